#include "contact/interaction/periodic_pixels.hpp"

#include "error.hpp"
#include "rough/library_lock.hpp"
#include "rough/parallel.hpp"
#include "rough/surface.hpp"

namespace rsc {
namespace {

constexpr std::size_t kThreads = 400000;  // number of pixels above which threads are used
constexpr std::size_t kLine = 64;         // bytes
constexpr int kColumns = 8;               // columns transformed together
constexpr int kRows = 8;                  // that a thread takes at a time

// Names of FFTW in single and double precision.
template <class Real>
struct Fftw;
template <>
struct Fftw<double> {
    using Complex = fftw_complex;
    using Plan = FftwPlan;
    static Plan rows_forward(int n, double* p) { return Plan(fftw_plan_dft_r2c_1d(n, p, reinterpret_cast<Complex*>(p), FFTW_ESTIMATE)); }
    static Plan rows_backward(int n, double* p) { return Plan(fftw_plan_dft_c2r_1d(n, reinterpret_cast<Complex*>(p), p, FFTW_ESTIMATE)); }
    static Plan columns(int n, double* p, int sign) {
        auto* c = reinterpret_cast<Complex*>(p);
        return Plan(fftw_plan_many_dft(1, &n, kColumns, c, nullptr, kColumns, 1, c, nullptr, kColumns, 1, sign, FFTW_ESTIMATE));
    }
    static void forward(const Plan& plan, double* p) { fftw_execute_dft_r2c(plan.get(), p, reinterpret_cast<Complex*>(p)); }
    static void backward(const Plan& plan, double* p) { fftw_execute_dft_c2r(plan.get(), reinterpret_cast<Complex*>(p), p); }
    static void complex(const Plan& plan, double* p) {
        fftw_execute_dft(plan.get(), reinterpret_cast<Complex*>(p), reinterpret_cast<Complex*>(p));
    }
};
template <>
struct Fftw<float> {
    using Complex = fftwf_complex;
    using Plan = FftwfPlan;
    static Plan rows_forward(int n, float* p) { return Plan(fftwf_plan_dft_r2c_1d(n, p, reinterpret_cast<Complex*>(p), FFTW_ESTIMATE)); }
    static Plan rows_backward(int n, float* p) { return Plan(fftwf_plan_dft_c2r_1d(n, reinterpret_cast<Complex*>(p), p, FFTW_ESTIMATE)); }
    static Plan columns(int n, float* p, int sign) {
        auto* c = reinterpret_cast<Complex*>(p);
        return Plan(fftwf_plan_many_dft(1, &n, kColumns, c, nullptr, kColumns, 1, c, nullptr, kColumns, 1, sign, FFTW_ESTIMATE));
    }
    static void forward(const Plan& plan, float* p) { fftwf_execute_dft_r2c(plan.get(), p, reinterpret_cast<Complex*>(p)); }
    static void backward(const Plan& plan, float* p) { fftwf_execute_dft_c2r(plan.get(), reinterpret_cast<Complex*>(p), p); }
    static void complex(const Plan& plan, float* p) {
        fftwf_execute_dft(plan.get(), reinterpret_cast<Complex*>(p), reinterpret_cast<Complex*>(p));
    }
};

}  // namespace

template <class Real>
struct PeriodicPixels<Real>::Plans {
    typename Fftw<Real>::Plan rows_forward, rows_backward, columns_forward, columns_backward;
    std::vector<Memory> blocks;  // columns being transformed, one block per thread
};

template <class Real>
void PeriodicPixels<Real>::Free::operator()(Real* p) const noexcept {
    HeightMap::Free()(reinterpret_cast<double*>(p));
}

template <class Real>
typename PeriodicPixels<Real>::Memory PeriodicPixels<Real>::allocate(std::size_t n) {
    constexpr std::size_t each = sizeof(double) / sizeof(Real);
    return Memory(reinterpret_cast<Real*>(allocate_doubles((n + each - 1) / each, "the pressures on all pixels")));
}

template <class Real>
PeriodicPixels<Real>::PeriodicPixels(int nx, int ny, double dx, double dy, const std::function<double(double)>& share)
    : nx_(nx),
      ny_(ny),
      dx_(dx),
      dy_(dy),
      threads_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) >= kThreads),
      plans_(std::make_unique<Plans>()) {
    // Rows hold whole blocks of columns and are an odd number of cache lines apart, so that the elements of a column do not share cache
    // sets.
    constexpr std::size_t line = kLine / sizeof(Real);
    std::size_t lines = (2 * static_cast<std::size_t>((nx / 2 + kColumns) / kColumns * kColumns) + line - 1) / line;
    lines += lines % 2 == 0;
    stride_ = lines * line;
    plane_ = allocate(stride_ * static_cast<std::size_t>(ny));
    const int threads = threads_ ? static_cast<int>(most_threads(0)) : 1;
    for (int t = 0; t < threads; ++t) plans_->blocks.push_back(allocate(2 * kColumns * static_cast<std::size_t>(ny)));
    const auto lock = fftw_planning();
    Real *const rows = plane_.get(), *const block = plans_->blocks[0].get();
    plans_->rows_forward = Fftw<Real>::rows_forward(nx, rows);
    plans_->rows_backward = Fftw<Real>::rows_backward(nx, rows);
    plans_->columns_forward = Fftw<Real>::columns(ny, block, FFTW_FORWARD);
    plans_->columns_backward = Fftw<Real>::columns(ny, block, FFTW_BACKWARD);
    if (!plans_->rows_forward || !plans_->rows_backward || !plans_->columns_forward || !plans_->columns_backward)
        throw Error(Failure::internal, "FFTW made no plan for " + std::to_string(nx) + " x " + std::to_string(ny) + " pixels");
    if (!share) return;
    const int columns = (nx / 2 + kColumns) / kColumns * kColumns, half = ny / 2 + 1;
    layered_ = allocate(static_cast<std::size_t>(columns) * static_cast<std::size_t>(half));
    const double pi = std::numbers::pi;
    parallel_for(half, kRows, threads, [&](int j) {
        for (int i = 0; i < columns; ++i) {
            const double k = 2 * pi * std::hypot(static_cast<double>(i) / nx / dx, static_cast<double>(j) / ny / dy);
            layered_[static_cast<std::size_t>((i / kColumns * half + j) * kColumns + i % kColumns)] =
                static_cast<Real>(k > 0 ? 1 + share(k) : 1.0);
        }
    });
}

