/* Saved states: a copy of the situation, with what tells a state of this model from anything else. */
#include <stdlib.h>
#include <string.h>

#include "fmi_common.h"

#define MAGIC "inertFMU"

typedef struct {
    char magic[8];
    char token[64];
    uint64_t kind;
    uint64_t sum;
    Situation situation;
} Saved;

/* FNV-1a */
static uint64_t sum_of(const Situation *situation) {
    const unsigned char *bytes = (const unsigned char *)situation;
    uint64_t sum = 14695981039346656037u;
    for (size_t i = 0; i < sizeof *situation; i++) sum = (sum ^ bytes[i]) * 1099511628211u;
    return sum;
}

static int is_ours(const Instance *c, const Saved *state) {
    return state && !memcmp(state->magic, MAGIC, sizeof state->magic) &&
           !strncmp(state->token, FMU_TOKEN, sizeof state->token) && state->kind == (uint64_t)c->kind &&
           state->sum == sum_of(&state->situation);
}

static Status foreign(Instance *c) {
    return face_refuse(c, "this is no saved state of this model and kind of instance");
}

static void discard(Saved *state) {
    memset(state, 0, sizeof state->magic);
    free(state);
}

Status FMI(GetFMUState)(void *instance, void **state) {
    ENTER(ANY_PHASE, EITHER);
    if (!state) return face_refuse(c, "there is nowhere to put the state");
    if (*state && !is_ours(c, *state)) return foreign(c);
    if (!*state) *state = calloc(1, sizeof(Saved));
    if (!*state) return face_refuse(c, "out of memory");
    Saved *saved = *state;
    memcpy(saved->magic, MAGIC, sizeof saved->magic);
    strncpy(saved->token, FMU_TOKEN, sizeof saved->token - 1);
    saved->kind = (uint64_t)c->kind;
    memcpy(&saved->situation, &c->now, sizeof c->now);
    saved->sum = sum_of(&saved->situation);
    return FMI(OK);
}

Status FMI(SetFMUState)(void *instance, void *state) {
    ENTER(ANY_PHASE, EITHER);
    if (!is_ours(c, state)) return foreign(c);
    memcpy(&c->now, &((const Saved *)state)->situation, sizeof c->now);
    return FMI(OK);
}

Status FMI(FreeFMUState)(void *instance, void **state) {
    ENTER(ANY_PHASE, EITHER);
    if (!state || !*state) return FMI(OK);
    if (!is_ours(c, *state)) return foreign(c);
    discard(*state);
    *state = NULL;
    return FMI(OK);
}

Status FMI(SerializedFMUStateSize)(void *instance, void *state, size_t *size) {
    ENTER(ANY_PHASE, EITHER);
    if (!size) return face_refuse(c, "there is nowhere to put the size");
    if (!is_ours(c, state)) return foreign(c);
    *size = sizeof(Saved);
    return FMI(OK);
}

Status FMI(SerializeFMUState)(void *instance, void *state, FMI(Byte) bytes[], size_t size) {
    ENTER(ANY_PHASE, EITHER);
    if (!is_ours(c, state)) return foreign(c);
    if (!bytes || size < sizeof(Saved)) return face_refuse(c, "the room for the state is too small");
    memcpy(bytes, state, sizeof(Saved));
    return FMI(OK);
}

Status FMI(DeserializeFMUState)(void *instance, const FMI(Byte) bytes[], size_t size, void **state) {
    ENTER(ANY_PHASE, EITHER);
    if (!state) return face_refuse(c, "there is nowhere to put the state");
    if ((*state && !is_ours(c, *state)) || !bytes || size < sizeof(Saved)) return foreign(c);
    Saved *copy = *state ? *state : calloc(1, sizeof *copy);
    if (!copy) return face_refuse(c, "out of memory");
    memcpy(copy, bytes, sizeof *copy);
    if (!is_ours(c, copy)) {
        discard(copy);
        *state = NULL;
        return foreign(c);
    }
    *state = copy;
    return FMI(OK);
}
