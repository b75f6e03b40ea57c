#include "physics/friction/friction.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

using Node = FrictionHistory::Node;

Slide operator+(Slide a, Slide b) { return {a.x + b.x, a.y + b.y}; }
Slide operator-(Slide a, Slide b) { return {a.x - b.x, a.y - b.y}; }
Slide operator*(double c, Slide a) { return {c * a.x, c * a.y}; }
double dot(Slide a, Slide b) { return a.x * b.x + a.y * b.y; }
double cross(Slide a, Slide b) { return a.x * b.y - a.y * b.x; }
double norm(Slide a) { return std::hypot(a.x, a.y); }

Slide slope(const Node& begin, const Node& end) {
    const double ds = end.approach - begin.approach;
    return ds > 0 ? (1 / ds) * (end.deflection - begin.deflection) : Slide{};
}

// Deflection u at s by linear interpolation between two nodes.
Slide between(const Node& begin, const Node& end, double s) {
    return begin.deflection + (s - begin.approach) * slope(begin, end);
}

Node node_at(LoadCurve& curve, double s, Slide u) {
    const auto load = curve.load(s);
    if (!std::isfinite(load.force) || !std::isfinite(load.energy))
        throw Error(Failure::not_converged,
                    "the load overflows double precision: choose other units");
    return {s, load.force, load.energy, u};
}

// Integral of S'(s) q(s) ds over a piece on which q is quadratic: [S q - N q' + W q''] without the
// terms in S, which cancel in the sum over the pieces, because q is continuous, and q or S vanishes
// at both ends of the whole range.
template <class Q>
double integral(const Node& begin, const Node& end, Q&& q) {
    const double h = end.approach - begin.approach;
    if (!(h > 0)) return 0;
    const double q0 = q(begin.approach), q1 = q(begin.approach + 0.5 * h), q2 = q(end.approach);
    const double slope = (-3 * q0 + 4 * q1 - q2) / h, bend = 4 * (q0 - 2 * q1 + q2) / (h * h);
    // Differences of neighbouring levels suffer from cancellation and are limited by their bounds
    // for an increasing load.
    const double growth = end.load - begin.load;
    const double area =
        std::clamp(end.energy - begin.energy - h * end.load, std::min(0.0, -h * growth), 0.0);
    return bend * area - slope * growth;
}

// Tolerance for a spring at its friction limit.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

// Pieces of memory whose slopes differ by less than this (relative to mu/m) are merged, so that
// proportional loading in many steps is one piece.
constexpr double kSameSlope = 1e-10;

}  // namespace

void require_friction(const Friction& friction) {
    if (!(friction.coefficient >= 0) || std::isinf(friction.coefficient))
        bad_input("the coefficient of friction must be finite and not negative");
    if (!(friction.ratio > 0) || std::isinf(friction.ratio))
        bad_input(
            "the ratio m = 4 G*/E* of the tangential to the normal stiffness must be "
            "positive and finite");
}

FrictionHistory::FrictionHistory(const Friction& friction) : friction_(friction) {
    require_friction(friction);
}

void FrictionHistory::restore(const State& state) {
    const double c = friction_.slide_per_approach();
    bool sound = std::isfinite(state.delta) && std::isfinite(norm(state.xi)) &&
                 std::isfinite(state.lost + state.step_lost);
    const auto& nodes = state.nodes;
    for (const auto k : indices(nodes)) {
        const Node& node = nodes[k];
        sound = sound && std::isfinite(node.approach + node.load + node.energy) &&
                (k == 0 || node.approach >= nodes[k - 1].approach) &&
                norm(node.deflection) <= c * (state.delta - node.approach) +
                                             1e-9 * c * (state.delta - nodes.front().approach);
    }
    sound = sound && nodes.size() != 1 && (nodes.empty() || nodes.back().approach == state.delta);
    if (!sound) bad_input("the state does not belong to a contact with this friction");
    now_ = state;
}

