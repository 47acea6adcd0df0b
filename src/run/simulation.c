// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/simulation.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "coupling/coupling.h"
#include "open/open_list.h"
#include "output/view.h"
#include "revision.h"
#include "run/folder.h"
#include "run/frames.h"
#include "run/interrupt.h"
#include "run/monitor.h"
#include "run/progress.h"
#include "run/record.h"
#include "run/saver.h"
#include "run/status.h"
#include "run/summary.h"
#include "solid/solid.h"
#include "sph/isa.h"
#include "wall/wall_list.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

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
    double started;     /**< of the time loop, as if all processes of the run had been one, s */
    double wall_before; /**< time loops of the processes before this one, s */
    double t, status_written, stop_looked, longest_step, updates;
    int64_t step;
    long frame_count; /**< frames that were due so far */
    int lock;         /**< of the folder */
    struct saver saver;
    struct field_group state;
    struct field state_fields[2];
    const char *stopped_by; /**< what asked for the end; NULL: nothing */
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
    return 0;
}

/** After the walls have let surfaces follow all nodes that they need. */
static int solids_attach(struct simulation *s)
{
    for (size_t k = 0; k < s->n_solids; ++k)
        for (size_t p = 0; p < s->n_surfaces; ++p)
            CALL(solid_attach(s->solids[k], s->surfaces[p]));
    return 0;
}

/** A run goes on with the instruction set that it began with where that is possible. */
static const char *isa_wanted(const struct run_options *options)
{
    const bool before = options->resume && strcmp(options->isa, "auto") == 0;
    return before && isa_available(options->isa_before) ? options->isa_before : options->isa;
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
                                          .isa = isa_wanted(s->options),
                                          .timer = &s->timer};
        CALL(fluid_create(&s->fluid, s->model, &parts));
    }
    CALL(solids_attach(s));
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
    saver_reset(&s->saver);
    if (s->lock >= 0)
        close(s->lock);
    memory_free(s->folder);
}

static size_t particles_now(const struct simulation *s)
{
    return s->fluid ? fluid_particles(s->fluid)->n : 0;
}

/** Everything that the next step reads, in the order of the checkpoint. */
static int state_list(struct simulation *s)
{
    const struct field fields[] = {
        {"Step", "-", FIELD_INT64, 1, FIELD_STATE, {&s->step}, NULL},
        {"Time", "s", FIELD_DOUBLE, 1, FIELD_STATE, {&s->t}, NULL},
    };
    s->state = field_singles("run", s, s->state_fields, fields, sizeof fields / sizeof *fields);
    struct field_list *list = &s->saver.state;
    CALL(field_list_add(list, &s->state));
    CALL(frames_state(s->frames, list));
    return coupling_state(s->coupling, list);
}

