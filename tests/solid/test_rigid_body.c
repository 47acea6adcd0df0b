// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies against closed forms: falling, turning, conserving, held.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "solid/bench.h"
#include "solid/rigid_body.h"

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.17g instead of %.17g (+- %g)", value, expected, tolerance);
}

static const double pi = 3.14159265358979323846;

/** A block of 0.3 x 0.7 (x 1.1) with a corner at the origin; density 1.7. */
static void block(struct bench *bench, int dim)
{
    const double upper[3] = {0.3, 0.7, dim == 3 ? 1.1 : 0.0};
    const int cells[3] = {2, 3, dim == 3 ? 2 : 0};
    bench_grid(bench, dim, upper, cells);
    bench->mesh.material = -1;
    bench->mesh.rigid = (struct model_rigid){.present = true, .density = 1.7};
}

static const struct rigid_body *body_of(const struct bench *bench)
{
    return *(void *const *)((const char *)bench->solid + offsetof(struct solid, data));
}

static void test_mass(void **state)
{
    (void)state;
    struct bench bench;
    struct rigid_body_mass mass;
    block(&bench, 3);
    rigid_body_mass_of(&bench.mesh, &mass);
    const double m = 1.7 * 0.3 * 0.7 * 1.1;
    assert_near(mass.mass, m, 1e-14);
    assert_near(mass.centre[0], 0.15, 1e-14);
    assert_near(mass.centre[2], 0.55, 1e-14);
    assert_near(mass.inertia[0][0], m * (0.49 + 1.21) / 12.0, 1e-14);
    assert_near(mass.inertia[1][1], m * (0.09 + 1.21) / 12.0, 1e-14);
    assert_near(mass.inertia[2][2], m * (0.09 + 0.49) / 12.0, 1e-14);
    for (int i = 0; i < 3; i++)
        assert_near(mass.inertia[i][(i + 1) % 3], 0.0, 1e-15);
    // instead of the density a mass, spread evenly
    bench.mesh.rigid.has_mass = true;
    bench.mesh.rigid.mass = 2.0 * m;
    rigid_body_mass_of(&bench.mesh, &mass);
    assert_near(mass.inertia[2][2], 2.0 * m * (0.09 + 0.49) / 12.0, 1e-14);
    bench_reset(&bench);
}

/** A disc: nodes of the rim on the circle, area and inertia those of what its elements cover. */
static void test_disc(void **state)
{
    (void)state;
    static const double centre[3] = {0.4, -0.3, 0.0};
    const enum element_type types[] = {ELEMENT_QUAD4, ELEMENT_QUAD8, ELEMENT_QUAD9};
    for (size_t k = 0; k < 3; k++) {
        struct model_mesh definition = {.rigid = {.present = true, .density = 1.3}};
        struct mesh *mesh = &definition.mesh;
        assert_int_equal(mesh_create_disc(mesh, types[k], centre, 0.125, 12), 0);
        assert_int_equal(mesh->n_elements, 144);
        const struct node_set *rim = mesh_find_set(mesh, "rim");
        assert_non_null(rim);
        assert_int_equal(rim->n, types[k] == ELEMENT_QUAD4 ? 48 : 96);
        for (size_t n = 0; n < rim->n; n++) {
            const double *X = mesh->X[rim->nodes[n]];
            assert_near(hypot(X[0] - centre[0], X[1] - centre[1]), 0.125, 1e-15);
        }
        struct rigid_body_mass mass;
        rigid_body_mass_of(&definition, &mass);
        assert_near(mass.centre[0], 0.4, 1e-14);
        assert_near(mass.centre[1], -0.3, 1e-14);
        // a 48-gon of quad4; parabolas through three points of the circle otherwise
        const double angle = 2.0 * pi / 48.0, polygon = 24.0 * sin(angle) * 0.125 * 0.125;
        const double area = types[k] == ELEMENT_QUAD4 ? polygon : pi * 0.125 * 0.125;
        assert_near(mass.mass / 1.3 / area, 1.0, types[k] == ELEMENT_QUAD4 ? 1e-13 : 1e-5);
        const double inertia = types[k] == ELEMENT_QUAD4
                                   ? mass.mass * 0.125 * 0.125 * (2.0 + cos(angle)) / 6.0
                                   : mass.mass * 0.125 * 0.125 / 2.0;
        assert_near(mass.inertia[2][2] / inertia, 1.0, types[k] == ELEMENT_QUAD4 ? 1e-13 : 1e-5);
        for (size_t e = 0; e < mesh->n_elements; e++)
            for (int c = 0; c < 4; c++)
                assert_true(
                    mesh_jacobian(mesh, e, (double[3]){c % 2 ? 0.99 : -0.99, c / 2 ? 0.99 : -0.99, 0}) > 0.0);
        mesh_reset(mesh);
    }
}

