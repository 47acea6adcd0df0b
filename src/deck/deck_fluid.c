// SPDX-License-Identifier: GPL-3.0-or-later
// Section <fluid>: method, regions, shapes.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { POINT_FILE_LIMIT = 1 << 30 }; // bytes

static void read_box(struct deck *deck, const struct deck_node *node, struct shape *shape)
{
    size_t before = deck->n_problems;
    shape->kind = SHAPE_BOX;
    deck_vector(deck, node, "lower", shape->a);
    deck_vector(deck, node, "upper", shape->b);
    for (int d = 0; d < deck->model->dim && deck->n_problems == before; d++)
        if (!(shape->a[d] < shape->b[d]))
            deck_error(deck, node, "upper",
                       "upper corner %.9g is not above lower corner %.9g in direction %c", shape->b[d],
                       shape->a[d], "xyz"[d]);
}

static void read_round(struct deck *deck, const struct deck_node *node, struct shape *shape)
{
    size_t before = deck->n_problems;
    shape->radius = deck_real(deck, node, "radius");
    if (node->id == SCHEMA_DISC)
        deck_need_dim(deck, node, 2, deck->model->dim == 1 ? "<box>" : "<ball>");
    else if (node->id == SCHEMA_BALL)
        deck_need_dim(deck, node, 3, deck->model->dim == 1 ? "<box>" : "<disc>");
    else if (node->id == SCHEMA_ANNULUS)
        deck_need_dim(deck, node, 2, deck->model->dim == 1 ? "<box>" : "<cylinder>");
    else
        deck_need_dim(deck, node, 3, deck->model->dim == 1 ? "<box>" : "<annulus> or <disc>");
    if (deck->n_problems > before)
        return;
    shape->kind = node->id == SCHEMA_DISC || node->id == SCHEMA_BALL ? SHAPE_BALL : SHAPE_CYLINDER;
    deck_vector(deck, node, node->id == SCHEMA_CYLINDER_SHAPE ? "from" : "centre", shape->a);
    memcpy(shape->b, shape->a, sizeof shape->b);
    if (node->id == SCHEMA_CYLINDER_SHAPE)
        deck_vector(deck, node, "to", shape->b);
    if (shape->kind == SHAPE_CYLINDER)
        shape->inner_radius = deck_real(deck, node, "inner-radius");
    if (deck->n_problems == before && shape->inner_radius >= shape->radius)
        deck_error(deck, node, "inner-radius", "inner radius %.9g is not less than the radius %.9g",
                   shape->inner_radius, shape->radius);
    if (deck->n_problems == before && node->id == SCHEMA_CYLINDER_SHAPE &&
        memcmp(shape->a, shape->b, sizeof shape->a) == 0)
        deck_error(deck, node, "to", "both ends of the axis are the same point");
}

static void read_half_space(struct deck *deck, const struct deck_node *node, struct shape *shape)
{
    size_t before = deck->n_problems;
    shape->kind = SHAPE_HALF_SPACE;
    deck_vector(deck, node, "point", shape->a);
    deck_vector(deck, node, "normal", shape->b);
    double length = sqrt(shape->b[0] * shape->b[0] + shape->b[1] * shape->b[1] + shape->b[2] * shape->b[2]);
    if (deck->n_problems == before && length == 0.0)
        deck_error(deck, node, "normal", "the normal must not be zero");
    for (int d = 0; d < 3 && length > 0.0; d++)
        shape->b[d] /= length;
}

/** The solid side of a surface: of facets by their distance, of analytic surfaces by the shape they bound. */
static void read_inside(struct deck *deck, const struct deck_node *node, struct shape *shape)
{
    const struct model *model = deck->model;
    int index = deck_reference(deck, node, "surface", "surface", model->surfaces, model->n_surfaces,
                               sizeof *model->surfaces);
    if (index < 0)
        return;
    const struct model_surface *surface = &model->surfaces[index];
    memcpy(shape->a, surface->centre, sizeof shape->a);
    if (surface->kind == SURFACE_FACETS) {
        shape->kind = SHAPE_FACETS;
        shape->facets = &surface->built;
    } else if (surface->kind == SURFACE_PLANE) {
        shape->kind = SHAPE_HALF_SPACE;
        memcpy(shape->b, surface->axis, sizeof shape->b);
    } else if (!surface->fluid_inside && (surface->kind == SURFACE_SPHERE || model->dim == 2)) {
        shape->kind = SHAPE_BALL;
        shape->radius = surface->radius;
    } else {
        deck_error(deck, node, "surface",
                   "surface \"%s\" has no bounded inside: describe the region by its shape", surface->name);
    }
}

