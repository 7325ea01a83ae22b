/* Shared libraries on Windows and elsewhere, and the end of the program. */
#include "slave.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>

void *host_load(const char *path)
{
    void *library = (void *)LoadLibraryA(path);
    if (library == NULL)
        host_fail("%s cannot be loaded: error %lu", path, GetLastError());
    return library;
}

static host_function find(void *library, const char *name)
{
    return (host_function)GetProcAddress((HMODULE)library, name);
}
#else
#include <dlfcn.h>

void *host_load(const char *path)
{
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL)
        host_fail("%s", dlerror());
    return library;
}

static host_function find(void *library, const char *name)
{
    void *found = dlsym(library, name);
    host_function function;
    memcpy(&function, &found, sizeof function); /* ISO C has no cast between the two */
    return function;
}
#endif

host_function host_find(void *library, const char *name)
{
    const host_function function = find(library, name);
    if (function == NULL)
        host_fail("the library has no function %s", name);
    return function;
}

void host_fail(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vfprintf(stderr, format, values);
    va_end(values);
    fputc('\n', stderr);
    exit(1);
}

void *host_allocate(size_t size)
{
    void *memory = calloc(1, size);
    if (memory == NULL)
        host_fail("no memory");
    return memory;
}
