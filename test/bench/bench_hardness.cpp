// What yielding costs beside the elastic contact.
#include <cstdio>
#include <limits>

#include "bench.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/element_contact.hpp"
#include "rough/detection.hpp"
#include "rough/synthesis.hpp"

using namespace rsc;

namespace bench {
namespace {

constexpr double kSigma = 0.01, kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHardness[] = {kInfinity, 50e3, 5e3, 250.0};  // [N/mm2]: from elastic to all that touches yields

// Levels from 4 sigma to `end`; the number of contacts at the last.
int indent(Contact& contact, int levels, double end = 1) {
    int contacts = 0;
    for (int k = 0; k < levels; ++k) contacts = contact.at_separation(kSigma * (4 - (4 - end) * k / (levels - 1))).contacts;
    return contacts;
}

void asperities(const char* name, LawKind law, Detail detail) {
    const Asperities a = make_asperities(Spectrum{}, 2048, Normalise::sample, 1, 1, Curvature::geometric, nullptr, nullptr, 1, detail);
    SolverOptions options;
    options.law = law;
    options.sigma = kSigma;
    double elastic = 0;
    int touching = 0;
    for (const double H : kHardness) {
        options.hardness.H0 = H;
        int contacts = 0;
        const auto to = [&](double end) {
            return shortest(7, [&] {
                AsperityContact contact(a, kGold, options);
                contacts = indent(contact, 100, end);
            });
        };
        const double time = to(1);
        if (H == kInfinity) {
            elastic = time, touching = contacts;
            continue;
        }
        // Yielding, more asperities touch at a separation. What as many cost: down to where there are as many.
        const int more = contacts;
        double end = 1;
        AsperityContact contact(a, kGold, options);
        for (double z = 3; z > 1 && contact.at_separation(z * kSigma).contacts < touching; z -= 0.02) end = z;
        const double as_many = to(end);
        std::printf(
            "  %s, 100 levels, H = %g N/mm2: %.1f ms, %d contacts at the end, of the elastic solve (%d contacts) %.2f; down to as many "
            "contacts %.2f (wanted: 1.5)\n",
            name, H, 1e3 * time, more, touching, time / elastic, as_many / elastic);
    }
}

}  // namespace

void hardness() {
    std::printf("\nhardness: default surface, 4 to 1 sigma, solving only (yielding / elastic)\n");
    asperities("hertz", LawKind::hertz, Detail::grid);
    asperities("fourth_order", LawKind::fourth_order, Detail::subgrid);
    const HeightMap map = synthesize(Spectrum{}, 4096, Normalise::sample, 1, 1);
    SolverOptions options;
    options.sigma = kSigma;
    double elastic = 0;
    for (const double H : kHardness) {
        options.hardness.H0 = H;
        const double time = shortest(1, [&] {
            ElementContact contact(map, kGold, options);
            (void)indent(contact, 30);
        });
        if (H == kInfinity)
            elastic = time;
        else
            std::printf("  elements, 4096^2, 30 levels, H = %g N/mm2: %.2f s, of the elastic solve %.2f\n", H, time, time / elastic);
    }
}

}  // namespace bench
