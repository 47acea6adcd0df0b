// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies that drift and turn in a fluid at rest, periodic in all directions: the momentum of both
// together stays, and the accelerations of the strong scheme reach the same state.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "run/assembly.h"

#include "base/error.h"
#include "base/log.h"
#include "base/parallel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEXT = 4096, STEPS = 40, MOST_NODES = 27 };

/** The places: dimension, domain, box of the fluid, place and motion of the body, attributes of <coupling>.
 */
static const char deck[] =
    "<deck version='1' dim='%d'>\n"
    "<parameters><parameter name='ratio' value='3'/></parameters>\n"
    "<time end='1' step='1.25e-3'/>\n"
    "%s\n"
    "<materials><fluid name='oil' density='1.3' kinematic-viscosity='0.05' sound-speed='10' "
    "background-pressure='130'/></materials>\n"
    "<fluid formulation='transport-velocity' material='oil' spacing='0.05' arithmetic='double'>\n"
    "  <region><difference>%s<inside surface='wet'/></difference></region></fluid>\n"
    "<meshes><mesh name='body'>%s</mesh></meshes>\n"
    "<surfaces><surface name='wet'><skin mesh='body'/></surface></surfaces>\n"
    "<boundaries><wall name='body' surfaces='wet' treatment='%s'/></boundaries>\n"
    "<coupling %s/>\n"
    "<output><fields every='1'/></output>\n"
    "</deck>\n";

static const char *const domains[] = {"<domain lower='0 0' upper='1 1' periodic='x y'/>",
                                      "<domain lower='0 0 0' upper='0.7 0.6 0.65' periodic='x y z'/>"};
static const char *const boxes[] = {"<box lower='0 0' upper='1 1'/>",
                                    "<box lower='0 0 0' upper='0.7 0.6 0.65'/>"};
static const char *const bodies[] = {
    "<grid lower='0.35 0.4' upper='0.65 0.6' cells='3 2'/>"
    "<rigid density='1.3*ratio' velocity='0.4 -0.3' angular-velocity='1.7'/>",
    "<grid lower='0.25 0.2 0.2' upper='0.45 0.4 0.4' cells='2 2 2'/>"
    "<rigid density='1.3*ratio' velocity='0.4 -0.3 0.2' angular-velocity='0.6 1.7 -1.1'/>"};
/** Mass by the fluid's density and the ratio. */
static const double volumes[] = {0.3 * 0.2, 0.2 * 0.2 * 0.2};

struct outcome {
    int status;
    double iterations;  /**< per step */
    double corner[3];   /**< its displacement */
    double velocity[3]; /**< of the centre */
    double drift;       /**< worst change of the momentum of all, by the body's at the start */
    double lost;        /**< change of the body's velocity, by that at the start */
};

/** A field of the body at its first node, and on the mean over all: at its centre, about which its mesh is
 * symmetric. */
static void body_read(const struct assembly *a, const char *name, double first[3], double mean[3])
{
    double nodes[MOST_NODES][3];
    const struct field_group *group = solid_node_fields(a->solids[0]);
    const size_t n = *group->count;
    assert_true(n <= MOST_NODES);
    assert_int_equal(field_read(group, field_find(group, name), nodes), 0);
    memset(mean, 0, 3 * sizeof *mean);
    for (int k = 0; k < 3; ++k) {
        first[k] = nodes[0][k];
        for (size_t i = 0; i < n; ++i)
            mean[k] += nodes[i][k] / (double)n;
    }
}

/** Velocity of the body's centre, and momentum of body and fluid. */
static void momentum_read(struct assembly *a, double mass, double velocity[3], double momentum[3])
{
    const struct particles *block = assembly_particles(a);
    double first[3];
    body_read(a, "Velocity", first, velocity);
    for (int k = 0; k < 3; ++k) {
        momentum[k] = mass * velocity[k];
        for (size_t i = 0; i < block->n; ++i)
            momentum[k] += block->m[i] * block->u[k][i];
    }
}

