// SPDX-License-Identifier: GPL-3.0-or-later
// Values of virtual boundary particles by extrapolation from the fluid (paper 000 eqs. 32-38), packed
// neighbours for the fluid's sweep, and loads (eqs. 41-42).
#include "wall/sliding_particles.h"

#include "base/error.h"
#include "base/memory.h"
#include "wall/contact_sums_sweeps.h"

#include <omp.h>
#include <string.h>

/** Fluid counts in the sums at a contact by its distance in front of the plane: from 0 at the plane to 1 at
 * this (of dx). */
#define FRONT_RAMP 0.1
/** A contact's closest point may move so far before the particles around it are listed again (of dx). */
#define LIST_MARGIN 0.02
/** Least distance of the centroid from the wall (of dx). */
#define LEAST_LAYER 0.5

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** List the particles that can count in the sums at a contact while its closest point moves little. */
static int contact_list(const struct sliding *s, const struct fluid_view *view, uint32_t lister,
                        struct contact *contact)
{
    const double *const *x = (const double *const *)view->particles->x, *c = contact->c;
    struct sliding_work *work = &s->work[lister];
    const double reach = view->kernel.support + LIST_MARGIN * view->spacing;
    struct cell_range ranges[CELL_GRID_RANGES];
    size_t n_ranges = cell_grid_ranges(view->grid, c, reach, ranges), most = work->n_list;
    for (size_t k = 0; k < n_ranges; ++k)
        most += ranges[k].end - ranges[k].begin;
    CALL(memory_grow((void **)&work->list, &work->list_capacity, most, sizeof *work->list));
    contact->lister = lister;
    contact->listed = work->n_list;
    memcpy(contact->listed_c, c, sizeof contact->listed_c);
    for (size_t k = 0; k < n_ranges; ++k) {
        const double o[3] = {ranges[k].shift[0] - c[0], ranges[k].shift[1] - c[1], ranges[k].shift[2] - c[2]};
        for (uint32_t j = ranges[k].begin; j < ranges[k].end; ++j) {
            const double dx = x[0][j] + o[0], dy = x[1][j] + o[1], dz = x[2][j] + o[2];
            work->list[work->n_list] = j;
            work->n_list += dx * dx + dy * dy + dz * dz < reach * reach;
        }
    }
    contact->n_listed = (uint32_t)(work->n_list - contact->listed);
    return 0;
}

#define SUMS_DECLARE(isa) contact_sums_sweep contact_sums_##isa##_double;
SUMS_DECLARE(baseline)
SUMS_DECLARE(v3)
SUMS_DECLARE(v4)
#undef SUMS_DECLARE

contact_sums_sweep *contact_sums_of(enum isa isa)
{
    static contact_sums_sweep *const all[ISAS] = ISA_TABLE(contact_sums, double);
    return all[isa];
}

/** Smoothed values at the contact's closest point over all particles of the moving block, particle @p i
 * always included. */
static void values_at(const struct sliding *s, const struct fluid_view *view, uint32_t i,
                      struct contact *contact)
{
    const bool one_sided = !s->paper && contact->front;
    struct contact_sums_task task = {.kernel = &view->kernel,
                                     .particles = view->particles,
                                     .list = s->work[contact->lister].list + contact->listed,
                                     .n = contact->n_listed,
                                     .self = i,
                                     .per_ramp = one_sided ? 1.0 / (FRONT_RAMP * view->spacing) : 0.0};
    struct contact_sums sums;
    memcpy(task.c, contact->c, sizeof task.c);
    memcpy(task.period, s->period, sizeof task.period);
    memcpy(task.normal, contact->normal, sizeof task.normal);
    contact_sums_of(view->isa)(&task, &sums);
    const double inverse = 1.0 / sums.weight;
    contact->mean_p = sums.p * inverse;
    contact->mean_rho = sums.rho * inverse;
    for (int k = 0; k < 3; ++k) {
        contact->mean_u[k] = sums.u[k] * inverse;
        contact->mean_r[k] = contact->c[k] + sums.r[k] * inverse;
    }
    contact->layer = -dot(sums.r, contact->e_r) * inverse;
    if (!s->paper)
        contact->layer = fmax(contact->layer, LEAST_LAYER * view->spacing);
}

