/**
 * Values behind the variables of the visible lines of one Monaco editor; `findUses` tells which stand in a text.
 *
 * Asks for what is on screen (and a little around it). A value that keeps its width is written into the element that
 * Monaco has drawn; only another width, or a prepared value, makes another decoration.
 */
import type { editor, IDisposable } from 'monaco-editor/editor/editor.api';
import type { LiveValue } from '@/online/board';
import type { GroupHandle, OnlineChannel } from '@/online/channel';
import type { NumberFormat } from '@/text/settings';
import { FRESH_MS } from '@/online/freshMarks';
import { expressionKey } from '@/online/item';
import { usePrepared } from '@/online/prepared';
import { isForced } from '@/online/useLive';
import { useOnline } from '@/workbench/onlineSession';
import type { CodeEditor } from '@/text/CodePane';
import type { Monaco } from '@/text/monacoLoader';
import { expressionOf, indexExpressions, type MonitorScope, type VariableUse } from '@/iec/variables';
import styles from './inlineMonitor.module.css';
import { newPillName, PillElements } from './pillElements';
import { executedText, pillOf, PillWidths, type Pill } from './pills';

export interface MonitorSettings {
  readonly runtimeId: string;
  readonly scope: MonitorScope;
  readonly format: NumberFormat;
  readonly lost: boolean;
  /** For each line whether it is the running one; null when all are. */
  readonly running: readonly boolean[] | null;
}

/** What the statements of a body left in their variables, where flow control knows it. */
export interface ExecutedValues {
  valueAt: (line: number, name: string) => string | null;
}

/** Attached to the text of a pill, so that a click on it is known. */
export interface PillTarget {
  readonly expression: string;
}

interface ShownUse {
  readonly use: VariableUse;
  /** As it is written. */
  readonly name: string;
  /** Null where it has no value between two cycles. */
  readonly expression: string | null;
  readonly line: number;
  readonly column: number;
}

interface DrawnPill {
  /** Number of its decoration, and the class of its element. */
  readonly id: string;
  readonly name: string;
  /** What Monaco lays out: another one needs another decoration. */
  readonly shape: string;
  look: string;
}

/** Classes that a pill has by turns. */
const LOOKS: ReadonlySet<string> = new Set(
  ['true', 'false', 'fresh', 'forced', 'lost', 'stale', 'executed'].map((look) => styles[look] ?? look),
);
const AROUND_LINES = 20;
const MOST_USES = 1500;

export class InlineMonitor {
  private text = '';
  private uses: readonly VariableUse[] = [];
  private shown: readonly ShownUse[] = [];
  private readonly widths = new PillWidths();
  /** What is drawn, by line and column of its place. */
  private readonly drawn = new Map<string, DrawnPill>();
  private readonly elements: PillElements;
  private readonly group: GroupHandle;
  private readonly disposables: IDisposable[] = [];
  private readonly stops: (() => void)[] = [];
  private listening: (() => void)[] = [];
  private listened = '';
  private frame = 0;
  private fading: ReturnType<typeof setTimeout> | undefined;
  /** Lines that were visible when it was last looked at what is on screen. */
  private lookedAt = { first: 0, last: 0 };
  /** Nothing is shown before the first settings. */
  private settings: MonitorSettings | null = null;
  private executed: ExecutedValues | null = null;
  private visible = true;

  constructor(
    private readonly monaco: Monaco,
    private readonly target: CodeEditor,
    private readonly channel: OnlineChannel,
    private readonly findUses: (text: string) => readonly VariableUse[],
  ) {
    this.group = channel.watch([], 100);
    const lines = target.getDomNode()?.querySelector<HTMLElement>('.view-lines');
    this.elements = new PillElements(lines ?? document.createElement('div'), styles.pill ?? 'pill', LOOKS);
    this.disposables.push(
      target.onDidScrollChange((event) => event.scrollTopChanged && this.scrolled()),
      target.onDidLayoutChange(() => this.look()),
      target.onDidChangeModelContent(() => this.read()),
      target.onDidChangeHiddenAreas(() => this.look()),
    );
    this.stops.push(
      usePrepared.subscribe(() => this.redraw()),
      useOnline.subscribe((now, before) => now.forces !== before.forces && this.redraw()),
    );
    this.read();
  }

  set(settings: MonitorSettings): void {
    this.settings = settings;
    this.look();
  }

