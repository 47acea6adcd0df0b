// SPDX-License-Identifier: GPL-3.0-or-later
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
// clang-format on

#include "base/error.h"
#include "solid/element/element_list.h"
#include "solid/element/quadrature.h"

#include <math.h>
#include <string.h>

enum { NODES = ELEMENT_MAX_NODES, DOF = ELEMENT_MAX_DOF, DATA = 27 * (1 + DOF) };

static const struct solid_material rubber = {
    .law = "saint-venant-kirchhoff", .density = 1100, .young = 1400, .poisson = 0.4};
static const struct solid_material valve = {
    .law = "neo-hookean", .density = 1100, .young = 1400, .poisson = 0.4};
static const struct solid_material *const materials[] = {&rubber, &valve};

enum { MATERIALS = sizeof materials / sizeof materials[0] };

static struct constitutive law_of(const struct solid_material *material)
{
    struct constitutive law = {.law = constitutive_find(material->law)};
    law.law->prepare(material, law.parameters);
    return law;
}

/** A distorted element of any type: nodes of the unit cell (simplex) moved by fixed awkward amounts. */
static void distorted(const struct element_kernel *kernel, double X[NODES][3])
{
    const double amount = element_is_quadratic(kernel->type) ? 0.02 : 0.06;
    for (int a = 0; a < element_nodes(kernel->type); a++) {
        double xi[3];
        element_node(kernel->type, a, xi);
        for (int i = 0; i < 3; i++) {
            const double unit = element_is_simplex(kernel->type) ? xi[i] : 0.5 * (xi[i] + 1);
            X[a][i] = i < element_dim(kernel->type) ? 0.37 * unit + amount * sin(7.0 * a + 3.1 * i + 0.4) : 0;
        }
    }
}

static void awkward_displacement(const struct element_kernel *kernel, double *d)
{
    for (int p = 0; p < element_nodes(kernel->type) * element_dim(kernel->type); p++)
        d[p] = 0.03 * cos(5.3 * p + 0.7);
}

/** Force = derivative of the energy, stiffness = derivative of the force, symmetric. */
static void test_derivatives(void **state)
{
    (void)state;
    for (int k = 0; k < MATERIALS * ELEMENT_LIST_SIZE; k++) {
        const struct constitutive law = law_of(materials[k % MATERIALS]);
        const struct element_kernel *kernel = element_list[k / MATERIALS];
        const int dof = element_nodes(kernel->type) * element_dim(kernel->type);
        double X[NODES][3], data[DATA], d[DOF], f[DOF], K[DOF * DOF], plus[DOF], minus[DOF];
        const double h = 1e-6;
        assert_true(kernel->data_size <= DATA);
        distorted(kernel, X);
        awkward_displacement(kernel, d);
        assert_int_equal(kernel->prepare((const double(*)[3])X, &law, data), 0);
        assert_int_equal(kernel->forces(data, &law, d, f, K), 0);
        assert_int_equal(kernel->forces(data, &law, d, plus, NULL), 0);
        assert_memory_equal(f, plus, (size_t)dof * sizeof *f);
        for (int q = 0; q < dof; q++) {
            const double value = d[q];
            d[q] = value + h;
            const double energy_plus = kernel->energy(data, &law, d, NULL, NULL);
            kernel->forces(data, &law, d, plus, NULL);
            d[q] = value - h;
            const double energy_minus = kernel->energy(data, &law, d, NULL, NULL);
            kernel->forces(data, &law, d, minus, NULL);
            d[q] = value;
            assert_true(fabs(f[q] - (energy_plus - energy_minus) / (2 * h)) < 1e-5);
            for (int p = 0; p < dof; p++) {
                assert_true(fabs(K[p * dof + q] - (plus[p] - minus[p]) / (2 * h)) < 1e-4);
                assert_true(fabs(K[p * dof + q] - K[q * dof + p]) < 1e-10);
            }
        }
    }
}

/** A rigid rotation and translation gives neither strain nor force. */
static void test_rigid_rotation(void **state)
{
    (void)state;
    for (int k = 0; k < MATERIALS * ELEMENT_LIST_SIZE; k++) {
        const struct constitutive law = law_of(materials[k % MATERIALS]);
        const struct element_kernel *kernel = element_list[k / MATERIALS];
        const int dim = element_dim(kernel->type);
        const double c = cos(2.1), s = sin(2.1);
        double X[NODES][3], data[DATA], d[DOF], f[DOF], stress[6], volume;
        distorted(kernel, X);
        for (int a = 0; a < element_nodes(kernel->type); a++) {
            const double x[3] = {c * X[a][0] - s * X[a][1] + 0.3, s * X[a][0] + c * X[a][1] - 1.7,
                                 X[a][2] + 0.9};
            for (int i = 0; i < dim; i++)
                d[a * dim + i] = x[i] - X[a][i];
        }
        assert_int_equal(kernel->prepare((const double(*)[3])X, &law, data), 0);
        assert_int_equal(kernel->forces(data, &law, d, f, NULL), 0);
        for (int p = 0; p < element_nodes(kernel->type) * dim; p++)
            assert_true(fabs(f[p]) < 1e-11);
        assert_true(fabs(kernel->energy(data, &law, d, stress, &volume)) < 1e-20);
        assert_true(fabs(stress[0]) < 1e-10 && fabs(stress[3]) < 1e-10 && volume > 0);
    }
}