/** Gravity that grows with time, and a force off the centre. */
static void test_fall(void **state)
{
    (void)state;
    struct bench bench;
    block(&bench, 2);
    bench.mesh.rigid.velocity[0] = 0.4;
    bench_load(&bench, NULL, 1, "-9.81*t");
    bench_start(&bench);
    for (int step = 0; step < 80; step++)
        assert_int_equal(bench_step(&bench, 0.01), 0);
    struct solid_rigid rigid;
    assert_true(solid_rigid(bench.solid, 0.0, &rigid));
    assert_near(rigid.centre[0], 0.15 + 0.4 * 0.8, 1e-13);
    assert_near(rigid.velocity[1], -9.81 * 0.5 * 0.64, 1e-12); // the trapezoidal rule is exact for it
    assert_near(rigid.centre[1], 0.35 - 9.81 * 0.512 / 6.0, 1e-3);
    assert_near(rigid.angular_velocity[2], 0.0, 1e-12);
    struct solid_energies energies;
    solid_energies(bench.solid, &energies);
    const double m = 1.7 * 0.21, v = rigid.velocity[1];
    assert_near(energies.kinetic, 0.5 * m * (0.16 + v * v), 1e-12);
    assert_near(energies.external, 0.5 * m * v * v, 1e-12);
    bench_reset(&bench);
}

static double angle_after(int steps)
{
    struct bench bench;
    struct solid_rigid rigid;
    block(&bench, 2);
    bench.mesh.rigid.fixed[0] = bench.mesh.rigid.fixed[1] = true;
    bench_load(&bench, "x+", 1, "0.13");
    bench_start(&bench);
    for (int step = 0; step < steps; step++)
        assert_int_equal(bench_step(&bench, 1.6 / steps), 0);
    solid_rigid(bench.solid, 0.0, &rigid);
    assert_near(rigid.centre[0], 0.15, 1e-13);
    assert_near(rigid.centre[1], 0.35, 1e-13);
    bench_reset(&bench);
    return rigid.rotation[2];
}

/** A pendulum of a kind: held at its centre, a force that does not turn with it: I a'' = F r cos a. Second
 * order in time. */
static void test_pendulum(void **state)
{
    (void)state;
    const double I = 1.7 * 0.21 * (0.09 + 0.49) / 12.0, moment = 0.13 * 0.15;
    double a = 0.0, w = 0.0;
    const double h = 1e-4;
    for (int n = 0; n < 16000; n++) { // classical Runge-Kutta
        const double k1 = moment / I * cos(a), k2 = moment / I * cos(a + 0.5 * h * w),
                     k3 = moment / I * cos(a + 0.5 * h * (w + 0.5 * h * k1)),
                     k4 = moment / I * cos(a + h * (w + 0.5 * h * k2));
        a += h * (w + h * (k1 + k2 + k3) / 6.0);
        w += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
    }
    const double coarse = fabs(angle_after(80) - a), fine = fabs(angle_after(160) - a);
    print_message("angle %g, errors %g, %g\n", a, coarse, fine);
    assert_true(a > 0.5 && coarse > 1e-7 && coarse < 1e-2);
    assert_true(coarse / fine > 3.5 && coarse / fine < 4.5);
}

