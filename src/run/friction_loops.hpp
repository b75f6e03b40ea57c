// The friction of a run's levels: what a contact held at each separation answers to a slide.
#pragma once

#include <memory>

#include "contact/contact_curve.hpp"
#include "file/result.hpp"

namespace rsc {

// Adds the loops of a level. `one` and `other` are contacts of their own, like the one that found the level: its path is not disturbed.
class FrictionRows {
public:
    FrictionRows(const Friction& friction, std::unique_ptr<Contact> one, std::unique_ptr<Contact> other);
    // Returns false if a level did not converge on the way: the row is then not to be used.
    bool add(const Level& level, FrictionLoops& loops);

private:
    Friction friction_;
    std::unique_ptr<Contact> one_, other_;
    ContactCurve curve_;
};

}  // namespace rsc
