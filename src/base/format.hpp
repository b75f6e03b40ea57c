// Texts with numbers in them.
#pragma once

#include "base/std.hpp"

namespace rsc {

// By the rules of printf. At most 599 characters; longer texts are cut.
[[gnu::format(printf, 1, 2)]] inline std::string format(const char* text, ...) {
    char buffer[600];
    std::va_list values;
    va_start(values, text);
    std::vsnprintf(buffer, sizeof buffer, text, values);
    va_end(values);
    return buffer;
}

// A number in a message.
inline std::string text_of(double value) { return format("%.9g", value); }

// A share in percent with two digits, and without exponent: "0.015 %", "4.2 %", "120 %".
inline std::string percent(double share) {
    if (std::abs(share) > 10) return "more than 1000 %";
    return format(std::abs(share) < 0.995 ? "%.2g %%" : "%.0f %%", 100 * share);
}

template <class Part>
void append_part(std::string& text, const Part& part) {
    if constexpr (std::is_floating_point_v<Part>)
        text += text_of(part);
    else if constexpr (std::is_integral_v<Part> && !std::is_same_v<Part, char>)
        text += std::to_string(part);
    else
        text += part;
}

// Texts and numbers, one after another.
std::string joined(const auto&... parts) {
    std::string all;
    (append_part(all, parts), ...);
    return all;
}

// Appends an item, joined() from its parts, to a list with `between` between its items.
void enlist(std::string& list, const char* between, const auto&... item) {
    if (!list.empty()) list += between;
    list += joined(item...);
}

// For messages: text of others, cut, with control characters replaced, those of terminals in UTF-8
// included.
inline std::string printable(std::string_view text, std::size_t most = 60) {
    std::string shown(text.substr(0, most));
    for (std::size_t k = 0; k < shown.size(); ++k) {
        const auto c = static_cast<unsigned char>(shown[k]);
        const bool second =
            k > 0 && static_cast<unsigned char>(text[k - 1]) == 0xc2 && c >= 0x80 && c < 0xa0;
        if (c < 32 || c == 127 || second) shown[k] = '?';
        if (second) shown[k - 1] = '?';
    }
    return shown;
}

}  // namespace rsc
