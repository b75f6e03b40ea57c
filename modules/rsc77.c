/* rsc for fixed-form FORTRAN 77, and whatever else has no derived types: every call is a subroutine with a name of six letters, every object an
 * INTEGER. modules/README has the list and an example.
 *
 *     CALL RSCIND(ICON, Z0, FORCE, IERR)
 *
 * INTEGER is 4 bytes and DOUBLE PRECISION 8, as compilers have them unless told otherwise. Arrays and scalars go by address; of a CHARACTER the
 * length follows all arguments by value, as gfortran and flang pass it; trailing blanks do not count. IERR is the status of rsc.h: 0, -i for the
 * i-th argument of the call here, or a positive value of RSC_STATUS_LIST; RSCMSG says why. Outputs keep what they held after a failure, but for
 * IERR = 1 (not converged). Indices count from 1. A handle of 0 is none: for a case, the defaults.
 *
 * Different handles may be used by different threads at the same time, as rsc.h says; the table of handles has a lock of its own.
 */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "rsc.h"

enum kind { FREE, CASE, SURFACE, ASPERITIES, CONTACT, FRICTION };
struct entry {
    enum kind kind;
    void* object;
};
static struct entry* table;
static int32_t entries;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* What is wrong with a handle, for RSCMSG; empty where the library itself has the last word. */
static _Thread_local char own_message[80];

static int32_t refuse(int32_t argument, const char* why) {
    strncpy(own_message, why, sizeof own_message - 1);
    return -argument;
}

/* The object of a handle; null if it is none of that kind. */
static void* object_of(int32_t handle, enum kind kind) {
    void* object = NULL;
    pthread_mutex_lock(&lock);
    if (handle > 0 && handle <= entries && table[handle - 1].kind == kind) object = table[handle - 1].object;
    pthread_mutex_unlock(&lock);
    return object;
}

/* Puts an object into the table; 0 if there is no memory for it. */
static int32_t enter(enum kind kind, void* object) {
    int32_t handle = 0;
    pthread_mutex_lock(&lock);
    for (int32_t k = 0; k < entries && !handle; ++k) {
        if (table[k].kind == FREE) handle = k + 1;
    }
    if (!handle) {
        const int32_t wanted = entries ? 2 * entries : 16;
        struct entry* larger = wanted > entries ? realloc(table, (size_t)wanted * sizeof *table) : NULL;
        if (larger) {
            for (int32_t k = entries; k < wanted; ++k) larger[k].kind = FREE;
            handle = entries + 1;
            table = larger;
            entries = wanted;
        }
    }
    if (handle) table[handle - 1] = (struct entry){kind, object};
    pthread_mutex_unlock(&lock);
    return handle;
}

static void destroy(enum kind kind, void* object) {
    switch (kind) {
        case CASE: rsc_case_destroy((rsc_case**)&object); break;
        case SURFACE: rsc_surface_destroy((rsc_surface**)&object); break;
        case ASPERITIES: rsc_asperities_destroy((rsc_asperities**)&object); break;
        case CONTACT: rsc_contact_destroy((rsc_contact**)&object); break;
        case FRICTION: rsc_friction_destroy((rsc_friction**)&object); break;
        case FREE: break;
    }
}

/* A C text of a CHARACTER without its trailing blanks; null if there is no memory. */
static char* text_of(const char* characters, size_t length) {
    while (length > 0 && characters[length - 1] == ' ') --length;
    char* text = malloc(length + 1);
    if (text) {
        memcpy(text, characters, length);
        text[length] = '\0';
    }
    return text;
}

/* Fills a CHARACTER: cut or filled with blanks. */
static void put_text(const char* text, char* characters, size_t length) {
    const size_t n = strlen(text);
    memcpy(characters, text, n < length ? n : length);
    if (n < length) memset(characters + n, ' ', length - n);
}

#define BEGIN own_message[0] = '\0'
/* Finds the object of a handle, or returns with the number of that argument. A case of 0 means the defaults. */
#define FIND(type, name, handle, kind, argument)                                        \
    type* const name = object_of(*(handle), kind);                                      \
    if (!name) {                                                                        \
        *ierr = refuse(argument, "not a handle of this kind, or one that was deleted"); \
        return;                                                                         \
    }
