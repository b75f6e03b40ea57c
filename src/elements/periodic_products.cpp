#include "elements/pixel_products.hpp"

namespace rsc {
namespace {

class PeriodicProducts final : public PixelProducts {
public:
    PeriodicProducts(const Substrate& substrate, const PointGrid& map)
        : nx_(map.nx),
          aspect_(map.ny > 1 ? map.dy / map.dx : kEndless),
          unit_(map.dx / substrate.modulus()),
          share_(share_of_modes(substrate, map.dx)),
          single_(map.nx, map.ny, 1, aspect_, share_),
          double_(map.nx, map.ny, 1, aspect_, share_) {}

    void set_pixels(const std::vector<Pixel>& pixels) override { pixels_ = pixels; }
    void apply(const double* p, double* w, Accuracy accuracy, const char*) override {
        if (accuracy == Accuracy::inner)
            multiply(single_, p, pixels_, w);
        else
            multiply(double_, p, pixels_, w);
    }
    void elsewhere(const double* p, const std::vector<Pixel>& pixels, double* w,
                   const char*) override {
        multiply(single_, p, pixels, w);
    }
    PixelStencil inverse(double diagonal) const override {
        return inverse_stencil(aspect_, with_diagonal(share_, diagonal / unit_));
    }
    double shift() const override { return 0; }
    double error(Accuracy accuracy) const override {
        constexpr double in_single = 2e-6, in_double = 1e-14;
        return accuracy == Accuracy::inner ? in_single : in_double;
    }

private:
    // Sets `w` to K p on the pixels `to`.
    template <class Real>
    void multiply(PeriodicPixels<Real>& plane, const double* p, const std::vector<Pixel>& to,
                  double* w) {
        ++count_;
        double most = 0;  // for single precision
        for (const auto k : indices(pixels_)) most = std::max(most, std::abs(p[k]));
        const double unit = most > 0 ? most : 1;
        const auto row_of = [](const std::vector<Pixel>& pixels, int j) {
            return std::size_t(std::ranges::lower_bound(pixels, j, {}, &Pixel::y) - pixels.begin());
        };
        plane.apply(
            [&](int j, Real* row) {
                std::fill_n(row, nx_, Real(0));
                for (std::size_t k = row_of(pixels_, j); k < pixels_.size() && pixels_[k].y == j;
                     ++k)
                    row[pixels_[k].x] = Real(p[k] / unit);
            },
            [&](int j, const Real* row) {
                for (std::size_t k = row_of(to, j); k < to.size() && to[k].y == j; ++k)
                    w[k] = unit * unit_ * double(row[to[k].x]);
            });
    }

    int nx_;
    double aspect_, unit_;
    std::function<double(double)> share_;
    PeriodicPixels<float> single_;
    PeriodicPixels<double> double_;
    std::vector<Pixel> pixels_;
};

}  // namespace

std::unique_ptr<PixelProducts> make_periodic_products(const Substrate& substrate,
                                                      const PointGrid& map) {
    return std::make_unique<PeriodicProducts>(substrate, map);
}

}  // namespace rsc
