// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary particles that are material points of meshes.
#include "wall_scene.h"

#include "base/error.h"
#include "model/surface_build.h"

#include <omp.h>

/** A block of a mesh in a fluid that fills a box of the lattice around it. */
struct block_scene {
    struct scene scene;
    struct model_mesh mesh;
    struct model_region region;
    struct surface_part parts[2];
    struct facets floor;
};

static const double block_lower[3] = {-4.7, -4.2, -4.3}, block_upper[3] = {5.4, 4.1, 4.6};

enum { FLUID_HALF = 9 }; /* the fluid's box, in spacings */

static const enum element_type all_types[] = {ELEMENT_QUAD4, ELEMENT_TRI3, ELEMENT_TRI6, ELEMENT_QUAD8,
                                              ELEMENT_QUAD9, ELEMENT_HEX8, ELEMENT_TET4, ELEMENT_TET10,
                                              ELEMENT_HEX20, ELEMENT_HEX27};

enum { ALL_TYPES = sizeof all_types / sizeof *all_types };

/** Signed distance from the block. */
static double block_distance(int dim, const double x[3])
{
    struct shape box = {.kind = SHAPE_BOX};
    memcpy(box.a, block_lower, sizeof box.a);
    memcpy(box.b, block_upper, sizeof box.b);
    return shape_distance(&box, dim, x);
}

/** The problem without surfaces: a mesh of @p type whose inner nodes are off their grid. */
static void block_start(struct block_scene *b, enum element_type type)
{
    const int dim = element_dim(type);
    memset(b, 0, sizeof *b);
    scene_start(&b->scene, dim, -12.0, 12.0, false);
    struct model *model = &b->scene.model;
    assert_int_equal(mesh_create_grid(&b->mesh.mesh, dim, block_lower, block_upper, (const int[3]){4, 3, 3}),
                     0);
    for (size_t a = 0; a < b->mesh.mesh.n_nodes; ++a)
        if (block_distance(dim, b->mesh.mesh.X[a]) < -1e-9)
            for (int d = 0; d < dim; ++d)
                b->mesh.mesh.X[a][d] += 0.4 * sin(11.3 * (double)a + 2.7 * d);
    assert_int_equal(mesh_convert(&b->mesh.mesh, type), 0);
    b->mesh.name = (char *)"block";
    model->meshes = &b->mesh;
    model->n_meshes = 1;
    model->fluid.smoothing_length_ratio = 1.0;
    model->fluid.regions = &b->region;
    model->fluid.n_regions = 1;
    b->region.shape.kind = SHAPE_BOX;
    for (int d = 0; d < dim; ++d) {
        model->domain.lower[d] = -12.0;
        model->domain.upper[d] = 12.0;
        b->region.shape.a[d] = -FLUID_HALF;
        b->region.shape.b[d] = FLUID_HALF;
    }
    b->scene.wall.treatment = (char *)"fixed-particles";
}

/** Fluid on the lattice where the block is not; in 2-D with a floor only above @p bottom. */
static void block_flood(struct block_scene *b, double bottom)
{
    const int dim = b->scene.model.dim;
    for (int k = dim > 2 ? -FLUID_HALF : 0; k < (dim > 2 ? FLUID_HALF : 1); ++k)
        for (int j = -FLUID_HALF; j < FLUID_HALF; ++j)
            for (int i = -FLUID_HALF; i < FLUID_HALF; ++i) {
                const double x[3] = {i + 0.5, j + 0.5, dim > 2 ? k + 0.5 : 0.0};
                if (block_distance(dim, x) > 0.02 && x[1] > bottom)
                    scene_add(&b->scene, x[0], x[1], x[2]);
            }
}

/** The block amid the fluid: its skin is the wall. */
static void block_build(struct block_scene *b, enum element_type type)
{
    block_start(b, type);
    block_flood(b, -INFINITY);
    struct model_surface *surface = &b->scene.surface_definition;
    b->parts[0] = (struct surface_part){.mesh = 0};
    surface->parts = b->parts;
    surface->n_parts = 1;
    assert_int_equal(surface_build(&b->scene.model, surface), 0);
    scene_build(&b->scene, CORNERS_SHARES);
}

