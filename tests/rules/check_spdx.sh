#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Sources say their licence in the first line, scripts in the second.
set -eu
cd "${srcdir:-.}"

checked=0 wrong=0
for file in $(find src tests tools -name '*.[ch]' -o -name '*.sh' -o -name '*.py' -o -name 'skerry-*' -type f) \
    configure.ac Makefile.am m4/skerry.m4 dev; do
    case $file in
    *.o | *.trs | *.log | */skerry-machine) continue ;;
    esac
    checked=$((checked + 1))
    if ! head -n 2 "$file" | grep -q 'SPDX-License-Identifier: GPL-3\.0-or-later'; then
        echo "$file: does not begin with its SPDX licence identifier, GPL-3.0-or-later"
        wrong=$((wrong + 1))
    fi
done
echo "$checked files checked, $wrong wrong"
[ "$checked" -gt 0 ] || exit 99
[ "$wrong" = 0 ]
