// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/frames.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "output/frame.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char *const always[] = {
    "Density",      "Mass",           "SmoothingLength", "Velocity",     "Pressure", "Id",           "Kind",
    "Displacement", "InterfaceForce", "ReactionForce",   "CauchyStress", "VonMises", "StrainEnergy", "Load"};

/** Virtual boundary particles of chosen fluid particles, collected for one frame. */
struct virtual_block {
    size_t n, capacity[6];
    double *x[3], *p, *rho, *owner;
    struct field fields[3];
    struct field_group group;
};

struct frames {
    const struct model *model;
    struct coupling_parts parts;
    char *folder;
    struct pvd pvd;
    int64_t count;
    struct field_group state;
    struct field state_field;
    struct wall_neighbours neighbours;
    struct virtual_block virtuals;
};

int frames_create(struct frames **frames, const struct model *model, const struct coupling_parts *parts,
                  const char *folder)
{
    struct frames *f = memory_create(1, sizeof *f);
    CHECK_MEMORY(f);
    *frames = f;
    f->model = model;
    f->parts = *parts;
    const struct field count = {"Frames", "-", FIELD_INT64, 1, FIELD_STATE, {&f->count}, NULL};
    f->state = field_singles("frames", f, &f->state_field, &count, 1);
    f->folder = memory_text(folder);
    CHECK_MEMORY(f->folder);
    char *path = memory_print("%s/%s.pvd", folder, model->name);
    CHECK_MEMORY(path);
    int status = pvd_create(&f->pvd, path);
    memory_free(path);
    return status;
}

void frames_destroy(struct frames *frames)
{
    if (!frames)
        return;
    for (int k = 0; k < 3; ++k)
        memory_free(frames->virtuals.x[k]);
    memory_free(frames->virtuals.p);
    memory_free(frames->virtuals.rho);
    memory_free(frames->virtuals.owner);
    wall_neighbours_reset(&frames->neighbours);
    pvd_reset(&frames->pvd);
    memory_free(frames->folder);
    memory_free(frames);
}

static struct frame_part fluid_part(struct fluid *fluid)
{
    const struct particles *block = fluid_particles(fluid);
    return (struct frame_part){.name = "fluid",
                               .x = {block->x[0], block->x[1], block->x[2]},
                               .points = fluid_output(fluid),
                               .scalars = "Pressure",
                               .vectors = "Velocity"};
}

static struct frame_part solid_part(const struct solid *solid, const char *name)
{
    return (struct frame_part){.name = name,
                               .places = solid_positions(solid),
                               .points = solid_node_fields(solid),
                               .cells = solid_cell_fields(solid),
                               .mesh = solid_mesh(solid),
                               .scalars = "VonMises",
                               .vectors = "Displacement"};
}

static int virtual_reserve(struct virtual_block *block, size_t n)
{
    double **const arrays[] = {&block->x[0], &block->x[1], &block->x[2],
                               &block->p,    &block->rho,  &block->owner};
    for (size_t k = 0; k < 6; ++k)
        CALL(memory_grow((void **)arrays[k], &block->capacity[k], n, sizeof(double)));
    return 0;
}

/** Add the wall neighbours of near particle @p near of @p boundary. */
static int virtual_collect(struct frames *frames, const struct boundary *boundary,
                           const struct fluid_view *view, size_t near)
{
    struct virtual_block *block = &frames->virtuals;
    const size_t i = boundary->near[near];
    CALL(boundary->type->unfold(boundary, view, near, &frames->neighbours));
    CALL(virtual_reserve(block, block->n + frames->neighbours.n));
    for (size_t k = 0; k < frames->neighbours.n; ++k, ++block->n) {
        for (int d = 0; d < 3; ++d)
            block->x[d][block->n] = view->particles->x[d][i] - frames->neighbours.dx[d][k];
        block->p[block->n] = frames->neighbours.p[k];
        block->rho[block->n] = frames->neighbours.rho[k];
        block->owner[block->n] = (double)view->particles->id[i];
    }
    return 0;
}

/** The virtual boundary particles of the particles that the deck names (paper 000, figures 8 and 15). */
static int virtual_write(struct frames *frames, const struct frame_writer *writer, int part, double t,
                         long step)
{
    const struct model_output *output = &frames->model->output;
    const struct fluid_view *view = fluid_view(frames->parts.fluid);
    struct virtual_block *block = &frames->virtuals;
    block->n = 0;
    for (size_t b = 0; b < fluid_boundary_count(frames->parts.fluid); ++b) {
        const struct boundary *boundary = fluid_boundary(frames->parts.fluid, b);
        for (size_t near = 0; near < boundary->n_near; ++near)
            for (size_t v = 0; v < output->n_virtual_particles; ++v)
                if (view->particles->id[boundary->near[near]] == output->virtual_particles[v])
                    CALL(virtual_collect(frames, boundary, view, near));
    }
    block->fields[0] = (struct field){"Density", "kg/m^3", FIELD_DOUBLE, 1, FIELD_OUTPUT, {block->rho}, NULL};
    block->fields[1] = (struct field){"Pressure", "Pa", FIELD_DOUBLE, 1, FIELD_OUTPUT, {block->p}, NULL};
    block->fields[2] = (struct field){"Id", "-", FIELD_DOUBLE, 1, FIELD_OUTPUT, {block->owner}, NULL};
    block->group = (struct field_group){"virtual", block, &block->n, block->fields, 3};
    const struct frame_part virtual_part = {.name = "virtual",
                                            .part = part,
                                            .x = {block->x[0], block->x[1], block->x[2]},
                                            .points = &block->group,
                                            .scalars = "Pressure"};
    CALL(virtual_reserve(block, 1));
    return frame_write_part(writer, &virtual_part, t, step);
}

