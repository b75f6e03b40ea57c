#include "read/formats.hpp"

#include "case/units.hpp"
#include "error.hpp"
#include "format.hpp"
#include "read/bytes.hpp"

namespace rsc {
namespace {

constexpr std::size_t kVersion = 8;

struct Header {
    std::size_t nx = 0, ny = 0;
    double dx = 0, dy = 0, scale = 0;  // [m]
    long compression = 0, type = 0, check = 0;
};

HeightMap prepare(const std::string& path, const Header& h, const std::string& length_unit, double& factor) {
    check_grid(path, h.nx, h.ny);
    const auto positive = [&](const char* name, double value) {
        if (!(value > 0 && std::isfinite(value))) bad_input(path + ": " + name + " = " + text_of(value) + ": must be positive");
    };
    positive("Xscale", h.dx), positive("Yscale", h.dy), positive("Zscale", h.scale);
    if (h.compression != 0) bad_input(path + ": Compression = " + std::to_string(h.compression) + ": only 0 (none) is known");
    if (h.check != 0) bad_input(path + ": CheckType = " + std::to_string(h.check) + ": only 0 (none) is known");
    const double metre = length_factor("m", length_unit);
    HeightMap map = allocate_map(h.nx, h.ny);
    map.dx = h.dx * metre, map.dy = h.dy * metre;
    factor = h.scale * metre;
    return map;
}

// The value of a type for a missing point; NaN always means missing.
template <class T>
constexpr double missing_value() {
    return static_cast<double>(std::is_unsigned_v<T> ? std::numeric_limits<T>::max() : std::numeric_limits<T>::lowest());
}

template <class T>
void take_values(ByteReader& in, HeightMap& map, double factor) {
    const auto points = static_cast<std::size_t>(map.nx) * static_cast<std::size_t>(map.ny);
    const char* const bytes = in.take(points, sizeof(T), "heights").data();
    for (std::size_t k = 0; k < points; ++k) {
        const auto value = static_cast<double>(ByteReader::value<T>(bytes + k * sizeof(T)));
        map.data[k] = value == missing_value<T>() ? std::nan("") : factor * value;
    }
}

HeightMap read_binary(const std::string& path, const std::string& bytes, const std::string& length_unit) {
    ByteReader in(path, bytes, kVersion, bytes.size());
    in.take(10 + 12 + 12, 1, "the header");  // maker, dates
    Header h;
    const bool second = bytes[5] >= '2';  // counts of 32 bits from version 2.0 on
    h.nx = second ? in.number<std::uint32_t>("NumPoints") : in.number<std::uint16_t>("NumPoints");
    h.ny = second ? in.number<std::uint32_t>("NumProfiles") : in.number<std::uint16_t>("NumProfiles");
    h.dx = in.number<double>("Xscale");
    h.dy = in.number<double>("Yscale");
    h.scale = in.number<double>("Zscale");
    in.number<double>("Zresolution");
    h.compression = in.number<std::uint8_t>("Compression");
    h.type = in.number<std::uint8_t>("DataType");
    h.check = in.number<std::uint8_t>("CheckType");
    constexpr std::size_t kSizes[] = {1, 2, 4, 4, 1, 2, 4, 8};
    if (h.type > 7) bad_input(path + ": DataType = " + std::to_string(h.type) + ": 0 to 7 was expected");
    // Before memory is allocated.
    if (h.nx > 0 && h.ny > 0 && in.left() / kSizes[h.type] / h.nx < h.ny)
        in.refuse(std::to_string(h.nx) + " x " + std::to_string(h.ny) + " heights of " + std::to_string(kSizes[h.type]) +
                  " bytes each, but " + std::to_string(in.left()) + " bytes are left; is the file complete?");
    double factor = 0;
    HeightMap map = prepare(path, h, length_unit, factor);
    // Some instruments (Olympus) write two more integers, 5 and 1, after the header.
    if (in.left() == h.nx * h.ny * kSizes[h.type] + 8 && ByteReader::value<std::uint32_t>(bytes.data() + in.at()) == 5 &&
        ByteReader::value<std::uint32_t>(bytes.data() + in.at() + 4) == 1)
        in.take(8, 1, "the header");
    switch (h.type) {
        case 0: take_values<std::uint8_t>(in, map, factor); break;
        case 1: take_values<std::uint16_t>(in, map, factor); break;
        case 2: take_values<std::uint32_t>(in, map, factor); break;
        case 3: take_values<float>(in, map, factor); break;
        case 4: take_values<std::int8_t>(in, map, factor); break;
        case 5: take_values<std::int16_t>(in, map, factor); break;
        case 6: take_values<std::int32_t>(in, map, factor); break;
        default: take_values<double>(in, map, factor); break;
    }
    // A text trailer may follow; more bytes are heights that are not in the header.
    constexpr std::size_t longest = std::size_t{1} << 16;
    if (in.left() > longest)
        in.refuse(std::to_string(in.left()) + " bytes follow the last of " + std::to_string(h.nx) + " x " + std::to_string(h.ny) +
                  " heights; are NumPoints and NumProfiles right?");
    return map;
}

// Words of a text with their line numbers.
class Words {
public:
    Words(const std::string& path, std::string_view text) : path_(path), text_(text) {}
    long line() const { return line_; }
    [[noreturn]] void refuse_here(const std::string& what) const { bad_input(path_ + ":" + std::to_string(line_) + ": " + what); }

