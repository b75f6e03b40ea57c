// Model: the contact of a rough surface with an indenter at one separation. Asperities
// (asperities/asperity_model.hpp), boundary elements (elements/element_model.hpp), and those that
// attract. A Path (path.hpp) leads a model from level to level.
#pragma once

#include "base/archive.hpp"
#include "contact/level.hpp"
#include "contact/stepper.hpp"

namespace rsc {

// What accepted levels leave in bodies whose levels depend on earlier ones: flattened asperities,
// loads that relax, points that stick, worn heights. Only a Path changes it.
class History {
public:
    virtual ~History() = default;

    // Accepts the last solution of the model, and adds the dissipated work to its level.
    virtual void accept(Level& level) = 0;
    // The history as numbers that only an identically made model can interpret; empty: none. read()
    // restores it and throws Error(bad_input) for numbers that do not belong to these bodies.
    virtual std::vector<double> write() const = 0;
    virtual void read(const std::vector<double>& numbers) = 0;

    // Length over which the attraction of the bodies acts, or which they are pulled out when they
    // part [length]; negative: they do not attract.
    virtual double attraction() const { return -1; }
    // How a level is reached in time or by sliding; null: levels depend on their order only.
    virtual const Stepper* stepper() const { return nullptr; }
    // With a stepper: following solutions end a step of this length that begins at the last
    // accepted one, of which `lasting` remains (Leg::solve).
    virtual void step(double length, double lasting) {
        (void)length;
        (void)lasting;
    }

    // `level` is the last level.
    virtual Remains remains(const Level& level) const { return (void)level, Remains{}; }
};

// The slope of N: as exact as a result, as exact as Newton's method needs, or, of bodies that
// attract, with contact areas that stay as they are.
enum class Slope { exact, rough, clamped };

// Separations between which the bodies touch each other [length].
struct ContactRange {
    // Below it there is no solution, at it N is not determined; -Infinity: there is none.
    double full_contact = -kInfinity;
    double first_touch;  // -Infinity: nothing lies under the indenter
};

// Results depend on the bodies and their history, the place of the tip and the separation. Earlier
// solutions are starting points and change them within the tolerance only.
class Model {
public:
    virtual ~Model() = default;

    virtual const Indenter& indenter() const = 0;
    // Asperities used at present (positions, heights, curvatures); null for boundary elements.
    virtual std::shared_ptr<const Asperities> asperities() const { return nullptr; }
    // Null if levels do not depend on earlier ones.
    virtual History* history() { return nullptr; }

    // Moves the tip to (x0, y0); what it must follow on the way, it follows.
    virtual void move_tip(double x0, double y0) = 0;
    virtual ContactRange contact_range() const = 0;

    // The model's separations z are measured from a plane that each unit force raises by this
    // [length/force], so that forces only lower the surface: Z0 = z + shift() N (Kernel::shift()).
    virtual double shift() const { return 0; }

    // Solves at the separation z. Failure to converge is reported by the level. The result of a
    // `trial` of force control may be another one, if there are several: Level::provisional is
    // then set.
    virtual Level solve(double z, bool trial = false) = 0;
    // Models that solve under a force themselves: elements with the sum of their pressures as a
    // constraint, and adhesive asperities, whose path ends at the force. Absent: the Path searches
    // for it (contact/force_search.hpp).
    virtual std::optional<Level> solve_under(double N) {
        (void)N;
        return std::nullopt;
    }
    // Solves at the separation z of a level accepted earlier, at the history after it; later
    // solutions then start from there.
    virtual void solve_again(double z, const Level& level) = 0;
    // Earlier solutions are no longer starting points, and there is no history.
    virtual void forget() = 0;

    // Everything besides the bodies, the place of the tip and the history that later results depend
    // on, to the last bit: the last solution, to which stiffness() and energy() refer, and the
    // starting points. recall() of an identically made model, at this place and history, then
    // continues as this one does. Throws as the reader.
    virtual void keep(ArchiveWriter& to) const { (void)to; }
    virtual void recall(ArchiveReader& from) { (void)from; }

    // Of the last solution, or with adhesion of the state after move_tip(): dN/dz (negative; 0
    // without contact, NaN in full contact of two flats, where N is no function of z)
    // [force/length]; for unloading if it is accepted.
    virtual double stiffness(Slope which) = 0;
    // Elastic energy, dW/dz = -N [force length]: of path-dependent bodies the recoverable energy.
    // The error is of the order of the square of the residual.
    virtual double energy() const = 0;

    // For force control: an upper bound of the force at a depth below first touch, exact for one
    // asperity.
    virtual double force_at_most(double depth) = 0;
};

}  // namespace rsc
