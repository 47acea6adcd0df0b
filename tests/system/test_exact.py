# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the exact decks and compare particles with the table beside each deck, every value to 1e-12."""

import csv
import os
import subprocess
import sys
import tempfile

SRCDIR = os.environ.get("srcdir", ".")
SKERRY = os.environ.get("SKERRY", "./skerry")
TOLERANCE = 1e-12

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(SRCDIR, "tools"))

import skerry_vtu  # noqa: E402

COLUMNS = {"x": ("Points", 0), "y": ("Points", 1), "z": ("Points", 2), "vx": ("Velocity", 0), "rho": ("Density", 0)}


def run(folder, deck, *options):
    """The frames of a run: [(time, Grid)]."""
    output = os.path.join(folder, "%s-%d" % (deck, len(os.listdir(folder))))
    command = [SKERRY, "run", os.path.join(SRCDIR, "decks", deck, deck + ".xml"), "-o", output, "-q", "-j", "1"]
    subprocess.run(command + list(options), check=True)
    return [(time, skerry_vtu.read(path)) for time, path in skerry_vtu.series(output, "fluid")]


def worst_difference(frames, table):
    """Compare all rows whose time is among the frames: (rows compared, largest difference)."""
    compared, worst = 0, 0.0
    with open(table, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    for row in rows:
        for time, grid in frames:
            if abs(time - float(row["t"])) > 1e-9:
                continue
            index = list(grid.column("Id")).index(int(row["id"]))
            for name, where in COLUMNS.items():
                if row.get(name):
                    difference = abs(grid.column(*where)[index] - float(row[name]))
                    worst = max(worst, difference)
                    print("  t = %-10s id %-4s %-3s %.17g, expected %s" % (row["t"], row["id"], name,
                                                                       grid.column(*where)[index], row[name]))
            compared += 1
    return compared, worst


def check(deck, frames, expected_rows):
    table = os.path.join(SRCDIR, "decks", deck, deck.replace("-", "_") + ".csv")
    compared, worst = worst_difference(frames, table)
    good = compared == expected_rows and worst <= TOLERANCE
    print("%s: %s: %d rows of %d compared, largest difference %.2e (at most %.0e)"
          % ("pass" if good else "FAIL", deck, compared, expected_rows, worst, TOLERANCE))
    return good


def main():
    with tempfile.TemporaryDirectory() as folder:
        line = check("exact-pressurewave-1d", run(folder, "exact-pressurewave-1d"), 2)
        first = run(folder, "exact-hydrostatic-3d", "--set", "frames=0.0003125", "--steps", "1")
        start = max(abs(rho - 1.002765419159314) for rho in first[0][1].column("Density"))
        print("exact-hydrostatic-3d: density at t = 0 differs by at most %.2e" % start)
        plates = check("exact-hydrostatic-3d", first + run(folder, "exact-hydrostatic-3d"), 4)
    return 0 if line and plates and start <= TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
