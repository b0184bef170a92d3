// @vitest-environment happy-dom
import type { editor } from 'monaco-editor/editor/editor.api';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { ValueBoard } from '@/online/board';
import type { OnlineChannel } from '@/online/channel';
import type { SubscribedItem } from '@/online/item';
import { prepare } from '@/online/prepared';
import type { CodeEditor } from '@/text/CodePane';
import type { Monaco } from '@/text/monacoLoader';
import { InlineMonitor, type MonitorSettings } from './inlineMonitor';
import { usesOf } from './uses';

const TEXT = 'count := count + step;\ndone := TRUE;';
const ITEMS: readonly SubscribedItem[] = [
  { expression: 'PRG.count', offset: 0, size: 2, type: 'INT', kind: 'int' },
  { expression: 'PRG.step', offset: 2, size: 2, type: 'INT', kind: 'int' },
  { expression: 'PRG.done', offset: 4, size: 1, type: 'BOOL', kind: 'bool' },
];
const SETTINGS: MonitorSettings = {
  runtimeId: 'local',
  scope: { instance: 'PRG', members: new Set(['COUNT', 'STEP', 'DONE']), temporary: new Set() },
  format: 'dec',
  lost: false,
  running: null,
};

/** Draws decorations as Monaco does: an element for each injected text, made anew when asked for. */
class Editor {
  readonly lines = document.createElement('div');
  readonly node = document.createElement('div');
  readonly decorations = new Map<string, editor.IModelDeltaDecoration>();
  /** Decorations that have been set since it was last looked. */
  set = 0;
  private next = 0;

  constructor() {
    this.lines.className = 'view-lines';
    this.node.append(this.lines);
  }

  render(pieces = 1): void {
    const spans = [...this.decorations.values()].flatMap(({ options }) => {
      const before = options.before as editor.InjectedTextOptions;
      const cut = Math.ceil(before.content.length / pieces);
      return Array.from({ length: pieces }, (_, piece) => {
        const span = document.createElement('span');
        span.className = `mtk1 ${before.inlineClassName ?? ''}`;
        span.append(before.content.slice(piece * cut, (piece + 1) * cut));
        return span;
      });
    });
    this.lines.replaceChildren(...spans);
  }

  shown(): string[] {
    return [...this.lines.children].map((each) => each.textContent.replaceAll('\u00a0', ' ').trim());
  }

  target(): CodeEditor {
    const offsets = TEXT.split('\n').map((_, line, all) => all.slice(0, line).join('\n').length + (line > 0 ? 1 : 0));
    const nothing = () => ({ dispose: () => undefined });
    const target = {
      getModel: () => ({
        getValue: () => TEXT,
        getOffsetAt: ({ lineNumber, column }: { lineNumber: number; column: number }) =>
          (offsets[lineNumber - 1] ?? 0) + column - 1,
        getPositionAt: (offset: number) => {
          const line = offsets.findLastIndex((start) => start <= offset);
          return { lineNumber: line + 1, column: offset - (offsets[line] ?? 0) + 1 };
        },
      }),
      getVisibleRanges: () => [{ startLineNumber: 1, endLineNumber: 2 }],
      getDomNode: () => this.node,
      onDidScrollChange: nothing,
      onDidLayoutChange: nothing,
      onDidChangeModelContent: nothing,
      onDidChangeHiddenAreas: nothing,
      deltaDecorations: (old: string[], added: editor.IModelDeltaDecoration[]) => {
        old.forEach((id) => this.decorations.delete(id));
        this.set += added.length;
        const ids = added.map((decoration) => {
          this.next += 1;
          this.decorations.set(String(this.next), decoration);
          return String(this.next);
        });
        this.render();
        return ids;
      },
    };
    return target as unknown as CodeEditor;
  }
}

const MONACO = {
  editor: { InjectedTextCursorStops: { None: 3 }, TrackedRangeStickiness: { NeverGrowsWhenTypingAtEdges: 1 } },
} as unknown as Monaco;

let board: ValueBoard;
let shown: Editor;
let monitor: InlineMonitor;
let frames: (() => void)[] = [];
/** What the monitor asks the runtime for. */
let watched: readonly string[] = [];

