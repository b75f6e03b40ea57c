// Boundary-element contact on a periodic surface: 0 <= p, w = K p - (z - Z0) >= 0, p w = 0 on all
// pixels of the period, for a given mean pressure or separation. Products with K:
// elements/periodic_pixels.hpp.
#pragma once

#include "base/archive.hpp"
#include "elements/block_correction.hpp"
#include "elements/bounded.hpp"
#include "elements/pixel_products.hpp"

namespace rsc {

// Heights on the pixels of a period, row by row; they must outlive their users.
struct PeriodicHeights {
    int nx = 0, ny = 0;
    double dx = 0, dy = 0;  // sides of a pixel [length]
    const double* z = nullptr;
    std::ptrdiff_t stride = 0;  // between rows
};

// Active-set method of bounded.hpp. The conjugate gradients are preconditioned by K^-1 (modes E*
// |k|/2) truncated to a few pixels, with a correction for what is farther apart
// (block_correction.hpp), and the start is the solution on a grid of half as many pixels per side
// (recursively), so that both short and long waves converge in few steps. Products are in single
// precision while the error is large; the final error is computed in double precision. Levels are
// independent of each other.
class PeriodicElements : private BoundedSolver<float> {
public:
    // Pressures are limited to `highest` (the hardness; Infinity: no limit); where p = highest, w
    // may be negative. Throws Error(bad_input) if all heights are equal, Error(no_memory).
    PeriodicElements(const PeriodicHeights& heights, const Substrate& substrate, double highest);

    // Solves for a given mean pressure > 0, or a separation Z0 (from z = 0 to the flat; the mean of
    // K p is 0). approach() throws Error(bad_input) at full contact, where Z0 does not determine
    // the pressure.
    ElementsOutcome press(double mean_pressure, double tolerance, int most_iterations);
    ElementsOutcome approach(double Z0, double tolerance, int most_iterations);

    // True if the last solution has all points in contact and none at the highest pressure: the
    // pressures then grow without any change of the separation.
    bool full() const {
        return !(diagonal_ > 0 || highest_ < kInfinity) &&
               p_.size() == at(heights_.nx) * at(heights_.ny) &&
               std::ranges::all_of(p_, [](double p) { return p > 0; });
    }

    // Separation of full contact: the mean height, to rounding. None with a highest pressure,
    // because pixels at this pressure can penetrate.
    double closed() const;

    // Lowers the pixels at the highest pressure by their penetration, for which the last solution
    // remains valid. Returns these pixels and depths; the owner of the heights must lower them and
    // call heights_changed().
    std::vector<std::pair<Pixel, double>> press_out();
    // Following solutions have this on the diagonal, added to K [length/pressure], for which there
    // is a solution at full contact, too. settle() lowers the pixels by it times their pressures,
    // for which the last solution remains valid, and sets it to 0; as after press_out().
    void set_diagonal(double diagonal);
    using BoundedSolver::settle;
    void heights_changed() {
        mean_ = mean_height();
        closing_.reset();
    }

    // K p at all points, row by row, for pressures p on some of them; its mean is 0.
    std::vector<double> deflections(const std::vector<Pixel>& pixels, const std::vector<double>& p);

    // Results of the last solution:
    double separation() const { return zero_ + Z0_ * rms_; }
    const std::vector<Pixel>& pixels() const { return pixels_; }  // under pressure, row by row
    const std::vector<double>& pressures() const { return pressures_; }  // of these pixels
    // -d(mean pressure)/dZ0, not in full contact. For further loading, pixels at the highest
    // pressure keep it; for unloading (`back`) they are elastic.
    double stiffness(bool back);
    // p'Kp/2 per pixel, with an error of the order of the square of the residual.
    double energy() const;

    // As Model: the last solution.
    void keep(ArchiveWriter& to) const;
    void recall(ArchiveReader& from);

private:
    // Controlled quantity: the mean of p over the grid (only without a highest pressure), or Z0.
    struct Given {
        bool is_pressure;
        double value;
    };
    using Share = std::function<double(double)>;  // as for PeriodicPixels with dx = 1

