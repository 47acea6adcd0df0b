#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# External symbols begin with the name of an object: the file's own or that of another file of its folder, with or
# without its last word (sliding_particles: sliding_...) or the folder's name in front (deck_schema: schema_...), or the
# folder's own name. Names that differ are listed here with their reason.
set -eu
source=${srcdir:-.}

# file: further prefixes
exceptions()
{
    case $1 in
    src/model/geometry) echo 'shape facets' ;;             # the objects that the header of that name defines
    src/model/mesh) echo 'element facets' ;;               # likewise
    src/sph/boundary) echo 'wall_neighbours' ;;            # what boundary_gather fills
    src/wall/projection) echo 'piece' ;;                   # of a surface within reach
    src/wall/*_particles) echo 'boundary' ;;               # the treatments, as the seam of sph/boundary.h names them
    src/open/inflow | src/open/outflow) echo 'open_boundary' ;; # likewise for sph/open_boundary.h
    src/run/monitor) echo 'schedule' ;;
    src/run/summary) echo 'status' ;;
    esac
}

# Names that the files of a folder stand for.
folder_prefixes()
{
    basename "$1"
    for file in "$source/$1"/*.[ch]; do
        name=$(basename "$file")
        name=${name%.*}
        echo "$name"
        echo "${name#"$(basename "$1")"_}"
        case $name in
        *_*) echo "${name%_*}" ;;
        esac
    done | sort -u
}

checked=0 wrong=0
for object in $(find src -name '*.o' -size +0 | grep -v '/\.libs/' | sort); do
    folder=$(dirname "$object")
    [ "$folder" != src ] || continue
    name=$(basename "$object" .o)
    name=${name#lib*_la-}
    # An object of a source that has been renamed or removed says nothing.
    [ -f "$source/$folder/$name.c" ] || continue
    prefixes=$(echo $(folder_prefixes "$folder") $(exceptions "$folder/$name") | sed 's/ /|/g')
    for symbol in $(nm -g --defined-only "$object" | awk 'NF == 3 && $3 !~ /^(__|[.])/ { print $3 }'); do
        checked=$((checked + 1))
        if ! echo "$symbol" | grep -q -E "^($prefixes)s?(_|\$)"; then
            echo "$folder/$name.c: the external symbol $symbol begins with no object's name"
            wrong=$((wrong + 1))
        fi
    done
done
echo "$checked symbols checked, $wrong wrong"
[ "$checked" -gt 0 ] || exit 99
[ "$wrong" = 0 ]
