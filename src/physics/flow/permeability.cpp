#include "physics/flow/permeability.hpp"

#include "base/error.hpp"
#include "physics/flow/dissection.hpp"

#ifdef RSC_CHOLMOD
#include <cholmod.h>

// OpenBLAS's, whose sums depend on its number of threads, and OpenMP's, which only CHOLMOD uses.
extern "C" int openblas_get_num_threads() __attribute__((weak));
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
extern "C" int omp_get_max_active_levels() __attribute__((weak));
extern "C" void omp_set_max_active_levels(int) __attribute__((weak));
#endif

namespace rsc {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Bytes of an open gap of n points, n (kBytes + kLog log2 n): from the peaks of parallel gaps of
// 256^2, 512^2 and 1024^2 points (768, 788 and 819 bytes a point); contact leaves less.
constexpr double kBytes = 560, kLog = 13.5;

}  // namespace

double permeability_bytes(double points) {
    return points * (kBytes + kLog * std::log2(std::max(points, 2.0)));
}

double permeability_points(double bytes) {
    double low = 0, high = 1e12;
    for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (low + high);
        (permeability_bytes(middle) > bytes ? high : low) = middle;
    }
    return low;
}

#ifndef RSC_CHOLMOD

bool has_permeability() { return false; }

GapFlow permeability(const GapMap&, std::vector<double>*) {
    throw Error(Failure::internal, "rsc was built without CHOLMOD: there is no permeability");
}

#else

bool has_permeability() { return true; }

namespace {

// The cubes of the gap relative to the largest, and what follows from them.
class Conductances {
public:
    explicit Conductances(const GapMap& map) : map_(map), cube_(map.points()) {
        double widest = 0;
        for (const double g : map.gap) widest = std::max(widest, g);
        for (const auto k : indices(cube_)) {
            const double g = widest > 0 ? map.gap[k] / widest : 0;
            cube_[k] = g * g * g;
        }
        unit_ = widest * widest * widest / 12;
        least_ = 0;
    }
    double unit() const { return unit_; }
    void leave_out_below(double least) { least_ = least; }

