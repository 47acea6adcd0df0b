// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_VERSION_H
#define RUN_VERSION_H

#include <stdio.h>

/** What "skerry --version" prints: version and revision, compiler and options, libraries with versions, the
 * instruction set that a run uses on this machine. */
void version_print(FILE *stream);

#endif
