# SPDX-License-Identifier: GPL-3.0-or-later
"""A run that was interrupted and resumed gives the same bytes as one that was not; what a checkpoint holds is what the
next step reads. Usage: test_resume.py SKERRY [identity | chain | perturb ...]"""

import argparse
import concurrent.futures
import filecmp
import importlib.machinery
import importlib.util
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import resume_decks  # noqa: E402

LONG = bool(os.environ.get("SKERRY_LONG"))
# Reached once by a process that is not interrupted; across the renewal of factors (20 steps) and of lists.
FIRST, SECOND, LAST = 13, 22, 31


class Wrong(Exception):
    """What a resumed run does differently."""


def run(skerry, *arguments, good=(0,)):
    """Run skerry with little output; returns exit code and messages."""
    done = subprocess.run([skerry, *arguments, "-q"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
    said = done.stdout.decode()
    if done.returncode not in good:
        raise Wrong("skerry %s: exit code %d: %s" % (" ".join(arguments), done.returncode, said))
    return done.returncode, said


def files(folder):
    """What must be the same: paths below the folder."""
    found = []
    for place in ("fields", "history"):
        found += [os.path.join(place, name) for name in os.listdir(os.path.join(folder, place))]
    return sorted(found + [name for name in os.listdir(folder) if name.endswith(".pvd")])


def figures(folder):
    """What summary.json says that is no matter of time or machine."""
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as stream:
        summary = json.load(stream)
    return {key: summary[key] for key in ("particles", "steps", "t", "iterations_mean", "files", "balances", "frames", "born",
                                          "removed", "put_back", "rebuilds") if key in summary}


def newest(folder):
    """Path of the newest checkpoint without its ending."""
    names = [name for name in os.listdir(os.path.join(folder, "checkpoint")) if name.endswith(".manifest")]
    return os.path.join(folder, "checkpoint", max(names)[:-len(".manifest")])


def differences(one, other):
    """Names of what differs between two output folders."""
    found = ["%s is there once" % name for name in set(files(one)) ^ set(files(other))]
    for name in sorted(set(files(one)) & set(files(other))):
        if not filecmp.cmp(os.path.join(one, name), os.path.join(other, name), shallow=False):
            found.append(name)
    if figures(one) != figures(other):
        found.append("summary.json")
    a, b = newest(one) + ".h5", newest(other) + ".h5"
    if os.path.basename(a) != os.path.basename(b):
        found.append("newest checkpoint")
    elif not filecmp.cmp(a, b, shallow=False):
        found.append(os.path.basename(a))
    return found


def compare(one, other):
    wrong = differences(one, other)
    if wrong:
        raise Wrong("%s differs from %s: %s" % (other, one, ", ".join(wrong[:8])))


def write(path, text):
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(text)


# ------------------------------------------------------------------------------------- further than the deck said

def test_further(skerry, folder):
    """A run that has come to its end goes on to a time, to a step, or to another end, with frames at other times."""
    (_, deck), = chosen(skerry, "beam2-.*-momentum-quad4-eas-shares-yes-fixed-point-constant-.*")
    path, whole, short = (os.path.join(folder, end) for end in ("deck.xml", "whole", "short"))
    deck = deck.replace('every="7.3*dt"', 'every="frames"').replace("</parameters>", '<parameter name="frames" value="7.3*dt"/></parameters>')
    write(path, deck)
    step = 0.25 * resume_decks.DX / 10
    run(skerry, "run", path, "-j", "1", "--steps", str(LAST), "-o", whole)
    run(skerry, "run", path, "-j", "1", "-o", short, "--set", "end=%d*dt" % FIRST)
    run(skerry, "resume", short, "-j", "1")
    if not newest(short).endswith("%09d" % FIRST):
        raise Wrong("a run at its end goes on without being told")
    for options in (["--until", "%.17g" % (LAST * step)], ["--steps", str(LAST)], ["--set", "end=%d*dt" % LAST]):
        there = os.path.join(folder, "there")
        shutil.copytree(short, there)
        run(skerry, "resume", there, "-j", "1", *options)
        compare(whole, there)
        shutil.rmtree(there)
    # other frames from here on: those so far stay, and the times are multiples of the new interval
    run(skerry, "resume", short, "-j", "1", "--set", "end=%d*dt" % LAST, "--set", "frames=3*dt")
    with open(os.path.join(short, "deck.pvd"), encoding="utf-8") as stream:
        times = sorted({round(float(t) / step) for t in re.findall(r'timestep="([^"]+)"', stream.read())})
    if times != [0, 8, 15, 18, 21, 24, 27, 30]:
        raise Wrong("frames at steps %s" % times)
    code, said = run(skerry, "resume", short, "--set", "dx=0.04", good=(64,))
    if "would change" not in said:
        raise Wrong("another spacing is refused without a reason: %s" % said)
    print("runs go further than their deck said", flush=True)
    return True


# -------------------------------------------------------------------------------------- 2 N steps = N + resume + N

def identity(skerry, folder, number, name, deck):
    """One combination: interrupted twice, with other numbers of threads in between."""
    here = os.path.join(folder, str(number))
    os.makedirs(here)
    path, whole, parts = (os.path.join(here, end) for end in ("deck.xml", "whole", "parts"))
    write(path, deck)
    code, said = run(skerry, "run", path, "-j", "1", "--steps", str(LAST), "-o", whole, good=(0, 65))
    if code == 65:
        shutil.rmtree(here)
        if "error: " not in said:
            raise Wrong("%s: refused without a reason: %s" % (name, said))
        return False
    threads = "121" if number % 2 else "212"
    # checkpoints on the way change nothing
    run(skerry, "run", path, "-j", threads[0], "--steps", str(FIRST), "-o", parts, "--checkpoint-every", "0")
    os.remove(path)
    run(skerry, "resume", parts, "-j", threads[1], "--steps", str(SECOND), "--checkpoint-every", "0.01")
    run(skerry, "resume", parts, "-j", threads[2], "--steps", str(LAST))
    compare(whole, parts)
    if number % 8 == 0:
        subprocess.run(["h5diff", newest(whole) + ".h5", newest(parts) + ".h5"], check=True)
    shutil.rmtree(here)
    return True


def test_identity(skerry, folder):
    decks = list(resume_decks.distinct(skerry, LONG))
    ran, refused, failed = 0, 0, 0
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        jobs = {pool.submit(identity, skerry, folder, number, name, deck): name
                for number, (name, deck) in enumerate(decks)}
        for job in concurrent.futures.as_completed(jobs):
            try:
                ran, refused = (ran + 1, refused) if job.result() else (ran, refused + 1)
            except (Wrong, OSError, subprocess.SubprocessError) as error:
                failed += 1
                print("FAIL: %s: %s" % (jobs[job], error), flush=True)
    print("%d combinations resumed exactly, %d were refused, %d failed" % (ran, refused, failed), flush=True)
    return failed == 0 and ran > 100 and refused > 0


# ----------------------------------------------------------------------------------- a checkpoint at every step

def chosen(skerry, *patterns):
    """The first deck whose name matches, for each pattern."""
    decks = dict(resume_decks.distinct(skerry, True))
    return [next((name, decks[name]) for name in decks if re.fullmatch(pattern, name)) for pattern in patterns]


def chain(skerry, folder, number, name, deck):
    """A checkpoint at each of the steps 0 to 20, each resumed to the end; and one run of 21 processes."""
    here = os.path.join(folder, "chain%d" % number)
    os.makedirs(here)
    path, whole, linked = (os.path.join(here, end) for end in ("deck.xml", "whole", "linked"))
    write(path, deck)
    run(skerry, "run", path, "-j", "1", "--steps", "24", "-o", whole)
    run(skerry, "run", path, "-j", "1", "--steps", "0", "-o", linked)
    for step in range(21):
        run(skerry, "resume", linked, "-j", str(1 + step % 2), "--steps", str(step))
        single = os.path.join(here, "single")
        shutil.copytree(linked, single)
        run(skerry, "resume", single, "-j", "1", "--steps", "24")
        compare(whole, single)
        shutil.rmtree(single)
    run(skerry, "resume", linked, "-j", "1", "--steps", "24")
    compare(whole, linked)
    shutil.rmtree(here)


def test_chain(skerry, folder):
    decks = chosen(skerry, "beam2-.*-characteristic-quad4-eas-shares-yes-fixed-point-iqn-ils-.*",
                   "beam2-.*-characteristic-quad4-eas-shares-yes-sub-cycled-added-mass-.*",
                   "beam2-fixed-particles-fixed-particles-characteristic-quad9-.*",
                   "moving2-fixed-particles-edged-translation-.*", "driven2-fixed-particles-.*")
    if LONG:
        decks += chosen(skerry, "beam3-.*-momentum-hex8-f-bar-shares-.*", "moving3-sliding-particles-edged-rotation-.*",
                        "burst-.*", "alone3-.*")
    good = True
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for (name, _), job in [(deck, pool.submit(chain, skerry, folder, number, *deck)) for number, deck in enumerate(decks)]:
            try:
                job.result()
                print("%s: a checkpoint at each of the steps 0 to 20 resumes exactly" % name, flush=True)
            except (Wrong, OSError, subprocess.SubprocessError) as error:
                good = False
                print("FAIL: %s: %s" % (name, error), flush=True)
    return good


# --------------------------------------------------------------------------------- no field of the state is idle

def datasets(path):
    """{name: (address, type, size in bytes)} of the data in an HDF5 file."""
    listing = subprocess.run(["h5ls", "-r", "-v", "-a", path], check=True, stdout=subprocess.PIPE).stdout.decode()
    found = {}
    for block in re.split(r"\n(?=/)", listing):
        name = re.match(r"(/\S+)\s+Dataset", block)
        if name:
            size, kind, place = (re.search(pattern, block).group(1) for pattern in (
                r"Storage:\s+(\d+) logical", r"Type:\s+(.*)", r"Address:\s+(\d+)"))
            found[name.group(1)] = int(place), kind, int(size)
    return found


def hash_of(data):
    """FNV-1a, 64 bits."""
    value = 0xcbf29ce484222325
    for byte in data:
        value = ((value ^ byte) * 0x100000001b3) & 0xffffffffffffffff
    return "fnv1a64:%016x" % value


def manifest_mend(base):
    """Make the manifest fit the changed data file."""
    with open(base + ".h5", "rb") as stream:
        data = stream.read()
    with open(base + ".manifest", encoding="utf-8") as stream:
        lines = stream.read().splitlines()
    lines = ["hash " + hash_of(data) if line.startswith("hash ") else line for line in lines[:-1]]
    text = "\n".join(lines) + "\n"
    write(base + ".manifest", text + "end %s\n" % hash_of(text.encode()))


def altered(kind, data):
    """The values of a dataset, all of them changed."""
    if "double" in kind:
        values = struct.unpack("<%dd" % (len(data) // 8), data)
        # not a rigid motion, which some laws would not notice
        return struct.pack("<%dd" % len(values), *[v + 0.01 * (abs(v) + 1.0) * (1 + i % 5) for i, v in enumerate(values)])
    if "unsigned char" in kind or "8-bit" in kind:
        return bytes(v ^ 1 for v in data)
    values = struct.unpack("<%dq" % (len(data) // 8), data)
    return struct.pack("<%dq" % len(values), *[v + 3 for v in values])


def perturb(skerry, before, base, name, place, kind, size):
    """Change one dataset of the newest checkpoint of the run in @p before and go on; returns what is different from the
    run @p base, or how it ended."""
    there = "%s-%s" % (before, name.strip("/").replace("/", "-"))
    shutil.copytree(before, there)
    data = newest(there) + ".h5"
    with open(data, "r+b") as stream:
        stream.seek(place)
        value = stream.read(size)
        stream.seek(place)
        stream.write(altered(kind, value))
    manifest_mend(newest(there))
    code, _ = run(skerry, "resume", there, "-j", "1", "--steps", str(LAST), good=(0, 70, 74))
    result = differences(base, there) if code == 0 else ["exit code %d" % code]
    shutil.rmtree(there)
    return code, result


def perturb_all(skerry, folder, number, name, deck):
    """{dataset: whether the resumed run differs}."""
    here = os.path.join(folder, "perturb%d" % number)
    os.makedirs(here)
    path, before, base = (os.path.join(here, end) for end in ("deck.xml", "before", "base"))
    write(path, deck)
    run(skerry, "run", path, "-j", "1", "--steps", str(FIRST), "-o", before)
    shutil.copytree(before, base)
    run(skerry, "resume", base, "-j", "1", "--steps", str(LAST))
    results = {}
    for dataset, (place, kind, size) in sorted(datasets(newest(before) + ".h5").items()):
        if size == 0:
            continue
        code, changed = perturb(skerry, before, base, dataset, place, kind, size)
        # a value that nothing reads stays as it is: alone in the last checkpoint it is no effect
        results[dataset] = bool(changed) and changed != [os.path.basename(newest(base)) + ".h5"]
        # a state that contradicts itself is refused (the order of the particles, by the places of the last rebuild)
        results[dataset] |= code == 74
    shutil.rmtree(here)
    return results


def test_perturb(skerry, folder):
    decks = chosen(skerry, "beam2-.*-characteristic-quad4-eas-shares-yes-fixed-point-added-mass-.*",
                   "beam2-.*-characteristic-quad4-eas-shares-yes-fixed-point-iqn-ils-.*",
                   "beam2-.*-characteristic-quad4-eas-shares-yes-sub-cycled-added-mass-.*",
                   "beam2-fixed-particles-fixed-particles-characteristic-quad9-.*", "driven2-fixed-particles-.*",
                   "moving2-sliding-particles-round-rotation-.*", "moving2-fixed-particles-edged-translation-.*",
                   "raft-.*", "burst-.*", "alone2-quad4-full-saint-venant-kirchhoff-moving",
                   "floating2-.*-fixed-point-added-mass-.*-False-.*", "floating3-.*-fixed-point-added-mass-.*-False-.*")
    acts = {}
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        jobs = [pool.submit(perturb_all, skerry, folder, number, *deck) for number, deck in enumerate(decks)]
        for (name, _), job in zip(decks, jobs):
            try:
                results = job.result()
            except (Wrong, OSError, subprocess.SubprocessError) as error:
                print("FAIL: %s: %s" % (name, error), flush=True)
                return False
            print("%s: %d of %d datasets act" % (name, sum(results.values()), len(results)), flush=True)
            for dataset, changed in results.items():
                # the same field of another wall, surface or solid
                field = re.sub(r"^/(surface|wall|solid|opening)-[a-z-]+", r"/\1", dataset)
                acts[field] = acts.get(field, False) or changed
    idle = sorted(field for field, changed in acts.items() if not changed)
    for field in idle:
        print("FAIL: %s takes part in no run that was tried" % field)
    print("%d fields, %d idle" % (len(acts), len(idle)), flush=True)
    return not idle and len(acts) > 30


# ------------------------------------------------------------------- the benchmarks go on where they were stopped

def test_validate(skerry, folder):
    """A run of the benchmarks that is stopped, killed, and of another program, then finished."""
    tools = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools")
    loader = importlib.machinery.SourceFileLoader("skerry_validate", os.path.join(tools, "skerry-validate"))
    validate = importlib.util.module_from_spec(importlib.util.spec_from_loader("skerry_validate", loader))
    loader.exec_module(validate)
    # runs end at once the first time
    stopper = os.path.join(folder, "stopper")
    write(stopper, '#!/bin/sh\ncase $1 in run) set -- "$@" --max-wall 0 ;; esac\nexec "%s" "$@"\n' % skerry)
    os.chmod(stopper, 0o755)
    args = argparse.Namespace(work=os.path.join(folder, "work"), skerry=stopper, fresh=False, threads=1,
                              dx=None)

    def told(output):
        with open(os.path.join(output, "log.txt"), encoding="utf-8") as stream:
            return stream.read()

    run_of = validate.Run("exact-pressurewave-1d")
    try:
        run_of.make(args)
        print("FAIL: a benchmark that was stopped counts as finished")
        return False
    except validate.Interrupted:
        pass
    args.skerry = skerry
    first = validate.Run("exact-pressurewave-1d").make(args)
    if "resumed from step 0" not in told(first.output):
        print("FAIL: the stopped benchmark was not resumed: %s" % told(first.output))
        return False
    # what another program began is not gone on with
    manifest = newest(first.output)
    os.remove(os.path.join(args.work, first.name, "finished.json"))
    with open(manifest + ".manifest", encoding="utf-8") as stream:
        text = stream.read()
    write(manifest + ".manifest", re.sub("revision .*", "revision other", text))
    second = validate.Run("exact-pressurewave-1d").make(args)
    if "resumed" in told(second.output):
        print("FAIL: a benchmark of another program was resumed")
        return False
    print("benchmarks go on where they were stopped", flush=True)
    return True


def main():
    skerry = os.path.abspath(sys.argv[1])
    tests = {"further": test_further, "identity": test_identity, "chain": test_chain, "perturb": test_perturb, "validate": test_validate}
    memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    good = True
    with tempfile.TemporaryDirectory(dir=memory) as folder:
        for name in sys.argv[2:] or tests:
            here = os.path.join(folder, name)
            os.mkdir(here)
            try:
                good &= tests[name](skerry, here)
            except (Wrong, OSError, subprocess.SubprocessError) as error:
                good = False
                print("FAIL: %s: %s" % (name, error), flush=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
