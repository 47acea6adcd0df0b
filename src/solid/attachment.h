// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_ATTACHMENT_H
#define SOLID_ATTACHMENT_H

#include "model/surface.h"

/** The map from a solid's nodes to the points of a surface; loads go back by its transpose. */
struct attachment {
    struct surface *surface; /**< not owned */
    size_t n;
    int32_t *points; /**< of the surface */
    int32_t *nodes;  /**< of the mesh that move them */
    bool *leads;     /**< the node belongs to no earlier pair: it takes its correction from this one */
    double (*acceleration)[3], (*reaction)[3]; /**< workspace: all points of the surface */
};

/** Pair the points of @p surface that belong to mesh @p mesh; @p claimed (per node) is updated. Returns 0 or
 * STATUS_MEMORY. */
int attachment_init(struct attachment *attachment, struct surface *surface, int mesh, bool *claimed);
void attachment_reset(struct attachment *attachment);

/** Points of @p motion := places X + d, velocities and accelerations of the nodes (rows of 3). */
void attachment_move(const struct attachment *attachment, const double (*X)[3], const double (*d)[3],
                     const double (*v)[3], const double (*a)[3], struct surface_motion *motion);

/** Add to the displacements of the nodes what the points' level 1 is ahead of their trial: the scheme has
 * relaxed the answer. Exactly 0 otherwise. Returns whether any node moved. */
bool attachment_follow(const struct attachment *attachment, double (*d)[3]);

/** f[node] += load of the points. */
void attachment_add_load(const struct attachment *attachment, double (*f)[3]);

/** f[node] += added mass of the surface applied to the nodes' accelerations @p a; @p per_acceleration as in
 * surface_added_mass_apply. */
void attachment_add_added_mass(struct attachment *attachment, const double (*a)[3], double per_acceleration,
                               double (*f)[3]);

#endif
