// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/model.h"

#include "base/memory.h"
#include "model/surface_build.h"

static void expressions_reset(struct expression *expressions[3])
{
    for (int d = 0; d < 3; d++)
        expression_destroy(expressions[d]);
}

static void region_reset(struct model_region *region)
{
    shape_reset(&region->shape);
    memory_free(region->points);
    expressions_reset(region->velocity);
}

static void materials_reset(struct model *model)
{
    for (size_t i = 0; i < model->n_fluid_materials; i++)
        memory_free(model->fluid_materials[i].name);
    for (size_t i = 0; i < model->n_solid_materials; i++) {
        memory_free(model->solid_materials[i].name);
        memory_free(model->solid_materials[i].law);
    }
    memory_free(model->fluid_materials);
    memory_free(model->solid_materials);
}

static void fluid_reset(struct model_fluid *fluid)
{
    for (size_t i = 0; i < fluid->n_regions; i++)
        region_reset(&fluid->regions[i]);
    memory_free(fluid->regions);
    memory_free(fluid->formulation);
    memory_free(fluid->kernel);
}

static void meshes_reset(struct model *model)
{
    for (size_t i = 0; i < model->n_meshes; i++) {
        struct model_mesh *mesh = &model->meshes[i];
        memory_free(mesh->name);
        mesh_reset(&mesh->mesh);
        for (size_t s = 0; s < mesh->n_supports; s++)
            motion_reset(&mesh->supports[s].motion);
        for (size_t l = 0; l < mesh->n_loads; l++)
            expressions_reset(mesh->loads[l].force);
        memory_free(mesh->supports);
        memory_free(mesh->loads);
        expressions_reset(mesh->displacement);
        expressions_reset(mesh->velocity);
    }
    memory_free(model->meshes);
}

static void surfaces_reset(struct model *model)
{
    for (size_t i = 0; i < model->n_surfaces; i++) {
        struct model_surface *surface = &model->surfaces[i];
        memory_free(surface->name);
        for (size_t p = 0; p < surface->n_parts; p++) {
            facets_reset(&surface->parts[p].facets);
            memory_free(surface->parts[p].excluded);
        }
        memory_free(surface->parts);
        motion_reset(&surface->motion);
        surface_build_reset(surface);
    }
    memory_free(model->surfaces);
}

static void boundaries_reset(struct model *model)
{
    for (size_t i = 0; i < model->n_walls; i++) {
        struct model_wall *wall = &model->walls[i];
        memory_free(wall->name);
        memory_free(wall->treatment);
        memory_free(wall->surfaces);
        region_reset(&wall->region);
        motion_reset(&wall->motion);
    }
    for (size_t i = 0; i < model->n_openings; i++) {
        memory_free(model->openings[i].name);
        expressions_reset(model->openings[i].velocity);
        expression_destroy(model->openings[i].pressure);
    }
    memory_free(model->walls);
    memory_free(model->openings);
}

static void output_reset(struct model_output *output)
{
    for (size_t i = 0; i < output->n_arrays; i++)
        memory_free(output->arrays[i]);
    for (size_t i = 0; i < output->n_histories; i++) {
        memory_free(output->histories[i].name);
        memory_free(output->histories[i].surfaces);
    }
    memory_free(output->arrays);
    memory_free(output->histories);
    memory_free(output->virtual_particles);
}

static void inputs_reset(struct model *model)
{
    for (size_t i = 0; i < model->n_inputs; i++) {
        memory_free(model->inputs[i].name);
        memory_free(model->inputs[i].path);
    }
    memory_free(model->inputs);
}

void model_destroy(struct model *model)
{
    if (!model)
        return;
    inputs_reset(model);
    for (size_t i = 0; i < model->n_parameters; i++) {
        memory_free(model->parameters[i].name);
        memory_free(model->parameters[i].text);
    }
    memory_free(model->parameters);
    expressions_reset(model->time.body_force);
    materials_reset(model);
    fluid_reset(&model->fluid);
    meshes_reset(model);
    surfaces_reset(model);
    boundaries_reset(model);
    memory_free(model->coupling.scheme);
    memory_free(model->coupling.acceleration);
    output_reset(&model->output);
    memory_free(model->path);
    memory_free(model->name);
    memory_free(model);
}