static int log_begin(const struct simulation *s)
{
    char *log = memory_print("%s/log.txt", s->folder);
    CHECK_MEMORY(log);
    const int status = log_open(log);
    memory_free(log);
    return status;
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

/** A new run: its folder with what it needs to be repeated. */
static int run_begin(struct simulation *s)
{
    const struct run_options *options = s->options;
    CALL(folder_create(s->folder, s->model, options->force, &s->lock));
    CALL(log_begin(s));
    CALL(record_create(s->folder, s->model, s->fluid ? fluid_isa(s->fluid) : NULL, options->n_overrides,
                       options->overrides));
    CALL(view_open(s));
    return monitors_start(s->monitors);
}

/** What may make a resumed run differ from one that was not interrupted. */
static void builds_compare(const struct simulation *s, const struct checkpoint_note *note)
{
    const char *isa = s->fluid ? fluid_isa(s->fluid) : "none";
    if (strcmp(note->version, PACKAGE_VERSION) != 0 || strcmp(note->revision, SKERRY_REVISION) != 0)
        log_message(LOG_WARNING,
                    "the checkpoint was written by skerry %s (%s), this is %s (%s): results may differ from "
                    "those of one program",
                    note->version, note->revision, PACKAGE_VERSION, SKERRY_REVISION);
    if (strcmp(note->isa, isa) != 0)
        log_message(LOG_WARNING,
                    "the run used the instruction set %s so far and %s from here: results differ in the last "
                    "digits from those of one of them",
                    note->isa, isa);
}

/** An interrupted run: its state, then its output cut back to that. */
static int run_continue(struct simulation *s)
{
    const struct run_options *options = s->options;
    const double step = s->model->time.step;
    struct checkpoint_note note;
    CALL(folder_lock(s->folder, &s->lock));
    CALL(log_begin(s));
    CALL(saver_read(&s->saver, &note));
    builds_compare(s, &note);
    CALL(coupling_resume(s->coupling));
    CALL(monitors_check(s->monitors));
    CALL(frames_resume(s->frames, s->t)); /* looks at the series before it cuts */
    CALL(monitors_resume(s->monitors, s->t, step));
    const bool same = !s->fluid || strcmp(fluid_isa(s->fluid), options->isa_before) == 0;
    CALL(record_add(s->folder, same ? NULL : fluid_isa(s->fluid),
                    options->n_overrides - options->n_overrides_before,
                    options->overrides + options->n_overrides_before));
    if (s->model->output.every > 0.0)
        s->frame_count = schedule_count(s->model->output.every, s->t, step);
    s->updates = note.updates;
    s->wall_before = note.wall_s;
    memcpy(s->timer.seconds, note.phases_s, sizeof note.phases_s);
    interrupt_stop_file(s->folder); /* it was meant for the process before */
    log_message(LOG_INFO, "resumed from step %lld, t = %.6g s", (long long)s->step, s->t);
    return 0;
}

static int output_open(struct simulation *s)
{
    const struct run_options *options = s->options;
    s->folder = options->output ? memory_text(options->output) : memory_print("%s.out", s->model->name);
    CHECK_MEMORY(s->folder);
    CALL(saver_create(&s->saver, s->folder,
                      options->checkpoint_every < 0.0 ? s->model->output.checkpoint_every
                                                      : options->checkpoint_every));
    CALL(frames_create(&s->frames, s->model, &s->coupling->parts, s->folder));
    CALL(monitors_create(&s->monitors, s->model, s->coupling, s->folder));
    CALL(state_list(s));
    return options->resume ? run_continue(s) : run_begin(s);
}

/** Whatever is due at this time. */
static int output_sample(struct simulation *s)
{
    double since = timer_now();
    if (schedule_due(s->model->output.every, s->t, s->model->time.step, &s->frame_count)) {
        CALL(frames_write(s->frames, s->t, s->step));
        char text[32];
        snprintf(text, sizeof text, "frame %lld", (long long)frames_count(s->frames) - 1);
        progress_event(&s->progress, "frame", text);
    }
    CALL(monitors_sample(s->monitors, s->t, s->model->time.step));
    timer_lap(&s->timer, TIMER_OUTPUT, &since);
    return 0;
}

/** Time at which the run ends, s: the deck's, or earlier; a run that goes on may be told to go further. */
static double end_of(const struct simulation *s)
{
    const struct run_options *options = s->options;
    const bool told = options->resume && (options->has_until || options->steps >= 0);
    double end = told ? INFINITY : s->model->time.end;
    if (options->has_until)
        end = fmin(end, options->until);
    if (options->steps >= 0)
        end = fmin(end, (double)options->steps * s->model->time.step);
    return end;
}

static int status_report_write(struct simulation *s, const char *state)
{
    char *path = memory_print("%s/status.json", s->folder);
    CHECK_MEMORY(path);
    double steps, updates, iterations;
    progress_rates(&s->progress, &steps, &updates, &iterations);
    const struct status_report report = {.state = state,
                                         .step = (long)s->step,
                                         .t = s->t,
                                         .t_end = end_of(s),
                                         .dt = s->model->time.step,
                                         .fraction = fmin(1.0, s->t / fmax(end_of(s), s->model->time.step)),
                                         .wall_s = timer_now() - s->started,
                                         .eta_s = progress_remaining(&s->progress),
                                         .updates_per_s = updates,
                                         .particles = particles_now(s),
                                         .checkpoint_step = s->saver.step,
                                         .checkpoint_t = s->saver.t};
    int status = status_write(&report, path);
    memory_free(path);
    s->status_written = timer_now();
    return status;
}

static bool run_ends(const struct simulation *s)
{
    const struct run_options *options = s->options;
    const double tolerance = 1e-6 * s->model->time.step;
    return s->t >= end_of(s) - tolerance || (options->steps >= 0 && s->step >= options->steps);
}

/** A checkpoint of this step; histories last before it does. */
static int state_save(struct simulation *s)
{
    struct checkpoint_note note = {
        .step = s->step, .t = s->t, .wall_s = timer_now() - s->started, .updates = s->updates};
    double since = timer_now();
    memcpy(note.phases_s, s->timer.seconds, sizeof note.phases_s);
    snprintf(note.version, sizeof note.version, "%s", PACKAGE_VERSION);
    snprintf(note.revision, sizeof note.revision, "%s", SKERRY_REVISION);
    snprintf(note.isa, sizeof note.isa, "%s", s->fluid ? fluid_isa(s->fluid) : "none");
    CALL(monitors_sync(s->monitors));
    CALL(saver_write(&s->saver, &note));
    timer_lap(&s->timer, TIMER_OUTPUT, &since);
    log_message(LOG_DETAIL, "checkpoint of step %lld, t = %.6g s", (long long)s->step, s->t);
    progress_event(&s->progress, "checkpoint", "");
    return 0;
}

/** Whether the wall-clock limit would pass with one more step and a checkpoint. */
static bool wall_ends(const struct simulation *s)
{
    const double margin = 2.0 * s->longest_step + 2.0 * saver_cost(&s->saver);
    return s->options->max_wall >= 0.0 && timer_now() - s->options->started + margin > s->options->max_wall;
}

/** Whether something asks for an early end; the file "stop" is looked for five times a second. */
static bool stop_wanted(struct simulation *s)
{
    const double now = timer_now();
    s->stopped_by = interrupt_stop();
    if (!s->stopped_by && wall_ends(s))
        s->stopped_by = "the wall-clock limit";
    if (!s->stopped_by && now - s->stop_looked >= 0.2) {
        s->stop_looked = now;
        if (interrupt_stop_file(s->folder))
            s->stopped_by = "the file \"stop\"";
    }
    return s->stopped_by;
}

/** Checkpoints that are due or asked for, and status.json, between two steps. */
static int run_tend(struct simulation *s)
{
    if (interrupt_save()) {
        CALL(frames_write_extra(s->frames, s->t, (long)s->step));
        CALL(state_save(s));
        log_message(LOG_INFO, "frame and checkpoint of step %lld, t = %.6g s, as SIGUSR1 asks",
                    (long long)s->step, s->t);
    } else if (saver_due(&s->saver)) {
        CALL(state_save(s));
    }
    return timer_now() - s->status_written > 5.0 ? status_report_write(s, "running") : 0;
}

static int time_loop(struct simulation *s)
{
    const double dt = s->model->time.step;
    if (!s->options->resume) {
        CALL(coupling_start(s->coupling, 0.0));
        CALL(output_sample(s));
    }
    CALL(status_report_write(s, "running"));
    while (!run_ends(s) && !stop_wanted(s)) {
        const double start = timer_now();
        CALL(coupling_step(s->coupling, s->t, dt));
        /* a product, not a sum: the same times whatever the number of steps before */
        s->t = (double)++s->step * dt;
        s->updates += (double)particles_now(s);
        CALL(output_sample(s));
        progress_update(&s->progress, (long)s->step, s->t, dt, particles_now(s),
                        s->n_solids ? s->coupling->iterations : 0);
        s->longest_step = fmax(s->longest_step, timer_now() - start);
        CALL(run_tend(s));
    }
    return state_save(s);
}

/** Balances of the end state: mass, momentum and energy of the fluid, energies of the solids. */
static size_t balances_fill(const struct simulation *s, struct summary_pair balances[12])
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
    static const char *const impulses[] = {"impulse on walls x", "impulse on walls y", "impulse on walls z"};
    for (int k = 0; block && k < s->model->dim; ++k)
        *b++ = (struct summary_pair){impulses[k], s->coupling->wall_impulse[k], deep ? "N s" : "N s/m"};
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
    *n++ = (struct summary_pair){"frames", (double)frames_count(s->frames), NULL};
    if (s->fluid) {
        int64_t put_back = 0;
        for (size_t b = 0; b < fluid_boundary_count(s->fluid); ++b)
            put_back += fluid_boundary(s->fluid, b)->put_back_count;
        *n++ = (struct summary_pair){
            "bytes_per_particle", (double)fluid_bytes(s->fluid) / (double)fluid_particles(s->fluid)->n, NULL};
        *n++ = (struct summary_pair){"stable_step", fluid_stable_step(s->fluid), NULL};
        int64_t born, removed;
        fluid_openings_count(s->fluid, &born, &removed);
        *n++ = (struct summary_pair){"born", (double)born, NULL};
        *n++ = (struct summary_pair){"removed", (double)removed, NULL};
        *n++ = (struct summary_pair){"put_back", (double)put_back, NULL};
        *n++ = (struct summary_pair){"rebuilds", (double)fluid_rebuilds(s->fluid), NULL};
    }
    return (size_t)(n - numbers);
}

