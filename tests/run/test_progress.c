// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/log.h"
#include "run/progress.h"

#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

// Standard output or error, diverted for a while.
struct diversion {
    int descriptor, kept, source;
};

static struct diversion divert(int descriptor, int to, int source)
{
    fflush(NULL);
    struct diversion made = {descriptor, dup(descriptor), source};
    assert_true(made.kept >= 0 && dup2(to, descriptor) >= 0);
    return made;
}

// Undo it; what was written is in @p text.
static void restore(struct diversion *diversion, char *text, size_t size)
{
    fflush(NULL);
    assert_true(dup2(diversion->kept, diversion->descriptor) >= 0);
    close(diversion->kept);
    struct pollfd ready = {.fd = diversion->source, .events = POLLIN};
    size_t n = 0;
    while (n + 1 < size && poll(&ready, 1, 300) > 0) { // a pseudo terminal may hand over in pieces
        ssize_t got = read(diversion->source, text + n, size - 1 - n);
        if (got <= 0)
            break;
        n += (size_t)got;
    }
    text[n] = '\0';
}

static struct diversion divert_pipe(int descriptor)
{
    int ends[2];
    assert_int_equal(pipe2(ends, O_NONBLOCK), 0);
    struct diversion made = divert(descriptor, ends[1], ends[0]);
    close(ends[1]);
    return made;
}

static int count(const char *text, const char *part)
{
    int n = 0;
    for (; (text = strstr(text, part)); ++text)
        ++n;
    return n;
}

static const struct progress_setup setup = {.t = 0.0, .t_end = 2.5, .step = 0, .step_end = -1};

// Without a terminal: a line each 5 %.
static void test_plain(void **state)
{
    (void)state;
    char text[16384];
    struct progress progress;
    struct diversion diversion = divert_pipe(STDERR_FILENO);
    progress_start(&progress, &setup);
    for (long step = 1; step <= 1000; ++step)
        progress_update(&progress, step, 2.5 * (double)step / 1000, 2.5e-3, 10000, 3);
    progress.told -= 61.0; // a minute later, although nothing has moved
    progress_update(&progress, 1000, 2.5, 2.5e-3, 10000, 0);
    progress_end(&progress, 0);
    restore(&diversion, text, sizeof text);
    assert_int_equal(count(text, "\n"), 21);
    assert_int_equal(count(text, "\r"), 0);
    assert_int_equal(count(text, "\033"), 0);
    assert_non_null(strstr(text, "  5.0 %  t = 0.125 of 2.5 s  step 50  dt = 0.0025 s"));
    assert_non_null(strstr(text, "100.0 %  t = 2.5 of 2.5 s  step 1000"));
    assert_non_null(strstr(text, "  3.00 iterations  ETA "));
}

static void test_quiet(void **state)
{
    (void)state;
    char text[4096];
    struct progress progress;
    struct progress_setup quiet = setup;
    quiet.quiet = true;
    struct diversion diversion = divert_pipe(STDERR_FILENO);
    progress_start(&progress, &quiet);
    progress_update(&progress, 1, 1.0, 1.0, 7, 0);
    progress_end(&progress, 0);
    restore(&diversion, text, sizeof text);
    assert_string_equal(text, "");
}

// The terminal side of a pseudo terminal, with the given width.
static int terminal_open(int *controller, unsigned short columns)
{
    *controller = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (*controller < 0)
        skip(); // no pseudo terminals here: a container without devpts
    assert_int_equal(grantpt(*controller), 0);
    assert_int_equal(unlockpt(*controller), 0);
    int terminal = open(ptsname(*controller), O_RDWR | O_NOCTTY);
    assert_true(terminal >= 0);
    struct winsize window = {.ws_col = columns, .ws_row = 24};
    assert_int_equal(ioctl(terminal, TIOCSWINSZ, &window), 0);
    return terminal;
}

static void terminal_run(unsigned short columns, int redraws, char *text, size_t size)
{
    struct progress progress;
    int controller, terminal = terminal_open(&controller, columns);
    struct diversion diversion = divert(STDERR_FILENO, terminal, controller);
    progress_start(&progress, &setup);
    for (int i = 1; i <= redraws; ++i) {
        for (int k = 0; k < 100; ++k) // far more often than it is drawn
            progress_update(&progress, i, 0.001 * i, 1e-3, 1000, 0);
        progress.drawn -= 1.0;
    }
    log_message(LOG_WARNING, "something odd");
    progress_end(&progress, 0);
    log_message(LOG_INFO, "behind");
    restore(&diversion, text, size);
    close(terminal);
    close(controller);
}

