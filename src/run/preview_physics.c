// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/preview_physics.h"

#include "base/log.h"
#include "model/surface_rims.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TIMES = 200, PLACES = 20, RAYS = 400 };

static double length3(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double speed_of(struct expression *const velocity[3], const double x[3], double t)
{
    double v[3] = {0.0, 0.0, 0.0};
    for (int d = 0; d < 3; d++)
        if (velocity[d])
            v[d] = expression_value(velocity[d], x, t);
    double speed = length3(v);
    return isfinite(speed) ? speed : 0.0;
}

/** Highest speed over a lattice of places in a box at time @p t. */
static double speed_in_box(struct expression *const velocity[3], int dim, const double lower[3],
                           const double upper[3], double t)
{
    const int n[3] = {PLACES, dim > 1 ? PLACES : 0, dim > 2 ? PLACES : 0};
    double most = 0.0;
    for (int i = 0; i <= n[0]; i++)
        for (int j = 0; j <= n[1]; j++)
            for (int k = 0; k <= n[2]; k++) {
                const double s[3] = {(double)i / PLACES, (double)j / PLACES, (double)k / PLACES};
                double x[3];
                for (int d = 0; d < 3; d++)
                    x[d] = lower[d] + s[d] * (upper[d] - lower[d]);
                most = fmax(most, speed_of(velocity, x, t));
            }
    return most;
}

/** Highest speed of the prescribed points of a surface at time @p t. */
static double speed_of_surface(const struct model_surface *surface, int dim, double t)
{
    double most = 0.0, x[3], v[3], a[3];
    if (!motion_moves(&surface->motion))
        return 0.0;
    for (size_t i = 0; i < surface->built.n_points; i++)
        if (surface->built_mesh[i] < 0) {
            motion_at(&surface->motion, surface->built.points[i], t, x, v, a);
            most = fmax(most, length3(v));
        }
    if (surface->kind != SURFACE_FACETS)
        for (int d = 0; d < dim; d++) {
            double X[3];
            memcpy(X, surface->centre, sizeof X);
            X[d] += surface->kind == SURFACE_PLANE ? 0.0 : surface->radius;
            motion_at(&surface->motion, X, t, x, v, a);
            most = fmax(most, length3(v));
        }
    return isfinite(most) ? most : 0.0;
}

static double speed_of_region(const struct model *model, const struct model_region *region)
{
    double lower[3], upper[3], most = 0.0;
    if (!region->n_points) {
        shape_bounds(&region->shape, model->dim, lower, upper);
        return speed_in_box(region->velocity, model->dim, lower, upper, 0.0);
    }
    for (size_t i = 0; i < region->n_points; i++)
        most = fmax(most, speed_of(region->velocity, region->points[i], 0.0));
    return most;
}

void preview_find_limits(const struct model *model, struct preview_limits *limits)
{
    const struct fluid_material *material = &model->fluid_materials[model->fluid.material];
    const double h = model->fluid.spacing * model->fluid.smoothing_length_ratio;
    double speed = 0.0, force = 0.0;
    for (size_t r = 0; r < model->fluid.n_regions; r++)
        speed = fmax(speed, speed_of_region(model, &model->fluid.regions[r]));
    for (int i = 0; i <= TIMES; i++) {
        const double t = model->time.end * i / TIMES;
        for (size_t o = 0; o < model->n_openings; o++) {
            const struct model_open *open = &model->openings[o];
            double lower[3], upper[3];
            memcpy(lower, open->lower, sizeof lower);
            memcpy(upper, open->upper, sizeof upper);
            lower[open->axis] = upper[open->axis] = open->at;
            speed = fmax(speed, speed_in_box(open->velocity, model->dim, lower, upper, t));
        }
        for (size_t s = 0; s < model->n_surfaces; s++)
            speed = fmax(speed, speed_of_surface(&model->surfaces[s], model->dim, t));
        force = fmax(force, speed_of(model->time.body_force, NULL, t));
    }
    limits->speed = speed;
    limits->sound = 0.25 * h / (material->sound_speed + speed);
    limits->viscosity =
        material->kinematic_viscosity > 0.0 ? 0.125 * h * h / material->kinematic_viscosity : INFINITY;
    limits->body_force = force > 0.0 ? 0.25 * sqrt(h / force) : INFINITY;
}

static void warn_at(const struct model *model, struct location where, const char *text)
{
    log_message(LOG_WARNING, "%s:%d:%d: %s", model->path, where.line, where.column, text);
}

static void warn_step(const struct model *model, const struct preview_limits *limits)
{
    const double least = fmin(limits->sound, fmin(limits->viscosity, limits->body_force));
    const char *what = least == limits->sound       ? "0.25 h / (c + u)"
                       : least == limits->viscosity ? "0.125 h^2 / nu"
                                                    : "0.25 sqrt(h / b)";
    char text[256];
    if (model->time.step <= least * (1.0 + 1e-9))
        return;
    snprintf(text, sizeof text, "<time>: the step of %.4g s exceeds the stability limit %s = %.4g s",
             model->time.step, what, least);
    warn_at(model, model->time.where, text);
}

/** Lattices fit where lengths are multiples of the spacing. */
static void warn_length(const struct model *model, struct location where, const char *what, int axis,
                        double length)
{
    const double dx = model->fluid.spacing, n = length / dx;
    char text[256];
    if (fabs(n - rint(n)) <= 1e-3)
        return;
    snprintf(text, sizeof text,
             "%s: its length %.6g in direction %c is %.3f spacings; a whole number fits better (dx = %.6g)",
             what, length, "xyz"[axis], n, length / fmax(1.0, rint(n)));
    warn_at(model, where, text);
}

static void warn_spacing(const struct model *model)
{
    for (int d = 0; d < model->dim; d++) {
        if (model->domain.periodic[d])
            warn_length(model, model->domain.where, "<domain>: periodic", d,
                        model->domain.upper[d] - model->domain.lower[d]);
        for (size_t r = 0; r < model->fluid.n_regions; r++) {
            const struct model_region *region = &model->fluid.regions[r];
            const struct shape *shape = &region->shape;
            while (!region->n_points && shape->kind == SHAPE_DIFFERENCE)
                shape = &shape->children[0];
            if (!region->n_points && shape->kind == SHAPE_BOX)
                warn_length(model, region->where, "<region>", d, shape->b[d] - shape->a[d]);
        }
    }
}

static int facet_corners(const int32_t nodes[4])
{
    int n = 0;
    while (n < 4 && nodes[n] >= 0)
        n++;
    return n;
}

static void facet_centre(const struct facets *facets, size_t f, double centre[3])
{
    const int n = facet_corners(facets->nodes[f]);
    for (int d = 0; d < 3; d++) {
        centre[d] = 0.0;
        for (int k = 0; k < n; k++)
            centre[d] += facets->points[facets->nodes[f][k]][d] / n;
    }
}

static void facet_normal(const struct facets *facets, size_t f, double normal[3])
{
    double a[3], b[3];
    const int32_t *nodes = facets->nodes[f];
    for (int d = 0; d < 3; d++) {
        a[d] = facets->points[nodes[1]][d] - facets->points[nodes[0]][d];
        b[d] = facets->dim == 3 ? facets->points[nodes[2]][d] - facets->points[nodes[0]][d] : d == 2;
    }
    normal[0] = a[1] * b[2] - a[2] * b[1]; // 2-D: (t_y, -t_x), to the right of the way
    normal[1] = a[2] * b[0] - a[0] * b[2];
    normal[2] = a[0] * b[1] - a[1] * b[0];
    const double length = length3(normal);
    for (int d = 0; d < 3 && length > 0.0; d++)
        normal[d] /= length;
}

/** Where the ray x + s e meets a segment (2-D); infinite: nowhere in front. */
static double ray_segment(const double x[3], const double e[3], const double a[3], const double b[3])
{
    const double tx = b[0] - a[0], ty = b[1] - a[1], rx = a[0] - x[0], ry = a[1] - x[1];
    const double det = e[1] * tx - e[0] * ty;
    if (det == 0.0)
        return INFINITY;
    const double s = (ry * tx - rx * ty) / det, u = (e[0] * ry - e[1] * rx) / det;
    return u >= 0.0 && u <= 1.0 && s > 0.0 ? s : INFINITY;
}

/** The same for a triangle (Moeller and Trumbore). */
static double ray_triangle(const double x[3], const double e[3], const double a[3], const double b[3],
                           const double c[3])
{
    double p[3], q[3], u[3], v[3], r[3];
    for (int d = 0; d < 3; d++) {
        u[d] = b[d] - a[d];
        v[d] = c[d] - a[d];
        r[d] = x[d] - a[d];
    }
    for (int d = 0; d < 3; d++) {
        const int i = (d + 1) % 3, j = (d + 2) % 3;
        p[d] = e[i] * v[j] - e[j] * v[i];
        q[d] = r[i] * u[j] - r[j] * u[i];
    }
    const double det = u[0] * p[0] + u[1] * p[1] + u[2] * p[2];
    if (det == 0.0)
        return INFINITY;
    const double beta = (r[0] * p[0] + r[1] * p[1] + r[2] * p[2]) / det;
    const double gamma = (e[0] * q[0] + e[1] * q[1] + e[2] * q[2]) / det;
    const double s = (v[0] * q[0] + v[1] * q[1] + v[2] * q[2]) / det;
    return beta >= 0.0 && gamma >= 0.0 && beta + gamma <= 1.0 && s > 0.0 ? s : INFINITY;
}

static double ray_facet(const struct facets *facets, size_t f, const double x[3], const double e[3])
{
    const int32_t *nodes = facets->nodes[f];
    const double *a = facets->points[nodes[0]], *b = facets->points[nodes[1]];
    if (facets->dim == 2)
        return ray_segment(x, e, a, b);
    double s = ray_triangle(x, e, a, b, facets->points[nodes[2]]);
    if (facet_corners(nodes) == 4)
        s = fmin(s, ray_triangle(x, e, a, facets->points[nodes[2]], facets->points[nodes[3]]));
    return s;
}

double preview_thickness(const struct facets *facets, double where[3])
{
    const double lower[3] = {-INFINITY, -INFINITY, -INFINITY}, upper[3] = {INFINITY, INFINITY, INFINITY};
    double least = INFINITY;
    struct surface_rims rims;
    if (facets->dim < 2 || surface_rims_find(&facets, 1, 0.0, 0.0, lower, upper, &rims) || rims.n_open)
        return INFINITY;
    const size_t stride = facets->n_facets / RAYS + 1;
    for (size_t f = 0; f < facets->n_facets; f += stride) {
        double centre[3], normal[3], direction[3];
        facet_centre(facets, f, centre);
        facet_normal(facets, f, normal);
        for (int d = 0; d < 3; d++)
            direction[d] = -normal[d];
        for (size_t other = 0; other < facets->n_facets; other++) {
            const double s = other == f ? INFINITY : ray_facet(facets, other, centre, direction);
            if (s < least) {
                least = s;
                memcpy(where, centre, sizeof centre);
            }
        }
    }
    return least;
}

static double facet_size(const struct facets *facets, size_t f)
{
    const int n = facet_corners(facets->nodes[f]);
    double least = INFINITY;
    for (int k = 0; k < (n == 2 ? 1 : n); k++) {
        double edge[3];
        for (int d = 0; d < 3; d++)
            edge[d] =
                facets->points[facets->nodes[f][(k + 1) % n]][d] - facets->points[facets->nodes[f][k]][d];
        least = fmin(least, length3(edge));
    }
    return least;
}

static void warn_surface(const struct model *model, const struct model_wall *wall,
                         const struct model_surface *surface)
{
    const double dx = model->fluid.spacing, support = 3.0 * dx * model->fluid.smoothing_length_ratio;
    const bool sliding = strcmp(wall->treatment, "sliding-particles") == 0;
    const double wanted = sliding ? 2.0 * dx : support;
    double where[3] = {0.0, 0.0, 0.0}, shortest = INFINITY;
    size_t n_short = 0;
    char text[512];
    const double thickness = preview_thickness(&surface->built, where);
    if (thickness < wanted * (1.0 - 1e-6)) {
        snprintf(text, sizeof text,
                 "<surface name=\"%s\">: the solid is only %.4g thick near (%.4g, %.4g, %.4g), less than %s "
                 "= %.4g: fluid on "
                 "its two sides interacts through it",
                 surface->name, thickness, where[0], where[1], where[2],
                 sliding ? "2 spacings" : "the support of the kernel", wanted);
        warn_at(model, surface->where, text);
    }
    for (size_t f = 0; sliding && f < surface->built.n_facets; f++) {
        const double size = facet_size(&surface->built, f);
        n_short += size < dx * (1.0 - 1e-6);
        shortest = fmin(shortest, size);
    }
    if (n_short) {
        snprintf(text, sizeof text,
                 "<surface name=\"%s\">: %zu facet%s shorter than one spacing (shortest edge %.4g, spacing "
                 "%.4g); two "
                 "spacings or more are best",
                 surface->name, n_short, n_short > 1 ? "s are" : " is", shortest, dx);
        warn_at(model, surface->where, text);
    }
}

void preview_warn(const struct model *model, const struct preview_limits *limits)
{
    const struct fluid_material *material = &model->fluid_materials[model->fluid.material];
    char text[256];
    if (material->sound_speed < 10.0 * limits->speed * (1.0 - 1e-9)) {
        snprintf(text, sizeof text,
                 "<fluid name=\"%s\">: the sound speed %.4g m/s is less than ten times the highest "
                 "prescribed speed %.4g m/s",
                 material->name, material->sound_speed, limits->speed);
        warn_at(model, material->where, text);
    }
    warn_step(model, limits);
    warn_spacing(model);
    for (size_t w = 0; w < model->n_walls; w++)
        for (size_t s = 0; s < model->walls[w].n_surfaces; s++) {
            const struct model_surface *surface = &model->surfaces[model->walls[w].surfaces[s]];
            if (surface->kind == SURFACE_FACETS)
                warn_surface(model, &model->walls[w], surface);
        }
}
