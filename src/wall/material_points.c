// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall/material_points.h"

#include "base/error.h"
#include "base/memory.h"

#include <string.h>

static const int32_t *element_nodes_of(const struct mesh *mesh, uint32_t element)
{
    return &mesh->connectivity[(size_t)element * (size_t)mesh->nodes_per_element];
}

static int reserve(struct material_points *material, const struct model *model,
                   const struct wall_places *places)
{
    size_t nodes = 0;
    for (size_t k = 0; k < places->n; ++k)
        if (places->mesh[k] >= 0) {
            ++material->n;
            nodes += (size_t)model->meshes[places->mesh[k]].mesh.nodes_per_element;
        }
    CHECK_MEMORY(material->particle = memory_create(material->n, sizeof *material->particle));
    CHECK_MEMORY(material->surface = memory_create(material->n, sizeof *material->surface));
    CHECK_MEMORY(material->start = memory_create(material->n + 1, sizeof *material->start));
    CHECK_MEMORY(material->points = memory_create(nodes, sizeof *material->points));
    CHECK_MEMORY(material->weights = memory_create(nodes, sizeof *material->weights));
    return 0;
}

/** Particles, their surfaces and weights; points are nodes still. */
static void rows_fill(struct material_points *material, const struct model *model,
                      const struct wall_places *places)
{
    size_t row = 0;
    for (size_t k = 0; k < places->n; ++k) {
        if (places->mesh[k] < 0)
            continue;
        const struct mesh *mesh = &model->meshes[places->mesh[k]].mesh;
        const uint32_t first = material->start[row];
        double N[ELEMENT_MAX_NODES];
        element_shape(mesh->type, places->xi[k], N, NULL);
        memcpy(material->points + first, element_nodes_of(mesh, places->element[k]),
               (size_t)mesh->nodes_per_element * sizeof *material->points);
        memcpy(material->weights + first, N, (size_t)mesh->nodes_per_element * sizeof *material->weights);
        material->particle[row] = (uint32_t)k;
        material->surface[row] = places->surface[k];
        material->start[++row] = first + (uint32_t)mesh->nodes_per_element;
    }
}

/** Let surface @p s follow all nodes of mesh @p mesh that its particles need, then put points for nodes.
 * @p point_of: workspace for all nodes of the mesh. */
static int nodes_follow(struct material_points *material, struct boundary *boundary,
                        const struct model *model, const struct wall_places *places, size_t s, int mesh,
                        int32_t *point_of, int32_t *missing)
{
    enum { UNUSED = -1, MISSING = -2 };
    struct surface *surface = boundary->surfaces[s];
    const size_t n_nodes = model->meshes[mesh].mesh.n_nodes;
    size_t n_missing = 0;
    for (size_t node = 0; node < n_nodes; ++node)
        point_of[node] = UNUSED;
    for (size_t row = 0; row < material->n; ++row)
        for (uint32_t j = material->start[row]; j < material->start[row + 1]; ++j)
            if (material->surface[row] == (int32_t)s && places->mesh[material->particle[row]] == mesh)
                point_of[material->points[j]] = MISSING;
    for (size_t p = 0; p < surface->n_points; ++p)
        if (surface->mesh[p] == mesh)
            point_of[surface->mesh_node[p]] = (int32_t)p;
    for (size_t node = 0; node < n_nodes; ++node)
        if (point_of[node] == MISSING) {
            point_of[node] = (int32_t)(surface->n_points + n_missing);
            missing[n_missing++] = (int32_t)node;
        }
    CALL(surface_add_nodes(surface, model, mesh, n_missing, missing));
    for (size_t row = 0; row < material->n; ++row)
        for (uint32_t j = material->start[row]; j < material->start[row + 1]; ++j)
            if (material->surface[row] == (int32_t)s && places->mesh[material->particle[row]] == mesh)
                material->points[j] = point_of[material->points[j]];
    return 0;
}

int material_points_init(struct material_points *material, struct boundary *boundary,
                         const struct model *model, const struct wall_places *places)
{
    *material = (struct material_points){0};
    CALL(reserve(material, model, places));
    rows_fill(material, model, places);
    int status = 0;
    for (size_t m = 0; m < model->n_meshes && !status; ++m) {
        int32_t *work = memory_create(2 * model->meshes[m].mesh.n_nodes, sizeof *work);
        CHECK_MEMORY(work);
        for (size_t s = 0; s < boundary->n_surfaces && !status; ++s)
            if (wall_places_has_mesh(boundary->surfaces[s]->definition, (int)m))
                status = nodes_follow(material, boundary, model, places, s, (int)m, work,
                                      work + model->meshes[m].mesh.n_nodes);
        memory_free(work);
    }
    return status;
}

void material_points_reset(struct material_points *material)
{
    memory_free(material->particle);
    memory_free(material->surface);
    memory_free(material->start);
    memory_free(material->points);
    memory_free(material->weights);
    *material = (struct material_points){0};
}

void material_points_motion(const struct material_points *material, const struct boundary *boundary, size_t k,
                            double x[3], double v[3], double a[3])
{
    const struct surface_motion *now = &boundary->surfaces[material->surface[k]]->now;
    for (int d = 0; d < 3; ++d)
        x[d] = v[d] = a[d] = 0.0;
    for (uint32_t j = material->start[k]; j < material->start[k + 1]; ++j)
        for (int d = 0; d < 3; ++d) {
            x[d] += material->weights[j] * now->x[material->points[j]][d];
            v[d] += material->weights[j] * now->v[material->points[j]][d];
            a[d] += material->weights[j] * now->a[material->points[j]][d];
        }
}

void material_points_load(const struct material_points *material, struct boundary *boundary, size_t k,
                          const double force[3])
{
    struct surface *surface = boundary->surfaces[material->surface[k]];
    for (uint32_t j = material->start[k]; j < material->start[k + 1]; ++j)
        for (int d = 0; d < 3; ++d)
            surface->load[material->points[j]][d] += material->weights[j] * force[d];
}

void material_points_contact(const struct material_points *material, const struct boundary *boundary,
                             size_t k, struct added_mass_contact *contact)
{
    struct anchor *anchors = boundary->surfaces[material->surface[k]]->anchors;
    contact->row = contact->column = material->start[k];
    contact->n_rows = contact->n_columns = material->start[k + 1] - material->start[k];
    for (uint32_t j = material->start[k]; j < material->start[k + 1]; ++j)
        anchors[j] = (struct anchor){material->weights[j], material->points[j]};
}