#define FIND_CASE(name, handle, argument)                                            \
    const rsc_case* const name = object_of(*(handle), CASE);                         \
    if (!name && *(handle) != 0) {                                                   \
        *ierr = refuse(argument, "not a handle of a case, or one that was deleted"); \
        return;                                                                      \
    }
/* Ends a constructor: the new object gets a handle. */
#define ENTER(kind, made, handle)                    \
    if (*ierr == 0) {                                \
        const int32_t entered = enter(kind, made);   \
        if (entered) {                               \
            *(handle) = entered;                     \
        } else {                                     \
            destroy(kind, made);                     \
            refuse(0, "the machine refused memory"); \
            *ierr = RSC_NO_MEMORY;                   \
        }                                            \
    }

/* ---- texts ------------------------------------------------------------------------------------------------------------------ */

RSC_API void rscver_(char* text, size_t length);
RSC_API void rscver_(char* text, size_t length) {
    char buffer[64] = "";
    rsc_version(buffer, sizeof buffer, NULL);
    put_text(buffer, text, length);
}

RSC_API void rscmsg_(char* text, size_t length);
RSC_API void rscmsg_(char* text, size_t length) {
    if (own_message[0]) {
        put_text(own_message, text, length);
        return;
    }
    char buffer[4096] = "";
    rsc_message(buffer, sizeof buffer, NULL);
    put_text(buffer, text, length);
}

/* ---- all handles ------------------------------------------------------------------------------------------------------------ */

RSC_API void rscdel_(int32_t* handle, int32_t* ierr);
RSC_API void rscdel_(int32_t* handle, int32_t* ierr) {
    BEGIN;
    *ierr = 0;
    if (*handle == 0) return;
    struct entry entry = {FREE, NULL};
    pthread_mutex_lock(&lock);
    if (*handle > 0 && *handle <= entries) {
        entry = table[*handle - 1];
        table[*handle - 1].kind = FREE;
    }
    pthread_mutex_unlock(&lock);
    if (entry.kind == FREE) {
        *ierr = refuse(1, "not a handle, or one that was deleted");
        return;
    }
    destroy(entry.kind, entry.object);
    *handle = 0;
}

RSC_API void rsccpy_(int32_t* handle, const int32_t* original, int32_t* ierr);
RSC_API void rsccpy_(int32_t* handle, const int32_t* original, int32_t* ierr) {
    BEGIN;
    struct entry entry = {FREE, NULL};
    pthread_mutex_lock(&lock);
    if (*original > 0 && *original <= entries) entry = table[*original - 1];
    pthread_mutex_unlock(&lock);
    void* made = NULL;
    switch (entry.kind) {
        case CASE: *ierr = rsc_case_copy((rsc_case**)&made, entry.object); break;
        case SURFACE: *ierr = rsc_surface_copy((rsc_surface**)&made, entry.object); break;
        case ASPERITIES: *ierr = rsc_asperities_copy((rsc_asperities**)&made, entry.object); break;
        case CONTACT: *ierr = rsc_contact_copy((rsc_contact**)&made, entry.object); break;
        case FRICTION: *ierr = rsc_friction_copy((rsc_friction**)&made, entry.object); break;
        case FREE: *ierr = refuse(2, "not a handle, or one that was deleted"); return;
    }
    ENTER(entry.kind, made, handle)
}

/* ---- cases ------------------------------------------------------------------------------------------------------------------ */

RSC_API void rsccas_(int32_t* icase, int32_t* ierr);
RSC_API void rsccas_(int32_t* icase, int32_t* ierr) {
    BEGIN;
    rsc_case* made = NULL;
    *ierr = rsc_case_create(&made);
    ENTER(CASE, made, icase)
}

RSC_API void rscred_(const int32_t* icase, const char* text, int32_t* ierr, size_t text_length);
RSC_API void rscred_(const int32_t* icase, const char* text, int32_t* ierr, size_t text_length) {
    BEGIN;
    FIND(rsc_case, a_case, icase, CASE, 1)
    char* const c_text = text_of(text, text_length);
    *ierr = c_text ? rsc_case_read(a_case, c_text) : RSC_NO_MEMORY;
    free(c_text);
}

RSC_API void rscset_(const int32_t* icase, const char* name, const char* value, int32_t* ierr, size_t name_length, size_t value_length);
RSC_API void rscset_(const int32_t* icase, const char* name, const char* value, int32_t* ierr, size_t name_length, size_t value_length) {
    BEGIN;
    FIND(rsc_case, a_case, icase, CASE, 1)
    char* const c_name = text_of(name, name_length);
    char* const c_value = text_of(value, value_length);
    *ierr = c_name && c_value ? rsc_case_set(a_case, c_name, c_value) : RSC_NO_MEMORY;
    free(c_name);
    free(c_value);
}

