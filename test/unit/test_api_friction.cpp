// Friction through the C interface: what it does is that of the core, what is wrong is told by name and changes nothing.
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/contact_curve.hpp"
#include "contact/equivalent.hpp"
#include "physics/random_asperities.hpp"
#include "rsc.h"

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

#define OK(call) CHECK((call) == RSC_SUCCESS)

std::string message() {
    char text[400];
    rsc_message(text, sizeof text, nullptr);
    return text;
}
bool says(const char* what) { return message().find(what) != std::string::npos; }

struct Handles {
    rsc::Asperities list = random_asperities(300, 0.02, 0.01, 5e-4, 0.3, 7);
    rsc_asperities* asperities = nullptr;
    rsc_contact* contact = nullptr;
    rsc_case* options = nullptr;
    Handles() {
        OK(rsc_asperities_take(&asperities, static_cast<std::int64_t>(list.size()), list.x.data(), list.y.data(), list.z.data(),
                               list.radius.data(), nullptr, nullptr, nullptr, nullptr));
        OK(rsc_case_create(&options));
        OK(rsc_case_set(options, "solver%tolerance", "1e-12"));
        OK(rsc_contact_create(&contact, asperities, 94e3, 2.5, 0.5, 0.5, options));
    }
    ~Handles() {
        rsc_contact_destroy(&contact);
        rsc_case_destroy(&options);
        rsc_asperities_destroy(&asperities);
    }
};

void same_as_core() {
    Handles h;
    rsc::SolverOptions tight;
    tight.tolerance = 1e-12;
    rsc::AsperityContact one(h.list, {94e3, 2.5, 0.5, 0.5}, tight), other(h.list, {94e3, 2.5, 0.5, 0.5}, tight);
    rsc::ContactCurve curve(one, other);
    rsc::FrictionHistory path({0.3, 0.8});
    rsc_friction* friction = nullptr;
    OK(rsc_friction_create(&friction, h.contact, 0.3, 0.8));
    rsc_contact_destroy(&h.contact);  // may go
    const double steps[][3] = {{0.002, 1, 2},           {0.001, 1.0001, 2},       {0.001, 1.0006, 2.0002}, {0.0005, 1.0006, 2},
                               {0.001, 1.0003, 1.9999}, {0.0012, 1.0003, 1.9999}, {0.001, 1.01, 2}};
    for (const auto& s : steps) {
        double N = 0, qx = 0, qy = 0, lost = 0, at = 0, x = 0, y = 0, W = 0, E = 0, total = 0, stick = 0, k[4] = {};
        OK(rsc_friction_update(friction, s[0], s[1], s[2], &N, &qx, &qy, &lost));
        path.go_to(curve, -s[0], {s[1], s[2]});
        CHECK(N == path.force() && qx == path.tangential_force().x && qy == path.tangential_force().y && lost == path.step_lost());
        OK(rsc_friction_state(friction, &at, &x, &y, &N, &qx, &qy, &W, &E, &total, &stick));
        CHECK(at == s[0] && x == s[1] && y == s[2] && qx == path.tangential_force().x && W == path.normal_energy());
        CHECK(E == path.tangential_energy() && total == path.work_lost() && stick == -path.stick_approach());
        OK(rsc_friction_stiffness(friction, &k[0], &k[1], &k[2], &k[3]));
        const auto tangent = path.stiffness(curve);
        CHECK(k[0] == tangent.xx && k[1] == tangent.xy && k[2] == tangent.yx && k[3] == tangent.yy);
    }
    // All slips now: mu N, and no spot sticks.
    double N = 0, qx = 0, qy = 0, slide = 0, most = 0, sum = 0;
    OK(rsc_friction_state(friction, nullptr, nullptr, nullptr, &N, &qx, &qy, nullptr, nullptr, nullptr, nullptr));
    CHECK_RELATIVE(std::hypot(qx, qy), 0.3 * N, 1e-12);
    OK(rsc_friction_full_slip(friction, &slide, &most));
    CHECK_RELATIVE(most, 0.3 * N, 1e-15);
    const double slides[4] = {0, 0.3 * slide, slide, 2 * slide};
    double Q[4], stick[4], back = 0;
    OK(rsc_friction_first_loading(friction, 4, slides, Q, stick));
    CHECK(Q[0] == 0 && Q[1] > 0 && Q[1] < most);
    CHECK_RELATIVE(Q[2], most, 1e-14);
    CHECK_RELATIVE(Q[3], most, 1e-14);
    // Spots that touch at a separation stick up to a slide of mu/m times how much deeper the sphere is.
    double now = 0;
    OK(rsc_friction_state(friction, &now, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr));
    CHECK(stick[0] == now);
    CHECK_RELATIVE(stick[1] - now, slides[1] * 0.8 / 0.3, 1e-12);
    CHECK_RELATIVE(stick[2] - now, slide * 0.8 / 0.3, 1e-12);
    CHECK(stick[3] == stick[2]);
    OK(rsc_friction_slide(friction, Q[1], &back));
    CHECK_RELATIVE(back, slides[1], 1e-7);
    std::int64_t n = 0;
    CHECK(rsc_friction_spots(friction, 0, &n, nullptr, nullptr, nullptr, nullptr, nullptr) == -2 && n > 5);
    std::vector<double> fx(static_cast<std::size_t>(n)), inner(static_cast<std::size_t>(n), 1.0);
    OK(rsc_friction_spots(friction, n, &n, nullptr, nullptr, inner.data(), fx.data(), nullptr));
    for (std::size_t i = 0; i < fx.size(); ++i) {
        sum += fx[i];
        CHECK(inner[i] == 0);
    }
    CHECK_RELATIVE(sum, qx, 1e-9);  // the levels of the sum and of the spots are two solutions to the tolerance
    // A copy has the path, and goes its own way.
    rsc_friction* copy = nullptr;
    OK(rsc_friction_copy(&copy, friction));
    OK(rsc_friction_commit(friction));
    double original = 0, copied = 0;
    OK(rsc_friction_update(friction, 0.001, 1.005, 2, nullptr, &original, nullptr, nullptr));
    OK(rsc_friction_update(copy, 0.001, 1.005, 2, nullptr, &copied, nullptr, nullptr));
    CHECK_RELATIVE(copied, original, 1e-9);
    OK(rsc_friction_rollback(friction));
    double again = 0;
    OK(rsc_friction_state(friction, nullptr, nullptr, nullptr, nullptr, &again, nullptr, nullptr, nullptr, nullptr, nullptr));
    CHECK(again == qx);
    OK(rsc_friction_destroy(&copy));
    OK(rsc_friction_destroy(&friction));
    CHECK(!friction);
    OK(rsc_friction_destroy(&friction));
}

