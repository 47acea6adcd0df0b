// SPDX-License-Identifier: GPL-3.0-or-later
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
// clang-format on

#include "bench.h"

/* A beam whose free end meets a fictitious fluid: the load on the points of the surface is f = f0(t) - T a.
 */

enum { POINTS = 6 };

struct fluid {
    struct bench bench;
    struct surface surface;
    struct added_mass_contact contacts[POINTS];
    struct anchor anchors[POINTS];
    double tensor; /* kg per point */
};

static void motion_init(struct surface_motion *motion)
{
    motion->x = memory_create(POINTS, sizeof *motion->x);
    motion->v = memory_create(POINTS, sizeof *motion->v);
    motion->a = memory_create(POINTS, sizeof *motion->a);
    assert_true(motion->x && motion->v && motion->a);
}

static void motion_free(struct surface_motion *motion)
{
    memory_free(motion->x);
    memory_free(motion->v);
    memory_free(motion->a);
}

/** The upper side's last POINTS - 1 nodes; point 0 is prescribed by somebody else. */
static void fluid_init(struct fluid *fluid, double tensor)
{
    const double upper[3] = {0.35, 0.02, 0};
    memset(fluid, 0, sizeof *fluid);
    bench_grid(&fluid->bench, 2, upper, (const int[3]){12, 2, 0});
    bench_support(&fluid->bench, "x-", true, true, false);
    fluid->bench.material.density = 1000;
    fluid->bench.material.young = 5e5;
    fluid->bench.mesh.newton_tolerance = 1e-13;
    fluid->bench.model.fluid.present = true;
    struct surface *surface = &fluid->surface;
    surface->dim = 2;
    surface->n_points = POINTS;
    surface->mesh = memory_create(POINTS, sizeof *surface->mesh);
    surface->mesh_node = memory_create(POINTS, sizeof *surface->mesh_node);
    surface->load = memory_create(POINTS, sizeof *surface->load);
    assert_true(surface->mesh && surface->mesh_node && surface->load);
    for (int k = 0; k < SURFACE_PARTS; ++k)
        assert_non_null(surface->part[k] = memory_create(POINTS, sizeof *surface->part[k]));
    motion_init(&surface->level[0]);
    motion_init(&surface->level[1]);
    motion_init(&surface->trial);
    surface->mesh[0] = -1;
    for (int p = 1; p < POINTS; p++)
        surface->mesh_node[p] = (int32_t)fluid->bench.mesh.mesh.n_nodes - p;
    surface->added_mass = fluid->contacts;
    surface->anchors = fluid->anchors;
    surface->n_added_mass = POINTS - 1;
    fluid->tensor = tensor;
    for (int p = 1; p < POINTS; p++) {
        struct added_mass_contact *contact = &fluid->contacts[p - 1];
        fluid->anchors[p] = (struct anchor){1.0, p};
        *contact = (struct added_mass_contact){(size_t)p, (size_t)p, 1, 1, {{0}}, 0.0};
        contact->tensor[1][1] = tensor;
        contact->tensor[0][1] = 0.1 * tensor; /* not symmetric */
    }
    assert_int_equal(solid_create(&fluid->bench.solid, &fluid->bench.model, 0), 0);
    assert_int_equal(solid_attach(fluid->bench.solid, surface), 0);
    assert_int_equal(solid_start(fluid->bench.solid, 0), 0);
}

static void fluid_reset(struct fluid *fluid)
{
    bench_reset(&fluid->bench);
    memory_free(fluid->surface.mesh);
    memory_free(fluid->surface.mesh_node);
    memory_free(fluid->surface.load);
    for (int k = 0; k < SURFACE_PARTS; ++k)
        memory_free(fluid->surface.part[k]);
    motion_free(&fluid->surface.level[0]);
    motion_free(&fluid->surface.level[1]);
    motion_free(&fluid->surface.trial);
}

