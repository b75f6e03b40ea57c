#include "rough/reshape.hpp"

#include <boost/math/special_functions/erf.hpp>

#include "error.hpp"
#include "rough/height_distribution.hpp"
#include "rough/library_lock.hpp"
#include "rough/surface.hpp"

namespace rsc {
namespace {

using Complex = std::complex<float>;

// Tolerances, smaller than the documented 0.02 and 0.05, which hold on any grid.
constexpr double kNearSkewness = 0.016, kNearKurtosis = 0.04;
double distance(HeightShape got, HeightShape wish) {
    return std::max(std::abs(got.skewness - wish.skewness) / kNearSkewness, std::abs(got.kurtosis - wish.kurtosis) / kNearKurtosis);
}

// Kept within Johnson's system, away from distributions of two values.
HeightShape usable(HeightShape shape) {
    const double skewness = std::clamp(shape.skewness, -6.0, 6.0);
    return {skewness, std::clamp(shape.kurtosis, 1.2 * skewness * skewness + 1.3, 90.0)};
}
HeightDistribution of_shape(HeightShape shape) { return HeightDistribution::of_moments(shape.skewness, shape.kurtosis); }

// Modes of the half plane within an ellipse (and the band of the surface), stored in the columns of the caller.
struct Modes {
    Band whole;  // of the surface
    Band band;   // the ellipse
    std::complex<double>* columns;
    std::ptrdiff_t stride;
    int n;

    // Calls visit(kx, ky, count, coefficients) for runs of modes within one column.
    template <class Visit>
    void runs(Visit visit) const {
        for (int kx = 0; kx <= band.highest_kx; ++kx) {
            const Band::Run in = band.column(kx), all = whole.column(kx);
            const int first = std::max(in.first, all.first), last = std::min(in.last, all.last);
            std::complex<double>* const column = columns + kx * stride;
            if (const int from = std::max(first, kx > 0 ? 0 : 1); from <= last) visit(kx, from, last - from + 1, column + from);
            if (const int to = std::min(last, -1); kx > 0 && first <= to) visit(kx, first, to - first + 1, column + first + n);
        }
    }
};

// Surface of some of the modes on m x m points. Single precision suffices, because only the phases of the modes are used.
class Field {
public:
    Field(const Modes& modes, int m)
        : modes_(modes),
          m_(m),
          columns_(modes.band.highest_kx + 1),
          stride_((m + 7) / 8 * 8 + 8),
          row_stride_((m + 2 + 15) / 16 * 16 + 16) {
        store_ = allocate(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(stride_));
        rows_ = allocate(static_cast<std::size_t>(kBlock) * static_cast<std::size_t>(row_stride_) / 2);
        heights_ = allocate(static_cast<std::size_t>(m_) * static_cast<std::size_t>(row_stride_) / 2);
        line_ = allocate(static_cast<std::size_t>(row_stride_) / 2);
        const auto lock = fftw_planning();
        auto* const c = reinterpret_cast<fftwf_complex*>(store_.get());
        auto* const rc = reinterpret_cast<fftwf_complex*>(rows_.get());
        up_.reset(fftwf_plan_dft_1d(m, c, c, FFTW_BACKWARD, FFTW_ESTIMATE));
        down_.reset(fftwf_plan_dft_1d(m, c, c, FFTW_FORWARD, FFTW_ESTIMATE));
        to_heights_.reset(fftwf_plan_dft_c2r_1d(m, rc, reinterpret_cast<float*>(heights_.get()), FFTW_ESTIMATE));
        to_modes_.reset(fftwf_plan_dft_r2c_1d(m, reinterpret_cast<float*>(line_.get()), rc, FFTW_ESTIMATE));
        if (!up_ || !down_ || !to_heights_ || !to_modes_)
            throw Error(Failure::internal, "surface: FFTW made no plan for heights that are not Gaussian");
    }

