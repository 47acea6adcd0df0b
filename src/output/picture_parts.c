// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/picture_parts.h"

#include "output/series.h"

#include <math.h>
#include <string.h>

// VTK cell types and the faces (sides) of the solid ones.
enum {
    VTK_VERTEX = 1,
    VTK_LINE = 3,
    VTK_TRIANGLE = 5,
    VTK_QUAD = 9,
    VTK_TETRA = 10,
    VTK_HEXAHEDRON = 12,
    VTK_QUADRATIC_TRIANGLE = 22,
    VTK_QUADRATIC_QUAD = 23,
    VTK_QUADRATIC_TETRA = 24,
    VTK_QUADRATIC_HEXAHEDRON = 25,
    VTK_BIQUADRATIC_QUAD = 28,
    VTK_TRIQUADRATIC_HEXAHEDRON = 29,
    FACE_NODES = 8
};

// Faces go round through the nodes in the middle of their edges.
struct cell_kind {
    int type, nodes, n_faces, face_nodes;
    int faces[6][FACE_NODES];
};

static const struct cell_kind kinds[] = {
    {VTK_TRIANGLE, 3, 1, 3, {{0, 1, 2}}},
    {VTK_QUAD, 4, 1, 4, {{0, 1, 2, 3}}},
    {VTK_TETRA, 4, 4, 3, {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}},
    {VTK_HEXAHEDRON,
     8,
     6,
     4,
     {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
    {VTK_QUADRATIC_TRIANGLE, 6, 1, 6, {{0, 3, 1, 4, 2, 5}}},
    {VTK_QUADRATIC_QUAD, 8, 1, 8, {{0, 4, 1, 5, 2, 6, 3, 7}}},
    {VTK_BIQUADRATIC_QUAD, 9, 1, 8, {{0, 4, 1, 5, 2, 6, 3, 7}}},
    {VTK_QUADRATIC_TETRA,
     10,
     4,
     6,
     {{0, 4, 1, 5, 2, 6}, {0, 4, 1, 8, 3, 7}, {1, 5, 2, 9, 3, 8}, {0, 6, 2, 9, 3, 7}}},
    {VTK_QUADRATIC_HEXAHEDRON,
     20,
     6,
     8,
     {{0, 8, 1, 9, 2, 10, 3, 11},
      {4, 12, 5, 13, 6, 14, 7, 15},
      {0, 8, 1, 17, 5, 12, 4, 16},
      {1, 9, 2, 18, 6, 13, 5, 17},
      {2, 10, 3, 19, 7, 14, 6, 18},
      {3, 11, 0, 16, 4, 15, 7, 19}}},
    {VTK_TRIQUADRATIC_HEXAHEDRON,
     27,
     6,
     8,
     {{0, 8, 1, 9, 2, 10, 3, 11},
      {4, 12, 5, 13, 6, 14, 7, 15},
      {0, 8, 1, 17, 5, 12, 4, 16},
      {1, 9, 2, 18, 6, 13, 5, 17},
      {2, 10, 3, 19, 7, 14, 6, 18},
      {3, 11, 0, 16, 4, 15, 7, 19}}}};

static const struct colour solid_fill = {206, 209, 214}, edge_colour = {96, 102, 112},
                           wall_fill = {168, 172, 180}, line_colour = {30, 33, 40};

// Layers of a 2-D picture, pixels towards the viewer; particles come to less than 1e5.
static const double layer_solid = 1e6, layer_edge = 2e6, layer_line = 3e6;

static void place(const struct scene *scene, const struct scene_part *part, const struct picture_frame *frame,
                  int64_t node, double layer, double p[3])
{
    double x[3];
    series_point(&part->file.grid, (size_t)node, x);
    p[0] = frame->x0 + (x[0] - frame->left) * frame->scale;
    p[1] = frame->y0 + (frame->top - x[1]) * frame->scale;
    p[2] = scene->dim == 3 ? x[2] * frame->scale : layer;
}

static struct colour value_colour(const struct picture_frame *frame, double value)
{
    return colour_map((value - frame->range[0]) / (frame->range[1] - frame->range[0]));
}

// Small discs grow to cover the gaps between them: white between dots of a few pixels would only grey the
// colours.
static double disc_radius(double diameter)
{
    const double crisp = 12.0, dense = 5.0; // pixels
    double w = fmin(1.0, fmax(0.0, (crisp - diameter) / (crisp - dense)));
    return fmax(0.75, diameter * ((1.0 - w) * 0.5 + w * 0.85));
}

static void particle_draw(struct canvas *canvas, const struct scene *scene, const struct scene_part *part,
                          const struct picture_frame *frame, int64_t node)
{
    double p[3], diameter = part->size * frame->scale;
    struct colour colour = part->values ? value_colour(frame, part->values[node]) : wall_fill;
    place(scene, part, frame, node, 0.0, p);
    if (scene->dim < 3) {
        canvas_disc(canvas, p[0], p[1], p[2], disc_radius(diameter), colour);
        return;
    }
    double z = p[2] / frame->scale;
    if (frame->slab[0] < frame->slab[1] && (z < frame->slab[0] || z > frame->slab[1]))
        return;
    canvas_ball(canvas, p[0], p[1], p[2], fmax(0.75, 0.72 * diameter), colour);
}

// How bright a face is in 3-D: by its normal, lit from the viewer's side.
static double face_light(const double corners[3][3])
{
    double a[3], b[3];
    for (int c = 0; c < 3; ++c) {
        a[c] = corners[1][c] - corners[0][c];
        b[c] = corners[2][c] - corners[0][c];
    }
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return length > 0.0 ? 0.55 + 0.45 * fabs(n[2]) / length : 1.0;
}

// Fill a polygon: triangles and quads by their halves, others by triangles about the mean of their corners.
static void polygon_fill(struct canvas *canvas, const double (*corners)[3], int n, struct colour colour)
{
    double triangle[3][3] = {{0}};
    for (int k = 0; n > 4 && k < n; ++k)
        for (int c = 0; c < 3; ++c)
            triangle[0][c] += corners[k][c] / n;
    if (n <= 4)
        memcpy(triangle[0], corners[0], sizeof triangle[0]);
    for (int k = n > 4 ? 0 : 1; k < (n > 4 ? n : n - 1); ++k) {
        memcpy(triangle[1], corners[k], sizeof triangle[1]);
        memcpy(triangle[2], corners[(k + 1) % n], sizeof triangle[2]);
        canvas_triangle(canvas, (const double(*)[3])triangle, colour);
    }
}

static void face_draw(struct canvas *canvas, const struct scene *scene, const struct scene_part *part,
                      const struct picture_frame *frame, const struct cell_kind *kind, const int64_t *nodes,
                      const int *face)
{
    double corners[FACE_NODES][3], sum = 0.0;
    int n = kind->face_nodes;
    for (int k = 0; k < n; ++k) {
        place(scene, part, frame, nodes[face[k]], layer_solid, corners[k]);
        sum += part->values ? part->values[nodes[face[k]]] : 0.0;
    }
    bool fill = scene->dim < 3 || strncmp(part->name, "solid", 5) == 0;
    if (fill) {
        struct colour colour = part->values ? value_colour(frame, sum / n) : solid_fill;
        if (scene->dim == 3) {
            double plane[3][3]; // three corners: with nodes in between every second one
            for (int k = 0; k < 3; ++k)
                memcpy(plane[k], corners[n > 4 ? 2 * k : k], sizeof plane[k]);
            colour = colour_shade(colour, face_light((const double(*)[3])plane));
        }
        polygon_fill(canvas, (const double(*)[3])corners, n, colour);
    }
    for (int k = 0; k < n; ++k) {
        double from[3], to[3], width = fmax(0.5, 0.05 * frame->letter);
        place(scene, part, frame, nodes[face[k]], layer_edge, from);
        place(scene, part, frame, nodes[face[(k + 1) % n]], layer_edge, to);
        if (scene->dim == 3) {
            from[2] += 1.0; // pixel: the edge lies on the face, and is to be seen
            to[2] += 1.0;
        }
        canvas_line(canvas, from, to, width, edge_colour);
    }
}

static void line_draw(struct canvas *canvas, const struct scene *scene, const struct scene_part *part,
                      const struct picture_frame *frame, const int64_t *nodes)
{
    double from[3], to[3];
    place(scene, part, frame, nodes[0], layer_line, from);
    place(scene, part, frame, nodes[1], layer_line, to);
    canvas_line(canvas, from, to, fmax(1.0, 0.14 * frame->letter), line_colour);
}

// Whether an element or a facet stands before the slab, so that it would hide what lies in it.
static bool hides_slab(const struct scene *scene, const struct scene_part *part,
                       const struct picture_frame *frame, const int64_t *nodes, int64_t n)
{
    double sum = 0.0;
    if (scene->dim < 3 || !(frame->slab[0] < frame->slab[1]))
        return false;
    for (int64_t k = 0; k < n; ++k) {
        double x[3];
        series_point(&part->file.grid, (size_t)nodes[k], x);
        sum += x[2];
    }
    return sum > (double)n * frame->slab[1];
}

void picture_part_draw(struct canvas *canvas, const struct scene *scene, const struct scene_part *part,
                       const struct picture_frame *frame)
{
    const struct vtu_grid *grid = &part->file.grid;
    int64_t begin = 0;
    for (size_t e = 0; e < grid->n_cells; begin = grid->offsets[e++]) {
        const int64_t *nodes = grid->connectivity + begin, n = grid->offsets[e] - begin;
        if (grid->types[e] == VTK_VERTEX && n == 1)
            particle_draw(canvas, scene, part, frame, nodes[0]);
        else if (hides_slab(scene, part, frame, nodes, n))
            continue;
        if (grid->types[e] == VTK_LINE && n == 2)
            line_draw(canvas, scene, part, frame, nodes);
        for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; ++k)
            if (kinds[k].type == grid->types[e] && kinds[k].nodes == n)
                for (int f = 0; f < kinds[k].n_faces; ++f)
                    face_draw(canvas, scene, part, frame, &kinds[k], nodes, kinds[k].faces[f]);
    }
}
