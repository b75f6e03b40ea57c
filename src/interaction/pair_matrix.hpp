// Products with a kernel that is expensive to evaluate (layers): values at pairs of points are
// stored and used again, because consecutive levels have most of their points in common.
#pragma once

#include "interaction/kernel.hpp"

namespace rsc {

// Largest number of values that one set of points may need; twice as many may be kept, of 12 bytes.
constexpr std::size_t kMostKeptValues = 8'000'000;

// G between the points that have carried force (sources, in the order in which they first did) and
// all known points. Sums are taken in the order of the sources, so their last bits depend on
// earlier calls.
class PairMatrix {
public:
    // Only for kernels without a lattice. The kernel must outlive this object.
    explicit PairMatrix(const Kernel& kernel) : kernel_(&kernel) {}

    // Number of a point, valid until forget().
    std::uint32_t find(double x, double y);
    // Sets the points that carry force; false if two of them coincide, for which there are no
    // products.
    bool set_active(const std::vector<std::uint32_t>& active);
    // True if the values for the given numbers of active and other points take too much memory.
    bool too_large(std::size_t active, std::size_t others) const;
    // Called before set_active(). True if forget() pays: for some time few of the sources have
    // carried force, so that products are slow, or too much memory is in use.
    bool stale(std::size_t active);
    // Removes all points and values.
    void forget();

    // phi = sum of f G at the active points, f over these, in full accuracy or to 1e-6.
    void among(bool single, const double* f, double* phi);
    // phi = sum of f G at other points.
    void onto(bool single, const double* f, const std::vector<std::uint32_t>& targets, double* phi);

private:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
    using Place = std::pair<double, double>;
    struct Hash {
        std::size_t operator()(const Place& place) const;
    };
    struct Point {
        double x, y;
        std::uint32_t source = kNone;  // place among the sources
        std::vector<double>
            exact;  // G from the first sources; of a source, from all sources before it
        std::vector<float> rough;  // the same, over unit_

        template <class Real>
        const Real* row() const {
            if constexpr (std::is_same_v<Real, double>)
                return exact.data();
            else
                return rough.data();
        }
    };
    // Work space of sums in one precision.
    template <class Real>
    struct Sums {
        std::vector<Real> force, back;  // by source
    };

    void extend(Point& point);
    template <class Real>
    double begin(Sums<Real>& sums, const double* f);
    // Sums from a source onto those before it, and onto the active points if `phi` is given.
    template <class Real>
    void symmetric(Sums<Real>& sums, double* phi);
    // Sums at the targets; if some are sources, after symmetric().
    template <class Real>
    void rows_onto(Sums<Real>& sums, double unit, const std::vector<std::uint32_t>& targets,
                   double* phi);

    const Kernel* kernel_;
    std::vector<Point> points_;
    std::unordered_map<Place, std::uint32_t, Hash> numbers_;  // of the points
    std::vector<std::uint32_t> active_;                       // numbers of points
    std::vector<std::uint32_t> place_;                        // of each source in active_, or kNone
    std::vector<std::uint32_t> order_;                        // places in active_, by source
    std::vector<double> x_, y_;                               // of the sources
    std::vector<double> total_;                               // by source
    std::vector<double> summed_;  // the forces that total_ is of, if it is from among()
    bool summed_single_ = false;
    double unit_ = 0;         // of `rough` [length/force]
    std::size_t values_ = 0;  // stored
    int small_ = 0;  // consecutive sets of active points much smaller than that of the sources
    Sums<double> exact_;
    Sums<float> rough_;
};

}  // namespace rsc
