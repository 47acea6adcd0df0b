// SPDX-License-Identifier: GPL-3.0-or-later
/* Outflow: a zone of particles with prescribed pressure (Fuchs et al. 2021, section 3.1.6). Zone particles
 * move with the outgoing characteristic <u_n + (p - p_out)/(rho c)> of the fluid within 3 spacings of the
 * plane, row by row, so that sound leaves and no particle of the zone clumps; or, velocity="momentum", by the
 * momentum equation as in the paper. */
#include "base/error.h"
#include "base/memory.h"
#include "open/open_list.h"
#include "open/zone.h"

struct outflow {
    size_t n_fluid, fluid_capacity;
    uint32_t *fluid; /**< particles within 3 spacings (and the skin) of the plane */
    int bins[3];     /**< rows across the plane, of one spacing; 1 along the axis */
    double width[3];
    double *sum, *count; /**< per row */
    double mean;         /**< over all rows: for rows without fluid */
};

static int outflow_create(struct open_boundary *open, const struct model *model,
                          const struct fluid_view *view)
{
    const struct model_open *definition = open->definition;
    struct outflow *outflow = memory_create(1, sizeof *outflow);
    CHECK_MEMORY(outflow);
    open->data = outflow;
    open->reads_density = definition->velocity_rule == OPEN_CHARACTERISTIC;
    size_t total = 1;
    for (int k = 0; k < 3; ++k) {
        double extent =
            k < model->dim && k != definition->axis ? definition->upper[k] - definition->lower[k] : 0.0;
        outflow->bins[k] = extent > 0.0 ? (int)fmax(1.0, floor(extent / view->spacing + 0.5)) : 1;
        outflow->width[k] = extent > 0.0 ? extent / outflow->bins[k] : 1.0;
        total *= (size_t)outflow->bins[k];
    }
    outflow->sum = memory_create(total, sizeof(double));
    outflow->count = memory_create(total, sizeof(double));
    return outflow->sum && outflow->count ? 0 : STATUS_MEMORY;
}

static void outflow_destroy(struct open_boundary *open)
{
    struct outflow *outflow = open->data;
    if (!outflow)
        return;
    memory_free(outflow->fluid);
    memory_free(outflow->sum);
    memory_free(outflow->count);
    memory_free(outflow);
}

/** Row of a place across the plane, clamped. */
static void outflow_bin(const struct outflow *outflow, const struct model_open *definition, const double x[3],
                        int bin[3])
{
    for (int k = 0; k < 3; ++k) {
        int b = outflow->bins[k] > 1 ? (int)floor((x[k] - definition->lower[k]) / outflow->width[k]) : 0;
        bin[k] = b < 0 ? 0 : b >= outflow->bins[k] ? outflow->bins[k] - 1 : b;
    }
}

static size_t bin_index(const struct outflow *outflow, const int bin[3])
{
    return ((size_t)bin[2] * (size_t)outflow->bins[1] + (size_t)bin[1]) * (size_t)outflow->bins[0] +
           (size_t)bin[0];
}

/** Rows of the outgoing characteristic from the fluid before the plane. */
static void characteristics_collect(struct open_boundary *open, const struct fluid_view *view,
                                    const struct particles *particles, double t)
{
    struct outflow *outflow = open->data;
    const struct model_open *definition = open->definition;
    size_t total = (size_t)outflow->bins[0] * (size_t)outflow->bins[1] * (size_t)outflow->bins[2];
    double all = 0.0, number = 0.0;
    memset(outflow->sum, 0, total * sizeof(double));
    memset(outflow->count, 0, total * sizeof(double));
    for (size_t c = 0; c < outflow->n_fluid; ++c) {
        size_t i = outflow->fluid[c];
        double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]};
        double inside = zone_inside(definition, x);
        if (inside < 0.0 || inside > 3.0 * view->spacing)
            continue;
        int bin[3];
        outflow_bin(outflow, definition, x, bin);
        double out = -definition->into * particles->u[definition->axis][i];
        double value = out + (particles->p[i] - expression_value(definition->pressure, x, t)) /
                                 (particles->rho[i] * view->sound_speed);
        outflow->sum[bin_index(outflow, bin)] += value;
        outflow->count[bin_index(outflow, bin)] += 1.0;
        all += value;
        number += 1.0;
    }
    outflow->mean = number > 0.0 ? all / number : 0.0;
}

/** Outgoing velocity at the foot of @p x: its row in 2-D; in 3-D a kernel average over rows, which hold few
 * particles each. */
