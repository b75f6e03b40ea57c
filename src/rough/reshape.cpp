#include "rough/reshape.hpp"

#include <boost/math/special_functions/erf.hpp>

#include "error.hpp"
#include "rough/height_distribution.hpp"
#include "rough/library_lock.hpp"
#include "rough/surface.hpp"

namespace rsc {
namespace {

using Complex = std::complex<double>;

// Grid points in the shortest wave during the iteration: enough for the shorter waves that the changed heights introduce.
constexpr double kPointsPerWave = 2.5;
constexpr int kMostRounds = 60;
// Tolerances, half of the documented ones.
constexpr double kNearSkewness = 0.01, kNearKurtosis = 0.025;

class Reshaping {
public:
    Reshaping(const Spectrum& spectrum, Complex* columns, std::ptrdiff_t stride, int n)
        : spectrum_(spectrum),
          band_(band(spectrum)),
          columns_(columns),
          stride_(stride),
          n_(n),
          m_(fast_size(std::max(32.0, kPointsPerWave * std::max(band_.highest_kx, band_.highest_ky)))),
          row_(m_ / 2 + 1),
          points_(static_cast<std::size_t>(m_) * static_cast<std::size_t>(m_)) {
        const std::size_t doubles = 2 * static_cast<std::size_t>(row_) * static_cast<std::size_t>(m_);
        data_.reset(allocate_doubles(doubles, "a surface whose heights are not Gaussian"));
        const auto lock = fftw_planning();
        auto* const complex = reinterpret_cast<fftw_complex*>(data_.get());
        to_heights_.reset(fftw_plan_dft_c2r_2d(m_, m_, complex, data_.get(), FFTW_ESTIMATE));
        to_modes_.reset(fftw_plan_dft_r2c_2d(m_, m_, data_.get(), complex, FFTW_ESTIMATE));
        if (!to_heights_ || !to_modes_) throw Error(Failure::internal, "surface: FFTW made no plan for changed heights");
    }

    HeightShape run() {
        double square = 0;
        for_modes([&](Complex& c, Complex&) { amplitude_.push_back(std::abs(c)), square += 2 * std::norm(c); });
        const double scale = square > 0 ? 1 / std::sqrt(square) : 1;
        for (double& a : amplitude_) a *= scale;
        clear();
        for_modes([&](Complex& c, Complex& there) { there = scale * c; });
        mirror();
        heights();
        HeightShape got = shape(), wish = spectrum_.shape, ask = wish, best;
        double best_distance = 1e300;
        for (int round = 0; round < kMostRounds; ++round) {
            rank(spectrum_.heights ? *spectrum_.heights : HeightDistribution::of_moments(ask.skewness, ask.kurtosis));
            fftw_execute(to_modes_.get());
            phases();
            clear();
            std::size_t k = 0;
            for_modes([&](Complex&, Complex& there) { there = phase_[k] * amplitude_[k], ++k; });
            mirror();
            heights();
            got = shape();
            if (spectrum_.heights) {  // no target moments: iterate until the heights no longer change
                best = got;
                if (std::abs(got.skewness - ask.skewness) + std::abs(got.kurtosis - ask.kurtosis) < 1e-4) break;
                ask = got;
                continue;
            }
            const double ds = wish.skewness - got.skewness, dk = wish.kurtosis - got.kurtosis;
            const double distance = std::max(std::abs(ds) / kNearSkewness, std::abs(dk) / kNearKurtosis);
            if (distance < best_distance) best_distance = distance, best = got, kept_ = phase_;
            if (distance <= 1) break;
            // Kept within Johnson's system, away from distributions of two values.
            ask.skewness = std::clamp(ask.skewness + 0.5 * ds, -6.0, 6.0);
            ask.kurtosis = std::clamp(ask.kurtosis + 0.5 * dk, 1.2 * ask.skewness * ask.skewness + 1.3, 90.0);
        }
        if (spectrum_.heights) kept_ = phase_;
        std::size_t k = 0;
        for_modes([&](Complex& c, Complex&) { c = kept_[k] * (amplitude_[k] / scale), ++k; });
        for (int ky = 1; ky <= band_.highest_ky; ++ky) columns_[n_ - ky] = std::conj(columns_[ky]);  // kx = 0
        return best;
    }

private:
    Complex* modes() { return reinterpret_cast<Complex*>(data_.get()); }
    void clear() { std::fill(modes(), modes() + static_cast<std::ptrdiff_t>(row_) * m_, Complex()); }
    void heights() { fftw_execute(to_heights_.get()); }

