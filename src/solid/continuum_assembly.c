// SPDX-License-Identifier: GPL-3.0-or-later
/* Sums over elements: consistent mass, internal force and tangent of the weak form (paper 000 eq. 26), into a
 * fixed pattern. */
#include "solid/continuum.h"

#include "base/error.h"
#include "base/memory.h"
#include "solid/element/quadrature.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BATCH = 64,       /**< elements whose stiffnesses are held at a time */
    LEAST_SHARED = 64 /**< fewer elements are not worth more than one thread */
};

/** Round-off of internal forces in units of (stiffness x area of an element's side). */
static const double rounding = 64 * DBL_EPSILON;

static const int32_t *element_nodes_of(const struct continuum *continuum, size_t element)
{
    return &continuum->mesh->connectivity[element * (size_t)continuum->mesh->nodes_per_element];
}

static void gather_places(const struct continuum *continuum, size_t element, double (*X)[3])
{
    const int32_t *nodes = element_nodes_of(continuum, element);
    for (int a = 0; a < continuum->mesh->nodes_per_element; a++)
        memcpy(X[a], continuum->mesh->X[nodes[a]], sizeof X[a]);
}

static int build_elements(struct continuum *continuum)
{
    const size_t n = continuum->mesh->n_elements, size = continuum->kernel->data_size;
    double largest = 0;
    continuum->element_data = memory_create(n * size, sizeof *continuum->element_data);
    CHECK_MEMORY(continuum->element_data);
    CHECK_MEMORY(continuum->element_forces = memory_create(n * (size_t)continuum->dof, sizeof(double)));
    CHECK_MEMORY(continuum->batch =
                     memory_create((size_t)(BATCH * continuum->dof * continuum->dof), sizeof(double)));
    for (size_t e = 0; e < n; e++) {
        double X[ELEMENT_MAX_NODES][3], *data = continuum->element_data + e * size;
        const double rest[ELEMENT_MAX_DOF] = {0};
        double volume;
        gather_places(continuum, e, X);
        CALL(continuum->kernel->prepare((const double(*)[3])X, &continuum->material, data));
        continuum->kernel->energy(data, &continuum->material, rest, NULL, &volume);
        largest = fmax(largest, volume);
    }
    double S[VOIGT_MAX], D[VOIGT_MAX * VOIGT_MAX];
    const double strain[VOIGT_MAX] = {0};
    continuum->material.law->stress(continuum->material.parameters, continuum->dim, strain, S, D);
    continuum->force_floor =
        rounding * D[0] * pow(largest, (continuum->dim - 1.0) / continuum->dim) * sqrt((double)n);
    return 0;
}

/** Number the components that are not prescribed. */
static int build_equations(struct continuum *continuum)
{
    const size_t n = continuum->mesh->n_nodes;
    continuum->equation = memory_create(3 * n, sizeof *continuum->equation);
    continuum->component = memory_create(3 * n, sizeof *continuum->component);
    continuum->moving_support = memory_create(n, sizeof *continuum->moving_support);
    if (!continuum->equation || !continuum->component || !continuum->moving_support)
        return STATUS_MEMORY;
    for (size_t a = 0; a < n; a++) {
        continuum->moving_support[a] = -1;
        for (int i = continuum->dim; i < 3; i++)
            continuum->equation[3 * a + (size_t)i] = -1;
    }
    for (size_t s = 0; s < continuum->definition->n_supports; s++) {
        const struct model_support *support = &continuum->definition->supports[s];
        const struct node_set *set = &continuum->mesh->sets[support->set];
        for (size_t k = 0; k < set->n; k++) {
            if (support->moves)
                continuum->moving_support[set->nodes[k]] = (int32_t)s;
            for (int i = 0; i < continuum->dim; i++)
                if (support->moves || support->fixed[i])
                    continuum->equation[3 * set->nodes[k] + i] = -1;
        }
    }
    for (size_t c = 0; c < 3 * n; c++)
        if (continuum->equation[c] >= 0) {
            continuum->component[continuum->n_free] = (int32_t)c;
            continuum->equation[c] = (int32_t)continuum->n_free++;
        }
    return 0;
}

