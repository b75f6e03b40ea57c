/* rsc: the elastic contact of rough surfaces. The whole of the C interface.
 *
 * The model of asperities is that of V. A. Yastrebov, "The Elastic Contact of Rough Spheres
 * Investigated Using a Deterministic Multi-Asperity Model", J. Multiscale Modelling, 2018.
 *
 * Order of use
 *     rsc_surface (heights) -> rsc_asperities (its summits) -> rsc_contact (a sphere on them)
 *     rsc_case, all options by the names of the program's namelist, is an argument wherever there
 *     is something to choose. Surfaces and asperities may also come from your own arrays:
 *     rsc_surface_take, rsc_asperities_take.
 * Units
 *     Any consistent ones; lengths, forces, moduli in force/length^2, energies in force length.
 * Status
 *     Every function returns an int32_t: 0 on success; -i if argument number i (counted from 1) is
 *     wrong; or a positive value of RSC_STATUS_LIST. rsc_message returns the reason as text. No
 *     function ends the program, prints, or throws a C++ exception. An error in an option of a
 *     case returns the number of the case argument.
 * After a failure
 *     Output arguments keep their values, except that a constructor sets its handle to null, and
 *     that all outputs are written after RSC_NOT_CONVERGED (see rsc_contact_indent). Handles stay
 *     valid and usable.
 * Handles
 *     are created by the functions ending in _create, _copy, _synthesize, _find, _make, _take and
 *     released by _destroy, which takes the address of the handle, frees the object and sets the
 *     handle to null; releasing a null handle is no error. A constructor overwrites the handle it
 *     is given: destroy the former object first. Objects own copies of all arrays they were made
 *     from: a surface or a case may be destroyed while objects made from it are in use.
 * Threads
 *     Different handles may be used by different threads at the same time. Several threads may call
 *     functions that take the same handle as pointer to const. NetCDF, HDF5 and the planner of FFTW
 *     are not thread-safe: rsc calls them under one global lock, and programs that use these
 *     libraries themselves must take the same lock, rsc_lock. After a fork the child may use its
 *     copies of the handles; it computes with one thread. See "rsc inside your program" in
 *     modules/README.
 * Numbers
 *     in arrays, and parameters of a grid, a sphere or a material, must be finite and at most 1e50
 *     in magnitude, positive ones at least 1e-50, because their squares and powers would overflow
 *     beyond. "Not finite" and "not positive" below include these limits.
 * Arrays
 *     are allocated by the caller and passed with their length; indices count from 0. "May be null"
 *     marks outputs that may be passed as NULL if they are not needed. Two-dimensional arrays are
 *     stored with x running fastest: z[j*nx + i] is the height at (x0 + i dx, y0 + j dy).
 * Text
 *     input is a null-terminated string. Text output is written to the caller's buffer: at most
 *     size-1 characters, always followed by a null character; *length receives the full length
 *     without it, so that length >= size means that the text was cut. The buffer may be null if
 *     size is 0; length may be null.
 */
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
#define RSC_STATUS_LIST(X)                                                                 \
    X(RSC_SUCCESS, 0, "success")                                                           \
    X(RSC_NOT_CONVERGED, 1,                                                                \
      "the solver did not reach its tolerance; the results are those of its last iterate") \
    X(RSC_NO_MEMORY, 2, "out of memory")                                                   \
    X(RSC_FILE, 3, "a file could not be read or written")                                  \
    X(RSC_NO_RESULT, 4, "the contact has no result yet: indent or press first")            \
    X(RSC_INTERNAL, 5, "an internal error of rsc; please report it")                       \
    X(RSC_STOPPED, 6, "stopped by the caller")

#define RSC_STATUS_ENUMERATOR(name, value, meaning) name = value,
enum { RSC_STATUS_LIST(RSC_STATUS_ENUMERATOR) RSC_STATUS_LAST_ = RSC_STOPPED };
#undef RSC_STATUS_ENUMERATOR

/* Status of a computed level (rsc_contact_level), the more serious the larger. The values are those
 * of the variable `status` of a result file. */
#define RSC_LEVEL_LIST(X)                                                  \
    X(RSC_LEVEL_CONVERGED, 0, "converged")                                 \
    X(RSC_LEVEL_OUT_OF_VALIDITY, 1,                                        \
      "something limits the accuracy: see the variable doubts of results") \
    X(RSC_LEVEL_OVERLAPPING, 2, "some contact spots overlap")              \
    X(RSC_LEVEL_NOT_UNIQUE, 3,                                             \
      "the solution is a minimum of the energy, perhaps not the only one") \
    X(RSC_LEVEL_NOT_CONVERGED, 4, "the solver did not reach its tolerance")

#define RSC_LEVEL_ENUMERATOR(name, value, meaning) name = value,
enum { RSC_LEVEL_LIST(RSC_LEVEL_ENUMERATOR) RSC_LEVEL_LAST_ = RSC_LEVEL_NOT_CONVERGED };
#undef RSC_LEVEL_ENUMERATOR

typedef struct rsc_case rsc_case;             /* options: every key with its value */
typedef struct rsc_surface rsc_surface;       /* heights on a regular grid */
typedef struct rsc_asperities rsc_asperities; /* summits: positions and radii */
typedef struct rsc_contact rsc_contact;       /* an indenter on asperities, and its last level */
typedef struct rsc_friction rsc_friction;     /* a contact with friction, and its path */

/* ---- version and messages -------------------------------------------------------------------- */

/* The version of this header. rsc_version returns that of the library at run time. */
#define RSC_VERSION_MAJOR 0
#define RSC_VERSION_MINOR 4
#define RSC_VERSION_PATCH 0

/* The version of the library, "major.minor.patch".
 *     buffer, size, length: text output.
 * Errors: -1 buffer null with size > 0; -2 size < 0. */
RSC_API int32_t rsc_version(char* buffer, int64_t size, int64_t* length);

/* The error message of the last call of this thread that failed; empty if none has. Successful
 * calls, this one included, leave it unchanged.
 *     buffer, size, length: text output.
 * Errors: -1 buffer null with size > 0; -2 size < 0. */
