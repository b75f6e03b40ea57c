#include "run/netcdf_writer.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <numbers>
#include <utility>

#include "error.hpp"
#include "observe/regimes.hpp"
#include "version.h"

namespace rsc {
namespace {

const char* const kPaper =
    "V. A. Yastrebov, The Elastic Contact of Rough Spheres Investigated Using a Deterministic Multi-Asperity Model, "
    "Journal of Multiscale Modelling (2018)";
const char* const kAbsentMeans = "_FillValue: absent";

std::string date() {
    std::time_t now = std::time(nullptr);
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
        char* end = nullptr;
        const long long seconds = std::strtoll(epoch, &end, 10);
        if (end != epoch && *end == '\0') now = static_cast<std::time_t>(seconds);
    }
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

std::int32_t clamped(std::int64_t n) {
    return static_cast<std::int32_t>(std::min<std::int64_t>(n, std::numeric_limits<std::int32_t>::max()));
}

// NaN in the attribute of a fit becomes the fill value, like NaN in a variable.
std::vector<double> filled(std::vector<double> values) {
    for (double& v : values)
        if (std::isnan(v)) v = 9.9692099683868690e+36;
    return values;
}

// The table of variables, one function a room of it.
class ResultTable {
public:
    explicit ResultTable(const Result& result) : r_(result), o_(result.observations) {
        length_ = r_.length_unit, force_ = r_.force_unit;
    }

    NetcdfFile make(const std::string& history) {
        global_attributes(history);
        axes();
        levels();
        means();
        surfaces();
        theory();
        regimes();
        maps();
        radial();
        distributions();
        asperities();
        contacts();
        heights();
        return std::move(file_);
    }

private:
    using Names = std::vector<std::string>;

    std::string unit(int length_power, int force_power = 0) const { return unit_of(length_, length_power, force_, force_power); }

    static NetcdfAttributes comment(const std::string& text) {
        return text.empty() ? NetcdfAttributes{} : NetcdfAttributes{{"comment", text}};
    }
    void add(const std::string& name, Names dimensions, const std::string& units, const std::string& long_name,
             std::vector<double> values, NetcdfAttributes attributes = {}) {
        file_.variable({name, std::move(dimensions), units, long_name, std::move(values), std::move(attributes), false});
    }
    void add(const std::string& name, Names dimensions, const std::string& units, const std::string& long_name,
             std::vector<std::int32_t> values, NetcdfAttributes attributes = {}) {
        file_.variable({name, std::move(dimensions), units, long_name, std::move(values), std::move(attributes), false});
    }
    // One that may lack values.
    void add_absent(const std::string& name, Names dimensions, const std::string& units, const std::string& long_name,
                    std::vector<double> values, std::string note = "") {
        note = note.empty() ? kAbsentMeans : note + "; " + kAbsentMeans;
        file_.variable({name, std::move(dimensions), units, long_name, std::move(values), comment(note), true});
    }

    template <typename T, typename Get>
    std::vector<T> of_rows(Get get) const {
        std::vector<T> values;
        values.reserve(o_.rows.size());
        for (const LevelRow& row : o_.rows) values.push_back(get(row));
        return values;
    }
    template <typename Get>
    std::vector<double> of_surfaces(Get get) const {
        std::vector<double> values;
        for (const SurfaceStatistics& s : o_.surface) values.push_back(get(s));
        return values;
    }

