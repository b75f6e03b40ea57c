#include "base/error.hpp"
#include "base/parallel.hpp"
#include "elements/periodic_pixels.hpp"
#include "elements/pixel_products.hpp"
#include "interaction/line_kernel.hpp"
#include "interaction/pixel_kernels.hpp"

namespace rsc {
namespace {

// Products on a strip of given width across the axis, padded to at least twice its width.
class Strip {
public:
    // `coefficient(across, along)` for offsets in pixels.
    template <class Coefficient>
    Strip(int padded, int period, bool along_x, Coefficient&& coefficient)
        : nx_(along_x ? period : padded), ny_(along_x ? padded : period) {
        modes_ = modes_of(nx_, ny_, false, [&](int i, int j) {
            return along_x ? coefficient(j, i) : coefficient(i, j);
        });
    }

    // w = K p for pixels row by row, whose first one of row j is begin[j].
    template <class Real>
    void apply(const std::vector<Pixel>& pixels, Pixel first, const std::vector<std::size_t>& begin,
               const double* p, double* w) {
        auto& products = of<Real>();
        const int rows = static_cast<int>(begin.size()) - 1;
        double largest = 0;
        for (std::size_t k = 0; k < pixels.size(); ++k) largest = std::max(largest, std::abs(p[k]));
        const double unit = largest > 0 ? largest : 1;  // for single precision
        products.apply(
            [&](int j, Real* row) {
                std::fill_n(row, nx_, Real(0));
                for (std::size_t k = j < rows ? begin[at(j)] : 0,
                                 end = j < rows ? begin[at(j + 1)] : 0;
                     k < end; ++k)
                    row[pixels[k].x - first.x] = static_cast<Real>(p[k] / unit);
            },
            [&](int j, const Real* row) {
                if (j >= rows) return;
                for (std::size_t k = begin[at(j)]; k < begin[at(j + 1)]; ++k)
                    w[k] = unit * static_cast<double>(row[pixels[k].x - first.x]);
            });
    }

private:
    template <class Real>
    PeriodicPixels<Real>& of() {
        auto& products = std::get<std::unique_ptr<PeriodicPixels<Real>>>(products_);
        if (!products) products = std::make_unique<PeriodicPixels<Real>>(nx_, ny_, modes_);
        return *products;
    }

    int nx_, ny_;
    std::vector<double> modes_;
    std::tuple<std::unique_ptr<PeriodicPixels<float>>, std::unique_ptr<PeriodicPixels<double>>>
        products_;
};

// What images of a unit pressure on a pixel add to the same forces at its middle, to second order
// in the sides (across, along): (across^2 dxx + along^2 dyy)/24 of 1/d times the area, for the
// images beyond the first `exact`. From the `summed`-th image on by their integral. The next order
// is below 1e-11 of the pixel's own deflection where images are farther than kFar sides.
double spread_of_far_images(double x, double y, double L, int exact, double across, double along) {
    const double xx = across * across / 24, yy = along * along / 24;
    const int summed = exact + 24;
    double sum = 0;
    for (const double to : {y, -y}) {
        for (int n = summed; n > exact; --n) {
            const double t = to + n * L, d = std::hypot(x, t), d5 = d * d * d * d * d;
            sum += (xx * (2 * x * x - t * t) + yy * (2 * t * t - x * x)) / d5;
        }
        const double t = to + (summed + 0.5) * L, d = std::hypot(x, t), bent = t / (d * d * d);
        sum += ((yy - xx) * bent + xx / (d * (d + t))) / L;
    }
    return sum * across * along;
}

// pi E* times the deflection at a distance across from a strip of width 2 h under unit pressure
// that is endless along the axis, 0 at the distance D from a narrow one: the sum of all images of a
// pixel as long as the period.
double strip(double x, double h, double D) {
    if (x == 0) return 4 * h * (1 - std::log(h / D));
    return 4 * h - 4 * x * std::atanh(h / x) - 2 * h * std::log((x - h) * (x + h) / (D * D));
}

}  // namespace

std::vector<double> line_deflections(const Substrate& substrate, const Period& period, int nx,
                                     int ny, double dx, double dy, double raised) {
    const bool along_x = period.along_x();
    const int width = along_x ? ny : nx, along = along_x ? nx : ny;
    const std::size_t half = at(along) / 2 + 1;
    const double step = along_x ? dx : dy, across_step = along_x ? dy : dx, L = period.length();
    const double D = period.reference > 0 ? period.reference : width * across_step;
    const double area = dx * dy;
    std::vector<double> coefficient(at(width) * half);
    if (along == 1) {
        for (const int i : indices(width))
            coefficient[at(i)] =
                substrate.near() * (strip(i * across_step, 0.5 * across_step, D) + area * raised);
        return coefficient;
    }
    const LineKernel kernel(L, D);
    const double aspect = step / across_step;
    constexpr double kFar = 64;
    const int exact = int(std::ceil(kFar * std::max(dx, dy) / L));
    parallel_for(width, 8, 0, [&](int i) {
        for (const auto j : indices(half)) {
            const double x = i * across_step, y = static_cast<double>(j) * step;
            // The force and its images are spread over their pixels.
            double sum = area * (kernel.images(x, y) + raised) +
                         spread_of_far_images(x, y, L, exact, across_step, step);
            for (int n = -exact; n <= exact; ++n) {
                const double t = y + n * L;
                sum += across_step * pixel_kernel(x / across_step, t / across_step, aspect);
                if (n != 0) sum -= area / std::hypot(x, t);
            }
            coefficient[at(i) * half + j] = substrate.near() * sum;
        }
    });
    return coefficient;
}

int padded_size(int width) {
    int padded = 4;
    while (padded < 2 * width - 1)
        padded =
            std::has_single_bit(static_cast<unsigned>(padded)) ? padded / 2 * 3 : padded / 3 * 4;
    return padded;
}

namespace {

class LineProducts final : public PixelProducts {
public:
    LineProducts(const Substrate& substrate, const Period& period, int nx, int ny, double dx,
                 double dy, bool shifted)
        : along_x_(period.along_x()),
          width_(along_x_ ? ny : nx),
          period_(along_x_ ? nx : ny),
          half_(at(period_) / 2 + 1),
          aspect_(dy / dx),
          dx_(dx),
          modulus_(substrate.modulus()) {
        if (substrate.smooth())
            throw Error(Failure::bad_input, "line contact is not available for bodies with layers");
        const double step = along_x_ ? dx : dy, across_step = along_x_ ? dy : dx,
                     L = period.length();
        constexpr double same = 1e-9;
        if (std::abs(period_ * step - L) > same * L)
            throw Error(Failure::internal, "the map is not the period of a line contact");
        const double D = period.reference > 0 ? period.reference : width_ * across_step;
        const LineKernel kernel(L, D);
        const auto point = [&](int i, int j) {
            const double x = i * across_step, y = j * step;
            return kernel.images(x, y) + (i > 0 || j > 0 ? 1 / std::hypot(x, y) : kInfinity);
        };
        double least = 0;  // relative to 1/(pi E*)
        for (std::size_t j = 0; j < half_; ++j)
            least = std::min(least, point(width_ - 1, static_cast<int>(j)));
        const double raised = shifted ? -least : 0.0;
        shift_ = substrate.near() * raised;
        coefficient_ = line_deflections(substrate, period, nx, ny, dx, dy, raised);
    }

