// What rsc.h gives back against plain computations, on inputs in which x is not y: oblong maps with unlike steps, places off centre,
// numbers at the very bounds of what is accepted, spots of friction, files that are kept.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "check.hpp"
#include "rsc.h"
#include "unit/temporary_folder.hpp"
#include "version.h"

namespace {

#define OK(call) CHECK((call) == RSC_SUCCESS)
constexpr double kPi = std::numbers::pi, kInfinity = std::numeric_limits<double>::infinity();
using Values = std::vector<double>;

std::string message() {
    char text[5000] = "";
    OK(rsc_message(text, sizeof text, nullptr));
    return text;
}

// A map of nx by ny points from (x0, y0) on.
struct Map {
    int nx = 24, ny = 15;
    double dx = 0.125, dy = 0.1875, x0 = -0.75, y0 = 2.0;
    double x(int i) const { return x0 + i * dx; }
    double y(int j) const { return y0 + j * dy; }
    std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
    template <class Height>
    Values heights(Height&& z) const {
        Values all;
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) all.push_back(z(i, j));
        return all;
    }
    rsc_surface* take(const Values& z, bool periodic = false) const {
        rsc_surface* surface = nullptr;
        OK(rsc_surface_take(&surface, nx, ny, dx, dy, x0, y0, periodic ? 1 : 0, z.data()));
        return surface;
    }
    Values heights_of(const rsc_surface* surface) const {
        Values z(size());
        OK(rsc_surface_heights(surface, nx * ny, z.data()));
        return z;
    }
};

double noise(int k, int s) { return ((k * k * s + 29 * k + 7 * s) % 61) / 64.0; }

double rms(const Values& z) {
    double mean = 0, square = 0;
    for (const double v : z) mean += v / static_cast<double>(z.size());
    for (const double v : z) square += (v - mean) * (v - mean) / static_cast<double>(z.size());
    return std::sqrt(square);
}

