// SPDX-License-Identifier: GPL-3.0-or-later
// The strong scheme on a clamped beam in a periodic channel: its accelerations reach the same state, its
// limit, its determinism, and its balance of momentum.
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

enum { TEXT = 4096, STEPS = 40 };

static void beam_create(struct assembly *a, const char *coupling, const char *ratio)
{
    char text[TEXT];
    const char *const overrides[] = {ratio, NULL};
    snprintf(text, sizeof text, beam_deck, "transport-velocity", "sliding-particles", "sliding-particles",
             coupling);
    assert_int_equal(assembly_create(a, text, overrides), 0);
    assert_int_equal(assembly_start(a), 0);
}

/** What a run ended with. */
struct outcome {
    int status;
    double mean; /**< iterations per step */
    double tip[2], velocity[2], force[2];
};

/** With these attributes of <coupling>: when to stop, and how to get there. */
static struct outcome run_to(const char *criterion, const char *acceleration, const char *ratio)
{
    struct assembly a;
    struct outcome outcome = {0};
    char coupling[256];
    snprintf(coupling, sizeof coupling, "%s iterations='60' %s", criterion, acceleration);
    beam_create(&a, coupling, ratio);
    outcome.status = assembly_steps(&a, STEPS);
    outcome.mean = (double)a.coupling->total_iterations / (double)(a.coupling->steps ? a.coupling->steps : 1);
    const size_t tip = solid_mesh(a.solids[0])->n_nodes - 1;
    const struct surface *wet = assembly_surface(&a, "wet");
    for (int k = 0; k < 2; ++k) {
        outcome.tip[k] = assembly_nodes(&a, "Displacement")[tip][k];
        outcome.velocity[k] = assembly_nodes(&a, "Velocity")[tip][k];
        for (size_t p = 0; p < wet->n_points; ++p)
            outcome.force[k] += wet->load[p][k];
    }
    assembly_reset(&a);
    return outcome;
}

static struct outcome run(const char *acceleration, const char *ratio)
{
    return run_to("tolerance='1e-10'", acceleration, ratio);
}

static void assert_same(const struct outcome *a, const struct outcome *b)
{
    assert_int_equal(a->status, 0);
    assert_int_equal(b->status, 0);
    for (int k = 0; k < 2; ++k) {
        assert_true(fabs(a->tip[k] - b->tip[k]) < 1e-9);
        assert_true(fabs(a->velocity[k] - b->velocity[k]) < 1e-8);
        assert_true(fabs(a->force[k] - b->force[k]) < 1e-5);
    }
}

static void test_accelerations_agree(void **state)
{
    (void)state;
    static const char *const ratios[] = {"ratio=10", "ratio=1"};
    for (int r = 0; r < 2; ++r) {
        const struct outcome added = run("acceleration='added-mass'", ratios[r]);
        const struct outcome aitken = run("acceleration='aitken' relaxation='0.5'", ratios[r]);
        const struct outcome quasi_newton = run("acceleration='iqn-ils' relaxation='0.5'", ratios[r]);
        const struct outcome constant = run("acceleration='constant' relaxation='0.6'", ratios[r]);
        const struct outcome none = run("acceleration='none'", ratios[r]);
        print_message("%s: iterations added-mass %.2f, iqn-ils %.2f, aitken %.2f, constant %.2f, none %.2f; "
                      "tip %g %g\n",
                      ratios[r], added.mean, quasi_newton.mean, aitken.mean, constant.mean,
                      none.status ? INFINITY : none.mean, added.tip[0], added.velocity[0]);
        assert_true(fabs(added.tip[0]) > 1e-3);
        assert_same(&aitken, &added);
        assert_same(&constant, &added);
        assert_same(&quasi_newton, &added);
        assert_true(quasi_newton.mean < constant.mean);
        assert_true(added.mean < aitken.mean && added.mean < constant.mean);
        if (r == 1) { // as heavy as the fluid at this spacing: plain iteration diverges
            assert_int_equal(none.status, STATUS_NUMERICAL);
            continue;
        }
        assert_same(&none, &added);
        assert_true(added.mean < none.mean);
    }
}

