// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid/fluid_case.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

double fluid_case_random(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 4503599627370496.0 - 1.0;
}

int fluid_case_create(struct fluid_case *c, int dim, const int cells[3], double dx, double jitter,
                      double speed, int cluster, enum arithmetic arithmetic, const char *isa)
{
    static char formulation[] = "transport-velocity", kernel[] = "quintic-spline", path[] = "test.xml";
    memset(c, 0, sizeof *c);
    c->material = (struct fluid_material){.name = formulation,
                                          .density = 1.3,
                                          .kinematic_viscosity = 0.017,
                                          .sound_speed = 11.0,
                                          .background_pressure = 190.0};
    struct model *model = &c->model;
    model->path = model->name = path;
    model->dim = dim;
    size_t n = 1;
    for (int k = 0; k < dim; ++k) {
        model->domain.lower[k] = -0.3 * dx;
        model->domain.upper[k] = (cells[k] - 0.3) * dx;
        model->domain.periodic[k] = true;
        n *= (size_t)cells[k];
    }
    for (int k = 0; k < 3; ++k)
        model->time.body_force[k] = expression_constant(0.1 * k - 0.03);
    c->region.n_points = n;
    c->region.points = memory_create(n, sizeof *c->region.points);
    CHECK_MEMORY(c->region.points);
    uint64_t seed = 12345;
    for (size_t i = 0; i < n; ++i) {
        size_t rest = i;
        for (int k = 0; k < dim; ++k) {
            double place = (double)(rest % (size_t)cells[k]) + 0.2, half = 0.5 * cells[k];
            rest /= (size_t)cells[k];
            if (cluster)
                place = half + (place - half) * (0.4 + 0.6 * fabs(place - half) / half);
            c->region.points[i][k] = dx * (place + jitter * fluid_case_random(&seed));
        }
    }
    model->fluid = (struct model_fluid){.present = true,
                                        .formulation = formulation,
                                        .kernel = kernel,
                                        .spacing = dx,
                                        .smoothing_length_ratio = 1.0,
                                        .arithmetic = arithmetic,
                                        .n_regions = 1,
                                        .regions = &c->region};
    model->n_fluid_materials = 1;
    model->fluid_materials = &c->material;
    const struct fluid_parts parts = {.isa = isa, .timer = &c->timer};
    CALL(fluid_create(&c->fluid, model, &parts));
    struct particles *block = (struct particles *)fluid_particles(c->fluid);
    for (size_t i = 0; i < block->n; ++i)
        for (int k = 0; k < dim; ++k)
            block->u[k][i] = speed * fluid_case_random(&seed);
    return 0;
}

void fluid_case_reset(struct fluid_case *c)
{
    fluid_destroy(c->fluid);
    memory_free(c->region.points);
    for (int k = 0; k < 3; ++k)
        expression_destroy(c->model.time.body_force[k]);
}
