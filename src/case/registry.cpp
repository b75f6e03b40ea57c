#include "case/registry.hpp"

#include "base/error.hpp"
#include "physics/indenter/shapes.hpp"
#include "physics/physics.hpp"

namespace rsc {

using namespace namelist;
using namespace keys;

namespace {

std::vector<const char*> shape_names() {
    std::vector<const char*> all;
    for (const ShapeRow& row : kShapes) all.push_back(row.name);
    return all;
}

std::vector<Key> keys_of_run() {
    return {
        changing(Changes::file, text(RSC_KEY(run, title), 1024, "title of the result file")),
        number(RSC_KEY(run, seed), "1", kAny,
               "seed of the random surface; seed and realization number determine it"),
        number(RSC_KEY(run, realizations), "1", between(1, 1e7), "number of surfaces"),
        number(RSC_KEY(run, first_realization), "1", between(1, 2147483647.0),
               "number of the first surface; realization k of a seed is always the same surface"),
        changing(Changes::nothing,
                 number(RSC_KEY(run, threads), "1", between(0, 4096),
                        "number of threads, 0 for all; results do not depend on it")),
        text(RSC_KEY(run, length_unit), 64,
             "unit of every length, as UDUNITS spells it; '1' for dimensionless lengths"),
        text(RSC_KEY(run, force_unit), 64,
             "unit of every force, as UDUNITS spells it; '1' for dimensionless forces"),
        text(RSC_KEY(run, time_unit), 64,
             "unit of every time, as UDUNITS spells it; '1' for dimensionless times"),
    };
}

std::vector<Key> keys_of_solids() {
    return {
        number(RSC_KEY(solids, E), "force/length^2", kPositiveOrInfinite,
               "Young's modulus of body 1 (rough) and of body 2 (the indenter); Infinity: rigid"),
        number(RSC_KEY(solids, nu), "1", above(-1, 0.5), "Poisson's ratio of the two bodies"),
        number(
            RSC_KEY(solids, R), "length", kRadius,
            "radii of the two bodies, spheres; Infinity: flat; negative: concave (a socket; 1/R(1) "
            "+ 1/R(2) must be positive). In line contact R(1) is the radius of a cylinder"),
        number(RSC_KEY(solids, resistivity), "resistance*length", kNotNegative,
               "electrical or thermal resistivity of the two bodies, for the constriction "
               "resistance of the contact"),
        list(RSC_KEY(solids, layer_thickness), kMostLayers, "length", kPositive, "none",
             "thicknesses of layers on body 1, top first; E(1) and nu(1) then belong to the body "
             "below them"),
        list(RSC_KEY(solids, layer_E), kMostLayers, "force/length^2", kPositive, "none",
             "Young's moduli of the layers"),
        list(RSC_KEY(solids, layer_nu), kMostLayers, "1", above(-1, 0.5), "none",
             "Poisson's ratios of the layers"),

    };
}

std::vector<Key> keys_of_surface() {
    return {
        choice(
            RSC_KEY(surface, source), kSourceNames,
            "synthetic: a random surface with the keys below; heights, asperities: read from "
            "`file`; spectrum: random surfaces with the spectrum in `file`; profile: heights along "
            "a line (NetCDF, .sdf, .smd, text), as a surface that is constant along y"),
        text(RSC_KEY(surface, file), 4096,
             "file with the heights (NetCDF, .gwy, .sdf, text), the asperities or the spectrum "
             "(NetCDF, text); for heights also a pattern such as maps/*.gwy: "
             "realization k is then the k-th file in alphabetical order"),
        number(RSC_KEY(surface, L), "length", kPositive, "side of the surface (x extent of a map)",
               "1.0; for heights and asperities from the file; for a spectrum 2 pi over its "
               "smallest wavenumber"),
        number(RSC_KEY(surface, n), "1", between(2, 32768), "points along a side, even"),
        number(RSC_KEY(surface, hurst), "1", between(0, 1), "Hurst exponent H"),
        number(RSC_KEY(surface, L_lambda_l), "1", between(1, 32768),
               "L / lambda_l: the longest wavelength of the self-affine band"),
        number(RSC_KEY(surface, L_lambda_s), "1", between(1, 32768),
               "L / lambda_s: the shortest wavelength"),
        number(RSC_KEY(surface, plateau), "", kAny,
               "constant spectrum between the wavelengths L and lambda_l instead of zero"),
        number(RSC_KEY(surface, sigma), "length", kPositive,
               "rms height of a random surface; for heights and asperities only the unit of length "
               "for unit = 'sigma' and delta0 (default for several files: that of the first)",
               "0.01; for data from a file the rms height of the data or of the spectrum"),
        number(RSC_KEY(surface, aspect), "1", between(0.01, 100),
               "ratio of the correlation lengths of a random surface along and across `direction`: "
               "the surface is stretched by sqrt(aspect) along it and compressed across it"),
        number(RSC_KEY(surface, direction), "degree", between(-360, 360),
               "direction of the long correlation length, from the x axis towards the y axis"),
        number(RSC_KEY(surface, skewness), "1", between(-6, 6),
               "skewness of the heights of a random surface; 0: symmetric"),
        number(RSC_KEY(surface, kurtosis), "1", between(1, 100),
               "kurtosis of the heights of a random surface, greater than skewness^2 + 1; 3: "
               "Gaussian"),
        choice(RSC_KEY(surface, twins), kTwinsNames,
               "source = 'spectrum': use the spectrum averaged over all directions, or the "
               "spectrum by direction"),
        choice(RSC_KEY(surface, twin_heights), kTwinHeightsNames,
               "source = 'spectrum': Gaussian heights, or the height distribution of the map that "
               "the spectrum was measured on"),
        choice(
            RSC_KEY(surface, finish), kFinishNames,
            "source = 'synthetic': instead of hurst and wavelengths, those that are typical of a "
            "polished or sand-blasted surface, of which only Ra or sigma is known: an "
            "assumption, which is printed with its sources"),
        number(RSC_KEY(surface, Ra), "length", kPositive,
               "with a finish: arithmetic mean roughness, as on a drawing, instead of sigma",
               "from sigma"),
        choice(RSC_KEY(surface, normalise), kNormaliseNames,
               "sample: each surface has exactly the rms height sigma; ensemble: on average"),
    };
}

std::vector<Key> keys_of_height_maps() {
    return {
        choice(RSC_KEY(surface, detrend), kDetrendNames,
               "form to subtract from a height map, fitted by least squares; separations are "
               "measured from z = 0 afterwards"),
        choice(RSC_KEY(surface, missing), kMissingNames,
               "missing points of a height map: refuse the map, or fill them with the harmonic "
               "function of the heights around them"),
        number(RSC_KEY(surface, filter_cutoff), "length", between(0, kNoLimit),
               "cutoff wavelength of the Gaussian low-pass filter (ISO 16610-61) of a height map, "
               "0 for none; waves of that length keep half of their amplitude"),
        text(RSC_KEY(surface, channel), 1024,
             "channel of a .gwy file (its title, or its number in Gwyddion, from 0), or variable "
             "of a NetCDF file; if empty, the first one with heights"),
        text(
            RSC_KEY(surface, height_unit), 64,
            "unit of the heights in a file without units, as UDUNITS spells it; run%length_unit if "
            "empty"),
        text(RSC_KEY(surface, coordinate_unit), 64,
             "unit of x and y in three columns of a text, or in another file without units; "
             "run%length_unit if empty"),
        number(RSC_KEY(surface, pixel), "length", kPositive,
               "distance between neighbouring points of a text matrix, or of another file without "
               "coordinates or units, instead of L",
               "from L"),
        number(RSC_KEY(surface, window), "length", kAny,
               "x0, x1, y0, y1: use only this part of a height map, in the coordinates of the map",
               "the whole map"),
        number(
            RSC_KEY(surface, outliers), "1", between(0, kNoLimit),
            "points of a height map that differ from the median of the means of opposite points "
            "around them (5 x 5 points) by more than this "
            "number of standard deviations (estimated from the 90 % quantile of the differences) "
            "are filled like missing ones, and groups of up to 12 points alone inside a missing "
            "part that differ as much from its filling; 0: none; 6 removes spikes and keeps "
            "roughness"),
        number(RSC_KEY(surface, cutoff_long), "length", kNotNegative,
               "long-wave cutoff (lambda_c) of the Gaussian filter (ISO 16610-21) of a profile, 0 "
               "for none; half of it is lost at each end. filter_cutoff is its short-wave cutoff "
               "(lambda_s)"),
        number(RSC_KEY(surface, thickness), "length", kPositive,
               "side along y of the surface of a profile, which is constant along y: forces, areas "
               "and energies are those of this length"),
        choice(RSC_KEY(surface, profile_surface), kProfileSurfaceNames,
               "spectrum, in the result, of the surfaces that have such profiles, with the lay of "
               "`aspect` and `direction`: the self-affine one fitted to the profile's, or its "
               "inversion without a model"),
        list(RSC_KEY(surface, missing_value), 16, "", kAny, "none",
             "heights that mean a missing point: for text and NetCDF, as written in the file; for "
             ".gwy and .sdf, in run%length_unit"),
    };
}

std::vector<Key> keys_of_asperities() {
    return {
        choice(RSC_KEY(asperities, curvature), kCurvatureNames,
               "mean of the principal curvatures that defines the radius of an asperity"),
        choice(RSC_KEY(asperities, law), kLawNames,
               "contact law of asperities: hertz: a sphere at a grid point (the paper's); "
               "elliptic: an elliptic paraboloid at the summit between the "
               "points; fourth_order: the paraboloid corrected by the fourth derivatives at the "
               "summit; the latter two are at the summits of the difference between surface and "
               "indenter, and count overlapping areas once"),
    };
}

std::vector<Key> keys_of_indenter() {
    return {
        choice({"indenter", "shape", 0, [](Case& c) { return choice_slot(c.indenter.shape); }},
               shape_names(),
               "shape of body 2: a sphere of solids%R (Infinity: a flat), a paraboloid of two "
               "radii (one Infinity: a cylinder), a cone, a flat "
               "punch, or a second rough body read from a height map"),
        number(RSC_KEY(indenter, radii), "length", kRadius,
               "shape = 'paraboloid': principal radii of curvature; Infinity: straight; negative: "
               "concave. The curvature 1/R(1) of body 1 is added. A ball of radius r on a straight "
               "groove of radius g: radii = 1/(1/r - 1/g), r",
               "solids%R(2), twice"),
        number(RSC_KEY(indenter, angle), "degree", between(-360, 360),
               "shape = 'paraboloid': angle from the x axis to the direction of the first radius"),
        number(
            RSC_KEY(indenter, slope), "1", kPositive,
            "shape = 'cone': slope of its side, the tangent of the angle between side and surface",
            "none: shape = 'cone' needs it"),
        number(RSC_KEY(indenter, radius), "length", kPositive,
               "shape = 'punch': radius of its flat end", "none: shape = 'punch' needs it"),
        number(RSC_KEY(indenter, rim_radius), "length", kNotNegative,
               "shape = 'punch': radius of the rounded rim around the flat end; 0: sharp"),
        text(RSC_KEY(indenter, file), 4096,
             "shape = 'map': file with the heights of body 2, positive towards body 1, at the x "
             "and y of body 1 (those of a body that is measured and "
             "then turned over are mirrored: not done here); its centre lies at "
             "indentation%centre, and surface%detrend, missing, outliers, "
             "filter_cutoff, height_unit, coordinate_unit and pixel apply to it, too"),
        text(RSC_KEY(indenter, channel), 1024,
             "shape = 'map': channel or variable of that file, as surface%channel"),
    };
}

std::vector<Key> keys_of_indentation() {
    return {
        choice(RSC_KEY(indentation, boundary), kBoundaryNames,
               "free: the surface ends at its border; periodic: two flats (solids%R = Infinity, "
               "Infinity), surface and contact are periodic"),
        choice(RSC_KEY(indentation, control), kControlNames,
               "quantity given by start, stop and levels; pressure: nominal pressure N/L^2, "
               "periodic boundary only"),
        number(RSC_KEY(indentation, start), "`unit`", kAny, "first level"),
        number(RSC_KEY(indentation, stop), "`unit`", kAny, "last level"),
        number(RSC_KEY(indentation, steps), "1", between(1, 1e6),
               "number of levels, both ends included"),
        choice(RSC_KEY(indentation, unit), kLevelUnitNames,
               "unit of separations: sigma or length; of pressures: relative, p/(E* sqrt(2 m2)), "
               "m2 of both bodies, or pressure; forces have the force unit"),
        choice(RSC_KEY(indentation, spacing), kSpacingNames, "spacing of the levels"),
        list(RSC_KEY(indentation, levels), 10000, "`unit`", kAny,
             "start, stop and steps give the levels",
             "list of levels instead of start, stop and steps"),
        number(RSC_KEY(indentation, centre), "length", kAny, "x and y of the tip of the indenter",
               "the middle of the surface"),
        number(RSC_KEY(indentation, line_reference), "length", kPositive,
               "line contact: distance from the line at which a uniform line load lowers nothing; "
               "separation, stiffness and resistance depend on it. In a real body it is of the "
               "order of its radius or thickness",
               "the side of the surface across the line"),
        choice(RSC_KEY(indentation, selection), kSelectionNames,
               "asperities in the system of equations: all that can touch, or those within "
               "selection_factor times the paper's radius"),
        number(RSC_KEY(indentation, selection_factor), "1", kPositive,
               "factor for selection = 'paper'"),
    };
}

std::vector<Key> keys_of_solver() {
    return {
        choice(RSC_KEY(solver, method), kMethodNames,
               "dgesv: the paper's method; direct, mesh: matrix-free Newton's method, products by "
               "pairs or by fast Fourier transforms"),
        number(RSC_KEY(solver, tolerance), "1", between(1e-14, 0.1),
               "relative residual of F - C<G0 - B F>^(3/2); for dgesv also on |dF|/|F|"),
        number(RSC_KEY(solver, max_iterations), "1", between(1, 1e6),
               "maximum number of Newton steps at a level"),
        number(RSC_KEY(solver, delta0), "sigma", above(0, 1e3),
               "initial regularisation of the paper's method"),
        choice(RSC_KEY(solver, interaction), kInteractionNames,
               "deflection of the surface around an asperity: that of a point force, or none"),

        choice(RSC_KEY(solver, model), kModelNames,
               "asperities: the summits of the surface; elements: boundary elements on every point "
               "of the surface (slower, more accurate). "
               "auto: elements, unless another key needs asperities"),
    };
}

std::vector<Key> keys_of_elements() {
    return {
        number(RSC_KEY(elements, points_per_wave), "1", between(4, 64),
               "grid steps in the shortest wavelength for model = 'elements'; &compare starts with "
               "it and refines the grid until N converges; a "
               "height map is used on its own grid"),
    };
}

std::vector<Key> keys_of_compare() {
    return {
        or_word(
            kCompareNames, [](Case& c) { return slot_of(c.compare.what); },
            list(RSC_KEY(compare, levels), 1000, "`unit` of the indentation", kAny, "",
                 "after the run, solves the level nearest to each of these by elements on the "
                 "first realization, to measure the error of the "
                 "asperity model on this surface. auto: the last level of a single run of the "
                 "program, if elements have at most 2^24 points, and 2^18 under the indenter (a "
                 "sixth of these for a force)")),
    };
}

std::vector<Key> keys_of_output() {
    return {
        changing(Changes::file, text(RSC_KEY(output, file), 4096, "the result file")),
        changing(Changes::file,
                 choice(RSC_KEY(output, format), kFormatNames, "format of the result file")),
        choice(RSC_KEY(output, contacts), kContactsNames,
               "levels whose contacts are written; auto: all levels of a single realization, none "
               "of a campaign"),
        number(RSC_KEY(output, heights), "", kAny, "write the height map to the result"),
        words(choice(RSC_KEY(output, fields), field_names(),
                     "quantities to write at the points of the surface, for a single realization. "
                     "Elements: the pressure and gap of the solution. Asperities: "
                     "the pressure in their contact spots, and the gap that follows from it")),
        list(RSC_KEY(output, field_levels), 1000, "`unit` of the indentation", kAny,
             "the last level",
             "levels whose fields are written, the nearest level to each; with sliding, distances"),
        number(RSC_KEY(output, field_window), "length", kAny,
               "x0, x1, y0, y1 of the region in which fields are written",
               "a region around the contact at these levels; two flats: the whole surface"),
        number(RSC_KEY(output, map_cells), "1", between(1, 4096),
               "cells along a side of the coarse maps"),
        number(RSC_KEY(output, radial_bins), "1", between(1, 100000),
               "number of radii of the radial means"),
        list(RSC_KEY(output, pdf_levels), 100, "sigma", kAny, "",
             "separations at which distributions are written (the nearest level to each)"),
        number(RSC_KEY(output, pdf_bins), "1", between(1, 100000), "bins of the distributions"),
        changing(Changes::file, number(RSC_KEY(output, compression), "1", between(0, 9),
                                       "deflate level of netcdf4")),
    };
}

std::vector<Key> make_registry() {
    std::vector<Key> all;
    for (const auto keys : {keys_of_run, keys_of_solids, keys_of_surface, keys_of_height_maps,
                            keys_of_asperities, keys_of_indenter, keys_of_indentation,
                            keys_of_solver, keys_of_elements, keys_of_compare, keys_of_output})
        for (Key& key : keys()) all.push_back(std::move(key));
    for (const Physics* p : all_physics())
        for (Key& key : p->keys()) {  // at the end of its group
            const auto last = std::find_if(all.rbegin(), all.rend(), [&](const Key& other) {
                return std::string_view(other.group) == key.group;
            });
            all.insert(last.base(), std::move(key));
        }
    return all;
}

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
    {"study",
     "lists of values for any keys; each member of the study is a run: surface%sigma = 0.001, 0.01 "
     " mode = 'product' ('zip')"},
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
    const std::string g = lower_case(group), n = lower_case(name);
    for (const Key& key : registry())
        if (g == key.group && n == lower_case(key.name)) return &key;
    return nullptr;
}

std::string suggest_key(std::string_view group, std::string_view name) {
    std::vector<std::string_view> here;
    for (const Key& key : registry())
        if (lower_case(group) == key.group) here.push_back(key.name);
    for (const Key& key : registry())
        if (find_key(key.group, name))
            return "; '" + std::string(name) + "' belongs to &" + find_key(key.group, name)->group;
    return suggestion(name, here);
}

const Key& key_of(std::string_view name) {
    const auto strip = [](std::string_view s) {
        const std::size_t first = std::min(s.find_first_not_of(' '), s.size());
        return s.substr(first, s.find_last_not_of(' ') + 1 - first);
    };
    const std::size_t percent = name.find('%');
    if (percent == std::string_view::npos) {
        std::string meant;
        for (const Key& key : registry())
            if (lower_case(strip(name)) == lower_case(key.name))
                enlist(meant, " or ", full_name(key));
        bad_input(
            "expected group%key, found '", name, "'",
            meant.empty() ? suggestion(name, group_names()) : "; did you mean " + meant + "?");
    }
    const std::string_view group = strip(name.substr(0, percent)),
                           bare = strip(name.substr(percent + 1));
    if (!group_meaning(lower_case(group)))
        bad_input("unknown group '", group, "'", suggestion(group, group_names()));
    const Key* const key = find_key(group, bare);
    if (!key) bad_input("unknown key '", bare, "'", suggest_key(group, bare));
    return *key;
}

std::string full_name(const Key& key) { return joined(key.group, "%", key.name); }

bool Bounds::hold(double value) const {
    if (std::isnan(value) || (std::isinf(value) && !infinity) || (nonzero && value == 0))
        return false;
    return (open ? value > low : value >= low) && value <= high;
}

std::string Bounds::text() const {
    const auto number = [](double value) {
        if (value == std::floor(value) && std::abs(value) < 1e15)
            return std::to_string(static_cast<long long>(value));
        return from_real(value);
    };
    std::string result = nonzero ? "not 0" : "";
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
