// SPDX-License-Identifier: GPL-3.0-or-later
// Values, forces and loads of sliding boundary particles.
#include "wall_scene.h"

#include "base/error.h"
#include "base/log.h"
#include "wall/sliding_particles.h"

#include <omp.h>

#define PI 3.14159265358979323846

static void lattice(struct scene *scene, double low_x, double low_y, double low_z, int nx, int ny, int nz,
                    double jitter)
{
    uint32_t seed = 7;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                scene_add(scene, low_x + i + 0.5 + jitter * scene_noise(&seed),
                          low_y + j + 0.5 + jitter * scene_noise(&seed),
                          scene->model.dim > 2 ? low_z + k + 0.5 + jitter * scene_noise(&seed) : 0.0);
}

/** A flat wall below y = 0 in facets of @p size. */
static void floor_2d(struct scene *scene, double size)
{
    double points[200][3];
    size_t n = 0;
    for (double x = 30.0; x > -30.0 - 0.5 * size; x -= size)
        memcpy(points[n++], (double[3]){x, 0.0, 0.0}, sizeof points[0]);
    scene_chain(scene, n, (const double(*)[3])points, false);
}

static int same(const double *a, const double *b, size_t n)
{
    return !memcmp(a, b, n * sizeof *a);
}

static void test_flat_is_paper(void **state)
{
    (void)state;
    struct scene scene[2];
    double total[2][3];
    for (int rule = 0; rule < 2; ++rule) {
        scene_start(&scene[rule], 2, -40.0, 40.0, false);
        lattice(&scene[rule], -8.0, 0.0, 0.0, 16, 8, 1, 0.2);
        floor_2d(&scene[rule], 1.7);
        scene_build(&scene[rule], rule ? CORNERS_PAPER : CORNERS_SHARES);
        scene_fill(&scene[rule]);
        scene_forces(&scene[rule], total[rule]);
    }
    // the published rule lists particles a little further away, whose blocks are out of reach
    struct boundary *a = scene[0].boundary, *b = scene[1].boundary;
    size_t compared = 0;
    for (size_t m = 0, n = 0; m < a->n_near; ++m) {
        while (b->near[n] != a->near[m])
            ++n;
        struct wall_neighbours *v = &scene[0].neighbours, *w = &scene[1].neighbours;
        assert_int_equal(a->type->gather(a, &scene[0].view, m, v), 0);
        assert_int_equal(b->type->gather(b, &scene[1].view, n, w), 0);
        assert_int_equal(v->n, w->n);
        assert_true(same(&a->kernel_sum[m], &b->kernel_sum[n], 1));
        assert_true(same(v->p, w->p, v->n) && same(v->rho, w->rho, v->n) && same(v->w, w->w, v->n));
        assert_true(same(v->share_viscous, w->share_viscous, v->n));
        for (int k = 0; k < 3; ++k)
            assert_true(same(v->dx[k], w->dx[k], v->n) && same(v->u_viscous[k], w->u_viscous[k], v->n));
        compared += v->n;
    }
    assert_true(compared > 200);
    assert_true(same(total[0], total[1], 3));
    for (int rule = 0; rule < 2; ++rule)
        scene_end(&scene[rule]);
}

/** A linear pressure in equilibrium and a linear velocity are continued exactly behind a flat wall. */
static void test_linear_fields(void **state)
{
    (void)state;
    struct scene scene;
    scene_start(&scene, 2, -40.0, 40.0, false);
    lattice(&scene, -8.0, 0.0, 0.0, 16, 8, 1, 0.2);
    floor_2d(&scene, 4.3);
    scene.view.body_force[0] = 0.31;
    scene.view.body_force[1] = -0.73;
    scene_build(&scene, CORNERS_SHARES);
    struct particles *p = scene.particles;
    for (size_t i = 0; i < p->n; ++i) {
        p->p[i] = 5.0 + 0.31 * p->x[0][i] - 0.73 * p->x[1][i];
        p->u[0][i] = 1.7 * p->x[1][i];
    }
    assert_int_equal(scene.boundary->type->close(scene.boundary, &scene.view), 0);
    for (size_t near = 0; near < scene.boundary->n_near; ++near) {
        struct wall_neighbours *w = &scene.neighbours;
        uint32_t i = scene.boundary->near[near];
        assert_int_equal(scene.boundary->type->gather(scene.boundary, &scene.view, near, w), 0);
        for (size_t n = 0; n < w->n; ++n) {
            double x = p->x[0][i] - w->dx[0][n], y = p->x[1][i] - w->dx[1][n];
            assert_true(y < 0.0);
            assert_true(fabs(w->p[n] - (5.0 + 0.31 * x - 0.73 * y)) < 1e-12);
            assert_true(fabs(w->rho[n] - (1.0 + w->p[n] / 100.0)) < 1e-14);
            assert_true(fabs(w->volume[n] * w->rho[n] - 1.0) < 1e-14);
            assert_true(fabs(w->u_viscous[0][n] - 1.7 * y) < 1e-11);
            assert_true(w->u[0][n] == 0.0 && w->normal[1][n] == 1.0);
        }
    }
    // without the pressure gradient (figure 8 of the paper) all virtual particles of a contact have the mean
    // pressure
    scene.wall.pressure_gradient = false;
    boundary_destroy(scene.boundary);
    const struct boundary_type *const types[] = {&boundary_sliding_particles};
    assert_int_equal(boundary_create(&scene.boundary, &scene.model, 0, &scene.surface, &scene.view, types, 1),
                     0);
    scene_list(&scene);
    assert_int_equal(scene.boundary->type->close(scene.boundary, &scene.view), 0);
    assert_int_equal(scene.boundary->type->gather(scene.boundary, &scene.view, 0, &scene.neighbours), 0);
    assert_true(scene.neighbours.n > 3);
    for (size_t n = 1; n < scene.neighbours.n; ++n)
        assert_true(scene.neighbours.p[n] == scene.neighbours.p[0]);
    scene_end(&scene);
}

