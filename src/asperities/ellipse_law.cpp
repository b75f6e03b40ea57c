#include "asperities/ellipse_law.hpp"

#include "asperities/most_loaded.hpp"
#include "base/parallel.hpp"
#include "surface/detection.hpp"

namespace rsc {
namespace {

// Convex force with given values and slopes at nodes, the first of which is the origin. Between two
// of them the slope is S_k + (S_k+1 - S_k) x^q, 0 < x < 1, with the q that gives the right
// difference of forces: 1/2 for a paraboloid in the first interval. It is not negative if the slope
// of the chord lies between those at the nodes.
class Table {
public:
    Table() = default;
    // `all`: also those with which it is not convex.
    explicit Table(std::vector<LoadedEllipse> ellipses, bool all) : node_(std::move(ellipses)) {
        node_.insert(node_.begin(), LoadedEllipse{});
        std::sort(node_.begin() + 1, node_.end(),
                  [](const LoadedEllipse& a, const LoadedEllipse& b) { return a.u < b.u; });
        if (!all) keep_convex();
        work_.assign(node_.size(), 0.0);
        for (std::size_t k = 1; k < node_.size(); ++k) work_[k] = within(k, 1).work;
    }

    bool empty() const { return node_.size() < 2; }
    double last() const { return node_.back().u; }
    const std::vector<LoadedEllipse>& nodes() const { return node_; }

    Response at(double u) const {
        if (!(u > 0)) return {};
        const std::size_t k = above(u);
        if (k < node_.size())
            return within(k, (u - node_[k - 1].u) / (node_[k].u - node_[k - 1].u));
        // beyond the table stiffness ~ u^q: between a flat punch, 0, and a paraboloid, 1/2
        constexpr double q = 0.25;
        const LoadedEllipse& e = node_.back();
        const double x = u / e.u, power = std::pow(x, q), grown = e.stiffness * e.u / (q + 1),
                     rest = e.force - grown;
        return {rest + grown * x * power, e.stiffness * power,
                work_.back() + rest * (u - e.u) + grown * e.u / (q + 2) * (x * x * power - 1)};
    }

    Spot spot(double u) const {
        const std::size_t k = std::min(above(u), node_.size() - 1);
        const LoadedEllipse &low = node_[k == 1 ? 1 : k - 1], &high = node_[k];
        Spot e = high.spot;
        if (k == 1 ||
            // like the spot of a paraboloid, also beyond the table, where the area would else
            // remain constant
            u > high.u) {
            const double root = std::sqrt(std::max(u / high.u, 0.0));
            e.major *= root, e.minor *= root;
            return e;
        }
        // the size of the spot follows the stiffness
        const double rise = high.stiffness - low.stiffness;
        const double w =
            rise > 0 ? std::clamp((at(u).slope - low.stiffness) / rise, 0.0, 1.0) : 1.0;
        // The ellipses are mixed by their matrices, which do not depend on how the angle is
        // counted.
        const auto mixed = [&](auto part) {
            return (1 - w) * part(low.spot) + w * part(high.spot);
        };
        const double t = mixed([](const Spot&v) { return 0.5 * (v.major + v.minor); }),
                     x = mixed([](const Spot&v) {
                         return 0.5 * (v.major - v.minor) * std::cos(2 * v.angle);
                     }),
                     y = mixed([](const Spot&v) {
                         return 0.5 * (v.major - v.minor) * std::sin(2 * v.angle);
                     });
        e.x = mixed([](const Spot& v) { return v.x; }),
        e.y = mixed([](const Spot& v) { return v.y; });
        e.major = t + std::hypot(x, y), e.minor = t - std::hypot(x, y),
        e.angle = 0.5 * std::atan2(y, x);
        return e;
    }

private:
    // The first node beyond u; the number of nodes if there is none.
    std::size_t above(double u) const {
        return static_cast<std::size_t>(
            std::upper_bound(node_.begin(), node_.end(), u,
                             [](double v, const LoadedEllipse& e) { return v < e.u; }) -
            node_.begin());
    }

    Response within(std::size_t k, double x) const {
        const LoadedEllipse &low = node_[k - 1], &high = node_[k];
        const double length = high.u - low.u, rise = high.stiffness - low.stiffness,
                     mean = (high.force - low.force) / length - low.stiffness;
        const double q = rise > 0 && mean > 0 ? std::clamp(rise / mean - 1, 1e-3, 1e3) : 1.0,
                     power = rise * std::pow(x, q);
        Response r;
        r.slope = low.stiffness + power;
        r.force = low.force + length * x * (low.stiffness + power / (q + 1));
        r.work = work_[k - 1] +
                 length * x *
                     (low.force + length * x * (0.5 * low.stiffness + power / ((q + 1) * (q + 2))));
        return r;
    }

