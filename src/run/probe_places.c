// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/probe_places.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "model/geometry.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 1 << 30, COLUMNS = 256 };
static const double most_places = 2e9;

/** Add a place; @p s: its way so far. */
static int place_add(struct probe_places *places, const double x[3], double s)
{
    const size_t room = places->n < places->x_capacity ? places->x_capacity : places->n + places->n / 2 + 16;
    void *rows = places->x, *ways = places->s;
    CHECK((double)places->n < most_places, STATUS_USAGE, "more than %g points are too many", most_places);
    CALL(memory_grow(&rows, &places->x_capacity, room, sizeof *places->x));
    places->x = rows;
    CALL(memory_grow(&ways, &places->s_capacity, room, sizeof *places->s));
    places->s = ways;
    memcpy(places->x[places->n], x, sizeof *places->x);
    places->s[places->n++] = s;
    return 0;
}

/** Add a point on the way from point to point; @p begins: it is the first one. */
static int point_add(struct probe_places *places, const double x[3], bool begins)
{
    double s = 0.0;
    if (!begins) {
        const double *before = places->x[places->n - 1];
        s = places->s[places->n - 1] + hypot(hypot(x[0] - before[0], x[1] - before[1]), x[2] - before[2]);
    }
    return place_add(places, x, s);
}

/** Coordinates at *@p text, which moves behind them. @p all: what was given to @p option. */
static int vector_read(const char *option, const char *all, int dim, const char **text, double x[3])
{
    int n = 0;
    for (const char *c = *text;; ++c) {
        char *end;
        const double value = strtod(c, &end);
        CHECK(end != c && isfinite(value) && strchr(",:", *end), STATUS_USAGE,
              "%s %s: \"%.*s\" is no coordinate; numbers in metres are wanted, separated by commas", option,
              all, (int)strcspn(c, ",:"), c);
        if (n < 3)
            x[n] = value;
        ++n;
        c = *text = end;
        if (*end != ',')
            break;
    }
    CHECK(n == dim, STATUS_USAGE, "%s %s: %d coordinate%s where the run has %d dimension%s", option, all, n,
          n > 1 ? "s" : "", dim, dim > 1 ? "s" : "");
    return 0;
}

static int point_read(struct probe_places *places, int dim, const char *text, bool begins)
{
    double x[3] = {0};
    const char *rest = text;
    CALL(vector_read("--point", text, dim, &rest, x));
    CHECK(*rest == '\0', STATUS_USAGE, "--point %s: one point is wanted", text);
    return point_add(places, x, begins);
}

static int line_read(struct probe_places *places, int dim, const char *text)
{
    double from[3] = {0}, to[3] = {0};
    const char *rest = text;
    char *end = NULL;
    long n = 0;
    CALL(vector_read("--line", text, dim, &rest, from));
    if (*rest == ':') {
        ++rest;
        CALL(vector_read("--line", text, dim, &rest, to));
    }
    if (*rest == ':') {
        errno = 0;
        n = strtol(rest + 1, &end, 10);
    }
    CHECK(end && end > rest + 1 && *end == '\0' && !errno, STATUS_USAGE,
          "--line %s: write FROM:TO:N, with commas between the coordinates", text);
    CHECK(n >= 2 && n <= INT_MAX, STATUS_USAGE, "--line %s: a line has from 2 to %d points", text, INT_MAX);
    for (long i = 0; i < n; ++i) {
        double x[3];
        const double s = geometry_line(from, to, (int)n, (int)i, x);
        CALL(place_add(places, x, s));
    }
    return 0;
}

