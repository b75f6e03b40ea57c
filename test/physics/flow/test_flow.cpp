// Flow through the gap of two flats: closed forms, an independent solver, symmetries, percolation,
// a level of a contact.
#include "physics/flow/dissection.hpp"
#include "physics/flow/flow.hpp"
#include "support/library.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"
#include "truth/flow.hpp"

namespace test_flow {

using namespace rsc;

truth::Gap gap(int nx, int ny, double dx, double dy, const std::function<double(int, int)>& at) {
    truth::Gap m{nx, ny, dx, dy, {}};
    for (const int j : indices(ny))
        for (const int i : indices(nx)) m.g.push_back(at(i, j));
    return m;
}

GapMap view(const truth::Gap& m) { return {m.nx, m.ny, m.dx, m.dy, m.g}; }

Permeability solved(const truth::Gap& m) { return permeability(view(m)).K; }

// A periodic Gaussian field of rms 1 and waves of up to `most` periods in the cell.
std::vector<double> noise(int nx, int ny, int most, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<double> z(nx * ny, 0.0);
    double power = 0;
    for (int a = -most; a <= most; ++a)
        for (int b = 0; b <= most; ++b) {
            if (a * a + b * b > most * most || (b == 0 && a <= 0)) continue;
            const double c = normal(random), s = normal(random);
            power += 1;
            for (const int j : indices(ny))
                for (const int i : indices(nx)) {
                    const double phase = 2 * pi * (a * double(i) / nx + b * double(j) / ny);
                    z[j * nx + i] += c * std::cos(phase) + s * std::sin(phase);
                }
        }
    for (double& h : z) h /= std::sqrt(power);
    return z;
}

// A rough gap that is closed on about a third of the cell.
truth::Gap rough(int nx, int ny, double dx, double dy, unsigned seed) {
    const std::vector<double> z = noise(nx, ny, 5, seed);
    return gap(nx, ny, dx, dy, [&](int i, int j) { return std::max(0.0, z[j * nx + i] + 0.45); });
}

TEST(stripes_along_and_across_the_flow) {
    const auto width = [](int k) { return 1.3 + std::sin(0.7 * k) + 0.2 * (k % 3); };
    const int n = 17;
    double cube = 0, inverse = 0;
    for (const int k : indices(n)) {
        const double w = std::abs(width(k)) + 0.01;
        cube += w * w * w / n;
        inverse += 1 / (w * w * w) / n;
    }
    const auto stripes_along_x =
        gap(12, n, 0.2, 0.5, [&](int, int j) { return std::abs(width(j)) + 0.01; });
    const auto stripes_along_y =
        gap(n, 12, 0.5, 0.2, [&](int i, int) { return std::abs(width(i)) + 0.01; });
    const Permeability x = solved(stripes_along_x), y = solved(stripes_along_y);
    CHECK_RELATIVE(x.xx, cube / 12, 1e-12);
    CHECK_RELATIVE(x.yy, 1 / (12 * inverse), 1e-12);
    CHECK_CLOSE(x.xy, 0, 1e-14);
    CHECK_RELATIVE(y.yy, x.xx, 1e-12);
    CHECK_RELATIVE(y.xx, x.yy, 1e-12);
}

TEST(rough_gaps_by_conjugate_gradients) {
    double worst = 0;
    int open = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const truth::Gap m = rough(48, 40, 0.5, 0.4 + 0.1 * seed, seed);
        const auto expected = truth::permeability(m);
        const Permeability K = solved(m);
        const double scale = std::max(expected[0], expected[1]);
        open += expected[0] > 1e-9 && expected[1] > 1e-9;
        for (const double error : {K.xx - expected[0], K.yy - expected[1], K.xy - expected[2]})
            worst = check::worse(worst, std::abs(error) / scale);
    }
    std::printf("conjugate gradients: largest difference of K %.1e, %d of 6 gaps open\n", worst,
                open);
    CHECK(open >= 3);
    CHECK(worst < 1e-8);
}