    // Leaves out nodes below the tangent of another one: a local maximum of the load that is not
    // the largest. Of two that are below each other's, where the share of the summit in a wide
    // ellipse stiffens less than its own one did, the deeper one; no law is convex that has the
    // origin below a tangent.
    void keep_convex() {
        constexpr double rounding = 1e-9;
        const auto below = [](const LoadedEllipse& a, const LoadedEllipse& b) {
            return b.force + b.stiffness * (a.u - b.u) > (1 + rounding) * a.force;
        };
        std::vector<LoadedEllipse> kept;
        for (const LoadedEllipse& e : node_) {
            if (below(node_[0], e)) continue;
            while (!kept.empty() && below(kept.back(), e) && !below(e, kept.back()))
                kept.pop_back();
            if (kept.empty() || !below(e, kept.back())) kept.push_back(e);
        }
        node_ = std::move(kept);
    }

    std::vector<LoadedEllipse> node_;
    std::vector<double> work_;
};

class EllipseLaw final : public Law {
public:
    EllipseLaw(std::unique_ptr<Law> other, const FoundSummits& found, const Indenter& indenter,
               double spacing, const EllipseLaw* like)
        : other_(std::move(other)),
          found_(found),
          asperities_(found.summits),
          indenter_(indenter),
          spacing_(spacing),
          like_(like),
          stencil_(found.points_per_wave > 0 ? Stencil::band_limited(found.points_per_wave)
                                             : Stencil::polynomial(kMeasuredReach / 2)),
          state_(asperities_.size()),
          own_(asperities_.size()),
          table_(asperities_.size()),
          widest_(asperities_.size()),
          clearance_(asperities_.size()) {
        for (std::size_t i = 0; i < clearance_.size(); ++i)
            clearance_[i] =
                indenter_.clearance(asperities_.x[i], asperities_.y[i], asperities_.z[i]);
        by_x_.resize(clearance_.size());
        std::iota(by_x_.begin(), by_x_.end(), 0);
        std::sort(by_x_.begin(), by_x_.end(), [&](int a, int b) {
            return std::tie(asperities_.x[at(a)], a) < std::tie(asperities_.x[at(b)], b);
        });
    }

    void prepare(std::span<const int> asperities) override {
        other_->prepare(asperities);
        // The ellipses of these, of the lower summits in them, and so on.
        std::vector<int> next(asperities.begin(), asperities.end()), fresh, added;
        while (!next.empty()) {
            fresh.clear();
            for (int i : next)
                if (state_[at(i)] == State::unknown)
                    state_[at(i)] = State::alone, fresh.push_back(i);
            next.clear();
            parallel_for(fresh.size(), 4, found_.threads, [&](std::size_t k) {
                own_[at(fresh[k])] = alone(fresh[k]),
                table_[at(fresh[k])] = Table(nodes(fresh[k]), like_);
            });
            for (int i : fresh) {
                if (like_) state_[at(i)] = like_->state_[at(i)];
                widest_[at(i)] = table_[at(i)].nodes().back();
                for (const LoadedEllipse& e : table_[at(i)].nodes())
                    for (int j : members(i, e, true)) next.push_back(j);
                if (table_[at(i)].empty() && !like_)
                    near(i, 2 * spacing_, [&](int j) {
                        if (lower(i, j)) next.push_back(j);
                    });
            }
            added.insert(added.end(), fresh.begin(), fresh.end());
        }
        std::sort(added.begin(), added.end(), [&](int a, int b) { return lower(a, b); });
        for (int i : added)
            if (table_[at(i)].empty() && !like_)
                near(i, 2 * spacing_, [&](int j) {
                    const Vec2 d = between(j, i);
                    if (lower(i, j) && widest_[at(j)].spot.contains(d.x, d.y))
                        state_[at(i)] = State::covered;
                });
        for (int i : added) share(i);
    }

    void respond(int n, const int* asperity, const double* u, double* force, double* slope,
                 double* work) const override {
        for (int k = 0; k < n; ++k) {
            const Table& table = table_[at(asperity[k])];
            Response r;
            if (state_[at(asperity[k])] != State::covered)
                r = table.empty() ? other_->response(asperity[k], u[k]) : table.at(u[k]);
            force[k] = r.force, slope[k] = r.slope, work[k] = r.work;
        }
    }

