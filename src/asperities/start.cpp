#include "asperities/start.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;

}  // namespace

void EarlierLevels::remember(double Z0, const Candidates& candidates, const Vector& v) {
    const auto& rank = candidates.rank;
    Past level{Z0, Vector(rank.empty() ? 0 : rank.back() + 1, kNotComputed)};
    for (const auto k : indices(rank)) level.phi[rank[k]] = candidates.set.g0[k] - v[k];
    past_ = std::move(level);
}

void EarlierLevels::bend(const Candidates& candidates, const Vector& slope) {
    if (!past_ || past_->phi.size() != candidates.rank.back() + 1) return;
    Past& last = *past_;
    last.slope.assign(last.phi.size(), 0.0);
    for (const auto k : indices(slope)) last.slope[candidates.rank[k]] = slope[k];
}

void EarlierLevels::carry(const Candidates& candidates, const Vector& v, std::size_t asperities,
                          Vec2 from, Vec2 to) {
    if (past_) {  // otherwise the tip moved twice without a level in between
        std::swap(last_place_, place_before_);
        for (const int i : last_place_.known) last_place_.phi[at(i)] = kNotComputed;
        last_place_.known.clear();
        if (v.size() == at(candidates.size())) {
            last_place_.separation = past_->separation;
            last_place_.place = from;
            last_place_.phi.resize(asperities, kNotComputed);
            last_place_.known = candidates.set.asperity;
            for (const auto k : indices(v))
                last_place_.phi[at(candidates.set.asperity[k])] = candidates.set.g0[k] - v[k];
        }
        past_.reset();
    }
    constexpr double straight = 0.2, furthest = 2.5;
    const Vec2 move{to.x - last_place_.place.x, to.y - last_place_.place.y};
    const Vec2 last{last_place_.place.x - place_before_.place.x,
                    last_place_.place.y - place_before_.place.y};
    const double square = last.x * last.x + last.y * last.y;
    step_ratio_ = last_place_.known.empty() || place_before_.known.empty()
                      ? 0
                      : (move.x * last.x + move.y * last.y) / square;
    const double aside = std::hypot(move.x - step_ratio_ * last.x, move.y - step_ratio_ * last.y);
    if (!(std::abs(step_ratio_) <= furthest) || aside > straight * std::hypot(move.x, move.y))
        step_ratio_ = 0;
}

bool EarlierLevels::predict(double Z0, const Candidates& candidates, Vector& start) const {
    const auto& rank = candidates.rank;
    const Vector& g0 = candidates.set.g0;
    if (!past_ && !last_place_.known.empty()) {
        start.resize(rank.size());
        bool any = false;
        for (const auto k : indices(rank)) {
            const auto i = at(candidates.set.asperity[k]);
            double phi = last_place_.phi[i];
            if (step_ratio_ != 0 && std::isfinite(place_before_.phi[i]))
                phi += step_ratio_ * (phi - place_before_.phi[i]);
            start[k] = std::isfinite(phi) ? g0[k] - phi : -kInfinity;
            any = any || start[k] > 0;
        }
        return any;
    }
    if (!past_) return false;
    start.resize(rank.size());
    bool any = false;
    for (const auto k : indices(rank)) {
        double phi = rank[k] < past_->phi.size() ? past_->phi[rank[k]] : kNotComputed;
        if (rank[k] < past_->slope.size())
            phi = std::max(phi + (Z0 - past_->separation) * past_->slope[rank[k]], 0.0);
        start[k] = std::isfinite(phi) ? g0[k] - phi : -kInfinity;
        any = any || start[k] > 0;
    }
    return any;
}

Vector cold_start(const Law& law, Products& products, const WorkingSet& candidates) {
    const int n = candidates.size();
    Vector start(at(n)), F(at(n)), D(at(n)), W(at(n)), active_F, phi(at(n));
    Vector x, y;  // positions of points with force
    std::vector<int> active;
    double low = 0, high = candidates.g0.front();
    for (double g : candidates.g0) high = std::max(high, g);
    constexpr int bisections = 6;
    for (int i = 0; i < bisections; ++i) {
        const double s = 0.5 * (low + high);
        for (std::size_t k = 0; k < at(n); ++k) start[k] = candidates.g0[k] - s;
        law.respond(n, candidates.asperity.data(), start.data(), F.data(), D.data(), W.data());
        active.clear();
        for (Vector* list : {&active_F, &x, &y}) list->clear();
        double total = 0, weighted = 0;
        for (const int k : indices(n)) {
            if (!(F[at(k)] > 0)) continue;
            active.push_back(int(active.size()));
            x.push_back(candidates.x[at(k)]);
            y.push_back(candidates.y[at(k)]);
            active_F.push_back(F[at(k)]);
            total += F[at(k)];
        }
        products.set_points(int(active.size()), x.data(), y.data());
        products.set_active(active);
        products.inner(active_F.data(), phi.data());
        for (const auto k : indices(active)) weighted += active_F[k] * phi[k];
        (weighted > s * total ? low : high) = s;
    }
    for (std::size_t k = 0; k < at(n); ++k) start[k] = candidates.g0[k] - low;
    return start;
}

}  // namespace rsc
