#include "io/formats.hpp"

#include "base/error.hpp"
#include "case/namelist.hpp"
#include "case/units.hpp"
#include "io/inputs.hpp"

namespace rsc {
namespace {

constexpr std::size_t kVersion = 8;

bool is_bcr(const std::string& bytes) { return bytes.substr(1, 3) == "BCR"; }

struct Header {
    std::size_t nx = 0, ny = 0;
    double dx = 0, dy = 0, scale = 0;  // [m]
    long compression = 0, type = 0, check = 0;
};

HeightMap prepare(const std::string& path, const Header& h, const std::string& length_unit,
                  double& factor) {
    const bool profile = h.ny == 1;  // Yscale may then be 0
    if (!profile) check_grid(path, h.nx, h.ny);
    check_memory(path, "the heights", double(h.nx));
    const auto positive = [&](const char* name, double value) {
        if (!(value > 0 && std::isfinite(value)))
            bad_input(path, ": ", name, " = ", value, ": must be positive");
    };
    positive("Xscale", h.dx);
    if (!profile) positive("Yscale", h.dy);
    positive("Zscale", h.scale);
    if (h.compression != 0)
        bad_input(path, ": Compression = ", h.compression, ": only 0 (none) is known");
    if (h.check != 0) bad_input(path, ": CheckType = ", h.check, ": only 0 (none) is known");
    const double metre = length_factor("m", length_unit);
    HeightMap map = allocate_map(h.nx, h.ny);
    map.dx = h.dx * metre;
    map.dy = h.dy * metre;
    factor = h.scale * metre;
    return map;
}

// True for the value of a type that means a missing point: the least of a signed type, the largest
// of an unsigned one and of every type of BCR, where both are met.
template <class T>
bool is_missing(double value, bool bcr) {
    using Limits = std::numeric_limits<T>;
    const bool least = std::is_signed_v<T> && value == double(Limits::lowest());
    const bool largest_counts = bcr || std::is_unsigned_v<T>;
    return least || (largest_counts && value == double(Limits::max()));
}

template <class T>
void take_values(ByteReader& in, HeightMap& map, double factor, bool bcr) {
    const std::size_t points = map.points();
    const char* const bytes = in.take(points, sizeof(T), "heights").data();
    for (const auto k : indices(points)) {
        const auto value = double(ByteReader::value<T>(bytes + k * sizeof(T)));
        map.data[k] = is_missing<T>(value, bcr) ? std::nan("") : factor * value;
    }
}

HeightMap read_binary(const std::string& path, const std::string& bytes,
                      const std::string& length_unit) {
    ByteReader in(path, bytes, kVersion, bytes.size());
    in.take(10 + 12 + 12, 1, "the header");  // maker, dates
    Header h;
    const bool second = bytes[5] >= '2';  // counts of 32 bits from version 2.0 on
    h.nx = second ? in.number<std::uint32_t>("NumPoints") : in.number<std::uint16_t>("NumPoints");
    h.ny =
        second ? in.number<std::uint32_t>("NumProfiles") : in.number<std::uint16_t>("NumProfiles");
    h.dx = in.number<double>("Xscale");
    h.dy = in.number<double>("Yscale");
    h.scale = in.number<double>("Zscale");
    in.number<double>("Zresolution");
    h.compression = in.number<std::uint8_t>("Compression");
    h.type = in.number<std::uint8_t>("DataType");
    h.check = in.number<std::uint8_t>("CheckType");
    constexpr std::size_t kSizes[] = {1, 2, 4, 4, 1, 2, 4, 8};
    if (h.type > 7) bad_input(path, ": DataType = ", h.type, ": 0 to 7 was expected");
    // Before memory is allocated.
    if (h.nx > 0 && h.ny > 0 && in.left() / kSizes[h.type] / h.nx < h.ny)
        in.refuse(h.nx, " x ", h.ny, " heights of ", kSizes[h.type], " bytes each, but ", in.left(),
                  " bytes are left; is the file complete?");
    double factor = 0;
    HeightMap map = prepare(path, h, length_unit, factor);
    // Some instruments (Olympus) write two more integers, 5 and 1, after the header.
    if (in.left() == h.nx * h.ny * kSizes[h.type] + 8 &&
        ByteReader::value<std::uint32_t>(bytes.data() + in.at()) == 5 &&
        ByteReader::value<std::uint32_t>(bytes.data() + in.at() + 4) == 1)
        in.take(8, 1, "the header");
    const bool bcr = is_bcr(bytes);
    switch (h.type) {
        case 0: take_values<std::uint8_t>(in, map, factor, bcr); break;
        case 1: take_values<std::uint16_t>(in, map, factor, bcr); break;
        case 2: take_values<std::uint32_t>(in, map, factor, bcr); break;
        case 3: take_values<float>(in, map, factor, bcr); break;
        case 4: take_values<std::int8_t>(in, map, factor, bcr); break;
        case 5: take_values<std::int16_t>(in, map, factor, bcr); break;
        case 6: take_values<std::int32_t>(in, map, factor, bcr); break;
        default: take_values<double>(in, map, factor, bcr); break;
    }
    // A text trailer may follow; more bytes are heights that are not in the header.
    constexpr std::size_t longest = std::size_t{1} << 16;
    if (in.left() > longest)
        in.refuse(in.left(), " bytes follow the last of ", h.nx, " x ", h.ny,
                  " heights; are NumPoints and NumProfiles right?");
    return map;
}

// The words of a text, without comments, which begin with ';'.
class SdfText {
public:
    SdfText(const std::string& path, const std::string& bytes) : path_(path), text_(bytes) {
        next();
    }