/** A symmetric top without moments: its axis goes round the angular momentum at L / I1. */
static double top_error(double dt)
{
    struct bench bench;
    const double upper[3] = {0.4, 0.4, 0.9};
    const int cells[3] = {1, 1, 1};
    bench_grid(&bench, 3, upper, cells);
    bench.mesh.material = -1;
    bench.mesh.rigid =
        (struct model_rigid){.present = true, .density = 1.3, .angular_velocity = {0.7, -0.4, 2.3}};
    bench_start(&bench);
    const struct rigid_body *body = body_of(&bench);
    const double I1 = body->mass.inertia[0][0];
    double L[3], axis[3] = {0, 0, 1}, size = 0.0, energy, R[3][3];
    memcpy(L, body->state.momentum, sizeof L);
    for (int i = 0; i < 3; i++)
        size += L[i] * L[i];
    size = sqrt(size);
    struct solid_energies energies;
    solid_energies(bench.solid, &energies);
    energy = energies.kinetic;
    const double end = 7.3;
    const int steps = (int)lround(end / dt);
    for (int n = 0; n < steps; n++)
        assert_int_equal(bench_step(&bench, end / steps), 0);
    // conserved to rounding: momentum, angular momentum, energy
    solid_energies(bench.solid, &energies);
    assert_near(energies.kinetic, energy, 1e-11 * energy);
    for (int i = 0; i < 3; i++) {
        assert_near(body->state.momentum[i], L[i], 1e-12 * size);
        assert_near(body->state.v[i], 0.0, 1e-15);
    }
    // Rodrigues' formula for the axis turned about L
    const double angle = size / I1 * end, c = cos(angle), s = sin(angle);
    double n[3], along = 0.0, error = 0.0;
    for (int i = 0; i < 3; i++) {
        n[i] = L[i] / size;
        along += n[i] * axis[i];
    }
    const double across[3] = {n[1] * axis[2] - n[2] * axis[1], n[2] * axis[0] - n[0] * axis[2],
                              n[0] * axis[1] - n[1] * axis[0]};
    rigid_body_rotation(body->state.q, R);
    for (int i = 0; i < 3; i++)
        error = fmax(error, fabs(R[i][2] - (axis[i] * c + across[i] * s + n[i] * along * (1.0 - c))));
    bench_reset(&bench);
    return error;
}

static void test_top(void **state)
{
    (void)state;
    const double coarse = top_error(0.05), fine = top_error(0.025);
    print_message("axis of the top: errors %g, %g\n", coarse, fine);
    assert_true(fine < 0.02 && coarse / fine > 3.5 && coarse / fine < 4.5);
}

/** Material points: place, velocity and acceleration are those of the rigid motion. */
static void test_points(void **state)
{
    (void)state;
    struct bench bench;
    block(&bench, 3);
    bench.mesh.rigid.angular_velocity[0] = 0.9;
    bench.mesh.rigid.angular_velocity[2] = -1.4;
    bench.mesh.rigid.velocity[1] = 0.2;
    bench_start(&bench);
    static const double X[3] = {0.27, 0.11, 0.83};
    struct solid_place place;
    double d[3][3], v[3][3], a[3][3];
    assert_int_equal(solid_locate(bench.solid, X, &place), 0);
    const double dt = 1e-4;
    for (int n = 0; n < 3; n++) {
        if (n)
            assert_int_equal(bench_step(&bench, dt), 0);
        solid_evaluate(bench.solid, &place, d[n], v[n], a[n]);
    }
    for (int i = 0; i < 3; i++) {
        assert_near((d[2][i] - d[0][i]) / (2.0 * dt), v[1][i], 1e-7);
        assert_near((v[2][i] - v[0][i]) / (2.0 * dt), a[1][i], 1e-6);
    }
    assert_int_equal(solid_locate(bench.solid, (double[3]){0.31, 0.1, 0.1}, &place), STATUS_DECK);
    bench_reset(&bench);
}

/** What is held does not move, whatever pushes. */
static void test_held(void **state)
{
    (void)state;
    struct bench bench;
    block(&bench, 3);
    struct model_rigid *rigid = &bench.mesh.rigid;
    rigid->fixed[0] = rigid->fixed[4] = rigid->fixed[5] = true;
    bench_load(&bench, "x+", 0, "2.1");
    bench_load(&bench, "z+", 1, "0.7");
    bench_start(&bench);
    for (int n = 0; n < 50; n++)
        assert_int_equal(bench_step(&bench, 0.01), 0);
    const struct rigid_body *body = body_of(&bench);
    assert_true(body->state.d[0] == 0.0 && body->state.v[0] == 0.0);
    assert_true(fabs(body->state.d[1]) > 1e-3 && fabs(body->state.omega[0]) > 1e-2);
    assert_true(body->state.omega[1] == 0.0 && body->state.omega[2] == 0.0);
    bench_reset(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mass),     cmocka_unit_test(test_disc), cmocka_unit_test(test_fall),
        cmocka_unit_test(test_pendulum), cmocka_unit_test(test_top),  cmocka_unit_test(test_points),
        cmocka_unit_test(test_held),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
