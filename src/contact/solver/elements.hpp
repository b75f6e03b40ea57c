// The contact of elements on a free surface: BoundedSolver on the pixels that may touch, with the Z0 in their penetrations. Pixels far from
// pressure stay outside a working set and are checked at the end; conjugate gradients are preconditioned by every spot solved alone.
#pragma once

#include "contact/interaction/pixel_products.hpp"
#include "contact/solver/bounded.hpp"
#include "contact/solver/spot_blocks.hpp"

namespace rsc {

class ElementsSolver : private BoundedSolver {
public:
    // Pressures are bounded by `highest` (the hardness; Infinity: none): where p = highest, w may be negative.
    ElementsSolver(PixelProducts& products, double highest);

    // Pixels that may touch, row by row (y, then x), their penetrations without deformation g0 > 0 [length], and pressures to start
    // from (all zero: a start is made here), which become the answer; all in the pixels' order.
    // With a `sum` of the pressures, g0 is known but for a constant: the answer is that for g0 - rise(). Pressures to start from are then
    // wanted, and rise() < 0 means that pixels may be missing.
    ElementsOutcome solve(const std::vector<Pixel>& pixels, const std::vector<double>& g0, double tolerance, int most_iterations,
                          std::vector<double>& p, std::optional<double> sum = std::nullopt);
    double rise() const { return Z0_; }

    // Plastic residual of the last solution: pixels at the highest pressure with w < 0, and -w, row by row. It is subtracted from g0: the
    // same pressures then leave no penetration anywhere.
    void press_out(std::vector<Pixel>& pixels, std::vector<double>& depth);

    // -d(sum of p)/dZ0 of the last answer, to a relative residual of `tolerance`: BoundedSolver::stiffness.
    double stiffness(double tolerance, bool back);
    using BoundedSolver::energy;

private:
    void start(const std::vector<Pixel>& pixels, const std::vector<double>& g0, std::vector<double>& p);
    std::size_t guess(const std::vector<Pixel>& pixels, const std::vector<double>& g0, const std::vector<double>& over, double& least,
                      std::vector<double>& p);
    void draw(const std::vector<double>& p);
    void multiply(const std::vector<double>& x, std::vector<double>& Kx, bool exact) override;
    void precondition(const std::vector<double>& r, std::vector<double>& y) override;
    void freed() override;
    bool judge_exactly(bool exact, double residual, int rounds) override;
    bool complete(bool solved, double residual) override;
    long join();

    PixelProducts& products_;
    // The pixels given, those of them that belong to the working set whatever their pressure, and whether those outside were looked at.
    const std::vector<Pixel>* pixels_ = nullptr;
    const std::vector<double>* g0_ = nullptr;
    std::vector<char> member_;
    bool looked_ = false;
    double tolerance_ = 0;
    // The working set: positions in the pixels given, places.
    std::vector<int> position_;
    std::vector<Pixel> set_;
    std::vector<double> r_, y_;            // over the free ones
    std::vector<double> full_p_, full_w_;  // of the last full product with this set
    SpotBlocks blocks_;
};

}  // namespace rsc
