// Record of one realization, and sums over realizations (paper, section 5).
//
// observe() reduces one realization to a RealizationRecord of plain numbers and vectors, which can
// be written to a checkpoint.
// Accumulators::add() adds records in the order of their realizations, independent of the thread,
// rank or run that computed them, so that a campaign that goes on from its checkpoint gives the
// same bits. finish() computes means and radial means.
#pragma once

#include "contact/level.hpp"
#include "observe/distributions.hpp"
#include "observe/map.hpp"
#include "physics/physics.hpp"
#include "surface/spectrum.hpp"

namespace rsc {

struct ObserveOptions {
    double tip_x = 0, tip_y = 0;  // centre of the radial means [length]
    MapGrid map;
    int radial_bins = 50;
    std::vector<double>
        pdf_levels;  // separations at whose nearest levels distributions are computed [length]
    PdfBins pdf;
    std::vector<AskedCurves> curves = {};
};

// Surface of a realization. NaN means absent (for example m2 of asperities read from a file).
struct SurfaceStatistics {
    double sigma = kNotComputed;  // rms height [length]
    // Profile moments from the modes drawn (synthetic) or the grid (measured).
    double m2 = kNotComputed, m4 = kNotComputed;
    MomentTensor tensor{kNotComputed, kNotComputed, kNotComputed, kNotComputed,
                        kNotComputed, kNotComputed, kNotComputed, kNotComputed};  // by direction
    double skewness = kNotComputed, kurtosis = kNotComputed;  // of non-Gaussian synthetic heights
    double m2_grid = kNotComputed, m4_grid = kNotComputed;    // from finite differences
    double mean_kappa_g = kNotComputed,
           mean_kappa_a = kNotComputed;  // means of the summits' curvatures [1/length]
    std::int64_t summits = 0, saddles = 0;
};

// The components of `tensor` by their names in files.
struct MomentComponent {
    const char* name;  // m, power of kx, power of ky
    double MomentTensor::*of;
};
inline constexpr MomentComponent kMomentComponents[] = {
    {"m20", &MomentTensor::m20}, {"m11", &MomentTensor::m11}, {"m02", &MomentTensor::m02},
    {"m40", &MomentTensor::m40}, {"m31", &MomentTensor::m31}, {"m22", &MomentTensor::m22},
    {"m13", &MomentTensor::m13}, {"m04", &MomentTensor::m04}};

struct RealizationRecord {
    std::int64_t realization = 1;
    SurfaceStatistics surface;
    std::vector<LevelValues> levels;
    std::vector<MapLevel>
        maps;  // one per level; empty if it did not converge, as are distributions
    std::vector<Distributions> distributions;  // one per pdf level
    std::vector<double> curves;                // [step], of each as ObserveOptions::curves
};

// Reduces the levels of one realization to a record. Throws Error(internal) if a level holds a
// value that is not finite.
RealizationRecord observe(const ObserveOptions& options, std::int64_t realization,
                          const SurfaceStatistics& surface, const std::vector<Level>& levels,
                          std::vector<double> curves = {});

// Index of the level (its separation, force or pressure) nearest to the requested one, the first of
// those that are equally near but for rounding;
// -1 if there are no levels.
std::int32_t nearest_level(const std::vector<double>& levels, double requested);

struct Observations;

// What is kept of every realization.
struct Realizations {
    ObserveOptions options;
    std::size_t steps = 0;
    std::vector<std::int64_t> realization;
    std::vector<SurfaceStatistics> surface;  // [realization]
    std::vector<LevelValues> rows;           // [realization][step]
    std::vector<double> curves;              // [realization][step], as ObserveOptions::curves
};

// Sums over realizations of a cell of the coarse map.
struct CellSums {
    std::int64_t cell = 0;
    double area = 0, force = 0;  // [length^2], [force]
};

// Sums over realizations, written to the checkpoint of a campaign.
struct Accumulators : Realizations {
    std::vector<std::vector<CellSums>> maps;  // [step], cells with contacts by increasing number
    std::vector<DistributionSums> distributions;  // [pdf level]

    Accumulators() = default;
    Accumulators(const ObserveOptions& options, std::size_t steps);
    // Records must be added by increasing realization and with the same number of levels; otherwise
    // throws Error(internal).
    void add(const RealizationRecord& record);
    // Appends the sums over later realizations of the same case. Within rounding the result is that
    // of adding all records one by one.
    void append(const Accumulators& later);
    std::vector<std::int32_t> converged()
        const;  // number of realizations that converged, for each step
    Observations finish() const;
    // Sets the sums of the maps of a step, within their rounding, from the means (of all cells)
    // that finish() computes.
    void restore_map(std::size_t step, std::span<const double> area_fraction,
                     std::span<const double> pressure);
};

// Statistics of a quantity over the M realizations that converged and have it, for each step: mean
// (NaN if M = 0), sample standard deviation (divisor M - 1; NaN if M = 1) and standard error of the
// mean, deviation/sqrt(M).
struct LevelStatistics {
    std::vector<double> mean, deviation, error;
    std::vector<std::int32_t> count;  // M
};

// Maps of a quantity at all levels, of which only the cells with contacts are stored.
struct SparseMaps {
    std::size_t cells = 0;           // of a map
    std::vector<std::size_t> end;    // [step], where its cells end in the next two
    std::vector<std::int32_t> cell;  // by increasing number
    std::vector<double> value;

    // All cells of a step, those without contacts 0.
    void fill(std::size_t step, std::span<double> map) const;
    bool operator==(const SparseMaps&) const = default;
};

// Means and statistics over the realizations added.
struct Observations : Realizations {
    std::size_t realizations = 0;  // their number
    LevelStatistics separation, force, area;
    SparseMaps map_area_fraction, map_pressure;                 // [step][j][i]
    std::vector<double> radii;                                  // middle of the rings [length]
    std::vector<double> radial_area_fraction, radial_pressure;  // [step][radius]
    std::vector<ShownDistributions> distributions;              // [pdf level]
    std::vector<DistributionSums> distribution_sums;            // [pdf level]
    const LevelValues& row(std::size_t k, std::size_t step) const { return rows[k * steps + step]; }
    LevelStatistics statistics(const std::function<double(const LevelValues&)>& of) const;
};

}  // namespace rsc
