// Contacts with a body that carries layers, through the library: kept in files, moved sideways, asked for deflections; asperities of a list.
#include "check.hpp"
#include "physics/random_asperities.hpp"
#include "unit/library.hpp"
#include "unit/temporary_folder.hpp"

namespace {

struct Coated {
    CaseHandle c;
    AsperitiesHandle asperities;
    ContactHandle contact;
    explicit Coated(const std::string& solids, const std::string& more = "") {
        const rsc::Asperities list = random_asperities(300, 0.01, 0.01, 5e-4, 0.4, 7);
        asperities = take(list);
        c = case_of("&surface L=1 sigma=0.01 / &solver tolerance=1e-9 model='asperities' / &solids " + solids + " / " + more);
        contact = contact_on(asperities, c);
    }
};

const std::string kSphere = " R=Infinity,2.5", kBody = "E=1e5,Infinity nu=0.3,0" + kSphere;
const char* const kValues[] = {"force",           "contact_area",    "energy",   "stiffness",
                               "lateral_force_x", "lateral_force_y", "moment_x", "contacts"};

// What a file gives back goes on as the original does; the lateral force is the gradient of the energy.
void kept(const std::string& more, const Folder& folder) {
    const std::string body = more.empty() ? kBody : "E=1e5,Infinity nu=0.3,0 R=Infinity,Infinity";
    Coated coated(body + " layer_thickness=0.05 layer_E=4e5 layer_nu=0.2", more);
    const double Z0 = 0.004;
    const double force = force_at(coated.contact, Z0);
    ContactHandle again;
    const std::string path = folder / "coated";
    OK(rsc_contact_save(coated.contact, path.c_str()));
    OK(rsc_contact_restore(&again, coated.asperities, path.c_str()));
    for (const char* name : {"force", "contact_area", "energy", "contacts"}) CHECK(value(again, name) == value(coated.contact, name));
    CHECK(force > 0 && force_at(again, 0.003) == force_at(coated.contact, 0.003));
    force_at(coated.contact, Z0);
    if (!more.empty()) return;  // flats have no lateral force
    const double lateral = value(coated.contact, "lateral_force_x"), step = 1e-4;
    double energy[2];
    for (const int side : {0, 1}) {
        OK(rsc_contact_move_tip(coated.contact, 0.5 + (side ? step : -step), 0.5));
        force_at(coated.contact, Z0);
        energy[side] = value(coated.contact, "energy");
    }
    CHECK_CLOSE(std::abs(energy[1] - energy[0]) / (2 * step), std::abs(lateral), 1e-3 * std::abs(lateral));
}

// The hardness is that of what lies on top: no contact bears more. A stiff coating carries more than its base, and yields at the same pressure.
void yielding() {
    const std::string layer = " layer_thickness=0.05 layer_E=4e5 layer_nu=0.2";
    Coated elastic(kBody + layer), yields(kBody + layer + " hardness=1000");
    const double N = force_at(yields.contact, 0.004);
    CHECK(N > 0 && N < force_at(elastic.contact, 0.004));
    CHECK(N <= 1000 * value(yields.contact, "contact_area") * (1 + 1e-9));
}

}  // namespace

TESTS {
    const Folder folder;
    kept("", folder);
    kept("&indentation boundary='periodic' /", folder);
    yielding();
}
