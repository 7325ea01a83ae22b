/* Tables of supports in CSV files; twin of fmu_src/python/support_table.py. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support_line.h"
#include "table_file.h"

#define LARGEST_NUMBER 2000000 /* of a support: what they need up to it is kept in memory */
#define MOST_COLUMNS (RC_PROPERTY_COUNT + 1)

static const char BLANK[] = " \t\v\f";

enum { NUMBER = RC_PROPERTY_COUNT, POSITION, UNKNOWN }; /* what a column may be besides a property */

typedef struct {
    size_t line, support; /* support: from 0 */
    rc_support values;
} row;

typedef struct {
    const char *path;
    double spacing;
    size_t supports; /* 0: endless */
    size_t columns, kinds[MOST_COLUMNS];
    row *rows;
    size_t count;
    char *message;
    size_t room;
} table;

#define REFUSE(of, ...) (snprintf((of)->message, (of)->room, __VA_ARGS__), 0)

/* The cell that begins at `from` in a line to `end`: where it ends; without blanks [from, to). */
static const char *next_cell(const char **from, const char **to, const char *end)
{
    const char *stop = *from;
    while (stop < end && *stop != ',' && *stop != ';')
        ++stop;
    *to = stop;
    while (*from < *to && strchr(BLANK, **from) != NULL)
        ++*from;
    while (*to > *from && strchr(BLANK, (*to)[-1]) != NULL)
        --*to;
    return stop;
}

static int is_name(const char *from, const char *to, const char *name)
{
    return strlen(name) == (size_t)(to - from) && memcmp(from, name, (size_t)(to - from)) == 0;
}

static size_t find_kind(const char *from, const char *to)
{
    for (size_t p = 0; p < RC_PROPERTY_COUNT; ++p)
        if (is_name(from, to, RC_PROPERTIES[p].name))
            return p;
    return is_name(from, to, "number") ? NUMBER : is_name(from, to, "position") ? POSITION : UNKNOWN;
}

static int refuse_column(const table *of, const char *from, const char *to)
{
    int used = snprintf(of->message, of->room,
                        "table %s: column '%.*s' is unknown or there twice; its first line must "
                        "name columns of number, position", of->path, (int)(to - from), from);
    for (size_t p = 0; p < RC_PROPERTY_COUNT && used > 0 && (size_t)used < of->room; ++p)
        used += snprintf(of->message + used, of->room - (size_t)used, ", %s", RC_PROPERTIES[p].name);
    return 0;
}

static int take_names(table *of, const char *line, const char *end)
{
    size_t places = 0;
    for (const char *from = line, *to;; ++from) {
        const char *stop = next_cell(&from, &to, end);
        const size_t kind = find_kind(from, to);
        int twice = 0;
        for (size_t c = 0; c < of->columns; ++c)
            twice |= of->kinds[c] == kind;
        places += kind == NUMBER || kind == POSITION;
        if (kind == UNKNOWN || twice)
            return refuse_column(of, from, to);
        if (places > 1 || of->columns == MOST_COLUMNS)
            break;
        of->kinds[of->columns++] = kind;
        from = stop;
        if (stop == end)
            break;
    }
    return places == 1 ? 1
                       : REFUSE(of, "table %s: must have one of the columns number and position",
                                of->path);
}

static size_t count_cells(const char *line, const char *end)
{
    size_t cells = 1;
    for (; line < end; ++line)
        cells += *line == ',' || *line == ';';
    return cells;
}

/* Finds the support of a row from its number, or from its position in spacings. */
static int take_place(const table *of, row *to, size_t kind, double value)
{
    const double exact = kind == NUMBER ? value - 1.0 : value / of->spacing - 1.0;
    const double support = rint(exact);
    const size_t most = of->supports > 0 ? of->supports : LARGEST_NUMBER;
    if (kind == NUMBER && exact != support)
        return REFUSE(of, "table %s, line %zu: number is %g, not a whole number", of->path, to->line,
                      value);
    if (!(support >= 0.0 && support < (double)most))
        return of->supports > 0
                   ? REFUSE(of, "table %s, line %zu: names support %.17g but the track has %zu: "
                                "correct it, or use more bays or an endless track", of->path,
                            to->line, support + 1.0, most)
                   : REFUSE(of, "table %s, line %zu: names support %.17g but it may go up to %zu: "
                                "correct it", of->path, to->line, support + 1.0, most);
    to->support = (size_t)support;
    return 1;
}

