// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_MOTION_H
#define MODEL_MOTION_H

#include "math/expression.h"

#include <stdbool.h>

enum motion_kind {
    MOTION_NONE,
    MOTION_RIGID, /**< rotation by angle(t) about an axis through centre, then translation displacement(t) */
    MOTION_FIELD  /**< displacement(X, t) of every material point */
};

/** A prescribed motion. Expressions that are NULL are 0 (displacement, angle) or one-sided (right)
 * differences of the function they derive from (velocity, acceleration, ...), so that kinks give no impulse.
 */
struct motion {
    enum motion_kind kind;
    struct expression *displacement[3], *velocity[3], *acceleration[3]; /**< m, m/s, m/s^2 */
    struct expression *angle, *angular_velocity, *angular_acceleration; /**< rad, rad/s, rad/s^2 */
    double centre[3], axis[3]; /**< axis: unit vector; 2-D: (0, 0, 1) */
};

/** Place, velocity and acceleration at time @p t of the material point with reference place @p X. */
void motion_at(const struct motion *motion, const double X[3], double t, double x[3], double v[3],
               double a[3]);

/** Velocity and acceleration at time @p t of the material point that is now at @p x (rigid motions and none
 * only). */
void motion_at_place(const struct motion *motion, const double x[3], double t, double v[3], double a[3]);

/** A rigid motion (or none) at one time: its expressions evaluated once, for many points and several threads.
 */
struct motion_frame {
    double centre[3], displacement[3], velocity[3], acceleration[3];
    double rotation[3][3], omega[3], alpha[3];
    bool turned; /**< the angle is not 0 */
};

/** The state of @p motion (rigid, or none) at time @p t; expressions are not reentrant: one thread at a time.
 */
void motion_frame_at(const struct motion *motion, double t, struct motion_frame *frame);

/** motion_at and motion_at_place with the expressions already evaluated. */
void motion_frame_point(const struct motion_frame *frame, const double X[3], double x[3], double v[3],
                        double a[3]);
void motion_frame_place(const struct motion_frame *frame, const double x[3], double v[3], double a[3]);

/** Whether anything ever moves: a rotating circle moves although its shape stays. */
bool motion_moves(const struct motion *motion);

/** Free the expressions. */
void motion_reset(struct motion *motion);

#endif
