// Whole runs, from a case's text to the file: every number of the file against what its definition says, worked out here from the
// heights, the asperities and the contacts of the same file.
#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "case/read_case.hpp"
#include "check.hpp"
#include "result_reader.hpp"
#include "rough/detection.hpp"
#include "run/run.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;
using std::numbers::pi;

namespace {

using Vector = std::vector<double>;
constexpr double kRounding = 1e-12;  // of sums of some hundred terms

long run(const std::string& text, const std::string& file) {
    Case c = read_case_text(text, "case.nml").settings;
    c.output.file = file;
    return run_case(c, {});
}

double sum(const Vector& v) {
    double s = 0;
    for (double x : v) s += x;
    return s;
}

// Heights as a rectangle of points, with the moments of finite differences (physics.md, section 2).
struct Map {
    std::size_t nx, ny;
    double dx, dy;
    bool periodic;
    Vector z;
    double at(long i, long j) const {
        const auto a = static_cast<long>(nx), b = static_cast<long>(ny);
        return z[static_cast<std::size_t>((j + b) % b * a + (i + a) % a)];
    }
    double rms() const {
        double mean = sum(z) / static_cast<double>(z.size()), square = 0;
        for (double h : z) square += (h - mean) * (h - mean);
        return std::sqrt(square / static_cast<double>(z.size()));
    }
    // m2 = <z_x^2 + z_y^2>/2 and m4 = (<z_xx^2> + <z_yy^2> + 3 <z_xy^2>)/3 of forward and second differences.
    std::pair<double, double> moments() const {
        const long edge = periodic ? 0 : 1;
        double m2 = 0, m4 = 0, n = 0;
        for (long j = edge; j < static_cast<long>(ny) - edge; ++j)
            for (long i = edge; i < static_cast<long>(nx) - edge; ++i) {
                const double zx = (at(i + 1, j) - at(i, j)) / dx, zy = (at(i, j + 1) - at(i, j)) / dy;
                const double xx = (at(i + 1, j) - 2 * at(i, j) + at(i - 1, j)) / (dx * dx);
                const double yy = (at(i, j + 1) - 2 * at(i, j) + at(i, j - 1)) / (dy * dy);
                const double xy = (at(i + 1, j + 1) - at(i, j + 1) - at(i + 1, j) + at(i, j)) / (dx * dy);
                m2 += (zx * zx + zy * zy) / 2;
                m4 += (xx * xx + yy * yy + 3 * xy * xy) / 3;
                ++n;
            }
        return {m2 / n, m4 / n};
    }
    // Points strictly above their eight neighbours.
    long maxima() const {
        const long edge = periodic ? 0 : 1;
        long found = 0;
        for (long j = edge; j < static_cast<long>(ny) - edge; ++j)
            for (long i = edge; i < static_cast<long>(nx) - edge; ++i) {
                bool top = true;
                for (long b = -1; b <= 1; ++b)
                    for (long a = -1; a <= 1; ++a) top = top && ((a == 0 && b == 0) || at(i, j) > at(i + a, j + b));
                found += top;
            }
        return found;
    }
};

struct Spot {
    double x, y, f, a, radius;
};

// The contacts of a level.
std::vector<Spot> spots_of(const Reader& file, std::size_t step) {
    const Vector start = file.values("contact_start"), count = file.values("contact_count"), which = file.values("contact_asperity");
    const Vector f = file.values("contact_force"), a = file.values("contact_radius");
    const Vector x = file.values("asperity_x"), y = file.values("asperity_y"), r = file.values("asperity_radius");
    std::vector<Spot> spots;
    for (auto k = static_cast<std::size_t>(start[step] - 1); k < static_cast<std::size_t>(start[step] - 1 + count[step]); ++k) {
        const auto i = static_cast<std::size_t>(which[k] - 1);
        spots.push_back({x[i], y[i], f[k], a[k], r[i]});
    }
    return spots;
}

// Levels and their contacts: sums, counts, the law, the selection; `spacing`: <d> of 1/sqrt(D).
void levels_are_their_contacts(const Reader& file, double spacing) {
    const Vector Z = file.values("separation"), N = file.values("force"), A = file.values("contact_area");
    const Vector contacts = file.values("contacts"), candidates = file.values("candidates"), status = file.values("status");
    const Vector pairs = file.values("overlapping_pairs"), large = file.values("large_contacts"), residual = file.values("residual");
    const Vector iterations = file.values("iterations"), products = file.values("products"), crowded = file.values("crowded_cells");
    const Vector ax = file.values("asperity_x"), ay = file.values("asperity_y"), az = file.values("asperity_z");
    const Vector cells = file.values("map_area_fraction"), pressures = file.values("map_pressure");
    const Vector cx = file.values("x"), cy = file.values("y");
    const double E = file.values("e_star")[0], R = file.values("r_star")[0], x0 = file.values("tip_x")[0], y0 = file.values("tip_y")[0];
    const double side = file.values("map_cell_side")[0];
    CHECK_RELATIVE(cx[1] - cx[0], side, kRounding);
    CHECK_RELATIVE(cy[1] - cy[0], side, kRounding);
    double met_pairs = 0, met_large = 0;
    for (std::size_t s = 0; s < Z.size(); ++s) {
        const std::vector<Spot> spots = spots_of(file, s);
        double force = 0, area = 0;
        long touching = 0, big = 0, reachable = 0;
        Vector cell_area(cells.size() / Z.size()), cell_force(cell_area.size());
        for (std::size_t i = 0; i < spots.size(); ++i) {
            const Spot& p = spots[i];
            force += p.f;
            area += pi * p.a * p.a;
            big += p.a > spacing / 4;
            CHECK_RELATIVE(p.f, 4.0 / 3 * E * p.a * p.a * p.a / p.radius, 1e-10);  // Hertz: u = a^2/r
            for (std::size_t j = 0; j < i; ++j) touching += std::hypot(p.x - spots[j].x, p.y - spots[j].y) < p.a + spots[j].a;
            const auto column = static_cast<std::size_t>((p.x - (cx[0] - side / 2)) / side);
            const auto row = static_cast<std::size_t>((p.y - (cy[0] - side / 2)) / side);
            if (column >= cx.size() || row >= cy.size()) continue;
            cell_area[row * cx.size() + column] += pi * p.a * p.a / (side * side);
            cell_force[row * cx.size() + column] += p.f / (side * side);
        }
        for (std::size_t i = 0; i < az.size(); ++i) {
            const double rho2 = (ax[i] - x0) * (ax[i] - x0) + (ay[i] - y0) * (ay[i] - y0);
            reachable += rho2 <= R * R && az[i] + std::sqrt(R * R - rho2) - R - Z[s] > 0;
        }
        CHECK_RELATIVE(N[s], force, kRounding);
        CHECK_RELATIVE(A[s], area, kRounding);
        CHECK(contacts[s] == static_cast<double>(spots.size()) && candidates[s] == static_cast<double>(reachable));
        CHECK(pairs[s] == static_cast<double>(touching) && large[s] == static_cast<double>(big));
        long crowds = 0;
        for (std::size_t c = 0; c < cell_area.size(); ++c) {
            CHECK_CLOSE(cells[s * cell_area.size() + c], cell_area[c], kRounding);
            CHECK_CLOSE(pressures[s * cell_area.size() + c], cell_force[c], kRounding * E);
            crowds += cell_area[c] > pi / 16;
        }
        CHECK(crowded[s] == static_cast<double>(crowds));
        CHECK(residual[s] <= 1e-6 && iterations[s] >= 1 && products[s] >= iterations[s]);
        // 0 converged, 1 out of validity, 2 overlapping; more serious ones have other reasons.
        if (touching > 0) CHECK(status[s] >= 2);
        if (touching == 0 && big > 0) CHECK(status[s] >= 1);
        CHECK(status[s] != 4);
        met_pairs += static_cast<double>(touching);
        met_large += static_cast<double>(big);
    }
    CHECK(met_pairs > 0 && met_large > 0 && N.back() > N.front());
}

void regimes(const Reader& file, double m2, double m4) {
    const Vector N = file.values("force_mean"), radius = file.values("radius"), hertz = file.values("hertz_pressure");
    const double E = file.values("e_star")[0], R = file.values("r_star")[0];
    CHECK_RELATIVE(file.values("transition_force")[0], 212.66 * std::pow(m2, 1.5) * E / m4, 3e-5);  // five digits in the paper
    constexpr double kDigits = 1e-3;                                                                // of 0.737
    for (std::size_t s = 0; s < N.size(); ++s) {
        const double a = std::cbrt(3 * N[s] * R / (4 * E)), p0 = 3 * N[s] / (2 * pi * a * a);
        CHECK_RELATIVE(file.values("area_I")[s], pi * std::pow(3 * 0.737 / std::sqrt(m4) * N[s] / (4 * E), 2.0 / 3), kDigits);
        CHECK_RELATIVE(file.values("area_II")[s], 0.2 * std::sqrt(2 * pi) * N[s] / (std::sqrt(2 * m2) * E), kRounding);
        CHECK_RELATIVE(file.values("area_hertz")[s], pi * a * a, kRounding);
        for (std::size_t b = 0; b < radius.size(); ++b) {
            const double t = radius[b] / a;
            CHECK_CLOSE(hertz[s * radius.size() + b], t < 1 ? p0 * std::sqrt(1 - t * t) : 0, 1e-9 * p0);
        }
    }
}

// Histograms from the contacts, with the edges the file's own axes give.
void distributions(const Reader& file) {
    const Vector step = file.values("pdf_step"), Z = file.values("separation_sigma"), wanted = file.values("pdf_level");
    const Vector used = file.values("pdf_separation_sigma");
    for (std::size_t d = 0; d < step.size(); ++d) {
        const auto s = static_cast<std::size_t>(step[d] - 1);
        for (double other : Z) CHECK(std::abs(Z[s] - wanted[d]) <= std::abs(other - wanted[d]));
        CHECK_RELATIVE(used[d], Z[s], kRounding);
        const std::vector<Spot> spots = spots_of(file, s);
        const auto n = static_cast<double>(spots.size());
        const auto counted = [&](const std::string& name, const auto& value) {
            const Vector axis = file.values(name + "_bin"), count = file.values(name + "_count"), pdf = file.values(name + "_pdf");
            const double width = file.numbers(name + "_bin", "bin_width").at(0);
            Vector mine(axis.size());
            double beyond = 0;
            for (const Spot& p : spots) {
                double least = 1e300;  // the bin whose middle is nearest
                std::size_t bin = 0;
                for (std::size_t b = 0; b < axis.size(); ++b)
                    if (std::abs(value(p) - axis[b]) < least) least = std::abs(value(p) - axis[b]), bin = b;
                least <= width / 2 ? mine[bin] += 1 : beyond += 1;
            }
            for (std::size_t b = 0; b < axis.size(); ++b) {
                CHECK_RELATIVE(axis[b], (static_cast<double>(b) + 0.5) * width, kRounding);
                CHECK(count[d * axis.size() + b] == mine[b]);
                CHECK_RELATIVE(pdf[d * axis.size() + b], mine[b] / (n * width), kRounding);
            }
            CHECK(file.numbers(name + "_count", "overflow").at(d) == beyond);
        };
        const auto pressure = [](const Spot& p) { return p.f / (pi * p.a * p.a); };
        counted("pressure_mean", pressure);
        counted("spot_area", [](const Spot& p) { return pi * p.a * p.a; });

        double squares = 0, area = 0, area_squares = 0;
        for (const Spot& p : spots)
            squares += pressure(p) * pressure(p), area += pi * p.a * p.a, area_squares += std::pow(pi * p.a * p.a, 2);
        CHECK_RELATIVE(file.numbers("pressure_pdf", "independent_contacts").at(d), area * area / area_squares, kRounding);
        CHECK_RELATIVE(file.numbers("pressure_mean_pdf", "rayleigh_scale").at(d), std::sqrt(squares / n / 2), kRounding);
        CHECK_RELATIVE(file.numbers("spot_area_pdf", "exponential_scale").at(d), area / n, kRounding);

        // Each contact has the pressures of its Hertz profile: the share (p/p0)^2 of its area is below p < p0 = 1.5 of the mean.
        const Vector axis = file.values("pressure_bin"), shares = file.values("pressure_area");
        const double width = file.numbers("pressure_bin", "bin_width").at(0);
        for (std::size_t b = 0; b < axis.size(); ++b) {
            double mine = 0;
            for (const Spot& p : spots) {
                const auto below = [&](double q) { return std::min(1.0, std::pow(q / (1.5 * pressure(p)), 2)); };
                mine += pi * p.a * p.a * (below(axis[b] + width / 2) - below(std::max(axis[b] - width / 2, 0.0)));
            }
            CHECK_CLOSE(shares[d * axis.size() + b], mine, 1e-11 * area);
            CHECK_CLOSE(file.values("pressure_pdf")[d * axis.size() + b], mine / (area * width), 1e-11 / width);
        }
    }
    CHECK(step.size() == 2 && step[0] != step[1]);
}

// Means over circles of a map that is linear in x and y between cell centres are what the centre's neighbours give; here only: the
// rings fill the largest circle in the map, and the means keep the map's size.
void radial(const Reader& file, double largest) {
    const Vector r = file.values("radius");
    for (std::size_t b = 0; b < r.size(); ++b)
        CHECK_RELATIVE(r[b], (static_cast<double>(b) + 0.5) * largest / static_cast<double>(r.size()), kRounding);
}

const char* const kSynthetic = R"(
&run seed = 3 /
&solids R(2) = 5.0 /
&surface n = 512, L = 2.0, L_lambda_l = 4.0, L_lambda_s = 64.0, hurst = 0.7, sigma = 0.02 /
&indentation spacing = 'log', start = 2.0, stop = 0.1, steps = 5, centre = 1.1, 0.9 /
&output heights = .true., map_cells = 20, radial_bins = 7, pdf_levels = 1.2, 0.5, pdf_bins = 30 /
)";

