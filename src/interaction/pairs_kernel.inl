// Pair loops over packs of W lanes, and the spreading window of the mesh. pairs_kernels.cpp
// includes this file once for each instruction set, in a separate namespace with its own RSC_TARGET
// and root_estimate().
//
// Layout: a few points i are kept in registers (coordinates, force, sum of potential), and the
// points j are processed in packs. 1/d of a pair is computed once and used for the sum of i and for
// phi_j. Loads and stores of j are shared by the rows i of a block.
//
// Throughput of the symmetric loop, per pack of pairs (2 W directed pairs), in instructions that
// need a multiply pipe (two of them on Zen 3 and on Intel's cores; the differences run on the add
// pipes of Zen 3):
//   single: d^2 2, rsqrt 1, Newton 3, mask 1-2, sums 2, together 9-10: 5 cycles for 16 directed
//           pairs with 8 lanes, 3.2 a cycle
//   double: d^2 2, rsqrt 1, refinement 7, mask 1-2, sums 2, conversions 1-2, together 15: 7.5
//           cycles for 8 with 4 lanes, 1.1 a cycle
// that is 10 G/s and 3.3 G/s at 3.1 GHz (EPYC, Zen 3). Measured there with AVX2: 8 to 9 G/s and 2.5
// G/s (SSE2: 3.9 and 1.2).

// Every step is done for all rows of a block before the next step, because the dependency chain of
// one row is too long for the processor's out-of-order execution.
#define RSC_FOR_ROWS _Pragma("GCC unroll 8") for (int k = 0; k < rows; ++k)

// Compiler vectors (GCC, clang) of W numbers; coordinates have type X and differences type R.
template <class R, class X, std::size_t kLanes, int kRows>
struct Pack {
    using Real = R;
    using Coordinate = X;
    static constexpr std::size_t W = kLanes;
    static constexpr int rows = kRows;
    using V [[gnu::vector_size(sizeof(R) * kLanes)]] = R;
    using C [[gnu::vector_size(sizeof(X) * kLanes)]] = X;
    RSC_TARGET static C load(const X* p) {
        C c;
        __builtin_memcpy(&c, p, sizeof c);
        return c;
    }
    RSC_TARGET static V load_real(const R* p) {
        V v;
        __builtin_memcpy(&v, p, sizeof v);
        return v;
    }
    RSC_TARGET static void store(R* p, V v) { __builtin_memcpy(p, &v, sizeof v); }
    RSC_TARGET static C splat(X a) { return C{} + a; }
    RSC_TARGET static V splat_real(double a) { return V{} + static_cast<R>(a); }
    RSC_TARGET static V difference(C a, C b) { return __builtin_convertvector(a - b, V); }
    RSC_TARGET static R sum(V v) {
        R part[W];
        __builtin_memcpy(part, &v, sizeof v);
        for (std::size_t half = W / 2; half > 0; half /= 2)
            for (std::size_t k = 0; k < half; ++k) part[k] += part[k + half];
        return part[0];
    }
    // Replaces d2 by 1/d from an estimate r; for coinciding points r is 0 and remains 0.
    RSC_TARGET static void refine(V* d2, const V* r) {
        if constexpr (sizeof(R) == 8) {
            // Binomial series of (1 - h)^(-1/2), h = 1 - d2 r^2. Estimates of 12 bits have |h| <
            // 7.4e-4, so the first neglected term is 6e-17.
            V p[rows];
            RSC_FOR_ROWS d2[k] = d2[k] * r[k];
            RSC_FOR_ROWS d2[k] = 1 - d2[k] * r[k];
            RSC_FOR_ROWS p[k] = d2[k] * (35.0 / 128) + 5.0 / 16;
            RSC_FOR_ROWS p[k] = p[k] * d2[k] + 3.0 / 8;
            RSC_FOR_ROWS p[k] = p[k] * d2[k] + 0.5;
            RSC_FOR_ROWS d2[k] = d2[k] * r[k];
            RSC_FOR_ROWS d2[k] = p[k] * d2[k] + r[k];
        } else {  // one Newton step without its factor 1/2, which gives 2/d (kSingleWeight)
            RSC_FOR_ROWS d2[k] = d2[k] * r[k];
            RSC_FOR_ROWS d2[k] = 3 - d2[k] * r[k];
            RSC_FOR_ROWS d2[k] = d2[k] * r[k];
        }
    }
};

