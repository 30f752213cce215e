// What is proposed for two solids: at one instant, and over the step.
#pragma once
#include <cstdio>
#include <map>
#include <string>

#include "depth.hpp"
#include "solid.hpp"

namespace truth {

struct Tree {  // node 0 is the root; children split the elements of `side` at `cut`
    struct Node {
        std::vector<Segment> segments;
        char side = 0;
        int cut = 0, left = -1, right = -1;
    };
    std::vector<Node> nodes;
};

struct Common {  // a point inside both at some time, relative to p_A; piece and tetrahedron of each (piece -1: a mesh)
    Wide point{};
    int piece_a = -1, piece_b = -1;
    std::array<int, 4> a{}, b{};
};

using Elements = std::pair<int, int>;  // an element of A and one of B

// A plane that is known from elsewhere to keep two elements apart over [0, end], though they may touch.
struct Seed {
    int number;
    double end;
};
using Seeds = std::map<Elements, Seed>;

struct Instant {
    std::string label = "uncertain";
    double gap = 0;
    std::vector<Elements> stuck;  // where uncertain: neither apart nor shown to share a point
    Tree tree;
    Common common;
};

struct Proof {
    std::string label = "uncertain", reason, start = "uncertain";
    double t_lo = 0, t_hi = 0, gap = 0, depth = 0;
    Tree tree;
    Common common;
    Instant end;
    std::vector<Elements> stuck;
};

inline std::string digits(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
}

class Prover {
  public:
    Prover(const Pair& pair, const Solid& A, const Solid& B, double limit, Seeds seeds = {})
        : A_(A), B_(B), seeds_(std::move(seeds)), sd_(pair), sq_(pair), ra_(A.nodes.size()), rb_(B.nodes.size()) {
        effort_.limit = limit;
        blur_ = quick(0, 0).blur();
    }
    const Effort& effort() const { return effort_; }

    // Depth at t, an estimate: of the deepest of the overlapping pieces. With a mesh: the diameter of the largest ball found
    // inside both, growing from the common point.
    double depth_at(double t, const Common& common) {
        if (A_.mesh || B_.mesh) return ball(t, common);
        double deepest = 0;
        deepen(0, 0, t, deepest);
        return deepest;
    }

    Instant at(double t) {
        Instant out;
        attempts_ = 0;
        if (single() && !A_.mesh && !B_.mesh) {
            if (!settle(quick(0, 0), t, out) && !settle_near(t, out)) {
                Exact e(*this, 0, 0);
                if (!settle(e.placed, t, out)) untouched(t, out);
            }
            return out;
        }
        double apart = 1e300;
        bool found = false;
        nearest(0, 0, t, apart, &out.common, &found);
        if (found) {
            out.label = "hit";
            return out;
        }
        if (apart > 1e3 * blur_)
            for (double share : {0.99, 0.5}) {
                Cover c = cover(t, t, share * apart, nullptr);
                if (!c.stuck.empty()) continue;
                out.label = contained(t, out.common) ? "hit" : "clear";
                out.gap = share * apart, out.tree = std::move(c.tree);
                return out;
            }
        Cover c = cover(t, t, 0, &out.common);
        if (c.found)
            out.label = "hit";
        else if (c.stuck.empty()) {
            out.label = contained(t, out.common) ? "hit" : "clear";
            out.tree = std::move(c.tree);
        } else if (anywhere(t, out.common))
            out.label = "hit";
        else
            out.stuck = elements(c);
        return out;
    }

    Proof sweep() {
        Proof p;
        Instant start = at(0);
        p.start = start.label;
        if (start.label == "hit") {
            p.label = "hit", p.common = start.common;
            finish(p);
            return p;
        }
        if (start.label == "uncertain") {
            p.reason = why("touching at the start"), p.stuck = start.stuck;
            return p;
        }
        Cover c = cover(0, 1, 0, nullptr);
        if (effort_.spent()) {
            p.reason = why("");
            return p;
        }
        p.tree = std::move(c.tree);
        if (c.stuck.empty()) {
            p.label = "clear";
            widen(p, c);
            return p;
        }
        p.t_lo = c.until;
        for (double rel : {2e-13, 6e-13, 1e-11, 1e-9, 1e-6, 1e-4, 1e-2, 1.0}) {
            if (rel > 1e-6 && p.t_lo * rel > 1e-12) break;
            p.t_hi = p.t_lo > 0 ? std::min(1.0, p.t_lo * (1 + rel)) : 1e-12 * rel;  // 0: they touch at the start
            if (!(p.t_hi > p.t_lo)) break;
            if (!meets_at(p.t_hi, c, p.common)) continue;
            p.label = "hit";
            finish(p);
            return p;
        }
        p.reason = why("touching without overlap that could be certified, at t = " + digits(p.t_lo));
        p.stuck = elements(c);
        return p;
    }

