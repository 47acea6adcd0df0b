// SPDX-License-Identifier: GPL-3.0-or-later
// The rate of one evaluation of a formulation with a compact kernel, for skerry-bench: what the frame of the
// sweeps gives to a formulation that needs no second sweep. A periodic box of disordered particles; the
// result is compared with plain sums in double precision first. Prints one line of JSON.

#include "pass.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/timer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;
static pass_sweep *const sweeps[ISAS] = ISA_TABLE(pass_sweep, mixed);

static const struct pass {
    const char *name;
    int dim, side;  // particles along a side
    double support; // in spacings
} passes[] = {{"delta-2d", 2, 500, 2.4}, {"delta-2d-wide", 2, 500, 3.39}, {"delta-3d", 3, 75, 2.4}};

struct box {
    int dim;
    size_t n;
    double side, skin, *x[3];
    struct pass_arrays arrays;
    struct cell_grid grid;
    struct neighbour_list list;
};

static double random_next(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 4503599627370496.0 - 1.0;
}

// Spacing 1; velocities and pressures of the size they have in a flow at a tenth of the speed of sound.
static int box_create(struct box *box, const struct pass *pass, int side, enum isa isa)
{
    uint64_t seed = 4711;
    const double lower[3] = {0.0}, upper[3] = {side, side, side};
    const bool periodic[3] = {true, true, true};
    *box = (struct box){.dim = pass->dim, .side = side, .skin = 0.3};
    box->n = 1;
    for (int k = 0; k < pass->dim; k++)
        box->n *= (size_t)side;
    struct pass_arrays *a = &box->arrays;
    a->dim = pass->dim;
    a->mass = 1.0;
    a->h = 0.5 * pass->support;
    a->kernel_constant =
        pass->dim == 2 ? 7.0 / (4.0 * pi * a->h * a->h) : 21.0 / (16.0 * pi * pow(a->h, 3.0));
    a->viscosity = 0.01;
    a->diffusion = 0.2 * a->h;
    double **const arrays[] = {&box->x[0], &box->x[1], &box->x[2], &a->u[0], &a->u[1], &a->u[2],
                               &a->rho,    &a->p,      &a->drho,   &a->a[0], &a->a[1], &a->a[2]};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
        if (!(*arrays[k] = memory_create(box->n, sizeof(double))))
            return 71;
    double *sorted = memory_create(box->n, sizeof *sorted);
    uint32_t *order = memory_create(box->n, sizeof *order);
    if (!sorted || !order)
        return 71;
    for (size_t i = 0; i < box->n; i++) {
        const size_t place[3] = {i % (size_t)side, i / (size_t)side % (size_t)side,
                                 i / (size_t)side / (size_t)side};
        for (int k = 0; k < pass->dim; k++) {
            box->x[k][i] = (double)place[k] + 0.5 + 0.2 * random_next(&seed);
            a->u[k][i] = 0.1 * random_next(&seed);
        }
        a->rho[i] = 1.0 + 0.01 * random_next(&seed);
        a->p[i] = a->rho[i] - 1.0;
    }
    const double *const x[3] = {box->x[0], box->x[1], box->x[2]};
    for (int k = 0; k < 3; k++)
        a->x[k] = x[k];
    int status = cell_grid_create(&box->grid, pass->dim, lower, upper, periodic, pass->support + box->skin,
                                  pass->dim == 2 ? 2.8 : 2.0, 1.0);
    if (!status)
        status = cell_grid_sort(&box->grid, x, box->n, order);
    // what a particle has is as random as before in whatever order
    for (int k = 0; k < pass->dim && !status; k++) {
        memcpy(sorted, box->x[k], box->n * sizeof *sorted);
        for (size_t i = 0; i < box->n; i++)
            box->x[k][i] = sorted[order[i]];
    }
    if (!status)
        status = neighbour_list_make(&box->list, &box->grid, x, box->n, pass->support + box->skin, isa);
    memory_free(sorted);
    memory_free(order);
    a->places = memory_create(box->list.n_slots, (size_t)pass->dim * sizeof(float));
    a->records = memory_create(box->list.n_slots, (size_t)(pass->dim + 3) * sizeof(float));
    return status ? status : a->places && a->records ? 0 : 71;
}

static void box_reset(struct box *box)
{
    struct pass_arrays *a = &box->arrays;
    for (int k = 0; k < 3; k++) {
        memory_free(box->x[k]);
        memory_free(a->u[k]);
        memory_free(a->a[k]);
    }
    memory_free(a->rho);
    memory_free(a->p);
    memory_free(a->drho);
    memory_free(a->places);
    memory_free(a->records);
    neighbour_list_reset(&box->list);
    cell_grid_reset(&box->grid);
}

