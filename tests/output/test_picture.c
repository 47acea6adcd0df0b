// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/error.h"
#include "model/mesh.h"
#include "output/colour_map.h"
#include "output/lettering.h"
#include "output/picture.h"
#include "output/pvd.h"
#include "output/series.h"
#include "output/view.h"
#include "output/vtu.h"

#include "folder.h"

#include <math.h>
#include <png.h>
#include <stdbool.h>
#include <sys/stat.h>

enum { NX = 100, NY = 30, N = NX * NY, FRAMES = 3 };
static const double spacing = 0.01;

static struct vtu_array array(const char *name, int components, const void *data)
{
    struct vtu_array made = {.components = components, .type = VTU_FLOAT64, .data = data};
    strcpy(made.name, name);
    return made;
}

static void grid_write(const struct folder *folder, struct pvd *pvd, const char *name, int part, int frame,
                       const struct vtu_grid *grid)
{
    char file[128], path[256];
    snprintf(file, sizeof file, "fields/%s_%06d.vtu", name, frame);
    assert_int_equal(vtu_write(folder_file(folder, file, path), grid), 0);
    assert_int_equal(pvd_add(pvd, grid->time, part, name, file), 0);
}

// A channel of 1 m x 0.3 m: speed = x + 0.05 y + frame. @p depth > 1: so many layers along z.
static void fluid_write(const struct folder *folder, struct pvd *pvd, int frame, int depth)
{
    size_t n = (size_t)(N * depth);
    double *x = calloc(n, sizeof(double[3])), *u = calloc(n, sizeof(double[3])), *p = calloc(n, sizeof *p),
           *rho = calloc(n, sizeof *rho), *m = calloc(n, sizeof *m);
    for (size_t i = 0; i < n; ++i) {
        x[3 * i] = ((double)(i % NX) + 0.5) * spacing;
        x[3 * i + 1] = ((double)(i / NX % NY) + 0.5) * spacing;
        x[3 * i + 2] = depth > 1 ? ((double)(i / N) + 0.5) * spacing : 0.0;
        u[3 * i + 1] = -(x[3 * i] + 0.05 * x[3 * i + 1] + frame);
        p[i] = 1e5 * x[3 * i + 1];
        rho[i] = 1000.0;
        m[i] = rho[i] * pow(spacing, depth > 1 ? 3 : 2);
    }
    const struct vtu_array arrays[] = {array("Density", 1, rho), array("Mass", 1, m), array("Velocity", 3, u),
                                       array("Pressure", 1, p)};
    const struct vtu_grid grid = {.time = 0.25 * frame,
                                  .n_points = n,
                                  .points = x,
                                  .points_type = VTU_FLOAT64,
                                  .n_point_arrays = 4,
                                  .point_arrays = arrays};
    grid_write(folder, pvd, "fluid", 0, frame, &grid);
    free(x);
    free(u);
    free(p);
    free(rho);
    free(m);
}

// A beam of two elements that covers 0.4..0.6 x 0.1..0.14, with a point and a cell array.
static void solid_write(const struct folder *folder, struct pvd *pvd, int frame)
{
    const double x[6][3] = {{0.4, 0.1, 0},  {0.5, 0.1, 0},  {0.6, 0.1, 0},
                            {0.4, 0.14, 0}, {0.5, 0.14, 0}, {0.6, 0.14, 0}};
    const double stress[2] = {1e6, 3e6}, d[6][3] = {{0}, {0.5}, {1}, {0}, {0.5}, {1}};
    const int64_t nodes[8] = {0, 1, 4, 3, 1, 2, 5, 4}, offsets[2] = {4, 8};
    const uint8_t types[2] = {9, 9};
    const struct vtu_array points[] = {array("Displacement", 3, d)}, cells[] = {array("VonMises", 1, stress)};
    const struct vtu_grid grid = {.time = 0.25 * frame,
                                  .n_points = 6,
                                  .n_cells = 2,
                                  .n_connectivity = 8,
                                  .points = x,
                                  .points_type = VTU_FLOAT64,
                                  .connectivity = nodes,
                                  .offsets = offsets,
                                  .types = types,
                                  .n_point_arrays = 1,
                                  .n_cell_arrays = 1,
                                  .point_arrays = points,
                                  .cell_arrays = cells};
    grid_write(folder, pvd, "solid-beam", 1, frame, &grid);
}

