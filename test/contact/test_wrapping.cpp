// Tips on a periodic surface: a shift by whole periods changes nothing, and the border has no
// effect.
#include "check.hpp"
#include "support/library.hpp"

namespace test_wrapping {

constexpr int kN = 128;              // points along a side, of length 1
constexpr double kTolerance = 1e-5;  // ten times that of the levels

// A surface, and the same one shifted by half a period.
struct Round {
    CaseHandle keys;
    AsperitiesHandle on[2];
    explicit Round(const std::string& more) {
        keys = case_of(
            "&surface n=128 L_lambda_l=4 L_lambda_s=16 L=1 sigma=0.01 / &solids E=1e5,Infinity "
            "nu=0.3,0 R=Infinity,2.5 " +
            more);
        SurfaceHandle surface;
        std::vector<double> z(kN * kN), turned(kN * kN);
        CHECK(rsc_surface_synthesize(&surface, keys, 1) == RSC_SUCCESS &&
              rsc_surface_heights(surface, kN * kN, z.data()) == RSC_SUCCESS);
        for (const int j : indices(kN))
            for (const int i : indices(kN))
                turned[(j + kN / 2) % kN * kN + (i + kN / 2) % kN] = z[j * kN + i];
        for (const int k : indices(2)) {
            OK(rsc_surface_take(&surface, kN, kN, 1.0 / kN, 1.0 / kN, 0, 0, 1,
                                (k == 0 ? z : turned).data()));
            OK(rsc_asperities_find(&on[k], surface, keys));
        }
    }
    ContactHandle contact(int k) const { return contact_on(on[k], keys); }
};

const char* const kNames[] = {"force",           "contact_area", "stiffness", "energy",
                              "lateral_force_x", "moment_y",     "contacts",  "edge_contacts",
                              "nominal_area",    "status"};

std::vector<double> answers(rsc_contact* contact) {
    std::vector<double> values;
    for (const char* name : kNames) {
        values.push_back(std::nan(""));
        OK(rsc_contact_value(contact, name, &values.back()));
    }
    double w = 0;
    const double x = 0.03, y = 0.05;
    OK(rsc_contact_deflection(contact, 1, &x, &y, &w));
    return values;
}

double press(rsc_contact* contact, double x, double y, double Z0) {
    double N = std::nan("");
    CHECK(rsc_contact_move_tip(contact, x, y) == RSC_SUCCESS &&
          rsc_contact_indent(contact, Z0, &N) == RSC_SUCCESS);
    return N;
}

// At places near the border as in the middle of the surface that is counted from there, whole
// periods away in the same bits, and twice round the second time as the first.
void test_contact(const std::string& keys, bool elastic) {
    const Round round(keys);
    const ContactHandle one = round.contact(0), other = round.contact(1), far = round.contact(0);
    constexpr double Z0 = 0.012;
    // Laws with summits between the points search for them again only after a longer move.
    for (rsc_contact* contact : {one.get(), other.get(), far.get()})
        OK(rsc_contact_move_tip(contact, 0.25, 0.25));
    const double places[][2] = {{0, 0}, {0.015625, 0.953125}, {0.984375, 0.5}, {0.25, 0.75}};
    for (const auto& [x, y] : places) {
        CHECK(press(one, x, y, Z0) > 0);
        press(other, x < 0.5 ? x + 0.5 : x - 0.5, y < 0.5 ? y + 0.5 : y - 0.5, Z0);
        press(far, x + 3, y - 2, Z0);
        double x0 = -1, y0 = -1;
        CHECK(rsc_contact_tip(far, &x0, &y0) == RSC_SUCCESS && x0 == x && y0 == y);
        const auto here = answers(one), turned = answers(other), periods = answers(far);
        for (const auto k : indices(here)) {
            if (!(std::abs(here[k] - turned[k]) <=
                  kTolerance * (std::abs(here[k]) + (k == 4 || k == 5 ? here[0] : 0))))
                std::printf("%s: %s at %g, %g: %.9g and %.9g\n", keys.c_str(), kNames[k], x, y,
                            here[k], turned[k]);
            CHECK_CLOSE(here[k], turned[k],
                        kTolerance * (std::abs(here[k]) + (k == 4 || k == 5 ? here[0] : 0)));
            CHECK(periods[k] == here[k]);
        }
        double w[2] = {};
        const double at[2][2] = {{x + 0.0625, y},
                                 {x < 0.5 ? x + 0.5625 : x - 0.4375, y < 0.5 ? y + 0.5 : y - 0.5}};
        OK(rsc_contact_deflection(one, 1, &at[0][0], &at[0][1], &w[0]));
        OK(rsc_contact_deflection(other, 1, &at[1][0], &at[1][1], &w[1]));
        CHECK_RELATIVE(w[0], w[1], kTolerance);
    }
    if (elastic) {
        double first[16] = {};
        for (const int k : indices(32)) {
            const double N = press(one, 0.5 + k / 16.0, 0.03125, Z0);
            if (k < 16)
                first[k] = N;
            else
                CHECK_RELATIVE(N, first[k - 16], kTolerance);
        }
    }
}

// Spots that yielded at the border have yielded after a shift by a period.
void test_path(const std::string& keys) {
    const Round round(keys);
    const ContactHandle one = round.contact(0), other = round.contact(1);
    press(one, 0, 0.9375, 0.01);
    press(other, 0.5, 0.4375, 0.01);
    CHECK(value(one, "plastic_work") > 0);
    for (const double x : {0.25, 0.5, 0.75}) press(one, x, 0.5, 0.03);  // too high to touch
    CHECK_RELATIVE(press(one, 1, -0.0625, 0.0105), press(other, 0.5, 0.4375, 0.0105), kTolerance);
}

// Loads that last at the border act as in the middle of the surface.
void test_relaxing(const std::string& keys) {
    const Round round(keys);
    const ContactHandle one = round.contact(0), other = round.contact(1);
    for (const int k : indices(4)) {
        for (rsc_contact* contact : {one.get(), other.get()}) OK(rsc_contact_set_time(contact, k));
        const double N = press(one, 0.01 * k, 0.95, 0.01);
        CHECK_RELATIVE(N, press(other, 0.5 + 0.01 * k, 0.45, 0.01), kTolerance);
        CHECK_RELATIVE(value(one, "energy"), value(other, "energy"), kTolerance);
    }
}

TEST(wrapping) {
    const std::string elements = "/ &solver model='elements' /",
                      asperities = "/ &solver model='asperities' / ";
    test_contact(asperities, true);
    test_contact(asperities + "&asperities law='fourth_order' /", true);
    test_contact(elements, true);
    test_contact("adhesion=0.05 " + asperities, false);
    test_relaxing("relaxation_share=0.9 relaxation_time=1 " + asperities);
    test_path("hardness=1500 " + asperities);
    test_path("hardness=1500 " + elements);
}

}  // namespace test_wrapping
