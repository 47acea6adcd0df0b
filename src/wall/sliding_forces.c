// SPDX-License-Identifier: GPL-3.0-or-later
// Values of virtual boundary particles by extrapolation from the fluid (paper 000 eqs. 32-38), packed
// neighbours for the fluid's sweep, and loads (eqs. 41-42).
#include "wall/sliding_particles.h"

#include "base/error.h"
#include "base/memory.h"

#include <omp.h>
#include <string.h>

/** Fluid counts in the sums at a contact by its distance in front of the plane: from 0 at the plane to 1 at
 * this (of dx). */
#define FRONT_RAMP 0.1
/** Least distance of the centroid from the wall (of dx). */
#define LEAST_LAYER 0.5

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Smoothed values at the contact's closest point over all particles of the moving block, particle @p i
 * always included. */
static void contact_sums(const struct sliding *s, const struct fluid_view *view, uint32_t i,
                         struct contact *contact)
{
    const struct particles *particles = view->particles;
    const double *x = particles->x[0], *y = particles->x[1], *z = particles->x[2];
    const double *c = contact->c, *normal = contact->normal;
    const double rc = view->kernel.support, per_ramp = 1.0 / (FRONT_RAMP * view->spacing);
    const bool one_sided = !s->paper && contact->front;
    struct cell_range ranges[CELL_GRID_RANGES];
    size_t n_ranges = cell_grid_ranges(view->grid, c, rc, ranges);
    double sum = 0.0, p = 0.0, rho = 0.0, u[3] = {0.0, 0.0, 0.0}, r[3] = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < n_ranges; ++k) {
        const double o[3] = {ranges[k].shift[0] - c[0], ranges[k].shift[1] - c[1], ranges[k].shift[2] - c[2]};
        for (uint32_t j = ranges[k].begin; j < ranges[k].end; ++j) {
            const double dx = x[j] + o[0], dy = y[j] + o[1], dz = z[j] + o[2],
                         r2 = dx * dx + dy * dy + dz * dz;
            if (r2 >= rc * rc)
                continue;
            double w = kernel_w(&view->kernel, sqrt(r2));
            if (one_sided && j != i) {
                double height = (dx * normal[0] + dy * normal[1] + dz * normal[2]) * per_ramp;
                if (height <= 0.0)
                    continue;
                w *= fmin(1.0, height);
            }
            sum += w;
            p += w * particles->p[j];
            rho += w * particles->rho[j];
            u[0] += w * particles->u[0][j];
            u[1] += w * particles->u[1][j];
            u[2] += w * particles->u[2][j];
            r[0] += w * dx;
            r[1] += w * dy;
            r[2] += w * dz;
        }
    }
    contact->mean_p = p / sum;
    contact->mean_rho = rho / sum;
    for (int k = 0; k < 3; ++k) {
        contact->mean_u[k] = u[k] / sum;
        contact->mean_r[k] = c[k] + r[k] / sum;
    }
    contact->layer = -dot(r, contact->e_r) / sum;
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

