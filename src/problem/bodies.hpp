// Creates the surface, the asperities and the contact of a case, for both the program and the
// library. Sets the defaults of keys that are not set.
#pragma once

#include "case/case.hpp"
#include "contact/path.hpp"
#include "io/result.hpp"
#include "surface/synthesis.hpp"

namespace rsc {

// The spectrum described by the keys of &surface, or read from surface%file with source =
// 'spectrum'.
Spectrum spectrum_of(const Case& settings);

// True if surfaces are synthesized (source = 'synthetic' or 'spectrum'), false if they are read.
bool has_spectrum(const Case& settings);

// True if every realization has its own surface: synthesized, or read from several files.
bool differs_by_realization(const Case& settings);

// The heights of realization `number` of a case whose surface is read from several files, without
// any treatment.
HeightMap read_points(const Case& settings, std::int64_t number);

struct Surface {
    HeightMap map;
    double sigma = 0;  // rms height: that of the case, or after detrending [length]
    // grid steps in the shortest wavelength of a synthetic surface; 0: not known
    double points_per_wave = 0;
    std::optional<Moments> theory;             // of a synthetic surface: moments of its spectrum
    std::optional<Moments> sampled;            // of a synthetic surface: moments of its modes
    std::optional<Moments> differences;        // and by finite differences of its heights
    std::string name = "the surface";          // for messages
    std::shared_ptr<const Measured> measured;  // preparation of a measured map; null for others
    bool irregular = true;                     // SurfaceFacts::measured
};

// Realization `number` of the surface. A measured surface is the same for every number, unless
// surface%file is a pattern: then it is the file of that number. Throws Error(bad_input) for source
// = 'asperities', and as synthesize and read_heights do.
Surface make_surface(const Case& settings, std::int64_t number, int threads);
Surface make_surface(const Case& settings, const Spectrum& spectrum, std::int64_t number,
                     int threads,
                     const RowSource::Filter& filter = {});  // of spectrum_of(settings)

// Points along a side of the element grid of a synthetic surface: elements%points_per_wave in the
// shortest wavelength, or slightly more.
int element_points(const Case& settings, const Spectrum& spectrum);

// Why that grid cannot be used: it is larger than allowed, or does not fit into memory. Empty if it
// can.
std::string too_large_for_elements(const Case& settings, const Spectrum& spectrum);

// The levels of a case, in its unit.
std::vector<double> spaced(const Case::Indentation& keys);

// True if elements read only points that are higher than the indenter at the lowest level: those of
// a synthetic surface pressed at given separations above its mean plane, elastic and without
// adhesion, whose heights are not asked for.
bool reads_high_points(const Case& settings);

// Realization `number` of the surface on the element grid; a measured map keeps its own grid. With
// the indenter and its levels [length], if reads_high_points(), heights below the indenter at all
// levels may be 0, except the first to be touched.
Surface make_element_surface(const Case& settings, std::int64_t number, int threads,
                             const Indenter* indenter = nullptr,
                             std::span<const double> levels = {});

// The rectangle of a surface, with what a contact has to know of the surface. Its sigma is that of
// the surface, or of the asperities of a list; its extent is set by solver_of().
struct SurfaceDomain : Domain, SurfaceFacts {
    // rectangle derived from the asperities of a list, because surface%L is not set
    bool guessed = false;
    // Half a grid step of a map: its points are cells that begin at 0, so the middle of the points
    // is half a step below that of the cells.
    double half_step_x = 0, half_step_y = 0;
    // periodic beyond its rectangle: synthetic surfaces, and heights declared periodic
    bool repeats = false;
};

// The surface for contacts: asperities, or with solver%model = 'elements' the points of the
// surface.
struct SurfaceModel {
    Asperities asperities;                    // the summits of the surface
    std::shared_ptr<const HeightMap> points;  // for elements, without asperities
    SurfaceDomain domain;
    SurfaceStatistics statistics;
    // the asperities were given as arrays; surface%L may replace the derived domain
    bool list = false;
    std::shared_ptr<const Measured> measured;  // of a measured map
    std::optional<Tensor> curvature;           // JudgedSurface::curvature
};

// The border points and spikes of a map that is not periodic.
std::shared_ptr<const MapMarks> marks_of(const HeightMap& map, const Breaks& breaks);

// The domain of a synthetic surface on n x n points, known before its asperities.
SurfaceDomain synthetic_domain(const Spectrum& spectrum, int n);

// The domain of listed asperities: the square [0, L]^2 if it contains them, otherwise a square of
// side L around them. Without L it is the smallest square around them, or one of side 1 for a
// single asperity. Throws Error(bad_input) if L is less than their extent; `whose` names the
// asperities in the message.
SurfaceDomain list_domain(const Asperities& asperities, std::optional<double> L,
                          const std::string& whose);

// The summits of a surface by the keys of &asperities, or a copy of its points with solver%model =
// 'elements'. Throws Error(bad_input) for a surface without summits.
SurfaceModel make_surface_model(const Surface& surface, const Case& settings, int threads);

// Realization `number` of the case. Asperities of a synthetic surface are found during synthesis,
// without storing it; they equal those of make_surface() if that grid is fine enough for the law.
// Throws Error(bad_input) for a surface that cannot be read or generated, or that the law cannot
// use.
SurfaceModel make_surface_model(const Case& settings, std::int64_t number, int threads);
SurfaceModel make_surface_model(const Case& settings, const Spectrum& spectrum, std::int64_t number,
                                int threads);  // of spectrum_of(settings)

// Domain and statistics only, for elements, without a search for summits.
SurfaceModel make_bare_model(const Surface& surface);

// Throws Error(bad_input) unless the tip at (x, y) is above the surface: on its rectangle, or, if
// the rectangle is derived from asperities, no farther from it than the reach of the indenter.
void require_tip_above(const SurfaceDomain& domain, const Shape& shape, double x, double y);

// The form of body 2, from &indenter and &solids. Throws Error(bad_input) for a file that cannot be
// read.
Shape shape_of(const Case& settings);

// E* from &solids, the form above, and the tip at indentation%centre, by default the middle of the
// surface, or of the points of a map.
Indenter indenter_of(const Case& settings, const SurfaceDomain& domain);

// The sides of the surface with indentation%boundary = 'periodic'.
Period period_of(const Case& settings, const SurfaceDomain& domain);

// The length that unit = 'sigma' and solver%delta0 refer to.
double sigma_of(const Case& settings, const SurfaceDomain& domain);

// The contact of an indenter with a surface; the model must outlive it.
std::unique_ptr<Path> make_contact(const SurfaceModel& model, const Indenter& indenter,
                                   const SolverOptions& options);

// The law of an asperity of a case on a surface: of a list of asperities, the part of
// 'fourth_order' that what is given of them permits.
LawKind law_of(const Case& settings, const SurfaceFacts& surface);

// The keys of &solver, &asperities and &indentation that a solver needs. Throws Error(bad_input) if
// it needs an rms height and there is none.
SolverOptions solver_of(const Case& settings, const SurfaceDomain& domain);

}  // namespace rsc
