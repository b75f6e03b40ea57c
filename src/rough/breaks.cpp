#include "rough/breaks.hpp"

namespace rsc {
namespace {

// Heights along one axis of a map; index 0 is the point (i, j).
struct Profile {
    const HeightMap& map;
    int i, j;
    bool along_x;

    bool has(int k) const {
        if (map.periodic) return true;
        return along_x ? i + k >= 0 && i + k < map.nx : j + k >= 0 && j + k < map.ny;
    }
    double at(int k) const {
        const auto wrapped = [](int at, int n) { return (at % n + n) % n; };
        return along_x ? map(wrapped(i + k, map.nx), j) : map(i, wrapped(j + k, map.ny));
    }
    double bend(int k) const { return has(k - 1) && has(k + 1) ? at(k - 1) - 2 * at(k) + at(k + 1) : 0; }
};

double median_bend(const HeightMap& map, bool along_x) {
    std::vector<double> bends;
    const int skip = std::max(1, map.ny / 256);
    for (int j = 1; j < map.ny - 1; j += skip)
        for (int i = 1; i < map.nx - 1; ++i)
            if (const double bend = std::abs(Profile{map, i, j, along_x}.bend(0)); bend > 0) bends.push_back(bend);
    if (bends.empty()) return 0;
    const auto middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
    std::nth_element(bends.begin(), middle, bends.end());
    return *middle;
}

// Kind of the break at point 0 of the profile, if there is one.
std::optional<Breaks::Kind> kind_of(const Profile& p, double least) {
    constexpr double foremost = 1.3;  // a pit's second difference is twice its neighbours'; at a step a neighbour's has the same size
    const double bend = p.bend(0), before = p.bend(-1), after = p.bend(1);
    if (!(std::abs(bend) > least)) return {};
    // Smooth: the neighbours curve the same way, none the other way. A hill on a plain has large second differences, too.
    constexpr double smooth = 0.3;
    const double sign = bend > 0 ? 1 : -1, like = std::max(sign * before, sign * after), against = std::max(-sign * before, -sign * after);
    if (like > smooth * std::abs(bend) && against < smooth * std::abs(bend)) return {};
    if (bend > foremost * std::max(-before, -after)) return Breaks::pit;
    if (-bend > foremost * std::max(before, after)) return Breaks::spike;
    return Breaks::step;
}

}  // namespace

Breaks find_breaks(const HeightMap& map, double height_step) {
    Breaks breaks;
    const int nx = map.nx, ny = map.ny;
    if (nx < 3 || ny < 3) return breaks;
    constexpr double rounding = 3;  // rounding changes a second difference by up to two steps
    const double least_x = std::max(kBreak * median_bend(map, true), rounding * height_step),
                 least_y = std::max(kBreak * median_bend(map, false), rounding * height_step);
    std::vector<Breaks::Place> marked;
    std::vector<int> in_column(static_cast<std::size_t>(nx), 0), in_row(static_cast<std::size_t>(ny), 0);
    const auto tell = [&](Breaks::Kind kind, int i, int j, double size) {
        Breaks::Found& found = breaks.found[kind];
        if (++found.points == 1 || size > found.size) found.largest = {i, j}, found.size = size;
    };
    // True if a neighbour is a pit or spike (`kind`), which causes the second difference at this point.
    const auto bent_by = [](const Profile& p, Breaks::Kind kind, double least) {
        const auto beside = [&](int k) {
            return p.has(k) && kind_of({p.map, p.i + (p.along_x ? k : 0), p.j + (p.along_x ? 0 : k), p.along_x}, least) == kind;
        };
        return beside(-1) || beside(1);
    };
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const Profile x{map, i, j, true}, y{map, i, j, false};
            const double bend_x = x.bend(0), bend_y = y.bend(0);
            if (!(std::abs(bend_x) > least_x || std::abs(bend_y) > least_y)) continue;
            const auto along_x = kind_of(x, least_x), along_y = kind_of(y, least_y);
            if (along_x == Breaks::pit || along_y == Breaks::pit) {
                const bool across = along_x == Breaks::pit && (along_y != Breaks::pit || bend_x >= bend_y);
                breaks.pits.push_back({i, j, across});
                tell(Breaks::pit, i, j, 0.5 * (across ? bend_x : bend_y));
                continue;
            }
            const bool spike = along_x == Breaks::spike && along_y == Breaks::spike;
            const auto left = [&](Breaks::Kind of) {
                return (along_x && !bent_by(x, of, least_x)) || (along_y && !bent_by(y, of, least_y));
            };
            if (!spike && !left(Breaks::pit)) continue;
            marked.push_back({i, j});
            if (spike) breaks.spikes.push_back({i, j});
            if (!spike && !left(Breaks::spike)) continue;
            const auto jump = [](const Profile& p) {
                return std::max(p.has(-1) ? std::abs(p.at(0) - p.at(-1)) : 0, p.has(1) ? std::abs(p.at(1) - p.at(0)) : 0);
            };
            tell(spike ? Breaks::spike : Breaks::step, i, j, spike ? -0.5 * std::max(bend_x, bend_y) : std::max(jump(x), jump(y)));
            if (!spike && along_x) ++in_column[static_cast<std::size_t>(i)];
            if (!spike && along_y) ++in_row[static_cast<std::size_t>(j)];
        }
    const auto seam = [](const std::vector<int>& counts, int length) {
        const auto most = std::max_element(counts.begin(), counts.end());
        return 2 * *most > length ? static_cast<int>(most - counts.begin()) : -1;
    };
    breaks.seam_column = seam(in_column, ny), breaks.seam_row = seam(in_row, nx);
    if (marked.empty()) return breaks;
    breaks.clear.assign(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), Breaks::kMostClear);
    constexpr int reach = Breaks::kMostClear;
    for (const auto [i, j, unused] : marked)
        for (int dj = -reach; dj <= reach; ++dj)
            for (int di = -reach; di <= reach; ++di) {
                int k = i + di, l = j + dj;
                if (map.periodic) k = (k % nx + nx) % nx, l = (l % ny + ny) % ny;
                if (k < 0 || l < 0 || k >= nx || l >= ny) continue;
                auto& clear = breaks.clear[static_cast<std::size_t>(l) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(k)];
                clear = std::min(clear, static_cast<std::uint8_t>(std::max(std::abs(di), std::abs(dj))));
            }
    return breaks;
}

