// SPDX-License-Identifier: GPL-3.0-or-later
// Plane Poiseuille flow through an inflow and an outflow, with the whole engine.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "run/assembly.h"

#include "base/error.h"
#include "base/log.h"
#include "base/parallel.h"
#include "fluid/fluid_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** Height 0.6 m, 12 spacings; mean velocity 1 m/s, Reynolds number 6; length 1.2 m. Places: initial velocity,
 * walls' treatment, direction of the flow (inflow at, into; outflow at, into), velocity rule, pressure. */
static const char deck_format[] =
    "<deck version='1' dim='2'>\n"
    "<parameters><parameter name='dx' value='0.05'/><parameter name='c' value='25'/>\n"
    "<function name='u' value='6*y*(0.6-y)/0.36'/></parameters>\n"
    "<time end='100' step='0.25*dx/c'/>\n"
    "<domain lower='-0.35 -0.2' upper='1.55 0.8'/>\n"
    "<materials><fluid name='f' density='1.2' kinematic-viscosity='0.1' sound-speed='c' "
    "background-pressure='1.2*c^2'/></materials>\n"
    "<fluid formulation='transport-velocity' material='f' spacing='dx'>\n"
    "  <region velocity='%s*u 0'><box lower='0 0' upper='1.2 0.6'/></region></fluid>\n"
    "<surfaces><surface name='bottom'><plane point='0 0' normal='0 1'/></surface>\n"
    "  <surface name='top'><plane point='0 0.6' normal='0 -1'/></surface></surfaces>\n"
    "<boundaries><wall name='w' surfaces='bottom top' treatment='%s'/>\n"
    "  <inflow name='in' axis='x' at='%s' into='%s' lower='0 0' upper='1.2 0.6' velocity='%su 0'/>\n"
    "  <outflow name='out' axis='x' at='%s' into='%s' lower='0 0' upper='1.2 0.6' velocity='%s' "
    "pressure='%s'/></boundaries>\n"
    "<output><fields every='1'/></output>\n"
    "</deck>\n";

/** The outflow's pressure makes the mean pressure, and with it the change of mass, 0; but particles that the
 * momentum equation moves beyond the plane want a pressure of 0 there, as beyond them is nothing. */
static void channel_create(struct assembly *a, const char *wall, bool backwards, bool at_rest,
                           const char *rule)
{
    char text[4096];
    snprintf(text, sizeof text, deck_format,
             at_rest     ? "0"
             : backwards ? "-1"
                         : "1",
             wall, backwards ? "1.2" : "0", backwards ? "-" : "+", backwards ? "-" : "",
             backwards ? "0" : "1.2", backwards ? "+" : "-", rule, strcmp(rule, "momentum") ? "-2.4" : "0");
    assert_int_equal(assembly_create(a, text, NULL), 0);
    assert_int_equal(assembly_start(a), 0);
}

static int id_compare(const void *left, const void *right)
{
    const int64_t a = *(const int64_t *)left, b = *(const int64_t *)right;
    return a < b ? -1 : a > b;
}

/** Every particle has an id of its own, and those there are are those that were born less those removed. */
static void census_check(const struct assembly *a, size_t at_first)
{
    const struct particles *block = fluid_particles(a->fluid);
    int64_t *ids = malloc(block->n * sizeof *ids);
    long born = 0, removed = 0;
    assert_non_null(ids);
    memcpy(ids, block->id, block->n * sizeof *ids);
    qsort(ids, block->n, sizeof *ids, id_compare);
    for (size_t i = 1; i < block->n; ++i)
        assert_true(ids[i] > ids[i - 1]);
    free(ids);
    for (size_t k = 0; k < a->fluid->n_openings; ++k) {
        born += a->fluid->openings[k].born;
        removed += a->fluid->openings[k].removed;
    }
    assert_true(born > 0 && removed > 0);
    assert_int_equal((long)block->n, (long)at_first + born - removed);
    assert_int_equal(block->next_id, (int64_t)at_first + born);
}

/** Particles between the openings. */
static size_t inside(const struct assembly *a)
{
    const struct particles *block = fluid_particles(a->fluid);
    size_t n = 0;
    for (size_t i = 0; i < block->n; ++i)
        n += block->x[0][i] > 0.0 && block->x[0][i] < 1.2;
    return n;
}

/** Go on for @p steps; returns the mean number of particles between the openings. Whole columns enter at once
 * at first, 12 of 288 particles: only the mean over the time a column takes says what the mass is. */
