// From a case to its surface, asperities and contact: the one way, for the program and for the library. Defaults of keys that are not set
// are decided here.
#pragma once

#include "case/case.hpp"
#include "contact/contact.hpp"
#include "contact/touching.hpp"
#include "file/result.hpp"

namespace rsc {

// The spectrum described by the keys of &surface, or read from surface%file with source = 'spectrum'.
Spectrum spectrum_of(const Case& settings);

// True where surfaces are made from a spectrum (source = 'synthetic' or 'spectrum'), false where they are read.
bool has_spectrum(const Case& settings);

// True where every realization has a surface of its own: made, or read from several files.
bool differs_by_realization(const Case& settings);

// Properties of a surface beside its heights.
struct Origin {
    double sigma = 0;                          // rms height: that of the case, or after detrending [length]
    double points_per_wave = 0;                // grid steps in the shortest wave of a made surface; 0: not known
    std::optional<Moments> theory;             // of a made surface: moments of its spectrum
    std::optional<Moments> sampled;            // of a made surface: moments of its modes
    std::string name = "the surface";          // for messages
    std::shared_ptr<const Measured> measured;  // how a measured map was prepared; null for others
};

struct Surface {
    HeightMap map;
    Origin origin;
};

// Realization `number` of the surface. A measured surface is the same for every number, unless surface%file is a pattern: then it is the
// file of that number. Throws Error(bad_input) for source = 'asperities', and as synthesize and read_heights do.
Surface make_surface(const Case& settings, std::int64_t number, int threads);
Surface make_surface(const Case& settings, const Spectrum& spectrum, std::int64_t number, int threads);  // of spectrum_of(settings)

// Points along a side of the element grid of a made surface: elements%points_per_wave in the shortest wave, or slightly more.
int element_points(const Case& settings, const Spectrum& spectrum);

// Throws Error(bad_input) where that grid is larger than allowed, or than the memory of the machine.
void require_element_memory(const Case& settings, const Spectrum& spectrum);
bool element_memory_suffices(const Case& settings, const Spectrum& spectrum);

// The same surface on the element grid; a measured map as it is.
Surface make_element_surface(const Case& settings, std::int64_t number, int threads);

// The rectangle of a surface, with the properties of the surface that a contact needs.
struct SurfaceDomain : Domain {
    double sigma = 0;            // rms height of the surface, or of the asperities of a list [length]
    bool guessed = false;        // the rectangle was derived from the asperities of a list, because surface%L is not set
    double mean_spacing = 0;     // <d> of the asperities [length]; 0: not known (a single one)
    double points_per_wave = 0;  // of the grid its summits are found on, in the shortest wave; 0: not known
    // Half a grid step of a map read: its points are cells that begin at 0, so the middle of the points lies half a step below that of the cells.
    double half_step_x = 0, half_step_y = 0;
    double rms_slope = 0;  // 0: not known (a list)
    bool repeats = false;  // beyond its rectangle: made surfaces, and heights that are said to
    std::shared_ptr<const MapMarks> marks = nullptr;  // of a measured map that is free at its border
};

// The surface as contacts use it: asperities, or with solver%model = 'elements' the points of the surface.
struct SurfaceModel {
    Asperities asperities;                    // the summits of the surface
    SummitSearch search;                      // finds the summits that an indenter touches, for laws with summits between the points
    std::shared_ptr<const HeightMap> points;  // for elements; there are no asperities then
    SurfaceDomain domain;
    SurfaceStatistics statistics;
    bool list = false;                         // the asperities were given one by one; surface%L may correct the guessed domain
    std::shared_ptr<const Measured> measured;  // of a measured map
};

// The border points and spikes of a map that is not periodic.
std::shared_ptr<const MapMarks> marks_of(const HeightMap& map, const Breaks& breaks);

// The domain of a made surface, which is known before its asperities are.
SurfaceDomain synthetic_domain(const Spectrum& spectrum);

// The domain of listed asperities: the square [0, L]^2 if it holds them, otherwise a square of side L around them. Without L it is the
// smallest square around them, or one of side 1 for a single asperity. Throws Error(bad_input) when L is less than their extent; `whose`
// names the asperities in the message.
SurfaceDomain list_domain(const Asperities& asperities, std::optional<double> L, const std::string& whose);

// The summits of a surface by the keys of &asperities, or a copy of its points with solver%model = 'elements'. Throws Error(bad_input)
// for a surface without summits.
SurfaceModel make_surface_model(const Surface& surface, const Case& settings, int threads);

// Realization `number` of the case. Asperities of a made surface are found while it is made, without storing it; they equal those of
// make_surface() where that grid is fine enough for the law. Throws Error(bad_input) for what cannot be read, made or used by the law.
SurfaceModel make_surface_model(const Case& settings, std::int64_t number, int threads);
SurfaceModel make_surface_model(const Case& settings, const Spectrum& spectrum, std::int64_t number,
                                int threads);  // of spectrum_of(settings)

// Domain and statistics alone, for elements: summits are not looked for.
SurfaceModel make_bare_model(const Surface& surface);

// Throws Error(bad_input) unless the tip at (x, y) lies above the surface: on its rectangle, or where that is guessed no farther from it
// than the indenter reaches.
void require_tip_above(const SurfaceDomain& domain, const Shape& shape, double x, double y);

// The form of body 2, from &indenter and &solids. Throws Error(bad_input) for a file that cannot be read.
Shape shape_of(const Case& settings);

// E* from &solids and that form, the tip above indentation%centre. Its default is the middle of the surface, or of the points of a map.
Indenter indenter_of(const Case& settings, const SurfaceDomain& domain);

// The sides of the surface with indentation%boundary = 'periodic'.
Period period_of(const Case& settings, const SurfaceDomain& domain);

// The length that unit = 'sigma' and solver%delta0 refer to.
double sigma_of(const Case& settings, const SurfaceDomain& domain);

// The contact of an indenter with a surface; the model must outlive it.
std::unique_ptr<Contact> make_contact(const SurfaceModel& model, const Indenter& indenter, const SolverOptions& options);

// The keys of &solver, &asperities and &indentation that a solver needs. Throws Error(bad_input) where it needs an rms height and
// there is none.
SolverOptions solver_of(const Case& settings, const SurfaceDomain& domain);

}  // namespace rsc