int deck_read_shape(struct deck *deck, const struct deck_node *node, struct shape *shape)
{
    switch (node->id) {
    case SCHEMA_BOX:
        read_box(deck, node, shape);
        return deck->status;
    case SCHEMA_POLYGON:
        deck_need_dim(deck, node, 2, "<inside> with a closed surface");
        shape->kind = SHAPE_POLYGON;
        shape->n_points = deck_points(deck, node, "points", &shape->points);
        if (shape->n_points < 3)
            deck_error(deck, node, "points", "has %zu corners; a polygon has at least 3", shape->n_points);
        return deck->status;
    case SCHEMA_HALF_SPACE:
        read_half_space(deck, node, shape);
        return deck->status;
    case SCHEMA_INSIDE:
        read_inside(deck, node, shape);
        return deck->status;
    case SCHEMA_UNION:
    case SCHEMA_INTERSECTION:
    case SCHEMA_DIFFERENCE:
        break;
    default:
        read_round(deck, node, shape);
        return deck->status;
    }
    shape->kind = node->id == SCHEMA_UNION          ? SHAPE_UNION
                  : node->id == SCHEMA_INTERSECTION ? SHAPE_INTERSECTION
                                                    : SHAPE_DIFFERENCE;
    size_t n = 0;
    for (const struct deck_node *child = node->children; child; child = child->next)
        n++;
    CHECK_MEMORY(shape->children = memory_create(n, sizeof *shape->children));
    for (const struct deck_node *child = node->children; child; child = child->next)
        CALL(deck_read_shape(deck, child, &shape->children[shape->n_children++]));
    return deck->status;
}

/** The path of a file named in the deck: in the deck's folder or below. NULL after noting why not. */
static char *file_beside_deck(struct deck *deck, const struct deck_node *node, const char *name)
{
    const char *slash = strrchr(deck->path, '/');
    char *joined = memory_print("%.*s%s", slash ? (int)(slash - deck->path + 1) : 0, deck->path, name);
    char *folder = memory_print("%.*s.", slash ? (int)(slash - deck->path + 1) : 0, deck->path);
    char *real = joined ? realpath(joined, NULL) : NULL,
         *real_folder = folder ? realpath(folder, NULL) : NULL;
    struct stat information;
    bool below = real && real_folder && strncmp(real, real_folder, strlen(real_folder)) == 0 &&
                 real[strlen(real_folder)] == '/';
    if (!joined || !folder)
        deck->status = STATUS_MEMORY;
    else if (name[0] == '/' || strstr(name, "..") || (real && !below))
        deck_error(deck, node, "file", "\"%.200s\" is not in the deck's folder or below it", name);
    else if (!real || stat(real, &information))
        deck_error(deck, node, "file", "there is no file \"%.200s\" beside the deck", name);
    else if (!S_ISREG(information.st_mode) || information.st_size > POINT_FILE_LIMIT)
        deck_error(deck, node, "file", "\"%.200s\" is not a regular file of at most 1 GiB", name);
    else {
        free(real);
        free(real_folder);
        memory_free(folder);
        return joined;
    }
    free(real);
    free(real_folder);
    memory_free(folder);
    memory_free(joined);
    return NULL;
}

