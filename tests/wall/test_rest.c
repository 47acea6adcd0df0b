// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid at rest and in simple motion between walls, with the whole engine. Units: spacing 0.05 m, sound speed
// 10 m/s, density 1, background pressure c^2, viscosity 0.1 m^2/s, steps of 0.25 dx/c; thresholds come from
// measured runs of the recipe of facet shares (H) and of the published rule (A), which must not meet them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "run/assembly.h"

#include "base/log.h"
#include "base/parallel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { TEXT = 8192 };

/** Places for the body force, the fluid's shapes, surfaces, and the wall's attributes. */
static const char deck_format[] =
    "<deck version='1' dim='2'>\n"
    "<parameters><parameter name='dx' value='0.05'/><parameter name='c' value='10'/></parameters>\n"
    "<time end='100' step='0.25*dx/c'><body-force value='%s'/></time>\n"
    "<domain lower='-0.2 -0.2' upper='1.2 1.2' %s/>\n"
    "<materials><fluid name='f' density='1' kinematic-viscosity='0.1' sound-speed='c' "
    "background-pressure='c^2'/></materials>\n"
    "<fluid formulation='transport-velocity' material='f' spacing='dx'><region origin='0 "
    "0'>%s</region></fluid>\n"
    "<surfaces>%s</surfaces>\n"
    "<boundaries><wall name='w' %s/></boundaries>\n"
    "<output><fields every='1'/></output>\n"
    "</deck>\n";

static const char box[] = "<box lower='0 0' upper='1 1'/>";
static const char box_walls[] =
    "<surface name='s'><segments points='0 0 0 1 1 1 1 0' closed='yes' fluid='right'/></surface>";
static const char shares[] = "surfaces='s' treatment='sliding-particles'";
static const char paper[] = "surfaces='s' treatment='sliding-particles' corners='paper'";
static const char fixed[] = "surfaces='s' treatment='fixed-particles'";

static void create(struct assembly *a, const char *force, const char *domain, const char *shape,
                   const char *surfaces, const char *wall)
{
    char text[TEXT];
    snprintf(text, sizeof text, deck_format, force, domain, shape, surfaces, wall);
    assert_int_equal(assembly_create(a, text, NULL), 0);
}

/** Start, relax for @p relaxed steps with the damping @p damping (1/s), stop everything, go on for @p steps.
 */
static void run(struct assembly *a, long relaxed, double damping, long steps)
{
    struct particles *block = assembly_particles(a);
    assert_int_equal(assembly_start(a), 0);
    if (relaxed > 0) {
        a->model->fluid.damping = damping;
        assert_int_equal(assembly_steps(a, relaxed), 0);
        a->model->fluid.damping = 0.0;
        for (int k = 0; k < 3; ++k)
            memset(block->u[k], 0, block->n * sizeof(double));
    }
    assert_int_equal(assembly_steps(a, steps), 0);
}

/** What is left at the end: largest |rho - 1|, velocity, and transport velocity. */
struct rest {
    double density, velocity, transport;
};

static struct rest measure(const struct assembly *a)
{
    const struct particles *block = fluid_particles(a->fluid);
    double *const *shift = assembly_field(a, "TransportShift");
    struct rest rest = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < block->n; ++i) {
        rest.density = fmax(rest.density, fabs(block->rho[i] - 1.0));
        rest.velocity = fmax(rest.velocity, hypot(block->u[0][i], block->u[1][i]));
        rest.transport =
            fmax(rest.transport, hypot(block->u[0][i] + shift[0][i], block->u[1][i] + shift[1][i]));
    }
    return rest;
}

static struct rest rest_of(const char *shape, const char *surfaces, const char *wall, double jitter,
                           long relaxed, long steps)
{
    struct assembly a;
    create(&a, "0 0", "", shape, surfaces, wall);
    assembly_jitter(&a, jitter * a.model->fluid.spacing);
    const size_t n = fluid_particles(a.fluid)->n;
    run(&a, relaxed, 0.2 / a.model->time.step, steps);
    assert_int_equal(fluid_particles(a.fluid)->n, n);
    const struct rest rest = measure(&a);
    print_message("%s jitter %g: density %.2g, velocity %.2g, transport velocity %.2g\n",
                  strchr(wall, ' ') + 1, jitter, rest.density, rest.velocity, rest.transport);
    assembly_reset(&a);
    return rest;
}

/** Box of 20 x 20 from the lattice. */
static void test_box(void **state)
{
    (void)state;
    const struct rest h = rest_of(box, box_walls, shares, 0.0, 0, 600);
    assert_true(h.density < 1e-4 && h.velocity < 5e-4);
    const struct rest a = rest_of(box, box_walls, paper, 0.0, 0, 600);
    assert_true(a.density > 1e-3);
    const struct rest f = rest_of(box, box_walls, fixed, 0.0, 0, 600);
    assert_true(f.density < 1e-4 && f.velocity < 1e-6);
}

