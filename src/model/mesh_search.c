// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/mesh_search.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/** How far outside its natural coordinates a point may lie and still count as inside an element. */
static const double tolerance = 1e-6;

enum { ITERATIONS = 20, MOST_CELLS = 512 };

/** Box around all places that element @p e may hold. */
static void element_box(const struct mesh_search *search, size_t e, double low[3], double high[3])
{
    const struct mesh *mesh = search->mesh;
    const int32_t *nodes = &mesh->connectivity[e * (size_t)mesh->nodes_per_element];
    for (int d = 0; d < 3; d++) {
        low[d] = high[d] = 0;
        if (d >= mesh->dim)
            continue;
        low[d] = INFINITY;
        high[d] = -INFINITY;
        for (int a = 0; a < mesh->nodes_per_element; a++) {
            low[d] = fmin(low[d], mesh->X[nodes[a]][d]);
            high[d] = fmax(high[d], mesh->X[nodes[a]][d]);
        }
        /* a curved side may bulge beyond its nodes, at most by as much again */
        const double more =
            (element_is_quadratic(mesh->type) ? 1 : tolerance) * (high[d] - low[d]) + search->margin;
        low[d] -= more;
        high[d] += more;
    }
}

/** Cells about as large as an element. */
static void cells_choose(struct mesh_search *search)
{
    const struct mesh *mesh = search->mesh;
    double upper[3] = {0}, volume = 1;
    for (int d = 0; d < 3; d++) {
        search->cells[d] = 1;
        search->size[d] = 1;
        search->lower[d] = d < mesh->dim ? INFINITY : 0;
        upper[d] = d < mesh->dim ? -INFINITY : 0;
    }
    for (size_t e = 0; e < mesh->n_elements; e++) {
        double low[3], high[3];
        element_box(search, e, low, high);
        for (int d = 0; d < mesh->dim; d++) {
            search->lower[d] = fmin(search->lower[d], low[d]);
            upper[d] = fmax(upper[d], high[d]);
        }
    }
    for (int d = 0; d < mesh->dim; d++)
        volume *= upper[d] - search->lower[d];
    const double size = pow(volume / (double)mesh->n_elements, 1.0 / mesh->dim);
    for (int d = 0; d < mesh->dim && size > 0; d++) {
        const double length = upper[d] - search->lower[d];
        search->cells[d] = (int)fmin(MOST_CELLS, fmax(1, ceil(length / size)));
        search->size[d] = length / search->cells[d];
    }
}

/** Cell of a place along direction @p d, of those that there are. */
static int cell_along(const struct mesh_search *search, int d, double x)
{
    const double cell = floor((x - search->lower[d]) / search->size[d]);
    return (int)fmin(search->cells[d] - 1, fmax(0, cell));
}

static size_t cell_number(const struct mesh_search *search, const int cell[3])
{
    return ((size_t)cell[2] * (size_t)search->cells[1] + (size_t)cell[1]) * (size_t)search->cells[0] +
           (size_t)cell[0];
}

/** Count the elements of each cell into @p count, or (@p elements) write them there; then @p count is where
 * the next one goes. */
static void cells_visit(const struct mesh_search *search, uint32_t *count, uint32_t *elements)
{
    for (size_t e = 0; e < search->mesh->n_elements; e++) {
        double low[3], high[3];
        int first[3], last[3], cell[3];
        element_box(search, e, low, high);
        for (int d = 0; d < 3; d++) {
            first[d] = cell_along(search, d, low[d]);
            last[d] = cell_along(search, d, high[d]);
        }
        for (cell[2] = first[2]; cell[2] <= last[2]; cell[2]++)
            for (cell[1] = first[1]; cell[1] <= last[1]; cell[1]++)
                for (cell[0] = first[0]; cell[0] <= last[0]; cell[0]++) {
                    const uint32_t place = count[cell_number(search, cell)]++;
                    if (elements)
                        elements[place] = (uint32_t)e;
                }
    }
}

int mesh_search_init(struct mesh_search *search, const struct mesh *mesh, double margin)
{
    *search = (struct mesh_search){.mesh = mesh, .margin = margin};
    cells_choose(search);
    const size_t n = (size_t)search->cells[0] * (size_t)search->cells[1] * (size_t)search->cells[2];
    CHECK_MEMORY(search->start = memory_create(n + 1, sizeof *search->start));
    cells_visit(search, search->start, NULL);
    uint32_t sum = 0;
    for (size_t c = 0; c <= n; c++) {
        const uint32_t count = search->start[c];
        search->start[c] = sum;
        sum += count;
    }
    search->elements = memory_create(sum, sizeof *search->elements);
    if (!search->elements) {
        mesh_search_reset(search);
        return STATUS_MEMORY;
    }
    cells_visit(search, search->start, search->elements);
    memmove(search->start + 1, search->start, n * sizeof *search->start);
    search->start[0] = 0;
    return 0;
}

void mesh_search_reset(struct mesh_search *search)
{
    memory_free(search->start);
    memory_free(search->elements);
    *search = (struct mesh_search){0};
}

