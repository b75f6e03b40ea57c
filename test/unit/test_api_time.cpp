// Bodies that relax in the library: times, trials that are rolled back, copies and saves that go on alike, refusals.
#include <cmath>
#include <string>

#include "check.hpp"
#include "rsc.h"
#include "unit/contact_values.hpp"
#include "unit/temporary_folder.hpp"

namespace {

double at(rsc_contact* contact, double time, double Z0) {
    double N = std::nan("");
    CHECK(rsc_contact_set_time(contact, time) == RSC_SUCCESS && rsc_contact_indent(contact, Z0, &N) == RSC_SUCCESS);
    return N;
}

void test_states(const std::string& keys) {
    const Folder folder;
    rsc_case* c = nullptr;
    rsc_asperities* asperities = nullptr;
    rsc_contact *contact = nullptr, *copy = nullptr, *saved = nullptr;
    rsc_friction* friction = nullptr;
    const std::string text = "&surface n=128 L_lambda_l=4 L_lambda_s=16 L=1 sigma=0.01 / &solver tolerance=1e-9 " + keys +
                             " / &solids E=10,Infinity nu=0.3,0 R=Infinity,2.5 relaxation_share=0.4,0.3 relaxation_time=1,20 ";
    CHECK(rsc_case_create(&c) == RSC_SUCCESS && rsc_case_read(c, (text + "/").c_str()) == RSC_SUCCESS);
    CHECK(rsc_asperities_make(&asperities, c, 1) == RSC_SUCCESS);
    CHECK(rsc_contact_create_from_case(&contact, asperities, c) == RSC_SUCCESS);
    const double sudden = at(contact, 0, 0.01), held = at(contact, 2, 0.01);
    CHECK(held < 0.9 * sudden && value(contact, "time") == 2 && value(contact, "energy_lost") > 0);
    CHECK(at(contact, 2, 0.01) == held);  // asked again
    CHECK(rsc_contact_set_time(contact, 1) == -2 && rsc_contact_set_time(contact, std::nan("")) == -2);
    CHECK(rsc_contact_commit(contact) == RSC_SUCCESS && rsc_contact_copy(&copy, contact) == RSC_SUCCESS);
    CHECK(rsc_contact_save(contact, (folder / "save").c_str()) == RSC_SUCCESS);
    CHECK(rsc_contact_restore(&saved, asperities, (folder / "save").c_str()) == RSC_SUCCESS);
    const double trial = at(contact, 3, 0.005), after = at(contact, 9, 0.01);
    CHECK(trial > held && after < held);
    CHECK(rsc_contact_rollback(contact) == RSC_SUCCESS);
    CHECK(value(contact, "force") == held && value(contact, "time") == 2);
    const double later = at(contact, 9, 0.01);
    for (rsc_contact* one : {copy, saved}) CHECK_RELATIVE(at(one, 9, 0.01), later, 1e-7);
    CHECK(later < held && std::abs(later / after - 1) > 1e-3);
    double Z0 = 0;
    CHECK(rsc_contact_set_time(contact, 30) == RSC_SUCCESS && rsc_contact_press(contact, held, &Z0) == RSC_SUCCESS && Z0 < 0.01);
    CHECK(rsc_friction_create(&friction, contact, 0.3, 0.8) != RSC_SUCCESS);
    rsc_contact_destroy(&contact), rsc_contact_destroy(&copy), rsc_contact_destroy(&saved);
    CHECK(rsc_case_set(c, "solids%hardness", "5.0") == RSC_SUCCESS);
    CHECK(rsc_contact_create_from_case(&contact, asperities, c) == -3 && !contact);
    rsc_asperities_destroy(&asperities), rsc_case_destroy(&c);
}

}  // namespace

TESTS {
    test_states("");
    test_states("model='elements'");
}
