// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_MODEL_H
#define MODEL_MODEL_H

#include "math/expression.h"
#include "model/geometry.h"
#include "model/mesh.h"
#include "model/motion.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** The problem as plain data: what the deck said, after units and expressions; const once the deck has been
 * read. SI units throughout; 2-D problems have unit depth. Every entry knows its place in the deck. */

struct location {
    int line, column; /**< in the deck; 0: not from a deck */
};

/** A file that the problem was read from. */
struct model_input {
    char *name; /**< of the deck: its base name, as on disk; of another file: relative to the deck's folder,
                   as the deck writes it, without "." folders and double slashes */
    char *path; /**< where it was read: the deck's path as given, or the deck's folder with the name */
    uint64_t hash; /**< hash_bytes over the bytes that were read */
    size_t size;   /**< their number */
};

struct parameter {
    char *name;
    double value;
    char *text; /**< as written, or as overridden by --set */
    struct location where;
};

struct model_time {
    double end;                       /**< s */
    double step;                      /**< s */
    struct expression *body_force[3]; /**< m/s^2, of t; never NULL */
    struct location where;
};

enum domain_outside { OUTSIDE_STOP, OUTSIDE_REMOVE };

/** Where particles may be. */
struct model_domain {
    double lower[3], upper[3];
    bool periodic[3];
    enum domain_outside outside;
    struct location where;
};

/** A fluid material; equation of state linear: p = c^2 (rho - rho0) (paper 000 eq. 20). */
struct fluid_material {
    char *name;
    double density, kinematic_viscosity, sound_speed, background_pressure; /**< kg/m^3 m^2/s m/s Pa */
    struct location where;
};

struct solid_material {
    char *name;
    char *law; /**< one of solid/constitutive list: "saint-venant-kirchhoff" */
    double density, young, poisson;
    struct location where;
};

enum arithmetic { ARITHMETIC_MIXED, ARITHMETIC_DOUBLE };
enum kernel_constant { KERNEL_EXACT, KERNEL_PUBLISHED };

/** Particles to start with. */
struct model_region {
    struct shape shape; /**< used unless n_points > 0 */
    size_t n_points;    /**< explicit places */
    double (*points)[3];
    bool has_origin;
    double origin[3];               /**< of the lattice; default: lower corner of the shape's bounding box */
    struct expression *velocity[3]; /**< initial, of x, y, z; NULL: 0 */
    struct location where;
};

struct model_fluid {
    bool present;
    char *formulation; /**< "transport-velocity" */
    int material;      /**< index into fluid_materials */
    char *kernel;      /**< "quintic-spline" */
    enum kernel_constant kernel_constant;
    double spacing;                /**< initial particle spacing, m */
    double smoothing_length_ratio; /**< h / spacing */
    double damping;                /**< global damping -d u, 1/s */
    enum arithmetic arithmetic;
    bool convective_stress; /**< of the transport velocity, in the momentum equation */
    size_t n_regions;
    struct model_region *regions;
    struct location where;
};

enum solid_formulation { SOLID_FULL, SOLID_F_BAR, SOLID_EAS };

/** Homogeneous Dirichlet condition, or prescribed motion, of a node set. */
struct model_support {
    int set;       /**< index into mesh.sets */
    bool fixed[3]; /**< components held */
    bool moves;
    struct motion motion; /**< when it moves (all components prescribed) */
    struct location where;
};

/** A load on a node set: force per node set (shared equally), or body force per mass on the whole mesh (set =
 * -1). */
struct model_load {
    int set;
    struct expression *force[3]; /**< N (2-D: N/m), of t; set = -1: m/s^2 */
    struct location where;
};

/** What makes a mesh a rigid body. Directions: x, y, z, then rotations about them through the centre of mass;
 * in 2-D those out of the plane are fixed. */
struct model_rigid {
    bool present;
    bool has_mass, has_centre, has_inertia;
    double density;       /**< kg/m^3; used unless has_mass */
    double mass;          /**< kg (2-D: kg/m) */
    double centre[3];     /**< of mass, m; otherwise that of the volume */
    double inertia[3][3]; /**< about the centre, kg m^2 (2-D: kg m, zz only); otherwise that of the volume */
    bool fixed[6];
    double velocity[3], angular_velocity[3]; /**< at time 0, m/s and rad/s */
    struct location where;
};

struct model_mesh {
    char *name;
    struct mesh mesh;
    int material; /**< index into solid_materials; rigid bodies may have none: -1 */
    struct model_rigid rigid;
    enum solid_formulation formulation;
    double rho_infinity;     /**< of the generalised-alpha method, 0..1 */
    double newton_tolerance; /**< relative residual of Newton's method */
    size_t n_supports;
    struct model_support *supports;
    size_t n_loads;
    struct model_load *loads;
    struct expression *displacement[3], *velocity[3]; /**< initial, of X (eq. 6); NULL: 0 */
    struct location where;
};

enum surface_kind { SURFACE_FACETS, SURFACE_PLANE, SURFACE_CYLINDER, SURFACE_SPHERE };

/** One part of a facet surface: the skin of a mesh or facets of its own. */
struct surface_part {
    int mesh; /**< index into meshes, or -1: own facets */
    size_t n_excluded;
    int *excluded;        /**< node sets of the mesh whose sides do not count */
    struct facets facets; /**< mesh = -1 */
};

