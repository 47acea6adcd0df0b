#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every kind of element and every law in a flow: loads balance, work becomes energy.
if ! python3 -c 'import sys; sys.exit(sys.version_info < (3, 9))' 2>/dev/null; then
    echo "skipped: needs python3 3.9 or newer"
    exit 77
fi
test -x ./skerry || exit 99
exec python3 "${srcdir:-.}/tests/system/test_elements.py" "$(pwd)/skerry"
