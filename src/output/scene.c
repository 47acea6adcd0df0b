// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/scene.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "output/series.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { VERTEX = 1 }; // VTK cell type
static const char speed[] = "Speed";

// What is drawn of an array: one of its components, or (below 0) a scalar or the magnitude of a vector.
static double array_value(const struct vtu_array *array, int component, size_t index)
{
    size_t n = (size_t)array->components;
    double sum = 0.0;
    if (component >= 0)
        return series_value(array, n * index + (size_t)component);
    if (n == 1)
        return series_value(array, index);
    for (size_t c = 0; c < n; ++c)
        sum += series_value(array, n * index + c) * series_value(array, n * index + c);
    return sqrt(sum);
}

static int parts_read(struct scene *scene, const struct series *series, size_t frame)
{
    const struct pvd_entry *entries = series->pvd.entries + series->first[frame];
    const size_t n = series->first[frame + 1] - series->first[frame];
    scene->time = series_time(series, frame);
    scene->parts = memory_create(n, sizeof *scene->parts);
    CHECK_MEMORY(scene->parts);
    for (size_t i = 0; i < n; ++i) {
        memcpy(scene->parts[i].name, entries[i].name, sizeof entries[i].name);
        CALL(series_read(series, &entries[i], &scene->parts[i].file));
        scene->n_parts = i + 1;
    }
    return 0;
}

static bool is_fluid(const struct scene_part *part)
{
    return strcmp(part->name, "fluid") == 0;
}

// The fluid is coloured; without one, the solids are.
static bool is_coloured(const struct scene *scene, const struct scene_part *part)
{
    for (size_t i = 0; i < scene->n_parts; ++i)
        if (is_fluid(&scene->parts[i]))
            return is_fluid(part);
    return strncmp(part->name, "solid", 5) == 0;
}

static void bounds_find(struct scene *scene)
{
    for (int c = 0; c < 3; ++c) {
        scene->lower[c] = INFINITY;
        scene->upper[c] = -INFINITY;
    }
    for (size_t p = 0; p < scene->n_parts; ++p) {
        const struct vtu_grid *grid = &scene->parts[p].file.grid;
        for (size_t i = 0; i < grid->n_points; ++i) {
            double x[3];
            series_point(grid, i, x);
            for (int c = 0; c < 3; ++c)
                if (isfinite(x[c])) {
                    scene->lower[c] = fmin(scene->lower[c], x[c]);
                    scene->upper[c] = fmax(scene->upper[c], x[c]);
                }
        }
    }
    scene->dim = scene->upper[2] > scene->lower[2] ? 3 : scene->upper[1] > scene->lower[1] ? 2 : 1;
}

// Distance of the particles: the edge of the volume of the first; else the smoothing length; else from the
// number in the box.
static double size_find(const struct scene *scene, const struct vtu_grid *grid, double before)
{
    const struct vtu_array *mass = series_array(grid->point_arrays, grid->n_point_arrays, "Mass"),
                           *density = series_array(grid->point_arrays, grid->n_point_arrays, "Density"),
                           *length =
                               series_array(grid->point_arrays, grid->n_point_arrays, "SmoothingLength");
    if (grid->n_points == 0 || grid->n_cells == 0 || grid->types[0] != VERTEX)
        return 0.0;
    if (mass && density && series_value(mass, 0) > 0.0 && series_value(density, 0) > 0.0)
        return pow(series_value(mass, 0) / series_value(density, 0), 1.0 / scene->dim);
    if (length && series_value(length, 0) > 0.0)
        return series_value(length, 0);
    if (before > 0.0)
        return before;
    double volume = 1.0;
    for (int c = 0; c < scene->dim; ++c)
        volume *= scene->upper[c] - scene->lower[c];
    return pow(volume / (double)grid->n_points, 1.0 / scene->dim);
}

// Values of cells at points: the mean of the cells around.
static int cells_spread(struct scene_part *part, const struct vtu_array *array, int component)
{
    const struct vtu_grid *grid = &part->file.grid;
    uint32_t *count = memory_create(grid->n_points, sizeof *count);
    CHECK_MEMORY(count);
    int64_t begin = 0;
    for (size_t e = 0; e < grid->n_cells; begin = grid->offsets[e++])
        for (int64_t k = begin; k < grid->offsets[e]; ++k) {
            part->values[grid->connectivity[k]] += array_value(array, component, e);
            ++count[grid->connectivity[k]];
        }
    for (size_t i = 0; i < grid->n_points; ++i)
        part->values[i] /= count[i] > 0 ? count[i] : 1;
    memory_free(count);
    return 0;
}