/** A step with a concave and a convex corner, in facets of @p size. */
static void step_2d(struct scene *scene, double size)
{
    static const double corner[4][2] = {{30.0, 3.0}, {0.0, 3.0}, {0.0, 0.0}, {-30.0, 0.0}};
    double points[400][3];
    size_t n = 0;
    for (int c = 0; c < 3; ++c) {
        double dx = corner[c + 1][0] - corner[c][0], dy = corner[c + 1][1] - corner[c][1];
        int parts = (int)ceil((fabs(dx) + fabs(dy)) / size - 1e-9);
        for (int i = 0; i < parts + (c == 2); ++i)
            memcpy(points[n++],
                   (double[3]){corner[c][0] + dx * i / parts, corner[c][1] + dy * i / parts, 0.0},
                   sizeof points[0]);
    }
    scene_chain(scene, n, (const double(*)[3])points, false);
}

static void step_scene(struct scene *scene, double size, enum corners corners)
{
    scene_start(scene, 2, -40.0, 40.0, false);
    uint32_t seed = 3;
    for (int j = 0; j < 10; ++j)
        for (int i = -10; i < 10; ++i)
            if (i < 0 || j >= 3)
                scene_add(scene, i + 0.5 + 0.3 * scene_noise(&seed), j + 0.5 + 0.3 * scene_noise(&seed), 0.0);
    step_2d(scene, size);
    scene_build(scene, corners);
    scene_fill(scene);
}

static void test_conservation(void **state)
{
    (void)state;
    for (int rule = 0; rule < 2; ++rule) {
        struct scene scene;
        double total[3], force[3], moment[3];
        step_scene(&scene, 1.3, rule ? CORNERS_PAPER : CORNERS_SHARES);
        scene_forces(&scene, total);
        surface_total_load(scene.surface, scene_zero, force, moment);
        assert_true(fabs(total[0]) + fabs(total[1]) > 1.0);
        for (int k = 0; k < 3; ++k)
            assert_true(fabs(total[k] + force[k]) < 1e-12);
        scene_end(&scene);
    }
}

static void test_subdivision(void **state)
{
    (void)state;
    static const double sizes[] = {100.0, 2.9, 0.53};
    struct scene scene;
    double total[3][3], sum[3];
    for (int s = 0; s < 3; ++s) {
        step_scene(&scene, sizes[s], CORNERS_SHARES);
        scene_forces(&scene, total[s]);
        sum[s] = 0.0;
        for (size_t near = 0; near < scene.boundary->n_near; ++near)
            sum[s] += scene.boundary->kernel_sum[near] * (1.0 + 0.01 * (double)near);
        scene_end(&scene);
    }
    for (int s = 1; s < 3; ++s) {
        assert_true(fabs(sum[s] - sum[0]) < 1e-10 * sum[0]);
        for (int k = 0; k < 2; ++k)
            assert_true(fabs(total[s][k] - total[0][k]) < 1e-9);
    }
}

static void test_threads(void **state)
{
    (void)state;
    struct scene scene[2];
    const int before = omp_get_max_threads();
    for (int t = 0; t < 2; ++t) {
        double total[3];
        omp_set_num_threads(t ? 2 : 1);
        step_scene(&scene[t], 0.9, CORNERS_SHARES);
        scene_forces(&scene[t], total);
        scene_forces(&scene[t], total); // twice gives the same
    }
    omp_set_num_threads(before);
    assert_int_equal(scene[0].boundary->n_near, scene[1].boundary->n_near);
    assert_true(
        same(scene[0].boundary->kernel_sum, scene[1].boundary->kernel_sum, scene[0].boundary->n_near));
    assert_true(same(scene[0].surface->load[0], scene[1].surface->load[0], 3 * scene[0].surface->n_points));
    scene_end(&scene[0]);
    scene_end(&scene[1]);
}

/** Whether some piece of facet @p f is within reach of @p x, by asking each. */
static bool facet_near(const struct sliding *s, size_t f, const double x[3], double reach)
{
    for (int p = 0; p < s->facets[f].n_pieces; ++p) {
        struct projection projection;
        projection_find(&projection, &s->pieces[s->facets[f].pieces + p], x, 0.0);
        if (projection.distance < reach)
            return true;
    }
    return false;
}

/** Candidates of particle @p i that asking every facet in every image gives: all of those listed of it, and
 * no others. The facets lie @p drift periods from the domain. */
static void candidates_compare(const struct scene *scene, uint32_t i, const struct candidate *listed,
                               size_t n, const int drift[3])
{
    const struct sliding *s = scene->boundary->data;
    size_t k = 0;
    for (size_t f = 0; f < s->n_facets; ++f) {
        size_t images = 0;
        for (int code = 0; code < 27; ++code) {
            const int shift[3] = {code % 3 - 1 - drift[0], code / 3 % 3 - 1 - drift[1],
                                  code / 9 - 1 - drift[2]};
            double at[3];
            for (int d = 0; d < 3; ++d)
                at[d] = scene->particles->x[d][i] - shift[d] * s->period[d];
            if (!facet_near(s, f, at, s->reach + scene->view.skin))
                continue;
            bool found = false;
            for (size_t c = k; c < n && listed[c].item == (int32_t)f; ++c) {
                bool equal = true;
                for (int d = 0; d < 3; ++d)
                    equal &= listed[c].shift[d] + s->facets[f].image[d] == shift[d];
                found |= equal;
            }
            assert_true(found);
            ++images;
        }
        k += images;
    }
    assert_int_equal(k, n);
}

static int messages;

static void count_message(void)
{
    ++messages;
}

static void points_move(struct scene *scene, double scale, const double by[3])
{
    for (size_t p = 0; p < scene->surface->n_points; ++p)
        for (int k = 0; k < 3; ++k)
            scene->surface->now.x[p][k] = scale * scene->surface->now.x[p][k] + by[k];
}

/** The search in tiles, by threads, finds what asking every facet does: a plane quad of many tiles and a
 * warped one, across periodic sides, a sliver, and a small facet; also where they have drifted out of the
 * domain. Facets that are too long are told of once. */
