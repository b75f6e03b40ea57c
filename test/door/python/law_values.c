/* Prints the status and the wrong line of a law, then value, slope and `where` of a column at the
 * arguments on standard input.
 * usage: law_values LAW COLUMN AGAINST(1 or 2) COUNT */
#include "rsc_law.h"

int main(int count, char** words) {
    rsc_law law;
    int status = rsc_law_read(words[1], &law);
    const size_t n = count > 4 ? (size_t)atoi(words[4]) : 0;
    double* const x = (double*)malloc(sizeof(double) * (3 * n + 1));
    int* const where = (int*)malloc(sizeof(int) * (n + 1));
    const int line = law.line;
    for (size_t i = 0; i < n; ++i)
        if (scanf("%lf", &x[i]) != 1) return 1;
    if (!status && n > 0)
        status = rsc_law_evaluate(&law, rsc_law_column(&law, words[2]), atoi(words[3]) - 1, n, x,
                                  x + n, x + 2 * n, where);
    printf("%d %d\n", status, line);
    for (size_t i = 0; i < n && (status == 0 || status == RSC_LAW_ARGUMENT); ++i)
        printf("%.17g %.17g %d\n", x[n + i], x[2 * n + i], where[i]);
    free(x);
    free(where);
    rsc_law_free(&law);
    return 0;
}
