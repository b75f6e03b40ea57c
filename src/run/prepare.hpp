// A case becomes surface, asperities and contact: the one way, for the program and for the library. What holds where a key is not set
// stands here.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "case/case.hpp"
#include "contact/contact.hpp"
#include "contact/indentation.hpp"
#include "contact/touching.hpp"
#include "file/result.hpp"
#include "observe/record.hpp"
#include "rough/asperities.hpp"
#include "rough/measured.hpp"

namespace rsc {

// The spectrum that the keys of &surface ask for, read from its file with source = 'spectrum'.
Spectrum spectrum_of(const Case& settings);

// Whether there is one: surfaces are made, not read.
bool has_spectrum(const Case& settings);

// Whether every realization has a surface of its own, made or read.
bool differs_by_realization(const Case& settings);

// What is known of heights beside them.
struct Origin {
    double sigma = 0;                          // rms height that is meant: the one asked for, or what detrending left [length]
    double points_per_wave = 0;                // grid steps in the shortest wave of a synthetic surface; 0: not known
    std::optional<Moments> theory;             // of a synthetic surface
    std::optional<Moments> sampled;            // of a synthetic surface by its modes
    std::string name = "the surface";          // what messages call it
    std::shared_ptr<const Measured> measured;  // what was done to a measured map; null for others
};

struct Surface {
    HeightMap map;
    Origin origin;
};

// Realization `number` of the surface that &surface source names: made, or read and measured (rough/measured.hpp) and then the same for every
// number, unless surface%file is a pattern: then it is the file of that number.
// Throws Error(bad_input) for a source that has no heights, and as synthesize and read_heights do.
Surface make_surface(const Case& settings, std::int64_t number, int threads);
Surface make_surface(const Case& settings, const Spectrum& spectrum, std::int64_t number, int threads);  // of spectrum_of(settings)

// Points a side of the grid of elements on a synthetic surface: points_per_wave in the shortest wave, or a few more.
int element_points(const Case& settings, const Spectrum& spectrum);

// Whether that grid is allowed and has room in memory.
bool element_memory_suffices(const Case& settings, const Spectrum& spectrum);

// Throws Error(bad_input) saying how much memory that grid takes when the machine has less.
void require_element_memory(const Case& settings, const Spectrum& spectrum);

// The same surface for elements: on that grid, or as measured.
Surface make_element_surface(const Case& settings, std::int64_t number, int threads);

// What a contact has to know of the surface beside its asperities.
struct Site {
    Domain domain;               // the surface's rectangle
    double sigma = 0;            // rms height of the surface, or of the asperities of a list [length]
    bool guessed = false;        // the rectangle is made up: asperities of a list, and no surface%L
    double mean_spacing = 0;     // <d> of the asperities [length]; 0: not known (a single one)
    double points_per_wave = 0;  // of the grid its summits are found on, in the shortest wave; 0: not known
    // Of a map read, whose points are cells from [0, dx] on: half a step, by which their middle is below that of the rectangle.
    double half_step_x = 0, half_step_y = 0;
    double rms_slope = 0;  // of the surface; 0: not known (a list)
};

// Asperities, or the points of the surface themselves, and what is known of where they come from.
struct Ground {
    Asperities asperities;                    // the summits of the surface
    SummitSearch search;                      // of those that an indenter touches, for laws that take summits between the points
    std::shared_ptr<const HeightMap> points;  // solver%model = 'elements'; there are no asperities then
    Site site;
    SurfaceStatistics statistics;
    bool list = false;                         // given one by one: the site is then a guess, which surface%L may better
    std::shared_ptr<const Measured> measured;  // of a measured map
};

// Site of a synthetic surface. Known before there are asperities.
Site synthetic_site(const Spectrum& spectrum);

// Site of asperities that were given: the square of side L about them, [0, L]^2 if it holds them; without L the smallest square
// about the middle of the smallest rectangle that holds them, of side 1 for a single one. Throws Error(bad_input) naming `whose`
// asperities they are when L is less than their extent.
Site list_site(const Asperities& asperities, std::optional<double> L, const std::string& whose);

// The summits of a surface by the keys of &asperities. Never empty: throws Error(bad_input) for a surface without summits. With
// model = 'elements' a copy of its points.
Ground make_ground(const Surface& surface, const Case& settings, int threads);

// Realization `number` of the asperities that &surface source names, whatever it is. Those of a synthetic surface are found while
// it is made, without storing it: the same as those of make_surface where that grid is fine enough for the law. Never empty.
// Throws Error(bad_input) for what cannot be read, made or used by the law.
Ground make_ground(const Case& settings, std::int64_t number, int threads);
Ground make_ground(const Case& settings, const Spectrum& spectrum, std::int64_t number, int threads);  // of spectrum_of(settings)

// Throws Error(bad_input) unless the tip at (x, y) is above the surface: on its rectangle, or where that is guessed no farther from it
// than the indenter reaches. For every place where a tip is put.
void require_tip_above(const Site& site, const Shape& shape, double x, double y);

// The same without asperities, for elements: summits are not looked for.
Ground make_bare_ground(const Surface& surface);

// The form of body 2, from &indenter and &solids. Throws Error(bad_input) for what cannot be read or made.
Shape shape_of(const Case& settings);

// E* from &solids and that shape, the tip above indentation%centre, by default the middle of the surface, or of the points of a map.
Indenter indenter_of(const Case& settings, const Site& site);

// The sides of the surface with indentation%boundary = 'periodic'.
Period period_of(const Case& settings, const Site& site);

// The length that unit='sigma' and delta0 mean.
double sigma_of(const Case& settings, const Site& site);

// The contact of an indenter with that ground, which must outlive it.
std::unique_ptr<Contact> make_contact(const Ground& ground, const Indenter& indenter, const SolverOptions& options);

// The keys of &solver, and of &asperities and &indentation that the solver looks at. Throws Error(bad_input) where it needs an rms
// height and there is none.
SolverOptions solver_of(const Case& settings, const Site& site);

}  // namespace rsc