static void test_search(void **state)
{
    (void)state;
    const double points[10][3] = {
        {-7.3, -4.1, 1.2}, {5.9, -4.1, 3.4},   {5.9, 9.6, 3.4},   {-7.3, 9.6, 1.2},   {12.1, -5.2, -2.1},
        {11.3, 10.7, 5.8}, {-7.9, -9.7, -6.0}, {8.8, -9.4, -5.6}, {-3.1, -9.6, -5.1}, {-3.3, -8.8, -6.3}};
    const int32_t nodes[4][4] = {{0, 1, 2, 3}, {1, 4, 5, 2}, {6, 7, 8, -1}, {6, 8, 9, -1}};
    const int before = omp_get_max_threads();
    struct scene scene;
    omp_set_num_threads(3);
    scene_start(&scene, 3, -10.0, 10.0, true);
    lattice(&scene, -10.0, -10.0, -10.0, 20, 20, 20, 0.3);
    scene_facets(&scene, 10, points, 4, nodes);
    scene_build(&scene, CORNERS_SHARES);
    omp_set_num_threads(before);
    const struct sliding *s = scene.boundary->data;
    assert_int_equal(s->facets[0].n_pieces, 1);
    assert_int_equal(s->facets[1].n_pieces, 4);
    scene.boundary->moving = true;
    static const double drifts[3][3] = {{0.0, 0.0, 0.0}, {7.4, -3.0, 1.9}, {-12345.6, 0.3, 0.0}};
    for (int drift = 0; drift < 3; ++drift) {
        double by[3];
        int periods[3];
        for (int k = 0; k < 3; ++k) {
            by[k] = s->period[k] * (drifts[drift][k] - (drift ? drifts[drift - 1][k] : 0.0));
            periods[k] = (int)lround(drifts[drift][k]);
        }
        points_move(&scene, 1.0, by);
        assert_int_equal(scene.boundary->type->list(scene.boundary, &scene.view), 0);
        size_t near = 0, most = 0;
        for (uint32_t i = 0; i < scene.particles->n; ++i) {
            const bool listed = near < scene.boundary->n_near && scene.boundary->near[near] == i;
            const size_t first = listed ? s->candidate_start[near] : 0,
                         n = listed ? s->candidate_start[near + 1] - first : 0;
            candidates_compare(&scene, i, &s->candidates[first], n, periods);
            most = n > most ? n : most;
            near += listed;
        }
        assert_int_equal(near, scene.boundary->n_near);
        assert_true(most > 2);
    }
    points_move(&scene, 5.0, scene_zero);
    messages = 0;
    log_set_hook(count_message);
    assert_int_equal(scene.boundary->type->list(scene.boundary, &scene.view), STATUS_NUMERICAL);
    log_set_hook(NULL);
    assert_int_equal(messages, 1); // by whatever number of threads
    scene_end(&scene);
}

/** A circle as an analytic surface and as a polygon of 192 sides. */
static void test_circle(void **state)
{
    (void)state;
    struct scene scene[2];
    const double radius = 10.0;
    for (int polygon = 0; polygon < 2; ++polygon) {
        struct scene *s = &scene[polygon];
        scene_start(s, 2, -20.0, 20.0, false);
        for (int j = -10; j < 10; ++j)
            for (int i = -10; i < 10; ++i)
                if (hypot(i + 0.5, j + 0.5) < radius - 0.3)
                    scene_add(s, i + 0.5, j + 0.5, 0.0);
        if (polygon) {
            double points[192][3];
            for (int k = 0; k < 192; ++k) { // clockwise: the solid, outside, lies to the left
                double angle = -2.0 * PI * k / 192.0, r = radius / cos(PI / 192.0);
                memcpy(points[k], (double[3]){r * cos(angle), r * sin(angle), 0.0}, sizeof points[k]);
            }
            scene_chain(s, 192, (const double(*)[3])points, true);
        } else {
            s->surface_definition.kind = SURFACE_CYLINDER;
            s->surface_definition.radius = radius;
            s->surface_definition.fluid_inside = true;
        }
        scene_build(s, CORNERS_SHARES);
    }
    // the analytic circle carries one flat block; the polygon the curved wall: they differ by the curvature,
    // dx / (8 R)
    double worst = 0.0;
    size_t m = 0;
    for (size_t n = 0; n < scene[0].boundary->n_near; ++n) {
        while (scene[1].boundary->near[m] != scene[0].boundary->near[n])
            ++m;
        worst = fmax(worst, fabs(scene[0].boundary->kernel_sum[n] - scene[1].boundary->kernel_sum[m]));
    }
    print_message("circle: %g\n", worst);
    assert_true(worst > 1e-4 && worst < 0.03);
    scene_end(&scene[0]);
    scene_end(&scene[1]);
}

/** A rotating circle: velocity and acceleration at the contact, force and moment. */
static void test_rotating_circle(void **state)
{
    (void)state;
    struct scene scene;
    double total[3], force[3], moment[3];
    scene_start(&scene, 2, -20.0, 20.0, false);
    lattice(&scene, -3.0, 5.3, 0.0, 6, 4, 1, 0.0);
    struct model_surface *definition = &scene.surface_definition;
    definition->kind = SURFACE_CYLINDER;
    definition->radius = 5.0;
    definition->motion.kind = MOTION_RIGID;
    definition->motion.axis[2] = 1.0;
    definition->motion.angular_velocity = expression_constant(-0.7);
    scene_build(&scene, CORNERS_SHARES);
    assert_true(scene.boundary->moving);
    scene_fill(&scene);
    scene_forces(&scene, total);
    for (size_t near = 0; near < scene.boundary->n_near; ++near) {
        struct wall_neighbours *w = &scene.neighbours;
        assert_int_equal(scene.boundary->type->gather(scene.boundary, &scene.view, near, w), 0);
        uint32_t i = scene.boundary->near[near];
        double x = scene.particles->x[0][i], y = scene.particles->x[1][i], r = hypot(x, y);
        assert_true(fabs(w->u[0][0] - 0.7 * 5.0 * y / r) < 1e-13 &&
                    fabs(w->u[1][0] + 0.7 * 5.0 * x / r) < 1e-13);
        assert_true(fabs(w->a[0][0] + 0.49 * 5.0 * x / r) < 1e-13);
        assert_true(fabs(w->normal[0][0] - x / r) < 1e-13);
    }
    surface_total_load(scene.surface, scene_zero, force, moment);
    for (int k = 0; k < 2; ++k)
        assert_true(fabs(force[k] + total[k]) < 1e-12);
    assert_true(fabs(moment[2]) > 1e-3);
    motion_reset(&definition->motion);
    scene_end(&scene);
}

