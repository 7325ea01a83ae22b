/* Instances come, are initialised, end and go; their logs are turned on and off. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "school.h"

/* A folder and whether it is the right one. */
static int choose_folder(school *at, char *path, size_t room)
{
    static const char *const wrong[] = {"none", "empty", "damaged", "truncated", "folder", "other"};
    if (!draw_once_in(&at->draw, 3)) {
        snprintf(path, room, "%s%s%s", draw_once_in(&at->draw, 3) ? "file://" : "", at->folder,
                 draw_once_in(&at->draw, 2) ? "/" : "");
        return 1;
    }
    snprintf(path, room, "%s/%s", at->scratch,
             wrong[draw_below(&at->draw, sizeof wrong / sizeof wrong[0])]);
    return 0;
}

static void enrol(school *at, pupil *of)
{
    char path[4096];
    draw *from = &at->draw;
    char *text = draw_text(from);
    int right = choose_folder(at, path, sizeof path);
    const char *name = "one", *token = at->token, *folder = path;
    if (draw_once_in(from, 8)) {
        name = draw_once_in(from, 2) ? NULL : text;
        right &= name != NULL && name[0] != '\0';
    }
    if (draw_once_in(from, 8)) {
        token = draw_once_in(from, 2) ? NULL : text;
        right = 0;
    }
    if (draw_once_in(from, 8)) {
        folder = draw_once_in(from, 2) ? NULL : text;
        right = 0;
    }
    *of = (pupil){.logger = !draw_once_in(from, 8), .early_return = draw_once_in(from, 2)};
    const int logging = draw_once_in(from, 2);
    of->errors = of->warnings = 1;
    of->discards = logging;
    ask(at, of, "instantiating");
    of->fmu = at->host->instantiate(name, token, folder, &of->ear, of->logger, logging,
                                    of->early_return);
    ++at->calls;
    if ((of->fmu != NULL) != right)
        blame(at, right ? "refused" : "made of '%.80s'", path);
    if (of->ear.bad || (of->fmu == NULL && of->ear.errors != (unsigned)of->logger))
        blame(at, "%u errors in the log", of->ear.errors);
    of->born = ++at->births;
    of->is.phase = CREATED;
    free(text);
}

/* Not without its states, most of the time. */
static void dismiss(school *at, pupil *of)
{
    for (size_t i = 0; i < STATES; ++i) {
        keepsake *kept = &at->states[i];
        if (kept->handle == NULL || kept->owner != of->born)
            continue;
        if (!draw_once_in(&at->draw, 4)) {
            ask(at, of, "freeing a state");
            judge(at, of, at->host->forget(of->fmu, &kept->handle), MAY_OK);
        }
        kept->handle = NULL;
    }
    at->doing = "freeing an instance";
    at->host->release(of->fmu);
    ++at->calls;
    *of = (pupil){0};
}

static void choose_log(school *at, pupil *of)
{
    static const char *const known[] = {"logStatusDiscard", "logStatusError",
                                        "logStatusWarning"};
    draw *from = &at->draw;
    char *text = draw_text(from);
    const size_t count = draw_below(from, 4);
    const int on = !draw_once_in(from, 3), missing = draw_once_in(from, 8);
    const char **names = exact(count, sizeof *names);
    int discards = count == 0, errors = count == 0, warnings = count == 0;
    unsigned right = right_in(of, ANY);
    for (size_t i = 0; i < count; ++i) {
        const size_t chosen = draw_below(from, 14);
        names[i] = chosen < 12 ? known[chosen % 3] : chosen == 12 ? NULL : text;
        discards |= chosen < 12 && chosen % 3 == 0;
        errors |= chosen < 12 && chosen % 3 == 1;
        warnings |= chosen < 12 && chosen % 3 == 2;
        if (chosen >= 12)
            right = MAY_ERROR;
    }
    if (missing && count > 0)
        right = MAY_ERROR;
    ask(at, of, "choosing the log");
    const answer given =
        at->host->choose_log(of->fmu, on, count, missing && count > 0 ? NULL : names);
    if (given == OK && of->fmu != NULL) {
        of->discards = discards ? on : of->discards;
        of->errors = errors ? on : of->errors;
        of->warnings = warnings ? on : of->warnings;
    }
    judge(at, of, given, right);
    free(names);
    free(text);
}

