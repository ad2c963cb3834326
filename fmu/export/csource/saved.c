/* Saved states: a copy of the situation, with what tells a state of this model from anything else. */
#include <stdlib.h>
#include <string.h>

#include "fmi_common.h"

#define MAGIC "inertFMU"

struct Saved {
    char magic[8];
    char token[64];
    uint64_t kind;
    uint64_t sum;
    Situation situation;
};

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

static FaceStatus foreign(Instance *c, const char *function) {
    return face_refuse(c, function, "this is no saved state of this model and kind of instance");
}

FaceStatus face_save(Instance *c, const char *function, Saved **state) {
    if (!state) return face_refuse(c, function, "there is nowhere to put the state");
    if (*state && !is_ours(c, *state)) return foreign(c, function);
    if (!*state) *state = calloc(1, sizeof **state);
    if (!*state) return face_refuse(c, function, "out of memory");
    memcpy((*state)->magic, MAGIC, sizeof(*state)->magic);
    strncpy((*state)->token, FMU_TOKEN, sizeof(*state)->token - 1);
    (*state)->kind = (uint64_t)c->kind;
    memcpy(&(*state)->situation, &c->now, sizeof c->now);
    (*state)->sum = sum_of(&(*state)->situation);
    return FACE_OK;
}

FaceStatus face_restore(Instance *c, const char *function, const Saved *state) {
    if (!is_ours(c, state)) return foreign(c, function);
    memcpy(&c->now, &state->situation, sizeof c->now);
    return FACE_OK;
}

FaceStatus face_forget(Instance *c, const char *function, Saved **state) {
    if (!state || !*state) return FACE_OK;
    if (!is_ours(c, *state)) return foreign(c, function);
    memset(*state, 0, sizeof(*state)->magic);
    free(*state);
    *state = NULL;
    return FACE_OK;
}

FaceStatus face_saved_size(Instance *c, const char *function, const Saved *state, size_t *size) {
    if (!size) return face_refuse(c, function, "there is nowhere to put the size");
    if (!is_ours(c, state)) return foreign(c, function);
    *size = sizeof *state;
    return FACE_OK;
}

FaceStatus face_serialize(Instance *c, const char *function, const Saved *state, void *bytes, size_t size) {
    if (!is_ours(c, state)) return foreign(c, function);
    if (!bytes || size < sizeof *state)
        return face_refuse(c, function, "the room for the state is too small");
    memcpy(bytes, state, sizeof *state);
    return FACE_OK;
}

FaceStatus face_deserialize(Instance *c, const char *function, const void *bytes, size_t size,
                            Saved **state) {
    Saved *copy;
    if (!state) return face_refuse(c, function, "there is nowhere to put the state");
    if (*state && !is_ours(c, *state)) return foreign(c, function);
    if (!bytes || size < sizeof *copy) return foreign(c, function);
    copy = *state ? *state : calloc(1, sizeof *copy);
    if (!copy) return face_refuse(c, function, "out of memory");
    memcpy(copy, bytes, sizeof *copy);
    if (!is_ours(c, copy)) {
        memset(copy, 0, sizeof copy->magic);
        free(copy);
        *state = NULL;
        return foreign(c, function);
    }
    *state = copy;
    return FACE_OK;
}
