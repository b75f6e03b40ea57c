/* The resistance of a switch as it closes: a gold-plated sphere is pressed on a rough gold
 * surface with increasing forces. The constriction resistance of all spots together is (rho1 +
 * rho2)/(2 S/E*), S = -dN/dZ0 being the stiffness of the contact (Barber 2003): no electrical
 * problem needs to be solved. Units: mm, N, ohm. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "rsc.h"

/* Ends the program with the reason when a call fails. */
static void must(int32_t status) {
    char text[1000];
    if (status == RSC_SUCCESS) return;
    rsc_message(text, sizeof text, NULL);
    fprintf(stderr, "status %d: %s\n", (int)status, text);
    exit(1);
}

int main(void) {
    const double rho = 2.2e-5; /* gold, ohm mm */
    const double E_star = 78.0e3 / (2 * (1 - 0.42 * 0.42)), largest = 50;
    rsc_case* options = NULL;
    rsc_asperities* asperities = NULL;
    rsc_contact* contact = NULL;
    double N = 0, before = INFINITY;
    double* radius = malloc(100000 * sizeof *radius);
    if (!radius) return 1;
    must(rsc_case_create(&options));
    must(rsc_case_read(options,
                       "&solver model = 'asperities' / &surface n = 512, L_lambda_l = 8, "
                       "L_lambda_s = 128, sigma = 1.0e-3 /"));
    must(rsc_asperities_make(&asperities, options, 1));
    must(rsc_contact_create(&contact, asperities, E_star, 2.5, 0.5, 0.5, options));
    printf(
        "    N [N]   spots   resistance [mohm]   of the spots alone   of one spot with their "
        "area\n");
    for (N = 0.01; N < largest; N *= 3) {
        double Z0 = 0, k = 0, A = 0, resistance = 0, alone = 0, one = 0, sum = 0;
        int64_t spots = 0, i;
        must(rsc_contact_press(contact, N, &Z0));
        must(rsc_contact_result(contact, NULL, NULL, &A, &spots));
        must(rsc_contact_stiffness(contact, &k));
        if (spots > 100000) return 1;
        must(rsc_contact_spots(contact, 100000, NULL, NULL, radius, NULL));
        for (i = 0; i < spots; ++i) sum += radius[i];
        resistance = 2 * rho / (-2 * k / E_star);
        alone = 2 * rho / (4 * sum); /* Holm's spots in parallel, without interaction */
        one = 2 * rho / (4 * sqrt(A / 3.14159265358979323846)); /* a single spot of the same area */
        printf("%9.3f %7lld %19.5f %20.5f %29.5f\n", N, (long long)spots, 1e3 * resistance,
               1e3 * alone, 1e3 * one);
        /* The resistance decreases with force; it is between that of independent spots and that
         * of one spot. */
        if (!(resistance < before && resistance >= alone * (1 - 1e-6) &&
              resistance <= one * (1 + 1e-6)))
            return 1;
        before = resistance;
    }
    free(radius);
    must(rsc_contact_destroy(&contact));
    must(rsc_asperities_destroy(&asperities));
    must(rsc_case_destroy(&options));
    return 0;
}
