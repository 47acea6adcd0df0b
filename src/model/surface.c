// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/surface.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/** Places in the field list that surface_show changes. */
enum { FIELD_VELOCITY = 1, FIELD_ACCELERATION = 2 };

/** An array with an entry for each point. */
struct point_array {
    void **rows;
    size_t size; /**< of an entry */
};

enum {
    POINT_ARRAYS = 19 + SURFACE_PARTS,
    LEAST_SHARED = 2000 /**< fewer points or contacts are not worth more than one thread */
};

/** Every one of them, so that none is forgotten when they are made, grow or go. */
static void point_arrays(struct surface *s, struct point_array arrays[POINT_ARRAYS])
{
    struct surface_motion *const motions[] = {&s->level[0], &s->level[1], &s->now, &s->trial};
    for (size_t k = 0; k < sizeof motions / sizeof *motions; ++k) {
        *arrays++ = (struct point_array){(void **)&motions[k]->x, sizeof *motions[k]->x};
        *arrays++ = (struct point_array){(void **)&motions[k]->v, sizeof *motions[k]->v};
        *arrays++ = (struct point_array){(void **)&motions[k]->a, sizeof *motions[k]->a};
    }
    *arrays++ = (struct point_array){(void **)&s->X, sizeof *s->X};
    *arrays++ = (struct point_array){(void **)&s->mesh, sizeof *s->mesh};
    *arrays++ = (struct point_array){(void **)&s->mesh_node, sizeof *s->mesh_node};
    *arrays++ = (struct point_array){(void **)&s->listed, sizeof *s->listed};
    *arrays++ = (struct point_array){(void **)&s->load, sizeof *s->load};
    *arrays++ = (struct point_array){(void **)&s->load_previous, sizeof *s->load_previous};
    *arrays++ = (struct point_array){(void **)&s->impulse, sizeof *s->impulse};
    for (size_t k = 0; k < SURFACE_PARTS; ++k)
        *arrays++ = (struct point_array){(void **)&s->part[k], sizeof *s->part[k]};
}

/** Room for @p more points behind those that there are. */
static int points_grow(struct surface *s, size_t more)
{
    struct point_array arrays[POINT_ARRAYS];
    point_arrays(s, arrays);
    for (size_t k = 0; k < POINT_ARRAYS; ++k) {
        size_t capacity = s->n_points;
        CALL(memory_grow(arrays[k].rows, &capacity, s->n_points + more, arrays[k].size));
    }
    s->n_points += more;
    return 0;
}

static void surface_motion_copy(struct surface_motion *to, const struct surface_motion *from, size_t n)
{
    to->t = from->t;
    memcpy(to->x, from->x, n * sizeof *to->x);
    memcpy(to->v, from->v, n * sizeof *to->v);
    memcpy(to->a, from->a, n * sizeof *to->a);
}

/** Copy reference places, facets and owners of the points from the definition. */
static void fill_definition(struct surface *s)
{
    const struct model_surface *d = s->definition;
    if (d->kind != SURFACE_FACETS) {
        memcpy(s->X[0], d->centre, sizeof s->X[0]);
        s->mesh[0] = s->mesh_node[0] = -1;
        return;
    }
    memcpy(s->X, d->built.points, s->n_points * sizeof *s->X);
    memcpy(s->nodes, d->built.nodes, s->n_facets * sizeof *s->nodes);
    if (s->sides)
        memcpy(s->sides, d->built.sides, s->n_facets * sizeof *s->sides);
    memcpy(s->mesh, d->built_mesh, s->n_points * sizeof *s->mesh);
    memcpy(s->mesh_node, d->built_node, s->n_points * sizeof *s->mesh_node);
    for (size_t i = 0; i < s->n_points; ++i)
        s->coupled |= s->mesh[i] >= 0;
}

static int facets_create(struct surface *s)
{
    CHECK_MEMORY(s->nodes = memory_create(s->n_facets, sizeof *s->nodes));
    if (s->definition->built.sides)
        CHECK_MEMORY(s->sides = memory_create(s->n_facets, sizeof *s->sides));
    return 0;
}

