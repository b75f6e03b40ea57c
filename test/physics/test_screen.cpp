// The screen of every kind of run, line by line: each number told is that of the result file, each remark stands there exactly when the
// levels of the file ask for it. The text expected is put together here from the variables of the file.
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "error.hpp"
#include "result_reader.hpp"
#include "run/run.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;
using std::numbers::pi;

namespace {

using Vector = std::vector<double>;

std::string print(const char* text, ...) __attribute__((format(printf, 1, 2)));
std::string print(const char* text, ...) {
    char buffer[2000];
    va_list arguments;
    va_start(arguments, text);
    std::vsnprintf(buffer, sizeof buffer, text, arguments);
    va_end(arguments);
    return buffer;
}

// Durations and rates are not the same twice.
std::string without_times(const std::string& text) {
    static const std::regex levels("(.* levels in )[0-9].*"), batch("( *[0-9]+ +[^ ]+ +[^ ]+ +[^ ]+ +[^ ]+) +[0-9.]+ m?s +[0-9.e+]+");
    std::istringstream lines(text);
    std::string result;
    for (std::string line, rest; std::getline(lines, line);)
        result += std::regex_replace(std::regex_replace(line, levels, "$1TIME"), batch, "$1 TIME") + "\n";
    return result;
}

void same_lines(const std::string& said, const std::string& expected, const std::string& which) {
    CHECK(said == expected);
    if (said == expected) return;
    std::istringstream a(said), b(expected);
    for (std::string x, y;;) {
        const bool more_x = static_cast<bool>(std::getline(a, x)), more_y = static_cast<bool>(std::getline(b, y));
        if (!more_x && !more_y) break;
        if (!more_x) x = "(nothing)";
        if (!more_y) y = "(nothing)";
        if (x == y) continue;
        std::printf("  %s\n  said:     %s\n  expected: %s\n", which.c_str(), x.c_str(), y.c_str());
        return;
    }
}

// What all screens have in common, from a result file.
class Screen {
public:
    Screen(const std::string& path, const Case& settings)
        : path(path),
          c(settings),
          f(path),
          l(c.run.length_unit),
          N(c.run.force_unit),
          sigma(one("sigma_reference")),
          flats(c.indentation.boundary == Boundary::periodic),
          elements(c.solver.model == Model::elements),
          levels(f.values("force").size()),
          steps(f.values("contact_area_mean").size()) {}

    const Vector& values(const std::string& name) const {
        const auto [found, fresh] = read_.try_emplace(name);
        if (fresh) found->second = f.values(name);
        return found->second;
    }
    double one(const char* name) const { return values(name)[0]; }
    // Of level k, realization by realization; `otherwise` where the file has no such variable.
    double at(const char* name, std::size_t k, double otherwise = 0) const {
        return read_.contains(name) || f.has(name) ? values(name)[k] : otherwise;
    }
    double separation(std::size_t k) const {
        const Vector& z = values("separation");
        return z[z.size() == steps ? k % steps : k];
    }

    std::string heading() const {
        std::string text = c.run.title.empty() ? "" : c.run.title + "\n";
        if (flats)
            text += print("two flats, a rough half-space that repeats every %g x %g %s, E* = %g %s/%s2, sigma = %g %s\n",
                          c.surface.L.value_or(1.0), c.surface.L.value_or(1.0) * (c.surface.source == Source::heights ? 0.8 : 1.0),
                          l.c_str(), one("e_star"), N.c_str(), l.c_str(), sigma, l.c_str());
        else
            text +=
                print("sphere R = %g %s on a rough half-space, E* = %g %s/%s2, sigma = %g %s\n",
                      one("r_star") < 1e30 ? one("r_star") : HUGE_VAL, l.c_str(), one("e_star"), N.c_str(), l.c_str(), sigma, l.c_str());
        if (c.surface.source == Source::synthetic || c.surface.source == Source::spectrum)
            text +=
                print("theory: rms slope %.4g, Nayak parameter %.4g, summit density %.5g 1/%s2, r_g %.4g %s, transition force N* %.5g %s\n",
                      std::sqrt(2 * one("m2_theory")), one("nayak_theory"), one("density_theory"), l.c_str(),
                      0.737 / std::sqrt(one("m4_theory")), l.c_str(), one("transition_force"), N.c_str());
        return text + (c.run.realizations > 1 ? first_map : f.has("sq") ? measured() : "");
    }

