// SPDX-License-Identifier: GPL-3.0-or-later
// The solid on steps of several fluid steps: what it shares with the strong scheme, what each gives the
// other, and what keeps light solids stable.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "run/assembly.h"
#include "run/beam_deck.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEXT = 4096, STEPS = 48 };

static void beam_create(struct assembly *a, const char *coupling, const char *ratio)
{
    char text[TEXT], undamped[TEXT];
    const char *const overrides[] = {ratio, NULL};
    snprintf(text, sizeof text, beam_deck, "transport-velocity", "sliding-particles", "sliding-particles",
             coupling);
    // forces at both ends of a step weigh the same: impulses are exact
    const char *mesh = strstr(text, "newton-tolerance");
    assert_non_null(mesh);
    snprintf(undamped, sizeof undamped, "%.*srho-infinity='1' %s", (int)(mesh - text), text, mesh);
    assert_int_equal(assembly_create(a, undamped, overrides), 0);
    assert_int_equal(assembly_start(a), 0);
}

static int run(const char *coupling, const char *ratio, long steps, double tip[2])
{
    struct assembly a;
    beam_create(&a, coupling, ratio);
    const int status = assembly_steps(&a, steps);
    const size_t last = solid_mesh(a.solids[0])->n_nodes - 1;
    for (int k = 0; k < 2; ++k)
        tip[k] = assembly_nodes(&a, "Displacement")[last][k];
    if (!status)
        assert_int_equal(a.coupling->total_iterations >= a.coupling->steps, 1);
    assembly_reset(&a);
    return status;
}

/** The shorter the solid's steps, the closer to the strong scheme; with them four fluid steps long too. */
static void test_near_strong_coupling(void **state)
{
    (void)state;
    double strong[2], tip[2], distance[3];
    assert_int_equal(run("tolerance='1e-10'", "ratio=10", STEPS, strong), 0);
    for (int k = 0; k < 3; ++k) {
        char coupling[96];
        snprintf(coupling, sizeof coupling, "scheme='sub-cycled' solid-every='%d'", 1 << k);
        assert_int_equal(run(coupling, "ratio=10", STEPS, tip), 0);
        distance[k] = hypot(tip[0] - strong[0], tip[1] - strong[1]) / hypot(strong[0], strong[1]);
        print_message("a step of the solid every %d: the tip is off by %g\n", 1 << k, distance[k]);
    }
    assert_true(hypot(strong[0], strong[1]) > 1e-2);
    assert_true(distance[0] < 0.003 && distance[1] < 0.01 && distance[2] < 0.03);
    assert_true(distance[0] < distance[2]);
}

/** Without the added mass in its only solve a light solid is lost; with it it follows the strong scheme. */
static void test_light_solid(void **state)
{
    (void)state;
    static const char *const ratios[] = {"ratio=1", "ratio=0.3"};
    for (int r = 0; r < 2; ++r) {
        double strong[2], tip[2];
        assert_int_equal(run("tolerance='1e-9'", ratios[r], STEPS, strong), 0);
        for (int every = 1; every <= 4; every *= 2) {
            char coupling[96];
            snprintf(coupling, sizeof coupling, "scheme='sub-cycled' solid-every='%d'", every);
            assert_int_equal(run(coupling, ratios[r], STEPS, tip), 0);
            const double distance = hypot(tip[0] - strong[0], tip[1] - strong[1]);
            print_message("%s, every %d: off by %g\n", ratios[r], every,
                          distance / hypot(strong[0], strong[1]));
            assert_true(distance < 0.05 * hypot(strong[0], strong[1]));
        }
        assert_int_equal(
            run("scheme='sub-cycled' solid-every='2' acceleration='none'", ratios[r], STEPS, tip),
            STATUS_NUMERICAL);
    }
}

/** Momentum of the solid, kg m/s (2-D: per metre of depth), from the consistent mass of its quads. */
static void momentum_take(const struct assembly *a, double density, double momentum[2])
{
    const struct mesh *mesh = solid_mesh(a->solids[0]);
    const double(*v)[3] = assembly_nodes(a, "Velocity");
    momentum[0] = momentum[1] = 0.0;
    for (size_t e = 0; e < mesh->n_elements; ++e) {
        const int32_t *n = &mesh->connectivity[e * 4];
        // the cells of the grid are rectangles: a quarter of the mass for each node
        const double area =
            fabs(mesh->X[n[2]][0] - mesh->X[n[0]][0]) * fabs(mesh->X[n[2]][1] - mesh->X[n[0]][1]);
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 2; ++k)
                momentum[k] += 0.25 * density * area * v[n[i]][k];
    }
}

