import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ValueBoard, type BoardClock } from './board';
import { decodeValue, FrameError, readFrame } from './frame';
import { formatAll, formatLiteral, formatShort } from './format';
import { expressionKey, overlaps, valueKind, type SubscribedItem } from './item';
import { checkLiteral, wholeNumber } from './literal';
import { clearPrepared, prepare, preparedLiteral, preparedValues, toggledLiteral } from './prepared';

const item = (type: string, kind: string, size: number, more: Partial<SubscribedItem> = {}): SubscribedItem => ({
  expression: 'x',
  offset: 0,
  size,
  type,
  kind,
  ...more,
});

function bytes(size: number, write: (view: DataView) => void): Uint8Array {
  const view = new DataView(new ArrayBuffer(size));
  write(view);
  return new Uint8Array(view.buffer);
}

function frameBytes(id: number, cycle: bigint, values: Uint8Array): ArrayBuffer {
  const data = new Uint8Array(24 + values.length);
  const view = new DataView(data.buffer);
  view.setUint32(0, id, true);
  view.setBigUint64(8, cycle, true);
  view.setBigInt64(16, 1_700_000_000_000_000_000n, true);
  data.set(values, 24);
  return data.buffer;
}

describe('places', () => {
  it('overlap when they share a byte, and bits when they are the same', () => {
    const word = { offset: 4, size: 2, bit: null };
    expect(overlaps(word, { offset: 5, size: 1, bit: null })).toBe(true);
    expect(overlaps(word, { offset: 5, size: 1, bit: 3 })).toBe(true);
    expect(overlaps(word, { offset: 6, size: 1, bit: null })).toBe(false);
    expect(overlaps(word, { offset: 3, size: 1, bit: null })).toBe(false);
    expect(overlaps({ offset: 5, size: 1, bit: 2 }, { offset: 5, size: 1, bit: 3 })).toBe(false);
    expect(overlaps({ offset: 5, size: 1, bit: 3 }, { offset: 5, size: 1, bit: 3 })).toBe(true);
  });
});

describe('frames', () => {
  it('have a header of 24 bytes', () => {
    const frame = readFrame(frameBytes(7, 99n, Uint8Array.of(1, 2)));
    expect(frame).toMatchObject({ subscription: 7, cycle: 99n, timestampNs: 1_700_000_000_000_000_000n });
    expect([...frame.values]).toEqual([1, 2]);
    expect(() => readFrame(new ArrayBuffer(23))).toThrow(FrameError);
  });

  it.each([
    ['BOOL', item('BOOL', 'bool', 1), bytes(1, (v) => v.setUint8(0, 1)), true],
    ['bit', item('BOOL', 'bool', 1, { bit: 3 }), Uint8Array.of(0b1000), true],
    ['bit 2', item('BOOL', 'bool', 1, { bit: 2 }), Uint8Array.of(0b1000), false],
    ['SINT', item('SINT', 'int', 1), bytes(1, (v) => v.setInt8(0, -5)), -5],
    ['INT', item('INT', 'int', 2), bytes(2, (v) => v.setInt16(0, -300, true)), -300],
    ['UDINT', item('UDINT', 'uint', 4), bytes(4, (v) => v.setUint32(0, 4_000_000_000, true)), 4_000_000_000],
    ['LWORD', item('LWORD', 'bits', 8), bytes(8, (v) => v.setBigUint64(0, 2n ** 64n - 1n, true)), 2n ** 64n - 1n],
    ['LINT', item('LINT', 'int', 8), bytes(8, (v) => v.setBigInt64(0, -1n, true)), -1n],
    ['REAL', item('REAL', 'real', 4), bytes(4, (v) => v.setFloat32(0, 1.5, true)), 1.5],
    ['LREAL', item('LREAL', 'real', 8), bytes(8, (v) => v.setFloat64(0, 0.1, true)), 0.1],
    ['TIME', item('TIME', 'time', 4), bytes(4, (v) => v.setUint32(0, 1500, true)), 1500],
    ['STRING', item('STRING(5)', 'string', 6), Uint8Array.of(97, 98, 0, 99, 100, 0), 'ab'],
    ['WSTRING', item('WSTRING(2)', 'wstring', 6), Uint8Array.of(0x2d, 0x4e, 0, 0, 1, 0), '\u4e2d'],
    ['enum', item('E', 'enum', 2, { enum: { Off: -1 } }), bytes(2, (v) => v.setInt16(0, -1, true)), -1],
    ['struct', item('ST_A', 'struct', 4), new Uint8Array(4), null],
    ['outside', item('INT', 'int', 2, { offset: 1 }), new Uint8Array(2), null],
    ['error', item('', 'error', 0, { error: 'unknown' }), new Uint8Array(2), null],
  ])('decode %s', (_name, what, values, expected) => {
    expect(decodeValue(what, values)).toEqual(expected);
  });
});