void raise_pits(HeightMap& map, const Breaks& breaks) {
    // Weights of the Lagrange polynomial through 1, 2 or 3 points on either side, evaluated at the middle.
    constexpr double weights[3][3] = {{1.0 / 2, 0, 0}, {4.0 / 6, -1.0 / 6, 0}, {15.0 / 20, -6.0 / 20, 1.0 / 20}};
    const auto row_by_row = [](const Breaks::Place& a, const Breaks::Place& b) { return a.j != b.j ? a.j < b.j : a.i < b.i; };
    for (const bool along_x : {true, false}) {
        std::vector<double> raised;
        for (const Breaks::Place& pit : breaks.pits) {
            const Profile p{map, pit.i, pit.j, along_x};
            int reach = 0;
            const auto taken = [&](int k) {  // outside the map, or a pit itself
                if (!p.has(k)) return true;
                const Breaks::Place there{pit.i + (along_x ? k : 0), pit.j + (along_x ? 0 : k)};
                const auto other = std::lower_bound(breaks.pits.begin(), breaks.pits.end(), there, row_by_row);
                return other != breaks.pits.end() && other->i == there.i && other->j == there.j && other->along_x == along_x;
            };
            while (reach < 3 && !taken(reach + 1) && !taken(-reach - 1)) ++reach;
            double z = map(pit.i, pit.j);
            if (pit.along_x == along_x && reach > 0) {
                z = 0;
                for (int k = 1; k <= reach; ++k) z += weights[reach - 1][k - 1] * (p.at(k) + p.at(-k));
            }
            raised.push_back(z);
        }
        for (std::size_t k = 0; k < raised.size(); ++k) map.row(breaks.pits[k].j)[breaks.pits[k].i] = raised[k];
    }
}

}  // namespace rsc
