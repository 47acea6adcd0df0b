// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/interrupt.h"

#include "base/memory.h"

#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <time.h>
#include <unistd.h>

static const long long twice = 500000000; // ns

static const struct {
    int number;
    const char *name;
} stops[] = {{SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}, {SIGXCPU, "SIGXCPU"}};

static volatile sig_atomic_t stop_signal, save_wanted;
static atomic_llong stopped_at; // ns; 0: not yet. Any thread may be the one that catches a signal.

static void stop_catch(int number)
{
    const int error = errno;
    struct timespec clock;
    clock_gettime(CLOCK_MONOTONIC, &clock);
    const long long now = clock.tv_sec * 1000000000LL + clock.tv_nsec;
    long long first = 0;
    if (atomic_compare_exchange_strong(&stopped_at, &first, now)) {
        stop_signal = number;
    } else if (now - first > twice && number != SIGXCPU) {
        signal(number, SIG_DFL);
        raise(number); // acts when this handler returns
    }
    errno = error;
}

static void save_catch(int number)
{
    (void)number;
    save_wanted = 1;
}

void interrupt_catch(void)
{
    struct sigaction action = {.sa_handler = stop_catch, .sa_flags = SA_RESTART}, before;
    sigemptyset(&action.sa_mask);
    stop_signal = save_wanted = 0;
    atomic_store(&stopped_at, 0);
    for (size_t k = 0; k < sizeof stops / sizeof *stops; ++k)
        if (sigaction(stops[k].number, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(stops[k].number, &action, NULL);
    action.sa_handler = save_catch;
    sigaction(SIGUSR1, &action, NULL);
}

const char *interrupt_stop(void)
{
    for (size_t k = 0; k < sizeof stops / sizeof *stops; ++k)
        if (stop_signal == stops[k].number)
            return stops[k].name;
    return NULL;
}

bool interrupt_save(void)
{
    const bool wanted = save_wanted;
    save_wanted = 0;
    return wanted;
}

bool interrupt_stop_file(const char *folder)
{
    char *path = memory_print("%s/stop", folder);
    const bool found = path && unlink(path) == 0;
    memory_free(path);
    return found;
}