void FrictionHistory::go_to(LoadCurve& curve, double delta, Slide xi) {
    if (!std::isfinite(delta) || !std::isfinite(xi.x) || !std::isfinite(xi.y))
        bad_input("approach and slide must be finite");
    State next = now_;
    next.step_lost = 0;
    const double touch = curve.first_touch();
    if (!next.begun) {
        next.begun = true;
        if (delta > touch) next.nodes = {{touch, 0, 0, {}}, node_at(curve, delta, {})};
    } else {
        const Slide from = next.xi;
        const double begin = next.delta, dd = delta - begin;
        // Slide at a point of the straight path.
        const auto slide_at = [&](double d) {
            return dd == 0 ? xi : from + ((d - begin) / dd) * (xi - from);
        };
        const auto part = [&](double d, Slide to) {
            const Slide dxi = to - next.xi;
            advance(curve, next, d, dxi);
            next.xi = to;
        };
        if (next.nodes.empty() && delta > touch) {  // contact begins on the path
            next.delta = touch;
            next.xi = begin < touch ? slide_at(touch) : from;
            next.nodes = {{touch, 0, 0, {}}};
        }
        // Unloading removes the pieces of memory above delta one by one. A step ends at each of
        // them, because the direction of slip changes there.
        while (next.nodes.size() > 2 && delta < next.nodes[next.nodes.size() - 2].approach) {
            const double d = next.nodes[next.nodes.size() - 2].approach;
            part(d, slide_at(d));
        }
        if (!next.nodes.empty()) {
            if (delta > touch)
                part(delta, xi);
            else {
                part(touch, slide_at(touch));
                next.nodes.clear();
            }
        }
    }
    next.delta = delta;
    next.xi = xi;
    next.lost += next.step_lost;
    now_ = std::move(next);
}

void FrictionHistory::move(LoadCurve& curve, double share) {
    State next = now_;
    const double touch = curve.first_touch(), delta = next.delta, before = tangential_energy();
    next.nodes.clear();
    if (delta > touch && now_.nodes.empty())
        next.nodes = {{touch, 0, 0, {}}, node_at(curve, delta, {})};
    if (delta > touch && !now_.nodes.empty()) {
        const double stretch = (delta - touch) / (delta - now_.nodes.front().approach);
        for (const auto k : indices(now_.nodes)) {
            const Node& node = now_.nodes[k];
            const Slide u = (share * stretch) * node.deflection;
            if (k == 0)
                next.nodes.push_back({touch, 0, 0, u});
            else
                next.nodes.push_back(node_at(curve, delta - stretch * (delta - node.approach), u));
        }
        next.nodes.back().approach = delta;
    }
    State old = std::exchange(now_, std::move(next));
    double after = tangential_energy();
    if (after > before) {
        const double less = std::sqrt(before / after);
        for (Node& node : now_.nodes) node.deflection = less * node.deflection;
        after = before;
    }
    now_.step_lost = before - after;
    now_.lost = old.lost + now_.step_lost;
}

// Advances along a straight path; delta is not below the node before the last.
void FrictionHistory::advance(LoadCurve& curve, State& state, double delta, Slide dxi) const {
    const double c = friction_.slide_per_approach();
    const double old_delta = state.delta, dd = delta - old_delta;
    std::vector<Node>& nodes = state.nodes;
    std::vector<Node> free = nodes;  // deflections without slip
    for (Node& node : free) node.deflection = node.deflection + dxi;
    state.delta = delta;
    if (dd > 0) {
        // New springs touch successively and follow the remaining slide: u = (delta - s) dxi/dd.
        const double rate = norm(dxi) / dd;
        Node top = node_at(curve, delta, {});
        if (rate <= c) {  // no slip, because the limits grow faster than the deflections
            const std::size_t n = free.size();
            const Slide fresh = (-1 / dd) * dxi;
            if (n > 1 && norm(slope(free[n - 2], free[n - 1]) - fresh) <= kSameSlope * c)
                free.pop_back();  // the last piece is extended
            free.push_back(top);
            nodes = std::move(free);
            return;
        }
        top.deflection = (1 - c / rate) * dxi;
        free.push_back(top);
    } else if (dd < 0) {
        const std::size_t n = free.size();
        const Slide u = between(free[n - 2], free[n - 1], delta);
        if (delta == free[n - 2].approach)
            free.pop_back();  // the piece is removed; its lower end is the new top
        else
            free.back() = node_at(curve, delta, u);
    }
    if (free.size() == 1)
        free.insert(free.begin(), free.front());  // no contact is left; adds an empty piece
    slip(curve, state, dd, dxi, old_delta, std::move(free));
}

