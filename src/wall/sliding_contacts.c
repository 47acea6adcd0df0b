// SPDX-License-Identifier: GPL-3.0-or-later
// Contact points of near particles: where blocks of virtual particles stand, and with which weights (paper
// 000 section 3.3.2 for corners="paper"; facet shares otherwise).
#include "wall/sliding_particles.h"

#include "base/error.h"
#include "base/memory.h"

#include <omp.h>
#include <string.h>

/** Facets are coplanar if the cosine of their angle and their distances differ by less than this (of dx). */
#define COPLANAR_COSINE 1e-12
#define COPLANAR_DISTANCE 1e-6
/** A contact behind a facet stays there while it follows it (of dx). */
#define LEAST_BEHIND 1e-12
/** Cosine of the angle between facets up to which the sums at one serve the other, too (3-D). */
#define SHARED_COSINE 0.8660254037844386
/** A penetrated particle sees the wall from this far outside, and is put back so far outside (of dx). */
#define OUTSIDE_EVALUATE 1e-3
#define OUTSIDE_PUT_BACK 0.1

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double distance(const double a[3], const double b[3])
{
    double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(dot(r, r));
}

/** Exact closest point of an analytic surface to @p x (already in the surface's own image). */
static void shape_hit(const struct surface *surface, const struct sliding_shape *shape, const double x[3],
                      struct hit *hit)
{
    const struct model_surface *definition = surface->definition;
    double r[3] = {x[0] - shape->centre[0], x[1] - shape->centre[1], x[2] - shape->centre[2]};
    double along = dot(r, shape->axis), side = definition->fluid_inside ? -1.0 : 1.0;
    hit->at.feature = PROJECTION_INTERIOR;
    hit->at.closest[0] = hit->at.closest[1] = 0.0;
    if (definition->kind == SURFACE_PLANE) {
        hit->at.d = along;
        for (int k = 0; k < 3; ++k) {
            hit->normal[k] = shape->axis[k];
            hit->place[k] = x[k] - along * shape->axis[k];
        }
    } else {
        for (int k = 0; k < 3 && definition->kind == SURFACE_CYLINDER; ++k)
            r[k] -= along * shape->axis[k];
        double length = sqrt(dot(r, r));
        hit->at.d = side * (length - definition->radius);
        for (int k = 0; k < 3; ++k) {
            double e = length > 0.0 ? r[k] / length : k == 0;
            hit->normal[k] = side * e;
            hit->place[k] = x[k] + (definition->radius - length) * e;
        }
    }
    hit->at.distance = fabs(hit->at.d);
    for (int k = 0; k < 3; ++k)
        hit->place[k] += hit->shift[k];
}

/** A hit that is yet to be found. */
static struct hit *hit_start(struct hit *hit, const struct piece *piece, int32_t surface, int32_t facet,
                             const double shift[3])
{
    hit->piece = piece;
    hit->surface = surface;
    hit->facet = facet;
    memcpy(hit->shift, shift, sizeof hit->shift);
    return hit;
}

size_t sliding_hits(const struct boundary *boundary, size_t near, const double x[3], struct hit *hits)
{
    const struct sliding *s = boundary->data;
    size_t n = 0;
    for (size_t c = s->candidate_start[near]; c < s->candidate_start[near + 1]; ++c) {
        const struct candidate *candidate = &s->candidates[c];
        const size_t item = (size_t)candidate->item;
        const double *image =
            item < s->n_facets ? s->facets[item].image : s->shapes[item - s->n_facets].image;
        double at[3], shift[3];
        for (int k = 0; k < 3; ++k) {
            shift[k] = (image[k] + candidate->shift[k]) * s->period[k];
            at[k] = x[k] - shift[k];
        }
        if (item >= s->n_facets) {
            struct hit *hit = hit_start(&hits[n], NULL, (int32_t)(item - s->n_facets), -1, shift);
            shape_hit(boundary->surfaces[hit->surface], &s->shapes[hit->surface], at, hit);
            n += hit->at.distance < s->reach;
            continue;
        }
        const struct sliding_facet *facet = &s->facets[item];
        for (int p = 0; p < facet->n_pieces; ++p) {
            const struct piece *piece = &s->pieces[facet->pieces + p];
            if (piece->n == 0 || fabs(piece_plane_distance(piece, at)) >= s->reach)
                continue;
            struct hit *hit = hit_start(&hits[n], piece, facet->surface, facet->facet, shift);
            projection_find(&hit->at, piece, at, s->snap);
            n += hit->at.distance < s->reach;
        }
    }
    return n;
}

void sliding_hit_place(struct hit *hit)
{
    if (!hit->piece)
        return;
    piece_place(hit->piece, hit->at.closest, hit->place);
    for (int k = 0; k < 3; ++k) {
        hit->place[k] += hit->shift[k];
        hit->normal[k] = hit->piece->normal[k];
    }
}

