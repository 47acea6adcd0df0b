// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/memory.h"
#include "deck/deck.h"
#include "decks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char deck_path[] = "/tmp/skerry-deck-XXXXXX";

static int setup(void **state)
{
    (void)state;
    log_set_level(LOG_ERROR);
    int file = mkstemp(deck_path);
    return file < 0 || close(file);
}

static int teardown(void **state)
{
    (void)state;
    return unlink(deck_path);
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void write_deck(const char *text)
{
    write_file(deck_path, text);
}

/** The deck of everything with one piece replaced. */
static void write_variant(const char *piece, const char *replacement)
{
    char text[16384];
    const char *found = strstr(deck_of_everything, piece);
    if (!found)
        fail_msg("\"%s\" is not in the deck", piece);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(found - deck_of_everything), deck_of_everything,
             replacement, found + strlen(piece));
    write_deck(text);
}

static struct model *read_deck(void)
{
    struct model *model;
    assert_int_equal(deck_read(&model, deck_path, 0, NULL), 0);
    assert_non_null(model);
    return model;
}

static void assert_near(double value, double wanted)
{
    if (!(fabs(value - wanted) <= 1e-13 * fmax(1.0, fabs(wanted))))
        fail_msg("%.17g is not %.17g", value, wanted);
}

static void assert_vector(const double *value, double x, double y, double z)
{
    assert_near(value[0], x);
    assert_near(value[1], y);
    assert_near(value[2], z);
}

static void test_values(void **state)
{
    (void)state;
    write_deck(deck_of_everything);
    struct model *model = read_deck();
    assert_int_equal(model->dim, 3);
    assert_int_equal(model->n_parameters, 2);
    assert_near(model->parameters[0].value, 0.1);
    assert_near(model->parameters[1].value, 2.0);
    assert_int_equal(model->parameters[1].where.line, 2);
    assert_near(model->time.end, 1.0);
    assert_near(model->time.step, 1e-4);
    assert_near(expression_value(model->time.body_force[1], NULL, 7.0), -9.81);
    assert_near(expression_value(model->time.body_force[2], NULL, 0.4), 3.0 * sin(0.8));
    assert_vector(model->domain.upper, 2, 2, 2);
    assert_true(model->domain.periodic[2] && !model->domain.periodic[0]);
    assert_int_equal(model->domain.outside, OUTSIDE_REMOVE);
    assert_near(model->fluid_materials[0].density, 900.0);
    assert_near(model->fluid_materials[0].kinematic_viscosity, 1e-6);
    assert_near(model->fluid_materials[0].background_pressure, 1e5);
    assert_near(model->solid_materials[0].young, 2.5e6);
    assert_string_equal(model->solid_materials[0].law, "saint-venant-kirchhoff");
    assert_true(model->fluid.present);
    assert_int_equal(model->fluid.material, 0);
    assert_string_equal(model->fluid.formulation, "transport-velocity");
    assert_int_equal(model->fluid.arithmetic, ARITHMETIC_DOUBLE);
    assert_int_equal(model->fluid.kernel_constant, KERNEL_PUBLISHED);
    assert_near(model->fluid.smoothing_length_ratio, 1.2);
    assert_string_equal(model->output.arrays[0], "Vorticity"); // in the order of the table
    assert_int_equal(model->output.n_arrays, 2);
    assert_true(model->output.float64);
    assert_int_equal(model->output.virtual_particles[2], 3);
    assert_string_equal(model->coupling.scheme,
                        "fixed-point"); // by default, as a wall has the skin of a mesh
    assert_string_equal(model->coupling.acceleration, "aitken");
    assert_int_equal(model->coupling.iterations, 10);
    model_destroy(model);
}

