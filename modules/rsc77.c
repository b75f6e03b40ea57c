/* rsc for fixed-form FORTRAN 77 and other languages without derived types: every call is a
 * subroutine with a name of six letters, every object an INTEGER. For the list and an example
 * see modules/README.
 *
 *     CALL RSCIND(ICON, Z0, FORCE, IERR)
 *
 * INTEGER must have 4 bytes and DOUBLE PRECISION 8, the default of compilers. Compilers and
 * linkers do not report other sizes (-fdefault-integer-8, -i8, -fdefault-real-8); therefore all
 * calls are refused before RSCINT and RSCDBL, which check the sizes. Arrays and scalars are
 * passed by address; the length of a CHARACTER follows all arguments by value, as with gfortran
 * and flang; trailing blanks do not count. IERR is the status of rsc.h: 0, -i for the i-th
 * argument of the call here, or a positive value of RSC_STATUS_LIST; RSCMSG returns the message.
 * Outputs keep their values after a failure, except for IERR = 1 (not converged). Indices count
 * from 1. A handle of 0 means none: for a case, the defaults.
 *
 * Different handles may be used by different threads at the same time, as rsc.h says; the table
 * of handles has its own lock.
 */
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "rsc.h"

enum kind { FREE, CASE, SURFACE, ASPERITIES, CONTACT, FRICTION };
struct entry {
    enum kind kind;
    int32_t generation; /* number of earlier objects with this entry */
    void* object;
};
static struct entry* table;
static int32_t entries;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* The error of a handle, for RSCMSG; empty if the message is that of the library. */
static _Thread_local char own_message[160];

static int32_t refuse(int32_t argument, const char* why) {
    strncpy(own_message, why, sizeof own_message - 1);
    return -argument;
}

/* A handle consists of the number of its entry, from 1, and in higher bits the generation, so
 * that a deleted handle is invalid even if its entry is used again. */
#define INDEX_BITS 20
#define GENERATIONS 2047

/* The entry of a handle, or a free entry. With `take` the entry is free afterwards. */
static struct entry entry_of(int32_t handle, int take) {
    struct entry found = {FREE, 0, NULL};
    const int32_t k = (handle & ((1 << INDEX_BITS) - 1)) - 1;
    pthread_mutex_lock(&lock);
    if (handle > 0 && k >= 0 && k < entries && table[k].generation == handle >> INDEX_BITS) {
        found = table[k];
        if (take) table[k] = (struct entry){FREE, (found.generation + 1) % GENERATIONS, NULL};
    }
    pthread_mutex_unlock(&lock);
    return found;
}

/* The object of a handle; null if it is not of that kind. */
static void* object_of(int32_t handle, enum kind kind) {
    const struct entry entry = entry_of(handle, 0);
    return entry.kind == kind ? entry.object : NULL;
}