/** A body that has drifted out of a periodic domain acts as one that has stayed: forces on the fluid, force
 * and moment on the body. */
static void test_drifted(void **state)
{
    (void)state;
    static const double place[2] = {1.3, -0.7}, drift[2] = {7.0 * 16.0, -301.0 * 16.0};
    for (int polygon = 0; polygon < 2; ++polygon) {
        double total[2][3], force[2][3], moment[2][3];
        for (int drifted = 0; drifted < 2; ++drifted) {
            struct scene scene;
            double centre[3] = {0.0, 0.0, 0.0};
            for (int k = 0; k < 2; ++k)
                centre[k] = place[k] + drifted * drift[k];
            scene_start(&scene, 2, -8.0, 8.0, true);
            for (int j = -8; j < 8; ++j)
                for (int i = -8; i < 8; ++i)
                    if (hypot(i + 0.5 - place[0], j + 0.5 - place[1]) > 6.4)
                        scene_add(&scene, i + 0.5, j + 0.5, 0.0);
            struct model_surface *definition = &scene.surface_definition;
            if (polygon) { // counter-clockwise: the solid lies within
                double points[12][3];
                for (int k = 0; k < 12; ++k)
                    memcpy(points[k],
                           (double[3]){centre[0] + 6.0 * cos(PI * k / 6.0),
                                       centre[1] + 6.0 * sin(PI * k / 6.0), 0.0},
                           sizeof points[k]);
                scene_chain(&scene, 12, (const double(*)[3])points, true);
            } else {
                definition->kind = SURFACE_CYLINDER;
                definition->radius = 6.0;
                memcpy(definition->centre, centre, sizeof centre);
            }
            scene_build(&scene, CORNERS_SHARES);
            scene_fill(&scene);
            scene_forces(&scene, total[drifted]);
            surface_total_load(scene.surface, centre, force[drifted], moment[drifted]);
            assert_true(scene.boundary->n_near > 40);
            scene_end(&scene);
        }
        for (int k = 0; k < 3; ++k) {
            assert_float_equal(total[1][k], total[0][k], 1e-10);
            assert_float_equal(force[1][k], force[0][k], 1e-10);
            assert_float_equal(moment[1][k], moment[0][k], 1e-8);
        }
        assert_true(fabs(total[0][0]) > 0.01 && fabs(moment[0][2]) > 0.01);
    }
}

/** A closed cube with the fluid inside. */
static void box_3d(struct scene *scene, double half, double warp)
{
    double points[8][3];
    static const int32_t nodes[6][4] = {{1, 3, 2, 0}, {6, 7, 5, 4}, {4, 5, 1, 0},
                                        {3, 7, 6, 2}, {2, 6, 4, 0}, {5, 7, 3, 1}};
    for (int c = 0; c < 8; ++c)
        for (int k = 0; k < 3; ++k)
            points[c][k] = (c >> k & 1 ? half : -half) * (c == 5 ? 1.0 + warp : 1.0);
    scene_facets(scene, 8, (const double(*)[3])points, 6, nodes);
}

/** What boundary_load adds to the reactions: force and moment of surface 0 about @p centre. */
static void turning_load(struct scene *scene, const double centre[3], double force[3], double moment[3])
{
    double reaction[3], turning[3], total[3];
    scene_forces(scene, total);
    surface_total_load(scene->surface, centre, reaction, turning);
    surface_clear_load(scene->surface);
    boundary_load(scene->boundary, &scene->view);
    surface_total_load(scene->surface, centre, force, moment);
    for (int k = 0; k < 3; ++k) {
        force[k] -= reaction[k];
        moment[k] -= turning[k];
    }
}

/** The viscous stress that pair forces leave out resists turning by 2 eta volume x angular velocity, about
 * any centre, and adds up to no force; a surface that goes straight on has none. */
static void test_turning(void **state)
{
    (void)state;
    static const double centre[3] = {0.7, -1.1, 0.4}, axis[3] = {2.0 / 7.0, 3.0 / 7.0, -6.0 / 7.0};
    for (int shape = 0; shape < 6; ++shape) {
        struct scene scene;
        double force[3], moment[3], volume;
        scene_start(&scene, shape < 2 ? 2 : 3, -20.0, 20.0, shape == 4);
        scene_add(&scene, 0.3, 5.3, 0.2);
        scene_add(&scene, -0.4, -5.4, 0.1);
        struct motion *motion = &scene.surface_definition.motion;
        motion->kind = MOTION_RIGID;
        memcpy(motion->axis, axis, sizeof axis);
        if (shape < 2 || shape >= 4)
            memcpy(motion->axis, (double[3]){0.0, 0.0, 1.0}, sizeof axis);
        motion->centre[0] = 0.3;
        motion->angular_velocity = expression_constant(-0.7);
        motion->velocity[1] = expression_constant(0.9);
        if (shape == 0 || shape == 2) {
            scene.surface_definition.kind = shape ? SURFACE_SPHERE : SURFACE_CYLINDER;
            scene.surface_definition.radius = 5.0;
            volume = shape ? 4.0 / 3.0 * PI * 125.0 : 25.0 * PI;
        } else if (shape == 1) { // counter-clockwise: the solid lies within
            scene_chain(&scene, 4,
                        (const double[4][3]){{-3.0, -5.0, 0}, {4.0, -5.0, 0}, {4.0, 5.0, 0}, {-2.0, 5.0, 0}},
                        true);
            volume = 65.0;
        } else if (shape >= 4) { // with a period of 40 along its axis, and without
            scene.surface_definition.kind = SURFACE_CYLINDER;
            scene.surface_definition.radius = 5.0;
            memcpy(scene.surface_definition.axis, (double[3]){0.0, 0.0, -2.0}, sizeof axis);
            volume = shape == 4 ? 25.0 * PI * 40.0 : 0.0;
        } else { // the fluid is within: the normal, and with it the sign, is turned round
            box_3d(&scene, 6.0, 0.0);
            volume = -12.0 * 12.0 * 12.0;
        }
        scene_build(&scene, CORNERS_SHARES);
        scene_fill(&scene);
        turning_load(&scene, centre, force, moment);
        for (int k = 0; k < 3; ++k) {
            assert_true(fabs(force[k]) < 1e-12);
            assert_true(fabs(moment[k] + 2.0 * 0.1 * volume * -0.7 * motion->axis[k]) < 1e-9);
        }
        motion_reset(motion);
        scene_end(&scene);
    }
}