/** What a scheme, an acceleration or a criterion brings with it. */
static void test_coupling(void **state)
{
    (void)state;
    static const char *const given = "<coupling tolerance='1e-6' iterations='10' acceleration='aitken' "
                                     "relaxation='0.5'/>";
    write_deck(deck_of_everything);
    struct model *model = read_deck();
    assert_near(model->coupling.tolerance, 1e-6);
    assert_true(model->coupling.force_tolerance == 0.0 && model->coupling.solid_every == 0);
    assert_int_equal(model->coupling.predictor, PREDICTOR_LINEAR);
    model_destroy(model);

    write_variant(given, "<coupling force-tolerance='2.5 mN' acceleration='iqn-ils' reused-steps='3'/>");
    model = read_deck();
    assert_true(model->coupling.tolerance == 0.0); // only what is asked for
    assert_near(model->coupling.force_tolerance, 2.5e-3);
    assert_int_equal(model->coupling.reused_steps, 3);
    assert_near(model->coupling.filter, 1e-2);
    assert_int_equal(model->coupling.iterations, 50);
    model_destroy(model);

    write_variant(given, "<coupling scheme='sub-cycled'/>");
    model = read_deck();
    assert_near(model->coupling.tolerance, 1e-8);
    assert_int_equal(model->coupling.solid_every, 2);
    assert_int_equal(model->coupling.predictor, PREDICTOR_CONSTANT);
    assert_string_equal(model->coupling.acceleration, "added-mass");
    model_destroy(model);

    write_variant(given, "<coupling scheme='sub-cycled' solid-every='6' predictor='zero-acceleration'/>");
    model = read_deck();
    assert_int_equal(model->coupling.solid_every, 6);
    assert_int_equal(model->coupling.predictor, PREDICTOR_ZERO);
    model_destroy(model);
}

static void test_regions(void **state)
{
    (void)state;
    write_deck(deck_of_everything);
    struct model *model = read_deck();
    const struct model_region *region = &model->fluid.regions[0];
    const double x[3] = {0.3, 0.4, 0.5};
    assert_int_equal(model->fluid.n_regions, 2);
    assert_true(region->has_origin);
    assert_vector(region->origin, -0.5, -0.5, -0.5); // the lower corner of the bounding box
    assert_near(expression_value(region->velocity[2], x, 0.0), -0.3);
    const struct shape *shape = &region->shape;
    assert_int_equal(shape->kind, SHAPE_DIFFERENCE);
    assert_int_equal(shape->n_children, 4);
    assert_int_equal(shape->children[1].kind, SHAPE_UNION);
    assert_int_equal(shape->children[1].children[1].kind, SHAPE_CYLINDER);
    assert_near(shape->children[1].children[1].inner_radius, 0.1);
    assert_vector(shape->children[2].children[0].b, 0, 0, 1); // normals are made unit vectors
    assert_ptr_equal(shape->children[2].children[1].facets, &model->surfaces[0].built);
    assert_int_equal(shape->children[3].kind, SHAPE_BALL);
    assert_near(shape->children[3].radius, 0.05);
    assert_int_equal(model->fluid.regions[1].n_points, 3);
    assert_vector(model->fluid.regions[1].points[2], 1.2, 1, 1);
    model_destroy(model);
}

static void test_meshes(void **state)
{
    (void)state;
    write_deck(deck_of_everything);
    struct model *model = read_deck();
    const struct model_mesh *mesh = &model->meshes[0];
    double x[3], v[3], a[3];
    assert_int_equal(mesh->mesh.n_elements, 12); // 0.3/dx is 3 up to rounding
    assert_int_equal(mesh->formulation, SOLID_F_BAR);
    assert_int_equal(mesh->n_supports, 2);
    assert_string_equal(mesh->mesh.sets[mesh->supports[0].set].name, "x-");
    assert_true(mesh->supports[0].fixed[0] && !mesh->supports[0].fixed[1] && mesh->supports[0].fixed[2]);
    assert_false(mesh->supports[0].moves);
    assert_true(mesh->supports[1].moves);
    motion_at(&mesh->supports[1].motion, (double[3]){2, 1, 1}, 0.25, x, v, a);
    assert_vector(x, 1.25 + cos(0.5), 1 + sin(0.5), 1);
    assert_int_equal(mesh->n_loads, 2);
    assert_near(expression_value(mesh->loads[0].force[0], NULL, 0.0), 1000.0);
    assert_near(expression_value(mesh->loads[0].force[2], NULL, 3.0), -3.0);
    assert_int_equal(mesh->loads[1].set, -1);
    assert_near(expression_value(mesh->displacement[0], (double[3]){7, 8, 9}, 0.0), 7.0);
    assert_near(expression_value(mesh->velocity[2], (double[3]){7, 8, 9}, 0.0), 8.0);
    assert_int_equal(model->meshes[1].mesh.type, ELEMENT_TET4);
    assert_int_equal(model->meshes[1].mesh.n_elements, 1);
    assert_int_equal(model->meshes[1].mesh.connectivity[3], 3);
    assert_int_equal(model->meshes[1].where.line, 29);
    model_destroy(model);
}

