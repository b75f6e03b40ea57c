// Friction by boundary elements: the tangential problem of an increment of the slide of body 2.
//
// Each pixel k of the contact carries a traction q_k of two components, |q_k| <= mu p_k. With the
// displacements u = T q (elements/traction_products.hpp) an increment d of the slide causes the
// slip
//     w = d + T q_before - T q,
// which is 0 where |q| < mu p and along q where |q| = mu p: q is the unique minimum of the
// complementary energy q'Tq/2 - (d + T q_before)'q over these discs. Pixels that join the contact
// start at T q_before, without deflection; those that leave lose their traction. The pressures do
// not depend on q (bodies of equal elasticity). Increments at constant pressures are exact for a
// pixel whose slip does not turn back within them; where pressures change, errors are of first
// order in the increment.
#pragma once

#include "contact/level.hpp"
#include "elements/traction_products.hpp"
#include "physics/friction/friction.hpp"

namespace rsc {

// Minimises q'Tq/2 - b'q over discs |q_k| <= limit_k. In every round pixels stick, or slip along
// their limit; conjugate gradients on the displacements that this leaves, in which a slipping pixel
// turns against the curvature of its limit, are followed by a projection on the discs. If this does
// not converge in some rounds, steps along the gradient, which decrease the energy, alternate with
// them.
class TractionSolver {
public:
    explicit TractionSolver(TractionProducts& products) : products_(products) {}

    struct Outcome {
        bool converged = false;
        int rounds = 0;
        double residual = 0;  // rms of the violations of the conditions on w, over `scale`
    };
    // q holds the start and receives the solution, w = b - T q; both are over the pixels of the
    // products. `limit` may be Infinity. `scale` > 0 [length]: of the residual.
    Outcome solve(const std::vector<double>& limit, const std::vector<double>& b, double scale,
                  double tolerance, std::vector<double>& q, std::vector<double>& w);

private:
    void evaluate(bool exact);
    void project();
    double classify();
    void descend(int most_steps, double reduction);
    void step_along_gradient();
    double energy() const;
    void restrict_to_free(std::vector<double>& v) const;

    TractionProducts& products_;
    std::size_t n_ = 0;
    const std::vector<double>*limit_ = nullptr, *b_ = nullptr;
    std::vector<double> q_, w_;
    // Of a slipping pixel: the direction of q, and w along it over |q|; sticking pixels have 0, 0.
    std::vector<double> along_x_, along_y_, bend_;
    std::vector<double> residual_, y_, direction_, image_;
    std::vector<float> from_, to_;
};

// A contact whose body 2 slides.
class SlidingElements {
public:
    SlidingElements(const Indenter& indenter, const Friction& friction, const PointGrid& map,
                    double tolerance);

    // The tip is above a point of a surface that repeats around it (Indenter::around).
    void move_tip(const Indenter& indenter);

    // Slides body 2 by (x, y) [length] to these pressures. False: it did not converge.
    bool slide(const LevelPixels& pixels, Slide by);

    Slide force() const;                            // Q: sum of the tractions [force]
    double energy() const;                          // q'Tq/2 [force length]
    double work_lost() const { return now_.lost; }  // since the beginning [force length]
    double step_lost() const { return step_lost_; }
    double sticking_area() const;  // [length^2]
    // Forces for unit slides, dQ_x/dx, dQ_x/dy and dQ_y/dy [force/length], if all pixels stick, or
    // if those that slip keep their tractions.
    std::array<double, 3> stiffness(bool slipping_ones_too = true);
    // The slide along a direction at which the last pixel would slip under tractions mu p along it
    // everywhere [length]: full slip.
    double full_slip(Slide direction);

    // Over the pixels of the contact: tractions, their limits and displacements T q, and the slip
    // since the pixel touched.
    struct State {
        std::vector<std::int32_t> pixels;  // as LevelPixels::index
        std::vector<double> limit, q, u, slip;
        double lost = 0;
    };
    const State& state() const { return now_; }
    void restore(State state) { now_ = std::move(state); }
    long products() const { return products_.count(); }

private:
    void set_contact(const LevelPixels& pixels);

    Friction friction_;
    PointGrid map_;
    double tolerance_, area_, step_lost_ = 0;
    TractionProducts products_;
    TractionSolver solver_;
    std::vector<Pixel> on_plane(const std::vector<std::int32_t>& pixels) const;
    bool sticks(std::size_t k) const;

    std::vector<std::int32_t> set_;  // of the products
    Pixel cut_{0, 0};                // first column and row of the map around the tip
    State now_;
};

}  // namespace rsc
