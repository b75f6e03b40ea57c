// Elements through the library: the same handles and calls, with solver%model = 'elements' in the case.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "check.hpp"
#include "rsc.h"

namespace {

rsc_case* make_case(const char* model) {
    rsc_case* a_case = nullptr;
    CHECK(rsc_case_create(&a_case) == RSC_SUCCESS);
    for (const auto& [key, value] :
         {std::pair{"surface%n", "256"}, {"surface%L_lambda_l", "4"}, {"surface%L_lambda_s", "24"}, {"solver%model", model}})
        CHECK(rsc_case_set(a_case, key, value) == RSC_SUCCESS);
    return a_case;
}

bool says(const char* what) {
    char text[400];
    rsc_message(text, sizeof text, nullptr);
    return std::string(text).find(what) != std::string::npos;
}

// Elements that yield: what a copy has not been through, it does not know; a size effect is refused.
void yielding() {
    rsc_case* a_case = make_case("'elements'");
    CHECK(rsc_case_set(a_case, "solids%hardness", "15000") == RSC_SUCCESS);
    rsc_asperities* on = nullptr;
    rsc_contact *contact = nullptr, *copy = nullptr;
    CHECK(rsc_asperities_make(&on, a_case, 1) == RSC_SUCCESS);
    CHECK(rsc_contact_create_from_case(&contact, on, a_case) == RSC_SUCCESS);
    double N = 0, less = 0, lost = 0, plastic = 0, virgin = 0;
    CHECK(rsc_contact_indent(contact, 0.004, &N) == RSC_SUCCESS && N > 0);
    CHECK(rsc_contact_value(contact, "plastic_work", &lost) == RSC_SUCCESS && lost > 0);
    CHECK(rsc_contact_value(contact, "plastic_contacts", &plastic) == RSC_SUCCESS && plastic > 0);
    CHECK(rsc_contact_indent(contact, 0.006, &less) == RSC_SUCCESS && less < N);
    CHECK(rsc_contact_value(contact, "plastic_contacts", &plastic) == RSC_SUCCESS && plastic == 0);
    CHECK(rsc_contact_copy(&copy, contact) == RSC_SUCCESS);
    CHECK(rsc_contact_indent(copy, 0.006, &virgin) == RSC_SUCCESS);
    CHECK(virgin > 1.05 * less);
    CHECK(rsc_contact_destroy(&contact) == RSC_SUCCESS);
    CHECK(rsc_case_set(a_case, "solids%size_effect", "0.001") == RSC_SUCCESS);
    CHECK(rsc_contact_create_from_case(&contact, on, a_case) != RSC_SUCCESS);
    CHECK(says("size_effect"));
    CHECK(rsc_contact_destroy(&copy) == RSC_SUCCESS && rsc_asperities_destroy(&on) == RSC_SUCCESS &&
          rsc_case_destroy(&a_case) == RSC_SUCCESS);
}

// Two flats by both models: made from a case, pressed, put at the separation found, copied; the tip's place means nothing there.
void flats(const char* model) {
    rsc_case* a_case = nullptr;
    CHECK(rsc_case_create(&a_case) == RSC_SUCCESS);
    const std::string text =
        std::string("&surface L=2, n=128, L_lambda_l=4, L_lambda_s=16, sigma=0.02 / &asperities law='fourth_order' / ") +
        "&solids E=3, Infinity  nu=0, 0  R=Infinity, Infinity / &indentation boundary='periodic' / &solver tolerance=1e-9 model='" + model +
        "' /";
    CHECK(rsc_case_read(a_case, text.c_str()) == RSC_SUCCESS);
    rsc_asperities* on = nullptr;
    rsc_contact *contact = nullptr, *copy = nullptr;
    CHECK(rsc_asperities_make(&on, a_case, 1) == RSC_SUCCESS);
    CHECK(rsc_contact_create_from_case(&contact, on, a_case) == RSC_SUCCESS);
    double Z0 = 0, N = 0, p = 0, share = 0, area = 0, S = 0, W = 0, touch = 0, again = 0;
    const double force = 0.05;  // p = 0.0125 of E* = 3, h' about 1
    CHECK(rsc_contact_press(contact, force, &Z0) == RSC_SUCCESS);
    CHECK(rsc_contact_first_touch(contact, &touch) == RSC_SUCCESS && Z0 > 0 && Z0 < touch);
    CHECK(rsc_contact_value(contact, "pressure", &p) == RSC_SUCCESS);
    CHECK(rsc_contact_value(contact, "area_fraction", &share) == RSC_SUCCESS);
    CHECK(rsc_contact_value(contact, "contact_area", &area) == RSC_SUCCESS);
    CHECK_RELATIVE(p, force / 4, 1e-8);
    CHECK_RELATIVE(share, area / 4, 1e-14);
    CHECK(share > 0.001 && share < 0.1);
    CHECK(rsc_contact_indent(contact, Z0, &N) == RSC_SUCCESS);
    CHECK_RELATIVE(N, force, 1e-6);
    CHECK(rsc_contact_stiffness(contact, &S) == RSC_SUCCESS && S < 0);
    CHECK(rsc_contact_energy(contact, &W) == RSC_SUCCESS && W > 0);
    CHECK(rsc_contact_copy(&copy, contact) == RSC_SUCCESS);
    CHECK(rsc_contact_move_tip(copy, 0.3, -7) == RSC_SUCCESS);
    const double step = 1e-5 * Z0;
    double up = 0, there = 0;
    CHECK(rsc_contact_indent(copy, Z0, &there) == RSC_SUCCESS);
    CHECK_RELATIVE(there, N, 1e-7);
    CHECK(rsc_contact_indent(copy, Z0 + step, &up) == RSC_SUCCESS);
    CHECK_RELATIVE((up - there) / step, S, 0.02);
    double energy = 0;
    CHECK(rsc_contact_energy(copy, &energy) == RSC_SUCCESS);
    CHECK_RELATIVE((W - energy) / step, 0.5 * (up + there), 1e-4);
    // Deflections have no mean over a period, and are the overlap where the flat presses.
    int64_t n = 0;
    CHECK(rsc_contact_result(contact, nullptr, nullptr, nullptr, &n) == RSC_SUCCESS && n > 0);
    std::vector<double> x, y, u;
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) x.push_back(i / 32.0), y.push_back(j / 32.0);
    u.resize(x.size());
    CHECK(rsc_contact_deflection(contact, static_cast<int64_t>(x.size()), x.data(), y.data(), u.data()) == RSC_SUCCESS);
    double mean = 0, largest = 0;
    for (double v : u) mean += v / static_cast<double>(u.size()), largest = std::max(largest, std::abs(v));
    CHECK(largest > 0.1 * 0.02 && std::abs(mean) < 0.02 * largest);
    double shifted[2] = {0, 0};
    const double at[2] = {x[77], x[77] - 4}, by[2] = {y[77], y[77] + 2};
    CHECK(rsc_contact_deflection(contact, 2, at, by, shifted) == RSC_SUCCESS);
    CHECK_RELATIVE(shifted[0], u[77], 1e-12);
    CHECK_RELATIVE(shifted[1], u[77], 1e-9);
    if (std::string(model) == "elements") {
        CHECK(rsc_contact_press(contact, 1e3, &again) < 0 && says("closes the gap altogether"));
        CHECK(rsc_contact_indent(contact, -0.001, &again) < 0 && says("closes the gap altogether"));
        CHECK(rsc_contact_energy(contact, &W) == RSC_NO_RESULT);
        CHECK(rsc_contact_press(contact, force, &again) == RSC_SUCCESS && again == Z0);
    }
    rsc_contact_destroy(&contact);
    rsc_contact_destroy(&copy);
    rsc_asperities_destroy(&on);
    rsc_case_destroy(&a_case);
}

}  // namespace