/** Weight of the normal of a hit where several meet. */
static double hit_angle(const struct hit *hit)
{
    return hit->piece ? projection_angle(&hit->at, hit->piece) : 1.0;
}

/** How far apart edges may be that are one: a quad that is nearly plane counts as plane. */
static double edges_apart(const struct sliding *sliding)
{
    return 2.0 * sliding->flat;
}

/** Whether the other facets that meet at the closest point are hits, too: just within reach they may not be,
 * and one facet alone does not tell where the solid is. */
static bool others_in_reach(const struct sliding *sliding, const struct hit *hit)
{
    return hit->at.feature == PROJECTION_INTERIOR || hit->at.distance + edges_apart(sliding) < sliding->reach;
}

bool sliding_penetrated(const struct sliding *sliding, struct hit *hits, size_t n, const double x[3],
                        double c[3], double normal[3], size_t *nearest)
{
    if (n == 0)
        return false;
    size_t best = 0;
    for (size_t h = 1; h < n; ++h)
        if (hits[h].at.distance < hits[best].at.distance)
            best = h;
    *nearest = best;
    sliding_hit_place(&hits[best]);
    memcpy(c, hits[best].place, 3 * sizeof *c);
    for (int k = 0; k < 3; ++k)
        normal[k] = hit_angle(&hits[best]) * hits[best].normal[k];
    if (!others_in_reach(sliding, &hits[best]))
        return false;
    /* a facet beside its edge may be nearer than the edge by as much as edges are apart */
    const double apart = edges_apart(sliding), around = apart + sqrt(2.0 * apart * hits[best].at.distance);
    for (size_t h = 0; h < n && hits[best].at.feature != PROJECTION_INTERIOR; ++h) {
        if (h == best || hits[h].at.distance > hits[best].at.distance + apart)
            continue;
        sliding_hit_place(&hits[h]);
        if (distance(hits[h].place, c) > around)
            continue;
        for (int k = 0; k < 3; ++k)
            normal[k] += hit_angle(&hits[h]) * hits[h].normal[k];
    }
    double length = sqrt(dot(normal, normal)), side = 0.0;
    for (int k = 0; k < 3; ++k) {
        normal[k] = length > 0.0 ? normal[k] / length : hits[best].normal[k];
        side += (x[k] - c[k]) * normal[k];
    }
    return side < 0.0;
}

int sliding_anchors(const struct boundary *boundary, const struct hit *hit, int32_t points[SIDE_MAX_NODES],
                    double weights[SIDE_MAX_NODES])
{
    const struct sliding *s = boundary->data;
    int n = 1;
    for (int j = 0; j < SIDE_MAX_NODES; ++j)
        points[j] = -1;
    if (hit->piece) {
        piece_weights(hit->piece, s->facets[hit->piece->facet].n_nodes, hit->at.closest, weights);
        n = surface_spread(boundary->surfaces[hit->surface], (size_t)hit->facet, points, weights);
    } else {
        points[0] = 0;
        weights[0] = 1.0;
    }
    return n;
}

/** Motion of the wall where near particle @p near has a contact. */
static void contact_motion(const struct boundary *boundary, size_t near, struct contact *contact)
{
    const struct sliding *s = boundary->data;
    const struct surface *surface = boundary->surfaces[contact->surface];
    double u[3] = {0.0, 0.0, 0.0}, a[3] = {0.0, 0.0, 0.0};
    if (!s->touches[s->touch_start[near] + contact->first].piece) {
        double at[3];
        for (int k = 0; k < 3; ++k)
            at[k] = contact->c[k] - contact->shift[k];
        motion_frame_place(&s->shapes[contact->surface].frame, at, contact->u, contact->a);
        return;
    }
    const struct anchor *rows = sliding_rows(s, near, contact);
    for (uint32_t r = 0; r < contact->n_rows; ++r)
        for (int k = 0; k < 3; ++k) {
            u[k] += rows[r].weight * surface->now.v[rows[r].point][k];
            a[k] += rows[r].weight * surface->now.a[rows[r].point][k];
        }
    memcpy(contact->u, u, sizeof u);
    memcpy(contact->a, a, sizeof a);
}

/** A block at the closest point, in the direction from the particle to it, with weight 1: the paper's. */
static void contact_at_point(struct contact *contact, const struct hit *hit, const double x[3])
{
    double d = distance(hit->place, x);
    contact->d = d;
    contact->front = hit->at.d >= 0.0;
    for (int k = 0; k < 3; ++k) {
        contact->c[k] = contact->o[k] = hit->place[k];
        contact->normal[k] = hit->normal[k];
        contact->e_r[k] = d > 0.0 ? (hit->place[k] - x[k]) / d : -hit->normal[k];
    }
}

