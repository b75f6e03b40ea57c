// The preconditioner beyond the reach of its stencil: near the closed form for the longest wave
// over all pixels, symmetric and positive over some.
#include "check.hpp"
#include "elements/block_correction.hpp"

namespace test_block_correction {

using namespace rsc;

constexpr int kSide = 256, kReach = 6;

struct Fixture {
    std::vector<std::size_t> rows = {0};
    std::vector<std::int32_t> column;
    PixelStencil inverse{kReach, [](double kx, double ky) { return 0.5 * std::hypot(kx, ky); },
                         [](int a) { return 1 - std::abs(a) / (kReach + 1.0); }};
    SparsePlane plane{kSide, kSide};
    BlockCorrection far{kSide, kSide, 1, inverse, {}};

    // A pixel belongs to the set if `in`(its column, its row).
    template <class F>
    explicit Fixture(F&& in) {
        for (int j = 0; j < kSide; ++j) {
            for (int i = 0; i < kSide; ++i)
                if (in(i, j)) column.push_back(i);
            rows.push_back(column.size());
        }
        far.set({rows, column}, stencil(std::vector<float>(column.size(), 1.0f)), 1);
    }
    std::vector<float> stencil(const std::vector<float>& r) {
        std::vector<float> y(r.size());
        plane.convolve(inverse, {rows, column}, r.data(), y.data(), 1);
        return y;
    }
    std::vector<float> apply(const std::vector<float>& r) {
        std::vector<float> y = stencil(r);
        far.subtract({rows, column}, r.data(), y.data(), 1);
        return y;
    }
};

double product(const std::vector<float>& a, const std::vector<float>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// Over all pixels K has the mode 2/k. The stencil alone is wrong by a factor of 10 for the longest
// wave; with blocks, on which waves are not smooth, some tens of per cent remain.
TEST(long_wave) {
    Fixture all([](int, int) { return true; });
    const double k = 2 * pi / kSide;
    std::vector<float> r;
    for (const std::int32_t i : all.column) r.push_back(static_cast<float>(std::cos(k * i)));
    const double exact = 0.5 * k * product(r, r);
    CHECK(product(r, all.stencil(r)) > 5 * exact);
    CHECK(product(r, all.apply(r)) < 1.5 * exact && product(r, all.apply(r)) > 0.9 * exact);
}

TEST(symmetric) {
    Fixture discs([](int i, int j) {
        return std::hypot(i % 32 - 16 + 3 * (j / 32), j % 32 - 15) < 4 + (i / 32);
    });
    std::mt19937 random(7);
    std::vector<float> a, b;
    for (std::size_t k = 0; k < discs.column.size(); ++k) {
        a.push_back(static_cast<float>(random() % 1000) / 1000);
        b.push_back(static_cast<float>(discs.column[k] > 100) +
                    static_cast<float>(random() % 1000) / 1000);
    }
    const std::vector<float> Ma = discs.apply(a), Mb = discs.apply(b);
    CHECK_CLOSE(product(b, Ma) / product(a, Mb), 1.0,
                0.002);  // the system on blocks is solved to 1 %
    CHECK(product(a, Ma) > 0 && product(b, Mb) > 0);
    CHECK(product(b, Mb) < product(b, discs.stencil(b)));
}

TEST(all_block_correction) {
    CHECK(!BlockCorrection(64, 64, 1, {}, {}).exists());
    CHECK(!BlockCorrection(509, 509, 1, {}, {}).exists());
}

}  // namespace test_block_correction
