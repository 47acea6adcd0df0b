// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_SURFACE_H
#define MODEL_SURFACE_H

#include "base/field.h"
#include "model/model.h"

#include <stdint.h>

/** How surface_at finds the surface between the levels. */
enum surface_rule { SURFACE_INTERPOLATE, SURFACE_MEAN };

/** Motion of all points at one time: rows of 3. */
struct surface_motion {
    double t;
    double (*x)[3], (*v)[3], (*a)[3];
};

/** A point of a surface and its weight. */
struct anchor {
    double weight;
    int32_t point;
};

/** Derivative of the load by the surface's motion (numerics.md section 4): per contact a tensor whose rows
 * are spread by the shape functions of what takes the load and whose columns by those of what gave the
 * acceleration (facets; elements around wall particles), and what viscous forces have of the velocity of the
 * former, alike in all directions. With velocities that change by b times the change of the acceleration a,
 * f += -(T + b D) a is the fluid's reaction: surface_added_mass_apply returns +(T + b D) a. */
struct added_mass_contact {
    size_t row, column;         /**< first of their anchors */
    uint32_t n_rows, n_columns; /**< how many */
    double tensor[3][3];        /**< T, kg */
    double damping;             /**< D, kg/s */
};

/** What is spread over the points of a surface is added up in so many parts, which threads fill side by side
 * (surface_sum_parts): as many with one thread as with any number, so that the sums are the same. */
enum { SURFACE_PARTS = 8 };

/** The only thing fluid and solid share: points, optionally facets or an analytic shape, their motion at the
 * start and end of the step, and the loads on them. First come the points of the facets, then (where walls
 * are made of material points) further nodes of meshes, inside the body. An analytic surface has one point,
 * its centre, with the load's force; the moment about the centre is in @c moment. Points are interleaved rows
 * of 3; loads are in double; z = 0 in 2-D. */
struct surface {
    const struct model_surface *definition;
    int dim;
    size_t n_points, n_facets;
    double (*X)[3];                   /**< reference places */
    int32_t (*nodes)[4];              /**< facets, oriented as struct facets */
    int32_t (*sides)[SIDE_MAX_NODES]; /**< curved sides they are pieces of, as in struct facets, or NULL */
    int32_t *mesh;      /**< per point: index of the model mesh that moves it, or -1: prescribed */
    int32_t *mesh_node; /**< per point: node of that mesh */
    bool coupled;       /**< some point is moved by a solid */
    bool moving;        /**< coupled, or its prescribed motion moves */
    bool sub_cycled;    /**< its steps span several of the fluid's, in which the impulse adds up */
    enum surface_rule rule;
    struct surface_motion level[2];     /**< start and end of the step */
    struct surface_motion now;          /**< as evaluated by surface_at */
    struct surface_motion trial;        /**< the solid's answer */
    const struct surface_motion *shown; /**< what output shows: level 1, or now (surface_show) */
    double (*listed)[3]; /**< places when the lists of near particles were made (surface_mark) */
    double (*load)[3], (*load_previous)[3], (*impulse)[3]; /**< N, N, N s (2-D: per metre of depth) */
    double moment[3]; /**< of loads about the points that take them (analytic surfaces, particles fixed behind
                         facets), N m */
    size_t n_added_mass, added_mass_capacity;
    struct added_mass_contact *added_mass;
    struct anchor *anchors; /**< of its rows and columns */
    size_t n_anchors, anchors_capacity;
    double (*part[SURFACE_PARTS])[3]; /**< workspace of n_points rows each, zero between uses */
    struct field_group fields;        /**< named "surface-NAME" */
    struct field field_list[7];
};

/** Build surface @p index of the model at time @p t (prescribed points at their places, mesh points at X plus
 * the mesh's initial displacement, at rest unless the mesh says otherwise). Free with surface_destroy. */
int surface_create(struct surface **surface, const struct model *model, int index, double t);
void surface_destroy(struct surface *surface);

/** Let @p n further points follow @p nodes of mesh @p mesh of the model, none of which any point follows yet.
 * Before the first step, and before solids are attached. Returns 0 or STATUS_MEMORY. */
int surface_add_nodes(struct surface *surface, const struct model *model, int mesh, size_t n,
                      const int32_t *nodes);

/** Level 0 := level 1, level 1 gets time @p t1 with prescribed points evaluated there (mesh points keep level
 * 1 until the solid predicts); impulse := 0. */
void surface_open(struct surface *surface, double t1);

/** Go on within a step that was opened before a checkpoint: both levels hold its start (surface_resume,
 * solid_resume); as surface_open, but the impulse stays. */
void surface_reopen(struct surface *surface, double t1);

/** Fill @c now for time @p t between the levels: x on the cubic through places and velocities, v its
 * derivative, a linear (the end times give the levels bit for bit). */
void surface_at(struct surface *surface, double t);

/** How far the point that goes farthest goes between @p t - @p dt and @p t, m. */
double surface_travel(const struct surface *surface, double t, double dt);

/** Let output show @c now (inside a step) or level 1 (otherwise). */
void surface_show(struct surface *surface, bool now);

/** Remember the places @c now: lists are made for them. */
void surface_mark(struct surface *surface);

/** Put @c now back to the places that were remembered at time @p t, to make the same lists once more. */
void surface_recall(struct surface *surface, double t);

/** Go on from a checkpoint at the end of a step at time @p t: prescribed points at both levels, trial and
 * now; points of solids follow from solid_resume. */
void surface_resume(struct surface *surface, double t);

/** How motion and load at a place of a facet belong to points: @p weights (overwritten) are the facet's own
 * shape functions there; where the facet is a straight piece of a curved side, they become the side's shape
 * functions at the same natural coordinates. Fills @p points; returns how many there are. */
int surface_spread(const struct surface *surface, size_t facet, int32_t points[SIDE_MAX_NODES],
                   double weights[SIDE_MAX_NODES]);

/** load := 0, moment := 0. */
void surface_clear_load(struct surface *surface);

/** Add the parts, one after the other, to @p sum (n_points rows) and make them zero again. */
void surface_sum_parts(const struct surface *surface, double (*sum)[3]);

enum surface_load { SURFACE_LOAD_MEAN, SURFACE_LOAD_END };
/** Add dt f (mean loads) or dt/2 (load_previous + f) (end-of-step loads) to the impulse; then load_previous
 * := load. */
void surface_add_impulse(struct surface *surface, double dt, enum surface_load kind);

/** Make room for n_added_mass contacts with n_anchors anchors in all. Returns 0 or STATUS_MEMORY. */
int surface_added_mass_reserve(struct surface *surface);

/** result[i] = sum of (T + b D) accelerations over the contacts (rows of 3, n_points each), b = @p
 * per_acceleration (s): what an acceleration of 1 adds to the velocity. result is overwritten. */
void surface_added_mass_apply(const struct surface *surface, const double (*acceleration)[3],
                              double per_acceleration, double (*result)[3]);

/** Total load, and moment about @p centre (points at @c now). */
void surface_total_load(const struct surface *surface, const double centre[3], double force[3],
                        double moment[3]);

#endif
