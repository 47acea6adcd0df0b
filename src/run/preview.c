// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/preview.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "run/preview_physics.h"

#include <math.h>
#include <string.h>
#include <sys/statvfs.h>

/** Rough figures of the estimates: they tell minutes from days, not more. */
static const double updates_per_thread[4] = {0, 1e7, 3e6, 6e5}; // particle updates per second by dimension
static const double neighbours[4] = {0, 6, 29, 113};            // in the support of the quintic spline
static const double bytes_per_particle = 350, bytes_per_neighbour = 6; // memory
static const double bytes_per_node = 6000;                          // memory with the factorised matrix, 2-D
static const double disk_per_value = 2.8;                           // compressed, of 4 bytes
static const double saved_per_particle = 154, saved_per_node = 192; // of a checkpoint, bytes

/** What is counted before a run. */
struct census {
    size_t particles, nodes, elements, unknowns;
};

/** Particles of one region. */
static int count_region(const struct model *model, const struct model_region *region, double margin,
                        size_t *n)
{
    double(*points)[3] = NULL, lower[3] = {0}, upper[3];
    *n = region->n_points;
    if (*n)
        return 0;
    shape_bounds(&region->shape, model->dim, lower, upper);
    CALL(geometry_fill(&region->shape, model->dim, model->fluid.spacing,
                       region->has_origin ? region->origin : lower, margin, &points, n));
    memory_free(points);
    return 0;
}

static int print_fluid(const struct model *model, struct census *census, FILE *stream)
{
    const struct model_fluid *fluid = &model->fluid;
    const double margin = 0.02 * fluid->spacing;
    fprintf(stream, "fluid      %s, %d-D, spacing %.6g m\n", fluid->formulation, model->dim, fluid->spacing);
    for (size_t r = 0; r < fluid->n_regions; r++) {
        size_t n;
        CALL(count_region(model, &fluid->regions[r], margin, &n));
        census->particles += n;
        fprintf(stream, "  region   %zu particles (line %d)\n", n, fluid->regions[r].where.line);
        if (n == 0)
            log_message(LOG_WARNING, "%s:%d:%d: <region>: no particle lies in it", model->path,
                        fluid->regions[r].where.line, fluid->regions[r].where.column);
    }
    for (size_t w = 0; w < model->n_walls; w++) {
        const struct model_wall *wall = &model->walls[w];
        size_t n = 0;
        if (wall->has_region) {
            CALL(count_region(model, &wall->region, 0.0, &n));
            census->particles += n;
            fprintf(stream, "  wall     %s: %s, %zu particles\n", wall->name, wall->treatment, n);
        } else {
            fprintf(stream, "  wall     %s: %s on %zu surface%s\n", wall->name, wall->treatment,
                    wall->n_surfaces, wall->n_surfaces > 1 ? "s" : "");
        }
    }
    for (size_t o = 0; o < model->n_openings; o++)
        fprintf(stream, "  %-8s %s at %c = %.6g m\n",
                model->openings[o].kind == OPEN_INFLOW ? "inflow" : "outflow", model->openings[o].name,
                "xyz"[model->openings[o].axis], model -> openings[o].at);
    return 0;
}

static void print_solids(const struct model *model, struct census *census, FILE *stream)
{
    for (size_t m = 0; m < model->n_meshes; m++) {
        const struct model_mesh *mesh = &model->meshes[m];
        const size_t unknowns = mesh->mesh.n_nodes * (size_t)model->dim;
        fprintf(stream, "mesh       %s: %zu nodes, %zu %s elements, %zu degrees of freedom\n", mesh->name,
                mesh->mesh.n_nodes, mesh->mesh.n_elements, element_name(mesh->mesh.type), unknowns);
        census->nodes += mesh->mesh.n_nodes;
        census->elements += mesh->mesh.n_elements;
        census->unknowns += unknowns;
    }
}

static void print_surfaces(const struct model *model, FILE *stream)
{
    static const char *const kinds[] = {"facets", "plane", "cylinder", "sphere"};
    for (size_t s = 0; s < model->n_surfaces; s++) {
        const struct model_surface *surface = &model->surfaces[s];
        size_t coupled = 0;
        for (size_t i = 0; i < surface->built.n_points; i++)
            coupled += surface->built_mesh[i] >= 0;
        fprintf(stream, "surface    %s: ", surface->name);
        if (surface->kind == SURFACE_FACETS)
            fprintf(stream, "%zu facets, %zu points, %zu of them moved by meshes\n", surface->built.n_facets,
                    surface->built.n_points, coupled);
        else
            fprintf(stream, "%s\n",
                    model->dim == 2 && surface->kind == SURFACE_CYLINDER ? "circle" : kinds[surface->kind]);
    }
}

static void print_limit(const char *name, double limit, FILE *stream)
{
    if (isfinite(limit))
        fprintf(stream, "  limit    %.4g s by %s\n", limit, name);
}

