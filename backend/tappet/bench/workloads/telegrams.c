#include <stdint.h>
#include <string.h>
double result;
typedef struct { char text[256]; } String;
static const char *const keys[4] = {"ADR=", "NET=", "TARE=", "STATE="};
static const char *const weights[4] = {"01234.56", "00099.20", "20000.00", "00815.47"};
static String telegram, body, field;
static int16_t start, stop;
static uint32_t n;
static int16_t len(const char *s) {
    int16_t i = 0;
    while (i < 255 && s[i] != 0) i++;
    return i;
}
static int16_t find(const char *s, const char *pattern) {
    int16_t text = len(s), count = len(pattern);
    if (count == 0) return 0;
    for (int16_t i = 0; i <= text - count; i++) {
        int16_t j = 0;
        while (j < count && s[i + j] == pattern[j]) j++;
        if (j == count) return i + 1;
    }
    return 0;
}
static String mid(const char *s, int16_t count, int16_t from) {
    String out;
    int16_t length = len(s), taken = 0;
    if (count >= 1 && from >= 1 && from <= length) {
        taken = count < length - from + 1 ? count : length - from + 1;
        for (int16_t i = 0; i < taken; i++) out.text[i] = s[from - 1 + i];
    }
    out.text[taken] = 0;
    return out;
}
static String left(const char *s, int16_t count) { return mid(s, count, 1); }
static String concat(const char *a, const char *b) {
    String out;
    int16_t length = 0, i = 0;
    while (length < 255 && a[length] != 0) {
        out.text[length] = a[length];
        length++;
    }
    while (length < 255 && b[i] != 0) out.text[length++] = b[i++];
    out.text[length] = 0;
    return out;
}
static uint8_t checksum(const char *s, int16_t count) {
    uint8_t sum = 0;
    for (int16_t i = 0; i < count; i++) sum ^= (uint8_t)s[i];
    return sum;
}
static int32_t digits(const char *s) {
    int32_t value = 0;
    for (int16_t i = 0; s[i] != 0; i++)
        if (s[i] >= '0' && s[i] <= '9') value = value * 10 + s[i] - '0';
    return value;
}
void cycle(void) {
    n++;
    telegram = concat("<ADR=07;NET=", weights[n % 4]);
    telegram = concat(telegram.text, ";TARE=");
    telegram = concat(telegram.text, weights[(n + 1) % 4]);
    telegram = concat(telegram.text, ";STATE=3;>*");
    stop = find(telegram.text, "*");
    uint8_t check = checksum(telegram.text, stop);
    body = mid(telegram.text, stop - 2, 2);
    for (int key = 0; key < 4; key++) {
        start = find(body.text, keys[key]);
        if (start > 0) {
            field = mid(body.text, 255, start + len(keys[key]));
            stop = find(field.text, ";");
            field = left(field.text, stop - 1);
            result += digits(field.text);
        }
    }
    result += check;
}
