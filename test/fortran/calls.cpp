// Calls every function of rsc.h and prints every value it gives back, bit by bit, with every status that is not 0 and its message:
//     scene function.argument values
// calls.f90, calls77.f and test/python/calls.py do the same through rsc.f90, rsc77.c and rsc.py; compare_calls.py compares them. No two
// lengths, moduli, places or numbers of points are alike, so that nothing can be taken for something else unseen. Input numbers are
// fractions of 64, which every language writes alike.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "rsc.h"

namespace {

using Reals = std::vector<double>;
using Numbers = std::vector<std::int32_t>;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
const char* scene = "";

void put_values(double v) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    std::printf(" %016llX", static_cast<unsigned long long>(bits));
}
void put_values(std::int64_t v) { std::printf(" %lld", static_cast<long long>(v)); }
void put_values(std::int32_t v) { std::printf(" %lld", static_cast<long long>(v)); }
void put_values(std::string text) {
    for (char& c : text)
        if (c == '\n') c = '|';
    while (!text.empty() && text.back() == ' ') text.pop_back();
    std::printf(" %s", text.c_str());
}
template <class T>
void put_values(const std::vector<T>& values) {
    for (const T v : values) put_values(v);
}
template <class T>
void put(const char* what, const T& value) {
    std::printf("%s %s", scene, what);
    put_values(value);
    std::printf("\n");
}

template <class Call>
std::string text(Call&& call) {
    char buffer[20000] = "";
    std::int64_t length = -1;
    if (call(buffer, std::int64_t{sizeof buffer}, &length) != RSC_SUCCESS || length != static_cast<std::int64_t>(std::strlen(buffer)))
        return "<failed>";
    return buffer;
}
std::string message() { return text(rsc_message); }

// Success is not told, everything else is.
void told(const char* function, std::int32_t status) {
    if (status != RSC_SUCCESS) put((std::string(function) + ".code").c_str(), std::to_string(status) + " " + message());
}
#define CALL(function, ...) told(#function, function(__VA_ARGS__))

// Numbers below 1 that look like noise: k from 1, another sequence for every s.
double noise(int k, int s) { return ((k * k * s + 29 * k + 7 * s) % 61) / 64.0; }

rsc_case* read_case(const char* namelist) {
    rsc_case* made = nullptr;
    CALL(rsc_case_create, &made);
    CALL(rsc_case_read, made, namelist);
    return made;
}

rsc_asperities* take_list(bool bent) {
    Reals x, y, z, radius, kappa1, kappa2, angle, biharmonic;
    for (int k = 1; k <= 35; ++k) {
        x.push_back(-0.25 + 0.25 * ((k - 1) % 5) + noise(k, 1) / 8);
        y.push_back(0.5 + 0.375 * ((k - 1) / 5) + noise(k, 2) / 8);
        z.push_back(noise(k, 3) / 16);
        radius.push_back(0.25 + noise(k, 4) / 4);
        kappa2.push_back(1.5 + noise(k, 5));
        kappa1.push_back(kappa2.back() + 0.25 + noise(k, 6));
        angle.push_back(noise(k, 7) - 0.5);
        biharmonic.push_back(400 + 256 * noise(k, 8));
    }
    rsc_asperities* made = nullptr;
    if (bent)
        CALL(rsc_asperities_take, &made, 35, x.data(), y.data(), z.data(), radius.data(), kappa1.data(), kappa2.data(), angle.data(),
             biharmonic.data());
    else
        CALL(rsc_asperities_take, &made, 35, x.data(), y.data(), z.data(), radius.data(), nullptr, nullptr, nullptr, nullptr);
    return made;
}

void read(const rsc_asperities* asperities, bool curved) {
    std::int64_t n = 0;
    CALL(rsc_asperities_count, asperities, &n);
    put("rsc_asperities_count.n", n);
    Reals x(static_cast<std::size_t>(n)), y(x), z(x), radius(x);
    CALL(rsc_asperities_get, asperities, n, x.data(), y.data(), z.data(), radius.data());
    put("rsc_asperities_get.x", x);
    put("rsc_asperities_get.y", y);
    put("rsc_asperities_get.z", z);
    put("rsc_asperities_get.radius", radius);
    const std::int32_t code = rsc_asperities_curvatures(asperities, n, x.data(), y.data(), z.data());
    told("rsc_asperities_curvatures", code);
    if (!curved) return;
    put("rsc_asperities_curvatures.kappa1", x);
    put("rsc_asperities_curvatures.kappa2", y);
    put("rsc_asperities_curvatures.angle", z);
}