    std::string change(const char* from, std::size_t a) const {
        (void)from;
        const Vector h = f.values("stage_rms_height"), s = f.values("stage_rms_slope"), k = f.values("stage_rms_curvature");
        return print("rms height %.4g -> %.4g %s, rms slope %.4g -> %.4g, rms curvature %.4g -> %.4g 1/%s\n", h[a], h[a + 1], l.c_str(),
                     s[a], s[a + 1], k[a], k[a + 1], l.c_str());
    }
    std::string measured() const {
        std::string text = map_line + "\n";
        if (one("filled_points") > 0)
            text += print("missing points: %.0f (%.3g %%) filled; summits nearer to them than the shortest wave are left out\n",
                          one("filled_points"), 100 * f.numbers("filled_points", "share")[0]);
        const Vector slope = f.numbers("form_removed", "slope");
        text += "form " + get_key(c, "surface%detrend") + ": ";
        if (c.surface.detrend == Detrend::plane || c.surface.detrend == Detrend::quadratic)
            text += print("slopes %.4g, %.4g; ", slope[0], slope[1]);
        if (c.surface.detrend == Detrend::sphere) {
            const double radius = f.numbers("form_removed", "radius")[0];
            text += print("radius %.6g %s (%s); ", std::abs(radius), l.c_str(), radius > 0 ? "dome" : "bowl");
        }
        text += change("form", 0);
        if (c.surface.filter_cutoff > 0)
            text += print("filter (Gaussian, %.4g %s): ", c.surface.filter_cutoff, l.c_str()) + change("filter", 1);
        text += print("heights: Sq %.5g %s, Ssk %.3f, Sku %.3f, Sdq %.4g; isotropy ratio of slopes %.2f\n", one("sq"), l.c_str(),
                      one("ssk"), one("sku"), one("sdq"), one("isotropy_ratio"));
        const auto fit = [&](const char* name) { return f.numbers("psd_fit", name)[0]; };
        if (f.has("psd_fit"))
            text += print("spectrum: hurst %.3f +- %.3f, lambda_l %.4g %s%s, lambda_s %.4g %s%s, %.1f points in the shortest wave\n",
                          fit("hurst"), fit("hurst_error"), 2 * pi / fit("kl"), l.c_str(), fit("plateau") != 0 ? " (plateau above)" : "",
                          2 * pi / fit("ks"), l.c_str(), fit("ks_seen") != 0 ? "" : " (the grid's: no end seen)", one("points_per_wave"));
        else
            text += "spectrum: none, the map is too small or flat\n";
        if (one("points_per_wave") < 4)
            text +=
                "warning: fewer than 4 points in the shortest wave: the grid, or noise at the pixel, makes the slopes, curvatures and "
                "summits; surface%filter_cutoff takes out what is no roughness\n";
        if (one("isotropy_ratio") < 0.8 || std::abs(one("ssk")) > 0.3 || std::abs(one("sku") - 3) > 0.6)
            text +=
                "warning: the map is not isotropic or not Gaussian (isotropy ratio 1, Ssk 0, Sku 3 would be): surfaces made from its "
                "spectrum are both\n";
        return text;
    }

    std::string table() const {
        std::string text =
            print("\nlevel %12s  Z0/sigma %14s %14s", ("Z0 [" + l + "]").c_str(), ("N [" + N + "]").c_str(), ("A [" + l + "2]").c_str());
        if (flats) text += print(" %14s       A/A0", ("p [" + N + " " + l + "-2]").c_str());
        text += "  contacts candidates steps  residual status\n";
        for (std::size_t k = 0; k < levels; ++k) {
            text += print("%5zu %12.6g %9.5f %14.8g %14.8g", k + 1, separation(k), separation(k) / sigma, at("force", k),
                          at("contact_area", k));
            if (flats) text += print(" %14.6g %10.6g", at("pressure", k), at("area_fraction", k));
            text += print(" %9.0f %10.0f %5.0f %9.1e  ", at("contacts", k), at("candidates", k), at("iterations", k), at("residual", k));
            static const char* const names[] = {"converged", "out of validity", "overlapping", "not unique", "NOT CONVERGED"};
            text += names[static_cast<int>(at("status", k))];
            if (at("fallback", k) > 0) text += std::string(", ") + method(at("method", k)) + ": " + reason(at("fallback", k));
            text += "\n";
        }
        return text;
    }

    static const char* method(double number) { return number == 1 ? "dgesv" : number == 2 ? "direct" : "mesh"; }
    static const char* reason(double number) {
        static const char* const reasons[] = {"", "there is no interaction", "dgesv did not converge", "dgesv's matrix was singular",
                                              "dgesv's solution is not proved unique"};
        return reasons[static_cast<int>(number)];
    }

