#include <stdint.h>
double result;
typedef struct Valve Valve;
typedef struct { double (*step)(Valve *, double); void (*move)(Valve *, double); } Table;
struct Valve { const Table *table; double position; int32_t moves; double limit; };
static double step(Valve *v, double demand) {
    v->table->move(v, demand - v->position);
    return v->position;
}
static void move(Valve *v, double by) {
    v->position += by * 0.5;
    v->moves++;
}
static void slow_move(Valve *v, double by) {
    double low = by > -v->limit ? by : -v->limit;
    v->position += low < v->limit ? low : v->limit;
    v->moves++;
}
const Table fast_table = {step, move}, slow_table = {step, slow_move};
static Valve fast[100], slow[100], *valves[200];
static int32_t n;
static uint8_t ready;
void cycle(void) {
    if (!ready) {
        for (int i = 0; i < 100; i++) {
            fast[i].table = &fast_table;
            slow[i].table = &slow_table;
            slow[i].limit = 0.25;
            valves[2 * i] = &fast[i];
            valves[2 * i + 1] = &slow[i];
        }
        ready = 1;
    }
    n++;
    double demand = n % 37;
    for (int i = 0; i < 200; i++) result += valves[i]->table->step(valves[i], demand + i);
}