/** In-plane axes of the block: in 2-D in the plane of the problem. */
static void block_axes(int dim, const double e_r[3], double e_s[3], double e_t[3])
{
    memset(e_s, 0, 3 * sizeof *e_s);
    memset(e_t, 0, 3 * sizeof *e_t);
    if (dim == 2) {
        e_s[0] = -e_r[1];
        e_s[1] = e_r[0];
    } else if (dim == 3) {
        int least = 0;
        for (int k = 1; k < 3; ++k)
            if (fabs(e_r[k]) < fabs(e_r[least]))
                least = k;
        double length = sqrt(1.0 - e_r[least] * e_r[least]);
        int a = (least + 1) % 3, b = (least + 2) % 3;
        e_s[a] = -e_r[b] / length;
        e_s[b] = e_r[a] / length;
        for (int k = 0; k < 3; ++k)
            e_t[k] = e_r[(k + 1) % 3] * e_s[(k + 2) % 3] - e_r[(k + 2) % 3] * e_s[(k + 1) % 3];
    }
}

/** Linear pressure field behind the wall, from the sums of the contact's source (eqs. 33, 34). */
static void contact_pressure(const struct sliding *s, const struct fluid_view *view,
                             const struct contact *source, struct contact *contact)
{
    double from[3];
    for (int k = 0; k < 3; ++k) {
        contact->gradient[k] = s->gradient ? source->mean_rho * (view->body_force[k] - source->a[k]) : 0.0;
        from[k] = contact->o[k] - source->mean_r[k];
    }
    contact->p0 = source->mean_p + dot(from, contact->gradient);
}

/** What the viscous term needs of the sums of another contact. */
static void contact_borrow(const struct fluid_view *view, const struct contact *source,
                           struct contact *contact)
{
    double to[3];
    for (int k = 0; k < 3; ++k) {
        to[k] = contact->c[k] - source->mean_r[k];
        contact->mean_u[k] = source->mean_u[k];
    }
    contact->layer = fmax(dot(to, contact->e_r), LEAST_LAYER * view->spacing);
}

/** List particles for the sums of a near particle's contacts that have none or have moved. */
static int near_lists(struct boundary *boundary, const struct fluid_view *view, size_t near)
{
    const struct sliding *s = boundary->data;
    struct contact *contacts = &s->contacts[s->contact_start[near]];
    const double margin = LIST_MARGIN * view->spacing;
    for (size_t k = 0; k < s->contact_count[near]; ++k) {
        struct contact *contact = &contacts[k];
        double moved[3];
        for (int d = 0; d < 3; ++d)
            moved[d] = contact->c[d] - contact->listed_c[d];
        if (contact->source == (int32_t)k &&
            (contact->n_listed == 0 || !(dot(moved, moved) < margin * margin)))
            CALL(contact_list(s, view, (uint32_t)omp_get_thread_num(), contact));
    }
    return 0;
}

/** Values behind the contacts of a near particle. */
static void near_values(struct boundary *boundary, const struct fluid_view *view, size_t near)
{
    const struct sliding *s = boundary->data;
    struct contact *contacts = &s->contacts[s->contact_start[near]];
    const size_t n = s->contact_count[near];
    for (size_t k = 0; k < n; ++k)
        if (contacts[k].source == (int32_t)k)
            values_at(s, view, boundary->near[near], &contacts[k]);
    for (size_t k = 0; k < n; ++k) {
        const struct contact *source = &contacts[contacts[k].source];
        contact_pressure(s, view, source, &contacts[k]);
        if (contacts[k].front && source != &contacts[k])
            contact_borrow(view, source, &contacts[k]);
    }
}

