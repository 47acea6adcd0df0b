// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/monitor.h"

#include "base/error.h"
#include "base/memory.h"
#include "model/geometry.h"
#include "output/history.h"

#include <math.h>
#include <string.h>

struct monitor {
    const struct model_history *definition;
    struct history file;
    bool open;
    long count; /**< samples so far */
    struct solid_place place;
};

struct monitors {
    const struct model *model;
    const struct coupling *coupling;
    char *folder;
    size_t n;
    struct monitor *monitors;
};

long schedule_count(double every, double t, double step)
{
    return (long)floor((t + 1e-6 * step) / every) + 1;
}

bool schedule_due(double every, double t, double step, long *count)
{
    if (every <= 0.0)
        return true;
    const long now = schedule_count(every, t, step);
    if (now <= *count)
        return false;
    *count = now;
    return true;
}

/** Column names by kind and dimension (forces and energies of 2-D problems are per metre of depth); returns
 * their number. */
static int columns_of(const struct monitor *monitor, int dim, const char *const **columns)
{
    static const char *const point[] = {
        "t [s]",     "x displacement [m]", "y displacement [m]", "z displacement [m]",
        "u_x [m/s]", "u_y [m/s]",          "u_z [m/s]"};
    static const char *const force2[] = {"t [s]",       "F_x [N/m]",   "F_y [N/m]",  "F_z [N/m]",
                                         "M_x [N m/m]", "M_y [N m/m]", "M_z [N m/m]"};
    static const char *const force3[] = {"t [s]",     "F_x [N]",   "F_y [N]",  "F_z [N]",
                                         "M_x [N m]", "M_y [N m]", "M_z [N m]"};
    static const char *const gauge[] = {"t [s]",     "p [Pa]",       "u_x [m/s]",  "u_y [m/s]",
                                        "u_z [m/s]", "rho [kg/m^3]", "support [-]"};
    static const char *const profile[] = {"t [s]",     "s [m]",        "x [m]",      "y [m]",
                                          "z [m]",     "p [Pa]",       "u_x [m/s]",  "u_y [m/s]",
                                          "u_z [m/s]", "rho [kg/m^3]", "support [-]"};
    static const char *const volume2[] = {"t [s]",
                                          "particles [-]",
                                          "mass [kg/m]",
                                          "volume [m^2]",
                                          "rho_min [kg/m^3]",
                                          "rho_max [kg/m^3]",
                                          "zone particles [-]"};
    static const char *const volume3[] = {"t [s]",
                                          "particles [-]",
                                          "mass [kg]",
                                          "volume [m^3]",
                                          "rho_min [kg/m^3]",
                                          "rho_max [kg/m^3]",
                                          "zone particles [-]"};
    static const char *const rigid2[] = {"t [s]",
                                         "x [m]",
                                         "y [m]",
                                         "z [m]",
                                         "rotation x [rad]",
                                         "rotation y [rad]",
                                         "rotation z [rad]",
                                         "u_x [m/s]",
                                         "u_y [m/s]",
                                         "u_z [m/s]",
                                         "omega_x [rad/s]",
                                         "omega_y [rad/s]",
                                         "omega_z [rad/s]",
                                         "F_x [N/m]",
                                         "F_y [N/m]",
                                         "F_z [N/m]",
                                         "M_x [N m/m]",
                                         "M_y [N m/m]",
                                         "M_z [N m/m]"};
    static const char *const rigid3[] = {"t [s]",
                                         "x [m]",
                                         "y [m]",
                                         "z [m]",
                                         "rotation x [rad]",
                                         "rotation y [rad]",
                                         "rotation z [rad]",
                                         "u_x [m/s]",
                                         "u_y [m/s]",
                                         "u_z [m/s]",
                                         "omega_x [rad/s]",
                                         "omega_y [rad/s]",
                                         "omega_z [rad/s]",
                                         "F_x [N]",
                                         "F_y [N]",
                                         "F_z [N]",
                                         "M_x [N m]",
                                         "M_y [N m]",
                                         "M_z [N m]"};
    static const char *const energy2[] = {"t [s]", "fluid kinetic [J/m]", "solid kinetic [J/m]",
                                          "elastic [J/m]", "work on solids [J/m]"};
    static const char *const energy3[] = {"t [s]", "fluid kinetic [J]", "solid kinetic [J]", "elastic [J]",
                                          "work on solids [J]"};
    static const char *const coupling[] = {"t [s]", "iterations [-]", "residual [m/s]"};
    const bool deep = dim == 3;
    switch (monitor->definition->kind) {
    case HISTORY_POINT:
        *columns = point;
        return sizeof point / sizeof *point;
    case HISTORY_FORCE:
        *columns = deep ? force3 : force2;
        return sizeof force2 / sizeof *force2;
    case HISTORY_GAUGE:
        *columns = gauge;
        return sizeof gauge / sizeof *gauge;
    case HISTORY_PROFILE:
        *columns = profile;
        return sizeof profile / sizeof *profile;
    case HISTORY_VOLUME:
        *columns = deep ? volume3 : volume2;
        return sizeof volume2 / sizeof *volume2;
    case HISTORY_RIGID:
        *columns = deep ? rigid3 : rigid2;
        return sizeof rigid2 / sizeof *rigid2;
    case HISTORY_ENERGY:
        *columns = deep ? energy3 : energy2;
        return sizeof energy2 / sizeof *energy2;
    case HISTORY_COUPLING:
        *columns = coupling;
        return sizeof coupling / sizeof *coupling;
    }
    return 0;
}

