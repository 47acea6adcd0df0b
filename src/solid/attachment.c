// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/attachment.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>

int attachment_init(struct attachment *attachment, struct surface *surface, int mesh, bool *claimed)
{
    *attachment = (struct attachment){.surface = surface};
    attachment->points = memory_create(surface->n_points, sizeof *attachment->points);
    attachment->nodes = memory_create(surface->n_points, sizeof *attachment->nodes);
    attachment->leads = memory_create(surface->n_points, sizeof *attachment->leads);
    attachment->acceleration = memory_create(surface->n_points, sizeof *attachment->acceleration);
    attachment->reaction = memory_create(surface->n_points, sizeof *attachment->reaction);
    if (!attachment->points || !attachment->nodes || !attachment->leads || !attachment->acceleration ||
        !attachment->reaction) {
        attachment_reset(attachment);
        return STATUS_MEMORY;
    }
    for (size_t p = 0; p < surface->n_points; p++) {
        if (surface->mesh[p] != mesh)
            continue;
        const int32_t node = surface->mesh_node[p];
        attachment->points[attachment->n] = (int32_t)p;
        attachment->nodes[attachment->n] = node;
        attachment->leads[attachment->n++] = !claimed[node];
        claimed[node] = true;
    }
    return 0;
}

void attachment_reset(struct attachment *attachment)
{
    memory_free(attachment->points);
    memory_free(attachment->nodes);
    memory_free(attachment->leads);
    memory_free(attachment->acceleration);
    memory_free(attachment->reaction);
    *attachment = (struct attachment){0};
}

void attachment_move(const struct attachment *attachment, const double (*X)[3], const double (*d)[3],
                     const double (*v)[3], const double (*a)[3], struct surface_motion *motion)
{
    for (size_t k = 0; k < attachment->n; k++) {
        const int32_t p = attachment->points[k], node = attachment->nodes[k];
        for (int i = 0; i < 3; i++) {
            motion->x[p][i] = X[node][i] + d[node][i];
            motion->v[p][i] = v[node][i];
            motion->a[p][i] = a[node][i];
        }
    }
}

bool attachment_follow(const struct attachment *attachment, double (*d)[3])
{
    const struct surface_motion *relaxed = &attachment->surface->level[1],
                                *trial = &attachment->surface->trial;
    bool moved = false;
    for (size_t k = 0; k < attachment->n; k++) {
        if (!attachment->leads[k])
            continue;
        const int32_t p = attachment->points[k], node = attachment->nodes[k];
        for (int i = 0; i < 3; i++) {
            const double ahead = relaxed->x[p][i] - trial->x[p][i];
            d[node][i] += ahead;
            moved |= fabs(ahead) > 0;
        }
    }
    return moved;
}

void attachment_add_load(const struct attachment *attachment, double (*f)[3])
{
    for (size_t k = 0; k < attachment->n; k++)
        for (int i = 0; i < 3; i++)
            f[attachment->nodes[k]][i] += attachment->surface->load[attachment->points[k]][i];
}

void attachment_add_added_mass(struct attachment *attachment, const double (*a)[3], double per_acceleration,
                               double (*f)[3])
{
    /* points that are not on this solid keep acceleration 0 */
    for (size_t k = 0; k < attachment->n; k++)
        for (int i = 0; i < 3; i++)
            attachment->acceleration[attachment->points[k]][i] = a[attachment->nodes[k]][i];
    surface_added_mass_apply(attachment->surface, (const double(*)[3])attachment->acceleration,
                             per_acceleration, attachment->reaction);
    for (size_t k = 0; k < attachment->n; k++)
        for (int i = 0; i < 3; i++)
            f[attachment->nodes[k]][i] += attachment->reaction[attachment->points[k]][i];
}
