// What a run's file says of stiffness, energy, lateral force, conductance and friction, worked out here from its contacts, from levels
// beside each other, and from a second run.
#include <netcdf.h>

#include <cmath>
#include <string>
#include <vector>

#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "error.hpp"
#include "result_reader.hpp"
#include "run/run.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;

namespace {

using Vector = std::vector<double>;

const std::string kCase =
    "&run seed = 5 / &surface n = 256, L_lambda_l = 8, L_lambda_s = 64, sigma = 1.0e-2 /\n"
    "&solids E = 80e3, 200e3  nu = 0.35, 0.3  R = Infinity, 2.5  resistivity = 2.0e-5, 1.0e-5 /\n"
    "&indentation centre = 0.4, 0.55, unit = 'length' / &solver tolerance = 1e-12 /\n";

void run(const std::string& more, const std::string& file) {
    Case c = read_case_text(kCase, "case.nml").settings;
    c.output.file = file;
    for (std::size_t at = 0; at < more.size();) {  // "key=value;key=value;"
        const auto equals = more.find('=', at), end = more.find(';', at);
        set_key(c, more.substr(at, equals - at), more.substr(equals + 1, end - equals - 1));
        at = end + 1;
    }
    CHECK(run_case(c, {}) == 0);
}

// Forces point to the centre of the sphere; derivatives by central differences of levels 2e-7 apart.
void answers(const std::string& folder) {
    run("indentation%levels=5.0e-2, 1.0e-2, 0.99999e-2, 1.00001e-2;", folder + "/answers.nc");
    const Reader file(folder + "/answers.nc");
    CHECK(!file.has("tangential_force"));
    CHECK(file.dimensions("lateral_force") == (std::vector<std::string>{"realization", "step", "component"}));
    const double x0 = 0.4, y0 = 0.55, R = 2.5, E = file.values("e_star")[0];
    const Vector N = file.values("force"), S = file.values("stiffness"), W = file.values("energy"), Z = file.values("separation");
    const Vector F = file.values("lateral_force"), M = file.values("moment"), length = file.values("conductance_length");
    const Vector resistance = file.values("resistance");
    const Vector start = file.values("contact_start"), count = file.values("contact_count"), which = file.values("contact_asperity");
    const Vector f = file.values("contact_force"), x = file.values("asperity_x"), y = file.values("asperity_y");
    CHECK(N[0] == 0 && S[0] == 0 && W[0] == 0 && F[0] == 0 && M[1] == 0 && length[0] == 0 && resistance[0] == NC_FILL_DOUBLE);
    for (std::size_t s = 1; s < 4; ++s) {
        CHECK(count[s] > 10);
        double Fx = 0, Fy = 0, Mx = 0, My = 0;
        for (auto k = static_cast<std::size_t>(start[s] - 1); k < static_cast<std::size_t>(start[s] - 1 + count[s]); ++k) {
            const auto i = static_cast<std::size_t>(which[k] - 1);
            const double dx = x[i] - x0, dy = y[i] - y0, up = std::sqrt(R * R - dx * dx - dy * dy), dz = R - up;
            const double fx = -f[k] * dx / up, fy = -f[k] * dy / up, fz = f[k];
            Fx += fx, Fy += fy;
            Mx += dy * fz - dz * fy, My += dz * fx - dx * fz;
        }
        const double most = std::hypot(Fx, Fy);
        CHECK_CLOSE(F[2 * s], Fx, 1e-10 * most);
        CHECK_CLOSE(F[2 * s + 1], Fy, 1e-10 * most);
        CHECK_CLOSE(M[2 * s], Mx, 1e-10 * most * R);
        CHECK_CLOSE(M[2 * s + 1], My, 1e-10 * most * R);
        CHECK_RELATIVE(length[s], -2 * S[s] / E, 1e-14);
        CHECK_RELATIVE(resistance[s], 3.0e-5 / length[s], 1e-14);
    }
    CHECK_RELATIVE(S[1], (N[3] - N[2]) / (Z[3] - Z[2]), 1e-5);  // spots that come and go between the two
    CHECK_RELATIVE(-N[1], (W[3] - W[2]) / (Z[3] - Z[2]), 1e-7);
    CHECK(file.text("resistance", "units") == "ohm" && file.text("conductance_length", "units") == "mm");
}

void friction(const std::string& folder) {
    const double mu = 0.3;
    const std::string keys = "solids%friction=0.3;";
    run(keys + "indentation%levels=5.0e-2, 1.2e-2, 5.0e-3;", folder + "/friction.nc");
    const Reader file(folder + "/friction.nc");
    const Vector N = file.values("force"), S = file.values("stiffness"), Z = file.values("separation");
    const Vector xi = file.values("tangential_displacement"), Q = file.values("tangential_force");
    const Vector stiffness = file.values("tangential_stiffness"), work = file.values("cycle_work");
    // 4 G*/E*, written out again.
    const double G1 = 80e3 / 2.7, G2 = 200e3 / 2.6, m = 4 / ((2 - 0.35) / G1 + (2 - 0.3) / G2) / file.values("e_star")[0];
    const std::size_t points = Q.size() / 3, first = static_cast<std::size_t>(file.numbers("point", "first_loading")[1]);
    CHECK(first == 41 && points == 114);
    CHECK(xi[0] == NC_FILL_DOUBLE && Q[5] == NC_FILL_DOUBLE && stiffness[0] == NC_FILL_DOUBLE && work[0] == NC_FILL_DOUBLE);
    for (std::size_t s = 1; s < 3; ++s) {
        const double *x = xi.data() + s * points, *q = Q.data() + s * points;
        CHECK(x[0] == 0 && q[0] == 0);
        CHECK_RELATIVE(q[first - 1], mu * N[s], 1e-10);
        CHECK_RELATIVE(stiffness[s], -m * S[s], 1e-12);
        double area = 0;
        for (std::size_t k = first + 1; k < points; ++k) area += 0.5 * (q[k] + q[k - 1]) * (x[k] - x[k - 1]);
        CHECK_RELATIVE(work[s], area, 5e-3);  // trapezia
        CHECK_CLOSE(x[points - 1], x[first], 1e-12 * x[first]);
        CHECK_CLOSE(q[points - 1], q[first], 1e-12 * q[first]);
        CHECK_RELATIVE(x[first], 0.9 * x[first - 1], 1e-12);
        for (std::size_t k = 1; k < first; ++k) CHECK(q[k] > q[k - 1] && x[k] > x[k - 1]);
    }
    // Q = mu [N(Z0) - N(Z0')], slide = (mu/m) (Z0' - Z0): the inner separations as levels of a run of their own.
    const std::size_t at[2] = {5, 30};
    std::string levels;
    for (std::size_t k : at) {
        char text[40];
        std::snprintf(text, sizeof text, "%s%.17g", levels.empty() ? "" : ", ", Z[2] + xi[2 * points + k] * m / mu);
        levels += text;
    }
    run("indentation%levels=" + levels + ";", folder + "/inner.nc");
    const Reader inner(folder + "/inner.nc");
    for (std::size_t k = 0; k < 2; ++k) CHECK_CLOSE(Q[2 * points + at[k]], mu * (N[2] - inner.values("force")[k]), 1e-9 * mu * N[2]);
    // Friction does not touch the levels.
    run("indentation%levels=5.0e-2, 1.2e-2, 5.0e-3;", folder + "/without.nc");
    CHECK(Reader(folder + "/without.nc").values("force") == N);
    CHECK_THROWS(run(keys + "run%realizations=2;indentation%levels=1.2e-2;", folder + "/refused.nc"), Error);
}

void campaign(const std::string& folder) {
    run("run%realizations=3;indentation%levels=1.2e-2, 5.0e-3;", folder + "/campaign.nc");
    const Reader file(folder + "/campaign.nc");
    for (const std::string name : {"stiffness", "energy", "conductance_length", "resistance"}) {
        const Vector v = file.values(name), mean = file.values(name + "_mean"), deviation = file.values(name + "_std");
        for (std::size_t s = 0; s < 2; ++s) {
            const double a = v[s], b = v[2 + s], c = v[4 + s], middle = (a + b + c) / 3;
            const double squares = (a - middle) * (a - middle) + (b - middle) * (b - middle) + (c - middle) * (c - middle);
            CHECK(a != b);
            CHECK_RELATIVE(mean[s], middle, 1e-13);
            CHECK_RELATIVE(deviation[s], std::sqrt(squares / 2), 1e-11);
        }
    }
    const Vector F = file.values("lateral_force"), mean = file.values("lateral_force_mean");
    for (std::size_t k = 0; k < 4; ++k) CHECK_CLOSE(mean[k], (F[k] + F[4 + k] + F[8 + k]) / 3, 1e-12 * std::abs(F[k]));
    CHECK(file.dimensions("lateral_force_std") == (std::vector<std::string>{"step", "component"}));
}

}  // namespace

int main() {
    const Folder temporary;
    const std::string folder = temporary.path.string();
    answers(folder);
    friction(folder);
    campaign(folder);
    return check::summary();
}
