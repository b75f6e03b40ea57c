// The pair loops over a pack type P of W lanes; included once by each file that defines packs for an instruction set, inside its
// unnamed namespace, so that no two of them share a symbol.
//
// Layout: a few points i stand in registers (coordinates, force, sum of potential), the points j stream past in packs; 1/d of a
// pair is computed once, added to the sum of i and to phi_j. Loads and stores of j are shared by the rows i of a block.
//
// Throughput of the symmetric loop, per pack of pairs (2 W directed pairs), in instructions that need a multiply pipe (two of
// them on Zen 3 and on Intel's cores; the differences run on the add pipes of Zen 3):
//   single: d^2 2, rsqrt 1, Newton 3, mask 1-2, sums 2  ~ 9-10 -> 5 cycles for 16 directed pairs with 8 lanes: 3.2 a cycle
//   double: d^2 2, rsqrt 1, refinement 7, mask 1-2, sums 2, conversions 1-2 ~ 15 -> 7.5 cycles for 8 with 4 lanes: 1.1 a cycle
// that is 10 G/s and 3.3 G/s at the 3.1 GHz of the EPYC (Zen 3) this was measured on, with AVX2: 8 to 9 G/s and 2.5 G/s reached
// (SSE2: 3.9 and 1.2, plain C++: 0.7 and 0.45).

// Every step is taken for all rows of a block before the next step: the chain of one row is longer than what the out-of-order
// window of the processor could overlap by itself.
#define RSC_FOR_ROWS _Pragma("GCC unroll 8") for (int k = 0; k < P::rows; ++k)

template <class P>
struct PointWeight {
    using V = typename P::V;
    [[gnu::always_inline]] void operator()(V* d2) const {
        V r[P::rows];
        RSC_FOR_ROWS r[k] = P::root_estimate(d2[k]);
        P::refine(d2, r);
    }
};

template <class P>
struct NearWeight {
    using V = typename P::V;
    V cutoff2;
    int degree;
    V c[kNearDegree + 1];
    explicit NearWeight(const NearKernel& kernel) : cutoff2(P::splat_real(kernel.cutoff2)), degree(kernel.degree) {
        for (int k = 0; k <= degree; ++k) c[k] = P::splat_real(kernel.c[k]);
    }
    [[gnu::always_inline]] void operator()(V* d2) const {
        V inside[P::rows], smooth[P::rows], r[P::rows];
        RSC_FOR_ROWS inside[k] = P::difference(cutoff2, d2[k]);
        RSC_FOR_ROWS smooth[k] = c[degree];
        for (int m = degree - 1; m >= 0; --m) RSC_FOR_ROWS smooth[k] = P::fma(smooth[k], inside[k], c[m]);
        RSC_FOR_ROWS r[k] = P::root_estimate(d2[k]);
        P::refine(d2, r);
        RSC_FOR_ROWS d2[k] = P::difference_where_positive(d2[k], smooth[k], inside[k]);
    }
};

// P::rows points i against nj points j; kBoth: also i onto j.
template <class P, bool kBoth, class Weight>
[[gnu::always_inline]] inline void block(const Weight& weight, const typename P::Coordinate* xi, const typename P::Coordinate* yi,
                                         const typename P::Real* fi, typename P::Real* phi_i, std::size_t nj,
                                         const typename P::Coordinate* xj, const typename P::Coordinate* yj, const typename P::Real* fj,
                                         typename P::Real* phi_j) {
    using V = typename P::V;
    typename P::C x[P::rows], y[P::rows];
    V f[P::rows], sum[P::rows];
    RSC_FOR_ROWS {
        x[k] = P::splat(xi[k]);
        y[k] = P::splat(yi[k]);
        if constexpr (kBoth) f[k] = P::splat_real(fi[k]);
        sum[k] = P::splat_real(0);
    }
    for (std::size_t j = 0; j < nj; j += P::W) {
        const typename P::C xs = P::load(xj + j), ys = P::load(yj + j);
        V dx[P::rows], w[P::rows];
        RSC_FOR_ROWS dx[k] = P::difference(x[k], xs);
        RSC_FOR_ROWS w[k] = P::difference(y[k], ys);
        RSC_FOR_ROWS w[k] = P::mul(w[k], w[k]);
        RSC_FOR_ROWS w[k] = P::fma(dx[k], dx[k], w[k]);
        weight(w);
        const V fs = P::load_real(fj + j);
        RSC_FOR_ROWS sum[k] = P::fma(w[k], fs, sum[k]);
        if constexpr (kBoth) {
            V back = P::load_real(phi_j + j);
            RSC_FOR_ROWS back = P::fma(w[k], f[k], back);
            P::store(phi_j + j, back);
        }
    }
    RSC_FOR_ROWS phi_i[k] += P::sum(sum[k]);
}

