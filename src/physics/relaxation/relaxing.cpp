#include "physics/relaxation/relaxing.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

class Relaxing final : public RelaxingLaw {
public:
    Relaxing(std::unique_ptr<Law> elastic, std::size_t asperities, const Creep& creep)
        : elastic_(std::move(elastic)),
          creep_(creep),
          passage_(creep_, 0),
          place_(asperities, -1) {}

    LawCapabilities capabilities() const override { return {.convex = true}; }
    const LawMemory* memory() const override { return this; }
    bool yields(int, double) const override { return false; }
    double steepest(int asperity, double high) const override {
        return response(asperity, high).slope;
    }
    void prepare(std::span<const int> asperities) override { elastic_->prepare(asperities); }

    void step(double dt) override {
        passage_ = Passage(creep_, dt);
        for (Summit& s : summits_) let_go(s);
    }
    double modulus() const override { return passage_.modulus; }
    const std::vector<int>& touched() const override { return touched_; }
    std::vector<double> rests() const override {
        return of_summits([](const Summit& s) {
            double sum = 0;
            for (std::size_t j = 0; j + 1 < s.nodes.size(); ++j)
                sum += (1 - s.nodes[j].spacing) * (s.nodes[j + 1].F - s.nodes[j].F);
            return sum;
        });
    }
    std::vector<double> forces() const override {
        return of_summits([&](const Summit& s) {
            return over_springs(
                s, [&](std::size_t j) { return held_by(s.nodes[j]); },
                [](std::size_t) { return 1.0; });
        });
    }
    // With the transform e(s) of the relaxation function, y = v e(s)/(s + lambda) w. e has a zero
    // at -lambda and the poles -1/tau_l, so that y = v sum_l g_l (w - d_l)/(1/tau_l - lambda).
    std::vector<std::vector<double>> retarded() const override {
        std::vector<std::vector<double>> all;
        for (const auto& [lambda, flow] : creep_.retardations())
            all.push_back(of_summits([&, lambda = lambda, flow = flow](const Summit& s) {
                const auto y = [&](std::size_t j) {
                    double sum = 0;
                    for (const auto l : indices(creep_.branches()))
                        sum += creep_.branches()[l].share * (s.nodes[j].w - s.nodes[j].d[l]) /
                               (creep_.branches()[l].rate - lambda);
                    return flow * sum;
                };
                return over_springs(s, y, [](std::size_t) { return 1.0; });
            }));
        return all;
    }

    std::vector<double> widest() const override {
        return of_summits(
            [&](const Summit& s) { return elastic_->area(s.asperity, s.nodes.back().s); });
    }

    void respond(int n, const int* asperity, const double* u, double* force, double* slope,
                 double* work) const override {
        std::vector<double> edge(at(n));
        for (const int k : indices(n)) edge[at(k)] = edge_of(asperity[k], u[k]);
        elastic_->respond(n, asperity, edge.data(), force, slope, work);
        for (const int k : indices(n)) {
            if (const Summit* s = summit(asperity[k])) {
                const Node& a = s->nodes[node_below(*s, u[k])];
                if (!(u[k] > s->nodes[0].release)) {
                    force[k] = slope[k] = work[k] = 0;
                    continue;
                }
                const double c = a.spacing, du = u[k] - a.release;
                work[k] = a.work_below + (a.force_below - c * a.F) * du + c * c * (work[k] - a.W);
                force[k] = a.force_below + c * (force[k] - a.F);
            }
        }
    }
    Footprint footprint(int asperity, double u) const override {
        return elastic_->footprint(asperity, edge_of(asperity, u));
    }
    double residual_depth(int asperity) const override {
        const Summit* s = summit(asperity);
        return s ? s->nodes[0].release : 0.0;
    }

    void commit(int n, const int* asperity, const double* u) override {
        std::vector<double> reached(summits_.size(), -kInfinity);
        for (const int k : indices(n)) {
            int& place = place_[at(asperity[k])];
            if (place < 0 && !(u[k] > 0)) continue;
            if (place < 0) {
                place = int(summits_.size());
                Summit s;
                s.asperity = asperity[k];
                s.nodes.push_back(
                    node(s.asperity, 0, 0, std::vector<double>(creep_.branches().size(), 0.0)));
                let_go(s);
                summits_.push_back(std::move(s));
                touched_.push_back(asperity[k]);
                reached.push_back(-kInfinity);
            }
            reached[at(place)] = u[k];
        }
        for (const auto i : indices(summits_)) advance(summits_[i], reached[i]);
        step(0);
    }

    double stored() const override { return total(&Summit::stored); }
    double lost() const override { return total(&Summit::lost); }
    void forget() override {
        summits_.clear();
        touched_.clear();
        std::ranges::fill(place_, -1);
    }

