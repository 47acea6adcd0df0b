// SPDX-License-Identifier: GPL-3.0-or-later
// A solid whose wall is made of its own material points: every scheme reaches the same state, what the fluid
// loses the walls get, and in the end it moves as behind a sliding wall.
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

/** A block that stands on the floor of a channel, periodic in x and z, in a fluid that a body force drives.
 * The places: element type, formulation, treatment, attributes of <coupling>. */
static const char block_deck[] =
    "<deck version='1' dim='3'>\n"
    "<parameters>\n"
    "  <parameter name='dx' value='0.05'/><parameter name='c' value='10'/><parameter name='ratio' "
    "value='10'/>\n"
    "</parameters>\n"
    "<time end='1' step='0.25*dx/c'><body-force value='9 -3 1'/></time>\n"
    "<domain lower='0 -4*dx 0' upper='0.6 0.5+4*dx 0.5' periodic='x z'/>\n"
    "<materials>\n"
    "  <fluid name='water' density='1.1' kinematic-viscosity='0.02' sound-speed='c' "
    "background-pressure='c^2'/>\n"
    "  <solid name='rubber' density='1.1*ratio' young='4000' poisson='0.35'/>\n"
    "</materials>\n"
    "<fluid formulation='transport-velocity' material='water' spacing='dx' arithmetic='double'>\n"
    "  <region><difference><box lower='0 0 0' upper='0.6 0.5 0.5'/><inside surface='wet'/></difference>"
    "</region></fluid>\n"
    "<meshes><mesh name='block' material='rubber' formulation='%s'>\n"
    "  <grid type='%s' lower='0.2 0 0.15' upper='0.4 0.3 0.35' cells='2 2 2'/>\n"
    "  <set name='root'><box lower='0.2 0 0.15' upper='0.4 0 0.35'/></set><support set='root' fixed='x y "
    "z'/>\n"
    "</mesh></meshes>\n"
    "<surfaces>\n"
    "  <surface name='wet'><skin mesh='block'/></surface>\n"
    "  <surface name='floor'><plane point='0 0 0' normal='0 1 0'/></surface>\n"
    "  <surface name='lid'><plane point='0 0.5 0' normal='0 -1 0'/></surface>\n"
    "</surfaces>\n"
    "<boundaries><wall name='wall' surfaces='wet floor lid' treatment='%s'/></boundaries>\n"
    "<coupling %s/>\n"
    "<output><fields every='1'/></output>\n"
    "</deck>\n";

/** What a run ended with. */
struct outcome {
    int status;
    double mean; /**< iterations per step */
    double tip[3], force[3];
    double defect; /**< worst balance of momentum in a step */
};

static struct outcome run(const char *deck, const char *ratio)
{
    struct assembly a;
    struct outcome outcome = {0};
    const char *const overrides[] = {ratio, NULL};
    assert_int_equal(assembly_create(&a, deck, overrides), 0);
    assert_int_equal(assembly_start(&a), 0);
    for (int step = 0; step < STEPS && !outcome.status; ++step) {
        double defect = 0.0;
        outcome.status = assembly_step_balanced(&a, &defect);
        outcome.defect = fmax(outcome.defect, defect);
    }
    outcome.mean = (double)a.coupling->total_iterations / (double)(a.coupling->steps ? a.coupling->steps : 1);
    const size_t last = solid_mesh(a.solids[0])->n_nodes - 1;
    const struct surface *wet = assembly_surface(&a, "wet");
    for (int k = 0; k < 3; ++k) {
        outcome.tip[k] = assembly_nodes(&a, "Displacement")[last][k];
        for (size_t p = 0; p < wet->n_points; ++p)
            outcome.force[k] += wet->load[p][k];
    }
    assembly_reset(&a);
    return outcome;
}

static struct outcome run_beam(const char *treatment, const char *coupling, const char *ratio)
{
    char text[TEXT];
    snprintf(text, sizeof text, beam_deck, "transport-velocity", treatment, "sliding-particles", coupling);
    return run(text, ratio);
}

static double distance(const struct outcome *a, const struct outcome *b)
{
    return hypot(hypot(a->tip[0] - b->tip[0], a->tip[1] - b->tip[1]), a->tip[2] - b->tip[2]);
}

static double size(const struct outcome *a)
{
    return hypot(hypot(a->tip[0], a->tip[1]), a->tip[2]);
}