/** Places of the prescribed points at time @p t. */
static void prescribe(const struct surface *s, double t, struct surface_motion *level)
{
    const struct motion *motion = &s->definition->motion;
    struct motion_frame frame;
    motion_frame_at(motion, t, &frame);
    for (size_t i = 0; i < s->n_points; ++i) {
        if (s->mesh[i] >= 0)
            continue;
        if (motion->kind == MOTION_FIELD)
            motion_at(motion, s->X[i], t, level->x[i], level->v[i], level->a[i]);
        else
            motion_frame_point(&frame, s->X[i], level->x[i], level->v[i], level->a[i]);
    }
    level->t = t;
}

/** Mesh points at the start: X plus the mesh's initial displacement, with its initial velocity. */
static void place_mesh_points(const struct surface *s, const struct model *model,
                              struct surface_motion *level)
{
    for (size_t i = 0; i < s->n_points; ++i) {
        if (s->mesh[i] < 0)
            continue;
        const struct model_mesh *mesh = &model->meshes[s->mesh[i]];
        for (int k = 0; k < 3; ++k) {
            const struct expression *d = mesh->displacement[k], *v = mesh->velocity[k];
            level->x[i][k] = s->X[i][k] + (d ? expression_value(d, s->X[i], 0.0) : 0.0);
            level->v[i][k] = v ? expression_value(v, s->X[i], 0.0) : 0.0;
        }
    }
}

static int fill_displacement(const void *owner, const struct field *field, void *destination)
{
    (void)field;
    const struct surface *s = owner;
    double(*d)[3] = destination;
    for (size_t i = 0; i < s->n_points; ++i)
        for (int k = 0; k < 3; ++k)
            d[i][k] = s->shown->x[i][k] - s->X[i][k];
    return 0;
}

static void fields_fill(struct surface *s)
{
    /* motion is prescribed, or follows from the solids' state; lists are made for a place of the past */
    const unsigned listed = s->moving ? FIELD_STATE : 0, impulse = s->sub_cycled ? FIELD_STATE : 0;
    const struct field list[] = {
        {"Displacement", "m", FIELD_DOUBLE, 3, FIELD_OUTPUT, {NULL}, fill_displacement},
        [FIELD_VELOCITY] = {"Velocity", "m/s", FIELD_DOUBLE, 3, FIELD_OUTPUT, {s->level[1].v}, NULL},
        [FIELD_ACCELERATION] =
            {"Acceleration", "m/s^2", FIELD_DOUBLE, 3, FIELD_OUTPUT, {s->level[1].a}, NULL},
        {"Load", "N", FIELD_DOUBLE, 3, FIELD_OUTPUT, {s->load}, NULL},
        {"LoadPrevious", "N", FIELD_DOUBLE, 3, FIELD_STATE, {s->load_previous}, NULL},
        {"ListedPlace", "m", FIELD_DOUBLE, 3, listed, {s->listed}, NULL},
        {"Impulse", "N s", FIELD_DOUBLE, 3, impulse, {s->impulse}, NULL},
    };
    _Static_assert(sizeof list == sizeof s->field_list, "every field has its place");
    memcpy(s->field_list, list, sizeof list);
}

static int fields_register(struct surface *s)
{
    char *name = memory_print("surface-%s", s->definition->name);
    CHECK_MEMORY(name);
    s->fields = (struct field_group){name, s, &s->n_points, s->field_list,
                                     sizeof s->field_list / sizeof *s->field_list};
    fields_fill(s);
    return 0;
}

/** Every point stands where level 1 has it. */
static void levels_start(struct surface *s)
{
    surface_motion_copy(&s->level[0], &s->level[1], s->n_points);
    surface_motion_copy(&s->now, &s->level[1], s->n_points);
    surface_motion_copy(&s->trial, &s->level[1], s->n_points);
}

