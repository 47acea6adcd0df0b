// SPDX-License-Identifier: GPL-3.0-or-later
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
// clang-format on

#include "bench.h"

#include <stdio.h>

/* A very long step of the undamped method from rest is statics: the inertia vanishes, and with f_int = f = 0
 * at its start the balance is f_int = f at its end. */
static const double forever = 1e7;

/** Move the inner nodes of a grid by awkward amounts. */
static void distort(struct mesh *mesh, const double *upper, double amount)
{
    for (size_t a = 0; a < mesh->n_nodes; a++) {
        bool inner = true;
        for (int i = 0; i < mesh->dim; i++)
            inner = inner && mesh->X[a][i] > 1e-9 && mesh->X[a][i] < upper[i] - 1e-9;
        for (int i = 0; inner && i < mesh->dim; i++)
            mesh->X[a][i] += amount * sin(11.3 * (double)a + 2.7 * i);
    }
}

static const enum element_type all_types[] = {ELEMENT_QUAD4, ELEMENT_TRI3, ELEMENT_TRI6, ELEMENT_QUAD8,
                                              ELEMENT_QUAD9, ELEMENT_HEX8, ELEMENT_TET4, ELEMENT_TET10,
                                              ELEMENT_HEX20, ELEMENT_HEX27};

enum { ALL_TYPES = sizeof all_types / sizeof all_types[0] };

/** The skin moves by a linear map: inside, displacement and stress are those of the map, for every element
 * and formulation. */
