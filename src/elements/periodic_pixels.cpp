#include "elements/periodic_pixels.hpp"

#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "base/parallel.hpp"
#include "base/vector_math.hpp"

namespace rsc {
namespace {

constexpr std::size_t kThreads = 400000;  // number of pixels above which threads are used
constexpr std::size_t kLine = 64;         // bytes
constexpr int kColumns = 8;               // columns transformed together
constexpr int kRows = 8;                  // that a thread takes at a time

// Names of FFTW in single and double precision. Transforms of single rows and columns from one
// array to another need half the time of those in place or of several interleaved columns with the
// plans that FFTW_ESTIMATE finds.
template <class Real>
struct Fftw;
template <>
struct Fftw<double> {
    using Complex = fftw_complex;
    using Plan = FftwPlan;
    static Plan row_forward(int n, double* from, Complex* to) {
        return Plan(fftw_plan_dft_r2c_1d(n, from, to, FFTW_ESTIMATE));
    }
    static Plan row_backward(int n, Complex* from, double* to) {
        return Plan(fftw_plan_dft_c2r_1d(n, from, to, FFTW_ESTIMATE));
    }
    static Plan column(int n, Complex* from, Complex* to, int sign) {
        return Plan(fftw_plan_dft_1d(n, from, to, sign, FFTW_ESTIMATE));
    }
    static void execute(const Plan& plan, double* from, Complex* to) {
        fftw_execute_dft_r2c(plan.get(), from, to);
    }
    static void execute(const Plan& plan, Complex* from, double* to) {
        fftw_execute_dft_c2r(plan.get(), from, to);
    }
    static void execute(const Plan& plan, Complex* from, Complex* to) {
        fftw_execute_dft(plan.get(), from, to);
    }
};
template <>
struct Fftw<float> {
    using Complex = fftwf_complex;
    using Plan = FftwfPlan;
    static Plan row_forward(int n, float* from, Complex* to) {
        return Plan(fftwf_plan_dft_r2c_1d(n, from, to, FFTW_ESTIMATE));
    }
    static Plan row_backward(int n, Complex* from, float* to) {
        return Plan(fftwf_plan_dft_c2r_1d(n, from, to, FFTW_ESTIMATE));
    }
    static Plan column(int n, Complex* from, Complex* to, int sign) {
        return Plan(fftwf_plan_dft_1d(n, from, to, sign, FFTW_ESTIMATE));
    }
    static void execute(const Plan& plan, float* from, Complex* to) {
        fftwf_execute_dft_r2c(plan.get(), from, to);
    }
    static void execute(const Plan& plan, Complex* from, float* to) {
        fftwf_execute_dft_c2r(plan.get(), from, to);
    }
    static void execute(const Plan& plan, Complex* from, Complex* to) {
        fftwf_execute_dft(plan.get(), from, to);
    }
};

template <class Real>
typename Fftw<Real>::Complex* as_complex(Real* p) {
    return reinterpret_cast<typename Fftw<Real>::Complex*>(p);
}

}  // namespace

template <class Real>
struct PeriodicPixels<Real>::Plans {
    typename Fftw<Real>::Plan row_forward, row_backward, column_forward, column_backward;
    // Of a row or column being transformed, and between the columns of a block.
    std::size_t length = 0, stride = 0;
    std::size_t size() const { return length + (kColumns + 1) * stride; }
    // One for each thread: a row or column being transformed, a block of columns, and the factors
    // of a column.
    std::vector<Array<Real>> buffers;
};

template <class Real>
PeriodicPixels<Real>::PeriodicPixels(int nx, int ny, double dx, double dy,
                                     const std::function<double(double)>& share,
                                     Array<double>* plane)
    : nx_(nx),
      ny_(ny),
      dx_(dx),
      dy_(dy),
      threads_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) >= kThreads),
      plane_(plane ? plane : &own_),
      plans_(std::make_unique<Plans>()) {
    make_plans();
    if (!share) return;
    set_factors([&](int i, int j) {
        const double k =
            2 * pi *
            std::hypot(static_cast<double>(i) / nx_ / dx_, static_cast<double>(j) / ny_ / dy_);
        return k > 0 ? 1 + share(k) : 1.0;
    });
}

