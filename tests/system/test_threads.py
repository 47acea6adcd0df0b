# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames, histories, figures and checkpoints are the same bytes whatever the number of threads.
Usage: test_threads.py SKERRY"""

import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import test_resume  # noqa: E402

TOOLS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools")
THREADS = (2, 3, 7)  # each is compared with one
STEPS = 30
ARITHMETICS = ("mixed", "double")

# More particles than fit into one piece of work of seven threads, in the benchmarks' own decks.
GENERATED = {
    "fsi2": ("turek-hron-fsi2", "--dx", "0.41/50", "--frames", "0.002"),
    "fsi2-fixed": ("turek-hron-fsi2", "--dx", "0.41/50", "--wall", "fixed-particles", "--frames", "0.002"),
    "channel-fixed": ("channel", "--dx", "0.01", "--wall", "fixed-particles", "--frames", "0.002"),
    "channel-sliding": ("channel", "--dx", "0.01", "--wall", "sliding-particles", "--frames", "0.002"),
    "box-3d": ("box-3d", "--cells", "18", "17", "16", "--frames", "0.001"),
}
# Small ones: openings, moving bodies and elastic ones in a flow that is there at once; all kinds of histories.
SMALL = ("channel3-sliding-particles-momentum-.*", "channel3-fixed-particles-characteristic-.*",
         "moving3-sliding-particles-edged-rotation-.*", "moving2-fixed-particles-edged-translation-.*",
         "beam2-.*-characteristic-quad4-eas-shares-yes-fixed-point-aitken-.*",
         "beam3-.*-periodic-hex8-f-bar-shares-yes-fixed-point-added-mass-.*",
         "beam3-fixed-particles-fixed-particles-characteristic-hex27-.*", "driven3-fixed-particles-.*")


def decks(skerry):
    """{name: text}, each in both arithmetics."""
    found = dict(test_resume.chosen(skerry, *SMALL))
    for name, options in GENERATED.items():
        found[name] = subprocess.run([sys.executable, os.path.join(TOOLS, "skerry-deckgen"), *options], check=True,
                                     stdout=subprocess.PIPE).stdout.decode()
    result = {}
    for name, text in found.items():
        plain = re.sub(' arithmetic="[a-z]*"', "", text)
        for arithmetic in ARITHMETICS:
            result["%s, %s" % (name, arithmetic)] = plain.replace("<fluid formulation", '<fluid arithmetic="%s" formulation'
                                                                  % arithmetic)
    return result


def threads_compare(skerry, folder, text):
    """Run a deck with each number of threads; complain about what differs."""
    os.makedirs(folder)
    path = os.path.join(folder, "deck.xml")
    test_resume.write(path, text)
    for threads in (1,) + THREADS:
        output = os.path.join(folder, str(threads))
        test_resume.run(skerry, "run", path, "-j", str(threads), "--steps", str(STEPS), "-o", output)
        test_resume.compare(os.path.join(folder, "1"), output)
    frames = [name for name in test_resume.files(folder + "/1") if name.startswith("fields" + os.sep + "fluid")]
    if len(frames) < 3:
        raise test_resume.Wrong("%d frames: too few to tell" % len(frames))


def main():
    skerry = os.path.abspath(sys.argv[1])
    memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    good = True
    with tempfile.TemporaryDirectory(dir=memory) as folder, \
            concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        jobs = {name: pool.submit(threads_compare, skerry, os.path.join(folder, str(number)), text)
                for number, (name, text) in enumerate(decks(skerry).items())}
        for name, job in jobs.items():
            try:
                job.result()
                print("%s: the same bytes with 1, %s threads" % (name, ", ".join(map(str, THREADS))), flush=True)
            except (test_resume.Wrong, OSError, subprocess.SubprocessError) as error:
                good = False
                print("FAIL: %s: %s" % (name, error), flush=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
