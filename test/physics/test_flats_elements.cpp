// Asperities between two flats against the independent solution on the points of the same surface, and that against a closed form.
#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "periodic_elements.hpp"
#include "rough/detection.hpp"
#include "rough/synthesis.hpp"

using namespace rsc;

namespace {

// The independent solver on a wave of one direction: flattened altogether from the pressure E* k A/2 on, the separation then 0; below it
// Westergaard's solution.
void the_solver_itself() {
    constexpr int n = 64;
    const double pi = std::numbers::pi;
    std::vector<double> z;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) z.push_back(0.01 * std::cos(2 * pi * i / n));
    PeriodicElementSolver solver(n, 1, z, 2);
    const double full = 2 * 2 * pi * 0.01 / 2;
    const PeriodicElements closed = solver.press(1.05 * full, 1e-10);
    CHECK_CLOSE(closed.separation, 0, 1e-10);
    CHECK(closed.area_fraction == 1);
    // Westergaard (Johnson 1985, section 13.2): p/full = sin^2(pi A/(2 A0)).
    const PeriodicElements half = solver.press(0.5 * full, 1e-10);
    CHECK_CLOSE(half.area_fraction, 0.5, 1.5 / n);
}

void asperities_and_elements() {
    constexpr double kArea = 0.08, kSeparation = 0.02;  // of the area, of the rms height
    const Spectrum spectrum{1, 0.8, 4, 32, false, 0.01};
    constexpr int n = 512;
    const HeightMap map = synthesize(spectrum, n, Normalise::sample, 1, 1, nullptr, 1);
    std::vector<double> z;
    for (int j = 0; j < n; ++j) z.insert(z.end(), map.row(j), map.row(j) + n);
    const double slope = std::sqrt(2 * theoretical_moments(spectrum).m2);
    const Asperities a = find_asperities(map, Curvature::geometric, nullptr, 1, Detail::subgrid, n / 32.0);
    SolverOptions options;
    options.law = LawKind::fourth_order;
    options.sigma = 0.01;
    AsperityContact contact(a, {1, Period{}.x, 0, 0, {1, 1}}, options);
    PeriodicElementSolver elements(n, 1, z, 1);
    std::printf("p/(E* h')   A E* h'/N elements, asperities   separation/sigma\n");
    for (double p : {0.05, 0.02, 0.01, 0.005}) {
        const PeriodicElements truth = elements.press(p * slope, 1e-5);
        const Level level = contact.at_force(p * slope);
        std::printf("%8.3f   %.4f %.4f   %.4f %.4f   (%d)\n", p, truth.border / p, level.area / p, truth.separation / 0.01,
                    level.separation / 0.01, truth.iterations);
        if (p > 0.02) continue;
        CHECK_RELATIVE(level.area, truth.border, kArea);
        CHECK_CLOSE(level.separation / 0.01, truth.separation / 0.01, kSeparation);
    }
}

}  // namespace

int main() {
    the_solver_itself();
    asperities_and_elements();
    return check::summary();
}
