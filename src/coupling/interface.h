// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef COUPLING_INTERFACE_H
#define COUPLING_INTERFACE_H

#include "coupling/coupling.h"

/** What the schemes do with the points of all coupled surfaces, taken as one vector: surface by surface,
 * point by point. Private to the coupling schemes. */

/** Trial minus level 1 into coupling->difference; points that no solid moves have none. Returns eq. 46: the
 * norm by the step @p dt and the root of the number of entries. */
double interface_difference(struct coupling *coupling, double dt);

/** Level 1 += @p factor (trial - level 1); factor 1 copies. */
void interface_blend(struct coupling *coupling, double factor);

/** Level 1 := what the quasi-Newton method makes of level 1, coupling->difference and the trial. */
void interface_extrapolate(struct coupling *coupling);

/** Norm of the change of the loads since the last call, N (2-D: N/m). */
double interface_load_change(struct coupling *coupling);

#endif
