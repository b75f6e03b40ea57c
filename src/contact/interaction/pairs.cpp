#include "contact/interaction/pairs.hpp"

#include "contact/interaction/pairs_kernel.hpp"
#include "error.hpp"
#include "format.hpp"

namespace rsc {

namespace {

// Tile size: a set of columns stays in the first-level cache for all rows, and single-precision partial sums, accumulated in double
// precision, stay short enough to be accurate.
constexpr std::size_t kTile = 512;

std::size_t padded(std::size_t n) { return (n + kPairPadding - 1) / kPairPadding * kPairPadding; }

struct Box {
    double x_min = HUGE_VAL, x_max = -HUGE_VAL, y_min = HUGE_VAL, y_max = -HUGE_VAL;
    double extent() const { return std::max(x_max - x_min, y_max - y_min); }
};

void enclose(Box& box, std::size_t n, const double* x, const double* y, const char* what) {
    for (std::size_t i = 0; i < n; ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
            throw Error(Failure::bad_input, std::string(what) + " point " + std::to_string(i + 1) + ": coordinates (" + text_of(x[i]) +
                                                ", " + text_of(y[i]) + ") must be finite");
        box.x_min = std::min(box.x_min, x[i]), box.x_max = std::max(box.x_max, x[i]);
        box.y_min = std::min(box.y_min, y[i]), box.y_max = std::max(box.y_max, y[i]);
    }
}

// Power of two that scales the extent to between 1/2 and 1, where single-precision estimates neither overflow nor underflow.
double unit_scale(const Box& box) {
    const double extent = box.extent();
    if (!(extent > 0)) return 1;
    if (!std::isfinite(extent)) throw Error(Failure::bad_input, "the points are too far apart: their extent overflows");
    return std::ldexp(1.0, std::clamp(-std::ilogb(extent) - 1, -1022, 1022));
}

// Scale of the fixed-point coordinates, whose differences fit in 31 bits.
double fixed_scale(const Box& box) { return box.extent() > 0 ? std::min(0x1.fffffep30 / box.extent(), 0x1p1000) : 1; }

std::int32_t fixed(double x, double origin, double scale) { return static_cast<std::int32_t>(std::lround((x - origin) * scale)); }

// Copies with padding by the last point without force.
template <class T, class F>
void fill(std::vector<T>& to, std::size_t n, F value) {
    to.resize(padded(n));
    for (std::size_t i = 0; i < n; ++i) to[i] = value(i);
    std::fill(to.begin() + static_cast<std::ptrdiff_t>(n), to.end(), n > 0 ? to[n - 1] : T{});
}

template <class T>
double largest(std::size_t n, const T* f) {
    T largest = 0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(f[i]));
    return static_cast<double>(largest);
}

// Single-precision forces are scaled by the largest, so that no product underflows.
double force_unit(double largest) {
    return largest > 0 && std::isfinite(largest) ? std::ldexp(1.0, std::clamp(std::ilogb(largest), -1020, 1020)) : 1;
}

template <class Real, class Coordinate>
void symmetric(const PairLoops<Real, Coordinate>& loops, std::size_t n, const Coordinate* x, const Coordinate* y, const Real* f,
               double* total) {
    Real rows[kTile], columns[kTile];
    const auto gather = [total](const Real* part, std::size_t from, std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) total[from + k] += static_cast<double>(part[k]);
    };
    for (std::size_t i = 0; i < n; i += kTile) {
        const std::size_t ni = std::min(kTile, n - i);
        std::fill_n(rows, ni, Real(0));
        loops.self(ni, x + i, y + i, f + i, rows);
        gather(rows, i, ni);
        for (std::size_t j = i + kTile; j < n; j += kTile) {
            const std::size_t nj = std::min(kTile, n - j);
            std::fill_n(rows, ni, Real(0));
            std::fill_n(columns, nj, Real(0));
            loops.cross(ni, x + i, y + i, f + i, rows, nj, x + j, y + j, f + j, columns);
            gather(rows, i, ni);
            gather(columns, j, nj);
        }
    }
}

// Adds the sums over padded sources to targets, whose coordinates are given by target(i, x, y).
template <class Real, class Coordinate, class Target>
void onto(const PairLoops<Real, Coordinate>& loops, std::size_t n_targets, Target target, std::size_t n_sources, const Coordinate* xs,
          const Coordinate* ys, const Real* fs, double* total) {
    constexpr std::size_t kTargets = 128;
    Coordinate x[kTargets], y[kTargets];
    Real part[kTargets];
    for (std::size_t i = 0; i < n_targets; i += kTargets) {
        const std::size_t count = std::min(kTargets, n_targets - i), full = padded(count);
        for (std::size_t k = 0; k < full; ++k) target(i + std::min(k, count - 1), x[k], y[k]);
        std::fill_n(total + i, count, 0.0);
        for (std::size_t j = 0; j < n_sources; j += kTile) {
            std::fill_n(part, full, Real(0));
            loops.onto(full, x, y, part, std::min(kTile, n_sources - j), xs + j, ys + j, fs + j);
            for (std::size_t k = 0; k < count; ++k) total[i + k] += static_cast<double>(part[k]);
        }
    }
}

}  // namespace

