/* Files in the folder of an FMU's resources. */
#include "resource_file.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int hexadecimal(char c)
{
    static const char digits[] = "0123456789abcdef";
    const char *place = c == '\0' ? NULL : strchr(digits, c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c);
    return place == NULL ? -1 : (int)(place - digits);
}

/* The path that a file URI stands for, written to `path`, which has room for it. */
static void resolve(const char *uri, char *path)
{
    const char *from = uri + strlen("file:");
    if (strncmp(from, "//", 2) == 0) { /* behind it the host, which is this one */
        from = strchr(from + 2, '/');
        if (from == NULL)
            from = "";
    }
#if defined(_WIN32)
    if (from[0] == '/' && from[1] != '\0' && from[2] == ':')
        ++from; /* file:///C:/folder */
#endif
    while (*from != '\0') {
        const int high = *from == '%' ? hexadecimal(from[1]) : -1;
        const int low = high < 0 ? -1 : hexadecimal(from[2]);
        if (low < 0) {
            *path++ = *from++;
            continue;
        }
        *path++ = (char)(16 * high + low);
        from += 3;
    }
    *path = '\0';
}

#if defined(_WIN32)
/* UTF-16 of UTF-8 in memory for free(); bytes that are not UTF-8 become U+FFFD. */
static wchar_t *widen(const char *text)
{
    const unsigned char *from = (const unsigned char *)text;
    wchar_t *wide = malloc((strlen(text) + 1) * sizeof *wide), *to = wide;
    while (wide != NULL && *from != 0) {
        const int more = *from < 0x80   ? 0
                         : *from < 0xc0 ? -1
                         : *from < 0xe0 ? 1
                         : *from < 0xf0 ? 2
                                        : 3;
        uint32_t code = more < 0 ? 0xfffdu : more == 0 ? *from : *from & (0x3fu >> more);
        ++from;
        for (int i = 0; i < more; ++i)
            code = (*from & 0xc0) == 0x80 ? code << 6 | (*from++ & 0x3fu) : 0xfffdu;
        if (code >= 0x10000u) {
            *to++ = (wchar_t)(0xd800u + ((code - 0x10000u) >> 10 & 0x3ffu));
            *to++ = (wchar_t)(0xdc00u + (code & 0x3ffu));
        } else {
            *to++ = (wchar_t)code;
        }
    }
    if (wide != NULL)
        *to = 0;
    return wide;
}

static FILE *open_file(const char *path)
{
    wchar_t *wide = widen(path);
    FILE *file = wide == NULL ? NULL : _wfopen(wide, L"rb");
    free(wide);
    return file;
}
#else
static FILE *open_file(const char *path)
{
    return fopen(path, "rb");
}
#endif

/* The rest of a file, with a zero behind it. */
static char *read_all(FILE *file, size_t *size)
{
    if (fseek(file, 0, SEEK_END) != 0)
        return NULL;
    const long length = ftell(file);
    if (length < 0 || (size_t)length >= SIZE_MAX / 2 || /* a folder, perhaps */
        fseek(file, 0, SEEK_SET) != 0)
        return NULL;
    char *data = malloc((size_t)length + 1);
    if (data == NULL)
        return NULL;
    *size = fread(data, 1, (size_t)length, file);
    data[*size] = '\0';
    if (*size == (size_t)length)
        return data;
    free(data);
    return NULL;
}

char *rc_read_resource(const char *folder, const char *name, size_t *size, char *message,
                       size_t room)
{
    char *path = malloc(strlen(folder) + strlen(name) + 2);
    if (path == NULL) {
        snprintf(message, room, "there is not enough memory to open %s", name);
        return NULL;
    }
    if (strncmp(folder, "file:", 5) == 0)
        resolve(folder, path);
    else
        strcpy(path, folder);
    const size_t length = strlen(path);
    if (length > 0 && path[length - 1] != '/' && path[length - 1] != '\\')
        strcat(path, "/");
    strcat(path, name);
    FILE *file = open_file(path);
    char *data = file == NULL ? NULL : read_all(file, size);
    if (file != NULL)
        fclose(file);
    if (data == NULL)
        snprintf(message, room, "%s cannot be read; unpack the whole FMU and name its folder of "
                                "resources", path);
    free(path);
    return data;
}
