// One grid of the contact of elements that repeat, in numbers without units: heights z of mean 0, deflections u = K p, gaps w = u - z + Z0.
// Building blocks of solver/periodic_elements.hpp.
#pragma once

#include "contact/interaction/periodic_pixels.hpp"
#include "contact/interaction/pixel_products.hpp"
#include "contact/solver/bounded.hpp"

namespace rsc {

// The controlled quantity: the mean of p over the grid (without a highest pressure), or Z0.
struct Given {
    bool is_pressure;
    double value;
};

// Heights of a grid where they lie: z = (what is stored - mean) scale.
struct StoredHeights {
    const double* z = nullptr;
    std::ptrdiff_t stride = 0;
    double mean = 0, scale = 1;
    double operator()(int j, int i) const { return (z[j * stride + i] - mean) * scale; }
};

class PeriodicGrid : private BoundedSolver {
public:
    // `aspect` is dy/dx; K is `unit` times PeriodicPixels' own. `share` of a wavenumber over 1/dx of the grid with unit = 1: kernel.hpp.
    // Pressures are bounded by `highest`.
    using Share = std::function<double(double)>;
    PeriodicGrid(int nx, int ny, double aspect, double unit, double highest, StoredHeights heights, Share share);

    // Half as many pixels a side, each as high as the mean of its four; `storage` takes them. Only where both sides are even.
    std::unique_ptr<PeriodicGrid> coarsened(std::vector<double>& storage) const;
    bool can_be_coarsened() const;

    // Pressures to start from: all the same, or like those of Hertz where z > Z0; those of the coarsened grid.
    void start(Given given);
    void start(const PeriodicGrid& coarse);
    bool bare() const;  // no pressure anywhere

    // Iterates until error() is below the tolerance: in single precision, on the finest grid with the error in double.
    ElementsOutcome solve(Given given, double tolerance, int most_iterations, bool finest);

    // The answer: the set's pixels are those under pressure and some that are not.
    const std::vector<double>& pressures() const { return p_; }
    std::vector<Pixel> pixels() const;  // of the set, row by row
    double Z0() const { return Z0_; }
    bool full() const;  // every pixel under pressure
    double stiffness(bool back);
    using BoundedSolver::energy, BoundedSolver::press_out;

    void deflect(std::vector<double>& plane);  // pressures of all pixels become K p

    double least_inverse();  // the least of K^-1 z

private:
    PeriodicPixels<double>& fine();
    Share share() const;  // in this grid's unit

    void multiply(const std::vector<double>& x, std::vector<double>& Kx, bool exact) override;
    template <class Real>
    void multiply_by(PeriodicPixels<Real>& pixels, const std::vector<double>& x, std::vector<double>& Kx);
    template <class F>
    void penetrating(int j, F&& visit) const;
    double outside() override;
    void renew() override;
    void precondition(const std::vector<double>& r, std::vector<double>& y) override;
    bool judge_exactly(bool exact, double residual, int rounds) override;

    int threads() const;  // for loops over rows

    int nx_, ny_;
    double aspect_, unit_;
    StoredHeights heights_;
    Share share_;
    PeriodicPixels<float> inner_;
    std::unique_ptr<PeriodicPixels<double>> fine_;
    std::vector<float> stencil_;  // of the preconditioner, (2 kReach + 1) rows of kTaps
    long products_ = 0;
    bool exact_ = false;                // the last product with p: what fine_ holds, or inner_
    std::vector<std::int32_t> column_;  // of the set
    std::vector<double> partial_;
};

}  // namespace rsc
