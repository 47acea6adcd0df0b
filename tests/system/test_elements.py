# SPDX-License-Identifier: GPL-3.0-or-later
"""A block of every kind of element and of every law between sliding walls: the momentum of the fluid and the impulse on
the walls add up to that of the body force, and the work on the solid to its energy. Usage: test_elements.py SKERRY"""

import json
import os
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import resume_decks  # noqa: E402

STEPS, DT = 3, 0.25 * resume_decks.DX / 10
FORCE = {"x": 3.0, "y": -1.0}


def balances(skerry, deck, steps, folder):
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([skerry, "run", deck, "--steps", str(steps), "-q", "-o", folder], check=True)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as stream:
        return {name: entry["value"] for name, entry in json.load(stream)["balances"].items()}


def check(skerry, folder, dim, element, formulation, law):
    """Returns what is wrong."""
    part = {"formulation": "transport-velocity", "arithmetic": "double", "wall": "sliding-particles",
            "wet": "sliding-particles", "ends": "periodic", "element": element, "solid": formulation, "law": law,
            "corners": "shares", "gradient": "yes", "scheme": "fixed-point", "acceleration": "added-mass"}
    deck = os.path.join(folder, "deck.xml")
    with open(deck, "w", encoding="utf-8") as stream:
        stream.write(resume_decks.channel(dim, part))
    one, last = (balances(skerry, deck, steps, os.path.join(folder, "out")) for steps in (1, STEPS))
    wrong = []
    for axis, force in FORCE.items():
        gain = sum(last[name % axis] - one[name % axis] for name in ("fluid momentum %s", "impulse on walls %s"))
        given = last["fluid mass"] * force * (STEPS - 1) * DT
        if abs(gain / given - 1) > 1e-10:
            wrong.append("momentum %s: %.17g instead of %.17g" % (axis, gain, given))
    energy = last["solid kinetic energy"] + last["elastic energy"]
    if not 0.95 < energy / last["work on solids"] < 1.001:  # the time integration damps
        wrong.append("energy %g from work %g" % (energy, last["work on solids"]))
    return wrong


def main():
    skerry = sys.argv[1]
    known = resume_decks.choices(skerry)
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for element in known["grid"]["type"]:
            dim = 2 if element.startswith(("tri", "quad")) else 3
            for law in known["solid-material"]["law"]:
                for formulation in ("full", "f-bar", "eas") if element in ("quad4", "hex8") else ("full",):
                    wrong = check(skerry, folder, dim, element, formulation, law)
                    failed += bool(wrong)
                    print(element, formulation, law, ": ".join(["FAIL"] + wrong) if wrong else "ok")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
