// SPDX-License-Identifier: GPL-3.0-or-later
/* What the fluid offers to the output: the block's fields in the order users expect, and fields computed on
 * demand. */
#include "base/error.h"
#include "fluid/fluid_internal.h"

#include <math.h>
#include <stdbool.h>
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

/** What is summed over the neighbours of a particle within the support: V W, and for the curl of the velocity
 * V (u_j - u_i) x (-grad W). */
struct particle_sums {
    double support, vorticity[3];
};

/** @p dim and @p curl are constants where this is called: only what is asked for is computed. */
static inline __attribute__((always_inline)) struct particle_sums particle_sums(const struct fluid *fluid,
                                                                                size_t i, int dim, bool curl)
{
    const struct particles *b = fluid->block;
    const struct kernel *kernel = &fluid->view.kernel;
    struct particle_sums sums = {0};
    struct cell_range ranges[CELL_GRID_RANGES];
    const double x[3] = {b->x[0][i], b->x[1][i], b->x[2][i]}, support2 = kernel->support * kernel->support;
    size_t n = cell_grid_ranges(&fluid->grid, x, kernel->support, ranges);
    for (size_t r = 0; r < n; ++r)
        for (uint32_t j = ranges[r].begin; j < ranges[r].end; ++j) {
            double d[3] = {0}, u[3] = {0}, r2 = 0.0;
            for (int k = 0; k < dim; ++k) {
                d[k] = x[k] - b->x[k][j] - ranges[r].shift[k];
                r2 += d[k] * d[k];
            }
            if (r2 >= support2 || (curl && r2 == 0.0))
                continue;
            const double distance = sqrt(r2);
            if (!curl) {
                sums.support += b->m[j] / b->rho[j] * kernel_w(kernel, distance);
                continue;
            }
            const double f = b->m[j] * kernel_dw(kernel, distance) / (b->rho[j] * distance);
            for (int k = 0; k < dim; ++k)
                u[k] = b->u[k][j] - b->u[k][i];
            for (int k = dim == 3 ? 0 : 2; k < 3; ++k)
                sums.vorticity[k] -= f * (u[(k + 1) % 3] * d[(k + 2) % 3] - u[(k + 2) % 3] * d[(k + 1) % 3]);
        }
    return sums;
}

static int support_fill(const void *owner, const struct field *field, void *destination)
{
    const struct fluid *fluid = owner;
    double *support = destination;
    (void)field;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < fluid->block->n; ++i) {
        const struct particle_sums sums =
            fluid->view.dim == 3 ? particle_sums(fluid, i, 3, false) : particle_sums(fluid, i, 2, false);
        support[i] = sums.support;
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
        const struct particle_sums sums =
            fluid->view.dim == 3 ? particle_sums(fluid, i, 3, true) : particle_sums(fluid, i, 2, true);
        memcpy(vorticity[i], sums.vorticity, sizeof sums.vorticity);
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
