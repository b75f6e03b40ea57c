#include "physics/flow/dissection.hpp"

namespace rsc {
namespace {

// Columns x0 <= x < x1 and rows y0 <= y < y1.
struct Box {
    int x0, x1, y0, y1;
};

class Dissection {
public:
    Dissection(int nx, int ny, const std::vector<std::uint8_t>& used)
        : nx_(nx), ny_(ny), used_(used) {
        order_.reserve(static_cast<std::size_t>(
            std::count_if(used.begin(), used.end(), [](std::uint8_t u) { return u != 0; })));
    }

    std::vector<std::uint32_t> all() {
        // Periodic in both directions: two lines make a rectangle of the cell.
        const int column = best_column({0, nx_, 0, ny_}, 0, nx_);
        const int row = best_row({0, nx_, 0, ny_}, 0, ny_);
        shift_x_ = column + 1;
        shift_y_ = row + 1;
        cut({0, nx_ - 1, 0, ny_ - 1});
        take({nx_ - 1, nx_, 0, ny_ - 1});
        take({0, nx_, ny_ - 1, ny_});
        return std::move(order_);
    }

private:
    std::size_t at(int x, int y) const {
        const int column = (x + shift_x_) % nx_;
        const int row = (y + shift_y_) % ny_;
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(nx_) +
               static_cast<std::size_t>(column);
    }
    void take(const Box& box) {
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = box.x0; x < box.x1; ++x)
                if (used_[at(x, y)]) order_.push_back(static_cast<std::uint32_t>(at(x, y)));
    }
    // Of the columns first .. last - 1 that with the fewest points, the middle one of several.
    int best_column(const Box& box, int first, int last) {
        count_.assign(static_cast<std::size_t>(last - first), 0);
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = first; x < last; ++x)
                count_[static_cast<std::size_t>(x - first)] += used_[at(x, y)] ? 1 : 0;
        return first + fewest();
    }
    int best_row(const Box& box, int first, int last) {
        count_.assign(static_cast<std::size_t>(last - first), 0);
        for (int y = first; y < last; ++y)
            for (int x = box.x0; x < box.x1; ++x)
                count_[static_cast<std::size_t>(y - first)] += used_[at(x, y)] ? 1 : 0;
        return first + fewest();
    }
    int fewest() const {
        const int middle = static_cast<int>(count_.size()) / 2;
        int best = middle;
        for (int k = 0; k < static_cast<int>(count_.size()); ++k) {
            const int here = count_[static_cast<std::size_t>(k)];
            const int least = count_[static_cast<std::size_t>(best)];
            if (here < least || (here == least && std::abs(k - middle) < std::abs(best - middle)))
                best = k;
        }
        return best;
    }
    void cut(const Box& box) {
        constexpr int kLeaf = 8;  // sides of parts that are not cut any more
        const int width = box.x1 - box.x0;
        const int height = box.y1 - box.y0;
        if (width <= kLeaf && height <= kLeaf) return take(box);
        // A line in the middle fifth leaves two parts of similar sizes.
        if (width >= height) {
            const int slack = width / 10;
            const int middle = box.x0 + width / 2;
            const int x = best_column(box, middle - slack, middle + slack + 1);
            cut({box.x0, x, box.y0, box.y1});
            cut({x + 1, box.x1, box.y0, box.y1});
            take({x, x + 1, box.y0, box.y1});
        } else {
            const int slack = height / 10;
            const int middle = box.y0 + height / 2;
            const int y = best_row(box, middle - slack, middle + slack + 1);
            cut({box.x0, box.x1, box.y0, y});
            cut({box.x0, box.x1, y + 1, box.y1});
            take({box.x0, box.x1, y, y + 1});
        }
    }

    int nx_, ny_, shift_x_ = 0, shift_y_ = 0;
    const std::vector<std::uint8_t>& used_;
    std::vector<std::uint32_t> order_;
    std::vector<int> count_;
};

}  // namespace

std::vector<std::uint32_t> dissection(int nx, int ny, const std::vector<std::uint8_t>& used) {
    return Dissection(nx, ny, used).all();
}

}  // namespace rsc