/** Forces of the support at an end of a step, apart from what they take over from the fluid's mean load on
 * the nodes that are held, which is that of one step or the next; and that load. */
static void support_take(const struct assembly *a, double support[2], double load[2])
{
    const struct mesh *mesh = solid_mesh(a->solids[0]);
    const double(*reaction)[3] = assembly_nodes(a, "ReactionForce");
    const double(*mean)[3] = assembly_nodes(a, "InterfaceForce");
    for (int k = 0; k < 2; ++k) {
        support[k] = load[k] = 0.0;
        for (size_t n = 0; n < mesh->n_nodes; ++n)
            if (mesh->X[n][1] == 0.0) {
                support[k] += reaction[n][k] + mean[n][k];
                load[k] += mean[n][k];
            }
    }
}

/** Impulse of the fluid on the points that the solid moves since its step began. */
static void impulse_take(const struct surface *wet, double impulse[2])
{
    impulse[0] = impulse[1] = 0.0;
    for (size_t p = 0; p < wet->n_points; ++p)
        for (int k = 0; k < 2 && wet->mesh[p] >= 0; ++k)
            impulse[k] += wet->impulse[p][k];
}

/** In a fluid step the walls get what the fluid loses, to rounding; in a step of the solid its momentum
 * changes by the fluid's impulse, its weight and the forces of its support. */
static void test_balance(void **state)
{
    (void)state;
    enum { EVERY = 3 };
    static const char *const couplings[] = {"scheme='sub-cycled' solid-every='3' acceleration='none'",
                                            "scheme='sub-cycled' solid-every='3' tolerance='1e-12'"};
    for (int c = 0; c < 2; ++c) {
        struct assembly a;
        double before[2], after[2], support_before[2], support[2], load[2], impulse[2];
        double worst_fluid = 0.0, worst_solid = 0.0, lost[2] = {0.0, 0.0}, flow = 0.0, largest_lost = 0.0;
        beam_create(&a, couplings[c], "ratio=10");
        const double dt = a.model->time.step, density = a.model->solid_materials[0].density;
        const double mass = density * 0.15 * 0.4;
        for (int step = 1; step <= STEPS; ++step) {
            double defect;
            if (step % EVERY == 1) {
                momentum_take(&a, density, before);
                support_take(&a, support_before, load);
            }
            assert_int_equal(assembly_step_balanced(&a, &defect), 0);
            worst_fluid = fmax(worst_fluid, defect);
            if (step % EVERY != 0)
                continue;
            momentum_take(&a, density, after);
            support_take(&a, support, load);
            impulse_take(assembly_surface(&a, "wet"), impulse);
            for (int k = 0; k < 2; ++k) {
                const double weight = mass * expression_value(a.model->time.body_force[k], NULL, a.t);
                const double held = 0.5 * (support_before[k] + support[k]) - load[k];
                const double change = after[k] - before[k] - impulse[k] - EVERY * dt * (weight + held);
                if (step > EVERY) { // the support had no force yet when all began
                    worst_solid = fmax(worst_solid, fabs(change));
                    flow = fmax(flow, fabs(impulse[k]));
                    lost[k] += change;
                    largest_lost = fmax(largest_lost, fabs(lost[k]));
                }
            }
        }
        print_message("%s: fluid %g, solid %g, adding up to %g of an impulse of %g\n", couplings[c],
                      worst_fluid, worst_solid, largest_lost, flow);
        assert_true(worst_fluid < 1e-13);
        assert_true(flow > 1e-3);
        if (c == 0)
            assert_true(worst_solid < 1e-9 * flow);
        else // what the added mass counts in advance does not grow with time
            assert_true(largest_lost < 3.0 * worst_solid && worst_solid < 0.2 * flow);
        assembly_reset(&a);
    }
}

/** Inside a step of the solid its state stays, surfaces go on; at its end they are where the solid is, and
 * loads are those of the last evaluation. */
