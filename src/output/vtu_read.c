// SPDX-License-Identifier: GPL-3.0-or-later
// The file may be damaged or hostile: every number in it is checked before it is used, and no array is
// allocated that the compressed bytes at hand could not fill.
#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/vtu.h"
#include "output/vtu_types.h"
#include "output/xml.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
    DEFLATE_RATIO = 1040, // deflate cannot expand more than 1032 : 1 (zlib's technical notes)
    ARRAYS = 32,          // of a kind in struct vtu_file
    COMPONENTS = 9
};

enum section { SECTION_NONE, SECTION_FIELD, SECTION_POINT, SECTION_CELL, SECTION_POINTS, SECTION_CELLS };

struct reader {
    const char *path;
    struct vtu_file *file;
    struct xml_span data; // the bytes of the appended data
    enum section section;
    bool piece;
};

#define DAMAGED(condition, what)                                                                             \
    CHECK(condition, STATUS_IO, "%s: damaged, or not written by skerry: %s", reader->path, what)

static int number_read(const struct reader *reader, const struct xml_span *tag, const char *name,
                       uint64_t limit, uint64_t *number)
{
    char text[32], *end;
    DAMAGED(xml_attribute(tag, name, text, sizeof text) && text[0] >= '0' && text[0] <= '9', name);
    errno = 0;
    *number = strtoull(text, &end, 10);
    DAMAGED(*end == '\0' && errno == 0 && *number <= limit, name);
    return 0;
}

static int type_read(const struct reader *reader, const struct xml_span *tag, enum vtu_type *type)
{
    char text[16];
    DAMAGED(xml_attribute(tag, "type", text, sizeof text), "array without type");
    for (*type = VTU_FLOAT32; *type <= VTU_UINT8; ++*type)
        if (strcmp(text, vtu_type_name(*type)) == 0)
            return 0;
    DAMAGED(false, "array of unknown type");
    return 0;
}

static uint64_t word(const char *data, size_t index)
{
    uint64_t value;
    memcpy(&value, data + index * sizeof value, sizeof value);
    return value;
}

// Sizes of an array at @p data with @p left bytes behind it: number of blocks, uncompressed bytes.
static int sizes_read(const struct reader *reader, const char *data, size_t left, uint64_t *blocks,
                      uint64_t *bytes)
{
    DAMAGED(left >= 24, "array head outside the file");
    uint64_t size = word(data, 1), last = word(data, 2), packed = 0;
    *blocks = word(data, 0);
    DAMAGED(*blocks <= left / 8 - 3, "number of blocks");
    DAMAGED(*blocks == 0 || (size > 0 && size <= UINT32_MAX && last < size), "block size");
    left -= 24 + 8 * *blocks;
    for (uint64_t i = 0; i < *blocks; ++i) {
        uint64_t one = word(data, 3 + i);
        DAMAGED(one <= left - packed, "compressed size");
        packed += one;
    }
    *bytes = *blocks == 0 ? 0 : last > 0 ? (*blocks - 1) * size + last : *blocks * size;
    DAMAGED(*bytes / DEFLATE_RATIO <= packed, "more data announced than there can be");
    return 0;
}

// Read the array at @p offset; *@p memory belongs to the file. @p bytes: expected size, or set when SIZE_MAX
// comes in.
static int data_read(const struct reader *reader, uint64_t offset, size_t *bytes, void **memory)
{
    size_t all = (size_t)(reader->data.end - reader->data.begin);
    DAMAGED(offset <= all, "offset outside the file");
    const char *data = reader->data.begin + offset;
    uint64_t blocks = 0, size = 0;
    CALL(sizes_read(reader, data, all - offset, &blocks, &size));
    DAMAGED(*bytes == SIZE_MAX || *bytes == size, "array of the wrong length");
    *bytes = size;
    struct vtu_file *file = reader->file;
    DAMAGED(file->n_memory < sizeof file->memory / sizeof file->memory[0], "too many arrays");
    unsigned char *to = memory_create(size, 1);
    CHECK_MEMORY(to);
    *memory = file->memory[file->n_memory++] = to;
    const char *from = data + 24 + 8 * blocks;
    uint64_t block = blocks > 0 ? word(data, 1) : 0;
    for (uint64_t i = 0; i < blocks; ++i) {
        uLongf wanted = i + 1 < blocks ? block : size - i * block, got = wanted;
        uint64_t packed = word(data, 3 + i);
        DAMAGED(uncompress(to + i * block, &got, (const Bytef *)from, packed) == Z_OK && got == wanted,
                "compressed data");
        from += packed;
    }
    return 0;
}

