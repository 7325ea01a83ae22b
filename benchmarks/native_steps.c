/* Times of a native track, with the contacts on its side or without: one update, an update repeated
 * with other forces or displacements, one with a step size never seen before, saving and restoring.
 * Prints nanoseconds, one figure a line. */
#include "program.h"

#define BATCHES 100u
#define ROUNDS 200u
#define STEP 20e-6 /* s */
#define SPEED 11.111111111111111
#define STATIC_LOAD 117720.0
#define HOP 1e-6 /* m */
#define MOST_WHEELS 64

typedef struct {
    rc_model *model;
    size_t position, pressed, result, wheels; /* pressed: by forces, or by displacements */
    double least, unit;                       /* of what it is pressed by */
    double positions[MOST_WHEELS], values[MOST_WHEELS], results[MOST_WHEELS], time;
    void *saved;
} run;

static void move(run *of, double step, unsigned int number)
{
    for (size_t i = 0; i < of->wheels; ++i) {
        of->positions[i] += SPEED * step;
        of->values[i] = of->least + of->unit * (double)((number + i) % 7);
    }
}

static void step(run *of, double size)
{
    double reached;
    rc_set_group(of->model, of->position, of->positions);
    rc_set_group(of->model, of->pressed, of->values);
    if (rc_step(of->model, of->time, size, RC_AS_PARAMETER, &reached) != RC_OK)
        fail(rc_message(of->model));
    rc_get_group(of->model, of->result, of->results);
}

/* One round of each kind; `number` makes it differ from the others. */
typedef void action(run *of, unsigned int number);

static void update(run *of, unsigned int number)
{
    move(of, STEP, number);
    step(of, STEP);
    of->time = rc_time(of->model);
}

static void repeat(run *of, unsigned int number)
{
    rc_restore(of->model, of->saved);
    of->values[0] = of->least + 1e-5 * of->unit * (double)number;
    step(of, STEP);
}

static void restore_and_save(run *of, unsigned int number)
{
    (void)number;
    rc_restore(of->model, of->saved);
    rc_save(of->model, of->saved);
}

static void take_new_step(run *of, unsigned int number)
{
    rc_restore(of->model, of->saved);
    step(of, STEP * (1.0 + 1e-6 * (double)(number + 1)));
}

/* The least time of many batches: what the program costs and not what disturbs it. */
static double measure(run *of, action *one)
{
    double least = 1e300;
    for (unsigned int batch = 0; batch < BATCHES; ++batch) {
        const double begin = now();
        for (unsigned int k = 0; k < ROUNDS; ++k)
            one(of, batch * ROUNDS + k);
        const double taken = (now() - begin) / ROUNDS;
        least = taken < least ? taken : least;
    }
    return least;
}

int main(int count, char **arguments)
{
    char message[RC_MESSAGE_SIZE];
    size_t size;
    if (count != 2)
        fail("give the resource of a track");
    void *data = read_resource(arguments[1], &size);
    run of = {.model = rc_create(rc_library_class(), data, size, message)};
    if (of.model == NULL)
        fail(message);
    of.position = find(of.model, "wheel[#].position");
    of.pressed = find(of.model, "wheel[#].contact_force");
    if (rc_group_at(of.model, of.pressed)->causality == RC_INPUT) {
        of.result = find(of.model, "wheel[#].rail_displacement");
        of.least = STATIC_LOAD;
        of.unit = 0.01 * STATIC_LOAD;
    } else {
        of.result = of.pressed;
        of.pressed = find(of.model, "wheel[#].displacement");
        of.unit = HOP;
    }
    of.wheels = rc_group_at(of.model, of.position)->count;
    const uint32_t linear = rc_variable_count(of.model) - 1;
    const double yes = 1.0;
    if (of.wheels > MOST_WHEELS || rc_set(of.model, RC_BOOLEAN, &linear, 1, &yes) != RC_OK)
        fail("this is no track for this program");
    rc_get_group(of.model, of.position, of.positions);
    rc_get_group(of.model, of.pressed, of.values);
    if (rc_enter_initialisation(of.model, 0.0) != RC_OK ||
        rc_exit_initialisation(of.model) != RC_OK)
        fail(rc_message(of.model));
    of.saved = malloc(rc_state_size(of.model));
    if (of.saved == NULL)
        fail("there is not enough memory");
    printf("update %.0f\n", measure(&of, update));
    rc_save(of.model, of.saved);
    move(&of, STEP, 0);
    printf("repeated %.0f\n", measure(&of, repeat));
    printf("restore_and_save %.0f\n", measure(&of, restore_and_save));
    printf("new_step_size %.0f\n", measure(&of, take_new_step));
    free(of.saved);
    rc_destroy(of.model);
    free(data);
    return 0;
}
