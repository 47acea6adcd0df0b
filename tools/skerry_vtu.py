# SPDX-License-Identifier: GPL-3.0-or-later
"""Read the .vtu, .vti and .pvd files that skerry writes, with nothing but Python's standard library.

A .vtu or .vti is an XML head followed by raw appended data: per array a header of unsigned 64-bit numbers (blocks, block
size, size of the last block or 0, compressed sizes) and one zlib stream a block.
"""

import array
import os
import struct
import sys
import xml.etree.ElementTree as ElementTree
import zlib

TYPES = {"Float32": "f", "Float64": "d", "Int32": "i", "Int64": "q", "UInt8": "B", "Int8": "b"}


class VtuError(Exception):
    """A file is damaged or not of the kind that skerry writes."""


class Grid:
    """One .vtu or .vti: time, cycle, points (rows of 3, flat), arrays {name: (components, values)}."""

    def __init__(self):
        self.time = None
        self.cycle = None
        self.n_points = 0
        self.points = array.array("d")
        self.arrays = {}

    def column(self, name, component=0):
        """One component of a point array (or of "Points") as a sequence."""
        if name == "Points":
            return self.points[component::3]
        components, values = self.arrays[name]
        return values[component::components]


def _appended(path, data, start, offset, type_name):
    code = TYPES.get(type_name)
    if code is None:
        raise VtuError("%s: array type %s is not known" % (path, type_name))
    position = start + offset
    try:
        blocks, _, _ = struct.unpack_from("<3Q", data, position)
        sizes = struct.unpack_from("<%dQ" % blocks, data, position + 24)
        position += 24 + 8 * blocks
        raw = bytearray()
        for size in sizes:
            if position + size > len(data):
                raise VtuError("%s: ends in the middle of an array" % path)
            raw += zlib.decompress(data[position:position + size])
            position += size
    except (struct.error, zlib.error) as error:
        raise VtuError("%s: damaged data (%s)" % (path, error)) from error
    values = array.array(code)
    if values.itemsize != struct.calcsize("=" + code):
        raise VtuError("%s: this machine's %s has another size" % (path, type_name))
    values.frombytes(bytes(raw))
    if sys.byteorder == "big":
        values.byteswap()
    return values


def _field_data(root, grid):
    for item in root.iter("FieldData"):
        for entry in item.findall("DataArray"):
            text = (entry.text or "").split()
            if entry.get("Name") == "TimeValue" and text:
                grid.time = float(text[0])
            if entry.get("Name") == "Cycle" and text:
                grid.cycle = int(float(text[0]))


def _image_points(root, piece):
    """Places of the points of a .vti, x fastest."""
    image = root.find("ImageData")
    extent = [int(n) for n in piece.get("Extent").split()]
    axes = [[origin + i * spacing for i in range(first, last + 1)]
            for origin, spacing, first, last in zip(map(float, image.get("Origin").split()),
                                                    map(float, image.get("Spacing").split()), extent[::2], extent[1::2])]
    return array.array("d", [c for z in axes[2] for y in axes[1] for x in axes[0] for c in (x, y, z)])


def read(path):
    """The Grid in the file at path."""
    with open(path, "rb") as stream:
        data = stream.read()
    mark = data.find(b"<AppendedData")
    start = data.find(b"_", mark) + 1
    if mark < 0 or start <= 0:
        raise VtuError("%s: has no appended data" % path)
    try:
        root = ElementTree.fromstring(data[:mark] + b"</VTKFile>")
    except ElementTree.ParseError as error:
        raise VtuError("%s: %s" % (path, error)) from error
    if root.get("header_type") != "UInt64" or root.get("compressor") != "vtkZLibDataCompressor":
        raise VtuError("%s: is not compressed as skerry does it" % path)
    grid = Grid()
    _field_data(root, grid)
    piece = root.find(".//Piece")
    if piece is None:
        raise VtuError("%s: has no Piece" % path)
    if root.get("type") == "ImageData":
        grid.points = _image_points(root, piece)
        grid.n_points = len(grid.points) // 3
    else:
        grid.n_points = int(piece.get("NumberOfPoints"))

    def load(entry):
        values = _appended(path, data, start, int(entry.get("offset")), entry.get("type"))
        components = int(entry.get("NumberOfComponents") or 1)
        if len(values) != components * grid.n_points:
            raise VtuError("%s: array %s has %d values instead of %d"
                           % (path, entry.get("Name"), len(values), components * grid.n_points))
        return components, values

    if root.get("type") != "ImageData":
        grid.points = load(piece.find("Points/DataArray"))[1]
    for entry in piece.findall("PointData/DataArray"):
        grid.arrays[entry.get("Name")] = load(entry)
    return grid


def series(output, name):
    """[(time, path)] of the part called name in the .pvd of an output folder, in order of time."""
    entries = []
    for file in sorted(os.listdir(output)):
        if not file.endswith(".pvd"):
            continue
        root = ElementTree.parse(os.path.join(output, file)).getroot()
        for entry in root.iter("DataSet"):
            if entry.get("name") == name:
                entries.append((float(entry.get("timestep")), os.path.join(output, entry.get("file"))))
    return sorted(entries)


def table(text):
    """A table that skerry wrote as {column name without unit: list of numbers}; an empty cell is nan."""
    lines = [line for line in text.split("\n") if line and not line.startswith("#")]
    names = [name.split("[")[0].strip() for name in lines[0].split(",")]
    columns = {name: [] for name in names}
    for line in lines[1:]:
        values = line.split(",")
        if len(values) != len(names):
            continue  # the row being written when the run was killed
        for name, value in zip(names, values):
            columns[name].append(float(value or "nan"))
    return columns


def history(path):
    """A history file as a table."""
    with open(path, encoding="utf-8") as stream:
        return table(stream.read())