  /** Values of flow control take the place of those between two cycles. */
  setExecuted(executed: ExecutedValues | null): void {
    if (this.executed === executed) return;
    this.executed = executed;
    this.redraw();
  }

  /** Whether the editor is in front of its group: no value is asked for in one that is not. */
  setVisible(visible: boolean): void {
    if (this.visible === visible) return;
    this.visible = visible;
    this.look();
  }

  /** The variable of the line that stands at the cursor and has a value. */
  atCursor(): PillTarget | null {
    const position = this.target.getPosition();
    const offset = position === null ? undefined : this.target.getModel()?.getOffsetAt(position);
    if (offset === undefined) return null;
    for (const { use, expression } of this.shown)
      if (expression !== null && use.start <= offset && offset <= use.end) return { expression };
    return null;
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    clearTimeout(this.fading);
    this.disposables.forEach((disposable) => disposable.dispose());
    this.stops.forEach((stop) => stop());
    this.listening.forEach((stop) => stop());
    this.group.release();
    this.elements.dispose();
    this.target.deltaDecorations(
      [...this.drawn.values()].map(({ id }) => id),
      [],
    );
  }

  /** The text has changed: find its variables again. */
  private read(): void {
    const model = this.target.getModel();
    this.text = model?.getValue() ?? '';
    this.uses = this.findUses(this.text);
    // Decorations have moved with the text: each is set where it belongs now.
    for (const [place, pill] of this.drawn) this.drawn.set(place, { ...pill, shape: '' });
    this.look();
  }

  private readonly indexValue = (expression: string): number | null => {
    const value = this.channel.board.get(expression)?.value;
    return typeof value === 'number' ? value : typeof value === 'bigint' ? Number(value) : null;
  };

  private visibleLines(): { first: number; last: number } {
    const ranges = this.target.getVisibleRanges();
    return { first: ranges[0]?.startLineNumber ?? 1, last: ranges[ranges.length - 1]?.endLineNumber ?? 1 };
  }

  /** The lines around what was on screen are watched already: a few lines more change nothing. */
  private scrolled(): void {
    const { first, last } = this.visibleLines();
    const near = (line: number, before: number) => Math.abs(line - before) < AROUND_LINES / 2;
    if (!near(first, this.lookedAt.first) || !near(last, this.lookedAt.last)) this.look();
  }

  /** Scrolled, resized or other settings: what is on screen and what has to be asked for. */
  private look(): void {
    const model = this.target.getModel();
    const settings = this.settings;
    if (model === null || settings === null) return;
    this.lookedAt = this.visibleLines();
    const ranges = this.target.getVisibleRanges();
    const visible = (line: number) =>
      ranges.some((r) => line >= r.startLineNumber - AROUND_LINES && line <= r.endLineNumber + AROUND_LINES);
    const first = model.getOffsetAt({
      lineNumber: Math.max(1, (ranges[0]?.startLineNumber ?? 1) - AROUND_LINES),
      column: 1,
    });
    const shown: ShownUse[] = [];
    const wanted: string[] = [];
    for (const use of this.uses) {
      if (use.end < first) continue;
      const { lineNumber: line, column } = model.getPositionAt(use.end);
      if (!visible(line)) {
        if (line > (ranges[ranges.length - 1]?.endLineNumber ?? 1) + AROUND_LINES) break;
        continue;
      }
      wanted.push(...indexExpressions(use.path, settings.scope, this.indexValue));
      const expression = expressionOf(use.path, settings.scope, this.indexValue);
      if (expression !== null) wanted.push(expression);
      shown.push({ use, name: this.text.slice(use.start, use.end), expression, line, column });
      if (shown.length >= MOST_USES) break;
    }
    this.shown = shown;
    const watched = this.visible ? wanted : [];
    this.group.update(watched);
    this.listen(watched, settings.scope);
    this.redraw();
  }

  private listen(expressions: readonly string[], scope: MonitorScope): void {
    const keys = [...new Set(expressions.map(expressionKey))].sort();
    const all = keys.join('\n');
    if (all === this.listened) return;
    this.listened = all;
    this.listening.forEach((stop) => stop());
    const indices = new Set(
      this.uses.flatMap((use) => indexExpressions(use.path, scope, this.indexValue)).map(expressionKey),
    );
    // A moved index means another element: what is asked for changes with it.
    this.listening = keys.map((key) => this.channel.board.subscribe(key, indices.has(key) ? this.moved : this.redraw));
  }

