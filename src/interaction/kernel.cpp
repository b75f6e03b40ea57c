#include "interaction/kernel.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "base/dispatch.hpp"
#include "base/error.hpp"
#include "interaction/layers.hpp"
#include "interaction/pixel_kernels.hpp"

namespace rsc {
namespace {

constexpr int kDegree = SquareTable::kDegree, kOctavePieces = SquareTable::kPiecesPerOctave;
constexpr std::size_t kPieces = SquareTable::kPieces;

// For y >= 1, the exponent and the first six bits of the mantissa number the piece; the other bits
// are the position within it.
constexpr int kBits = 6, kShift = 52 - kBits;
static_assert(kOctavePieces == 1 << kBits);
constexpr std::uint64_t kFirst = std::uint64_t{1023} << kBits,
                        kRest = (std::uint64_t{1} << kShift) - 1, kOne = std::uint64_t{1023} << 52;
constexpr double kMiddle = 1 + 0.5 / kOctavePieces;

constexpr std::size_t kBlock = SquareTable::kBlock;  // sources processed together

struct Task {
    std::size_t n;
    double inverse_square;
    const double *squares, *coefficient;
    double* value;
};

RSC_ALWAYS_INLINE void table_body(const Task& task) {
    std::uint64_t piece[kBlock];
    double t[kBlock], sum[kBlock];
    for (std::size_t j = 0; j < task.n; ++j) {
        const auto bits = std::bit_cast<std::uint64_t>(1 + task.squares[j] * task.inverse_square);
        const std::uint64_t number = (bits >> kShift) - kFirst;
        piece[j] = number < kPieces ? number : kPieces - 1;
        t[j] = std::bit_cast<double>((bits & kRest) | kOne) - kMiddle;
    }
    for (std::size_t j = 0; j < task.n; ++j)
        sum[j] = task.coefficient[kDegree * kPieces + piece[j]];
    for (int k = kDegree - 1; k >= 0; --k)
        for (std::size_t j = 0; j < task.n; ++j)
            sum[j] =
                sum[j] * t[j] + task.coefficient[static_cast<std::size_t>(k) * kPieces + piece[j]];
    for (std::size_t j = 0; j < task.n; ++j) task.value[j] = sum[j];
}

RSC_DISPATCH(table_values, table_body, (const Task& task), (task))

}  // namespace

SquareTable::SquareTable(double unit, const std::function<double(double)>& value)
    : unit_(unit),
      inverse_square_(1 / (unit * unit)),
      coefficient_((kDegree + 1) * kPieces),
      sum_(kPieces) {
    constexpr int nodes = kDegree + 1;
    constexpr double half = 0.5 / kOctavePieces;  // half width of a piece relative to its octave
    // Interpolation at Chebyshev points by Newton's divided differences, converted to powers.
    double place[nodes];
    for (int i = 0; i < nodes; ++i) place[i] = half * std::cos(pi * (i + 0.5) / nodes);
    double before = 0;
    for (std::size_t piece = 0; piece < kPieces; ++piece) {
        const double octave = std::ldexp(1.0, static_cast<int>(piece / kOctavePieces));
        const double middle =
            1 + (static_cast<double>(piece % kOctavePieces) + 0.5) / kOctavePieces;
        double difference[nodes], power[nodes] = {};
        for (int i = 0; i < nodes; ++i)
            difference[i] =
                value(unit * std::sqrt(std::max(0.0, octave * (middle + place[i]) - 1)));
        for (int k = 1; k < nodes; ++k)
            for (int i = nodes - 1; i >= k; --i)
                difference[i] = (difference[i] - difference[i - 1]) / (place[i] - place[i - k]);
        for (int i = nodes - 1; i >= 0; --i) {
            for (int k = nodes - 1; k > 0; --k) power[k] = power[k - 1] - place[i] * power[k];
            power[0] = difference[i] - place[i] * power[0];
        }
        for (std::size_t k = 0; k < nodes; ++k) coefficient_[k * kPieces + piece] = power[k];
        sum_[piece] = before;
        for (int k = 0; k < nodes; k += 2)
            before += octave * 2 * power[k] * std::pow(half, k + 1) / (k + 1);
    }
}

namespace {

// The piece of y = 1 + t^2/unit^2, and the distance from its middle relative to its octave.
std::pair<std::size_t, double> piece_of(double y) {
    const auto bits = std::bit_cast<std::uint64_t>(y);
    return {std::min<std::uint64_t>((bits >> kShift) - kFirst, kPieces - 1),
            std::bit_cast<double>((bits & kRest) | kOne) - kMiddle};
}

}  // namespace

double SquareTable::at_square(double t2) const {
    const auto [piece, t] = piece_of(1 + t2 * inverse_square_);
    double sum = coefficient_[kDegree * kPieces + piece];
    for (std::size_t k = kDegree; k-- > 0;) sum = sum * t + coefficient_[k * kPieces + piece];
    return sum;
}

void SquareTable::values(std::size_t n, const double* squares, double* value) const {
    table_values({n, inverse_square_, squares, coefficient_.data(), value});
}

double SquareTable::moment(double t) const {
    const auto [piece, to] = piece_of(1 + t * t * inverse_square_);
    constexpr double half = 0.5 / kOctavePieces;
    double sum = 0, high = to, low = -half;
    for (std::size_t k = 0; k <= kDegree; ++k, high *= to, low *= -half)
        sum += coefficient_[k * kPieces + piece] * (high - low) / static_cast<double>(k + 1);
    return 0.5 * unit_ * unit_ *
           (sum_[piece] + std::ldexp(sum, static_cast<int>(piece / kOctavePieces)));
}

void SquareTable::add(std::size_t n_targets, const double* xt, const double* yt,
                      std::size_t n_sources, const double* xs, const double* ys, const double* f,
                      double* to) const {
    // If sources and targets are the same points, each value is used for both directions of a pair.
    const bool same = xt == xs && yt == ys && n_targets == n_sources;
    double x[kBlock], y[kBlock], force[kBlock], square[kBlock], value[kBlock], back[kBlock];
    for (std::size_t j = 0; j < n_sources; j += kBlock) {
        const std::size_t count = std::min(kBlock, n_sources - j);
        for (std::size_t k = 0; k < kBlock; ++k) {
            const std::size_t from = j + std::min(k, count - 1);
            x[k] = xs[from];
            y[k] = ys[from];
            force[k] = k < count ? f[from] : 0;
            back[k] = 0;
        }
        for (std::size_t i = 0; i < (same ? j + count : n_targets); ++i) {
            for (std::size_t k = 0; k < kBlock; ++k)
                square[k] = (xt[i] - x[k]) * (xt[i] - x[k]) + (yt[i] - y[k]) * (yt[i] - y[k]);
            values(kBlock, square, value);
            double sum = 0;
            for (std::size_t k = 0; k < kBlock; ++k) sum += force[k] * value[k];
            to[i] += sum;
            if (!same || i >= j) continue;
            for (std::size_t k = 0; k < kBlock; ++k) back[k] += f[i] * value[k];
        }
        for (std::size_t k = 0; same && k < count; ++k) to[j + k] += back[k];
    }
}

SmoothPart::SmoothPart(const std::function<double(double)>& s, std::function<double(double)> share,
                       double scale)
    : table_(scale, s), share_(std::move(share)) {}

// Integral over the rectangle from 0 to (s, t), in polar coordinates by one triangle at each axis.
// For a triangle with the far side x = s and y = x sinh(v) it is the integral of moment(x cosh
// v)/cosh v dv.
double SmoothPart::corner(double s, double t) const {
    const double x = std::abs(s), y = std::abs(t);
    const auto triangle = [this](double side, double end) {
        if (!(side > 0) || !(end > 0)) return 0.0;
        const double most = std::asinh(end / side);
        const int panels = 1 + static_cast<int>(most / 3);
        double sum = 0;
        for (int k = 0; k < panels; ++k) {
            sum += boost::math::quadrature::gauss<double, 20>::integrate(
                [&](double v) { return table_.moment(side * std::cosh(v)) / std::cosh(v); },
                most * k / panels, most * (k + 1) / panels);
        }
        return sum;
    };
    const double sum = triangle(x, y) + triangle(y, x);
    return (s < 0) == (t < 0) ? sum : -sum;
}

// Integral over the rectangle by the Gauss rule of n x n points.
template <unsigned n>
double SmoothPart::by_points(double x, double y, double a, double b) const {
    using Rule = boost::math::quadrature::gauss<double, n>;
    return a * b * Rule::integrate([&](double u) {
               const double dx = x + a * u;
               return Rule::integrate([&](double v) {
                   const double dy = y + b * v;
                   return at_square(dx * dx + dy * dy);
               });
           });
}

double SmoothPart::over_rectangle(double x, double y, double a, double b) const {
    // With singularities of s at m half sides from the rectangle, the error of n points falls like
    // (m + sqrt(m^2 + 1))^(-2 n); here to 1e-10.
    const double half = std::max(a, b);
    const double m =
        std::hypot(scale(), std::max(std::abs(x) - a, 0.0), std::max(std::abs(y) - b, 0.0)) / half;
    if (m > 25) return by_points<3>(x, y, a, b);
    if (m > 4) return by_points<6>(x, y, a, b);
    if (m > 1.5) return by_points<10>(x, y, a, b);
    return corner(x + a, y + b) - corner(x + a, y - b) - corner(x - a, y + b) +
           corner(x - a, y - b);
}

Substrate::Substrate(double E_star, std::shared_ptr<const SmoothPart> smooth)
    : E_star_(E_star), smooth_(std::move(smooth)) {
    if (!smooth_) return;
    // 1/(pi E* d) dominates at small distances; far away both terms are proportional to 1/d.
    for (double d = 0.01 * smooth_->scale(); d < 1e4 * smooth_->scale(); d *= 1.01)
        bulge_ = std::max(bulge_, 0 - near() / d - smooth_->at(d));
    bulge_ *= 1 + 1e-3;  // margin for maxima between the sampled distances
}

double Substrate::near() const { return 1 / (pi * E_star_); }

double Substrate::under_pixel(double x, double y, double dx, double dy) const {
    double sum = near() * dx * pixel_kernel(x / dx, y / dx, dy / dx);
    if (smooth_) sum += smooth_->over_rectangle(x, y, 0.5 * dx, 0.5 * dy);
    return sum;
}

Kernel::Kernel(Interaction interaction, Substrate substrate, Period period)
    : substrate_(std::move(substrate)) {
    if (interaction == Interaction::none) return;
    near_ = substrate_.near();
    if (period.finite()) lattice_.emplace(period, smooth(), near_);
    shift_ = lattice_ ? -near_ * lattice_->least() : substrate_.bulge();
}

double Kernel::at(double dx, double dy) const {
    if (none()) return 0;
    if (lattice_) return near_ * (lattice_->at(dx, dy) - lattice_->least());
    const double d2 = dx * dx + dy * dy, point = near_ / std::sqrt(d2);
    return smooth() ? point + smooth()->at_square(d2) + shift_ : point;
}

std::shared_ptr<const Kernel> make_kernel(Interaction interaction, Substrate substrate,
                                          Period period) {
    return std::make_shared<const Kernel>(interaction, std::move(substrate), period);
}

}  // namespace rsc