template <class P>
struct PointWeight {
    using V = typename P::V;
    static constexpr int rows = P::rows;
    RSC_TARGET [[gnu::always_inline]] void operator()(V* d2) const {
        V r[rows];
        RSC_FOR_ROWS r[k] = root_estimate(d2[k]);
        P::refine(d2, r);
    }
};

template <class P>
struct NearWeight {
    using V = typename P::V;
    static constexpr int rows = P::rows;
    V cutoff2;
    int degree;
    V c[kNearDegree + 1];
    RSC_TARGET explicit NearWeight(const NearKernel& kernel)
        : cutoff2(P::splat_real(kernel.cutoff2)), degree(kernel.degree) {
        for (int k = 0; k <= degree; ++k) c[k] = P::splat_real(kernel.c[k]);
    }
    RSC_TARGET [[gnu::always_inline]] void operator()(V* d2) const {
        V inside[rows], smooth[rows], r[rows];
        RSC_FOR_ROWS inside[k] = cutoff2 - d2[k];
        RSC_FOR_ROWS smooth[k] = c[degree];
        for (int m = degree - 1; m >= 0; --m) RSC_FOR_ROWS smooth[k] = smooth[k] * inside[k] + c[m];
        RSC_FOR_ROWS r[k] = root_estimate(d2[k]);
        P::refine(d2, r);
        RSC_FOR_ROWS d2[k] = inside[k] > V{} ? d2[k] - smooth[k] : V{};
    }
};

// Interaction of P::rows points i with nj points j; kBoth: also of i on j.
template <class P, bool kBoth, class Weight>
RSC_TARGET [[gnu::always_inline]] inline void block(
    const Weight& weight, const typename P::Coordinate* xi, const typename P::Coordinate* yi,
    const typename P::Real* fi, typename P::Real* phi_i, std::size_t nj,
    const typename P::Coordinate* xj, const typename P::Coordinate* yj, const typename P::Real* fj,
    typename P::Real* phi_j) {
    using V = typename P::V;
    constexpr int rows = P::rows;
    typename P::C x[rows], y[rows];
    V f[rows], sum[rows];
    RSC_FOR_ROWS {
        x[k] = P::splat(xi[k]);
        y[k] = P::splat(yi[k]);
        if constexpr (kBoth) f[k] = P::splat_real(fi[k]);
        sum[k] = V{};
    }
    for (std::size_t j = 0; j < nj; j += P::W) {
        const typename P::C xs = P::load(xj + j), ys = P::load(yj + j);
        V dx[rows], w[rows];
        RSC_FOR_ROWS dx[k] = P::difference(x[k], xs);
        RSC_FOR_ROWS w[k] = P::difference(y[k], ys);
        RSC_FOR_ROWS w[k] = w[k] * w[k];
        RSC_FOR_ROWS w[k] = dx[k] * dx[k] + w[k];
        weight(w);
        const V fs = P::load_real(fj + j);
        RSC_FOR_ROWS sum[k] = w[k] * fs + sum[k];
        if constexpr (kBoth) {
            V back = P::load_real(phi_j + j);
            RSC_FOR_ROWS back = w[k] * f[k] + back;
            P::store(phi_j + j, back);
        }
    }
    RSC_FOR_ROWS phi_i[k] += P::sum(sum[k]);
}

template <class P, class Weight>
RSC_TARGET inline void cross_loop(const Weight& weight, std::size_t ni,
                                  const typename P::Coordinate* xi,
                                  const typename P::Coordinate* yi, const typename P::Real* fi,
                                  typename P::Real* phi_i, std::size_t nj,
                                  const typename P::Coordinate* xj,
                                  const typename P::Coordinate* yj, const typename P::Real* fj,
                                  typename P::Real* phi_j) {
    for (std::size_t i = 0; i < ni; i += P::rows)
        block<P, true>(weight, xi + i, yi + i, fi + i, phi_i + i, nj, xj, yj, fj, phi_j);
}