    // For each summit: asperity, number of nodes, dissipated work, and for each node s, w and d.
    void write(std::vector<double>& numbers) const override {
        for (const Summit& s : summits_) {
            append(numbers, {double(s.asperity), double(s.nodes.size()), s.lost});
            for (const Node& node : s.nodes) {
                append(numbers, {node.s, node.w});
                append(numbers, node.d);
            }
        }
    }
    void read(std::span<const double> numbers) override {
        forget();
        const std::size_t terms = creep_.branches().size();
        const auto wrong = [] { bad_input("the state does not belong to these asperities"); };
        for (std::size_t next = 0; next < numbers.size();) {
            if (numbers.size() - next < 3) wrong();
            const double index = numbers[next], count = numbers[next + 1];
            if (!(index >= 0 && index < double(place_.size()) && count >= 1) ||
                !(count <= double((numbers.size() - next - 3) / (2 + terms))))
                wrong();
            Summit s;
            s.asperity = int(index);
            s.lost = numbers[next + 2];
            next += 3;
            elastic_->prepare(std::span<const int>(&s.asperity, 1));
            for (std::size_t k = 0; k < at(count); ++k, next += 2 + terms) {
                const double* from = numbers.data() + next;
                if (!std::all_of(from, from + 2 + terms,
                                 [](double v) { return std::isfinite(v); }) ||
                    (k > 0 && !(from[0] > s.nodes.back().s)))
                    wrong();
                s.nodes.push_back(node(s.asperity, from[0], from[1], {from + 2, from + 2 + terms}));
            }
            if (place_[at(s.asperity)] >= 0) wrong();
            place_[at(s.asperity)] = int(summits_.size());
            s.stored = stored_in(s);
            touched_.push_back(s.asperity);
            summits_.push_back(std::move(s));
        }
        step(0);
    }

private:
    // A former edge of the contact: the spring s, its state, and force and work of the elastic law
    // at s.
    struct Node {
        double s = 0, w = 0;
        std::vector<double> d;
        double F = 0, W = 0;
        // For the current step: penetration at which it is released; difference to that of the next
        // node over the difference in s (1 after the last); force and work of the springs below
        // when the edge is here.
        double release = 0, spacing = 1, force_below = 0, work_below = 0;
    };
    // The last node has w = d = 0, because springs beyond it were never touched.
    struct Summit {
        int asperity = 0;
        std::vector<Node> nodes;
        double stored = 0, lost = 0;
    };

    const Summit* summit(int asperity) const {
        const int place = place_[at(asperity)];
        return place < 0 ? nullptr : &summits_[at(place)];
    }
    Node node(int asperity, double s, double w, std::vector<double> d) const {
        const Response elastic = elastic_->response(asperity, s);
        return {s, w, std::move(d), elastic.force, elastic.work};
    }
    static std::size_t node_below(const Summit& s, double u) {
        const auto above = std::ranges::upper_bound(s.nodes, u, {}, &Node::release);
        return above == s.nodes.begin() ? 0 : at(above - s.nodes.begin()) - 1;
    }
    double edge_of(int asperity, double u) const {
        const Summit* s = summit(asperity);
        return s ? edge(*s, u) : u;
    }
    static double edge(const Summit& s, double u) {
        if (!(u > s.nodes[0].release)) return 0;
        const Node& below = s.nodes[node_below(s, u)];
        return below.s + (u - below.release) / below.spacing;
    }

    // Force of a spring divided by its stiffness.
    double held_by(const Node& node) const {
        double q = creep_.last() * node.w;
        for (const auto k : indices(node.d)) q += creep_.branches()[k].share * node.d[k];
        return q;
    }

    // Computes the penetrations at which the nodes are released at the end of the step: the
    // remaining force of a spring held at w, divided by the modulus of the step, is the distance by
    // which it can retreat.
    void let_go(Summit& s) const {
        double highest = 0;
        for (Node& node : s.nodes) {
            double left = creep_.last() * node.w;
            for (const auto k : indices(node.d))
                left += creep_.branches()[k].share * passage_.decays[k].stay * node.d[k];
            highest = node.release = std::max(node.s + node.w - left / passage_.modulus, highest);
        }
        for (std::size_t j = 0; j + 1 < s.nodes.size(); ++j) {
            Node &a = s.nodes[j], &b = s.nodes[j + 1];
            const double du = b.release - a.release, ds = b.s - a.s;
            a.spacing = du / ds;
            b.force_below = a.force_below + a.spacing * (b.F - a.F);
            b.work_below = a.work_below + (a.force_below - a.spacing * a.F) * du +
                           a.spacing * a.spacing * (b.W - a.W);
        }
    }