/** "NXxNYxNZ" at @p text. */
static int grid_size(struct probe_places *places, int dim, const char *all, const char *text)
{
    double total = 1.0;
    int n = 0;
    for (const char *c = text; n == 0 || *c == 'x'; ++n) {
        char *end;
        const char *number = c + (n > 0);
        errno = 0;
        const long size = strtol(number, &end, 10);
        CHECK(end != number && !errno && size <= INT_MAX && strchr("x", *end), STATUS_USAGE,
              "--grid %s: write NXxNY[xNZ] or LOWER:UPPER:NXxNY[xNZ], with commas between coordinates", all);
        CHECK(size > 0, STATUS_USAGE, "--grid %s: a grid has at least 1 point in each direction", all);
        if (n < 3)
            places->size[n] = (size_t)size;
        total *= (double)size;
        c = end;
    }
    CHECK(n == dim, STATUS_USAGE, "--grid %s: %d direction%s where the run has %d dimension%s", all, n,
          n > 1 ? "s" : "", dim, dim > 1 ? "s" : "");
    CHECK(total <= most_places, STATUS_USAGE, "--grid %s: more than %g points are too many", all,
          most_places);
    return 0;
}

/** Distance of the points; a single one lies in the middle. */
static int grid_space(struct probe_places *places, const char *all, int k, double lower, double upper)
{
    const size_t n = places->size[k];
    CHECK(n > 1 ? lower < upper : lower <= upper, STATUS_USAGE,
          "--grid %s: %c goes from %g to %g; the lower corner comes first", all, "xyz"[k], lower, upper);
    places->lower[k] = n > 1 ? lower : 0.5 * (lower + upper);
    places->spacing[k] = n > 1 ? (upper - lower) / (double)(n - 1) : 1.0;
    return 0;
}

static int grid_fill(struct probe_places *places, const double upper[3])
{
    const size_t *size = places->size;
    places->x = memory_create(size[0] * size[1] * size[2], sizeof *places->x);
    CHECK_MEMORY(places->x);
    places->n = size[0] * size[1] * size[2];
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < places->n; ++i) {
        const size_t index[3] = {i % size[0], i / size[0] % size[1], i / size[0] / size[1]};
        for (int k = 0; k < 3; ++k)
            places->x[i][k] = index[k] > 0 && index[k] + 1 == size[k]
                                  ? upper[k]
                                  : places->lower[k] + (double)index[k] * places->spacing[k];
    }
    return 0;
}

static int grid_read(struct probe_places *places, const struct model *model, const char *text)
{
    double lower[3] = {0}, upper[3] = {0};
    const char *rest = text;
    places->grid = true;
    for (int k = 0; k < 3; ++k) {
        places->size[k] = 1;
        places->spacing[k] = 1.0;
    }
    for (int k = 0; k < model->dim; ++k) {
        lower[k] = model->domain.lower[k];
        upper[k] = model->domain.upper[k];
    }
    if (strchr(text, ':')) {
        CALL(vector_read("--grid", text, model->dim, &rest, lower));
        rest += *rest == ':';
        CALL(vector_read("--grid", text, model->dim, &rest, upper));
        CHECK(*rest == ':', STATUS_USAGE, "--grid %s: write LOWER:UPPER:NXxNY[xNZ]", text);
        ++rest;
    }
    CALL(grid_size(places, model->dim, text, rest));
    for (int k = 0; k < model->dim; ++k)
        CALL(grid_space(places, text, k, lower[k], upper[k]));
    return grid_fill(places, upper);
}

/** A table of points while it is read. */
struct table {
    const char *path;
    int line, dim, cells; /**< cells of each row */
    int columns[3];       /**< of x, y, z; -1: none */
};

static bool cell_number(const char *cell, double *value)
{
    char *end;
    *value = strtod(cell, &end);
    return end != cell && end[strspn(end, " \t")] == '\0' && isfinite(*value);
}

/** Split a line at its commas. Returns the number of cells. */
static int cells_split(char *line, char *cells[COLUMNS])
{
    int n = 0;
    for (char *next = line; next && n < COLUMNS;) {
        char *cell = next;
        next = strchr(cell, ',');
        if (next)
            *next++ = '\0';
        cells[n++] = cell;
    }
    return n;
}

/** Whether a cell of the header is called @p name; a unit in brackets may follow. */
static bool is_called(const char *cell, char name)
{
    cell += strspn(cell, " \t\"");
    return cell[0] == name && strchr("[", cell[1 + strspn(cell + 1, " \t\"")]);
}

