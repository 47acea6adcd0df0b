// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_PARALLEL_H
#define BASE_PARALLEL_H

/** Threads of the parallel regions that follow. @p threads = 0: the CPUs in this process's affinity mask.
 * Threads are bound to CPUs only when the mask was narrowed for this process (never on a shared machine). */
void parallel_setup(int threads);

/** Number of threads in use. */
int parallel_threads(void);

#endif