template <class Real>
PeriodicPixels<Real>::PeriodicPixels(int nx, int ny, const std::vector<double>& modes)
    : nx_(nx),
      ny_(ny),
      dx_(1),
      dy_(1),
      threads_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) >= kThreads),
      half_space_(false),
      plans_(std::make_unique<Plans>()) {
    make_plans();
    const std::size_t row = static_cast<std::size_t>(nx / 2) + 1;
    const double points = static_cast<double>(nx) * ny;
    set_factors(
        [&](int i, int j) { return 2 * i <= nx_ ? modes[at(j) * row + at(i)] / points : 0.0; });
}

template <class Real>
template <class Factor>
void PeriodicPixels<Real>::set_factors(Factor&& factor) {
    const int columns = (nx_ / 2 + kColumns) / kColumns * kColumns, half = ny_ / 2 + 1;
    layered_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(half));
    parallel_for(half, kRows, static_cast<int>(plans_->buffers.size()), [&](int j) {
        for (int i = 0; i < columns; ++i)
            layered_[static_cast<std::size_t>(i) * static_cast<std::size_t>(half) +
                     static_cast<std::size_t>(j)] = static_cast<Real>(factor(i, j));
    });
}

template <class Real>
void PeriodicPixels<Real>::make_plans() {
    const int nx = nx_, ny = ny_;
    // Rows hold whole blocks of columns and are an odd number of cache lines apart, so that the
    // elements of a column do not share cache sets.
    constexpr std::size_t line = kLine / sizeof(Real);
    std::size_t lines =
        (2 * static_cast<std::size_t>((nx / 2 + kColumns) / kColumns * kColumns) + line - 1) / line;
    lines += lines % 2 == 0;
    stride_ = lines * line;
    // The contents, of others, are of no meaning.
    const std::size_t size = stride_ * at(ny) * sizeof(Real) / sizeof(double);
    if (plane_->size() < size) *plane_ = Array<double>(size);
    const auto whole_lines = [](std::size_t n) { return (n + line - 1) / line * line; };
    plans_->length = whole_lines(2 * static_cast<std::size_t>(std::max(nx / 2 + 1, ny)));
    plans_->stride = whole_lines(2 * static_cast<std::size_t>(ny)) +
                     line;  // columns that do not share cache sets
    const int threads = threads_ ? static_cast<int>(most_threads(0)) : 1;
    for (int t = 0; t < threads; ++t) plans_->buffers.emplace_back(plans_->size());
    const auto lock = fftw_planning();
    Real *const row = this->row(0), *const buffer = plans_->buffers[0].data(),
                *const column = buffer + plans_->length;
    plans_->row_forward = Fftw<Real>::row_forward(nx, buffer, as_complex(row));
    plans_->row_backward = Fftw<Real>::row_backward(nx, as_complex(buffer), row);
    plans_->column_forward =
        Fftw<Real>::column(ny, as_complex(column), as_complex(buffer), FFTW_FORWARD);
    plans_->column_backward =
        Fftw<Real>::column(ny, as_complex(buffer), as_complex(column), FFTW_BACKWARD);
    if (!plans_->row_forward || !plans_->row_backward || !plans_->column_forward ||
        !plans_->column_backward)
        throw Error(Failure::internal, "FFTW made no plan for " + std::to_string(nx) + " x " +
                                           std::to_string(ny) + " pixels");
}

template <class Real>
PeriodicPixels<Real>::~PeriodicPixels() = default;

template <class Real>
std::size_t PeriodicPixels<Real>::bytes() const {
    return sizeof(Real) *
           (stride_ * static_cast<std::size_t>(ny_) + plans_->buffers.size() * plans_->size());
}