static void test_schemes_agree(void **state)
{
    (void)state;
    static const char *const accelerations[] = {"added-mass", "iqn-ils' relaxation='0.5",
                                                "aitken' relaxation='0.5", "constant' relaxation='0.6",
                                                "none"};
    static const char *const ratios[] = {"ratio=10", "ratio=1"};
    enum { COUNT = sizeof accelerations / sizeof *accelerations };
    for (int r = 0; r < 2; ++r) {
        struct outcome outcomes[COUNT];
        for (int k = 0; k < COUNT; ++k) {
            char coupling[128];
            snprintf(coupling, sizeof coupling, "tolerance='1e-10' iterations='60' acceleration='%s'",
                     accelerations[k]);
            outcomes[k] = run_beam("fixed-particles", coupling, ratios[r]);
            print_message("%s, %s': %.2f iterations, status %d, tip %g %g\n", ratios[r], accelerations[k],
                          outcomes[k].mean, outcomes[k].status, outcomes[k].tip[0], outcomes[k].tip[1]);
            assert_int_equal(outcomes[k].status, 0);
            assert_true(distance(&outcomes[k], &outcomes[0]) < 1e-9);
            assert_true(outcomes[k].defect < 1e-13);
            assert_true(outcomes[0].mean <= 1.2 * outcomes[k].mean);
        }
        assert_true(size(&outcomes[0]) > 1e-3);
        assert_true(outcomes[0].mean < 5.5);
    }
}

/** Loads spread over all nodes near the wall, so that plain iteration bears more than with sliding particles;
 * a tenth of the fluid's density it does not. */
static void test_light(void **state)
{
    (void)state;
    char coupling[128];
    struct outcome outcomes[3];
    static const char *const accelerations[] = {"added-mass", "iqn-ils' relaxation='0.5", "none"};
    for (int k = 0; k < 3; ++k) {
        snprintf(coupling, sizeof coupling, "tolerance='1e-9' iterations='60' acceleration='%s'",
                 accelerations[k]);
        outcomes[k] = run_beam("fixed-particles", coupling, "ratio=0.1");
        print_message("%s': %.2f iterations, status %d, tip %g %g\n", accelerations[k], outcomes[k].mean,
                      outcomes[k].status, outcomes[k].tip[0], outcomes[k].tip[1]);
    }
    for (int k = 0; k < 2; ++k) {
        assert_int_equal(outcomes[k].status, 0);
        assert_true(outcomes[k].mean < 6.5 && outcomes[k].defect < 1e-13);
    }
    assert_true(distance(&outcomes[1], &outcomes[0]) < 1e-8);
    assert_int_equal(outcomes[2].status, STATUS_NUMERICAL);
}

static void test_sub_cycled(void **state)
{
    (void)state;
    const struct outcome strong = run_beam("fixed-particles", "tolerance='1e-10'", "ratio=10");
    for (int every = 1; every <= 4; every *= 2) {
        char coupling[64];
        snprintf(coupling, sizeof coupling, "scheme='sub-cycled' solid-every='%d'", every);
        const struct outcome sub = run_beam("fixed-particles", coupling, "ratio=10");
        print_message("a step of the solid every %d: the tip is off by %g\n", every,
                      distance(&sub, &strong) / size(&strong));
        assert_int_equal(sub.status, 0);
        assert_true(distance(&sub, &strong) < 0.05 * size(&strong));
        assert_true(sub.defect < 1e-13);
    }
}

/** Neither force nor motion is far from those of sliding particles. */
static void test_near_sliding(void **state)
{
    (void)state;
    const struct outcome fixed = run_beam("fixed-particles", "tolerance='1e-9'", "ratio=10");
    const struct outcome sliding = run_beam("sliding-particles", "tolerance='1e-9'", "ratio=10");
    print_message("tip %g %g and %g %g, force %g %g and %g %g\n", fixed.tip[0], fixed.tip[1], sliding.tip[0],
                  sliding.tip[1], fixed.force[0], fixed.force[1], sliding.force[0], sliding.force[1]);
    assert_true(distance(&fixed, &sliding) < 0.2 * size(&sliding));
}

static void test_three_dimensions(void **state)
{
    (void)state;
    static const char *const elements[][2] = {{"eas", "hex8"}, {"full", "tet10"}, {"full", "hex27"}};
    struct outcome outcomes[4];
    for (int k = 0; k < 4; ++k) {
        char text[TEXT];
        snprintf(text, sizeof text, block_deck, elements[k % 3][0], elements[k % 3][1],
                 k == 3 ? "sliding-particles" : "fixed-particles", "tolerance='1e-9'");
        outcomes[k] = run(text, "ratio=10");
        print_message("%s, %s: %.2f iterations, tip %g %g %g\n", elements[k % 3][1],
                      k == 3 ? "sliding" : "fixed", outcomes[k].mean, outcomes[k].tip[0], outcomes[k].tip[1],
                      outcomes[k].tip[2]);
        assert_int_equal(outcomes[k].status, 0);
        assert_true(outcomes[k].defect < 1e-13);
        assert_true(outcomes[k].mean < 5.0);
    }
}

