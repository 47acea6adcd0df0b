// SPDX-License-Identifier: GPL-3.0-or-later
/* Rigid bodies: mass, checks, creation, what others may see, descriptor. */
#include "solid/rigid_body.h"

#include "base/memory.h"
#include "model/mesh_search.h"
#include "solid/element/quadrature.h"
#include "solid/solid_list.h"

#include <math.h>
#include <string.h>

static bool takes(const struct model_mesh *mesh)
{
    return element_dim(mesh->mesh.type) >= 2 && mesh->rigid.present;
}

void rigid_body_mass_of(const struct model_mesh *definition, struct rigid_body_mass *mass)
{
    const struct model_rigid *rigid = &definition->rigid;
    const int dim = definition->mesh.dim;
    double volume, first[3], second[3][3], rough[3];
    *mass = (struct rigid_body_mass){0};
    memcpy(rough, definition->mesh.X[0], sizeof rough); /* near enough for the digits of the centre */
    mesh_moments(&definition->mesh, rough, &volume, first, second);
    for (int i = 0; i < dim; i++)
        mass->centre[i] = rough[i] + first[i] / volume;
    if (rigid->has_centre)
        memcpy(mass->centre, rigid->centre, sizeof mass->centre);
    mass->mass = rigid->has_mass ? rigid->mass : rigid->density * volume;
    if (rigid->has_inertia) {
        memcpy(mass->inertia, rigid->inertia, sizeof mass->inertia);
        return;
    }
    mesh_moments(&definition->mesh, mass->centre, &volume, first, second);
    const double density = mass->mass / volume, trace = second[0][0] + second[1][1] + second[2][2];
    for (int i = dim == 2 ? 2 : 0; i < 3; i++)
        for (int j = dim == 2 ? 2 : 0; j < 3; j++)
            mass->inertia[i][j] = density * ((i == j ? trace : 0) - second[i][j]);
}

/** The Jacobian of every element must be positive. */
static int check_elements(const struct model *model, const struct model_mesh *definition)
{
    const struct mesh *mesh = &definition->mesh;
    const struct quadrature rule = quadrature_of(mesh->type, QUADRATURE_MASS);
    for (size_t e = 0; e < mesh->n_elements; e++)
        for (int p = 0; p < rule.n; p++) {
            const double *X = mesh->X[mesh->connectivity[e * (size_t)mesh->nodes_per_element]];
            CHECK_MESH(mesh_jacobian(mesh, e, rule.xi[p]) > 0, definition->where,
                       "element %zu at (%g, %g, %g) is degenerate or its nodes run the wrong way round; the "
                       "Jacobian must be positive",
                       e, X[0], X[1], X[2]);
        }
    return 0;
}

/** Moments of inertia of a body that exists: mass times the mean of (x x) is positive definite. */
static int check_inertia(const struct model *model, const struct model_mesh *definition)
{
    struct rigid_body_mass mass;
    rigid_body_mass_of(definition, &mass);
    const double(*J)[3] = (const double(*)[3])mass.inertia;
    CHECK_MESH(mass.mass > 0, definition->rigid.where, "the mass %g must be positive", mass.mass);
    if (model->dim == 2) {
        CHECK_MESH(J[2][2] > 0, definition->rigid.where, "the inertia %g must be positive", J[2][2]);
        return 0;
    }
    const double trace = J[0][0] + J[1][1] + J[2][2];
    double S[3][3]; /* twice the second moments */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            S[i][j] = (i == j ? trace : 0) - 2 * J[i][j];
    const double minor = S[0][0] * S[1][1] - S[0][1] * S[1][0];
    const double det = S[0][0] * (S[1][1] * S[2][2] - S[1][2] * S[2][1]) -
                       S[0][1] * (S[1][0] * S[2][2] - S[1][2] * S[2][0]) +
                       S[0][2] * (S[1][0] * S[2][1] - S[1][1] * S[2][0]);
    CHECK_MESH(
        S[0][0] > 0 && minor > 0 && det > 0, definition->rigid.where,
        "no body has the inertia xx %g, yy %g, zz %g, xy %g, yz %g, xz %g: each of its three principal "
        "moments must be less than the sum of the others",
        J[0][0], J[1][1], J[2][2], J[0][1], J[1][2], J[0][2]);
    return 0;
}

static int check(const struct model *model, const struct model_mesh *definition)
{
    CHECK_MESH(element_dim(definition->mesh.type) == model->dim, definition->where,
               "%s elements have %d dimensions, the deck has %d", element_name(definition->mesh.type),
               element_dim(definition->mesh.type), model->dim);
    CALL(check_elements(model, definition));
    return check_inertia(model, definition);
}