static const double F_hand[3][3] = {{1.13, 0.21, 0}, {0, 0.94, 0}, {0, 0, 1}};

/** All formulations have the given stress and energy density in a patch with deformation F_hand. */
static void check_homogeneous_deformation(const struct solid_material *material, const double expected[6],
                                          double density)
{
    const struct constitutive law = law_of(material);
    for (int k = 0; k < ELEMENT_LIST_SIZE; k++) {
        const struct element_kernel *kernel = element_list[k];
        const int dim = element_dim(kernel->type);
        double X[NODES][3], data[DATA], d[DOF], stress[6], volume;
        distorted(kernel, X);
        for (int a = 0; a < element_nodes(kernel->type); a++)
            for (int i = 0; i < dim; i++)
                d[a * dim + i] =
                    F_hand[i][0] * X[a][0] + F_hand[i][1] * X[a][1] + F_hand[i][2] * X[a][2] - X[a][i];
        assert_int_equal(kernel->prepare((const double(*)[3])X, &law, data), 0);
        const double energy = kernel->energy(data, &law, d, stress, &volume);
        assert_true(fabs(energy - density * volume) < 1e-12);
        for (int i = 0; i < 6; i++)
            assert_true(fabs(stress[i] - expected[i]) < 1e-10);
    }
}

/** The stress of a homogeneous deformation by hand: stretches and shear. */
static void test_homogeneous_deformation(void **state)
{
    (void)state;
    const double lambda = 2000, mu = 500; /* of E = 1400, nu = 0.4 */
    const double exx = 0.5 * (1.13 * 1.13 - 1), eyy = 0.5 * (0.21 * 0.21 + 0.94 * 0.94 - 1),
                 exy = 0.5 * 1.13 * 0.21;
    const double sxx = lambda * (exx + eyy) + 2 * mu * exx, syy = lambda * (exx + eyy) + 2 * mu * eyy;
    const double sxy = 2 * mu * exy, szz = lambda * (exx + eyy), J = 1.13 * 0.94;
    const double expected[6] = {(1.13 * 1.13 * sxx + 2 * 1.13 * 0.21 * sxy + 0.21 * 0.21 * syy) / J,
                                0.94 * 0.94 * syy / J,
                                szz / J,
                                0.94 * (1.13 * sxy + 0.21 * syy) / J,
                                0,
                                0};
    check_homogeneous_deformation(&rubber, expected, 0.5 * (sxx * exx + syy * eyy + 2 * sxy * exy));
}

/** The same for the neo-Hookean law from b = F F^T: sigma = (mu (b - I) + lambda ln J I)/J. */
static void test_homogeneous_neo_hookean(void **state)
{
    (void)state;
    const double lambda = 2000, mu = 500, J = 1.13 * 0.94, log_J = log(J);
    const double bxx = 1.13 * 1.13 + 0.21 * 0.21, byy = 0.94 * 0.94, bxy = 0.21 * 0.94;
    const double expected[6] = {(mu * (bxx - 1) + lambda * log_J) / J,
                                (mu * (byy - 1) + lambda * log_J) / J,
                                lambda * log_J / J,
                                mu * bxy / J,
                                0,
                                0};
    check_homogeneous_deformation(&valve, expected,
                                  0.5 * mu * (bxx + byy - 2) - mu * log_J + 0.5 * lambda * log_J * log_J);
}

/** A strongly bent, stretched element: the enhanced strains are at the minimum of the energy, so that the
 * energy is below that of the plain element, and the same when it is computed again. */