static int take_row(table *of, const char *line, const char *end, size_t number)
{
    row *to = &of->rows[of->count++];
    const size_t cells = count_cells(line, end);
    to->line = number;
    if (cells != of->columns)
        return REFUSE(of, "table %s, line %zu: has %zu values, not %zu as the first line", of->path,
                      number, cells, of->columns);
    for (size_t p = 0; p < RC_PROPERTY_COUNT; ++p)
        to->values.of[p] = RC_PROPERTIES[p].nominal;
    const char *from = line;
    for (size_t c = 0; c < cells; ++c, ++from) {
        const size_t kind = of->kinds[c];
        const char *last, *stop = next_cell(&from, &last, end);
        double value;
        if (!rc_parse_number(from, last, &value) || !(isfinite(value) && value >= 0.0))
            return REFUSE(of, "table %s, line %zu: %s is '%.*s', not a number of at least 0",
                          of->path, number,
                          kind == NUMBER     ? "number"
                          : kind == POSITION ? "position"
                                             : RC_PROPERTIES[kind].name,
                          (int)(last - from), from);
        if (kind == RC_FASTENED && value != 0.0 && value != 1.0)
            return REFUSE(of, "table %s, line %zu: fastened is '%.*s', neither 1 nor 0", of->path,
                          number, (int)(last - from), from);
        if (kind >= NUMBER && !take_place(of, to, kind, value))
            return 0;
        if (kind < NUMBER)
            to->values.of[kind] = value;
        from = stop;
    }
    return 1;
}

static int take_lines(table *of, const char *text)
{
    size_t number = 1;
    for (const char *line = text; *line != '\0'; ++number) {
        const char *end = line + strcspn(line, "\r\n"), *first = line + strspn(line, BLANK);
        if (first < end && *first != '#' &&
            !(of->columns == 0 ? take_names(of, line, end) : take_row(of, line, end, number)))
            return 0;
        line = end + (end[0] == '\r' && end[1] == '\n' ? 2 : end[0] != '\0');
    }
    return of->columns > 0 ? 1
                           : REFUSE(of, "table %s: is empty; its first line must name the columns",
                                    of->path);
}

/* Puts the rows where their supports are. */
static int place_rows(const table *of, rc_support_line *line)
{
    size_t count = 1;
    for (size_t r = 0; r < of->count; ++r)
        count = of->rows[r].support + 1 > count ? of->rows[r].support + 1 : count;
    char *taken = calloc(count, 1);
    int good = taken != NULL && rc_claim_supports(line, count);
    if (!good)
        (void)REFUSE(of, "table %s: there is not enough memory for it", of->path);
    for (size_t r = 0; r < of->count && good; ++r) {
        const row *from = &of->rows[r];
        if (taken[from->support])
            good = REFUSE(of, "table %s, line %zu: support %zu has a row already; leave one out",
                          of->path, from->line, from->support + 1);
        taken[from->support] = 1;
        line->known[from->support] = from->values;
    }
    free(taken);
    return good;
}

int rc_read_supports(rc_support_line *line, const char *path, double spacing, size_t supports,
                     char *message, size_t room)
{
    char *text = rc_read_text(path, message, room);
    if (text == NULL)
        return 0;
    table of = {.path = path, .spacing = spacing, .supports = supports, .message = message,
                .room = room};
    of.rows = malloc(rc_count_lines(text) * sizeof *of.rows);
    const int good = of.rows != NULL
                         ? take_lines(&of, text) && place_rows(&of, line)
                         : REFUSE(&of, "table %s: there is not enough memory for it", path);
    free(of.rows);
    free(text);
    if (!good)
        rc_free_supports(line);
    return good;
}