namespace {

// Where a piece leaves the cone: the distance from its beginning, at which |u + p t| = L - c t,
// (p^2 - c^2) t^2 + 2 (p.u + c L) t + u^2 - L^2 = 0.
double way_inside(Slide u, Slide p, double c, double L, double h) {
    const double b = dot(p, u) + c * L;
    const Slide q = c * u + L * p;
    const double root = std::sqrt(std::max(0.0, dot(q, q) - cross(p, u) * cross(p, u)));
    const double deficit = (L - norm(u)) * (L + norm(u));
    double t = b + root > 0 ? std::min(h, deficit / (b + root)) : h;
    // Corrects cancellation in numerator and denominator.
    for (int polish = 0; polish < 2; ++polish) {
        const Slide w = u + t * p;
        const double rate = norm(w) > 0 ? dot(p, w) / norm(w) + c : 0.0;
        if (rate > 0) t = std::clamp(t - (norm(w) - (L - c * t)) / rate, 0.0, h);
    }
    return t;
}

// A step in which springs slip in `direction`, the one at the edge and all above it.
struct SlippingStep {
    double c, delta, old_delta, dd;
    double rate;  // of slip along the step
    Slide direction;

    double limit(double s) const { return c * (delta - s); }

    // Work dissipated by the springs of `free` (deflections without a limit) from the node `begin`
    // in piece `piece` on, over m: a spring slips by `over` at the rate along the step, while its
    // limit changes.
    double lost(const std::vector<Node>& free, std::size_t piece, Node begin) const {
        const double e = rate;
        double lost = 0;
        const auto over = [&](std::size_t k, double s) {
            return dot(direction, between(free[k], free[k + 1], s)) - limit(s);
        };
        for (std::size_t k = piece; k + 1 < free.size(); ++k) {
            const Node& end = free[k + 1];
            // Springs that touched during the step slip from the beginning.
            if (dd > 0 && begin.approach >= old_delta)
                lost += integral(
                    begin, end, [&](double s) { return 0.5 * e * limit(s) * limit(s) / (c * dd); });
            else
                lost += integral(begin, end, [&](double s) {
                    return over(k, s) * (limit(s) - 0.5 * c * dd * over(k, s) / e);
                });
            begin = end;
        }
        return lost;
    }
    // Springs released during the step slip until their limit is 0.
    double lost_by_released(const std::vector<Node>& before, const Node& top) const {
        const std::size_t k = before.size() - 2;
        return integral(top, before.back(), [&](double s) {
            const double still =
                (c * (old_delta - s) - dot(direction, between(before[k], before[k + 1], s))) / rate;
            const double limit_then = c * (old_delta - s + still * dd);
            return -0.5 * rate * limit_then * limit_then / (c * dd);
        });
    }
};

}  // namespace

