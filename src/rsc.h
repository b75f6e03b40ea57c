/* clang-format off */
/* rsc: the elastic contact of rough spheres by a deterministic multi-asperity model (V. A. Yastrebov, "The Elastic Contact of
 * Rough Spheres Investigated Using a Deterministic Multi-Asperity Model", J. Multiscale Modelling, 2018). The whole of the C
 * interface.
 *
 * Order of use
 *     rsc_surface (heights)  ->  rsc_asperities (its summits)  ->  rsc_contact (a sphere pressed on them)
 *     rsc_case (all options, by the names of the program's namelist) is an argument wherever there is something to choose.
 *     Surfaces and asperities may also come from your own arrays: rsc_surface_take, rsc_asperities_take.
 *
 * Units: any consistent ones; lengths, forces, moduli in force/length^2, energies in force length.
 *
 * Status
 *     Every function returns an int32_t: 0 is success; -i says that argument number i (counted from 1) is wrong; a positive value
 *     is one of RSC_STATUS_LIST. rsc_message gives the reason in words. No function ends the program, prints, or throws a C++
 *     exception. Errors found in an option of a case carry the number of the case argument.
 * After a failure
 *     Output arguments hold what they held before, except that a constructor sets its handle to null, and except for
 *     RSC_NOT_CONVERGED, where all outputs are written (see rsc_contact_indent). Handles stay valid and usable.
 * Handles
 *     are made by the functions ending in _create, _copy, _synthesize, _find, _make, _take and released by _destroy, which takes
 *     the address of the handle, releases what it names and sets it to null; a null handle is released without complaint. A
 *     constructor overwrites the handle it is given: destroy what it held before. Handles own copies of all arrays they were made
 *     from, and share nothing you could change: a surface or a case may be destroyed while the things made from it are in use.
 * Threads
 *     Different handles may be used by different threads at the same time. Several threads may call functions that take the same handle
 *     as pointer to const. NetCDF, HDF5 and the planner of FFTW are not thread-safe, so that rsc calls them under one global lock;
 *     programs that use these libraries themselves must take the same lock, rsc_lock.
 *     After a fork the child may use its copies of the handles; it computes with one thread. modules/README has more: "rsc inside your program".
 * Numbers
 *     of arrays, and what describes a grid, a sphere or a material, must be finite and at most 1e50, positive ones at least 1e-50:
 *     beyond that, squares and powers of them would overflow. "Not finite" and "not positive" below include that.
 * Arrays
 *     come from the caller with their length; indices count from 0. "May be null" says that an output that is not wanted may be
 *     NULL. Two-dimensional arrays are stored with x running fastest: z[j*nx + i] is the height at (x0 + i dx, y0 + j dy).
 * Text
 *     goes in as a null-terminated string, and comes out into a caller's buffer: at most size-1 characters are written, always
 *     followed by a null character, and *length receives the full length without it: length >= size means that the text was cut.
 *     The buffer may be null if size is 0; length may be null.
 */
/* clang-format on */
#ifndef RSC_H
#define RSC_H

#include <stdint.h>

#ifndef RSC_API
#if defined(__GNUC__)
#define RSC_API __attribute__((visibility("default")))
#else
#define RSC_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Status codes: name, value, meaning. Negative values -i name the wrong argument. */
#define RSC_STATUS_LIST(X)                                                                                       \
    X(RSC_SUCCESS, 0, "success")                                                                                 \
    X(RSC_NOT_CONVERGED, 1, "the solver did not reach its tolerance; the results are those of its last iterate") \
    X(RSC_NO_MEMORY, 2, "out of memory")                                                                         \
    X(RSC_FILE, 3, "a file could not be read or written")                                                        \
    X(RSC_NO_RESULT, 4, "the contact has no result yet: indent or press first")                                  \
    X(RSC_INTERNAL, 5, "an internal error of rsc; please report it")                                             \
    X(RSC_STOPPED, 6, "stopped by the caller")

#define RSC_STATUS_ENUMERATOR(name, value, meaning) name = value,
enum { RSC_STATUS_LIST(RSC_STATUS_ENUMERATOR) RSC_STATUS_LAST_ = RSC_STOPPED };
#undef RSC_STATUS_ENUMERATOR

/* Status of a computed level (rsc_contact_level), the more serious the larger. The values are those of
 * the variable `status` of a result file. */
#define RSC_LEVEL_LIST(X)                                                                                 \
    X(RSC_LEVEL_CONVERGED, 0, "converged")                                                                \
    X(RSC_LEVEL_OUT_OF_VALIDITY, 1, "outside the range of validity: see the attribute comment of status") \
    X(RSC_LEVEL_OVERLAPPING, 2, "some contact spots overlap")                                             \
    X(RSC_LEVEL_NOT_UNIQUE, 3, "the solution is a minimum of the energy, perhaps not the only one")       \
    X(RSC_LEVEL_NOT_CONVERGED, 4, "the solver did not reach its tolerance")

#define RSC_LEVEL_ENUMERATOR(name, value, meaning) name = value,
enum { RSC_LEVEL_LIST(RSC_LEVEL_ENUMERATOR) RSC_LEVEL_LAST_ = RSC_LEVEL_NOT_CONVERGED };
#undef RSC_LEVEL_ENUMERATOR

