/* A sphere pressed on a rough surface with increasing forces, from C. */
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
    rsc_case* options = NULL;
    rsc_asperities* asperities = NULL;
    rsc_contact* contact = NULL;
    int64_t n = 0, contacts = 0, i;
    double Z0 = 0, N = 0, A = 0, k = 0, before = INFINITY, sum = 0;
    double* force;
    char version[32];

    must(rsc_version(version, sizeof version, NULL));
    printf("rsc %s\n", version);
    must(rsc_case_create(&options));
    must(rsc_case_read(options,
                       "&solver model='asperities' / &surface n=512, L_lambda_l=8, "
                       "L_lambda_s=128, sigma=0.005 / &solids E=70d3, 210d3, nu=0.33, 0.3 /"));
    must(rsc_asperities_make(&asperities, options, 1));
    must(rsc_asperities_count(asperities, &n));
    must(rsc_contact_create_from_case(&contact, asperities, options));
    printf("%lld asperities\n     N [N]      Z0 [mm]    A [mm2]   contacts  dN/dZ0 [N/mm]\n",
           (long long)n);
    for (N = 0.125; N <= 32; N *= 4) {
        must(rsc_contact_press(contact, N, &Z0));
        must(rsc_contact_result(contact, NULL, NULL, &A, &contacts));
        must(rsc_contact_stiffness(contact, &k));
        printf("%10.4f %12.6f %10.3e %10lld %14.4g\n", N, Z0, A, (long long)contacts, k);
        if (!(Z0 < before && k < 0 && A > 0 && contacts > 0))
            return 1; /* more force, less separation */
        before = Z0;
    }
    force = malloc((size_t)n * sizeof *force);
    if (!force) return 1;
    must(rsc_contact_per_asperity(contact, n, force, NULL, NULL));
    for (i = 0; i < n; ++i) sum += force[i];
    free(force);
    printf("sum of the forces %.6f\n", sum);
    if (!(fabs(sum - 32) < 1e-4)) return 1;
    must(rsc_contact_destroy(&contact));
    must(rsc_asperities_destroy(&asperities));
    must(rsc_case_destroy(&options));
    return 0;
}
