// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TESTS_RUN_ASSEMBLY_H
#define TESTS_RUN_ASSEMBLY_H

#include "base/timer.h"
#include "coupling/coupling.h"
#include "fluid/fluid.h"
#include "model/model.h"
#include "solid/solid.h"

#include <stddef.h>

/** The parts of a run, built from a deck as the program does it, without output. */
struct assembly {
    struct model *model;
    struct timer timer;
    size_t n_surfaces, n_solids;
    struct surface **surfaces;
    struct solid **solids;
    struct fluid *fluid;
    struct coupling *coupling;
    double t;
    long step;
    int64_t put_back; /**< particles that assembly_step_balanced has seen walls put back */
    double owed[3];   /**< momentum of the last of them that walls get in the next step, kg m/s */
};

/** Read @p deck (the text of one) with @p overrides ("NAME=VALUE", NULL at the end; NULL: none), check the
 * combination of parts and build them. Returns a status; assembly_reset is due in any case. */
int assembly_create(struct assembly *assembly, const char *deck, const char *const *overrides);
void assembly_reset(struct assembly *assembly);

/** The evaluation at time 0. */
int assembly_start(struct assembly *assembly);

/** @p n steps of the deck's length. Returns a status. */
int assembly_steps(struct assembly *assembly, long n);

/** The moving block, to be changed by a test before assembly_start. */
struct particles *assembly_particles(struct assembly *assembly);

/** The surface called @p name, or NULL. */
struct surface *assembly_surface(const struct assembly *assembly, const char *name);

/** Values of a particle field: one array per component. */
double *const *assembly_field(const struct assembly *assembly, const char *name);

/** Values of a field of the nodes of solid 0: rows of 3. */
const double (*assembly_nodes(const struct assembly *assembly, const char *name))[3];

/** Move every particle by up to @p size along each direction, repeatably. */
void assembly_jitter(struct assembly *assembly, double size);

/** One step; afterwards @p defect is what the fluid's momentum changed by other than the constant body force
 * and the impulse of the walls account for, relative to the sum of what flowed through all particles. Of
 * particles that are put back walls get the momentum as a force at the end of the step, half of it in this
 * step and half in the next: the balance of such steps is that of both. Returns a status. */
int assembly_step_balanced(struct assembly *assembly, double *defect);

/** What the engine says from now on goes into a file instead of to the terminal. */
void assembly_listen(void);

/** What was said since assembly_listen: at most @p size - 1 characters. Ends listening. */
void assembly_heard(char *text, size_t size);

#endif
