// Direct pair sums against sums in long double, for every instruction set this machine has.
#include "check.hpp"
#include "contact/interaction/pairs.hpp"
#include "contact/interaction/pairs_kernel.hpp"
#include "error.hpp"

using namespace rsc;

namespace {

struct Points {
    std::vector<double> x, y, f;
    std::size_t size() const { return x.size(); }
};

Points random_points(std::size_t n, unsigned seed, double size = 1, double x0 = 0) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Points p{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
    for (std::size_t i = 0; i < n; ++i) {
        p.x[i] = x0 + size * uniform(engine);
        p.y[i] = size * uniform(engine);
        p.f[i] = uniform(engine) - 0.3;
    }
    return p;
}

// The truth, and the sum of |f_j| / d_ij that errors are measured against.
void truth(const Points& targets, const Points& sources, std::vector<double>& phi, std::vector<double>& size) {
    phi.assign(targets.size(), 0);
    size.assign(targets.size(), 0);
    for (std::size_t i = 0; i < targets.size(); ++i) {
        long double sum = 0, magnitude = 0;
        for (std::size_t j = 0; j < sources.size(); ++j) {
            const long double dx = static_cast<long double>(targets.x[i]) - sources.x[j];
            const long double dy = static_cast<long double>(targets.y[i]) - sources.y[j];
            const long double d = std::sqrt(dx * dx + dy * dy);
            if (d == 0) continue;
            sum += sources.f[j] / d;
            magnitude += std::abs(sources.f[j]) / d;
        }
        phi[i] = static_cast<double>(sum);
        size[i] = static_cast<double>(magnitude);
    }
}

// Largest |a - b| / size; NaN counts as infinite.
template <class T>
double distance(const std::vector<T>& a, const std::vector<double>& b, const std::vector<double>& size) {
    double largest = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const double error = std::abs(static_cast<double>(a[i]) - b[i]);
        const double relative = size[i] > 0 ? error / size[i] : error;
        if (!(relative <= largest)) largest = std::isnan(relative) ? std::numeric_limits<double>::infinity() : relative;
    }
    return largest;
}

// Rounding of a term: difference, square, root and sum, some 4 units of 2^-53, and sums of at most 512 terms before they are
// gathered.
constexpr double kDouble = 2e-15;
// One Newton step on 12 bits: 2e-7; sums of some hundred terms in 24 bits: 5e-7.
constexpr double kSingle = 2e-6;

// The fixed-point coordinates of the single loop keep (extent / d) 2^-31 of a pair's term.
double single_tolerance(const Points& p) {
    double closest2 = std::numeric_limits<double>::infinity(), extent2 = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double d2 = std::pow(p.x[i] - p.x[j], 2) + std::pow(p.y[i] - p.y[j], 2);
            if (d2 > 0) closest2 = std::min(closest2, d2);
            extent2 = std::max(extent2, d2);
        }
    return kSingle + 0x1p-31 * std::sqrt(extent2 / closest2);
}

// The sums of 1/d.
const Kernel& unit_kernel() {
    static const auto kernel = make_kernel(Interaction::point, 1 / std::numbers::pi);
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
    for (std::size_t n : {0, 1, 2, 3, 15, 16, 17, 31, 100, 511, 512, 513, 1300}) check_all_products(random_points(n, 1), "uniform");
    check_all_products(random_points(300, 2, 1e-7, 0), "tiny lengths");
    check_all_products(random_points(300, 3, 1e150, 0), "huge lengths", false);
    check_all_products(random_points(300, 4, 1e-160, 0), "lengths whose squares underflow", false);
    check_all_products(random_points(300, 5, 0x1p-10, 1000), "far from the origin");
    Points line = random_points(400, 6);
    std::fill(line.y.begin(), line.y.end(), 3.5);
    check_all_products(line, "collinear");
    Points forces = random_points(300, 7);
    for (double& f : forces.f) f *= 1e-35;
    check_all_products(forces, "tiny forces");
}

