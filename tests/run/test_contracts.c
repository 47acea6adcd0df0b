// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts promise each other, with all of them put together: combinations, repeatable interface,
// balance of momentum, complete field tables.
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
#include "coupling/coupling_list.h"
#include "fluid/fluid_list.h"
#include "wall/wall_list.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/** A slab of fluid between two walls across x, the left of which shakes; periodic in all other directions.
 * The places: dim, vectors of the domain and the fluid, the treatment, ... */
static const char slab_deck[] =
    "<deck version='1' dim='%d'>\n"
    "<time end='1' step='1e-3'><body-force value='%s'/></time>\n"
    "<domain lower='%s' upper='%s' periodic='%s'/>\n"
    "<materials><fluid name='oil' density='1.3' kinematic-viscosity='0.01' sound-speed='10' "
    "background-pressure='130'/></materials>\n"
    "<fluid formulation='%s' material='oil' spacing='0.05' arithmetic='double'>\n"
    "  <region velocity='%s'><box lower='%s' upper='%s'/></region></fluid>\n"
    "<surfaces>\n"
    "  <surface name='left'><plane point='%s' normal='%s'/><translation value='%s'/></surface>\n"
    "  <surface name='right'><plane point='%s' normal='%s'/></surface>\n"
    "</surfaces>\n"
    "<boundaries><wall name='plates' surfaces='left right' treatment='%s'/></boundaries>\n"
    "<coupling scheme='%s'/>\n"
    "<output><fields every='1'/></output>\n"
    "</deck>\n";

/** How often each entry of a list took part in something that ran. */
struct tally {
    int fluids[FLUID_TYPES], walls[WALL_TYPES], schemes[COUPLING_TYPES];
    int ran, refused;
};

enum { TEXT = 8192 };

/** Three steps, each with its balance of momentum; or a refusal that gives its reason. */
static void run_or_refuse(const char *deck, struct tally *tally, size_t fluid, size_t wall, size_t scheme)
{
    struct assembly a;
    char said[TEXT];
    assembly_listen();
    int status = assembly_create(&a, deck, NULL);
    if (!status)
        status = assembly_start(&a);
    for (int step = 0; step < 3 && !status; ++step) {
        double defect;
        status = assembly_step_balanced(&a, &defect);
        if (!status && !(defect < 1e-13))
            fail_msg("%s, %s, %s: step %d misses momentum: %g", fluid_types[fluid]->name,
                     wall_types[wall]->name, coupling_types[scheme]->name, step, defect);
    }
    assembly_reset(&a);
    assembly_heard(said, sizeof said);
    if (status == 0) {
        ++tally->ran;
        ++tally->fluids[fluid];
        ++tally->walls[wall];
        ++tally->schemes[scheme];
        return;
    }
    ++tally->refused;
    if (status != STATUS_DECK || !strstr(said, "error: "))
        fail_msg("%s, %s, %s: status %d, said \"%s\"", fluid_types[fluid]->name, wall_types[wall]->name,
                 coupling_types[scheme]->name, status, said);
}

static void slab_text(char *text, int dim, const char *fluid, const char *wall, const char *scheme)
{
    static const char *const gravity[] = {"", "-0.7", "-0.7 0.4", "-0.7 0.4 0.2"};
    static const char *const lower[] = {"", "-0.2", "-0.2 0", "-0.2 0 0"};
    static const char *const upper[] = {"", "0.6", "0.6 0.45", "0.6 0.45 0.4"};
    static const char *const periodic[] = {"", "", "y", "y z"};
    static const char *const velocity[] = {"", "0.1", "0.1 sin(20*x)", "0.1 sin(20*x) x"};
    static const char *const from[] = {"", "0", "0 0", "0 0 0"};
    static const char *const to[] = {"", "0.4", "0.4 0.45", "0.4 0.45 0.4"};
    static const char *const right[] = {"", "1", "1 0", "1 0 0"};
    static const char *const left[] = {"", "-1", "-1 0", "-1 0 0"};
    static const char *const shake[] = {"", "0.01*sin(30*t)", "0.01*sin(30*t) t", "0.01*sin(30*t) t 0"};
    const size_t d = (size_t)dim;
    snprintf(text, TEXT, slab_deck, dim, gravity[d], lower[d], upper[d], periodic[d], fluid, velocity[d],
             from[d], to[d], from[d], right[d], shake[d], to[d], left[d], wall, scheme);
}

