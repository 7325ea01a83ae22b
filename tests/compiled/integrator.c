/* dx/dt = rate * u, y = x + gain * u, exact for u held over a step: little more than the calls. */

#include "model.h"

struct Model {
    double u, y, gain, rate, start;
    double x;
    bool moving;
};

enum { U, Y, GAIN, RATE, START };

const size_t model_size = sizeof(Model);
const Variable variables[] = {
    {FLOAT64, offsetof(Model, u), 1},     {FLOAT64, offsetof(Model, y), 1},
    {FLOAT64, offsetof(Model, gain), 1},  {FLOAT64, offsetof(Model, rate), 1},
    {FLOAT64, offsetof(Model, start), 1},
};
const size_t variable_count = sizeof variables / sizeof *variables;

void model_reset(Model *m) { *m = (Model){.rate = 1.0}; }

Outcome model_start(Model *m) {
    model_evaluate(m);
    return OK;
}

/* Only before the first step, without the input: then the output is that at the end of the last. */
void model_evaluate(Model *m) {
    if (!m->moving) m->x = m->y = m->start;
}

Result model_step(Model *m, Surroundings *around, double t, double h) {
    (void)around;
    m->x += h * m->rate * m->u;
    m->y = m->x + m->gain * m->u;
    m->moving = true;
    return (Result){OK, .reached = t + h};
}

void model_restored(Model *m, const Model *before) { (void)m, (void)before; }

bool model_leaks(const Model *m) { (void)m; return false; }

bool model_set_slope(Model *m, size_t input, double slope) {
    (void)m, (void)input, (void)slope;
    return false;
}

double model_derivative(const Model *m, size_t unknown, size_t j, size_t known, size_t i) {
    (void)j, (void)i;
    return unknown == Y && known == U ? m->gain : 0.0;
}