// The walls y = 0 and y = 0.3.
static void surface_write(const struct folder *folder, struct pvd *pvd, int frame)
{
    const double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 0.3, 0}, {1, 0.3, 0}};
    const int64_t nodes[4] = {0, 1, 2, 3}, offsets[2] = {2, 4};
    const uint8_t types[2] = {3, 3};
    const struct vtu_grid grid = {.time = 0.25 * frame,
                                  .n_points = 4,
                                  .n_cells = 2,
                                  .n_connectivity = 4,
                                  .points = x,
                                  .points_type = VTU_FLOAT64,
                                  .connectivity = nodes,
                                  .offsets = offsets,
                                  .types = types};
    grid_write(folder, pvd, "surface-channel", 2, frame, &grid);
}

enum content { FLUID = 1, SOLID = 2, SURFACE = 4, DEEP = 8 };

static void run_write(const struct folder *folder, unsigned content)
{
    char path[256];
    struct pvd pvd;
    mkdir(folder_file(folder, "fields", path), 0777);
    assert_int_equal(pvd_create(&pvd, folder_file(folder, "channel.pvd", path)), 0);
    for (int frame = 0; frame < FRAMES; ++frame) {
        if (content & FLUID)
            fluid_write(folder, &pvd, frame, content & DEEP ? 8 : 1);
        if (content & SOLID)
            solid_write(folder, &pvd, frame);
        if (content & SURFACE)
            surface_write(folder, &pvd, frame);
    }
    assert_int_equal(pvd_write(&pvd), 0);
    pvd_reset(&pvd);
}

struct image {
    int width, height;
    uint8_t *rgb;
};

static struct image image_read(const char *path)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&png, path));
    png.format = PNG_FORMAT_RGB;
    struct image image = {(int)png.width, (int)png.height, malloc(PNG_IMAGE_SIZE(png))};
    assert_non_null(image.rgb);
    assert_true(png_image_finish_read(&png, NULL, image.rgb, 0, NULL));
    return image;
}

static void assert_colour(const struct image *image, double x, double y, struct colour expected,
                          int tolerance)
{
    const uint8_t *is = image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
    if (abs(is[0] - expected.r) > tolerance || abs(is[1] - expected.g) > tolerance ||
        abs(is[2] - expected.b) > tolerance)
        fail_msg("pixel %g, %g is %d %d %d instead of %d %d %d", x, y, is[0], is[1], is[2], expected.r,
                 expected.g, expected.b);
}

// The place of a point in a picture of 1000 pixels whose window is x 0..1, y 0..0.3: letters are 10 pixels
// high, the margins 60 and 25 pixels, the top 32 pixels.
static const double left = 60, top = 32, scale = 915;

static struct picture picture_of(const struct folder *folder, const char *file)
{
    return (struct picture){.output = folder->path,
                            .field = "Speed",
                            .frame = "last",
                            .has_range = true,
                            .range = {2.0, 3.015},
                            .has_window = true,
                            .window = {0, 1, 0, 0.3},
                            .width = 1000,
                            .file = file};
}

static void test_plane(void **state)
{
    const struct folder *folder = *state;
    char path[256];
    run_write(folder, FLUID | SOLID | SURFACE);
    struct picture picture = picture_of(folder, folder_file(folder, "a.png", path));
    assert_int_equal(picture_draw(&picture), 0);
    struct image image = image_read(path);
    assert_int_equal(image.width, 1000);
    const double places[][2] = {{0.055, 0.255}, {0.305, 0.055}, {0.755, 0.205}, {0.985, 0.015}};
    for (size_t i = 0; i < 4; ++i) {
        double value = 2.0 + places[i][0] + 0.05 * places[i][1];
        assert_colour(&image, left + scale * places[i][0], top + scale * (0.3 - places[i][1]),
                      colour_map((value - 2.0) / 1.015), 2);
    }
    const struct colour white = {255, 255, 255}, grey = {206, 209, 214};
    assert_colour(&image, left + scale * 0.45, top + scale * 0.18, grey, 1); // within an element
    assert_colour(&image, left + scale * 0.55, top + scale * 0.18, grey, 1);
    assert_colour(&image, left + scale * 0.5, top + scale * 0.18, (struct colour){96, 102, 112}, 130); // edge
    assert_colour(&image, 10, 10, white, 0);
    assert_colour(&image, 995, image.height - 5, white, 0);
    const uint8_t *wall = image.rgb + 3 * ((size_t)(top - 0.6) * 1000 + 500);
    assert_true(wall[0] < 150 && abs(wall[0] - wall[2]) < 30); // the dark line at y = 0.3
    free(image.rgb);
}

