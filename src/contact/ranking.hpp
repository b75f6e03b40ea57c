// Asperities by falling height under the sphere, so that the candidates of a level are the first ones.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "contact/indentation.hpp"
#include "rough/asperities.hpp"

namespace rsc {

// Penetration without interaction, g0_i = height_i - Z0, of an asperity under the sphere whose tip is at (x0, y0):
// height_i = z_i + sqrt(R^2 - rho_i^2) - R; -Infinity outside the sphere (rho > R).
double height_under_sphere(const Indenter& indenter, double x, double y, double z);

class Ranking {
public:
    struct Entry {
        double height;
        int asperity;
    };

    // Asperities outside the sphere are left out.
    void assign(const Asperities& asperities, const Indenter& indenter);
    bool empty() const { return entries_.empty(); }
    // Height of the highest, -Infinity if there is none, and its asperity.
    double highest() const;
    int highest_asperity() const;

    // Number of entries with height > Z0: they come first, highest first, ties by asperity. Asperities ranked for the first time
    // are appended to `fresh`. Sorting goes only as deep as levels ask for, and a little deeper.
    std::size_t above(double Z0, std::vector<int>& fresh);
    const Entry& operator[](std::size_t rank) const { return entries_[rank]; }

private:
    std::vector<Entry> entries_;
    std::size_t sorted_ = 0;
    double highest_rest_ = -std::numeric_limits<double>::infinity();  // of what is not sorted yet
};

}  // namespace rsc
