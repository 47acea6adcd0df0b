#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# meshio and VTK read what skerry writes, value by value. Skipped where neither is installed
# (Debian: python3-meshio; python3-vtk9 or python3-paraview).
python=${PYTHON:-/usr/bin/python3}
if ! "$python" -c 'import meshio' 2>/dev/null && ! "$python" -c 'import vtk' 2>/dev/null; then
    echo "skipped: $python has neither meshio nor vtk"
    exit 77
fi
folder=$(mktemp -d) || exit 99
trap 'rm -rf "$folder"' EXIT
./tests/output/write_samples "$folder" || exit 1
"$python" - "$folder" <<'END'
import sys

folder, n, read = sys.argv[1], 200000, []


def check(name, good):
    if not good:
        sys.exit(name + ": wrong")


def close(a, b):
    return abs(a - b) <= 1e-12 * abs(b)


try:
    import meshio
except ImportError:
    meshio = None
if meshio:
    fluid = meshio.read(folder + "/fluid.vtu")
    check("meshio points", fluid.points.shape == (n, 3) and fluid.points[n - 1][0] == (n - 1) / 8)
    check("meshio cells", fluid.cells[0].type == "vertex" and fluid.cells[0].data[n - 1][0] == n - 1)
    check("meshio density", all(close(fluid.point_data["Density"][i], 1000 + i / 3) for i in range(n)))
    check("meshio id", all(fluid.point_data["Id"][i] == 3000000000 + i for i in range(n)))
    check("meshio kind", all(fluid.point_data["Kind"][i] == i % 3 for i in range(n)))
    solid = meshio.read(folder + "/solid.vtu")
    check("meshio solid", solid.cells[0].type == "quad" and solid.cells[0].data.tolist()[1] == [1, 2, 5, 4])
    check("meshio stress", solid.cell_data["VonMises"][0].ravel().tolist() == [1e6, -2.5e6])
    read.append("meshio " + meshio.__version__)

try:
    import vtk
except ImportError:
    vtk = None
if vtk:
    def grid_of(name):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(folder + name)
        reader.Update()
        check("vtk error", reader.GetErrorCode() == 0)
        return reader.GetOutput()

    grid = grid_of("/fluid.vtu")
    data = grid.GetPointData()
    check("vtk points", grid.GetNumberOfPoints() == n and grid.GetPoint(n - 1)[0] == (n - 1) / 8)
    check("vtk cells", grid.GetNumberOfCells() == n and grid.GetCellType(n - 1) == vtk.VTK_VERTEX)
    check("vtk cell", grid.GetCell(n - 1).GetPointId(0) == n - 1)
    check("vtk density", all(close(data.GetArray("Density").GetValue(i), 1000 + i / 3) for i in range(n)))
    check("vtk id", all(data.GetArray("Id").GetValue(i) == 3000000000 + i for i in range(n)))
    names = data.GetScalars().GetName(), data.GetVectors().GetName()
    check("vtk colouring", names == ("Density", "Velocity"))
    check("vtk time", grid.GetFieldData().GetArray("TimeValue").GetValue(0) == 0.1)
    check("vtk cycle", grid.GetFieldData().GetArray("Cycle").GetValue(0) == 123456789012)
    solid = grid_of("/solid.vtu")
    check("vtk solid", solid.GetCellType(1) == vtk.VTK_QUAD and solid.GetPoint(5) == (2.0, 1.0, 0.5))
    check("vtk stress", solid.GetCellData().GetArray("VonMises").GetValue(1) == -2.5e6)
    reader = vtk.vtkXMLImageDataReader()
    reader.SetFileName(folder + "/image.vti")
    reader.Update()
    image, data = reader.GetOutput(), reader.GetOutput().GetPointData()
    check("vtk image", image.GetDimensions() == (5, 4, 3) and reader.GetErrorCode() == 0)
    check("vtk image place", image.GetPoint(59) == (0.0, 1.75, 4.5))
    pressure = [data.GetArray("Pressure").GetValue(i) for i in range(60)]
    check("vtk image NaN", pressure[7] != pressure[7])
    check("vtk image pressure", all(close(pressure[i], 1e5 + i / 3) for i in range(60) if i != 7))
    check("vtk image velocity", data.GetArray("Velocity").GetTuple(58) == (0.0, -14.5, 0.0))
    check("vtk image colouring", (data.GetScalars().GetName(), data.GetVectors().GetName()) == ("Pressure", "Velocity"))
    check("vtk image time", image.GetFieldData().GetArray("TimeValue").GetValue(0) == 0.7)
    read.append("VTK " + vtk.vtkVersion().GetVTKVersion())
print("read by " + " and ".join(read))
END
