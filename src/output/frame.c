// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/frame.h"

#include "base/error.h"
#include "base/memory.h"
#include "output/vtu.h"

#include <stdio.h>
#include <string.h>

enum { FRAME_ARRAYS = 32, FRAME_VALUES = 2 * FRAME_ARRAYS + 1, FRAME_BUFFERS = FRAME_VALUES + 8 };

/** Where the numbers of an array lie: they are gathered, and narrowed, only as they are written. */
struct frame_values {
    const void *from[3]; /**< one array per component, or interleaved in the first */
    enum field_type type;
    size_t components;
    bool separate, float64;
};

/** The arrays of one file and the memory behind them. */
struct frame_buffers {
    void *memory[FRAME_BUFFERS];
    size_t n;
    struct frame_values values[FRAME_VALUES];
    size_t n_values;
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

static void number_read(const struct frame_values *values, const void *from, size_t index, size_t i, void *to)
{
    const size_t size = field_size(values->type);
    if (values->type != FIELD_DOUBLE)
        memcpy((char *)to + i * size, (const char *)from + index * size, size);
    else if (values->float64)
        ((double *)to)[i] = ((const double *)from)[index];
    else
        ((float *)to)[i] = (float)((const double *)from)[index];
}

static void values_read(const void *data, size_t first, size_t n, void *to)
{
    const struct frame_values *values = data;
    if (!values->separate) {
        for (size_t i = 0; i < n; ++i)
            number_read(values, values->from[0], first + i, i, to);
        return;
    }
    size_t row = first / values->components, c = first % values->components;
    for (size_t i = 0; i < n; ++i) {
        number_read(values, values->from[c], row, i, to);
        if (++c == values->components) {
            c = 0;
            ++row;
        }
    }
}

/** Declare a field, narrowed to float unless @p float64 asks for all digits. */
static int field_take(struct frame_buffers *buffers, const struct field_group *group,
                      const struct field *field, bool float64, struct vtu_array *array)
{
    struct frame_values *values = &buffers->values[buffers->n_values++];
    const size_t components = (size_t)field->components;
    *values = (struct frame_values){.from = {field->data[0], field->data[1], field->data[2]},
                                    .type = field->type,
                                    .components = components,
                                    .separate = components > 1 && field->data[1],
                                    .float64 = float64};
    if (!field->data[0] && field->fill) {
        void *filled = buffer_create(buffers, *group->count * components, field_size(field->type));
        CHECK_MEMORY(filled);
        CALL(field_read(group, field, filled));
        values->from[0] = filled;
        values->separate = false;
    }
    snprintf(array->name, sizeof array->name, "%s", field->name);
    array->components = field->components;
    array->type = vtu_type_of(field->type, float64);
    array->data = values;
    array->read = values_read;
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

static void points_take(struct frame_buffers *buffers, const struct frame_part *part, size_t n, bool float64,
                        struct vtu_grid *grid)
{
    struct frame_values *values = &buffers->values[buffers->n_values++];
    *values = (struct frame_values){.type = FIELD_DOUBLE, .components = 3, .float64 = float64};
    values->separate = part->x[0];
    if (values->separate)
        memcpy(values->from, part->x, sizeof values->from);
    else
        values->from[0] = part->places;
    grid->points = values;
    grid->points_read = values_read;
    grid->points_type = float64 ? VTU_FLOAT64 : VTU_FLOAT32;
    grid->n_points = n;
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
    points_take(buffers, part, *part->points->count, float64, &grid);
    CALL(cells_take(buffers, part, &grid));
    return vtu_write(path, &grid);
}

int frame_write_part(const struct frame_writer *writer, const struct frame_part *part, double t,
                     int64_t cycle)
{
    struct frame_buffers buffers = {0};
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
    struct frame_buffers buffers = {0};
    int status = part_write(path, NULL, part, true, t, cycle, &buffers);
    buffers_reset(&buffers);
    return status;
}
