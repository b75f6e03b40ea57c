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
    shape.skewness = std::clamp(shape.skewness, -6.0, 6.0);
    shape.kurtosis = std::clamp(shape.kurtosis, 1.2 * shape.skewness * shape.skewness + 1.3, 90.0);
    return shape;
}

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
        const auto lock = fftw_planning();
        auto* const c = reinterpret_cast<fftwf_complex*>(store_.get());
        auto* const r = reinterpret_cast<float*>(rows_.get());
        auto* const rc = reinterpret_cast<fftwf_complex*>(rows_.get());
        up_.reset(fftwf_plan_dft_1d(m, c, c, FFTW_BACKWARD, FFTW_ESTIMATE));
        down_.reset(fftwf_plan_dft_1d(m, c, c, FFTW_FORWARD, FFTW_ESTIMATE));
        to_heights_.reset(fftwf_plan_dft_c2r_1d(m, rc, r, FFTW_ESTIMATE));
        to_modes_.reset(fftwf_plan_dft_r2c_1d(m, r, rc, FFTW_ESTIMATE));
        if (!up_ || !down_ || !to_heights_ || !to_modes_)
            throw Error(Failure::internal, "surface: FFTW made no plan for heights that are not Gaussian");
    }

    // Iterates: heights are replaced by rank in a distribution, then the amplitudes of the modes are restored. The distribution is chosen
    // from the moments reached so far; `measured` (optional) is the distribution for `wish`. The best phases are stored in the columns of
    // the caller.
    HeightShape run(HeightShape wish, const HeightDistribution* measured, bool gaussian, int rounds) {
        // Twins of a map come nearer, since all of them stop on the same, more Gaussian side of it.
        const double near_enough = measured ? 0.3 : 1;
        take();
        transform(up_);
        HeightShape now, best, lost{0, 0};
        double nearest = HUGE_VAL;
        now = shape(std::max(1, m_ / 128));  // enough to choose the first distribution
        for (int round = 0; round <= rounds; ++round) {
            // Share of a change of the distribution that remains after the amplitudes are restored; smaller in the first round from a
            // Gaussian surface.
            const bool first = gaussian && round == 0;
            const double skewed = first ? 0.42 : kRemains, peaked = first ? 0.3 : kRemains;
            const HeightShape ask = usable({now.skewness + (wish.skewness - now.skewness + lost.skewness) / skewed,
                                            now.kurtosis + (wish.kurtosis - now.kurtosis + lost.kurtosis) / peaked});
            change(ask, wish, measured);
            transform(down_);
            restore();
            transform(up_);
            const HeightShape got = shape();
            const double off = distance(got, wish);
            if (off < nearest) {
                nearest = off, best = got;
                kept_.assign(unit_.begin(), unit_.end());
            }
            if (off <= near_enough) break;
            if (!first) {  // what is lost of a large first change says nothing about the next ones
                lost.skewness += kRemains * (now.skewness + skewed * (ask.skewness - now.skewness) - got.skewness - lost.skewness);
                lost.kurtosis += kRemains * (now.kurtosis + peaked * (ask.kurtosis - now.kurtosis) - got.kurtosis - lost.kurtosis);
            }
            now = got;
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
    static constexpr double kRemains = 0.6;

    Complex* place(int kx, int ky) const { return store_.get() + kx * stride_ + (ky < 0 ? ky + m_ : ky); }
    void transform(const FftwfPlan& plan) {
        for (int kx = 0; kx < columns_; ++kx) {
            auto* const c = reinterpret_cast<fftwf_complex*>(store_.get() + kx * stride_);
            fftwf_execute_dft(plan.get(), c, c);
        }
    }
    // The column kx = 0 contains its own mirror image.
    void mirror() {
        for (int ky = 1; 2 * ky < m_; ++ky) *place(0, -ky) = std::conj(*place(0, ky));
    }

    void take() {
        double square = 0;
        modes_.runs([&](int, int, int count, const std::complex<double>* c) {
            for (int i = 0; i < count; ++i) square += std::norm(c[i]);
        });
        const double scale = square > 0 ? 1 / std::sqrt(2 * square) : 1;
        std::fill_n(store_.get(), columns_ * stride_, Complex());
        amplitude_.clear();
        modes_.runs([&](int kx, int ky, int count, const std::complex<double>* c) {
            Complex* const to = place(kx, ky);
            for (int i = 0; i < count; ++i) {
                const double re = scale * c[i].real(), im = scale * c[i].imag();
                to[i] = {static_cast<float>(re), static_cast<float>(im)};
                amplitude_.push_back(static_cast<float>(std::sqrt(re * re + im * im)));
            }
        });
        unit_.resize(amplitude_.size());
        mirror();
    }

    // Restores the amplitudes of the modes.
    void restore() {
        std::size_t k = 0;
        kept_.resize(unit_.size());
        modes_.runs([&](int kx, int ky, int count, const std::complex<double>*) {
            const Complex* const from = place(kx, ky);
            Complex* const to = unit_.data() + k;
            for (int i = 0; i < count; ++i) {
                const float re = from[i].real(), im = from[i].imag(), square = re * re + im * im;
                const float inverse = 1 / std::sqrt(square);
                to[i] = square > 1e-30f ? Complex(re * inverse, im * inverse) : Complex(1, 0);
            }
            k += static_cast<std::size_t>(count);
        });
        std::fill_n(store_.get(), columns_ * stride_, Complex());
        k = 0;
        modes_.runs([&](int kx, int ky, int count, const std::complex<double>*) {
            Complex* const to = place(kx, ky);
            for (int i = 0; i < count; ++i) to[i] = {unit_[k + i].real() * amplitude_[k + i], unit_[k + i].imag() * amplitude_[k + i]};
            k += static_cast<std::size_t>(count);
        });
        mirror();
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

    // Calls visit() for the heights of every `step`-th row, from transformed columns; with `back`, the modified heights are stored.
    template <class Visit>
    void rows(int step, bool back, Visit visit) {
        auto* const data = reinterpret_cast<float*>(rows_.get());
        const int wide = step == 1 ? kBlock : 1;
        for (int j = 0; j < m_; j += step * wide) {
            const int count = std::min(wide, m_ - j);
            for (int kx = 0; kx < columns_; ++kx) {
                const Complex* const from = store_.get() + kx * stride_ + j;
                for (int r = 0; r < count; ++r) {
                    data[r * row_stride_ + 2 * kx] = from[r].real();
                    data[r * row_stride_ + 2 * kx + 1] = from[r].imag();
                }
            }
            for (int r = 0; r < count; ++r) {
                float* const row = data + r * row_stride_;
                auto* const complex = reinterpret_cast<fftwf_complex*>(row);
                std::fill(row + 2 * columns_, row + m_ + 2, 0.0f);
                fftwf_execute_dft_c2r(to_heights_.get(), complex, row);
                visit(row);
                if (back) fftwf_execute_dft_r2c(to_modes_.get(), row, complex);
            }
            for (int kx = 0; back && kx < columns_; ++kx) {
                Complex* const to = store_.get() + kx * stride_ + j;
                for (int r = 0; r < count; ++r) to[r] = {data[r * row_stride_ + 2 * kx], data[r * row_stride_ + 2 * kx + 1]};
            }
        }
    }

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

    // Moments of every `step`-th row, and the histogram of the heights, from at least 128 rows.
    HeightShape shape(int step = 1) {
        Sums sums;
        std::fill(std::begin(bin_), std::end(bin_), 0);
        int row = 0;
        const int binned = std::max(1, m_ / (step * 128));
        rows(step, false, [&](const float* z) {
            sums.add(z, m_);
            for (int i = 0; row % binned == 0 && i < m_; ++i) ++bin_[bin(z[i])];
            ++row;
        });
        return sums.shape();
    }
    // Bins over +-kRange rms heights; the outermost include all larger heights.
    static constexpr float kRange = 12, kPerUnit = kBins / (2 * kRange);
    static std::size_t bin(float z) {
        return static_cast<std::size_t>(std::clamp((z + kRange) * kPerUnit, 0.0f, static_cast<float>(kBins - 1)));
    }

    void change(HeightShape ask, HeightShape wish, const HeightDistribution* measured) {
        const HeightDistribution asked = HeightDistribution::of_moments(ask.skewness, ask.kurtosis);
        const HeightShape at = usable(wish);
        const HeightDistribution wished = measured ? HeightDistribution::of_moments(at.skewness, at.kurtosis) : asked;
        double total = 0, below = 0;
        for (const long count : bin_) total += static_cast<double>(count);
        float value[kBins + 1];
        for (std::size_t b = 0; b <= kBins; ++b) {
            const double p = std::clamp(below / total, 0.5 / total, 1 - 0.5 / total);
            const double score = -std::numbers::sqrt2 * boost::math::erfc_inv(2 * p), z = asked(score);
            value[b] = static_cast<float>(measured ? (*measured)(wished.normal(z)) : z);
            if (b < kBins) below += static_cast<double>(bin_[b]);
        }
        rows(1, true, [&](float* z) {
            for (int i = 0; i < m_; ++i) {
                const float place = std::clamp((z[i] + kRange) * kPerUnit, 0.0f, static_cast<float>(kBins));
                const std::size_t b = std::min<std::size_t>(static_cast<std::size_t>(place), kBins - 1);
                z[i] = value[b] + (value[b + 1] - value[b]) * (place - static_cast<float>(b));
            }
        });
    }

    const Modes& modes_;
    int m_, columns_;
    std::ptrdiff_t stride_, row_stride_;  // strides of columns (complex numbers) and rows (real numbers)
    Memory store_, rows_;
    FftwfPlan up_, down_, to_heights_, to_modes_;
    std::vector<float> amplitude_;  // amplitudes of the modes for an rms height of 1
    std::vector<Complex> unit_, kept_;
    long bin_[kBins] = {};
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
    const int m = points(all.band);
    // Long waves are reshaped first, on a coarse grid. The short waves are still Gaussian and uncorrelated with them, so the moments of the
    // sum are those of the long waves times powers of their share.
    constexpr double most_of_it = 0.9, nearly_all = 0.95, flat = 2.8;
    constexpr int many_rounds = 40, coarse_rounds = 7, fine_rounds = 20;
    const auto [band, share] = long_waves(all, wish.kurtosis < flat ? nearly_all : most_of_it);
    const Modes longest{whole, band, columns, stride, n};
    const bool in_turn = 2 * points(band) <= m;
    if (in_turn)
        Field(longest, points(band))
            .run(usable({wish.skewness / (share * std::sqrt(share)), 3 + (wish.kurtosis - 3) / (share * share)}), nullptr, true,
                 coarse_rounds);
    const HeightShape got = Field(all, m).run(wish, spectrum.heights.get(), !in_turn, in_turn ? fine_rounds : many_rounds);
    for (int ky = 1; ky <= whole.highest_ky; ++ky) columns[n - ky] = std::conj(columns[ky]);  // kx = 0
    return got;
}

}  // namespace rsc
