// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/coupling.h"

#include "base/error.h"
#include "base/memory.h"
#include "coupling/coupling_list.h"

#include <string.h>

const struct coupling_type *coupling_choose(const struct model *model)
{
    const char *name = model->coupling.scheme;
    if (!name || !model->fluid.present || !model->n_meshes)
        return model->fluid.present && model->n_meshes ? &coupling_fixed_point : &coupling_one_field;
    for (size_t k = 0; k < COUPLING_TYPES; ++k)
        if (!strcmp(coupling_types[k]->name, name))
            return coupling_types[k];
    error_report(STATUS_DECK, "%s:%d:%d: error: <coupling>: unknown scheme \"%s\"", model->path,
                 model->coupling.where.line, model->coupling.where.column, name);
    return NULL;
}

int coupling_check_parts(const struct model *model)
{
    CHECK(model->fluid.present && model->n_meshes, STATUS_DECK,
          "%s:%d:%d: error: <coupling>: scheme \"%s\" couples a fluid with meshes, and the deck has no %s",
          model->path, model->coupling.where.line, model->coupling.where.column, model->coupling.scheme,
          model->fluid.present ? "<mesh>" : "<fluid>");
    return 0;
}

static int quasi_newton_begin(struct coupling *coupling, const struct model_coupling *definition)
{
    CHECK_MEMORY(coupling->answer = memory_create(3 * coupling->n_dof, sizeof *coupling->answer));
    CHECK_MEMORY(coupling->iterate = memory_create(3 * coupling->n_dof, sizeof *coupling->iterate));
    return quasi_newton_create(&coupling->quasi_newton, coupling->n_dof, definition->relaxation,
                               definition->reused_steps, definition->filter);
}

static int acceleration_create(struct coupling *coupling, const struct model_coupling *definition)
{
    const char *name = definition->acceleration ? definition->acceleration : "added-mass";
    enum relaxation_kind kind = !strcmp(name, "aitken")     ? RELAXATION_AITKEN
                                : !strcmp(name, "constant") ? RELAXATION_CONSTANT
                                                            : RELAXATION_NONE;
    coupling->added_mass = !strcmp(name, "added-mass");
    coupling->difference = memory_create(coupling->n_dof, sizeof *coupling->difference);
    CHECK_MEMORY(coupling->difference);
    coupling->load_before = memory_create(coupling->n_points, sizeof *coupling->load_before);
    CHECK_MEMORY(coupling->load_before);
    if (!strcmp(name, "iqn-ils") && coupling->n_dof > 0)
        CALL(quasi_newton_begin(coupling, definition));
    return relaxation_create(&coupling->relaxation, kind, definition->relaxation, coupling->n_dof);
}

static void state_register(struct coupling *coupling)
{
    const struct field fields[] = {
        {"StepEnd", "s", FIELD_DOUBLE, 1, FIELD_STATE, {&coupling->t_end}, NULL},
        {"Steps", "-", FIELD_INT64, 1, FIELD_STATE, {&coupling->steps}, NULL},
        {"TotalIterations", "-", FIELD_INT64, 1, FIELD_STATE, {&coupling->total_iterations}, NULL},
        {"WallImpulse", "N s", FIELD_DOUBLE, 3, FIELD_STATE, {coupling->wall_impulse}, NULL},
    };
    coupling->state =
        field_singles("coupling", coupling, coupling->state_fields, fields, sizeof fields / sizeof *fields);
}

int coupling_create(struct coupling **coupling, const struct model *model, const struct coupling_parts *parts)
{
    struct coupling *c = memory_create(1, sizeof *c);
    CHECK_MEMORY(c);
    c->parts = *parts;
    c->definition = &model->coupling;
    c->type = coupling_choose(model);
    c->unit_of_force = model->dim == 2 ? "N/m" : "N";
    state_register(c);
    for (size_t s = 0; s < parts->n_surfaces; ++s)
        if (parts->surfaces[s]->coupled)
            c->n_points += parts->surfaces[s]->n_points;
    c->n_dof = (size_t)model->dim * c->n_points;
    int status = c->type ? acceleration_create(c, c->definition) : STATUS_DECK;
    if (!status && c->type->create)
        status = c->type->create(c);
    if (status) {
        coupling_destroy(c);
        return status;
    }
    *coupling = c;
    return 0;
}

void coupling_destroy(struct coupling *coupling)
{
    if (!coupling)
        return;
    if (coupling->type && coupling->type->destroy)
        coupling->type->destroy(coupling);
    relaxation_destroy(coupling->relaxation);
    quasi_newton_destroy(coupling->quasi_newton);
    memory_free(coupling->difference);
    memory_free(coupling->answer);
    memory_free(coupling->iterate);
    memory_free(coupling->load_before);
    memory_free(coupling);
}

int coupling_start(struct coupling *coupling, double t)
{
    struct coupling_parts *parts = &coupling->parts;
    for (size_t k = 0; k < parts->n_solids; ++k)
        CALL(solid_start(parts->solids[k], t));
    if (parts->fluid)
        CALL(fluid_start(parts->fluid, t));
    for (size_t k = 0; k < parts->n_surfaces; ++k) /* the first step begins with these loads */
        surface_add_impulse(parts->surfaces[k], 0.0, SURFACE_LOAD_END);
    for (size_t k = 0; k < parts->n_solids; ++k)
        solid_load(parts->solids[k]);
    coupling->t_end = t;
    return 0;
}

int coupling_state(struct coupling *coupling, struct field_list *list)
{
    const struct coupling_parts *parts = &coupling->parts;
    CALL(field_list_add(list, &coupling->state));
    if (coupling->quasi_newton)
        CALL(field_list_add(list, &coupling->quasi_newton->state));
    if (coupling->type->state)
        CALL(coupling->type->state(coupling, list));
    for (size_t k = 0; k < parts->n_surfaces; ++k)
        CALL(field_list_add(list, &parts->surfaces[k]->fields));
    for (size_t k = 0; k < parts->n_solids; ++k)
        CALL(solid_state(parts->solids[k], list));
    return parts->fluid ? fluid_state(parts->fluid, list) : 0;
}

int coupling_resume(struct coupling *coupling)
{
    const struct coupling_parts *parts = &coupling->parts;
    if (coupling->type->resume)
        return coupling->type->resume(coupling);
    for (size_t k = 0; k < parts->n_surfaces; ++k)
        surface_resume(parts->surfaces[k], coupling->t_end);
    for (size_t k = 0; k < parts->n_solids; ++k)
        CALL(solid_resume(parts->solids[k], coupling->t_end));
    return parts->fluid ? fluid_resume(parts->fluid, coupling->t_end) : 0;
}

void coupling_add_impulse(struct coupling *coupling, double dt)
{
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        struct surface *surface = coupling->parts.surfaces[s];
        for (size_t p = 0; p < surface->n_points; ++p)
            for (int k = 0; k < 3; ++k)
                coupling->wall_impulse[k] += 0.5 * dt * (surface->load_previous[p][k] + surface->load[p][k]);
        surface_add_impulse(surface, dt, SURFACE_LOAD_END);
    }
}

int coupling_step(struct coupling *coupling, double t, double dt)
{
    CALL(coupling->type->step(coupling, t, dt));
    coupling->t_end = t + dt;
    coupling->total_iterations += coupling->iterations;
    ++coupling->steps;
    return 0;
}