static int points_read(struct reader *reader, uint64_t offset, enum vtu_type type, uint64_t components)
{
    struct vtu_grid *grid = &reader->file->grid;
    size_t bytes = 3 * grid->n_points * vtu_type_size(type);
    void *memory;
    DAMAGED(components == 3 && (type == VTU_FLOAT32 || type == VTU_FLOAT64) && !grid->points, "points");
    CALL(data_read(reader, offset, &bytes, &memory));
    grid->points = memory;
    grid->points_type = type;
    return 0;
}

static int cells_read(struct reader *reader, uint64_t offset, enum vtu_type type, const char *name)
{
    struct vtu_grid *grid = &reader->file->grid;
    void *memory;
    if (strcmp(name, "types") == 0) {
        size_t bytes = grid->n_cells;
        DAMAGED(type == VTU_UINT8 && !grid->types, "types");
        CALL(data_read(reader, offset, &bytes, &memory));
        grid->types = memory;
        return 0;
    }
    bool offsets = strcmp(name, "offsets") == 0;
    size_t bytes = offsets ? grid->n_cells * sizeof(int64_t) : SIZE_MAX;
    DAMAGED(type == VTU_INT64 && (offsets ? !grid->offsets : !grid->connectivity), "cells");
    CALL(data_read(reader, offset, &bytes, &memory));
    DAMAGED(bytes % sizeof(int64_t) == 0, "cells");
    if (offsets) {
        grid->offsets = memory;
    } else {
        grid->connectivity = memory;
        grid->n_connectivity = bytes / sizeof(int64_t);
    }
    return 0;
}

static int fields_read(struct reader *reader, uint64_t offset, enum vtu_type type, uint64_t components,
                       const char *name)
{
    struct vtu_file *file = reader->file;
    bool points = reader->section == SECTION_POINT;
    size_t *n = points ? &file->grid.n_point_arrays : &file->grid.n_cell_arrays;
    size_t items = points ? file->grid.n_points : file->grid.n_cells;
    size_t bytes = items * components * vtu_type_size(type);
    DAMAGED(*n < ARRAYS, "too many arrays");
    struct vtu_array *array = points ? &file->point_arrays[*n] : &file->cell_arrays[*n];
    void *memory;
    CALL(data_read(reader, offset, &bytes, &memory));
    *array = (struct vtu_array){.components = (int)components, .type = type, .data = memory};
    memcpy(array->name, name, strlen(name) + 1);
    ++*n;
    return 0;
}

static int array_read(struct reader *reader, const struct xml_span *tag)
{
    char name[sizeof reader->file->point_arrays[0].name], format[16];
    uint64_t offset, components;
    enum vtu_type type;
    DAMAGED(xml_attribute(tag, "Name", name, sizeof name), "array without name");
    if (reader->section == SECTION_FIELD) {
        if (strcmp(name, "TimeValue") == 0)
            reader->file->grid.time = strtod(tag->end + 1, NULL);
        else if (strcmp(name, "Cycle") == 0)
            reader->file->grid.cycle = strtoll(tag->end + 1, NULL, 10);
        return 0;
    }
    DAMAGED(reader->piece && reader->section != SECTION_NONE, "array at an odd place");
    DAMAGED(xml_attribute(tag, "format", format, sizeof format) && strcmp(format, "appended") == 0, "format");
    CALL(type_read(reader, tag, &type));
    CALL(number_read(reader, tag, "NumberOfComponents", COMPONENTS, &components));
    CALL(number_read(reader, tag, "offset", UINT64_MAX, &offset));
    if (reader->section == SECTION_POINTS)
        return points_read(reader, offset, type, components);
    if (reader->section == SECTION_CELLS)
        return cells_read(reader, offset, type, name);
    return fields_read(reader, offset, type, components, name);
}