void ratio_and_case() {
    const double E[2] = {70e3, 210e3}, nu[2] = {0.2, 0.3}, rigid[2] = {kInfinity, kInfinity}, wrong[2] = {0.2, 0.6};
    double m = 0;
    OK(rsc_tangential_ratio(E, nu, &m));
    CHECK(m == rsc::tangential_ratio(E, nu));
    CHECK(rsc_tangential_ratio(rigid, nu, &m) == -1 && says("both bodies are rigid"));
    CHECK(rsc_tangential_ratio(E, wrong, &m) == -2 && says("nu"));
    CHECK(rsc_tangential_ratio(nullptr, nu, &m) == -1 && rsc_tangential_ratio(E, nullptr, &m) == -2 &&
          rsc_tangential_ratio(E, nu, nullptr) == -3);
    CHECK(m == rsc::tangential_ratio(E, nu));
    Handles h;
    OK(rsc_case_set(h.options, "solids%E", "70e3, 210e3"));
    OK(rsc_case_set(h.options, "solids%nu", "0.2, 0.3"));
    OK(rsc_case_set(h.options, "solids%friction", "0.4"));
    CHECK(rsc_case_set(h.options, "solids%friction", "-0.1") == -3 && says("friction"));
    CHECK(rsc_case_set(h.options, "solids%resistivity", "1, -2") == -3 && says("resistivity"));
    rsc_friction *by_case = nullptr, *by_hand = nullptr;
    OK(rsc_friction_create_from_case(&by_case, h.contact, h.options));
    OK(rsc_friction_create(&by_hand, h.contact, 0.4, m));
    double a = 0, b = 0;
    for (rsc_friction* f : {by_case, by_hand}) OK(rsc_friction_update(f, 0.0, 0, 0, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_friction_update(by_case, 0.0, 1e-4, 0, nullptr, &a, nullptr, nullptr));
    OK(rsc_friction_update(by_hand, 0.0, 1e-4, 0, nullptr, &b, nullptr, nullptr));
    CHECK(a == b && a > 0);
    OK(rsc_friction_destroy(&by_case));
    OK(rsc_friction_destroy(&by_hand));
    // What yields has no friction, by a case either.
    rsc_contact* soft = nullptr;
    OK(rsc_case_set(h.options, "solids%hardness", "100.0"));
    CHECK(rsc_contact_create_from_case(&soft, h.asperities, h.options) == -3 && says("friction"));
    OK(rsc_case_set(h.options, "solids%friction", "0.0"));
    OK(rsc_contact_create_from_case(&soft, h.asperities, h.options));
    CHECK(rsc_friction_create_from_case(&by_case, soft, h.options) == -2 && says("must be elastic") && !by_case);
    OK(rsc_contact_destroy(&soft));
}

void misuse() {
    Handles h;
    rsc_friction* f = nullptr;
    CHECK(rsc_friction_create(nullptr, h.contact, 0.3, 0.8) == -1);
    CHECK(rsc_friction_create(&f, nullptr, 0.3, 0.8) == -2);
    CHECK(rsc_friction_create(&f, h.contact, -0.1, 0.8) == -3 && says("mu"));
    CHECK(rsc_friction_create(&f, h.contact, kNan, 0.8) == -3);
    CHECK(rsc_friction_create(&f, h.contact, 0.3, 0) == -4 && says("ratio"));
    CHECK(rsc_friction_create(&f, h.contact, 0.3, kInfinity) == -4 && !f);
    OK(rsc_friction_create(&f, h.contact, 0.3, 0.8));
    double q = 7, slides[2] = {1e-4, -1e-4}, forces[2] = {7, 7};
    CHECK(rsc_friction_state(f, &q, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr) == RSC_NO_RESULT);
    CHECK(rsc_friction_full_slip(f, &q, nullptr) == RSC_NO_RESULT && says("update first"));
    CHECK(rsc_friction_spots(f, 9, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr) == RSC_NO_RESULT);
    double touch = 0;
    OK(rsc_contact_first_touch(h.contact, &touch));
    OK(rsc_friction_update(f, touch + 0.01, 5, 5, nullptr, nullptr, nullptr, nullptr));
    CHECK(rsc_friction_first_loading(f, 1, slides, forces, nullptr) == RSC_NO_RESULT && says("no contact yet"));
    CHECK(rsc_friction_slide(f, 0, &q) == RSC_NO_RESULT);
    OK(rsc_friction_update(f, 0, 5, 5, nullptr, nullptr, nullptr, nullptr));
    CHECK(rsc_friction_update(f, kNan, 5, 5, &q, nullptr, nullptr, nullptr) == -2);
    CHECK(rsc_friction_update(f, 0, kInfinity, 5, &q, nullptr, nullptr, nullptr) == -3);
    CHECK(rsc_friction_update(f, 0, 5, 1e60, &q, nullptr, nullptr, nullptr) == -4);
    CHECK(rsc_friction_first_loading(f, -1, slides, forces, nullptr) == -2);
    CHECK(rsc_friction_first_loading(f, 2, slides, forces, nullptr) == -3 && forces[0] == 7);
    CHECK(rsc_friction_first_loading(f, 1, slides, nullptr, nullptr) == -4);
    CHECK(rsc_friction_slide(f, -1, &q) == -2 && rsc_friction_slide(f, 1e9, &q) == -2 && says("mu N"));
    CHECK(rsc_friction_slide(f, 0, nullptr) == -3);
    CHECK(q == 7);
    double x = 0;
    OK(rsc_friction_state(f, nullptr, &x, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr));
    CHECK(x == 5);
    CHECK(rsc_friction_update(nullptr, 0, 0, 0, nullptr, nullptr, nullptr, nullptr) == -1);
    CHECK(rsc_friction_stiffness(nullptr, nullptr, nullptr, nullptr, nullptr) == -1 && rsc_friction_commit(nullptr) == -1);
    CHECK(rsc_friction_rollback(nullptr) == -1 && rsc_friction_destroy(nullptr) == -1);
    OK(rsc_friction_destroy(&f));
    CHECK(rsc_friction_copy(&f, nullptr) == -2 && !f);
}

// A level on the way that does not converge is told by update, stiffness, first loading and slide, and the numbers are there.
void not_converged() {
    Handles h;
    OK(rsc_case_set(h.options, "solver%max_iterations", "1"));
    rsc_contact* contact = nullptr;
    OK(rsc_contact_create(&contact, h.asperities, 94e3, 2.5, 0.5, 0.5, h.options));
    rsc_friction* friction = nullptr;
    OK(rsc_friction_create(&friction, contact, 0.3, 0.8));
    double N = 0, slide = 1e-5, Q = 0;
    CHECK(rsc_friction_update(friction, 0.001, 0, 0, &N, nullptr, nullptr, nullptr) == RSC_NOT_CONVERGED && says("tolerance"));
    CHECK(N > 0);
    CHECK(rsc_friction_first_loading(friction, 1, &slide, &Q, nullptr) == RSC_NOT_CONVERGED && Q > 0);
    rsc_friction_destroy(&friction);
    rsc_contact_destroy(&contact);
}

}  // namespace

TESTS {
    same_as_core();
    not_converged();
    ratio_and_case();
    misuse();
}
