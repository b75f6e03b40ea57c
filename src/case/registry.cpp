#include "case/registry.hpp"

#include "case/namelist_value.hpp"
#include "contact/indenter/shapes.hpp"
#include "observe/fields.hpp"

namespace rsc {
namespace {

constexpr double kNoLimit = Case::kInfinity;
constexpr Bounds kAny{};
constexpr Bounds kPositive{0, kNoLimit, true, false};
constexpr Bounds kNotNegative{0, kNoLimit, false, false};
constexpr Bounds kPositiveOrInfinite{0, kNoLimit, true, true};
constexpr Bounds between(double low, double high) { return {low, high, false, false}; }
constexpr Bounds above(double low, double high) { return {low, high, true, false}; }

template <class E>
Slot choice_slot(E& object) {
    return ChoiceSlot{&object, [](const void* p) { return static_cast<int>(*static_cast<const E*>(p)); },
                      [](void* p, int i) { *static_cast<E*>(p) = static_cast<E>(i); }};
}

#define RSC_SLOT(member) [](Case& c) -> Slot { return &c.member; }
#define RSC_FIRST(member) [](Case& c) -> Slot { return &c.member[0]; }
#define RSC_CHOICE(member) [](Case& c) -> Slot { return choice_slot(c.member); }

using enum Type;

Key scalar(const char* group, const char* name, Type type, const char* unit, Bounds bounds, const char* meaning, Slot (*slot)(Case&)) {
    return {group, name, type, 1, false, 0, unit, bounds, {}, "", meaning, slot};
}
Key array(const char* group, const char* name, int size, const char* unit, Bounds bounds, const char* meaning, Slot (*slot)(Case&)) {
    return {group, name, real, size, false, 0, unit, bounds, {}, "", meaning, slot};
}
Key list(const char* group, const char* name, int most, const char* unit, const char* unset, const char* meaning, Slot (*slot)(Case&)) {
    return {group, name, real, most, true, 0, unit, kAny, {}, unset, meaning, slot};
}
Key list_or_word(const char* group, const char* name, int most, const char* unit, std::vector<const char*> words, const char* meaning,
                 Slot (*slot)(Case&), Slot (*word)(Case&)) {
    return {group, name, real, most, true, 0, unit, kAny, std::move(words), "", meaning, slot, Changes::numbers, word};
}
Key optional(const char* group, const char* name, int size, Bounds bounds, const char* unset, const char* meaning, Slot (*slot)(Case&)) {
    return {group, name, real, size, false, 0, "length", bounds, {}, unset, meaning, slot};
}
Key text(const char* group, const char* name, int length, const char* meaning, Slot (*slot)(Case&)) {
    return {group, name, string, 1, false, length, "", kAny, {}, "", meaning, slot};
}
Key pure_number(Key key) {
    key.unit = "1";
    return key;
}
Key timed(Key key) {
    key.unit = "time";
    return key;
}
// The order of the names is the order of the enumeration.
Key one_of(const char* group, const char* name, std::vector<const char*> choices, const char* meaning, Slot (*slot)(Case&)) {
    return {group, name, choice, 1, false, 32, "", kAny, std::move(choices), "", meaning, slot};
}

Key words(const char* group, const char* name, std::vector<const char*> choices, const char* meaning, Slot (*slot)(Case&)) {
    const int most = static_cast<int>(choices.size());
    return {group, name, choice, most, true, 32, "", kAny, std::move(choices), "none", meaning, slot};
}

Key within(Bounds bounds, Key key) {
    key.bounds = bounds;
    return key;
}

Key changing(Changes what, Key key) {
    key.changes = what;
    return key;
}

template <std::size_t n>
std::vector<const char*> names(const std::array<const char*, n>& all) {
    return {all.begin(), all.end()};
}

std::vector<const char*> shape_names() {
    std::vector<const char*> all;
    for (const ShapeRow& row : kShapes) all.push_back(row.name);
    return all;
}

std::vector<Key> make_registry() {
    return {
        changing(Changes::file, text("run", "title", 1024, "title of the result file", RSC_SLOT(run.title))),
        scalar("run", "seed", long_integer, "1", kAny, "seed of the random surface; seed and realization number determine it",
               RSC_SLOT(run.seed)),
        scalar("run", "realizations", integer, "1", between(1, 1e7), "number of surfaces", RSC_SLOT(run.realizations)),
        scalar("run", "first_realization", integer, "1", between(1, 2147483647.0),
               "number of the first surface; realization k of a seed is always the same surface", RSC_SLOT(run.first_realization)),
        changing(Changes::nothing, scalar("run", "threads", integer, "1", between(0, 4096),
                                          "number of threads, 0 for all; results do not depend on it", RSC_SLOT(run.threads))),
        text("run", "length_unit", 64, "unit of every length, as UDUNITS spells it; '1' for dimensionless lengths",
             RSC_SLOT(run.length_unit)),
        text("run", "force_unit", 64, "unit of every force, as UDUNITS spells it; '1' for dimensionless forces", RSC_SLOT(run.force_unit)),
        text("run", "time_unit", 64, "unit of every time, as UDUNITS spells it; '1' for dimensionless times", RSC_SLOT(run.time_unit)),

        array("solids", "E", 2, "force/length^2", kPositiveOrInfinite,
              "Young's modulus of body 1 (rough) and of body 2 (the indenter); Infinity: rigid", RSC_FIRST(solids.E)),
        array("solids", "nu", 2, "1", above(-1, 0.5), "Poisson's ratio of the two bodies", RSC_FIRST(solids.nu)),
        array("solids", "R", 2, "length", kPositiveOrInfinite, "radius of curvature of the two bodies; Infinity: flat",
              RSC_FIRST(solids.R)),
        scalar(
            "solids", "hardness", real, "force/length^2", kPositiveOrInfinite,
            "hardness H0: upper limit of the mean pressure of an asperity, H0 sqrt(1 + size_effect/r), and of the pressure on an element, H0; each level then "
            "depends on the levels before it",
            RSC_SLOT(solids.hardness)),
        scalar("solids", "size_effect", real, "length", kNotNegative,
               "characteristic length of the indentation size effect on the hardness of asperities", RSC_SLOT(solids.size_effect)),
        array("solids", "resistivity", 2, "resistance*length", kNotNegative,
              "electrical or thermal resistivity of the two bodies, for the constriction resistance of the contact",
              RSC_FIRST(solids.resistivity)),
        scalar("solids", "friction", real, "1", kNotNegative,
               "coefficient of friction mu; if above 0, the result has the tangential force at each level (one realization only)",
               RSC_SLOT(solids.friction)),
        scalar("solids", "adhesion", real, "force/length", kNotNegative,
               "work of adhesion w; above 0 forces may be negative, and each level depends on the levels before it",
               RSC_SLOT(solids.adhesion)),
        scalar("solids", "adhesion_range", real, "length", kNotNegative,
               "range z0 of the attraction, a constant traction w/z0 across gaps below z0 (Dugdale); 0: attraction of zero range (JKR)",
               RSC_SLOT(solids.adhesion_range)),
        within(kPositive, list("solids", "layer_thickness", kMostLayers, "length", "none",
                               "thicknesses of layers on body 1, top first; E(1) and nu(1) then belong to the body below them",
                               RSC_SLOT(solids.layer_thickness))),
        within(kPositive,
               list("solids", "layer_E", kMostLayers, "force/length^2", "none", "Young's moduli of the layers", RSC_SLOT(solids.layer_E))),
        within(above(-1, 0.5),
               list("solids", "layer_nu", kMostLayers, "1", "none", "Poisson's ratios of the layers", RSC_SLOT(solids.layer_nu))),

        within(
            between(0, 1),
            list(
                "solids", "relaxation_share", kMostRelaxations, "1", "none",
                "shares g_k of E(1) that body 1 loses by relaxation, E(t) = E(1) (1 - sum g_k (1 - exp(-t/tau_k))); their sum is at most 1",
                RSC_SLOT(solids.relaxation_share))),
        within(kPositive, list("solids", "relaxation_time", kMostRelaxations, "time", "none", "relaxation times tau_k, one for each share",
                               RSC_SLOT(solids.relaxation_time))),

        one_of(
            "surface", "source", names(kSourceNames),
            "synthetic: a random surface with the keys below; heights, asperities: read from `file`; spectrum: random surfaces with the spectrum in `file`",
            RSC_CHOICE(surface.source)),
        text(
            "surface", "file", 4096,
            "file with the heights (NetCDF, .gwy, .sdf, text), the asperities or the spectrum (NetCDF, text); for heights also a pattern such as maps/*.gwy: "
            "realization k is then the k-th file in alphabetical order",
            RSC_SLOT(surface.file)),
        optional("surface", "L", 1, kPositive,
                 "1.0; for heights and asperities from the file; for a spectrum 2 pi over its smallest wavenumber",
                 "side of the surface (x extent of a map)", RSC_SLOT(surface.L)),
        scalar("surface", "n", integer, "1", between(2, 32768), "points along a side, even", RSC_SLOT(surface.n)),
        scalar("surface", "hurst", real, "1", between(0, 1), "Hurst exponent H", RSC_SLOT(surface.hurst)),
        scalar("surface", "L_lambda_l", real, "1", between(1, 32768), "L / lambda_l: the longest wavelength of the self-affine band",
               RSC_SLOT(surface.L_lambda_l)),
        scalar("surface", "L_lambda_s", real, "1", between(1, 32768), "L / lambda_s: the shortest wavelength",
               RSC_SLOT(surface.L_lambda_s)),
        scalar("surface", "plateau", logical, "", kAny, "constant spectrum between the wavelengths L and lambda_l instead of zero",
               RSC_SLOT(surface.plateau)),
        optional(
            "surface", "sigma", 1, kPositive, "0.01; for data from a file the rms height of the data or of the spectrum",
            "rms height of a random surface; for heights and asperities only the unit of length for unit = 'sigma' and delta0 (default for several files: that of the first)",
            RSC_SLOT(surface.sigma)),
        scalar(
            "surface", "aspect", real, "1", between(0.01, 100),
            "ratio of the correlation lengths of a random surface along and across `direction`: the surface is stretched by sqrt(aspect) along it and compressed across it",
            RSC_SLOT(surface.aspect)),
        scalar("surface", "direction", real, "degree", between(-360, 360),
               "direction of the long correlation length, from the x axis towards the y axis", RSC_SLOT(surface.direction)),
        scalar("surface", "skewness", real, "1", between(-6, 6), "skewness of the heights of a random surface; 0: symmetric",
               RSC_SLOT(surface.skewness)),
        scalar("surface", "kurtosis", real, "1", between(1, 100),
               "kurtosis of the heights of a random surface, greater than skewness^2 + 1; 3: Gaussian", RSC_SLOT(surface.kurtosis)),
        one_of("surface", "twins", names(kTwinsNames),
               "source = 'spectrum': use the spectrum averaged over all directions, or the spectrum by direction",
               RSC_CHOICE(surface.twins)),
        one_of("surface", "twin_heights", names(kTwinHeightsNames),
               "source = 'spectrum': Gaussian heights, or the height distribution of the map that the spectrum was measured on",
               RSC_CHOICE(surface.twin_heights)),
        one_of("surface", "normalise", names(kNormaliseNames),
               "sample: each surface has exactly the rms height sigma; ensemble: on average", RSC_CHOICE(surface.normalise)),
        one_of("surface", "detrend", names(kDetrendNames),
               "form to subtract from a height map, fitted by least squares; separations are measured from z = 0 afterwards",
               RSC_CHOICE(surface.detrend)),
        one_of("surface", "missing", names(kMissingNames),
               "missing points of a height map: refuse the map, or fill them with the harmonic function of the heights around them",
               RSC_CHOICE(surface.missing)),
        scalar(
            "surface", "filter_cutoff", real, "length", between(0, kNoLimit),
            "cutoff wavelength of the Gaussian low-pass filter (ISO 16610-61) of a height map, 0 for none; waves of that length keep half of their amplitude",
            RSC_SLOT(surface.filter_cutoff)),
        text("surface", "channel", 1024,
             "channel of a .gwy file, or variable of a NetCDF file, with the heights; if empty, the first one with heights",
             RSC_SLOT(surface.channel)),
        text("surface", "height_unit", 64, "unit of the heights in a text file, as UDUNITS spells it; run%length_unit if empty",
             RSC_SLOT(surface.height_unit)),
        optional("surface", "pixel", 1, kPositive, "from L", "distance between neighbouring points of a text matrix, instead of L",
                 RSC_SLOT(surface.pixel)),
        optional("surface", "window", 4, kAny, "the whole map",
                 "x0, x1, y0, y1: use only this part of a height map, in the coordinates of the map", RSC_FIRST(surface.window)),
        scalar(
            "surface", "outliers", real, "1", between(0, kNoLimit),
            "points of a height map that differ from the median of the 5 x 5 points around them by more than this number of standard "
            "deviations (estimated from the median of the differences) are filled like missing ones; 0: none; 6 removes spikes and keeps roughness",
            RSC_SLOT(surface.outliers)),

        one_of("asperities", "curvature", names(kCurvatureNames), "mean of the principal curvatures that defines the radius of an asperity",
               RSC_CHOICE(asperities.curvature)),
        one_of(
            "asperities", "law", names(kLawNames),
            "contact law of asperities: hertz: a sphere at a grid point (the paper's); elliptic: an elliptic paraboloid at the summit between the "
            "points; fourth_order: the paraboloid corrected by the fourth derivatives at the summit, under a steep indenter the most loaded ellipse; the latter two count "
            "overlapping areas once",
            RSC_CHOICE(asperities.law)),

        one_of(
            "indenter", "shape", shape_names(),
            "shape of body 2: a sphere of solids%R (Infinity: a flat), a paraboloid of two radii (one Infinity: a cylinder), a cone, a flat "
            "punch, or a second rough body read from a height map",
            RSC_CHOICE(indenter.shape)),
        optional("indenter", "radii", 2, kPositiveOrInfinite, "solids%R(2), twice",
                 "shape = 'paraboloid': principal radii of curvature; Infinity: straight", RSC_FIRST(indenter.radii)),
        scalar("indenter", "angle", real, "degree", between(-360, 360),
               "shape = 'paraboloid': angle from the x axis to the direction of the first radius", RSC_SLOT(indenter.angle)),
        pure_number(optional("indenter", "slope", 1, kPositive, "none: shape = 'cone' needs it",
                             "shape = 'cone': slope of its side, the tangent of the angle between side and surface",
                             RSC_SLOT(indenter.slope))),
        optional("indenter", "radius", 1, kPositive, "none: shape = 'punch' needs it", "shape = 'punch': radius of its flat end",
                 RSC_SLOT(indenter.radius)),
        scalar("indenter", "rim_radius", real, "length", kNotNegative,
               "shape = 'punch': radius of the rounded rim around the flat end; 0: sharp", RSC_SLOT(indenter.rim_radius)),
        text(
            "indenter", "file", 4096,
            "shape = 'map': file with the heights of body 2, upwards positive, as for surface%file; its centre lies at indentation%centre, and "
            "surface%detrend, missing, outliers, filter_cutoff, height_unit and pixel apply to it, too",
            RSC_SLOT(indenter.file)),
        text("indenter", "channel", 1024, "shape = 'map': channel or variable of that file, as surface%channel",
             RSC_SLOT(indenter.channel)),

        one_of(
            "indentation", "boundary", names(kBoundaryNames),
            "free: the surface ends at its border; periodic: two flats (solids%R = Infinity, Infinity), surface and contact are periodic",
            RSC_CHOICE(indentation.boundary)),
        one_of("indentation", "control", names(kControlNames),
               "quantity given by start, stop and levels; pressure: nominal pressure N/L^2, periodic boundary only",
               RSC_CHOICE(indentation.control)),
        scalar("indentation", "start", real, "`unit`", kAny, "first level", RSC_SLOT(indentation.start)),
        scalar("indentation", "stop", real, "`unit`", kAny, "last level", RSC_SLOT(indentation.stop)),
        scalar("indentation", "steps", integer, "1", between(1, 1e6), "number of levels, both ends included", RSC_SLOT(indentation.steps)),
        one_of("indentation", "unit", names(kLevelUnitNames),
               "unit of separations: sigma or length; of pressures: relative, p/(E* sqrt(2 m2)), or pressure; forces have the force unit",
               RSC_CHOICE(indentation.unit)),
        one_of("indentation", "spacing", names(kSpacingNames), "spacing of the levels", RSC_CHOICE(indentation.spacing)),
        list("indentation", "levels", 10000, "`unit`", "start, stop and steps give the levels",
             "list of levels instead of start, stop and steps", RSC_SLOT(indentation.levels)),
        timed(optional("indentation", "duration", 1, kPositive, "none",
                       "for a body that relaxes, time from the first to the last level, in equal steps; the first level is reached at once",
                       RSC_SLOT(indentation.duration))),
        list("indentation", "times", 10000, "time", "none", "time of each level, increasing, instead of `duration`",
             RSC_SLOT(indentation.times)),
        optional("indentation", "centre", 2, kAny, "the middle of the surface", "x and y of the tip of the indenter",
                 RSC_FIRST(indentation.centre)),
        one_of("indentation", "selection", names(kSelectionNames),
               "asperities in the system of equations: all that can touch, or those within selection_factor times the paper's radius",
               RSC_CHOICE(indentation.selection)),
        scalar("indentation", "selection_factor", real, "1", kPositive, "factor for selection = 'paper'",
               RSC_SLOT(indentation.selection_factor)),

        one_of("solver", "method", names(kMethodNames),
               "dgesv: the paper's method; direct, mesh: matrix-free Newton's method, products by pairs or by fast Fourier transforms",
               RSC_CHOICE(solver.method)),
        scalar("solver", "tolerance", real, "1", between(1e-14, 0.1),
               "relative residual of F - C<G0 - B F>^(3/2); for dgesv also on |dF|/|F|", RSC_SLOT(solver.tolerance)),
        scalar("solver", "max_iterations", integer, "1", between(1, 1e6), "maximum number of Newton steps at a level",
               RSC_SLOT(solver.max_iterations)),
        scalar("solver", "delta0", real, "sigma", above(0, 1e3), "initial regularisation of the paper's method", RSC_SLOT(solver.delta0)),
        one_of("solver", "interaction", names(kInteractionNames),
               "deflection of the surface around an asperity: that of a point force, or none", RSC_CHOICE(solver.interaction)),

        one_of("solver", "model", names(kModelNames),
               "asperities: the summits of the surface; elements: boundary elements on every point of the surface (slower, more accurate). "
               "auto: asperities for random surfaces, elements for height maps unless another key needs asperities",
               RSC_CHOICE(solver.model)),

        scalar(
            "elements", "points_per_wave", real, "1", between(4, 64),
            "grid steps in the shortest wavelength for model = 'elements'; &compare starts with it and refines the grid until N converges; a "
            "height map is used on its own grid",
            RSC_SLOT(elements.points_per_wave)),

        list_or_word(
            "compare", "levels", 1000, "`unit` of the indentation", names(kCompareNames),
            "after the run, solves the level nearest to each of these by elements on the first realization, to measure the error of the "
            "asperity model on this surface. auto: the last level of a single run of the program, if elements are "
            "expected to take less than 2 s",
            RSC_SLOT(compare.levels), RSC_CHOICE(compare.what)),

        changing(Changes::file, text("output", "file", 4096, "the result file", RSC_SLOT(output.file))),
        changing(Changes::file, one_of("output", "format", names(kFormatNames), "format of the result file", RSC_CHOICE(output.format))),
        one_of("output", "contacts", names(kContactsNames),
               "levels whose contacts are written; auto: all levels of a single realization, none of a campaign",
               RSC_CHOICE(output.contacts)),
        scalar("output", "heights", logical, "", kAny, "write the height map to the result", RSC_SLOT(output.heights)),
        words(
            "output", "fields", names(kFieldNames),
            "quantities to write at the points of the surface, for a single realization. Elements: the pressure and gap of the solution. Asperities: "
            "the pressure in their contact spots, and the gap that follows from it",
            RSC_SLOT(output.fields)),
        list("output", "field_levels", 1000, "`unit` of the indentation", "the last level",
             "levels whose fields are written, the nearest level to each", RSC_SLOT(output.field_levels)),
        optional("output", "field_window", 4, kAny, "a region around the contact at these levels; two flats: the whole surface",
                 "x0, x1, y0, y1 of the region in which fields are written", RSC_FIRST(output.field_window)),
        scalar("output", "map_cells", integer, "1", between(1, 4096), "cells along a side of the coarse maps", RSC_SLOT(output.map_cells)),
        scalar("output", "radial_bins", integer, "1", between(1, 100000), "number of radii of the radial means",
               RSC_SLOT(output.radial_bins)),
        list("output", "pdf_levels", 100, "sigma", "", "separations at which distributions are written (the nearest level to each)",
             RSC_SLOT(output.pdf_levels)),
        scalar("output", "pdf_bins", integer, "1", between(1, 100000), "bins of the distributions", RSC_SLOT(output.pdf_bins)),
        changing(Changes::file,
                 scalar("output", "compression", integer, "1", between(0, 9), "deflate level of netcdf4", RSC_SLOT(output.compression))),
    };
}

#undef RSC_SLOT
#undef RSC_FIRST
#undef RSC_CHOICE

constexpr std::pair<const char*, const char*> kGroups[] = {
    {"run", "title, realizations, threads and units"},
    {"solids", "material and radii of the two bodies: body 1 is rough, body 2 is the indenter"},
    {"surface", "the rough surface"},
    {"asperities", "asperities made from the summits of the surface"},
    {"indenter", "shape of body 2"},
    {"indentation", "the levels of the indentation"},
    {"solver", "solution of the contact problem"},
    {"elements", "grid of boundary elements"},
    {"compare", "comparison of asperities with elements"},
    {"output", "the result file"},
    {"study", "lists of values for any keys; each member of the study is a run: surface%sigma = 0.001, 0.01  mode = 'product' ('zip')"},
};

}  // namespace

std::span<const Key> registry() {
    static const std::vector<Key> keys = make_registry();
    return keys;
}

const std::vector<std::string_view>& group_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> result;
        for (const auto& [name, meaning] : kGroups) result.push_back(name);
        return result;
    }();
    return names;
}

