#include <boost/math/special_functions/erf.hpp>

#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "surface/height_distribution.hpp"
#include "surface/mode_rotation.hpp"
#include "surface/surface.hpp"

namespace rsc {
namespace {

using Complex = std::complex<float>;
constexpr int kBatch = kRotatedModes;

// Tolerances, smaller than the documented 0.02 and 0.05, which hold on any grid.
constexpr double kNearSkewness = 0.016, kNearKurtosis = 0.04;
double distance(HeightShape got, HeightShape wish) {
    return std::max(std::abs(got.skewness - wish.skewness) / kNearSkewness,
                    std::abs(got.kurtosis - wish.kurtosis) / kNearKurtosis);
}

// Kept feasible, away from distributions of two values.
HeightShape usable(HeightShape shape) {
    const double skewness = std::clamp(shape.skewness, -6.0, 6.0);
    return {skewness, std::clamp(shape.kurtosis, 1.2 * skewness * skewness + 1.3, 90.0)};
}

// Modes of the half plane within an ellipse (and the band of the surface), stored in the columns of
// the caller.
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
            if (const int from = std::max(first, kx > 0 ? 0 : 1); from <= last)
                visit(kx, from, last - from + 1, column + from);
            if (const int to = std::min(last, -1); kx > 0 && first <= to)
                visit(kx, first, to - first + 1, column + first + n);
        }
    }
};

// Surface of some of the modes on m x m points. Single precision suffices, because only the phases
// of the modes are used.
class Field {
public:
    Field(const Modes& modes, int m)
        : modes_(modes), m_(m), columns_(modes.band.highest_kx + 1), stride_(m + 8) {
        store_ = allocate(at(columns_) * at(stride_));
        rows_ = allocate(at(kBlock + 1) * at(m));
        line_ = rows_.get() + kBlock * m_;
        heights_ = allocate(at(m) * at(m) / 2);
        modes_.runs([&](int kx, int ky, int count, const std::complex<double>*) {
            runs_.push_back({kx, ky < 0 ? ky + m_ : ky, count});
        });
        make_plans();
    }

    // The heights of the caller's modes, and their moments.
    HeightShape take() {
        double square = 0;
        std::size_t modes = 0;
        modes_.runs([&](int, int, int count, const std::complex<double>* c) {
            for (const int i : indices(count)) square += std::norm(c[i]);
            modes += at(count);
        });
        const double scale = square > 0 ? 1 / std::sqrt(2 * square) : 1;
        mode_.assign((modes + kBatch - 1) / kBatch * kBatch, Complex());
        std::size_t k = 0;
        modes_.runs([&](int, int, int count, const std::complex<double>* c) {
            for (int i = 0; i < count; ++i, ++k)
                mode_[k] = {float(scale * c[i].real()), float(scale * c[i].imag())};
        });
        inverse_.resize(mode_.size());
        for (std::size_t i = 0; i < mode_.size(); ++i) {
            const float square = std::norm(mode_[i]);
            inverse_[i] = square > 1e-30f ? 1 / square : 0;
        }
        return now_ = heights();
    }

