// The judge of levels: after a level exists, what it is worth. The only place where the status of a
// level, its doubts and its expected errors are assigned. They depend on the level, the bodies and
// the options, not on other levels, except where the bodies themselves remember them.
#pragma once

#include "contact/path.hpp"
#include "trust/doubts.hpp"
#include "trust/filled_points.hpp"
#include "trust/grid_error.hpp"

namespace rsc {

// Larger expected errors of N and A of elements are a doubt. Under a prescribed force that of N is
// an error of the separation.
inline constexpr double kMuchForceError = 0.03, kMuchAreaError = 0.1;

// Mean curvature of a synthetic surface at points of unit height [1/length^2].
Tensor curvature_at_unit_height(const Moments& moments);

// What of the surface the judgement depends on, besides the options of the solver.
struct JudgedSurface {
    const HeightMap* map = nullptr;  // of elements; must outlive the judge
    // Elements on a synthetic surface: curvature_at_unit_height().
    std::optional<Tensor> curvature = {};
    const Measured* measured = nullptr;  // of a measured map; must outlive the judge
    double x0 = 0, y0 = 0;               // its first point [length]
};

class Judge {
public:
    Judge(const SolverOptions& options, JudgedSurface surface);

    // Judges a level of `contact`, which must be at that level. `by_force`: the level was found for
    // a prescribed force.
    void judge(Level& level, Path& contact, bool by_force);

private:
    std::vector<Doubt> of_asperities(Level& level, const Path& contact) const;
    std::vector<Doubt> of_elements(const Level& level, Path& contact, bool by_force);
    double touch_between(const Level& level, const Path& contact);
    Doubt grid(const Level& level, Path& contact) const;
    GridBodies bodies(const Indenter& indenter) const;  // of elements

    SolverOptions options_;
    JudgedSurface surface_;
    std::optional<PlaceOfTip> between_at_;
    double between_ = 0;  // Z0 at which the bodies may touch between points, at that place
};

}  // namespace rsc