/** A block on the plane of a facet, at the foot point. */
static void contact_at_plane(struct contact *contact, const struct hit *hit, const double x[3])
{
    double d = hit->at.d, side = d < 0.0 ? 1.0 : -1.0;
    contact->d = fabs(d);
    contact->front = d >= 0.0;
    for (int k = 0; k < 3; ++k) {
        contact->c[k] = hit->place[k];
        contact->normal[k] = hit->normal[k];
        contact->e_r[k] = side * hit->normal[k];
        contact->o[k] = x[k] - d * hit->normal[k];
    }
}

static bool coplanar(const struct sliding *s, const double normal_a[3], double d_a, const double normal_b[3],
                     double d_b)
{
    return dot(normal_a, normal_b) > 1.0 - COPLANAR_COSINE &&
           fabs(d_a - d_b) < COPLANAR_DISTANCE * s->shares.dx;
}

/** Facets that a solid moves are never taken together: whether they are coplanar would change within the
 * coupling's iterations, and with it the extrapolated state by some per cent, so that they would not
 * converge. */
static bool joins(const struct boundary *boundary, const struct hit *hit)
{
    return hit->piece && !boundary->surfaces[hit->surface]->coupled;
}

/** Whether all facets in range are parts of one plane that the particle is in front of: then it is the
 * paper's flat wall. The nearest one is returned. */
static const struct hit *flat_wall(const struct boundary *boundary, const struct hit *hits, size_t n)
{
    const struct sliding *s = boundary->data;
    const struct hit *best = NULL;
    for (size_t h = 0; h < n; ++h) {
        const struct hit *hit = &hits[h];
        if (!hit->piece)
            continue;
        if (hit->at.d < 0.0 || !joins(boundary, hit) ||
            (best && !coplanar(s, hit->piece->normal, hit->at.d, best->piece->normal, best->at.d)))
            return NULL;
        if (!best || hit->at.distance < best->at.distance)
            best = hit;
    }
    return best && others_in_reach(s, best) ? best : NULL;
}

static void hit_shares(const struct sliding *s, const struct hit *hit, double share[SHARES])
{
    const struct piece *piece = hit->piece;
    const double *foot = hit->at.foot;
    if (piece->n == 2) {
        facet_shares_segment(&s->shares, hit->at.d, -foot[0], piece->corner[1][0] - foot[0], share);
        return;
    }
    facet_shares_polygon(&s->shares, hit->at.d, &hit->at.edges, share);
}

static void whole_block(struct touch *touch)
{
    for (int k = 0; k < SHARES; ++k)
        touch->weight[k] = 1.0;
}

/** Add a facet's shares to the touch of its plane, or make one. Returns the number of touches. */
static size_t add_facet(const struct boundary *boundary, struct hit *hit, const double x[3],
                        struct sliding_work *work, size_t n)
{
    const struct sliding *s = boundary->data;
    const struct hit **owner = work->owners;
    double share[SHARES];
    hit_shares(s, hit, share);
    if (share[SHARE_DENSITY] == 0.0 && share[SHARE_PRESSURE] == 0.0 && share[SHARE_VISCOUS] == 0.0)
        return n;
    sliding_hit_place(hit);
    size_t g = joins(boundary, hit) ? 0 : n;
    while (g < n && !(joins(boundary, owner[g]) && owner[g]->surface == hit->surface &&
                      coplanar(s, owner[g]->normal, owner[g]->at.d, hit->normal, hit->at.d)))
        ++g;
    if (g == n || hit->at.distance < owner[g]->at.distance) {
        contact_at_plane(&work->contacts[g], hit, x);
        owner[g] = hit;
    }
    for (int k = 0; k < SHARES; ++k)
        work->touches[g].weight[k] = (g == n ? 0.0 : work->touches[g].weight[k]) + share[k];
    return g == n ? n + 1 : n;
}

/** In 3-D the sums at a front contact serve the weaker ones whose facets are turned by little: there are many
 * where facets are small. */
static void share_sums(struct sliding_work *work, size_t n)
{
    struct contact *contacts = work->contacts;
    const struct touch *touches = work->touches;
    uint32_t *order = work->order; /* front contacts, the strongest first */
    size_t n_front = 0;
    for (size_t k = 0; k < n; ++k) {
        if (!contacts[k].front)
            continue;
        size_t place = n_front++;
        for (; place > 0 &&
               touches[k].weight[SHARE_PRESSURE] > touches[order[place - 1]].weight[SHARE_PRESSURE];
             --place)
            order[place] = order[place - 1];
        order[place] = (uint32_t)k;
    }
    for (size_t p = 0; p < n_front; ++p) {
        const uint32_t k = order[p];
        size_t best = 0;
        while (order[best] != k && !(dot(contacts[order[best]].normal, contacts[k].normal) > SHARED_COSINE))
            ++best;
        contacts[k].source = (int32_t)order[best];
    }
    for (size_t k = 0; k < n; ++k) /* ascends to stronger ones only */
        while (contacts[contacts[k].source].source != contacts[k].source)
            contacts[k].source = contacts[contacts[k].source].source;
}