RSC_API int32_t rsc_message(char* buffer, int64_t size, int64_t* length);

/* The general meaning of a status code; status may have any value.
 *     buffer, size, length: text output.
 * Errors: -2 buffer null with size > 0; -3 size < 0. */
RSC_API int32_t rsc_status_text(int32_t status, char* buffer, int64_t size, int64_t* length);

/* ---- cases: options by name ------------------------------------------------------------------ */

/* A case with every key at its default.
 *     new_case (out): the handle.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_create(rsc_case** new_case);

/* A copy that is independent of the original.
 *     new_case (out): the handle;
 *     original: the case to copy.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_copy(rsc_case** new_case, const rsc_case* original);

/* Releases a case and nulls the handle.
 * Errors: -1 null address. */
RSC_API int32_t rsc_case_destroy(rsc_case** old_case);

/* Sets all keys from a namelist text; keys that are not in the text get their defaults.
 *     a_case: the case;
 *     text: namelist input as for the program, but without &study.
 * Errors: -1, -2 null; -2 errors in the text, one line of the message for each; RSC_NO_MEMORY. On
 *     failure the case is unchanged. */
RSC_API int32_t rsc_case_read(rsc_case* a_case, const char* text);

/* Sets all keys from a namelist file, as rsc_case_read does from a text.
 *     a_case: the case;
 *     path: the file.
 * Errors: -1, -2 null; -2 if the file cannot be read or its text has errors; RSC_NO_MEMORY. On
 *     failure the case is unchanged. */
RSC_API int32_t rsc_case_read_file(rsc_case* a_case, const char* path);

/* Sets one key.
 *     a_case: the case;
 *     name: "group%key", "group%key(2)" or "group%key(1:2)", in any case;
 *     value: in namelist syntax (texts in quotes).
 * A key with a fixed number of values (solids%E has two) takes all of them, "1e5, 2e5", or one by
 * its subscript. An empty value is the default.
 * Errors: -1 null; -2 null or unknown name; -3 null or an invalid value; RSC_NO_MEMORY. On failure
 *     the case is unchanged. Relations between keys are checked when the case is used. */
RSC_API int32_t rsc_case_set(rsc_case* a_case, const char* name, const char* value);

/* The value of one key in namelist syntax, as rsc_case_set accepts it; empty for a key that is not
 * set.
 *     a_case: the case;
 *     name: as above;
 *     buffer, size, length: text output.
 * Errors: -1 null; -2 null or unknown name; -3 buffer null with size > 0; -4 size < 0;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_get(const rsc_case* a_case, const char* name, char* buffer, int64_t size,
                             int64_t* length);

/* All keys with their values as namelist text. If rsc_case_read accepts this text, it restores the
 * same values.
 *     a_case: the case;
 *     buffer, size, length: text output.
 * Errors: -1 null; -2 buffer null with size > 0; -3 size < 0; RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_text(const rsc_case* a_case, char* buffer, int64_t size, int64_t* length);

/* Number of keys.
 *     count (out): the number.
 * Errors: -1 null. */
RSC_API int32_t rsc_key_count(int64_t* count);

/* The name of the key with a given number, "group%key": a program can list all keys.
 *     key: 0 to count-1;
 *     buffer, size, length: text output.
 * Errors: -1 out of range; -2 buffer null with size > 0; -3 size < 0. */
RSC_API int32_t rsc_key_name(int64_t key, char* buffer, int64_t size, int64_t* length);

/* Runs the case as the program does, and writes its result file (output%file, relative to the
 * working directory). Prints nothing.
 *     a_case: the case;
 *     failed_levels (out, may be null): number of levels that did not converge.
 * Errors: -1 null, an invalid case or an unusable input file; RSC_NOT_CONVERGED if failed_levels >
 *     0, in which case the result file is still written; RSC_FILE; RSC_NO_MEMORY. After any other
 *     failure there is no result file, but a campaign leaves its checkpoint for rsc_case_resume.
 */
RSC_API int32_t rsc_case_run(const rsc_case* a_case, int64_t* failed_levels);

/* Callback during the run of a case.
 *     done, total: number of levels (or realizations, if there are several) computed so far and in
 *       total;
 *     data: the pointer given to rsc_case_run_watched.
 * Returns 0 to continue, any other value to stop. Called by the thread that called
 * rsc_case_run_watched, about ten times a second, less often while a large surface is generated or
 * a map is read. It must neither throw an exception nor call longjmp. */
typedef int32_t (*rsc_watch)(double done, double total, void* data);

/* rsc_case_run with a function that reports progress and may stop the run.
 *     a_case: the case;
 *     watch: the function, or null;
 *     data: passed to it;
 *     failed_levels (out, may be null): number of levels that did not converge.
 * Errors: as rsc_case_run; RSC_STOPPED if watch stopped the run: then there is no result, but a
 *     campaign leaves its checkpoint for rsc_case_resume. */
RSC_API int32_t rsc_case_run_watched(const rsc_case* a_case, rsc_watch watch, void* data,
                                     int64_t* failed_levels);

/* Continues an interrupted campaign from its checkpoint, or adds realizations to a finished one, as
 * the program does with --resume. A case without a checkpoint or result is run from its start.
 *     a_case, watch, data, failed_levels (out, may be null): as in rsc_case_run_watched.
 * Errors: as rsc_case_run_watched. The file is the one that an uninterrupted run would have
 *     written. */
RSC_API int32_t rsc_case_resume(const rsc_case* a_case, rsc_watch watch, void* data,
                                int64_t* failed_levels);

/* Takes the lock under which rsc calls NetCDF, HDF5 and the planner of FFTW, for programs in which
 * other threads call these libraries. Waits until no other thread holds the lock. A thread that holds the
 * lock may call rsc and take the lock again; it must release it as often as it took it. Hold it as
 * briefly as possible: other threads in rsc wait for it. HDF5 prints no messages in this thread
 * afterwards. */
