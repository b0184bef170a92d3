#include <stdint.h>
double result;
typedef struct { uint8_t unit; uint16_t address, count, *values, length; uint8_t frame[256]; uint16_t crc; } Writer;
static Writer w;
static uint16_t registers[32], n;
static uint16_t crc16(uint8_t *data, uint16_t count) {
    uint16_t crc = 0xFFFF;
    for (uint16_t i = 1; i <= count; i++) {
        crc ^= *data;
        for (uint16_t bit = 1; bit <= 8; bit++) {
            if (crc & 1) crc = (crc >> 1) ^ 0xA001;
            else crc >>= 1;
        }
        data++;
    }
    return crc;
}
static void writer(Writer *w) {
    uint8_t *f = w->frame;
    f[0] = w->unit; f[1] = 0x10;
    f[2] = w->address >> 8; f[3] = w->address;
    f[4] = w->count >> 8; f[5] = w->count;
    f[6] = w->count * 2;
    w->length = 7;
    for (uint16_t i = 0; i <= w->count - 1; i++) {
        f[w->length] = w->values[i] >> 8;
        f[w->length + 1] = w->values[i];
        w->length += 2;
    }
    w->crc = crc16(f, w->length);
    f[w->length] = w->crc; f[w->length + 1] = w->crc >> 8;
    w->length += 2;
}
void cycle(void) {
    n++;
    for (int i = 0; i < 32; i++) registers[i] = n * 31 + i * 7;
    w.unit = n % 247; w.address = n; w.count = 32; w.values = registers;
    writer(&w);
    result += w.frame[w.length - 2] + w.frame[w.length - 1];
}