  private:
    void finish(Proof& p) {
        p.end = at(1);
        // Deepest of instants at growing distances from the impact (a thin wall is crossed in a small part of the step).
        const bool meshes = A_.mesh || B_.mesh;
        auto depth_of = [&](double t) {
            Instant there;
            if (meshes) there = at(t);
            return !meshes || there.label == "hit" ? depth_at(t, there.common) : 0.0;
        };
        p.depth = depth_at(p.t_hi, p.common);
        double best = p.t_hi, ratio = meshes ? 0.03 : 0.2, rest = 1 - p.t_hi;
        for (double f = 1; f > 1e-11 && p.t_hi + f * rest > p.t_hi; f *= ratio) {
            double d = depth_of(p.t_hi + f * rest);
            if (d > p.depth) p.depth = d, best = p.t_hi + f * rest;
        }
        double lo = p.t_hi + (best - p.t_hi) * ratio, hi = std::min(1.0, p.t_hi + (best - p.t_hi) / ratio);
        for (int i = 1; i < (meshes ? 3 : 9) && hi > lo; ++i)
            p.depth = std::max(p.depth, depth_of(lo + (hi - lo) * i / (meshes ? 3 : 9)));
    }
    struct Stuck {
        int a, b;
        double t;
    };
    struct Cover {
        Tree tree;
        std::vector<Stuck> stuck;
        double until = 1, least = 1e300, at = 0;
        bool found = false;
    };
    struct Exact {  // one pair of tree nodes in double-double
        Moving<dd> a, b;
        Placed<dd> placed;
        Exact(const Prover& p, int na, int nb)
            : a{p.of_a<dd>(p.sq_, p.A_.nodes[na].v), {}},
              b{p.of_b<dd>(p.sq_, p.B_.nodes[nb].v), {}},
              placed(p.sq_, a, b, p.reach(na, nb)) {}
    };

    const Solid &A_, &B_;
    const Seeds seeds_;
    Scene<double> sd_;
    Scene<dd> sq_;
    double blur_;
    mat<double> pose_a_, pose_b_;
    double posed_ = -1;
    int attempts_ = 0;  // pairs of elements in which a common point was sought and not found, at one instant
    Effort effort_;
    std::vector<Moving<double>> ra_, rb_;

    bool single() const { return A_.elements.size() == 1 && B_.elements.size() == 1; }
    std::string why(std::string otherwise) const {
        return effort_.spent() ? "the effort limit of " + std::to_string((long long)effort_.limit) + " vertex visits ran out"
                               : otherwise;
    }
    double reach(int na, int nb) const {
        return A_.nodes[na].far + B_.nodes[nb].far + norm(sd_.about_a) + norm(sd_.about_b) + norm(sd_.dp) + norm(sd_.d);
    }
    Placed<double> quick(int na, int nb) {
        if (ra_[na].r.empty()) ra_[na].r = of_a(sd_, A_.nodes[na].v);
        if (rb_[nb].r.empty()) rb_[nb].r = of_b(sd_, B_.nodes[nb].v);
        return {sd_, ra_[na], rb_[nb], reach(na, nb)};
    }
    template <class T>
    static Points<T> of_a(const Scene<T>& s, const Vertices& v) {
        return turned(s.RA, s.about_a, v);
    }
    template <class T>
    static Points<T> of_b(const Scene<T>& s, const Vertices& v) {
        return turned(s.RB, s.about_b, v);
    }
    Elements elements(int na, int nb) const { return {A_.order[A_.nodes[na].lo], B_.order[B_.nodes[nb].lo]}; }
    std::vector<Elements> elements(const Cover& c) const {
        std::vector<Elements> found;
        for (auto& s : c.stuck) found.push_back(elements(s.a, s.b));
        return found;
    }
    const Seed* seed(int na, int nb) const {
        auto at = seeds_.empty() ? seeds_.end() : seeds_.find(elements(na, nb));
        return at == seeds_.end() ? nullptr : &at->second;
    }
    static Segment planted(const Seed& s, double end) { return {end, 'S', wide(vec<double>{double(s.number), 0, 0})}; }
    // Two single elements that touch at t, with a seed there; else they are stuck.
    void untouched(double t, Instant& out) const {
        auto s = seed(0, 0);
        if (s && t <= s->end) {
            out.label = "clear";
            out.tree.nodes.push_back({{planted(*s, t)}});
        } else
            out.stuck = {elements(0, 0)};
    }
    bool leaf_pair(int na, int nb) const { return A_.nodes[na].left < 0 && B_.nodes[nb].left < 0; }

