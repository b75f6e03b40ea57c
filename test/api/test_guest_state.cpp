// What is asked of a state later, after moves, copies and rollbacks (states of every kind:
// test_state_walk); a sphere with friction that rolls; runs that are watched.
#include "check.hpp"
#include "support/library.hpp"
#include "support/temporary_folder.hpp"

namespace test_guest_state {

constexpr double kTolerance = 1e-5;  // ten times that of the levels

const std::string kSurface =
    "&surface n=128 L_lambda_l=4 L_lambda_s=16 L=1 sigma=0.01 / &solids E=1e5,Infinity nu=0.3,0 "
    "R=Infinity,2.5 ";

double at(rsc_contact* contact, double time, double Z0) {
    OK(rsc_contact_set_time(contact, time));
    return force_at(contact, Z0);
}

// The lateral force and the moment of a level are the same, to the last bit, whenever they are
// asked for: at once, after other results, where the tip has moved on (near, far, over the border
// of a surface), of a copy, and after a step that was taken back. The next level has its own.
void test_asked_later(const std::string& keys) {
    const std::string text =
        "&surface n=128 L_lambda_l=4 L_lambda_s=16 L=1 sigma=0.01 / &solids E=1e5,Infinity "
        "nu=0.3,0 R=Infinity," +
        keys;
    const auto lateral = [](rsc_contact* contact) {
        return std::array{value(contact, "lateral_force_x"), value(contact, "lateral_force_y"),
                          value(contact, "moment_x")};
    };
    for (const double place : {0.3, 0.55}) {  // without a move before, too
        Made at_once(text), later(text);
        ContactHandle copy;
        for (rsc_contact* one : {at_once.contact.get(), later.contact.get()}) {
            CHECK(force_at(one, 0.008) > 0);
            if (place > 0.3)
                CHECK(rsc_contact_move_tip(one, place, 0.98) == RSC_SUCCESS &&
                      force_at(one, 0.008) > 0);
        }
        const auto now = lateral(at_once.contact);
        CHECK(now[0] != 0 && now[1] != 0);
        OK(rsc_contact_commit(later.contact));
        (void)value(later.contact, "stiffness");
        (void)value(later.contact, "energy");
        for (const double x : {place + 1e-5, place + 0.2}) {
            OK(rsc_contact_move_tip(later.contact, x, 0.9));
            OK(rsc_contact_copy(&copy, later.contact));
            CHECK(lateral(x > place + 0.1 ? later.contact : copy) == now);
        }
        double x = 0;
        CHECK(rsc_contact_tip(later.contact, &x, nullptr) == RSC_SUCCESS && x == place + 0.2 &&
              lateral(later.contact) == now);
        OK(rsc_contact_rollback(later.contact));
        CHECK(lateral(later.contact) == now);
        for (rsc_contact* one : {at_once.contact.get(), later.contact.get()})
            CHECK(force_at(one, 0.007) > 0);
        CHECK(lateral(later.contact) != now);
        for (const auto k : indices(now))
            CHECK(std::abs(lateral(later.contact)[k] - lateral(at_once.contact)[k]) <
                  1e-4 * value(later.contact, "force"));
    }
}

// So are those of a committed level from which another was computed before the tip moved for the
// first time, or could not move.
void test_asked_after_rollback(const std::string& keys) {
    Made made(
        "&surface n=128 L_lambda_l=4 L_lambda_s=16 L=1 sigma=0.01 / &solids E=1e5,Infinity "
        "nu=0.3,0 R=Infinity," +
        keys);
    rsc_contact* const contact = made.contact;
    const ContactHandle at_once = contact_on(made.asperities, made.c);
    for (rsc_contact* one : {contact, at_once.get()}) force_at(one, 0.002);
    OK(rsc_contact_commit(contact));
    const double next = force_at(contact, 0.008);
    (void)rsc_contact_move_tip(contact, 0.4, 0.9);
    CHECK(value(contact, "force") == next);
    OK(rsc_contact_rollback(contact));
    for (const char* name : {"lateral_force_x", "lateral_force_y"})
        CHECK_CLOSE(value(contact, name), value(at_once, name), 1e-9 * value(contact, "force"));
}

TEST(asked_later) {
    test_asked_later("2.5 / &asperities law='hertz' /");
    test_asked_later("1000 / &asperities law='fourth_order' /");  // summits moved
    test_asked_later("2.5 / &asperities law='fourth_order' /");   // summits found again
    test_asked_later("1000 hardness=1e3 / &asperities law='elliptic' /");
    for (const char* memory : {"", "hardness=1e3", "adhesion=0.01"})
        test_asked_after_rollback(std::string("20 ") + memory +
                                  " / &asperities law='fourth_order' /");
}

// Pulled off, a contact that sticks has a force at the first separation of its path with this
// force.
TEST(first_state_of_a_force) {
    Made made(
        "&surface L=2 n=256 sigma=1e-3 L_lambda_l=8 L_lambda_s=64 / &solids E=2,Infinity nu=0.49,0 "
        "R=Infinity,50 adhesion=1e-5 / &asperities law='hertz' /");
    constexpr double N = -9.5e-6, below = 1.7623e-3;
    double Z0 = 0;
    OK(rsc_contact_press(made.contact, 3e-3, &Z0));
    OK(rsc_contact_commit(made.contact));
    CHECK(force_at(made.contact, below) < N);
    OK(rsc_contact_rollback(made.contact));
    OK(rsc_contact_press(made.contact, N, &Z0));
    CHECK(Z0 < below);
}

// Time goes on, a body that relaxes gives way; it has neither hardness nor friction.
TEST(test_time) {
    const std::string body = "relaxation_share=0.4,0.3 relaxation_time=1,20";
    Made made(kSurface + body + " / &solver tolerance=1e-9 /");
    ContactHandle refused, copy;
    FrictionHandle friction;
    double Z0 = 0;
    const double sudden = at(made.contact, 0, 0.01), x[] = {0.5, 0.9}, y[] = {0.5, 0.1};
    double before[2], after[2];
    OK(rsc_contact_deflection(made.contact, 2, x, y, before));
    const double held = at(made.contact, 2, 0.01);
    // Under an indenter that is held the forces relax, the surface stays.
    OK(rsc_contact_deflection(made.contact, 2, x, y, after));
    for (const int k : {0, 1}) CHECK_RELATIVE(after[k], before[k], 1e-6);
    CHECK(held < 0.9 * sudden && value(made.contact, "time") == 2 &&
          at(made.contact, 2, 0.01) == held);
    CHECK(rsc_contact_copy(&copy, made.contact) == RSC_SUCCESS &&
          rsc_contact_set_time(copy, 1) == -2);
    CHECK(rsc_contact_set_time(made.contact, 1) == -2 &&
          rsc_contact_set_time(made.contact, std::nan("")) == -2);
    CHECK(rsc_contact_set_time(made.contact, 30) == RSC_SUCCESS &&
          rsc_contact_press(made.contact, held, &Z0) == RSC_SUCCESS && Z0 < 0.01);
    CHECK(rsc_friction_create(&friction, made.contact, 0.3, 0.8) != RSC_SUCCESS);
    OK(rsc_case_set(made.c, "solids%hardness", "5.0"));
    CHECK(rsc_contact_create_from_case(&refused, made.asperities, made.c) == -3 && !refused);
}

// The force of the slide is bounded by mu N; of asperities, what its energy falls by is lost, none
// is won; of elements, pixels that join the contact hold the deflection they meet, those that leave
// lose their tractions. A move back to where the tip is does nothing.
FrictionState rolled(const Made& made, FrictionHandle& friction, bool elements) {
    constexpr double mu = 0.4, Z0 = 0.012;
    OK(rsc_friction_create(&friction, made.contact, mu, 0.8));
    OK(rsc_friction_update(friction, Z0, 0, 0, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_friction_update(friction, Z0, 2e-4, 1e-4, nullptr, nullptr, nullptr, nullptr));
    const FrictionState slid = state(friction);
    CHECK(slid.Qx > 0 && slid.tangential > 0 && rsc_friction_commit(friction) == RSC_SUCCESS);
    CHECK(rsc_friction_move_tip(friction, 0.5, 0.5) == RSC_SUCCESS &&
          state(friction).Qx == slid.Qx);
    FrictionState last = slid;
    for (int k = 1; k <= 20; ++k) {
        OK(rsc_friction_move_tip(friction, 0.5 + 0.001 * k, 0.5));
        const FrictionState now = state(friction);
        CHECK(std::hypot(now.Qx, now.Qy) <= mu * now.N * (1 + 1e-12) && now.lost >= last.lost);
        if (!elements) {
            CHECK(now.tangential <= last.tangential * (1 + 1e-12));
            CHECK_CLOSE(now.tangential + now.lost, last.tangential + last.lost,
                        1e-12 * slid.tangential);
        }
        last = now;
    }
    CHECK(last.Qx > 0 && last.Qx < slid.Qx);
    ContactHandle there;
    CHECK(rsc_contact_copy(&there, made.contact) == RSC_SUCCESS &&
          rsc_contact_move_tip(there, 0.52, 0.5) == RSC_SUCCESS);
    CHECK_RELATIVE(last.N, force_at(there, Z0), kTolerance);
    return slid;
}

// A move to other asperities leaves nothing of the slide; a rollback brings the tip back, too.
TEST(test_rolling) {
    constexpr double Z0 = 0.012;
    for (const bool elements : {false, true}) {
        Made made(kSurface + (elements ? "/ &solver model='elements' /" : "/"));
        FrictionHandle friction;
        const FrictionState slid = rolled(made, friction, elements);
        if (!elements)
            CHECK(rsc_friction_move_tip(friction, 0.9, 0.1) == RSC_SUCCESS &&
                  state(friction).Qx == 0 && state(friction).tangential == 0);
        OK(rsc_friction_rollback(friction));
        double N = 0, Qx = 0;
        OK(rsc_friction_update(friction, Z0, 2e-4, 1e-4, &N, &Qx, nullptr, nullptr));
        CHECK_RELATIVE(N, slid.N, kTolerance);
        CHECK_RELATIVE(Qx, slid.Qx, kTolerance);
        OK(rsc_friction_update(friction, 0.9 * Z0, 2e-4, 1e-4, &N, nullptr, nullptr, nullptr));
        CHECK_RELATIVE(N, force_at(made.contact, 0.9 * Z0), kTolerance);
    }
}

struct Watched {
    int calls = 0, until = 0;
    double done = 0, total = 0;
};
std::int32_t watch(double done, double total, void* data) {
    auto& w = *static_cast<Watched*>(data);
    w.done = done;
    w.total = total;
    return ++w.calls >= w.until;
}

TEST(test_watched) {
    const Folder folder;
    for (const char* realizations : {"1", "20"}) {
        const std::string file = folder / "run.nc";
        Made made(kSurface + "/ &indentation steps=40 / &run realizations=" +
                  std::string(realizations) + " / &output file='" + file + "' /");
        Watched once{0, 1, 0, 0}, never{0, 1 << 30, 0, 0};
        CHECK(rsc_case_run_watched(made.c, watch, &once, nullptr) == RSC_STOPPED &&
              folder.files() <= 1);
        CHECK(once.calls == 1 && !std::ifstream(file));
        std::filesystem::remove(file + ".checkpoint");
        CHECK(rsc_case_run_watched(made.c, watch, &never, nullptr) == RSC_SUCCESS &&
              std::ifstream(file));
        CHECK(never.calls > 1 && never.done >= never.total - 1 &&
              never.total == (*realizations == '1' ? 40 : 20));
        std::filesystem::remove(file);
    }
}

// Where the indenter is steep, a contact that is moved before its first load is one made at that
// place, and a trial there is undone by a rollback; the results of a level outlast a move, also
// those of bodies with a memory.
void test_steep(const std::string& memory) {
    const std::string text =
        "&surface n=128 L_lambda_l=4 L_lambda_s=16 sigma=1e-4 / &solids R=Infinity,0.5 E=1e5,1e5 " +
        memory + " / &asperities law='elliptic' / ";
    Made moved(text), there(text + "&indentation centre=0.45,0.52 /");
    OK(rsc_contact_move_tip(moved.contact, 0.45, 0.52));
    double touch = 0, touch_there = 0;
    OK(rsc_contact_first_touch(moved.contact, &touch));
    OK(rsc_contact_first_touch(there.contact, &touch_there));
    CHECK(touch == touch_there);
    CHECK_RELATIVE(force_at(moved.contact, touch - 1e-4), force_at(there.contact, touch - 1e-4),
                   kTolerance);
    const double stiffness = value(there.contact, "stiffness");
    CHECK(stiffness < 0);
    OK(rsc_contact_move_tip(moved.contact, 0.47, 0.52));
    CHECK_RELATIVE(value(moved.contact, "stiffness"), stiffness, 1e-3);
    OK(rsc_contact_rollback(moved.contact));
    double x0 = 0;
    OK(rsc_contact_tip(moved.contact, &x0, nullptr));
    CHECK(x0 == 0.5);
    // A level at one place, a trial at another one.
    const double above = force_at(moved.contact, 2 * touch + 1);
    OK(rsc_contact_move_tip(moved.contact, 0.45, 0.52));
    OK(rsc_contact_commit(moved.contact));
    const double tried = force_at(moved.contact, touch - 1e-4);
    OK(rsc_contact_rollback(moved.contact));
    CHECK(above == 0 && value(moved.contact, "force") == above);
    CHECK_RELATIVE(force_at(moved.contact, touch - 1e-4), tried, kTolerance);
}

TEST(guest_state) {
    for (const char* memory :
         {"", "hardness=100", "relaxation_share=0.4 relaxation_time=1", "adhesion=1e-4"})
        test_steep(memory);
}

}  // namespace test_guest_state
