#include "rough/reshape.hpp"

#include <boost/math/special_functions/erf.hpp>

#include "error.hpp"
#include "rough/dispatch.hpp"
#include "rough/height_distribution.hpp"
#include "rough/library_lock.hpp"
#include "rough/surface.hpp"
#include "rough/vector_math.hpp"

namespace rsc {
namespace {

using Complex = std::complex<float>;

// Tolerances, smaller than the documented 0.02 and 0.05, which hold on any grid.
constexpr double kNearSkewness = 0.016, kNearKurtosis = 0.04;
double distance(HeightShape got, HeightShape wish) {
    return std::max(std::abs(got.skewness - wish.skewness) / kNearSkewness, std::abs(got.kurtosis - wish.kurtosis) / kNearKurtosis);
}

// Kept feasible, away from distributions of two values.
HeightShape usable(HeightShape shape) {
    const double skewness = std::clamp(shape.skewness, -6.0, 6.0);
    return {skewness, std::clamp(shape.kurtosis, 1.2 * skewness * skewness + 1.3, 90.0)};
}

// Sums go by lanes, so that loops vectorise, and modes by batches.
constexpr int kLanes = 16, kBatch = 256;

double sum(const float* lanes) { return std::accumulate(lanes, lanes + kLanes, 0.0f); }

// Adds the squares, cubes and fourth powers of `count` numbers, a multiple of kLanes, to sums in lanes.
RSC_ALWAYS_INLINE void add_powers_body(const float* z, std::ptrdiff_t count, float* second, float* third, float* fourth) {
    for (std::ptrdiff_t i = 0; i < count; i += kLanes)
        for (int l = 0; l < kLanes; ++l) {
            const float square = z[i + l] * z[i + l];
            second[l] += square, third[l] += z[i + l] * square, fourth[l] += square * square;
        }
}
RSC_DISPATCH(add_powers, add_powers_body, (const float* z, std::ptrdiff_t count, float* second, float* third, float* fourth),
             (z, count, second, third, fourth))

// Tangents and cosines of the angles by which a change p x + q y across a batch of modes rotates them; inverse: of their squared amplitudes.
RSC_ALWAYS_INLINE void angles(const float* x, const float* y, const float* inverse, float p, float q, float* tangent, float* cosine) {
    for (int i = 0; i < kBatch; ++i) {
        tangent[i] = (p * x[i] + q * y[i]) * inverse[i];
        cosine[i] = 1 + tangent[i] * tangent[i];
    }
    vector_math::square_roots(cosine, kBatch);
    for (int i = 0; i < kBatch; ++i) cosine[i] = 1 / cosine[i];
}

// Adds up, over a batch of modes rotated by these angles, the changes x and y across them in products, and the losses of u and v along them.
RSC_ALWAYS_INLINE void add_rotated_body(const float* x, const float* y, const float* u, const float* v, const float* inverse, float p,
                                        float q, double* total) {
    alignas(64) float tangent[kBatch], cosine[kBatch];
    angles(x, y, inverse, p, q, tangent, cosine);
    float sums[5][kLanes] = {};
    for (int j = 0; j < kBatch; j += kLanes)
        for (int l = 0; l < kLanes; ++l) {
            const int m = j + l;
            const float weight = cosine[m] * inverse[m], wx = weight * x[m], wy = weight * y[m], lost = 1 - cosine[m];
            sums[0][l] += wx * x[m], sums[1][l] += wx * y[m], sums[2][l] += wy * y[m];
            sums[3][l] += lost * u[m], sums[4][l] += lost * v[m];
        }
    for (int i = 0; i < 5; ++i) total[i] += sum(sums[i]);
}
RSC_DISPATCH(add_rotated, add_rotated_body,
             (const float* x, const float* y, const float* u, const float* v, const float* inverse, float p, float q, double* total),
             (x, y, u, v, inverse, p, q, total))

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
          row_stride_((m + 2 + kLanes - 1) / kLanes * kLanes) {
        store_ = allocate(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(stride_));
        rows_ = allocate(static_cast<std::size_t>(kBlock) * static_cast<std::size_t>(row_stride_) / 2);
        heights_ = allocate(static_cast<std::size_t>(m_) * static_cast<std::size_t>(row_stride_) / 2);
        std::fill_n(heights_.get(), m_ * row_stride_ / 2, Complex());
        line_ = allocate(static_cast<std::size_t>(row_stride_) / 2);
        modes_.runs([&](int kx, int ky, int count, const std::complex<double>*) {
            runs_.emplace_back(kx * stride_ + (ky < 0 ? ky + m_ : ky), count);
        });
        plans_ = plans();
    }

