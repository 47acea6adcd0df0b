#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# skerry probe: its sums against sums over all particles, its forms of output, its refusals.
if ! python3 -c 'import sys; sys.exit(sys.version_info < (3, 9))' 2>/dev/null; then
    echo "skipped: needs python3 3.9 or newer"
    exit 77
fi
exec python3 "${srcdir:-.}/tests/system/test_probe.py" "$(pwd)/skerry"
