/* rsc: the elastic contact of rough surfaces. The complete C interface.
 *
 * The asperity model is that of V. A. Yastrebov, "The Elastic Contact of Rough Spheres Investigated
 * Using a Deterministic Multi-Asperity Model", J. Multiscale Modelling, 2018.
 *
 * Order of use
 *     rsc_surface (heights) -> rsc_asperities (its summits) -> rsc_contact (a sphere on them)
 *     rsc_case holds all options, under their namelist names; functions that depend on options take
 *     one as an argument. Surfaces and asperities may also come from your own arrays:
 *     rsc_surface_take, rsc_asperities_take.
 * Terms
 *     Tip: lowest point of the sphere. Separation Z0: its height above z = 0. Level: the contact at
 *     one separation or force. Latest level: the one computed most recently. Loading history: what
 *     bodies with solids%hardness, relaxation_share, wear_coefficient or adhesion retain of earlier
 *     levels.
 * Units
 *     Any consistent set: lengths, forces, moduli in force/length^2, energies in force length.
 * Status
 *     Every function returns an int32_t: 0 on success; -i if argument number i (counted from 1) is
 *     wrong; or a positive value of RSC_STATUS_LIST. If an option of a case is wrong, i is the
 *     number of the case argument. rsc_message returns the error message. No function ends the
 *     program, prints, or throws a C++ exception.
 * After a failure
 *     Output arguments keep their values, with two exceptions: a constructor sets its handle to
 *     null, and after RSC_NOT_CONVERGED all outputs are nevertheless written (see
 *     rsc_contact_indent). Handles remain usable.
 * Handles
 *     Constructors (_create, _copy, _synthesize, _find, _make, _take, _restore, ...) create them.
 *     _destroy takes the address of a handle, frees the object and sets the handle to null;
 *     destroying a null handle is not an error. A constructor overwrites the handle it is given, so
 *     destroy the old object first. Objects own copies of all arrays they were made from; a surface
 *     or a case may be destroyed while objects made from it are in use.
 * Threads
 *     Different threads may use different handles at the same time. Several threads may pass the
 *     same handle to functions that take it as a pointer to const. NetCDF, HDF5 and the FFTW
 *     planner are not thread-safe: rsc calls them under one global lock, and programs that call
 *     these libraries themselves must take the same lock, rsc_lock. After a fork the child may use
 *     its copies of the handles, except those that another thread was using in a call at the fork,
 *     whose state is unknown: only the caller can know which. The child computes with one thread.
 *     See "rsc inside your program" in modules/README.
 * Numbers
 *     Numbers in arrays, and the parameters of a grid, a sphere or a material, must be finite and
 *     at most 1e50 in magnitude; quantities that must be positive must be at least 1e-50. Beyond
 *     these limits their squares and powers would overflow or vanish. "Not finite" and "not
 *     positive" include these limits.
 * Arrays
 *     The caller allocates them and passes their length; indices count from 0. Outputs marked "may
 *     be null" may be passed as NULL if they are not needed. Two-dimensional arrays are stored with
 *     x running fastest: z[j*nx + i] is the height at (x0 + i dx, y0 + j dy).
 * Text
 *     Input is a null-terminated string. Output is written to the caller's buffer: at most size-1
 *     characters, always followed by a null character. *length receives the full length without it;
 *     if length >= size, the text was truncated. The buffer may be null if size is 0; length may be
 *     null.
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

/* Status codes: name, value, meaning. A value -i means that argument i is wrong. */
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

/* Status of a computed level (rsc_contact_level). If several apply, the level has the first of
 * not converged, out of validity, not unique, overlapping. The variable `status` of a result file
 * has the same values. */
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

typedef struct rsc_case rsc_case;             /* options: all keys and their values */
typedef struct rsc_surface rsc_surface;       /* heights on a regular grid */
typedef struct rsc_asperities rsc_asperities; /* summits: positions and radii */
typedef struct rsc_contact rsc_contact;       /* an indenter on asperities, with its latest level */
typedef struct rsc_friction rsc_friction;     /* a contact with friction, and its loading path */

/* ---- version and messages -------------------------------------------------------------------- */

/* The version of this header. At run time rsc_version returns the version of the library. */
#define RSC_VERSION_MAJOR 0
#define RSC_VERSION_MINOR 4
#define RSC_VERSION_PATCH 0

/* The version of the library, "major.minor.patch".
 *     buffer, size, length: text output.
 * Errors: -1 buffer null with size > 0; -2 size < 0. */
RSC_API int32_t rsc_version(char* buffer, int64_t size, int64_t* length);

/* The error message of the most recent failed call in this thread; empty if no call has failed.
 * Successful calls, including this one, leave it unchanged.
 *     buffer, size, length: text output.
 * Errors: -1 buffer null with size > 0; -2 size < 0. */
RSC_API int32_t rsc_message(char* buffer, int64_t size, int64_t* length);

/* The general meaning of a status code; any value of status is allowed.
 *     buffer, size, length: text output.
 * Errors: -2 buffer null with size > 0; -3 size < 0. */
RSC_API int32_t rsc_status_text(int32_t status, char* buffer, int64_t size, int64_t* length);

/* ---- cases: options by name ------------------------------------------------------------------ */

/* Creates a case with all keys at their defaults.
 *     new_case (out): the handle.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_create(rsc_case** new_case);

/* Creates an independent copy of a case.
 *     new_case (out): the handle;
 *     original: the case to copy.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_copy(rsc_case** new_case, const rsc_case* original);

/* Frees a case and sets its handle to null.
 * Errors: -1 null address. */
RSC_API int32_t rsc_case_destroy(rsc_case** old_case);

/* Sets all keys from namelist text; keys not in the text get their defaults.
 *     a_case: the case;
 *     text: namelist input as for the program, but without &study.
 * Errors: -1, -2 null; -2 errors in the text (one line of the message for each); RSC_NO_MEMORY.
 *     On failure the case is unchanged. */
RSC_API int32_t rsc_case_read(rsc_case* a_case, const char* text);