static void check_patch(enum element_type type, enum solid_formulation formulation, const char *law)
{
    const int dim = element_dim(type);
    static const char *const sides[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    const double upper[3] = {0.6, 0.45, 0.5},
                 A[3][3] = {{0.03, 0.05, -0.01}, {-0.02, 0.04, 0.02}, {0.01, 0, -0.03}};
    const int cells[3] = {3, 3, 3};
    struct bench bench;
    bench_grid(&bench, dim, upper, cells);
    struct model_support supports[6] = {{0}};
    distort(&bench.mesh.mesh, upper, 0.03);
    bench_convert(&bench, type);
    bench.material.law = (char *)law;
    /* one set with the whole skin: a node may move in one way only */
    struct node_set *skin = &bench.mesh.mesh.sets[0];
    memory_free(skin->nodes);
    skin->nodes = memory_create(bench.mesh.mesh.n_nodes, sizeof *skin->nodes);
    skin->n = 0;
    for (size_t a = 0; a < bench.mesh.mesh.n_nodes; a++)
        for (int i = 0; i < dim; i++)
            if (bench.mesh.mesh.X[a][i] < 1e-9 || bench.mesh.mesh.X[a][i] > upper[i] - 1e-9) {
                skin->nodes[skin->n++] = (int32_t)a;
                break;
            }
    assert_string_equal(skin->name, sides[0]);
    bench.mesh.supports = supports;
    bench.mesh.n_supports = 1;
    supports[0] = (struct model_support){.set = 0, .moves = true, .motion = {.kind = MOTION_FIELD}};
    for (int i = 0; i < dim; i++) {
        char text[128];
        snprintf(text, sizeof text, "t > 0 ? (%g)*x + (%g)*y + (%g)*z : 0", A[i][0], A[i][1],
                 dim == 3 ? A[i][2] : 0.0);
        supports[0].motion.displacement[i] = bench_expression(text);
        supports[0].motion.velocity[i] = expression_constant(0);
        supports[0].motion.acceleration[i] = expression_constant(0);
    }
    bench.mesh.newton_tolerance = 1e-13;
    bench.mesh.formulation = formulation;
    bench.mesh.rho_infinity = 1;
    bench_start(&bench);
    assert_int_equal(bench_step(&bench, forever), 0);
    const double(*d)[3] = bench_field(&bench, "Displacement");
    for (size_t a = 0; a < bench.mesh.mesh.n_nodes; a++)
        for (int i = 0; i < dim; i++) {
            const double *X = bench.mesh.mesh.X[a];
            assert_true(fabs(d[a][i] - A[i][0] * X[0] - A[i][1] * X[1] - (dim == 3 ? A[i][2] * X[2] : 0)) <
                        1e-11);
        }
    const struct field_group *cells_group = solid_cell_fields(bench.solid);
    double(*stress)[6] = memory_create(bench.mesh.mesh.n_elements, sizeof *stress);
    assert_int_equal(field_read(cells_group, field_find(cells_group, "CauchyStress"), stress), 0);
    for (size_t e = 0; e < bench.mesh.mesh.n_elements; e++)
        for (int k = 0; k < 6; k++)
            assert_true(fabs(stress[e][k] - stress[0][k]) < 1e-8);
    assert_true(fabs(stress[0][0]) > 10);
    memory_free(stress);
    motion_reset(&supports[0].motion);
    bench.mesh.n_supports = 0;
    bench_reset(&bench);
}

static void test_patch(void **state)
{
    (void)state;
    for (int l = 0; l < 2; l++) {
        const char *law = l ? "neo-hookean" : "saint-venant-kirchhoff";
        for (int t = 0; t < ALL_TYPES; t++)
            check_patch(all_types[t], SOLID_FULL, law);
        for (int dim = 2; dim <= 3; dim++) {
            check_patch(dim == 2 ? ELEMENT_QUAD4 : ELEMENT_HEX8, SOLID_F_BAR, law);
            check_patch(dim == 2 ? ELEMENT_QUAD4 : ELEMENT_HEX8, SOLID_EAS, law);
        }
    }
}

/** Add to the loads a force along y with the shares of a uniform traction of total @p force on side x+, which
 * has
 * @p n elements: ends, inner corners and middles in the proportion 1 : 2 : 4, without middles 1 : 2. @p
 * corners: number of nodes before middles were added. */
static void traction(struct bench *bench, int n, size_t corners, double force)
{
    struct mesh *mesh = &bench->mesh.mesh;
    const bool quadratic = element_is_quadratic(mesh->type);
    size_t room = mesh->n_sets;
    assert_int_equal(memory_grow((void **)&mesh->sets, &room, mesh->n_sets + 3, sizeof *mesh->sets), 0);
    const struct node_set *side = mesh_find_set(mesh, "x+");
    const char *const names[3] = {"ends", "inner", "middles"};
    const double unit = force / ((quadratic ? 6.0 : 2.0) * n), shares[3] = {1, 2, 4};
    for (int k = 0; k < 3; k++) {
        struct node_set *set = &mesh->sets[mesh->n_sets++];
        *set = (struct node_set){.name = memory_text(names[k]),
                                 .nodes = memory_create(side->n, sizeof *set->nodes)};
        assert_true(set->name && set->nodes);
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < side->n; i++) {
            low = fmin(low, mesh->X[side->nodes[i]][1]);
            high = fmax(high, mesh->X[side->nodes[i]][1]);
        }
        for (size_t i = 0; i < side->n; i++) {
            const double y = mesh->X[side->nodes[i]][1];
            const bool end = y < low + 1e-9 || y > high - 1e-9;
            if (k == ((size_t)side->nodes[i] >= corners ? 2 : end ? 0 : 1))
                set->nodes[set->n++] = side->nodes[i];
        }
        char text[64];
        snprintf(text, sizeof text, "t > 0 ? %.17g : 0", shares[k] * unit * (double)set->n);
        if (set->n > 0)
            bench_load(bench, names[k], 1, text);
    }
}

/** Cook's membrane with n x n elements (pairs of triangles); returns the upward displacement of the middle of
 * the right side per unit load. */
static double cook(enum element_type type, enum solid_formulation formulation, int n, double young,
                   double poisson)
{
    const double unit[3] = {1, 1, 0};
    struct bench bench;
    bench_grid(&bench, 2, unit, (const int[3]){n, n, 0});
    for (size_t a = 0; a < bench.mesh.mesh.n_nodes; a++) {
        double *X = bench.mesh.mesh.X[a];
        const double s = X[0], r = X[1];
        X[0] = 48 * s;
        X[1] = 44 * s + r * (44 - 28 * s);
    }
    const size_t corners = bench.mesh.mesh.n_nodes;
    bench_convert(&bench, type);
    traction(&bench, n, corners, 1e-5);
    bench.material.young = young;
    bench.material.poisson = poisson;
    bench.mesh.formulation = formulation;
    bench.mesh.rho_infinity = 1;
    bench_support(&bench, "x-", true, true, false);
    bench_start(&bench);
    assert_int_equal(bench_step(&bench, forever), 0);
    struct solid_place place;
    double d[3], v[3], a[3];
    assert_int_equal(solid_locate(bench.solid, (const double[3]){48, 52, 0}, &place), 0);
    solid_evaluate(bench.solid, &place, d, v, a);
    bench_reset(&bench);
    return d[1] / 1e-5;
}