const char* group_meaning(std::string_view group) {
    for (const auto& [name, meaning] : kGroups)
        if (group == name) return meaning;
    return nullptr;
}

const Key* find_key(std::string_view group, std::string_view name) {
    const std::string g = namelist::lower_case(group), n = namelist::lower_case(name);
    for (const Key& key : registry())
        if (g == key.group && n == namelist::lower_case(key.name)) return &key;
    return nullptr;
}

std::string suggest_key(std::string_view group, std::string_view name) {
    std::vector<std::string_view> here;
    for (const Key& key : registry())
        if (namelist::lower_case(group) == key.group) here.push_back(key.name);
    for (const Key& key : registry())
        if (find_key(key.group, name)) return "; '" + std::string(name) + "' belongs to &" + find_key(key.group, name)->group;
    return namelist::suggestion(name, here);
}

std::string keys_named(std::string_view name) {
    while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
    std::string found;
    for (const Key& key : registry())
        if (namelist::lower_case(name) == namelist::lower_case(key.name))
            found += (found.empty() ? "" : " or ") + std::string(key.group) + "%" + key.name;
    return found;
}

bool Bounds::hold(double value) const {
    if (std::isnan(value) || (std::isinf(value) && !infinity)) return false;
    return (open ? value > low : value >= low) && value <= high;
}

std::string Bounds::text() const {
    const auto number = [](double value) {
        if (value == std::floor(value) && std::abs(value) < 1e15) return std::to_string(static_cast<long long>(value));
        return namelist::from_real(value);
    };
    std::string result;
    if (std::isfinite(low) && std::isfinite(high))
        result = (open ? "> " + number(low) + " and <= " : number(low) + " to ") + number(high);
    else if (std::isfinite(low))
        result = (open ? "> " : ">= ") + number(low);
    else if (std::isfinite(high))
        result = "<= " + number(high);
    if (infinity) result += " (Infinity allowed)";
    return result;
}

}  // namespace rsc
