// Memory refused at every single allocation, one after the other: the status says so, nothing is
// lost or broken, and the next call works.
#include "check.hpp"
#include "rsc.h"
#include "support/asperities.hpp"

namespace {

// Allocations left until one is refused; negative: none will be.
std::atomic<long> left{-1};

void* allocate(std::size_t size) {
    if (left >= 0 && left-- == 0) throw std::bad_alloc();
    void* p = std::malloc(size ? size : 1);
    if (!p) throw std::bad_alloc();
    return p;
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept try {
    return allocate(size);
} catch (const std::bad_alloc&) {
    return nullptr;
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace {

// Calls until no allocation is left to refuse; returns how many were refused.
template <class Call, class After>
int refuse_each(Call&& call, After&& after) {
    for (int k = 0;; ++k) {
        left = k;
        const std::int32_t status = call();
        const bool untouched = left >= 0;
        left = -1;
        if (status != RSC_NO_MEMORY) {
            CHECK(status == RSC_SUCCESS);
            if (untouched) return k;
        }
        after(status);
        if (k > 20000) {
            CHECK(!"more allocations than can be true");
            return k;
        }
    }
}

}  // namespace

TEST(api_memory) {
    const rsc::Asperities made = random_asperities(60, 0.05, 0.01, 3e-3, 0.3, 9);
    rsc_case* c = nullptr;
    CHECK(rsc_case_create(&c) == 0);
    int refused = 0;
    refused += refuse_each(
        [&] {
            return rsc_case_set(c, "output%file",
                                "'a name longer than what fits into a string itself'");
        },
        [](std::int32_t) {});
    refused += refuse_each([&] { return rsc_case_read(c, "&solver tolerance = 1e-9 /"); },
                           [](std::int32_t) {});

    rsc_asperities* a = nullptr;
    const auto n = static_cast<std::int64_t>(made.size());
    refused += refuse_each(
        [&] {
            return rsc_asperities_take(&a, n, made.x.data(), made.y.data(), made.z.data(),
                                       made.radius.data(), nullptr, nullptr, nullptr, nullptr);
        },
        [&](std::int32_t status) {
            CHECK((status == 0) == (a != nullptr));
            rsc_asperities_destroy(&a);
        });
    rsc_contact *k = nullptr, *fresh = nullptr;
    refused += refuse_each([&] { return rsc_contact_create(&k, a, 1e5, 20, 0.5, 0.5, c); },
                           [&](std::int32_t) { rsc_contact_destroy(&k); });
    CHECK(rsc_contact_copy(&fresh, k) == 0);

    double N = 0, M = 0, Z = 0;
    CHECK(rsc_contact_indent(fresh, 0.0, &M) == 0 && M > 0);
    refused += refuse_each(
        [&] { return rsc_contact_indent(k, 0.0, nullptr); },
        [&](std::int32_t status) {
            if (status != 0) {
                CHECK(rsc_contact_result(k, nullptr, nullptr, nullptr, nullptr) == RSC_NO_RESULT);
                CHECK(rsc_contact_stiffness(k, &Z) == RSC_NO_RESULT);
            }
            CHECK(rsc_contact_indent(k, 0.002, nullptr) == 0);
            CHECK(rsc_contact_indent(k, 0.0, &N) == 0);
            CHECK_RELATIVE(N, M, 1e-8);
        });
    CHECK(rsc_contact_indent(k, 0.0, &N) == 0);
    refused += refuse_each([&] { return rsc_contact_press(k, 2 * M, &Z); },
                           [&](std::int32_t) {
                               CHECK(rsc_contact_indent(k, 0.0, &N) == 0);
                               CHECK_RELATIVE(N, M, 1e-8);
                           });
    refused += refuse_each([&] { return rsc_contact_stiffness(k, &Z); }, [&](std::int32_t) {});
    double x0 = 0.5;
    refused += refuse_each(
        [&] {
            x0 = x0 == 0.5 ? 0.55 : 0.5;
            const std::int32_t status = rsc_contact_move_tip(k, x0, 0.5);
            return status != 0 ? status : rsc_contact_indent(k, 0.0, nullptr);
        },
        [&](std::int32_t) {
            CHECK(rsc_contact_move_tip(k, 0.5, 0.5) == 0);
            CHECK(rsc_contact_indent(k, 0.0, &N) == 0);
            CHECK_RELATIVE(N, M, 1e-8);
        });
    CHECK(refused > 100);
    rsc_contact_destroy(&k);
    rsc_contact_destroy(&fresh);
    rsc_asperities_destroy(&a);
    rsc_case_destroy(&c);
}
