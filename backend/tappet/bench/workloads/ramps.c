#include <math.h>
#include <stdint.h>
double result;
typedef struct {
    uint8_t enable, hold;
    double target, slope, rounding, out, rate;
    uint8_t at_target;
    double cycle, step, wanted, rest;
} Ramp;
static Ramp ramps[32];
static uint32_t n;
static uint8_t ready;
static void ramp(Ramp *r) {
    if (!r->enable) {
        r->out = 0.0;
        r->rate = 0.0;
        r->at_target = 0;
        return;
    }
    if (r->hold) {
        r->wanted = 0.0;
    } else {
        r->rest = r->target - r->out;
        r->wanted = sqrt(2.0 * r->rounding * fabs(r->rest));
        if (r->wanted > r->slope) r->wanted = r->slope;
        if (r->rest < 0.0) r->wanted = -r->wanted;
    }
    r->step = r->rounding * r->cycle;
    double low = r->rate - r->step, high = r->rate + r->step;
    double limited = r->wanted > low ? r->wanted : low;
    r->rate = limited < high ? limited : high;
    r->out += r->rate * r->cycle;
    r->at_target = fabs(r->target - r->out) < 0.05;
}
void cycle(void) {
    if (!ready) {
        for (int i = 0; i < 32; i++) {
            ramps[i].enable = 1;
            ramps[i].slope = 5.0;
            ramps[i].rounding = 20.0;
            ramps[i].cycle = 0.01;
        }
        ready = 1;
    }
    n++;
    for (int16_t i = 0; i < 32; i++) {
        ramps[i].hold = (n + (uint32_t)i) % 97 < 5;
        ramps[i].target = (double)((n / 500 + (uint32_t)i) % 11) * 2.5 - 10.0;
        ramp(&ramps[i]);
        result += ramps[i].out;
        if (ramps[i].at_target) result += 1.0;
    }
}