// Limits the free deflections to the cone |u| <= c (delta - s). They change by at most c per unit
// of s. If one spring leaves the cone, so do all with a larger s: the springs s* < s <= delta slip.
void FrictionHistory::slip(LoadCurve& curve, State& state, double dd, Slide dxi, double old_delta,
                           std::vector<Node> free) const {
    const double c = friction_.slide_per_approach(), m = friction_.ratio;
    const double delta = state.delta, touch = free.front().approach;
    const auto limit = [&](double s) { return c * (delta - s); };
    const double slack = kRounding * limit(touch);
    const std::size_t n = free.size();
    std::size_t inside = 0;  // number of nodes within the cone
    while (inside < n && norm(free[inside].deflection) <= limit(free[inside].approach) + slack)
        ++inside;
    if (inside == n) {
        free.back().deflection = {};
        state.nodes = std::move(free);
        return;
    }
    const std::vector<Node> before = std::move(state.nodes);
    std::vector<Node> after(free.begin(), free.begin() + std::ptrdiff_t(inside));
    Slide direction;
    double edge = touch;
    if (inside == 0) {  // full slip
        const Slide u = free.front().deflection;
        direction = (1 / norm(u)) * u;
        Node bottom = free.front();
        bottom.deflection = limit(touch) * direction;
        after.push_back(bottom);
    } else {
        const Node &begin = free[inside - 1], &end = free[inside];
        const Slide u = begin.deflection, p = slope(begin, end);
        const double L = std::max(limit(begin.approach), norm(u));
        const double t = way_inside(u, p, c, L, end.approach - begin.approach);
        const double s = begin.approach + t;
        const Slide at = u + t * p;
        direction =
            norm(at) > 0 ? (1 / norm(at)) * at : (1 / norm(end.deflection)) * end.deflection;
        const Slide on_cone = limit(s) * direction;
        edge = std::min(s, delta);
        if (!(s > begin.approach))
            after.back().deflection = on_cone;
        else if (s < delta)
            after.push_back(node_at(curve, s, on_cone));
    }
    Node top = free.back();
    top.deflection = {};

    const double e = dot(direction, dxi) - c * dd;
    if (c > 0 && e > 0) {
        const SlippingStep step{c, delta, old_delta, dd, e, direction};
        double lost = 0;
        if (edge < delta)
            lost = step.lost(free, std::max<std::size_t>(inside, 1) - 1, after.back());
        if (dd < 0) lost += step.lost_by_released(before, top);
        state.step_lost += m * lost;
    }
    after.push_back(top);
    state.nodes = std::move(after);
}

Slide FrictionHistory::tangential_force() const {
    Slide sum;
    const auto& nodes = now_.nodes;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
        sum = sum - (nodes[k + 1].load - nodes[k].load) * slope(nodes[k], nodes[k + 1]);
    return friction_.ratio * sum;
}

double FrictionHistory::tangential_energy() const {
    double square = 0;
    const auto& nodes = now_.nodes;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        square += integral(nodes[k], nodes[k + 1], [&](double s) {
            const Slide u = between(nodes[k], nodes[k + 1], s);
            return dot(u, u);
        });
    }
    return 0.5 * friction_.ratio * square;
}

double FrictionHistory::stick_approach() const {
    const auto& nodes = now_.nodes;
    if (nodes.size() < 2) return now_.delta;
    const double c = friction_.slide_per_approach();
    const std::size_t n = nodes.size();
    return norm(slope(nodes[n - 2], nodes[n - 1])) >= c * (1 - 1e-12) ? nodes[n - 2].approach
                                                                      : now_.delta;
}

FrictionHistory::Tangent FrictionHistory::stiffness(LoadCurve& curve) const {
    const auto& nodes = now_.nodes;
    if (nodes.size() < 2) return {};
    const double m = friction_.ratio, c = friction_.slide_per_approach();
    const double edge = stick_approach();
    const double S = m * (edge > nodes.front().approach ? curve.stiffness(edge) : 0.0);
    Tangent tangent{S, 0, 0, S};
    const double L = c * (now_.delta - edge);
    if (!(L > 0)) return tangent;
    // The slipping part mu [N - N* - S* (delta - s*)] n rotates with the deflection of the spring
    // at its inner edge, n = u/|u|: dn = (I - n n') (dxi + p ds*)/L, c ds* = -n.(dxi + p ds*),
    // where p is the slope of u inside the edge.
    const std::size_t k = nodes.size() - 2;
    const Slide n = (1 / norm(nodes[k].deflection)) * nodes[k].deflection;
    const Slide p = k > 0 ? slope(nodes[k - 1], nodes[k]) : Slide{};
    const double slipping = friction_.coefficient * (nodes[k + 1].load - nodes[k].load) - S * L;
    const double turn = slipping / L,
                 ahead = k > 0 && c + dot(n, p) > 0 ? 1 / (c + dot(n, p)) : 0.0;
    const Slide across = p - dot(n, p) * n;
    tangent.xx += turn * (1 - n.x * n.x - ahead * across.x * n.x);
    tangent.xy += turn * (-n.x * n.y - ahead * across.x * n.y);
    tangent.yx += turn * (-n.y * n.x - ahead * across.y * n.x);
    tangent.yy += turn * (1 - n.y * n.y - ahead * across.y * n.y);
    return tangent;
}

