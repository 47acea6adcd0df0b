// SPDX-License-Identifier: GPL-3.0-or-later
// The HDF5 file of a checkpoint. Times are not tracked and nothing else but the state goes into it, so that
// equal states give equal bytes.
#include "output/checkpoint_internal.h"

#include "base/error.h"
#include "base/memory.h"

#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PART = 16384 }; /* items written at once */

/** Types in the file (little endian whatever the machine) and in memory. */
static hid_t file_type(enum field_type type)
{
    const hid_t types[] = {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_STD_I64LE, H5T_STD_I32LE, H5T_STD_U8LE};
    return types[type];
}

static hid_t memory_type(enum field_type type)
{
    const hid_t types[] = {H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT, H5T_NATIVE_INT64, H5T_NATIVE_INT32,
                           H5T_NATIVE_UINT8};
    return types[type];
}

/** HDF5 prints nothing and does not tidy up when the program ends: after a failed write that would fail
 * again. It locks no files, which some network file systems cannot: the whole folder is locked already. */
static void library_prepare(void)
{
    setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0);
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

/** The system's error number from the description of the first error of the stack. */
static herr_t error_take(unsigned number, const H5E_error2_t *error, void *context)
{
    const char *found = error->desc ? strstr(error->desc, "errno = ") : NULL;
    if (number == 0 && found)
        *(int *)context = atoi(found + strlen("errno = "));
    return 0;
}

/** Why the last call failed: the system's error number, or -1. The next call of HDF5 forgets it. */
static int failure(void)
{
    int number = 0;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, error_take, &number);
    return number > 0 ? number : -1;
}

static int report_failed(const char *path, const char *what, int reason)
{
    return error_report(STATUS_IO, "%s: cannot write%s%s: %s", path, *what ? " " : "", what,
                        reason > 0 ? strerror(reason) : "HDF5 failed");
}

static bool is_finite(const struct field *field, const void *values, size_t i)
{
    return field->type == FIELD_DOUBLE  ? isfinite(((const double *)values)[i])
           : field->type == FIELD_FLOAT ? isfinite(((const float *)values)[i])
                                        : true;
}

/** Index of the first value that is not finite; @p n: all are. */
static size_t find_bad(const struct field *field, const void *values, size_t n)
{
    size_t i = 0;
    while (i < n && is_finite(field, values, i))
        ++i;
    return i;
}

/** The dimensions of a field's dataset; returns their number. */
static int field_shape(const struct field_group *group, const struct field *field, hsize_t shape[2])
{
    shape[0] = *group->count;
    shape[1] = (hsize_t)field->components;
    return field->components > 1 ? 2 : 1;
}

/** Returns 0, or why it failed. */
static int dataset_create(hid_t parent, const struct field_group *group, const struct field *field,
                          hid_t *set, hid_t *space)
{
    hsize_t shape[2];
    const int rank = field_shape(group, field, shape);
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    *space = H5Screate_simple(rank, shape, NULL);
    H5Pset_obj_track_times(properties, false);
    *set =
        H5Dcreate2(parent, field->name, file_type(field->type), *space, H5P_DEFAULT, properties, H5P_DEFAULT);
    const int reason = *set < 0 ? failure() : 0;
    H5Pclose(properties);
    return reason;
}

/** Write items [first, first + n) of a field; returns 0, or why it failed. */
static int part_write(hid_t set, hid_t space, const struct field *field, size_t first, size_t n,
                      const void *values)
{
    const hsize_t begin[2] = {first, 0}, shape[2] = {n, (hsize_t)field->components};
    const hid_t memory = H5Screate_simple(field->components > 1 ? 2 : 1, shape, NULL);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, begin, NULL, shape, NULL);
    const int reason =
        H5Dwrite(set, memory_type(field->type), memory, space, H5P_DEFAULT, values) < 0 ? failure() : 0;
    H5Sclose(memory);
    return reason;
}