    double area(int asperity, double u) const override {
        const Table& table = table_[at(asperity)];
        if (state_[at(asperity)] == State::covered) return 0;
        if (table.empty()) return other_->area(asperity, u);
        if (!(u > 0)) return 0;
        const Spot spot = table.spot(u);
        return std::numbers::pi * spot.major * spot.minor;
    }

    double axes(int asperity) const override { return other_->axes(asperity); }
    bool beyond(int asperity, double u) const override {
        const Table& table = table_[at(asperity)];
        return table.empty() ? other_->beyond(asperity, u) : u > table.last();
    }

    std::optional<Spot> spot(int asperity, double u) const override {
        const Table& table = table_[at(asperity)];
        if (table.empty() || !(u > 0)) return std::nullopt;
        return table.spot(u);
    }

private:
    enum class State : char {
        unknown,
        alone,
        covered
    };  // covered: no spot of its own, but inside that of a higher summit

    bool lower(int a, int b) const {
        return std::tie(clearance_[at(a)], b) < std::tie(clearance_[at(b)], a);
    }

    // Ratio of the curvatures of a summit to those under the tip close by, and so of the
    // penetrations in its table.
    double steeper(int i) const {
        const Asperities& a = like_->asperities_;
        return std::sqrt(asperities_.kappa1[at(i)] * asperities_.kappa2[at(i)] /
                         (a.kappa1[at(i)] * a.kappa2[at(i)]));
    }

    std::vector<LoadedEllipse> alone(int i) const {
        constexpr double
            window = 2,
            // half width over the widest ellipse, whose centre may be off the summit; points in it
            fine = 45;
        const std::size_t k = at(i);
        // Odd, because midway between two points the stencil of one of them would be used: not the
        // same on a mirror image of the map.
        const int steps =
            std::clamp(static_cast<int>(
                           std::ceil(fine * std::max(found_.map->dx, found_.map->dy) / spacing_)),
                       1, 7) |
            1;
        const HeightsAround heights(found_, stencil_, indenter_, asperities_.x[k], asperities_.y[k],
                                    window * spacing_, steps);
        if (like_) return ellipses_like(heights, indenter_.E_star, steeper(i), like_->own_[k]);
        const double k1 = asperities_.kappa1[k], k2 = asperities_.kappa2[k];
        auto ellipses = most_loaded_ellipses(heights, indenter_.E_star, std::sqrt(k1 * k2), k1 / k2,
                                             asperities_.angle[k], spacing_);
        // A spot that contains a higher summit is that of the higher one.
        const auto end =
            std::find_if(ellipses.begin(), ellipses.end(),
                         [&](const LoadedEllipse& e) { return !members(i, e, false).empty(); });
        ellipses.erase(end, ellipses.end());
        return ellipses;
    }

    // The ellipses of i for its table: all, or those that the law alike has in its own.
    std::vector<LoadedEllipse> nodes(int i) const {
        if (!like_) return own_[at(i)];
        std::vector<LoadedEllipse> kept;
        const auto& its = like_->own_[at(i)];
        for (std::size_t k = 0; k < its.size(); ++k)
            if (std::ranges::any_of(like_->table_[at(i)].nodes(), [&](const LoadedEllipse& e) {
                    return e.spot.x == its[k].spot.x && e.spot.major == its[k].spot.major;
                }))
                kept.push_back(own_[at(i)][k]);
        return kept;
    }

    Vec2 between(int i, int j) const {
        return {indenter_.around.nearest_x(asperities_.x[at(j)] - asperities_.x[at(i)]),
                indenter_.around.nearest_y(asperities_.y[at(j)] - asperities_.y[at(i)])};
    }

    // Visits the other summits within a distance in x and in y, each once, also across the border
    // of a surface that repeats.
    template <class Visit>
    void near(int i, double distance, Visit&& visit) const {
        constexpr double half = 0.5 * (1 - 1e-9);
        const double period = indenter_.around.x, reach = std::min(distance, half * period);
        for (const double turn : {0.0, -1.0, 1.0}) {
            if (turn != 0 && !std::isfinite(period)) break;
            const double x = asperities_.x[at(i)] + (turn != 0 ? turn * period : 0.0);
            auto j = std::partition_point(by_x_.begin(), by_x_.end(),
                                          [&](int k) { return asperities_.x[at(k)] < x - reach; });
            for (; j != by_x_.end() && asperities_.x[at(*j)] <= x + reach; ++j)
                if (*j != i && std::abs(between(i, *j).y) <= distance) visit(*j);
        }
    }

