// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/memory.h"
#include "model/surface.h"

#include <math.h>
#include <omp.h>
#include <string.h>

/** Three points: the first two are prescribed, the last is moved by a mesh. */
struct fixture {
    struct model model;
    struct model_surface definition;
    struct model_mesh mesh;
    double points[3][3];
    int32_t nodes[2][4], mesh_of[3], node_of[3];
    struct surface *surface;
};

static struct expression *make(const char *text)
{
    struct expression *expression = NULL;
    char message[256];
    const struct expression_scope scope = {0};
    assert_int_equal(expression_create(&expression, text, &scope, message, sizeof message), 0);
    return expression;
}

static void setup(struct fixture *f)
{
    memset(f, 0, sizeof *f);
    memcpy(f->points, (double[3][3]){{0.5, 0.25, 0.0}, {1.5, -0.75, 0.0}, {2.25, 1.125, 0.0}},
           sizeof f->points);
    memcpy(f->nodes, (int32_t[2][4]){{0, 1, -1, -1}, {1, 2, -1, -1}}, sizeof f->nodes);
    memcpy(f->mesh_of, (int32_t[3]){-1, -1, 0}, sizeof f->mesh_of);
    memcpy(f->node_of, (int32_t[3]){-1, -1, 17}, sizeof f->node_of);
    f->definition.name = (char *)"gate";
    f->definition.built = (struct facets){2, 3, 2, f->points, f->nodes};
    f->definition.built_mesh = f->mesh_of;
    f->definition.built_node = f->node_of;
    f->definition.motion.kind = MOTION_RIGID;
    f->definition.motion.axis[2] = 1.0;
    f->definition.motion.displacement[0] = make("0.2*t^2");
    f->mesh.displacement[1] = make("0.01*x");
    f->mesh.velocity[0] = make("-y");
    f->model.dim = 2;
    f->model.surfaces = &f->definition;
    f->model.meshes = &f->mesh;
    f->model.n_surfaces = f->model.n_meshes = 1;
    assert_int_equal(surface_create(&f->surface, &f->model, 0, 0.5), 0);
}

static void teardown(struct fixture *f)
{
    surface_destroy(f->surface);
    motion_reset(&f->definition.motion);
    expression_destroy(f->mesh.displacement[1]);
    expression_destroy(f->mesh.velocity[0]);
}

static void test_create(void **state)
{
    (void)state;
    struct fixture f;
    setup(&f);
    const struct surface *s = f.surface;
    assert_true(s->coupled && s->moving);
    assert_int_equal(s->n_points, 3);
    assert_int_equal(s->n_facets, 2);
    assert_int_equal(s->mesh_node[2], 17);
    assert_int_equal(s->nodes[1][1], 2);
    assert_true(fabs(s->now.x[0][0] - 0.55) < 1e-15);
    assert_true(fabs(s->now.v[0][0] - 0.2) < 1e-8);
    assert_true(fabs(s->now.a[0][0] - 0.4) < 1e-5);
    assert_true(fabs(s->level[0].x[2][1] - 1.125 - 0.0225) < 1e-15);
    assert_true(s->level[1].v[2][0] == -1.125);
    assert_string_equal(s->fields.name, "surface-gate");
    const struct field *field = field_find(&s->fields, "Displacement");
    assert_non_null(field);
    double displacement[3][3];
    assert_int_equal(field_read(&s->fields, field, displacement), 0);
    assert_true(fabs(displacement[1][0] - 0.05) < 1e-15 && fabs(displacement[2][1] - 0.0225) < 1e-15);
    teardown(&f);
}

