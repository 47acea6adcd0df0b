// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/simulation.h"

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "coupling/coupling.h"
#include "open/open_list.h"
#include "output/view.h"
#include "revision.h"
#include "run/folder.h"
#include "run/frames.h"
#include "run/monitor.h"
#include "run/progress.h"
#include "run/summary.h"
#include "solid/solid.h"
#include "wall/wall_list.h"

#include <math.h>
#include <signal.h>
#include <string.h>

/** The signal that asked the run to end; the one thing a handler may touch. */
static volatile sig_atomic_t simulation_signal;

static void signal_catch(int number)
{
    simulation_signal = number;
}

/** Everything of one run. */
struct simulation {
    const struct model *model;
    const struct run_options *options;
    char *folder;
    struct timer timer;
    size_t n_surfaces, n_solids;
    struct surface **surfaces;
    struct solid **solids;
    struct fluid *fluid;
    struct coupling *coupling;
    struct frames *frames;
    struct monitors *monitors;
    struct progress progress;
    double t, started, status_written, updates;
    long step, next_frame;
};

int simulation_check(const struct model *model)
{
    int status = 0;
    const struct coupling_type *scheme = coupling_choose(model);
    status |= scheme ? scheme->check(model) : STATUS_DECK;
    for (size_t k = 0; k < model->n_walls; ++k)
        for (size_t w = 0; w < WALL_TYPES; ++w)
            if (!strcmp(wall_types[w]->name, model->walls[k].treatment))
                status |= wall_types[w]->check(model, &model->walls[k]);
    if (!model->fluid.present && !model->n_meshes)
        status |=
            error_report(STATUS_DECK, "%s: error: the deck has neither a <fluid> nor a <mesh>", model->path);
    return status ? STATUS_DECK : 0;
}

static int surfaces_create(struct simulation *s)
{
    s->surfaces = memory_create(s->model->n_surfaces, sizeof *s->surfaces);
    CHECK_MEMORY(s->surfaces);
    for (; s->n_surfaces < s->model->n_surfaces; ++s->n_surfaces)
        CALL(surface_create(&s->surfaces[s->n_surfaces], s->model, (int)s->n_surfaces, 0.0));
    return 0;
}

static int solids_create(struct simulation *s)
{
    s->solids = memory_create(s->model->n_meshes, sizeof *s->solids);
    CHECK_MEMORY(s->solids);
    for (; s->n_solids < s->model->n_meshes; ++s->n_solids)
        CALL(solid_create(&s->solids[s->n_solids], s->model, (int)s->n_solids));
    for (size_t k = 0; k < s->n_solids; ++k)
        for (size_t p = 0; p < s->n_surfaces; ++p)
            CALL(solid_attach(s->solids[k], s->surfaces[p]));
    return 0;
}

static int parts_create(struct simulation *s)
{
    CALL(surfaces_create(s));
    CALL(solids_create(s));
    if (s->model->fluid.present) {
        const struct fluid_parts parts = {.surfaces = s->surfaces,
                                          .wall_types = wall_types,
                                          .n_wall_types = WALL_TYPES,
                                          .opening_types = open_boundary_types,
                                          .isa = s->options->isa,
                                          .timer = &s->timer};
        CALL(fluid_create(&s->fluid, s->model, &parts));
    }
    const struct coupling_parts parts = {s->fluid,    s->solids,     s->n_solids,
                                         s->surfaces, s->n_surfaces, &s->timer};
    return coupling_create(&s->coupling, s->model, &parts);
}

static void simulation_reset(struct simulation *s)
{
    monitors_destroy(s->monitors);
    frames_destroy(s->frames);
    coupling_destroy(s->coupling);
    fluid_destroy(s->fluid);
    for (size_t k = 0; k < s->n_solids; ++k)
        solid_destroy(s->solids[k]);
    for (size_t k = 0; k < s->n_surfaces; ++k)
        surface_destroy(s->surfaces[k]);
    memory_free(s->solids);
    memory_free(s->surfaces);
    memory_free(s->folder);
}

static size_t particles_now(const struct simulation *s)
{
    return s->fluid ? fluid_particles(s->fluid)->n : 0;
}

static int output_open(struct simulation *s)
{
    const struct run_options *options = s->options;
    s->folder = options->output ? memory_text(options->output) : memory_print("%s.out", s->model->name);
    CHECK_MEMORY(s->folder);
    CALL(folder_create(s->folder, s->model, options->force));
    char *log = memory_print("%s/log.txt", s->folder);
    CHECK_MEMORY(log);
    int status = log_open(log);
    memory_free(log);
    CALL(status);
    CALL(frames_create(&s->frames, s->model, &s->coupling->parts, s->folder));
    return monitors_create(&s->monitors, s->model, s->coupling, s->folder);
}

