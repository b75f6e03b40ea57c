#include "elements/pixel_interpolation.hpp"

#include "base/dispatch.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

constexpr int kMostPoints = 18;

double error_with(int q) { return 0.2 * std::pow(6.0, -q); }

// Chebyshev points of [-1, 1], and the weights for interpolation from them to t.
double chebyshev_point(int q, int i) { return std::cos(pi * (i + 0.5) / q); }
void interpolation_weights(int q, double t, double* weight) {
    for (int i = 0; i < q; ++i) {
        weight[i] = 1;
        for (int j = 0; j < q; ++j) {
            if (j != i)
                weight[i] *=
                    (t - chebyshev_point(q, j)) / (chebyshev_point(q, i) - chebyshev_point(q, j));
        }
    }
}

// Weights by pixel as weights by point.
std::vector<double> transposed(int q, const std::vector<double>& weights) {
    const std::size_t n = weights.size() / at(q);
    std::vector<double> other(weights.size());
    for (std::size_t k = 0; k < weights.size(); ++k) other[k % at(q) * n + k / at(q)] = weights[k];
    return other;
}

// Calls f with q, as a constant for the usual numbers of points.
template <class F>
RSC_ALWAYS_INLINE void with_points(int q, F&& f) {
    switch (q) {
        case 3: return f(std::integral_constant<int, 3>());
        case 6: return f(std::integral_constant<int, 6>());
        case 9: return f(std::integral_constant<int, 9>());
        default: return f(q);
    }
}

RSC_ALWAYS_INLINE void from_pixels_body(int points, const double* columns_of, const double* rows_of,
                                        std::size_t n, const TileSource* sources, double* point) {
    with_points(
        points, [=](auto q) __attribute__((always_inline)) {
            for (std::size_t k = 0; k < n; ++k) {
                const double* wx = columns_of + sources[k].column * q;
                const double* wy = rows_of + sources[k].row * q;
                for (int j = 0; j < q; ++j) {
                    const double v = sources[k].value * wy[j];
                    for (int i = 0; i < q; ++i) point[j * q + i] += v * wx[i];
                }
            }
        });
}
RSC_DISPATCH(from_pixels, from_pixels_body,
             (int points, const double* columns_of, const double* rows_of, std::size_t n,
              const TileSource* sources, double* point),
             (points, columns_of, rows_of, n, sources, point))

RSC_ALWAYS_INLINE void to_parent_body(int points, const double* cx, const double* cy,
                                      const double* child, double* parent) {
    with_points(
        points, [=](auto q) __attribute__((always_inline)) {
            double part[kMostPoints * kMostPoints];
            for (int j = 0; j < q; ++j) {
                double* to = part + j * q;
                for (int i = 0; i < q; ++i) to[i] = 0;
                for (int k = 0; k < q; ++k)
                    for (int i = 0; i < q; ++i) to[i] += child[j * q + k] * cx[k * q + i];
            }
            for (int k = 0; k < q; ++k)
                for (int j = 0; j < q; ++j)
                    for (int i = 0; i < q; ++i)
                        parent[j * q + i] += cy[k * q + j] * part[k * q + i];
        });
}
RSC_DISPATCH(to_parent, to_parent_body,
             (int points, const double* cx, const double* cy, const double* child, double* parent),
             (points, cx, cy, child, parent))

// Adds to[r*columns + c] the sum of rows_at(j, r) columns_at(i, c) point[j*q + i].
template <class Points, class Rows, class Columns>
RSC_ALWAYS_INLINE void expand(Points q, Rows rows, Columns columns, const double* columns_at,
                              const double* rows_at, const double* point, double* to) {
    double line[kMostPoints * std::max(kMostRows, kMostPoints)],
        sum[std::max(kTileColumns, kMostPoints)];
    for (int i = 0; i < q; ++i) {
        double* const part = line + i * rows;
        for (int r = 0; r < rows; ++r) part[r] = 0;
        for (int j = 0; j < q; ++j)
            for (int r = 0; r < rows; ++r) part[r] += rows_at[j * rows + r] * point[j * q + i];
    }
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) sum[c] = 0;
        for (int i = 0; i < q; ++i)
            for (int c = 0; c < columns; ++c)
                sum[c] += columns_at[i * columns + c] * line[i * rows + r];
        for (int c = 0; c < columns; ++c) to[r * columns + c] += sum[c];
    }
}

RSC_ALWAYS_INLINE void to_pixels_body(int points, int rows, const double* columns_at,
                                      const double* rows_at, const double* point, double* to) {
    constexpr std::integral_constant<int, kTileColumns> columns;
    with_points(
        points, [=](auto q) __attribute__((always_inline)) {
            if (rows == kTileColumns)
                expand(q, columns, columns, columns_at, rows_at, point, to);
            else
                expand(q, rows, columns, columns_at, rows_at, point, to);
        });
}
RSC_DISPATCH(to_pixels, to_pixels_body,
             (int points, int rows, const double* columns_at, const double* rows_at,
              const double* point, double* to),
             (points, rows, columns_at, rows_at, point, to))

