// A second rough body, s = -z2, with heights z2 positive upwards like those of the first. Its
// centre is above the tip position, and Z0 is the separation of the two mean planes. Between grid
// points it is interpolated by polynomials, like measured maps in surface/detection.hpp.

#include "base/error.hpp"
#include "physics/indenter/shapes.hpp"
#include "surface/stencil.hpp"
#include "surface/surface.hpp"

namespace rsc {
namespace {

constexpr int kReach = 6;          // points on either side
constexpr int kBlock = 16;         // side of the blocks whose highest points are stored [points]
constexpr double kOnPoint = 1e-9;  // distance within which an offset is a grid point [steps]

class MapShape final : public IndenterShape {
public:
    MapShape(const char* name, const ShapeKeys& keys)
        : IndenterShape(name, keys),
          map_(*keys.map),
          blocks_x_((map_.nx + kBlock - 1) / kBlock),
          blocks_y_((map_.ny + kBlock - 1) / kBlock) {
        for (int reach = 1; reach <= kReach; ++reach)
            stencils_.push_back(Stencil::polynomial(reach));
        find_tops();
    }

    std::string text(const std::string& unit) const override {
        return format("second rough body, %d x %d points on %g x %g %s,", map_.nx, map_.ny,
                      map_.Lx(), map_.Ly(), unit.c_str());
    }
    double height(double x, double y) const override {
        Along u, v;
        if (!place(x, map_.dx, map_.nx, 1, u) || !place(y, map_.dy, map_.ny, 1, v))
            return kInfinity;
        return -sum(u, 0, v, 0);
    }
    void heights(int n, const double* x, double y, double* s) const override {
        Along u, v;
        const bool inside = place(y, map_.dy, map_.ny, 1, v);
        for (const int k : indices(n))
            s[k] = inside && place(x[k], map_.dx, map_.nx, 1, u) ? -sum(u, 0, v, 0) : kInfinity;
    }
    Vec2 gradient(double x, double y) const override {
        Along u, v;
        if (!place(x, map_.dx, map_.nx, 2, u) || !place(y, map_.dy, map_.ny, 2, v)) return {};
        return {-sum(u, 1, v, 0) / map_.dx, -sum(u, 0, v, 1) / map_.dy};
    }
    Tensor curvature(double x, double y) const override {
        Along u, v;
        if (!place(x, map_.dx, map_.nx, 3, u) || !place(y, map_.dy, map_.ny, 3, v)) return {};
        return {-sum(u, 2, v, 0) / (map_.dx * map_.dx), -sum(u, 1, v, 1) / (map_.dx * map_.dy),
                -sum(u, 0, v, 2) / (map_.dy * map_.dy)};
    }
    double biharmonic(double x, double y) const override {
        Along u, v;
        if (!place(x, map_.dx, map_.nx, 5, u) || !place(y, map_.dy, map_.ny, 5, v)) return 0;
        const double dx2 = map_.dx * map_.dx, dy2 = map_.dy * map_.dy;
        return -(sum(u, 4, v, 0) / (dx2 * dx2) + 2 * sum(u, 2, v, 2) / (dx2 * dy2) +
                 sum(u, 0, v, 4) / (dy2 * dy2));
    }
    double lowest(const Box& box) const override {
        const auto range = [this](double low, double high, double step, int n, int blocks,
                                  int& first, int& last) {
            if (map_.periodic || !std::isfinite(low) || !std::isfinite(high))
                return first = 0, last = blocks - 1, true;
            const double from = low / step + 0.5 * (n - 1) - 1,
                         to = high / step + 0.5 * (n - 1) + 1;
            if (to < 0 || from > n - 1) return false;
            first = std::clamp(int(from), 0, n - 1) / kBlock;
            last = std::clamp(int(to), 0, n - 1) / kBlock;
            return true;
        };
        int i0, i1, j0, j1;
        if (!range(box.x0, box.x1, map_.dx, map_.nx, blocks_x_, i0, i1) ||
            !range(box.y0, box.y1, map_.dy, map_.ny, blocks_y_, j0, j1))
            return kInfinity;
        double top = -kInfinity;
        for (int j = j0; j <= j1; ++j)
            for (int i = i0; i <= i1; ++i)
                top = std::max(top, tops_[std::size_t(j * blocks_x_ + i)]);
        return -top;
    }
    double reach() const override { return 0.5 * std::hypot(map_.Lx(), map_.Ly()); }
    bool repeats(double x, double y) const override {
        constexpr double same = 1e-9;
        const auto fits = [](double period, double length) {
            return std::isinf(period) || std::abs(length - period) <= same * period;
        };
        return map_.periodic && fits(x, map_.Lx()) && fits(y, map_.Ly());
    }

private:
    // Interpolation along one axis: points first ... first + 2 reach and their weights for each
    // derivative.
    struct Along {
        int first = 0, reach = -1;
        double t = 0;
        int orders = 0;
        alignas(64) double weight[Stencil::kOrders][Stencil::kTaps];
    };

