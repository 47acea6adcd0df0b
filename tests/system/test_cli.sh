#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The command line: verbs, options, exit codes, what is printed where.
set -u
skerry=$(pwd)/skerry
cd "${srcdir:-.}" || exit 99
work=$(mktemp -d) || exit 99
trap 'rm -rf "$work"' EXIT
trap 'exit 99' HUP INT TERM
failed=0
control=tests/system/control.xml

fail() {
    echo "FAIL: $*"
    failed=1
}

# expect CODE TEXT ARGUMENT...: exit code, and a text in standard output or error ("": none wanted)
expect() {
    code=$1
    text=$2
    shift 2
    timeout 60 "$skerry" "$@" >"$work/stdout" 2>"$work/stderr" </dev/null
    got=$?
    test "$got" = "$code" || fail "skerry $*: exit $got instead of $code: $(cat "$work/stderr")"
    if test -n "$text"; then
        cat "$work/stdout" "$work/stderr" | grep -qF -e "$text" ||
            fail "skerry $*: \"$text\" is missing in: $(cat "$work/stdout" "$work/stderr")"
    fi
}

# quiet_on stdout|stderr: nothing was printed there
quiet_on() {
    test -s "$work/$1" && fail "unexpected on $1: $(cat "$work/$1")"
}

expect 64 'usage: skerry VERB'
quiet_on stdout
expect 0 'usage: skerry VERB' --help
quiet_on stderr
expect 0 'usage: skerry VERB' -h
expect 0 'instruction set' --version
grep -q '^skerry [0-9]' "$work/stdout" || fail "no version in: $(cat "$work/stdout")"
grep -q '^libxml2 ' "$work/stdout" || fail "no libraries in: $(cat "$work/stdout")"
expect 64 'unknown verb chekc; did you mean check?' chekc "$control"
expect 64 'see skerry --help' zzzzzzzz
for verb in check run show schema help picture probe; do
    expect 0 "usage: skerry $verb" "$verb" --help
    expect 0 "usage: skerry $verb" "$verb" -h
    expect 64 'has no option --nonsense' "$verb" --nonsense
done
expect 64 'skerry run has no option --forc; did you mean --force?' run "$control" --forc
expect 64 'skerry show has no option --force' show "$control" --force
expect 64 'skerry check needs DECK' check
expect 64 'unexpected argument b.xml' check a.xml b.xml
expect 64 '--output needs DIR' run "$control" --output
expect 64 '-j 0: a whole number from 1 to 4096 is wanted' run "$control" -j 0
expect 64 '-j 2x: a whole number' run "$control" -j2x
expect 64 '--steps -1: a whole number' run "$control" --steps -1
expect 64 '--until soon: 1 number is wanted' run "$control" --until soon
expect 64 '--range 1: 2 numbers are wanted, separated by colons' picture x --range 1
expect 64 '--force takes no value' run "$control" --force=yes

# The schema and the help come from the same tables.
expect 0 '<xs:element name="deck" type="deck"/>' schema
if command -v xmllint >/dev/null; then
    cp "$work/stdout" "$work/deck.xsd"
    xmllint --noout --schema "$work/deck.xsd" "$control" 2>"$work/log" || fail "xmllint: $(cat "$work/log")"
    sed 's/<coupling/<couplng/' "$control" >"$work/wrong.xml"
    xmllint --noout --schema "$work/deck.xsd" "$work/wrong.xml" 2>"$work/log" &&
        fail "xmllint accepts a wrong deck"
fi
expect 0 'rho-infinity="..."' help mesh
expect 0 'half-space' help
expect 64 'a deck has no element <mehs>; did you mean <mesh>?' help mehs

# Decks that cannot be read.
expect 66 'missing.xml' check "$work/missing.xml"
expect 66 "$work" check "$work"
mkfifo "$work/fifo.xml"
expect 66 'fifo.xml' check "$work/fifo.xml"

# Parameters.
expect 64 "--set dxx=1: $control has no parameter \"dxx\"; did you mean \"dx\"?" check "$control" --set dxx=1
expect 64 '--set dx: write NAME=VALUE' check "$control" --set dx
expect 64 '--set dx=0.4/: ' check "$control" --set dx=0.4/
expect 64 '--set dx=5 s m q: unknown unit' check "$control" --set 'dx=5 s m q'
expect 65 "$control:14:27: error: <fluid>: spacing=\"dx\" is -0.01; it must be greater than 0" \
    check "$control" --set dx=-0.01
expect 0 'spacing="0.02"' show "$control" --set dx=0.4/20
expect 0 'spacing="0.005"' show "$control" --set dx=0.02 --set 'dx=5 mm'
expect 0 '<parameter name="dx" value="0.02"/>' show "$control" --set=dx=0.02
expect 0 'step="0.0005"' show "$control" --set dx=0.02

# What is shown is a deck that is shown in the same way.
for deck in "$control" decks/*/*.xml; do
    expect 0 '<deck version="1"' show "$deck"
    cp "$work/stdout" "$work/shown.xml"
    expect 0 '' show "$work/shown.xml"
    cmp -s "$work/shown.xml" "$work/stdout" || fail "show of show of $deck differs"
    expect 0 '' check "$work/shown.xml"
done

# check prints what would run and writes nothing; so does run --dry-run.
expect 0 'region   3920 particles' check "$control"
grep -q '33 nodes, 20 quad4 elements, 66 degrees of freedom' "$work/stdout" ||
    fail "check: $(cat "$work/stdout")"
grep -q 'the step of 0.00025 s exceeds the stability limit 0.25 h / (c + u) = 0.0002273 s' "$work/stderr" ||
    fail "check does not warn of the step: $(cat "$work/stderr")"
cp "$control" "$work/dry.xml"
mkdir "$work/dry"
(cd "$work/dry" && "$skerry" run ../dry.xml --dry-run && "$skerry" check ../dry.xml) >/dev/null 2>&1 ||
    fail "run --dry-run"
test -z "$(ls -A "$work/dry")" || fail "run --dry-run wrote $(ls -A "$work/dry")"
expect 0 'the sound speed 5 m/s is less than ten times the highest prescribed speed 1 m/s' \
    check "$control" --set c=5
expect 0 'is 13.333 spacings' check "$control" --set dx=0.03
expect 0 'the solid is only 0.04 thick' check "$control" --set dx=0.025
expect 0 'shorter than one spacing' check "$control" --set dx=0.025

# The output folder.
expect 0 '' run "$control" --steps 1 -q -o "$work/out"
test -f "$work/out/control.pvd" || fail "run -o wrote no series"
expect 73 '' run "$control" --steps 1 -q -o "$work/out"
expect 0 '' run "$control" --steps 1 -q -o "$work/out" --force
expect 73 '' run "$control" --steps 1 -q -o "$work/dry.xml/out"
expect 0 '"ev"' run "$control" --steps 1 -o "$work/json" --json --log "$work/messages"
test -s "$work/messages" || fail "--log wrote nothing"
expect 64 '--isa v9' run "$control" --steps 1 -q -o "$work/isa" --isa v9

# Standard output that cannot be written.
if test -w /dev/full; then
    "$skerry" schema >/dev/full 2>"$work/stderr"
    test $? = 74 || fail "a full device is not noticed: $(cat "$work/stderr")"
fi
"$skerry" schema 2>/dev/null | head -n 1 >/dev/null || fail "schema | head"
exit "$failed"