static int compare_pairs(const void *a, const void *b)
{
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

/** Which nodes share an element: compressed rows, ascending. */
static int build_neighbours(struct continuum *continuum)
{
    const struct mesh *mesh = continuum->mesh;
    const size_t per = (size_t)mesh->nodes_per_element, n = mesh->n_elements * per * per;
    uint64_t *pairs = memory_create(n, sizeof *pairs);
    CHECK_MEMORY(pairs);
    for (size_t e = 0, k = 0; e < mesh->n_elements; e++)
        for (size_t a = 0; a < per; a++)
            for (size_t b = 0; b < per; b++, k++)
                pairs[k] = (uint64_t)element_nodes_of(continuum, e)[a] << 32 |
                           (uint64_t)element_nodes_of(continuum, e)[b];
    qsort(pairs, n, sizeof *pairs, compare_pairs);
    size_t unique = 0;
    for (size_t k = 0; k < n; k++)
        if (k == 0 || pairs[k] != pairs[k - 1])
            pairs[unique++] = pairs[k];
    continuum->mass_rows = memory_create(mesh->n_nodes + 1, sizeof *continuum->mass_rows);
    continuum->mass_columns = memory_create(unique, sizeof *continuum->mass_columns);
    continuum->mass = memory_create(unique, sizeof *continuum->mass);
    continuum->nodal_mass = memory_create(mesh->n_nodes, sizeof *continuum->nodal_mass);
    if (continuum->mass_rows && continuum->mass_columns && continuum->mass && continuum->nodal_mass) {
        for (size_t k = 0; k < unique; k++) {
            continuum->mass_rows[(pairs[k] >> 32) + 1]++;
            continuum->mass_columns[k] = (int32_t)(pairs[k] & 0xffffffff);
        }
        for (size_t a = 0; a < mesh->n_nodes; a++)
            continuum->mass_rows[a + 1] += continuum->mass_rows[a];
    }
    memory_free(pairs);
    return continuum->nodal_mass ? 0 : STATUS_MEMORY;
}

/** Position of the pair (a, b) in the nodes' rows. */
static size_t find_pair(const struct continuum *continuum, int32_t a, int32_t b)
{
    size_t low = continuum->mass_rows[a], high = continuum->mass_rows[a + 1] - 1;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (continuum->mass_columns[middle] < b)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/** M_ab = integral of rho N_a N_b. */
static void build_mass(struct continuum *continuum)
{
    const struct mesh *mesh = continuum->mesh;
    const struct quadrature rule = quadrature_of(mesh->type, QUADRATURE_MASS);
    const int per = mesh->nodes_per_element;
    for (size_t e = 0; e < mesh->n_elements; e++) {
        const int32_t *nodes = element_nodes_of(continuum, e);
        for (int p = 0; p < rule.n; p++) {
            double N[ELEMENT_MAX_NODES];
            const double det = mesh_jacobian(mesh, e, rule.xi[p]);
            element_shape(mesh->type, rule.xi[p], N, NULL);
            for (int a = 0; a < per; a++)
                for (int b = 0; b < per; b++) {
                    const double m = continuum->density * rule.weight[p] * det * N[a] * N[b];
                    continuum->mass[find_pair(continuum, nodes[a], nodes[b])] += m;
                    continuum->nodal_mass[nodes[a]] += m;
                }
        }
    }
}

/** Upper triangle of the system matrix. The two passes count and fill. */
static int build_pattern(struct continuum *continuum)
{
    const size_t n = continuum->n_free;
    continuum->columns = memory_create(n + 1, sizeof *continuum->columns);
    CHECK_MEMORY(continuum->columns);
    for (int pass = 0; pass < 2; pass++) {
        size_t count = 0;
        for (size_t j = 0; j < n; j++) {
            const int32_t node = continuum->component[j] / 3;
            for (size_t k = continuum->mass_rows[node]; k < continuum->mass_rows[node + 1]; k++)
                for (int i = 0; i < continuum->dim; i++) {
                    const int32_t row = continuum->equation[3 * continuum->mass_columns[k] + i];
                    if (row < 0 || (size_t)row > j)
                        continue;
                    if (pass == 1) {
                        continuum->rows[count] = row;
                        if (i == continuum->component[j] % 3)
                            continuum->mass_values[count] = continuum->mass[k];
                    }
                    count++;
                }
            continuum->columns[j + 1] = (long)count;
        }
        if (pass == 1)
            break;
        CHECK(count < INT32_MAX, STATUS_DECK,
              "<mesh name=\"%s\">: the stiffness matrix has %zu entries; at most %d are possible",
              continuum->definition->name, count, INT32_MAX);
        continuum->nonzeros = count;
        continuum->rows = memory_create(count, sizeof *continuum->rows);
        continuum->values = memory_create(count, sizeof *continuum->values);
        continuum->mass_values = memory_create(count, sizeof *continuum->mass_values);
        if (!continuum->rows || !continuum->values || !continuum->mass_values)
            return STATUS_MEMORY;
    }
    return 0;
}

/** Where entry (row, column) of the upper triangle is. */
static int32_t find_entry(const struct continuum *continuum, int32_t row, int32_t column)
{
    long low = continuum->columns[column], high = continuum->columns[column + 1] - 1;
    while (low < high) {
        const long middle = (low + high) / 2;
        if (continuum->rows[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return (int32_t)low;
}

static int build_scatter(struct continuum *continuum)
{
    const int dof = continuum->dof, dim = continuum->dim;
    const size_t size = (size_t)(dof * dof);
    continuum->scatter = memory_create(continuum->mesh->n_elements * size, sizeof *continuum->scatter);
    CHECK_MEMORY(continuum->scatter);
    for (size_t e = 0; e < continuum->mesh->n_elements; e++) {
        const int32_t *nodes = element_nodes_of(continuum, e);
        int32_t *scatter = continuum->scatter + e * size;
        for (int p = 0; p < dof; p++)
            for (int q = 0; q < dof; q++) {
                const int32_t row = continuum->equation[3 * nodes[p / dim] + p % dim];
                const int32_t column = continuum->equation[3 * nodes[q / dim] + q % dim];
                scatter[p * dof + q] = row < 0 || row > column ? -1 : find_entry(continuum, row, column);
            }
    }
    return 0;
}

int continuum_build(struct continuum *continuum)
{
    CALL(build_elements(continuum));
    CALL(build_equations(continuum));
    CALL(build_neighbours(continuum));
    build_mass(continuum);
    CALL(build_pattern(continuum));
    CALL(build_scatter(continuum));
    if (continuum->n_free == 0)
        return 0;
    return sparse_solver_create(&continuum->solver, continuum->n_free, continuum->columns, continuum->rows);
}

void continuum_gather(const struct continuum *continuum, size_t element, const double (*d)[3], double *local)
{
    const int32_t *nodes = element_nodes_of(continuum, element);
    const int dim = continuum->dim;
    for (int a = 0; a < continuum->mesh->nodes_per_element; a++)
        for (int i = 0; i < dim; i++)
            local[a * dim + i] = d[nodes[a]][i];
}

/** Internal forces and, unless NULL, stiffnesses of elements @p first .. @p first + @p n - 1, one after the
 * other. STATUS_NUMERICAL (not reported, bad_element set) when one is inverted. */
static int elements_evaluate(struct continuum *continuum, size_t first, size_t n, const double (*d)[3],
                             double *forces, double *K)
{
    const struct element_kernel *kernel = continuum->kernel;
    const size_t dof = (size_t)continuum->dof;
    size_t bad = SIZE_MAX;
#pragma omp parallel for schedule(static) reduction(min : bad) if (n >= LEAST_SHARED)
    for (size_t e = 0; e < n; e++) {
        double local[ELEMENT_MAX_DOF];
        continuum_gather(continuum, first + e, d, local);
        if (kernel->forces(continuum->element_data + (first + e) * kernel->data_size, &continuum->material,
                           local, forces + e * dof, K ? K + e * dof * dof : NULL))
            bad = first + e < bad ? first + e : bad;
    }
    if (bad == SIZE_MAX)
        return 0;
    continuum->bad_element = bad;
    return STATUS_NUMERICAL;
}

int continuum_internal_forces(struct continuum *continuum, const double (*d)[3], double (*f)[3])
{
    const int dim = continuum->dim, per = continuum->mesh->nodes_per_element;
    const double *force = continuum->element_forces;
    CALL(elements_evaluate(continuum, 0, continuum->mesh->n_elements, d, continuum->element_forces, NULL));
    memset(f, 0, continuum->mesh->n_nodes * sizeof *f);
    for (size_t e = 0; e < continuum->mesh->n_elements; e++) {
        const int32_t *nodes = element_nodes_of(continuum, e);
        for (int a = 0; a < per; a++)
            for (int i = 0; i < dim; i++)
                f[nodes[a]][i] += *force++;
    }
    return 0;
}

int continuum_factor(struct continuum *continuum, double mass_factor, double stiffness_factor,
                     const double (*d)[3])
{
    const size_t size = (size_t)(continuum->dof * continuum->dof), n = continuum->mesh->n_elements;
    for (size_t k = 0; k < continuum->nonzeros; k++)
        continuum->values[k] = mass_factor * continuum->mass_values[k];
    for (size_t first = 0; stiffness_factor > 0 && first < n; first += BATCH) {
        const size_t count = n - first < BATCH ? n - first : BATCH;
        const double *K = continuum->batch;
        if (elements_evaluate(continuum, first, count, d, continuum->element_forces, continuum->batch))
            return continuum_report_inverted(continuum, continuum->solid->t + continuum->solid->dt);
        const int32_t *scatter = continuum->scatter + first * size;
        for (size_t k = 0; k < count * size; k++)
            if (scatter[k] >= 0)
                continuum->values[scatter[k]] += stiffness_factor * K[k];
    }
    return sparse_solver_factor(continuum->solver, continuum->values);
}

void continuum_mass_times(const struct continuum *continuum, const double (*x)[3], double (*y)[3])
{
    for (size_t a = 0; a < continuum->mesh->n_nodes; a++) {
        double sum[3] = {0};
        for (size_t k = continuum->mass_rows[a]; k < continuum->mass_rows[a + 1]; k++)
            for (int i = 0; i < 3; i++)
                sum[i] += continuum->mass[k] * x[continuum->mass_columns[k]][i];
        memcpy(y[a], sum, sizeof sum);
    }
}

int continuum_report_inverted(const struct continuum *continuum, double t)
{
    const int32_t node = element_nodes_of(continuum, continuum->bad_element)[0];
    const double *X = continuum->mesh->X[node];
    return error_report(STATUS_NUMERICAL,
                        "solid \"%s\": element %zu (first node at reference place %g, %g, %g) is inverted or "
                        "unstable at t = %g s; "
                        "the load or the step is too large for this mesh",
                        continuum->definition->name, continuum->bad_element, X[0], X[1], X[2], t);
}