/** One quad per plate and periodic sides: every particle of a layer sees the same wall. */
static void test_periodic_plate(void **state)
{
    (void)state;
    static const double points[4][3] = {
        {-5.0, -5.0, -3.0}, {5.0, -5.0, -3.0}, {5.0, 5.0, -3.0}, {-5.0, 5.0, -3.0}};
    static const int32_t nodes[1][4] = {{0, 1, 2, 3}};
    struct facet_shares shares;
    assert_int_equal(facet_shares_create(&shares, kernel_quintic(3, 1.0, false), 1.0, isa_best()), 0);
    for (int rule = 0; rule < 2; ++rule) {
        struct scene scene;
        scene_start(&scene, 3, -5.0, 5.0, true);
        lattice(&scene, -5.0, -5.0, -3.0, 10, 10, 4, 0.0);
        scene_facets(&scene, 4, points, 1, nodes);
        scene_build(&scene, rule ? CORNERS_PAPER : CORNERS_SHARES);
        size_t n[2] = {0, 0};
        for (size_t near = 0; near < scene.boundary->n_near; ++near) {
            double height = scene.particles->x[2][scene.boundary->near[near]] + 3.0;
            if (height > 2.0 || height < 0.0)
                continue;
            int layer = (int)height;
            double sums[SHARES];
            facet_shares_block(&shares, height, sums);
            // whole blocks are tabulated by layers; the published rule sums them
            assert_true(fabs(scene.boundary->kernel_sum[near] - sums[SHARE_DENSITY]) < (rule ? 1e-12 : 1e-9));
            ++n[layer];
        }
        assert_int_equal(n[0], 100);
        assert_int_equal(n[1], 100);
        scene_end(&scene);
    }
    facet_shares_reset(&shares);
}

/** Loads change with the surface's acceleration as the tensors say. */
static void test_added_mass(void **state)
{
    (void)state;
    struct scene scene;
    struct model_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    scene_start(&scene, 2, -40.0, 40.0, false);
    scene.view.sound_speed = 1e5; // the derivative leaves out the density of the virtual particles
    uint32_t seed = 3;
    for (int j = 0; j < 10; ++j)
        for (int i = -10; i < 10; ++i)
            if (i < 0 || j >= 3)
                scene_add(&scene, i + 0.5 + 0.3 * scene_noise(&seed), j + 0.5 + 0.3 * scene_noise(&seed),
                          0.0);
    step_2d(&scene, 2.3);
    for (size_t i = 0; i < scene.surface_definition.built.n_points; ++i)
        scene.surface_definition.built_mesh[i] = 0;
    scene.model.meshes = &mesh;
    scene.model.n_meshes = 1;
    scene_build(&scene, CORNERS_SHARES);
    assert_true(scene.boundary->coupled);
    scene_fill(&scene);
    const size_t n = scene.surface->n_points;
    double(*direction)[3] = memory_create(n, sizeof *direction), (*load)[3] = memory_create(n, sizeof *load),
    (*product)[3] = memory_create(n, sizeof *product), total[3];
    for (size_t i = 0; i < n; ++i)
        for (int k = 0; k < 2; ++k)
            direction[i][k] = scene_noise(&seed);
    scene_forces(&scene, total);
    assert_int_equal(scene.boundary->type->added_mass(scene.boundary, &scene.view), 0);
    surface_added_mass_apply(scene.surface, (const double(*)[3])direction, 0.0, product);
    memcpy(load, scene.surface->load, n * sizeof *load);
    memcpy(scene.surface->level[1].a, direction, n * sizeof *direction);
    memcpy(scene.surface->level[0].a, direction, n * sizeof *direction);
    assert_int_equal(boundary_prepare(scene.boundary, &scene.view, false), 0);
    scene_forces(&scene, total);
    double largest = 0.0, off = 0.0, energy = 0.0;
    for (size_t i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) {
            largest = fmax(largest, fabs(product[i][k]));
            off = fmax(off, fabs(scene.surface->load[i][k] - load[i][k] + product[i][k]));
            energy += direction[i][k] * product[i][k];
        }
    assert_true(largest > 0.1);
    assert_true(off < 1e-7 * largest);
    assert_true(energy > 0.0);
    memory_free(direction);
    memory_free(load);
    memory_free(product);
    scene_end(&scene);
}

