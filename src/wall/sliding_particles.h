// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef WALL_SLIDING_PARTICLES_H
#define WALL_SLIDING_PARTICLES_H

#include "sph/boundary.h"
#include "wall/facet_shares.h"
#include "wall/projection.h"

/** What the parts of the sliding boundary particle treatment share (sliding_particles.c: object, lists;
 * sliding_contacts.c: contact points; sliding_forces.c: values of the virtual particles, packed neighbours,
 * loads). */

/** What one facet, or an analytic surface, adds to a contact. */
struct touch {
    const struct piece *piece; /**< NULL: analytic */
    double at[2];              /**< closest point in the axes of the piece */
    double d;                  /**< distance of the particle from its plane */
    double weight[SHARES];
    double part; /**< of the contact's force that it takes, and of its motion that is the contact's; they add
                    up to 1 */
};

/** 3-D: what the particles of one layer behind all touches of a contact add up to, with their shares. */
struct layer_sums {
    double kernel;    /**< W, share of density */
    double normal[3]; /**< W' y/r e_r, share of pressure */
    double place[3];  /**< W' y/r times the place from the particle, share of pressure */
    double strength;  /**< W' y/r, share of pressure */
    double viscous;   /**< W'/r, share of viscosity */
    double tangent;   /**< W' s^2/r, share of pressure */
};

/** Virtual boundary particles behind a wall, of one near particle: a block behind each touch, all with the
 * same smoothed values and the same motion of the wall. In 3-D facets turned by little against the strongest
 * one share a contact with it; otherwise each has its own. Places are in the image of the particle; they, and
 * the directions, are those of the first touch, the strongest. */
struct contact {
    double c[3];                                   /**< closest point of the wall: sums belong there */
    double o[3];                                   /**< the block stands here */
    double d;                                      /**< distance from the particle to o */
    double e_r[3];                                 /**< from the particle to o */
    double normal[3];                              /**< into the fluid */
    double shift[3];                               /**< of the wall's image */
    double u[3], a[3];                             /**< of the wall, by the parts of the touches */
    double mean_p, mean_rho, mean_u[3], mean_r[3]; /**< smoothed values at c (eqs. 32-34, 36) */
    double layer;                                  /**< d_f: distance of the centroid from the wall */
    double p0, gradient[3];                        /**< p_k = p0 + gradient . (r_k - o) */
    double force[3];                               /**< on the wall, N */
    uint32_t first, n_touches;                     /**< among the touches of the near particle */
    uint32_t n_rows; /**< points that move with it and take its load (sliding_rows) */
    int32_t surface;
    int32_t source; /**< contact of the same particle whose sums are used: itself, or another one's source */
    size_t tensor;  /**< where its added mass stands in the surface's list, or SIZE_MAX */
    size_t
        listed; /**< sums: where the list of particles around listed_c begins in the work of thread lister */
    double listed_c[3];
    uint32_t n_listed, lister;
    bool front; /**< the particle is on the fluid side */
    bool apart; /**< the particle has penetrated: evaluated from another place */
};

/** The wall point closest to a place, of one candidate. */
struct hit {
    const struct piece *piece; /**< NULL: analytic */
    int32_t surface, facet;    /**< facet of the surface, or -1 */
    double shift[3];
    struct projection at; /**< pieces: in their own image; analytic: only d, distance and feature are set */
    double place[3], normal[3]; /**< closest point and normal; pieces: filled by hit_place */
};

/** A facet, or an analytic surface, that a near particle can reach until the next sort. */
struct candidate {
    int32_t item;    /**< facet number over all surfaces; from n_facets on: analytic surface */
    int8_t shift[3]; /**< image, in periods, beside that of the item: -1, 0 or 1 */
};

/** A particle and a candidate of its. */
struct near_pair {
    uint32_t particle;
    struct candidate candidate;
};

struct sliding_facet {
    int32_t surface, facet; /**< number in the surface */
    int32_t pieces;         /**< where its pieces start (room for one, a quad for four) */
    int32_t n_pieces, n_nodes;
    double image[3]; /**< whole periods that bring its middle into the domain; set by the search */
};

/** An analytic surface as it stands now. */
struct sliding_shape {
    double centre[3], axis[3];
    struct motion_frame frame;
    double image[3]; /**< as of a facet */
};

/** Room for one particle; in the making each touch is a contact of its own, number k of both. */
struct sliding_work {
    struct hit *hits;
    struct contact *contacts;
    struct touch *touches;
    const struct hit **owners; /**< hit of each touch */
    uint32_t *order;           /**< touches by contact */
    size_t hits_capacity, contacts_capacity, touches_capacity, owners_capacity, order_capacity;
    struct wall_neighbours neighbours;
    uint32_t *list; /**< particles around contacts */
    size_t n_list, list_capacity;
    struct near_pair *pairs; /**< what this part of the search found */
    size_t n_pairs, pairs_capacity;
    bool quiet; /**< the search does not report what is wrong */
};

