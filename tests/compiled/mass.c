/* A mass, exact for a force on a straight line; `trouble` makes it misbehave. */

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "model.h"

struct Model {
    double force, x, v, a, mass;
    int32_t steps, trouble;
    bool moving, linear_inputs;
    double last_force, slope;
};

enum { FORCE, X, V, A, MASS };

const size_t model_size = sizeof(Model);
const Variable variables[] = {
    {FLOAT64, offsetof(Model, force), 1}, {FLOAT64, offsetof(Model, x), 1},
    {FLOAT64, offsetof(Model, v), 1},     {FLOAT64, offsetof(Model, a), 1},
    {FLOAT64, offsetof(Model, mass), 1},  {INT32, offsetof(Model, steps), 1},
    {INT32, offsetof(Model, trouble), 1}, {BOOLEAN, offsetof(Model, moving), 1},
    {BOOLEAN, offsetof(Model, linear_inputs), 1},
};
const size_t variable_count = sizeof variables / sizeof *variables;

void model_reset(Model *m) { *m = (Model){.x = 1.0, .mass = 1.0}; }

/* Only before the first step: then the acceleration is that at the end of the last one. */
void model_evaluate(Model *m) {
    if (!m->moving) m->a = m->force / m->mass;
}

Outcome model_start(Model *m) {
    m->last_force = m->force;
    return m->trouble == 3 ? ERROR : OK;
}

static void move(Model *m, double h) {
    double start = m->force, end = m->force;
    if (m->slope != 0.0) end += m->slope * h;
    else if (m->linear_inputs) start = m->last_force;
    m->x += h * m->v + h * h * (2.0 * start + end) / (6.0 * m->mass);
    m->v += h * (start + end) / (2.0 * m->mass);
    m->a = end / m->mass;
    m->last_force = end;
    m->steps += 1;
    m->moving = true;
}

static Result misbehave(Model *m, Surroundings *around) {
    volatile int *nowhere = NULL;
    bool again = around->calls_after_half++ > 0;
    switch (m->trouble) {
        case 2: return (Result){FATAL, .message = "broken axle"};
        case 5: abort();
        case 6: *nowhere = 1; break;
        case 7: _exit(7);
        case 8: sleep(3600); break;
        case 9: m->x = NAN; break;
        case 12: if (!again) return (Result){ERROR, .message = "loose bolt"}; break;
        case 13: return (Result){ERROR, .message = "lost bolt"};
    }
    return (Result){OK};
}

Result model_step(Model *m, Surroundings *around, double t, double h) {
    double stop = 0.25 * floor(t / 0.25 + 1.0 + 1e-9);
    if (m->trouble == 1 && h > 0.015)
        return (Result){DISCARD, .reached = t, .message = "the step is too long"};
    if (m->trouble == 11 && h > 0.015)
        return (Result){DISCARD, .reached = t + 0.01, .message = "not that far"};
    if (m->trouble == 14 && around->may_return_early && t + h > stop + 1e-9) {
        move(m, stop - t);
        return (Result){OK, .early = true, .reached = stop};
    }
    if (m->trouble == 15 && t + h > 0.5 + 1e-9)
        return (Result){DISCARD, .terminate = true, .reached = 0.5, .message = "it is over"};
    if (t > 0.5) {
        Result result = misbehave(m, around);
        if (result.outcome != OK) return result;
    }
    if (m->trouble != 9 || t <= 0.5) move(m, h);
    return (Result){OK, .reached = t + h};
}

void model_restored(Model *m, const Model *before) {
    if (m->trouble == 4) m->v = before->v;
}

bool model_leaks(const Model *m) { return m->trouble == 10; }

bool model_set_slope(Model *m, size_t input, double slope) {
    m->slope = slope;
    return input == FORCE;
}

double model_derivative(const Model *m, size_t unknown, size_t j, size_t known, size_t i) {
    (void)j, (void)i;
    return unknown == A && known == FORCE ? 1.0 / m->mass : 0.0;
}