    // Newton's method brings both moments to the wish, after heights are replaced by rank in a
    // distribution, if there is one, and the amplitudes of the modes are restored. It ends also
    // when a round leaves more than the share `still` of the distance. The best phases are stored
    // in the caller's columns.
    HeightShape run(HeightShape wish, const HeightDistribution* by, double near_enough, int rounds,
                    double still) {
        // times near_enough: one more step in the directions of the last one, which are known
        constexpr double close = 3;
        HeightShape best = now_;
        double nearest = HUGE_VAL, before = HUGE_VAL;
        bool again = true;
        step_ = 0;
        for (int round = 0;; ++round) {
            const double off = distance(now_, wish);
            if ((round > 0 || !by) && off < nearest) {
                nearest = off;
                best = now_;
                kept_ = mode_;
            }
            if (round >= rounds || nearest <= near_enough ||
                (!again && round > 2 && off > still * before))
                break;
            before = off;
            if (round == 0 && by) {
                replace(*by);
                now_ = heights();
                continue;
            }
            again = !again && off < close * near_enough;
            step(wish, again);
        }
        give();
        return best;
    }

private:
    struct Free {
        void operator()(Complex* p) const noexcept {
            HeightMap::Free()(reinterpret_cast<double*>(p));
        }
    };
    using Memory = std::unique_ptr<Complex[], Free>;
    static Memory allocate(std::size_t n) {
        return Memory(reinterpret_cast<Complex*>(
            allocate_doubles(n, "a surface whose heights are not Gaussian")));
    }
    static fftwf_complex* fftw(Complex* p) { return reinterpret_cast<fftwf_complex*>(p); }
    static float* numbers(Complex* p) { return reinterpret_cast<float*>(p); }
    static const float* numbers(const Complex* p) { return reinterpret_cast<const float*>(p); }
    void make_plans() {
        const auto lock = fftw_planning();
        for (auto [plan, sign] :
             {std::pair(&up_, FFTW_BACKWARD), std::pair(&down_, FFTW_FORWARD)}) {
            plan->reset(
                fftwf_plan_dft_1d(m_, fftw(line_), fftw(store_.get()), sign, FFTW_ESTIMATE));
            if (!*plan)
                throw Error(Failure::internal,
                            "surface: FFTW made no plan for heights that are not Gaussian");
        }
    }
    static constexpr int kBlock = 8;  // pairs of rows at a time
    static constexpr int kBins = 1024;
    static constexpr double
        kFar = 0.8,
        kLongest = 0.5,
        kSmall = 0.35;  // rms changes of heights by a step: at most, if the wish is far or not

    // Calls visit(k, place of the modes in column kx, count) for its runs of modes k, k + 1, ...;
    // next, k: the state of a walk over all columns.
    template <class Next, class Visit>
    void each(int kx, Next& next, std::size_t& k, Visit visit) const {
        for (; next != runs_.end() && next->kx == kx; k += at(next++->count))
            visit(k, next->first, at(next->count));
    }

    // The heights of the modes, and their moments. Rows 2i and 2i + 1 are the real and imaginary
    // parts of one transform.
    HeightShape heights() {
        auto next = runs_.begin();
        std::size_t done = 0;
        for (int kx = 0; kx < columns_; ++kx) {
            std::fill_n(line_, m_, Complex());
            each(kx, next, done, [&](std::size_t k, int first, std::size_t count) {
                std::copy_n(mode_.data() + k, count, line_ + first);
            });
            for (int ky = 1; kx == 0 && 2 * ky < m_; ++ky)
                line_[m_ - ky] = std::conj(line_[ky]);  // kx = 0 contains its own mirror image
            fftwf_execute_dft(up_.get(), fftw(line_), fftw(store_.get() + kx * stride_));
        }
        double sums[3] = {};
        for (int j = 0; j < m_ / 2; j += kBlock) {
            const int count = std::min(kBlock, m_ / 2 - j);
            for (const int r : indices(count)) {
                rows_[r * m_] = {store_[2 * (j + r)].real(), store_[2 * (j + r) + 1].real()};
                std::fill_n(rows_.get() + r * m_ + columns_, m_ - 2 * columns_ + 1, Complex());
            }
            for (int kx = 1; kx < columns_; ++kx) {
                const Complex* const from = store_.get() + kx * stride_ + 2 * j;
                Complex *const to = rows_.get() + kx, *const mirror = rows_.get() + m_ - kx;
                for (const int r : indices(count)) {
                    const Complex a = from[2 * r], b = from[2 * r + 1];
                    to[r * m_] = {a.real() - b.imag(), a.imag() + b.real()};
                    mirror[r * m_] = {a.real() + b.imag(), b.real() - a.imag()};
                }
            }
            Complex* const z = heights_.get() + j * m_;
            for (const int r : indices(count))
                fftwf_execute_dft(up_.get(), fftw(rows_.get() + r * m_), fftw(z + r * m_));
            add_powers(numbers(z), 2 * count * m_, sums);
        }
        const double points = double(m_) * m_, variance = sums[0] / points;
        // The mean is 0: no mode (0, 0).
        return {sums[1] / points / (variance * std::sqrt(variance)),
                sums[2] / points / (variance * variance)};
    }

