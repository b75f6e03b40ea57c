#include "interaction/lattice.hpp"

#include "base/dispatch.hpp"
#include "base/error.hpp"
#include "base/format.hpp"
#include "interaction/kernel.hpp"

namespace rsc {
namespace {

constexpr double kSmallErfc = 6;  // erfc(6) = 2e-17

// Ewald sum on a cell of sides a and b with a b = 1 and the parameter sqrt(pi), for which both
// parts need the same small number of terms.
class Ewald {
public:
    Ewald(double a, double b) : a_(a), b_(b) {
        const double most = kSmallErfc / std::sqrt(pi);
        images_x_ = static_cast<int>(most / a) + 2;
        images_y_ = static_cast<int>(most / b) + 2;
        const int mx = static_cast<int>(most * a) + 1, my = static_cast<int>(most * b) + 1;
        for (int m = 0; m <= mx; ++m)
            for (int n = 0; n <= my; ++n) {
                if (m == 0 && n == 0) continue;
                const double kx = 2 * pi * m / a, ky = 2 * pi * n / b, k = std::hypot(kx, ky);
                const double signs = (m > 0 ? 2 : 1) * (n > 0 ? 2 : 1);
                modes_.push_back({kx, ky, signs * 2 * pi * std::erfc(k / (2 * std::sqrt(pi))) / k});
            }
    }

