// SPDX-License-Identifier: GPL-3.0-or-later
// Byte layout of the appended, compressed arrays (VTK XML formats, https://docs.vtk.org, "VTKXMLFileFormat"),
// all numbers uint64 in the byte order of the file:
//     blocks | block size | size of a partial last block or 0 | compressed size of each block | zlib streams
// Offsets count from the byte behind the underscore of <AppendedData>.
#include "output/vtu.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/vtu_types.h"
#include "output/xml.h"

#include <inttypes.h>
#include <stdbool.h>
#include <string.h>
#include <zlib.h>

enum {
    BATCH = 32,       // blocks compressed side by side; also bounds the memory: 32 x 512 KiB
    OFFSET_WIDTH = 24 // room in the head for an offset that is known after compression
};

enum source { SOURCE_MEMORY, SOURCE_INDEX, SOURCE_NEXT_INDEX, SOURCE_VERTEX };

// One array of the file; vertex cells are generated block by block instead of being kept.
struct item {
    const char *name;
    int components;
    enum vtu_type type;
    enum source source;
    const char *data;
    size_t bytes;
    long place;      // in the file, of the room for its offset
    uint64_t offset; // of its data
};

struct writer {
    FILE *stream;
    char *raw, *packed; // BATCH blocks each; raw only for generated arrays
    size_t bound;       // largest size of a compressed block
    uint64_t written;   // bytes of data so far
};

// Compression. Of level 1's saving on particle data (smooth fields with noise, 2-D) Z_RLE alone keeps 80 %
// at 1.75 times the speed: it finds no repetition of multi-byte words. Integers and constant blocks therefore
// go through level 1, which is as fast there, and the rest through Z_RLE: 91 % at 1.8 times the speed.
static int strategy_choose(const struct item *item, const char *raw, size_t n)
{
    size_t size = vtu_type_size(item->type);
    bool real = item->type == VTU_FLOAT32 || item->type == VTU_FLOAT64;
    bool constant = n > size && memcmp(raw, raw + size, n - size) == 0;
    return real && !constant ? Z_RLE : Z_DEFAULT_STRATEGY;
}

static bool block_compress(const struct item *item, const char *raw, size_t n, char *packed, size_t bound,
                           uint64_t *size)
{
    z_stream stream;
    memset(&stream, 0, sizeof stream);
    if (deflateInit2(&stream, 1, Z_DEFLATED, MAX_WBITS, 8, strategy_choose(item, raw, n)) != Z_OK)
        return false;
    stream.next_in = (Bytef *)raw;
    stream.avail_in = (uInt)n;
    stream.next_out = (Bytef *)packed;
    stream.avail_out = (uInt)bound;
    bool good = deflate(&stream, Z_FINISH) == Z_STREAM_END;
    *size = stream.total_out;
    deflateEnd(&stream);
    return good;
}

static const char *block_source(const struct item *item, size_t block, size_t n, char *raw)
{
    size_t start = block * VTU_BLOCK;
    if (item->source == SOURCE_MEMORY)
        return item->data + start;
    if (item->source == SOURCE_VERTEX) {
        memset(raw, 1, n); // VTK_VERTEX
        return raw;
    }
    int64_t first = (int64_t)(start / sizeof(int64_t)) + (item->source == SOURCE_NEXT_INDEX);
    for (size_t i = 0; i < n / sizeof(int64_t); ++i) {
        int64_t value = first + (int64_t)i;
        memcpy(raw + i * sizeof value, &value, sizeof value);
    }
    return raw;
}

