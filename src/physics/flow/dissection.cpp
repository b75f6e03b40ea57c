#include "physics/flow/dissection.hpp"

namespace rsc {
namespace {

// A point of the cell, and where it lies in the plane once the cell has been cut open.
struct Place {
    std::uint32_t point;
    std::int32_t x, y;
};

// Directions along which parts are cut: lines x, y, x + y or x - y = constant. The oblique ones cut
// off more of an open part for the same number of points.
constexpr std::size_t kDirections = 4;
constexpr std::array<std::size_t, kDirections> kAlong = {1, 0, 3, 2};
std::array<std::int32_t, kDirections> coordinates(const Place& p) {
    return {p.x, p.y, p.x + p.y, p.x - p.y};
}

// Where parts may be cut: positions low to high across the line.
struct Band {
    std::size_t direction = 0;
    std::int32_t low = 0, high = 0;
    double score = kInfinity;  // the lower, the better

    std::int32_t across(const Place& p) const { return coordinates(p)[direction]; }
    std::int32_t along(const Place& p) const { return coordinates(p)[kAlong[direction]]; }
};

// The line on the fewest points of all lines that run along a band and turn by at most 45 degrees.
// Each point of the line is a diagonal or straight neighbour of the next, so that no point on one
// side of it has a neighbour on the other side.
class Seam {
public:
    Seam(std::span<const Place> part, const Band& band)
        : band_(band), width_(at(band.high - band.low + 1)) {
        const auto [first, last] =
            std::ranges::minmax(part, {}, [&](const Place& p) { return band.along(p); });
        first_ = band.along(first);
        length_ = at(band.along(last) - first_ + 1);
        points_.assign(length_ * width_, 0);
        for (const Place& p : part) {
            const std::int32_t c = band.across(p);
            if (c >= band.low && c <= band.high) ++points_[index(step_of(p), at(c - band.low))];
        }
        for (std::size_t a = 1; a < length_; ++a)
            for (const auto c : indices(width_)) points_[index(a, c)] += before(a, c).points;
        trace();
    }

    // Below 0 on one side, 0 on the line, above 0 on the other side.
    std::int32_t side(const Place& p) const {
        return band_.across(p) - band_.low - line_[step_of(p)];
    }

private:
    // A place in the band, and the number of points on the line of fewest points up to it.
    struct Reached {
        std::size_t a, c;
        std::int32_t points;
    };

    std::size_t step_of(const Place& p) const { return at(band_.along(p) - first_); }
    std::size_t index(std::size_t a, std::size_t c) const { return a * width_ + c; }
    bool oblique() const { return band_.direction > 1; }

    // The best place from which a line comes to (a, c), a > 0. Oblique coordinates of points are
    // both even or both odd: straight on, the next place along is the second.
    Reached before(std::size_t a, std::size_t c) const {
        Reached best{a, c, std::numeric_limits<std::int32_t>::max()};
        const auto try_from = [&](std::size_t from, std::size_t at) {
            const std::int32_t points = points_[index(from, at)];
            if (points < best.points) best = {from, at, points};
        };
        if (!oblique()) try_from(a - 1, c);
        if (oblique() && a > 1) try_from(a - 2, c);
        if (c > 0) try_from(a - 1, c - 1);
        if (c + 1 < width_) try_from(a - 1, c + 1);
        if (best.a == a) best.points = 0;  // a line may begin here
        return best;
    }

    void trace() {
        line_.assign(length_, 0);
        Reached at = end();
        for (std::size_t a = at.a; a < length_; ++a) line_[a] = std::int32_t(at.c);
        while (at.a > 0) {
            const Reached next = before(at.a, at.c);
            if (next.a == at.a) break;
            for (std::size_t a = next.a; a < at.a; ++a) line_[a] = std::int32_t(next.c);
            at = next;
        }
    }
    // Where the best line ends, nearest to the middle of the band.
    Reached end() const {
        Reached best{length_ - 1, 0, std::numeric_limits<std::int32_t>::max()};
        const auto off_middle = [&](std::size_t c) {
            return c > width_ / 2 ? c - width_ / 2 : width_ / 2 - c;
        };
        for (std::size_t a = length_ - (oblique() && length_ > 1 ? 2 : 1); a < length_; ++a)
            for (const auto c : indices(width_)) {
                const auto parity = std::int32_t(a + c) + first_ + band_.low;
                if (oblique() && parity % 2 != 0) continue;
                const std::int32_t points = points_[index(a, c)];
                if (points < best.points ||
                    (points == best.points && off_middle(c) < off_middle(best.c)))
                    best = {a, c, points};
            }
        return best;
    }

