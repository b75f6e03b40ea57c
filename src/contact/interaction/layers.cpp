#include "contact/interaction/layers.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "error.hpp"
#include "format.hpp"

namespace rsc {
namespace {

using Matrix = std::array<std::array<double, 4>, 4>;
struct Compliance {  // displacements (along, down) per traction (shear, normal) over 2 mu of the material above
    double aa, ab, bb;
};

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
}

// (x cosh x - sinh x) exp(-x).
double cosh_less_sinh(double x, double ch, double sh) {
    if (x > 0.5) return x * ch - sh;
    double sum = 0, term = x * x * x / 3;  // sum of x^(2k+1) 2k/(2k+1)!
    for (int k = 1; k < 12; ++k) {
        sum += term;
        term *= x * x * (2 * k + 2) / ((2.0 * k) * (2 * k + 2) * (2 * k + 3));
    }
    return sum * std::exp(-x);
}

// exp(-A x - x) for the state equations y' = A y, y = (u, w, shear/2mu, normal/2mu), with depths in units of 1/k. A has the double
// eigenvalues 1 and -1; with N = A^2 - I, N^2 = 0: exp(-A x) = cosh x + x sinh x N/2 - A [sinh x + (x cosh x - sinh x) N/2].
Matrix carried_up(double nu, double x) {
    const double p = nu / (1 - nu);
    const Matrix A = {{{0, 1, 2, 0}, {-p, 0, 0, (1 - 2 * nu) / (1 - nu)}, {1 / (1 - nu), 0, 0, p}, {0, 0, -1, 0}}};
    Matrix N = product(A, A);
    for (std::size_t i = 0; i < 4; ++i) N[i][i] -= 1;
    const Matrix AN = product(A, N);
    const double ch = 0.5 * (1 + std::exp(-2 * x)), sh = -0.5 * std::expm1(-2 * x), rest = cosh_less_sinh(x, ch, sh);
    Matrix sum{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) sum[i][j] = (i == j ? ch : 0) + 0.5 * x * sh * N[i][j] - sh * A[i][j] - 0.5 * rest * AN[i][j];
    return sum;
}

double plane_modulus(double E, double nu) { return E / (1 - nu * nu); }
double shear_modulus(double E, double nu) { return E / (2 * (1 + nu)); }

void require_usable(const LayeredBody& body) {
    const auto refuse = [](std::size_t i, const char* what, double value, const char* wanted) {
        throw Error(Failure::bad_input, format("%s of layer %zu is %.9g; it must be %s", what, i + 1, value, wanted));
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(body.count); ++i) {
        const Layer& layer = body.layer[i];
        if (!(layer.thickness > 0) || std::isinf(layer.thickness)) refuse(i, "the thickness", layer.thickness, "positive and finite");
        if (!(layer.E > 0) || std::isinf(layer.E)) refuse(i, "Young's modulus", layer.E, "positive and finite");
        if (!(layer.nu > -1 && layer.nu <= 0.5)) refuse(i, "Poisson's ratio", layer.nu, "above -1 and at most 0.5");
    }
}

// For larger k times the thickness of the top layer, T is 1 to rounding.
constexpr double kShallow = 22;

// Coefficients of T - 1 = sum a_n exp(-k z) L_n(2 k z), n < count: a_n = 2 z int (T - 1) exp(-k z) L_n(2 k z) dk, integrated over sqrt(k),
// in which the phase of L_n grows uniformly.
std::vector<double> laguerre(const LayeredBody& body, double z, int count) {
    constexpr int nodes = 20;
    using Gauss = boost::math::quadrature::gauss<double, nodes>;
    const double top = std::sqrt(kShallow / body.layer[0].thickness), phase = 2 * std::sqrt(2.0 * count * z) * top;
    const int panels = 8 + static_cast<int>(phase / 15);
    const double half = 0.5 * top / panels;
    std::vector<double> a(static_cast<std::size_t>(count));
    for (int panel = 0; panel < panels; ++panel)
        for (int i = 0; i < nodes; ++i) {
            const auto m = static_cast<std::size_t>(i / 2);
            const double at = i % 2 ? -Gauss::abscissa()[m] : Gauss::abscissa()[m];
            const double q = half * (2 * panel + 1 + at), k = q * q;
            const double weight = Gauss::weights()[m] * half * 2 * q * 2 * z * (layered_answer(body, k) - 1);
            // Long double, because exp(-k z) of the longest series underflows in double, but its products do not.
            const long double y = 2 * static_cast<long double>(k) * z;
            long double before = std::exp(-y / 2), now = (1 - y) * before;
            a[0] += weight * static_cast<double>(before);
            for (int n = 1; n < count; ++n) {
                a[static_cast<std::size_t>(n)] += weight * static_cast<double>(now);
                const long double next = ((2 * n + 1 - y) * now - n * before) / (n + 1);
                before = now, now = next;
            }
        }
    return a;
}

struct Series {
    double z;
    std::vector<double> a;

