#include "elements/bounded.hpp"

#include "base/parallel.hpp"

namespace rsc {
namespace {

// Error, and share of the free pixels beyond their bounds, above which a round has a second part.
constexpr double kUnsettled = 1e-3, kMany = 0.02;
// Later rounds of a stiffness reduce the residual to this part of its tolerance.
constexpr double kEnough = 0.8;
// Part of a stiffness that products inside a round, exact to some per cent, determine well enough.
constexpr double kSmall = 5e-5;

}  // namespace

template <class Real>
template <class Sum, class F>
Sum BoundedSolver<Real>::total_free(F&& add) {
    if (manner_.repeats) return sum_with<Sum>(add);
    const std::size_t n = free_list_.size();
    const std::size_t pieces = (n + kPixels - 1) / kPixels;
    return sum_in_order<Sum>(pieces, 1, threads_for(n), [&](std::size_t piece) {
        Sum part{};
        for (std::size_t k = piece * kPixels; k < std::min(n, (piece + 1) * kPixels); ++k)
            add(part, at(free_list_[k]));
        return part;
    });
}

template <class Real>
template <class F>
double BoundedSolver<Real>::sum_free(F&& of) {
    return total_free<double>([&](double& part, std::size_t k) { part += of(k); });
}

template <class Real>
template <class F>
void BoundedSolver<Real>::set_free(F&& of) {
    free_.resize(p_.size());
    const auto set = [&](std::size_t k) { return free_[k] = of(k); };
    if (manner_.repeats)
        each(set);
    else
        find_all(p_.size(), kPixels, threads_for(p_.size()), set, free_list_);
    freed();
}

template <class Real>
void BoundedSolver<Real>::evaluate(bool exact) {
    stopping_point();
    multiply(p_, w_, exact);
    add_diagonal(p_, w_);
    if (given_sum_) Z0_ = 0;
    each([&](std::size_t k) { w_[k] += Z0_ - z_[k]; });
    find_Z0();
}

// If the sum of p is given, sets Z0 such that the mean of w over the pixels under pressure is 0.
template <class Real>
void BoundedSolver<Real>::find_Z0() {
    if (!given_sum_) return;
    struct Sums {
        std::size_t touching = 0;
        double w = 0;
        Sums operator+(const Sums& o) const { return {touching + o.touching, w + o.w}; }
    };
    const Sums sums = sum_with<Sums>([&](Sums& part, std::size_t k) {
        if (!(p_[k] > 0)) return;
        ++part.touching;
        part.w += w_[k];
    });
    if (sums.touching == 0) return;
    const double shift = -sums.w / static_cast<double>(sums.touching);
    Z0_ += shift;
    each([&](std::size_t k) { w_[k] += shift; });
}

template <class Real>
double BoundedSolver<Real>::error() {
    struct Sums {
        std::size_t touching = 0;
        double weight = 0, inside = 0, overlap = 0;
        Sums operator+(const Sums& o) const {
            return {touching + o.touching, weight + o.weight, inside + o.inside,
                    overlap + o.overlap};
        }
    };
    const Sums sums = sum_with<Sums>([&](Sums& part, std::size_t k) {
        if (p_[k] == 0 && w_[k] >= 0) return;
        const double e = p_[k] >= highest_ ? std::max(w_[k], 0.0)
                         : p_[k] > 0       ? w_[k]
                                           : std::min(w_[k], 0.0);
        part.inside += e * e;
        part.touching += p_[k] > 0;
        part.weight += p_[k];
        part.overlap += p_[k] * std::abs(z_[k] - Z0_);
    });
    const double bad = sums.inside + outside();
    if (sums.touching == 0) return bad > 0 ? kInfinity : 0.0;
    return std::sqrt(bad / static_cast<double>(sums.touching)) / (sums.overlap / sums.weight);
}

template <class Real>
double BoundedSolver<Real>::certificate() {
    struct Sums {
        double largest = 0, weight = 0, overlap = 0, product = 0;
        Sums operator+(const Sums& o) const {
            return {std::max(largest, o.largest), weight + o.weight, overlap + o.overlap,
                    product + o.product};
        }
    };
    const Sums sums = sum_with<Sums>([&](Sums& part, std::size_t k) {
        const bool held = p_[k] >= highest_, pressed = p_[k] > 0;
        const double violation = held      ? std::max(w_[k], 0.0)
                                 : pressed ? std::abs(w_[k])
                                           : std::max(-w_[k], 0.0);
        part.largest = std::max(part.largest, violation);
        part.weight += p_[k];
        part.overlap += p_[k] * std::abs(z_[k] - Z0_);
        part.product += p_[k] * violation;
    });
    if (!(sums.weight > 0)) return 0;
    const double overlap = sums.overlap,
                 load = given_sum_ ? std::abs(sums.weight / *given_sum_ - 1) : 0.0,
                 farthest = std::max(sums.largest, std::sqrt(outside()));
    return std::max({farthest * sums.weight / overlap, sums.product / overlap, load});
}

template <class Real>
void BoundedSolver<Real>::find_free() {
    set_free([&](std::size_t k) {
        return !((p_[k] <= 0 && w_[k] >= 0) || (p_[k] >= highest_ && w_[k] <= 0));
    });
}

template <class Real>
void BoundedSolver<Real>::precondition_ones(Array<Real>& y) {
    residual_.assign(free_.begin(), free_.end());
    y.assign(free_.size(), Real(0));
    precondition(residual_, y);
}

// Leaves K one_ in image_ where it computes punch_.
template <class Real>
void BoundedSolver<Real>::prepare_constant(bool plain) {
    if (!manner_.repeats && !given_sum_) return;
    if (plain)
        one_.assign(free_.begin(), free_.end());
    else
        precondition_ones(one_);
    whole_ = sum_free([&](std::size_t k) { return double(one_[k]); });
    punch_ = 0;
    if (given_sum_ || plain) return;
    multiply_roughly(one_, image_);
    add_diagonal(one_, image_);
    const double energy = sum_free(
        [&](std::size_t k) { return free_[k] ? double(one_[k]) * double(image_[k]) : 0.0; });
    if (energy > 0) punch_ = 1 / energy;
}

// Sums of y, of the residual times y and, if `constant`, times one_.
template <class Real>
auto BoundedSolver<Real>::sums_of_step(bool constant) -> Products {
    return total_free<Products>([&](Products& part, std::size_t k) {
        const double r = residual_[k], y = y_[k];
        part.y += y;
        part.residual_y += r * y;
        if (constant) part.residual_one += r * double(one_[k]);
    });
}

// Conjugate gradients on the free pixels. If the sum of p is given, it is kept constant, and w is
// minimised up to a constant.
template <class Real>
double BoundedSolver<Real>::descend(int most_steps, double reduction) {
    const std::size_t n = p_.size();
    // A single step follows the gradient itself, which remains a descent direction after projection
    // on the bounds.
    const bool plain = most_steps == 1, constant = manner_.repeats || given_sum_;
    for (auto* v : {&residual_, &y_, &direction_}) v->resize(n);
    const auto set_residual = [&](std::size_t k) {
        residual_[k] = free_[k] ? static_cast<Real>(0 - w_[k]) : Real(0);
        y_[k] = 0;
    };
    each(set_residual);
    double last = 0, first = 0, decrease = 0;
    for (int step = 0; step < most_steps; ++step) {
        if (plain)
            y_ = residual_;
        else
            precondition(residual_, y_);
        const Products products = sums_of_step(constant);
        const double c = !constant    ? 0
                         : given_sum_ ? -products.y / whole_
                                      : punch_ * products.residual_one,
                     ry = products.residual_y + c * products.residual_one;
        if (step == 0) first = ry;
        if (!(ry > reduction * reduction * first)) break;
        const auto beta = static_cast<Real>(step > 0 ? ry / last : 0.0);
        last = ry;
        each([&](std::size_t k) {
            const Real y = constant ? y_[k] + static_cast<Real>(c) * one_[k] : y_[k];
            direction_[k] = step > 0 ? y + beta * direction_[k] : y;
        });
        stopping_point();
        multiply_roughly(direction_, image_);
        add_diagonal(direction_, image_);
        const double curvature =
            sum_free([&](std::size_t k) { return double(direction_[k]) * double(image_[k]); });
        if (!(curvature > 0)) break;
        const double alpha = ry / curvature;
        each([&](std::size_t k) {
            p_[k] += alpha * double(direction_[k]);
            w_[k] += alpha * double(image_[k]);
            set_residual(k);
        });
        decrease += alpha * ry;
    }
    return decrease;
}

template <class Real>
void BoundedSolver<Real>::clip() {
    each([&](std::size_t k) { p_[k] = std::clamp(p_[k], 0.0, highest_); });
}

// Clips pressures at their bounds, and restores their sum by adding pressure as a lower flat would.
template <class Real>
void BoundedSolver<Real>::bound() {
    clip();
    if (!given_sum_) return;
    constexpr int most = 50;
    for (int i = 0; i < most; ++i) {
        struct Sums {
            double all = 0, room = 0;
            Sums operator+(const Sums& o) const { return {all + o.all, room + o.room}; }
        };
        const Sums sums = sum_with<Sums>([&](Sums& part, std::size_t k) {
            part.all += p_[k];
            part.room += p_[k] > 0 ? double(one_[k]) : 0.0;
        });
        const double missing = *given_sum_ - sums.all;
        if (std::abs(missing) <= 1e-14 * *given_sum_ || !(sums.room > 0)) break;
        each([&](std::size_t k) {
            if (p_[k] > 0) p_[k] = std::max(p_[k] + missing / sums.room * double(one_[k]), 0.0);
        });
    }
}

// A round begins on all pixels that penetrate, which are more than those in contact: many end under
// tension. They are released, and the others descend again before pixels are added. For a matrix
// whose inverse has no positive element beside the diagonal, nearly the case of K, pixels released
// in this way need not return (R. Chandrasekaran, Opsearch 7 (1970) 263). Where additions and
// releases alternate in single steps, sets of many pixels may repeat without end.
template <class Real>
void BoundedSolver<Real>::release(int most_steps) {
    each([&](std::size_t k) { direction_[k] = static_cast<Real>(p_[k]); });
    bound();
    each([&](std::size_t k) { direction_[k] = static_cast<Real>(p_[k] - double(direction_[k])); });
    multiply_roughly(direction_, image_);
    add_diagonal(direction_, image_);
    each([&](std::size_t k) { w_[k] += double(image_[k]); });
    find_Z0();
    const Array<char> before = free_;
    set_free([&](std::size_t k) { return before[k] && p_[k] > 0 && p_[k] < highest_; });
    prepare_constant(most_steps == 1);
    descend(most_steps, manner_.reduction);
}

// Whether many of the free pixels are beyond their bounds.
template <class Real>
bool BoundedSolver<Real>::many_beyond() {
    struct Count {
        std::size_t beyond = 0, free = 0;
        Count operator+(const Count& o) const { return {beyond + o.beyond, free + o.free}; }
    };
    const Count count = sum_with<Count>([&](Count& part, std::size_t k) {
        if (!free_[k]) return;
        ++part.free;
        part.beyond += p_[k] < 0 || p_[k] > highest_;
    });
    return static_cast<double>(count.beyond) > kMany * static_cast<double>(count.free);
}

// Returns true if the last round lowered the energy; otherwise restores the best pressures along
// the step.
template <class Real>
bool BoundedSolver<Real>::fell() {
    struct Sums {
        double slope = 0, curvature = 0;
        Sums operator+(const Sums& o) const { return {slope + o.slope, curvature + o.curvature}; }
    };
    const auto [slope, curvature] = sum_with<Sums>([&](Sums& part, std::size_t k) {
        const double d = p_[k] - before_p_[k];
        part.slope += d * before_w_[k];
        part.curvature += d * (w_[k] - before_w_[k]);
    });
    if (slope + 0.5 * curvature <= 0) return true;
    const double t = slope < 0 && curvature > 0 ? std::min(1.0, -slope / curvature) : 0.5;
    each([&](std::size_t k) { p_[k] = before_p_[k] + t * (p_[k] - before_p_[k]); });
    return false;
}

template <class Real>
ElementsOutcome BoundedSolver<Real>::iterate(double tolerance, int most_rounds, bool exactly) {
    ElementsOutcome outcome;
    if (given_sum_) {  // the start may have another sum
        one_.resize(p_.size());
        each([&](std::size_t k) { one_[k] = static_cast<Real>(p_[k]); });
        bound();
    }
    before_p_.clear();
    bool exact = false;
    int steps = manner_.steps;
    double last = kInfinity;
    evaluate(false);
    for (;;) {
        outcome.residual = error();
        // A round that raised the energy is reduced to its best point, and the following rounds are
        // shorter.
        const bool watched =
            outcome.iterations > manner_.quick || (manner_.repeats && outcome.residual > last);
        if (watched && !before_p_.empty() && !fell()) {
            evaluate(exact);
            outcome.residual = error();
            steps = std::max(steps / 2, 1);
        } else {
            steps = std::min(steps + 1, manner_.steps);
        }
        last = outcome.residual;
        const bool judged =
            manner_.repeats ||
            outcome.iterations > 0;  // starts from other levels get at least one round
        const bool small = judged && outcome.residual <= tolerance;
        if (small && exactly && !exact) {
            exact = true;
            before_p_.clear();
            evaluate(true);
            continue;
        }
        if (judged) outcome.converged = complete(small, outcome.residual);
        if (w_.size() != p_.size()) evaluate(exact);  // the set has changed
        if (outcome.converged || outcome.iterations >= most_rounds) break;
        ++outcome.iterations;
        renew();
        find_free();
        if (manner_.repeats || outcome.iterations > manner_.quick) {
            before_p_ = p_;
            before_w_ = w_;
        }
        prepare_constant(steps == 1);
        descend(steps, manner_.reduction);
        // Rough solutions, which are only starting points, are not worth it.
        if (!manner_.repeats && tolerance < kUnsettled && outcome.residual > kUnsettled &&
            many_beyond())
            release(steps);
        bound();
        exact = exactly && judge_exactly(exact, outcome.residual, outcome.iterations);
        evaluate(exact);
    }
    if (exact) outcome.certificate = certificate();
    return outcome;
}

template <class Real>
double BoundedSolver<Real>::stiffness(bool back, double tolerance, int most_rounds, int most_steps,
                                      double reduction) {
    // Solves K q = 1 by the same iteration; the solution of the level is restored afterwards.
    const Array<double> p = p_, w = w_;
    const std::optional<double> given_sum = std::exchange(given_sum_, std::nullopt);
    set_free([&](std::size_t k) { return p_[k] > 0 && (back || p_[k] < highest_); });
    const double count = sum_free([&](std::size_t k) { return free_[k] ? 1.0 : 0.0; });
    each([&](std::size_t k) {
        p_[k] = 0;
        w_[k] = -1;
    });
    const auto rms = [&] {
        return std::sqrt(sum_free([&](std::size_t k) { return free_[k] ? w_[k] * w_[k] : 0.0; }) /
                         count);
    };
    const auto value = [&] {
        return sum_free([&](std::size_t k) { return free_[k] ? p_[k] * (1 - w_[k]) : 0.0; });
    };
    prepare_constant(false);
    if (const double c = whole_ * punch_; manner_.repeats && c > 0)  // the first step is known
        each([&](std::size_t k) {
            p_[k] = c * double(one_[k]);
            w_[k] = c * double(image_[k]) - 1;
        });
    double residual = 0, answer = 0;
    for (int round = 0; round < most_rounds && count > 0; ++round) {
        const double decrease =
            descend(most_steps,
                    round == 0 ? reduction : std::max(reduction, kEnough * tolerance / residual));
        if (manner_.repeats && round > 0 && decrease <= kSmall * answer && rms() <= tolerance) {
            residual = tolerance;
            answer += decrease;
            break;
        }
        if (most_rounds > 1) {
            multiply(p_, w_, !manner_.repeats);
            add_diagonal(p_, w_);
            each([&](std::size_t k) { w_[k] -= 1; });
            residual = rms();
        }
        answer = value();
        if (residual <= tolerance) break;
    }
    // The error of 2 1'q - q'Kq is of second order in the residual. Without convergence there is no
    // stiffness.
    constexpr double useless = 0.1;
    if (!(residual <= useless)) answer = std::nan("");
    p_ = p;
    w_ = w;
    given_sum_ = given_sum;
    return answer;
}

template <class Real>
double BoundedSolver<Real>::energy() const {
    return 0.5 * sum_with<double>([&](double& part, std::size_t k) {
               part += p_[k] * (z_[k] - Z0_ + (p_[k] < highest_ ? -w_[k] : w_[k]));
           });
}

template <class Real>
std::vector<std::pair<int, double>> BoundedSolver<Real>::press_out() {
    std::vector<std::pair<int, double>> depths;
    for (std::size_t k = 0; k < p_.size(); ++k) {
        if (!(p_[k] >= highest_ && w_[k] < 0)) continue;
        depths.emplace_back(static_cast<int>(k), -w_[k]);
        z_[k] += w_[k];
        w_[k] = 0;
    }
    return depths;
}

template <class Real>
void BoundedSolver<Real>::settle() {
    each([&](std::size_t k) { z_[k] -= diagonal_ * p_[k]; });
    diagonal_ = 0;
}

template class BoundedSolver<float>;
template class BoundedSolver<double>;

}  // namespace rsc