describe('formats', () => {
  const time = item('TIME', 'time', 4);
  it.each([
    [true, item('BOOL', 'bool', 1), 'TRUE'],
    [-5, item('INT', 'int', 2), '-5'],
    [1500, time, 'T#1s500ms'],
    [0, time, 'T#0ms'],
    [90_061_001, time, 'T#1d1h1m1s1ms'],
    [1_000_000_044n, item('LTIME', 'time', 8), 'LTIME#1s44ns'],
    [0, item('DATE', 'date', 4), 'D#1970-01-01'],
    [86_400 + 3661, item('DATE_AND_TIME', 'date', 4), 'DT#1970-01-02-01:01:01'],
    [3_661_500, item('TIME_OF_DAY', 'date', 4), 'TOD#01:01:01.5'],
    [2, item('E_Mode', 'enum', 2, { enum: { Off: 0, On: 2 } }), 'On'],
    [7, item('E_Mode', 'enum', 2, { enum: { Off: 0, On: 2 } }), '7'],
    ["a$'\n", item('STRING', 'string', 81), "'a$$$'$N'"],
    [0, item('REAL', 'real', 4), '0.0'],
    [Math.fround(0.1), item('REAL', 'real', 4), '0.1'],
    [0.1, item('LREAL', 'real', 8), '0.1'],
    [1e21, item('LREAL', 'real', 8), '1E21'],
    [NaN, item('LREAL', 'real', 8), 'NaN'],
  ])('write %s', (value, what, text) => expect(formatLiteral(value, what)).toBe(text));

  it('write integers in other bases with the width of the type', () => {
    expect(formatLiteral(-1, item('INT', 'int', 2), 'hex')).toBe('16#FFFF');
    expect(formatLiteral(10, item('BYTE', 'bits', 1), 'bin')).toBe('2#0000_1010');
    expect(formatAll(255, item('WORD', 'bits', 2)).map((f) => f.text)).toEqual([
      '255',
      '16#00FF',
      '2#0000_0000_1111_1111',
    ]);
  });

  it('are shown in the number format that their attribute displaymode fixes', () => {
    const hex = { ...item('UINT', 'uint', 2), flags: ['DISPLAY_HEX'] };
    expect(formatShort(255, hex)).toBe('16#00FF');
    expect(formatShort(255, hex, 'bin')).toBe('16#00FF');
    expect(formatShort(255, { ...hex, flags: ['CONSTANT', 'DISPLAY_DEC'] }, 'hex')).toBe('255');
    expect(formatShort(1.5, { ...item('REAL', 'real', 4), flags: ['DISPLAY_BIN'] })).toBe('1.5');
    expect(formatLiteral(255, hex)).toBe('255');
  });

  it('round floats so that they stand still', () => {
    const real = item('LREAL', 'real', 8);
    expect(formatShort(1 / 3, real)).toBe('0.3333333');
    expect(formatShort(123456.789012, real)).toBe('123456.8');
    expect(formatShort(2, real)).toBe('2.0');
    expect(formatShort(1.23e-12, real)).toBe('1.2300E-12');
    expect(formatShort('x'.repeat(80), item('STRING', 'string', 81))).toHaveLength(32);
  });
});

