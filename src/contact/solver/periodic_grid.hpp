// One grid of a periodic boundary-element contact in dimensionless form: heights z of mean 0, deflections u = K p, gaps w = u - z + Z0.
// Used by solver/periodic_elements.hpp.
#pragma once

#include "contact/interaction/periodic_pixels.hpp"
#include "contact/interaction/pixel_products.hpp"
#include "contact/interaction/sparse_plane.hpp"
#include "contact/solver/block_correction.hpp"
#include "contact/solver/bounded.hpp"

namespace rsc {

// Controlled quantity: the mean of p over the grid (only without a highest pressure), or Z0.
struct Given {
    bool is_pressure;
    double value;
};

// Reference to stored heights: z = (stored value - mean) scale.
struct StoredHeights {
    const double* z = nullptr;
    std::ptrdiff_t stride = 0;
    double mean = 0, scale = 1;
    double operator()(int j, int i) const { return (z[j * stride + i] - mean) * scale; }
};

class PeriodicGrid : private BoundedSolver {
public:
    // `aspect` is dy/dx; K is `unit` times that of PeriodicPixels. `share` (kernel.hpp) is a function of the wavenumber times the dx of the
    // grid with unit = 1. Pressures are limited to `highest`.
    using Share = std::function<double(double)>;
    PeriodicGrid(int nx, int ny, double aspect, double unit, double highest, StoredHeights heights, Share share);

    // Grid of half as many pixels per side, whose heights, stored in `storage`, are means of four. Both sides must be even.
    std::unique_ptr<PeriodicGrid> coarsened(std::vector<double>& storage) const;
    bool can_be_coarsened() const;

    // Sets starting pressures: uniform, or Hertz-like where z > Z0; or those of the coarsened grid.
    void start(Given given);
    void start(const PeriodicGrid& coarse);
    bool bare() const;  // true without any pressure

    // Iterates until error() is below the tolerance, in single precision; on the finest grid the error is computed in double precision.
    ElementsOutcome solve(Given given, double tolerance, int most_iterations, bool finest);

    // The solution. The set contains the pixels under pressure and some others.
    const std::vector<double>& pressures() const { return p_; }
    std::vector<Pixel> pixels() const;  // of the set, row by row
    double Z0() const { return Z0_; }
    bool full() const;  // true if every pixel is under pressure
    double stiffness(bool back);
    using BoundedSolver::energy, BoundedSolver::press_out;

    void deflect(std::vector<double>& plane);  // replaces the pressures of all pixels by K p

    double least_inverse();  // minimum of K^-1 z

private:
    PeriodicPixels<double>& fine();
    Share share() const;  // for the pixel size of this grid

    void multiply(const std::vector<double>& x, std::vector<double>& Kx, bool exact) override;
    void multiply_roughly(const std::vector<double>& x, std::vector<double>& Kx) override;
    template <class Real>
    void multiply_by(PeriodicPixels<Real>& pixels, const std::vector<double>& x, std::vector<double>& Kx);
    double outside() override;
    void renew() override;
    void precondition(const std::vector<double>& r, std::vector<double>& y) override;
    void precondition_ones(std::vector<double>& y) override;
    void correct(std::vector<double>& y);
    void freed() override;
    bool judge_exactly(bool exact, double residual, int rounds) override;

    int threads() const;  // for loops over rows

    int nx_, ny_;
    double aspect_, unit_;
    StoredHeights heights_;
    Share share_;
    PeriodicPixels<float> inner_;
    std::unique_ptr<PeriodicPixels<double>> fine_;
    SparsePlane plane_;
    PixelStencil inverse_;  // preconditioner, within its reach and beyond
    std::unique_ptr<BlockCorrection> far_;
    bool far_is_set_ = false;
    std::unique_ptr<SplitPixels> split_;   // null: not for this grid
    std::vector<float> from_, to_, ones_;  // ones_: truncated K^-1 times 1 over the free pixels
    long products_ = 0;
    bool exact_ = false;                // the last product with p is in fine_ (true) or inner_
    std::vector<std::int32_t> column_;  // of the set
    std::vector<double> partial_;
    struct Penetration {
        std::int32_t column;
        double w;
    };
    std::vector<std::vector<Penetration>> outside_;  // by row: penetrating pixels outside the set, from the last outside()
};

}  // namespace rsc