/** Learning from more steps saves iterations, and where the iteration ends does not depend on that, however
 * small the changes that it learned from. */
static void test_reused_steps(void **state)
{
    (void)state;
    static const char *const more[] = {"reused-steps='5'", "reused-steps='0'", "filter='1e-6'"};
    const struct outcome added = run_to("tolerance='1e-12'", "acceleration='added-mass'", "ratio=10");
    struct outcome outcomes[3];
    for (int k = 0; k < 3; ++k) {
        char attributes[128];
        snprintf(attributes, sizeof attributes, "acceleration='iqn-ils' relaxation='0.5' %s", more[k]);
        outcomes[k] = run_to("tolerance='1e-11'", attributes, "ratio=10");
        assert_same(&outcomes[k], &added);
    }
    print_message("iterations with 5 steps reused %.2f, with none %.2f, hardly filtered %.2f\n",
                  outcomes[0].mean, outcomes[1].mean, outcomes[2].mean);
    assert_true(outcomes[0].mean < outcomes[1].mean);
}

/** The forces alone, the displacement alone, or both. */
static void test_criteria(void **state)
{
    (void)state;
    const char *const added_mass = "acceleration='added-mass'";
    const struct outcome fine = run(added_mass, "ratio=10");
    const struct outcome force = run_to("force-tolerance='1e-8'", added_mass, "ratio=10");
    const struct outcome coarse = run_to("tolerance='1e-3'", added_mass, "ratio=10");
    const struct outcome coarse_force = run_to("force-tolerance='1'", added_mass, "ratio=10");
    const struct outcome both = run_to("tolerance='1e-3' force-tolerance='1e-8'", added_mass, "ratio=10");
    print_message("iterations: displacement %.2f, force %.2f; coarse %.2f, %.2f; both %.2f\n", fine.mean,
                  force.mean, coarse.mean, coarse_force.mean, both.mean);
    assert_same(&force, &fine);
    assert_true(coarse.mean < 2.0 && coarse.mean >= 1.0);
    assert_true(coarse_force.mean == 2.0); // there is no change of the first forces
    assert_true(both.mean == force.mean);  // the stricter one decides
    assert_memory_equal(both.tip, force.tip, sizeof both.tip);
}

/** Where a step ends does not depend on the prediction, how soon does. */
static void test_predictors(void **state)
{
    (void)state;
    static const char *const names[] = {"linear-acceleration", "constant-acceleration", "zero-acceleration"};
    struct outcome outcomes[3];
    for (int k = 0; k < 3; ++k) {
        char attributes[128];
        snprintf(attributes, sizeof attributes, "acceleration='added-mass' predictor='%s'", names[k]);
        outcomes[k] = run(attributes, "ratio=10");
        const double off =
            hypot(outcomes[k].tip[0] - outcomes[0].tip[0], outcomes[k].tip[1] - outcomes[0].tip[1]);
        print_message("%s: %.2f iterations, tip off by %g m\n", names[k], outcomes[k].mean, off);
        /* the shares of facets are those of the predicted place */
        assert_true(outcomes[k].status == 0 && off < 1e-6);
    }
    assert_true(outcomes[0].mean < outcomes[2].mean && outcomes[1].mean < outcomes[2].mean);
}