typedef struct rsc_case rsc_case;             /* options: every key of the namelist with its value */
typedef struct rsc_surface rsc_surface;       /* heights on a regular grid */
typedef struct rsc_asperities rsc_asperities; /* summits: positions and radii */
typedef struct rsc_contact rsc_contact;       /* a rigid sphere on asperities, and the last level computed */
typedef struct rsc_friction rsc_friction;     /* a contact with friction, and its path */

/* ---- version and messages ------------------------------------------------------------------------------------------------- */

/* The version of this header. That of the library at run time is rsc_version's. */
#define RSC_VERSION_MAJOR 0
#define RSC_VERSION_MINOR 2
#define RSC_VERSION_PATCH 0

/* The version of the library, "major.minor.patch".
 * buffer, size, length: text output. Errors: -1 buffer null with size > 0; -2 size < 0. */
RSC_API int32_t rsc_version(char* buffer, int64_t size, int64_t* length);

/* The reason why the last failing call of this thread failed; empty if none did. Successful calls, and this one, do not change the
 * message. buffer, size, length: text output. Errors: -1 buffer null with size > 0; -2 size < 0. */
RSC_API int32_t rsc_message(char* buffer, int64_t size, int64_t* length);

/* The meaning of a status code in general, for a status of any value.
 * buffer, size, length: text output. Errors: -2 buffer null with size > 0; -3 size < 0. */
RSC_API int32_t rsc_status_text(int32_t status, char* buffer, int64_t size, int64_t* length);

/* ---- cases: options by name --------------------------------------------------------------------- */

/* A case with every key at its default.
 * new_case (out): the handle. Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_create(rsc_case** new_case);

/* A copy that is independent of the original.
 * new_case (out): the handle; original: the case to copy. Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_copy(rsc_case** new_case, const rsc_case* original);

/* Releases a case and nulls the handle. Errors: -1 null address. */
RSC_API int32_t rsc_case_destroy(rsc_case** old_case);

/* Replaces all keys by those of a namelist text; keys that are not in the text get their defaults.
 * a_case: the case; text: namelist input, as the program reads it, without &study.
 * Errors: -1, -2 null; -2 errors in the text, one line of the message for each; RSC_NO_MEMORY. On failure
 * the case is unchanged. */
RSC_API int32_t rsc_case_read(rsc_case* a_case, const char* text);

/* The same from a file.
 * a_case: the case; path: the file. Errors: -1, -2 null; -2 a file that cannot be read, or errors in its text;
 * RSC_NO_MEMORY. On failure the case is unchanged. */
RSC_API int32_t rsc_case_read_file(rsc_case* a_case, const char* path);

/* Sets one key.
 * a_case: the case; name: "group%key", "group%key(2)" or "group%key(1:2)", in any case; value: in namelist syntax (texts in
 * quotes). A key with a fixed number of values (solids%E has two) takes all of them, "1e5, 2e5", or one by its subscript.
 * Errors: -1 null; -2 null or unknown name; -3 null or a value that is refused; RSC_NO_MEMORY. On failure the case is
 * unchanged. Relations between keys are checked where the case is used. */
RSC_API int32_t rsc_case_set(rsc_case* a_case, const char* name, const char* value);

/* The value of one key in namelist syntax, exactly as rsc_case_set takes it; empty for a key that is not set.
 * a_case: the case; name: as above; buffer, size, length: text output.
 * Errors: -1 null; -2 null or unknown name; -3 buffer null with size > 0; -4 size < 0; RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_get(const rsc_case* a_case, const char* name, char* buffer, int64_t size, int64_t* length);

/* All keys with their values, as namelist text that rsc_case_read reads back to the same values if it accepts them.
 * a_case: the case; buffer, size, length: text output. Errors: -1 null; -2 buffer null with size > 0; -3 size < 0; RSC_NO_MEMORY.
 */
RSC_API int32_t rsc_case_text(const rsc_case* a_case, char* buffer, int64_t size, int64_t* length);

/* Number of keys. count (out): the number. Errors: -1 null. */
RSC_API int32_t rsc_key_count(int64_t* count);

/* The name of a key, "group%key", for going through all of them.
 * key: 0 to count-1; buffer, size, length: text output. Errors: -1 out of range; -2 buffer null with size > 0; -3 size < 0. */
RSC_API int32_t rsc_key_name(int64_t key, char* buffer, int64_t size, int64_t* length);

/* Runs the case as the program does, and writes its result file (output%file, relative to the working directory). Prints nothing.
 * a_case: the case; failed_levels (out, may be null): number of levels that did not converge.
 * Errors: -1 null or a case that is refused, an input file that cannot be used included; RSC_NOT_CONVERGED if failed_levels > 0,
 * the file being written all the same; RSC_FILE; RSC_NO_MEMORY. After any other failure
 * there is no result file, but a campaign leaves its checkpoint for the program's --resume. */
RSC_API int32_t rsc_case_run(const rsc_case* a_case, int64_t* failed_levels);

/* Called while a case runs: levels (or realizations, if there are several) done, and their total number; data: the pointer given to
 * rsc_case_run_watched. Returns 0 to continue, any other value to stop. Called by the thread that called rsc_case_run_watched, about ten
 * times a second, less often while a large surface is made or a map read. It must neither throw an exception nor call longjmp. */
