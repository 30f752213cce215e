// What is proposed for a convex pair: at one instant, and over the step.
#pragma once
#include <string>

#include "convex.hpp"

namespace truth {

struct Instant { std::string label = "uncertain"; double gap = 0; Wide n{}; Inside in{}; };

template <class T> bool settle(Placed<T>& P, double t, Instant& out) {
    const auto& x = P.at(t);
    auto g = gjk<T>(x, P.b, P.b[0] - x[0], P.reach, 1e-9);
    if (g.status == Status::Apart) {
        double gap = double(norm(g.v));
        auto n = g.v * T(1 / gap);
        double trust = 32 * P.blur();
        if (!(gap > trust) || !leaf(P, t, t, 'W', n, T(0.5 * trust))) return false;
        double sure = double(dot(n, P.b[support(P.b, -n)]) - dot(n, x[support(x, n)])) / double(norm(n)) - P.blur();
        out.label = "clear", out.gap = sure * (1 - 1e-9), out.n = wide(n);
        return true;
    }
    auto w = inside<T>(x, P.b, P.reach);
    if (!w) return false;
    out.label = "hit", out.in = *w;
    return true;
}

struct Proof {
    std::string label = "uncertain", reason, start = "uncertain";
    double t_lo = 0, t_hi = 0, gap = 0;
    std::vector<Segment> segments;
    Inside in{};
    Instant end;
    int steps = 0;
};

class Prover {
  public:
    Prover(const Pair& pair, const Vertices& A, const Vertices& B)
        : fine_(pair), coarse_(pair), A_(A), B_(B), quick_(coarse_, A, B), theta_(pair.theta) {}

    Instant at(double t) {
        Instant i;
        if (!settle(quick_, t, i)) settle(slow(), t, i);
        return i;
    }

    Proof sweep(int effort) {
        Proof p;
        Instant start = at(0);
        p.start = start.label;
        if (start.label == "hit") { p.label = "hit"; p.in = start.in; p.end = at(1); return p; }
        if (start.label == "uncertain") { p.reason = "touching at the start"; return p; }
        if (theta_ == 0 && swept_clear(p)) return p;
        int steps = effort;
        March m = run(0, 1, 0, steps, p.segments);
        p.steps = effort - steps;
        if (m.done) { clear_with_gap(p, m, effort); return p; }
        if (m.tired) { p.reason = "effort limit of " + std::to_string(effort) + " segments"; return p; }
        p.t_lo = m.t;
        if (theta_ == 0) straighten(p);
        for (double rel : {2e-13, 6e-13, 1e-11, 1e-9, 1e-6}) {
            p.t_hi = std::min(1.0, m.t * (1 + rel));
            if (!(p.t_hi > m.t)) break;
            Instant hit = at(p.t_hi);
            if (hit.label != "hit") continue;
            p.label = "hit", p.in = hit.in, p.end = at(1);
            return p;
        }
        p.reason = "touching without overlap that could be certified, at t = " + std::to_string(m.t);
        return p;
    }

  private:
    Scene<dd> fine_;
    Scene<double> coarse_;
    const Vertices &A_, &B_;
    Placed<double> quick_;
    std::optional<Placed<dd>> slow_;
    double theta_;

    Placed<dd>& slow() {
        if (!slow_) slow_.emplace(fine_, A_, B_);
        return *slow_;
    }

    March run(double s, double end, double margin, int& steps, std::vector<Segment>& out) {
        double floor = 1e4 * quick_.blur();
        March m = march(quick_, s, end, margin, floor, steps, out);
        if (m.done || m.tired) return m;
        March f = march(slow(), m.t, end, margin, 1e3 * slow().blur(), steps, out);
        if (m.least < f.least) f.least = m.least, f.at = m.at;
        return f;
    }

    template <class T> bool swept_plane(Placed<T>& P, Proof& p) {  // translation: one plane for the whole step
        Points<T> both = P.at(0);
        auto e = P.at(1);
        both.insert(both.end(), e.begin(), e.end());
        auto g = gjk<T>(both, P.b, P.b[0] - both[0], P.reach, 1e-9);
        if (g.status != Status::Apart) return false;
        double gap = double(norm(g.v)), trust = 32 * P.blur();
        auto n = g.v * T(1 / gap);
        double sure = double(dot(n, P.b[support(P.b, -n)]) - dot(n, both[support(both, n)])) / double(norm(n)) - P.blur();
        if (!(sure > trust)) return false;
        p.label = "clear", p.gap = sure * (1 - 1e-9), p.segments = {{1.0, 'W', wide(n)}};
        return true;
    }
    bool swept_clear(Proof& p) { return swept_plane(quick_, p) || swept_plane(slow(), p); }

    void straighten(Proof& p) {  // translation: the last plane alone usually serves from the start
        if (p.segments.size() < 2) return;
        auto last = p.segments.back();
        if (leaf(slow(), 0, p.t_lo, 'W', unwide(last.n), dd(0))) p.segments = {last};
    }

    double nearest(double lo, double hi) {  // golden section on the distance
        auto gap = [&](double t) {
            const auto& x = quick_.at(t);
            auto g = gjk<double>(x, quick_.b, quick_.b[0] - x[0], quick_.reach, 1e-6);
            return g.status == Status::Apart ? norm(g.v) : 0.0;
        };
        const double r = 0.6180339887498949;
        double a = lo, b = hi, c = b - r * (b - a), d = a + r * (b - a), fc = gap(c), fd = gap(d);
        for (int i = 0; i < 24; ++i) {
            if (fc < fd) b = d, d = c, fd = fc, c = b - r * (b - a), fc = gap(c);
            else a = c, c = d, fc = fd, d = a + r * (b - a), fd = gap(d);
        }
        return std::min(fc, fd);
    }

    void clear_with_gap(Proof& p, const March& m, int effort) {
        p.label = "clear";
        double before = 0, after = 1, least = m.least;
        for (auto& s : p.segments) {
            if (s.end < m.at) before = s.end;
            if (s.end > m.at) { after = s.end; break; }
        }
        least = std::min(least, nearest(before, after));
        for (double share : {0.98, 0.85, 0.5, 0.1}) {
            std::vector<Segment> segments;
            int steps = effort;
            March again = run(0, 1, share * least, steps, segments);
            if (!again.done) continue;
            p.segments = segments, p.gap = share * least, p.steps += effort - steps;
            return;
        }
    }
};

}  // namespace truth