void read(const rsc_surface* surface) {
    std::int64_t nx = 0, ny = 0;
    double dx = 0, dy = 0, x0 = 0, y0 = 0, m0 = 0, m2 = 0, m4 = 0;
    std::int32_t periodic = -1;
    CALL(rsc_surface_grid, surface, &nx, &ny, &dx, &dy, &x0, &y0, &periodic);
    put("rsc_surface_grid.nx", nx);
    put("rsc_surface_grid.ny", ny);
    put("rsc_surface_grid.dx", dx);
    put("rsc_surface_grid.dy", dy);
    put("rsc_surface_grid.x0", x0);
    put("rsc_surface_grid.y0", y0);
    put("rsc_surface_grid.periodic", periodic);
    Reals z(static_cast<std::size_t>(nx * ny));
    CALL(rsc_surface_heights, surface, nx * ny, z.data());
    put("rsc_surface_heights.heights", z);
    CALL(rsc_surface_moments, surface, &m0, &m2, &m4);
    put("rsc_surface_moments.m0", m0);
    put("rsc_surface_moments.m2", m2);
    put("rsc_surface_moments.m4", m4);
}

void tip(const rsc_contact* contact) {
    double x0 = 0, y0 = 0, touch = 0;
    CALL(rsc_contact_tip, contact, &x0, &y0);
    put("rsc_contact_tip.x0", x0);
    put("rsc_contact_tip.y0", y0);
    CALL(rsc_contact_first_touch, contact, &touch);
    put("rsc_contact_first_touch.separation", touch);
}

// Everything that can be asked of a level.
void read(rsc_contact* contact, bool elements) {
    double Z = 0, N = 0, A = 0, residual = 0, dN = 0, W = 0, fx = 0, fy = 0, value = 0;
    std::int64_t n = 0, candidates = 0, iterations = 0, pairs = 0, large = 0, beyond = 0, edge = 0;
    std::int32_t status = -1;
    CALL(rsc_contact_result, contact, &Z, &N, &A, &n);
    put("rsc_contact_result.separation", Z);
    put("rsc_contact_result.force", N);
    put("rsc_contact_result.area", A);
    put("rsc_contact_result.contacts", n);
    CALL(rsc_contact_level, contact, &status, &candidates, &iterations, &pairs, &residual);
    put("rsc_contact_level.level_status", status);
    put("rsc_contact_level.candidates", candidates);
    put("rsc_contact_level.iterations", iterations);
    put("rsc_contact_level.overlapping_pairs", pairs);
    put("rsc_contact_level.residual", residual);
    CALL(rsc_contact_stiffness, contact, &dN);
    put("rsc_contact_stiffness.stiffness", dN);
    CALL(rsc_contact_energy, contact, &W);
    put("rsc_contact_energy.energy", W);
    CALL(rsc_contact_answer, contact, &Z, &N, &dN, &A, &W, &fx, &fy, &status, &n, &pairs, &large, &beyond, &edge);
    put("rsc_contact_answer.separation", Z);
    put("rsc_contact_answer.force", N);
    put("rsc_contact_answer.stiffness", dN);
    put("rsc_contact_answer.area", A);
    put("rsc_contact_answer.energy", W);
    put("rsc_contact_answer.lateral_x", fx);
    put("rsc_contact_answer.lateral_y", fy);
    put("rsc_contact_answer.level_status", status);
    put("rsc_contact_answer.contacts", n);
    put("rsc_contact_answer.overlapping_pairs", pairs);
    put("rsc_contact_answer.large_contacts", large);
    put("rsc_contact_answer.beyond_law", beyond);
    put("rsc_contact_answer.edge_contacts", edge);
    for (const char* name : {"moment_x", "moment_y", "nominal_area", "products"}) {
        CALL(rsc_contact_value, contact, name, &value);
        put("rsc_contact_value.value", value);
    }
    const auto size = static_cast<std::size_t>(n);
    Numbers which(size);
    Reals force(size), radius(size), penetration(size), deflection(3);
    CALL(rsc_contact_spots, contact, n, which.data(), force.data(), radius.data(), penetration.data());
    put("rsc_contact_spots.asperity", which);
    put("rsc_contact_spots.force", force);
    put("rsc_contact_spots.radius", radius);
    put("rsc_contact_spots.penetration", penetration);
    if (!elements) {
        Reals all(35), radii(35), depths(35);
        CALL(rsc_contact_per_asperity, contact, 35, all.data(), radii.data(), depths.data());
        put("rsc_contact_per_asperity.force", all);
        put("rsc_contact_per_asperity.radius", radii);
        put("rsc_contact_per_asperity.penetration", depths);
    }
    const double x[] = {0.25, 0.375, 0.75}, y[] = {1.25, 0.875, 1.0};
    CALL(rsc_contact_deflection, contact, 3, x, y, deflection.data());
    put("rsc_contact_deflection.deflection", deflection);
}