/** The first line: names of the columns, or numbers already. */
static int columns_find(struct table *table, int n, char *const *cells, bool *header)
{
    double value;
    table->cells = n;
    *header = !cell_number(cells[0], &value);
    for (int k = 0; k < 3; ++k) {
        table->columns[k] = *header || k >= table->dim ? -1 : k;
        for (int c = 0; c < n && *header; ++c)
            if (is_called(cells[c], "xyz"[k]))
                table->columns[k] = c;
        CHECK(!*header || k >= table->dim || table->columns[k] >= 0, STATUS_DECK,
              "%s:%d: error: there is no column called %c", table->path, table->line, "xyz"[k]);
    }
    CHECK(*header || n == table->dim, STATUS_DECK,
          "%s:%d: error: %d number%s where the run has %d dimension%s; write a first line with the names of "
          "the columns (x,y,z) if there are others",
          table->path, table->line, n, n > 1 ? "s" : "", table->dim, table->dim > 1 ? "s" : "");
    return 0;
}

static int row_read(const struct table *table, int n, char *const *cells, double x[3])
{
    CHECK(n == table->cells, STATUS_DECK, "%s:%d: error: %d columns instead of %d", table->path, table->line,
          n, table->cells);
    for (int k = 0; k < 3; ++k) {
        const int c = table->columns[k];
        CHECK(c < 0 || cell_number(cells[c], &x[k]), STATUS_DECK, "%s:%d: error: \"%s\" is no coordinate",
              table->path, table->line, cells[c]);
        CHECK(k < table->dim || x[k] == 0.0, STATUS_DECK,
              "%s:%d: error: %c = %g where the run has %d dimension%s", table->path, table->line, "xyz"[k],
              x[k], table -> dim, table -> dim > 1 ? "s" : "");
    }
    return 0;
}

/** @p text is taken apart. */
static int table_read(struct probe_places *places, struct table *table, char *text)
{
    const size_t first = places->n;
    char *cells[COLUMNS];
    for (char *next = text; next;) {
        char *line = next;
        double x[3] = {0};
        bool header = false;
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        ++table->line;
        line[strcspn(line, "\r")] = '\0';
        if (line[0] == '#' || line[strspn(line, " \t")] == '\0')
            continue;
        const int n = cells_split(line, cells);
        if (table->cells == 0)
            CALL(columns_find(table, n, cells, &header));
        if (header)
            continue;
        CALL(row_read(table, n, cells, x));
        CALL(point_add(places, x, places->n == first));
    }
    CHECK(places->n > first, STATUS_DECK, "%s: error: there is no point in it", table->path);
    return 0;
}

static int points_read(struct probe_places *places, int dim, const char *path)
{
    struct table table = {.path = path, .dim = dim};
    char *text;
    size_t size;
    CALL(file_read(path, FILE_LIMIT, &text, &size));
    const size_t mark = strncmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    int status = memchr(text, '\0', size)
                     ? error_report(STATUS_DECK, "%s: error: no table of points: it holds a zero byte", path)
                     : table_read(places, &table, text + mark);
    memory_free(text);
    return status;
}

int probe_places_create(struct probe_places *places, const struct model *model, size_t n,
                        const struct probe_place *given)
{
    *places = (struct probe_places){.n = 0};
    CHECK(n > 0, STATUS_USAGE, "skerry probe: nowhere to probe; give --point, --points, --line or --grid");
    for (size_t i = 0; i < n; ++i) {
        const char *text = given[i].text;
        CHECK(given[i].kind != PROBE_GRID || n == 1, STATUS_USAGE,
              "--grid %s: a grid goes with no other grid, point or line", text);
        switch (given[i].kind) {
        case PROBE_POINT:
            CALL(point_read(places, model->dim, text, i == 0 || given[i - 1].kind != PROBE_POINT));
            break;
        case PROBE_POINTS:
            CALL(points_read(places, model->dim, text));
            break;
        case PROBE_LINE:
            CALL(line_read(places, model->dim, text));
            break;
        case PROBE_GRID:
            CALL(grid_read(places, model, text));
            break;
        }
    }
    return 0;
}

void probe_places_reset(struct probe_places *places)
{
    memory_free(places->x);
    memory_free(places->s);
    *places = (struct probe_places){.n = 0};
}