    // The next line without its comment; false at the end of the file.
    bool next() {
        ++number_;
        const bool there = next_line(text_, line_);
        words_.clear();
        words_.str(line_.substr(0, line_.find(';')));
        return there;
    }
    // The next word of the lines; empty at the end of the file.
    std::string word() {
        std::string word;
        while (!(words_ >> word))
            if (!next()) return "";
        return word;
    }
    // What is left of the line.
    std::string rest() {
        std::string all, word;
        while (words_ >> word)
            if (word != "=") enlist(all, " ", word);
        return all;
    }
    long number() const { return number_; }
    [[noreturn]] void refuse(const auto&... what) const {
        bad_input(path_, ":", number_, ": ", what...);
    }

private:
    const std::string& path_;
    std::stringbuf text_;
    std::string line_;
    std::istringstream words_;
    long number_ = 0;
};

// Words for numbers of the header, as the specification has them in its example and in its table of
// types.
std::optional<std::int64_t> number_of_word(std::string_view word) {
    static const std::map<std::string, std::int64_t> known = {
        {"null", 0},         {"none", 0},  {"unsigned char", 0},  {"unsigned integer", 1},
        {"unsigned int", 1}, {"float", 3}, {"unsigned long", 2},  {"signed char", 4},
        {"char", 4},         {"int", 5},   {"signed integer", 5}, {"integer", 5},
        {"signed int", 5},   {"long", 6},  {"signed long", 6},    {"double", 7}};
    const auto found = known.find(namelist::lower_case(word));
    if (found == known.end()) return {};
    return found->second;
}

// The header of a text: its names in lower case, with their values and lines.
class TextHeader {
public:
    // Reads up to the line that begins with '*'.
    TextHeader(const std::string& path, SdfText& in) : path_(path) {
        std::string name;
        in.rest();  // the version
        while ((name = in.word())[0] != '*') {
            if (name.empty())
                bad_input(path,
                          ": the line '*' that ends the header is missing; is the file complete?");
            const std::size_t equals = name.find('=');
            std::string value = equals == std::string::npos ? "" : name.substr(equals + 1);
            const std::string rest = in.rest();
            if (!rest.empty()) enlist(value, " ", rest[0] == '=' ? rest.substr(1) : rest);
            values_[namelist::lower_case(name.substr(0, equals))] = {value, in.number()};
        }
        in.rest();
    }

