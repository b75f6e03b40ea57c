#include "contact/quantities.hpp"

#include "base/error.hpp"
#include "case/case.hpp"
#include "case/units.hpp"
#include "contact/answers.hpp"
#include "physics/physics.hpp"

namespace rsc {
namespace {

using V = LevelValues;

bool of_flats(const Case& c) { return c.indentation.boundary == Boundary::periodic; }
bool of_lines(const Case& c) { return c.indentation.line(); }
bool has_resistivity(const Case& c) {
    return c.solids.resistivity[0] + c.solids.resistivity[1] > 0;
}

constexpr LevelQuantity kRows[] = {
    {.name = "separation",
     .member = &V::separation,
     .length_power = 1,
     .meaning = "separation of the indenter's tip from the mean plane, Z0",
     .error_member = &V::separation_error_expected,
     .separate = true},
    {.name = "force",
     .member = &V::force,
     .force_power = 1,
     .meaning = "normal force, N",
     .comment = "N = sum of the forces f of the contacts",
     .error_member = &V::force_error_expected,
     .statistics = true,
     .plain = "force",
     .heading = "N",
     .width = 14,
     .digits = 8},
    {.name = "contact_area",
     .member = &V::area,
     .length_power = 2,
     .meaning = "true contact area, A",
     .comment = "law 'hertz': sum of pi a^2 over the contacts; 'elliptic' and 'fourth_order': area "
                "of the union of their elliptic spots; boundary elements: area of the pixels under "
                "pressure, corrected at borders below the hardness",
     .error_member = &V::area_error_expected,
     .statistics = true,
     .plain = "contact area",
     .heading = "A",
     .width = 14,
     .digits = 8},
    {.name = "contact_area_pixels",
     .member = &V::area_pixels,
     .length_power = 2,
     .meaning = "area of the pixels under pressure, without border correction",
     .comment = "boundary elements: contact_area is smaller by (pi - 1 + ln 2)/24 of a pixel for "
                "each pixel side on the border; yielding borders: see src/elements/pixel_spots.hpp",
     .always = false},
    {.name = "pressure",
     .member = &V::pressure,
     .length_power = -2,
     .force_power = 1,
     .meaning = "nominal pressure between two flats, N/A0",
     .always = false,
     .shown = of_flats,
     .statistics = true,
     .plain = "pressure",
     .heading = "p",
     .width = 14,
     .digits = 6},
    {.name = "area_fraction",
     .member = &V::area_fraction,
     .meaning = "ratio of true to nominal contact area of two flats, A/A0",
     .always = false,
     .shown = of_flats,
     .statistics = true,
     .plain = "area fraction",
     .heading = "A/A0",
     .width = 10,
     .digits = 6},
    {.name = "force_per_length",
     .member = &V::force_per_length,
     .length_power = -1,
     .force_power = 1,
     .meaning = "force per length of a line contact, N/L",
     .always = false,
     .shown = of_lines,
     .statistics = true,
     .plain = "force per length",
     .heading = "N/L",
     .width = 14,
     .digits = 6},
    {.name = "contacts",
     .member = &V::contacts,
     .meaning = "number of contacts",
     .heading = "contacts",
     .width = 9},
    {.name = "candidates",
     .member = &V::candidates,
     .meaning = "number of asperities or pixels passed to the solver",
     .heading = "candidates",
     .width = 10},
    {.name = "iterations",
     .member = &V::iterations,
     .meaning = "Newton iterations; boundary elements: number of active sets tried",
     .heading = "steps",
     .width = 5},
    {.name = "residual",
     .member = &V::residual,
     .meaning = "relative residual of F - C<G0 - B F>^(3/2)",
     .comment =
         "without regularisation, over all candidates; boundary elements: rms of the gap under "
         "pressure and of remaining penetrations, relative to the mean overlap under pressure",
     .heading = "residual",
     .width = 9},
    {.name = "certificate",
     .member = &V::certificate,
     .meaning = "largest violation of the contact conditions by the returned pressures",
     .comment =
         "boundary elements, recomputed in double precision: the largest of the penetration "
         "and of the gap under pressure (relative to the mean overlap under pressure), of "
         "the complementarity sum p gap (relative to sum p overlap), and of the difference "
         "of the prescribed force. It tells how well the discrete problem is solved, not how "
         "far that is from the continuous one",
     .always = false},
    {.name = "status",
     .member = &V::status,
     .meaning = "outcome of the level",
     .comment = "1: some doubt (doubts); 2: contacts overlap, d < a_i + a_j; 3: a local minimum of "
                "the energy, possibly not unique; 4: not converged, do not use. 4 overrides all "
                "others, 1 overrides 2 and 3, 3 overrides 2",
     .heading = "status",
     .width = 0},
    {.name = "doubts",
     .member = &V::doubts,
     .meaning = "what limits the level; 0: nothing that is known"},
    {.name = "method",
     .member = &V::method,
     .meaning = "solver that found the solution",
     .comment = "fallback gives the reason if it is not the requested one"},
    {.name = "fallback",
     .member = &V::fallback,
     .meaning = "reason why the requested solver was not used",
     .comment =
         "solver%method = 'dgesv': 2: the paper's iteration did not reach the tolerance; 3: its "
         "matrix was singular; 4: it converged, but its solution could not be proved to be unique; "
         "'mesh': 1: there is no interaction; adhesion: 5: no state has the requested force, and "
         "the level is the last stable state, that of the smallest force; 6: at this separation "
         "the force jumps over the requested one, because contacts so close that they have several "
         "solutions change together; the level is the state at one side of the jump"},
    {.name = "products",
     .member = &V::products,
     .meaning = "matrix-vector products with the interaction matrix B (direct, mesh), or linear "
                "systems solved (dgesv)"},
    {.name = "overlapping_pairs",
     .member = &V::overlapping_pairs,
     .meaning = "pairs of contacts with d < a_i + a_j"},
    {.name = "pressure_max",
     .member = &V::pressure_max,
     .length_power = -2,
     .force_power = 1,
     .meaning = "largest pressure at a point",
     .comment = "asperities: the largest of Hertz's pressures, elastic bodies only",
     .always = false,
     .statistics = true,
     .plain = "largest pressure"},
    {.name = "pixels_per_contact",
     .member = &V::pixels_per_contact,
     .unit = "1",
     .meaning = "number of pixels per contact (boundary elements), median weighted by area",
     .comment = "half of the contact area belongs to contacts with at most this number of pixels; "
                "contacts of few pixels are inaccurate",
     .always = false},
    {.name = "border_share",
     .member = &V::border_share,
     .unit = "1",
     .meaning = "sides of pixels on the borders of contacts over pixels in contact",
     .comment =
         "boundary elements; of two flats over the pixels of the gap if these are fewer; 2.5 "
         "over the radius in pixels of a round contact. Expected "
         "errors grow with powers of it",
     .always = false},
    {.name = "border_runs",
     .member = &V::border_runs,
     .unit = "1",
     .meaning =
         "root of the sum of the squares of the lengths of the straight parts of the borders "
         "of contacts, in pixels, over pixels in contact",
     .comment = "boundary elements, as border_share: a straight part is known to half a pixel, and "
                "the errors of different parts of the contact area cancel on average",
     .always = false},
    {.name = "force_error_expected",
     .member = &V::force_error_expected,
     .unit = "1",
     .meaning = "expected relative error of the force at the separation",
     .comment = "not exceeded in nine of ten cases. Asperities: difference from boundary elements "
                "(calibrated: input/trust); elements: from border_share and "
                "from crests between the points; with adhesion from cohesive_resolution. Times "
                "|force| it is the error of the force. Missing without contact, under a prescribed "
                "force, and where nothing was calibrated (doubts)",
     .always = false},
    {.name = "area_error_expected",
     .member = &V::area_error_expected,
     .unit = "1",
     .meaning = "expected relative error of the contact area",
     .comment =
         "as force_error_expected; under a prescribed force that of the area under this force",
     .always = false},
    {.name = "separation_error_expected",
     .member = &V::separation_error_expected,
     .length_power = 1,
     .meaning = "expected error of the separation under a prescribed force, a length",
     .comment = "as force_error_expected: the error of N over the stiffness",
     .always = false},
    {.name = "slope_ratio",
     .member = &V::slope_ratio,
     .unit = "1",
     .meaning = "largest slope of the indenter at a contact over the rms slope of the surface, "
                "with a lay sqrt(2) times that along it",
     .comment = "above 0.2 the surface also touches beside its summits, and no error is stated",
     .always = false},
    {.name = "indenter_slope",
     .member = &V::indenter_slope,
     .unit = "1",
     .meaning = "rms slope of the face of body 2 over the contacts, weighted by the forces",
     .comment = "above 0.5 slopes are not small, as the theory of both models assumes: no error is "
                "stated",
     .always = false},
    {.name = "filled_share",
     .member = &V::filled_share,
     .unit = "1",
     .meaning = "share of the contact area on filled points of the map (far from measured ones), "
                "or, if larger, the share expected there for Gaussian heights",
     .always = false},
    {.name = "large_contacts",
     .member = &V::large_contacts,
     .meaning = "contacts with a > <d>/4",
     .comment = "<d> = 1/sqrt(density of summits); such contacts are not small compared with the "
                "distances between them"},
    {.name = "wide_contacts",
     .member = &V::wide_contacts,
     .meaning = "share of the contacts with a > h/5, h the top layer's thickness",
     .comment =
         "layered bodies: the effect of layers on an asperity is computed to first order in a/h",
     .always = false},
    {.name = "beyond_law",
     .member = &V::beyond_law,
     .meaning = "contacts beyond the validity of the contact law",
     .comment =
         "asperities law = 'fourth_order': penetration beyond 4 F2 kappa/q^2, kappa = sqrt(kappa1 "
         "kappa2), q^2 = asperity_biharmonic/(kappa1 + kappa2): the contact has reached the trough "
         "around the summit; beyond, its radius and stiffness are constant; 0 for the other laws"},
    {.name = "edge_contacts",
     .member = &V::edge_contacts,
     .meaning = "contacts within <d> of the border of a free surface",
     .comment = "the load is too small, because there are no asperities beyond the border"},
    {.name = "nominal_area",
     .member = &V::nominal_area,
     .length_power = 2,
     .meaning = "nominal area under the sphere, or of two flats",
     .comment = "the smallest disc about the tip that contains all contacts (boundary elements: "
                "all pixels under pressure), at most the area of the surface; two flats: A0"},
    {.name = "energy_lost",
     .member = &V::energy_lost,
     .length_power = 1,
     .force_power = 1,
     .meaning = "energy dissipated since the first level, by relaxation or in jumps",
     .comment =
         "relaxation: energy + energy_lost is the work done, int N d(-Z0); adhesion: over a "
         "cycle, the area of the hysteresis loop of N and Z0 (boundary elements: a step that "
         "loses less than 0.1 % of w times the attracting area counts as reversible)",
     .always = false,
     .statistics = true,
     .plain = "energy lost"},
    {.name = "extreme_area_fraction",
     .member = &V::extreme_area_fraction,
     .meaning = "share of the contact area with a mean pressure above E*/10",
     .comment = "of contacts; boundary elements: of pixels. No metal is elastic at such pressures: "
                "solids%hardness limits them"},
    {.name = "crowded_cells",
     .member = &V::crowded_cells,
     .meaning = "number of map cells with an area fraction above pi/16",
     .comment = "above 19.6 % interaction by point forces is inaccurate",
     .of_map = true},
    {.name = "contacts_outside_map",
     .member = &V::outside_map,
     .meaning = "contacts outside the map, included in force and contact_area but in no cell",
     .of_map = true},
    {.name = "stiffness",
     .member = &V::stiffness,
     .length_power = -1,
     .force_power = 1,
     .meaning = "derivative of the force with respect to the separation, dN/dZ0",
     .comment =
         "boundary elements with adhesion: at fixed attracting points, as in small oscillations",
     .compute = compute_stiffness,
     .always = false,
     .statistics = true,
     .plain = "stiffness"},
    {.name = "energy",
     .member = &V::energy,
     .length_power = 1,
     .force_power = 1,
     .meaning = "elastic energy of the contact, W",
     .comment = "dW/dZ0 = -N",
     .always = false,
     .statistics = true,
     .plain = "elastic energy"},
    {.name = "lateral_force",
     .member = &V::lateral_x,
     .y = &V::lateral_y,
     .force_power = 1,
     .meaning = "lateral force on the indenter at fixed separation",
     .comment = "-dW/dx0 and -dW/dy0: lateral components of the normal forces of the contacts, "
                "without friction",
     .compute = compute_lateral_force,
     .always = false,
     .statistics = true,
     .plain = "lateral force"},
    {.name = "moment",
     .member = &V::moment_x,
     .y = &V::moment_y,
     .length_power = 1,
     .force_power = 1,
     .meaning = "moment of the contact forces on the indenter about its tip",
     .comment = "about the axes x and y through the tip",
     .compute = compute_moment,
     .always = false,
     .statistics = true,
     .plain = "moment about the tip"},
    {.name = "conductance_length",
     .member = &V::conductance_length,
     .length_power = 1,
     .meaning = "conductance of the contact times the sum of the resistivities, -2 (dN/dZ0)/E* at "
                "fixed contact areas",
     .comment = "electrical or thermal (Barber 2003); 4 a for a single spot",
     .compute = compute_conductance,
     .always = false,
     .statistics = true,
     .plain = "conductance length"},
    {.name = "conductance_per_area",
     .member = &V::conductance_per_area,
     .length_power = -1,
     .meaning = "conductance of two flats per nominal area times the sum of the resistivities",
     .comment = "conductance_length/A0: divided by the sum of the thermal (electrical) "
                "resistivities the heat flux for a difference of temperatures of 1",
     .compute = compute_conductance_per_area,
     .always = false,
     .statistics = true,
     .plain = "conductance per area"},
    {.name = "resistance",
     .member = &V::resistance,
     .unit = "ohm",
     .meaning = "constriction resistance of the contact",
     .comment =
         "sum of solids%resistivity [ohm times run%length_unit] over conductance_length; thermal "
         "resistivities [K/W times run%length_unit] make it K/W; absent without contact",
     .compute = compute_resistance,
     .always = false,
     .shown = has_resistivity,
     .answers = true,
     .statistics = true,
     .plain = "constriction resistance",
     .heading = "resistance",
     .width = 18,
     .digits = 5},
};

// Names of components by their number.
constexpr const char* kComponents[][4] = {
    {""}, {"_x", "_y"}, {"_xx", "_yy", "_xy"}, {"_xx", "_yy", "_xy", "_yx"}};

std::vector<LevelQuantity> make_quantities() {
    std::vector<LevelQuantity> all(std::begin(kRows), std::end(kRows));
    // Those of physics come after N, A and what follows from them.
    auto place = std::ranges::find(all, std::string_view("contacts"), &LevelQuantity::name);
    for (const Physics* p : all_physics())
        place = all.insert(place, p->quantities.begin(), p->quantities.end()) +
                std::ssize(p->quantities);
    std::size_t slots = 0;
    for (LevelQuantity& q : all) {
        q.slot = slots;
        slots += q.components();
    }
    if (slots > kMostComponents) throw Error(Failure::internal, "too many quantities of a level");
    return all;
}

}  // namespace

double LevelQuantity::of(const LevelValues& level, std::size_t component) const {
    if (component > 0) return level.*(component == 1 ? y : component == 2 ? z : yx);
    return std::visit([&](auto m) { return double(level.*m); }, member);
}

void LevelQuantity::put(LevelValues& level, double value, std::size_t component) const {
    if (component > 0) {
        level.*(component == 1 ? y : component == 2 ? z : yx) = value;
        return;
    }
    std::visit(
        [&](auto m) { level.*m = static_cast<std::remove_reference_t<decltype(level.*m)>>(value); },
        member);
}

double LevelQuantity::error(const LevelValues& level, std::size_t component) const {
    return error_member ? level.*error_member : level.errors[slot + component];
}

std::string LevelQuantity::unit_in(const std::string& length, const std::string& force,
                                   const std::string& time) const {
    if (unit) return std::string(unit) == "time" ? time : unit;
    return unit_of(length, length_power, force, force_power) +
           (per_time ? " " + unit_of(time, -1) : "");
}

std::string LevelQuantity::error_name() const {
    if (error_member)
        for (const LevelQuantity& q : level_quantities())
            if (q.member == Member(error_member)) return q.name;
    return name + std::string("_error_expected");
}

std::span<const LevelQuantity> level_quantities() {
    static const std::vector<LevelQuantity> all = make_quantities();
    return all;
}

std::optional<QuantityComponent> find_quantity(std::string_view name) {
    for (const LevelQuantity& q : level_quantities())
        for (const auto c : indices(q.components()))
            if (!q.of_map && name.starts_with(q.name) &&
                name.substr(std::strlen(q.name)) == kComponents[q.components() - 1][c])
                return QuantityComponent{&q, c};
    return std::nullopt;
}

std::string names_of_quantities() {
    std::string names;
    for (const LevelQuantity& q : level_quantities())
        for (std::size_t c = 0; c < q.components() && !q.of_map; ++c)
            enlist(names, ", ", std::string(q.name) + kComponents[q.components() - 1][c]);
    return names;
}

double error_of_least_force(std::span<const LevelValues> levels) {
    const auto least = std::ranges::min_element(levels, {}, [](const LevelValues& level) {
        return std::isnan(level.force) ? kInfinity : level.force;
    });
    if (least == levels.end()) return kNotComputed;
    const auto breaks_early = [](const LevelValues& level) {
        return level.contacts > 0 && level.status == LevelStatus::out_of_validity;
    };
    if (std::any_of(least + 1, levels.end(), breaks_early)) return kNotComputed;
    if (least->force_error_expected >= 0) return least->force_error_expected;
    return least->separation_error_expected * std::abs(least->stiffness / least->force);
}

void compute_quantities(LevelSource& source, const Case* run) {
    if (std::isnan(source.level.force)) return;  // there is no state
    for (const LevelQuantity& q : level_quantities())
        if (q.compute && (!q.in_run || (run && q.in_run(*run)))) (void)q.compute(source);
}

}  // namespace rsc
