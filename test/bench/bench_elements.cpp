// What elements cost: a level cold, a series of levels, between flats.
#include "bench.hpp"

#include <fftw3.h>

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

// A transform of n x n numbers in single precision and back.
double bare_pair(int n) {
    std::vector<float> data(at(n) * (at(n) + 2));
    auto* const modes = reinterpret_cast<fftwf_complex*>(data.data());
    const fftwf_plan there = fftwf_plan_dft_r2c_2d(n, n, data.data(), modes, FFTW_ESTIMATE),
                     back = fftwf_plan_dft_c2r_2d(n, n, modes, data.data(), FFTW_ESTIMATE);
    const double time = shortest(3, [&] {
        fftwf_execute(there);
        fftwf_execute(back);
    });
    fftwf_destroy_plan(there);
    fftwf_destroy_plan(back);
    return time;
}

long page_faults() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
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

// Levels from nothing against bare transforms: products and rounds must not grow with the grid.
void flats() {
    std::printf(
        "\nflats: L/lambda_l = 4, 8 points in the shortest wave, tolerance 1e-6, cold, one thread "
        "(processor time / products times a bare pair of transforms)\n");
    for (const int n : {512, 1024, 2048, 4096}) {
        const double pair = bare_pair(n);
        std::printf("  %d^2: bare pair in single precision %.1f ms\n", n, 1e3 * pair);
        for (const int seed : {1, 2, 3}) {
            Spectrum spectrum{.L_lambda_l = 4, .L_lambda_s = n / 8.0};
            const HeightMap map = synthesize(spectrum, n, Normalise::sample, seed, 1);
            const Indenter flat{kGold.E_star, HUGE_VAL, 0, 0, {map.Lx(), map.Ly()}};
            const auto contact = make_element_contact(map, flat, options());
            const double unit = kGold.E_star * theoretical_moments(spectrum).rms_slope();
            for (const double pressure : {0.02, 0.1, 0.3}) {
                Level level;
                const long before = page_faults();
                const double time =
                    shortest(1, [&] { level = contact->at_force(pressure * unit); });
                std::printf(
                    "    seed %d, p/(E* h') = %.2f: A/A0 = %.3f, %d rounds, %ld products, %.2f s, "
                    "ratio %.2f, %ld page faults%s\n",
                    seed, pressure, level.area_fraction, level.iterations, long(level.products),
                    time, time / (double(level.products) * pair), page_faults() - before,
                    level.converged ? "" : ", NOT CONVERGED");
            }
        }
    }
    std::printf("  peak memory %.0f MB\n", peak_memory_mb());
}

}  // namespace bench
