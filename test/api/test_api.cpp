// The C interface against closed forms. Every value of a level against the result file:
// test_api_run.
#include <cfenv>

#include "check.hpp"
#include "support/library.hpp"

namespace test_api {

CaseHandle tight() { return case_of("&solver tolerance=1e-11 /"); }

// One asperity is Hertz: force, area, stiffness, energy and the deflection around it in closed
// form.
void test_single() {
    const double E = 2e5, r = 0.3, R = 5, u = 1e-3, x = 0.7, y = -0.2, z = 0.01;
    AsperitiesHandle a;
    OK(rsc_asperities_take(&a, 1, &x, &y, &z, &r, nullptr, nullptr, nullptr, nullptr));
    const CaseHandle options = tight();
    ContactHandle c;
    OK(rsc_contact_create(&c, a, E, R, x, y, options));
    OK(rsc_asperities_destroy(&a));  // the contact keeps its own
    CHECK(rsc_contact_result(c, nullptr, nullptr, nullptr, nullptr) == RSC_NO_RESULT);
    double N = 0, A = 0, Z = 0, touch = 0;
    std::int64_t contacts = 0, candidates = 0;
    OK(rsc_contact_first_touch(c, &touch));
    CHECK(touch == z);
    OK(rsc_contact_indent(c, z - u, &N));
    const double penetration = z - (z - u);  // as rounded
    const double f = 4.0 / 3 * E * std::sqrt(r) * std::pow(penetration, 1.5);
    CHECK_RELATIVE(N, f, 1e-13);
    OK(rsc_contact_result(c, &Z, &N, &A, &contacts));
    CHECK(Z == z - u && contacts == 1);
    CHECK_RELATIVE(A, pi * r * penetration, 1e-13);
    CHECK_RELATIVE(value(c, "stiffness"), -2 * E * std::sqrt(r * penetration), 1e-13);
    CHECK_RELATIVE(value(c, "energy"), 0.4 * f * penetration, 1e-12);
    std::int32_t status = -1;
    double residual = -1;
    OK(rsc_contact_level(c, &status, &candidates, nullptr, nullptr, &residual));
    CHECK(status == RSC_LEVEL_CONVERGED && candidates == 1 && residual <= 1e-11);
    // At the centre the penetration itself, at the edge half of it from both sides, far away the
    // point force and its correction.
    const double spot = std::sqrt(r * penetration);
    const double xs[4] = {x, x + 1, x + spot * (1 - 1e-9), x + spot * (1 + 1e-9)},
                 ys[4] = {y, y, y, y};
    double w[4];
    OK(rsc_contact_deflection(c, 4, xs, ys, w));
    CHECK_RELATIVE(w[0], penetration, 1e-12);
    CHECK_RELATIVE(w[1], f / (pi * E) * (1 + spot * spot / 10), 1e-8);
    CHECK_RELATIVE(w[2], penetration / 2, 1e-8);
    CHECK_RELATIVE(w[3], penetration / 2, 1e-8);

    OK(rsc_contact_press(c, f, &Z));
    CHECK_CLOSE(Z, z - penetration, 1e-10 * u);
    // Out of contact: everything is zero, and no failure.
    CHECK(force_at(c, z) == 0 && value(c, "stiffness") == 0 && value(c, "energy") == 0);
    OK(rsc_contact_press(c, 0, &Z));
    CHECK(Z == z);
    // Beyond the limits of numbers.
    CHECK(rsc_contact_press(c, 1e60, &Z) == -2 && rsc_contact_indent(c, -1e60, &N) == -2 &&
          rsc_contact_move_tip(c, 1e60, y) == -2 && Z == z);
    // The sphere moved aside by s stands lower there by R - sqrt(R^2 - s^2).
    const double s = 0.05, drop = R - std::sqrt(R * R - s * s);
    OK(rsc_contact_move_tip(c, x + s, y));
    CHECK_RELATIVE(force_at(c, z - drop - u), f, 1e-10);
    double x0 = 0;
    OK(rsc_contact_tip(c, &x0, nullptr));
    CHECK(x0 == x + s);
    // A place where the sphere cannot feel the asperity: refused, and the tip stays.
    for (const double far : {x + 2 * R, 1e49}) CHECK(rsc_contact_move_tip(c, far, y) == -2);
    CHECK(message().find("is not above the surface") != std::string::npos);
    OK(rsc_contact_tip(c, &x0, nullptr));
    CHECK(x0 == x + s);
    OK(rsc_contact_move_tip(c, x + 1.1 * R, y));
    CHECK_RELATIVE(value(c, "lateral_force_x"), f * s / std::sqrt(R * R - s * s),
                   1e-9);  // of the last level, where it was
    CHECK(rsc_contact_press(c, f, &Z) == -1);
    CHECK(message().find("no asperity under") != std::string::npos);
    CHECK(force_at(c, z - u) == 0);
}

// A text that does not fit is cut while its whole length is known.
void test_cut() {
    char whole[300], cut[8];
    std::int64_t length = 0, known = 0;
    OK(rsc_status_text(RSC_NOT_CONVERGED, whole, 300, &length));
    OK(rsc_status_text(RSC_NOT_CONVERGED, cut, 8, &known));
    CHECK(length > 8 && known == length && whole[length] == 0 &&
          std::string(cut) == std::string(whole).substr(0, 7));
}

constexpr const char* kRough =
    "&surface n=256, L_lambda_l=4, L_lambda_s=64 / &solver tolerance=1e-11 / &indentation "
    "centre=0.43, 0.56 / &solids R=1.0,Infinity /";

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
        CHECK(value(k, "iterations") <= 4 * steps);
    }
}

