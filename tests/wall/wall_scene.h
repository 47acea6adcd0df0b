// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TESTS_WALL_WALL_SCENE_H
#define TESTS_WALL_WALL_SCENE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/memory.h"
#include "model/surface_build.h"
#include "sph/boundary.h"
#include "wall/wall_list.h"

#include <math.h>
#include <string.h>

/** A piece of fluid and a wall without the rest of the engine, in units of the lattice spacing and the
 * density. */
struct scene {
    struct model model;
    struct model_surface surface_definition;
    struct model_wall wall;
    int surface_index;
    struct surface *surface;
    struct particles *particles;
    struct cell_grid grid;
    struct fluid_view view;
    struct boundary *boundary;
    struct wall_neighbours neighbours;
};

static const double scene_zero[3] = {0.0, 0.0, 0.0};

static inline void scene_start(struct scene *scene, int dim, double lower, double upper, bool periodic)
{
    const bool wraps[3] = {periodic, periodic, periodic};
    double low[3] = {lower, lower, lower}, high[3] = {upper, upper, upper};
    memset(scene, 0, sizeof *scene);
    scene->model.dim = dim;
    scene->model.path = (char *)"scene.xml";
    scene->model.fluid.spacing = 1.0;
    assert_int_equal(particles_create(&scene->particles, "fluid", dim, 16), 0);
    assert_int_equal(cell_grid_create(&scene->grid, dim, low, high, wraps, 3.3, 3.3, 1.0), 0);
    scene->view = (struct fluid_view){.dim = dim,
                                      .spacing = 1.0,
                                      .mass = 1.0,
                                      .skin = 0.3,
                                      .dt = 0.01,
                                      .kernel = kernel_quintic(dim, 1.0, false),
                                      .density = 1.0,
                                      .sound_speed = 10.0,
                                      .viscosity = 0.1};
    scene->wall.treatment = (char *)"sliding-particles";
    scene->wall.name = (char *)"wall";
    scene->wall.pressure_gradient = true;
    scene->surface_definition.name = (char *)"surface";
}

static inline void scene_add(struct scene *scene, double x, double y, double z)
{
    const double place[3] = {x, y, z};
    size_t index;
    assert_int_equal(particles_append(scene->particles, PARTICLE_FLUID, place, 1.0, &index), 0);
    scene->particles->rho[index] = 1.0;
}

static inline void scene_facets(struct scene *scene, size_t n_points, const double (*points)[3],
                                size_t n_facets, const int32_t (*nodes)[4])
{
    struct model_surface *definition = &scene->surface_definition;
    definition->kind = SURFACE_FACETS;
    struct facets *built = &definition->built;
    *built = (struct facets){scene->model.dim, n_points, n_facets, memory_create(n_points, sizeof *points),
                             memory_create(n_facets, sizeof *nodes)};
    memcpy(built->points, points, n_points * sizeof *points);
    memcpy(built->nodes, nodes, n_facets * sizeof *nodes);
    definition->built_mesh = memory_create(n_points, sizeof(int32_t));
    definition->built_node = memory_create(n_points, sizeof(int32_t));
    for (size_t i = 0; i < n_points; ++i)
        definition->built_mesh[i] = definition->built_node[i] = -1;
}

/** A 2-D wall through the points in turn: the solid lies to the left. */
static inline void scene_chain(struct scene *scene, size_t n, const double (*points)[3], bool closed)
{
    size_t n_facets = closed ? n : n - 1;
    int32_t(*nodes)[4] = memory_create(n_facets, sizeof *nodes);
    for (size_t f = 0; f < n_facets; ++f) {
        nodes[f][0] = (int32_t)f;
        nodes[f][1] = (int32_t)((f + 1) % n);
        nodes[f][2] = nodes[f][3] = -1;
    }
    scene_facets(scene, n, points, n_facets, (const int32_t(*)[4])nodes);
    memory_free(nodes);
}

static inline void scene_list(struct scene *scene)
{
    uint32_t *order = memory_create(scene->particles->n, sizeof *order);
    const double *const x[3] = {scene->particles->x[0], scene->particles->x[1], scene->particles->x[2]};
    assert_int_equal(cell_grid_sort(&scene->grid, x, scene->particles->n, order), 0);
    assert_int_equal(particles_permute(scene->particles, order, scene->particles->n), 0);
    memory_free(order);
    for (size_t k = 0; k < scene->boundary->n_surfaces; ++k)
        surface_at(scene->boundary->surfaces[k], scene->view.t);
    assert_int_equal(scene->boundary->type->list(scene->boundary, &scene->view), 0);
    assert_int_equal(boundary_prepare(scene->boundary, &scene->view, false), 0);
}

/** Build the boundary, sort, list and prepare. */
static inline void scene_build(struct scene *scene, enum corners corners)
{
    scene->wall.corners = corners;
    scene->wall.n_surfaces = 1;
    scene->wall.surfaces = &scene->surface_index;
    scene->model.walls = &scene->wall;
    scene->model.n_walls = 1;
    scene->model.surfaces = &scene->surface_definition;
    scene->model.n_surfaces = 1;
    scene->view.particles = scene->particles;
    scene->view.grid = &scene->grid;
    assert_int_equal(surface_create(&scene->surface, &scene->model, 0, 0.0), 0);
    for (size_t w = 0; w < WALL_TYPES; ++w)
        if (!strcmp(wall_types[w]->name, scene->wall.treatment))
            assert_int_equal(wall_types[w]->check(&scene->model, &scene->wall), 0);
    assert_int_equal(boundary_create(&scene->boundary, &scene->model, 0, &scene->surface, &scene->view,
                                     wall_types, WALL_TYPES),
                     0);
    scene_list(scene);
}

