// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/frame.h"

#include "base/error.h"
#include "base/memory.h"
#include "output/vtu.h"

#include <stdio.h>
#include <string.h>

enum { FRAME_ARRAYS = 32, FRAME_BUFFERS = 2 * FRAME_ARRAYS + 8 };

/** The arrays of one file and the memory behind them. */
struct frame_buffers {
    void *memory[FRAME_BUFFERS];
    size_t n;
};

static void *buffer_create(struct frame_buffers *buffers, size_t count, size_t size)
{
    void *memory = memory_create(count, size);
    if (memory)
        buffers->memory[buffers->n++] = memory;
    return memory;
}

static void buffers_reset(struct frame_buffers *buffers)
{
    for (size_t k = 0; k < buffers->n; ++k)
        memory_free(buffers->memory[k]);
}

static enum vtu_type vtu_type_of(enum field_type type, bool float64)
{
    switch (type) {
    case FIELD_DOUBLE:
        return float64 ? VTU_FLOAT64 : VTU_FLOAT32;
    case FIELD_FLOAT:
        return VTU_FLOAT32;
    case FIELD_INT64:
        return VTU_INT64;
    case FIELD_INT32:
        return VTU_INT32;
    default:
        return VTU_UINT8;
    }
}

/** Read a field, narrowed to float unless @p float64 asks for all digits. */
static int field_take(struct frame_buffers *buffers, const struct field_group *group,
                      const struct field *field, bool float64, struct vtu_array *array)
{
    size_t n = *group->count * (size_t)field->components;
    void *values = buffer_create(buffers, n, field_size(field->type));
    CHECK_MEMORY(values);
    CALL(field_read(group, field, values));
    if (field->type == FIELD_DOUBLE && !float64) {
        const double *from = values;
        float *to = values; /* narrowing in place: each float lies before the doubles still to be read */
        for (size_t i = 0; i < n; ++i) {
            float narrow = (float)from[i];
            memcpy(&to[i], &narrow, sizeof narrow);
        }
    }
    snprintf(array->name, sizeof array->name, "%s", field->name);
    array->components = field->components;
    array->type = vtu_type_of(field->type, float64);
    array->data = values;
    return 0;
}

static bool name_listed(const char *name, const char *const *list, size_t n)
{
    for (size_t k = 0; k < n; ++k)
        if (!strcmp(list[k], name))
            return true;
    return false;
}

static int group_take(struct frame_buffers *buffers, const struct frame_writer *writer,
                      const struct field_group *group, bool float64, struct vtu_array *arrays, size_t *n)
{
    *n = 0;
    for (size_t k = 0; group && k < group->n_fields; ++k) {
        const struct field *field = &group->fields[k];
        bool wanted = !writer || name_listed(field->name, writer->always, writer->n_always) ||
                      name_listed(field->name, writer->optional, writer->n_optional);
        if ((field->flags & FIELD_OUTPUT) && wanted && *n < FRAME_ARRAYS)
            CALL(field_take(buffers, group, field, float64, &arrays[(*n)++]));
    }
    return 0;
}

static int points_take(struct frame_buffers *buffers, const struct frame_part *part, size_t n, bool float64,
                       struct vtu_grid *grid)
{
    void *points = buffer_create(buffers, 3 * n, float64 ? sizeof(double) : sizeof(float));
    CHECK_MEMORY(points);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < 3; ++k) {
            double x = part->x[0] ? part->x[k][i] : part->places[i][k];
            if (float64)
                ((double *)points)[3 * i + k] = x;
            else
                ((float *)points)[3 * i + k] = (float)x;
        }
    grid->points = points;
    grid->points_type = float64 ? VTU_FLOAT64 : VTU_FLOAT32;
    grid->n_points = n;
    return 0;
}

static const uint8_t facet_vtk[5] = {0, 0, 3, 5, 9}; /* VTK_LINE, VTK_TRIANGLE, VTK_QUAD by number of nodes */

static int cells_take(struct frame_buffers *buffers, const struct frame_part *part, struct vtu_grid *grid)
{
    grid->n_cells = part->mesh ? part->mesh->n_elements : part->facets ? part->n_facets : grid->n_points;
    if (!part->mesh && !part->facets)
        return 0;
    size_t most = part->mesh ? (size_t)part->mesh->nodes_per_element : 4;
    int64_t *connectivity = buffer_create(buffers, grid->n_cells * most, sizeof *connectivity);
    int64_t *offsets = buffer_create(buffers, grid->n_cells, sizeof *offsets);
    uint8_t *types = buffer_create(buffers, grid->n_cells, 1);
    if (!connectivity || !offsets || !types)
        return STATUS_MEMORY;
    size_t n = 0;
    for (size_t c = 0; c < grid->n_cells; ++c) {
        size_t nodes = 0;
        for (size_t k = 0; k < most; ++k) {
            int32_t node = part->mesh ? part->mesh->connectivity[c * most + k] : part->facets[c][k];
            if (node < 0)
                break;
            connectivity[n + nodes++] = node;
        }
        n += nodes;
        offsets[c] = (int64_t)n;
        types[c] = part->mesh ? (uint8_t)element_vtk(part->mesh->type) : facet_vtk[nodes];
    }
    grid->connectivity = connectivity;
    grid->offsets = offsets;
    grid->types = types;
    grid->n_connectivity = n;
    return 0;
}

static int part_write(const char *path, const struct frame_writer *writer, const struct frame_part *part,
                      bool float64, double t, int64_t cycle, struct frame_buffers *buffers)
{
    struct vtu_array points[FRAME_ARRAYS], cells[FRAME_ARRAYS];
    struct vtu_grid grid = {.time = t,
                            .cycle = cycle,
                            .point_arrays = points,
                            .cell_arrays = cells,
                            .scalars = part->scalars,
                            .vectors = part->vectors};
    CALL(group_take(buffers, writer, part->points, float64, points, &grid.n_point_arrays));
    CALL(group_take(buffers, writer, part->cells, float64, cells, &grid.n_cell_arrays));
    CALL(points_take(buffers, part, *part->points->count, float64, &grid));
    CALL(cells_take(buffers, part, &grid));
    return vtu_write(path, &grid);
}

int frame_write_part(const struct frame_writer *writer, const struct frame_part *part, double t,
                     int64_t cycle)
{
    struct frame_buffers buffers = {.n = 0};
    char file[192];
    snprintf(file, sizeof file, "fields/%s_%s.vtu", part->name, writer->label);
    char *path = memory_print("%s/%s", writer->folder, file);
    CHECK_MEMORY(path);
    int status = part_write(path, writer, part, writer->float64, t, cycle, &buffers);
    buffers_reset(&buffers);
    memory_free(path);
    return status ? status : pvd_add(writer->pvd, t, part->part, part->name, file);
}

int frame_write_single(const char *path, const struct frame_part *part, double t, int64_t cycle)
{
    struct frame_buffers buffers = {.n = 0};
    int status = part_write(path, NULL, part, true, t, cycle, &buffers);
    buffers_reset(&buffers);
    return status;
}
