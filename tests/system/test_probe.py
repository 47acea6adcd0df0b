# SPDX-License-Identifier: GPL-3.0-or-later
"""skerry probe in 1-D, 2-D and 3-D: sums over all particles and images, histories of the run, grids, frames, refusals.
Usage: test_probe.py SKERRY"""

import csv
import itertools
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools"))

import skerry_vtu  # noqa: E402

SKERRY = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else "./skerry"

DECK = """<deck version="1" dim="%(dim)d">
  <parameters><parameter name="dx" value="1"/></parameters>
  <time end="1" step="2e-4"/>
  <domain lower="%(lower)s" upper="%(upper)s" periodic="%(periodic)s"/>
  <materials><fluid name="oil" density="1.3" kinematic-viscosity="0.01" sound-speed="10" background-pressure="130"/></materials>
  <fluid material="oil" spacing="dx" smoothing-length-ratio="%(ratio)s"%(more)s>
    <region velocity="%(velocity)s"><box lower="%(box_lower)s" upper="%(box_upper)s"/></region>
  </fluid>
  <output>
    <fields every="1e-3" precision="%(precision)s"/>
    <history name="profile" type="profile" from="%(from)s" to="%(to)s" points="23" every="1e-3"/>
  </output>
</deck>
"""

# In 2-D and 3-D part of the domain is empty. The spacing is given by --set: the deck alone would be another run.
CASES = {
    1: dict(dim=1, lower="-0.31", upper="1.29", periodic="x", ratio="1.05", velocity="0.4*sin(3.92699*x)",
            box_lower="-0.31", box_upper="1.29", more="", precision="float64", **{"from": "-0.5", "to": "1.9"}),
    2: dict(dim=2, lower="-0.2 0.1", upper="0.6 1.3", periodic="x", ratio="1", velocity="0.5*cos(7.854*x) 0.2*y",
            box_lower="-0.2 0.3", box_upper="0.6 0.9", more="", precision="float64",
            **{"from": "-0.31 0.2", "to": "0.77 1.1"}),
    3: dict(dim=3, lower="0 0.2 -0.3", upper="0.4 0.68 0.5", periodic="x y", ratio="1",
            velocity="0.5*sin(13.09*y) 0.3*sin(15.708*x) -0.4*z", box_lower="0 0.2 -0.2", box_upper="0.4 0.68 0.12",
            more=' kernel-constant="published"', precision="float64", **{"from": "0.01 0.1 -0.25", "to": "0.5 0.9 0.4"}),
}
SPACING = {1: 0.02, 2: 0.02, 3: 0.04}
BOUNDS = {1: ([-0.31], [1.29], [True]), 2: ([-0.2, 0.1], [0.6, 1.3], [True, False]),
          3: ([0.0, 0.2, -0.3], [0.4, 0.68, 0.5], [True, True, False])}
# Awkward places: inside, near periodic sides, on one, beyond one, where there is nothing.
PLACES = {
    1: [(0.123456,), (-0.3099,), (1.2899,), (1.29,), (3.3,), (-17.2345,)],
    2: [(0.3333, 0.5771), (-0.1999, 0.61), (0.5999, 0.6100001), (0.6, 0.35), (1.41, 0.77), (0.1, 0.2999), (0.2, 1.2),
        (-41.7, 0.4444)],
    3: [(0.1234, 0.3456, -0.0789), (0.0001, 0.2002, 0.05), (0.3999, 0.6799, 0.05), (0.4, 0.68, 0.1), (-0.11, 0.9, -0.2),
        (0.2, 0.3, 0.18), (0.2, 0.3, 0.45)],
}

CHANNEL = """<deck version="1" dim="2">
  <time end="1" step="5e-4"/>
  <domain lower="-0.2 0" upper="1.2 0.4" periodic="y"/>
  <materials><fluid name="oil" density="1.2" kinematic-viscosity="0.1" sound-speed="10" background-pressure="120"/></materials>
  <fluid material="oil" spacing="0.025">
    <region velocity="1 0"><box lower="0 0" upper="1 0.4"/></region>
  </fluid>
  <boundaries>
    <inflow name="in" axis="x" at="0" into="+" lower="0 0" upper="0 0.4" velocity="1 0"/>
    <outflow name="out" axis="x" at="1" into="-" lower="1 0" upper="1 0.4" pressure="0"/>
  </boundaries>
  <output>
    <fields every="0.01" precision="float64"/>
    <history name="profile" type="profile" from="-0.1 0.2" to="1.1 0.2" points="61" every="0.01"/>
  </output>
</deck>
"""