    std::string compared() const {
        if (!f.has("compare_step")) return {};
        std::string text = "\ncompared with elements on " + grid + " points (asperities over elements - 1):\n";
        for (std::size_t k = 0; k < f.values("compare_step").size(); ++k) {
            const auto step = static_cast<std::size_t>(at("compare_step", k)) - 1;
            text += print("level %zu, Z0/sigma %.5g: elements N = %.6g %s, A = %.5g %s2, %.0f contacts; asperities ", step + 1,
                          separation(step) / sigma, at("compare_force", k), N.c_str(), at("compare_contact_area", k), l.c_str(),
                          at("compare_contacts", k));
            if (at("compare_contacts", k) > 0 && at("force_error", k) > 1e30)  // absent
                text += "not compared: ELEMENTS DID NOT CONVERGE, raise solver%max_iterations\n";
            else if (at("compare_contacts", k) == 0)
                text += print("N = %.6g %s, A = %.5g %s2, %.0f contacts\n", at("force", step), N.c_str(), at("contact_area", step),
                              l.c_str(), at("contacts", step));
            else
                text += print("N %+.2f %%, A %+.2f %%, contacts %+.1f %%\n", 100 * (at("force", step) / at("compare_force", k) - 1),
                              100 * (at("contact_area", step) / at("compare_contact_area", k) - 1),
                              100 * (at("contacts", step) / at("compare_contacts", k) - 1));
        }
        return text;
    }

    // Levels that did not converge, those of the elements beside them too.
    long failed() const {
        long n = 0;
        for (const double status : f.values("status")) n += status == 4;
        for (std::size_t k = 0; f.has("compare_step") && k < f.values("compare_step").size(); ++k)
            n += at("compare_contacts", k) > 0 && at("force_error", k) > 1e30;
        return n;
    }

    // By the level, with the thresholds of the README and of the file's comments.
    std::string remarks() const {
        std::string text;
        const auto count = [&](const std::function<bool(std::size_t)>& holds) {
            std::size_t n = 0;
            for (std::size_t k = 0; k < levels; ++k) n += holds(k);
            return n;
        };
        const auto tell = [&](const std::function<bool(std::size_t)>& holds, const std::string& what) {
            if (const std::size_t n = count(holds)) text += print("  %zu of %zu levels: ", n, levels) + what + "\n";
        };
        if (!elements) {
            text += "method:";
            std::string separator = " ";
            for (int m = 1; m <= 3; ++m)
                for (int why = 0; why <= 4; ++why)
                    if (const std::size_t n = count([&](std::size_t k) { return at("method", k) == m && at("fallback", k) == why; })) {
                        text += separator + method(m) + print(" (%zu levels", n) + (why == 0 ? "" : ": ") + reason(why) + ")";
                        separator = ", ";
                    }
            text += "\n";
        }
        tell([&](std::size_t k) { return at("edge_contacts", k) > 0; },
             "contacts within <d> of the surface's border - what would carry beyond it is missing: N is too small.");
        if (!elements) {
            tell(
                [&](std::size_t k) { return separation(k) < -3 * sigma; },
                "separation below -3 sigma - the sphere's tip lies under all but a thousandth of the surface: the asperity model is out of its "
                "range.");
            tell([&](std::size_t k) { return at("nominal_area", k) > 0 && at("contact_area", k) > (1 + 1e-9) * at("nominal_area", k); },
                 "contact area above the nominal area under the sphere - the asperity model is out of its range.");
            tell([&](std::size_t k) { return at("large_contacts", k) > 0; },
                 "contacts with a > <d>/4, a quarter of the mean spacing of summits - the asperity model is leaving its range.");
        }
        tell([&](std::size_t k) { return at("beyond_law", k) > 0; },
             "contacts pressed beyond what the law knows of a summit (beyond_law in the file).");
        tell([&](std::size_t k) { return at("status", k) == 2; },
             "overlapping - pairs of contact spots nearer than the sum of their radii: asperities that would merge are counted as two.");
        tell(
            [&](std::size_t k) { return at("status", k) == 3; },
            "not unique - spots so deep in each other that other solutions may exist: the one given is a local minimum of the energy, reached "
            "by a fixed rule.");
        tell(
            [&](std::size_t k) { return at("status", k) == 4; },
            "NOT CONVERGED - the residual is above solver%tolerance: do not use these values; raise solver%max_iterations or the tolerance.");
        const bool yields = std::isfinite(c.solids.hardness);
        if (!yields)
            tell(
                [&](std::size_t k) { return at("beyond_law", k) > 0.3 * at("contacts", k); },
                "spots cover much of each other, more than 30 % of the contacts lie beyond the law. Against elements on such surfaces the area "
                "was 32 % too low on average (1 to 56), the force 7 % (0 to 26): see &compare.");
        std::size_t most = 0;
        for (std::size_t k = 1; k < levels; ++k)
            if (at("extreme_area_fraction", k) > at("extreme_area_fraction", most)) most = k;
        if (!yields && at("extreme_area_fraction", most) > 0.01)
            text += print(
                "  pressures above E*/10 on %.0f %% of the contact area at Z0/sigma = %.4g: no metal bears them elastically; "
                "solids%%hardness bounds them.\n",
                100 * at("extreme_area_fraction", most), separation(most) / sigma);
        if (yields) {
            most = 0;
            double lost = 0;
            for (std::size_t k = 0; k < levels; ++k) {
                if (at("plastic_contacts", k) > at("plastic_contacts", most)) most = k;
                lost = std::max(lost, at("plastic_work", k));
            }
            if (at("plastic_contacts", most) == 0)
                text += "  nothing yields: pressures stay below the hardness.\n";
            else
                text += print("  at Z0/sigma = %.4g, %.0f of %.0f contacts yield", separation(most) / sigma, at("plastic_contacts", most),
                              at("contacts", most)) +
                        (c.run.realizations == 1 ? print("; %.4g %s %s of work are lost", lost, N.c_str(), l.c_str()) : "") +
                        ". Levels depend on those before them.\n";
        }
        double crowded = 0;
        for (std::size_t k = 0; k < levels; ++k) crowded += at("crowded_cells", k);
        if (crowded > 0 && !elements)
            text += print("  %.0f map cells (over all levels) with an area fraction above pi/16 = 19.6 %%: contacts there would merge.\n",
                          crowded);
        return text;
    }