// Along stripes <g>/2, across them <g^-2>/(2 <g^-3>), which the grid meets to second order. A
// parallel gap drags half of itself, a gap closed across the sliding nothing.
TEST(shear_flow_of_stripes) {
    double before = 0;
    for (const int n : {64, 128, 256}) {
        const auto width = [&](int k) { return 1.3 + std::sin(2 * pi * (k + 0.5) / n); };
        const ShearFlow S =
            permeability(view(gap(n, 6, 0.5, 0.3, [&](int i, int) { return width(i); }))).S;
        // With a = 1.3: <1/g^2> = a/(a^2 - 1)^(3/2), <1/g^3> = (a^2 + 1/2)/(a^2 - 1)^(5/2).
        const double across = 1.3 * (1.69 - 1) / (1.69 + 0.5) / 2;
        CHECK_RELATIVE(S.yy, 1.3 / 2, 1e-12);
        CHECK(std::abs(S.xy) < 1e-12 && std::abs(S.yx) < 1e-12);
        const double error = std::abs(S.xx / across - 1);
        if (before > 0) CHECK_CLOSE(std::log2(before / error), 2, 0.2);
        before = error;
    }
    CHECK(before < 1e-3);
    const ShearFlow parallel =
        permeability(view(gap(6, 9, 0.3, 0.7, [](int, int) { return 2.0; }))).S;
    CHECK_RELATIVE(parallel.xx, 1, 1e-13);
    CHECK_RELATIVE(parallel.yy, 1, 1e-13);
    const ShearFlow wall =
        permeability(view(gap(8, 6, 1, 1, [](int i, int) { return i == 3 ? 0.0 : 1.0; }))).S;
    CHECK(wall.xx == 0);
    CHECK_RELATIVE(wall.yy, 0.5 * 7 / 8, 1e-13);
}

// Reciprocity against the direct solution for the sliding face.
TEST(shear_flow_by_conjugate_gradients) {
    double worst = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const truth::Gap m = rough(48, 40, 0.5, 0.4 + 0.1 * seed, seed);
        const auto expected = truth::shear_flow(m);
        const ShearFlow S = permeability(view(m)).S;
        const std::array<double, 4> found{S.xx, S.xy, S.yx, S.yy};
        const double scale = std::max(expected[0], expected[3]);
        CHECK(scale > 0.01);
        for (const auto k : indices(found))
            worst = check::worse(worst, std::abs(found[k] - expected[k]) / scale);
    }
    std::printf("shear flow: largest difference %.1e\n", worst);
    CHECK(worst < 1e-10);
}

// Roughness of small variance s in a wide gap h = 1: 12 K = 1 + 3 s - 9 s <cos^2> and 2 S = 1 - 3 s
// <cos^2>, of the angle between the waves and the direction (Patir and Cheng's limits: along a lay
// 1 + 3 s and 1, across it 1 - 6 s and 1 - 3 s). The sum of both directions holds for any sample.
TEST(wide_gaps) {
    const int nx = 96, ny = 80;
    const std::vector<double> z = noise(nx, ny, 4, 3);
    double variance = 0;
    const double mean = sum_of(z) / double(z.size());
    for (const double height : z) variance += (height - mean) * (height - mean) / double(z.size());
    for (const double rms : {0.02, 0.01}) {
        const GapFlow flow = permeability(view(
            gap(nx, ny, 0.5, 0.6, [&](int i, int j) { return 1 + rms * (z[j * nx + i] - mean); })));
        const double s = rms * rms * variance;
        const double tolerance = 0.02 * s;  // waves of 20 points, and terms of s^2
        CHECK_CLOSE(12 * (flow.K.xx + flow.K.yy), 2 - 3 * s, 3 * tolerance);
        CHECK_CLOSE(2 * (flow.S.xx + flow.S.yy), 2 - 3 * s, 3 * tolerance);
    }
}

