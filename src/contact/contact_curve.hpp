// The load curve of a contact, level by level, at any order of approaches.
#pragma once

#include "contact/contact.hpp"
#include "contact/friction.hpp"
#include "contact/load_curve.hpp"

namespace rsc {

// Two contacts of the same asperities, sphere and options take turns: friction asks for the approach at hand and for one further out, and
// each is reached faster from its own last level. Which one answers depends on the approaches asked for alone.
class ContactCurve : public LoadCurve {
public:
    ContactCurve(Contact& one, Contact& other) : contact_{&one, &other} {}

    double first_touch() const override { return -contact_[0]->first_touch(); }
    Load load(double delta) override;
    double stiffness(double delta) override;
    double approach(double force) override;

    // Forgets the last levels, as if newly made. The caller makes the contacts forget theirs, too.
    void forget() { last_[0].reset(), last_[1].reset(); }

    // Levels computed so far, and those of them that did not converge.
    long levels() const { return levels_; }
    long failed() const { return failed_; }
    // The level at an approach: computed, unless it is the last one of either contact.
    const Level& level(double delta);

private:
    int lane(double delta) const;

    Contact* contact_[2];
    std::unique_ptr<Level> last_[2];
    long levels_ = 0, failed_ = 0;
};

// Friction at the spots of the present level: q_i = -m sum over the pieces of u' [f_i(s_end) - f_i(s_begin)], and the stick
// radius, that of the spot at stick_approach() (0 where all of it slips): its area sticks, the rest of the spot slips.
struct SpotSlip {
    int asperity = 0;  // 0-based, in increasing order: the contacts of the level at history.approach()
    double radius = 0, stick_radius = 0;
    Slide force;
};
// Asks `curve` for a level for each piece of memory.
std::vector<SpotSlip> slip_of_spots(ContactCurve& curve, const FrictionHistory& history);

}  // namespace rsc
