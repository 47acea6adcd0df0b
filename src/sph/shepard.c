// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/shepard.h"

double shepard_means(const struct shepard *shepard, const double x[3], size_t n, const double *const *values,
                     double *means)
{
    const struct kernel *kernel = shepard->kernel;
    const double *const *y = shepard->x, support2 = kernel->support * kernel->support;
    struct cell_range ranges[CELL_GRID_RANGES];
    const size_t n_ranges = cell_grid_ranges(shepard->grid, x, kernel->support, ranges);
    double weight = 0.0;
    for (size_t v = 0; v < n; ++v)
        means[v] = 0.0;
    for (size_t r = 0; r < n_ranges; ++r) {
        const double *shift = ranges[r].shift;
        const double near[3] = {x[0] - shift[0], x[1] - shift[1], x[2] - shift[2]};
        for (uint32_t j = ranges[r].begin; j < ranges[r].end; ++j) {
            const double dx = near[0] - y[0][j], dy = near[1] - y[1][j], dz = near[2] - y[2][j],
                         r2 = dx * dx + dy * dy + dz * dz;
            if (r2 >= support2 || (shepard->kind && shepard->kind[j] != PARTICLE_FLUID))
                continue;
            const double w = shepard->m[j] / shepard->rho[j] * kernel_w(kernel, sqrt(r2));
            weight += w;
            for (size_t v = 0; v < n; ++v)
                means[v] += w * values[v][j];
        }
    }
    for (size_t v = 0; v < n; ++v)
        means[v] = weight > 0.0 ? means[v] / weight : NAN;
    return weight;
}
