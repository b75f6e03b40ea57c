// What elements cost: a level cold, a series of levels, between flats.
#include "bench.hpp"
#include "contact/make.hpp"
#include "surface/synthesis.hpp"

using namespace rsc;

namespace bench {
namespace {

SolverOptions options() { return {.tolerance = 1e-6, .max_iterations = 200}; }

HeightMap surface(int n, double L_lambda_s) {
    Spectrum spectrum{.L_lambda_s = L_lambda_s};
    return synthesize(spectrum, n, Normalise::sample, 1, 1);
}

// One level at Z0, nothing known of others.
Level cold(const HeightMap& map, const Indenter& indenter, double Z0, int runs, double& time) {
    Level level;
    time = shortest(
        runs, [&] { level = make_element_contact(map, indenter, options())->at_separation(Z0); });
    return level;
}

void print_cold(const char* what, const HeightMap& map, double wanted) {
    double time = 0;
    const Level level = cold(map, kGold, 0.01, 3, time);
    std::printf(
        "  %s, Z0 = sigma, cold: %zu pixels in contact of %d with g0 > 0, %d rounds, %ld products, "
        "residual %.1e%s: %.3f s (wanted: %g)\n",
        what, level.pixels.index.size(), level.candidates, level.iterations, long(level.products),
        level.residual, !level.converged ? ", NOT CONVERGED" : "", time, wanted);
}

}  // namespace

void elements() {
    std::printf(
        "\nelements: default surface, 8 points in the shortest wave, tolerance 1e-6, one thread\n");
    print_cold("1024^2, L/lambda_s = 128", surface(1024, 128), 0.2);
    print_cold("2048^2, L/lambda_s = 256", surface(2048, 256), 0.4);
    HeightMap map;
    const double make = shortest(1, [&] { map = surface(4096, 512); });
    print_cold("4096^2, L/lambda_s = 512", map, 2);
    double force = 0;
    const double series = shortest(1, [&] {
        const auto contact = make_element_contact(map, kGold, options());
        for (int k = 0; k < 100; ++k)
            force = contact->at_separation(0.01 * (4 - 3.0 * k / 99)).force;
    });
    std::printf(
        "  4096^2: heights made in %.2f s; 100 levels from 4 to 1 sigma, N = %.2f N at the last: "
        "%.2f s (wanted: 40)\n",
        make, force, series);
    std::printf("  peak memory so far %.0f MB (wanted: 1000)\n", peak_memory_mb());
}

void element_flats() {
    std::printf(
        "\nelement_flats: two flats, L/lambda_l = 8, 8 points in the shortest wave, tolerance "
        "1e-6, one thread\n");
    for (const int n : {1024, 2048, 4096}) {
        Spectrum spectrum{.L_lambda_l = 8, .L_lambda_s = n / 8.0};
        const HeightMap map = synthesize(spectrum, n, Normalise::sample, 1, 1);
        const Indenter flat{kGold.E_star, HUGE_VAL, 0, 0, {map.Lx(), map.Ly()}};
        const auto contact = make_element_contact(map, flat, options());
        const double highest = 0.02 * kGold.E_star * theoretical_moments(spectrum).rms_slope();
        Level level;
        const double one = shortest(n < 4096 ? 3 : 1, [&] { level = contact->at_force(highest); });
        const double stiffness = shortest(1, [&] { contact->stiffness(); });
        std::printf(
            "  %d^2: p/(E* h') = 0.02: %zu pixels, %d rounds, %.2f s (wanted at 4096^2, with the "
            "stiffness: 6), stiffness %.2f s\n",
            n, level.pixels.index.size(), level.iterations, one, stiffness);
        if (n < 4096) continue;
        const double series = shortest(1, [&] {
            for (int k = 0; k < 30; ++k)
                contact->at_force(highest * std::pow(40.0, (k - 29) / 29.0));
        });
        std::printf("  30 pressures from 0.0005 to 0.02: %.1f s (wanted: 60)\n", series);
    }
}

}  // namespace bench