RSC_API int32_t rsc_lock(void);

/* Releases the lock.
 * Errors: RSC_NO_RESULT if this thread does not hold it. */
RSC_API int32_t rsc_unlock(void);

/* ---- surfaces -------------------------------------------------------------------------------- */

/* The surface described by &surface, as in the program. source = 'synthetic' or 'spectrum': a
 * random surface from the keys of &surface and run%seed, identical to realization number
 * `realization` of the program for any number of threads (run%threads are used); its heights are
 * periodic, on x = i L/n, y = j L/n (with a free boundary a contact uses only one period). source =
 * 'heights': the map in surface%file, in run%length_unit, with missing points, form and noise
 * treated by the keys of &surface.
 *     surface (out): the handle;
 *     a_case: the case, null for the defaults;
 *     realization: any number.
 * Errors: -1 null; -2 invalid keys of &surface or &run, an unusable file, or a source without
 *     heights ('asperities': use rsc_asperities_make); RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_synthesize(rsc_surface** surface, const rsc_case* a_case,
                                       int64_t realization);

/* A surface from an array of heights, which is copied. Separations are measured from z = 0: see
 * rsc_surface_detrend.
 *     surface (out): the handle;
 *     nx, ny: points, 3 or more;
 *     dx, dy: grid steps > 0 [length];
 *     x0, y0: place of the first point [length];
 *     periodic: 1 for a periodic surface, 0 otherwise (then its outermost points are no summits);
 *     heights: nx*ny values, x fastest, finite [length].
 * Errors: -1 null; -2, -3 less than 3, or more than 2^31-1; -4, -5 not positive or not finite; -6,
 *     -7 not finite; -8 neither 0 nor 1; -9 null, or a height that is not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_take(rsc_surface** surface, int64_t nx, int64_t ny, double dx,
                                 double dy, double x0, double y0, int32_t periodic,
                                 const double* heights);

/* A copy that is independent of the original.
 *     surface (out): the handle;
 *     original: the surface to copy.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_copy(rsc_surface** surface, const rsc_surface* original);

/* Releases a surface and nulls the handle.
 * Errors: -1 null address. */
RSC_API int32_t rsc_surface_destroy(rsc_surface** surface);

/* Subtracts a form fitted by least squares. No other thread may use the surface meanwhile.
 *     surface: the surface;
 *     how: "none", "mean", "plane", "quadratic" or "sphere";
 *     rms (out, may be null): remaining rms height, about the mean [length].
 * Errors: -1 null; -2 null, another word, or a sphere that cannot be fitted. */
RSC_API int32_t rsc_surface_detrend(rsc_surface* surface, const char* how, double* rms);

/* Low-pass filter of ISO 16610-61: a wave of length lambda keeps exp(-pi (alpha cutoff/lambda)^2)
 * of its height, alpha = sqrt(ln 2/pi); a surface that is not periodic is continued by reflection.
 * No other thread may use the surface meanwhile.
 *     surface: the surface;
 *     cutoff: > 0 [length].
 * Errors: -1 null; -2 not positive or not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_filter(rsc_surface* surface, double cutoff);

/* The grid. All outputs may be null.
 *     surface: the surface;
 *     nx, ny: points;
 *     dx, dy: steps [length];
 *     x0, y0: place of the first point [length];
 *     periodic: 1 or 0.
 * Errors: -1 null. */
RSC_API int32_t rsc_surface_grid(const rsc_surface* surface, int64_t* nx, int64_t* ny, double* dx,
                                 double* dy, double* x0, double* y0, int32_t* periodic);

/* The heights.
 *     surface: the surface;
 *     n: length of the array, nx*ny;
 *     heights (out): x fastest [length].
 * Errors: -1 null; -2 n is not nx*ny; -3 null. */
RSC_API int32_t rsc_surface_heights(const rsc_surface* surface, int64_t n, double* heights);

/* Spectral moments by finite differences on the grid; the rms slope is sqrt(2 m2). All outputs may
 * be null.
 *     surface: the surface;
 *     m0 (out) [length^2];
 *     m2 (out) [1];
 *     m4 (out) [1/length^2].
 * Errors: -1 null. */
RSC_API int32_t rsc_surface_moments(const rsc_surface* surface, double* m0, double* m2, double* m4);

/* ---- asperities ------------------------------------------------------------------------------ */

/* The summits of a surface: points above their 8 neighbours, with curvatures from second
 * differences.
 *     asperities (out): the handle, never empty;
 *     surface: the surface;
 *     a_case: asperities%curvature selects the radius; null for the defaults.
 * With an asperities%law other than 'hertz', summits are located between the points, and curvatures
 * and biharmonic come from longer stencils.
 * With solver%model = 'elements' in the case, the handle holds a copy of all points of the surface
 * and no asperities; contacts made from it with such a case are solved by boundary elements. Their
 * spots are sets of pixels connected by sides, and rsc_contact_spots returns for each the pixel
 * with the highest pressure, row*nx + column from 0, in place of an asperity.
 * Errors: -1 null; -2 null, or a surface without summits, or (with such a law) one synthesized with
 *     fewer than 4 points in lambda_s, for which rsc_asperities_make must be used; RSC_NO_MEMORY.
 */
RSC_API int32_t rsc_asperities_find(rsc_asperities** asperities, const rsc_surface* surface,
                                    const rsc_case* a_case);

