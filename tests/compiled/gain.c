/* y = gain * u, without memory. */

#include "model.h"

struct Model {
    double u, y, gain, slope;
};

const size_t model_size = sizeof(Model);
const Variable variables[] = {
    {FLOAT64, offsetof(Model, u), 1},
    {FLOAT64, offsetof(Model, y), 1},
    {FLOAT64, offsetof(Model, gain), 1},
};
const size_t variable_count = sizeof variables / sizeof *variables;

void model_reset(Model *m) { *m = (Model){.gain = 1.0}; }

Outcome model_start(Model *m) {
    model_evaluate(m);
    return OK;
}

void model_evaluate(Model *m) { m->y = m->gain * m->u; }

Result model_step(Model *m, Surroundings *around, double t, double h) {
    (void)around;
    m->u += m->slope * h;
    model_evaluate(m);
    return (Result){OK, .reached = t + h};
}

void model_restored(Model *m, const Model *before) { (void)m, (void)before; }

bool model_leaks(const Model *m) { (void)m; return false; }

bool model_set_slope(Model *m, size_t input, double slope) {
    m->slope = slope;
    return input == 0;
}

double model_derivative(const Model *m, size_t unknown, size_t j, size_t known, size_t i) {
    (void)j, (void)i;
    return unknown == 1 && known == 0 ? m->gain : 0.0;
}