// Within a block each pair occurs twice and is used in one direction; pairs with later points are
// used in both.
template <class P, class Weight>
RSC_TARGET inline void self_loop(const Weight& weight, std::size_t n,
                                 const typename P::Coordinate* x, const typename P::Coordinate* y,
                                 const typename P::Real* f, typename P::Real* phi) {
    constexpr std::size_t kBlock = P::W > std::size_t(P::rows) ? P::W : std::size_t(P::rows);
    for (std::size_t b = 0; b < n; b += kBlock) {
        const std::size_t e = b + kBlock;
        for (std::size_t i = b; i < e; i += P::rows) {
            block<P, false>(weight, x + i, y + i, f + i, phi + i, kBlock, x + b, y + b, f + b,
                            phi + b);
            block<P, true>(weight, x + i, y + i, f + i, phi + i, n - e, x + e, y + e, f + e,
                           phi + e);
        }
    }
}

template <class P>
struct Loops {
    using R = typename P::Real;
    using X = typename P::Coordinate;
    RSC_TARGET static void self(std::size_t n, const X* x, const X* y, const R* f, R* phi) {
        self_loop<P>(PointWeight<P>{}, n, x, y, f, phi);
    }
    RSC_TARGET static void cross(std::size_t ni, const X* xi, const X* yi, const R* fi, R* phi_i,
                                 std::size_t nj, const X* xj, const X* yj, const R* fj, R* phi_j) {
        cross_loop<P>(PointWeight<P>{}, ni, xi, yi, fi, phi_i, nj, xj, yj, fj, phi_j);
    }
    RSC_TARGET static void onto(std::size_t ni, const X* xi, const X* yi, R* phi_i, std::size_t nj,
                                const X* xj, const X* yj, const R* fj) {
        for (std::size_t i = 0; i < ni; i += P::rows)
            block<P, false>(PointWeight<P>{}, xi + i, yi + i, fj, phi_i + i, nj, xj, yj, fj, phi_i);
    }
    // In a strip sorted by x, the points within reach of a block lie between two indices that
    // advance with the block.
    RSC_TARGET static void near_own(const NearKernel& kernel, std::size_t n, const X* x, const X* y,
                                    const R* f, R* phi) {
        constexpr std::size_t kBlock = P::W > std::size_t(P::rows) ? P::W : std::size_t(P::rows);
        const NearWeight<P> weight(kernel);
        std::size_t end = 0;
        for (std::size_t b = 0; b < n; b += kBlock) {
            const std::size_t e = b + kBlock;
            for (std::size_t i = b; i < e && i < n; i += P::rows) {
                const std::size_t last = i + P::rows < n ? i + P::rows - 1 : n - 1;
                while (end < n && x[end] < x[last] + kernel.reach) ++end;
                block<P, false>(weight, x + i, y + i, f + i, phi + i, kBlock, x + b, y + b, f + b,
                                phi + b);
                if (e < end)
                    block<P, true>(weight, x + i, y + i, f + i, phi + i, end - e, x + e, y + e,
                                   f + e, phi + e);
            }
        }
    }
    RSC_TARGET static void near_strips(const NearKernel& kernel, std::size_t ni, const X* xi,
                                       const X* yi, const R* fi, R* phi_i, std::size_t nj,
                                       const X* xj, const X* yj, const R* fj, R* phi_j) {
        const NearWeight<P> weight(kernel);
        std::size_t begin = 0, end = 0;
        for (std::size_t i = 0; i < ni; i += P::rows) {
            const std::size_t last = i + P::rows < ni ? i + P::rows - 1 : ni - 1;
            while (begin < nj && xj[begin] <= xi[i] - kernel.reach) ++begin;
            while (end < nj && xj[end] < xi[last] + kernel.reach) ++end;
            if (begin < end)
                block<P, true>(weight, xi + i, yi + i, fi + i, phi_i + i, end - begin, xj + begin,
                               yj + begin, fj + begin, phi_j + begin);
        }
    }
};