static void test_put_back(void **state)
{
    (void)state;
    struct scene scene;
    scene_start(&scene, 3, -20.0, 20.0, false);
    scene_add(&scene, 0.7, -5.04, 1.3);  // behind the side y = -5
    scene_add(&scene, 4.93, 4.96, -5.1); // beside an edge region, behind z = -5
    scene_add(&scene, 4.9, 4.9, 4.9);    // in the fluid, in a corner
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            scene.particles->u[k][i] = i == 1 ? 0.4 : -0.3 + 0.05 * k;
    box_3d(&scene, 5.0, 0.0);
    scene_build(&scene, CORNERS_SHARES);
    // until it is put back, a penetrated particle sees the wall as if it were on it
    for (size_t near = 0; near < 3; ++near)
        assert_true(scene.boundary->kernel_sum[near] > 0.3 && scene.boundary->kernel_sum[near] < 1.0);
    double before[3] = {0.0, 0.0, 0.0}, change[3] = {0.0, 0.0, 0.0}, force[3], moment[3];
    struct particles *p = scene.particles;
    for (size_t i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            before[k] += p->u[k][i];
    assert_int_equal(scene.boundary->type->put_back(scene.boundary, &scene.view, p), 0);
    assert_int_equal(scene.boundary->put_back_count, 2);
    for (size_t i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k)
            change[k] += p->u[k][i];
        if (fabs(p->x[0][i] - 0.7) < 1e-12) {
            assert_true(fabs(p->x[1][i] + 4.9) < 1e-12 && fabs(p->x[2][i] - 1.3) < 1e-12);
            assert_true(fabs(p->u[1][i]) < 1e-15 && fabs(p->u[0][i] + 0.3) < 1e-15);
        } else if (p->x[2][i] < 0.0) {
            assert_true(fabs(p->x[2][i] + 4.9) < 1e-12);
            assert_true(p->u[2][i] == 0.4); // it was leaving already
        }
    }
    surface_clear_load(scene.surface);
    scene.boundary->type->load(scene.boundary, &scene.view);
    surface_total_load(scene.surface, scene_zero, force, moment);
    assert_true(change[1] - before[1] > 0.2);
    for (int k = 0; k < 3; ++k)
        assert_true(fabs(force[k] * scene.view.dt + change[k] - before[k]) < 1e-14);
    assert_int_equal(boundary_prepare(scene.boundary, &scene.view, false), 0);
    scene_end(&scene);
}

/** The same in 2-D: behind a side and behind a corner of a channel's step. */
static void test_put_back_2d(void **state)
{
    (void)state;
    static const double points[][3] = {
        {30.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, -3.0, 0.0}, {-30.0, -3.0, 0.0}};
    struct scene scene;
    scene_start(&scene, 2, -40.0, 40.0, false);
    scene_add(&scene, 5.3, -0.07, 0.0);
    scene_add(&scene, 1.97, 0.4, 0.0); // in the fluid over the corner
    scene_add(&scene, 2.02, -0.01, 0.0);
    for (int i = 0; i < 3; ++i) {
        scene.particles->u[0][i] = 0.45;
        scene.particles->u[1][i] = -0.3;
    }
    scene_chain(&scene, 4, points, false);
    scene_build(&scene, CORNERS_SHARES);
    struct particles *p = scene.particles;
    assert_int_equal(scene.boundary->type->put_back(scene.boundary, &scene.view, p), 0);
    assert_int_equal(scene.boundary->put_back_count, 2);
    for (size_t i = 0; i < 3; ++i) {
        const bool side = p->x[0][i] > 5.0, free = p->x[1][i] > 0.3;
        assert_true(fabs(p->x[0][i] - (side ? 5.3 : free ? 1.97 : 2.02)) < 1e-12);
        assert_true(fabs(p->x[1][i] - (free ? 0.4 : 0.1)) < 1e-12);
        assert_true(p->u[0][i] == 0.45 && p->u[1][i] == (free ? -0.3 : 0.0));
    }
    double force[3], moment[3];
    surface_clear_load(scene.surface);
    scene.boundary->type->load(scene.boundary, &scene.view);
    surface_total_load(scene.surface, scene_zero, force, moment);
    assert_true(fabs(force[0]) < 1e-14 && fabs(force[1] * scene.view.dt + 0.6 * scene.view.mass) < 1e-14);
    scene_end(&scene);
}

/** Beyond an edge, in the plane of one side of it and nearest to it: the other side, in quads that are not
 * quite plane and so end beside the edge, tells that this is the fluid, even where it is just out of reach.
 */
static void test_beyond_edge(void **state)
{
    (void)state;
    enum { ROWS = 10 };
    static const double height[3] = {0.0, 2.044, 4.05},
                        bend[2][3] = {{0.0, 0.007, -0.07}, {0.0, 0.031, -0.07}};
    double points[4 * ROWS][3];
    int32_t nodes[3 * (ROWS - 1)][4];
    for (int r = 0; r < ROWS; ++r) {
        const double z = 2.0 * r - ROWS + 1.0;
        memcpy(points[4 * r], (double[3]){-8.0, 0.0, z}, sizeof points[0]);
        for (int k = 0; k < 3; ++k)
            memcpy(points[4 * r + 1 + k], (double[3]){bend[r % 2][k], height[k], z}, sizeof points[0]);
        for (int k = 0; k < 3 && r > 0; ++k)
            memcpy(nodes[3 * (r - 1) + k],
                   (int32_t[4]){4 * r - 4 + k, 4 * r - 3 + k, 4 * r + 1 + k, 4 * r + k}, sizeof nodes[0]);
    }
    for (int place = 0; place < 8 * 16; ++place) { /* up to where the walls end to act */
        struct scene scene;
        scene_start(&scene, 3, -20.0, 20.0, false);
        const double x = place < 8 ? 1.949 : 2.44 + 0.0007 * place, y = place % 8 < 4 ? 0.002 : -0.002,
                     z = -0.9 + 0.5 * (place % 4);
        scene_add(&scene, x, y, z);
        scene_facets(&scene, 4 * ROWS, (const double(*)[3])points, 3 * (ROWS - 1),
                     (const int32_t(*)[4])nodes);
        scene_build(&scene, CORNERS_SHARES);
        assert_true(fabs(scene.boundary->kernel_sum[0]) < 0.02);
        assert_true(x > 2.0 || scene.boundary->kernel_sum[0] > 0.0);
        assert_int_equal(scene.boundary->type->put_back(scene.boundary, &scene.view, scene.particles), 0);
        assert_int_equal(scene.boundary->put_back_count, 0);
        scene_end(&scene);
    }
}

