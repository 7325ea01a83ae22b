/* A plain host: passes all outputs on, then steps all slaves (Jacobi), without iterating.

   Its only argument is a text file:

       fmi 2
       steps 1e-4 5850
       slave vehicle
       library /path/of/binaries/linux64/Masses.so
       token 12ab
       resources file:///path/of/resources
       parameter 0 3 11.1        slave, value reference, value
       connection 0 7 1 4        slave and output, slave and input
       watched 1 6               slave and output

   Slaves count from 0, in the order of the file. It prints a line of JSON. */
#include "slave.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

enum { SLAVES = 8, VALUES = 256 };

typedef struct {
    unsigned slave, reference;
} place;

typedef struct {
    const host_version *version;
    double size;
    long steps;
    unsigned slave_count, parameter_count, connection_count, watched_count;
    host_archive archives[SLAVES];
    host_slave *slaves[SLAVES];
    place parameters[VALUES], sources[VALUES], targets[VALUES], watched[VALUES];
    double values[VALUES], passed[VALUES], largest[VALUES];
} job;

static unsigned next(unsigned *count, unsigned limit)
{
    if (*count == limit)
        host_fail("more than %u entries of a kind in the job", limit);
    return (*count)++;
}

static void copy(char *to, size_t size, const char *text)
{
    const size_t length = strcspn(text, "\r\n");
    if (length >= size)
        host_fail("text too long: %s", text);
    memcpy(to, text, length);
    to[length] = '\0';
}

static void read_text(job *j, const char *key, const char *text)
{
    if (strcmp(key, "slave") == 0) {
        copy(j->archives[next(&j->slave_count, SLAVES)].name, HOST_NAME, text);
        return;
    }
    if (j->slave_count == 0)
        host_fail("%s before the first slave", key);
    host_archive *archive = &j->archives[j->slave_count - 1];
    if (strcmp(key, "library") == 0)
        copy(archive->library, HOST_TEXT, text);
    else if (strcmp(key, "token") == 0)
        copy(archive->token, HOST_TEXT, text);
    else if (strcmp(key, "resources") == 0)
        copy(archive->resources, HOST_TEXT, text);
    else
        host_fail("unknown entry of the job: %s", key);
}

static void check_place(const job *j, place where)
{
    if (where.slave >= j->slave_count)
        host_fail("there is no slave %u", where.slave);
}

static void read_line(job *j, const char *line)
{
    char key[HOST_NAME];
    int version, start = 0;
    place a, b;
    double value;
    if (sscanf(line, "fmi %d", &version) == 1) {
        if (version != 2 && version != 3)
            host_fail("no FMI %d", version);
        j->version = version == 2 ? &host_fmi2 : &host_fmi3;
    } else if (sscanf(line, "steps %lf %ld", &j->size, &j->steps) == 2) {
        return;
    } else if (sscanf(line, "parameter %u %u %lf", &a.slave, &a.reference, &value) == 3) {
        check_place(j, a);
        const unsigned n = next(&j->parameter_count, VALUES);
        j->parameters[n] = a;
        j->values[n] = value;
    } else if (sscanf(line, "connection %u %u %u %u", &a.slave, &a.reference, &b.slave,
                      &b.reference) == 4) {
        check_place(j, a);
        check_place(j, b);
        const unsigned n = next(&j->connection_count, VALUES);
        j->sources[n] = a;
        j->targets[n] = b;
    } else if (sscanf(line, "watched %u %u", &a.slave, &a.reference) == 2) {
        check_place(j, a);
        j->watched[next(&j->watched_count, VALUES)] = a;
    } else if (sscanf(line, "%63s %n", key, &start) == 1) {
        read_text(j, key, line + start);
    }
}

static void read_job(job *j, const char *path)
{
    static char line[2 * HOST_TEXT];
    FILE *file = fopen(path, "r");
    if (file == NULL)
        host_fail("%s cannot be read", path);
    while (fgets(line, sizeof line, file) != NULL)
        read_line(j, line);
    fclose(file);
    if (j->version == NULL || j->steps < 1)
        host_fail("%s does not say which FMI and how many steps", path);
}

static double get(const job *j, place where)
{
    return j->version->get(j->slaves[where.slave], where.reference);
}

static void set(const job *j, place where, double value)
{
    j->version->set(j->slaves[where.slave], where.reference, value);
}

static void exchange(job *j)
{
    for (unsigned n = 0; n < j->connection_count; ++n)
        j->passed[n] = get(j, j->sources[n]);
    for (unsigned n = 0; n < j->connection_count; ++n)
        set(j, j->targets[n], j->passed[n]);
}

static void initialise(job *j)
{
    for (unsigned k = 0; k < j->slave_count; ++k)
        j->slaves[k] = j->version->open(&j->archives[k]);
    for (unsigned n = 0; n < j->parameter_count; ++n)
        set(j, j->parameters[n], j->values[n]);
    for (unsigned k = 0; k < j->slave_count; ++k)
        j->version->enter(j->slaves[k]);
    for (unsigned n = 0; n < j->connection_count; ++n) /* in the order of the file */
        set(j, j->targets[n], get(j, j->sources[n]));
    for (unsigned k = 0; k < j->slave_count; ++k)
        j->version->leave(j->slaves[k]);
    for (unsigned n = 0; n < j->watched_count; ++n)
        j->largest[n] = get(j, j->watched[n]);
}

static void run(job *j)
{
    for (long step = 0; step < j->steps; ++step) {
        exchange(j);
        for (unsigned k = 0; k < j->slave_count; ++k)
            j->version->step(j->slaves[k], (double)step * j->size, j->size);
        for (unsigned n = 0; n < j->watched_count; ++n) {
            const double value = get(j, j->watched[n]);
            j->largest[n] = value > j->largest[n] ? value : j->largest[n];
        }
    }
}

static void print(const char *name, const job *j, const double *values)
{
    printf("\"%s\": [", name);
    for (unsigned n = 0; n < j->watched_count; ++n)
        printf("%s%.17g", n == 0 ? "" : ", ", values == NULL ? get(j, j->watched[n]) : values[n]);
    printf("]");
}

static double now(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(int count, char **arguments)
{
    static job j;
    if (count != 2)
        host_fail("usage: %s JOB.txt", arguments[0]);
    read_job(&j, arguments[1]);
    initialise(&j);
    const double began = now();
    run(&j);
    printf("{\"seconds\": %.9g, ", now() - began);
    print("final", &j, NULL);
    printf(", ");
    print("largest", &j, j.largest);
    printf("}\n");
    for (unsigned k = 0; k < j.slave_count; ++k)
        j.version->close(j.slaves[k]);
    return 0;
}