/** Particles at given places. */
static int read_point_list(struct deck *deck, const struct deck_node *node, struct model_region *region)
{
    const size_t dim = (size_t)deck->model->dim;
    const char *file = deck_text(node, "file");
    const bool has_text = node->text[strspn(node->text, " \t\r\n")] != '\0';
    char *data = NULL;
    size_t size = 0;
    if (file && has_text)
        deck_error(deck, node, "file", "takes a file or numbers, not both");
    if (file) {
        char *path = file_beside_deck(deck, node, file);
        int status = path ? file_read(path, POINT_FILE_LIMIT, &data, &size) : 0;
        if (status)
            deck_error(deck, node, "file", "\"%.200s\" cannot be read", file);
        if (data && deck_note_input(deck, file, path, data, size))
            deck->status = STATUS_MEMORY;
        memory_free(path);
        if (!data)
            return deck->status;
    }
    double *values = NULL;
    size_t before = deck->n_problems;
    size_t n = deck_numbers(deck, node, data ? data : node->text, dim, &values);
    memory_free(data);
    if (deck->n_problems == before && !deck->status)
        region->points = deck_memory(deck, n, sizeof *region->points);
    for (size_t i = 0; region->points && i < n; i++)
        memcpy(region->points[i], values + i * dim, dim * sizeof *values);
    region->n_points = region->points ? n : 0;
    memory_free(values);
    return deck->status;
}

int deck_read_region(struct deck *deck, struct deck_node *node, struct model_region *region)
{
    const int dim = deck->model->dim;
    region->where = node->where;
    region->has_origin = deck_vector(deck, node, "origin", region->origin);
    deck_expressions(deck, node, "velocity", region->velocity);
    if (!node->children || node->children->next) {
        deck_error(deck, node, NULL,
                   "takes exactly one shape or one <points>; put several shapes into a <union>");
        return deck->status;
    }
    if (node->children->id == SCHEMA_POINT_LIST)
        return read_point_list(deck, node->children, region);
    size_t before = deck->n_problems;
    CALL(deck_read_shape(deck, node->children, &region->shape));
    if (deck->n_problems > before || deck->n_errors > 0) // surfaces may be unusable
        return deck->status;
    double lower[3], upper[3];
    shape_bounds(&region->shape, dim, lower, upper);
    for (int d = 0; d < dim; d++)
        if (!isfinite(lower[d]) || !isfinite(upper[d])) {
            deck_error(deck, node, NULL, "reaches to infinity in direction %c: intersect it with a box",
                       "xyz"[d]);
            return deck->status;
        }
    if (!region->has_origin) {
        region->has_origin = true;
        memcpy(region->origin, lower, (size_t)dim * sizeof *lower);
        char text[128] = "";
        for (int d = 0, used = 0; d < dim; d++)
            used += snprintf(text + used, sizeof text - (size_t)used, "%s%.17g", d ? " " : "", lower[d]);
        deck_fill(deck, node, "origin", "%s", text);
    }
    return deck->status;
}

int deck_read_fluid(struct deck *deck)
{
    const struct deck_node *node = deck_child(deck->root, SCHEMA_FLUID);
    struct model *model = deck->model;
    struct model_fluid *fluid = &model->fluid;
    fluid->material = -1;
    if (!node)
        return deck->status;
    fluid->present = true;
    fluid->where = node->where;
    fluid->formulation = deck_word(deck, node, "formulation");
    fluid->material = deck_reference(deck, node, "material", "fluid material", model->fluid_materials,
                                     model->n_fluid_materials, sizeof *model->fluid_materials);
    fluid->kernel = deck_word(deck, node, "kernel");
    fluid->kernel_constant =
        deck_choice(deck, node, "kernel-constant") == 1 ? KERNEL_PUBLISHED : KERNEL_EXACT;
    fluid->spacing = deck_real(deck, node, "spacing");
    fluid->smoothing_length_ratio = deck_real(deck, node, "smoothing-length-ratio");
    fluid->damping = deck_real(deck, node, "damping");
    fluid->arithmetic = deck_choice(deck, node, "arithmetic") == 1 ? ARITHMETIC_DOUBLE : ARITHMETIC_MIXED;
    fluid->convective_stress = deck_choice(deck, node, "convective-stress") == 0;
    CHECK_MEMORY(fluid->regions = memory_create(deck_count(node, SCHEMA_REGION), sizeof *fluid->regions));
    for (struct deck_node *region = deck_child(node, SCHEMA_REGION); region; region = deck_next(region))
        CALL(deck_read_region(deck, region, &fluid->regions[fluid->n_regions++]));
    return deck->status;
}