static void test_terminal(void **state)
{
    (void)state;
    char text[8192];
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
    terminal_run(200, 3, text, sizeof text);
    assert_int_equal(count(text, "step "), 3);
    assert_int_equal(count(text, "\033[1m"), 3);
    // the message finds an empty line, and so does what comes when the run is over
    assert_non_null(strstr(text, "\r\033[Kskerry: warning: something odd\r\n"));
    assert_non_null(strstr(text, "\r\033[Kbehind"));
    terminal_run(40, 1, text, sizeof text); // cut to the width, so that it can be cleared
    const char *line = strstr(text, "\033[1m");
    assert_non_null(line);
    assert_int_equal(strcspn(line, "\r"), 39 + strlen("\033[1m\033[0m"));
    setenv("NO_COLOR", "1", 1);
    terminal_run(200, 2, text, sizeof text);
    assert_int_equal(count(text, "step "), 2);
    assert_int_equal(count(text, "\033[1m"), 0);
    setenv("TERM", "dumb", 1);
    terminal_run(200, 2, text, sizeof text);
    assert_int_equal(count(text, "\033"), 0);
    assert_int_equal(count(text, "step "), 0); // 5 % are not reached
    unsetenv("NO_COLOR");
}

static void test_json(void **state)
{
    (void)state;
    char text[8192];
    struct progress progress;
    struct progress_setup json = setup;
    json.json = json.quiet = true;
    struct diversion diversion = divert_pipe(STDOUT_FILENO);
    progress_start(&progress, &json);
    progress_update(&progress, 1, 0.5, 0.5, 100, 4);
    progress.reported -= 2.0;
    progress_update(&progress, 2, 1.0, 0.5, 100, 4);
    progress_event(&progress, "frame", "a \"quoted\"\n\\ text \xff");
    progress_end(&progress, 70);
    restore(&diversion, text, sizeof text);
    assert_int_equal(count(text, "\n"), 4);
    assert_non_null(strstr(text, "{\"ev\": \"start\", \"t\": 0, \"t_end\": 2.5, \"step\": 0}\n"));
    assert_non_null(strstr(text, "{\"ev\": \"progress\", \"step\": 2, \"t\": 1, \"dt\": 0.5, \"fraction\": "
                                 "0.40000000000000002, "));
    assert_non_null(strstr(text, "{\"ev\": \"event\", \"kind\": \"frame\", \"text\": "
                                 "\"a \\\"quoted\\\"\\u000a\\\\ text ?\", \"t\": 1, \"step\": 2}\n"));
    assert_non_null(strstr(text, "\"iterations\": 4, "));
    assert_non_null(strstr(text, "\"status\": 70}\n"));
}

// Rates and the remaining time are those of the last minute: a slow start is forgotten.
static void test_remaining(void **state)
{
    (void)state;
    struct progress progress;
    struct progress_setup quiet = setup;
    quiet.quiet = true;
    progress_start(&progress, &quiet);
    assert_true(progress_remaining(&progress) < 0.0);
    // 100 s without any progress, then 1 % and 7 steps a second for 80 s; the clock of the past is set by
    // hand
    double now = progress.started;
    progress.n_samples = 0;
    for (int second = 0; second <= 180; ++second) {
        double part = second < 100 ? 0.0 : 0.01 * (second - 100);
        progress.now = (struct progress_sample){.wall = now + second,
                                                .fraction = part,
                                                .updates = 700000.0 * part,
                                                .step = lround(700 * part),
                                                .iterations = lround(2100 * part)};
        progress.samples[progress.n_samples++ % PROGRESS_SAMPLES] = progress.now;
    }
    double steps, updates, iterations;
    progress_rates(&progress, &steps, &updates, &iterations);
    assert_true(fabs(progress_remaining(&progress) - 20.0) < 1e-6);
    assert_true(fabs(steps - 7.0) < 1e-6);
    assert_true(fabs(updates - 7000.0) < 1e-3);
    assert_true(fabs(iterations - 3.0) < 1e-12);
    progress_end(&progress, 0);
}

// With --steps the count of steps may be what ends the run.
static void test_steps(void **state)
{
    (void)state;
    struct progress progress;
    const struct progress_setup counted = {
        .quiet = true, .t = 1.0, .t_end = 3.0, .step = 100, .step_end = 110};
    progress_start(&progress, &counted);
    progress_update(&progress, 104, 1.1, 0.025, 50, 0);
    assert_true(fabs(progress.now.fraction - 0.4) < 1e-15);
    assert_true(progress.now.updates == 200.0);
    progress_update(&progress, 105, 2.5, 0.025, 50, 0);
    assert_true(fabs(progress.now.fraction - 0.75) < 1e-15);
    progress_update(&progress, 120, 4.0, 0.025, 50, 0);
    assert_true(progress.now.fraction == 1.0);
    progress_end(&progress, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plain), cmocka_unit_test(test_quiet),     cmocka_unit_test(test_terminal),
        cmocka_unit_test(test_json),  cmocka_unit_test(test_remaining), cmocka_unit_test(test_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
