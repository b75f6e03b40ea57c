/* The loop of a particle code with the law of a rough ball: 1000 balls fall on a plane at different
 * speeds and rebound. Each step evaluates the law at all contacts in one call.
 *
 *     rsc input/first.nml
 *     law.py output/first.nc --text -o ball.law
 *     particles ball.law
 *
 * The force depends on the approach alone, so that each ball leaves as fast as it came, and the
 * impulse is twice its momentum; the example checks both. */
#include "rsc_law.h"

enum { BALLS = 1000 };

int main(int count, char** words) {
    static double approach[BALLS], speed[BALLS], came[BALLS], force[BALLS];
    static double impulse[BALLS], longest[BALLS];
    rsc_law law;
    int status = count > 1 ? rsc_law_read(words[1], &law) : RSC_LAW_FILE;
    if (status) {
        fprintf(stderr, "particles: %s: %s\n", count > 1 ? words[1] : "", rsc_law_message(status));
        return 1;
    }
    /* The largest approach of the law is that of the fastest ball; slower ones go less deep. A step
     * is a small part of the shortest period of mass and stiffness. */
    const int force_column = rsc_law_column(&law, "force");
    const double deepest = law.values[(law.rows - 1) * law.columns], mass = 1;
    double step, most = 0, error = 0, impulse_error = 0, deep = 0, work = 0, stiff = 0;
    const int points = 1000;
    for (int k = 0; k < points; ++k) {
        const double x = deepest * (k + 0.5) / points;
        double N, dN;
        status = rsc_law_evaluate(&law, force_column, 0, 1, &x, &N, &dN, NULL);
        if (status) return 1;
        work += N * deepest / points;
        stiff = fmax(stiff, dN);
    }
    most = sqrt(2 * work / mass);
    step = 0.005 * sqrt(mass / stiff);
    for (int k = 0; k < BALLS; ++k) came[k] = speed[k] = most * (k + 100.0) / (BALLS + 100);
    int flying = 0;
    for (long steps = 0; flying < BALLS && steps < 1000000; ++steps) { /* leapfrog */
        flying = 0;
        for (int k = 0; k < BALLS; ++k) approach[k] += speed[k] * step / 2;
        status = rsc_law_evaluate(&law, force_column, 0, BALLS, approach, force, NULL, NULL);
        if (status) return 1;
        for (int k = 0; k < BALLS; ++k) {
            speed[k] -= force[k] / mass * step;
            impulse[k] += force[k] * step;
            approach[k] += speed[k] * step / 2;
            longest[k] = fmax(longest[k], approach[k]);
            flying += approach[k] < 0 && speed[k] < 0;
        }
    }
    for (int k = 0; k < BALLS; ++k) {
        error = fmax(error, fabs(-speed[k] / came[k] - 1));
        impulse_error = fmax(impulse_error, fabs(impulse[k] / (2 * mass * came[k]) - 1));
        deep = fmax(deep, longest[k]);
    }
    printf(
        "%d balls, up to %.3g deep (the law: %.3g); speed after over speed before: 1 within "
        "%.1e, impulse %.1e\n",
        BALLS, deep, deepest, error, impulse_error);
    rsc_law_free(&law);
    return flying == BALLS && error < 1e-3 && impulse_error < 1e-3 && deep <= deepest ? 0 : 1;
}