void indent(rsc_contact* contact, double separation) {
    double force = 7;
    CALL(rsc_contact_indent, contact, separation, &force);
    put("rsc_contact_indent.force", force);
}
void press(rsc_contact* contact, double force) {
    double separation = 7;
    CALL(rsc_contact_press, contact, force, &separation);
    put("rsc_contact_press.separation", separation);
}

void texts() {
    scene = "texts";
    put("rsc_version.buffer", text(rsc_version));
    std::int64_t count = 0;
    CALL(rsc_key_count, &count);
    put("rsc_key_count.count", count);
    for (std::int64_t k = 0; k < count; ++k)
        put("rsc_key_name.buffer", text([k](char* b, std::int64_t n, std::int64_t* l) { return rsc_key_name(k, b, n, l); }));
    for (const std::int32_t status : {-3, 0, 1, 2, 3, 4, 5, 6})
        put("rsc_status_text.buffer",
            text([status](char* b, std::int64_t n, std::int64_t* l) { return rsc_status_text(status, b, n, l); }));
}

void get(const rsc_case* a_case, const char* name) {
    const std::string value = text([&](char* b, std::int64_t n, std::int64_t* l) { return rsc_case_get(a_case, name, b, n, l); });
    put("rsc_case_get.buffer", value);
}
void whole(const rsc_case* a_case) {
    put("rsc_case_text.buffer", text([&](char* b, std::int64_t n, std::int64_t* l) { return rsc_case_text(a_case, b, n, l); }));
}

void cases() {
    scene = "cases";
    rsc_case *a_case = nullptr, *other = nullptr;
    CALL(rsc_case_create, &a_case);
    const char* const keys[][2] = {{"surface%sigma", "0.30000000000000004"},
                                   {"surface%hurst", "0.1"},
                                   {"surface%n", "4096"},
                                   {"run%seed", "9000000000"},
                                   {"surface%plateau", ".true."},
                                   {"solids%E", "0.1, 0.7"},
                                   {"solids%nu", "0.1, 0.3"},
                                   {"indentation%levels", "3 2 1"},
                                   {"solver%method", "'direct'"},
                                   {"run%title", "'it''s'"},
                                   {"indentation%centre(2)", "0.625"},
                                   {"output%heights", ".false."}};
    for (const auto& [name, value] : keys) {
        CALL(rsc_case_set, a_case, name, value);
        get(a_case, name);
    }
    CALL(rsc_case_set, a_case, "surface%file", ("'" + std::string(4096, 'f') + "'").c_str());
    get(a_case, "surface%file");
    whole(a_case);
    CALL(rsc_case_copy, &other, a_case);
    CALL(rsc_case_set, a_case, "surface%sigma", "0.03125");
    get(other, "surface%sigma");
    CALL(rsc_case_set, a_case, "surface%simga", "1");
    CALL(rsc_case_set, a_case, "surface%sigma", "-1");
    char nothing[8];
    std::int64_t length = 0;
    CALL(rsc_case_get, a_case, "surface%simga", nothing, 8, &length);
    CALL(rsc_case_read, a_case, "&surface n=3 /");
    CALL(rsc_case_read_file, a_case, "no/such/file.nml");
    get(a_case, "surface%sigma");
    CALL(rsc_case_read, a_case, "&surface n=128, L_lambda_l=4, L_lambda_s=32, sigma=0.25 / &solids nu=0.1, 0.2 /");
    whole(a_case);
    CALL(rsc_case_read_file, other, "calls.nml");
    whole(other);
    std::int64_t failed = -7;
    CALL(rsc_case_run, other, &failed);
    put("rsc_case_run.failed_levels", failed);
    CALL(rsc_case_set, other, "surface%n", "16");
    CALL(rsc_case_run, other, nullptr);
    CALL(rsc_case_destroy, &a_case);
    CALL(rsc_case_destroy, &other);
}

