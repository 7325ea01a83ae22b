/* Lists of variables and values for a call, with faults in some of them. */
#ifndef FUZZ_REQUEST_H
#define FUZZ_REQUEST_H

#include "school.h"

typedef struct {
    list list;
    uint32_t *memory; /* of the variables, also where the FMU gets NULL */
    int faulty;       /* an array is missing or a number of values wrong: an error is due */
} request;

/* `count` variables of a type and of any of these causalities, most of the time; values are zeros. */
request make_request(school *at, rc_type type, const rc_causality *of, size_t causalities,
                     size_t count);
void free_request(request *made);

#endif