void synthetic(const Folder& folder) {
    const std::string path = folder / "synthetic.nc";
    CHECK(run(kSynthetic, path) == 0);
    const Reader file(path);
    const Vector heights = file.values("height"), hx = file.values("height_x"), hy = file.values("height_y");
    const Map map{hx.size(), hy.size(), 2.0 / 512, 2.0 / 512, true, heights};
    CHECK(hx.size() == 512 && hy.size() == 512);
    CHECK_RELATIVE(file.values("sigma")[0], 0.02, 1e-12);
    CHECK_RELATIVE(map.rms(), 0.02, 1e-12);
    const auto [m2, m4] = map.moments();
    CHECK_RELATIVE(file.values("m2_grid")[0], m2, 1e-10);
    CHECK_RELATIVE(file.values("m4_grid")[0], m4, 1e-10);
    // Eight points a wave: differences miss less than (2 pi/8)^2/12 and twice that of the exact sums.
    CHECK(file.values("m2")[0] > m2 && file.values("m2")[0] < 1.06 * m2);
    CHECK(file.values("m4")[0] > m4 && file.values("m4")[0] < 1.12 * m4);
    CHECK_RELATIVE(file.values("rms_slope")[0], std::sqrt(2 * file.values("m2")[0]), kRounding);

    // Asperities are the maxima of the grid with their curvatures.
    const Vector x = file.values("asperity_x"), y = file.values("asperity_y"), z = file.values("asperity_z");
    const Vector r = file.values("asperity_radius"), k1 = file.values("asperity_kappa1"), k2 = file.values("asperity_kappa2");
    CHECK(file.values("summits")[0] == static_cast<double>(x.size()) && x.size() > 1000);
    CHECK(file.values("summits")[0] + file.values("saddles")[0] == static_cast<double>(map.maxima()));
    CHECK(file.values("saddles")[0] > 0);
    double g = 0, a = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const long i = std::lround(x[k] / map.dx), j = std::lround(y[k] / map.dy);
        CHECK(z[k] == map.at(i, j));
        const double xx = (map.at(i + 1, j) - 2 * z[k] + map.at(i - 1, j)) / (map.dx * map.dx);
        const double yy = (map.at(i, j + 1) - 2 * z[k] + map.at(i, j - 1)) / (map.dy * map.dy);
        CHECK_CLOSE(k1[k] + k2[k], -xx - yy, 1e-9 * k1[k]);
        CHECK_RELATIVE(r[k], 1 / std::sqrt(k1[k] * k2[k]), kRounding);
        g += std::sqrt(k1[k] * k2[k]), a += (k1[k] + k2[k]) / 2;
    }
    CHECK_RELATIVE(file.values("mean_kappa_g")[0], g / static_cast<double>(x.size()), kRounding);
    CHECK_RELATIVE(file.values("mean_kappa_a")[0], a / static_cast<double>(x.size()), kRounding);

    // Closed forms (physics.md, section 2), no plateau: T(p) Phi0 kl^(p+2) (zeta^(p-2H) - 1)/(p-2H).
    const double H = 0.7, zeta = 16, kl = 2 * pi * 4 / 2.0;
    const auto form = [&](double p, double T) { return T * std::pow(kl, p + 2) * (std::pow(zeta, p - 2 * H) - 1) / (p - 2 * H); };
    const double Phi0 = 0.02 * 0.02 / form(0, 2 * pi), t2 = Phi0 * form(2, pi), t4 = Phi0 * form(4, 0.75 * pi);
    CHECK_RELATIVE(file.values("m0_theory")[0], 0.02 * 0.02, kRounding);
    CHECK_RELATIVE(file.values("m2_theory")[0], t2, 1e-10);
    CHECK_RELATIVE(file.values("m4_theory")[0], t4, 1e-10);
    CHECK_RELATIVE(file.values("nayak_theory")[0], 0.0004 * t4 / (t2 * t2), 1e-10);
    const double density = std::sqrt(3) * t4 / (18 * pi * t2);
    CHECK_RELATIVE(file.values("density_theory")[0], density, 1e-10);
    CHECK_RELATIVE(file.values("e_star")[0], 78e3 / (1 - 0.42 * 0.42), kRounding);
    CHECK(file.values("r_star")[0] == 5 && file.values("tip_x")[0] == 1.1 && file.values("tip_y")[0] == 0.9);

    // Levels a fixed ratio apart, both ends there.
    const Vector Z = file.values("separation"), Zs = file.values("separation_sigma");
    CHECK(Z.size() == 5 && std::abs(Zs[0] - 2) < 1e-15 && std::abs(Zs[4] - 0.1) < 1e-15);
    for (std::size_t s = 0; s < Z.size(); ++s) {
        CHECK_RELATIVE(Zs[s], 2 * std::pow(0.05, static_cast<double>(s) / 4), 1e-14);
        CHECK_RELATIVE(Z[s], 0.02 * Zs[s], 1e-14);
    }
    levels_are_their_contacts(file, 1 / std::sqrt(density));
    regimes(file, t2, t4);
    distributions(file);
    radial(file, 0.9);
}