typedef int32_t (*rsc_watch)(double done, double total, void* data);

/* rsc_case_run with a function that reports progress and may stop the run.
 * a_case: the case; watch: the function, or null; data: passed to it; failed_levels (out, may be null): number of levels that did not
 * converge. Errors: as rsc_case_run; RSC_STOPPED if watch stopped the run: there is no result then, but a campaign leaves its checkpoint
 * for the program's --resume. */
RSC_API int32_t rsc_case_run_watched(const rsc_case* a_case, rsc_watch watch, void* data, int64_t* failed_levels);

/* Takes the lock under which rsc calls NetCDF, HDF5 and the planner of FFTW, for programs in which other threads call these libraries. Waits
 * until no other thread holds it. A thread that holds the lock may call rsc, and take the lock again; it must be released as often as it
 * was taken. Hold it as short as possible: other threads in rsc wait. */
RSC_API int32_t rsc_lock(void);

/* Releases the lock. Errors: RSC_NO_RESULT if this thread does not hold it. */
RSC_API int32_t rsc_unlock(void);

/* ---- surfaces ----------------------------------------------------------------------------------- */

/* The surface described by &surface, as in the program. source = 'synthetic' or 'spectrum': a random one by the keys of &surface and
 * run%seed, on run%threads threads, the same as realization number `realization` of the program, whatever the threads; its heights are
 * periodic, on x = i L/n, y = j L/n (a contact on a free surface sees one period only: beyond its border there is nothing to press on).
 * source = 'heights': the map in surface%file, in run%length_unit, its missing points, form and noise treated as the keys say. surface
 * (out): the handle; a_case: the case, null for the defaults; realization: any number. Errors: -1 null; -2 keys of &surface or &run that
 * are refused, a file that cannot be used, or a source that has no heights ('asperities': rsc_asperities_make); RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_synthesize(rsc_surface** surface, const rsc_case* a_case, int64_t realization);

/* A surface of given heights, copied. Separations are measured from z = 0: see rsc_surface_detrend.
 * surface (out): the handle; nx, ny: points, 3 or more; dx, dy: grid steps > 0 [length]; x0, y0: place of the first point
 * [length]; periodic: 1 if the surface wraps around, 0 if it ends (its outermost points are then no summits); heights: nx*ny
 * values, x fastest, finite [length]. Errors: -1 null; -2, -3 less than 3, or more than 2^31-1; -4, -5 not positive or not
 * finite; -6, -7 not finite; -8 neither 0 nor 1; -9 null, or a height that is not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_take(rsc_surface** surface, int64_t nx, int64_t ny, double dx, double dy, double x0, double y0,
                                 int32_t periodic, const double* heights);

/* A copy that is independent of the original.
 * surface (out): the handle; original: the surface to copy. Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_copy(rsc_surface** surface, const rsc_surface* original);

/* Releases a surface and nulls the handle. Errors: -1 null address. */
RSC_API int32_t rsc_surface_destroy(rsc_surface** surface);

/* Subtracts a form fitted by least squares. Not while other threads read the surface.
 * surface: the surface; how: "none", "mean", "plane", "quadratic" or "sphere"; rms (out, may be null): rms height left, about its mean
 * [length]. Errors: -1 null; -2 null, another word, or a sphere that does not fit. */
RSC_API int32_t rsc_surface_detrend(rsc_surface* surface, const char* how, double* rms);

/* Low-pass filter of ISO 16610-61: a wave of length lambda keeps exp(-pi (alpha cutoff/lambda)^2) of its height, alpha = sqrt(ln 2/pi);
 * a surface that ends is continued by reflection. Not while other threads read the surface.
 * surface: the surface; cutoff: > 0 [length]. Errors: -1 null; -2 not positive or not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_filter(rsc_surface* surface, double cutoff);

/* The grid. All outputs may be null. surface: the surface; nx, ny: points; dx, dy: steps [length]; x0, y0: place of the first
 * point [length]; periodic: 1 or 0. Errors: -1 null. */
RSC_API int32_t rsc_surface_grid(const rsc_surface* surface, int64_t* nx, int64_t* ny, double* dx, double* dy, double* x0, double* y0,
                                 int32_t* periodic);

/* The heights. surface: the surface; n: length of the array, nx*ny; heights (out): x fastest [length].
 * Errors: -1 null; -2 n is not nx*ny; -3 null. */
RSC_API int32_t rsc_surface_heights(const rsc_surface* surface, int64_t n, double* heights);

/* Spectral moments by finite differences on the grid: m0 [length^2], m2 [1], m4 [1/length^2]; rms slope sqrt(2 m2). All outputs
 * may be null. surface: the surface; m0, m2, m4 (out). Errors: -1 null. */
RSC_API int32_t rsc_surface_moments(const rsc_surface* surface, double* m0, double* m2, double* m4);

/* ---- asperities --------------------------------------------------------------------------------- */