    // The vertices of one pair of elements that lie near the contact, in double-double: a tenth of the work of all of them.
    struct Near {
        std::vector<int> ids_a, ids_b;
        Moving<dd> a, b;
        std::optional<Placed<dd>> placed;
        Near(Prover& p, int na, int nb, double t) {
            auto P = p.quick(na, nb);
            const auto &x = P.a(t), &y = P.b(t);
            auto shrunk = [](const Points<double>& q) {
                vec<double> m;
                for (auto& v : q) m = m + v;
                m = m * (1.0 / double(q.size()));
                Points<double> out(q);
                for (auto& v : out) v = v + (m - v) * 1e-3;
                return out;
            };
            auto sa = shrunk(x), sb = shrunk(y);
            auto g = gjk<double>(sa, sb, sb[0] - sa[0], P.reach, 1e-6);
            if (g.status != Status::Apart) return;
            ids_a = ends(x, g.v), ids_b = ends(y, -g.v);
            a.r = of_a(p.sq_, pick(p.A_.nodes[na].v, ids_a)), b.r = of_b(p.sq_, pick(p.B_.nodes[nb].v, ids_b));
            placed.emplace(p.sq_, a, b, P.reach);
        }
        static std::vector<int> ends(const Points<double>& p, vec<double> n) {  // near the support along n, and six all around
            std::vector<int> ids;
            double top = dot(n, p[support(p, n)]), range = top + dot(-n, p[support(p, -n)]);
            for (int i = 0; i < int(p.size()); ++i)
                if (dot(n, p[i]) > top - 4e-3 * range) ids.push_back(i);
            for (vec<double> u : {vec<double>{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, -n})
                ids.push_back(support(p, u));
            std::sort(ids.begin(), ids.end());
            ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
            return ids;
        }
        static Vertices pick(const Vertices& v, const std::vector<int>& ids) {
            Vertices out;
            for (int i : ids) out.push_back(v[i]);
            return out;
        }
    };
    bool settle_near(double t, Instant& out) {
        if (A_.nodes[0].v.size() + B_.nodes[0].v.size() < 24) return false;
        Near near(*this, 0, 0, t);
        Instant found;
        if (!near.placed || !settle(*near.placed, t, found)) return false;
        if (found.label == "hit")
            for (int i = 0; i < 4; ++i)
                found.common.a[i] = near.ids_a[found.common.a[i]], found.common.b[i] = near.ids_b[found.common.b[i]];
        else {
            Exact e(*this, 0, 0);
            auto n = unwide(found.tree.nodes[0].segments[0].n);
            double sure = width(e.placed, t, n) / double(norm(n)) - e.placed.blur();
            if (!(sure > 32 * e.placed.blur())) return false;
            found.gap = claimed(sure);
        }
        out = found;
        return true;
    }

    // A gap a little below the certain one, so that the checker's doubles can agree: they err more than ours.
    double claimed(double sure) const {
        double low = sure - 48 * blur_;
        return std::min(low > 0.99 * sure ? low : sure, sure * (1 - 1e-9));
    }
    template <class T>
    bool settle(Placed<T>&& P, double t, Instant& out) {
        return settle(P, t, out);
    }
    template <class T>
    bool settle(Placed<T>& P, double t, Instant& out) {  // one convex pair
        const auto &x = P.a(t), &y = P.b(t);
        auto g = gjk<T>(x, y, y[0] - x[0], P.reach, 1e-9);
        if (g.status == Status::Apart) {
            double gap = double(norm(g.v));
            auto n = g.v * T(1 / gap);
            double trust = 32 * P.blur();
            if (!(gap > trust) || !leaf(P, t, t, 'W', n, T(0.5 * trust))) return false;
            double sure = width(P, t, n) / double(norm(n)) - P.blur();
            out.label = "clear", out.gap = claimed(sure);
            out.tree.nodes.push_back({{{t, 'W', wide(n)}}});
            return true;
        }
        auto w = inside<T>(x, y, P.reach);
        if (!w) return false;
        out.label = "hit", out.common = {w->point, 0, 0, w->a, w->b};
        return true;
    }
    template <class T>
    static double width(Placed<T>& P, double t, vec<T> n) {  // |n| times the distance along n
        const auto &x = P.a(t), &y = P.b(t);
        return double(dot(n, y[support(y, -n)]) - dot(n, x[support(x, n)]));
    }