int sliding_close(struct boundary *boundary, const struct fluid_view *view)
{
    int status = 0;
    /* a list grows in the place of the thread that makes it, and is read by any: all are made first */
#pragma omp parallel for schedule(dynamic, 16) reduction(| : status)
    for (size_t near = 0; near < boundary->n_near; ++near)
        if (!status)
            status = near_lists(boundary, view, near);
    CALL(status);
#pragma omp parallel for schedule(dynamic, 16)
    for (size_t near = 0; near < boundary->n_near; ++near)
        near_values(boundary, view, near);
    return 0;
}

void sliding_touch_direction(const struct contact *contact, const struct touch *touches, uint32_t t,
                             double e_r[3])
{
    const double side = contact->front ? -1.0 : 1.0;
    for (int k = 0; k < 3; ++k)
        e_r[k] = t == 0 ? contact->e_r[k] : side * touches[t].piece->normal[k];
}

/** Append the block behind touch @p t of a contact; @p source is the contact's number. */
static void pack_block(const struct sliding *s, const struct fluid_view *view, const struct contact *contact,
                       const struct touch *touches, uint32_t t, int32_t source, double mass,
                       struct wall_neighbours *out)
{
    const struct kernel *kernel = &view->kernel;
    const struct touch *touch = &touches[t];
    const int q = s->shares.layers, side = view->dim > 1 ? q - 1 : 0, depth = view->dim > 2 ? q - 1 : 0;
    const double dx = view->spacing, rc2 = kernel->support * kernel->support,
                 per_c2 = 1.0 / (view->sound_speed * view->sound_speed);
    const double *gradient = contact->gradient;
    double e_r[3], e_s[3], e_t[3], p0 = contact->p0;
    sliding_touch_direction(contact, touches, t, e_r);
    block_axes(view->dim, e_r, e_s, e_t);
    for (int k = 0; k < 3 && t > 0; ++k) /* from the foot point on the first plane to that on this one */
        p0 += (touch->d * e_r[k] - contact->d * contact->e_r[k]) * gradient[k];
    const double slope[3] = {dx * dot(e_r, gradient), dx * dot(e_s, gradient), dx * dot(e_t, gradient)};
    for (int m = 0; m < q; ++m) {
        const double height = (m + 0.5) * dx, y = touch->d + height;
        const double f = touch->weight[SHARE_VISCOUS] != 0.0 ? height / contact->layer : 0.0;
        for (int a = -side; a <= side; ++a)
            for (int b = -depth; b <= depth; ++b) {
                const double r2 = y * y + (double)(a * a + b * b) * dx * dx;
                if (r2 >= rc2)
                    continue;
                const size_t n = out->n++;
                const double r = sqrt(r2);
                out->r[n] = r;
                out->w[n] = kernel_w(kernel, r);
                out->dw[n] = kernel_dw(kernel, r);
                out->p[n] = p0 + (m + 0.5) * slope[0] + a * slope[1] + b * slope[2];
                out->rho[n] = out->p[n] * per_c2 + view->density;
                out->volume[n] = mass / out->rho[n];
                for (int k = 0; k < 3; ++k) {
                    out->dx[k][n] = -(y * e_r[k] + a * dx * e_s[k] + b * dx * e_t[k]);
                    out->u[k][n] = contact->u[k];
                    out->u_viscous[k][n] = (1.0 + f) * contact->u[k] - f * contact->mean_u[k];
                    out->a[k][n] = contact->a[k];
                    out->normal[k][n] = contact->normal[k];
                }
                out->share_density[n] = touch->weight[SHARE_DENSITY];
                out->share_pressure[n] = touch->weight[SHARE_PRESSURE];
                out->share_viscous[n] = touch->weight[SHARE_VISCOUS];
                out->source[n] = source;
            }
    }
}

