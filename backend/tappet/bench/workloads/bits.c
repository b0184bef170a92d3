#include <stdint.h>
double result;
static uint32_t seed = 0x2545F491u, gray, rev, work;
static int32_t ones, i, k;
void cycle(void) {
    ones = 0;
    for (i = 1; i <= 100; i++) {
        seed ^= seed << 13;
        seed ^= seed >> 17;
        seed ^= seed << 5;
        gray = seed ^ (seed >> 1);
        work = gray;
        rev = 0;
        for (k = 1; k <= 32; k++) {
            rev = (rev << 1) | (work & 1);
            work >>= 1;
        }
        work = (rev << 7) | (rev >> 25);
        while (work != 0) {
            work &= work - 1;
            ones++;
        }
        if (((gray >> 5) & 1) && !((rev >> 9) & 1)) ones += 3;
    }
    result = result * 0.5 + (double)ones;
}
