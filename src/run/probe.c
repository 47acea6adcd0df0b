// SPDX-License-Identifier: GPL-3.0-or-later
/* Fields of a run at chosen places, from the files that it has written. */
#include "run/probe.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "output/series.h"
#include "output/vti.h"
#include "run/probe_places.h"
#include "run/probe_sums.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct prober {
    const struct probe *probe;
    const struct model *model;
    struct series series;
    size_t first, last; /**< frames */
    bool several;       /**< asked for as a series */
    struct probe_places places;
    struct probe_sums sums;
    double *results;
    bool images;  /**< a .vti for each frame, or one table */
    char *base;   /**< of the names of images: what stands before "_000123.vti" */
    bool numbers; /**< the images carry the number of their frame */
};

static bool ends_in(const char *text, const char *end)
{
    const size_t n = strlen(text), m = strlen(end);
    return n >= m && strcmp(text + n - m, end) == 0;
}

static int frames_choose(struct prober *prober)
{
    const struct probe *probe = prober->probe;
    CHECK(!probe->time || !probe->frames, STATUS_USAGE,
          "--frame %s, --time %s: only one of them can choose the frame", probe->frames, probe->time);
    char *text =
        probe->time ? memory_print("t=%s", probe->time) : memory_text(probe->frames ? probe->frames : "last");
    CHECK_MEMORY(text);
    int status =
        series_choose_several(&prober->series, text, &prober->first, &prober->last, &prober->several);
    memory_free(text);
    return status;
}

/** Whether images or a table are wanted, and where. */
static int output_choose(struct prober *prober)
{
    const char *file = prober->probe->file;
    const bool vti = file && ends_in(file, ".vti");
    CHECK(prober->places.grid || !vti, STATUS_USAGE,
          "-o %s: points and lines are written as CSV; only a --grid can be a .vti", file);
    CHECK(!prober->places.grid || !file || vti || ends_in(file, ".csv") || strcmp(file, "-") == 0,
          STATUS_USAGE, "-o %s: a grid is written as .vti or .csv", file);
    prober->images = prober->places.grid && (!file || vti);
    prober->numbers = !file || prober->several;
    if (!prober->images)
        return 0;
    prober->base = file ? memory_print("%.*s", (int)(strlen(file) - 4), file)
                        : memory_print("%s/probe/grid", prober->probe->output);
    CHECK_MEMORY(prober->base);
    if (file)
        return 0;
    char *folder = memory_print("%s/probe", prober->probe->output);
    CHECK_MEMORY(folder);
    int status = file_make_folder(folder);
    memory_free(folder);
    return status;
}

static const struct pvd_entry *fluid_entry(const struct series *series, size_t frame)
{
    for (size_t i = series->first[frame]; i < series->first[frame + 1]; ++i)
        if (strcmp(series->pvd.entries[i].name, "fluid") == 0)
            return &series->pvd.entries[i];
    return NULL;
}

/** The results of a frame; *@p cycle: its step. */
static int frame_evaluate(struct prober *prober, size_t frame, int64_t *cycle)
{
    const struct pvd_entry *entry = fluid_entry(&prober->series, frame);
    struct vtu_file file;
    CHECK(entry, STATUS_IO, "%s: frame %zu has no part called fluid", prober->series.pvd.path, frame);
    CALL(series_read(&prober->series, entry, &file));
    int status = probe_sums_load(&prober->sums, entry->file, &file.grid);
    *cycle = file.grid.cycle;
    vtu_file_reset(&file);
    CALL(status);
    if (!prober->results)
        prober->results =
            memory_create(prober->places.n, (prober->sums.n_columns + 1) * sizeof *prober->results);
    CHECK_MEMORY(prober->results);
    probe_sums_evaluate(&prober->sums, prober->places.n, (const double(*)[3])prober->places.x,
                        prober->results);
    return 0;
}

static void header_write(const struct prober *prober, FILE *stream)
{
    fputs(prober->places.grid ? "t [s],x [m],y [m],z [m]" : "t [s],s [m],x [m],y [m],z [m]", stream);
    for (size_t f = 0; f < prober->sums.n_fields; ++f) {
        const struct probe_field *field = &prober->sums.fields[f];
        const char *unit = series_unit(field->name, prober->model->dim);
        for (size_t c = 0; c < field->components; ++c) {
            fprintf(stream, ",%s", field->name);
            if (field->components == 3)
                fprintf(stream, "_%c", "xyz"[c]);
            else if (field->components > 1)
                fprintf(stream, "_%zu", c);
            if (unit)
                fprintf(stream, " [%s]", unit);
        }
    }
    fputs(",Support [-]\n", stream);
}

static void rows_write(const struct prober *prober, double t, FILE *stream)
{
    const struct probe_places *places = &prober->places;
    const size_t columns = prober->sums.n_columns;
    for (size_t i = 0; i < places->n; ++i) {
        const double *x = places->x[i], *row = prober->results + i * (columns + 1);
        fprintf(stream, "%.17g", t);
        if (!places->grid)
            fprintf(stream, ",%.17g", places->s[i]);
        fprintf(stream, ",%.17g,%.17g,%.17g", x[0], x[1], x[2]);
        for (size_t c = 0; c < columns; ++c) {
            fputc(',', stream);
            if (!isnan(row[c]))
                fprintf(stream, "%.17g", row[c]);
        }
        fprintf(stream, ",%.17g\n", row[columns]);
    }
}