/** Append a neighbour that stands for many particles behind a contact: all but its places and weights. */
static size_t pack_common(const struct fluid_view *view, const struct contact *contact, double mass, double p,
                          int32_t source, struct wall_neighbours *out)
{
    const size_t n = out->n++;
    out->p[n] = p;
    out->rho[n] = p / (view->sound_speed * view->sound_speed) + view->density;
    out->volume[n] = mass / out->rho[n];
    for (int k = 0; k < 3; ++k) {
        out->u[k][n] = out->u_viscous[k][n] = contact->u[k];
        out->a[k][n] = contact->a[k];
        out->normal[k][n] = contact->normal[k];
    }
    out->share_density[n] = out->share_viscous[n] = 0.0;
    out->share_pressure[n] = 1.0;
    out->source[n] = source;
    return n;
}

/** What the layers' particles at both sides of their middles add up to: share_pressure W' s^2/r, and the
 * pressure in the middle. */
struct tangent_sums {
    double sum, p;
};

/** Append two neighbours at one spacing on either side that stand for what the pressure's gradient along the
 * wall does. */
static void pack_tangents(const struct fluid_view *view, const struct contact *contact,
                          const struct tangent_sums *tangent, double mass, int32_t source,
                          struct wall_neighbours *out)
{
    const double dx = view->spacing, across = dot(contact->gradient, contact->e_r);
    double along[3], slope = 0.0;
    for (int k = 0; k < 3; ++k) {
        along[k] = contact->gradient[k] - across * contact->e_r[k];
        slope += along[k] * along[k];
    }
    slope = sqrt(slope);
    for (int side = -1; side <= 1 && slope > 0.0; side += 2) {
        const size_t n = pack_common(view, contact, mass, tangent->p + side * dx * slope, source, out);
        out->r[n] = dx;
        out->w[n] = 0.0;
        out->dw[n] = 0.5 * tangent->sum / dx;
        for (int k = 0; k < 3; ++k)
            out->dx[k][n] = -side * dx * along[k] / slope;
    }
}

/** Append the blocks of a contact by the moments of their layers instead of their particles: one neighbour
 * right behind the wall for each layer, and (pack_tangents) two beside it where the pressure varies along the
 * wall. To first order in that variation the sums are the blocks'. */
static void pack_layers(const struct sliding *s, const struct fluid_view *view, const struct contact *contact,
                        const struct layer_sums *layers, int32_t source, double mass,
                        struct wall_neighbours *out, struct tangent_sums *tangent)
{
    const double dx = view->spacing;
    *tangent = (struct tangent_sums){0.0, 0.0};
    for (int m = 0; m < s->shares.layers; ++m) {
        const double height = (m + 0.5) * dx, f = height / contact->layer;
        const struct layer_sums *sums = &layers[m];
        const double length = sqrt(dot(sums->normal, sums->normal));
        if (!(length > 0.0) && sums->viscous == 0.0)
            break;
        double p = contact->p0, r = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double place = sums->strength != 0.0 ? sums->place[k] / sums->strength
                                                       : (contact->d + height) * contact->e_r[k];
            p += (place - contact->d * contact->e_r[k]) * contact->gradient[k];
            r -= length > 0.0 ? place * sums->normal[k] / length : -place * contact->e_r[k];
        }
        const size_t n = pack_common(view, contact, mass, p, source, out);
        /* the sum points from the particle, or towards it where facets seen from behind take away */
        const double sign = r < 0.0 ? -1.0 : 1.0;
        out->r[n] = fabs(r);
        out->w[n] = sums->kernel;
        out->dw[n] = length > 0.0 ? -sign * length : sums->viscous * r;
        out->share_density[n] = 1.0;
        out->share_pressure[n] = length > 0.0;
        out->share_viscous[n] = sums->viscous * fabs(r) / out->dw[n];
        for (int k = 0; k < 3; ++k) {
            out->dx[k][n] = length > 0.0 ? sign * fabs(r) * sums->normal[k] / length : -r * contact->e_r[k];
            if (sums->viscous != 0.0)
                out->u_viscous[k][n] = (1.0 + f) * contact->u[k] - f * contact->mean_u[k];
        }
        tangent->sum += sums->tangent;
        tangent->p += sums->tangent * p;
    }
    if (tangent->sum != 0.0)
        tangent->p /= tangent->sum;
}

