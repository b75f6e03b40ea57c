// Boundary-element contact on a free surface: BoundedSolver on the pixels that may touch, with Z0
// included in their penetrations. Pixels far from pressure are outside a working set and checked at
// the end. The preconditioner is the inverse of K between near pixels.
#pragma once

#include "base/archive.hpp"
#include "elements/bounded.hpp"
#include "elements/pixel_products.hpp"

namespace rsc {

// Whether all pixels lie on a map of this size.
bool within(const std::vector<Pixel>& pixels, int columns, int rows);

class ElementsSolver : private BoundedSolver<double> {
public:
    // Pressures are limited to `highest` (the hardness; Infinity: no limit); where p = highest, w
    // may be negative.
    ElementsSolver(PixelProducts& products, double highest);

    // Solves for the pixels that may touch, row by row (y, then x), with penetrations without
    // deformation g0 [length]: > 0, or larger than the height by which pressures raise other points
    // if K is not positive everywhere (layers without a shift), with its sign changed. p contains
    // starting pressures (all zero: none) and receives the solution. All vectors are in the order
    // of the pixels. If the `sum` of the pressures is given, g0 is known up to a constant, and the
    // solution is that for g0 - rise(). Starting pressures are then required, and rise() < 0 means
    // that pixels may be missing.
    ElementsOutcome solve(const std::vector<Pixel>& pixels, const std::vector<double>& g0,
                          double tolerance, int most_iterations, std::vector<double>& p,
                          std::optional<double> sum = std::nullopt);
    double rise() const { return Z0_; }

    // Following solutions have this on the diagonal, added to K; settle() ends it.
    void set_diagonal(double diagonal) { diagonal_ = diagonal; }
    using BoundedSolver::settle;

    // Plastic residual of the last solution: the pixels at the highest pressure with w < 0, and -w,
    // row by row.
    std::vector<std::pair<Pixel, double>> press_out();

    // -d(sum of p)/dZ0 of the last solution, to a relative residual of `tolerance`
    // (BoundedSolver::stiffness).
    double stiffness(double tolerance, bool back);
    using BoundedSolver::energy;

    // As Model: the last solution, of pixels within the map.
    void keep(ArchiveWriter& to) const;
    void recall(ArchiveReader& from, int columns, int rows);

private:
    void start(const std::vector<Pixel>& pixels, const std::vector<double>& g0,
               std::vector<double>& p);
    std::size_t guess(const std::vector<Pixel>& pixels, const std::vector<double>& g0,
                      const std::vector<double>& over, double& least, std::vector<double>& p);
    void draw(const std::vector<double>& p);
    void multiply(const Array<double>& x, Array<double>& Kx, bool exact) override;
    void multiply_roughly(const Array<double>& x, Array<double>& Kx) override;
    void precondition(const Array<double>& r, Array<double>& y) override;
    void enclose();
    void freed() override;
    bool judge_exactly(bool exact, double residual, int rounds) override;
    bool complete(bool solved, double residual) override;
    bool join(const std::vector<double>& p);
    void spread(std::vector<double>& p);

    PixelProducts& products_;
    // The given pixels, the members (always in the working set), and whether pixels outside have
    // been checked.
    const std::vector<Pixel>* pixels_ = nullptr;
    const std::vector<double>* g0_ = nullptr;
    std::vector<double>* answer_ = nullptr;
    std::vector<char> member_;
    bool looked_ = false;
    double tolerance_ = 0;
    // Working set: whether a given pixel is in it, positions in the given pixels, and pixels.
    std::vector<char> in_, outside_;
    std::vector<int> position_;
    std::vector<Pixel> set_;
    Array<double> full_p_, full_w_,
        step_;                       // last full product with this set, and the step since
    std::vector<double> elsewhere_;  // deflections of all pixels
    // Preconditioner: products.inverse() for a diagonal, and the set on a plane that encloses it.
    PixelStencil inverse_;
    double inverse_of_ = 0;
    SparsePlane plane_{0, 0};
    std::vector<std::size_t> plane_rows_;
    std::vector<std::int32_t> column_;
    Array<float> from_, to_;
};

}  // namespace rsc
