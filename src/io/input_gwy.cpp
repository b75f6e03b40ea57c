#include "io/formats.hpp"

#include "base/error.hpp"
#include "case/units.hpp"
#include "io/inputs.hpp"

namespace rsc {
namespace {

// A named value: its position in the bytes and its type.
struct Component {
    std::string_view name;
    char type = 0;
    std::size_t at = 0, end = 0;
};

// Skips a value of the given type.
void skip_object(ByteReader& in) {
    in.text("the name of an object");
    in.take(in.number<std::uint32_t>("the size of an object"), 1, "an object");
}

void skip(ByteReader& in, char type, const std::string& name) {
    constexpr std::string_view singles = "bciqd", arrays = "CIQD";
    constexpr std::size_t single_sizes[] = {1, 1, 4, 8, 8}, array_sizes[] = {1, 4, 8, 8};
    const auto length = [&] { return in.number<std::uint32_t>("the length of " + name); };
    if (const std::size_t k = singles.find(type); k != std::string_view::npos) {
        in.take(1, single_sizes[k], name);
    } else if (const std::size_t l = arrays.find(type); l != std::string_view::npos) {
        in.take(length(), array_sizes[l], name);
    } else if (type == 's' || type == 'S') {
        for (std::uint32_t n = type == 'S' ? length() : 1; n > 0; --n) in.text(name);
    } else if (type == 'o' || type == 'O') {
        for (std::uint32_t n = type == 'O' ? length() : 1; n > 0; --n) skip_object(in);
    } else {
        in.refuse(name, " has an unknown type, '", printable(std::string_view(&type, 1)), "'");
    }
}

// The components of the next object, beginning at its name and size.
std::vector<Component> components(ByteReader& in, const std::string& expected) {
    const std::string_view name = in.text("the name of an object");
    if (name != expected)
        in.refuse("an object ", expected, " was expected, not '", printable(name), "'");
    const std::size_t size = in.number<std::uint32_t>("the size of " + expected);
    if (size > in.left())
        in.refuse(expected, " of ", size, " bytes, but ", in.left(),
                  " are left; is the file complete?");
    const std::size_t end = in.at() + size;
    std::vector<Component> all;
    while (in.at() < end) {
        Component c;
        c.name = in.text("the name of a component of " + expected);
        c.type = in.number<char>("the type of a component");
        c.at = in.at();
        skip(in, c.type, printable(c.name));
        c.end = in.at();
        all.push_back(c);
    }
    return all;
}

// The contents of a GwyDataField.
struct Field {
    std::size_t nx = 0, ny = 0;
    double Lx = 0, Ly = 0;
    std::string unit_xy, unit_z;
    std::string_view data;
};

class GwyFile {
public:
    GwyFile(const std::string& path) : path_(path), bytes_(read_bytes(path)) {
        if (!bytes_.starts_with("GWYP"))
            bad_input(path, ": a file of another version of Gwyddion (it begins with '",
                      printable(bytes_.substr(0, 4)),
                      "', not 'GWYP'): open it in Gwyddion 2 and save it again");
        ByteReader in(path_, bytes_, 4, bytes_.size());
        for (const Component& c : components(in, "GwyContainer")) top_[c.name] = c;
    }

    // The numbers N for which there is /N/data.
    std::vector<long> channels() const {
        std::vector<long> numbers;
        for (const auto& [name, c] : top_) {
            if (c.type != 'o' || name.size() < 7 || name[0] != '/' ||
                name.substr(name.size() - 5) != "/data")
                continue;
            const std::string_view digits = name.substr(1, name.size() - 6);
            if (digits.size() > 9 ||
                !std::ranges::all_of(digits, [](unsigned char d) { return std::isdigit(d) != 0; }))
                continue;
            numbers.push_back(std::stol(std::string(digits)));
        }
        std::ranges::sort(numbers);
        return numbers;
    }

    std::string title(long n) const {
        const Component* const c = find(format("/%ld/data/title", n));
        if (!c || c->type != 's') return "channel " + std::to_string(n);
        return utf8(reader(*c).text("a title"));
    }

    std::optional<Field> field(const std::string& name) const {
        const Component* const c = find(name);
        if (!c || c->type != 'o') return std::nullopt;
        ByteReader in = reader(*c);
        Field f;
        for (const Component& part : components(in, "GwyDataField")) {
            const auto is = [&](const char* expected, char type) {
                return part.name == expected && part.type == type;
            };
            ByteReader value = reader(part);
            if (is("xres", 'i')) f.nx = size(value, name + " xres");
            if (is("yres", 'i')) f.ny = size(value, name + " yres");
            if (is("xreal", 'd')) f.Lx = value.number<double>("xreal");
            if (is("yreal", 'd')) f.Ly = value.number<double>("yreal");
            if (is("si_unit_xy", 'o')) f.unit_xy = unit(value);
            if (is("si_unit_z", 'o')) f.unit_z = unit(value);
            if (is("data", 'D'))
                f.data = value.take(value.number<std::uint32_t>("the length of data"),
                                    sizeof(double), "data");
        }
        // Gwyddion's default for missing extents is 1.
        if (f.Lx == 0) f.Lx = 1;
        if (f.Ly == 0) f.Ly = 1;
        return f;
    }

private:
    const Component* find(const std::string& name) const {
        const auto found = top_.find(name);
        return found == top_.end() ? nullptr : &found->second;
    }
    ByteReader reader(const Component& c) const { return {path_, bytes_, c.at, c.end}; }
    static std::size_t size(ByteReader& in, const std::string& what) {
        const auto n = in.number<std::int32_t>(what);
        if (n < 1) in.refuse(what, " = ", n, ": must be positive");
        return at(n);
    }
    std::string unit(ByteReader& in) const {
        for (const Component& part : components(in, "GwySIUnit"))
            if (part.name == "unitstr" && part.type == 's')
                return utf8(reader(part).text("a unit"));
        return {};
    }

