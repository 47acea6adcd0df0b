#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The generator gives the committed decks, refuses what makes no sense, and skerry accepts what it writes.
set -u

srcdir=${srcdir:-.}
deckgen=$srcdir/tools/skerry-deckgen
skerry=${SKERRY:-./skerry}
failed=0

if ! python3 -c 'import sys; sys.exit(sys.version_info < (3, 9))' 2>/dev/null; then
    echo "skipped: needs python3 3.9 or newer"
    exit 77
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

fail()
{
    echo "FAIL: $*"
    failed=1
}

# Refused with exit code 64 and these words.
refused()
{
    words=$1
    shift
    python3 "$deckgen" "$@" >"$work/out" 2>"$work/err"
    status=$?
    [ $status -eq 64 ] || fail "$*: exit code $status instead of 64"
    [ ! -s "$work/out" ] || fail "$*: wrote a deck all the same"
    grep -q -e "$words" "$work/err" || fail "$*: does not say '$words' but: $(cat "$work/err")"
}

python3 "$deckgen" list >"$work/list" || fail "list: generator failed"
compared=0
for deck in "$srcdir"/decks/*/*.xml; do
    name=$(basename "$deck" .xml)
    grep -q "^$name " "$work/list" || { fail "$name is not in the generator"; continue; }
    python3 "$deckgen" "$name" >"$work/$name.xml" || fail "$name: generator failed"
    cmp -s "$deck" "$work/$name.xml" || fail "$deck differs from the output of skerry-deckgen $name"
    for parameter in dx end frames; do
        grep -q "<parameter name=\"$parameter\" " "$deck" || fail "$deck has no parameter $parameter"
    done
    [ -s "$(dirname "$deck")/README.md" ] || fail "$deck has no README.md beside it"
    compared=$((compared + 1))
done
[ $compared -ge 5 ] || fail "only $compared decks compared"

refused "0.41/69 = 0.00594.* and 0.41/68 = 0.00602" turek-hron-fsi2 --dx 0.006
refused "0.2/28 = .* and 0.2/27 = " hydrostatic-plates --dx 0.0073
refused "--length" turek-hron-fsi2 --length 9
refused "give one" turek-hron-fsi2 --density-ratio 1 --solid-density 3
refused "nothing to accelerate by aitken" turek-hron-fsi2 --solid-every 2 --acceleration aitken
refused "1 fluid step or more" turek-hron-fsi2 --solid-every 0
refused "dx = 0.004 only" exact-pressurewave-1d --dx 0.002
refused "sliding-particles" hydrostatic-plates --wall fixed-particles --no-pressure-gradient
refused "too coarse" taylor-couette --facets 5
refused "too coarse" cylinder-2d2 --facets 7
refused "does not divide the wall" isochoric-box --dx 0.01
python3 "$deckgen" hydrostatic-plates --dx 0 2>"$work/err" && fail "--dx 0 was accepted"
grep -q "must be positive" "$work/err" || fail "--dx 0: does not say what is wrong"
python3 "$deckgen" hydrostatic-plates --dx five 2>"$work/err" && fail "--dx five was accepted"
grep -q "neither a number" "$work/err" || fail "--dx five: does not say what is wrong"

# Variants; skerry reads each when it has been built.
n=0
try()
{
    n=$((n + 1))
    python3 "$deckgen" "$@" -o "$work/variant$n.xml" || { fail "$*: generator failed"; return; }
    python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' "$work/variant$n.xml" ||
        fail "$*: not well-formed"
    if [ -x "$skerry" ]; then
        "$skerry" check "$work/variant$n.xml" >"$work/log" 2>&1 || fail "skerry check of $*: $(cat "$work/log")"
    fi
}
for name in $(cut -d' ' -f1 "$work/list"); do
    try "$name"
done
try turek-hron-fsi2 --dx 0.41/50
try turek-hron-fsi2 --dx 0.41/50 --rigid --corners paper
try turek-hron-fsi2 --dx 0.41/50 --solid-density 5 --young 2800 --length 0.3 --acceleration aitken
try turek-hron-fsi2 --dx 0.41/50 --density-ratio 0.1 --acceleration iqn-ils
try turek-hron-fsi2 --dx 0.41/50 --density-ratio 1 --solid-every 4
try turek-hron-fsi2 --dx 0.41/50 --wall fixed-particles
grep -q 'name="obstacle" surfaces="obstacle" treatment="fixed-particles"/>' "$work/variant$n.xml" || fail "--wall had no effect"
try turek-hron-fsi2 --dx 0.41/50 --wall fixed-particles --rigid
try taylor-couette --facets 48
try taylor-couette --facets 192 --corners paper
try taylor-couette --wall fixed-particles
try hydrostatic-plates --wall fixed-particles --dx 0.01
try hydrostatic-plates --no-pressure-gradient
try cylinder-2d2 --dx 0.01 --wall fixed-particles
try cylinder-2d2 --dx 0.41/50 --facets 24 --corners paper
try isochoric-box --wall fixed-particles
try isochoric-box --dx 0.0025
try balloon --dx 0.2 --rigid
[ "$(grep -c 'mesh\|solid\|coupling' "$work/variant$n.xml")" = 0 ] || fail "balloon --rigid has a solid"
try balloon --dx 0.2 --formulation eas --corners paper
try channel --wall fixed-particles --dx 0.01
try box-2d --cells 31 29
try box-3d --cells 12 13 14
grep -q 'density="0.1" young="5600"' "$work"/variant*.xml || fail "--density-ratio had no effect"
grep -q 'scheme="sub-cycled" solid-every="4" acceleration="added-mass"' "$work"/variant*.xml || fail "--solid-every had no effect"
grep -q 'acceleration="iqn-ils" relaxation="0.5"' "$work"/variant*.xml || fail "--acceleration iqn-ils had no effect"
grep -q 'density="5" young="2800"' "$work"/variant*.xml || fail "--solid-density, --young had no effect"
grep -q 'upper="0.55 0.21" cells="30 3"' "$work"/variant*.xml || fail "--length had no effect"

exit $failed