int surface_create(struct surface **surface, const struct model *model, int index, double t)
{
    struct surface *s = memory_create(1, sizeof *s);
    *surface = NULL;
    CHECK_MEMORY(s);
    const struct model_surface *d = &model->surfaces[index];
    bool facets = d->kind == SURFACE_FACETS;
    s->definition = d;
    s->dim = model->dim;
    s->n_facets = facets ? d->built.n_facets : 0;
    int status = points_grow(s, facets ? d->built.n_points : 1);
    if (!status)
        status = facets_create(s);
    if (!status) {
        fill_definition(s);
        s->moving = s->coupled || motion_moves(&d->motion);
        s->sub_cycled = s->coupled && model->coupling.solid_every > 0;
        s->shown = &s->level[1];
        status = fields_register(s);
    }
    if (status) {
        surface_destroy(s);
        return status;
    }
    place_mesh_points(s, model, &s->level[1]);
    prescribe(s, t, &s->level[1]);
    levels_start(s);
    *surface = s;
    return 0;
}

int surface_add_nodes(struct surface *surface, const struct model *model, int mesh, size_t n,
                      const int32_t *nodes)
{
    const size_t first = surface->n_points;
    CALL(points_grow(surface, n));
    for (size_t k = 0; k < n; ++k) {
        memcpy(surface->X[first + k], model->meshes[mesh].mesh.X[nodes[k]], sizeof *surface->X);
        surface->mesh[first + k] = mesh;
        surface->mesh_node[first + k] = nodes[k];
    }
    place_mesh_points(surface, model, &surface->level[1]);
    levels_start(surface);
    fields_fill(surface);
    return 0;
}

void surface_destroy(struct surface *surface)
{
    struct point_array arrays[POINT_ARRAYS];
    if (!surface)
        return;
    point_arrays(surface, arrays);
    for (size_t k = 0; k < POINT_ARRAYS; ++k) {
        void *rows;
        memcpy(&rows, arrays[k].rows, sizeof rows);
        memory_free(rows);
    }
    memory_free(surface->nodes);
    memory_free(surface->sides);
    memory_free(surface->added_mass);
    memory_free(surface->anchors);
    memory_free((char *)surface->fields.name);
    memory_free(surface);
}

void surface_open(struct surface *surface, double t1)
{
    size_t n = surface->n_points;
    double dt = surface->level[1].t - surface->level[0].t;
    if (surface->rule == SURFACE_MEAN && dt > 0.0)
        for (size_t i = 0; i < n; ++i)
            for (int k = 0; k < 3; ++k) {
                surface->now.v[i][k] = (surface->level[1].x[i][k] - surface->level[0].x[i][k]) / dt;
                surface->now.a[i][k] = (surface->level[1].v[i][k] - surface->level[0].v[i][k]) / dt;
            }
    surface_motion_copy(&surface->level[0], &surface->level[1], n);
    surface_reopen(surface, t1);
    memset(surface->impulse, 0, n * sizeof *surface->impulse);
}

void surface_reopen(struct surface *surface, double t1)
{
    if (surface->moving)
        prescribe(surface, t1, &surface->level[1]);
    surface->level[1].t = t1;
}

/** Place and velocity of point @p i at the part @p s of the step: the cubic of Hermite and its derivative. */
static void point_between(const struct surface *surface, size_t i, double s, double x[3], double v[3])
{
    const struct surface_motion *l0 = &surface->level[0], *l1 = &surface->level[1];
    const double dt = l1->t - l0->t, r = 1.0 - s;
    for (int k = 0; k < 3; ++k) {
        const double way = l1->x[i][k] - l0->x[i][k], v0 = l0->v[i][k], v1 = l1->v[i][k];
        x[k] = l0->x[i][k] + s * s * (3.0 - 2.0 * s) * way + dt * s * r * (r * v0 - s * v1);
        v[k] = 6.0 * s * r * way / dt + r * (1.0 - 3.0 * s) * v0 + s * (3.0 * s - 2.0) * v1;
    }
}

