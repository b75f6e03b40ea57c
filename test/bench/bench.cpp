// What rsc costs: processor times, and their ratios in one run, on one thread. `rsc_bench` runs all
// parts but those of minutes and gigabytes; `rsc_bench NAME...` only the parts named, in the table
// at the end of this file.
#include "bench.hpp"

#include <fftw3.h>

#include "base/parallel.hpp"
#include "physics/adhesion/sticking.hpp"
#include "support/paths.hpp"
#include "surface/detection.hpp"

extern "C" void openblas_set_num_threads(int) __attribute__((weak));

using namespace rsc;
using bench::kGold, bench::middle, bench::now, bench::shortest;

namespace {

Asperities surface(double sigma, std::int64_t realization) {
    Spectrum spectrum{.sigma = sigma};
    return make_asperities(spectrum, 2048, Normalise::sample, 1, realization, Curvature::geometric);
}

std::vector<Level> indent(const Asperities& asperities, double sigma, Method method, int steps,
                          LawKind law = LawKind::hertz) {
    SolverOptions options{.method = method, .law = law, .surface = {.sigma = sigma}};
    Path contact = asperity_path(asperities, kGold, options);
    std::vector<Level> levels;
    for (int k = 0; k < steps; ++k)
        levels.push_back(contact.at_separation(sigma * (4 - 3.0 * k / (steps - 1))));
    return levels;
}

long sum(const std::vector<Level>& levels, long Level::*field) {
    long total = 0;
    for (const Level& level : levels) total += level.*field;
    return total;
}

void bench_solve() {
    std::printf(
        "\nsolve: 100 levels from 4 to 1 sigma, default surface, solving only, one core (paper's "
        "method / direct)\n");
    double all_direct = 0, all_dgesv = 0;
    for (int realization = 1; realization <= 4; ++realization) {
        const Asperities a = surface(0.01, realization);
        std::vector<Level> direct, dgesv;
        const double t_direct = shortest(5, [&] { direct = indent(a, 0.01, Method::direct, 100); });
        const double t_dgesv = shortest(1, [&] { dgesv = indent(a, 0.01, Method::dgesv, 100); });
        double differ = 0;
        long steps = 0, solves = 0, not_unique = 0;
        for (std::size_t k = 0; k < direct.size(); ++k) {
            if (direct[k].force > 0)
                differ = std::max(differ, std::abs(dgesv[k].force / direct[k].force - 1));
            steps += direct[k].iterations;
            solves += dgesv[k].iterations;
            not_unique += !direct[k].unique;
        }
        std::printf(
            "  realization %d: dgesv %.3f s (%ld solves), direct %.4f s (%ld Newton steps, %ld "
            "products), ratio %.0f; "
            "loads differ %.1e; %ld levels not unique\n",
            realization, t_dgesv, solves, t_direct, steps, sum(direct, &Level::products),
            t_dgesv / t_direct, differ, not_unique);
        all_direct += t_direct;
        all_dgesv += t_dgesv;
    }
    std::printf("  mean ratio %.0f (wanted: 200)\n", all_dgesv / all_direct);
}

double bare_transform(int n) {
    const auto size = static_cast<std::size_t>(n);
    double* data = fftw_alloc_real(size * 2 * (size / 2 + 1));
    const fftw_plan plan =
        fftw_plan_dft_c2r_2d(n, n, reinterpret_cast<fftw_complex*>(data), data, FFTW_ESTIMATE);
    std::fill(data, data + size * 2 * (size / 2 + 1), 1e-3);
    const double time = shortest(5, [&] {
        fftw_execute(plan);
        std::fill(data, data + 64, 1e-3);
    });
    fftw_destroy_plan(plan);
    fftw_free(data);
    return time;
}

void bench_realization() {
    std::printf(
        "\nrealization: 2048^2 surface, detection and 100 levels, one core (all in / bare in-place "
        "c2r transform of the grid)\n");
    const double bare = bare_transform(2048);
    double make = 1e300, solve = 1e300, whole = 1e300;
    for (int i = 0; i < 5; ++i) {
        const double start = now();
        const Asperities a = surface(0.01, 5);
        const double made = now();
        indent(a, 0.01, Method::automatic, 100);
        const double done = now();
        make = std::min(make, made - start);
        solve = std::min(solve, done - made);
        whole = std::min(whole, done - start);
    }
    std::printf(
        "  bare %.1f ms, surface and detection %.1f ms, levels %.1f ms, all in %.1f ms, ratio %.2f "
        "(wanted: 2.5)\n",
        1e3 * bare, 1e3 * make, 1e3 * solve, 1e3 * whole, whole / bare);
}

// A loop of adhesive asperities, 100 levels from 3 sigma down to 1 sigma and 100 up, against the
// elastic levels down.
void bench_adhesion() {
    const Asperities a = surface(0.01, 1);
    SolverOptions options{.surface = {.sigma = 0.01}};
    Level last;
    const auto levels = [&](double work) {
        options.physics.of<Adhesion>().work = work;
        const auto contact = make_asperity_contact(a, kGold, options);
        double jumps = 0;
        for (int k = 0; k <= (work > 0 ? 200 : 100); ++k) {
            last =
                contact->at_separation(options.surface.sigma * (3 - 0.02 * std::min(k, 200 - k)));
            jumps += last.jumps;
        }
        return jumps;
    };
    double jumps = 0;
    const double elastic = middle(5, [&] { levels(0); }),
                 loop = middle(5, [&] { jumps = levels(1e-4); });
    std::printf(
        "\nadhesion: 100 levels down and up %.2f s, %.0f jumps, 100 elastic levels %.3f s: %.1f "
        "times (wanted: 10); N %.9g, lost %.9g\n",
        loop, jumps, elastic, loop / elastic, last.force, last.energy_lost);
}

}  // namespace

struct Part {
    const char* name;
    void (*run)();
    bool only_named = false;  // minutes or gigabytes: not run unless asked for
};
const Part kParts[] = {
    {"realization", bench_realization}, {"solve", bench_solve},
    {"adhesion", bench_adhesion},       {"calls", bench::calls},
    {"elements", bench::elements},      {"flats", bench::flats, true},
    {"scaling", bench::scaling, true},
};

int main(int argc, char** argv) {
    const LoopThreads loops(1);
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    for (int k = 1; k < argc; ++k) {
        if (std::any_of(std::begin(kParts), std::end(kParts),
                        [&](const Part& part) { return std::strcmp(argv[k], part.name) == 0; }))
            continue;
        std::fprintf(stderr, "rsc_bench: no part %s; there are", argv[k]);
        for (const Part& part : kParts) std::fprintf(stderr, " %s", part.name);
        std::fprintf(stderr, "\n");
        return 2;
    }
    for (const Part& part : kParts) {
        const bool named = std::any_of(argv + 1, argv + argc, [&](const char* arg) {
            return std::strcmp(arg, part.name) == 0;
        });
        if (named || (argc == 1 && !part.only_named)) part.run();
        std::fflush(stdout);
    }
    return 0;
}
