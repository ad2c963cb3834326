/* What the files of the FMI 3 face share. */
#ifndef INERTANCE_FMI3_FACE_H
#define INERTANCE_FMI3_FACE_H

#include "fmi_common.h"
#include "fmi3Functions.h"

#define ENTER(phases, kinds) \
    Instance *c = instance;  \
    if (!face_may(c, __func__, (phases), (kinds))) return fmi3Error

#define AS_FMI(status) ((fmi3Status)(status))
#define HERE __func__
#define SETTABLE (INSTANTIATED | INITIALIZATION | RUNNING)

#endif