static void test_surfaces(void **state)
{
    (void)state;
    write_deck(deck_of_everything);
    struct model *model = read_deck();
    double x[3], v[3], a[3];
    assert_int_equal(model->n_surfaces, 4);
    assert_int_equal(model->surfaces[0].built.n_facets, 4);
    assert_int_equal(model->surfaces[0].built_mesh[0], -1);
    assert_int_equal(model->surfaces[0].motion.kind, MOTION_FIELD);
    motion_at(&model->surfaces[0].motion, (double[3]){2, 0, 0}, 3.0, x, v, a);
    assert_vector(x, 2, 0, 0.6);
    assert_int_equal(model->surfaces[1].kind, SURFACE_SPHERE);
    assert_int_equal(model->surfaces[2].kind, SURFACE_CYLINDER);
    assert_vector(model->surfaces[2].axis, 0, 0.6, 0.8);
    assert_true(model->surfaces[2].fluid_inside);
    assert_vector(model->surfaces[2].motion.axis, 0, 0.6, 0.8);
    assert_int_equal(model->surfaces[3].parts[0].mesh, 0);
    assert_int_equal(model->surfaces[3].built.n_facets, 2 * (2 * 2 + 2 * 3 + 2 * 3) - 2 * 3);
    model_destroy(model);
}

static void test_boundaries(void **state)
{
    (void)state;
    write_deck(deck_of_everything);
    struct model *model = read_deck();
    assert_int_equal(model->n_walls, 2);
    assert_int_equal(model->walls[0].n_surfaces, 4);
    assert_int_equal(model->walls[0].surfaces[2], 2);
    assert_int_equal(model->walls[0].corners, CORNERS_PAPER);
    assert_false(model->walls[0].pressure_gradient);
    assert_true(model->walls[1].has_region && model->walls[1].pressure_gradient);
    assert_int_equal(model->walls[1].motion.kind, MOTION_RIGID);
    assert_int_equal(model->n_openings, 2);
    assert_int_equal(model->openings[0].kind, OPEN_INFLOW);
    assert_vector(model->openings[0].lower, -1, -1, -1); // by default the domain
    assert_int_equal(model->openings[1].into, -1);
    assert_int_equal(model->openings[1].axis, 1);
    assert_vector(model->openings[1].lower, 0, 1, 0);
    assert_near(expression_value(model->openings[1].pressure, NULL, 0.0), 6.0);
    assert_int_equal(model->openings[1].velocity_rule, OPEN_MOMENTUM);
    assert_int_equal(model->output.n_histories, 4);
    assert_int_equal(model->output.histories[2].n_surfaces, 2);
    assert_int_equal(model->output.histories[2].surfaces[1], 3);
    assert_int_equal(model->output.histories[3].mesh, 1);
    assert_vector(model->output.histories[3].from, 0.1, 0.2, 0.3);
    assert_vector(model->output.histories[1].to, 1, 0, 0);
    assert_int_equal(model->output.histories[1].points, 3);
    assert_near(model->output.histories[0].every, 0.2);
    model_destroy(model);
}