/** A part at a time, so that a checkpoint needs no memory to speak of. */
static int parts_save(hid_t set, hid_t space, const char *path, const struct field_group *group,
                      const struct field *field, void *values)
{
    const size_t count = *group->count, components = (size_t)field->components;
    for (size_t first = 0; first < count; first += PART) {
        const size_t n = count - first < PART ? count - first : PART;
        field_read_part(field, first, n, values);
        const size_t bad = find_bad(field, values, n * components);
        CHECK(bad == n * components, STATUS_NUMERICAL,
              "the state is not finite: %s of %s, item %zu, component %zu; no checkpoint is made of it",
              field->name, group->name, first + bad / components, bad % components);
        const int reason = part_write(set, space, field, first, n, values);
        if (reason)
            return report_failed(path, field->name, reason);
    }
    return 0;
}

static int field_save(hid_t parent, const char *path, const struct field_group *group,
                      const struct field *field, void *values)
{
    hid_t set, space;
    const int reason = dataset_create(parent, group, field, &set, &space);
    int status = reason ? report_failed(path, field->name, reason)
                        : parts_save(set, space, path, group, field, values);
    if (set >= 0 && H5Dclose(set) < 0 && !status)
        status = report_failed(path, field->name, failure());
    H5Sclose(space);
    return status;
}

/** Size of the largest item of a group's fields. */
static size_t item_size(const struct field_group *group)
{
    size_t largest = 1;
    for (size_t f = 0; f < group->n_fields; ++f) {
        const size_t size = field_size(group->fields[f].type) * (size_t)group->fields[f].components;
        largest = size > largest ? size : largest;
    }
    return largest;
}