/* Sets all keys from a namelist file, like rsc_case_read.
 *     a_case: the case;
 *     path: the file.
 * Errors: -1, -2 null; -2 if the file cannot be read or its text has errors; RSC_NO_MEMORY. On
 *     failure the case is unchanged. */
RSC_API int32_t rsc_case_read_file(rsc_case* a_case, const char* path);

/* Sets one key.
 *     a_case: the case;
 *     name: "group%key", "group%key(2)" or "group%key(1:2)", in upper or lower case;
 *     value: in namelist syntax (strings in quotes).
 * For a key with a fixed number of values (solids%E has two), give all of them, "1e5, 2e5", or use
 * a subscript to set one. An empty value restores the default.
 * Errors: -1 null; -2 null or unknown name; -3 null or an invalid value; RSC_NO_MEMORY. On failure
 *     the case is unchanged. Relations between keys are checked only when the case is used. */
RSC_API int32_t rsc_case_set(rsc_case* a_case, const char* name, const char* value);

/* The value of one key in namelist syntax, as rsc_case_set accepts it; empty if the key is not set.
 *     a_case: the case;
 *     name: as in rsc_case_set;
 *     buffer, size, length: text output.
 * Errors: -1 null; -2 null or unknown name; -3 buffer null with size > 0; -4 size < 0;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_get(const rsc_case* a_case, const char* name, char* buffer, int64_t size,
                             int64_t* length);

/* All keys and their values as namelist text. If rsc_case_read accepts this text, it restores the
 * same values.
 *     a_case: the case;
 *     buffer, size, length: text output.
 * Errors: -1 null; -2 buffer null with size > 0; -3 size < 0; RSC_NO_MEMORY. */
RSC_API int32_t rsc_case_text(const rsc_case* a_case, char* buffer, int64_t size, int64_t* length);

/* Number of keys.
 *     count (out): the number.
 * Errors: -1 null. */
RSC_API int32_t rsc_key_count(int64_t* count);

/* The name, "group%key", of the key with number `key`, so that a program can list all keys.
 *     key: 0 to count-1;
 *     buffer, size, length: text output.
 * Errors: -1 out of range; -2 buffer null with size > 0; -3 size < 0. */
RSC_API int32_t rsc_key_name(int64_t key, char* buffer, int64_t size, int64_t* length);

/* Runs the case as the program does, and writes the result file (output%file, relative to the
 * working directory). Prints nothing.
 *     a_case: the case;
 *     failed_levels (out, may be null): number of levels that did not converge.
 * Errors: -1 null, an invalid case or an unusable input file; RSC_NOT_CONVERGED if failed_levels >
 *     0 (the result file is still written); RSC_FILE; RSC_NO_MEMORY. After any other failure there
 *     is no result file, but a campaign leaves its checkpoint for rsc_case_resume. */
RSC_API int32_t rsc_case_run(const rsc_case* a_case, int64_t* failed_levels);

/* Callback during the run of a case.
 *     done, total: number of levels (or realizations, if there are several) computed so far, and
 *       their total number;
 *     data: the pointer given to rsc_case_run_watched.
 * Returns 0 to continue, any other value to stop. It is called in the thread that called
 * rsc_case_run_watched, about ten times a second, or less often while a large surface is generated
 * or a map is read. It must not throw an exception or call longjmp. */
typedef int32_t (*rsc_watch)(double done, double total, void* data);

/* Like rsc_case_run, with a callback that receives the progress and may stop the run.
 *     a_case: the case;
 *     watch: the callback, or null;
 *     data: passed to the callback;
 *     failed_levels (out, may be null): number of levels that did not converge.
 * Errors: as rsc_case_run; RSC_STOPPED if the callback stopped the run: there is no result file,
 *     but a campaign leaves its checkpoint for rsc_case_resume. */
RSC_API int32_t rsc_case_run_watched(const rsc_case* a_case, rsc_watch watch, void* data,
                                     int64_t* failed_levels);

/* Continues an interrupted campaign from its checkpoint, or adds realizations to a finished one,
 * like the program with --resume. The result file is the same as that of an uninterrupted run. A
 * case without checkpoint or result is run from the start.
 *     a_case, watch, data, failed_levels (out, may be null): as in rsc_case_run_watched.
 * Errors: as rsc_case_run_watched. */
RSC_API int32_t rsc_case_resume(const rsc_case* a_case, rsc_watch watch, void* data,
                                int64_t* failed_levels);

/* Takes the lock under which rsc calls NetCDF, HDF5 and the FFTW planner. Call it before using
 * these libraries yourself if another thread may be running rsc. Waits until no other thread holds
 * the lock. A thread that holds it may call rsc and take it again; it must release it as often as
 * it took it. Hold it as briefly as possible, because other threads in rsc wait for it. Afterwards
 * HDF5 prints no messages in this thread. */
RSC_API int32_t rsc_lock(void);

/* Releases the lock.
 * Errors: RSC_NO_RESULT if this thread does not hold it. */
RSC_API int32_t rsc_unlock(void);

/* ---- surfaces -------------------------------------------------------------------------------- */

/* Generates or reads the surface described by &surface, as the program does. source = 'synthetic'
 * or 'spectrum': a random surface from the keys of &surface and run%seed, identical to realization
 * number `realization` of the program for any number of threads (run%threads). Its heights are
 * periodic, at x = i L/n, y = j L/n (with a free boundary a contact uses only one period). source =
 * 'heights': the map in surface%file, converted to run%length_unit, with missing points, form and
 * noise treated according to the keys of &surface.
 *     surface (out): the handle;
 *     a_case: the case, null for the defaults;
 *     realization: any integer; if surface%file has wildcards, the number of the file, from 1; no
 *       effect on a single file.
 * Errors: -1 null; -2 invalid keys of &surface or &run, an unusable file, or a source without
 *     heights ('asperities': use rsc_asperities_make); RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_synthesize(rsc_surface** surface, const rsc_case* a_case,
                                       int64_t realization);

/* Creates a surface from an array of heights, which is copied. Separations are measured from z = 0;
 * rsc_surface_detrend can move the mean plane there.
 *     surface (out): the handle;
 *     nx, ny: numbers of points, 3 or more;
 *     dx, dy: grid steps > 0 [length];
 *     x0, y0: position of the first point [length];
 *     periodic: 1 for a periodic surface, 0 otherwise (then its outermost points are not treated as
 *       summits);
 *     heights: nx*ny values, x fastest, finite [length].
 * Errors: -1 null; -2, -3 less than 3, or more than 2^31-1; -4, -5 not positive or not finite; -6,
 *     -7 not finite; -8 neither 0 nor 1; -9 null, or a height that is not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_take(rsc_surface** surface, int64_t nx, int64_t ny, double dx,
                                 double dy, double x0, double y0, int32_t periodic,
                                 const double* heights);

/* Creates an independent copy of a surface.
 *     surface (out): the handle;
 *     original: the surface to copy.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_copy(rsc_surface** surface, const rsc_surface* original);

/* Frees a surface and sets its handle to null.
 * Errors: -1 null address. */