    // From a Gaussian surface, or towards a measured distribution, heights are replaced by rank in a distribution and the amplitudes of the
    // modes are restored. Newton's method then brings both moments to the wish. The best phases are stored in the caller's columns.
    HeightShape run(HeightShape wish, const HeightDistribution* measured, bool gaussian, int rounds) {
        take();
        HeightShape now = heights(), best = now;
        double nearest = HUGE_VAL;
        const double near_enough = measured || gaussian ? 0.3 : 1;
        const bool replaced = measured || gaussian;
        for (int round = 0;; ++round) {
            const double off = distance(now, wish);
            if ((round > 0 || !replaced) && off < nearest) nearest = off, best = now, kept_ = unit_;
            if (round >= rounds || nearest <= near_enough) break;
            if (round > 0 || !replaced)
                step(wish, now);
            else if (measured)
                replace(*measured);
            else  // shares of the changes that remain after the amplitudes are restored
                replace(of_shape(
                    usable({now.skewness + (wish.skewness - now.skewness) / 0.42, now.kurtosis + (wish.kurtosis - now.kurtosis) / 0.3})));
            now = heights();
        }
        give();
        return best;
    }

private:
    struct Free {
        void operator()(Complex* p) const noexcept { HeightMap::Free()(reinterpret_cast<double*>(p)); }
    };
    using Memory = std::unique_ptr<Complex[], Free>;
    static Memory allocate(std::size_t n) {
        return Memory(reinterpret_cast<Complex*>(allocate_doubles(n, "a surface whose heights are not Gaussian")));
    }
    static constexpr int kBlock = 16;  // rows at a time
    static constexpr int kBins = 1024;
    static constexpr double kLongest = 0.4;

    Complex* place(int kx, int ky) const { return store_.get() + kx * stride_ + (ky < 0 ? ky + m_ : ky); }
    void transform(const FftwfPlan& plan) {
        for (int kx = 0; kx < columns_; ++kx) {
            auto* const c = reinterpret_cast<fftwf_complex*>(store_.get() + kx * stride_);
            fftwf_execute_dft(plan.get(), c, c);
        }
    }
    void take() {
        double square = 0;
        modes_.runs([&](int, int, int count, const std::complex<double>* c) {
            for (int i = 0; i < count; ++i) square += std::norm(c[i]);
        });
        const double scale = square > 0 ? 1 / std::sqrt(2 * square) : 1;
        amplitude_.clear(), unit_.clear();
        modes_.runs([&](int, int, int count, const std::complex<double>* c) {
            for (int i = 0; i < count; ++i) {
                const double re = scale * c[i].real(), im = scale * c[i].imag();
                amplitude_.push_back(static_cast<float>(std::sqrt(re * re + im * im)));
                unit_.emplace_back();
                direct(unit_.size() - 1, static_cast<float>(re), static_cast<float>(im));
            }
        });
    }

    // The heights of the phases unit_, and their moments.
    HeightShape heights() {
        std::size_t k = 0;
        std::fill_n(store_.get(), columns_ * stride_, Complex());
        modes_.runs([&](int kx, int ky, int count, const std::complex<double>*) {
            Complex* const to = place(kx, ky);
            for (int i = 0; i < count; ++i) to[i] = {unit_[k + i].real() * amplitude_[k + i], unit_[k + i].imag() * amplitude_[k + i]};
            k += static_cast<std::size_t>(count);
        });
        for (int ky = 1; 2 * ky < m_; ++ky) *place(0, -ky) = std::conj(*place(0, ky));  // the column contains its own mirror image
        transform(up_);
        Sums sums;
        auto* const all = reinterpret_cast<float*>(heights_.get());
        auto* const data = reinterpret_cast<float*>(rows_.get());
        for (int j = 0; j < m_; j += kBlock) {
            const int count = std::min(kBlock, m_ - j);
            for (int kx = 0; kx < columns_; ++kx) {
                const Complex* const from = store_.get() + kx * stride_ + j;
                for (int r = 0; r < count; ++r) {
                    data[r * row_stride_ + 2 * kx] = from[r].real();
                    data[r * row_stride_ + 2 * kx + 1] = from[r].imag();
                }
            }
            for (int r = 0; r < count; ++r) {
                float *const row = data + r * row_stride_, *const to = all + (j + r) * row_stride_;
                std::fill(row + 2 * columns_, row + m_ + 2, 0.0f);
                fftwf_execute_dft_c2r(to_heights_.get(), reinterpret_cast<fftwf_complex*>(row), to);
                sums.add(to, m_);
            }
        }
        return sums.shape();
    }

