/* The life of an instance: initialisation, steps, outputs, derivatives. */
#include "model.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "instance.h"

#define TIME_TOLERANCE 1e-9  /* relative; sums of steps may differ by rounding */
#define TIME_RESOLUTION 1e-12 /* s */

rc_status rc_fail(rc_model *model, rc_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(model->message, RC_MESSAGE_SIZE, format, arguments);
    va_end(arguments);
    return status;
}

size_t rc_parameter_bytes(const rc_model *model)
{
    return RC_TEXT_SIZE * model->text_count + sizeof(double) * model->input_first;
}

const char *rc_message(const rc_model *model)
{
    return model->message;
}

const char *rc_warning(const rc_model *model)
{
    return model->warning;
}

rc_phase rc_current_phase(const rc_model *model)
{
    return (rc_phase)model->head->phase;
}

double rc_time(const rc_model *model)
{
    return model->head->time;
}

rc_status rc_prepare(rc_model *model)
{
    const size_t size = rc_parameter_bytes(model);
    if (model->prepared && memcmp(model->made_from, model->texts, size) == 0)
        return RC_OK;
    model->prepared = 0;
    const rc_status status = model->kind->prepare(model);
    if (status == RC_OK) {
        memcpy(model->made_from, model->texts, size);
        model->prepared = 1;
    }
    return status;
}

rc_status rc_enter_initialisation(rc_model *model, double start_time)
{
    if (model->head->phase != RC_INSTANTIATED)
        return rc_fail(model, RC_ERROR, "the initialisation has begun already; reset first");
    if (!isfinite(start_time))
        return rc_fail(model, RC_ERROR, "the start time is %g s, not a number", start_time);
    const rc_status status = rc_prepare(model);
    if (status != RC_OK)
        return status;
    model->head->time = start_time;
    model->head->started = 0;
    model->head->phase = RC_INITIALISING;
    return RC_OK;
}

/* Whether the state gives outputs that are numbers; all of them are worked out. */
static int has_finite_outputs(rc_model *model)
{
    for (size_t g = 0; g < model->kind->kind_count; ++g) {
        if (model->groups[g].causality != RC_OUTPUT)
            continue;
        double *outputs = model->outputs + model->slots[g];
        model->kind->read(model, g, outputs);
        model->known[g] = 1;
        for (uint32_t i = 0; i < model->groups[g].count; ++i)
            if (!isfinite(outputs[i]))
                return 0;
    }
    return 1;
}

/* Works the initial state out if parameters or inputs have changed since the last time. */
static rc_status ensure_started(rc_model *model)
{
    if (model->head->started)
        return RC_OK;
    memset(model->known, 0, model->kind->kind_count);
    const rc_status prepared = rc_prepare(model);
    if (prepared != RC_OK)
        return prepared;
    const rc_status status = model->kind->start(model);
    if (status != RC_OK)
        return status;
    if (!has_finite_outputs(model)) {
        memset(model->known, 0, model->kind->kind_count);
        return rc_fail(model, RC_ERROR, "no finite initial state follows from these parameters and "
                                        "inputs; look for one that is out of all proportion");
    }
    model->head->started = 1;
    return RC_OK;
}

rc_status rc_exit_initialisation(rc_model *model)
{
    if (model->head->phase != RC_INITIALISING)
        return rc_fail(model, RC_ERROR, "the initialisation ends after it has begun");
    const rc_status status = ensure_started(model);
    if (status == RC_OK)
        model->head->phase = RC_STEPPING;
    return status;
}

static int joins(double time, double present)
{
    const double limit = TIME_TOLERANCE * fmax(fabs(time), fabs(present));
    return fabs(time - present) <= fmax(limit, TIME_RESOLUTION);
}