RSC_API int32_t rsc_surface_destroy(rsc_surface** surface);

/* Subtracts a form fitted by least squares. No other thread may use the surface during the call.
 *     surface: the surface;
 *     how: "none", "mean", "plane", "quadratic" or "sphere";
 *     rms (out, may be null): remaining rms height about the mean [length].
 * Errors: -1 null; -2 null, another word, or a sphere that cannot be fitted. */
RSC_API int32_t rsc_surface_detrend(rsc_surface* surface, const char* how, double* rms);

/* Applies the Gaussian low-pass filter of ISO 16610-61: waves of length lambda are multiplied by
 * exp(-pi (alpha cutoff/lambda)^2), alpha = sqrt(ln 2/pi). A surface that is not periodic is
 * extended by reflection at its border. No other thread may use the surface during the call.
 *     surface: the surface;
 *     cutoff: > 0 [length].
 * Errors: -1 null; -2 not positive or not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_surface_filter(rsc_surface* surface, double cutoff);

/* The grid of a surface. All outputs may be null.
 *     surface: the surface;
 *     nx, ny: numbers of points;
 *     dx, dy: grid steps [length];
 *     x0, y0: position of the first point [length];
 *     periodic: 1 or 0.
 * Errors: -1 null. */
RSC_API int32_t rsc_surface_grid(const rsc_surface* surface, int64_t* nx, int64_t* ny, double* dx,
                                 double* dy, double* x0, double* y0, int32_t* periodic);

/* The heights of a surface.
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

/* Finds the summits of a surface: points higher than their 8 neighbours. Their curvatures are
 * computed from second differences.
 *     asperities (out): the handle;
 *     surface: the surface;
 *     a_case: the case (asperities%curvature defines the radius), null for the defaults
 *         and solver%model = 'asperities'.
 * With an asperities%law other than 'hertz', summits are located between grid points, and
 * curvatures and biharmonic are computed from wider stencils.
 * With solver%model = 'elements' in the case, or 'auto' (the default) where this chooses elements,
 * the handle holds a copy of the whole surface and no asperities; contacts created from it with
 * such a case are solved by boundary elements. Their spots are groups of edge-connected pixels; in
 * place of an asperity index, rsc_contact_spots returns the index (row*nx + column, from 0) of each
 * spot's highest-pressure pixel.
 * Errors: -1 null; -2 null, a surface without summits, or (with a law other than 'hertz') one
 *     synthesized with fewer than 4 points per lambda_s, for which rsc_asperities_make must be
 *     used; RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_find(rsc_asperities** asperities, const rsc_surface* surface,
                                    const rsc_case* a_case);

/* Creates the asperities given by surface%source, as the program does: the summits of the surface
 * that rsc_surface_synthesize would create, or the list in surface%file. A synthetic surface is not
 * stored: this is faster, takes half the memory and allows any grid for every asperities%law. With
 * solver%model = 'elements': the points of the surface on the grid of elements%points_per_wave.
 * 'auto' means what it means for the program: mostly elements. Ask for 'asperities' where summits
 * are needed.
 *     asperities (out): the handle;
 *     a_case: the case, null for the defaults;
 *     realization: as in rsc_surface_synthesize; no effect on a list of asperities.
 * Errors: -1 null; -2 invalid keys of &surface, &asperities or &run, or an unusable file;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_make(rsc_asperities** asperities, const rsc_case* a_case,
                                    int64_t realization);

/* Creates asperities from arrays, which are copied.
 *     asperities (out): the handle;
 *     n: number of asperities, 1 to 2^31-1;
 *     x, y, z: positions of the summits [length];
 *     radius: > 0 [length];
 *     kappa1, kappa2: principal curvatures, kappa1 >= kappa2 > 0 [1/length], and angle: direction
 *       of the kappa2 axis from x [rad], all three or none of them (null);
 *     biharmonic: nabla^4 z at the summit [1/length^3], or null.
 * Contact laws (asperities%law) that need curvatures or biharmonic reject asperities without them.
 * Errors: -1 null; -2 out of range; -3 to -10 null for a required array, a value that is not finite
 *     or, where required, not positive, or two summits at the same (x, y) (-3); RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_take(rsc_asperities** asperities, int64_t n, const double* x,
                                    const double* y, const double* z, const double* radius,
                                    const double* kappa1, const double* kappa2, const double* angle,
                                    const double* biharmonic);

/* Creates another handle to the same asperities. Asperities never change, so they are stored only
 * once.
 *     asperities (out): the handle;
 *     original: the asperities.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_asperities_copy(rsc_asperities** asperities, const rsc_asperities* original);

/* Frees asperities and sets their handle to null.
 * Errors: -1 null address. */
RSC_API int32_t rsc_asperities_destroy(rsc_asperities** asperities);

/* Number of asperities.
 *     asperities: the asperities;
 *     n (out): the number.
 * Errors: -1, -2 null. */
RSC_API int32_t rsc_asperities_count(const rsc_asperities* asperities, int64_t* n);

/* Positions and radii of the asperities.
 *     asperities: the asperities;
 *     n: length of each array, the number of asperities;
 *     x, y, z, radius (out, may be null) [length].
 * Errors: -1 null; -2 n is not the number of asperities. */
