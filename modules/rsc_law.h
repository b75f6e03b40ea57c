/* The law of an interface in C: reads the text that output/export/law.py writes with --text, and
 * evaluates its columns. Needs nothing but the C library (link with -lm); C99 and C++.
 *
 *     rsc_law law;
 *     int status = rsc_law_read("seal.law", &law);
 *     int k = rsc_law_column(&law, "pressure");
 *     if (!status) status = rsc_law_evaluate(&law, k, 0, n, gap, pressure, slope, where);
 *     if (status) puts(rsc_law_message(status));
 *     rsc_law_free(&law);
 *
 * Columns count from 0. The form of the text, and how it is interpolated, is described in
 * modules/rsc/law.py. After reading, a law does not change: any threads may evaluate it. */
#ifndef RSC_LAW_H
#define RSC_LAW_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    RSC_LAW_SUCCESS = 0,
    RSC_LAW_FILE = 1,     /* the file cannot be read */
    RSC_LAW_FORM = 2,     /* it is not the text of a law; rsc_law.line: at which line, or 0 */
    RSC_LAW_COLUMN = 3,   /* no such column, or not interpolated against this one */
    RSC_LAW_ARGUMENT = 4, /* some argument has no value: its `where` is 2, value and slope NaN */
    RSC_LAW_MEMORY = 5    /* out of memory */
};

enum { RSC_LAW_MOST = 64, RSC_LAW_WORD = 48 };

/* A column against an abscissa: nodes x, and n + 1 pieces, before, between and after the nodes,
 * each with its form and the coefficients of a cubic in the distance from its node. */
typedef struct {
    int n, log_value, log_x;
    double *x, *piece;
} rsc_law_curve;

typedef struct {
    int columns, rows, line;
    char name[RSC_LAW_MOST][RSC_LAW_WORD], unit[RSC_LAW_MOST][RSC_LAW_WORD];
    double* values; /* rows * columns, row by row */
    rsc_law_curve curve[RSC_LAW_MOST][2];
    char word[RSC_LAW_MOST][2][RSC_LAW_WORD];
} rsc_law;

static inline const char* rsc_law_message(int status) {
    static const char* const texts[] = {"success",
                                        "the file cannot be read",
                                        "the file is not the text of a law of rsc",
                                        "no such column, or not against this abscissa",
                                        "the law has no value at some argument",
                                        "out of memory"};
    return status >= 0 && status <= RSC_LAW_MEMORY ? texts[status] : "unknown status";
}

/* The number of a column, -1 if there is none of this name. */
static inline int rsc_law_column(const rsc_law* law, const char* name) {
    for (int k = 0; k < law->columns; ++k)
        if (strcmp(law->name[k], name) == 0) return k;
    return -1;
}

static inline void rsc_law_free(rsc_law* law) {
    for (int k = 0; k < law->columns; ++k)
        for (int axis = 0; axis < 2; ++axis) free(law->curve[k][axis].x);
    free(law->values);
    memset(law, 0, sizeof *law);
}

/* What the coefficients of a piece are of (its first number): the value, its logarithm; beyond the
 * rows also c0 exp(c1/c0 t) as the value, or as its logarithm. */
enum { RSC_LAW_VALUE, RSC_LAW_LOGARITHM, RSC_LAW_DECAY, RSC_LAW_LOG_DECAY };

/* Slope over the interval k in the coordinates of its end `of`, where the column is not 0. */
static inline double rsc_law_secant(const rsc_law_curve* c, const double* y, int k, int of) {
    const double h = c->x[k + 1] - c->x[k];
    if (!c->log_value) return (y[k + 1] - y[k]) / h;
    if (y[k] > 0 && y[k + 1] > 0) return (log(y[k + 1]) - log(y[k])) / h;
    return (of == k ? -1 : 1) / h;
}

/* That of a parabola through three nodes, limited so that each cubic is monotonic. */
static inline double rsc_law_slope(const rsc_law_curve* c, const double* y, int i) {
    const int n = c->n, end = i == 0 || i == n - 1;
    const int own = i == 0 ? 0 : i - 1, other = i == 0 ? 1 : i == n - 1 ? n - 3 : i;
    const int next = i == 0 ? 1 : i - 1;
    double m, d, most;
    if (c->log_value && !(y[i] > 0)) return 0;
    d = rsc_law_secant(c, y, own, i);
    if (!end) {
        const double e = rsc_law_secant(c, y, other, i);
        const double before = c->x[i] - c->x[i - 1], after = c->x[i + 1] - c->x[i];
        m = (after * d + before * e) / (before + after);
        most = d * e > 0 ? 3 * fmin(fabs(d), fabs(e)) : 0;
    } else {
        m = d;
        if (n > 2 && (!c->log_value || y[next] > 0)) {
            const double h = c->x[own + 1] - c->x[own], beyond = c->x[other + 1] - c->x[other];
            m = d + (d - rsc_law_secant(c, y, other, next)) * h / (h + beyond);
        }
        most = m * d > 0 ? 3 * fabs(d) : 0;
    }
    return fmax(-most, fmin(most, m));
}

