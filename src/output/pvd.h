// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_PVD_H
#define OUTPUT_PVD_H

#include <stddef.h>

struct pvd_entry {
    double time;
    int part;
    char name[96];  /**< "fluid" */
    char file[192]; /**< relative to the .pvd */
};

/** A ParaView collection: the series of a run. */
struct pvd {
    char *path;
    size_t n, capacity;
    struct pvd_entry *entries;
};

int pvd_create(struct pvd *pvd, const char *path);
void pvd_reset(struct pvd *pvd);

/** Add an entry (in memory). */
int pvd_add(struct pvd *pvd, double time, int part, const char *name, const char *file);

/** Number of entries of time @p t or before; as entries follow in time, they are the first ones. */
size_t pvd_count(const struct pvd *pvd, double t);

/** Rewrite the file atomically. */
int pvd_write(const struct pvd *pvd);

/** Read a .pvd that pvd_write wrote. */
int pvd_read(struct pvd *pvd, const char *path);

#endif