/** Plane stress with E = 1, nu = 1/3 (converged 23.96) is plane strain with nu/(1+nu) = 1/4, E = 15/16.
 * Displacement elements 4 x 4 and 16 x 16: 18.30 and 23.43 in the literature (Simo and Rifai 1990 and
 * others). */
static void test_cook(void **state)
{
    (void)state;
    const double young = 15.0 / 16, poisson = 0.25;
    assert_true(fabs(cook(ELEMENT_QUAD4, SOLID_FULL, 4, young, poisson) - 18.30) < 0.05);
    assert_true(fabs(cook(ELEMENT_QUAD4, SOLID_FULL, 16, young, poisson) - 23.43) < 0.05);
    assert_true(fabs(cook(ELEMENT_QUAD4, SOLID_EAS, 4, young, poisson) - 23.02) < 0.3);
    assert_true(fabs(cook(ELEMENT_QUAD4, SOLID_EAS, 32, young, poisson) - 23.96) < 0.05);
    const enum element_type quadratic[3] = {ELEMENT_TRI6, ELEMENT_QUAD8, ELEMENT_QUAD9};
    for (int k = 0; k < 3; k++) {
        const double coarse = cook(quadratic[k], SOLID_FULL, 4, young, poisson);
        const double fine = cook(quadratic[k], SOLID_FULL, 12, young, poisson);
        print_message("%s 4: %g, 12: %g\n", element_name(quadratic[k]), coarse, fine);
        assert_true(fabs(coarse - 23.96) < 0.5);
        assert_true(fabs(fine - 23.96) < 0.06);
    }
}

enum { STEPS = 20 };

/** A slender cantilever (length 1, height 0.05) under a dead load P at its end, step by step, against the
 * elastica: P L^2/(EI) = 5 lowers the end by 0.71379 L and draws it in by 0.38763 L (Mattiasson 1981); plane
 * strain: E/(1 - nu^2). */
static void check_elastica(enum element_type type, const char *law, int length)
{
    struct bench bench;
    const double height = 0.05, upper[3] = {1, height, height}, young = 1e6, poisson = 0.3;
    const int dim = element_dim(type);
    char text[64];
    bench_grid(&bench, dim, upper, (const int[3]){length, 1, 1});
    bench_convert(&bench, type);
    bench.material.law = (char *)law;
    bench.material.young = young;
    bench.material.poisson = dim == 2 ? poisson : 0;
    bench.mesh.rho_infinity = 0; /* the prediction must not oscillate */
    bench_support(&bench, "x-", true, true, dim == 3);
    const double bending = young * pow(height, 3) / 12 * (dim == 2 ? 1 / (1 - poisson * poisson) : height);
    snprintf(text, sizeof text, "-%.17g*t", 5 * bending / (STEPS * forever));
    bench_load(&bench, "x+", 1, text);
    bench_start(&bench);
    for (int step = 0; step < STEPS; step++)
        assert_int_equal(bench_step(&bench, forever), 0);
    struct solid_place place;
    double d[3], v[3], a[3];
    const double end[3] = {1, height / 2, height / 2};
    assert_int_equal(solid_locate(bench.solid, end, &place), 0);
    solid_evaluate(bench.solid, &place, d, v, a);
    print_message("%s %s: %g %g\n", element_name(type), law, d[0], d[1]);
    assert_true(fabs(d[1] + 0.71379) < 4e-3 && fabs(d[0] + 0.38763) < 4e-3);
    bench_reset(&bench);
}