    // Potential at (x, y) in [0, a/2] x [0, b/2] minus 1/d of the images at (0, 0), (a, 0), (0, b),
    // (a, b).
    double rest(double x, double y) const {
        double sum = -2;  // background
        for (int m = -images_x_; m <= images_x_; ++m)
            for (int n = -images_y_; n <= images_y_; ++n) {
                const double d = std::hypot(x - m * a_, y - n * b_), z = std::sqrt(pi) * d;
                const bool around = (m == 0 || m == 1) && (n == 0 || n == 1);
                if (around)
                    sum -= d > 0 ? std::erf(z) / d : 2.0;  // erf(sqrt(pi) d)/d -> 2
                else
                    sum += std::erfc(z) / d;
            }
        for (const Mode& k : modes_) sum += k.weight * std::cos(k.x * x) * std::cos(k.y * y);
        return sum;
    }

private:
    struct Mode {
        double x, y, weight;
    };
    double a_, b_;
    int images_x_, images_y_;
    std::vector<Mode> modes_;
};

constexpr int kNodes = 28;

// Converts values at Chebyshev nodes cos(pi (i + 1/2)/n), `stride` apart, to coefficients of
// Chebyshev polynomials.
void chebyshev(double* values, std::size_t stride) {
    double result[kNodes];
    for (int k = 0; k < kNodes; ++k) {
        double sum = 0;
        for (int i = 0; i < kNodes; ++i)
            sum += values[static_cast<std::size_t>(i) * stride] *
                   std::cos(pi * k * (i + 0.5) / kNodes);
        result[k] = sum * (k == 0 ? 1 : 2) / kNodes;
    }
    for (int k = 0; k < kNodes; ++k) values[static_cast<std::size_t>(k) * stride] = result[k];
}

// Converts coefficients of Chebyshev polynomials up to a degree to those of powers.
void powers(double* values, std::size_t stride, int degree) {
    double sum[kNodes] = {}, t0[kNodes] = {1}, t1[kNodes] = {0, 1}, t2[kNodes];
    for (int k = 0; k <= degree; ++k) {
        for (int m = 0; m <= degree; ++m)
            sum[m] += values[static_cast<std::size_t>(k) * stride] * t0[m];
        for (int m = 0; m <= degree; ++m) t2[m] = (m > 0 ? 2 * t1[m - 1] : 0) - t0[m];
        std::copy_n(t1, kNodes, t0);
        std::copy_n(t2, kNodes, t1);
    }
    for (int m = 0; m <= degree; ++m) values[static_cast<std::size_t>(m) * stride] = sum[m];
}

constexpr std::size_t kBlock = 64;  // sources processed together

struct Task {
    double Lx, Ly, x, y;  // of the target
    const double *xs, *ys;
    const double* c;
    int degree;
    double* value;  // Gamma of kBlock sources
};

// Nearest integer, by adding a number so large that fractions are rounded off.
RSC_ALWAYS_INLINE double whole(double t) {
    constexpr double big = 0x1.8p52;
    return (t + big) - big;
}

RSC_ALWAYS_INLINE double inverse(double d2) { return d2 > 0 ? 1 / std::sqrt(d2) : 0.0; }

RSC_ALWAYS_INLINE void lattice_body(const Task& task) {
    double u[kBlock], v[kBlock], inner[kBlock], sum[kBlock], near[kBlock];
    const double inverse_x = 1 / task.Lx, inverse_y = 1 / task.Ly;
    for (std::size_t j = 0; j < kBlock; ++j) {
        double dx = task.x - task.xs[j], dy = task.y - task.ys[j];
        dx = std::abs(dx - task.Lx * whole(dx * inverse_x));
        dy = std::abs(dy - task.Ly * whole(dy * inverse_y));
        const double ex = task.Lx - dx, ey = task.Ly - dy, s = 1 - 2 * dx * inverse_x,
                     t = 1 - 2 * dy * inverse_y;
        u[j] = 2 * s * s - 1;
        v[j] = 2 * t * t - 1;
        near[j] = inverse(dx * dx + dy * dy) +
                  (inverse(ex * ex + dy * dy) +
                   (inverse(dx * dx + ey * ey) + inverse(ex * ex + ey * ey)));
        sum[j] = 0;
    }
    const double* c = task.c + (task.degree + 1) * (task.degree + 2) / 2;
    for (int a = task.degree; a >= 0; --a) {
        c -= task.degree - a + 1;
        for (std::size_t j = 0; j < kBlock; ++j) inner[j] = c[task.degree - a];
        for (int b = task.degree - a - 1; b >= 0; --b)
            for (std::size_t j = 0; j < kBlock; ++j) inner[j] = inner[j] * v[j] + c[b];
        for (std::size_t j = 0; j < kBlock; ++j) sum[j] = sum[j] * u[j] + inner[j];
    }
    for (std::size_t j = 0; j < kBlock; ++j) task.value[j] = near[j] + sum[j];
}

RSC_DISPATCH(lattice_values, lattice_body, (const Task& task), (task))

}  // namespace

// Sums over the modes m >= 0 and n >= 0 with a relevant share, row by row: the sums over n for all
// y first.
std::vector<double> Lattice::shares(const std::vector<double>& x,
                                    const std::vector<double>& y) const {
    // share(k) decays like exp(-k scale) (SmoothPart).
    constexpr double gone = 44, most = 6000;
    const double end = gone / smooth_->scale(), ux = 2 * pi / period_.x, uy = 2 * pi / period_.y;
    if (!(end / std::min(ux, uy) < most))
        throw Error(Failure::bad_input,
                    "layers so much thinner than the period need solver%model = 'elements' between "
                    "two flats (the top one must be at least " +
                        text_of(gone / (4 * pi * most)) + " of the longer side thick)");
    const int rows = static_cast<int>(end / uy);
    const std::size_t nx = x.size(), ny = y.size();
    std::vector<double> wave(static_cast<std::size_t>(rows + 1) * ny), inner(ny), sum(nx * ny);
    for (int n = 0; n <= rows; ++n)
        for (std::size_t j = 0; j < ny; ++j)
            wave[static_cast<std::size_t>(n) * ny + j] = (n > 0 ? 2 : 1) * std::cos(uy * n * y[j]);
    for (int m = 0; m * ux <= end; ++m) {
        std::fill(inner.begin(), inner.end(), 0.0);
        for (int n = m > 0 ? 0 : 1; n <= rows; ++n) {
            const double k = std::hypot(ux * m, uy * n);
            if (k > end) break;
            const double part = smooth_->share(k) / k, *const row =
                                                           wave.data() +
                                                           static_cast<std::size_t>(n) * ny;
            for (std::size_t j = 0; j < ny; ++j) inner[j] += part * row[j];
        }
        for (std::size_t i = 0; i < nx; ++i) {
            const double c = (m > 0 ? 2 : 1) * 2 * pi / period_.area() * std::cos(ux * m * x[i]);
            for (std::size_t j = 0; j < ny; ++j) sum[i * ny + j] += c * inner[j];
        }
    }
    return sum;
}

namespace {

void require_shape(const Period& period) {
    const double longer = std::max(period.x, period.y), shorter = std::min(period.x, period.y);
    if (!(shorter > 0) || !period.finite())
        throw Error(Failure::bad_input,
                    "the sides of a periodic surface must be positive and finite");
    if (longer > Lattice::kMostAspect * shorter) {
        throw Error(Failure::bad_input, "periodic surface of sides " + text_of(period.x) + " and " +
                                            text_of(period.y) +
                                            ": the longer may be at most 4 times the shorter");
    }
}

// Turns values at the nodes, row by row, into coefficients of powers. Returns the degree beyond
// which nothing is left.
int to_powers(std::vector<double>& table) {
    for (std::size_t k = 0; k < kNodes; ++k) chebyshev(&table[k * kNodes], 1);
    for (std::size_t k = 0; k < kNodes; ++k) chebyshev(&table[k], kNodes);
    const auto tail = [&](int degree) {  // magnitude of the truncated terms
        double sum = 0;
        for (int i = 0; i < kNodes; ++i)
            for (int j = std::max(0, degree + 1 - i); j < kNodes; ++j)
                sum += std::abs(table[static_cast<std::size_t>(i * kNodes + j)]);
        return sum;
    };
    int degree = 1;
    while (degree < kNodes - 1 && tail(degree) > tail(kNodes - 1) + 2e-14) ++degree;
    for (int i = 0; i < kNodes; ++i)
        for (int j = std::max(0, degree + 1 - i); j < kNodes; ++j)
            table[static_cast<std::size_t>(i * kNodes + j)] = 0;
    for (std::size_t k = 0; k < kNodes; ++k) powers(&table[k * kNodes], 1, degree);
    for (std::size_t k = 0; k < kNodes; ++k) powers(&table[k], kNodes, degree);
    return degree;
}

}  // namespace

Lattice::Lattice(Period period, const SmoothPart* smooth, double near)
    : period_(period), smooth_(smooth), near_(near) {
    require_shape(period);
    const double unit = std::sqrt(period.x) * std::sqrt(period.y), a = period.x / unit,
                 b = period.y / unit;
    const Ewald ewald(a, b);
    std::vector<double> table(kNodes * kNodes);
    for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j < kNodes; ++j) {
            const auto place = [](int k, double side) {
                return side / 2 * (1 - std::sqrt((1 + std::cos(pi * (k + 0.5) / kNodes)) / 2));
            };
            table[static_cast<std::size_t>(i * kNodes + j)] = ewald.rest(place(i, a), place(j, b));
        }
    const double own = smooth ? add_smooth(unit, table) : 0;
    degree_ = to_powers(table);
    for (int i = 0; i <= degree_; ++i)
        for (int j = 0; j <= degree_ - i; ++j)
            c_.push_back(table[static_cast<std::size_t>(i * kNodes + j)] / unit);
    self_ = ewald.rest(0, 0) / unit + 1 / period.x + 1 / period.y +
            1 / std::hypot(period.x, period.y) + own;
    least_ = at(period.x / 2, period.y / 2);
    if (smooth) search_least();
}

