// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/particles.h"

#include "base/error.h"
#include "base/memory.h"

#include <stdbool.h>
#include <string.h>

enum { POINTERS = 3 }; // of a field: struct field has room for three components

// Arrays of different types share one code path; memcpy keeps the pointer types apart as the language wants
// it.
static void owner_set(struct particles *particles, size_t field, int component, void *array)
{
    particles->fields.fields[field].data[component] = array;
    memcpy(particles->owners[POINTERS * field + (size_t)component], &array, sizeof array);
}

// Components of a vector that have no direction in this problem: all of them are one array of zeros.
static bool is_void(const struct particles *particles, const struct field *field, int component)
{
    return field->components == POINTERS && component >= particles->dim;
}

static int fields_reserve(struct particles *particles, size_t n)
{
    size_t capacity = particles->fields_capacity, owners_capacity = POINTERS * capacity;
    void *fields = particles->fields.fields, *owners = particles->owners;
    CALL(memory_grow(&fields, &capacity, n, sizeof *particles->fields.fields));
    particles->fields.fields = fields;
    CALL(memory_grow(&owners, &owners_capacity, POINTERS * capacity, sizeof *particles->owners));
    particles->owners = owners;
    particles->fields_capacity = capacity;
    return 0;
}

// Register the arrays whose pointers lie one behind the other at @p data.
static int field_add(struct particles *particles, const char *name, const char *unit, enum field_type type,
                     int components, unsigned flags, void *data)
{
    CHECK(!field_find(&particles->fields, name), STATUS_NUMERICAL, "particles %s: field %s exists already",
          particles->fields.name, name);
    CALL(fields_reserve(particles, particles->fields.n_fields + 1));
    const struct field field = {
        .name = name, .unit = unit, .type = type, .components = components, .flags = flags};
    void *arrays[POINTERS] = {NULL};
    for (int c = 0; c < components; ++c) {
        arrays[c] = is_void(particles, &field, c) ? particles->zeros
                                                  : memory_create(particles->capacity, field_size(type));
        if (!arrays[c] && particles->capacity) {
            while (c > 0)
                memory_free(arrays[--c]);
            return STATUS_MEMORY;
        }
    }
    size_t index = particles->fields.n_fields++;
    particles->fields.fields[index] = field;
    for (int c = 0; c < components; ++c) {
        particles->owners[POINTERS * index + (size_t)c] = (void **)data + c;
        owner_set(particles, index, c, arrays[c]);
    }
    return 0;
}

// Density and Mass come first: ParaView's SPH filters preselect the first arrays. Density and pressure follow
// from the places where density is summed; a formulation that integrates them adds FIELD_STATE.
static int fields_create(struct particles *particles)
{
    const unsigned sorted = FIELD_SORTED | FIELD_HALO, state = sorted | FIELD_STATE;
    struct particles *a = particles;
    CALL(field_add(a, "Density", "kg/m^3", FIELD_DOUBLE, 1, sorted | FIELD_OUTPUT, &a->rho));
    CALL(field_add(a, "Mass", "kg", FIELD_DOUBLE, 1, state | FIELD_OUTPUT, &a->m));
    CALL(field_add(a, "Velocity", "m/s", FIELD_DOUBLE, 3, state | FIELD_OUTPUT, a->u));
    CALL(field_add(a, "Pressure", "Pa", FIELD_DOUBLE, 1, sorted | FIELD_OUTPUT, &a->p));
    CALL(field_add(a, "Id", "-", FIELD_INT64, 1, state | FIELD_OUTPUT, &a->id));
    CALL(field_add(a, "Position", "m", FIELD_DOUBLE, 3, state, a->x));
    CALL(field_add(a, "Kind", "-", FIELD_UINT8, 1, state, &a->kind));
    CALL(field_add(a, "Opening", "-", FIELD_UINT8, 1, state, &a->opening));
    return 0;
}

// For a checkpoint, which then writes every field that is state.
static int fields_resize(void *owner, size_t count)
{
    struct particles *particles = owner;
    CALL(particles_reserve(particles, count));
    particles->n = count;
    return 0;
}

int particles_create(struct particles **particles, const char *name, int dim, size_t capacity)
{
    *particles = NULL;
    struct particles *block = memory_create(1, sizeof *block);
    CHECK_MEMORY(block);
    block->dim = dim;
    block->fields.owner = block;
    block->fields.count = &block->n;
    block->fields.resize = fields_resize;
    block->fields.name = memory_text(name);
    int status = block->fields.name ? 0 : STATUS_MEMORY;
    if (!status)
        status = fields_create(block);
    if (!status)
        status = particles_reserve(block, capacity > 0 ? capacity : 1);
    if (status) {
        particles_destroy(block);
        return status;
    }
    *particles = block;
    return 0;
}