/** With a default, whether the element is there or not; in wall-clock seconds. */
static void test_checkpoints(void **state)
{
    (void)state;
    static const struct {
        const char *element;
        double every;
    } cases[] = {
        {"", 600.0},
        {"<checkpoints/>", 600.0},
        {"<checkpoints every='0'/>", 0.0},
        {"<checkpoints every='10 min'/>", 600.0},
        {"<checkpoints every='dx*w'/>", 0.2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[128];
        snprintf(text, sizeof text, "%s</output>", cases[i].element);
        write_variant("</output>", text);
        struct model *model = read_deck();
        assert_near(model->output.checkpoint_every, cases[i].every);
        model_destroy(model);
    }
}

static void assert_input(const struct model_input *input, const char *name, const char *path,
                         const char *text)
{
    uint64_t hash;
    size_t size;
    assert_string_equal(input->name, name);
    assert_int_equal(hash_file(input->path, &hash, &size), 0);
    assert_true(input->hash == hash && input->size == size);
    assert_true(hash == hash_bytes(text, strlen(text)) && size == strlen(text));
    assert_true(access(path, R_OK) == 0 && hash_file(path, &hash, NULL) == 0 && input->hash == hash);
}

/** The deck and each file that it names are listed once, with what was read. */
static void test_inputs(void **state)
{
    (void)state;
    static const char near[] = "1 1 1\r\n1.2 1 1\n", far[] = "1.4 1 1 # one point";
    const char *slash = strrchr(deck_path, '/');
    char *folder = memory_print("%s.d", deck_path), *first = memory_print("%s/b.txt", folder),
         *second = memory_print("%s/a.xml", folder);
    assert_int_equal(file_make_folder(folder), 0);
    write_file(first, near);
    write_file(second, far);
    char *points = memory_print("<points file='%s.d/b.txt'/></region><region><points file='./%s.d//a.xml'/>"
                                "</region><region><points file='%s.d/./b.txt'/></region>",
                                slash + 1, slash + 1, slash + 1);
    write_variant("<points>1 1 1\n 1.1 1 1 # not 9 9 9\n 1.2 1 1</points></region>", points);
    char *text = NULL;
    size_t size;
    assert_int_equal(file_read(deck_path, 1 << 20, &text, &size), 0);
    struct model *model = read_deck();
    assert_int_equal(model->fluid.n_regions, 4);
    assert_int_equal(model->fluid.regions[3].n_points, 2);
    assert_int_equal(model->n_inputs, 3);
    assert_string_equal(model->inputs[0].path, deck_path);
    assert_input(&model->inputs[0], slash + 1, deck_path, text);
    assert_input(&model->inputs[1], first + (slash + 1 - deck_path), first, near);
    assert_input(&model->inputs[2], second + (slash + 1 - deck_path), second, far);
    model_destroy(model);
    assert_true(unlink(first) == 0 && unlink(second) == 0 && rmdir(folder) == 0);
    memory_free(text);
    memory_free(points);
    memory_free(first);
    memory_free(second);
    memory_free(folder);
}

/** A deck that names no file is its only input; its name keeps the extension. */
static void test_input_of_deck(void **state)
{
    (void)state;
    char *path = memory_print("%s.xml", deck_path);
    struct model *model;
    write_file(path, deck_of_everything);
    assert_int_equal(deck_read(&model, path, 0, NULL), 0);
    assert_int_equal(model->n_inputs, 1);
    assert_input(&model->inputs[0], strrchr(path, '/') + 1, path, deck_of_everything);
    assert_string_equal(model->name, strrchr(deck_path, '/') + 1);
    model_destroy(model);
    assert_int_equal(unlink(path), 0);
    memory_free(path);
}

static char *show(size_t n, const char *const *overrides)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    assert_int_equal(deck_show(deck_path, n, overrides, stream), 0);
    assert_int_equal(fclose(stream), 0);
    return text;
}

