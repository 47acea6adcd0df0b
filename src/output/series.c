// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/series.h"

#include "base/error.h"
#include "base/memory.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

static int frames_find(struct series *series)
{
    const struct pvd *pvd = &series->pvd;
    series->first = memory_create(pvd->n + 1, sizeof *series->first);
    CHECK_MEMORY(series->first);
    for (size_t i = 0; i < pvd->n; ++i)
        if (i == 0 || pvd->entries[i].time != pvd->entries[i - 1].time)
            series->first[series->n_frames++] = i;
    series->first[series->n_frames] = pvd->n;
    CHECK(series->n_frames > 0, STATUS_NO_INPUT, "%s: no frame has been written yet", pvd->path);
    return 0;
}

int series_open(struct series *series, const char *folder)
{
    memset(series, 0, sizeof *series);
    series->folder = memory_text(folder);
    CHECK_MEMORY(series->folder);
    CALL(collection_find(folder, series->name));
    char *path = memory_print("%s/%s", folder, series->name);
    CHECK_MEMORY(path);
    series->name[strlen(series->name) - 4] = '\0';
    int status = pvd_read(&series->pvd, path);
    memory_free(path);
    return status ? status : frames_find(series);
}

void series_reset(struct series *series)
{
    pvd_reset(&series->pvd);
    memory_free(series->first);
    memory_free(series->folder);
    memset(series, 0, sizeof *series);
}

double series_time(const struct series *series, size_t frame)
{
    return series->pvd.entries[series->first[frame]].time;
}

static size_t nearest_frame(const struct series *series, double t)
{
    size_t frame = 0;
    for (size_t f = 1; f < series->n_frames; ++f)
        if (fabs(series_time(series, f) - t) < fabs(series_time(series, frame) - t))
            frame = f;
    return frame;
}

// A whole number at *@p text, which moves behind it.
static bool number_read(const char **text, long *number)
{
    char *end;
    errno = 0;
    *number = strtol(*text, &end, 10);
    if (end == *text || errno)
        return false;
    *text = end;
    return true;
}

static int frame_check(const struct series *series, long number, size_t *frame)
{
    CHECK(number >= 0 && (size_t)number < series->n_frames, STATUS_USAGE,
          "frame %ld does not exist; there are 0 to %zu", number, series->n_frames - 1);
    *frame = (size_t)number;
    return 0;
}

// @p others: what may be given besides.
static int choose(const struct series *series, const char *text, const char *others, size_t *frame)
{
    const char *rest = text;
    char *end;
    long number;
    if (strcmp(text, "last") == 0) {
        *frame = series->n_frames - 1;
    } else if (strcmp(text, "first") == 0) {
        *frame = 0;
    } else if (strncmp(text, "t=", 2) == 0) {
        const double t = strtod(text + 2, &end);
        CHECK(end != text + 2 && *end == '\0' && isfinite(t), STATUS_USAGE,
              "frame \"%s\": a time in seconds should follow t=", text);
        *frame = nearest_frame(series, t);
    } else {
        CHECK(number_read(&rest, &number) && *rest == '\0', STATUS_USAGE,
              "frame \"%s\": neither last, first, %st=TIME nor a number", text, others);
        CALL(frame_check(series, number, frame));
    }
    return 0;
}

int series_choose(const struct series *series, const char *text, size_t *frame)
{
    return choose(series, text, "", frame);
}

int series_choose_several(const struct series *series, const char *text, size_t *first, size_t *last,
                          bool *several)
{
    const char *rest = text;
    long a, b;
    *first = 0;
    *last = series->n_frames - 1;
    *several = true;
    if (strcmp(text, "all") == 0)
        return 0;
    if (number_read(&rest, &a) && *rest == ':') {
        ++rest;
        CHECK(number_read(&rest, &b) && *rest == '\0' && a <= b, STATUS_USAGE,
              "frames \"%s\": two numbers A:B are wanted, the smaller first", text);
        CALL(frame_check(series, a, first));
        return frame_check(series, b, last);
    }
    *several = false;
    CALL(choose(series, text, "all, A:B, ", first));
    *last = *first;
    return 0;
}

int series_read(const struct series *series, const struct pvd_entry *entry, struct vtu_file *file)
{
    char *path = memory_print("%s/%s", series->folder, entry->file);
    CHECK_MEMORY(path);
    int status = vtu_read(file, path);
    memory_free(path);
    return status;
}

const struct vtu_array *series_array(const struct vtu_array *arrays, size_t n, const char *name)
{
    for (size_t i = 0; i < n; ++i)
        if (strcmp(arrays[i].name, name) == 0)
            return &arrays[i];
    return NULL;
}

double series_value(const struct vtu_array *array, size_t index)
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

void series_point(const struct vtu_grid *grid, size_t index, double x[3])
{
    for (size_t c = 0; c < 3; ++c)
        x[c] = grid->points_type == VTU_FLOAT32 ? (double)((const float *)grid->points)[3 * index + c]
                                                : ((const double *)grid->points)[3 * index + c];
}

const char *series_unit(const char *name, int dim)
{
    static const struct {
        const char *name, *units[3]; // 1-D, 2-D, 3-D; the last one where they are the same
    } units[] = {{"Speed", {NULL, NULL, "m/s"}},
                 {"Velocity", {NULL, NULL, "m/s"}},
                 {"Pressure", {NULL, NULL, "Pa"}},
                 {"Density", {NULL, NULL, "kg/m^3"}},
                 {"Mass", {"kg/m^2", "kg/m", "kg"}},
                 {"SmoothingLength", {NULL, NULL, "m"}},
                 {"Vorticity", {NULL, NULL, "1/s"}},
                 {"Acceleration", {NULL, NULL, "m/s^2"}},
                 {"Displacement", {NULL, NULL, "m"}},
                 {"CauchyStress", {NULL, NULL, "Pa"}},
                 {"VonMises", {NULL, NULL, "Pa"}},
                 {"ReactionForce", {"N/m^2", "N/m", "N"}},
                 {"InterfaceForce", {"N/m^2", "N/m", "N"}},
                 {"StrainEnergy", {NULL, NULL, "J/m^3"}},
                 {"Support", {NULL, NULL, "-"}},
                 {"Position", {NULL, NULL, "m"}}};
    size_t length = strlen(name);
    if (length > 2 && name[length - 2] == '_' && strchr("xyz", name[length - 1]))
        length -= 2;
    for (size_t i = 0; i < sizeof units / sizeof units[0]; ++i)
        if (strncmp(units[i].name, name, length) == 0 && units[i].name[length] == '\0')
            return units[i].units[0] ? units[i].units[dim - 1] : units[i].units[2];
    return NULL;
}
