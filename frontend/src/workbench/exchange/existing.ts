/** Objects of an import whose names exist already: what becomes of each. Pure functions. */
import type { ImportEntry, ImportNode } from '@/api/types';
import type { NodeForest } from './choice';

export type ExistingAct = NonNullable<ImportNode['existing']>['acts'][number];
export const ACTS = ['rename', 'overwrite', 'merge', 'skip'] as const satisfies readonly ExistingAct[];

/** The form field `existing` of an import. */
interface Decisions {
  all: ExistingAct;
  objects: Record<string, { act: ExistingAct; name: string | null; texts: Record<string, string> }>;
}

/** What the user has decided for one object; fields that are not set follow the rest. */
export interface Choice {
  act?: ExistingAct;
  name?: string;
  /** What the user has made of the texts of both sides. */
  texts?: Record<string, string>;
}

export interface Choices {
  all: ExistingAct;
  one: ReadonlyMap<string, Choice>;
}

export const NOTHING_CHOSEN: Choices = { all: 'rename', one: new Map() };

export interface ExistingRow {
  node: ImportNode;
  existing: NonNullable<ImportNode['existing']>;
  act: ExistingAct;
  name: string;
  joined: boolean;
}

/**
 * The objects to decide on, those below another one behind it. What is below an object that comes in under another name
 * exists nowhere; what is below one that was decided on follows it.
 */
export function existingRows(
  forest: NodeForest<ImportNode>,
  chosen: ReadonlySet<string>,
  choices: Choices,
): ExistingRow[] {
  const rows: ExistingRow[] = [];
  const visit = (parent: string | null, given: ExistingAct | null) => {
    for (const node of forest.children.get(parent) ?? []) {
      const { existing } = node;
      if (!existing) {
        visit(node.key, given);
        continue;
      }
      const own = choices.one.get(node.key);
      const wanted = own?.act ?? given ?? (existing.same ? 'skip' : choices.all);
      const act = existing.acts.includes(wanted) ? wanted : existing.acts[0]!;
      const isChosen = chosen.has(node.key);
      if (isChosen)
        rows.push({
          node,
          existing,
          act,
          name: own?.name ?? existing.proposal,
          joined: act === 'merge' && own?.texts !== undefined,
        });
      if (!isChosen || act !== 'rename') visit(node.key, own?.act ? act : given);
    }
  };
  visit(null, null);
  return rows;
}

/** The decisions as the server takes them. */
export function decisionsOf(rows: readonly ExistingRow[], choices: Choices): Decisions {
  const objects = rows.map(({ node, act, name }) => {
    const texts = act === 'merge' ? choices.one.get(node.key)?.texts : undefined;
    return [node.key, { act, name: act === 'rename' ? name.trim() : null, texts: texts ?? {} }] as const;
  });
  return { all: choices.all, objects: Object.fromEntries(objects) };
}

/** Rows whose new names are empty, those of the objects that are there, or given twice; the server knows the rest. */
export function wrongNames(rows: readonly ExistingRow[], taken: (row: ExistingRow, name: string) => boolean) {
  const wrong = new Set<string>();
  const seen = new Map<string, string>();
  for (const row of rows) {
    if (row.act !== 'rename') continue;
    const name = row.name.trim().toLowerCase();
    const twin = seen.get(name);
    if (!name || taken(row, name)) wrong.add(row.node.key);
    if (twin !== undefined) [twin, row.node.key].forEach((key) => wrong.add(key));
    seen.set(name, row.node.key);
  }
  return wrong;
}

/** What a preview has to say besides objects that exist: what becomes of these is decided in the preview. */
export function undecidedEntries(entries: readonly ImportEntry[], nodes: readonly ImportNode[]): ImportEntry[] {
  const decided = new Set(
    nodes.filter(({ existing }) => existing).map((node) => `${node.source}:${node.line}:${node.name}`),
  );
  return entries.filter(
    ({ outcome, source, line, object }) => outcome !== 'imported' && !decided.has(`${source}:${line}:${object}`),
  );
}

export function withChoice(choices: Choices, key: string, choice: Choice): Choices {
  return { ...choices, one: new Map(choices.one).set(key, { ...choices.one.get(key), ...choice }) };
}