/* The asperities for surface%source, as in the program: the summits of the surface of
 * rsc_surface_synthesize, or the list in surface%file. A synthetic surface is not stored, which is
 * faster, takes half the memory and allows any grid for every asperities%law. With solver%model =
 * 'elements': the points of the surface on the grid of elements%points_per_wave. 'auto' means
 * asperities here, as the levels, on which the choice of a run depends, are not known.
 *     asperities (out): the handle;
 *     a_case: the case, null for the defaults;
 *     realization: any number, without effect on files.
 * Errors: -1 null; -2 invalid keys of &surface, &asperities or &run, or an unusable file;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_make(rsc_asperities** asperities, const rsc_case* a_case,
                                    int64_t realization);

/* Asperities from arrays, which are copied.
 *     asperities (out): the handle;
 *     n: number of them, 1 to 2^31-1;
 *     x, y, z: summits [length];
 *     radius: > 0 [length];
 *     kappa1, kappa2: principal curvatures, kappa1 >= kappa2 > 0 [1/length], and angle: direction
 *       of the kappa2 axis from x [rad], all three or none of them (null);
 *     biharmonic: nabla^4 z at the summit [1/length^3], or null.
 * Contact laws (asperities%law) that need curvatures or biharmonic refuse asperities without them.
 * Errors: -1 null; -2 out of range; -3 to -10 null for a required array, a value that is not finite
 *     or, where required, not positive, or two summits at the same (x, y) (-3); RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_take(rsc_asperities** asperities, int64_t n, const double* x,
                                    const double* y, const double* z, const double* radius,
                                    const double* kappa1, const double* kappa2, const double* angle,
                                    const double* biharmonic);

/* Another handle of the same asperities. They never change, so that they are stored only once.
 *     asperities (out): the handle;
 *     original: the asperities.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_copy(rsc_asperities** asperities, const rsc_asperities* original);

/* Releases asperities and nulls the handle.
 * Errors: -1 null address. */
RSC_API int32_t rsc_asperities_destroy(rsc_asperities** asperities);

/* Number of asperities.
 *     asperities: the asperities;
 *     n (out): their number.
 * Errors: -1, -2 null. */
RSC_API int32_t rsc_asperities_count(const rsc_asperities* asperities, int64_t* n);

/* Positions and radii.
 *     asperities: the asperities;
 *     n: length of each array, their number;
 *     x, y, z, radius (out, may be null) [length].
 * Errors: -1 null; -2 n is not their number. */
RSC_API int32_t rsc_asperities_get(const rsc_asperities* asperities, int64_t n, double* x,
                                   double* y, double* z, double* radius);

/* Curvatures.
 *     asperities: the asperities;
 *     n: length of each array, their number;
 *     kappa1, kappa2 (out, may be null) [1/length];
 *     angle (out, may be null) [rad].
 * Errors: -1 null, or asperities that were given without curvatures; -2 n is not their number. */
RSC_API int32_t rsc_asperities_curvatures(const rsc_asperities* asperities, int64_t n,
                                          double* kappa1, double* kappa2, double* angle);

/* ---- contact --------------------------------------------------------------------------------- */

/* A rigid smooth sphere over an elastic half-space that carries the asperities: the equivalent
 * problem of two bodies, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, 1/R = 1/R1 + 1/R2. No result yet.
 *     contact (out): the handle;
 *     asperities: shared, the handle may be destroyed at once;
 *     E_star: E* > 0, finite [force/length^2];
 *     R: radius > 0, Infinity for a flat [length];
 *     x0, y0: place of the tip [length];
 *     a_case: null for the defaults, otherwise these keys apply: &solver, asperities%law,
 *       indentation%selection, indentation%selection_factor; surface%sigma as the rms height
 *       (default: that of the surface of the asperities, or of the heights of asperities from
 *       arrays); surface%L for asperities from arrays, as the side of their square surface, which
 *       determines their mean spacing (default: the smallest square that contains them).
 * Errors: -1, -2 null; -3, -4 out of range; -5, -6 not finite; -7 invalid keys; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_create(rsc_contact** contact, const rsc_asperities* asperities,
                                   double E_star, double R, double x0, double y0,
                                   const rsc_case* a_case);

/* As rsc_contact_create, with E* and R from the keys of &solids and the tip at indentation%centre,
 * by default above the middle of the surface (for asperities from arrays: of [0, surface%L]^2 if it
 * contains them, otherwise of the smallest rectangle that does).
 *     contact (out): the handle;
 *     asperities: as above;
 *     a_case: the case, null for the defaults.
 * Errors: -1, -2 null; -3 invalid keys; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_create_from_case(rsc_contact** contact,
                                             const rsc_asperities* asperities,
                                             const rsc_case* a_case);

/* A copy that is independent of the original, with its last level, its loading history
 * (solids%hardness, solids%adhesion) and its committed state.
 *     contact (out): the handle;
 *     original: the contact, which other threads may use only by functions that take it as pointer
 *       to const.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_copy(rsc_contact** contact, const rsc_contact* original);

/* Releases a contact and nulls the handle.
 * Errors: -1 null address. */
RSC_API int32_t rsc_contact_destroy(rsc_contact** contact);

/* Moves the tip sideways. The results remain those of the last level until the next one is
 * computed.
 *     contact: the contact;
 *     x0, y0: new position [length].
 * On a periodic surface (made from a spectrum, or heights declared periodic) any position: whole
 * periods do not count, and rsc_contact_tip returns the position within the surface's rectangle.
 * From the first move on contacts continue across the border of such a surface, half a period to
 * each side of the tip (elements: at least a quarter). On other surfaces a position above the
 * surface; for asperities from arrays without surface%L, no farther from them than the sphere's
 * radius. With solids%adhesion the state of attached asperities, or of elements that attract, is
 * followed while the tip moves on a straight line (the shortest one on a periodic surface) at the
 * last separation; the next level includes the jumps on this path. Near the edge of a body (a
 * punch) that attracts, the tip cannot be moved (-2).
 * Errors: -1 null; -2, -3 not finite; -2 a position outside a surface that is not periodic;
 *     RSC_NOT_CONVERGED (adhesion: the path is lost); the tip is then not moved; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_move_tip(rsc_contact* contact, double x0, double y0);

/* Stores the state for rsc_contact_rollback: the tip, the last level and the loading history
 * (solids%hardness, solids%adhesion). A new contact is committed when it is created. For codes that
 * try a step and may have to repeat it.
 *     contact: the contact.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_commit(rsc_contact* contact);

/* Restores the state of the last commit. The levels computed next equal, within the tolerance,
 * those computed directly after the commit.
 *     contact: the contact.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_rollback(rsc_contact* contact);

/* Position of the tip.
 *     contact: the contact;
 *     x0, y0 (out, may be null) [length].
 * Errors: -1 null. */