// Summits between the points: those found from the heights of the file, and the maxima of the grid that lead to none of their own.
void between_points(const Folder& folder) {
    const std::string path = folder / "between.nc";
    CHECK(run("&surface n = 256, L_lambda_l = 2, L_lambda_s = 60 /\n&asperities law = 'fourth_order' /\n&indentation levels = 3.0 /\n"
              "&output heights = .true. /",
              path) == 0);
    const Reader file(path);
    const Vector z = file.values("height");
    HeightMap map;
    map.allocate(256, 256, 256);
    map.dx = map.dy = 1.0 / 256;
    map.periodic = true;
    std::copy(z.begin(), z.end(), map.data.get());
    SummitCount count;
    const Asperities found = find_asperities(map, Curvature::geometric, &count, 1, Detail::subgrid, 256.0 / 60);
    CHECK(found.x == file.values("asperity_x") && file.values("summits")[0] == static_cast<double>(found.size()));
    CHECK(count.repeated > 0 && count.saddles > 0);
    CHECK(file.values("saddles")[0] == static_cast<double>(count.saddles + count.repeated));
}

// Elements that yield: where the surface is lower for good is under the tip, and its volume is the work.
void pressed_out(const Folder& folder) {
    const std::string path = folder / "pressed.nc";
    CHECK(run("&surface n = 128, L_lambda_l = 2, L_lambda_s = 16, sigma = 0.002 /\n&solver model = 'elements' /\n"
              "&solids hardness = 500 /\n&indentation levels = 1.0, 0.0, centre = 0.3, 0.6 /",
              path) == 0);
    const Reader file(path);
    const Vector x = file.values("residual_pixel_x"), y = file.values("residual_pixel_y"), depth = file.values("residual_pixel_depth");
    const double h = file.numbers("residual_pixel_x", "pixel_size").at(0), n = static_cast<double>(x.size());
    CHECK(n > 5 && file.numbers("residual_pixel_y", "pixel_size").at(0) == h);
    CHECK_RELATIVE(file.values("plastic_work")[1], 500 * h * h * sum(depth), 1e-12);
    CHECK_CLOSE(sum(x) / n, 0.3, 0.1);
    CHECK_CLOSE(sum(y) / n, 0.6, 0.1);
}