TEST(channels_dead_ends_and_islands) {
    // A channel one pixel wide along x carries what its resistance lets through; a pocket beside
    // it, and an island, carry nothing.
    const auto channel = [](bool more) {
        return gap(10, 12, 0.5, 0.25, [more](int i, int j) {
            if (j == 4) return 1.0 + 0.1 * i;
            if (more && ((i == 3 && j > 4 && j < 8) || (i > 5 && i < 9 && j > 8 && j < 11)))
                return 3.0;
            return 0.0;
        });
    };
    double inverse = 0;
    for (const int i : indices(10)) inverse += 0.1 * std::pow(1.0 + 0.1 * i, -3);
    const Permeability K = solved(channel(true));
    CHECK_RELATIVE(K.xx, 1 / (12 * inverse) / 12, 1e-12);
    CHECK(K.yy == 0 && K.xy == 0);
    // A channel that winds once along both axes: the flux along it is that of the sum of gradients.
    const Permeability both = solved(
        gap(8, 8, 1, 1, [](int i, int j) { return i == j || i == (j + 1) % 8 ? 1.0 : 0.0; }));
    CHECK(both.xx > 0);
    CHECK_RELATIVE(both.yy, both.xx, 1e-12);
    CHECK_RELATIVE(both.xy, both.xx, 1e-12);
    // Wide islands behind gaps so narrow that rounding hides them do not spoil the rest.
    const auto hidden = [](double neck) {
        return gap(12, 12, 1, 1, [neck](int i, int j) {
            if (j < 4) return 1.0;
            if (j == 4 || j == 11) return i == 5 || i == 6 ? neck : 0.0;
            return i > 3 && i < 9 ? 1.0 : 0.0;
        });
    };
    for (const double neck : {1e-4, 1e-6, 1e-9, 1e-60})
        CHECK_RELATIVE(solved(hidden(neck)).xx, 4.0 / 12 / 12, 1e-10);
    CHECK(solved(gap(8, 8, 1, 1, [](int, int) { return 0.0; })).xx == 0);
}

TEST(the_flux_at_each_point_adds_up) {
    const truth::Gap m = rough(40, 32, 0.5, 0.6, 3);
    std::vector<double> flow;
    const Permeability K = permeability(view(m), &flow).K;
    const double mean = sum_of(flow) / (40 * 32);
    CHECK(mean > std::hypot(K.xx, K.xy));  // the mean of magnitudes
    for (const auto k : indices(flow)) CHECK(m.g[k] > 0 || flow[k] == 0);
    permeability(view(gap(6, 9, 0.3, 0.7, [](int, int) { return 2.0; })), &flow);
    for (const double q : flow) CHECK_RELATIVE(q, 8.0 / 12, 1e-12);
}

TEST(percolation_by_walks) {
    std::mt19937 random(5);
    int along[2] = {0, 0};
    for (const int sample : indices(300)) {
        const int nx = 3 + sample % 11, ny = 2 + sample % 8;
        const truth::Gap m =
            gap(nx, ny, 1, 1, [&](int, int) { return random() % 1000 < 580 ? 1.0 : 0.0; });
        const auto expected = truth::percolates(m);
        LevelValues level;
        add_gap(level, view(m));
        CHECK(level.percolates_x == (expected[0] ? 1 : 0));
        CHECK(level.percolates_y == (expected[1] ? 1 : 0));
        const Permeability K = solved(m);
        CHECK((K.xx > 0) == expected[0] && (K.yy > 0) == expected[1]);
        along[0] += expected[0];
        along[1] += expected[1];
    }
    CHECK(along[0] > 50 && along[0] < 250 && along[1] > 50 && along[1] < 290);
}

TEST(every_point_is_eliminated_once) {
    std::mt19937 random(9);
    for (const auto& [nx, ny] : {std::pair{1, 1}, {1, 20}, {37, 2}, {60, 45}}) {
        std::vector<std::uint8_t> used(nx * ny);
        for (auto& u : used) u = random() % 3 > 0;
        std::vector<std::uint32_t> order = dissection(nx, ny, used);
        std::ranges::sort(order);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t k = 0; k < used.size(); ++k)
            if (used[k]) expected.push_back(k);
        CHECK(order == expected);
    }
}

