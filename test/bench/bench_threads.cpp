// What the second thread brings on an idle machine, and that it costs nothing beside processes that
// keep the processors busy:
// (time on the wall with all threads) / (with one), beside 0, 1 and 2 busy processes. Medians of
// several runs, the two kinds in turn.
#include <sys/wait.h>
#include <unistd.h>

#include "base/parallel.hpp"
#include "bench.hpp"
#include "case/read_case.hpp"
#include "run/job.hpp"
#include "run/team.hpp"
#include "support/paths.hpp"
#include "surface/synthesis.hpp"

namespace bench {
namespace {

using namespace rsc;

// Processes that compute without end while this lives.
class Busy {
public:
    explicit Busy(int count) {
        for (int k = 0; k < count; ++k) {
            const pid_t child = fork();
            if (child == 0)
                for (volatile unsigned i = 0;;) i = i + 1;
            children_.push_back(child);
        }
    }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
    ~Busy() {
        for (const pid_t child : children_) {
            kill(child, SIGKILL);
            waitpid(child, nullptr, 0);
        }
    }

private:
    std::vector<pid_t> children_;
};

double seconds(int threads, const std::function<void()>& work) {
    const LoopThreads loops(threads);
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void compare(const char* what, const std::function<void()>& work) {
    constexpr int runs = 5;
    std::printf("  %-60s", what);
    for (int busy = 0; busy <= 2; ++busy) {
        const Busy neighbours(busy);
        std::vector<double> one, all, ratio;
        for (int k = 0; k < runs; ++k) {
            one.push_back(seconds(1, work));
            all.push_back(seconds(0, work));
            ratio.push_back(all.back() / one.back());
        }
        for (auto* v : {&one, &all, &ratio})
            std::nth_element(v->begin(), v->begin() + runs / 2, v->end());
        std::printf("  %.2f / %.2f s: %.2f", all[runs / 2], one[runs / 2], ratio[runs / 2]);
        std::fflush(stdout);
    }
    std::printf("\n");
}

void levels(const HeightMap& map, int count) {
    SolverOptions options{.max_iterations = 200};
    const auto contact = make_element_contact(map, kGold, options);
    for (int k = 0; k < count; ++k) contact->at_separation(0.01 * (4 - 3.0 * k / (count - 1)));
}

}  // namespace

void threads() {
    std::printf(
        "\nthreads: time with all threads / with one, beside 0, 1, 2 busy processes (wanted: at "
        "most 1.1 everywhere)\n");
    Spectrum spectrum{.L_lambda_s = 512};
    const auto make = [&] {
        return synthesize(spectrum, 4096, Normalise::sample, 1, 1, nullptr,
                          static_cast<int>(most_threads(0)));
    };
    compare("synthesis, 4096^2", make);
    const HeightMap map = make();
    compare("elements, 4096^2, 100 levels from 4 to 1 sigma", [&] { levels(map, 100); });
    const Asperities a = lattice(100000);
    SolverOptions options{.method = Method::mesh, .surface = {.sigma = 0.05 / std::sqrt(1e5)}};
    compare("asperities by mesh, 1e5, a third in contact", [&] {
        asperity_path(a, {1.0, 1e4, 0.5, 0.5}, options)
            .at_separation(-11.3 * options.surface.sigma);
    });
    const Case settings = read_case_text(
                              "&run realizations = 16 / &surface n = 1024, L_lambda_s = 256 / "
                              "&indentation start = 4, stop = 1, steps = 20 /\n"
                              "&output map_cells = 200, radial_bins = 1000 /\n",
                              "bench.nml")
                              .settings;
    CampaignWork work({settings}, {});
    compare("campaign, 16 realizations of 1024^2, 20 levels, observing", [&] {
        ThreadTeam team(std::ref(work), static_cast<int>(most_threads(0)));
        std::int64_t next = 0;
        team.run(
            [&]() -> std::optional<Task> {
                return next < 16 ? std::optional<Task>({0, ++next}) : std::nullopt;
            },
            [](const Task&, std::string&&) {}, 1);
    });
}

}  // namespace bench
