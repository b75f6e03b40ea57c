#include "interaction/pair_matrix.hpp"

#include "base/dispatch.hpp"

namespace rsc {
namespace {

// rows added in single precision before they are added in double precision
constexpr std::size_t kRows = 128;

// Elements begin ... end - 1 of kMany rows of the matrix: sum[k] += row[k] . force, and back += sum
// of f[k] row[k]. Products and sums are not contracted, so that all instruction sets give the same
// bits.
constexpr std::size_t kMany = 4;
template <class Real>
struct Rows {
    std::size_t begin, end;
    const Real* row[kMany];
    Real f[kMany];
    const Real* force;
    Real* back;
    Real* sum;
};

template <class Real, std::size_t rows, bool with_back>
RSC_ALWAYS_INLINE void rows_body(const Rows<Real>& given) {
    const Rows<Real> r = given;  // a copy, whose members cannot change by writing to r.back
    constexpr std::size_t W = 32 / sizeof(Real);
    using V [[gnu::vector_size(32)]] = Real;
    // Read through a pointer: GCC 12 copies arrays that are filled by memcpy through memory, at a
    // third of the speed.
    using Unaligned [[gnu::vector_size(32), gnu::aligned(alignof(Real)), gnu::may_alias]] = Real;
    V sum[rows] = {};
    std::size_t j = r.begin;
    for (; j + W <= r.end; j += W) {
        const V force = *reinterpret_cast<const Unaligned*>(r.force + j);
        V back;
        if constexpr (with_back) back = *reinterpret_cast<const Unaligned*>(r.back + j);
        for (std::size_t k = 0; k < rows; ++k) {
            const V g = *reinterpret_cast<const Unaligned*>(r.row[k] + j);
            sum[k] += g * force;
            if constexpr (with_back) back += r.f[k] * g;
        }
        if constexpr (with_back) *reinterpret_cast<Unaligned*>(r.back + j) = back;
    }
    for (std::size_t k = 0; k < rows; ++k) {
        Real total = r.sum[k];
        for (std::size_t lane = 0; lane < W; ++lane) total += sum[k][lane];
        for (std::size_t i = j; i < r.end; ++i) {
            total += r.row[k][i] * r.force[i];
            if constexpr (with_back) r.back[i] += r.f[k] * r.row[k][i];
        }
        r.sum[k] = total;
    }
}

RSC_DISPATCH(both_many, (rows_body<double, kMany, true>), (const Rows<double>& rows), (rows))
RSC_DISPATCH(both_many, (rows_body<float, kMany, true>), (const Rows<float>& rows), (rows))
RSC_DISPATCH(both_one, (rows_body<double, 1, true>), (const Rows<double>& rows), (rows))
RSC_DISPATCH(both_one, (rows_body<float, 1, true>), (const Rows<float>& rows), (rows))
RSC_DISPATCH(sum_many, (rows_body<double, kMany, false>), (const Rows<double>& rows), (rows))
RSC_DISPATCH(sum_many, (rows_body<float, kMany, false>), (const Rows<float>& rows), (rows))
RSC_DISPATCH(sum_one, (rows_body<double, 1, false>), (const Rows<double>& rows), (rows))
RSC_DISPATCH(sum_one, (rows_body<float, 1, false>), (const Rows<float>& rows), (rows))

// exact = value + near/d + shift, or `self` for coinciding points, to which 1/d does not apply;
// rough = exact inverse_unit.
struct Singular {
    std::size_t n;
    const double *squares, *value;
    double near, shift, self, inverse_unit;
    double* exact;
    float* rough;
};
RSC_ALWAYS_INLINE void singular_body(const Singular& given) {
    const Singular s = given;
    for (std::size_t k = 0; k < s.n; ++k) {
        const double apart = s.value[k] + (s.shift + s.near / std::sqrt(s.squares[k]));
        s.exact[k] = s.squares[k] > 0 ? apart : s.self;
        s.rough[k] = static_cast<float>(s.exact[k] * s.inverse_unit);
    }
}
RSC_DISPATCH(add_singular, singular_body, (const Singular& s), (s))

}  // namespace

std::size_t PairMatrix::Hash::operator()(const Place& place) const {
    const std::uint64_t a = std::bit_cast<std::uint64_t>(place.first) * 0x9e3779b97f4a7c15,
                        b = std::bit_cast<std::uint64_t>(place.second);
    const std::uint64_t mixed = (a ^ (a >> 29) ^ b) * 0xbf58476d1ce4e5b9;
    return static_cast<std::size_t>(mixed ^ (mixed >> 32));
}

void PairMatrix::forget() {
    points_.clear();
    numbers_.clear();
    active_.clear();
    summed_.clear();
    x_.clear();
    y_.clear();
    unit_ = 0;
    values_ = 0;
    small_ = 0;
}

bool PairMatrix::too_large(std::size_t active, std::size_t others) const {
    return active * (active / 2 + others) > kMostKeptValues;
}

bool PairMatrix::stale(std::size_t active) {
    constexpr int often = 16;
    small_ = x_.size() > 2 * active + 256 ? small_ + 1 : 0;
    return small_ > often || values_ > kMostKeptValues;
}

std::uint32_t PairMatrix::find(double x, double y) {
    const auto [at, fresh] =
        numbers_.try_emplace({x, y}, static_cast<std::uint32_t>(points_.size()));
    if (fresh) points_.push_back({x, y, kNone, {}, {}});
    return at->second;
}

// Computes the missing values of a point that is not a source.
void PairMatrix::extend(Point& point) {
    constexpr std::size_t kBlock = SquareTable::kBlock;
    double square[kBlock], value[kBlock] = {};
    const double self = kernel_->self();
    std::size_t from = point.exact.size();
    const std::size_t all = x_.size();
    if (from == all) return;
    values_ += all - from;
    point.exact.resize(all);
    point.rough.resize(all);
    for (; from < all; from += std::min(kBlock, all - from)) {
        const std::size_t count = std::min(kBlock, all - from);
        for (std::size_t k = 0; k < count; ++k) {
            const double dx = x_[from + k] - point.x, dy = y_[from + k] - point.y;
            square[k] = dx * dx + dy * dy;
        }
        if (kernel_->smooth()) kernel_->smooth()->table().values(count, square, value);
        if (!(unit_ > 0)) unit_ = kernel_->near() / std::sqrt(square[0] > 0 ? square[0] : 1);
        add_singular({count, square, value, kernel_->near(), kernel_->shift(), self, 1 / unit_,
                      point.exact.data() + from, point.rough.data() + from});
    }
}

bool PairMatrix::set_active(const std::vector<std::uint32_t>& active) {
    active_ = active;
    summed_.clear();
    for (const std::uint32_t k : active_) {
        Point& point = points_[k];
        if (point.source != kNone) continue;
        extend(point);
        point.source = static_cast<std::uint32_t>(x_.size());
        x_.push_back(point.x);
        y_.push_back(point.y);
    }
    place_.assign(x_.size(), kNone);
    for (std::uint32_t k = 0; k < active_.size(); ++k) place_[points_[active_[k]].source] = k;
    order_.clear();
    for (const std::uint32_t k : place_)
        if (k != kNone) order_.push_back(k);
    return order_.size() == active_.size();
}

// Sets the forces by source; returns their unit.
template <class Real>
double PairMatrix::begin(Sums<Real>& sums, const double* f) {
    double unit = 1;
    if constexpr (std::is_same_v<Real, float>) {
        double largest = 0;
        for (std::size_t k = 0; k < active_.size(); ++k)
            largest = std::max(largest, std::abs(f[k]));
        if (largest > 0) unit = largest;
    }
    sums.force.assign(x_.size(), 0);
    for (std::size_t k = 0; k < active_.size(); ++k)
        sums.force[points_[active_[k]].source] = static_cast<Real>(f[k] / unit);
    return unit;
}

template <class Real>
void PairMatrix::symmetric(Sums<Real>& sums, double* phi) {
    const std::size_t all = x_.size(), n = order_.size();
    sums.back.assign(all, 0);
    total_.assign(all, 0);
    for (std::size_t k = 0; k < n; k += kMany) {
        const std::size_t count = std::min(kMany, n - k);
        Real sum[kMany] = {};
        Rows<Real> rows{0, 0, {}, {}, sums.force.data(), sums.back.data(), sum};
        for (std::size_t i = 0; i < count; ++i) {
            const Point& point = points_[active_[order_[k + i]]];
            rows.row[i] = point.template row<Real>();
            rows.f[i] = sums.force[point.source];
        }
        // The rows have increasing lengths; what they have in common is read together.
        if (count == kMany) {
            rows.end = points_[active_[order_[k]]].source;
            both_many(rows);
        }
        for (std::size_t i = 0; i < count; ++i)
            if (const std::size_t end = points_[active_[order_[k + i]]].source; end > rows.end)
                both_one(Rows<Real>{
                    rows.end, end, {rows.row[i]}, {rows.f[i]}, rows.force, rows.back, sum + i});
        for (std::size_t i = 0; phi && i < count; ++i)
            phi[order_[k + i]] = static_cast<double>(sum[i]);
        if ((k + kMany) % kRows == 0 || k + kMany >= n)
            for (std::size_t j = 0; j < all; ++j)
                total_[j] += static_cast<double>(std::exchange(sums.back[j], Real(0)));
    }
}

void PairMatrix::among(bool single, const double* f, double* phi) {
    summed_.assign(f, f + active_.size());
    summed_single_ = single;
    const double unit = single ? begin(rough_, f) * unit_ : begin(exact_, f);
    if (single)
        symmetric(rough_, phi);
    else
        symmetric(exact_, phi);
    const double self = kernel_->self();
    for (std::size_t k = 0; k < active_.size(); ++k)
        phi[k] = unit * (phi[k] + total_[points_[active_[k]].source]) + self * f[k];
}

template <class Real>
void PairMatrix::rows_onto(Sums<Real>& sums, double unit, const std::vector<std::uint32_t>& targets,
                           double* phi) {
    for (std::size_t k = 0; k < targets.size(); k += kMany) {
        const std::size_t count = std::min(kMany, targets.size() - k);
        Real sum[kMany] = {};
        Rows<Real> rows{0, x_.size(), {}, {}, sums.force.data(), nullptr, sum};
        for (std::size_t i = 0; i < count; ++i) {
            rows.row[i] = points_[targets[k + i]].template row<Real>();
            rows.end = std::min(rows.end, points_[targets[k + i]].exact.size());
        }
        if (count == kMany)
            sum_many(rows);
        else
            rows.end = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Point& point = points_[targets[k + i]];
            if (rows.end < point.exact.size())
                sum_one(Rows<Real>{
                    rows.end, point.exact.size(), {rows.row[i]}, {}, rows.force, nullptr, sum + i});
            phi[k + i] = unit * (static_cast<double>(sum[i]) +
                                 (point.source != kNone ? total_[point.source] : 0));
        }
    }
}

void PairMatrix::onto(bool single, const double* f, const std::vector<std::uint32_t>& targets,
                      double* phi) {
    bool sources = false;
    for (const std::uint32_t k : targets) {
        sources = sources || points_[k].source != kNone;
        if (points_[k].source == kNone && points_[k].exact.size() < x_.size()) extend(points_[k]);
    }
    const double unit = single ? begin(rough_, f) * unit_ : begin(exact_, f);
    sources = sources && !(single == summed_single_ &&
                           std::equal(summed_.begin(), summed_.end(), f, f + active_.size()));
    if (sources && single) symmetric(rough_, nullptr);
    if (sources && !single) symmetric(exact_, nullptr);
    if (sources) summed_.clear();
    if (single)
        rows_onto(rough_, unit, targets, phi);
    else
        rows_onto(exact_, unit, targets, phi);
}

}  // namespace rsc
