// SPDX-License-Identifier: GPL-3.0-or-later
/* What others may see of continuum finite elements: fields, energies, material points. */
#include "solid/continuum.h"

#include "base/error.h"
#include "base/memory.h"
#include "model/mesh_search.h"

#include <math.h>
#include <string.h>

/** Cell values on demand: average Cauchy stress, von Mises stress of that average, energy density. */
static int fill_cells(const void *owner, const struct field *field, void *destination)
{
    const struct continuum *continuum = owner;
    double *out = destination;
    for (size_t e = 0; e < continuum->mesh->n_elements; e++) {
        double local[ELEMENT_MAX_DOF], s[6], volume;
        continuum_gather(continuum, e, (const double(*)[3])continuum->state.d, local);
        const double energy =
            continuum->kernel->energy(continuum->element_data + e * continuum->kernel->data_size,
                                      &continuum->material, local, s, &volume);
        if (!strcmp(field->name, "CauchyStress")) {
            memcpy(out, s, sizeof s);
            out += 6;
        } else if (!strcmp(field->name, "VonMises")) {
            *out++ = sqrt(0.5 * ((s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) +
                                 (s[2] - s[0]) * (s[2] - s[0])) +
                          3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
        } else {
            *out++ = energy / volume;
        }
    }
    return 0;
}

static struct field vector_field(const char *name, const char *unit, unsigned flags, double (*data)[3])
{
    return (struct field){
        .name = name, .unit = unit, .type = FIELD_DOUBLE, .components = 3, .flags = flags, .data = {data}};
}

static struct field cell_field(const char *name, const char *unit, int components)
{
    return (struct field){.name = name,
                          .unit = unit,
                          .type = FIELD_DOUBLE,
                          .components = components,
                          .flags = FIELD_OUTPUT,
                          .fill = fill_cells};
}

static struct field scalar_field(const char *name, const char *unit, enum field_type type, void *data)
{
    return (struct field){
        .name = name, .unit = unit, .type = type, .components = 1, .flags = FIELD_STATE, .data = {data}};
}

int continuum_fields(struct continuum *continuum)
{
    const char *newton = continuum->dim == 2 ? "N/m" : "N", *joule = continuum->dim == 2 ? "J/m" : "J";
    struct continuum_nodes *state = &continuum->state;
    /* output within a step of several fluid steps shows that of the step before */
    const bool sub_cycled = continuum->solid->model->coupling.solid_every > 0;
    const unsigned interface = FIELD_OUTPUT | (sub_cycled ? FIELD_STATE : 0);
    const struct field node_fields[CONTINUUM_NODE_FIELDS] = {
        vector_field("Displacement", "m", FIELD_STATE | FIELD_OUTPUT, state->d),
        vector_field("Velocity", "m/s", FIELD_STATE | FIELD_OUTPUT, state->v),
        vector_field("Acceleration", "m/s^2", FIELD_STATE | FIELD_OUTPUT, state->a),
        vector_field("InterfaceForce", newton, interface, continuum->f_interface),
        vector_field("ReactionForce", newton, FIELD_STATE | FIELD_OUTPUT, continuum->reaction),
        vector_field("PreviousAcceleration", "m/s^2", FIELD_STATE, continuum->a_before),
        vector_field("InternalForce", newton, FIELD_STATE, state->f_internal),
        vector_field("ExternalForce", newton, FIELD_STATE, state->f_external),
        vector_field("FactorDisplacement", "m", FIELD_STATE, continuum->factor_d),
        vector_field("Position", "m", 0, continuum->x),
    };
    const struct field cell_fields[CONTINUUM_CELL_FIELDS] = {
        cell_field("CauchyStress", "Pa", 6),
        cell_field("VonMises", "Pa", 1),
        cell_field("StrainEnergy", "J/m^3", 1),
    };
    const struct field state_fields[CONTINUUM_STATE_FIELDS] = {
        scalar_field("FactorAge", "-", FIELD_INT64, &continuum->factor_age),
        scalar_field("FactorStep", "s", FIELD_DOUBLE, &continuum->factor_dt),
        scalar_field("ExternalWork", joule, FIELD_DOUBLE, &continuum->external_work),
    };
    memcpy(continuum->node_fields, node_fields, sizeof node_fields);
    memcpy(continuum->cell_fields, cell_fields, sizeof cell_fields);
    continuum->node_group_name = memory_print("solid-%s", continuum->definition->name);
    continuum->cell_group_name = memory_print("solid-%s:cells", continuum->definition->name);
    continuum->state_group_name = memory_print("solid-%s:state", continuum->definition->name);
    if (!continuum->node_group_name || !continuum->cell_group_name || !continuum->state_group_name)
        return STATUS_MEMORY;
    continuum->node_group = (struct field_group){.name = continuum->node_group_name,
                                                 .owner = continuum,
                                                 .count = &continuum->mesh->n_nodes,
                                                 .fields = continuum->node_fields,
                                                 .n_fields = CONTINUUM_NODE_FIELDS};
    continuum->cell_group = (struct field_group){.name = continuum->cell_group_name,
                                                 .owner = continuum,
                                                 .count = &continuum->mesh->n_elements,
                                                 .fields = continuum->cell_fields,
                                                 .n_fields = CONTINUUM_CELL_FIELDS};
    continuum->state_group = field_singles(continuum->state_group_name, continuum, continuum->state_fields,
                                           state_fields, CONTINUUM_STATE_FIELDS);
    return 0;
}

void continuum_energies(const struct solid *solid, struct solid_energies *energies)
{
    const struct continuum *continuum = solid->data;
    *energies = (struct solid_energies){.external = continuum->external_work};
    for (size_t a = 0; a < continuum->mesh->n_nodes; a++)
        for (size_t k = continuum->mass_rows[a]; k < continuum->mass_rows[a + 1]; k++)
            for (int i = 0; i < 3; i++)
                energies->kinetic += 0.5 * continuum->mass[k] * continuum->state.v[a][i] *
                                     continuum->state.v[continuum->mass_columns[k]][i];
    for (size_t e = 0; e < continuum->mesh->n_elements; e++) {
        double local[ELEMENT_MAX_DOF];
        continuum_gather(continuum, e, (const double(*)[3])continuum->state.d, local);
        energies->elastic +=
            continuum->kernel->energy(continuum->element_data + e * continuum->kernel->data_size,
                                      &continuum->material, local, NULL, NULL);
    }
}

int continuum_locate(const struct solid *solid, const double X[3], struct solid_place *place)
{
    const struct continuum *continuum = solid->data;
    return mesh_search_once(continuum->mesh, X, &place->element, place->xi);
}

void continuum_evaluate(const struct solid *solid, const struct solid_place *place, double d[3], double v[3],
                        double a[3])
{
    const struct continuum *continuum = solid->data;
    const struct mesh *mesh = continuum->mesh;
    const int32_t *nodes = &mesh->connectivity[(size_t)place->element * (size_t)mesh->nodes_per_element];
    double N[ELEMENT_MAX_NODES];
    element_shape(mesh->type, place->xi, N, NULL);
    for (int i = 0; i < 3; i++) {
        d[i] = v[i] = a[i] = 0;
        for (int n = 0; n < mesh->nodes_per_element; n++) {
            d[i] += N[n] * continuum->state.d[nodes[n]][i];
            v[i] += N[n] * continuum->state.v[nodes[n]][i];
            a[i] += N[n] * continuum->state.a[nodes[n]][i];
        }
    }
}

const double (*continuum_positions(const struct solid *solid))[3]
{
    const struct continuum *continuum = solid->data;
    return (const double(*)[3])continuum->x;
}

const struct field_group *continuum_node_fields(const struct solid *solid)
{
    const struct continuum *continuum = solid->data;
    return &continuum->node_group;
}

const struct field_group *continuum_cell_fields(const struct solid *solid)
{
    const struct continuum *continuum = solid->data;
    return &continuum->cell_group;
}

const struct field_group *continuum_state_fields(const struct solid *solid)
{
    const struct continuum *continuum = solid->data;
    return &continuum->state_group;
}
