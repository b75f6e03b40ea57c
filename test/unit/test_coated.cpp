// Contacts with a body that carries layers, through the library: yielding. Kept in files: test_guest_state; forces and energies: physics/test_layers.
#include "check.hpp"
#include "physics/random_asperities.hpp"
#include "unit/library.hpp"

namespace {

struct Coated {
    CaseHandle c;
    AsperitiesHandle asperities;
    ContactHandle contact;
    explicit Coated(const std::string& solids) {
        const rsc::Asperities list = random_asperities(300, 0.01, 0.01, 5e-4, 0.4, 7);
        asperities = take(list);
        c = case_of("&surface L=1 sigma=0.01 / &solver tolerance=1e-9 model='asperities' / &solids " + solids + " /");
        contact = contact_on(asperities, c);
    }
};

const std::string kBody = "E=1e5,Infinity nu=0.3,0 R=Infinity,2.5";

// The hardness is that of what lies on top: no contact bears more. A stiff coating carries more than its base, and yields at the same pressure.
TEST(yielding) {
    const std::string layer = " layer_thickness=0.05 layer_E=4e5 layer_nu=0.2";
    Coated elastic(kBody + layer), yields(kBody + layer + " hardness=1000");
    const double N = force_at(yields.contact, 0.004);
    CHECK(N > 0 && N < force_at(elastic.contact, 0.004));
    CHECK(N <= 1000 * value(yields.contact, "contact_area") * (1 + 1e-9));
}

}  // namespace