/** The block stands on a rigid floor, in one surface. */
static void block_on_floor(struct block_scene *b)
{
    const double y = block_lower[1];
    double points[4][3] = {
        {11.0, y, 0.0}, {block_upper[0], y, 0.0}, {block_lower[0], y, 0.0}, {-11.0, y, 0.0}};
    int32_t nodes[2][4] = {{0, 1, -1, -1}, {2, 3, -1, -1}};
    block_start(b, ELEMENT_QUAD4);
    block_flood(b, y + 0.02);
    struct model_surface *surface = &b->scene.surface_definition;
    static int foot;
    foot = (int)(mesh_find_set(&b->mesh.mesh, "y-") - b->mesh.mesh.sets);
    b->parts[0] = (struct surface_part){.mesh = 0, .n_excluded = 1, .excluded = &foot};
    b->parts[1] = (struct surface_part){.mesh = -1, .facets = {2, 4, 2, points, nodes}};
    surface->parts = b->parts;
    surface->n_parts = 2;
    assert_int_equal(surface_build(&b->scene.model, surface), 0);
    scene_build(&b->scene, CORNERS_SHARES);
}

static void block_end(struct block_scene *b)
{
    scene_end(&b->scene);
    mesh_reset(&b->mesh.mesh);
}

static double *const *wall_field(const struct scene *scene, const char *name)
{
    const struct field *field = field_find(&scene->boundary->wall_fields, name);
    assert_non_null(field);
    return (double *const *)field->data;
}

static size_t wall_count(const struct scene *scene)
{
    return *scene->boundary->wall_fields.count;
}

/** Copies of the places of the wall particles. */
static double (*wall_places_copy(const struct scene *scene))[3]
{
    const size_t n = wall_count(scene);
    double(*places)[3] = memory_create(n, sizeof *places);
    for (size_t k = 0; k < n; ++k)
        for (int d = 0; d < 3; ++d)
            places[k][d] = scene->boundary->wall_x[d][k];
    return places;
}

static void map(double m[3][3], const double x[3], const double shift[3], double y[3])
{
    for (int i = 0; i < 3; ++i)
        y[i] = shift[i] + m[i][0] * x[0] + m[i][1] * x[1] + m[i][2] * x[2];
}

static double X_map[3][3] = {{1.13, 0.21, -0.05}, {-0.17, 0.91, 0.08}, {0.06, -0.11, 1.04}};
static double V_map[3][3] = {{0.3, -0.7, 0.2}, {0.45, 0.1, -0.35}, {-0.6, 0.25, 0.15}};
static double A_map[3][3] = {{-1.3, 0.4, 0.9}, {2.1, -0.8, 0.3}, {0.7, 1.7, -0.2}};
static const double X_shift[3] = {0.31, -0.12, 0.07}, V_shift[3] = {-0.9, 0.35, 0.5},
                    A_shift[3] = {1.9, -2.3, 0.6};

/** All points that the mesh moves go by the linear maps; @p part of the displacement. */
static void mesh_move(struct scene *scene, double part)
{
    struct surface *surface = scene->surface;
    for (size_t p = 0; p < surface->n_points; ++p)
        for (int level = 0; level < 2 && surface->mesh[p] >= 0; ++level) {
            struct surface_motion *motion = &surface->level[level];
            double x[3], v[3], a[3];
            map(X_map, surface->X[p], X_shift, x);
            map(V_map, surface->X[p], V_shift, v);
            map(A_map, surface->X[p], A_shift, a);
            for (int d = 0; d < scene->model.dim; ++d) {
                motion->x[p][d] = surface->X[p][d] + part * (x[d] - surface->X[p][d]);
                motion->v[p][d] = v[d];
                motion->a[p][d] = a[d];
            }
        }
}

