// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/interrupt.h"

#include "base/memory.h"

#include <signal.h>
#include <stddef.h>
#include <unistd.h>

static volatile sig_atomic_t stop_signal, save_wanted;

static void stop_catch(int number)
{
    stop_signal = number;
}

static void save_catch(int number)
{
    (void)number;
    save_wanted = 1;
}

void interrupt_catch(void)
{
    static const int stops[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};
    struct sigaction action = {.sa_handler = stop_catch, .sa_flags = (int)SA_RESETHAND}, before;
    sigemptyset(&action.sa_mask);
    stop_signal = save_wanted = 0;
    for (size_t k = 0; k < sizeof stops / sizeof *stops; ++k)
        if (sigaction(stops[k], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(stops[k], &action, NULL);
    action.sa_handler = save_catch;
    action.sa_flags = SA_RESTART;
    sigaction(SIGUSR1, &action, NULL);
}

int interrupt_stop(void)
{
    return stop_signal;
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
