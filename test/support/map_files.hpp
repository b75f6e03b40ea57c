// Files of instruments, written here: what the readers are tested with.
#pragma once

#include "check.hpp"

namespace map_files {

template <class T>
void put(std::string& to, T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof value);
    to.append(bytes, sizeof value);
}

inline void put_text(std::string& to, const std::string& text) {
    to.append(text.c_str(), text.size() + 1);
}

// A map in rows from the top of the picture.
struct Map {
    int nx = 0, ny = 0;
    double dx = 0, dy = 0;  // [m]
    std::vector<double> z;  // [m]
};

inline std::string gwy_object(const std::string& name, const std::string& components) {
    std::string object;
    put_text(object, name);
    put(object, static_cast<std::uint32_t>(components.size()));
    return object + components;
}

inline void gwy_component(std::string& to, const std::string& name, char type,
                          const std::string& value) {
    put_text(to, name);
    to += type;
    to += value;
}

template <class T>
std::string bytes(T value) {
    std::string s;
    put(s, value);
    return s;
}

inline std::string gwy_field(const Map& map, const std::string& unit_xy,
                             const std::string& unit_z) {
    std::string c;
    gwy_component(c, "xres", 'i', bytes(map.nx));
    gwy_component(c, "yres", 'i', bytes(map.ny));
    gwy_component(c, "xreal", 'd', bytes(map.nx * map.dx));
    gwy_component(c, "yreal", 'd', bytes(map.ny * map.dy));
    const auto unit = [](const std::string& text) {
        std::string part;
        gwy_component(part, "unitstr", 's', text + '\0');
        return gwy_object("GwySIUnit", part);
    };
    gwy_component(c, "si_unit_xy", 'o', unit(unit_xy));
    gwy_component(c, "si_unit_z", 'o', unit(unit_z));
    std::string data = bytes(static_cast<std::uint32_t>(map.z.size()));
    for (const double z : map.z) put(data, z);
    gwy_component(c, "data", 'D', data);
    return gwy_object("GwyDataField", c);
}

// The inside of a container with one channel.
inline std::string gwy_channel(int number, const std::string& title, const Map& map,
                               const std::string& unit_z = "m", const std::string& unit_xy = "m") {
    std::string c;
    const std::string base = "/" + std::to_string(number) + "/data";
    gwy_component(c, base, 'o', gwy_field(map, unit_xy, unit_z));
    gwy_component(c, base + "/title", 's', title + '\0');
    return c;
}

inline std::string gwy_file(const std::string& components) {
    return "GWYP" + gwy_object("GwyContainer", components);
}

// Types of ISO 25178-71: 1 u16, 3 float, 5 i16, 6 i32, 7 double, ... `values` are in units of
// `scale`.
template <class T>
std::string sdf_binary(const Map& map, int type, double scale, const std::vector<T>& values,
                       const std::string& version = "bISO-1.0") {
    std::string f = version + "rsc       " + "010120240000" + "010120240000";
    if (version[5] >= '2') {
        put(f, static_cast<std::uint32_t>(map.nx));
        put(f, static_cast<std::uint32_t>(map.ny));
    } else {
        put(f, static_cast<std::uint16_t>(map.nx));
        put(f, static_cast<std::uint16_t>(map.ny));
    }
    put(f, map.dx);
    put(f, map.dy);
    put(f, scale);
    put(f, -1.0);
    f += '\0';
    f += char(type);
    f += '\0';
    for (const T v : values) put(f, v);
    return f;
}

inline std::string sdf_text(const Map& map, double scale, const std::vector<std::string>& values,
                            int type = 7) {
    const auto number = [](double v) {
        char text[32];
        std::snprintf(text, sizeof text, "%.17g", v);
        return std::string(text);
    };
    std::string f =
        "aISO-1.0\r\nManufacID   = rsc\r\n; a comment\r\nCreateDate = 010120240000\r\nModDate = "
        "010120240000\r\n";
    f += "NumPoints = " + std::to_string(map.nx) + "\r\nNumProfiles = " + std::to_string(map.ny) +
         "\r\nXscale = " + number(map.dx) + "\r\nYscale = " + number(map.dy) +
         "\r\nZscale = " + number(scale) +
         "\r\nZresolution = -1\r\nCompression = 0\r\nDataType = " + std::to_string(type) +
         "\r\nCheckType = 0\r\n*\r\n";
    for (const auto k : indices(values)) f += values[k] + ((k + 1) % 7 == 0 ? "\r\n" : " ");
    return f + "\r\n*\r\nNothing = 1\r\n*\r\n";
}

}  // namespace map_files
