// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_PROBE_SUMS_H
#define RUN_PROBE_SUMS_H

#include "model/model.h"
#include "output/vtu.h"
#include "sph/cell_grid.h"
#include "sph/kernel.h"

#include <stdbool.h>

enum { PROBE_FIELDS = 32 };

/** A point array of the fluid. */
struct probe_field {
    char name[64];
    size_t column, components; /**< among the columns of the results; 0 components: not known yet */
    bool float64;
};

/** The fluid particles of a frame, ready for Shepard-corrected sums. */
struct probe_sums {
    const struct model *model;
    struct kernel kernel;
    struct cell_grid grid;
    size_t n_fields, n_columns; /**< columns: components of all fields */
    struct probe_field fields[PROBE_FIELDS];
    bool float64; /**< places of particles are known to all digits */
    bool warned;  /**< about frames that do not tell the kinds of particles */
    size_t n;
    double *data; /**< (5 + n_columns) x n: x, y, z, m, rho, columns; in the order of the grid */
};

/** For a run of @p model; @p fields: names separated by commas ("Support" is nothing to read: it comes
 * without asking). Returns 0, STATUS_USAGE or STATUS_MEMORY. */
int probe_sums_create(struct probe_sums *sums, const struct model *model, const char *fields);
void probe_sums_reset(struct probe_sums *sums);

/** Take the fluid particles of the frame in @p grid, read from @p path. Returns 0, STATUS_USAGE (no such
 * field), STATUS_IO (the frame does not fit the deck, or holds what is no number) or STATUS_MEMORY. */
int probe_sums_load(struct probe_sums *sums, const char *path, const struct vtu_grid *grid);

/** @p results: for each of @p n places (n_columns + 1) numbers: the means, NaN where no particle is in reach;
 * sum V W. */
void probe_sums_evaluate(const struct probe_sums *sums, size_t n, const double (*x)[3], double *results);

#endif
