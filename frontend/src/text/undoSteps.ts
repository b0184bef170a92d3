/**
 * The undo steps of texts, kept in this browser so that Ctrl+Z goes back over edits made before the page was
 * reloaded. They count only for the very text that they lead to: when somebody else has changed it since, they are
 * dropped, so undo never takes back what others did.
 */
import { smallestChange } from '@/iec/declaration/text';
import type { DraftStorage } from './drafts';

/** At an offset, `inserted` took the place of `removed`. */
export interface Step {
  readonly at: number;
  readonly removed: string;
  readonly inserted: string;
}

/** Steps of a text of this length and check sum. */
export interface StepsOfText {
  readonly length: number;
  readonly sum: string;
  readonly steps: readonly Step[];
}

const MOST_STEPS = 300;
const MOST_CHARACTERS = 150_000;
/** Typing that goes on within this time is one step, as in the editor. */
const PAUSE_MS = 900;

/** FNV-1a over the characters, twice with other seeds: 64 bits tell two texts of one object apart. */
export function checkSum(text: string): string {
  let [a, b] = [0x811c9dc5, 0x9e3779b9];
  for (let i = 0; i < text.length; i++) {
    const code = text.charCodeAt(i);
    a = Math.imul(a ^ code, 0x01000193);
    b = Math.imul(b ^ code, 0x85ebca6b) ^ (b >>> 13);
  }
  return `${(a >>> 0).toString(16)}${(b >>> 0).toString(16)}`;
}

function back(text: string, { at, removed, inserted }: Step): string | null {
  if (text.slice(at, at + inserted.length) !== inserted) return null;
  return text.slice(0, at) + removed + text.slice(at + inserted.length);
}

/** The text before all steps; null when they do not lead to this text. */
export function textBefore(text: string, kept: StepsOfText): string | null {
  if (kept.length !== text.length || kept.sum !== checkSum(text)) return null;
  return [...kept.steps].reverse().reduce<string | null>((now, step) => (now === null ? null : back(now, step)), text);
}

/** The steps of one text while it is being edited. */
export class UndoSteps {
  private steps: Step[];
  private last = -Infinity;

  constructor(steps: readonly Step[] = []) {
    this.steps = [...steps];
  }

  get length(): number {
    return this.steps.length;
  }

  /** The text was edited; `undone` when the editor went back over a step. */
  edited(before: string, after: string, now: number, undone = false): void {
    if (undone && this.wentBack(before, after)) return;
    const change = smallestChange(before, after);
    if (change === null) return;
    const step = { at: change.start, removed: before.slice(change.start, change.end), inserted: change.text };
    const previous = this.steps.at(-1);
    const goesOn =
      previous !== undefined &&
      now - this.last < PAUSE_MS &&
      step.removed === '' &&
      previous.removed === '' &&
      step.at === previous.at + previous.inserted.length &&
      !previous.inserted.endsWith('\n');
    if (goesOn) this.steps[this.steps.length - 1] = { ...previous, inserted: previous.inserted + step.inserted };
    else this.steps.push(step);
    this.last = now;
    this.shorten();
  }

  /** Somebody else has changed the text: what was before it is out of reach. */
  clear(): void {
    this.steps = [];
  }

  of(text: string): StepsOfText {
    return { length: text.length, sum: checkSum(text), steps: [...this.steps] };
  }

  /** Whether `after` is what some of the last steps began with; they are gone then. */
  private wentBack(before: string, after: string): boolean {
    let text: string | null = before;
    for (let count = 1; count <= this.steps.length; count++) {
      text = back(text, this.steps[this.steps.length - count]!);
      if (text === null) return false;
      if (text !== after) continue;
      this.steps = this.steps.slice(0, -count);
      this.last = -Infinity;
      return true;
    }
    return false;
  }

  private shorten(): void {
    let characters = 0;
    let kept = 0;
    for (const { removed, inserted } of [...this.steps].reverse()) {
      characters += removed.length + inserted.length;
      if (characters > MOST_CHARACTERS || kept >= MOST_STEPS) break;
      kept++;
    }
    if (kept < this.steps.length) this.steps = this.steps.slice(this.steps.length - kept);
  }
}

const PREFIX = 'tappet.undo.';
const MOST_OBJECTS = 60;

interface Kept<Value> {
  savedAt: number;
  value: Value;
}

/** What goes into the storage of the browser, by user and object; the oldest entries go when there are many. */
export class KeptSteps<Value> {
  constructor(
    private readonly storage: DraftStorage,
    private readonly accepts: (value: unknown) => value is Value,
  ) {}

  private key(user: string, projectId: string, objectId: string): string {
    return `${PREFIX}${user}.${projectId}.${objectId}`;
  }

  read(user: string, projectId: string, objectId: string): Value | null {
    const value = parsed(this.storage.getItem(this.key(user, projectId, objectId)))?.value;
    return this.accepts(value) ? value : null;
  }

  /** Null: there are no steps. Without room in the browser the steps live in this page alone. */
  write(user: string, projectId: string, objectId: string, value: Value | null, now: number): void {
    const key = this.key(user, projectId, objectId);
    if (value === null) {
      this.storage.removeItem(key);
      return;
    }
    this.forgetOldest();
    try {
      this.storage.setItem(key, JSON.stringify({ savedAt: now, value } satisfies Kept<Value>));
    } catch {
      this.storage.removeItem(key);
    }
  }

  private forgetOldest(): void {
    const keys = Array.from({ length: this.storage.length }, (_, i) => this.storage.key(i) ?? '');
    const own = keys.filter((key) => key.startsWith(PREFIX));
    if (own.length <= MOST_OBJECTS) return;
    const ages = own.map((key) => ({ key, savedAt: parsed(this.storage.getItem(key))?.savedAt ?? 0 }));
    ages.sort((a, b) => a.savedAt - b.savedAt);
    ages.slice(0, own.length - MOST_OBJECTS).forEach(({ key }) => this.storage.removeItem(key));
  }
}

function parsed(text: string | null): Kept<unknown> | null {
  if (text === null) return null;
  try {
    const kept = JSON.parse(text) as Partial<Kept<unknown>> | null;
    return typeof kept?.savedAt === 'number' ? (kept as Kept<unknown>) : null;
  } catch {
    return null;
  }
}

/** The steps of both texts of an object. */
export interface StepsOfParts {
  readonly declaration: StepsOfText;
  readonly implementation: StepsOfText;
}

function isSteps(value: unknown): value is StepsOfText {
  const kept = value as Partial<StepsOfText> | null;
  return (
    typeof kept?.length === 'number' &&
    typeof kept.sum === 'string' &&
    Array.isArray(kept.steps) &&
    kept.steps.every(
      (step: Partial<Step> | null) =>
        typeof step?.at === 'number' && typeof step.removed === 'string' && typeof step.inserted === 'string',
    )
  );
}

export function isStepsOfParts(value: unknown): value is StepsOfParts {
  const kept = value as Partial<StepsOfParts> | null;
  return isSteps(kept?.declaration) && isSteps(kept.implementation);
}
