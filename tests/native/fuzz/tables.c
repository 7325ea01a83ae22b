#include "tables.h"

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

static const char *separator_of(draw *from)
{
    static const char *const separators[] = {",", ";", " ", "\t", " , "};
    return separators[draw_below(from, 5)];
}

static const char *end_of(draw *from)
{
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    return ends[draw_below(from, 3)];
}

/* A table of two columns; now and then with a fault in it. */
static void write_curve(FILE *file, draw *from, int profile)
{
    const char *separator = separator_of(from), *end = end_of(from);
    const size_t rows = draw_below(from, LONGEST);
    double x = profile ? -0.03 : 0.0;
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
}

/* A rail pad whose parameters depend on the preload. */
static void write_pad(FILE *file, draw *from)
{
    const char *separator = separator_of(from), *end = end_of(from);
    const size_t rows = 1 + draw_below(from, 6);
    for (size_t i = 0; i < rows; ++i) {
        const double values[] = {2e4 * (double)(i + 1), 1e8, 2e8, 3e4};
        for (size_t k = 0; k < 4; ++k) {
            write_number(file, from, values[k] * (0.9 + 0.2 * draw_share(from)));
            fputs(k < 3 ? separator : end, file);
        }
    }
}

/* Supports that differ: any of the columns, by number or by position. */
static void write_supports(FILE *file, draw *from)
{
    static const char *const names[] = {"pad_stiffness_factor", "pad_damping_factor",
                                        "ballast_stiffness_factor", "ballast_damping_factor",
                                        "gap", "fastened", "sleeper_mass_factor"};
    const char *separator = draw_once_in(from, 2) ? "," : ";", *end = end_of(from);
    const int by_number = !draw_once_in(from, 3);
    const unsigned chosen = (unsigned)draw_below(from, 128);
    const size_t least = draw_once_in(from, 4) ? 0 : 1;
    size_t support = least;
    fputs(by_number ? "number" : "position", file);
    for (size_t k = 0; k < 7; ++k)
        if (chosen & 1u << k)
            fprintf(file, "%s%s", separator, names[k]);
    fputs(end, file);
    for (size_t i = draw_below(from, 11); i > 0; --i) {
        write_number(file, from, by_number ? (double)support : 0.65 * (double)support);
        for (size_t k = 0; k < 7; ++k)
            if (chosen & 1u << k) {
                fputs(separator, file);
                write_number(file, from, k == 4   ? 1e-3 * draw_share(from)
                                         : k == 5 ? (double)draw_below(from, 2)
                                                  : 0.3 + 1.4 * draw_share(from));
            }
        fputs(end, file);
        support += draw_once_in(from, 60) ? draw_below(from, 3000000) : 1;
    }
}

/* A table of one of the kinds; now and then with a byte order mark, and with rubbish behind it. */
void write_table(FILE *file, draw *from, table_kind kind)
{
    if (draw_once_in(from, 3))
        fputs("\xEF\xBB\xBF", file);
    switch (kind) {
    case SUPPORT_TABLE:
        write_supports(file, from);
        break;
    case PAD_TABLE:
        write_pad(file, from);
        break;
    default:
        write_curve(file, from, kind == PROFILE_TABLE);
    }
    for (size_t i = draw_once_in(from, 10) ? draw_below(from, 200) : 0; i > 0; --i)
        fputc((int)draw_below(from, 256), file);
}
