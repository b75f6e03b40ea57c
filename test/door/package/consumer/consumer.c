/* Uses an installed rsc: one asperity must be Hertz, and a rough surface must push back. The
   argument is the version expected. */
#include <math.h>
#include <rsc.h>
#include <stdio.h>
#include <string.h>

static int failed = 0;

static void check(int ok, const char* what) {
    if (ok) return;
    printf("failed: %s\n", what);
    failed = 1;
}

int main(int argc, char** argv) {
    const double x = 0, y = 0, z = 0, r = 0.5, E = 1e5, u = 1e-3;
    rsc_case* options = NULL;
    rsc_surface* surface = NULL;
    rsc_asperities* asperities = NULL;
    rsc_contact* contact = NULL;
    double N = 0, Z0 = 0;
    char text[256];

    check(rsc_version(text, sizeof text, NULL) == 0 && argc > 1 && strcmp(text, argv[1]) == 0,
          "version");
    check(rsc_asperities_take(&asperities, 1, &x, &y, &z, &r, NULL, NULL, NULL, NULL) == 0, "take");
    check(rsc_contact_create(&contact, asperities, E, 10, 0, 0, NULL) == 0, "create");
    check(rsc_contact_indent(contact, -u, &N) == 0, "indent");
    check(fabs(N / (4.0 / 3 * E * sqrt(r) * pow(u, 1.5)) - 1) < 1e-12, "the force of Hertz");
    check(rsc_contact_indent(contact, NAN, &N) == -2, "a separation that is no number");
    check(rsc_message(text, sizeof text, NULL) == 0 && strstr(text, "separation"), "its message");
    check(rsc_contact_destroy(&contact) == 0 && rsc_asperities_destroy(&asperities) == 0,
          "destroy");

    check(rsc_case_create(&options) == 0, "case");
    check(rsc_case_read(
              options,
              "&solver model='asperities' / &surface n=256 L_lambda_l=4 L_lambda_s=64 /") == 0,
          "case from text");
    check(rsc_surface_synthesize(&surface, options, 1) == 0, "synthesize");
    check(rsc_asperities_find(&asperities, surface, options) == 0, "find");
    check(rsc_contact_create_from_case(&contact, asperities, options) == 0, "create from case");
    check(rsc_contact_press(contact, 10, &Z0) == 0 && isfinite(Z0), "press");
    check(rsc_contact_result(contact, NULL, &N, NULL, NULL) == 0 && fabs(N - 10) < 1e-4,
          "the force asked for");
    rsc_contact_destroy(&contact);
    rsc_asperities_destroy(&asperities);
    rsc_surface_destroy(&surface);
    rsc_case_destroy(&options);
    if (!failed) printf("consumer: all is well\n");
    return failed;
}