/** Back-facing facets use the sums of the strongest front contact; their viscous shares go to the front
 * contacts. */
static void fold_back(const struct sliding *s, struct sliding_work *work, size_t n)
{
    struct contact *contacts = work->contacts;
    struct touch *touches = work->touches;
    double front = 0.0, back = 0.0;
    size_t strongest = n;
    for (size_t k = 0; k < n; ++k) {
        double viscous = touches[k].weight[SHARE_VISCOUS] * facet_shares_viscous(&s->shares, contacts[k].d);
        contacts[k].source = (int32_t)k;
        if (contacts[k].front) {
            front += viscous;
            if (strongest == n ||
                touches[k].weight[SHARE_PRESSURE] > touches[strongest].weight[SHARE_PRESSURE])
                strongest = k;
        } else {
            back += viscous;
        }
    }
    if (s->shares.kernel.dim == 3)
        share_sums(work, n);
    double factor = front > 0.0 ? fmax(0.0, 1.0 + back / front) : 1.0;
    for (size_t k = 0; k < n; ++k) {
        if (contacts[k].front) {
            touches[k].weight[SHARE_VISCOUS] *= factor;
        } else {
            touches[k].weight[SHARE_VISCOUS] = 0.0;
            if (strongest < n)
                contacts[k].source = contacts[strongest].source;
        }
    }
}

/** Whether touch @p k belongs to the contact of the one whose sums it uses. */
static bool joins_source(const struct sliding_work *work, size_t k)
{
    const struct contact *contact = &work->contacts[k], *source = &work->contacts[contact->source];
    return contact->front && contact->surface == source->surface && work->owners[k]->piece &&
           work->owners[contact->source]->piece;
}

/** What of the force of a contact a touch takes: its part of the pressure's. */
static double touch_strength(const struct sliding *s, const struct touch *touch)
{
    double moments[LAYER_MOMENTS], sum = 0.0;
    for (int m = 0; m < s->shares.layers; ++m) {
        facet_shares_layer(&s->shares, touch->d + (m + 0.5) * s->shares.dx, moments);
        sum -= moments[LAYER_NORMAL];
    }
    return touch->weight[SHARE_PRESSURE] * sum;
}

/** Parts of the touches of a contact. */
static void contact_part(const struct sliding *s, struct sliding_work *work, const struct contact *contact)
{
    const uint32_t *order = &work->order[contact->first];
    double sum = 0.0;
    for (uint32_t t = 0; t < contact->n_touches; ++t) {
        struct touch *touch = &work->touches[order[t]];
        touch->part = contact->n_touches > 1 ? touch_strength(s, touch) : 1.0;
        sum += touch->part;
    }
    for (uint32_t t = 0; t < contact->n_touches; ++t)
        work->touches[order[t]].part = sum > 0.0 ? work->touches[order[t]].part / sum : t == 0;
}

/** Put touches that join into one contact: work->order lists them by contact, first the one that has the
 * sums. Returns the number of contacts. */
static size_t bundle(const struct sliding *s, struct sliding_work *work, size_t n)
{
    struct contact *contacts = work->contacts;
    const bool together = s->layered;
    size_t n_contacts = 0;
    uint32_t placed = 0;
    for (size_t k = 0; k < n; ++k) {
        work->touches[k].piece = work->owners[k]->piece;
        memcpy(work->touches[k].at, work->owners[k]->at.closest, sizeof work->touches[k].at);
        work->touches[k].d = contacts[k].d;
    }
    for (size_t k = 0; k < n; ++k) {
        if (together && contacts[k].source != (int32_t)k && joins_source(work, k))
            continue;
        contacts[k].first = placed;
        work->order[placed++] = (uint32_t)k;
        for (size_t l = 0; l < n && together && contacts[k].source == (int32_t)k; ++l)
            if (l != k && contacts[l].source == (int32_t)k && joins_source(work, l))
                work->order[placed++] = (uint32_t)l;
        contacts[k].n_touches = placed - contacts[k].first;
        contact_part(s, work, &contacts[k]);
        contacts[k].tensor = n_contacts++; /* its number from now on */
    }
    for (size_t k = 0; k < n; ++k)
        contacts[k].source = (int32_t)contacts[contacts[k].source].tensor;
    n_contacts = 0;
    for (size_t k = 0; k < n; ++k)
        if (contacts[k].n_touches > 0)
            contacts[n_contacts++] = contacts[k];
    return n_contacts;
}

/** Contacts of one particle with facet shares, one for each touch. Returns their number; @p clear is the
 * distance from the wall. */
