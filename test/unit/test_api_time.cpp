// Bodies that relax in the library: times, trials that are rolled back, copies and saves that go on alike, refusals.
#include "check.hpp"
#include "unit/library.hpp"
#include "unit/temporary_folder.hpp"

namespace {

double at(rsc_contact* contact, double time, double Z0) {
    double N = std::nan("");
    CHECK(rsc_contact_set_time(contact, time) == RSC_SUCCESS && rsc_contact_indent(contact, Z0, &N) == RSC_SUCCESS);
    return N;
}

void test_states(const std::string& keys) {
    const Folder folder;
    Made made("&surface n=128 L_lambda_l=4 L_lambda_s=16 L=1 sigma=0.01 / &solver tolerance=1e-9 " + keys +
              " / &solids E=10,Infinity nu=0.3,0 R=Infinity,2.5 relaxation_share=0.4,0.3 relaxation_time=1,20 /");
    rsc_contact* const contact = made.contact;
    ContactHandle copy, saved, later_saved, refused;
    FrictionHandle friction;
    const double sudden = at(contact, 0, 0.01), held = at(contact, 2, 0.01);
    CHECK(held < 0.9 * sudden && value(contact, "time") == 2 && value(contact, "energy_lost") > 0);
    CHECK(at(contact, 2, 0.01) == held);  // asked again
    CHECK(rsc_contact_set_time(contact, 1) == -2 && rsc_contact_set_time(contact, std::nan("")) == -2);
    CHECK(rsc_contact_commit(contact) == RSC_SUCCESS && rsc_contact_copy(&copy, contact) == RSC_SUCCESS);
    OK(rsc_contact_save(contact, (folder / "save").c_str()));
    OK(rsc_contact_restore(&saved, made.asperities, (folder / "save").c_str()));
    const double trial = at(contact, 3, 0.005), after = at(contact, 9, 0.01);
    CHECK(trial > held && after < held);
    OK(rsc_contact_save(contact, (folder / "later").c_str()));  // which keeps the committed state, too
    OK(rsc_contact_restore(&later_saved, made.asperities, (folder / "later").c_str()));
    CHECK(value(later_saved, "force") == after && rsc_contact_rollback(later_saved) == RSC_SUCCESS && value(later_saved, "force") == held);
    OK(rsc_contact_rollback(contact));
    CHECK(value(contact, "force") == held && value(contact, "time") == 2);
    const double later = at(contact, 9, 0.01);
    for (rsc_contact* one : {copy.get(), saved.get()}) CHECK_RELATIVE(at(one, 9, 0.01), later, 1e-7);
    CHECK(later < held && std::abs(later / after - 1) > 1e-3);
    double Z0 = 0;
    CHECK(rsc_contact_set_time(contact, 30) == RSC_SUCCESS && rsc_contact_press(contact, held, &Z0) == RSC_SUCCESS && Z0 < 0.01);
    CHECK(rsc_friction_create(&friction, contact, 0.3, 0.8) != RSC_SUCCESS);
    OK(rsc_case_set(made.c, "solids%hardness", "5.0"));
    CHECK(rsc_contact_create_from_case(&refused, made.asperities, made.c) == -3 && !refused);
}

}  // namespace

TESTS {
    test_states("");
    test_states("model='elements'");
}
