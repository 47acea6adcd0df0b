// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TESTS_SOLID_BENCH_H
#define TESTS_SOLID_BENCH_H

#include "base/error.h"
#include "base/memory.h"
#include "solid/solid.h"

#include <math.h>
#include <string.h>

/** A model with one mesh, built by hand. Include after cmocka.h. */
struct bench {
    struct model model;
    struct model_mesh mesh;
    struct solid_material material;
    struct model_support supports[6];
    struct model_load loads[4];
    struct solid *solid;
    double t;
};

static inline struct expression *bench_expression(const char *text)
{
    struct expression *expression;
    const struct expression_scope scope = {0};
    char message[256];
    assert_int_equal(expression_create(&expression, text, &scope, message, sizeof message), 0);
    return expression;
}

static inline void bench_grid(struct bench *bench, int dim, const double *upper, const int *cells)
{
    const double lower[3] = {0, 0, 0};
    memset(bench, 0, sizeof *bench);
    assert_int_equal(mesh_create_grid(&bench->mesh.mesh, dim, lower, upper, cells), 0);
    bench->model.path = "bench.xml";
    bench->model.dim = dim;
    bench->model.n_meshes = 1;
    bench->model.meshes = &bench->mesh;
    bench->model.n_solid_materials = 1;
    bench->model.solid_materials = &bench->material;
    bench->material = (struct solid_material){
        .name = "rubber", .law = "saint-venant-kirchhoff", .density = 1100, .young = 1400, .poisson = 0.4};
    bench->mesh.name = "body";
    bench->mesh.where = (struct location){12, 5};
    bench->mesh.formulation = SOLID_EAS;
    bench->mesh.rho_infinity = 0.8;
    bench->mesh.newton_tolerance = 1e-10;
    bench->mesh.supports = bench->supports;
    bench->mesh.loads = bench->loads;
}

/** Other elements than quad4 and hex8; formulation "full" unless EAS exists. */
static inline void bench_convert(struct bench *bench, enum element_type type)
{
    if (bench->mesh.mesh.type == type)
        return;
    assert_int_equal(mesh_convert(&bench->mesh.mesh, type), 0);
    bench->mesh.formulation = SOLID_FULL;
}

static inline int bench_set(const struct bench *bench, const char *name)
{
    const struct node_set *set = mesh_find_set(&bench->mesh.mesh, name);
    assert_non_null(set);
    return (int)(set - bench->mesh.mesh.sets);
}

static inline struct model_support *bench_support(struct bench *bench, const char *set, bool x, bool y,
                                                  bool z)
{
    struct model_support *support = &bench->supports[bench->mesh.n_supports++];
    *support = (struct model_support){.set = bench_set(bench, set), .fixed = {x, y, z}};
    return support;
}

/** A load along one direction; set NULL: body force. */
static inline void bench_load(struct bench *bench, const char *set, int direction, const char *text)
{
    struct model_load *load = &bench->loads[bench->mesh.n_loads++];
    *load = (struct model_load){.set = set ? bench_set(bench, set) : -1};
    load->force[direction] = bench_expression(text);
}

static inline void bench_start(struct bench *bench)
{
    assert_int_equal(solid_create(&bench->solid, &bench->model, 0), 0);
    assert_int_equal(solid_start(bench->solid, bench->t), 0);
}

static inline int bench_step(struct bench *bench, double dt)
{
    CALL(solid_begin_step(bench->solid, bench->t, dt));
    CALL(solid_solve(bench->solid));
    CALL(solid_accept(bench->solid));
    bench->t += dt;
    return 0;
}

static inline void bench_reset(struct bench *bench)
{
    solid_destroy(bench->solid);
    for (size_t l = 0; l < bench->mesh.n_loads; l++)
        for (int i = 0; i < 3; i++)
            expression_destroy(bench->loads[l].force[i]);
    for (size_t s = 0; s < bench->mesh.n_supports; s++)
        motion_reset(&bench->supports[s].motion);
    for (int i = 0; i < 3; i++) {
        expression_destroy(bench->mesh.displacement[i]);
        expression_destroy(bench->mesh.velocity[i]);
    }
    mesh_reset(&bench->mesh.mesh);
}

/** Node field of the solid. */
static inline const double (*bench_field(const struct bench *bench, const char *name))[3]
{
    const struct field *field = field_find(solid_node_fields(bench->solid), name);
    assert_non_null(field);
    return (const double(*)[3])field->data[0];
}

#endif
