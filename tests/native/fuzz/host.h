/* The functions of FMI, of either version, as the fuzzer calls them.
 *
 * Arrays reach the FMU in memory of exactly their size, so that a sanitizer sees a step beyond it.
 */
#ifndef FUZZ_HOST_H
#define FUZZ_HOST_H

#include <stddef.h>
#include <stdint.h>

#include "draw.h"
#include "model.h"

typedef enum { OK, WARNING, DISCARD, ERROR, FATAL, PENDING } answer; /* as in both versions */

/* What an instance's logger heard. */
typedef struct {
    unsigned errors, discards, warnings, others;
    int bad; /* a NULL, an empty or an unescaped sentence, a wrong category */
} ear;

/* A list of variables and of their values; `values` are numbers of any type. */
typedef struct {
    const uint32_t *variables; /* may be NULL */
    size_t count;
    double *values;     /* for numbers; `no_values`: the FMU gets NULL */
    const char **texts; /* for texts */
    int no_values;
    size_t said; /* the number of values that the FMU is told (FMI 3.0) */
} list;

typedef struct {
    int version;
    int has_time; /* whether time is a variable, behind those of the model */
    void *(*instantiate)(const char *name, const char *token, const char *folder, ear *heard,
                         int logger, int logging, int early_return);
    void (*release)(void *fmu);
    answer (*choose_log)(void *fmu, int on, size_t count, const char *const *names);
    answer (*set_up)(void *fmu, double start, int has_stop, double stop); /* NULL: `enter` does */
    answer (*enter)(void *fmu, double start, int has_stop, double stop);
    answer (*leave)(void *fmu);
    answer (*terminate)(void *fmu);
    answer (*reset)(void *fmu);
    /* `reached` and `early` where the version has them; `without`: one result of the four NULL */
    answer (*step)(void *fmu, double time, double step, int without, double *reached, int *early);
    answer (*get)(void *fmu, rc_type type, const list *of);
    answer (*set)(void *fmu, rc_type type, const list *to);
    answer (*set_slopes)(void *fmu, const list *to, const int32_t *orders); /* NULL: none */
    answer (*get_slopes)(void *fmu, const list *of, const int32_t *orders);
    answer (*derive)(void *fmu, const list *unknowns, const list *knowns);
    answer (*adjoin)(void *fmu, const list *unknowns, const list *knowns); /* NULL: there is none */
    answer (*save)(void *fmu, void **state);
    answer (*restore)(void *fmu, void *state);
    answer (*forget)(void *fmu, void **state);
    answer (*size)(void *fmu, void *state, size_t *size);
    answer (*serialise)(void *fmu, void *state, void *bytes, size_t size);
    answer (*deserialise)(void *fmu, const void *bytes, size_t size, void **state);
    /* A call that only this version has; the answers that are right, as bits. */
    answer (*odd)(void *fmu, draw *from, unsigned *right);
} host;

extern const host host_fmi2;
extern const host host_fmi3;

/* Notes a message that came with a status and a category; `format`: it is one of printf. */
void ear_hear(ear *heard, answer status, const char *category, const char *message, int format);

/* `count` values of a size in memory of their own, with zeros; for free(). */
void *exact(size_t count, size_t size);

#endif
