#include "elements/spot_blocks.hpp"

#include "base/dispatch.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

// Replaces a symmetric positive definite matrix A (n x n) by its inverse, by Gauss-Jordan
// elimination without pivoting.
RSC_ALWAYS_INLINE void invert_body(std::size_t n, double* A) {
    for (std::size_t k = 0; k < n; ++k) {
        double* const pivot = A + k * n;
        const double inverse = 1 / pivot[k];
        pivot[k] = 1;
        for (std::size_t j = 0; j < n; ++j) pivot[j] *= inverse;
        for (std::size_t i = 0; i < n; ++i) {
            if (i == k) continue;
            double* const row = A + i * n;
            const double factor = row[k];
            row[k] = 0;
            for (std::size_t j = 0; j < n; ++j) row[j] -= factor * pivot[j];
        }
    }
}
RSC_DISPATCH(invert, invert_body, (std::size_t n, double* A), (n, A))

RSC_ALWAYS_INLINE void multiply_body(std::size_t n, const float* A, const float* x, float* y) {
    for (std::size_t i = 0; i < n; ++i) y[i] = 0;
    for (std::size_t j = 0; j < n; ++j) {
        const float factor = x[j];
        const float* row = A + j * n;  // symmetric
        for (std::size_t i = 0; i < n; ++i) y[i] += factor * row[i];
    }
}
RSC_DISPATCH(multiply, multiply_body, (std::size_t n, const float* A, const float* x, float* y),
             (n, A, x, y))

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
        const auto next = [&] { above = above_end, above_end = end_of(above); };
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

}  // namespace

