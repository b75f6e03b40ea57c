// Cost of anisotropy and of non-Gaussian heights in making surfaces: processor times over those of the isotropic Gaussian
// surface, in turns in one run; and the tables of layers.
#include "bench.hpp"
#include "contact/interaction/layers.hpp"
#include "rough/detection.hpp"
#include "rough/synthesis.hpp"

using namespace rsc;

namespace bench {
namespace {

// The median over runs of the time of `work` over that of `reference` beside it.
double beside(int runs, const std::function<void()>& reference, const std::function<void()>& work) {
    std::vector<double> ratios;
    for (int i = 0; i < runs; ++i) {
        const double one = shortest(2, reference);
        ratios.push_back(shortest(2, work) / one);
    }
    std::nth_element(ratios.begin(), ratios.begin() + runs / 2, ratios.end());
    return ratios[static_cast<std::size_t>(runs / 2)];
}

Spectrum spectrum_of(double lambda_l, double lambda_s) { return {.L_lambda_l = lambda_l, .L_lambda_s = lambda_s}; }

}  // namespace

void made() {
    struct Grid {
        double lambda_l, lambda_s;
        int n;
    };
    for (const Grid& grid :
         {Grid{24, 256, 1024}, {24, 512, 2048}, {4, 128, 1024}, {4, 64, 1024}, {24, 128, 512}, {8, 64, 256}, {8, 32, 128}, {4, 16, 128}}) {
        const Spectrum plain = spectrum_of(grid.lambda_l, grid.lambda_s);
        const auto surface = [&](const Spectrum& s) { synthesize(s, grid.n, Normalise::sample, 1, 1); };
        const auto summits = [&](const Spectrum& s) { make_asperities(s, grid.n, Normalise::sample, 1, 1, Curvature::geometric); };
        std::printf(
            "\nmade: %d^2, L/lambda_l = %g, L/lambda_s = %g: surface %.1f ms, with its summits %.1f ms; over these (surface, summits)\n",
            grid.n, grid.lambda_l, grid.lambda_s, 1e3 * shortest(3, [&] { surface(plain); }), 1e3 * shortest(3, [&] { summits(plain); }));
        for (const double aspect : {2.0, 4.0, 8.0}) {
            if (2 * std::sqrt(aspect) * grid.lambda_s >= grid.n) continue;
            std::printf("  aspect %g:", aspect);
            for (const double direction : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 135.0, 150.0, 165.0}) {
                Spectrum s = plain;
                s.aspect = aspect, s.direction = direction;
                std::printf("  %g: %.2f %.2f", direction,
                            beside(
                                5, [&] { surface(plain); }, [&] { surface(s); }),
                            beside(
                                3, [&] { summits(plain); }, [&] { summits(s); }));
            }
            std::printf("  (wanted: 1.2)\n");
        }
        std::printf("  skewness, kurtosis:");
        for (const HeightShape& shape : {HeightShape{0.5, 3.5}, {-0.5, 3.5}, {-1, 5}, {1, 4.5}, {0, 4}, {0, 2.5}, {-2, 9}}) {
            Spectrum s = plain;
            s.shape = shape;
            Moments got;
            const double ratio = beside(
                3, [&] { surface(plain); }, [&] { synthesize(s, grid.n, Normalise::sample, 1, 1, &got); });
            std::printf("  %g %g: %.2f (off by %.3f %.3f)", shape.skewness, shape.kurtosis, ratio, got.heights.skewness - shape.skewness,
                        got.heights.kurtosis - shape.kurtosis);
        }
        std::printf("  (wanted: 3)\n");
    }
}

void layers() {
    std::printf("\nlayers: tables\n");
    const auto coated = [](double h, double E) {
        Indenter tip = kGold;
        tip.layers.count = 1;
        tip.layers.layer[0] = {h, 78.0e3, 0.42};
        tip.layers.E = E, tip.layers.nu = 0.28;
        return tip;
    };
    for (const auto& [E, count] : {std::pair{130.0e3, 1}, {7.8, 1}, {7.8e6, 1}, {1e3, 8}, {1e8, 8}}) {
        Indenter tip = coated(0.01, E);
        for (int l = 1; l < count; ++l)
            tip.layers.layer[static_cast<std::size_t>(l)] = {0.003 * (l + 1), l % 2 ? 1e3 : 3e5, 0.1 + 0.04 * l};
        tip.layers.count = count;
        std::printf("  %d layers, E of the base %g: table in %.1f ms (wanted: 50)\n", count, E,
                    1e3 * shortest(3, [&] { make_layers(tip.layers, tip.E_star); }));
    }
}

}  // namespace bench
