// The record of one realization, and the sums over realizations (paper, section 5).
//
// observe() reduces one realization to a RealizationRecord: plain numbers and vectors without references, which a checkpoint holds as they
// are. Accumulators::add() takes records in the order of their realizations, whatever thread, rank or interrupted run made them; sums over
// realizations are exact (ExactSum), so that those of two campaigns can be added, too. finish() turns the sums into means, radial
// means and fits.
#pragma once

#include "contact/level.hpp"
#include "observe/distributions.hpp"
#include "observe/map.hpp"
#include "rough/spectrum.hpp"

namespace rsc {

struct ObserveOptions {
    double tip_x = 0, tip_y = 0;  // centre of the radial means [length]
    MapGrid map;
    int radial_bins = 50;
    std::vector<double> pdf_levels;  // separations whose nearest level gives the distributions [length]
    PdfBins pdf;
};

// The surface of a realization; NaN is absent (asperities read from a file have no m2, say).
struct SurfaceStatistics {
    double sigma = kAbsent;             // rms height [length]
    double m2 = kAbsent, m4 = kAbsent;  // profile moments from the modes drawn (synthetic) or the grid (measured)
    MomentTensor tensor{kAbsent, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent};  // the same by direction
    double skewness = kAbsent, kurtosis = kAbsent;                                                // of made heights that are not Gaussian
    double m2_grid = kAbsent, m4_grid = kAbsent;                                                  // from finite differences
    double mean_kappa_g = kAbsent, mean_kappa_a = kAbsent;  // means of the summits' curvatures [1/length]
    std::int64_t summits = 0, saddles = 0;
};

struct RealizationRecord {
    std::int64_t realization = 1;
    SurfaceStatistics surface;
    std::vector<LevelValues> levels;
    std::vector<MapLevel> maps;                // one a level; empty where it did not converge, as are distributions
    std::vector<Distributions> distributions;  // one a pdf level
};

// Observes the levels of one realization. Throws Error(internal) if a level holds a value that is not finite.
RealizationRecord observe(const ObserveOptions& options, std::int64_t realization, const SurfaceStatistics& surface,
                          const std::vector<Level>& levels);

// The level whose separation is nearest to the wanted one; of two equally near the first. -1 if there is none.
std::int32_t nearest_level(const std::vector<Level>& levels, double separation);

struct Observations;

// Sums over realizations. Copyable and plain: a campaign writes it to its checkpoint as it is.
struct Accumulators {
    ObserveOptions options;
    std::size_t steps = 0;
    std::vector<std::int64_t> realization;
    std::vector<SurfaceStatistics> surface;
    std::vector<LevelValues> rows;                // [realization][step]
    std::vector<ExactSum> map_area, map_force;    // [step][cell], sums over realizations [length^2], [force]
    std::vector<DistributionSums> distributions;  // [pdf level]

    Accumulators() = default;
    Accumulators(const ObserveOptions& options, std::size_t steps);
    // Records come in increasing order of their realization; another order throws Error(internal), as does another number of
    // levels.
    void add(const RealizationRecord& record);
    // Appends the sums over later realizations of the same case: they are then, bit for bit, those of adding all records one by one.
    void append(const Accumulators& later);
    std::vector<std::int32_t> converged() const;  // realizations whose level converged, for each step
    Observations finish() const;
};

// A level's quantity over the M realizations that converged and have it, a value a step: mean (NaN where there is none), deviation of the
// sample (divisor M - 1; NaN for one) and standard error of the mean, deviation/sqrt(M).
struct LevelStatistics {
    std::vector<double> mean, deviation, error;
    std::vector<std::int32_t> count;  // M
};

// Means and statistics over the realizations added.
struct Observations {
    ObserveOptions options;
    std::size_t realizations = 0, steps = 0;
    std::vector<std::int64_t> realization;
    std::vector<SurfaceStatistics> surface;  // [realization]
    std::vector<LevelValues> rows;           // [realization][step]
    LevelStatistics separation, force, area;
    std::vector<double> map_area_fraction, map_pressure;        // [step][j][i]
    std::vector<double> radii;                                  // middle of the rings [length]
    std::vector<double> radial_area_fraction, radial_pressure;  // [step][radius]
    std::vector<FittedDistributions> distributions;             // [pdf level]
    // Rounding errors of the means above, which restore the exact sums over realizations (map_sums): [step][j][i]
    std::vector<double> map_area_rest, map_force_rest;  // [length^2], [force]
    std::vector<DistributionSums> distribution_sums;    // [pdf level]
    const LevelValues& row(std::size_t k, std::size_t step) const { return rows[k * steps + step]; }
    LevelStatistics statistics(const std::function<double(const LevelValues&)>& of) const;
};

// The sums over realizations that gave these means of a map, from what finish() leaves of them: exactly the same.
std::vector<ExactSum> map_sums(const MapGrid& grid, const std::vector<std::int32_t>& converged, const std::vector<double>& means,
                               const std::vector<double>& rests);

}  // namespace rsc