    template <class Value>
    void number(const char* name, Value& value) const {
        const auto found = values_.find(namelist::lower_case(name));
        if (found == values_.end()) bad_input(path_, ": the header has no ", name);
        const auto& [text, line] = found->second;
        const auto read = number_in_file(text);
        if (!read || (std::is_integral_v<Value> &&
                      !(*read >= 0 && *read < 0x1p32 && *read == std::floor(*read))))
            bad_input(path_, ":", line, ": ", name, ": a number was expected, not ", shown(text));
        value = static_cast<Value>(*read);
    }
    // A number or a word for it; unchanged if the header has none.
    void choice(const char* name, long& value) const {
        const auto found = values_.find(namelist::lower_case(name));
        if (found == values_.end()) return;
        if (const auto word = number_of_word(found->second.first))
            value = long(*word);
        else
            number(name, value);
    }

private:
    const std::string& path_;
    std::map<std::string, std::pair<std::string, long>> values_;
};

HeightMap read_text(const std::string& path, std::string bytes, const std::string& length_unit) {
    std::replace(bytes.begin(), bytes.end(), '\0', ' ');
    SdfText in(path, bytes);
    const TextHeader header(path, in);
    Header h;
    header.number("NumPoints", h.nx);
    header.number("NumProfiles", h.ny);
    header.number("Xscale", h.dx);
    header.number("Yscale", h.dy);
    header.number("Zscale", h.scale);
    header.choice("Compression", h.compression);
    header.choice("DataType", h.type);
    header.choice("CheckType", h.check);
    // A height has at least two characters, so excessive sizes are refused before memory is
    // allocated.
    if (h.nx > 0 && h.ny > bytes.size() / h.nx)
        bad_input(path, ": ", h.nx, " x ", h.ny, " heights in a file of ", bytes.size(),
                  " bytes; is the file complete?");
    double factor = 0;
    HeightMap map = prepare(path, h, length_unit, factor);
    // Some writers of integers also mark missing points by a number.
    const bool bcr = is_bcr(bytes);
    const auto missing = [&](double height) {
        return (h.type == 5 && is_missing<std::int16_t>(height, bcr)) ||
               (h.type == 6 && is_missing<std::int32_t>(height, bcr));
    };
    const std::size_t points = h.nx * h.ny;
    const std::string size = std::to_string(h.nx) + " x " + std::to_string(h.ny);
    for (const auto k : indices(points)) {
        const std::string word = in.word();
        if (word.empty() || word[0] == '*')
            in.refuse(k, " heights where ", size, " were expected; is the file complete?");
        const auto value =
            namelist::lower_case(word) == "bad" ? std::nan("") : number_in_file(word);
        if (!value) in.refuse(shown(word), " is not a number");
        map.data[k] = missing(*value) ? std::nan("") : factor * *value;
    }
    if (const std::string word = in.word(); !word.empty() && word[0] != '*')
        in.refuse(shown(word), " after the last of ", size, " heights");
    return map;
}

}  // namespace

bool is_sdf(const std::string& start) {
    if (start.size() < kVersion || (start[0] != 'a' && start[0] != 'b')) return false;
    // NPL and NIST publish theirs under these names.
    if (start.starts_with("aNPL-V1.") || start.starts_with("aBC-1.0")) return true;
    const std::string kind = start.substr(1, 4);
    return (kind == "ISO-" || kind == "BCR-") &&
           std::isdigit(static_cast<unsigned char>(start[5])) && start[6] == '.' &&
           std::isdigit(static_cast<unsigned char>(start[7]));
}

HeightMap read_sdf(const std::string& path, const std::string&, const std::string& length_unit,
                   const MapKeys& keys, std::string*) {
    keys.require_use(path, false, false);
    const std::string bytes = read_bytes(path);
    if (!is_sdf(bytes)) bad_input(path, ": is no surface data file (ISO 25178-71)");
    return bytes[0] == 'b' ? read_binary(path, bytes, length_unit)
                           : read_text(path, bytes, length_unit);
}

}  // namespace rsc