void surfaces() {
    scene = "surfaces";
    Reals z;
    for (int j = 1; j <= 7; ++j)
        for (int i = 1; i <= 9; ++i) z.push_back(noise(i + 9 * j, 9) / 8 + (i * i - 2 * i * j) / 256.0 + j / 64.0);
    rsc_case* a_case = read_case("&asperities curvature='algebraic' /");
    rsc_surface *surface = nullptr, *other = nullptr;
    rsc_asperities* found = nullptr;
    for (const std::int32_t periodic : {1, 0}) {
        CALL(rsc_surface_take, &surface, 9, 7, 0.125, 0.1875, -0.5, 0.75, periodic, z.data());
        read(surface);
        for (rsc_case* c : {static_cast<rsc_case*>(nullptr), a_case}) {
            CALL(rsc_asperities_find, &found, surface, c);
            read(found, true);
            CALL(rsc_asperities_destroy, &found);
        }
        if (periodic) CALL(rsc_surface_destroy, &surface);
    }
    CALL(rsc_surface_copy, &other, surface);
    scene = "forms";
    for (const char* how : {"none", "mean", "plane", "quadratic", "sphere", "cubic"}) {
        double rms = 7;
        CALL(rsc_surface_detrend, surface, how, &rms);
        if (std::strcmp(how, "cubic") != 0) put("rsc_surface_detrend.rms", rms);
    }
    read(surface);
    CALL(rsc_surface_filter, surface, 0.3125);
    CALL(rsc_surface_filter, surface, -1.0);
    read(surface);
    read(other);
    CALL(rsc_surface_destroy, &surface);
    CALL(rsc_surface_destroy, &other);
    scene = "surfaces";
    CALL(rsc_surface_take, &surface, 9, 7, 0.0, 0.1875, -0.5, 0.75, 0, z.data());
    CALL(rsc_surface_take, &surface, 9, 7, 0.125, -1.0, -0.5, 0.75, 0, z.data());
    CALL(rsc_surface_take, &surface, 9, 7, 0.125, 0.1875, kNan, 0.75, 0, z.data());
    CALL(rsc_surface_take, &surface, 9, 7, 0.125, 0.1875, -0.5, kInfinity, 0, z.data());
    z[5] = kNan;
    CALL(rsc_surface_take, &surface, 9, 7, 0.125, 0.1875, -0.5, 0.75, 0, z.data());
    CALL(rsc_case_destroy, &a_case);
}

void synthetic() {
    scene = "synthetic";
    rsc_case* a_case = read_case(
        "&surface n=64, L=1.5, L_lambda_l=2, L_lambda_s=8, sigma=0.03125 / &run seed=5 / "
        "&solids E=1e3, 3e3  nu=0.125, 0.375  R=3.0, 5.0  resistivity=1e-5, 3e-5 / &indentation centre=0.625, 0.875 /");
    rsc_surface* surface = nullptr;
    rsc_asperities *made = nullptr, *other = nullptr;
    rsc_contact* contact = nullptr;
    for (const std::int64_t realization : {3, 1}) {
        CALL(rsc_surface_synthesize, &surface, a_case, realization);
        read(surface);
        CALL(rsc_asperities_make, &made, a_case, realization);
        read(made, true);
        if (realization == 3) {
            CALL(rsc_surface_destroy, &surface);
            CALL(rsc_asperities_destroy, &made);
        }
    }
    CALL(rsc_asperities_copy, &other, made);
    read(other, true);
    CALL(rsc_contact_create_from_case, &contact, other, a_case);
    tip(contact);
    indent(contact, 0.03125);
    read(contact, true);
    double resistance = 0;
    CALL(rsc_contact_value, contact, "resistance", &resistance);
    put("rsc_contact_value.value", resistance);
    CALL(rsc_contact_destroy, &contact);
    CALL(rsc_case_set, a_case, "surface%n", "16");
    CALL(rsc_surface_synthesize, &surface, a_case, 1);
    CALL(rsc_asperities_make, &made, a_case, 1);
    CALL(rsc_case_set, a_case, "solver%model", "'elements'");
    CALL(rsc_contact_create_from_case, &contact, other, a_case);
    CALL(rsc_asperities_destroy, &other);
    CALL(rsc_case_destroy, &a_case);
}