std::vector<int> open_sides(const std::vector<Pixel>& pixels, int period_x, int period_y) {
    std::vector<int> open(pixels.size());
    for_neighbours(
        pixels, period_x, period_y,
        [&](int k, int end) {
            for (int l = k; l < end; ++l) open[at(l)] = 2 + (l == k) + (l == end - 1);
        },
        [&](int k, int l, int n) {
            for (int i = 0; i < n; ++i) --open[at(k + i)], --open[at(l + i)];
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
            k = root(k), l = root(l);
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

void SpotBlocks::assign(const std::vector<Pixel>& all, const std::vector<int>& which,
                        const PixelProducts& products, double diagonal) {
    std::vector<Pixel> pixels(which.size());
    for (std::size_t k = 0; k < which.size(); ++k) pixels[k] = all[at(which[k])];
    std::vector<int> label;
    std::vector<std::size_t> begin(at(connected_sets(pixels, label)) + 1,
                                   0);  // of the pixels of each spot
    for (const int l : label) ++begin[at(l) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    members_.resize(pixels.size());
    std::vector<std::size_t> next = begin;
    for (std::size_t k = 0; k < pixels.size(); ++k) members_[next[at(label[k])]++] = which[k];
    // A block is a spot, or the part of a large spot in one square of the lattice. Its number is
    // computed from its shape.
    struct Part {
        std::size_t begin, end;
        std::uint64_t number = 0;
    };
    const auto square = [&](int k) {
        constexpr int positive = (1 << 20) * kSquare;
        return std::pair((all[at(k)].y + positive) / kSquare, (all[at(k)].x + positive) / kSquare);
    };
    const auto offset = [&](const Part& part, std::size_t k) {
        const Pixel &first = all[at(members_[part.begin])], &pixel = all[at(members_[k])];
        return Pixel{pixel.x - first.x, pixel.y - first.y};
    };
    constexpr std::size_t grain = 16;
    std::vector<std::vector<Part>> parts(begin.size() / grain + 1);
    parallel_for(begin.size() - 1, grain, threads(), [&](std::size_t s) {
        const auto first = members_.begin() + static_cast<std::ptrdiff_t>(begin[s]);
        const auto last = members_.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]);
        const bool large = begin[s + 1] - begin[s] > kMostPixels;
        if (large)
            std::stable_sort(first, last, [&](int a, int b) { return square(a) < square(b); });
        Part part{begin[s], begin[s]};
        for (auto k = first; k < last; ++k) {
            if (large && k > first && square(k[-1]) != square(*k))
                parts[s / grain].push_back(std::exchange(part, {part.end, part.end}));
            const Pixel d = offset(part, part.end++);
            part.number =
                (part.number ^ static_cast<std::uint64_t>((std::int64_t{d.y} << 32) + d.x)) *
                0x9e3779b97f4a7c15u;
            part.number ^= part.number >> 32;
        }
        parts[s / grain].push_back(part);
    });
    std::erase_if(known_, [](const auto& entry) {
        return entry.second.values.empty();
    });  // an exception ended their computation
    if (std::exchange(diagonal_, diagonal) != diagonal) known_.clear();
    for (auto& [number, inverse] : known_) inverse.wanted = false;
    blocks_.clear();
    std::vector<Inverse*> fresh;
    for (const auto& some : parts)
        for (Part part : some) {
            const auto fits = [&](const Shape& shape) {
                for (std::size_t k = part.begin; k < part.end; ++k)
                    if (shape[k - part.begin] != offset(part, k)) return false;
                return true;
            };
            auto [place, is_new] = known_.try_emplace(part.number);
            while (!is_new && !(place->second.shape.size() == part.end - part.begin &&
                                fits(place->second.shape)))
                // another shape has this number
                std::tie(place, is_new) = known_.try_emplace(++part.number);
            Inverse& inverse = place->second;
            inverse.wanted = true;
            blocks_.push_back({part.begin, &inverse});
            if (!is_new) continue;
            inverse.shape.resize(part.end - part.begin);
            for (std::size_t k = part.begin; k < part.end; ++k)
                inverse.shape[k - part.begin] = offset(part, k);
            fresh.push_back(&inverse);
        }
    std::erase_if(known_, [](const auto& entry) { return !entry.second.wanted; });
    parallel_for(fresh.size(), 1, fresh.size() > 4 ? 0 : 1, [&](std::size_t f) {
        const Shape& shape = fresh[f]->shape;
        const std::size_t n = shape.size();
        std::vector<double> A(n * n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                A[i * n + j] = A[j * n + i] =
                    products.coefficient(shape[i].x - shape[j].x, shape[i].y - shape[j].y) +
                    (i == j ? diagonal : 0.0);
        const double unit = A[0];
        for (double& v : A) v /= unit;
        invert(n, A.data());
        fresh[f]->values.assign(A.begin(), A.end());
    });
    blocks_.push_back({members_.size(), nullptr});
}

void SpotBlocks::apply(const std::vector<double>& r, std::vector<double>& z) const {
    const auto for_blocks = [&](auto&& visit) {  // visit(block, first member, number of members)
        parallel_for(blocks_.size() - 1, 16, threads(), [&](std::size_t b) {
            visit(b, blocks_[b].begin, blocks_[b + 1].begin - blocks_[b].begin);
        });
    };
    std::vector<double> most(blocks_.size(), 0.0);
    for_blocks([&](std::size_t b, std::size_t begin, std::size_t n) {
        for (std::size_t k = begin; k < begin + n; ++k)
            most[b] = std::max(most[b], std::abs(r[at(members_[k])]));
    });
    // scales the values for single precision
    double unit = *std::max_element(most.begin(), most.end());
    if (!(unit > 0)) unit = 1;
    for_blocks([&](std::size_t b, std::size_t begin, std::size_t n) {
        float x[kMostPixels], y[kMostPixels];
        for (std::size_t k = 0; k < n; ++k)
            x[k] = static_cast<float>(r[at(members_[begin + k])] / unit);
        multiply(n, blocks_[b].inverse->values.data(), x, y);
        for (std::size_t k = 0; k < n; ++k)
            z[at(members_[begin + k])] = unit * static_cast<double>(y[k]);
    });
}

}  // namespace rsc
