/* An instance of an FMU, whatever version of FMI its host speaks.
 *
 * Every refusal is logged with a sentence. The complete state, for hosts that go back, is one
 * block: rc_fmu_head, the slopes of the inputs, the inputs at the last communication point, the
 * state of the model.
 */
#ifndef RC_FMU_H
#define RC_FMU_H

#include "model.h"

#if defined(__GNUC__)
#define RC_LIKE_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define RC_LIKE_PRINTF(text, first)
#endif

/* Where an instance is in its life; bits, so that a function can list where it may be called. */
typedef enum {
    RC_FMU_CREATED = 1,
    RC_FMU_INITIALISING = 2,
    RC_FMU_STEPPING = 4,
    RC_FMU_TERMINATED = 8
} rc_fmu_phase;
#define RC_FMU_ANY 15u

#define RC_LOG_DISCARD 1u /* categories, bits */
#define RC_LOG_ERROR 2u
#define RC_LOG_WARNING 4u
#define RC_LOG_ALL 7u

typedef struct rc_fmu rc_fmu;

/* Hands a sentence to the host's logger; a warning has the status RC_OK. */
typedef void (*rc_fmu_log)(const rc_fmu *fmu, rc_status status, const char *category,
                           const char *message);

typedef struct {
    double start_time; /* s */
    double reached;    /* s; last successful time */
    int32_t terminated;
    int32_t sloped; /* whether slopes are set for the next step */
    int32_t discarded; /* whether the last step was */
    int32_t unused;
} rc_fmu_head;

struct rc_fmu {
    rc_model *model;
    void *resource;
    char *name;
    rc_fmu_log log;
    void (*logger)(void); /* the host's; cast back by `log` */
    void (*update)(void); /* of the host, NULL without: told of the end of every step (FMI 3.0) */
    void *environment;
    unsigned categories;
    int early_return; /* whether a step may end at a switch of contact */
    const rc_group *gap; /* signed outputs whose signs are those switches; NULL: there are none */
    uint32_t linear_inputs; /* number of the parameter */
    const rc_group *inputs; /* the first group of them; the others follow it */
    size_t input_groups, input_count;
    rc_fmu_head *head;
    double *slopes, *last; /* of the inputs; behind the head */
    size_t own_size;       /* bytes of head, slopes and last */
    double *present, *ends; /* scratch for inputs */
    double *gaps, *gaps_now; /* scratch for gaps before a step and after it */
    void *before, *start;   /* scratch for states of the model: before a jump, before a step */
    struct rc_saved *states, *freed_states; /* all that were saved, and those freed of them */
    char message[RC_MESSAGE_SIZE];
};

typedef struct {
    const char *name, *token;
    const char *folder; /* of the resources: a path or a file URI */
    rc_fmu_log log;
    void (*logger)(void);
    void *environment;
    int logging;
} rc_fmu_request;

/* NULL, with the reason logged, where there can be none. */
rc_fmu *rc_fmu_create(const rc_fmu_request *request);
void rc_fmu_free(rc_fmu *fmu);
void rc_fmu_reset(rc_fmu *fmu);

rc_fmu_phase rc_fmu_present_phase(const rc_fmu *fmu);

/* Logs a sentence and returns the status. */
RC_LIKE_PRINTF(3, 4)
rc_status rc_fmu_refuse(rc_fmu *fmu, rc_status status, const char *format, ...);

/* Passes on what the model answered, with its sentence if it refused. */
rc_status rc_fmu_pass(rc_fmu *fmu, rc_status status);

/* Logs what is doubtful about the last step. */
void rc_fmu_warn(const rc_fmu *fmu);

/* Refuses a call in other phases than these, and without an argument that it needs. */
rc_status rc_fmu_expect(rc_fmu *fmu, const char *call, unsigned phases);
rc_status rc_fmu_need(rc_fmu *fmu, const char *call, size_t count, const void *argument);

/* Turns categories of the log on or off; all of them if `count` is 0. */
rc_status rc_fmu_choose_log(rc_fmu *fmu, int on, size_t count, const char *const *names);

rc_status rc_fmu_set_experiment(rc_fmu *fmu, double start, int has_stop, double stop);
rc_status rc_fmu_enter(rc_fmu *fmu);
rc_status rc_fmu_exit(rc_fmu *fmu);
rc_status rc_fmu_terminate(rc_fmu *fmu);

/* Slope of an input over the next step. A step that succeeds forgets the slopes and leaves the
 * inputs at their values at its end. */
rc_status rc_fmu_set_slope(rc_fmu *fmu, uint32_t variable, int32_t order, double slope);

/* First derivative of an output by time. */
rc_status rc_fmu_output_slope(rc_fmu *fmu, uint32_t variable, int32_t order, double *slope);

/* One step of the model from the inputs in `present`; with slopes, to those at its end. */
rc_status rc_fmu_step_once(rc_fmu *fmu, double time, double step);
void rc_fmu_write_inputs(rc_fmu *fmu, const double *values);

/* Keeps what it takes to go back from a step, and ends the step just behind the first switch of
 * contact that was found in it. */
void rc_fmu_watch(rc_fmu *fmu);
rc_status rc_fmu_go_back_to_switch(rc_fmu *fmu, double time, double step, int *ended_early);

/* A step. `ended_early` is set where it ended at a switch of contact. */
rc_status rc_fmu_step(rc_fmu *fmu, double time, double step, int *ended_early);

/* sensitivity = transpose(d(unknowns)/d(knowns)) seed. */
rc_status rc_fmu_adjoint(rc_fmu *fmu, const uint32_t *unknowns, size_t unknown_count,
                         const uint32_t *knowns, size_t known_count, const double *seed,
                         double *sensitivity);

/* Saved states; `*saved` is made where it is NULL, written over where it is not. They end with
 * their instance; others of the same resource may read them until then. */
void rc_fmu_free_states(rc_fmu *fmu);
rc_status rc_fmu_save(rc_fmu *fmu, void **saved);
rc_status rc_fmu_restore(rc_fmu *fmu, const void *saved);
rc_status rc_fmu_forget(rc_fmu *fmu, void **saved);
rc_status rc_fmu_serialised_size(rc_fmu *fmu, const void *saved, size_t *size);
rc_status rc_fmu_serialise(rc_fmu *fmu, const void *saved, void *bytes, size_t size);
rc_status rc_fmu_deserialise(rc_fmu *fmu, const void *bytes, size_t size, void **saved);

#endif
