// Bounded pressures on the pixels of a surface: 0 <= p <= highest and w = K p - z + Z0, with
//     w >= 0 where p = 0,   w = 0 in between,   w <= 0 where p = highest,
// for a given Z0, or a given sum of p. K is symmetric and positive definite (except for constants
// between periodic flats), so that p is the unique minimum of the energy p'Kp/2 - (z - Z0)'p within
// the bounds.
//
// To K is added a `diagonal`: the deflection of a pixel by the pressure on itself alone, as by wear
// in a step of sliding.
//
// Primal-dual active-set method: every round determines the free pixels (not held at a bound),
// makes some steps of conjugate gradients on them, releases those beyond their bounds and makes
// some steps on the others. If the sets do not converge in some rounds, the energy is forced to
// decrease in every round, which excludes cycles. Derived classes define K, the preconditioner and
// the set of pixels.
#pragma once

#include "base/array.hpp"
#include "base/parallel.hpp"

namespace rsc {

struct ElementsOutcome {
    bool converged = false;
    int iterations = 0;   // rounds, i.e. active sets tried
    long products = 0;    // products with K
    double residual = 0;  // violation of the conditions, BoundedSolver::error()
    // Largest violation by the pressures of the solution; NaN unless their product was exact.
    double certificate = std::numeric_limits<double>::quiet_NaN();
};

// Real is the type of what is used inside a round only.
template <class Real>
class BoundedSolver {
public:
    virtual ~BoundedSolver() = default;

    // p'Kp/2 of the last solution, evaluated as (z - Z0)'p - p'Kp/2 = sum p (z - Z0 - w)/2, which
    // is equal at the solution; for pixels at the highest pressure as p (z - Z0 + w)/2.
    double energy() const;

    // The last solution, to which energy() and stiffness() refer.
    template <class Archive, class Self>
    static void archive(Archive& a, Self& my) {
        a(my.given_sum_, my.Z0_, my.diagonal_, my.rows_, my.z_, my.p_, my.w_);
    }

protected:
    // Whether an archived solution is one of n pixels.
    bool fits(std::size_t n) const {
        return z_.size() == n && p_.size() == n && w_.size() == n && rows_.size() > 1 &&
               rows_.front() == 0 && rows_.back() == n && std::ranges::is_sorted(rows_);
    }
    struct Manner {
        int steps;         // largest number of conjugate-gradient steps in a round
        double reduction;  // reduction of the preconditioned residual that ends a round earlier
        int quick;  // rounds after which the energy is monitored; most sets converge in fewer
        // Periodic surface: the set is renewed in every round, errors outside it are included, and
        // a constant pressure is a separate step.
        bool repeats;
    };
    BoundedSolver(double highest, Manner manner) : highest_(highest), manner_(manner) {}

    // Kx = K x over the set: approximate for iterations, or exact for the final error.
    virtual void multiply(const Array<double>& x, Array<double>& Kx, bool exact) = 0;
    // The same to some per cent, for steps inside a round if every round starts from a better
    // product.
    virtual void multiply_roughly(const Array<Real>& x, Array<Real>& Kx) = 0;
    // Preconditioner: y approximates K^-1 r over the free pixels and is 0 elsewhere, as it is
    // everywhere on entry.
    virtual void precondition(const Array<Real>& r, Array<Real>& y) = 0;
    // The same for r = 1.
    virtual void precondition_ones(Array<Real>& y);
    // Sum of the squared penetrations of pixels outside the set, from the last multiply() with p.
    virtual double outside() { return 0; }
    // Clips pressures at their bounds.
    virtual void clip();
    // Updates the set for the next round, including p_, w_ and z_.
    virtual void renew() {}
    // Called when free_ has changed.
    virtual void freed() {}
    // True if the error of this round is to be computed exactly, given whether the last one was
    // exact, the previous residual and the number of rounds.
    virtual bool judge_exactly(bool exact, double residual, int rounds) = 0;
    // True if the set is complete. Returns false if the set, p_ and z_ have been changed.
    virtual bool complete(bool solved, double residual) { return (void)residual, solved; }