RSC_API int32_t rsc_asperities_get(const rsc_asperities* asperities, int64_t n, double* x,
                                   double* y, double* z, double* radius);

/* Curvatures of the asperities.
 *     asperities: the asperities;
 *     n: length of each array, the number of asperities;
 *     kappa1, kappa2 (out, may be null) [1/length];
 *     angle (out, may be null) [rad].
 * Errors: -1 null, or asperities created without curvatures; -2 n is not the number of asperities.
 */
RSC_API int32_t rsc_asperities_curvatures(const rsc_asperities* asperities, int64_t n,
                                          double* kappa1, double* kappa2, double* angle);

/* ---- contact --------------------------------------------------------------------------------- */

/* Creates the contact of a smooth rigid sphere with asperities on an elastic half-space: the
 * equivalent problem of two bodies, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, 1/R = 1/R1 + 1/R2. It
 * has no result yet.
 *     contact (out): the handle;
 *     asperities: shared; their handle may be destroyed at once;
 *     E_star: E* > 0, finite [force/length^2];
 *     R: radius > 0, Infinity for a flat [length];
 *     x0, y0: position of the tip [length];
 *     a_case: null for the defaults; otherwise these keys apply: &solver, asperities%law,
 *       indentation%selection, indentation%selection_factor; surface%sigma as the rms height
 *       (default: that of the surface, or of the summit heights of asperities from arrays); and,
 *       for asperities from arrays, surface%L as the side of their square surface, which determines
 *       their mean spacing (default: the smallest square that contains them).
 * Errors: -1, -2 null; -3, -4 out of range; -5, -6 not finite; -7 invalid keys; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_create(rsc_contact** contact, const rsc_asperities* asperities,
                                   double E_star, double R, double x0, double y0,
                                   const rsc_case* a_case);

/* Like rsc_contact_create, with E* and R from the keys of &solids and the tip at
 * indentation%centre. By default this is the middle of the surface (for asperities from arrays: of
 * [0, surface%L]^2 if it contains them, otherwise of the smallest rectangle that contains them).
 *     contact (out): the handle;
 *     asperities: as in rsc_contact_create;
 *     a_case: the case, null for the defaults.
 * Errors: -1, -2 null; -3 invalid keys; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_create_from_case(rsc_contact** contact,
                                             const rsc_asperities* asperities,
                                             const rsc_case* a_case);

/* Creates an independent copy of a contact, including its latest level, loading history and
 * committed state. The same calls on both give the same results, bit for bit.
 *     contact (out): the handle;
 *     original: the contact; meanwhile other threads may call only functions that take it as a
 *       pointer to const.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_copy(rsc_contact** contact, const rsc_contact* original);

/* Frees a contact and sets its handle to null.
 * Errors: -1 null address. */
RSC_API int32_t rsc_contact_destroy(rsc_contact** contact);

/* Moves the tip sideways. The results remain those of the latest level until another level is
 * computed.
 *     contact: the contact;
 *     x0, y0: new position [length].
 * On a periodic surface (generated from a spectrum, or made from heights declared periodic) any
 * position is allowed, and rsc_contact_tip returns the equivalent position within the surface's
 * rectangle. Once the tip has been moved, contacts continue across the border of such a surface,
 * half a period to each side of the tip (elements: at least a quarter). On other surfaces the tip
 * must be above the surface or, for asperities from arrays without surface%L, no farther from them
 * than the sphere's radius.
 * With solids%adhesion, attached asperities (or attracting elements) are followed while the tip
 * moves in a straight line (the shortest one on a periodic surface) at the latest separation; the
 * next level includes the jumps on this path. An indenter with an edge, such as a punch, cannot be
 * moved while asperities or elements near its edge attract (-2).
 * Errors: -1 null; -2, -3 not finite; -2 a position outside a surface that is not periodic;
 *     RSC_NOT_CONVERGED if, with adhesion, the path cannot be followed (the tip is then not moved);
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_move_tip(rsc_contact* contact, double x0, double y0);

/* Stores the state for rsc_contact_rollback: the tip, the latest level, the loading history, and
 * the time or distance that was set. Use it in codes that may have to repeat a step. The initial
 * state of a new contact counts as committed.
 *     contact: the contact.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_commit(rsc_contact* contact);

/* Restores the last committed state. Results afterwards equal, bit for bit, those of the same calls
 * directly after the commit.
 *     contact: the contact.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_rollback(rsc_contact* contact);

/* Position of the tip.
 *     contact: the contact;
 *     x0, y0 (out, may be null) [length].
 * Errors: -1 null. */
RSC_API int32_t rsc_contact_tip(const rsc_contact* contact, double* x0, double* y0);

/* The separation at first contact.
 *     contact: the contact;
 *     separation (out) [length].
 * Errors: -1 null, or no asperity under the sphere; -2 null. */
RSC_API int32_t rsc_contact_first_touch(const rsc_contact* contact, double* separation);

/* Computes the contact at a given separation. Within the tolerance, the result depends only on the
 * bodies, the position of the tip, the separation and the loading history, if there is one. Apart
 * from that, earlier calls and the path of the tip have no effect. A level close to the latest one
 * is computed faster; the latest one itself is not computed again, except with adhesion.
 *     contact: the contact;
 *     separation: Z0, height of the tip above z = 0 [length];
 *     force (out, may be null): N, 0 without contact [force].
 * Errors: -1 null; -2 not finite; RSC_NOT_CONVERGED, with the results of the last iterate, or NaN
 *     if the solver found no equilibrium (with adhesion, or if two flats are pressed too far
 *     together for the asperity model); RSC_NO_MEMORY, RSC_INTERNAL, after which the contact has no
 *     result. */
RSC_API int32_t rsc_contact_indent(rsc_contact* contact, double separation, double* force);

/* Sets the time for subsequent levels. Affects only bodies that relax (solids%relaxation_share).
 * Between two levels the separation (in rsc_contact_press, the force) varies linearly with time;
 * the interval is integrated in 16 steps, or fewer if the interval is shorter than the shortest
 * relaxation time. The first level is reached instantaneously. The time is initially 0, keeps its
 * value until it is set again, and is restored by rsc_contact_rollback.
 *     contact: the contact;
 *     time: t, not before that of the latest level [time].
 * Errors: -1 null; -2 not finite, or before the latest level. */