rc_status rc_step(rc_model *model, double time, double step, rc_input_shape shape,
                  double *reached)
{
    *reached = model->head->time;
    model->warning[0] = '\0';
    if (model->head->phase != RC_STEPPING)
        return rc_fail(model, RC_ERROR, "a step comes after the initialisation");
    if (!joins(time, model->head->time))
        return rc_fail(model, RC_DISCARD,
                       "a step from %.17g s does not continue from %.17g s; restore the state of "
                       "that time first", time, model->head->time);
    if (!(isfinite(time + step) && step > 0.0))
        return rc_fail(model, RC_DISCARD, "the step size is %g s; it must be a finite number "
                                          "above zero, and so must be its end", step);
    if (!(time + step > time))
        return rc_fail(model, RC_DISCARD, "a step of %g s from %.17g s does not move the time on; "
                                          "use a longer one", step, time);
    model->stepped = 0; /* what derivatives need may be overwritten even if the step is refused */
    const rc_status status = model->kind->step(
        model, step, shape == RC_AS_PARAMETER ? model->linear : shape == RC_STRAIGHT);
    if (status != RC_OK)
        return status;
    *reached = model->head->time = time + step;
    memset(model->known, 0, model->kind->kind_count);
    model->stepped = 1;
    return RC_OK;
}

rc_status rc_jump(rc_model *model)
{
    if (model->head->phase != RC_STEPPING)
        return rc_fail(model, RC_ERROR, "inputs jump after the initialisation");
    model->stepped = 0;
    const rc_status status = model->kind->jump(model);
    if (status == RC_OK)
        memset(model->known, 0, model->kind->kind_count);
    return status;
}

rc_status rc_get_group(rc_model *model, size_t number, double *values)
{
    const rc_group *group = &model->groups[number];
    const size_t bytes = group->count * sizeof(double);
    if (group->type == RC_TEXT)
        return rc_fail(model, RC_ERROR, "%s is a text, not a number", group->name);
    if (group->causality != RC_OUTPUT) {
        memcpy(values, model->values + model->slots[number], bytes);
        return RC_OK;
    }
    if (model->head->phase == RC_INSTANTIATED) {
        memset(values, 0, bytes); /* nothing is known yet */
        return RC_OK;
    }
    const rc_status status = ensure_started(model);
    if (status != RC_OK)
        return status;
    double *outputs = model->outputs + model->slots[number];
    if (!model->known[number]) {
        model->kind->read(model, number, outputs);
        model->known[number] = 1;
    }
    if (values != outputs)
        memcpy(values, outputs, bytes);
    return RC_OK;
}

rc_status rc_derivative(rc_model *model, const uint32_t *unknowns, size_t unknown_count,
                        const uint32_t *knowns, size_t known_count, const double *seed,
                        double *sensitivity)
{
    double *input = model->change;
    double *output = input + (model->value_count - model->input_first);
    if (!model->stepped)
        return rc_fail(model, RC_DISCARD, "derivatives are those of the last step; none "
                                          "succeeded since the last restored or refused one");
    memset(model->change, 0,
           sizeof(double) * (model->value_count - model->input_first + model->output_count));
    for (size_t i = 0; i < known_count; ++i) {
        const rc_group *group = rc_group_of(model, knowns[i]);
        if (group == NULL || group->causality != RC_INPUT || group->type != RC_REAL)
            return rc_fail(model, RC_ERROR, "variable %lu is no Real input",
                           (unsigned long)knowns[i]);
        const size_t slot = model->slots[model->group_of[knowns[i]]] + knowns[i] - group->first;
        input[slot - model->input_first] += seed[i];
    }
    for (size_t i = 0; i < unknown_count; ++i) {
        const rc_group *group = rc_group_of(model, unknowns[i]);
        if (group == NULL || group->causality != RC_OUTPUT || group->type != RC_REAL)
            return rc_fail(model, RC_ERROR, "variable %lu is no Real output",
                           (unsigned long)unknowns[i]);
    }
    const rc_status status = model->kind->derive(model, model->change, output);
    if (status != RC_OK)
        return status;
    for (size_t i = 0; i < unknown_count; ++i) {
        const rc_group *group = rc_group_of(model, unknowns[i]);
        sensitivity[i] = output[model->slots[model->group_of[unknowns[i]]] + unknowns[i] -
                                group->first];
    }
    return RC_OK;
}