    // The heights of the caller's modes, and their moments.
    HeightShape take() {
        double square = 0;
        std::size_t modes = 0;
        modes_.runs([&](int, int, int count, const std::complex<double>* c) {
            for (int i = 0; i < count; ++i) square += std::norm(c[i]);
            modes += static_cast<std::size_t>(count);
        });
        const double scale = square > 0 ? 1 / std::sqrt(2 * square) : 1;
        mode_.assign((modes + kBatch - 1) / kBatch * kBatch, Complex());
        std::size_t k = 0;
        modes_.runs([&](int, int, int count, const std::complex<double>* c) {
            for (int i = 0; i < count; ++i, ++k)
                mode_[k] = {static_cast<float>(scale * c[i].real()), static_cast<float>(scale * c[i].imag())};
        });
        inverse_.resize(mode_.size());
        for (std::size_t i = 0; i < mode_.size(); ++i) {
            const float square = std::norm(mode_[i]);
            inverse_[i] = square > 1e-30f ? 1 / square : 0;
        }
        return now_ = heights();
    }

    // Newton's method brings both moments to the wish, after heights are replaced by rank in a distribution, if there is one, and the
    // amplitudes of the modes are restored. It ends also when a round leaves more than the share `still` of the distance. The best phases
    // are stored in the caller's columns.
    HeightShape run(HeightShape wish, const HeightDistribution* by, double near_enough, int rounds, double still) {
        HeightShape best = now_;
        double nearest = HUGE_VAL, before = HUGE_VAL;
        for (int round = 0;; ++round) {
            const double off = distance(now_, wish);
            if ((round > 0 || !by) && off < nearest) nearest = off, best = now_, kept_ = mode_;
            if (round >= rounds || nearest <= near_enough || (round > 2 && off > still * before)) break;
            before = off;
            if (round > 0 || !by)
                step(wish);
            else
                replace(*by);
            now_ = heights();
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
    static fftwf_complex* fftw(Complex* p) { return reinterpret_cast<fftwf_complex*>(p); }
    static float* numbers(const Memory& p) { return reinterpret_cast<float*>(p.get()); }
    struct Plans {
        FftwfPlan up, down, to_heights, to_modes;
    };
    // Planning takes longer than the transforms of a small surface: the plans of the last sizes are kept for the next surfaces.
    std::shared_ptr<const Plans> plans() const {
        constexpr std::size_t most = 4;
        static std::deque<std::pair<int, std::shared_ptr<const Plans>>> kept;
        const auto lock = fftw_planning();
        for (const auto& [points, p] : kept)
            if (points == m_) return p;
        const auto p = std::make_shared<Plans>();
        auto *const c = fftw(store_.get()), *const row = fftw(rows_.get());
        p->up.reset(fftwf_plan_dft_1d(m_, row, c, FFTW_BACKWARD, FFTW_ESTIMATE));
        p->down.reset(fftwf_plan_dft_1d(m_, row, c, FFTW_FORWARD, FFTW_ESTIMATE));
        p->to_heights.reset(fftwf_plan_dft_c2r_1d(m_, row, numbers(heights_), FFTW_ESTIMATE));
        p->to_modes.reset(fftwf_plan_dft_r2c_1d(m_, numbers(line_), row, FFTW_ESTIMATE));
        if (!p->up || !p->down || !p->to_heights || !p->to_modes)
            throw Error(Failure::internal, "surface: FFTW made no plan for heights that are not Gaussian");
        kept.emplace_front(m_, p);
        if (kept.size() > most) kept.pop_back();
        return p;
    }
    static constexpr int kBlock = 16;  // rows at a time
    static constexpr int kBins = 1024;
    static constexpr double kLongest = 0.5;

    // From a copy of each column, because FFTW takes longer in place.
    void transform(const FftwfPlan& plan) {
        for (int kx = 0; kx < columns_; ++kx) {
            Complex* const c = store_.get() + kx * stride_;
            std::copy_n(c, m_, rows_.get());
            fftwf_execute_dft(plan.get(), fftw(rows_.get()), fftw(c));
        }
    }

    // Calls visit(k, place of the modes in the columns, count) for runs of modes k, k + 1, ...
    template <class Visit>
    void each(Visit visit) const {
        std::size_t k = 0;
        for (const auto& [place, count] : runs_) {
            visit(k, store_.get() + place, count);
            k += count;
        }
    }

    // The heights of the modes, and their moments.
    HeightShape heights() {
        std::fill_n(store_.get(), columns_ * stride_, Complex());
        each([&](std::size_t k, Complex* to, std::size_t count) { std::copy_n(mode_.data() + k, count, to); });
        for (int ky = 1; 2 * ky < m_; ++ky) store_[m_ - ky] = std::conj(store_[ky]);  // kx = 0 contains its own mirror image
        transform(plans_->up);
        double m2 = 0, m3 = 0, m4 = 0;
        for (int j = 0; j < m_; j += kBlock) {
            const int count = std::min(kBlock, m_ - j);
            for (int kx = 0; kx < columns_; ++kx) {
                const Complex* const from = store_.get() + kx * stride_ + j;
                for (int r = 0; r < count; ++r) rows_[r * row_stride_ / 2 + kx] = from[r];
            }
            for (int r = 0; r < count; ++r) {
                Complex* const row = rows_.get() + r * row_stride_ / 2;
                std::fill(row + columns_, row + m_ / 2 + 1, Complex());
                fftwf_execute_dft_c2r(plans_->to_heights.get(), fftw(row), numbers(heights_) + (j + r) * row_stride_);
            }
            float second[kLanes] = {}, third[kLanes] = {}, fourth[kLanes] = {};
            add_powers(numbers(heights_) + j * row_stride_, count * row_stride_, second, third, fourth);  // rows end with zeros
            m2 += sum(second), m3 += sum(third), m4 += sum(fourth);
        }
        const double points = static_cast<double>(m_) * m_, variance = m2 / points;
        return {m3 / points / (variance * std::sqrt(variance)), m4 / points / (variance * variance)};  // the mean is 0: no mode (0, 0)
    }

    // Fourier coefficients of a function of the heights, by column.
    template <class Function>
    void coefficients(Function of) {
        float* const line = numbers(line_);
        for (int j = 0; j < m_; j += kBlock) {
            const int count = std::min(kBlock, m_ - j);
            for (int r = 0; r < count; ++r) {
                const float* const from = numbers(heights_) + (j + r) * row_stride_;
                for (int i = 0; i < m_; ++i) line[i] = of(from[i]);
                fftwf_execute_dft_r2c(plans_->to_modes.get(), line, fftw(rows_.get() + r * row_stride_ / 2));
            }
            for (int kx = 0; kx < columns_; ++kx) {
                Complex* const to = store_.get() + kx * stride_ + j;
                for (int r = 0; r < count; ++r) to[r] = rows_[r * row_stride_ / 2 + kx];
            }
        }
        transform(plans_->down);
    }

    // Parts of a change of heights along and across the modes, times their amplitude.
    struct Parts {
        std::vector<float> along, across;
    };
    template <class Function>
    void parts(Function of, Parts& to) {
        coefficients(of);
        to.along.resize(mode_.size()), to.across.resize(mode_.size());
        const float scale = 1 / (static_cast<float>(m_) * static_cast<float>(m_));
        each([&](std::size_t first, const Complex* change, std::size_t count) {
            const Complex* const mode = mode_.data() + first;
            for (std::size_t i = 0; i < count; ++i) {
                const float x = scale * mode[i].real(), y = scale * mode[i].imag();
                to.along[first + i] = x * change[i].real() + y * change[i].imag();
                to.across[first + i] = x * change[i].imag() - y * change[i].real();
            }
        });
    }

    // Newton's method for both moments with the smallest change of heights that phases allow: p z^2 + q z^3 without the parts along the modes.
    // The rotation of a mode, and the loss along its old direction, are not linearised, because modes of small amplitude rotate far.
    void step(HeightShape wish) {
        parts([](float z) { return z * z; }, second_);
        parts([](float z) { return z * z * z; }, third_);
        // skewness = <z^3>, kurtosis = <z^4>; every mode counts twice. A change of the skewness by p z^2 alone raises the kurtosis of Gaussian
        // heights by 4/3 of its square.
        const double change = wish.skewness - now_.skewness, s = change / 6,
                     t = (wish.kurtosis - now_.kurtosis - 4.0 / 3 * change * change) / 8;
        alignas(64) float tangent[kBatch], cosine[kBatch];
        float p = 0, q = 0;
        for (int i = 0; i < kSteps; ++i) {
            double sums[5] = {0, 0, 0, s, t};
            for (std::size_t k = 0; k < mode_.size(); k += kBatch)
                add_rotated(&second_.across[k], &third_.across[k], &second_.along[k], &third_.along[k], &inverse_[k], p, q, sums);
            const auto [a, b, c, s1, t1] = sums;
            const double determinant = a * c - b * b;
            if (!(determinant > 0)) return;
            p = static_cast<float>((c * s1 - b * t1) / determinant), q = static_cast<float>((a * t1 - b * s1) / determinant);
            const double size = std::sqrt(2 * (p * p * a + 2 * p * q * b + q * q * c));
            if (const float most = static_cast<float>(kLongest / size); most < 1) p *= most, q *= most;
        }
        for (std::size_t k = 0; k < mode_.size(); k += kBatch) {
            angles(&second_.across[k], &third_.across[k], &inverse_[k], p, q, tangent, cosine);
            for (std::size_t i = 0; i < kBatch; ++i) {
                const float x = cosine[i] * mode_[k + i].real(), y = cosine[i] * mode_[k + i].imag();
                mode_[k + i] = {x - tangent[i] * y, y + tangent[i] * x};
            }
        }
    }

    void give() {
        std::size_t k = 0;
        modes_.runs([&](int, int, int count, std::complex<double>* c) {
            for (int i = 0; i < count; ++i, ++k) {
                const double re = kept_[k].real(), im = kept_[k].imag(), square = re * re + im * im;
                if (!(square > 0)) continue;
                const double size = std::sqrt(std::norm(c[i]) / square);
                c[i] = {size * re, size * im};
            }
        });
    }

    static constexpr int kSteps = 3;

    // Bins over +-kRange rms heights; the outermost include all larger heights.
    static constexpr float kRange = 12, kPerUnit = kBins / (2 * kRange);
    static std::size_t place_of(float z) {
        return static_cast<std::size_t>(std::clamp((z + kRange) * kPerUnit, 0.0f, static_cast<float>(kBins - 1)));
    }

    // Heights replaced by rank.
    void replace(const HeightDistribution& by) {
        long bin[kBins] = {};
        for (int j = 0; j < m_; j += std::max(1, m_ / 128))  // enough rows
            for (int i = 0; i < m_; ++i) ++bin[place_of(numbers(heights_)[j * row_stride_ + i])];
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
        each([&](std::size_t k, const Complex* c, std::size_t count) {
            for (std::size_t i = 0; i < count; ++i)
                if (const float square = std::norm(c[i]); square > 1e-30f)
                    mode_[k + i] = c[i] * std::sqrt(std::norm(mode_[k + i]) / square);
        });
    }

    const Modes& modes_;
    int m_, columns_;
    std::ptrdiff_t stride_, row_stride_;  // strides of columns (complex numbers) and rows (real numbers)
    Memory store_, rows_, heights_, line_;
    std::vector<std::pair<std::ptrdiff_t, std::size_t>> runs_;  // places in the columns and lengths of the runs of modes
    std::shared_ptr<const Plans> plans_;
    HeightShape now_;
    std::vector<Complex> mode_, kept_;  // for an rms height of 1; kept_: those nearest to the wish
    std::vector<float> inverse_;        // of the squared amplitudes; 0 for a mode that is none
    Parts second_, third_;
};

// Number of points, fast to transform: enough for fourth powers if there are few modes; with many modes more are not required.
int points(const Band& band) {
    const double highest = std::max({band.highest_kx, band.highest_ky, 16});
    return 8 * fast_size(std::max(2.1 * highest + 2, std::min(4.1 * highest, 64.0)) / 8);
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
    int b = 0;
    while (b < bins && found < share * total) found += energy[static_cast<std::size_t>(b++)];
    const double q = static_cast<double>(b) / bins;
    return {ellipse(modes.whole, modes.band.stretched, modes.band.highest_q2 * q * q), found / total};
}

}  // namespace

HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns, std::ptrdiff_t stride, int n) {
    const Band whole = band(spectrum);
    Modes all{whole, whole, columns, stride, n};
    if (spectrum.plane) {
        // The table of a measured map ends with its grid, and its spectrum often before that.
        const Stretch form = power_ellipse(spectrum);
        all.band = ellipse(whole, form, whole.highest_q2 * (form.xx + form.yy));
        all.band = long_waves(all, 1 - 1e-12).first;
    }
    const HeightShape wish = spectrum.heights ? spectrum.heights->shape() : spectrum.shape;
    // At first only the long waves are changed. The short ones remain Gaussian and uncorrelated with them, so the skewness and excess
    // kurtosis of the sum are those of the long waves times powers of their share.
    const auto [band, share] = long_waves(all, 0.92);
    const auto of_long_waves = [s = share](double skewness, double kurtosis) {
        return HeightShape{skewness / (s * std::sqrt(s)), kurtosis / (s * s)};
    };
    HeightShape ask = of_long_waves(wish.skewness, wish.kurtosis - 3), got;
    ask.kurtosis += 3;
    const Modes longest{whole, band, columns, stride, n};
    Field coarse(longest, points(band)), fine(all, points(all.band));
    constexpr int coarse_rounds = 10, corrections = 3, fine_rounds = 20;
    constexpr double far = 4;  // beyond, all waves are changed at once
    double off = 0;
    coarse.take();
    for (int i = 0; i < corrections && (i == 0 || (off > 1 && off < far)); ++i) {
        coarse.run(usable(ask), nullptr, i == 0 ? 0.6 : 1, coarse_rounds, 0.75);
        got = fine.take();
        off = distance(got, wish);
        const auto [skewness, kurtosis] = of_long_waves(wish.skewness - got.skewness, wish.kurtosis - got.kurtosis);
        ask.skewness += skewness, ask.kurtosis += kurtosis;
    }
    if (off > 1 || spectrum.heights) got = fine.run(wish, spectrum.heights.get(), spectrum.heights ? 0.3 : 1, fine_rounds, HUGE_VAL);
    for (int ky = 1; ky <= whole.highest_ky; ++ky) columns[n - ky] = std::conj(columns[ky]);  // kx = 0
    return got;
}

}  // namespace rsc