    // Fourier coefficients of a function of the heights, by column.
    template <class Function>
    void coefficients(Function of) {
        const auto* const all = reinterpret_cast<const float*>(heights_.get());
        auto *const data = reinterpret_cast<float*>(rows_.get()), *const line = reinterpret_cast<float*>(line_.get());
        for (int j = 0; j < m_; j += kBlock) {
            const int count = std::min(kBlock, m_ - j);
            for (int r = 0; r < count; ++r) {
                float* const row = data + r * row_stride_;
                const float* const from = all + (j + r) * row_stride_;
                for (int i = 0; i < m_; ++i) line[i] = of(from[i]);
                fftwf_execute_dft_r2c(to_modes_.get(), line, reinterpret_cast<fftwf_complex*>(row));
            }
            for (int kx = 0; kx < columns_; ++kx) {
                Complex* const to = store_.get() + kx * stride_ + j;
                for (int r = 0; r < count; ++r) to[r] = {data[r * row_stride_ + 2 * kx], data[r * row_stride_ + 2 * kx + 1]};
            }
        }
        transform(down_);
    }

    // Calls visit(k, coefficient) for the modes k = 0, 1, ...
    template <class Visit>
    void each(Visit visit) const {
        std::size_t k = 0;
        modes_.runs([&](int kx, int ky, int count, const std::complex<double>*) {
            const Complex* const from = place(kx, ky);
            for (int i = 0; i < count; ++i) visit(k++, from[i]);
        });
    }

    void direct(std::size_t k, float re, float im) {
        const float square = re * re + im * im, inverse = 1 / std::sqrt(square);
        unit_[k] = square > 1e-30f ? Complex(re * inverse, im * inverse) : Complex(1, 0);
    }

    // Newton's method for both moments with the smallest change of heights that phases allow: p z^2 + q z^3 without the parts along the modes.
    // The rotation of a mode, and the loss along its old direction, are not linearised, because modes of small amplitude rotate far.
    void step(HeightShape wish, HeightShape now) {
        const float scale = 1 / (static_cast<float>(m_) * static_cast<float>(m_));
        const auto relative = [&](std::vector<Complex>& to) {  // the part across a mode is the imaginary one
            to.resize(unit_.size());
            each([&](std::size_t k, Complex c) {
                const float x = unit_[k].real(), y = unit_[k].imag();
                to[k] = {scale * (x * c.real() + y * c.imag()), scale * (x * c.imag() - y * c.real())};
            });
        };
        coefficients([](float z) { return z * z; });
        relative(second_);
        coefficients([](float z) { return z * z * z; });
        relative(third_);
        // skewness = <z^3>, kurtosis = <z^4>; every mode counts twice.
        const double s = (wish.skewness - now.skewness) / 6, t = (wish.kurtosis - now.kurtosis) / 8;
        float p = 0, q = 0;
        for (int i = 0; i < kSteps; ++i) {
            Lanes sums[5];
            for (std::size_t k = 0; k < unit_.size(); ++k) {
                const float x = second_[k].imag(), y = third_[k].imag(), along = amplitude_[k], across = p * x + q * y;
                const float length = std::sqrt(along * along + across * across), cosine = length > 0 ? along / length : 1;
                const float lost = along * (1 - cosine),
                            values[5] = {cosine * x * x, cosine * x * y, cosine * y * y, lost * second_[k].real(), lost * third_[k].real()};
                for (int l = 0; l < 5; ++l) sums[l].v[k % 8] += values[l];
            }
            const double a = sums[0].sum(), b = sums[1].sum(), c = sums[2].sum(), determinant = a * c - b * b;
            if (!(determinant > 0)) return;
            const double s1 = s + sums[3].sum(), t1 = t + sums[4].sum();
            p = static_cast<float>((c * s1 - b * t1) / determinant), q = static_cast<float>((a * t1 - b * s1) / determinant);
            const double size = std::sqrt(2 * (p * p * a + 2 * p * q * b + q * q * c));
            if (const float most = static_cast<float>(kLongest / size); most < 1) p *= most, q *= most;
        }
        for (std::size_t k = 0; k < unit_.size(); ++k) {
            const float across = p * second_[k].imag() + q * third_[k].imag(), along = amplitude_[k], x = unit_[k].real(),
                        y = unit_[k].imag();
            direct(k, along * x - across * y, along * y + across * x);
        }
    }

