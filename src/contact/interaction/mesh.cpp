#include "contact/interaction/mesh.hpp"

#include "contact/interaction/mesh_far.hpp"
#include "contact/interaction/pair_sums.hpp"
#include "error.hpp"
#include "format.hpp"
#include "rough/parallel.hpp"

namespace rsc {

namespace {

constexpr std::size_t kDirect = 256;        // fewer points are summed directly
constexpr std::size_t kDirectLattice = 32;  // for periodic kernels
constexpr std::size_t kThreads = 5000;      // fewer points use one thread
constexpr int kStrips = 16;                 // or rows of the mesh processed by a thread at a time

// Measured times on one core in seconds, used only to balance the work of mesh and near field.
constexpr double kSecondsPerNearPair = 2.3e-9;
constexpr double kSecondsPerMeshPoint = 11e-9;
double seconds_per_point(const MeshDesign& design) { return 20e-9 + 0.9e-9 * design.width * ((design.width + 3) / 4 * 4); }

// Largest memory of far fields stored for later points.
constexpr std::size_t kKeptBytes = std::size_t{100} << 20;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Largest doubled mesh, at 16 bytes per point or less; otherwise the near field becomes larger.
constexpr double kMeshPointsAtMost = 5e7;

// Estimated number of directed pairs within a distance, from counts of points in square cells of doubling sizes.
class PairEstimate {
public:
    PairEstimate(std::size_t n, const double* x, const double* y, double x0, double y0, double length_x, double length_y) {
        // The finest cells contain a few points each for a uniform distribution.
        size_ = std::max({std::sqrt(length_x * length_y * 2 / static_cast<double>(n)), length_x * 2 / static_cast<double>(n)});
        std::size_t nx = static_cast<std::size_t>(length_x / size_) + 1, ny = static_cast<std::size_t>(length_y / size_) + 1;
        std::vector<double> count(nx * ny, 0.0);
        for (std::size_t i = 0; i < n; ++i)
            count[static_cast<std::size_t>((y[i] - y0) / size_) * nx + static_cast<std::size_t>((x[i] - x0) / size_)] += 1;
        for (;;) {
            double pairs = 0;
            for (double c : count) pairs += c * c;
            pairs_.push_back(pairs - static_cast<double>(n));  // without pairs of a point with itself
            if (nx == 1 && ny == 1) break;
            const std::size_t mx = (nx + 1) / 2, my = (ny + 1) / 2;
            std::vector<double> coarse(mx * my, 0.0);
            for (std::size_t j = 0; j < ny; ++j)
                for (std::size_t i = 0; i < nx; ++i) coarse[(j / 2) * mx + i / 2] += count[j * nx + i];
            count.swap(coarse);
            nx = mx, ny = my;
        }
    }
    // A cell of area pi r^2 represents a disc of radius r; interpolated between sizes by a power law.
    double operator()(double radius) const {
        const double level = std::log2(std::sqrt(3.14159) * radius / size_);
        if (level <= 0) return pairs_.front() * std::exp2(2 * level);
        const auto k = static_cast<std::size_t>(level);
        if (k + 1 >= pairs_.size()) return pairs_.back();
        const double low = std::max(pairs_[k], 1.0), high = std::max(pairs_[k + 1], 1.0);
        return low * std::pow(high / low, level - static_cast<double>(k));
    }

private:
    double size_;
    std::vector<double> pairs_;
};

// Factor in the bound of the modes of a smooth part that a mesh does not resolve.
constexpr double kAliases = 100;

struct Choice {
    double spacing = 0, pairs = 0, cost = 0;
};

// Mesh spacing of lowest cost. The longest side must be several cutoffs long; otherwise there is no relevant far field. `resolved`: largest
// spacing that resolves the smooth part. Returns 0 if too many mesh points are required.
template <class Pairs>
Choice choose_spacing(const MeshDesign& design, std::size_t n, double length_x, double length_y, bool periodic, double resolved,
                      Pairs pairs) {
    Choice best;
    best.cost = std::numeric_limits<double>::infinity();
    // A periodic mesh must be wider than a window and several cutoffs of any design.
    const double largest = std::min(periodic ? std::min(length_x, length_y) / 32 : std::max(length_x, length_y) / 8, resolved);
    for (double spacing = largest; spacing > largest * 1e-7; spacing *= 0.84) {
        const double mesh =
            periodic ? length_x / spacing * (length_y / spacing) : FarField::points_needed(design, length_x / spacing, length_y / spacing);
        if (mesh > kMeshPointsAtMost && (best.spacing > 0 || resolved < kInfinity)) break;
        const double near = pairs(design.cutoff * spacing);
        const double cost = kSecondsPerNearPair * near + kSecondsPerMeshPoint * mesh + seconds_per_point(design) * static_cast<double>(n);
        if (cost < best.cost) best = {spacing, near, cost};
    }
    return best;
}

// The kernel 1/d.
std::shared_ptr<const Kernel> unit_kernel() {
    static const auto unit = make_kernel(Interaction::point, 1 / std::numbers::pi);
    return unit;
}

}  // namespace

struct MeshPotential::Parts {
    std::size_t n = 0;
    std::shared_ptr<const Kernel> kernel;
    const Lattice* lattice;  // null unless periodic
    PairSums direct;         // used instead of the mesh for few or coinciding points, and if a mesh would be too fine

