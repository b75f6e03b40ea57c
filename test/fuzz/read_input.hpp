// Reads a file as heights, as a measured map, as a spectrum and as asperities: what comes out is
// finite and of the shape it says, or it is refused with a message.
#pragma once

#include "base/error.hpp"
#include "io/inputs.hpp"
#include "promise.hpp"
#include "surface/asperities.hpp"
#include "surface/measured.hpp"

inline void read_input(const std::string& path, std::optional<double> L) {
    const auto refused = [](const rsc::Error& error) {
        PROMISE(error.kind() == rsc::Failure::bad_input, error.what());
    };
    try {
        rsc::HeightMap map = rsc::read_heights(path, L);
        PROMISE(map.nx >= 3 && map.ny >= 3 && map.dx > 0 && map.dy > 0, "grid");
        PROMISE(std::isfinite(map.dx) && std::isfinite(map.dy) && std::isfinite(map.x0) &&
                    std::isfinite(map.y0),
                "grid");
        for (int j = 0; j < map.ny; ++j)
            for (int i = 0; i < map.nx; ++i) PROMISE(std::isfinite(map(i, j)), "a height");
    } catch (const rsc::Error& error) {
        refused(error);
    }
    // Missing points allowed: they are NaN, and gone when the map is measured.
    try {
        rsc::HeightMap map = rsc::read_heights(path, L, "mm", "", rsc::Missing::fill);
        PROMISE(map.nx >= 3 && map.ny >= 3 && map.dx > 0 && map.dy > 0, "grid");
        constexpr rsc::Detrend kForms[] = {rsc::Detrend::none, rsc::Detrend::plane,
                                           rsc::Detrend::quadratic, rsc::Detrend::sphere};
        const rsc::Measured measured = rsc::measure(
            map, {rsc::Missing::fill, kForms[map.nx % 4], map.ny % 2 == 0 ? 3 * map.dx : 0.0});
        for (int j = 0; j < map.ny; ++j)
            for (int i = 0; i < map.nx; ++i) PROMISE(std::isfinite(map(i, j)), "a measured height");
        PROMISE(std::isfinite(measured.parameters.sq) && measured.shortest_wave > 0,
                "what was measured");
        PROMISE(!rsc::report(measured, "mm").empty(), "the report");
    } catch (const rsc::Error& error) {
        refused(error);
    }
    try {
        const auto table = rsc::read_spectrum(path, "mm").table;
        PROMISE(std::isfinite(table->sigma()) && table->sigma() >= 0 &&
                    table->lowest() < table->highest(),
                "a spectrum");
    } catch (const rsc::Error& error) {
        refused(error);
    }
    try {
        const rsc::Asperities a = rsc::read_asperities(path);
        PROMISE(a.size() > 0 && a.y.size() == a.size() && a.z.size() == a.size() &&
                    a.radius.size() == a.size(),
                "sizes");
        for (const auto* values : {&a.x, &a.y, &a.z, &a.radius})
            for (const double v : *values) PROMISE(std::isfinite(v), "an asperity");
        for (const double r : a.radius) PROMISE(r > 0, "a radius");
    } catch (const rsc::Error& error) {
        refused(error);
    }
}
