/* What the files of the FMI 2 face share. */
#ifndef INERTANCE_FMI2_FACE_H
#define INERTANCE_FMI2_FACE_H

#include "fmi_common.h"
#include "fmi2Functions.h"

#define ENTER(phases, kinds) \
    Instance *c = component; \
    if (!face_may(c, __func__, (phases), (kinds))) return fmi2Error

#define AS_FMI(status) ((fmi2Status)(status))
#define HERE __func__

#endif
