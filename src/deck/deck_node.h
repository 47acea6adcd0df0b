// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef DECK_DECK_NODE_H
#define DECK_DECK_NODE_H

#include "deck/deck_schema.h"
#include "deck/unit.h"
#include "model/model.h"

#include <stdarg.h>

/** Inside of the deck reader: the deck as a tree of elements known to the schema, and typed access to its
 * values. */

struct deck_attribute {
    char *text; /**< NULL: not given */
    struct location where;
};

struct deck_node {
    const struct schema_element *element;
    enum schema_id id;
    struct location where;
    struct deck_node *parent, *children, *next;
    struct deck_attribute *attributes; /**< one per attribute of the schema, in its order */
    char *text;                        /**< of elements that hold text, otherwise NULL */
};

struct deck_error {
    struct location where;
    char *text; /**< the whole line */
};

/** Everything known while a deck is read. */
struct deck {
    const char *path;
    size_t n_overrides;
    const char *const *overrides; /**< "NAME=VALUE" */
    size_t n_before; /**< how many belonged to the run that is resumed; n_overrides: nothing is resumed */
    struct deck_node *root;
    struct model *model;
    size_t input_capacity; /**< of model->inputs */
    struct unit_system units;
    struct expression_scope scope; /**< parameters and functions so far */
    bool spoilt;                   /**< some parameter has no value (NaN), which has been noted */
    bool *surface_used;            /**< per surface of the model: something refers to it */
    size_t n_errors, error_capacity;
    struct deck_error *errors;
    size_t n_problems; /**< errors, and values that could not be used because of an error noted elsewhere:
                          checks that need several values are left out where it has grown */
    int status;        /**< worst thing that is no mistake of the deck: STATUS_MEMORY, STATUS_USAGE, ... */
};

/* ---- errors (deck_error.c) ---- */