/* The summits of a surface: points above their 8 neighbours, with curvatures from second differences.
 * asperities (out): the handle, never empty; surface: the surface; a_case: asperities%curvature decides on the radius; null for
 * the defaults. With another asperities%law than 'hertz' the summits between the points, with curvatures and biharmonic by longer
 * stencils. Errors: -1 null; -2 null, or a surface without summits, or one synthesized with fewer than 4 points in lambda_s for
 * such a law (rsc_asperities_make can); RSC_NO_MEMORY.
 * With solver%model = 'elements' in the case the handle holds a copy of all points of the surface instead, and no asperities: contacts
 * made from it, with a case that says so, too, are of elements. Their spots are sets of pixels connected by sides; in place of an
 * asperity rsc_contact_spots gives the pixel with the highest pressure, row*nx + column from 0. */
RSC_API int32_t rsc_asperities_find(rsc_asperities** asperities, const rsc_surface* surface, const rsc_case* a_case);

/* The asperities for surface%source, as in the program: those of the surface of rsc_surface_synthesize, or the list in surface%file. A
 * synthetic surface is not stored, which is faster, takes half the memory and allows any grid for every asperities%law. With
 * solver%model = 'elements' the points of the surface on the grid of elements%points_per_wave.
 * asperities (out): the handle; a_case: the case, null for the defaults; realization: any number, without effect on what is read.
 * Errors: -1 null; -2 keys of &surface, &asperities or &run that are refused, or a file that cannot be used; RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_make(rsc_asperities** asperities, const rsc_case* a_case, int64_t realization);

/* Given asperities, copied.
 * asperities (out): the handle; n: number of them, 1 to 2^31-1; x, y, z: summits [length]; radius: > 0 [length]; kappa1, kappa2:
 * principal curvatures, kappa1 >= kappa2 > 0 [1/length], and angle: direction of the kappa2 axis from x [rad], all three or none
 * of them (null); biharmonic: nabla^4 z at the summit [1/length^3], or null. Contact laws (asperities%law) that need
 * missing columns refuse them. Errors: -1 null; -2 out of range; -3 to -10 null where it must not be, a value that is not finite, not positive
 * where it must be, or two summits at the same (x, y) (-3); RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_take(rsc_asperities** asperities, int64_t n, const double* x, const double* y, const double* z,
                                    const double* radius, const double* kappa1, const double* kappa2, const double* angle,
                                    const double* biharmonic);

/* Another handle of the same asperities, which never change and are held once.
 * asperities (out): the handle; original: the asperities. Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_copy(rsc_asperities** asperities, const rsc_asperities* original);

/* Releases asperities and nulls the handle. Errors: -1 null address. */
RSC_API int32_t rsc_asperities_destroy(rsc_asperities** asperities);

/* Number of asperities. asperities: the asperities; n (out): their number. Errors: -1, -2 null. */
RSC_API int32_t rsc_asperities_count(const rsc_asperities* asperities, int64_t* n);

/* Positions and radii. asperities: the asperities; n: length of each array, their number; x, y, z, radius (out, may be null)
 * [length]. Errors: -1 null; -2 n is not their number. */
RSC_API int32_t rsc_asperities_get(const rsc_asperities* asperities, int64_t n, double* x, double* y, double* z, double* radius);

/* Curvatures. asperities: the asperities; n: length of each array, their number; kappa1, kappa2 (out, may be null)
 * [1/length]; angle (out, may be null) [rad].
 * Errors: -1 null, or asperities that were given without curvatures; -2 n is not their number. */
RSC_API int32_t rsc_asperities_curvatures(const rsc_asperities* asperities, int64_t n, double* kappa1, double* kappa2, double* angle);

/* ---- contact ------------------------------------------------------------------------------------ */

/* A rigid smooth sphere over an elastic half-space that carries the asperities: the equivalent problem of two bodies,
 * 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, 1/R = 1/R1 + 1/R2. No result yet.
 * contact (out): the handle; asperities: copied by reference, may be destroyed at once; E_star: E* > 0, finite [force/length^2];
 * R: radius > 0, Infinity for a flat [length]; x0, y0: place of the tip [length]; a_case: keys of &solver, asperities%law,
 * indentation%selection, indentation%selection_factor and, where they need an rms height, surface%sigma (unless set: that of the
 * surface the asperities come from, otherwise of their heights); for asperities that were given, surface%L, the side of the square
 * surface they stand on (unless set: the smallest square that holds them), from which their mean spacing follows; null for the defaults.
 * Errors: -1, -2 null; -3, -4 out of range; -5, -6 not finite; -7 keys that are refused; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_create(rsc_contact** contact, const rsc_asperities* asperities, double E_star, double R, double x0, double y0,
                                   const rsc_case* a_case);

/* The same with E* and R from the keys of &solids, and the tip at indentation%centre, by default above the middle of the surface
 * (for asperities that were given: of the smallest rectangle that holds them, or of [0, surface%L]^2 if that holds them). contact (out): the handle; asperities: as above;
 * a_case: the case, null for the defaults. Errors: -1, -2 null; -3 keys that are refused; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_create_from_case(rsc_contact** contact, const rsc_asperities* asperities, const rsc_case* a_case);

/* A copy that is independent of the original, with its last level, what stays of its path (solids%hardness, solids%adhesion) and its committed state.
 * contact (out): the handle; original: the contact, which other threads may use only by functions that take it as pointer to const.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_copy(rsc_contact** contact, const rsc_contact* original);

/* Releases a contact and nulls the handle. Errors: -1 null address. */
RSC_API int32_t rsc_contact_destroy(rsc_contact** contact);

