/** Objects to choose from, as a tree with a box for each. Pure functions. */
import type { ObjectSummary } from '@/api/types';
import { displayName } from '@/project/objectName';
import { childrenOf, forestOf, rootsOf, subtree } from '@/project/tree';
import type { Checked } from '@/ui/ChoiceBox';

/** An object of a project, or of the files of an import. */
export interface ChoiceNode extends Pick<ObjectSummary, 'kind' | 'subkind' | 'name' | 'excluded'> {
  readonly key: string;
  readonly parent: string | null;
}

export interface NodeForest<Node extends ChoiceNode = ChoiceNode> {
  /** Parents before what stands in them. */
  nodes: readonly Node[];
  children: ReadonlyMap<string | null, readonly Node[]>;
}

export function nodeForest<Node extends ChoiceNode>(nodes: readonly Node[]): NodeForest<Node> {
  const children = new Map<string | null, Node[]>();
  for (const node of nodes) {
    const list = children.get(node.parent);
    if (list) list.push(node);
    else children.set(node.parent, [node]);
  }
  return { nodes, children };
}

function below(forest: NodeForest, key: string): ChoiceNode[] {
  const found: ChoiceNode[] = [];
  const waiting = [...(forest.children.get(key) ?? [])];
  for (let node = waiting.shift(); node; node = waiting.shift()) {
    found.push(node);
    waiting.push(...(forest.children.get(node.key) ?? []));
  }
  return found;
}

/** The choice after a click on the box of a node: all of it, or none when all was chosen. */
export function toggled(forest: NodeForest, chosen: ReadonlySet<string>, key: string): ReadonlySet<string> {
  const keys = [key, ...below(forest, key).map((node) => node.key)];
  const next = new Set(chosen);
  const all = keys.every((one) => chosen.has(one));
  for (const one of keys) {
    if (all) next.delete(one);
    else next.add(one);
  }
  return next;
}

/** How the box of each node looks: itself with all below it, something of it, nothing. */
export function checkedOf(forest: NodeForest, chosen: ReadonlySet<string>): ReadonlyMap<string, Checked> {
  const state = new Map<string, Checked>();
  for (const node of [...forest.nodes].reverse()) {
    const states = (forest.children.get(node.key) ?? []).map((child) => state.get(child.key));
    if (chosen.has(node.key)) state.set(node.key, states.every((one) => one === 'all') ? 'all' : 'some');
    else state.set(node.key, states.some((one) => one !== 'none') ? 'some' : 'none');
  }
  return state;
}

export interface NodeRow<Node extends ChoiceNode = ChoiceNode> {
  node: Node;
  level: number;
  expandable: boolean;
  expanded: boolean;
}

/** Rows to draw; with a search the nodes that match, and what they stand in. */
export function nodeRows<Node extends ChoiceNode>(
  forest: NodeForest<Node>,
  closed: ReadonlySet<string>,
  search: string,
): NodeRow<Node>[] {
  const text = search.trim().toLowerCase();
  const shown = text ? new Set<string>() : null;
  if (shown) {
    const parents = new Map(forest.nodes.map((node) => [node.key, node.parent]));
    for (const node of forest.nodes) {
      if (!node.name.toLowerCase().includes(text)) continue;
      for (let key: string | null | undefined = node.key; key; key = parents.get(key)) shown.add(key);
    }
  }
  const rows: NodeRow<Node>[] = [];
  const visit = (parent: string | null, level: number) => {
    for (const node of forest.children.get(parent) ?? []) {
      if (shown && !shown.has(node.key)) continue;
      const expandable = forest.children.has(node.key);
      const expanded = expandable && (shown !== null || !closed.has(node.key));
      rows.push({ node, level, expandable, expanded });
      if (expanded) visit(node.key, level + 1);
    }
  };
  visit(null, 1);
  return rows;
}

export interface ProjectNode extends ChoiceNode {
  readonly path: string;
}

/** The objects of a project in the order of its trees, devices first. */
export function projectForest(objects: readonly ObjectSummary[]): NodeForest<ProjectNode> {
  const forest = forestOf(objects);
  const nodes: ProjectNode[] = [];
  const visit = (found: readonly ObjectSummary[], parent: string | null, above: string) => {
    for (const object of found) {
      const { id, kind, subkind, excluded } = object;
      const name = displayName(object);
      const path = above + name;
      nodes.push({ key: id, parent, name, kind, subkind, excluded, path });
      visit(childrenOf(forest, id), id, `${path}/`);
    }
  };
  for (const view of ['devices', 'pous'] as const) visit(rootsOf(forest, view), null, '');
  return nodeForest(nodes);
}

/** The ids of objects with all below them. */
export function withAllBelow(objects: readonly ObjectSummary[], tops: readonly ObjectSummary[]): ReadonlySet<string> {
  const forest = forestOf(objects);
  return new Set(tops.flatMap(({ id }) => subtree(forest, id).map((object) => object.id)));
}

/** Names of a choice as requests take them, few even of many objects: those where a line from a root changes. */
export function requestOf(forest: NodeForest, chosen: ReadonlySet<string>): { object: string[]; without: string[] } {
  const request = { object: [] as string[], without: [] as string[] };
  const visit = (parent: string | null, given: boolean) => {
    for (const { key } of forest.children.get(parent) ?? []) {
      const taken = chosen.has(key);
      if (taken !== given) (taken ? request.object : request.without).push(key);
      visit(key, taken);
    }
  };
  visit(null, false);
  return request;
}
