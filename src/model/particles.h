// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_PARTICLES_H
#define MODEL_PARTICLES_H

#include "base/field.h"

#include <stdint.h>

enum particle_kind { PARTICLE_FLUID = 0, PARTICLE_INFLOW = 1, PARTICLE_OUTFLOW = 2 };

/** A block of particles as a structure of arrays. The moving block (fluid and open-boundary zones) is sorted
 * by the cell grid; nothing may keep indices across a sort, only ids. Vectors are separate arrays per
 * component; those beyond the dimension of the problem exist and are zero: all the same array, not to be
 * written. */
struct particles {
    int dim;
    size_t n, capacity;
    int64_t next_id;
    int64_t *id;
    uint8_t *kind;
    uint8_t *opening;          /**< zone particles: number of their opening */
    double *x[3];              /**< m */
    double *u[3];              /**< momentum velocity, m/s */
    double *rho;               /**< kg/m^3 */
    double *p;                 /**< Pa */
    double *m;                 /**< kg (2-D: kg/m) */
    struct field_group fields; /**< every array above and those of particles_add_field */
    size_t fields_capacity;
    void ***owners; /**< addresses of the pointers to the arrays, refreshed when arrays move */
    void *zeros;    /**< components beyond the dimension */
    void *scratch;  /**< room for one array of 8-byte items, for whoever is at work: the sort, mostly */
};

/** An empty block with room for @p capacity particles. */
int particles_create(struct particles **particles, const char *name, int dim, size_t capacity);
void particles_destroy(struct particles *particles);

/** Register one more double array with @p components (1 or 3) under @p name (kept, not copied); data[] is
 * where the owner keeps its pointers: 1 or 3 of them, one behind the other, which stay where they are as long
 * as the block lives. The block frees the arrays. Field groups may move: pointers into fields.fields end
 * here. */
int particles_add_field(struct particles *particles, const char *name, const char *unit, int components,
                        unsigned flags, double **data);

/** Give a registered field more flags (FIELD_STATE: something reads it across steps). */
void particles_add_flags(struct particles *particles, const char *name, unsigned flags);

/** Make room for @p capacity particles; all arrays may move (registered pointers are refreshed). */
int particles_reserve(struct particles *particles, size_t capacity);

/** Append a particle (all fields 0 but these; a new id); returns its index in *@p index unless that is NULL.
 * Arrays move when the room is used up. */
int particles_append(struct particles *particles, enum particle_kind kind, const double x[3], double m,
                     size_t *index);

/** Reorder every SORTED field: new[i] = old[order[i]], n := @p n (particles not named vanish). Bitwise
 * deterministic. Arrays move (registered pointers are refreshed). STATUS_NUMERICAL when @p order does not fit
 * the block: nothing changes. */
int particles_permute(struct particles *particles, const uint32_t *order, size_t n);

#endif