/** Linear pressure field in the block, from the sums of the contact's source (eqs. 33, 34). */
static void contact_pressure(const struct sliding *s, const struct fluid_view *view,
                             const struct contact *source, struct contact *contact)
{
    double gradient[3], e_s[3], e_t[3], from[3];
    for (int k = 0; k < 3; ++k) {
        gradient[k] = s->gradient ? source->mean_rho * (view->body_force[k] - source->a[k]) : 0.0;
        from[k] = contact->o[k] - source->mean_r[k];
    }
    block_axes(view->dim, contact->e_r, e_s, e_t);
    contact->p0 = source->mean_p + dot(from, gradient);
    contact->p_slope[0] = view->spacing * dot(contact->e_r, gradient);
    contact->p_slope[1] = view->spacing * dot(e_s, gradient);
    contact->p_slope[2] = view->spacing * dot(e_t, gradient);
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

int sliding_close(struct boundary *boundary, const struct fluid_view *view)
{
    const struct sliding *s = boundary->data;
#pragma omp parallel for schedule(dynamic, 16)
    for (size_t near = 0; near < boundary->n_near; ++near) {
        struct contact *contacts = &s->contacts[s->contact_start[near]];
        const size_t n = s->contact_count[near];
        for (size_t k = 0; k < n; ++k)
            if (contacts[k].source == (int32_t)k)
                contact_sums(s, view, boundary->near[near], &contacts[k]);
        for (size_t k = 0; k < n; ++k) {
            const struct contact *source = &contacts[contacts[k].source];
            contact_pressure(s, view, source, &contacts[k]);
            if (contacts[k].front && source != &contacts[k])
                contact_borrow(view, source, &contacts[k]);
        }
    }
    return 0;
}

/** Append the block of a contact; @p source is its number. */
static void pack_block(const struct sliding *s, const struct fluid_view *view, const struct contact *contact,
                       int32_t source, double mass, struct wall_neighbours *out)
{
    const struct kernel *kernel = &view->kernel;
    const int q = s->shares.layers, side = view->dim > 1 ? q - 1 : 0, depth = view->dim > 2 ? q - 1 : 0;
    const double dx = view->spacing, rc2 = kernel->support * kernel->support,
                 per_c2 = 1.0 / (view->sound_speed * view->sound_speed);
    double e_s[3], e_t[3];
    block_axes(view->dim, contact->e_r, e_s, e_t);
    for (int m = 0; m < q; ++m) {
        const double height = (m + 0.5) * dx, y = contact->d + height;
        const double f = contact->weight[SHARE_VISCOUS] != 0.0 ? height / contact->layer : 0.0;
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
                out->p[n] = contact->p0 + (m + 0.5) * contact->p_slope[0] + a * contact->p_slope[1] +
                            b * contact->p_slope[2];
                out->rho[n] = out->p[n] * per_c2 + view->density;
                out->volume[n] = mass / out->rho[n];
                for (int k = 0; k < 3; ++k) {
                    out->dx[k][n] = -(y * contact->e_r[k] + a * dx * e_s[k] + b * dx * e_t[k]);
                    out->u[k][n] = contact->u[k];
                    out->u_viscous[k][n] = (1.0 + f) * contact->u[k] - f * contact->mean_u[k];
                    out->a[k][n] = contact->a[k];
                    out->normal[k][n] = contact->normal[k];
                }
                out->share_density[n] = contact->weight[SHARE_DENSITY];
                out->share_pressure[n] = contact->weight[SHARE_PRESSURE];
                out->share_viscous[n] = contact->weight[SHARE_VISCOUS];
                out->source[n] = source;
            }
    }
}

/** What a neighbour of a contact's block does not share with its place. */
static void pack_common(const struct contact *contact, double mass, double p, double density, double per_c2,
                        int32_t source, struct wall_neighbours *out, size_t n)
{
    out->p[n] = p;
    out->rho[n] = p * per_c2 + density;
    out->volume[n] = mass / out->rho[n];
    for (int k = 0; k < 3; ++k) {
        out->u[k][n] = out->u_viscous[k][n] = contact->u[k];
        out->a[k][n] = contact->a[k];
        out->normal[k][n] = contact->normal[k];
    }
    out->share_density[n] = 0.0;
    out->share_pressure[n] = contact->weight[SHARE_PRESSURE];
    out->share_viscous[n] = 0.0;
    out->source[n] = source;
}

/** Append two neighbours at one spacing on either side along @p axis that stand for what a layer's pressure
 * gradient along it does. */
static void pack_tangents(const struct fluid_view *view, const struct contact *contact,
                          const double moments[LAYER_MOMENTS], double p, double slope, const double axis[3],
                          double mass, int32_t source, struct wall_neighbours *out)
{
    const double dx = view->spacing, per_c2 = 1.0 / (view->sound_speed * view->sound_speed);
    for (int side = -1; side <= 1; side += 2) {
        const size_t n = out->n++;
        pack_common(contact, mass, p + side * slope, view->density, per_c2, source, out, n);
        out->r[n] = dx;
        out->w[n] = 0.0;
        out->dw[n] = 0.5 * moments[LAYER_TANGENT] / dx;
        for (int k = 0; k < 3; ++k)
            out->dx[k][n] = -side * dx * axis[k];
    }
}

/** Append the block of a contact by the moments of its layers instead of its particles: one neighbour right
 * behind the wall for each layer, and four beside it where the pressure varies along the wall. To first order
 * in that variation the sums are the block's. */
