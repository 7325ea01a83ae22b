#include "continuation.h"

#include <string.h>

void rc_begin_history(const rc_history *history, const double *value, const double *rate,
                      double age)
{
    for (size_t k = 0; k < history->count; ++k) {
        history->newest[k] = value[k];
        history->second[k] = value[k] - age * rate[k];
        history->third[k] = value[k] - 2.0 * age * rate[k];
    }
    history->ages[0] = age;
    history->ages[1] = 2.0 * age;
}

void rc_remember(const rc_history *history, const double *value, double passed)
{
    const size_t bytes = history->count * sizeof(double);
    memcpy(history->third, history->second, bytes);
    memcpy(history->second, history->newest, bytes);
    memcpy(history->newest, value, bytes);
    history->ages[1] = history->ages[0] + passed;
    history->ages[0] = passed;
}

void rc_continue(const rc_history *history, double ahead, double *value)
{
    const double first_age = history->ages[0], second_age = history->ages[1];
    for (size_t k = 0; k < history->count; ++k) {
        const double newest = history->newest[k], second = history->second[k];
        const double slope = (newest - second) / first_age;
        const double earlier = (second - history->third[k]) / (second_age - first_age);
        const double bend = (slope - earlier) / second_age;
        value[k] = newest + ahead * (slope + (ahead + first_age) * bend);
    }
}
