#include "elements/traction_products.hpp"

#include "base/error.hpp"
#include "interaction/cerruti.hpp"
#include "interaction/pixel_kernels.hpp"

namespace rsc {

TractionProducts::TractionProducts(const Substrate& substrate, double shear, const Period& period,
                                   const PointGrid& map)
    : substrate_(substrate),
      shear_(shear),
      period_(period),
      map_(map),
      inverse_(inverse_stencil(map.dy / map.dx)) {
    if (substrate.smooth()) throw Error(Failure::internal, "tractions on bodies with layers");
    if (period_.line())
        line_ = line_deflections(substrate_, period_, map.nx, map.ny, map.dx, map.dy, 0);
}

TractionProducts::~TractionProducts() = default;

void TractionProducts::set_pixels(const std::vector<Pixel>& pixels) {
    pixels_ = pixels;
    Pixel low{0, 0}, high{0, 0};
    if (!pixels.empty()) low = high = pixels[0];
    for (const Pixel& pixel : pixels) {
        low = {std::min(low.x, pixel.x), std::min(low.y, pixel.y)};
        high = {std::max(high.x, pixel.x), std::max(high.y, pixel.y)};
    }
    const bool repeats_x = std::isfinite(period_.x), repeats_y = std::isfinite(period_.y);
    first_ = {repeats_x ? 0 : low.x, repeats_y ? 0 : low.y};
    constexpr int least = 2 * SparsePlane::kMostReach;  // for the preconditioner
    set_plane(repeats_x ? map_.nx : padded_size(std::max(least, high.x - low.x + 1)),
              repeats_y ? map_.ny : padded_size(std::max(least, high.y - low.y + 1)));
    order_.resize(pixels.size());
    std::iota(order_.begin(), order_.end(), std::size_t(0));
    std::ranges::sort(order_, {},
                      [&](std::size_t k) { return std::pair(pixels[k].y, pixels[k].x); });
    begin_.assign(at(ny_) + 1, 0);
    column_.resize(pixels.size());
    for (const auto k : indices(pixels)) {
        const Pixel& pixel = pixels[order_[k]];
        ++begin_[at(pixel.y - first_.y) + 1];
        column_[k] = pixel.x - first_.x;
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
}

void TractionProducts::set_plane(int nx, int ny) {
    if (nx == nx_ && ny == ny_) return;
    nx_ = nx;
    ny_ = ny;
    single_.reset();
    double_.reset();
    near_ = std::make_unique<SparsePlane>(nx, ny);
    modes_ = period_.finite() ? periodic_modes() : period_.line() ? line_modes() : free_modes();
    largest_ = 0;
    for (const auto k : indices(modes_.xx)) {
        const double mean = 0.5 * (modes_.xx[k] + modes_.yy[k]),
                     half = 0.5 * (modes_.xx[k] - modes_.yy[k]);
        largest_ = std::max(largest_, mean + std::hypot(half, modes_.xy[k]));
    }
}

VectorModes TractionProducts::free_modes() const {
    const double dx = map_.dx, aspect = map_.dy / dx, a = 0.5, b = 0.5 * aspect;
    const double unit = substrate_.near() * dx;
    const auto add = [&](double c) {
        return modes_of(nx_, ny_, false, [&, c](int i, int j) {
            return unit *
                   (pixel_kernel(i, j * aspect, aspect) + c * cerruti_xx(i, j * aspect, a, b));
        });
    };
    VectorModes modes;
    modes.xx = add(shear_);
    // The sum of X^2/R^3 and Y^2/R^3 is 1/R.
    modes.yy = modes_of(nx_, ny_, false, [&](int i, int j) {
        return unit * ((1 + shear_) * pixel_kernel(i, j * aspect, aspect) -
                       shear_ * cerruti_xx(i, j * aspect, a, b));
    });
    modes.xy = modes_of(nx_, ny_, true, [&](int i, int j) {
        return unit * shear_ * cerruti_xy(i, j * aspect, a, b);
    });
    return modes;
}

VectorModes TractionProducts::line_modes() const {
    const bool along_x = period_.along_x();
    const double step = along_x ? map_.dx : map_.dy, across = along_x ? map_.dy : map_.dx;
    const std::size_t half = at(along_x ? map_.nx : map_.ny) / 2 + 1;
    const int width = along_x ? map_.ny : map_.nx;
    const LineCerruti line{period_.length()};
    const double c = shear_ * substrate_.near();
    const auto modes = [&](bool odd, auto&& of) {
        return modes_of(nx_, ny_, odd, [&](int i, int j) {
            const int m = along_x ? j : i, n = along_x ? i : j;
            if (m >= width) return 0.0;  // no two pixels are so far apart
            return of(m * across, n * step, line_[at(m) * half + at(n)]);
        });
    };
    const double a = 0.5 * across, b = 0.5 * step;
    VectorModes all;
    all.xx =
        modes(false, [&](double x, double y, double k) { return k + c * line.xx(x, y, a, b); });
    all.yy = modes(false, [&](double x, double y, double k) {
        return (1 + shear_) * k - c * line.xx(x, y, a, b);
    });
    all.xy = modes(true, [&](double x, double y, double) { return c * line.xy(x, y, a, b); });
    if (along_x) all.xx.swap(all.yy);
    return all;
}

VectorModes TractionProducts::periodic_modes() const {
    const std::size_t columns = at(nx_) / 2 + 1, rows = at(ny_) / 2 + 1;
    VectorModes modes;
    for (auto* m : {&modes.xx, &modes.xy, &modes.yy}) m->assign(columns * rows, 0.0);
    const double unit_x = 2 * pi / map_.Lx(), unit_y = 2 * pi / map_.Ly();
    for (const auto j : indices(rows))
        for (const auto i : indices(columns)) {
            if (i + j == 0) continue;
            const double kx = unit_x * double(i), ky = unit_y * double(j), k = std::hypot(kx, ky);
            const double along = 2 / (substrate_.modulus() * k), turned = shear_ * along / (k * k);
            const std::size_t m = j * columns + i;
            modes.xx[m] = (1 + shear_) * along - turned * kx * kx;
            modes.yy[m] = (1 + shear_) * along - turned * ky * ky;
            // An odd part of the highest mode of an even number of points has no value at them.
            const bool highest = 2 * int(i) == nx_ || 2 * int(j) == ny_;
            modes.xy[m] = highest ? 0.0 : -turned * kx * ky;
        }
    return modes;
}

template <class Real>
void TractionProducts::multiply(std::unique_ptr<VectorPixels<Real>>& plane, const double* q,
                                double* u) {
    if (!plane) plane = std::make_unique<VectorPixels<Real>>(nx_, ny_, modes_);
    const std::size_t n = pixels_.size();
    double largest = 0;  // for single precision
    for (const auto k : indices(2 * n)) largest = std::max(largest, std::abs(q[k]));
    const double unit = largest > 0 ? largest : 1;
    plane->apply(
        [&](int j, Real* x, Real* y) {
            std::fill_n(x, nx_, Real(0));
            std::fill_n(y, nx_, Real(0));
            for (std::size_t k = begin_[at(j)]; k < begin_[at(j) + 1]; ++k) {
                x[column_[k]] = static_cast<Real>(q[order_[k]] / unit);
                y[column_[k]] = static_cast<Real>(q[n + order_[k]] / unit);
            }
        },
        [&](int j, const Real* x, const Real* y) {
            for (std::size_t k = begin_[at(j)]; k < begin_[at(j) + 1]; ++k) {
                u[order_[k]] = unit * static_cast<double>(x[column_[k]]);
                u[n + order_[k]] = unit * static_cast<double>(y[column_[k]]);
            }
        });
}

void TractionProducts::apply(const double* q, double* u, bool exact) {
    if (pixels_.empty()) return;
    ++count_;
    if (exact)
        multiply(double_, q, u);
    else
        multiply(single_, q, u);
}

void TractionProducts::precondition(const std::vector<float>& q, std::vector<float>& y) {
    const std::size_t n = pixels_.size();
    y.resize(2 * n);
    const PixelSet set{begin_, column_};
    std::vector<float> from(n), to(n);
    for (const std::size_t part : {std::size_t(0), n}) {
        for (const auto k : indices(n)) from[k] = q[part + order_[k]];
        near_->convolve(inverse_, set, from.data(), to.data(), n >= 16384 ? 0 : 1);
        for (const auto k : indices(n)) y[part + order_[k]] = to[k];
    }
}

}  // namespace rsc
