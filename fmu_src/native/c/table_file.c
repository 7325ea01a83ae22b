#include "table_file.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COLUMNS 4
#define FEWEST_COLUMNS 2
#define CELL 64 /* longest number, its end included */
#define LONGEST_FILE ((size_t)1 << 30)

static const char BLANK[] = " \t\v\f";

/* The whole file with a zero behind it, NULL if it cannot be read. */
static char *read_file(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return NULL;
    size_t room = 1 << 16, size = 0;
    char *text = malloc(room);
    while (text != NULL) {
        size += fread(text + size, 1, room - size, file);
        if (size < room)
            break;
        char *larger = room < LONGEST_FILE ? realloc(text, 2 * room) : NULL;
        if (larger == NULL)
            free(text);
        text = larger;
        room *= 2;
    }
    if (text != NULL && ferror(file)) {
        free(text);
        text = NULL;
    }
    fclose(file);
    if (text != NULL)
        text[size] = '\0';
    *length = size;
    return text;
}

char *rc_read_text(const char *path, char *message, size_t room)
{
    size_t length;
    char *text = read_file(path, &length);
    if (text == NULL) {
        snprintf(message, room, "table %s: cannot be read", path);
        return NULL;
    }
    if (strlen(text) < length) {
        snprintf(message, room, "table %s: byte %zu is zero, which is no text; save the table as "
                                "UTF-8", path, strlen(text) + 1);
        free(text);
        return NULL;
    }
    const size_t mark = strncmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    memmove(text, text + mark, length - mark + 1);
    return text;
}

int rc_parse_number(const char *from, const char *to, double *value)
{
    char cell[CELL];
    from += strspn(from, BLANK);
    while (to > from && strchr(BLANK, to[-1]) != NULL)
        --to;
    const size_t length = to > from ? (size_t)(to - from) : 0;
    if (length == 0 || length >= CELL || strspn(from, "+-.0123456789eE") < length)
        return 0;
    memcpy(cell, from, length);
    cell[length] = '\0';
    char *point = strchr(cell, '.');
    if (point != NULL)
        *point = localeconv()->decimal_point[0]; /* strtod obeys the host's locale */
    char *end;
    *value = strtod(cell, &end);
    return *end == '\0';
}

typedef struct {
    size_t cells, numbers;
    double values[COLUMNS]; /* of the first cells */
} row;

/* Splits a line [from, to); `separators` are single, white space counts as one. */
static row split(const char *from, const char *to)
{
    row found = {0, 0, {0.0}};
    const int separated = memchr(from, ',', (size_t)(to - from)) != NULL ||
                          memchr(from, ';', (size_t)(to - from)) != NULL;
    while (from <= to) {
        if (!separated)
            from += strspn(from, BLANK);
        if (!separated && from >= to)
            break;
        const char *end = from + strcspn(from, separated ? ",;" : BLANK);
        if (end > to)
            end = to;
        double value = 0.0;
        const int number = rc_parse_number(from, end, &value);
        if (found.cells < COLUMNS)
            found.values[found.cells] = value;
        found.numbers += (size_t)number;
        ++found.cells;
        from = end + 1;
    }
    return found;
}

size_t rc_count_lines(const char *text)
{
    size_t lines = 1;
    for (; *text != '\0'; ++text)
        lines += *text == '\n' || *text == '\r';
    return lines;
}

/* Whether the decimals of a line have commas, which then cannot separate its values. */
static int has_decimal_commas(const char *from, const char *to)
{
    const size_t length = (size_t)(to - from);
    return memchr(from, ',', length) != NULL && memchr(from, ';', length) != NULL;
}

static int is_good(const row *found, size_t columns)
{
    for (size_t c = 0; c < columns; ++c)
        if (!isfinite(found->values[c]))
            return 0;
    return found->cells == columns && found->numbers == columns;
}

/* Takes the rows of a text; 0 and a sentence if there is something wrong with one. */
static int take_rows(rc_table *table, const char *text, const char *path,
                     const rc_table_kind *kind, char *message, size_t room)
{
    int header_allowed = 1;
    size_t number = 1;
    for (const char *line = text; *line != '\0'; ++number) {
        const char *end = line + strcspn(line, "\r\n");
        const char *first = line + strspn(line, BLANK);
        if (first < end && *first != '#') {
            const row found = split(first, end);
            const int header = header_allowed && found.numbers == 0;
            header_allowed = 0;
            if (!header && table->rows == 0 && kind->most == COLUMNS && found.cells == COLUMNS)
                table->columns = COLUMNS; /* the first row says how many there are */
            if (!header && has_decimal_commas(first, end)) {
                snprintf(message, room, "table %s, line %zu: has both commas and semicolons; write "
                                        "decimals with a point", path, number);
                return 0;
            }
            if (!header && !is_good(&found, table->columns)) {
                if (kind->most == COLUMNS)
                    snprintf(message, room, "table %s, line %zu: must be %zu finite numbers", path,
                             number, table->columns);
                else
                    snprintf(message, room, "table %s, line %zu: must be two finite numbers, %s "
                                            "and %s", path, number, kind->x_name, kind->y_name);
                return 0;
            }
            if (!header) {
                double *const columns[COLUMNS] = {table->x, table->y, table->third, table->fourth};
                for (size_t c = 0; c < table->columns; ++c)
                    columns[c][table->rows] = found.values[c];
                ++table->rows;
            }
        }
        line = end + (end[0] == '\r' && end[1] == '\n' ? 2 : end[0] != '\0');
    }
    return 1;
}

static int check(const rc_table *table, const rc_table_kind *kind, char *message, size_t room)
{
    if (table->rows < kind->least) {
        snprintf(message, room, "%s: %zu points; at least %zu are needed", kind->what, table->rows,
                 kind->least);
        return 0;
    }
    for (size_t i = 1; i < table->rows; ++i)
        if (!(table->x[i] > table->x[i - 1])) {
            snprintf(message, room,
                     "%s: %s goes from %g to %g at point %zu; it must increase from point to "
                     "point: sort the table and remove duplicates", kind->what, kind->x_name,
                     table->x[i - 1], table->x[i], i + 1);
            return 0;
        }
    return 1;
}

int rc_read_table(rc_table *table, const char *path, const rc_table_kind *kind, char *message,
                  size_t room)
{
    char *text = rc_read_text(path, message, room);
    memset(table, 0, sizeof *table);
    if (text == NULL)
        return 0;
    const size_t lines = rc_count_lines(text);
    table->x = malloc(sizeof(double) * COLUMNS * lines);
    table->columns = FEWEST_COLUMNS;
    int good = 0;
    if (table->x == NULL)
        snprintf(message, room, "table %s: there is not enough memory for it", path);
    else {
        table->y = table->x + lines;
        table->third = table->y + lines;
        table->fourth = table->third + lines;
        good = take_rows(table, text, path, kind, message, room) &&
               check(table, kind, message, room);
    }
    free(text);
    if (!good)
        rc_free_table(table);
    return good;
}

void rc_free_table(rc_table *table)
{
    free(table->x);
    memset(table, 0, sizeof *table);
}