SOLID = """<deck version="1" dim="2">
  <time end="1" step="1e-3"/>
  <domain lower="-1 -1" upper="2 2"/>
  <materials><solid name="rubber" density="1100" young="2 MPa" poisson="0.3"/></materials>
  <meshes><mesh name="block" material="rubber"><grid lower="0 0" upper="1 1" cells="2 2"/></mesh></meshes>
  <output><fields every="1"/></output>
</deck>
"""


def run(*arguments, code=0):
    """Run skerry; what it prints on standard output and error."""
    done = subprocess.run([SKERRY, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120)
    out, said = done.stdout.decode(), done.stderr.decode()
    if done.returncode != code:
        raise AssertionError("skerry %s: exit code %d instead of %d: %s" % (" ".join(map(str, arguments)), done.returncode,
                                                                           code, said))
    return out, said


def write(path, text):
    with open(path, "w", encoding="utf-8", newline="") as stream:
        stream.write(text)
    return path


def rows(text):
    """A table as a list of {column: number or None}."""
    return [{name: float(value) if value else None for name, value in row.items()} for row in csv.DictReader(text.splitlines())]


def spline(dim, h, r, published):
    norm = {1: 1 / (120 * h), 2: 7 / (478 * math.pi * h ** 2),
            3: (3 / 359 if published else 1 / 120) / (math.pi * h ** 3)}[dim]
    q = r / h
    return norm * (max(3 - q, 0) ** 5 - 6 * max(2 - q, 0) ** 5 + 15 * max(1 - q, 0) ** 5)


def sums(grid, dim, h, place, published=False, among=None):
    """Pressure, velocity, density and support by eq. 14, over all particles and the nearest images."""
    lower, upper, periodic = BOUNDS[dim]
    place = list(place)
    for k in range(dim):
        if periodic[k]:
            place[k] = lower[k] + (place[k] - lower[k]) % (upper[k] - lower[k])
    shifts = list(itertools.product(*[(-1, 0, 1) if periodic[k] else (0,) for k in range(dim)]))
    columns = [grid.column("Pressure")] + [grid.column("Velocity", c) for c in range(3)] + [grid.column("Density")]
    total, support = [0.0] * 5, 0.0
    for i in range(grid.n_points):
        if among is not None and not among[i]:
            continue
        for shift in shifts:
            r = math.sqrt(sum((place[k] - grid.points[3 * i + k] - shift[k] * (upper[k] - lower[k])) ** 2 for k in range(dim)))
            if r < 3 * h:
                weight = grid.column("Mass")[i] / grid.column("Density")[i] * spline(dim, h, r, published)
                support += weight
                for c in range(5):
                    total[c] += weight * columns[c][i]
    return [value / support if support > 0 else None for value in total] + [support]


NAMES = ["Pressure [Pa]", "Velocity_x [m/s]", "Velocity_y [m/s]", "Velocity_z [m/s]", "Density [kg/m^3]", "Support [-]"]


class Runs(unittest.TestCase):
    """Tests on runs that are made once."""

    folder = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        for dim, case in CASES.items():
            for precision in ("float64", "float32"):
                path = write(cls.path("%dd-%s.xml" % (dim, precision)), DECK % dict(case, precision=precision))
                run("run", path, "-o", cls.path("%dd-%s" % (dim, precision)), "--set", "dx=%g" % SPACING[dim], "--steps", 15,
                    "-q", "-j", 1)
        run("run", write(cls.path("channel.xml"), CHANNEL), "-o", cls.path("channel"), "--steps", 60, "-q", "-j", 1)
        run("run", write(cls.path("solid.xml"), SOLID), "-o", cls.path("solid"), "--steps", 1, "-q", "-j", 1)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder, name)

    def output(self, dim, precision="float64"):
        return self.path("%dd-%s" % (dim, precision))

    def assert_close(self, value, expected, tolerance, what):
        if expected is None or value is None:
            self.assertIs(value, expected, what)
        else:
            self.assertLessEqual(abs(value - expected), tolerance * max(1.0, abs(expected)), what)

    def test_sums_over_all_particles(self):
        for dim in CASES:
            for precision in ("float64", "float32"):
                output = self.output(dim, precision)
                options = [word for place in PLACES[dim] for word in ("--point", ",".join("%r" % x for x in place))]
                table = rows(run("probe", output, *options)[0])
                grid = skerry_vtu.read(skerry_vtu.series(output, "fluid")[-1][1])
                h = SPACING[dim] * float(CASES[dim]["ratio"])
                empty = 0
                for place, row in zip(PLACES[dim], table):
                    expected = sums(grid, dim, h, place, "published" in CASES[dim]["more"])
                    for name, value in zip(NAMES, expected):
                        self.assert_close(row[name], value, 2e-12, "%d-D %s %s %s" % (dim, precision, place, name))
                    self.assertEqual([row["x [m]"], row["y [m]"], row["z [m]"]], (list(place) + [0.0, 0.0])[:3])
                    self.assertEqual(row["t [s]"], skerry_vtu.series(output, "fluid")[-1][0])
                    empty += expected[0] is None
                self.assertEqual(len(table), len(PLACES[dim]))
                self.assertEqual(empty, dim - 1 if dim < 3 else 1)

    def test_history_of_the_run(self):
        for dim, case in CASES.items():
            line = "%s:%s:23" % (case["from"].replace(" ", ","), case["to"].replace(" ", ","))
            self.compare_with_history(self.output(dim), line, 4)

    def compare_with_history(self, output, line, frames):
        table = rows(run("probe", output, "--line", line, "--frame", "all")[0])
        with open(os.path.join(output, "history", "profile.csv"), encoding="utf-8") as stream:
            history = rows(stream.read())
        self.assertEqual(len(table), len(history))
        self.assertEqual(len({row["t [s]"] for row in table}), frames)
        others = ["p [Pa]", "u_x [m/s]", "u_y [m/s]", "u_z [m/s]", "rho [kg/m^3]", "support [-]"]
        for row, before in zip(table, history):
            for name in ("t [s]", "s [m]", "x [m]", "y [m]", "z [m]"):
                self.assertEqual(row[name], before[name])
            for name, other in zip(NAMES, others):
                expected = before[other] if before["support [-]"] or name == NAMES[-1] else None
                self.assert_close(row[name], expected, 2e-12, "%s at %s" % (name, row))

    def test_openings(self):
        output = self.path("channel")
        self.compare_with_history(output, "-0.1,0.2:1.1,0.2:61", 4)
        grid = skerry_vtu.read(skerry_vtu.series(output, "fluid")[-1][1])
        self.assertEqual(set(grid.column("Kind")), {0, 1, 2})
        # without the kinds of particles those behind the planes are left out, with a warning
        shutil.copytree(output, self.path("old"))
        for name in os.listdir(self.path("old/fields")):
            with open(os.path.join(self.path("old/fields"), name), "r+b") as stream:
                data = stream.read()
                self.assertEqual(data.count(b'Name="Kind"'), 1)
                stream.seek(0)
                stream.write(data.replace(b'Name="Kind"', b'Name="Hide"'))
        line = ("--line", "-0.1,0.2:1.1,0.2:61")
        old, said = run("probe", self.path("old"), *line)
        self.assertEqual(said.count("does not tell the kinds of particles"), 1)
        new, said = run("probe", output, *line)
        self.assertEqual(said, "")
        for row, other in zip(rows(new), rows(old)):
            if 0.1 < row["x [m]"] < 0.9:
                self.assertEqual(row, other)
        self.assertIsNone(rows(new)[0]["Pressure [Pa]"])
        self.assertIsNone(rows(old)[0]["Pressure [Pa]"])

    def test_grids(self):
        for dim, size, box in ((1, "37", "0.5:1.5:"), (2, "17x23", ""), (3, "9x7x5", "0.1,0.1,-0.3:0.3,0.5,0.3:")):
            for precision, tolerance in (("float64", 0.0), ("float32", 2e-7)):
                output = self.output(dim, precision)
                image, table = self.path("g%d.vti" % dim), self.path("g%d.csv" % dim)
                fields = ("--field", "Velocity,Mass,Pressure")
                self.assertEqual(run("probe", output, "--grid", box + size, "-o", image, *fields)[0], image + "\n")
                run("probe", output, "--grid", box + size, "-o", table, *fields)
                with open(table, encoding="utf-8") as stream:
                    expected = rows(stream.read())
                grid = skerry_vtu.read(image)
                self.assertEqual(list(grid.arrays), ["Velocity", "Mass", "Pressure", "Support"])
                self.assertEqual(grid.n_points, math.prod(map(int, size.split("x"))))
                self.assertEqual(len(expected), grid.n_points)
                self.assertEqual((grid.time, grid.cycle), (expected[0]["t [s]"], 15))
                self.assertEqual(grid.arrays["Pressure"][1].typecode, "d" if precision == "float64" else "f")
                mass = "Mass [%s]" % {1: "kg/m^2", 2: "kg/m", 3: "kg"}[dim]
                empty = 0
                for i, row in enumerate(expected):
                    for c in range(3):
                        self.assert_close(grid.points[3 * i + c], row["xyz"[c] + " [m]"], 1e-15, "place")
                    values = [(name, grid.column(*where)[i]) for name, where in (
                        ("Velocity_x [m/s]", ("Velocity", 0)), ("Velocity_y [m/s]", ("Velocity", 1)),
                        ("Velocity_z [m/s]", ("Velocity", 2)), (mass, ("Mass",)), ("Pressure [Pa]", ("Pressure",)),
                        ("Support [-]", ("Support",)))]
                    for name, value in values:
                        self.assert_close(None if math.isnan(value) else value, row[name], tolerance, "%s of %d" % (name, i))
                    empty += row["Pressure [Pa]"] is None
                    self.assertEqual(row["Pressure [Pa]"] is None, row["Support [-]"] == 0)
                self.assertEqual(empty > 0, dim > 1)
        corner = rows(run("probe", self.output(2), "--grid", "2x2", "-o", "-")[0])
        self.assertEqual([(row["x [m]"], row["y [m]"]) for row in corner], [(-0.2, 0.1), (0.6, 0.1), (-0.2, 1.3), (0.6, 1.3)])
        slab = rows(run("probe", self.output(3), "--grid", "0.1,0.3,0:0.3,0.5,0.1:3x2x1", "-o", "-")[0])
        self.assertEqual({row["z [m]"] for row in slab}, {0.05})

    def test_periodic_sides(self):
        # a line near a side is the line a period away
        shift = {1: "1.6", 2: "0.8,0", 3: "0.4,-0.48,0"}
        for dim in CASES:
            base = ["-0.35", "-0.21,0.5", "-0.01,0.69,0.03"][dim - 1].split(",")
            ends = [str(float(base[0]) + 0.1)] + base[1:]
            tables = []
            for times in (0, 1, -3):
                moved = [",".join("%.15g" % (float(a) + times * float(b)) for a, b in zip(end, shift[dim].split(",")))
                         for end in (base, ends)]
                tables.append(rows(run("probe", self.output(dim), "--line", "%s:%s:11" % tuple(moved))[0]))
            for one, *others in zip(*tables):
                for other in others:
                    for name in NAMES:
                        self.assert_close(other[name], one[name], 1e-11, name)
                    self.assertIsNotNone(one["Pressure [Pa]"])

    def test_frames(self):
        output, point = self.output(2), ("--point", "0.2,0.5")
        times = [time for time, _ in skerry_vtu.series(output, "fluid")]
        for options, expected in (((), times[3:]), (("--frame", "last"), times[3:]), (("--frame", "first"), times[:1]),
                                  (("--frame", "2"), times[2:3]), (("--frame", "all"), times),
                                  (("--frame", "1:2"), times[1:3]), (("--frame", "t=0.0021"), times[2:3]),
                                  (("--time", "0.0009"), times[1:2]), (("--time", "99"), times[3:])):
            table = rows(run("probe", output, *point, *options)[0])
            self.assertEqual([row["t [s]"] for row in table], expected)

    def test_series_of_images(self):
        output = self.path("series")
        shutil.copytree(self.output(2), output)
        alone = os.path.join(output, "probe", "grid_000003.vti")
        self.assertEqual(run("probe", output, "--grid", "5x4")[0], alone + "\n")
        self.assertEqual(run("probe", output, "--grid", "5x4", "--frame", "1:2")[0],
                         os.path.join(output, "probe", "grid.pvd") + "\n")
        self.assertEqual(sorted(os.listdir(output + "/probe")),
                         ["grid.pvd", "grid_000001.vti", "grid_000002.vti", "grid_000003.vti"])
        base = self.path("flow")
        self.assertEqual(run("probe", output, "--grid", "5x4", "--frame", "all", "-o", base + ".vti")[0], base + ".pvd\n")
        os.makedirs(self.path("one"))
        shutil.move(base + ".pvd", self.path("one/flow.pvd"))
        entries = skerry_vtu.series(self.path("one"), "grid")
        self.assertEqual([time for time, _ in entries], [time for time, _ in skerry_vtu.series(output, "fluid")])
        self.assertEqual([os.path.basename(path) for _, path in entries], ["flow_%06d.vti" % i for i in range(4)])
        self.assertTrue(all(os.path.exists(self.path(os.path.basename(path))) for _, path in entries))
        # the run's own series is found as before, and a new run removes what was probed
        run("probe", output, "--point", "0.2,0.5")
        run("run", self.path("2d-float64.xml"), "-o", output, "--set", "dx=0.02", "--steps", 0, "-q", "--force")
        self.assertEqual(os.listdir(output + "/probe"), [])

    def test_threads(self):
        for dim, size in ((1, "4000"), (2, "90x80"), (3, "30x25x20")):
            made = []
            for threads in (1, 2, 3, 7):
                image = self.path("threads.vti")
                run("probe", self.output(dim), "--grid", size, "-o", image, "-j", threads)
                with open(image, "rb") as stream:
                    made.append(stream.read())
                made[-1] += run("probe", self.output(dim), "--grid", size, "-o", "-", "-j", threads)[0].encode()
            self.assertEqual(len(set(made)), 1)

    def test_files_of_points(self):
        output = self.output(2)
        plain = run("probe", output, "--point", "0.2,0.5", "--point=0.21,-0.7")[0]
        self.assertEqual(rows(plain)[1]["s [m]"], math.hypot(0.21 - 0.2, -0.7 - 0.5))
        for text in ("0.2,0.5\n0.21,-0.7\n", "# a comment\r\n0.2 , 0.5\r\n\r\n0.21,-0.7", "\ufeffx,y\n0.2,0.5\n0.21,-0.7\n",
                     't [s],"y [m]",name,x [m],z [m]\n1,0.5,a b,0.2,0\n2,-0.7,,0.21,0\n'):
            self.assertEqual(run("probe", output, "--points", write(self.path("p.csv"), text))[0], plain)
        self.assertEqual(run("probe", output, "--points", os.path.join(output, "history", "profile.csv"), "--field",
                             "Support")[0].count("\n"), 4 * 23 + 1)
        for text, where in (
                ("0.2,0.5\n0.2\n", ":2: error: 1 columns instead of 2"),
                ("x,z\n1,2\n", ":1: error: there is no column called y"),
                ("1,2,3\n", ":1: error: 3 numbers where the run has 2 dimensions"),
                ("x,y,z\n1,2,0\n1,2,3\n", ":3: error: z = 3"), ("x,y\n1,two\n", ':2: error: "two" is no coordinate'),
                ("1,inf\n", '"inf" is no coordinate'), ("", "there is no point in it"), ("x,y\n", "there is no point in it"),
                ("1,2\0\n", "zero byte")):
            self.refused(65, where, output, "--points", write(self.path("p.csv"), text))
        self.refused(66, "cannot open", output, "--points", self.path("none.csv"))

    def refused(self, code, text, output, *options):
        out, said = run("probe", output, *options, code=code)
        self.assertEqual(out, "")
        self.assertIn(text, said)

    def test_refusals(self):
        two, point = self.output(2), ("--point", "0.2,0.5")
        self.refused(64, "nowhere to probe", two)
        self.refused(66, "nowhere", self.path("nowhere"), *point)
        self.refused(66, "", self.path("channel/history"), *point)
        self.refused(66, "the run has no fluid", self.path("solid"), *point)
        for options, text in (
                (("--point", "0.2"), "--point 0.2: 1 coordinate where the run has 2 dimensions"),
                (("--point", "0.2,0.5,0"), "3 coordinates where the run has 2 dimensions"),
                (("--point", "0.2;0.5"), '"0.2;0.5" is no coordinate'), (("--point", "0.2,nan"), '"nan" is no coordinate'),
                (("--point", "0.2,"), '"" is no coordinate'), (("--point", "0.2,0.5:0,0"), "one point is wanted"),
                (("--line", "0,0.5:1,0.5"), "write FROM:TO:N"), (("--line", "0,0.5"), "write FROM:TO:N"),
                (("--line", "0,0.5:1,0.5:x"), "write FROM:TO:N"), (("--line", "0,0.5:1,0.5:1"), "a line has from 2 to"),
                (("--line", "0:1,0.5:5"), "1 coordinate where"), (("--grid", "10"), "1 direction where the run has 2 dimensions"),
                (("--grid", "10x10x10"), "3 directions where"), (("--grid", "10x0"), "at least 1 point in each direction"),
                (("--grid", "10x-3"), "at least 1 point"), (("--grid", "10xa"), "write NXxNY[xNZ]"),
                (("--grid", "0,0:10x10"), "is no coordinate"), (("--grid", "1,0:0,1:10x10"), "x goes from 1 to 0"),
                (("--grid", "0,0:0,1:10x10"), "x goes from 0 to 0"),
                (("--grid", "100000x100000"), "are too many"),
                (("--grid", "3x3", "--grid", "4x4"), "a grid goes with no other"),
                (("--grid", "3x3") + point, "a grid goes with no other"),
                (point + ("--field", "Presure"), 'no field "Presure"; did you mean "Pressure"; there are: '
                 'Density, Mass'),
                (point + ("--field", "Id"), "--field Id: these are labels"), (point + ("--field", ""), "names of arrays are wanted"),
                (point + ("--field", "Mass,,Pressure"), "names of arrays are wanted"),
                (point + ("--field", "Mass,Pressure,Mass"), "Mass is there twice"),
                (point + ("--frame", "4"), "frame 4 does not exist; there are 0 to 3"),
                (point + ("--frame", "1:9"), "frame 9 does not exist"),
                (point + ("--frame", "2:1"), "two numbers A:B are wanted"),
                (point + ("--frame", "lst"), "neither last, first, all, A:B, t=TIME"),
                (point + ("--time", "soon"), "a time in seconds"), (point + ("--time", "1", "--frame", "1"), "only one of them"),
                (point + ("-o", "p.vti"), "only a --grid can be a .vti"), (("--grid", "3x3", "-o", "g.png"), "written as .vti or .csv"),
                (point + ("--fild", "Mass"), "did you mean --field?")):
            with self.subTest(options=options):
                self.refused(64, text, two, *options)

    def test_output_that_cannot_be_written(self):
        two, point = self.output(2), ("--point", "0.2,0.5")
        self.refused(74, "cannot open for writing", two, *point, "-o", self.path("none/p.csv"))
        self.refused(74, "cannot open for writing", two, "--grid", "3x3", "-o", self.path("none/g.vti"))
        kept = write(self.path("kept.csv"), "older\n")
        self.refused(64, "no field", two, *point, "--field", "Density,Rho", "-o", kept)
        with open(kept, encoding="utf-8") as stream:
            self.assertEqual(stream.read(), "older\n")
        self.assertFalse(os.path.exists(kept + ".tmp"))
        shutil.copytree(two, self.path("blocked"))
        write(self.path("blocked/probe"), "a file")
        self.refused(73, "cannot create the folder", self.path("blocked"), "--grid", "3x3")
        if os.access("/dev/full", os.W_OK):
            with open("/dev/full", "wb") as full:
                done = subprocess.run([SKERRY, "probe", two, *point], stdout=full, stderr=subprocess.PIPE)
            self.assertEqual(done.returncode, 74)

    def test_damaged_runs(self):
        output = self.path("damaged")
        shutil.copytree(self.output(2), output)
        last, point = skerry_vtu.series(output, "fluid")[-1][1], ("--point", "0.2,0.5")
        # a run of other particles
        shutil.copy(skerry_vtu.series(self.output(3), "fluid")[0][1], last)
        self.refused(74, "a smoothing length of 0.04 m, where the deck says 0.02 m", output, *point)
        with open(last, "r+b") as stream:
            stream.truncate(3000)
        self.refused(74, "damaged", output, *point)
        run("probe", output, *point, "--frame", "first")
        os.remove(os.path.join(output, "2d-float64.pvd"))
        self.refused(66, "no .pvd file there", output, *point)
        with open(os.path.join(output, "input", "2d-float64.xml"), "a", encoding="utf-8") as stream:
            stream.write("\n")
        self.refused(74, "2d-float64.xml", output, *point)


if __name__ == "__main__":
    unittest.main()
