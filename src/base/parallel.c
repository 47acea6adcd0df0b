// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"

#include <omp.h>
#include <sched.h>
#include <stdbool.h>
#include <stdlib.h>
#include <unistd.h>

// The CPU that is number @p index of the mask.
static int nth_cpu(const cpu_set_t *mask, int index)
{
    int cpu = 0;

    for (; cpu < CPU_SETSIZE; cpu++)
        if (CPU_ISSET(cpu, mask) && index-- == 0)
            break;
    return cpu;
}

// Worker i goes to CPU i of the mask. The calling thread stays free: it finds the CPU that is left, and
// threads that are started later do not inherit a mask of one CPU.
static void bind_workers(const cpu_set_t *mask)
{
#pragma omp parallel
    {
        const int index = omp_get_thread_num();
        if (index > 0) {
            cpu_set_t own;
            CPU_ZERO(&own);
            CPU_SET(nth_cpu(mask, index), &own);
            sched_setaffinity(0, sizeof own, &own); // only speed depends on it
        }
    }
}

void parallel_wait_briefly(char **arguments)
{
    char program[4096]; // by its own path, so that it keeps its name
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);

    if (length <= 0 || getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT"))
        return;
    program[length] = '\0';
    if (!setenv("GOMP_SPINCOUNT", "1000", 1))
        execv(program, arguments);
}

void parallel_setup(int threads)
{
    cpu_set_t mask;
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    const bool known = sched_getaffinity(0, sizeof mask, &mask) == 0;
    const int usable = known ? CPU_COUNT(&mask) : (int)online;

    omp_set_dynamic(0);
    omp_set_num_threads(threads > 0 ? threads : usable > 0 ? usable : 1);
    if (known && usable < online && parallel_threads() == usable && !getenv("OMP_PROC_BIND"))
        bind_workers(&mask);
}

int parallel_threads(void)
{
    return omp_get_max_threads();
}