// Linear spacing, and a list.
void levels(const Folder& folder) {
    const std::string path = folder / "levels.nc", surface = "&surface n = 64, L_lambda_l = 2, L_lambda_s = 8 /\n";
    CHECK(run(surface + "&indentation start = 3, stop = 1, steps = 9 /", path) == 0);
    Vector Z = Reader(path).values("separation_sigma");
    CHECK(Z.size() == 9);
    for (std::size_t s = 0; s < Z.size(); ++s) CHECK_RELATIVE(Z[s], 3 - 0.25 * static_cast<double>(s), 1e-14);
    CHECK(run(surface + "&indentation levels = 2.5, 0.5, 1.75, start = 9, steps = 7 /", path) == 0);
    Z = Reader(path).values("separation_sigma");
    CHECK(Z.size() == 3);
    CHECK_RELATIVE(Z[1], 0.5, 1e-14);
    CHECK_RELATIVE(Z[2], 1.75, 1e-14);
    CHECK(run(surface + "&indentation levels = 0.02, 0.015, unit = 'length' /", path) == 0);
    Z = Reader(path).values("separation");
    CHECK(Z.size() == 2 && Z[0] == 0.02 && Z[1] == 0.015);
}

// Means and deviations over realizations, of which each is the run of its own.
void ensemble(const Folder& folder) {
    const std::string text =
        "&surface n = 64, L_lambda_l = 2, L_lambda_s = 8 /\n&indentation levels = 1.5, 0.5 /\n&output map_cells = 5 /\n";
    CHECK(run(text + "&run realizations = 4, first_realization = 3 /", folder / "many.nc") == 0);
    const Reader file(folder / "many.nc");
    for (const auto& [name, mean, deviation] :
         {std::array{"force", "force_mean", "force_std"}, {"contact_area", "contact_area_mean", "contact_area_std"}}) {
        const Vector all = file.values(name);
        for (std::size_t s = 0; s < 2; ++s) {
            double m = 0, v = 0;
            for (std::size_t k = 0; k < 4; ++k) m += all[2 * k + s] / 4;
            for (std::size_t k = 0; k < 4; ++k) v += std::pow(all[2 * k + s] - m, 2) / 3;
            CHECK_RELATIVE(file.values(mean)[s], m, kRounding);
            CHECK_RELATIVE(file.values(deviation)[s], std::sqrt(v), 1e-10);
        }
    }
    for (int k = 0; k < 4; ++k) {
        CHECK(run(text + "&run first_realization = " + std::to_string(3 + k) + " /", folder / "one.nc") == 0);
        const Reader one(folder / "one.nc");
        const auto i = static_cast<std::size_t>(k);
        for (const char* name : {"force", "contact_area", "contacts", "overlapping_pairs", "large_contacts"})
            CHECK(one.values(name)[1] == file.values(name)[2 * i + 1]);
        for (const char* name : {"sigma", "m2", "m4", "m2_grid", "m4_grid", "summits", "saddles", "mean_kappa_g", "mean_kappa_a"})
            CHECK(one.values(name)[0] == file.values(name)[i]);
        CHECK(file.values("realization")[i] == 3 + k);
    }
}