    // Twice the Fourier coefficients of a function of the heights: visit(k, coefficients, count)
    // for runs of modes k, k + 1, ...
    template <class Function, class Visit>
    void coefficients(Function of, Visit visit) {
        for (int j = 0; j < m_ / 2; j += kBlock) {
            const int count = std::min(kBlock, m_ / 2 - j);
            for (const int r : indices(count)) {
                const float* const z = numbers(heights_.get() + (j + r) * m_);
                for (const int i : indices(2 * m_)) numbers(line_)[i] = of(z[i]);
                fftwf_execute_dft(down_.get(), fftw(line_), fftw(rows_.get() + r * m_));
            }
            for (const int kx : indices(columns_)) {
                const Complex *const from = rows_.get() + kx, *const mirror =
                                                                  rows_.get() +
                                                                  (kx > 0 ? m_ - kx : 0);
                Complex* const to = store_.get() + kx * stride_ + 2 * j;
                for (const int r : indices(count)) {
                    const Complex a = from[r * m_], b = mirror[r * m_];
                    to[2 * r] = {a.real() + b.real(), a.imag() - b.imag()};
                    to[2 * r + 1] = {a.imag() + b.imag(), b.real() - a.real()};
                }
            }
        }
        auto next = runs_.begin();
        std::size_t done = 0;
        for (const int kx : indices(columns_)) {
            fftwf_execute_dft(down_.get(), fftw(store_.get() + kx * stride_), fftw(line_));
            each(kx, next, done, [&](std::size_t k, int first, std::size_t count) {
                visit(k, line_ + first, count);
            });
        }
    }

    // Parts of a change of heights along and across the modes, times their amplitude.
    struct Parts {
        std::vector<float> along, across;
    };
    template <class Function>
    void parts(Function of, Parts& to) {
        to.along.resize(mode_.size());
        to.across.resize(mode_.size());
        const float scale = 0.5f / (float(m_) * float(m_));
        coefficients(of, [&](std::size_t first, const Complex* change, std::size_t count) {
            const Complex* const mode = mode_.data() + first;
            for (const auto i : indices(count)) {
                const float x = scale * mode[i].real(), y = scale * mode[i].imag();
                to.along[first + i] = x * change[i].real() + y * change[i].imag();
                to.across[first + i] = x * change[i].imag() - y * change[i].real();
            }
        });
    }

    // Newton's method for both moments with the smallest change of heights that phases allow: p z^2
    // + q z^3 without the parts along the modes.
    // The rotation of a mode, and the loss along its old direction, are not linearised, because
    // modes of small amplitude rotate far. What the step before missed, this one is expected to
    // miss in proportion to the square of its size. again: from the same heights as the step
    // before, corrected by what it missed.
    void step(HeightShape wish, bool again) {
        if (!again) {
            parts([](float z) { return z * z; }, second_);
            parts([](float z) { return z * z * z; }, third_);
            from_ = now_;
            std::swap(from_mode_, mode_);
            mode_.resize(from_mode_.size());
        }
        // skewness = <z^3>, kurtosis = <z^4>; every mode counts twice. A change of the skewness by
        // p z^2 alone raises the kurtosis of Gaussian heights by 4/3 of its square.
        const double skewness = wish.skewness - from_.skewness,
                     kurtosis = wish.kurtosis - from_.kurtosis;
        double s = skewness / 6, t = (kurtosis - 4.0 / 3 * skewness * skewness) / 8, size = 0;
        const auto expect = [&](double share) {
            s = (skewness - share * missed_.skewness) / 6;
            t = (kurtosis - share * missed_.kurtosis) / 8;
        };
        if (again) expect(1);
        alignas(64) float tangent[kBatch], cosine[kBatch];
        HeightShape predicted;
        float p = 0, q = 0;
        for (int i = 0; i < kSteps; ++i) {
            double sums[5] = {};
            for (std::size_t k = 0; k < mode_.size(); k += kBatch)
                add_rotated(&second_.across[k], &third_.across[k], &second_.along[k],
                            &third_.along[k], &inverse_[k], p, q, sums);
            const auto [a, b, c, lost_s, lost_t] = sums;
            const double determinant = a * c - b * b, s1 = s + lost_s, t1 = t + lost_t;
            if (!(determinant > 0)) break;
            p = float((c * s1 - b * t1) / determinant);
            q = float((a * t1 - b * s1) / determinant);
            size = std::sqrt(2 * (p * p * a + 2 * p * q * b + q * q * c));
            const double longest = size > 1 ? kFar : kLongest;
            if (const float most = float(longest / size); most < 1) {
                p *= most;
                q *= most;
            }
            size = std::min(size, longest);
            predicted = {6 * (a * p + b * q - lost_s), 8 * (b * p + c * q - lost_t)};
            if (!again && step_ > 0 && step_ <= kLongest && size < kSmall)
                expect(size * size / (step_ * step_));
        }
        for (std::size_t k = 0; k < mode_.size(); k += kBatch) {
            rotation_angles(&second_.across[k], &third_.across[k], &inverse_[k], p, q, tangent,
                            cosine);
            for (std::size_t i = 0; i < kBatch; ++i) {
                const float x = cosine[i] * from_mode_[k + i].real(),
                            y = cosine[i] * from_mode_[k + i].imag();
                mode_[k + i] = {x - tangent[i] * y, y + tangent[i] * x};
            }
        }
        now_ = heights();
        step_ = size;
        missed_ = {now_.skewness - from_.skewness - predicted.skewness,
                   now_.kurtosis - from_.kurtosis - predicted.kurtosis};
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
        return at(std::clamp((z + kRange) * kPerUnit, 0.0f, float(kBins - 1)));
    }

