/* An instance of a model, and what a model gives to the part that all models share. */
#ifndef RC_INSTANCE_H
#define RC_INSTANCE_H

#include "binary.h"
#include "model.h"

/* How many variables a group has. */
typedef enum {
    RC_ONE,
    RC_WHEELS,
    RC_FOLLOWERS, /* the wheels behind the first, counted from 2 */
    RC_GAUGES,
    RC_SUPPORTS,
    RC_BOGIES,
    RC_DIMENSIONS
} rc_dimension;

typedef struct {
    const char *name;
    rc_type type;
    rc_causality causality;
    rc_dimension dimension;
} rc_group_kind;

struct rc_class {
    const char *name;
    const rc_group_kind *kinds;
    size_t kind_count;
    size_t own_size; /* bytes of the model's own memory, which starts as zeros */
    /* Checks the resource; sets the numbers of wheels, gauges, supports and of state values. */
    rc_status (*open)(rc_model *model);
    /* Makes what follows from the parameters, which are final then; may be called again. */
    rc_status (*prepare)(rc_model *model);
    rc_status (*start)(rc_model *model);
    rc_status (*step)(rc_model *model, double step, int linear);
    rc_status (*jump)(rc_model *model);
    /* Outputs of a group. */
    void (*read)(rc_model *model, size_t group, double *values);
    /* Derivatives of all outputs, one block after the other as in `outputs`, after a step. */
    rc_status (*derive)(rc_model *model, const double *input_seed, double *output_change);
    void (*release)(rc_model *model); /* frees what open and prepare claimed */
};

typedef struct {
    double time;
    int64_t phase;
    int64_t started; /* whether the initial state is that of the present inputs */
} rc_head;

struct rc_model {
    const rc_class *kind;
    rc_resource resource;
    size_t dimensions[RC_DIMENSIONS];
    rc_group *groups;
    size_t *slots;      /* of every group: its first place among texts, values or outputs */
    uint16_t *group_of; /* of every variable */
    uint32_t variable_count;
    size_t text_count, value_count, input_first, output_count, dynamic_count;

    /* the state: head, texts, parameters and constants, inputs, dynamic values */
    unsigned char *state;
    size_t state_size;
    rc_head *head;
    char *texts;
    double *values;  /* parameters and constants, then inputs */
    double *dynamic; /* the model's own */

    double *outputs;
    unsigned char *known;     /* of every group, whether its outputs are worked out */
    unsigned char *made_from; /* texts and parameters that `prepare` saw last */
    double *change;           /* seeds and derivatives */
    int linear; /* the parameter linear_inputs */
    int prepared, stepped;
    void *own;
    char message[RC_MESSAGE_SIZE];
    char warning[RC_MESSAGE_SIZE];
};

/* Keeps a sentence for rc_message and returns the status. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
rc_status rc_fail(rc_model *model, rc_status status, const char *format, ...);

/* The first value of a group of parameters or inputs. */
static inline const double *rc_values(const rc_model *model, size_t group)
{
    return model->values + model->slots[group];
}

/* The first text of a group; the next ones are RC_TEXT_SIZE bytes further on each. */
static inline const char *rc_text(const rc_model *model, size_t group)
{
    return model->texts + RC_TEXT_SIZE * model->slots[group];
}

/* A section of float64 of exactly that many values, or NULL and a sentence. */
const double *rc_require_section(rc_model *model, const char *name, size_t count);

/* Reads the numbers of wheels and bogies of a model that has nothing else to count. */
rc_status rc_read_wheels(rc_model *model);

/* Takes how far every wheel runs behind the first, whose 0 no parameter says; all finite. */
rc_status rc_take_offsets(rc_model *model, size_t group, double *offsets);

/* Refuse a parameter that is no finite number, or none above zero. */
rc_status rc_require_finite(rc_model *model, size_t group, const char *unit, const char *remedy);
rc_status rc_require_positive(rc_model *model, size_t group, const char *unit, const char *remedy);

/* Bytes from texts to the last parameter. */
size_t rc_parameter_bytes(const rc_model *model);

/* Makes `prepare` follow the present parameters. */
rc_status rc_prepare(rc_model *model);

#endif