    // Advances the springs to the end of the step at the penetration u.
    void advance(Summit& s, double u) const {
        if (u > s.nodes[0].release) add_edge(s, u);
        const std::size_t n = s.nodes.size(), terms = creep_.branches().size();
        std::vector<double> change(n), mean(n, 0.0);  // change of w; mean force over the step
        for (const auto j : indices(n)) {
            Node& node = s.nodes[j];
            const double w = j + 1 < n ? std::max(u, node.release) - node.s : 0.0;
            change[j] = w - node.w;
            mean[j] = 0.5 * creep_.last() * (w + node.w);
            constexpr double rounding = 1e-9;
            const bool free =
                !(u > node.release) &&
                held_by(node) <= rounding * std::abs(node.w);  // it creeps back freely without work
            for (const auto k : indices(terms)) {
                const Passage::Decay& decay = passage_.decays[k];
                mean[j] += creep_.branches()[k].share *
                           (decay.change * node.d[k] + decay.mean * change[j]);
                node.d[k] = decay.stay * node.d[k] + decay.change * change[j];
            }
            node.w = w;
            if (free) mean[j] = 0;
        }
        const double before = s.stored;
        s.stored = stored_in(s);
        s.lost += over_springs(
                      s, [&](std::size_t j) { return change[j]; },
                      [&](std::size_t j) { return mean[j]; }) -
                  (s.stored - before);
    }

    // Adds a node at the edge of the contact at u.
    void add_edge(Summit& s, double u) const {
        const std::size_t j = node_below(s, u);
        const double place = edge(s, u);
        constexpr double same = 1e-9;  // relative to the distance between two nodes
        const double from = s.nodes[j].s;
        if (j + 1 == s.nodes.size()) {
            if (!(place > from * (1 + same))) return;
            Node added =
                node(s.asperity, place, 0, std::vector<double>(creep_.branches().size(), 0.0));
            added.release = u;
            s.nodes.push_back(std::move(added));
            return;
        }
        const double share = (place - from) / (s.nodes[j + 1].s - from);
        if (!(share > same && share < 1 - same)) return;
        const Node &a = s.nodes[j], &b = s.nodes[j + 1];
        std::vector<double> d(a.d.size());
        for (const auto k : indices(d)) d[k] = a.d[k] + share * (b.d[k] - a.d[k]);
        Node added = node(s.asperity, place, a.w + share * (b.w - a.w), std::move(d));
        added.release = u;
        s.nodes.insert(s.nodes.begin() + std::ptrdiff_t(j) + 1, std::move(added));
    }

    // Integral of S'(s) a b ds for two functions given at the nodes, by parts, since S(0) = 0 and a
    // b = 0 at the last node.
    template <class A, class B>
    static double over_springs(const Summit& s, A&& a, B&& b) {
        double sum = 0;
        for (std::size_t j = 0; j + 1 < s.nodes.size(); ++j) {
            const Node &low = s.nodes[j], &high = s.nodes[j + 1];
            const double ds = high.s - low.s, da = (a(j + 1) - a(j)) / ds,
                         db = (b(j + 1) - b(j)) / ds;
            sum -= (da * b(j) + db * a(j)) * (high.F - low.F) +
                   2 * da * db * (ds * high.F - (high.W - low.W));
        }
        return sum;
    }
    double stored_in(const Summit& s) const {
        const auto w = [&](std::size_t j) { return s.nodes[j].w; };
        double sum = creep_.last() * over_springs(s, w, w);
        for (const auto k : indices(creep_.branches())) {
            const auto d = [&](std::size_t j) { return s.nodes[j].d[k]; };
            sum += creep_.branches()[k].share * over_springs(s, d, d);
        }
        return 0.5 * sum;
    }
    template <class F>
    std::vector<double> of_summits(F&& f) const {
        std::vector<double> values;
        for (const Summit& s : summits_) values.push_back(f(s));
        return values;
    }
    double total(double Summit::*member) const {
        double sum = 0;
        for (const Summit& s : summits_) sum += s.*member;
        return sum;
    }

    std::unique_ptr<Law> elastic_;
    Creep creep_;
    Passage passage_;
    std::vector<int> place_;  // index of an asperity in summits_ and touched_; -1: never touched
    std::vector<int> touched_;
    std::vector<Summit> summits_;
};

}  // namespace

std::unique_ptr<RelaxingLaw> make_relaxing(std::unique_ptr<Law> elastic, std::size_t asperities,
                                           const Creep& creep) {
    if (!elastic->capabilities().convex)
        bad_input("solids%relaxation_share: not available with this asperities%law");
    return std::make_unique<Relaxing>(std::move(elastic), asperities, creep);
}

}  // namespace rsc
