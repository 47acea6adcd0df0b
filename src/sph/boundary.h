// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_BOUNDARY_H
#define SPH_BOUNDARY_H

#include "base/field.h"
#include "model/model.h"
#include "model/particles.h"
#include "model/surface.h"
#include "sph/cell_grid.h"
#include "sph/isa.h"
#include "sph/kernel.h"
#include "sph/turning_load.h"

/** The seam between fluid and walls: wall/ implements it, fluid/ calls it. Everything here is double
 * precision and in global coordinates, so that action and reaction are equal to rounding. */

/** What a boundary may read of the fluid at an evaluation. Arrays are those of the moving block. */
struct fluid_view {
    int dim;
    double t;       /**< evaluation time */
    double dt;      /**< step that leads there, s */
    double spacing; /**< dx */
    double mass;    /**< of a fluid particle */
    double skin;    /**< lists hold everything within their range + skin */
    struct kernel kernel;
    double density, sound_speed, viscosity; /**< rho0, c, dynamic viscosity eta */
    double body_force[3];                   /**< at t */
    const struct particles *particles; /**< x at t, u = half-step velocity, rho and p of the newest pass */
    const struct cell_grid *grid;      /**< of the moving block */
    enum isa isa;                      /**< instruction set of sums */
};

/** Wall neighbours of one fluid particle in the packed form that every formulation understands. */
struct wall_neighbours {
    size_t n, capacity;
    double *dx[3];      /**< r_i - r_k */
    double *r, *w, *dw; /**< |r_i - r_k|, W, dW/dr */
    double *volume, *rho, *p;
    double *u[3];         /**< kinematic velocity of the wall there (continuity) */
    double *u_viscous[3]; /**< extrapolated velocity (viscous term) */
    double *a[3];         /**< acceleration of the wall there */
    double *normal[3];    /**< into the fluid */
    double *share_density, *share_pressure,
        *share_viscous; /**< facet shares (walls.md); 1 for particle walls */
    int32_t *source;    /**< contact (within the near particle) or wall particle, for boundary_react */
};

struct boundary;

/** A wall treatment. */
struct boundary_type {
    const char *name;
    /** Say why a wall of the model cannot be treated so (STATUS_DECK, reported with its line), or 0. */
    int (*check)(const struct model *model, const struct model_wall *wall);
    /** Build from boundary->wall and ->surfaces. */
    int (*create)(struct boundary *boundary, const struct model *model, const struct fluid_view *view);
    void (*destroy)(struct boundary *boundary);
    /** After each sort of the moving block: find the particles within range + skin (near) of where the wall
     * stands at view->t and its surfaces @c now. A resumed run calls it once more for the same places. */
    int (*list)(struct boundary *boundary, const struct fluid_view *view);
    /** Add field groups with what the treatment carries from step to step; may be NULL. */
    int (*state)(struct boundary *boundary, struct field_list *list);
    /** Once a step after the drift: put penetrated particles back (3-D sliding walls); may be NULL. */
    int (*put_back)(struct boundary *boundary, const struct fluid_view *view, struct particles *particles);
    /** Surfaces have been evaluated (now): projection and shares, or moving the wall particles; fills
     * kernel_sum. @p again: nothing but surfaces of solids has moved since the last call, and little: what
     * decides which wall points a particle meets, and how much they weigh, may stay. */
    int (*prepare)(struct boundary *boundary, const struct fluid_view *view, bool again);
    /** p, rho, u of wall particles or contacts from the fluid's newest rho, p, u. */
    int (*close)(struct boundary *boundary, const struct fluid_view *view);
    /** Wall neighbours of near particle number @p near (within the support), appended to nothing: n is set.
     * Thread-safe for different @p near and @p neighbours. A neighbour may stand for several particles. */
    int (*gather)(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                  struct wall_neighbours *neighbours);
    /** The same with each wall particle on its own, for output. */
    int (*unfold)(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                  struct wall_neighbours *neighbours);
    /** Reaction: @p force[k] (component arrays) is the force of neighbour k on the fluid particle; store its
     * negative per source for near particle @p near. Thread-safe for different @p near. */
    void (*react)(struct boundary *boundary, size_t near, const struct wall_neighbours *neighbours,
                  double *const force[3]);
    /** Add the stored reactions to surface loads, per point in fixed order (near particle, contact). */
    void (*load)(struct boundary *boundary, const struct fluid_view *view);
    /** Derivative of the load by the surface's acceleration into surface->added_mass; may be NULL. */
    int (*added_mass)(struct boundary *boundary, const struct fluid_view *view);
};

struct boundary {
    const struct boundary_type *type;
    const struct model_wall *wall;
    void *data; /**< of the treatment */
    size_t n_surfaces;
    struct surface **surfaces;    /**< not owned */
    struct turning_load *turning; /**< of each moving surface of facets */
    bool moving;                  /**< some surface moves, or the wall particles do */
    bool coupled;                 /**< some surface is moved by a solid */
    size_t n_near, near_capacity;
    uint32_t *near;                 /**< indices of near particles in the moving block, ascending */
    double *kernel_sum;             /**< per near particle: sum over the wall of share_density W, 1/m^dim */
    double drift;                   /**< how far the wall may have moved since the lists were made, m; the
                                       fluid sets it to 0 then */
    const double *wall_x[3];        /**< places of wall particles for the output, or NULL */
    struct field_group wall_fields; /**< of the wall particles */
    struct field wall_field_list[5];
    int64_t put_back_count; /**< particles put back so far */
    struct field_group state;
    struct field state_fields[2];
};

/** Create the boundary of wall @p index; @p surfaces are all surfaces of the model, by index. */
int boundary_create(struct boundary **boundary, const struct model *model, int index,
                    struct surface **surfaces, const struct fluid_view *view,
                    const struct boundary_type *const *types, size_t n_types);
void boundary_destroy(struct boundary *boundary);

/** Add everything that the boundary carries from step to step. */
int boundary_state(struct boundary *boundary, struct field_list *list);

/** Evaluate the surfaces at view->t, then prepare. */
int boundary_prepare(struct boundary *boundary, const struct fluid_view *view, bool again);

/** Loads of the surfaces: the reactions, and what the forces between particles leave out of the viscous
 * stress at walls that turn or stretch (turning_load.h). */
void boundary_load(struct boundary *boundary, const struct fluid_view *view);

/** Room for @p n near particles (near, kernel_sum). */
int boundary_reserve_near(struct boundary *boundary, size_t n);

/** Room for @p n packed neighbours. */
int wall_neighbours_reserve(struct wall_neighbours *neighbours, size_t n);
void wall_neighbours_reset(struct wall_neighbours *neighbours);

#endif
