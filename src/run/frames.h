// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_FRAMES_H
#define RUN_FRAMES_H

#include "coupling/coupling.h"
#include "model/model.h"

/** The field output of a run: all parts of a frame and the series file. */
struct frames;

/** For the run folder @p folder. */
int frames_create(struct frames **frames, const struct model *model, const struct coupling_parts *parts,
                  const char *folder);
void frames_destroy(struct frames *frames);

/** Write the next frame, then the .pvd. */
int frames_write(struct frames *frames, double t, long step);

/** Write the last state as blowup.vtu (the fluid, or the first solid), outside the series. */
int frames_blowup(struct frames *frames, double t, long step);

/** Number of frames and of files written. */
int frames_count(const struct frames *frames);
long frames_files(const struct frames *frames);

#endif
