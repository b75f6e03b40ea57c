#include "interaction/pairs.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "interaction/pairs_kernel.hpp"

namespace rsc {

namespace {

// Tile size: a set of columns stays in the first-level cache for all rows, and single-precision
// partial sums, accumulated in double precision, stay short enough to be accurate.
constexpr std::size_t kTile = 512;

std::size_t padded(std::size_t n) { return (n + kPairPadding - 1) / kPairPadding * kPairPadding; }

struct Bounds {
    double x_min = HUGE_VAL, x_max = -HUGE_VAL, y_min = HUGE_VAL, y_max = -HUGE_VAL;
    double extent() const { return std::max(x_max - x_min, y_max - y_min); }
};

void enclose(Bounds& bounds, std::size_t n, const double* x, const double* y) {
    for (std::size_t i = 0; i < n; ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
            throw Error(Failure::bad_input,
                        "point " + std::to_string(i + 1) + " of a sum over pairs: coordinates (" +
                            text_of(x[i]) + ", " + text_of(y[i]) + ") must be finite");
        bounds.x_min = std::min(bounds.x_min, x[i]);
        bounds.x_max = std::max(bounds.x_max, x[i]);
        bounds.y_min = std::min(bounds.y_min, y[i]);
        bounds.y_max = std::max(bounds.y_max, y[i]);
    }
}

// Copies with padding by the last point, which has no force.
template <class T, class F>
void fill(std::vector<T>& to, std::size_t n, F value) {
    to.resize(padded(n));
    for (std::size_t i = 0; i < n; ++i) to[i] = value(i);
    std::fill(to.begin() + static_cast<std::ptrdiff_t>(n), to.end(), n > 0 ? to[n - 1] : T{});
}

// Double coordinates: scaled by a power of two to an extent between 1/2 and 1, where
// single-precision estimates neither overflow nor underflow.
void set_frame(PairPoints<double>& points, const Bounds& bounds) {
    const double extent = bounds.extent();
    if (std::isinf(extent) && extent > 0)
        throw Error(Failure::bad_input, "the points are too far apart: their extent overflows");
    points.scale =
        extent > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(extent) - 1, -1022, 1022)) : 1;
}
double coordinate(const PairPoints<double>& points, double value, double) {
    return value * points.scale;
}

// Integer coordinates: their differences fit in 31 bits.
void set_frame(PairPoints<std::int32_t>& points, const Bounds& bounds) {
    points.x0 = bounds.x_min;
    points.y0 = bounds.y_min;
    points.scale = bounds.extent() > 0 ? std::min(0x1.fffffep30 / bounds.extent(), 0x1p1000) : 1;
}
std::int32_t coordinate(const PairPoints<std::int32_t>& points, double value, double origin) {
    return static_cast<std::int32_t>(std::lround((value - origin) * points.scale));
}

template <class Coordinate>
void assign_points(PairPoints<Coordinate>& points, const Bounds& bounds, std::size_t n,
                   const double* x, const double* y) {
    set_frame(points, bounds);
    fill(points.x, n, [&](std::size_t i) { return coordinate(points, x[i], points.x0); });
    fill(points.y, n, [&](std::size_t i) { return coordinate(points, y[i], points.y0); });
}

// Copies forces over `unit`, with padding.
template <class Real>
void fill_forces(std::vector<Real>& to, std::size_t n, const double* f, double unit) {
    to.assign(padded(n), Real(0));
    for (std::size_t i = 0; i < n; ++i) to[i] = static_cast<Real>(f[i] / unit);
}

// In single precision forces are scaled by the largest, so that no product underflows.
template <class Real>
double largest_force(std::size_t n, const double* f) {
    double largest = 0;
    for (std::size_t i = 0; i < n && std::is_same_v<Real, float>; ++i)
        largest = std::max(largest, std::abs(f[i]));
    return largest > 0 && std::isfinite(largest) ? largest : 1;
}

// Factor of the sums of the loops.
template <class Real>
constexpr double kWeight = std::is_same_v<Real, float> ? kSingleWeight : 1;

// phi_i = sum_j f_j / d_ij at the sources.
template <class Real, class Coordinate>
void sum_among(const PairLoops<Real, Coordinate>& loops, const PairPoints<Coordinate>& points,
               std::size_t sources, const double* f, double* phi) {
    static thread_local std::vector<Real> force;
    static thread_local std::vector<double> total;
    const double unit = largest_force<Real>(sources, f), back = points.scale / kWeight<Real>;
    fill_forces(force, sources, f, unit);
    const std::size_t n = force.size();
    total.assign(n, 0.0);
    Real rows[kTile], columns[kTile];
    const auto gather = [](const Real* part, std::size_t from, std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) total[from + k] += static_cast<double>(part[k]);
    };
    const Coordinate *const x = points.x.data(), *const y = points.y.data();
    for (std::size_t i = 0; i < n; i += kTile) {
        const std::size_t ni = std::min(kTile, n - i);
        std::fill_n(rows, ni, Real(0));
        loops.self(ni, x + i, y + i, force.data() + i, rows);
        gather(rows, i, ni);
        for (std::size_t j = i + kTile; j < n; j += kTile) {
            const std::size_t nj = std::min(kTile, n - j);
            std::fill_n(rows, ni, Real(0));
            std::fill_n(columns, nj, Real(0));
            loops.cross(ni, x + i, y + i, force.data() + i, rows, nj, x + j, y + j,
                        force.data() + j, columns);
            gather(rows, i, ni);
            gather(columns, j, nj);
        }
    }
    for (std::size_t i = 0; i < sources; ++i)
        phi[i] = unit * static_cast<double>(static_cast<Real>(total[i] * back));
}

