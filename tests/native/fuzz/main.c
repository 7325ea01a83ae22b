/* Calls the functions of FMI in any order with any arguments, or makes models of damaged resources.
 *
 * fuzz 2|3|resources SEED CALLS FOLDER TOKEN SCRATCH, FOLDER being that of the resources and SCRATCH one
 * with damaged ones, which the program may write into. Ends with 1 and a sentence on the first
 * answer that is wrong; a sanitizer ends it where it sees something.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "resource_file.h"
#include "resources.h"
#include "school.h"

typedef void (*group_of_calls)(school *at, pupil *of);

static void call_something(school *at, pupil *of)
{
    static const group_of_calls groups[] = {
        call_life,   call_start,  call_start,  call_values, call_values, call_values, call_slopes,
        call_slopes, call_step,   call_step,   call_step,   call_step,   call_step,   call_step,
        call_states, call_states, call_states, call_bytes};
    groups[draw_below(&at->draw, sizeof groups / sizeof groups[0])](at, of);
}

/* Real variables of a causality. */
static uint32_t *find(const rc_model *model, rc_causality causality, size_t *count)
{
    uint32_t *found = exact(rc_variable_count(model), sizeof *found);
    *count = 0;
    for (uint32_t i = 0; i < rc_variable_count(model); ++i) {
        const rc_group *group = rc_group_of(model, i);
        if (group->type == RC_REAL && group->causality == causality)
            found[(*count)++] = i;
    }
    return found;
}

static void fuzz(school *at, unsigned long calls)
{
    while (at->calls < calls) {
        ++at->call;
        call_something(at, &at->pupils[draw_below(&at->draw, INSTANCES)]);
        if (draw_once_in(&at->draw, 500))
            spoil_tables(at);
    }
    leave_school(at);
}

static int fuzz_calls(school *at, unsigned long calls)
{
    char tables[TABLES][4096];
    at->variables = rc_variable_count(at->model);
    at->outputs = find(at->model, RC_OUTPUT, &at->output_count);
    at->inputs = find(at->model, RC_INPUT, &at->input_count);
    if (at->output_count > MOST_OUTPUTS)
        return 2;
    for (size_t i = 0; i < TABLES; ++i) {
        snprintf(tables[i], sizeof tables[i], "%s/table%zu.csv", at->scratch, i);
        at->tables[i] = tables[i];
    }
    spoil_tables(at);
    fuzz(at, calls);
    printf("%lu calls: %lu OK, %lu Discard, %lu Error\n", at->calls, at->answers[OK],
           at->answers[DISCARD], at->answers[ERROR]);
    free(at->outputs);
    free(at->inputs);
    return 0;
}

int main(int count, char **words)
{
    static school at;
    char message[RC_MESSAGE_SIZE];
    if (count != 7)
        return 2;
    const unsigned long calls = strtoul(words[3], NULL, 10);
    at.host = strcmp(words[1], "2") == 0   ? &host_fmi2
              : strcmp(words[1], "3") == 0 ? &host_fmi3
                                           : NULL;
    at.draw.state = at.seed = strtoull(words[2], NULL, 10);
    at.folder = words[4];
    at.token = words[5];
    at.scratch = words[6];
    size_t size;
    char *data = rc_read_resource(at.folder, "model.bin", &size, message, sizeof message);
    at.model = data == NULL ? NULL : rc_create(rc_library_class(), data, size, message);
    if (at.model == NULL) {
        fprintf(stderr, "%s\n", message);
        return 2;
    }
    const int result = at.host != NULL
                           ? fuzz_calls(&at, calls)
                           : fuzz_resources(at.seed, calls, (unsigned char *)data, size);
    rc_destroy(at.model);
    free(data);
    return result;
}
