// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/assembly.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "deck/deck.h"
#include "open/open_list.h"
#include "run/simulation.h"
#include "wall/wall_list.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char log_path[32];

static int deck_write(const char *deck, char path[32])
{
    strcpy(path, "/tmp/skerry-case-XXXXXX");
    const int descriptor = mkstemp(path);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    CHECK(file, STATUS_CREATE, "%s: cannot be created", path);
    const int written = fputs(deck, file);
    CHECK(fclose(file) == 0 && written >= 0, STATUS_IO, "%s: cannot be written", path);
    return 0;
}

static int surfaces_create(struct assembly *a)
{
    a->surfaces = memory_create(a->model->n_surfaces, sizeof *a->surfaces);
    CHECK_MEMORY(a->surfaces);
    for (; a->n_surfaces < a->model->n_surfaces; ++a->n_surfaces)
        CALL(surface_create(&a->surfaces[a->n_surfaces], a->model, (int)a->n_surfaces, 0.0));
    return 0;
}

static int solids_create(struct assembly *a)
{
    a->solids = memory_create(a->model->n_meshes, sizeof *a->solids);
    CHECK_MEMORY(a->solids);
    for (; a->n_solids < a->model->n_meshes; ++a->n_solids)
        CALL(solid_create(&a->solids[a->n_solids], a->model, (int)a->n_solids));
    return 0;
}

static int solids_attach(struct assembly *a)
{
    for (size_t k = 0; k < a->n_solids; ++k)
        for (size_t s = 0; s < a->n_surfaces; ++s)
            CALL(solid_attach(a->solids[k], a->surfaces[s]));
    return 0;
}

static int parts_create(struct assembly *a)
{
    CALL(surfaces_create(a));
    CALL(solids_create(a));
    if (a->model->fluid.present) {
        const struct fluid_parts parts = {.surfaces = a->surfaces,
                                          .wall_types = wall_types,
                                          .n_wall_types = WALL_TYPES,
                                          .opening_types = open_boundary_types,
                                          .isa = "auto",
                                          .timer = &a->timer};
        CALL(fluid_create(&a->fluid, a->model, &parts));
    }
    CALL(solids_attach(a));
    const struct coupling_parts parts = {a->fluid,    a->solids,     a->n_solids,
                                         a->surfaces, a->n_surfaces, &a->timer};
    return coupling_create(&a->coupling, a->model, &parts);
}

int assembly_create(struct assembly *a, const char *deck, const char *const *overrides)
{
    char path[32];
    size_t n = 0;
    memset(a, 0, sizeof *a);
    while (overrides && overrides[n])
        ++n;
    CALL(deck_write(deck, path));
    const int status = deck_read(&a->model, path, n, overrides);
    unlink(path);
    CALL(status);
    CALL(simulation_check(a->model));
    return parts_create(a);
}

void assembly_reset(struct assembly *a)
{
    coupling_destroy(a->coupling);
    fluid_destroy(a->fluid);
    for (size_t k = 0; k < a->n_solids; ++k)
        solid_destroy(a->solids[k]);
    for (size_t k = 0; k < a->n_surfaces; ++k)
        surface_destroy(a->surfaces[k]);
    memory_free(a->solids);
    memory_free(a->surfaces);
    model_destroy(a->model);
    memset(a, 0, sizeof *a);
}

int assembly_start(struct assembly *a)
{
    return coupling_start(a->coupling, 0.0);
}

int assembly_steps(struct assembly *a, long n)
{
    const double dt = a->model->time.step;
    for (long k = 0; k < n; ++k) {
        CALL(coupling_step(a->coupling, a->t, dt));
        a->t = (double)++a->step * dt;
    }
    return 0;
}

struct particles *assembly_particles(struct assembly *a)
{
    return (struct particles *)fluid_particles(a->fluid);
}

struct surface *assembly_surface(const struct assembly *a, const char *name)
{
    for (size_t s = 0; s < a->n_surfaces; ++s)
        if (!strcmp(a->model->surfaces[s].name, name))
            return a->surfaces[s];
    return NULL;
}

double *const *assembly_field(const struct assembly *a, const char *name)
{
    const struct field *field = field_find(&fluid_particles(a->fluid)->fields, name);
    return field ? (double *const *)field->data : NULL;
}

const double (*assembly_nodes(const struct assembly *a, const char *name))[3]
{
    const struct field *field = field_find(solid_node_fields(a->solids[0]), name);
    return field ? (const double(*)[3])field->data[0] : NULL;
}

void assembly_jitter(struct assembly *a, double size)
{
    struct particles *block = assembly_particles(a);
    uint64_t seed = 20211;
    for (size_t i = 0; i < block->n; ++i)
        for (int k = 0; k < block->dim; ++k) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            block->x[k][i] += size * ((double)(seed >> 11) / 4503599627370496.0 - 1.0);
        }
}

/** Momentum of the fluid, its mass, and the sum of the sizes. */
static void momentum_take(const struct assembly *a, double momentum[3], double *mass, double *size)
{
    const struct particles *block = fluid_particles(a->fluid);
    double *const *acceleration = assembly_field(a, "Acceleration");
    const double dt = a->model->time.step;
    momentum[0] = momentum[1] = momentum[2] = *mass = *size = 0.0;
    for (size_t i = 0; i < block->n; ++i) {
        *mass += block->m[i];
        for (int k = 0; k < 3; ++k) {
            momentum[k] += block->m[i] * block->u[k][i];
            *size += block->m[i] * (fabs(block->u[k][i]) + dt * fabs(acceleration[k][i]));
        }
    }
}

int assembly_step_balanced(struct assembly *a, double *defect)
{
    const double dt = a->model->time.step;
    double before[3], after[3], impulse[3], mass, size, worst = 0.0;
    const int64_t put_back = a->put_back;
    memcpy(impulse, a->coupling->wall_impulse, sizeof impulse);
    momentum_take(a, before, &mass, &size);
    CALL(assembly_steps(a, 1));
    momentum_take(a, after, &mass, &size);
    a->put_back = 0;
    for (size_t b = 0; b < fluid_boundary_count(a->fluid); ++b)
        a->put_back += fluid_boundary(a->fluid, b)->put_back_count;
    for (int k = 0; k < 3; ++k) {
        double change = a->owed[k] + after[k] - before[k] -
                        dt * mass * expression_value(a->model->time.body_force[k], NULL, a->t);
        change += a->coupling->wall_impulse[k] - impulse[k];
        a->owed[k] = a->put_back > put_back ? change : 0.0;
        worst = fmax(worst, fabs(change - a->owed[k]));
    }
    *defect = worst / size;
    return 0;
}

void assembly_listen(void)
{
    strcpy(log_path, "/tmp/skerry-said-XXXXXX");
    const int descriptor = mkstemp(log_path);
    if (descriptor >= 0)
        close(descriptor);
    log_set_level(LOG_ERROR);
    log_open(log_path);
}

void assembly_heard(char *text, size_t size)
{
    size_t n = 0;
    log_close();
    FILE *file = fopen(log_path, "r");
    if (file) {
        n = fread(text, 1, size - 1, file);
        fclose(file);
    }
    text[n] = '\0';
    unlink(log_path);
}
