// Two flats through the program: a rectangular map beside its double, and the theory of summits.
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

const std::string kSurface = "&surface L = 2, n = 128, L_lambda_l = 2, L_lambda_s = 16, sigma = 0.01 /\n";

void run_one(const std::string& text, const std::string& file) {
    Case settings = read_case_text(text, "case.nml").settings;
    settings.output.file = file;
    CHECK(run_case(settings, {}) == 0);
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

void greenwood_williamson() {
    const FlatSummits s{40, 0.02, 0.003};
    const double sum = std::pow(2.0, -0.25) * std::tgamma(1.25) / std::sqrt(std::numbers::pi);
    const double p = 4.0 / 3 * s.density * std::sqrt(s.radius) * std::pow(s.deviation, 1.5) * sum;
    CHECK_RELATIVE(area_gw(p, s), std::numbers::pi * s.density * s.radius * s.deviation / std::sqrt(2 * std::numbers::pi), 1e-8);
    CHECK(area_gw(0, s) == 0);
}

}  // namespace

TESTS {
    rectangular_maps();
    greenwood_williamson();
}
