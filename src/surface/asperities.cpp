#include "surface/asperities.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace rsc {

Asperities selected(const Asperities& all, const std::vector<std::size_t>& which) {
    Asperities some;
    constexpr std::size_t many = 10000;
    parallel_for(kAsperityColumns.size(), 1, which.size() > many ? 0 : 1, [&](std::size_t c) {
        const std::vector<double>& from = all.*kAsperityColumns[c].values;
        std::vector<double>& to = some.*kAsperityColumns[c].values;
        if (from.empty()) return;
        to.resize(which.size());
        for (const auto k : indices(which)) to[k] = from[which[k]];
    });
    return some;
}

void replace(Asperities& all, const std::vector<std::size_t>& which, const Asperities& some) {
    for (const AsperityColumn& column : kAsperityColumns)
        for (std::size_t k = 0; k < which.size() && !(some.*column.values).empty(); ++k)
            (all.*column.values)[which[k]] = (some.*column.values)[k];
}

std::optional<std::pair<std::size_t, std::size_t>> coincident(const Asperities& a) {
    std::vector<std::size_t> order(a.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t i) { return std::tuple(a.x[i], a.y[i], i); };
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
    const auto same = std::ranges::adjacent_find(
        order, [&](std::size_t i, std::size_t j) { return a.x[i] == a.x[j] && a.y[i] == a.y[j]; });
    if (same == order.end()) return {};
    return std::pair{same[0], same[1]};
}

void validate(const Asperities& a, const std::function<std::string(std::size_t)>& name) {
    const std::size_t n = a.size();
    const auto refuse = [](const std::string& message) { bad_input(message); };
    const auto text = [](double v) {
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, "%.17g", v);
        return std::string(buffer);
    };
    if (n == 0) refuse("there are no asperities");
    for (const AsperityColumn& column : kAsperityColumns) {
        const std::vector<double>& values = a.*column.values;
        if (values.empty() && !column.required) continue;
        if (values.size() != n)
            refuse(std::string("asperities: ") + std::to_string(values.size()) + " values of " +
                   column.name + " for " + std::to_string(n) + " asperities");
        for (const auto i : indices(n))
            if (!usable(values[i]))
                refuse(name(i) + ": " + column.name +
                       (std::isfinite(values[i]) ? " = " + text(values[i]) + ": " + kNumberBounds
                                                 : " is not finite"));
    }
    if (a.kappa1.size() != a.kappa2.size() || a.kappa1.size() != a.angle.size())
        refuse("asperities: kappa1, kappa2 and angle must be given together");
    for (const auto i : indices(n)) {
        if (!usable_positive(a.radius[i]))
            refuse(name(i) + ": the radius " +
                   (a.radius[i] > 0 ? kPositiveBounds : "must be positive") + ", not " +
                   text(a.radius[i]));
        if (!a.kappa1.empty() && !(a.kappa1[i] >= a.kappa2[i] && usable_positive(a.kappa2[i])))
            refuse(name(i) + ": kappa1 >= kappa2 > 0 was expected, not " + text(a.kappa1[i]) +
                   " and " + text(a.kappa2[i]));
    }
    if (const auto same = coincident(a))
        refuse(name(same->second) + ": lies at the same point as " + name(same->first) +
               " (x = " + text(a.x[same->first]) + ", y = " + text(a.y[same->first]) + ")");
}

}  // namespace rsc
