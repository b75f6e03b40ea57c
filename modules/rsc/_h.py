"""Functions and status codes of rsc.h.

Generated from src/rsc.h by python3 modules/generate.py. Do not edit."""

PROTOTYPES = """
rsc_version(char* buffer, int64_t size, int64_t* length)
rsc_message(char* buffer, int64_t size, int64_t* length)
rsc_status_text(int32_t status, char* buffer, int64_t size, int64_t* length)
rsc_case_create(rsc_case** new_case)
rsc_case_copy(rsc_case** new_case, const rsc_case* original)
rsc_case_destroy(rsc_case** old_case)
rsc_case_read(rsc_case* a_case, const char* text)
rsc_case_read_file(rsc_case* a_case, const char* path)
rsc_case_set(rsc_case* a_case, const char* name, const char* value)
rsc_case_get(const rsc_case* a_case, const char* name, char* buffer, int64_t size, int64_t* length)
rsc_case_text(const rsc_case* a_case, char* buffer, int64_t size, int64_t* length)
rsc_key_count(int64_t* count)
rsc_key_name(int64_t key, char* buffer, int64_t size, int64_t* length)
rsc_case_run(const rsc_case* a_case, int64_t* failed_levels)
rsc_case_run_watched(const rsc_case* a_case, rsc_watch watch, void* data, int64_t* failed_levels)
rsc_case_resume(const rsc_case* a_case, rsc_watch watch, void* data, int64_t* failed_levels)
rsc_lock()
rsc_unlock()
rsc_surface_synthesize(rsc_surface** surface, const rsc_case* a_case, int64_t realization)
rsc_surface_take(rsc_surface** surface, int64_t nx, int64_t ny, double dx, double dy, double x0,
    double y0, int32_t periodic, const double* heights)
rsc_surface_copy(rsc_surface** surface, const rsc_surface* original)
rsc_surface_destroy(rsc_surface** surface)
rsc_surface_detrend(rsc_surface* surface, const char* how, double* rms)
rsc_surface_filter(rsc_surface* surface, double cutoff)
rsc_surface_grid(const rsc_surface* surface, int64_t* nx, int64_t* ny, double* dx, double* dy,
    double* x0, double* y0, int32_t* periodic)
rsc_surface_heights(const rsc_surface* surface, int64_t n, double* heights)
rsc_surface_moments(const rsc_surface* surface, double* m0, double* m2, double* m4)
rsc_asperities_find(rsc_asperities** asperities, const rsc_surface* surface, const rsc_case* a_case)
rsc_asperities_make(rsc_asperities** asperities, const rsc_case* a_case, int64_t realization)
rsc_asperities_take(rsc_asperities** asperities, int64_t n, const double* x, const double* y, const
    double* z, const double* radius, const double* kappa1, const double* kappa2, const double*
    angle, const double* biharmonic)
rsc_asperities_copy(rsc_asperities** asperities, const rsc_asperities* original)
rsc_asperities_destroy(rsc_asperities** asperities)
rsc_asperities_count(const rsc_asperities* asperities, int64_t* n)
rsc_asperities_get(const rsc_asperities* asperities, int64_t n, double* x, double* y, double* z,
    double* radius)
rsc_asperities_curvatures(const rsc_asperities* asperities, int64_t n, double* kappa1, double*
    kappa2, double* angle)
rsc_contact_create(rsc_contact** contact, const rsc_asperities* asperities, double E_star, double R,
    double x0, double y0, const rsc_case* a_case)
rsc_contact_create_from_case(rsc_contact** contact, const rsc_asperities* asperities, const
    rsc_case* a_case)
rsc_contact_copy(rsc_contact** contact, const rsc_contact* original)
rsc_contact_destroy(rsc_contact** contact)
rsc_contact_move_tip(rsc_contact* contact, double x0, double y0)
rsc_contact_commit(rsc_contact* contact)
rsc_contact_rollback(rsc_contact* contact)
rsc_contact_tip(const rsc_contact* contact, double* x0, double* y0)
rsc_contact_first_touch(const rsc_contact* contact, double* separation)
rsc_contact_indent(rsc_contact* contact, double separation, double* force)
rsc_contact_set_time(rsc_contact* contact, double time)
rsc_contact_set_distance(rsc_contact* contact, double distance)
rsc_contact_press(rsc_contact* contact, double force, double* separation)
rsc_contact_result(const rsc_contact* contact, double* separation, double* force, double* area,
    int64_t* contacts)
rsc_contact_level(const rsc_contact* contact, int32_t* level_status, int64_t* candidates, int64_t*
    iterations, int64_t* overlapping_pairs, double* residual)
rsc_contact_answer(rsc_contact* contact, double* separation, double* force, double* stiffness,
    double* area, double* energy, double* lateral_x, double* lateral_y, int32_t* level_status,
    int64_t* contacts, int64_t* overlapping_pairs, int64_t* large_contacts, int64_t* beyond_law,
    int64_t* edge_contacts)
rsc_contact_value(rsc_contact* contact, const char* name, double* value)
rsc_contact_error(const rsc_contact* contact, const char* name, double* error)
rsc_contact_stiffness(rsc_contact* contact, double* stiffness)
rsc_contact_energy(const rsc_contact* contact, double* energy)
rsc_contact_asperities(rsc_asperities** asperities, const rsc_contact* contact)
rsc_contact_spots(const rsc_contact* contact, int64_t n, int32_t* asperity, double* force, double*
    radius, double* penetration)
rsc_contact_per_asperity(const rsc_contact* contact, int64_t n, double* force, double* radius,
    double* penetration)
rsc_contact_deflection(const rsc_contact* contact, int64_t n, const double* x, const double* y,
    double* deflection)
rsc_contacts_press(int64_t n, rsc_contact** contacts, const double* force, double* separation,
    int32_t* status, int32_t threads)
rsc_contacts_indent(int64_t n, rsc_contact** contacts, const double* separation, double* force,
    int32_t* status, int32_t threads)
rsc_contacts_step(int64_t n, rsc_contact** contacts, const double* x0, const double* y0, int32_t
    by_force, const double* value, double* separation, double* force, double* stiffness, double*
    lateral_x, double* lateral_y, double* moment_x, double* moment_y, int32_t* level_status,
    int32_t* status, int32_t threads)
rsc_contact_save(rsc_contact* contact, const char* path)
rsc_contact_restore(rsc_contact** contact, const rsc_asperities* asperities, const char* path)
rsc_stiffness_ratio(const double* E, const double* nu, double* ratio)
rsc_tangential_ratio(const double* E, const double* nu, double* ratio)
rsc_friction_create(rsc_friction** friction, const rsc_contact* contact, double mu, double ratio)
rsc_friction_create_from_case(rsc_friction** friction, const rsc_contact* contact, const rsc_case*
    a_case)
rsc_friction_copy(rsc_friction** friction, const rsc_friction* original)
rsc_friction_destroy(rsc_friction** friction)
rsc_friction_update(rsc_friction* friction, double separation, double x, double y, double* force,
    double* force_x, double* force_y, double* lost)
rsc_friction_move_tip(rsc_friction* friction, double x0, double y0)
rsc_friction_stiffness(rsc_friction* friction, double* xx, double* xy, double* yx, double* yy)
rsc_friction_state(const rsc_friction* friction, double* separation, double* x, double* y, double*
    force, double* force_x, double* force_y, double* energy, double* tangential_energy, double*
    lost, double* stick_separation)
rsc_friction_commit(rsc_friction* friction)
rsc_friction_rollback(rsc_friction* friction)
rsc_friction_first_loading(rsc_friction* friction, int64_t n, const double* slide, double* force,
    double* stick_separation)
rsc_friction_slide(rsc_friction* friction, double force, double* slide)
rsc_friction_full_slip(const rsc_friction* friction, double* slide, double* force)
rsc_friction_spots(rsc_friction* friction, int64_t n, int64_t* count, int32_t* asperity, double*
    radius, double* stick_radius, double* force_x, double* force_y)
rsc_friction_save(rsc_friction* friction, const char* path)
rsc_friction_restore(rsc_friction** friction, const rsc_asperities* asperities, const char* path)
"""

SUCCESS = 0
NOT_CONVERGED = 1
NO_MEMORY = 2
FILE = 3
NO_RESULT = 4
INTERNAL = 5
STOPPED = 6
LEVEL_CONVERGED = 0
LEVEL_OUT_OF_VALIDITY = 1
LEVEL_OVERLAPPING = 2
LEVEL_NOT_UNIQUE = 3
LEVEL_NOT_CONVERGED = 4

#: Names of the statuses of a level, by number, as in `status` of a result file.
LEVELS = ("converged", "out_of_validity", "overlapping", "not_unique", "not_converged")
