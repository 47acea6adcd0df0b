// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/vti.h"

#include "base/error.h"
#include "base/memory.h"
#include "output/appended.h"

#include <stdio.h>

static void head_write(FILE *stream, const void *what, struct appended_item *items)
{
    const struct vti_image *image = what;
    const size_t *n = image->n;
    const double *o = image->origin, *s = image->spacing;
    char extent[80], attributes[384];
    snprintf(extent, sizeof extent, "0 %zu 0 %zu 0 %zu", n[0] - 1, n[1] - 1, n[2] - 1);
    snprintf(attributes, sizeof attributes,
             " WholeExtent=\"%s\" Origin=\"%.17g %.17g %.17g\" Spacing=\"%.17g %.17g %.17g\"", extent, o[0],
             o[1], o[2], s[0], s[1], s[2]);
    appended_begin(stream, "ImageData", attributes, image->time, image->cycle);
    fprintf(stream, "<Piece Extent=\"%s\">\n", extent);
    appended_point_data(stream, image->scalars, image->vectors);
    for (size_t i = 0; i < image->n_arrays; ++i)
        appended_declare(stream, &items[i]);
    fputs("</PointData>\n<CellData>\n</CellData>\n</Piece>\n</ImageData>\n", stream);
}

int vti_write(const char *path, const struct vti_image *image)
{
    const size_t points = image->n[0] * image->n[1] * image->n[2];
    struct appended_item *items = memory_create(image->n_arrays, sizeof *items);
    CHECK_MEMORY(items);
    for (size_t i = 0; i < image->n_arrays; ++i)
        items[i] = appended_array(&image->arrays[i], points);
    int status = appended_write(path, head_write, image, items, image->n_arrays);
    memory_free(items);
    return status;
}
