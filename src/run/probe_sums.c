// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/probe_sums.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/text.h"
#include "open/zone.h"
#include "output/series.h"
#include "sph/shepard.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PLACE = 0, MASS = 3, DENSITY = 4, FIXED = 5 }; // rows of probe_sums.data

/** Arrays of a frame that are always needed. */
struct frame_arrays {
    const char *path;
    const struct vtu_grid *grid;
    const struct vtu_array *mass, *density, *smoothing_length, *kind;
};

static int field_add(struct probe_sums *sums, const char *name, size_t length, const char *all)
{
    struct probe_field *field = &sums->fields[sums->n_fields];
    CHECK(length > 0 && length < sizeof field->name, STATUS_USAGE,
          "--field %s: names of arrays are wanted, separated by commas", all);
    CHECK(sums->n_fields < PROBE_FIELDS, STATUS_USAGE, "--field %s: more than %d arrays", all, PROBE_FIELDS);
    *field = (struct probe_field){.column = 0};
    memcpy(field->name, name, length);
    for (size_t f = 0; f < sums->n_fields; ++f)
        CHECK(strcmp(sums->fields[f].name, field->name) != 0, STATUS_USAGE, "--field %s: %s is there twice",
              all, field->name);
    sums->n_fields += strcmp(field->name, "Support") != 0;
    return 0;
}

int probe_sums_create(struct probe_sums *sums, const struct model *model, const char *fields)
{
    *sums = (struct probe_sums){.model = model, .kernel = kernel_of_model(model)};
    for (const char *name = fields;; ++name) {
        const size_t length = strcspn(name, ",");
        CALL(field_add(sums, name, length, fields));
        name += length;
        if (!*name)
            break;
    }
    const struct model_domain *domain = &model->domain;
    /* rows as those of the fluid's own grid */
    const double width = (model->dim == 3 ? 2.0 / 3.0 : 2.8 / 3.0) * sums->kernel.support;
    return cell_grid_create(&sums->grid, model->dim, domain->lower, domain->upper, domain->periodic,
                            sums->kernel.support, width, model->fluid.spacing);
}

void probe_sums_reset(struct probe_sums *sums)
{
    cell_grid_reset(&sums->grid);
    memory_free(sums->data);
    *sums = (struct probe_sums){.n = 0};
}

static int field_unknown(const char *path, const struct vtu_grid *grid, const char *name)
{
    const char *names[PROBE_FIELDS];
    char list[PROBE_FIELDS * 66] = "";
    size_t n = 0, length = 0;
    for (size_t i = 0; i < grid->n_point_arrays && n < PROBE_FIELDS; ++i)
        if (grid->point_arrays[i].type <= VTU_FLOAT64)
            names[n++] = grid->point_arrays[i].name;
    for (size_t i = 0; i < n; ++i)
        length += (size_t)snprintf(list + length, sizeof list - length, i > 0 ? ", %s" : "%s", names[i]);
    const char *close = text_closest(name, names, n);
    return error_report(STATUS_USAGE, "%s: the fluid has no field \"%s\"%s%s%s; there are: %s", path, name,
                        close ? "; did you mean \"" : "", close ? close : "", close ? "\"" : "", list);
}

/** Where the fields are in a frame; the first one tells how many components they have. */
static int fields_find(struct probe_sums *sums, const struct frame_arrays *frame,
                       const struct vtu_array *arrays[PROBE_FIELDS])
{
    const struct vtu_grid *grid = frame->grid;
    sums->n_columns = 0;
    for (size_t f = 0; f < sums->n_fields; ++f) {
        struct probe_field *field = &sums->fields[f];
        arrays[f] = series_array(grid->point_arrays, grid->n_point_arrays, field->name);
        if (!arrays[f])
            return field_unknown(frame->path, grid, field->name);
        const size_t components = (size_t)arrays[f]->components;
        CHECK(arrays[f]->type <= VTU_FLOAT64, STATUS_USAGE,
              "--field %s: these are labels, of which there is no mean", field->name);
        CHECK(field->components == 0 || field->components == components, STATUS_IO,
              "%s: %s has %zu components instead of %zu", frame->path, field->name, components,
              field->components);
        field->components = components;
        field->float64 = arrays[f]->type == VTU_FLOAT64;
        field->column = sums->n_columns;
        sums->n_columns += components;
    }
    return 0;
}

