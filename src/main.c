// SPDX-License-Identifier: GPL-3.0-or-later
// The command line. Every verb reads its options from one table, so that help, checks and suggestions agree.
#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/text.h"
#include "base/timer.h"
#include "deck/deck.h"
#include "deck/deck_schema.h"
#include "output/picture.h"
#include "run/preview.h"
#include "run/probe.h"
#include "run/record.h"
#include "run/simulation.h"
#include "run/status.h"
#include "run/version.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** Everything that options can say. */
struct command {
    const char *operand; /**< DECK, OUTPUT or ELEMENT; NULL: none given */
    struct run_options run;
    struct picture picture;
    struct probe probe;
    struct probe_place *places;
    size_t n_overrides;
    const char **overrides;
    const char *log;
    bool verbose, dry_run, help;
};

struct option {
    const char *name;  /**< "--set" */
    char letter;       /**< 'o' for -o; 0: none */
    const char *value; /**< what stands behind it; NULL: nothing */
    const char *verbs; /**< blank-separated */
    const char *doc;
    int (*set)(struct command *command, const char *value);
};

/** @p n numbers separated by colons. */
static int read_numbers(const char *option, const char *text, double *values, int n)
{
    const char *c = text;
    for (int i = 0; i < n; i++) {
        char *end;
        values[i] = strtod(c, &end);
        CHECK(end > c && isfinite(values[i]) && *end == (i + 1 < n ? ':' : '\0'), STATUS_USAGE,
              "%s %s: %d number%s wanted%s", option, text, n, n > 1 ? "s are" : " is",
              n > 1 ? ", separated by colons" : "");
        c = end + 1;
    }
    return 0;
}

static int read_whole(const char *option, const char *text, long least, long most, long *value)
{
    char *end;
    errno = 0;
    *value = strtol(text, &end, 10);
    CHECK(end > text && !*end && !errno && *value >= least && *value <= most, STATUS_USAGE,
          "%s %s: a whole number from %ld to %ld is wanted", option, text, least, most);
    return 0;
}

static int set_override(struct command *command, const char *value)
{
    command->overrides[command->n_overrides++] = value;
    return 0;
}

static int set_output(struct command *command, const char *value)
{
    command->run.output = value;
    return 0;
}

static int set_threads(struct command *command, const char *value)
{
    long threads;
    CALL(read_whole("-j", value, 1, 4096, &threads));
    command->run.threads = (int)threads;
    return 0;
}

static int set_until(struct command *command, const char *value)
{
    command->run.has_until = true;
    return read_numbers("--until", value, &command->run.until, 1);
}

static int set_steps(struct command *command, const char *value)
{
    return read_whole("--steps", value, 0, LONG_MAX, &command->run.steps);
}

static int set_max_wall(struct command *command, const char *value)
{
    CALL(read_numbers("--max-wall", value, &command->run.max_wall, 1));
    CHECK(command->run.max_wall >= 0.0, STATUS_USAGE, "--max-wall %s: seconds are wanted, 0 or more", value);
    return 0;
}

static int set_checkpoint_every(struct command *command, const char *value)
{
    CALL(read_numbers("--checkpoint-every", value, &command->run.checkpoint_every, 1));
    CHECK(command->run.checkpoint_every >= 0.0, STATUS_USAGE,
          "--checkpoint-every %s: seconds are wanted; 0 means after every step", value);
    return 0;
}

static int set_quiet(struct command *command, const char *value)
{
    (void)value;
    command->run.quiet = true;
    return 0;
}

static int set_verbose(struct command *command, const char *value)
{
    (void)value;
    command->verbose = true;
    return 0;
}

static int set_log(struct command *command, const char *value)
{
    command->log = value;
    return 0;
}

static int set_json(struct command *command, const char *value)
{
    (void)value;
    command->run.json = true;
    return 0;
}

static int set_force(struct command *command, const char *value)
{
    (void)value;
    command->run.force = true;
    return 0;
}

static int set_dry_run(struct command *command, const char *value)
{
    (void)value;
    command->dry_run = true;
    return 0;
}

static int set_isa(struct command *command, const char *value)
{
    command->run.isa = value;
    return 0;
}

static int set_field(struct command *command, const char *value)
{
    command->picture.field = command->probe.fields = value;
    return 0;
}

static int set_frame(struct command *command, const char *value)
{
    command->picture.frame = command->probe.frames = value;
    return 0;
}

