// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid between walls in three dimensions, with the whole engine: at rest, under gravity, in round, moving
// and sharp-edged walls. Units: spacing 1 m, density 1, sound speed 10 m/s, background pressure c^2, steps of
// 0.25 dx/c. Thresholds come from measured runs of facet shares; the published rule must not meet them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "run/assembly.h"

#include "base/log.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_NODES = 200, MOST_FACETS = 400, TEXT = 1 << 17 };

/** A closed surface of triangles or quads, counter-clockwise seen from outside. */
struct skin {
    int n_nodes, n_facets, corners;
    double nodes[MOST_NODES][3];
    int facets[MOST_FACETS][4];
};

static int node_add(struct skin *skin, const double x[3])
{
    for (int k = 0; k < skin->n_nodes; ++k)
        if (hypot(hypot(skin->nodes[k][0] - x[0], skin->nodes[k][1] - x[1]), skin->nodes[k][2] - x[2]) < 1e-9)
            return k;
    memcpy(skin->nodes[skin->n_nodes], x, 3 * sizeof *x);
    return skin->n_nodes++;
}

static int middle(struct skin *skin, int a, int b, double radius)
{
    double x[3], length = 0.0;
    for (int k = 0; k < 3; ++k) {
        x[k] = skin->nodes[a][k] + skin->nodes[b][k];
        length += x[k] * x[k];
    }
    for (int k = 0; k < 3; ++k)
        x[k] *= radius / sqrt(length);
    return node_add(skin, x);
}

/** An icosahedron about the origin, its triangles cut in four @p times times. */
static void icosphere(struct skin *skin, double radius, int times)
{
    static const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    const double g = 0.5 * (1.0 + sqrt(5.0)), a = radius / sqrt(1.0 + g * g), b = a * g;
    const double corners[12][3] = {{-a, b, 0},  {a, b, 0},  {-a, -b, 0}, {a, -b, 0}, {0, -a, b},  {0, a, b},
                                   {0, -a, -b}, {0, a, -b}, {b, 0, -a},  {b, 0, a},  {-b, 0, -a}, {-b, 0, a}};
    *skin = (struct skin){.n_nodes = 12, .n_facets = 20, .corners = 3};
    memcpy(skin->nodes, corners, sizeof corners);
    for (int f = 0; f < 20; ++f)
        memcpy(skin->facets[f], faces[f], sizeof faces[f]);
    for (; times > 0; --times)
        for (int f = 0, n = skin->n_facets; f < n; ++f) {
            int *face = skin->facets[f];
            const int old[3] = {face[0], face[1], face[2]};
            int m[3];
            for (int k = 0; k < 3; ++k)
                m[k] = middle(skin, old[k], old[(k + 1) % 3], radius);
            for (int k = 0; k < 3; ++k) {
                int *corner = skin->facets[skin->n_facets++];
                corner[0] = old[k];
                corner[1] = m[k];
                corner[2] = m[(k + 2) % 3];
            }
            memcpy(face, m, sizeof m);
        }
}

/** A box of quads: @p n by n on each side. */
static void cuboid(struct skin *skin, double low, double high, int n)
{
    static const int axes[6][3] = {{0, 2, 1}, {0, 1, 2}, {1, 0, 2}, {1, 2, 0}, {2, 1, 0}, {2, 0, 1}};
    *skin = (struct skin){.corners = 4};
    for (int side = 0; side < 6; ++side)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                int *facet = skin->facets[skin->n_facets++];
                for (int c = 0; c < 4; ++c) {
                    double x[3];
                    x[axes[side][0]] = side % 2 ? high : low;
                    x[axes[side][1]] = low + (high - low) * (i + (c == 1 || c == 2)) / n;
                    x[axes[side][2]] = low + (high - low) * (j + (c >= 2)) / n;
                    facet[c] = node_add(skin, x);
                }
            }
}

/** A rectangle at @p level of axis @p axis, along axes @p b and @p c; its normal is e_b x e_c. */
static void plate(struct skin *skin, int axis, double level, int b, const double along_b[2], int c,
                  const double along_c[2])
{
    int *facet = skin->facets[skin->n_facets++];
    for (int corner = 0; corner < 4; ++corner) {
        double x[3];
        x[axis] = level;
        x[b] = along_b[corner == 1 || corner == 2];
        x[c] = along_c[corner >= 2];
        facet[corner] = node_add(skin, x);
    }
}

/** A box of side 10 with a duct of length 5 and side 4 at x = 0, one closed surface: the rim's corners hang
 * on longer edges. */
