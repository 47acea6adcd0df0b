#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Interrupted and resumed runs give the bytes of whole ones.
if ! python3 -c 'import sys; sys.exit(sys.version_info < (3, 9))' 2>/dev/null; then
    echo "skipped: needs python3 3.9 or newer"
    exit 77
fi
command -v h5ls >/dev/null && command -v h5diff >/dev/null || { echo "skipped: needs h5ls and h5diff (hdf5-tools)"; exit 77; }
test -x ./skerry || exit 99
exec python3 "${srcdir:-.}/tests/system/test_resume.py" "$(pwd)/skerry"
