// Friction at the levels of a case: first loading and a cycle at each.
#pragma once

#include "physics/friction/contact_curve.hpp"
#include "physics/friction/load_table.hpp"
#include "run/job.hpp"

namespace rsc {

class FrictionLevels {
public:
    // `copy` makes a contact of the bodies of the levels; its path is not that of the levels.
    // Asperities solve each load of the curve, boundary elements interpolate it (load_table.hpp).
    FrictionLevels(const Case& settings, const std::function<std::unique_ptr<Path>()>& copy);

    // Adds the loop of a level, missing without contact. Returns false if a level of its load curve
    // did not converge.
    bool add(const Level& level, FrictionLoops& loops);

    // Boundary elements: the pixels that stick at `share` of the slide of full slip after pressing
    // to the level, with the pressures below which nothing slips; the traction of a pixel is mu
    // times what its pressure is above.
    LevelPixels stuck(const Level& level, double share);

private:
    long failed() const { return table_ ? table_->failed() : curve_ ? curve_->failed() : 0; }

    Friction friction_;
    std::unique_ptr<Path> copies_[2];
    std::optional<ContactCurve> curve_;
    std::optional<LoadTable> table_;
};

}  // namespace rsc
