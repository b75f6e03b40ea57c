#include "read/input_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "error.hpp"

namespace rsc {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
bool separator(char c) { return c == ',' || c == ';'; }

[[noreturn]] void refuse(const std::string& path, long line, const std::string& what) {
    throw Error(Failure::bad_input, path + ":" + std::to_string(line) + ": " + what);
}

// A word as it may be shown in a message.
std::string shown(std::string_view word) {
    std::string s(word.substr(0, 40));
    for (char& c : s)
        if (static_cast<unsigned char>(c) < 32) c = '?';
    return "'" + s + (word.size() > 40 ? "...'" : "'");
}

double number(std::string_view word, const std::string& path, long line, std::size_t column) {
    const std::string place = shown(word) + " in column " + std::to_string(column);
    // std::from_chars knows no plus sign before a number.
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    std::string text(plus ? word.substr(1) : word);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = end == text.data() + text.size() && !text.empty();
    // Out of range means too large, or so small that zero is the nearest double: the latter does no harm.
    if (whole && error == std::errc::result_out_of_range && std::abs(std::strtod(text.c_str(), nullptr)) < 1.0) return 0.0;
    if (!whole || error != std::errc()) refuse(path, line, place + " is not a number");
    if (!std::isfinite(value)) refuse(path, line, place + " is not finite: every value must be known");
    return value;
}

// Appends the numbers of a line to `values`; returns how many there were.
std::size_t parse(std::string_view text, const std::string& path, long line, std::vector<double>& values) {
    text = text.substr(0, text.find('#'));
    std::size_t count = 0, i = 0;
    bool expecting = false;  // a separator has been read, a number must follow
    while (true) {
        while (i < text.size() && blank(text[i])) ++i;
        if (i == text.size()) break;
        if (separator(text[i])) {
            if (expecting || count == 0) refuse(path, line, "nothing between the separators at column " + std::to_string(count + 1));
            expecting = true;
            ++i;
            continue;
        }
        const std::size_t start = i;
        while (i < text.size() && !blank(text[i]) && !separator(text[i])) ++i;
        values.push_back(number(text.substr(start, i - start), path, line, count + 1));
        ++count;
        expecting = false;
    }
    return count;  // a separator at the end of the line is forgiven
}

}  // namespace

TextTable read_table(const std::string& path, std::size_t columns) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(Failure::bad_input, path + ": cannot be read");
    TextTable table;
    table.columns = columns;
    std::string text;
    long line = 0;
    while (std::getline(file, text)) {
        ++line;
        std::string_view view(text);
        if (line == 1 && view.substr(0, 3) == "\xef\xbb\xbf") view.remove_prefix(3);  // the mark some editors put before UTF-8
        if (view.find('\0') != std::string_view::npos) refuse(path, line, "neither text nor a NetCDF file (there is a zero byte)");
        const std::size_t count = parse(view, path, line, table.values);
        if (count == 0) continue;
        if (table.columns == 0) table.columns = count;
        if (count != table.columns) {
            const std::string wanted =
                columns > 0 ? std::to_string(columns) : std::to_string(table.columns) + " as in line " + std::to_string(table.line[0]);
            refuse(path, line, std::to_string(count) + " values where " + wanted + " were expected");
        }
        table.line.push_back(line);
    }
    if (file.bad()) throw Error(Failure::bad_input, path + ": reading failed after line " + std::to_string(line));
    table.rows = table.line.size();
    if (table.rows == 0) throw Error(Failure::bad_input, path + ": holds no numbers");
    return table;
}

}  // namespace rsc