/** Whatever is due at this time. */
static int output_sample(struct simulation *s)
{
    double since = timer_now();
    if (schedule_due(s->model->output.every, s->t, s->model->time.step, &s->next_frame)) {
        CALL(frames_write(s->frames, s->t, s->step));
        char text[32];
        snprintf(text, sizeof text, "frame %d", frames_count(s->frames) - 1);
        progress_event(&s->progress, "frame", text);
    }
    CALL(monitors_sample(s->monitors, s->t, s->model->time.step));
    timer_lap(&s->timer, TIMER_OUTPUT, &since);
    return 0;
}

static int status_report_write(struct simulation *s, const char *state)
{
    char *path = memory_print("%s/status.json", s->folder);
    CHECK_MEMORY(path);
    double steps, updates, iterations;
    progress_rates(&s->progress, &steps, &updates, &iterations);
    const struct status_report report = {.state = state,
                                         .step = s->step,
                                         .t = s->t,
                                         .t_end = s->model->time.end,
                                         .dt = s->model->time.step,
                                         .fraction = s->t / s->model->time.end,
                                         .wall_s = timer_now() - s->started,
                                         .eta_s = progress_remaining(&s->progress),
                                         .updates_per_s = updates,
                                         .particles = particles_now(s)};
    int status = status_write(&report, path);
    memory_free(path);
    return status;
}

static bool run_ends(const struct simulation *s)
{
    const struct run_options *options = s->options;
    const double tolerance = 1e-6 * s->model->time.step;
    return s->t >= s->model->time.end - tolerance || (options->steps >= 0 && s->step >= options->steps) ||
           (options->has_until && s->t >= options->until - tolerance);
}

static int time_loop(struct simulation *s)
{
    const double dt = s->model->time.step;
    CALL(coupling_start(s->coupling, 0.0));
    CALL(output_sample(s));
    while (!run_ends(s) && !simulation_signal) {
        CALL(coupling_step(s->coupling, s->t, dt));
        /* a product, not a sum: the same times whatever the number of steps before */
        s->t = (double)++s->step * dt;
        s->updates += (double)particles_now(s);
        CALL(output_sample(s));
        progress_update(&s->progress, s->step, s->t, dt, particles_now(s),
                        s->n_solids ? s->coupling->iterations : 0);
        if (timer_now() - s->status_written > 5.0) {
            CALL(status_report_write(s, "running"));
            s->status_written = timer_now();
        }
    }
    return 0;
}

/** Balances of the end state: mass, momentum and energy of the fluid, energies of the solids. */
static size_t balances_fill(const struct simulation *s, struct summary_pair balances[8])
{
    struct summary_pair *b = balances;
    double mass = 0.0, momentum[3] = {0}, kinetic = 0.0;
    const struct particles *block = s->fluid ? fluid_particles(s->fluid) : NULL;
    for (size_t i = 0; block && i < block->n; ++i)
        for (int k = 0; k < 3 && block->kind[i] == PARTICLE_FLUID; ++k) {
            mass += k == 0 ? block->m[i] : 0.0;
            momentum[k] += block->m[i] * block->u[k][i];
            kinetic += 0.5 * block->m[i] * block->u[k][i] * block->u[k][i];
        }
    const bool deep = s->model->dim == 3;
    if (block) {
        *b++ = (struct summary_pair){"fluid mass", mass, deep ? "kg" : "kg/m"};
        *b++ = (struct summary_pair){"fluid momentum x", momentum[0], deep ? "kg m/s" : "kg/s"};
        *b++ = (struct summary_pair){"fluid momentum y", momentum[1], deep ? "kg m/s" : "kg/s"};
        *b++ = (struct summary_pair){"fluid kinetic energy", kinetic, deep ? "J" : "J/m"};
    }
    double solid_kinetic = 0.0, elastic = 0.0, external = 0.0;
    for (size_t k = 0; k < s->n_solids; ++k) {
        struct solid_energies energies;
        solid_energies(s->solids[k], &energies);
        solid_kinetic += energies.kinetic;
        elastic += energies.elastic;
        external += energies.external;
    }
    if (s->n_solids) {
        *b++ = (struct summary_pair){"solid kinetic energy", solid_kinetic, deep ? "J" : "J/m"};
        *b++ = (struct summary_pair){"elastic energy", elastic, deep ? "J" : "J/m"};
        *b++ = (struct summary_pair){"work on solids", external, deep ? "J" : "J/m"};
    }
    return (size_t)(b - balances);
}

