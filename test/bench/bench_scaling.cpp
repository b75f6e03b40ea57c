// Whole cases on 1, 2, 4, ... threads up to all processors, each run in a process of its own. Run
// it on an idle machine.
#include <sys/wait.h>
#include <unistd.h>

#include "bench.hpp"
#include "case/read_case.hpp"
#include "run/run.hpp"

namespace bench {
namespace {

using namespace rsc;

struct ScalingCase {
    const char* name;
    const char* text;
};

const ScalingCase kCases[] = {
    {"elements, default surface, 100 levels",
     "&solver model = 'elements' / &indentation start = 4, stop = 1, steps = 100 /"},
    {"elements, two flats of 4096^2, one pressure",
     "&solids R = Infinity, Infinity / &surface L_lambda_s = 512 / &solver model = 'elements' /"
     "&indentation boundary = 'periodic', control = 'pressure', unit = 'relative', levels = 0.05 "
     "/"},
    {"elements, ball of 5 mm on 2048^2, 13 forces",
     "&solids E = 210e3, 210e3, nu = 0.3, 0.3, R = Infinity, 5 /"
     "&surface L_lambda_s = 256, sigma = 2e-4 / &solver model = 'elements' /"
     "&indentation control = 'force', start = 1, stop = 100, steps = 13, spacing = 'log' /"},
    {"fourth_order on 8192^2, 20 levels",
     "&surface n = 8192, L_lambda_s = 1024 / &asperities law = 'fourth_order' /"
     "&solver model = 'asperities' / &indentation start = 3, stop = 1, steps = 20 /"},
    {"2000 realizations of 512^2, 10 levels",
     "&run realizations = 2000 / &surface n = 512, L_lambda_l = 8, L_lambda_s = 64 /"
     "&solver model = 'asperities' / &indentation start = 3, stop = 0, steps = 10 /"},
    {"200 realizations of 2048^2, 10 levels",
     "&run realizations = 200 / &surface n = 2048, L_lambda_s = 256 /"
     "&solver model = 'asperities' / &indentation start = 3, stop = 1, steps = 10 /"},
    {"elements on 8192^2, one level",
     "&surface n = 8192, L_lambda_s = 1024 / &solver model = 'elements' / &indentation levels = 1 "
     "/"},
};

double on_wall() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

void run(const ScalingCase& one, int threads, const std::string& file) {
    Case settings = read_case_text(std::string(one.text) +
                                       "&compare levels = 'none' /"
                                       "&output contacts = 'none' /\n",
                                   "bench.nml")
                        .settings;
    settings.run.threads = threads;
    settings.output.file = file;
    run_case(settings, {});
}

// Runs `work` in a process of its own. Returns false if it failed.
bool apart(const std::function<void()>& work, rusage& used) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        try {
            work();
        } catch (const std::exception& error) {
            std::printf("  failed: %s\n", error.what());
            std::fflush(stdout);
            _exit(1);
        }
        std::fflush(stdout);
        _exit(0);
    }
    int status = 0;
    return wait4(child, &status, 0, &used) == child && status == 0;
}

}  // namespace

void scaling() {
    std::printf(
        "\nscaling: threads, time on the wall [s], times as fast as one, processor time [s], that "
        "of one = 1, memory [MB]\n");
    const std::string file = "bench_scaling_" + std::to_string(getpid()) + ".nc";
    const int most = int(std::thread::hardware_concurrency());
    std::vector<int> counts;
    for (int threads = 1; threads < most; threads *= 2) counts.push_back(threads);
    counts.push_back(most);
    for (const ScalingCase& one : kCases) {
        std::printf("%s\n", one.name);
        double wall_of_one = 0, work_of_one = 0;
        rusage used{};
        for (const int threads : counts) {
            const double start = on_wall();
            if (!apart([&] { run(one, threads, file); }, used)) break;
            const double wall = on_wall() - start;
            const auto seconds = [](const timeval& t) {
                return double(t.tv_sec) + 1e-6 * double(t.tv_usec);
            };
            const double work = seconds(used.ru_utime) + seconds(used.ru_stime);
            if (threads == 1) {
                wall_of_one = wall;
                work_of_one = work;
            }
            std::printf("  %3d  %8.2f  %6.2f  %8.2f  %5.2f  %6.0f\n", threads, wall,
                        wall_of_one / wall, work, work / work_of_one,
                        double(used.ru_maxrss) / 1024);
        }
    }
    std::remove(file.c_str());
}

}  // namespace bench