static size_t shares_contacts(const struct boundary *boundary, size_t near, const double x[3],
                              struct sliding_work *work, double *clear)
{
    const struct sliding *s = boundary->data;
    struct hit *hits = work->hits;
    double at[3] = {x[0], x[1], x[2]}, c[3], normal[3];
    size_t n_hits = sliding_hits(boundary, near, at, hits), nearest = 0, n = 0;
    const bool apart = sliding_penetrated(s, hits, n_hits, at, c, normal, &nearest);
    *clear = apart ? 0.0 : n_hits > 0 ? hits[nearest].at.distance : s->reach;
    if (apart) {
        for (int k = 0; k < 3; ++k)
            at[k] = c[k] + OUTSIDE_EVALUATE * s->shares.dx * normal[k];
        n_hits = sliding_hits(boundary, near, at, hits);
    }
    const struct hit *flat = flat_wall(boundary, hits, n_hits);
    for (size_t h = 0; h < n_hits; ++h) {
        struct hit *hit = &hits[h];
        if (hit->piece && !flat) {
            n = add_facet(boundary, hit, at, work, n);
        } else if (!hit->piece || hit == flat) {
            struct contact *contact = &work->contacts[n];
            sliding_hit_place(hit);
            if (hit->at.distance - fabs(hit->at.d) > s->snap)
                contact_at_plane(contact, hit, at);
            else
                contact_at_point(contact, hit, at);
            contact->front = true;
            whole_block(&work->touches[n]);
            work->owners[n++] = hit;
        }
    }
    for (size_t k = 0; k < n; ++k) {
        work->contacts[k].apart = apart;
        work->contacts[k].n_touches = 0;
        work->contacts[k].surface = work->owners[k]->surface;
        memcpy(work->contacts[k].shift, work->owners[k]->shift, sizeof work->contacts[k].shift);
    }
    fold_back(s, work, n);
    return n;
}

/** Whether a point is the same as another of lower dimension, or lies in the disc that a point of higher
 * dimension (surface, then edge) cuts out of the support (paper 000 remark 6). */
static bool removed(const struct sliding *s, const struct hit *hits, size_t n, size_t h)
{
    const double rc = s->shares.kernel.support;
    for (size_t k = 0; k < n; ++k) {
        if (k == h)
            continue;
        double apart = distance(hits[k].place, hits[h].place);
        bool lower = hits[k].at.feature < hits[h].at.feature;
        if (apart < s->snap && (lower || (hits[k].at.feature == hits[h].at.feature && k < h)))
            return true;
        if (hits[k].at.feature > hits[h].at.feature &&
            apart * apart <= rc * rc - hits[k].at.distance * hits[k].at.distance)
            return true;
    }
    return false;
}

/** Contacts of one particle by the published rule. */
static size_t paper_contacts(const struct boundary *boundary, size_t near, const double x[3],
                             struct sliding_work *work)
{
    const struct sliding *s = boundary->data;
    struct hit *hits = work->hits;
    size_t n_hits = sliding_hits(boundary, near, x, hits), n = 0;
    for (size_t h = 0; h < n_hits; ++h)
        sliding_hit_place(&hits[h]);
    for (size_t h = 0; h < n_hits; ++h) {
        if (removed(s, hits, n_hits, h))
            continue;
        struct contact *contact = &work->contacts[n];
        contact_at_point(contact, &hits[h], x);
        contact->front = true;
        contact->apart = false;
        contact->source = (int32_t)n;
        contact->surface = hits[h].surface;
        memcpy(contact->shift, hits[h].shift, sizeof contact->shift);
        whole_block(&work->touches[n]);
        work->owners[n++] = &hits[h];
    }
    return n;
}

/** Sum of the kernel over a block at distance @p d, particle by particle. */
static double block_kernel_sum(const struct sliding *s, double d)
{
    const struct kernel *kernel = &s->shares.kernel;
    const int q = s->shares.layers;
    const double dx = s->shares.dx;
    double sum = 0.0;
    for (int m = 0; m < q; ++m)
        for (int a = 0; a < (kernel->dim > 1 ? q : 1); ++a)
            for (int b = 0; b < (kernel->dim > 2 ? q : 1); ++b) {
                double y = d + (m + 0.5) * dx, r2 = y * y + (double)(a * a + b * b) * dx * dx;
                if (r2 < kernel->support * kernel->support)
                    sum += (a ? 2.0 : 1.0) * (b ? 2.0 : 1.0) * kernel_w(kernel, sqrt(r2));
            }
    return sum;
}

