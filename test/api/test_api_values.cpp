// The rms height that a contact of a map given through rsc.h goes by; copies of a map.
#include "check.hpp"
#include "support/library.hpp"

namespace test_api_values {

using Values = std::vector<double>;

// A map of nx by ny points from (x0, y0) on.
struct Map {
    int nx = 24, ny = 15;
    double dx = 0.125, dy = 0.1875, x0 = -0.75, y0 = 2.0;
    double x(int i) const { return x0 + i * dx; }
    double y(int j) const { return y0 + j * dy; }
    std::size_t size() const { return nx * ny; }
    template <class Height>
    Values heights(Height&& z) const {
        Values all;
        for (const int j : indices(ny))
            for (const int i : indices(nx)) all.push_back(z(i, j));
        return all;
    }
    SurfaceHandle take(const Values& z, bool periodic = false) const {
        SurfaceHandle surface;
        OK(rsc_surface_take(&surface, nx, ny, dx, dy, x0, y0, periodic ? 1 : 0, z.data()));
        return surface;
    }
    Values heights_of(const rsc_surface* surface) const {
        Values z(size());
        OK(rsc_surface_heights(surface, nx * ny, z.data()));
        return z;
    }
};

double rms(const Values& z) {
    double mean = 0, square = 0;
    for (const double v : z) mean += v / double(z.size());
    for (const double v : z) square += (v - mean) * (v - mean) / double(z.size());
    return std::sqrt(square);
}

// Candidates at a separation with the tip 0.001 from the middle of a map.
std::int64_t candidates_at(const rsc_surface* surface, const rsc_case* a_case, double separation) {
    AsperitiesHandle on;
    ContactHandle contact;
    std::int64_t candidates = -1;
    OK(rsc_asperities_find(&on, surface, a_case));
    OK(rsc_contact_create(&contact, on, 1e3, 1.0, 0.501, 0.625, a_case));
    OK(rsc_contact_indent(contact, separation, nullptr));
    OK(rsc_contact_level(contact, nullptr, &candidates, nullptr, nullptr, nullptr));
    return candidates;
}

// The rms height that a contact goes by is that of the heights as they are now: given, with a form
// subtracted, or filtered; or surface%sigma. With the paper's selection no asperity is a candidate
// from 4 of it on: here the top of a wide bump, which is higher.
TEST(rms_height) {
    const Map map{32, 20, 0.03125, 0.0625, 0, 0};
    const Values z = map.heights([&](int i, int j) {
        const double r = std::hypot(map.x(i) - 0.5, map.y(j) - 0.625);
        return 0.004 + 0.01 * map.x(i) + 0.06 * std::exp(-r * r / (2 * 0.06 * 0.06));
    });
    CaseHandle a_case = case_of("&indentation selection='paper' / &solver interaction='none' /");
    const SurfaceHandle surface = map.take(z);
    SurfaceHandle copy;
    const auto goes_by = [&](const rsc_surface* s, double sigma) {
        CHECK(candidates_at(s, a_case, 3.99 * sigma) == 1);
        CHECK(candidates_at(s, a_case, 4.01 * sigma) == 0);
    };
    goes_by(surface, rms(z));
    double left = 0;
    OK(rsc_surface_detrend(surface, "plane", &left));
    CHECK_RELATIVE(left, rms(map.heights_of(surface)), 1e-12);
    CHECK(std::abs(left / rms(z) - 1) > 0.02);
    goes_by(surface, left);
    OK(rsc_surface_copy(&copy, surface));
    goes_by(copy, left);
    OK(rsc_surface_filter(surface, 0.25));
    const double filtered = rms(map.heights_of(surface));
    CHECK(std::abs(filtered / left - 1) > 0.02);
    goes_by(surface, filtered);
    goes_by(copy, left);
    OK(rsc_case_set(a_case, "surface%sigma", "0.0125"));
    goes_by(copy, 0.0125);
}

// A copy lies where its original lies, and has the same heights.
TEST(copy_of_a_surface) {
    const Map map;
    const Values z = map.heights([&](int i, int j) { return map.x(i) * map.y(j); });
    const SurfaceHandle surface = map.take(z);
    SurfaceHandle copy;
    OK(rsc_surface_copy(&copy, surface));
    double dx = 0, dy = 0, x0 = 0, y0 = 0;
    OK(rsc_surface_grid(copy, nullptr, nullptr, &dx, &dy, &x0, &y0, nullptr));
    CHECK(dx == map.dx && dy == map.dy && x0 == map.x0 && y0 == map.y0 &&
          map.heights_of(copy) == z);
}

// What was made for one model is no surface for the other.
TEST(models) {
    const std::string surface = "&surface n=64 L_lambda_l=4 L_lambda_s=16 / &solver model=";
    CaseHandle c[2] = {case_of((surface + "'asperities' /").c_str()),
                       case_of((surface + "'elements' /").c_str())};
    for (const int made : {0, 1}) {
        AsperitiesHandle a;
        OK(rsc_asperities_make(&a, c[made], 1));
        for (const int asked : {0, 1}) {
            ContactHandle contact;
            CHECK(rsc_contact_create_from_case(&contact, a, c[asked]) == (made == asked ? 0 : -3));
        }
    }
}

}  // namespace test_api_values
