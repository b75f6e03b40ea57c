// Cost of a layer at a level: processor time of 100 levels from 4 sigma down, over that of the same surface without layers, medians of 5 in
// turns in one run. A layer changes how many asperities touch at a separation: the first ratio is for levels down to 1 sigma with and without
// it, the one in brackets for levels down to the separation at which as many touch as without it at 1 sigma. Contacts and the tables of layers
// are made beforehand.
#include <cstdio>
#include <string>

#include "bench.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/element_contact.hpp"
#include "contact/interaction/layers.hpp"
#include "rough/detection.hpp"
#include "rough/synthesis.hpp"

using namespace rsc;

namespace bench {
namespace {

constexpr double kSigma = 0.01;
constexpr int kRuns = 5;

double touching(const Level& level) { return static_cast<double>(std::max<std::size_t>(level.a.size(), level.pixels.index.size())); }

using Maker = std::function<std::unique_ptr<Contact>(const Indenter&)>;

// NaN if a level does not converge, as for layers much thinner than a spot is wide.
double levels(const Maker& maker, const Indenter& of, int count, double last) {
    const auto contact = maker(of);
    const double start = now();
    for (int k = 0; k < count; ++k)
        if (contact->at_separation(kSigma * (4 - (4 - last) * k / (count - 1))).status == LevelStatus::not_converged) return NAN;
    return now() - start;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

// Separation, in units of sigma, at which this many asperities or pixels touch.
double as_many(const Maker& maker, const Indenter& of, double many) {
    const auto contact = maker(of);
    double low = 0.5, high = 4;
    for (int i = 0; i < 8; ++i) {
        const double middle = 0.5 * (low + high);
        const Level level = contact->at_separation(kSigma * middle);
        (touching(level) > many ? low : high) = middle;
    }
    return high;
}

void row(const char* name, const Maker& maker, const Indenter& bare, const std::vector<Indenter>& coated, int count, double last) {
    std::vector<std::vector<double>> ratios(coated.size()), fair(coated.size());
    std::vector<double> own, lasts;
    const double many = touching(maker(bare)->at_separation(kSigma * last));
    for (const Indenter& of : coated) lasts.push_back(as_many(maker, of, many));
    for (int run = 0; run < kRuns; ++run) {
        own.push_back(levels(maker, bare, count, last));
        for (std::size_t k = 0; k < coated.size(); ++k) {
            ratios[k].push_back(levels(maker, coated[k], count, last) / own.back());
            fair[k].push_back(levels(maker, coated[k], count, lasts[k]) / own.back());
        }
    }
    std::printf("  %-34s %9.3f ms", name, 1e3 * median(own) / count);
    for (std::size_t k = 0; k < ratios.size(); ++k) std::printf("  %5.2f (%.2f)", median(ratios[k]), median(fair[k]));
    std::printf("\n");
    std::fflush(stdout);
}

}  // namespace

void coated_levels() {
    const std::vector<double> thickness = {0.003, 0.01, 0.1, 1};
    const auto coated = [&](const Indenter& bare) {
        std::vector<Indenter> all;
        for (const double h : thickness) {
            all.push_back(bare);
            all.back().layers.count = 1;
            all.back().layers.layer[0] = {h, 78.0e3, 0.42};
            all.back().layers.E = 130.0e3, all.back().layers.nu = 0.28;
        }
        return all;
    };
    Indenter flat = kGold;
    flat.shape = HUGE_VAL, flat.period = {1, 1};
    const auto tips = coated(kGold), flats = coated(flat);
    std::vector<std::shared_ptr<const SmoothPart>> tables;  // shared by all contacts
    for (const auto& tip : tips) tables.push_back(layers_of(tip.layers, tip.E_star));
    std::printf("\ncoated_levels: a level without layers, and with a layer of h/L = 0.003, 0.01, 0.1, 1 over it (wanted: 1.3)\n");
    Spectrum coarse{.L_lambda_s = 128};
    const HeightMap map = synthesize(coarse, 1024, Normalise::sample, 1, 1);
    SolverOptions elements{.max_iterations = 200};
    const auto by_elements = [&](const Indenter& of) { return make_element_contact(map, of, elements); };
    row("elements 1024^2, free", by_elements, kGold, tips, 10, 1);
    row("elements 1024^2, flats", by_elements, flat, flats, 5, 1.5);
    for (const double lambda_s : {Spectrum{}.L_lambda_s, 128.0}) {
        Spectrum s{.L_lambda_s = lambda_s};
        const Asperities plain = make_asperities(s, 2048, Normalise::sample, 1, 1, Curvature::geometric);
        const Asperities fine =
            make_asperities(s, 2048, Normalise::sample, 1, 1, Curvature::geometric, nullptr, nullptr, 1, Detail::subgrid);
        for (const LawKind law : {LawKind::hertz, LawKind::fourth_order})
            for (const Method method : {Method::automatic, Method::direct, Method::mesh, Method::dgesv}) {
                SolverOptions options{.method = method, .law = law, .sigma = kSigma};
                const auto& asperities = law == LawKind::hertz ? plain : fine;
                const auto maker = [&](const Indenter& of) { return make_asperity_contact(asperities, of, options); };
                const bool dense = method == Method::dgesv;
                const std::string name = std::string(law == LawKind::hertz ? "hertz" : "fourth_order") + ", " +
                                         kMethodNames[static_cast<std::size_t>(method)] + (lambda_s == 128 ? ", 128" : "");
                row((name + ", free").c_str(), maker, kGold, tips, dense ? 10 : 100, dense ? 2 : 1);
                if (method == Method::automatic && lambda_s == 128) row((name + ", flats").c_str(), maker, flat, flats, 20, 1.5);
            }
    }
}

}  // namespace bench
