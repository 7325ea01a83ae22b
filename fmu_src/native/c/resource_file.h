/* Files in the folder of an FMU's resources. */
#ifndef RC_RESOURCE_FILE_H
#define RC_RESOURCE_FILE_H

#include <stddef.h>

/* The whole file, with a zero behind it, in memory for free(); NULL and a sentence (`room` bytes)
 * where it cannot be read. `folder` is a path or a file URI, in UTF-8. */
char *rc_read_resource(const char *folder, const char *name, size_t *size, char *message,
                       size_t room);

#endif