RSC_API int32_t rsc_contact_set_time(rsc_contact* contact, double time);

/* Sets the cumulative sliding distance for subsequent levels. Affects only bodies with wear
 * (solids%wear_coefficient). The interval between two levels is divided into steps, over which the
 * separation (in rsc_contact_press, the force) varies linearly with the distance; the steps are
 * halved, at most seven times, until the result changes by less than 0.2 % (rsc_contact_value,
 * "sliding_error"). The first level is reached without sliding. The distance is initially 0, keeps
 * its value until it is set again, and is restored by rsc_contact_rollback, like the time of
 * rsc_contact_set_time.
 *     contact: the contact;
 *     distance: s, not less than that of the latest level [length].
 * Errors: -1 null; -2 not finite, or less than that of the latest level. */
RSC_API int32_t rsc_contact_set_distance(rsc_contact* contact, double distance);

/* Finds the separation at which the sphere carries the given force, to a relative tolerance
 * solver%tolerance (elements with adhesion: relative to the attractive force, if larger), and
 * computes the contact there.
 *     contact: the contact;
 *     force: N >= 0; 0 gives the separation at first contact [force];
 *     separation (out, may be null): Z0 [length].
 * With solids%adhesion N may be negative, and the result, also for N = 0, is the first level with
 * this force on the path from the latest level. If there is none, the level of smallest force is
 * returned, with status RSC_NOT_CONVERGED.
 * Errors: -1 null, or no asperity under the sphere; -2 negative or not finite; RSC_NOT_CONVERGED,
 *     with the results of the last iterate, also if N(Z0) jumps past this force; RSC_NO_MEMORY,
 *     RSC_INTERNAL, after which the contact has no result. */
RSC_API int32_t rsc_contact_press(rsc_contact* contact, double force, double* separation);

/* Separation, force, area and number of contacts of the latest level. All outputs may be null.
 *     contact: the contact;
 *     separation: Z0 [length];
 *     force: N = sum f [force];
 *     area: A = sum pi a^2; with elliptic spots the area of their union [length^2];
 *     contacts: number of asperities in contact.
 * Errors: -1 null; RSC_NO_RESULT if no level has been computed or the solver found no equilibrium.
 *     This applies to all contact functions below; but without equilibrium, rsc_contact_level and
 *     rsc_contact_value still return status and solver data. */
RSC_API int32_t rsc_contact_result(const rsc_contact* contact, double* separation, double* force,
                                   double* area, int64_t* contacts);

/* Status and solver data of the latest level. All outputs may be null.
 *     contact: the contact;
 *     level_status: a value of RSC_LEVEL_LIST;
 *     candidates: number of asperities that the sphere would penetrate without interaction;
 *     iterations: solver iterations, in rsc_contact_press summed over all levels it computed;
 *     overlapping_pairs: pairs of contact spots with d < a_i + a_j;
 *     residual: relative residual of F = f(<g0 - BF>).
 * Errors: -1 null; RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_level(const rsc_contact* contact, int32_t* level_status,
                                  int64_t* candidates, int64_t* iterations,
                                  int64_t* overlapping_pairs, double* residual);

/* The main results of the latest level in one call. All outputs may be null.
 *     contact: the contact;
 *     separation: Z0 [length];
 *     force: N [force];
 *     stiffness: dN/dZ0, negative, 0 without contact (costs one more solution of linear equations,
 *       unless null) [force/length];
 *     area: A [length^2];
 *     energy: W, dW/dZ0 = -N [force length];
 *     lateral_x, lateral_y: lateral force on the indenter at this separation, -dW/d(x0, y0), the
 *       sum of -f_i times the gradient of the indenter's surface at contact i: for a sphere -sum
 *       f_i (x_i - x0)/sqrt(R^2 - rho_i^2) [force]. With the laws 'elliptic' and 'fourth_order' it
 *       neglects that the indenter's curvature above a summit changes as the tip moves: no error
 *       for a paraboloid, and a relative error of order (rho_i/R)^2 for a sphere;
 *     level_status: a value of RSC_LEVEL_LIST;
 *     contacts: number of contacts;
 *     overlapping_pairs: pairs of contact spots that overlap;
 *     large_contacts: contacts with a radius above a quarter of the mean spacing;
 *     beyond_law: contacts outside the range of validity of the contact law;
 *     edge_contacts: contacts within a mean spacing of the border of the surface.
 * All values refer to the tip position at which the level was computed.
 * Errors: -1 null; RSC_NO_RESULT, also if stiffness or energy is not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_answer(rsc_contact* contact, double* separation, double* force,
                                   double* stiffness, double* area, double* energy,
                                   double* lateral_x, double* lateral_y, int32_t* level_status,
                                   int64_t* contacts, int64_t* overlapping_pairs,
                                   int64_t* large_contacts, int64_t* beyond_law,
                                   int64_t* edge_contacts);

/* One quantity of the latest level, by its name in the result file: "force", "contact_area",
 * "contacts", "candidates", "iterations", "residual", "status", "products", "overlapping_pairs",
 * "large_contacts", "beyond_law", ... ; "separation", "stiffness", "energy", "conductance_length"
 * (2 |dN/dZ0|/E* at fixed contact areas), "lateral_force_x", "lateral_force_y", "moment_x",
 * "moment_y", "gap_mean", "percolates_x", "permeability_xx", "hydraulic_gap_x", ... (two flats
 * solved by elements), "resistance" (if solids%resistivity is set in the case of the contact). The
 * error message for an unknown name lists all names.
 * The expected errors of N and A are "force_error_expected" and "area_error_expected", under a
 * prescribed force "separation_error_expected"; those of other quantities: rsc_contact_error.
 *     contact: the contact;
 *     name: the name;
 *     value (out): its value.
 * Errors: -1, -3 null; -2 null or unknown; RSC_NO_RESULT, also if the value is not finite;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_value(rsc_contact* contact, const char* name, double* value);

/* The expected error of a quantity of the latest level, which is not exceeded in nine of ten cases.
 * It is relative, except for "separation", whose error is a length.
 *     contact: the contact;
 *     name: as in rsc_contact_value;
 *     error (out): the error.
 * Errors: -1, -3 null; -2 null or unknown; RSC_NO_RESULT, also if no error of it is stated;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_error(const rsc_contact* contact, const char* name, double* error);

/* dN/dZ0 of the latest level: negative, or 0 without contact; with solids%hardness, the unloading
 * stiffness. Costs one more solution of linear equations.
 *     contact: the contact;
 *     stiffness (out) [force/length].
 * Errors: -1, -2 null; RSC_NO_RESULT, also if the value is not finite; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_stiffness(rsc_contact* contact, double* stiffness);

/* Elastic energy of the latest level, W = sum W_i + F'BF/2: the energies of the asperities plus
 * that of their interaction. Because dW/dZ0 = -N, the kinetic plus elastic energy of a sphere
 * moving on the surface is conserved. The error of W is of the order of the squared residual.
 *     contact: the contact;
 *     energy (out) [force length].
 * Errors: -1, -2 null; RSC_NO_RESULT, also if the value is not finite. */
