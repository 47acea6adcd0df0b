// SPDX-License-Identifier: GPL-3.0-or-later
// Writes files for other programs to read (readers.sh): write_samples FOLDER
#include "output/vti.h"
#include "output/vtu.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N = 200000 }; // several blocks

static struct vtu_array array(const char *name, int components, enum vtu_type type, const void *data)
{
    struct vtu_array made = {.components = components, .type = type, .data = data};
    strcpy(made.name, name);
    return made;
}

static int fluid_write(const char *path)
{
    static float points[N][3];
    static double density[N];
    static int64_t id[N];
    static uint8_t kind[N];
    for (int i = 0; i < N; ++i) {
        points[i][0] = (float)i / 8.0F;
        points[i][1] = (float)(i % 7);
        density[i] = 1000.0 + i / 3.0;
        id[i] = 3000000000 + i;
        kind[i] = (uint8_t)(i % 3);
    }
    const struct vtu_array arrays[] = {array("Density", 1, VTU_FLOAT64, density),
                                       array("Velocity", 3, VTU_FLOAT32, points),
                                       array("Id", 1, VTU_INT64, id), array("Kind", 1, VTU_UINT8, kind)};
    const struct vtu_grid grid = {.time = 0.1,
                                  .cycle = 123456789012,
                                  .n_points = N,
                                  .points = points,
                                  .points_type = VTU_FLOAT32,
                                  .n_point_arrays = 4,
                                  .point_arrays = arrays,
                                  .scalars = "Density",
                                  .vectors = "Velocity"};
    return vtu_write(path, &grid);
}

static int solid_write(const char *path)
{
    const double points[6][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0.5}};
    const int64_t nodes[8] = {0, 1, 4, 3, 1, 2, 5, 4}, offsets[2] = {4, 8};
    const uint8_t types[2] = {9, 9};
    const double stress[2] = {1e6, -2.5e6};
    const struct vtu_array arrays[] = {array("VonMises", 1, VTU_FLOAT64, stress)};
    const struct vtu_grid grid = {.time = 0.1,
                                  .n_points = 6,
                                  .n_cells = 2,
                                  .n_connectivity = 8,
                                  .points = points,
                                  .points_type = VTU_FLOAT64,
                                  .connectivity = nodes,
                                  .offsets = offsets,
                                  .types = types,
                                  .n_cell_arrays = 1,
                                  .cell_arrays = arrays};
    return vtu_write(path, &grid);
}

static int image_write(const char *path)
{
    enum { NX = 5, NY = 4, NZ = 3 };
    static float velocity[NX * NY * NZ][3];
    static double pressure[NX * NY * NZ];
    for (int i = 0; i < NX * NY * NZ; ++i) {
        pressure[i] = i == 7 ? NAN : 1e5 + i / 3.0;
        velocity[i][1] = -0.25F * (float)i;
    }
    const struct vtu_array arrays[] = {array("Pressure", 1, VTU_FLOAT64, pressure),
                                       array("Velocity", 3, VTU_FLOAT32, velocity)};
    const struct vti_image image = {.time = 0.7,
                                    .cycle = 21,
                                    .n = {NX, NY, NZ},
                                    .origin = {-0.5, 0.25, 3.0},
                                    .spacing = {0.125, 0.5, 0.75},
                                    .n_arrays = 2,
                                    .arrays = arrays,
                                    .scalars = "Pressure",
                                    .vectors = "Velocity"};
    return vti_write(path, &image);
}

int main(int argc, char **argv)
{
    char path[512];
    if (argc != 2)
        return 1;
    snprintf(path, sizeof path, "%s/fluid.vtu", argv[1]);
    int status = fluid_write(path);
    snprintf(path, sizeof path, "%s/solid.vtu", argv[1]);
    status = status ? status : solid_write(path);
    snprintf(path, sizeof path, "%s/image.vti", argv[1]);
    return status ? status : image_write(path);
}