static void pack_layers(const struct sliding *s, const struct fluid_view *view, const struct contact *contact,
                        int32_t source, double mass, struct wall_neighbours *out)
{
    const double dx = view->spacing, per_c2 = 1.0 / (view->sound_speed * view->sound_speed);
    double e_s[3], e_t[3];
    block_axes(view->dim, contact->e_r, e_s, e_t);
    for (int m = 0; m < s->shares.layers; ++m) {
        const double height = (m + 0.5) * dx, y = contact->d + height;
        const double p = contact->p0 + (m + 0.5) * contact->p_slope[0], f = height / contact->layer;
        double moments[LAYER_MOMENTS];
        facet_shares_layer(&s->shares, y, moments);
        if (!(moments[LAYER_NORMAL] < 0.0))
            break;
        const size_t n = out->n++;
        pack_common(contact, mass, p, view->density, per_c2, source, out, n);
        out->r[n] = y;
        out->w[n] = moments[LAYER_W];
        out->dw[n] = moments[LAYER_NORMAL];
        out->share_density[n] = contact->weight[SHARE_DENSITY];
        out->share_viscous[n] =
            contact->weight[SHARE_VISCOUS] * moments[LAYER_VISCOUS] * y / moments[LAYER_NORMAL];
        for (int k = 0; k < 3; ++k) {
            out->dx[k][n] = -y * contact->e_r[k];
            if (contact->weight[SHARE_VISCOUS] != 0.0)
                out->u_viscous[k][n] = (1.0 + f) * contact->u[k] - f * contact->mean_u[k];
        }
        if (contact->p_slope[1] != 0.0)
            pack_tangents(view, contact, moments, p, contact->p_slope[1], e_s, mass, source, out);
        if (contact->p_slope[2] != 0.0)
            pack_tangents(view, contact, moments, p, contact->p_slope[2], e_t, mass, source, out);
    }
}

/** Append what stands for the block of a contact in the sweeps: in 3-D its layers, except where walls are as
 * published. */
static void pack(const struct sliding *s, const struct fluid_view *view, const struct contact *contact,
                 int32_t source, double mass, struct wall_neighbours *out)
{
    if (view->dim == 3 && !s->paper)
        pack_layers(s, view, contact, source, mass, out);
    else
        pack_block(s, view, contact, source, mass, out);
}

static int gather(const struct boundary *boundary, const struct fluid_view *view, size_t near, bool unfolded,
                  struct wall_neighbours *neighbours)
{
    const struct sliding *s = boundary->data;
    const struct contact *contacts = &s->contacts[s->contact_start[near]];
    const size_t n = s->contact_count[near];
    const double mass = view->particles->m[boundary->near[near]];
    CALL(wall_neighbours_reserve(neighbours, n * s->block));
    neighbours->n = 0;
    for (size_t k = 0; k < n; ++k)
        (unfolded ? pack_block : pack)(s, view, &contacts[k], (int32_t)k, mass, neighbours);
    return 0;
}

int sliding_gather(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                   struct wall_neighbours *neighbours)
{
    return gather(boundary, view, near, false, neighbours);
}

