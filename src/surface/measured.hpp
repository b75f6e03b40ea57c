// Preparation of a measured map: missing points, form, filter, and the properties of the result.
#pragma once

#include "surface/defects.hpp"
#include "surface/form.hpp"
#include "surface/measured_spectrum.hpp"
#include "surface/profile.hpp"
#include "surface/surface.hpp"

namespace rsc {

enum class Missing { refuse, fill };
inline constexpr std::array kMissingNames = {"refuse", "fill"};

struct MeasureOptions {
    Missing missing = Missing::refuse;
    Detrend detrend = Detrend::plane;
    double filter_cutoff = 0;  // 0: no filter [length]
    double outliers = 0;       // threshold of remove_outliers(); 0: outliers are not removed
    // Of a profile:
    double cutoff_long = 0;            // 0: no filter
    bool by_inversion = false;         // the spectrum of its surface; otherwise self-affine
    double aspect = 1, direction = 0;  // assumed lay of its surface, as in Spectrum
};

// Roughness before and after each step.
struct Roughness {
    double height = 0;     // rms about the mean [length]
    double slope = 0;      // rms gradient
    double curvature = 0;  // sqrt(m4), the rms second derivative of a profile [1/length]
};
Roughness roughness(const HeightMap& map);

// Processing of a measured map, and the properties of the result.
struct Measured : PointGrid {
    std::string channel;         // of the file that the map was read from; empty: it has none
    std::optional<double> code;  // a height, as the file has it, that probably means "no data"
    long coded = 0;              // points that have it
    Moments moments;             // of the treated map, without differences across its border
    long missing = 0;            // points filled
    double outlier_times = 0;    // MeasureOptions::outliers
    Outliers outliers;           // of the points filled
    double missing_share = 0;    // of all points
    // 1 at j*nx + i where a point deep in a hole was filled (keep_depths()); empty: none.
    std::vector<std::uint8_t> filled;
    Form form;
    double filter_cutoff = 0;
    Roughness as_read, without_form, filtered;  // the last two are equal when there is no filter
    HeightParameters parameters;
    double isotropy = 1;
    HeightQuantiles quantiles;
    // Rounding step of the heights [length]; 0: not rounded, or filtered afterwards.
    double height_step = 0;
    Breaks breaks;  // pits, spikes and steps
    // Density of the heights about their mean, in an even number of bins around it [1/length].
    std::vector<double> height_pdf;
    double height_bin = 0;  // their width [length]
    MeasuredSpectrum spectrum;
    std::optional<SelfAffineFit> fit;  // absent if the map is too small or too flat
    // upper end of the direction-averaged spectrum, or twice the grid step [length]
    double shortest_wave = 0;
    // Skewness within 0.3 of 0 and kurtosis within 0.6 of 3, the scatter of Gaussian samples.
    std::shared_ptr<const MeasuredProfile> profile;  // null: a map
    bool gaussian() const;
    double points_per_wave() const;  // grid steps in the shortest wave
};

// Smallest ratio of rms slopes that is regarded as isotropic; it allows for maps of few waves.
inline constexpr double kIsotropic = 0.8;

// With fewer points in the shortest wave, curvatures are determined by the grid or by noise.
inline constexpr double kFewPointsPerWave = 4;

// Subtracts the fitted form, fills missing points (fill_missing) and filters, in place. Throws
// Error(bad_input) if all points are missing, or if any is missing with Missing::refuse (the
// message states the first). A map of one row is a profile: its `spectrum` and `fit` are those of
// the surface that has such profiles, whose wavenumbers are stretched by the assumed lay. Its
// long-wave filter cuts off its ends.
Measured measure(HeightMap& map, const MeasureOptions& options);

// Processing and properties of a map as lines of text; lengths are followed by `length_unit`.
std::vector<std::string> report(const Measured& measured, const std::string& length_unit);

}  // namespace rsc
