// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Proposals for one convex pair: separating planes over time segments, and points inside both
// bodies.
#pragma once
#include <algorithm>
#include <optional>

#include "gjk.hpp"

namespace truth {

// One body as the query states it: its pose, and its motion: it turns by `theta` about the axis k
// through its point `about`.
struct Mover {
  std::array<double, 4> q;
  std::array<double, 3> p, d, k;
  double theta;
  std::array<double, 3> about;
};
struct Pair {
  Mover a, b;
};

// The power of two that brings the largest component to 1 or a little more: squares of numbers of
// any size stay in range.
template <size_t N>
double unit(const std::array<double, N>& v) {
  double top = 0;
  for (double c : v) top = std::max(top, std::abs(c));
  return std::ldexp(1.0, -std::ilogb(top));
}
template <class T>
vec<T> vector(const std::array<double, 3>& v) {
  return {T(v[0]), T(v[1]), T(v[2])};
}

template <class T>
struct Turn {  // Rot(k, theta t), k a unit vector
  vec<T> k;
  T theta;
  bool on;
  explicit Turn(const Mover& m) : k(vector<T>(m.k)), theta(T(m.theta)), on(m.theta != 0) {
    if (on) {
      const double u = unit(m.k);
      k = vector<T>({m.k[0] * u, m.k[1] * u, m.k[2] * u});
      k = k * (T(1) / norm(k));
    } else
      k = {};
  }
  mat<T> at(T t) const {
    mat<T> R{{{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}}};
    if (!on) return R;
    T s, c;
    sincos(theta * t, s, c);
    T v = T(1) - c;
    R.r[0] = {c + k.x * k.x * v, k.x * k.y * v - k.z * s, k.x * k.z * v + k.y * s};
    R.r[1] = {k.y * k.x * v + k.z * s, c + k.y * k.y * v, k.y * k.z * v - k.x * s};
    R.r[2] = {k.z * k.x * v - k.y * s, k.z * k.y * v + k.x * s, c + k.z * k.z * v};
    return R;
  }
};

// Both bodies in one frame, which moves with B's displacement: A's point of turning starts at 0 and
// moves by d = d_A - d_B, and B's stays at dp.
template <class T>
struct Scene {
  mat<T> RA, RB;
  vec<T> about_a, about_b, dp, d;
  Turn<T> a, b;
  explicit Scene(const Pair& p) : a(p.a), b(p.b) {
    RA = rotation(p.a), RB = rotation(p.b);
    if (a.on) about_a = vector<T>(p.a.about);
    if (b.on) about_b = vector<T>(p.b.about);
    dp = (vector<T>(p.b.p) - vector<T>(p.a.p)) + (RB * about_b - RA * about_a);
    d = vector<T>(p.a.d) - vector<T>(p.b.d);
  }
  bool turns() const { return a.on || b.on; }
  static mat<T> rotation(const Mover& m) {
    const double u = unit(m.q);
    return truth::rotation(T(m.q[0] * u), T(m.q[1] * u), T(m.q[2] * u), T(m.q[3] * u));
  }
};

template <class T>
vec<T> transposed(const mat<T>& m, vec<T> v) {
  return m.r[0] * v.x + m.r[1] * v.y + m.r[2] * v.z;
}

using Vertices = std::vector<std::array<double, 3>>;

template <class T>
double largest(const Points<T>& p) {
  double m = 0;
  for (auto& v : p) m = std::max(m, double(norm(v)));
  return m;
}
template <class T>
Points<T> turned(const mat<T>& R, vec<T> about, const Vertices& v) {  // R (v - about)
  Points<T> r;
  r.reserve(v.size());
  for (auto& x : v) r.push_back(R * (vector<T>(x) - about));
  return r;
}

template <class T>
struct Moving {  // a body's points about its point of turning at t = 0, and where they are at time
                 // `now`
  Points<T> r, x;
  double now = -1;
  const Points<T>& at(const Turn<T>& turn, vec<T> shift, bool moves, double t) {
    if (now >= 0 && (t == now || !moves)) return x;
    x.resize(r.size());
    if (turn.on && t != 0) {
      auto R = turn.at(T(t));
      for (size_t i = 0; i < r.size(); ++i) x[i] = R * r[i] + shift;
    } else
      for (size_t i = 0; i < r.size(); ++i) x[i] = r[i] + shift;
    now = t;
    return x;
  }
};
template <class T>
struct Placed {  // two point sets in a scene
  const Scene<T>& scene;
  Moving<T>&a_, &b_;
  const Points<T>&r, &s;  // of A and of B, about their points of turning at t = 0
  double reach;           // of all coordinates
  Placed(const Scene<T>& scene, Moving<T>& a, Moving<T>& b, double reach)
      : scene(scene), a_(a), b_(b), r(a.r), s(b.r), reach(reach) {}
  const Points<T>& a(double t) { return a_.at(scene.a, scene.d * T(t), true, t); }
  const Points<T>& b(double t) { return b_.at(scene.b, scene.dp, scene.b.on, t); }
  size_t size() const { return r.size() + s.size(); }
  double blur() const {
    return resolution<T>() * 64 *
           (1 + std::abs(double(scene.a.theta)) + std::abs(double(scene.b.theta))) * reach;
  }
};

struct Wide {
  double hi[3], lo[3];
};
inline Wide wide(vec<double> v) { return {{v.x, v.y, v.z}, {0, 0, 0}}; }
inline Wide wide(vec<dd> v) { return {{v.x.hi, v.y.hi, v.z.hi}, {v.x.lo, v.y.lo, v.z.lo}}; }
inline vec<dd> unwide(const Wide& w) {
  return {{w.hi[0], w.lo[0]}, {w.hi[1], w.lo[1]}, {w.hi[2], w.lo[2]}};
}

struct Segment {
  double end;
  char frame;  // 'W', 'A', 'B', or 'S': the plane of a seed, n.hi[0] its number
  Wide n;
};

struct Inside {
  Wide point;
  std::array<int, 4> a, b;
};  // point relative to p_A

// Does plane n (in its own frame: 'W' at rest, 'A' or 'B' turning with that body) keep the pair
// apart by `margin` over [s, e]? As the checker asks it: each point q of one side (Q) against the
// support of the other (P), at both ends, with a bound on the second derivative in between.
template <class T>
bool leaf(Placed<T>& P, double s, double e, char frame, vec<T> n, T margin) {
  using std::abs;
  const auto& S = P.scene;
  const bool on_b = frame == 'A';  // Q is B
  const auto &q = on_b ? P.s : P.r, &p = on_b ? P.r : P.s;
  const Turn<T>&tq = on_b ? S.b : S.a, &tp = on_b ? S.a : S.b;
  const T h = T(e) - T(s), half = h * h * T(0.5), sign = T(on_b ? 1 : -1);
  margin = (margin + T(P.blur())) * norm(n);
  vec<T> line[2], arm[2], k{};
  T base[2];
  for (int i = 0; i < 2; ++i) {
    const T t = T(i ? e : s);
    const auto nt = frame == 'W' ? n : tp.at(t) * n;
    const auto mp = frame == 'W' ? transposed(tp.at(t), n) : n;
    line[i] = transposed(tq.at(t), nt);
    const auto shift = S.dp - S.d * t;
    const auto support_p = on_b ? dot(mp, p[support(p, mp)]) : -dot(mp, p[support(p, -mp)]);
    base[i] = dot(nt, shift) - support_p - margin;
    if (frame != 'W') {
      const auto back = tq.at(T(s));
      k = transposed(back, tp.k), arm[i] = transposed(back, shift) * sign;
    }
  }
  const T nk = norm(cross(n, frame == 'W' ? tq.k : tp.k)), nn = norm(n), tq1 = abs(tq.theta),
          tp1 = abs(tp.theta);
  T rest(0), slide = T(2) * tp1 * norm(cross(tp.k, S.d));
  if (frame == 'W' && tp.on) {
    T far(0);
    for (auto& v : p) {
      T r = norm(cross(tp.k, v));
      if (r > far) far = r;
    }
    rest = tp.theta * tp.theta * norm(cross(n, tp.k)) * far;
  }
  for (auto& v : q) {
    T f0 = base[0] + sign * dot(line[0], v), f1 = base[1] + sign * dot(line[1], v);
    T lo = f0 < f1 ? f0 : f1, hi = f0 < f1 ? f1 : f0;
    if (!(lo > T(0))) return false;
    if (!S.turns()) continue;
    T spin = tq.on ? norm(cross(tq.k, v)) : T(0), M;
    if (frame == 'W')
      M = tq.theta * tq.theta * nk * spin + rest;
    else {
      T a0 = norm(cross(k, v + arm[0])), a1 = norm(cross(k, v + arm[1])), a = a0 > a1 ? a0 : a1;
      M = nk * (tp.theta * tp.theta * (a + tq1 * h * spin) + slide + T(2) * tp1 * tq1 * spin) +
          nn * tq.theta * tq.theta * spin;
    }
    if (!(hi + T(3) * lo > M * half)) return false;
  }
  return true;
}

// How long n (world, at time s) surely stays a separating plane by margin |n|, and in which frame
// the longest.
template <class T>
T lasts(Placed<T>& P, double s, double end, vec<T> n, T margin, char& frame) {
  using std::abs;
  using std::sqrt;
  const auto& S = P.scene;
  const auto &x = P.a(s), &y = P.b(s);
  const auto shift = S.d * T(s);
  margin = margin * norm(n);
  auto root = [](T f0, T f1, T M) {
    if (!(f0 > T(0))) return T(0);
    T q = f1 * f1 + T(2) * M * f0;
    T r = sqrt(q) - f1;
    return r > T(0) ? T(2) * f0 / r : T(1e30);
  };
  auto square = [](T x) { return x * x; };
  const T nd = dot(n, S.d), nn = norm(n);
  const auto na = cross(n, S.a.k), nb = cross(n, S.b.k);  // n . (k x y) = (n x k) . y
  const T nka = norm(na), nkb = norm(nb), ta = abs(S.a.theta), tb = abs(S.b.theta);
  T best(1e30);
  {  // at rest: between A and B stands a plane that moves as the mean of the two points nearest to
     // it
    const int i = support(x, n), j = support(y, -n);
    T top = dot(n, x[i]), low = dot(n, y[j]) - margin, place = low, speed(0);
    if (S.b.on) {
      place = (top + low) * T(0.5);
      speed = (nd + S.a.theta * dot(na, x[i] - shift) + S.b.theta * dot(nb, y[j] - S.dp)) * T(0.5);
      for (auto& p : y) {
        auto r = p - S.dp;
        T h = root(dot(n, p) - margin - place, S.b.theta * dot(nb, r) - speed,
                   square(tb) * nkb * norm(cross(S.b.k, r)));
        if (h < best) best = h;
      }
    }
    for (auto& p : x) {
      auto r = p - shift;
      T h = root(place - dot(n, p), speed - nd - S.a.theta * dot(na, r),
                 S.a.on ? square(ta) * nka * norm(cross(S.a.k, r)) : T(0));
      if (h < best) best = h;
    }
  }
  frame = 'W';
  const T rest = T(end) - T(s);
  // Turning with one body (its support stays), past the points q of the other, about the centre of
  // turning `centre`.
  auto turning = [&](const Turn<T>& c, const Turn<T>& o, const Points<T>& q, vec<T> centre,
                     vec<T> own, T sign, T fixed, T nk) {
    const auto n1 = cross(n, c.k), n2 = cross(n, o.k);
    const T kd = norm(cross(c.k, S.d)), tc = abs(c.theta), to = abs(o.theta);
    T least(1e30);
    for (auto& p : q) {
      auto w = p - centre, r = p - own;
      T spin = o.on ? norm(cross(o.k, r)) : T(0);
      T M = nk * (square(tc) * (norm(cross(c.k, w)) + rest * (kd + to * spin)) +
                  T(2) * tc * (kd + to * spin)) +
            nn * square(to) * spin;
      T f1 = sign * (o.theta * dot(n2, r) - c.theta * dot(n1, w)) - nd;
      T h = root(sign * dot(n, w) - fixed, f1, M);
      if (h < least) least = h;
    }
    return least;
  };
  if (S.a.on) {
    T fixed = dot(n, x[support(x, n)] - shift) + margin;
    T h = turning(S.a, S.b, y, shift, S.dp, T(1), fixed, nka);
    if (h > best) best = h, frame = 'A';
  }
  if (S.b.on) {
    T fixed = margin - dot(n, y[support(y, -n)] - S.dp);
    T h = turning(S.b, S.a, x, S.dp, shift, T(-1), fixed, nkb);
    if (h > best) best = h, frame = 'B';
  }
  return best;
}

// A point strictly inside both, found on shrunk copies so that it keeps clear of both surfaces.
// Each copy shrinks towards an interior point drawn at random: symmetric bodies would else put the
// point on faces of every tetrahedron tried.
template <class T>
std::optional<Inside> inside(const Points<T>& A, const Points<T>& B, double reach) {
  unsigned long long seed = 1;
  auto draw = [&] {
    return 0.25 + double((seed = seed * 6364136223846793005ULL + 1442695040888963407ULL) >> 33) /
                      4294967296.0;
  };
  auto centre = [&](const Points<T>& p) {
    vec<T> m;
    double total = 0;
    for (auto& v : p) {
      double w = draw();
      m = m + v * T(w), total += w;
    }
    return m * (T(1) / T(total));
  };
  Points<T> a(A), b(B), one(1);
  const double least = std::is_same_v<T, double> ? 1e-9 : 1e-25;
  for (double eps = std::is_same_v<T, double> ? 0.5 : 3e-3; eps > least;
       eps *= eps > 0.06 ? 0.25 : 0.03)
    for (int attempt = 0; attempt < 2; ++attempt) {
      auto ca = centre(A), cb = centre(B);
      for (size_t i = 0; i < A.size(); ++i) a[i] = A[i] + (ca - A[i]) * T(eps);
      for (size_t i = 0; i < B.size(); ++i) b[i] = B[i] + (cb - B[i]) * T(eps);
      auto g = gjk<T>(a, b, cb - ca, reach, 1e-3);
      if (g.status == Status::Apart) break;
      if (g.status != Status::Meet) continue;
      one[0] = {};
      for (int i = 0; i < 4; ++i) one[0] = one[0] + b[g.s[i].b] * g.w[i];
      auto ga = gjk<T>(one, A, ca - one[0], reach, 1e-3),
           gb = gjk<T>(one, B, cb - one[0], reach, 1e-3);
      if (ga.status != Status::Meet || gb.status != Status::Meet) continue;
      Inside w;
      w.point = wide(one[0]);
      for (int i = 0; i < 4; ++i) w.a[i] = ga.s[i].b, w.b[i] = gb.s[i].b;
      return w;
    }
  return std::nullopt;
}

// Work done so far and allowed, in vertices visited (double-double counts 20-fold): the stated
// limit of effort of a case.
struct Effort {
  double done = 0, limit = 0;
  bool spent() const { return done > limit; }
};

// March: certified segments from `s` on until the gap falls to `margin` or below `floor`, a step
// falls below `least_step`, or `end` is reached. Appends to `out`. least: the smallest distance
// seen, at time `at`.
struct March {
  double t = 0, least = 1e300, at = 0;
  bool done = false;
};

template <class T>
March march(Placed<T>& P, double s, double end, double margin, double floor, double least_step,
            Effort& effort, std::vector<Segment>& out) {
  March m;
  m.t = s;
  vec<T> guess = P.b(s)[0] - P.a(s)[0];
  for (int step = 0; step < 2000 && !effort.spent(); ++step) {
    effort.done += double(P.size()) * (std::is_same_v<T, double> ? 1 : 20);
    auto g = gjk<T>(P.a(m.t), P.b(m.t), guess, P.reach, 1e-6);
    if (g.status != Status::Apart) return m;
    auto n = guess = g.v;
    double gap = double(norm(n));
    if (gap < m.least) m.least = gap, m.at = m.t;
    if (!(gap > floor) || !(gap > margin)) return m;
    n = n * T(1 / gap);
    if (m.t >= end) {
      if (!leaf(P, m.t, m.t, 'W', n, T(margin))) return m;
      if (out.empty() || out.back().end < end) out.push_back({end, 'W', wide(n)});
      m.done = true;
      return m;
    }
    char frame;
    double h = double(lasts(P, m.t, end, n, T(margin), frame));
    if (0.999 * h < least_step && m.t + h < end) return m;
    auto own = frame == 'W' ? n : transposed((frame == 'A' ? P.scene.a : P.scene.b).at(T(m.t)), n);
    double e = m.t;
    for (double f : {8.0, 3.0, 1.4, 0.999, 0.7, 0.4, 0.15, 0.03}) {
      double to = std::min(end, m.t + f * h);
      if (to > m.t && leaf(P, m.t, to, frame, own, T(margin))) {
        e = to;
        break;
      }
    }
    if (!(e - m.t > 2e-13 * e)) return m;
    out.push_back({e, frame, wide(own)});
    m.t = e;
    if (e >= end) {
      m.done = true;
      return m;
    }
  }
  return m;
}

}  // namespace truth
