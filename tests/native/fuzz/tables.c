/* Tables in CSV files, good ones and damaged ones. */
#include <stdio.h>

#include "school.h"

#define LONGEST 40

static void write_number(FILE *file, draw *from, double usual)
{
    static const char *const strange[] = {"",     "1e999",  "-",     "nan", "inf",  "0x10", "1e-320",
                                          "1,5",  "--2",    "1.2.3", "e",   "+1e+", "1e308", "\xff",
                                          "1 2"};
    if (draw_once_in(from, 150))
        fputs(strange[draw_below(from, sizeof strange / sizeof strange[0])], file);
    else
        fprintf(file, "%.17g", usual);
}

/* A table of either kind; now and then with a fault in it. */
static void write_table(FILE *file, draw *from, int profile)
{
    static const char *const separators[] = {",", ";", " ", "\t", " , "};
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    const char *separator = separators[draw_below(from, 5)], *end = ends[draw_below(from, 3)];
    const size_t rows = draw_below(from, LONGEST);
    double x = profile ? -0.03 : 0.0;
    if (draw_once_in(from, 3))
        fputs("\xEF\xBB\xBF", file);
    if (draw_once_in(from, 2))
        fprintf(file, "# a comment%sx%sy%s", end, separator, end);
    for (size_t i = 0; i < rows; ++i) {
        const int last = i == 0 || i + 1 == rows;
        write_number(file, from, x);
        fputs(separator, file);
        write_number(file, from, !profile ? 5.0 + draw_share(from)
                                 : last   ? 0.0
                                          : 1e-3 * draw_share(from));
        fputs(draw_once_in(from, 200) ? "" : end, file);
        x += draw_once_in(from, 100) ? draw_strange(from)
                                     : (profile ? 1e-3 : 0.01) * (0.1 + draw_share(from));
    }
    for (size_t i = draw_once_in(from, 10) ? draw_below(from, 200) : 0; i > 0; --i)
        fputc((int)draw_below(from, 256), file);
}

void spoil_tables(school *at)
{
    ++at->spoilt;
    for (size_t i = 0; i + 2 < TABLES; ++i) {
        if (draw_once_in(&at->draw, 8)) { /* none, for a while */
            (void)remove(at->tables[i]);
            continue;
        }
        FILE *file = fopen(at->tables[i], "wb");
        if (file == NULL)
            blame(at, "%s cannot be written", at->tables[i]);
        write_table(file, &at->draw, i % 2 == 0);
        fclose(file);
    }
}
