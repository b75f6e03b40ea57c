#include "interaction/mesh.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "base/parallel.hpp"

namespace rsc {

namespace {

constexpr std::size_t kDirect = 256;        // fewer points are summed directly
constexpr std::size_t kDirectLattice = 32;  // for periodic kernels
constexpr std::size_t kThreads = 5000;      // fewer points use one thread
constexpr int kStrips = 16;                 // or rows of the mesh processed by a thread at a time

// Measured times on one core in seconds, used only to balance the work of mesh and near field.
constexpr double kSecondsPerNearPair = 2.3e-9;
constexpr double kSecondsPerMeshPoint = 11e-9;
double seconds_per_point(const MeshDesign& design) {
    return 20e-9 + 0.9e-9 * design.width * ((design.width + 3) / 4 * 4);
}

// Largest doubled mesh, at 16 bytes per point or less; otherwise the near field becomes larger.
constexpr double kMeshPointsAtMost = 5e7;

// Estimated number of directed pairs within a distance, from counts of points in square cells of
// doubling sizes.
class PairEstimate {
public:
    PairEstimate(std::size_t n, const double* x, const double* y, double x0, double y0,
                 double length_x, double length_y) {
        // The finest cells contain a few points each for a uniform distribution.
        size_ = std::max({std::sqrt(length_x * length_y * 2 / static_cast<double>(n)),
                          length_x * 2 / static_cast<double>(n)});
        std::size_t nx = static_cast<std::size_t>(length_x / size_) + 1,
                    ny = static_cast<std::size_t>(length_y / size_) + 1;
        std::vector<double> count(nx * ny, 0.0);
        for (std::size_t i = 0; i < n; ++i)
            count[static_cast<std::size_t>((y[i] - y0) / size_) * nx +
                  static_cast<std::size_t>((x[i] - x0) / size_)] += 1;
        for (;;) {
            double pairs = 0;
            for (double c : count) pairs += c * c;
            pairs_.push_back(pairs -
                             static_cast<double>(n));  // without pairs of a point with itself
            if (nx == 1 && ny == 1) break;
            const std::size_t mx = (nx + 1) / 2, my = (ny + 1) / 2;
            std::vector<double> coarse(mx * my, 0.0);
            for (std::size_t j = 0; j < ny; ++j)
                for (std::size_t i = 0; i < nx; ++i)
                    coarse[(j / 2) * mx + i / 2] += count[j * nx + i];
            count.swap(coarse);
            nx = mx;
            ny = my;
        }
    }
    // A cell of area pi r^2 represents a disc of radius r; interpolated between sizes by a power
    // law.
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

// Largest spacing for which the neglected modes of a smooth part that changes little within `scale`
// are not larger than those of 1/d.
double resolved_by(const MeshDesign& design, double scale) {
    return scale * design.beta / design.cutoff / std::log(kAliases / design.error);
}

struct Choice {
    double spacing = 0, cost = kInfinity;
};

// Mesh spacing of lowest cost. The longest side must be several cutoffs long; otherwise there is no
// relevant far field. `resolved`: largest spacing that resolves the smooth part. Returns 0 if too
// many mesh points are required.
template <class Pairs>
Choice choose_spacing(const MeshDesign& design, std::size_t n, double length_x, double length_y,
                      bool periodic, double resolved, Pairs pairs) {
    Choice best;
    // A periodic mesh must be wider than a window and several cutoffs of any design.
    const double largest = std::min(
        periodic ? std::min(length_x, length_y) / 32 : std::max(length_x, length_y) / 8, resolved);
    for (double spacing = largest; spacing > largest * 1e-7; spacing *= 0.84) {
        const double mesh =
            periodic ? length_x / spacing * (length_y / spacing)
                     : FarField::points_needed(design, length_x / spacing, length_y / spacing);
        if (mesh > kMeshPointsAtMost && (best.spacing > 0 || resolved < kInfinity)) break;
        const double near = pairs(design.cutoff * spacing);
        const double cost = kSecondsPerNearPair * near + kSecondsPerMeshPoint * mesh +
                            seconds_per_point(design) * static_cast<double>(n);
        if (cost < best.cost) best = {spacing, cost};
    }
    return best;
}

}  // namespace

int MeshPotential::threads() const { return n_ > kThreads ? 0 : 1; }

double MeshPotential::resolved() const {
    return kernel_->smooth() ? resolved_by(*design_, kernel_->smooth()->scale()) : kInfinity;
}

MeshPotential::MeshPotential(std::size_t n, const double* x, const double* y, double relative_error,
                             std::shared_ptr<const Kernel> kernel)
    : n_(n),
      kernel_(std::move(kernel)),
      lattice_(kernel_->lattice()),
      direct_(*kernel_),
      design_(&mesh_design(relative_error)) {
    if (!(relative_error >= 1e-10 && relative_error <= 1e-2))
        throw Error(Failure::bad_input, "mesh product: relative error " + text_of(relative_error) +
                                            " is outside the range 1e-10 to 1e-2");
    if (n > std::numeric_limits<std::uint32_t>::max())
        throw Error(Failure::bad_input,
                    "mesh product: " + std::to_string(n) + " points exceed the limit of 2^32");
    double x_min = HUGE_VAL, x_max = -HUGE_VAL, y_min = HUGE_VAL, y_max = -HUGE_VAL;
    for (std::size_t i = 0; i < n; ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
            throw Error(Failure::bad_input, "mesh product: coordinates of point " +
                                                std::to_string(i + 1) + " must be finite");
        x_min = std::min(x_min, x[i]);
        x_max = std::max(x_max, x[i]);
        y_min = std::min(y_min, y[i]);
        y_max = std::max(y_max, y[i]);
    }
    if (n <= (lattice_ ? kDirectLattice : kDirect) || (x_max == x_min && y_max == y_min)) {
        direct_.assign(n, x, y);
        return;
    }
    window_ = mesh_window(*design_);
    if (lattice_) {
        make_periodic(x, y);
        return;
    }
    // The kernel is symmetric in x and y.
    if (y_max - y_min > x_max - x_min) {
        std::swap(x, y);
        std::swap(x_min, y_min);
        std::swap(x_max, y_max);
    }
    const double length_x = x_max - x_min, length_y = y_max - y_min;
    if (!std::isfinite(length_x))
        throw Error(Failure::bad_input, "mesh product: the extent of the points overflows");
    spacing_ = choose_spacing(*design_, n, length_x, length_y, false, resolved(),
                              PairEstimate(n, x, y, x_min, y_min, length_x, length_y))
                   .spacing;
    if (!(spacing_ > 0)) {
        direct_.assign(n, x, y);
        return;
    }
    scale_ = std::ldexp(1.0, -std::ilogb(length_x) - 1);
    near_part_ = near_kernel(*design_, design_->cutoff * spacing_ * scale_);
    far_ = std::make_unique<FarField>(*design_, length_x / spacing_, length_y / spacing_, spacing_,
                                      *kernel_);
    make_strips(x, y, x_min, y_min, length_y);
}

// Maps the points into the cell and sets up a periodic mesh.
void MeshPotential::make_periodic(const double* x, const double* y) {
    const Period& period = lattice_->period();
    std::vector<double> inside_x(n_), inside_y(n_);
    const auto inside = [](double value, double side) {
        const double moved = value - side * std::floor(value / side);
        return moved < side ? moved : 0.0;
    };
    for (std::size_t i = 0; i < n_; ++i) {
        inside_x[i] = inside(x[i], period.x);
        inside_y[i] = inside(y[i], period.y);
    }
    spacing_ =
        choose_spacing(*design_, n_, period.x, period.y, true, resolved(),
                       PairEstimate(n_, inside_x.data(), inside_y.data(), 0, 0, period.x, period.y))
            .spacing;
    scale_ = std::ldexp(1.0, -std::ilogb(std::max(period.x, period.y)) - 1);
    const double cutoff = design_->cutoff * spacing_;
    near_part_ = near_kernel(*design_, cutoff * scale_);
    far_ = std::make_unique<FarField>(*design_, *lattice_, spacing_, cutoff);
    make_strips(inside_x.data(), inside_y.data(), 0, 0, period.y);
}

void MeshPotential::make_strips(const double* x, const double* y, double x0, double y0,
                                double length_y) {
    // Strips are at least half a cutoff high, so that points interact with at most two strips on
    // each side.
    const double reach = near_part_.reach / scale_;
    double height = reach / 2;
    strips_ = static_cast<std::size_t>(length_y / height) + 1;
    if (lattice_) height = length_y / static_cast<double>(--strips_);
    std::vector<std::uint32_t> strip(n_);
    const std::size_t whole = lattice_ ? strips_ + 2 : strips_,
                      all = lattice_ ? 2 * whole : strips_;
    strip_size_.assign(all, 0);
    // Calls visit(segment) for the strip of a point and its copies.
    const auto segments = [&](std::size_t i, auto&& visit) {
        const std::size_t s = strip[i];
        visit(s);
        if (!lattice_) return;
        const bool left = x[i] - x0 < reach;
        if (left) visit(whole + s);
        if (s < 2) visit(strips_ + s);
        if (s < 2 && left) visit(whole + strips_ + s);
    };
    for (std::size_t i = 0; i < n_; ++i) {
        strip[i] = std::min(static_cast<std::uint32_t>((y[i] - y0) / height),
                            static_cast<std::uint32_t>(strips_ - 1));
        segments(i, [&](std::size_t s) { ++strip_size_[s]; });
    }
    strip_begin_.resize(all + 1);
    strip_begin_[0] = 0;
    for (std::size_t s = 0; s < all; ++s)
        strip_begin_[s + 1] =
            strip_begin_[s] + (strip_size_[s] + 2 * kPairPadding - 1) / kPairPadding * kPairPadding;
    const std::size_t size = strip_begin_[all];
    point_.resize(size);
    std::vector<std::size_t> next(strip_begin_.begin(), strip_begin_.end() - 1);
    for (std::size_t i = 0; i < n_; ++i)
        segments(i, [&](std::size_t s) { point_[next[s]++] = static_cast<std::uint32_t>(i); });

    for (auto* array : {&x_, &y_, &u_, &v_, &f_, &near_phi_, &far_phi_}) array->assign(size, 0.0);
    fill_strips(x, y, x0, y0, whole);
    mesh_ = fftw_array(far_->rows() * far_->stride());
    spread_band_ = static_cast<std::size_t>((design_->width + 1) * spacing_ / height) + 1;
}

// Sorts the points of each strip, and sets their coordinates. `whole`: number of strips without the
// copies beyond the right border.
void MeshPotential::fill_strips(const double* x, const double* y, double x0, double y0,
                                std::size_t whole) {
    const double offset = 0.5 * design_->width;
    const double dx =
        lattice_ ? lattice_->period().x / static_cast<double>(far_->columns()) : spacing_;
    const double dy =
        lattice_ ? lattice_->period().y / static_cast<double>(far_->lines()) : spacing_;
    parallel_for(strip_size_.size(), kStrips, threads(), [&](std::size_t s) {
        const double right = s >= whole ? lattice_->period().x : 0,
                     up = s % whole >= strips_ ? lattice_->period().y : 0;
        const auto begin = point_.begin() + static_cast<std::ptrdiff_t>(strip_begin_[s]);
        std::sort(
            begin, begin + static_cast<std::ptrdiff_t>(strip_size_[s]),
            [x](std::uint32_t a, std::uint32_t b) { return x[a] != x[b] ? x[a] < x[b] : a < b; });
        for (std::size_t k = strip_begin_[s]; k < strip_begin_[s] + strip_size_[s]; ++k) {
            const std::uint32_t i = point_[k];
            x_[k] = (x[i] + right) * scale_;
            y_[k] = (y[i] + up) * scale_;
            u_[k] = (x[i] - x0) / dx + offset;
            v_[k] = (y[i] - y0) / dy + offset;
        }
        // Padding points are farther from all others than the cutoff, since the box is at most 1
        // wide.
        for (std::size_t k = strip_begin_[s] + strip_size_[s]; k < strip_begin_[s + 1]; ++k) {
            x_[k] = x0 * scale_ + 4;
            y_[k] = y0 * scale_;
        }
    });
}

// Even bands of strips are processed in parallel, then odd ones: concurrent bands never access the
// same rows, and the order of summation in a row does not depend on the threads.
void MeshPotential::spread() {
    const std::size_t bands = (strips_ + spread_band_ - 1) / spread_band_, stride = far_->stride();
    const auto table = pair_kernels().spread;
    double* const mesh = mesh_.get();
    parallel_for(far_->rows(), kStrips, threads(),
                 [&](std::size_t row) { std::fill_n(mesh + row * stride, stride, 0.0); });
    for (std::size_t odd = 0; odd < 2; ++odd)
        parallel_for((bands + 1 - odd) / 2, 1, threads(), [&](std::size_t half) {
            const std::size_t band = 2 * half + odd;
            for (std::size_t s = band * spread_band_;
                 s < std::min(strips_, (band + 1) * spread_band_); ++s) {
                const std::size_t b = strip_begin_[s];
                table(window_, strip_size_[s], u_.data() + b, v_.data() + b, f_.data() + b, mesh,
                      stride);
            }
        });
}

// Adds the pairs of a strip with itself and with the next two strips.
void MeshPotential::near_strip(std::size_t s) {
    const PairKernels& table = pair_kernels();
    const double *const x = x_.data(), *const y = y_.data(), *const f = f_.data();
    double* const phi = near_phi_.data();
    const auto between = [&](std::size_t a, std::size_t b) {
        const std::size_t i = strip_begin_[a], j = strip_begin_[b];
        if (strip_size_[a] == 0 || strip_size_[b] == 0) return;
        table.near_strips(near_part_, strip_size_[a], x + i, y + i, f + i, phi + i, strip_size_[b],
                          x + j, y + j, f + j, phi + j);
    };
    const std::size_t b = strip_begin_[s], whole = lattice_ ? strips_ + 2 : strips_;
    table.near_own(near_part_, strip_size_[s], x + b, y + b, f + b, phi + b);
    if (lattice_) between(s, whole + s);
    for (std::size_t t = s + 1; t < std::min(whole, s + 3); ++t) {
        between(s, t);
        if (lattice_) {
            between(s, whole + t);
            between(t, whole + s);
        }
    }
}

// Near field by groups of strips: a group adds to its own strips, the two after it, and the copies
// of their left ends.
void MeshPotential::near_field() {
    constexpr std::size_t kGroup = 4;
    const std::size_t groups = (strips_ + kGroup - 1) / kGroup;
    for (std::size_t odd = 0; odd < 2; ++odd)
        parallel_for((groups + 1 - odd) / 2, 1, threads(), [&](std::size_t half) {
            const std::size_t group = 2 * half + odd;
            for (std::size_t s = group * kGroup; s < std::min(strips_, (group + 1) * kGroup); ++s)
                near_strip(s);
        });
}

void MeshPotential::apply(const double* f, double* phi) {
    if (!far_) return direct_.among(false, f, phi);
    const std::size_t all = strip_size_.size();
    parallel_for(all, kStrips, threads(), [&](std::size_t s) {
        for (std::size_t b = strip_begin_[s], k = b; k < b + strip_size_[s]; ++k)
            f_[k] = f[point_[k]];  // padding remains without force
        std::fill_n(near_phi_.data() + strip_begin_[s], strip_begin_[s + 1] - strip_begin_[s], 0.0);
    });
    near_field();
    spread();
    far_->convolve(mesh_.get());
    const double unit = kernel_->near(), near_unit = unit * scale_,
                 far_unit = lattice_ ? unit : unit / spacing_;
    parallel_for(strips_, kStrips, threads(), [&](std::size_t s) {
        const std::size_t b = strip_begin_[s];
        pair_kernels().interpolate(window_, strip_size_[s], u_.data() + b, v_.data() + b,
                                   far_phi_.data() + b, mesh_.get(), far_->stride());
        for (std::size_t k = b; k < b + strip_size_[s]; ++k)
            phi[point_[k]] = near_phi_[k] * near_unit + far_phi_[k] * far_unit;
    });
    for (std::size_t s = strips_; s < all; ++s)  // adds the results of the copies
        for (std::size_t b = strip_begin_[s], k = b; k < b + strip_size_[s]; ++k)
            phi[point_[k]] += near_phi_[k] * near_unit;
    if (const double shift = kernel_->shift();
        shift > 0 && !lattice_) {  // periodic kernels include it in the far field
        const double total = std::accumulate(f, f + n_, 0.0);
        for (std::size_t k = 0; k < n_; ++k) phi[k] += shift * total;
    }
}

double MeshPotential::estimated_cost(std::size_t n, double relative_error, double aspect_ratio,
                                     double scale) {
    if (n <= kDirect) return 1e-9 * static_cast<double>(n) * static_cast<double>(n);
    const double side = std::min(aspect_ratio, 1 / aspect_ratio), count = static_cast<double>(n);
    const auto pairs = [&](double radius) {
        return count * std::min(count, count * 3.14159 * radius * radius / side);
    };
    const MeshDesign& design = mesh_design(relative_error);
    return choose_spacing(design, n, 1, side, false,
                          scale < 1e300 ? resolved_by(design, scale) : kInfinity, pairs)
        .cost;
}

}  // namespace rsc
