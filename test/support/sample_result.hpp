// A made-up result whose numbers are known by formula: asperities on a golden-ratio sequence,
// pressed one by one (no interaction). The writer's test, the Fortran reader's test and the
// pictures' test share it.
#pragma once

#include "io/result.hpp"

namespace sample {

using namespace rsc;

inline constexpr int kAsperities = 6000, kSteps = 12, kPoints = 64;
inline constexpr double kSigma = 0.01, kRadius = 0.004, kEStar = 1000, kSphere = 10;

inline double fraction(double x) { return x - std::floor(x); }

// Asperity i (from 0) of realization k: x and y are known by formula, heights spread over +- 4
// sigma.
inline Asperities asperities(int k) {
    Asperities a;
    for (int i = 0; i < kAsperities; ++i) {
        const double u = (i + 0.5) / kAsperities, v = fraction((i + 1) * 0.6180339887498949),
                     w = fraction((i + 1) * 0.7548776662466927 + 0.1 * k);
        a.x.push_back(u);
        a.y.push_back(v);
        a.z.push_back(kSigma * std::log(w / (1 - w)) * 0.55);
        a.radius.push_back(kRadius * (0.5 + fraction(97.3 * w)));
        a.kappa1.push_back(1.4 / a.radius.back());
        a.kappa2.push_back(1 / (1.4 * a.radius.back()));
        a.angle.push_back((v - 0.5) * pi);
    }
    return a;
}

inline std::vector<Level> levels(const Asperities& a) {
    std::vector<Level> out;
    for (int s = 0; s < kSteps; ++s) {
        Level level;
        level.separation = kSigma * (4.0 - 3.0 * s / (kSteps - 1));
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double rho2 = (a.x[i] - 0.5) * (a.x[i] - 0.5) + (a.y[i] - 0.5) * (a.y[i] - 0.5);
            const double g =
                a.z[i] + std::sqrt(kSphere * kSphere - rho2) - kSphere - level.separation;
            if (!(g > 0)) continue;
            level.add_contact(static_cast<int>(i), a.x[i], a.y[i],
                              4.0 / 3.0 * kEStar * std::sqrt(a.radius[i]) * g * std::sqrt(g),
                              std::sqrt(a.radius[i] * g), g);
            level.force += level.f.back();
            level.area += pi * level.a.back() * level.a.back();
        }
        level.candidates = static_cast<int>(level.asperity.size());
        level.iterations = s;
        level.beyond_law = 2 * s;
        level.products = 3 * s;
        level.residual = 1e-9;
        level.status = s == kSteps - 1 ? LevelStatus::overlapping : LevelStatus::converged;
        out.push_back(std::move(level));
    }
    return out;
}

inline Case make_case(int realizations) {
    Case c;
    c.run.title = "A made-up result";
    c.run.realizations = realizations;
    c.output.map_cells = 20;
    c.output.radial_bins = 16;
    c.output.pdf_bins = 24;
    c.output.pdf_levels = {2.0, 1.0};
    return c;
}

// Height of point (i, j): a ramp that tells x from y.
inline double height(int i, int j) {
    return kSigma * (std::sin(0.3 * i) + 0.5 * std::cos(0.2 * j)) + 1e-4 * i;
}

inline Result result(int realizations) {
    const Case c = make_case(realizations);
    Indenter indenter;
    indenter.E_star = kEStar;
    indenter.shape = kSphere;
    indenter.x0 = 0.5;
    indenter.y0 = 0.45;
    const Moments theory{kSigma * kSigma, 0.02, 0.543169 / (kRadius * kRadius), {}, {}};
    const ObserveOptions options =
        observe_options(c, {0, 0, 1, 1}, indenter, kSigma, std::sqrt(theory.m4));
    Accumulators sums(options, kSteps);
    std::vector<Level> last;
    for (int k = 1; k <= realizations; ++k) {
        const Asperities a = asperities(k);
        last = levels(a);
        SurfaceStatistics surface;
        surface.sigma = kSigma;
        surface.m2 = 0.02 + 0.001 * k;
        surface.m4 = theory.m4;
        surface.summits = kAsperities;
        surface.saddles = k;
        sums.add(observe(options, k, surface,
                         last));  // m2_grid, m4_grid and the mean curvatures stay absent
    }
    Result r = make_result(c, "&run title='A made-up result' /\n", indenter, kSigma, theory,
                           sums.finish());
    if (realizations == 1) {
        keep_contacts(r, last, contacts_kept(c));
        r.asperities = asperities(1);
        r.heights.emplace();
        r.heights->allocate(kPoints, kPoints - 4, kPoints + 2);
        r.heights->dx = r.heights->dy = 1.0 / kPoints;
        for (int j = 0; j < kPoints - 4; ++j)
            for (int i = 0; i < kPoints; ++i) r.heights->row(j)[i] = height(i, j);
    }
    return r;
}

}  // namespace sample
