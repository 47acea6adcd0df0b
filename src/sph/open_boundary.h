// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_OPEN_BOUNDARY_H
#define SPH_OPEN_BOUNDARY_H

#include "sph/boundary.h"

struct open_boundary;

/** The seam between fluid and open boundaries: open/ implements it, fluid/ calls it (numerics: zones of
 * particles that are recycled). Zones are deep enough that a newborn is in every list. Particles change kind,
 * are born and die only in the sort. */
struct open_boundary_type {
    const char *name;
    int (*create)(struct open_boundary *open, const struct model *model, const struct fluid_view *view);
    void (*destroy)(struct open_boundary *open);
    /** Velocities u of zone particles at time @p t, before the drift that ends there. */
    int (*velocities)(struct open_boundary *open, const struct fluid_view *view, struct particles *particles,
                      double t);
    /** Before the sort: change kinds, append the newborn, mark the dead (@p dead: one flag per particle that
     * exists when called). */
    int (*move)(struct open_boundary *open, const struct fluid_view *view, struct particles *particles,
                uint8_t *dead);
    /** After the sort: find the zone's particles and what they need of the fluid. */
    int (*list)(struct open_boundary *open, const struct fluid_view *view);
    /** p and rho of zone particles from the fluid or the deck. */
    int (*values)(struct open_boundary *open, const struct fluid_view *view, struct particles *particles);
};

struct open_boundary {
    const struct open_boundary_type *type;
    const struct model_open *definition;
    int index;    /**< number of the opening: particles->opening */
    double depth; /**< of the zone, L_z, m */
    size_t n_zone, zone_capacity;
    uint32_t *zone; /**< indices of zone particles, ascending */
    void *data;
    int64_t born, removed; /**< particles so far */
    struct field_group state;
    struct field state_fields[2];
    bool reads_density; /**< set by create: velocities reads rho and p of the step before */
};

#endif
