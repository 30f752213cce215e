// Proposals for one convex pair: separating planes over time segments, and points inside both bodies.
#pragma once
#include <algorithm>
#include <optional>

#include "gjk.hpp"

namespace truth {

struct Pair {  // B at rest, all relative to p_A
    std::array<double, 4> qa, qb;
    std::array<double, 3> pa, pb, d, k;
    double theta;
};

template <class T>
struct Scene {
    mat<T> RA, RB;
    vec<T> dp, d, k;
    T theta;
    bool turns;
    explicit Scene(const Pair& p) {
        RA = rotation(T(p.qa[0]), T(p.qa[1]), T(p.qa[2]), T(p.qa[3]));
        RB = rotation(T(p.qb[0]), T(p.qb[1]), T(p.qb[2]), T(p.qb[3]));
        dp = {T(p.pb[0]) - T(p.pa[0]), T(p.pb[1]) - T(p.pa[1]), T(p.pb[2]) - T(p.pa[2])};
        d = {T(p.d[0]), T(p.d[1]), T(p.d[2])};
        theta = T(p.theta);
        turns = p.theta != 0;
        k = {T(p.k[0]), T(p.k[1]), T(p.k[2])};
        if (turns) k = k * (T(1) / norm(k));
    }
    mat<T> turn(T t) const {
        mat<T> R{{{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}}};
        if (!turns) return R;
        T s, c;
        sincos(theta * t, s, c);
        T v = T(1) - c;
        R.r[0] = {c + k.x * k.x * v, k.x * k.y * v - k.z * s, k.x * k.z * v + k.y * s};
        R.r[1] = {k.y * k.x * v + k.z * s, c + k.y * k.y * v, k.y * k.z * v - k.x * s};
        R.r[2] = {k.z * k.x * v - k.y * s, k.z * k.y * v + k.x * s, c + k.z * k.z * v};
        return R;
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
Points<T> turned(const Scene<T>& s, const Vertices& A) {  // R(q_A) v
    Points<T> r;
    r.reserve(A.size());
    for (auto& v : A) r.push_back(s.RA * vec<T>{T(v[0]), T(v[1]), T(v[2])});
    return r;
}
template <class T>
Points<T> placed(const Scene<T>& s, const Vertices& B) {  // R(q_B) v + p_B - p_A
    Points<T> b;
    b.reserve(B.size());
    for (auto& v : B) b.push_back(s.RB * vec<T>{T(v[0]), T(v[1]), T(v[2])} + s.dp);
    return b;
}

template <class T>
struct Moving {  // A's points: r = R(q_A) v, and x at time `now`, kept for the next question at that time
    Points<T> r, x;
    double now = -1;
};
template <class T>
struct Placed {  // two point sets in a scene
    const Scene<T>& scene;
    Moving<T>& a;
    const Points<T>&r, &b;
    double reach;  // of all coordinates
    Placed(const Scene<T>& s, Moving<T>& a, const Points<T>& b, double reach) : scene(s), a(a), r(a.r), b(b), reach(reach) {}
    const Points<T>& at(double t) {
        if (t == a.now) return a.x;
        a.x.resize(r.size());
        auto shift = scene.d * T(t);
        if (scene.turns && t != 0) {
            auto R = scene.turn(T(t));
            for (size_t i = 0; i < r.size(); ++i) a.x[i] = R * r[i] + shift;
        } else
            for (size_t i = 0; i < r.size(); ++i) a.x[i] = r[i] + shift;
        a.now = t;
        return a.x;
    }
    double blur() const { return resolution<T>() * 64 * (1 + std::abs(double(scene.theta))) * reach; }
};

struct Wide {
    double hi[3], lo[3];
};
inline Wide wide(vec<double> v) { return {{v.x, v.y, v.z}, {0, 0, 0}}; }
inline Wide wide(vec<dd> v) { return {{v.x.hi, v.y.hi, v.z.hi}, {v.x.lo, v.y.lo, v.z.lo}}; }
inline vec<dd> unwide(const Wide& w) { return {{w.hi[0], w.lo[0]}, {w.hi[1], w.lo[1]}, {w.hi[2], w.lo[2]}}; }

struct Segment {
    double end;
    char frame;
    Wide n;
};

struct Inside {
    Wide point;
    std::array<int, 4> a, b;
};  // point relative to p_A

// Does plane n (in the frame's own coordinates) keep the pair apart by `margin` over [s, e]? As the checker asks it.
template <class T>
bool leaf(Placed<T>& P, double s, double e, char frame, vec<T> n, T margin) {
    using std::abs;
    const auto& S = P.scene;
    margin = margin * norm(n) + T(P.blur()) * norm(n);
    T h = T(e) - T(s), th2 = S.theta * S.theta, half = h * h * T(0.5);
    T nk = norm(cross(n, S.k));
    auto holds = [&](T f0, T f1, T M) {
        T lo = (f0 < f1 ? f0 : f1) - margin, hi = (f0 < f1 ? f1 : f0) - margin;
        return lo > T(0) && hi + T(3) * lo > M * half;
    };
    if (frame == 'W') {
        T c = dot(n, P.b[support(P.b, -n)]);
        auto n0 = transposed(S.turn(T(s)), n), n1 = transposed(S.turn(T(e)), n);
        T c0 = c - T(s) * dot(n, S.d), c1 = c - T(e) * dot(n, S.d);
        for (auto& r : P.r)
            if (!holds(c0 - dot(n0, r), c1 - dot(n1, r), S.turns ? th2 * nk * norm(cross(S.k, r)) : T(0))) return false;
    } else {
        T c = dot(n, P.r[support(P.r, n)]);
        auto n0 = S.turn(T(s)) * n, n1 = S.turn(T(e)) * n;
        T slide = T(2) * abs(S.theta) * norm(cross(S.k, S.d));
        for (auto& b : P.b) {
            auto w0 = b - S.d * T(s), w1 = b - S.d * T(e);
            T f0 = dot(n0, w0) - c, f1 = dot(n1, w1) - c;
            T a0 = norm(cross(S.k, w0)), a1 = norm(cross(S.k, w1));
            if (!holds(f0, f1, nk * (th2 * (a0 > a1 ? a0 : a1) + slide))) return false;
        }
    }
    return true;
}

// How long n (world, at time s) surely stays a separating plane by margin |n|, in either frame.
template <class T>
T lasts(Placed<T>& P, double s, double end, vec<T> n, T margin, char& frame) {
    using std::abs;
    using std::sqrt;
    const auto& S = P.scene;
    const auto& x = P.at(s);
    margin = margin * norm(n);
    T nk = norm(cross(n, S.k)), th2 = S.theta * S.theta;
    auto root = [](T f0, T f1, T M) {
        if (!(f0 > T(0))) return T(0);
        T q = f1 * f1 + T(2) * M * f0;
        T r = sqrt(q) - f1;
        return r > T(0) ? T(2) * f0 / r : T(1e30);
    };
    T hW(1e30), hA(1e30);
    T c = dot(n, P.b[support(P.b, -n)]) - margin, nd = dot(n, S.d);
    auto kn = cross(n, S.k);  // n . (k x y) = (n x k) . y
    auto shift = S.d * T(s);
    for (auto& p : x) {
        auto y = p - shift;
        T h = root(c - dot(n, p), -nd - S.theta * dot(kn, y), S.turns ? th2 * nk * norm(cross(S.k, y)) : T(0));
        if (h < hW) hW = h;
    }
    frame = 'W';
    if (!S.turns) return hW;
    c = dot(n, x[support(x, n)] - shift) + margin;
    T kd = norm(cross(S.k, S.d)), slide = T(2) * abs(S.theta) * kd, rest = T(end) - T(s);
    for (auto& b : P.b) {
        auto w = b - shift;
        T M = nk * (th2 * (norm(cross(S.k, w)) + rest * kd) + slide);
        T h = root(dot(n, w) - c, -S.theta * dot(kn, w) - nd, M);
        if (h < hA) hA = h;
    }
    if (hA > hW) {
        frame = 'A';
        return hA;
    }
    return hW;
}

// A point strictly inside both, found on shrunk copies so that it keeps clear of both surfaces. Each copy shrinks towards an
// interior point drawn at random: symmetric bodies would else put the point on faces of every tetrahedron tried.
template <class T>
std::optional<Inside> inside(const Points<T>& A, const Points<T>& B, double reach) {
    unsigned long long seed = 1;
    auto draw = [&] {
        return 0.25 + double((seed = seed * 6364136223846793005ULL + 1442695040888963407ULL) >> 33) / 4294967296.0;
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
    for (double eps = std::is_same_v<T, double> ? 0.5 : 3e-3; eps > least; eps *= eps > 0.06 ? 0.25 : 0.03)
        for (int attempt = 0; attempt < 2; ++attempt) {
            auto ca = centre(A), cb = centre(B);
            for (size_t i = 0; i < A.size(); ++i) a[i] = A[i] + (ca - A[i]) * T(eps);
            for (size_t i = 0; i < B.size(); ++i) b[i] = B[i] + (cb - B[i]) * T(eps);
            auto g = gjk<T>(a, b, cb - ca, reach, 1e-3);
            if (g.status == Status::Apart) break;
            if (g.status != Status::Meet) continue;
            one[0] = {};
            for (int i = 0; i < 4; ++i) one[0] = one[0] + b[g.s[i].b] * g.w[i];
            auto ga = gjk<T>(one, A, ca - one[0], reach, 1e-3), gb = gjk<T>(one, B, cb - one[0], reach, 1e-3);
            if (ga.status != Status::Meet || gb.status != Status::Meet) continue;
            Inside w;
            w.point = wide(one[0]);
            for (int i = 0; i < 4; ++i) w.a[i] = ga.s[i].b, w.b[i] = gb.s[i].b;
            return w;
        }
    return std::nullopt;
}

// Work done so far and allowed, in vertices visited (double-double counts 20-fold): the stated limit of effort of a case.
struct Effort {
    double done = 0, limit = 0;
    bool spent() const { return done > limit; }
};

// March: certified segments from `s` on until the gap falls to `margin` or below `floor`, a step falls below `least_step`, or
// `end` is reached. Appends to `out`. least: the smallest distance seen, at time `at`.
struct March {
    double t = 0, least = 1e300, at = 0;
    bool done = false;
};

template <class T>
March march(Placed<T>& P, double s, double end, double margin, double floor, double least_step, Effort& effort,
            std::vector<Segment>& out) {
    March m;
    m.t = s;
    vec<T> guess = P.b[0] - P.at(s)[0];
    for (int step = 0; step < 2000 && !effort.spent(); ++step) {
        effort.done += double(P.r.size() + P.b.size()) * (std::is_same_v<T, double> ? 1 : 20);
        const auto& x = P.at(m.t);
        auto g = gjk<T>(x, P.b, guess, P.reach, 1e-6);
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
        auto own = frame == 'A' ? transposed(P.scene.turn(T(m.t)), n) : n;
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