    const MeshDesign* design = nullptr;
    Choice choice;
    double scale = 1;  // near-field coordinate units per length, a power of two
    NearKernel near_part;
    MeshWindow window;
    std::shared_ptr<const FarField> far;

    // Points are sorted in strips along the longer side (x), by x within a strip. Strips are padded for the pair loops. With periodic
    // boundaries the first `strips` strips are followed by copies: of the two lowest strips beyond the upper border, then of the left ends
    // of all these strips beyond the right border.
    std::size_t strips = 0;
    std::vector<std::size_t> strip_begin, strip_size;
    std::vector<std::uint32_t> point;  // [strip_begin[s] + k] index of the caller, k < strip_size[s]
    std::vector<double> x, y;          // for the near field, scaled
    std::vector<double> u, v;          // on the mesh
    std::size_t spread_band = 1;       // number of strips whose windows reach only into the next band

    struct Scratch {
        std::vector<double> f, near, far;
        FftwArray mesh;
    };
    mutable std::mutex mutex;
    mutable std::vector<std::unique_ptr<Scratch>> free_scratch;

    int threads() const { return n > kThreads ? 0 : 1; }

    explicit Parts(std::shared_ptr<const Kernel> kernel_) : kernel(std::move(kernel_)), lattice(kernel->lattice()), direct(*kernel) {}

