// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/pvd.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/xml.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { PVD_LIMIT = 1 << 30 }; // bytes of a file that is read

#define PVD_END "</Collection>\n</VTKFile>\n"

int pvd_create(struct pvd *pvd, const char *path)
{
    memset(pvd, 0, sizeof *pvd);
    pvd->path = memory_text(path);
    CHECK_MEMORY(pvd->path);
    return 0;
}

void pvd_reset(struct pvd *pvd)
{
    memory_free(pvd->path);
    memory_free(pvd->entries);
    memset(pvd, 0, sizeof *pvd);
}

int pvd_add(struct pvd *pvd, double time, int part, const char *name, const char *file)
{
    struct pvd_entry entry = {.time = time, .part = part};
    CHECK(strlen(name) < sizeof entry.name, STATUS_IO, "%s: the name of part %s is longer than %zu letters",
          pvd->path, name, sizeof entry.name - 1);
    CHECK(strlen(file) < sizeof entry.file, STATUS_IO, "%s: the file name %s is longer than %zu letters",
          pvd->path, file, sizeof entry.file - 1);
    memcpy(entry.name, name, strlen(name) + 1);
    memcpy(entry.file, file, strlen(file) + 1);
    void *entries = pvd->entries;
    if (pvd->n == pvd->capacity)
        CALL(memory_grow(&entries, &pvd->capacity, 2 * pvd->n + 16, sizeof entry));
    pvd->entries = entries;
    pvd->entries[pvd->n++] = entry;
    return 0;
}

size_t pvd_count(const struct pvd *pvd, double t)
{
    size_t n = 0;
    while (n < pvd->n && pvd->entries[n].time <= t)
        ++n;
    return n;
}

int pvd_write(const struct pvd *pvd)
{
    struct file_atomic file;
    CALL(file_atomic_open(&file, pvd->path));
    fputs(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n",
        file.stream);
    for (size_t i = 0; i < pvd->n; ++i) {
        const struct pvd_entry *entry = &pvd->entries[i];
        fprintf(file.stream, "<DataSet timestep=\"%.17g\" group=\"\" part=\"%d\" name=\"", entry->time,
                entry->part);
        xml_write(file.stream, entry->name);
        fputs("\" file=\"", file.stream);
        xml_write(file.stream, entry->file);
        fputs("\"/>\n", file.stream);
    }
    fputs(PVD_END, file.stream);
    return file_atomic_commit(&file);
}

static bool number(const struct xml_span *tag, const char *name, double *value)
{
    char text[40], *end;
    if (!xml_attribute(tag, name, text, sizeof text) || text[0] == '\0')
        return false;
    *value = strtod(text, &end);
    return *end == '\0';
}

static int entry_read(struct pvd *pvd, const struct xml_span *tag)
{
    struct pvd_entry entry;
    double part;
    CHECK(number(tag, "timestep", &entry.time) && number(tag, "part", &part) && part >= 0 && part <= 1e6 &&
              xml_attribute(tag, "name", entry.name, sizeof entry.name) &&
              xml_attribute(tag, "file", entry.file, sizeof entry.file),
          STATUS_IO, "%s: damaged: entry %zu is not as skerry writes it", pvd->path, pvd->n);
    CHECK(file_stays_below(entry.file), STATUS_IO, "%s: entry %zu leads out of the folder (%s)", pvd->path,
          pvd->n, entry.file);
    return pvd_add(pvd, entry.time, (int)part, entry.name, entry.file);
}

static int text_read(struct pvd *pvd, const char *text, size_t size)
{
    const size_t tail = strlen(PVD_END);
    struct xml_span rest = {text, text + size}, tag;
    char type[16] = "";
    CHECK(size >= tail && memcmp(text + size - tail, PVD_END, tail) == 0, STATUS_IO,
          "%s: damaged: the end is missing", pvd->path);
    while (xml_next(&rest, &tag)) {
        if (xml_is(&tag, "VTKFile"))
            (void)xml_attribute(&tag, "type", type, sizeof type);
        if (xml_is(&tag, "DataSet"))
            CALL(entry_read(pvd, &tag));
    }
    CHECK(strcmp(type, "Collection") == 0, STATUS_IO, "%s: not a ParaView collection", pvd->path);
    return 0;
}

int pvd_read(struct pvd *pvd, const char *path)
{
    char *text = NULL;
    size_t size;
    CALL(pvd_create(pvd, path));
    int status = file_read(path, PVD_LIMIT, &text, &size);
    if (!status)
        status = text_read(pvd, text, size);
    memory_free(text);
    if (status)
        pvd_reset(pvd);
    return status;
}
