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

void indent(Contact& contact, int levels) {
    for (int k = 0; k < levels; ++k) (void)contact.at_separation(kSigma * (4 - 3.0 * k / (levels - 1)));
}

void asperities(const char* name, LawKind law, Detail detail) {
    const Asperities a = make_asperities(Spectrum{}, 2048, Normalise::sample, 1, 1, Curvature::geometric, nullptr, nullptr, 1, detail);
    SolverOptions options;
    options.law = law;
    options.sigma = kSigma;
    double elastic = 0;
    for (const double H : kHardness) {
        options.hardness.H0 = H;
        const double time = shortest(7, [&] {
            AsperityContact contact(a, kGold, options);
            indent(contact, 100);
        });
        if (H == kInfinity)
            elastic = time;
        else
            std::printf("  %s, 100 levels, H = %g N/mm2: %.1f ms, of the elastic solve %.2f (wanted: 1.5)\n", name, H, 1e3 * time,
                        time / elastic);
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
            indent(contact, 30);
        });
        if (H == kInfinity)
            elastic = time;
        else
            std::printf("  elements, 4096^2, 30 levels, H = %g N/mm2: %.2f s, of the elastic solve %.2f\n", H, time, time / elastic);
    }
}

}  // namespace bench
