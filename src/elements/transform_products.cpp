#include "base/error.hpp"
#include "base/parallel.hpp"
#include "elements/periodic_pixels.hpp"
#include "elements/pixel_products.hpp"
#include "interaction/line_kernel.hpp"
#include "interaction/pixel_kernels.hpp"

namespace rsc {
namespace {

// Pixels row by row, on the plane of the transforms.
struct PlaneSet {
    std::vector<Pixel> pixels;
    Pixel first{0, 0};               // of the plane
    std::vector<std::size_t> begin;  // of its rows, and the end
    int width = 0;                   // across a line contact

    // Calls visit(pixel, column on the plane) for those in a row of the plane.
    template <class Visit>
    void row(int j, Visit&& visit) const {
        if (at(j) + 1 >= begin.size()) return;
        for (std::size_t k = begin[at(j)]; k < begin[at(j) + 1]; ++k)
            visit(k, pixels[k].x - first.x);
    }
};

// Products by transforms in both precisions: of a kernel given by its modes, or of a half-space
// (PeriodicPixels).
class TransformPlane {
public:
    TransformPlane(int nx, int ny, std::vector<double> modes, double aspect = 1,
                   std::function<double(double)> share = {})
        : nx_(nx), ny_(ny), modes_(std::move(modes)), aspect_(aspect), share_(std::move(share)) {}

    // w = `factor` K p
    template <class Real>
    void apply(const PlaneSet& set, const double* p, double factor, double* w) {
        double largest = 0;
        for (const auto k : indices(set.pixels)) largest = std::max(largest, std::abs(p[k]));
        const double unit = largest > 0 ? largest : 1;  // for single precision
        of<Real>().apply(
            [&](int j, Real* row) {
                std::fill_n(row, nx_, Real(0));
                set.row(j, [&](std::size_t k, int i) { row[i] = Real(p[k] / unit); });
            },
            [&](int j, const Real* row) {
                set.row(j, [&](std::size_t k, int i) { w[k] = unit * factor * double(row[i]); });
            });
    }

private:
    template <class Real>
    PeriodicPixels<Real>& of() {
        using Pixels = PeriodicPixels<Real>;
        auto& products = std::get<std::unique_ptr<Pixels>>(products_);
        if (!products)
            products = modes_.empty() ? std::make_unique<Pixels>(nx_, ny_, 1, aspect_, share_)
                                      : std::make_unique<Pixels>(nx_, ny_, modes_);
        return *products;
    }

    int nx_, ny_;
    std::vector<double> modes_;
    double aspect_;
    std::function<double(double)> share_;
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

// On a surface that repeats along one axis, or along both.
class TransformProducts final : public PixelProducts {
public:
    TransformProducts(const Substrate& substrate, const Period& period, const PointGrid& map,
                      bool shifted)
        : flats_(period.finite()),
          along_x_(std::isfinite(period.x)),
          along_y_(std::isfinite(period.y)),
          nx_(map.nx),
          ny_(map.ny),
          aspect_(ny_ == 1 && along_y_ ? kEndless : map.dy / map.dx),
          unit_(map.dx / substrate.modulus()),
          share_(share_of_modes(substrate, map.dx)) {
        if (flats_) return;
        if (substrate.smooth())
            throw Error(Failure::bad_input, "line contact is not available for bodies with layers");
        const double step = along_x_ ? map.dx : map.dy, across_step = along_x_ ? map.dy : map.dx,
                     L = period.length();
        constexpr double same = 1e-9;
        if (std::abs(along() * step - L) > same * L)
            throw Error(Failure::internal, "the map is not the period of a line contact");
        const double D = period.reference > 0 ? period.reference : across() * across_step;
        const LineKernel kernel(L, D);
        const auto point = [&](int i, int j) {
            const double x = i * across_step, y = j * step;
            return kernel.images(x, y) + (i > 0 || j > 0 ? 1 / std::hypot(x, y) : kInfinity);
        };
        double least = 0;  // relative to 1/(pi E*)
        for (int j = 0; 2 * j <= along(); ++j) least = std::min(least, point(across() - 1, j));
        const double raised = shifted ? -least : 0.0;
        shift_ = substrate.near() * raised;
        coefficient_ = line_deflections(substrate, period, nx_, ny_, map.dx, map.dy, raised);
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
        return inverse_stencil(aspect_, with_diagonal(share_, diagonal / unit_));
    }
    double shift() const override { return shift_; }
    double error(Accuracy accuracy) const override {
        constexpr double in_single = 2e-6, in_double = 1e-14;
        return accuracy == Accuracy::inner ? in_single : in_double;
    }

private:
    // Of the map, along and across the axis of a line contact, in pixels.
    int along() const { return along_x_ ? nx_ : ny_; }
    int across() const { return along_x_ ? ny_ : nx_; }