// A level without contact, and what is not estimated there: a caller that traps floating-point
// exceptions goes on, and one that tests the flags finds its own.
void test_caller_of_traps() {
    const Made made(kRough);
    double touch = 0;
    OK(rsc_contact_first_touch(made.contact, &touch));
    constexpr int errors = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW;
    for (const int own : {0, FE_UNDERFLOW})
        for (const double above : {1e-3, -1e-3}) {
            std::feclearexcept(FE_ALL_EXCEPT);
            std::feraiseexcept(own);
            OK(rsc_contact_indent(made.contact, touch + above, nullptr));
            CHECK(std::fetestexcept(errors) == own);
        }
    std::feclearexcept(FE_ALL_EXCEPT);
}

std::string namelist_of(const rsc_case* c) {
    std::string text(20000, ' ');
    OK(rsc_case_text(c, text.data(), static_cast<std::int64_t>(text.size()), nullptr));
    return text.substr(0, text.find('\0'));
}

// An empty value is the default.
void test_default_values() {
    const CaseHandle defaults = case_of("&run /");
    const CaseHandle c = case_of("&run /");
    const std::map<std::string, const char*> others{
        {"run%seed", "7"},         {"surface%window", "0,1,0,1"}, {"output%fields", "'gap'"},
        {"output%file", "'a.nc'"}, {"compare%levels", "1"},       {"surface%source", "'heights'"}};
    for (const auto& [key, value] : others) OK(rsc_case_set(c, key.c_str(), value));
    OK(rsc_case_set(c, "solids%E", "1, 2"));
    CHECK(namelist_of(c) != namelist_of(defaults));
    for (const auto& [key, value] : others) OK(rsc_case_set(c, key.c_str(), ""));
    CHECK(rsc_case_set(c, "solids%E(1)", " ") == -3);
    OK(rsc_case_set(c, "solids%E", " "));
    CHECK(namelist_of(c) == namelist_of(defaults));
}

TEST(api) {
    CHECK(message().empty());
    test_single();
    test_cut();
    test_press_after();
    test_caller_of_traps();
    test_default_values();
}

}  // namespace test_api
