// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_INTERRUPT_H
#define RUN_INTERRUPT_H

#include <stdbool.h>

/** What can ask a run to stop or to save itself from outside. Signals are the process's, so the handlers'
 * variables are the one state that is not in an object. */

/** Let SIGINT, SIGTERM, SIGHUP and SIGXCPU ask for a stop, and SIGUSR1 for a checkpoint and a frame. A second
 * signal to stop has its usual effect at once, but not within half a second: timeout(1), service managers and
 * terminals that close send a signal, or two kinds of it, twice. Nor has SIGXCPU, which comes again every
 * second of CPU time. What the parent process ignores (nohup, background jobs of a shell) stays ignored, but
 * for SIGUSR1. */
void interrupt_catch(void);

/** Name of the signal that asked for a stop ("SIGTERM"); NULL: none. */
const char *interrupt_stop(void);

/** Whether SIGUSR1 has come since the last call. */
bool interrupt_save(void);

/** Remove the file "stop" of the folder; whether it was there. */
bool interrupt_stop_file(const char *folder);

#endif