static size_t numbers_fill(const struct simulation *s, struct summary_pair numbers[8])
{
    struct summary_pair *n = numbers;
    *n++ = (struct summary_pair){"frames", frames_count(s->frames), NULL};
    if (s->fluid) {
        long put_back = 0;
        for (size_t b = 0; b < fluid_boundary_count(s->fluid); ++b)
            put_back += fluid_boundary(s->fluid, b)->put_back_count;
        *n++ = (struct summary_pair){
            "bytes_per_particle", (double)fluid_bytes(s->fluid) / (double)fluid_particles(s->fluid)->n, NULL};
        *n++ = (struct summary_pair){"stable_step", fluid_stable_step(s->fluid), NULL};
        *n++ = (struct summary_pair){"put_back", (double)put_back, NULL};
        *n++ = (struct summary_pair){"rebuilds", (double)fluid_rebuilds(s->fluid), NULL};
    }
    return (size_t)(n - numbers);
}

static int summary_finish(struct simulation *s, int result)
{
    struct summary_pair balances[8], numbers[8];
    struct summary_pair *parameters = memory_create(s->model->n_parameters, sizeof *parameters);
    char *path = memory_print("%s/summary.json", s->folder);
    int status = parameters && path ? 0 : STATUS_MEMORY;
    for (size_t k = 0; !status && k < s->model->n_parameters; ++k)
        parameters[k] =
            (struct summary_pair){s->model->parameters[k].name, s->model->parameters[k].value, NULL};
    struct summary summary = {.version = PACKAGE_VERSION,
                              .revision = SKERRY_REVISION,
                              .deck = s->model->path,
                              .isa = s->fluid ? fluid_isa(s->fluid) : NULL,
                              .dim = s->model->dim,
                              .threads = parallel_threads(),
                              .status = result,
                              .particles = particles_now(s),
                              .steps = s->step,
                              .t = s->t,
                              .wall_s = timer_now() - s->started,
                              .updates = s->updates,
                              .iterations_mean =
                                  s->fluid && s->n_solids && s->coupling->steps
                                      ? (double)s->coupling->total_iterations / (double)s->coupling->steps
                                      : 0.0,
                              .files = frames_files(s->frames),
                              .n_parameters = s->model->n_parameters,
                              .parameters = parameters,
                              .n_overrides = s->options->n_overrides,
                              .overrides = s->options->overrides,
                              .n_balances = balances_fill(s, balances),
                              .balances = balances,
                              .n_numbers = numbers_fill(s, numbers),
                              .numbers = numbers,
                              .timer = &s->timer};
    if (!status)
        status = hash_file(s->model->path, &summary.deck_hash, NULL);
    if (!status)
        status = summary_write(&summary, path);
    if (!status && !s->options->quiet)
        summary_print(&summary);
    memory_free(path);
    memory_free(parameters);
    return status;
}

/** SIGINT and SIGTERM end the run after the current step; a second one ends it at once. */
static void signals_catch(void)
{
    struct sigaction action = {.sa_handler = signal_catch, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    simulation_signal = 0;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

static int view_open(const struct simulation *s)
{
    const struct view view = {.name = s->model->name,
                              .dim = s->model->dim,
                              .spacing = s->model->fluid.present ? s->model->fluid.spacing : 0.0,
                              .colour = "Velocity"};
    char *path = memory_print("%s/view.py", s->folder);
    CHECK_MEMORY(path);
    int status = view_write(&view, path);
    memory_free(path);
    return status;
}

static int run_whole(struct simulation *s)
{
    const struct run_options *options = s->options;
    CALL(parts_create(s));
    CALL(output_open(s));
    CALL(view_open(s));
    signals_catch();
    const double end = options->has_until ? fmin(options->until, s->model->time.end) : s->model->time.end;
    const struct progress_setup setup = {
        .quiet = options->quiet, .json = options->json, .t_end = end, .step_end = options->steps};
    s->started = s->status_written = timer_now();
    progress_start(&s->progress, &setup);
    int result = time_loop(s);
    if (!result && simulation_signal)
        result = 128 + simulation_signal;
    progress_end(&s->progress, result);
    if (result == STATUS_NUMERICAL)
        frames_blowup(s->frames, s->t, s->step);
    int closed = monitors_close(s->monitors);
    int status = status_report_write(s, result == 0 ? "done" : result > 128 ? "stopped" : "failed");
    int summary = summary_finish(s, result);
    return result ? result : closed ? closed : status ? status : summary;
}

int simulation_run(const struct model *model, const struct run_options *options)
{
    struct simulation simulation = {.model = model, .options = options};
    parallel_setup(options->threads);
    int status = run_whole(&simulation);
    simulation_reset(&simulation);
    log_close();
    return status;
}