/** Add what stands behind one touch to the layers of its contact. */
static void layers_add(const struct sliding *s, const struct touch *touch, const double e_r[3],
                       struct layer_sums *layers)
{
    const double *weight = touch->weight;
    for (int m = 0; m < s->shares.layers; ++m) {
        struct layer_sums *sums = &layers[m];
        const double y = touch->d + (m + 0.5) * s->shares.dx;
        double moments[LAYER_MOMENTS];
        facet_shares_layer(&s->shares, y, moments);
        const double strength = weight[SHARE_PRESSURE] * moments[LAYER_NORMAL];
        for (int k = 0; k < 3; ++k) {
            sums->normal[k] += strength * e_r[k];
            sums->place[k] += strength * y * e_r[k];
        }
        sums->kernel += weight[SHARE_DENSITY] * moments[LAYER_W];
        sums->strength += strength;
        sums->viscous += weight[SHARE_VISCOUS] * moments[LAYER_VISCOUS];
        sums->tangent += weight[SHARE_PRESSURE] * moments[LAYER_TANGENT];
    }
}

/** Layers of a contact, from its touches. */
static void contact_layers(const struct sliding *s, size_t near, const struct contact *contact)
{
    const struct touch *touches = &s->touches[s->touch_start[near] + contact->first];
    struct layer_sums *layers = &s->layers[(size_t)(contact - s->contacts) * (size_t)s->shares.layers];
    memset(layers, 0, (size_t)s->shares.layers * sizeof *layers);
    for (uint32_t t = 0; t < contact->n_touches; ++t) {
        double e_r[3];
        sliding_touch_direction(contact, touches, t, e_r);
        layers_add(s, &touches[t], e_r, layers);
    }
}

/** Sum over the wall of share and kernel, of one near particle. */
static double near_kernel_sum(const struct sliding *s, size_t near)
{
    const size_t q = (size_t)s->shares.layers;
    double sum = 0.0;
    if (s->layered) {
        for (size_t l = s->contact_start[near] * q; l < (s->contact_start[near] + s->contact_count[near]) * q;
             ++l)
            sum += s->layers[l].kernel;
        return sum;
    }
    const struct touch *touches = &s->touches[s->touch_start[near]];
    for (size_t t = 0; t < s->touch_count[near]; ++t)
        sum += touches[t].weight[SHARE_DENSITY] * block_kernel_sum(s, touches[t].d);
    return sum;
}

/** Let a contact follow its facets: the place of the block and of the closest point, but not the weights. One
 * that is evaluated from another place keeps its distances. */
static void contact_follow(const struct boundary *boundary, size_t near, const double x[3],
                           struct contact *contact)
{
    const struct sliding *s = boundary->data;
    struct touch *touches = &s->touches[s->touch_start[near] + contact->first];
    const bool front = contact->front;
    double at[3], block[3];
    for (int k = 0; k < 3; ++k) {
        at[k] = x[k] - contact->shift[k];
        block[k] = contact->o[k] - contact->c[k];
    }
    for (uint32_t t = 0; t < contact->n_touches && !contact->apart; ++t) {
        const double d = piece_plane_distance(touches[t].piece, at);
        touches[t].d = front ? fmax(0.0, d) : fmax(LEAST_BEHIND * s->shares.dx, -d);
    }
    struct hit hit = {.piece = touches->piece, .at.d = front ? touches->d : -touches->d};
    memcpy(hit.at.closest, touches->at, sizeof hit.at.closest);
    memcpy(hit.shift, contact->shift, sizeof hit.shift);
    sliding_hit_place(&hit);
    contact_at_plane(contact, &hit, x);
    contact->front = front;
    for (int k = 0; k < 3 && contact->apart; ++k)
        contact->o[k] = contact->c[k] + block[k];
    if (s->layered)
        contact_layers(s, near, contact);
    contact_motion(boundary, near, contact);
}

/** Contacts of one near particle for surfaces of solids that moved a little since they were found. Which
 * facets act from which side is not asked again: where that changed the iterations would not settle. */
static void contacts_follow(struct boundary *boundary, const struct fluid_view *view, size_t near)
{
    const struct sliding *s = boundary->data;
    const uint32_t i = boundary->near[near];
    const double x[3] = {view->particles->x[0][i], view->particles->x[1][i], view->particles->x[2][i]};
    struct contact *contacts = &s->contacts[s->contact_start[near]];
    for (size_t k = 0; k < s->contact_count[near]; ++k)
        if (boundary->surfaces[contacts[k].surface]->coupled &&
            s->touches[s->touch_start[near] + contacts[k].first].piece)
            contact_follow(boundary, near, x, &contacts[k]);
    boundary->kernel_sum[near] = near_kernel_sum(s, near);
}

