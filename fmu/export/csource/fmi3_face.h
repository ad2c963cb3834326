/* FMI 3.0.1, where the files of both standards say FMI(name). */
#ifndef INERTANCE_FMI_FACE_H
#define INERTANCE_FMI_FACE_H

#include "fmi3Functions.h"

#define FMI(name) fmi3##name

/* Whom an instance talks to. */
typedef struct {
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
    fmi3IntermediateUpdateCallback update;
} Host;

#endif
