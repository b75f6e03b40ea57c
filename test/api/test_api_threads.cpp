// Handles in several threads at once: each its own gives the bits it gives alone, and one may be
// read by all. Made for
// ThreadSanitizer, too.
#include "check.hpp"
#include "support/asperities.hpp"
#include "support/library.hpp"

namespace test_api_threads {

constexpr int kThreads = 4;

// Checks are not made for several threads: each counts what failed.
struct Answer {
    std::vector<double> values;
    int failures = 0;
    void ok(bool good) { failures += !good; }
    bool operator==(const Answer&) const = default;
};

// A surface of its own, its asperities, a contact, a few levels: all of the way, FFT included.
Answer work(int number) {
    Answer answer;
    rsc_case* c = nullptr;
    rsc_asperities* a = nullptr;
    rsc_contact* k = nullptr;
    double N = 0, more[5] = {};
    const double x = 0.1, y = 0.9;
    answer.ok(rsc_case_create(&c) == 0 &&
              rsc_case_read(c, "&surface n=128 L_lambda_l=4 L_lambda_s=32 / &run threads=1 /") ==
                  0);
    answer.ok(rsc_asperities_make(&a, c, number) == 0 &&
              rsc_contact_create_from_case(&k, a, c) == 0);
    for (const double Z0 : {0.03, 0.02, 0.01, 0.0}) answer.ok(rsc_contact_indent(k, Z0, &N) == 0);
    answer.ok(rsc_contact_stiffness(k, &more[0]) == 0 && rsc_contact_energy(k, &more[1]) == 0);
    answer.ok(rsc_contact_result(k, nullptr, nullptr, &more[2], nullptr) == 0 &&
              rsc_contact_deflection(k, 1, &x, &y, &more[3]) == 0);
    answer.ok(rsc_contact_press(k, 2 * N, &more[4]) == 0);
    // Messages belong to the thread.
    const std::string value = "wrong" + std::to_string(number);
    char text[4096];
    answer.ok(rsc_case_set(c, "surface%n", value.c_str()) == -3 &&
              rsc_message(text, sizeof text, nullptr) == 0);
    answer.ok(std::strstr(text, value.c_str()));
    answer.ok(rsc_contact_destroy(&k) == 0 && rsc_asperities_destroy(&a) == 0 &&
              rsc_case_destroy(&c) == 0);
    answer.values.assign(more, more + 5);
    answer.values.push_back(N);
    return answer;
}

std::vector<Answer> at_once(const std::function<Answer(int)>& work_of) {
    std::vector<Answer> answers(kThreads);
    std::vector<std::thread> threads;
    for (const int t : indices(kThreads)) threads.emplace_back([&, t] { answers[t] = work_of(t); });
    for (auto& t : threads) t.join();
    return answers;
}

TEST(api_threads) {
    std::vector<Answer> alone;
    for (const int t : indices(kThreads)) alone.push_back(work(t));
    const std::vector<Answer> together = at_once(work);
    for (const std::size_t t : indices(kThreads)) {
        CHECK(alone[t].failures == 0 && alone[t].values.back() > 0 && alone[t] == together[t]);
        if (t > 0) CHECK(alone[t] != alone[0]);
    }

    // One contact, one set of asperities and one case, read by all; each thread works on a copy of
    // the contact.
    const CaseHandle c = case_of("&run threads=1 /");
    const rsc::Asperities list = asperities_at({{0, 0, 0, 1}, {1, 0, 0.1, 1}, {2, 0, 0, 1}});
    const AsperitiesHandle a = take(list);
    ContactHandle k;
    OK(rsc_contact_create(&k, a, 1e5, 10, 1, 0, c));
    OK(rsc_contact_indent(k, 0.05, nullptr));
    for (const Answer& answer : at_once([&](int) {
             Answer read;
             rsc_contact *copy = nullptr, *other = nullptr;
             double N = 0, M = 0, W = 0, w[3], f[3];
             char text[64];
             read.ok(rsc_contact_result(k, nullptr, &N, nullptr, nullptr) == 0 &&
                     rsc_contact_energy(k, &W) == 0);
             read.ok(rsc_contact_deflection(k, 3, list.x.data(), list.y.data(), w) == 0);
             read.ok(rsc_contact_per_asperity(k, 3, f, nullptr, nullptr) == 0);
             read.ok(rsc_case_get(c, "solver%method", text, sizeof text, nullptr) == 0);
             read.ok(rsc_contact_copy(&copy, k) == 0 &&
                     rsc_contact_create(&other, a, 1e5, 10, 1, 0, c) == 0);
             read.ok(rsc_contact_indent(copy, 0.05, &M) == 0 && M == N && f[1] == N);
             read.ok(rsc_contact_destroy(&copy) == 0 && rsc_contact_destroy(&other) == 0);
             return read;
         }))
        CHECK(answer.failures == 0);
}

}  // namespace test_api_threads