static int monitor_place(const struct monitors *monitors, struct monitor *monitor)
{
    const struct model_history *definition = monitor->definition;
    if (definition->kind == HISTORY_POINT)
        CHECK(!solid_locate(monitors->coupling->parts.solids[definition->mesh], definition->from,
                            &monitor->place),
              STATUS_DECK, "%s:%d:%d: error: <history name=\"%s\">: (%g, %g, %g) lies outside mesh \"%s\"",
              monitors->model->path, definition->where.line, definition->where.column, definition->name,
              definition->from[0], definition->from[1], definition->from[2],
              monitors->model->meshes[definition->mesh].name);
    return 0;
}

/** The file of a monitor; freed with memory_free. */
static char *monitor_path(const struct monitors *monitors, const struct monitor *monitor)
{
    return memory_print("%s/history/%s.csv", monitors->folder, monitor->definition->name);
}

/** Begin the file of a monitor, or go on after time *@p t. */
static int monitor_open(const struct monitors *monitors, struct monitor *monitor, const double *t)
{
    const char *const *columns = NULL;
    const int n = columns_of(monitor, monitors->model->dim, &columns);
    char *path = monitor_path(monitors, monitor);
    CHECK_MEMORY(path);
    const int status = t ? history_resume(&monitor->file, path, columns, n, *t)
                         : history_create(&monitor->file, path, columns, n);
    memory_free(path);
    monitor->open = !status;
    return status;
}

int monitors_create(struct monitors **monitors, const struct model *model, const struct coupling *coupling,
                    const char *folder)
{
    struct monitors *m = memory_create(1, sizeof *m);
    CHECK_MEMORY(m);
    *monitors = m;
    m->model = model;
    m->coupling = coupling;
    CHECK_MEMORY(m->folder = memory_text(folder));
    m->monitors = memory_create(model->output.n_histories, sizeof *m->monitors);
    CHECK_MEMORY(m->monitors);
    m->n = model->output.n_histories;
    for (size_t k = 0; k < m->n; ++k) {
        m->monitors[k].definition = &model->output.histories[k];
        CALL(monitor_place(m, &m->monitors[k]));
    }
    return 0;
}

int monitors_start(struct monitors *monitors)
{
    for (size_t k = 0; k < monitors->n; ++k)
        CALL(monitor_open(monitors, &monitors->monitors[k], NULL));
    return 0;
}

int monitors_check(const struct monitors *monitors)
{
    for (size_t k = 0; k < monitors->n; ++k) {
        const char *const *columns = NULL;
        const int n = columns_of(&monitors->monitors[k], monitors->model->dim, &columns);
        char *path = monitor_path(monitors, &monitors->monitors[k]);
        CHECK_MEMORY(path);
        const int status = history_check(path, columns, n);
        memory_free(path);
        CALL(status);
    }
    return 0;
}

int monitors_resume(struct monitors *monitors, double t, double step)
{
    for (size_t k = 0; k < monitors->n; ++k) {
        struct monitor *monitor = &monitors->monitors[k];
        CALL(monitor_open(monitors, monitor, &t));
        if (monitor->definition->every > 0.0)
            monitor->count = schedule_count(monitor->definition->every, t, step);
    }
    return 0;
}

int monitors_sync(const struct monitors *monitors)
{
    for (size_t k = 0; k < monitors->n; ++k)
        CALL(history_sync(&monitors->monitors[k].file));
    return 0;
}

static int force_row(const struct monitors *monitors, struct monitor *monitor, double t)
{
    static const double origin[3];
    double row[7] = {t};
    for (int s = 0; s < monitor->definition->n_surfaces; ++s) {
        double force[3], moment[3];
        surface_total_load(monitors->coupling->parts.surfaces[monitor->definition->surfaces[s]], origin,
                           force, moment);
        for (int k = 0; k < 3; ++k) {
            row[1 + k] += force[k];
            row[4 + k] += moment[k];
        }
    }
    return history_row(&monitor->file, row);
}

static int profile_rows(const struct monitors *monitors, struct monitor *monitor, double t)
{
    const struct model_history *definition = monitor->definition;
    const bool line = definition->kind == HISTORY_PROFILE;
    const int points = line ? definition->points : 1;
    for (int i = 0; i < points; ++i) {
        double row[11] = {t}, x[3];
        double *value = line ? row + 5 : row + 1;
        const double s = geometry_line(definition->from, definition->to, points, i, x);
        if (line) {
            row[1] = s;
            memcpy(&row[2], x, sizeof x);
        }
        value[5] = fluid_probe(monitors->coupling->parts.fluid, x, &value[0], &value[1], &value[4]);
        CALL(history_row(&monitor->file, row));
    }
    return 0;
}