    void global_attributes(const std::string& history) {
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

    void axes() {
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

    void levels() {
        const Names dims{"realization", "step"};
        const auto integers = [&](const std::string& name, const std::string& long_name, auto get,
                                  NetcdfAttributes attributes = {}) {
            add(name, dims, "1", long_name, of_rows<std::int32_t>(get), std::move(attributes));
        };
        add("force", dims, unit(0, 1), "normal force on the sphere, N",
            of_rows<double>([](const LevelRow& l) { return l.force; }), comment("N = sum of the forces f of the contacts"));
        add("contact_area", dims, unit(2), "true contact area, A", of_rows<double>([](const LevelRow& l) { return l.area; }),
            comment("A = sum of pi a^2 over the contacts"));
        integers("contacts", "number of asperities in contact", [](const LevelRow& l) { return l.contacts; });
        integers("candidates", "number of asperities given to the solver", [](const LevelRow& l) { return l.candidates; });
        integers("iterations", "Newton iterations", [](const LevelRow& l) { return l.iterations; });
        add("residual", dims, "1", "relative residual of F - C<G0 - B F>^(3/2)",
            of_rows<double>([](const LevelRow& l) { return l.residual; }),
            comment("unregularised, over all candidates: it says whether the forces are right"));
        integers("status", "how the level ended", [](const LevelRow& l) { return l.status; },
                 {{"flag_values", std::vector<std::int32_t>{0, 1, 2, 3, 4}},
                  {"flag_meanings", "converged out_of_validity overlapping not_unique not_converged"},
                  {"comment",
                   "1: contacts with a > <d>/4; 2: contacts overlap, d < a_i + a_j; 3: a local minimum of the energy, not the "
                   "only one; "
                   "4: do not use. The larger is the more serious and hides the smaller"}});
        integers("method", "solver used", [](const LevelRow& l) { return l.method; },
                 {{"flag_values", std::vector<std::int32_t>{1, 2, 3}}, {"flag_meanings", "dgesv direct mesh"}});
        integers("products", "products with the interaction matrix B (direct, mesh) or solves (dgesv)",
                 [](const LevelRow& l) { return clamped(l.products); });
        integers("overlapping_pairs", "pairs of contacts with d < a_i + a_j",
                 [](const LevelRow& l) { return clamped(l.overlapping_pairs); });
        integers(
            "large_contacts", "contacts with a > <d>/4", [](const LevelRow& l) { return l.large_contacts; },
            comment(
                "<d> = 1/sqrt(density of summits); beyond it a contact is no longer small against its distance from the next"));
        integers(
            "crowded_cells", "cells of the map with an area fraction above pi/16",
            [](const LevelRow& l) { return l.crowded_cells; },
            comment("19.6 %: beyond it point forces do not describe the interaction well"));
        integers("contacts_outside_map", "contacts outside the map: in force and contact_area, in no cell",
                 [](const LevelRow& l) { return l.outside_map; });
        const std::vector<double> stiffness = of_rows<double>([](const LevelRow& l) { return l.stiffness; });
        bool computed = false;
        for (double k : stiffness) computed = computed || !std::isnan(k);
        if (computed) add_absent("stiffness", dims, unit(-1, 1), "derivative of the force by the separation, dN/dZ0", stiffness);
    }

    void means() {
        const std::string deviation = "divisor M - 1 for M realizations";
        if (r_.force_control) add("separation_mean", {"step"}, unit(1), "mean separation over realizations", o_.separation_mean);
        add("force_mean", {"step"}, unit(0, 1), "mean force over realizations", o_.force_mean);
        add_absent("force_std", {"step"}, unit(0, 1), "standard deviation of the force over realizations", o_.force_std,
                   deviation);
        add("contact_area_mean", {"step"}, unit(2), "mean contact area over realizations", o_.area_mean);
        add_absent("contact_area_std", {"step"}, unit(2), "standard deviation of the contact area over realizations", o_.area_std,
                   deviation);
    }

    void surfaces() {
        const Names dims{"realization"};
        const std::string origin = r_.theory ? "exact sum over the modes drawn" : "finite differences on the grid of heights";
        add_absent("sigma", dims, unit(1), "rms height of the surface", of_surfaces([](const auto& s) { return s.sigma; }));
        add_absent("m2", dims, "1", "second profile moment: half the mean square gradient",
                   of_surfaces([](const auto& s) { return s.m2; }), origin);
        add_absent("m4", dims, unit(-2), "fourth profile moment: mean square profile curvature",
                   of_surfaces([](const auto& s) { return s.m4; }), origin + ", (m40 + m04 + 3 m22)/3");
        add_absent("m2_grid", dims, "1", "second profile moment from finite differences",
                   of_surfaces([](const auto& s) { return s.m2_grid; }),
                   "its distance from m2 says how well the grid resolves the shortest waves");
        add_absent("m4_grid", dims, unit(-2), "fourth profile moment from finite differences",
                   of_surfaces([](const auto& s) { return s.m4_grid; }),
                   "its distance from m4 says how well the grid resolves the shortest waves");
        add_absent("rms_slope", dims, "1", "rms gradient of the surface",
                   of_surfaces([](const auto& s) { return std::sqrt(2 * s.m2); }),
                   "sqrt(2 m2); the theory is one of small slopes");
        std::vector<std::int32_t> summits, saddles;
        for (const SurfaceStatistics& s : o_.surface)
            summits.push_back(clamped(s.summits)), saddles.push_back(clamped(s.saddles));
        add("summits", dims, "1", "number of asperities", summits);
        add("saddles", dims, "1", "grid maxima that are saddles by their curvatures, not kept", saddles);
        add_absent("mean_kappa_g", dims, unit(-1), "mean geometric curvature of the summits",
                   of_surfaces([](const auto& s) { return s.mean_kappa_g; }), "1.356 sqrt(m4) in theory");
        add_absent("mean_kappa_a", dims, unit(-1), "mean algebraic curvature of the summits",
                   of_surfaces([](const auto& s) { return s.mean_kappa_a; }), "1.5045 sqrt(m4) in theory");
    }

    void theory() {
        const bool known = r_.theory.has_value();
        const Moments m = known ? *r_.theory : Moments{};
        const auto scalar = [&](const std::string& name, const std::string& units, const std::string& long_name, double value,
                                const std::string& note) {
            add_absent(name, {}, units, long_name, {known ? value : kAbsent}, note);
        };
        scalar("m0_theory", unit(2), "mean square height of the continuous spectrum", m.m0, "");
        scalar("m2_theory", "1", "second profile moment of the continuous spectrum", m.m2, "");
        scalar("m4_theory", unit(-2), "fourth profile moment of the continuous spectrum", m.m4, "");
        scalar("nayak_theory", "1", "Nayak's bandwidth parameter of the continuous spectrum", known ? m.nayak() : kAbsent,
               "m0 m4/m2^2");
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

    void regimes() {
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
        add_absent("transition_force", {}, unit(0, 1), "force at which area_I = area_II, N*",
                   {known ? transition_force(m, E) : kAbsent}, "212.66 m2^(3/2) E*/m4, with " + which);
        add_absent("area_I", {"step"}, unit(2), "contact area of one mean asperity at force_mean, A_I", first,
                   "pi (3 r_g N/(4 E*))^(2/3), r_g = 0.737/sqrt(m4), with " + which);
        add_absent("area_II", {"step"}, unit(2), "contact area proportional to force_mean, A_II", second,
                   "beta sqrt(2 pi) N/(sqrt(2 m2) E*), beta = 0.2, with " + which);
        add_absent("area_hertz", {"step"}, unit(2), "contact area of the smooth sphere at force_mean (Hertz)", hertz,
                   "pi a^2, a = (3 N R*/(4 E*))^(1/3); absent for flat on flat");
    }

    void maps() {
        const MapGrid& g = o_.options.map;
        file_.dimension("y", static_cast<std::size_t>(g.ny));
        file_.dimension("x", static_cast<std::size_t>(g.nx));
        std::vector<double> x, y;
        for (int i = 0; i < g.nx; ++i) x.push_back(g.x(i));
        for (int j = 0; j < g.ny; ++j) y.push_back(g.y(j));
        add("y", {"y"}, unit(1), "y of the cell centres", y, {{"axis", "Y"}});
        add("x", {"x"}, unit(1), "x of the cell centres", x, {{"axis", "X"}});
        add("map_cell_side", {}, unit(1), "side of the square cells of the map, w", std::vector<double>{g.side});
        const Names dims{"step", "y", "x"};
        add("map_area_fraction", dims, "1", "contact area over cell area, mean over realizations", o_.map_area_fraction,
            comment("A' = sum of pi a^2/w^2 over the asperities in the cell"));
        add("map_pressure", dims, unit(-2, 1), "force over cell area, mean over realizations", o_.map_pressure,
            comment("p = sum of f/w^2 over the asperities in the cell"));
    }

    void radial() {
        if (o_.radii.empty()) return;  // the tip is not over the map
        file_.dimension("radius", o_.radii.size());
        add("radius", {"radius"}, unit(1), "distance from the tip", o_.radii,
            comment("middles of rings of equal width, from the tip to the largest circle in the map"));
        const Names dims{"step", "radius"};
        const std::string how = "mean over the circle of the map, interpolated by bicubic Bezier patches between cell centres";
        add("radial_area_fraction", dims, "1", "area fraction about the tip", o_.radial_area_fraction, comment(how));
        add("radial_pressure", dims, unit(-2, 1), "pressure about the tip", o_.radial_pressure, comment(how));
        std::vector<double> hertz;
        for (double N : o_.force_mean)
            for (double r : o_.radii)
                hertz.push_back(std::isfinite(r_.indenter.R) && std::isfinite(N)
                                    ? hertz_contact(N, r_.indenter.R, r_.indenter.E_star).pressure(r)
                                    : kAbsent);
        add_absent("hertz_pressure", dims, unit(-2, 1), "pressure of the smooth sphere at force_mean (Hertz)", hertz,
                   "p0 sqrt(1 - r^2/a^2), p0 = 3 N/(2 pi a^2); absent for flat on flat");
    }

    // Attributes of one fitted distribution: a value a pdf_level each.
    template <typename Get>
    static std::vector<double> of_fits(const std::vector<FittedDistributions>& fits, Get get) {
        std::vector<double> values;
        for (const FittedDistributions& f : fits) values.push_back(get(f));
        return filled(std::move(values));
    }
    template <typename Get>
    NetcdfAttributes moment_attributes(Get moments) const {
        const auto& fits = o_.distributions;
        return {{"mean", of_fits(fits, [&](const auto& f) { return moments(f).mean; })},
                {"standard_deviation", of_fits(fits, [&](const auto& f) { return moments(f).deviation; })},
                {"skewness", of_fits(fits, [&](const auto& f) { return moments(f).skewness; })},
                {"kurtosis", of_fits(fits, [&](const auto& f) { return moments(f).kurtosis; })}};
    }
    static void append(NetcdfAttributes& to, NetcdfAttributes more) {
        for (auto& a : more) to.push_back(std::move(a));
    }

    void bin_axis(const std::string& name, const std::string& units, const std::string& long_name, double width) {
        std::vector<double> centres;
        for (int b = 0; b < o_.options.pdf.bins; ++b) centres.push_back((b + 0.5) * width);
        add(name, {"bin"}, units, long_name, centres, {{"bin_width", std::vector<double>{width}}});
    }

    void distributions() {
        if (o_.distributions.empty()) return;
        file_.dimension("pdf_level", o_.distributions.size());
        file_.dimension("bin", static_cast<std::size_t>(o_.options.pdf.bins));
        std::vector<double> wanted, used;
        std::vector<std::int32_t> step, bin;
        for (double level : o_.options.pdf_levels) wanted.push_back(level / r_.sigma);
        for (const FittedDistributions& f : o_.distributions) {
            used.push_back(f.sum.separation / static_cast<double>(f.sum.levels) / r_.sigma);
            step.push_back(f.sum.step + 1);
        }
        for (int b = 1; b <= o_.options.pdf.bins; ++b) bin.push_back(b);
        add("pdf_level", {"pdf_level"}, "1", "Z0/sigma asked for", wanted);
        add("pdf_separation_sigma", {"pdf_level"}, "1", "Z0/sigma of the nearest level run, which the distributions are of", used,
            comment("mean over realizations under force control"));
        add("pdf_step", {"pdf_level"}, "1", "number of that level", step,
            {{"start_index", std::vector<std::int32_t>{1}}, {"comment", "0: it differs between realizations (force control)"}});
        add("bin", {"bin"}, "1", "number of the bin", bin);
        const PdfBins& bins = o_.options.pdf;
        bin_axis("pressure_mean_bin", unit(-2, 1), "middle of the bins of pressure_mean_pdf", bins.mean_pressure_width());
        bin_axis("pressure_bin", unit(-2, 1), "middle of the bins of pressure_pdf", bins.pressure_width());
        bin_axis("spot_area_bin", unit(2), "middle of the bins of spot_area_pdf", bins.area_width());
        mean_pressure();
        pressure();
        spot_area();
    }

    void counts(const std::string& name, const std::string& axis, const std::string& long_name,
                CountHistogram Distributions::*which) {
        std::vector<double> values;
        std::vector<double> overflow;
        for (const FittedDistributions& f : o_.distributions) {
            for (std::int64_t n : (f.sum.*which).count) values.push_back(static_cast<double>(n));
            overflow.push_back(static_cast<double>((f.sum.*which).overflow));
        }
        add(name, {"pdf_level", "bin"}, "1", long_name, values,
            {{"coordinates", axis},
             {"overflow", overflow},
             {"comment", "whole numbers; overflow: contacts beyond the last bin, one value a pdf_level"}});
    }

    void density(const std::string& name, const std::string& axis, const std::string& units, const std::string& long_name,
                 std::vector<double> FittedDistributions::*which, NetcdfAttributes attributes, const std::string& note) {
        std::vector<double> values;
        for (const FittedDistributions& f : o_.distributions) values.insert(values.end(), (f.*which).begin(), (f.*which).end());
        NetcdfAttributes all{{"coordinates", axis}};
        append(all, std::move(attributes));
        append(all, comment(note + "; ks_distance is the Kolmogorov-Smirnov distance at the bin edges; one value a pdf_level; " +
                            kAbsentMeans));
        file_.variable({name, {"pdf_level", "bin"}, units, long_name, std::move(values), std::move(all), true});
    }

    void mean_pressure() {
        const auto& fits = o_.distributions;
        counts("pressure_mean_count", "pressure_mean_bin", "contacts by mean pressure, all realizations",
               &Distributions::mean_pressure);
        NetcdfAttributes a{{"rayleigh_scale", of_fits(fits, [](const auto& f) { return f.rayleigh.scale; })},
                           {"rayleigh_scale_error", of_fits(fits, [](const auto& f) { return f.rayleigh.scale_error; })},
                           {"ks_distance", of_fits(fits, [](const auto& f) { return f.rayleigh.ks_distance; })}};
        append(a, moment_attributes([](const auto& f) { return f.mean_pressure_moments; }));
        density("pressure_mean_pdf", "pressure_mean_bin", unit(2, -1),
                "probability density of the mean pressure of a contact, f/(pi a^2)", &FittedDistributions::mean_pressure_pdf,
                std::move(a),
                "fit: Rayleigh, (p/s^2) exp(-p^2/(2 s^2)), s = rayleigh_scale by maximum likelihood, with its standard error");
    }

    void pressure() {
        const auto& fits = o_.distributions;
        std::vector<double> values, overflow, equal;
        for (const FittedDistributions& f : fits) {
            values.insert(values.end(), f.sum.pressure.area.begin(), f.sum.pressure.area.end());
            overflow.push_back(f.sum.pressure.overflow);
            equal.push_back(f.sum.pressure.squares > 0 ? f.sum.pressure.total * f.sum.pressure.total / f.sum.pressure.squares
                                                       : 0);
        }
        add("pressure_area", {"pdf_level", "bin"}, unit(2), "contact area by pressure, summed over realizations", values,
            {{"coordinates", "pressure_bin"},
             {"overflow", overflow},
             {"comment", "overflow: area beyond the last bin, one value a pdf_level"}});
        const auto parameter = [&](const std::string& name, double GammaFit::*p) {
            return std::pair<std::string, NetcdfAttribute>{name, of_fits(fits, [p](const auto& f) { return f.gamma.*p; })};
        };
        NetcdfAttributes a{parameter("alpha", &GammaFit::alpha),
                           parameter("alpha_error", &GammaFit::alpha_error),
                           parameter("beta", &GammaFit::beta),
                           parameter("beta_error", &GammaFit::beta_error),
                           parameter("delta", &GammaFit::delta),
                           parameter("delta_error", &GammaFit::delta_error),
                           parameter("gamma", &GammaFit::gamma),
                           parameter("gamma_error", &GammaFit::gamma_error),
                           parameter("ks_distance", &GammaFit::ks_distance),
                           {"independent_contacts", equal}};
        append(a, moment_attributes([](const auto& f) { return f.pressure_moments; }));
        density("pressure_pdf", "pressure_bin", unit(2, -1),
                "probability density of the pressure at a random point of the contact area", &FittedDistributions::pressure_pdf,
                std::move(a),
                "each contact contributes 2 p/p0^2 on [0, p0], p0 = 1.5 f/(pi a^2), weighted by its area; fit: gamma p^alpha "
                "exp(-(p/delta)^beta), "
                "maximum likelihood of the bins; errors are those of independent_contacts = (sum A)^2/sum A^2 draws");
    }

    void spot_area() {
        const auto& fits = o_.distributions;
        counts("spot_area_count", "spot_area_bin", "contacts by area, all realizations", &Distributions::spot_area);
        NetcdfAttributes a{{"exponential_scale", of_fits(fits, [](const auto& f) { return f.exponential.scale; })},
                           {"exponential_scale_error", of_fits(fits, [](const auto& f) { return f.exponential.scale_error; })},
                           {"ks_distance", of_fits(fits, [](const auto& f) { return f.exponential.ks_distance; })}};
        append(a, moment_attributes([](const auto& f) { return f.spot_area_moments; }));
        density("spot_area_pdf", "spot_area_bin", unit(-2), "probability density of the area of a contact, pi a^2",
                &FittedDistributions::spot_area_pdf, std::move(a),
                "fit: exponential, exp(-A/s)/s, s = exponential_scale by maximum likelihood, with its standard error");
    }

    void asperities() {
        const Asperities& a = r_.asperities;
        if (a.size() == 0) return;
        file_.dimension("asperity", a.size());
        const auto column = [&](const std::string& name, const std::string& units, const std::string& long_name,
                                const std::vector<double>& values) {
            if (!values.empty()) add(name, {"asperity"}, units, long_name, values);
        };
        column("asperity_x", unit(1), "x of the summit", a.x);
        column("asperity_y", unit(1), "y of the summit", a.y);
        column("asperity_z", unit(1), "height of the summit", a.z);
        column("asperity_radius", unit(1), "radius of the asperity", a.radius);
        column("asperity_kappa1", unit(-1), "larger principal curvature, positive for a peak", a.kappa1);
        column("asperity_kappa2", unit(-1), "smaller principal curvature, positive for a peak", a.kappa2);
        column("asperity_angle", "radian", "direction of the axis of kappa2, the long axis of the contact ellipse, from x",
               a.angle);
        column("asperity_biharmonic", unit(-3), "biharmonic of the height at the summit, nabla^4 z", a.biharmonic);
    }

    void contacts() {
        const PackedContacts& c = r_.contacts;
        if (c.start.empty()) return;
        const NetcdfAttributes from_one{{"start_index", std::vector<std::int32_t>{1}}};
        const auto plus_one = [](std::vector<std::int32_t> v) {
            for (std::int32_t& i : v) ++i;
            return v;
        };
        NetcdfAttributes start = from_one;
        append(start, comment("level s has the contacts contact_start(s) to contact_start(s) + contact_count(s) - 1"));
        add("contact_start", {"step"}, "1", "first contact of the level in contact_asperity, contact_force, contact_radius",
            plus_one(c.start), start);
        add("contact_count", {"step"}, "1", "contacts kept of the level", c.count);
        if (c.asperity.empty()) return;
        file_.dimension("contact", c.asperity.size());
        add("contact_asperity", {"contact"}, "1", "asperity of the contact", plus_one(c.asperity), from_one);
        add("contact_force", {"contact"}, unit(0, 1), "force of the contact, f", c.force);
        add("contact_radius", {"contact"}, unit(1), "radius of the contact, a", c.radius, comment("its area is pi a^2"));
    }

    void heights() {
        if (!r_.heights) return;
        const HeightMap& h = *r_.heights;
        // The maps own the dimensions x and y; the heights lie on a finer grid.
        file_.dimension("height_y", static_cast<std::size_t>(h.ny));
        file_.dimension("height_x", static_cast<std::size_t>(h.nx));
        std::vector<double> x, y;
        for (int i = 0; i < h.nx; ++i) x.push_back(h.x0 + i * h.dx);
        for (int j = 0; j < h.ny; ++j) y.push_back(h.y0 + j * h.dy);
        add("height_y", {"height_y"}, unit(1), "y of the points of height", y);
        add("height_x", {"height_x"}, unit(1), "x of the points of height", x);
        file_.variable({"height",
                        {"height_y", "height_x"},
                        unit(1),
                        "height of the surface",
                        StridedRows{h.data.get(), h.stride},
                        comment(h.periodic ? "periodic in x and y" : ""),
                        false});
    }

    const Result& r_;
    const Observations& o_;
    std::string length_, force_;
    NetcdfFile file_;
};

}  // namespace

std::string unit_of(const std::string& length_unit, int length_power, const std::string& force_unit, int force_power) {
    std::string text;
    const auto factor = [&text](const std::string& unit, int power) {
        if (power == 0 || unit.empty() || unit == "1") return;
        bool plain = true;
        for (char c : unit)
            plain =
                plain && (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || static_cast<unsigned char>(c) >= 0x80);
        if (!text.empty()) text += ' ';
        text += plain ? unit : "(" + unit + ")";
        if (power != 1) text += std::to_string(power);
    };
    // A positive power comes first: "N mm-2", "mm2 N-1".
    if (force_power > 0) factor(force_unit, force_power);
    factor(length_unit, length_power);
    if (force_power < 0) factor(force_unit, force_power);
    return text.empty() ? "1" : text;
}

void write_result(const Result& result, const std::string& path, const WriteOptions& options) {
    const Observations& o = result.observations;
    if (o.realizations == 0 || o.steps == 0)
        throw Error(Failure::internal, "result file: there is nothing to write, no level was run");
    std::string history = date() + " rsc " RSC_VERSION;
    if (!options.command.empty()) history = date() + " " + options.command;
    ResultTable(result).make(history).write(path, options.format, options.compression);
}

}  // namespace rsc
