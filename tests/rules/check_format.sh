#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The sources are formatted by clang-format 14: other versions differ in details.
set -eu
cd "${srcdir:-.}"

for formatter in clang-format-14 clang-format ''; do
    [ -n "$formatter" ] || { echo "clang-format 14 is not installed"; exit 77; }
    "$formatter" --version 2>/dev/null | grep -q 'version 14\.' && break
done

files=$(find src tests tools -name '*.[ch]')
[ -n "$files" ] || exit 99
# shellcheck disable=SC2086 # a list of files
"$formatter" --dry-run --Werror $files
echo "$files" | awk 'END { print NR " files checked" }'