    static std::string of_slope(double slope) {
        if (slope > 2)
            return " - above 2 the theory of small slopes does not hold: the numbers are the model's own, good for comparing its runs and for "
                   "repeating the paper (4.7 there); no load, area or pressure here is that of a real body";
        if (slope > 0.5)
            return " - above 0.5 the theory of small slopes is strained: compare surfaces by N(Z0), A(N) and stiffness, their ratios and trends; "
                   "do not take absolute areas and pressures (some 0.4 E* in a contact) for those of a real body";
        return {};
    }

    std::string end(bool replaces = false) const {
        std::string text;
        if (f.has("psd_fit")) {
            const std::string twins = path.substr(0, path.size() - 3) + "_twins.nml";
            text += "twins: " + twins + " (surfaces with this spectrum: rsc < " + twins + ")\n";
        }
        return text + "result: " + path + (replaces ? " (replaces the result that was there)" : "") +
               "\npicture: python3 output/plot/plot.py " + path + "\n";
    }

    std::string single(bool replaces) const {
        std::string text = heading() + table() + compared() + "\n";
        text += elements
                    ? print("elements, %zu levels in TIME\n", levels)
                    : print("%.0f asperities (%.0f saddles left out), %zu levels in TIME\n", at("summits", 0), at("saddles", 0), levels);
        if (f.has("rms_slope") && one("rms_slope") < 1e30)
            text += print("surface: rms height %.6g %s, rms slope %.4g", one("sigma"), l.c_str(), one("rms_slope")) +
                    of_slope(one("rms_slope")) + "\n";
        return text + remarks() + end(replaces);
    }