/** Box under gravity: pressure against rho g (H - y), relative to rho g H, over all particles. */
static void hydrostatic(const char *wall, long steps, double *rms, double *most)
{
    struct assembly a;
    create(&a, "0 -1", "", box, box_walls, wall);
    run(&a, steps, 40.0, 100);
    const struct particles *block = fluid_particles(a.fluid);
    double mean = 0.0;
    *rms = *most = 0.0;
    for (size_t i = 0; i < block->n; ++i)
        mean += (block->p[i] - (0.5 - block->x[1][i])) / (double)block->n;
    for (size_t i = 0; i < block->n; ++i) {
        // a closed box fixes the pressure up to a constant only
        const double error = fabs(block->p[i] - (0.5 - block->x[1][i]) - mean);
        *rms += error * error / (double)block->n;
        *most = fmax(*most, error);
    }
    *rms = sqrt(*rms);
    double force[3], moment[3];
    surface_total_load(a.surfaces[0], (const double[3]){0.0, 0.0, 0.0}, force, moment);
    print_message("hydrostatic %s: error rms %.4f, max %.4f, weight %.6f\n", strchr(wall, ' ') + 1, *rms,
                  *most, -force[1]);
    assert_true(fabs(force[1] + 1.0) < 0.01 && fabs(force[0]) < 0.01);
    assembly_reset(&a);
}

static void test_hydrostatic(void **state)
{
    (void)state;
    double rms, most;
    hydrostatic(shares, 600, &rms, &most);
    assert_true(rms < 0.004 && most < 0.02);
    hydrostatic(paper, 600, &rms, &most);
    assert_true(rms > 0.02);
    hydrostatic(fixed, 600, &rms, &most);
    assert_true(rms < 0.02);
}

/** A box with a step in a corner, jittered. */
static void test_step(void **state)
{
    (void)state;
    static const char shape[] = "<difference><box lower='0 0' upper='1 1'/><box lower='0.5 0' upper='1 0.5'/>"
                                "</difference>";
    static const char walls[] = "<surface name='s'><segments points='0 0 0 1 1 1 1 0.5 0.5 0.5 0.5 0' "
                                "closed='yes' fluid='right'/></surface>";
    const struct rest h = rest_of(shape, walls, shares, 0.1, 0, 2000);
    const struct rest a = rest_of(shape, walls, paper, 0.1, 0, 2000);
    assert_true(h.density < 1e-3 && h.transport < 1e-3);
    assert_true(a.density > 2.0 * h.density && a.transport > 2e-3);
}

/** Inside a circle of radius 10 dx cut into 12 facets. */
static void test_polygon(void **state)
{
    (void)state;
    static const char shape[] =
        "<difference><box lower='0 0' upper='1 1'/><inside surface='s'/></difference>";
    static const char walls[] = "<surface name='s'><arc centre='0.5 0.5' radius='0.5' segments='12' "
                                "fluid='inside'/></surface>";
    const struct rest h = rest_of(shape, walls, shares, 0.0, 300, 1200);
    const struct rest a = rest_of(shape, walls, paper, 0.0, 300, 1200);
    assert_true(h.transport < 3e-3 && h.density < 3e-3);
    assert_true(a.transport > 0.05);
}

/** Start-up of plane Couette flow: series solution for plates at y = 0 (at rest) and y = 1. */
static double couette(double y, double t, double speed)
{
    double u = y;
    for (int n = 1; n < 60; ++n)
        u += 2.0 / (n * PI) * (n % 2 ? -1.0 : 1.0) * exp(-0.1 * n * n * PI * PI * t) * sin(n * PI * y);
    return speed * u;
}

static void test_couette(void **state)
{
    (void)state;
    static const char walls[] =
        "<surface name='s'><plane point='0 0' normal='0 1'/></surface>"
        "<surface name='m'><plane point='0 1' normal='0 -1'/>"
        "<translation value='0.8*t 0' velocity='0.8 0' acceleration='0 0'/></surface>";
    static const char *const treatments[] = {"surfaces='s m' treatment='fixed-particles'",
                                             "surfaces='s m' treatment='sliding-particles'"};
    for (int w = 0; w < 2; ++w) {
        struct assembly a;
        double rms = 0.0, still = 0.0;
        create(&a, "0 0", "periodic='x'", "<box lower='-0.2 0' upper='1.2 1'/>", walls, treatments[w]);
        run(&a, 0, 0.0, 320);
        const struct particles *block = fluid_particles(a.fluid);
        for (size_t i = 0; i < block->n; ++i) {
            const double error = block->u[0][i] - couette(block->x[1][i], a.t, 0.8);
            rms += error * error / (double)block->n;
            still = fmax(still, fabs(block->u[1][i]));
        }
        rms = sqrt(rms) / 0.8;
        // drag of the moving plate per length against the series' slope there
        const double slope = (couette(1.0, a.t, 0.8) - couette(1.0 - 1e-5, a.t, 0.8)) / 1e-5;
        const double drag = assembly_surface(&a, "m")->load[0][0] / 1.4;
        print_message("%s: Couette error %.4f, across %.2g, drag %.4f of %.4f\n", treatments[w], rms, still,
                      drag, -0.1 * slope);
        assert_true(rms < 0.005 && still < 0.005);
        assert_true(fabs(drag / (-0.1 * slope) - 1.0) < 0.05);
        assert_true(couette(0.5, a.t, 0.8) < 0.3); // the start, not the end state
        assembly_reset(&a);
    }
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
        cmocka_unit_test(test_box),     cmocka_unit_test(test_hydrostatic), cmocka_unit_test(test_step),
        cmocka_unit_test(test_polygon), cmocka_unit_test(test_couette),
    };
    return cmocka_run_group_tests(tests, quiet, NULL);
}