constexpr const char* kFlats =
    "&solids E = Infinity, 5.0 nu = 0.3, 0.49 R = Infinity, Infinity viscosity = 1e-9 /\n"
    "&surface L = 0.5 sigma = 8e-4 L_lambda_l = 4 L_lambda_s = 12 n = 64 /\n"
    "&solver model = 'elements' /\n"
    "&indentation boundary = 'periodic' control = 'pressure' unit = 'pressure' "
    "levels = 0.01, 0.02, 0.3 /\n"
    "&output flow = .true. fields = 'gap', 'flow' field_levels = 0.01, 0.02\n"
    " leak_drop = 0.3, 0.1 leak_length = 2.0 leak_width = 50.0 /\n";

// K and S along x and y from those on every second point, a geometric mean of both diagonal
// choices.
void extrapolate(const truth::Gap& m, auto& K, auto& S) {
    std::array<double, 4> change{};
    for (const int offset : {0, 1}) {
        const truth::Gap coarse = gap(m.nx / 2, m.ny / 2, 2 * m.dx, 2 * m.dy, [&](int i, int j) {
            return m.g[at((2 * j + offset) * m.nx + 2 * i + offset)];
        });
        const auto k = truth::permeability(coarse);
        const auto s = truth::shear_flow(coarse);
        const double ratio[] = {K[0] / k[0], K[1] / k[1], S[0] / s[0], S[3] / s[3]};
        for (const auto c : indices(change)) change[c] += 0.5 * std::log(ratio[c]);
    }
    K[0] *= std::exp(kPermeabilityPower * change[0]);
    K[1] *= std::exp(kPermeabilityPower * change[1]);
    S[0] *= std::exp(kShearPower * change[2]);
    S[3] *= std::exp(kShearPower * change[3]);
}

TEST(the_gap_of_a_level) {
    const Job job = prepare(settings_of(kFlats));
    const Realization r = realize(job, 1, 1);
    const int n = int(r.fields.x.size());
    const std::size_t points = n * n;
    for (std::size_t s = 0; s < 2; ++s) {
        const Level& level = r.levels[s];
        truth::Gap m{n, n, r.fields.x[1] - r.fields.x[0], r.fields.y[1] - r.fields.y[0], {}};
        m.g.assign(r.fields.gap.begin() + static_cast<std::ptrdiff_t>(s * points),
                   r.fields.gap.begin() + static_cast<std::ptrdiff_t>((s + 1) * points));
        auto K = truth::permeability(m);
        auto S = truth::shear_flow(m);
        extrapolate(m, K, S);
        CHECK_RELATIVE(level.permeability_xx, K[0], 1e-8);
        CHECK_RELATIVE(level.permeability_yy, K[1], 1e-8);
        CHECK_CLOSE(level.permeability_xy, K[2], 1e-8 * K[0]);
        CHECK_RELATIVE(level.hydraulic_gap_x, std::cbrt(12 * K[0]), 1e-8);
        CHECK(level.hydraulic_gap_x < level.gap_mean_open);
        CHECK_RELATIVE(level.shear_xx, S[0], 1e-8);
        CHECK_CLOSE(level.shear_xy, S[1], 1e-8 * S[0]);
        CHECK_CLOSE(level.shear_yx, S[2], 1e-8 * S[0]);
        CHECK_RELATIVE(level.shear_yy, S[3], 1e-8);
        const double h = sum_of(m.g) / double(points);
        CHECK_RELATIVE(level.pressure_factor_y, 12 * K[1] / (h * h * h), 1e-8);
        CHECK_RELATIVE(level.shear_factor_x, (h - 2 * S[0]) / 8e-4, 1e-6);
        CHECK_RELATIVE(level.leak_rate, K[0] * (0.3 - 0.1) * 50 / (1e-9 * 2), 1e-8);
        // Deflections have no mean: the mean gap is the separation.
        CHECK_RELATIVE(level.gap_mean, level.separation, 1e-4);
        CHECK(level.percolates_x == 1 && level.percolates_y == 1);
    }
    CHECK(r.levels[1].permeability_xx < r.levels[0].permeability_xx);
    CHECK(r.levels[2].gap_mean < r.levels[1].gap_mean);
    CHECK(r.fields.physics[0].values.size() == 2 * points);

    Made library(kFlats);
    OK(rsc_contact_press(library.contact, r.levels[1].force, nullptr));
    CHECK_RELATIVE(value(library.contact, "gap_mean"), r.levels[1].gap_mean, 1e-9);
    CHECK_RELATIVE(value(library.contact, "permeability_xx"), r.levels[1].permeability_xx, 1e-9);
    CHECK_RELATIVE(value(library.contact, "hydraulic_gap_y"), r.levels[1].hydraulic_gap_y, 1e-9);
    CHECK(value(library.contact, "percolates_x") == 1);
    CHECK_RELATIVE(value(library.contact, "shear_flow_yx"), r.levels[1].shear_yx, 1e-6);
}