static void test_combinations(void **state)
{
    (void)state;
    struct tally tally = {0};
    char text[TEXT], scheme[64];
    for (size_t f = 0; f < FLUID_TYPES; ++f)
        for (size_t w = 0; w < WALL_TYPES; ++w)
            for (size_t s = 0; s < COUPLING_TYPES; ++s) {
                const char *fluid = fluid_types[f]->name, *wall = wall_types[w]->name;
                for (int dim = 1; dim <= 3; ++dim) {
                    slab_text(text, dim, fluid, wall, coupling_types[s]->name);
                    run_or_refuse(text, &tally, f, w, s);
                }
                snprintf(scheme, sizeof scheme, "scheme='%s'", coupling_types[s]->name);
                for (size_t lid = 0; lid < WALL_TYPES; ++lid) {
                    snprintf(text, sizeof text, beam_deck, fluid, wall, wall_types[lid]->name, scheme);
                    run_or_refuse(text, &tally, f, w, s);
                }
            }
    print_message("%d combinations ran, %d were refused\n", tally.ran, tally.refused);
    assert_true(tally.ran > 0 && tally.refused > 0);
    for (size_t f = 0; f < FLUID_TYPES; ++f)
        assert_true(tally.fluids[f] > 0);
    for (size_t w = 0; w < WALL_TYPES; ++w)
        assert_true(tally.walls[w] > 0);
    for (size_t s = 0; s < COUPLING_TYPES; ++s)
        assert_true(tally.schemes[s] > 0);
}

/** The beam in motion, after @p steps. */
static void beam_start(struct assembly *a, const char *wet, const char *lid, const char *coupling, long steps)
{
    char text[TEXT];
    snprintf(text, sizeof text, beam_deck, fluid_types[0]->name, wet, lid, coupling);
    assert_int_equal(assembly_create(a, text, NULL), 0);
    assert_int_equal(assembly_start(a), 0);
    assert_int_equal(assembly_steps(a, steps), 0);
}

static void *copy_of(const void *data, size_t size)
{
    void *copy = memory_create(size, 1);
    assert_non_null(copy);
    memcpy(copy, data, size);
    return copy;
}

static void test_interface_is_repeatable(void **state)
{
    (void)state;
    for (size_t w = 0; w < WALL_TYPES * WALL_TYPES; ++w) {
        struct assembly a;
        beam_start(&a, wall_types[w / WALL_TYPES]->name, wall_types[w % WALL_TYPES]->name,
                   "scheme='fixed-point'", 7);
        const double dt = a.model->time.step;
        for (size_t s = 0; s < a.n_surfaces; ++s)
            surface_open(a.surfaces[s], a.t + dt);
        assert_int_equal(solid_begin_step(a.solids[0], a.t, dt), 0);
        assert_int_equal(solid_predict(a.solids[0]), 0);
        assert_int_equal(fluid_begin_step(a.fluid, a.t, dt), 0);
        assert_int_equal(fluid_interface(a.fluid, false), 0);
        struct surface *wet = assembly_surface(&a, "wet");
        const struct particles *block = fluid_particles(a.fluid);
        const size_t loads = wet->n_points * sizeof *wet->load, sums = block->n * sizeof *block->rho;
        double *load = copy_of(wet->load, loads), *rho = copy_of(block->rho, sums);
        assert_true(fabs(load[1]) > 0.0);
        for (int again = 0; again < 4; ++again) {
            assert_int_equal(fluid_interface(a.fluid, again % 2 == 0), 0);
            assert_memory_equal(wet->load, load, loads);
            assert_memory_equal(block->rho, rho, sums);
        }
        memory_free(load);
        memory_free(rho);
        assembly_reset(&a);
    }
}

