// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/interface.h"

#include <math.h>
#include <string.h>

double interface_difference(struct coupling *coupling, double dt)
{
    double *difference = coupling->difference, square = 0.0;
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        const struct surface *surface = coupling->parts.surfaces[s];
        for (size_t p = 0; p < surface->n_points && surface->coupled; ++p)
            for (int d = 0; d < surface->dim; ++d) {
                double r = surface->mesh[p] < 0 ? 0.0 : surface->trial.x[p][d] - surface->level[1].x[p][d];
                *difference++ = r;
                square += r * r;
            }
    }
    return sqrt(square / (double)coupling->n_dof) / dt;
}

static void rows_blend(double (*level)[3], const double (*trial)[3], size_t p, double factor)
{
    for (int d = 0; d < 3; ++d)
        level[p][d] = factor == 1.0 ? trial[p][d] : level[p][d] + factor * (trial[p][d] - level[p][d]);
}

void interface_blend(struct coupling *coupling, double factor)
{
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        struct surface *surface = coupling->parts.surfaces[s];
        for (size_t p = 0; p < surface->n_points && surface->coupled; ++p) {
            if (surface->mesh[p] < 0)
                continue;
            rows_blend(surface->level[1].x, (const double(*)[3])surface->trial.x, p, factor);
            rows_blend(surface->level[1].v, (const double(*)[3])surface->trial.v, p, factor);
            rows_blend(surface->level[1].a, (const double(*)[3])surface->trial.a, p, factor);
        }
    }
}

/** One of x, v, a of a coupled surface's points from rows into the vector, or (@p back) from there into rows.
 * Points that no solid moves are 0. Returns the place behind them in the vector. */
static double *rows_exchange(const struct surface *surface, double (*rows)[3], double *vector, bool back)
{
    for (size_t p = 0; p < surface->n_points; ++p)
        for (int d = 0; d < surface->dim; ++d, ++vector) {
            if (surface->mesh[p] < 0)
                *vector = 0.0;
            else if (back)
                rows[p][d] = *vector;
            else
                *vector = rows[p][d];
        }
    return vector;
}

/** Displacement, velocity, acceleration of the trial or of level 1 of all coupled points, one after the
 * other. */
static void motion_exchange(struct coupling *coupling, bool trial, double *vector, bool back)
{
    for (int kind = 0; kind < 3; ++kind)
        for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
            struct surface *surface = coupling->parts.surfaces[s];
            struct surface_motion *motion = trial ? &surface->trial : &surface->level[1];
            double(*const rows[3])[3] = {motion->x, motion->v, motion->a};
            if (surface->coupled)
                vector = rows_exchange(surface, rows[kind], vector, back);
        }
}

void interface_extrapolate(struct coupling *coupling)
{
    motion_exchange(coupling, true, coupling->answer, false);
    motion_exchange(coupling, false, coupling->iterate, false);
    quasi_newton_next(coupling->quasi_newton, coupling->difference, coupling->answer, coupling->iterate);
    motion_exchange(coupling, false, coupling->iterate, true);
}

double interface_load_change(struct coupling *coupling)
{
    double(*before)[3] = coupling->load_before, square = 0.0;
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        const struct surface *surface = coupling->parts.surfaces[s];
        for (size_t p = 0; p < surface->n_points && surface->coupled; ++p, ++before)
            for (int d = 0; d < 3; ++d) {
                square += pow(surface->load[p][d] - (*before)[d], 2.0);
                (*before)[d] = surface->load[p][d];
            }
    }
    return sqrt(square);
}
