// SPDX-License-Identifier: GPL-3.0-or-later
/* Continuum finite elements in the total Lagrangian description (paper 000, section 3.2, eq. 26): checks,
 * creation, descriptor. */
#include "solid/continuum.h"

#include "base/error.h"
#include "base/memory.h"
#include "solid/solid_list.h"

#include <math.h>

enum { GMRES_DIRECTIONS = 30 };

static bool takes(const struct model_mesh *mesh)
{
    return element_dim(mesh->mesh.type) >= 2 && !mesh->rigid.present;
}

static int check_material(const struct model *model, const struct model_mesh *definition)
{
    const struct solid_material *material = &model->solid_materials[definition->material];
    const struct constitutive_law *law = constitutive_find(material->law);
    CHECK_MESH(law, material->where, "unknown law \"%s\" of material \"%s\"", material->law, material->name);
    const char *reason = law->check(material);
    CHECK_MESH(!reason, material->where, "material \"%s\": %s", material->name, reason);
    CHECK_MESH(material->density > 0, material->where, "material \"%s\": density %g must be positive",
               material->name, material->density);
    const struct element_kernel *kernel =
        element_kernel_find(definition->mesh.type, definition->formulation, &reason);
    CHECK_MESH(kernel, definition->where, "formulation \"%s\" with %s elements: %s",
               element_formulation_name(definition->formulation), element_name(definition->mesh.type),
               reason);
    return 0;
}

/** The Jacobian of every element must be positive. */
static int check_elements(const struct model *model, const struct model_mesh *definition)
{
    const struct mesh *mesh = &definition->mesh;
    const struct solid_material *material = &model->solid_materials[definition->material];
    const char *reason;
    const struct element_kernel *kernel = element_kernel_find(mesh->type, definition->formulation, &reason);
    struct constitutive law = {.law = constitutive_find(material->law)};
    law.law->prepare(material, law.parameters);
    double *data = memory_create(kernel->data_size, sizeof *data);
    CHECK_MEMORY(data);
    for (size_t e = 0; e < mesh->n_elements; e++) {
        double X[ELEMENT_MAX_NODES][3] = {{0}};
        const int32_t *nodes = &mesh->connectivity[e * (size_t)mesh->nodes_per_element];
        for (int a = 0; a < mesh->nodes_per_element; a++)
            for (int i = 0; i < 3; i++)
                X[a][i] = mesh->X[nodes[a]][i];
        if (!kernel->prepare((const double(*)[3])X, &law, data))
            continue;
        memory_free(data);
        CHECK_MESH(false, definition->where,
                   "element %zu at (%g, %g, %g) is degenerate or its nodes run the wrong way round; the "
                   "Jacobian must be positive",
                   e, X[0][0], X[0][1], X[0][2]);
    }
    memory_free(data);
    return 0;
}

static bool in_set(const struct node_set *set, int32_t node)
{
    for (size_t n = 0; n < set->n; n++)
        if (set->nodes[n] == node)
            return true;
    return false;
}

/** A node moves in one way only. */
static int check_supports(const struct model *model, const struct model_mesh *definition)
{
    for (size_t s = 0; s < definition->n_supports; s++) {
        const struct model_support *support = &definition->supports[s];
        const struct node_set *set = &definition->mesh.sets[support->set];
        for (size_t o = 0; support->moves && o < definition->n_supports; o++)
            for (size_t n = 0; o != s && n < set->n; n++) {
                const struct node_set *other = &definition->mesh.sets[definition->supports[o].set];
                CHECK_MESH(
                    !in_set(other, set->nodes[n]), support->where,
                    "node %d is moved by the support of set \"%s\" and held by that of set \"%s\"; a moving "
                    "support prescribes all components, so it must be the only one",
                    (int)set->nodes[n], set->name, other->name);
            }
    }
    return 0;
}

static int check(const struct model *model, const struct model_mesh *definition)
{
    CHECK_MESH(element_dim(definition->mesh.type) == model->dim, definition->where,
               "%s elements have %d dimensions, the deck has %d", element_name(definition->mesh.type),
               element_dim(definition->mesh.type), model->dim);
    CHECK_MESH(definition->rho_infinity >= 0 && definition->rho_infinity <= 1, definition->where,
               "rho-infinity %g must lie between 0 and 1", definition->rho_infinity);
    CHECK_MESH(definition->newton_tolerance > 0 && definition->newton_tolerance < 1, definition->where,
               "Newton tolerance %g must lie between 0 and 1", definition->newton_tolerance);
    CALL(check_material(model, definition));
    CALL(check_elements(model, definition));
    return check_supports(model, definition);
}

