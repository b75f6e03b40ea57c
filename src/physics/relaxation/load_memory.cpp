#include "physics/relaxation/load_memory.hpp"

#include "base/error.hpp"

namespace rsc {
LoadMemory::LoadMemory(const Relaxation& body)
    : body_(body),
      steps_(body.shortest()),
      creep_(body),
      passage_(creep_, 0),
      y_(creep_.retardations().size()),
      yf_(y_.size(), 0.0),
      yy_(y_.size(), 0.0) {}

std::vector<double> LoadMemory::rest() const {
    std::vector<double> r(places_.size(), 0.0);
    for (const auto k : indices(y_))
        for (const auto i : indices(r))
            r[i] += passage_.lags[k].stay * y_[k][i] + passage_.lags[k].before * f_[i];
    return r;
}

std::vector<double> LoadMemory::lasting() const {
    std::vector<double> sum = f_;
    for (const auto& y : y_)
        std::transform(y.begin(), y.end(), sum.begin(), sum.begin(), std::plus{});
    return sum;
}

void LoadMemory::accept(std::span<const std::int32_t> where, std::span<const double> f,
                        const Deflect& deflect) {
    std::vector<std::int32_t> all;
    std::set_union(places_.begin(), places_.end(), where.begin(), where.end(),
                   std::back_inserter(all));
    const auto spread = [&](std::span<const std::int32_t> at, std::span<const double> values) {
        std::vector<double> over(all.size(), 0.0);
        for (std::size_t i = 0, k = 0; k < at.size(); ++i)
            if (all[i] == at[k]) over[i] = values[k++];
        return over;
    };
    const std::vector<double> now = spread(where, f), before = spread(places_, f_);
    for (auto& y : y_) y = spread(places_, y);
    places_ = std::move(all);
    const std::vector<double> d = deflect(now);
    const double f01 = dot(before, d), f11 = dot(now, d), f00 = ff_, stored_before = stored();
    // Twice the work (f_0 + f_1)'K (l_1 - l_0)/2 of the step, l = f + sum y_k, by the trapezoidal
    // rule: none at a constant separation.
    double twice = f11 - f00;
    for (const auto k : indices(y_)) {
        const auto [stay, a, b] = passage_.lags[k];
        const double y0d = dot(y_[k], d), yf = yf_[k], yy = yy_[k];
        twice += (stay - 1) * (yf + y0d) + a * (f00 + f01) + b * (f01 + f11);
        yy_[k] = stay * stay * yy + a * a * f00 + b * b * f11 +
                 2 * (stay * a * yf + stay * b * y0d + a * b * f01);
        yf_[k] = stay * y0d + a * f01 + b * f11;
        for (const auto i : indices(now)) y_[k][i] = stay * y_[k][i] + a * before[i] + b * now[i];
    }
    f_ = now;
    ff_ = f11;
    lost_ += 0.5 * twice - (stored() - stored_before);
}

double LoadMemory::stored() const {
    double sum = ff_;
    for (const auto k : indices(y_))
        sum += creep_.retardations()[k].rate / creep_.retardations()[k].flow * yy_[k];
    return 0.5 * sum;
}

void LoadMemory::forget() { *this = LoadMemory(Relaxation(body_)); }

void LoadMemory::write(std::vector<double>& numbers) const {
    append(numbers, {double(places_.size()), ff_, lost_});
    append(numbers, yf_);
    append(numbers, yy_);
    append(numbers, places_);
    append(numbers, f_);
    for (const auto& y : y_) append(numbers, y);
}

std::size_t LoadMemory::read(std::span<const double> numbers) {
    forget();
    const std::size_t terms = y_.size(), head = 3 + 2 * terms;
    const double count = numbers.size() >= head ? numbers[0] : -1;
    if (!(count >= 0 && count <= 2147483647.0) || numbers.size() < head + at(count) * (2 + terms) ||
        std::ranges::any_of(numbers, [](double v) { return !std::isfinite(v); }))
        bad_input("the state of the loads is invalid");
    const auto n = at(count);
    const double* next = numbers.data() + 1;
    const auto take = [&](std::vector<double>& to, std::size_t size) {
        to.assign(next, next + size);
        next += size;
    };
    ff_ = *next++;
    lost_ = *next++;
    take(yf_, terms);
    take(yy_, terms);
    for (std::size_t i = 0; i < n; ++i) places_.push_back(std::int32_t(*next++));
    take(f_, n);
    for (auto& y : y_) take(y, n);
    if (!std::ranges::is_sorted(places_) || (n > 0 && places_[0] < 0))
        bad_input("the state of the loads is invalid");
    return at(next - numbers.data());
}

}  // namespace rsc