// The arrays are freed through the field table: those who registered a field may be gone already.
void particles_destroy(struct particles *particles)
{
    if (!particles)
        return;
    for (size_t f = 0; f < particles->fields.n_fields; ++f)
        for (int c = 0; c < POINTERS; ++c)
            if (!is_void(particles, &particles->fields.fields[f], c))
                memory_free(particles->fields.fields[f].data[c]);
    memory_free(particles->zeros);
    memory_free(particles->scratch);
    memory_free(particles->owners);
    memory_free(particles->fields.fields);
    memory_free((char *)particles->fields.name);
    memory_free(particles);
}

int particles_add_field(struct particles *particles, const char *name, const char *unit, int components,
                        unsigned flags, double **data)
{
    CHECK(components == 1 || components == POINTERS, STATUS_NUMERICAL,
          "particles %s: field %s has %d components; 1 or 3 are possible", particles->fields.name, name,
          components);
    return field_add(particles, name, unit, FIELD_DOUBLE, components, flags, data);
}

void particles_add_flags(struct particles *particles, const char *name, unsigned flags)
{
    for (size_t f = 0; f < particles->fields.n_fields; ++f)
        if (!strcmp(particles->fields.fields[f].name, name))
            particles->fields.fields[f].flags |= flags;
}

int particles_reserve(struct particles *particles, size_t capacity)
{
    if (capacity <= particles->capacity)
        return 0;
    CHECK(capacity <= UINT32_MAX, STATUS_MEMORY,
          "particles %s: %zu particles wanted, but the sort counts to %lu; use a larger spacing",
          particles->fields.name, capacity, (unsigned long)UINT32_MAX);
    if (particles->dim < POINTERS) {
        size_t old = particles->capacity;
        CALL(memory_grow(&particles->zeros, &old, capacity, sizeof(double)));
    }
    for (size_t f = 0; f < particles->fields.n_fields; ++f) {
        const struct field *field = &particles->fields.fields[f];
        for (int c = 0; c < field->components; ++c) {
            if (is_void(particles, field, c)) {
                owner_set(particles, f, c, particles->zeros);
                continue;
            }
            size_t old = particles->capacity;
            void *array = field->data[c];
            CALL(memory_grow(&array, &old, capacity, field_size(field->type)));
            owner_set(particles, f, c, array);
        }
    }
    size_t old = particles->capacity;
    CALL(memory_grow(&particles->scratch, &old, capacity, sizeof(double)));
    particles->capacity = capacity;
    return 0;
}

int particles_append(struct particles *particles, enum particle_kind kind, const double x[3], double m,
                     size_t *index)
{
    size_t n = particles->n;
    if (n == particles->capacity)
        CALL(particles_reserve(particles, n + n / 2 + 16));
    for (size_t f = 0; f < particles->fields.n_fields; ++f) {
        const struct field *field = &particles->fields.fields[f];
        size_t size = field_size(field->type);
        for (int c = 0; c < field->components; ++c)
            if (!is_void(particles, field, c))
                memset((char *)field->data[c] + n * size, 0, size);
    }
    particles->id[n] = particles->next_id++;
    particles->kind[n] = (uint8_t)kind;
    for (int c = 0; c < particles->dim; ++c)
        particles->x[c][n] = x[c];
    particles->m[n] = m;
    particles->n = n + 1;
    if (index)
        *index = n;
    return 0;
}

// Arrays of 8-byte items trade places with the scratch array; arrays of bytes are copied back.
static void array_permute(struct particles *particles, size_t f, int c, const uint32_t *order, size_t n)
{
    const struct field *field = &particles->fields.fields[f];
    char *from = field->data[c], *to = particles->scratch;
    if (field_size(field->type) == sizeof(double)) {
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < n; ++i)
            memcpy(to + i * sizeof(double), from + order[i] * sizeof(double), sizeof(double));
        particles->scratch = from;
        owner_set(particles, f, c, to);
    } else {
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < n; ++i)
            to[i] = from[order[i]];
        memcpy(from, to, n);
    }
}

int particles_permute(struct particles *particles, const uint32_t *order, size_t n)
{
    uint32_t last = 0;
#pragma omp parallel for schedule(static) reduction(max : last)
    for (size_t i = 0; i < n; ++i)
        last = order[i] > last ? order[i] : last;
    CHECK(n <= particles->n && (n == 0 || last < particles->n), STATUS_NUMERICAL,
          "particles %s: an order of %zu entries up to %lu does not fit %zu particles",
          particles->fields.name, n, (unsigned long)last, particles->n);
    for (size_t f = 0; f < particles->fields.n_fields; ++f) {
        const struct field *field = &particles->fields.fields[f];
        if (field->flags & FIELD_SORTED)
            for (int c = 0; c < field->components; ++c)
                if (!is_void(particles, field, c))
                    array_permute(particles, f, c, order, n);
    }
    particles->n = n;
    return 0;
}
