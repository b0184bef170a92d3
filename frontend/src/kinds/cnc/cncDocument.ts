/** The program in a Monaco model: text and table, markers, hovers and folds look at one and the same. */
import type { editor } from 'monaco-editor/editor/editor.api';
import { t } from '@/i18n';
import type { Monaco } from '@/text/monacoLoader';
import type { Conditions } from './checks';
import { changeOf, type LinesEdit } from './edits';
import { CncProgram, type PlacedFinding } from './program';
import { ORIGIN, type Position } from './state';

const MARKERS = 'cnc';
/** Lines that are checked at one go: some milliseconds. */
const AT_ONCE = 3000;
/** More marks help nobody, and the editor slows down with them. */
const MOST_SHOWN = 1000;
const PAUSE_MS = 120;
const UNKNOWN: Conditions = { velocity: 1, ready: false, suppress: false };

export class CncDocument {
  readonly program: CncProgram;
  /** Variables that have a value where no controller runs. */
  private names: readonly string[] = [];
  private findings: readonly PlacedFinding[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly listeners = new Set<() => void>();
  private count = 0;
  private readonly stop: () => void;

  constructor(
    private readonly monaco: Monaco,
    readonly model: editor.ITextModel,
    private readonly forget: () => void,
  ) {
    const source = { count: () => model.getLineCount(), line: (index: number) => model.getLineContent(index + 1) };
    this.program = new CncProgram(source, UNKNOWN, ORIGIN);
    const typing = model.onDidChangeContent((event) => this.changed(event));
    const ending = model.onWillDispose(() => this.dispose());
    this.stop = () => {
      typing.dispose();
      ending.dispose();
    };
    this.later(0);
  }

  /** Grows with every change of the text and of what is known of it. */
  get version(): number {
    return this.count;
  }

  get found(): readonly PlacedFinding[] {
    return this.findings;
  }

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };

  get offlineNames(): readonly string[] {
    return this.names;
  }

  /** The properties of the program have changed. */
  under(conditions: Conditions, start: Position, names: readonly string[]): void {
    this.names = names;
    this.program.under(conditions, start);
    this.later(0);
    this.tell();
  }

  lines(): string[] {
    return this.model.getLinesContent();
  }

  /** Edits that do not overlap, as Monaco takes them: only what differs is touched, so cursors stay. */
  operations(edits: readonly LinesEdit[]): editor.IIdentifiedSingleEditOperation[] {
    return edits.flatMap((edit) => this.operation(edit));
  }

  /** Carries out edits that do not overlap, as one step of the undo stack, or `joined` with those before. */
  apply(edits: readonly LinesEdit[], how: 'step' | 'joined' = 'step'): void {
    const operations = this.operations(edits);
    if (operations.length === 0) return;
    if (how === 'step') this.closeStep();
    this.model.pushEditOperations([], operations, () => null);
    if (how === 'step') this.closeStep();
  }

  /** What follows is another step of the undo stack. */
  closeStep(): void {
    this.model.pushStackElement();
  }

  private operation({ from, removed, lines }: LinesEdit): editor.IIdentifiedSingleEditOperation[] {
    const all = this.model.getLineCount();
    const length = Math.max(0, Math.min(removed, all - from));
    const before = Array.from({ length }, (_, at) => this.model.getLineContent(from + at + 1));
    const change = changeOf(before, lines, { first: from === 0, last: from + removed >= all });
    if (change === null) return [];
    const start = this.model.getOffsetAt(
      change.breakBefore
        ? { lineNumber: from, column: this.model.getLineMaxColumn(from) }
        : { lineNumber: from + 1, column: 1 },
    );
    const at = this.model.getPositionAt(start + change.start);
    const to = this.model.getPositionAt(start + change.end);
    return [{ range: new this.monaco.Range(at.lineNumber, at.column, to.lineNumber, to.column), text: change.text }];
  }

  private changed({ changes, isFlush }: editor.IModelContentChangedEvent): void {
    if (isFlush) this.program.edited(0, this.program.count, this.model.getLineCount());
    else
      // From the last to the first, so that the numbers of the lines before hold.
      for (const { range, text } of [...changes].sort((a, b) => b.rangeOffset - a.rangeOffset))
        this.program.edited(
          range.startLineNumber - 1,
          range.endLineNumber - range.startLineNumber + 1,
          text.split('\n').length,
        );
    this.later(PAUSE_MS);
    this.tell();
  }

  private later(ms: number): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.work(), ms);
  }

  private work(): void {
    if (!this.program.check(AT_ONCE)) {
      this.later(0);
      return;
    }
    this.findings = this.program.findings(MOST_SHOWN);
    this.show();
    this.tell();
  }

  /** The marks again, in the language of the user. */
  show(): void {
    const { Error: error, Warning: warning } = this.monaco.MarkerSeverity;
    this.monaco.editor.setModelMarkers(
      this.model,
      MARKERS,
      this.findings.map(({ rule, severity, line, at, end, values }) => ({
        severity: severity === 'error' ? error : warning,
        message: t(`cnc.message.${rule}`, values),
        code: rule,
        source: 'CNC',
        startLineNumber: line + 1,
        endLineNumber: line + 1,
        startColumn: at + 1,
        endColumn: Math.max(end, at + 1) + 1,
      })),
    );
  }

  private tell(): void {
    this.count += 1;
    this.listeners.forEach((listener) => listener());
  }

  private dispose(): void {
    clearTimeout(this.timer);
    this.stop();
    this.forget();
  }
}

const documents = new Map<string, CncDocument>();

/** The program in a model; it lives as long as that. */
export function openProgram(monaco: Monaco, model: editor.ITextModel): CncDocument {
  const uri = model.uri.toString();
  const known = documents.get(uri) ?? new CncDocument(monaco, model, () => documents.delete(uri));
  documents.set(uri, known);
  return known;
}

/** The program in a model that an editor shows. */
export function programOf(model: editor.ITextModel): CncDocument | undefined {
  return documents.get(model.uri.toString());
}

export function openPrograms(): readonly CncDocument[] {
  return [...documents.values()];
}