    void give() {
        std::size_t k = 0;
        modes_.runs([&](int, int, int count, std::complex<double>* c) {
            for (int i = 0; i < count; ++i, ++k) {
                const double re = kept_[k].real(), im = kept_[k].imag();
                const double size = std::sqrt(std::norm(c[i]) / (re * re + im * im));
                c[i] = {size * re, size * im};
            }
        });
    }

    struct Lanes {
        double v[8] = {};
        double sum() const { return std::accumulate(v, v + 8, 0.0); }
    };
    static constexpr int kSteps = 4;
    struct Sums {
        static constexpr int kLanes = 8;
        double m2[kLanes] = {}, m3[kLanes] = {}, m4[kLanes] = {};
        void add(const float* row, int n) {
            for (int i = 0; i + kLanes <= n; i += kLanes)
                for (int l = 0; l < kLanes; ++l) {
                    const double z = row[i + l], z2 = z * z;
                    m2[l] += z2, m3[l] += z * z2, m4[l] += z2 * z2;
                }
            for (int i = n - n % kLanes; i < n; ++i) {
                const double z = row[i], z2 = z * z;
                m2[0] += z2, m3[0] += z * z2, m4[0] += z2 * z2;
            }
            count += n;
        }
        HeightShape shape() const {  // the mean is 0, because there is no mode (0, 0)
            double s2 = 0, s3 = 0, s4 = 0;
            for (int l = 0; l < kLanes; ++l) s2 += m2[l], s3 += m3[l], s4 += m4[l];
            const double variance = s2 / count;
            return {s3 / count / (variance * std::sqrt(variance)), s4 / count / (variance * variance)};
        }
        double count = 0;
    };

    // Bins over +-kRange rms heights; the outermost include all larger heights.
    static constexpr float kRange = 12, kPerUnit = kBins / (2 * kRange);
    static std::size_t place_of(float z) {
        return static_cast<std::size_t>(std::clamp((z + kRange) * kPerUnit, 0.0f, static_cast<float>(kBins - 1)));
    }

    // Heights replaced by rank.
    void replace(const HeightDistribution& by) {
        const auto* const all = reinterpret_cast<const float*>(heights_.get());
        long bin[kBins] = {};
        for (int j = 0; j < m_; j += std::max(1, m_ / 128))  // enough rows
            for (int i = 0; i < m_; ++i) ++bin[place_of(all[j * row_stride_ + i])];
        double total = 0, below = 0;
        for (const long count : bin) total += static_cast<double>(count);
        float value[kBins + 1];
        for (std::size_t b = 0; b <= kBins; ++b) {
            const double p = std::clamp(below / total, 0.5 / total, 1 - 0.5 / total);
            using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
            value[b] = static_cast<float>(by(-std::numbers::sqrt2 * boost::math::erfc_inv(2 * p, Policy())));
            if (b < kBins) below += static_cast<double>(bin[b]);
        }
        coefficients([&](float z) {
            const float at = std::clamp((z + kRange) * kPerUnit, 0.0f, static_cast<float>(kBins));
            const std::size_t k = std::min<std::size_t>(static_cast<std::size_t>(at), kBins - 1);
            return value[k] + (value[k + 1] - value[k]) * (at - static_cast<float>(k));
        });
        each([&](std::size_t k, Complex c) { direct(k, c.real(), c.imag()); });
    }

    const Modes& modes_;
    int m_, columns_;
    std::ptrdiff_t stride_, row_stride_;  // strides of columns (complex numbers) and rows (real numbers)
    Memory store_, rows_, heights_, line_;
    FftwfPlan up_, down_, to_heights_, to_modes_;
    std::vector<float> amplitude_;  // amplitudes of the modes for an rms height of 1
    std::vector<Complex> unit_, kept_;
    std::vector<Complex> second_, third_;
};

// Number of points: enough for fourth powers if there are few modes; with many modes more are not required.
int points(const Band& band) {
    const double highest = std::max({band.highest_kx, band.highest_ky, 16});
    return fast_size(std::max(2.1 * highest + 2, std::min(4.1 * highest, 160.0)));
}

Band ellipse(const Band& whole, const Stretch& stretched, double q2) {
    Band b{stretched, 0, q2, 0, 0};
    b.highest_kx = std::min(whole.highest_kx, static_cast<int>(std::sqrt(stretched.yy * q2)));
    b.highest_ky = std::min(whole.highest_ky, static_cast<int>(std::sqrt(stretched.xx * q2)));
    return b;
}

// The ellipses of equal power of a spectrum by direction are those of its second moments: k = A k' with k' isotropic has the moments A A^T.
// They are exact if the spectrum is an isotropic one that is stretched.
Stretch power_ellipse(const Spectrum& spectrum) {
    if (!spectrum.plane) return stretch(spectrum);
    const double xx = spectrum.plane->integral(2, 0), xy = spectrum.plane->integral(1, 1), yy = spectrum.plane->integral(0, 2);
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 1e-6 * xx * yy)) return {};  // all waves have one direction
    const double scale = 1 / std::sqrt(determinant);
    return {scale * yy, -scale * xy, scale * xx};
}

