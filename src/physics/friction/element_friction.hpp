// A contact by boundary elements along any path of separations and slides, as FrictionHistory of
// asperities.
#pragma once

#include "physics/friction/contact_curve.hpp"
#include "physics/friction/sliding_elements.hpp"

namespace rsc {

class ElementFriction {
public:
    // An elastic contact, which must outlive this; the tolerance is that of its levels.
    ElementFriction(Path& contact, const Friction& friction, const PointGrid& map,
                    double tolerance);

    // Follows the path to a separation and a slide, in one increment. The first call is its
    // beginning. False, here and below: something did not converge. If it throws, the state is
    // unchanged.
    bool go_to(double separation, Slide xi);
    // Moves the tip at the present separation; pixels in contact at both places keep their
    // tractions.
    bool move_tip(double x0, double y0);

    struct State {
        bool begun = false;
        double separation = 0, load = 0, energy = 0, step_lost = 0;
        Slide xi;
        SlidingElements::State tractions;
    };
    const State& state() const { return now_; }
    // Throws Error(bad_input) for a state of another map.
    void restore(State state);
    bool touches() const { return now_.load > 0; }
    Slide tangential_force() const { return sliding_.force(); }
    double tangential_energy() const { return sliding_.energy(); }
    double work_lost() const { return sliding_.work_lost(); }
    // If the pixels that slip keep their tractions: dQ_x/dx, dQ_x/dy, dQ_y/dy.
    std::array<double, 3> stiffness() { return sliding_.stiffness(false); }

    // As the functions of friction.hpp, along x from rest at the present separation.
    bool slide_to(const std::vector<double>& xi, double* force);
    bool slide_at_force(double Q, double& xi);
    double full_slip() { return sliding_.full_slip({1, 0}); }

    // The contacts of the last level, with circles of the same areas.
    std::vector<SpotSlip> spots() const;

private:
    bool follow(const Level& level, Slide by);
    LevelPixels pressures() const;

    Path& contact_;
    Friction friction_;
    PointGrid map_;
    SlidingElements sliding_;
    State now_;
};

}  // namespace rsc