static int set_range(struct command *command, const char *value)
{
    command->picture.has_range = true;
    return read_numbers("--range", value, command->picture.range, 2);
}

static int set_window(struct command *command, const char *value)
{
    command->picture.has_window = true;
    return read_numbers("--window", value, command->picture.window, 4);
}

static int set_slab(struct command *command, const char *value)
{
    return read_numbers("--slab", value, command->picture.slab, 2);
}

static int set_width(struct command *command, const char *value)
{
    long width;
    CALL(read_whole("--width", value, 100, 20000, &width));
    command->picture.width = (int)width;
    return 0;
}

static int set_file(struct command *command, const char *value)
{
    command->picture.file = value;
    return 0;
}

static int place_add(struct command *command, enum probe_kind kind, const char *value)
{
    command->places[command->probe.n_places++] = (struct probe_place){kind, value};
    return 0;
}

static int set_point(struct command *command, const char *value)
{
    return place_add(command, PROBE_POINT, value);
}

static int set_points(struct command *command, const char *value)
{
    return place_add(command, PROBE_POINTS, value);
}

static int set_line(struct command *command, const char *value)
{
    return place_add(command, PROBE_LINE, value);
}

static int set_grid(struct command *command, const char *value)
{
    return place_add(command, PROBE_GRID, value);
}

static int set_time(struct command *command, const char *value)
{
    command->probe.time = value;
    return 0;
}

static int set_probe_file(struct command *command, const char *value)
{
    command->probe.file = value;
    return 0;
}

static int set_help(struct command *command, const char *value)
{
    (void)value;
    command->help = true;
    return 0;
}

static const struct option options[] = {
    {"--set", 0, "NAME=VALUE", "check run resume show",
     "new value of a parameter of the deck (may be repeated); resume: of one that only the end or the output "
     "depends on",
     set_override},
    {"--output", 'o', "DIR", "check run", "folder of the output (default: NAME.out in the current folder)",
     set_output},
    {"--threads", 'j', "THREADS", "run resume probe",
     "number of threads (default: the CPUs this process may use)", set_threads},
    {"--until", 0, "TIME", "run resume",
     "stop after the first step that reaches TIME (in s); resume: also beyond the deck's end", set_until},
    {"--steps", 0, "N", "run resume",
     "stop when N steps have been made since the start; resume: also beyond the deck's end", set_steps},
    {"--max-wall", 0, "SECONDS", "run resume",
     "stop with a checkpoint (exit code 75) before the program has run so long", set_max_wall},
    {"--checkpoint-every", 0, "SECONDS", "run resume",
     "wall-clock time between checkpoints (default: as the deck says, else 600); 0: after every step",
     set_checkpoint_every},
    {"--quiet", 'q', NULL, "check run resume", "no progress, only warnings and errors", set_quiet},
    {"--verbose", 'v', NULL, "check run resume", "more messages", set_verbose},
    {"--log", 0, "FILE", "check run resume", "append all messages to FILE", set_log},
    {"--json", 0, NULL, "run resume", "progress as JSON, one object a line, on standard output", set_json},
    {"--force", 0, NULL, "run", "remove what an earlier run wrote into the folder", set_force},
    {"--dry-run", 0, NULL, "run", "check everything and print what would run, write nothing", set_dry_run},
    {"--isa", 0, "NAME", "run resume",
     "instruction set: auto, baseline, v3 or v4 (resume: default as before)", set_isa},
    {"--field", 0, "NAME", "picture", "what to colour by, of a vector its size or NAME_x (default: Speed)",
     set_field},
    {"--frame", 0, "FRAME", "picture", "first, last, a number, or t=TIME (default: last)", set_frame},
    {"--range", 0, "A:B", "picture", "values at the ends of the colour bar (default: those that occur)",
     set_range},
    {"--window", 0, "X0:X1:Y0:Y1", "picture", "part of the plane to draw (default: all)", set_window},
    {"--slab", 0, "Z0:Z1", "picture", "3-D: particles between, and solids up to there (default: all)",
     set_slab},
    {"--width", 0, "PIXELS", "picture", "width of the picture (default: 1600)", set_width},
    {"--file", 0, "FILE", "picture", "PNG to write (default: OUTPUT/FIELD_FRAME.png)", set_file},
    {"--point", 0, "X,Y,Z", "probe", "a place, as many numbers as the run has dimensions (may be repeated)",
     set_point},
    {"--points", 0, "FILE", "probe",
     "places from a CSV file: coordinates only, or with columns called x, y, z", set_points},
    {"--line", 0, "FROM:TO:N", "probe", "N places from X,Y,Z to X,Y,Z (may be repeated)", set_line},
    {"--grid", 0, "[LOWER:UPPER:]NXxNYxNZ", "probe",
     "a regular grid between two corners X,Y,Z (default: those of the domain)", set_grid},
    {"--field", 0, "NAME,...", "probe", "arrays of the fluid (default: Pressure,Velocity,Density)",
     set_field},
    {"--frame", 0, "FRAMES", "probe", "first, last, a number, all, A:B, or t=TIME (default: last)",
     set_frame},
    {"--time", 0, "TIME", "probe", "the frame nearest to TIME (in s)", set_time},
    {"--output", 'o', "FILE", "probe",
     "CSV (\"-\" or nothing: standard output), for a grid also .vti (default: OUTPUT/probe/grid_FRAME.vti); "
     "several .vti get numbers and a .pvd",
     set_probe_file},
    {"--help", 'h', NULL, "check run resume status show schema help picture probe", "this text", set_help},
};
enum { N_OPTIONS = sizeof options / sizeof *options };