    // Heights replaced by rank.
    void replace(const HeightDistribution& by) {
        long bin[kBins] = {};
        for (int j = 0; j < m_ / 2; j += std::max(1, m_ / 256))  // enough rows
            for (const int i : indices(2 * m_))
                ++bin[place_of(numbers(heights_.get() + j * m_)[i])];
        double total = 0, below = 0;
        for (const long count : bin) total += double(count);
        float value[kBins + 1];
        for (std::size_t b = 0; b <= kBins; ++b) {
            const double p = std::clamp(below / total, 0.5 / total, 1 - 0.5 / total);
            using Policy =
                boost::math::policies::policy<boost::math::policies::promote_double<false>>;
            value[b] = float(by(-std::numbers::sqrt2 * boost::math::erfc_inv(2 * p, Policy())));
            if (b < kBins) below += double(bin[b]);
        }
        const auto ranked = [&](float z) {
            const float at = std::clamp((z + kRange) * kPerUnit, 0.0f, float(kBins));
            const std::size_t k = std::min(std::size_t(at), std::size_t(kBins - 1));
            return value[k] + (value[k + 1] - value[k]) * (at - float(k));
        };
        coefficients(ranked, [&](std::size_t k, const Complex* c, std::size_t count) {
            for (const auto i : indices(count))
                if (const float square = std::norm(c[i]); square > 1e-30f)
                    mode_[k + i] = c[i] * std::sqrt(std::norm(mode_[k + i]) / square);
        });
    }

    struct Run {
        int kx, first, count;  // modes from place `first` of column kx on
    };
    const Modes& modes_;
    int m_, columns_;
    std::ptrdiff_t stride_;          // of columns
    Memory store_, rows_, heights_;  // heights_: of pairs of rows
    Complex* line_;                  // a column or a row
    std::vector<Run> runs_;
    FftwfPlan up_, down_;  // transforms of a line
    HeightShape now_, from_,
        missed_;       // the heights' now and before the last step; what that one missed
    double step_ = 0;  // rms change of heights by the last step
    std::vector<Complex> mode_, kept_,
        from_mode_;               // for an rms height of 1; kept_: those nearest to the wish
    std::vector<float> inverse_;  // of the squared amplitudes; 0 for a mode that is none
    Parts second_, third_;
};

// Number of points: 4, 5 or 6 times a power of two, for which FFTW's complex transform takes half
// the time per point or less of others. Enough for fourth powers if there are few modes; with many
// modes more are not required.
int points(const Band& band) {
    const double highest = std::max({band.highest_kx, band.highest_ky, 16});
    const double least = std::max(2.1 * highest + 2, std::min(4.1 * highest, 64.0));
    for (int power = 16;; power *= 2)
        for (int m : {4 * power, 5 * power, 6 * power})
            if (m >= least) return m;
}

Band ellipse(const Band& whole, const Stretch& stretched, double q2) {
    Band b{stretched, 0, q2, 0, 0};
    b.highest_kx = std::min(whole.highest_kx, int(std::sqrt(stretched.yy * q2)));
    b.highest_ky = std::min(whole.highest_ky, int(std::sqrt(stretched.xx * q2)));
    return b;
}