template <class Real>
PeriodicPixels<Real>::~PeriodicPixels() = default;

template <class Real>
std::size_t PeriodicPixels<Real>::bytes() const {
    return sizeof(Real) * (stride_ * static_cast<std::size_t>(ny_) + plans_->blocks.size() * 2 * kColumns * static_cast<std::size_t>(ny_));
}

// Transforms the columns of modes, a few at a time, multiplies them and transforms them back while they are in the cache.
template <class Real>
void PeriodicPixels<Real>::columns(Answer answer) {
    const int blocks = (nx_ / 2 + kColumns) / kColumns;
    const double pi = std::numbers::pi, points = static_cast<double>(nx_) * static_cast<double>(ny_);
    std::vector<Real> ky2(static_cast<std::size_t>(ny_));  // (ky dx)^2
    for (int j = 0; j < ny_; ++j) {
        const double k = 2 * pi * (2 * j <= ny_ ? j : j - ny_) / ny_ * (dx_ / dy_);
        ky2[static_cast<std::size_t>(j)] = static_cast<Real>(k * k);
    }
    parallel_for(blocks, 1, static_cast<int>(plans_->blocks.size()), [&](int b, std::size_t worker) {
        constexpr std::size_t width = 2 * kColumns;
        Real* const block = plans_->blocks[worker].get();
        Real* const plane = plane_.get() + static_cast<std::size_t>(b) * width;
        const auto rows = static_cast<std::size_t>(ny_);
        for (std::size_t j = 0; j < rows; ++j) std::copy_n(plane + j * stride_, width, block + j * width);
        Fftw<Real>::complex(plans_->columns_forward, block);
        Real kx2[kColumns];  // (kx dx)^2
        for (int c = 0; c < kColumns; ++c) {
            const double k = 2 * pi * (b * kColumns + c) / nx_;
            kx2[c] = static_cast<Real>(k * k);
        }
        const auto two = static_cast<Real>(2 / points), part = static_cast<Real>(0.5 / points);
        for (std::size_t j = 0; j < rows; ++j) {
            Real factor[kColumns];
            if (answer == Answer::deflection)
                for (int c = 0; c < kColumns; ++c) factor[c] = two / std::sqrt(kx2[c] + ky2[j]);
            else
                for (int c = 0; c < kColumns; ++c) factor[c] = part * std::sqrt(kx2[c] + ky2[j]);
            if (layered_) {
                const std::size_t half = rows / 2 + 1, row = (static_cast<std::size_t>(b) * half + std::min(j, rows - j)) * kColumns;
                const Real* const layered = layered_.get() + row;
                for (int c = 0; c < kColumns; ++c)
                    factor[c] = answer == Answer::deflection ? factor[c] * layered[c] : factor[c] / layered[c];
            }
            if (b == 0 && j == 0) factor[0] = 0;
            Real* const value = block + j * width;
            for (int c = 0; c < kColumns; ++c) value[2 * c] *= factor[c], value[2 * c + 1] *= factor[c];
        }
        Fftw<Real>::complex(plans_->columns_backward, block);
        for (std::size_t j = 0; j < rows; ++j) std::copy_n(block + j * width, width, plane + j * stride_);
    });
}

template <class Real>
void PeriodicPixels<Real>::apply(const Load& load, const Take& take, Answer answer) {
    const int threads = static_cast<int>(plans_->blocks.size());
    // The padding after the modes of a row is transformed with them, so it must be initialised.
    const std::size_t used = 2 * static_cast<std::size_t>(nx_ / 2 + 1);
    parallel_for(ny_, kRows, threads, [&](int j) {
        load(j, row(j));
        Fftw<Real>::forward(plans_->rows_forward, row(j));
        std::fill(row(j) + used, row(j) + stride_, Real(0));
    });
    columns(answer);
    parallel_for(ny_, kRows, threads, [&](int j) {
        Fftw<Real>::backward(plans_->rows_backward, row(j));
        take(j, row(j));
    });
}

template class PeriodicPixels<float>;
template class PeriodicPixels<double>;

}  // namespace rsc