/* Adds an object to the table; 0 if there is no memory for it. */
static int32_t enter(enum kind kind, void* object) {
    int32_t handle = 0;
    pthread_mutex_lock(&lock);
    for (int32_t k = 0; k < entries && !handle; ++k) {
        if (table[k].kind == FREE) handle = k + 1;
    }
    if (!handle) {
        const int32_t wanted = entries ? 2 * entries : 16;
        struct entry* larger =
            wanted < 1 << INDEX_BITS ? realloc(table, (size_t)wanted * sizeof *table) : NULL;
        if (larger) {
            for (int32_t k = entries; k < wanted; ++k) larger[k] = (struct entry){FREE, 0, NULL};
            handle = entries + 1;
            table = larger;
            entries = wanted;
        }
    }
    if (handle) {
        struct entry* const entry = &table[handle - 1];
        *entry = (struct entry){kind, entry->generation, object};
        handle |= entry->generation << INDEX_BITS;
    }
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

/* A C string from a CHARACTER without its trailing blanks; null if there is no memory. */
static char* text_of(const char* characters, size_t length) {
    while (length > 0 && characters[length - 1] == ' ') --length;
    char* text = malloc(length + 1);
    if (text) {
        memcpy(text, characters, length);
        text[length] = '\0';
    }
    return text;
}

/* Copies text to a CHARACTER, truncated or padded with blanks. */
static void put_text(const char* text, char* characters, size_t length) {
    const size_t n = strlen(text);
    memcpy(characters, text, n < length ? n : length);
    if (n < length) memset(characters + n, ' ', length - n);
}

/* True once RSCINT has found that INTEGER has 4 bytes, and RSCDBL that DOUBLE PRECISION has 8. */
static atomic_int integers_fit, doubles_fit;

/* Begins every call; refuses it before RSCINT and RSCDBL have succeeded. */
#define BEGIN                                                                                    \
    own_message[0] = '\0';                                                                       \
    if (!atomic_load(&integers_fit) || !atomic_load(&doubles_fit)) {                             \
        refuse(0,                                                                                \
               "call RSCINT first, with an INTEGER array of 1 and 2, and RSCDBL, with a DOUBLE " \
               "PRECISION array of 1 and 2: they check the sizes");                              \
        *ierr = RSC_NO_RESULT;                                                                   \
        return;                                                                                  \
    }
/* Finds the object of a handle, or returns with the number of that argument. A case of 0 means
 * the defaults. */
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
/* Ends a constructor: assigns a handle to the new object. */
#define ENTER(kind, made, handle)                  \
    if (*ierr == 0) {                              \
        const int32_t entered = enter(kind, made); \
        if (entered) {                             \
            *(handle) = entered;                   \
        } else {                                   \
            destroy(kind, made);                   \
            refuse(0, "out of memory");            \
            *ierr = RSC_NO_MEMORY;                 \
        }                                          \
    }

/* ---- texts ----------------------------------------------------------------------------------- */

RSC_API void rscver_(char* text, size_t length) {
    char buffer[64] = "";
    rsc_version(buffer, sizeof buffer, NULL);
    put_text(buffer, text, length);
}

RSC_API void rscmsg_(char* text, size_t length) {
    if (own_message[0]) {
        put_text(own_message, text, length);
        return;
    }
    char buffer[4096] = "";
    rsc_message(buffer, sizeof buffer, NULL);
    put_text(buffer, text, length);
}

RSC_API void rscint_(const int32_t* one_and_two, int32_t* ierr) {
    own_message[0] = '\0';
    const int fits = one_and_two[0] == 1 && one_and_two[1] == 2;
    atomic_store(&integers_fit, fits);
    *ierr =
        fits ? 0
             : refuse(1, "INTEGER must have 4 bytes: compile without -fdefault-integer-8 or -i8");
}

RSC_API void rscdbl_(const double* one_and_two, int32_t* ierr) {
    own_message[0] = '\0';
    const int fits = one_and_two[0] == 1 && one_and_two[1] == 2;
    atomic_store(&doubles_fit, fits);
    *ierr = fits ? 0
                 : refuse(1,
                          "DOUBLE PRECISION must have 8 bytes: compile without -fdefault-real-8, "
                          "or with -fdefault-double-8, too");
}

/* ---- all handles ----------------------------------------------------------------------------- */

RSC_API void rscdel_(int32_t* handle, int32_t* ierr) {
    BEGIN
    *ierr = 0;
    if (*handle == 0) return;
    const struct entry entry = entry_of(*handle, 1);
    if (entry.kind == FREE) {
        *ierr = refuse(1, "not a handle, or one that was deleted");
        return;
    }
    destroy(entry.kind, entry.object);
    *handle = 0;
}

RSC_API void rsccpy_(int32_t* handle, const int32_t* original, int32_t* ierr) {
    BEGIN
    const struct entry entry = entry_of(*original, 0);
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

/* ---- cases ----------------------------------------------------------------------------------- */

RSC_API void rscget_(const int32_t* icase, const char* name, char* value, int32_t* ierr,
                     size_t name_length, size_t value_length) {
    BEGIN
    FIND(rsc_case, a_case, icase, CASE, 1)
    char* const c_name = text_of(name, name_length);
    char* const buffer = malloc(value_length + 1);
    *ierr = c_name && buffer ? rsc_case_get(a_case, c_name, buffer, (int64_t)value_length + 1, NULL)
                             : RSC_NO_MEMORY;
    if (*ierr == 0) put_text(buffer, value, value_length);
    free(c_name);
    free(buffer);
}

/* ---- contact --------------------------------------------------------------------------------- */

RSC_API void rscspt_(const int32_t* icon, const int32_t* n, int32_t* asperity, double* force,
                     double* radius, double* penetration, int32_t* ierr) {
    BEGIN
    FIND(const rsc_contact, contact, icon, CONTACT, 1)
    int64_t contacts = 0;
    *ierr = rsc_contact_result(contact, NULL, NULL, NULL, &contacts);
    if (*ierr == 0) *ierr = rsc_contact_spots(contact, *n, asperity, force, radius, penetration);
    for (int64_t k = 0; *ierr == 0 && k < contacts; ++k) ++asperity[k];
}

/* ---- subroutines that only call their function ----------------------------------------------- */

#include "generated/rsc77.inc"
