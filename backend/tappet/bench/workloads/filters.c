#include <stdint.h>
#include <stdlib.h>
double result;
typedef struct { double in, out, b0, b1, b2, a1, a2, s1, s2; } Biquad;
typedef struct { float in, out, history[32], taps[32]; int16_t head; uint8_t ready; } Fir;
static Biquad sections[16][4];
static Fir firs[8];
static int32_t n;
static uint8_t ready;
static void biquad(Biquad *f) {
    f->out = f->b0 * f->in + f->s1;
    f->s1 = f->b1 * f->in - f->a1 * f->out + f->s2;
    f->s2 = f->b2 * f->in - f->a2 * f->out;
}
static void fir(Fir *f) {
    if (!f->ready) {
        for (int i = 0; i < 32; i++) f->taps[i] = (float)(16 - abs(16 - i)) / 256.0f;
        f->ready = 1;
    }
    f->history[f->head] = f->in;
    f->out = 0.0f;
    for (int i = 0; i < 32; i++) f->out = f->out + f->taps[i] * f->history[(f->head - i + 32) % 32];
    f->head = (f->head + 1) % 32;
}
void cycle(void) {
    if (!ready) {
        for (int c = 0; c < 16; c++)
            for (int s = 0; s < 4; s++) {
                Biquad *f = &sections[c][s];
                f->b0 = 0.2066; f->b1 = 0.4131; f->b2 = 0.2066; f->a1 = -0.3695; f->a2 = 0.1958;
            }
        ready = 1;
    }
    n++;
    for (int c = 0; c < 16; c++) {
        double sample = (double)((n * 7 + c) % 100) * 0.01;
        for (int s = 0; s < 4; s++) {
            sections[c][s].in = sample;
            biquad(&sections[c][s]);
            sample = sections[c][s].out;
        }
        result += sample;
    }
    for (int c = 0; c < 8; c++) {
        firs[c].in = (float)((n + c) % 50);
        fir(&firs[c]);
        result += firs[c].out;
    }
}
