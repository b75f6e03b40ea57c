// Words and values of a namelist.

#include "case/namelist.hpp"

namespace rsc::namelist {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Infinity or zero, for a number too large or too small for a double.
double out_of_range(std::string_view plain) {
    long double wide = 0;
    if (std::from_chars(plain.data(), plain.data() + plain.size(), wide).ec == std::errc{})
        return double(wide);
    return plain.find("e-") == std::string_view::npos ? kInfinity : 0.0;
}

// Number of edits (insert, delete, replace, swap neighbours) between two words.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
        for (std::size_t j = 1; j <= b.size(); ++j) {
            d[i][j] = std::min(
                {d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

}  // namespace

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
    if (word.empty() || word.size() > 63) return {};
    const std::string w = lower_case(word);
    std::string_view best;
    std::size_t least = std::max<std::size_t>(1, w.size() / 3) + 1;
    for (const std::string_view candidate : candidates) {
        std::size_t distance = edit_distance(w, lower_case(candidate));
        if (w.size() >= 3 && distance >= least && lower_case(candidate).starts_with(w))
            distance = least - 1;  // cut short
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates,
                       const char* mark) {
    const std::string_view near = nearest(word, candidates);
    return near.empty() ? "" : joined("; did you mean '", mark, near, "'?");
}

std::string lower_case(std::string_view word) {
    std::string result(word);
    std::transform(result.begin(), result.end(), result.begin(), lower);
    return result;
}

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
    if (const std::size_t open = plain.find("nan(");
        open <= plain.starts_with('-') && plain.find(')') == plain.size() - 1)
        return std::numeric_limits<double>::quiet_NaN();
    // An exponent begins with any of e, d and q, or only with its sign.
    if (const std::size_t letter = plain.find_first_of("dq"); letter != std::string::npos)
        plain[letter] = 'e';
    else if (const std::size_t sign = plain.find_first_of("+-", 1);
             sign != std::string::npos && plain[sign - 1] != 'e')
        plain.insert(sign, "e");
    double value = 0;
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (end != plain.data() + plain.size() || error == std::errc::invalid_argument) return {};
    return error == std::errc{} ? value
                                : std::copysign(out_of_range(plain), plain[0] == '-' ? -1.0 : 1.0);
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
