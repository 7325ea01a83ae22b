/* What a host needs of a model: variables, initialisation, steps, states, derivatives.
 *
 * A model is fed with one resource (binary.h) and driven in this order: rc_create, rc_set of
 * parameters and inputs, rc_enter_initialisation, rc_set of both, rc_exit_initialisation, then
 * steps. Memory is claimed by rc_create and during the initialisation alone (and by rc_restore of a
 * state with other parameters). Instances share nothing but the resource, which nobody changes.
 *
 * Every function that can fail leaves the model as it was and a sentence in rc_message; only
 * rc_restore of a state whose parameters cannot be used leaves it to be initialised again.
 */
#ifndef RC_MODEL_H
#define RC_MODEL_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define RC_API __declspec(dllexport)
#elif defined(__GNUC__)
#define RC_API __attribute__((visibility("default")))
#else
#define RC_API
#endif

#define RC_TEXT_SIZE 1024 /* bytes of a text parameter, its end included */
#define RC_MESSAGE_SIZE 2048

typedef enum {
    RC_OK = 0,
    RC_DISCARD = 1, /* nothing is wrong, but not with this step */
    RC_ERROR = 2
} rc_status;

typedef enum { RC_REAL, RC_INTEGER, RC_BOOLEAN, RC_TEXT } rc_type;
typedef enum { RC_CONSTANT, RC_PARAMETER, RC_INPUT, RC_OUTPUT } rc_causality;
typedef enum { RC_INSTANTIATED, RC_INITIALISING, RC_STEPPING } rc_phase;

/* Variables that differ by an index only. The number of a variable is `first` plus its index; it
 * is the value reference of the FMU and the place in the declaration that Python makes. */
typedef struct {
    const char *name; /* "wheel[#].position": # stands for the index */
    rc_type type;
    rc_causality causality;
    uint32_t first, count;
    uint32_t lowest; /* index in the name of the first one */
} rc_group;

typedef struct rc_model rc_model;
typedef struct rc_class rc_class;

/* The model that this library holds. */
RC_API const rc_class *rc_library_class(void);

/* Makes an instance with the start values of the resource; NULL and a sentence in `message`
 * (RC_MESSAGE_SIZE bytes) where that is impossible. `data` is not copied: it stays where it is,
 * unchanged and aligned to 8 bytes, until rc_destroy. */
RC_API rc_model *rc_create(const rc_class *kind, const void *data, size_t size, char *message);
RC_API void rc_destroy(rc_model *model);

/* Goes back to what rc_create made. */
RC_API void rc_reset(rc_model *model);

/* Why the last call failed; "" if none has. */
RC_API const char *rc_message(const rc_model *model);

/* What is doubtful about the last step though it was made; "" if nothing is. */
RC_API const char *rc_warning(const rc_model *model);
RC_API rc_phase rc_current_phase(const rc_model *model);
RC_API double rc_time(const rc_model *model);

RC_API uint32_t rc_variable_count(const rc_model *model);
RC_API size_t rc_group_count(const rc_model *model);
RC_API const rc_group *rc_group_at(const rc_model *model, size_t number);

/* The group of a variable, NULL if there is no such variable. */
RC_API const rc_group *rc_group_of(const rc_model *model, uint32_t variable);

/* Writes the name with its index and returns its length; nothing if it does not fit. */
RC_API size_t rc_name(const rc_model *model, uint32_t variable, char *name, size_t size);

/* Values of variables of one type; Integer and Boolean travel as whole numbers in double.
 * Parameters are fixed once the initialisation has ended, constants always. During it, outputs are
 * those of the equilibrium under the parameters and inputs set so far. */
RC_API rc_status rc_get(rc_model *model, rc_type type, const uint32_t *variables, size_t count,
                        double *values);
RC_API rc_status rc_set(rc_model *model, rc_type type, const uint32_t *variables, size_t count,
                        const double *values);
RC_API rc_status rc_get_text(rc_model *model, uint32_t variable, const char **text);
RC_API rc_status rc_set_text(rc_model *model, uint32_t variable, const char *text);

/* All values of a group at once. */
RC_API rc_status rc_get_group(rc_model *model, size_t group, double *values);
RC_API rc_status rc_set_group(rc_model *model, size_t group, const double *values);

RC_API rc_status rc_enter_initialisation(rc_model *model, double start_time);
RC_API rc_status rc_exit_initialisation(rc_model *model);

/* How the inputs run over a step: as the parameter linear_inputs says, from their values at its
 * start on, or on straight lines from the last values to the present ones. From their start on,
 * Track and Vehicle hold them; TrackContact and Masses continue them as they ran before. */
typedef enum { RC_AS_PARAMETER, RC_HELD, RC_STRAIGHT } rc_input_shape;

/* Moves on from `time` [s], where the model is, by `step` [s]. RC_DISCARD leaves everything as it
 * was. `reached` is where the model is afterwards (the last successful time). */
RC_API rc_status rc_step(rc_model *model, double time, double step, rc_input_shape shape,
                         double *reached);

/* Takes the inputs over without time passing, so that straight lines begin there. With it a host
 * gives inputs by value and slope: set the values, rc_jump, set the values at the end of the step,
 * rc_step with RC_STRAIGHT. */
RC_API rc_status rc_jump(rc_model *model);

/* The complete state is one block without pointers: a saved one is a copy of its bytes, good for
 * this instance or any other of the same resource in the same program. */
RC_API size_t rc_state_size(const rc_model *model);
RC_API void rc_save(const rc_model *model, void *state);
RC_API rc_status rc_restore(rc_model *model, const void *state);

/* The same with magic, version, identity of the resource and checksum around it. rc_deserialise
 * checks and writes a state for rc_restore; the model itself stays as it is. */
RC_API size_t rc_serialised_size(const rc_model *model);
RC_API void rc_serialise(const rc_model *model, const void *state, void *bytes);
RC_API rc_status rc_deserialise(rc_model *model, const void *bytes, size_t size, void *state);

/* sensitivity = d(unknowns)/d(knowns) seed, for Real outputs after the last step and Real inputs
 * as they were given for it (the interface Jacobian). Refused unless the last step succeeded and no
 * state was restored after it. By contact forces and rail displacements it is exact; by wheel
 * positions, over steps that the track divides, and for TrackContact it is a central difference with
 * some 8 good digits. */
RC_API rc_status rc_derivative(rc_model *model, const uint32_t *unknowns, size_t unknown_count,
                               const uint32_t *knowns, size_t known_count, const double *seed,
                               double *sensitivity);

#endif