    // Visits the modes of the half plane: the caller's coefficient and the corresponding element of data_.
    template <class Visit>
    void for_modes(Visit visit) {
        for (int kx = 0; kx <= band_.highest_kx; ++kx) {
            const auto [first, last] = band_.column(kx);
            for (int ky = kx > 0 ? first : 1; ky <= last; ++ky)
                visit(columns_[kx * stride_ + (ky < 0 ? ky + n_ : ky)],
                      modes()[static_cast<std::ptrdiff_t>(ky < 0 ? ky + m_ : ky) * row_ + kx]);
        }
    }
    // The column kx = 0 contains its own mirror image.
    void mirror() {
        for (int ky = 1; ky <= band_.highest_ky; ++ky)
            modes()[static_cast<std::ptrdiff_t>(m_ - ky) * row_] = std::conj(modes()[static_cast<std::ptrdiff_t>(ky) * row_]);
    }
    void phases() {
        phase_.clear();
        for_modes([&](Complex&, Complex& there) {
            const double size = std::abs(there);
            phase_.push_back(size > 0 ? there / size : Complex(1));
        });
    }

    template <class Visit>
    void for_heights(Visit visit) {
        for (int j = 0; j < m_; ++j) {
            double* const z = data_.get() + 2 * static_cast<std::ptrdiff_t>(row_) * j;
            for (int i = 0; i < m_; ++i) visit(z[i]);
        }
    }

    HeightShape shape() {
        double m2 = 0, m3 = 0, m4 = 0;  // the mean is 0, because there is no mode (0, 0)
        for_heights([&](double z) { m2 += z * z, m3 += z * z * z, m4 += z * z * z * z; });
        const double n = static_cast<double>(points_);
        m2 /= n, m3 /= n, m4 /= n;
        return {m3 / (m2 * std::sqrt(m2)), m4 / (m2 * m2)};
    }

    // Replaces every height by the height of its rank in the distribution. Ranks are interpolated linearly in a histogram.
    void rank(const HeightDistribution& wanted) {
        constexpr int bins = 8192;
        double low = 1e300, high = -1e300;
        for_heights([&](double z) { low = std::min(low, z), high = std::max(high, z); });
        const double width = (high - low) / bins;
        if (!(width > 0)) return;
        const auto bin = [&](double z) { return std::clamp(static_cast<int>((z - low) / width), 0, bins - 1); };
        std::vector<long> count(bins);
        for_heights([&](double z) { ++count[static_cast<std::size_t>(bin(z))]; });
        std::vector<double> value(bins + 1);
        const double n = static_cast<double>(points_);
        double below = 0;
        for (std::size_t b = 0; b <= bins; ++b) {
            const double p = std::clamp(below / n, 0.5 / n, 1 - 0.5 / n);
            value[b] = wanted(-std::numbers::sqrt2 * boost::math::erfc_inv(2 * p));
            if (b < bins) below += static_cast<double>(count[b]);
        }
        for_heights([&](double& z) {
            const int b = bin(z);
            const auto k = static_cast<std::size_t>(b);
            z = value[k] + (value[k + 1] - value[k]) * ((z - low) / width - b);
        });
    }

    const Spectrum& spectrum_;
    Band band_;
    Complex* columns_;
    std::ptrdiff_t stride_;
    int n_, m_;
    int row_;  // number of complex values in a row
    std::size_t points_;
    std::unique_ptr<double[], HeightMap::Free> data_;
    FftwPlan to_heights_, to_modes_;
    std::vector<double> amplitude_;  // of the modes in the order of for_modes(), for an rms height of 1
    std::vector<Complex> phase_, kept_;
};

}  // namespace

int fast_size(double least) {
    int n = static_cast<int>(std::ceil(least));
    for (n += n % 2;; n += 2) {
        int rest = n;
        for (int factor : {2, 3, 5, 7})
            while (rest % factor == 0) rest /= factor;
        if (rest == 1) return n;
    }
}

HeightShape reshape_heights(const Spectrum& spectrum, Complex* columns, std::ptrdiff_t stride, int n) {
    return Reshaping(spectrum, columns, stride, n).run();
}

}  // namespace rsc