/** Displacement, velocity, acceleration of all nodes, and the loads on them, on demand. */
static int fill_nodes(const void *owner, const struct field *field, void *destination)
{
    const struct rigid_body *body = owner;
    double(*out)[3] = destination, R[3][3], x[3], v[3], a[3];
    rigid_body_rotation(body->state.q, R);
    for (size_t n = 0; n < body->mesh->n_nodes; n++) {
        const double *X = body->mesh->X[n];
        rigid_body_point(body, &body->state, (const double(*)[3])R, X, x, v, a);
        for (int i = 0; i < 3; i++)
            out[n][i] = field->name[0] == 'D' ? x[i] - X[i] : field->name[0] == 'V' ? v[i] : a[i];
    }
    return 0;
}

static int fill_interface(const void *owner, const struct field *field, void *destination)
{
    (void)field;
    const struct rigid_body *body = owner;
    double(*out)[3] = destination;
    memset(out, 0, body->mesh->n_nodes * sizeof *out);
    for (size_t k = 0; k < body->solid->n_attachments; k++)
        attachment_add_load(&body->solid->attachments[k], out);
    return 0;
}

static struct field state_field(const char *name, const char *unit, int components, double *data)
{
    return (struct field){.name = name,
                          .unit = unit,
                          .type = FIELD_DOUBLE,
                          .components = components,
                          .flags = FIELD_STATE,
                          .data = {data}};
}

static int create_fields(struct rigid_body *body)
{
    const bool plane = body->mesh->dim == 2;
    const char *newton = plane ? "N/m" : "N";
    struct rigid_body_motion *state = &body->state;
    const struct field nodes[RIGID_BODY_NODE_FIELDS] = {
        {"Displacement", "m", FIELD_DOUBLE, 3, FIELD_OUTPUT, {NULL}, fill_nodes},
        {"Velocity", "m/s", FIELD_DOUBLE, 3, FIELD_OUTPUT, {NULL}, fill_nodes},
        {"Acceleration", "m/s^2", FIELD_DOUBLE, 3, FIELD_OUTPUT, {NULL}, fill_nodes},
        {"InterfaceForce", newton, FIELD_DOUBLE, 3, FIELD_OUTPUT, {NULL}, fill_interface},
        {"Position", "m", FIELD_DOUBLE, 3, 0, {body->x}, NULL},
    };
    const struct field states[RIGID_BODY_STATE_FIELDS] = {
        state_field("CentreDisplacement", "m", 3, state->d),
        state_field("CentreVelocity", "m/s", 3, state->v),
        state_field("CentreAcceleration", "m/s^2", 3, state->a),
        state_field("PreviousCentreAcceleration", "m/s^2", 3, body->a_before),
        state_field("Orientation", "-", 4, state->q),
        state_field("AngularMomentum", plane ? "kg m/s" : "kg m^2/s", 3, state->momentum),
        state_field("AngularAcceleration", "rad/s^2", 3, state->alpha),
        state_field("PreviousAngularAcceleration", "rad/s^2", 3, body->alpha_before),
        state_field("Force", newton, 3, body->force),
        state_field("Moment", plane ? "N" : "N m", 3, body->moment),
        state_field("Turn", "rad", 1, &body->turn),
        state_field("ExternalWork", plane ? "J/m" : "J", 1, &body->external_work),
    };
    const char *name = body->definition->name;
    memcpy(body->node_fields, nodes, sizeof nodes);
    CHECK_MEMORY(body->node_group_name = memory_print("solid-%s", name));
    CHECK_MEMORY(body->cell_group_name = memory_print("solid-%s:cells", name));
    CHECK_MEMORY(body->state_group_name = memory_print("solid-%s:state", name));
    body->node_group = (struct field_group){.name = body->node_group_name,
                                            .owner = body,
                                            .count = &body->mesh->n_nodes,
                                            .fields = body->node_fields,
                                            .n_fields = RIGID_BODY_NODE_FIELDS};
    body->cell_group =
        (struct field_group){.name = body->cell_group_name, .owner = body, .count = &body->mesh->n_elements};
    body->state_group =
        field_singles(body->state_group_name, body, body->state_fields, states, RIGID_BODY_STATE_FIELDS);
    return 0;
}

static int create(struct solid *solid)
{
    struct rigid_body *body = solid->data = memory_create(1, sizeof *body);
    CHECK_MEMORY(body);
    body->solid = solid;
    body->definition = solid->definition;
    body->mesh = &solid->definition->mesh;
    rigid_body_mass_of(solid->definition, &body->mass);
    for (int k = 0; k < 6; k++) {
        const bool in_plane = k < 2 || k == 5;
        body->free[k] = !solid->definition->rigid.fixed[k] && (in_plane || body->mesh->dim == 3);
    }
    solid->end_weight = 1;
    CHECK_MEMORY(body->x = memory_create(body->mesh->n_nodes, sizeof *body->x));
    return create_fields(body);
}

