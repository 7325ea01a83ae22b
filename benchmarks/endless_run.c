/* Kilometres on a track with the contacts on its side, under masses that this program moves itself.
 * Prints what an update costs, the median over stretches of 6.5 m [ns of processor time], and the
 * memory of the process after a tenth and at the end [pages]. Linux. */
#include "program.h"

#define STEP 1e-4 /* s */
#define LOAD 117720.0
#define MASS 592.5
#define WHEELS 2
#define AXLE_BASE 1.8
#define STRETCH 6.5 /* m */

static void set(rc_model *model, const char *name, double value)
{
    if (rc_set_group(model, find(model, name), &value) != RC_OK)
        fail(rc_message(model));
}

static void name_file(rc_model *model, const char *name, const char *path)
{
    if (rc_set_text(model, rc_group_at(model, find(model, name))->first, path) != RC_OK)
        fail(rc_message(model));
}

static long memory(void)
{
    long all = 0, resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL || fscanf(file, "%ld %ld", &all, &resident) != 2)
        fail("the memory of the process is not told");
    fclose(file);
    return resident;
}

typedef struct {
    rc_model *model;
    size_t position, displacement, force;
    double x, speed, z[WHEELS], v[WHEELS], f[WHEELS], least, most;
} run;

static void place(const run *of, double *positions)
{
    for (size_t i = 0; i < WHEELS; ++i)
        positions[i] = of->x - AXLE_BASE * (double)i;
}

/* Masses by the velocity Verlet method; the track's step in between. */
static void step(run *of)
{
    double positions[WHEELS], before[WHEELS], reached;
    memcpy(before, of->f, sizeof before);
    of->x += of->speed * STEP;
    place(of, positions);
    for (size_t i = 0; i < WHEELS; ++i)
        of->z[i] += STEP * (of->v[i] + 0.5 * STEP * (LOAD - of->f[i]) / MASS);
    rc_set_group(of->model, of->position, positions);
    rc_set_group(of->model, of->displacement, of->z);
    if (rc_step(of->model, rc_time(of->model), STEP, RC_STRAIGHT, &reached) != RC_OK)
        fail(rc_message(of->model));
    rc_get_group(of->model, of->force, of->f);
    for (size_t i = 0; i < WHEELS; ++i) {
        of->v[i] += 0.5 * STEP * (2.0 * LOAD - before[i] - of->f[i]) / MASS;
        of->most = of->f[i] > of->most ? of->f[i] : of->most;
        of->least = of->f[i] < of->least ? of->f[i] : of->least;
    }
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Median cost of an update over all stretches. */
static double drive(run *of, size_t stretches, long *early)
{
    const size_t steps = (size_t)(STRETCH / of->speed / STEP);
    double *costs = calloc(stretches, sizeof *costs);
    if (costs == NULL)
        fail("there is not enough memory");
    for (size_t s = 0; s < stretches; ++s) {
        const double begin = now();
        for (size_t k = 0; k < steps; ++k)
            step(of);
        costs[s] = (now() - begin) / (double)steps;
        if (s == stretches / 10)
            *early = memory();
    }
    qsort(costs, stretches, sizeof *costs, compare);
    const double median = costs[stretches / 2];
    free(costs);
    return median;
}

int main(int count, char **arguments)
{
    char message[RC_MESSAGE_SIZE];
    size_t size;
    if (count != 7)
        fail("give the resource, a rail irregularity, a table of supports or nothing, whether "
             "endless, speed [m/s], distance [m]");
    void *data = read_resource(arguments[1], &size);
    run of = {.model = rc_create(rc_library_class(), data, size, message), .least = LOAD};
    if (of.model == NULL)
        fail(message);
    of.x = 12.7;
    of.speed = atof(arguments[5]);
    of.position = find(of.model, "wheel[#].position");
    of.displacement = find(of.model, "wheel[#].displacement");
    of.force = find(of.model, "wheel[#].contact_force");
    name_file(of.model, "rail_irregularity", arguments[2]);
    name_file(of.model, "supports", arguments[3]);
    set(of.model, "endless", atof(arguments[4]));
    set(of.model, "initial_speed", of.speed);
    set(of.model, "flat.depth", 0.5e-3);
    set(of.model, "flat.periodic", 1.0);
    double positions[WHEELS];
    place(&of, positions);
    rc_set_group(of.model, of.position, positions);
    if (rc_enter_initialisation(of.model, 0.0) != RC_OK ||
        rc_exit_initialisation(of.model) != RC_OK)
        fail(rc_message(of.model));
    rc_get_group(of.model, of.force, of.f);
    long early = 0;
    printf("update %.0f\n", drive(&of, (size_t)(atof(arguments[6]) / STRETCH), &early));
    printf("memory_early %ld\nmemory_late %ld\n", early, memory());
    printf("least_force %.0f\nlargest_force %.0f\nposition %.3f\n", of.least, of.most, of.x);
    rc_destroy(of.model);
    free(data);
    return 0;
}