void list() {
    scene = "list";
    rsc_case* a_case = read_case("&solver tolerance=1e-9 / &surface L=4.0 /");
    rsc_asperities *asperities = take_list(false), *again = nullptr;
    rsc_contact *contact = nullptr, *other = nullptr;
    read(asperities, false);
    CALL(rsc_contact_create, &contact, asperities, 3e3, 4.0, 0.4375, 1.25, a_case);
    tip(contact);
    CALL(rsc_contact_result, contact, nullptr, nullptr, nullptr, nullptr);
    CALL(rsc_contact_press, contact, -1.0, nullptr);
    indent(contact, 0.0);
    read(contact, false);
    press(contact, 8.0);
    read(contact, false);
    CALL(rsc_contact_move_tip, contact, 0.5, 0.9375);
    tip(contact);
    read(contact, false);
    CALL(rsc_contact_copy, &other, contact);
    tip(other);
    CALL(rsc_contact_energy, other, nullptr);
    indent(contact, -0.015625);
    read(contact, false);
    indent(other, -0.015625);
    read(other, false);
    // Refused, and nothing changed.
    CALL(rsc_contact_indent, contact, kNan, nullptr);
    CALL(rsc_contact_press, contact, -1.0, nullptr);
    CALL(rsc_contact_move_tip, contact, 1e3, 1.0);
    CALL(rsc_contact_move_tip, contact, kNan, 1.0);
    CALL(rsc_contact_move_tip, contact, 1.0, kInfinity);
    const double x[] = {0.25, kNan}, y[] = {0.5, 0.75};
    double w[2];
    CALL(rsc_contact_deflection, contact, 2, x, y, w);
    CALL(rsc_contact_deflection, contact, 2, y, x, w);
    double value = 0;
    CALL(rsc_contact_value, contact, "nothing", &value);
    tip(contact);
    read(contact, false);
    CALL(rsc_contact_destroy, &contact);
    CALL(rsc_contact_create, &contact, asperities, -1.0, 4.0, 0.5, 1.0, a_case);
    CALL(rsc_contact_create, &contact, asperities, 3e3, 0.0, 0.5, 1.0, a_case);
    CALL(rsc_contact_create, &contact, asperities, 3e3, 4.0, kNan, 1.0, a_case);
    CALL(rsc_contact_create, &contact, asperities, 3e3, 4.0, 0.5, kNan, a_case);
    CALL(rsc_case_set, a_case, "solver%model", "'elements'");
    CALL(rsc_contact_create, &contact, asperities, 3e3, 4.0, 0.5, 1.0, a_case);
    const double one[] = {1.0}, two[] = {0.5}, zero[] = {0.0};
    CALL(rsc_asperities_take, &again, 1, one, two, zero, zero, nullptr, nullptr, nullptr, nullptr);
    const double twice[] = {1.0, 1.0};
    CALL(rsc_asperities_take, &again, 2, twice, twice, twice, twice, nullptr, nullptr, nullptr, nullptr);
    CALL(rsc_contact_destroy, &other);
    CALL(rsc_asperities_destroy, &asperities);
    CALL(rsc_case_destroy, &a_case);
}

// A contact in a file, its tip moved since the level it holds.
void kept() {
    scene = "kept";
    rsc_asperities *asperities = take_list(false), *again = take_list(true);
    rsc_contact* contact = nullptr;
    CALL(rsc_contact_create, &contact, asperities, 3e3, 4.0, 0.4375, 1.25, nullptr);
    indent(contact, 0.0);
    CALL(rsc_contact_move_tip, contact, 0.5, 0.9375);
    CALL(rsc_contact_save, contact, "contact.kept");
    CALL(rsc_contact_destroy, &contact);
    CALL(rsc_contact_restore, &contact, asperities, "contact.kept");
    tip(contact);
    read(contact, false);
    indent(contact, -0.015625);
    read(contact, false);
    CALL(rsc_contact_save, contact, "no/folder/contact.kept");
    CALL(rsc_contact_destroy, &contact);
    CALL(rsc_contact_restore, &contact, asperities, "nothing.kept");
    CALL(rsc_contact_restore, &contact, again, "contact.kept");
    CALL(rsc_asperities_destroy, &again);
    CALL(rsc_asperities_destroy, &asperities);
}

