// The contact of two flats that repeat, solved on the points of the surface: independent of everything in src. Conjugate gradients on the
// pressures with their mean given (Polonsky and Keer 1999), the answer of a mode of pressure being 2/(E* |k|).
#pragma once

#include "std.hpp"

#include <fftw3.h>

struct PeriodicElements {
    double separation = 0;     // of the flat from the mean plane of the deformed surface
    double area_fraction = 0;  // of the points under pressure
    double border = 0;         // the same less (pi - 1 + ln 2)/24 a side of the border (Yastrebov, Anciaux, Molinari 2017)
    double gap = 0;            // largest |gap| under pressure and penetration elsewhere, over the rms height
    int iterations = 0;
};

class PeriodicElementSolver {
public:
    // Heights row by row, n x n points on the square of side L.
    PeriodicElementSolver(int n, double L, std::vector<double> heights, double E_star) : n_(n), z_(std::move(heights)) {
        const auto points = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
        real_.resize(points);
        modes_.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n / 2 + 1));
        forward_ = fftw_plan_dft_r2c_2d(n, n, real_.data(), reinterpret_cast<fftw_complex*>(modes_.data()), FFTW_ESTIMATE);
        backward_ = fftw_plan_dft_c2r_2d(n, n, reinterpret_cast<fftw_complex*>(modes_.data()), real_.data(), FFTW_ESTIMATE);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i <= n / 2; ++i) {
                const double k = 2 * std::numbers::pi / L * std::hypot(i, j <= n / 2 ? j : j - n);
                answer_.push_back(k > 0 ? 2 / (E_star * k) / static_cast<double>(points) : 0);
            }
        double mean = 0, square = 0;
        for (double z : z_) mean += z / static_cast<double>(points);
        for (double& z : z_) z -= mean, square += z * z / static_cast<double>(points);
        rms_ = std::sqrt(square);
        p_.assign(points, 1.0);
    }
    ~PeriodicElementSolver() { fftw_destroy_plan(forward_), fftw_destroy_plan(backward_); }
    PeriodicElementSolver(const PeriodicElementSolver&) = delete;
    PeriodicElementSolver& operator=(const PeriodicElementSolver&) = delete;

    // Of any pressures, their mean left out.
    std::vector<double> deflections(const std::vector<double>& p) {
        std::vector<double> u;
        product(p, u);
        return u;
    }

    // Goes on from the last pressures.
    PeriodicElements press(double pressure, double tolerance, int most = 3000) {
        const std::size_t points = p_.size();
        scale(pressure);
        std::vector<double> u(points), g(points), t(points, 0.0), r(points);
        double before = 1;
        bool fresh = true;
        PeriodicElements result;
        for (result.iterations = 0; result.iterations < most; ++result.iterations) {
            product(p_, u);
            double mean = 0;
            std::size_t inside = 0;
            for (std::size_t k = 0; k < points; ++k) {
                g[k] = u[k] - z_[k];
                if (p_[k] > 0) mean += g[k], ++inside;
            }
            mean /= static_cast<double>(inside);
            double squares = 0, worst = 0;
            for (std::size_t k = 0; k < points; ++k) {
                g[k] -= mean;
                if (p_[k] > 0) squares += g[k] * g[k];
                worst = std::max(worst, p_[k] > 0 ? std::abs(g[k]) : -g[k]);
            }
            result.separation = -mean;
            result.gap = worst / rms_;
            if (result.gap < tolerance) break;
            double r_mean = 0, gt = 0, rt = 0;
            for (std::size_t k = 0; k < points; ++k) t[k] = p_[k] > 0 ? g[k] + (fresh ? 0 : squares / before * t[k]) : 0;
            before = squares;
            product(t, r);
            for (std::size_t k = 0; k < points; ++k)
                if (p_[k] > 0) r_mean += r[k] / static_cast<double>(inside);
            for (std::size_t k = 0; k < points; ++k)
                if (p_[k] > 0) gt += g[k] * t[k], rt += (r[k] - r_mean) * t[k];
            const double step = gt / rt;
            fresh = false;
            for (std::size_t k = 0; k < points; ++k) {
                if (p_[k] > 0)
                    p_[k] = std::max(0.0, p_[k] - step * t[k]);
                else if (g[k] < 0)
                    p_[k] = -step * g[k], fresh = true;
            }
            scale(pressure);
        }
        count(result);
        return result;
    }

private:
    void product(const std::vector<double>& p, std::vector<double>& u) {
        real_ = p;
        fftw_execute(forward_);
        for (std::size_t k = 0; k < modes_.size(); ++k) modes_[k] *= answer_[k];
        fftw_execute(backward_);
        u = real_;
    }
    void scale(double pressure) {
        double sum = 0;
        for (double p : p_) sum += p;
        for (double& p : p_) p *= pressure * static_cast<double>(p_.size()) / sum;
    }
    void count(PeriodicElements& result) const {
        double inside = 0, sides = 0;
        for (int j = 0; j < n_; ++j)
            for (int i = 0; i < n_; ++i) {
                const bool here = at(i, j);
                inside += here;
                sides += (here != at(i + 1, j)) + (here != at(i, j + 1));
            }
        const double points = static_cast<double>(p_.size());
        result.area_fraction = inside / points;
        result.border = (inside - (std::numbers::pi - 1 + std::numbers::ln2) / 24 * sides) / points;
    }
    bool at(int i, int j) const {
        return p_[static_cast<std::size_t>(j % n_) * static_cast<std::size_t>(n_) + static_cast<std::size_t>(i % n_)] > 0;
    }

    int n_;
    double rms_ = 0;
    std::vector<double> z_, p_, real_, answer_;
    std::vector<std::complex<double>> modes_;
    fftw_plan forward_, backward_;
};
