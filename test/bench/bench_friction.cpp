// What friction costs beside the normal contact.
#include <cstdio>
#include <memory>

#include "bench.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/contact_curve.hpp"
#include "contact/friction.hpp"
#include "rough/detection.hpp"

using namespace rsc;

namespace bench {
namespace {

void friction(const char* name, LawKind law, Detail detail) {
    constexpr double sigma = 0.01;
    constexpr int points = 100;
    const Asperities a = make_asperities(Spectrum{}, 2048, Normalise::sample, 1, 1, Curvature::geometric, nullptr, nullptr, 1, detail);
    SolverOptions options;
    options.law = law;
    options.sigma = sigma;
    const Friction coulomb{0.3, 0.75};
    const auto contact = [&] { return AsperityContact(a, kGold, options); };

    const double level = shortest(20, [&] { contact().at_separation(sigma); });
    double last = 0;
    const double loading = shortest(10, [&] {
        AsperityContact one = contact(), other = contact();
        ContactCurve curve(one, other);
        const double full = full_slip(curve, coulomb, -sigma);
        std::vector<double> slides;
        for (int k = 1; k <= points; ++k) slides.push_back(full * k / points);
        last = slide_to(curve, coulomb, -sigma, slides).back().force;
    });
    std::printf("  %s: Q(xi) at %d points up to full slip, Q = %.2f N: %.1f ms, of one level cold %.1f (wanted: 10)\n", name, points, last,
                1e3 * loading, loading / level);

    // Pressed on and slid on in small steps, as a code that calls for every time step does.
    constexpr int steps = 200;
    const auto approach = [](int k) { return sigma * (-1 + 0.1 * k / steps); };
    const double calls = shortest(5, [&] {
        AsperityContact one = contact();
        for (int k = 0; k <= steps; ++k) one.at_separation(-approach(k));
    });
    const double updates = shortest(5, [&] {
        AsperityContact one = contact(), other = contact();
        ContactCurve curve(one, other);
        FrictionHistory history(coulomb);
        for (int k = 0; k <= steps; ++k) history.go_to(curve, approach(k), {2e-3 * sigma * k, 0});
    });
    std::printf("  %s: %d updates of a path, %.1f ms each, of a force call %.2f (wanted: 2)\n", name, steps, 1e3 * updates / steps,
                updates / calls);
}

}  // namespace

void friction() {
    std::printf("\nfriction: default surface, Z0 = sigma, mu = 0.3, one thread\n");
    friction("hertz", LawKind::hertz, Detail::grid);
    friction("fourth_order", LawKind::fourth_order, Detail::subgrid);
}

}  // namespace bench