const char* pair_instruction_set() { return pair_kernels().name; }

void pair_potential(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources, const double* xs, const double* ys,
                    const double* fs, double* phi) {
    if (n_targets == 0) return;
    Box box;
    enclose(box, n_targets, xt, yt, "target");
    enclose(box, n_sources, xs, ys, "source");
    const double scale = unit_scale(box);
    static thread_local std::vector<double> x, y, f;
    fill(x, n_sources, [&](std::size_t i) { return xs[i] * scale; });
    fill(y, n_sources, [&](std::size_t i) { return ys[i] * scale; });
    f.assign(padded(n_sources), 0.0);
    std::copy_n(fs, n_sources, f.begin());
    const auto target = [&](std::size_t i, double& xi, double& yi) { xi = xt[i] * scale, yi = yt[i] * scale; };
    onto(pair_kernels().exact, n_targets, target, f.size(), x.data(), y.data(), f.data(), phi);
    for (std::size_t i = 0; i < n_targets; ++i) phi[i] *= scale;
}

void pair_potential_single(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources, const double* xs,
                           const double* ys, const double* fs, double* phi) {
    if (n_targets == 0) return;
    Box box;
    enclose(box, n_targets, xt, yt, "target");
    enclose(box, n_sources, xs, ys, "source");
    const double scale = fixed_scale(box), unit = force_unit(largest(n_sources, fs));
    static thread_local std::vector<std::int32_t> x, y;
    static thread_local std::vector<float> f;
    fill(x, n_sources, [&](std::size_t i) { return fixed(xs[i], box.x_min, scale); });
    fill(y, n_sources, [&](std::size_t i) { return fixed(ys[i], box.y_min, scale); });
    f.assign(padded(n_sources), 0.0f);
    for (std::size_t i = 0; i < n_sources; ++i) f[i] = static_cast<float>(fs[i] / unit);
    const auto target = [&](std::size_t i, std::int32_t& xi, std::int32_t& yi) {
        xi = fixed(xt[i], box.x_min, scale), yi = fixed(yt[i], box.y_min, scale);
    };
    onto(pair_kernels().single, n_targets, target, f.size(), x.data(), y.data(), f.data(), phi);
    for (std::size_t i = 0; i < n_targets; ++i) phi[i] *= unit * scale / kSingleWeight;
}

void PairSet::assign(std::size_t n, const double* x, const double* y) {
    Box box;
    enclose(box, n, x, y, "contact");
    scale_ = unit_scale(box);
    fixed_scale_ = fixed_scale(box);
    fill(x_, n, [&](std::size_t i) { return x[i] * scale_; });
    fill(y_, n, [&](std::size_t i) { return y[i] * scale_; });
    fill(x_fixed_, n, [&](std::size_t i) { return fixed(x[i], box.x_min, fixed_scale_); });
    fill(y_fixed_, n, [&](std::size_t i) { return fixed(y[i], box.y_min, fixed_scale_); });
    n_ = n;
}

void PairSet::apply(const double* f, double* phi) const {
    static thread_local std::vector<double> force, total;
    force.assign(x_.size(), 0.0);
    std::copy_n(f, n_, force.begin());
    total.assign(x_.size(), 0.0);
    symmetric(pair_kernels().exact, x_.size(), x_.data(), y_.data(), force.data(), total.data());
    for (std::size_t i = 0; i < n_; ++i) phi[i] = total[i] * scale_;
}

void PairSet::apply_single(const float* f, float* phi) const {
    static thread_local std::vector<float> force;
    static thread_local std::vector<double> total;
    const double unit = force_unit(largest(n_, f)), back = unit * fixed_scale_ / kSingleWeight;
    force.assign(x_.size(), 0.0f);
    for (std::size_t i = 0; i < n_; ++i) force[i] = static_cast<float>(static_cast<double>(f[i]) / unit);
    total.assign(x_.size(), 0.0);
    symmetric(pair_kernels().single, x_.size(), x_fixed_.data(), y_fixed_.data(), force.data(), total.data());
    for (std::size_t i = 0; i < n_; ++i) phi[i] = static_cast<float>(total[i] * back);
}

}  // namespace rsc