    // Largest spacing for which the neglected modes of a smooth part are not larger than those of 1/d.
    double resolved(const MeshDesign& of) const {
        const SmoothPart* smooth = kernel->smooth();
        return smooth ? smooth->scale() * of.beta / of.cutoff / std::log(kAliases / of.error) : kInfinity;
    }
    void sum_directly(const double* px, const double* py);
    std::unique_ptr<Scratch> take_scratch() const;
    void give_back(std::unique_ptr<Scratch> scratch) const;
    void make_strips(const double* px, const double* py, double x0, double y0, double length_y);
    void near_strip(std::size_t s, const double* f, double* phi) const;
    void repeat(std::size_t n, const double* px, const double* py, double relative_error, FarFields* kept);
    void spread(const double* f, double* mesh) const;
    void near_field(const double* f, double* phi) const;
};

void MeshPotential::Parts::sum_directly(const double* px, const double* py) {
    direct.assign(n, px, py);
    choice.pairs = static_cast<double>(n) * static_cast<double>(n);
    choice.cost = 1e-9 * choice.pairs;
}

MeshPotential::MeshPotential(std::size_t n, const double* x, const double* y, double relative_error, std::shared_ptr<const Kernel> kernel,
                             FarFields* kept)
    : parts_(std::make_unique<Parts>(kernel ? std::move(kernel) : unit_kernel())) {
    if (!(relative_error >= 1e-10 && relative_error <= 1e-2))
        throw Error(Failure::bad_input, "mesh product: relative error " + text_of(relative_error) + " is outside the range 1e-10 to 1e-2");
    if (n > std::numeric_limits<std::uint32_t>::max())
        throw Error(Failure::bad_input, "mesh product: " + std::to_string(n) + " points exceed the limit of 2^32");
    Parts& p = *parts_;
    p.n = n;
    double x_min = HUGE_VAL, x_max = -HUGE_VAL, y_min = HUGE_VAL, y_max = -HUGE_VAL;
    for (std::size_t i = 0; i < n; ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
            throw Error(Failure::bad_input, "mesh product: coordinates of point " + std::to_string(i + 1) + " must be finite");
        x_min = std::min(x_min, x[i]), x_max = std::max(x_max, x[i]);
        y_min = std::min(y_min, y[i]), y_max = std::max(y_max, y[i]);
    }
    if (n <= (p.lattice ? kDirectLattice : kDirect) || (x_max == x_min && y_max == y_min)) {
        p.sum_directly(x, y);
        return;
    }
    if (p.lattice) {
        p.repeat(n, x, y, relative_error, kept);
        return;
    }
    p.design = &mesh_design(relative_error);
    const double resolved = p.resolved(*p.design);
    // The kernel is symmetric in x and y.
    if (y_max - y_min > x_max - x_min) std::swap(x, y), std::swap(x_min, y_min), std::swap(x_max, y_max);
    const double length_x = x_max - x_min, length_y = y_max - y_min;
    if (!std::isfinite(length_x)) throw Error(Failure::bad_input, "mesh product: the extent of the points overflows");
    p.choice = choose_spacing(*p.design, n, length_x, length_y, false, resolved, PairEstimate(n, x, y, x_min, y_min, length_x, length_y));
    if (!(p.choice.spacing > 0)) {
        p.sum_directly(x, y);
        return;
    }
    p.scale = std::ldexp(1.0, -std::ilogb(length_x) - 1);
    const double cutoff = p.design->cutoff * p.choice.spacing;
    p.near_part = near_kernel(*p.design, cutoff * p.scale);
    p.window = mesh_window(*p.design);
    p.far = std::make_shared<FarField>(*p.design, length_x / p.choice.spacing, length_y / p.choice.spacing, p.choice.spacing, *p.kernel);
    p.make_strips(x, y, x_min, y_min, length_y);
}

MeshPotential::~MeshPotential() = default;
MeshPotential::MeshPotential(MeshPotential&&) noexcept = default;
MeshPotential& MeshPotential::operator=(MeshPotential&&) noexcept = default;

void MeshPotential::Parts::make_strips(const double* px, const double* py, double x0, double y0, double length_y) {
    // Strips are at least half a cutoff high, so that points interact with at most two strips on each side.
    double height = near_part.reach / scale / 2;
    strips = static_cast<std::size_t>(length_y / height) + 1;
    if (lattice) height = length_y / static_cast<double>(--strips);
    std::vector<std::uint32_t> strip(n);
    const std::size_t whole = lattice ? strips + 2 : strips, all = lattice ? 2 * whole : strips;
    const double reach = near_part.reach / scale;
    strip_size.assign(all, 0);
    // Calls visit(segment) for the strip of a point and its copies.
    const auto segments = [&](std::size_t i, auto&& visit) {
        const std::size_t s = strip[i];
        visit(s);
        if (!lattice) return;
        const bool left = px[i] - x0 < reach;
        if (left) visit(whole + s);
        if (s < 2) visit(strips + s);
        if (s < 2 && left) visit(whole + strips + s);
    };
    for (std::size_t i = 0; i < n; ++i) {
        strip[i] = std::min(static_cast<std::uint32_t>((py[i] - y0) / height), static_cast<std::uint32_t>(strips - 1));
        segments(i, [&](std::size_t s) { ++strip_size[s]; });
    }
    strip_begin.resize(all + 1);
    strip_begin[0] = 0;
    for (std::size_t s = 0; s < all; ++s)
        strip_begin[s + 1] = strip_begin[s] + (strip_size[s] + 2 * kPairPadding - 1) / kPairPadding * kPairPadding;
    point.resize(strip_begin[all]);
    std::vector<std::size_t> next(strip_begin.begin(), strip_begin.end() - 1);
    for (std::size_t i = 0; i < n; ++i) segments(i, [&](std::size_t s) { point[next[s]++] = static_cast<std::uint32_t>(i); });

    for (auto* array : {&x, &y, &u, &v}) array->resize(point.size());
    const double offset = 0.5 * design->width;
    const double dx = lattice ? lattice->period().x / static_cast<double>(far->columns()) : choice.spacing;
    const double dy = lattice ? lattice->period().y / static_cast<double>(far->lines()) : choice.spacing;
    parallel_for(all, kStrips, threads(), [&](std::size_t s) {
        const double right = s >= whole ? lattice->period().x : 0, up = s % whole >= strips ? lattice->period().y : 0;
        const auto begin = point.begin() + static_cast<std::ptrdiff_t>(strip_begin[s]);
        std::sort(begin, begin + static_cast<std::ptrdiff_t>(strip_size[s]),
                  [px](std::uint32_t a, std::uint32_t b) { return px[a] != px[b] ? px[a] < px[b] : a < b; });
        for (std::size_t k = strip_begin[s]; k < strip_begin[s] + strip_size[s]; ++k) {
            const std::uint32_t i = point[k];
            x[k] = (px[i] + right) * scale, y[k] = (py[i] + up) * scale;
            u[k] = (px[i] - x0) / dx + offset, v[k] = (py[i] - y0) / dy + offset;
        }
        // Padding points are farther from all others than the cutoff, since the box is at most 1 wide.
        for (std::size_t k = strip_begin[s] + strip_size[s]; k < strip_begin[s + 1]; ++k) x[k] = x0 * scale + 4, y[k] = y0 * scale;
    });
    spread_band = static_cast<std::size_t>((design->width + 1) * choice.spacing / height) + 1;
}

std::unique_ptr<MeshPotential::Parts::Scratch> MeshPotential::Parts::take_scratch() const {
    {
        const std::lock_guard lock(mutex);
        if (!free_scratch.empty()) {
            auto scratch = std::move(free_scratch.back());
            free_scratch.pop_back();
            return scratch;
        }
    }
    auto scratch = std::make_unique<Scratch>();
    for (auto* array : {&scratch->f, &scratch->near, &scratch->far}) array->assign(point.size(), 0.0);
    scratch->mesh = fftw_array(far->rows() * far->stride());
    return scratch;
}

void MeshPotential::Parts::give_back(std::unique_ptr<Scratch> scratch) const {
    const std::lock_guard lock(mutex);
    free_scratch.push_back(std::move(scratch));
}

// Maps the points into the cell and sets up a periodic mesh.
void MeshPotential::Parts::repeat(std::size_t count, const double* px, const double* py, double relative_error, FarFields* kept) {
    const Period& period = lattice->period();
    std::vector<double> inside_x(count), inside_y(count);
    const auto inside = [](double value, double side) {
        const double moved = value - side * std::floor(value / side);
        return moved < side ? moved : 0.0;
    };
    for (std::size_t i = 0; i < count; ++i) inside_x[i] = inside(px[i], period.x), inside_y[i] = inside(py[i], period.y);
    design = &mesh_design(relative_error);
    choice = choose_spacing(*design, count, period.x, period.y, true, resolved(*design),
                            PairEstimate(count, inside_x.data(), inside_y.data(), 0, 0, period.x, period.y));
    scale = std::ldexp(1.0, -std::ilogb(std::max(period.x, period.y)) - 1);
    const double cutoff = design->cutoff * choice.spacing;
    near_part = near_kernel(*design, cutoff * scale);
    window = mesh_window(*design);
    const std::pair<const MeshDesign*, double> key{design, choice.spacing};
    if (kept && kept->contains(key)) {
        far = kept->at(key);
    } else {
        far = std::make_shared<FarField>(*design, *lattice, choice.spacing, cutoff);
        if (kept) {
            std::size_t held = far->bytes();
            for (const auto& [other, field] : *kept) held += field->bytes();
            if (held > kKeptBytes) kept->clear();
            kept->emplace(key, far);
        }
    }
    make_strips(inside_x.data(), inside_y.data(), 0, 0, period.y);
}

// Even bands of strips are processed in parallel, then odd ones: concurrent bands never access the same rows, and the order of summation in
// a row does not depend on the threads.
void MeshPotential::Parts::spread(const double* f, double* mesh) const {
    const std::size_t bands = (strips + spread_band - 1) / spread_band, stride = far->stride();
    const auto table = pair_kernels().spread;
    parallel_for(far->rows(), kStrips, threads(), [&](std::size_t row) { std::fill_n(mesh + row * stride, stride, 0.0); });
    for (std::size_t odd = 0; odd < 2; ++odd)
        parallel_for((bands + 1 - odd) / 2, 1, threads(), [&](std::size_t half) {
            const std::size_t band = 2 * half + odd;
            for (std::size_t s = band * spread_band; s < std::min(strips, (band + 1) * spread_band); ++s) {
                const std::size_t b = strip_begin[s];
                table(window, strip_size[s], u.data() + b, v.data() + b, f + b, mesh, stride);
            }
        });
}

// Adds the pairs of a strip with itself and with the next two strips.
void MeshPotential::Parts::near_strip(std::size_t s, const double* f, double* phi) const {
    const PairKernels& table = pair_kernels();
    const auto between = [&](std::size_t a, std::size_t b) {
        const std::size_t i = strip_begin[a], j = strip_begin[b];
        if (strip_size[a] == 0 || strip_size[b] == 0) return;
        table.near_strips(near_part, strip_size[a], x.data() + i, y.data() + i, f + i, phi + i, strip_size[b], x.data() + j, y.data() + j,
                          f + j, phi + j);
    };
    const std::size_t b = strip_begin[s], whole = lattice ? strips + 2 : strips;
    table.near_own(near_part, strip_size[s], x.data() + b, y.data() + b, f + b, phi + b);
    if (lattice) between(s, whole + s);
    for (std::size_t t = s + 1; t < std::min(whole, s + 3); ++t) {
        between(s, t);
        if (lattice) between(s, whole + t), between(t, whole + s);
    }
}

// Near field by groups of strips: a group adds to its own strips, the two after it, and the copies of their left ends.
void MeshPotential::Parts::near_field(const double* f, double* phi) const {
    constexpr std::size_t kGroup = 4;
    const std::size_t groups = (strips + kGroup - 1) / kGroup;
    for (std::size_t odd = 0; odd < 2; ++odd)
        parallel_for((groups + 1 - odd) / 2, 1, threads(), [&](std::size_t half) {
            const std::size_t group = 2 * half + odd;
            for (std::size_t s = group * kGroup; s < std::min(strips, (group + 1) * kGroup); ++s) near_strip(s, f, phi);
        });
}

std::size_t MeshPotential::size() const { return parts_->n; }

void MeshPotential::apply(const double* f, double* phi) const {
    const Parts& p = *parts_;
    if (!p.far) return p.direct.apply(f, phi);
    auto scratch = p.take_scratch();
    const std::size_t strips = p.strips, all = p.strip_size.size();
    double *const sorted = scratch->f.data(), *const near = scratch->near.data(), *const far = scratch->far.data();
    parallel_for(all, kStrips, p.threads(), [&](std::size_t s) {
        const std::size_t b = p.strip_begin[s];
        for (std::size_t k = b; k < b + p.strip_size[s]; ++k) sorted[k] = f[p.point[k]];  // padding remains without force
        std::fill(near + b, near + p.strip_begin[s + 1], 0.0);
    });
    p.near_field(sorted, near);
    p.spread(sorted, scratch->mesh.get());
    p.far->convolve(scratch->mesh.get());
    const double unit = p.kernel->near(), near_unit = unit * p.scale, far_unit = p.lattice ? unit : unit / p.choice.spacing;
    parallel_for(strips, kStrips, p.threads(), [&](std::size_t s) {
        const std::size_t b = p.strip_begin[s];
        pair_kernels().interpolate(p.window, p.strip_size[s], p.u.data() + b, p.v.data() + b, far + b, scratch->mesh.get(),
                                   p.far->stride());
        for (std::size_t k = b; k < b + p.strip_size[s]; ++k) phi[p.point[k]] = near[k] * near_unit + far[k] * far_unit;
    });
    for (std::size_t s = strips; s < all; ++s)  // adds the results of the copies
        for (std::size_t k = p.strip_begin[s]; k < p.strip_begin[s] + p.strip_size[s]; ++k) phi[p.point[k]] += near[k] * near_unit;
    p.give_back(std::move(scratch));
    if (const double shift = p.kernel->shift(); shift > 0 && !p.lattice) {  // periodic kernels include it in the far field
        double total = 0;
        for (std::size_t k = 0; k < p.n; ++k) total += f[k];
        for (std::size_t k = 0; k < p.n; ++k) phi[k] += shift * total;
    }
}

std::size_t MeshPotential::bytes() const {
    const Parts& p = *parts_;
    if (!p.far) return p.n * (2 * sizeof(double) + 2 * sizeof(std::int32_t));
    return p.far->bytes() + p.point.size() * (sizeof(std::uint32_t) + 7 * sizeof(double));
}

std::size_t MeshPotential::mesh_points() const { return parts_->far ? parts_->far->points() : 0; }
double MeshPotential::cutoff() const { return parts_->far ? parts_->design->cutoff * parts_->choice.spacing : 0; }
double MeshPotential::near_pairs() const { return parts_->choice.pairs; }
double MeshPotential::cost() const { return parts_->choice.cost; }

double MeshPotential::estimated_cost(std::size_t n, double relative_error, double aspect_ratio, double scale) {
    if (n <= kDirect) return 1e-9 * static_cast<double>(n) * static_cast<double>(n);
    const double side = std::min(aspect_ratio, 1 / aspect_ratio), count = static_cast<double>(n);
    const auto pairs = [&](double radius) { return count * std::min(count, count * 3.14159 * radius * radius / side); };
    const MeshDesign& design = mesh_design(relative_error);
    const double resolved = scale < 1e300 ? scale * design.beta / design.cutoff / std::log(kAliases / design.error) : kInfinity;
    return choose_spacing(design, n, 1, side, false, resolved, pairs).cost;
}

}  // namespace rsc
