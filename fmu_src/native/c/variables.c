/* Variables of an instance by number. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "instance.h"

uint32_t rc_variable_count(const rc_model *model)
{
    return model->variable_count;
}

size_t rc_group_count(const rc_model *model)
{
    return model->kind->kind_count;
}

const rc_group *rc_group_at(const rc_model *model, size_t number)
{
    return number < model->kind->kind_count ? &model->groups[number] : NULL;
}

const rc_group *rc_group_of(const rc_model *model, uint32_t variable)
{
    return variable < model->variable_count ? &model->groups[model->group_of[variable]] : NULL;
}

size_t rc_name(const rc_model *model, uint32_t variable, char *name, size_t size)
{
    const rc_group *group = rc_group_of(model, variable);
    if (group == NULL)
        return 0;
    const char *mark = strchr(group->name, '#');
    const int before = mark == NULL ? (int)strlen(group->name) : (int)(mark - group->name);
    const int length =
        mark == NULL ? snprintf(name, size, "%s", group->name)
                     : snprintf(name, size, "%.*s%lu%s", before, group->name,
                                (unsigned long)(variable - group->first + group->lowest), mark + 1);
    return length > 0 && (size_t)length < size ? (size_t)length : 0;
}

rc_status rc_require_finite(rc_model *model, size_t group, const char *unit, const char *remedy)
{
    const double value = *rc_values(model, group);
    if (isfinite(value))
        return RC_OK;
    return rc_fail(model, RC_ERROR, "%s is %g %s; it must be a finite number: %s",
                   model->groups[group].name, value, unit, remedy);
}

rc_status rc_require_positive(rc_model *model, size_t group, const char *unit, const char *remedy)
{
    const double value = *rc_values(model, group);
    if (isfinite(value) && value > 0.0)
        return RC_OK;
    return rc_fail(model, RC_ERROR, "%s is %g %s; it must be a finite number above zero: %s",
                   model->groups[group].name, value, unit, remedy);
}

rc_status rc_take_offsets(rc_model *model, size_t group, double *offsets)
{
    offsets[0] = 0.0;
    for (size_t i = 1; i < model->dimensions[RC_WHEELS]; ++i) {
        offsets[i] = rc_values(model, group)[i - 1];
        if (!isfinite(offsets[i]))
            return rc_fail(model, RC_ERROR, "offset of wheel %zu is %g m; it must be a finite "
                                            "number: give its way behind wheel 1", i + 1,
                           offsets[i]);
    }
    return RC_OK;
}

static const char *type_name(rc_type type)
{
    static const char *const names[] = {"Real", "Integer", "Boolean", "String"};
    return names[type];
}

#define LONGEST_NAME 64

/* The name of a variable that there is, in `place`, which has room for it. */
static const char *name_in(const rc_model *model, uint32_t variable, char *place)
{
    (void)rc_name(model, variable, place, LONGEST_NAME);
    return place;
}

/* The group of a variable of the type asked for; NULL and a sentence if it is none. */
static const rc_group *typed_group(rc_model *model, uint32_t variable, rc_type type)
{
    const rc_group *group = rc_group_of(model, variable);
    if (group == NULL) {
        rc_fail(model, RC_ERROR, "there is no variable %lu; the last one is %lu",
                (unsigned long)variable, (unsigned long)(model->variable_count - 1));
        return NULL;
    }
    if (group->type != type) {
        char name[LONGEST_NAME];
        rc_fail(model, RC_ERROR, "%s is a %s, not a %s", name_in(model, variable, name),
                type_name(group->type), type_name(type));
        return NULL;
    }
    return group;
}

rc_status rc_get(rc_model *model, rc_type type, const uint32_t *variables, size_t count,
                 double *values)
{
    for (size_t i = 0; i < count; ++i) {
        const rc_group *group = typed_group(model, variables[i], type);
        if (group == NULL)
            return RC_ERROR;
        const size_t number = model->group_of[variables[i]], index = variables[i] - group->first;
        if (group->causality != RC_OUTPUT) {
            values[i] = model->values[model->slots[number] + index];
            continue;
        }
        double *outputs = model->outputs + model->slots[number];
        if (!model->known[number]) {
            const rc_status status = rc_get_group(model, number, outputs);
            if (status != RC_OK)
                return status;
        }
        values[i] = outputs[index];
    }
    return RC_OK;
}

/* Whether a variable may be set now. */
static rc_status may_set(rc_model *model, uint32_t variable)
{
    const rc_causality causality = rc_group_of(model, variable)->causality;
    char name[LONGEST_NAME];
    if (causality == RC_INPUT)
        return RC_OK;
    name_in(model, variable, name);
    if (causality == RC_OUTPUT)
        return rc_fail(model, RC_ERROR, "%s is an output and cannot be set", name);
    if (causality == RC_CONSTANT)
        return rc_fail(model, RC_ERROR, "%s is fixed in this FMU, whose modes were computed with "
                                        "it; build another FMU", name);
    if (model->head->phase == RC_STEPPING)
        return rc_fail(model, RC_ERROR, "%s is fixed once the initialisation has ended; set it "
                                        "before", name);
    return RC_OK;
}

/* What was worked out from the values is so no more while they still set the initial state. */
static void note_change(rc_model *model)
{
    if (model->head->phase == RC_INITIALISING) {
        model->head->started = 0;
        memset(model->known, 0, model->kind->kind_count);
    }
}

rc_status rc_set(rc_model *model, rc_type type, const uint32_t *variables, size_t count,
                 const double *values)
{
    for (size_t i = 0; i < count; ++i) {
        const rc_group *group = typed_group(model, variables[i], type);
        if (group == NULL || may_set(model, variables[i]) != RC_OK)
            return RC_ERROR;
    }
    for (size_t i = 0; i < count; ++i) {
        const size_t number = model->group_of[variables[i]];
        const size_t index = variables[i] - model->groups[number].first;
        model->values[model->slots[number] + index] = values[i];
    }
    note_change(model);
    return RC_OK;
}

rc_status rc_set_group(rc_model *model, size_t number, const double *values)
{
    const rc_group *group = &model->groups[number];
    if (group->type == RC_TEXT)
        return rc_fail(model, RC_ERROR, "%s is a text, not a number", group->name);
    if (may_set(model, group->first) != RC_OK)
        return RC_ERROR;
    memcpy(model->values + model->slots[number], values, group->count * sizeof(double));
    note_change(model);
    return RC_OK;
}

/* The place of a text. */
static char *text_of(rc_model *model, uint32_t variable)
{
    const size_t group = model->group_of[variable];
    const size_t index = variable - model->groups[group].first;
    return model->texts + RC_TEXT_SIZE * (model->slots[group] + index);
}

rc_status rc_get_text(rc_model *model, uint32_t variable, const char **text)
{
    if (typed_group(model, variable, RC_TEXT) == NULL)
        return RC_ERROR;
    *text = text_of(model, variable);
    return RC_OK;
}

rc_status rc_set_text(rc_model *model, uint32_t variable, const char *text)
{
    const rc_group *group = typed_group(model, variable, RC_TEXT);
    if (group == NULL || may_set(model, variable) != RC_OK)
        return RC_ERROR;
    const size_t length = strlen(text);
    if (length >= RC_TEXT_SIZE)
        return rc_fail(model, RC_ERROR, "%s has %zu bytes; at most %d are kept: use a shorter path",
                       group->name, length, RC_TEXT_SIZE - 1);
    char *place = text_of(model, variable);
    memset(place, 0, RC_TEXT_SIZE); /* equal parameters are equal bytes */
    memcpy(place, text, length);
    note_change(model);
    return RC_OK;
}