static int table_fill(struct prober *prober, FILE *stream)
{
    for (size_t frame = prober->first; frame <= prober->last; ++frame) {
        int64_t cycle;
        CALL(frame_evaluate(prober, frame, &cycle));
        if (frame == prober->first)
            header_write(prober, stream);
        rows_write(prober, series_time(&prober->series, frame), stream);
        if (ferror(stream))
            return 0; /* told by whoever closes it */
    }
    return 0;
}

static int table_write(struct prober *prober)
{
    const char *path = prober->probe->file;
    struct file_atomic file;
    if (!path || strcmp(path, "-") == 0)
        return table_fill(prober, stdout);
    CALL(file_atomic_open(&file, path));
    int status = table_fill(prober, file.stream);
    if (status) {
        file_atomic_abandon(&file);
        return status;
    }
    CALL(file_atomic_commit(&file));
    printf("%s\n", path);
    return 0;
}

/** Columns of the results as an array of an image. */
struct image_column {
    const double *results;
    size_t stride, column, components;
    bool float64;
};

static void column_read(const void *data, size_t first, size_t n, void *to)
{
    const struct image_column *column = data;
    for (size_t i = 0; i < n; ++i) {
        const size_t point = (first + i) / column->components, c = (first + i) % column->components;
        const double value = column->results[point * column->stride + column->column + c];
        if (column->float64)
            ((double *)to)[i] = value;
        else
            ((float *)to)[i] = (float)value;
    }
}

static int image_write(const struct prober *prober, const char *path, double t, int64_t cycle)
{
    const struct probe_sums *sums = &prober->sums;
    const struct probe_places *places = &prober->places;
    struct image_column columns[PROBE_FIELDS + 1];
    struct vtu_array arrays[PROBE_FIELDS + 1];
    struct vti_image image = {
        .time = t, .cycle = cycle, .n_arrays = sums->n_fields + 1, .arrays = arrays, .scalars = "Support"};
    const struct probe_field support = {
        .name = "Support", .column = sums->n_columns, .components = 1, .float64 = sums->float64};
    memcpy(image.n, places->size, sizeof image.n);
    memcpy(image.origin, places->lower, sizeof image.origin);
    memcpy(image.spacing, places->spacing, sizeof image.spacing);
    for (size_t f = sums->n_fields + 1; f-- > 0;) { /* backwards: the first ones colour */
        const struct probe_field *field = f < sums->n_fields ? &sums->fields[f] : &support;
        columns[f] = (struct image_column){.results = prober->results,
                                           .stride = sums->n_columns + 1,
                                           .column = field->column,
                                           .components = field->components,
                                           .float64 = field->float64};
        arrays[f] = (struct vtu_array){.components = (int)field->components,
                                       .type = field->float64 ? VTU_FLOAT64 : VTU_FLOAT32,
                                       .data = &columns[f],
                                       .read = column_read};
        memcpy(arrays[f].name, field->name, sizeof field->name);
        if (field->components == 1)
            image.scalars = field->name;
        else if (field->components == 3)
            image.vectors = field->name;
    }
    return vti_write(path, &image);
}

/** The image of a frame, and its entry in the collection @p pvd. */
static int frame_image(struct prober *prober, size_t frame, struct pvd *pvd)
{
    const double t = series_time(&prober->series, frame);
    int64_t cycle;
    CALL(frame_evaluate(prober, frame, &cycle));
    char *path = prober->numbers ? memory_print("%s_%06zu.vti", prober->base, frame)
                                 : memory_text(prober->probe->file);
    CHECK_MEMORY(path);
    int status = image_write(prober, path, t, cycle);
    if (!status && pvd) {
        const char *slash = strrchr(path, '/');
        status = pvd_add(pvd, t, 0, "grid", slash ? slash + 1 : path);
    } else if (!status) {
        printf("%s\n", path);
    }
    memory_free(path);
    return status;
}

static int image_series(struct prober *prober)
{
    struct pvd pvd = {.n = 0};
    char *path = memory_print("%s.pvd", prober->base);
    CHECK_MEMORY(path);
    int status = pvd_create(&pvd, path);
    for (size_t frame = prober->first; !status && frame <= prober->last; ++frame)
        status = frame_image(prober, frame, &pvd);
    if (!status)
        status = pvd_write(&pvd);
    if (!status)
        printf("%s\n", path);
    pvd_reset(&pvd);
    memory_free(path);
    return status;
}

static int prober_run(struct prober *prober)
{
    const struct probe *probe = prober->probe;
    CALL(probe_places_create(&prober->places, prober->model, probe->n_places, probe->places));
    CALL(probe_sums_create(&prober->sums, prober->model,
                           probe->fields ? probe->fields : "Pressure,Velocity,Density"));
    CALL(series_open(&prober->series, probe->output));
    CALL(frames_choose(prober));
    CALL(output_choose(prober));
    if (!prober->images)
        return table_write(prober);
    return prober->several ? image_series(prober) : frame_image(prober, prober->first, NULL);
}

int probe_write(const struct probe *probe, const struct model *model)
{
    struct prober prober = {.probe = probe, .model = model};
    CHECK(model->fluid.present, STATUS_NO_INPUT, "%s: the run has no fluid: there is nothing to probe",
          probe->output);
    parallel_setup(probe->threads);
    int status = prober_run(&prober);
    probe_sums_reset(&prober.sums);
    series_reset(&prober.series);
    probe_places_reset(&prober.places);
    memory_free(prober.results);
    memory_free(prober.base);
    return status;
}
