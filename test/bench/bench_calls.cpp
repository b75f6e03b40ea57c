// What one call costs in a time loop: a prescribed force while the tip moves, through the C
// interface, on one thread.
#include "bench.hpp"
#include "rsc.h"

namespace bench {
namespace {

double thread_time() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

void check(std::int32_t status) {
    if (status != RSC_SUCCESS) std::abort();
}

// Calls with the tip moved by `step` each time; 0: the force changes instead.
void calls(const char* law, double step, bool force) {
    rsc_case* c = nullptr;
    rsc_asperities* asperities = nullptr;
    rsc_contact* contact = nullptr;
    check(rsc_case_create(&c));
    check(rsc_case_read(
        c,
        (std::string("&solver model = 'asperities' / &asperities law = '") + law + "' /").c_str()));
    check(rsc_asperities_make(&asperities, c, 1));
    check(rsc_contact_create_from_case(&contact, asperities, c));
    double N = 0, Z0 = 0.0173, x = 0, y = 0;
    std::int64_t contacts = 0;
    check(rsc_contact_tip(contact, &x, &y));
    check(rsc_contact_indent(contact, Z0, &N));
    check(rsc_contact_result(contact, nullptr, nullptr, nullptr, &contacts));
    std::vector<double> times;
    double products = 0, iterations = 0;
    constexpr int count = 400;
    for (int k = 1; k <= count; ++k) {
        const double start = thread_time();
        if (step > 0) check(rsc_contact_move_tip(contact, x + step * k, y));
        const double share = step > 0 ? 1 : 1 + 1e-4 * std::sin(0.1 * k);
        double now = 0;
        check(force ? rsc_contact_press(contact, N * share, &Z0)
                    : rsc_contact_indent(contact, Z0 * share, &now));
        times.push_back(1e6 * (thread_time() - start));
        double one = 0;
        check(rsc_contact_value(contact, "products", &one));
        products += one / count;
        check(rsc_contact_value(contact, "iterations", &one));
        iterations += one / count;
    }
    std::ranges::sort(times);
    std::printf(
        "  %-13s %s %-12s %3ld contacts, %4.1f products, %4.1f steps: median %6.1f us, least %6.1f "
        "us\n",
        law, force ? "force,     " : "separation,",
        step > 0 ? (step > 1e-5 ? "moved 1e-4" : "moved 1e-6") : "tip at rest", long(contacts),
        products, iterations, times[count / 2], times[0]);
    check(rsc_contact_destroy(&contact));
    check(rsc_asperities_destroy(&asperities));
    check(rsc_case_destroy(&c));
}

}  // namespace

void calls() {
    std::printf(
        "\ncalls: processor time of one call in a time loop, default surface (wanted at moved tips "
        "and 250 contacts: 30 us)\n");
    for (const char* law : {"fourth_order", "hertz"})
        for (const bool force : {true, false})
            for (const double step : {1e-6, 1e-4, 0.0}) calls(law, step, force);
}

}  // namespace bench
