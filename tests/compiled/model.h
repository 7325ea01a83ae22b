/* What a model gives to the FMI layer: a struct of variables, and what happens in a step. */

#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
    FLOAT64, FLOAT32, INT8, UINT8, INT16, UINT16, INT32, UINT32, INT64, UINT64, BOOLEAN
} Kind;

/* A variable: where it is in the struct; its value reference is its place in the table. */
typedef struct {
    Kind kind;
    size_t offset;
    size_t size;
} Variable;

typedef enum { OK, WARNING, DISCARD, ERROR, FATAL } Outcome;

/* How a step ended; `reached` is set where it did not get to its end. */
typedef struct {
    Outcome outcome;
    bool early;
    bool terminate;
    double reached;
    const char *message;
} Result;

/* What the FMI layer knows and a saved state does not hold. */
typedef struct {
    bool may_return_early;
    int calls_after_half;
} Surroundings;

/* All of the model: a saved state is a copy of it. */
typedef struct Model Model;

extern const size_t model_size;
extern const Variable variables[];
extern const size_t variable_count;

void model_reset(Model *model);
Outcome model_start(Model *model);
Result model_step(Model *model, Surroundings *around, double time, double step_size);
void model_evaluate(Model *model);
void model_restored(Model *model, const Model *before);
bool model_leaks(const Model *model);
bool model_set_slope(Model *model, size_t input, double slope);

/* What element j of `unknown` gains with element i of `known`. */
double model_derivative(const Model *model, size_t unknown, size_t j, size_t known, size_t i);
