// What campaigns cost, on the paper's map campaign (2048 x 2048 points, L/lambda_s = 512, 100 levels): threads, ranks, memory,
// checkpoints. Ratios of one run of this program; a machine busy with other things spoils them.
//     bench_campaign [realizations, 100 by default] [rsc_mpi]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

#include "bench.hpp"
#include "run/campaign_archive.hpp"
#include "run/checkpoint.hpp"
#include "run/job.hpp"
#include "run/run.hpp"

using namespace rsc;

namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double timed(const Case& c) {
    const double start = seconds();
    run_case(c, {});
    return seconds() - start;
}

// Processor time of one realization, and of what the checkpoint adds to it over a whole campaign of 2000.
void checkpoint_share(Case c) {
    constexpr int made = 5, campaign = 2000;
    c.run.realizations = campaign;
    const Job job = prepare(c);
    RealizationRecord record;
    double start = processor_seconds();
    for (int k = 1; k <= made; ++k) record = observe(job, k, realize(job, k, 1));
    const double realization = (processor_seconds() - start) / made;
    double spent = 0;
    std::size_t bytes = 0;
    {
        Accumulators sums(job.observe, job.levels.size());
        Checkpoint checkpoint(c.output.file, c, false);
        for (int k = 1; k <= campaign; ++k) {
            record.realization = k;
            start = processor_seconds();
            const std::string packed = to_bytes(record);
            checkpoint.append(packed);
            if (checkpoint.wants_rewrite()) checkpoint.rewrite(to_bytes(sums), {});
            spent += processor_seconds() - start;
            bytes = packed.size();
            sums.add(record);
        }
        checkpoint.remove();
    }
    std::printf("checkpoint: records of %zu kB; %.2f %% of the processor time of a realization (%.1f ms), at most 2 wanted\n", bytes / 1000,
                100 * spent / campaign / realization, 1e3 * realization);
    std::printf("2000 realizations: %.0f s of processor time, %.0f s on two cores, at most 180 wanted\n", campaign * realization,
                campaign * realization / 2);
}

}  // namespace

int main(int argc, char** argv) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("rsc-bench-" + std::to_string(std::time(nullptr)));
    fs::create_directories(folder);
    Case c;
    c.run.realizations = argc > 1 ? std::max(2, std::atoi(argv[1])) : 100;
    c.output.file = (folder / "campaign.nc").string();

    c.run.threads = 1;
    const double one = timed(c), memory_one = bench::peak_memory_mb();
    c.run.threads = 2;
    const double two = timed(c), memory_two = bench::peak_memory_mb();
    std::printf("%d realizations: 1 thread %.2f s, 2 threads %.2f s: %.2f times, 1.9 wanted\n", c.run.realizations, one, two, one / two);
    std::printf("memory: %.0f MB with one thread, %.0f MB with two, at most 150 MB a thread wanted\n", memory_one, memory_two);
    if (argc > 2) {
        const auto ranks = [&](int n) {
            const std::string command = "mpirun --oversubscribe -n " + std::to_string(n) + " '" + argv[2] + "' -q -o '" + c.output.file +
                                        "' -s run%realizations=" + std::to_string(c.run.realizations);
            const double start = seconds();
            const int status = std::system(
                ("echo '&run /' > '" + (folder / "c.nml").string() + "' && " + command + " '" + (folder / "c.nml").string() + "'").c_str());
            return status == 0 ? seconds() - start : 0.0;
        };
        const double rank = ranks(1), pair = ranks(2);
        if (pair > 0) std::printf("1 rank %.2f s, 2 ranks %.2f s: %.2f times, 1.9 wanted\n", rank, pair, rank / pair);
    }
    checkpoint_share(c);
    fs::remove_all(folder);
}
