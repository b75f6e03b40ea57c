// Asperities by falling height under the indenter, so that the candidates of a level are the first ones.
#pragma once

#include "contact/indentation.hpp"
#include "rough/asperities.hpp"

namespace rsc {

class Ranking {
public:
    struct Entry {
        double height;  // Indenter::clearance
        int asperity;
    };

    // Asperities where the indenter does not reach are left out. They must outlive the ranking, or its next assign.
    void assign(const Asperities& asperities, const Indenter& indenter);

    // The same as assign, of the same asperities, after the tip moved to (x0, y0). Only what was sorted is ranked anew as long as a
    // bound on the heights of the rest says that none of it comes up to where levels were.
    void move(double x0, double y0);
    bool empty() const { return entries_.empty(); }
    // Height of the highest, -Infinity if there is none.
    double highest() const;

    // Number of entries with height > Z0: they come first, highest first, ties by asperity. Asperities ranked for the first time
    // are appended to `fresh`. Asperities are sorted only as deep as levels need, and slightly deeper.
    std::size_t above(double Z0, std::vector<int>& fresh);
    const Entry& operator[](std::size_t rank) const { return entries_[rank]; }

private:
    double bound_on_rest() const;

    const Asperities* asperities_ = nullptr;
    std::vector<Entry> entries_;
    std::size_t sorted_ = 0;
    Indenter now_;
    // Of what is not sorted: heights are those with the tip at (x_rest_, y_rest_), where highest_rest_ is the highest.
    double x_rest_ = 0, y_rest_ = 0;
    double highest_rest_ = -std::numeric_limits<double>::infinity();
    double highest_z_ = -std::numeric_limits<double>::infinity();  // of all asperities, including those that the indenter cannot reach
};

}  // namespace rsc
