#include "contact/ranking.hpp"

#include <algorithm>
#include <cmath>

namespace rsc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool comes_first(const Ranking::Entry& a, const Ranking::Entry& b) {
    return a.height != b.height ? a.height > b.height : a.asperity < b.asperity;
}

}  // namespace

double height_under_sphere(const Indenter& indenter, double x, double y, double z) {
    if (std::isinf(indenter.R)) return z;
    const double dx = x - indenter.x0, dy = y - indenter.y0, rho2 = dx * dx + dy * dy, R = indenter.R;
    if (rho2 > R * R) return -kInfinity;
    return z - rho2 / (R + std::sqrt(R * R - rho2));  // sqrt(R^2 - rho^2) - R without its cancellation
}

void Ranking::assign(const Asperities& asperities, const Indenter& indenter) {
    entries_.clear();
    entries_.reserve(asperities.size());
    sorted_ = 0;
    highest_rest_ = -kInfinity;
    for (std::size_t i = 0; i < asperities.size(); ++i) {
        const double h = height_under_sphere(indenter, asperities.x[i], asperities.y[i], asperities.z[i]);
        if (h == -kInfinity) continue;
        entries_.push_back({h, static_cast<int>(i)});
        highest_rest_ = std::max(highest_rest_, h);
    }
}

double Ranking::highest() const { return sorted_ > 0 ? entries_.front().height : highest_rest_; }

int Ranking::highest_asperity() const { return std::min_element(entries_.begin(), entries_.end(), comes_first)->asperity; }

std::size_t Ranking::above(double Z0, std::vector<int>& fresh) {
    const auto first = entries_.begin(), rest = first + static_cast<std::ptrdiff_t>(sorted_);
    auto end = rest;
    if (highest_rest_ > Z0) {
        // A quarter deeper than asked for: a series of levels then passes over the rest a few times, not at every level.
        const double threshold = Z0 - 0.25 * (highest() - Z0);
        end = std::partition(rest, entries_.end(), [threshold](const Entry& e) { return e.height > threshold; });
        std::sort(rest, end, comes_first);
        for (auto e = rest; e != end; ++e) fresh.push_back(e->asperity);
        sorted_ = static_cast<std::size_t>(end - first);
        highest_rest_ = -kInfinity;
        for (auto e = end; e != entries_.end(); ++e) highest_rest_ = std::max(highest_rest_, e->height);
    }
    const auto last = std::partition_point(first, end, [Z0](const Entry& e) { return e.height > Z0; });
    return static_cast<std::size_t>(last - first);
}

}  // namespace rsc
