// A case as a problem: everything that is read, computed and checked once, and for each realization
// its rough body, its contact and the judge of its levels.
#pragma once

#include "case/case.hpp"
#include "contact/path.hpp"
#include "observe/record.hpp"
#include "problem/bodies.hpp"
#include "surface/asperities.hpp"
#include "trust/judge.hpp"

namespace rsc {

struct Job {
    Case settings;
    SurfaceDomain domain;
    Indenter indenter;
    SolverOptions solver;
    double sigma = 0;  // unit of length for unit = 'sigma' and delta0
    std::vector<double>
        levels;  // separations [length], or forces [force] with control='force' or 'pressure'
    std::vector<double> times;         // of the levels; empty: no times
    bool slides = false;               // these are distances of sliding
    double level_unit = 1;             // factor from the levels of the case to `levels`
    std::optional<Spectrum> spectrum;  // of a synthetic surface
    std::optional<Moments> theory;     // its moments
    ObserveOptions observe;
    // The surface from the file, if it is the same in every realization.
    std::optional<SurfaceModel> given;
    std::shared_ptr<const Measured> measured;  // of a measured map, the first of several
    double points_touch = -kInfinity;          // of a map: Z0 at which one of its points touches
    double seam = 0;  // of a periodic map: jump across the border relative to that between points
    // Of the file, of the first of several; null: only summits are known, or each realization has
    // its own.
    std::shared_ptr<const HeightMap> heights;
};

// Reads the inputs of the case, determines levels, domain and ranges. Throws Error(bad_input) if
// the case cannot be run.
Job prepare(const Case& settings);

// The rough body of a realization: its summits, or its heights for elements.
struct RoughBody {
    // Shared with the job if all realizations have the same; of asperities where they are read or
    // asked for. Nobody copies or changes them.
    std::shared_ptr<const HeightMap> heights;
    const HeightMap* map = nullptr;  // these heights, for elements
    Asperities asperities;
    SurfaceStatistics statistics;
    std::shared_ptr<const Measured> measured;
    std::optional<Tensor> curvature;  // JudgedSurface::curvature
    SolverOptions solver;
};

// The body of realization `number`. Results do not depend on the number of threads.
RoughBody rough_body(const Job& job, std::int64_t number, int threads);

// Its contact with the indenter of the job, and the judge of its levels; the body must outlive
// them.
std::unique_ptr<Path> make_contact(const Job& job, const RoughBody& body);
Judge make_judge(const Job& job, const RoughBody& body);

}  // namespace rsc
