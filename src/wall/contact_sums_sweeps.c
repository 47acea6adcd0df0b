// SPDX-License-Identifier: GPL-3.0-or-later
/* Sums over the particles around a contact, compiled once per instruction set: some particles at a time are
 * fetched into arrays, which loops without branches then take as lanes. */
#include "wall/contact_sums_sweeps.h"

#include "sph/sweep_vector.h"

enum { LANES = 16 };

/** What is fetched of particles, each a lane. */
struct lanes {
    double d[3][LANES], p[LANES], rho[LANES], u[3][LANES], always[LANES];
};

/** Fetch particles @p first .. first + LANES - 1 of the list; behind its end stand some that do not count. */
SWEEP_INLINE void lanes_fetch(const struct contact_sums_task *task, uint32_t first, struct lanes *lanes)
{
    const struct particles *particles = task->particles;
    const uint32_t left = task->n - first, n = left < LANES ? left : LANES;
    for (uint32_t l = 0; l < n; ++l) {
        const uint32_t j = task->list[first + l];
        for (int k = 0; k < 3; ++k) {
            lanes->d[k][l] = particles->x[k][j] - task->c[k];
            lanes->u[k][l] = particles->u[k][j];
        }
        lanes->p[l] = particles->p[j];
        lanes->rho[l] = particles->rho[j];
        lanes->always[l] = j == task->self ? 1.0 : 0.0;
    }
    for (int k = 0; k < 3; ++k)
        for (uint32_t l = 0; l < n && task->period[k] > 0.0; ++l)
            lanes->d[k][l] -= task->period[k] * round(lanes->d[k][l] / task->period[k]);
    for (uint32_t l = n; l < LANES; ++l) {
        lanes->d[0][l] = 2.0 * task->kernel->support;
        lanes->d[1][l] = lanes->d[2][l] = lanes->p[l] = lanes->rho[l] = lanes->always[l] = 0.0;
        lanes->u[0][l] = lanes->u[1][l] = lanes->u[2][l] = 0.0;
    }
}

SWEEP_INLINE double lanes_dot(const double *a, const double *b)
{
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (int l = 0; l < LANES; ++l)
        sum += a[l] * b[l];
    return sum;
}

contact_sums_sweep SWEEP_NAME(contact_sums);

void SWEEP_NAME(contact_sums)(const struct contact_sums_task *task, struct contact_sums *sums)
{
    const struct kernel kernel = *task->kernel;
    const double per_h = 1.0 / kernel.h, *normal = task->normal;
    const double ramped = task->per_ramp > 0.0 ? 0.0 : 1.0;
    *sums = (struct contact_sums){0};
    for (uint32_t first = 0; first < task->n; first += LANES) {
        struct lanes lanes;
        double w[LANES];
        lanes_fetch(task, first, &lanes);
#pragma omp simd
        for (int l = 0; l < LANES; ++l) {
            const double x = lanes.d[0][l], y = lanes.d[1][l], z = lanes.d[2][l];
            const double q = sqrt(x * x + y * y + z * z) * per_h;
            const double a = kernel_positive(3.0 - q), b = kernel_positive(2.0 - q),
                         c = kernel_positive(1.0 - q);
            const double a2 = a * a, b2 = b * b, c2 = c * c;
            const double height = (x * normal[0] + y * normal[1] + z * normal[2]) * task->per_ramp;
            const double up = kernel_positive(height), ramp = up < 1.0 ? up : 1.0;
            const double fully = lanes.always[l] + ramped, part = fully > 0.0 ? 1.0 : ramp;
            w[l] = part * kernel.constant * (a2 * a2 * a - 6.0 * b2 * b2 * b + 15.0 * c2 * c2 * c);
        }
        double weight = 0.0;
#pragma omp simd reduction(+ : weight)
        for (int l = 0; l < LANES; ++l)
            weight += w[l];
        sums->weight += weight;
        sums->p += lanes_dot(w, lanes.p);
        sums->rho += lanes_dot(w, lanes.rho);
        for (int k = 0; k < 3; ++k) {
            sums->u[k] += lanes_dot(w, lanes.u[k]);
            sums->r[k] += lanes_dot(w, lanes.d[k]);
        }
    }
}
