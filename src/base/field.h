// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_FIELD_H
#define BASE_FIELD_H

#include <stddef.h>

enum field_type { FIELD_DOUBLE, FIELD_FLOAT, FIELD_INT64, FIELD_INT32, FIELD_UINT8 };

enum field_flags {
    FIELD_STATE = 1,  /**< the next step reads it: it belongs into a checkpoint */
    FIELD_SORTED = 2, /**< one value per particle of a sorted block: permuted by the sort */
    FIELD_HALO = 4,   /**< neighbours in another domain need it */
    FIELD_OUTPUT = 8  /**< offered to the user's output */
};

/** One quantity of an object. Every object lists all of its arrays in field groups; the sort, the output and
 * the checkpoint loop over groups and know nothing else.
 *
 * Layout: components stored in separate arrays (data[0], data[1], data[2]) when data[1] is not NULL,
 * otherwise interleaved in data[0]. The data pointers are refreshed by the owner when arrays move. */
struct field {
    const char *name; /**< CamelCase, as ParaView shows it ("Velocity") */
    const char *unit; /**< SI, "m/s"; "-" if dimensionless */
    enum field_type type;
    int components;
    unsigned flags;
    void *data[3];
    /** Computes the field on demand into @p destination (count x components, interleaved, of the type) when
     * data[0] is NULL; returns a status. */
    int (*fill)(const void *owner, const struct field *field, void *destination);
};

/** The fields of one block, surface or solid: all have the same number of items. */
struct field_group {
    const char *name;    /**< "fluid", "solid-beam", ... unique in a run: a colon, which no name of a
                             deck has, sets what is added behind one apart */
    const void *owner;   /**< passed to fill */
    const size_t *count; /**< current number of items (points to the owner's counter) */
    struct field *fields;
    size_t n_fields;
    /** Make room for @p count items and set the counter, before fields are written; NULL: their number is
     * fixed. Returns a status. */
    int (*resize)(void *owner, size_t count);
};

/** Groups whose STATE fields together are the state of something, in a fixed order. */
struct field_list {
    size_t n, capacity;
    const struct field_group **groups; /**< not owned */
};

/** Size in bytes of one component of @p type. */
size_t field_size(enum field_type type);

/** Copy a field into @p destination (count x components, interleaved, of its own type), by fill or from data.
 * Returns a status. */
int field_read(const struct field_group *group, const struct field *field, void *destination);

/** Copy items [first, first + n) of a field that has arrays, interleaved, into @p destination. */
void field_read_part(const struct field *field, size_t first, size_t n, void *destination);

/** The reverse of field_read: from @p source (count x components, interleaved) into the arrays of a field
 * that has some. */
void field_write(const struct field_group *group, const struct field *field, const void *source);

/** Number of fields of a group that are state. */
size_t field_count_state(const struct field_group *group);

/** A group of single values (counters, times): the @p n @p fields are copied to @p storage, which has to last
 * as long as the group. */
struct field_group field_singles(const char *name, const void *owner, struct field *storage,
                                 const struct field *fields, size_t n);

/** Add a group to a list; one without state is left out. Returns 0 or STATUS_MEMORY. */
int field_list_add(struct field_list *list, const struct field_group *group);
void field_list_reset(struct field_list *list);

/** The field called @p name, or NULL. */
const struct field *field_find(const struct field_group *group, const char *name);

#endif