void curved() {
    scene = "curved";
    rsc_asperities* refused = nullptr;
    const double one[] = {1.0}, two[] = {0.5}, zero[] = {0.0};
    CALL(rsc_asperities_take, &refused, 1, one, two, zero, one, two, one, zero, nullptr);
    CALL(rsc_asperities_take, &refused, 1, one, two, zero, one, one, zero, zero, nullptr);
    CALL(rsc_asperities_take, &refused, 1, one, two, zero, one, one, nullptr, zero, nullptr);
    rsc_case* a_case = read_case("&asperities law='fourth_order' / &surface L=4.0 /");
    rsc_asperities* asperities = take_list(true);
    rsc_contact* contact = nullptr;
    read(asperities, true);
    CALL(rsc_contact_create, &contact, asperities, 3e3, kInfinity, 0.4375, 1.25, a_case);
    indent(contact, 0.015625);
    read(contact, false);
    CALL(rsc_contact_destroy, &contact);
    // Deep and at the border: spots of every kind, no two numbers alike.
    rsc_case* bent = read_case("&asperities law='fourth_order' / &surface L=2.5 /");
    CALL(rsc_contact_create, &contact, asperities, 3e3, 4.0, 0.4375, 1.25, bent);
    CALL(rsc_case_destroy, &bent);
    indent(contact, -0.28125);
    read(contact, false);
    CALL(rsc_contact_destroy, &contact);
    // Those that yield: what was pressed before is remembered.
    rsc_case* soft = read_case("&solids hardness=512.0 / &surface L=4.0 /");
    CALL(rsc_contact_create_from_case, &contact, asperities, soft);
    for (const double separation : {0.015625, 0.0, 0.0078125}) {
        indent(contact, separation);
        for (const char* name : {"plastic_contacts", "plastic_work"}) {
            double value = 0;
            CALL(rsc_contact_value, contact, name, &value);
            put("rsc_contact_value.value", value);
        }
    }
    CALL(rsc_contact_save, contact, "soft.kept");
    rsc_friction* friction = nullptr;
    CALL(rsc_friction_create, &friction, contact, 0.3125, 0.8125);
    CALL(rsc_contact_destroy, &contact);
    CALL(rsc_asperities_destroy, &asperities);
    CALL(rsc_case_destroy, &soft);
    CALL(rsc_case_destroy, &a_case);
}

// Two flats, by asperities and by elements.
void flats() {
    for (const bool elements : {false, true}) {
        scene = elements ? "elements" : "flats";
        rsc_case* a_case = read_case(
            "&surface L=2, n=64, L_lambda_l=2, L_lambda_s=8, sigma=0.015625 / &solver tolerance=1e-9 / "
            "&solids E=3, 5  nu=0.125, 0.25  R=Infinity, Infinity / &indentation boundary='periodic' /");
        if (elements) CALL(rsc_case_set, a_case, "solver%model", "'elements'");
        rsc_surface* surface = nullptr;
        rsc_asperities* on = nullptr;
        rsc_contact* contact = nullptr;
        CALL(rsc_surface_synthesize, &surface, a_case, 2);
        CALL(rsc_asperities_find, &on, surface, a_case);
        read(on, !elements);
        CALL(rsc_contact_create_from_case, &contact, on, a_case);
        tip(contact);
        press(contact, 0.0625);
        read(contact, true);
        if (elements) {
            CALL(rsc_contact_per_asperity, contact, 0, nullptr, nullptr, nullptr);
            CALL(rsc_contact_save, contact, "elements.kept");
        }
        CALL(rsc_contact_destroy, &contact);
        CALL(rsc_asperities_destroy, &on);
        CALL(rsc_surface_destroy, &surface);
        CALL(rsc_case_destroy, &a_case);
    }
}

// The solver is stopped before its tolerance: told, and the numbers are there.
void unfinished() {
    scene = "unfinished";
    rsc_case* a_case = read_case("&solver max_iterations=1, tolerance=1e-14 /");
    rsc_asperities* asperities = take_list(false);
    rsc_contact* contact = nullptr;
    rsc_friction* friction = nullptr;
    CALL(rsc_contact_create, &contact, asperities, 3e3, 4.0, 0.4375, 1.25, a_case);
    indent(contact, 0.0);
    read(contact, false);
    press(contact, 8.0);
    read(contact, false);
    CALL(rsc_case_set, a_case, "solids%friction", "0.25");
    CALL(rsc_friction_create_from_case, &friction, contact, a_case);
    double N = 0, fx = 0, fy = 0, lost = 0;
    CALL(rsc_friction_update, friction, 0.0, 0.5, 0.25, &N, &fx, &fy, &lost);
    put("rsc_friction_update.force", N);
    put("rsc_friction_update.force_x", fx);
    put("rsc_friction_update.force_y", fy);
    put("rsc_friction_update.lost", lost);
    CALL(rsc_friction_destroy, &friction);
    CALL(rsc_contact_destroy, &contact);
    CALL(rsc_asperities_destroy, &asperities);
    CALL(rsc_case_destroy, &a_case);
}

