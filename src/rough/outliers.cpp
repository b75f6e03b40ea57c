#include "rough/outliers.hpp"

namespace rsc {
namespace {

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

Outliers remove_outliers(HeightMap& map, double times) {
    constexpr int kReach = 2;
    const auto at = [&](int i, int j) {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(map.nx) + static_cast<std::size_t>(i);
    };
    std::vector<double> distance(at(0, map.ny)), around, present;
    for (int j = 0; j < map.ny; ++j)
        for (int i = 0; i < map.nx; ++i) {
            if (std::isnan(map(i, j))) continue;
            around.clear();
            for (int b = std::max(0, j - kReach); b <= std::min(map.ny - 1, j + kReach); ++b)
                for (int a = std::max(0, i - kReach); a <= std::min(map.nx - 1, i + kReach); ++a)
                    if (!std::isnan(map(a, b))) around.push_back(map(a, b));
            distance[at(i, j)] = std::abs(map(i, j) - median(around));
            present.push_back(distance[at(i, j)]);
        }
    if (present.empty()) return {};
    Outliers found{0, times * 1.4826 * median(present)};
    for (int j = 0; j < map.ny; ++j)
        for (int i = 0; i < map.nx; ++i) {
            if (std::isnan(map(i, j)) || !(distance[at(i, j)] > found.threshold)) continue;
            map.row(j)[i] = std::numeric_limits<double>::quiet_NaN();
            ++found.count;
        }
    return found;
}

}  // namespace rsc
