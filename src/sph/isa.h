// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_ISA_H
#define SPH_ISA_H

#include <stdbool.h>

/** Instruction sets that the sweeps over pairs are compiled for, one object each (Makefile.am): of x86-64
 * the psABI levels without a name, v3 (AVX2 and FMA) and v4 (AVX-512); elsewhere the baseline alone. Sums
 * differ in their last bits between instruction sets, never between numbers of threads. */
enum isa { ISA_BASELINE, ISA_V3, ISA_V4, ISAS };

/** "baseline", "v3", "v4". */
const char *isa_name(enum isa isa);

/** The best that this machine can run. */
enum isa isa_best(void);

/** Whether @p name is an instruction set that this machine can run. */
bool isa_available(const char *name);

/** The instruction set called @p name; NULL and "auto" mean the best. STATUS_USAGE when there is none of this
 * name or this machine cannot run it. */
int isa_choose(const char *name, enum isa *isa);

/** Initialiser of an array of ISAS pointers to the objects that @p table##_ISA_PRECISION names. */
#ifdef SKERRY_SWEEPS_X86
#define ISA_TABLE(table, precision)                                                                          \
    {                                                                                                        \
        &table##_baseline_##precision, &table##_v3_##precision, &table##_v4_##precision                      \
    }
#else
#define ISA_TABLE(table, precision)                                                                          \
    {                                                                                                        \
        &table##_baseline_##precision                                                                        \
    }
#endif

#endif