// The colour bar ends with the first and the last colour; the time stands in the upper right corner.
static void test_decorations(void **state)
{
    const struct folder *folder = *state;
    char path[256];
    run_write(folder, FLUID);
    struct picture picture = picture_of(folder, folder_file(folder, "a.png", path));
    assert_int_equal(picture_draw(&picture), 0);
    struct image image = image_read(path);
    double middle = 0.5 * (left + 975), y = top + 0.3 * scale + 56 + 5;
    assert_colour(&image, middle - 249, y, colour_map(0), 2);
    assert_colour(&image, middle, y, colour_map(0.5), 2);
    assert_colour(&image, middle + 248, y, colour_map(1), 2);
    size_t dark = 0;
    for (int row = 8; row < 24; ++row)
        for (int x = 880; x < 975; ++x)
            dark += image.rgb[3 * (row * 1000 + x)] < 128;
    assert_in_range(dark, 60, 600);
    free(image.rgb);
}

static void test_frames(void **state)
{
    struct folder *folder = *state;
    char path[256];
    run_write(folder, FLUID);
    struct picture picture = picture_of(folder, NULL);
    picture.width = 300;
    static const char *const frames[][2] = {{"last", "Speed_000002.png"},
                                            {"first", "Speed_000000.png"},
                                            {"1", "Speed_000001.png"},
                                            {"t=0.3", "Speed_000001.png"},
                                            {"t=99", "Speed_000002.png"}};
    for (size_t i = 0; i < 5; ++i) {
        picture.frame = frames[i][0];
        assert_int_equal(picture_draw(&picture), 0);
        assert_int_equal(unlink(folder_file(folder, frames[i][1], path)), 0);
    }
    static const char *const wrong[] = {"3", "-1", "newest", "t=", "t=1x", ""};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        picture.frame = wrong[i];
        assert_int_equal(picture_draw(&picture), STATUS_USAGE);
    }
}

static void test_fields(void **state)
{
    const struct folder *folder = *state;
    char path[256];
    run_write(folder, FLUID | SOLID);
    struct picture picture = picture_of(folder, folder_file(folder, "a.png", path));
    picture.field = "Pressure";
    picture.has_range = false; // 500 to 29500 Pa
    picture.has_window = false;
    assert_int_equal(picture_draw(&picture), 0);
    struct image image = image_read(path);
    assert_colour(&image, 500, top + 6, colour_map(1), 2);
    assert_colour(&image, 500, top + 0.3 * 915 - 7, colour_map(0), 2);
    free(image.rgb);
    picture.field = "Velocity_y"; // falls along x
    assert_int_equal(picture_draw(&picture), 0);
    image = image_read(path);
    assert_colour(&image, left + 6, top + 0.15 * 915, colour_map(1), 6);
    assert_colour(&image, left + 909, top + 0.15 * 915, colour_map(0), 6);
    free(image.rgb);
    assert_string_equal(series_unit("Velocity_y", 2), "m/s");
    assert_string_equal(series_unit("ReactionForce_x", 2), "N/m");
    assert_null(series_unit("Velocity_w", 2));
    assert_null(series_unit("Velo", 2));
    static const char *const wrong[] = {"Presure",    "VonMises",   "",  "../Speed",
                                        "Velocity_w", "Pressure_x", "_x"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        picture.field = wrong[i];
        assert_int_equal(picture_draw(&picture), STATUS_USAGE);
    }
}

// Without a fluid the solids are coloured, by node and by cell values.
static void test_solid_alone(void **state)
{
    const struct folder *folder = *state;
    char path[256];
    run_write(folder, SOLID);
    struct picture picture = picture_of(folder, folder_file(folder, "a.png", path));
    picture.field = "Displacement";
    picture.range[0] = 0;
    picture.range[1] = 1;
    assert_int_equal(picture_draw(&picture), 0);
    struct image image = image_read(path);
    assert_colour(&image, left + scale * 0.45, top + scale * 0.18, colour_map(0.25), 2);
    assert_colour(&image, left + scale * 0.55, top + scale * 0.18, colour_map(0.75), 2);
    free(image.rgb);
    picture.field = "VonMises";
    picture.has_range = false; // at the nodes: 1, 2, 3 MPa; means of the elements: 1.5, 2.5
    assert_int_equal(picture_draw(&picture), 0);
    image = image_read(path);
    assert_colour(&image, left + scale * 0.45, top + scale * 0.18, colour_map(0.25), 2);
    free(image.rgb);
}