// Copies complex numbers from rows to columns, or back.
template <class Real>
void to_columns(std::size_t rows, const Real* __restrict row, std::size_t row_stride,
                Real* __restrict column, std::size_t stride) {
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t c = 0; c < kColumns; ++c)
            std::copy_n(row + j * row_stride + 2 * c, 2, column + c * stride + 2 * j);
}
template <class Real>
void to_rows(std::size_t rows, const Real* __restrict column, std::size_t stride,
             Real* __restrict row, std::size_t row_stride) {
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t c = 0; c < kColumns; ++c)
            std::copy_n(column + c * stride + 2 * j, 2, row + j * row_stride + 2 * c);
}

// mode[j] *= 2/(k points), or k/(2 points), for the n modes of a column with k^2 = kx2 + ky2[j].
// `k` is for at least n + 3 numbers.
template <class Real>
void scale(Real* __restrict mode, std::size_t n, Real kx2, const Real* __restrict ky2, Real points,
           bool inverse, Real* __restrict k) {
    for (std::size_t j = 0; j < n; ++j) k[j] = kx2 + ky2[j];
    std::fill_n(k + n, 3, Real(0));
    vector_math::square_roots(k, static_cast<int>((n + 3) / 4 * 4));
    if (inverse) {
        const Real part = Real(0.5) / points;
        for (std::size_t j = 0; j < n; ++j) k[j] *= part;
    } else {
        const Real two = Real(2) / points;
        for (std::size_t j = 0; j < n; ++j) k[j] = two / k[j];
    }
    for (std::size_t j = 0; j < n; ++j) {
        mode[2 * j] *= k[j];
        mode[2 * j + 1] *= k[j];
    }
}

template <class Real>
typename PeriodicPixels<Real>::Columns PeriodicPixels<Real>::columns_from_plane(
    int block, std::size_t worker) {
    Real* const modes = plans_->buffers[worker].data();
    const Columns columns{modes, modes + plans_->length};
    to_columns(static_cast<std::size_t>(ny_), row(0) + at(block) * 2 * kColumns, stride_,
               columns.block, plans_->stride);
    return columns;
}

template <class Real>
void PeriodicPixels<Real>::columns_to_plane(int block, std::size_t worker) {
    to_rows(static_cast<std::size_t>(ny_), plans_->buffers[worker].data() + plans_->length,
            plans_->stride, row(0) + at(block) * 2 * kColumns, stride_);
}

template <class Real>
void PeriodicPixels<Real>::forward(const Columns& columns, int column) {
    Fftw<Real>::execute(plans_->column_forward,
                        as_complex(columns.block + at(column) * plans_->stride),
                        as_complex(columns.modes));
}

template <class Real>
void PeriodicPixels<Real>::backward(const Columns& columns, int column) {
    Fftw<Real>::execute(plans_->column_backward, as_complex(columns.modes),
                        as_complex(columns.block + at(column) * plans_->stride));
}