/* Moves the tip sideways. The results stay those of the last level until the next one is computed.
 * contact: the contact; x0, y0: its new place [length], above the surface; above asperities given without surface%L, no farther from
 * them than the sphere's radius. Errors: -1 null; -2, -3 not finite; -2 a place outside, where the tip
 * then is not moved; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_move_tip(rsc_contact* contact, double x0, double y0);

/* Stores the state for rsc_contact_rollback: the tip, the last level, and what the path has left (solids%hardness, solids%adhesion). A new contact is committed
 * when it is made. For codes that try a step and may have to repeat it.
 * contact: the contact. Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_commit(rsc_contact* contact);

/* Restores the state of the last commit. The levels that follow equal those that would have followed it then, to the tolerance.
 * contact: the contact. Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_rollback(rsc_contact* contact);

/* Position of the tip. contact: the contact; x0, y0 (out, may be null) [length]. Errors: -1 null. */
RSC_API int32_t rsc_contact_tip(const rsc_contact* contact, double* x0, double* y0);

/* The separation of first contact.
 * contact: the contact; separation (out) [length]. Errors: -1 null, or no asperity lies under the sphere; -2 null. */
RSC_API int32_t rsc_contact_first_touch(const rsc_contact* contact, double* separation);

/* Computes the contact at a separation. The result depends on the separation and the tip alone, and with solids%hardness or solids%adhesion on
 * the levels before (with adhesion it follows from the last level at fixed grips). A level near the last one is computed faster; the last one
 * itself is not computed again.
 * contact: the contact; separation: Z0, height of the tip above z = 0 [length]; force (out, may be null): N, 0 without contact
 * [force]. Errors: -1 null; -2 not finite; RSC_NOT_CONVERGED, results then being those of the last iterate; RSC_NO_MEMORY,
 * RSC_INTERNAL, the contact then holding no result. */
RSC_API int32_t rsc_contact_indent(rsc_contact* contact, double separation, double* force);

/* Says at what time the levels that follow are reached, for a body that relaxes (solids%relaxation_share; for others it changes nothing):
 * between two levels loads change linearly with time, and the first level is reached at once. The time stays until it is set again, and
 * goes back with rsc_contact_rollback; at first it is 0. contact: the contact; time: t, not before that of the last level [time]. Errors:
 * -1 null; -2 not finite, or before the last level. */
RSC_API int32_t rsc_contact_set_time(rsc_contact* contact, double time);

/* Finds the separation at which the sphere carries a force, and computes the contact there, to solver%tolerance of the force.
 * contact: the contact; force: N >= 0; 0 gives the separation of first touch [force]; separation (out, may be null): Z0 [length].
 * With solids%adhesion N may be negative, and the level is the first on the way from the last one that carries it, N = 0 included; where none
 * does, the state of the smallest force is held, and the status is RSC_NOT_CONVERGED.
 * Errors: -1 null, or no asperity lies under the sphere; -2 negative or not finite; RSC_NOT_CONVERGED, also if the force jumps
 * over N, results then being those of the last iterate; RSC_NO_MEMORY, RSC_INTERNAL, the contact then holding no result. */
RSC_API int32_t rsc_contact_press(rsc_contact* contact, double force, double* separation);

/* The last level. All outputs may be null. contact: the contact; separation: Z0 [length]; force: N = sum f [force]; area:
 * A = sum pi a^2, with elliptic spots the area of their union [length^2]; contacts: number of asperities in contact. Errors: -1 null;
 * RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_result(const rsc_contact* contact, double* separation, double* force, double* area, int64_t* contacts);

/* Status and solver data of the last level. All outputs may be null. contact: the contact; level_status: of RSC_LEVEL_LIST; candidates:
 * asperities that the sphere would penetrate without interaction; iterations: of the solver, of all levels visited when pressing;
 * overlapping_pairs: pairs of contact spots with d < a_i + a_j; residual: relative residual of F = f(<g0 - BF>). Errors: -1 null;
 * RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_level(const rsc_contact* contact, int32_t* level_status, int64_t* candidates, int64_t* iterations,
                                  int64_t* overlapping_pairs, double* residual);

/* The results of the last level in one call. All outputs may be null. contact: the contact;
 * separation: Z0 [length]; force: N [force]; stiffness: dN/dZ0, negative, 0 without contact (takes one more solution of linear
 * equations, unless null) [force/length]; area: A [length^2]; energy: W, dW/dZ0 = -N [force length]; lateral_x, lateral_y: lateral
 * force on the sphere at this separation, -dW/dx0, -dW/dy0 = -sum f_i (x_i - x0)/sqrt(R^2 - rho_i^2), alike in y [force];
 * level_status: of RSC_LEVEL_LIST; contacts: their number, of which overlapping_pairs overlap, large_contacts have a radius above a
 * quarter of the mean spacing, beyond_law are beyond the validity of the contact law, edge_contacts within a mean spacing of the border of the
 * surface. All are those at the tip's place when the level was computed.
 * Errors: -1 null; RSC_NO_RESULT, also if stiffness or energy is no finite number; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_answer(rsc_contact* contact, double* separation, double* force, double* stiffness, double* area, double* energy,
                                   double* lateral_x, double* lateral_y, int32_t* level_status, int64_t* contacts,
                                   int64_t* overlapping_pairs, int64_t* large_contacts, int64_t* beyond_law, int64_t* edge_contacts);

/* One quantity of the last level by its name in the result file: "force", "contact_area", "contacts", "candidates", "iterations",
 * "residual", "status", "products", "overlapping_pairs", "large_contacts", "beyond_law", ... ; "separation", "stiffness", "energy",
 * "conductance_length" (2 |dN/dZ0|/E*), "lateral_force_x", "lateral_force_y", "moment_x", "moment_y",
 * "resistance" (with solids%resistivity in the case the contact was made from). The message of an unknown name lists all.
 * "force_error_expected" and "area_error_expected", how far N and A may be off: known for asperities only. The error of elements shows in what
 * a finer grid changes, which rsc_case_run looks at and a contact does not: of elements there is none here, and the status says nothing of it.
 * contact: the contact; name: the name; value (out): as a number. Errors: -1, -3 null; -2 null or unknown; RSC_NO_RESULT, also if it is no
 * finite number; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_value(rsc_contact* contact, const char* name, double* value);

/* dN/dZ0 of the last level, negative, 0 without contact. It takes one more solution of linear equations.
 * contact: the contact; stiffness (out) [force/length]. Errors: -1, -2 null; RSC_NO_RESULT, also if it is no finite number;
 * RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_stiffness(rsc_contact* contact, double* stiffness);

/* Elastic energy of the last level, W = sum W_i + F'BF/2, the work of the asperities and of their interaction; dW/dZ0 = -N, so
 * that a sphere moving on the surface keeps kinetic plus elastic energy. In error by the square of the residual only. contact:
 * the contact; energy (out) [force length]. Errors: -1, -2 null; RSC_NO_RESULT, also if it is no finite number. */
