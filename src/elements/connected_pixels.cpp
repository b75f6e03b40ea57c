#include "elements/connected_pixels.hpp"

namespace rsc {
namespace {

// Calls run(k, end) for all pixels k ... end - 1 that follow each other in a row, and then pairs(k,
// l, n) for the pixels with a common side in other rows, or across the borders of a period: k + i
// and l + i for i = 0 ... n - 1.
template <class Run, class Pairs>
void for_neighbours(const std::vector<Pixel>& pixels, int period_x, int period_y, Run&& run,
                    Pairs&& pairs) {
    const int n = static_cast<int>(pixels.size());
    const auto end_of = [&](int k) {
        do ++k;
        while (k < n && pixels[at(k)] == Pixel{pixels[at(k - 1)].x + 1, pixels[at(k - 1)].y});
        return k;
    };
    const auto before = [](const Pixel& a, const Pixel& b) {
        return std::tie(a.y, a.x) < std::tie(b.y, b.x);
    };
    const auto wrap = [&](int k, const Pixel& there) {
        const auto other = std::lower_bound(pixels.begin(), pixels.end(), there, before);
        if (other != pixels.end() && *other == there)
            pairs(static_cast<int>(other - pixels.begin()), k, 1);
    };
    int above = 0, above_end = n > 0 ? end_of(0) : 0;  // pixels that advance along the row above
    for (int k = 0, end; k < n; k = end) {
        end = end_of(k);
        run(k, end);
        const Pixel first = pixels[at(k)], last = pixels[at(end - 1)];
        const auto next = [&] {
            above = above_end;
            above_end = end_of(above);
        };
        while (above < k && before(pixels[at(above_end - 1)], {first.x, first.y - 1})) next();
        while (above < k && pixels[at(above)].y == first.y - 1 && pixels[at(above)].x <= last.x) {
            const int left = std::max(first.x, pixels[at(above)].x),
                      right = std::min(last.x, pixels[at(above_end - 1)].x);
            pairs(above + left - pixels[at(above)].x, k + left - first.x, right - left + 1);
            if (right == last.x) break;  // it may also touch what follows
            next();
        }
        if (period_x > 0 && last.x == period_x - 1) wrap(end - 1, {0, last.y});
        for (int l = k; l < end && period_y > 0 && first.y == period_y - 1; ++l)
            wrap(l, {pixels[at(l)].x, 0});
    }
}

// Adds the straight parts of the borders across the rows of pixels that are sorted by row.
double squares_across_rows(const std::vector<Pixel>& pixels, int period) {
    struct Side {
        int line, right, row;
        auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    const auto n = pixels.size();
    for (std::size_t k = 0; k < n;) {
        const int row = pixels[k].y;
        const std::size_t of_row = sides.size();
        for (; k < n && pixels[k].y == row; ++k) {
            const int x = pixels[k].x;
            if (k == 0 || pixels[k - 1] != Pixel{x - 1, row}) sides.push_back({x, 0, row});
            if (k + 1 == n || pixels[k + 1] != Pixel{x + 1, row}) sides.push_back({x + 1, 1, row});
        }
        if (period > 0 && sides[of_row].line == 0 && sides.back().line == period) {
            sides[of_row] = sides.end()[-2];
            sides.resize(sides.size() - 2);
        }
    }
    std::ranges::sort(sides);
    double sum = 0;
    for (std::size_t k = 0; k < sides.size();) {
        std::size_t end = k + 1;
        while (end < sides.size() &&
               sides[end] == Side{sides[k].line, sides[k].right, sides[k].row + int(end - k)})
            ++end;
        sum += double(end - k) * double(end - k);
        k = end;
    }
    return sum;
}

}  // namespace

double squares_of_straight_parts(const std::vector<Pixel>& pixels, int period_x, int period_y) {
    // Transposed, with rows and columns exchanged.
    int columns = 0;
    for (const Pixel& p : pixels) columns = std::max(columns, p.x + 1);
    std::vector<std::size_t> next(at(columns) + 1, 0);
    for (const Pixel& p : pixels) ++next[at(p.x) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<Pixel> transposed(pixels.size());
    for (const Pixel& p : pixels) transposed[next[at(p.x)]++] = {p.y, p.x};
    return squares_across_rows(pixels, period_x) + squares_across_rows(transposed, period_y);
}

std::vector<int> open_sides(const std::vector<Pixel>& pixels, int period_x, int period_y) {
    std::vector<int> open(pixels.size());
    for_neighbours(
        pixels, period_x, period_y,
        [&](int k, int end) {
            for (int l = k; l < end; ++l) open[at(l)] = 2 + (l == k) + (l == end - 1);
        },
        [&](int k, int l, int n) {
            for (int i = 0; i < n; ++i) {
                --open[at(k + i)];
                --open[at(l + i)];
            }
        });
    return open;
}

int connected_sets(const std::vector<Pixel>& pixels, std::vector<int>& label, int period_x,
                   int period_y) {
    const int n = static_cast<int>(pixels.size());
    std::vector<int> parent(pixels.size());  // of each pixel; the root of a set is its first pixel
    const auto root = [&](int k) {
        while (parent[at(k)] != k) k = parent[at(k)] = parent[at(parent[at(k)])];
        return k;
    };
    for_neighbours(
        pixels, period_x, period_y,
        [&](int k, int end) { std::fill(parent.begin() + k, parent.begin() + end, k); },
        [&](int k, int l, int) {
            k = root(k);
            l = root(l);
            parent[at(std::max(k, l))] = std::min(k, l);
        });
    label.resize(pixels.size());
    int count = 0;
    for (int k = 0; k < n; ++k) {
        const int first = root(k);
        label[at(k)] = first == k ? count++ : label[at(first)];
    }
    return count;
}

}  // namespace rsc