// --- First loading and cycles ---

namespace {

void require_contact(const LoadCurve& curve, double delta) {
    if (!std::isfinite(delta)) bad_input("the approach must be finite");
    if (!(delta > curve.first_touch())) bad_input("there is no contact yet");
}

}  // namespace

double full_slip(const LoadCurve& curve, const Friction& friction, double delta) {
    return friction.slide_per_approach() * std::max(0.0, delta - curve.first_touch());
}

std::vector<SlidePoint> slide_to(LoadCurve& curve, const Friction& friction, double delta,
                                 const std::vector<double>& xi) {
    require_friction(friction);
    require_contact(curve, delta);
    for (double x : xi)
        if (!(x >= 0) || std::isinf(x))
            bad_input("slides of first loading must be finite and not negative");
    const double N = curve.load(delta).force, touch = curve.first_touch(),
                 c = friction.slide_per_approach();
    std::vector<SlidePoint> points;
    points.reserve(xi.size());
    for (double x : xi) {
        const double stick = c > 0 ? std::max(touch, delta - x / c) : x > 0 ? touch : delta;
        const double inner = stick < delta ? (stick > touch ? curve.load(stick).force : 0.0) : N;
        points.push_back({stick, x, friction.coefficient * (N - inner)});
    }
    return points;
}

SlidePoint slide_at_force(LoadCurve& curve, const Friction& friction, double delta, double Q) {
    require_friction(friction);
    require_contact(curve, delta);
    const double N = curve.load(delta).force;
    if (!(Q >= 0) || Q > friction.coefficient * N)
        bad_input("the tangential force must be from 0 to mu N = ", friction.coefficient * N);
    const double inner = Q > 0 ? N - Q / friction.coefficient : N;
    const double stick = Q == 0      ? delta
                         : inner > 0 ? std::min(delta, curve.approach(inner))
                                     : curve.first_touch();
    return {stick, friction.slide_per_approach() * (delta - stick), Q};
}

SlideCycle slide_cycle(LoadCurve& curve, const Friction& friction, double delta, double amplitude,
                       const SlideCycles& in) {
    require_friction(friction);
    require_contact(curve, delta);
    const double mu = friction.coefficient, depth = delta - curve.first_touch(),
                 full = full_slip(curve, friction, delta);
    const auto whole = curve.load(delta);
    // The load of the springs that slip after a slide by this share of full slip.
    const auto inner = [&](double share) {
        return share < 1 ? curve.load(delta - share * depth) : LoadCurve::Load{};
    };
    const auto drop = [&](double share) {
        return share > 0 ? whole.force - inner(share).force : 0.0;
    };
    SlideCycle cycle;
    const auto put = [&](double xi, double Q) {
        cycle.displacement.push_back(xi);
        cycle.force.push_back(Q);
    };
    for (int k = 0; k <= in.steps; ++k) {
        const double share = double(k) / in.steps;
        put(full * share, mu * drop(share));
    }
    const double reach = full > 0 ? amplitude / full : kInfinity, Q_A = mu * drop(reach);
    std::vector<double> back;  // Q on the way from +amplitude to -amplitude
    for (int k = 0; k <= in.steps; ++k)
        back.push_back(Q_A - 2 * mu * drop(reach * double(k) / in.steps));
    put(amplitude, Q_A);
    for (int half = 0; half < 2 * in.cycles; ++half)
        for (int k = 1; k <= in.steps; ++k) {
            const double xi = amplitude * (1 - 2.0 * k / in.steps);
            put(half % 2 == 0 ? xi : -xi, half % 2 == 0 ? back[at(k)] : -back[at(k)]);
        }
    const double slipped = std::min(reach, 1.0) * depth;
    const auto stuck = inner(reach);
    cycle.work = 4 * mu * friction.slide_per_approach() *
                     ((whole.force + stuck.force) * slipped - 2 * (whole.energy - stuck.energy)) +
                 4 * mu * whole.force * std::max(amplitude - full, 0.0);
    return cycle;
}

}  // namespace rsc
