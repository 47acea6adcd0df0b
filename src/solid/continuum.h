// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_CONTINUUM_H
#define SOLID_CONTINUUM_H

#include "math/gmres.h"
#include "math/sparse.h"
#include "solid/element/element.h"
#include "solid/generalized_alpha.h"
#include "solid/solid_type.h"

/** Continuum finite elements (paper 000, section 3.2): private to the files continuum*.c. Nodal vectors are
 * rows of 3 (z = 0 in 2-D); vectors of equations hold the n_free components that are not prescribed, node by
 * node. */

/** Motion and forces of all nodes at one time. */
struct continuum_nodes {
    double (*d)[3], (*v)[3], (*a)[3];
    double (*f_internal)[3], (*f_external)[3]; /**< external: loads, body forces, interface */
};

enum { CONTINUUM_NODE_FIELDS = 10, CONTINUUM_CELL_FIELDS = 3, CONTINUUM_STATE_FIELDS = 3 };

struct continuum {
    const struct solid *solid;
    const struct model_mesh *definition;
    const struct mesh *mesh;
    int dim, dof; /**< degrees of freedom of an element */
    const struct element_kernel *kernel;
    struct constitutive material;
    double density;
    struct generalized_alpha method;
    double *element_data;   /**< kernel->data_size per element */
    double *element_forces; /**< workspace: dof per element */
    double *batch;          /**< workspace: stiffnesses of some elements */
    size_t bad_element;     /**< the one that was inverted, after a failed evaluation */

    size_t n_free;
    int32_t *equation;       /**< per node and component: its equation, -1: prescribed */
    int32_t *component;      /**< per equation: 3 node + component */
    int32_t *moving_support; /**< per node: the support with a prescribed motion, or -1 */

    size_t *mass_rows; /**< consistent mass, one number per pair of nodes that share an element, compressed
                          rows */
    int32_t *mass_columns;
    double *mass;       /**< kg */
    double *nodal_mass; /**< row sums */
    double force_floor; /**< what rounding makes of the forces at rest, N */

    size_t nonzeros;
    long *columns, *rows; /**< upper triangle of the system matrix, compressed columns */
    double *values, *mass_values;
    int32_t *scatter; /**< dof x dof per element: where an entry of the element matrix goes, or -1 */
    struct sparse_solver *solver; /**< NULL when n_free = 0 */
    struct gmres *gmres;

    struct continuum_nodes state, trial; /**< at the start of the step, and the answer for its end */
    double (*a_before)[3];               /**< acceleration one step before the state */
    double (*reaction)[3];               /**< forces of the supports on the solid, N */
    double (*f_interface)[3];            /**< the attached surfaces' part of the external force */
    double (*f_given)[3];                /**< the rest of it at the end of the step */
    double (*x)[3];                      /**< current places */
    double (*work)[3], (*work2)[3];
    double *residual, *delta; /**< n_free each */
    bool forces_current;      /**< trial.f_internal belongs to trial.d */

    double (*factor_d)[3]; /**< displacement the kept factor was made for */
    bool factored;         /**< solver holds that factor */
    double factor_dt;      /**< and the step; 0: none */
    int64_t factor_age;    /**< steps since */
    int64_t corrections;   /**< in this step */
    double external_work;

    struct field_group node_group, cell_group, state_group;
    char *node_group_name, *cell_group_name, *state_group_name;
    struct field node_fields[CONTINUUM_NODE_FIELDS], cell_fields[CONTINUUM_CELL_FIELDS],
        state_fields[CONTINUUM_STATE_FIELDS];
};

/* continuum_assembly.c */

/** Element data, equations, mass, pattern and solver. */
int continuum_build(struct continuum *continuum);

/** f := internal forces at displacement d. STATUS_NUMERICAL (not reported, bad_element set) when an element
 * is inverted. */
int continuum_internal_forces(struct continuum *continuum, const double (*d)[3], double (*f)[3]);

/** Matrix mass_factor M + stiffness_factor K(d) into the solver, factored. */
int continuum_factor(struct continuum *continuum, double mass_factor, double stiffness_factor,
                     const double (*d)[3]);

/** y := M x (nodal vectors). */
void continuum_mass_times(const struct continuum *continuum, const double (*x)[3], double (*y)[3]);

/** Gather the displacement of an element's nodes. */
void continuum_gather(const struct continuum *continuum, size_t element, const double (*d)[3], double *local);

/** Report the inverted element of a failed evaluation at time @p t; returns STATUS_NUMERICAL. */
int continuum_report_inverted(const struct continuum *continuum, double t);

/* continuum_step.c */

int continuum_start(struct solid *solid);
void continuum_load(struct solid *solid);
int continuum_resume(struct solid *solid);
int continuum_begin_step(struct solid *solid);
int continuum_predict(struct solid *solid);
int continuum_solve(struct solid *solid);
int continuum_correct(struct solid *solid, bool added_mass);
int continuum_accept(struct solid *solid);

/* continuum_output.c */

int continuum_fields(struct continuum *continuum);
void continuum_energies(const struct solid *solid, struct solid_energies *energies);
int continuum_locate(const struct solid *solid, const double X[3], struct solid_place *place);
void continuum_evaluate(const struct solid *solid, const struct solid_place *place, double d[3], double v[3],
                        double a[3]);
const double (*continuum_positions(const struct solid *solid))[3];
const struct field_group *continuum_node_fields(const struct solid *solid);
const struct field_group *continuum_cell_fields(const struct solid *solid);
const struct field_group *continuum_state_fields(const struct solid *solid);

#endif