int sliding_unfold(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                   struct wall_neighbours *neighbours)
{
    return gather(boundary, view, near, true, neighbours);
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

/** Spread a contact's force over the points of its surface. */
static void contact_load(const struct sliding *s, struct surface *surface, const struct contact *contact)
{
    for (int j = 0; j < SIDE_MAX_NODES && contact->nodes[j] >= 0; ++j)
        for (int k = 0; k < 3; ++k)
            surface->load[contact->nodes[j]][k] += contact->nodes_weight[j] * contact->force[k];
    if (surface->definition->kind == SURFACE_FACETS)
        return;
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

void sliding_load(struct boundary *boundary, const struct fluid_view *view)
{
    const struct sliding *s = boundary->data;
    for (size_t near = 0; near < boundary->n_near; ++near)
        for (size_t k = 0; k < s->contact_count[near]; ++k) {
            const struct contact *contact = &s->contacts[s->contact_start[near] + k];
            contact_load(s, boundary->surfaces[contact->surface], contact);
        }
    if (boundary->put_back_count > 0 && view->dt > 0.0)
        pending_load(s, boundary, view->dt);
}

/** T = -sum_k (V_i^2 + V_k^2) W' w_g rho_i / (rho_i + rho_k) <rho> e_k (x) (r_k - <r>), e_k from the particle
 * to k. */
static void contact_tensor(const struct fluid_view *view, uint32_t i, const struct contact *contact,
                           const struct contact *source, const struct wall_neighbours *block,
                           double tensor[3][3])
{
    const double rho = view->particles->rho[i], volume = view->particles->m[i] / rho;
    double from[3];
    for (int k = 0; k < 3; ++k)
        from[k] = contact->o[k] - contact->d * contact->e_r[k] - source->mean_r[k];
    memset(tensor, 0, 9 * sizeof(double));
    for (size_t n = 0; n < block->n; ++n) {
        double factor = (volume * volume + block->volume[n] * block->volume[n]) * block->dw[n] *
                        block->share_pressure[n] * rho / (rho + block->rho[n]) * source->mean_rho /
                        block->r[n];
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
                tensor[k][l] += factor * block->dx[k][n] * (from[l] - block->dx[l][n]);
    }
}

/** Whether a contact's load depends on the acceleration of its own surface. */
static bool has_tensor(const struct boundary *boundary, const struct contact *contact,
                       const struct contact *source)
{
    return boundary->surfaces[contact->surface]->coupled && contact->surface == source->surface &&
           contact->weight[SHARE_PRESSURE] != 0.0;
}

static int reserve_tensors(struct boundary *boundary)
{
    const struct sliding *s = boundary->data;
    for (size_t k = 0; k < boundary->n_surfaces; ++k)
        boundary->surfaces[k]->n_added_mass = 0;
    for (size_t near = 0; s->gradient && near < boundary->n_near; ++near) {
        struct contact *contacts = &s->contacts[s->contact_start[near]];
        for (size_t k = 0; k < s->contact_count[near]; ++k) {
            bool has = has_tensor(boundary, &contacts[k], &contacts[contacts[k].source]);
            contacts[k].tensor = has ? boundary->surfaces[contacts[k].surface]->n_added_mass++ : SIZE_MAX;
        }
    }
    for (size_t k = 0; k < boundary->n_surfaces; ++k) {
        struct surface *surface = boundary->surfaces[k];
        CALL(memory_grow((void **)&surface->added_mass, &surface->added_mass_capacity, surface->n_added_mass,
                         sizeof *surface->added_mass));
    }
    return 0;
}

int sliding_added_mass(struct boundary *boundary, const struct fluid_view *view)
{
    const struct sliding *s = boundary->data;
    CALL(reserve_tensors(boundary));
    if (!s->gradient)
        return 0;
    int status = 0;
#pragma omp parallel for schedule(dynamic, 16) reduction(| : status)
    for (size_t near = 0; near < boundary->n_near; ++near) {
        struct wall_neighbours *block = &s->work[omp_get_thread_num()].neighbours;
        const uint32_t i = boundary->near[near];
        const struct contact *contacts = &s->contacts[s->contact_start[near]];
        for (size_t k = 0; k < s->contact_count[near]; ++k) {
            const struct contact *contact = &contacts[k], *source = &contacts[contact->source];
            if (contact->tensor == SIZE_MAX)
                continue;
            block->n = 0;
            if (wall_neighbours_reserve(block, s->block)) {
                status = STATUS_MEMORY;
                break;
            }
            pack(s, view, contact, (int32_t)k, view->particles->m[i], block);
            struct added_mass_contact *out =
                &boundary->surfaces[contact->surface]->added_mass[contact->tensor];
            memcpy(out->rows, contact->nodes, sizeof contact->nodes);
            memcpy(out->columns, source->nodes, sizeof source->nodes);
            memcpy(out->row_weights, contact->nodes_weight, sizeof contact->nodes_weight);
            memcpy(out->column_weights, source->nodes_weight, sizeof source->nodes_weight);
            out->rows[SIDE_MAX_NODES] = out->columns[SIDE_MAX_NODES] = -1;
            contact_tensor(view, i, contact, source, block, out->tensor);
        }
    }
    return status;
}
