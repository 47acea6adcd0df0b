// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/boundary.h"

#include "base/error.h"
#include "base/memory.h"

#include <string.h>

static int state_register(struct boundary *boundary)
{
    const struct field fields[] = {
        {"Drift", "m", FIELD_DOUBLE, 1, FIELD_STATE, {&boundary->drift}, NULL},
        {"PutBack", "-", FIELD_INT64, 1, FIELD_STATE, {&boundary->put_back_count}, NULL},
    };
    char *name = memory_print("wall-%s:state", boundary->wall->name);
    CHECK_MEMORY(name);
    boundary->state =
        field_singles(name, boundary, boundary->state_fields, fields, boundary->type->put_back ? 2 : 1);
    return 0;
}

int boundary_create(struct boundary **boundary, const struct model *model, int index,
                    struct surface **surfaces, const struct fluid_view *view,
                    const struct boundary_type *const *types, size_t n_types)
{
    struct boundary *b = memory_create(1, sizeof *b);
    CHECK_MEMORY(b);
    *boundary = b;
    b->wall = &model->walls[index];
    for (size_t k = 0; k < n_types; ++k)
        if (!strcmp(types[k]->name, b->wall->treatment))
            b->type = types[k];
    CHECK(b->type, STATUS_DECK, "%s:%d:%d: error: <wall name=\"%s\">: unknown treatment \"%s\"", model->path,
          b->wall->where.line, b->wall->where.column, b->wall->name, b->wall->treatment);
    b->n_surfaces = b->wall->n_surfaces;
    b->surfaces = memory_create(b->n_surfaces, sizeof(struct surface *));
    CHECK_MEMORY(b->surfaces);
    for (size_t s = 0; s < b->n_surfaces; ++s) {
        b->surfaces[s] = surfaces[b->wall->surfaces[s]];
        b->moving |= b->surfaces[s]->moving;
        b->coupled |= b->surfaces[s]->coupled;
    }
    b->moving |= motion_moves(&b->wall->motion);
    b->turning = memory_create(b->n_surfaces, sizeof *b->turning);
    CHECK_MEMORY(b->turning);
    for (size_t s = 0; s < b->n_surfaces; ++s)
        if (b->surfaces[s]->moving && b->surfaces[s]->definition->kind == SURFACE_FACETS)
            CALL(turning_load_create(&b->turning[s], b->surfaces[s], view->kernel.h));
    CALL(state_register(b));
    return b->type->create(b, model, view);
}

void boundary_destroy(struct boundary *boundary)
{
    if (!boundary)
        return;
    if (boundary->type)
        boundary->type->destroy(boundary);
    for (size_t s = 0; boundary->turning && s < boundary->n_surfaces; ++s)
        turning_load_reset(&boundary->turning[s]);
    memory_free(boundary->turning);
    memory_free(boundary->surfaces);
    memory_free(boundary->near);
    memory_free(boundary->kernel_sum);
    memory_free((char *)boundary->state.name);
    memory_free(boundary);
}

int boundary_state(struct boundary *boundary, struct field_list *list)
{
    CALL(field_list_add(list, &boundary->state));
    return boundary->type->state ? boundary->type->state(boundary, list) : 0;
}

int boundary_prepare(struct boundary *boundary, const struct fluid_view *view, bool again)
{
    for (size_t s = 0; s < boundary->n_surfaces; ++s)
        surface_at(boundary->surfaces[s], view->t);
    return boundary->type->prepare(boundary, view, again);
}

/** Length of a cylinder in 3-D: the period along its axis; 0 if it has none, or lies askew. */
static double cylinder_length(const double axis[3], const struct cell_grid *grid)
{
    const double size = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    for (int k = 0; k < 3; ++k)
        if (grid->periodic[k] && fabs(axis[k]) > (1.0 - 1e-12) * size)
            return grid->upper[k] - grid->lower[k];
    return 0.0;
}

/** A circle or a sphere that turns, or a cylinder about its axis between periodic sides; what goes on for
 * ever has no moment. */
static void shape_turning_load(struct surface *surface, const struct fluid_view *view)
{
    static const double pi = 3.14159265358979323846;
    const struct model_surface *definition = surface->definition;
    const double r = definition->radius, side = definition->fluid_inside ? 1.0 : -1.0;
    struct motion_frame frame;
    double volume = 0.0;
    if (definition->kind == SURFACE_CYLINDER)
        volume = pi * r * r * (view->dim == 2 ? 1.0 : cylinder_length(definition->axis, view->grid));
    else if (definition->kind == SURFACE_SPHERE)
        volume = 4.0 / 3.0 * pi * r * r * r;
    else
        return;
    motion_frame_at(&definition->motion, view->t, &frame);
    for (int k = 0; k < 3; ++k)
        if (definition->kind == SURFACE_SPHERE || view->dim == 2 || definition->axis[k] != 0.0)
            surface->moment[k] += side * 2.0 * view->viscosity * volume * frame.omega[k];
}

void boundary_load(struct boundary *boundary, const struct fluid_view *view)
{
    boundary->type->load(boundary, view);
    for (size_t s = 0; s < boundary->n_surfaces; ++s) {
        struct surface *surface = boundary->surfaces[s];
        if (surface->moving && surface->definition->kind == SURFACE_FACETS)
            turning_load_add(&boundary->turning[s], view->viscosity, surface->load);
        else if (surface->moving)
            shape_turning_load(surface, view);
    }
}

int boundary_reserve_near(struct boundary *boundary, size_t n)
{
    size_t capacity = boundary->near_capacity;
    CALL(memory_grow((void **)&boundary->near, &capacity, n, sizeof *boundary->near));
    return memory_grow((void **)&boundary->kernel_sum, &boundary->near_capacity, n,
                       sizeof *boundary->kernel_sum);
}

/** Every array of packed neighbours, so that none is forgotten when they grow or go. */
static size_t neighbour_arrays(struct wall_neighbours *w, double **arrays[32])
{
    double ***a = arrays;
    for (int k = 0; k < 3; ++k) {
        *a++ = &w->dx[k];
        *a++ = &w->u[k];
        *a++ = &w->u_viscous[k];
        *a++ = &w->a[k];
        *a++ = &w->normal[k];
    }
    double **const scalars[] = {&w->r,
                                &w->w,
                                &w->dw,
                                &w->volume,
                                &w->rho,
                                &w->p,
                                &w->share_density,
                                &w->share_pressure,
                                &w->share_viscous};
    for (size_t k = 0; k < sizeof scalars / sizeof *scalars; ++k)
        *a++ = scalars[k];
    return (size_t)(a - arrays);
}

int wall_neighbours_reserve(struct wall_neighbours *neighbours, size_t n)
{
    if (n <= neighbours->capacity)
        return 0;
    double **arrays[32];
    size_t n_arrays = neighbour_arrays(neighbours, arrays), capacity = neighbours->capacity;
    n += n / 2;
    for (size_t k = 0; k < n_arrays; ++k) {
        size_t old = capacity;
        CALL(memory_grow((void **)arrays[k], &old, n, sizeof(double)));
    }
    return memory_grow((void **)&neighbours->source, &neighbours->capacity, n, sizeof *neighbours->source);
}

void wall_neighbours_reset(struct wall_neighbours *neighbours)
{
    double **arrays[32];
    size_t n_arrays = neighbour_arrays(neighbours, arrays);
    for (size_t k = 0; k < n_arrays; ++k)
        memory_free(*arrays[k]);
    memory_free(neighbours->source);
    *neighbours = (struct wall_neighbours){0};
}