/** Inner nodes of the mesh follow as further points; what was there stays. */
static void test_add_nodes(void **state)
{
    (void)state;
    struct fixture f;
    setup(&f);
    double X[4][3] = {{0.0, 0.0, 0.0}, {1.75, 0.375, 0.0}, {0.0, 0.0, 0.0}, {2.5, -0.5, 0.0}};
    const int32_t nodes[2] = {3, 1};
    double first[3][3], displacement[5][3];
    struct surface *s = f.surface;
    f.mesh.mesh.X = X;
    memcpy(first, s->level[1].x, sizeof first);
    s->load_previous[1][0] = 3.25;
    assert_int_equal(surface_add_nodes(s, &f.model, 0, 2, nodes), 0);
    assert_int_equal(s->n_points, 5);
    assert_int_equal(s->n_facets, 2);
    assert_memory_equal(s->level[0].x, first, sizeof first);
    assert_memory_equal(s->now.x, first, sizeof first);
    assert_true(s->load_previous[1][0] == 3.25 && s->load_previous[3][0] == 0.0);
    assert_int_equal(s->mesh[0], -1);
    assert_int_equal(s->mesh_node[2], 17);
    for (int k = 0; k < 2; ++k) {
        assert_int_equal(s->mesh[3 + k], 0);
        assert_int_equal(s->mesh_node[3 + k], nodes[k]);
        assert_memory_equal(s->X[3 + k], X[nodes[k]], sizeof *X);
        assert_true(fabs(s->trial.x[3 + k][1] - X[nodes[k]][1] - 0.01 * X[nodes[k]][0]) < 1e-15);
        assert_true(s->level[0].v[3 + k][0] == -X[nodes[k]][1]);
    }
    const struct field *field = field_find(&s->fields, "Displacement");
    assert_int_equal(*s->fields.count, 5);
    assert_int_equal(field_read(&s->fields, field, displacement), 0);
    assert_true(fabs(displacement[4][1] - 0.0175) < 1e-15 && fabs(displacement[1][0] - 0.05) < 1e-15);
    assert_true(field_find(&s->fields, "Load")->data[0] == (void *)s->load);
    teardown(&f);
}

static void test_levels(void **state)
{
    (void)state;
    struct fixture f;
    setup(&f);
    struct surface *s = f.surface;
    double first[3][3];
    memcpy(first, s->level[1].x, sizeof first);
    s->impulse[1][0] = 3.0;
    surface_open(s, 0.7);
    assert_true(s->impulse[1][0] == 0.0);
    assert_memory_equal(s->level[0].x, first, sizeof first);
    assert_true(fabs(s->level[1].x[1][0] - 1.5 - 0.2 * 0.49) < 1e-15);
    assert_memory_equal(s->level[1].x[2], first[2], sizeof first[2]); // until the solid predicts
    s->level[1].x[2][0] += 0.1;
    surface_at(s, 0.5);
    assert_memory_equal(s->now.x, s->level[0].x, sizeof first);
    assert_memory_equal(s->now.a, s->level[0].a, sizeof first);
    surface_at(s, 0.7);
    assert_memory_equal(s->now.x, s->level[1].x, sizeof first);
    // a quarter of the way, 0.1 m and -1.125 m/s at both ends: 5/32 0.1 + 0.2 (9/64 - 3/64) (-1.125)
    surface_at(s, 0.55);
    assert_true(fabs(s->now.x[2][0] - 2.25 - (0.015625 - 0.02109375)) < 1e-15);
    assert_true(fabs(s->now.v[2][0] - (1.125 * 0.5 - 1.125 * (0.1875 - 0.3125))) < 1e-14);
    // the cubic is exact for the prescribed parabola, its derivative too
    assert_true(fabs(s->now.x[0][0] - 0.5 - 0.2 * 0.55 * 0.55) < 1e-9);
    assert_true(fabs(s->now.v[0][0] - 0.4 * 0.55) < 1e-7);
    assert_true(fabs(s->now.a[0][0] - 0.75 * s->level[0].a[0][0] - 0.25 * s->level[1].a[0][0]) < 1e-15);
    s->rule = SURFACE_MEAN;
    surface_open(s, 0.9);
    surface_at(s, 0.8);
    assert_memory_equal(s->now.x, s->level[0].x, sizeof first);
    assert_true(fabs(s->now.v[2][0] - 0.5) < 1e-13); // 0.1 m in 0.2 s, the step before
    assert_true(fabs(s->now.a[0][0] - 0.4) < 1e-6);
    teardown(&f);
}