void surface_at(struct surface *surface, double t)
{
    const struct surface_motion *l0 = &surface->level[0], *l1 = &surface->level[1];
    size_t n = surface->n_points;
    if (surface->rule == SURFACE_MEAN) {
        memcpy(surface->now.x, l0->x, n * sizeof *l0->x);
    } else if (t == l1->t) {
        surface_motion_copy(&surface->now, l1, n);
    } else if (t == l0->t || l1->t == l0->t) {
        surface_motion_copy(&surface->now, l0, n);
    } else {
        const double s = (t - l0->t) / (l1->t - l0->t);
        for (size_t i = 0; i < n; ++i) {
            point_between(surface, i, s, surface->now.x[i], surface->now.v[i]);
            for (int k = 0; k < 3; ++k)
                surface->now.a[i][k] = (1.0 - s) * l0->a[i][k] + s * l1->a[i][k];
        }
    }
    surface->now.t = t;
}

double surface_travel(const struct surface *surface, double t, double dt)
{
    const struct surface_motion *l0 = &surface->level[0], *l1 = &surface->level[1];
    const double step = l1->t - l0->t;
    const bool whole = !(dt < (1.0 - 1e-9) * step);
    double farthest = 0.0;
    for (size_t i = 0; i < surface->n_points; ++i) {
        double before[3], after[3], v[3], square = 0.0;
        if (!whole) {
            point_between(surface, i, (t - dt - l0->t) / step, before, v);
            point_between(surface, i, (t - l0->t) / step, after, v);
        }
        for (int k = 0; k < 3; ++k) {
            const double way = whole ? l1->x[i][k] - l0->x[i][k] : after[k] - before[k];
            square += way * way;
        }
        farthest = fmax(farthest, square);
    }
    return sqrt(farthest);
}

void surface_show(struct surface *surface, bool now)
{
    surface->shown = now ? &surface->now : &surface->level[1];
    surface->field_list[FIELD_VELOCITY].data[0] = surface->shown->v;
    surface->field_list[FIELD_ACCELERATION].data[0] = surface->shown->a;
}

void surface_mark(struct surface *surface)
{
    memcpy(surface->listed, surface->now.x, surface->n_points * sizeof *surface->listed);
}

void surface_recall(struct surface *surface, double t)
{
    if (surface->moving)
        memcpy(surface->now.x, surface->listed, surface->n_points * sizeof *surface->listed);
    surface->now.t = t;
}

void surface_resume(struct surface *surface, double t)
{
    struct surface_motion *const others[] = {&surface->level[0], &surface->now, &surface->trial};
    prescribe(surface, t, &surface->level[1]);
    for (size_t k = 0; k < sizeof others / sizeof *others; ++k)
        surface_motion_copy(others[k], &surface->level[1], surface->n_points);
}

int surface_spread(const struct surface *surface, size_t facet, int32_t points[SIDE_MAX_NODES],
                   double weights[SIDE_MAX_NODES])
{
    const int32_t *nodes = surface->nodes[facet];
    if (!surface->sides || surface->sides[facet][0] < 0) {
        int n = 0;
        for (; n < 4 && nodes[n] >= 0; ++n)
            points[n] = nodes[n];
        return n;
    }
    const int32_t *side = surface->sides[facet];
    const enum element_type type = mesh_side_type(surface->dim, side);
    const int n = element_nodes(type);
    double at[3] = {0.0, 0.0, 0.0};
    for (int j = 0; j < 4 && nodes[j] >= 0; ++j) {
        int a = 0;
        double xi[3];
        while (a < n - 1 && side[a] != nodes[j])
            ++a;
        element_node(type, a, xi);
        for (int k = 0; k < 3; ++k)
            at[k] += weights[j] * xi[k];
    }
    memcpy(points, side, (size_t)n * sizeof *points);
    element_shape(type, at, weights, NULL);
    return n;
}

void surface_clear_load(struct surface *surface)
{
    memset(surface->load, 0, surface->n_points * sizeof *surface->load);
    memset(surface->moment, 0, sizeof surface->moment);
}