    // The same surface on a grid of half as many pixels per side, whose heights, coarse_heights(),
    // are already in units of rms_.
    PeriodicElements(const PeriodicElements& finer, const std::vector<double>& heights);
    std::vector<double> coarse_heights() const;
    void prepare();
    void prepare_inverse();

    template <class F>
    double mean_of(F&& f) const;
    double mean_height() const;
    double points() const { return static_cast<double>(heights_.nx) * heights_.ny; }
    double height(int j, int i) const {
        return (heights_.z[j * heights_.stride + i] - zero_) * scale_;
    }
    int threads() const;  // for loops over rows
    PeriodicPixels<double>& fine();
    // Calls take(row number, row) with K^-1 z.
    template <class F>
    void flattening(F&& take);
    // Mean pressure that closes the gap, -min of K^-1 z; Infinity where none does.
    double closing_pressure();
    ElementsOutcome flatten(double tolerance);

    // Sets starting pressures: uniform, or Hertz-like where z > Z0; or those of a coarser grid.
    void start(Given given);
    void start(const PeriodicElements& coarse);
    bool bare() const;  // true without any pressure
    // Iterates until error() is below the tolerance, in single precision; on the finest grid the
    // error is computed in double precision.
    ElementsOutcome solve(Given given, double tolerance, int most_iterations, bool finest);
    std::vector<std::size_t> pressed_by_row() const;
    std::vector<Pixel> set() const;  // the pixels under pressure and some others, row by row

    void multiply(const Array<double>& x, Array<double>& Kx, bool exact) override;
    void multiply_roughly(const Array<float>& x, Array<float>& Kx) override;
    template <class Real, class T>
    void multiply_by(PeriodicPixels<Real>& pixels, const Array<T>& x, Array<T>& Kx);
    double outside() override;
    void clip() override;
    void renew() override;
    void precondition(const Array<float>& r, Array<float>& y) override;
    void precondition_ones(Array<float>& y) override;
    void correct(const Array<float>& r, Array<float>& y);
    void freed() override;
    bool judge_exactly(bool exact, double residual, int rounds) override;

    PeriodicHeights heights_;
    Substrate substrate_;
    double highest_pressure_;
    // Units in which values are of order 1: heights are relative to `zero_` in units of `rms_`
    // (both of the initial heights), pressures in units of E* rms/dx with the dx of the finest
    // grid. K is `unit_` times that of PeriodicPixels with dx = 1.
    double zero_ = 0, rms_ = 1, scale_ = 1, pressure_unit_ = 1, unit_ = 1;
    double mean_ = 0;                // mean of the current heights
    std::optional<double> closing_;  // closing_pressure(), once it is known
    double aspect_;                  // dy/dx
    double inverse_of_ = 0;          // the diagonal for which the preconditioner is
    Array<double> transformed_;      // the plane of inner_ or of fine_, whichever was used last
    PeriodicPixels<float> inner_;
    std::unique_ptr<PeriodicPixels<double>> fine_;
    SparsePlane plane_;
    PixelStencil inverse_;  // preconditioner, within its reach and beyond
    std::unique_ptr<BlockCorrection> far_;
    bool far_is_set_ = false;
    std::unique_ptr<SplitPixels> split_;  // null: not for this grid
    Array<float> ones_;                   // truncated K^-1 times 1 over the free pixels
    long products_ = 0;
    bool exact_ = false;               // the last product with p is that of fine_, not of inner_
    Array<std::int32_t> column_;       // of the set
    Array<std::int32_t> next_column_;  // inside renew()
    struct Penetration {
        std::int32_t column;
        double w;
    };
    std::vector<std::vector<Penetration>>
        outside_;  // by row: penetrating pixels outside the set, from the last outside()
    std::vector<Pixel> pixels_;
    std::vector<double> pressures_;
};

}  // namespace rsc