/** Wall particles fill the mesh on the lattice, as deep as the kernel reaches. */
static void test_filling(void **state)
{
    (void)state;
    for (int type = 0; type < ALL_TYPES; ++type) {
        const int dim = element_dim(all_types[type]);
        struct block_scene b;
        size_t expected = 0, in_hole = 0;
        block_build(&b, all_types[type]);
        for (int k = dim > 2 ? -FLUID_HALF : 0; k < (dim > 2 ? FLUID_HALF : 1); ++k)
            for (int j = -FLUID_HALF; j < FLUID_HALF; ++j)
                for (int i = -FLUID_HALF; i < FLUID_HALF; ++i) {
                    const double x[3] = {i + 0.5, j + 0.5, dim > 2 ? k + 0.5 : 0.0};
                    const double distance = block_distance(dim, x);
                    expected += distance <= 0.02 && distance >= -3.0;
                    in_hole += distance < -3.0;
                }
        assert_true(expected > 50 && in_hole > 0);
        assert_int_equal(wall_count(&b.scene), expected);
        for (size_t k = 0; k < expected; ++k) {
            const double x[3] = {b.scene.boundary->wall_x[0][k], b.scene.boundary->wall_x[1][k],
                                 b.scene.boundary->wall_x[2][k]};
            assert_true(block_distance(dim, x) < 0.0 && block_distance(dim, x) > -3.0);
            for (int d = 0; d < dim; ++d)
                assert_true(fabs(x[d] - floor(x[d]) - 0.5) < 1e-12);
        }
        block_end(&b);
    }
}

/** Without motion the lattice of fluid and wall is whole: density 1, no force. */
static void test_lattice_at_rest(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; ++dim) {
        struct block_scene b;
        block_build(&b, dim == 2 ? ELEMENT_TRI6 : ELEMENT_HEX8);
        const struct scene *s = &b.scene;
        size_t n = 0;
        for (size_t near = 0; near < s->boundary->n_near; ++near) {
            const uint32_t i = s->boundary->near[near];
            const struct particles *p = s->particles;
            double reach = fmax(fabs(p->x[0][i]), fabs(p->x[1][i])), rho = 0.0, g[3] = {0.0, 0.0, 0.0};
            if (fmax(reach, fabs(p->x[2][i])) > FLUID_HALF - 3)
                continue;
            scene_fluid_sums(s, i, &rho, g);
            scene_wall_sums(&b.scene, near, &rho, g);
            assert_true(fabs(rho - 1.0) < 2e-3); /* of the kernel on the lattice */
            assert_true(fabs(g[0]) + fabs(g[1]) + fabs(g[2]) < 1e-11);
            ++n;
        }
        assert_true(n > 20);
        block_end(&b);
    }
}

/** A linear motion of the nodes is that of the particles. */
static void test_patch(void **state)
{
    (void)state;
    for (int type = 0; type < ALL_TYPES; ++type) {
        const int dim = element_dim(all_types[type]);
        struct block_scene b;
        block_build(&b, all_types[type]);
        struct scene *s = &b.scene;
        assert_true(s->boundary->coupled && s->boundary->moving);
        double(*X)[3] = wall_places_copy(s), worst = 0.0;
        mesh_move(s, 1.0);
        assert_int_equal(boundary_prepare(s->boundary, &s->view, false), 0);
        double *const *velocity = wall_field(s, "Velocity");
        for (size_t k = 0; k < wall_count(s); ++k) {
            double x[3], v[3];
            map(X_map, X[k], X_shift, x);
            map(V_map, X[k], V_shift, v);
            for (int d = 0; d < dim; ++d) {
                worst = fmax(worst, fabs(s->boundary->wall_x[d][k] - x[d]));
                worst = fmax(worst, fabs(velocity[d][k] - v[d]));
            }
        }
        assert_true(worst < 1e-13);
        /* the lists are made anew for the moved wall, so that accelerations can be looked at, too */
        scene_list(s);
        assert_int_equal(s->boundary->type->close(s->boundary, &s->view), 0);
        size_t compared = 0;
        for (size_t near = 0; near < s->boundary->n_near; ++near) {
            struct wall_neighbours *w = &s->neighbours;
            assert_int_equal(s->boundary->type->gather(s->boundary, &s->view, near, w), 0);
            for (size_t n = 0; n < w->n; ++n, ++compared) {
                /* which particle it is, its place tells */
                double a[3], x[3], best = INFINITY;
                size_t of = 0;
                for (int d = 0; d < 3; ++d)
                    x[d] = s->particles->x[d][s->boundary->near[near]] - w->dx[d][n];
                for (size_t k = 0; k < wall_count(s); ++k) {
                    double r2 = 0.0;
                    for (int d = 0; d < dim; ++d)
                        r2 += pow(s->boundary->wall_x[d][k] - x[d], 2.0);
                    if (r2 < best) {
                        best = r2;
                        of = k;
                    }
                }
                map(A_map, X[of], A_shift, a);
                for (int d = 0; d < dim; ++d)
                    assert_true(fabs(w->a[d][n] - a[d]) < 1e-12);
            }
            if (compared > 300)
                break;
        }
        assert_true(compared > 300);
        memory_free(X);
        block_end(&b);
    }
}

