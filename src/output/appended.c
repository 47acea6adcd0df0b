// SPDX-License-Identifier: GPL-3.0-or-later
// Byte layout of the appended, compressed arrays (VTK XML formats, https://docs.vtk.org, "VTKXMLFileFormat"),
// all numbers uint64 in the byte order of the file:
//     blocks | block size | size of a partial last block or 0 | compressed size of each block | zlib streams
// Offsets count from the byte behind the underscore of <AppendedData>.
#include "output/appended.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "output/vtu_types.h"
#include "output/xml.h"

#include <inttypes.h>
#include <omp.h>
#include <stdbool.h>
#include <string.h>
#include <zlib.h>

enum {
    SHARE = 4,          // blocks for each thread in a batch; bounds the memory: 4 x 128 KiB per thread
    SAMPLE = 32 * 1024, // bytes that stand for an array where ways to compress are compared
    OFFSET_WIDTH = 24   // room in the head for an offset that is known after compression
};

// A block of the file in the making.
struct job {
    const struct appended_item *item;
    size_t block;
    char *packed;
    uint64_t size; // of packed, when done
    bool done;
};

struct writer {
    FILE *stream;
    struct appended_item *items;
    size_t n_items, item, block; // the next one to be compressed
    char *raw, *packed;          // one block per thread, only for arrays that are made; a batch
    size_t size, bound;          // largest size of a block, of a compressed block
    struct job *jobs;            // blocks compressed side by side
    size_t n_jobs, n_written, batch;
    struct appended_item *begun; // the first one whose head is not in the file yet
    uint64_t written;            // bytes of data so far
};

static size_t block_size(const struct appended_item *item, size_t block)
{
    size_t left = item->bytes - block * VTU_BLOCK;
    return left < VTU_BLOCK ? left : VTU_BLOCK;
}

// Bytes [start, start + n) of an array; @p raw is room for them where they have to be made.
static const char *bytes_of(const struct appended_item *item, size_t start, size_t n, char *raw)
{
    const size_t size = vtu_type_size(item->type);
    if (!item->read)
        return (const char *)item->data + start;
    item->read(item->data, start / size, n / size, raw);
    return raw;
}

// The size of @p raw compressed, or 0 (out of memory).
static uint64_t compress_bytes(int level, int strategy, const char *raw, size_t n, char *packed, size_t bound)
{
    z_stream stream;
    memset(&stream, 0, sizeof stream);
    if (deflateInit2(&stream, level, Z_DEFLATED, MAX_WBITS, 8, strategy) != Z_OK)
        return 0;
    stream.next_in = (Bytef *)raw;
    stream.avail_in = (uInt)n;
    stream.next_out = (Bytef *)packed;
    stream.avail_out = (uInt)bound;
    bool good = deflate(&stream, Z_FINISH) == Z_STREAM_END;
    deflateEnd(&stream);
    return good ? stream.total_out : 0;
}

// Level 1 looks for words that come again. Where particles lie in order it finds them, and takes no longer
// than the other ways; where they do not, it looks in vain, at half the speed of Z_RLE, which codes bytes by
// how often they come. A sample from the middle shows which it is. Sizes decide, never times: the same array
// always gives the same bytes. Returns false: out of memory.
static bool strategy_choose(struct appended_item *item, char *raw, char *packed, size_t bound)
{
    const size_t n = item->bytes < SAMPLE ? item->bytes : SAMPLE, tuple = 8 * 3;
    const size_t start = (item->bytes - n) / 2 / tuple * tuple;
    item->level = 1;
    item->strategy = Z_DEFAULT_STRATEGY;
    if (n == 0 || (item->type != VTU_FLOAT32 && item->type != VTU_FLOAT64))
        return true;
    const char *bytes = bytes_of(item, start, n, raw);
    const uint64_t words = compress_bytes(1, Z_DEFAULT_STRATEGY, bytes, n, packed, bound);
    const uint64_t runs = compress_bytes(1, Z_RLE, bytes, n, packed, bound);
    if (4 * words > 3 * runs)
        item->strategy = Z_RLE;
    return words > 0 && runs > 0;
}