// Adds the smooth part, without that of the four nearest images, to the values at the nodes.
// Returns its value at the source.
double Lattice::add_smooth(double unit, std::vector<double>& table) const {
    // Contribution of the four images around the offset (x, y).
    const auto around = [&](double x, double y) {
        const double ex = period_.x - x, ey = period_.y - y;
        return smooth(x, y) + smooth(ex, y) + smooth(x, ey) + smooth(ex, ey);
    };
    std::vector<double> x, y;
    for (int k = 0; k < kNodes; ++k) {
        const double part = 0.5 * (1 - std::sqrt((1 + std::cos(pi * (k + 0.5) / kNodes)) / 2));
        x.push_back(part * period_.x);
        y.push_back(part * period_.y);
    }
    x.push_back(0);
    y.push_back(0);
    const std::vector<double> sum = shares(x, y);
    for (std::size_t i = 0; i < kNodes; ++i)
        for (std::size_t j = 0; j < kNodes; ++j)
            table[i * kNodes + j] += unit * (sum[i * (kNodes + 1) + j] - around(x[i], y[j]));
    return sum.back();
}

// A soft layer on a stiff base bulges around a force, so the minimum is searched.
void Lattice::search_least() {
    double largest = least_;
    constexpr int rays = 16;
    for (double d = 0.01 * smooth_->scale(); d < 0.75 * (period_.x + period_.y); d *= 1.01)
        for (int ray = 0; ray <= rays; ++ray) {
            const double angle = 0.5 * pi * ray / rays;
            const double x = d * std::cos(angle), y = d * std::sin(angle);
            const double value = at(x, y);
            if (x <= period_.x / 2 && y <= period_.y / 2) {
                least_ = std::min(least_, value);
                largest = std::max(largest, std::abs(least_));
            }
        }
    least_ -= 1e-2 * largest;  // between the places asked
}

