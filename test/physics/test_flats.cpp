// A case of two flats from its text to its file: what is refused by name, what the file holds.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "case/read_case.hpp"
#include "check.hpp"
#include "error.hpp"
#include "observe/regimes.hpp"
#include "result_reader.hpp"
#include "run/run.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;

namespace {

const std::string kFlat = "&solids E = 3, Infinity  nu = 0, 0  R = Infinity, Infinity /\n";

// What is said of a case, empty if it is sound.
std::string complaint(const std::string& text) {
    try {
        read_case_text(text, "case.nml");
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

#define SAYS(text, what)                                                             \
    do {                                                                             \
        const std::string said = complaint(text);                                    \
        if (said.find(what) == std::string::npos) std::printf("%s\n", said.c_str()); \
        CHECK(said.find(what) != std::string::npos);                                 \
    } while (0)

void refused_by_name() {
    CHECK(complaint(kFlat + "&indentation boundary = 'periodic' /").empty());
    CHECK(complaint(kFlat + "&indentation boundary = 'periodic', control = 'pressure', unit = 'relative', start = 0.01, stop = 0.02 /")
              .empty());
    SAYS("&indentation boundary = 'periodic' /", "boundary = 'periodic': is for two flats, and R = Infinity, 2.5");
    SAYS(kFlat + "&indentation control = 'pressure', unit = 'relative', start = 0.01, stop = 0.02 /", "needs a nominal area");
    SAYS(kFlat + "&indentation boundary = 'periodic', control = 'pressure', start = 0.01, stop = 0.02 /",
         "with control = 'pressure' it is 'relative' or 'pressure'");
    SAYS(kFlat + "&indentation boundary = 'periodic', unit = 'relative' /", "with control = 'separation' it is 'sigma' or 'length'");
    SAYS(kFlat + "&indentation boundary = 'periodic', control = 'pressure', unit = 'relative', start = 0.01, stop = 1.2 /",
         "closes the gap altogether");
    SAYS(kFlat + "&indentation boundary = 'periodic', control = 'pressure', unit = 'pressure', start = -1, stop = 1.2 /",
         "must be positive");
    SAYS(kFlat + "&indentation boundary = 'periodic', selection = 'paper' /", "two flats have no sphere");
    SAYS(kFlat + "&surface source = 'asperities', file = 'a.txt' / &indentation boundary = 'periodic' /", "does not say with which period");
}

const std::string kSurface = "&surface L = 2, n = 128, L_lambda_l = 2, L_lambda_s = 16, sigma = 0.01 /\n";

void run_one(const std::string& text, const std::string& file) {
    Case settings = read_case_text(text, "case.nml").settings;
    settings.output.file = file;
    CHECK(run_case(settings, {}) == 0);
}

void the_file() {
    const Folder folder;
    const std::string name = folder / "flat.nc", again = folder / "again.nc";
    run_one(kFlat + kSurface +
                "&indentation boundary = 'periodic', control = 'pressure', unit = 'relative', levels = 0.001, 0.005, 0.02 /"
                "&solver tolerance = 1e-8 /",
            name);
    const Reader file(name);
    for (const char* absent : {"radius", "radial_pressure", "radial_area_fraction", "hertz_pressure", "area_hertz"})
        CHECK(!file.has(absent));
    const auto p = file.values("pressure"), N = file.values("force"), A = file.values("contact_area"), share = file.values("area_fraction"),
               m2 = file.values("m2_theory"), S = file.values("stiffness"), persson = file.values("area_persson"),
               bgt = file.values("area_bgt"), gw = file.values("area_gw"), Z0 = file.values("separation");
    // Greenwood and Williamson's summits as the file says: its own, with Nayak's variance of their heights.
    const double m0 = file.values("m0_theory")[0], m4 = file.values("m4_theory")[0];
    const FlatSummits own{file.values("summits")[0] / 4, 1 / file.values("mean_kappa_g")[0], std::sqrt(m0 - 0.8968 * m2[0] * m2[0] / m4)};
    CHECK(p.size() == 3);
    const double wanted[] = {0.001, 0.005, 0.02}, full = 3 * std::sqrt(2 * m2[0]);
    for (std::size_t k = 0; k < p.size(); ++k) {
        CHECK_RELATIVE(p[k], wanted[k] * full, 1e-7);
        CHECK_RELATIVE(N[k], 4 * p[k], 1e-14);
        CHECK_RELATIVE(A[k], 4 * share[k], 1e-14);
        CHECK(S[k] < 0);
        CHECK_RELATIVE(persson[k], std::erf(std::sqrt(2.0) * wanted[k]), 1e-7);
        CHECK_RELATIVE(bgt[k], std::sqrt(2 * std::numbers::pi) * wanted[k], 1e-7);
        CHECK_RELATIVE(gw[k], area_gw(p[k] / 3, own), 1e-4);  // 0.8968 has four digits
        CHECK(share[k] > 0.6 * bgt[k] && share[k] < 1.2 * bgt[k]);
    }
    // The same separations give the same forces.
    std::string levels;
    char number[40];
    for (double z : Z0) std::snprintf(number, sizeof number, "%.17g ", z), levels += number;
    run_one(kFlat + kSurface + "&indentation boundary = 'periodic', unit = 'length', levels = " + levels + "/ &solver tolerance = 1e-8 /",
            again);
    const Reader other(again);
    const auto back = other.values("force");
    for (std::size_t k = 0; k < N.size(); ++k) CHECK_RELATIVE(back[k], N[k], 1e-6);
}

// The same by elements: by pressure and back by separation; beside asperities by &compare; a gap that is closed altogether.
void by_elements() {
    const Folder folder;
    const std::string name = folder / "flat.nc", again = folder / "again.nc", both = folder / "both.nc";
    const std::string pressures =
                          "&indentation boundary = 'periodic', control = 'pressure', unit = 'relative', levels = 0.001, 0.01, 0.1 / ",
                      solver = "&solver tolerance = 1e-8, model = 'elements' /";
    run_one(kFlat + kSurface + pressures + solver, name);
    const Reader file(name);
    CHECK(!file.has("radius") && !file.has("area_hertz"));
    const auto p = file.values("pressure"), N = file.values("force"), share = file.values("area_fraction"), m2 = file.values("m2_theory"),
               S = file.values("stiffness"), W = file.values("energy"), Z0 = file.values("separation"), status = file.values("status");
    const double wanted[] = {0.001, 0.01, 0.1}, full = 3 * std::sqrt(2 * m2[0]);
    std::string levels;
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK_RELATIVE(p[k], wanted[k] * full, 1e-12);
        CHECK_RELATIVE(N[k], 4 * p[k], 1e-14);
        CHECK(S[k] < 0 && W[k] > 0 && status[k] == 0);
        std::printf("elements, p/(E* h') = %g: A/A0 %g\n", wanted[k], share[k]);
        CHECK(share[k] > 1.5 * wanted[k] && share[k] < 3.2 * wanted[k]);
        char number[40];
        std::snprintf(number, sizeof number, "%.17g ", Z0[k]);
        levels += number;
    }
    run_one(kFlat + kSurface + "&indentation boundary = 'periodic', unit = 'length', levels = " + levels + "/" + solver, again);
    const auto back = Reader(again).values("force");
    for (std::size_t k = 0; k < 3; ++k) CHECK_RELATIVE(back[k], N[k], 1e-6);
    // Asperities, and elements at the same separations.
    run_one(kFlat + kSurface + pressures + "&compare levels = 0.01, 0.001 / &asperities law = 'fourth_order' /", both);
    const Reader compared(both);
    const auto step = compared.values("compare_step"), force_error = compared.values("force_error"),
               at = compared.values("compare_separation"), asperities = compared.values("separation");
    CHECK(step.size() == 2 && step[0] == 2 && step[1] == 1);
    CHECK(at[0] == asperities[1]);
    for (double e : force_error) CHECK(std::abs(e) < 0.25);
    const auto told = [&](const std::string& indentation) {
        Case settings =
            read_case_text(kFlat + kSurface + "&indentation boundary = 'periodic', " + indentation + " / " + solver, "case.nml").settings;
        settings.output.file = folder / "none.nc";
        try {
            run_case(settings, {});
        } catch (const Error& e) {
            CHECK(e.kind() == Failure::bad_input);
            return std::string(e.what());
        }
        return std::string();
    };
    CHECK(told("levels = 1, 0").find("a separation of 0 closes the gap altogether") != std::string::npos);
    CHECK(told("control = 'pressure', unit = 'pressure', levels = 1, 2").find("closes the gap altogether") != std::string::npos);
    CHECK(!std::filesystem::exists(folder / "none.nc"));
}

// A rectangular map of rectangular pixels, through the program and both models: two of its periods are a square, which carries twice the
// force on twice the area at the same separation.
void rectangular_maps() {
    const Folder folder;
    constexpr int nx = 96, ny = 32;
    constexpr double dx = 2.0 / nx, dy = 1.0 / ny;  // 2 x 1
    const auto map = [&](int periods) {
        const std::string name = folder / ("map" + std::to_string(periods) + ".txt");
        std::ofstream out(name);
        out.precision(17);
        for (int j = 0; j < periods * ny; ++j)
            for (int i = 0; i < nx; ++i) {
                double z = 0;
                for (const auto& [a, b, phase] : {std::tuple{3, 1, 0.3}, {2, -2, 1.1}, {5, 2, 2.0}, {1, 3, 0.7}, {7, -1, 1.9}, {6, 3, 0.1}})
                    z += 0.02 / (a + std::abs(b)) * std::cos(2 * std::numbers::pi * (a * i / double(nx) + b * j / double(ny)) + phase);
                out << i * dx << ' ' << j * dy << ' ' << z << '\n';
            }
        return name;
    };
    for (const char* model : {"asperities", "elements"}) {
        std::vector<double> Z0, N, share, contacts, S;
        for (const int periods : {1, 2}) {
            const std::string file = folder / "map.nc";
            run_one(kFlat + "&surface source = 'heights', file = '" + map(periods) +
                        "', detrend = 'mean' / &asperities law = 'fourth_order' / " +
                        "&indentation boundary = 'periodic', control = 'pressure', unit = 'pressure', levels = 0.002, 0.01 / " +
                        "&solver tolerance = 1e-9, model = '" + model + "' /",
                    file);
            const Reader result(file);
            for (const auto& [to, name] :
                 {std::pair{&Z0, "separation"}, {&N, "force"}, {&share, "area_fraction"}, {&contacts, "contacts"}, {&S, "stiffness"}})
                for (double v : result.values(name)) to->push_back(v);
        }
        for (std::size_t k = 0; k < 2; ++k) {
            CHECK_RELATIVE(N[k], k == 0 ? 0.004 : 0.02, 1e-7);
            CHECK_RELATIVE(N[k + 2], 2 * N[k], 1e-7);
            CHECK(contacts[k] > 0 && contacts[k + 2] == 2 * contacts[k]);
            CHECK_RELATIVE(share[k + 2], share[k], 1e-6);
            CHECK_RELATIVE(Z0[k + 2], Z0[k], 1e-7);
            CHECK_RELATIVE(S[k + 2], 2 * S[k], 1e-5);
        }
        std::printf("2 x 1, %s: Z0 %.6g %.6g, A/A0 %.5g %.5g\n", model, Z0[0], Z0[1], share[0], share[1]);
    }
}

// At h = 0: F_1 = 1/sqrt(2 pi), F_{3/2} = 2^(-1/4) Gamma(5/4)/sqrt(pi).
// Crowded asperities, a fifth of the area in contact, several solutions at the deep levels, whose separations trials reach by another
// branch than the answers: all are found.
void crowded() {
    const Folder folder;
    const std::string text = kFlat +
                             "&surface n=256 L_lambda_l=8 L_lambda_s=64 sigma=0.01 / &asperities law='fourth_order' / "
                             "&run first_realization=4 / &indentation boundary='periodic' start=4.5 stop=0.6 steps=40 /";
    run_one(text, folder / "deep.nc");
}

void greenwood_williamson() {
    const FlatSummits s{40, 0.02, 0.003};
    const double sum = std::pow(2.0, -0.25) * std::tgamma(1.25) / std::sqrt(std::numbers::pi);
    const double p = 4.0 / 3 * s.density * std::sqrt(s.radius) * std::pow(s.deviation, 1.5) * sum;
    CHECK_RELATIVE(area_gw(p, s), std::numbers::pi * s.density * s.radius * s.deviation / std::sqrt(2 * std::numbers::pi), 1e-8);
    CHECK(area_gw(0, s) == 0);
}

}  // namespace

int main() {
    refused_by_name();
    the_file();
    by_elements();
    rectangular_maps();
    greenwood_williamson();
    crowded();
    return check::summary();
}