RSC_API int32_t rsc_contact_energy(const rsc_contact* contact, double* energy);

/* The asperities of a contact, to which the indices of rsc_contact_spots refer: those from which it
 * was created or, with law = 'elliptic' or 'fourth_order' on a surface, the summits of the
 * difference between surface and indenter at the current position of the tip.
 *     asperities (out): the handle, to be destroyed by the caller; a contact created from it uses
 *       these asperities unchanged;
 *     contact: the contact.
 * Errors: -1 null address; -2 null, or a contact of elements. */
RSC_API int32_t rsc_contact_asperities(rsc_asperities** asperities, const rsc_contact* contact);

/* The contact spots of the latest level, in order of asperity index.
 *     contact: the contact;
 *     n: length of each array, at least the number of contacts (rsc_contact_result); only that many
 *       values are written;
 *     asperity (out, may be null): indices;
 *     force (out, may be null) [force];
 *     radius (out, may be null): contact radius a, defined by the area pi a^2 [length];
 *     penetration (out, may be null): that of the asperity, including the interaction [length].
 * Errors: -1 null; -2 too short; RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_spots(const rsc_contact* contact, int64_t n, int32_t* asperity,
                                  double* force, double* radius, double* penetration);

/* Force, radius and penetration of every asperity, 0 for those not in contact.
 *     contact: the contact;
 *     n: length of each array, the number of its asperities (rsc_contact_asperities);
 *     force, radius, penetration (out, may be null): as in rsc_contact_spots.
 * Errors: -1 null; -2 n is not the number of asperities; RSC_NO_RESULT. */
RSC_API int32_t rsc_contact_per_asperity(const rsc_contact* contact, int64_t n, double* force,
                                         double* radius, double* penetration);

/* Deflection of the surface by the contact forces, at any points. It is the sum over the contact
 * spots of the displacement due to a Hertz pressure with the force and area of the spot (Johnson
 * 1985, section 3.4 and eq. 3.42), and is continuous. At distance d from the centre of a spot it is
 * 3f/(8 E* a)(2 - d^2/a^2) inside, 3f/(4 pi E* a) [(2 - d^2/a^2) asin(a/d) + sqrt(d^2/a^2 - 1)]
 * outside, and f/(pi E* d) far away. In the solver, spots interact as point forces; the effect of
 * their finite size, about a^2/(10 d^2), is included only here. With laws other than 'hertz', a
 * spot is replaced by a circle of the same area.
 * With solids%adhesion, f is the force giving the same area without adhesion, and the deflection
 * due to the tension is added: for a resultant t < 0, t/(2 E* a) inside and t/(pi E* a) asin(a/d)
 * outside; with adhesion_range, the deflection due to Maugis's cohesive ring. For elements: the
 * deflection due to the pressures and tensions of all pixels.
 *     contact: the contact;
 *     n: number of points, >= 0;
 *     x, y: positions [length];
 *     deflection (out): positive downwards [length].
 * Errors: -1 null; -2 negative; -3, -4 null with n > 0, or not finite; -5 null with n > 0;
 *     RSC_NO_RESULT; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_deflection(const rsc_contact* contact, int64_t n, const double* x,
                                       const double* y, double* deflection);

/* ---- many contacts, and contacts saved in files ---------------------------------------------- */

/* Like rsc_contact_press, for many contacts in parallel. The results do not depend on the number of
 * threads.
 *     n: number of contacts, >= 0;
 *     contacts: different handles, not used by other threads during the call;
 *     force: N >= 0 for each [force];
 *     separation (out, may be null): Z0 of each, unchanged after a failure [length];
 *     status (out, may be null): status of rsc_contact_press for each;
 *     threads: 1 or more, 0 for all processors.
 * Errors: -1, -6 out of range; -2 null, a null handle, or one given twice; -3 null with n > 0.
 *     Otherwise RSC_SUCCESS if every contact succeeded, else the status of the first that failed; a
 *     negative status is returned as -2. */
RSC_API int32_t rsc_contacts_press(int64_t n, rsc_contact** contacts, const double* force,
                                   double* separation, int32_t* status, int32_t threads);

/* Like rsc_contact_indent, for many contacts in parallel. Arguments and errors are as in
 * rsc_contacts_press, except:
 *     separation: Z0 of each [length];
 *     force (out, may be null): N of each [force]. */
RSC_API int32_t rsc_contacts_indent(int64_t n, rsc_contact** contacts, const double* separation,
                                    double* force, int32_t* status, int32_t threads);

