#include "school.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tables.h"

void blame(const school *at, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "FMI %d, seed %llu, call %lu, %s: ", at->host->version,
            (unsigned long long)at->seed, at->call, at->doing);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    _Exit(1); /* nothing is freed */
}

void ask(school *at, pupil *of, const char *doing)
{
    at->doing = doing;
    of->ear = (ear){0};
}

void judge(school *at, pupil *of, answer given, unsigned right)
{
    static const char *const names[] = {"OK", "Warning", "Discard", "Error", "Fatal", "Pending"};
    ++at->calls;
    if (given > PENDING)
        blame(at, "the answer %d is none", (int)given);
    ++at->answers[given];
    if (of->fmu != NULL && of->is.tainted)
        right |= MAY_OK | MAY_DISCARD | MAY_ERROR | MAY_WARN;
    if (!(right & 1u << given))
        blame(at, "answered %s in phase %d (touched %d)", names[given], (int)of->is.phase,
              of->is.touched);
    if (of->ear.bad || of->ear.others > 0 || (!of->logger && of->ear.errors + of->ear.discards + of->ear.warnings > 0))
        blame(at, "the log has what does not belong there");
    if (of->fmu == NULL)
        return;
    if (of->ear.errors != (given == ERROR && of->logger && of->errors))
        blame(at, "%u errors in the log after %s", of->ear.errors, names[given]);
    if (of->ear.discards != (given == DISCARD && of->logger && of->discards))
        blame(at, "%u discards in the log after %s", of->ear.discards, names[given]);
    if (of->ear.warnings > (given == OK && of->warnings && (right & MAY_WARN)))
        blame(at, "%u warnings in the log after %s", of->ear.warnings, names[given]);
}

unsigned right_in(const pupil *of, unsigned phases)
{
    return of->fmu != NULL && (of->is.phase & phases) ? MAY_OK : MAY_ERROR;
}

int read_outputs(school *at, pupil *of, double *values)
{
    const list all = {.variables = at->outputs,
                      .count = at->output_count,
                      .values = values,
                      .said = at->output_count};
    ask(at, of, "reading the outputs");
    const answer given = at->host->get(of->fmu, RC_REAL, &all);
    judge(at, of, given, of->is.phase == INITIALISING && of->is.touched ? MAY_OK | MAY_ERROR : MAY_OK);
    if (given != OK)
        return 0;
    for (size_t i = 0; i < at->output_count; ++i)
        if (!isfinite(values[i]) && !of->is.tainted)
            blame(at, "output %lu is %g in phase %d", (unsigned long)at->outputs[i], values[i],
                  (int)of->is.phase);
    return 1;
}

int inputs_are_finite(school *at, pupil *of)
{
    double *values = exact(at->input_count, sizeof *values);
    const list all = {.variables = at->inputs,
                      .count = at->input_count,
                      .values = values,
                      .said = at->input_count};
    int finite = 1;
    ask(at, of, "reading the inputs");
    judge(at, of, at->host->get(of->fmu, RC_REAL, &all), MAY_OK);
    for (size_t i = 0; i < at->input_count; ++i)
        finite &= isfinite(values[i]) != 0;
    free(values);
    return finite;
}

void compare(school *at, pupil *of, const knowledge *with)
{
    double now[MOST_OUTPUTS];
    if (!with->known || with->tainted)
        return;
    if (with->touched && with->spoilt != at->spoilt)
        return; /* the tables that its parameters name are others now */
    if (!read_outputs(at, of, now))
        blame(at, "outputs that were known are so no more");
    for (size_t i = 0; i < at->output_count; ++i)
        if (memcmp(&now[i], &with->outputs[i], sizeof now[i]) != 0)
            blame(at, "output %lu is %.17g, it was %.17g", (unsigned long)at->outputs[i], now[i],
                  with->outputs[i]);
}

void spoil_tables(school *at)
{
    ++at->spoilt;
    for (size_t i = 0; i + 2 < TABLES; ++i) {
        if (draw_once_in(&at->draw, 8)) { /* none, for a while */
            (void)remove(at->tables[i]);
            continue;
        }
        FILE *file = fopen(at->tables[i], "wb");
        if (file == NULL)
            blame(at, "%s cannot be written", at->tables[i]);
        write_table(file, &at->draw, (table_kind)(i % TABLE_KINDS));
        fclose(file);
    }
}
