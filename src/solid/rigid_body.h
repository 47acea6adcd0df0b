// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_RIGID_BODY_H
#define SOLID_RIGID_BODY_H

#include "solid/solid_type.h"

/** Rigid bodies. One pair of files: rigid_body.c (mass, checks, creation, fields), rigid_body_step.c
 * (motion).
 *
 * A body is its centre of mass x, its orientation (unit quaternion q, places x + q (X - C) q*), its velocity
 * v and its angular momentum L about the centre. All vectors stand in the fixed axes; arms of reference
 * places X - C and the inertia J in those of the body. 2-D problems are the same with everything but x, y and
 * the rotation about z fixed.
 *
 * One step is the midpoint rule in the form of Simo and Wong (1991), algorithm C1:
 *   x1 = x0 + dt (v0 + v1)/2               M (v1 - v0) = impulse of the forces
 *   q1 = q0 exp(dt (W0 + W1)/2)            L1 - L0 = impulse of the moments,   W = J^-1 (L in the body's
 * axes) It is of second order, keeps momentum and angular momentum to rounding, and without loads energy too;
 * steady spin about a principal axis is exact. Loads of the end of a step have the impulse dt (f0 + f1)/2,
 * the very one that fluid particles lose; loads that are means over the step have dt f. The acceleration is
 * that of the newest load, so that in coupled steps it is implicit in the end of the step with full weight.
 */

/** Mass, its centre, and the inertia about that in the reference orientation: of the mesh's geometry and
 * density, unless the deck gives others. */
struct rigid_body_mass {
    double mass; /**< kg (2-D: kg/m) */
    double centre[3];
    double inertia[3][3]; /**< kg m^2 (2-D: kg m, zz only) */
};

struct rigid_body_motion {
    double d[3], v[3], a[3];   /**< displacement of the centre, velocity, acceleration */
    double q[4];               /**< orientation: w, x, y, z */
    double momentum[3];        /**< angular, about the centre */
    double omega[3], alpha[3]; /**< angular velocity, which follows from q and momentum, and acceleration */
};

/** Forces at material points: their sum, and the sum of (X - C)_i f_j, which gives their moment in any
 * orientation. */
struct rigid_body_load {
    double force[3], lever[3][3];
};

enum { RIGID_BODY_NODE_FIELDS = 5, RIGID_BODY_STATE_FIELDS = 12 };

struct rigid_body {
    const struct solid *solid;
    const struct model_mesh *definition;
    const struct mesh *mesh;
    struct rigid_body_mass mass;
    bool free[6]; /**< x, y, z, rotations about them */

    struct rigid_body_motion state, trial; /**< at the start of the step, and the answer for its end */
    double a_before[3], alpha_before[3];   /**< one step before the state */
    double force[3], moment[3];            /**< at the start of the step */
    double turn;                           /**< angle turned about z so far, rad */
    double external_work;
    struct rigid_body_load given[2];  /**< loads of the deck at the start and at the end of the step */
    struct rigid_body_load interface; /**< loads now on the attached surfaces */
    double added_mass[6][6];          /**< of the attached surfaces, on the body's accelerations */
    bool added_mass_current;          /**< made in this step */
    bool approximate; /**< the trial counts on loads that follow its acceleration by the added mass */

    double (*x)[3]; /**< current places of the nodes */
    struct field_group node_group, cell_group, state_group;
    char *node_group_name, *cell_group_name, *state_group_name;
    struct field node_fields[RIGID_BODY_NODE_FIELDS], state_fields[RIGID_BODY_STATE_FIELDS];
};

/** Mass properties of a mesh that is a rigid body (about its centre of mass). */
void rigid_body_mass_of(const struct model_mesh *definition, struct rigid_body_mass *mass);

/* rigid_body_step.c */

/** R of x = R X for the unit quaternion @p q. */
void rigid_body_rotation(const double q[4], double R[3][3]);

/** p := q exp(turn): the orientation @p q turned by the rotation vector @p turn in the axes of the body. */
void rigid_body_turn(const double q[4], const double turn[3], double p[4]);

/** Place, velocity and acceleration of the material point @p X, with the rotation @p R of the motion. */
void rigid_body_point(const struct rigid_body *body, const struct rigid_body_motion *motion,
                      const double R[3][3], const double X[3], double x[3], double v[3], double a[3]);

int rigid_body_start(struct solid *solid);
void rigid_body_take_load(struct solid *solid);
int rigid_body_resume(struct solid *solid);
int rigid_body_begin_step(struct solid *solid);
int rigid_body_predict(struct solid *solid);
int rigid_body_solve(struct solid *solid);
int rigid_body_correct(struct solid *solid, bool added_mass);
int rigid_body_accept(struct solid *solid);

#endif
