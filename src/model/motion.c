// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/motion.h"

#include <math.h>
#include <string.h>

/** Steps of the one-sided differences, s: powers of two, so that t + k step is exact. */
#define FIRST_STEP 0x1p-20
#define SECOND_STEP 0x1p-16

static double first_difference(const struct expression *f, const double X[3], double t)
{
    if (expression_is_steady(f))
        return 0.0;
    double h = FIRST_STEP;
    return (-3.0 * expression_value(f, X, t) + 4.0 * expression_value(f, X, t + h) -
            expression_value(f, X, t + 2.0 * h)) /
           (2.0 * h);
}

static double second_difference(const struct expression *f, const double X[3], double t)
{
    if (expression_is_steady(f))
        return 0.0;
    double h = SECOND_STEP;
    return (2.0 * expression_value(f, X, t) - 5.0 * expression_value(f, X, t + h) +
            4.0 * expression_value(f, X, t + 2.0 * h) - expression_value(f, X, t + 3.0 * h)) /
           (h * h);
}

/** A function of time and its two derivatives, from the expressions that are given. */
static void evaluate(const struct expression *f, const struct expression *rate,
                     const struct expression *rate2, const double X[3], double t, double value[3])
{
    value[0] = f ? expression_value(f, X, t) : 0.0;
    value[1] = rate ? expression_value(rate, X, t) : f ? first_difference(f, X, t) : 0.0;
    value[2] = rate2  ? expression_value(rate2, X, t)
               : rate ? first_difference(rate, X, t)
               : f    ? second_difference(f, X, t)
                      : 0.0;
}

void motion_frame_at(const struct motion *motion, double t, struct motion_frame *frame)
{
    *frame = (struct motion_frame){.rotation = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (motion->kind != MOTION_RIGID)
        return;
    double value[3];
    for (int k = 0; k < 3; ++k) {
        evaluate(motion->displacement[k], motion->velocity[k], motion->acceleration[k], NULL, t, value);
        frame->centre[k] = motion->centre[k];
        frame->displacement[k] = value[0];
        frame->velocity[k] = value[1];
        frame->acceleration[k] = value[2];
    }
    evaluate(motion->angle, motion->angular_velocity, motion->angular_acceleration, NULL, t, value);
    const double *e = motion->axis;
    double c = cos(value[0]), s = sin(value[0]);
    const double cross[3][3] = {{0, -e[2], e[1]}, {e[2], 0, -e[0]}, {-e[1], e[0], 0}};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            frame->rotation[i][j] = (i == j ? c : 0.0) + (1.0 - c) * e[i] * e[j] + s * cross[i][j];
        frame->omega[i] = value[1] * e[i];
        frame->alpha[i] = value[2] * e[i];
    }
    frame->turned = value[0] != 0.0;
}

/** Velocity and acceleration of the point at @p r from the displaced centre. */
static void rates(const struct motion_frame *frame, const double r[3], double v[3], double a[3])
{
    const double *w = frame->omega, *b = frame->alpha;
    const double wr[3] = {w[1] * r[2] - w[2] * r[1], w[2] * r[0] - w[0] * r[2], w[0] * r[1] - w[1] * r[0]};
    const double br[3] = {b[1] * r[2] - b[2] * r[1], b[2] * r[0] - b[0] * r[2], b[0] * r[1] - b[1] * r[0]};
    const double wwr[3] = {w[1] * wr[2] - w[2] * wr[1], w[2] * wr[0] - w[0] * wr[2],
                           w[0] * wr[1] - w[1] * wr[0]};
    for (int k = 0; k < 3; ++k) {
        v[k] = frame->velocity[k] + wr[k];
        a[k] = frame->acceleration[k] + br[k] + wwr[k];
    }
}

void motion_frame_point(const struct motion_frame *frame, const double X[3], double x[3], double v[3],
                        double a[3])
{
    double r[3];
    for (int k = 0; k < 3; ++k) {
        r[k] = X[k] - frame->centre[k];
        x[k] = X[k] + frame->displacement[k];
    }
    if (frame->turned) {
        const double r0[3] = {r[0], r[1], r[2]};
        for (int k = 0; k < 3; ++k) {
            r[k] =
                frame->rotation[k][0] * r0[0] + frame->rotation[k][1] * r0[1] + frame->rotation[k][2] * r0[2];
            x[k] = frame->centre[k] + r[k] + frame->displacement[k];
        }
    }
    rates(frame, r, v, a);
}

void motion_frame_place(const struct motion_frame *frame, const double x[3], double v[3], double a[3])
{
    double r[3];
    for (int k = 0; k < 3; ++k)
        r[k] = x[k] - frame->centre[k] - frame->displacement[k];
    rates(frame, r, v, a);
}

void motion_at(const struct motion *motion, const double X[3], double t, double x[3], double v[3],
               double a[3])
{
    if (motion->kind == MOTION_FIELD) {
        for (int k = 0; k < 3; ++k) {
            double value[3];
            evaluate(motion->displacement[k], motion->velocity[k], motion->acceleration[k], X, t, value);
            x[k] = X[k] + value[0];
            v[k] = value[1];
            a[k] = value[2];
        }
        return;
    }
    struct motion_frame frame;
    motion_frame_at(motion, t, &frame);
    motion_frame_point(&frame, X, x, v, a);
}

void motion_at_place(const struct motion *motion, const double x[3], double t, double v[3], double a[3])
{
    struct motion_frame frame;
    motion_frame_at(motion, t, &frame);
    motion_frame_place(&frame, x, v, a);
}

/** Whether a displacement or angle changes with time. */
static bool changes(const struct expression *f)
{
    return f && !expression_is_steady(f);
}

/** Whether a given rate is ever anything but 0. */
static bool acts(const struct expression *rate)
{
    return rate && !(expression_is_constant(rate) && expression_value(rate, NULL, 0.0) == 0.0);
}

bool motion_moves(const struct motion *motion)
{
    if (motion->kind == MOTION_NONE)
        return false;
    bool moves =
        changes(motion->angle) || acts(motion->angular_velocity) || acts(motion->angular_acceleration);
    for (int k = 0; k < 3; ++k)
        moves = moves || changes(motion->displacement[k]) || acts(motion->velocity[k]) ||
                acts(motion->acceleration[k]);
    return moves;
}

void motion_reset(struct motion *motion)
{
    for (int k = 0; k < 3; ++k) {
        expression_destroy(motion->displacement[k]);
        expression_destroy(motion->velocity[k]);
        expression_destroy(motion->acceleration[k]);
    }
    expression_destroy(motion->angle);
    expression_destroy(motion->angular_velocity);
    expression_destroy(motion->angular_acceleration);
    memset(motion, 0, sizeof *motion);
}