/* Computes a step for many contacts in parallel: moves their tips, applies a separation or a force
 * to each, and returns the quantities that codes for moving bodies need. The results do not depend
 * on the number of threads.
 *     n: number of contacts, >= 0;
 *     contacts: different handles, not used by other threads during the call;
 *     x0, y0: positions of the tips, both null to leave them in place [length];
 *     by_force: 1 if value is a force, 0 if it is a separation;
 *     value: force [force] or separation [length] of each.
 *     separation (out): Z0 of each [length];
 *     force (out): N of each [force];
 *     stiffness (out): dN/dZ0 [force/length] (costs one more solution of linear equations, unless
 *       null);
 *     lateral_x, lateral_y (out) [force], moment_x, moment_y (out) [force length]: as in
 *       rsc_contact_value;
 *     level_status (out): values of RSC_LEVEL_LIST;
 *     status (out): status of rsc_contact_move_tip, _indent or _press for each; if these succeed,
 *       that of rsc_contact_stiffness;
 *     threads: 1 or more, 0 for all processors.
 * Any output may be null. If a contact fails before it has a level, its outputs are unchanged;
 * otherwise they are written: NaN for the stiffness if there is none, and for all values but
 * separation and level_status if the solver found no equilibrium.
 * Errors: -1, -5, -16 out of range; -2 null, a null handle, or one given twice; -3, -4 only one of
 *     the two is null; -6 null with n > 0. Otherwise as in rsc_contacts_press. */
RSC_API int32_t rsc_contacts_step(int64_t n, rsc_contact** contacts, const double* x0,
                                  const double* y0, int32_t by_force, const double* value,
                                  double* separation, double* force, double* stiffness,
                                  double* lateral_x, double* lateral_y, double* moment_x,
                                  double* moment_y, int32_t* level_status, int32_t* status,
                                  int32_t threads);

/* Saves a contact to a file: tip, options, the time or distance that was set, latest level, loading
 * history and committed state, but not the asperities or the surface of elements. The contact is
 * not changed, and the restored one gives the same results, bit for bit, if the same version of the
 * library restores it. Later versions can read the file, too; the results are then the same within
 * the tolerance. Files are not portable between machine types. The file is written completely or
 * not at all. An existing file is replaced only if it was saved by rsc; links, devices, read-only
 * files and all others are left unchanged.
 *     contact: the contact;
 *     path: the file.
 * Errors: -1 null; -2 null or empty; RSC_FILE; RSC_NO_MEMORY; RSC_INTERNAL. */
RSC_API int32_t rsc_contact_save(rsc_contact* contact, const char* path);

/* Restores a contact from a file written by rsc_contact_save.
 *     contact (out): the handle;
 *     asperities: those of the saved contact, or others equal to them bit for bit;
 *     path: the file.
 * Errors: -1, -2 null; -2 different asperities; -3 null, empty, no such file, or a file that is
 *     damaged or from a later version; RSC_NO_MEMORY. */
RSC_API int32_t rsc_contact_restore(rsc_contact** contact, const rsc_asperities* asperities,
                                    const char* path);

/* ---- friction -------------------------------------------------------------------------------- */

/* The ratio of tangential to normal stiffness of any contact between two bodies, m = 4 G* / E*,
 * where 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2 and G = E/(2 (1 + nu)); for equal materials m = 2 (1 -
 * nu)/(2 - nu).
 *     E: two Young's moduli [force/length^2];
 *     nu: two Poisson's ratios;
 *     ratio (out): m [1].
 * Errors: -1 null, a modulus not positive (Infinity: rigid), or two rigid bodies; -2 null, or
 *     outside [-1, 0.5]; -3 null. */
RSC_API int32_t rsc_stiffness_ratio(const double* E, const double* nu, double* ratio);

/* The former name of rsc_stiffness_ratio. */
RSC_API int32_t rsc_tangential_ratio(const double* E, const double* nu, double* ratio);

/* Creates a friction object with the bodies, tip and options of a contact, and an empty loading
 * path. Asperities superpose two normal contacts; boundary elements solve the tangential problem,
 * with tractions of two components on their points. A step of elements is exact at constant
 * separation if no slip turns back within it; where the separation or the direction changes, its
 * errors are of first order in the step: take small ones.
 *     friction (out): the handle;
 *     contact: copied, may be destroyed at once;
 *     mu: coefficient of friction >= 0, finite;
 *     ratio: m > 0, finite (rsc_stiffness_ratio).
 * Errors: -1, -2 null; -2 not elastic; -3, -4 out of range; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_create(rsc_friction** friction, const rsc_contact* contact, double mu,
                                    double ratio);

/* Like rsc_friction_create, with mu = solids%friction and the ratio from solids%E and solids%nu.
 *     friction (out): the handle;
 *     contact: as in rsc_friction_create;
 *     a_case: the case, null for the defaults (mu = 0).
 * Errors: -1, -2 null; -2 not elastic; -3 invalid keys; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_create_from_case(rsc_friction** friction, const rsc_contact* contact,
                                              const rsc_case* a_case);

/* Creates an independent copy, including the path.
 *     friction (out): the handle;
 *     original: the object to copy.
 * Errors: -1, -2 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_copy(rsc_friction** friction, const rsc_friction* original);

/* Frees a friction object and sets its handle to null.
 * Errors: -1 null address. */
RSC_API int32_t rsc_friction_destroy(rsc_friction** friction);

/* Moves the contact along a straight path to (separation, x, y) and returns the forces there. Costs
 * as much as one level, or two if spots slip. The first call defines the start of the path, where
 * the contact is pressed without sliding. Only differences in x and y matter; sliding without
 * contact has no effect.
 *     friction: the object;
 *     separation: Z0 [length];
 *     x, y: tangential displacement [length];
 *     force (out, may be null): N [force];
 *     force_x, force_y (out, may be null): tangential force Q [force], initially in the direction
 *       of the displacement; the force on the sphere is -Q;
 *     lost (out, may be null): work dissipated by friction in this step, >= 0 [force length].
 * Errors: -1 null; -2, -3, -4 not finite; RSC_NOT_CONVERGED, with the results of the last iterate;
 *     RSC_NO_MEMORY, RSC_INTERNAL. On failures other than RSC_NOT_CONVERGED the state is unchanged.
 */
RSC_API int32_t rsc_friction_update(rsc_friction* friction, double separation, double x, double y,
                                    double* force, double* force_x, double* force_y, double* lost);

