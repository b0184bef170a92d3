/**
 * Expressions of watch lists: arithmetic, comparisons and logic over variables, with the types and the values that the
 * evaluator of the runtime has (codegen/expressions). The variables of an expression come with one frame, so that its
 * value is of one cycle. Pure functions.
 */
import type { TextKey, TextValues } from '@/i18n';
import type { PlcValue, SubscribedItem } from '../item';
import { literalOf } from './literals';
import { binary, call, ComputedError, constant, unary, untyped, type Operand } from './operations';
import { parseTree, type Tree } from './parse';
import { elementaryOf, hold, itemOf, type Scalar, type TypedItem } from './types';

/** A variable with what the server says about it; no value yet: null. */
export interface Source {
  readonly value: PlcValue | null;
  readonly item: TypedItem;
}

export type Result =
  | { readonly kind: 'value'; readonly value: PlcValue; readonly item: Pick<SubscribedItem, 'kind' | 'type' | 'size'> }
  /** A value is still to come. */
  | { readonly kind: 'waiting' }
  /** The expression is possible, but has no value now: a whole number is divided by zero. */
  | { readonly kind: 'none'; readonly key: TextKey; readonly values: TextValues }
  | { readonly kind: 'wrong'; readonly key: TextKey; readonly values: TextValues }
  /** In the words of the server. */
  | { readonly kind: 'refused'; readonly message: string };

export interface Computed {
  /** The variables in it, each once. */
  readonly operands: readonly string[];
  readonly evaluate: (sourceOf: (expression: string) => Source | null) => Result;
}

/** What an expression computes; null for a mere variable, and for a text that is no expression. */
export function parseComputed(text: string): Computed | null {
  const tree = parseTree(text);
  return tree && { operands: [...new Set(pathsOf(tree))], evaluate: (sourceOf) => evaluated(tree, sourceOf) };
}

function pathsOf(tree: Tree): string[] {
  switch (tree.kind) {
    case 'variable':
      return [tree.path];
    case 'unary':
      return pathsOf(tree.of);
    case 'binary':
      return [...pathsOf(tree.left), ...pathsOf(tree.right)];
    case 'call':
      return tree.values.flatMap(pathsOf);
    default:
      return [];
  }
}

type SourceOf = (expression: string) => Source | null;

class Waiting extends Error {}

class Refused extends Error {}

function evaluated(tree: Tree, sourceOf: SourceOf): Result {
  let checked = false;
  try {
    const operand = operandOf(tree, sourceOf);
    checked = true;
    return { kind: 'value', value: plcValue(operand.value(), operand), item: itemOf(operand.held) };
  } catch (error) {
    if (error instanceof Waiting) return { kind: 'waiting' };
    if (error instanceof Refused) return { kind: 'refused', message: error.message };
    if (!(error instanceof ComputedError)) throw error;
    return { kind: checked ? 'none' : 'wrong', key: error.key, values: error.values };
  }
}

const plcValue = (value: Scalar, { held }: Operand): PlcValue => (held.family === 'bool' ? value !== 0n : value);

function operandOf(tree: Tree, sourceOf: SourceOf): Operand {
  switch (tree.kind) {
    case 'literal':
      return literalOperand(tree.text);
    case 'text':
      throw new ComputedError('watch.computed.text', { text: tree.text });
    case 'variable':
      return variable(tree.path, sourceOf(tree.path));
    case 'unary':
      return unary(tree.op, operandOf(tree.of, sourceOf));
    case 'call':
      return call(
        tree.name,
        tree.values.map((value) => operandOf(value, sourceOf)),
      );
    case 'binary': {
      const [left, right] = sides(tree.left, tree.right, sourceOf);
      return binary(tree.op, left, right);
    }
  }
}

function literalOperand(text: string): Operand {
  const literal = literalOf(text);
  if (literal === null) throw new ComputedError('watch.computed.literal', { text });
  return literal.type === null ? untyped(literal.value) : constant(literal.value, literal.type);
}

function variable(path: string, source: Source | null): Operand {
  if (source === null) throw new Waiting();
  const { item, value } = source;
  if (item.error) throw new Refused(item.error);
  const type = elementaryOf(item);
  if (type === null) throw new ComputedError('watch.computed.noNumber', { path, type: item.type });
  return {
    type,
    held: type,
    declared: item.type,
    enumerators: item.enum ?? undefined,
    value: () => {
      if (value === null || typeof value === 'string') throw new Waiting();
      if (type.family === 'real') return Number(value);
      return hold(BigInt(value), type);
    },
  };
}

/** Both sides, where a name can be a value of the enumeration on the other side. */
function sides(left: Tree, right: Tree, sourceOf: SourceOf): [Operand, Operand] {
  if (!isUnknown(left, sourceOf)) {
    const found = operandOf(left, sourceOf);
    return [found, expected(right, found, sourceOf)];
  }
  const found = operandOf(right, sourceOf);
  return [expected(left, found, sourceOf), found];
}

const isUnknown = (tree: Tree, sourceOf: SourceOf) =>
  tree.kind === 'variable' && Boolean(sourceOf(tree.path)?.item.error);

function expected(tree: Tree, other: Operand, sourceOf: SourceOf): Operand {
  if (tree.kind === 'variable' && other.enumerators) {
    const dot = tree.path.lastIndexOf('.');
    const owner = tree.path.slice(0, Math.max(0, dot)).replace(/^\./, '');
    const name = tree.path.slice(dot + 1).toUpperCase();
    const number = Object.entries(other.enumerators).find(([own]) => own.toUpperCase() === name)?.[1];
    const isOwn = owner === '' || isNamed(other.declared ?? '', owner);
    if (number !== undefined && isOwn) return { ...constant(BigInt(number), other.type), declared: other.declared };
  }
  return operandOf(tree, sourceOf);
}

/** Whether a type is written so: with its namespace or without. */
function isNamed(type: string, written: string): boolean {
  const [full, short] = [type.toUpperCase(), written.toUpperCase()];
  return full === short || full.endsWith(`.${short}`) || short.endsWith(`.${full}`);
}