RSC_ALWAYS_INLINE void to_child_body(int points, const double* cx, const double* cy,
                                     const double* parent, double* child) {
    with_points(
        points, [=](auto q)
                    __attribute__((always_inline)) { expand(q, q, q, cx, cy, parent, child); });
}
RSC_DISPATCH(to_child, to_child_body,
             (int points, const double* cx, const double* cy, const double* parent, double* child),
             (points, cx, cy, parent, child))

}  // namespace

Interpolation::Interpolation(double error, int rows, const PixelAnswer& answer)
    : q_(3), rows_(rows), aspect_(answer.dy / answer.dx), answer_(answer) {
    while (q_ < kMostPoints && error_with(q_) > error) ++q_;
    const int q = q_;
    padded_ = (q * q + kLane - 1) / kLane * kLane;
    for (int i = 0; i < q; ++i) point_.push_back(chebyshev_point(q, i));
    columns_of_.resize(at(kTileColumns * q));
    rows_of_.resize(at(rows * q));
    for (int i = 0; i < kTileColumns; ++i)
        interpolation_weights(q, (i + 0.5) * 2 / kTileColumns - 1, &columns_of_[at(i * q)]);
    for (int i = 0; i < rows; ++i)
        interpolation_weights(q, (i + 0.5) * 2 / rows - 1, &rows_of_[at(i * q)]);
    columns_at_ = transposed(q, columns_of_);
    rows_at_ = transposed(q, rows_of_);
    for (int half = 0; half < 2; ++half) {
        child_[half].resize(at(q * q));
        for (int i = 0; i < q; ++i)
            interpolation_weights(q, 0.5 * point_[at(i)] + (half == 0 ? -0.5 : 0.5),
                                  &child_[half][at(i * q)]);
        child_at_[half] = transposed(q, child_[half]);
    }
}

double Interpolation::error() const { return error_with(q_); }

void Interpolation::up_from_tile(std::size_t n, const TileSource* sources, double* point) const {
    from_pixels(q_, columns_of_.data(), rows_of_.data(), n, sources, point);
}

void Interpolation::up(int half_x, int half_y, const double* child, double* parent) const {
    to_parent(q_, child_[half_x].data(), child_[half_y].data(), child, parent);
}

void Interpolation::down_to_tile(const double* point, double* values) const {
    to_pixels(q_, rows_, columns_at_.data(), rows_at_.data(), point, values);
}

void Interpolation::down(int half_x, int half_y, const double* parent, double* child) const {
    to_child(q_, child_at_[half_x].data(), child_at_[half_y].data(), parent, child);
}

// Computes the quadrant of positive offsets. The others are mirror images: point i of a line
// corresponds to point q-1-i.
void Interpolation::make_matrices() {
    const int generation = static_cast<int>(matrices_.size()), n = q_ * q_;
    const double half_x = 0.5 * kTileColumns * std::ldexp(1.0, generation),
                 half_y = 0.5 * rows_ * aspect_ * std::ldexp(1.0, generation);
    std::vector<std::vector<double>> all(kOffsets);
    parallel_for(16, 1, 0, [&](int offset) {
        const int ox = offset % 4, oy = offset / 4;
        if (ox <= 1 && oy <= 1) return;
        std::vector<double> K(at(n) * at(n));  // (target, source)
        for (int t = 0; t < n; ++t)
            for (int s = 0; s < n; ++s) {
                const double x = half_x * (2 * ox + point_[at(s % q_)] - point_[at(t % q_)]);
                const double y = half_y * (2 * oy + point_[at(s / q_)] - point_[at(t / q_)]);
                K[at(t) * at(n) + at(s)] = answer_(x, y);
            }
        for (int sy = oy == 0 ? 1 : -1; sy <= 1; sy += 2)
            for (int sx = ox == 0 ? 1 : -1; sx <= 1; sx += 2) {
                const auto mirror = [&](int k) {
                    const int i = k % q_, j = k / q_;
                    return at((sy < 0 ? q_ - 1 - j : j) * q_ + (sx < 0 ? q_ - 1 - i : i));
                };
                std::vector<double>& T = all[at((sy * oy + 3) * 7 + sx * ox + 3)];
                T.assign(at(padded_) * at(n), 0.0);
                std::size_t k = 0;
                for (int first = 0; first < padded_; first += kSlice) {
                    const int end = std::min(padded_, first + kSlice);
                    for (int s = 0; s < n; ++s)
                        for (int t = first; t < end; ++t, ++k) {
                            if (t < n) T[k] = K[mirror(t) * at(n) + mirror(s)];
                        }
                }
            }
    });
    matrices_.push_back(std::move(all));
}

}  // namespace rsc
