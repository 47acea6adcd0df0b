// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints of a state made by hand.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/memory.h"
#include "output/checkpoint.h"
#include "output/checkpoint_internal.h"

#include "folder.h"

#include <math.h>
#include <stdbool.h>

/** A group whose number of items changes, one with a fixed number, one of single values. */
struct scene {
    size_t n, capacity, nodes;
    double *x[3];
    uint8_t *kind;
    float weight[4];
    double time;
    int64_t step;
    struct field particle_fields[3], node_fields[1], single_fields[2];
    struct field_group particles, mesh, singles;
    struct field_list list;
};

static int scene_resize(void *owner, size_t count)
{
    struct scene *scene = owner;
    for (int d = 0; d < 3; ++d) {
        memory_free(scene->x[d]);
        scene->x[d] = memory_create(count, sizeof(double));
        scene->particle_fields[0].data[d] = scene->x[d];
    }
    memory_free(scene->kind);
    scene->kind = memory_create(count, 1);
    scene->particle_fields[1].data[0] = scene->kind;
    scene->n = count;
    return 0;
}

static void scene_create(struct scene *scene, size_t n)
{
    *scene = (struct scene){.nodes = 2};
    scene->particle_fields[0] =
        (struct field){"Position", "m", FIELD_DOUBLE, 3, FIELD_STATE, {NULL, NULL, NULL}, NULL};
    scene->particle_fields[1] = (struct field){"Kind", "-", FIELD_UINT8, 1, FIELD_STATE, {NULL}, NULL};
    scene->particle_fields[2] = (struct field){"Shown", "-", FIELD_DOUBLE, 1, FIELD_OUTPUT, {NULL}, NULL};
    scene_resize(scene, n);
    scene->node_fields[0] = (struct field){"Weight", "-", FIELD_FLOAT, 2, FIELD_STATE, {scene->weight}, NULL};
    const struct field singles[] = {{"Time", "s", FIELD_DOUBLE, 1, FIELD_STATE, {&scene->time}, NULL},
                                    {"Step", "-", FIELD_INT64, 1, FIELD_STATE, {&scene->step}, NULL}};
    scene->particles =
        (struct field_group){"fluid", scene, &scene->n, scene->particle_fields, 3, scene_resize};
    scene->mesh = (struct field_group){
        .name = "solid", .owner = scene, .count = &scene->nodes, .fields = scene->node_fields, .n_fields = 1};
    scene->singles = field_singles("run", scene, scene->single_fields, singles, 2);
    assert_int_equal(field_list_add(&scene->list, &scene->particles), 0);
    assert_int_equal(field_list_add(&scene->list, &scene->mesh), 0);
    assert_int_equal(field_list_add(&scene->list, &scene->singles), 0);
}

static void scene_fill(struct scene *scene)
{
    for (size_t i = 0; i < scene->n; ++i) {
        for (int d = 0; d < 3; ++d)
            scene->x[d][i] = 0.1 + (double)i / 3.0 - d * 2.385;
        scene->kind[i] = (uint8_t)(i % 3);
    }
    for (int k = 0; k < 4; ++k)
        scene->weight[k] = 0.3f * (float)k;
    scene->time = 0.1 * 3;
    scene->step = INT64_C(1) << 41;
}

static void scene_reset(struct scene *scene)
{
    for (int d = 0; d < 3; ++d)
        memory_free(scene->x[d]);
    memory_free(scene->kind);
    field_list_reset(&scene->list);
}

static const struct checkpoint_note note_of_step_7 = {.step = 7,
                                                      .t = 0.1 * 3,
                                                      .wall_s = 1.0 / 3.0,
                                                      .updates = 1e12,
                                                      .phases_s = {1, 2, 3, 4, 5, 2.385},
                                                      .version = "0.1.0",
                                                      .revision = "abc-dirty",
                                                      .isa = "v3"};

static void test_round_trip(void **state)
{
    const struct folder *folder = *state;
    struct scene scene, back;
    struct checkpoint_note note;
    scene_create(&scene, 50);
    scene_fill(&scene);
    assert_int_equal(checkpoint_write(folder->path, &scene.list, &note_of_step_7, -1), 0);
    assert_int_equal(folder_count(folder->path), 2);
    scene_create(&back, 3); // of another length
    assert_int_equal(checkpoint_read(folder->path, &back.list, &note), 0);
    assert_memory_equal(&note, &note_of_step_7, sizeof note);
    assert_int_equal(back.n, 50);
    for (int d = 0; d < 3; ++d)
        assert_memory_equal(back.x[d], scene.x[d], 50 * sizeof(double));
    assert_memory_equal(back.kind, scene.kind, 50);
    assert_memory_equal(back.weight, scene.weight, sizeof back.weight);
    assert_true(back.time == 0.1 * 3 && back.step == INT64_C(1) << 41);
    scene_reset(&back);
    scene_reset(&scene);
    scene_create(&scene, 0); // nothing in it is fine
    assert_int_equal(checkpoint_write(folder->path, &scene.list, &note_of_step_7, -1), 0);
    scene_create(&back, 3);
    assert_int_equal(checkpoint_read(folder->path, &back.list, &note), 0);
    assert_int_equal(back.n, 0);
    scene_reset(&back);
    scene_reset(&scene);
}