static void ducted(struct skin *skin)
{
    static const double all[2] = {0.0, 10.0}, low[2] = {0.0, 3.0}, high[2] = {7.0, 10.0}, mid[2] = {3.0, 7.0},
                        duct[2] = {-5.0, 0.0};
    cuboid(skin, 0.0, 10.0, 1);
    skin->n_facets = 5;
    memmove(skin->facets, skin->facets + 1, 5 * sizeof *skin->facets); // without the side x = 0
    plate(skin, 0, 0.0, 2, low, 1, all);
    plate(skin, 0, 0.0, 2, high, 1, all);
    plate(skin, 0, 0.0, 2, mid, 1, low);
    plate(skin, 0, 0.0, 2, mid, 1, high);
    plate(skin, 0, -5.0, 2, mid, 1, mid);
    plate(skin, 1, 3.0, 0, duct, 2, mid);
    plate(skin, 1, 7.0, 2, mid, 0, duct);
    plate(skin, 2, 3.0, 1, mid, 0, duct);
    plate(skin, 2, 7.0, 0, duct, 1, mid);
}

/** The surface as text; @p inward: the fluid is inside. */
static void skin_print(char *text, const struct skin *skin, bool inward, const char *motion)
{
    int n = sprintf(text, "<surface name='s'><facets><nodes>");
    for (int k = 0; k < skin->n_nodes; ++k)
        n += sprintf(text + n, "%.17g %.17g %.17g ", skin->nodes[k][0], skin->nodes[k][1], skin->nodes[k][2]);
    n += sprintf(text + n, "</nodes><elements type='%s'>", skin->corners == 3 ? "tri3" : "quad4");
    for (int f = 0; f < skin->n_facets; ++f)
        for (int c = 0; c < skin->corners; ++c)
            n += sprintf(text + n, "%d ", skin->facets[f][inward ? skin->corners - 1 - c : c]);
    sprintf(text + n, "</elements></facets>%s</surface>", motion);
}

/** Places for the body force, the domain, the fluid's region, surfaces, and the wall's attributes. */
static const char deck_format[] =
    "<deck version='1' dim='3'>\n"
    "<parameters><parameter name='dx' value='1'/><parameter name='c' value='10'/></parameters>\n"
    "<time end='1e4' step='0.25*dx/c'><body-force value='%s'/></time>\n"
    "<domain %s/>\n"
    "<materials><fluid name='f' density='1' kinematic-viscosity='1' sound-speed='c' "
    "background-pressure='c^2'/></materials>\n"
    "<fluid formulation='transport-velocity' material='f' spacing='dx'>%s</fluid>\n"
    "<surfaces>%s</surfaces>\n"
    "<boundaries><wall name='w' surfaces='s' treatment='sliding-particles'%s/></boundaries>\n"
    "<output><fields every='1'/></output>\n"
    "</deck>\n";

static const char everywhere[] = "lower='-15 -15 -15' upper='15 15 15'";

/** What is left at the end: largest deviation of the density from its mean (a lattice does not quite fill a
 * round wall), velocity, and transport velocity. */
struct rest {
    size_t n;
    double density, velocity, transport;
};

static struct rest measure(const struct assembly *a)
{
    const struct particles *block = fluid_particles(a->fluid);
    double *const *shift = assembly_field(a, "TransportShift");
    struct rest rest = {block->n, 0.0, 0.0, 0.0};
    double mean = 0.0;
    for (size_t i = 0; i < block->n; ++i)
        mean += block->rho[i] / (double)block->n;
    for (size_t i = 0; i < block->n; ++i) {
        double u2 = 0.0, w2 = 0.0;
        for (int k = 0; k < 3; ++k) {
            u2 += block->u[k][i] * block->u[k][i];
            w2 += pow(block->u[k][i] + shift[k][i], 2.0);
        }
        rest.density = fmax(rest.density, fabs(block->rho[i] - mean));
        rest.velocity = fmax(rest.velocity, sqrt(u2));
        rest.transport = fmax(rest.transport, sqrt(w2));
    }
    return rest;
}

static void create(struct assembly *a, const char *force, const char *domain, const char *region,
                   const char *surface, const char *wall)
{
    char *deck = memory_print(deck_format, force, domain, region, surface, wall);
    assert_non_null(deck);
    assert_int_equal(assembly_create(a, deck, NULL), 0);
    memory_free(deck);
}