double Lattice::smooth(double x, double y) const {
    return smooth_ ? smooth_->at_square(x * x + y * y) / near_ : 0.0;
}

double Lattice::nearest_smooth(double dx, double dy) const {
    return smooth(period_.nearest_x(dx), period_.nearest_y(dy));
}

double Lattice::polynomial(double u, double v) const {
    const double* c = c_.data() + c_.size();
    double sum = 0;
    for (int a = degree_; a >= 0; --a) {
        c -= degree_ - a + 1;
        double inner = c[degree_ - a];
        for (int b = degree_ - a - 1; b >= 0; --b) inner = inner * v + c[b];
        sum = sum * u + inner;
    }
    return sum;
}

double Lattice::rest(double dx, double dy) const {
    const double x = std::abs(period_.nearest_x(dx)), y = std::abs(period_.nearest_y(dy));
    const double ex = period_.x - x, ey = period_.y - y, s = 1 - 2 * x / period_.x,
                 t = 1 - 2 * y / period_.y;
    return polynomial(2 * s * s - 1, 2 * t * t - 1) + 1 / std::sqrt(ex * ex + y * y) +
           1 / std::sqrt(x * x + ey * ey) + 1 / std::sqrt(ex * ex + ey * ey) +
           (smooth_ ? smooth(ex, y) + smooth(x, ey) + smooth(ex, ey) : 0.0);
}

double Lattice::at(double dx, double dy) const {
    const double x = period_.nearest_x(dx), y = period_.nearest_y(dy);
    return 1 / std::sqrt(x * x + y * y) + smooth(x, y) + rest(x, y);
}

void Lattice::potential(std::size_t n_targets, const double* xt, const double* yt,
                        std::size_t n_sources, const double* xs, const double* ys, const double* fs,
                        double* phi) const {
    double x[kBlock], y[kBlock], f[kBlock], value[kBlock];
    const auto add_smooth = [&](double xi, double yi, const double* xj, const double* yj,
                                double* to) {
        double square[4 * kBlock], s[4 * kBlock];
        for (std::size_t k = 0; k < kBlock; ++k) {
            const double dx = std::abs((xi - xj[k]) - period_.x * whole((xi - xj[k]) / period_.x)),
                         dy = std::abs((yi - yj[k]) - period_.y * whole((yi - yj[k]) / period_.y));
            const double ex = period_.x - dx, ey = period_.y - dy;
            square[k] = dx * dx + dy * dy;
            square[kBlock + k] = ex * ex + dy * dy;
            square[2 * kBlock + k] = dx * dx + ey * ey;
            square[3 * kBlock + k] = ex * ex + ey * ey;
        }
        for (std::size_t image = 0; image < 4; ++image)
            smooth_->table().values(kBlock, square + image * kBlock, s + image * kBlock);
        for (std::size_t k = 0; k < kBlock; ++k)
            to[k] += (s[k] + s[kBlock + k] + s[2 * kBlock + k] + s[3 * kBlock + k]) / near_;
    };
    static_assert(kBlock == SquareTable::kBlock);
    std::fill_n(phi, n_targets, 0.0);
    for (std::size_t j = 0; j < n_sources; j += kBlock) {
        const std::size_t count = std::min(kBlock, n_sources - j);
        for (std::size_t k = 0; k < kBlock; ++k) {
            const std::size_t from = j + std::min(k, count - 1);
            x[k] = xs[from];
            y[k] = ys[from];
            f[k] = k < count ? fs[from] : 0;
        }
        for (std::size_t i = 0; i < n_targets; ++i) {
            lattice_values({period_.x, period_.y, xt[i], yt[i], x, y, c_.data(), degree_, value});
            if (smooth_) add_smooth(xt[i], yt[i], x, y, value);
            double sum = 0;
            for (std::size_t k = 0; k < kBlock; ++k) sum += f[k] * value[k];
            phi[i] += sum;
        }
    }
}

}  // namespace rsc