/** Equal states give equal bytes; two checkpoints are kept, whatever else there was. */
static void test_two_are_kept(void **state)
{
    const struct folder *folder = *state;
    struct scene scene;
    uint64_t first, second;
    char path[256];
    scene_create(&scene, 20);
    scene_fill(&scene);
    struct checkpoint_note note = note_of_step_7;
    assert_int_equal(checkpoint_newest(folder->path), -1);
    for (int64_t step = 1; step <= 4; ++step) {
        note.step = step;
        assert_int_equal(checkpoint_write(folder->path, &scene.list, &note, step - 1), 0);
    }
    assert_int_equal(checkpoint_newest(folder->path), 4);
    assert_int_equal(folder_count(folder->path), 4);
    assert_int_equal(hash_file(folder_file(folder, "step_000000003.h5", path), &first, NULL), 0);
    assert_int_equal(hash_file(folder_file(folder, "step_000000004.h5", path), &second, NULL), 0);
    assert_true(first == second);
    // one from a time that the run has been set back before is not kept, a file of the user's is
    folder_write(folder_file(folder, "notes.txt", path), "mine", 4);
    note.step = 2;
    assert_int_equal(checkpoint_write(folder->path, &scene.list, &note, -1), 0);
    assert_int_equal(checkpoint_newest(folder->path), 2);
    assert_int_equal(folder_count(folder->path), 3);
    scene_reset(&scene);
}

/** A state that is not finite never replaces a good one. */
static void test_not_finite(void **state)
{
    const struct folder *folder = *state;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    struct scene scene;
    scene_create(&scene, 20);
    scene_fill(&scene);
    struct checkpoint_note note = note_of_step_7;
    assert_int_equal(checkpoint_write(folder->path, &scene.list, &note, -1), 0);
    note.step = 8;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        scene.x[1][13] = bad[k];
        assert_int_equal(checkpoint_write(folder->path, &scene.list, &note, -1), STATUS_NUMERICAL);
        assert_int_equal(checkpoint_newest(folder->path), 7);
        assert_int_equal(folder_count(folder->path), 2);
    }
    scene_reset(&scene);
}

/** Read the newest checkpoint into a scene that @p change has made different; the reason has @p words. */
static void refuse(const struct folder *folder, void (*change)(struct scene *), const char *words)
{
    struct scene scene;
    struct checkpoint_note note;
    char path[256], reason[CHECKPOINT_REASON] = "";
    scene_create(&scene, 20);
    scene_fill(&scene);
    field_list_reset(&scene.list);
    change(&scene);
    assert_int_equal(
        checkpoint_data_read(folder_file(folder, "step_000000007.h5", path), &scene.list, reason), STATUS_IO);
    if (!strstr(reason, words))
        fail_msg("\"%s\" is missing in \"%s\"", words, reason);
    assert_true(scene.x[0][19] == 0.1 + 19.0 / 3.0); // nothing has been filled
    assert_int_equal(checkpoint_read(folder->path, &scene.list, &note), STATUS_IO);
    scene_reset(&scene);
}

static void groups_add(struct scene *scene, bool particles, bool mesh, bool singles)
{
    scene->particles.n_fields = 3;
    if (particles)
        assert_int_equal(field_list_add(&scene->list, &scene->particles), 0);
    if (mesh)
        assert_int_equal(field_list_add(&scene->list, &scene->mesh), 0);
    if (singles)
        assert_int_equal(field_list_add(&scene->list, &scene->singles), 0);
}

static void without_group(struct scene *scene)
{
    groups_add(scene, true, true, false);
}

static void other_group(struct scene *scene)
{
    scene->mesh.name = "beam";
    groups_add(scene, true, true, true);
}

static void without_field(struct scene *scene)
{
    scene->particle_fields[1].flags = 0;
    groups_add(scene, true, true, true);
}

static void other_field(struct scene *scene)
{
    scene->single_fields[0].name = "Clock";
    groups_add(scene, true, true, true);
}

static void other_type(struct scene *scene)
{
    scene->single_fields[0].type = FIELD_INT64;
    groups_add(scene, true, true, true);
}

static void other_count(struct scene *scene)
{
    scene->nodes = 1;
    groups_add(scene, true, true, true);
}

static void other_components(struct scene *scene)
{
    scene->node_fields[0].components = 1;
    groups_add(scene, true, true, true);
}

/** A checkpoint of another deck or program is refused before anything is filled. */
static void test_other_states(void **state)
{
    const struct folder *folder = *state;
    struct scene scene;
    scene_create(&scene, 30);
    scene_fill(&scene);
    assert_int_equal(checkpoint_write(folder->path, &scene.list, &note_of_step_7, -1), 0);
    scene_reset(&scene);
    refuse(folder, without_group, "it has 3 groups, not 2");
    refuse(folder, other_group, "beam is not a group of it");
    refuse(folder, without_field, "fluid has other fields");
    refuse(folder, other_field, "run/Clock is missing");
    refuse(folder, other_type, "run/Time has another type");
    refuse(folder, other_count, "solid/Weight has another number of values");
    refuse(folder, other_components, "solid/Weight has another number of values");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_round_trip, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_two_are_kept, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_not_finite, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_other_states, folder_enter, folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