std::int32_t level_at(const rsc_surface* surface, const rsc_case* a_case, double separation) {
    rsc_asperities* on = nullptr;
    rsc_contact* contact = nullptr;
    std::int32_t status = -1;
    OK(rsc_asperities_find(&on, surface, nullptr));
    OK(rsc_contact_create(&contact, on, 1e3, kInfinity, 0, 0, a_case));
    OK(rsc_contact_indent(contact, separation, nullptr));
    OK(rsc_contact_level(contact, &status, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_contact_destroy(&contact));
    OK(rsc_asperities_destroy(&on));
    return status;
}

// The rms height that a contact goes by (below -3 of it a level is out of validity) is that of the heights as they are now: given, with a
// form subtracted, or filtered; or surface%sigma. One thin spike on a wave, periodic, is all that touches.
void rms_height() {
    const Map map{32, 20, 0.03125, 0.0625, 0, 0};
    const Values z = map.heights([&](int i, int j) {
        const double wave = 0.01 * (std::cos(2 * kPi * (i - 16) / map.nx) + std::cos(2 * kPi * (j - 10) / map.ny));
        return 0.004 + 0.01 * map.x(i) + wave + (i == 16 && j == 10 ? 0.03 : 0);
    });
    rsc_case* a_case = nullptr;
    OK(rsc_case_create(&a_case));
    OK(rsc_case_read(a_case, "&indentation boundary='periodic' / &solids R=Infinity, Infinity / &solver interaction='none' /"));
    rsc_surface *surface = map.take(z, true), *copy = nullptr;
    const auto goes_by = [&](const rsc_surface* s, double sigma) {
        CHECK(level_at(s, a_case, -2.99 * sigma) == RSC_LEVEL_CONVERGED);
        CHECK(level_at(s, a_case, -3.01 * sigma) == RSC_LEVEL_OUT_OF_VALIDITY);
    };
    goes_by(surface, rms(z));
    double left = 0;
    OK(rsc_surface_detrend(surface, "plane", &left));
    const Values level = map.heights_of(surface);
    CHECK_RELATIVE(left, rms(level), 1e-12);
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
    OK(rsc_surface_destroy(&surface));
    OK(rsc_surface_destroy(&copy));
    OK(rsc_case_destroy(&a_case));
}

// What was synthesized keeps the rms height it was made for, whatever is done to its heights: seen in who is a candidate by the paper's radius.
void rms_of_synthesized() {
    rsc_case *made = nullptr, *asks = nullptr;
    rsc_surface *surface = nullptr, *copy = nullptr;
    OK(rsc_case_create(&made));
    OK(rsc_case_read(made, "&surface n=128, L_lambda_l=4, L_lambda_s=32, sigma=0.02, normalise='ensemble' /"));
    OK(rsc_surface_synthesize(&surface, made, 1));
    double left = 0;
    OK(rsc_surface_filter(surface, 0.25));
    OK(rsc_surface_detrend(surface, "quadratic", &left));
    CHECK(left < 0.7 * 0.02);
    OK(rsc_surface_copy(&copy, surface));
    const auto candidates = [&](const rsc_surface* s, const std::string& sigma) {
        rsc_asperities* on = nullptr;
        rsc_contact* contact = nullptr;
        std::int64_t n = 0;
        OK(rsc_case_create(&asks));
        OK(rsc_case_read(asks, ("&indentation selection='paper', selection_factor=0.5 / &surface " + sigma + "/").c_str()));
        OK(rsc_asperities_find(&on, s, nullptr));
        OK(rsc_contact_create(&contact, on, 1e3, 1.5, 0.5, 0.5, asks));
        OK(rsc_contact_indent(contact, 0.0, nullptr));
        OK(rsc_contact_level(contact, nullptr, &n, nullptr, nullptr, nullptr));
        OK(rsc_contact_destroy(&contact));
        OK(rsc_asperities_destroy(&on));
        OK(rsc_case_destroy(&asks));
        return n;
    };
    const std::int64_t of_made = candidates(surface, "sigma=0.02 ");
    CHECK(candidates(surface, "") == of_made && candidates(copy, "") == of_made);
    CHECK(candidates(surface, "sigma=" + std::to_string(left) + " ") != of_made);
    for (rsc_surface** s : {&surface, &copy}) OK(rsc_surface_destroy(s));
    OK(rsc_case_destroy(&made));
}

// The tip may be anywhere above the surface, its border included, and nowhere beside it: of a map, of given asperities (as far as the
// sphere reaches), of the square of surface%L around or from the origin.
void reach(rsc_contact* contact, double x_min, double x_max, double y_min, double y_max) {
    const double x = 0.4 * x_min + 0.6 * x_max, y = 0.7 * y_min + 0.3 * y_max, lx = 1e-9 * (x_max - x_min), ly = 1e-9 * (y_max - y_min);
    double x0 = 0, y0 = 0;
    for (const auto& [to_x, to_y] : {std::array{x_min, y}, {x_max, y}, {x, y_min}, {x, y_max}}) {
        CHECK(rsc_contact_move_tip(contact, to_x, to_y) == RSC_SUCCESS);
        OK(rsc_contact_tip(contact, &x0, &y0));
        CHECK(x0 == to_x && y0 == to_y);
    }
    for (const auto& [to_x, to_y] : {std::array{x_min - lx, y}, {x_max + lx, y}, {x, y_min - ly}, {x, y_max + ly}}) {
        CHECK(rsc_contact_move_tip(contact, to_x, to_y) == -2);
        CHECK(message().find("is not above the surface") != std::string::npos);
    }
    OK(rsc_contact_tip(contact, &x0, &y0));
    CHECK(x0 == x && y0 == y_max);
}

void places() {
    const Map map;
    rsc_surface* surface = map.take(map.heights([](int i, int j) { return noise(i + 24 * j, 9); }));
    rsc_asperities *on = nullptr, *given = nullptr;
    rsc_contact *contact = nullptr, *copy = nullptr;
    rsc_case* a_case = nullptr;
    double x0 = 0, y0 = 0;
    OK(rsc_asperities_find(&on, surface, nullptr));
    OK(rsc_contact_create_from_case(&contact, on, nullptr));
    OK(rsc_contact_tip(contact, &x0, &y0));
    const double Lx = map.nx * map.dx, Ly = map.ny * map.dy;
    CHECK_CLOSE(x0, map.x0 + 0.5 * (map.nx - 1) * map.dx, 1e-14 * Lx);  // the middle of the points
    CHECK_CLOSE(y0, map.y0 + 0.5 * (map.ny - 1) * map.dy, 1e-14 * Ly);
    reach(contact, map.x0, map.x0 + Lx, map.y0, map.y0 + Ly);
    OK(rsc_contact_copy(&copy, contact));
    reach(copy, map.x0, map.x0 + Lx, map.y0, map.y0 + Ly);
    for (rsc_contact** c : {&contact, &copy}) OK(rsc_contact_destroy(c));
    // Three asperities, 2 by 1, around (2, 0.5): the tip as far from their smallest square as the sphere's radius.
    const double x[] = {1, 3, 2}, y[] = {1, 0.25, 0}, z[] = {0, 0.1, 0.2}, r[] = {0.1, 0.2, 0.3};
    OK(rsc_asperities_take(&given, 3, x, y, z, r, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_contact_create(&contact, given, 1e3, 0.5, 2, 0.5, nullptr));
    reach(contact, 1 - 0.5, 3 + 0.5, 0.5 - 1 - 0.5, 0.5 + 1 + 0.5);
    OK(rsc_contact_destroy(&contact));
    OK(rsc_contact_create_from_case(&contact, given, nullptr));
    OK(rsc_contact_tip(contact, &x0, &y0));
    CHECK(x0 == 2 && y0 == 0.5);
    OK(rsc_contact_destroy(&contact));
    OK(rsc_case_create(&a_case));
    OK(rsc_case_set(a_case, "surface%L", "5.0"));  // [0, 5]^2 holds them
    OK(rsc_contact_create_from_case(&contact, given, a_case));
    OK(rsc_contact_tip(contact, &x0, &y0));
    CHECK(x0 == 2.5 && y0 == 2.5);
    reach(contact, 0, 5, 0, 5);
    OK(rsc_contact_destroy(&contact));
    OK(rsc_case_set(a_case, "surface%L", "2.5"));  // [0, 2.5]^2 does not: a square around their middle
    OK(rsc_contact_create_from_case(&contact, given, a_case));
    OK(rsc_contact_tip(contact, &x0, &y0));
    CHECK(x0 == 2 && y0 == 0.5);
    reach(contact, 0.75, 3.25, -0.75, 1.75);
    OK(rsc_contact_destroy(&contact));
    OK(rsc_case_set(a_case, "surface%L", "1.5"));  // too small
    CHECK(rsc_contact_create_from_case(&contact, given, a_case) == -3 && message().find("the asperities") != std::string::npos);
    OK(rsc_case_destroy(&a_case));
    for (rsc_asperities** a : {&on, &given}) OK(rsc_asperities_destroy(a));
    OK(rsc_surface_destroy(&surface));
}

// Numbers at the bounds are taken, the next ones beyond are not.
void bounds() {
    const double least = 1e-50, most = 1e50, less = least * (1 - 1e-12), more = std::nextafter(most, kInfinity);
    const Values z(12, 0.0);
    rsc_surface* s = nullptr;
    rsc_asperities* a = nullptr;
    rsc_contact* k = nullptr;
    rsc_friction* f = nullptr;
    const auto surface = [&](double dx, double dy, double height) {
        Values heights = z;
        heights[5] = height;
        const std::int32_t code = rsc_surface_take(&s, 4, 3, dx, dy, 0, 0, 1, heights.data());
        OK(rsc_surface_destroy(&s));
        return code;
    };
    for (const double d : {least, most}) CHECK(surface(d, 1, 0) == 0 && surface(1, d, 0) == 0);
    for (const double d : {less, more}) CHECK(surface(d, 1, 0) == -4 && surface(1, d, 0) == -5);
    CHECK(surface(1, 1, most) == 0 && surface(1, 1, -most) == 0 && surface(1, 1, more) == -9 && surface(1, 1, -more) == -9);
    const Values nine(9, 0.0);  // 3 points each way, and no fewer
    for (const int nx : {2, 3})
        for (const int ny : {2, 3}) {
            const std::int32_t code = rsc_surface_take(&s, nx, ny, 1, 1, 0, 0, 0, nine.data());
            CHECK(code == (nx == 2 ? -2 : ny == 2 ? -3 : 0));
            OK(rsc_surface_destroy(&s));
        }
    const auto asperity = [&](double x, double radius, double kappa1, double kappa2, double angle) {
        const std::int32_t code = rsc_asperities_take(&a, 1, &x, &x, &x, &radius, &kappa1, &kappa2, &angle, &angle);
        OK(rsc_asperities_destroy(&a));
        return code;
    };
    CHECK(asperity(most, 1, 1, 1, 0) == 0 && asperity(more, 1, 1, 1, 0) == -3 && asperity(0, least, 1, 1, 0) == 0 &&
          asperity(0, less, 1, 1, 0) == -6);
    CHECK(asperity(0, most, 1, 1, 0) == 0 && asperity(0, more, 1, 1, 0) == -6 && asperity(0, 1, 1, least, 0) == 0 &&
          asperity(0, 1, 1, less, 0) == -8);
    CHECK(asperity(0, 1, 1, 1, 0) == 0 && asperity(0, 1, std::nextafter(1, 0), 1, 0) == -7 && asperity(0, 1, more, 1, 0) == -7 &&
          asperity(0, 1, 1, 1, more) == -9);
    const double zero = 0, one = 1;
    OK(rsc_asperities_take(&a, 1, &zero, &zero, &zero, &one, nullptr, nullptr, nullptr, nullptr));
    const auto contact = [&](double E, double R) {
        const std::int32_t code = rsc_contact_create(&k, a, E, R, 0, 0, nullptr);
        OK(rsc_contact_destroy(&k));
        return code;
    };
    for (const double v : {least, most}) CHECK(contact(v, 1) == 0 && contact(1, v) == 0);
    for (const double v : {less, more}) CHECK(contact(v, 1) == -3 && contact(1, v) == -4);
    CHECK(contact(1, kInfinity) == 0 && contact(kInfinity, 1) == -3);
    OK(rsc_contact_create(&k, a, 1, 1, 0, 0, nullptr));
    const auto friction = [&](double mu, double ratio) {
        const std::int32_t code = rsc_friction_create(&f, k, mu, ratio);
        OK(rsc_friction_destroy(&f));
        return code;
    };
    CHECK(friction(0, 1) == 0 && friction(most, 1) == 0 && friction(more, 1) == -3 && friction(std::nextafter(0, -1), 1) == -3);
    for (const double v : {least, most}) CHECK(friction(1, v) == 0);
    for (const double v : {less, more}) CHECK(friction(1, v) == -4);
    OK(rsc_friction_create(&f, k, 0.5, 1));
    const auto update = [&](double to_z, double x, double y) {
        return rsc_friction_update(f, to_z, x, y, nullptr, nullptr, nullptr, nullptr);
    };
    CHECK(update(most, most, -most) == 0 && update(more, 0, 0) == -2 && update(most, more, 0) == -3 && update(most, 0, -more) == -4);
    // Full slip on first loading: Q = mu N may be asked for, a little more may not.
    double full = 0, slide = 0, limit = 0;
    CHECK(update(-0.01, 0, 0) == 0);
    OK(rsc_friction_full_slip(f, &full, &limit));
    OK(rsc_friction_slide(f, limit, &slide));
    CHECK_RELATIVE(slide, full, 1e-9);
    OK(rsc_friction_slide(f, 0, &slide));
    CHECK(slide == 0);
    CHECK(rsc_friction_slide(f, limit * (1 + 1e-9), &slide) == -2 && rsc_friction_slide(f, -1e-300, &slide) == -2);
    double ratio = 0;
    const double E[] = {1, 2}, at[] = {-1, 0.5}, low[] = {std::nextafter(-1, -2), 0.5}, high[] = {-1, std::nextafter(0.5, 1)};
    OK(rsc_tangential_ratio(E, at, &ratio));
    // 1/G* = 3 (2 (1 - 1))/1 + ...: the first body is rigid in shear.
    CHECK_RELATIVE(ratio, 4 * (2 / (2 * 1.5) / 1.5) * ((1 - 1) / 1 + (1 - 0.25) / 2), 1e-14);
    CHECK(rsc_tangential_ratio(E, low, &ratio) == -2 && rsc_tangential_ratio(E, high, &ratio) == -2);
    OK(rsc_friction_destroy(&f));
    OK(rsc_contact_destroy(&k));
    OK(rsc_asperities_destroy(&a));
    // The last key has a name, the next one has none.
    std::int64_t count = 0;
    char name[60] = "";
    OK(rsc_key_count(&count));
    OK(rsc_key_name(count - 1, name, sizeof name, nullptr));
    CHECK(std::string(name).find('%') != std::string::npos && rsc_key_name(count, name, sizeof name, nullptr) == -1);
}

// After first loading, spots that touch at the stick separation stick, in the circles they have there; shares add up to Q and point along it.
void friction_spots() {
    Values x, y, z, r;
    for (int k = 1; k <= 35; ++k) {
        x.push_back(0.25 * ((k - 1) % 5) + noise(k, 1) / 8);
        y.push_back(0.375 * ((k - 1) / 5) + noise(k, 2) / 8);
        z.push_back(noise(k, 3) / 16);
        r.push_back(0.25 + noise(k, 4) / 4);
    }
    rsc_asperities* a = nullptr;
    rsc_contact* k = nullptr;
    rsc_friction* f = nullptr;
    rsc_case* tight = nullptr;
    OK(rsc_case_create(&tight));
    OK(rsc_case_set(tight, "solver%tolerance", "1e-12"));
    OK(rsc_asperities_take(&a, 35, x.data(), y.data(), z.data(), r.data(), nullptr, nullptr, nullptr, nullptr));
    OK(rsc_contact_create(&k, a, 3e3, 4, 0.6, 1.1, tight));
    OK(rsc_friction_create(&f, k, 0.3125, 0.8125));
    double Q[2] = {}, at = 0, stick = 0, N = 0, lost = 0;
    OK(rsc_friction_update(f, 0, 7, -3, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_friction_update(f, 0, 7.003, -3.004, &N, &Q[0], &Q[1], &lost));
    OK(rsc_friction_state(f, &at, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, &stick));
    CHECK_RELATIVE(stick, 0.8125 / 0.3125 * 0.005, 1e-9);
    CHECK_RELATIVE(Q[1] / Q[0], -4.0 / 3, 1e-9);
    std::int64_t n = 0;
    CHECK(rsc_friction_spots(f, 0, &n, nullptr, nullptr, nullptr, nullptr, nullptr) == -2 &&
          message() == "argument n must be at least the number of spots, " + std::to_string(n));
    const auto size = static_cast<std::size_t>(n);
    std::vector<std::int32_t> which(size), in_contact(size);
    Values radius(size), inner(size), fx(size), fy(size), now(size), force(size), before(35), load(35);
    OK(rsc_friction_spots(f, n, nullptr, which.data(), radius.data(), inner.data(), fx.data(), fy.data()));
    OK(rsc_contact_indent(k, 0, nullptr));
    OK(rsc_contact_spots(k, n, in_contact.data(), force.data(), now.data(), nullptr));
    OK(rsc_contact_indent(k, stick, nullptr));
    OK(rsc_contact_per_asperity(k, 35, load.data(), before.data(), nullptr));
    double sum[2] = {};
    CHECK(which == in_contact && n > 3);
    for (std::size_t i = 0; i < size; ++i) {
        const auto m = static_cast<std::size_t>(which[i]);
        CHECK_RELATIVE(radius[i], now[i], 1e-9);
        CHECK_CLOSE(inner[i], before[m], 1e-7);
        const double share = 0.3125 * (force[i] - load[m]);
        CHECK_CLOSE(fx[i], 0.6 * share, 1e-9 * N);
        CHECK_CLOSE(fy[i], -0.8 * share, 1e-9 * N);
        sum[0] += fx[i], sum[1] += fy[i];
    }
    for (int i : {0, 1}) CHECK_RELATIVE(sum[i], Q[i], 1e-9);
    OK(rsc_friction_destroy(&f));
    OK(rsc_contact_destroy(&k));
    OK(rsc_asperities_destroy(&a));
    OK(rsc_case_destroy(&tight));
}

}  // namespace

TESTS {
    const Folder folder;
    rms_height();
    rms_of_synthesized();
    places();
    bounds();
    friction_spots();
}