/** Touches, and layers, of contact @p contact of a near particle. */
static const struct touch *touches_of(const struct sliding *s, size_t near, const struct contact *contact)
{
    return &s->touches[s->touch_start[near] + contact->first];
}

static const struct layer_sums *layers_of(const struct sliding *s, const struct contact *contact)
{
    return &s->layers[(size_t)(contact - s->contacts) * (size_t)s->shares.layers];
}

int sliding_gather(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                   struct wall_neighbours *neighbours)
{
    const struct sliding *s = boundary->data;
    const struct contact *contacts = &s->contacts[s->contact_start[near]];
    const size_t n = s->contact_count[near];
    const double mass = view->particles->m[boundary->near[near]];
    CALL(wall_neighbours_reserve(neighbours, n * s->block));
    neighbours->n = 0;
    for (size_t k = 0; k < n; ++k) {
        struct tangent_sums tangent;
        if (!s->layered) {
            pack_block(s, view, &contacts[k], touches_of(s, near, &contacts[k]), 0, (int32_t)k, mass,
                       neighbours);
            continue;
        }
        pack_layers(s, view, &contacts[k], layers_of(s, &contacts[k]), (int32_t)k, mass, neighbours,
                    &tangent);
        pack_tangents(view, &contacts[k], &tangent, mass, (int32_t)k, neighbours);
    }
    return 0;
}

int sliding_unfold(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                   struct wall_neighbours *neighbours)
{
    const struct sliding *s = boundary->data;
    const struct contact *contacts = &s->contacts[s->contact_start[near]];
    const double mass = view->particles->m[boundary->near[near]];
    CALL(wall_neighbours_reserve(neighbours, s->touch_count[near] * s->block));
    neighbours->n = 0;
    for (size_t k = 0; k < s->contact_count[near]; ++k)
        for (uint32_t t = 0; t < contacts[k].n_touches; ++t)
            pack_block(s, view, &contacts[k], touches_of(s, near, &contacts[k]), t, (int32_t)k, mass,
                       neighbours);
    return 0;
}

void sliding_react(struct boundary *boundary, size_t near, const struct wall_neighbours *neighbours,
                   double *const force[3])
{
    const struct sliding *s = boundary->data;
    struct contact *contacts = &s->contacts[s->contact_start[near]];
    for (size_t k = 0; k < s->contact_count[near]; ++k)
        contacts[k].force[0] = contacts[k].force[1] = contacts[k].force[2] = 0.0;
    for (size_t n = 0; n < neighbours->n; ++n)
        for (int k = 0; k < 3; ++k)
            contacts[neighbours->source[n]].force[k] -= force[k][n];
}

/** Spread a contact's force over the points of its surface, in one of its parts. */
static void contact_load(const struct sliding *s, size_t near, const struct surface *surface, size_t part,
                         const struct contact *contact)
{
    const struct anchor *rows = sliding_rows(s, near, contact);
    double(*load)[3] = surface->part[part];
    for (uint32_t r = 0; r < contact->n_rows; ++r)
        for (int k = 0; k < 3; ++k)
            load[rows[r].point][k] += rows[r].weight * contact->force[k];
}

/** Moment of a contact's force about the centre of its analytic surface. */
static void contact_moment(const struct sliding *s, struct surface *surface, const struct contact *contact)
{
    double arm[3];
    for (int k = 0; k < 3; ++k)
        arm[k] = contact->c[k] - contact->shift[k] - s->shapes[contact->surface].centre[k];
    for (int k = 0; k < 3; ++k) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        surface->moment[k] += arm[a] * contact->force[b] - arm[b] * contact->force[a];
    }
}