/** A frame of values as the server sends it, and the pictures that follow. */
async function receive(count: number, step: number, done: boolean): Promise<void> {
  const values = new Uint8Array(5);
  const view = new DataView(values.buffer);
  view.setInt16(0, count, true);
  view.setInt16(2, step, true);
  view.setUint8(4, done ? 1 : 0);
  board.receive({ subscription: 1, flags: 0, cycle: 1n, timestampNs: 0n, values });
  await pictures();
}

async function pictures(): Promise<void> {
  while (frames.length > 0) frames.splice(0).forEach((frame) => frame());
  await new Promise((resolve) => setTimeout(resolve));
}

beforeEach(async () => {
  vi.stubGlobal('requestAnimationFrame', (frame: () => void) => frames.push(frame));
  board = new ValueBoard({ now: () => performance.now(), soon: (callback) => void frames.push(callback) });
  board.open(1, ITEMS);
  shown = new Editor();
  watched = [];
  const update = (expressions: readonly string[]) => (watched = expressions);
  const channel = { board, watch: () => ({ update, release: () => undefined }) };
  monitor = new InlineMonitor(MONACO, shown.target(), channel as unknown as OnlineChannel, usesOf.implementation);
  monitor.set(SETTINGS);
  await receive(10, 5, false);
  shown.set = 0;
});
afterEach(() => {
  monitor.dispose();
  prepare('local', 'PRG.step', null);
  frames = [];
  vi.unstubAllGlobals();
});

describe('values behind the variables of a text', () => {
  it('stand behind each use, and go with the monitor', () => {
    expect(shown.shown()).toEqual(['10', '10', '5', 'FALSE']);
    monitor.dispose();
    expect(shown.decorations.size).toBe(0);
  });

  it('change in their elements: no decoration is set again for a value of the same width', async () => {
    await receive(99, 5, true);
    expect(shown.shown()).toEqual(['99', '99', '5', 'TRUE']);
    expect(shown.set).toBe(0);
    const done = shown.lines.children[3]!;
    expect([done.className.includes('true'), done.className.includes('false')]).toEqual([true, false]);
    expect(done.className.startsWith('mtk1')).toBe(true);
  });

  it('get another decoration when they need more room, and keep that room', async () => {
    await receive(100, 5, false);
    expect(shown.shown().sort()).toEqual(['100', '100', '5', 'FALSE']);
    expect(shown.set).toBe(2);
    await receive(7, 5, false);
    expect(shown.shown().sort()).toEqual(['5', '7', '7', 'FALSE']);
    expect(shown.set).toBe(2);
  });

  it('are the latest ones when Monaco draws a line again', async () => {
    await receive(42, 6, true);
    shown.render();
    await pictures();
    expect(shown.shown()).toEqual(['42', '42', '6', 'TRUE']);
    expect(shown.set).toBe(0);
  });

  it('are not asked for while another editor is in front', async () => {
    expect(new Set(watched)).toEqual(new Set(['PRG.count', 'PRG.step', 'PRG.done']));
    monitor.setVisible(false);
    expect(watched).toEqual([]);
    board.close(1);
    await pictures();
    expect(frames).toEqual([]);
    monitor.setVisible(true);
    expect(watched).toContain('PRG.count');
    board.open(2, ITEMS);
    board.receive({ subscription: 2, flags: 0, cycle: 2n, timestampNs: 0n, values: new Uint8Array([7, 0, 6, 0, 1]) });
    await pictures();
    expect(shown.shown().sort()).toEqual(['6', '7', '7', 'TRUE']);
  });

  it('get another decoration where a wrapped line has cut their element', async () => {
    shown.render(2);
    await pictures();
    await receive(98, 5, false);
    expect(shown.set).toBe(2);
    expect(shown.shown().slice(-2)).toEqual(['98', '98']);
  });

  it('show a prepared value by another decoration', async () => {
    prepare('local', 'PRG.step', '12');
    await pictures();
    expect(shown.set).toBe(1);
    const afters = [...shown.decorations.values()].flatMap(({ options }) => options.after?.content ?? []);
    expect(afters).toEqual(['<12>']);
  });

  it('touch nothing when no value has changed', async () => {
    const put = vi.spyOn(shown.lines.children[0]!.firstChild as Text, 'data', 'set');
    await receive(10, 5, false);
    expect(put).not.toHaveBeenCalled();
    expect(shown.set).toBe(0);
  });
});
