// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/field.h"

#include "base/error.h"
#include "base/memory.h"

#include <stdint.h>
#include <string.h>

size_t field_size(enum field_type type)
{
    switch (type) {
    case FIELD_DOUBLE:
        return sizeof(double);
    case FIELD_FLOAT:
        return sizeof(float);
    case FIELD_INT64:
        return sizeof(int64_t);
    case FIELD_INT32:
        return sizeof(int32_t);
    case FIELD_UINT8:
        return sizeof(uint8_t);
    }
    return 0;
}

void field_read_part(const struct field *field, size_t first, size_t n, void *destination)
{
    const size_t size = field_size(field->type), components = (size_t)field->components;

    if (n == 0)
        return; // arrays of an empty block may not exist yet
    if (components == 1 || !field->data[1]) {
        const size_t item = components * size;
        memcpy(destination, (const char *)field->data[0] + first * item, n * item);
        return;
    }
    for (size_t c = 0; c < components; c++) {
        const char *from = (const char *)field->data[c] + first * size;
        char *to = (char *)destination + c * size;
        for (size_t i = 0; i < n; i++)
            memcpy(to + i * components * size, from + i * size, size);
    }
}

int field_read(const struct field_group *group, const struct field *field, void *destination)
{
    if (!field->data[0] && field->fill)
        return field->fill(group->owner, field, destination);
    field_read_part(field, 0, *group->count, destination);
    return STATUS_OK;
}

void field_write(const struct field_group *group, const struct field *field, const void *source)
{
    const size_t size = field_size(field->type), components = (size_t)field->components;
    const size_t count = *group->count;

    if (components == 1 || !field->data[1]) {
        if (count > 0)
            memcpy(field->data[0], source, count * components * size);
        return;
    }
    for (size_t c = 0; c < components; c++) {
        const char *from = (const char *)source + c * size;
        char *to = field->data[c];
        for (size_t i = 0; i < count; i++)
            memcpy(to + i * size, from + i * components * size, size);
    }
}

size_t field_count_state(const struct field_group *group)
{
    size_t n = 0;
    for (size_t i = 0; i < group->n_fields; i++)
        n += (group->fields[i].flags & FIELD_STATE) != 0;
    return n;
}

struct field_group field_singles(const char *name, const void *owner, struct field *storage,
                                 const struct field *fields, size_t n)
{
    static const size_t one = 1;
    memcpy(storage, fields, n * sizeof *fields);
    return (struct field_group){
        .name = name, .owner = owner, .count = &one, .fields = storage, .n_fields = n};
}

int field_list_add(struct field_list *list, const struct field_group *group)
{
    if (field_count_state(group) == 0)
        return STATUS_OK;
    void *groups = list->groups;
    CALL(memory_grow(&groups, &list->capacity, list->n + 1, sizeof *list->groups));
    list->groups = groups;
    list->groups[list->n++] = group;
    return STATUS_OK;
}

void field_list_reset(struct field_list *list)
{
    memory_free(list->groups);
    *list = (struct field_list){0};
}

const struct field *field_find(const struct field_group *group, const char *name)
{
    for (size_t i = 0; i < group->n_fields; i++)
        if (strcmp(group->fields[i].name, name) == 0)
            return &group->fields[i];
    return NULL;
}