describe('literals', () => {
  const accepted: [string, SubscribedItem, string][] = [
    ['true', item('BOOL', 'bool', 1), 'TRUE'],
    ['16#ff', item('BYTE', 'bits', 1), '16#FF'],
    ['-32768', item('INT', 'int', 2), '-32768'],
    ['1', item('REAL', 'real', 4), '1.0'],
    ['.5', item('REAL', 'real', 4), '0.5'],
    ['1e3', item('LREAL', 'real', 8), '1E3'],
    ['t#1s500ms', item('TIME', 'time', 4), 'T#1s500ms'],
    ['100ms', item('TIME', 'time', 4), 'T#100ms'],
    ['LTIME#1s2us', item('LTIME', 'time', 8), 'LTIME#1s2us'],
    ['e_mode.on', item('E_Mode', 'enum', 2, { enum: { Off: 0, On: 2 } }), 'On'],
    ['2', item('E_Mode', 'enum', 2, { enum: { Off: 0, On: 2 } }), 'On'],
    ['abc', item('STRING(5)', 'string', 6), "'abc'"],
    ["'a$'b'", item('STRING(5)', 'string', 6), "'a$'b'"],
  ];
  it.each(accepted)('accept %s', (text, what, literal) =>
    expect(checkLiteral(text, what)).toEqual({ ok: true, literal }),
  );

  it.each([
    ['2', item('BOOL', 'bool', 1), 'online.literal.bool'],
    ['32768', item('INT', 'int', 2), 'online.literal.range'],
    ['-1', item('UINT', 'uint', 2), 'online.literal.range'],
    ['1.5', item('INT', 'int', 2), 'online.literal.whole'],
    ['1,5', item('REAL', 'real', 4), 'online.literal.real'],
    ['1e39', item('REAL', 'real', 4), 'online.literal.range'],
    ['T#5m68s', item('TIME', 'time', 4), 'online.literal.pattern'],
    ['T#4ms13s', item('TIME', 'time', 4), 'online.literal.pattern'],
    ['5', item('TIME', 'time', 4), 'online.literal.pattern'],
    ['Auto', item('E_Mode', 'enum', 2, { enum: { Off: 0, On: 2 } }), 'online.literal.enum'],
    ['abcdef', item('STRING(5)', 'string', 6), 'online.literal.long'],
    ['\u4e2d', item('STRING(5)', 'string', 6), 'online.literal.narrow'],
    ['5', item('ST_A', 'struct', 4), 'online.literal.compound'],
  ])('refuse %s', (text, what, reason) => expect(checkLiteral(text, what)).toMatchObject({ ok: false, reason }));

  it('read back what is shown', () => {
    fc.assert(
      fc.property(fc.bigInt({ min: -(2n ** 31n), max: 2n ** 31n - 1n }), (number) => {
        const dint = item('DINT', 'int', 4);
        const shown = formatLiteral(Number(number), dint);
        expect(checkLiteral(shown, dint)).toEqual({ ok: true, literal: shown });
        const hex = formatLiteral(Number(BigInt.asUintN(32, number)), item('DWORD', 'bits', 4), 'hex');
        expect(wholeNumber(hex)).toBe(BigInt.asUintN(32, number));
      }),
    );
    fc.assert(
      fc.property(fc.integer({ min: 0, max: 2 ** 32 - 1 }), (ms) => {
        const shown = formatLiteral(ms, item('TIME', 'time', 4));
        expect(checkLiteral(shown, item('TIME', 'time', 4))).toEqual({ ok: true, literal: shown });
      }),
    );
  });
});

describe('prepared values', () => {
  it('toggle as the field has it (DECL-44, declaration EX-01)', () => {
    const sequence = (current: boolean) => {
      const seen: (string | null)[] = [];
      let prepared: string | null = null;
      for (let i = 0; i < 3; i += 1) seen.push((prepared = toggledLiteral(current, prepared)));
      return seen;
    };
    expect(sequence(true)).toEqual(['FALSE', 'TRUE', null]);
    expect(sequence(false)).toEqual(['TRUE', 'FALSE', null]);
  });

  it('are one for all views, whatever the spelling', () => {
    prepare('r1', 'PLC_PRG.a[1, 2]', '5');
    expect(preparedLiteral('r1', 'plc_prg.A[1,2]')).toBe('5');
    expect(preparedLiteral('r2', 'plc_prg.A[1,2]')).toBeNull();
    const sent = preparedValues('r1');
    prepare('r1', 'PLC_PRG.a[1,2]', '6');
    clearPrepared('r1', sent);
    expect(preparedLiteral('r1', 'PLC_PRG.a[1,2]')).toBe('6');
    clearPrepared('r1');
    expect(preparedValues('r1')).toEqual([]);
  });
});