static int run_check(struct command *command);
static int run_run(struct command *command);
static int run_resume(struct command *command);
static int run_status(struct command *command);
static int run_show(struct command *command);
static int run_schema(struct command *command);
static int run_help(struct command *command);
static int run_picture(struct command *command);
static int run_probe(struct command *command);

static const struct verb {
    const char *name, *operand;
    bool needs_operand;
    const char *doc;
    int (*run)(struct command *command);
} verbs[] = {
    {"check", "DECK", true, "parse and validate a deck, print what would run; write nothing", run_check},
    {"run", "DECK", true, "run a deck", run_run},
    {"resume", "OUTPUT", true,
     "go on with a run that was stopped or killed, from the newest checkpoint in its output folder",
     run_resume},
    {"status", "OUTPUT", true, "tell where a run is", run_status},
    {"show", "DECK", true, "print a deck as understood: every default filled in, every expression evaluated",
     run_show},
    {"schema", NULL, false, "print the XML schema of decks", run_schema},
    {"help", "ELEMENT", false, "print what an element of a deck takes", run_help},
    {"picture", "OUTPUT", true, "draw a frame of a run as PNG", run_picture},
    {"probe", "OUTPUT", true, "fields of a run at points, along lines, on grids: CSV or .vti", run_probe},
};
enum { N_VERBS = sizeof verbs / sizeof *verbs };

static void print_usage(FILE *stream)
{
    fputs("usage: skerry VERB ...\n", stream);
    for (size_t v = 0; v < N_VERBS; v++)
        fprintf(stream, "  %-8s %-8s %s\n", verbs[v].name, verbs[v].operand ? verbs[v].operand : "",
                verbs[v].doc);
    fputs("  --version         print version, libraries, instruction set\n"
          "  -h, --help        this text; skerry VERB --help tells more\n",
          stream);
}

/** Whether @p list, separated by blanks, has the word. */
static bool has_word(const char *list, const char *word)
{
    const size_t length = strlen(word);
    for (const char *c = list; *c; c += strspn(c, " ")) {
        const size_t n = strcspn(c, " ");
        if (n == length && strncmp(c, word, n) == 0)
            return true;
        c += n;
    }
    return false;
}

static void print_verb(const struct verb *verb)
{
    printf("usage: skerry %s", verb->name);
    if (verb->operand)
        printf(verb->needs_operand ? " %s" : " [%s]", verb->operand);
    printf(" [options]\n%s\n", verb->doc);
    for (size_t i = 0; i < N_OPTIONS; i++)
        if (has_word(options[i].verbs, verb->name)) {
            char text[64];
            snprintf(text, sizeof text, "%c%c%s%s %s", options[i].letter ? '-' : ' ',
                     options[i].letter ? options[i].letter : ' ', options[i].letter ? ", " : "  ",
                     options[i].name, options[i].value ? options[i].value : "");
            printf("  %-26s %s\n", text, options[i].doc);
        }
}

