// The table of variables of a result file, one function for each group of variables. Internal to
// the writer.
#pragma once

#include "base/format.hpp"
#include "case/units.hpp"
#include "contact/quantities.hpp"
#include "io/netcdf_file.hpp"
#include "io/result.hpp"

namespace rsc {

// In the comment of every variable that may have missing values.
inline constexpr const char* kAbsentMeans = "_FillValue: missing";

// The classic data model has no integers longer than 32 bits; larger counts are written as the
// largest one.
inline std::int32_t clamped(std::int64_t n) {
    return std::int32_t(std::min<std::int64_t>(n, std::numeric_limits<std::int32_t>::max()));
}
inline std::int32_t clamped(double n) { return clamped(std::int64_t(n)); }

// Numbers of levels, asperities, ... counted from 1, as in the file, and the attribute that tells
// it.
inline std::vector<std::int32_t> from_one(std::vector<std::int32_t> numbers) {
    for (std::int32_t& k : numbers) ++k;
    return numbers;
}
inline const std::pair<std::string, NetcdfAttribute> kFromOne{"start_index", std::int32_t{1}};

// value(0), value(1), ..., value(n - 1)
template <class Value>
std::vector<double> each_of(int n, Value value) {
    std::vector<double> all;
    for (const int k : indices(n)) all.push_back(value(k));
    return all;
}
// 1, 2, ..., n
inline std::vector<std::int32_t> one_to(std::size_t n) {
    std::vector<std::int32_t> all(n);
    std::iota(all.begin(), all.end(), 1);
    return all;
}

// flag_values from `first` on, with the names of the enumeration.
template <std::size_t n>
NetcdfAttributes flags(const std::array<const char*, n>& names, std::size_t first = 0) {
    std::vector<std::int32_t> values;
    std::string meanings;
    for (std::size_t k = first; k < n; ++k) {
        values.push_back(std::int32_t(k));
        enlist(meanings, " ", names[k]);
    }
    return {{"flag_values", values}, {"flag_meanings", meanings}};
}

// flag_masks, bit k for name k.
template <std::size_t n>
NetcdfAttributes masks(const std::array<const char*, n>& names) {
    NetcdfAttributes attributes = flags(names);
    std::vector<std::int32_t> bits;
    for (const auto k : indices(n)) bits.push_back(std::int32_t{1} << k);
    attributes[0] = {"flag_masks", bits};
    return attributes;
}

class ResultTable {
public:
    explicit ResultTable(const Result& result)
        : r_(result),
          o_(result.observations),
          length_(result.settings.run.length_unit),
          force_(result.settings.run.force_unit) {}

    // In the order in which ncdump prints them.
    NetcdfFile make(const std::string& history) {
        global_attributes(history);
        axes();
        levels();
        means();
        surfaces();
        measured();
        theory();
        regimes();
        maps();
        radial();
        distributions();
        curves();
        asperities();
        contacts();
        contact_mask();
        residual_profile();
        compared();
        heights();
        fields();
        return std::move(file_);
    }

private:
    using Names = std::vector<std::string>;

