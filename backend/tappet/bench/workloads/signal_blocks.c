#include <stdint.h>
double result;
typedef struct Block Block;
typedef struct { double (*execute)(Block *, double); } Table;
struct Block { const Table *table; double p, s; int32_t n; };
static double gain(Block *b, double x) {
    return x * b->p;
}
static double offset(Block *b, double x) {
    return x + b->p;
}
static double limit(Block *b, double x) {
    double low = x > -b->p ? x : -b->p;
    return low < b->p ? low : b->p;
}
static double lowpass(Block *b, double x) {
    b->s += (x - b->s) * b->p;
    return b->s;
}
static double counter(Block *b, double x) {
    b->n++;
    return x + (b->n % 100) * b->p;
}
static double hysteresis(Block *b, double x) {
    if (x > b->p) b->s = 1.0;
    else if (x < -b->p) b->s = 0.0;
    return x + b->s;
}
static double slew(Block *b, double x) {
    double by = x - b->s > -b->p ? x - b->s : -b->p;
    b->s += by < b->p ? by : b->p;
    return b->s;
}
static double mean(Block *b, double x) {
    double y = (x + b->s) * b->p;
    b->s = x;
    return y;
}
const Table tables[8] = {{gain}, {offset}, {limit}, {lowpass}, {counter}, {hysteresis}, {slew}, {mean}};
static const double parameters[8] = {1.5, 0.25, 2.0, 0.1, 0.001, 0.5, 0.05, 0.5};
static Block blocks[8][8], *chain[64];
static int32_t n;
static uint8_t ready;
void cycle(void) {
    if (!ready) {
        for (int i = 0; i < 64; i++) {
            int kind = (i * 5 + i / 8 * 3) % 8;
            chain[i] = &blocks[kind][i / 8];
            chain[i]->table = &tables[kind];
            chain[i]->p = parameters[kind];
        }
        ready = 1;
    }
    n++;
    double signal = (n % 41 - 20) * 0.1;
    for (int i = 0; i < 64; i++) {
        signal = chain[i]->table->execute(chain[i], signal);
        result += signal;
    }
}