static int group_save(hid_t file, const char *path, const struct field_group *group)
{
    void *values = memory_create(PART, item_size(group));
    CHECK_MEMORY(values);
    const hid_t parent = H5Gcreate2(file, group->name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    int status = parent >= 0 ? 0 : report_failed(path, group->name, failure());
    for (size_t f = 0; f < group->n_fields && !status; ++f)
        if (group->fields[f].flags & FIELD_STATE)
            status = field_save(parent, path, group, &group->fields[f], values);
    if (parent >= 0 && H5Gclose(parent) < 0 && !status)
        status = report_failed(path, group->name, failure());
    memory_free(values);
    return status;
}

int checkpoint_data_write(const char *path, const struct field_list *state)
{
    library_prepare();
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (file < 0)
        return report_failed(path, "", failure());
    int status = 0;
    for (size_t g = 0; g < state->n && !status; ++g)
        status = group_save(file, path, state->groups[g]);
    if (H5Fclose(file) < 0 && !status)
        status = report_failed(path, "", failure());
    return status;
}

/** What is wrong with a dataset of the file, or NULL. */
static const char *dataset_wrong(hid_t set, const struct field_group *group, const struct field *field)
{
    hsize_t shape[2] = {0, 0}, wanted[2];
    const int rank = field_shape(group, field, wanted);
    const hid_t space = H5Dget_space(set), type = H5Dget_type(set);
    const char *wrong = NULL;
    if (H5Tequal(type, file_type(field->type)) <= 0)
        wrong = "has another type";
    else if (H5Sget_simple_extent_ndims(space) != rank ||
             H5Sget_simple_extent_dims(space, shape, NULL) != rank || (rank == 2 && shape[1] != wanted[1]) ||
             (!group->resize && shape[0] != wanted[0]))
        wrong = "has another number of values";
    H5Sclose(space);
    H5Tclose(type);
    return wrong;
}

/** Number of items of a field in the file. */
static hsize_t dataset_count(hid_t set)
{
    hsize_t shape[2] = {0, 0};
    const hid_t space = H5Dget_space(set);
    H5Sget_simple_extent_dims(space, shape, NULL);
    H5Sclose(space);
    return shape[0];
}

static hsize_t link_count(hid_t parent)
{
    H5G_info_t information = {.nlinks = 0};
    H5Gget_info(parent, &information);
    return information.nlinks;
}

/** Whether the group of the file has just the fields that are asked for, all of one length. */
static int group_check(hid_t file, const struct field_group *group, hsize_t *count,
                       char reason[CHECKPOINT_REASON])
{
    const hid_t parent = H5Gopen2(file, group->name, H5P_DEFAULT);
    const char *wrong = parent < 0 ? "is not a group of it" : NULL, *name = "";
    bool first = true;
    if (!wrong && link_count(parent) != field_count_state(group))
        wrong = "has other fields than this program";
    for (size_t f = 0; f < group->n_fields && !wrong; ++f) {
        const struct field *field = &group->fields[f];
        if (!(field->flags & FIELD_STATE))
            continue;
        name = field->name;
        const hid_t set = H5Dopen2(parent, name, H5P_DEFAULT);
        wrong = set < 0 ? "is missing" : dataset_wrong(set, group, field);
        if (!wrong && !first && dataset_count(set) != *count)
            wrong = "has another number of values than the fields before it";
        if (!wrong)
            *count = dataset_count(set);
        first = false;
        if (set >= 0)
            H5Dclose(set);
    }
    if (parent >= 0)
        H5Gclose(parent);
    if (!wrong)
        return 0;
    snprintf(reason, CHECKPOINT_REASON, "it does not fit the deck: %s%s%s %s", group->name, *name ? "/" : "",
             name, wrong);
    return STATUS_IO;
}

static int field_load(hid_t parent, const struct field_group *group, const struct field *field, void *values,
                      char reason[CHECKPOINT_REASON])
{
    const size_t n = *group->count * (size_t)field->components;
    const hid_t set = H5Dopen2(parent, field->name, H5P_DEFAULT);
    bool good = set >= 0;
    if (good && n > 0)
        good = H5Dread(set, memory_type(field->type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
    if (set >= 0)
        H5Dclose(set);
    if (!good || find_bad(field, values, n) < n) {
        snprintf(reason, CHECKPOINT_REASON, "%s/%s %s", group->name, field->name,
                 good ? "holds a value that is not finite" : "cannot be read");
        return STATUS_IO;
    }
    field_write(group, field, values);
    return 0;
}

static int group_load(hid_t file, const struct field_group *group, hsize_t count,
                      char reason[CHECKPOINT_REASON])
{
    if (group->resize)
        CALL(group->resize((void *)group->owner, (size_t)count));
    void *values = memory_create(*group->count, item_size(group));
    CHECK_MEMORY(values);
    const hid_t parent = H5Gopen2(file, group->name, H5P_DEFAULT);
    int status = 0;
    for (size_t f = 0; f < group->n_fields && !status; ++f)
        if (group->fields[f].flags & FIELD_STATE)
            status = field_load(parent, group, &group->fields[f], values, reason);
    H5Gclose(parent);
    memory_free(values);
    return status;
}

static int file_load(hid_t file, const struct field_list *state, char reason[CHECKPOINT_REASON])
{
    hsize_t *counts = memory_create(state->n, sizeof *counts);
    CHECK_MEMORY(counts);
    int status = 0;
    if (link_count(file) != state->n) {
        snprintf(reason, CHECKPOINT_REASON, "it does not fit the deck: it has %llu groups, not %zu",
                 (unsigned long long)link_count(file), state->n);
        status = STATUS_IO;
    }
    for (size_t g = 0; g < state->n && !status; ++g)
        status = group_check(file, state->groups[g], &counts[g], reason);
    for (size_t g = 0; g < state->n && !status; ++g)
        status = group_load(file, state->groups[g], counts[g], reason);
    memory_free(counts);
    return status;
}

int checkpoint_data_read(const char *path, const struct field_list *state, char reason[CHECKPOINT_REASON])
{
    library_prepare();
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) {
        snprintf(reason, CHECKPOINT_REASON, "it is no HDF5 file");
        return STATUS_IO;
    }
    const int status = file_load(file, state, reason);
    H5Fclose(file);
    return status;
}
