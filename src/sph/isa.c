// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/isa.h"

#include "base/error.h"

#include <stddef.h>
#include <string.h>

static const char *const names[ISAS] = {"baseline", "v3", "v4"};

const char *isa_name(enum isa isa)
{
    return names[isa];
}

enum isa isa_best(void)
{
#ifdef SKERRY_SWEEPS_X86
    /* one by one: clang 14 does not know the levels by name */
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                    __builtin_cpu_supports("avx512cd");
    return v4 ? ISA_V4 : v3 ? ISA_V3 : ISA_BASELINE;
#else
    return ISA_BASELINE;
#endif
}

static int isa_find(const char *name)
{
    int found = 0;
    while (found < ISAS && strcmp(names[found], name) != 0)
        ++found;
    return found;
}

bool isa_available(const char *name)
{
    return isa_find(name) <= (int)isa_best();
}

int isa_choose(const char *name, enum isa *isa)
{
    *isa = isa_best();
    if (!name || !strcmp(name, "auto"))
        return 0;
    const int found = isa_find(name);
    CHECK(found < ISAS, STATUS_USAGE,
          "--isa %s: unknown instruction set; this program has baseline, v3 and v4 on x86-64", name);
    CHECK(found <= (int)isa_best(), STATUS_USAGE, "--isa %s: this machine cannot run it; the best here is %s",
          name, names[isa_best()]);
    *isa = (enum isa)found;
    return 0;
}