/** A fluid, periodic in x and y, around a block that a linear motion stretches and turns: the places are for
 * what says that the block is a mesh, or particles of their own. */
static const char led_deck[] =
    "<deck version='1' dim='2'>\n"
    "<time end='1' step='1e-3'/>\n"
    "<domain lower='0 0' upper='1 1' periodic='x y'/>\n"
    "<materials><fluid name='oil' density='1.3' kinematic-viscosity='0.05' sound-speed='10' "
    "background-pressure='130'/><solid name='rubber' density='2' young='900' poisson='0.3'/></materials>\n"
    "<fluid formulation='transport-velocity' material='oil' spacing='0.05' arithmetic='double'>\n"
    "  <region><difference><box lower='0 0' upper='1 1'/><box lower='0.4 0.35' upper='0.6 0.6'/></difference>"
    "</region></fluid>\n"
    "%s<output><fields every='1'/></output>\n"
    "</deck>\n";

#define LED_MOTION                                                                                           \
    "<displacement value='3*t^2*x-2*t^2*y t^2*x-4*t^2*y' velocity='6*t*x-4*t*y 2*t*x-8*t*y' "                \
    "acceleration='6*x-4*y 2*x-8*y'/>"

/** Particles by id. */
static double *places_of(struct assembly *a)
{
    const struct particles *block = fluid_particles(a->fluid);
    double *places = memory_create(2 * block->n, sizeof *places);
    assert_non_null(places);
    for (size_t i = 0; i < block->n; ++i)
        for (size_t k = 0; k < 2; ++k)
            places[2 * (size_t)block->id[i] + k] = block->x[k][i];
    return places;
}

/** A mesh whose nodes are all led acts as wall particles that the deck leads in the same way. */
static void test_led(void **state)
{
    (void)state;
    static const char *const blocks[] = {
        "<boundaries><wall name='block' treatment='fixed-particles'><region>"
        "<box lower='0.4 0.35' upper='0.6 0.6'/></region>" LED_MOTION "</wall></boundaries>\n",
        "<meshes><mesh name='block' material='rubber' formulation='full'>"
        "<grid type='quad9' lower='0.4 0.35' upper='0.6 0.6' cells='3 2'/>"
        "<set name='all'><box lower='0 0' upper='1 1'/></set><support set='all'>" LED_MOTION "</support>"
        "</mesh></meshes>\n<surfaces><surface name='wet'><skin mesh='block'/></surface></surfaces>\n"
        "<boundaries><wall name='block' surfaces='wet' treatment='fixed-particles'/></boundaries>\n"};
    double *places[3], off = 0.0, moved = 0.0;
    size_t n = 0;
    for (int k = 0; k < 2; ++k) {
        struct assembly a;
        char text[TEXT];
        snprintf(text, sizeof text, led_deck, blocks[k]);
        assert_int_equal(assembly_create(&a, text, NULL), 0);
        assert_int_equal(assembly_start(&a), 0);
        if (k == 0)
            places[2] = places_of(&a);
        assert_int_equal(assembly_steps(&a, STEPS), 0);
        places[k] = places_of(&a);
        n = 2 * fluid_particles(a.fluid)->n;
        assert_int_equal(n, 2 * (400 - 20));
        assembly_reset(&a);
    }
    for (size_t i = 0; i < n; ++i) {
        off = fmax(off, fabs(places[1][i] - places[0][i]));
        moved = fmax(moved, fabs(places[0][i] - places[2][i]));
    }
    print_message("particles moved by up to %g and differ by %g\n", moved, off);
    assert_true(moved > 1e-3 && off < 1e-11);
    for (int k = 0; k < 3; ++k)
        memory_free(places[k]);
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
        cmocka_unit_test(test_schemes_agree),    cmocka_unit_test(test_light),
        cmocka_unit_test(test_sub_cycled),       cmocka_unit_test(test_near_sliding),
        cmocka_unit_test(test_three_dimensions), cmocka_unit_test(test_led),
    };
    return cmocka_run_group_tests(tests, quiet, NULL);
}