/** In a coupled step the start of the step is level 0 to the bit, also where the solid moves it. */
static void test_surface_at_start(void **state)
{
    (void)state;
    struct assembly a;
    beam_start(&a, "sliding-particles", "sliding-particles", "scheme='fixed-point'", 6);
    struct surface *wet = assembly_surface(&a, "wet");
    const size_t size = wet->n_points * sizeof *wet->now.x;
    assert_true(wet->level[1].t > wet->level[0].t);
    assert_true(memcmp(wet->level[0].x, wet->level[1].x, size) != 0);
    surface_at(wet, wet->level[0].t);
    assert_memory_equal(wet->now.x, wet->level[0].x, size);
    assert_memory_equal(wet->now.v, wet->level[0].v, size);
    assert_memory_equal(wet->now.a, wet->level[0].a, size);
    surface_at(wet, wet->level[1].t);
    assert_memory_equal(wet->now.x, wet->level[1].x, size);
    assembly_reset(&a);
}

/** The map of a solid to its surface and its transpose: force, moment and power are those of the points. */
static void attachment_check(const char *treatment)
{
    struct assembly a;
    beam_start(&a, treatment, "sliding-particles", "scheme='fixed-point' tolerance='1e-11'", 6);
    const struct surface *wet = assembly_surface(&a, "wet");
    const struct mesh *mesh = solid_mesh(a.solids[0]);
    const double(*x)[3] = solid_positions(a.solids[0]), (*v)[3] = assembly_nodes(&a, "Velocity");
    const double(*f)[3] = assembly_nodes(&a, "InterfaceForce");
    double nodes[4] = {0.0}, points[4] = {0.0}, size[4] = {0.0};
    for (size_t n = 0; n < mesh->n_nodes; ++n) {
        nodes[0] += f[n][0];
        nodes[1] += f[n][1];
        nodes[2] += x[n][0] * f[n][1] - x[n][1] * f[n][0];
        nodes[3] += v[n][0] * f[n][0] + v[n][1] * f[n][1];
    }
    for (size_t p = 0; p < wet->n_points; ++p) {
        if (wet->mesh[p] < 0)
            continue;
        const double *y = wet->level[1].x[p], *w = wet->level[1].v[p], *g = wet->load[p];
        const double terms[4] = {g[0], g[1], y[0] * g[1] - y[1] * g[0], w[0] * g[0] + w[1] * g[1]};
        for (int k = 0; k < 4; ++k) {
            points[k] += terms[k];
            size[k] += fabs(terms[k]);
        }
    }
    for (int k = 0; k < 4; ++k) {
        assert_true(size[k] > 0.0);
        assert_true(fabs(nodes[k] - points[k]) < 1e-14 * size[k]);
    }
    assembly_reset(&a);
}

static void test_attachment_conserves(void **state)
{
    (void)state;
    for (size_t w = 0; w < WALL_TYPES; ++w)
        attachment_check(wall_types[w]->name);
}

static bool in_table(const struct field_group *group, const void *array)
{
    for (size_t f = 0; f < group->n_fields; ++f)
        for (int c = 0; c < 3; ++c)
            if (group->fields[f].data[c] == array)
                return true;
    return false;
}

static void test_arrays_are_in_tables(void **state)
{
    (void)state;
    struct assembly a;
    beam_start(&a, "sliding-particles", "sliding-particles", "scheme='fixed-point'", 3);
    const struct particles *b = fluid_particles(a.fluid);
    const void *const arrays[] = {b->id,   b->kind, b->opening, b->x[0], b->x[1], b->x[2],
                                  b->u[0], b->u[1], b->u[2],    b->rho,  b->p,    b->m};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; ++k)
        assert_true(in_table(&b->fields, arrays[k]));
    for (size_t s = 0; s < a.n_surfaces; ++s) {
        const struct surface *surface = a.surfaces[s];
        const void *const rows[] = {surface->level[1].v, surface->level[1].a, surface->load,
                                    surface->load_previous, surface->listed};
        for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k)
            assert_true(in_table(&surface->fields, rows[k]));
    }
    assert_true(in_table(solid_node_fields(a.solids[0]), solid_positions(a.solids[0])));
    assert_false(in_table(&b->fields, &a));
    assembly_reset(&a);
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
        cmocka_unit_test(test_combinations),         cmocka_unit_test(test_interface_is_repeatable),
        cmocka_unit_test(test_surface_at_start),     cmocka_unit_test(test_attachment_conserves),
        cmocka_unit_test(test_arrays_are_in_tables),
    };
    return cmocka_run_group_tests(tests, quiet, NULL);
}
