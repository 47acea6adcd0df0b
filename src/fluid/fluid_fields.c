// SPDX-License-Identifier: GPL-3.0-or-later
/* What the fluid offers to the output: the block's fields in the order users expect, and fields computed on
 * demand. */
#include "base/error.h"
#include "fluid/fluid_internal.h"

#include <math.h>
#include <string.h>

static int smoothing_length_fill(const void *owner, const struct field *field, void *destination)
{
    const struct fluid *fluid = owner;
    double *h = destination;
    (void)field;
    for (size_t i = 0; i < fluid->block->n; ++i)
        h[i] = fluid->view.kernel.h;
    return 0;
}

/** Loop over the neighbours of particle @p i within the support: sum of V W, and curl of the velocity sum V
 * (u_j - u_i) x (-grad W). */
static void particle_sums(const struct fluid *fluid, size_t i, double *support, double vorticity[3])
{
    const struct particles *b = fluid->block;
    const struct kernel *kernel = &fluid->view.kernel;
    struct cell_range ranges[CELL_GRID_RANGES];
    double x[3] = {b->x[0][i], b->x[1][i], b->x[2][i]};
    size_t n = cell_grid_ranges(&fluid->grid, x, kernel->support, ranges);
    *support = vorticity[0] = vorticity[1] = vorticity[2] = 0.0;
    for (size_t r = 0; r < n; ++r)
        for (uint32_t j = ranges[r].begin; j < ranges[r].end; ++j) {
            double d[3], u[3], r2 = 0.0;
            for (int k = 0; k < 3; ++k) {
                d[k] = x[k] - b->x[k][j] - ranges[r].shift[k];
                u[k] = b->u[k][j] - b->u[k][i];
                r2 += d[k] * d[k];
            }
            if (r2 >= kernel->support * kernel->support)
                continue;
            double distance = sqrt(r2), volume = b->m[j] / b->rho[j];
            *support += volume * kernel_w(kernel, distance);
            double f = j == i ? 0.0 : volume * kernel_dw(kernel, distance) / distance;
            for (int k = 0; k < 3; ++k)
                vorticity[k] -= f * (u[(k + 1) % 3] * d[(k + 2) % 3] - u[(k + 2) % 3] * d[(k + 1) % 3]);
        }
}

static int support_fill(const void *owner, const struct field *field, void *destination)
{
    const struct fluid *fluid = owner;
    double *support = destination;
    (void)field;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < fluid->block->n; ++i) {
        double vorticity[3];
        particle_sums(fluid, i, &support[i], vorticity);
    }
    return 0;
}

static int vorticity_fill(const void *owner, const struct field *field, void *destination)
{
    const struct fluid *fluid = owner;
    double(*vorticity)[3] = destination;
    (void)field;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < fluid->block->n; ++i) {
        double support;
        particle_sums(fluid, i, &support, vorticity[i]);
    }
    return 0;
}

const struct field_group *fluid_output(struct fluid *fluid)
{
    static const char *const first[] = {"Density", "Mass"}, *const others[] = {"Velocity", "Pressure", "Id",
                                                                               "Acceleration", "Kind"};
    const struct field_group *block = &fluid->block->fields;
    struct field *out = fluid->output_fields;
    for (size_t k = 0; k < sizeof first / sizeof *first; ++k)
        *out++ = *field_find(block, first[k]);
    *out++ =
        (struct field){"SmoothingLength", "m", FIELD_DOUBLE, 1, FIELD_OUTPUT, {0}, smoothing_length_fill};
    for (size_t k = 0; k < sizeof others / sizeof *others; ++k) {
        const struct field *field = field_find(block, others[k]);
        if (field)
            *out++ = *field;
    }
    *out++ = (struct field){"Support", "-", FIELD_DOUBLE, 1, FIELD_OUTPUT, {0}, support_fill};
    *out++ = (struct field){"Vorticity", "1/s", FIELD_DOUBLE, 3, FIELD_OUTPUT, {0}, vorticity_fill};
    fluid->output = (struct field_group){"fluid", fluid, &fluid->block->n, fluid->output_fields,
                                         (size_t)(out - fluid->output_fields)};
    return &fluid->output;
}