    // Harmonic mean of two neighbours' cubes; 0: not linked.
    double mean(std::size_t k, std::size_t l) const {
        const double a = cube_[k], b = cube_[l];
        if (!(a > 0 && b > 0)) return 0;
        const double both = 2 * a * b / (a + b);
        return both > least_ ? both : 0;
    }
    double x(std::size_t k) const { return mean(k, map_.right_of(k)) * map_.dy / map_.dx; }
    double y(std::size_t k) const { return mean(k, map_.above(k)) * map_.dx / map_.dy; }

private:
    const GapMap& map_;
    std::vector<double> cube_;
    double unit_, least_;
};

// The neighbours of a point: right, above, left, below.
std::array<std::size_t, 4> around(const GapMap& map, std::size_t k) {
    const auto nx = at(map.nx);
    const std::size_t left = k % nx == 0 ? k + nx - 1 : k - 1;
    const std::size_t below = k >= nx ? k - nx : k + map.points() - nx;
    return {map.right_of(k), map.above(k), left, below};
}

// Points that may carry fluid: in sets that wind around the cell, and not in their dead ends, which
// hang on a single link.
std::vector<std::uint8_t> carrying(const GapMap& map, const Conductances& conductance,
                                   Openings& openings) {
    std::vector<std::uint8_t> used(map.points(), 0);
    for (const auto k : indices(used)) used[k] = openings.winds(k);
    const auto linked = [&](std::size_t k, std::size_t l) {
        return used[l] && conductance.mean(k, l) > 0;
    };
    for (const auto begin : indices(used)) {
        std::size_t k = begin;
        while (used[k]) {
            std::size_t links = 0, next = k;
            for (const std::size_t l : around(map, k))
                if (linked(k, l)) {
                    ++links;
                    next = l;
                }
            if (links > 1) break;
            used[k] = 0;
            k = next;
        }
    }
    return used;
}

// While one exists OpenBLAS has one thread, so that results do not depend on their number, and this
// thread's loops of CHOLMOD are not shared among threads: they are so short that four take a
// quarter longer than one.
class OneThread {
public:
    OneThread() {
        const std::lock_guard lock(mutex_);
        if (users_++ == 0 && openblas_get_num_threads && openblas_set_num_threads) {
            blas_threads_ = openblas_get_num_threads();
            openblas_set_num_threads(1);
        }
        if (!omp_get_max_active_levels || !omp_set_max_active_levels) return;
        levels_ = omp_get_max_active_levels();
        omp_set_max_active_levels(0);
    }
    ~OneThread() {
        const std::lock_guard lock(mutex_);
        if (levels_) omp_set_max_active_levels(*levels_);
        if (--users_ == 0 && blas_threads_ > 0) openblas_set_num_threads(blas_threads_);
    }
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;

private:
    inline static std::mutex mutex_;
    inline static int users_ = 0, blas_threads_ = 0;
    std::optional<int> levels_;
};

// CHOLMOD's settings and memory.
struct Cholmod {
    Cholmod() {
        cholmod_l_start(&common);
        common.print = 0;
        common.nmethods = 1;  // the matrix has the order of dissection()
        common.method[0].ordering = CHOLMOD_NATURAL;
        common.supernodal = CHOLMOD_SUPERNODAL;
        common.try_catch = 1;
    }
    ~Cholmod() {
        cholmod_l_free_factor(&factor, &common);
        cholmod_l_free_sparse(&matrix, &common);
        cholmod_l_finish(&common);
    }
    Cholmod(const Cholmod&) = delete;
    Cholmod& operator=(const Cholmod&) = delete;
    void require_memory() const {
        if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
            throw Error(Failure::no_memory, "out of memory for the permeability of the gap");
    }
    OneThread one_thread;
    cholmod_common common{};
    cholmod_sparse* matrix = nullptr;
    cholmod_factor* factor = nullptr;
};

using Pressures = std::array<std::vector<double>, 2>;

// Equations of the pressures for mean gradients 1/dx along x and 1/dy along y: at each point sum c
// (p_l - p_k + step) = 0 over its links, where step is +-1 on links along the gradient.
class FlowEquations {
public:
    FlowEquations(const GapMap& map, const Conductances& conductance, Openings& openings)
        : map_(map),
          conductance_(conductance),
          used_(carrying(map, conductance, openings)),
          order_(dissection(map.nx, map.ny, used_)),
          place_(map.points(), kNone),
          winds_(map.points(), 0) {
        for (const auto p : indices(order_)) place_[order_[p]] = std::uint32_t(p);
        for (const std::uint32_t k : order_)
            winds_[k] = std::uint8_t((openings.winds_x(k) ? 1 : 0) | (openings.winds_y(k) ? 2 : 0));
        assemble(openings);
    }

    bool factorize() {
        cholmod_common& common = cholmod_.common;
        cholmod_.factor = cholmod_l_analyze(cholmod_.matrix, &common);
        cholmod_.require_memory();
        if (!cholmod_.factor) return false;
        cholmod_l_factorize(cholmod_.matrix, cholmod_.factor, &common);
        cholmod_.require_memory();
        return common.status == CHOLMOD_OK;
    }

    // Pressures at all points for the gradient along x and along y, 0 at points without; none if
    // rounding in the elimination spoils them. Each round solves for the error that is left, whose
    // dissipation is by how much that of the flow, and with it K, is too large.
    std::optional<Pressures> solve() {
        constexpr int kRounds = 4;
        constexpr double kError = 1e-11;
        Pressures p{std::vector<double>(map_.points(), 0.0),
                    std::vector<double>(map_.points(), 0.0)};
        for (const int round : indices(kRounds)) {
            const std::array<double, 2> error = improve(p);
            const Permeability K = dissipation(p);
            if (round > 0 && error[0] <= kError * K.xx && error[1] <= kError * K.yy) return p;
        }
        return {};
    }

    // Of the flow for each gradient, and of both together.
    Permeability dissipation(const Pressures& p) const {
        Permeability sum;
        for (std::size_t k = 0; k < map_.points(); ++k) {
            if (!used_[k]) continue;
            for (const bool along_x : {true, false}) {
                const std::size_t l = along_x ? map_.right_of(k) : map_.above(k);
                const double c = link(k, l, along_x);
                const double x = drop(p[0], 0, k, l, along_x), y = drop(p[1], 1, k, l, along_x);
                sum.xx += c * x * x;
                sum.yy += c * y * y;
                sum.xy += c * x * y;
            }
        }
        return sum;
    }

