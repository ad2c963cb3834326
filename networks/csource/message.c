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

/* The first nine digits of a number above zero. Returns the exponent of ten that belongs to the first. */
static int leading_digits(double value, char digits[]) {
    int exponent = (int)floor(log10(value));
    double left = floor(value / pow(10.0, exponent - DIGITS + 1) + 0.5);
    if (left >= 1e9) {
        left /= 10;
        exponent++;
    }
    for (int i = DIGITS - 1; i >= 0; i--) {
        digits[i] = (char)('0' + (int)fmod(left, 10.0));
        left = floor(left / 10);
    }
    return exponent;
}

static void say_with_exponent(Core *c, const char digits[], int last, int exponent) {
    char text[DIGITS + 2] = {digits[0], last ? '.' : '\0'};
    if (last) memcpy(text + 2, digits + 1, (size_t)last);
    core_say_more(c, text);
    core_say_more(c, "e");
    say_integer(c, exponent);
}

static void say_with_point(Core *c, const char digits[], int last, int exponent) {
    char text[DIGITS + 4];
    int place = 0;
    if (exponent < 0) core_say_more(c, "0.");
    for (int i = -1; i > exponent; i--) core_say_more(c, "0");
    for (int i = 0; i <= (last > exponent ? last : exponent); i++) {
        text[place++] = i <= last ? digits[i] : '0';
        if (i == exponent && last > i) text[place++] = '.';
    }
    text[place] = '\0';
    core_say_more(c, text);
}

/* Nine digits, as %.9g would. */
void core_say_number(Core *c, double value) {
    char digits[DIGITS];
    int exponent, last = DIGITS - 1;
    const char *word = isnan(value) ? "nan" : isinf(value) ? "inf" : value == 0 ? "0" : 0;
    if (value < 0) core_say_more(c, "-");
    if (word) {
        core_say_more(c, word);
        return;
    }
    exponent = leading_digits(fabs(value), digits);
    while (last > 0 && digits[last] == '0') last--;
    if (exponent < -4 || exponent >= DIGITS) say_with_exponent(c, digits, last, exponent);
    else say_with_point(c, digits, last, exponent);
}

/* The beginning of a message of what does not go on here. */
void core_say_when(Core *c) {
    core_say(c, "at t = ");
    core_say_number(c, c->t);
    core_say_more(c, " s ");
}
