// A case: every key of the namelist, with its value. The registry (registry.hpp) names, checks,
// prints and describes them.
#pragma once

#include "contact/indentation.hpp"
#include "surface/form.hpp"
#include "surface/measured.hpp"
#include "surface/surface.hpp"

namespace rsc {

// Enumerations with the spellings of their values, in their order. Those of the contact are in
// contact/indentation.hpp.
// Twins, TwinHeights: properties of the measured map that surfaces with source = 'spectrum'
// reproduce.
enum class Twins { radial, directional };
inline constexpr std::array kTwinsNames = {"radial", "directional"};
enum class TwinHeights { gaussian, measured };
inline constexpr std::array kTwinHeightsNames = {"gaussian", "measured"};
enum class Source { synthetic, heights, asperities, spectrum, profile };
inline constexpr std::array kSourceNames = {"synthetic", "heights", "asperities", "spectrum",
                                            "profile"};
enum class Finish { none, polished, blasted };
inline constexpr std::array kFinishNames = {"none", "polished", "blasted"};
// How the spectrum of the surface that has the given profile follows from that of the profile.
enum class ProfileSurface { self_affine, inversion };
inline constexpr std::array kProfileSurfaceNames = {"self_affine", "inversion"};
// periodic_x, periodic_y: line contact; the surface repeats along this axis only.
enum class Boundary { free, periodic, periodic_x, periodic_y };
inline constexpr std::array kBoundaryNames = {"free", "periodic", "periodic_x", "periodic_y"};
enum class Control { separation, force, pressure };
inline constexpr std::array kControlNames = {"separation", "force", "pressure"};
enum class LevelUnit { sigma, length, relative, pressure };
inline constexpr std::array kLevelUnitNames = {"sigma", "length", "relative", "pressure"};
enum class Spacing { linear, log };
inline constexpr std::array kSpacingNames = {"linear", "log"};
enum class AmplitudeUnit { full_slip, length };
inline constexpr std::array kAmplitudeUnitNames = {"full_slip", "length"};
enum class Format { netcdf4, cdf5, classic };
inline constexpr std::array kFormatNames = {"netcdf4", "cdf5", "classic"};
enum class Contacts { automatic, none, last, all };
inline constexpr std::array kContactsNames = {"auto", "none", "last", "all"};
// Words allowed for compare%levels instead of a list.
enum class CompareWhat { automatic, none };
inline constexpr std::array kCompareNames = {"auto", "none"};
// Words allowed for output%stress_depths instead of a list.
enum class StressDepths { none, automatic };
inline constexpr std::array kStressDepthsNames = {"none", "auto"};
enum class StudyMode { product, zip };

struct Case {
    struct Run {
        std::string title;
        std::int64_t seed = 1;
        int realizations = 1, first_realization = 1;
        int threads = 0;  // 0: all
        std::string length_unit = "mm", force_unit = "N", time_unit = "s";
    } run;
    struct Solids {
        double E[2] = {78.0e3, kInfinity}, nu[2] = {0.42, 0.0}, R[2] = {kInfinity, 2.5};
        double hardness = kInfinity, size_effect = 0.0, resistivity[2] = {0.0, 0.0}, friction = 0.0;
        double adhesion = 0.0, adhesion_range = 0.0;
        double viscosity = 0.0;
        bool gas = false;
        double wear_coefficient = 0.0;
        std::vector<double> layer_thickness, layer_E, layer_nu;  // from the top; empty: none
        std::vector<double> relaxation_share,
            relaxation_time;  // g_k, tau_k of body 1; empty: elastic
    } solids;
    struct Surface {
        Source source = Source::synthetic;
        std::string file;
        std::optional<double> L;  // default: 1.0 if synthetic, otherwise from the file
        int n = 2048;
        double hurst = 0.8, L_lambda_l = 24.0, L_lambda_s = 512.0;
        bool plateau = false;
        std::optional<double>
            sigma;  // default: 0.01 if synthetic, otherwise the rms of the data read
        double aspect = 1.0, direction = 0.0, skewness = 0.0, kurtosis = 3.0;
        Twins twins = Twins::radial;
        TwinHeights twin_heights = TwinHeights::gaussian;
        Finish finish = Finish::none;
        std::optional<double> Ra;  // of a finish, instead of sigma
        Normalise normalise = Normalise::sample;
        Detrend detrend = Detrend::plane;
        Missing missing = Missing::refuse;
        double filter_cutoff = 0;  // 0: no filter
        std::string channel;
        std::string height_unit;      // of a map without units; empty: run%length_unit
        std::string coordinate_unit;  // of its x and y; empty: run%length_unit
        std::optional<double> pixel;  // of a map without coordinates: step between points [length]
        std::optional<double> window[4];  // x0, x1, y0, y1: part of the map to use; default: all
        double outliers = 0;              // 0: no search
        double cutoff_long = 0;           // of a profile; 0: no filter
        double thickness = 1;             // side along y of the surface of a profile
        ProfileSurface profile_surface = ProfileSurface::self_affine;
        std::vector<double> missing_value;  // heights in a file that mean a missing point
    } surface;
    struct AsperityKeys {
        Curvature curvature = Curvature::geometric;
        LawKind law = LawKind::fourth_order;
    } asperities;
    struct IndenterKeys {
        int shape = 0;  // row of kShapes (physics/indenter/shapes.hpp); a sphere takes solids%R
        std::optional<double> radii[2];  // paraboloid; default: the sphere's radius
        double angle = 0;                // [degree]
        std::optional<double> slope;     // cone
        std::optional<double> radius;    // punch
        double rim_radius = 0;           // punch
        std::string file, channel;       // map
    } indenter;
    struct Indentation {
        Boundary boundary = Boundary::free;
        bool line() const {
            return boundary == Boundary::periodic_x || boundary == Boundary::periodic_y;
        }
        Control control = Control::separation;
        double start = 4.0, stop = 1.0;
        int steps = 100;
        LevelUnit unit = LevelUnit::sigma;
        Spacing spacing = Spacing::linear;
        std::vector<double> levels;  // explicit list instead, in `unit`; empty: start, stop, steps
        std::optional<double> duration;  // from the first to the last level
        std::vector<double> times;       // explicit list instead
        std::optional<double> sliding;   // distance from the first to the last level
        std::vector<double> distances;   // explicit list instead
        bool slides() const { return sliding || !distances.empty(); }
        // Friction: tangential displacements of body 2, x and y of each; empty: cycles.
        std::vector<double> sliding_path;
        double amplitude = 0.9;
        AmplitudeUnit amplitude_unit = AmplitudeUnit::full_slip;
        int cycles = 1;
        std::optional<double> centre[2];  // default: the middle of the surface
        // line contact: distance from the line at which a uniform line load lowers nothing;
        // default: the side of the surface across the line
        std::optional<double> line_reference;
        Selection selection = Selection::overlap;
        double selection_factor = 1.5;
    } indentation;
    struct Solver {
        Method method = Method::automatic;
        double tolerance = 1.0e-6;
        int max_iterations = 100;
        double delta0 = 0.01;
        Interaction interaction = Interaction::point;
        ModelKind model = ModelKind::automatic;
    } solver;
    struct Elements {
        double points_per_wave = 8;
    } elements;
    struct Compare {
        CompareWhat what = CompareWhat::automatic;
        std::vector<double> levels;  // in `unit` of the indentation; empty: `what` applies
        bool listed() const { return !levels.empty(); }
    } compare;
    struct Output {
        std::string file = "output/rsc.nc";
        Format format = Format::netcdf4;
        Contacts contacts = Contacts::automatic;
        bool heights = false, flow = false;
        std::optional<double> leak_drop[2], leak_length, leak_width;
        int map_cells = 50, radial_bins = 50;
        std::vector<double> pdf_levels = {2.0, 2.5, 3.0};
        int pdf_bins = 60;
        int compression = 4;
        std::vector<double> fields;        // numbers of field_names(); empty: none
        std::vector<double> field_levels;  // in `unit` of the indentation; empty: the last level
        std::optional<double> field_window[4];  // x0, x1, y0, y1; default: about the contact
        StressDepths automatic_depths = StressDepths::none;
        std::vector<double> stress_depths;        // empty: `automatic_depths` applies
        std::optional<double> sliding_direction;  // [degree]; default: the bodies do not slide
        bool stresses() const {
            return !stress_depths.empty() || automatic_depths == StressDepths::automatic;
        }
    } output;
};

// What a finishing process makes of a surface of which a drawing has only Ra or Rq: typical values,
// each with its source (model_choice.cpp). An assumption, not a measurement.
struct FinishedSurface {
    double hurst = 0, shortest = 0, longest = 0;  // wavelengths [length]
    double sigma = 0;                             // [length]
    std::string sources;
};
std::optional<FinishedSurface> finished_surface(const Case& settings);  // none: no surface%finish

// True if the surface is read from a file of heights: a map or a profile.
inline bool reads_heights(const Case& settings) {
    return settings.surface.source == Source::heights || settings.surface.source == Source::profile;
}

struct Spectrum;
// The spectrum of a surface with source = 'synthetic'.
Spectrum self_affine_spectrum(const Case& settings);

// The model that solves this case: solver%model, or the choice of 'auto' with its reason
// (model_choice.cpp).
struct ModelChoice {
    ModelKind model;       // asperities or elements
    const char* why = "";  // of `auto`, for the screen
};
ModelChoice model_of(const Case& settings);

// The radii of bodies 1 and 2 in the two principal directions of the gap between them, for the
// shapes sphere and paraboloid: R[direction][body] [length], Infinity: straight. In line contact
// body 1 is a cylinder: straight along the axis.
struct GapRadii {
    double R[2][2];
    double angle;  // of the first direction from x [degree]
};
GapRadii gap_radii(const Case& settings);
// True if closed forms of areas and pressures hold: body 1 is an elastic half-space without layers,
// and the only rough body.
bool has_closed_forms(const Case& settings);
inline bool by_elements(const Case& settings) {
    return model_of(settings).model == ModelKind::elements;
}

}  // namespace rsc