RSC_API int32_t rsc_contact_energy(const rsc_contact* contact, double* energy);

/* The asperities a contact is made of, which the indices of rsc_contact_spots mean: those it was made from or, with law = 'elliptic' or
 * 'fourth_order' on a surface, the summits of the difference between surface and indenter with its tip where it is now.
 * asperities (out): the handle, to be destroyed; a contact made from it takes them as they are; contact: the contact. Errors: -1
 * null address; -2 null, or a contact of elements. */
RSC_API int32_t rsc_contact_asperities(rsc_asperities** asperities, const rsc_contact* contact);

/* The contacts of the last level, by increasing index of asperity.
 * contact: the contact; n: length of each array, at least the number of contacts (rsc_contact_result); the first ones are
 * written; asperity (out, may be null): indices; force (out, may be null) [force]; radius (out, may be null): contact radius a,
 * the area being pi a^2 [length]; penetration (out, may be null): of the asperity, interaction included [length]. Errors: -1
 * null; -2 too short; RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_spots(const rsc_contact* contact, int64_t n, int32_t* asperity, double* force, double* radius,
                                  double* penetration);

/* The same for every asperity: 0 where there is no contact.
 * contact: the contact; n: length of each array, the number of its asperities (rsc_contact_asperities); force, radius, penetration
 * (out, may be null): as above. Errors: -1 null; -2 n is not the number of asperities; RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_per_asperity(const rsc_contact* contact, int64_t n, double* force, double* radius, double* penetration);

/* Deflection of the surface by the contact forces, at any points: the sum over the contacts of the displacement under and around a
 * Hertz pressure of their force and area (Johnson 1985, section 3.4 and eq. 3.42), continuous everywhere: at distance d from the middle
 * of a spot 3f/(8 E* a)(2 - d^2/a^2) inside, 3f/(4 pi E* a) [(2 - d^2/a^2) asin(a/d) + sqrt(d^2/a^2 - 1)] outside, f/(pi E* d) far away.
 * In the solver spots interact as points; the effect of their finite size, some a^2/(10 d^2), is included here only. With laws
 * other than 'hertz' a spot is replaced by a circle of the same area. contact: the contact; n: number of points, >= 0; x, y: places [length];
 * deflection (out): positive down [length]. Errors: -1 null, or solids%adhesion; -2 negative; -3, -4 null with n > 0, or not finite; -5 null with n > 0;
 * RSC_NO_RESULT; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_deflection(const rsc_contact* contact, int64_t n, const double* x, const double* y, double* deflection);

/* ---- many contacts, and contacts saved in files -------------------------------------------------- */

/* rsc_contact_press for many contacts, in parallel. The results do not depend on the number of threads.
 * n: number of contacts, >= 0; contacts: different handles, which no other thread uses meanwhile; force: N >= 0 of each [force];
 * separation (out, may be null): Z0 of each, unchanged where it failed [length]; status (out, may be null): what rsc_contact_press returns
 * for each; threads: 1 or more, 0 for all of the machine. Errors: -1, -6 out of range; -2 null, a null handle, or one given twice; -3
 * null with n > 0. Otherwise RSC_SUCCESS if all were, or the status of the first that was not, negative ones as -2. */
RSC_API int32_t rsc_contacts_press(int64_t n, rsc_contact** contacts, const double* force, double* separation, int32_t* status,
                                   int32_t threads);

/* rsc_contact_indent for many contacts. Arguments and errors as above, with separation: Z0 of each [length]; force (out, may be null): N of
 * each [force]. */
