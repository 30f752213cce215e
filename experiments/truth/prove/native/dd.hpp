// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Double-double arithmetic (106 bits), for proposals that double cannot make. Dekker (1971), Knuth;
// sin/cos by Taylor series.
#pragma once
#include <cmath>

namespace truth {

struct dd {
  double hi, lo;
  dd() : hi(0), lo(0) {}
  dd(double h) : hi(h), lo(0) {}
  dd(double h, double l) : hi(h), lo(l) {}
  explicit operator double() const { return hi; }
};

inline dd quick(double a, double b) {
  double s = a + b;
  return {s, b - (s - a)};
}
inline dd sum2(double a, double b) {
  double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}
inline dd operator+(dd a, dd b) {
  dd s = sum2(a.hi, b.hi), t = sum2(a.lo, b.lo);
  s = quick(s.hi, s.lo + t.hi);
  return quick(s.hi, s.lo + t.lo);
}
inline dd operator-(dd a) { return {-a.hi, -a.lo}; }
inline dd operator-(dd a, dd b) { return a + (-b); }
inline dd operator*(dd a, dd b) {
  double p = a.hi * b.hi, e = std::fma(a.hi, b.hi, -p);
  return quick(p, e + (a.hi * b.lo + a.lo * b.hi));
}
inline dd operator/(dd a, dd b) {
  double q1 = a.hi / b.hi;
  dd r = a - b * dd(q1);
  double q2 = r.hi / b.hi;
  r = r - b * dd(q2);
  return quick(q1, q2) + dd(r.hi / b.hi);
}
inline dd& operator+=(dd& a, dd b) { return a = a + b; }
inline dd& operator-=(dd& a, dd b) { return a = a - b; }
inline dd& operator*=(dd& a, dd b) { return a = a * b; }
inline bool operator<(dd a, dd b) { return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo); }
inline bool operator>(dd a, dd b) { return b < a; }
inline bool operator<=(dd a, dd b) { return !(b < a); }
inline bool operator>=(dd a, dd b) { return !(a < b); }
inline bool operator==(dd a, dd b) { return a.hi == b.hi && a.lo == b.lo; }
inline dd sqrt(dd a) {
  if (!(a.hi > 0)) return 0.0;
  double s = std::sqrt(a.hi);
  return dd(s) + (a - dd(s) * dd(s)) / dd(2 * s);
}
inline dd abs(dd a) { return a.hi < 0 ? -a : a; }

inline void sincos(double x, double& s, double& c) {
  s = std::sin(x);
  c = std::cos(x);
}
inline void sincos(dd x, dd& s, dd& c) {
  // x - m pi/32 with pi to 161 bits, then Taylor, then the angle-addition of the double-double
  // table of sin, cos(m pi/32).
  static const double p1 = 3.141592653589793116e+00, p2 = 1.224646799147353207e-16,
                      p3 = -2.994769809718339666e-33;
  double q = std::nearbyint(x.hi / (p1 / 2));
  dd r = ((x - dd(q) * dd(p1 / 2)) - dd(q) * dd(p2 / 2)) - dd(q) * dd(p3 / 2);
  r = r * dd(1.0 / 64);
  dd r2 = r * r, term = r, sn = r, cn = -r2 * dd(0.5), ct = cn;  // cn = cos - 1
  for (int i = 3; i < 22; i += 2) {
    term = -(term * r2) / dd(double(i) * (i - 1));
    sn += term;
    ct = -(ct * r2) / dd(double(i) * (i + 1));
    cn += ct;
  }
  for (int i = 0; i < 6;
       ++i) {  // double the angle six times: cos 2r - 1 = 2 (cos r - 1)(cos r + 1)
    sn = dd(2) * sn * (cn + dd(1));
    cn = dd(2) * cn * (cn + dd(2));
  }
  dd cs = cn + dd(1);
  switch (((long long)q % 4 + 4) % 4) {
    case 0:
      s = sn;
      c = cs;
      break;
    case 1:
      s = cs;
      c = -sn;
      break;
    case 2:
      s = -sn;
      c = -cs;
      break;
    default:
      s = -cs;
      c = sn;
  }
}

template <class T>
struct vec {
  T x{}, y{}, z{};
  T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
};
template <class T>
vec<T> operator+(vec<T> a, vec<T> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
vec<T> operator-(vec<T> a, vec<T> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
vec<T> operator-(vec<T> a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
vec<T> operator*(vec<T> a, T s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class T>
T dot(vec<T> a, vec<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
vec<T> cross(vec<T> a, vec<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T norm(vec<T> a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
template <class T>
struct mat {
  vec<T> r[3];
};
template <class T>
vec<T> operator*(const mat<T>& m, vec<T> v) {
  return {dot(m.r[0], v), dot(m.r[1], v), dot(m.r[2], v)};
}
template <class T>
mat<T> operator*(const mat<T>& m, const mat<T>& n) {
  mat<T> out;
  for (int i = 0; i < 3; ++i) out.r[i] = n.r[0] * m.r[i].x + n.r[1] * m.r[i].y + n.r[2] * m.r[i].z;
  return out;
}
template <class T>
mat<T> rotation(T w, T x, T y, T z) {
  T s = T(1) / (w * w + x * x + y * y + z * z), two = T(2) * s;
  return {{{(w * w + x * x - y * y - z * z) * s, (x * y - w * z) * two, (x * z + w * y) * two},
           {(x * y + w * z) * two, (w * w - x * x + y * y - z * z) * s, (y * z - w * x) * two},
           {(x * z - w * y) * two, (y * z + w * x) * two, (w * w - x * x - y * y + z * z) * s}}};
}

}  // namespace truth
