// One grid of the contact of elements that repeat, in numbers without units: heights z of mean 0, deflections u = K p, gaps w = u - z + Z0.
// Building blocks of solver/periodic_elements.hpp.
#pragma once

#include "contact/interaction/periodic_pixels.hpp"
#include "contact/solver/elements.hpp"

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

// Pixels row by row: row j has those from begin[j] to begin[j + 1].
struct PixelRows {
    std::vector<std::size_t> begin;
    std::vector<std::int32_t> column;
    std::size_t size() const { return column.size(); }
};

class PeriodicGrid {
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

    // Iterates until error() is below the tolerance: in single precision, on the finest grid with the error in double. Iterations are rounds:
    // sets of pixels tried.
    ElementsOutcome solve(Given given, double tolerance, int most_iterations, bool finest);

    // The answer: pixels under pressure and some that are not.
    const PixelRows& set() const { return set_; }
    const std::vector<double>& pressures() const { return p_; }
    const std::vector<double>& gaps() const { return w_; }
    double Z0() const { return Z0_; }
    bool full() const;            // every pixel under pressure
    double stiffness(bool back);  // -d(sum of p)/dZ0: of all pixels under pressure, or of those below the highest one
    // p'Kp/2 = sum p (g0 - w)/2 with g0 = z - Z0, to second order; pressed out.
    double energy() const;
    // Heights were lowered by the penetrations at the highest pressure.
    void press_out();

    void deflect(std::vector<double>& plane);  // pressures of all pixels become K p

    double least_inverse();  // the least of K^-1 z
    void release();          // gives back what only solving needs

private:
    template <class F>
    double over_rows(F&& f);
    PeriodicPixels<double>& fine();
    Share share() const;  // in this grid's unit

    template <class Real>
    void evaluate(PeriodicPixels<Real>& pixels, Given given);
    // Rms of w where 0 < p < highest and of penetrations left elsewhere, over the number of pixels under pressure, by the mean of z - Z0
    // weighted with p.
    template <class Real>
    double error(const PeriodicPixels<Real>& pixels);
    template <class Real>
    void collect(const PeriodicPixels<Real>& pixels);
    void precondition(const std::vector<double>& r, std::vector<double>& y);
    double descend(std::vector<double>& x, bool keep_sum, int most_steps, double reduction);
    void bound(Given given);
    bool fell();

    int nx_, ny_;
    double aspect_, unit_, highest_;
    StoredHeights heights_;
    Share share_;
    PeriodicPixels<float> inner_;
    std::unique_ptr<PeriodicPixels<double>> fine_;
    std::vector<float> stencil_;  // of the preconditioner, (2 kReach + 1) rows of kTaps
    long products_ = 0;
    double Z0_ = 0;

    PixelRows set_;
    std::vector<double> p_, w_;  // of the set
    std::vector<char> free_;     // pixels of the set that are not held at a bound
    std::vector<double> r_, y_, one_, d_, image_, before_p_, before_w_, partial_;
};

}  // namespace rsc
