// A small result as a run makes it, for the tests of its file.
#pragma once

#include "io/result.hpp"
#include "problem/bodies.hpp"
#include "run/realize.hpp"
#include "support/runs.hpp"

namespace sample {

using namespace rsc;

inline constexpr std::size_t kSteps = 12;

inline Case make_case(int realizations) {
    return settings_of(
        "&run title='A sample' realizations=" + std::to_string(realizations) +
        " / &surface n=128 L_lambda_l=4 L_lambda_s=32 / &solver model='asperities' / "
        "&asperities law='hertz' / &indentation steps=12 / "
        "&output map_cells=20 radial_bins=16 pdf_bins=24 pdf_levels=2,1 /");
}

inline Result result(int realizations) {
    const Case c = make_case(realizations);
    const Job job = prepare(c);
    Accumulators sums(job.observe, kSteps);
    Realization last;
    for (int k = 1; k <= realizations; ++k) {
        last = realize(job, k, 1);
        sums.add(observe(job.observe, k, last.statistics, last.levels));
    }
    Result result =
        make_result(c, case_text(c), job.indenter, job.sigma, job.theory, sums.finish());
    if (realizations > 1) return result;
    keep_contacts(result, last.levels, Contacts::all);
    result.asperities = last.asperities;
    result.heights = std::make_shared<HeightMap>(make_surface(c, 1, 1).map);
    return result;
}

}  // namespace sample