// A message that lists what there is.
static int field_unknown(const struct scene_part *part, const char *name)
{
    const struct vtu_grid *grid = &part->file.grid;
    const char *names[65] = {speed};
    char list[65 * 66] = "";
    size_t n = series_array(grid->point_arrays, grid->n_point_arrays, "Velocity") ? 1 : 0, length = 0;
    for (size_t i = 0; i < grid->n_point_arrays + grid->n_cell_arrays; ++i)
        names[n++] = i < grid->n_point_arrays ? grid->point_arrays[i].name
                                              : grid->cell_arrays[i - grid->n_point_arrays].name;
    for (size_t i = 0; i < n; ++i)
        length += (size_t)snprintf(list + length, sizeof list - length, i > 0 ? ", %s" : "%s", names[i]);
    const char *close = text_closest(name, names, n);
    return error_report(STATUS_USAGE, "%s has no field \"%s\"%s%s%s; there are: %s", part->name, name,
                        close ? "; did you mean \"" : "", close ? close : "", close ? "\"" : "", list);
}

// The array called @p name, or, for NAME_x, NAME_y or NAME_z, the vector NAME and its component (else -1).
static const struct vtu_array *array_choose(const struct vtu_array *arrays, size_t n, const char *name,
                                            int *component)
{
    const size_t length = strlen(name);
    const struct vtu_array *array = series_array(arrays, n, name);
    char vector[96];
    *component = -1;
    if (array || length < 3 || length >= sizeof vector || name[length - 2] != '_')
        return array;
    memcpy(vector, name, length - 2);
    vector[length - 2] = '\0';
    array = series_array(arrays, n, vector);
    *component = name[length - 1] - 'x';
    return array && *component >= 0 && *component < 3 && array->components == 3 ? array : NULL;
}

static int values_fill(struct scene *scene, struct scene_part *part, const char *name)
{
    const struct vtu_grid *grid = &part->file.grid;
    const char *array_name = strcmp(name, speed) == 0 ? "Velocity" : name;
    int component, of_cell;
    const struct vtu_array *points =
                               array_choose(grid->point_arrays, grid->n_point_arrays, array_name, &component),
                           *cells =
                               array_choose(grid->cell_arrays, grid->n_cell_arrays, array_name, &of_cell);
    if (!points && !cells)
        return field_unknown(part, name);
    part->values = memory_create(grid->n_points, sizeof *part->values);
    CHECK_MEMORY(part->values);
    if (!points)
        CALL(cells_spread(part, cells, of_cell));
    for (size_t i = 0; i < grid->n_points; ++i) {
        if (points)
            part->values[i] = array_value(points, component, i);
        if (isfinite(part->values[i])) {
            scene->range[0] = fmin(scene->range[0], part->values[i]);
            scene->range[1] = fmax(scene->range[1], part->values[i]);
        }
    }
    return 0;
}

static int frame_read(struct scene *scene, const struct series *series, const char *text)
{
    size_t frame;
    CALL(series_choose(series, text ? text : "last", &frame));
    scene->frame = (long)frame;
    memcpy(scene->title, series->name, sizeof series->name);
    return parts_read(scene, series, frame);
}

static int scene_read(struct scene *scene, const struct picture *picture)
{
    struct series series;
    int status = series_open(&series, picture->output);
    if (!status)
        status = frame_read(scene, &series, picture->frame);
    series_reset(&series);
    CALL(status);
    bounds_find(scene);
    scene->range[0] = INFINITY;
    scene->range[1] = -INFINITY;
    for (size_t p = 0; p < scene->n_parts; ++p) {
        struct scene_part *part = &scene->parts[p];
        part->size = size_find(scene, &part->file.grid, p > 0 ? part[-1].size : 0.0);
        if (is_coloured(scene, part))
            CALL(values_fill(scene, part, picture->field));
    }
    return 0;
}

int scene_create(struct scene *scene, const struct picture *picture)
{
    memset(scene, 0, sizeof *scene);
    int status = scene_read(scene, picture);
    if (status)
        scene_reset(scene);
    return status;
}

void scene_reset(struct scene *scene)
{
    for (size_t i = 0; i < scene->n_parts; ++i) {
        vtu_file_reset(&scene->parts[i].file);
        memory_free(scene->parts[i].values);
    }
    memory_free(scene->parts);
    memset(scene, 0, sizeof *scene);
}