struct sliding {
    struct facet_shares shares;
    bool paper, gradient;
    double reach;     /**< contacts further away do not act */
    double snap;      /**< points closer than this are one */
    size_t block;     /**< most virtual particles of a contact */
    double flat;      /**< how far the corners of a plane quad may be off its plane */
    double period[3]; /**< 0: not periodic */
    size_t n_facets, n_pieces;
    struct sliding_facet *facets;
    struct piece *pieces;
    struct sliding_shape *shapes; /**< one per surface */
    bool placed;                  /**< pieces and shapes have been filled once */

    struct candidate *candidates; /**< of near particle k: candidate_start[k] .. candidate_start[k + 1] */
    size_t candidates_capacity, *candidate_start, candidate_start_capacity;
    uint32_t *stamp, *mask, *count; /**< workspace of the search, per particle */
    size_t stamp_capacity, mask_capacity, count_capacity;

    struct contact *contacts; /**< of near particle k: from contact_start[k], contact_count[k] of them */
    size_t contacts_capacity, *contact_start, contact_start_capacity;
    uint32_t *contact_count, *touch_count;
    size_t contact_count_capacity, touch_count_capacity;
    struct touch *touches; /**< of near particle k: from touch_start[k], touch_count[k] of them */
    size_t touches_capacity, *touch_start, touch_start_capacity;
    struct layer_sums *layers; /**< of contact k (of all): shares.layers of them from there on, if layered */
    size_t layers_capacity;
    bool layered;   /**< layers stand for blocks in the sweeps: in 3-D, except where walls are as published */
    size_t anchors; /**< most points of a touch */
    struct anchor *rows; /**< points of contacts and their weights (sliding_rows) */
    size_t rows_capacity;

    /* 3-D: what tells that a particle cannot have penetrated since contacts were found */
    bool clear_current;
    double *clear; /**< distance of near particle k from the wall then; 0 if it had penetrated */
    double (*clear_x)[3], (**wall_x)[3]; /**< where near particles and the surfaces' points were */
    size_t clear_capacity, clear_x_capacity;

    size_t n_work;
    struct sliding_work *work; /**< one per thread */
    double (**pending)[3];     /**< per surface and point: impulse of particles put back in this step, N s */
    double (*pending_moment)[3]; /**< per analytic surface */
    size_t put_capacity;
    uint8_t *put; /**< near particles to be put back */
};

/** Pieces and shapes from the surfaces' current places; @p again: facets are cut as before. */
void sliding_place(struct boundary *boundary, bool again);

/** Closest points of all candidates of near particle @p near to the place @p x within the reach. Returns
 * their number. */
size_t sliding_hits(const struct boundary *boundary, size_t near, const double x[3], struct hit *hits);

/** Fill place and normal of a hit. */
void sliding_hit_place(struct hit *hit);

/** Whether the place @p x lies inside the solid as the nearest of the @p n hits shows; then @p c is the
 * closest point, @p normal the unit normal there (averaged at edges and nodes) and *@p nearest the hit.
 * False, too, where an edge or node is nearest that lies at the end of the reach. */
bool sliding_penetrated(const struct sliding *sliding, struct hit *hits, size_t n, const double x[3],
                        double c[3], double normal[3], size_t *nearest);

/** Points of the wall at the closest point of @p hit and their weights, -1 behind the last of at most
 * SIDE_MAX_NODES; analytic: the centre. Returns their number. */
int sliding_anchors(const struct boundary *boundary, const struct hit *hit, int32_t points[SIDE_MAX_NODES],
                    double weights[SIDE_MAX_NODES]);

/** Points that move with a contact of a near particle and take its load, n_rows of them: their weights are
 * those of the touches' shape functions by the parts of the touches, and add up to 1. There is room for all
 * points of all touches. */
static inline struct anchor *sliding_rows(const struct sliding *sliding, size_t near,
                                          const struct contact *contact)
{
    return &sliding->rows[(sliding->touch_start[near] + contact->first) * sliding->anchors];
}

/** Direction from near particle to the plane of touch @p t of a contact (0: the first). */
void sliding_touch_direction(const struct contact *contact, const struct touch *touches, uint32_t t,
                             double e_r[3]);

/** Room for the contacts and touches that the starts of @p n near particles lay out. */
int sliding_reserve_contacts(struct sliding *sliding, size_t n);

/** The operations of the treatment (sph/boundary.h) that live in the other files. */
int sliding_prepare(struct boundary *boundary, const struct fluid_view *view, bool again);
int sliding_put_back(struct boundary *boundary, const struct fluid_view *view, struct particles *particles);
int sliding_close(struct boundary *boundary, const struct fluid_view *view);
int sliding_gather(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                   struct wall_neighbours *neighbours);
int sliding_unfold(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                   struct wall_neighbours *neighbours);
void sliding_react(struct boundary *boundary, size_t near, const struct wall_neighbours *neighbours,
                   double *const force[3]);
void sliding_load(struct boundary *boundary, const struct fluid_view *view);
int sliding_added_mass(struct boundary *boundary, const struct fluid_view *view);

#endif