// One element of a quadratic type over 0.4..0.6 x 0.1..0.2 (a triangle: its lower left half); the middle of
// its lower edge hangs down to 0.06. The values at all nodes are 0.5.
static void curved_write(const struct folder *folder, struct pvd *pvd, enum element_type type)
{
    const int n = element_nodes(type), dim = element_dim(type);
    double x[ELEMENT_MAX_NODES][3] = {{0}}, d[ELEMENT_MAX_NODES][3] = {{0}};
    int64_t nodes[ELEMENT_MAX_NODES];
    const int64_t offset = n;
    const uint8_t cell = (uint8_t)element_vtk(type);
    for (int a = 0; a < n; a++) {
        double xi[3];
        const bool simplex = element_is_simplex(type);
        element_node(type, a, xi);
        x[a][0] = 0.4 + 0.2 * (simplex ? xi[0] : 0.5 * (xi[0] + 1));
        x[a][1] = 0.1 + 0.1 * (simplex ? xi[1] : 0.5 * (xi[1] + 1));
        x[a][2] = dim == 3 ? 0.1 * (simplex ? xi[2] : 0.5 * (xi[2] + 1)) : 0;
        if (fabs(x[a][0] - 0.5) < 1e-9 && x[a][1] < 0.1 + 1e-9)
            x[a][1] = 0.06;
        d[a][0] = 0.5;
        nodes[a] = a;
    }
    const struct vtu_array points[] = {array("Displacement", 3, d)};
    const struct vtu_grid grid = {.n_points = (size_t)n,
                                  .n_cells = 1,
                                  .n_connectivity = (size_t)n,
                                  .points = x,
                                  .points_type = VTU_FLOAT64,
                                  .connectivity = nodes,
                                  .offsets = &offset,
                                  .types = &cell,
                                  .n_point_arrays = 1,
                                  .point_arrays = points};
    grid_write(folder, pvd, "solid-beam", 1, 0, &grid);
}

// Quadratic elements are drawn through the nodes in the middle of their edges.
static void test_curved(void **state)
{
    const struct folder *folder = *state;
    const enum element_type types[] = {ELEMENT_TRI6,  ELEMENT_QUAD8, ELEMENT_QUAD9,
                                       ELEMENT_TET10, ELEMENT_HEX20, ELEMENT_HEX27};
    char path[256];
    mkdir(folder_file(folder, "fields", path), 0777);
    for (size_t k = 0; k < sizeof types / sizeof types[0]; k++) {
        struct pvd pvd;
        assert_int_equal(pvd_create(&pvd, folder_file(folder, "channel.pvd", path)), 0);
        curved_write(folder, &pvd, types[k]);
        assert_int_equal(pvd_write(&pvd), 0);
        pvd_reset(&pvd);
        struct picture picture = picture_of(folder, folder_file(folder, "a.png", path));
        picture.field = "Displacement";
        picture.range[0] = 0;
        picture.range[1] = 1;
        assert_int_equal(picture_draw(&picture), 0);
        struct image image = image_read(path);
        const struct colour white = {255, 255, 255}, half = colour_map(0.5);
        const bool shaded = element_dim(types[k]) == 3;
        assert_colour(&image, left + scale * 0.47, top + scale * (0.3 - 0.12), half, shaded ? 90 : 2);
        assert_colour(&image, left + scale * 0.49, top + scale * (0.3 - 0.08), half, shaded ? 90 : 2);
        const uint8_t *bulge =
            image.rgb + 3 * ((size_t)(top + scale * 0.22) * 1000 + (size_t)(left + scale * 0.49));
        assert_true(bulge[0] + bulge[1] + bulge[2] < 600);
        assert_colour(&image, left + scale * 0.42, top + scale * (0.3 - 0.07), white, 0);
        free(image.rgb);
    }
}

// In 3-D the nearest layer is seen; a slab takes others away.
static void test_space(void **state)
{
    const struct folder *folder = *state;
    char path[256];
    run_write(folder, FLUID | DEEP | SOLID | SURFACE);
    struct picture picture = picture_of(folder, folder_file(folder, "a.png", path));
    assert_int_equal(picture_draw(&picture), 0);
    struct image image = image_read(path);
    double x = left + scale * 0.505, y = top + scale * 0.175; // over the beam, which lies at z = 0: hidden
    const uint8_t *is = image.rgb + 3 * ((size_t)y * 1000 + (size_t)x);
    struct colour at = colour_map(0.5125 / 1.015);
    assert_true(is[1] > is[0] + 20 && is[1] <= at.g + 2);
    free(image.rgb);
    picture.slab[0] = 0.5;
    picture.slab[1] = 0.6; // nothing there: the beam shows
    assert_int_equal(picture_draw(&picture), 0);
    image = image_read(path);
    is = image.rgb + 3 * ((size_t)(top + scale * 0.18) * 1000 + (size_t)(left + scale * 0.45));
    assert_true(abs(is[0] - is[1]) < 8 && is[0] > 180);
    free(image.rgb);
    picture.slab[0] = -0.6;
    picture.slab[1] = -0.5; // the beam stands before it
    assert_int_equal(picture_draw(&picture), 0);
    image = image_read(path);
    assert_colour(&image, left + scale * 0.45, top + scale * 0.18, (struct colour){255, 255, 255}, 0);
    free(image.rgb);
}