static double window(struct assembly *a, long steps)
{
    const struct particles *block = fluid_particles(a->fluid);
    double sum = 0.0;
    for (long k = 0; k < steps; ++k) {
        assert_int_equal(assembly_steps(a, 1), 0);
        sum += (double)inside(a) / (double)steps;
    }
    for (size_t i = 0; i < block->n; ++i)
        assert_true(block->x[1][i] > 0.0 && block->x[1][i] < 0.6);
    return sum;
}

/** Root mean square error of the velocity along the channel and the largest across, by the mean velocity. */
static void profile_errors(const struct assembly *a, double sign, double *along, double *across)
{
    const struct particles *block = fluid_particles(a->fluid);
    size_t n = 0;
    *along = *across = 0.0;
    for (size_t i = 0; i < block->n; ++i) {
        if (block->kind[i] != PARTICLE_FLUID)
            continue;
        const double y = block->x[1][i], u = sign * 6.0 * y * (0.6 - y) / 0.36;
        *along += (block->u[0][i] - u) * (block->u[0][i] - u);
        *across = fmax(*across, fabs(block->u[1][i]));
        ++n;
    }
    *along = sqrt(*along / (double)n);
}

/** Pressure drop per length between two sections. */
static double pressure_slope(const struct assembly *a)
{
    double sum[2] = {0.0, 0.0};
    for (int s = 0; s < 2; ++s)
        for (int k = 0; k < 9; ++k) {
            const double x[3] = {s ? 0.9 : 0.3, 0.18 + 0.03 * k, 0.0};
            double p, u[3], rho;
            assert_true(fluid_probe(a->fluid, x, &p, u, &rho) > 0.9);
            sum[s] += p / 9.0;
        }
    return (sum[1] - sum[0]) / 0.6;
}

static void channel(const char *wall, bool backwards, const char *rule, double number_most, double along_most,
                    double across_most)
{
    struct assembly a;
    const double sign = backwards ? -1.0 : 1.0;
    channel_create(&a, wall, backwards, false, rule);
    const size_t at_first = fluid_particles(a.fluid)->n;
    double along, across, slope = 0.0, worst = 0.0;
    assert_int_equal(inside(&a), 12 * 24);
    for (int part = 0; part < 24; ++part) { // 2400 steps: the channel is flown through once
        worst = fmax(worst, fabs(window(&a, 100) / 288.0 - 1.0));
        slope += part >= 12 ? pressure_slope(&a) / 12.0 : 0.0;
    }
    profile_errors(&a, sign, &along, &across);
    print_message("%s, %s%s: number changes by %.4f, error along %.4f, across %.4f, pressure slope %.3f\n",
                  wall, rule, backwards ? ", backwards" : "", worst, along, across, slope);
    assert_true(worst < number_most);
    assert_true(along < along_most && across < across_most);
    // 12 rho nu U / H^2
    assert_true(fabs(slope / (-sign * 12.0 * 1.2 * 0.1 / 0.36) - 1.0) < 0.1);
    census_check(&a, at_first);
    assembly_reset(&a);
}

static void test_channel(void **state)
{
    (void)state;
    channel("fixed-particles", false, "characteristic", 0.01, 0.02, 0.04);
    channel("sliding-particles", true, "characteristic", 0.01, 0.02, 0.04);
}

static void test_momentum_outflow(void **state)
{
    (void)state;
    channel("fixed-particles", false, "momentum", 0.02, 0.05, 0.1);
}

/** A fluid that is at rest when the inflow sets in with full speed: the wave leaves, nothing is lost. */
static void test_sudden_start(void **state)
{
    (void)state;
    struct assembly a;
    channel_create(&a, "fixed-particles", false, true, "characteristic");
    const size_t at_first = fluid_particles(a.fluid)->n;
    double fastest = 0.0, along, across, change = 0.0;
    for (int part = 0; part < 20; ++part) {
        change = window(&a, 100) / 288.0 - 1.0;
        const struct particles *block = fluid_particles(a.fluid);
        for (size_t i = 0; i < block->n; ++i)
            fastest = fmax(fastest, hypot(block->u[0][i], block->u[1][i]));
    }
    profile_errors(&a, 1.0, &along, &across);
    print_message("sudden start: fastest %.3f, error along %.4f, across %.4f, number %+.4f\n", fastest, along,
                  across, change);
    assert_true(fastest < 3.0 && along < 0.05 && fabs(change) < 0.02);
    census_check(&a, at_first);
    assembly_reset(&a);
}

static int quiet(void **state)
{
    (void)state;
    log_set_level(LOG_ERROR);
    parallel_setup(0);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_channel),
        cmocka_unit_test(test_momentum_outflow),
        cmocka_unit_test(test_sudden_start),
    };
    return cmocka_run_group_tests(tests, quiet, NULL);
}