static void test_limit(void **state)
{
    (void)state;
    struct assembly a;
    char said[TEXT];
    beam_create(&a, "acceleration='none' iterations='2' tolerance='1e-12'", "ratio=10");
    assembly_listen();
    assert_int_equal(assembly_steps(&a, 1), STATUS_NUMERICAL);
    assembly_heard(said, sizeof said);
    assert_non_null(strstr(said, "the coupling did not converge at t = 0.00125 s"));
    assert_non_null(strstr(said, "after 2 iterations, tolerance 1e-12"));
    assert_non_null(strstr(said, "added-mass"));
    assembly_reset(&a);
    beam_create(&a, "iterations='3' force-tolerance='1e-14'", "ratio=10");
    assembly_listen();
    assert_int_equal(assembly_steps(&a, 1), STATUS_NUMERICAL);
    assembly_heard(said, sizeof said);
    assert_non_null(strstr(said, "after 3 iterations, change of the force "));
    assert_non_null(strstr(said, "; try a smaller step or more iterations"));
    assert_non_null(strstr(said, "force-tolerance 1e-14 N/m"));
    assembly_reset(&a);
}

/** Particles by id, nodes and loads of a run. */
static double *bytes(const char *coupling, int threads, size_t *size)
{
    struct assembly a;
    parallel_setup(threads);
    beam_create(&a, coupling, "ratio=10");
    assert_int_equal(assembly_steps(&a, STEPS), 0);
    const struct particles *block = fluid_particles(a.fluid);
    const struct surface *wet = assembly_surface(&a, "wet");
    const size_t n_nodes = solid_mesh(a.solids[0])->n_nodes;
    *size = 4 * block->n + 3 * n_nodes + 3 * wet->n_points;
    double *result = memory_create(*size, sizeof *result);
    assert_non_null(result);
    for (size_t i = 0; i < block->n; ++i)
        for (size_t k = 0; k < 2; ++k) {
            result[4 * (size_t)block->id[i] + k] = block->x[k][i];
            result[4 * (size_t)block->id[i] + 2 + k] = block->u[k][i];
        }
    memcpy(result + 4 * block->n, assembly_nodes(&a, "Displacement"), n_nodes * sizeof(double[3]));
    memcpy(result + 4 * block->n + 3 * n_nodes, wet->load, wet->n_points * sizeof(double[3]));
    assert_true(fluid_rebuilds(a.fluid) > 1);
    assembly_reset(&a);
    return result;
}

static void test_threads(void **state)
{
    (void)state;
    static const char *const couplings[] = {"acceleration='added-mass'", "acceleration='iqn-ils'"};
    for (int c = 0; c < 2; ++c) {
        size_t size, other_size;
        double *one = bytes(couplings[c], 1, &size);
        for (int threads = 2; threads <= 3; ++threads) {
            double *other = bytes(couplings[c], threads, &other_size);
            assert_int_equal(size, other_size);
            assert_memory_equal(one, other, size * sizeof *one);
            memory_free(other);
        }
        memory_free(one);
    }
    parallel_setup(1);
}

/** In every step what the fluid loses the walls get, to rounding, whether the iteration was exact or not; and
 * the accepted surface is where the solid is. */
static void test_balance(void **state)
{
    (void)state;
    static const char *const couplings[] = {"tolerance='1e-10'", "tolerance='1e-3'"};
    for (int c = 0; c < 2; ++c) {
        struct assembly a;
        double worst = 0.0;
        beam_create(&a, couplings[c], "ratio=10");
        for (int step = 0; step < STEPS; ++step) {
            double defect;
            assert_int_equal(assembly_step_balanced(&a, &defect), 0);
            worst = fmax(worst, defect);
        }
        print_message("%s: momentum balances to %g\n", couplings[c], worst);
        assert_true(worst < 1e-13);
        const struct surface *wet = assembly_surface(&a, "wet");
        for (size_t p = 0; p < wet->n_points; ++p)
            if (wet->mesh[p] >= 0)
                assert_memory_equal(wet->level[1].x[p], solid_positions(a.solids[0])[wet->mesh_node[p]],
                                    sizeof(double[3]));
        assembly_reset(&a);
    }
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
        cmocka_unit_test(test_accelerations_agree),
        cmocka_unit_test(test_reused_steps),
        cmocka_unit_test(test_criteria),
        cmocka_unit_test(test_predictors),
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_balance),
    };
    return cmocka_run_group_tests(tests, quiet, NULL);
}