static void print_bytes(const char *name, double bytes, FILE *stream)
{
    static const char *const units[] = {"B", "kB", "MB", "GB", "TB"};
    int unit = 0;
    for (; bytes >= 1000.0 && unit < 4; unit++)
        bytes /= 1000.0;
    fprintf(stream, "%s%.3g %s", name, bytes, units[unit]);
}

/** Free space where @p path is or will be: of its nearest folder that exists. Negative: unknown. */
static double free_disk(const char *path)
{
    struct statvfs information;
    char *folder = memory_text(path), *slash = folder;
    bool found = false;
    while (folder && slash && !(found = statvfs(*folder ? folder : "/", &information) == 0)) {
        slash = strrchr(folder, '/');
        if (slash)
            *slash = '\0';
    }
    found = found || (folder && statvfs(".", &information) == 0); // a name without folders
    memory_free(folder);
    return found ? (double)information.f_bavail * (double)information.f_frsize : -1.0;
}

static void print_costs(const struct model *model, const struct census *census, const char *output,
                        FILE *stream)
{
    const int dim = model->dim;
    const double n = (double)census->particles, steps = ceil(model->time.end / model->time.step);
    const double frames = floor(model->time.end / model->output.every) + 1.0;
    const double ratio = pow(fmax(1.0, model->fluid.smoothing_length_ratio), dim);
    const double memory = n * (bytes_per_particle + bytes_per_neighbour * neighbours[dim] * ratio) +
                          (double)census->nodes * bytes_per_node * (dim == 3 ? 4.0 : 1.0);
    const double values = n * (11.0 + (double)model->output.n_arrays) + (double)census->nodes * 16.0 +
                          (double)census->elements * 12.0;
    /* two checkpoints are kept while a third is written */
    const double saved = 3.0 * (n * saved_per_particle + (double)census->nodes * saved_per_node);
    const double disk = frames * values * disk_per_value * (model->output.float64 ? 2.0 : 1.0) + saved,
                 space = free_disk(output);
    const double seconds = steps * (n * ratio / updates_per_thread[dim] + (double)census->unknowns * 2e-6) /
                           (double)parallel_threads();
    print_bytes("memory     about ", memory, stream);
    print_bytes("\ndisk       about ", disk, stream);
    fprintf(stream, " in %.0f frames and", frames);
    print_bytes(" ", saved, stream);
    fputs(" of checkpoints", stream);
    if (space >= 0.0)
        print_bytes(", free: ", space, stream);
    fprintf(stream, "\nrun time   about %.0f %s with %d thread%s\n",
            seconds < 120.0    ? ceil(seconds)
            : seconds < 7200.0 ? seconds / 60.0
                               : seconds / 3600.0,
            seconds < 120.0    ? "s"
            : seconds < 7200.0 ? "min"
                               : "h",
            parallel_threads(), parallel_threads() > 1 ? "s" : "");
    if (space >= 0.0 && disk > space)
        log_message(LOG_WARNING, "the output will not fit on the disk of %s", output);
}

static void print_coupling(const struct model *model, FILE *stream)
{
    const struct model_coupling *coupling = &model->coupling;
    if (strcmp(coupling->scheme, "none") == 0)
        return;
    fprintf(stream, "coupling   %s, acceleration %s", coupling->scheme, coupling->acceleration);
    if (coupling->solid_every > 0)
        fprintf(stream, ", a step of the solid every %d", coupling->solid_every);
    if (coupling->tolerance > 0.0)
        fprintf(stream, ", tolerance %.3g m/s", coupling->tolerance);
    if (coupling->force_tolerance > 0.0)
        fprintf(stream, ", force tolerance %.3g %s", coupling->force_tolerance,
                model->dim == 2 ? "N/m" : "N");
    fprintf(stream, "\n");
}

int preview_print(const struct model *model, const char *output, FILE *stream)
{
    struct census census = {0};
    fprintf(stream, "deck       %s\noutput     %s\n", model->path, output);
    if (model->fluid.present)
        CALL(print_fluid(model, &census, stream));
    print_solids(model, &census, stream);
    print_surfaces(model, stream);
    print_coupling(model, stream);
    fprintf(stream, "time       %.6g s in %.0f steps of %.4g s\n", model->time.end,
            ceil(model->time.end / model->time.step * (1.0 - 1e-12)), model->time.step);
    if (model->fluid.present) {
        struct preview_limits limits;
        preview_find_limits(model, &limits);
        fprintf(stream, "  speed    %.4g m/s is the highest prescribed\n", limits.speed);
        print_limit("sound, 0.25 h / (c + u)", limits.sound, stream);
        print_limit("viscosity, 0.125 h^2 / nu", limits.viscosity, stream);
        print_limit("body force, 0.25 sqrt(h / b)", limits.body_force, stream);
        preview_warn(model, &limits);
    }
    print_costs(model, &census, output, stream);
    return ferror(stream) ? error_report(STATUS_IO, "the preview cannot be printed") : 0;
}