/** How far points go in a part of the step, and what is shown inside it. */
static void test_parts_of_a_step(void **state)
{
    (void)state;
    struct fixture f;
    setup(&f);
    struct surface *s = f.surface;
    surface_open(s, 0.9);
    s->level[1].v[2][0] = s->level[0].v[2][0] = 0.5;
    s->level[1].x[2][0] += 0.2;
    s->level[1].x[2][1] += 0.65;
    assert_true(fabs(surface_travel(s, 0.9, 0.4) - hypot(0.2, 0.65)) < 1e-15);
    // x goes evenly, y as s^2 (3 - 2 s) between: from s = 1/4 to 1/2
    const double way[2] = {0.05, 0.65 * (0.5 - 0.15625)};
    assert_true(fabs(surface_travel(s, 0.7, 0.1) - hypot(way[0], way[1])) < 1e-15);
    const struct field *velocity = field_find(&s->fields, "Velocity");
    const struct field *displacement = field_find(&s->fields, "Displacement");
    double values[3][3];
    surface_at(s, 0.6);
    for (int now = 1; now >= 0; --now) {
        const struct surface_motion *shown = now ? &s->now : &s->level[1];
        surface_show(s, now);
        assert_memory_equal(s->shown->x, shown->x, sizeof values);
        assert_int_equal(field_read(&s->fields, velocity, values), 0);
        assert_memory_equal(values, shown->v, sizeof values);
        assert_int_equal(field_read(&s->fields, displacement, values), 0);
        assert_true(values[2][0] == shown->x[2][0] - 2.25);
    }
    // gone on with: prescribed points at the end of the step, the impulse as it was
    s->impulse[0][1] = 0.75;
    surface_resume(s, 0.5);
    surface_reopen(s, 0.9);
    assert_true(s->impulse[0][1] == 0.75);
    assert_true(s->level[0].t == 0.5 && s->level[1].t == 0.9);
    assert_true(fabs(s->level[1].x[1][0] - 1.5 - 0.2 * 0.81) < 1e-15);
    teardown(&f);
}

static void test_loads(void **state)
{
    (void)state;
    struct fixture f;
    setup(&f);
    struct surface *s = f.surface;
    s->load[0][1] = 2.0;
    s->load[2][0] = -0.5;
    s->moment[2] = 0.125;
    double force[3], moment[3];
    surface_total_load(s, (double[3]){0.05, 0.0, 0.0}, force, moment);
    assert_true(force[0] == -0.5 && force[1] == 2.0);
    assert_true(fabs(moment[2] - (0.125 + 0.5 * 2.0 + 1.1475 * 0.5)) < 1e-14);
    surface_add_impulse(s, 0.1, SURFACE_LOAD_MEAN);
    assert_true(fabs(s->impulse[0][1] - 0.2) < 1e-16);
    s->load[0][1] = 4.0;
    surface_add_impulse(s, 0.1, SURFACE_LOAD_END);
    assert_true(fabs(s->impulse[0][1] - 0.5) < 1e-15);
    assert_true(s->load_previous[0][1] == 4.0);
    surface_clear_load(s);
    assert_true(s->load[0][1] == 0.0 && s->moment[2] == 0.0);
    teardown(&f);
}

static void test_added_mass(void **state)
{
    (void)state;
    struct fixture f;
    setup(&f);
    struct surface *s = f.surface;
    s->added_mass = memory_create(1, sizeof *s->added_mass);
    s->n_added_mass = 1;
    s->added_mass[0] =
        (struct added_mass_contact){0, 2, 2, 2, {{1.0, 2.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 0.0}}, 5.0};
    s->anchors = memory_create(4, sizeof *s->anchors);
    s->anchors[0] = (struct anchor){0.3, 0};
    s->anchors[1] = (struct anchor){0.7, 1};
    s->anchors[2] = (struct anchor){0.6, 1};
    s->anchors[3] = (struct anchor){0.4, 2};
    const double a[3][3] = {{9.0, 9.0, 9.0}, {1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}};
    double result[3][3];
    surface_added_mass_apply(s, a, 0.0, result); // T (0.6, 0.8) = (2.2, 2.4)
    assert_true(fabs(result[0][0] - 0.66) < 1e-15 && fabs(result[0][1] - 0.72) < 1e-15);
    assert_true(fabs(result[1][0] - 1.54) < 1e-15 && fabs(result[1][1] - 1.68) < 1e-15);
    assert_true(result[2][0] == 0.0);
    surface_added_mass_apply(s, a, 0.2, result); // and 0.2 * 5 (3.4, 2.7, 2.7)
    assert_true(fabs(result[0][0] - 0.3 * 5.6) < 1e-15 && fabs(result[1][1] - 0.7 * 5.1) < 1e-14);
    assert_true(fabs(result[1][2] - 0.7 * 2.7) < 1e-15);
    teardown(&f);
}

/** Many contacts, as threads share them: the sum is what one after the other gives, bit for bit the same at
 * any number of threads, and nothing of it is left for the next. */