    // `done`: realizations of an earlier run.
    std::string campaign(int done, std::size_t workers) const {
        const auto total = static_cast<std::size_t>(c.run.realizations);
        std::string text = heading() + print("%zu realizations of %zu levels, %zu at a time", total, steps, workers) +
                           (done > 0 ? print("; %d of them are done", done) : "") + "\n\n" +
                           "Means over the realizations so far at the last level; scatter is the standard deviation of one realization.\n" +
                           print("%12s %14s %10s %14s %10s %12s %10s\n", "realizations", ("N [" + N + "]").c_str(), "scatter",
                                 ("A [" + l + "2]").c_str(), "scatter", "elapsed", "a second");
        const auto spread = [&](const char* name, std::size_t n) {
            double mean = 0, square = 0;
            for (std::size_t k = 0; k < n; ++k) mean += at(name, k * steps + steps - 1) / static_cast<double>(n);
            for (std::size_t k = 0; k < n; ++k) square += std::pow(at(name, k * steps + steps - 1) - mean, 2);
            return std::pair(mean, n > 1 ? std::sqrt(square / static_cast<double>(n - 1)) : 0.0);
        };
        const std::size_t batch = std::max<std::size_t>(1, total / 20);
        for (std::size_t n = static_cast<std::size_t>(done) + 1; n <= total; ++n) {
            if (n % batch != 0) continue;
            const auto [force, force_scatter] = spread("force", n);
            const auto [area, area_scatter] = spread("contact_area", n);
            text += print("%12zu %14.8g %10.3g %14.8g %10.3g TIME\n", n, force, force_scatter, area, area_scatter);
        }
        text += compared();
        text += print("\nmean curve of %zu realizations\nlevel %12s  Z0/sigma %14s    scatter %14s    scatter\n", total,
                      ("Z0 [" + l + "]").c_str(), ("N [" + N + "]").c_str(), ("A [" + l + "2]").c_str());
        const std::size_t rows = std::min<std::size_t>(steps, 11);
        for (std::size_t r = 0; r < rows; ++r) {
            const std::size_t s = rows > 1 ? r * (steps - 1) / (rows - 1) : 0;
            double Z0 = 0;
            for (std::size_t k = 0; k < total; ++k) Z0 += separation(k * steps + s) / static_cast<double>(total);
            text += print("%5zu %12.6g %9.5f %14.8g %10.3g %14.8g %10.3g\n", s + 1, Z0, Z0 / sigma, at("force_mean", s), at("force_std", s),
                          at("contact_area_mean", s), at("contact_area_std", s));
        }
        text += print("\n%zu realizations, %zu levels in TIME\n", total, levels);
        double m2 = 0;
        for (const double m : f.values("m2")) m2 += m / static_cast<double>(total);
        text += print("surfaces: rms slope %.4g", std::sqrt(2 * m2)) + of_slope(std::sqrt(2 * m2)) + "\n";
        return text + remarks() + print("result: %s\npicture: python3 output/plot/plot.py %s\n", path.c_str(), path.c_str());
    }