template <class P, class Weight>
inline void cross_loop(const Weight& weight, std::size_t ni, const typename P::Coordinate* xi, const typename P::Coordinate* yi,
                       const typename P::Real* fi, typename P::Real* phi_i, std::size_t nj, const typename P::Coordinate* xj,
                       const typename P::Coordinate* yj, const typename P::Real* fj, typename P::Real* phi_j) {
    for (std::size_t i = 0; i < ni; i += P::rows) block<P, true>(weight, xi + i, yi + i, fi + i, phi_i + i, nj, xj, yj, fj, phi_j);
}

// Rows of a block see the block itself one way (each of its pairs comes up twice) and everything after it both ways.
template <class P, class Weight>
inline void self_loop(const Weight& weight, std::size_t n, const typename P::Coordinate* x, const typename P::Coordinate* y,
                      const typename P::Real* f, typename P::Real* phi) {
    constexpr std::size_t kBlock = P::W > std::size_t(P::rows) ? P::W : std::size_t(P::rows);
    for (std::size_t b = 0; b < n; b += kBlock) {
        const std::size_t e = b + kBlock;
        for (std::size_t i = b; i < e; i += P::rows) {
            block<P, false>(weight, x + i, y + i, f + i, phi + i, kBlock, x + b, y + b, f + b, phi + b);
            block<P, true>(weight, x + i, y + i, f + i, phi + i, n - e, x + e, y + e, f + e, phi + e);
        }
    }
}

template <class P>
struct Loops {
    using R = typename P::Real;
    using X = typename P::Coordinate;
    static void self(std::size_t n, const X* x, const X* y, const R* f, R* phi) { self_loop<P>(PointWeight<P>{}, n, x, y, f, phi); }
    static void cross(std::size_t ni, const X* xi, const X* yi, const R* fi, R* phi_i, std::size_t nj, const X* xj, const X* yj,
                      const R* fj, R* phi_j) {
        cross_loop<P>(PointWeight<P>{}, ni, xi, yi, fi, phi_i, nj, xj, yj, fj, phi_j);
    }
    static void onto(std::size_t ni, const X* xi, const X* yi, R* phi_i, std::size_t nj, const X* xj, const X* yj, const R* fj) {
        for (std::size_t i = 0; i < ni; i += P::rows)
            block<P, false>(PointWeight<P>{}, xi + i, yi + i, fj, phi_i + i, nj, xj, yj, fj, phi_i);
    }
    // Strips by increasing x: the points within reach of a block lie between two marks that move along with it.
    static void near_own(const NearKernel& kernel, std::size_t n, const X* x, const X* y, const R* f, R* phi) {
        constexpr std::size_t kBlock = P::W > std::size_t(P::rows) ? P::W : std::size_t(P::rows);
        const NearWeight<P> weight(kernel);
        std::size_t end = 0;
        for (std::size_t b = 0; b < n; b += kBlock) {
            const std::size_t e = b + kBlock;
            for (std::size_t i = b; i < e && i < n; i += P::rows) {
                const std::size_t last = i + P::rows < n ? i + P::rows - 1 : n - 1;
                while (end < n && x[end] < x[last] + kernel.reach) ++end;
                block<P, false>(weight, x + i, y + i, f + i, phi + i, kBlock, x + b, y + b, f + b, phi + b);
                if (e < end) block<P, true>(weight, x + i, y + i, f + i, phi + i, end - e, x + e, y + e, f + e, phi + e);
            }
        }
    }
    static void near_strips(const NearKernel& kernel, std::size_t ni, const X* xi, const X* yi, const R* fi, R* phi_i, std::size_t nj,
                            const X* xj, const X* yj, const R* fj, R* phi_j) {
        const NearWeight<P> weight(kernel);
        std::size_t begin = 0, end = 0;
        for (std::size_t i = 0; i < ni; i += P::rows) {
            const std::size_t last = i + P::rows < ni ? i + P::rows - 1 : ni - 1;
            while (begin < nj && xj[begin] <= xi[i] - kernel.reach) ++begin;
            while (end < nj && xj[end] < xi[last] + kernel.reach) ++end;
            if (begin < end)
                block<P, true>(weight, xi + i, yi + i, fi + i, phi_i + i, end - begin, xj + begin, yj + begin, fj + begin, phi_j + begin);
        }
    }
};

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