RSC_API void rscget_(const int32_t* icase, const char* name, char* value, int32_t* ierr, size_t name_length, size_t value_length);
RSC_API void rscget_(const int32_t* icase, const char* name, char* value, int32_t* ierr, size_t name_length, size_t value_length) {
    BEGIN;
    FIND(rsc_case, a_case, icase, CASE, 1)
    char* const c_name = text_of(name, name_length);
    char* const buffer = malloc(value_length + 1);
    *ierr = c_name && buffer ? rsc_case_get(a_case, c_name, buffer, (int64_t)value_length + 1, NULL) : RSC_NO_MEMORY;
    if (*ierr == 0) put_text(buffer, value, value_length);
    free(c_name);
    free(buffer);
}

RSC_API void rscrun_(const int32_t* icase, int32_t* failed, int32_t* ierr);
RSC_API void rscrun_(const int32_t* icase, int32_t* failed, int32_t* ierr) {
    BEGIN;
    FIND(rsc_case, a_case, icase, CASE, 1)
    int64_t levels = 0;
    *ierr = rsc_case_run(a_case, &levels);
    if (*ierr == 0 || *ierr == RSC_NOT_CONVERGED) *failed = (int32_t)levels;
}

/* ---- surfaces --------------------------------------------------------------------------------------------------------------- */

RSC_API void rscsyn_(int32_t* isurf, const int32_t* icase, const int32_t* k, int32_t* ierr);
RSC_API void rscsyn_(int32_t* isurf, const int32_t* icase, const int32_t* k, int32_t* ierr) {
    BEGIN;
    FIND_CASE(a_case, icase, 2)
    rsc_surface* made = NULL;
    *ierr = rsc_surface_synthesize(&made, a_case, *k);
    ENTER(SURFACE, made, isurf)
}

RSC_API void rscsur_(int32_t* isurf, const int32_t* nx, const int32_t* ny, const double* dx, const double* dy, const double* x0,
                     const double* y0, const int32_t* periodic, const double* z, int32_t* ierr);
RSC_API void rscsur_(int32_t* isurf, const int32_t* nx, const int32_t* ny, const double* dx, const double* dy, const double* x0,
                     const double* y0, const int32_t* periodic, const double* z, int32_t* ierr) {
    BEGIN;
    rsc_surface* made = NULL;
    *ierr = rsc_surface_take(&made, *nx, *ny, *dx, *dy, *x0, *y0, *periodic, z);
    ENTER(SURFACE, made, isurf)
}

RSC_API void rschgt_(const int32_t* isurf, const int32_t* n, double* z, int32_t* ierr);
RSC_API void rschgt_(const int32_t* isurf, const int32_t* n, double* z, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_surface, surface, isurf, SURFACE, 1)
    *ierr = rsc_surface_heights(surface, *n, z);
}

/* ---- asperities ------------------------------------------------------------------------------------------------------------- */

RSC_API void rscfnd_(int32_t* iasp, const int32_t* isurf, const int32_t* icase, int32_t* ierr);
RSC_API void rscfnd_(int32_t* iasp, const int32_t* isurf, const int32_t* icase, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_surface, surface, isurf, SURFACE, 2)
    FIND_CASE(a_case, icase, 3)
    rsc_asperities* made = NULL;
    *ierr = rsc_asperities_find(&made, surface, a_case);
    ENTER(ASPERITIES, made, iasp)
}

RSC_API void rscmak_(int32_t* iasp, const int32_t* icase, const int32_t* k, int32_t* ierr);
RSC_API void rscmak_(int32_t* iasp, const int32_t* icase, const int32_t* k, int32_t* ierr) {
    BEGIN;
    FIND_CASE(a_case, icase, 2)
    rsc_asperities* made = NULL;
    *ierr = rsc_asperities_make(&made, a_case, *k);
    ENTER(ASPERITIES, made, iasp)
}

RSC_API void rscasp_(int32_t* iasp, const int32_t* n, const double* x, const double* y, const double* z, const double* radius,
                     int32_t* ierr);