    const std::string path;
    const Case& c;
    Reader f;
    mutable std::map<std::string, Vector> read_;
    const std::string l, N;
    double sigma;
    bool flats, elements;
    std::size_t levels, steps;
    std::string map_line, grid, first_map;  // of a measured map, of a comparison, of the first of several: not in the file
};

struct Ran {
    Case settings;
    std::string screen, messages;
    long failed = 0;
};

Ran run(const std::string& text, const std::string& file, bool resume = false) {
    Ran ran;
    ran.settings = read_case_text(text, "case.nml").settings;
    ran.settings.output.file = file;
    ran.settings.run.threads = 1;
    std::ostringstream table, messages;
    RunOptions options;
    options.table = &table;
    options.messages = &messages;
    options.progress = Progress::never;
    options.resume = resume;
    ran.failed = run_case(ran.settings, options);
    ran.screen = without_times(table.str());
    ran.messages = messages.str();
    return ran;
}

std::string failed_text(long failed, std::size_t levels) {
    if (failed == 0) return {};
    return print(
        "rsc: %ld of %zu levels did not converge; their values are in the file with status = 4. Raise solver%%max_iterations or "
        "solver%%tolerance.\n",
        failed, levels);
}

// A single run; returns its screen.
std::string single(const Folder& folder, const std::string& text, const std::string& map_line = "", const std::string& grid = "") {
    const std::string file = folder / "single.nc";
    std::filesystem::remove(file);
    for (const bool replaces : {false, true}) {
        const Ran ran = run(text, file);
        Screen s(file, ran.settings);
        s.map_line = map_line, s.grid = grid;
        same_lines(ran.screen, s.single(replaces), text);
        CHECK(ran.failed == s.failed() && ran.messages == failed_text(s.failed(), s.levels));
        if (replaces) return ran.screen;
        if (text.find("title") == std::string::npos) return ran.screen;
    }
    return {};
}

void campaign(const Folder& folder, const std::string& text, const std::string& first_map = "", const std::string& grid = "") {
    const std::string file = folder / "campaign.nc";
    std::filesystem::remove(file);
    const Ran ran = run(text, file);
    Screen s(file, ran.settings);
    s.first_map = first_map, s.grid = grid;
    same_lines(ran.screen, s.campaign(0, 1), text);
    CHECK(ran.failed == s.failed() && ran.messages == failed_text(s.failed(), s.levels));
}

std::string map_text(std::size_t nx, std::size_t ny, double scale, unsigned salt) {
    std::string text;
    for (std::size_t j = 0; j < ny; ++j) {
        for (std::size_t i = 0; i < nx; ++i) {
            double z = 0;
            for (unsigned k = 1; k <= 12; ++k)
                z += std::sin(0.55 * k * std::cos(k + salt) * static_cast<double>(i) +
                              0.6 * k * std::sin(k * 1.3) * static_cast<double>(j) + k * k) /
                     k;
            text += print("%.6f ", scale * z);
        }
        text += "\n";
    }
    return text;
}

void runs(const Folder& folder) {
    const std::string surface = "&surface n=128 L_lambda_l=4 L_lambda_s=32 ";
    std::string seen;
    const auto add = [&](const std::string& text, const std::string& map_line = "", const std::string& grid = "") {
        seen += single(folder, text, map_line, grid);
    };
    // Other units, a title, unlike bodies; levels from no contact to far too deep.
    add(surface +
        "L=2.5 sigma=0.02 / &indentation levels=6, 3, 1.5, 0, -2.9, -3.1, centre=1.1, 1.4 / &run title='A title' length_unit='um' force_unit='mN' "
        "seed=5 first_realization=7 / &solids E=1e4,3e4 nu=0.1,0.4 R=3,7 /");
    add(surface + "sigma=0.2 / &indentation levels=3,-0.5,-2 /");  // far too steep
    add(surface + "sigma=0.2 / &indentation levels=2,-0.5 / &solver method='dgesv' /");
    add(surface + "sigma=0.1 / &asperities law='fourth_order' / &solids R=Infinity,Infinity / &indentation levels=0,-4 /");
    add(surface + "sigma=0.001 / &indentation steps=3 /");  // small slopes
    add(surface + "sigma=0.003 / &indentation steps=3 /");  // strained ones
    add(surface + "/ &asperities law='fourth_order' / &indentation levels=3,1,-1 /");
    add(surface + "/ &indentation levels=2.5,2 selection='paper' / &solver method='dgesv' /");
    add(surface + "/ &indentation levels=2,0,-1 / &solver method='dgesv' max_iterations=3 /");
    add(surface + "/ &indentation levels=2,1 / &solver method='mesh' interaction='none' /");
    add(surface + "/ &indentation levels=2,1 / &solver method='mesh' /");
    add("&surface n=64 L_lambda_l=2 L_lambda_s=16 / &indentation levels=0.5,0,-1 / &solver max_iterations=1 /");
    add(surface + "/ &indentation control='force' levels=0.01,0.5,8 /");
    add(surface + "/ &solids hardness=2000 size_effect=1e-3 / &indentation levels=3,1.5,0.5,1 /");
    add(surface + "sigma=0.001 / &solids hardness=1e6 / &indentation levels=3,1.5,0.5 /");
    add(surface + "/ &solids friction=0.3 resistivity=1e-5,2e-5 / &indentation levels=3,2 /");
    add(surface + "/ &compare levels=5,2,1 / &indentation levels=5,2,1.5,1 /", "", "256 x 256");
    add(surface + "/ &solver max_iterations=2 / &compare levels=1 / &indentation levels=5,1 /", "", "256 x 256");
    add(surface + "/ &solver model='elements' / &indentation levels=6,2,1 /");
    add(surface + "/ &solver model='elements' / &solids hardness=5000 / &indentation levels=3,1 /");
    const std::string flats = "&solids R=Infinity,Infinity E=5e4,2e5 nu=0.3,0.2 / &indentation boundary='periodic' ";
    add(surface + "/ " + flats + "control='pressure' unit='relative' levels=0.002,0.01,0.05 / &run length_unit='um' force_unit='kN' /");
    add(surface + "L=1.5 / " + flats + "levels=2.5,2 / &solver model='elements' /");
    // Lists and maps; a map of 50 x 40 points of one size, and one with holes and a form.
    std::ofstream(folder / "list.txt") << "0.3 0.4 0.012 0.5\n0.5 0.42 0.01 0.4\n0.52 0.7 0.011 0.2\n";
    const std::string list = "&surface source='asperities' sigma=0.01 file='" + folder / "list.txt" + "' ";
    add(list + "L=1.0 / &indentation levels=2,0,-3,-3.000001 /");
    add(list + "/ &indentation levels=0,-2,-4 /");
    std::ofstream(folder / "near.txt") << "0.5 0.5 0.01 0.5\n0.501 0.5 0.0101 0.5\n";
    add("&surface source='asperities' sigma=0.01 L=1 file='" + folder / "near.txt" +
        "' / &indentation levels=0.5,-1 / &solver method='dgesv' /");
    add("&surface source='asperities' sigma=0.01 L=1 file='" + folder / "near.txt" +
        "' / &indentation levels=0.5,-1 / &solver interaction='none' /");
    std::ofstream(folder / "map.txt") << map_text(50, 40, 0.01, 1);
    const std::string map = "source='heights' file='" + folder / "map.txt" + "' ";
    add("&surface L=5.0 " + map + "/ &indentation steps=3 /", "map: 50 x 40 points of 0.1 x 0.1 mm, 5 x 4 mm");
    add("&surface L=10.0 detrend='quadratic' filter_cutoff=0.9 sigma=0.02 " + map + "/ &indentation levels=3,1 / &compare levels=1 /",
        "map: 50 x 40 points of 0.2 x 0.2 mm, 10 x 8 mm", "50 x 40");
    add("&surface L=5.0 " + map + "/ " + flats + "levels=2 /", "map: 50 x 40 points of 0.1 x 0.1 mm, 5 x 4 mm");
    std::string holes = map_text(48, 40, 0.01, 2);
    holes.replace(holes.find(' ', 3000) + 1, 8, "nan     ");
    std::ofstream(folder / "holes.txt") << holes;
    add("&surface L=4.8 missing='fill' detrend='sphere' source='heights' file='" + folder / "holes.txt" + "' / &indentation steps=2 /",
        "map: 48 x 40 points of 0.1 x 0.1 mm, 4.8 x 4 mm");
    add("&surface L=4.8 missing='fill' detrend='none' source='heights' file='" + folder / "holes.txt" +
            "' / &indentation steps=2 / &solver model='elements' /",
        "map: 48 x 40 points of 0.1 x 0.1 mm, 4.8 x 4 mm");
    std::string bowl, noise;
    for (int j = 0; j < 12; ++j, bowl += "\n", noise += "\n")
        for (int i = 0; i < 14; ++i) {
            bowl += print("%.9f ", 0.002 * ((i - 6) * (i - 6) + (j - 5) * (j - 5)) + 0.001 * std::sin(7.7 * i * i + 3.3 * j * j + i * j));
            noise += print("%.9f ", std::pow(std::sin(9.1 * i + 5.7 * j * j + 0.1 * i * j), 9));
        }
    std::ofstream(folder / "bowl.txt") << bowl;
    add("&surface L=7.0 detrend='sphere' source='heights' file='" + folder / "bowl.txt" + "' / &indentation levels=1,0 /",
        "map: 14 x 12 points of 0.5 x 0.5 mm, 7 x 6 mm");
    std::string dome;
    for (int j = 0; j < 12; ++j, dome += "\n")
        for (int i = 0; i < 14; ++i)
            dome += print("%.9f ", -0.003 * ((i - 6) * (i - 6) + (j - 5) * (j - 5)) + 0.001 * std::sin(7.7 * i * i + 3.3 * j * j + i * j));
    std::ofstream(folder / "dome.txt") << dome;
    add("&surface L=7.0 detrend='sphere' source='heights' file='" + folder / "dome.txt" + "' / &indentation levels=1,0 /",
        "map: 14 x 12 points of 0.5 x 0.5 mm, 7 x 6 mm");
    std::ofstream(folder / "noise.txt") << noise;
    add("&surface L=7.0 detrend='mean' source='heights' file='" + folder / "noise.txt" + "' / &indentation levels=1,0 /",
        "map: 14 x 12 points of 0.5 x 0.5 mm, 7 x 6 mm");

    // Both ways of every remark were met, or the runs above prove nothing of them.
    for (const char* words : {"out of validity",
                              "overlapping",
                              "not unique",
                              "NOT CONVERGED",
                              "of the surface's border",
                              "separation below -3 sigma",
                              "a > <d>/4",
                              "contact area above the nominal",
                              "beyond what the law knows",
                              "more than 30 %",
                              "pressures above E*/10",
                              "contacts yield",
                              "nothing yields",
                              "map cells",
                              "above 0.5 the theory",
                              "above 2 the theory",
                              "there is no interaction",
                              "dgesv did not converge",
                              "not proved unique",
                              "mesh (",
                              "dgesv (",
                              "direct (",
                              "missing points: 1 ",
                              "warning: fewer than 4",
                              "warning: the map is not isotropic",
                              "(dome)",
                              "(bowl)",
                              "slopes ",
                              "filter (Gaussian",
                              "(the grid's: no end seen)",
                              "N = 0 ",
                              "ELEMENTS DID NOT CONVERGE",
                              "spectrum: hurst",
                              "spectrum: none",
                              "Z0 [um]"}) {
        const bool met = seen.find(words) != std::string::npos;
        if (!met) std::printf("  never met: %s\n", words);
        CHECK(met);
    }
}

// What lies beside a measured map's result, and what is told where it cannot be.
void twins(const Folder& folder) {
    std::ofstream(folder / "map.txt") << map_text(50, 40, 0.01, 1);
    const std::string text = "&surface L=5.0 source='heights' file='" + folder / "map.txt" + "' / &indentation levels=3 /";
    const std::string file = folder / "measured.nc", twins = folder / "measured_twins.nml";
    run(text, file);
    const std::string mark = "! Written by rsc beside a measured map's result, and again with it: change a copy.\n&run\n";
    CHECK(bytes(twins).starts_with(mark + "  title             = 'Surfaces with the spectrum of map.txt'\n"));
    CHECK(!Reader(file).has("height"));
    run(text + " &output heights=.true. /", file);
    CHECK(Reader(file).values("height").size() == 2000);
    std::ofstream(twins, std::ios::app) << "! and more";
    run(text, file);
    CHECK(bytes(twins).starts_with(mark) && bytes(twins).find("! and more") == std::string::npos);
    std::ofstream(twins) << "mine\n";
    const Ran ran = run(text, file);
    CHECK(ran.screen.find("\ntwins: " + twins + " is there already and was not written by rsc: left as it is\n") != std::string::npos);
    CHECK(bytes(twins) == "mine\n");
    std::filesystem::remove(twins);
    std::filesystem::create_directory(twins + ".part");
    try {
        run(text, file);
        CHECK(!"twins that cannot be written are told");
    } catch (const Error& error) {
        CHECK(error.kind() == Failure::file_system && error.what() == twins + ": could not be written");
    }
    // Two flats nearer than the mean planes: elements have no such level, and the others are compared.
    const Ran flats =
        run("&surface n=128 L_lambda_l=4 L_lambda_s=32 / &solids R=Infinity,Infinity / &indentation boundary='periodic' levels=2,-0.5 / "
            "&compare levels=2,-0.5 /",
            folder / "flats.nc");
    CHECK(flats.failed == 1 && flats.screen.find("\nlevel 2, Z0/sigma -0.5: not compared: ") != std::string::npos);
    CHECK(Reader(folder / "flats.nc").values("compare_step") == Vector{1});
}

void campaigns(const Folder& folder) {
    const std::string surface = "&surface n=64 L_lambda_l=2 L_lambda_s=16 ";
    campaign(
        folder,
        surface +
            "sigma=0.02 / &indentation start=3.5 stop=0 steps=25 / &run realizations=43 first_realization=3 length_unit='um' force_unit='mN' title='Many' / "
            "&solids E=1e4,3e4 nu=0.1,0.4 R=3,7 /");
    campaign(folder, surface + "/ &indentation control='force' levels=0.5,2 / &run realizations=3 / &compare levels=2 /", "", "128 x 128");
    campaign(folder, surface + "/ &indentation levels=1 / &run realizations=2 / &solids hardness=3000 /");
    campaign(folder, surface + "/ &indentation levels=0.5,0 / &run realizations=2 / &solver max_iterations=1 /");
    campaign(folder, surface + "sigma=1e-3 / &indentation levels=2,1.5 / &run realizations=2 / &solver model='elements' /");
    campaign(
        folder,
        surface +
            "/ &solids R=Infinity,Infinity / &indentation boundary='periodic' control='pressure' unit='pressure' levels=50,100,200 / &run realizations=2 /");
    for (const unsigned k : {1U, 2U}) std::ofstream(folder / ("m" + std::to_string(k) + ".txt")) << map_text(50, 40, 0.01, k);
    const std::string keys = "&surface source='heights' L=5.0 file='", one = folder / "one_map.nc";
    const Ran first_ran = run(keys + folder / "m1.txt" + "' / &indentation levels=2 /", one);
    Screen first(one, first_ran.settings);
    first.map_line = "map: 50 x 40 points of 0.1 x 0.1 mm, 5 x 4 mm";
    campaign(folder, keys + folder / "m?.txt" + "' / &indentation steps=3 / &run realizations=2 /",
             "the first of the maps:\n" + first.measured());
    // What was done before is told.
    const std::string file = folder / "campaign.nc", more = " / &indentation levels=2,1 / &run realizations=";
    std::filesystem::remove(file);
    run(surface + more + "3 /", file);
    const Ran grown = run(surface + more + "5 /", file, true);
    std::string expected = Screen(file, grown.settings).campaign(3, 1);
    expected.replace(expected.find("result: " + file + "\n"), 8 + file.size(), "result: " + file + " (replaces the result that was there)");
    same_lines(grown.screen, expected, "grown");
    CHECK(grown.messages.empty());
}

}  // namespace

int main() {
    const Folder folder;
    omp_set_num_threads(1);
    runs(folder);
    twins(folder);
    campaigns(folder);
    return check::summary();
}
