// The contact of elements: p >= 0, w = K p - g0 >= 0, p w = 0 on the pixels of a surface. K is symmetric and positive definite: the
// pressures are the one minimum of the energy p'Kp/2 - g0'p over p >= 0.
#pragma once

#include "contact/interaction/pixel_products.hpp"
#include "contact/solver/spot_blocks.hpp"

namespace rsc {

struct ElementsOutcome {
    bool converged = false;
    int iterations = 0;   // rounds: sets of pixels under pressure tried
    long products = 0;    // products with K
    double residual = 0;  // what the conditions miss: see ElementsSolver::error
};

// Primal-dual active set: pixels whose pressure falls below 0 leave, pixels that penetrate enter, some steps of conjugate gradients on
// the pixels under pressure in between, preconditioned by every spot solved alone. Where the sets do not settle in some rounds, the
// energy is made to fall in every round, so that rounds cannot repeat. Pixels far from pressure stay outside a working set, and are checked at the end.
class ElementsSolver {
public:
    // Pressures are bounded by `highest` (the hardness; Infinity: none): where p = highest, w may be negative.
    ElementsSolver(PixelProducts& products, double highest);

    // Pixels that may touch, row by row (y, then x), their penetrations without deformation g0 > 0 [length], and pressures to start
    // from (all zero: a start is made here), which become the answer; all in the pixels' order.
    ElementsOutcome solve(const std::vector<Pixel>& pixels, const std::vector<double>& g0, double tolerance, int most_iterations,
                          std::vector<double>& p);

    // Plastic residual of the last solution: pixels at the highest pressure with w < 0, and -w, row by row. It is subtracted from g0: the
    // same pressures then leave no penetration anywhere.
    void press_out(std::vector<Pixel>& pixels, std::vector<double>& depth);

    // -d(sum of p)/dZ0 of the last answer: sum of q over the pixels under pressure, where K q = 1, to a relative residual of
    // `tolerance`. Pressed further, pixels at the highest pressure keep it; on the way back they are elastic.
    enum class Way { further, back };
    double stiffness(double tolerance, Way way);

    // p'Kp/2 of the last answer, evaluated as g0'p - p'Kp/2 = sum p (g0 - w)/2, which equals it at the solution; pixels at the highest
    // pressure with p (g0 + w)/2.
    double energy() const;

private:
    void start(const std::vector<Pixel>& pixels, const std::vector<double>& g0, std::vector<double>& p);
    std::size_t guess(const std::vector<Pixel>& pixels, const std::vector<double>& g0, const std::vector<double>& over, double& least,
                      std::vector<double>& p);
    void draw(const std::vector<Pixel>& pixels, const std::vector<double>& g0, const std::vector<double>& p);
    void evaluate(PixelProducts::Accuracy accuracy);
    void find_free();
    void descend(int most_steps, double reduction);
    long bound();
    void keep_falling(PixelProducts::Accuracy accuracy);
    long join(const std::vector<Pixel>& pixels, const std::vector<double>& g0);
    // Rms of w where 0 < p < highest and of penetrations left elsewhere, over the number of pixels under pressure, by the mean of g0
    // weighted with p.
    double error() const;

    PixelProducts& products_;
    double highest_;
    // The working set: positions in the pixels given, values. `member_`: pixels given that belong to it whatever their pressure.
    std::vector<char> member_;
    std::vector<int> position_;
    std::vector<Pixel> set_;
    std::vector<double> g0_, p_, w_, direction_, image_, before_p_, before_w_;
    // Positions in the working set of the pixels that are neither held at 0 nor at the highest pressure.
    std::vector<int> free_;
    std::vector<double> r_, z_;
    SpotBlocks blocks_;
};

}  // namespace rsc
