// The first half of the table: what the file is, its axes, the levels, the surfaces, closed forms.
#include <cmath>
#include <limits>

#include "file/netcdf_table.hpp"
#include "observe/regimes.hpp"
#include "version.h"

namespace rsc {
namespace {

const char* const kPaper =
    "V. A. Yastrebov, The Elastic Contact of Rough Spheres Investigated Using a Deterministic Multi-Asperity Model, "
    "Journal of Multiscale Modelling (2018)";

}  // namespace

void ResultTable::global_attributes(const std::string& history) {
    file_.attribute("Conventions", "CF-1.10");
    file_.attribute("title", r_.title.empty() ? "Elastic contact of a rough sphere" : r_.title);
    file_.attribute("source", "rsc " RSC_VERSION ", deterministic multi-asperity model of rough spheres in elastic contact");
    file_.attribute("history", history);
    file_.attribute("references", kPaper);
    file_.attribute("comment",
                    "Indices in this file (start_index = 1) count from 1. The effective namelist in the attribute `case` "
                    "makes this file again, "
                    "equal but for the attribute `history`.");
    file_.attribute("case", r_.case_text);
    if (r_.seed >= std::numeric_limits<std::int32_t>::min() && r_.seed <= std::numeric_limits<std::int32_t>::max())
        file_.attribute("seed", std::vector<std::int32_t>{static_cast<std::int32_t>(r_.seed)});
    else  // the classic data model has no longer integers
        file_.attribute("seed", std::to_string(r_.seed));
}

void ResultTable::axes() {
    file_.dimension("realization", o_.realizations);
    file_.dimension("step", o_.steps);
    std::vector<std::int32_t> realization, step;
    for (std::int64_t k : o_.realization) realization.push_back(clamped(k));
    for (std::size_t s = 1; s <= o_.steps; ++s) step.push_back(static_cast<std::int32_t>(s));
    add("realization", {"realization"}, "1", "number of the realization", realization,
        comment("realization k of a seed is the same surface in every case"));
    add("step", {"step"}, "1", "number of the level", step);

    const Names dims = r_.force_control ? Names{"realization", "step"} : Names{"step"};
    std::vector<double> separation = of_rows<double>([](const LevelRow& row) { return row.separation; });
    if (!r_.force_control) separation.resize(o_.steps);  // the same in every realization
    std::vector<double> scaled = separation;
    for (double& z : scaled) z /= r_.sigma;
    add("separation", dims, unit(1), "separation of the sphere's tip from the mean plane, Z0", separation);
    add_absent("separation_sigma", dims, "1", "separation over rms height, Z0/sigma", scaled, "sigma is sigma_reference");
}

void ResultTable::levels() {
    const Names dims{"realization", "step"};
    const auto integers = [&](const std::string& name, const std::string& long_name, auto get, NetcdfAttributes attributes = {}) {
        add(name, dims, "1", long_name, of_rows<std::int32_t>(get), std::move(attributes));
    };
    add("force", dims, unit(0, 1), "normal force on the sphere, N", of_rows<double>([](const LevelRow& l) { return l.force; }),
        comment("N = sum of the forces f of the contacts"));
    add("contact_area", dims, unit(2), "true contact area, A", of_rows<double>([](const LevelRow& l) { return l.area; }),
        comment("law 'hertz': sum of pi a^2 over the contacts; 'elliptic' and 'fourth_order': area of the union of their elliptic spots"));
    integers("contacts", "number of asperities in contact", [](const LevelRow& l) { return l.contacts; });
    integers("candidates", "number of asperities given to the solver", [](const LevelRow& l) { return l.candidates; });
    integers("iterations", "Newton iterations", [](const LevelRow& l) { return l.iterations; });
    add("residual", dims, "1", "relative residual of F - C<G0 - B F>^(3/2)", of_rows<double>([](const LevelRow& l) { return l.residual; }),
        comment("unregularised, over all candidates: it says whether the forces are right"));
    integers(
        "status", "how the level ended", [](const LevelRow& l) { return l.status; },
        {{"flag_values", std::vector<std::int32_t>{0, 1, 2, 3, 4}},
         {"flag_meanings", "converged out_of_validity overlapping not_unique not_converged"},
         {"comment",
          "1: contacts with a > <d>/4 or beyond the law (large_contacts, beyond_law); 2: contacts overlap, d < a_i + a_j; 3: a local minimum of the energy, perhaps not the "
          "only one; "
          "4: do not use. The larger is the more serious and hides the smaller"}});
    integers("method", "solver used", [](const LevelRow& l) { return l.method; },
             {{"flag_values", std::vector<std::int32_t>{1, 2, 3}}, {"flag_meanings", "dgesv direct mesh"}});
    integers("products", "products with the interaction matrix B (direct, mesh) or solves (dgesv)",
             [](const LevelRow& l) { return clamped(l.products); });
    integers("overlapping_pairs", "pairs of contacts with d < a_i + a_j", [](const LevelRow& l) { return clamped(l.overlapping_pairs); });
    integers(
        "large_contacts", "contacts with a > <d>/4", [](const LevelRow& l) { return l.large_contacts; },
        comment("<d> = 1/sqrt(density of summits); beyond it a contact is no longer small against its distance from the next"));
    integers(
        "beyond_law", "contacts past the range in which the law describes a summit",
        [](const LevelRow& l) { return clamped(l.beyond_law); },
        comment("asperities law = 'fourth_order': penetration beyond 4 F2 kappa/q^2, kappa = sqrt(kappa1 kappa2), q^2 = "
                "asperity_biharmonic/(kappa1 + kappa2): the contact has reached the trough around the summit; from there its "
                "radius stays and the stiffness with it; 0 for the other laws"));
    integers(
        "crowded_cells", "cells of the map with an area fraction above pi/16", [](const LevelRow& l) { return l.crowded_cells; },
        comment("19.6 %: beyond it point forces do not describe the interaction well"));
    integers("contacts_outside_map", "contacts outside the map: in force and contact_area, in no cell",
             [](const LevelRow& l) { return l.outside_map; });
    const std::vector<double> stiffness = of_rows<double>([](const LevelRow& l) { return l.stiffness; });
    bool computed = false;
    for (double k : stiffness) computed = computed || !std::isnan(k);
    if (computed) add_absent("stiffness", dims, unit(-1, 1), "derivative of the force by the separation, dN/dZ0", stiffness);
}

void ResultTable::means() {
    const std::string deviation = "divisor M - 1 for M realizations";
    if (r_.force_control) add("separation_mean", {"step"}, unit(1), "mean separation over realizations", o_.separation_mean);
    add("force_mean", {"step"}, unit(0, 1), "mean force over realizations", o_.force_mean);
    add_absent("force_std", {"step"}, unit(0, 1), "standard deviation of the force over realizations", o_.force_std, deviation);
    add("contact_area_mean", {"step"}, unit(2), "mean contact area over realizations", o_.area_mean);
    add_absent("contact_area_std", {"step"}, unit(2), "standard deviation of the contact area over realizations", o_.area_std, deviation);
}

void ResultTable::surfaces() {
    const Names dims{"realization"};
    const std::string origin = r_.theory ? "exact sum over the modes drawn" : "finite differences on the grid of heights";
    add_absent("sigma", dims, unit(1), "rms height of the surface", of_surfaces([](const auto& s) { return s.sigma; }));
    add_absent("m2", dims, "1", "second profile moment: half the mean square gradient", of_surfaces([](const auto& s) { return s.m2; }),
               origin);
    add_absent("m4", dims, unit(-2), "fourth profile moment: mean square profile curvature",
               of_surfaces([](const auto& s) { return s.m4; }), origin + ", (m40 + m04 + 3 m22)/3");
    add_absent("m2_grid", dims, "1", "second profile moment from finite differences", of_surfaces([](const auto& s) { return s.m2_grid; }),
               "its distance from m2 says how well the grid resolves the shortest waves");
    add_absent("m4_grid", dims, unit(-2), "fourth profile moment from finite differences",
               of_surfaces([](const auto& s) { return s.m4_grid; }),
               "its distance from m4 says how well the grid resolves the shortest waves");
    add_absent("rms_slope", dims, "1", "rms gradient of the surface", of_surfaces([](const auto& s) { return std::sqrt(2 * s.m2); }),
               "sqrt(2 m2); the theory is one of small slopes");
    std::vector<std::int32_t> summits, saddles;
    for (const SurfaceStatistics& s : o_.surface) summits.push_back(clamped(s.summits)), saddles.push_back(clamped(s.saddles));
    add("summits", dims, "1", "number of asperities", summits);
    add("saddles", dims, "1", "grid maxima that are no asperities, not kept", saddles,
        comment("saddles by their curvatures; with law = 'elliptic' or 'fourth_order' those that lead to no summit between the grid "
                "points, or to one already found"));
    add_absent("mean_kappa_g", dims, unit(-1), "mean geometric curvature of the summits",
               of_surfaces([](const auto& s) { return s.mean_kappa_g; }), "1.356 sqrt(m4) in theory");
    add_absent("mean_kappa_a", dims, unit(-1), "mean algebraic curvature of the summits",
               of_surfaces([](const auto& s) { return s.mean_kappa_a; }), "1.5045 sqrt(m4) in theory");
}

void ResultTable::theory() {
    const bool known = r_.theory.has_value();
    const Moments m = known ? *r_.theory : Moments{};
    const auto scalar = [&](const std::string& name, const std::string& units, const std::string& long_name, double value,
                            const std::string& note) { add_absent(name, {}, units, long_name, {known ? value : kAbsent}, note); };
    scalar("m0_theory", unit(2), "mean square height of the continuous spectrum", m.m0, "");
    scalar("m2_theory", "1", "second profile moment of the continuous spectrum", m.m2, "");
    scalar("m4_theory", unit(-2), "fourth profile moment of the continuous spectrum", m.m4, "");
    scalar("nayak_theory", "1", "Nayak's bandwidth parameter of the continuous spectrum", known ? m.nayak() : kAbsent, "m0 m4/m2^2");
    scalar("density_theory", unit(-2), "density of summits of the continuous spectrum", known ? m.summit_density() : kAbsent,
           "sqrt(3) m4/(18 pi m2)");
    const double R = r_.indenter.R;
    add("e_star", {}, unit(-2, 1), "equivalent modulus E*", std::vector<double>{r_.indenter.E_star},
        comment("1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2"));
    add_absent("r_star", {}, unit(1), "equivalent radius R*", {std::isfinite(R) ? R : kAbsent},
               "1/R* = 1/R1 + 1/R2; absent for flat on flat");
    add("tip_x", {}, unit(1), "x of the sphere's tip", std::vector<double>{r_.indenter.x0});
    add("tip_y", {}, unit(1), "y of the sphere's tip", std::vector<double>{r_.indenter.y0});
    add_absent("sigma_reference", {}, unit(1), "rms height that separations are divided by", {r_.sigma});
}

void ResultTable::regimes() {
    const Moments m = regime_moments(r_);
    const double E = r_.indenter.E_star, R = r_.indenter.R;
    const std::string which = r_.theory ? "m2_theory and m4_theory" : "the means of m2 and m4 over realizations";
    const bool known = m.m2 > 0 && m.m4 > 0;
    std::vector<double> first, second, hertz;
    for (double N : o_.force_mean) {
        first.push_back(known ? area_one_asperity(N, m.mean_radius(), E) : kAbsent);
        second.push_back(known ? area_proportional(N, m.m2, E) : kAbsent);
        hertz.push_back(std::isfinite(R) && std::isfinite(N) ? hertz_contact(N, R, E).area() : kAbsent);
    }
    add_absent("transition_force", {}, unit(0, 1), "force at which area_I = area_II, N*", {known ? transition_force(m, E) : kAbsent},
               "212.66 m2^(3/2) E*/m4, with " + which);
    add_absent("area_I", {"step"}, unit(2), "contact area of one mean asperity at force_mean, A_I", first,
               "pi (3 r_g N/(4 E*))^(2/3), r_g = 0.737/sqrt(m4), with " + which);
    add_absent("area_II", {"step"}, unit(2), "contact area proportional to force_mean, A_II", second,
               "beta sqrt(2 pi) N/(sqrt(2 m2) E*), beta = 0.2, with " + which);
    add_absent("area_hertz", {"step"}, unit(2), "contact area of the smooth sphere at force_mean (Hertz)", hertz,
               "pi a^2, a = (3 N R*/(4 E*))^(1/3); absent for flat on flat");
}

}  // namespace rsc
