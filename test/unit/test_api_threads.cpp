// Handles in several threads at once: each its own gives the bits it gives alone, and one may be read by all. Made for
// ThreadSanitizer, too.
#include "check.hpp"
#include "rsc.h"

namespace {

constexpr int kThreads = 4;

struct Answer {
    double N = 0, A = 0, k = 0, W = 0, Z = 0, w = 0;
    int failures = 0;
    bool operator==(const Answer&) const = default;
};

// A surface of its own, its asperities, a contact, a few levels: all of the way, FFT included.
Answer work(int number) {
    Answer answer;
    const auto ok = [&](std::int32_t status) { answer.failures += status != 0; };
    rsc_case* c = nullptr;
    rsc_surface* s = nullptr;
    rsc_asperities* a = nullptr;
    rsc_contact* k = nullptr;
    ok(rsc_case_create(&c));
    ok(rsc_case_set(c, "surface%n", "128"));
    ok(rsc_case_set(c, "surface%L_lambda_l", "4"));
    ok(rsc_case_set(c, "surface%L_lambda_s", "32"));
    ok(rsc_case_set(c, "run%threads", "1"));
    ok(rsc_surface_synthesize(&s, c, number));
    ok(rsc_asperities_find(&a, s, c));
    ok(rsc_contact_create_from_case(&k, a, c));
    for (const double Z0 : {0.03, 0.02, 0.01, 0.0}) ok(rsc_contact_indent(k, Z0, &answer.N));
    ok(rsc_contact_stiffness(k, &answer.k));
    ok(rsc_contact_energy(k, &answer.W));
    ok(rsc_contact_result(k, nullptr, nullptr, &answer.A, nullptr));
    const double x = 0.1, y = 0.9;
    ok(rsc_contact_deflection(k, 1, &x, &y, &answer.w));
    ok(rsc_contact_press(k, 2 * answer.N, &answer.Z));
    // Messages belong to the thread.
    const std::string value = "wrong" + std::to_string(number);
    answer.failures += rsc_case_set(c, "surface%n", value.c_str()) != -3;
    char text[4096];
    ok(rsc_message(text, sizeof text, nullptr));
    answer.failures += std::strstr(text, value.c_str()) == nullptr;
    ok(rsc_contact_destroy(&k));
    ok(rsc_asperities_destroy(&a));
    ok(rsc_surface_destroy(&s));
    ok(rsc_case_destroy(&c));
    return answer;
}

}  // namespace

TEST(api_threads) {
    std::vector<Answer> alone, together(kThreads);
    for (int t = 0; t < kThreads; ++t) alone.push_back(work(t));
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t) threads.emplace_back([&, t] { together[static_cast<std::size_t>(t)] = work(t); });
    for (auto& t : threads) t.join();
    for (int t = 0; t < kThreads; ++t) {
        const auto i = static_cast<std::size_t>(t);
        CHECK(alone[i].failures == 0 && together[i].failures == 0);
        CHECK(alone[i].N > 0 && alone[i] == together[i]);
        if (t > 0) CHECK(alone[i].N != alone[0].N);
    }

    // One contact, one set of asperities and one case, read by all; each thread works on a copy of the contact.
    rsc_case* c = nullptr;
    rsc_asperities* a = nullptr;
    rsc_contact* k = nullptr;
    const double x[3] = {0, 1, 2}, y[3] = {0, 0, 0}, z[3] = {0, 0.1, 0}, r[3] = {1, 1, 1};
    CHECK(rsc_case_create(&c) == 0);
    CHECK(rsc_asperities_take(&a, 3, x, y, z, r, nullptr, nullptr, nullptr, nullptr) == 0);
    CHECK(rsc_contact_create(&k, a, 1e5, 10, 1, 0, c) == 0);
    CHECK(rsc_contact_indent(k, 0.05, nullptr) == 0);
    threads.clear();
    std::vector<int> failures(kThreads, 0);
    for (int t = 0; t < kThreads; ++t) {
        threads.emplace_back([&, t] {
            int& failed = failures[static_cast<std::size_t>(t)];
            rsc_contact *copy = nullptr, *other = nullptr;
            double N = 0, M = 0, W = 0, w[3], f[3];
            char text[64];
            failed += rsc_contact_result(k, nullptr, &N, nullptr, nullptr) != 0;
            failed += rsc_contact_energy(k, &W) != 0;
            failed += rsc_contact_deflection(k, 3, x, y, w) != 0;
            failed += rsc_contact_per_asperity(k, 3, f, nullptr, nullptr) != 0;
            failed += rsc_case_get(c, "solver%method", text, sizeof text, nullptr) != 0;
            failed += rsc_contact_copy(&copy, k) != 0;
            failed += rsc_contact_create(&other, a, 1e5, 10, 1, 0, c) != 0;
            failed += rsc_contact_indent(copy, 0.05, &M) != 0;
            failed += !(M == N) || !(f[1] == N);
            failed += rsc_contact_destroy(&copy) != 0;
            failed += rsc_contact_destroy(&other) != 0;
        });
    }
    for (auto& t : threads) t.join();
    for (const int failed : failures) CHECK(failed == 0);
    CHECK(rsc_contact_destroy(&k) == 0);
    CHECK(rsc_asperities_destroy(&a) == 0);
    CHECK(rsc_case_destroy(&c) == 0);
}