/** Note an error at a place of the deck. */
void deck_error_at(struct deck *deck, struct location where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/** Note an error at an attribute (NULL or absent: at the element), with the element in front: <mesh
 * name="beam">: ... */
void deck_error(struct deck *deck, const struct deck_node *node, const char *attribute, const char *format,
                ...) __attribute__((format(printf, 4, 5)));

/** Note an error unless the deck has dimension @p dim. */
void deck_need_dim(struct deck *deck, const struct deck_node *node, int dim, const char *instead);

/** Log a warning at an element. */
void deck_warning(const struct deck *deck, struct location where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/** '; did you mean "rubber"?' or '; known: "a", "b"' into @p text. */
void deck_suggest(const char *word, const char *const *names, size_t n, char *text, size_t size);

/** Print the errors in the order of the deck and free them. Returns deck->status, or STATUS_DECK if there
 * were any. */
int deck_errors_finish(struct deck *deck);

/* ---- the tree (deck_xml.c, deck_tree.c) ---- */

/** Parse @p size bytes of @p text into deck->root and check its structure; mistakes are noted. */
int deck_parse(struct deck *deck, const char *text, size_t size);

void deck_node_destroy(struct deck_node *node);

/** Check required attributes, counts of children, duplicate names in the tree below @p node. */
void deck_check_structure(struct deck *deck, const struct deck_node *node);

/** First child of kind @p id, or NULL; the next one of the same kind. */
struct deck_node *deck_child(const struct deck_node *node, enum schema_id id);
struct deck_node *deck_next(const struct deck_node *node);
size_t deck_count(const struct deck_node *node, enum schema_id id);

/** Add a child with all its defaults, as if it had been written. NULL: no memory. */
struct deck_node *deck_add(struct deck *deck, struct deck_node *parent, enum schema_id id);

/** Whether an attribute was given. */
bool deck_has(const struct deck_node *node, const char *name);

/** Text of an attribute as given, or its default; NULL: neither. Not owned. */
const char *deck_text(const struct deck_node *node, const char *name);

/** The same; that a required attribute is missing has been noted, and counts as a problem. */
const char *deck_get(struct deck *deck, const struct deck_node *node, const char *name);

/** Fill in an attribute that was not given, so that deck_show prints it. */
void deck_fill(struct deck *deck, struct deck_node *node, const char *name, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* ---- values (deck_value.c, deck_list.c); mistakes are noted and give 0, NULL or -1 ---- */

/** Value of @p text: number, number with unit (to @p unit; NULL: any), or constant expression. Returns
 * whether it is one; otherwise @p message says why; it is empty where a parameter without value is the cause.
 */
bool deck_evaluate(struct deck *deck, const char *text, const char *unit, double *value, char *message,
                   size_t size);

/** Note what deck_evaluate said about the value of an attribute; an empty message only counts as a problem.
 */
void deck_error_value(struct deck *deck, const struct deck_node *node, const char *attribute,
                      const char *text, const char *message);

/** The value that the last of the first @p n_overrides overrides of a <parameter> gives to it, or NULL. */
const char *deck_override(const struct deck *deck, const struct deck_node *node, size_t n_overrides);

/** Whether the value of an attribute (number in the table) uses the parameter or function @p name; of a
 * <parameter>, the value that it has after --set. Names, units and words that are no expressions use none. */
bool deck_mentions(struct deck *deck, const struct deck_node *node, size_t attribute, const char *name);

/** The first of @p node, its siblings behind it and all below them with an attribute (its number: *@p
 * attribute) that mentions one of @p n names and of which @p counts says so (NULL: every one); NULL: none. */
const struct deck_node *deck_find_mention(struct deck *deck, const struct deck_node *node, size_t n,
                                          const char *const *names,
                                          bool (*counts)(const struct deck_node *node, size_t attribute),
                                          size_t *attribute);

/** Compile an expression; a number with a unit is one too. NULL after noting a mistake. */
struct expression *deck_compile(struct deck *deck, const struct deck_node *node,
                                const struct schema_attribute *attribute, const char *text);

double deck_real(struct deck *deck, const struct deck_node *node, const char *name);
int deck_integer(struct deck *deck, const struct deck_node *node, const char *name);

/** Number of the word in the attribute's list of choices; -1: not given and no default. */
int deck_choice(struct deck *deck, const struct deck_node *node, const char *name);
bool deck_yes(struct deck *deck, const struct deck_node *node, const char *name);

/** A copy of the text; NULL: not given. */
char *deck_word(struct deck *deck, const struct deck_node *node, const char *name);

/** Index of the object an attribute refers to, -1: not given or unknown (noted). @p objects: an array of
 * structs of @p size bytes whose first member is the name; @p what: "material". */
int deck_reference(struct deck *deck, const struct deck_node *node, const char *name, const char *what,
                   const void *objects, size_t n, size_t size);

/** One attribute's lists: *@p values (memory_free) gets the indices of the objects. */
size_t deck_references(struct deck *deck, const struct deck_node *node, const char *name, const char *what,
                       const void *objects, size_t n, size_t size, int **values);

/** Set chosen[k] for each word of a list of choices. */
void deck_choices(struct deck *deck, const struct deck_node *node, const char *name, bool *chosen);

/** One real per dimension; the rest 0. About axes: z in 2-D, x, y, z in 3-D. The entries of a tensor: zz in
 * 2-D, xx yy zz xy yz xz in 3-D. False if not given. */
bool deck_vector(struct deck *deck, const struct deck_node *node, const char *name, double value[3]);
bool deck_turn(struct deck *deck, const struct deck_node *node, const char *name, double value[3]);
bool deck_inertia(struct deck *deck, const struct deck_node *node, const char *name, double value[3][3]);
bool deck_cells(struct deck *deck, const struct deck_node *node, const char *name, int value[3]);
size_t deck_integers(struct deck *deck, const struct deck_node *node, const char *name, long **values);
size_t deck_points(struct deck *deck, const struct deck_node *node, const char *name, double (**points)[3]);

/** NULL if not given. */
struct expression *deck_expression(struct deck *deck, const struct deck_node *node, const char *name);
bool deck_expressions(struct deck *deck, const struct deck_node *node, const char *name,
                      struct expression *value[3]);

/** Cut a list in place at blanks that are outside parentheses and do not belong to an operator: a blank
 * behind an operator joins, one in front of it too, except before a sign that is followed by no blank ("2 -1"
 * has two entries, "2 - 1" one).
 * *@p entries (memory_free) point into @p text. Returns their number. */
size_t deck_split(struct deck *deck, char *text, char ***entries);

/** Numbers of an element's text: rows of @p columns. *@p values is freed with memory_free. Returns the number
 * of rows. */
size_t deck_numbers(struct deck *deck, const struct deck_node *node, const char *text, size_t columns,
                    double **values);

/** Unit that an attribute's values are in. */
const char *deck_unit(const struct deck *deck, const struct schema_attribute *attribute);

/** Allocate; on failure deck->status becomes STATUS_MEMORY. */
void *deck_memory(struct deck *deck, size_t count, size_t size);

/* ---- sections: deck tree -> model ---- */
int deck_read_parameters(struct deck *deck);
int deck_check_resume(struct deck *deck); /**< right after the parameters, whose overrides it may refuse */
int deck_read_time(struct deck *deck);
int deck_read_domain(struct deck *deck);
int deck_read_materials(struct deck *deck);
int deck_read_meshes(struct deck *deck);
void deck_read_rigid(struct deck *deck, const struct deck_node *mesh, struct model_mesh *definition);
void deck_read_facets(struct deck *deck, const struct deck_node *node, struct facets *facets);
int deck_read_surfaces(struct deck *deck);
int deck_read_fluid(struct deck *deck);
int deck_read_region(struct deck *deck, struct deck_node *node, struct model_region *region);
int deck_read_shape(struct deck *deck, const struct deck_node *node, struct shape *shape);
int deck_read_boundaries(struct deck *deck);
int deck_read_coupling(struct deck *deck);
int deck_read_output(struct deck *deck);
void deck_read_motion(struct deck *deck, const struct deck_node *node, struct motion *motion);

/** List a file among the inputs of the model unless it is there: @p name relative to the deck's folder, @p
 * data the @p size bytes that were read from @p path. Returns 0 or STATUS_MEMORY. */
int deck_note_input(struct deck *deck, const char *name, const char *path, const char *data, size_t size);

/** Read a whole deck into deck->model with its tree kept; errors are printed. Reset in any case. @p n_before:
 * as of deck_read_resume. */
int deck_load(struct deck *deck, const char *path, size_t n_overrides, const char *const *overrides,
              size_t n_before);
void deck_reset(struct deck *deck);

#endif
