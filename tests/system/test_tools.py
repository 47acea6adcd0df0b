# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of what the tools share and of their figures."""

import array
import importlib.util
import math
import os
import struct
import sys
import tempfile
import unittest
import zlib

TOOLS = os.path.join(os.environ.get("srcdir", "."), "tools")


def load(path, name):
    """Import a file whatever it is called, without leaving compiled files behind."""
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader(name, os.path.join(TOOLS, path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


signal = load("skerry_signal.py", "skerry_signal")
vtu = load("skerry_vtu.py", "skerry_vtu")
validate = load("skerry-validate", "skerry_validate")
bench = load("skerry-bench", "skerry_bench")


class Signals(unittest.TestCase):
    times = [0.37 + i / 1000 for i in range(4001)]
    wave = [0.0012 + 0.0816 * math.sin(2 * math.pi * 1.93 * t + 0.3) for t in times]

    def test_frequency_and_extremes(self):
        marks = signal.crossings(self.times, self.wave, level=0.0012)
        self.assertEqual(len(marks), 8)
        self.assertAlmostEqual(signal.frequency(marks), 1.93, 6)
        low, high = signal.extremes(self.times, self.wave, marks)
        self.assertAlmostEqual(low, -0.0804, 5)
        self.assertAlmostEqual(high, 0.0828, 5)

    def test_both_directions(self):
        marks = signal.crossings([0, 1, 2, 3, 4], [-1, 3, -1, -3, 1], falling=True)
        for mark, expected in zip(marks, [0.25, 1.75, 3.75]):
            self.assertAlmostEqual(mark, expected)

    def test_too_short_for_a_period(self):
        self.assertTrue(math.isnan(signal.frequency([1.0])))
        self.assertTrue(math.isnan(signal.extremes([0, 1], [2, 3], [0.5])[0]))

    def test_filter_gain_without_phase(self):
        # forwards and backwards: gain 1/(1 + (f/f_c)^4), half at the cut-off
        for frequency in (1.93, 20.0, 60.0):
            wave = [math.sin(2 * math.pi * frequency * t) for t in self.times]
            prewarped = math.tan(math.pi * frequency / 1000) / math.tan(math.pi * 20 / 1000)
            gain = 1 / (1 + prewarped ** 4)
            filtered = signal.butterworth(wave, 1000.0, 20.0)
            self.assertEqual(len(filtered), len(wave))
            for i in range(400, 3600):
                self.assertAlmostEqual(filtered[i], gain * wave[i], 4)

    def test_filter_keeps_constants_and_lines(self):
        line = [3.7 - 0.01 * i for i in range(500)]
        for value, expected in zip(signal.butterworth(line, 1000.0, 20.0), line):
            self.assertAlmostEqual(value, expected, 3)
        self.assertAlmostEqual(max(signal.butterworth([2.5] * 300, 1000.0, 20.0)), 2.5, 12)

    def test_resample_and_window(self):
        times, values = signal.resample([0, 0.1, 0.35, 0.4], [0, 1, 6, 6], 10.0)
        self.assertEqual(len(times), 5)
        for value, expected in zip(values, [0, 1, 3, 5, 6]):
            self.assertAlmostEqual(value, expected)
        self.assertEqual(signal.window([1, 2, 3, 4], 2, 3, [5, 6, 7, 8]), [[2, 3], [6, 7]])


def block(data, size):
    """One array as appended data in blocks of size bytes."""
    parts = [data[i:i + size] for i in range(0, len(data), size)]
    streams = [zlib.compress(part) for part in parts]
    last = len(parts[-1]) % size if parts else 0
    return struct.pack("<%dQ" % (3 + len(parts)), len(parts), size if parts else 0, last,
                       *[len(stream) for stream in streams]) + b"".join(streams)


def write_grid(path):
    """Three particles; each array in several blocks."""
    points = block(struct.pack("<9f", *range(9)), 16)
    pressure = block(struct.pack("<3d", 1.5, -2.25, 1e300), 24)
    ids = block(struct.pack("<3q", 2, 0, 1), 8)
    head = (
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"'
        ' header_type="UInt64" compressor="vtkZLibDataCompressor">\n<UnstructuredGrid>\n<FieldData>'
        '<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">0.25</DataArray>'
        '<DataArray type="Int64" Name="Cycle" NumberOfTuples="1" format="ascii">7</DataArray></FieldData>\n'
        '<Piece NumberOfPoints="3" NumberOfCells="3">\n<PointData>'
        '<DataArray type="Float64" Name="Pressure" format="appended" offset="%d"/>'
        '<DataArray type="Int64" Name="Id" format="appended" offset="%d"/></PointData>\n'
        '<Points><DataArray type="Float32" Name="Points" NumberOfComponents="3" format="appended" offset="0"/>'
        "</Points>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_"
        % (len(points), len(points) + len(pressure)))
    with open(path, "wb") as stream:
        stream.write(head.encode() + points + pressure + ids + b"\n</AppendedData>\n</VTKFile>\n")


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def test_grid(self):
        write_grid(self.path("a.vtu"))
        grid = vtu.read(self.path("a.vtu"))
        self.assertEqual((grid.time, grid.cycle, grid.n_points), (0.25, 7, 3))
        self.assertEqual(list(grid.column("Points", 1)), [1, 4, 7])
        self.assertEqual(list(grid.column("Pressure")), [1.5, -2.25, 1e300])
        self.assertEqual(list(grid.column("Id")), [2, 0, 1])
        self.assertIsInstance(grid.points, array.array)

    def test_damage_is_noticed(self):
        write_grid(self.path("a.vtu"))
        with open(self.path("a.vtu"), "rb") as stream:
            data = stream.read()
        for broken in (data[:-60], data.replace(b"Float32", b"Float16"), data.replace(b'NumberOfPoints="3"',
                       b'NumberOfPoints="4"'), data.replace(b"UInt64", b"UInt32"), b"nothing"):
            with open(self.path("b.vtu"), "wb") as stream:
                stream.write(broken)
            with self.assertRaises(vtu.VtuError):
                vtu.read(self.path("b.vtu"))

    def test_history_without_the_row_being_written(self):
        with open(self.path("h.csv"), "w", encoding="utf-8") as stream:
            stream.write("t [s],ux [m]\n0,1e-3\n0.5,-2\n0.75")
        self.assertEqual(vtu.history(self.path("h.csv")), {"t": [0.0, 0.5], "ux": [1e-3, -2.0]})

    def test_series(self):
        with open(self.path("a.pvd"), "w", encoding="utf-8") as stream:
            stream.write('<VTKFile type="Collection"><Collection>'
                         '<DataSet timestep="0.5" part="0" name="fluid" file="fields/2.vtu"/>'
                         '<DataSet timestep="0" part="0" name="fluid" file="fields/1.vtu"/>'
                         '<DataSet timestep="0" part="1" name="wall" file="fields/w.vtu"/></Collection></VTKFile>')
        self.assertEqual(vtu.series(self.folder.name, "fluid"),
                         [(0.0, self.path("fields/1.vtu")), (0.5, self.path("fields/2.vtu"))])

    def test_table_keeps_the_rows_of_other_decks(self):
        run = validate.Run("taylor-couette")
        run.dx, run.summary = 0.05, {"particles": 3768, "steps": 6400, "wall_s": 5.25, "updates_per_s": 4.6e6}
        table = validate.Table()
        table.add("F2", run, "error", 0.6, upper=1.0, unit="%")
        table.add("F2", run, "other error", 1.6, upper=1.0, unit="%")
        table.add("F2", run, "no number", math.nan, lower=0.0)
        table.add("F2", run, "shown", 3.0)
        self.assertEqual([row[7] for row in table.rows], ["yes", "no", "no", "-"])
        path = self.path("validation.csv")
        other = ["F1", "hydrostatic-plates"] + ["1"] * 12
        validate.write_table(path, [other, ["F2", "taylor-couette"] + ["old"] * 12], {"x"})
        validate.write_table(path, table.rows, {"taylor-couette"})
        with open(path, encoding="utf-8") as stream:
            lines = stream.read().split("\n")
        self.assertEqual(lines[0], ",".join(validate.COLUMNS))
        self.assertEqual(lines[1], ",".join(other))
        self.assertEqual(lines[2], "F2,taylor-couette,error,0.6,,1,%,yes,0.05,3768,6400,5.2,4.6e+06,-")
        self.assertEqual(len(lines), 7)

    def test_table_with_a_spacing_of_its_own(self):
        path = self.path("validation.csv")
        old = ["F2", "taylor-couette", "error", "old"] + ["1"] * 4 + ["0.05"] + ["1"] * 5
        run = validate.Run("taylor-couette", "--facets", 48)
        run.options += ["--dx", "0.1"]
        run.dx = 0.1
        table = validate.Table(judges=False)
        table.add("F2", run, "error", 0.7, upper=0.5)
        self.assertEqual(table.rows[0][4:8], ["", "", "-", "-"])
        self.assertEqual(run.name, "taylor-couette-facets-48-dx-0.1")
        validate.write_table(path, [old], set())
        for _ in range(2):
            validate.write_table(path, table.rows, set())
        with open(path, encoding="utf-8") as stream:
            rows = [line.split(",") for line in stream.read().split()[1:]]
        self.assertEqual([(row[3], row[8]) for row in rows], [("old", "0.05"), ("0.7", "0.1")])

    def test_table_keeps_runs_of_the_papers_size(self):
        path = self.path("validation.csv")
        large, small = (["F6", "turek-hron-fsi2", "u_y", "old"] + ["1"] * 4 + [dx] + ["1"] * 5 for dx in ("0.002", "0.005"))
        new = {row[8]: row[:3] + ["new"] + row[4:] for row in (large, small)}
        for made, values in ((["0.005"], ["old", "new"]), (["0.005", "0.002"], ["new", "new"])):
            validate.write_table(path, [large, small], {"turek-hron-fsi2"})
            validate.write_table(path, [new[dx] for dx in made], {"turek-hron-fsi2"})
            with open(path, encoding="utf-8") as stream:
                rows = [line.split(",") for line in stream.read().split()[1:]]
            self.assertEqual([row[3] for row in sorted(rows, key=lambda row: row[8])], values)


class Figures(unittest.TestCase):
    def test_repeats_have_smaller_steps(self):
        deck = b'<time end="end" step="min(0.25*dx/c,1)"/><fluid step="2"/>'
        run = validate.Run("taylor-couette", "--facets", 48, repeat=3)
        self.assertEqual(run.name, "taylor-couette-facets-48-repeat-3")
        self.assertEqual(run._repeated(deck), b'<time end="end" step="0.991*min(0.25*dx/c,1)"/><fluid step="2"/>')
        self.assertEqual(validate.Run("taylor-couette")._repeated(deck), deck)
        with self.assertRaisesRegex(validate.Failed, "repeat-3: cannot be repeated, its deck has no step"):
            run._repeated(b'<time end="end"/>')

    def test_asymmetry_of_a_ring(self):
        rows = [(1.21, 1.0, 0.5), (1.22, 3.0, -0.5), (1.31, 7.0, 0.0)]
        scatter, radial = validate.couette_asymmetry(rows, 0.05)
        self.assertAlmostEqual(scatter, math.sqrt(2 / 3))
        self.assertAlmostEqual(radial, math.sqrt(0.5 / 3))

    def test_targets_of_the_bench(self):
        self.assertEqual(bench.target_of("box-2d", {}), 12e6)
        self.assertIsNone(bench.target_of("channel-fixed", {}))
        self.assertAlmostEqual(bench.target_of("channel-fixed", {"box-2d": 10e6}), 8.5e6)
        self.assertAlmostEqual(bench.target_of("fsi2-coupled", {"fsi2-rigid": 10e6}), 8e6)

    def test_cost_of_coupling(self):
        rows = [{"name": name, "threads": threads, "updates_per_s": rate, "iterations_mean": 2.0}
                for name, threads, rate in (("fsi2-rigid", 2, 9e6), ("fsi2-coupled", 2, 7.5e6), ("balloon-rigid", 2, 2.1e6),
                                            ("fsi2-rigid", 1, 5e6), ("fsi2-coupled", 1, 2e6))]
        self.assertEqual(bench.ratios(rows), {"fsi2": 1.2})
        rows.append({"name": "balloon-coupled", "threads": 2, "updates_per_s": 0.7e6})
        self.assertAlmostEqual(bench.ratios(rows)["balloon"], 3.0)

    def test_cost_of_a_frame(self):
        rows = [{"name": "fsi2-rigid", "threads": 2, "steps": 300, "wall_s": 6.0, "phases_s": {"output": 0.1}},
                {"name": "fsi2-output", "threads": 2, "steps": 300, "wall_s": 6.5, "phases_s": {"output": 0.5}}]
        self.assertAlmostEqual(bench.frame_cost(rows, 2), 5.0)
        self.assertIsNone(bench.frame_cost(rows, 1))


PROGRAM = """#!/usr/bin/env python3
import json, os, sys
if sys.argv[1] == "--version":
    print("skerry 0\\n%s")
elif sys.argv[1] != "run":
    print(json.dumps({"name": sys.argv[1], "dim": 2, "particles": 1000, "threads": int(sys.argv[3]),
                      "updates_per_s": 5e7, "neighbours": 20}))
else:
    words = [word for word in sys.argv[3:] if word not in ("--force", "-q")]
    option = dict(zip(words[0::2], words[1::2]))
    os.makedirs(option["-o"])
    steps, n = int(option["--steps"]), 1000
    wall = 0.5 + steps * n / %g
    phases = {"output": 0.5, "fluid": 0.75 * (wall - 0.5), "walls": 0.25 * (wall - 0.5)}
    with open(os.path.join(option["-o"], "summary.json"), "w") as stream:
        json.dump({"dim": 2, "particles": n, "steps": steps, "wall_s": wall, "updates_per_s": steps * n / wall,
                   "phases_s": phases, "iterations_mean": 0.0}, stream)
"""


class Runs(unittest.TestCase):
    """The bench, with programs whose speed is known."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.bench = bench.Bench(self.folder.name)

    def program(self, name, rate, said="optimised       yes"):
        path = os.path.join(self.folder.name, name)
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(PROGRAM % (said, rate))
        os.chmod(path, 0o755)
        return path

    def test_rate_is_that_of_the_steps(self):
        row = self.bench.row(self.program("a", 8e6), "box-2d", 2)
        self.assertAlmostEqual(row["updates_per_s"] / 8e6, 1.0, 9)
        self.assertAlmostEqual(row["phases_s"]["walls"] / row["wall_s"], 0.25)
        self.assertAlmostEqual(row["phases_s"]["output"], 0.0)
        self.assertAlmostEqual(row["ns_per_pair"], 1e9 / 8e6 / 27)
        rates = {}
        bench.row_judge(row, rates)
        self.assertAlmostEqual(row["ratio"], 8 / 12)
        self.assertLessEqual(len(bench.line_of(row)), 120)
        self.assertLessEqual(len(bench.HEADING), 120)
        row["threads"] = 1
        bench.row_judge(row, rates)
        self.assertIsNone(row["ratio"])

    def test_passes(self):
        row = self.bench.pass_row(self.program("a", 8e6), "delta-2d", 2)
        bench.row_judge(row, {})
        self.assertAlmostEqual(row["ratio"], 2.0)
        self.assertAlmostEqual(row["ns_per_pair"], 1.0)
        self.assertLessEqual(len(bench.line_of(row)), 120)

    def test_comparison(self):
        new, old = self.program("a", 12e6), self.program("b", 10e6)
        quotients, best, other = bench.compare_run(self.bench, new, old, "box-2d", 1, 2)
        self.assertEqual(len(quotients), 2)
        for quotient in quotients:
            self.assertAlmostEqual(quotient, 1.2)
        self.assertAlmostEqual(best / other, 1.2)

    def test_what_means_nothing_is_refused(self):
        bench.program_check(self.program("a", 1e6))
        for said in ("optimised       no", "optimised       yes\\nsanitizers      yes"):
            with self.assertRaises(bench.Wrong):
                bench.program_check(self.program("b", 1e6, said))
        for flags, good in (("-O3 -ffast-math", True), ("-O0 -g", False), ("-O3 -O1", False)):
            with open(os.path.join(self.folder.name, "config.status"), "w", encoding="utf-8") as stream:
                stream.write('S["OPTIMIZE_CFLAGS"]="-O3"\nS["CFLAGS"]="-g"\nS["SWEEP_CFLAGS"]="%s"\n' % flags)
            if good:
                self.assertEqual(bench.flags_check(self.program("c", 1e6)), ("-O3 -g", flags))
            else:
                with self.assertRaises(bench.Wrong):
                    bench.flags_check(self.program("c", 1e6))
        failing = self.program("d", 1e6)
        with open(failing, "w", encoding="utf-8") as stream:
            stream.write("#!/bin/sh\nexit 70\n")
        with self.assertRaises(bench.Wrong):
            self.bench.row(failing, "box-2d", 1)


if __name__ == "__main__":
    unittest.main()
