
#include "case/namelist.hpp"

namespace rsc::namelist {
namespace {

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
    std::string plain = lower_case(word);
    if (plain.starts_with('+') && !plain.starts_with("+-")) plain.erase(0, 1);
    if (const std::size_t open = plain.find("nan("); open <= plain.starts_with('-') && plain.find(')') == plain.size() - 1)
        return std::numeric_limits<double>::quiet_NaN();
    // An exponent begins with any of e, d and q, or only with its sign.
    if (const std::size_t letter = plain.find_first_of("dq"); letter != std::string::npos)
        plain[letter] = 'e';
    else if (const std::size_t sign = plain.find_first_of("+-", 1); sign != std::string::npos && plain[sign - 1] != 'e')
        plain.insert(sign, "e");
    double value = 0;
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (end != plain.data() + plain.size() || error == std::errc::invalid_argument) return {};
    return error == std::errc{} ? value : std::copysign(out_of_range(plain), plain[0] == '-' ? -1.0 : 1.0);
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
