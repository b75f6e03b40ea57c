#include "case/namelist_value.hpp"

#include "case/namelist.hpp"

namespace rsc::namelist {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t skip_digits(std::string_view word, std::size_t i) {
    while (i < word.size() && is_digit(word[i])) ++i;
    return i;
}

// Infinity or zero, for a number too large or too small for a double.
double out_of_range(std::string_view plain) {
    long double wide = 0;
    if (std::from_chars(plain.data(), plain.data() + plain.size(), wide).ec == std::errc{}) return static_cast<double>(wide);
    return plain.find("e-") == std::string_view::npos ? std::numeric_limits<double>::infinity() : 0.0;
}

}  // namespace

std::optional<std::int64_t> to_integer(std::string_view word) {
    if (!word.empty() && word[0] == '+') {
        word.remove_prefix(1);
        if (!word.empty() && word[0] == '-') return {};
    }
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return {};
    return value;
}

std::optional<double> to_real(std::string_view word) {
    bool negative = false;
    if (!word.empty() && (word[0] == '+' || word[0] == '-')) {
        negative = word[0] == '-';
        word.remove_prefix(1);
    }
    const double sign = negative ? -1.0 : 1.0;
    const std::string w = lower_case(word);
    if (w == "inf" || w == "infinity") return sign * std::numeric_limits<double>::infinity();
    if (w == "nan" || (w.starts_with("nan(") && w.find(')') == w.size() - 1)) return std::numeric_limits<double>::quiet_NaN();

    std::size_t i = skip_digits(w, 0);
    std::size_t mantissa_digits = i;
    if (i < w.size() && w[i] == '.') {
        const std::size_t fraction = i + 1;
        i = skip_digits(w, fraction);
        mantissa_digits += i - fraction;
    }
    if (mantissa_digits == 0) return {};
    std::string plain = w.substr(0, i);
    if (i < w.size()) {
        const bool lettered = w[i] == 'e' || w[i] == 'd' || w[i] == 'q';
        if (lettered) ++i;
        std::string exponent_sign;
        if (i < w.size() && (w[i] == '+' || w[i] == '-'))
            exponent_sign = w[i++];
        else if (!lettered)
            return {};
        if (i == w.size() || skip_digits(w, i) != w.size()) return {};
        plain += "e" + exponent_sign + w.substr(i);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (error == std::errc::result_out_of_range)
        value = out_of_range(plain);
    else if (error != std::errc{} || end != plain.data() + plain.size())
        return {};
    return negative ? -value : value;
}

std::optional<bool> to_logical(std::string_view word) {
    if (!word.empty() && word[0] == '.') word.remove_prefix(1);
    if (word.empty()) return {};
    if (word[0] == 't' || word[0] == 'T') return true;
    if (word[0] == 'f' || word[0] == 'F') return false;
    return {};
}

std::string from_real(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    char buffer[64];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    std::string text(buffer, result.ptr);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string from_logical(bool value) { return value ? ".true." : ".false."; }

std::string from_string(std::string_view value) {
    std::string text = "'";
    for (const char c : value) {
        text += c;
        if (c == '\'') text += c;
    }
    return text + "'";
}

}  // namespace rsc::namelist