    // Lower bound on the distance of two groups: their bounding spheres, and the sphere of each against the box of the other.
    double sphere_gap(int na, int nb, double t) {
        if (t != posed_) {
            pose_a_ = sd_.a.at(t) * sd_.RA, pose_b_ = sd_.b.at(t) * sd_.RB;
            posed_ = t;
        }
        auto &a = A_.nodes[na], &b = B_.nodes[nb];
        auto shift = sd_.d * t;
        vec<double> x = pose_a_ * (vector<double>(a.centre) - sd_.about_a) + shift;
        vec<double> y = pose_b_ * (vector<double>(b.centre) - sd_.about_b) + sd_.dp;
        double spheres = norm(x - y) - a.radius - b.radius;
        double boxes =
            std::max(outside(a, transposed(pose_a_, y - shift) + sd_.about_a) - b.radius,
                     outside(b, transposed(pose_b_, x - sd_.dp) + sd_.about_b) - a.radius);
        return std::max(spheres, boxes);
    }
    bool split_a(int na, int nb) const {
        if (A_.nodes[na].left < 0) return false;
        return B_.nodes[nb].left < 0 || A_.nodes[na].radius >= B_.nodes[nb].radius;
    }

    // The largest ball inside both, from a common point: away from the nearer surface to half way between the two, and some luck.
    double ball(double t, const Common& c) {
        vec<dd> x = unwide(c.point);
        vec<double> away_a, away_b;
        const auto turn_a = sd_.a.at(t) * sd_.RA, turn_b = sd_.b.at(t) * sd_.RB;
        auto room = [&](vec<dd> y, double& ra, double& rb) {
            effort_.done += 200;
            ra = A_.room(in_a(y, t), away_a), rb = B_.room(in_b(y, t), away_b);
            away_a = turn_a * away_a, away_b = turn_b * away_b;
            return std::min(ra, rb);
        };
        unsigned long long seed = 11;
        auto draw = [&] {
            return double((seed = seed * 6364136223846793005ULL + 1442695040888963407ULL) >> 33) / 2147483648.0 - 0.5;
        };
        double ra, rb, r = room(x, ra, rb), step = r;
        vec<double> to_a = away_a, to_b = away_b;
        for (int i = 0; i < 20 && step > 3e-2 * r && !effort_.spent(); ++i) {
            vec<double> u;
            if (i % 3 == 0)
                u = (to_a + to_b) * (std::min(step, 0.9 * r) / std::max(norm(to_a + to_b), 1e-3));
            else if (i % 3 == 1)
                u = ra < rb ? to_a * std::min(0.5 * (rb - ra) + 0.1 * step, 0.9 * r)
                            : to_b * std::min(0.5 * (ra - rb) + 0.1 * step, 0.9 * r);
            else {
                u = {draw(), draw(), draw()};
                u = u *
                    (std::min(step, 0.9 * r) / std::max(norm(u), 1e-3));  // never out of the ball: the next centre is inside too
            }
            vec<dd> y = x + vec<dd>{dd(u.x), dd(u.y), dd(u.z)};
            double qa, qb, q = room(y, qa, qb);
            if (q > r)
                x = y, r = q, ra = qa, rb = qb, to_a = away_a, to_b = away_b, step = std::min(2 * step, r);
            else if (i % 3 == 2)
                step *= 0.6;
        }
        return 2 * r;
    }
    void deepen(int na, int nb, double t, double& deepest) {
        if (effort_.spent() || 1e3 * blur_ - sphere_gap(na, nb, t) <= deepest) return;
        auto P = quick(na, nb);
        const auto &x = P.a(t), &y = P.b(t);
        effort_.done += double(P.size());
        if (leaf_pair(na, nb)) {
            double d = depth(x, y, P.reach, effort_);
            if (d < 1e-9 * P.reach) {
                Near near(*this, na, nb, t);
                if (near.placed) d = depth(near.placed->a(t), near.placed->b(t), P.reach, effort_);
                if (!(d > 0)) {
                    Exact e(*this, na, nb);
                    d = depth(e.placed.a(t), e.placed.b(t), P.reach, effort_);
                }
            }
            deepest = std::max(deepest, d);
            return;
        }
        if (gjk<double>(x, y, y[0] - x[0], P.reach, 1e-3).status == Status::Apart) return;
        auto [c1, c2] = children(na, nb, t);
        deepen(c1.first, c1.second, t, deepest);
        deepen(c2.first, c2.second, t, deepest);
    }