void many() {
    scene = "many";
    rsc_case* few = read_case("&solver max_iterations=1, tolerance=1e-14 /");
    rsc_asperities* asperities = take_list(false);
    rsc_contact* contacts[3] = {};
    for (int k = 0; k < 3; ++k)
        CALL(rsc_contact_create, &contacts[k], asperities, 3e3, 4.0, 0.375 + 0.125 * k, 1.25 - 0.0625 * k, k == 1 ? few : nullptr);
    Reals Z(3, 7.0), N(3, 7.0);
    Numbers status(3, 7);
    const double separations[] = {0.0, 0.015625, -0.015625}, forces[] = {4.0, 6.0, 9.0}, bad[] = {5.0, -1.0, 7.0};
    CALL(rsc_contacts_indent, 3, contacts, separations, N.data(), status.data(), 2);
    put("rsc_contacts_indent.force", N);
    put("rsc_contacts_indent.status", status);
    CALL(rsc_contacts_press, 3, contacts, forces, Z.data(), status.data(), 2);
    put("rsc_contacts_press.separation", Z);
    put("rsc_contacts_press.status", status);
    CALL(rsc_contacts_press, 3, contacts, bad, nullptr, nullptr, 1);
    scene = "many_refused";
    Z.assign(3, 7.0);
    CALL(rsc_contacts_press, 3, contacts, bad, Z.data(), status.data(), 1);
    put("rsc_contacts_press.separation", Z);
    put("rsc_contacts_press.status", status);
    for (rsc_contact*& contact : contacts) CALL(rsc_contact_destroy, &contact);
    CALL(rsc_asperities_destroy, &asperities);
    CALL(rsc_case_destroy, &few);
}

void state(const rsc_friction* friction) {
    double at = 0, x = 0, y = 0, N = 0, fx = 0, fy = 0, W = 0, V = 0, lost = 0, stick = 0;
    CALL(rsc_friction_state, friction, &at, &x, &y, &N, &fx, &fy, &W, &V, &lost, &stick);
    put("rsc_friction_state.separation", at);
    put("rsc_friction_state.x", x);
    put("rsc_friction_state.y", y);
    put("rsc_friction_state.force", N);
    put("rsc_friction_state.force_x", fx);
    put("rsc_friction_state.force_y", fy);
    put("rsc_friction_state.energy", W);
    put("rsc_friction_state.tangential_energy", V);
    put("rsc_friction_state.lost", lost);
    put("rsc_friction_state.stick_separation", stick);
}

void update(rsc_friction* friction, double separation, double x, double y) {
    double N = 0, fx = 0, fy = 0, lost = 0;
    CALL(rsc_friction_update, friction, separation, x, y, &N, &fx, &fy, &lost);
    put("rsc_friction_update.force", N);
    put("rsc_friction_update.force_x", fx);
    put("rsc_friction_update.force_y", fy);
    put("rsc_friction_update.lost", lost);
}

void read(rsc_friction* friction) {
    state(friction);
    double xx = 0, xy = 0, yx = 0, yy = 0, slide = 0, most = 0;
    CALL(rsc_friction_stiffness, friction, &xx, &xy, &yx, &yy);
    put("rsc_friction_stiffness.xx", xx);
    put("rsc_friction_stiffness.xy", xy);
    put("rsc_friction_stiffness.yx", yx);
    put("rsc_friction_stiffness.yy", yy);
    CALL(rsc_friction_full_slip, friction, &slide, &most);
    put("rsc_friction_full_slip.slide", slide);
    put("rsc_friction_full_slip.force", most);
    const double slides[] = {0.0, 0.00390625, 0.0078125};
    Reals Q(3), stick(3);
    CALL(rsc_friction_first_loading, friction, 3, slides, Q.data(), stick.data());
    put("rsc_friction_first_loading.force", Q);
    put("rsc_friction_first_loading.stick_separation", stick);
    CALL(rsc_friction_slide, friction, 1.25, &slide);
    put("rsc_friction_slide.slide", slide);
    std::int64_t n = 0;
    (void)rsc_friction_spots(friction, 0, &n, nullptr, nullptr, nullptr, nullptr, nullptr);
    const auto size = static_cast<std::size_t>(n);
    Numbers which(size);
    Reals radius(size), inner(size), fx(size), fy(size);
    CALL(rsc_friction_spots, friction, n, &n, which.data(), radius.data(), inner.data(), fx.data(), fy.data());
    put("rsc_friction_spots.asperity", which);
    put("rsc_friction_spots.radius", radius);
    put("rsc_friction_spots.stick_radius", inner);
    put("rsc_friction_spots.force_x", fx);
    put("rsc_friction_spots.force_y", fy);
}

