#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Who may include whom: folders of src include only from the folders of this table, and libraries stay in theirs.
set -eu
cd "${srcdir:-.}/src"

# What files of a folder may include, besides their own folder: shell patterns.
allowed()
{
    case $1 in
    base) ;;
    math) echo 'base/*' ;;
    model) echo 'base/* math/*' ;;
    sph) echo 'base/* math/* model/*' ;;
    fluid | wall | open | solid) echo 'base/* math/* model/* sph/*' ;;
    coupling) echo 'base/* math/* model/* fluid/fluid.h solid/solid.h' ;;
    output) echo 'base/* model/*' ;;
    run) echo 'base/* math/* model/* sph/* fluid/* wall/* open/* solid/* coupling/* output/* revision.h' ;;
    deck) echo 'base/* math/* model/* fluid/*_list.h wall/*_list.h open/*_list.h solid/*_list.h
        coupling/*_list.h output/*_list.h' ;;
    main.c) echo 'base/* deck/* model/* output/* run/* revision.h' ;;
    *) return 1 ;;
    esac
}

# Folder that alone may include a library's header.
home()
{
    case $1 in
    libxml/*) echo deck ;;
    udunits2.h) echo deck ;;
    muParser*) echo math ;;
    suitesparse/* | cholmod.h | umfpack.h) echo math ;;
    png.h | hdf5.h) echo output ;;
    esac
}

is_allowed()
{
    set -f
    for pattern in "$2/*" $(allowed "$2"); do
        case $1 in
        $pattern)
            set +f
            return 0
            ;;
        esac
    done
    set +f
    return 1
}

checked=0 wrong=0
for file in $(find . -name '*.[ch]' | sed 's|^\./||' | sort); do
    folder=${file%%/*}
    if ! allowed "$folder" >/dev/null; then
        echo "src/$file: the folder $folder is not in the table of who may include whom"
        wrong=$((wrong + 1))
        continue
    fi
    for header in $(sed -n 's/^ *# *include *"\([^"]*\)".*/\1/p' "$file"); do
        checked=$((checked + 1))
        if ! is_allowed "$header" "$folder"; then
            echo "src/$file: $folder must not include $header"
            wrong=$((wrong + 1))
        fi
    done
    for header in $(sed -n 's/^ *# *include *<\([^>]*\)>.*/\1/p' "$file"); do
        only=$(home "$header")
        # version.c prints the versions of all libraries.
        if [ -n "$only" ] && [ "$only" != "$folder" ] && [ "$file" != run/version.c ]; then
            echo "src/$file: only $only includes <$header>"
            wrong=$((wrong + 1))
        fi
    done
done
echo "$checked includes checked, $wrong wrong"
[ "$checked" -gt 0 ] || exit 99
[ "$wrong" = 0 ]