// Transforms the columns of modes, multiplies them and transforms them back while they are in the
// cache. A few columns are copied together, because their elements share cache lines.
template <class Real>
void PeriodicPixels<Real>::columns(Answer answer) {
    const int blocks = (nx_ / 2 + kColumns) / kColumns;
    const double points = static_cast<double>(nx_) * static_cast<double>(ny_);
    const auto rows = static_cast<std::size_t>(ny_);
    std::vector<Real> ky2(rows);  // (ky dx)^2
    for (int j = 0; j < ny_; ++j) {
        const double k = 2 * pi * (2 * j <= ny_ ? j : j - ny_) / ny_ * (dx_ / dy_);
        ky2[static_cast<std::size_t>(j)] = static_cast<Real>(k * k);
    }
    parallel_for(
        blocks, 1, static_cast<int>(plans_->buffers.size()), [&](int b, std::size_t worker) {
            const Columns some = columns_from_plane(b, worker);
            Real *const modes = some.modes, *const k = some.block + kColumns * plans_->stride;
            for (int c = 0; c < kColumns; ++c) {
                const int i = b * kColumns + c;
                forward(some, c);
                const double kx = 2 * pi * i / nx_;  // times dx
                if (half_space_)
                    scale(modes, rows, static_cast<Real>(kx * kx), ky2.data(),
                          static_cast<Real>(points), answer == Answer::pressure, k);
                if (!layered_.empty()) {
                    const std::size_t half = rows / 2 + 1;
                    const Real* const layered =
                        layered_.data() + static_cast<std::size_t>(i) * half;
                    for (std::size_t j = 0; j < rows; ++j) {
                        const Real share = layered[std::min(j, rows - j)],
                                   factor = answer == Answer::deflection ? share : 1 / share;
                        modes[2 * j] *= factor;
                        modes[2 * j + 1] *= factor;
                    }
                }
                if (i == 0 && half_space_) modes[0] = modes[1] = 0;
                backward(some, c);
            }
            columns_to_plane(b, worker);
        });
}

// The waves of a single row, which needs no transforms along y.
template <class Real>
void PeriodicPixels<Real>::scale_row(Answer answer) {
    Real* const modes = row(0);
    const double unit = answer == Answer::deflection ? 2.0 / nx_ : 0.5 / nx_;
    for (int i = 0; i <= nx_ / 2; ++i) {
        const double k = 2 * pi * i / nx_;  // times dx
        double factor = !half_space_ ? 1 : answer == Answer::deflection ? unit / k : unit * k;
        if (i == 0 && half_space_) factor = 0;
        const double share = !layered_.empty() ? static_cast<double>(layered_[at(i)]) : 1.0;
        factor *= answer == Answer::deflection ? share : 1 / share;
        modes[2 * i] *= static_cast<Real>(factor);
        modes[2 * i + 1] *= static_cast<Real>(factor);
    }
}

template <class Real>
void PeriodicPixels<Real>::forward_rows(const Load& load) {
    // The padding after the modes of a row is transformed with them, so it must be initialised.
    const std::size_t used = 2 * static_cast<std::size_t>(nx_ / 2 + 1);
    parallel_for(ny_, kRows, static_cast<int>(plans_->buffers.size()),
                 [&](int j, std::size_t worker) {
                     Real* const values = plans_->buffers[worker].data();
                     load(j, values);
                     Fftw<Real>::execute(plans_->row_forward, values, as_complex(row(j)));
                     std::fill(row(j) + used, row(j) + stride_, Real(0));
                 });
}

template <class Real>
void PeriodicPixels<Real>::backward_rows(const Take& take) {
    const std::size_t used = 2 * static_cast<std::size_t>(nx_ / 2 + 1);
    parallel_for(ny_, kRows, static_cast<int>(plans_->buffers.size()),
                 [&](int j, std::size_t worker) {
                     Real* const modes = plans_->buffers[worker].data();
                     std::copy_n(row(j), used, modes);
                     Fftw<Real>::execute(plans_->row_backward, as_complex(modes), row(j));
                     take(j, row(j));
                 });
}

template <class Real>
void PeriodicPixels<Real>::apply(const Load& load, const Take& take, Answer answer) {
    forward_rows(load);
    if (ny_ == 1)
        scale_row(answer);
    else
        columns(answer);
    backward_rows(take);
}

