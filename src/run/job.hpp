// A prepared case, with everything that is read, computed and checked once, and the run of one
// realization.
#pragma once

#include "case/case.hpp"
#include "contact/path.hpp"
#include "io/result.hpp"
#include "observe/record.hpp"
#include "run/prepare.hpp"
#include "surface/asperities.hpp"

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
    std::optional<HeightMap> given_heights;  // if the case or its elements need them
};

// Reads the inputs of the case, determines levels, domain and ranges. Throws Error(bad_input) if
// the case cannot be run.
Job prepare(const Case& settings);

// One realization: its surface, its asperities, its levels.
struct Realization {
    SurfaceStatistics statistics;
    Asperities asperities;
    std::vector<Level> levels;
    std::vector<double> curves;  // [step], as ObserveOptions::curves
    // Residual depth of the asperities after the last level; empty without hardness.
    std::vector<double> residual_depth;
    ResidualProfile residual_profile;  // of elements that yielded, likewise
    std::optional<HeightMap> heights;  // if requested by the case
    Fields fields;                     // likewise
};

// Levels of elements that do not depend on each other are solved in groups of this many, if there
// are at least kFewestGroups of them; groups whose levels have at most kFewPoints candidates side
// by side, by a contact for each thread.
inline constexpr std::size_t kGroup = 8, kFewestGroups = 4;
inline constexpr std::int32_t kFewPoints = 200000;

// Realization `number` of the case. `on_level` is called with each level and its number, in their
// order. Results do not depend on the number of threads.
Realization realize(const Job& job, std::int64_t number, int threads,
                    const std::function<void(std::size_t, const Level&)>& on_level = {});

}  // namespace rsc