/** All nodal vectors. */
static int create_vectors(struct continuum *continuum)
{
    double(**const vectors[])[3] = {&continuum->state.d,
                                    &continuum->state.v,
                                    &continuum->state.a,
                                    &continuum->state.f_internal,
                                    &continuum->state.f_external,
                                    &continuum->trial.d,
                                    &continuum->trial.v,
                                    &continuum->trial.a,
                                    &continuum->trial.f_internal,
                                    &continuum->trial.f_external,
                                    &continuum->a_before,
                                    &continuum->reaction,
                                    &continuum->f_interface,
                                    &continuum->f_given,
                                    &continuum->x,
                                    &continuum->work,
                                    &continuum->work2,
                                    &continuum->factor_d};
    for (size_t k = 0; k < sizeof vectors / sizeof vectors[0]; k++) {
        *vectors[k] = memory_create(continuum->mesh->n_nodes, sizeof **vectors[k]);
        CHECK_MEMORY(*vectors[k]);
    }
    continuum->residual = memory_create(continuum->n_free, sizeof *continuum->residual);
    continuum->delta = memory_create(continuum->n_free, sizeof *continuum->delta);
    return continuum->residual && continuum->delta ? 0 : STATUS_MEMORY;
}

static int create(struct solid *solid)
{
    struct continuum *continuum = solid->data = memory_create(1, sizeof *continuum);
    CHECK_MEMORY(continuum);
    const struct model_mesh *definition = solid->definition;
    const struct solid_material *material = &solid->model->solid_materials[definition->material];
    const char *reason;
    continuum->solid = solid;
    continuum->definition = definition;
    continuum->mesh = &definition->mesh;
    continuum->dim = solid->model->dim;
    continuum->dof = continuum->dim * definition->mesh.nodes_per_element;
    continuum->kernel = element_kernel_find(definition->mesh.type, definition->formulation, &reason);
    continuum->material.law = constitutive_find(material->law);
    continuum->material.law->prepare(material, continuum->material.parameters);
    continuum->density = material->density;
    continuum->method = generalized_alpha_of(definition->rho_infinity);
    solid->end_weight = 1 - continuum->method.alpha_f;
    CALL(continuum_build(continuum));
    CALL(create_vectors(continuum));
    if (continuum->n_free > 0)
        CALL(gmres_create(&continuum->gmres, continuum->n_free, GMRES_DIRECTIONS));
    return continuum_fields(continuum);
}

static void destroy(struct solid *solid)
{
    struct continuum *continuum = solid->data;
    if (!continuum)
        return;
    sparse_solver_destroy(continuum->solver);
    gmres_destroy(continuum->gmres);
    void *const memory[] = {continuum->element_data,
                            continuum->element_forces,
                            continuum->batch,
                            continuum->equation,
                            continuum->component,
                            continuum->moving_support,
                            continuum->mass_rows,
                            continuum->mass_columns,
                            continuum->mass,
                            continuum->nodal_mass,
                            continuum->columns,
                            continuum->rows,
                            continuum->values,
                            continuum->mass_values,
                            continuum->scatter,
                            continuum->state.d,
                            continuum->state.v,
                            continuum->state.a,
                            continuum->state.f_internal,
                            continuum->state.f_external,
                            continuum->trial.d,
                            continuum->trial.v,
                            continuum->trial.a,
                            continuum->trial.f_internal,
                            continuum->trial.f_external,
                            continuum->a_before,
                            continuum->reaction,
                            continuum->f_interface,
                            continuum->f_given,
                            continuum->x,
                            continuum->work,
                            continuum->work2,
                            continuum->factor_d,
                            continuum->residual,
                            continuum->delta,
                            continuum->node_group_name,
                            continuum->cell_group_name,
                            continuum->state_group_name};
    for (size_t k = 0; k < sizeof memory / sizeof memory[0]; k++)
        memory_free(memory[k]);
    memory_free(continuum);
    solid->data = NULL;
}

/** Implicit: any step is stable. */
static double stable_step(const struct solid *solid)
{
    (void)solid;
    return INFINITY;
}

const struct solid_type continuum_type = {
    .name = "continuum",
    .takes = takes,
    .check = check,
    .create = create,
    .destroy = destroy,
    .start = continuum_start,
    .load = continuum_load,
    .resume = continuum_resume,
    .stable_step = stable_step,
    .begin_step = continuum_begin_step,
    .predict = continuum_predict,
    .solve = continuum_solve,
    .correct = continuum_correct,
    .accept = continuum_accept,
    .energies = continuum_energies,
    .locate = continuum_locate,
    .evaluate = continuum_evaluate,
    .positions = continuum_positions,
    .node_fields = continuum_node_fields,
    .cell_fields = continuum_cell_fields,
    .state_fields = continuum_state_fields,
};
