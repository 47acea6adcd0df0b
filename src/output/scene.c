// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/scene.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "output/pvd.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { VERTEX = 1 }; // VTK cell type
static const char speed[] = "Speed";

void scene_point(const struct vtu_grid *grid, size_t index, double x[3])
{
    for (size_t c = 0; c < 3; ++c)
        x[c] = grid->points_type == VTU_FLOAT32 ? (double)((const float *)grid->points)[3 * index + c]
                                                : ((const double *)grid->points)[3 * index + c];
}

static double array_value(const struct vtu_array *array, size_t index)
{
    switch (array->type) {
    case VTU_FLOAT32:
        return (double)((const float *)array->data)[index];
    case VTU_FLOAT64:
        return ((const double *)array->data)[index];
    case VTU_INT32:
        return ((const int32_t *)array->data)[index];
    case VTU_INT64:
        return (double)((const int64_t *)array->data)[index];
    default:
        return ((const uint8_t *)array->data)[index];
    }
}

static double array_magnitude(const struct vtu_array *array, size_t index)
{
    size_t n = (size_t)array->components;
    double sum = 0.0;
    if (n == 1)
        return array_value(array, index);
    for (size_t c = 0; c < n; ++c)
        sum += array_value(array, n * index + c) * array_value(array, n * index + c);
    return sqrt(sum);
}

static const struct vtu_array *array_find(const struct vtu_array *arrays, size_t n, const char *name)
{
    for (size_t i = 0; i < n; ++i)
        if (strcmp(arrays[i].name, name) == 0)
            return &arrays[i];
    return NULL;
}

// The .pvd in the folder; the first by name if there are several.
static int collection_find(const char *folder, char name[64])
{
    DIR *stream = opendir(folder);
    CHECK(stream, STATUS_NO_INPUT, "%s: cannot open the output folder: %s", folder, strerror(errno));
    name[0] = '\0';
    for (struct dirent *entry; (entry = readdir(stream));) {
        size_t n = strlen(entry->d_name);
        if (n > 4 && n < 64 && strcmp(entry->d_name + n - 4, ".pvd") == 0 &&
            (!name[0] || strcmp(entry->d_name, name) < 0))
            memcpy(name, entry->d_name, n + 1);
    }
    closedir(stream);
    CHECK(name[0], STATUS_NO_INPUT, "%s: no .pvd file there; give the output folder of a run", folder);
    return 0;
}

static long frames_count(const struct pvd *pvd)
{
    long n = 0;
    for (size_t i = 0; i < pvd->n; ++i)
        n += i == 0 || pvd->entries[i].time != pvd->entries[i - 1].time;
    return n;
}

// First entry of frame @p frame.
static size_t frame_entry(const struct pvd *pvd, long frame)
{
    size_t i = 0;
    while (frame > 0) {
        ++i;
        frame -= pvd->entries[i].time != pvd->entries[i - 1].time;
    }
    return i;
}

static int frame_choose(const struct pvd *pvd, const char *text, long *frame)
{
    long n = frames_count(pvd);
    char *end = NULL;
    CHECK(n > 0, STATUS_NO_INPUT, "%s: no frame has been written yet", pvd->path);
    if (!text || strcmp(text, "last") == 0) {
        *frame = n - 1;
    } else if (strcmp(text, "first") == 0) {
        *frame = 0;
    } else if (strncmp(text, "t=", 2) == 0) {
        double t = strtod(text + 2, &end), best = INFINITY;
        CHECK(end != text + 2 && *end == '\0' && isfinite(t), STATUS_USAGE,
              "frame \"%s\": a time in seconds should follow t=", text);
        for (long f = 0; f < n; ++f) {
            double distance = fabs(pvd->entries[frame_entry(pvd, f)].time - t);
            if (distance < best) {
                best = distance;
                *frame = f;
            }
        }
    } else {
        *frame = strtol(text, &end, 10);
        CHECK(end != text && *end == '\0', STATUS_USAGE,
              "frame \"%s\": neither last, first, t=TIME nor a number", text);
        CHECK(*frame >= 0 && *frame < n, STATUS_USAGE, "frame %ld does not exist; there are 0 to %ld", *frame,
              n - 1);
    }
    return 0;
}