// Spreading onto a mesh and interpolation from it: loops of fixed length, which the compiler
// vectorises.
template <
    int kWidth>  // window.width rounded up to a multiple of 4; the additional weights are zero
struct Weights {
    double x[kWidth], y[kWidth];
    long column, row;
    RSC_TARGET [[gnu::always_inline]] Weights(const MeshWindow& window, double u, double v) {
        const double half = 0.5 * window.width;
        column = static_cast<long>(u - half) + 1;
        row = static_cast<long>(v - half) + 1;
        const double s = 2 * (static_cast<double>(column) - u + half) - 1,
                     t = 2 * (static_cast<double>(row) - v + half) - 1;
        for (int m = 0; m < kWidth; ++m) x[m] = y[m] = window.c[window.degree][m];
        for (int k = window.degree - 1; k >= 0; --k)
            for (int m = 0; m < kWidth; ++m) {
                x[m] = x[m] * s + window.c[k][m];
                y[m] = y[m] * t + window.c[k][m];
            }
    }
};

template <int kWidth>
RSC_TARGET inline void spread_width(const MeshWindow& window, std::size_t n, const double* u,
                                    const double* v, const double* f, double* mesh,
                                    std::size_t stride) {
    for (std::size_t i = 0; i < n; ++i) {
        if (f[i] == 0) continue;
        const Weights<kWidth> w(window, u[i], v[i]);
        double* to =
            mesh + static_cast<std::size_t>(w.row) * stride + static_cast<std::size_t>(w.column);
        for (int r = 0; r < window.width; ++r, to += stride) {
            const double part = f[i] * w.y[r];
            for (int m = 0; m < kWidth; ++m) to[m] += part * w.x[m];
        }
    }
}

template <int kWidth>
RSC_TARGET inline void interpolate_width(const MeshWindow& window, std::size_t n, const double* u,
                                         const double* v, double* phi, const double* mesh,
                                         std::size_t stride) {
    for (std::size_t i = 0; i < n; ++i) {
        const Weights<kWidth> w(window, u[i], v[i]);
        const double* from =
            mesh + static_cast<std::size_t>(w.row) * stride + static_cast<std::size_t>(w.column);
        double sum[kWidth] = {};
        for (int r = 0; r < window.width; ++r, from += stride)
            for (int m = 0; m < kWidth; ++m) sum[m] += w.y[r] * from[m];
        double total = 0;
        for (int m = 0; m < kWidth; ++m) total += sum[m] * w.x[m];
        phi[i] = total;
    }
}

RSC_TARGET static void spread(const MeshWindow& window, std::size_t n, const double* u,
                              const double* v, const double* f, double* mesh, std::size_t stride) {
    if (window.width <= 4) return spread_width<4>(window, n, u, v, f, mesh, stride);
    if (window.width <= 8) return spread_width<8>(window, n, u, v, f, mesh, stride);
    if (window.width <= 12) return spread_width<12>(window, n, u, v, f, mesh, stride);
    spread_width<16>(window, n, u, v, f, mesh, stride);
}

RSC_TARGET static void interpolate(const MeshWindow& window, std::size_t n, const double* u,
                                   const double* v, double* phi, const double* mesh,
                                   std::size_t stride) {
    if (window.width <= 4) return interpolate_width<4>(window, n, u, v, phi, mesh, stride);
    if (window.width <= 8) return interpolate_width<8>(window, n, u, v, phi, mesh, stride);
    if (window.width <= 12) return interpolate_width<12>(window, n, u, v, phi, mesh, stride);
    interpolate_width<16>(window, n, u, v, phi, mesh, stride);
}

template <class D, class S>
constexpr PairKernels make_table(const char* name) {
    return {name,
            {Loops<D>::self, Loops<D>::cross, Loops<D>::onto},
            {Loops<S>::self, Loops<S>::cross, Loops<S>::onto},
            Loops<D>::near_own,
            Loops<D>::near_strips,
            spread,
            interpolate};
}

#undef RSC_FOR_ROWS