/** The momentum of particles put back in this step acts as a force over the step. */
static void pending_load(const struct sliding *s, struct boundary *boundary, double dt)
{
    for (size_t k = 0; k < boundary->n_surfaces; ++k) {
        struct surface *surface = boundary->surfaces[k];
        for (size_t i = 0; i < surface->n_points; ++i)
            for (int d = 0; d < 3; ++d)
                surface->load[i][d] += s->pending[k][i][d] / dt;
        for (int d = 0; d < 3; ++d)
            surface->moment[d] += s->pending_moment[k][d] / dt;
    }
}

/** Loads of part @p part of the near particles. */
static void part_load(const struct boundary *boundary, size_t part)
{
    const struct sliding *s = boundary->data;
    const size_t begin = boundary->n_near * part / SURFACE_PARTS,
                 end = boundary->n_near * (part + 1) / SURFACE_PARTS;
    for (size_t near = begin; near < end; ++near)
        for (size_t k = 0; k < s->contact_count[near]; ++k) {
            const struct contact *contact = &s->contacts[s->contact_start[near] + k];
            contact_load(s, near, boundary->surfaces[contact->surface], part, contact);
        }
}

void sliding_load(struct boundary *boundary, const struct fluid_view *view)
{
    const struct sliding *s = boundary->data;
#pragma omp parallel for schedule(static, 1)
    for (size_t part = 0; part < SURFACE_PARTS; ++part)
        part_load(boundary, part);
    bool analytic = false;
    for (size_t k = 0; k < boundary->n_surfaces; ++k) {
        surface_sum_parts(boundary->surfaces[k], boundary->surfaces[k]->load);
        analytic |= boundary->surfaces[k]->definition->kind != SURFACE_FACETS;
    }
    for (size_t near = 0; near < boundary->n_near && analytic; ++near)
        for (size_t k = 0; k < s->contact_count[near]; ++k) {
            const struct contact *contact = &s->contacts[s->contact_start[near] + k];
            struct surface *surface = boundary->surfaces[contact->surface];
            if (surface->definition->kind != SURFACE_FACETS)
                contact_moment(s, surface, contact);
        }
    if (boundary->put_back_count > 0 && view->dt > 0.0)
        pending_load(s, boundary, view->dt);
}

/** T = -sum_k (V_i^2 + V_k^2) W' w_g rho_i / (rho_i + rho_k) <rho> e_k (x) (r_k - <r>), e_k from the particle
 * to k; D = -sum_k (V_i^2 + V_k^2) W'/r w_v eta (1 + f). @p same: the accelerations are of the same surface.
 */
static void contact_tensor(const struct sliding *s, const struct fluid_view *view, uint32_t i,
                           const struct contact *contact, const struct contact *source, bool same,
                           const struct wall_neighbours *block, double tangent,
                           struct added_mass_contact *out)
{
    const double rho = view->particles->rho[i], volume = view->particles->m[i] / rho;
    double from[3];
    for (int k = 0; k < 3; ++k)
        from[k] = contact->o[k] - contact->d * contact->e_r[k] - source->mean_r[k];
    const bool accelerated = same && s->gradient;
    /* the layers' own particles stand for theirs on both sides */
    const double beside = accelerated ? -volume * volume * tangent * source->mean_rho : 0.0;
    for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
            out->tensor[k][l] = beside * ((k == l) - contact->e_r[k] * contact->e_r[l]);
    out->damping = 0.0;
    for (size_t n = 0; n < block->n; ++n) {
        const double pair =
            (volume * volume + block->volume[n] * block->volume[n]) * block->dw[n] / block->r[n];
        const double factor =
            pair * block->share_pressure[n] * rho / (rho + block->rho[n]) * source->mean_rho;
        for (int k = 0; k < 3 && accelerated; ++k)
            for (int l = 0; l < 3; ++l)
                out->tensor[k][l] += factor * block->dx[k][n] * (from[l] - block->dx[l][n]);
        if (block->share_viscous[n] != 0.0) {
            double height = -contact->d;
            for (int k = 0; k < 3; ++k)
                height -= block->dx[k][n] * contact->e_r[k];
            out->damping -=
                pair * block->share_viscous[n] * view->viscosity * (1.0 + height / contact->layer);
        }
    }
}

