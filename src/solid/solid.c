// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/solid.h"

#include "base/error.h"
#include "base/memory.h"
#include "solid/solid_list.h"

#include <string.h>

static const struct solid_type *find_type(const struct model_mesh *mesh)
{
    for (int k = 0; k < SOLID_LIST_SIZE; k++)
        if (solid_list[k]->takes(mesh))
            return solid_list[k];
    return NULL;
}

int solid_check(const struct model *model, int index)
{
    const struct model_mesh *mesh = &model->meshes[index];
    const struct solid_type *type = find_type(mesh);
    CHECK(type, STATUS_DECK,
          "%s:%d:%d: <mesh name=\"%s\">: no solid is made of %s elements; use triangles, quads, tetrahedra "
          "or hexahedra",
          model->path, mesh->where.line, mesh->where.column, mesh->name, element_name(mesh->mesh.type));
    return type->check(model, mesh);
}

int solid_create(struct solid **created, const struct model *model, int index)
{
    *created = NULL;
    CALL(solid_check(model, index));
    struct solid *solid = memory_create(1, sizeof *solid);
    CHECK_MEMORY(solid);
    solid->model = model;
    solid->definition = &model->meshes[index];
    solid->index = index;
    solid->type = find_type(solid->definition);
    solid->end_weight = 0.5;
    solid->claimed = memory_create(solid->definition->mesh.n_nodes, sizeof *solid->claimed);
    const int status = solid->claimed ? solid->type->create(solid) : STATUS_MEMORY;
    if (status) {
        solid_destroy(solid);
        return status;
    }
    *created = solid;
    return 0;
}

void solid_destroy(struct solid *solid)
{
    if (!solid)
        return;
    solid->type->destroy(solid);
    for (size_t k = 0; k < solid->n_attachments; k++)
        attachment_reset(&solid->attachments[k]);
    memory_free(solid->attachments);
    memory_free(solid->claimed);
    memory_free(solid);
}

int solid_attach(struct solid *solid, struct surface *surface)
{
    size_t capacity = solid->n_attachments;
    CALL(memory_grow((void **)&solid->attachments, &capacity, solid->n_attachments + 1,
                     sizeof *solid->attachments));
    struct attachment *attachment = &solid->attachments[solid->n_attachments];
    CALL(attachment_init(attachment, surface, solid->index, solid->claimed));
    if (attachment->n > 0)
        solid->n_attachments++;
    else
        attachment_reset(attachment);
    return 0;
}

int solid_start(struct solid *solid, double t)
{
    solid->t = t;
    return solid->type->start(solid);
}

void solid_load(struct solid *solid)
{
    solid->type->load(solid);
}

void solid_take_means(struct solid *solid)
{
    solid->mean_loads = true;
}

double solid_end_weight(const struct solid *solid)
{
    return solid->end_weight;
}

int solid_state(const struct solid *solid, struct field_list *list)
{
    CALL(field_list_add(list, solid->type->node_fields(solid)));
    CALL(field_list_add(list, solid->type->cell_fields(solid)));
    return field_list_add(list, solid->type->state_fields(solid));
}

int solid_resume(struct solid *solid, double t)
{
    solid->t = t;
    return solid->type->resume(solid);
}

double solid_stable_step(const struct solid *solid)
{
    return solid->type->stable_step(solid);
}

int solid_begin_step(struct solid *solid, double t, double dt)
{
    solid->t = t;
    solid->dt = dt;
    return solid->type->begin_step(solid);
}

void solid_predictor(const struct solid *solid, double weights[2])
{
    static const double all[][2] = {
        [PREDICTOR_LINEAR] = {2.0, -1.0}, [PREDICTOR_CONSTANT] = {1.0, 0.0}, [PREDICTOR_ZERO] = {0.0, 0.0}};
    memcpy(weights, all[solid->model->coupling.predictor], sizeof all[0]);
}

int solid_predict(struct solid *solid)
{
    return solid->type->predict(solid);
}

int solid_solve(struct solid *solid)
{
    return solid->type->solve(solid);
}

int solid_correct(struct solid *solid, bool added_mass)
{
    return solid->type->correct(solid, added_mass);
}

int solid_accept(struct solid *solid)
{
    return solid->type->accept(solid);
}

void solid_energies(const struct solid *solid, struct solid_energies *energies)
{
    solid->type->energies(solid, energies);
}

bool solid_rigid(const struct solid *solid, double ahead, struct solid_rigid *rigid)
{
    if (solid->type->rigid)
        solid->type->rigid(solid, ahead, rigid);
    return solid->type->rigid;
}

int solid_locate(const struct solid *solid, const double X[3], struct solid_place *place)
{
    return solid->type->locate(solid, X, place);
}

void solid_evaluate(const struct solid *solid, const struct solid_place *place, double d[3], double v[3],
                    double a[3])
{
    solid->type->evaluate(solid, place, d, v, a);
}

const char *solid_name(const struct solid *solid)
{
    return solid->definition->name;
}

const struct mesh *solid_mesh(const struct solid *solid)
{
    return &solid->definition->mesh;
}

const double (*solid_positions(const struct solid *solid))[3]
{
    return solid->type->positions(solid);
}

const struct field_group *solid_node_fields(const struct solid *solid)
{
    return solid->type->node_fields(solid);
}

const struct field_group *solid_cell_fields(const struct solid *solid)
{
    return solid->type->cell_fields(solid);
}

const struct field_group *solid_state_fields(const struct solid *solid)
{
    return solid->type->state_fields(solid);
}