static int strategies_choose(struct writer *writer)
{
    int failed = 0;
#pragma omp parallel for schedule(dynamic, 1) reduction(max : failed)
    for (size_t i = 0; i < writer->n_items; ++i) {
        const size_t thread = (size_t)omp_get_thread_num();
        if (!strategy_choose(&writer->items[i], writer->raw + thread * writer->size,
                             writer->packed + thread * writer->bound, writer->bound))
            failed = 1;
    }
    CHECK(!failed, STATUS_MEMORY, "out of memory while compressing");
    return 0;
}

// The next blocks in file order, across arrays: small ones do not leave threads without work.
static void batch_collect(struct writer *writer)
{
    writer->n_jobs = writer->n_written = 0;
    while (writer->item < writer->n_items && writer->n_jobs < writer->batch) {
        const struct appended_item *item = &writer->items[writer->item];
        if (writer->block == item->blocks) {
            ++writer->item;
            writer->block = 0;
            continue;
        }
        writer->jobs[writer->n_jobs] =
            (struct job){.item = item,
                         .block = writer->block++,
                         .packed = writer->packed + writer->n_jobs * writer->bound};
        ++writer->n_jobs;
    }
}

static void item_begin(struct writer *writer, struct appended_item *item)
{
    item->offset = writer->written;
    item->head_place = ftell(writer->stream);
    fwrite(item->head, sizeof *item->head, 3 + item->blocks, writer->stream);
    writer->written += (3 + item->blocks) * sizeof *item->head;
}

// Begin the arrays before @p end that have not begun.
static void items_begin(struct writer *writer, const struct appended_item *end)
{
    while (writer->begun < end)
        item_begin(writer, writer->begun++);
}

// Write every block whose predecessors are written, too.
static void batch_write(struct writer *writer)
{
    for (; writer->n_written < writer->n_jobs && writer->jobs[writer->n_written].done; ++writer->n_written) {
        const struct job *job = &writer->jobs[writer->n_written];
        items_begin(writer, job->item + 1);
        fwrite(job->packed, 1, job->size, writer->stream);
        writer->written += job->size;
        job->item->head[3 + job->block] = job->size;
    }
}

static int batch_compress(struct writer *writer)
{
    int failed = 0;
#pragma omp parallel for schedule(dynamic, 1) reduction(max : failed)
    for (size_t k = 0; k < writer->n_jobs; ++k) {
        struct job *job = &writer->jobs[k];
        const struct appended_item *item = job->item;
        const size_t n = block_size(item, job->block);
        const char *raw = bytes_of(item, job->block * VTU_BLOCK, n,
                                   writer->raw + (size_t)omp_get_thread_num() * writer->size);
        job->size = compress_bytes(item->level, item->strategy, raw, n, job->packed, writer->bound);
        failed = job->size == 0 ? 1 : failed;
#pragma omp critical(vtu_batch)
        {
            job->done = true;
            batch_write(writer);
        }
    }
    CHECK(!failed, STATUS_MEMORY, "out of memory while compressing");
    return 0;
}

void appended_declare(FILE *stream, struct appended_item *item)
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

static int heads_create(struct appended_item *items, size_t n)
{
    for (size_t i = 0; i < n; ++i) {
        items[i].blocks = (items[i].bytes + VTU_BLOCK - 1) / VTU_BLOCK;
        items[i].head = memory_create(3 + items[i].blocks, sizeof *items[i].head);
        CHECK_MEMORY(items[i].head);
        if (items[i].blocks > 0) {
            items[i].head[0] = items[i].blocks;
            items[i].head[1] = VTU_BLOCK;
            items[i].head[2] = items[i].bytes % VTU_BLOCK;
        }
    }
    return 0;
}

