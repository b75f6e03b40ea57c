// Load curve of an elastic contact between the levels of a run: boundary elements have a load, a
// stiffness and an energy at each level, and between levels the curve is interpolated.
#pragma once

#include "contact/path.hpp"
#include "physics/friction/friction.hpp"

namespace rsc {

// The energy W(delta) is interpolated by polynomials of degree 5 that have the energies, loads N =
// dW/ddelta and stiffnesses dN/ddelta of the levels. Levels are about evenly spaced in the root of
// the depth below first touch, six or more to the deepest; for a Hertz contact the load between
// them is then exact to 7e-5 of the largest. Where loads interpolated by degree 3 differ from those
// of degree 5 by more than kCoarse of the largest load, for example where contacts begin, further
// levels are computed.
class LoadTable final : public LoadCurve {
public:
    static constexpr double kCoarse = 1e-3;

    // `path`: an elastic contact for levels that are missing; it must outlive the table.
    explicit LoadTable(Path& path) : path_(path) {}

    // A level of the same contact at the same place of the tip, with its energy and stiffness.
    void add(const Level& level);
    // Computes levels so that the curve is known up to the approach of a level.
    void prepare(double delta);

    double first_touch() const override { return -path_.first_touch(); }
    Load load(double delta) override;
    double stiffness(double delta) override;
    double approach(double force) override;

    long failed() const { return failed_; }  // number of levels that did not converge

private:
    struct Node {
        double delta, energy, load, stiffness;
    };
    using Nodes = std::map<double, Node>;

    void compute(double delta);
    // W and its derivatives at a depth between two nodes, by polynomials of degree 5.
    static std::array<double, 3> between(const Node& a, const Node& b, double delta);
    std::array<double, 3> at(double delta) const;

    Path& path_;
    Nodes nodes_;  // by approach, above first touch
    long failed_ = 0;
};

}  // namespace rsc
