#include "physics/adhesion/adhesive_edges.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

constexpr int kAround = 3;   // pixels selected around those with a share
constexpr int kMost = 1000;  // rounds of a level
// Factors of the change of shares in a round, and of the change in the round before.
constexpr double kRelaxed = 2, kMomentum = 0.5;
constexpr double kLeast = 0.3;  // of a share that remains after a round
// Error of gaps of touching pixels relative to u0 and to the change of the shares.
constexpr double kEarly = 0.3, kFinal = 0.1;
// The same change for the first round, before which pressures are those of another separation.
constexpr double kFirst = 0.01;
// Residual relative to that of the last product in full accuracy, at which another one is due.
constexpr double kDrift = 0.03;
constexpr int kMostSteps = 60;         // of conjugate gradients in a round
constexpr double kPenetration = 1e-3;  // relative to u0: of points apart from other contacts
constexpr int kMostForStiffness = 500;

double product(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

AdhesiveEdges::AdhesiveEdges(PixelProducts& products, const CutMap& map, bool wraps, double s0,
                             double u0)
    : products_(products),
      map_(map),
      wraps_(wraps),
      s0_(s0),
      u0_(u0),
      inverse_(products.inverse(0)),
      plane_(map.frame.nx + (wraps ? 0 : inverse_.reach()),
             map.frame.ny + (wraps ? 0 : inverse_.reach())),
      where_(map.frame.points(), -1) {}

void AdhesiveEdges::select(const std::vector<double>& p, const std::vector<double>& share,
                           bool more) {
    const int nx = map_.frame.nx, ny = map_.frame.ny;
    std::vector<char> in(share.size(), 0);
    if (more)
        for (const Pixel& pixel : pixels_) in[at(map_.place(pixel))] = 1;
    const auto inside = [&](Pixel& q) {
        if (wraps_) q = {(q.x + nx) % nx, (q.y + ny) % ny};
        return q.x >= 0 && q.x < nx && q.y >= 0 && q.y < ny;
    };
    for (const auto i : indices(share)) {
        if (!(share[i] > 0)) continue;
        const Pixel here = map_.pixel_at(std::int32_t(i));
        for (int b = -kAround; b <= kAround; ++b)
            for (int a = -kAround; a <= kAround; ++a)
                if (Pixel q{here.x + a, here.y + b}; inside(q)) in[at(map_.place(q))] = 1;
    }
    std::ranges::fill(where_, -1);
    pixels_.clear();
    column_.clear();
    rows_.assign(1, 0);
    for (const int j : indices(ny)) {
        for (const int i : indices(nx)) {
            const std::size_t place = at(map_.place({i, j}));
            if (!in[place]) continue;
            where_[place] = std::int32_t(pixels_.size());
            pixels_.push_back({i, j});
            column_.push_back(i);
        }
        rows_.push_back(pixels_.size());
    }
    if (!wraps_) rows_.resize(at(ny + inverse_.reach()) + 1, pixels_.size());
    around_.resize(pixels_.size());
    for (std::vector<double>* values : {&p_, &u_, &share_, &before_, &overlap_, &loaded_})
        values->assign(pixels_.size(), 0.0);
    for (const auto k : indices(pixels_)) {
        const std::size_t place = at(map_.place(pixels_[k]));
        share_[k] = before_[k] = share[place];
        p_[k] = touches(k) ? p[place] : -s0_ * share_[k];
        std::size_t n = 0;
        for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a) {
                if (a == 0 && b == 0) continue;
                Pixel q{pixels_[k].x + a, pixels_[k].y + b};
                std::int32_t index = -1;
                if (inside(q)) index = where_[at(map_.place(q))];
                around_[k][n++] = inside(q) && index < 0 ? -2 : index;
            }
    }
    if (!pixels_.empty()) products_.set_pixels(pixels_);
}

// y = approximately K^-1 r between touching pixels. False: r is 0 there.
bool AdhesiveEdges::precondition(const std::vector<double>& r, std::vector<double>& y) {
    double unit = 0;  // for single precision
    for (const auto k : indices(r))
        if (touches(k)) unit = std::max(unit, std::abs(r[k]));
    y.assign(r.size(), 0.0);
    if (!(unit > 0)) return false;
    from_.resize(r.size());
    to_.resize(r.size());
    for (const auto k : indices(r)) from_[k] = touches(k) ? float(r[k] / unit) : 0.0f;
    plane_.convolve(inverse_, {rows_, column_}, from_.data(), to_.data(),
                    r.size() >= 16384 ? 0 : 1);
    for (const auto k : indices(r))
        if (touches(k)) y[k] = unit * double(to_[k]);
    return true;
}

// Conjugate gradients for u = 0 at touching pixels, until done(number of steps).
template <class Done>
void AdhesiveEdges::descend(Done&& done) {
    std::vector<double> r(p_.size()), y, q, Kq(p_.size());
    const auto residual = [&] {
        for (const auto k : indices(r)) r[k] = touches(k) ? -u_[k] : 0.0;
    };
    residual();
    double last = 0;
    for (int step = 0; !done(step); ++step) {
        if (!precondition(r, y)) return;
        const double now = product(r, y);
        if (!(now > 0)) return;
        if (step == 0) q = y;
        for (std::size_t k = 0; k < q.size() && step > 0; ++k) q[k] = y[k] + now / last * q[k];
        last = now;
        products_.apply(q.data(), Kq.data(), PixelProducts::Accuracy::inner);
        const double curvature = product(q, Kq);
        if (!(curvature > 0)) return;  // two flats in full contact
        const double length = now / curvature;
        for (const auto k : indices(q)) {
            p_[k] += length * q[k];
            u_[k] += length * Kq[k];
        }
        residual();
    }
}