    ShearFlow shear(const Pressures& p) const {
        ShearFlow sum;
        for (std::size_t k = 0; k < map_.points(); ++k) {
            if (!used_[k]) continue;
            for (const bool along_x : {true, false}) {
                const std::size_t l = along_x ? map_.right_of(k) : map_.above(k);
                if (!(link(k, l, along_x) > 0)) continue;
                const double half = (map_.gap[k] + map_.gap[l]) / 4;
                (along_x ? sum.xx : sum.xy) += half * drop(p[0], 0, k, l, along_x);
                (along_x ? sum.yx : sum.yy) += half * drop(p[1], 1, k, l, along_x);
            }
        }
        // A gradient is in units of 1/dx along x, of 1/dy along y.
        const double points = double(map_.points()), stretch = map_.dx / map_.dy;
        return {sum.xx / points, sum.xy * stretch / points, sum.yx / stretch / points,
                sum.yy / points};
    }

    // Difference of the pressures of neighbours for the gradient along `axis`, which sets of points
    // that do not wind along it balance completely.
    double drop(const std::vector<double>& p, int axis, std::size_t k, std::size_t l,
                bool along_x) const {
        const bool step = along_x == (axis == 0) && (winds_[k] & (axis == 0 ? 1 : 2)) != 0;
        return (step ? 1 : 0) + p[l] - p[k];
    }

    // Conductance of the link from a carrying point k to l, to the right or above; 0 without link.
    double link(std::size_t k, std::size_t l, bool along_x) const {
        if (!used_[k] || !used_[l]) return 0;
        return along_x ? conductance_.x(k) : conductance_.y(k);
    }

private:
    // Adds to the pressures the solution for their residual. Returns its dissipation.
    std::array<double, 2> improve(Pressures& p) {
        cholmod_common& common = cholmod_.common;
        const std::size_t n = order_.size();
        cholmod_dense* right = cholmod_l_zeros(n, 2, CHOLMOD_REAL, &common);
        cholmod_.require_memory();
        auto* r = static_cast<double*>(right->x);
        for (const auto place : indices(n)) {
            const std::size_t k = order_[place];
            for (const bool along_x : {true, false}) {
                const std::size_t l = along_x ? map_.right_of(k) : map_.above(k);
                const double c = link(k, l, along_x);
                if (!(c > 0)) continue;
                for (const auto d : indices(2)) {
                    const double flux = c * drop(p[d], int(d), k, l, along_x);
                    r[place + d * n] += flux;
                    r[place_[l] + d * n] -= flux;
                }
            }
        }
        cholmod_dense* solution = cholmod_l_solve(CHOLMOD_A, cholmod_.factor, right, &common);
        std::array<double, 2> error{};
        for (std::size_t d = 0; d < 2 && solution; ++d)
            for (const auto place : indices(n)) {
                const double e = static_cast<const double*>(solution->x)[place + d * n];
                p[d][order_[place]] += e;
                error[d] += e * r[place + d * n];
            }
        cholmod_l_free_dense(&solution, &common);
        cholmod_l_free_dense(&right, &common);
        cholmod_.require_memory();
        return error;
    }