// Largest difference from plain sums, by the largest value; returns the mean number of neighbours as well.
static double box_error(const struct box *box, double *neighbours)
{
    const struct pass_arrays *a = &box->arrays;
    double error[2] = {0.0}, largest[2] = {0.0};
    size_t pairs = 0;
    for (size_t i = 0; i < box->n; i++) {
        double rates[4] = {0.0};
        for (size_t j = 0; j < box->n; j++) {
            double d[3] = {0.0}, r2 = 0.0, along = 0.0;
            for (int k = 0; k < box->dim; k++) {
                d[k] = a->x[k][i] - a->x[k][j];
                d[k] -= box->side * round(d[k] / box->side);
                r2 += d[k] * d[k];
                along += (a->u[k][i] - a->u[k][j]) * d[k];
            }
            const double q = sqrt(r2) / a->h;
            if (i == j || q >= 2.0)
                continue;
            pairs++;
            const double slope = -5.0 * a->kernel_constant / (a->h * a->h) * pow(1.0 - 0.5 * q, 3.0);
            const double v = a->mass / a->rho[j];
            rates[0] += slope * (a->mass * along + a->diffusion * (a->rho[i] - a->rho[j]) * v);
            for (int k = 0; k < box->dim; k++)
                rates[1 + k] += slope * (-a->mass * (a->p[i] + a->p[j]) / (a->rho[i] * a->rho[j]) * d[k] +
                                         4.0 * a->viscosity * a->mass * r2 * (a->u[k][i] - a->u[k][j]) /
                                             ((a->rho[i] + a->rho[j]) * (r2 + 0.01 * a->h * a->h)));
        }
        for (int k = 0; k <= box->dim; k++) {
            const double got = k ? a->a[k - 1][i] : a->drho[i];
            error[k > 0] = fmax(error[k > 0], fabs(got - rates[k]));
            largest[k > 0] = fmax(largest[k > 0], fabs(rates[k]));
        }
    }
    *neighbours = (double)pairs / (double)box->n;
    return fmax(error[0] / largest[0], error[1] / largest[1]);
}

// Mean time of an evaluation, s.
static double box_time(struct box *box, pass_sweep *sweep, double least)
{
    const double start = timer_now();
    double now;
    int times = 0;
    do {
        sweep(&box->list, &box->arrays);
        times++;
        now = timer_now();
    } while (now - start < least);
    return (now - start) / times;
}

static int pass_run(const struct pass *pass, enum isa isa, double least)
{
    struct box box;
    double neighbours = 0.0;
    int status = box_create(&box, pass, pass->dim == 2 ? 40 : 12, isa);
    if (!status) {
        sweeps[isa](&box.list, &box.arrays);
        const double error = box_error(&box, &neighbours);
        if (!(error < 1e-3)) {
            fprintf(stderr, "skerry-pass: error: %s differs from plain sums by %g\n", pass->name, error);
            status = 70;
        }
    }
    box_reset(&box);
    if (!status)
        status = box_create(&box, pass, pass->side, isa);
    if (!status) {
        const double seconds = box_time(&box, sweeps[isa], least);
        printf("{\"name\": \"%s\", \"dim\": %d, \"particles\": %zu, \"threads\": %d, \"isa\": \"%s\", "
               "\"updates_per_s\": %.6g, \"neighbours\": %.4g}\n",
               pass->name, pass->dim, box.n, parallel_threads(), isa_name(isa), (double)box.n / seconds,
               neighbours);
        box_reset(&box);
    }
    return status;
}

static int usage(void)
{
    fprintf(stderr, "usage: skerry-pass NAME [-j THREADS] [--isa NAME] [--seconds S]; NAME:");
    for (size_t k = 0; k < sizeof passes / sizeof *passes; k++)
        fprintf(stderr, " %s", passes[k].name);
    fprintf(stderr, "\n");
    return 64;
}

int main(int argc, char **argv)
{
    const struct pass *pass = NULL;
    const char *isa_wanted = NULL;
    int threads = 0;
    double seconds = 3.0;
    enum isa isa;
    for (int k = 1; k < argc; k++) {
        const bool value = k + 1 < argc;
        if (!strcmp(argv[k], "-j") && value)
            threads = atoi(argv[++k]);
        else if (!strcmp(argv[k], "--isa") && value)
            isa_wanted = argv[++k];
        else if (!strcmp(argv[k], "--seconds") && value)
            seconds = atof(argv[++k]);
        else
            for (size_t p = 0; p < sizeof passes / sizeof *passes; p++)
                if (!strcmp(argv[k], passes[p].name))
                    pass = &passes[p];
    }
    if (!pass)
        return usage();
    const int status = isa_choose(isa_wanted, &isa);
    if (status)
        return status;
    parallel_setup(threads);
    return pass_run(pass, isa, seconds);
}