/** The fluid's answer to level 1. */
static void fluid_load(struct fluid *fluid, double t)
{
    for (int p = 1; p < POINTS; p++) {
        const double a = fluid->surface.level[1].a[p][1];
        fluid->surface.load[p][0] = 0.02 * t - 0.1 * fluid->tensor * a;
        fluid->surface.load[p][1] = 0.3 * sin(40 * t + p) - fluid->tensor * a;
    }
}

/** One fixed-point step; returns the iterations, or 100 when it does not converge. */
static int fluid_step(struct fluid *fluid, double dt, bool added_mass, double relaxation, double tolerance)
{
    struct surface *surface = &fluid->surface;
    struct solid *solid = fluid->bench.solid;
    int iterations = 0;
    double norm = INFINITY;
    assert_int_equal(solid_begin_step(solid, fluid->bench.t, dt), 0);
    assert_int_equal(solid_predict(solid), 0);
    while (iterations < 100 && norm > tolerance && (iterations < 2 || norm < 1e3)) {
        fluid_load(fluid, fluid->bench.t + dt);
        if (solid_correct(solid, added_mass))
            return 100;
        norm = 0;
        for (int p = 1; p < POINTS; p++)
            for (int i = 0; i < 3; i++) {
                norm = fmax(norm, fabs(surface->trial.x[p][i] - surface->level[1].x[p][i]) / dt);
                surface->level[1].x[p][i] +=
                    relaxation * (surface->trial.x[p][i] - surface->level[1].x[p][i]);
                surface->level[1].v[p][i] +=
                    relaxation * (surface->trial.v[p][i] - surface->level[1].v[p][i]);
                surface->level[1].a[p][i] +=
                    relaxation * (surface->trial.a[p][i] - surface->level[1].a[p][i]);
                if (relaxation == 1) {
                    surface->level[1].x[p][i] = surface->trial.x[p][i];
                    surface->level[1].v[p][i] = surface->trial.v[p][i];
                    surface->level[1].a[p][i] = surface->trial.a[p][i];
                }
            }
        iterations++;
    }
    if (norm > tolerance)
        return 100;
    assert_int_equal(solid_accept(solid), 0);
    fluid->bench.t += dt;
    return iterations;
}

static double tip(const struct fluid *fluid)
{
    return bench_field(&fluid->bench, "Displacement")[fluid->bench.mesh.mesh.n_nodes - 1][1];
}

/** With loads that do not depend on the motion, corrections converge to what Newton's method gives. */
static void test_corrections_reach_newton(void **state)
{
    (void)state;
    struct fluid a, b;
    fluid_init(&a, 0);
    fluid_init(&b, 0);
    double largest = 0;
    for (int k = 0; k < 45; k++) { /* the factor is renewed at steps 20 and 40 and when the step changes */
        const double dt = k < 30 ? 2e-3 : 1e-3;
        assert_in_range(fluid_step(&a, dt, false, 1, 1e-12), 1, 8);
        assert_int_equal(solid_begin_step(b.bench.solid, b.bench.t, dt), 0);
        fluid_load(&b, b.bench.t + dt);
        assert_int_equal(solid_solve(b.bench.solid), 0);
        assert_int_equal(solid_accept(b.bench.solid), 0);
        b.bench.t += dt;
        largest = fmax(largest, fabs(tip(&a)));
        assert_true(fabs(tip(&a) - tip(&b)) < 1e-9 * largest);
    }
    assert_true(largest > 3e-4);
    const struct field_group *group = solid_state_fields(a.bench.solid);
    int64_t age;
    assert_int_equal(field_read(group, field_find(group, "FactorAge"), &age), 0);
    assert_int_equal(age, 15); /* made at step 30 with the new dt */
    fluid_reset(&a);
    fluid_reset(&b);
}

/** A light solid in a heavy fluid: plain iteration diverges, the added mass in the matrix makes it converge,
 * to the same answer as strong relaxation. */