RSC_API int32_t rsc_contacts_indent(int64_t n, rsc_contact** contacts, const double* separation, double* force, int32_t* status,
                                    int32_t threads);

/* A step of many contacts, in parallel: moves their tips, brings each to a separation or under a force, and returns what codes for moving
 * bodies need. The results do not depend on the number of threads.
 * n: number of contacts, >= 0; contacts: different handles, which no other thread uses meanwhile; x0, y0: tips, both null to leave them
 * [length]; by_force: 1 where value is a force, 0 where it is a separation; value: of each [force] or [length]. Outputs, each may be null, of a
 * contact that failed unchanged unless it is RSC_NOT_CONVERGED: separation, force; stiffness: dN/dZ0 (takes one more solution of linear
 * equations, unless null); lateral_x, lateral_y, moment_x, moment_y as of rsc_contact_value; level_status: of RSC_LEVEL_LIST; status: what
 * moving, indenting or pressing returned for each, negative ones as argument numbers of those functions. threads: 1 or more, 0 for all the
 * machine has.
 * Errors: -1, -5, -16 out of range; -2 null, a null handle, or one given twice; -3, -4 one null and the other not; -6 null with n > 0. Otherwise
 * RSC_SUCCESS if all were, or the status of the first that was not, negative ones as -2. */
RSC_API int32_t rsc_contacts_step(int64_t n, rsc_contact** contacts, const double* x0, const double* y0, int32_t by_force,
                                  const double* value, double* separation, double* force, double* stiffness, double* lateral_x,
                                  double* lateral_y, double* moment_x, double* moment_y, int32_t* level_status, int32_t* status,
                                  int32_t threads);

/* Saves a contact in a file: tip, options, the last level, what the path has left (solids%hardness, solids%adhesion) and the committed state, but neither the
 * asperities nor the surface of elements. The saved and the restored contact continue alike, an elastic one bit for bit. For that,
 * earlier levels no longer serve as starts for the next ones, so that results after a save may differ within the tolerance. The file
 * depends on the machine type; later versions of the library can read it. It is written completely or not at all. An existing file is
 * replaced only if it is a save of rsc; links, devices, read-only and other files are left as they are.
 * contact: the contact; path: the file. Errors: -1 null; -2 null or empty; RSC_FILE; RSC_NO_MEMORY; RSC_INTERNAL. */
RSC_API int32_t rsc_contact_save(rsc_contact* contact, const char* path);

/* The contact of such a file. contact (out): the handle; asperities: those it was saved with, or ones equal to them bit for bit; path: the
 * file. Errors: -1, -2 null; -2 other asperities; -3 null, empty, no such file, a damaged one or one of a later version; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_restore(rsc_contact** contact, const rsc_asperities* asperities, const char* path);

/* ---- friction ----------------------------------------------------------------------------------- */

/* m = 4 G star / E star, 1/G star = (2 - nu1)/G1 + (2 - nu2)/G2, G = E/(2 (1 + nu)): the tangential over the normal stiffness of any
 * contact of two bodies; 2 (1 - nu)/(2 - nu) for like ones. E, nu: two values each; ratio (out). Errors: -1 null, a modulus not positive
 * (Infinity: rigid), or two rigid bodies; -2 null, or outside [-1, 0.5]; -3 null. */
RSC_API int32_t rsc_stiffness_ratio(const double* E, const double* nu, double* ratio);

/* The former name of rsc_stiffness_ratio. */
RSC_API int32_t rsc_tangential_ratio(const double* E, const double* nu, double* ratio);

/* Friction for the asperities, sphere, tip and options of a contact. No path yet.
 * friction (out): the handle; contact: copied, may be destroyed at once; mu: coefficient of friction >= 0, finite; ratio: m > 0, finite
 * (rsc_stiffness_ratio). Errors: -1, -2 null; -2 not elastic; -3, -4 out of range; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_create(rsc_friction** friction, const rsc_contact* contact, double mu, double ratio);

/* The same with mu = solids%friction and the ratio from solids%E and solids%nu.
 * friction (out): the handle; contact: as above; a_case: the case, null for the defaults (mu = 0). Errors: -1, -2 null; -2 not elastic; -3
 * keys that are refused; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_create_from_case(rsc_friction** friction, const rsc_contact* contact, const rsc_case* a_case);

/* A copy that is independent of the original, with its path. friction (out): the handle; original: the friction.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_copy(rsc_friction** friction, const rsc_friction* original);

/* Releases friction and nulls the handle. Errors: -1 null address. */
RSC_API int32_t rsc_friction_destroy(rsc_friction** friction);

/* Moves the contact on a straight path to (separation, x, y) and returns the forces there. Costs one level at the new separation, one more
 * where spots slip. The first call defines the start of the path, pressed without slide. Only differences of x and y matter; a slide
 * without contact has no effect.
 * friction: the friction; separation: Z0; x, y: slide [length]; force (out, may be null): N [force]; force_x, force_y (out, may be
 * null): tangential force Q [force], along the slide at first; the force on the sphere is -Q; lost (out, may be
 * null): work lost to friction on this step, >= 0 [force length]. Errors: -1 null; -2, -3, -4 not finite; RSC_NOT_CONVERGED, outputs then
 * being those of the last iterates; RSC_NO_MEMORY, RSC_INTERNAL. On failures other than RSC_NOT_CONVERGED the state is unchanged. */
