/* The life of an FMU's instance: resources, log, phases. */
#include "fmu.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "resource_file.h"

#define MODEL_FILE "model.bin"
#define BUILD_FILE "build.txt"

static const struct {
    unsigned bit;
    const char *name;
} CATEGORIES[] = {{RC_LOG_DISCARD, "logStatusDiscard"},
                  {RC_LOG_ERROR, "logStatusError"},
                  {RC_LOG_WARNING, "logStatusWarning"}};
#define CATEGORY_COUNT (sizeof CATEGORIES / sizeof CATEGORIES[0])

static void report(const rc_fmu *fmu, rc_status status, const char *message)
{
    const size_t category = status == RC_DISCARD ? 0 : status == RC_ERROR ? 1 : 2;
    if (fmu->logger != NULL && (fmu->categories & CATEGORIES[category].bit))
        fmu->log(fmu, status, CATEGORIES[category].name, message);
}

rc_status rc_fmu_refuse(rc_fmu *fmu, rc_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fmu->message, sizeof fmu->message, format, arguments);
    va_end(arguments);
    report(fmu, status, fmu->message);
    return status;
}

/* The same with the sentence that is in `message` already. */
static rc_status refuse_as_said(const rc_fmu *fmu)
{
    report(fmu, RC_ERROR, fmu->message);
    return RC_ERROR;
}

rc_status rc_fmu_pass(rc_fmu *fmu, rc_status status)
{
    if (status != RC_OK)
        report(fmu, status, rc_message(fmu->model));
    return status;
}

void rc_fmu_warn(const rc_fmu *fmu)
{
    if (rc_warning(fmu->model)[0] != '\0')
        report(fmu, RC_OK, rc_warning(fmu->model));
}

static const char *phase_name(rc_fmu_phase phase)
{
    switch (phase) {
    case RC_FMU_CREATED:
        return "before the initialisation";
    case RC_FMU_INITIALISING:
        return "during the initialisation";
    case RC_FMU_STEPPING:
        return "between steps";
    default:
        return "after the end";
    }
}

rc_fmu_phase rc_fmu_present_phase(const rc_fmu *fmu)
{
    if (fmu->head->terminated)
        return RC_FMU_TERMINATED;
    switch (rc_current_phase(fmu->model)) {
    case RC_INSTANTIATED:
        return RC_FMU_CREATED;
    case RC_INITIALISING:
        return RC_FMU_INITIALISING;
    default:
        return RC_FMU_STEPPING;
    }
}

rc_status rc_fmu_expect(rc_fmu *fmu, const char *call, unsigned phases)
{
    const rc_fmu_phase phase = rc_fmu_present_phase(fmu);
    if (phase & phases)
        return RC_OK;
    return rc_fmu_refuse(fmu, RC_ERROR, "%s may not be called %s", call, phase_name(phase));
}

rc_status rc_fmu_need(rc_fmu *fmu, const char *call, size_t count, const void *argument)
{
    if (count == 0 || argument != NULL)
        return RC_OK;
    return rc_fmu_refuse(fmu, RC_ERROR, "%s was called with a NULL pointer", call);
}

rc_status rc_fmu_choose_log(rc_fmu *fmu, int on, size_t count, const char *const *names)
{
    unsigned chosen = count == 0 ? RC_LOG_ALL : 0;
    for (size_t i = 0; i < count; ++i) {
        if (names[i] == NULL)
            return rc_fmu_refuse(fmu, RC_ERROR, "category %zu of the log is NULL", i + 1);
        size_t k = 0;
        while (k < CATEGORY_COUNT && strcmp(names[i], CATEGORIES[k].name) != 0)
            ++k;
        if (k == CATEGORY_COUNT)
            return rc_fmu_refuse(fmu, RC_ERROR, "the log has no category '%s'; it must be %s, %s "
                                                "or %s", names[i], CATEGORIES[0].name,
                                 CATEGORIES[1].name, CATEGORIES[2].name);
        chosen |= CATEGORIES[k].bit;
    }
    fmu->categories = on ? fmu->categories | chosen : fmu->categories & ~chosen;
    return RC_OK;
}

/* Finds the inputs, which stand together, and the gaps. */
static void find_groups(rc_fmu *fmu)
{
    for (size_t g = 0; g < rc_group_count(fmu->model); ++g) {
        const rc_group *group = rc_group_at(fmu->model, g);
        if (group->causality == RC_INPUT) {
            if (fmu->input_groups++ == 0)
                fmu->inputs = group;
            fmu->input_count += group->count;
        }
        if (group->causality == RC_OUTPUT && strcmp(group->name, "wheel[#].gap") == 0)
            fmu->gap = group;
        if (strcmp(group->name, "linear_inputs") == 0)
            fmu->linear_inputs = group->first;
    }
}