static void test_enhanced_minimum(void **state)
{
    (void)state;
    const struct constitutive law = law_of(&valve);
    const struct element_kernel *const pairs[2][2] = {{&quad4_eas, &quad4_full}, {&hex8_eas, &hex8_full}};
    for (int k = 0; k < 2; k++) {
        const struct element_kernel *eas = pairs[k][0], *full = pairs[k][1];
        const int dim = element_dim(eas->type), nodes = element_nodes(eas->type);
        double X[NODES][3], data[DATA], plain[DATA], d[DOF], f[DOF], again[DOF], K[DOF * DOF];
        distorted(eas, X);
        for (int a = 0; a < nodes; a++) {
            const double angle = 1.1 * X[a][0], radius = 0.8 - 0.8 * X[a][1];
            const double x[3] = {radius * sin(angle), 0.8 - radius * cos(angle), 1.1 * X[a][2]};
            for (int i = 0; i < dim; i++)
                d[a * dim + i] = x[i] - X[a][i];
        }
        assert_int_equal(eas->prepare((const double(*)[3])X, &law, data), 0);
        assert_int_equal(full->prepare((const double(*)[3])X, &law, plain), 0);
        assert_int_equal(eas->forces(data, &law, d, f, K), 0);
        assert_int_equal(eas->forces(data, &law, d, again, NULL), 0);
        assert_memory_equal(f, again, (size_t)(nodes * dim) * sizeof *f);
        const double energy = eas->energy(data, &law, d, NULL, NULL);
        assert_true(energy > 0.3 * full->energy(plain, &law, d, NULL, NULL));
        assert_true(energy < 0.999 * full->energy(plain, &law, d, NULL, NULL));
    }
}

/** Pure bending of a rectangle a x b: u_x = k x y needs the energy E/(1 - nu^2) b^3/12 a k^2/2; full
 * integration locks. */
static void test_bending_of_one_element(void **state)
{
    (void)state;
    const double a = 0.8, b = 0.1, k = 1e-4;
    const double X[4][3] = {{-a / 2, -b / 2, 0}, {a / 2, -b / 2, 0}, {a / 2, b / 2, 0}, {-a / 2, b / 2, 0}};
    const double exact = 1400 / (1 - 0.16) * b * b * b / 12 * a * k * k / 2;
    double data[DATA], d[8];
    for (int n = 0; n < 4; n++) {
        d[2 * n] = k * X[n][0] * X[n][1];
        d[2 * n + 1] = 0;
    }
    for (int m = 0; m < MATERIALS; m++) {
        const struct constitutive law = law_of(materials[m]);
        assert_int_equal(quad4_eas.prepare(X, &law, data), 0);
        assert_true(fabs(quad4_eas.energy(data, &law, d, NULL, NULL) / exact - 1) < 1e-6);
        assert_int_equal(quad4_full.prepare(X, &law, data), 0);
        assert_true(quad4_full.energy(data, &law, d, NULL, NULL) / exact > 10);
    }
}

/** The same displacement is in the quadratic elements, with v = -k x^2/2: no locking. */
static void test_bending_of_quadratic_elements(void **state)
{
    (void)state;
    const struct element_kernel *const kernels[] = {&tri6_full,  &quad8_full, &quad9_full,
                                                    &tet10_full, &hex20_full, &hex27_full};
    const double a = 0.8, b = 0.1, k = 1e-6;
    const struct constitutive law = law_of(&rubber);
    for (size_t e = 0; e < sizeof kernels / sizeof kernels[0]; e++) {
        const struct element_kernel *kernel = kernels[e];
        const int dim = element_dim(kernel->type);
        double X[NODES][3], data[DATA], d[DOF], volume;
        for (int n = 0; n < element_nodes(kernel->type); n++) {
            double xi[3];
            element_node(kernel->type, n, xi);
            const bool simplex = element_is_simplex(kernel->type);
            const double size[3] = {a, b, 0.3};
            for (int i = 0; i < 3; i++)
                X[n][i] = i < dim ? size[i] * (simplex ? xi[i] : 0.5 * xi[i]) : 0;
            /* plane strain in bending: sigma_yy = 0 by v = -nu/(1 - nu) k y^2/2 - k x^2/2 */
            d[n * dim] = k * X[n][0] * X[n][1];
            d[n * dim + 1] = -0.5 * k * X[n][0] * X[n][0] - 0.5 * 0.4 / 0.6 * k * X[n][1] * X[n][1];
            if (dim == 3)
                d[n * dim + 2] = 0;
        }
        assert_int_equal(kernel->prepare((const double(*)[3])X, &law, data), 0);
        const double energy = kernel->energy(data, &law, d, NULL, &volume);
        /* y^2 over the box, the triangle and the tetrahedron: b^2 times 1/12, 1/6, 1/10 of the volume */
        const double moment = element_is_simplex(kernel->type) ? (dim == 2 ? 1.0 / 6 : 1.0 / 10) : 1.0 / 12;
        const double exact = 1400 / (1 - 0.16) * moment * b * b * volume * k * k / 2;
        assert_true(fabs(energy / exact - 1) < 1e-4);
    }
}

/** Sum of w times a monomial of degree up to @p degree against the integral over the element in natural
 * coordinates. */
