// Load curve of a contact, computed level by level for approaches in any order.
#pragma once

#include "contact/path.hpp"
#include "physics/friction/friction.hpp"

namespace rsc {

// Uses two contacts of the same asperities, sphere and options: friction requests the current
// approach and a smaller one alternately, and each is solved faster from its own last level. The
// choice depends only on the requested approaches.
class ContactCurve : public LoadCurve {
public:
    ContactCurve(Path& one, Path& other) : contact_{&one, &other} {}

    double first_touch() const override { return -contact_[0]->first_touch(); }
    Load load(double delta) override;
    double stiffness(double delta) override;
    double approach(double force) override;

    // Discards the last levels. The caller must also call forget() of the contacts.
    void forget() {
        last_[0].reset();
        last_[1].reset();
    }

    // Which contacts of the memory have a level here. After a restore these contacts have solved
    // that level again, and recall() takes it from them.
    std::array<bool, 2> known() const { return {last_[0] != nullptr, last_[1] != nullptr}; }
    void recall(std::array<bool, 2> known) {
        for (const auto k : indices(known))
            last_[k] = known[k] && contact_[k]->level()
                           ? std::make_unique<Level>(*contact_[k]->level())
                           : nullptr;
    }

    // Number of levels computed, and of those that did not converge.
    long levels() const { return levels_; }
    long failed() const { return failed_; }
    // Level at an approach; computed unless it is the last one of either contact.
    const Level& level(double delta);

private:
    int lane(double delta) const;

    Path* contact_[2];
    std::unique_ptr<Level> last_[2];
    long levels_ = 0, failed_ = 0;
};

// Friction of the spots of the current level: forces q_i = -m sum over the pieces of u' [f_i(s_end)
// - f_i(s_begin)], and stick radii. The stick radius is that of the spot at stick_approach(), 0 if
// all of it slips; the rest of the spot slips.
struct SpotSlip {
    int asperity = 0;  // 0-based index, increasing: the contacts of the level at history.approach()
    double radius = 0, stick_radius = 0;
    Slide force;
};
// Requests one level of `curve` for each piece of the memory.
std::vector<SpotSlip> slip_of_spots(ContactCurve& curve, const FrictionHistory& history);

}  // namespace rsc
