#include <stdint.h>
double result;
typedef struct {
    uint8_t in;
    int16_t limit;
    uint8_t out;
    int32_t edges;
    int16_t count;
    uint8_t last;
} Debounce;
static Debounce d[400];
static uint32_t n;
static int32_t total;
static uint8_t ready;
static void debounce(Debounce *f) {
    if (f->in == f->out)
        f->count = 0;
    else {
        f->count++;
        if (f->count >= f->limit) {
            f->out = f->in;
            f->count = 0;
        }
    }
    if (f->out && !f->last) f->edges++;
    f->last = f->out;
}
void cycle(void) {
    if (!ready) {
        for (int i = 0; i < 400; i++) d[i].limit = 3;
        ready = 1;
    }
    n++;
    total = 0;
    for (int32_t i = 0; i <= 399; i++) {
        d[i].in = ((n >> 2) + (uint32_t)i) % 5 < 2;
        debounce(&d[i]);
        total += d[i].edges;
    }
    result = (double)total;
}
