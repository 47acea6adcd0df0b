#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every source compiles for aarch64 (syntax only). The libraries' headers are those of this machine: they come after
# the cross compiler's own, so that only what is missing there is taken here.
set -eu
compiler=aarch64-linux-gnu-gcc
source=${srcdir:-.}

command -v $compiler >/dev/null || { echo "$compiler is not installed"; exit 77; }
echo '#include <stdio.h>' | $compiler -fsyntax-only -x c - 2>/dev/null ||
    { echo "$compiler has no C library (libc6-dev-arm64-cross)"; exit 77; }

checked=0 wrong=0
for file in $(find "$source/src" -name '*.c' | sort); do
    checked=$((checked + 1))
    $compiler -std=gnu11 -fsyntax-only -fopenmp -Wall -Wextra -Wno-missing-field-initializers -D_GNU_SOURCE -DPACKAGE_VERSION='"0"' \
        -DPACKAGE_NAME='"skerry"' -DSWEEP_ISA=baseline -DSWEEP_MANTISSA=24 -DSWEEP_PRECISION=mixed \
        -I"$source/src" -I. -idirafter /usr/include/libxml2 -idirafter /usr/include/hdf5/serial -idirafter /usr/include \
        -idirafter "/usr/include/$(gcc -print-multiarch 2>/dev/null)" "$file" || wrong=$((wrong + 1))
done
echo "$checked files checked, $wrong wrong"
[ "$checked" -gt 0 ] || exit 99
[ "$wrong" = 0 ]
