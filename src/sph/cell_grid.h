// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_CELL_GRID_H
#define SPH_CELL_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Cells for finding neighbours: pencils along x ("rows", row-major in y and z), each cut into short cells.
 * Points are sorted by row, then cell, then previous index, so that neighbours lie close in memory and a
 * search reads few contiguous runs. Instantiable: moving particles, wall particles, facets. */
struct cell_grid {
    int dim;
    double lower[3], upper[3]; /**< domain; periodic directions wrap there */
    bool periodic[3];
    double row_width[3]; /**< width of a cell per direction ([0]: of the cells along x) */
    double inverse_width[3];
    int cells[3];
    uint32_t *start; /**< cells + 1 entries: first sorted point of each cell */
    size_t start_capacity;
    double moved;              /**< how far any point may have moved since the grid was made, m */
    uint32_t *cell_of, *count; /**< workspace: of each point; per part of the points and cell */
    size_t cell_of_capacity, count_capacity;
};

/** A run of consecutive sorted points near a place; add @c shift to their coordinates (periodic images). */
struct cell_range {
    uint32_t begin, end;
    double shift[3];
};

enum { CELL_GRID_RANGES = 512 };

/** Prepare for a domain; @p reach: how far searches look at most (periodic directions must be longer than
 * twice that); @p width: least width of rows; @p fine: of the cells along x. */
int cell_grid_create(struct cell_grid *grid, int dim, const double lower[3], const double upper[3],
                     const bool periodic[3], double reach, double width, double fine);
void cell_grid_reset(struct cell_grid *grid);

/** Sort @p n points (separate coordinate arrays): @p order[new] = old. Points outside the domain (not
 * periodic) go to the border cells. moved := 0. Returns a status. */
int cell_grid_sort(struct cell_grid *grid, const double *const x[3], size_t n, uint32_t *order);

/** Runs that contain every point within @p radius (plus grid->moved) of @p x, in fixed order; at most
 * CELL_GRID_RANGES. Returns their number. */
size_t cell_grid_ranges(const struct cell_grid *grid, const double x[3], double radius,
                        struct cell_range ranges[CELL_GRID_RANGES]);

/** The same for every point in the box [lower, upper] (widened by grid->moved). */
size_t cell_grid_box_ranges(const struct cell_grid *grid, const double lower[3], const double upper[3],
                            struct cell_range ranges[CELL_GRID_RANGES]);

#endif