static inline void rsc_law_pieces(rsc_law_curve* c, const double* y, int to_one) {
    const int n = c->n;
    for (int k = 0; k + 1 < n; ++k) {
        double* const p = c->piece + 5 * (k + 1);
        const int raised = c->log_value && y[k] > 0 && y[k + 1] > 0;
        const double h = c->x[k + 1] - c->x[k];
        const double a = raised ? log(y[k]) : y[k], b = raised ? log(y[k + 1]) : y[k + 1];
        const double unit_a = raised || !c->log_value ? 1 : y[k];
        const double unit_b = raised || !c->log_value ? 1 : y[k + 1];
        const double m = unit_a * rsc_law_slope(c, y, k), e = unit_b * rsc_law_slope(c, y, k + 1);
        const double d = (b - a) / h;
        p[0] = raised ? RSC_LAW_LOGARITHM : RSC_LAW_VALUE;
        p[1] = a;
        p[2] = m;
        p[3] = (3 * d - 2 * m - e) / h;
        p[4] = (m + e - 2 * d) / (h * h);
    }
    for (int side = -1; side <= 1; side += 2) {
        const int i = side < 0 ? 0 : n - 1;
        double* const p = c->piece + (side < 0 ? 0 : 5 * n);
        for (int q = 0; q < 5; ++q) p[q] = 0;
        if (c->log_value && !(y[i] > 0)) continue;
        p[1] = c->log_value ? log(y[i]) : y[i];
        p[2] = rsc_law_slope(c, y, i);
        p[0] = c->log_value ? RSC_LAW_LOGARITHM : RSC_LAW_VALUE;
        if ((to_one || !c->log_value) && p[1] * p[2] * side < 0) p[0] += 2;
    }
}

/* The curve of column k against the column `axis`. */
static inline int rsc_law_make(rsc_law* law, int k, int axis) {
    rsc_law_curve* const c = &law->curve[k][axis];
    char word[RSC_LAW_WORD];
    char* dash;
    double* y;
    const int m = law->columns, rows = law->rows;
    const int falls = law->values[axis] > law->values[(rows - 1) * m + axis];
    strcpy(word, law->word[k][axis]);
    if (strcmp(word, "-") == 0 || axis == k) return RSC_LAW_SUCCESS;
    dash = strchr(word, '-');
    if (dash && strcmp(dash, "-to-1") != 0) return RSC_LAW_FORM;
    if (dash) *dash = 0;
    c->log_value = strcmp(word, "power") == 0 || strcmp(word, "exponential") == 0;
    c->log_x = strcmp(word, "power") == 0 || strcmp(word, "logarithmic") == 0;
    if (!c->log_value && !c->log_x && strcmp(word, "linear") != 0) return RSC_LAW_FORM;
    c->x = (double*)malloc(sizeof(double) * (size_t)(7 * rows + 5));
    if (!c->x) return RSC_LAW_MEMORY;
    c->piece = c->x + rows;
    y = c->piece + 5 * (rows + 1);
    for (int r = 0; r < rows; ++r) {
        const double* const row = law->values + (falls ? rows - 1 - r : r) * m;
        if (c->log_x && !(row[axis] > 0)) continue;
        if (c->log_value && row[k] < 0) return RSC_LAW_FORM;
        c->x[c->n] = c->log_x ? log(row[axis]) : row[axis];
        y[c->n] = row[k];
        if (c->n > 0 && !(c->x[c->n] > c->x[c->n - 1])) return RSC_LAW_FORM;
        ++c->n;
    }
    if (c->n < 2) return RSC_LAW_FORM;
    rsc_law_pieces(c, y, dash != NULL);
    return RSC_LAW_SUCCESS;
}

/* A line of the text: a column, a row, or neither. */
static inline int rsc_law_line(rsc_law* law, const char* line, int* room) {
    int k = law->columns, used = 0, more = 0;
    if (law->line == 1) {
        char rest[2];
        if (sscanf(line, " # rsc law 1%n %1s", &used, rest) == 1 || used == 0) return RSC_LAW_FORM;
        return RSC_LAW_SUCCESS;
    }
    sscanf(line, " # column %n", &used);
    if (used > 0) {
        if (k == RSC_LAW_MOST || law->rows > 0) return RSC_LAW_FORM;
        if (sscanf(line + used, "%47s %47s %47s %47[^: \n] %n", law->name[k], law->unit[k],
                   law->word[k][0], law->word[k][1], &more) != 4 ||
            more == 0 || line[used + more] != ':')
            return RSC_LAW_FORM;
        ++law->columns;
        return RSC_LAW_SUCCESS;
    }
    line += strspn(line, " \t\r\n");
    if (*line == 0 || *line == '#') return RSC_LAW_SUCCESS;
    if (law->rows == *room) {
        const size_t doubles = 2 * (size_t)(*room + 8) * (size_t)k;
        double* const grown = (double*)realloc(law->values, sizeof(double) * (doubles + 1));
        if (!grown) return RSC_LAW_MEMORY;
        law->values = grown;
        *room = 2 * (*room + 8);
    }
    for (int c = 0; c < k; ++c) {
        char* end;
        const double value = strtod(line, &end);
        if (end == line || !isfinite(value)) return RSC_LAW_FORM;
        law->values[law->rows * k + c] = value;
        line = end + strspn(end, " \t\r\n");
    }
    ++law->rows;
    return *line == 0 && k > 0 ? RSC_LAW_SUCCESS : RSC_LAW_FORM;
}