RSC_API void rscasp_(int32_t* iasp, const int32_t* n, const double* x, const double* y, const double* z, const double* radius,
                     int32_t* ierr) {
    BEGIN;
    rsc_asperities* made = NULL;
    *ierr = rsc_asperities_take(&made, *n, x, y, z, radius, NULL, NULL, NULL, NULL);
    ENTER(ASPERITIES, made, iasp)
}

RSC_API void rscnum_(const int32_t* iasp, int32_t* n, int32_t* ierr);
RSC_API void rscnum_(const int32_t* iasp, int32_t* n, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_asperities, asperities, iasp, ASPERITIES, 1)
    int64_t count = 0;
    *ierr = rsc_asperities_count(asperities, &count);
    if (*ierr == 0) *n = (int32_t)count;
}

RSC_API void rscxyz_(const int32_t* iasp, const int32_t* n, double* x, double* y, double* z, double* radius, int32_t* ierr);
RSC_API void rscxyz_(const int32_t* iasp, const int32_t* n, double* x, double* y, double* z, double* radius, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_asperities, asperities, iasp, ASPERITIES, 1)
    *ierr = rsc_asperities_get(asperities, *n, x, y, z, radius);
}

/* ---- contact ---------------------------------------------------------------------------------------------------------------- */

RSC_API void rsccon_(int32_t* icon, const int32_t* iasp, const double* E_star, const double* R, const double* x0, const double* y0,
                     const int32_t* icase, int32_t* ierr);
RSC_API void rsccon_(int32_t* icon, const int32_t* iasp, const double* E_star, const double* R, const double* x0, const double* y0,
                     const int32_t* icase, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_asperities, asperities, iasp, ASPERITIES, 2)
    FIND_CASE(a_case, icase, 7)
    rsc_contact* made = NULL;
    *ierr = rsc_contact_create(&made, asperities, *E_star, *R, *x0, *y0, a_case);
    ENTER(CONTACT, made, icon)
}

RSC_API void rsccnc_(int32_t* icon, const int32_t* iasp, const int32_t* icase, int32_t* ierr);
RSC_API void rsccnc_(int32_t* icon, const int32_t* iasp, const int32_t* icase, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_asperities, asperities, iasp, ASPERITIES, 2)
    FIND_CASE(a_case, icase, 3)
    rsc_contact* made = NULL;
    *ierr = rsc_contact_create_from_case(&made, asperities, a_case);
    ENTER(CONTACT, made, icon)
}

RSC_API void rsctip_(const int32_t* icon, const double* x0, const double* y0, int32_t* ierr);
RSC_API void rsctip_(const int32_t* icon, const double* x0, const double* y0, int32_t* ierr) {
    BEGIN;
    FIND(rsc_contact, contact, icon, CONTACT, 1)
    *ierr = rsc_contact_move_tip(contact, *x0, *y0);
}

RSC_API void rsctch_(const int32_t* icon, double* separation, int32_t* ierr);
RSC_API void rsctch_(const int32_t* icon, double* separation, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_contact, contact, icon, CONTACT, 1)
    *ierr = rsc_contact_first_touch(contact, separation);
}

RSC_API void rscind_(const int32_t* icon, const double* separation, double* force, int32_t* ierr);
RSC_API void rscind_(const int32_t* icon, const double* separation, double* force, int32_t* ierr) {
    BEGIN;
    FIND(rsc_contact, contact, icon, CONTACT, 1)
    *ierr = rsc_contact_indent(contact, *separation, force);
}

RSC_API void rscprs_(const int32_t* icon, const double* force, double* separation, int32_t* ierr);
RSC_API void rscprs_(const int32_t* icon, const double* force, double* separation, int32_t* ierr) {
    BEGIN;
    FIND(rsc_contact, contact, icon, CONTACT, 1)
    *ierr = rsc_contact_press(contact, *force, separation);
}

RSC_API void rscres_(const int32_t* icon, double* separation, double* force, double* area, int32_t* contacts, int32_t* ierr);
RSC_API void rscres_(const int32_t* icon, double* separation, double* force, double* area, int32_t* contacts, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_contact, contact, icon, CONTACT, 1)
    int64_t n = 0;
    *ierr = rsc_contact_result(contact, separation, force, area, &n);
    if (*ierr == 0) *contacts = (int32_t)n;
}

RSC_API void rsclev_(const int32_t* icon, int32_t* status, int32_t* candidates, int32_t* iterations, int32_t* overlapping, double* residual,
                     int32_t* ierr);
