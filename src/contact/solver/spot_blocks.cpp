#include "contact/solver/spot_blocks.hpp"

#include "rough/dispatch.hpp"
#include "rough/parallel.hpp"

namespace rsc {
namespace {

// Replaces a symmetric positive definite matrix A (n x n) by its inverse, by Gauss-Jordan elimination without pivoting.
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
RSC_DISPATCH(multiply, multiply_body, (std::size_t n, const float* A, const float* x, float* y), (n, A, x, y))

struct Sets {
    std::vector<int> parent;
    int find(int k) {
        while (parent[at(k)] != k) k = parent[at(k)] = parent[at(parent[at(k)])];
        return k;
    }
    void join(int a, int b) {
        a = find(a), b = find(b);
        if (a != b) parent[at(std::max(a, b))] = std::min(a, b);  // the root is the first pixel
    }
};

// Calls visit(k, l) for every pair of pixels with a common side.
template <class Visit>
void for_neighbours(const std::vector<Pixel>& pixels, int period_x, int period_y, Visit&& visit) {
    const auto before = [](const Pixel& a, const Pixel& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); };
    const int n = static_cast<int>(pixels.size());
    int above = 0;  // index that advances along the row above
    for (int k = 0; k < n; ++k) {
        const Pixel p = pixels[at(k)];
        if (k > 0 && pixels[at(k - 1)] == Pixel{p.x - 1, p.y}) visit(k - 1, k);
        while (above < k && before(pixels[at(above)], {p.x, p.y - 1})) ++above;
        if (above < k && pixels[at(above)] == Pixel{p.x, p.y - 1}) visit(above, k);
        const auto wrap = [&](int x, int y) {
            const auto other = std::lower_bound(pixels.begin(), pixels.end(), Pixel{x, y}, before);
            if (other != pixels.end() && *other == Pixel{x, y}) visit(static_cast<int>(other - pixels.begin()), k);
        };
        if (period_x > 0 && p.x == period_x - 1) wrap(0, p.y);
        if (period_y > 0 && p.y == period_y - 1) wrap(p.x, 0);
    }
}

}  // namespace

std::vector<int> open_sides(const std::vector<Pixel>& pixels, int period_x, int period_y) {
    std::vector<int> open(pixels.size(), 4);
    for_neighbours(pixels, period_x, period_y, [&](int k, int l) { --open[at(k)], --open[at(l)]; });
    return open;
}

int connected_sets(const std::vector<Pixel>& pixels, std::vector<int>& label, int period_x, int period_y) {
    const int n = static_cast<int>(pixels.size());
    Sets sets;
    sets.parent.resize(pixels.size());
    std::iota(sets.parent.begin(), sets.parent.end(), 0);
    for_neighbours(pixels, period_x, period_y, [&](int k, int l) { sets.join(k, l); });
    label.resize(pixels.size());
    int count = 0;
    for (int k = 0; k < n; ++k) {
        const int root = sets.find(k);
        label[at(k)] = root == k ? count++ : label[at(root)];
    }
    return count;
}

void SpotBlocks::assign(const std::vector<Pixel>& all, const std::vector<int>& which, const PixelProducts& products) {
    std::vector<Pixel> pixels;
    for (const int k : which) pixels.push_back(all[at(k)]);
    std::vector<int> label;
    std::vector<std::size_t> begin(at(connected_sets(pixels, label)) + 1, 0);  // of the pixels of each spot
    for (const int l : label) ++begin[at(l) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    members_.resize(pixels.size());
    std::vector<std::size_t> next = begin;
    for (std::size_t k = 0; k < pixels.size(); ++k) members_[next[at(label[k])]++] = which[k];
    // A block is a spot, or the part of a large spot in one square of the lattice.
    const auto square = [&](int k) {
        constexpr int positive = (1 << 20) * kSquare;
        return std::pair((all[at(k)].y + positive) / kSquare, (all[at(k)].x + positive) / kSquare);
    };
    std::vector<std::size_t> ends;
    for (std::size_t s = 0; s + 1 < begin.size(); ++s) {
        if (begin[s + 1] - begin[s] > kMostPixels) {
            const auto first = members_.begin() + static_cast<std::ptrdiff_t>(begin[s]);
            const auto last = members_.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]);
            std::stable_sort(first, last, [&](int a, int b) { return square(a) < square(b); });
            for (auto k = first + 1; k < last; ++k)
                if (square(k[-1]) != square(*k)) ends.push_back(static_cast<std::size_t>(k - members_.begin()));
        }
        ends.push_back(begin[s + 1]);
    }
    std::erase_if(known_, [](const auto& entry) { return entry.second.values.empty(); });  // an exception ended their computation
    for (auto& [shape, inverse] : known_) inverse.wanted = false;
    blocks_.clear();
    std::vector<std::pair<const Shape*, Inverse*>> fresh;
    std::size_t b = 0;
    for (const std::size_t e : ends) {
        Shape shape;
        const Pixel first = all[at(members_[b])];
        for (std::size_t k = b; k < e; ++k) shape.push_back({all[at(members_[k])].x - first.x, all[at(members_[k])].y - first.y});
        const auto [place, is_new] = known_.try_emplace(std::move(shape));
        place->second.wanted = true;
        if (is_new) fresh.push_back({&place->first, &place->second});
        blocks_.push_back({std::exchange(b, e), &place->second});
    }
    std::erase_if(known_, [](const auto& entry) { return !entry.second.wanted; });
    parallel_for(fresh.size(), 1, fresh.size() > 4 ? 0 : 1, [&](std::size_t f) {
        const Shape& shape = *fresh[f].first;
        const std::size_t n = shape.size();
        std::vector<double> A(n * n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) A[i * n + j] = products.coefficient(shape[i].x - shape[j].x, shape[i].y - shape[j].y);
        const double unit = A[0];
        for (double& v : A) v /= unit;
        invert(n, A.data());
        fresh[f].second->values.assign(A.begin(), A.end());
    });
    blocks_.push_back({b, nullptr});
}

void SpotBlocks::apply(const std::vector<double>& r, std::vector<double>& z) const {
    const auto for_blocks = [&](auto&& visit) {  // visit(block, first member, number of members)
        parallel_for(blocks_.size() - 1, 16, members_.size() > 2000 ? 0 : 1,
                     [&](std::size_t b) { visit(b, blocks_[b].begin, blocks_[b + 1].begin - blocks_[b].begin); });
    };
    std::vector<double> most(blocks_.size(), 0.0);
    for_blocks([&](std::size_t b, std::size_t begin, std::size_t n) {
        for (std::size_t k = begin; k < begin + n; ++k) most[b] = std::max(most[b], std::abs(r[at(members_[k])]));
    });
    double unit = *std::max_element(most.begin(), most.end());  // scales the values for single precision
    if (!(unit > 0)) unit = 1;
    for_blocks([&](std::size_t b, std::size_t begin, std::size_t n) {
        float x[kMostPixels], y[kMostPixels];
        for (std::size_t k = 0; k < n; ++k) x[k] = static_cast<float>(r[at(members_[begin + k])] / unit);
        multiply(n, blocks_[b].inverse->values.data(), x, y);
        for (std::size_t k = 0; k < n; ++k) z[at(members_[begin + k])] = unit * static_cast<double>(y[k]);
    });
}

}  // namespace rsc
