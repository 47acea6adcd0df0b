#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs that end early: divergence, an escaped particle, an inverted element, no convergence, signals, a folder in use.
# Exit codes, messages that name the place, the last state, and output that stays whole.
set -u
skerry=$(pwd)/skerry
cd "${srcdir:-.}" || exit 99

work=$(mktemp -d) || exit 99
trap 'rm -rf "$work"' EXIT
trap 'exit 99' HUP INT TERM
cd "$work" || exit 99
failed=0

fail() {
    echo "FAIL: $*"
    failed=1
}

# A small box of fluid; $1: time step, $2: body force, $3: walls
box() {
    cat <<END
<deck version="1" dim="2">
  <parameters><parameter name="dx" value="0.01"/></parameters>
  <time end="100" step="$1"><body-force value="$2"/></time>
  <domain lower="-0.04 -0.04" upper="0.24 0.24" outside="stop"/>
  <materials><fluid name="water" density="1" kinematic-viscosity="0.01" sound-speed="2" background-pressure="4"/></materials>
  <fluid formulation="transport-velocity" material="water" spacing="dx">
    <region><box lower="0 0" upper="0.2 0.2"/></region>
  </fluid>
  <surfaces>
    <surface name="sides"><segments closed="yes" fluid="$3" points="0 0  0.2 0  0.2 0.2  0 0.2"/></surface>
    <surface name="floor"><plane point="0 0" normal="0 1"/></surface>
  </surfaces>
  <boundaries><wall name="w" surfaces="$4" treatment="fixed-particles"/></boundaries>
  <output><fields every="0.01"/><history name="v" type="volume" every="0.01"/></output>
</deck>
END
}

# A beam alone; $1: its load
beam() {
    cat <<END
<deck version="1" dim="2">
  <time end="1" step="0.01"/>
  <materials><solid name="rubber" law="saint-venant-kirchhoff" density="10" young="1400" poisson="0.4"/></materials>
  <meshes>
    <mesh name="beam" material="rubber" formulation="eas">
      <grid lower="0 0" upper="0.35 0.02" cells="20 2"/>
      <set name="root"><box lower="0 0" upper="0 0.02"/></set>
      <set name="tip"><box lower="0.35 0" upper="0.35 0.02"/></set>
      <support set="root" fixed="x y"/>
      <load set="tip" force="$1"/>
    </mesh>
  </meshes>
  <output><fields every="0.1"/><history name="tip" type="point" mesh="beam" at="0.35 0.01" every="0"/></output>
</deck>
END
}

# ends CODE TEXT DECK: the run ends so, names the place, leaves a summary
ends() {
    timeout 120 "$skerry" run "$3" -q -j 1 -o "$3.out" >"$work/stdout" 2>"$work/stderr" </dev/null
    got=$?
    test "$got" = "$1" || fail "$3: exit $got instead of $1: $(cat "$work/stderr")"
    grep -q -e "$2" "$work/stderr" || fail "$3: \"$2\" is missing in: $(cat "$work/stderr")"
    test -s "$3.out/summary.json" || fail "$3: no summary.json"
    test -z "$(find "$3.out" -name '*.tmp')" || fail "$3: temporary files left"
}

box 0.02 "0 0" left sides >diverges.xml
ends 70 'the fluid diverged at t = .* particle [0-9]* at (' diverges.xml
test -s diverges.xml.out/blowup.vtu || fail "no blowup.vtu after a divergence"

box 0.00125 "3 0" left floor >escapes.xml
ends 70 'particle [0-9]* left the domain at (' escapes.xml
test -s escapes.xml.out/blowup.vtu || fail "no blowup.vtu after an escape"

beam "-4000000 0" >inverts.xml
ends 70 'element' inverts.xml
test -s inverts.xml.out/blowup.vtu || fail "no blowup.vtu after an inverted element"

# Signals: the step is finished, every file is whole, there is a checkpoint, the exit code is 75.
box 0.00125 "0 -0.1" left sides >signal.xml
for signal in INT TERM; do
    code=75
    # A shell starts background jobs with SIGINT ignored; env resets it where it can.
    env --default-signal=INT "$skerry" run signal.xml -q -j 1 -o "signal-$signal" 2>"$work/stderr" &
    pid=$!
    tries=0
    until test -s "signal-$signal/signal.pvd" || test $tries -ge 200; do
        sleep 0.1
        tries=$((tries + 1))
    done
    sleep 0.3
    kill -"$signal" $pid
    wait $pid
    got=$?
    test $got = $code || fail "SIG$signal: exit $got instead of $code: $(cat "$work/stderr")"
    tail -n 1 "signal-$signal/signal.pvd" | grep -q '</VTKFile>' || fail "SIG$signal: the series file is not whole"
    for file in $(sed -n 's/.*file="\([^"]*\)".*/\1/p' "signal-$signal/signal.pvd"); do
        tail -c 12 "signal-$signal/$file" | grep -q '</VTKFile>' || fail "SIG$signal: $file is not whole"
    done
    grep -q '"status": *'$code "signal-$signal/summary.json" || fail "SIG$signal: summary.json does not say $code"
    test -s "$(ls "signal-$signal"/checkpoint/step_*.manifest)" || fail "SIG$signal: no checkpoint"
    grep -q "stopped early by SIG$signal .* skerry resume signal-$signal" "$work/stderr" ||
        fail "SIG$signal: not told how to go on: $(cat "$work/stderr")"
    test -z "$(find "signal-$signal" -name '*.tmp')" || fail "SIG$signal: temporary files left"
done

# A folder in use is refused, with --force only what a run wrote is replaced.
"$skerry" run signal.xml -q -j 1 --steps 1 -o signal-INT 2>"$work/stderr"
test $? = 73 || fail "a folder in use is not refused"
grep -q -e '--force' "$work/stderr" || fail "the message does not name --force: $(cat "$work/stderr")"
echo mine >signal-INT/notes.txt
"$skerry" run signal.xml -q -j 1 --steps 1 --force -o signal-INT || fail "--force fails"
test "$(cat signal-INT/notes.txt)" = mine || fail "--force removed a file that is not ours"
test "$(find signal-INT/fields -name 'fluid_*.vtu' | wc -l)" = 1 || fail "--force left old frames"

# --until ends after the first step that reaches it, without shortening it; --steps counts from t = 0.
"$skerry" run signal.xml -q -j 1 --until 0.003 -o until || fail "--until fails"
grep -q '"steps": *3,' until/summary.json || fail "--until 0.003 did not take 3 steps of 0.00125: $(grep steps until/summary.json)"

exit $failed
