// Pressures between bounds on the pixels of a surface: 0 <= p <= highest and w = K p - z + Z0, with
//     w >= 0 where p = 0,   w = 0 in between,   w <= 0 where p = highest,
// at a given Z0, or at the Z0 where p has a given sum. K is symmetric and positive definite (but for a constant, between flats): the
// pressures are the one minimum of the energy p'Kp/2 - (z - Z0)'p between the bounds.
//
// Primal-dual active set: in every round the pixels that are not held at a bound are found, some steps of conjugate gradients are made on
// them, and pressures beyond a bound are cut off. Where the sets do not settle in some rounds the energy is made to fall in every one, so
// that rounds cannot repeat. What K is, how it is preconditioned, and which pixels are looked at, classes below this one say.
#pragma once

#include "std.hpp"

namespace rsc {

struct ElementsOutcome {
    bool converged = false;
    int iterations = 0;   // rounds: sets of pixels under pressure tried
    long products = 0;    // products with K
    double residual = 0;  // what the conditions miss: see BoundedSolver::error
};

class BoundedSolver {
public:
    virtual ~BoundedSolver() = default;

    // p'Kp/2 of the last answer, evaluated as (z - Z0)'p - p'Kp/2 = sum p (z - Z0 - w)/2, which equals it at the solution; pixels at the
    // highest pressure with p (z - Z0 + w)/2.
    double energy() const;

protected:
    struct Manner {
        int steps;         // of conjugate gradients in a round, at most
        double reduction;  // of the preconditioned residual, that ends a round sooner
        int quick;         // rounds from which the energy is watched: sets that settle need fewer
        bool repeats;      // a period: the set is renewed in every round, pixels outside it count, a constant pressure is a step of its own
    };
    BoundedSolver(double highest, Manner manner) : highest_(highest), manner_(manner) {}

    // Kx = K x over the set: the cheaper way that iterations are made of, or the exact one that answers are judged by.
    virtual void multiply(const std::vector<double>& x, std::vector<double>& Kx, bool exact) = 0;
    // y = about K^-1 r over the pixels that are free_, 0 elsewhere.
    virtual void precondition(const std::vector<double>& r, std::vector<double>& y) = 0;
    // Sum of the squares of the penetrations of pixels outside the set, by the last multiply() with p.
    virtual double outside() { return 0; }
    // The set for the next round, p_, w_ and z_ with it.
    virtual void renew() {}
    // free_ has changed.
    virtual void freed() {}
    // Whether the round that ends is judged exactly; the last one was or was not, and before it the residual was so large.
    virtual bool judge_exactly(bool exact, double residual, int rounds) = 0;
    // Whether a set that is `solved` or not is the whole. If not, the set has changed, and p_ and z_ with it.
    virtual bool complete(bool solved, double residual) { return (void)residual, solved; }

    // From p_ over the set until error() is below the tolerance, `exactly` or not.
    ElementsOutcome iterate(double tolerance, int most_rounds, bool exactly);
    // Sum of q over the pixels under pressure, where K q = 1: -d(sum of p)/dZ0. Pressed further, pixels at the highest pressure keep it; on
    // the way `back` they are elastic. Rounds of conjugate gradients until K q misses 1 by less than the tolerance; a single one is not judged.
    double stiffness(bool back, double tolerance, int most_rounds, int most_steps, double reduction);
    // Pixels at the highest pressure, where they penetrate, are lowered by it: returns their positions in the set, and how far.
    std::vector<std::pair<int, double>> press_out();

    void evaluate(bool exact);
    // Rms of w where 0 < p < highest and of penetrations left elsewhere, over the number of pixels under pressure, by the mean of z - Z0
    // weighted with p.
    double error();
    void find_free();
    void descend(int most_steps, double reduction);
    bool bound();
    bool fell();
    template <class F>
    double sum(F&& of);  // over the positions in the set, the same whatever the threads

    double highest_;
    Manner manner_;
    std::optional<double> wanted_;  // the sum of p; none: Z0 is given
    double Z0_ = 0;
    // Over the set, and where its rows begin: pixels of a row are summed by one thread.
    std::vector<std::size_t> rows_ = {0, 0};
    std::vector<double> z_, p_, w_;
    std::vector<char> free_;  // not held at a bound

private:
    std::vector<double> y_, one_, direction_, image_, before_p_, before_w_, partial_;
};

}  // namespace rsc
