/** Comparisons as data: the tree of what differs, and what of it is to be taken over. Pure functions. */
import type { ObjectSummary, Schemas } from '@/api/types';
import { displayPath } from '@/project/objectName';
import type { Checked } from '@/ui/ChoiceBox';

export type Comparison = Schemas['ComparisonDetail'];
export type Difference = Schemas['DifferenceItem'];
export type State = Difference['state'];
export type Ignoring = Readonly<Record<'white_space' | 'comments' | 'pragmas', boolean>>;

export const STATES: readonly State[] = ['changed', 'added', 'removed'];

/** The object as it is, or as it was when it is gone. */
export function sideOf(difference: Difference): Schemas['ComparedObject'] {
  return (difference.new ?? difference.old)!;
}

/** What is to be taken over of one object. */
export interface Choice {
  /** All of it; the rest is for parts. */
  readonly whole: boolean;
  readonly name: boolean;
  readonly place: boolean;
  readonly fields: readonly string[];
  /** Texts with single blocks taken over, by field. */
  readonly texts: Readonly<Record<string, string>>;
}

export type Choices = ReadonlyMap<string, Choice>;

export const NOTHING: Choice = { whole: false, name: false, place: false, fields: [], texts: {} };
export const EVERYTHING: Choice = { ...NOTHING, whole: true };

export type Part = 'name' | 'place' | { readonly field: string };

function isNothing({ whole, name, place, fields, texts }: Choice): boolean {
  return !whole && !name && !place && fields.length === 0 && Object.keys(texts).length === 0;
}

/** The choice of everything as one of parts, so that a part can be left out. */
function inParts(choice: Choice, difference: Difference): Choice {
  if (!choice.whole) return choice;
  const { renamed, moved, reordered, fields } = difference;
  return { whole: false, name: renamed, place: moved || reordered, fields, texts: {} };
}

/** The same choice, said shortly when nothing is left out of it. */
function asWhole(choice: Choice, difference: Difference): Choice {
  const all = inParts(EVERYTHING, difference);
  const complete =
    choice.name === all.name &&
    choice.place === all.place &&
    all.fields.every((field) => choice.fields.includes(field)) &&
    Object.keys(choice.texts).length === 0;
  return complete ? EVERYTHING : choice;
}

export function withChoice(choices: Choices, key: string, choice: Choice): Choices {
  const next = new Map(choices);
  if (isNothing(choice)) next.delete(key);
  else next.set(key, choice);
  return next;
}

/** Whether a part of an object is to be taken over. */
export function takes(choice: Choice, difference: Difference, part: Part): boolean {
  const parts = inParts(choice, difference);
  return typeof part === 'string' ? parts[part] : parts.fields.includes(part.field);
}

export function withPart(choice: Choice, difference: Difference, part: Part, taken: boolean): Choice {
  const parts = inParts(choice, difference);
  if (typeof part === 'string') return asWhole({ ...parts, [part]: taken }, difference);
  const { [part.field]: _, ...texts } = parts.texts;
  const others = parts.fields.filter((field) => field !== part.field);
  return asWhole({ ...parts, texts, fields: taken ? [...others, part.field] : others }, difference);
}

/** The text that a field will have. */
export function outcome(choice: Choice, difference: Difference, field: string, old: string, now: string): string {
  return choice.texts[field] ?? (takes(choice, difference, { field }) ? old : now);
}

/** The choice after a text was edited, by taking blocks over or by hand. */
export function withText(
  choice: Choice,
  difference: Difference,
  field: string,
  sides: { old: string; now: string },
  text: string,
): Choice {
  if (text === sides.old || text === sides.now)
    return withPart(choice, difference, { field }, text === sides.old && sides.old !== sides.now);
  const parts = inParts(choice, difference);
  const fields = parts.fields.filter((one) => one !== field);
  return { ...parts, fields, texts: { ...parts.texts, [field]: text } };
}

/** The request to take over what was chosen. */
export function order(choices: Choices, differences: readonly Difference[]): Schemas['TakenDifference'][] {
  return differences.flatMap((difference) => {
    const choice = choices.get(difference.key);
    if (choice === undefined) return [];
    const { whole, name, place, fields, texts } = choice;
    return [
      {
        key: difference.key,
        base_revision: difference.new?.revision ?? null,
        whole,
        name,
        place,
        fields: [...fields],
        texts: { ...texts },
      },
    ];
  });
}

export interface DiffRow {
  /** Path of the object, and names from the last row above it: what does not differ and has one child is one row. */
  readonly path: string;
  readonly name: string;
  readonly level: number;
  readonly difference: Difference | null;
  readonly kind: string | null;
  readonly subkind: string | null;
  readonly expandable: boolean;
  readonly expanded: boolean;
  /** Differences of the object and of all below it. */
  readonly keys: readonly string[];
}