std::vector<double> modes_of(int nx, int ny, bool odd,
                             const std::function<double(int, int)>& value) {
    const std::size_t stride = at(nx) / 2 + 1;
    std::vector<std::complex<double>> plane(stride * at(ny));
    double* const values = reinterpret_cast<double*>(plane.data());
    // An odd kernel has no value half a period away.
    const auto sign = [odd](int k, int n) { return !odd || 2 * k < n ? 1 : 2 * k == n ? 0 : -1; };
    parallel_for((ny + 2) / 2, kRows, 0, [&](int j) {
        for (int i = 0; 2 * i <= nx; ++i) {
            const double v = value(i, j);
            for (const int to_j : {j, (ny - j) % ny})
                for (const int to_i : {i, (nx - i) % nx})
                    values[2 * stride * at(to_j) + at(to_i)] = v * sign(to_i, nx) * sign(to_j, ny);
        }
    });
    FftwPlan plan;
    {
        const auto lock = fftw_planning();
        plan.reset(fftw_plan_dft_r2c_2d(
            ny, nx, values, reinterpret_cast<fftw_complex*>(plane.data()), FFTW_ESTIMATE));
    }
    if (!plan) throw Error(Failure::internal, "FFTW made no plan for a kernel of pixels");
    fftw_execute(plan.get());
    std::vector<double> modes(stride * (at(ny) / 2 + 1));
    for (const auto k : indices(modes)) modes[k] = plane[k].real();
    return modes;
}

template <class Real>
VectorPixels<Real>::VectorPixels(int nx, int ny, const VectorModes& modes)
    : x_(nx, ny, 1, 1), y_(nx, ny, 1, 1) {
    const std::size_t columns = at(nx) / 2 + 1, half = at(ny) / 2 + 1;
    const double points = static_cast<double>(nx) * ny;
    const auto turned = [&](const std::vector<double>& from) {
        Array<Real> to(columns * half);
        for (const auto j : indices(half))
            for (const auto i : indices(columns))
                to[i * half + j] = static_cast<Real>(from[j * columns + i] / points);
        return to;
    };
    xx_ = turned(modes.xx);
    xy_ = turned(modes.xy);
    yy_ = turned(modes.yy);
}

template <class Real>
void VectorPixels<Real>::mix(Real* x, Real* y, int column) const {
    const auto rows = static_cast<std::size_t>(x_.ny_);
    const std::size_t half = rows / 2 + 1, from = at(column) * half;
    for (std::size_t j = 0; j < rows; ++j) {
        const bool mirrored = 2 * j > rows;
        const std::size_t k = from + (mirrored ? rows - j : j);
        const Real xx = xx_[k], yy = yy_[k], xy = mirrored ? -xy_[k] : xy_[k];
        for (const std::size_t part : {2 * j, 2 * j + 1}) {
            const Real a = x[part], b = y[part];
            x[part] = xx * a + xy * b;
            y[part] = xy * a + yy * b;
        }
    }
}

template <class Real>
void VectorPixels<Real>::apply(const Load& load, const Take& take) {
    // Rows of y are filled with those of x, and taken with them.
    x_.forward_rows([&](int j, Real* x) { load(j, x, y_.row(j)); });
    y_.forward_rows([&](int j, Real* y) { std::copy_n(y_.row(j), y_.nx_, y); });
    const int columns = x_.nx_ / 2 + 1;
    parallel_for((columns + kColumns - 1) / kColumns, 1,
                 static_cast<int>(x_.plans_->buffers.size()), [&](int b, std::size_t worker) {
                     const auto x = x_.columns_from_plane(b, worker);
                     const auto y = y_.columns_from_plane(b, worker);
                     for (int c = 0; c < std::min(kColumns, columns - b * kColumns); ++c) {
                         x_.forward(x, c);
                         y_.forward(y, c);
                         mix(x.modes, y.modes, b * kColumns + c);
                         x_.backward(x, c);
                         y_.backward(y, c);
                     }
                     x_.columns_to_plane(b, worker);
                     y_.columns_to_plane(b, worker);
                 });
    x_.backward_rows([](int, const Real*) {});
    y_.backward_rows([&](int j, const Real* y) { take(j, x_.row(j), y); });
}

template class VectorPixels<float>;
template class VectorPixels<double>;
template class PeriodicPixels<float>;
template class PeriodicPixels<double>;

}  // namespace rsc