    // The rest of the line, without blanks around it; false at the end of the text.
    bool next_line(std::string_view& content) {
        if (at_ >= text_.size()) return false;
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        content = text_.substr(at_, end - at_);
        at_ = std::min(end + 1, text_.size());
        line_ = ++ends_;
        while (!content.empty() && blank(content.front())) content.remove_prefix(1);
        while (!content.empty() && blank(content.back())) content.remove_suffix(1);
        return true;
    }
    // Empty at the end of the text.
    std::string_view next_word() {
        while (at_ < text_.size() && blank(text_[at_])) ends_ += text_[at_++] == '\n';
        line_ = ends_ + 1;
        const std::size_t start = at_;
        while (at_ < text_.size() && !blank(text_[at_])) ++at_;
        return text_.substr(start, at_ - start);
    }

private:
    static bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v' || c == '\0'; }

    const std::string& path_;
    std::string_view text_;
    std::size_t at_ = 0;
    long line_ = 0, ends_ = 0;  // of the last word; line ends before the next word
};

std::string lower(std::string_view text) {
    std::string s(text);
    for (char& c : s) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return s;
}

std::string shown(std::string_view word) { return format(word.size() > 40 ? "'%s...'" : "'%s'", printable(word, 40).c_str()); }

template <class T>
bool to_number(std::string_view word, T& value) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() && !word.empty();
}

HeightMap read_text(const std::string& path, const std::string& bytes, const std::string& length_unit) {
    Words words(path, bytes);
    std::string_view line;
    words.next_line(line);  // the version
    std::map<std::string, std::pair<std::string_view, long>> header;
    bool data = false;
    while (!data && words.next_line(line)) {
        if (line.empty() || line[0] == ';') continue;
        if (line[0] == '*') {
            data = true;
            break;
        }
        const std::size_t end = std::min(line.find_first_of("= \t"), line.size());
        std::string_view value = line.substr(end);
        value.remove_prefix(std::min(value.find_first_not_of("= \t"), value.size()));
        header[lower(line.substr(0, end))] = {value, words.line()};
    }
    if (!data) bad_input(path + ": the line '*' that ends the header is missing; is the file complete?");
    const auto number = [&](const char* name, auto& value) {
        const auto found = header.find(lower(name));
        if (found == header.end()) bad_input(path + ": the header has no " + std::string(name));
        if (!to_number(found->second.first, value))
            bad_input(path + ":" + std::to_string(found->second.second) + ": " + name + ": a number was expected, not " +
                      shown(found->second.first));
    };
    Header h;
    number("NumPoints", h.nx), number("NumProfiles", h.ny);
    number("Xscale", h.dx), number("Yscale", h.dy), number("Zscale", h.scale);
    if (header.count("compression")) number("Compression", h.compression);
    if (header.count("datatype")) number("DataType", h.type);
    if (header.count("checktype")) number("CheckType", h.check);
    // A height has at least two characters, so excessive sizes are refused before memory is allocated.
    if (h.nx > 0 && h.ny > bytes.size() / h.nx)
        bad_input(path + ": " + std::to_string(h.nx) + " x " + std::to_string(h.ny) + " heights in a file of " +
                  std::to_string(bytes.size()) + " bytes; is the file complete?");
    double factor = 0;
    HeightMap map = prepare(path, h, length_unit, factor);
    // Some writers of integers also mark missing points by a number.
    const double missing = h.type == 5 ? missing_value<std::int16_t>() : h.type == 6 ? missing_value<std::int32_t>() : std::nan("");
    const std::size_t points = h.nx * h.ny;
    for (std::size_t k = 0; k < points; ++k) {
        const std::string_view word = words.next_word();
        if (word.empty() || word[0] == '*')
            words.refuse_here(std::to_string(k) + " heights where " + std::to_string(h.nx) + " x " + std::to_string(h.ny) +
                              " were expected; is the file complete?");
        double value = 0;
        const std::string small = lower(word.substr(0, 4));
        if (small == "bad" || small == "nan") {
            map.data[k] = std::nan("");
            continue;
        }
        if (!to_number(word, value)) words.refuse_here(shown(word) + " is not a number");
        map.data[k] = value == missing ? std::nan("") : factor * value;
    }
    if (const std::string_view word = words.next_word(); !word.empty() && word[0] != '*')
        words.refuse_here(shown(word) + " after the last of " + std::to_string(h.nx) + " x " + std::to_string(h.ny) + " heights");
    return map;
}

}  // namespace

bool is_sdf(const std::string& start) {
    if (start.size() < kVersion || (start[0] != 'a' && start[0] != 'b')) return false;
    const std::string kind = start.substr(1, 4);
    return (kind == "ISO-" || kind == "BCR-") && std::isdigit(static_cast<unsigned char>(start[5])) && start[6] == '.' &&
           std::isdigit(static_cast<unsigned char>(start[7]));
}

HeightMap read_sdf(const std::string& path, const std::string& length_unit) {
    const std::string bytes = read_bytes(path);
    if (!is_sdf(bytes)) bad_input(path + ": is no surface data file (ISO 25178-71)");
    HeightMap map = bytes[0] == 'b' ? read_binary(path, bytes, length_unit) : read_text(path, bytes, length_unit);
    reverse_rows(map);
    return map;
}

}  // namespace rsc