    // Lower or higher summits in an ellipse of i that touch at its penetration, in the order of
    // their numbers.
    std::vector<int> members(int i, const LoadedEllipse& e, bool lower_ones) const {
        std::vector<int> found;
        if (!(e.u > 0)) return found;
        if (like_) {
            const auto& own = like_->own_[at(i)];
            return like_->members(
                i,
                *std::lower_bound(own.begin(), own.end(), (1 - 1e-6) * e.u / steeper(i),
                                  [](const LoadedEllipse& a, double u) { return a.u < u; }),
                lower_ones);
        }
        near(i, e.spot.major + std::hypot(e.spot.x, e.spot.y), [&](int j) {
            if (lower(j, i) != lower_ones || clearance_[at(i)] - e.u >= clearance_[at(j)]) return;
            const Vec2 d = between(i, j);
            if (e.spot.contains(d.x, d.y)) found.push_back(j);
        });
        std::sort(found.begin(), found.end());
        return found;
    }

    // Forces of lower summits if they and summit i, which is first, carry F together at its
    // penetration u without the others. Returns that left to i.
    double shared(double u, double F, const std::vector<int>& members,
                  std::vector<double>& f) const {
        constexpr int most = 500;
        const std::size_t n = members.size();
        std::vector<double> fresh(n);
        f.assign(n, 0.0), f[0] = F;
        const auto left = [&](std::size_t k) {
            double v = u - (clearance_[at(members[0])] - clearance_[at(members[k])]);
            for (std::size_t l = 0; l < n; ++l) {
                if (l == k) continue;
                const Vec2 d = between(members[k], members[l]);
                v -= f[l] / (std::numbers::pi * indenter_.E_star * std::hypot(d.x, d.y));
            }
            return v;
        };
        for (int i = 0; i < most; ++i) {
            fresh[0] = F;
            for (std::size_t k = 1; k < n; ++k)
                fresh[k] = table_[at(members[k])].at(left(k)).force, fresh[0] -= fresh[k];
            double change = 0;
            for (std::size_t k = 0; k < n; ++k) {
                fresh[k] = std::max(fresh[k], 0.0);
                change = std::max(change, std::abs(fresh[k] - f[k]));
                f[k] += 0.5 * (fresh[k] - f[k]);
            }
            if (change <= 1e-10 * F) break;
        }
        return left(0);
    }

    // Subtracts what the lower summits in the ellipses of i carry; their own tables are complete.
    void share(int i) {
        const Table& table = table_[at(i)];
        std::vector<LoadedEllipse> nodes;
        bool changed = false;
        for (const LoadedEllipse& e : table.nodes()) {
            if (!(e.u > 0)) continue;
            std::vector<int> group = members(i, e, true);
            std::erase_if(group, [&](int j) { return table_[at(j)].empty(); });
            nodes.push_back(e);
            if (group.empty()) continue;
            changed = true;
            group.insert(group.begin(), i);
            const double step = 1e-4 * e.u;
            std::vector<double> low, high;
            const double u0 = shared(e.u - step, e.force - step * e.stiffness, group, low),
                         u1 = shared(e.u + step, e.force + step * e.stiffness, group, high);
            nodes.back().u = 0.5 * (u0 + u1), nodes.back().force = 0.5 * (low[0] + high[0]);
            nodes.back().stiffness = (high[0] - low[0]) / (u1 - u0);
            const LoadedEllipse left = nodes.back();
            nodes.pop_back();
            // share of the highest summit; with less, the others carry the ellipse by themselves
            constexpr double least = 0.1;
            if (!like_ && !(u0 > 0 && u1 > u0 && low[0] > least * e.force && high[0] > low[0]))
                continue;
            // Smaller ellipses that carried more lay on the spots of these summits, beside their
            // tops.
            while (!like_ && !nodes.empty() && !(nodes.back().force < left.force)) nodes.pop_back();
            nodes.push_back(left);
        }
        if (changed) table_[at(i)] = Table(std::move(nodes), like_);
    }

    std::unique_ptr<Law> other_;
    const FoundSummits& found_;
    const Asperities& asperities_;
    Indenter indenter_;
    double spacing_;
    const EllipseLaw* like_;
    Stencil stencil_;
    std::vector<State> state_;
    std::vector<std::vector<LoadedEllipse>> own_;  // of each summit by itself
    std::vector<Table> table_;
    std::vector<LoadedEllipse> widest_;  // of each summit by itself
    std::vector<double> clearance_;
    std::vector<int> by_x_;
};

}  // namespace

std::unique_ptr<Law> make_ellipse_law(std::unique_ptr<Law> other, const FoundSummits& found,
                                      const Indenter& indenter, double spacing, const Law* like) {
    return std::make_unique<EllipseLaw>(std::move(other), found, indenter, spacing,
                                        dynamic_cast<const EllipseLaw*>(like));
}

}  // namespace rsc
