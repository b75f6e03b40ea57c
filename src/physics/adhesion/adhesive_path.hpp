// The path of adhesive asperities under a changing separation (adhesive_contact.hpp).
//
// From each state the path descends to the next: where no asperity attaches or detaches, the step
// is reversible. Otherwise the step is divided until it is short, at the place where the asperity
// is expected to attach or detach; the energy lost is then the work of the short step minus the
// change of the energy. Asperities whose own loss is negligible attach and detach within long
// steps.
#pragma once

#include "asperities/asperity_level.hpp"
#include "asperities/ranking.hpp"
#include "contact/path.hpp"
#include "interaction/products.hpp"
#include "physics/adhesion/attached.hpp"
#include "physics/adhesion/sticking.hpp"

namespace rsc {

struct AdhesivePath : ContactBodies {
    using Vector = std::vector<double>;

    // State left by accepted levels.
    struct Past {
        double separation = kInfinity;
        std::vector<int> asperity;  // attached asperities, increasing
        Vector s;
        double lost = 0;         // energy dissipated since the beginning
        double least_force = 0;  // smallest force since the beginning
        double most_energy = 0;  // largest sum of the sizes of the asperities' energies
        double margin = 0;       // that of the path
        int jumps = 0;           // during moves of the tip since the last level
    };

    std::unique_ptr<Law> law;
    Sticking sticking;
    Ranking ranking;
    std::unique_ptr<Products> direct, mesh;
    Products* products = nullptr;
    AttachedSolver solver;
    double goal = 1e-9;  // tolerance of the relative residual

    Past accepted, now;
    int jumps = 0, steps = 0;
    long products_before = 0;
    std::optional<double> requested;  // force at which follow() ends
    bool lost_way = false;  // the path could not be followed, e.g. an avalanche did not end

    // Working set: asperities that may attach, and the attached ones.
    WorkingSet set;
    Vector clearance;
    Vector rate;  // of g0 along the path
    // The tip moves from `from` to `to` at the separation Z0. The path's coordinate Z is then its
    // share of the way times `length`, the largest change of a clearance.
    struct Motion {
        Vec2 from, to;
        double Z0 = 0, length = 1;
        bool edge = false;  // asperities that may attach lie outside the body somewhere on the way
    };
    std::optional<Motion> motion;
    double covered = kInfinity;  // asperities with a clearance above this are in the set
    // Height by which forces may raise an asperity, and the range of the attraction.
    double margin = 0;
    // During a jump: residuals of the state before it, by which the gaps are changed so that it is
    // an exact equilibrium. Empty: none.
    Vector held;

    // A state on the path. Positions are places in the set.
    struct Point {
        double Z = 0;
        std::vector<int> active;  // positions of the attached asperities, increasing
        Vector s;                 // their states
        std::vector<Sticking::State> states;
        Vector residuals;
        Vector u;  // penetrations of the whole set
        double force = 0, energy = 0, residual = 0;
        bool exact = false;
        // Derivatives with respect to Z: of the force, of the work, of s and of u.
        double dforce = 0, power = 0, dpower = 0;
        Vector ds, du;
    };
    Point here;

    // Second derivatives of u with respect to Z, from a way of this length.
    struct Trend {
        double length = 0;
        Vector bend;
    } trend;

    // The state before `here`, with the same attached asperities.
    struct {
        double Z = 0;
        Vector ds;
    } last;

    // As AdhesiveContact.
    AdhesivePath(const Asperities& asperities_, const Indenter& indenter_,
                 const SolverOptions& options_);

    bool begin(double target);
    bool follow(double target);
    bool follow_to_force(double N);
    Past past() const;
    bool move(double x0, double y0);
    bool stand();

private:
    // What a descent meets: an equilibrium; one that would have to be reached by a jump; or
    // asperities rise so much that others belong to the set.
    enum class Found { equilibrium, jump, raised };
    struct Step {
        double length;
        bool jump;     // asperities may attach and detach
        double ahead;  // distance to where they are expected to
    };

    bool cover(double lowest, const std::vector<int>& attached, const Vector& s);
    void find_members(double lowest, const std::vector<int>& attached);
    bool cover(double lowest);
    void add_member(int asperity, double height);
    void find_members_of_motion(std::vector<int>& fresh);
    void choose_products();
    void set_gaps(double Z);
    double clearance_at(int asperity, double share);  // with the tip at this share of its way
    bool move_piece(Vec2 from, Vec2 to);

    bool find(Point& point, double accuracy, int least = 0);
    void read_solution(Point& point);
    void complete(Point& point, double accuracy = 1e-4);
    double raised() const;

    Step next_step(double rest, double direction, double blocked) const;
    Point predicted(double Z, bool jump) const;
    std::size_t fastest(double direction) const;
    double fold_ahead(double direction) const;
    Found descend(Point& there, bool jump, double accuracy);
    bool attach_touching(Point& there, bool jump, bool& refused);
    bool touches_between(const Point& there) const;
    bool hides_least_force(const Point& there) const;
    void note_bend(const Point& there);
    void hold();
    bool hides(const Point& there) const;
    double reach(double direction) const;
    void accept(Point there, const Step& step);
    bool find_between(const Point& a, const Point& b, double share, Point& middle);
    Point least_between(const Point& there, double bound);
    bool find_requested(const Point& there);
    bool find_force(const Point& there);
    double dissipated(const Point& there, double ahead, bool detaches) const;

    bool small(int position) const;
    int at_place(int position) const { return set.asperity[at(position)]; }
    double scale(int position) const { return -sticking.lets_go(at_place(position)); }
    double near(int position) const;
};

}  // namespace rsc