RSC_API int32_t rsc_friction_update(rsc_friction* friction, double separation, double x, double y, double* force, double* force_x,
                                    double* force_y, double* lost);

/* Moves the tip, for a sphere that rolls onto other asperities, at the separation of the last update. Asperities that carry at both places keep
 * their share of Q: memory is taken over at the same share of the depth below first touch, and its slips times the share of the force that is
 * carried at both places. What that leaves of the energy of the slide beyond what fits is lost to friction; none is won. Without a path, or to
 * where the tip is already, nothing but the tip changes. Costs a level for each reversal in memory.
 * friction: the friction; x0, y0: the new place [length], as of rsc_contact_move_tip. Errors: -1 null; -2, -3 not finite; -2 outside;
 * RSC_NOT_CONVERGED; RSC_NO_MEMORY, RSC_INTERNAL. On failures other than RSC_NOT_CONVERGED the state is unchanged. */
RSC_API int32_t rsc_friction_move_tip(rsc_friction* friction, double x0, double y0);

/* dQ/d(x, y) of a further slide at this separation in the direction of what slips now (S m in all directions where nothing slips, and for a
 * slide back, S being -dN/dZ0). Costs up to one level. All outputs may be null. friction: the friction; xx, xy, yx, yy: dQ_x/dx, dQ_x/dy,
 * dQ_y/dx, dQ_y/dy [force/length], 0 without contact. Errors: -1 null; RSC_NOT_CONVERGED; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_stiffness(rsc_friction* friction, double* xx, double* xy, double* yx, double* yy);

/* State of the path after the last update. All outputs may be null. friction: the friction; separation, x, y: the last update's [length]; force: N;
 * force_x, force_y: Q [force]; energy: elastic energy W of the normal problem; tangential_energy: elastic energy of the slide; lost: work
 * lost to friction since the path began [force length]; stick_separation: the separation whose spots stick, the separation itself where
 * all sticks, that of first touch where all slips [length]. Errors: -1 null; RSC_NO_RESULT before the first update. */
RSC_API int32_t rsc_friction_state(const rsc_friction* friction, double* separation, double* x, double* y, double* force, double* force_x,
                                   double* force_y, double* energy, double* tangential_energy, double* lost, double* stick_separation);

/* Stores the state for rsc_friction_rollback. A new friction is committed without a path.
 * friction: the friction. Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_commit(rsc_friction* friction);

/* Restores the state of the last commit. friction: the friction. Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_rollback(rsc_friction* friction);

/* First loading at the separation of the last update: tangential forces of a contact that is pressed there and then slid. The path of the
 * friction is not changed.
 * Q = mu [N(Z0) - N(Z0')], slide = (mu/m) (Z0' - Z0). A level for each slide short of full slip.
 * friction: the friction; n: length of the arrays, >= 0; slide: >= 0 [length]; force (out): Q [force]; stick_separation (out, may be
 * null): Z0' [length]. Errors: -1 null; -2 negative; -3 null with n > 0, negative or not finite; -4 null with n > 0; RSC_NO_RESULT before
 * the first update and without contact; RSC_NOT_CONVERGED; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_first_loading(rsc_friction* friction, int64_t n, const double* slide, double* force, double* stick_separation);

/* The same for a given force: the slide that takes Q. friction: the friction; force: 0 <= Q <= mu N [force]; slide (out) [length].
 * Errors: -1 null; -2 out of range; -3 null; RSC_NO_RESULT before the first update and without contact; RSC_NOT_CONVERGED; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_slide(rsc_friction* friction, double force, double* slide);

/* Full slip after first loading at the separation of the last update. Both outputs may be null. friction: the friction; slide: the one
 * that takes it [length]; force: mu N [force]. Errors: -1 null; RSC_NO_RESULT before the first update and without contact. */
RSC_API int32_t rsc_friction_full_slip(const rsc_friction* friction, double* slide, double* force);

/* Friction at the spots of the last update, by increasing index of asperity. Costs a level for each reversal in memory. The number is
 * written even if the arrays are too short.
 * friction: the friction; n: length of each array; count (out, may be null): number of spots; asperity (out, may be null): indices; radius
 * (out, may be null): contact radius [length]; stick_radius (out, may be null): of the part that sticks, 0 where all of it slips [length];
 * force_x, force_y (out, may be null): the spot's share of Q [force]. Errors: -1 null; -2 too short; RSC_NO_RESULT before the first update;
 * RSC_NOT_CONVERGED; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_spots(rsc_friction* friction, int64_t n, int64_t* count, int32_t* asperity, double* radius,
                                   double* stick_radius, double* force_x, double* force_y);

/* Saves friction with its path, and the committed state, in a file, as rsc_contact_save does. friction: the friction; path: the file.
 * Errors: -1 null; -2 null or empty; RSC_FILE; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_save(rsc_friction* friction, const char* path);

/* The friction of such a file. friction (out): the handle; asperities, path and errors as of rsc_contact_restore. */
RSC_API int32_t rsc_friction_restore(rsc_friction** friction, const rsc_asperities* asperities, const char* path);

#ifdef __cplusplus
}
#endif

#endif /* RSC_H */
