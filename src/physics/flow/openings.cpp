#include "physics/flow/openings.hpp"

namespace rsc {

std::size_t Openings::root_of_run(std::size_t r) {
    // The first pass adds up the periods from r to the root, the second refers every run on the way
    // to the root directly.
    std::size_t top = r;
    std::int32_t x = 0, y = 0;
    while (run_[top].parent != top) {
        x += run_[top].x;
        y += run_[top].y;
        top = run_[top].parent;
    }
    while (run_[r].parent != top && r != top) {
        Run& run = run_[r];
        const std::size_t next = run.parent;
        const std::int32_t step_x = run.x, step_y = run.y;
        run.parent = std::uint32_t(top);
        run.x = x;
        run.y = y;
        x -= step_x;
        y -= step_y;
        r = next;
    }
    return top;
}

// The run s lies `period_x`, `period_y` periods beyond its place in the cell if it is reached from
// r.
void Openings::link(std::size_t r, std::size_t s, int period_x, int period_y) {
    const std::size_t a = root_of_run(r), b = root_of_run(s), into = std::min(a, b);
    const std::int32_t x = (a == r ? 0 : run_[r].x) + period_x - (b == s ? 0 : run_[s].x);
    const std::int32_t y = (a == r ? 0 : run_[r].y) + period_y - (b == s ? 0 : run_[s].y);
    if (a == b) {
        run_[a].winds |= std::uint8_t((x != 0 ? 1 : 0) | (y != 0 ? 2 : 0));
    } else {
        Run& from = run_[std::max(a, b)];
        const std::int32_t sign = a < b ? 1 : -1;
        from.parent = std::uint32_t(into);
        from.x = sign * x;
        from.y = sign * y;
        run_[into].winds |= from.winds;
    }
    all_ |= run_[into].winds;
}

std::optional<std::size_t> Openings::run_of(std::size_t k) const {
    const auto row = [&](std::size_t j) { return run_.begin() + std::ptrdiff_t(rows_[j]); };
    const auto after =
        std::upper_bound(row(k / nx_), row(k / nx_ + 1), k,
                         [](std::size_t point, const Run& r) { return point < r.first; });
    if (after == row(k / nx_) || (after - 1)->end <= k) return {};
    return std::size_t(after - 1 - run_.begin());
}

std::uint8_t Openings::ways(std::size_t k) {
    const auto r = run_of(k);
    return r ? run_[root_of_run(*r)].winds : std::uint8_t(0);
}

std::size_t Openings::root(std::size_t k) {
    const auto r = run_of(k);
    return r ? run_[root_of_run(*r)].first : k;
}

}  // namespace rsc