// Compress and write blocks [first, first + n); their sizes go to @p sizes.
static int batch_write(struct writer *writer, const struct item *item, size_t first, size_t n,
                       uint64_t *sizes)
{
    int failed = 0;
#pragma omp parallel for schedule(dynamic, 1) reduction(max : failed)
    for (size_t i = 0; i < n; ++i) {
        size_t left = item->bytes - (first + i) * VTU_BLOCK, size = left < VTU_BLOCK ? left : VTU_BLOCK;
        const char *raw =
            block_source(item, first + i, size, writer->raw ? writer->raw + i * VTU_BLOCK : NULL);
        if (!block_compress(item, raw, size, writer->packed + i * writer->bound, writer->bound, &sizes[i]))
            failed = 1;
    }
    CHECK(!failed, STATUS_MEMORY, "out of memory while compressing array %s", item->name);
    for (size_t i = 0; i < n; ++i) {
        fwrite(writer->packed + i * writer->bound, 1, sizes[i], writer->stream);
        writer->written += sizes[i];
    }
    return 0;
}

static int item_write(struct writer *writer, struct item *item)
{
    size_t blocks = (item->bytes + VTU_BLOCK - 1) / VTU_BLOCK;
    uint64_t *head = memory_create(3 + blocks, sizeof *head);
    CHECK_MEMORY(head);
    if (blocks > 0) {
        head[0] = blocks;
        head[1] = VTU_BLOCK;
        head[2] = item->bytes % VTU_BLOCK;
    }
    item->offset = writer->written;
    long place = ftell(writer->stream);
    fwrite(head, sizeof *head, 3 + blocks, writer->stream);
    writer->written += (3 + blocks) * sizeof *head;
    int status = 0;
    for (size_t first = 0; first < blocks && !status; first += BATCH) {
        size_t n = blocks - first < BATCH ? blocks - first : BATCH;
        status = batch_write(writer, item, first, n, head + 3 + first);
    }
    if (!status && blocks > 0) { // the sizes are known now
        fseek(writer->stream, place, SEEK_SET);
        fwrite(head, sizeof *head, 3 + blocks, writer->stream);
        fseek(writer->stream, 0, SEEK_END);
    }
    memory_free(head);
    return status;
}

static void item_declare(FILE *stream, struct item *item)
{
    fprintf(stream, "<DataArray type=\"%s\" Name=\"", vtu_type_name(item->type));
    xml_write(stream, item->name);
    fprintf(stream, "\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"0\"", item->components);
    item->place = ftell(stream) - 2;
    fprintf(stream, "%*s/>\n", OFFSET_WIDTH, "");
}

static void default_array(FILE *stream, const char *kind, const char *name)
{
    if (name) {
        fprintf(stream, " %s=\"", kind);
        xml_write(stream, name);
        fputc('"', stream);
    }
}

// Items in file order: point arrays, cell arrays, points, connectivity, offsets, types.
static void head_write(FILE *stream, const struct vtu_grid *grid, struct item *items)
{
    size_t n_cells = grid->connectivity ? grid->n_cells : grid->n_points;
    fprintf(stream,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"%s\" "
            "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n<FieldData>\n"
            "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">%.17g"
            "</DataArray>\n<DataArray type=\"Int64\" Name=\"Cycle\" NumberOfTuples=\"1\" format=\"ascii\">"
            "%" PRId64 "</DataArray>\n</FieldData>\n<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n"
            "<PointData",
            VTU_BYTE_ORDER, grid->time, grid->cycle, grid->n_points, n_cells);
    default_array(stream, "Scalars", grid->scalars);
    default_array(stream, "Vectors", grid->vectors);
    fputs(">\n", stream);
    for (size_t i = 0; i < grid->n_point_arrays; ++i)
        item_declare(stream, items++);
    fputs("</PointData>\n<CellData>\n", stream);
    for (size_t i = 0; i < grid->n_cell_arrays; ++i)
        item_declare(stream, items++);
    fputs("</CellData>\n<Points>\n", stream);
    item_declare(stream, items++);
    fputs("</Points>\n<Cells>\n", stream);
    for (int i = 0; i < 3; ++i)
        item_declare(stream, items++);
    fputs("</Cells>\n</Piece>\n</UnstructuredGrid>\n" VTU_APPENDED, stream);
}

