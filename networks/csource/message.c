/* Words, without stdio. */
#include <math.h>
#include <string.h>

#include "core_state.h"

#define DIGITS 9

const char *core_message(const Core *c) { return c->message; }

void core_say(Core *c, const char *text) {
    c->message[0] = '\0';
    core_say_more(c, text);
}

void core_say_more(Core *c, const char *text) {
    size_t used = strlen(c->message), count = strlen(text);
    if (count > MESSAGE - 1 - used) count = MESSAGE - 1 - used;
    memcpy(c->message + used, text, count);
    c->message[used + count] = '\0';
}

static void say_integer(Core *c, int value) {
    char text[16];
    int place = 15;
    unsigned left = value < 0 ? 0u - (unsigned)value : (unsigned)value;
    text[place] = '\0';
    do text[--place] = (char)('0' + left % 10);
    while (left /= 10);
    if (value < 0) text[--place] = '-';
    core_say_more(c, text + place);
}

/* Nine digits, as %.9g would. */
void core_say_number(Core *c, double value) {
    char text[DIGITS + 4];
    int exponent, last, place = 0, i;
    double left;
    if (isnan(value)) {
        core_say_more(c, "nan");
        return;
    }
    if (value < 0) core_say_more(c, "-");
    value = fabs(value);
    if (isinf(value)) {
        core_say_more(c, "inf");
        return;
    }
    if (value == 0) {
        core_say_more(c, "0");
        return;
    }
    exponent = (int)floor(log10(value));
    left = floor(value / pow(10.0, exponent - DIGITS + 1) + 0.5);
    if (left >= 1e9) {
        left /= 10;
        exponent++;
    }
    char digits[DIGITS + 1];
    for (i = DIGITS - 1; i >= 0; i--) {
        digits[i] = (char)('0' + (int)fmod(left, 10.0));
        left = floor(left / 10);
    }
    for (last = DIGITS - 1; last > 0 && digits[last] == '0'; last--) {}
    if (exponent < -4 || exponent >= DIGITS) {
        text[place++] = digits[0];
        if (last) text[place++] = '.';
        for (i = 1; i <= last; i++) text[place++] = digits[i];
        text[place] = '\0';
        core_say_more(c, text);
        core_say_more(c, "e");
        say_integer(c, exponent);
        return;
    }
    if (exponent < 0) {
        core_say_more(c, "0.");
        for (i = -1; i > exponent; i--) core_say_more(c, "0");
    }
    for (i = 0; i <= (last > exponent ? last : exponent); i++) {
        text[place++] = i <= last ? digits[i] : '0';
        if (i == exponent && last > i) text[place++] = '.';
    }
    text[place] = '\0';
    core_say_more(c, text);
}
