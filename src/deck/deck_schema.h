// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef DECK_DECK_SCHEMA_H
#define DECK_DECK_SCHEMA_H

#include <stdbool.h>
#include <stdio.h>

/** The one description of what a deck may say. From these tables come the reader's checks and defaults, the
 * XML schema, the help texts and "skerry show". */

enum schema_kind {
    SCHEMA_NAME,        /**< a new name */
    SCHEMA_TEXT,        /**< any text */
    SCHEMA_CHOICE,      /**< one of choices */
    SCHEMA_CHOICES,     /**< any of choices, blank-separated */
    SCHEMA_REAL,        /**< number, number with unit, or constant expression */
    SCHEMA_INTEGER,     /**< the same, a whole number */
    SCHEMA_INTEGERS,    /**< list of whole numbers */
    SCHEMA_VECTOR,      /**< one real per dimension */
    SCHEMA_CELLS,       /**< one whole number per dimension */
    SCHEMA_TURN,        /**< reals about axes: one in 2-D, three in 3-D */
    SCHEMA_INERTIA,     /**< the entries of a symmetric tensor about axes: one in 2-D, six in 3-D */
    SCHEMA_POINTS,      /**< any number of vectors */
    SCHEMA_EXPRESSION,  /**< expression in variables */
    SCHEMA_EXPRESSIONS, /**< one expression per dimension */
    SCHEMA_REFERENCE,   /**< name of an object */
    SCHEMA_REFERENCES   /**< names of objects */
};

enum schema_range { RANGE_ANY, RANGE_POSITIVE, RANGE_NOT_NEGATIVE, RANGE_FRACTION, RANGE_POISSON };

struct schema_attribute {
    const char *name;
    enum schema_kind kind;
    bool required;
    enum schema_range range;
    const char *unit;      /**< SI, as UDUNITS-2 reads it; NULL: dimensionless */
    const char *unit_2d;   /**< in 2-D, where it differs (unit depth) */
    const char *choices;   /**< "a|b|c" */
    const char *variables; /**< of expressions: "xyzt", "xyz", "t" */
    const char *fallback;  /**< default as text; NULL: none, or as doc says */
    const char *doc;
};

enum schema_id {
    SCHEMA_DECK,
    SCHEMA_PARAMETERS,
    SCHEMA_PARAMETER,
    SCHEMA_FUNCTION,
    SCHEMA_TIME,
    SCHEMA_BODY_FORCE,
    SCHEMA_DOMAIN,
    SCHEMA_MATERIALS,
    SCHEMA_FLUID_MATERIAL,
    SCHEMA_SOLID_MATERIAL,
    SCHEMA_FLUID,
    SCHEMA_REGION,
    SCHEMA_BOX,
    SCHEMA_DISC,
    SCHEMA_BALL,
    SCHEMA_ANNULUS,
    SCHEMA_CYLINDER_SHAPE,
    SCHEMA_POLYGON,
    SCHEMA_HALF_SPACE,
    SCHEMA_INSIDE,
    SCHEMA_UNION,
    SCHEMA_INTERSECTION,
    SCHEMA_DIFFERENCE,
    SCHEMA_POINT_LIST,
    SCHEMA_MESHES,
    SCHEMA_MESH,
    SCHEMA_GRID,
    SCHEMA_HOLE,
    SCHEMA_DISC_MESH,
    SCHEMA_NODES,
    SCHEMA_ELEMENTS,
    SCHEMA_RIGID,
    SCHEMA_SET,
    SCHEMA_SUPPORT,
    SCHEMA_LOAD,
    SCHEMA_INITIAL,
    SCHEMA_SURFACES,
    SCHEMA_SURFACE,
    SCHEMA_SKIN,
    SCHEMA_ARC,
    SCHEMA_SEGMENTS,
    SCHEMA_FACETS,
    SCHEMA_PLANE,
    SCHEMA_CIRCLE,
    SCHEMA_CYLINDER_SURFACE,
    SCHEMA_SPHERE,
    SCHEMA_ROTATION,
    SCHEMA_TRANSLATION,
    SCHEMA_DISPLACEMENT,
    SCHEMA_BOUNDARIES,
    SCHEMA_WALL,
    SCHEMA_INFLOW,
    SCHEMA_OUTFLOW,
    SCHEMA_COUPLING,
    SCHEMA_OUTPUT,
    SCHEMA_FIELDS,
    SCHEMA_HISTORY,
    SCHEMA_CHECKPOINTS,
    SCHEMA_ELEMENTS_END /**< number of kinds of elements; ends lists of children */
};

struct schema_child {
    enum schema_id id;
    int least, most; /**< most = 0: any number */
};

struct schema_element {
    const char *name;
    const char *type; /**< name of its type in the XML schema, unique */
    const char *doc;
    const struct schema_attribute *attributes; /**< ended by a NULL name; NULL: none */
    const struct schema_child *children;       /**< ended by SCHEMA_ELEMENTS_END; NULL: none */
    const struct schema_child *shapes;         /**< children that are alternatives; NULL: none */
    int least_shapes, most_shapes;             /**< how many of the alternatives; most = 0: any number */
    const char *text;                          /**< what its text holds; NULL: no text */
};

/** The description of an element kind. */
const struct schema_element *schema_element(enum schema_id id);

/** Number of attributes of an element. */
size_t schema_attribute_count(const struct schema_element *element);

/** The child called @p name that @p element may have (SCHEMA_ELEMENTS_END: none). */
enum schema_id schema_find_child(const struct schema_element *element, const char *name);

/** Names of all children of @p element into @p names (at most @p size). Returns their number. */
size_t schema_child_names(const struct schema_element *element, const char **names, size_t size);

/** What an attribute takes, in words ("a number in m/s, greater than 0"), into @p text. */
void schema_describe(const struct schema_attribute *attribute, char *text, size_t size);

/** Print the XML schema of decks. */
int schema_print(FILE *stream);

/** Print what the elements called @p name take; NULL: the list of all elements. Returns 0 or STATUS_USAGE (no
 * such element: reported with the closest name). */
int schema_help(const char *name, FILE *stream);

#endif
