#include <stdint.h>
double result;
typedef struct { int16_t kind; double value; uint32_t time_ms; } Step;
typedef struct {
    uint32_t number;
    uint8_t name[32];
    Step steps[16];
    double limits[8];
    uint16_t version;
    uint8_t locked;
} Recipe;
typedef struct { Recipe recipe; double scale; Recipe adapted; uint32_t total_ms; int16_t i; } Batch;
static Recipe store[16], active;
static Batch batch;
static uint32_t n;
static uint8_t ready;
static void run(Batch *b) {
    b->adapted = b->recipe;
    b->total_ms = 0;
    for (b->i = 0; b->i < 16; b->i++) {
        Step *s = &b->adapted.steps[b->i];
        if (s->kind == 2) s->value *= b->scale;
        b->total_ms += s->time_ms;
    }
    if (!b->adapted.locked) b->adapted.version++;
}
void cycle(void) {
    if (!ready) {
        for (int i = 0; i < 16; i++) {
            store[i].number = 100 + i;
            for (int j = 0; j < 32; j++) store[i].name[j] = 65 + (i + j) % 26;
            for (int j = 0; j < 16; j++) {
                store[i].steps[j].kind = j % 4;
                store[i].steps[j].value = 10.0 + i + j * 0.5;
                store[i].steps[j].time_ms = 250 * (j + 1);
            }
            store[i].locked = i % 3 == 0;
        }
        ready = 1;
    }
    n++;
    for (int16_t i = 0; i < 8; i++) {
        int16_t number = (n + (uint32_t)i) % 16;
        active = store[number];
        active.limits[i] = active.steps[i].value;
        batch.recipe = active;
        batch.scale = 1.0 + number * 0.000001;
        run(&batch);
        store[number] = batch.adapted;
        result = result + store[number].steps[2].value + batch.total_ms + store[number].version;
    }
}