static void check_rule(enum element_type type, enum quadrature_use use, int degree)
{
    const struct quadrature rule = quadrature_of(type, use);
    const int dim = element_dim(type);
    for (int i = 0; i <= degree; i++)
        for (int j = 0; j <= degree; j++)
            for (int k = 0; k <= (dim == 3 ? degree : 0); k++) {
                const bool simplex = element_is_simplex(type);
                double sum = 0, exact = tgamma(i + 1.0) * tgamma(j + 1.0) * tgamma(k + 1.0) /
                                        tgamma(i + j + k + dim + 1.0);
                if (simplex && i + j + k > degree)
                    continue;
                if (!simplex)
                    exact = (i % 2 ? 0 : 2.0 / (i + 1)) * (j % 2 ? 0 : 2.0 / (j + 1)) *
                            (dim < 3 ? 1
                             : k % 2 ? 0
                                     : 2.0 / (k + 1));
                for (int p = 0; p < rule.n; p++)
                    sum += rule.weight[p] * pow(rule.xi[p][0], i) * pow(rule.xi[p][1], j) *
                           (dim < 3 ? 1 : pow(rule.xi[p][2], k));
                assert_true(fabs(sum - exact) < 1e-14);
            }
}

static void test_quadrature(void **state)
{
    (void)state;
    const enum element_type tensor[] = {ELEMENT_QUAD8, ELEMENT_QUAD9, ELEMENT_HEX20, ELEMENT_HEX27};
    for (int k = 0; k < 4; k++) {
        check_rule(tensor[k], QUADRATURE_STIFFNESS, 5);
        check_rule(tensor[k], QUADRATURE_MASS, 5);
    }
    check_rule(ELEMENT_QUAD4, QUADRATURE_MASS, 3);
    check_rule(ELEMENT_HEX8, QUADRATURE_STIFFNESS, 3);
    const enum element_type simplex[] = {ELEMENT_TRI3, ELEMENT_TET4, ELEMENT_TRI6, ELEMENT_TET10};
    for (int k = 0; k < 4; k++) {
        check_rule(simplex[k], QUADRATURE_STIFFNESS, k < 2 ? 1 : 2);
        check_rule(simplex[k], QUADRATURE_MASS, k < 2 ? 2 : 4);
    }
    check_rule(ELEMENT_TET10, QUADRATURE_MASS, 5);
}

static void test_inverted_and_degenerate(void **state)
{
    (void)state;
    for (int k = 0; k < MATERIALS * ELEMENT_LIST_SIZE; k++) {
        const struct constitutive law = law_of(materials[k % MATERIALS]);
        const struct element_kernel *kernel = element_list[k / MATERIALS];
        const int dim = element_dim(kernel->type), nodes = element_nodes(kernel->type);
        double X[NODES][3], data[DATA], d[DOF] = {0}, f[DOF];
        distorted(kernel, X);
        assert_int_equal(kernel->prepare((const double(*)[3])X, &law, data), 0);
        for (int a = 0; a < nodes; a++)
            d[a * dim] = -2 * X[a][0]; /* mirrored */
        assert_int_equal(kernel->forces(data, &law, d, f, NULL), STATUS_NUMERICAL);
        for (int a = 0; a < nodes; a++)
            X[a][0] = -X[a][0];
        assert_int_equal(kernel->prepare((const double(*)[3])X, &law, data), STATUS_DECK);
    }
}

static void test_refused(void **state)
{
    (void)state;
    const char *reason = NULL;
    assert_ptr_equal(element_kernel_find(ELEMENT_QUAD4, SOLID_EAS, &reason), &quad4_eas);
    assert_null(element_kernel_find(ELEMENT_TET4, SOLID_F_BAR, &reason));
    assert_non_null(strstr(reason, "constant strain"));
    assert_null(element_kernel_find(ELEMENT_QUAD9, SOLID_EAS, &reason));
    assert_non_null(strstr(reason, "bend without locking"));
    assert_null(element_kernel_find(ELEMENT_LINE3, SOLID_FULL, &reason));
    assert_non_null(strstr(reason, "triangles"));
    const struct solid_material soft = {.law = "saint-venant-kirchhoff", .young = 1, .poisson = 0.5};
    assert_non_null(strstr(constitutive_find(soft.law)->check(&soft), "Poisson"));
    assert_null(constitutive_find("hooke"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_derivatives),
        cmocka_unit_test(test_rigid_rotation),
        cmocka_unit_test(test_homogeneous_deformation),
        cmocka_unit_test(test_homogeneous_neo_hookean),
        cmocka_unit_test(test_enhanced_minimum),
        cmocka_unit_test(test_bending_of_one_element),
        cmocka_unit_test(test_bending_of_quadratic_elements),
        cmocka_unit_test(test_quadrature),
        cmocka_unit_test(test_inverted_and_degenerate),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
