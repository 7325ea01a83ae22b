/* Instances under fuzzed calls, and what each of them has to answer.
 *
 * A refused call leaves an instance as it was, so the phase follows from the calls that answered
 * OK. What an instance may answer is a set of bits, one for each `answer`.
 */
#ifndef FUZZ_SCHOOL_H
#define FUZZ_SCHOOL_H

#include "draw.h"
#include "host.h"
#include "model.h"

#define INSTANCES 4
#define STATES 24
#define MOST_OUTPUTS 512
#define TABLES 10 /* files, two of every kind; the last two never exist */

#define MAY_OK (1u << OK)
#define MAY_DISCARD (1u << DISCARD)
#define MAY_ERROR (1u << ERROR)
#define MAY_WARN (1u << 8) /* in the log, after OK; no instance answers WARNING */

typedef enum { CREATED = 1, INITIALISING = 2, STEPPING = 4, TERMINATED = 8 } phase;
#define RUNNING (CREATED | INITIALISING | STEPPING)
#define ANY (RUNNING | TERMINATED)

typedef struct {
    phase phase;
    int touched;  /* parameters or early inputs were set: the initialisation may be refused */
    int tainted;  /* holds a forged state: it may answer anything, but not crash */
    double start, time;
    double outputs[MOST_OUTPUTS]; /* of a saved state, bit for bit */
    int known;                    /* whether `outputs` are */
    unsigned spoilt;              /* how often the tables were before they were read */
} knowledge;

typedef struct {
    void *fmu;
    ear ear;
    int logger;
    int errors, discards, warnings; /* whether these categories are logged */
    int early_return;
    unsigned born; /* number of the instance, for states */
    knowledge is;
} pupil;

typedef struct {
    void *handle; /* NULL: an empty place */
    unsigned owner;
    knowledge of;
} keepsake;

typedef struct {
    const host *host;
    draw draw;
    uint64_t seed;
    unsigned long call, calls, answers[6];
    const char *doing; /* what is called now */
    const char *folder, *token, *scratch;
    pupil pupils[INSTANCES];
    keepsake states[STATES];
    unsigned births;
    rc_model *model; /* another instance, asked for the declaration of the variables */
    uint32_t variables;
    uint32_t *outputs; /* Real ones */
    size_t output_count;
    uint32_t *inputs;
    size_t input_count;
    const char *tables[TABLES];
    unsigned spoilt; /* how often the tables were written */
} school;

/* Ends the program with the seed and the call. */
#if defined(__GNUC__)
__attribute__((noreturn, format(printf, 2, 3)))
#endif
void blame(const school *at, const char *format, ...);

/* Before and after a call: whether its answer is one of `right`, and the log fits it. */
void ask(school *at, pupil *of, const char *doing);
void judge(school *at, pupil *of, answer given, unsigned right);

/* The same where there may be no instance: then only an error is right. */
unsigned right_in(const pupil *of, unsigned phases);

/* All Real outputs; whether the instance gave them. Blames outputs that are not finite. */
int read_outputs(school *at, pupil *of, double *values);

/* Whether all Real inputs are finite numbers. */
int inputs_are_finite(school *at, pupil *of);

/* Blames an instance whose outputs are not those remembered. */
void compare(school *at, pupil *of, const knowledge *with);

/* Groups of random calls. */
void call_life(school *at, pupil *of);
void call_values(school *at, pupil *of);
void call_slopes(school *at, pupil *of);
void call_step(school *at, pupil *of);
void call_states(school *at, pupil *of);
void call_bytes(school *at, pupil *of);
void call_start(school *at, pupil *of); /* through a whole proper initialisation */
void make_wishes(school *at, pupil *of); /* parameters of an instance to be initialised */
void spoil_tables(school *at);
void leave_school(school *at);

#endif
