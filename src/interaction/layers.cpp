#include "interaction/layers.hpp"

#include <boost/math/special_functions/bessel.hpp>

#include "base/error.hpp"
#include "base/format.hpp"

namespace rsc {
namespace {

using Matrix = std::array<std::array<double, 4>, 4>;
// Displacements (along, down) per traction (shear, normal) over 2 mu of the material above.
struct Compliance {
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

// exp(-A x - x) for the state equations y' = A y, y = (u, w, shear/2mu, normal/2mu), with depths in
// units of 1/k. A has the double eigenvalues 1 and -1; with N = A^2 - I, N^2 = 0: exp(-A x) = cosh
// x + x sinh x N/2 - A [sinh x + (x cosh x - sinh x) N/2].
Matrix carried_up(double nu, double x) {
    const double p = nu / (1 - nu);
    const Matrix A = {{{0, 1, 2, 0},
                       {-p, 0, 0, (1 - 2 * nu) / (1 - nu)},
                       {1 / (1 - nu), 0, 0, p},
                       {0, 0, -1, 0}}};
    Matrix N = product(A, A);
    for (std::size_t i = 0; i < 4; ++i) N[i][i] -= 1;
    const Matrix AN = product(A, N);
    const double ch = 0.5 * (1 + std::exp(-2 * x)), sh = -0.5 * std::expm1(-2 * x),
                 rest = cosh_less_sinh(x, ch, sh);
    Matrix sum{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            sum[i][j] =
                (i == j ? ch : 0) + 0.5 * x * sh * N[i][j] - sh * A[i][j] - 0.5 * rest * AN[i][j];
    return sum;
}

double plane_modulus(double E, double nu) { return E / (1 - nu * nu); }
double shear_modulus(double E, double nu) { return E / (2 * (1 + nu)); }

void require_usable(const LayeredBody& body) {
    const auto refuse = [](std::size_t i, const char* what, double value, const char* expected) {
        throw Error(Failure::bad_input,
                    format("%s of layer %zu is %.9g; it must be %s", what, i + 1, value, expected));
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(body.count); ++i) {
        const Layer& layer = body.layer[i];
        if (!(layer.thickness > 0) || std::isinf(layer.thickness))
            refuse(i, "the thickness", layer.thickness, "positive and finite");
        if (!(layer.E > 0) || std::isinf(layer.E))
            refuse(i, "Young's modulus", layer.E, "positive and finite");
        if (!(layer.nu > -1 && layer.nu <= 0.5))
            refuse(i, "Poisson's ratio", layer.nu, "above -1 and at most 0.5");
    }
}

// For larger k times the thickness of the top layer, T is 1 to rounding.
constexpr double kShallow = 22;

// F = T - 1 on a logarithmic grid of wavenumbers, and its Hankel transform int F J0(k d) dk on a
// logarithmic grid of distances. On these the transform is a convolution, and the trapezoidal rule
// converges exponentially because F is analytic in a sector about the real axis.
// J0 is truncated smoothly, with an error below 1e-12. The part F(0) exp(-k z), with the transform
// F(0)/sqrt(d^2 + z^2), is subtracted first; the rest vanishes at k = 0, and its transform decays
// like 1/d^3.
class Hankel {
public:
    explicit Hankel(const LayeredBody& body) {
        const auto layers = static_cast<std::size_t>(body.count);
        double depth = 0, stiffest = 0, softest = body.E;
        for (std::size_t l = 0; l < layers; ++l) {
            depth += body.layer[l].thickness;
            stiffest = std::max(stiffest, body.layer[l].E);
            softest = std::min(softest, body.layer[l].E);
        }
        // A stiff layer on a soft body bends over lengths much larger than its thickness.
        z_ = 2 * depth * std::max(1.0, std::cbrt(stiffest / softest));
        const Layer& top = body.layer[0];
        at_zero_ = plane_modulus(top.E, top.nu) / plane_modulus(body.E, body.nu) - 1;
        constexpr double longest = 1e-9, nearest = 1e-3, farthest = 1e5;
        highest_ = kShallow / top.thickness;
        const auto waves = static_cast<std::size_t>(std::log(highest_ * z_ / longest) / kStep) + 1;
        answer_.resize(waves);
        for (std::size_t i = 0; i < waves; ++i) answer_[i] = layered_answer(body, wave(i)) - 1;
        first_ = nearest * top.thickness;
        const auto places =
            static_cast<std::size_t>(std::log(farthest * z_ / first_) / (kStep * kEvery)) + kNodes;
        // J0(k d) from the smallest product k d to the largest relevant one.
        constexpr double end = 80, soft = 0.25, gone = 5.5;
        const double smallest = std::log(wave(waves - 1) * first_);
        std::vector<double> wavelet(waves + places * kEvery);
        for (std::size_t i = 0; i < wavelet.size(); ++i) {
            const double x = std::exp(smallest + kStep * static_cast<double>(i)),
                         late = std::log(x / end) / soft;
            wavelet[i] = late < gone ? 0.5 * std::erfc(late) * boost::math::cyl_bessel_j(0, x) : 0;
        }
        std::vector<double> weight(waves);  // beginning with the longest wave
        double sum = 0;
        for (std::size_t i = 0; i < waves; ++i) {
            const double k = wave(waves - 1 - i);
            weight[i] = kStep * k * (answer_[waves - 1 - i] - at_zero_ * std::exp(-k * z_));
            sum += weight[i];
        }
        at_middle_ = sum;
        rest_.resize(places);
        for (std::size_t j = 0; j < places; ++j) {
            double total = 0;
            for (std::size_t i = 0; i < waves; ++i) total += weight[i] * wavelet[i + j * kEvery];
            rest_[j] = total;
        }
    }

    double length() const { return z_; }
    // F at a wavenumber.
    double answer(double k) const {
        if (k >= highest_) return 0;
        const double place = std::log(highest_ / k) / kStep - 0.5;
        if (place > static_cast<double>(answer_.size() - kNodes)) return at_zero_;
        return between(answer_, place);
    }
    // Transform of F at a distance.
    double at(double d) const {
        const double whole = at_zero_ / std::hypot(d, z_);
        if (d <= first_)
            return whole + at_middle_ + (rest_[0] - at_middle_) * (d / first_) * (d / first_);
        const double place = std::log(d / first_) / (kStep * kEvery);
        return place > static_cast<double>(rest_.size() - kNodes) ? whole
                                                                  : whole + between(rest_, place);
    }

private:
    static constexpr double kStep = 0.02;
    static constexpr std::size_t kEvery = 2;   // number of steps between two distances
    static constexpr std::size_t kNodes = 10;  // interpolation nodes

    double wave(std::size_t i) const {
        return highest_ * std::exp(-kStep * (static_cast<double>(i) + 0.5));
    }

    // Lagrange interpolation between the values around `place`.
    static double between(const std::vector<double>& values, double place) {
        const auto first =
            static_cast<std::size_t>(std::clamp(std::floor(place) - (kNodes / 2 - 1), 0.0,
                                                static_cast<double>(values.size() - kNodes)));
        const double t = place - static_cast<double>(first);
        double sum = 0, weights = 0;  // barycentric formula
        double binomial = 1;
        for (std::size_t i = 0; i < kNodes; ++i) {
            const double off = t - static_cast<double>(i);
            if (off == 0) return values[first + i];
            const double w = binomial / off;
            sum += w * values[first + i];
            weights += w;
            binomial *= -static_cast<double>(kNodes - 1 - i) / static_cast<double>(i + 1);
        }
        return sum / weights;
    }

    double z_, at_zero_, highest_, first_, at_middle_;
    std::vector<double> answer_, rest_;
};

}  // namespace

double layered_answer(const LayeredBody& body, double k) {
    if (body.count == 0 || k * body.layer[0].thickness > kShallow) return 1;
    // Compliances of a half-space: -2 (1 - nu) and 1 - 2 nu over 2 mu (Johnson 1985, section 2.3);
    // 0 if rigid.
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
        c = {(up[0][0] * up[3][1] - up[0][1] * up[3][0]) / det,
             (up[0][1] * up[2][0] - up[0][0] * up[2][1]) / det,
             (up[1][1] * up[2][0] - up[1][0] * up[2][1]) / det};
    }
    return -c.bb / (2 * (1 - body.layer[0].nu));
}

std::shared_ptr<const SmoothPart> make_layers(const LayeredBody& body, double E_star) {
    require_usable(body);
    const double E_1 = plane_modulus(body.layer[0].E, body.layer[0].nu), near = 1 / (pi * E_1);
    const Hankel hankel(body);
    // T is smooth in k, so the table uses the square of sqrt(k). Its first pieces are much narrower
    // than 1/z.
    constexpr double pieces = 100;
    const double z = hankel.length();
    const auto answer = std::make_shared<const SquareTable>(
        std::sqrt(1 / (pieces * z)),
        [&](double root) { return hankel.answer(std::max(root * root, 1e-9 / z)); });
    const double part = E_star / E_1;
    return std::make_shared<const SmoothPart>(
        [&](double d) { return near * hankel.at(d); },
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
