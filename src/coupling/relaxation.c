// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/relaxation.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

int relaxation_create(struct relaxation **relaxation, enum relaxation_kind kind, double first, size_t n)
{
    struct relaxation *r = memory_create(1, sizeof *r);
    CHECK_MEMORY(r);
    *r = (struct relaxation){.kind = kind, .first = first, .factor = first, .n = n};
    r->previous = memory_create(n, sizeof *r->previous);
    if (!r->previous) {
        memory_free(r);
        return STATUS_MEMORY;
    }
    *relaxation = r;
    return 0;
}

void relaxation_destroy(struct relaxation *relaxation)
{
    if (!relaxation)
        return;
    memory_free(relaxation->previous);
    memory_free(relaxation);
}

void relaxation_restart(struct relaxation *relaxation)
{
    relaxation->iteration = 0;
}

double relaxation_factor(struct relaxation *relaxation, const double *residual)
{
    double factor = relaxation->kind == RELAXATION_NONE ? 1.0 : relaxation->first;
    if (relaxation->kind == RELAXATION_AITKEN && relaxation->iteration > 0) {
        double product = 0.0, square = 0.0;
        for (size_t k = 0; k < relaxation->n; ++k) {
            double change = residual[k] - relaxation->previous[k];
            product += relaxation->previous[k] * change;
            square += change * change;
        }
        factor = square > 0.0 ? -relaxation->factor * product / square : relaxation->factor;
    }
    memcpy(relaxation->previous, residual, relaxation->n * sizeof *residual);
    ++relaxation->iteration;
    return relaxation->factor = factor;
}
