// The first half of the table: global attributes, axes, levels, surfaces, closed forms.

#include "base/version.h"
#include "contact/quantities.hpp"
#include "io/netcdf_table.hpp"
#include "observe/regimes.hpp"
#include "physics/physics.hpp"
#include "trust/doubts.hpp"

namespace rsc {
namespace {

const char* const kPaper =
    "V. A. Yastrebov, The Elastic Contact of Rough Spheres Investigated Using a Deterministic "
    "Multi-Asperity Model, "
    "Journal of Multiscale Modelling (2018)";

}  // namespace

void ResultTable::global_attributes(const std::string& history) {
    file_.attribute("Conventions", "CF-1.10");
    file_.attribute(
        "title", r_.settings.run.title.empty() ? "Contact of rough bodies" : r_.settings.run.title);
    file_.attribute(
        "source",
        "rsc " RSC_VERSION +
            (by_elements(r_.settings)
                 ? std::string(", boundary elements of rough bodies in contact")
                 : std::string(", deterministic multi-asperity model of rough bodies in contact, "
                               "law ") +
                       kLawNames[at(r_.settings.asperities.law)]));
    file_.attribute("history", history);
    file_.attribute("references", kPaper);
    file_.attribute("indenter", r_.indenter.shape->text(r_.settings.run.length_unit));
    file_.attribute("comment",
                    "Indices in this file (start_index = 1) count from 1. The effective namelist "
                    "in the attribute `case` "
                    "reproduces this file, "
                    "except for the attribute `history`.");
    std::string path;
    for (const Physics* p : physics_asked(r_.settings))
        if (p->path) enlist(path, ", ", p->path);
    if (!path.empty()) file_.attribute("path", "each level depends on the previous ones: " + path);
    file_.attribute("case", r_.case_text);
    if (r_.settings.run.seed >= std::numeric_limits<std::int32_t>::min() &&
        r_.settings.run.seed <= std::numeric_limits<std::int32_t>::max())
        file_.attribute("seed", std::int32_t(r_.settings.run.seed));
    else  // the classic data model has no integers longer than 32 bits
        file_.attribute("seed", std::to_string(r_.settings.run.seed));
}

void ResultTable::axes() {
    add_axis("realization", "1", "number of the realization",
             values_of<std::int32_t>(o_.realization, [](std::int64_t k) { return clamped(k); }),
             comment("realization k of a seed is the same surface in every case"));
    add_axis("step", "1", "number of the level", one_to(o_.steps));

    const Names dims = r_.force_control() ? Names{"realization", "step"} : Names{"step"};
    std::vector<double> separation = of_rows(&LevelValues::separation);
    if (!r_.force_control()) separation.resize(o_.steps);  // the same in every realization
    std::vector<double> scaled = separation;
    for (double& z : scaled) z /= r_.sigma;
    const LevelQuantity& Z0 = *find_quantity("separation")->quantity;
    add(Z0.name, dims, units(Z0), Z0.meaning, separation, with_error(Z0));
    add_absent("separation_sigma", dims, "1", "separation over rms height, Z0/sigma", scaled,
               "sigma is sigma_reference");
}

// The attribute of a quantity that names its expected error, if some level has one (CF, section
// 3.4).
NetcdfAttributes ResultTable::with_error(const LevelQuantity& q) const {
    for (const LevelValues& level : o_.rows)
        for (const auto c : indices(q.components()))
            if (!std::isnan(q.error(level, c))) return {{"ancillary_variables", q.error_name()}};
    return {};
}

// The expected error of a quantity that has no row for it.
void ResultTable::error_of(const LevelQuantity& q, const Names& shape) {
    if (q.error_member || with_error(q).empty()) return;
    std::vector<double> errors;
    for (const auto k : indices(o_.realizations))
        for (const auto s : indices(o_.steps))
            for (const auto c : indices(q.components()))
                errors.push_back(q.least ? error_of_least(q, k, s + 1) : q.error(o_.row(k, s), c));
    add_absent(q.error_name(), shape, "1", std::string("expected relative error of ") + q.name,
               errors, "not exceeded in nine of ten cases; follows from border_share");
}

// The declared quantities of a level (contact/quantities.hpp).
void ResultTable::levels() {
    const Names dims{"realization", "step"};
    for (const LevelQuantity& q : level_quantities()) {
        if (q.separate) continue;
        NetcdfAttributes attributes;
        if (std::holds_alternative<LevelStatus LevelValues::*>(q.member))
            attributes = flags(kLevelStatusNames);
        if (q.member == LevelQuantity::Member(&LevelValues::doubts))
            attributes = masks(kCauseNames);
        if (std::holds_alternative<Method LevelValues::*>(q.member))
            attributes = flags(kMethodNames, 1);  // 0 is 'auto'
        if (std::holds_alternative<Fallback LevelValues::*>(q.member))
            attributes = flags(kFallbackNames);
        append(attributes, comment(q.comment));
        const auto absent = [&](const LevelValues& l) {
            return std::isnan(q.written_with ? l.*q.written_with : q.of(l));
        };
        if (!q.always && std::ranges::all_of(o_.rows, absent)) continue;
        if (q.integer()) {
            add(q.name, dims, "1", q.meaning,
                of_rows<std::int32_t>([&](const LevelValues& l) { return clamped(q.of(l)); }),
                attributes);
            continue;
        }
        std::vector<double> values;
        for (const LevelValues& level : o_.rows)
            for (const auto c : indices(q.components())) values.push_back(q.of(level, c));
        Names shape = dims;
        if (q.of_step) {
            shape = {"step"};
            values.resize(o_.steps);
        }
        if (q.components() > 1) shape.push_back(components(q.components()));
        // Levels that did not converge may have no force.
        const NetcdfAttributes error = with_error(q);
        append(attributes, error);
        if (q.of_step || (q.always && std::ranges::none_of(o_.rows, absent)))
            add(q.name, shape, units(q), q.meaning, values, attributes);
        else
            add_absent(q.name, shape, units(q), q.meaning, values, q.comment, error);
        error_of(q, shape);
    }
    for (const LevelQuantity& q : level_quantities())
        if (q.least) least_of(q);
}

// The expected error of the smallest value of a quantity over the first levels of a realization.
double ResultTable::error_of_least(const LevelQuantity& q, std::size_t realization,
                                   std::size_t levels) const {
    const std::span first(&o_.row(realization, 0), levels);
    const bool negative = q.of(first.back()) < 0;
    return negative ? error_of_least_force(first) : kNotComputed;
}

// The smallest value of a quantity over the levels of a realization.
void ResultTable::least_of(const LevelQuantity& q) {
    if (!computed(of_rows([&](const LevelValues& l) { return q.of(l); }))) return;
    std::vector<double> least(o_.realizations, kNotComputed);
    for (const auto k : indices(least)) {
        bool without_state = false;  // the smallest may have been that of such a level
        for (std::size_t s = 0; s < o_.steps; ++s) {
            least[k] = std::fmin(least[k], q.of(o_.row(k, s)));
            without_state = without_state || std::isnan(o_.row(k, s).force);
        }
        if (without_state) least[k] = kNotComputed;
    }
    std::vector<double> errors;
    for (const auto k : indices(least)) errors.push_back(error_of_least(q, k, o_.steps));
    const std::string error_name = std::string(q.least) + "_error_expected";
    NetcdfAttributes error;
    if (computed(errors)) error = {{"ancillary_variables", error_name}};
    add_absent(q.least, {"realization"}, units(q), q.least_meaning, least, q.least_comment, error);
    if (computed(errors))
        add_absent(error_name, {"realization"}, "1",
                   std::string("expected relative error of ") + q.least, errors,
                   "that of N at the level with the smallest force");
}

bool ResultTable::computed(const std::vector<double>& values) {
    return !std::ranges::all_of(values, [](double v) { return std::isnan(v); });
}

// The dimension of the components of a vector, or of a symmetric tensor, which is declared on the
// first call.
std::string ResultTable::components(std::size_t number) {
    struct Components {
        const char *name, *meaning, *each;
    };
    constexpr Components kinds[] = {
        {"component", "component of a vector", "x y"},
        {"tensor_component", "component of a symmetric tensor", "xx yy xy"},
        {"component_of_four", "component of a tensor that is not symmetric", "xx yy xy yx"}};
    const auto& [name, meaning, each] = kinds[number - 2];
    if (!components_.insert(number).second) return name;
    add_axis(name, "1", meaning, one_to(number),
             {{"flag_values", one_to(number)}, {"flag_meanings", each}});
    return name;
}

void ResultTable::means() {
    add("converged", {"step"}, "1", "number of realizations in the means", o_.force.count,
        comment(
            "all means (of levels, maps and distributions) exclude levels that did not converge "
            "(status 4); the mean of a quantity also excludes levels where it is missing"));
    if (r_.force_control()) {
        add_absent("separation_mean", {"step"}, unit(1), "mean separation over realizations",
                   o_.separation.mean);
        add_absent("separation_std", {"step"}, unit(1),
                   "standard deviation of the separation over realizations",
                   o_.separation.deviation, "divisor M - 1 for M realizations");
        add_absent("separation_stderr", {"step"}, unit(1), "standard error of separation_mean",
                   o_.separation.error);
    }
    for (const LevelQuantity& q : level_quantities()) {
        if (!q.statistics) continue;
        const auto seen = [&](double value) {
            if (!q.logarithm) return value;
            return value > 0 ? std::log(value) : kNotComputed;
        };
        LevelStatistics s = o_.statistics([&](const LevelValues& l) { return seen(q.of(l)); });
        if (!q.always && !computed(of_rows([&](const LevelValues& l) { return q.of(l); })))
            continue;
        const std::string name = q.name + std::string(q.logarithm ? "_log" : ""),
                          of = (q.logarithm ? "natural logarithm of the " : std::string()) +
                               q.plain + " over realizations",
                          unit_of_mean = q.logarithm ? "1" : units(q);
        Names dims{"step"};
        bool fewer = s.count != o_.force.count;
        if (q.y) {
            const LevelStatistics y =
                o_.statistics([&](const LevelValues& l) { return seen(q.of(l, 1)); });
            fewer = fewer || y.count != o_.force.count;
            s = {pairs(s.mean, y.mean), pairs(s.deviation, y.deviation), pairs(s.error, y.error),
                 pairs(s.count, y.count)};
            dims.push_back(components(2));
        }
        // A prescribed force scatters as little as the solver leaves of it.
        if (r_.force_control() && name == "force")
            for (const auto step : indices(s.mean))
                if (s.count[step] > 1) s.deviation[step] = s.error[step] = 0;
        add_absent(name + "_mean", dims, unit_of_mean, "mean " + of, s.mean,
                   fewer ? "over `" + name + "_count` realizations, those that have it" : "");
        add_absent(name + "_std", dims, unit_of_mean, "standard deviation of the " + of,
                   s.deviation, "divisor M - 1 for M realizations");
        add_absent(name + "_stderr", dims, unit_of_mean, "standard error of " + name + "_mean",
                   s.error, name + "_std/sqrt(M)");
        if (fewer)
            add(name + "_count", dims, "1",
                "number of realizations with a value of the " + std::string(q.plain), s.count);
    }
}

void ResultTable::surfaces() {
    const Names dims{"realization"};
    const bool directional =
        r_.theory && (r_.theory->tensor.m20 != r_.theory->tensor.m02 || r_.theory->tensor.m11 != 0);
    const std::string origin =
        r_.theory ? "exact sum over the modes drawn"
                  : "finite differences on the grid of heights, without those across its border, "
                    "which is none of the surface even where the heights repeat";
    add_absent("sigma", dims, unit(1), "rms height of the surface",
               of_surfaces(&SurfaceStatistics::sigma));
    add_absent("m2", dims, "1", "second profile moment: half the mean square gradient",
               of_surfaces(&SurfaceStatistics::m2), origin);
    add_absent("m4", dims, unit(-2), "fourth profile moment: mean square profile curvature",
               of_surfaces(&SurfaceStatistics::m4),
               origin + (directional ? ", 3/8 (m40 + m04 + 2 m22)" : ", (m40 + m04 + 3 m22)/3"));
    for (const auto& [name, of] : kMomentComponents)
        add_absent(
            name, dims, name[1] - '0' + name[2] - '0' == 2 ? "1" : unit(-2),
            std::string("integral of kx^") + name[1] + " ky^" + name[2] + " over the spectrum",
            of_surfaces([of = of](const auto& s) { return s.tensor.*of; }), origin);
    add_absent("m2_grid", dims, "1", "second profile moment from finite differences",
               of_surfaces(&SurfaceStatistics::m2_grid),
               "differs from m2 if the grid does not resolve the shortest waves");
    add_absent("m4_grid", dims, unit(-2), "fourth profile moment from finite differences",
               of_surfaces(&SurfaceStatistics::m4_grid),
               "differs from m4 if the grid does not resolve the shortest waves");
    if (computed(of_surfaces(&SurfaceStatistics::skewness))) {
        add("skewness", dims, "1", "skewness of the heights",
            of_surfaces(&SurfaceStatistics::skewness));
        add("kurtosis", dims, "1", "kurtosis of the heights",
            of_surfaces(&SurfaceStatistics::kurtosis));
    }
    add_absent("rms_slope", dims, "1", "rms gradient of the surface",
               of_surfaces([](const auto& s) { return std::sqrt(2 * s.m2); }),
               "sqrt(2 m2); the theory assumes small slopes");
    const auto counts = [&](std::int64_t SurfaceStatistics::*member) {
        return values_of<std::int32_t>(o_.surface,
                                       [&](const auto& s) { return clamped(s.*member); });
    };
    const std::vector<std::int32_t> summits = counts(&SurfaceStatistics::summits);
    if (std::ranges::any_of(summits,
                            [](auto n) { return n > 0; })) {  // elements do not search for summits
        add("summits", dims, "1", "number of asperities", summits);
        add("saddles", dims, "1", "grid maxima that are not asperities",
            counts(&SurfaceStatistics::saddles),
            comment("saddles by their curvatures; with law = 'elliptic' or 'fourth_order' maxima "
                    "without a summit between the grid "
                    "points, or with one already found"));
    }
    add_absent("mean_kappa_g", dims, unit(-1), "mean geometric curvature of the summits",
               of_surfaces(&SurfaceStatistics::mean_kappa_g), "1.356 sqrt(m4) in theory");
    add_absent("mean_kappa_a", dims, unit(-1), "mean algebraic curvature of the summits",
               of_surfaces(&SurfaceStatistics::mean_kappa_a), "1.5045 sqrt(m4) in theory");
}

void ResultTable::theory() {
    const bool known = r_.theory.has_value();
    const Moments m = known ? *r_.theory : Moments{};
    const auto scalar = [&](const std::string& name, const std::string& units,
                            const std::string& long_name, double value, const std::string& note) {
        add_absent(name, {}, units, long_name, {known ? value : kNotComputed}, note);
    };
    scalar("m0_theory", unit(2), "mean square height of the continuous spectrum", m.m0, "");
    scalar("m2_theory", "1", "second profile moment of the continuous spectrum", m.m2, "");
    scalar("m4_theory", unit(-2), "fourth profile moment of the continuous spectrum", m.m4, "");
    scalar("nayak_theory", "1", "Nayak's bandwidth parameter of the continuous spectrum",
           known ? m.nayak() : kNotComputed, "m0 m4/m2^2");
    scalar("density_theory", unit(-2), "density of summits of the continuous spectrum",
           known ? m.summit_density() : kNotComputed,
           "sqrt(3) m4/(18 pi m2), with a lay of the isotropic surface before it is stretched");
    const double R = r_.indenter.shape->hertz_radius();
    add("e_star", unit(-2, 1), "equivalent modulus E*", r_.indenter.E_star,
        comment("1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2; on a body with layers that of the top layer"));
    add_absent("r_star", {}, unit(1), "equivalent radius R*", {std::isfinite(R) ? R : kNotComputed},
               "1/R* = 1/R1 + 1/R2; missing for two flats and for shapes other than spheres");
    if (r_.indenter.period.line())
        add("line_reference", unit(1),
            "distance from the line at which a uniform line load lowers nothing",
            r_.indenter.period.reference,
            comment("separation, stiffness, energy and resistance of line contact count from it"));
    add("tip_x", unit(1), "x of the indenter's tip", r_.indenter.x0);
    add("tip_y", unit(1), "y of the indenter's tip", r_.indenter.y0);
    outline();
    add_absent("sigma_reference", {}, unit(1), "rms height used as the unit of separations",
               {r_.sigma});
}

// The part of body 2 that can touch points up to 4 rms heights above the mean plane at the deepest
// level; hardly any point is higher.
void ResultTable::outline() {
    double lowest = kInfinity;
    for (const LevelValues& row : o_.rows) lowest = std::fmin(lowest, row.separation);
    const double height = 4 * r_.sigma - lowest;
    if (!(height > 0) || std::isinf(height)) return;
    const std::vector<Vec2> curve = r_.indenter.shape->outline(height);
    if (curve.empty()) return;
    std::vector<double> x, y;
    for (const Vec2& p : curve) {
        x.push_back(r_.indenter.x0 + p.x);
        y.push_back(r_.indenter.y0 + p.y);
    }
    file_.dimension("outline_point", curve.size());
    const auto how = comment(
        "closed curve on which the indenter is 4 sigma_reference above the mean plane at the "
        "deepest level");
    add("outline_x", {"outline_point"}, unit(1), "x of the indenter's outline", x, how);
    add("outline_y", {"outline_point"}, unit(1), "y of the indenter's outline", y, how);
}

void ResultTable::regimes() {
    const Moments m = regime_moments(r_);
    const double E = r_.indenter.E_star;
    const auto smooth = r_.indenter.shape->smooth(E);
    const std::string which =
        r_.theory ? "m2_theory and m4_theory" : "the means of m2 and m4 over realizations";
    const bool known = has_closed_forms(r_.settings) && m.m2 > 0 && m.m4 > 0;
    std::vector<double> first, second, hertz;
    for (double N : o_.force.mean) {
        if (N < 0) N = kNotComputed;  // adhesion
        first.push_back(known ? area_one_asperity(N, m.mean_radius(), E) : kNotComputed);
        second.push_back(known ? area_proportional(N, m.m2, E) : kNotComputed);
        hertz.push_back(smooth && std::isfinite(N) ? smooth->area_under(N) : kNotComputed);
    }
    add_absent("transition_force", {}, unit(0, 1), "force at which area_I = area_II, N*",
               {known ? transition_force(m, E) : kNotComputed},
               "212.66 m2^(3/2) E*/m4, with " + which);
    add_absent("area_I", {"step"}, unit(2), "contact area of one mean asperity at force_mean, A_I",
               first, "pi (3 r_g N/(4 E*))^(2/3), r_g = 0.737/sqrt(m4), with " + which);
    add_absent("area_II", {"step"}, unit(2), "contact area proportional to force_mean, A_II",
               second, "beta sqrt(2 pi) N/(sqrt(2 m2) E*), beta = 0.2, with " + which);
    if (!has_closed_forms(r_.settings)) return;
    if (r_.indenter.period.finite()) return two_flats(m);
    add_absent("area_hertz", {"step"}, unit(2),
               "contact area of the smooth indenter at force_mean (sphere: Hertz)", hertz,
               "sphere: pi a^2, a = (3 N R*/(4 E*))^(1/3); missing for two flats and for indenters "
               "without a closed form");
}

void ResultTable::two_flats(const Moments& m) {
    const double E = r_.indenter.E_star, A0 = r_.indenter.period.area();
    double summits = 0, kappa = 0, m2 = 0;
    for (const SurfaceStatistics& s : o_.surface) {
        summits += double(s.summits);
        kappa += s.mean_kappa_g;
        m2 += s.m2;
    }
    const auto n = double(o_.surface.size());
    // of the generated surfaces: for a band that begins at L their slope differs from that of
    // m2_theory
    m2 /= n;
    const FlatSummits own{summits / n / A0, n / kappa,
                          std::sqrt(std::max(0.0, m.m0 - kSummitVariance * m.m2 * m.m2 / m.m4))};
    std::vector<double> persson, bush, greenwood;
    for (double N : o_.force.mean) {
        if (N < 0) N = kNotComputed;  // adhesion
        const double p = N / (A0 * E * std::sqrt(2 * m2));
        persson.push_back(m2 > 0 ? area_persson(p) : kNotComputed);
        bush.push_back(m2 > 0 ? area_bgt(p) : kNotComputed);
        greenwood.push_back(own.usable() && std::isfinite(N) ? area_gw(N / (A0 * E), own)
                                                             : kNotComputed);
    }
    const std::string which = "the mean of m2 over realizations";
    add_absent("area_persson", {"step"}, "1", "area fraction at force_mean by Persson's theory",
               persson, "erf(sqrt(2) p/(E* sqrt(2 m2))), with " + which);
    add_absent("area_bgt", {"step"}, "1",
               "area fraction at force_mean by the asymptote of Bush, Gibson and Thomas", bush,
               "sqrt(2 pi) p/(E* sqrt(2 m2)), derived for isotropic surfaces, with " + which);
    add_absent("area_gw", {"step"}, "1", "area fraction at force_mean by Greenwood and Williamson",
               greenwood,
               "summits of the surface's own density and radius 1/mean_kappa_g, Gaussian heights "
               "of variance m0 - 0.8968 m2^2/m4 (Nayak)");
}

}  // namespace rsc