    struct Tie {
        SuiteSparse_long entry = 0;
        double diagonal = 0;
    };
    // Lower triangle by columns. The widest point of each set is tied to 0: its equation gets its
    // diagonal a second time, and as the right sides of a set add up to 0 its pressure is 0.
    void assemble(Openings& openings) {
        const std::size_t n = order_.size();
        cholmod_common& common = cholmod_.common;
        cholmod_.matrix =
            cholmod_l_allocate_sparse(n, n, 3 * n + 1, 1, 1, -1, CHOLMOD_REAL, &common);
        cholmod_.require_memory();
        auto* start = static_cast<SuiteSparse_long*>(cholmod_.matrix->p);
        auto* row = static_cast<SuiteSparse_long*>(cholmod_.matrix->i);
        auto* value = static_cast<double*>(cholmod_.matrix->x);
        std::map<std::size_t, Tie> ties;  // of each set
        SuiteSparse_long at = 0;
        for (const auto p : indices(n)) {
            start[p] = at;
            const std::size_t k = order_[p];
            const auto near = around(map_, k);
            const double c[4] = {link(k, near[0], true), link(k, near[1], false),
                                 link(near[2], k, true), link(near[3], k, false)};
            const double diagonal = c[0] + c[1] + c[2] + c[3];
            const SuiteSparse_long own = at++;
            row[own] = static_cast<SuiteSparse_long>(p);
            value[own] = diagonal;
            Tie& tie = ties[openings.root(k)];
            if (diagonal > tie.diagonal) tie = {own, diagonal};
            for (const auto side : indices(4)) add_link(p, place_[near[side]], c[side], own, at);
        }
        start[n] = at;
        for (const auto& [root, tie] : ties) value[tie.entry] += tie.diagonal;
        cholmod_l_sort(cholmod_.matrix, &common);
        cholmod_.require_memory();
    }
    // A cell of one or two points along an axis links a point with itself, which adds nothing, or
    // twice with another.
    void add_link(std::size_t p, std::uint32_t q, double c, SuiteSparse_long own,
                  SuiteSparse_long& at) {
        auto* row = static_cast<SuiteSparse_long*>(cholmod_.matrix->i);
        auto* value = static_cast<double*>(cholmod_.matrix->x);
        if (!(c > 0)) return;
        if (q == p) {
            value[own] -= c;
            return;
        }
        if (q < p) return;
        for (SuiteSparse_long e = own + 1; e < at; ++e)
            if (row[e] == static_cast<SuiteSparse_long>(q)) {
                value[e] -= c;
                return;
            }
        row[at] = static_cast<SuiteSparse_long>(q);
        value[at++] = -c;
    }

    const GapMap& map_;
    const Conductances& conductance_;
    std::vector<std::uint8_t> used_;
    std::vector<std::uint32_t> order_, place_;
    std::vector<std::uint8_t> winds_;  // 1 along x, 2 along y
    Cholmod cholmod_;
};

// Means of the fluxes to the left and the right, and up and down, at each point.
std::vector<double> flux_of(const GapMap& map, const FlowEquations& equations,
                            const std::vector<double>& p, double unit) {
    std::vector<double> x(map.points(), 0.0), y(map.points(), 0.0);
    for (std::size_t k = 0; k < map.points(); ++k) {
        const std::size_t right = map.right_of(k), above = map.above(k);
        const double to_right =
                         equations.link(k, right, true) * equations.drop(p, 0, k, right, true) / 2,
                     up = equations.link(k, above, false) * equations.drop(p, 0, k, above, false) /
                          2;
        x[k] += to_right;
        x[right] += to_right;
        y[k] += up;
        y[above] += up;
    }
    for (const auto k : indices(x))  // the pressure is in units of dx times the gradient
        x[k] = unit * std::hypot(x[k] * map.dx / map.dy, y[k]);
    return x;
}

}  // namespace

GapFlow permeability(const GapMap& map, std::vector<double>* flow) {
    if (flow) flow->assign(map.points(), 0.0);
    Conductances conductance(map);
    // Rounding makes the elimination fail where a link is 1e-16 of those beside it or less: then
    // the narrowest links are left out, which add less than that to K, and as few as it takes.
    for (double least = 0; least<1e-9; least = least> 0 ? 10 * least : 1e-16) {
        conductance.leave_out_below(least);
        Openings openings(map,
                          [&](std::size_t k, std::size_t l) { return conductance.mean(k, l) > 0; });
        if (!openings.any_winds_x() && !openings.any_winds_y()) return {};
        FlowEquations equations(map, conductance, openings);
        if (!equations.factorize()) continue;
        const std::optional<Pressures> pressures = equations.solve();
        if (!pressures) continue;
        if (flow) *flow = flux_of(map, equations, (*pressures)[0], conductance.unit());
        const double unit = conductance.unit() / double(map.points());
        const double stretch = map.dx / map.dy;
        const Permeability k = equations.dissipation(*pressures);
        return {{unit * stretch * k.xx, unit * k.yy / stretch, unit * k.xy},
                equations.shear(*pressures)};
    }
    throw Error(Failure::internal, "the equations of the flow through the gap are not solved");
}

#endif

}  // namespace rsc