static void test_elastica(void **state)
{
    (void)state;
    check_elastica(ELEMENT_QUAD4, "neo-hookean", 40);
    check_elastica(ELEMENT_QUAD9, "neo-hookean", 12);
    check_elastica(ELEMENT_QUAD8, "saint-venant-kirchhoff", 12);
    check_elastica(ELEMENT_TRI6, "saint-venant-kirchhoff", 20);
    check_elastica(ELEMENT_HEX8, "neo-hookean", 40);
    check_elastica(ELEMENT_HEX20, "neo-hookean", 12);
    check_elastica(ELEMENT_HEX27, "neo-hookean", 12);
    check_elastica(ELEMENT_TET10, "neo-hookean", 12);
}

/** Nearly incompressible: displacement elements lock, F-bar and EAS do not. Reference: refinement of both
 * to 64 x 64 elements. */
static void test_cook_incompressible(void **state)
{
    (void)state;
    const double converged =
        18.48; /* EAS 16, 32, 64: 18.266, 18.405, 18.464; F-bar: 18.251, 18.411, 18.470 */
    const double full = cook(ELEMENT_QUAD4, SOLID_FULL, 8, 1, 0.4999),
                 f_bar = cook(ELEMENT_QUAD4, SOLID_F_BAR, 8, 1, 0.4999);
    const double eas = cook(ELEMENT_QUAD4, SOLID_EAS, 16, 1, 0.4999);
    print_message("full 8: %g, F-bar 8: %g, EAS 16: %g\n", full, f_bar, eas);
    assert_true(full < 0.35 * converged);
    assert_true(fabs(f_bar / converged - 1) < 0.04);
    assert_true(fabs(eas / converged - 1) < 0.02);
}

/** Gravity on a standing column, laterally held: shortening rho g L^2/(2 (lambda + 2 mu)) for small loads;
 * reactions carry the weight. */
static void test_column_under_gravity(void **state)
{
    (void)state;
    for (int type = 0; type < ALL_TYPES; type++) {
        const int dim = element_dim(all_types[type]);
        struct bench bench;
        const double upper[3] = {0.3, 1.2, 0.4};
        bench_grid(&bench, dim, upper, (const int[3]){2, 5, 2});
        const size_t top = bench.mesh.mesh.n_nodes - 1;
        bench_convert(&bench, all_types[type]);
        bench.mesh.rho_infinity = 1;
        bench_support(&bench, "x-", true, false, false);
        bench_support(&bench, "x+", true, false, false);
        bench_support(&bench, "y-", false, true, false);
        if (dim == 3) {
            bench_support(&bench, "z-", false, false, true);
            bench_support(&bench, "z+", false, false, true);
        }
        bench_load(&bench, NULL, 1, "t > 0 ? -1e-6 : 0");
        bench_start(&bench);
        assert_int_equal(bench_step(&bench, forever), 0);
        const double(*d)[3] = bench_field(&bench, "Displacement");
        const double(*r)[3] = bench_field(&bench, "ReactionForce");
        const double weight = 1100 * 1e-6 * 0.3 * 1.2 * (dim == 3 ? 0.4 : 1);
        double sum = 0;
        for (size_t a = 0; a < bench.mesh.mesh.n_nodes; a++)
            sum += r[a][1];
        /* the floor of rounding is larger for a larger stiffness matrix */
        assert_true(fabs(sum - weight) < (element_is_quadratic(all_types[type]) ? 2e-6 : 1e-9) * weight);
        const double expected = -1100 * 1e-6 * 1.44 / (2 * 3000); /* lambda + 2 mu = 3000 */
        /* simplices of constant strain do not hold the exact solution */
        const bool constant = all_types[type] == ELEMENT_TRI3 || all_types[type] == ELEMENT_TET4;
        assert_true(fabs(d[top][1] / expected - 1) < (constant ? 0.04 : 1e-5));
        bench_reset(&bench);
    }
}

