#include "elements/block_correction.hpp"

#include "base/parallel.hpp"

namespace rsc {
namespace {

// The side of a block is the smallest divisor of nx and ny between these. Blocks wider than the
// reach of M do not repeat its work; on narrower blocks the steps cost more than they save.
constexpr int kNarrowest = 12, kWidest = 32;
constexpr int kFewest = 16;  // blocks along a side
// F is multiplied by exp(-kFilter (k side)^2), because P is not smooth
constexpr double kFilter = 0.25;
// Reduction of the residual on blocks, and a bound for its steps; more accurate solutions do not
// save steps on pixels.
constexpr double kReduction = 0.01;
constexpr int kSteps = 60;
constexpr int kBlockRows = 16;  // that a thread takes at a time

}  // namespace

BlockCorrection::BlockCorrection(int nx, int ny, double aspect, const PixelStencil& inverse,
                                 const Share& share) {
    const int common = std::gcd(nx, ny);
    int side = kNarrowest;
    while (side <= kWidest && common % side != 0) ++side;
    if (side > kWidest || std::min(nx, ny) < kFewest * side) return;
    side_ = side;
    mx_ = nx / side;
    my_ = ny / side;
    far_ = std::make_unique<PeriodicPixels<float>>(mx_, my_, 1, aspect, [&](double k_side) {
        const double k = k_side / side,
                     beyond = (share ? 1 + share(k) : 1) - 0.5 * k / inverse.transform(k);
        return std::max(beyond, 0.0) * std::exp(-kFilter * k_side * k_side) - 1;
    });
}

std::vector<float> BlockCorrection::sums(const PixelSet& set, const float* r, int threads) const {
    std::vector<float> sums(at(mx_) * at(my_), 0.0f);
    parallel_for(my_, 1, threads, [&](int J) {
        for (int j = J * side_; j < (J + 1) * side_; ++j)
            for (std::size_t k = set.rows[at(j)]; k < set.rows[at(j) + 1];) {
                const int block = set.column[k] / side_, end = (block + 1) * side_;
                float part = 0;
                for (; k < set.rows[at(j) + 1] && set.column[k] < end; ++k) part += m(k) * r[k];
                sums[at(J) * at(mx_) + at(block)] += part;
            }
    });
    return sums;
}

void BlockCorrection::set(const PixelSet& set, std::span<const float> m,
                          std::span<const float> free, int threads) {
    m_ = m;
    root_ = sums(set, free.data(), threads);
    for (float& d : root_) d = std::sqrt(std::max(d, 0.0f));
}

void BlockCorrection::multiply(const std::vector<float>& x, std::vector<float>& Fx) {
    Fx.resize(x.size());
    far_->apply(
        [&](int J, float* row) {
            const std::size_t first = at(J) * at(mx_);
            for (std::size_t i = 0; i < at(mx_); ++i) row[i] = x[first + i] * root_[first + i];
        },
        [&](int J, const float* row) {
            const std::size_t first = at(J) * at(mx_);
            for (std::size_t i = 0; i < at(mx_); ++i)
                Fx[first + i] = row[i] * root_[first + i] / static_cast<float>(side_);
        });
}

void BlockCorrection::subtract(const PixelSet& set, const float* r, float* y, int threads) {
    // Solves (1 + D^1/2 F D^1/2) z = D^-1/2 P' M r. The field is then F D^1/2 z.
    std::vector<float> residual = sums(set, r, threads), z(residual.size(), 0.0f), direction, image;
    // The sum of add(i), which also changes the vectors.
    const auto sum = [&](auto&& add) {
        return sum_in_order(my_, kBlockRows, threads, [&](int J) {
            double part = 0;
            for (std::size_t i = at(J) * at(mx_); i < at(J + 1) * at(mx_); ++i) part += add(i);
            return part;
        });
    };
    const auto product = [](float a, float b) {
        return static_cast<double>(a) * static_cast<double>(b);
    };
    const auto divided = [&](float x, std::size_t i) { return root_[i] > 0 ? x / root_[i] : 0.0f; };
    direction.resize(residual.size());
    double square = sum([&](std::size_t i) {
        direction[i] = residual[i] = divided(residual[i], i);
        return product(residual[i], residual[i]);
    });
    const double goal = kReduction * kReduction * square;
    for (int step = 0; step < kSteps && square > goal; ++step) {
        multiply(direction, image);
        const double curvature = sum([&](std::size_t i) {
            image[i] += direction[i];
            return product(direction[i], image[i]);
        });
        const auto alpha = static_cast<float>(square / curvature);
        const double last = std::exchange(square, sum([&](std::size_t i) {
                                              z[i] += alpha * direction[i];
                                              residual[i] -= alpha * image[i];
                                              return product(residual[i], residual[i]);
                                          }));
        const auto beta = static_cast<float>(square / last);
        sum([&](std::size_t i) {
            direction[i] = residual[i] + beta * direction[i];
            return 0.0;
        });
    }
    multiply(z, image);
    sum([&](std::size_t i) {
        image[i] = divided(image[i], i);
        return 0.0;
    });
    parallel_for(my_, 1, threads, [&](int J) {
        const float* const field = image.data() + at(J) * at(mx_);
        for (int j = J * side_; j < (J + 1) * side_; ++j)
            for (std::size_t k = set.rows[at(j)]; k < set.rows[at(j) + 1];) {
                const int block = set.column[k] / side_, end = (block + 1) * side_;
                for (; k < set.rows[at(j) + 1] && set.column[k] < end; ++k)
                    y[k] -= m(k) * field[block];
            }
    });
}

}  // namespace rsc
