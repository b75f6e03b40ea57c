// Spreading onto a mesh and interpolation off it, included by the same files as the pair loops and in the same way. Plain loops
// of a fixed length: the compiler makes vector instructions of them.

template <int kWidth>  // window.width rounded up to a multiple of 4: the weights beyond it are zero
struct Weights {
    double x[kWidth], y[kWidth];
    long column, row;
    [[gnu::always_inline]] Weights(const MeshWindow& window, double u, double v) {
        const double half = 0.5 * window.width;
        column = static_cast<long>(u - half) + 1;
        row = static_cast<long>(v - half) + 1;
        const double s = 2 * (static_cast<double>(column) - u + half) - 1, t = 2 * (static_cast<double>(row) - v + half) - 1;
        for (int m = 0; m < kWidth; ++m) x[m] = y[m] = window.c[window.degree][m];
        for (int k = window.degree - 1; k >= 0; --k)
            for (int m = 0; m < kWidth; ++m) {
                x[m] = x[m] * s + window.c[k][m];
                y[m] = y[m] * t + window.c[k][m];
            }
    }
};

template <int kWidth>
inline void spread_width(const MeshWindow& window, std::size_t n, const double* u, const double* v, const double* f, double* mesh,
                         std::size_t stride) {
    for (std::size_t i = 0; i < n; ++i) {
        if (f[i] == 0) continue;
        const Weights<kWidth> w(window, u[i], v[i]);
        double* to = mesh + static_cast<std::size_t>(w.row) * stride + static_cast<std::size_t>(w.column);
        for (int r = 0; r < window.width; ++r, to += stride) {
            const double part = f[i] * w.y[r];
            for (int m = 0; m < kWidth; ++m) to[m] += part * w.x[m];
        }
    }
}

template <int kWidth>
inline void interpolate_width(const MeshWindow& window, std::size_t n, const double* u, const double* v, double* phi, const double* mesh,
                              std::size_t stride) {
    for (std::size_t i = 0; i < n; ++i) {
        const Weights<kWidth> w(window, u[i], v[i]);
        const double* from = mesh + static_cast<std::size_t>(w.row) * stride + static_cast<std::size_t>(w.column);
        double sum[kWidth] = {};
        for (int r = 0; r < window.width; ++r, from += stride)
            for (int m = 0; m < kWidth; ++m) sum[m] += w.y[r] * from[m];
        double total = 0;
        for (int m = 0; m < kWidth; ++m) total += sum[m] * w.x[m];
        phi[i] = total;
    }
}

static void spread(const MeshWindow& window, std::size_t n, const double* u, const double* v, const double* f, double* mesh,
                   std::size_t stride) {
    if (window.width <= 4) return spread_width<4>(window, n, u, v, f, mesh, stride);
    if (window.width <= 8) return spread_width<8>(window, n, u, v, f, mesh, stride);
    if (window.width <= 12) return spread_width<12>(window, n, u, v, f, mesh, stride);
    spread_width<16>(window, n, u, v, f, mesh, stride);
}

static void interpolate(const MeshWindow& window, std::size_t n, const double* u, const double* v, double* phi, const double* mesh,
                        std::size_t stride) {
    if (window.width <= 4) return interpolate_width<4>(window, n, u, v, phi, mesh, stride);
    if (window.width <= 8) return interpolate_width<8>(window, n, u, v, phi, mesh, stride);
    if (window.width <= 12) return interpolate_width<12>(window, n, u, v, phi, mesh, stride);
    interpolate_width<16>(window, n, u, v, phi, mesh, stride);
}
