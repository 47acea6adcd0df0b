// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/saver.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/timer.h"

#include <math.h>

/** Of a slow disk, for the time before the first checkpoint. */
static const double bytes_per_second = 5e7, least_cost = 0.1;

int saver_create(struct saver *saver, const char *output, double every)
{
    *saver = (struct saver){.every = every, .step = -1, .saved_at = timer_now()};
    saver->folder = memory_print("%s/checkpoint", output);
    return saver->folder ? 0 : STATUS_MEMORY;
}

void saver_reset(struct saver *saver)
{
    field_list_reset(&saver->state);
    memory_free(saver->folder);
    saver->folder = NULL;
}

bool saver_due(const struct saver *saver)
{
    return timer_now() - saver->saved_at >= saver->every;
}

int saver_write(struct saver *saver, const struct checkpoint_note *note)
{
    const double start = timer_now();
    if (saver->step == note->step)
        return 0;
    CALL(checkpoint_write(saver->folder, &saver->state, note, saver->step));
    saver->step = note->step;
    saver->t = note->t;
    saver->saved_at = timer_now();
    saver->cost = fmax(saver->cost, saver->saved_at - start);
    return 0;
}

int saver_read(struct saver *saver, struct checkpoint_note *note)
{
    CALL(checkpoint_read(saver->folder, &saver->state, note));
    saver->step = note->step;
    saver->t = note->t;
    saver->saved_at = timer_now();
    return 0;
}

double saver_cost(const struct saver *saver)
{
    double bytes = 0.0;
    for (size_t g = 0; g < saver->state.n; ++g) {
        const struct field_group *group = saver->state.groups[g];
        for (size_t f = 0; f < group->n_fields; ++f)
            if (group->fields[f].flags & FIELD_STATE)
                bytes += (double)*group->count * (double)field_size(group->fields[f].type) *
                         group->fields[f].components;
    }
    return saver->cost > 0.0 ? saver->cost : least_cost + bytes / bytes_per_second;
}