// The ellipses of equal power of a spectrum by direction are those of its second moments: k = A k'
// with k' isotropic has the moments A A^T.
// They are exact if the spectrum is an isotropic one that is stretched.
Stretch power_ellipse(const Spectrum& spectrum) {
    if (!spectrum.by_direction()) return stretch(spectrum);
    const double xx = spectrum.table->integral(2, 0), xy = spectrum.table->integral(1, 1),
                 yy = spectrum.table->integral(0, 2);
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 1e-6 * xx * yy)) return {};  // all waves have one direction
    const double scale = 1 / std::sqrt(determinant);
    return {scale * yy, -scale * xy, scale * xx};
}

// The smallest ellipse of the shape of modes.band with at least `share` of the mean square height,
// and its actual share.
std::pair<Band, double> long_waves(const Modes& modes, double share) {
    constexpr int bins = 1024;
    std::vector<double> energy(bins + 1);
    const double scale = 1 / modes.band.highest_q2;
    double total = 0, found = 0;
    modes.runs([&](int kx, int ky, int count, const std::complex<double>* c) {
        for (const int i : indices(count)) {
            const double e = std::norm(c[i]),
                         q = std::sqrt(scale * modes.band.stretched(kx, ky + i));
            energy[std::min<std::size_t>(bins, at(bins * q))] += e;
            total += e;
        }
    });
    int b = 0;
    while (b < bins && found < share * total) found += energy[at(b++)];
    const double q = double(b) / bins;
    return {ellipse(modes.whole, modes.band.stretched, modes.band.highest_q2 * q * q),
            found / total};
}

}  // namespace

HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns,
                            std::ptrdiff_t stride, int n) {
    const Band whole = band(spectrum);
    Modes all{whole, whole, columns, stride, n};
    if (spectrum.by_direction()) {
        // The table of a measured map ends with its grid, and its spectrum often before that.
        const Stretch form = power_ellipse(spectrum);
        all.band = ellipse(whole, form, whole.highest_q2 * (form.xx + form.yy));
        all.band = long_waves(all, 1 - 1e-12).first;
    }
    const HeightShape wish = spectrum.heights ? spectrum.heights->shape() : spectrum.shape;
    // Long waves are changed. The short ones remain Gaussian and uncorrelated with them, so the
    // skewness and excess kurtosis of the sum are those of the long waves times powers of their
    // share.
    const auto of_long_waves = [](HeightShape sum, double share) {
        return HeightShape{sum.skewness / (share * std::sqrt(share)),
                           3 + (sum.kurtosis - 3) / (share * share)};
    };
    Modes longest = all, most = all;
    double share = 1, share_of_most = 1;
    std::tie(longest.band, share) = long_waves(all, 0.92);
    if (!spectrum.heights && std::max(all.band.highest_kx, all.band.highest_ky) > 200)
        std::tie(most.band, share_of_most) = long_waves(all, 0.985);
    Field coarse(longest, points(longest.band)), fine(most, points(most.band));
    const HeightShape fine_wish = of_long_waves(wish, share_of_most);
    HeightShape ask = of_long_waves(wish, share), got;
    constexpr int coarse_rounds = 10, corrections = 3, fine_rounds = 20;
    constexpr double far = 4;  // beyond, all waves are changed at once
    double off = 0;
    coarse.take();
    for (int i = 0; i < corrections && (i == 0 || (off > 1 && off < far)); ++i) {
        coarse.run(usable(ask), nullptr, i == 0 ? 0.6 : 1, coarse_rounds, 0.5);
        got = fine.take();
        off = distance(got, fine_wish);
        const auto [skewness, kurtosis] = of_long_waves(
            {fine_wish.skewness - got.skewness, 3 + fine_wish.kurtosis - got.kurtosis},
            share / share_of_most);
        ask.skewness += skewness;
        ask.kurtosis += kurtosis - 3;
    }
    if (off > 1 || spectrum.heights)
        got = fine.run(fine_wish, spectrum.heights.get(), spectrum.heights ? 0.3 : 1, fine_rounds,
                       HUGE_VAL);
    got = of_long_waves(got, 1 / share_of_most);
    if (distance(got, wish) > 1 && share_of_most < 1) {
        Field whole(all, points(all.band));
        whole.take();
        got = whole.run(wish, nullptr, 1, fine_rounds, HUGE_VAL);
    }
    for (int ky = 1; ky <= whole.highest_ky; ++ky)
        columns[n - ky] = std::conj(columns[ky]);  // kx = 0
    return got;
}

}  // namespace rsc
