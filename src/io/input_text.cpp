#include "io/formats.hpp"

#include "base/error.hpp"
#include "case/namelist.hpp"

namespace rsc {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

// The separator of the numbers of a file, and its decimal mark; each is unknown (0) until first
// seen, and fixed afterwards.
struct Style {
    char separator = 0;  // ' ', ',' or ';'
    char decimal = 0;    // '.' or ','
    long line = 0;       // where the separator was first seen
    long decimal_line = 0;
};

const char* name_of(char separator) {
    return separator == ' ' ? "blanks" : separator == ',' ? "commas" : "semicolons";
}

[[noreturn]] void refuse(const std::string& path, long line, const std::string& what) {
    bad_input(path + ":" + std::to_string(line) + ": " + what);
}

double number(std::string_view word, const std::string& path, long line, std::size_t column,
              Style& style) {
    const std::string place = shown(word) + " in column " + std::to_string(column);
    std::string text(word);
    if (style.separator == ';') {
        const std::size_t mark = text.find_first_of(".,");
        if (mark != std::string::npos) {
            if (style.decimal == 0) style.decimal = text[mark], style.decimal_line = line;
            if (style.decimal != text[mark])
                refuse(path, line,
                       place + ": a decimal " + (text[mark] == ',' ? "comma" : "point") +
                           ", where line " + std::to_string(style.decimal_line) + " has decimal " +
                           (style.decimal == ',' ? "commas" : "points"));
            if (text[mark] == ',') {
                if (text.find('.') != std::string::npos)
                    refuse(path, line, place + " is not a number");
                text[mark] = '.';
            }
        }
    }
    const auto value = number_in_file(text);
    if (!value)
        refuse(
            path, line,
            place + " is not a number; comments begin with '#', a missing point of a map is nan");
    if (!std::isfinite(*value))
        refuse(path, line,
               place +
                   " is not finite: every value must be known (missing points of a map: "
                   "surface%missing)");
    return *value;
}

// Appends the numbers of a line to `values`; returns how many there were.
std::size_t parse(std::string_view text, const std::string& path, long line, Style& style,
                  bool missing, std::vector<double>& values) {
    text = text.substr(0, text.find('#'));
    const bool semicolons = text.find(';') != std::string_view::npos;
    const auto separates = [semicolons](char c) { return c == (semicolons ? ';' : ','); };
    const auto require = [&](char found, const std::string& before) {
        if (style.separator == 0) style.separator = found, style.line = line;
        if (style.separator == found) return;
        const bool here = style.line == line;
        // In "0,01 0,02" one of two apparent separators may be a decimal comma.
        const std::string hint =
            style.separator != ';' && found != ';'
                ? "; decimal commas are accepted only with semicolons as separators"
                : "";
        refuse(path, line,
               std::string(name_of(found)) + " before " + before + " where " +
                   (here ? std::string("the rest of the line")
                         : "line " + std::to_string(style.line)) +
                   " has " + name_of(style.separator) + ": one separator is expected throughout" +
                   hint);
    };
    std::size_t count = 0, i = 0;
    char gap = 0;  // separator since the last number
    if (semicolons) require(';', "the end");
    while (true) {
        while (i < text.size() && blank(text[i])) {
            if (gap == 0) gap = ' ';
            ++i;
        }
        if (i == text.size()) break;
        if (separates(text[i])) {
            if (gap == text[i] || count == 0)
                refuse(path, line,
                       "nothing between the separators at column " + std::to_string(count + 1));
            gap = text[i++];
            continue;
        }
        const std::size_t start = i;
        while (i < text.size() && !blank(text[i]) && !separates(text[i])) ++i;
        const std::string_view word = text.substr(start, i - start);
        if (count > 0) require(gap, shown(word));
        const std::string lower = missing ? namelist::lower_case(word) : "";
        values.push_back(lower == "nan" || lower == "bad"
                             ? std::nan("")
                             : number(word, path, line, count + 1, style));
        ++count;
        gap = 0;
    }
    return count;  // a separator at the end of the line is accepted
}

}  // namespace

std::optional<double> number_in_file(std::string_view word) {
    const std::size_t sign = word.find_first_of("+-", 1);
    if (sign != std::string_view::npos && word[sign - 1] < 'A') return {};
    return namelist::to_real(word);
}

TextTable read_table(const std::string& path, std::size_t columns, bool missing) {
    std::ifstream file(path, std::ios::binary);
    if (!file) bad_input(path + ": cannot be read");
    TextTable table;
    Style style;
    table.columns = columns;
    std::string text;
    long line = 0;
    while (std::getline(file, text)) {
        ++line;
        std::string_view view(text);
        if (line == 1 && view.substr(0, 3) == "\xef\xbb\xbf")
            view.remove_prefix(3);  // UTF-8 byte order mark
        if (line == 1 && (view.substr(0, 2) == "\xff\xfe" || view.substr(0, 2) == "\xfe\xff"))
            bad_input(path + ": is text in UTF-16; save it as UTF-8 or plain ASCII");
        if (view.find('\0') != std::string_view::npos)
            refuse(path, line, "neither text nor a NetCDF file (there is a zero byte)");
        constexpr std::string_view told = "# Value units: ";
        if (view.starts_with(told))
            table.unit = view.substr(told.size(), view.find('\r') - told.size());
        const std::size_t count = parse(view, path, line, style, missing, table.values);
        if (count == 0) continue;
        if (table.columns == 0) table.columns = count;
        if (count != table.columns) {
            const std::string wanted = columns > 0
                                           ? std::to_string(columns)
                                           : std::to_string(table.columns) + " as in line " +
                                                 std::to_string(table.line[0]);
            refuse(path, line,
                   std::to_string(count) + " values where " + wanted + " were expected");
        }
        table.line.push_back(line);
    }
    if (file.bad()) bad_input(path + ": reading failed after line " + std::to_string(line));
    table.rows = table.line.size();
    if (table.rows == 0) bad_input(path + ": contains no numbers");
    return table;
}

}  // namespace rsc
