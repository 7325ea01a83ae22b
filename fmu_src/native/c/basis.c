#include "basis.h"

#include <math.h>

#include "rows.h"

enum { WHEELS, GAUGES, BAYS, ELEMENTS_PER_BAY, MODES, HALF, SLEEPER_SIZE, SEAT, SIZES };
enum { SPACING, SHEAR_PARAMETER, PAD_K, PAD_C, BALLAST_K, BALLAST_C, NUMBERS };

#define TINY 1e-12 /* lengths and stiffnesses are larger, in any unit */
#define MOST 1000000 /* more of anything is a damaged resource, and its square fits in a size_t */
#define MOST_OF_SLEEPER 1000 /* likewise of its degrees of freedom */

static int sizes_fit(const int64_t *size)
{
    for (size_t i = 0; i < SIZES; ++i)
        if (size[i] < 0 || size[i] > MOST)
            return 0;
    return size[WHEELS] >= 1 && size[BAYS] >= 2 && size[ELEMENTS_PER_BAY] >= 1 &&
           size[BAYS] * size[ELEMENTS_PER_BAY] <= MOST && size[MODES] >= 1 &&
           size[HALF] >= size[MODES] && size[HALF] % RC_LANES == 0 && size[SLEEPER_SIZE] >= 1 &&
           size[SLEEPER_SIZE] <= MOST_OF_SLEEPER && size[SEAT] < size[SLEEPER_SIZE];
}

/* Whether the numbers of a matrix are numbers, and above zero on the diagonal. */
static int is_inertia(const double *matrix, size_t size)
{
    for (size_t i = 0; i < size * size; ++i)
        if (!isfinite(matrix[i]) || (i % (size + 1) == 0 && !(matrix[i] > 0.0)))
            return 0;
    return 1;
}

/* What it takes to move a window: masses, the sleepers' bed, and all displacements. */
static rc_status read_motion(rc_model *model, rc_basis *basis)
{
    const size_t size = basis->sleeper_size, all = basis->supports * size;
    basis->bent_shape = basis->bent_flexibility = NULL;
    if ((basis->inertia = rc_require_section(model, "inertia", RC_INERTIA_COUNT)) == NULL ||
        (basis->sleeper_mass = rc_require_section(model, "sleeper_mass", size * size)) == NULL ||
        (basis->sleeper_bed = rc_require_section(model, "sleeper_bed", size * size)) == NULL ||
        (size > 1 &&
         ((basis->bent_shape = rc_require_section(model, "bent_shape", all * basis->length)) ==
              NULL ||
          (basis->bent_flexibility = rc_require_section(model, "bent_flexibility",
                                                        basis->coordinates * all)) == NULL)))
        return RC_ERROR;
    if (!is_inertia(basis->inertia, 4) || !is_inertia(basis->sleeper_mass, size) ||
        !is_inertia(basis->sleeper_bed, size))
        return rc_fail(model, RC_ERROR, "the resource describes a track without mass or ballast; "
                                        "build the FMU again");
    return RC_OK;
}

/* What is observed of the sleepers, which the resource has if they are beams. */
static rc_status read_sleepers(rc_model *model, rc_basis *basis)
{
    const size_t rows = 3 * basis->supports;
    size_t count;
    basis->sleeper_shape = basis->sleeper_flexibility = NULL;
    if (rc_find_section(&model->resource, "sleeper_shape", RC_FLOAT64, &count) == NULL)
        return RC_OK;
    if ((basis->sleeper_shape =
             rc_require_section(model, "sleeper_shape", rows * basis->length)) == NULL ||
        (basis->sleeper_flexibility = rc_require_section(model, "sleeper_flexibility",
                                                         rows * basis->coordinates)) == NULL)
        return RC_ERROR;
    return RC_OK;
}

rc_status rc_read_basis(rc_model *model, rc_basis *basis)
{
    size_t count;
    const int64_t *size = rc_find_section(&model->resource, "structure", RC_INT64, &count);
    if (size == NULL || count != SIZES || !sizes_fit(size))
        return rc_fail(model, RC_ERROR, "the resource does not say how large the track is; build "
                                        "the FMU again");
    const double *number = rc_require_section(model, "numbers", NUMBERS);
    if (number == NULL)
        return RC_ERROR;
    for (size_t i = 0; i < NUMBERS; ++i)
        if (!(isfinite(number[i]) && number[i] >= (i == PAD_C || i == BALLAST_C ? 0.0 : TINY)))
            return rc_fail(model, RC_ERROR, "the resource describes a track that cannot be (number "
                                            "%zu is %g); build the FMU again", i + 1, number[i]);
    basis->wheels = (size_t)size[WHEELS];
    basis->gauges = (size_t)size[GAUGES];
    basis->supports = (size_t)size[BAYS] - 1;
    basis->elements = (size_t)(size[BAYS] * size[ELEMENTS_PER_BAY]);
    basis->nodes = basis->elements + 1;
    basis->coordinates = 2 * (basis->nodes + basis->supports);
    basis->modes = (size_t)size[MODES];
    basis->half = (size_t)size[HALF];
    basis->length = 2 * basis->half;
    basis->sleeper_size = (size_t)size[SLEEPER_SIZE];
    basis->seat = (size_t)size[SEAT];
    basis->spacing = number[SPACING];
    basis->element_length = number[SPACING] / (double)size[ELEMENTS_PER_BAY];
    basis->track_length = (double)size[BAYS] * number[SPACING];
    basis->shear_parameter = number[SHEAR_PARAMETER];
    basis->pad_stiffness = number[PAD_K];
    basis->pad_damping = number[PAD_C];
    basis->ballast_stiffness = number[BALLAST_K];
    basis->ballast_damping = number[BALLAST_C];
    const size_t n = basis->coordinates, nodes = basis->nodes, length = basis->length;
    if ((basis->eigenvalues = rc_require_section(model, "eigenvalues", length)) == NULL ||
        (basis->inverses = rc_require_section(model, "inverses", length)) == NULL ||
        (basis->weight = rc_require_section(model, "weight", basis->half)) == NULL ||
        (basis->shape = rc_require_section(model, "shape", n * length)) == NULL ||
        (basis->moment_shape = rc_require_section(model, "moment_shape", nodes * length)) == NULL ||
        (basis->flexibility = rc_require_section(model, "flexibility", n * n)) == NULL ||
        (basis->moment_flexibility = rc_require_section(model, "moment_flexibility", nodes * n)) ==
            NULL ||
        read_motion(model, basis) != RC_OK)
        return RC_ERROR;
    return read_sleepers(model, basis);
}
