/* The bodies above the contacts and their motion; twin of vehicle_fmu/suspension.py,
 * suspended_motion.py and bodies.py.
 *
 * Coordinates, downwards positive from static equilibrium: wheels, hubs, bogie bounce, bogie pitch,
 * car bounce, car pitch. Those that a vehicle has not stay at rest. */
#ifndef RC_SUSPENSION_H
#define RC_SUSPENSION_H

#include "instance.h"

/* Groups of parameters, in the order of the declaration, from wherever they begin. */
enum {
    RC_VEHICLE_KIND, RC_TREAD_MASS, RC_TREAD_STIFFNESS, RC_TREAD_DAMPING,
    RC_PRIMARY,
    RC_SECONDARY = RC_PRIMARY + 5,
    RC_BOGIE_MASS = RC_SECONDARY + 5,
    RC_BOGIE_PITCH_INERTIA, RC_CAR_MASS, RC_CAR_PITCH_INERTIA,
    RC_SUSPENSION_PARAMETER_COUNT
};

/* Groups of outputs likewise. */
enum {
    RC_BOGIE_DISPLACEMENT, RC_BOGIE_PITCH, RC_BOGIE_ACCELERATION,
    RC_CAR_DISPLACEMENT, RC_CAR_PITCH, RC_CAR_ACCELERATION,
    RC_PRIMARY_FORCE, RC_SECONDARY_FORCE,
    RC_BODY_OUTPUT_COUNT
};

#define RC_ELEMENT_PARAMETERS(first, name)                                                        \
    [(first)] = {name ".stiffness", RC_REAL, RC_PARAMETER, RC_ONE},                                \
    [(first) + 1] = {name ".damping", RC_REAL, RC_PARAMETER, RC_ONE},                              \
    [(first) + 2] = {name ".rebound_ratio", RC_REAL, RC_PARAMETER, RC_ONE},                        \
    [(first) + 3] = {name ".clearance", RC_REAL, RC_PARAMETER, RC_ONE},                            \
    [(first) + 4] = {name ".stop_stiffness", RC_REAL, RC_PARAMETER, RC_ONE}

#define RC_SUSPENSION_PARAMETERS(first)                                                           \
    [(first) + RC_VEHICLE_KIND] = {"model", RC_TEXT, RC_PARAMETER, RC_ONE},                        \
    [(first) + RC_TREAD_MASS] = {"tread.mass", RC_REAL, RC_PARAMETER, RC_ONE},                     \
    [(first) + RC_TREAD_STIFFNESS] = {"tread.stiffness", RC_REAL, RC_PARAMETER, RC_ONE},           \
    [(first) + RC_TREAD_DAMPING] = {"tread.damping", RC_REAL, RC_PARAMETER, RC_ONE},               \
    RC_ELEMENT_PARAMETERS((first) + RC_PRIMARY, "primary"),                                        \
    RC_ELEMENT_PARAMETERS((first) + RC_SECONDARY, "secondary"),                                    \
    [(first) + RC_BOGIE_MASS] = {"bogie[#].mass", RC_REAL, RC_PARAMETER, RC_BOGIES},               \
    [(first) + RC_BOGIE_PITCH_INERTIA] = {"bogie[#].pitch_inertia", RC_REAL, RC_PARAMETER,         \
                                          RC_BOGIES},                                              \
    [(first) + RC_CAR_MASS] = {"car.mass", RC_REAL, RC_PARAMETER, RC_ONE},                         \
    [(first) + RC_CAR_PITCH_INERTIA] = {"car.pitch_inertia", RC_REAL, RC_PARAMETER, RC_ONE}

#define RC_BODY_OUTPUTS(first)                                                                    \
    [(first) + RC_BOGIE_DISPLACEMENT] = {"bogie[#].displacement", RC_REAL, RC_OUTPUT, RC_BOGIES},  \
    [(first) + RC_BOGIE_PITCH] = {"bogie[#].pitch", RC_REAL, RC_OUTPUT, RC_BOGIES},                \
    [(first) + RC_BOGIE_ACCELERATION] = {"bogie[#].acceleration", RC_REAL, RC_OUTPUT, RC_BOGIES},  \
    [(first) + RC_CAR_DISPLACEMENT] = {"car.displacement", RC_REAL, RC_OUTPUT, RC_ONE},            \
    [(first) + RC_CAR_PITCH] = {"car.pitch", RC_REAL, RC_OUTPUT, RC_ONE},                          \
    [(first) + RC_CAR_ACCELERATION] = {"car.acceleration", RC_REAL, RC_OUTPUT, RC_ONE},            \
    [(first) + RC_PRIMARY_FORCE] = {"primary[#].force", RC_REAL, RC_OUTPUT, RC_WHEELS},            \
    [(first) + RC_SECONDARY_FORCE] = {"secondary[#].force", RC_REAL, RC_OUTPUT, RC_BOGIES}

typedef struct {
    double stiffness, compressing, extending, clearance, stop;
} rc_element;

typedef struct {
    size_t wheels, bogies, coordinates;
    int coupled;            /* 0: rigid masses under their loads, which need nothing of this */
    int flexible, suspended; /* whether there are hubs, and bodies above the wheels */
    rc_element tread, primary, secondary;
    double on_primary;    /* static force of a primary suspension */
    double *on_secondary; /* of every bogie */
    double *inverse_mass; /* of every coordinate; 0 where it rests */
    double *lever;        /* of every wheel ahead of its bogie's centre */
    double *bogie_lever;  /* of every bogie ahead of the car body's centre */
    double *work;         /* of a substep, or a sweep towards equilibrium */
    double *matrix;       /* of that sweep: stiffness, by rows of a stride */
    size_t *pivot;
} rc_suspension;

/* Coordinates of so many wheels and bogies. */
static inline size_t rc_coordinates(size_t wheels, size_t bogies)
{
    return 2 * (wheels + bogies + 1);
}

/* Claims memory for the sizes of the model. */
rc_status rc_open_suspension(rc_model *model, rc_suspension *own);
void rc_free_suspension(rc_suspension *own);

/* Takes the parameters of the model, whose groups begin at `first`; may be called again. `offsets`
 * are those of all wheels. A substep that does not resolve every element is refused. */
rc_status rc_make_suspension(rc_model *model, rc_suspension *own, size_t first, double wheel_mass,
                             double load, const double *offsets, double substep);

/* Of an element beyond its static force [N]. */
double rc_element_force(const rc_element *element, double compression, double rate);

/* The largest rate of an element between its bodies [1/s]. */
double rc_fastest(const rc_suspension *own);

/* Refuses a step that takes more substeps than any should. */
rc_status rc_check_substeps(rc_model *model, double step, double longest);

/* Into how many equal substeps, none above the longest, a duration is divided. */
size_t rc_substeps(double duration, double longest);

/* Static load minus contact force of every wheel at the k-th half substep of a step. */
typedef void rc_push(void *of, size_t k, const double *displacement, double *push);

/* Integrates coordinates and rates, in place, over a time in equal substeps. */
void rc_advance(const rc_suspension *own, double *q, double *v, double duration, size_t substeps,
                rc_push *push, void *of);

/* An output group, counted from the first; zeros for rigid masses. */
void rc_read_bodies(const rc_suspension *own, const double *q, const double *v, size_t group,
                    double *values);

#endif
