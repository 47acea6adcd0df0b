// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_PARALLEL_H
#define BASE_PARALLEL_H

/** Let threads that wait spin for some 10 us only, then sleep, unless the environment says otherwise
 * (OMP_WAIT_POLICY, GOMP_SPINCOUNT): with the OpenMP library's own long spinning two threads were five times
 * slower than one on a shared machine (with 50 us still three times); sleeping at once costs a third on an
 * idle one. The library reads the
 * environment when it is loaded, so the program is started once more with it set; call first in main. Returns
 * if that is not needed or not possible. */
void parallel_wait_briefly(char **arguments);

/** Threads of the parallel regions that follow. @p threads = 0: the CPUs in this process's affinity mask.
 * Threads are bound to CPUs only when the mask was narrowed for this process (never on a shared machine). */
void parallel_setup(int threads);

/** Number of threads in use. */
int parallel_threads(void);

#endif