    // Iterates from p_ over the set until error() is below the tolerance, computed exactly if
    // `exactly`.
    ElementsOutcome iterate(double tolerance, int most_rounds, bool exactly);
    // -d(sum of p)/dZ0, the sum of q over the pixels under pressure where K q = 1. For further
    // loading, pixels at the highest pressure keep it; for unloading (`back`) they are elastic.
    // Iterates until the residual of K q = 1 is below the tolerance; not tested after a single
    // round.
    double stiffness(bool back, double tolerance, int most_rounds, int most_steps,
                     double reduction);
    // Lowers the pixels at the highest pressure by their penetration. Returns their positions in
    // the set, and the depths.
    std::vector<std::pair<int, double>> press_out();
    // Lowers each pixel by `diagonal` times its pressure and sets the diagonal to 0, for which the
    // last solution remains valid.
    void settle();

    void evaluate(bool exact);
    // Relative error: rms (per pixel under pressure) of w where 0 < p < highest and of penetrations
    // elsewhere, divided by the mean of |z - Z0| weighted with p.
    double error();
    // The largest of the penetration w < 0 at a pixel without pressure, and of |w| at one between
    // its bounds, both over the mean of |z - Z0| weighted with p, of the complementarity sum |p w|
    // over sum p |z - Z0|, and of the difference of the given sum of p over this sum.
    double certificate();
    void find_Z0();
    // Returns the decrease of p'Kp - 2 (z - Z0)'p by its steps.
    double descend(int most_steps, double reduction);
    void prepare_constant(bool plain);
    void release(int most_steps);
    bool many_beyond();
    void bound();
    bool fell();
    static constexpr int kPixels = 4096, kRows = 8;  // that a thread takes at a time
    static int threads_for(std::size_t pixels) { return pixels >= 16384 ? 0 : 1; }
    // Over the positions in the set, independent of the number of threads: calls, sums, and sums of
    // what is 0 where it is not free.
    template <class F>
    void each(F&& of) {
        parallel_for(p_.size(), kPixels, threads_for(p_.size()), of);
    }
    template <class Sum, class F>
    Sum sum_with(F&& add) const;  // add(part, k) adds to a part of the sum
    template <class Sum, class F>
    Sum total_free(F&& add);
    template <class F>
    double sum_free(F&& of);
    template <class F>
    void set_free(F&& of);

    double highest_;
    double diagonal_ = 0;
    Manner manner_;
    std::optional<double> given_sum_;  // given sum of p; absent: Z0 is given
    double Z0_ = 0;
    // Vectors over the set, and the beginnings of its rows, or of parts of it; a row is summed by
    // one thread.
    std::vector<std::size_t> rows_ = {0, 0};
    Array<double> z_, p_, w_;
    Array<char> free_;                   // not held at a bound
    std::vector<int> free_list_;         // their positions; not if `repeats`
    Array<Real> residual_;               // inside a descent; free for use outside
    Array<double> before_p_, before_w_;  // before a round; of no meaning in renew()

private:
    struct Products {
        double y = 0, residual_y = 0, residual_one = 0;
        Products operator+(const Products& o) const {
            return {y + o.y, residual_y + o.residual_y, residual_one + o.residual_one};
        }
    };
    Products sums_of_step(bool constant);
    void find_free();
    template <class T>
    void add_diagonal(const Array<T>& x, Array<T>& Kx) {
        if (diagonal_ > 0) each([&](std::size_t k) { Kx[k] += static_cast<T>(diagonal_) * x[k]; });
    }
    Array<Real> y_, direction_, image_;
    // Correction by a constant pressure on the free pixels, which is most effective near full
    // contact: M 1 (M: preconditioner), its sum, and 1/((M 1)'K (M 1)).
    Array<Real> one_;
    double whole_ = 0, punch_ = 0;
};

template <class Real>
template <class Sum, class F>
Sum BoundedSolver<Real>::sum_with(F&& add) const {
    const int rows = static_cast<int>(rows_.size()) - 1;
    return sum_in_order<Sum>(rows, kRows, threads_for(p_.size()), [&](int j) {
        Sum part{};
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) add(part, k);
        return part;
    });
}

extern template class BoundedSolver<float>;
extern template class BoundedSolver<double>;

}  // namespace rsc