    // Distance at t between the elements, in double; 0 where a pair meets.
    double distance(double t) {
        double best = 1e300;
        nearest(0, 0, t, best);
        return best;
    }
    void nearest(int na, int nb, double t, double& best, Common* common = nullptr, bool* found = nullptr) {
        if (effort_.spent() || sphere_gap(na, nb, t) >= best) return;
        if (best <= 0 && (!common || *found || attempts_ > 8)) return;
        double big = double(A_.nodes[na].v.size() + B_.nodes[nb].v.size());
        if (leaf_pair(na, nb) || (best < 1e300 && (big <= 48 || sphere_gap(na, nb, t) > 0))) {
            auto P = quick(na, nb);
            effort_.done += double(P.size());
            const auto &x = P.a(t), &y = P.b(t);
            auto g = gjk<double>(x, y, y[0] - x[0], P.reach, 1e-6);
            double d = g.status == Status::Apart ? norm(g.v) : 0;
            if (d >= best) return;
            if (leaf_pair(na, nb)) {
                best = d;
                if (d <= 0 && common) *found = crossing(na, nb, t, *common);
                return;
            }
        }
        auto [c1, c2] = children(na, nb, t);
        nearest(c1.first, c1.second, t, best, common, found);
        nearest(c2.first, c2.second, t, best, common, found);
    }
    std::pair<std::pair<int, int>, std::pair<int, int>> children(int na, int nb, double t) {  // nearer first
        std::pair<int, int> c1{na, nb}, c2{na, nb};
        if (split_a(na, nb))
            c1.first = A_.nodes[na].left, c2.first = A_.nodes[na].right;
        else
            c1.second = B_.nodes[nb].left, c2.second = B_.nodes[nb].right;
        if (sphere_gap(c2.first, c2.second, t) < sphere_gap(c1.first, c1.second, t)) std::swap(c1, c2);
        return {c1, c2};
    }

    // A tree of planes that keeps all elements apart by `margin` from s until `end`, or until the first pair gets stuck. With
    // `common` (an instant): stop as soon as a stuck pair yields a common interior point.
    Cover cover(double s, double end, double margin, Common* common) {
        Cover c;
        c.until = end;
        c.tree.nodes.reserve(64);
        extend(c, 0, 0, s, margin, common);
        return c;
    }
    int extend(Cover& c, int na, int nb, double s, double margin, Common* common) {
        int id = int(c.tree.nodes.size());
        c.tree.nodes.emplace_back();
        std::vector<Segment> segments;
        bool instant = s >= c.until, last = leaf_pair(na, nb);
        double from = s;
        if (auto sown = last && margin == 0 ? seed(na, nb) : nullptr; sown && s <= sown->end) {
            const double to = instant ? s : sown->end;
            segments.push_back(planted(*sown, to));
            if (instant || to >= c.until) {
                c.tree.nodes[id].segments = std::move(segments);
                return id;
            }
            s = to;
        }
        auto P = quick(na, nb);
        bool done = !instant && !sd_.turns() && straight(P, s, c.until, margin, segments);
        if (!done) {
            double floor = (last ? 1e4 : 64) * P.blur();
            March m = march(P, s, c.until, margin, floor, last ? 0 : 0.03 * (c.until - s), effort_, segments);
            if (m.least < c.least) c.least = m.least, c.at = m.at;
            done = m.done;
            s = m.t;
        }
        if (!done && last) {
            Exact e(*this, na, nb);
            March m = march(e.placed, s, c.until, margin, 1e3 * e.placed.blur(), 0, effort_, segments);
            if (m.least < c.least) c.least = m.least, c.at = m.at;
            if (!sd_.turns() && segments.size() > 1 && segments[0].frame != 'S' && leaf(e.placed, from, m.t, 'W', unwide(segments.back().n), dd(margin)))
                segments = {segments.back()};
            if (!m.done) {
                c.until = m.t;
                c.stuck.push_back({na, nb, m.t});
                if (common && crossing(na, nb, m.t, *common)) c.found = true;
            }
        }
        c.tree.nodes[id].segments = std::move(segments);
        if (done || last || c.found || effort_.spent()) return id;
        if (!instant && s >= c.until) return id;
        auto [c1, c2] = children(na, nb, s);
        bool on_a = c1.first != na || c2.first != na;
        bool swapped = on_a ? c1.first != A_.nodes[na].left : c1.second != B_.nodes[nb].left;
        int first = extend(c, c1.first, c1.second, s, margin, common);
        if (c.found || (margin > 0 && !c.stuck.empty())) return id;
        int second = extend(c, c2.first, c2.second, s, margin, common);
        auto& node = c.tree.nodes[id];
        node.side = on_a ? 'a' : 'b';
        node.cut = on_a ? A_.nodes[A_.nodes[na].left].hi : B_.nodes[B_.nodes[nb].left].hi;
        node.left = swapped ? second : first, node.right = swapped ? first : second;
        return id;
    }
    // Translation: one plane for all of [s, end], if the swept hull of A's group is apart from B's.
    bool straight(Placed<double>& P, double s, double end, double margin, std::vector<Segment>& out) {
        Points<double> both = P.a(s);
        const auto &e = P.a(end), &b = P.b(s);
        both.insert(both.end(), e.begin(), e.end());
        effort_.done += double(both.size() + b.size());
        auto g = gjk<double>(both, b, b[0] - both[0], P.reach, 1e-9);
        if (g.status != Status::Apart) return false;
        double gap = norm(g.v);
        if (!(gap > 64 * P.blur() + margin)) return false;
        auto n = g.v * (1 / gap);
        if (!leaf(P, s, end, 'W', n, margin)) return false;
        out.push_back({end, 'W', wide(n)});
        return true;
    }

