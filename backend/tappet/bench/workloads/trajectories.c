#include <math.h>
#include <stdint.h>
double result;
typedef struct { double p0, v0, a0, p1, v1, a1, T; double c[6]; } Quintic;
static Quintic axes[6];
static double now, path_velocity, p[6], v[6], a[6], j[6];
static uint32_t n;
static void plan(Quintic *q) {
    double h = q->p1 - q->p0, T = q->T, T2 = T * T, T3 = T2 * T;
    q->c[0] = q->p0;
    q->c[1] = q->v0;
    q->c[2] = 0.5 * q->a0;
    q->c[3] = (20.0 * h - (8.0 * q->v1 + 12.0 * q->v0) * T - (3.0 * q->a0 - q->a1) * T2) / (2.0 * T3);
    q->c[4] = (-30.0 * h + (14.0 * q->v1 + 16.0 * q->v0) * T + (3.0 * q->a0 - 2.0 * q->a1) * T2) / (2.0 * T3 * T);
    q->c[5] = (12.0 * h - 6.0 * (q->v1 + q->v0) * T + (q->a1 - q->a0) * T2) / (2.0 * T3 * T2);
}
static double position(const Quintic *q, double u) {
    double sum = q->c[5];
    for (int i = 4; i >= 0; i--) sum = sum * u + q->c[i];
    return sum;
}
static double derivative(const Quintic *q, double u, int16_t order) {
    double sum = 0.0;
    for (int16_t i = 5; i >= order; i--) {
        double factor = 1.0;
        for (int16_t k = 0; k < order; k++) factor *= i - k;
        sum = sum * u + factor * q->c[i];
    }
    return sum;
}
void cycle(void) {
    now += 0.001;
    if (n % 256 == 0) {
        now = 0.0;
        for (int i = 0; i < 6; i++) {
            Quintic *q = &axes[i];
            q->p0 = p[i]; q->v0 = v[i] * 0.5; q->a0 = 0.0;
            q->p1 = ((double)(n / 256 % 9) - 4.0) * (i + 1);
            q->v1 = i * 0.25; q->a1 = 0.0;
            q->T = 0.256;
            plan(q);
        }
    }
    n++;
    path_velocity = 0.0;
    for (int16_t i = 0; i < 6; i++) {
        p[i] = position(&axes[i], now);
        v[i] = derivative(&axes[i], now, 1);
        a[i] = derivative(&axes[i], now, 2);
        j[i] = derivative(&axes[i], now, 3);
        path_velocity += v[i] * v[i];
    }
    result = result + sqrt(path_velocity) + a[2] * 0.001 + j[5] * 0.000001;
}
