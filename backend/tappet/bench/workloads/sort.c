#include <stdint.h>
#define N 400
double result;
static int32_t a[N], gap, value, i, j;
static uint32_t seed = 1;
void cycle(void) {
    for (i = 0; i <= N - 1; i++) {
        seed = seed * 1103515245u + 12345u;
        a[i] = (int32_t)(seed >> 8) % 10000;
    }
    gap = N / 2;
    while (gap > 0) {
        for (i = gap; i <= N - 1; i++) {
            value = a[i];
            j = i;
            while (j >= gap && a[j - gap] > value) {
                a[j] = a[j - gap];
                j = j - gap;
            }
            a[j] = value;
        }
        gap = gap / 2;
    }
    result = (double)a[0] + (double)a[N / 2] + (double)a[N - 1];
}