/** Points that move with a contact and take its load: those of all touches, each once. */
static void contact_rows(const struct boundary *boundary, size_t near, const struct sliding_work *work,
                         struct contact *contact)
{
    struct anchor *rows = sliding_rows(boundary->data, near, contact);
    const struct hit *before = NULL;
    uint32_t n = 0, row[SIDE_MAX_NODES];
    for (uint32_t t = contact->first; t < contact->first + contact->n_touches; ++t) {
        const struct hit *hit = work->owners[work->order[t]];
        int32_t points[SIDE_MAX_NODES];
        double weights[SIDE_MAX_NODES];
        const int n_points = sliding_anchors(boundary, hit, points, weights);
        const bool same = before && hit->facet >= 0 && hit->facet == before->facet &&
                          hit->surface == before->surface; /* a quad's quarters */
        for (int j = 0; j < n_points; ++j) {
            for (row[j] = same ? row[j] : 0; row[j] < n && rows[row[j]].point != points[j];)
                ++row[j];
            if (row[j] == n)
                rows[n++] = (struct anchor){0.0, points[j]};
            rows[row[j]].weight += work->touches[work->order[t]].part * weights[j];
        }
        before = hit;
    }
    contact->n_rows = n;
}

/** Contacts of one near particle into its slots; the counts say how many there are, they are stored only if
 * they fit. */
static void particle_contacts(struct boundary *boundary, const struct fluid_view *view, size_t near,
                              struct sliding_work *work)
{
    struct sliding *s = boundary->data;
    const uint32_t i = boundary->near[near];
    const double x[3] = {view->particles->x[0][i], view->particles->x[1][i], view->particles->x[2][i]};
    double clear = 0.0;
    const size_t n =
        s->paper ? paper_contacts(boundary, near, x, work) : shares_contacts(boundary, near, x, work, &clear);
    const size_t n_contacts = bundle(s, work, n), first = s->touch_start[near];
    s->contact_count[near] = (uint32_t)n_contacts;
    s->touch_count[near] = (uint32_t)n;
    if (n > s->touch_start[near + 1] - first ||
        n_contacts > s->contact_start[near + 1] - s->contact_start[near])
        return;
    struct contact *contacts = &s->contacts[s->contact_start[near]];
    memcpy(contacts, work->contacts, n_contacts * sizeof *contacts);
    for (size_t t = 0; t < n; ++t)
        s->touches[first + t] = work->touches[work->order[t]];
    for (size_t k = 0; k < n_contacts; ++k) {
        contacts[k].n_listed = 0;
        contact_rows(boundary, near, work, &contacts[k]);
        contact_motion(boundary, near, &contacts[k]);
        if (s->layered)
            contact_layers(s, near, &contacts[k]);
    }
    boundary->kernel_sum[near] = near_kernel_sum(s, near);
    s->clear[near] = clear;
    memcpy(s->clear_x[near], x, sizeof x);
}

/** Make room where the counts are larger. */
static void room_grow(size_t n, const uint32_t *counts, size_t *start)
{
    size_t offset = 0;
    for (size_t near = 0; near < n; ++near) {
        const size_t room = start[near + 1] - start[near];
        start[near] = offset;
        offset += counts[near] > room ? counts[near] + 1 : room;
    }
    start[n] = offset;
}

int sliding_reserve_contacts(struct sliding *s, size_t n)
{
    const size_t touches = s->touch_start[n];
    CALL(memory_grow((void **)&s->contacts, &s->contacts_capacity, s->contact_start[n], sizeof *s->contacts));
    if (s->layered)
        CALL(memory_grow((void **)&s->layers, &s->layers_capacity,
                         s->contact_start[n] * (size_t)s->shares.layers, sizeof *s->layers));
    CALL(memory_grow((void **)&s->touches, &s->touches_capacity, touches, sizeof *s->touches));
    return memory_grow((void **)&s->rows, &s->rows_capacity, touches * s->anchors, sizeof *s->rows);
}

/** Contacts of all near particles; *@p full: some have more than there is room for. */
static void contacts_find(struct boundary *boundary, const struct fluid_view *view, int *full)
{
    struct sliding *s = boundary->data;
    int more = 0;
#pragma omp parallel for schedule(dynamic, 16) reduction(max : more)
    for (size_t near = 0; near < boundary->n_near; ++near) {
        particle_contacts(boundary, view, near, &s->work[omp_get_thread_num()]);
        if (s->contact_count[near] > s->contact_start[near + 1] - s->contact_start[near] ||
            s->touch_count[near] > s->touch_start[near + 1] - s->touch_start[near])
            more = 1;
    }
    *full = more;
}

int sliding_prepare(struct boundary *boundary, const struct fluid_view *view, bool again)
{
    struct sliding *s = boundary->data;
    const size_t n = boundary->n_near;
    const bool follow = again && !s->paper;
    sliding_place(boundary, follow);
    if (follow) {
#pragma omp parallel for schedule(dynamic, 16)
        for (size_t near = 0; near < n; ++near)
            contacts_follow(boundary, view, near);
        return 0;
    }
    for (size_t t = 0; t < s->n_work; ++t)
        s->work[t].n_list = 0;
    int full;
    for (contacts_find(boundary, view, &full); full; contacts_find(boundary, view, &full)) {
        room_grow(n, s->contact_count, s->contact_start);
        room_grow(n, s->touch_count, s->touch_start);
        CALL(sliding_reserve_contacts(s, n));
    }
    for (size_t k = 0; k < boundary->n_surfaces; ++k)
        memcpy(s->wall_x[k], boundary->surfaces[k]->now.x,
               boundary->surfaces[k]->n_points * sizeof **s->wall_x);
    s->clear_current = true;
    return 0;
}

