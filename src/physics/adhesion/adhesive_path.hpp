// The path of adhesive asperities under a changing separation (adhesive_contact.hpp): attachments,
// detachments, avalanches, and states of a given force on the way.
#pragma once

#include "asperities/asperity_level.hpp"
#include "asperities/ranking.hpp"
#include "contact/path.hpp"
#include "interaction/products.hpp"
#include "physics/adhesion/attached.hpp"
#include "physics/adhesion/sticking.hpp"

namespace rsc {

// tolerance for touching, relative to the detachment penetration of an asperity
constexpr double kTouching = 1e-8;
// error of the products of the state before a jump; it does not change in the jump
constexpr double kNoiseBeforeJump = 3e-7;

struct AdhesivePath : ContactBodies {
    using Vector = std::vector<double>;

    // State left by accepted levels.
    struct Past {
        double separation = kInfinity;
        std::vector<int> asperity;  // attached asperities, increasing
        Vector s;
        double lost = 0;         // energy dissipated since the beginning
        double least_force = 0;  // smallest force since the beginning
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
    std::vector<int> place;      // position of an asperity in the set; -1: not in the set
    double covered = kInfinity;  // asperities with a clearance above this are in the set
    // height by which forces may raise an asperity, and the range of the attraction
    double margin = 0;
    std::vector<int> active;  // positions of the attached in the set
    // Asperities that would be in the set, with their clearances, but stay away from touching by
    // more than `safety`.
    bool thin = false;  // there may be such
    std::vector<std::pair<int, double>> left_out;
    double safety = 0;

    // A state on the path.
    struct Point {
        double Z = 0;
        Vector s;  // states of the attached
        Vector u;  // penetrations of the others, relative to attachment
        std::vector<Sticking::State> states;
        double force = 0, energy = 0, residual = 0;
        bool exact = false;
        AttachedSolver::Change change;
        Vector left;  // expected distances of the attached to detachment
    };
    Point here;

    // The state before a jump: the attached asperities, and the penetrations of the others by
    // asperity.
    struct Held {
        int asperity;
        Sticking::State state;
        double residual;
    };
    std::vector<Held> held_before;
    Vector free_before;

    // Second derivatives of all penetrations with respect to Z, by position in the set, from a way
    // of this length.
    struct Trend {
        double length = 0;
        Vector bend;
    } trend;

    // As AdhesiveContact.
    AdhesivePath(const Asperities& asperities_, const Indenter& indenter_,
                 const SolverOptions& options_);

    void cover(double lowest);
    bool leave_out(double lowest);
    bool missed();
    void choose_products();
    void attach(const std::vector<int>& attached, const Vector& s);
    bool find(double Z, Vector s, Point& point, double accuracy = 0, int least = 0);
    void complete(Point& point, double accuracy = 1e-4);
    double raised() const;
    void read_solution(Point& point);
    void hold();
    void keep();
    void hold_more(double Z);
    double energy_gained() const;
    Vector rates() const;
    double bend(int position) const {
        return trend.bend.empty() ? 0.0 : trend.bend[static_cast<std::size_t>(position)];
    }
    void note_bend(const Vector& now_rates, const Point& there);
    std::pair<Vector, bool> predict(double Z, const Vector& now_rates, int but = -1) const;
    bool settle(double Z, Vector s);
    bool leap(double target, std::optional<double> wanted);
    bool others_apart(const Point& point, std::size_t k) const;
    void attach_one(int position, double ahead);
    void let_go(std::size_t weakest, double ahead);
    void jump(Vector s, double ahead, double bend, int event = -1, double lifts = 0);
    void attach_at(int position, double u, Vector& s);
    void detach(std::size_t k, Vector& s);
    bool go(double target, std::optional<double> wanted);
    bool begin(double target);
    void set_gaps(double Z);
    void hold_gaps();
    double clearance_at(int asperity, double share);  // with the tip at this share of its way
    bool move(double x0, double y0);
    bool stand();
    bool move_piece(Vec2 from, Vec2 to);
    Point least_between(const Point& a, const Point& b);
    bool find_force(const Point& a, const Point& b, double wanted);
    double scale(int position) const {
        return -sticking.lets_go(set.asperity[static_cast<std::size_t>(position)]);
    }
    double near(int position) const;
    double fold(int position) const;
    Past past() const;
};

}  // namespace rsc