static void turn(const double x[3], const double f[3], double moment[3])
{
    for (int k = 0; k < 3; ++k)
        moment[k] += x[(k + 1) % 3] * f[(k + 2) % 3] - x[(k + 2) % 3] * f[(k + 1) % 3];
}

/** Force, moment about a point and power of the wall particles are those of the loads. */
static void balance_check(struct scene *s)
{
    static const double centre[3] = {2.3, -1.7, 0.9};
    double total[3], force[3], moment[3], sum[3] = {0.0}, arms[3] = {0.0}, power[2] = {0.0}, size = 0.0;
    mesh_move(s, 0.3);
    scene_list(s);
    scene_fill(s);
    scene_forces(s, total);
    surface_total_load(s->surface, centre, force, moment);
    double *const *reaction = wall_field(s, "ReactionForce"), *const *velocity = wall_field(s, "Velocity");
    for (size_t k = 0; k < wall_count(s); ++k) {
        double x[3], f[3];
        for (int d = 0; d < 3; ++d) {
            x[d] = s->boundary->wall_x[d][k] - centre[d];
            f[d] = reaction[d][k];
            sum[d] += f[d];
            power[0] += f[d] * velocity[d][k];
            size += fabs(f[d]);
        }
        turn(x, f, arms);
    }
    for (size_t p = 0; p < s->surface->n_points; ++p)
        for (int d = 0; d < 3; ++d)
            power[1] += s->surface->load[p][d] * s->surface->now.v[p][d];
    assert_true(size > 10.0);
    for (int d = 0; d < 3; ++d) {
        assert_true(fabs(force[d] + total[d]) < 1e-13 * size);
        assert_true(fabs(force[d] - sum[d]) < 1e-14 * size);
        assert_true(fabs(moment[d] - arms[d]) < 1e-13 * size);
    }
    assert_true(fabs(moment[2]) > 1e-2);
    assert_true(fabs(power[0] - power[1]) < 1e-13 * size && fabs(power[0]) > 1e-2);
}

static void test_balance(void **state)
{
    (void)state;
    for (int type = 0; type < ALL_TYPES; ++type) {
        struct block_scene b;
        block_build(&b, all_types[type]);
        balance_check(&b.scene);
        block_end(&b);
    }
    struct block_scene b;
    block_on_floor(&b);
    balance_check(&b.scene);
    block_end(&b);
}

/** A floor and a block in one surface: what is behind the floor stays where it is, and loads no node. */
static void test_mixed(void **state)
{
    (void)state;
    struct block_scene b;
    block_on_floor(&b);
    struct scene *s = &b.scene;
    double(*X)[3] = wall_places_copy(s), total[3], mesh[3] = {0.0}, nodes[3] = {0.0}, size = 0.0;
    size_t in_mesh = 0, below = 0;
    mesh_move(s, 0.3);
    scene_list(s);
    scene_fill(s);
    scene_forces(s, total);
    double *const *reaction = wall_field(s, "ReactionForce");
    for (size_t k = 0; k < wall_count(s); ++k) {
        const bool inside = block_distance(2, X[k]) < 0.0;
        in_mesh += inside;
        below += !inside;
        assert_true(inside || X[k][1] < block_lower[1]);
        for (int d = 0; d < 3; ++d) {
            if (!inside)
                assert_true(s->boundary->wall_x[d][k] == X[k][d]);
            mesh[d] += inside ? reaction[d][k] : 0.0;
            size += fabs(reaction[d][k]);
        }
    }
    /* three layers behind the floor, also under the block's foot as far as the floor's ends reach */
    assert_true(in_mesh > 40);
    assert_true(below >= 3 * (size_t)(24 - 11) && below <= 3 * 24);
    for (size_t p = 0; p < s->surface->n_points; ++p)
        for (int d = 0; d < 3 && s->surface->mesh[p] >= 0; ++d)
            nodes[d] += s->surface->load[p][d];
    for (int d = 0; d < 3; ++d)
        assert_true(fabs(nodes[d] - mesh[d]) < 1e-13 * size);
    assert_true(fabs(mesh[0]) > 1e-2 && fabs(mesh[1]) > 1e-2);
    memory_free(X);
    block_end(&b);
}