/** Report an unknown option of a verb with the closest one. */
static int refuse_option(const struct verb *verb, const char *argument)
{
    const char *names[N_OPTIONS];
    char word[64];
    size_t n = 0;
    for (size_t i = 0; i < N_OPTIONS; i++)
        if (has_word(options[i].verbs, verb->name))
            names[n++] = options[i].name;
    snprintf(word, sizeof word, "%.*s", (int)strcspn(argument, "="), argument);
    const char *closest = text_closest(word, names, n);
    return error_report(STATUS_USAGE, "skerry %s has no option %s%s%s%s", verb->name, argument,
                        closest ? "; did you mean " : "; see skerry ", closest ? closest : verb->name,
                        closest ? "?" : " --help");
}

/** Read one option at arguments[*i] with its value; *i moves to the last argument used. */
static int read_option(const struct verb *verb, char **arguments, int n, int *i, struct command *command)
{
    const char *argument = arguments[*i];
    const struct option *option = NULL;
    const char *value = NULL;
    for (size_t k = 0; k < N_OPTIONS && !option; k++) {
        const size_t length = strlen(options[k].name);
        if (!has_word(options[k].verbs, verb->name))
            continue;
        if (strncmp(argument, options[k].name, length) == 0 &&
            (!argument[length] || argument[length] == '=')) {
            option = &options[k];
            value = argument[length] ? argument + length + 1 : NULL;
        } else if (options[k].letter && argument[0] == '-' && argument[1] == options[k].letter &&
                   (!argument[2] || options[k].value)) {
            option = &options[k];
            value = argument[2] ? argument + 2 : NULL;
        }
    }
    if (!option)
        return refuse_option(verb, argument);
    CHECK(option->value || !value, STATUS_USAGE, "%s takes no value", option->name);
    if (option->value && !value) {
        CHECK(*i + 1 < n, STATUS_USAGE, "%s needs %s", argument, option->value);
        value = arguments[++*i];
    }
    return option->set(command, value);
}

static int read_arguments(const struct verb *verb, int n, char **arguments, struct command *command)
{
    bool only_operands = false;
    for (int i = 0; i < n; i++) {
        if (!only_operands && strcmp(arguments[i], "--") == 0)
            only_operands = true;
        else if (!only_operands && arguments[i][0] == '-' && arguments[i][1])
            CALL(read_option(verb, arguments, n, &i, command));
        else {
            CHECK(verb->operand && !command->operand, STATUS_USAGE, "skerry %s: unexpected argument %s",
                  verb->name, arguments[i]);
            command->operand = arguments[i];
        }
    }
    CHECK(command->operand || !verb->needs_operand || command->help, STATUS_USAGE,
          "skerry %s needs %s; see skerry %s --help", verb->name, verb->operand, verb->name);
    command->run.n_overrides = command->n_overrides;
    command->run.overrides = command->overrides;
    return 0;
}

/** Open what options ask for before anything is said. */
static int messages_open(const struct command *command)
{
    if (command->log)
        CALL(log_open(command->log));
    if (command->verbose)
        log_set_level(LOG_DETAIL);
    return 0;
}

/** Whether the parts of a deck go together; what the deck is like has been said now. */
static int check(const struct command *command, const struct model *model)
{
    if (command->run.quiet)
        log_set_level(LOG_WARNING);
    return simulation_check(model);
}

/** Read the deck and check that its parts go together. */
static int load(struct command *command, struct model **model)
{
    CALL(messages_open(command));
    CALL(deck_read(model, command->operand, command->n_overrides, command->overrides));
    int status = check(command, *model);
    if (status) {
        model_destroy(*model);
        *model = NULL;
    }
    return status;
}

static int run_check(struct command *command)
{
    struct model *model;
    CALL(load(command, &model));
    char *output =
        command->run.output ? memory_text(command->run.output) : memory_print("%s.out", model->name);
    int status = output ? preview_print(model, output, stdout) : STATUS_MEMORY;
    memory_free(output);
    model_destroy(model);
    return status;
}

static int run_run(struct command *command)
{
    if (command->dry_run)
        return run_check(command);
    struct model *model;
    CALL(load(command, &model));
    int status = simulation_run(model, &command->run);
    model_destroy(model);
    return status;
}

