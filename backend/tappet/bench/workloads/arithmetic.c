#include <stdint.h>
double result;
static uint32_t seed = 12345;
static int32_t sum;
static double x;
void cycle(void) {
    for (int32_t i = 1; i <= 500; i++) {
        seed = seed * 1664525u + 1013904223u;
        sum = (int32_t)((uint32_t)sum + (uint32_t)((int32_t)(seed >> 20) % 97 - i / 3));
        x = (double)(seed >> 8) / 16777216.0;
        result = result * 0.999 + ((1.5 * x - 2.25) * x + 0.5) * x - (double)sum * 1.0e-9;
    }
}
