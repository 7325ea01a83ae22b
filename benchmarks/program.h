/* What the programs that time native models have in common. */
#ifndef RC_PROGRAM_H
#define RC_PROGRAM_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "model.h"

/* Processor time [ns]: what others do on the machine does not count. */
static inline double now(void)
{
    return 1e9 / CLOCKS_PER_SEC * (double)clock();
}

static inline void fail(const char *why)
{
    fprintf(stderr, "%s\n", why);
    exit(1);
}

static inline void *read_resource(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0)
        fail("the resource cannot be read");
    *size = (size_t)ftell(file);
    rewind(file);
    void *data = malloc(*size);
    if (data == NULL || fread(data, 1, *size, file) != *size)
        fail("the resource cannot be read");
    fclose(file);
    return data;
}

/* Number of a group of variables, by name. */
static inline size_t find(const rc_model *model, const char *name)
{
    for (size_t g = 0; g < rc_group_count(model); ++g)
        if (strcmp(rc_group_at(model, g)->name, name) == 0)
            return g;
    fail("a variable is missing");
    return 0;
}

#endif