void frictions() {
    scene = "friction";
    const double E[] = {1e3, 3e3}, nu[] = {0.125, 0.375}, wrong[] = {0.125, 0.625}, rigid[] = {kInfinity, kInfinity};
    double ratio = 0, slide = 0;
    CALL(rsc_tangential_ratio, E, nu, &ratio);
    put("rsc_tangential_ratio.ratio", ratio);
    CALL(rsc_tangential_ratio, E, wrong, &ratio);
    CALL(rsc_tangential_ratio, rigid, nu, &ratio);
    rsc_asperities* asperities = take_list(false);
    rsc_contact* contact = nullptr;
    rsc_friction *friction = nullptr, *other = nullptr;
    CALL(rsc_contact_create, &contact, asperities, 3e3, 4.0, 0.4375, 1.25, nullptr);
    CALL(rsc_friction_create, &friction, contact, -1.0, 0.8125);
    CALL(rsc_friction_create, &friction, contact, 0.3125, 0.0);
    CALL(rsc_friction_create, &friction, contact, 0.3125, 0.8125);
    CALL(rsc_friction_state, friction, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
    update(friction, 0.015625, 0.5, 0.25);
    update(friction, 0.0, 0.501953125, 0.25);
    update(friction, 0.00390625, 0.5029296875, 0.251953125);
    read(friction);
    CALL(rsc_friction_commit, friction);
    update(friction, 0.0, 0.5, 0.25390625);
    read(friction);
    CALL(rsc_friction_copy, &other, friction);
    CALL(rsc_friction_rollback, friction);
    state(friction);
    state(other);
    CALL(rsc_friction_save, other, "friction.kept");
    update(other, 0.001953125, 0.515625, 0.25);
    read(other);
    CALL(rsc_friction_destroy, &other);
    CALL(rsc_friction_restore, &other, asperities, "friction.kept");
    state(other);
    CALL(rsc_friction_rollback, other);
    state(other);
    CALL(rsc_friction_update, friction, kNan, 0.5, 0.25, nullptr, nullptr, nullptr, nullptr);
    CALL(rsc_friction_update, friction, 0.0, kNan, 0.25, nullptr, nullptr, nullptr, nullptr);
    CALL(rsc_friction_update, friction, 0.0, 0.5, kNan, nullptr, nullptr, nullptr, nullptr);
    CALL(rsc_friction_slide, friction, 1e6, &slide);
    const double back[] = {-1.0};
    CALL(rsc_friction_first_loading, friction, 1, back, &slide, nullptr);
    state(friction);
    CALL(rsc_friction_save, friction, "no/folder/friction.kept");
    CALL(rsc_friction_destroy, &friction);
    CALL(rsc_friction_restore, &friction, asperities, "nothing.kept");
    scene = "friction_case";
    rsc_case* a_case = read_case("&solids E=1e3, 3e3  nu=0.125, 0.375  friction=0.1875 /");
    CALL(rsc_friction_create_from_case, &friction, contact, a_case);
    CALL(rsc_contact_destroy, &contact);
    update(friction, 0.0, 0.5, 0.25);
    update(friction, 0.0, 0.501953125, 0.2490234375);
    CALL(rsc_friction_commit, friction);
    update(friction, 0.00390625, 0.53125, 0.2490234375);
    CALL(rsc_friction_rollback, friction);
    update(friction, 0.00390625, 0.5, 0.2490234375);
    CALL(rsc_friction_destroy, &friction);
    CALL(rsc_friction_destroy, &other);
    CALL(rsc_asperities_destroy, &asperities);
    CALL(rsc_case_destroy, &a_case);
}

}  // namespace

int main() {
    texts();
    cases();
    surfaces();
    synthetic();
    list();
    kept();
    curved();
    flats();
    unfinished();
    many();
    frictions();
    return 0;
}