static void destroy(struct solid *solid)
{
    struct rigid_body *body = solid->data;
    if (!body)
        return;
    memory_free(body->x);
    memory_free(body->node_group_name);
    memory_free(body->cell_group_name);
    memory_free(body->state_group_name);
    memory_free(body);
    solid->data = NULL;
}

/** Implicit: any step is stable. */
static double stable_step(const struct solid *solid)
{
    (void)solid;
    return INFINITY;
}

static void energies(const struct solid *solid, struct solid_energies *energies)
{
    const struct rigid_body *body = solid->data;
    *energies = (struct solid_energies){.external = body->external_work};
    for (int i = 0; i < 3; i++)
        energies->kinetic += 0.5 * (body->mass.mass * body->state.v[i] * body->state.v[i] +
                                    body->state.omega[i] * body->state.momentum[i]);
}

/** The shortest rotation vector of an orientation. */
static void rotation_vector(const double q[4], double rotation[3])
{
    const double sine = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), sign = q[0] < 0 ? -1 : 1;
    const double angle = 2 * atan2(sine, sign * q[0]);
    for (int i = 0; i < 3; i++)
        rotation[i] = sign * (sine > 0 ? angle / sine : 2) * q[1 + i];
}

static void rigid(const struct solid *solid, double ahead, struct solid_rigid *rigid)
{
    const struct rigid_body *body = solid->data;
    const struct rigid_body_motion *state = &body->state;
    double R[3][3], turn[3] = {0}, way[3], q[4];
    for (int i = 0; i < 3; i++) {
        rigid->centre[i] =
            body->mass.centre[i] + state->d[i] + ahead * (state->v[i] + 0.5 * ahead * state->a[i]);
        rigid->velocity[i] = state->v[i] + ahead * state->a[i];
        way[i] = ahead * (state->omega[i] + 0.5 * ahead * state->alpha[i]);
        rigid->angular_velocity[i] = state->omega[i] + ahead * state->alpha[i];
        rigid->force[i] = body->force[i];
        rigid->moment[i] = body->moment[i];
        rigid->rotation[i] = 0;
    }
    if (body->mesh->dim == 2) {
        rigid->rotation[2] = body->turn + way[2];
        return;
    }
    rigid_body_rotation(state->q, R);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            turn[i] += R[j][i] * way[j];
    rigid_body_turn(state->q, turn, q);
    rotation_vector(q, rigid->rotation);
}

static int locate(const struct solid *solid, const double X[3], struct solid_place *place)
{
    const struct rigid_body *body = solid->data;
    return mesh_search_once(body->mesh, X, &place->element, place->xi);
}

static void evaluate(const struct solid *solid, const struct solid_place *place, double d[3], double v[3],
                     double a[3])
{
    const struct rigid_body *body = solid->data;
    const struct mesh *mesh = body->mesh;
    const int32_t *nodes = &mesh->connectivity[(size_t)place->element * (size_t)mesh->nodes_per_element];
    double N[ELEMENT_MAX_NODES], X[3] = {0}, R[3][3], x[3];
    element_shape(mesh->type, place->xi, N, NULL);
    for (int n = 0; n < mesh->nodes_per_element; n++)
        for (int i = 0; i < 3; i++)
            X[i] += N[n] * mesh->X[nodes[n]][i];
    rigid_body_rotation(body->state.q, R);
    rigid_body_point(body, &body->state, (const double(*)[3])R, X, x, v, a);
    for (int i = 0; i < 3; i++)
        d[i] = x[i] - X[i];
}

static const double (*positions(const struct solid *solid))[3]
{
    const struct rigid_body *body = solid->data;
    return (const double(*)[3])body->x;
}

static const struct field_group *node_fields(const struct solid *solid)
{
    return &((const struct rigid_body *)solid->data)->node_group;
}

static const struct field_group *cell_fields(const struct solid *solid)
{
    return &((const struct rigid_body *)solid->data)->cell_group;
}

static const struct field_group *state_fields(const struct solid *solid)
{
    return &((const struct rigid_body *)solid->data)->state_group;
}

const struct solid_type rigid_body_type = {
    .name = "rigid-body",
    .takes = takes,
    .check = check,
    .create = create,
    .destroy = destroy,
    .start = rigid_body_start,
    .load = rigid_body_take_load,
    .resume = rigid_body_resume,
    .stable_step = stable_step,
    .begin_step = rigid_body_begin_step,
    .predict = rigid_body_predict,
    .solve = rigid_body_solve,
    .correct = rigid_body_correct,
    .accept = rigid_body_accept,
    .energies = energies,
    .rigid = rigid,
    .locate = locate,
    .evaluate = evaluate,
    .positions = positions,
    .node_fields = node_fields,
    .cell_fields = cell_fields,
    .state_fields = state_fields,
};
