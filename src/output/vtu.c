// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/vtu.h"

#include "base/error.h"
#include "base/memory.h"
#include "output/appended.h"
#include "output/vtu_types.h"

#include <stdbool.h>
#include <string.h>

// Items in file order: point arrays, cell arrays, points, connectivity, offsets, types.
static void head_write(FILE *stream, const void *what, struct appended_item *items)
{
    const struct vtu_grid *grid = what;
    size_t n_cells = grid->connectivity ? grid->n_cells : grid->n_points;
    appended_begin(stream, "UnstructuredGrid", "", grid->time, grid->cycle);
    fprintf(stream, "<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n", grid->n_points, n_cells);
    appended_point_data(stream, grid->scalars, grid->vectors);
    for (size_t i = 0; i < grid->n_point_arrays; ++i)
        appended_declare(stream, items++);
    fputs("</PointData>\n<CellData>\n", stream);
    for (size_t i = 0; i < grid->n_cell_arrays; ++i)
        appended_declare(stream, items++);
    fputs("</CellData>\n<Points>\n", stream);
    appended_declare(stream, items++);
    fputs("</Points>\n<Cells>\n", stream);
    for (int i = 0; i < 3; ++i)
        appended_declare(stream, items++);
    fputs("</Cells>\n</Piece>\n</UnstructuredGrid>\n", stream);
}

// Number of each point from 0 and from 1, and the type of a vertex: what particles have for cells.
static void vertex_points(const void *data, size_t first, size_t n, void *to)
{
    (void)data;
    for (size_t i = 0; i < n; ++i) { // blocks begin anywhere in a buffer
        const int64_t number = (int64_t)(first + i);
        memcpy((char *)to + i * sizeof number, &number, sizeof number);
    }
}

static void vertex_ends(const void *data, size_t first, size_t n, void *to)
{
    vertex_points(data, first + 1, n, to);
}

static void vertex_types(const void *data, size_t first, size_t n, void *to)
{
    (void)data;
    (void)first;
    memset(to, 1, n); // VTK_VERTEX
}

static void items_fill(struct appended_item *items, const struct vtu_grid *grid)
{
    bool vertices = !grid->connectivity;
    size_t n_cells = vertices ? grid->n_points : grid->n_cells;
    size_t n_connectivity = vertices ? grid->n_points : grid->n_connectivity;
    for (size_t i = 0; i < grid->n_point_arrays + grid->n_cell_arrays; ++i) {
        bool points = i < grid->n_point_arrays;
        const struct vtu_array *array =
            points ? &grid->point_arrays[i] : &grid->cell_arrays[i - grid->n_point_arrays];
        *items++ = appended_array(array, points ? grid->n_points : n_cells);
    }
    *items++ = (struct appended_item){.name = "Points",
                                      .components = 3,
                                      .type = grid->points_type,
                                      .data = grid->points,
                                      .read = grid->points_read,
                                      .bytes = 3 * grid->n_points * vtu_type_size(grid->points_type)};
    *items++ = (struct appended_item){.name = "connectivity",
                                      .components = 1,
                                      .type = VTU_INT64,
                                      .data = grid->connectivity,
                                      .read = vertices ? vertex_points : NULL,
                                      .bytes = n_connectivity * sizeof(int64_t)};
    *items++ = (struct appended_item){.name = "offsets",
                                      .components = 1,
                                      .type = VTU_INT64,
                                      .data = grid->offsets,
                                      .read = vertices ? vertex_ends : NULL,
                                      .bytes = n_cells * sizeof(int64_t)};
    *items++ = (struct appended_item){.name = "types",
                                      .components = 1,
                                      .type = VTU_UINT8,
                                      .data = grid->types,
                                      .read = vertices ? vertex_types : NULL,
                                      .bytes = n_cells};
}

int vtu_write(const char *path, const struct vtu_grid *grid)
{
    size_t n = grid->n_point_arrays + grid->n_cell_arrays + 4;
    struct appended_item *items = memory_create(n, sizeof *items);
    CHECK_MEMORY(items);
    items_fill(items, grid);
    int status = appended_write(path, head_write, grid, items, n);
    memory_free(items);
    return status;
}