    bool meets_at(double t, const Cover& c, Common& common) {
        for (auto it = c.stuck.rbegin(); it != c.stuck.rend() && it - c.stuck.rbegin() < 8; ++it)
            if (crossing(it->a, it->b, t, common)) return true;
        if (single() && !A_.mesh && !B_.mesh) return false;
        attempts_ = 0;
        return cover(t, t, 0, &common).found || anywhere(t, common);
    }

    // A point of the crossing of two elements, moved into the solid where an element is only a triangle of its surface.
    bool crossing(int na, int nb, double t, Common& out) {
        if (attempts_++ > 48) return false;
        if (!A_.mesh && !B_.mesh) {
            auto P = quick(na, nb);
            auto w = inside<double>(P.a(t), P.b(t), P.reach);
            if (!w) {
                Exact e(*this, na, nb);
                w = inside<dd>(e.placed.a(t), e.placed.b(t), e.placed.reach);
            }
            if (!w) return false;
            out = {w->point, A_.order[A_.nodes[na].lo], B_.order[B_.nodes[nb].lo], w->a, w->b};
            return true;
        }
        Exact e(*this, na, nb);
        const auto &x = e.placed.a(t), &b = e.placed.b(t);
        vec<dd> inward;
        if (A_.mesh) inward = inward - unit(cross(x[1] - x[0], x[2] - x[0]));
        if (B_.mesh) inward = inward - unit(cross(b[1] - b[0], b[2] - b[0]));
        if (!(norm(inward) > dd(1e-20))) return false;
        double reach = e.placed.reach;
        for (auto& y : shared(na, nb, t, x, b, reach))
            for (double depth = 0.03 * std::min(A_.size, B_.size); depth > 1e-27 * reach; depth *= 0.02) {
                if (!holds(y + inward * dd(depth), t, out)) continue;
                double inner = depth, outer = 50 * depth;  // half way through what both share: where the ball is to grow
                for (int i = 0; i < 6; ++i) {
                    double half = std::sqrt(inner * outer);
                    (holds(y + inward * dd(half), t, out) ? inner : outer) = half;
                }
                holds(y + inward * dd(0.5 * inner), t, out);
                return true;
            }
        return false;
    }
    static vec<dd> unit(vec<dd> v) {
        dd l = norm(v);
        return l > dd(0) ? v * (dd(1) / l) : v;
    }
    // Points common to two hulls and in the relative interior of both, if they cross.
    std::vector<vec<dd>> shared(int na, int nb, double t, const Points<dd>& A, const Points<dd>& B, double reach) {
        std::vector<vec<dd>> found;
        auto P = quick(na, nb);
        for (auto& y : crossings<double>(P.a(t), P.b(t), reach, 1e-6)) found.push_back({dd(y.x), dd(y.y), dd(y.z)});
        return found.empty() ? crossings<dd>(A, B, reach, 1e-25) : found;
    }
    template <class T>
    std::vector<vec<T>> crossings(const Points<T>& A, const Points<T>& B, double reach, double least) {
        unsigned long long seed = 7;
        auto draw = [&] {
            return 0.25 + double((seed = seed * 6364136223846793005ULL + 1442695040888963407ULL) >> 33) / 4294967296.0;
        };
        auto shrink = [&](const Points<T>& p, double eps) {
            vec<T> m;
            double total = 0;
            for (auto& v : p) {
                double w = draw();
                m = m + v * T(w), total += w;
            }
            m = m * (T(1) / T(total));
            Points<T> out(p);
            for (auto& v : out) v = v + (m - v) * T(eps);
            return out;
        };
        std::vector<vec<T>> found;
        for (double eps = 0.5; eps > least && found.empty(); eps *= eps > 0.06 ? 0.25 : 0.03)
            for (int attempt = 0; attempt < 2; ++attempt) {
                auto a = shrink(A, eps), b = shrink(B, eps);
                effort_.done += (std::is_same_v<T, double> ? 1.0 : 20.0) * double(a.size() + b.size());
                auto g = gjk<T>(a, b, b[0] - a[0], reach, 1e-3);
                if (g.status == Status::Apart) break;
                if (g.status != Status::Meet) continue;
                vec<T> y;
                for (int i = 0; i < 4; ++i) y = y + b[g.s[i].b] * g.w[i];
                found.push_back(y);
            }
        return found;
    }