static void test_added_mass(void **state)
{
    (void)state;
    struct fluid plain, relaxed, added;
    const double tensor = 0.5, dt = 1e-3; /* a node's mass is about 0.3 */
    fluid_init(&plain, tensor);
    assert_int_equal(fluid_step(&plain, dt, false, 1, 1e-10), 100);
    fluid_reset(&plain);
    fluid_init(&relaxed, tensor);
    fluid_init(&added, tensor);
    int total = 0;
    for (int k = 0; k < 10; k++) {
        assert_true(fluid_step(&relaxed, dt, false, 0.3, 1e-10) < 100);
        const int iterations = fluid_step(&added, dt, true, 1, 1e-10);
        assert_in_range(iterations, 1, 10);
        total += iterations;
    }
    print_message("added mass: %.1f iterations per step\n", total / 10.0);
    assert_true(fabs(tip(&added)) > 1e-5);
    assert_true(fabs(tip(&relaxed) / tip(&added) - 1) < 1e-5);
    fluid_reset(&relaxed);
    fluid_reset(&added);
}

/** Loads reach the nodes whole, level 1 and trial are the accepted motion, foreign points stay untouched, and
 * the prediction extrapolates the acceleration. */
static void test_attachment(void **state)
{
    (void)state;
    struct fluid fluid;
    const double dt = 2e-3;
    fluid_init(&fluid, 0);
    fluid.surface.level[1].x[0][0] = 7;
    for (int k = 0; k < 3; k++)
        fluid_step(&fluid, dt, false, 1, 1e-11);
    const double(*f)[3] = bench_field(&fluid.bench, "InterfaceForce");
    double nodes[2] = {0}, points[2] = {0};
    for (size_t n = 0; n < fluid.bench.mesh.mesh.n_nodes; n++)
        for (int i = 0; i < 2; i++)
            nodes[i] += f[n][i];
    for (int p = 0; p < POINTS; p++)
        for (int i = 0; i < 2; i++)
            points[i] += fluid.surface.load[p][i];
    assert_true(fabs(nodes[0] - points[0]) < 1e-15 && fabs(nodes[1] - points[1]) < 1e-15);
    assert_true(fluid.surface.level[1].x[0][0] == 7);
    const size_t last = fluid.bench.mesh.mesh.n_nodes - 1;
    const double(*a)[3] = bench_field(&fluid.bench, "Acceleration");
    const double(*before)[3] = bench_field(&fluid.bench, "PreviousAcceleration");
    assert_memory_equal(fluid.surface.level[1].x[1], solid_positions(fluid.bench.solid)[last],
                        sizeof(double[3]));
    const double expected = 2 * a[last][1] - before[last][1];
    assert_true(fabs(a[last][1] - before[last][1]) > 1e-3);
    assert_int_equal(solid_begin_step(fluid.bench.solid, fluid.bench.t, dt), 0);
    assert_int_equal(solid_predict(fluid.bench.solid), 0);
    assert_true(fabs(fluid.surface.level[1].a[1][1] - expected) < 1e-12);
    assert_memory_equal(fluid.surface.level[1].x[1], fluid.surface.trial.x[1], sizeof(double[POINTS - 1][3]));
    fluid_reset(&fluid);
}

/** In contact with a fluid the solid starts without accelerations. */
static void test_start(void **state)
{
    (void)state;
    struct fluid fluid;
    fluid_init(&fluid, 0);
    bench_load(&fluid.bench, NULL, 1, "-9.81");
    assert_int_equal(solid_start(fluid.bench.solid, 0), 0);
    assert_true(fluid.surface.level[0].a[1][1] == 0);
    fluid.bench.model.fluid.present = false;
    assert_int_equal(solid_start(fluid.bench.solid, 0), 0);
    assert_true(fluid.surface.level[0].a[1][1] < -9);
    fluid_reset(&fluid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corrections_reach_newton),
        cmocka_unit_test(test_added_mass),
        cmocka_unit_test(test_attachment),
        cmocka_unit_test(test_start),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
