/* A slave of FMI 2.0 or 3.0 in a host; every call ends the program with a message if it fails. */
#ifndef HOST_SLAVE_H
#define HOST_SLAVE_H

#include <stddef.h>

enum { HOST_NAME = 64, HOST_TEXT = 4096 };

typedef struct {
    char name[HOST_NAME];
    char library[HOST_TEXT];
    char token[HOST_TEXT];
    char resources[HOST_TEXT]; /* FMI 2.0: URI; FMI 3.0: path, with a separator at its end */
} host_archive;

typedef struct host_slave host_slave;

/* What a version of FMI does for each of the calls below. */
typedef struct {
    host_slave *(*open)(const host_archive *archive);
    void (*enter)(host_slave *slave);
    void (*leave)(host_slave *slave);
    void (*set)(host_slave *slave, unsigned reference, double value);
    double (*get)(host_slave *slave, unsigned reference);
    void (*step)(host_slave *slave, double time, double size);
    void (*close)(host_slave *slave);
} host_version;

extern const host_version host_fmi2, host_fmi3;

typedef void (*host_function)(void);

void *host_load(const char *path);
host_function host_find(void *library, const char *name);
void host_fail(const char *format, ...);
void *host_allocate(size_t size);

#endif
