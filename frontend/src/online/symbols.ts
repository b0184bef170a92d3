/**
 * The variables of the loaded application as a tree, asked for level by level.
 *
 * Two structures of one type have the same components, so each type is asked for once, whatever its instances;
 * all instances of a function block are found from the types alone.
 */
import { api } from '@/api/client';
import type { Schemas } from '@/api/types';

/** What lies below a path, as the server lists it. */
export type SymbolChild = Readonly<Schemas['Symbol']>;

export type SymbolSource = (path: string) => Promise<readonly SymbolChild[]>;

/** What has components of its own, other than those of its type. */
const ROOT_KINDS = new Set(['program', 'gvl', 'part']);

/** The array that a part `a[1000..1999]` is of; any other path as it is. */
export function wholeArray(path: string): string {
  return path.replace(/\[[^[\]]*\.\.[^[\]]*\]$/, '');
}

export class SymbolTree {
  private readonly byType = new Map<string, Promise<readonly SymbolChild[]>>();
  private roots: Promise<readonly SymbolChild[]> | null = null;
  /** Types of paths seen so far, by upper-case path. */
  private readonly known = new Map<string, SymbolChild>();

  constructor(private readonly source: SymbolSource) {}

  /** Programs and variable lists. */
  top(): Promise<readonly SymbolChild[]> {
    this.roots ??= this.source('').then((roots) => this.remember(roots));
    this.roots.catch(() => (this.roots = null));
    return this.roots;
  }

  /** Components of the variable at `path`; an empty list for a path without any. */
  async children(path: string): Promise<readonly SymbolChild[]> {
    if (path === '') return this.top();
    const own = this.known.get(path.toUpperCase());
    if (own === undefined) return this.remember(await this.source(path));
    if (own.leaf) return [];
    const key = ROOT_KINDS.has(own.kind) ? `${own.kind} ${own.path}` : own.type;
    const above = wholeArray(own.path);
    let asked = this.byType.get(key);
    if (asked === undefined) {
      asked = this.source(own.path).then((children) =>
        children.map((child) => ({ ...child, path: child.path.slice(above.length) })),
      );
      this.byType.set(key, asked);
      asked.catch(() => this.byType.delete(key));
    }
    return this.remember((await asked).map((child) => ({ ...child, path: above + child.path })));
  }

  /** Paths of all instances of a function block or structure type, in order of the tree; at most `most`. */
  async instancesOf(type: string, most = 500): Promise<readonly string[]> {
    const wanted = type.toUpperCase();
    const found: string[] = [];
    const holds = new Map<string, boolean>();
    const visit = async (child: SymbolChild, depth: number): Promise<boolean> => {
      if (child.leaf || depth > 12 || found.length >= most) return false;
      const own = child.type.toUpperCase() === wanted;
      if (own) found.push(child.path);
      // A type whose first instance held none holds none anywhere.
      const key = ROOT_KINDS.has(child.kind) ? child.path : child.type;
      if (holds.get(key) === false) return own;
      let inside = false;
      for (const next of await this.children(child.path)) if (await visit(next, depth + 1)) inside = true;
      holds.set(key, inside);
      return own || inside;
    };
    for (const root of await this.top()) await visit(root, 0);
    return found;
  }

  private remember(children: readonly SymbolChild[]): readonly SymbolChild[] {
    for (const child of children) this.known.set(child.path.toUpperCase(), child);
    return children;
  }
}

const trees = new Map<string, { codeId: string | null; tree: SymbolTree }>();

/** The tree of a runtime; a new one when its application has changed. */
export function symbolTree(runtimeId: string, codeId: string | null): SymbolTree {
  const known = trees.get(runtimeId);
  if (known !== undefined && known.codeId === codeId) return known.tree;
  const tree = new SymbolTree((path) =>
    api.get('/api/v1/runtimes/{runtime_id}/symbols', {
      params: { path: { runtime_id: runtimeId }, query: { path } },
    }),
  );
  trees.set(runtimeId, { codeId, tree });
  return tree;
}