    Band band_;
    std::size_t width_, length_ = 0;
    std::int32_t first_ = 0;
    std::vector<std::int32_t> points_;
    std::vector<std::int32_t> line_;  // position of the line in the band at each step along it
};

class Dissection {
public:
    Dissection(int nx, int ny, const std::vector<std::uint8_t>& used) {
        std::uint32_t k = 0;
        for (const int y : indices(ny))
            for (int x = 0; x < nx; ++x, ++k)
                if (used[k]) places_.push_back({k, x, y});
        other_.resize(places_.size());
        last_.resize(places_.size());
        open(nx, ny);
    }

    std::vector<std::uint32_t> order() const {
        std::vector<std::uint32_t> order;
        order.reserve(places_.size());
        for (const Place& p : places_) order.push_back(p.point);
        return order;
    }

private:
    // Cuts the periodic cell open by a row and a line from this row to its image, and then to
    // pieces.
    void open(int nx, int ny) {
        const std::int32_t row = fewest(&Place::y, ny);
        for (Place& p : places_) p.y = p.y <= row ? p.y + ny : p.y;
        std::span<Place> rest(places_);
        rest = rest.first(divide(rest, [&](const Place& p) { return p.y - (row + ny); }).second);
        if (rest.empty()) return;
        const std::int32_t column = fewest(&Place::x, nx);  // in the middle of the band
        for (Place& p : rest) p.x = (p.x - column + nx / 2 + nx) % nx;
        const Seam seam(rest, {0, 0, nx - 1});
        const auto [left, end] = divide(rest, [&](const Place& p) { return seam.side(p); });
        for (Place& p : rest.first(left)) p.x += nx;
        cut(rest.first(end));
    }
    std::int32_t fewest(std::int32_t Place::*across, int n) const {
        std::vector<std::uint32_t> count(at(n), 0);
        for (const Place& p : places_) ++count[at(p.*across % n)];
        return std::int32_t(std::ranges::min_element(count) - count.begin());
    }

    // Cuts the part into halves, these again, and puts the points of each line behind its halves.
    void cut(std::span<Place> part) {
        constexpr std::size_t kLeaf = 8;  // points of parts that are not cut any more
        if (part.size() <= kLeaf) return;
        const Seam seam(part, best_band(part));
        const auto [first, second] = divide(part, [&](const Place& p) { return seam.side(p); });
        cut(part.first(first));
        cut(part.subspan(first, second - first));
    }

    // Orders the part: one side, the other side, the line. Returns where the first two end.
    template <class Side>
    std::pair<std::size_t, std::size_t> divide(std::span<Place> part, const Side& side_of) {
        std::size_t first = 0, second = 0, third = 0;
        for (const Place& p : part) {
            const std::int32_t side = side_of(p);
            if (side < 0)
                part[first++] = p;
            else if (side > 0)
                other_[second++] = p;
            else
                last_[third++] = p;
        }
        const auto rest = std::copy_n(other_.begin(), second, part.begin() + std::ptrdiff_t(first));
        std::copy_n(last_.begin(), third, rest);
        return {first, first + second};
    }

    // The band of one of the directions that leaves at least three tenths of the points on either
    // side: that with the straight line of the fewest points.
    Band best_band(std::span<const Place> part) {
        std::array<std::int32_t, kDirections> low = coordinates(part[0]), high = low;
        for (const Place& p : part) {
            const auto c = coordinates(p);
            for (const auto d : indices(kDirections)) {
                low[d] = std::min(low[d], c[d]);
                high[d] = std::max(high[d], c[d]);
            }
        }
        for (const auto d : indices(kDirections)) count_[d].assign(at(high[d] - low[d] + 1), 0);
        for (const Place& p : part) {
            const auto c = coordinates(p);
            for (const auto d : indices(kDirections)) ++count_[d][at(c[d] - low[d])];
        }
        Band best;
        for (const auto d : indices(kDirections)) {
            const Band band = middle(d, low[d], double(part.size()));
            if (band.score < best.score) best = band;
        }
        return best;
    }
    Band middle(std::size_t direction, std::int32_t first, double points) const {
        constexpr double kSmallest = 0.3;
        Band band{direction, first, first, points};
        double below = 0;
        std::int32_t at = first;
        for (const std::uint32_t count : count_[direction]) {
            const double balance = std::min(below, points - below - count) / points;
            if (below <= kSmallest * points) band.low = at;
            if (below <= (1 - kSmallest) * points) {
                band.high = at;
                // The one nearest to the middle of several with as few points.
                if (below >= kSmallest * points) band.score = std::min(band.score, count - balance);
            }
            below += count;
            ++at;
        }
        return band;
    }

    std::vector<Place> places_, other_, last_;  // the last two: work space of divide()
    std::array<std::vector<std::uint32_t>, kDirections> count_;
};

}  // namespace

std::vector<std::uint32_t> dissection(int nx, int ny, const std::vector<std::uint8_t>& used) {
    return Dissection(nx, ny, used).order();
}

}  // namespace rsc