/** What is shown reads to the same model: it is shown in the same way, and these values agree. */
static void test_show(void **state)
{
    (void)state;
    write_deck(deck_of_everything);
    struct model *model = read_deck();
    char *first = show(0, NULL);
    write_deck(first);
    char *second = show(0, NULL);
    assert_string_equal(first, second);
    assert_non_null(strstr(first, " formulation=\"transport-velocity\""));
    assert_non_null(strstr(first, " origin=\"-0.5 -0.5 -0.5\""));
    assert_non_null(strstr(first, " scheme=\"fixed-point\""));
    assert_non_null(strstr(first, "<checkpoints every=\"600\"/>"));
    assert_non_null(strstr(first, " cells=\"2 2 3\"")); // 0.3/dx is a whole number after rounding
    struct model *again = read_deck();
    assert_int_equal(again->fluid.regions[0].shape.n_children, model->fluid.regions[0].shape.n_children);
    assert_memory_equal(again->fluid.regions[0].origin, model->fluid.regions[0].origin, 3 * sizeof(double));
    assert_true(again->fluid.spacing == model->fluid.spacing);
    assert_true(again->fluid_materials[0].density == model->fluid_materials[0].density);
    assert_memory_equal(again->meshes[0].mesh.X, model->meshes[0].mesh.X,
                        model->meshes[0].mesh.n_nodes * 3 * sizeof(double));
    assert_memory_equal(again->surfaces[3].built.nodes, model->surfaces[3].built.nodes,
                        model->surfaces[3].built.n_facets * 4 * sizeof(int32_t));
    for (int i = 0; i < 5; i++) {
        const double t = 0.37 * i;
        assert_true(expression_value(again->time.body_force[2], NULL, t) ==
                    expression_value(model->time.body_force[2], NULL, t));
    }
    model_destroy(again);
    model_destroy(model);
    free(first);
    free(second);
}

static void test_overrides(void **state)
{
    (void)state;
    struct model *model;
    write_deck(deck_of_everything);
    const char *const good[] = {"dx=7", "dx=0.4/8"}; // the last one counts
    assert_int_equal(deck_read(&model, deck_path, 2, good), 0);
    assert_near(model->fluid.spacing, 0.05);
    assert_near(model->parameters[1].value, 1.0); // parameters that use it follow
    assert_string_equal(model->parameters[0].text, "0.4/8");
    model_destroy(model);
    const char *const unknown[] = {"dxx=1"}, *const incomplete[] = {"dx"}, *const wrong[] = {"dx=1+"};
    assert_int_equal(deck_read(&model, deck_path, 1, unknown), STATUS_USAGE);
    assert_null(model);
    assert_int_equal(deck_read(&model, deck_path, 1, incomplete), STATUS_USAGE);
    assert_int_equal(deck_read(&model, deck_path, 1, wrong), STATUS_USAGE);
}

/** Blanks separate, except inside parentheses and beside operators. */
static void test_lists(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double x, y, z; // x = NAN: refused
    } cases[] = {
        {"1 2 3", 1, 2, 3},
        {"  1\t2\n3 ", 1, 2, 3},
        {"-1 -2 -3", -1, -2, -3},
        {"3 - 1 -2 +4", 2, -2, 4},
        {"max(1, 2) (3 + 4) 5*2", 2, 7, 10},
        {"2 * 3 2*-1 4 /2", 6, -2, 2},
        {"1 &lt; 2 ? 5 : 6 1 2", 5, 1, 2},
        {"4mm 1.5e-3 2cm", 0.004, 0.0015, 0.02},
        {"1 2", NAN, 0, 0},
        {"1 2 3 4", NAN, 0, 0},
        {"4 mm 3 mm 2 mm", NAN, 0, 0},
        {"1 2 t", NAN, 0, 0},
        {"1 2 3s", NAN, 0, 0},
        {"0x10 2 3", NAN, 0, 0},
        {"inf 2 3", NAN, 0, 0},
        {"1e999 2 3", NAN, 0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char attribute[128];
        struct model *model;
        snprintf(attribute, sizeof attribute, "<ball centre='%s'", cases[i].text);
        write_variant("<ball centre='0 0 0'", attribute);
        int status = deck_read(&model, deck_path, 0, NULL);
        if (status != (isnan(cases[i].x) ? STATUS_DECK : 0))
            fail_msg("\"%s\": status %d", cases[i].text, status);
        if (status == 0)
            assert_vector(model->fluid.regions[0].shape.children[1].children[0].a, cases[i].x, cases[i].y,
                          cases[i].z);
        model_destroy(model);
    }
}