static void test_errors(void **state)
{
    const struct folder *folder = *state;
    char path[256], file[256];
    struct picture picture = picture_of(folder, folder_file(folder, "a.png", path));
    assert_int_equal(picture_draw(&picture), STATUS_NO_INPUT); // no .pvd
    run_write(folder, FLUID);
    picture.file = "/nowhere/a.png";
    assert_int_equal(picture_draw(&picture), STATUS_IO);
    picture.file = path;
    picture.range[1] = picture.range[0];
    assert_int_equal(picture_draw(&picture), STATUS_USAGE);
    picture.has_range = false;
    picture.window[1] = -1;
    assert_int_equal(picture_draw(&picture), STATUS_USAGE);
    picture.has_window = false;
    picture.width = 99;
    assert_int_equal(picture_draw(&picture), STATUS_USAGE);
    picture.width = 20000;
    assert_int_equal(picture_draw(&picture), STATUS_USAGE);
    picture.width = 300;
    folder_write(folder_file(folder, "fields/fluid_000002.vtu", file), "<VTKFile>", 9);
    assert_int_equal(picture_draw(&picture), STATUS_IO);
    unlink(file);
    assert_int_equal(picture_draw(&picture), STATUS_NO_INPUT);
    picture.output = "/nowhere";
    assert_int_equal(picture_draw(&picture), STATUS_NO_INPUT);
    assert_int_equal(access(path, F_OK), -1); // nothing was written
}

static void test_colours(void **state)
{
    (void)state;
    const struct colour first = colour_map(-3), last = colour_map(7), bad = colour_map(NAN);
    assert_true(first.r == 0x44 && first.g == 0x01 && first.b == 0x54);
    assert_true(last.r == 0xFD && last.g == 0xE7 && last.b == 0x25);
    assert_true(bad.r > 200 && bad.g < 60);
    double before = 0;
    for (int i = 0; i <= 100; ++i) { // brightness rises all the way: that is what the map is for
        struct colour c = colour_map(i / 100.0);
        double light =
            0.2126 * pow(c.r / 255.0, 2.2) + 0.7152 * pow(c.g / 255.0, 2.2) + 0.0722 * pow(c.b / 255.0, 2.2);
        assert_true(light > before);
        before = light;
    }
}

static void test_lettering(void **state)
{
    (void)state;
    assert_true(lettering_width("", 9) == 0.0);
    assert_true(lettering_width("0", 9) == 6.0);
    assert_true(lettering_width("00", 9) == 15.0);
    assert_true(lettering_width("00", 18) == 30.0);
    assert_true(fabs(lettering_width("m^3", 9) - (11.0 + 9.0 * 0.65 - 3.0)) < 1e-12);
    assert_true(lettering_width("m^", 9) == 8.0);
}

static void test_view(void **state)
{
    const struct folder *folder = *state;
    char path[256];
    const struct view view = {.name = "it's \\ fsi2", .dim = 2, .spacing = 0.00625, .colour = "Velocity"};
    assert_int_equal(view_write(&view, folder_file(folder, "view.py", path)), 0);
    char *text = folder_read(path, NULL);
    assert_non_null(strstr(text, "NAME = 'it\\'s \\\\ fsi2'\n"));
    assert_non_null(strstr(text, "SPACING = 0.0062500000000000003"));
    assert_non_null(strstr(text, "COLOUR = 'Velocity'"));
    assert_null(strstr(text, folder->path));
    free(text);
    assert_int_equal(view_write(&view, "/nowhere/view.py"), STATUS_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_plane, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_decorations, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_frames, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_fields, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_solid_alone, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_curved, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_space, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_errors, folder_enter, folder_leave),
        cmocka_unit_test(test_colours),
        cmocka_unit_test(test_lettering),
        cmocka_unit_test_setup_teardown(test_view, folder_enter, folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