// Under force control the levels are the forces, and the stiffness is the slope of the force over the separation, with the sign its
// own description gives it.
void force_control(const Folder& folder) {
    const std::string text =
        "&surface n = 128, L_lambda_l = 4, L_lambda_s = 32 /\n&indentation control = 'force', levels = 4.995, 5.0, 5.005 /\n"
        "&solver tolerance = 1e-12 /\n";
    CHECK(run(text, folder / "force.nc") == 0);
    const Reader file(folder / "force.nc");
    const Vector N = file.values("force"), Z = file.values("separation"), S = file.values("stiffness");
    CHECK_RELATIVE(N[0], 4.995, 1e-9);
    CHECK_RELATIVE(N[2], 5.005, 1e-9);
    const double slope = (N[2] - N[0]) / (Z[2] - Z[0]);
    const bool opposite = file.text("stiffness", "long_name").find("-dN/dZ0") != std::string::npos;
    CHECK(slope < 0);
    CHECK_RELATIVE(S[1], opposite ? -slope : slope, 1e-4);  // a centred difference over a thousandth of the force
    CHECK(file.text("stiffness", "units") == "N mm-1");
}

// A measured map, wider than high, of other steps in y than in x, tilted, away from the origin.
void measured(const Folder& folder) {
    constexpr std::size_t nx = 48, ny = 30;
    constexpr double dx = 0.1, dy = 0.07, x_first = 2.0, y_first = -1.0;
    Map map{nx, ny, dx, dy, false, Vector(nx * ny)};
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) {
            const double u = static_cast<double>(i), v = static_cast<double>(j);
            map.z[j * nx + i] =
                0.01 * (std::sin(1.1 * u + 0.3) * std::cos(0.8 * v) + 0.4 * std::sin(0.5 * u - 0.9 * v)) + 0.002 * u - 0.003 * v + 7;
        }
    const std::string input = folder / "measured_map.nc";
    int id = -1, dims[2] = {}, vx = -1, vy = -1, vz = -1;
    CHECK(nc_create(input.c_str(), NC_CLOBBER, &id) == NC_NOERR);
    nc_def_dim(id, "y", ny, &dims[0]), nc_def_dim(id, "x", nx, &dims[1]);
    nc_def_var(id, "y", NC_DOUBLE, 1, &dims[0], &vy), nc_def_var(id, "x", NC_DOUBLE, 1, &dims[1], &vx);
    nc_def_var(id, "height", NC_DOUBLE, 2, dims, &vz);
    for (int v : {vx, vy, vz}) nc_put_att_text(id, v, "units", 2, "mm");
    nc_enddef(id);
    Vector px, py;
    for (std::size_t i = 0; i < nx; ++i) px.push_back(x_first + dx * static_cast<double>(i));
    for (std::size_t j = 0; j < ny; ++j) py.push_back(y_first + dy * static_cast<double>(j));
    nc_put_var_double(id, vx, px.data()), nc_put_var_double(id, vy, py.data()), nc_put_var_double(id, vz, map.z.data());
    CHECK(nc_close(id) == NC_NOERR);

    const std::string rest = "&solids R(2) = 50 /\n&indentation levels = 1.0, 0.3 /\n&output heights = .true., map_cells = 12 /\n";
    std::map<std::string, double> sigma;
    for (const char* how : {"none", "mean", "plane"}) {
        const std::string path = folder / (std::string(how) + ".nc");
        CHECK(run("&surface source = 'heights', file = '" + input + "', detrend = '" + how + "' /\n" + rest, path) == 0);
        const Reader file(path);
        Map left{nx, ny, dx, dy, false, file.values("height")};
        sigma[how] = file.values("sigma")[0];
        CHECK_RELATIVE(sigma[how], left.rms(), 1e-10);
        // What is left: nothing touched, no mean, or neither mean nor slope along x or y.
        double mean = 0, along_x = 0, along_y = 0;
        for (std::size_t j = 0; j < ny; ++j)
            for (std::size_t i = 0; i < nx; ++i) {
                const double z = left.z[j * nx + i];
                mean += z / (nx * ny), along_x += z * (static_cast<double>(i) - (nx - 1) / 2.0),
                    along_y += z * (static_cast<double>(j) - (ny - 1) / 2.0);
            }
        if (how == std::string("none")) CHECK(left.z == map.z);
        if (how != std::string("none")) CHECK_CLOSE(mean, 0, 1e-13);
        if (how == std::string("plane")) CHECK_CLOSE(along_x, 0, 1e-9), CHECK_CLOSE(along_y, 0, 1e-9);
        if (how == std::string("mean")) CHECK(along_x > 1 && along_y < -1);

        const auto [m2, m4] = left.moments();
        for (const char* name : {"m2", "m2_grid"}) CHECK_RELATIVE(file.values(name)[0], m2, 1e-9);
        for (const char* name : {"m4", "m4_grid"}) CHECK_RELATIVE(file.values(name)[0], m4, 1e-9);
        CHECK(file.values("summits")[0] + file.values("saddles")[0] == static_cast<double>(left.maxima()));
        CHECK(file.values("m4_theory")[0] == NC_FILL_DOUBLE);
        // A point is a cell: the surface is nx dx by ny dy, and the tip is above its middle.
        CHECK_RELATIVE(file.values("tip_x")[0], x_first + nx * dx / 2, 0.011);
        CHECK_CLOSE(file.values("tip_y")[0], y_first + ny * dy / 2, dy / 2 + 1e-9);
        const Vector hx = file.values("height_x"), hy = file.values("height_y");
        CHECK(hx.size() == nx && hy.size() == ny);
        CHECK_CLOSE(hx.back() - hx.front(), (nx - 1) * dx, 1e-12);
        CHECK_CLOSE(hy.back() - hy.front(), (ny - 1) * dy, 1e-12);
        CHECK_CLOSE(hx[0], x_first, dx / 2 + 1e-9);
        CHECK_CLOSE(hy[0], y_first, dy / 2 + 1e-9);
        regimes(file, m2, m4);
        // <d> is that of the summits found on the map.
        const double spacing = std::sqrt(nx * dx * ny * dy / file.values("summits")[0]), border = spacing;
        for (std::size_t s = 0; s < 2; ++s) {
            double large = 0, edge = 0;
            for (const Spot& p : spots_of(file, s)) {
                large += p.a > spacing / 4;
                edge += std::min({p.x - x_first, x_first + nx * dx - p.x, p.y - y_first, y_first + ny * dy - p.y}) < border;
            }
            CHECK(file.values("large_contacts")[s] == large && file.values("edge_contacts")[s] == edge);
        }
        const double N = file.values("force")[1];
        double carried = 0;
        for (const Spot& p : spots_of(file, 1)) carried += p.f;
        CHECK_RELATIVE(N, carried, kRounding);
    }
    CHECK(sigma["plane"] < 0.5 * sigma["mean"] && std::abs(sigma["mean"] - sigma["none"]) < 1e-12);
}

}  // namespace

int main() {
    const Folder folder;
    synthetic(folder);
    between_points(folder);
    pressed_out(folder);
    levels(folder);
    ensemble(folder);
    force_control(folder);
    measured(folder);
    return check::summary();
}