RSC_API int32_t rsc_contact_tip(const rsc_contact* contact, double* x0, double* y0);

/* The separation of first contact.
 *     contact: the contact;
 *     separation (out) [length].
 * Errors: -1 null, or no asperity under the sphere; -2 null. */
RSC_API int32_t rsc_contact_first_touch(const rsc_contact* contact, double* separation);

/* Computes the contact at a separation. The result depends, within the tolerance, on the bodies,
 * the place of the tip, the separation and, with solids%hardness, solids%relaxation_share or
 * solids%adhesion, the state left by the levels before, on nothing else: not on earlier calls nor
 * on the way of the tip. A level near the last one is computed faster; the last one itself is not
 * computed again, except with adhesion.
 *     contact: the contact;
 *     separation: Z0, height of the tip above z = 0 [length];
 *     force (out, may be null): N, 0 without contact [force].
 * Errors: -1 null; -2 not finite; RSC_NOT_CONVERGED, with the results of the last iterate,
 *     not-a-number if there is no state (with adhesion, or two flats deeper than asperities bear);
 *     RSC_NO_MEMORY, RSC_INTERNAL, after which the contact has no result. */
RSC_API int32_t rsc_contact_indent(rsc_contact* contact, double separation, double* force);

/* Sets the time of the following levels, for a body that relaxes (solids%relaxation_share; without
 * effect for others): between two levels the separation (rsc_contact_press: the force) changes
 * linearly with time, computed in up to 16 steps if the shortest relaxation time is not much
 * longer, and the first level is reached at once. The time is 0 initially, keeps its value until it
 * is set again, and is restored by rsc_contact_rollback.
 *     contact: the contact;
 *     time: t, not before that of the last level [time].
 * Errors: -1 null; -2 not finite, or before the last level. */
RSC_API int32_t rsc_contact_set_time(rsc_contact* contact, double time);

/* Sets the distance that has been slid at the following levels, for a body that wears
 * (solids%wear_coefficient; without effect for others): between two levels the separation
 * (rsc_contact_press: the force) changes linearly with it, in steps that are halved until the level
 * does not depend on them (rsc_contact_value, "sliding_error"), and the first level is reached
 * without sliding. Initially 0, kept and restored as the time of rsc_contact_set_time.
 *     contact: the contact;
 *     distance: s, not less than that of the last level [length].
 * Errors: -1 null; -2 not finite, or less than that of the last level. */
RSC_API int32_t rsc_contact_set_distance(rsc_contact* contact, double distance);

/* Finds the separation at which the sphere carries a force, and computes the contact there, to
 * solver%tolerance of the force (elements with adhesion: of the attraction, if that is larger).
 *     contact: the contact;
 *     force: N >= 0; 0 gives the separation of first touch [force];
 *     separation (out, may be null): Z0 [length].
 * With solids%adhesion N may be negative, and the level is the first one with this force on the
 * path from the last level, also for N = 0; if there is none, the result is the level of smallest
 * force, and the status is RSC_NOT_CONVERGED.
 * Errors: -1 null, or no asperity under the sphere; -2 negative or not finite; RSC_NOT_CONVERGED,
 *     also if the force jumps over N, with the results of the last iterate; RSC_NO_MEMORY,
 *     RSC_INTERNAL, after which the contact has no result. */
RSC_API int32_t rsc_contact_press(rsc_contact* contact, double force, double* separation);

/* The last level. All outputs may be null.
 *     contact: the contact;
 *     separation: Z0 [length];
 *     force: N = sum f [force];
 *     area: A = sum pi a^2, with elliptic spots the area of their union [length^2];
 *     contacts: number of asperities in contact.
 * Errors: -1 null; RSC_NO_RESULT, here and below also if the solver found no state;
 *     rsc_contact_level is available then, too. */
RSC_API int32_t rsc_contact_result(const rsc_contact* contact, double* separation, double* force,
                                   double* area, int64_t* contacts);