  private readonly moved = () => this.look();

  private readonly redraw = () => {
    if (this.frame !== 0) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.draw();
    });
  };

  private draw(): void {
    const { settings } = this;
    if (settings === null) return;
    const now = performance.now();
    let freshUntil = 0;
    const present = new Set<string>();
    const outdated: string[] = [];
    const changed: { place: string; pill: Omit<DrawnPill, 'id'>; decoration: editor.IModelDeltaDecoration }[] = [];
    for (const use of this.shown) {
      const { expression, line, column } = use;
      const live = expression === null ? null : this.channel.board.get(expression);
      const pill = this.pillOf(use, live, settings, now);
      if (pill === null) continue;
      if (pill.classes.includes('fresh')) freshUntil = Math.max(freshUntil, (live?.changedAt ?? 0) + FRESH_MS);
      const place = `${String(line)}.${String(column)}`;
      present.add(place);
      const classes = pill.classes.map((each) => styles[each] ?? each);
      const look = `${pill.text} ${classes.join(' ')}`;
      const shape = `${expression ?? ''} ${String(pill.text.length)} ${pill.prepared ?? ''}`;
      const before = this.drawn.get(place);
      if (before?.shape === shape) {
        if (before.look === look) continue;
        before.look = look;
        if (this.elements.write(before.name, pill.text, classes)) continue;
      }
      if (before !== undefined) this.outdate(before, outdated);
      const name = newPillName();
      this.elements.made(name, pill.text, classes);
      const target = expression === null ? null : { expression };
      const decoration = this.decoration(target, { ...pill, classes: [...classes, name] }, line, column);
      changed.push({ place, pill: { name, shape, look }, decoration });
    }
    for (const [place, pill] of this.drawn) {
      if (present.has(place)) continue;
      this.outdate(pill, outdated);
      this.drawn.delete(place);
    }
    if (outdated.length > 0 || changed.length > 0) {
      const ids = this.target.deltaDecorations(
        outdated,
        changed.map(({ decoration }) => decoration),
      );
      changed.forEach(({ place, pill }, at) => this.drawn.set(place, { ...pill, id: ids[at] ?? '' }));
    }
    clearTimeout(this.fading);
    if (freshUntil > 0) this.fading = setTimeout(this.redraw, freshUntil - now + 20);
  }

  private pillOf(use: ShownUse, live: LiveValue | null, settings: MonitorSettings, now: number): Pill | null {
    const { runtimeId, format, lost, running } = settings;
    const key = use.expression === null ? '' : expressionKey(use.expression);
    const executed = this.executed?.valueAt(use.line, use.name) ?? null;
    let width = 0;
    if (executed !== null) {
      const place = `executed ${format} ${String(use.line)}.${String(use.column)}`;
      width = this.widths.widthOfExecuted(place, executedText(executed, live, format));
    } else if (live !== null) width = this.widths.widthOf(key, live, format);
    const state = {
      live,
      executed,
      forced: live !== null && isForced(live.item, useOnline.getState().forcedPlaces[runtimeId]),
      prepared: usePrepared.getState().values[runtimeId]?.[key]?.literal ?? null,
      lost,
      stale: running !== null && running[use.line - 1] === false,
      now,
      format,
    };
    return pillOf(state, width);
  }

  private outdate(pill: DrawnPill, ids: string[]): void {
    ids.push(pill.id);
    this.elements.forget(pill.name);
  }

  private decoration(
    attachedData: PillTarget | null,
    pill: { text: string; classes: readonly string[]; prepared: string | null },
    line: number,
    column: number,
  ): editor.IModelDeltaDecoration {
    const { None } = this.monaco.editor.InjectedTextCursorStops;
    const injected = (content: string, inlineClassName: string): editor.InjectedTextOptions => ({
      content,
      inlineClassName,
      inlineClassNameAffectsLetterSpacing: true,
      cursorStops: None,
      attachedData,
    });
    return {
      range: { startLineNumber: line, startColumn: column, endLineNumber: line, endColumn: column },
      options: {
        showIfCollapsed: true,
        stickiness: this.monaco.editor.TrackedRangeStickiness.NeverGrowsWhenTypingAtEdges,
        before: injected(pill.text, pill.classes.join(' ')),
        ...(pill.prepared !== null && { after: injected(pill.prepared, styles.prepared ?? '') }),
      },
    };
  }
}
