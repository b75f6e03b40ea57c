// A case of two flats from its text to its file: what is refused by name, what the file holds.
#include <cmath>
#include <numbers>
#include <string>

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
    SAYS(kFlat + "&indentation boundary = 'periodic', selection = 'paper' /", "two flats have none");
    SAYS(kFlat + "&surface source = 'asperities', file = 'a.txt' / &indentation boundary = 'periodic' /", "has no period of its own");
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
    CHECK(p.size() == 3);
    const double wanted[] = {0.001, 0.005, 0.02}, full = 3 * std::sqrt(2 * m2[0]);
    for (std::size_t k = 0; k < p.size(); ++k) {
        CHECK_RELATIVE(p[k], wanted[k] * full, 1e-7);
        CHECK_RELATIVE(N[k], 4 * p[k], 1e-14);
        CHECK_RELATIVE(A[k], 4 * share[k], 1e-14);
        CHECK(S[k] < 0);
        CHECK_RELATIVE(persson[k], std::erf(std::sqrt(2.0) * wanted[k]), 1e-7);
        CHECK_RELATIVE(bgt[k], std::sqrt(2 * std::numbers::pi) * wanted[k], 1e-7);
        CHECK(gw[k] > 0.5 * bgt[k] && gw[k] < 1.5 * bgt[k]);
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

// At h = 0: F_1 = 1/sqrt(2 pi), F_{3/2} = 2^(-1/4) Gamma(5/4)/sqrt(pi).
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
    greenwood_williamson();
    return check::summary();
}