static double characteristic_at(const struct open_boundary *open, const struct fluid_view *view,
                                const double x[3])
{
    const struct outflow *outflow = open->data;
    const struct model_open *definition = open->definition;
    int centre[3], bin[3];
    outflow_bin(outflow, definition, x, centre);
    if (view->dim < 3) {
        size_t row = bin_index(outflow, centre);
        return outflow->count[row] > 0.0 ? outflow->sum[row] / outflow->count[row] : outflow->mean;
    }
    int reach = (int)ceil(view->kernel.support / view->spacing);
    int a = (definition->axis + 1) % 3, b = (definition->axis + 2) % 3;
    double weight = 0.0, sum = 0.0;
    for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j) {
            memcpy(bin, centre, sizeof bin);
            bin[a] += i;
            bin[b] += j;
            if (bin[a] < 0 || bin[a] >= outflow->bins[a] || bin[b] < 0 || bin[b] >= outflow->bins[b])
                continue;
            double da = definition->lower[a] + (bin[a] + 0.5) * outflow->width[a] - x[a];
            double db = definition->lower[b] + (bin[b] + 0.5) * outflow->width[b] - x[b];
            double w = kernel_w(&view->kernel, sqrt(da * da + db * db));
            weight += w * outflow->count[bin_index(outflow, bin)];
            sum += w * outflow->sum[bin_index(outflow, bin)];
        }
    return weight > 0.0 ? sum / weight : outflow->mean;
}

static int outflow_velocities(struct open_boundary *open, const struct fluid_view *view,
                              struct particles *particles, double t)
{
    const struct model_open *definition = open->definition;
    if (definition->velocity_rule != OPEN_CHARACTERISTIC)
        return 0;
    characteristics_collect(open, view, particles, t);
    for (size_t z = 0; z < open->n_zone; ++z) {
        size_t i = open->zone[z];
        double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]};
        double out = characteristic_at(open, view, x);
        for (int k = 0; k < 3; ++k)
            particles->u[k][i] = k == definition->axis ? -definition->into * out : 0.0;
    }
    return 0;
}

static int outflow_move(struct open_boundary *open, const struct fluid_view *view,
                        struct particles *particles, uint8_t *dead)
{
    const size_t n = particles->n;
    const struct model_open *definition = open->definition;
    CALL(zone_release(open, view, particles));
    int64_t removed = 0;
#pragma omp parallel for schedule(static) reduction(+ : removed)
    for (size_t i = 0; i < n; ++i) {
        double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]};
        double inside = zone_inside(definition, x);
        if (particles->kind[i] == PARTICLE_OUTFLOW && particles->opening[i] == open->index) {
            if (inside < -open->depth) {
                dead[i] = 1;
                ++removed;
            }
        } else if (particles->kind[i] == PARTICLE_FLUID && inside < 0.0 && inside > -open->depth &&
                   zone_across(definition, view->dim, x, 0.5 * view->spacing)) {
            particles->kind[i] = PARTICLE_OUTFLOW;
            particles->opening[i] = (uint8_t)open->index;
        }
    }
    open->removed += removed;
    return 0;
}

static int outflow_list(struct open_boundary *open, const struct fluid_view *view)
{
    struct outflow *outflow = open->data;
    const struct model_open *definition = open->definition;
    const struct particles *particles = view->particles;
    const double reach = 3.0 * view->spacing + view->skin;
    CALL(zone_list(open, view));
    outflow->n_fluid = 0;
    for (size_t i = 0; i < particles->n; ++i) {
        double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]};
        double inside = zone_inside(definition, x);
        if (particles->kind[i] != PARTICLE_FLUID || inside < -view->skin || inside > reach ||
            !zone_across(definition, view->dim, x, 0.5 * view->spacing))
            continue;
        CALL(memory_grow((void **)&outflow->fluid, &outflow->fluid_capacity, outflow->n_fluid + 1,
                         sizeof *outflow->fluid));
        outflow->fluid[outflow->n_fluid++] = (uint32_t)i;
    }
    return 0;
}

static int outflow_values(struct open_boundary *open, const struct fluid_view *view,
                          struct particles *particles)
{
    const double c2 = view->sound_speed * view->sound_speed;
    for (size_t z = 0; z < open->n_zone; ++z) {
        size_t i = open->zone[z];
        double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]};
        particles->p[i] = expression_value(open->definition->pressure, x, view->t);
        particles->rho[i] = particles->p[i] / c2 + view->density;
    }
    return 0;
}

const struct open_boundary_type open_boundary_outflow = {
    .name = "outflow",
    .create = outflow_create,
    .destroy = outflow_destroy,
    .velocities = outflow_velocities,
    .move = outflow_move,
    .list = outflow_list,
    .values = outflow_values,
};
