/* Arrays and every type of number of FMI 3.0: y = gain * (u, w), and an echo of each parameter. */

#include "model.h"

enum { ROWS = 2, COLUMNS = 3 };

struct Model {
    double u[COLUMNS], y[ROWS], gain[ROWS * COLUMNS];
    float w, z;
    int8_t i8, o8;
    uint8_t u8, p8;
    int16_t i16, o16;
    uint16_t u16, p16;
    int32_t i32, o32;
    uint32_t u32, p32;
    int64_t i64, o64;
    uint64_t u64, p64;
    bool flags[2], mirror[2];
};

#define AT(name, kind, size) {kind, offsetof(Model, name), size}

const size_t model_size = sizeof(Model);
const Variable variables[] = {
    AT(u, FLOAT64, COLUMNS), AT(y, FLOAT64, ROWS), AT(gain, FLOAT64, ROWS *COLUMNS),
    AT(w, FLOAT32, 1),       AT(z, FLOAT32, 1),
    AT(i8, INT8, 1),         AT(o8, INT8, 1),
    AT(u8, UINT8, 1),        AT(p8, UINT8, 1),
    AT(i16, INT16, 1),       AT(o16, INT16, 1),
    AT(u16, UINT16, 1),      AT(p16, UINT16, 1),
    AT(i32, INT32, 1),       AT(o32, INT32, 1),
    AT(u32, UINT32, 1),      AT(p32, UINT32, 1),
    AT(i64, INT64, 1),       AT(o64, INT64, 1),
    AT(u64, UINT64, 1),      AT(p64, UINT64, 1),
    AT(flags, BOOLEAN, 2),   AT(mirror, BOOLEAN, 2),
};
const size_t variable_count = sizeof variables / sizeof *variables;

void model_reset(Model *m) {
    *m = (Model){.gain = {1, 2, 3, 4, 5, 6}, .u = {10, 20, 30}};
}

Outcome model_start(Model *m) {
    model_evaluate(m);
    return OK;
}

void model_evaluate(Model *m) {
    for (int row = 0; row < ROWS; row++) {
        m->y[row] = 0.0;
        for (int n = 0; n < COLUMNS; n++) m->y[row] += m->gain[COLUMNS * row + n] * m->u[n];
    }
    m->z = 2.0f * m->w;
    m->o8 = m->i8, m->p8 = m->u8, m->o16 = m->i16, m->p16 = m->u16;
    m->o32 = m->i32, m->p32 = m->u32, m->o64 = m->i64, m->p64 = m->u64;
    m->mirror[0] = m->flags[1], m->mirror[1] = m->flags[0];
}

Result model_step(Model *m, Surroundings *around, double t, double h) {
    (void)around;
    model_evaluate(m);
    return (Result){OK, .reached = t + h};
}

void model_restored(Model *m, const Model *before) { (void)m, (void)before; }

bool model_leaks(const Model *m) { (void)m; return false; }

bool model_set_slope(Model *m, size_t input, double slope) {
    (void)m, (void)input, (void)slope;
    return false;
}

double model_derivative(const Model *m, size_t unknown, size_t j, size_t known, size_t i) {
    if (unknown == 1 && known == 0) return m->gain[COLUMNS * j + i];
    return unknown == 4 && known == 3 ? 2.0 : 0.0;
}
