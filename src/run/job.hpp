// A prepared case, with all that is read, computed and checked once, and the run of one realization.
#pragma once

#include "case/case.hpp"
#include "contact/contact.hpp"
#include "contact/contact_curve.hpp"
#include "file/result.hpp"
#include "observe/record.hpp"
#include "rough/asperities.hpp"
#include "run/prepare.hpp"

namespace rsc {

struct Job {
    Case settings;
    SurfaceDomain domain;
    Indenter indenter;
    SolverOptions solver;
    double sigma = 0;                  // the length unit='sigma' and delta0 mean
    std::vector<double> levels;        // separations [length], or forces [force] with control='force' or 'pressure'
    double level_unit = 1;             // what 1 of the case's levels is of them
    std::optional<Spectrum> spectrum;  // of a synthetic surface
    std::optional<Moments> theory;     // its moments
    ObserveOptions observe;
    // The surface that was read, if it is the same in every realization.
    std::optional<SurfaceModel> given;
    std::shared_ptr<const Measured> measured;                        // of a measured map, the first of several
    double points_touch = -std::numeric_limits<double>::infinity();  // of a map read, by asperities: Z0 at which one of its points touches
    double seam = 0;                         // of a map that is to repeat: its jump across the border over those between points
    std::optional<HeightMap> given_heights;  // if the case, or its elements, want them
};

// Reads what the case names, works out levels, domain and ranges. Throws Error(bad_input) for what cannot be run.
Job prepare(const Case& settings);

// One realization: its surface, its asperities, its levels.
struct Realization {
    SurfaceStatistics statistics;
    Asperities asperities;
    std::vector<Level> levels;
    FrictionLoops friction;
    std::vector<double> residual_depth;  // of the asperities that yielded, after the last level; empty: none can
    ResidualProfile residual_profile;    // of elements that yielded, likewise
    std::optional<HeightMap> heights;    // if the case wants them
};

// Realization `number` of the case. `on_level` is called after each level with its number; returning false stops the run there.
// `threads` may work on the surface; the answer does not depend on it.
Realization realize(const Job& job, std::int64_t number, int threads, const std::function<bool(std::size_t, const Level&)>& on_level = {});

RealizationRecord observe(const Job& job, std::int64_t number, const Realization& realization);

// The friction of a run's levels: what a contact held at each separation answers to a slide.

// Adds the loops of a level. `one` and `other` are contacts of their own, like the one that found the level: its path is not disturbed.
class FrictionRows {
public:
    FrictionRows(const Friction& friction, std::unique_ptr<Contact> one, std::unique_ptr<Contact> other);
    // Returns false if a level did not converge on the way: the row is then not to be used.
    bool add(const Level& level, FrictionLoops& loops);

private:
    Friction friction_;
    std::unique_ptr<Contact> one_, other_;
    ContactCurve curve_;
};

}  // namespace rsc
