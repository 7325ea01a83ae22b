/* Makes an instance from its resource, and frees it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"

#define MOST_WHEELS 10000

const double *rc_require_section(rc_model *model, const char *name, size_t count)
{
    size_t found;
    const double *values = rc_find_section(&model->resource, name, RC_FLOAT64, &found);
    if (values != NULL && found == count)
        return values;
    rc_fail(model, RC_ERROR, "the resource has %zu numbers named '%s', not %zu; build the FMU "
                             "again", found, name, count);
    return NULL;
}

rc_status rc_read_wheels(rc_model *model)
{
    size_t count;
    const int64_t *structure = rc_find_section(&model->resource, "structure", RC_INT64, &count);
    if (structure == NULL || count != 2 || structure[0] < 1 || structure[0] > MOST_WHEELS ||
        structure[1] < 1 || structure[1] > structure[0] || structure[0] % structure[1] != 0)
        return rc_fail(model, RC_ERROR, "the resource does not say how many wheels there are in how "
                                        "many bogies; build the FMU again");
    model->dimensions[RC_WHEELS] = (size_t)structure[0];
    model->dimensions[RC_FOLLOWERS] = (size_t)structure[0] - 1;
    model->dimensions[RC_BOGIES] = (size_t)structure[1];
    return RC_OK;
}

/* Gives every group its variables and its place; texts, parameters, inputs and outputs apart. */
static void lay_out(rc_model *model)
{
    const rc_class *kind = model->kind;
    size_t inputs = 0;
    for (size_t g = 0; g < kind->kind_count; ++g) {
        const rc_group_kind *from = &kind->kinds[g];
        const size_t count = model->dimensions[from->dimension];
        model->groups[g] = (rc_group){.name = from->name,
                                      .type = from->type,
                                      .causality = from->causality,
                                      .first = model->variable_count,
                                      .count = (uint32_t)count,
                                      .lowest = from->dimension == RC_FOLLOWERS ? 2 : 1};
        model->variable_count += (uint32_t)count;
        size_t *end = from->causality == RC_OUTPUT  ? &model->output_count
                      : from->type == RC_TEXT       ? &model->text_count
                      : from->causality == RC_INPUT ? &inputs
                                                    : &model->input_first;
        model->slots[g] = *end;
        *end += count;
    }
    model->value_count = model->input_first + inputs;
    for (size_t g = 0; g < kind->kind_count; ++g)
        if (kind->kinds[g].causality == RC_INPUT)
            model->slots[g] += model->input_first;
}

static void point_into_state(rc_model *model)
{
    model->head = (rc_head *)(void *)model->state;
    model->texts = (char *)model->state + sizeof(rc_head);
    model->values = (double *)(void *)(model->texts + RC_TEXT_SIZE * model->text_count);
    model->dynamic = model->values + model->value_count;
}

/* Claims at least one byte, filled with zeros. */
static void *claim(size_t count, size_t size)
{
    return calloc(count > 0 ? count : 1, size);
}

static int allocate(rc_model *model)
{
    const size_t kinds = model->kind->kind_count;
    model->groups = claim(kinds, sizeof *model->groups);
    model->slots = claim(kinds, sizeof *model->slots);
    if (model->groups == NULL || model->slots == NULL)
        return 0;
    lay_out(model);
    model->state_size = sizeof(rc_head) + RC_TEXT_SIZE * model->text_count +
                        sizeof(double) * (model->value_count + model->dynamic_count);
    model->state = claim(1, model->state_size);
    model->group_of = claim(model->variable_count, sizeof *model->group_of);
    model->outputs = claim(model->output_count, sizeof(double));
    model->known = claim(kinds, 1);
    model->made_from = claim(1, rc_parameter_bytes(model));
    model->change = claim(model->value_count + model->output_count, sizeof(double));
    if (model->state == NULL || model->group_of == NULL || model->outputs == NULL ||
        model->known == NULL || model->made_from == NULL || model->change == NULL)
        return 0;
    point_into_state(model);
    for (size_t g = 0; g < kinds; ++g)
        for (uint32_t i = 0; i < model->groups[g].count; ++i)
            model->group_of[model->groups[g].first + i] = (uint16_t)g;
    return 1;
}

