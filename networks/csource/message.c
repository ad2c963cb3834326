/* Words, without stdio. */
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "core_state.h"

#define DIGITS 9

const char *core_message(const Core *c) { return c->message; }

static void put_text(Core *c, const char *text, size_t count) {
    size_t used = strlen(c->message);
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
    put_text(c, text + place, (size_t)(15 - place));
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
    put_text(c, digits, 1);
    if (last) put_text(c, ".", 1);
    put_text(c, digits + 1, (size_t)last);
    put_text(c, "e", 1);
    say_integer(c, exponent);
}

static void say_with_point(Core *c, const char digits[], int last, int exponent) {
    if (exponent < 0) put_text(c, "0.", 2);
    for (int i = -1; i > exponent; i--) put_text(c, "0", 1);
    for (int i = 0; i <= (last > exponent ? last : exponent); i++) {
        put_text(c, i <= last ? digits + i : "0", 1);
        if (i == exponent && last > i) put_text(c, ".", 1);
    }
}

/* Nine digits, as %.9g would. */
static void say_number(Core *c, double value) {
    char digits[DIGITS];
    int last = DIGITS - 1;
    const char *word = isnan(value) ? "nan" : isinf(value) ? "inf" : value == 0 ? "0" : 0;
    if (value < 0) put_text(c, "-", 1);
    if (word) {
        put_text(c, word, strlen(word));
        return;
    }
    int exponent = leading_digits(fabs(value), digits);
    while (last > 0 && digits[last] == '0') last--;
    if (exponent < -4 || exponent >= DIGITS) say_with_exponent(c, digits, last, exponent);
    else say_with_point(c, digits, last, exponent);
}

/* A text in which %s and %g stand for what follows. */
static void say_all(Core *c, const char *format, va_list more) {
    for (;; format++) {
        size_t plain = strcspn(format, "%");
        put_text(c, format, plain);
        format += plain;
        if (!*format) return;
        if (*++format == 'g') say_number(c, va_arg(more, double));
        else {
            const char *text = va_arg(more, const char *);
            put_text(c, text, strlen(text));
        }
    }
}

void core_say_more(Core *c, const char *format, ...) {
    va_list more;
    va_start(more, format);
    say_all(c, format, more);
    va_end(more);
}

/* Say anew what went wrong; return the status. */
CoreStatus core_fail(Core *c, CoreStatus status, const char *format, ...) {
    va_list more;
    c->message[0] = '\0';
    va_start(more, format);
    say_all(c, format, more);
    va_end(more);
    return status;
}