static inline void scene_end(struct scene *scene)
{
    boundary_destroy(scene->boundary);
    surface_destroy(scene->surface);
    particles_destroy(scene->particles);
    cell_grid_reset(&scene->grid);
    wall_neighbours_reset(&scene->neighbours);
    surface_build_reset(&scene->surface_definition);
    memset(scene, 0, sizeof *scene);
}

/** Density and sum of kernel gradients of particle @p i from the fluid. */
static inline void scene_fluid_sums(const struct scene *scene, uint32_t i, double *rho, double gradient[3])
{
    const struct particles *p = scene->particles;
    const struct kernel *kernel = &scene->view.kernel;
    for (size_t j = 0; j < p->n; ++j) {
        double d[3], r = 0.0;
        for (int k = 0; k < 3; ++k) {
            d[k] = p->x[k][i] - p->x[k][j];
            r += d[k] * d[k];
        }
        r = sqrt(r);
        *rho += kernel_w(kernel, r);
        for (int k = 0; k < 3 && r > 0.0; ++k)
            gradient[k] += kernel_dw(kernel, r) * d[k] / r;
    }
}

/** The same from the wall, of near particle @p near. */
static inline void scene_wall_sums(struct scene *scene, size_t near, double *rho, double gradient[3])
{
    struct wall_neighbours *w = &scene->neighbours;
    assert_int_equal(scene->boundary->type->gather(scene->boundary, &scene->view, near, w), 0);
    double sum = 0.0;
    for (size_t n = 0; n < w->n; ++n) {
        sum += w->share_density[n] * w->w[n];
        for (int k = 0; k < 3; ++k)
            gradient[k] += w->share_pressure[n] * w->dw[n] * w->dx[k][n] / w->r[n];
    }
    assert_float_equal(sum, scene->boundary->kernel_sum[near], 1e-13);
    *rho += sum;
}

/** Largest |rho - 1| and |sum of gradients| over near particles within @p radius of the origin. */
static inline void scene_errors(struct scene *scene, double radius, double *density, double *gradient)
{
    size_t n = 0;
    *density = *gradient = 0.0;
    for (size_t near = 0; near < scene->boundary->n_near; ++near) {
        uint32_t i = scene->boundary->near[near];
        double x[3], rho = 0.0, g[3] = {0.0, 0.0, 0.0}, r2 = 0.0;
        for (int k = 0; k < 3; ++k) {
            x[k] = scene->particles->x[k][i];
            r2 += x[k] * x[k];
        }
        if (r2 > radius * radius)
            continue;
        ++n;
        scene_fluid_sums(scene, i, &rho, g);
        scene_wall_sums(scene, near, &rho, g);
        *density = fmax(*density, fabs(rho - 1.0));
        *gradient = fmax(*gradient, sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]));
    }
    assert_true(n > 4);
}

static inline double scene_noise(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)*seed / 4294967296.0 - 0.5;
}

/** Awkward values on every particle, the same for the same place. */
static inline void scene_fill(struct scene *scene)
{
    struct particles *p = scene->particles;
    for (size_t i = 0; i < p->n; ++i) {
        uint32_t seed = (uint32_t)lround(1e3 * (p->x[0][i] + 31.0 * p->x[1][i] + 977.0 * p->x[2][i]));
        for (int k = 0; k < 4; ++k)
            scene_noise(&seed);
        p->p[i] = 3.0 * scene_noise(&seed) + 2.0;
        p->rho[i] = 1.0 + 0.05 * scene_noise(&seed);
        for (int k = 0; k < scene->model.dim; ++k)
            p->u[k][i] = scene_noise(&seed);
    }
    for (int k = 0; k < scene->model.dim; ++k)
        scene->view.body_force[k] = 0.3 - 0.7 * k;
}

/** Forces by eq. 40 on all near particles, reactions, and loads; returns the total force on the fluid. */
static inline void scene_forces(struct scene *scene, double total[3])
{
    struct boundary *b = scene->boundary;
    const struct particles *p = scene->particles;
    assert_int_equal(b->type->close(b, &scene->view), 0);
    total[0] = total[1] = total[2] = 0.0;
    for (size_t near = 0; near < b->n_near; ++near) {
        struct wall_neighbours *w = &scene->neighbours;
        assert_int_equal(b->type->gather(b, &scene->view, near, w), 0);
        uint32_t i = b->near[near];
        double *force[3], volume = p->m[i] / p->rho[i];
        for (int k = 0; k < 3; ++k)
            force[k] = memory_create(w->n, sizeof(double));
        for (size_t n = 0; n < w->n; ++n) {
            double mean = (w->rho[n] * p->p[i] + p->rho[i] * w->p[n]) / (w->rho[n] + p->rho[i]);
            double v2 = volume * volume + w->volume[n] * w->volume[n];
            for (int k = 0; k < 3; ++k) {
                force[k][n] =
                    v2 * w->dw[n] / w->r[n] *
                    (-w->share_pressure[n] * mean * w->dx[k][n] +
                     w->share_viscous[n] * scene->view.viscosity * (p->u[k][i] - w->u_viscous[k][n]));
                total[k] += force[k][n];
            }
        }
        b->type->react(b, near, w, force);
        for (int k = 0; k < 3; ++k)
            memory_free(force[k]);
    }
    surface_clear_load(scene->surface);
    b->type->load(b, &scene->view);
}

#endif
