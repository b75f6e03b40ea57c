// Deflections of a surface that repeats under pressures on all its pixels: products with K by Fourier transforms over the whole period.
#pragma once

#include "std.hpp"

namespace rsc {

// A half-space of modulus E* whose nx x ny pixels of sides dx, dy repeat in both directions. Pressures are the values of a band-limited
// surface at the pixels' middles: each of the modes exp(i k x) that the pixels carry, |kx| <= pi/dx and |ky| <= pi/dy, answers with
// 2/(E* |k|) (1 + share(|k|)) of itself (Johnson 1985, section 13.2; kernel.hpp), k = 0 with none: deflections are those from the mean plane, whatever the mean pressure.
// K is symmetric, and positive definite but for k = 0. Numbers are those of Real, float or double; results do not depend on the number
// of threads.
template <class Real>
class PeriodicPixels {
public:
    // `share` takes wavenumbers in the unit 1/dx; none: a homogeneous half-space. Throws Error(no_memory); bad_input for a grid too large.
    PeriodicPixels(int nx, int ny, double dx, double dy, const std::function<double(double)>& share = {});
    ~PeriodicPixels();
    PeriodicPixels(const PeriodicPixels&) = delete;
    PeriodicPixels& operator=(const PeriodicPixels&) = delete;

    // Row j of the plane that transforms work on, nx numbers.
    Real* row(int j) { return plane_.get() + static_cast<std::size_t>(j) * stride_; }
    const Real* row(int j) const { return plane_.get() + static_cast<std::size_t>(j) * stride_; }

    enum class Answer { deflection, pressure };
    // Replaces the plane by K/unit() of it, or by unit() K^-1 of it with mean 0. `load(j, row)` fills each row first, `take(j, row)` may
    // look at it at the end; both are called for different rows at the same time.
    using Load = std::function<void(int, Real*)>;
    using Take = std::function<void(int, const Real*)>;
    void apply(const Load& load, const Take& take, Answer answer = Answer::deflection);

    // dx/E*, for E* = 1 [length/pressure]: the plane holds numbers without it, which are of the order of 1 in float, too.
    double unit() const { return dx_; }

    std::size_t bytes() const;

private:
    void columns(Answer answer);

    struct Free {
        void operator()(Real* p) const noexcept;
    };
    struct Plans;
    using Memory = std::unique_ptr<Real[], Free>;
    static Memory allocate(std::size_t n);

    int nx_, ny_;
    double dx_, dy_;
    std::size_t stride_;
    bool threads_;
    Memory plane_;
    Memory layered_;  // 1 + share of the modes with ky >= 0, [column block][row][column]; none for a homogeneous half-space
    std::unique_ptr<Plans> plans_;
};

extern template class PeriodicPixels<float>;
extern template class PeriodicPixels<double>;

}  // namespace rsc
