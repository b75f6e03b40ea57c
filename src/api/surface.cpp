// Surfaces and their asperities.

#include "api/guard.hpp"
#include "api/handles.hpp"
#include "surface/asperities.hpp"
#include "surface/form.hpp"
#include "surface/measured.hpp"

namespace rsc::api {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();

void copy_to(double* output, const std::vector<double>& values) {
    if (output) std::ranges::copy(values, output);
}

rsc_asperities* share(SurfaceModel&& model) {
    auto handle = std::make_unique<rsc_asperities>();
    handle->model = std::make_shared<const SurfaceModel>(std::move(model));
    return handle.release();
}

void require_positive(const std::vector<double>& values, int argument, const char* name) {
    for (const auto k : indices(values)) {
        if (!usable_positive(values[k]))
            refuse(argument, name, kPositiveBounds, ": entry ", k, " is not");
    }
}

}  // namespace
}  // namespace rsc::api

using namespace rsc;
using namespace rsc::api;

int32_t rsc_surface_synthesize(rsc_surface** surface, const rsc_case* a_case, int64_t realization) {
    return constructed(2, surface, "surface", [&] {
        const Case& settings = settings_of(a_case);
        require_valid(settings, {"surface", "run"});
        auto made = std::make_unique<rsc_surface>();
        made->surface = make_surface(settings, realization, threads_of(settings));
        return made.release();
    });
}

int32_t rsc_surface_take(rsc_surface** surface, int64_t nx, int64_t ny, double dx, double dy,
                         double x0, double y0, int32_t periodic, const double* heights) {
    return constructed(0, surface, "surface", [&] {
        if (nx < 3 || nx > kMost) refuse(2, "nx", "must be from 3 to 2147483647");
        if (ny < 3 || ny > kMost) refuse(3, "ny", "must be from 3 to 2147483647");
        if (!usable_positive(dx)) refuse(4, "dx", kPositiveBounds);
        if (!usable_positive(dy)) refuse(5, "dy", kPositiveBounds);
        require_finite(x0, 6, "x0");
        require_finite(y0, 7, "y0");
        if (periodic != 0 && periodic != 1) refuse(8, "periodic", "must be 0 or 1");
        if (nx > std::numeric_limits<std::int64_t>::max() / 8 / ny) throw std::bad_alloc();
        require_finite(heights, nx * ny, 9, "heights");
        auto made = std::make_unique<rsc_surface>();
        HeightMap& map = made->surface.map;
        map.allocate(int(nx), int(ny), std::ptrdiff_t(nx));
        map.dx = dx;
        map.dy = dy;
        map.x0 = x0;
        map.y0 = y0;
        map.periodic = periodic == 1;
        std::copy(heights, heights + nx * ny, map.row(0));
        made->surface.sigma = detrend(map, Detrend::none).rms;
        return made.release();
    });
}

int32_t rsc_surface_copy(rsc_surface** surface, const rsc_surface* original) {
    return constructed(0, surface, "surface", [&] {
        require(original, 2, "original");
        const Surface& from = original->surface;
        return new rsc_surface{
            {},
            {from.map.copy(), from.sigma, from.points_per_wave, from.theory, from.sampled,
             from.differences, from.name, from.measured, from.irregular}};
    });
}

int32_t rsc_surface_destroy(rsc_surface** surface) { return destroyed(surface, "surface"); }

int32_t rsc_surface_detrend(rsc_surface* surface, const char* how, double* rms_left) {
    return on(surface, "surface", 0, [&] {
        require(how, 2, "how");
        const std::string_view word = how;
        const auto form = std::ranges::find(kDetrendNames, word) - kDetrendNames.begin();
        if (form == std::ssize(kDetrendNames))
            refuse(2, "how", "must be \"none\", \"mean\", \"plane\", \"quadratic\" or \"sphere\"");
        const double left = [&] {
            try {
                return detrend(surface->surface.map, static_cast<Detrend>(form)).rms;
            } catch (const Error& error) {
                refuse(2, "how", error.what());
            }
        }();
        if (!surface->surface.theory) surface->surface.sigma = left;
        surface->surface.differences.reset();
        put(rms_left, left);
    });
}

int32_t rsc_surface_filter(rsc_surface* surface, double cutoff) {
    return on(surface, "surface", 0, [&] {
        if (!usable_positive(cutoff)) refuse(2, "cutoff", kPositiveBounds);
        gaussian_filter(surface->surface.map, cutoff);
        surface->surface.differences.reset();
        if (!surface->surface.theory)
            surface->surface.sigma = roughness(surface->surface.map).height;
    });
}

int32_t rsc_surface_grid(const rsc_surface* surface, int64_t* nx, int64_t* ny, double* dx,
                         double* dy, double* x0, double* y0, int32_t* periodic) {
    return on(surface, "surface", 0, [&] {
        const HeightMap& map = surface->surface.map;
        put(nx, map.nx);
        put(ny, map.ny);
        put(dx, map.dx);
        put(dy, map.dy);
        put(x0, map.x0);
        put(y0, map.y0);
        put(periodic, map.periodic ? 1 : 0);
    });
}

