// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// An answer to "do the interiors of two convex hulls meet?" that shares nothing with verified.hpp:
// every plane that three vertices of one body or an edge of each can span is tried, in doubles and,
// where these are not sure, in 113 bits.
#pragma once
#include <algorithm>
#include <vector>

#include "ofg/motion.hpp"

namespace judge {

__extension__ typedef __float128 Quad;

template <class T>
struct Point {
  T x, y, z;
};
template <class T>
Point<T> operator-(const Point<T>& a, const Point<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
T dot(const Point<T>& a, const Point<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Point<T> cross(const Point<T>& a, const Point<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T size_of(const Point<T>& a) {  // no less than its length
  const auto plus = [](T t) { return t < 0 ? -t : t; };
  return plus(a.x) + plus(a.y) + plus(a.z);
}

enum class Says { clear, hit, near };  // near: nothing, it is as good as touching

struct Question {
  const std::vector<ofg::Vec3<double>>&a, &b;
  const ofg::Pose &p, &q;
};

template <class T>
using Points = std::vector<Point<T>>;

// The vertices of both bodies less B's position, times |q_A|^2 |q_B|^2: nothing is divided, so that
// whole numbers stay whole.
template <class T>
struct Posed {
  Points<T> a, b;
  T lengths = 0;  // no coordinate, and none of the terms it is the sum of, is larger

  explicit Posed(const Question& question) {
    T q[2][4], square[2] = {};
    for (int i = 0; i < 2; ++i) {
      const ofg::Pose& pose = i == 0 ? question.p : question.q;
      double most = 0;
      for (const double c : pose.q) most = std::max(most, std::abs(c));
      for (int j = 0; j < 4; ++j) q[i][j] = T(pose.q[j]) / T(most), square[i] += q[i][j] * q[i][j];
    }
    const T all = square[0] * square[1];
    const auto &p = question.p.p, &o = question.q.p;
    const Point<T> way{(T(p.x) - T(o.x)) * all, (T(p.y) - T(o.y)) * all, (T(p.z) - T(o.z)) * all};
    lengths = size_of(way) + turn(question.a, q[0], square[1], way, a) * all +
              turn(question.b, q[1], square[0], {}, b) * all;
  }

 private:
  // Returns the largest vertex.
  static T turn(const std::vector<ofg::Vec3<double>>& from, const T (&q)[4], T other,
                const Point<T>& to, Points<T>& out) {
    const T w = q[0], x = q[1], y = q[2], z = q[3];
    const Point<T> m[3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    T most = 0;
    out.reserve(from.size());
    for (const auto& v : from) {
      const Point<T> at{T(v.x), T(v.y), T(v.z)};
      most = std::max(most, size_of(at));
      out.push_back({dot(m[0], at) * other + to.x, dot(m[1], at) * other + to.y,
                     dot(m[2], at) * other + to.z});
    }
    return most;
  }
};

// Calls f(normal, the same in quads as a function of them) for every candidate.
template <class F>
void normals(const Points<double>& a, const Points<double>& b, F f) {
  for (const bool second : {false, true}) {
    const auto& d = second ? b : a;
    for (std::size_t i = 0; i < d.size(); ++i)
      for (std::size_t j = i + 1; j < d.size(); ++j)
        for (std::size_t k = j + 1; k < d.size(); ++k)
          f(cross(d[j] - d[i], d[k] - d[i]), [second, i, j, k](const Posed<Quad>& all) {
            const auto& e = second ? all.b : all.a;
            return cross(e[j] - e[i], e[k] - e[i]);
          });
  }
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = i + 1; j < a.size(); ++j)
      for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t l = k + 1; l < b.size(); ++l)
          f(cross(a[j] - a[i], b[l] - b[k]), [i, j, k, l](const Posed<Quad>& all) {
            return cross(all.a[j] - all.a[i], all.b[l] - all.b[k]);
          });
}

// How far apart the two are along n, times |n|: the least along it of B less the greatest of A.
template <class T>
T gap(const Points<T>& a, const Points<T>& b, const Point<T>& n) {
  T most = dot(a[0], n), least = dot(b[0], n);
  for (const auto& p : a) most = std::max(most, dot(p, n));
  for (const auto& p : b) least = std::min(least, dot(p, n));
  return least - most;
}

// How far apart along n or against it.
template <class T>
T gap_either_way(const Points<T>& a, const Points<T>& b, const Point<T>& n) {
  T most[2] = {dot(a[0], n), dot(b[0], n)}, least[2] = {most[0], most[1]};
  for (const bool second : {false, true})
    for (const auto& p : second ? b : a) {
      const T t = dot(p, n);
      most[second] = std::max(most[second], t), least[second] = std::min(least[second], t);
    }
  return std::max(least[1] - most[0], least[0] - most[1]);
}

inline Points<double> rounded(const Points<Quad>& all) {
  Points<double> out;
  for (const auto& p : all) out.push_back({double(p.x), double(p.y), double(p.z)});
  return out;
}

// By all planes. whole: of such numbers that 113 bits hold every product of three coordinates; then
// the answer is exact, and bodies that touch are clear of one another.
inline Says by_all_planes(const Question& question, bool whole) {
  const Posed<Quad> all(question);
  const Points<double> a = rounded(all.a), b = rounded(all.b);
  double size = 0;
  for (const auto* side : {&a, &b})
    for (const auto& p : *side) size = std::max(size, size_of(p));
  // A normal is off by some 1e-15 size^2, so what is along it by 1e-15 size^3, however short it is.
  const double off = 1e-14 * size * size * size;
  const Quad tiny = whole ? Quad(0) : Quad(1e-31) * all.lengths * size * size;
  bool clear = false, near = false;
  normals(a, b, [&](const Point<double>& n, auto exactly) {
    if (clear) return;
    const double apart = gap_either_way(a, b, n);
    if (apart > off) clear = true;
    if (apart > off || apart < -off) return;
    const Point<Quad> m = exactly(all);
    if (size_of(m) <= tiny / size) return;  // three in a line, or parallel
    const Quad exact = gap_either_way(all.a, all.b, m);
    if (exact > tiny || (whole && exact == 0))
      clear = true;
    else if (exact >= -tiny)
      near = true;
  });
  return clear ? Says::clear : near ? Says::near : Says::hit;
}

// How far A may go along a direction and still meet B, if it goes on from where they do: beyond it
// they are apart. In doubles.
inline double reach(const Question& question, const Point<double>& way) {
  const Posed<double> at(question);
  double far = 1e300, all = 1;  // what Posed multiplies by
  for (const auto* pose : {&question.p, &question.q}) {
    double most = 0, square = 0;
    for (const double c : pose->q) most = std::max(most, std::abs(c));
    for (const double c : pose->q) square += c / most * (c / most);
    all *= square;
  }
  normals(at.a, at.b, [&](const Point<double>& n, auto) {
    const double speed = dot(n, way);  // at which a gap along n grows, or shrinks
    if (!(speed * speed > 1e-18 * dot(n, n) * dot(way, way))) return;
    const double side = speed < 0 ? 1 : -1;
    far = std::min(far, -gap(at.a, at.b, {side * n.x, side * n.y, side * n.z}) / std::abs(speed));
  });
  return far / all;
}

}  // namespace judge
