#include "physics/adhesion/adhesion.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "elements/element_model.hpp"
#include "elements/pixel_spots.hpp"
#include "physics/adhesion/adhesive_contact.hpp"
#include "physics/adhesion/adhesive_elements.hpp"
#include "physics/adhesion/sticking.hpp"

namespace rsc {
namespace {

std::vector<Key> adhesion_keys() {
    using namespace keys;
    return {
        number(RSC_KEY(solids, adhesion), "force/length", kNotNegative,
               "work of adhesion w; above 0 forces may be negative, and each level depends on the "
               "levels before it"),
        number(RSC_KEY(solids, adhesion_range), "length", kNotNegative,
               "range z0 of the attraction, a constant traction w/z0 across gaps below z0 "
               "(Dugdale); 0: attraction of zero range (JKR), by asperities or elements"),
    };
}

void check_adhesion(const Case& settings, const Complain& complain) {
    if (settings.solids.adhesion_range > 0 && !(settings.solids.adhesion > 0))
        complain({"solids%adhesion_range", "solids%adhesion"}, "needs solids%adhesion > 0");
}

// Of the smallest force, at the level that has it.
double error_at_least_force(const LevelValues& level, std::size_t) {
    const bool here = level.force < 0 && level.force <= level.least_force;
    return here ? error_of_least_force({&level, 1}) : kNotComputed;
}

std::vector<LevelQuantity> adhesion_quantities() {
    using V = LevelValues;
    return {
        {.name = "jumps",
         .member = &V::jumps,
         .meaning = "number of jumps since the previous level",
         .comment = "adhesion: a contact forms or breaks at one separation, including the "
                    "avalanche that it "
                    "triggers; boundary elements: connected sets of at least 8 points that began "
                    "or ceased to "
                    "attract and dissipated more than a tenth of w times their area between the "
                    "two levels; "
                    "steps short beside adhesion_range tell jumps from smooth changes",
         .always = false,
         .written_with = &V::least_force},
        {.name = "least_force",
         .member = &V::least_force,
         .force_power = 1,
         .meaning = "smallest force since the first level",
         .comment = "adhesion: including forces between levels; pull_off_force is its last value",
         .own_error = error_at_least_force,
         .always = false,
         .least = "pull_off_force",
         .least_meaning = "smallest force since the first level",
         .least_comment = "adhesion: including forces between levels; negative if separating the "
                          "bodies takes a tensile force; missing if a level has no state"},
        {.name = "cohesive_area",
         .member = &V::cohesive_area,
         .length_power = 2,
         .meaning = "area that attracts without touching",
         .comment = "adhesion with a range: gaps above 0 and below adhesion_range",
         .always = false},
        {.name = "cohesive_resolution",
         .member = &V::cohesive_resolution,
         .meaning = "length over which the attraction acts at edges of contact, (pi/4) E* "
                    "adhesion_range^2/adhesion, over the side of a pixel",
         .comment = "boundary elements: the error of the pull-off force is of first order in its "
                    "inverse; 4 or more is wanted",
         .always = false},
    };
}

// The range of attraction up to which JKR is valid.
void print_tabor(std::ostream& out, const RunFacts& run) {
    // JKR holds from a Tabor parameter of 5 on.
    const Case::Solids& s = run.settings.solids;
    const auto reach = [&](double radius) {
        return std::cbrt(radius * std::pow(s.adhesion / run.indenter.E_star, 2));
    };
    const double summit = run.summit_radius, R = run.indenter.shape->hertz_radius(),
                 range = s.adhesion_range;
    const char* const l = run.settings.run.length_unit.c_str();
    if (!(summit > 0)) return;
    if (range > 0)
        out << format(
            "  Tabor's parameter (JKR from 5 on, DMT below 0.1): %.3g for summits of mean radius "
            "(%.3g %s)",
            reach(summit) / range, summit, l);
    else
        out << format(
            "  JKR (adhesion_range = 0) is valid for summits of mean radius (%.3g %s) if the "
            "range of the attraction is at most %.3g %s (Tabor's parameter 5)",
            summit, l, reach(summit) / 5, l);
    if (std::isfinite(R))
        out << (range > 0 ? format("; %.3g for a smooth sphere", reach(R) / range)
                          : format("; for a smooth sphere at most %.3g %s", reach(R) / 5, l));
    out << ".\n";
}

// Whether two flats with this surface would stick.
void print_stickiness(std::ostream& out, const RunFacts& run) {
    const Case::Solids& s = run.settings.solids;
    const double range = s.adhesion_range;
    if (!(run.theory && range > 0) || run.indenter.layers.count > 0) return;
    // Pastewka and Robbins, PNAS 111, 3298 (2014), with kappa_rep = 2, d_rep = 4 h'/h'': h'
    // range/(2 l_a) (h'^2/(h'' range))^(2/3) < pi (3/16)^(2/3), l_a = w/E*, rms slope h', rms
    // curvature h'' (rms of the sum of both second derivatives).
    const double slope = std::sqrt(2 * run.theory->m2),
                 curvature = std::sqrt(8.0 / 3 * run.theory->m4);
    const double needed = 1 / (2 * 1.03) * run.indenter.E_star * slope * range *
                          std::pow(slope * slope / (curvature * range), 2.0 / 3);
    out << format(
        "  two flats with this surface %s (Pastewka and Robbins 2014): it needs w above about "
        "%.2g %s/%s.\n",
        s.adhesion > needed ? "would stick" : "would not stick", needed,
        run.settings.run.force_unit.c_str(), run.settings.run.length_unit.c_str());
}

void print_sticking(std::ostream& out, const RunFacts& run) {
    const auto& levels = run.levels;
    if (levels.empty()) return;
    long jumps = 0;
    double lost = 0, least = 0, attracting = 0;
    const LevelValues* smallest = nullptr;
    for (const LevelValues& level : levels) {
        if (level.least_force < least) smallest = &level;
        attracting = std::fmax(attracting, level.area + level.cohesive_area);
        jumps += level.jumps;
        lost = std::fmax(lost, level.energy_lost);
        least = std::fmin(least, level.least_force);
    }
    std::string how;
    if (run.elements)
        how = format(" (steps that lose less than %.1g count as reversible)",
                     loss_share(run.settings.solids.adhesion_range) * run.settings.solids.adhesion *
                         attracting);
    const auto& units = run.settings.run;
    const bool without_state =
        std::ranges::any_of(levels, [](const LevelValues& l) { return std::isnan(l.force); });
    if (units.realizations == 1 && without_state)
        out << "  adhesion: the smallest force is not known, because levels have no state.\n";
    else if (units.realizations == 1) {
        const bool apart = levels.back().contacts == 0;
        const double error = least < 0 ? error_of_least_force(levels) : kNotComputed;
        out << format(
            "  adhesion: the smallest force is %.4g %s%s%s; the bodies are %s at the last level; "
            "jumps: %ld, energy lost: %.4g %s %s%s. Results depend on the loading history.\n",
            least, units.force_unit.c_str(),
            error > 0 ? joined(" +- ", percent(error)).c_str() : "",
            smallest ? (" (" + run.place_of(*smallest) + ")").c_str() : "",
            apart ? "separated" : "still attached", jumps, lost, units.force_unit.c_str(),
            units.length_unit.c_str(), how.c_str());
    }
    print_tabor(out, run);
    print_stickiness(out, run);
}

// The work of adhesion that closes all gaps of the roughness, so that the contacts of asperities
// merge, at most: the elastic energy that flattens the roughness, for each unit of area (E*/4)
// sigma^2 times the mean wavenumber <q> (Persson and Tosatti, 2001), with <q>^2 <= <q^2>.
double flattening_work(double E_star, double sigma, const Moments& theory) {
    return 0.25 * E_star * sigma * theory.rms_slope();
}

// With layers no such bound is known.
void require_separate_contacts(const PreparedFacts& facts) {
    if (!facts.theory || facts.indenter.layers.count > 0) return;
    const double flat = flattening_work(facts.indenter.E_star, facts.sigma, *facts.theory);
    if (const double w = facts.settings.solids.adhesion; w >= flat)
        bad_input(
            format("solids%%adhesion = %g: more than the elastic energy that flattens the "
                   "roughness, at most E* sigma h'/4 = %.3g for each unit of area; the contacts of "
                   "asperities merge, and asperities do not hold; give solver%%model = 'elements'",
                   w, flat));
}

// Without a range, `auto` leaves hard rough surfaces, whose contacts stay apart, to asperities:
// edges of their small contacts would need fine grids.
const char* why_asperities_adhere(const Case& c) {
    const Case::Solids& s = c.solids;
    if (s.adhesion_range > 0 || c.surface.source != Source::synthetic) return "";
    const Spectrum spectrum = self_affine_spectrum(c);
    double compliance = 0;
    for (const int body : {0, 1}) compliance += (1 - s.nu[body] * s.nu[body]) / s.E[body];
    const double flat =
        flattening_work(1 / compliance, spectrum.sigma, theoretical_moments(spectrum));
    return s.adhesion >= flat ? "" : "its adhesion leaves the contacts of asperities separate";
}

void require_feasible(const PreparedFacts& facts) {
    if (!facts.elements) return require_separate_contacts(facts);
    const Case::Solids& s = facts.settings.solids;
    if (!(s.adhesion_range > 0)) return;
    require_resolved(facts.indenter.E_star, {s.adhesion, s.adhesion_range}, facts.side);
}

bool has_range(const Combination& c) { return c.bodies.of<Adhesion>().range > 0; }

std::unique_ptr<Model> make_elements_that_attract(const HeightMap& heights,
                                                  const Indenter& indenter,
                                                  const SolverOptions& options) {
    return make_adhesive_elements(require_elements(heights, indenter, options), indenter, options);
}

}  // namespace

const Physics kAdhesion = {
    .name = "adhesion",
    .key = "solids%adhesion",
    .keys = adhesion_keys,
    .take =
        [](const Case& c, BodyPhysics& bodies) {
            bodies.of<Adhesion>() = {c.solids.adhesion, c.solids.adhesion_range};
        },
    .asked = [](const BodyPhysics& bodies) { return bodies.of<Adhesion>().work > 0; },
    .excludes = {{"hardness"},
                 {"friction"},
                 {"relaxation"},
                 {"asperities%law", "the law does not say how its contacts widen",
                  [](const Combination& c) {
                      return !c.elements && !capabilities_of(c.law).widening;
                  }},
                 {"asperities%law",
                  "with adhesion_range > 0 it must be the law of a paraboloid, 'hertz' or "
                  "'elliptic'",
                  [](const Combination& c) {
                      return has_range(c) && !c.elements && !capabilities_of(c.law).paraboloid;
                  }},
                 {"solver%method", "'dgesv' has no tensile forces",
                  [](const Combination& c) { return c.method == Method::dgesv; }},
                 {"indentation%selection", "asperities beyond the circle of 'paper' attract, too",
                  [](const Combination& c) { return c.selection == Selection::paper; }},
                 {"indentation%boundary",
                  "the edges of adhesive contacts are followed on bodies of finite size and "
                  "between two flats, not along a line",
                  [](const Combination& c) { return c.line; }}},
    .check = check_adhesion,
    .needs_asperities = why_asperities_adhere,
    .path = "attached spots (solids adhesion) remain attached until pull-off",
    .quantities = adhesion_quantities(),
    .pulls = true,
    .require_feasible = require_feasible,
    .compares_itself = [](const Case&) { return false; },
    .grid_error = adhesion_grid_error,
    .doubts_range = adhesion_range_in_doubt,
    .bytes_per_point = 49,
    .remark = print_sticking,
    .asperities = make_adhesive_asperities,
    .elements = make_elements_that_attract,
};

}  // namespace rsc
