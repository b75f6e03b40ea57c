#include "asperities/start.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void EarlierLevels::remember(double Z0, const Candidates& candidates, const Vector& v, bool unique,
                             bool passed) {
    unique_ = unique;
    ++solved_;
    if (!past_.empty() && past_.front().passed) past_.pop_front();
    const auto& rank = candidates.rank;
    Past level{Z0, Vector(rank.empty() ? 0 : rank.back() + 1, kUnknown), passed};
    for (std::size_t k = 0; k < rank.size(); ++k) level.phi[rank[k]] = candidates.set.g0[k] - v[k];
    past_.push_front(std::move(level));
    if (past_.size() > 4) past_.pop_back();
}

void EarlierLevels::bend(const Candidates& candidates, const Vector& slope) {
    if (past_.empty() || past_.front().phi.size() != candidates.rank.back() + 1) return;
    Past& last = past_.front();
    last.slope.assign(last.phi.size(), 0.0);
    for (std::size_t k = 0; k < slope.size(); ++k) last.slope[candidates.rank[k]] = slope[k];
}

void EarlierLevels::carry(const Candidates& candidates, const Vector& v, std::size_t asperities,
                          Vec2 from, Vec2 to) {
    if (!past_
             // otherwise moved twice without a level between; the carried state is kept
             .empty()) {
        std::swap(carried_, before_);
        for (const int i : carried_.known) carried_.phi[at(i)] = kUnknown;
        carried_.known.clear();
        if (v.size() == at(candidates.size())) {
            carried_.separation = past_.front().separation;
            carried_.place = from;
            carried_.phi.resize(asperities, kUnknown);
            carried_.known = candidates.set.asperity;
            for (std::size_t k = 0; k < v.size(); ++k)
                carried_.phi[at(candidates.set.asperity[k])] = candidates.set.g0[k] - v[k];
        }
        past_.clear();
        solved_ = 0;
    }
    constexpr double straight = 0.2, furthest = 2.5;
    const Vec2 move{to.x - carried_.place.x, to.y - carried_.place.y};
    const Vec2 last{carried_.place.x - before_.place.x, carried_.place.y - before_.place.y};
    const double square = last.x * last.x + last.y * last.y;
    ahead_ = carried_.known.empty() || before_.known.empty()
                 ? 0
                 : (move.x * last.x + move.y * last.y) / square;
    const double aside = std::hypot(move.x - ahead_ * last.x, move.y - ahead_ * last.y);
    if (!(std::abs(ahead_) <= furthest) || aside > straight * std::hypot(move.x, move.y))
        ahead_ = 0;
}

bool EarlierLevels::predict(double Z0, const Candidates& candidates, Vector& start) const {
    const auto& rank = candidates.rank;
    const Vector& g0 = candidates.set.g0;
    if (past_.empty() && !carried_.known.empty()) {
        start.resize(rank.size());
        bool any = false;
        for (std::size_t k = 0; k < rank.size(); ++k) {
            const auto i = at(candidates.set.asperity[k]);
            double phi = carried_.phi[i];
            if (ahead_ != 0 && std::isfinite(before_.phi[i]))
                phi += ahead_ * (phi - before_.phi[i]);
            start[k] = std::isfinite(phi) ? g0[k] - phi : -kInfinity;
            any = any || start[k] > 0;
        }
        return any;
    }
    if (past_.empty()) return false;
    std::size_t used = 1;
    while (used < past_.size() && used < 4) {
        const double gap = std::abs(past_[used - 1].separation - past_[used].separation);
        if (!(gap > 0) || std::abs(Z0 - past_[0].separation) > 2.5 * gap) break;
        ++used;
    }
    double weight[4];
    for (std::size_t a = 0; a < used; ++a) {
        weight[a] = 1;
        for (std::size_t b = 0; b < used; ++b) {
            if (b != a)
                weight[a] *=
                    (Z0 - past_[b].separation) / (past_[a].separation - past_[b].separation);
        }
    }
    start.resize(rank.size());
    bool any = false;
    for (std::size_t k = 0; k < rank.size(); ++k) {
        double phi = 0;
        bool known = true;
        for (std::size_t a = 0; a < used && known; ++a) {
            known = rank[k] < past_[a].phi.size();
            if (known) phi += weight[a] * past_[a].phi[rank[k]];
        }
        if (!known && rank[k] < past_[0].phi.size()) {
            phi = past_[0].phi[rank[k]];
            known = true;
        }
        if (used == 1 && known && !past_[0].slope.empty())
            phi = std::max(phi + (Z0 - past_[0].separation) * past_[0].slope[rank[k]], 0.0);
        start[k] = known && std::isfinite(phi) ? g0[k] - phi : -kInfinity;
        any = any || start[k] > 0;
    }
    return any;
}

std::optional<double> EarlierLevels::likely_separation(double first_touch) const {
    if (!past_.empty()) return past_.front().separation;
    if (carried_.known.empty() || !(carried_.separation < first_touch)) return std::nullopt;
    const double next = carried_.separation + ahead_ * (carried_.separation - before_.separation);
    return next < first_touch ? next : carried_.separation;
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
        for (int k = 0; k < n; ++k) {
            if (!(F[at(k)] > 0)) continue;
            active.push_back(static_cast<int>(active.size()));
            x.push_back(candidates.x[at(k)]);
            y.push_back(candidates.y[at(k)]);
            active_F.push_back(F[at(k)]);
            total += F[at(k)];
        }
        products.set_points(static_cast<int>(active.size()), x.data(), y.data());
        products.set_active(active);
        products.inner(active_F.data(), phi.data());
        for (std::size_t k = 0; k < active.size(); ++k) weighted += active_F[k] * phi[k];
        (weighted > s * total ? low : high) = s;
    }
    for (std::size_t k = 0; k < at(n); ++k) start[k] = candidates.g0[k] - low;
    return start;
}

}  // namespace rsc