/* Moves the tip sideways at the separation of the latest update. Use it when the sphere rolls onto
 * other asperities. Asperities in contact at both positions keep their part of Q. Each stored
 * reversal of the tangential displacement keeps its depth as a fraction of the approach since first
 * contact; its deflection changes in proportion to this approach, and is multiplied by the fraction
 * of the normal force carried by these asperities. If the tangential energy would increase, the
 * deflections are scaled so that it stays constant; a decrease counts as work dissipated by
 * friction. If the path is empty or the tip is already there, only the tip changes. Costs as much
 * as one level for each stored reversal. Of elements, pixels in contact at both positions keep
 * their tractions, those that join hold the deflection that they meet, and the energy of those that
 * leave is not counted as dissipated.
 *     friction: the object;
 *     x0, y0: the new position [length], as in rsc_contact_move_tip.
 * Errors: -1 null; -2, -3 not finite; -2 outside; RSC_NOT_CONVERGED; RSC_NO_MEMORY, RSC_INTERNAL.
 *     On failures other than RSC_NOT_CONVERGED the state is unchanged. */
RSC_API int32_t rsc_friction_move_tip(rsc_friction* friction, double x0, double y0);

/* Tangential stiffness dQ/d(x, y) for further sliding at this separation in the current direction
 * of slip. If nothing slips, and for reversed sliding, it is S m in all directions, with S =
 * -dN/dZ0. Of elements, if the points that slip keep their tractions. Costs at most as much as one
 * level. All outputs may be null.
 *     friction: the object;
 *     xx, xy, yx, yy: dQ_x/dx, dQ_x/dy, dQ_y/dx, dQ_y/dy [force/length], 0 without contact.
 * Errors: -1 null; RSC_NOT_CONVERGED; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_stiffness(rsc_friction* friction, double* xx, double* xy, double* yx,
                                       double* yy);

/* State of the path after the latest update. All outputs may be null.
 *     friction: the object;
 *     separation, x, y: position on the path [length];
 *     force: N [force];
 *     force_x, force_y: Q [force];
 *     energy: elastic energy W of the normal problem [force length];
 *     tangential_energy: elastic energy of the tangential displacement [force length];
 *     lost: work dissipated by friction since the start of the path [force length];
 *     stick_separation: separation at which the contact area would equal the current stick area:
 *       the current separation if all spots stick, that at first contact if all slip [length]; NaN
 *       of elements.
 * Errors: -1 null; RSC_NO_RESULT before the first update. */
RSC_API int32_t rsc_friction_state(const rsc_friction* friction, double* separation, double* x,
                                   double* y, double* force, double* force_x, double* force_y,
                                   double* energy, double* tangential_energy, double* lost,
                                   double* stick_separation);

/* Stores the state for rsc_friction_rollback. The empty path of a new object counts as committed.
 *     friction: the object.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_commit(rsc_friction* friction);

/* Restores the last committed state.
 *     friction: the object.
 * Errors: -1 null; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_rollback(rsc_friction* friction);

/* Tangential forces in first loading, for a contact that is pressed to the separation of the latest
 * update and then slid: Q = mu [N(Z0) - N(Z0')], slide = (mu/m) (Z0' - Z0). The path is not
 * changed. Costs as much as one level for each displacement below full slip. Of elements: along x,
 * with stick_separation NaN.
 *     friction: the object;
 *     n: length of the arrays, >= 0;
 *     slide: tangential displacements, >= 0 [length];
 *     force (out): Q [force];
 *     stick_separation (out, may be null): Z0' [length].
 * Errors: -1 null; -2 negative; -3 null with n > 0, negative or not finite; -4 null with n > 0;
 *     RSC_NO_RESULT before the first update, or if there is no contact; RSC_NOT_CONVERGED;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_first_loading(rsc_friction* friction, int64_t n, const double* slide,
                                           double* force, double* stick_separation);

/* The tangential displacement in first loading at which the tangential force is Q.
 *     friction: the object;
 *     force: 0 <= Q <= mu N [force];
 *     slide (out): the displacement [length].
 * Errors: -1 null; -2 out of range; -3 null; RSC_NO_RESULT before the first update, or if there is
 *     no contact; RSC_NOT_CONVERGED; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_slide(rsc_friction* friction, double force, double* slide);

/* The onset of full slip in first loading at the separation of the latest update. Both outputs may
 * be null.
 *     friction: the object;
 *     slide: tangential displacement at the onset [length];
 *     force: mu N [force].
 * Errors: -1 null; RSC_NO_RESULT before the first update, or if there is no contact. */
RSC_API int32_t rsc_friction_full_slip(const rsc_friction* friction, double* slide, double* force);

/* Friction at the contact spots of the latest update, in order of asperity index, or of the
 * contacts of elements, with the radii of circles of the same areas. Costs as much as one level for
 * each stored reversal of the displacement. The number of spots is written even if the arrays are
 * too short.
 *     friction: the object;
 *     n: length of each array;
 *     count (out, may be null): number of spots;
 *     asperity (out, may be null): indices;
 *     radius (out, may be null): contact radius [length];
 *     stick_radius (out, may be null): radius of the sticking part, 0 if the whole spot slips
 *       [length];
 *     force_x, force_y (out, may be null): the spot's share of Q [force].
 * Errors: -1 null; -2 too short; RSC_NO_RESULT before the first update; RSC_NOT_CONVERGED;
 *     RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_spots(rsc_friction* friction, int64_t n, int64_t* count,
                                   int32_t* asperity, double* radius, double* stick_radius,
                                   double* force_x, double* force_y);

/* Saves a friction object, its path and committed state to a file, like rsc_contact_save.
 *     friction: the object;
 *     path: the file.
 * Errors: -1 null; -2 null or empty; RSC_FILE; RSC_NO_MEMORY. */
RSC_API int32_t rsc_friction_save(rsc_friction* friction, const char* path);

/* Restores a friction object from a file written by rsc_friction_save.
 *     friction (out): the handle;
 *     asperities, path and errors: as in rsc_contact_restore. */
RSC_API int32_t rsc_friction_restore(rsc_friction** friction, const rsc_asperities* asperities,
                                     const char* path);

#ifdef __cplusplus
}
#endif

#endif /* RSC_H */