static int frame_arrays_find(struct frame_arrays *frame, const char *path, const struct vtu_grid *grid)
{
    const struct {
        const char *name;
        const struct vtu_array **array;
    } needed[] = {
        {"Mass", &frame->mass}, {"Density", &frame->density}, {"SmoothingLength", &frame->smoothing_length}};
    *frame = (struct frame_arrays){.path = path, .grid = grid};
    for (size_t i = 0; i < sizeof needed / sizeof *needed; ++i) {
        *needed[i].array = series_array(grid->point_arrays, grid->n_point_arrays, needed[i].name);
        CHECK(*needed[i].array && (*needed[i].array)->components == 1, STATUS_IO,
              "%s: not the fluid of a run: there is no array %s", path, needed[i].name);
    }
    frame->kind = series_array(grid->point_arrays, grid->n_point_arrays, "Kind");
    return 0;
}

/** Whether a place lies in the zone behind an opening: all that can be said without the kinds of particles.
 */
static bool in_zone(const struct probe_sums *sums, const double x[3])
{
    const struct model *model = sums->model;
    const double dx = model->fluid.spacing, deepest = sums->kernel.support + 1.5 * dx;
    for (size_t k = 0; k < model->n_openings; ++k) {
        const double inside = zone_inside(&model->openings[k], x);
        if (inside < 0.0 && inside > -deepest && zone_across(&model->openings[k], model->dim, x, 0.5 * dx))
            return true;
    }
    return false;
}

/** The same place between the sides of a periodic direction. */
static double wrapped(double x, double lower, double upper)
{
    const double length = upper - lower;
    if (x >= lower && x < upper)
        return x;
    const double rest = fmod(x - lower, length);
    return rest < 0.0 ? fmin(upper, rest + length + lower) : lower + rest;
}

static void place_wrap(const struct model *model, double x[3])
{
    for (int k = 0; k < model->dim; ++k)
        if (model->domain.periodic[k])
            x[k] = wrapped(x[k], model->domain.lower[k], model->domain.upper[k]);
    for (int k = model->dim; k < 3; ++k)
        x[k] = 0.0;
}

/** Which particles are fluid, and their places. */
static int particles_choose(struct probe_sums *sums, const struct frame_arrays *frame, uint32_t *chosen,
                            double *const place[3])
{
    const size_t n = frame->grid->n_points;
    const double h = sums->kernel.h;
    const bool guess = !frame->kind && sums->model->n_openings > 0;
    if (guess && !sums->warned)
        log_message(LOG_WARNING,
                    "%s: does not tell the kinds of particles; those behind the plane of an opening "
                    "are left out",
                    frame->path);
    sums->warned = sums->warned || guess;
    sums->n = 0;
    for (size_t i = 0; i < n; ++i) {
        double x[3];
        series_point(frame->grid, i, x);
        CHECK(isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]), STATUS_IO,
              "%s: the place of particle %zu is no number", frame->path, i);
        CHECK(fabs(series_value(frame->smoothing_length, i) - h) <= 1e-6 * h, STATUS_IO,
              "%s: a smoothing length of %g m, where the deck says %g m", frame->path,
              series_value(frame->smoothing_length, i), h);
        if (frame->kind ? series_value(frame->kind, i) != PARTICLE_FLUID : guess && in_zone(sums, x))
            continue;
        place_wrap(sums->model, x);
        for (int k = 0; k < 3; ++k)
            place[k][sums->n] = x[k];
        chosen[sums->n++] = (uint32_t)i;
    }
    return 0;
}

/** Fill the rows of @c data; @p order: sorted particles among the chosen ones. Returns how many particles
 * hold what is no number. */