/** Start, let it settle for @p relaxed steps with a damping, stop everything and go on for @p steps. */
static struct rest settle(struct assembly *a, long relaxed, long steps)
{
    struct particles *block = assembly_particles(a);
    assert_int_equal(assembly_start(a), 0);
    if (relaxed > 0) {
        a->model->fluid.damping = 0.2 / a->model->time.step;
        assert_int_equal(assembly_steps(a, relaxed), 0);
        a->model->fluid.damping = 0.0;
        for (int k = 0; k < 3; ++k)
            memset(block->u[k], 0, block->n * sizeof(double));
    }
    assert_int_equal(assembly_steps(a, steps), 0);
    return measure(a);
}

static struct rest rest_of(const char *name, const char *domain, const char *region, const struct skin *skin,
                           bool inward, const char *wall, long relaxed, long steps)
{
    static char surface[TEXT];
    struct assembly a;
    skin_print(surface, skin, inward, "");
    create(&a, "0 0 0", domain, region, surface, wall);
    const size_t n = fluid_particles(a.fluid)->n;
    const struct rest rest = settle(&a, relaxed, steps);
    print_message("%s%s: %zu particles, density %.2g, velocity %.2g, transport velocity %.2g\n", name, wall,
                  n, rest.density, rest.velocity, rest.transport);
    assert_int_equal(rest.n, n);
    assembly_reset(&a);
    return rest;
}

static const char box[] = "<region><box lower='0 0 0' upper='10 10 10'/></region>";
static const char paper[] = " corners='paper'";

/** A box of 10 x 10 x 10 from the lattice, each side one quad or four. */
static void test_box(void **state)
{
    (void)state;
    struct skin skin;
    for (int n = 1; n <= 2; ++n) {
        cuboid(&skin, 0.0, 10.0, n);
        const struct rest h = rest_of("box", everywhere, box, &skin, true, "", 0, 150);
        assert_true(h.density < 5e-4 && h.transport < 2e-3);
    }
    cuboid(&skin, 0.0, 10.0, 1);
    const struct rest a = rest_of("box", everywhere, box, &skin, true, paper, 0, 150);
    assert_true(a.density > 3e-3);
}

/** The same under gravity, a body force in z: pressure, and the weight on the walls. */
static void test_hydrostatic(void **state)
{
    (void)state;
    static char surface[TEXT];
    struct skin skin;
    struct assembly a;
    double mean = 0.0, rms = 0.0, most = 0.0, force[3], moment[3];
    cuboid(&skin, 0.0, 10.0, 1);
    skin_print(surface, &skin, true, "");
    create(&a, "0 0 -0.02", everywhere, box, surface, "");
    settle(&a, 400, 50);
    const struct particles *block = fluid_particles(a.fluid);
    const double scale = 0.02 * 10.0;
    for (size_t i = 0; i < block->n; ++i)
        mean += (block->p[i] - 0.02 * (5.0 - block->x[2][i])) / (double)block->n;
    for (size_t i = 0; i < block->n; ++i) {
        // a closed box fixes the pressure up to a constant only
        const double error = fabs(block->p[i] - 0.02 * (5.0 - block->x[2][i]) - mean) / scale;
        rms += error * error / (double)block->n;
        most = fmax(most, error);
    }
    rms = sqrt(rms);
    surface_total_load(a.surfaces[0], (const double[3]){5.0, 5.0, 5.0}, force, moment);
    print_message("hydrostatic box: error rms %.4f, max %.4f, weight %.6f of 20\n", rms, most, -force[2]);
    assert_true(rms < 0.02 && most < 0.12);
    assert_true(fabs(force[2] / 20.0 + 1.0) < 0.01);
    assert_true(fabs(force[0]) < 0.02 && fabs(force[1]) < 0.02);
    assembly_reset(&a);
}

/** Inside and around polyhedra that approach a sphere: facets shared by many particles, turned by little. */
static void test_spheres(void **state)
{
    (void)state;
    struct skin skin;
    static const char within[] =
        "<region><difference><box lower='-8.5 -8.5 -8.5' upper='8.5 8.5 8.5'/><inside "
        "surface='s'/></difference></region>";
    static const char around[] = "<region><difference><box lower='-8 -8 -8' upper='8 8 8'/><inside "
                                 "surface='s'/></difference></region>";
    icosphere(&skin, 6.0, 1);
    const struct rest inside = rest_of("inside 80 triangles", everywhere, within, &skin, true, "", 200, 200);
    assert_true(inside.density < 8e-3 && inside.transport < 0.02);
    icosphere(&skin, 4.0, 1);
    const struct rest outside =
        rest_of("around 80 triangles", "lower='-8 -8 -8' upper='8 8 8' periodic='x y z'", around, &skin,
                false, "", 150, 100);
    assert_true(outside.density < 4e-3 && outside.transport < 0.02);
    const struct rest a = rest_of("inside 80 triangles", everywhere, within,
                                  (icosphere(&skin, 6.0, 1), &skin), true, paper, 200, 200);
    assert_true(a.density > 3.0 * inside.density);
}