/** A warped quad is cut into four; weights still add up and loads still balance. */
static void test_warped(void **state)
{
    (void)state;
    struct scene scene[2];
    for (int warped = 0; warped < 2; ++warped) {
        double total[3], force[3], moment[3];
        scene_start(&scene[warped], 3, -20.0, 20.0, false);
        lattice(&scene[warped], -5.0, -5.0, -5.0, 10, 10, 10, 0.2);
        box_3d(&scene[warped], 5.0, warped ? 0.012 : 0.0);
        scene_build(&scene[warped], CORNERS_SHARES);
        scene_fill(&scene[warped]);
        scene_forces(&scene[warped], total);
        surface_total_load(scene[warped].surface, scene_zero, force, moment);
        for (int k = 0; k < 3; ++k)
            assert_true(fabs(force[k] + total[k]) < 1e-11);
    }
    struct boundary *a = scene[0].boundary, *b = scene[1].boundary;
    double worst = 0.0;
    for (size_t m = 0, n = 0; m < a->n_near; ++m) {
        for (n = 0; n < b->n_near && b->near[n] != a->near[m]; ++n)
            ;
        if (n < b->n_near)
            worst = fmax(worst, fabs(a->kernel_sum[m] - b->kernel_sum[n]));
    }
    assert_true(worst > 1e-4 && worst < 0.1);
    scene_end(&scene[0]);
    scene_end(&scene[1]);
}

/** Sums over the wall neighbours of a near particle that are linear in their values. */
static void linear_sums(const struct wall_neighbours *w, double sums[8])
{
    memset(sums, 0, 8 * sizeof *sums);
    for (size_t n = 0; n < w->n; ++n) {
        sums[0] += w->share_density[n] * w->w[n];
        sums[1] += w->share_viscous[n] * w->dw[n] / w->r[n];
        for (int k = 0; k < 3; ++k) {
            sums[2 + k] += w->share_pressure[n] * w->dw[n] / w->r[n] * w->dx[k][n] * w->p[n];
            sums[5 + k] += w->share_viscous[n] * w->dw[n] / w->r[n] * w->u_viscous[k][n];
        }
    }
}

/** Force of eq. 40 on near particle @p near. */
static void force_on(const struct scene *scene, size_t near, const struct wall_neighbours *w, double force[3])
{
    const struct particles *p = scene->particles;
    const uint32_t i = scene->boundary->near[near];
    const double volume = p->m[i] / p->rho[i];
    force[0] = force[1] = force[2] = 0.0;
    for (size_t n = 0; n < w->n; ++n) {
        double mean = (w->rho[n] * p->p[i] + p->rho[i] * w->p[n]) / (w->rho[n] + p->rho[i]);
        double v2 = volume * volume + w->volume[n] * w->volume[n];
        for (int k = 0; k < 3; ++k)
            force[k] += v2 * w->dw[n] / w->r[n] *
                        (-w->share_pressure[n] * mean * w->dx[k][n] +
                         w->share_viscous[n] * scene->view.viscosity * (p->u[k][i] - w->u_viscous[k][n]));
    }
}

/** In 3-D a few neighbours stand for each block: linear sums are the block's, forces differ by the square of
 * how much the pressure varies along the wall. */
static void test_layers_are_blocks(void **state)
{
    (void)state;
    struct scene scene;
    struct wall_neighbours block = {0}, *layers = &scene.neighbours;
    double worst[2] = {0.0, 0.0}, linear = 0.0, largest = 0.0;
    size_t n_layers = 0, n_block = 0;
    scene_start(&scene, 3, -20.0, 20.0, false);
    lattice(&scene, -5.0, -5.0, -5.0, 10, 10, 10, 0.2);
    box_3d(&scene, 5.0, 0.0);
    scene_build(&scene, CORNERS_SHARES);
    for (int half = 0; half < 2; ++half) {
        scene_fill(&scene);
        for (size_t i = 0; half && i < scene.particles->n; ++i)
            scene.particles->p[i] *= 0.5;
        for (int k = 0; half && k < 3; ++k)
            scene.view.body_force[k] *= 0.5;
        assert_int_equal(scene.boundary->type->close(scene.boundary, &scene.view), 0);
        for (size_t near = 0; near < scene.boundary->n_near; ++near) {
            double a[8], b[8], f[3], g[3];
            assert_int_equal(scene.boundary->type->gather(scene.boundary, &scene.view, near, layers), 0);
            assert_int_equal(scene.boundary->type->unfold(scene.boundary, &scene.view, near, &block), 0);
            n_layers += layers->n;
            n_block += block.n;
            linear_sums(layers, a);
            linear_sums(&block, b);
            force_on(&scene, near, layers, f);
            force_on(&scene, near, &block, g);
            for (int k = 0; k < 8; ++k) {
                linear = fmax(linear, fabs(a[k] - b[k]));
                largest = fmax(largest, fabs(b[k]));
            }
            for (int k = 0; k < 3; ++k)
                worst[half] = fmax(worst[half], fabs(f[k] - g[k]));
        }
    }
    print_message("layers: %zu for %zu, linear %g of %g, forces %g and %g\n", n_layers, n_block, linear,
                  largest, worst[0], worst[1]);
    assert_true(2 * n_layers < n_block);
    assert_true(linear < 1e-6 * largest);
    assert_true(worst[0] < 5e-3 * largest && worst[1] < 0.3 * worst[0] && worst[1] > 0.2 * worst[0]);
    wall_neighbours_reset(&block);
    scene_end(&scene);
}

/** Within a step contacts follow the surface: the same bytes if it did not move, and a small motion changes
 * distances at once and weights not. */