static void test_inside_a_step(void **state)
{
    (void)state;
    struct assembly a;
    beam_create(&a, "scheme='sub-cycled' solid-every='4'", "ratio=10");
    const struct surface *wet = assembly_surface(&a, "wet");
    const size_t last = solid_mesh(a.solids[0])->n_nodes - 1;
    assert_int_equal(assembly_steps(&a, 8), 0);
    const double tip = solid_positions(a.solids[0])[last][0], dt = a.model->time.step;
    double place = -1.0;
    for (size_t p = 0; p < wet->n_points; ++p)
        if (wet->mesh_node[p] == (int32_t)last)
            place = (double)p;
    assert_true(place >= 0.0);
    const size_t p = (size_t)place;
    assert_true(wet->shown == &wet->level[1] && wet->shown->x[p][0] == tip);
    assert_memory_equal(wet->load, wet->load_previous, wet->n_points * sizeof *wet->load);
    double before = tip;
    for (int step = 1; step <= 3; ++step) {
        assert_int_equal(assembly_steps(&a, 1), 0);
        assert_true(solid_positions(a.solids[0])[last][0] == tip);
        assert_true(wet->shown == &wet->now && wet->shown->x[p][0] > before);
        assert_true(fabs(wet->shown->t - a.t) < 1e-12);
        assert_true(fabs(a.coupling->solids_behind - step * dt) < 1e-12);
        assert_true(a.coupling->residual == 0.0 && a.coupling->iterations == 1);
        before = wet->shown->x[p][0];
    }
    assert_int_equal(assembly_steps(&a, 1), 0);
    assert_true(a.coupling->solids_behind == 0.0 && a.coupling->residual > 0.0);
    assert_true(wet->shown == &wet->level[1]);
    assert_memory_equal(wet->level[1].x[p], solid_positions(a.solids[0])[last], sizeof(double[3]));
    assert_true(solid_positions(a.solids[0])[last][0] > tip);
    assembly_reset(&a);
}

static void test_limit(void **state)
{
    (void)state;
    struct assembly a;
    char said[TEXT];
    beam_create(&a, "scheme='sub-cycled' solid-every='4' iterations='1' tolerance='1e-14'", "ratio=10");
    assembly_listen();
    assert_int_equal(assembly_steps(&a, 3), 0);
    assert_int_equal(assembly_steps(&a, 1), STATUS_NUMERICAL);
    assembly_heard(said, sizeof said);
    assert_non_null(strstr(said, "the solids' step to t = 0.005 s did not converge"));
    assembly_reset(&a);
}

/** Particles by id and nodes of a run. */
static double *bytes(int threads, size_t *size)
{
    struct assembly a;
    parallel_setup(threads);
    beam_create(&a, "scheme='sub-cycled' solid-every='3'", "ratio=1");
    assert_int_equal(assembly_steps(&a, STEPS - 1), 0);
    const struct particles *block = fluid_particles(a.fluid);
    const size_t n_nodes = solid_mesh(a.solids[0])->n_nodes;
    *size = 2 * block->n + 3 * n_nodes;
    double *result = memory_create(*size, sizeof *result);
    assert_non_null(result);
    for (size_t i = 0; i < block->n; ++i)
        for (size_t k = 0; k < 2; ++k)
            result[2 * (size_t)block->id[i] + k] = block->x[k][i];
    memcpy(result + 2 * block->n, assembly_nodes(&a, "Displacement"), n_nodes * sizeof(double[3]));
    assert_true(fluid_rebuilds(a.fluid) > 1);
    assembly_reset(&a);
    return result;
}

static void test_threads(void **state)
{
    (void)state;
    size_t size, other_size;
    double *one = bytes(1, &size), *other = bytes(3, &other_size);
    assert_int_equal(size, other_size);
    assert_memory_equal(one, other, size * sizeof *one);
    memory_free(one);
    memory_free(other);
    parallel_setup(1);
}

static int quiet(void **state)
{
    (void)state;
    log_set_level(LOG_ERROR);
    parallel_setup(1);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_near_strong_coupling),
        cmocka_unit_test(test_light_solid),
        cmocka_unit_test(test_balance),
        cmocka_unit_test(test_inside_a_step),
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, quiet, NULL);
}