describe('value board', () => {
  function board() {
    const waiting: (() => void)[] = [];
    let now = 1000;
    const clock: BoardClock = { now: () => now, soon: (callback) => waiting.push(callback) };
    const draw = () => waiting.splice(0).forEach((callback) => callback());
    return { board: new ValueBoard(clock), draw, pass: (ms: number) => (now += ms) };
  }
  const two = [
    { ...item('INT', 'int', 2), expression: 'P.a' },
    { ...item('INT', 'int', 2), expression: 'P.b', offset: 2 },
  ];
  const frame = (cycle: bigint, a: number, b: number) =>
    readFrame(
      frameBytes(
        1,
        cycle,
        bytes(4, (v) => (v.setInt16(0, a, true), v.setInt16(2, b, true))),
      ),
    );

  it('notifies only the views of changed values, once a picture', () => {
    const { board: values, draw, pass } = board();
    const notified = { a: 0, b: 0 };
    values.subscribe('p.A', () => (notified.a += 1));
    values.subscribe('P.b', () => (notified.b += 1));
    values.open(1, two);
    values.receive(frame(1n, 1, 1));
    draw();
    expect(notified).toEqual({ a: 1, b: 1 });
    pass(100);
    values.receive(frame(2n, 2, 1));
    values.receive(frame(3n, 3, 1));
    draw();
    expect(notified).toEqual({ a: 2, b: 1 });
    expect(values.get('P.A')).toMatchObject({ value: 3, changedAt: 1100 });
    expect(values.get('P.B')).toMatchObject({ value: 1, changedAt: 0 });
    expect(values.counters.decoded).toBe(4);
    expect(values.cycleOf(1)).toBe(3n);
  });

  it('keeps a value while any subscription holds it', () => {
    const { board: values } = board();
    values.open(1, two);
    values.open(2, [{ ...item('INT', 'int', 2), expression: 'P.A' }]);
    values.receive(frame(1n, 5, 6));
    values.close(1);
    expect(values.get('P.a')?.value).toBe(5);
    expect(values.get('P.b')).toBeNull();
    values.close(2);
    expect(values.get('P.a')).toBeNull();
  });

  it('tells those who show what a variable is of another type, not of values or another place in the frame', () => {
    const { board: values, draw } = board();
    const notified = { item: 0, value: 0 };
    values.subscribeItem('P.a', () => (notified.item += 1));
    values.subscribe('P.a', () => (notified.value += 1));
    values.open(1, two);
    values.receive(frame(1n, 1, 1));
    draw();
    expect(notified).toEqual({ item: 1, value: 1 });
    const first = values.get('P.a')?.item;
    values.receive(frame(2n, 2, 1));
    draw();
    expect(notified).toEqual({ item: 1, value: 2 });
    // Scrolled: the same variable at another place of another frame keeps its value and what is known of it.
    values.open(2, [{ ...item('INT', 'int', 2), expression: 'P.a', offset: 8 }]);
    values.close(1);
    draw();
    expect(notified).toEqual({ item: 1, value: 2 });
    expect(values.get('P.a')).toMatchObject({ value: 2, changedAt: 1000 });
    expect(values.get('P.a')?.item).toBe(first);
    values.open(3, [{ ...item('DINT', 'int', 4), expression: 'P.a' }]);
    draw();
    expect(notified).toEqual({ item: 2, value: 3 });
  });

  it('decodes nothing of 1,000 standing values', () => {
    const { board: values } = board();
    const many = Array.from({ length: 1000 }, (_, i) => ({
      ...item('INT', 'int', 2),
      expression: `P.v${i}`,
      offset: 2 * i,
    }));
    values.open(1, many);
    values.receive(readFrame(frameBytes(1, 1n, new Uint8Array(2000))));
    const before = values.counters.decoded;
    const next = new Uint8Array(2000);
    next[20] = 1;
    for (let i = 2; i < 12; i += 1) values.receive(readFrame(frameBytes(1, BigInt(i), next)));
    expect(values.counters.decoded - before).toBe(1);
  });
});

describe('kinds', () => {
  it('follow type and size where the server names a family', () => {
    expect(valueKind(item('LTIME', 'time', 8))).toBe('ltime');
    expect(valueKind(item('DATE_AND_TIME', 'date', 4))).toBe('dt');
    expect(valueKind(item('ARRAY [0..1] OF INT', 'array', 4))).toBe('compound');
    expect(valueKind(item('INT', 'int', 2, { error: 'gone' }))).toBe('error');
    expect(expressionKey(' Plc_Prg.a [1, 2] ')).toBe('PLC_PRG.A[1,2]');
  });
});