/* Status and solver data of the last level. All outputs may be null.
 *     contact: the contact;
 *     level_status: of RSC_LEVEL_LIST;
 *     candidates: number of asperities that the sphere would penetrate without interaction;
 *     iterations: of the solver, summed over all levels computed when pressing;
 *     overlapping_pairs: pairs of contact spots with d < a_i + a_j;
 *     residual: relative residual of F = f(<g0 - BF>).
 * Errors: -1 null; RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_level(const rsc_contact* contact, int32_t* level_status,
                                  int64_t* candidates, int64_t* iterations,
                                  int64_t* overlapping_pairs, double* residual);

/* The results of the last level in one call. All outputs may be null.
 *     contact: the contact;
 *     separation: Z0 [length];
 *     force: N [force];
 *     stiffness: dN/dZ0, negative, 0 without contact (takes one more solution of linear equations,
 *       unless null) [force/length];
 *     area: A [length^2];
 *     energy: W, dW/dZ0 = -N [force length];
 *     lateral_x, lateral_y: lateral force on the indenter at this separation, -dW/d(x0, y0), the
 *       sum of -f_i times the gradient of the indenter's face at contact i: for a sphere -sum f_i
 *       (x_i - x0)/sqrt(R^2 - rho_i^2) [force]. With the laws 'elliptic' and 'fourth_order' it
 *       leaves out that the curvature of the face above a summit changes as the tip moves: nothing
 *       for a paraboloid, for a sphere a share of (rho_i/R)^2;
 *     level_status: of RSC_LEVEL_LIST;
 *     contacts: number of contacts;
 *     overlapping_pairs: pairs that overlap;
 *     large_contacts: with a radius above a quarter of the mean spacing;
 *     beyond_law: outside the range of validity of the contact law;
 *     edge_contacts: within a mean spacing of the border of the surface.
 * All hold for the position of the tip when the level was computed.
 * Errors: -1 null; RSC_NO_RESULT, also if stiffness or energy is not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_answer(rsc_contact* contact, double* separation, double* force,
                                   double* stiffness, double* area, double* energy,
                                   double* lateral_x, double* lateral_y, int32_t* level_status,
                                   int64_t* contacts, int64_t* overlapping_pairs,
                                   int64_t* large_contacts, int64_t* beyond_law,
                                   int64_t* edge_contacts);

/* One quantity of the last level by its name in the result file: "force", "contact_area",
 * "contacts", "candidates", "iterations", "residual", "status", "products", "overlapping_pairs",
 * "large_contacts", "beyond_law", ... ; "separation", "stiffness", "energy", "conductance_length"
 * (2 |dN/dZ0|/E* at fixed contact areas), "lateral_force_x", "lateral_force_y", "moment_x",
 * "moment_y", "gap_mean", "percolates_x", "permeability_xx", "hydraulic_gap_x", ... (two flats by
 * elements), "resistance" (with solids%resistivity in the case the contact was made from). The
 * error message for an unknown name lists all names. "force_error_expected" and "area_error_expected", the
 * expected errors of N and A, exist for asperities, and for elements with adhesion. rsc_case_run
 * estimates the error of elements without adhesion from a second grid; a contact handle does not,
 * and its status does not include that error.
 *     contact: the contact;
 *     name: the name;
 *     value (out): its value.
 * Errors: -1, -3 null; -2 null or unknown; RSC_NO_RESULT, also if the value is not finite;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_value(rsc_contact* contact, const char* name, double* value);

/* dN/dZ0 of the last level, negative, 0 without contact; with solids%hardness that of unloading.
 * Costs one more solution of linear equations.
 *     contact: the contact;
 *     stiffness (out) [force/length].
 * Errors: -1, -2 null; RSC_NO_RESULT, also if the value is not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_stiffness(rsc_contact* contact, double* stiffness);

/* Elastic energy of the last level, W = sum W_i + F'BF/2, the work of the asperities and of their
 * interaction; dW/dZ0 = -N, so that kinetic plus elastic energy of a sphere moving on the surface
 * is conserved. Its error is of the order of the squared residual.
 *     contact: the contact;
 *     energy (out) [force length].
 * Errors: -1, -2 null; RSC_NO_RESULT, also if the value is not finite. */
RSC_API int32_t rsc_contact_energy(const rsc_contact* contact, double* energy);

/* The asperities of a contact, to which the indices of rsc_contact_spots refer: those it was
 * created from or, with law = 'elliptic' or 'fourth_order' on a surface, the summits of the
 * difference between surface and indenter for the present position of the tip.
 *     asperities (out): the handle, to be destroyed; a contact made from it uses them unchanged;
 *     contact: the contact.
 * Errors: -1 null address; -2 null, or a contact of elements. */
RSC_API int32_t rsc_contact_asperities(rsc_asperities** asperities, const rsc_contact* contact);

/* The contacts of the last level, by increasing index of asperity.
 *     contact: the contact;
 *     n: length of each array, at least the number of contacts (rsc_contact_result); the first ones
 *       are written;
 *     asperity (out, may be null): indices;
 *     force (out, may be null) [force];
 *     radius (out, may be null): contact radius a, the area being pi a^2 [length];
 *     penetration (out, may be null): of the asperity, interaction included [length].
 * Errors: -1 null; -2 too short; RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_spots(const rsc_contact* contact, int64_t n, int32_t* asperity,
                                  double* force, double* radius, double* penetration);

/* Force, radius and penetration of every asperity: 0 where there is no contact.
 *     contact: the contact;
 *     n: length of each array, the number of its asperities (rsc_contact_asperities);
 *     force, radius, penetration (out, may be null): as above.
 * Errors: -1 null; -2 n is not the number of asperities; RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_per_asperity(const rsc_contact* contact, int64_t n, double* force,
                                         double* radius, double* penetration);

/* Deflection of the surface by the contact forces, at any points: the sum over the contacts of the
 * displacement under and around a Hertz pressure of their force and area (Johnson 1985, section 3.4
 * and eq. 3.42), continuous everywhere: at distance d from the middle of a spot 3f/(8 E* a)(2 -
 * d^2/a^2) inside, 3f/(4 pi E* a) [(2 - d^2/a^2) asin(a/d) + sqrt(d^2/a^2 - 1)] outside, f/(pi E*
 * d) far away. In the solver spots interact as points; the effect of their finite size, some
 * a^2/(10 d^2), is included here only. With laws other than 'hertz' a spot is replaced by a circle
 * of the same area. With solids%adhesion f is the force at the same area without adhesion, and the
 * deflection by the tension is added: t/(2 E* a) inside, t/(pi E* a) asin(a/d) outside, for the
 * force t < 0 of the tension, or with a range that of Maugis's cohesive ring. Elements: the field
 * of the pressures and tensions of all pixels.
 *     contact: the contact;
 *     n: number of points, >= 0;
 *     x, y: places [length];
 *     deflection (out): positive down [length].
 * Errors: -1 null; -2 negative; -3, -4 null with n > 0, or not finite; -5 null with n > 0;
 *     RSC_NO_RESULT; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_deflection(const rsc_contact* contact, int64_t n, const double* x,
                                       const double* y, double* deflection);

/* ---- many contacts, and contacts saved in files ---------------------------------------------- */

/* rsc_contact_press for many contacts, in parallel. The results do not depend on the number of
 * threads.
 *     n: number of contacts, >= 0;
 *     contacts: different handles, which no other thread uses meanwhile;
 *     force: N >= 0 of each [force];
 *     separation (out, may be null): Z0 of each, unchanged where it failed [length];
 *     status (out, may be null): status of rsc_contact_press for each;
 *     threads: 1 or more, 0 for all of the machine.
 * Errors: -1, -6 out of range; -2 null, a null handle, or one given twice; -3 null with n > 0.
 *     Otherwise RSC_SUCCESS if all succeeded, or the status of the first that failed, negative ones
 *     as -2. */
