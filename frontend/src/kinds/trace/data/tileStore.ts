/**
 * What is known of one record, in tiles: each spans a power of two of nanoseconds and has about a point a pixel.
 *
 * A view is drawn at once from what is there, of whatever fineness, while the tiles that fit are fetched; neighbours
 * come beforehand. The memory is bound by `MOST_BYTES`, whatever the length of the recording.
 */
import type { Range } from '@/editors/plot/scales';
import type { TraceWindow } from './windowFormat';

/** Points asked for per tile; a tile is between half of it and all of it in pixels. */
export const TILE_POINTS = 2048;
const MOST_BYTES = 96 * 2 ** 20;
const MOST_REQUESTS = 4;
/** Coarser tiles looked through for what is not there yet. */
const MOST_LEVELS = 40;

export type FetchWindow = (range: Range, width: number, signal: AbortSignal) => Promise<TraceWindow>;

interface Tile {
  key: string;
  range: Range;
  window: TraceWindow;
  bytes: number;
  used: number;
  /** Samples may have come since. */
  open: boolean;
  version: number;
}

interface Wanted {
  key: string;
  range: Range;
}

/** A part of a tile that is drawn: its points within `range`. */
export interface Piece {
  range: Range;
  window: TraceWindow;
  /** Nothing before it is drawn. */
  begins?: boolean;
}

export class TileStore {
  private readonly tiles = new Map<string, Tile>();
  private readonly running = new Map<string, AbortController>();
  private wanted: Wanted[] = [];
  private clock = 0;
  private bytes = 0;
  private version = 0;
  /** Changes whenever other pieces may be given, or others be asked for. */
  revision = 0;
  /** Why nothing is asked for any more, until `retry`. */
  failure: unknown = null;

  constructor(
    private readonly fetchWindow: FetchWindow,
    /** Distance of two samples, so that lines reach over the edges of tiles. */
    private readonly interval: number,
    private readonly changed: () => void,
  ) {}

  /** Samples have come: tiles that were not complete are fetched again when they are next seen. */
  grown(): void {
    this.version += 1;
    this.revision += 1;
  }

  /** Asks again after a failure. */
  retry(): void {
    this.failure = null;
    this.revision += 1;
  }

  /** What can be drawn of a view now, in order of time; asks for what fits better. */
  pieces(view: Range, pixels: number): Piece[] {
    const level = levelOf(view, pixels);
    const tiles = tilesOf(view, level);
    this.want(tiles, level);
    return tiles.flatMap(({ key, range }) => this.found(key, range, level));
  }

  /** Whether all that fits the view is there. */
  complete(view: Range, pixels: number): boolean {
    return tilesOf(view, levelOf(view, pixels)).every(({ key }) => this.tiles.has(key));
  }

  get size(): { bytes: number; tiles: number } {
    return { bytes: this.bytes, tiles: this.tiles.size };
  }

  close(): void {
    this.wanted = [];
    for (const request of this.running.values()) request.abort();
    this.running.clear();
  }

  /** The tile, or the next coarser one that is there, or the finer ones. */
  private found(key: string, range: Range, level: number): Piece[] {
    const own = this.take(key);
    if (own) return [{ range, window: own.window }];
    for (let up = level + 1; up <= level + MOST_LEVELS; up += 1) {
      const coarse = this.take(keyOf(up, Math.floor(range.min / 2 ** up)));
      if (coarse) return [{ range, window: coarse.window }];
    }
    return this.finer(range, level, 2);
  }

  private finer(range: Range, level: number, depth: number): Piece[] {
    if (depth === 0) return [];
    return tilesOf({ min: range.min, max: range.max - 1 }, level - 1).flatMap(({ key, range: part }) => {
      const tile = this.take(key);
      return tile ? [{ range: part, window: tile.window }] : this.finer(part, level - 1, depth - 1);
    });
  }

  private take(key: string): Tile | undefined {
    const tile = this.tiles.get(key);
    if (tile) tile.used = ++this.clock;
    return tile;
  }

  private want(seen: readonly Wanted[], level: number): void {
    const span = 2 ** level;
    const [first, last] = [seen[0], seen.at(-1)];
    const around =
      first === undefined || last === undefined
        ? []
        : [
            tileAt(level + 2, Math.floor(first.range.min / (4 * span))),
            tileAt(level, Math.round(last.range.max / span)),
            tileAt(level, Math.round(first.range.min / span) - 1),
          ];
    const stale = (one: Wanted) => {
      const tile = this.tiles.get(one.key);
      return tile === undefined || (tile.open && tile.version < this.version);
    };
    this.wanted = [...seen, ...around.filter((one) => this.tiles.get(one.key) === undefined)].filter(stale);
    const kept = new Set(this.wanted.map(({ key }) => key));
    for (const [key, request] of this.running) {
      if (kept.has(key)) continue;
      request.abort();
      this.running.delete(key);
    }
    this.next();
  }

  private next(): void {
    if (this.failure !== null) return;
    for (const { key, range } of this.wanted) {
      if (this.running.size >= MOST_REQUESTS) return;
      if (!this.running.has(key)) void this.load(key, range);
    }
  }

  private async load(key: string, range: Range): Promise<void> {
    const request = new AbortController();
    const version = this.version;
    this.running.set(key, request);
    try {
      const around = { min: range.min - 2 * this.interval, max: range.max + 2 * this.interval };
      const window = await this.fetchWindow(around, TILE_POINTS, request.signal);
      if (request.signal.aborted) return;
      this.keep(key, range, window, version);
      this.wanted = this.wanted.filter((one) => one.key !== key);
    } catch (error) {
      if (request.signal.aborted) return;
      this.failure = error;
    } finally {
      if (this.running.get(key) === request) this.running.delete(key);
    }
    this.next();
    this.changed();
  }

  private keep(key: string, range: Range, window: TraceWindow, version: number): void {
    this.revision += 1;
    this.bytes -= this.tiles.get(key)?.bytes ?? 0;
    const bytes = window.time.length * 8 * (2 + 2 * window.channels.length);
    const open = window.extent === null || window.extent.max < range.max + 2 * this.interval;
    this.tiles.set(key, { key, range, window, bytes, used: ++this.clock, open, version });
    this.bytes += bytes;
    if (this.bytes <= MOST_BYTES) return;
    for (const old of [...this.tiles.values()].sort((one, other) => one.used - other.used)) {
      if (this.bytes <= MOST_BYTES || old.key === key) return;
      this.tiles.delete(old.key);
      this.bytes -= old.bytes;
    }
  }
}

/** The power of two of nanoseconds that a tile spans, so that it has a point or two for each pixel. */
export function levelOf(view: Range, pixels: number): number {
  const perPixel = (view.max - view.min) / Math.max(1, pixels);
  return Math.max(0, Math.ceil(Math.log2(Math.max(1e-9, (perPixel * TILE_POINTS) / 2))));
}

const keyOf = (level: number, index: number) => `${level}:${index}`;
function tileAt(level: number, index: number): Wanted {
  return { key: keyOf(level, index), range: { min: index * 2 ** level, max: (index + 1) * 2 ** level } };
}

function tilesOf(view: Range, level: number): Wanted[] {
  const [first, last] = [view.min, view.max].map((at) => Math.floor(at / 2 ** level)) as [number, number];
  return Array.from({ length: Math.min(64, last - first + 1) }, (_, k) => tileAt(level, first + k));
}