    void set_pixels(const std::vector<Pixel>& pixels) override { set_ = arrange(pixels); }
    void apply(const double* p, double* w, Accuracy accuracy, const char*) override {
        multiply(set_, p, w, accuracy);
    }
    void elsewhere(const double* p, const std::vector<Pixel>& pixels, double* w,
                   const char*) override {
        multiply(arrange(pixels), p, w, Accuracy::inner);
    }
    PixelStencil inverse(double diagonal) const override {
        const double aspect = period_ == 1 && !along_x_ ? kEndless : aspect_;
        return inverse_stencil(aspect, with_diagonal({}, diagonal * modulus_ / dx_));
    }
    double shift() const override { return shift_; }
    double error(Accuracy accuracy) const override {
        constexpr double in_single = 2e-6, in_double = 1e-14;
        return accuracy == Accuracy::inner ? in_single : in_double;
    }

private:
    struct Set {
        std::vector<Pixel> pixels;
        Pixel first{0, 0};               // of the plane of the transforms
        std::vector<std::size_t> begin;  // of its rows, and the end
        int width = 0;                   // across
    };

    Set arrange(const std::vector<Pixel>& pixels) const {
        Set set{pixels, {0, 0}, {}, 0};
        if (pixels.empty()) return set;
        Pixel low = pixels[0], high = pixels[0];
        for (const Pixel& pixel : pixels) {
            low = {std::min(low.x, pixel.x), std::min(low.y, pixel.y)};
            high = {std::max(high.x, pixel.x), std::max(high.y, pixel.y)};
        }
        set.first = along_x_ ? Pixel{0, low.y} : Pixel{low.x, 0};
        set.width = along_x_ ? high.y - low.y + 1 : high.x - low.x + 1;
        const int rows = along_x_ ? set.width : period_;
        set.begin.assign(at(rows) + 1, 0);
        for (const Pixel& pixel : pixels) ++set.begin[at(pixel.y - set.first.y) + 1];
        std::partial_sum(set.begin.begin(), set.begin.end(), set.begin.begin());
        return set;
    }

    void multiply(const Set& set, const double* p, double* w, Accuracy accuracy) {
        if (set.pixels.empty()) return;
        ++count_;
        const int padded = padded_size(set.width);
        auto& strip = strips_[padded];
        if (!strip)
            strip = std::make_unique<Strip>(padded, period_, along_x_, [&](int across, int along) {
                return across < width_ ? coefficient_[at(across) * half_ + at(along)] : 0.0;
            });
        if (accuracy == Accuracy::inner)
            strip->apply<float>(set.pixels, set.first, set.begin, p, w);
        else
            strip->apply<double>(set.pixels, set.first, set.begin, p, w);
    }

    bool along_x_;
    int width_, period_;  // of the map across and along, in pixels
    std::size_t half_;
    double aspect_, dx_, modulus_;
    double shift_ = 0;
    std::vector<double> coefficient_;  // [across][along], along at most half a period
    Set set_;
    std::map<int, std::unique_ptr<Strip>> strips_;  // by their padded width
};

}  // namespace

std::unique_ptr<PixelProducts> make_line_products(const Substrate& substrate, const Period& period,
                                                  int nx, int ny, double dx, double dy,
                                                  bool shifted) {
    return std::make_unique<LineProducts>(substrate, period, nx, ny, dx, dy, shifted);
}

std::unique_ptr<PixelProducts> make_products(const Substrate& substrate, const Period& period,
                                             const PointGrid& map, double inner_error,
                                             double full_error, bool shifted) {
    if (period.line())
        return make_line_products(substrate, period, map.nx, map.ny, map.dx, map.dy, shifted);
    return make_tree_products(substrate, map.dx, map.dy, inner_error, full_error, shifted);
}

}  // namespace rsc