// The gaps under the pressures: anew, or from the change of the shares.
void AdhesiveEdges::load(bool exact) {
    std::vector<double> change(p_.size()), K(p_.size());
    double most = 0;
    for (const auto k : indices(p_)) {
        if (!touches(k)) {
            change[k] = -s0_ * share_[k] - p_[k];
            p_[k] += change[k];
        }
        most = std::max(most, std::abs(change[k]));
    }
    if (exact) {
        products_.apply(p_.data(), u_.data(), PixelProducts::Accuracy::full);
        for (const auto k : indices(u_)) u_[k] -= overlap_[k];
    } else if (most > 0) {
        products_.apply(change.data(), K.data(), PixelProducts::Accuracy::inner);
        for (const auto k : indices(u_)) u_[k] += K[k];
    }
}

// By which the share of a pixel differs from that of its gap, or of a touching one from that which
// its tension leaves.
double AdhesiveEdges::change(std::size_t k) const {
    if (touches(k)) return std::min(1 + p_[k] / s0_, 0.0);
    const double target = 1 - u_[k] / u0_;
    if (share_[k] == 0) {
        if (target <= 0) return 0;
        const auto attracts = [&](std::int32_t l) { return l >= 0 && share_[at(l)] > 0; };
        if (std::ranges::none_of(around_[k], attracts))
            return u_[k] < -kPenetration * u0_ ? 1.0 : 0.0;
    }
    return std::max(target, 0.0) - share_[k];
}

// Moves the shares. Returns whether more pixels must be selected.
bool AdhesiveEdges::advance(double tolerance) {
    const std::vector<double> now = share_;
    std::vector<double> next = share_;
    bool wider = false;
    for (const auto k : indices(now)) {
        const double by = change(k);
        const bool between = now[k] > 0 && now[k] < 1;
        const double step = kRelaxed * by + (between ? kMomentum * (now[k] - before_[k]) : 0.0);
        next[k] = std::clamp(now[k] + std::clamp(step, -1.0, 1.0), 0.0, 1.0);
        // A pixel that would be let go by a step that is too long could not come back alone.
        if (now[k] + by > 0) next[k] = std::max(next[k], kLeast * now[k]);
        if (next[k] < kFinal * tolerance) next[k] = 0;
        if (next[k] > 0) wider = wider || std::ranges::count(around_[k], -2) > 0;
    }
    before_ = now;
    share_ = std::move(next);
    return wider;
}

AdhesiveEdges::Outcome AdhesiveEdges::balance(const std::vector<double>& clearance, double Z,
                                              double tolerance) {
    Outcome outcome;
    for (const auto k : indices(pixels_)) overlap_[k] = clearance[at(map_.place(pixels_[k]))] - Z;
    double worst = kFirst, at_exact = 0;
    bool exact = true;
    for (; outcome.rounds < kMost; ++outcome.rounds) {
        stopping_point();
        if (std::ranges::all_of(share_, [](double s) { return s == 0; })) {
            std::ranges::fill(p_, 0.0);
            for (const auto k : indices(u_)) u_[k] = -overlap_[k];
            outcome.converged = true;
            return outcome;
        }
        load(exact);
        const double most = std::max(kFinal * tolerance, kEarly * std::min(worst, 1.0)) * u0_;
        const auto open = [&] {
            double gap = 0;
            for (const auto k : indices(u_))
                if (touches(k)) gap = std::max(gap, std::abs(u_[k]));
            return gap;
        };
        const bool sound = exact && open() <= tolerance * u0_;
        if (!sound) descend([&](int step) { return open() <= most || step >= kMostSteps; });
        worst = 0;
        for (const auto k : indices(share_)) worst = std::max(worst, std::abs(change(k)));
        outcome.residual = std::max(worst, open() / u0_);
        if (outcome.residual <= tolerance && sound) {
            outcome.converged = true;
            return outcome;
        }
        if (exact) at_exact = outcome.residual;
        exact = outcome.residual <= std::max(tolerance, kDrift * at_exact);
        if (exact) continue;
        if (advance(tolerance)) {
            outcome.wider = true;
            return outcome;
        }
    }
    return outcome;
}

double AdhesiveEdges::stiffness(double error) {
    const std::vector<double> p = p_, u = u_;
    std::ranges::fill(p_, 0.0);
    std::ranges::fill(u_, -1.0);
    descend([&](int step) {
        double most = 0;
        for (const auto k : indices(u_))
            if (touches(k)) most = std::max(most, std::abs(u_[k]));
        return most <= error || step >= kMostForStiffness;
    });
    const double sum = std::accumulate(p_.begin(), p_.end(), 0.0);
    p_ = p;
    u_ = u;
    return sum;
}

}  // namespace rsc