static void test_many_contacts(void **state)
{
    (void)state;
    enum { CONTACTS = 4999 };
    struct fixture f;
    setup(&f);
    struct surface *s = f.surface;
    s->added_mass = memory_create(CONTACTS, sizeof *s->added_mass);
    s->anchors = memory_create(2 * CONTACTS, sizeof *s->anchors);
    s->n_added_mass = CONTACTS;
    const double a[3][3] = {{9.1, -0.3, 2.7}, {1.3, 0.6, -4.1}, {0.2, 2.9, 0.8}};
    double expected[3][3] = {{0.0}}, result[3][3][3];
    for (size_t c = 0; c < CONTACTS; ++c) {
        const double weight = 0.5 + 0.4 * sin(1.7 * (double)c), t = 1.0 + 0.3 * cos((double)c);
        const int32_t first = (int32_t)(c % 3), second = (first + 1) % 3;
        s->added_mass[c] = (struct added_mass_contact){
            2 * c, 2 * c, 2, 2, {{t, 0.0, 0.0}, {0.0, t, 0.0}, {0.0, 0.0, t}}, 0.0};
        s->anchors[2 * c] = (struct anchor){weight, first};
        s->anchors[2 * c + 1] = (struct anchor){1.0 - weight, second};
        for (int k = 0; k < 3; ++k) {
            const double force = t * (weight * a[first][k] + (1.0 - weight) * a[second][k]);
            expected[first][k] += weight * force;
            expected[second][k] += (1.0 - weight) * force;
        }
    }
    const int before = omp_get_max_threads(), threads[3] = {1, 3, 3};
    for (int run = 0; run < 3; ++run) {
        omp_set_num_threads(threads[run]);
        surface_added_mass_apply(s, a, 0.0, result[run]);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                assert_true(fabs(result[run][i][k] - expected[i][k]) < 1e-9);
        assert_memory_equal(result[run], result[0], sizeof result[0]);
    }
    omp_set_num_threads(before);
    teardown(&f);
}

/** Motion and load of a piece of a curved side belong to the whole side: line3 with nodes 0, 1 and 2 in the
 * middle, by hand at xi = -0.3 and 0.4. */
static void test_spread(void **state)
{
    (void)state;
    struct fixture f;
    setup(&f);
    int32_t points[SIDE_MAX_NODES];
    double weights[SIDE_MAX_NODES] = {0.3, 0.7};
    assert_int_equal(surface_spread(f.surface, 1, points, weights), 2);
    assert_true(points[0] == 1 && points[1] == 2 && weights[0] == 0.3 && weights[1] == 0.7);
    surface_destroy(f.surface);
    int32_t sides[2][SIDE_MAX_NODES] = {{0, 1, 2, -1, -1, -1, -1, -1, -1}, {0, 1, 2, -1, -1, -1, -1, -1, -1}};
    memcpy(f.nodes, (int32_t[2][4]){{0, 2, -1, -1}, {2, 1, -1, -1}}, sizeof f.nodes);
    f.definition.built.sides = sides;
    assert_int_equal(surface_create(&f.surface, &f.model, 0, 0.5), 0);
    const double expected[2][3] = {{0.195, -0.105, 0.91}, {-0.12, 0.28, 0.84}};
    for (int facet = 0; facet < 2; facet++) {
        weights[0] = facet ? 0.6 : 0.3;
        weights[1] = 1 - weights[0];
        assert_int_equal(surface_spread(f.surface, (size_t)facet, points, weights), 3);
        for (int k = 0; k < 3; k++) {
            assert_int_equal(points[k], k);
            assert_true(fabs(weights[k] - expected[facet][k]) < 1e-15);
        }
    }
    teardown(&f);
}

static void test_analytic(void **state)
{
    (void)state;
    struct model model = {.dim = 2};
    struct model_surface definition = {
        .name = (char *)"circle", .kind = SURFACE_CYLINDER, .centre = {1.0, 2.0, 0.0}};
    definition.motion.kind = MOTION_RIGID;
    definition.motion.axis[2] = 1.0;
    definition.motion.angular_velocity = expression_constant(2.0);
    model.surfaces = &definition;
    struct surface *s;
    assert_int_equal(surface_create(&s, &model, 0, 0.0), 0);
    assert_int_equal(s->n_points, 1);
    assert_int_equal(s->n_facets, 0);
    assert_true(s->moving && !s->coupled);
    assert_true(s->now.x[0][1] == 2.0 && s->now.v[0][0] == -4.0);
    surface_destroy(s);
    motion_reset(&definition.motion);
    surface_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_create),          cmocka_unit_test(test_add_nodes),
        cmocka_unit_test(test_levels),          cmocka_unit_test(test_loads),
        cmocka_unit_test(test_parts_of_a_step), cmocka_unit_test(test_added_mass),
        cmocka_unit_test(test_many_contacts),   cmocka_unit_test(test_spread),
        cmocka_unit_test(test_analytic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