static int resume_record(struct command *command, const struct record *record)
{
    const size_t n = record->n_overrides + command->n_overrides;
    const char **overrides = memory_create(n, sizeof *overrides);
    struct model *model = NULL;
    CHECK_MEMORY(overrides);
    for (size_t k = 0; k < n; k++)
        overrides[k] =
            k < record->n_overrides ? record->overrides[k] : command->overrides[k - record->n_overrides];
    struct run_options options = command->run;
    options.resume = true;
    options.output = command->operand;
    options.isa_before = record->isa;
    options.overrides = overrides;
    options.n_overrides = n;
    options.n_overrides_before = record->n_overrides;
    int status = deck_read_resume(&model, record->deck, n, overrides, record->n_overrides);
    if (!status)
        status = check(command, model);
    if (!status)
        status = simulation_run(model, &options);
    model_destroy(model);
    memory_free(overrides);
    return status;
}

static int run_resume(struct command *command)
{
    struct record record;
    CALL(messages_open(command));
    CALL(record_read(&record, command->operand));
    const int status = resume_record(command, &record);
    record_reset(&record);
    return status;
}

static int run_status(struct command *command)
{
    return status_print(command->operand, stdout);
}

static int run_show(struct command *command)
{
    return deck_show(command->operand, command->n_overrides, command->overrides, stdout);
}

static int run_schema(struct command *command)
{
    (void)command;
    return schema_print(stdout);
}

static int run_help(struct command *command)
{
    return schema_help(command->operand, stdout);
}

static int run_picture(struct command *command)
{
    command->picture.output = command->operand;
    return picture_draw(&command->picture);
}

static int run_probe(struct command *command)
{
    struct record record;
    struct model *model = NULL;
    CALL(record_read(&record, command->operand));
    log_set_level(LOG_ERROR); /* what is odd about the deck has been said when it was run */
    int status = deck_read(&model, record.deck, record.n_overrides, (const char *const *)record.overrides);
    log_set_level(LOG_INFO);
    record_reset(&record);
    CALL(status);
    command->probe.output = command->operand;
    command->probe.places = command->places;
    command->probe.threads = command->run.threads;
    status = probe_write(&command->probe, model);
    model_destroy(model);
    return status;
}

static int run_verb(const struct verb *verb, int n, char **arguments)
{
    struct command command = {.run = {.steps = -1,
                                      .isa = "auto",
                                      .started = timer_now(),
                                      .max_wall = -1.0,
                                      .checkpoint_every = -1.0},
                              .picture = {.field = "Speed", .frame = "last", .width = 1600}};
    command.overrides = memory_create((size_t)n, sizeof *command.overrides);
    command.places = memory_create((size_t)n, sizeof *command.places);
    int status = command.overrides && command.places ? 0 : STATUS_MEMORY;
    if (!status)
        status = read_arguments(verb, n, arguments, &command);
    if (!status && command.help)
        print_verb(verb);
    else if (!status)
        status = verb->run(&command);
    memory_free(command.places);
    memory_free(command.overrides);
    return status;
}

static int dispatch(int n, char **arguments)
{
    const char *names[N_VERBS];
    if (n < 2) {
        print_usage(stderr);
        return STATUS_USAGE;
    }
    if (strcmp(arguments[1], "-h") == 0 || strcmp(arguments[1], "--help") == 0) {
        print_usage(stdout);
        return 0;
    }
    if (strcmp(arguments[1], "--version") == 0) {
        version_print(stdout);
        deck_print_libraries(stdout);
        return 0;
    }
    for (size_t v = 0; v < N_VERBS; v++) {
        names[v] = verbs[v].name;
        if (strcmp(arguments[1], verbs[v].name) == 0)
            return run_verb(&verbs[v], n - 2, arguments + 2);
    }
    const char *closest = text_closest(arguments[1], names, N_VERBS);
    return error_report(STATUS_USAGE, "unknown verb %s%s%s%s", arguments[1], closest ? "; did you mean " : "",
                        closest ? closest : "; see skerry --help", closest ? "?" : "");
}

int main(int n, char **arguments)
{
    parallel_wait_briefly(arguments);
    signal(SIGPIPE, SIG_IGN); // a reader that goes away gives a write error instead
    signal(SIGXFSZ, SIG_IGN); // and so does a limit on the size of files
    int status = dispatch(n, arguments);
    if ((fflush(stdout) || ferror(stdout)) && !status)
        status = error_report(STATUS_IO, "standard output cannot be written");
    log_close();
    return status;
}
