// A level's answer in one call and by name, the same level asked for again, and force control after levels that went wrong.
#include <cmath>
#include <fstream>
#include <string>

#include "check.hpp"
#include "rsc.h"
#include "unit/contact_values.hpp"
#include "unit/temporary_folder.hpp"

namespace {

#define OK(call) CHECK((call) == RSC_SUCCESS)

rsc_contact* contact(const char* text) {
    rsc_case* c = nullptr;
    rsc_asperities* a = nullptr;
    rsc_contact* k = nullptr;
    OK(rsc_case_create(&c));
    OK(rsc_case_read(c, text));
    OK(rsc_asperities_make(&a, c, 1));
    OK(rsc_contact_create_from_case(&k, a, c));
    OK(rsc_asperities_destroy(&a));
    OK(rsc_case_destroy(&c));
    return k;
}

constexpr const char* kRough =
    "&surface n=256, L_lambda_l=4, L_lambda_s=64 / &solver tolerance=1e-11 / &indentation centre=0.43, 0.56 / &solids R=1.0,Infinity /";

// Asked again for the level it holds, the contact does not solve it again: a second solution would begin at the first and need fewer steps.
void test_again() {
    rsc_contact* k = contact(kRough);
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
    OK(rsc_contact_destroy(&k));
}

// Force control begins at the last level only where that is a start.
void test_press_after() {
    rsc_contact* fresh = contact(kRough);
    double Z = 0, Z_fresh = 0;
    OK(rsc_contact_press(fresh, 20, &Z_fresh));
    const double steps = value(fresh, "iterations");
    for (const double before : {-10.0, -1e30, 1e30, 1e3, 0.1}) {
        rsc_contact* k = contact(kRough);
        const std::int32_t status = rsc_contact_indent(k, before, nullptr);
        CHECK(status == RSC_SUCCESS || status == RSC_NOT_CONVERGED);
        OK(rsc_contact_press(k, 20, &Z));
        CHECK_CLOSE(Z, Z_fresh, 1e-9);
        CHECK(value(k, "iterations") <= 2 * steps);
        OK(rsc_contact_destroy(&k));
    }
    OK(rsc_contact_destroy(&fresh));
}

}  // namespace

TESTS {
    test_again();
    test_press_after();
}
