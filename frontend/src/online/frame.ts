/** The binary frames of the online socket: header and packed raw memory bytes, little endian (seam 6). */
import { valueKind, type PlcValue, type SubscribedItem, type ValueKind } from './item';

const HEADER_SIZE = 24;

export interface Frame {
  readonly subscription: number;
  readonly flags: number;
  readonly cycle: bigint;
  /** Nanoseconds since 1970. */
  readonly timestampNs: bigint;
  readonly values: Uint8Array;
}

export class FrameError extends Error {}

/** Reads the header; the values are a view on the same bytes. Throws FrameError when it is too short. */
export function readFrame(data: ArrayBuffer): Frame {
  if (data.byteLength < HEADER_SIZE) {
    throw new FrameError(`a frame has at least ${String(HEADER_SIZE)} bytes, this one ${String(data.byteLength)}`);
  }
  const view = new DataView(data);
  return {
    subscription: view.getUint32(0, true),
    flags: view.getUint32(4, true),
    cycle: view.getBigUint64(8, true),
    timestampNs: view.getBigInt64(16, true),
    values: new Uint8Array(data, HEADER_SIZE),
  };
}

/** Whether the values are those of a past cycle. */
export function isPast(frame: Frame): boolean {
  return (frame.flags & 1) !== 0;
}

const WIDE = new TextDecoder('utf-16le');

/** The value at the item's place, or null when it has none of its own or lies outside of the frame. */
export function decodeValue(item: SubscribedItem, values: Uint8Array): PlcValue | null {
  const { offset, size } = item;
  if (offset < 0 || size < 0 || offset + size > values.length) return null;
  const kind = valueKind(item);
  if (kind === 'bool') {
    const byte = values[offset] ?? 0;
    return item.bit == null ? (byte & 1) === 1 : ((byte >> item.bit) & 1) === 1;
  }
  if (kind === 'string') {
    const bytes = values.subarray(offset, offset + size);
    const end = bytes.indexOf(0);
    return String.fromCharCode(...(end < 0 ? bytes : bytes.subarray(0, end)));
  }
  if (kind === 'wstring') return wideText(values.subarray(offset, offset + size));
  if (kind === 'compound' || kind === 'error') return null;
  return decodeNumber(kind, item, new DataView(values.buffer, values.byteOffset + offset, size));
}

function wideText(bytes: Uint8Array): string {
  let end = bytes.length & ~1;
  for (let at = 0; at + 1 < bytes.length; at += 2) {
    if (bytes[at] === 0 && bytes[at + 1] === 0) {
      end = at;
      break;
    }
  }
  return WIDE.decode(bytes.subarray(0, end));
}

function isSigned(kind: ValueKind, item: SubscribedItem): boolean {
  return kind === 'int' || (kind === 'enum' && (item.base ?? 'int') === 'int');
}

function decodeNumber(kind: ValueKind, item: SubscribedItem, view: DataView): PlcValue | null {
  if (kind === 'real') {
    if (item.size === 4) return view.getFloat32(0, true);
    return item.size === 8 ? view.getFloat64(0, true) : null;
  }
  const signed = isSigned(kind, item);
  switch (item.size) {
    case 1:
      return signed ? view.getInt8(0) : view.getUint8(0);
    case 2:
      return signed ? view.getInt16(0, true) : view.getUint16(0, true);
    case 4:
      return signed ? view.getInt32(0, true) : view.getUint32(0, true);
    case 8:
      return signed ? view.getBigInt64(0, true) : view.getBigUint64(0, true);
    default:
      return null;
  }
}

/** Whether the bytes of an item differ between two frames of one subscription. */
export function itemChanged(item: SubscribedItem, before: Uint8Array, after: Uint8Array): boolean {
  const end = item.offset + item.size;
  for (let at = item.offset; at < end; at += 1) if (before[at] !== after[at]) return true;
  return false;
}