    PlaneSet arrange(const std::vector<Pixel>& pixels) const {
        PlaneSet set{pixels};
        if (pixels.empty()) return set;
        Pixel low = pixels[0], high = pixels[0];
        for (const Pixel& pixel : pixels) {
            low = {std::min(low.x, pixel.x), std::min(low.y, pixel.y)};
            high = {std::max(high.x, pixel.x), std::max(high.y, pixel.y)};
        }
        set.first = {along_x_ ? 0 : low.x, along_y_ ? 0 : low.y};
        set.width = along_x_ ? high.y - low.y + 1 : high.x - low.x + 1;
        set.begin.assign(at(along_y_ ? ny_ : set.width) + 1, 0);
        for (const Pixel& pixel : pixels) ++set.begin[at(pixel.y - set.first.y) + 1];
        std::partial_sum(set.begin.begin(), set.begin.end(), set.begin.begin());
        return set;
    }

    // The whole period, padded across a line contact.
    std::unique_ptr<TransformPlane> make_plane(int padded) const {
        if (flats_)
            return std::make_unique<TransformPlane>(nx_, ny_, std::vector<double>(), aspect_,
                                                    share_);
        const int nx = along_x_ ? nx_ : padded, ny = along_x_ ? padded : ny_;
        return std::make_unique<TransformPlane>(
            nx, ny, modes_of(nx, ny, false, [&](int i, int j) {
                const std::size_t m = at(along_x_ ? j : i), n = at(along_x_ ? i : j);
                return m < at(across()) ? coefficient_[m * (at(along()) / 2 + 1) + n] : 0.0;
            }));
    }

    void multiply(const PlaneSet& set, const double* p, double* w, Accuracy accuracy) {
        if (set.pixels.empty()) return;
        ++count_;
        const int padded = flats_ ? 0 : padded_size(set.width);
        auto& plane = planes_[padded];
        if (!plane) plane = make_plane(padded);
        const double factor = flats_ ? unit_ : 1;
        if (accuracy == Accuracy::inner)
            plane->apply<float>(set, p, factor, w);
        else
            plane->apply<double>(set, p, factor, w);
    }

    bool flats_, along_x_, along_y_;
    int nx_, ny_;  // of the map
    double aspect_, unit_;
    std::function<double(double)> share_;
    double shift_ = 0;
    std::vector<double> coefficient_;  // of a line contact: [across][along], at most half a period
    PlaneSet set_;
    std::map<int, std::unique_ptr<TransformPlane>> planes_;  // by their padded width
};

}  // namespace

std::unique_ptr<PixelProducts> make_periodic_products(const Substrate& substrate,
                                                      const PointGrid& map) {
    const Period period{map.Lx(), map.Ly()};
    return std::make_unique<TransformProducts>(substrate, period, map, false);
}

std::unique_ptr<PixelProducts> make_products(const Substrate& substrate, const Period& period,
                                             const PointGrid& map, double inner_error,
                                             double full_error, bool shifted) {
    if (period.line()) return std::make_unique<TransformProducts>(substrate, period, map, shifted);
    return make_tree_products(substrate, map.dx, map.dy, inner_error, full_error, shifted);
}

}  // namespace rsc
