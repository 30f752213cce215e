// experiments.truth._native: the prover's proposals. Nothing here is believed; the checker decides.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "prove.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using namespace truth;

using Array = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

struct Solid {
    std::vector<Vertices> elements;
    explicit Solid(const std::vector<Array>& pieces) {
        for (auto& p : pieces) {
            Vertices v(p.shape(0));
            for (size_t i = 0; i < v.size(); ++i) v[i] = {p(i, 0), p(i, 1), p(i, 2)};
            elements.push_back(std::move(v));
        }
    }
};

static nb::tuple pack(const Wide& w) { return nb::make_tuple(w.hi[0], w.hi[1], w.hi[2], w.lo[0], w.lo[1], w.lo[2]); }
static nb::dict pack(const Inside& in) {
    nb::dict out;
    out["point"] = pack(in.point), out["a"] = in.a, out["b"] = in.b;
    return out;
}

NB_MODULE(_native, m) {
    nb::class_<Solid>(m, "Solid").def(nb::init<std::vector<Array>>());
    nb::class_<Pair>(m, "Pair").def(
        "__init__", [](Pair* self, std::array<double, 4> qa, std::array<double, 3> pa, std::array<double, 4> qb, std::array<double, 3> pb,
                       std::array<double, 3> d, std::array<double, 3> k, double theta) { new (self) Pair{qa, qb, pa, pb, d, k, theta}; });
    m.def("instant", [](const Pair& pair, const Solid& A, const Solid& B, double t) {
        Prover prover(pair, A.elements.at(0), B.elements.at(0));
        Instant i = prover.at(t);
        nb::dict out;
        out["label"] = i.label;
        if (i.label == "clear") out["gap"] = i.gap, out["n"] = pack(i.n);
        if (i.label == "hit") out["inside"] = pack(i.in);
        return out;
    });
    m.def("sweep", [](const Pair& pair, const Solid& A, const Solid& B, int effort) {
        Prover prover(pair, A.elements.at(0), B.elements.at(0));
        Proof p = prover.sweep(effort);
        nb::dict out;
        out["label"] = p.label, out["reason"] = p.reason, out["start"] = p.start, out["steps"] = p.steps;
        out["t_lo"] = p.t_lo, out["t_hi"] = p.t_hi, out["gap"] = p.gap;
        nb::list segments;
        for (auto& s : p.segments) segments.append(nb::make_tuple(s.end, std::string(1, s.frame), pack(s.n)));
        out["segments"] = segments;
        if (p.label == "hit") {
            out["inside"] = pack(p.in);
            out["end"] = p.end.label;
            if (p.end.label == "clear") out["end_n"] = pack(p.end.n);
            if (p.end.label == "hit") out["end_inside"] = pack(p.end.in);
        }
        return out;
    });
}