    std::string path_, bytes_;
    std::map<std::string_view, Component> top_;
};

std::optional<double> factor_of(const std::string& unit, const std::string& length_unit) {
    if (unit.empty())
        return std::nullopt;  // pure numbers are not lengths, whatever the power of ten
    try {
        return length_factor(unit, length_unit);
    } catch (const Error&) {
        return std::nullopt;
    }
}

// The number of the channel to read.
long chosen_channel(const GwyFile& file, const std::string& path, const std::string& channel,
                    const std::string& length_unit, bool without_unit) {
    std::string names;
    std::optional<long> chosen, numbered;
    bool unknown = false;  // a channel has no unit
    for (const long n : file.channels()) {
        const std::string title = file.title(n), unit = file.field(format("/%ld/data", n))->unit_z;
        enlist(names, ", ", "'", printable(title), "' (", n, ") in '", printable(unit), "'");
        unknown = unknown || unit.empty();
        if (channel == std::to_string(n)) numbered = n;
        const bool heights =
            factor_of(unit, length_unit).has_value() || (without_unit && unit.empty());
        if (!chosen && (channel.empty() ? heights : title == channel)) chosen = n;
    }
    if (!chosen) chosen = numbered;
    if (names.empty()) bad_input(path, ": contains no channel (image)");
    if (!chosen)
        bad_input(path, ": ",
                  channel.empty() ? "no channel contains heights"
                                  : "there is no channel '" + channel + "'",
                  "; there are ", names,
                  channel.empty() && unknown
                      ? "; surface%height_unit is the unit of a channel that has none"
                      : "");
    return *chosen;
}

// Sets the steps of a map from the sides of its channel and the keys.
void set_steps(HeightMap& map, const std::string& name, const Field& field, const MapKeys& keys,
               const std::string& length_unit) {
    const std::string unit = field.unit_xy.empty() ? keys.coordinate_unit : field.unit_xy;
    if (field.unit_xy.empty() && keys.pixel) {
        map.dx = map.dy = *keys.pixel;
        return;
    }
    if (unit.empty())
        bad_input(name,
                  ": its sides have no unit; surface%pixel or surface%coordinate_unit must be "
                  "given");
    const auto factor = factor_of(unit, length_unit);
    if (!factor) bad_input(name, ": its sides are in '", printable(unit), "', which is no length");
    map.dx = field.Lx * *factor / double(field.nx);
    map.dy = field.Ly * *factor / double(field.ny);
}

}  // namespace

bool is_gwy(const std::string& start) { return start.substr(0, 3) == "GWY"; }

bool gwy_lacks_units(const std::string& path, const std::string& channel) {
    const GwyFile file(path);
    const long chosen = chosen_channel(file, path, channel, "m", true);
    const Field field = *file.field(format("/%ld/data", chosen));
    return field.unit_z.empty() || field.unit_xy.empty();
}

HeightMap read_gwy(const std::string& path, const std::string& channel,
                   const std::string& length_unit, const MapKeys& keys, std::string* title) {
    const GwyFile file(path);
    const long chosen = chosen_channel(file, path, channel, length_unit, !keys.height_unit.empty());
    const std::string base = format("/%ld", chosen);
    const Field field = *file.field(base + "/data");
    const std::string name = path + ": channel '" + printable(file.title(chosen)) + "'";
    if (title) *title = printable(file.title(chosen));
    keys.require_use(path, field.unit_z.empty(), field.unit_xy.empty());
    const auto factor_z =
        factor_of(field.unit_z.empty() ? keys.height_unit : field.unit_z, length_unit);
    if (!factor_z)
        bad_input(name, ": its values are in '", printable(field.unit_z), "', which is no length",
                  field.unit_z.empty() ? "; surface%height_unit, their unit, must be given" : "");
    check_grid(path, field.nx, field.ny);
    const std::size_t points = field.nx * field.ny;
    if (field.data.size() != points * sizeof(double))
        bad_input(name, ": ", field.data.size() / sizeof(double), " values for ", field.nx, " x ",
                  field.ny, " points");
    if (!(field.Lx > 0 && field.Ly > 0 && std::isfinite(field.Lx) && std::isfinite(field.Ly)))
        bad_input(name, ": sides of ", field.Lx, " and ", field.Ly, " must be positive");
    HeightMap map = allocate_map(field.nx, field.ny);
    set_steps(map, name, field, keys, length_unit);
    for (const auto k : indices(points))
        map.data[k] = *factor_z * ByteReader::value<double>(field.data.data() + k * sizeof(double));
    if (const auto mask = file.field(base + "/mask")) {
        if (mask->nx != field.nx || mask->ny != field.ny || mask->data.size() != field.data.size())
            bad_input(name, ": its mask and the channel differ in size");
        for (const auto k : indices(points))
            if (ByteReader::value<double>(mask->data.data() + k * sizeof(double)) > 0)
                map.data[k] = std::nan("");
    }
    reverse_rows(map);
    return map;
}

}  // namespace rsc
