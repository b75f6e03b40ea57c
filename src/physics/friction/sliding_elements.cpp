#include "physics/friction/sliding_elements.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

// Conjugate-gradient steps of a round, and the reduction of the preconditioned residual that ends
// it earlier; rounds in all, and before the energy is monitored.
constexpr int kSteps = 6, kRounds = 400, kQuick = 25;
constexpr double kReduction = 0.1;
// Residual below which products that judge a round are in double precision.
constexpr double kClose = 3e-5;
// Relative difference from the limit within which a traction is at its limit.
constexpr double kAtLimit = 1e-12;

double product(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

TractionSolver::Outcome TractionSolver::solve(const std::vector<double>& limit,
                                              const std::vector<double>& b, double scale,
                                              double tolerance, std::vector<double>& q,
                                              std::vector<double>& w) {
    n_ = limit.size();
    limit_ = &limit;
    b_ = &b;
    q_ = q;
    for (auto* v : {&w_, &residual_, &y_, &direction_, &image_}) v->assign(2 * n_, 0.0);
    for (auto* v : {&along_x_, &along_y_, &bend_}) v->assign(n_, 0.0);
    project();
    Outcome outcome;
    bool exact = false;
    std::vector<double> best;
    double least = kInfinity;
    for (; outcome.rounds < kRounds; ++outcome.rounds) {
        evaluate(exact);
        outcome.residual = classify() / scale;
        if (!exact && outcome.residual < std::max(kClose, tolerance)) {
            exact = true;
            evaluate(exact);
            outcome.residual = classify() / scale;
        }
        if (!std::isfinite(outcome.residual)) break;
        outcome.converged = exact && outcome.residual <= tolerance;
        if (outcome.converged) break;
        if (outcome.rounds > kQuick) {
            const double now = energy();
            if (now < least) {
                least = now;
                best = q_;
            } else {
                q_ = best;
                evaluate(exact);
                (void)classify();
                step_along_gradient();
                least = kInfinity;
                continue;
            }
        }
        descend(kSteps, kReduction);
        project();
    }
    q = q_;
    w = w_;
    return outcome;
}

void TractionSolver::evaluate(bool exact) {
    stopping_point();
    products_.apply(q_.data(), w_.data(), exact);
    for (const auto k : indices(2 * n_)) w_[k] = (*b_)[k] - w_[k];
}

// Scales tractions beyond their limits down to these.
void TractionSolver::project() {
    for (const auto k : indices(n_)) {
        const double size = std::hypot(q_[k], q_[n_ + k]), limit = (*limit_)[k];
        if (!(size > limit)) continue;
        q_[k] *= limit / size;
        q_[n_ + k] *= limit / size;
    }
}

double TractionSolver::energy() const {
    double sum = 0;
    for (const auto k : indices(2 * n_)) sum -= 0.5 * q_[k] * ((*b_)[k] + w_[k]);
    return sum;
}

// Determines which pixels slip and their residuals. Returns the rms of these.
double TractionSolver::classify() {
    double square = 0;
    for (const auto k : indices(n_)) {
        const double limit = (*limit_)[k], x = q_[k], y = q_[n_ + k], size = std::hypot(x, y);
        const double slip = size > 0 ? (w_[k] * x + w_[n_ + k] * y) / size : 0.0;
        const bool slips = size >= (1 - kAtLimit) * limit && slip >= 0;
        along_x_[k] = slips && size > 0 ? x / size : 0.0;
        along_y_[k] = slips && size > 0 ? y / size : 0.0;
        bend_[k] = slips && limit > 0 ? slip / limit : 0.0;
        if (limit == 0) {
            residual_[k] = residual_[n_ + k] = 0;
            continue;
        }
        residual_[k] = w_[k] - slip * along_x_[k];
        residual_[n_ + k] = w_[n_ + k] - slip * along_y_[k];
        square += residual_[k] * residual_[k] + residual_[n_ + k] * residual_[n_ + k];
    }
    return n_ > 0 ? std::sqrt(square / double(n_)) : 0.0;
}

void TractionSolver::restrict_to_free(std::vector<double>& v) const {
    for (const auto k : indices(n_)) {
        const double along = v[k] * along_x_[k] + v[n_ + k] * along_y_[k];
        v[k] -= along * along_x_[k];
        v[n_ + k] -= along * along_y_[k];
        if ((*limit_)[k] == 0) v[k] = v[n_ + k] = 0;
    }
}

// Conjugate gradients from the residual of classify().
void TractionSolver::descend(int most_steps, double reduction) {
    from_.resize(2 * n_);
    std::vector<double> share(n_);  // of slipping pixels, by which they turn
    for (const auto k : indices(n_)) share[k] = 1 / std::sqrt(1 + bend_[k] / products_.local());
    double last = 0, first = 0;
    for (const int step : indices(most_steps)) {
        for (const auto k : indices(n_)) {
            from_[k] = float(share[k] * residual_[k] / products_.local());
            from_[n_ + k] = float(share[k] * residual_[n_ + k] / products_.local());
        }
        products_.precondition(from_, to_);
        for (const auto k : indices(n_)) {
            y_[k] = share[k] * double(to_[k]);
            y_[n_ + k] = share[k] * double(to_[n_ + k]);
        }
        restrict_to_free(y_);
        const double ry = product(residual_, y_);
        if (step == 0) first = ry;
        if (!(ry > reduction * reduction * first)) break;
        const double beta = step > 0 ? ry / last : 0.0;
        last = ry;
        for (const auto k : indices(2 * n_))
            direction_[k] = y_[k] + (step > 0 ? beta * direction_[k] : 0.0);
        stopping_point();
        products_.apply(direction_.data(), image_.data(), false);
        restrict_to_free(image_);
        for (const auto k : indices(n_)) {
            image_[k] += bend_[k] * direction_[k];
            image_[n_ + k] += bend_[k] * direction_[n_ + k];
        }
        const double curvature = product(direction_, image_);
        if (!(curvature > 0)) break;
        const double alpha = ry / curvature;
        for (const auto k : indices(2 * n_)) {
            q_[k] += alpha * direction_[k];
            residual_[k] -= alpha * image_[k];
        }
    }
}

// A step that decreases the energy whatever the pixels do.
void TractionSolver::step_along_gradient() {
    for (const auto k : indices(2 * n_)) q_[k] += w_[k] / products_.largest();
    project();
}

SlidingElements::SlidingElements(const Indenter& indenter, const Friction& friction,
                                 const PointGrid& map, double tolerance)
    : friction_(friction),
      map_(map),
      tolerance_(tolerance),
      area_(map.dx * map.dy),
      products_(substrate_of(indenter), 2 / friction.ratio - 2, indenter.period, map),
      solver_(products_) {
    require_friction(friction);
    if (!(friction.ratio < 2)) bad_input("the ratio m of the stiffnesses must be below 2");
}

namespace {

// Values of some pixels at others; 0 where they are not among them. Both sorted.
std::vector<double> carried(const std::vector<std::int32_t>& from,
                            const std::vector<double>& values,
                            const std::vector<std::int32_t>& to) {
    std::vector<double> result(2 * to.size(), 0.0);
    std::size_t k = 0;
    for (const auto i : indices(to)) {
        while (k < from.size() && from[k] < to[i]) ++k;
        if (k == from.size() || from[k] != to[i]) continue;
        result[i] = values[k];
        result[to.size() + i] = values[from.size() + k];
    }
    return result;
}

}  // namespace

void SlidingElements::move_tip(const Indenter& indenter) {
    const auto cut = [](double tip, double first, double step, int n, double period) {
        if (!std::isfinite(period)) return 0;
        return wrapped(int(std::lround(std::remainder(tip - first, period) / step)) + n / 2, n);
    };
    cut_ = {cut(indenter.x0, map_.x0, map_.dx, map_.nx, indenter.around.x),
            cut(indenter.y0, map_.y0, map_.dy, map_.ny, indenter.around.y)};
    set_.clear();
}

std::vector<Pixel> SlidingElements::on_plane(const std::vector<std::int32_t>& pixels) const {
    std::vector<Pixel> all;
    for (const std::int32_t k : pixels)
        all.push_back(
            {wrapped(k % map_.nx - cut_.x, map_.nx), wrapped(k / map_.nx - cut_.y, map_.ny)});
    return all;
}

bool SlidingElements::sticks(std::size_t k) const {
    return std::hypot(now_.q[k], now_.q[now_.pixels.size() + k]) < (1 - 1e-9) * now_.limit[k];
}

// The pixels under pressure, their limits, and T q of the state at them.
void SlidingElements::set_contact(const LevelPixels& pixels) {
    const std::vector<std::int32_t>& contact = pixels.index;
    if (contact != now_.pixels) {
        std::vector<std::int32_t> all;
        std::ranges::set_union(contact, now_.pixels, std::back_inserter(all));
        const auto q = carried(now_.pixels, now_.q, all);
        std::vector<double> u(q.size());
        products_.set_pixels(on_plane(all));
        products_.apply(q.data(), u.data(), true);
        now_.u = carried(all, u, contact);
        now_.q = carried(now_.pixels, now_.q, contact);
        now_.slip = carried(now_.pixels, now_.slip, contact);
        now_.pixels = contact;
        set_.clear();
    }
    now_.limit.resize(contact.size());
    for (const auto k : indices(contact))
        now_.limit[k] = friction_.coefficient * pixels.pressure[k];
    if (set_ != contact) products_.set_pixels(on_plane(contact));
    set_ = contact;
}

bool SlidingElements::slide(const LevelPixels& pixels, Slide by) {
    set_contact(pixels);
    step_lost_ = 0;
    const std::size_t n = now_.pixels.size();
    std::vector<double> b = now_.u, w;
    double weight = 0, size = 0;
    for (const auto k : indices(n)) {
        b[k] += by.x;
        b[n + k] += by.y;
        weight += now_.limit[k];
        size += now_.limit[k] * (std::hypot(b[k], b[n + k]) + std::hypot(now_.u[k], now_.u[n + k]));
    }
    if (!(size > 0)) return true;
    const auto outcome = solver_.solve(now_.limit, b, size / weight, tolerance_, now_.q, w);
    for (const auto k : indices(2 * n)) now_.u[k] = b[k] - w[k];
    for (const auto k : indices(n)) {
        if (sticks(k)) continue;
        step_lost_ += area_ * std::max(now_.q[k] * w[k] + now_.q[n + k] * w[n + k], 0.0);
        now_.slip[k] += w[k];
        now_.slip[n + k] += w[n + k];
    }
    now_.lost += step_lost_;
    return outcome.converged;
}

Slide SlidingElements::force() const {
    const auto half = std::ptrdiff_t(now_.pixels.size());
    return {area_ * std::accumulate(now_.q.begin(), now_.q.begin() + half, 0.0),
            area_ * std::accumulate(now_.q.begin() + half, now_.q.end(), 0.0)};
}

double SlidingElements::energy() const { return 0.5 * area_ * product(now_.q, now_.u); }

double SlidingElements::sticking_area() const {
    double pixels = 0;
    for (const auto k : indices(now_.pixels)) pixels += sticks(k);
    return area_ * pixels;
}

std::array<double, 3> SlidingElements::stiffness(bool slipping_ones_too) {
    const std::size_t n = now_.pixels.size();
    if (set_ != now_.pixels) products_.set_pixels(on_plane(now_.pixels));
    set_ = now_.pixels;
    std::vector<double> free(n), bx(2 * n, 0.0), by(2 * n, 0.0), x(2 * n, 0.0), y(2 * n, 0.0);
    for (const auto k : indices(n)) {
        free[k] = slipping_ones_too || sticks(k) ? kInfinity : 0.0;
        bx[k] = by[n + k] = free[k] > 0;
    }
    // Errors of the sums below are of second order in the residual.
    constexpr double tolerance = 1e-4;
    std::vector<double> wx(2 * n), wy(2 * n);
    (void)solver_.solve(free, bx, 1, tolerance, x, wx);
    (void)solver_.solve(free, by, 1, tolerance, y, wy);
    return {area_ * (product(x, bx) + product(x, wx)), area_ * (product(x, by) + product(y, wx)),
            area_ * (product(y, by) + product(y, wy))};
}

double SlidingElements::full_slip(Slide direction) {
    const std::size_t n = now_.pixels.size();
    const double size = std::hypot(direction.x, direction.y);
    if (n == 0 || !(size > 0)) return 0;
    if (set_ != now_.pixels) products_.set_pixels(on_plane(now_.pixels));
    set_ = now_.pixels;
    std::vector<double> q(2 * n), u(2 * n);
    for (const auto k : indices(n)) {
        q[k] = now_.limit[k] * direction.x / size;
        q[n + k] = now_.limit[k] * direction.y / size;
    }
    products_.apply(q.data(), u.data(), true);
    double largest = 0;
    for (const auto k : indices(n))
        largest = std::max(largest, (u[k] * direction.x + u[n + k] * direction.y) / size);
    return largest;
}

}  // namespace rsc
