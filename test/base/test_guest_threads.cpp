// The library in processes that are short of threads, and in children of processes that had
// threads.
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/parallel.hpp"
#include "check.hpp"
#include "elements/pixel_products.hpp"
#include "problem/bodies.hpp"
#include "support/library.hpp"

namespace test_guest_threads {

CaseHandle small_case(const char* more) {
    return case_of(std::string("&surface n=256 L_lambda_l=4 L_lambda_s=32 / ") + more);
}

// The exit status of a child process that runs `body`; 128 + signal if a signal ended it (an alarm
// after 60 s).
int in_child(const std::function<int()>& body) {
    const pid_t child = fork();
    if (child == 0) {
        alarm(60);
        _exit(body());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// With memory for only a few of the 200 threads requested. Returns 0 if all calls succeed, 1 if
// some report lack of memory.
int with_little_memory() {
    long pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t most = static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) +
                        (rlim_t{100} << 20);
    const rlimit limit{most, most};
    if (setrlimit(RLIMIT_AS, &limit) != 0) return 9;
    const CaseHandle c = small_case("&run threads=200 /");
    int refused = 0;
    for (int k = 1; k <= 4; ++k) {
        SurfaceHandle surface;
        AsperitiesHandle asperities;
        std::int32_t status = rsc_surface_synthesize(&surface, c, k);
        if (status == RSC_SUCCESS) status = rsc_asperities_find(&asperities, surface, c);
        if (status != RSC_SUCCESS && status != RSC_NO_MEMORY) return 2;
        refused |= status != RSC_SUCCESS;
    }
    return refused;
}

// True if a parallel loop can be stopped by the caller while it runs.
bool stops(const std::function<void()>& loop) {
    usleep(60000);  // nobody is asked more often than every 50 ms
    try {
        const rsc::Watch watch([] { throw std::domain_error("enough"); });
        loop();
    } catch (const std::domain_error&) {
        return true;
    }
    return false;
}

void test_stopping() {
    std::vector<rsc::Pixel> pixels;
    for (const int k : indices(128 * 128)) pixels.push_back({k % 128, k / 128});
    const std::vector<double> p(pixels.size(), 1.0);
    std::vector<double> w(pixels.size());
    const auto products = rsc::make_tree_products(1.0, 1, 1, 1e-3, 1e-5);
    products->set_pixels(pixels);
    CHECK(stops([&] { products->apply(p.data(), w.data(), rsc::PixelProducts::Accuracy::inner); }));
    CHECK(stops([] { rsc::make_surface(rsc::Case{}, 1, 2); }));
    for (const int kind :
         {0, 1, 2, 3}) {  // the solvers: Newton's method, dgesv, elements, adhesion
        rsc::Case c;
        c.surface.n = 256;
        c.surface.L_lambda_l = 4;
        c.surface.L_lambda_s = 32;
        if (kind == 1) c.solver.method = rsc::Method::dgesv;
        if (kind == 2) c.solver.model = rsc::ModelKind::elements;
        if (kind == 3) c.solids.adhesion = 0.01;
        const auto model = rsc::make_surface_model(c, 1, 1);
        const auto contact = rsc::make_contact(model, rsc::indenter_of(c, model.domain),
                                               rsc::solver_of(c, model.domain));
        CHECK(stops([&] { contact->at_separation(0.01); }));
    }
}

// As many threads as the processors that the process may use: a rank or a job that is bound to one
// does not start one for each of the machine.
int with_one_processor() {
    unsetenv("OMP_NUM_THREADS");
    cpu_set_t allowed, one;
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return 0;
    int first = 0;
    while (!CPU_ISSET(first, &allowed)) ++first;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    return sched_setaffinity(0, sizeof one, &one) != 0 || rsc::most_threads(0) == 1 ? 0 : 1;
}

double height(const rsc_case* c) {
    SurfaceHandle surface;
    std::vector<double> z(256 * 256);
    OK(rsc_surface_synthesize(&surface, c, 1));
    OK(rsc_surface_heights(surface, 256 * 256, z.data()));
    return z[777];
}

// Every piece runs once, loops inside pieces included; an exception of one comes out.
void test_pieces() {
    for (const int threads : {1, 2, 3, 8}) {
        std::vector<int> runs(1000, 0);
        std::atomic<bool> strange{false};
        rsc::parallel_for(100, 7, threads, [&](int i, std::size_t worker) {
            if (std::cmp_greater_equal(worker, threads)) strange = true;
            rsc::parallel_for(10, 3, threads, [&](int j) { ++runs[10 * i + j]; });
        });
        CHECK(!strange && runs == std::vector<int>(1000, 1));
        const auto refuses = [](int k) {
            if (k == 77) throw std::domain_error("77");
        };
        CHECK_THROWS(rsc::parallel_for(100, 1, threads, refuses), std::domain_error);
    }
}

// Threads without a piece of the outer loop take part in those inside its pieces, and never more
// work at a time than were asked for.
void test_loops_inside_pieces() {
    constexpr int threads = 4, outer = 2, inner = 8;
    std::mutex mutex;
    std::set<std::thread::id> who;
    int busy = 0, most = 0;
    std::vector<int> runs(outer * inner, 0);
    const auto work = [&](int k) {
        {
            const std::lock_guard lock(mutex);
            who.insert(std::this_thread::get_id());
            most = std::max(most, ++busy);
            ++runs[k];
        }
        usleep(5000);
        const std::lock_guard lock(mutex);
        --busy;
    };
    rsc::parallel_for(outer, 1, threads, [&](int i) {
        rsc::parallel_for(inner, 1, threads, [&](int j) { work(i * inner + j); });
    });
    CHECK(runs == std::vector<int>(outer * inner, 1));
    CHECK(who.size() > outer && most <= threads);
    const auto refuse = [&](int i) {
        rsc::parallel_for(inner, 1, threads, [&](int j) {
            if (i == 1 && j == 5) throw std::domain_error("5");
        });
    };
    CHECK_THROWS(rsc::parallel_for(outer, 1, threads, refuse), std::domain_error);
}

void test_more_threads_than_work() {
    const CaseHandle c = small_case("");
    AsperitiesHandle asperities;
    rsc_contact* contacts[2] = {};
    OK(rsc_asperities_make(&asperities, c, 1));
    for (auto& contact : contacts) OK(rsc_contact_create_from_case(&contact, asperities, c));
    const double force[] = {1e-3, 2e-3};
    double few[2], many[2];
    OK(rsc_contacts_press(2, contacts, force, few, nullptr, 1));
    CHECK(in_child([&] { return rsc_contacts_press(2, contacts, force, many, nullptr, 100000); }) ==
          0);
    for (auto& contact : contacts) rsc_contact_destroy(&contact);
}

void test_fork() {
    const CaseHandle c = small_case("&run threads=4 /");
    const double before = height(c);  // the pool's threads are there now
    CHECK(in_child([&] { return height(c) == before ? 0 : 1; }) == 0);
    CHECK(height(c) == before);
#ifndef __SANITIZE_ADDRESS__
    // While another thread is in the library. Not under the address sanitizer of g++ 12: its
    // allocator, unlike glibc's, may be locked for ever in the child if another thread was
    // allocating at the fork.
    std::atomic<bool> done{false};
    std::thread other([&] {
        while (!done) height(c);
    });
    for (int k = 0; k < 5; ++k) CHECK(in_child([&] { return height(c) == before ? 0 : 1; }) == 0);
    done = true;
    other.join();
#endif
}

void test_lock() {
    CHECK(rsc_unlock() == RSC_NO_RESULT);
    CHECK(rsc_lock() == RSC_SUCCESS && rsc_lock() == RSC_SUCCESS);
    const CaseHandle c = small_case("");
    height(c);  // makes plans of FFTW on the way
    OK(rsc_unlock());
    std::atomic<bool> in{false};
    std::thread other([&] {
        rsc_lock();
        in = true;
        rsc_unlock();
    });
    usleep(50000);
    CHECK(!in);
    OK(rsc_unlock());
    other.join();
    CHECK(in && rsc_unlock() == RSC_NO_RESULT);
}

TEST(guest_threads) {
    CHECK(in_child(with_one_processor) == 0);  // before this process has counted its own
#ifndef __SANITIZE_THREAD__                    // which ends without memory
    CHECK(in_child(with_little_memory) <= 1);
#endif
    test_loops_inside_pieces();
    test_more_threads_than_work();
    test_fork();
    test_lock();
    test_stopping();
    test_pieces();
}

}  // namespace test_guest_threads