// Points at the same place do not act on each other, and all points together at one place not at all.
TEST(coincident) {
    Points p = random_points(100, 9);
    for (std::size_t i = 0; i < 40; ++i) p.x[i + 50] = p.x[i], p.y[i + 50] = p.y[i];
    check_all_products(p, "coincident pairs");
    for (std::size_t i = 0; i < p.size(); ++i) p.x[i] = 0.1, p.y[i] = -7;
    check_all_products(p, "one place");
    PairSums sums(unit_kernel());
    sums.assign(100, p.x.data(), p.y.data());
    std::vector<double> phi(100, 1.0);
    sums.among(false, p.f.data(), phi.data());
    CHECK(std::all_of(phi.begin(), phi.end(), [](double v) { return v == 0; }));
}

// Two strips by increasing x with a short-range kernel, against the same sums written down plainly. Points that coincide, one
// with itself included, get the smooth part alone.
void near_field(const PairKernels& k) {
    constexpr std::size_t room = kPairPadding;
    constexpr std::size_t ni = 45, nj = 77, begin_j = ni + room, n = begin_j + nj + room;
    Points p = random_points(n, 16);
    std::fill(p.x.begin(), p.x.end(), 4.0), std::fill(p.y.begin(), p.y.end(), 0.0);
    const Points inside = random_points(n, 17);
    for (std::size_t i = 0; i < n; ++i) {
        const bool first = i < ni, second = i >= begin_j && i < begin_j + nj;
        if (first || second)
            p.x[i] = inside.x[i], p.y[i] = 0.1 * inside.y[i] + (second ? 0.1 : 0.0);
        else
            p.f[i] = 0;
    }
    std::sort(p.x.begin(), p.x.begin() + ni);
    std::sort(p.x.begin() + begin_j, p.x.begin() + begin_j + nj);
    p.x[begin_j + 5] = p.x[begin_j + 4], p.y[begin_j + 5] = p.y[begin_j + 4];
    NearKernel near;
    near.reach = 0.15, near.cutoff2 = near.reach * near.reach, near.degree = 3;
    const double c[] = {6.0, 100.0, -3000.0, 2e4};
    std::copy(c, c + 4, near.c);
    std::vector<double> exact(n, 0.0), size(n, 0.0), phi(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const double d2 = std::pow(p.x[i] - p.x[j], 2) + std::pow(p.y[i] - p.y[j], 2), s = near.cutoff2 - d2;
            if (s <= 0) continue;
            const double w = (d2 > 0 ? 1 / std::sqrt(d2) : 0) - (((c[3] * s + c[2]) * s + c[1]) * s + c[0]);
            exact[i] += p.f[j] * w;
            size[i] += std::abs(p.f[j]) * (std::abs(w) + 6);
        }
    const double *x = p.x.data(), *y = p.y.data(), *f = p.f.data();
    k.near_own(near, ni, x, y, f, phi.data());
    k.near_own(near, nj, x + begin_j, y + begin_j, f + begin_j, phi.data() + begin_j);
    k.near_strips(near, ni, x, y, f, phi.data(), nj, x + begin_j, y + begin_j, f + begin_j, phi.data() + begin_j);
    for (std::size_t i = 0; i < n; ++i)
        if (p.x[i] == 4.0) phi[i] = exact[i];  // what pads get is nobody's
    CHECK_CLOSE(distance(phi, exact, size), 0, kDouble);
}