static void items_fill(struct item *items, const struct vtu_grid *grid)
{
    bool vertices = !grid->connectivity;
    size_t n_cells = vertices ? grid->n_points : grid->n_cells;
    size_t n_connectivity = vertices ? grid->n_points : grid->n_connectivity;
    for (size_t i = 0; i < grid->n_point_arrays + grid->n_cell_arrays; ++i) {
        bool points = i < grid->n_point_arrays;
        const struct vtu_array *array =
            points ? &grid->point_arrays[i] : &grid->cell_arrays[i - grid->n_point_arrays];
        size_t n = (points ? grid->n_points : n_cells) * (size_t)array->components;
        *items++ = (struct item){.name = array->name,
                                 .components = array->components,
                                 .type = array->type,
                                 .data = array->data,
                                 .bytes = n * vtu_type_size(array->type)};
    }
    *items++ = (struct item){.name = "Points",
                             .components = 3,
                             .type = grid->points_type,
                             .data = grid->points,
                             .bytes = 3 * grid->n_points * vtu_type_size(grid->points_type)};
    *items++ = (struct item){.name = "connectivity",
                             .components = 1,
                             .type = VTU_INT64,
                             .source = vertices ? SOURCE_INDEX : SOURCE_MEMORY,
                             .data = (const char *)grid->connectivity,
                             .bytes = n_connectivity * sizeof(int64_t)};
    *items++ = (struct item){.name = "offsets",
                             .components = 1,
                             .type = VTU_INT64,
                             .source = vertices ? SOURCE_NEXT_INDEX : SOURCE_MEMORY,
                             .data = (const char *)grid->offsets,
                             .bytes = n_cells * sizeof(int64_t)};
    *items++ = (struct item){.name = "types",
                             .components = 1,
                             .type = VTU_UINT8,
                             .source = vertices ? SOURCE_VERTEX : SOURCE_MEMORY,
                             .data = (const char *)grid->types,
                             .bytes = n_cells};
}

static int file_write(FILE *stream, const struct vtu_grid *grid, struct item *items, size_t n)
{
    struct writer writer = {.stream = stream};
    size_t largest = 1; // bytes of an array: small files need no large buffers
    for (size_t i = 0; i < n; ++i)
        largest = items[i].bytes > largest ? items[i].bytes : largest;
    const size_t block = largest < VTU_BLOCK ? largest : VTU_BLOCK;
    const size_t blocks = (largest + VTU_BLOCK - 1) / VTU_BLOCK, batch = blocks < BATCH ? blocks : BATCH;
    writer.bound = compressBound(block);
    head_write(stream, grid, items);
    writer.packed = memory_create(batch, writer.bound);
    writer.raw = grid->connectivity ? NULL : memory_create(batch, block);
    int status = writer.packed && (grid->connectivity || writer.raw) ? 0 : STATUS_MEMORY;
    for (size_t i = 0; i < n && !status; ++i)
        status = item_write(&writer, &items[i]);
    memory_free(writer.packed);
    memory_free(writer.raw);
    if (status)
        return status;
    fputs(VTU_END, stream);
    for (size_t i = 0; i < n; ++i) {
        fseek(stream, items[i].place, SEEK_SET);
        fprintf(stream, "%" PRIu64 "\"", items[i].offset);
    }
    return 0;
}

int vtu_write(const char *path, const struct vtu_grid *grid)
{
    size_t n = grid->n_point_arrays + grid->n_cell_arrays + 4;
    struct item *items = memory_create(n, sizeof *items);
    CHECK_MEMORY(items);
    items_fill(items, grid);
    struct file_atomic file;
    int status = file_atomic_open(&file, path);
    if (!status) {
        status = file_write(file.stream, grid, items, n);
        if (status)
            file_atomic_abandon(&file);
        else
            status = file_atomic_commit(&file);
    }
    memory_free(items);
    return status;
}