/* Reads the text of a law. Returns a status; free the law also after a failure. */
static inline int rsc_law_read(const char* path, rsc_law* law) {
    char line[4096];
    int room = 0, status = RSC_LAW_SUCCESS;
    FILE* const file = fopen(path, "r");
    memset(law, 0, sizeof *law);
    if (!file) return RSC_LAW_FILE;
    while (!status && fgets(line, sizeof line, file)) {
        ++law->line;
        status = strlen(line) + 1 < sizeof line ? rsc_law_line(law, line, &room) : RSC_LAW_FORM;
    }
    if (ferror(file)) status = RSC_LAW_FILE;
    fclose(file);
    if (status) return status;
    law->line = 0;
    if (law->columns < 2 || law->rows < 2) return RSC_LAW_FORM;
    for (int k = 0; k < law->columns && !status; ++k)
        for (int axis = 0; axis < 2 && !status; ++axis) status = rsc_law_make(law, k, axis);
    return status;
}

/* Of an abscissa of 0 or below, where its logarithm does not exist; NaN: there is no limit. */
static inline double rsc_law_limit(const double* first) {
    const int form = (int)first[0];
    if (first[2] == 0) return form == RSC_LAW_LOGARITHM ? exp(first[1]) : first[1];
    if (form == RSC_LAW_VALUE || (form == RSC_LAW_LOGARITHM && first[2] < 0)) return NAN;
    return form == RSC_LAW_LOG_DECAY ? 1 : 0;
}

static inline void rsc_law_value(const rsc_law_curve* c, double x, double* value, double* slope,
                                 int* where) {
    int low = 0, high = c->n;
    double at = x, t;
    const double* p;
    if (c->log_x && x <= 0) {
        *value = rsc_law_limit(c->piece);
        *slope = 0;
        *where = -1;
        return;
    }
    if (c->log_x) at = log(x);
    while (low < high) { /* the number of nodes at or below it */
        const int middle = (low + high) / 2;
        if (c->x[middle] <= at)
            low = middle + 1;
        else
            high = middle;
    }
    if (at == c->x[c->n - 1]) --low;
    *where = low == 0 ? -1 : low == c->n;
    p = c->piece + 5 * low;
    t = at - c->x[low > 0 ? low - 1 : 0];
    if (p[0] < RSC_LAW_DECAY) {
        *value = ((p[4] * t + p[3]) * t + p[2]) * t + p[1];
        *slope = (3 * p[4] * t + 2 * p[3]) * t + p[2];
    } else {
        const double factor = exp(p[2] / p[1] * t);
        *value = p[1] * factor;
        *slope = p[2] * factor;
    }
    if (p[0] == RSC_LAW_LOGARITHM || p[0] == RSC_LAW_LOG_DECAY) {
        *value = exp(*value);
        *slope *= *value;
    }
    if (c->log_x) *slope /= x;
}

/* Column k at n values x of the column `against`, 0 or 1: values, their slopes with respect to x
 * (may be null), and -1 below the rows, 0 within, 1 beyond, 2 without a value (may be null).
 * Returns a status. */
static inline int rsc_law_evaluate(const rsc_law* law, int k, int against, size_t n,
                                   const double* x, double* value, double* slope, int* where) {
    int status = RSC_LAW_SUCCESS;
    const rsc_law_curve* c;
    if (k < 0 || k >= law->columns || against < 0 || against > 1) return RSC_LAW_COLUMN;
    c = &law->curve[k][against];
    if (c->n == 0) return RSC_LAW_COLUMN;
    for (size_t i = 0; i < n; ++i) {
        double d;
        int w;
        rsc_law_value(c, x[i], &value[i], &d, &w);
        if (!isfinite(value[i]) || !isfinite(d)) {
            value[i] = d = NAN;
            w = 2;
            status = RSC_LAW_ARGUMENT;
        }
        if (slope) slope[i] = d;
        if (where) where[i] = w;
    }
    return status;
}

#endif