// Spreading is the transpose of interpolating, and both use the products of the weights as documented.
void mesh_window_loops(const PairKernels& k) {
    for (int width : {3, 4, 7, 8, 11, 16}) {
        MeshWindow window;
        window.width = width, window.degree = 2;
        for (int m = 0; m < width; ++m)
            for (int d = 0; d <= window.degree; ++d) window.c[d][m] = 1.0 / (1 + m + 2 * d);
        constexpr std::size_t stride = 48, rows = 40, n = 9;
        Points p = random_points(n, 18, 20.0, 0);
        p.x[3] = 5.0, p.y[3] = 7.5;  // on mesh lines
        for (std::size_t i = 0; i < n; ++i) p.x[i] += 0.5 * width, p.y[i] += 0.5 * width;
        std::vector<double> mesh(stride * rows, 0.0), exact = mesh;
        for (std::size_t i = 0; i < n; ++i) {
            const double u = p.x[i] - 0.5 * width, v = p.y[i] - 0.5 * width;
            const auto column = static_cast<std::size_t>(std::floor(u)) + 1, row = static_cast<std::size_t>(std::floor(v)) + 1;
            const double s = 2 * (static_cast<double>(column) - u) - 1, t = 2 * (static_cast<double>(row) - v) - 1;
            const auto weight = [&](std::size_t m, double z) { return window.c[0][m] + z * (window.c[1][m] + z * window.c[2][m]); };
            for (std::size_t r = 0; r < static_cast<std::size_t>(width); ++r)
                for (std::size_t m = 0; m < static_cast<std::size_t>(width); ++m)
                    exact[(row + r) * stride + column + m] += p.f[i] * weight(m, s) * weight(r, t);
        }
        k.spread(window, n, p.x.data(), p.y.data(), p.f.data(), mesh.data(), stride);
        CHECK_CLOSE(distance(mesh, exact, std::vector<double>(mesh.size(), 1.0)), 0, 1e-13);
        const Points values = random_points(stride * rows, 19);
        std::vector<double> phi(n);
        k.interpolate(window, n, p.x.data(), p.y.data(), phi.data(), values.f.data(), stride);
        double there = 0, back = 0;
        for (std::size_t m = 0; m < mesh.size(); ++m) there += mesh[m] * values.f[m];
        for (std::size_t i = 0; i < n; ++i) back += p.f[i] * phi[i];
        CHECK_CLOSE(there, back, 1e-12);
    }
}

// Every table against plain sums, the loops by themselves: 48 points i, 80 points j, already padded.
TEST(instruction_sets) {
    constexpr std::size_t ni = 48, nj = 80, n = ni + nj;
    const Points p = random_points(n, 12);
    std::vector<double> exact, size;
    truth(p, p, exact, size);
    std::vector<std::int32_t> x(n), y(n);
    std::vector<float> f(p.f.begin(), p.f.end());
    const double unit = 0x1p30;
    for (std::size_t i = 0; i < n; ++i) x[i] = static_cast<std::int32_t>(p.x[i] * unit), y[i] = static_cast<std::int32_t>(p.y[i] * unit);
    int found = 0;
    for (const char* name : {"generic", "sse2", "avx2", "avx512"}) {
        const PairKernels* k = pair_kernels(name);
        if (!k) continue;
        ++found;
        std::printf("instruction set %s\n", k->name);
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
            for (float& a : v) a *= static_cast<float>(unit / kSingleWeight);
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

        near_field(*k);
        mesh_window_loops(*k);
    }
    // What this machine has is there, and the widest of it is the one in use.
    const char* widest = "generic";
#if defined(__x86_64__)
    widest = "sse2";
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) widest = "avx2";
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) widest = "avx512";
#endif
    CHECK(std::string(pair_instruction_set()) == widest);
    CHECK(found == (widest == std::string("avx512") ? 3 : widest == std::string("avx2") ? 2 : 1));
    CHECK(pair_kernels("no such set") == nullptr);
    CHECK(pair_kernels(pair_instruction_set()) == &pair_kernels());
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
    p.y[3] = 0.5, p.f[2] = std::nan("");
    sums.assign(5, p.x.data(), p.y.data());
    sums.among(false, p.f.data(), phi.data());
    CHECK(std::isnan(phi[0]) && std::isnan(phi[4]));
}

}  // namespace