void surface_sum_parts(const struct surface *surface, double (*sum)[3])
{
#pragma omp parallel for schedule(static) if (surface->n_points >= LEAST_SHARED)
    for (size_t i = 0; i < surface->n_points; ++i)
        for (size_t part = 0; part < SURFACE_PARTS; ++part)
            for (int k = 0; k < 3; ++k) {
                sum[i][k] += surface->part[part][i][k];
                surface->part[part][i][k] = 0.0;
            }
}

void surface_add_impulse(struct surface *surface, double dt, enum surface_load kind)
{
    for (size_t i = 0; i < surface->n_points; ++i)
        for (int k = 0; k < 3; ++k) {
            double f = surface->load[i][k];
            surface->impulse[i][k] +=
                kind == SURFACE_LOAD_MEAN ? dt * f : 0.5 * dt * (surface->load_previous[i][k] + f);
            surface->load_previous[i][k] = f;
        }
}

/** Sum of the weighted rows of @p values. */
static void anchors_gather(const struct anchor *anchors, uint32_t n, const double (*values)[3], double sum[3])
{
    sum[0] = sum[1] = sum[2] = 0.0;
    for (uint32_t j = 0; j < n; ++j)
        for (int k = 0; k < 3; ++k)
            sum[k] += anchors[j].weight * values[anchors[j].point][k];
}

int surface_added_mass_reserve(struct surface *surface)
{
    CALL(memory_grow((void **)&surface->added_mass, &surface->added_mass_capacity, surface->n_added_mass,
                     sizeof *surface->added_mass));
    return memory_grow((void **)&surface->anchors, &surface->anchors_capacity, surface->n_anchors,
                       sizeof *surface->anchors);
}

static void contact_apply(const struct surface *surface, const struct added_mass_contact *contact,
                          const double (*acceleration)[3], double per_acceleration, double (*result)[3])
{
    const struct anchor *rows = surface->anchors + contact->row;
    const double damping = per_acceleration * contact->damping;
    double a[3], own[3], f[3];
    anchors_gather(surface->anchors + contact->column, contact->n_columns, acceleration, a);
    if (contact->row == contact->column)
        memcpy(own, a, sizeof own);
    else
        anchors_gather(rows, contact->n_rows, acceleration, own);
    for (int k = 0; k < 3; ++k)
        f[k] = contact->tensor[k][0] * a[0] + contact->tensor[k][1] * a[1] + contact->tensor[k][2] * a[2] +
               damping * own[k];
    for (uint32_t j = 0; j < contact->n_rows; ++j)
        for (int k = 0; k < 3; ++k)
            result[rows[j].point][k] += rows[j].weight * f[k];
}

void surface_added_mass_apply(const struct surface *surface, const double (*acceleration)[3],
                              double per_acceleration, double (*result)[3])
{
    const size_t n = surface->n_added_mass;
#pragma omp parallel for schedule(static, 1) if (n >= LEAST_SHARED)
    for (size_t part = 0; part < SURFACE_PARTS; ++part)
        for (size_t c = n * part / SURFACE_PARTS; c < n * (part + 1) / SURFACE_PARTS; ++c)
            contact_apply(surface, &surface->added_mass[c], acceleration, per_acceleration,
                          surface->part[part]);
    memset(result, 0, surface->n_points * sizeof *result);
    surface_sum_parts(surface, result);
}

void surface_total_load(const struct surface *surface, const double centre[3], double force[3],
                        double moment[3])
{
    for (int k = 0; k < 3; ++k) {
        force[k] = 0.0;
        moment[k] = surface->moment[k];
    }
    for (size_t i = 0; i < surface->n_points; ++i) {
        const double *f = surface->load[i];
        double r[3];
        for (int k = 0; k < 3; ++k) {
            r[k] = surface->now.x[i][k] - centre[k];
            force[k] += f[k];
        }
        moment[0] += r[1] * f[2] - r[2] * f[1];
        moment[1] += r[2] * f[0] - r[0] * f[2];
        moment[2] += r[0] * f[1] - r[1] * f[0];
    }
}
