#include <math.h>
#include <stdint.h>
#define N 24
double result;
static double a[N][N], b[N][N], p[N][N], sum;
static int32_t i, j, k;
static uint8_t ready;
void cycle(void) {
    if (!ready) {
        for (i = 1; i <= N; i++)
            for (j = 1; j <= N; j++) {
                a[i - 1][j - 1] = (double)((i * 7 + j * 3) % 11) / 11.0;
                b[i - 1][j - 1] = (double)((i * 5 + j * 13) % 17) / 17.0;
            }
        ready = 1;
    }
    for (i = 1; i <= N; i++)
        for (j = 1; j <= N; j++) {
            sum = 0.0;
            for (k = 1; k <= N; k++) sum += a[i - 1][k - 1] * b[k - 1][j - 1];
            p[i - 1][j - 1] = sum;
        }
    for (i = 1; i <= N; i++)
        for (j = 1; j <= N; j++) a[i - 1][j - 1] = p[i - 1][j - 1] / (1.0 + fabs(p[i - 1][j - 1]));
    result = a[2][4] + a[N - 1][N - 1];
}