/** Loads change with the nodes' acceleration and velocity as the tensors and dampings say. */
static void test_added_mass(void **state)
{
    (void)state;
    const double per_acceleration = 0.013; /* of the velocity */
    for (int type = 0; type < ALL_TYPES; ++type) {
        struct block_scene b;
        block_build(&b, all_types[type]);
        struct scene *s = &b.scene;
        s->view.sound_speed = 1e5; /* the derivative leaves out the density of the wall particles */
        mesh_move(s, 0.2);
        scene_list(s);
        scene_fill(s);
        const size_t n = s->surface->n_points;
        double(*direction)[3] = memory_create(n, sizeof *direction),
        (*load)[3] = memory_create(n, sizeof *load), (*product)[3] = memory_create(n, sizeof *product),
        total[3];
        uint32_t seed = 3;
        for (size_t i = 0; i < n; ++i)
            for (int k = 0; k < s->model.dim; ++k)
                direction[i][k] = scene_noise(&seed);
        scene_forces(s, total);
        assert_int_equal(s->boundary->type->added_mass(s->boundary, &s->view), 0);
        surface_added_mass_apply(s->surface, (const double(*)[3])direction, per_acceleration, product);
        memcpy(load, s->surface->load, n * sizeof *load);
        for (size_t i = 0; i < n; ++i)
            for (int k = 0; k < s->model.dim; ++k) {
                s->surface->level[1].a[i][k] += direction[i][k];
                s->surface->level[1].v[i][k] += per_acceleration * direction[i][k];
            }
        assert_int_equal(boundary_prepare(s->boundary, &s->view, true), 0);
        scene_forces(s, total);
        double largest = 0.0, off = 0.0, energy = 0.0;
        for (size_t i = 0; i < n; ++i)
            for (int k = 0; k < 3; ++k) {
                largest = fmax(largest, fabs(product[i][k]));
                off = fmax(off, fabs(s->surface->load[i][k] - load[i][k] + product[i][k]));
                energy += direction[i][k] * product[i][k];
            }
        assert_true(largest > 0.05);
        assert_true(off < 1e-7 * largest);
        assert_true(energy > 0.0);
        memory_free(direction);
        memory_free(load);
        memory_free(product);
        block_end(&b);
    }
}

static bool same(const double *a, const double *b, size_t n)
{
    return !memcmp(a, b, n * sizeof *a);
}

/** Iterations, and any number of threads, give the same bytes. */
static void test_again_and_threads(void **state)
{
    (void)state;
    const int before = omp_get_max_threads();
    double *sums[3], *loads[3];
    size_t n_sums = 0, n_loads = 0;
    for (int run = 0; run < 3; ++run) {
        struct block_scene b;
        double total[3];
        omp_set_num_threads(run == 2 ? 2 : 1);
        block_on_floor(&b);
        struct scene *s = &b.scene;
        mesh_move(s, 0.1);
        scene_list(s);
        scene_fill(s);
        mesh_move(s, 0.101);
        assert_int_equal(boundary_prepare(s->boundary, &s->view, run == 1), 0);
        scene_forces(s, total);
        n_sums = s->boundary->n_near;
        n_loads = 3 * s->surface->n_points;
        sums[run] = memory_create(n_sums, sizeof **sums);
        loads[run] = memory_create(n_loads, sizeof **loads);
        memcpy(sums[run], s->boundary->kernel_sum, n_sums * sizeof **sums);
        memcpy(loads[run], s->surface->load, n_loads * sizeof **loads);
        assert_true(s->boundary->drift > 1e-4 && s->boundary->drift < 0.1);
        block_end(&b);
    }
    omp_set_num_threads(before);
    for (int run = 1; run < 3; ++run) {
        assert_true(same(sums[0], sums[run], n_sums));
        assert_true(same(loads[0], loads[run], n_loads));
    }
    for (int run = 0; run < 3; ++run) {
        memory_free(sums[run]);
        memory_free(loads[run]);
    }
}