/** How far @p xi lies outside the element (0: inside). */
static double outside(enum element_type type, const double xi[3])
{
    const int dim = element_dim(type);
    double excess = 0, sum = 0;
    for (int d = 0; d < dim; d++) {
        const bool simplex = element_is_simplex(type);
        excess = fmax(excess, simplex ? -xi[d] : fabs(xi[d]) - 1);
        sum += simplex ? xi[d] : 0;
    }
    return fmax(excess, sum - 1);
}

/** Solve the dim x dim system J step = r by Cramer's rule; false when it is singular. */
static bool solve_small(int dim, double J[3][3], const double r[3], double step[3])
{
    if (dim == 2)
        J[2][2] = 1;
    double inverse[3][3], det = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int p = (j + 1) % 3, q = (j + 2) % 3, s = (i + 1) % 3, u = (i + 2) % 3;
            inverse[i][j] = J[p][s] * J[q][u] - J[p][u] * J[q][s];
        }
    for (int j = 0; j < 3; j++)
        det += J[0][j] * inverse[j][0];
    if (!(fabs(det) > 0))
        return false;
    for (int i = 0; i < 3; i++)
        step[i] = (inverse[i][0] * r[0] + inverse[i][1] * r[1] + inverse[i][2] * r[2]) / det;
    return true;
}

/** Natural coordinates of @p X in an element by Newton's method; false when it does not converge. */
static bool invert_map(const struct mesh *mesh, size_t element, const double X[3], double xi[3])
{
    const int32_t *nodes = &mesh->connectivity[element * (size_t)mesh->nodes_per_element];
    xi[0] = xi[1] = xi[2] = element_is_simplex(mesh->type) ? 0.25 : 0;
    for (int iteration = 0; iteration < ITERATIONS; iteration++) {
        double N[ELEMENT_MAX_NODES], dN[ELEMENT_MAX_NODES][3], J[3][3] = {{0}}, r[3] = {0}, step[3];
        element_shape(mesh->type, xi, N, dN);
        for (int i = 0; i < mesh->dim; i++) {
            r[i] = X[i];
            for (int a = 0; a < mesh->nodes_per_element; a++) {
                r[i] -= N[a] * mesh->X[nodes[a]][i];
                for (int A = 0; A < mesh->dim; A++)
                    J[i][A] += mesh->X[nodes[a]][i] * dN[a][A];
            }
        }
        if (!solve_small(mesh->dim, J, r, step))
            return false;
        double length = 0;
        for (int i = 0; i < mesh->dim; i++) {
            xi[i] += step[i];
            length = fmax(length, fabs(step[i]));
        }
        if (length < 1e-13)
            return true;
        if (!(length < 1e6))
            return false;
    }
    return outside(mesh->type, xi) <= tolerance;
}

/** At least the distance of @p X from an element in which it has the natural coordinates @p xi. */
static double distance(const struct mesh *mesh, size_t element, const double X[3], const double xi[3])
{
    const int32_t *nodes = &mesh->connectivity[element * (size_t)mesh->nodes_per_element];
    const bool simplex = element_is_simplex(mesh->type);
    double at[3] = {0}, N[ELEMENT_MAX_NODES], sum = 0, square = 0;
    for (int d = 0; d < mesh->dim; d++) {
        at[d] = fmax(simplex ? 0 : -1, fmin(1, xi[d]));
        sum += at[d];
    }
    for (int d = 0; d < mesh->dim && simplex && sum > 1; d++)
        at[d] /= sum;
    element_shape(mesh->type, at, N, NULL);
    for (int d = 0; d < mesh->dim; d++) {
        double away = X[d];
        for (int a = 0; a < mesh->nodes_per_element; a++)
            away -= N[a] * mesh->X[nodes[a]][d];
        square += away * away;
    }
    return sqrt(square);
}

bool mesh_search_find(const struct mesh_search *search, const double X[3], size_t *element, double xi[3])
{
    const struct mesh *mesh = search->mesh;
    int cell[3];
    double best = INFINITY;
    for (int d = 0; d < 3; d++)
        cell[d] = d < mesh->dim ? cell_along(search, d, X[d]) : 0;
    const size_t number = cell_number(search, cell);
    for (uint32_t c = search->start[number]; c < search->start[number + 1] && best > 0; c++) {
        const size_t e = search->elements[c];
        double low[3], high[3], trial[3];
        bool near = true;
        element_box(search, e, low, high);
        for (int d = 0; d < mesh->dim; d++)
            near = near && X[d] >= low[d] && X[d] <= high[d];
        if (!near || !invert_map(mesh, e, X, trial))
            continue;
        const double excess = outside(mesh->type, trial);
        if (excess >= best || (excess > tolerance && distance(mesh, e, X, trial) > search->margin))
            continue;
        best = excess;
        *element = e;
        memcpy(xi, trial, sizeof trial);
    }
    return best < INFINITY;
}

int mesh_search_once(const struct mesh *mesh, const double X[3], int *element, double xi[3])
{
    struct mesh_search search;
    size_t found;
    CALL(mesh_search_init(&search, mesh, 0.0));
    const bool inside = mesh_search_find(&search, X, &found, xi);
    mesh_search_reset(&search);
    *element = inside ? (int)found : -1;
    return inside ? STATUS_OK : STATUS_DECK;
}
