// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/view.h"

#include "base/error.h"
#include "base/file.h"

// The part of the script that is the same for all runs. Parts are told apart by their names in the .pvd.
static const char script[] =
    "import os\n"
    "import xml.etree.ElementTree\n"
    "import paraview\n"
    "from paraview.simple import *\n"
    "\n"
    "paraview.simple._DisableFirstRenderCameraReset()\n"
    "here = os.path.dirname(os.path.abspath(__file__))\n"
    "collection = os.path.join(here, NAME + '.pvd')\n"
    "names = []\n"
    "for data in xml.etree.ElementTree.parse(collection).getroot().iter('DataSet'):\n"
    "    if data.get('name') not in names:\n"
    "        names.append(data.get('name'))\n"
    "reader = PVDReader(registrationName=NAME, FileName=collection)\n"
    "reader.UpdatePipeline()\n"
    "times = list(reader.TimestepValues)\n"
    "scene = GetAnimationScene()\n"
    "scene.UpdateAnimationUsingDataTimeSteps()\n"
    "view = GetActiveViewOrCreate('RenderView')\n"
    "view.ViewSize = [1600, 900]\n"
    "view.UseColorPaletteForBackground = 0\n"
    "view.Background = [1, 1, 1]\n"
    "view.OrientationAxesVisibility = 0\n"
    "view.InteractionMode = '2D' if DIM < 3 else '3D'\n"
    "black = [0, 0, 0]\n"
    "\n"
    "def part(name):\n"
    "    if len(names) == 1:\n"
    "        return reader\n"
    "    block = ExtractBlock(registrationName=name, Input=reader)\n"
    "    block.Selectors = ['/Root/*[@label=\"%s\"]' % name]\n"
    "    return MergeBlocks(registrationName=name + ' merged', Input=block)\n"
    "\n"
    "def show_fluid(source):\n"
    "    shown = Show(source, view)\n"
    "    shown.SetRepresentationType('Point Gaussian')\n"
    "    shown.ShaderPreset = 'Plain circle' if DIM < 3 else 'Sphere'\n"
    "    shown.GaussianRadius = 0.5 * SPACING\n"
    "    colour_by(source, shown)\n"
    "\n"
    "def show_wall(source):\n"
    "    shown = Show(source, view)\n"
    "    shown.SetRepresentationType('Point Gaussian')\n"
    "    shown.ShaderPreset = 'Plain circle' if DIM < 3 else 'Sphere'\n"
    "    shown.GaussianRadius = 0.5 * SPACING\n"
    "    shown.ColorArrayName = [None, '']\n"
    "    shown.DiffuseColor = shown.AmbientColor = [0.66, 0.66, 0.66]\n"
    "\n"
    "def colour_by(source, shown):\n"
    "    source.UpdatePipeline()\n"
    "    if COLOUR not in source.PointData.keys():\n"
    "        return\n"
    "    vector = source.PointData[COLOUR].GetNumberOfComponents() > 1\n"
    "    ColorBy(shown, ('POINTS', COLOUR, 'Magnitude') if vector else ('POINTS', COLOUR))\n"
    "    table = GetColorTransferFunction(COLOUR)\n"
    "    table.ApplyPreset('Viridis (matplotlib)', True)\n"
    "    shown.RescaleTransferFunctionToDataRangeOverTime()\n"
    "    bar = GetScalarBar(table, view)\n"
    "    bar.Orientation = 'Horizontal'\n"
    "    bar.WindowLocation = 'Lower Center'\n"
    "    bar.TitleColor = bar.LabelColor = black\n"
    "    shown.SetScalarBarVisibility(view, True)\n"
    "\n"
    "def show_solid(source):\n"
    "    shown = Show(source, view)\n"
    "    shown.SetRepresentationType('Surface With Edges')\n"
    "    shown.ColorArrayName = [None, '']\n"
    "    shown.DiffuseColor = shown.AmbientColor = [0.72, 0.72, 0.72]\n"
    "    shown.EdgeColor = [0.25, 0.25, 0.25]\n"
    "    if SPACING == 0:\n"
    "        colour_by(source, shown)\n"
    "\n"
    "def show_surface(source):\n"
    "    shown = Show(source, view)\n"
    "    shown.SetRepresentationType('Wireframe')\n"
    "    shown.ColorArrayName = [None, '']\n"
    "    shown.DiffuseColor = shown.AmbientColor = [0.1, 0.1, 0.1]\n"
    "    shown.LineWidth = 2\n"
    "\n"
    "if len(names) > 1:\n"
    "    Hide(reader, view)\n"
    "kinds = {'fluid': show_fluid, 'solid': show_solid, 'wall': show_wall, 'virtual': show_wall}\n"
    "for name in names:\n"
    "    kinds.get(name.split('-')[0], show_surface)(part(name))\n"
    "clock = AnnotateTimeFilter(registrationName='time', Input=reader)\n"
    "clock.Format = 't = {time:g} s'\n"
    "label = Show(clock, view)\n"
    "label.Color = black\n"
    "label.WindowLocation = 'Upper Right Corner'\n"
    "if times:\n"
    "    scene.AnimationTime = view.ViewTime = times[-1]\n"
    "view.ResetCamera(True)\n"
    "if paraview.fromGUI:\n"
    "    Render(view)\n"
    "else:\n"
    "    for frame, time in enumerate(times):\n"
    "        scene.AnimationTime = view.ViewTime = time\n"
    "        SaveScreenshot(os.path.join(here, 'view_%06d.png' % frame), view)\n";

// A Python literal of @p text.
static void literal_write(FILE *stream, const char *text)
{
    fputc('\'', stream);
    for (; *text; ++text) {
        unsigned char letter = (unsigned char)*text;
        if (letter == '\'' || letter == '\\')
            fprintf(stream, "\\%c", letter);
        else if (letter < 0x20)
            fprintf(stream, "\\x%02x", letter);
        else
            fputc(letter, stream);
    }
    fputc('\'', stream);
}

int view_write(const struct view *view, const char *path)
{
    struct file_atomic file;
    CALL(file_atomic_open(&file, path));
    fputs("# Open it in ParaView (File > Load State, or Tools > Python Shell > Run Script);\n"
          "# xvfb-run -a pvbatch view.py writes a PNG of each frame beside it.\n\n"
          "NAME = ",
          file.stream);
    literal_write(file.stream, view->name);
    fprintf(file.stream, "\nDIM = %d\nSPACING = %.17g  # m, of the particles\nCOLOUR = ", view->dim,
            view->spacing);
    literal_write(file.stream, view->colour);
    fprintf(file.stream, "\n\n%s", script);
    return file_atomic_commit(&file);
}
