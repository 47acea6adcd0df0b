// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FLUID_FLUID_INTERNAL_H
#define FLUID_FLUID_INTERNAL_H

#include "fluid/fluid.h"
#include "sph/isa.h"
#include "sph/neighbour_list.h"

/** Accelerations of the near particles of one boundary by its wall: a (eq. 40) and a_background; one entry
 * per near particle. */
struct fluid_wall_forces {
    size_t capacity;
    double *a[3], *a_background[3];
};

/** What every formulation shares: the moving block, its grid and lists, the walls and open boundaries around
 * it. Private to the files of this folder. */
struct fluid {
    const struct fluid_type *type;
    void *data; /**< of the formulation */
    const struct model *model;
    const struct fluid_material *material;
    struct particles *block;
    struct cell_grid grid;
    struct neighbour_list list;
    struct fluid_view view;
    size_t n_boundaries;
    struct boundary **boundaries;
    struct fluid_wall_forces *wall_forces; /**< one per boundary */
    size_t n_openings;
    struct open_boundary *openings;
    double skin;       /**< of the lists, m */
    double drift;      /**< how far a particle may have moved since the lists were made, m */
    double list_time;  /**< when they were made, s */
    double *listed[3]; /**< places of the particles then */
    uint32_t *order;
    size_t order_capacity;
    uint8_t *dead;
    size_t dead_capacity;
    size_t n_scratch;
    struct wall_neighbours *scratch; /**< one per thread */
    double **force;                  /**< per thread: 3 rows of pair forces */
    size_t *force_capacity;
    struct timer *timer;
    enum isa isa;
    int64_t rebuilds;
    struct field_group output, state;
    struct field output_fields[16], state_fields[4];
};

/** A fluid formulation. Wall sweeps are called with the boundary's neighbours gathered; @c a of
 * fluid_wall_forces is overwritten. */
struct fluid_type {
    const char *name;
    int (*create)(struct fluid *fluid);
    void (*destroy)(struct fluid *fluid);
    /** First kick and drift to view.t; returns through @p moved the largest distance any particle went. */
    int (*drift)(struct fluid *fluid, double dt, double *moved);
    /** Before the evaluation at the very start: velocities as after a drift of no length. */
    void (*start)(struct fluid *fluid);
    /** Fluid-fluid density sums. */
    int (*density)(struct fluid *fluid);
    /** Density and pressure of all particles (@p coupled_only: of those near coupled boundaries) from fluid
     * and walls. */
    void (*pressure)(struct fluid *fluid, bool coupled_only);
    /** Pair term of one fluid particle with its packed wall neighbours: accelerations @p a, @p a_background,
     * and per neighbour the force on the particle. */
    void (*wall_pair)(const struct fluid *fluid, size_t i, const struct wall_neighbours *neighbours,
                      double a[3], double a_background[3], double *const force[3]);
    /** Memory of the formulation that is no field of the block. */
    size_t (*bytes)(const struct fluid *fluid);
    /** Fluid-fluid forces, wall forces added, final kick over dt. */
    int (*finish)(struct fluid *fluid, double dt);
};

/** Wall forces of boundary @p b on its near particles and the reactions, in parallel (fluid_walls.c). */
int fluid_wall_forces(struct fluid *fluid, size_t b);

/** Sort, lists of fluid, walls and openings (fluid_lists.c). */
int fluid_rebuild(struct fluid *fluid);

/** The same lists once more, from what the state remembers of the last rebuild. */
int fluid_relist(struct fluid *fluid);

extern const struct fluid_type fluid_transport_velocity;

#endif