    // Is x (relative to p_A, world axes) strictly inside both at time t? Fills `out` if so.
    bool holds(vec<dd> x, double t, Common& out) {
        vec<dd> ya = in_a(x, t), yb = in_b(x, t);
        Common c;
        c.point = wide(x);
        if (!within(A_, ya, c.piece_a, c.a) || !within(B_, yb, c.piece_b, c.b)) return false;
        out = c;
        return true;
    }
    bool within(const Solid& s, vec<dd> y, int& piece, std::array<int, 4>& ids) {
        if (s.mesh) {
            effort_.done += double(s.faces.size());
            auto w = s.winding(y);
            return w && *w != 0;
        }
        for (size_t i = 0; i < s.elements.size(); ++i)
            if (tetrahedron(s.elements[i], y, ids)) {
                piece = int(i);
                return true;
            }
        return false;
    }
    bool tetrahedron(const Vertices& element, vec<dd> y, std::array<int, 4>& ids) {
        Points<double> p, o(1, vec<double>{double(y.x), double(y.y), double(y.z)});
        for (auto& v : element) p.push_back({v[0], v[1], v[2]});
        double reach = largest(p) + norm(o[0]);
        effort_.done += double(p.size());
        auto g = gjk<double>(o, p, p[0] - o[0], reach, 1e-3);
        if (g.status == Status::Apart && norm(g.v) > 1e-12 * reach) return false;
        if (g.status == Status::Meet && *std::min_element(g.w.begin(), g.w.end()) > 1e-9) {
            for (int i = 0; i < 4; ++i) ids[i] = g.s[i].b;
            return true;
        }
        Points<dd> q, oq(1, y);
        for (auto& v : element) q.push_back({dd(v[0]), dd(v[1]), dd(v[2])});
        effort_.done += 20.0 * double(p.size());
        auto gq = gjk<dd>(oq, q, q[0] - y, reach, 1e-3);
        if (gq.status != Status::Meet) return false;
        for (int i = 0; i < 4; ++i) ids[i] = gq.s[i].b;
        return true;
    }

    // Surfaces are apart at t: is one inside the other? Then a point of the inner one is common to both.
    bool contained(double t, Common& out) { return (B_.mesh || A_.mesh) && probes(t, out, true); }
    // Surfaces are not shown apart, and no crossing gave a point (coincident faces): look below the surface of both.
    bool anywhere(double t, Common& out) { return probes(t, out, false); }