static int part_write_numbered(const struct frame_writer *writer, struct frame_part part, int *number,
                               double t, long step)
{
    part.part = (*number)++;
    return frame_write_part(writer, &part, t, step);
}

static int surfaces_write(struct frames *frames, const struct frame_writer *writer, int *number, double t,
                          long step)
{
    for (size_t s = 0; s < frames->parts.n_surfaces; ++s) {
        const struct surface *surface = frames->parts.surfaces[s];
        if (!surface->n_facets)
            continue;
        char *name = memory_print("surface-%s", surface->definition->name);
        CHECK_MEMORY(name);
        const struct frame_part part = {.name = name,
                                        .places = (const double(*)[3])surface->shown->x,
                                        .points = &surface->fields,
                                        .facets = (const int32_t(*)[4])surface->nodes,
                                        .n_facets = surface->n_facets};
        int status = part_write_numbered(writer, part, number, t, step);
        memory_free(name);
        CALL(status);
    }
    return 0;
}

/** All parts of the frame called @p label, then the .pvd. */
static int frame_write(struct frames *frames, const char *label, double t, long step)
{
    const struct model_output *output = &frames->model->output;
    const struct frame_writer writer = {.folder = frames->folder,
                                        .label = label,
                                        .pvd = &frames->pvd,
                                        .float64 = output->float64,
                                        .optional = (const char *const *)output->arrays,
                                        .n_optional = output->n_arrays,
                                        .always = always,
                                        .n_always = sizeof always / sizeof *always};
    int number = 0;
    if (frames->parts.fluid)
        CALL(part_write_numbered(&writer, fluid_part(frames->parts.fluid), &number, t, step));
    for (size_t b = 0; frames->parts.fluid && b < fluid_boundary_count(frames->parts.fluid); ++b) {
        const struct boundary *boundary = fluid_boundary(frames->parts.fluid, b);
        if (!boundary->wall_x[0])
            continue;
        char *name = memory_print("wall-%s", boundary->wall->name);
        CHECK_MEMORY(name);
        const struct frame_part part = {.name = name,
                                        .x = {boundary->wall_x[0], boundary->wall_x[1], boundary->wall_x[2]},
                                        .points = &boundary->wall_fields,
                                        .scalars = "Pressure",
                                        .vectors = "Velocity"};
        int status = part_write_numbered(&writer, part, &number, t, step);
        memory_free(name);
        CALL(status);
    }
    for (size_t k = 0; k < frames->parts.n_solids; ++k) {
        char *name = memory_print("solid-%s", solid_name(frames->parts.solids[k]));
        CHECK_MEMORY(name);
        int status =
            part_write_numbered(&writer, solid_part(frames->parts.solids[k], name), &number, t, step);
        memory_free(name);
        CALL(status);
    }
    CALL(surfaces_write(frames, &writer, &number, t, step));
    if (frames->parts.fluid && output->n_virtual_particles)
        CALL(virtual_write(frames, &writer, number, t, step));
    return pvd_write(&frames->pvd);
}

int frames_write(struct frames *frames, double t, long step)
{
    char label[32];
    snprintf(label, sizeof label, "%06lld", (long long)frames->count);
    CALL(frame_write(frames, label, t, step));
    ++frames->count;
    return 0;
}

int frames_write_extra(struct frames *frames, double t, long step)
{
    char label[32];
    if (frames->pvd.n > 0 && frames->pvd.entries[frames->pvd.n - 1].time >= t)
        return 0;
    snprintf(label, sizeof label, "step%09ld", step);
    return frame_write(frames, label, t, step);
}

/** Remove the files of the entries from @p first on. */
static int later_remove(struct frames *frames, size_t first)
{
    for (size_t k = first; k < frames->pvd.n; ++k) {
        char *path = memory_print("%s/%s", frames->folder, frames->pvd.entries[k].file);
        CHECK_MEMORY(path);
        if (unlink(path) && errno != ENOENT)
            log_message(LOG_WARNING, "%s: cannot be removed: %s", path, strerror(errno));
        memory_free(path);
    }
    return 0;
}

int frames_resume(struct frames *frames, double t)
{
    struct pvd *pvd = &frames->pvd;
    if (access(pvd->path, F_OK) && errno == ENOENT) {
        log_message(LOG_WARNING, "%s: is missing: the series begins anew", pvd->path);
        return 0;
    }
    char *path = memory_text(pvd->path);
    CHECK_MEMORY(path);
    pvd_reset(pvd);
    int status = pvd_read(pvd, path);
    memory_free(path);
    CALL(status);
    const size_t all = pvd->n, kept = pvd_count(pvd, t);
    if (kept == all)
        return 0;
    pvd->n = kept;
    CALL(pvd_write(pvd));
    pvd->n = all;
    status = later_remove(frames, kept);
    pvd->n = kept;
    return status;
}

int frames_state(struct frames *frames, struct field_list *list)
{
    return field_list_add(list, &frames->state);
}

int frames_blowup(struct frames *frames, double t, long step)
{
    char *path = memory_print("%s/blowup.vtu", frames->folder);
    CHECK_MEMORY(path);
    const struct frame_part part =
        frames->parts.fluid ? fluid_part(frames->parts.fluid) : solid_part(frames->parts.solids[0], "solid");
    int status = frame_write_single(path, &part, t, step);
    if (!status)
        log_message(LOG_INFO, "the last state is in %s", path);
    memory_free(path);
    return status;
}

int64_t frames_count(const struct frames *frames)
{
    return frames->count;
}

long frames_files(const struct frames *frames)
{
    return (long)frames->pvd.n;
}