// The mass flux of an ideal gas, -(K/eta) P dP/dx, is the same everywhere: with a pressure P(x) of
// constant P dP/dx the gas leaves at P2 with K (P1^2 - P2^2)/(2 eta l P2).
TEST(leak_of_a_gas) {
    const auto leak = [](const char* gas) {
        std::string text = kFlats;
        text.insert(text.find("viscosity"), "gas = " + std::string(gas) + " ");
        return realize(prepare(settings_of(text)), 1, 1).levels[0];
    };
    const Level liquid = leak(".false."), gas = leak(".true.");
    // From the slope of P(x) at the outlet.
    const double P1 = 0.3, P2 = 0.1, length = 2, step = 1e-4;
    const auto pressure = [&](double x) {
        return std::sqrt(P1 * P1 - (P1 * P1 - P2 * P2) * x / length);
    };
    const double outlet = gas.permeability_xx * (pressure(length - step) - P2) / step / 1e-9 * 50;
    CHECK_RELATIVE(gas.leak_rate, outlet, 1e-3);
    CHECK_RELATIVE(gas.leak_rate / liquid.leak_rate, 2, 1e-12);  // mean pressure over P2
}

// The distribution at the level nearest to 1 sigma of each of three surfaces, from the stored gaps
// of the first, and its sums over all.
TEST(the_distribution_of_gaps) {
    const Folder folder;
    const auto solved = [&](const std::string& realizations, const char* fields) {
        return run_to(folder / (realizations + ".nc"),
                      std::string(kFlats).substr(0, std::string(kFlats).find("&output")) +
                          "&run realizations = " + realizations + " /\n&output " + fields +
                          " pdf_levels = 1.0, pdf_bins = 25 /\n");
    };
    const Reader one = solved("1", "fields = 'gap' field_levels = 0.01, 0.02, 0.3");
    const auto gap = one.values("field_gap");
    const std::size_t points = gap.size() / 3;
    const auto step = at(one.values("pdf_step")[0]) - 1;
    const double width = 2 * one.values("gap_bin")[0];
    std::vector<double> counts(26, 0.0);
    for (std::size_t k = step * points; k < (step + 1) * points; ++k)
        if (gap[k] > 0) ++counts[std::min(25, int(gap[k] / width))];
    const double open = sum_of(counts);
    CHECK(one.numbers("gap_count", "overflow")[0] == counts.back());
    counts.pop_back();
    CHECK(one.values("gap_count") == counts);
    for (const auto b : indices(counts))
        CHECK_RELATIVE(one.values("gap_pdf")[b], counts[b] / (open * width), 1e-12);
    CHECK_RELATIVE(one.numbers("gap_pdf", "mean")[0], one.values("gap_mean_open")[step], 1e-12);

    const Reader three = solved("3", "");
    double all = 0, sum = 0;
    for (const double n : three.values("gap_count")) all += n;
    for (std::size_t k = 0; k < 3; ++k)
        sum += three.values("gap_mean")[k * 3 + step] * double(points);
    all += three.numbers("gap_count", "overflow")[0];
    CHECK_RELATIVE(three.numbers("gap_pdf", "mean")[0] * all, sum, 1e-12);
}

}  // namespace test_flow
