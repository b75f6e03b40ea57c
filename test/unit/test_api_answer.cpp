// Force control after levels that went wrong.
#include "check.hpp"
#include "unit/library.hpp"

namespace {

constexpr const char* kRough =
    "&surface n=256, L_lambda_l=4, L_lambda_s=64 / &solver tolerance=1e-11 / &indentation centre=0.43, 0.56 / &solids R=1.0,Infinity /";

// Force control begins at the last level only where that is a start.
void test_press_after() {
    const Made fresh_one(kRough);
    rsc_contact* const fresh = fresh_one.contact;
    double Z = 0, Z_fresh = 0;
    OK(rsc_contact_press(fresh, 20, &Z_fresh));
    const double steps = value(fresh, "iterations");
    for (const double before : {-10.0, -1e30, 1e30, 1e3, 0.1}) {
        const Made made(kRough);
        rsc_contact* const k = made.contact;
        const std::int32_t status = rsc_contact_indent(k, before, nullptr);
        CHECK(status == RSC_SUCCESS || status == RSC_NOT_CONVERGED);
        OK(rsc_contact_press(k, 20, &Z));
        CHECK_CLOSE(Z, Z_fresh, 1e-9);
        CHECK(value(k, "iterations") <= 2 * steps);
    }
}

}  // namespace

TESTS { test_press_after(); }