int main() {
    yielding();
    flats("asperities");
    flats("elements");
    rsc_case *elements = make_case("'elements'"), *asperities = make_case("'asperities'");
    rsc_asperities *points = nullptr, *summits = nullptr;
    CHECK(rsc_asperities_make(&points, elements, 1) == RSC_SUCCESS);
    CHECK(rsc_asperities_make(&summits, asperities, 1) == RSC_SUCCESS);
    int64_t n = -1;
    CHECK(rsc_asperities_count(points, &n) == RSC_SUCCESS && n == 0);

    rsc_contact *truth = nullptr, *model = nullptr, *none = nullptr;
    CHECK(rsc_contact_create_from_case(&truth, points, elements) == RSC_SUCCESS);
    CHECK(rsc_contact_create_from_case(&model, summits, asperities) == RSC_SUCCESS);
    CHECK(rsc_contact_create_from_case(&none, points, asperities) == -3 && none == nullptr);
    CHECK(rsc_contact_create_from_case(&none, summits, elements) == -3 && none == nullptr);

    double N = 0, N_model = 0, Z0 = 0, area = 0, stiffness = 0, energy = 0;
    CHECK(rsc_contact_indent(truth, 0.01, &N) == RSC_SUCCESS);
    CHECK(rsc_contact_indent(model, 0.01, &N_model) == RSC_SUCCESS);
    CHECK(std::abs(N_model / N - 1) < 0.2);  // one surface, two models
    CHECK(rsc_contact_result(truth, nullptr, nullptr, &area, &n) == RSC_SUCCESS && n > 0 && area > 0);
    CHECK(rsc_contact_stiffness(truth, &stiffness) == RSC_SUCCESS && stiffness < 0);
    CHECK(rsc_contact_energy(truth, &energy) == RSC_SUCCESS && energy > 0);
    std::vector<double> force(static_cast<std::size_t>(n));
    std::vector<int32_t> pixel(force.size());
    CHECK(rsc_contact_spots(truth, n, pixel.data(), force.data(), nullptr, nullptr) == RSC_SUCCESS);
    double sum = 0;
    for (double f : force) sum += f;
    CHECK_RELATIVE(sum, N, 1e-12);
    CHECK(rsc_contact_per_asperity(truth, 0, nullptr, nullptr, nullptr) == -1);
    CHECK(rsc_contact_press(truth, N, &Z0) == RSC_SUCCESS);
    CHECK_RELATIVE(Z0, 0.01, 1e-5);

    // Where a pixel is pressed the surface follows the sphere: deflection = overlap at its middle.
    int64_t nx = 0;
    double dx = 0;
    rsc_surface* surface = nullptr;
    CHECK(rsc_case_set(elements, "surface%n", "192") == RSC_SUCCESS);  // the grid of the elements
    CHECK(rsc_surface_synthesize(&surface, elements, 1) == RSC_SUCCESS);
    CHECK(rsc_surface_grid(surface, &nx, nullptr, &dx, nullptr, nullptr, nullptr, nullptr) == RSC_SUCCESS);
    std::vector<double> z(static_cast<std::size_t>(nx * nx));
    CHECK(rsc_surface_heights(surface, nx * nx, z.data()) == RSC_SUCCESS);
    const double x = static_cast<double>(pixel[0] % nx) * dx, y = static_cast<double>(pixel[0] / nx) * dx;
    const double R = 2.5, rho2 = (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5);
    double deflection = 0;
    CHECK(rsc_contact_deflection(truth, 1, &x, &y, &deflection) == RSC_SUCCESS);
    CHECK_RELATIVE(deflection, z[static_cast<std::size_t>(pixel[0])] - rho2 / (R + std::sqrt(R * R - rho2)) - Z0, 1e-4);
    // Points that were handed over: the same contact.
    rsc_asperities* taken = nullptr;
    rsc_contact* other = nullptr;
    CHECK(rsc_asperities_find(&taken, surface, elements) == RSC_SUCCESS);
    CHECK(rsc_surface_destroy(&surface) == RSC_SUCCESS);
    CHECK(rsc_contact_create(&other, taken, 94706.168487394958, R, 0.5, 0.5, elements) == RSC_SUCCESS);
    double again = 0;
    CHECK(rsc_contact_indent(other, 0.01, &again) == RSC_SUCCESS);
    CHECK_RELATIVE(again, N, 1e-5);

    for (rsc_contact* c : {truth, model, other}) rsc_contact_destroy(&c);
    for (rsc_asperities* a : {points, summits, taken}) rsc_asperities_destroy(&a);
    for (rsc_case* c : {elements, asperities}) rsc_case_destroy(&c);
    return check::summary();
}
