// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/error.h"
#include "model/particles.h"

#include <string.h>

static void append(struct particles *particles, size_t n)
{
    for (size_t i = 0; i < n; ++i) {
        const double x[3] = {0.37 + (double)i, 0.25 - 1.5 * (double)i, 99.0};
        size_t index = 77;
        assert_int_equal(particles_append(particles, PARTICLE_FLUID, x, 2.385 + (double)i, &index), 0);
        assert_int_equal(index, particles->n - 1);
    }
}

static void test_fields(void **state)
{
    (void)state;
    struct particles *block;
    assert_int_equal(particles_create(&block, "fluid", 2, 0), 0);
    assert_string_equal(block->fields.name, "fluid");
    assert_string_equal(block->fields.fields[0].name, "Density");
    assert_string_equal(block->fields.fields[1].name, "Mass");
    append(block, 3);
    assert_int_equal(*block->fields.count, 3);
    const struct field *mass = field_find(&block->fields, "Mass");
    assert_ptr_equal(mass->data[0], block->m);
    assert_true(mass->flags & FIELD_STATE);
    const struct field *x = field_find(&block->fields, "Position");
    for (int c = 0; c < 3; ++c)
        assert_ptr_equal(x->data[c], block->x[c]);
    double read[9];
    assert_int_equal(field_read(&block->fields, x, read), 0);
    const double expected[9] = {0.37, 0.25, 0.0, 1.37, -1.25, 0.0, 2.37, -2.75, 0.0}; // z stays 0 in 2-D
    assert_memory_equal(read, expected, sizeof expected);
    assert_int_equal(block->id[2], 2);
    assert_int_equal(block->next_id, 3);
    particles_destroy(block);
    particles_destroy(NULL);
}

// What a checkpoint does: room for another number of particles, then every field.
static void test_resize(void **state)
{
    (void)state;
    struct particles *block;
    double *listed[3];
    assert_int_equal(particles_create(&block, "fluid", 2, 3), 0);
    assert_int_equal(particles_add_field(block, "Listed", "m", 3, 0, listed), 0);
    append(block, 2);
    assert_int_equal(block->fields.resize((void *)block->fields.owner, 50), 0);
    assert_int_equal(block->n, 50);
    assert_true(block->capacity >= 50);
    const struct field *x = field_find(&block->fields, "Position");
    double places[150];
    for (int i = 0; i < 150; ++i)
        places[i] = i % 3 < 2 ? 2.385 * i : 0.0;
    field_write(&block->fields, x, places);
    assert_true(block->x[1][49] == places[148]);
    assert_int_equal(block->fields.resize((void *)block->fields.owner, 1), 0);
    assert_int_equal(block->n, 1);
    assert_false(field_find(&block->fields, "Pressure")->flags & FIELD_STATE);
    particles_add_flags(block, "Pressure", FIELD_STATE);
    assert_true(field_find(&block->fields, "Pressure")->flags & FIELD_STATE);
    assert_true(field_find(&block->fields, "Pressure")->flags & FIELD_OUTPUT);
    particles_destroy(block);
}

static void test_growth(void **state)
{
    (void)state;
    struct particles *block;
    double *force[3], *rate;
    assert_int_equal(particles_create(&block, "fluid", 3, 5), 0);
    assert_int_equal(particles_add_field(block, "Force", "N", 3, FIELD_SORTED, force), 0);
    append(block, 5);
    for (size_t i = 0; i < 5; ++i)
        force[2][i] = 0.1 + (double)i;
    for (int more = 0; more < 20; ++more) { // the table of fields moves too
        static const char *const names[20] = {"A", "B", "C", "D", "E", "F", "G", "H", "I", "J",
                                              "K", "L", "M", "N", "O", "P", "Q", "R", "S", "T"};
        static double *data[20];
        assert_int_equal(particles_add_field(block, names[more], "-", 1, 0, &data[more]), 0);
    }
    assert_int_equal(particles_add_field(block, "Rate", "1/s", 1, FIELD_SORTED, &rate), 0);
    append(block, 1000);
    assert_true(block->capacity >= 1005);
    assert_ptr_equal(field_find(&block->fields, "Force")->data[2], force[2]);
    assert_ptr_equal(field_find(&block->fields, "Rate")->data[0], rate);
    for (size_t i = 0; i < 1005; ++i) {
        assert_true(force[2][i] == (i < 5 ? 0.1 + (double)i : 0.0));
        assert_true(rate[i] == 0.0);
        assert_int_equal(block->id[i], i);
    }
    assert_true(block->x[2][0] == 99.0);
    particles_destroy(block);
}

static void test_permute(void **state)
{
    (void)state;
    struct particles *block;
    double *force[3], *fixed;
    assert_int_equal(particles_create(&block, "fluid", 3, 1), 0);
    assert_int_equal(particles_add_field(block, "Force", "N", 3, FIELD_SORTED, force), 0);
    assert_int_equal(particles_add_field(block, "Fixed", "-", 1, 0, &fixed), 0);
    append(block, 7);
    for (size_t i = 0; i < 7; ++i) {
        force[1][i] = -3.25 * (double)i;
        fixed[i] = (double)i;
        block->kind[i] = (uint8_t)(i % 3);
    }
    const uint32_t order[5] = {6, 0, 3, 2, 5};
    assert_int_equal(particles_permute(block, order, 5), 0);
    assert_int_equal(block->n, 5);
    for (size_t i = 0; i < 5; ++i) {
        assert_int_equal(block->id[i], order[i]);
        assert_int_equal(block->kind[i], order[i] % 3);
        assert_true(block->x[0][i] == 0.37 + order[i]);
        assert_true(block->m[i] == 2.385 + order[i]);
        assert_true(force[1][i] == -3.25 * order[i]);
        assert_true(fixed[i] == (double)i); // not SORTED
    }
    assert_ptr_equal(field_find(&block->fields, "Force")->data[1], force[1]);
    append(block, 1); // nothing of the vanished particles shines through
    assert_int_equal(block->id[5], 7);
    assert_true(force[1][5] == 0.0 && block->rho[5] == 0.0 && block->kind[5] == PARTICLE_FLUID);
    particles_destroy(block);
}

static void test_errors(void **state)
{
    (void)state;
    struct particles *block;
    double *data[3];
    assert_int_equal(particles_create(&block, "fluid", 2, 4), 0);
    append(block, 4);
    const uint32_t outside[2] = {1, 4}, longer[5] = {0, 1, 2, 3, 0};
    assert_int_equal(particles_permute(block, outside, 2), STATUS_NUMERICAL);
    assert_int_equal(particles_permute(block, longer, 5), STATUS_NUMERICAL);
    assert_int_equal(block->n, 4);
    assert_int_equal(block->id[1], 1);
    assert_int_equal(particles_add_field(block, "Two", "-", 2, 0, data), STATUS_NUMERICAL);
    assert_int_equal(particles_add_field(block, "Mass", "kg", 1, 0, data), STATUS_NUMERICAL);
    assert_int_equal(particles_reserve(block, (size_t)UINT32_MAX + 1), STATUS_MEMORY);
    assert_int_equal(particles_permute(block, NULL, 0), 0);
    assert_int_equal(block->n, 0);
    particles_destroy(block);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fields),  cmocka_unit_test(test_resize), cmocka_unit_test(test_growth),
        cmocka_unit_test(test_permute), cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