/** Where a duct meets a box, facets and edges add up as anywhere else. */
static void test_rim(void **state)
{
    (void)state;
    struct skin skin;
    ducted(&skin);
    const struct rest rest = rest_of(
        "box with duct", everywhere,
        "<region><union><box lower='0 0 0' upper='10 10 10'/><box lower='-5 3 3' upper='0 7 7'/></union>"
        "</region>",
        &skin, true, "", 0, 100);
    assert_int_equal(rest.n, 1080);
    assert_true(rest.density < 1e-3 && rest.transport < 5e-3);
}

/** A box that turns about an oblique axis, and one that is shaken: nobody leaves it, the density stays. */
static void test_moving_box(void **state)
{
    (void)state;
    static char surface[TEXT];
    static const char *const motions[] = {
        "<rotation centre='5 5 5' axis='1 2 3' angle='0.2*t' velocity='0.2' acceleration='0'/>",
        "<translation value='0.5*(1-cos(0.8*t)) 0 0' velocity='0.4*sin(0.8*t) 0 0' "
        "acceleration='0.32*cos(0.8*t) 0 0'/>"};
    struct skin skin;
    cuboid(&skin, 0.0, 10.0, 1);
    for (int k = 0; k < 2; ++k) {
        struct assembly a;
        skin_print(surface, &skin, true, motions[k]);
        create(&a, "0 0 0", everywhere, box, surface, "");
        const struct rest rest = settle(&a, 0, 300);
        print_message("%s: density %.2g, velocity %.2g\n", k ? "shaken" : "turning", rest.density,
                      rest.velocity);
        assert_int_equal(rest.n, 1000);
        assert_true(rest.density < 0.02 && rest.velocity > 0.1 && rest.velocity < 3.0);
        const struct particles *block = fluid_particles(a.fluid);
        const double cube = 0.5 * sqrt(3.0) * 10.0 + 1.0;
        for (size_t i = 0; i < block->n; ++i)
            assert_true(hypot(hypot(block->x[0][i] - 5.0, block->x[1][i] - 5.0), block->x[2][i] - 5.0) <
                        cube);
        assembly_reset(&a);
    }
}

/** A cube that stirs a periodic box: what gets through its edges is put back. */
static void test_stirring_cube(void **state)
{
    (void)state;
    static char surface[TEXT];
    struct skin skin;
    struct assembly a;
    cuboid(&skin, -3.0, 3.0, 2);
    skin_print(surface, &skin, false,
               "<rotation centre='0 0 0' axis='1 2 3' angle='0.25*t' velocity='0.25' acceleration='0'/>");
    create(&a, "0 0 0", "lower='-8 -8 -8' upper='8 8 8' periodic='x y z'",
           "<region><difference><box lower='-8 -8 -8' upper='8 8 8'/><inside "
           "surface='s'/></difference></region>",
           surface, "");
    const size_t n = fluid_particles(a.fluid)->n;
    const struct rest rest = settle(&a, 0, 300);
    print_message("stirring cube: density %.2g, velocity %.2g, put back %lld times\n", rest.density,
                  rest.velocity, (long long)fluid_boundary(a.fluid, 0)->put_back_count);
    assert_int_equal(rest.n, n);
    assert_true(rest.density < 0.1 && rest.velocity > 0.3);
    const struct particles *block = fluid_particles(a.fluid);
    for (size_t i = 0; i < block->n; ++i) { // nobody is in the ball within the cube
        const double r = hypot(hypot(block->x[0][i], block->x[1][i]), block->x[2][i]);
        assert_true(r > 2.9);
    }
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
        cmocka_unit_test(test_box), cmocka_unit_test(test_hydrostatic), cmocka_unit_test(test_spheres),
        cmocka_unit_test(test_rim), cmocka_unit_test(test_moving_box),  cmocka_unit_test(test_stirring_cube),
    };
    return cmocka_run_group_tests(tests, quiet, NULL);
}