static int volume_row(const struct monitors *monitors, struct monitor *monitor, double t)
{
    const struct particles *block = fluid_particles(monitors->coupling->parts.fluid);
    const struct model_history *definition = monitor->definition;
    double row[7] = {t, 0.0, 0.0, 0.0, INFINITY, -INFINITY, 0.0};
    for (size_t i = 0; i < block->n; ++i) {
        bool counts = true;
        for (int k = 0; definition->has_box && k < block->dim; ++k)
            counts = counts && block->x[k][i] >= definition->from[k] && block->x[k][i] < definition->to[k];
        if (!counts)
            continue;
        if (block->kind[i] != PARTICLE_FLUID) {
            row[6] += 1.0;
            continue;
        }
        row[1] += 1.0;
        row[2] += block->m[i];
        row[3] += block->m[i] / block->rho[i];
        row[4] = fmin(row[4], block->rho[i]);
        row[5] = fmax(row[5], block->rho[i]);
    }
    return history_row(&monitor->file, row);
}

/** Inside a step of the solid the body goes on with its accelerations. */
static int rigid_row(const struct monitors *monitors, struct monitor *monitor, double t)
{
    const struct coupling *coupling = monitors->coupling;
    struct solid_rigid rigid;
    double row[19] = {t};
    solid_rigid(coupling->parts.solids[monitor->definition->mesh], coupling->solids_behind, &rigid);
    const double *const parts[] = {rigid.centre,           rigid.rotation, rigid.velocity,
                                   rigid.angular_velocity, rigid.force,    rigid.moment};
    for (int p = 0; p < 6; ++p)
        memcpy(row + 1 + 3 * p, parts[p], 3 * sizeof *row);
    return history_row(&monitor->file, row);
}

static int energy_row(const struct monitors *monitors, struct monitor *monitor, double t)
{
    const struct coupling_parts *parts = &monitors->coupling->parts;
    double row[5] = {t};
    const struct particles *block = parts->fluid ? fluid_particles(parts->fluid) : NULL;
    for (size_t i = 0; block && i < block->n; ++i)
        if (block->kind[i] == PARTICLE_FLUID)
            for (int k = 0; k < 3; ++k)
                row[1] += 0.5 * block->m[i] * block->u[k][i] * block->u[k][i];
    for (size_t s = 0; s < parts->n_solids; ++s) {
        struct solid_energies energies;
        solid_energies(parts->solids[s], &energies);
        row[2] += energies.kinetic;
        row[3] += energies.elastic;
        row[4] += energies.external;
    }
    return history_row(&monitor->file, row);
}

static int monitor_write(const struct monitors *monitors, struct monitor *monitor, double t)
{
    const struct coupling *coupling = monitors->coupling;
    switch (monitor->definition->kind) {
    case HISTORY_POINT: {
        double row[7] = {t}, a[3], behind = coupling->solids_behind;
        solid_evaluate(coupling->parts.solids[monitor->definition->mesh], &monitor->place, row + 1, row + 4,
                       a);
        for (int k = 0; k < 3 && behind > 0.0; ++k) { /* inside a step of the solid */
            row[1 + k] += behind * (row[4 + k] + 0.5 * behind * a[k]);
            row[4 + k] += behind * a[k];
        }
        return history_row(&monitor->file, row);
    }
    case HISTORY_FORCE:
        return force_row(monitors, monitor, t);
    case HISTORY_GAUGE:
    case HISTORY_PROFILE:
        return profile_rows(monitors, monitor, t);
    case HISTORY_VOLUME:
        return volume_row(monitors, monitor, t);
    case HISTORY_RIGID:
        return rigid_row(monitors, monitor, t);
    case HISTORY_ENERGY:
        return energy_row(monitors, monitor, t);
    case HISTORY_COUPLING: {
        double row[3] = {t, coupling->iterations, coupling->residual};
        return history_row(&monitor->file, row);
    }
    }
    return 0;
}

int monitors_sample(struct monitors *monitors, double t, double step)
{
    for (size_t k = 0; k < monitors->n; ++k) {
        struct monitor *monitor = &monitors->monitors[k];
        if (schedule_due(monitor->definition->every, t, step, &monitor->count))
            CALL(monitor_write(monitors, monitor, t));
    }
    return 0;
}

int monitors_close(struct monitors *monitors)
{
    int status = 0;
    for (size_t k = 0; k < monitors->n; ++k)
        if (monitors->monitors[k].open) {
            int result = history_close(&monitors->monitors[k].file);
            monitors->monitors[k].open = false;
            status = status ? status : result;
        }
    return status;
}

void monitors_destroy(struct monitors *monitors)
{
    if (!monitors)
        return;
    monitors_close(monitors);
    memory_free(monitors->monitors);
    memory_free(monitors->folder);
    memory_free(monitors);
}
