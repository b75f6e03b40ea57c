// From levels to a file: what observing, recording and writing cost beside solving. And a realization of two flats.
#include <unistd.h>

#include "bench.hpp"
#include "case/read_case.hpp"
#include "file/netcdf_writer.hpp"
#include "file/result.hpp"
#include "run/job.hpp"
#include "run/run.hpp"

namespace bench {

using namespace rsc;

void observe() {
    std::printf("\nobserve: 100 levels of the default case, one core\n");
    const auto path = std::filesystem::temp_directory_path() / ("rsc_bench_" + std::to_string(::getpid()) + ".nc");
    const Case settings = read_case_text("&indentation start = 4, stop = 1, steps = 100 /\n", "bench.nml").settings;
    const Job job = prepare(settings);
    double solve = 1e300, record = 1e300, write = 1e300;
    for (int run = 0; run < 7; ++run) {
        double start = 0;
        const auto lap = [&start](double& best) {
            const double end = now();
            best = std::min(best, end - start);
            start = end;
        };
        Realization realization = realize(job, 1, 1, [&](std::size_t k, const Level&) {
            if (k == 0) start = now();  // the surface is made and the first level, which hardly touches, solved
            return true;
        });
        lap(solve);
        Accumulators sums(job.observe, job.levels.size());
        sums.add(observe(job, 1, realization));
        Result result = make_result(settings, case_text(settings), job.indenter, job.sigma, job.theory, sums.finish());
        keep_contacts(result, realization.levels, contacts_kept(settings));
        result.asperities = std::move(realization.asperities);
        lap(record);
        write_result(result, path.string(), {settings.output.format, settings.output.compression, ""});
        lap(write);
    }
    std::printf("  solving %.1f ms; observing and recording %.2f of that, writing %.2f (%.1f MB)\n", 1e3 * solve, record / solve,
                write / solve, 1e-6 * static_cast<double>(std::filesystem::file_size(path)));
    std::filesystem::remove(path);
}

void flats() {
    std::printf("\nflats: asperities between two flats, L/lambda_l = 8, 30 pressures up to 0.02 E* h', one core\n");
    std::vector<double> contacts, times;
    for (int n : {512, 1024, 2048}) {
        const Case settings =
            read_case_text("&solids R = Infinity, Infinity /\n&surface sigma = 0.0005, hurst = 0.8, L_lambda_l = 8, L_lambda_s = " +
                               std::to_string(n / 4) + ", n = " + std::to_string(n) +
                               " /\n&asperities law = 'fourth_order' /\n"
                               "&indentation boundary = 'periodic', control = 'pressure', unit = 'relative', "
                               "start = 0.0005, stop = 0.02, steps = 30, spacing = 'log' /\n",
                           "bench.nml")
                .settings;
        const Job job = prepare(settings);
        Realization realization;
        const double time = shortest(1, [&] { realization = realize(job, 1, 1); });
        long steps = 0, products = 0, not_unique = 0;
        for (const Level& level : realization.levels) {
            steps += level.iterations, products += level.products;
            not_unique += level.status == LevelStatus::not_unique;
        }
        contacts.push_back(realization.levels.back().contacts);
        times.push_back(time);
        std::printf("  %4d^2: %5d contacts at the last, %2ld levels not unique, %ld Newton steps, %ld products: %.2f s%s\n", n,
                    realization.levels.back().contacts, not_unique, steps, products, time, n == 2048 ? " (wanted: 5 s)" : "");
    }
    std::printf("  time ~ contacts^%.2f\n", exponent(contacts, times));
}

}  // namespace bench