    bool probes(double t, Common& out, bool parts_only) {
        for (int side = 0; side < 2; ++side) {
            const Solid& s = side ? B_ : A_;
            size_t count = parts_only ? s.part.size() : s.elements.size();
            size_t stride = parts_only ? 1 : std::max<size_t>(1, count / 64);
            for (size_t i = 0; i < count && !effort_.spent(); i += stride) {
                int id = parts_only ? s.part[i] : int(i);
                auto& e = s.elements[id];
                vec<dd> m, n;
                Points<dd> p;
                for (auto& v : e) p.push_back({dd(v[0]), dd(v[1]), dd(v[2])});
                double total = 0;
                for (size_t j = 0; j < p.size(); ++j) {
                    double w = 1 + 0.37 * double((j * 7 + size_t(id) * 3) % 11) / 11;
                    m = m + p[j] * dd(w), total += w;
                }
                m = m * (dd(1) / dd(total));
                if (parts_only && !sees(side ? A_ : B_, side, m, t)) continue;
                if (s.mesh) n = unit(cross(p[1] - p[0], p[2] - p[0]));
                for (double depth = s.mesh ? 0.05 * std::min(A_.size, B_.size) : 0;; depth *= 0.02) {
                    if (holds(world(side, m - n * dd(depth), t), t, out)) return true;
                    if (!s.mesh || depth < 1e-18 * s.size || effort_.spent()) break;
                }
            }
        }
        return false;
    }
    // Is point y of side's body inside the other body? Where surfaces are apart, that tells of its whole part.
    bool sees(const Solid& other, int side, vec<dd> y, double t) {
        auto x = world(side, y, t);
        vec<dd> there = side ? in_a(x, t) : in_b(x, t);
        int piece;
        std::array<int, 4> ids;
        return within(other, there, piece, ids);
    }
    vec<dd> world(int side, vec<dd> y, double t) const {
        return side ? sq_.b.at(dd(t)) * (sq_.RB * (y - sq_.about_b)) + sq_.dp
                    : sq_.a.at(dd(t)) * (sq_.RA * (y - sq_.about_a)) + sq_.d * dd(t);
    }
    // A point of the scene at time t, in a body's frame.
    vec<dd> in_a(vec<dd> x, double t) const {
        return transposed(sq_.RA, transposed(sq_.a.at(dd(t)), x - sq_.d * dd(t))) + sq_.about_a;
    }
    vec<dd> in_b(vec<dd> x, double t) const {
        return transposed(sq_.RB, transposed(sq_.b.at(dd(t)), x - sq_.dp)) + sq_.about_b;
    }

    // A clear sweep: prove it again with a margin close to the least distance, which the places where that fails help to find.
    void widen(Proof& p, const Cover& c) {
        if (!sd_.turns() && single()) {
            if (!swept(quick(0, 0), p)) {
                Exact e(*this, 0, 0);
                swept(std::move(e.placed), p);
            }
            return;
        }
        double least = single() ? c.least : 1e300;  // of groups it would be that of their hulls
        const int n = single() ? 16 : 12;
        int best = 0;
        double lowest = 1e300;
        for (int i = 0; i <= n; ++i) {
            double d = distance(double(i) / n);
            if (d < lowest) lowest = d, best = i;
        }
        least = std::min(least, lowest);
        least = std::min(least, dip(double(best) / n, 1.0 / n));
        if (single() && std::abs(c.at - double(best) / n) > 1.0 / n) least = std::min(least, dip(c.at, 1.0 / n));
        for (double share : {0.98, 0.95, 0.95, 0.8, 0.4, 0.1}) {
            if (!(share * least > 64 * blur_)) return;
            Cover again = cover(0, 1, share * least, nullptr);
            if (effort_.spent()) return;
            if (again.stuck.empty()) {
                p.tree = std::move(again.tree), p.gap = share * least;
                return;
            }
            least = std::min(least, dip(again.until, 1.0 / n));
        }
    }
    template <class T>
    bool swept(Placed<T> P, Proof& p) {  // translation of one element: the swept hull's distance and plane
        Points<T> both = P.a(0);
        const auto &e = P.a(1), &b = P.b(0);
        both.insert(both.end(), e.begin(), e.end());
        auto g = gjk<T>(both, b, b[0] - both[0], P.reach, 1e-9);
        if (g.status != Status::Apart) return false;
        auto n = g.v * (T(1) / norm(g.v));
        double gap = double(dot(n, b[support(b, -n)]) - dot(n, both[support(both, n)])) - P.blur();
        if (!(gap > 1e3 * P.blur())) return false;
        p.gap = claimed(gap);
        p.tree = {};
        p.tree.nodes.push_back({{{1.0, 'W', wide(n)}}});
        return true;
    }
    double dip(double t, double width) {  // least distance near t, by golden section
        const double r = 0.6180339887498949;
        double lo = std::max(0.0, t - width), hi = std::min(1.0, t + width), least = distance(t);
        double x = hi - r * (hi - lo), y = lo + r * (hi - lo), fx = distance(x), fy = distance(y);
        for (int i = 0; i < (single() ? 36 : 16); ++i) {
            if (fx < fy)
                hi = y, y = x, fy = fx, x = hi - r * (hi - lo), fx = distance(x);
            else
                lo = x, x = y, fx = fy, y = lo + r * (hi - lo), fy = distance(y);
            least = std::min({least, fx, fy});
        }
        return least;
    }
};

}  // namespace truth