/** Two surfaces of one mesh in one wall: each particle belongs to the nearer one, every node has its points.
 */
static void test_two_surfaces(void **state)
{
    (void)state;
    struct block_scene b;
    struct model_surface definitions[2];
    struct surface *surfaces[2];
    int indices[2] = {0, 1};
    static const char *const without[2] = {"y-", "y+"};
    struct surface_part parts[2];
    double total[2] = {0.0, 0.0};
    block_start(&b, ELEMENT_QUAD9);
    block_flood(&b, -INFINITY);
    struct scene *s = &b.scene;
    int sets[2];
    memset(definitions, 0, sizeof definitions);
    s->model.surfaces = definitions;
    s->model.n_surfaces = 2;
    for (int k = 0; k < 2; ++k) {
        sets[k] = (int)(mesh_find_set(&b.mesh.mesh, without[k]) - b.mesh.mesh.sets);
        parts[k] = (struct surface_part){.mesh = 0, .n_excluded = 1, .excluded = &sets[k]};
        definitions[k].name = (char *)without[k];
        definitions[k].parts = &parts[k];
        definitions[k].n_parts = 1;
        assert_int_equal(surface_build(&s->model, &definitions[k]), 0);
        assert_int_equal(surface_create(&surfaces[k], &s->model, k, 0.0), 0);
    }
    s->wall.surfaces = indices;
    s->wall.n_surfaces = 2;
    s->model.walls = &s->wall;
    s->model.n_walls = 1;
    s->view.particles = s->particles;
    s->view.grid = &s->grid;
    assert_int_equal(boundary_fixed_particles.check(&s->model, &s->wall), 0);
    assert_int_equal(boundary_create(&s->boundary, &s->model, 0, surfaces, &s->view, wall_types, WALL_TYPES),
                     0);
    scene_list(s);
    scene_fill(s);
    s->surface = surfaces[0];
    double force[3];
    surface_clear_load(surfaces[1]);
    scene_forces(s, force);
    for (int k = 0; k < 2; ++k) {
        assert_true(surfaces[k]->n_points > definitions[k].built.n_points);
        for (size_t p = 0; p < surfaces[k]->n_points; ++p) {
            assert_int_equal(surfaces[k]->mesh[p], 0);
            for (size_t q = 0; q < p; ++q)
                assert_true(surfaces[k]->mesh_node[p] != surfaces[k]->mesh_node[q]);
            total[k] += surfaces[k]->load[p][1];
        }
    }
    assert_true(fabs(total[0]) > 0.1 && fabs(total[1]) > 0.1);
    assert_true(fabs(total[0] + total[1] + force[1]) < 1e-12);
    for (int k = 0; k < 2; ++k)
        surface_build_reset(&definitions[k]);
    surface_destroy(surfaces[1]);
    block_end(&b);
}

static void test_check(void **state)
{
    (void)state;
    struct block_scene b;
    block_build(&b, ELEMENT_QUAD4);
    struct scene *s = &b.scene;
    int (*check)(const struct model *, const struct model_wall *) = boundary_fixed_particles.check;
    struct model_wall walls[2] = {s->wall, s->wall};
    s->model.walls = walls;
    s->model.n_walls = 2;
    walls[1].treatment = (char *)"sliding-particles";
    assert_int_equal(check(&s->model, &walls[0]), STATUS_DECK); /* twice */
    walls[1].n_surfaces = 0;
    assert_int_equal(check(&s->model, &walls[0]), STATUS_OK);
    /* between the layers of a coarse lattice: planes at multiples of 9 and a half */
    s->model.fluid.spacing = 19.0;
    b.region.shape.a[1] = -4.3;
    assert_int_equal(check(&s->model, &walls[0]), STATUS_DECK);
    block_end(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_filling),
        cmocka_unit_test(test_lattice_at_rest),
        cmocka_unit_test(test_patch),
        cmocka_unit_test(test_balance),
        cmocka_unit_test(test_mixed),
        cmocka_unit_test(test_added_mass),
        cmocka_unit_test(test_again_and_threads),
        cmocka_unit_test(test_two_surfaces),
        cmocka_unit_test(test_check),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