    // Returns false more than half a step beyond the outermost points. The result of the last call
    // is reused for the same offset.
    bool place(double offset, double step, int n, int orders, Along& along) const {
        const double at = offset / step + 0.5 * (n - 1);
        if (!map_.periodic && !(at >= -0.5 - kOnPoint && at <= n - 0.5 + kOnPoint)) return false;
        int middle = int(std::floor(at + 0.5));
        int reach = kReach;
        if (!map_.periodic) {
            reach = std::clamp(std::min(middle, n - 1 - middle), 1, kReach);
            middle = std::clamp(middle, reach, n - 1 - reach);
        }
        double t = at - middle;
        if (std::abs(t) < kOnPoint) t = 0;
        if (reach != along.reach || std::abs(t - along.t) > 1e-3 * kOnPoint ||
            orders > along.orders) {
            along.reach = reach;
            along.t = t;
            along.orders = orders;
            stencils_[std::size_t(reach - 1)].weights(t, orders, along.weight);
        }
        along.first = middle - reach;
        return true;
    }

    double sum(const Along& u, int order_x, const Along& v, int order_y) const {
        double total = 0;
        for (int j = 0; j <= 2 * v.reach; ++j) {
            const double w = v.weight[order_y][j];
            if (w == 0) continue;
            const double* const row =
                map_.row(map_.periodic ? wrapped(v.first + j, map_.ny) : v.first + j);
            double line = 0;
            for (int i = 0; i <= 2 * u.reach; ++i) {
                const double a = u.weight[order_x][i];
                if (a != 0)
                    line += a * row[map_.periodic ? wrapped(u.first + i, map_.nx) : u.first + i];
            }
            total += w * line;
        }
        return total;
    }

    // Upper bounds of the heights of blocks: the highest point in and around a block plus a quarter
    // of the range, for values between points.
    void find_tops() {
        for (const int bj : indices(blocks_y_))
            for (const int bi : indices(blocks_x_)) {
                double low = kInfinity, high = -kInfinity;
                for (int j = std::max(bj * kBlock - 1, 0);
                     j <= std::min((bj + 1) * kBlock, map_.ny - 1); ++j)
                    for (int i = std::max(bi * kBlock - 1, 0);
                         i <= std::min((bi + 1) * kBlock, map_.nx - 1); ++i) {
                        low = std::min(low, map_(i, j));
                        high = std::max(high, map_(i, j));
                    }
                tops_.push_back(high + 0.25 * (high - low));
            }
    }

    const HeightMap& map_;
    int blocks_x_, blocks_y_;
    std::vector<double> tops_;
    std::vector<Stencil> stencils_;  // of reach 1, 2, ...
};

}  // namespace

std::shared_ptr<const IndenterShape> make_map_shape(const char* name, const ShapeKeys& keys) {
    if (!keys.map || keys.map->nx < 3 || keys.map->ny < 3)
        bad_input("body 2 needs a map of at least 3 x 3 points");
    return std::make_shared<MapShape>(name, keys);
}

}  // namespace rsc
