// From a measured map to a rough surface: missing points, form, filter, and what is left when they are done (physics, section 11).
#pragma once

#include "rough/breaks.hpp"
#include "rough/form.hpp"
#include "rough/measured_spectrum.hpp"
#include "rough/surface.hpp"
#include "rough/texture.hpp"

namespace rsc {

enum class Missing { refuse, fill };
inline constexpr std::array kMissingNames = {"refuse", "fill"};

struct MeasureOptions {
    Missing missing = Missing::refuse;
    Detrend detrend = Detrend::plane;
    double filter_cutoff = 0;  // 0: no filter [length]
};

// Roughness before and after each step.
struct Roughness {
    double height = 0;     // rms about the mean [length]
    double slope = 0;      // rms gradient
    double curvature = 0;  // sqrt(m4), the rms second derivative of a profile [1/length]
};
Roughness roughness(const HeightMap& map);

// The treatment of a measured map, and its properties afterwards.
struct Measured {
    int nx = 0, ny = 0;
    double dx = 0, dy = 0, x0 = 0, y0 = 0;
    long missing = 0;                  // points filled
    double missing_share = 0;          // of all points
    std::vector<std::uint8_t> filled;  // 1 at j*nx + i where a point was filled; empty if none was
    Form form;
    double filter_cutoff = 0;
    Roughness as_read, without_form, filtered;  // the last two are equal when there is no filter
    HeightParameters parameters;
    double isotropy = 1;
    Texture texture;
    double height_step = 0;          // heights were rounded to multiples of it (rough/rounding.hpp); 0: not, or filtered since [length]
    Breaks breaks;                   // pits, spikes and steps
    std::vector<double> height_pdf;  // density of the heights about their mean, in an even number of bins around it [1/length]
    double height_bin = 0;           // their width [length]
    MeasuredSpectrum spectrum;
    std::optional<SelfAffineFit> fit;  // none for a map too small or too flat for one
    bool gaussian() const;             // skewness within 0.3 of 0, kurtosis within 0.6 of 3: as samples of Gaussian surfaces have them
    double shortest_wave() const;      // 2 pi/ks [length]
    double points_per_wave() const;    // grid steps in the shortest wave
};

// Least ratio of rms slopes that isotropic maps have, those of few waves too.
inline constexpr double kIsotropic = 0.8;

// Fewer points in the shortest wave than this, and the grid, or noise at the pixel, makes the curvatures.
inline constexpr double kFewPointsPerWave = 4;

// Subtracts the form fitted to the points present, fills the missing ones with the harmonic function of what is left around them, and filters, in place.
// Throws Error(bad_input) when points are missing and Missing::refuse says so (the message names the first), or all are missing.
Measured measure(HeightMap& map, const MeasureOptions& options);

// The treatment and the properties of a map as lines of text; `length_unit` follows every length.
std::vector<std::string> report(const Measured& measured, const std::string& length_unit);

}  // namespace rsc
