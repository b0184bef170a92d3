#include <stdint.h>
double result;
typedef struct {
    double set, actual, kp, tn, tv, dt, min, max, out, sum, last, error, raw;
} Pid;
static Pid p[100];
static double plant[100];
static uint8_t ready;
static void pid(Pid *f) {
    f->error = f->set - f->actual;
    f->raw = f->kp * (f->error + f->sum / f->tn + f->tv * (f->error - f->last) / f->dt);
    f->last = f->error;
    if (f->raw > f->max)
        f->out = f->max;
    else if (f->raw < f->min)
        f->out = f->min;
    else {
        f->out = f->raw;
        f->sum += f->error * f->dt;
    }
}
void cycle(void) {
    if (!ready) {
        for (int i = 0; i < 100; i++) {
            p[i].kp = 2.0; p[i].tn = 0.5; p[i].tv = 0.05; p[i].dt = 0.01; p[i].min = -10.0; p[i].max = 10.0;
        }
        ready = 1;
    }
    result = 0.0;
    for (int32_t i = 1; i <= 100; i++) {
        p[i - 1].set = (double)i * 0.1;
        p[i - 1].actual = plant[i - 1];
        pid(&p[i - 1]);
        plant[i - 1] += (p[i - 1].out - plant[i - 1]) * 0.02;
        result += plant[i - 1];
    }
}