    // netcdf_levels.cpp
    void global_attributes(const std::string& history);
    void axes();
    void levels();
    void least_of(const LevelQuantity& q);
    double error_of_least(const LevelQuantity& q, std::size_t realization,
                          std::size_t levels) const;
    static bool computed(const std::vector<double>& values);
    NetcdfAttributes with_error(const LevelQuantity& q) const;
    void error_of(const LevelQuantity& q, const Names& shape);
    std::string components(std::size_t number);
    std::set<std::size_t> components_;  // whose dimensions are declared
    template <class T>
    static std::vector<T> pairs(const std::vector<T>& x, const std::vector<T>& y) {
        std::vector<T> both;
        for (const auto k : indices(x)) append(both, {x[k], y[k]});
        return both;
    }
    std::string units(const LevelQuantity& q) const {
        return q.unit_in(length_, force_, r_.settings.run.time_unit);
    }
    void means();
    void surfaces();
    void theory();
    void outline();
    void regimes();
    // netcdf_writer.cpp
    void measured();
    void measured_form(const Measured& m);
    void measured_heights(const Measured& m);
    void measured_spectrum(const Measured& m);
    void measured_quantiles(const Measured& m);
    void measured_profile(const MeasuredProfile& p);
    void measured_fit(const MeasuredSpectrum& spectrum, const SelfAffineFit& found);
    void two_flats(const Moments& moments);
    // netcdf_observed.cpp
    void maps();
    void radial();
    void distributions();
    void bin_axis(const std::string& name, const std::string& units, const std::string& long_name,
                  double width);
    void histogram(const std::string& name, const std::string& axis, const std::string& units,
                   const std::string& long_name, Histogram Distributions::*which,
                   const std::string& note);
    void density(const std::string& name, const std::string& axis, const std::string& units,
                 const std::string& long_name, std::vector<double> ShownDistributions::*which,
                 DistributionMoments ShownDistributions::*moments, NetcdfAttributes more,
                 const std::string& note);
    void pressure();
    void curves();
    void asperities();
    void contacts();
    void contact_mask();
    void residual_profile();
    void compared();
    void heights();
    void fields();

    std::string unit(int length_power, int force_power = 0) const {
        return unit_of(length_, length_power, force_, force_power);
    }

    static NetcdfAttributes comment(const std::string& text) {
        return text.empty() ? NetcdfAttributes{} : NetcdfAttributes{{"comment", text}};
    }
    template <class T>
    void add(const std::string& name, Names dimensions, const std::string& units,
             const std::string& long_name, std::vector<T> values,
             NetcdfAttributes attributes = {}) {
        file_.variable({name, std::move(dimensions), units, long_name, std::move(values),
                        std::move(attributes), false});
    }
    // A dimension and its variable.
    template <class T>
    void add_axis(const std::string& name, const std::string& units, const std::string& long_name,
                  std::vector<T> values, NetcdfAttributes attributes = {}) {
        file_.dimension(name, values.size());
        add(name, {name}, units, long_name, std::move(values), std::move(attributes));
    }
    // A single number.
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void add(const std::string& name, const std::string& units, const std::string& long_name,
             Number value, NetcdfAttributes attributes = {}) {
        add(name, Names{}, units, long_name, std::vector{value}, std::move(attributes));
    }
    // Incompressible data: unordered positions, heights, forces.
    void add_disorder(const std::string& name, Names dimensions, const std::string& units,
                      const std::string& long_name, std::vector<double> values,
                      NetcdfAttributes attributes = {}) {
        file_.variable({name, std::move(dimensions), units, long_name, std::move(values),
                        std::move(attributes), false, true});
    }
    // A variable that may have missing values.
    void add_absent(const std::string& name, Names dimensions, const std::string& units,
                    const std::string& long_name, std::vector<double> values, std::string note = "",
                    const NetcdfAttributes& more = {}) {
        note = note.empty() ? kAbsentMeans : note + "; " + kAbsentMeans;
        NetcdfAttributes attributes = comment(note);
        append(attributes, more);
        file_.variable({name, std::move(dimensions), units, long_name, std::move(values),
                        std::move(attributes), true});
    }

    // Of all levels, or surfaces: what `get`, a function or a member, gives.
    template <class T = double>
    std::vector<T> of_rows(auto get) const {
        return values_of<T>(o_.rows, get);
    }
    std::vector<double> of_surfaces(auto get) const { return values_of<double>(o_.surface, get); }
    template <class T>
    static std::vector<T> values_of(const auto& all, auto get) {
        std::vector<T> values;
        for (const auto& one : all) values.push_back(std::invoke(get, one));
        return values;
    }

    const Result& r_;
    const Observations& o_;
    std::string length_, force_;
    NetcdfFile file_;
};

}  // namespace rsc
