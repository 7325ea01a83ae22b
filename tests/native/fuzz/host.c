#include "host.h"

#include <stdlib.h>
#include <string.h>

void *exact(size_t count, size_t size)
{
    void *memory = malloc(count * size); /* of no byte, too */
    if (memory == NULL && count * size > 0)
        abort();
    if (memory != NULL)
        memset(memory, 0, count * size);
    return memory;
}

/* Whether every % of a message is doubled. */
static int is_plain_format(const char *message)
{
    for (; *message != '\0'; ++message)
        if (*message == '%' && *++message != '%')
            return 0;
    return 1;
}

void ear_hear(ear *heard, answer status, const char *category, const char *message, int format)
{
    const char *due = status == DISCARD   ? "logStatusDiscard"
                      : status == WARNING ? "logStatusWarning"
                                          : "logStatusError";
    if (status == ERROR)
        ++heard->errors;
    else if (status == DISCARD)
        ++heard->discards;
    else if (status == WARNING)
        ++heard->warnings;
    else
        ++heard->others;
    if (category == NULL || strcmp(category, due) != 0 || message == NULL || message[0] == '\0' ||
        (format && !is_plain_format(message)))
        heard->bad = 1;
}
