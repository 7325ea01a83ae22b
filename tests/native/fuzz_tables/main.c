/* Reads CSV files that were good before they were damaged, by both readers of them.
 *
 * fuzz_tables SEED FILES PATH, PATH being that of a file which is written again and again. A file
 * is refused with a sentence, which ends within its room, or what was read of it is as it must be.
 * Ends with 1 and a sentence on what is wrong; a sanitizer ends it where it sees something.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw.h"
#include "support_line.h"
#include "table_file.h"
#include "tables.h"

#define ROOM (1 << 17)
#define MOST_SUPPORTS 2000000
#define SPACING 0.65

typedef struct {
    char *data;
    size_t size;
} text;

/* A good table of any kind, as the file has it. */
static text make(const char *path, draw *from)
{
    text made = {malloc(ROOM), 0};
    FILE *file = fopen(path, "wb");
    if (made.data == NULL || file == NULL)
        abort();
    write_table(file, from, (table_kind)draw_below(from, TABLE_KINDS));
    fclose(file);
    file = fopen(path, "rb");
    if (file == NULL)
        abort();
    made.size = fread(made.data, 1, ROOM, file);
    fclose(file);
    return made;
}

/* Puts bytes at a place, as many as there is room for. */
static void insert(text *into, size_t place, const char *bytes, size_t count)
{
    if (into->size + count > ROOM)
        return;
    memmove(into->data + place + count, into->data + place, into->size - place);
    memcpy(into->data + place, bytes, count);
    into->size += count;
}

static void damage(text *one, draw *from)
{
    static const char *const words[] = {
        "\n", "\r", "\r\n", "\r\r", ",", ";", ",,", " ", "\t", "\v\f", "#", "\"", "number", "position",
        "gap", "fastened,fastened", "-0", "-1", "0", "0.5", "1e400", "1e-400", "nan", "inf", "0x1p3",
        "2000000", "2000001", "4294967296", "18446744073709551616", "1300000", "+", ".", "e", "1e",
        "\xEF\xBB\xBF", "\xff\xfe", "%s%n%999999d",
        "00000000000000000000000000000000000000000000000000000000000000000000000001"};
    const size_t place = draw_below(from, one->size + 1), left = one->size - place;
    switch (draw_below(from, 7)) {
    case 0:
        one->size = place;
        break;
    case 1:
        if (left > 0)
            one->data[place] = (char)draw_bits(from);
        break;
    case 2: { /* a part is missing */
        const size_t count = draw_below(from, left < 20 ? left + 1 : 20);
        memmove(one->data + place, one->data + place + count, left - count);
        one->size -= count;
        break;
    }
    case 3: { /* a part is there twice */
        char part[200];
        const size_t count = draw_below(from, left < sizeof part ? left + 1 : sizeof part);
        memcpy(part, one->data + place, count);
        insert(one, place, part, count);
        break;
    }
    case 4: { /* a long run of one byte, zeros among them */
        char run[3000];
        memset(run, draw_once_in(from, 2) ? "0, \n#9e"[draw_below(from, 7)] : (int)draw_below(from, 256),
               sizeof run);
        insert(one, place, run, draw_below(from, sizeof run));
        break;
    }
    default: {
        const char *word = words[draw_below(from, sizeof words / sizeof words[0])];
        insert(one, place, word, strlen(word));
    }
    }
}

static void put(const char *path, const text *one)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL || fwrite(one->data, 1, one->size, file) != one->size)
        abort();
    fclose(file);
}

/* Whether a refusal says why, in a text that ends. */
static int is_sentence(const char *message, size_t room)
{
    return room < 2 || (memchr(message, '\0', room) != NULL && message[0] != '\0');
}

static int are_supports(const rc_support_line *line, size_t supports)
{
    int good = line->count > 0 && line->count <= (supports > 0 ? supports : MOST_SUPPORTS);
    for (size_t s = 0; s < line->count; ++s)
        for (size_t p = 0; p < RC_PROPERTY_COUNT; ++p)
            good &= isfinite(line->known[s].of[p]) && line->known[s].of[p] >= 0.0;
    return good;
}

/* 1 if the file was used, 0 if it was refused, -1 if something is wrong. */
static int read_supports(const char *path, draw *from, char *message, size_t room)
{
    rc_support_line line = {0};
    const size_t supports = draw_once_in(from, 2) ? 0 : 1 + draw_below(from, 20);
    const int used = rc_read_supports(&line, path, SPACING, supports, message, room);
    const int right = used ? are_supports(&line, supports)
                           : line.known == NULL && is_sentence(message, room);
    rc_free_supports(&line);
    return right ? used : -1;
}

static int is_table(const rc_table *table, const rc_table_kind *kind)
{
    const double *const columns[] = {table->x, table->y, table->third, table->fourth};
    int good = table->rows >= kind->least &&
               (table->columns == 2 || (table->columns == 4 && kind->most == 4));
    for (size_t c = 0; c < table->columns; ++c)
        for (size_t i = 0; i < table->rows; ++i)
            good &= isfinite(columns[c][i]) != 0;
    for (size_t i = 1; i < table->rows; ++i)
        good &= table->x[i] > table->x[i - 1];
    return good;
}

static int read_curve(const char *path, draw *from, char *message, size_t room)
{
    const rc_table_kind kind = {.what = "curve", .x_name = "x [m]", .y_name = "y [m]",
                                .least = 1 + draw_below(from, 3),
                                .most = draw_once_in(from, 2) ? 2 : 4};
    rc_table table;
    const int used = rc_read_table(&table, path, &kind, message, room);
    const int right = used ? is_table(&table, &kind) : table.x == NULL && is_sentence(message, room);
    rc_free_table(&table);
    return right ? used : -1;
}

int main(int count, char **words)
{
    static const size_t rooms[] = {1, 2, 30, 200, 2048};
    unsigned long used = 0;
    if (count != 4)
        return 2;
    draw from = {strtoull(words[1], NULL, 10)};
    const unsigned long files = strtoul(words[2], NULL, 10);
    for (unsigned long n = 0; n < files; ++n) {
        const size_t room = rooms[draw_below(&from, sizeof rooms / sizeof rooms[0])];
        char *message = calloc(room, 1); /* of this size, for the sanitizer */
        text one = make(words[3], &from);
        for (size_t i = draw_below(&from, 4); i > 0; --i)
            damage(&one, &from);
        put(words[3], &one);
        const int supports = read_supports(words[3], &from, message, room);
        const int curve = read_curve(words[3], &from, message, room);
        free(one.data);
        free(message);
        if (supports < 0 || curve < 0) {
            fprintf(stderr, "seed %s, file %lu, which is there still: what was %s is wrong\n",
                    words[1], n, supports < 0 ? "said of its supports" : "said of its curve");
            return 1;
        }
        used += supports || curve;
    }
    printf("%lu files: %lu refused, %lu used\n", files, files - used, used);
    return 0;
}
