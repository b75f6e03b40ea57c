#include "physics/friction/load_table.hpp"

#include "base/error.hpp"

namespace rsc {

void LoadTable::add(const Level& level) {
    const double delta = -level.separation;
    if (!level.converged || !(delta > first_touch())) return;
    nodes_[delta] = {delta, level.energy, level.force, -level.stiffness};
}

void LoadTable::compute(double delta) {
    Level level = path_.at_separation(-delta);
    if (!level.converged) {
        ++failed_;
        return;
    }
    level.stiffness = path_.stiffness();
    add(level);
}

void LoadTable::prepare(double delta) {
    const double touch = first_touch();
    if (!(delta > touch)) return;
    constexpr int parts = 6;
    constexpr int most = 64;  // levels of a refinement
    if (!nodes_.contains(delta)) compute(delta);
    const double widest = std::sqrt(delta - touch) / parts;
    const auto root = [&](double d) { return std::sqrt(std::max(d - touch, 0.0)); };
    // From first touch up: intervals that are too wide are divided.
    double from = touch;
    int added = 0;
    while (from < delta && added < most) {
        const auto next = nodes_.upper_bound(from);
        if (next == nodes_.end()) break;
        const double low = root(from), high = root(next->first);
        bool wide = high - low > 1.5 * widest;
        if (!wide && from > touch) {
            const Node &a = nodes_.at(from), &b = next->second;
            const double h = b.delta - a.delta;
            const double cubic = 0.5 * (a.load + b.load) + h / 8 * (a.stiffness - b.stiffness);
            const double quintic = between(a, b, 0.5 * (a.delta + b.delta))[1];
            const double highest = nodes_.at(delta).load;
            wide = std::abs(cubic - quintic) > kCoarse * highest && high - low > 0.1 * widest;
        }
        if (!wide) {
            from = next->first;
            continue;
        }
        const double middle = low + std::max(1.0, std::round((high - low) / widest / 2)) *
                                        std::min(widest, 0.5 * (high - low));
        const long before = failed_;
        compute(touch + middle * middle);
        ++added;
        if (failed_ > before) break;
    }
}

std::array<double, 3> LoadTable::between(const Node& a, const Node& b, double delta) {
    const double h = b.delta - a.delta, t = (delta - a.delta) / h;
    // Of t, with derivatives by t at both ends.
    const double w = b.energy - a.energy, p = h * a.load, q = h * b.load, r = h * h * a.stiffness,
                 s = h * h * b.stiffness;
    const double c3 = 10 * w - 6 * p - 4 * q - 1.5 * r + 0.5 * s;
    const double c4 = -15 * w + 8 * p + 7 * q + 1.5 * r - s;
    const double c5 = 6 * w - 3 * p - 3 * q - 0.5 * r + 0.5 * s;
    const double t2 = t * t, t3 = t2 * t;
    return {a.energy + p * t + 0.5 * r * t2 + c3 * t3 + c4 * t3 * t + c5 * t3 * t2,
            (p + r * t + 3 * c3 * t2 + 4 * c4 * t3 + 5 * c5 * t3 * t) / h,
            (r + 6 * c3 * t + 12 * c4 * t2 + 20 * c5 * t3) / (h * h)};
}

std::array<double, 3> LoadTable::at(double delta) const {
    if (!(delta > first_touch()) || nodes_.empty()) return {0, 0, 0};
    auto next = nodes_.lower_bound(delta);
    if (next == nodes_.end())
        throw Error(Failure::internal, "a load beyond the levels of its curve");
    const Node& b = next->second;
    if (b.delta == delta) return {b.energy, b.load, b.stiffness};
    const Node touch{first_touch(), 0, 0, 0};
    return between(next == nodes_.begin() ? touch : std::prev(next)->second, b, delta);
}

LoadCurve::Load LoadTable::load(double delta) {
    const auto [energy, force, stiffness] = at(delta);
    return {std::max(force, 0.0), std::max(energy, 0.0)};
}

double LoadTable::stiffness(double delta) { return std::max(at(delta)[2], 0.0); }

double LoadTable::approach(double force) {
    double low = first_touch(), high = nodes_.empty() ? low : nodes_.rbegin()->first;
    for (const auto& [delta, node] : nodes_) {
        if (node.load >= force) {
            high = delta;
            break;
        }
        low = delta;
    }
    constexpr int halvings = 60;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (load(middle).force < force ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace rsc