static void set_up_and_enter(school *at, pupil *of, double start, int has_stop, double stop)
{
    const int good = isfinite(start) && !(has_stop && !(stop >= start));
    unsigned right = right_in(of, CREATED);
    if (at->host->set_up != NULL && !draw_once_in(&at->draw, 8)) {
        ask(at, of, "setting the experiment up");
        const answer given = at->host->set_up(of->fmu, start, has_stop, stop);
        judge(at, of, given, good ? right : MAY_ERROR);
        if (given == OK)
            of->is.start = start;
    }
    if (at->host->set_up == NULL && !good)
        right = MAY_ERROR;
    ask(at, of, "entering the initialisation");
    const answer given = at->host->enter(of->fmu, start, has_stop, stop);
    judge(at, of, given, right == MAY_OK && of->is.touched ? MAY_OK | MAY_ERROR : right);
    if (given != OK)
        return;
    if (at->host->set_up == NULL)
        of->is.start = start;
    of->is.time = of->is.start;
    of->is.spoilt = at->spoilt;
    of->is.phase = INITIALISING;
}

static void leave_initialisation(school *at, pupil *of)
{
    double outputs[MOST_OUTPUTS];
    const unsigned right = right_in(of, INITIALISING);
    ask(at, of, "leaving the initialisation");
    const answer given = at->host->leave(of->fmu);
    judge(at, of, given, right == MAY_OK && of->is.touched ? MAY_OK | MAY_ERROR : right);
    if (given != OK)
        return;
    of->is.phase = STEPPING;
    (void)read_outputs(at, of, outputs);
}

static void end(school *at, pupil *of)
{
    ask(at, of, "terminating");
    const answer given = at->host->terminate(of->fmu);
    judge(at, of, given, right_in(of, STEPPING));
    if (given == OK)
        of->is.phase = TERMINATED;
}

static void reset(school *at, pupil *of)
{
    ask(at, of, "resetting");
    const answer given = at->host->reset(of->fmu);
    judge(at, of, given, right_in(of, ANY));
    if (given == OK)
        of->is = (knowledge){.phase = CREATED};
}

void call_start(school *at, pupil *of)
{
    if (of->fmu == NULL)
        enrol(at, of);
    if (of->fmu == NULL)
        return;
    if (of->is.phase != CREATED && draw_once_in(&at->draw, 20))
        reset(at, of);
    if (of->is.phase != CREATED)
        return;
    make_wishes(at, of);
    set_up_and_enter(at, of, draw_once_in(&at->draw, 2) ? 0.0 : draw_share(&at->draw), 0, 0.0);
    if (of->is.phase != INITIALISING)
        return;
    for (size_t i = 1 + draw_below(&at->draw, 3); i > 0; --i)
        call_values(at, of);
    leave_initialisation(at, of);
}

void call_life(school *at, pupil *of)
{
    draw *from = &at->draw;
    if (of->fmu == NULL && !draw_once_in(from, 4)) {
        enrol(at, of);
        return;
    }
    switch (draw_below(from, 12)) {
    case 0:
        if (of->fmu != NULL)
            dismiss(at, of);
        break;
    case 1:
        end(at, of);
        break;
    case 2:
        reset(at, of);
        break;
    case 3:
    case 4:
        set_up_and_enter(at, of, draw_near(from, 0.1), draw_once_in(from, 2), draw_near(from, 1.0));
        break;
    case 5:
    case 6:
        leave_initialisation(at, of);
        break;
    case 7:
        choose_log(at, of);
        break;
    default: {
        unsigned right;
        ask(at, of, "a call of this version alone");
        const answer given = at->host->odd(of->fmu, from, &right);
        judge(at, of, given, right);
    }
    }
}

void leave_school(school *at)
{
    for (size_t i = 0; i < INSTANCES; ++i)
        if (at->pupils[i].fmu != NULL)
            dismiss(at, &at->pupils[i]);
}
