/* Loads the library of an FMI 3.0 FMU on Windows, runs it as Co-Simulation, and prints one variable after
 * each step: windows.exe LIBRARY TOKEN REFERENCE STEP COUNT */
#include <stdio.h>
#include <stdlib.h>
#include <windows.h>

#include "fmi3FunctionTypes.h"

#define LOAD(name) \
    fmi3##name##TYPE *name = (fmi3##name##TYPE *)(void (*)(void))GetProcAddress(library, "fmi3" #name)

int main(int count, char **given) {
    HMODULE library = count > 5 ? LoadLibraryA(given[1]) : NULL;
    if (!library) return 1;
    LOAD(InstantiateCoSimulation);
    LOAD(EnterInitializationMode);
    LOAD(ExitInitializationMode);
    LOAD(DoStep);
    LOAD(GetFloat64);
    LOAD(Terminate);
    LOAD(FreeInstance);
    fmi3ValueReference reference = (fmi3ValueReference)atoi(given[3]);
    double step = atof(given[4]), value, reached;
    bool event, end, early;
    fmi3Instance it =
        InstantiateCoSimulation("it", given[2], NULL, false, false, false, false, NULL, 0, NULL, NULL, NULL);
    if (!it) return 2;
    if (EnterInitializationMode(it, true, 1e-6, 0, false, 0) || ExitInitializationMode(it)) return 3;
    for (int k = 0; k < atoi(given[5]); k++) {
        if (DoStep(it, k * step, step, true, &event, &end, &early, &reached)) return 4;
        if (GetFloat64(it, &reference, 1, &value, 1)) return 5;
        printf("%.17g\n", value);
    }
    if (Terminate(it)) return 6;
    FreeInstance(it);
    return 0;
}