static rc_status claim_memory(rc_fmu *fmu)
{
    const size_t inputs = fmu->input_count, gaps = fmu->gap == NULL ? 0 : fmu->gap->count;
    fmu->own_size = sizeof(rc_fmu_head) + 2 * inputs * sizeof(double);
    fmu->head = calloc(1, fmu->own_size);
    fmu->present = calloc(2 * inputs + 2 * gaps + 1, sizeof(double));
    fmu->before = malloc(rc_state_size(fmu->model));
    fmu->start = malloc(rc_state_size(fmu->model));
    if (fmu->head == NULL || fmu->present == NULL || fmu->before == NULL || fmu->start == NULL)
        return rc_fmu_refuse(fmu, RC_ERROR, "there is not enough memory for this instance");
    fmu->slopes = (double *)(void *)(fmu->head + 1);
    fmu->last = fmu->slopes + inputs;
    fmu->ends = fmu->present + inputs;
    fmu->gaps = fmu->ends + inputs;
    fmu->gaps_now = fmu->gaps + gaps;
    return RC_OK;
}

/* Whether the host's token is that of this build, whose resources these are. */
static rc_status check_token(rc_fmu *fmu, const char *token, const char *folder)
{
    size_t size;
    char *build = rc_read_resource(folder, BUILD_FILE, &size, fmu->message, sizeof fmu->message);
    if (build == NULL)
        return refuse_as_said(fmu);
    build[strcspn(build, "\r\n")] = '\0';
    const rc_status status =
        strcmp(build, token) == 0
            ? RC_OK
            : rc_fmu_refuse(fmu, RC_ERROR, "the resources are of build %.64s, the model "
                                           "description is of %.64s; unpack the FMU again",
                            build, token);
    free(build);
    return status;
}

static rc_status create(rc_fmu *fmu, const rc_fmu_request *request)
{
    if (request->name == NULL || request->name[0] == '\0')
        return rc_fmu_refuse(fmu, RC_ERROR, "an instance needs a name");
    fmu->name = malloc(strlen(request->name) + 1);
    if (fmu->name == NULL)
        return rc_fmu_refuse(fmu, RC_ERROR, "there is not enough memory for this instance");
    strcpy(fmu->name, request->name);
    if (request->token == NULL)
        return rc_fmu_refuse(fmu, RC_ERROR, "an instance needs the token (GUID) of the model "
                                            "description");
    if (request->folder == NULL)
        return rc_fmu_refuse(fmu, RC_ERROR, "an instance needs the folder of the resources");
    if (check_token(fmu, request->token, request->folder) != RC_OK)
        return RC_ERROR;
    size_t size;
    fmu->resource = rc_read_resource(request->folder, MODEL_FILE, &size, fmu->message,
                                     sizeof fmu->message);
    if (fmu->resource == NULL)
        return refuse_as_said(fmu);
    fmu->model = rc_create(rc_library_class(), fmu->resource, size, fmu->message);
    if (fmu->model == NULL)
        return refuse_as_said(fmu);
    find_groups(fmu);
    return claim_memory(fmu);
}

rc_fmu *rc_fmu_create(const rc_fmu_request *request)
{
    rc_fmu *fmu = calloc(1, sizeof *fmu);
    if (fmu == NULL)
        return NULL;
    fmu->log = request->log;
    fmu->logger = request->logger;
    fmu->environment = request->environment;
    fmu->categories = request->logging ? RC_LOG_ALL : RC_LOG_ERROR | RC_LOG_WARNING;
    if (create(fmu, request) == RC_OK)
        return fmu;
    rc_fmu_free(fmu);
    return NULL;
}

void rc_fmu_free(rc_fmu *fmu)
{
    if (fmu == NULL)
        return;
    rc_fmu_free_states(fmu);
    rc_destroy(fmu->model);
    free(fmu->resource);
    free(fmu->name);
    free(fmu->head);
    free(fmu->present);
    free(fmu->before);
    free(fmu->start);
    free(fmu);
}

void rc_fmu_reset(rc_fmu *fmu)
{
    rc_reset(fmu->model);
    memset(fmu->head, 0, fmu->own_size);
}

rc_status rc_fmu_set_experiment(rc_fmu *fmu, double start, int has_stop, double stop)
{
    if (!isfinite(start))
        return rc_fmu_refuse(fmu, RC_ERROR, "the start time is %g s, not a number", start);
    if (has_stop && !(stop >= start))
        return rc_fmu_refuse(fmu, RC_ERROR,
                             "the stop time of %g s is before the start time of %g s", stop, start);
    fmu->head->start_time = fmu->head->reached = start;
    return RC_OK;
}

rc_status rc_fmu_enter(rc_fmu *fmu)
{
    return rc_fmu_pass(fmu, rc_enter_initialisation(fmu->model, fmu->head->start_time));
}

rc_status rc_fmu_terminate(rc_fmu *fmu)
{
    fmu->head->terminated = 1;
    return RC_OK;
}