RSC_API void rsclev_(const int32_t* icon, int32_t* status, int32_t* candidates, int32_t* iterations, int32_t* overlapping, double* residual,
                     int32_t* ierr) {
    BEGIN;
    FIND(const rsc_contact, contact, icon, CONTACT, 1)
    int64_t n[3] = {0, 0, 0};
    *ierr = rsc_contact_level(contact, status, &n[0], &n[1], &n[2], residual);
    if (*ierr == 0) {
        *candidates = (int32_t)n[0];
        *iterations = (int32_t)n[1];
        *overlapping = (int32_t)n[2];
    }
}

RSC_API void rscstf_(const int32_t* icon, double* stiffness, int32_t* ierr);
RSC_API void rscstf_(const int32_t* icon, double* stiffness, int32_t* ierr) {
    BEGIN;
    FIND(rsc_contact, contact, icon, CONTACT, 1)
    *ierr = rsc_contact_stiffness(contact, stiffness);
}

RSC_API void rscnrg_(const int32_t* icon, double* energy, int32_t* ierr);
RSC_API void rscnrg_(const int32_t* icon, double* energy, int32_t* ierr) {
    BEGIN;
    FIND(rsc_contact, contact, icon, CONTACT, 1)
    *ierr = rsc_contact_energy(contact, energy);
}

RSC_API void rscspt_(const int32_t* icon, const int32_t* n, int32_t* asperity, double* force, double* radius, double* penetration,
                     int32_t* ierr);
RSC_API void rscspt_(const int32_t* icon, const int32_t* n, int32_t* asperity, double* force, double* radius, double* penetration,
                     int32_t* ierr) {
    BEGIN;
    FIND(const rsc_contact, contact, icon, CONTACT, 1)
    int64_t contacts = 0;
    *ierr = rsc_contact_result(contact, NULL, NULL, NULL, &contacts);
    if (*ierr == 0) *ierr = rsc_contact_spots(contact, *n, asperity, force, radius, penetration);
    for (int64_t k = 0; *ierr == 0 && k < contacts; ++k) ++asperity[k];
}

RSC_API void rscdfl_(const int32_t* icon, const int32_t* n, const double* x, const double* y, double* deflection, int32_t* ierr);
RSC_API void rscdfl_(const int32_t* icon, const int32_t* n, const double* x, const double* y, double* deflection, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_contact, contact, icon, CONTACT, 1)
    *ierr = rsc_contact_deflection(contact, *n, x, y, deflection);
}

/* ---- friction --------------------------------------------------------------------------------------------------------------- */

RSC_API void rscfri_(int32_t* ifri, const int32_t* icon, const int32_t* icase, int32_t* ierr);
RSC_API void rscfri_(int32_t* ifri, const int32_t* icon, const int32_t* icase, int32_t* ierr) {
    BEGIN;
    FIND(const rsc_contact, contact, icon, CONTACT, 2)
    FIND_CASE(a_case, icase, 3)
    rsc_friction* made = NULL;
    *ierr = rsc_friction_create_from_case(&made, contact, a_case);
    ENTER(FRICTION, made, ifri)
}

RSC_API void rscupd_(const int32_t* ifri, const double* separation, const double* x, const double* y, double* force, double* force_x,
                     double* force_y, double* lost, int32_t* ierr);
RSC_API void rscupd_(const int32_t* ifri, const double* separation, const double* x, const double* y, double* force, double* force_x,
                     double* force_y, double* lost, int32_t* ierr) {
    BEGIN;
    FIND(rsc_friction, friction, ifri, FRICTION, 1)
    *ierr = rsc_friction_update(friction, *separation, *x, *y, force, force_x, force_y, lost);
}

RSC_API void rsccmt_(const int32_t* ifri, int32_t* ierr);
RSC_API void rsccmt_(const int32_t* ifri, int32_t* ierr) {
    BEGIN;
    FIND(rsc_friction, friction, ifri, FRICTION, 1)
    *ierr = rsc_friction_commit(friction);
}

RSC_API void rscrbk_(const int32_t* ifri, int32_t* ierr);
RSC_API void rscrbk_(const int32_t* ifri, int32_t* ierr) {
    BEGIN;
    FIND(rsc_friction, friction, ifri, FRICTION, 1)
    *ierr = rsc_friction_rollback(friction);
}