/** Move penetrated particle @p i of near number @p near to the fluid side and give the surface its momentum.
 */
static void put_particle(struct boundary *boundary, size_t near, double mass, struct particles *particles)
{
    struct sliding *s = boundary->data;
    const uint32_t i = boundary->near[near];
    struct hit *hits = s->work[0].hits;
    double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]}, c[3], normal[3];
    size_t n = sliding_hits(boundary, near, x, hits), nearest;
    if (!sliding_penetrated(s, hits, n, x, c, normal, &nearest))
        return;
    const struct hit *hit = &hits[nearest];
    const struct surface *surface = boundary->surfaces[hit->surface];
    int32_t points[SIDE_MAX_NODES];
    double weights[SIDE_MAX_NODES], u[3] = {0.0, 0.0, 0.0}, a[3], at[3];
    const int n_points = sliding_anchors(boundary, hit, points, weights);
    for (int k = 0; k < 3; ++k)
        at[k] = c[k] - hit->shift[k];
    if (hit->piece)
        for (int j = 0; j < n_points; ++j)
            for (int k = 0; k < 3; ++k)
                u[k] += weights[j] * surface->now.v[points[j]][k];
    else
        motion_frame_place(&s->shapes[hit->surface].frame, at, u, a);
    double inward = 0.0, impulse[3], arm[3];
    for (int k = 0; k < 3; ++k)
        inward += (particles->u[k][i] - u[k]) * normal[k];
    inward = fmin(0.0, inward);
    for (int k = 0; k < 3; ++k) {
        particles->x[k][i] = c[k] + OUTSIDE_PUT_BACK * s->shares.dx * normal[k];
        particles->u[k][i] -= inward * normal[k];
        impulse[k] = mass * inward * normal[k];
        arm[k] = at[k] - s->shapes[hit->surface].centre[k];
    }
    for (int j = 0; j < n_points; ++j)
        for (int k = 0; k < 3; ++k)
            s->pending[hit->surface][points[j]][k] += weights[j] * impulse[k];
    if (!hit->piece)
        for (int k = 0; k < 3; ++k)
            s->pending_moment[hit->surface][k] +=
                arm[(k + 1) % 3] * impulse[(k + 2) % 3] - arm[(k + 2) % 3] * impulse[(k + 1) % 3];
    ++boundary->put_back_count;
}

/** How far facets have moved since contacts were found; infinite if that is not known. */
static double wall_moved(const struct boundary *boundary)
{
    const struct sliding *s = boundary->data;
    double moved = s->clear_current ? 0.0 : INFINITY;
    for (size_t k = 0; k < boundary->n_surfaces && s->clear_current; ++k) {
        const struct surface *surface = boundary->surfaces[k];
        if (surface->definition->kind != SURFACE_FACETS && surface->moving)
            return INFINITY; /* its centre does not tell */
        for (size_t i = 0; i < surface->n_points && surface->moving; ++i)
            moved = fmax(moved, distance(surface->now.x[i], s->wall_x[k][i]));
    }
    return moved;
}

int sliding_put_back(struct boundary *boundary, const struct fluid_view *view, struct particles *particles)
{
    struct sliding *s = boundary->data;
    if (s->paper)
        return 0;
    for (size_t k = 0; k < boundary->n_surfaces; ++k) {
        surface_at(boundary->surfaces[k], view->t);
        memset(s->pending[k], 0, boundary->surfaces[k]->n_points * sizeof **s->pending);
        memset(s->pending_moment[k], 0, sizeof *s->pending_moment);
    }
    sliding_place(boundary, false);
    const double moved = wall_moved(boundary);
#pragma omp parallel for schedule(dynamic, 64)
    for (size_t near = 0; near < boundary->n_near; ++near) {
        const uint32_t i = boundary->near[near];
        const double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]};
        s->put[near] = false;
        if (s->clear_current && s->clear[near] > moved + distance(x, s->clear_x[near]))
            continue; /* neither can have come through the other */
        struct hit *hits = s->work[omp_get_thread_num()].hits;
        double c[3], normal[3];
        size_t n = sliding_hits(boundary, near, x, hits), nearest;
        s->put[near] = sliding_penetrated(s, hits, n, x, c, normal, &nearest);
    }
    for (size_t near = 0; near < boundary->n_near; ++near)
        if (s->put[near])
            put_particle(boundary, near, view->mass, particles);
    return 0;
}