interface Node {
  name: string;
  path: string;
  difference: Difference | null;
  children: Map<string, Node>;
}

function forestOf(differences: readonly Difference[]): Node {
  const root: Node = { name: '', path: '', difference: null, children: new Map() };
  for (const difference of differences) {
    const names = sideOf(difference).path.split('/');
    let node = root;
    names.forEach((name, at) => {
      // An object that was removed and one that was added may have the same path.
      const last = at === names.length - 1;
      const key = last && node.children.get(name)?.difference ? `${name}/${difference.key}` : name;
      let child = node.children.get(key);
      if (child === undefined) {
        child = { name, path: names.slice(0, at + 1).join('/'), difference: null, children: new Map() };
        node.children.set(key, child);
      }
      if (last) child.difference = difference;
      node = child;
    });
  }
  return root;
}

function keysOf(node: Node): string[] {
  const below = [...node.children.values()].flatMap(keysOf);
  return node.difference ? [node.difference.key, ...below] : below;
}

/** Rows to draw: what differs and matches the filter, in the objects that it stands in. */
export function diffRows(
  differences: readonly Difference[],
  closed: ReadonlySet<string>,
  known: ReadonlyMap<string, ObjectSummary>,
): DiffRow[] {
  const rows: DiffRow[] = [];
  const visit = (parent: Node, level: number) => {
    for (const first of parent.children.values()) {
      let node = first;
      let name = displayPath(node.name);
      while (node.difference === null && node.children.size === 1) {
        node = [...node.children.values()][0]!;
        if (node.difference !== null) break;
        name = `${name} / ${displayPath(node.name)}`;
      }
      if (node !== first && node.difference !== null) node = only(first, node);
      const expandable = node.children.size > 0;
      const expanded = expandable && !closed.has(node.path);
      const object = known.get(node.path);
      rows.push({
        path: node.path,
        name: node.difference ? displayPath(node.name) : name,
        level,
        difference: node.difference,
        kind: node.difference?.kind ?? object?.kind ?? null,
        subkind: node.difference ? node.difference.subkind : (object?.subkind ?? null),
        expandable,
        expanded,
        keys: keysOf(node),
      });
      if (expanded) visit(node, level + 1);
    }
  };
  visit(forestOf(differences), 1);
  return rows;
}

/** The last node of a chain before the one that differs. */
function only(first: Node, differing: Node): Node {
  let node = first;
  for (;;) {
    const [next] = node.children.values();
    if (next === undefined || next === differing) return node;
    node = next;
  }
}

/** Those that are shown: by state, and by what their path holds. */
export function filtered(
  differences: readonly Difference[],
  hidden: ReadonlySet<State>,
  search: string,
): readonly Difference[] {
  const text = search.trim().toLowerCase();
  return differences.filter(
    (one) =>
      !hidden.has(one.state) &&
      (sideOf(one).path.toLowerCase().includes(text) || one.old?.name.toLowerCase().includes(text)),
  );
}

/** How the box of a row looks. */
export function checkedOf(keys: readonly string[], choices: Choices): Checked {
  if (keys.every((key) => choices.get(key)?.whole)) return 'all';
  return keys.some((key) => choices.has(key)) ? 'some' : 'none';
}

/** The choices after a click on the box of a row: all of it, or nothing when all was chosen. */
export function toggled(keys: readonly string[], choices: Choices): Choices {
  const choice = checkedOf(keys, choices) === 'all' ? NOTHING : EVERYTHING;
  return keys.reduce((next, key) => withChoice(next, key, choice), choices);
}

/** Lines that differ, as Monaco counts them: from 1; an end of 0 means that there are none on that side. */
export interface LineChange {
  readonly originalStartLineNumber: number;
  readonly originalEndLineNumber: number;
  readonly modifiedStartLineNumber: number;
  readonly modifiedEndLineNumber: number;
}

/** The lines of `modified` to replace (from 0, end excluded) and those of `original` that take their place. */
export function takenBlock(original: string, modified: string, change: LineChange): string {
  const lines = original.split('\n');
  const mine = modified.split('\n');
  const block =
    change.originalEndLineNumber === 0
      ? []
      : lines.slice(change.originalStartLineNumber - 1, change.originalEndLineNumber);
  const [start, end] =
    change.modifiedEndLineNumber === 0
      ? [change.modifiedStartLineNumber, change.modifiedStartLineNumber]
      : [change.modifiedStartLineNumber - 1, change.modifiedEndLineNumber];
  return [...mine.slice(0, start), ...block, ...mine.slice(end)].join('\n');
}

/** The change that a line of the modified text is in, or the next one behind it; the first one at the end. */
export function changeAt<Change extends LineChange>(changes: readonly Change[], line: number): Change | undefined {
  const end = (one: Change) => Math.max(one.modifiedEndLineNumber, one.modifiedStartLineNumber);
  return changes.find((one) => end(one) >= line) ?? changes[0];
}