static double distance(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

static struct outcome run(int dim, const char *treatment, const char *coupling, double ratio)
{
    static const double zero[3];
    struct assembly a;
    struct outcome outcome = {0};
    char text[TEXT], override[64];
    const char *const overrides[] = {override, NULL};
    const double mass = 1.3 * ratio * volumes[dim - 2];
    snprintf(override, sizeof override, "ratio=%g", ratio);
    snprintf(text, sizeof text, deck, dim, domains[dim - 2], boxes[dim - 2], bodies[dim - 2], treatment,
             coupling);
    assert_int_equal(assembly_create(&a, text, overrides), 0);
    assert_int_equal(assembly_start(&a), 0);
    double start[3], velocity[3], momentum[3], unused[3];
    momentum_read(&a, mass, velocity, start);
    const double speed = distance(velocity, zero);
    memcpy(outcome.velocity, velocity, sizeof velocity);
    for (int step = 0; step < STEPS && !outcome.status; ++step) {
        outcome.status = assembly_steps(&a, 1);
        momentum_read(&a, mass, velocity, momentum);
        outcome.drift = fmax(outcome.drift, distance(momentum, start) / (mass * speed));
    }
    outcome.lost = distance(velocity, outcome.velocity) / speed;
    memcpy(outcome.velocity, velocity, sizeof velocity);
    outcome.iterations =
        (double)a.coupling->total_iterations / (double)(a.coupling->steps ? a.coupling->steps : 1);
    body_read(&a, "Displacement", outcome.corner, unused);
    assembly_reset(&a);
    return outcome;
}

static void print(const char *what, int dim, double ratio, const struct outcome *outcome)
{
    print_message("%d-D, ratio %g, %s: status %d, %.2f iterations, corner %g %g %g, momentum of all kept to "
                  "%.1e, the body slowed by %.0f %%\n",
                  dim, ratio, what, outcome->status, outcome->iterations, outcome->corner[0],
                  outcome->corner[1], outcome->corner[2], outcome->drift, 100.0 * outcome->lost);
}

/** What the body loses the fluid gets, to rounding, whichever way its wall is made. */
static void test_momentum(void **state)
{
    (void)state;
    static const char *const treatments[] = {"sliding-particles", "fixed-particles"};
    for (int dim = 2; dim <= 3; ++dim)
        for (int k = 0; k < 2; ++k) {
            const struct outcome outcome = run(dim, treatments[k], "tolerance='1e-9'", 3.0);
            print(treatments[k], dim, 3.0, &outcome);
            assert_int_equal(outcome.status, 0);
            assert_true(outcome.lost > 0.05);
            assert_true(outcome.drift < 1e-12);
        }
}

static void test_accelerations_agree(void **state)
{
    (void)state;
    static const char *const accelerations[] = {"added-mass", "iqn-ils' relaxation='0.5",
                                                "aitken' relaxation='0.5", "constant' relaxation='0.6",
                                                "none"};
    enum { COUNT = sizeof accelerations / sizeof *accelerations };
    static const double ratios[] = {10.0, 1.0};
    for (int dim = 2; dim <= 3; ++dim)
        for (int r = 0; r < 2; ++r) {
            struct outcome outcomes[COUNT];
            for (int k = 0; k < COUNT; ++k) {
                char coupling[128];
                snprintf(coupling, sizeof coupling, "tolerance='1e-11' iterations='60' acceleration='%s'",
                         accelerations[k]);
                outcomes[k] = run(dim, "sliding-particles", coupling, ratios[r]);
                print(accelerations[k], dim, ratios[r], &outcomes[k]);
                assert_int_equal(outcomes[k].status, 0);
                assert_true(distance(outcomes[k].corner, outcomes[0].corner) < 1e-9);
                assert_true(distance(outcomes[k].velocity, outcomes[0].velocity) < 1e-8);
                // of so few unknowns quasi-Newton soon knows everything
                assert_true(k <= 1 || outcomes[0].iterations < outcomes[k].iterations);
            }
        }
}

/** A tenth of the fluid's density. */
static void test_light(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; ++dim) {
        const struct outcome added = run(dim, "sliding-particles", "tolerance='1e-10'", 0.1);
        const struct outcome learned =
            run(dim, "sliding-particles",
                "tolerance='1e-10' iterations='60' acceleration='iqn-ils' relaxation='0.2'", 0.1);
        print("added-mass", dim, 0.1, &added);
        print("iqn-ils", dim, 0.1, &learned);
        assert_int_equal(added.status, 0);
        assert_int_equal(learned.status, 0);
        assert_true(distance(learned.corner, added.corner) < 1e-8);
        assert_true(added.drift < 1e-12);
        assert_true(added.iterations < 8.0 && learned.iterations < 8.0);
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
        cmocka_unit_test(test_momentum),
        cmocka_unit_test(test_accelerations_agree),
        cmocka_unit_test(test_light),
    };
    return cmocka_run_group_tests(tests, quiet, NULL);
}