int32_t rsc_surface_heights(const rsc_surface* surface, int64_t n, double* heights) {
    return on(surface, "surface", 0, [&] {
        const HeightMap& map = surface->surface.map;
        if (n != static_cast<int64_t>(map.nx) * map.ny) refuse(2, "n", "must be nx*ny");
        require(heights, 3, "heights");
        for (const int j : indices(map.ny))
            std::copy(map.row(j), map.row(j) + map.nx, heights + std::ptrdiff_t(j) * map.nx);
    });
}

int32_t rsc_surface_moments(const rsc_surface* surface, double* m0, double* m2, double* m4) {
    return on(surface, "surface", 0, [&] {
        const Moments moments = grid_moments(surface->surface.map);
        put(m0, moments.m0);
        put(m2, moments.m2);
        put(m4, moments.m4);
    });
}

int32_t rsc_asperities_find(rsc_asperities** asperities, const rsc_surface* surface,
                            const rsc_case* a_case) {
    return constructed(2, asperities, "asperities", [&] {
        require(surface, 2, "surface");
        Case settings = settings_of(a_case);
        if (!a_case) settings.solver.model = ModelKind::asperities;
        return share(make_surface_model(surface->surface, settings, threads_of(settings)));
    });
}

int32_t rsc_asperities_make(rsc_asperities** asperities, const rsc_case* a_case,
                            int64_t realization) {
    return constructed(2, asperities, "asperities", [&] {
        const Case& settings = settings_of(a_case);
        require_valid(settings, {"surface", "run", "asperities%curvature", "asperities%law"});
        return share(make_surface_model(settings, realization, threads_of(settings)));
    });
}

int32_t rsc_asperities_take(rsc_asperities** asperities, int64_t n, const double* x,
                            const double* y, const double* z, const double* radius,
                            const double* kappa1, const double* kappa2, const double* angle,
                            const double* biharmonic) {
    return constructed(0, asperities, "asperities", [&] {
        if (n < 1 || n > kMost) refuse(2, "n", "must be from 1 to 2147483647");
        if ((kappa1 || kappa2 || angle) && !(kappa1 && kappa2 && angle)) {
            refuse(!kappa1   ? 7
                   : !kappa2 ? 8
                             : 9,
                   "curvature", "is missing: kappa1, kappa2 and angle go together");
        }
        SurfaceModel model;
        Asperities& a = model.asperities;
        const auto take = [n](std::vector<double>& to, const double* from, int argument,
                              const char* name) {
            require_finite(from, n, argument, name);
            to.assign(from, from + n);
        };
        take(a.x, x, 3, "x");
        take(a.y, y, 4, "y");
        take(a.z, z, 5, "z");
        take(a.radius, radius, 6, "radius");
        require_positive(a.radius, 6, "radius");
        if (kappa1) {
            take(a.kappa1, kappa1, 7, "kappa1");
            take(a.kappa2, kappa2, 8, "kappa2");
            take(a.angle, angle, 9, "angle");
            require_positive(a.kappa2, 8, "kappa2");
            for (const auto k : indices(a)) {
                if (!(a.kappa1[k] >= a.kappa2[k]))
                    refuse(7, "kappa1", "must be at least kappa2: entry ", k, " is less");
            }
        }
        if (biharmonic) take(a.biharmonic, biharmonic, 10, "biharmonic");
        if (const auto same = coincident(a))
            refuse(3, "x", "and y: entries ", same->first, " and ", same->second,
                   " are at the same position");
        model.domain = list_domain(a, {}, "the asperities");
        model.list = true;
        return share(std::move(model));
    });
}

int32_t rsc_asperities_copy(rsc_asperities** asperities, const rsc_asperities* original) {
    return constructed(0, asperities, "asperities", [&] {
        require(original, 2, "original");
        return new rsc_asperities(*original);
    });
}

int32_t rsc_asperities_destroy(rsc_asperities** asperities) {
    return destroyed(asperities, "asperities");
}

int32_t rsc_asperities_count(const rsc_asperities* asperities, int64_t* n) {
    return on(asperities, "asperities", 0, [&] {
        require(n, 2, "n");
        put(n, asperities->model->asperities.size());
    });
}

int32_t rsc_asperities_get(const rsc_asperities* asperities, int64_t n, double* x, double* y,
                           double* z, double* radius) {
    return on(asperities, "asperities", 0, [&] {
        const Asperities& a = asperities->model->asperities;
        if (n != static_cast<int64_t>(a.size())) refuse(2, "n", "must be the number of asperities");
        copy_to(x, a.x);
        copy_to(y, a.y);
        copy_to(z, a.z);
        copy_to(radius, a.radius);
    });
}

int32_t rsc_asperities_curvatures(const rsc_asperities* asperities, int64_t n, double* kappa1,
                                  double* kappa2, double* angle) {
    return on(asperities, "asperities", 0, [&] {
        const Asperities& a = asperities->model->asperities;
        if (a.kappa1.empty()) refuse(1, "asperities", "were given without curvatures");
        if (n != static_cast<int64_t>(a.size())) refuse(2, "n", "must be the number of asperities");
        copy_to(kappa1, a.kappa1);
        copy_to(kappa2, a.kappa2);
        copy_to(angle, a.angle);
    });
}
