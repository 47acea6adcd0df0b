// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/cell_grid.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>
#include <string.h>

int cell_grid_create(struct cell_grid *grid, int dim, const double lower[3], const double upper[3],
                     const bool periodic[3], double reach, double width, double fine)
{
    *grid = (struct cell_grid){.dim = dim};
    double total = 1.0;
    for (int k = 0; k < 3; ++k) {
        bool used = k < dim;
        double length = used ? upper[k] - lower[k] : 1.0;
        double least = k == 0 ? fine : width;
        grid->lower[k] = used ? lower[k] : -0.5;
        grid->upper[k] = used ? upper[k] : 0.5;
        grid->periodic[k] = used && periodic[k];
        CHECK(!grid->periodic[k] || length > 2.0 * reach, STATUS_DECK,
              "the domain is periodic in %c over %g m: it must be longer than %g m, twice the reach of a "
              "particle",
              "xyz"[k], length, 2.0 * reach);
        double count = used ? fmax(1.0, floor(length / least * (1.0 + 1e-12))) : 1.0;
        total *= count;
        CHECK(total < 2.0e9, STATUS_DECK,
              "the domain needs more than 2e9 search cells: it is too large for this particle spacing");
        grid->cells[k] = (int)count;
        grid->row_width[k] = length / count;
        grid->inverse_width[k] = count / length;
    }
    return memory_grow((void **)&grid->start, &grid->start_capacity, (size_t)total + 1, sizeof *grid->start);
}

void cell_grid_reset(struct cell_grid *grid)
{
    memory_free(grid->start);
    memory_free(grid->cell_of);
    memory_free(grid->count);
    *grid = (struct cell_grid){0};
}

static int cell_clamped(const struct cell_grid *grid, int k, double x)
{
    double c = floor((x - grid->lower[k]) * grid->inverse_width[k]);
    return c < 0.0 ? 0 : c >= grid->cells[k] ? grid->cells[k] - 1 : (int)c;
}

/** The cells of points first to last - 1, and how many are in each: @p count. */
static void part_count(struct cell_grid *grid, const double *const x[3], size_t first, size_t last,
                       uint32_t *count)
{
    for (size_t i = first; i < last; ++i) {
        size_t c = 0;
        for (int k = grid->dim - 1; k >= 0; --k)
            c = c * (size_t)grid->cells[k] + (size_t)cell_clamped(grid, k, x[k][i]);
        grid->cell_of[i] = (uint32_t)c;
        ++count[c];
    }
}

int cell_grid_sort(struct cell_grid *grid, const double *const x[3], size_t n, uint32_t *order)
{
    CHECK(n < UINT32_MAX, STATUS_MEMORY, "%zu particles are more than a search grid can number", n);
    const size_t cells = (size_t)grid->cells[0] * (size_t)grid->cells[1] * (size_t)grid->cells[2];
    /* one part of the points per thread; few threads where counting them by cells would be the larger work */
    const size_t most = 1 + 2 * n / (cells + 1), threads = (size_t)parallel_threads(),
                 parts = threads < most ? threads : most;
    CALL(memory_grow((void **)&grid->cell_of, &grid->cell_of_capacity, n, sizeof *grid->cell_of));
    CALL(memory_grow((void **)&grid->count, &grid->count_capacity, parts * cells, sizeof *grid->count));
#pragma omp parallel for schedule(static, 1)
    for (size_t part = 0; part < parts; ++part) {
        memset(grid->count + part * cells, 0, cells * sizeof *grid->count);
        part_count(grid, x, n * part / parts, n * (part + 1) / parts, grid->count + part * cells);
    }
    /* from here on a count is where the next point of this part and cell goes */
    uint32_t next = 0;
    for (size_t c = 0; c < cells; ++c) {
        grid->start[c] = next;
        for (size_t part = 0; part < parts; ++part) {
            const uint32_t here = grid->count[part * cells + c];
            grid->count[part * cells + c] = next;
            next += here;
        }
    }
    grid->start[cells] = next;
#pragma omp parallel for schedule(static, 1)
    for (size_t part = 0; part < parts; ++part)
        for (size_t i = n * part / parts; i < n * (part + 1) / parts; ++i)
            order[grid->count[part * cells + grid->cell_of[i]]++] = (uint32_t)i;
    grid->moved = 0.0;
    return 0;
}

static int wrap_count(int index, int n)
{
    return index >= 0 ? index / n : -((n - 1 - index) / n);
}

size_t cell_grid_box_ranges(const struct cell_grid *grid, const double lower[3], const double upper[3],
                            struct cell_range ranges[CELL_GRID_RANGES])
{
    int low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    double length[3];
    for (int k = 0; k < 3; ++k) {
        length[k] = grid->upper[k] - grid->lower[k];
        if (k >= grid->dim)
            continue;
        /* a diverged particle has no neighbours; it is still written out */
        if (!isfinite(lower[k]) || !isfinite(upper[k]))
            return 0;
        if (grid->periodic[k]) {
            low[k] = (int)floor((lower[k] - grid->moved - grid->lower[k]) * grid->inverse_width[k]);
            high[k] = (int)floor((upper[k] + grid->moved - grid->lower[k]) * grid->inverse_width[k]);
        } else {
            low[k] = cell_clamped(grid, k, lower[k] - grid->moved);
            high[k] = cell_clamped(grid, k, upper[k] + grid->moved);
        }
    }
    size_t n = 0;
    for (int cz = low[2]; cz <= high[2]; ++cz) {
        int wz = wrap_count(cz, grid->cells[2]);
        for (int cy = low[1]; cy <= high[1]; ++cy) {
            int wy = wrap_count(cy, grid->cells[1]);
            size_t row = ((size_t)(cz - wz * grid->cells[2]) * (size_t)grid->cells[1] +
                          (size_t)(cy - wy * grid->cells[1])) *
                         (size_t)grid->cells[0];
            for (int cx = low[0]; cx <= high[0] && n < CELL_GRID_RANGES;) {
                int wx = wrap_count(cx, grid->cells[0]);
                int last = (wx + 1) * grid->cells[0] - 1;
                if (last > high[0])
                    last = high[0];
                uint32_t begin = grid->start[row + (size_t)(cx - wx * grid->cells[0])];
                uint32_t end = grid->start[row + (size_t)(last - wx * grid->cells[0]) + 1];
                if (end > begin)
                    ranges[n++] =
                        (struct cell_range){begin, end, {wx * length[0], wy * length[1], wz * length[2]}};
                cx = last + 1;
            }
        }
    }
    return n;
}

size_t cell_grid_ranges(const struct cell_grid *grid, const double x[3], double radius,
                        struct cell_range ranges[CELL_GRID_RANGES])
{
    const double lower[3] = {x[0] - radius, x[1] - radius, x[2] - radius};
    const double upper[3] = {x[0] + radius, x[1] + radius, x[2] + radius};
    return cell_grid_box_ranges(grid, lower, upper, ranges);
}
