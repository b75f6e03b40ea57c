// The stiffness of two flats by elements, against K q = 1 on the pixels under pressure solved by
// plain conjugate gradients in double precision.
#include "check.hpp"
#include "contact/make.hpp"
#include "elements/periodic_pixels.hpp"
#include "surface/synthesis.hpp"

namespace test_flat_stiffness {

using namespace rsc;

constexpr double kE = 2.0;

// dN/dZ0 = -sum q dx dy for fixed pixels in contact.
double by_conjugate_gradients(const HeightMap& map, const std::vector<std::int32_t>& pixels) {
    PeriodicPixels<double> K(map.nx, map.ny, map.dx, map.dy);
    std::vector<double> q(pixels.size(), 0.0), r(pixels.size(), 1.0), d = r, image(pixels.size());
    const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    };
    double square = product(r, r);
    const double enough = 1e-18 * square;
    while (square > enough) {
        K.apply(
            [&](int j, double* row) {
                std::fill_n(row, map.nx, 0.0);
                for (const auto k : indices(pixels))
                    if (pixels[k] / map.nx == j) row[pixels[k] % map.nx] = d[k];
            },
            [&](int j, const double* row) {
                for (const auto k : indices(pixels))
                    if (pixels[k] / map.nx == j) image[k] = K.unit() / kE * row[pixels[k] % map.nx];
            });
        const double alpha = square / product(d, image);
        for (const auto k : indices(q)) {
            q[k] += alpha * d[k];
            r[k] -= alpha * image[k];
        }
        const double last = std::exchange(square, product(r, r));
        for (const auto k : indices(q)) d[k] = r[k] + square / last * d[k];
    }
    return -map.dx * map.dy * sum_of(q);
}

TEST(flat_stiffness) {
    const Spectrum spectrum{1, 0.8, 4, 20, false, 0.01};
    const HeightMap map = synthesize(spectrum, 160, Normalise::sample, 1, 1, nullptr, 1);
    const Indenter flat{kE, kInfinity, 0, 0, {map.Lx(), map.Ly()}};
    const double slope = std::sqrt(2 * theoretical_moments(spectrum).m2);
    for (const double pressure : {0.005, 0.02, 0.3}) {
        const auto contact =
            make_element_contact(map, flat, {.tolerance = 1e-6, .max_iterations = 200});
        const Level level = contact->at_force(pressure * kE * slope * map.Lx() * map.Ly());
        const double stiffness = contact->stiffness(),
                     exact = by_conjugate_gradients(map, level.pixels.index);
        CHECK_RELATIVE(stiffness, exact, 1e-6);
    }
}

}  // namespace test_flat_stiffness
