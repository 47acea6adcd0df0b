// SPDX-License-Identifier: GPL-3.0-or-later
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
// clang-format on

#include "solid/constitutive/constitutive_list.h"

#include <math.h>
#include <string.h>

static const struct solid_material rubber = {.density = 1100, .young = 1400, .poisson = 0.4};
static const double lambda = 2000, mu = 500; /* of this material */

static struct constitutive law_of(const char *name)
{
    struct constitutive law = {.law = constitutive_find(name)};
    assert_non_null(law.law);
    assert_null(law.law->check(&rubber));
    law.law->prepare(&rubber, law.parameters);
    return law;
}

static double value(const struct constitutive *law, int dim, const double *E, double *S, double *D)
{
    return law->law->stress(law->parameters, dim, E, S, D);
}

/** Stress = derivative of the energy, tangent = derivative of the stress, for every law. */
static void test_derivatives(void **state)
{
    (void)state;
    const double h = 1e-6;
    for (int l = 0; l < CONSTITUTIVE_LIST_SIZE; l++)
        for (int dim = 2; dim <= 3; dim++) {
            const struct constitutive law = law_of(constitutive_list[l]->name);
            const int n = dim == 2 ? 3 : 6;
            const double strains[2][6] = {{0.11, -0.07, 0.23}, {0.11, -0.07, 0.19, 0.23, -0.13, 0.08}};
            double E[6], S[6], D[36], plus[6], minus[6];
            memcpy(E, strains[dim - 2], sizeof E);
            value(&law, dim, E, S, D);
            for (int l2 = 0; l2 < n; l2++) {
                const double at = E[l2];
                E[l2] = at + h;
                const double above = value(&law, dim, E, plus, NULL);
                E[l2] = at - h;
                const double below = value(&law, dim, E, minus, NULL);
                E[l2] = at;
                assert_true(fabs(S[l2] - (above - below) / (2 * h)) < 1e-6);
                for (int k = 0; k < n; k++) {
                    assert_true(fabs(D[k * n + l2] - (plus[k] - minus[k]) / (2 * h)) < 1e-5);
                    assert_true(fabs(D[k * n + l2] - D[l2 * n + k]) < 1e-9);
                }
            }
        }
}

/** Plane strain is the three-dimensional law with E_ZZ = E_YZ = E_XZ = 0. */
static void test_plane_strain(void **state)
{
    (void)state;
    for (int l = 0; l < CONSTITUTIVE_LIST_SIZE; l++) {
        const struct constitutive law = law_of(constitutive_list[l]->name);
        const double flat[3] = {0.17, -0.09, 0.21}, solid[6] = {0.17, -0.09, 0, 0.21, 0, 0};
        double S2[6], S3[6];
        assert_true(fabs(value(&law, 2, flat, S2, NULL) - value(&law, 3, solid, S3, NULL)) < 1e-12);
        assert_true(fabs(S2[0] - S3[0]) < 1e-11 && fabs(S2[1] - S3[1]) < 1e-11 &&
                    fabs(S2[2] - S3[3]) < 1e-11);
        assert_true(fabs(S2[3] - S3[2]) < 1e-11 && fabs(S3[4]) < 1e-12);
    }
}

/** Stretch g = 1.3 along x alone: P = F S = mu (g - 1/g) + lambda ln g / g = 265.3846 + 403.6373, and across
 * lambda ln g. */
static void test_uniaxial_strain(void **state)
{
    (void)state;
    const struct constitutive law = law_of("neo-hookean");
    const double g = 1.3, E[6] = {0.5 * (g * g - 1)};
    double S[6];
    const double energy = value(&law, 3, E, S, NULL);
    assert_true(fabs(g * S[0] - (500 * 0.530769230769231 + 2000 * 0.201818664974993)) < 1e-9);
    assert_true(fabs(S[1] - 2000 * 0.262364264467491) < 1e-9 && fabs(S[2] - S[1]) < 1e-12);
    assert_true(fabs(energy - (500 * (0.345 - 0.262364264467491) + 1000 * 0.068835007269568)) < 1e-9);
}

/** Simple shear by 0.37: sigma_xy = mu g and W = mu g^2/2, as J = 1. */
static void test_simple_shear(void **state)
{
    (void)state;
    const struct constitutive law = law_of("neo-hookean");
    const double g = 0.37, E[3] = {0, 0.5 * g * g, g};
    double S[6];
    assert_true(fabs(value(&law, 2, E, S, NULL) - 500 * 0.1369 / 2) < 1e-11);
    /* sigma = F S F^T with F = [1 g; 0 1] */
    assert_true(fabs(S[2] + g * S[1] - 185) < 1e-10);
    assert_true(fabs(S[0] + 2 * g * S[2] + g * g * S[1] - 500 * 0.1369) < 1e-10);
    assert_true(fabs(S[1]) < 1e-10 && fabs(S[3]) < 1e-10);
}

/** Both laws agree to first order in the strain, also where it is tiny. */
static void test_small_strains(void **state)
{
    (void)state;
    const struct constitutive neo = law_of("neo-hookean"), svk = law_of("saint-venant-kirchhoff");
    const double direction[6] = {0.7, -0.4, 0.3, 0.9, -0.2, 0.5}, sizes[3] = {1e-4, 1e-8, 1e-13};
    for (int s = 0; s < 3; s++) {
        double E[6], S[6], linear[6];
        for (int k = 0; k < 6; k++)
            E[k] = sizes[s] * direction[k];
        value(&neo, 3, E, S, NULL);
        value(&svk, 3, E, linear, NULL);
        for (int k = 0; k < 6; k++)
            assert_true(fabs(S[k] - linear[k]) < (10 * sizes[s] + 1e-14) * (lambda + 2 * mu) * sizes[s]);
    }
    double D[36], C[36], S[6];
    const double rest[6] = {0};
    assert_true(value(&neo, 3, rest, S, D) == 0 && S[0] == 0 && S[3] == 0);
    value(&svk, 3, rest, S, C);
    for (int k = 0; k < 36; k++)
        assert_true(fabs(D[k] - C[k]) < 1e-12);
}

/** Strains that no deformation has: two directions turned inside out have a positive determinant too. */
static void test_impossible_strain(void **state)
{
    (void)state;
    const struct constitutive law = law_of("neo-hookean");
    const double flat[3] = {-0.51, 0.1, 0}, twice[6] = {-0.7, -0.8, 0.1};
    double S[6];
    assert_true(isnan(value(&law, 2, flat, S, NULL)));
    assert_true(isnan(value(&law, 3, twice, S, NULL)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_derivatives),     cmocka_unit_test(test_plane_strain),
        cmocka_unit_test(test_uniaxial_strain), cmocka_unit_test(test_simple_shear),
        cmocka_unit_test(test_small_strains),   cmocka_unit_test(test_impossible_strain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
