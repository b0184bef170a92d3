#include <stdint.h>
#include <string.h>
double result;
static char telegram[256], part[256] = "axis=17;pos=123.456;", end_[256] = "#done";
static int32_t total;
static int32_t length(char *s) {
    int32_t n = 0;
    while (s[n] != 0) n++;
    return n;
}
static int32_t append(char *s, char *t) {
    int32_t n = length(s), i = 0;
    while (n < 255 && t[i] != 0) {
        s[n] = t[i];
        n++;
        i++;
    }
    s[n] = 0;
    return n;
}
static int32_t find(char *s, uint8_t b) {
    int32_t i = 0;
    while (s[i] != 0) {
        if ((uint8_t)s[i] == b) return i + 1;
        i++;
    }
    return 0;
}
void cycle(void) {
    for (int32_t i = 1; i <= 20; i++) {
        strcpy(telegram, "STX:");
        append(telegram, part);
        append(telegram, part);
        append(telegram, part);
        append(telegram, end_);
        total += find(telegram, 35) + length(telegram);
    }
    result = (double)total;
}