/** Mistakes beyond those of tests/decks-bad. */
static void test_mistakes(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"smoothing-length-ratio='1.2'", "smoothing-length-ratio='0'"},
        {"rho-infinity='1'", "rho-infinity='1.01'"},
        {"cells='2 2 0.3/dx'", "cells='2 2 0'"},
        {"cells='2 2 0.3/dx'", "cells='2 2 0.35/dx'"},
        {"nodes='0 1 2'", "nodes='0 1 3000'"},
        {"<set name='some'", "<set name='x-'"},
        {"fixed='x z'", "fixed='x q'"},
        {"axis='0 0 2'", ""},
        {"axis='0 0 2'", "axis='0 0 0'"},
        {"inner-radius='0.1'", "inner-radius='0.4'"},
        {"<cylinder from='0 0 0' to='0 0 1'", "<cylinder from='0 0 1' to='0 0 1'"},
        {"<rotation centre='0 0 0' axis='0 3 4' angle='t'",
         "<displacement value='0 0 t'/><rotation centre='0 0 0' axis='0 3 4' angle='t'"},
        {"exclude='x-'", "exclude='x'"},
        {"surfaces='pipe skin'", "surfaces='pipe pipe'"},
        {"points='3'", "points='3.5'"},
        {"<points>1 1 1\n", "<points>1 1 1 1\n"},
        {"<points>1 1 1\n", "<points>1 1 one\n"},
        {"<points>1 1 1\n", "<points file='x'>1 1 1\n"},
        {"virtual-particles='1 2 3'", "virtual-particles='1 -2'"},
        {"<elements type='tri3'>0 2 1", "<elements type='tet4'>0 2 1"},
        {"name='block'", "name='a/b'"},
        {"<parameter name='w'", "<parameter name='sin'"},
        {"<inside surface='ball'/>", "<inside surface='pipe'/>"},
        {"<history name='tip'", "<history name='load'"},
        {"into='+'", "into='1'"},
    };
    struct model *model;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_variant(cases[i][0], cases[i][1]);
        if (deck_read(&model, deck_path, 0, NULL) != STATUS_DECK)
            fail_msg("accepted: %s", cases[i][1]);
        assert_null(model);
    }
    assert_int_equal(deck_read(&model, "/nowhere/deck.xml", 0, NULL), STATUS_NO_INPUT);
}

/** A solid alone needs neither fluid nor domain; a fluid neither meshes nor walls. */
static void test_parts_alone(void **state)
{
    (void)state;
    write_deck("<deck version='1' dim='2'><output><fields every='1'/></output><time end='1' step='0.1'/>"
               "<materials><solid name='s' density='1' young='1' poisson='0'/></materials>"
               "<meshes><mesh name='m' material='s'><grid lower='0 0' upper='1 1' cells='1 "
               "1'/></mesh></meshes></deck>");
    struct model *model = read_deck();
    assert_false(model->fluid.present);
    assert_string_equal(model->coupling.scheme, "none");
    assert_int_equal(model->meshes[0].formulation, SOLID_EAS);
    assert_near(model->meshes[0].rho_infinity, 0.8);
    model_destroy(model);
    write_deck(
        "<deck version='1' dim='1'><time end='1' step='0.1'/><domain lower='-1' upper='1' periodic='x'/>"
        "<materials><fluid name='w' density='1' kinematic-viscosity='0' sound-speed='1' "
        "background-pressure='0'/>"
        "</materials><fluid material='w' spacing='0.1'><region><box lower='-1' upper='1'/></region></fluid>"
        "<output><fields every='1'/></output></deck>");
    model = read_deck();
    assert_string_equal(model->coupling.scheme, "none");
    assert_int_equal(model->n_meshes, 0);
    model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),        cmocka_unit_test(test_coupling),
        cmocka_unit_test(test_regions),       cmocka_unit_test(test_meshes),
        cmocka_unit_test(test_surfaces),      cmocka_unit_test(test_boundaries),
        cmocka_unit_test(test_checkpoints),   cmocka_unit_test(test_inputs),
        cmocka_unit_test(test_input_of_deck), cmocka_unit_test(test_show),
        cmocka_unit_test(test_overrides),     cmocka_unit_test(test_lists),
        cmocka_unit_test(test_mistakes),      cmocka_unit_test(test_parts_alone)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
