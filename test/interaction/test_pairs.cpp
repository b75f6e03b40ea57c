// Direct pair sums against sums in long double, for every instruction set this machine has. The
// loops of the mesh, compiled with them: test_mesh.
#include "base/error.hpp"
#include "check.hpp"
#include "interaction/pairs.hpp"
#include "interaction/pairs_kernel.hpp"

namespace test_pairs {

using namespace rsc;

struct Points {
    std::vector<double> x, y, f;
    std::size_t size() const { return x.size(); }
};

Points random_points(std::size_t n, unsigned seed, double size = 1, double x0 = 0) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Points p{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
    for (const std::size_t i : indices(n)) {
        p.x[i] = x0 + size * uniform(engine);
        p.y[i] = size * uniform(engine);
        p.f[i] = uniform(engine) - 0.3;
    }
    return p;
}

// The truth, and the sum of |f_j| / d_ij that errors are measured against.
void truth(const Points& targets, const Points& sources, std::vector<double>& phi,
           std::vector<double>& size) {
    phi.assign(targets.size(), 0);
    size.assign(targets.size(), 0);
    for (const auto i : indices(targets)) {
        long double sum = 0, magnitude = 0;
        for (const auto j : indices(sources)) {
            const long double dx = static_cast<long double>(targets.x[i]) - sources.x[j];
            const long double dy = static_cast<long double>(targets.y[i]) - sources.y[j];
            const long double d = std::sqrt(dx * dx + dy * dy);
            if (d == 0) continue;
            sum += sources.f[j] / d;
            magnitude += std::abs(sources.f[j]) / d;
        }
        phi[i] = double(sum);
        size[i] = double(magnitude);
    }
}

// Largest |a - b| / size; NaN counts as infinite.
template <class T>
double distance(const std::vector<T>& a, const std::vector<double>& b,
                const std::vector<double>& size) {
    double largest = 0;
    for (const auto i : indices(b)) {
        const double error = std::abs(double(a[i]) - b[i]);
        const double relative = size[i] > 0 ? error / size[i] : error;
        if (!(relative <= largest)) largest = std::isnan(relative) ? kInfinity : relative;
    }
    return largest;
}

// Rounding of a term: difference, square, root and sum, some 4 units of 2^-53, and sums of at most
// 512 terms before they are gathered.
constexpr double kDouble = 2e-15;
// One Newton step on 12 bits: 2e-7; sums of some hundred terms in 24 bits: 5e-7.
constexpr double kSingle = 2e-6;

// The fixed-point coordinates of the single loop keep (extent / d) 2^-31 of a pair's term.
double single_tolerance(const Points& p) {
    double closest2 = kInfinity, extent2 = 0;
    for (const auto i : indices(p))
        for (const std::size_t j : indices(i)) {
            const double d2 = std::pow(p.x[i] - p.x[j], 2) + std::pow(p.y[i] - p.y[j], 2);
            if (d2 > 0) closest2 = std::min(closest2, d2);
            extent2 = std::max(extent2, d2);
        }
    return kSingle + 0x1p-31 * std::sqrt(extent2 / closest2);
}

// The sums of 1/d.
const Kernel& unit_kernel() {
    static const auto kernel = make_kernel(Interaction::point, 1 / pi);
    return *kernel;
}

// in_single: potentials are within the range of float.
void check_all_products(const Points& p, const char* name, bool in_single = true) {
    const std::size_t n = p.size();
    const int before = check::failures;
    std::vector<double> phi(n), exact, size;
    truth(p, p, exact, size);
    PairSums sums(unit_kernel());
    sums.assign(n, p.x.data(), p.y.data());
    for (const bool single : {false, true}) {
        const double tolerance = single ? single_tolerance(p) : kDouble;
        sums.onto(single, n, p.x.data(), p.y.data(), p.f.data(), phi.data());
        CHECK_CLOSE(distance(phi, exact, size), 0, tolerance);
        if (single && !in_single) continue;
        sums.among(single, p.f.data(), phi.data());
        CHECK_CLOSE(distance(phi, exact, size), 0, tolerance);
    }
    if (check::failures > before) std::printf("  (in %s, n = %zu)\n", name, n);
}

TEST(sizes_and_shapes) {
    for (std::size_t n : {0, 1, 2, 3, 15, 16, 17, 31, 100, 511, 512, 513, 1300})
        check_all_products(random_points(n, 1), "uniform");
    check_all_products(random_points(300, 2, 1e-7, 0), "tiny lengths");
    check_all_products(random_points(300, 3, 1e150, 0), "huge lengths", false);
    check_all_products(random_points(300, 4, 1e-160, 0), "lengths whose squares underflow", false);
    check_all_products(random_points(300, 5, 0x1p-10, 1000), "far from the origin");
    Points line = random_points(400, 6);
    std::ranges::fill(line.y, 3.5);
    check_all_products(line, "collinear");
    Points forces = random_points(300, 7);
    for (double& f : forces.f) f *= 1e-35;
    check_all_products(forces, "tiny forces");
}

// Points at the same place do not act on each other, and all points together at one place not at
// all.
TEST(coincident) {
    Points p = random_points(100, 9);
    for (std::size_t i = 0; i < 40; ++i) {
        p.x[i + 50] = p.x[i];
        p.y[i + 50] = p.y[i];
    }
    check_all_products(p, "coincident pairs");
    for (const auto i : indices(p)) {
        p.x[i] = 0.1;
        p.y[i] = -7;
    }
    check_all_products(p, "one place");
    PairSums sums(unit_kernel());
    sums.assign(100, p.x.data(), p.y.data());
    std::vector<double> phi(100, 1.0);
    sums.among(false, p.f.data(), phi.data());
    CHECK(std::ranges::all_of(phi, [](double v) { return v == 0; }));
}

// Every table against plain sums, the loops by themselves: 48 points i, 80 points j, already
// padded.
TEST(instruction_sets) {
    constexpr std::size_t ni = 48, nj = 80, n = ni + nj;
    const Points p = random_points(n, 12);
    std::vector<double> exact, size;
    truth(p, p, exact, size);
    std::vector<std::int32_t> x(n), y(n);
    std::vector<float> f(p.f.begin(), p.f.end());
    const double unit = 0x1p30;
    for (const std::size_t i : indices(n)) {
        x[i] = std::int32_t(p.x[i] * unit);
        y[i] = std::int32_t(p.y[i] * unit);
    }
    int found = 0;
    for (const char* name : {"generic", "sse2", "avx2", "avx512"}) {
        const PairKernels* k = pair_kernels(name);
        if (!k) continue;
        ++found;
        std::vector<double> phi(n, 0.0);
        k->exact.self(n, p.x.data(), p.y.data(), p.f.data(), phi.data());
        CHECK_CLOSE(distance(phi, exact, size), 0, kDouble);
        phi.assign(n, 0.0);
        const auto split = [&](auto self, auto cross, auto* px, auto* py, auto* pf, auto* to) {
            self(ni, px, py, pf, to);
            self(nj, px + ni, py + ni, pf + ni, to + ni);
            cross(ni, px, py, pf, to, nj, px + ni, py + ni, pf + ni, to + ni);
        };
        split(k->exact.self, k->exact.cross, p.x.data(), p.y.data(), p.f.data(), phi.data());
        CHECK_CLOSE(distance(phi, exact, size), 0, kDouble);
        phi.assign(n, 0.0);
        k->exact.onto(n, p.x.data(), p.y.data(), phi.data(), n, p.x.data(), p.y.data(), p.f.data());
        CHECK_CLOSE(distance(phi, exact, size), 0, kDouble);

        const auto scaled = [&](std::vector<float> v) {
            for (float& a : v) a *= float(unit / kSingleWeight);
            return v;
        };
        std::vector<float> single(n, 0.0f);
        k->single.self(n, x.data(), y.data(), f.data(), single.data());
        CHECK_CLOSE(distance(scaled(single), exact, size), 0, kSingle);
        single.assign(n, 0.0f);
        split(k->single.self, k->single.cross, x.data(), y.data(), f.data(), single.data());
        CHECK_CLOSE(distance(scaled(single), exact, size), 0, kSingle);
        single.assign(n, 0.0f);
        k->single.onto(n, x.data(), y.data(), single.data(), n, x.data(), y.data(), f.data());
        CHECK_CLOSE(distance(scaled(single), exact, size), 0, kSingle);
    }
    // What this machine has is there, and the widest of it is the one in use.
    const char* widest = "generic";
#if defined(__x86_64__)
    widest = "sse2";
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) widest = "avx2";
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        widest = "avx512";
#endif
    CHECK(std::string(pair_kernels().name) == widest);
    CHECK(found == (widest == std::string("avx512") ? 3 : widest == std::string("avx2") ? 2 : 1));
    CHECK(pair_kernels("no such set") == nullptr);
    CHECK(pair_kernels(pair_kernels().name) == &pair_kernels());
}

TEST(bad_coordinates) {
    Points p = random_points(5, 15);
    p.y[3] = std::nan("");
    PairSums sums(unit_kernel());
    CHECK_THROWS(sums.assign(5, p.x.data(), p.y.data()), Error);
    std::vector<double> phi(5);
    sums.assign(5, p.x.data(), p.x.data());
    CHECK_THROWS(sums.onto(false, 5, p.x.data(), p.y.data(), p.f.data(), phi.data()), Error);
    // A force that is not a number does not vanish on the way.
    p.y[3] = 0.5;
    p.f[2] = std::nan("");
    sums.assign(5, p.x.data(), p.y.data());
    sums.among(false, p.f.data(), phi.data());
    CHECK(std::isnan(phi[0]) && std::isnan(phi[4]));
}

}  // namespace test_pairs