// The smallest ellipse of the shape of modes.band with at least `share` of the mean square height, and its actual share.
std::pair<Band, double> long_waves(const Modes& modes, double share) {
    constexpr int bins = 1024;
    std::vector<double> energy(bins + 1);
    const double scale = 1 / modes.band.highest_q2;
    double total = 0, found = 0;
    modes.runs([&](int kx, int ky, int count, const std::complex<double>* c) {
        for (int i = 0; i < count; ++i) {
            const double e = std::norm(c[i]), q = std::sqrt(scale * modes.band.stretched(kx, ky + i));
            energy[std::min<std::size_t>(bins, static_cast<std::size_t>(bins * q))] += e;
            total += e;
        }
    });
    std::size_t b = 0;
    while (b < bins && found < share * total) found += energy[b++];
    const double q = static_cast<double>(b) / bins;
    return {ellipse(modes.whole, modes.band.stretched, modes.band.highest_q2 * q * q), found / total};
}

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

HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns, std::ptrdiff_t stride, int n) {
    const Band whole = band(spectrum);
    Modes all{whole, whole, columns, stride, n};
    if (spectrum.plane) {
        // The table of a measured map ends with its grid, and its spectrum often before that.
        const Stretch form = power_ellipse(spectrum);
        all.band = ellipse(whole, form, whole.highest_q2 * (form.xx + form.yy));
        constexpr double all_of_it = 1 - 1e-12;
        all.band = long_waves(all, all_of_it).first;
    }
    const HeightShape wish = spectrum.heights ? spectrum.heights->shape() : spectrum.shape;
    // At first only the long waves are changed. The short ones remain Gaussian and uncorrelated with them, so the skewness and excess
    // kurtosis of the sum are those of the long waves times powers of their share. Close to the bound of the kurtosis and for long tails
    // the share must be nearly 1.
    constexpr double least_room = 0.9, longest_tail = 8, most_of_it = 0.9, nearly_all = 0.97;
    HeightShape ask;
    Band band;
    double share = 0;
    std::tie(band, share) = long_waves(all, most_of_it);
    const auto of_long_waves = [&](HeightShape change) {
        return HeightShape{change.skewness / (share * std::sqrt(share)), change.kurtosis / (share * share)};
    };
    const auto asked = [&] {
        ask = of_long_waves({wish.skewness, wish.kurtosis - 3});
        ask.kurtosis += 3;
        return ask.kurtosis < longest_tail && ask.kurtosis - 1 - ask.skewness * ask.skewness > least_room;
    };
    if (!asked()) std::tie(band, share) = long_waves(all, nearly_all), asked();
    const Modes longest{whole, band, columns, stride, n};
    constexpr int coarse_rounds = 4, corrections = 3, fine_rounds = 20;
    Field coarse(longest, points(band)), fine(all, points(all.band));
    HeightShape got;
    bool near = false;
    for (int i = 0; i < corrections && !near; ++i) {
        coarse.run(usable(ask), nullptr, i == 0, coarse_rounds);
        got = fine.run(wish, nullptr, false, 0);
        near = distance(got, wish) <= 1;
        const HeightShape more = of_long_waves({wish.skewness - got.skewness, wish.kurtosis - got.kurtosis});
        ask.skewness += more.skewness, ask.kurtosis += more.kurtosis;
    }
    if (!near || spectrum.heights) got = fine.run(wish, spectrum.heights.get(), false, fine_rounds);
    for (int ky = 1; ky <= whole.highest_ky; ++ky) columns[n - ky] = std::conj(columns[ky]);  // kx = 0
    return got;
}

}  // namespace rsc
