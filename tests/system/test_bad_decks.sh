#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every deck of tests/decks-bad is refused with exit code 65 and the messages of its .txt (each line of it
# must occur), and nothing is written. A good deck, also with a byte order mark, Windows line ends and an
# editor's schema reference, passes.
set -u
skerry=$(pwd)/skerry
cd "${srcdir:-.}" || exit 99
work=$(mktemp -d) || exit 99
trap 'rm -rf "$work"' EXIT
trap 'exit 99' HUP INT TERM
failed=0

fail() {
    echo "FAIL: $*"
    failed=1
}

control=tests/system/control.xml
"$skerry" run "$control" --steps 2 -q -o "$work/control.out" >"$work/log" 2>&1 ||
    fail "the good deck: exit $? $(cat "$work/log")"
test -f "$work/control.out/control.pvd" || fail "the good deck wrote no series"
printf '\357\273\277' | cat - "$control" >"$work/bom.xml"
sed 's/$/\r/' "$control" >"$work/crlf.xml"
instance='xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="deck.xsd"'
sed "s|<deck |<deck $instance |" "$control" >"$work/editor.xml"
cmp -s "$control" "$work/crlf.xml" && fail "the deck with Windows line ends has none"
cmp -s "$control" "$work/editor.xml" && fail "the deck with a schema reference has none"
for good in bom crlf editor; do
    "$skerry" check "$work/$good.xml" >"$work/log" 2>&1 || fail "$good.xml: exit $? $(cat "$work/log")"
done

number=0
for deck in tests/decks-bad/*.xml; do
    name=$(basename "$deck" .xml)
    number=$((number + 1))
    "$skerry" run "$deck" --steps 2 -o "$work/$name.out" >"$work/stdout" 2>"$work/stderr"
    code=$?
    test "$code" = 65 || fail "$name: exit $code instead of 65: $(cat "$work/stderr")"
    test -e "$work/$name.out" && fail "$name: something was written"
    test -s "$work/stdout" && fail "$name: something was printed on standard output"
    test -s "tests/decks-bad/$name.txt" || fail "$name: no expected text"
    while IFS= read -r line; do
        grep -qF -e "$line" "$work/stderr" || fail "$name: expected: $line
got: $(cat "$work/stderr")"
    done <"tests/decks-bad/$name.txt"
done
test "$number" -ge 30 || fail "only $number bad decks were found"
test "$failed" = 0 && echo "$number bad decks refused"
exit "$failed"
