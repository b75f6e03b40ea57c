// States as values: commit, roll back, copies and saves of contacts that yield; a sphere with friction that rolls; many contacts at once; runs
// that are watched.
#include "check.hpp"
#include "unit/library.hpp"
#include "unit/temporary_folder.hpp"

namespace {

constexpr double kTolerance = 1e-5;  // ten times that of the levels

const std::string kSurface = "&surface n=128 L_lambda_l=4 L_lambda_s=16 L=1 sigma=0.01 / &solids E=1e5,Infinity nu=0.3,0 R=Infinity,2.5 ";

// A step that was tried leaves no trace; a copy and a restored save go on as the original does.
void test_yielding(const std::string& keys, const Folder& folder) {
    Made made(kSurface + "hardness=1500 / " + keys);
    rsc_contact* const contact = made.contact;
    ContactHandle copy, saved;
    const std::string path = folder / "save";
    force_at(contact, 0.01);
    const double before = force_at(contact, 0.0102), work = value(contact, "plastic_work"), stiffness = value(contact, "stiffness");
    CHECK(before > 0 && work > 0);
    OK(rsc_contact_commit(contact));
    OK(rsc_contact_copy(&copy, contact));
    OK(rsc_contact_save(contact, path.c_str()));
    OK(rsc_contact_restore(&saved, made.asperities, path.c_str()));
    for (rsc_contact* one : {contact, copy.get(), saved.get()}) {
        CHECK_RELATIVE(value(one, "force"), before, 1e-15);
        CHECK_RELATIVE(value(one, "stiffness"), stiffness, 1e-3);
    }
    const double deeper = force_at(contact, 0.005), again = force_at(contact, 0.0102);
    CHECK(deeper > before && again < before);  // it has yielded further
    const ContactHandle fresh = contact_on(made.asperities, made.c);
    force_at(fresh, 0.01), force_at(fresh, 0.0102);
    const double way_back = force_at(fresh, 0.0104);
    OK(rsc_contact_rollback(contact));
    CHECK_RELATIVE(value(contact, "force"), before, 1e-15);
    CHECK_RELATIVE(value(contact, "plastic_work"), work, 1e-15);
    CHECK_RELATIVE(value(contact, "stiffness"), stiffness, 1e-3);
    for (rsc_contact* one : {contact, copy.get(), saved.get()}) {
        CHECK_RELATIVE(force_at(one, 0.0104), way_back, kTolerance);
        CHECK_RELATIVE(value(one, "plastic_work"), work, kTolerance);
        CHECK_RELATIVE(force_at(one, 0.005), deeper, kTolerance);
        OK(rsc_contact_rollback(one));
        CHECK_RELATIVE(force_at(one, 0.0104), way_back, kTolerance);
    }
}

// With adhesion, a contact that is saved after a move of its tip goes on from there, with the deflections of its tension.
void test_moved(const std::string& keys, const Folder& folder) {
    Made made(kSurface + "adhesion=0.5 " + keys + " / &compare levels='none' /");
    rsc_contact* const contact = made.contact;
    ContactHandle saved;
    const std::string path = folder / "save";
    force_at(contact, 0.01);
    OK(rsc_contact_commit(contact));
    OK(rsc_contact_move_tip(contact, 0.55, 0.48));
    ContactHandle copy;  // results are those of the last level until the next one
    OK(rsc_contact_copy(&copy, contact));
    for (const char* name : {"stiffness", "energy"}) CHECK_RELATIVE(value(copy, name), value(contact, name), 1e-15);
    const double moved = force_at(contact, 0.01);
    CHECK(moved != 0 && rsc_contact_commit(contact) == RSC_SUCCESS);
    OK(rsc_contact_save(contact, path.c_str()));
    OK(rsc_contact_restore(&saved, made.asperities, path.c_str()));
    CHECK_RELATIVE(value(saved, "force"), moved, 1e-15);
    const double x[] = {0.5, 0.552}, y[] = {0.5, 0.481};
    double before[2], after[2];
    OK(rsc_contact_deflection(contact, 2, x, y, before));
    OK(rsc_contact_deflection(saved, 2, x, y, after));
    for (int k = 0; k < 2; ++k) CHECK_RELATIVE(after[k], before[k], 1e-15);
    for (rsc_contact* one : {contact, saved.get()}) OK(rsc_contact_move_tip(one, 0.47, 0.5));
    for (const double Z : {0.01, 0.013, 0.008}) {
        CHECK_RELATIVE(force_at(saved, Z), force_at(contact, Z), kTolerance);
        CHECK_RELATIVE(value(saved, "energy_lost"), value(contact, "energy_lost"), 10 * kTolerance);
    }
}

struct Path {
    double N = 0, Qx = 0, Qy = 0, tangential = 0, lost = 0;
};

Path state(const rsc_friction* friction) {
    Path p;
    CHECK(rsc_friction_state(friction, nullptr, nullptr, nullptr, &p.N, &p.Qx, &p.Qy, nullptr, &p.tangential, &p.lost, nullptr) ==
          RSC_SUCCESS);
    return p;
}

// The force of the slide is bounded by mu N, what its energy falls by is lost, none is won; a move back to where the tip is does nothing, one to
// other asperities leaves nothing of the slide.
void test_rolling() {
    Made made(kSurface + "/");
    FrictionHandle friction;
    constexpr double mu = 0.4, Z0 = 0.012;
    OK(rsc_friction_create(&friction, made.contact, mu, 0.8));
    OK(rsc_friction_update(friction, Z0, 0, 0, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_friction_update(friction, Z0, 2e-4, 1e-4, nullptr, nullptr, nullptr, nullptr));
    const Path slid = state(friction);
    CHECK(slid.Qx > 0 && slid.tangential > 0 && rsc_friction_commit(friction) == RSC_SUCCESS);
    CHECK(rsc_friction_move_tip(friction, 0.5, 0.5) == RSC_SUCCESS && state(friction).Qx == slid.Qx);
    Path last = slid;
    for (int k = 1; k <= 20; ++k) {
        OK(rsc_friction_move_tip(friction, 0.5 + 0.001 * k, 0.5));
        const Path now = state(friction);
        CHECK(std::hypot(now.Qx, now.Qy) <= mu * now.N * (1 + 1e-12));
        CHECK(now.tangential <= last.tangential * (1 + 1e-12) && now.lost >= last.lost);
        CHECK_CLOSE(now.tangential + now.lost, last.tangential + last.lost, 1e-12 * slid.tangential);
        last = now;
    }
    CHECK(last.Qx > 0 && last.Qx < slid.Qx);
    ContactHandle there;
    CHECK(rsc_contact_copy(&there, made.contact) == RSC_SUCCESS && rsc_contact_move_tip(there, 0.52, 0.5) == RSC_SUCCESS);
    CHECK_RELATIVE(last.N, force_at(there, Z0), kTolerance);
    CHECK(rsc_friction_move_tip(friction, 0.9, 0.1) == RSC_SUCCESS && state(friction).Qx == 0 && state(friction).tangential == 0);
    OK(rsc_friction_rollback(friction));
    double N = 0, Qx = 0;
    OK(rsc_friction_update(friction, Z0, 2e-4, 1e-4, &N, &Qx, nullptr, nullptr));
    CHECK_RELATIVE(N, slid.N, kTolerance);
    CHECK_RELATIVE(Qx, slid.Qx, kTolerance);
    OK(rsc_friction_update(friction, 0.9 * Z0, 2e-4, 1e-4, &N, nullptr, nullptr, nullptr));  // the tip is back, too
    CHECK_RELATIVE(N, force_at(made.contact, 0.9 * Z0), kTolerance);
}

struct Watched {
    int calls = 0, until = 0;
    double done = 0, total = 0;
};
std::int32_t watch(double done, double total, void* data) {
    auto& w = *static_cast<Watched*>(data);
    w.done = done, w.total = total;
    return ++w.calls >= w.until;
}

void test_watched(const Folder& folder) {
    for (const char* realizations : {"1", "20"}) {
        const std::string file = folder / "run.nc";
        Made made(kSurface + "/ &indentation steps=40 / &run realizations=" + std::string(realizations) + " / &output file='" + file +
                  "' /");
        Watched once{0, 1, 0, 0}, never{0, 1 << 30, 0, 0};
        CHECK(rsc_case_run_watched(made.c, watch, &once, nullptr) == RSC_STOPPED && folder.files() <= 1);
        CHECK(once.calls == 1 && !std::ifstream(file));
        std::filesystem::remove(file + ".checkpoint");
        CHECK(rsc_case_run_watched(made.c, watch, &never, nullptr) == RSC_SUCCESS && std::ifstream(file));
        CHECK(never.calls > 1 && never.done >= never.total - 1 && never.total == (*realizations == '1' ? 40 : 20));
        std::filesystem::remove(file);
    }
}

}  // namespace

TESTS {
    test_yielding("", Folder());
    test_yielding("&solver model='elements' / &elements points_per_wave=4 /", Folder());
    for (const char* keys : {"", "adhesion_range=2e-4", "adhesion_range=0.02 / &elements points_per_wave=4 / &solver model='elements'"})
        test_moved(keys, Folder());
    test_rolling();
    test_watched(Folder());
}