static void test_refused(void **state)
{
    (void)state;
    struct bench bench;
    const double upper[3] = {0.3, 0.2, 0};
    const int cells[3] = {3, 2, 0};
    bench_grid(&bench, 2, upper, cells);
    assert_int_equal(solid_check(&bench.model, 0), 0);
    bench.material.poisson = 0.5;
    assert_int_equal(solid_create(&bench.solid, &bench.model, 0), STATUS_DECK);
    bench.material.poisson = 0.3;
    bench.material.density = 0;
    assert_int_equal(solid_check(&bench.model, 0), STATUS_DECK);
    bench.material.density = 1;
    bench.material.law = "hooke";
    assert_int_equal(solid_check(&bench.model, 0), STATUS_DECK);
    bench.material.law = "saint-venant-kirchhoff";
    bench.mesh.rho_infinity = 1.01;
    assert_int_equal(solid_check(&bench.model, 0), STATUS_DECK);
    bench.mesh.rho_infinity = 1;
    bench.mesh.newton_tolerance = 0;
    assert_int_equal(solid_check(&bench.model, 0), STATUS_DECK);
    bench.mesh.newton_tolerance = 1e-9;
    bench.mesh.mesh.type = ELEMENT_LINE2;
    assert_int_equal(solid_check(&bench.model, 0), STATUS_DECK);
    bench.mesh.mesh.type = ELEMENT_TRI3;
    assert_int_equal(solid_check(&bench.model, 0), STATUS_DECK); /* has no EAS */
    bench.mesh.mesh.type = ELEMENT_QUAD9;
    assert_int_equal(solid_check(&bench.model, 0), STATUS_DECK); /* nor has this */
    bench.mesh.mesh.type = ELEMENT_QUAD4;
    bench.model.dim = 3;
    assert_int_equal(solid_check(&bench.model, 0), STATUS_DECK);
    bench.model.dim = 2;
    bench_support(&bench, "x-", true, true, false);
    bench_support(&bench, "y-", false, false, false)->moves = true;
    assert_int_equal(solid_check(&bench.model, 0), STATUS_DECK); /* they share a corner */
    bench.mesh.n_supports = 1;
    const int32_t first = bench.mesh.mesh.connectivity[4];
    bench.mesh.mesh.connectivity[4] = bench.mesh.mesh.connectivity[6];
    bench.mesh.mesh.connectivity[6] = first;
    assert_int_equal(solid_create(&bench.solid, &bench.model, 0), STATUS_DECK);
    assert_null(bench.solid);
    bench_reset(&bench);
}

/** Points are found in elements of every type; quadratic ones are curved. */
static void test_locate(void **state)
{
    (void)state;
    for (int type = 0; type < ALL_TYPES; type++) {
        const int dim = element_dim(all_types[type]);
        struct bench bench;
        const double upper[3] = {0.6, 0.45, 0.5}, inside[3] = {0.217, 0.391, 0.133},
                     outside[3] = {0.601, 0.2, 0.1};
        struct solid_place place;
        double N[ELEMENT_MAX_NODES], X[3] = {0};
        bench_grid(&bench, dim, upper, (const int[3]){3, 3, 3});
        distort(&bench.mesh.mesh, upper, 0.03);
        bench_convert(&bench, all_types[type]);
        if (element_is_quadratic(all_types[type]))
            distort(&bench.mesh.mesh, upper, 0.007);
        bench_start(&bench);
        assert_int_equal(solid_locate(bench.solid, outside, &place), STATUS_DECK);
        assert_int_equal(solid_locate(bench.solid, upper, &place), 0);
        assert_int_equal(solid_locate(bench.solid, inside, &place), 0);
        element_shape(bench.mesh.mesh.type, place.xi, N, NULL);
        const int nodes = bench.mesh.mesh.nodes_per_element;
        for (int n = 0; n < nodes; n++)
            for (int i = 0; i < dim; i++)
                X[i] += N[n] * bench.mesh.mesh.X[bench.mesh.mesh.connectivity[place.element * nodes + n]][i];
        for (int i = 0; i < dim; i++)
            assert_true(fabs(X[i] - inside[i]) < 1e-15);
        bench_reset(&bench);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_patch),
        cmocka_unit_test(test_cook),
        cmocka_unit_test(test_cook_incompressible),
        cmocka_unit_test(test_elastica),
        cmocka_unit_test(test_column_under_gravity),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_locate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
