// Asperities sorted by decreasing height under the indenter, so that the candidates of a level come
// first.
#pragma once

#include "contact/indentation.hpp"
#include "surface/asperities.hpp"

namespace rsc {

class Ranking {
public:
    struct Entry {
        double height;  // Indenter::clearance
        int asperity;
    };

    // Assigns asperities, without those beyond the reach of the indenter. They must outlive the
    // ranking or its next assign().
    void assign(const Asperities& asperities, const Indenter& indenter);

    // Updates the ranking after the tip moved to (x0, y0). Only sorted entries are ranked again,
    // unless the bound on the heights of the others shows that these may have become relevant.
    void move(double x0, double y0);
    bool empty() const { return entries_.empty(); }
    // Largest height; -Infinity if there are no entries.
    double highest() const;

    // Number of entries with height > Z0, which come first, in decreasing order (ties by asperity).
    // Asperities ranked for the first time are appended to `fresh`. Sorting extends only slightly
    // deeper than required.
    std::size_t above(double Z0, std::vector<int>& fresh);
    const Entry& operator[](std::size_t rank) const { return entries_[rank]; }
    // Place of a sorted entry.
    Vec2 place(std::size_t rank) const { return {places_[rank].x, places_[rank].y}; }

private:
    double bound_on_rest() const;
    void place_sorted();  // updates places_

    const Asperities* asperities_ = nullptr;
    std::vector<Entry> entries_;
    std::size_t sorted_ = 0;
    struct Place {
        double x, y, z;
        int asperity;
    };
    std::vector<Place>
        places_;  // of the sorted entries, in their order: side by side, for loops over all of them
    Indenter now_;
    // Unsorted entries: their heights, at most highest_rest_, are those with the tip at (x_rest_,
    // y_rest_).
    double x_rest_ = 0, y_rest_ = 0;
    double highest_rest_ = -kInfinity;
    double highest_z_ = -kInfinity;  // largest z of all asperities, also beyond the indenter
};

}  // namespace rsc