static void heads_free(struct appended_item *items, size_t n)
{
    for (size_t i = 0; i < n; ++i)
        memory_free(items[i].head);
}

static int data_write(struct writer *writer)
{
    CALL(strategies_choose(writer));
    for (batch_collect(writer); writer->n_jobs > 0; batch_collect(writer))
        CALL(batch_compress(writer));
    items_begin(writer, writer->items + writer->n_items);
    return 0;
}

// What is known only now that all is compressed.
static void heads_write(FILE *stream, const struct appended_item *items, size_t n)
{
    for (size_t i = 0; i < n; ++i) {
        fseek(stream, items[i].place, SEEK_SET);
        fprintf(stream, "%" PRIu64 "\"", items[i].offset);
    }
    for (size_t i = 0; i < n; ++i) {
        fseek(stream, items[i].head_place, SEEK_SET);
        fwrite(items[i].head, sizeof *items[i].head, 3 + items[i].blocks, stream);
    }
}

static int file_write(FILE *stream, appended_head *head_write, const void *what, struct appended_item *items,
                      size_t n)
{
    struct writer writer = {.stream = stream, .items = items, .n_items = n, .begun = items, .size = 1};
    const size_t threads = (size_t)parallel_threads();
    size_t blocks = 0; // small files need no large buffers
    for (size_t i = 0; i < n; ++i) {
        const size_t block = items[i].bytes < VTU_BLOCK ? items[i].bytes : VTU_BLOCK;
        writer.size = block > writer.size ? block : writer.size;
        blocks += items[i].blocks;
    }
    writer.batch = blocks < SHARE * threads ? blocks : SHARE * threads;
    writer.bound = compressBound(writer.size);
    head_write(stream, what, items);
    fputs(VTU_APPENDED, stream);
    writer.raw = memory_create(threads, writer.size);
    writer.packed = memory_create(writer.batch > threads ? writer.batch : threads, writer.bound);
    writer.jobs = memory_create(writer.batch, sizeof *writer.jobs);
    int status = writer.raw && writer.packed && writer.jobs ? data_write(&writer) : STATUS_MEMORY;
    memory_free(writer.raw);
    memory_free(writer.packed);
    memory_free(writer.jobs);
    CALL(status);
    fputs(VTU_END, stream);
    heads_write(stream, items, n);
    return 0;
}

struct appended_item appended_array(const struct vtu_array *array, size_t n)
{
    return (struct appended_item){.name = array->name,
                                  .components = array->components,
                                  .type = array->type,
                                  .data = array->data,
                                  .read = array->read,
                                  .bytes = n * (size_t)array->components * vtu_type_size(array->type)};
}

int appended_write(const char *path, appended_head *head_write, const void *what, struct appended_item *items,
                   size_t n)
{
    struct file_atomic file;
    int status = heads_create(items, n);
    if (!status)
        status = file_atomic_open(&file, path);
    if (!status) {
        status = file_write(file.stream, head_write, what, items, n);
        if (status)
            file_atomic_abandon(&file);
        else
            status = file_atomic_commit(&file);
    }
    heads_free(items, n);
    return status;
}

void appended_begin(FILE *stream, const char *kind, const char *extent, double time, int64_t cycle)
{
    fprintf(stream,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"%s\" version=\"1.0\" byte_order=\"%s\" "
            "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<%s%s>\n<FieldData>\n"
            "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">%.17g"
            "</DataArray>\n<DataArray type=\"Int64\" Name=\"Cycle\" NumberOfTuples=\"1\" format=\"ascii\">"
            "%" PRId64 "</DataArray>\n</FieldData>\n",
            kind, VTU_BYTE_ORDER, kind, extent, time, cycle);
}

void appended_point_data(FILE *stream, const char *scalars, const char *vectors)
{
    fputs("<PointData", stream);
    default_array(stream, "Scalars", scalars);
    default_array(stream, "Vectors", vectors);
    fputs(">\n", stream);
}
