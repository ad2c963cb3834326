/* FMI 2.0.4, where the files of both standards say FMI(name): its names where they are not those of FMI 3. */
#ifndef INERTANCE_FMI_FACE_H
#define INERTANCE_FMI_FACE_H

#include "fmi2Functions.h"

#define FMI(name) fmi2##name
#define fmi2GetContinuousStateDerivatives fmi2GetDerivatives
#define fmi2GetFMUState fmi2GetFMUstate
#define fmi2SetFMUState fmi2SetFMUstate
#define fmi2FreeFMUState fmi2FreeFMUstate
#define fmi2SerializedFMUStateSize fmi2SerializedFMUstateSize
#define fmi2SerializeFMUState fmi2SerializeFMUstate
#define fmi2DeserializeFMUState fmi2DeSerializeFMUstate

/* Whom an instance talks to. */
typedef struct {
    fmi2CallbackFunctions callbacks;
    char *name;
} Host;

#endif
