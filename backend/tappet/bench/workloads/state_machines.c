#include <stdint.h>
double result;
enum { Idle, Start, Run, Slow, Stop, Error };
static struct {
    int16_t step;
    int32_t count, parts, errors;
} m[64];
static int32_t n, total;
void cycle(void) {
    n++;
    total = 0;
    for (int32_t i = 0; i <= 63; i++) {
        m[i].count++;
        switch (m[i].step) {
        case Idle:
            if ((n + i) % 7 == 0) {
                m[i].step = Start;
                m[i].count = 0;
            }
            break;
        case Start:
            if (m[i].count > 3) m[i].step = Run;
            break;
        case Run:
            if (m[i].count > 10 + i % 5) m[i].step = Slow;
            break;
        case Slow:
            if ((n ^ i) % 13 == 0)
                m[i].step = Error;
            else if (m[i].count > 20)
                m[i].step = Stop;
            break;
        case Stop:
            m[i].parts++;
            m[i].step = Idle;
            break;
        case Error:
            m[i].errors++;
            m[i].step = Idle;
            break;
        }
        total += m[i].parts - m[i].errors;
    }
    result = (double)total;
}