/** A surface between fluid and solid. */
struct model_surface {
    char *name;
    enum surface_kind kind;
    size_t n_parts;
    struct surface_part *parts; /**< SURFACE_FACETS; coinciding points of parts are merged */
    double centre[3]; /**< plane: a point of it; cylinder: a point of the axis (2-D: circle); sphere */
    double axis[3];   /**< plane: normal into the fluid; cylinder: axis */
    double radius;
    bool fluid_inside;    /**< cylinder, sphere: the fluid is inside */
    struct motion motion; /**< of the points that do not belong to a mesh */
    struct facets built; /**< all parts in the reference configuration, merged and oriented (surface_build) */
    int32_t *built_mesh; /**< per built point: index of the mesh that moves it, or -1: prescribed */
    int32_t *built_node; /**< per built point: node of that mesh, or -1 */
    struct location where;
};

enum corners { CORNERS_SHARES, CORNERS_PAPER };

/** A wall: a treatment over a set of surfaces. */
struct model_wall {
    char *name;
    char *treatment; /**< "fixed-particles", "sliding-particles" */
    size_t n_surfaces;
    int *surfaces; /**< indices into surfaces */
    bool has_region;
    struct model_region
        region; /**< fixed-particles: explicit wall particles instead of those behind the surfaces */
    struct motion motion;   /**< of the explicit wall particles */
    enum corners corners;   /**< sliding-particles */
    bool pressure_gradient; /**< sliding-particles: eq. 34 on (default) or off (fig. 8) */
    struct location where;
};

enum open_kind { OPEN_INFLOW, OPEN_OUTFLOW };
enum open_velocity { OPEN_CHARACTERISTIC, OPEN_MOMENTUM };

/** An inflow or outflow through an axis-parallel plane. */
struct model_open {
    char *name;
    enum open_kind kind;
    int axis;                       /**< 0, 1, 2: the plane is x_axis = at */
    int into;                       /**< +1 / -1: direction along the axis in which the fluid domain lies */
    double at;                      /**< m */
    double lower[3], upper[3];      /**< extent of the opening in the other directions */
    struct expression *velocity[3]; /**< inflow, of x, y, z, t */
    struct expression *pressure;    /**< outflow, of x, y, z, t */
    enum open_velocity velocity_rule;
    struct location where;
};

/** The acceleration a solid is predicted to have at the end of a step, from those of the start (a_n) and one
 * step before (a_{n-1}): 2 a_n - a_{n-1}, a_n, or 0; displacement and velocity follow by Newmark. */
enum predictor { PREDICTOR_LINEAR, PREDICTOR_CONSTANT, PREDICTOR_ZERO };

struct model_coupling {
    char *scheme;           /**< "fixed-point", "sub-cycled" */
    double tolerance;       /**< of eq. 46, m/s; 0: not asked for */
    double force_tolerance; /**< of the change of the loads, N (2-D: N/m); 0: not asked for */
    int iterations;
    char *acceleration; /**< "added-mass", "iqn-ils", "aitken", "constant", "none" */
    double relaxation;  /**< first (aitken, iqn-ils) or only (constant) relaxation factor */
    int reused_steps;   /**< iqn-ils: steps whose columns are kept */
    double filter;      /**< iqn-ils: least part of a column that is new */
    enum predictor predictor;
    int solid_every; /**< sub-cycled: fluid steps in a step of the solids; otherwise 0 */
    struct location where;
};

enum history_kind {
    HISTORY_POINT,   /**< displacement, velocity of a material point of a mesh */
    HISTORY_FORCE,   /**< force and moment on surfaces */
    HISTORY_GAUGE,   /**< Shepard-corrected fluid fields at a place (eq. 14) */
    HISTORY_PROFILE, /**< the same along a line, rows t,s,x,y,z,values */
    HISTORY_VOLUME,  /**< number, mass, volume of fluid particles, extreme densities */
    HISTORY_RIGID,   /**< place, rotation, velocities, force and moment of a rigid body */
    HISTORY_ENERGY,  /**< kinetic and elastic energies */
    HISTORY_COUPLING /**< iterations, residual of each step */
};

struct model_history {
    char *name;
    enum history_kind kind;
    double every; /**< s; 0: every step */
    int mesh;     /**< point, rigid */
    int n_surfaces;
    int *surfaces;         /**< force */
    bool has_box;          /**< volume: only of the box from, to */
    double from[3], to[3]; /**< point, gauge: from; profile, volume: both */
    int points;            /**< profile */
    struct location where;
};

struct model_output {
    double every; /**< s between frames */
    bool float64;
    size_t n_arrays;
    char **arrays; /**< wanted optional fluid arrays ("Vorticity", ...) */
    size_t n_histories;
    struct model_history *histories;
    size_t n_virtual_particles; /**< ids of fluid particles whose virtual boundary particles are written */
    long *virtual_particles;
    double checkpoint_every; /**< s of wall-clock time between checkpoints; 0: after every step */
};

struct model {
    char *path, *name; /**< of the deck; base name without .xml */
    size_t n_inputs;
    struct model_input *inputs; /**< the deck itself, then every file that it names, each once */
    int dim;
    size_t n_parameters;
    struct parameter *parameters;
    struct model_time time;
    struct model_domain domain;
    size_t n_fluid_materials, n_solid_materials;
    struct fluid_material *fluid_materials;
    struct solid_material *solid_materials;
    struct model_fluid fluid;
    size_t n_meshes, n_surfaces, n_walls, n_openings;
    struct model_mesh *meshes;
    struct model_surface *surfaces;
    struct model_wall *walls;
    struct model_open *openings;
    struct model_coupling coupling; /**< scheme NULL: default for what is present */
    struct model_output output;
};

/** Free everything the model owns and the model itself; NULL is fine. */
void model_destroy(struct model *model);

#endif