static int root_check(const struct reader *reader, const struct xml_span *tag)
{
    static const char *const expected[][2] = {{"type", "UnstructuredGrid"},
                                              {"byte_order", VTU_BYTE_ORDER},
                                              {"header_type", "UInt64"},
                                              {"compressor", "vtkZLibDataCompressor"}};
    char text[32];
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; ++i)
        DAMAGED(xml_attribute(tag, expected[i][0], text, sizeof text) && strcmp(text, expected[i][1]) == 0,
                expected[i][0]);
    return 0;
}

static int tag_read(struct reader *reader, const struct xml_span *tag)
{
    static const char *const sections[] = {"?", "FieldData", "PointData", "CellData", "Points", "Cells"};
    for (int s = SECTION_FIELD; s <= SECTION_CELLS; ++s)
        if (xml_is(tag, sections[s]))
            reader->section = (enum section)s;
    if (xml_is(tag, "VTKFile"))
        return root_check(reader, tag);
    if (xml_is(tag, "DataArray"))
        return array_read(reader, tag);
    if (xml_is(tag, "Piece")) {
        uint64_t points, cells;
        DAMAGED(!reader->piece, "several pieces");
        CALL(number_read(reader, tag, "NumberOfPoints", INT64_MAX / 256, &points));
        CALL(number_read(reader, tag, "NumberOfCells", INT64_MAX / 256, &cells));
        reader->piece = true;
        reader->file->grid.n_points = points;
        reader->file->grid.n_cells = cells;
    }
    return 0;
}

static int cells_check(const struct reader *reader)
{
    const struct vtu_grid *grid = &reader->file->grid;
    DAMAGED(reader->piece && grid->points && grid->connectivity && grid->offsets && grid->types,
            "points or cells are missing");
    int64_t previous = 0, n = (int64_t)grid->n_connectivity;
    for (size_t i = 0; i < grid->n_cells; ++i) {
        DAMAGED(grid->offsets[i] >= previous && grid->offsets[i] <= n, "offset of a cell");
        previous = grid->offsets[i];
    }
    DAMAGED(previous == n, "offset of the last cell");
    for (size_t i = 0; i < grid->n_connectivity; ++i)
        DAMAGED(grid->connectivity[i] >= 0 && (uint64_t)grid->connectivity[i] < grid->n_points,
                "node of a cell");
    return 0;
}

static int text_read(struct reader *reader, const char *text, size_t size)
{
    const size_t tail = strlen(VTU_END);
    DAMAGED(size >= tail && memcmp(text + size - tail, VTU_END, tail) == 0, "the end is missing");
    struct xml_span rest = {text, text + size}, tag;
    bool root = false, appended = false;
    // The data come behind the declarations: find them first, then read the declarations.
    while (!appended && xml_next(&rest, &tag)) {
        root |= xml_is(&tag, "VTKFile");
        appended = xml_is(&tag, "AppendedData");
    }
    const size_t mark = strlen(VTU_APPENDED);
    DAMAGED(root && appended, "no appended data");
    const char *start = tag.begin - 1, *end = text + size - tail;
    DAMAGED((size_t)(end - start) >= mark && start < end && memcmp(start, VTU_APPENDED, mark) == 0,
            "no appended data");
    reader->data = (struct xml_span){start + mark, end};
    rest = (struct xml_span){text, start};
    while (xml_next(&rest, &tag))
        CALL(tag_read(reader, &tag));
    return cells_check(reader);
}

int vtu_read(struct vtu_file *file, const char *path)
{
    char *text;
    size_t size;
    memset(file, 0, sizeof *file);
    CALL(file_read(path, SIZE_MAX / 4, &text, &size));
    struct reader reader = {.path = path, .file = file};
    int status = text_read(&reader, text, size);
    memory_free(text);
    if (status) {
        vtu_file_reset(file);
        return status;
    }
    file->grid.point_arrays = file->point_arrays;
    file->grid.cell_arrays = file->cell_arrays;
    return 0;
}

void vtu_file_reset(struct vtu_file *file)
{
    for (size_t i = 0; i < file->n_memory; ++i)
        memory_free(file->memory[i]);
    memset(file, 0, sizeof *file);
}
