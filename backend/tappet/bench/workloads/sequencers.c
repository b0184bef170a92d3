#include <stdint.h>
double result;
typedef struct { uint8_t in; uint32_t now, delay; uint8_t out; uint32_t elapsed; uint8_t last; uint32_t start; } Delay;
typedef struct {
    uint32_t now;
    uint8_t part, clamped, pressure, reset, clamp, valve, motor, fault;
    uint32_t parts, faults;
    int16_t step, last;
    Delay delay, supervise;
} Station;
static Station stations[24];
static uint32_t now, n;
static void run_delay(Delay *d) {
    if (d->in) {
        if (!d->last) d->start = d->now;
        d->elapsed = d->now - d->start;
        d->out = d->elapsed >= d->delay;
    } else {
        d->out = 0;
        d->elapsed = 0;
    }
    d->last = d->in;
}
static void run(Station *s) {
    s->delay.in = s->step == s->last;
    s->delay.now = s->now;
    s->delay.delay = 30;
    run_delay(&s->delay);
    s->supervise.in = s->step == s->last && s->step != 0;
    s->supervise.now = s->now;
    s->supervise.delay = 400;
    run_delay(&s->supervise);
    s->last = s->step;
    switch (s->step) {
    case 0:
        s->clamp = 0;
        if (s->part && !s->fault) s->step = 10;
        break;
    case 10:
        s->clamp = 1;
        if (s->clamped) s->step = 20;
        break;
    case 20:
        if (s->delay.out) s->step = 30;
        break;
    case 30:
        s->valve = 1;
        if (s->pressure) s->step = 40;
        break;
    case 40:
        if (s->delay.out) {
            s->motor = 1;
            s->step = 50;
        }
        break;
    case 50: case 51:
        if (s->delay.out) s->step++;
        break;
    case 52:
        s->motor = 0;
        s->step = 60;
        break;
    case 60:
        s->valve = 0;
        if (!s->pressure && s->delay.out) {
            s->parts++;
            s->step = 0;
        }
        break;
    case 90 ... 99:
        s->clamp = s->valve = s->motor = 0;
        s->fault = 1;
        if (s->reset) {
            s->fault = 0;
            s->step = 0;
        }
        break;
    default:
        s->step = 90;
    }
    if (s->supervise.out && s->step < 90) {
        s->faults++;
        s->step = 90;
    }
}
void cycle(void) {
    n++;
    now += 10;
    for (int16_t i = 0; i < 24; i++) {
        uint32_t phase = n + (uint32_t)i * 7;
        Station *s = &stations[i];
        s->now = now;
        s->part = phase % 5 == 0;
        s->clamped = phase % 3 == 0;
        s->pressure = (phase / 64) % 3 != 2 && phase % 4 < 2;
        s->reset = phase % 50 == 0;
        run(s);
        result += s->parts;
        result += s->faults * 3;
    }
}
