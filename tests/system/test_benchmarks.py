# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper benchmarks on coarse lattices: figures stay where they are. What is asked of the papers' resolution is
checked by tools/skerry-validate.
Usage: test_benchmarks.py SKERRY [NAME...]"""

import concurrent.futures
import json
import math
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
TOOLS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools")
sys.path.insert(0, TOOLS)

import skerry_signal  # noqa: E402
import skerry_vtu  # noqa: E402


class Output:
    """What a run has written."""

    def __init__(self, folder):
        self.folder = folder
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as stream:
            self.summary = json.load(stream)

    def frame(self, number):
        return skerry_vtu.read(skerry_vtu.series(self.folder, "fluid")[number][1])

    def history(self, name):
        return skerry_vtu.history(os.path.join(self.folder, "history", name + ".csv"))


def rms(values):
    values = list(values)
    return math.sqrt(sum(value * value for value in values) / len(values))


def hydrostatic_plates(output):
    grid = output.frame(-1)
    errors = [(p - 0.1 * q) / 0.01 for q, p in zip(grid.column("Points", 1), grid.column("Pressure"))]
    return {"rms error of pressure": rms(errors), "largest error": max(map(abs, errors))}


def taylor_couette(output):
    grid, errors = output.frame(-1), []
    for x, y, u, v in zip(grid.column("Points", 0), grid.column("Points", 1), grid.column("Velocity", 0),
                          grid.column("Velocity", 1)):
        r = math.hypot(x, y)
        errors.append(((x * v - y * u) / r - 8 / 3 * (r - 1 / r)) / 4)
    return {"particles": len(errors), "rms error of u_theta": rms(errors)}


def cylinder_2d2(output):
    force, volume = output.history("force"), output.history("volume")
    times, drag, lift = skerry_signal.window(force["t"], 3.0, 5.0, force["F_x"], force["F_y"])
    drag, lift = (skerry_signal.butterworth(skerry_signal.resample(times, signal, 2000.0)[1], 2000.0, 10.0)
                  for signal in (drag, lift))
    return {"mean c_drag": 20 * sum(drag) / len(drag), "rms of c_lift": 20 * rms(lift),
            "largest density": max(volume["rho_max"][volume["t"].index(3.0):])}


def isochoric_box(output):
    grid = output.frame(-1)
    inside = [abs(rho - 1) for x, y, rho in zip(grid.column("Points", 0), grid.column("Points", 1),
                                                 grid.column("Density")) if abs(x) <= 0.1 and abs(y) <= 0.025]
    return {"outside": 400 - len(inside), "mean |rho/rho0 - 1|": sum(inside) / len(inside)}


def cylinder_shear_flow(output):
    """It is carried along and turned at half the shear rate of 2/s; from the middle of the upper half it goes down."""
    body = output.history("cylinder")
    return {"turned": body["rotation z"][-1], "carried": body["x"][-1] - 0.002, "risen": body["y"][-1] - 0.0075,
            "mean iterations": output.summary["iterations_mean"]}


def turek_hron_fsi2(output):
    tip, force = output.history("tip"), output.history("force")
    drag = skerry_signal.window(force["t"], 1.5, 2.0, force["F_x"])[1]
    return {"drag for 1.5 <= t <= 2": sum(drag) / len(drag), "largest |u_y|": max(map(abs, tip["y displacement"])),
            "mean iterations": output.summary["iterations_mean"]}


def balloon(output):
    """What flowed in is there, and little compressed."""
    everything, duct = output.history("all"), output.history("duct")
    rows = list(zip(everything["t"], everything["mass"], duct["mass"], everything["volume"], duct["volume"]))[-10:]
    true = [27 + 20 / 9 * (t / 2 - math.sin(math.pi * t) / (2 * math.pi)) for t, *_ in rows]
    return {"mass by the analytic": sum((m - d) / v for (_, m, d, _, _), v in zip(rows, true)) / len(rows),
            "volume by the analytic": sum((m - d) / v for (_, _, _, m, d), v in zip(rows, true)) / len(rows),
            "smallest density": min(everything["rho_min"]), "far side": output.history("far-side")["x displacement"][-1],
            "mean iterations": output.summary["iterations_mean"]}


# name: options of the generator, figures, {figure: least and largest value}
CASES = {
    "hydrostatic-plates": (["--dx", "0.01"], hydrostatic_plates,
                           {"rms error of pressure": (0, 0.012), "largest error": (0, 0.03)}),
    "taylor-couette": (["--dx", "0.1", "--facets", "48"], taylor_couette,
                       {"particles": (948, 948), "rms error of u_theta": (0, 0.014)}),
    "cylinder-2d2": (["--dx", "0.01", "--end", "5"], cylinder_2d2,
                     {"mean c_drag": (2.55, 2.9), "rms of c_lift": (0.2, 0.8), "largest density": (1, 1.1)}),
    "isochoric-box": ([], isochoric_box, {"outside": (0, 0), "mean |rho/rho0 - 1|": (0, 0.003)}),
    "isochoric-box of fixed particles": (["--wall", "fixed-particles"], isochoric_box,
                                         {"outside": (20, 60), "mean |rho/rho0 - 1|": (0.05, 0.1)}),
    "cylinder-shear-flow": (["--dx", "0.0005", "--start", "couette", "--end", "2"], cylinder_shear_flow,
                            {"turned": (-1.95, -1.65), "carried": (0.007, 0.011), "risen": (-0.0006, 0),
                             "mean iterations": (1, 3)}),
    "turek-hron-fsi2": (["--dx", "0.41/30", "--end", "2"], turek_hron_fsi2,
                        {"drag for 1.5 <= t <= 2": (0.1, 0.145), "largest |u_y|": (0.004, 0.02),
                         "mean iterations": (2, 4)}),
    "balloon": (["--dx", "0.2", "--end", "0.3"], balloon,
                {"mass by the analytic": (0.997, 1.003), "volume by the analytic": (0.997, 1.003),
                 "smallest density": (0.98, 1), "far side": (0, 0.002), "mean iterations": (1, 5)}),
}


def case_run(skerry, folder, name):
    """Run a case; lines that say how it went, and whether well."""
    options, figures, limits = CASES[name]
    deck = os.path.join(folder, name.replace(" ", "-") + ".xml")
    generator = os.path.join(TOOLS, "skerry-deckgen")
    subprocess.run([sys.executable, generator, name.split()[0], *options, "-o", deck], check=True)
    done = subprocess.run([skerry, "run", deck, "-q", "-j", "1", "-o", deck[:-4] + ".out"], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode:
        return ["FAIL: %s: exit code %d: %s" % (name, done.returncode, done.stderr)], False
    lines, good = [], True
    for figure, value in figures(Output(deck[:-4] + ".out")).items():
        low, high = limits[figure]
        within = low <= value <= high
        good = good and within
        lines.append("%s: %s: %s = %.6g, %g to %g" % ("ok" if within else "FAIL", name, figure, value, low, high))
    return lines, good


def main():
    skerry, names = sys.argv[1], sys.argv[2:] or list(CASES)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(lambda name: case_run(skerry, folder, name), names))
    for lines, _ in results:
        print("\n".join(lines))
    return 0 if all(good for _, good in results) else 1


if __name__ == "__main__":
    sys.exit(main())