/** Number the contacts with surfaces of solids, and lay out their anchors. */
static int reserve_tensors(struct boundary *boundary)
{
    const struct sliding *s = boundary->data;
    for (size_t k = 0; k < boundary->n_surfaces; ++k)
        boundary->surfaces[k]->n_added_mass = boundary->surfaces[k]->n_anchors = 0;
    for (size_t near = 0; near < boundary->n_near; ++near) {
        struct contact *contacts = &s->contacts[s->contact_start[near]];
        for (size_t k = 0; k < s->contact_count[near]; ++k) {
            struct surface *surface = boundary->surfaces[contacts[k].surface];
            contacts[k].tensor = surface->coupled ? surface->n_added_mass++ : SIZE_MAX;
            surface->n_anchors += surface->coupled ? contacts[k].n_rows : 0;
        }
    }
    for (size_t k = 0; k < boundary->n_surfaces; ++k) {
        struct surface *surface = boundary->surfaces[k];
        CALL(surface_added_mass_reserve(surface));
        surface->n_anchors = 0;
    }
    for (size_t near = 0; near < boundary->n_near; ++near) {
        const struct contact *contacts = &s->contacts[s->contact_start[near]];
        for (size_t k = 0; k < s->contact_count[near]; ++k) {
            struct surface *surface = boundary->surfaces[contacts[k].surface];
            if (!surface->coupled)
                continue;
            surface->added_mass[contacts[k].tensor].row = surface->n_anchors;
            surface->n_anchors += contacts[k].n_rows;
        }
    }
    return 0;
}

/** Rows, then tensors of the contacts of a near particle. */
static int near_tensors(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                        struct wall_neighbours *block)
{
    const struct sliding *s = boundary->data;
    const struct contact *contacts = &s->contacts[s->contact_start[near]];
    const uint32_t i = boundary->near[near];
    CALL(wall_neighbours_reserve(block, s->block));
    for (size_t k = 0; k < s->contact_count[near]; ++k) {
        const struct surface *surface = boundary->surfaces[contacts[k].surface];
        if (contacts[k].tensor == SIZE_MAX)
            continue;
        struct added_mass_contact *out = &surface->added_mass[contacts[k].tensor];
        out->n_rows = contacts[k].n_rows;
        memcpy(&surface->anchors[out->row], sliding_rows(s, near, &contacts[k]),
               out->n_rows * sizeof *surface->anchors);
    }
    for (size_t k = 0; k < s->contact_count[near]; ++k) {
        const struct contact *contact = &contacts[k], *source = &contacts[contact->source];
        if (contact->tensor == SIZE_MAX)
            continue;
        struct added_mass_contact *list = boundary->surfaces[contact->surface]->added_mass,
                                  *out = &list[contact->tensor];
        const bool same = contact->surface == source->surface;
        out->column = same ? list[source->tensor].row : out->row;
        out->n_columns = same ? list[source->tensor].n_rows : out->n_rows;
        struct tangent_sums tangent = {0.0, 0.0};
        block->n = 0;
        if (s->layered)
            pack_layers(s, view, contact, layers_of(s, contact), (int32_t)k, view->particles->m[i], block,
                        &tangent);
        else
            pack_block(s, view, contact, touches_of(s, near, contact), 0, (int32_t)k, view->particles->m[i],
                       block);
        contact_tensor(s, view, i, contact, source, same, block, tangent.sum, out);
    }
    return 0;
}

int sliding_added_mass(struct boundary *boundary, const struct fluid_view *view)
{
    const struct sliding *s = boundary->data;
    CALL(reserve_tensors(boundary));
    int status = 0;
#pragma omp parallel for schedule(dynamic, 16) reduction(| : status)
    for (size_t near = 0; near < boundary->n_near; ++near)
        if (!status)
            status = near_tensors(boundary, view, near, &s->work[omp_get_thread_num()].neighbours);
    return status;
}
