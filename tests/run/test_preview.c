// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "run/preview_physics.h"

#include <math.h>
#include <string.h>

static void assert_near(double value, double wanted)
{
    if (!(fabs(value - wanted) <= 1e-12 * fabs(wanted)))
        fail_msg("%.17g is not %.17g", value, wanted);
}

static void test_thickness(void **state)
{
    (void)state;
    double box[4][3] = {{0, 0, 0}, {3, 0, 0}, {3, 0.7, 0}, {0, 0.7, 0}}, where[3];
    int32_t inside_solid[4][4] = {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}};
    int32_t inside_fluid[4][4] = {{1, 0, -1, -1}, {2, 1, -1, -1}, {3, 2, -1, -1}, {0, 3, -1, -1}};
    assert_near(preview_thickness(&(struct facets){2, 4, 4, box, inside_solid}, where), 0.7);
    assert_near(where[0], 1.5);
    assert_true(isinf(preview_thickness(&(struct facets){2, 4, 4, box, inside_fluid}, where)));
    assert_true(isinf(preview_thickness(&(struct facets){2, 4, 3, box, inside_solid}, where)));

    double brick[8][3];
    for (int i = 0; i < 8; i++)
        for (int d = 0; d < 3; d++)
            brick[i][d] = (i >> d & 1) * (2.0 - 0.7 * d);
    int32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    assert_near(preview_thickness(&(struct facets){3, 8, 6, brick, quads}, where), 0.6);
}

/** The limits of paper 000, eq. 25, with the highest speed of openings, walls and regions. */
static void test_limits(void **state)
{
    (void)state;
    struct fluid_material water = {.name = "water",
                                   .density = 1000,
                                   .kinematic_viscosity = 0.03,
                                   .sound_speed = 20,
                                   .background_pressure = 0};
    struct model_region region = {.shape = {.kind = SHAPE_BOX, .b = {1, 1, 0}}};
    struct model_open open = {.kind = OPEN_INFLOW, .upper = {0, 1, 0}};
    struct model model = {
        .dim = 2, .n_fluid_materials = 1, .fluid_materials = &water, .n_openings = 1, .openings = &open};
    model.fluid = (struct model_fluid){
        .present = true, .spacing = 0.01, .smoothing_length_ratio = 1.5, .n_regions = 1, .regions = &region};
    model.time.end = 2.0;
    model.time.step = 1e-3;
    const struct expression_scope scope = {0};
    char message[128];
    assert_int_equal(
        expression_create(&open.velocity[0], "4*y*(1-y)*min(t,1)*2", &scope, message, sizeof message), 0);
    model.time.body_force[1] = expression_constant(-9.81);
    struct preview_limits limits;
    preview_find_limits(&model, &limits);
    assert_near(limits.speed, 2.0);
    assert_near(limits.sound, 0.25 * 0.015 / 22.0);
    assert_near(limits.viscosity, 0.125 * 0.015 * 0.015 / 0.03);
    assert_near(limits.body_force, 0.25 * sqrt(0.015 / 9.81));
    region.velocity[1] = expression_constant(-7.0);
    preview_find_limits(&model, &limits);
    assert_near(limits.speed, 7.0);
    water.kinematic_viscosity = 0.0;
    preview_find_limits(&model, &limits);
    assert_true(isinf(limits.viscosity));
    expression_destroy(region.velocity[1]);
    expression_destroy(open.velocity[0]);
    expression_destroy(model.time.body_force[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_thickness), cmocka_unit_test(test_limits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