// phi_i = sum_j f_j / d_ij at n targets (x, y).
template <class Real, class Coordinate>
void sum_onto(const PairLoops<Real, Coordinate>& loops, std::size_t n, const double* x,
              const double* y, std::size_t n_sources, const double* xs, const double* ys,
              const double* f, double* phi) {
    Bounds bounds;
    enclose(bounds, n, x, y);
    enclose(bounds, n_sources, xs, ys);
    static thread_local PairPoints<Coordinate> sources;
    static thread_local std::vector<Real> force;
    assign_points(sources, bounds, n_sources, xs, ys);
    const double unit =
        std::ldexp(1.0, std::clamp(std::ilogb(largest_force<Real>(n_sources, f)), -1020, 1020));
    fill_forces(force, n_sources, f, unit);
    constexpr std::size_t kTargets = 128;
    Coordinate xt[kTargets], yt[kTargets];
    Real part[kTargets];
    for (std::size_t i = 0; i < n; i += kTargets) {
        const std::size_t count = std::min(kTargets, n - i), full = padded(count);
        for (std::size_t k = 0; k < full; ++k) {
            const std::size_t from = i + std::min(k, count - 1);
            xt[k] = coordinate(sources, x[from], sources.x0);
            yt[k] = coordinate(sources, y[from], sources.y0);
        }
        std::fill_n(phi + i, count, 0.0);
        for (std::size_t j = 0; j < force.size(); j += kTile) {
            std::fill_n(part, full, Real(0));
            loops.onto(full, xt, yt, part, std::min(kTile, force.size() - j), sources.x.data() + j,
                       sources.y.data() + j, force.data() + j);
            for (std::size_t k = 0; k < count; ++k) phi[i + k] += static_cast<double>(part[k]);
        }
        for (std::size_t k = 0; k < count; ++k) phi[i + k] *= unit * sources.scale / kWeight<Real>;
    }
}

}  // namespace

void PairSums::assign(std::size_t n, const double* x, const double* y) {
    x_.assign(x, x + n);
    y_.assign(y, y + n);
    if (kernel_->lattice()) return;
    Bounds bounds;
    enclose(bounds, n, x, y);
    assign_points(exact_, bounds, n, x, y);
    assign_points(rough_, bounds, n, x, y);
}

// Converts sums of f/d to sums of f G.
void PairSums::scale_and_add(std::size_t n, const double* x, const double* y, const double* f,
                             double* phi) const {
    const double near = kernel_->near();
    for (std::size_t k = 0; k < n; ++k) phi[k] *= near;
    const SmoothPart* const smooth = kernel_->smooth();
    if (!smooth) return;
    smooth->table().add(n, x, y, x_.size(), x_.data(), y_.data(), f, phi);
    if (const double shift = kernel_->shift(); shift > 0) {
        const double total = std::accumulate(f, f + x_.size(), 0.0);
        for (std::size_t k = 0; k < n; ++k) phi[k] += shift * total;
    }
}

void PairSums::among(bool single, const double* f, double* phi) const {
    const std::size_t n = x_.size();
    if (kernel_->none()) {
        for (std::size_t k = 0; k < n; ++k) phi[k] = kernel_->self() * f[k];
        return;
    }
    if (kernel_->lattice()) return onto(single, n, x_.data(), y_.data(), f, phi);
    if (single)
        sum_among(pair_kernels().single, rough_, n, f, phi);
    else
        sum_among(pair_kernels().exact, exact_, n, f, phi);
    scale_and_add(n, x_.data(), y_.data(), f, phi);
}

void PairSums::onto(bool single, std::size_t n, const double* x, const double* y, const double* f,
                    double* phi) const {
    const std::size_t sources = x_.size();
    if (kernel_->none() || n == 0) {
        std::fill_n(phi, n, 0.0);
    } else if (const Lattice* lattice = kernel_->lattice()) {
        lattice->potential(n, x, y, sources, x_.data(), y_.data(), f, phi);
        const double total = std::accumulate(f, f + sources, 0.0);
        for (std::size_t k = 0; k < n; ++k)
            phi[k] = kernel_->near() * (phi[k] - lattice->least() * total);
    } else {
        if (single)
            sum_onto(pair_kernels().single, n, x, y, sources, x_.data(), y_.data(), f, phi);
        else
            sum_onto(pair_kernels().exact, n, x, y, sources, x_.data(), y_.data(), f, phi);
        scale_and_add(n, x, y, f, phi);
    }
}

}  // namespace rsc