static size_t rows_fill(struct probe_sums *sums, const struct frame_arrays *frame,
                        const struct vtu_array *const arrays[PROBE_FIELDS], const uint32_t *chosen,
                        const uint32_t *order, double *const place[3])
{
    const size_t n = sums->n;
    double *data = sums->data;
    size_t wrong = 0;
#pragma omp parallel for schedule(static) reduction(+ : wrong)
    for (size_t i = 0; i < n; ++i) {
        const size_t from = chosen[order[i]];
        for (size_t k = 0; k < 3; ++k)
            data[(PLACE + k) * n + i] = place[k][order[i]];
        data[MASS * n + i] = series_value(frame->mass, from);
        data[DENSITY * n + i] = series_value(frame->density, from);
        bool good = data[MASS * n + i] > 0.0 && data[DENSITY * n + i] > 0.0 &&
                    isfinite(data[MASS * n + i] / data[DENSITY * n + i]);
        for (size_t f = 0; f < sums->n_fields; ++f) {
            const struct probe_field *field = &sums->fields[f];
            for (size_t c = 0; c < field->components; ++c) {
                const double value = series_value(arrays[f], from * field->components + c);
                data[(FIXED + field->column + c) * n + i] = value;
                good = good && isfinite(value);
            }
        }
        wrong += !good;
    }
    return wrong;
}

static int particles_sort(struct probe_sums *sums, const struct frame_arrays *frame,
                          const struct vtu_array *const arrays[PROBE_FIELDS], uint32_t *chosen,
                          uint32_t *order, double *const place[3])
{
    const double *const x[3] = {place[0], place[1], place[2]};
    CALL(particles_choose(sums, frame, chosen, place));
    CALL(cell_grid_sort(&sums->grid, x, sums->n, order));
    memory_free(sums->data);
    CHECK_MEMORY(sums->data = memory_create((FIXED + sums->n_columns) * sums->n, sizeof *sums->data));
    const size_t wrong = rows_fill(sums, frame, arrays, chosen, order, place);
    CHECK(wrong == 0, STATUS_IO, "%s: %zu particles hold what is no number, or no positive mass and density",
          frame->path, wrong);
    return 0;
}

int probe_sums_load(struct probe_sums *sums, const char *path, const struct vtu_grid *grid)
{
    const struct vtu_array *arrays[PROBE_FIELDS];
    struct frame_arrays frame;
    const size_t n = grid->n_points;
    CHECK(n < UINT32_MAX, STATUS_IO, "%s: %zu particles are more than a search grid can number", path, n);
    CALL(frame_arrays_find(&frame, path, grid));
    CALL(fields_find(sums, &frame, arrays));
    sums->float64 = grid->points_type == VTU_FLOAT64;
    uint32_t *numbers = memory_create(2 * n, sizeof *numbers);
    double *places = memory_create(3 * n, sizeof *places);
    double *const place[3] = {places, places + n, places + 2 * n};
    int status =
        numbers && places ? particles_sort(sums, &frame, arrays, numbers, numbers + n, place) : STATUS_MEMORY;
    memory_free(numbers);
    memory_free(places);
    return status;
}

void probe_sums_evaluate(const struct probe_sums *sums, size_t n, const double (*x)[3], double *results)
{
    const double *data = sums->data;
    const size_t particles = sums->n, columns = sums->n_columns;
    const struct shepard shepard = {.kernel = &sums->kernel,
                                    .grid = &sums->grid,
                                    .x = {data, data + particles, data + 2 * particles},
                                    .m = data + MASS * particles,
                                    .rho = data + DENSITY * particles};
    const double *values[PROBE_FIELDS * 9];
    for (size_t c = 0; c < columns; ++c)
        values[c] = data + (FIXED + c) * particles;
#pragma omp parallel for schedule(dynamic, 256)
    for (size_t i = 0; i < n; ++i) {
        double *row = results + i * (columns + 1), place[3] = {x[i][0], x[i][1], x[i][2]};
        place_wrap(sums->model, place);
        row[columns] = shepard_means(&shepard, place, columns, values, row);
    }
}