RSC_API int32_t rsc_contacts_press(int64_t n, rsc_contact** contacts, const double* force,
                                   double* separation, int32_t* status, int32_t threads);

/* rsc_contact_indent for many contacts. Arguments and errors as above, with
 *     separation: Z0 of each [length];
 *     force (out, may be null): N of each [force]. */
RSC_API int32_t rsc_contacts_indent(int64_t n, rsc_contact** contacts, const double* separation,
                                    double* force, int32_t* status, int32_t threads);

/* A step of many contacts, in parallel: moves their tips, applies a separation or a force to each,
 * and returns the quantities that codes for moving bodies need. The results do not depend on the
 * number of threads.
 *     n: number of contacts, >= 0;
 *     contacts: different handles, which no other thread uses meanwhile;
 *     x0, y0: tips, both null to leave them [length];
 *     by_force: 1 where value is a force, 0 where it is a separation;
 *     value: of each [force] or [length].
 *     separation (out): Z0 of each [length];
 *     force (out): N of each [force];
 *     stiffness (out): dN/dZ0 [force/length] (costs one more solution of linear equations, unless
 *       null);
 *     lateral_x, lateral_y (out) [force], moment_x, moment_y (out) [force length]: as in
 *       rsc_contact_value;
 *     level_status (out): of RSC_LEVEL_LIST;
 *     status (out): of rsc_contact_move_tip, _indent or _press for each contact;
 *     threads: 1 or more, 0 for all of the machine.
 * Each output may be null; those of a contact that failed are unchanged, except for
 * RSC_NOT_CONVERGED.
 * Errors: -1, -5, -16 out of range; -2 null, a null handle, or one given twice; -3, -4 one null and
 *     the other not; -6 null with n > 0. Otherwise RSC_SUCCESS if all succeeded, or the status of
 *     the first that failed, negative ones as -2. */
RSC_API int32_t rsc_contacts_step(int64_t n, rsc_contact** contacts, const double* x0,
                                  const double* y0, int32_t by_force, const double* value,
                                  double* separation, double* force, double* stiffness,
                                  double* lateral_x, double* lateral_y, double* moment_x,
                                  double* moment_y, int32_t* level_status, int32_t* status,
                                  int32_t threads);

/* Saves a contact in a file: tip, options, the last level, the loading history (solids%hardness,
 * solids%adhesion) and the committed state, but neither the asperities nor the surface of elements.
 * The saved and the restored contact give the same results afterwards, bit for bit if elastic. To
 * this end earlier levels no longer serve as initial guesses after a save, so that results may
 * differ within the tolerance from those without a save. The file depends on the machine type;
 * later versions of the library can read it. It is written completely or not at all. An existing
 * file is replaced only if it is a save of rsc; links, devices, read-only and other files are left
 * as they are.
 *     contact: the contact;
 *     path: the file.
 * Errors: -1 null; -2 null or empty; RSC_FILE; RSC_NO_MEMORY; RSC_INTERNAL. */
RSC_API int32_t rsc_contact_save(rsc_contact* contact, const char* path);

/* Reads a contact from a file of rsc_contact_save.
 *     contact (out): the handle;
 *     asperities: those it was saved with, or ones equal to them bit for bit;
 *     path: the file.
 * Errors: -1, -2 null; -2 other asperities; -3 null, empty, no such file, or a file that is damaged
 *     or from a later version; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_restore(rsc_contact** contact, const rsc_asperities* asperities,
                                    const char* path);

/* ---- friction -------------------------------------------------------------------------------- */

/* m = 4 G* / E*, 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2, G = E/(2 (1 + nu)): the ratio of
 * tangential to normal stiffness of any contact of two bodies; 2 (1 - nu)/(2 - nu) for equal
 * materials.
 *     E: two Young's moduli [force/length^2];
 *     nu: two Poisson's ratios;
 *     ratio (out): m [1].
 * Errors: -1 null, a modulus not positive (Infinity: rigid), or two rigid bodies; -2 null, or
 *     outside [-1, 0.5]; -3 null. */
RSC_API int32_t rsc_stiffness_ratio(const double* E, const double* nu, double* ratio);

/* The former name of rsc_stiffness_ratio. */
RSC_API int32_t rsc_tangential_ratio(const double* E, const double* nu, double* ratio);

/* Friction for the asperities, sphere, tip and options of a contact, with an empty path.
 *     friction (out): the handle;
 *     contact: copied, may be destroyed at once;
 *     mu: coefficient of friction >= 0, finite;
 *     ratio: m > 0, finite (rsc_stiffness_ratio).
 * Errors: -1, -2 null; -2 not elastic; -3, -4 out of range; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_create(rsc_friction** friction, const rsc_contact* contact, double mu,
                                    double ratio);

/* As rsc_friction_create, with mu = solids%friction and the ratio from solids%E and solids%nu.
 *     friction (out): the handle;
 *     contact: as above;
 *     a_case: the case, null for the defaults (mu = 0).
 * Errors: -1, -2 null; -2 not elastic; -3 invalid keys; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_create_from_case(rsc_friction** friction, const rsc_contact* contact,
                                              const rsc_case* a_case);

/* A copy that is independent of the original, with its path.
 *     friction (out): the handle;
 *     original: the friction.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_copy(rsc_friction** friction, const rsc_friction* original);

/* Releases friction and nulls the handle.
 * Errors: -1 null address. */
RSC_API int32_t rsc_friction_destroy(rsc_friction** friction);

/* Moves the contact on a straight path to (separation, x, y) and returns the forces there. Costs
 * one level at the new separation, and one more if spots slip. The first call defines the start of
 * the path, where the contact is pressed without slide. Only differences of x and y matter; a slide without contact has
 * no effect.
 *     friction: the friction;
 *     separation: Z0;
 *     x, y: slide [length];
 *     force (out, may be null): N [force];
 *     force_x, force_y (out, may be null): tangential force Q [force], initially along the slide;
 *       the force on the sphere is -Q;
 *     lost (out, may be null): work lost to friction on this step, >= 0 [force length].
 * Errors: -1 null; -2, -3, -4 not finite; RSC_NOT_CONVERGED, with outputs of the last iterates;
 *     RSC_NO_MEMORY, RSC_INTERNAL. On failures other than RSC_NOT_CONVERGED the state is unchanged.
 */