static int summary_finish(struct simulation *s, int result)
{
    struct summary_pair balances[12], numbers[8];
    struct summary_pair *parameters = memory_create(s->model->n_parameters, sizeof *parameters);
    char *path = memory_print("%s/summary.json", s->folder);
    int status = parameters && path ? 0 : STATUS_MEMORY;
    for (size_t k = 0; !status && k < s->model->n_parameters; ++k)
        parameters[k] =
            (struct summary_pair){s->model->parameters[k].name, s->model->parameters[k].value, NULL};
    struct summary summary = {.version = PACKAGE_VERSION,
                              .revision = SKERRY_REVISION,
                              .deck = s->model->path,
                              .deck_hash = s->model->inputs[0].hash,
                              .isa = s->fluid ? fluid_isa(s->fluid) : NULL,
                              .dim = s->model->dim,
                              .threads = parallel_threads(),
                              .status = result,
                              .particles = particles_now(s),
                              .steps = (long)s->step,
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
        status = summary_write(&summary, path);
    if (!status && !s->options->quiet)
        summary_print(&summary);
    memory_free(path);
    memory_free(parameters);
    return status;
}

/** The last words: how to go on. */
static void stop_tell(const struct simulation *s)
{
    log_message(LOG_WARNING,
                "stopped early by %s at step %lld, t = %.6g s of %.6g s; to go on: skerry resume %s",
                s->stopped_by, (long long)s->step, s->t, end_of(s), s->folder);
}

static void failure_tell(struct simulation *s, int result)
{
    if (result == STATUS_NUMERICAL)
        frames_blowup(s->frames, s->t, (long)s->step);
    if (s->saver.step >= 0)
        log_message(LOG_INFO, "the newest checkpoint is of step %lld, t = %.6g s", (long long)s->saver.step,
                    s->saver.t);
}

static int run_whole(struct simulation *s)
{
    const struct run_options *options = s->options;
    interrupt_catch();
    CALL(parts_create(s));
    CALL(output_open(s));
    const struct progress_setup setup = {.quiet = options->quiet,
                                         .json = options->json,
                                         .t = s->t,
                                         .t_end = end_of(s),
                                         .step = (long)s->step,
                                         .step_end = options->steps};
    s->started = timer_now() - s->wall_before;
    progress_start(&s->progress, &setup);
    int result = time_loop(s);
    if (!result && s->stopped_by)
        result = STATUS_STOPPED;
    progress_end(&s->progress, result);
    if (result == STATUS_STOPPED)
        stop_tell(s);
    else if (result)
        failure_tell(s, result);
    int closed = monitors_close(s->monitors);
    int status = status_report_write(s, result == 0                ? "done"
                                        : result == STATUS_STOPPED ? "stopped"
                                                                   : "failed");
    int summary = summary_finish(s, result);
    return result ? result : closed ? closed : status ? status : summary;
}

int simulation_run(const struct model *model, const struct run_options *options)
{
    struct simulation simulation = {.model = model, .options = options, .lock = -1};
    parallel_setup(options->threads);
    int status = run_whole(&simulation);
    simulation_reset(&simulation);
    log_close();
    return status;
}