static int parts_read(struct scene *scene, const struct pvd *pvd, const char *folder)
{
    size_t first = frame_entry(pvd, scene->frame), n = 1;
    while (first + n < pvd->n && pvd->entries[first + n].time == pvd->entries[first].time)
        ++n;
    scene->time = pvd->entries[first].time;
    scene->parts = memory_create(n, sizeof *scene->parts);
    CHECK_MEMORY(scene->parts);
    for (size_t i = 0; i < n; ++i) {
        const struct pvd_entry *entry = &pvd->entries[first + i];
        char *path = memory_print("%s/%s", folder, entry->file);
        CHECK_MEMORY(path);
        memcpy(scene->parts[i].name, entry->name, sizeof entry->name);
        int status = vtu_read(&scene->parts[i].file, path);
        memory_free(path);
        CALL(status);
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
            scene_point(grid, i, x);
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
    const struct vtu_array *mass = array_find(grid->point_arrays, grid->n_point_arrays, "Mass"),
                           *density = array_find(grid->point_arrays, grid->n_point_arrays, "Density"),
                           *length = array_find(grid->point_arrays, grid->n_point_arrays, "SmoothingLength");
    if (grid->n_points == 0 || grid->n_cells == 0 || grid->types[0] != VERTEX)
        return 0.0;
    if (mass && density && array_value(mass, 0) > 0.0 && array_value(density, 0) > 0.0)
        return pow(array_value(mass, 0) / array_value(density, 0), 1.0 / scene->dim);
    if (length && array_value(length, 0) > 0.0)
        return array_value(length, 0);
    if (before > 0.0)
        return before;
    double volume = 1.0;
    for (int c = 0; c < scene->dim; ++c)
        volume *= scene->upper[c] - scene->lower[c];
    return pow(volume / (double)grid->n_points, 1.0 / scene->dim);
}

// Values of cells at points: the mean of the cells around.
static int cells_spread(struct scene_part *part, const struct vtu_array *array)
{
    const struct vtu_grid *grid = &part->file.grid;
    uint32_t *count = memory_create(grid->n_points, sizeof *count);
    CHECK_MEMORY(count);
    int64_t begin = 0;
    for (size_t e = 0; e < grid->n_cells; begin = grid->offsets[e++])
        for (int64_t k = begin; k < grid->offsets[e]; ++k) {
            part->values[grid->connectivity[k]] += array_magnitude(array, e);
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
    size_t n = array_find(grid->point_arrays, grid->n_point_arrays, "Velocity") ? 1 : 0, length = 0;
    for (size_t i = 0; i < grid->n_point_arrays + grid->n_cell_arrays; ++i)
        names[n++] = i < grid->n_point_arrays ? grid->point_arrays[i].name
                                              : grid->cell_arrays[i - grid->n_point_arrays].name;
    for (size_t i = 0; i < n; ++i)
        length += (size_t)snprintf(list + length, sizeof list - length, i > 0 ? ", %s" : "%s", names[i]);
    const char *close = text_closest(name, names, n);
    return error_report(STATUS_USAGE, "%s has no field \"%s\"%s%s%s; there are: %s", part->name, name,
                        close ? "; did you mean \"" : "", close ? close : "", close ? "\"" : "", list);
}

static int values_fill(struct scene *scene, struct scene_part *part, const char *name)
{
    const struct vtu_grid *grid = &part->file.grid;
    const char *array_name = strcmp(name, speed) == 0 ? "Velocity" : name;
    const struct vtu_array *points = array_find(grid->point_arrays, grid->n_point_arrays, array_name),
                           *cells = array_find(grid->cell_arrays, grid->n_cell_arrays, array_name);
    if (!points && !cells)
        return field_unknown(part, name);
    part->values = memory_create(grid->n_points, sizeof *part->values);
    CHECK_MEMORY(part->values);
    if (!points)
        CALL(cells_spread(part, cells));
    for (size_t i = 0; i < grid->n_points; ++i) {
        if (points)
            part->values[i] = array_magnitude(points, i);
        if (isfinite(part->values[i])) {
            scene->range[0] = fmin(scene->range[0], part->values[i]);
            scene->range[1] = fmax(scene->range[1], part->values[i]);
        }
    }
    return 0;
}

static int scene_read(struct scene *scene, const struct picture *picture)
{
    char name[64];
    CALL(collection_find(picture->output, name));
    char *path = memory_print("%s/%s", picture->output, name);
    CHECK_MEMORY(path);
    struct pvd pvd;
    int status = pvd_read(&pvd, path);
    memory_free(path);
    CALL(status);
    status = frame_choose(&pvd, picture->frame, &scene->frame);
    if (!status)
        status = parts_read(scene, &pvd, picture->output);
    pvd_reset(&pvd);
    CALL(status);
    snprintf(scene->title, sizeof scene->title, "%.*s", (int)(strlen(name) - 4), name);
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