static void test_again(void **state)
{
    (void)state;
    static const double motion[] = {0.0, 1e-3};
    for (int dim = 2; dim <= 3; ++dim)
        for (int m = 0; m < 2; ++m) {
            struct scene scene;
            struct model_mesh mesh;
            memset(&mesh, 0, sizeof mesh);
            if (dim == 2) {
                scene_start(&scene, 2, -40.0, 40.0, false);
                lattice(&scene, -5.0, 3.0, 0.0, 10, 6, 1, 0.3);
                step_2d(&scene, 1.3);
            } else {
                scene_start(&scene, 3, -20.0, 20.0, false);
                lattice(&scene, -5.0, -5.0, -5.0, 10, 10, 10, 0.3);
                box_3d(&scene, 5.0, 0.0);
            }
            for (size_t i = 0; i < scene.surface_definition.built.n_points; ++i)
                scene.surface_definition.built_mesh[i] = 0;
            scene.model.meshes = &mesh;
            scene.model.n_meshes = 1;
            scene_build(&scene, CORNERS_SHARES);
            const size_t n = scene.boundary->n_near;
            double *sums[3];
            for (int k = 0; k < 3; ++k)
                sums[k] = memory_create(n, sizeof **sums);
            memcpy(sums[0], scene.boundary->kernel_sum, n * sizeof **sums);
            for (size_t i = 0; i < scene.surface->n_points; ++i)
                for (int k = 0; k < dim; ++k)
                    scene.surface->level[1].x[i][k] += motion[m] * (k == 1 ? -1.0 : 0.4);
            for (int again = 1; again >= 0; --again) {
                assert_int_equal(boundary_prepare(scene.boundary, &scene.view, again), 0);
                memcpy(sums[1 + again], scene.boundary->kernel_sum, n * sizeof **sums);
            }
            double moved = 0.0, off = 0.0;
            for (size_t k = 0; k < n; ++k) {
                moved = fmax(moved, fabs(sums[1][k] - sums[0][k]));
                off = fmax(off, fabs(sums[2][k] - sums[1][k]));
            }
            print_message("again in %d-D: off %g, moved %g\n", dim, off, moved);
            if (m == 0)
                assert_true(same(sums[0], sums[2], n));
            else
                assert_true(moved > 1e-4 && off < moved && off > 0.0);
            for (int k = 0; k < 3; ++k)
                memory_free(sums[k]);
            scene_end(&scene);
        }
}

/** Planes in 1-D: the wall completes the kernel sum. */
static void test_one_dimension(void **state)
{
    (void)state;
    struct scene scene;
    scene_start(&scene, 1, -20.0, 20.0, false);
    for (int i = 0; i < 9; ++i)
        scene_add(&scene, i + 0.5, 0.0, 0.0);
    scene.surface_definition.kind = SURFACE_PLANE;
    scene.surface_definition.axis[0] = 2.0;
    scene_build(&scene, CORNERS_SHARES);
    assert_int_equal(scene.boundary->n_near, 3);
    for (size_t near = 0; near < 3; ++near) {
        double rho = 0.0, g[3] = {0.0, 0.0, 0.0};
        scene_fluid_sums(&scene, scene.boundary->near[near], &rho, g);
        scene_wall_sums(&scene, near, &rho, g);
        assert_true(fabs(rho - 1.0) < 1e-12 && fabs(g[0]) < 1e-12);
    }
    scene_end(&scene);
}

static void test_check(void **state)
{
    (void)state;
    struct model model;
    struct model_surface surface;
    struct model_wall walls[2];
    int index = 0;
    int (*check)(const struct model *, const struct model_wall *) = boundary_sliding_particles.check;
    memset(&model, 0, sizeof model);
    memset(&surface, 0, sizeof surface);
    memset(walls, 0, sizeof walls);
    model.path = (char *)"deck.xml";
    model.surfaces = &surface;
    model.walls = walls;
    model.n_walls = 1;
    model.dim = 2;
    surface.name = (char *)"s";
    surface.kind = SURFACE_PLANE;
    surface.axis[1] = 1.0;
    walls[0].name = (char *)"w";
    walls[1].name = (char *)"v";
    walls[0].surfaces = walls[1].surfaces = &index;
    walls[1].n_surfaces = 1;
    assert_int_equal(check(&model, &walls[0]), STATUS_DECK); // no surface
    walls[0].n_surfaces = 1;
    assert_int_equal(check(&model, &walls[0]), STATUS_OK);
    walls[0].has_region = true;
    assert_int_equal(check(&model, &walls[0]), STATUS_DECK);
    walls[0].has_region = false;
    surface.motion.kind = MOTION_FIELD;
    assert_int_equal(check(&model, &walls[0]), STATUS_DECK);
    surface.motion.kind = MOTION_RIGID;
    surface.motion.axis[2] = 1.0;
    assert_int_equal(check(&model, &walls[0]), STATUS_OK);
    char message[256];
    const struct expression_scope scope = {0};
    assert_int_equal(expression_create(&surface.motion.angle, "0.3*t", &scope, message, sizeof message), 0);
    assert_int_equal(check(&model, &walls[0]), STATUS_DECK); // tilts
    surface.kind = SURFACE_CYLINDER;
    assert_int_equal(check(&model, &walls[0]), STATUS_OK);
    motion_reset(&surface.motion);
    model.dim = 1;
    assert_int_equal(check(&model, &walls[0]), STATUS_DECK);
    model.dim = 2;
    model.n_walls = 2;
    assert_int_equal(check(&model, &walls[0]), STATUS_DECK); // shared
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flat_is_paper),
        cmocka_unit_test(test_linear_fields),
        cmocka_unit_test(test_conservation),
        cmocka_unit_test(test_subdivision),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_search),
        cmocka_unit_test(test_circle),
        cmocka_unit_test(test_rotating_circle),
        cmocka_unit_test(test_drifted),
        cmocka_unit_test(test_turning),
        cmocka_unit_test(test_periodic_plate),
        cmocka_unit_test(test_added_mass),
        cmocka_unit_test(test_put_back),
        cmocka_unit_test(test_put_back_2d),
        cmocka_unit_test(test_beyond_edge),
        cmocka_unit_test(test_warped),
        cmocka_unit_test(test_layers_are_blocks),
        cmocka_unit_test(test_again),
        cmocka_unit_test(test_one_dimension),
        cmocka_unit_test(test_check),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
