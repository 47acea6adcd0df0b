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

/** Go on with the series after its last frame of time @p t or before: later entries leave the .pvd, then
 * their files are removed. A series that is missing is begun anew with a warning. The number of frames so far
 * is state. Returns a status (STATUS_IO: the .pvd is damaged; reported). */
int frames_resume(struct frames *frames, double t);

/** Add the number of frames. */
int frames_state(struct frames *frames, struct field_list *list);

/** Write the next frame, then the .pvd. */
int frames_write(struct frames *frames, double t, long step);

/** Write a frame out of turn, named by its step; the numbering goes on as if it were not there. Does nothing
 * when a frame of this time has been written. */
int frames_write_extra(struct frames *frames, double t, long step);

/** Write the last state as blowup.vtu (the fluid, or the first solid), outside the series. */
int frames_blowup(struct frames *frames, double t, long step);

/** Number of frames written in turn, and of files in the series. */
int64_t frames_count(const struct frames *frames);
long frames_files(const struct frames *frames);

#endif
