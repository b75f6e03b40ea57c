// A level's answer in one call and by name, the same level asked for again, and force control after levels that went wrong.
#include <cmath>
#include <fstream>
#include <string>

#include "check.hpp"
#include "rsc.h"
#include "temporary_folder.hpp"

namespace {

#define OK(call) CHECK((call) == RSC_SUCCESS)

std::string message() {
    char text[2000] = "";
    OK(rsc_message(text, sizeof text, nullptr));
    return text;
}

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

double value(rsc_contact* k, const char* name) {
    double v = -12345;
    CHECK(rsc_contact_value(k, name, &v) == RSC_SUCCESS);
    return v;
}

constexpr const char* kRough =
    "&surface n=256, L_lambda_l=4, L_lambda_s=64 / &solver tolerance=1e-11 / &indentation centre=0.43, 0.56 / &solids R=1.0,Infinity /";

void test_answer() {
    rsc_contact* k = contact(kRough);
    double Z = 0, N = 0, S = 0, A = 0, W = 0, x = 0, y = 0, v = 7;
    std::int32_t status = -1;
    std::int64_t contacts = -1, pairs = -1, large = -1, beyond = -1, edge = -1;
    const auto all = [&] { return rsc_contact_answer(k, &Z, &N, &S, &A, &W, &x, &y, &status, &contacts, &pairs, &large, &beyond, &edge); };
    CHECK(all() == RSC_NO_RESULT && rsc_contact_value(k, "force", &v) == RSC_NO_RESULT && v == 7 && N == 0);
    const double Z0 = -0.01, h = 1e-6;
    OK(rsc_contact_indent(k, Z0, nullptr));
    OK(all());
    double N_ = 0, A_ = 0, S_ = 0, W_ = 0;
    std::int64_t n = 0, pairs_ = 0;
    std::int32_t status_ = -1;
    OK(rsc_contact_result(k, nullptr, &N_, &A_, &n));
    OK(rsc_contact_level(k, &status_, nullptr, nullptr, &pairs_, nullptr));
    OK(rsc_contact_stiffness(k, &S_));
    OK(rsc_contact_energy(k, &W_));
    CHECK(Z == Z0 && N == N_ && A == A_ && S == S_ && W == W_ && contacts == n && pairs == pairs_ && status == status_);
    CHECK(N > 0 && S < 0 && contacts > 20 && pairs > 0 && large > 0 && large <= contacts && beyond == 0 && edge >= 0 && edge <= contacts);
    OK(rsc_contact_answer(k, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                          nullptr));
    CHECK(value(k, "separation") == Z && value(k, "force") == N && value(k, "contact_area") == A && value(k, "stiffness") == S);
    CHECK(value(k, "energy") == W && value(k, "lateral_force_x") == x && value(k, "lateral_force_y") == y);
    CHECK(value(k, "large_contacts") == static_cast<double>(large) && value(k, "contacts") == static_cast<double>(contacts));
    CHECK(value(k, "status") == status && value(k, "overlapping_pairs") == static_cast<double>(pairs));
    CHECK_RELATIVE(value(k, "conductance_length"), -2 * S / (78e3 / (1 - 0.42 * 0.42)), 1e-14);
    // Every force points to the centre of the sphere, R above the tip.
    CHECK(value(k, "moment_x") == -1.0 * y && value(k, "moment_y") == 1.0 * x);
    CHECK(rsc_contact_value(k, "resistance", &v) == RSC_NO_RESULT && message().find("solids%resistivity") != std::string::npos && v == 7);
    CHECK(rsc_contact_value(k, "lateral_force", &v) == -2);  // by component
    CHECK(rsc_contact_value(k, "forces", &v) == -2 && message().find("lateral_force_x") != std::string::npos);
    CHECK(message().find("large_contacts") != std::string::npos && v == 7);
    CHECK(rsc_contact_value(k, "crowded_cells", &v) == -2);  // of maps, which the library does not make
    CHECK(rsc_contact_value(nullptr, "force", &v) == -1 && rsc_contact_value(k, nullptr, &v) == -2 &&
          rsc_contact_value(k, "force", nullptr) == -3);

    // The answer is that of the tip's old place until the next level; the lateral force is the slope of the energy.
    const double x_before = x;
    OK(rsc_contact_move_tip(k, 0.43 + h, 0.56));
    OK(all());
    CHECK(x == x_before && W == W_);
    OK(rsc_contact_indent(k, Z0, nullptr));
    OK(all());
    CHECK(x != x_before);
    double W_up = W, W_down = 0;
    OK(rsc_contact_move_tip(k, 0.43 - h, 0.56));
    OK(rsc_contact_indent(k, Z0, nullptr));
    OK(rsc_contact_energy(k, &W_down));
    // Central differences of the energy, right to some 1e-9 W/h; the force is a sum of slopes of some 0.1 N.
    CHECK_CLOSE(x_before, -(W_up - W_down) / (2 * h), 1e-3 * std::abs(x_before));
    OK(rsc_contact_destroy(&k));
}

// (rho_1 + rho_2) over the conductance length, in a copy, too; infinite where nothing touches.
void test_resistance() {
    rsc_contact *k = contact("&surface n=256, L_lambda_l=4, L_lambda_s=64 / &solids resistivity=2e-5, 3e-5 /"), *copy = nullptr;
    OK(rsc_contact_copy(&copy, k));
    for (rsc_contact* c : {k, copy}) {
        OK(rsc_contact_indent(c, 0.01, nullptr));
        CHECK_RELATIVE(value(c, "resistance") * value(c, "conductance_length"), 5e-5, 1e-14);
        double v = 7;
        OK(rsc_contact_indent(c, 1.0, nullptr));
        CHECK(rsc_contact_value(c, "resistance", &v) == RSC_NO_RESULT && v == 7);
    }
    OK(rsc_contact_destroy(&k));
    OK(rsc_contact_destroy(&copy));
    for (const char* one : {"0, 7e-5", "7e-5, 0"}) {  // of one body alone
        k = contact(("&surface n=256, L_lambda_l=4, L_lambda_s=64 / &solids resistivity=" + std::string(one) + " /").c_str());
        OK(rsc_contact_indent(k, 0.01, nullptr));
        CHECK_RELATIVE(value(k, "resistance") * value(k, "conductance_length"), 7e-5, 1e-14);
        OK(rsc_contact_destroy(&k));
    }
}

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

void test_file_and_arrays() {
    const Folder folder;
    std::ofstream(folder / "good.nml") << "&surface sigma=0.02, n=4096 / &indentation levels=3,2,1 /\n";
    std::ofstream(folder / "bad.nml") << "&surface\n  simga=0.02 /\n";
    std::ofstream(folder / "study.nml") << "&surface sigma=0.02 / &study surface%sigma=0.01,0.02 /\n";
    rsc_case* c = nullptr;
    char text[100] = "";
    OK(rsc_case_create(&c));
    OK(rsc_case_read_file(c, (folder / "good.nml").c_str()));
    OK(rsc_case_get(c, "surface%n", text, sizeof text, nullptr));
    CHECK(std::string(text) == "4096");
    CHECK(rsc_case_read_file(c, (folder / "bad.nml").c_str()) == -2 && message().find("bad.nml:2:3") != std::string::npos);
    CHECK(rsc_case_read_file(c, (folder / "none.nml").c_str()) == -2 && message().find("none.nml") != std::string::npos);
    CHECK(rsc_case_read_file(c, (folder / "study.nml").c_str()) == -2 && message().find("&study") != std::string::npos);
    CHECK(rsc_case_read_file(c, folder.path.c_str()) == -2 && rsc_case_read_file(c, nullptr) == -2);
    CHECK(rsc_case_read_file(c, "") == -2 && message() == "argument 2 (path) must not be empty");
    CHECK(rsc_case_read_file(nullptr, "x") == -1);
    // Both values or one by name: half an array is a mistake.
    CHECK(rsc_case_set(c, "solids%E", "1e5") == -3 && message().find("solids%E(1)") != std::string::npos);
    OK(rsc_case_set(c, "solids%E", "1e5, 2e5"));
    OK(rsc_case_set(c, "solids%E", "2*3e5"));
    OK(rsc_case_set(c, "solids%E(2)", "4e5"));
    OK(rsc_case_get(c, "solids%E", text, sizeof text, nullptr));
    CHECK(std::string(text) == "3e+05, 4e+05");
    OK(rsc_case_set(c, "indentation%levels", "2.5"));  // a list of one
    OK(rsc_case_destroy(&c));
}

}  // namespace

int main() {
    test_answer();
    test_resistance();
    test_again();
    test_press_after();
    test_file_and_arrays();
    return check::summary();
}