/* Start values: numbers in the order of the variables, then the texts, each with a zero. */
static rc_status set_start_values(rc_model *model)
{
    size_t text_bytes;
    const double *numbers = rc_require_section(model, "start", model->value_count);
    const char *text = rc_find_section(&model->resource, "start_text", RC_BYTES, &text_bytes);
    const char *end = text == NULL ? NULL : text + text_bytes;
    if (numbers == NULL)
        return RC_ERROR;
    memset(model->state, 0, model->state_size);
    for (size_t g = 0; g < model->kind->kind_count; ++g) {
        const rc_group *group = &model->groups[g];
        if (group->causality == RC_OUTPUT)
            continue;
        if (group->type != RC_TEXT) {
            memcpy(model->values + model->slots[g], numbers, group->count * sizeof(double));
            numbers += group->count;
            continue;
        }
        for (uint32_t i = 0; i < group->count; ++i) {
            const char *zero = text == NULL ? NULL : memchr(text, 0, (size_t)(end - text));
            if (zero == NULL || zero - text >= RC_TEXT_SIZE)
                return rc_fail(model, RC_ERROR, "the resource has no start value of %s; build the "
                                                "FMU again", group->name);
            memcpy(model->texts + RC_TEXT_SIZE * (model->slots[g] + i), text,
                   (size_t)(zero - text));
            text = zero + 1;
        }
    }
    if (text != end)
        return rc_fail(model, RC_ERROR, "the resource has more start texts than the model; build "
                                        "the FMU again");
    return RC_OK;
}

static rc_status create(rc_model *model, const void *data, size_t size)
{
    if (!rc_open_resource(&model->resource, data, size, model->message, RC_MESSAGE_SIZE))
        return RC_ERROR;
    size_t length;
    const char *name = rc_find_section(&model->resource, "model", RC_BYTES, &length);
    if (name == NULL || length != strlen(model->kind->name) ||
        memcmp(name, model->kind->name, length) != 0)
        return rc_fail(model, RC_ERROR, "the resource is not that of a %s", model->kind->name);
    model->dimensions[RC_ONE] = 1;
    model->own = claim(1, model->kind->own_size);
    if (model->own == NULL)
        return rc_fail(model, RC_ERROR, "there is not enough memory for a %s", model->kind->name);
    const rc_status status = model->kind->open(model);
    if (status != RC_OK)
        return status;
    if (!allocate(model))
        return rc_fail(model, RC_ERROR, "there is not enough memory for a %s", model->kind->name);
    return set_start_values(model);
}

rc_model *rc_create(const rc_class *kind, const void *data, size_t size, char *message)
{
    rc_model *model = calloc(1, sizeof *model);
    if (model == NULL) {
        snprintf(message, RC_MESSAGE_SIZE, "there is not enough memory for a %s", kind->name);
        return NULL;
    }
    model->kind = kind;
    if (create(model, data, size) == RC_OK)
        return model;
    memcpy(message, model->message, RC_MESSAGE_SIZE);
    rc_destroy(model);
    return NULL;
}

void rc_destroy(rc_model *model)
{
    if (model == NULL)
        return;
    if (model->own != NULL)
        model->kind->release(model);
    free(model->own);
    free(model->groups);
    free(model->slots);
    free(model->group_of);
    free(model->state);
    free(model->outputs);
    free(model->known);
    free(model->made_from);
    free(model->change);
    free(model);
}

void rc_reset(rc_model *model)
{
    (void)set_start_values(model); /* succeeded once, with the same resource */
    memset(model->known, 0, model->kind->kind_count);
    model->stepped = 0;
    model->warning[0] = '\0';
}
