#include <stdint.h>
double result;
typedef struct { uint32_t stamp; uint16_t channel; double value; uint16_t flags; uint8_t tag[8]; } Record;
typedef struct { Record buffer[256]; uint16_t head, tail, used; uint32_t lost; } Ring;
static Ring ring;
static Record item, taken;
static uint32_t n;
static uint8_t push(Ring *r, Record *x) {
    if (r->used > 255) { r->lost++; return 0; }
    r->buffer[r->head] = *x;
    r->head = (r->head + 1) % 256;
    r->used++;
    return 1;
}
static uint8_t pop(Ring *r, Record *x) {
    if (r->used == 0) return 0;
    *x = r->buffer[r->tail];
    r->tail = (r->tail + 1) % 256;
    r->used--;
    return 1;
}
void cycle(void) {
    for (int i = 0; i <= 99; i++) {
        n++;
        item.stamp = n; item.channel = n % 16; item.value = n * 0.125;
        item.flags = n; item.tag[n % 8] = n;
        push(&ring, &item);
    }
    for (int i = 0; i <= 97; i++)
        if (pop(&ring, &taken)) result = result + taken.value + taken.tag[3] + taken.channel;
    result += ring.lost;
}
