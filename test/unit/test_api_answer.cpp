// A level's answer in one call and by name, the same level asked for again, and force control after levels that went wrong.
#include "check.hpp"
#include "unit/library.hpp"

namespace {

constexpr const char* kRough =
    "&surface n=256, L_lambda_l=4, L_lambda_s=64 / &solver tolerance=1e-11 / &indentation centre=0.43, 0.56 / &solids R=1.0,Infinity /";

// Asked again for the level it holds, the contact does not solve it again: a second solution would begin at the first and need fewer steps.
void test_again() {
    const Made made(kRough);
    rsc_contact* const k = made.contact;
    double N = 0, M = 0;
    OK(rsc_contact_indent(k, 0.01, &N));
    const double steps = value(k, "iterations");
    CHECK(steps > 1);
    OK(rsc_contact_indent(k, 0.01, &M));
    CHECK(M == N && value(k, "iterations") == steps);
    OK(rsc_contact_move_tip(k, 0.44, 0.56));  // another place is another level
    OK(rsc_contact_indent(k, 0.01, &M));
    CHECK(M != N);
    // Nor after a move, once the level there is known.
    OK(rsc_contact_indent(k, 0.008, &N));
    const double moved_steps = value(k, "iterations");
    OK(rsc_contact_indent(k, 0.008, &M));
    CHECK(M == N && moved_steps > 1 && value(k, "iterations") == moved_steps);
}

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

TESTS {
    test_again();
    test_press_after();
}