    // Sum of a_n P_n(u)/R.
    double at(double d) const {
        const double R = std::hypot(d, z), u = (d - z) * (d + z) / (R * R);
        double before = 1, now = u, sum = a[0];
        for (std::size_t n = 1; n < a.size(); ++n) {
            sum += a[n] * now;
            const double m = static_cast<double>(n), next = ((2 * m + 1) * u * now - m * before) / (m + 1);
            before = now, now = next;
        }
        return sum / R;
    }
};

// Finds a depth z for which the series converges in few terms. The important modes are near k z = 1: a stiff layer on a soft base bends
// over lengths much larger than its thickness.
Series expand(const LayeredBody& body) {
    constexpr double tolerance = 2e-11, step = 1.6;
    constexpr int shortest = 48, longest = 3072, tail = 8;
    const auto layers = static_cast<std::size_t>(body.count);
    double depth = 0, stiffest = 0, softest = body.E;
    for (std::size_t l = 0; l < layers; ++l) {
        depth += body.layer[l].thickness;
        stiffest = std::max(stiffest, body.layer[l].E);
        softest = std::min(softest, body.layer[l].E);
    }
    double low = 3 * body.layer[0].thickness, high = 10 * depth * std::max(1.0, std::cbrt(stiffest / softest));
    for (int count = shortest; count <= longest; count *= 2) {
        double least = HUGE_VAL, best = low;
        for (double z = low; z <= high; z *= step) {
            std::vector<double> a = laguerre(body, z, count);
            double largest = 1, last = 0;
            for (double v : a) largest = std::max(largest, std::abs(v));
            for (int k = 1; k <= tail; ++k) last = std::max(last, std::abs(a[a.size() - static_cast<std::size_t>(k)]));
            if (last <= tolerance * largest) return {z, std::move(a)};
            if (last / largest < least) least = last / largest, best = z;
        }
        low = best / step, high = best * step * 1.01;
    }
    throw Error(Failure::bad_input,
                format("the layers and the base differ too much in stiffness or thickness for a series of %d terms", longest));
}

}  // namespace

double layered_answer(const LayeredBody& body, double k) {
    if (body.count == 0 || k * body.layer[0].thickness > kShallow) return 1;
    // Compliances of a half-space: -2 (1 - nu) and 1 - 2 nu over 2 mu (Johnson 1985, section 2.3); 0 if rigid.
    const bool rigid = std::isinf(body.E);
    Compliance c{};
    double mu = shear_modulus(body.E, body.nu);
    if (!rigid) c = {-2 * (1 - body.nu), 1 - 2 * body.nu, -2 * (1 - body.nu)};
    for (std::size_t l = static_cast<std::size_t>(body.count); l-- > 0;) {
        const Layer& layer = body.layer[l];
        const double own = shear_modulus(layer.E, layer.nu), ratio = std::isinf(mu) ? 0 : own / mu;
        const double x = k * layer.thickness;
        c = {c.aa * ratio, c.ab * ratio, c.bb * ratio};
        mu = own;
        if (x > 300) {  // no effect of the material below
            c = {-2 * (1 - layer.nu), 1 - 2 * layer.nu, -2 * (1 - layer.nu)};
            continue;
        }
        const Matrix P = carried_up(layer.nu, x);
        double up[4][2];  // state at the top for unit tractions at the bottom
        for (std::size_t i = 0; i < 4; ++i) {
            up[i][0] = P[i][0] * c.aa + P[i][1] * c.ab + P[i][2];
            up[i][1] = P[i][0] * c.ab + P[i][1] * c.bb + P[i][3];
        }
        const double det = up[2][0] * up[3][1] - up[2][1] * up[3][0];
        c = {(up[0][0] * up[3][1] - up[0][1] * up[3][0]) / det, (up[0][1] * up[2][0] - up[0][0] * up[2][1]) / det,
             (up[1][1] * up[2][0] - up[1][0] * up[2][1]) / det};
    }
    return -c.bb / (2 * (1 - body.layer[0].nu));
}

std::shared_ptr<const SmoothPart> make_layers(const LayeredBody& body, double E_star) {
    require_usable(body);
    const double E_1 = plane_modulus(body.layer[0].E, body.layer[0].nu), near = 1 / (std::numbers::pi * E_1);
    const Series series = expand(body);
    // T is smooth in k, so the table uses the square of sqrt(k). Its first pieces are much narrower than 1/z.
    constexpr double pieces = 100;
    const auto answer = std::make_shared<const SquareTable>(
        std::sqrt(1 / (pieces * series.z)), [&](double root) { return layered_answer(body, std::max(root * root, 1e-9 / series.z)) - 1; });
    const double part = E_star / E_1;
    return std::make_shared<const SmoothPart>([&](double d) { return near * series.at(d); },
                                              [answer, part](double k) { return part * answer->at_square(k); },
                                              2 * body.layer[0].thickness);
}

std::shared_ptr<const SmoothPart> layers_of(const LayeredBody& body, double E_star) {
    if (body.count == 0) return nullptr;
    struct Made {
        LayeredBody body;
        double E_star;
        std::weak_ptr<const SmoothPart> smooth;
    };
    static std::mutex mutex;
    static std::vector<Made> all;
    const std::lock_guard lock(mutex);
    std::erase_if(all, [](const Made& made) { return made.smooth.expired(); });
    for (const Made& made : all)
        if (made.E_star == E_star && made.body == body)
            if (auto smooth = made.smooth.lock()) return smooth;
    auto smooth = make_layers(body, E_star);
    all.push_back({body, E_star, smooth});
    return smooth;
}

}  // namespace rsc