RSC_API int32_t rsc_friction_update(rsc_friction* friction, double separation, double x, double y,
                                    double* force, double* force_x, double* force_y, double* lost);

/* Moves the tip at the separation of the last update, for a sphere that rolls onto other
 * asperities. Asperities in contact at both positions keep their share of Q: remembered
 * reversals of the slide keep their relative depth below first touch, and their deflections are multiplied by the fraction
 * of the force that these asperities carry. The excess tangential energy is counted as lost to
 * friction; no energy is gained. Without a path, or if the tip is already there, only the tip
 * changes. Costs as much as a level for each reversal of the slide that is remembered.
 *     friction: the friction;
 *     x0, y0: the new position [length], as in rsc_contact_move_tip.
 * Errors: -1 null; -2, -3 not finite; -2 outside; RSC_NOT_CONVERGED; RSC_NO_MEMORY, RSC_INTERNAL.
 *     On failures other than RSC_NOT_CONVERGED the state is unchanged. */
RSC_API int32_t rsc_friction_move_tip(rsc_friction* friction, double x0, double y0);

/* Tangential stiffness dQ/d(x, y) for a further slide at this separation in the present direction
 * of slip (S m in all directions if nothing slips, and for a reversed slide; S = -dN/dZ0). Costs at
 * most as much as one level. All outputs may be null.
 *     friction: the friction;
 *     xx, xy, yx, yy: dQ_x/dx, dQ_x/dy, dQ_y/dx, dQ_y/dy [force/length], 0 without contact.
 * Errors: -1 null; RSC_NOT_CONVERGED; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_stiffness(rsc_friction* friction, double* xx, double* xy, double* yx,
                                       double* yy);

/* State of the path after the last update. All outputs may be null.
 *     friction: the friction;
 *     separation, x, y: of the last update [length];
 *     force: N;
 *     force_x, force_y: Q [force];
 *     energy: elastic energy W of the normal problem;
 *     tangential_energy: elastic energy of the slide;
 *     lost: work lost to friction since the start of the path [force length];
 *     stick_separation: separation at which the contact area would equal the present stick area:
 *       separation itself if all spots stick, that of first touch if all slip [length].
 * Errors: -1 null; RSC_NO_RESULT before the first update. */
RSC_API int32_t rsc_friction_state(const rsc_friction* friction, double* separation, double* x,
                                   double* y, double* force, double* force_x, double* force_y,
                                   double* energy, double* tangential_energy, double* lost,
                                   double* stick_separation);

/* Stores the state for rsc_friction_rollback. The committed state of a new object is an empty path.
 *     friction: the friction.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_commit(rsc_friction* friction);

/* Restores the state of the last commit.
 *     friction: the friction.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_rollback(rsc_friction* friction);

/* First loading at the separation of the last update: tangential forces of a contact that is
 * pressed there and then slid. The path of the friction is not changed. Q = mu [N(Z0) - N(Z0')],
 * slide = (mu/m) (Z0' - Z0). Costs as much as a level for each slide below full slip.
 *     friction: the friction;
 *     n: length of the arrays, >= 0;
 *     slide: >= 0 [length];
 *     force (out): Q [force];
 *     stick_separation (out, may be null): Z0' [length].
 * Errors: -1 null; -2 negative; -3 null with n > 0, negative or not finite; -4 null with n > 0;
 *     RSC_NO_RESULT before the first update and without contact; RSC_NOT_CONVERGED; RSC_NO_MEMORY.
 */
RSC_API int32_t rsc_friction_first_loading(rsc_friction* friction, int64_t n, const double* slide,
                                           double* force, double* stick_separation);

/* The slide of first loading at which the tangential force is Q.
 *     friction: the friction;
 *     force: 0 <= Q <= mu N [force];
 *     slide (out) [length].
 * Errors: -1 null; -2 out of range; -3 null; RSC_NO_RESULT before the first update and without
 *     contact; RSC_NOT_CONVERGED; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_slide(rsc_friction* friction, double force, double* slide);

/* Full slip in first loading at the separation of the last update. Both outputs may be null.
 *     friction: the friction;
 *     slide: at which it begins [length];
 *     force: mu N [force].
 * Errors: -1 null; RSC_NO_RESULT before the first update and without contact. */
RSC_API int32_t rsc_friction_full_slip(const rsc_friction* friction, double* slide, double* force);

/* Friction at the spots of the last update, by increasing index of asperity. Costs as much as a
 * level for each reversal of the slide that is remembered. The number is written even if the arrays are too short.
 *     friction: the friction;
 *     n: length of each array;
 *     count (out, may be null): number of spots;
 *     asperity (out, may be null): indices;
 *     radius (out, may be null): contact radius [length];
 *     stick_radius (out, may be null): of the part that sticks, 0 if the whole spot slips [length];
 *     force_x, force_y (out, may be null): the spot's share of Q [force].
 * Errors: -1 null; -2 too short; RSC_NO_RESULT before the first update; RSC_NOT_CONVERGED;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_spots(rsc_friction* friction, int64_t n, int64_t* count,
                                   int32_t* asperity, double* radius, double* stick_radius,
                                   double* force_x, double* force_y);

/* Saves friction with its path and the committed state in a file, as rsc_contact_save does.
 *     friction: the friction;
 *     path: the file.
 * Errors: -1 null; -2 null or empty; RSC_FILE; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_save(rsc_friction* friction, const char* path);

/* Reads friction from a file of rsc_friction_save.
 *     friction (out): the handle;
 *     asperities, path and errors: as in rsc_contact_restore. */
RSC_API int32_t rsc_friction_restore(rsc_friction** friction, const rsc_asperities* asperities,
                                     const char* path);

#ifdef __cplusplus
}
#endif

#endif /* RSC_H */
