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

// Elements that yield: a copy knows what its original has been through, a contact newly made does not; a size effect is refused.
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
    CHECK_RELATIVE(virgin, less, 1e-6);
    CHECK(rsc_contact_destroy(&contact) == RSC_SUCCESS);
    CHECK(rsc_contact_create_from_case(&contact, on, a_case) == RSC_SUCCESS);
    CHECK(rsc_contact_indent(contact, 0.006, &virgin) == RSC_SUCCESS);
    CHECK(virgin > 1.05 * less);
    CHECK(rsc_contact_destroy(&contact) == RSC_SUCCESS);
    CHECK(rsc_case_set(a_case, "solids%size_effect", "0.001") == RSC_SUCCESS);
    CHECK(rsc_contact_create_from_case(&contact, on, a_case) != RSC_SUCCESS);
    CHECK(says("size_effect"));
    CHECK(rsc_contact_destroy(&copy) == RSC_SUCCESS && rsc_asperities_destroy(&on) == RSC_SUCCESS &&
          rsc_case_destroy(&a_case) == RSC_SUCCESS);
}

}  // namespace

TESTS {
    yielding();
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
}
