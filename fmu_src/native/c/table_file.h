/* Numeric tables of two columns, or four where that is allowed, in CSV files; twin of fmu_src/python/tables.py. */
#ifndef RC_TABLE_FILE_H
#define RC_TABLE_FILE_H

#include <stddef.h>

typedef struct {
    double *x, *y;            /* free x alone */
    double *third, *fourth;   /* where there are four columns */
    size_t rows, columns;
} rc_table;

/* What a table must be. */
typedef struct {
    const char *what;        /* "wheel profile" */
    const char *x_name, *y_name; /* "distance [m]", "drop [m]" */
    size_t least;            /* number of rows */
    size_t most;             /* number of columns: 2, or 4 for 2 or 4 */
} rc_table_kind;

/* Reads a table and checks that x increases strictly; 0 and a sentence if it cannot be used.
 *
 * Values are separated by commas, semicolons or white space, with a decimal point whatever the
 * locale; empty lines and those that start with # are passed over, one line of names may come
 * first. */
int rc_read_table(rc_table *table, const char *path, const rc_table_kind *kind, char *message,
                  size_t room);

/* The text of a file, without a byte order mark, to be freed; NULL and a sentence if it is none. */
char *rc_read_text(const char *path, char *message, size_t room);

size_t rc_count_lines(const char *text);

/* Whether [from, to), but for white space, is a decimal number, with a point whatever the locale. */
int rc_parse_number(const char *from, const char *to, double *value);

void rc_free_table(rc_table *table);

#endif
