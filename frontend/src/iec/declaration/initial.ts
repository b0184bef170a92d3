/**
 * Initial values of structured variables: `(a := 1, b := [3(0)])` taken apart and composed again (DECL-31).
 *
 * Values that are no aggregates stay as the text the user wrote.
 */
import { isTrivia, textOf, tokenize, type Token } from '../lexer';

export type InitialValue =
  | { readonly kind: 'plain'; readonly text: string }
  | { readonly kind: 'members'; readonly members: readonly { readonly name: string; readonly value: InitialValue }[] }
  | {
      readonly kind: 'elements';
      readonly elements: readonly { readonly count: number; readonly value: InitialValue }[];
    };

class InitialReader {
  private readonly tokens: Token[];
  private at = 0;

  constructor(private readonly text: string) {
    this.tokens = tokenize(text).filter((token) => !isTrivia(token));
  }

  /** The aggregate, or null when the text is none; then it is plain. */
  read(): InitialValue | null {
    const value = this.value();
    return value !== null && this.at === this.tokens.length ? value : null;
  }

  private word(ahead = 0): string {
    const token = this.tokens[this.at + ahead];
    return token === undefined ? '' : textOf(this.text, token);
  }

  private value(): InitialValue | null {
    if (this.word() === '(' && this.word(2) === ':=') return this.members();
    if (this.word() === '[') return this.elements();
    return this.plain();
  }

  private plain(): InitialValue | null {
    const first = this.tokens[this.at];
    let last: Token | undefined;
    let depth = 0;
    while (this.at < this.tokens.length) {
      const word = this.word();
      if (depth === 0 && [',', ')', ']'].includes(word)) break;
      if (word === '(' || word === '[') depth += 1;
      if (word === ')' || word === ']') depth -= 1;
      last = this.tokens[this.at];
      this.at += 1;
    }
    if (first === undefined || last === undefined) return null;
    return { kind: 'plain', text: this.text.slice(first.start, last.end) };
  }

  private members(): InitialValue | null {
    const members: { name: string; value: InitialValue }[] = [];
    this.at += 1;
    while (this.word() !== ')') {
      const name = this.word();
      if (this.tokens[this.at]?.kind !== 'word' || this.word(1) !== ':=') return null;
      this.at += 2;
      const value = this.value();
      if (value === null) return null;
      members.push({ name, value });
      if (this.word() === ',') this.at += 1;
      else if (this.word() !== ')') return null;
    }
    this.at += 1;
    return { kind: 'members', members };
  }

  private elements(): InitialValue | null {
    const elements: { count: number; value: InitialValue }[] = [];
    this.at += 1;
    while (this.word() !== ']') {
      const repeated = this.tokens[this.at]?.kind === 'number' && this.word(1) === '(' && /^\d+$/.test(this.word());
      let count = 1;
      if (repeated) {
        count = Number(this.word());
        this.at += 2;
      }
      const value = this.value();
      if (value === null) return null;
      if (repeated) {
        if (this.word() !== ')') return null;
        this.at += 1;
      }
      elements.push({ count, value });
      if (this.word() === ',') this.at += 1;
      else if (this.word() !== ']') return null;
    }
    this.at += 1;
    return { kind: 'elements', elements };
  }
}

export function parseInitial(text: string): InitialValue {
  return new InitialReader(text).read() ?? { kind: 'plain', text: text.trim() };
}

export function formatInitial(value: InitialValue): string {
  switch (value.kind) {
    case 'plain':
      return value.text;
    case 'members':
      return `(${value.members.map((m) => `${m.name} := ${formatInitial(m.value)}`).join(', ')})`;
    case 'elements':
      return `[${value.elements.map((e) => (e.count === 1 ? formatInitial(e.value) : `${String(e.count)}(${formatInitial(e.value)})`)).join(', ')}]`;
  }
}

/** What an initial value is made of: a leaf with its default, members by name, or array elements by index. */
export type TypeShape =
  | { readonly kind: 'leaf'; readonly type: string; readonly default: string }
  | {
      readonly kind: 'members';
      readonly type: string;
      readonly members: readonly {
        readonly name: string;
        readonly shape: TypeShape;
        readonly initial: string | null;
      }[];
    }
  | {
      readonly kind: 'elements';
      readonly type: string;
      readonly labels: readonly string[];
      readonly element: TypeShape;
    };

/** One line of the Initialization Value dialog. */
export interface InitialLine {
  readonly path: string;
  readonly label: string;
  readonly depth: number;
  readonly type: string;
  /** Null for lines that only head their components. */
  readonly value: string | null;
  readonly isDefault: boolean;
}

/** Values the user gave, by path of the line; what is not in here has the default of its type. */
export type GivenValues = Readonly<Record<string, string>>;

const MAX_ELEMENTS = 4096;

/** Spreads an initial value over the leaves of its type; repeated elements count out. */
export function givenValues(shape: TypeShape, initial: InitialValue | null): GivenValues {
  const given: Record<string, string> = {};
  const walk = (at: TypeShape, value: InitialValue | null, path: string): void => {
    if (value === null) return;
    if (value.kind === 'plain' || at.kind === 'leaf') {
      given[path] = formatInitial(value);
    } else if (at.kind === 'members' && value.kind === 'members') {
      for (const member of value.members) {
        const own = at.members.find((m) => m.name.toUpperCase() === member.name.toUpperCase());
        if (own === undefined) given[`${path}.${member.name}`] = formatInitial(member.value);
        else walk(own.shape, member.value, `${path}.${own.name}`);
      }
    } else if (at.kind === 'elements' && value.kind === 'elements') {
      let index = 0;
      for (const element of value.elements) {
        for (let n = 0; n < element.count && index < Math.min(at.labels.length, MAX_ELEMENTS); n += 1, index += 1) {
          walk(at.element, element.value, `${path}[${at.labels[index] ?? ''}]`);
        }
      }
    } else {
      given[path] = formatInitial(value);
    }
  };
  walk(shape, initial, '');
  return given;
}

/** Values that the type itself gives its components, by path: initial values of members, spread over arrays. */
function typeDefaults(shape: TypeShape): GivenValues {
  const defaults: Record<string, string> = {};
  const walk = (at: TypeShape, path: string): void => {
    if (at.kind === 'leaf') return;
    const parts =
      at.kind === 'members'
        ? at.members.map((m) => ({ shape: m.shape, path: `${path}.${m.name}`, initial: m.initial }))
        : at.labels
            .slice(0, MAX_ELEMENTS)
            .map((l) => ({ shape: at.element, path: `${path}[${l}]`, initial: null as string | null }));
    for (const part of parts) {
      walk(part.shape, part.path);
      if (part.initial === null) continue;
      const own = givenValues(part.shape, parseInitial(part.initial));
      for (const [below, value] of Object.entries(own)) defaults[part.path + below] = value;
    }
  };
  walk(shape, '');
  return defaults;
}

export function initialLines(shape: TypeShape, name: string, given: GivenValues): InitialLine[] {
  const lines: InitialLine[] = [];
  const defaults = typeDefaults(shape);
  const walk = (at: TypeShape, path: string, label: string, depth: number): void => {
    const value = given[path];
    const standard = defaults[path] ?? (at.kind === 'leaf' ? at.default : null);
    lines.push({ path, label, depth, type: at.type, value: value ?? standard, isDefault: value === undefined });
    if (value !== undefined && at.kind !== 'leaf') return;
    if (at.kind === 'members') {
      for (const m of at.members) walk(m.shape, `${path}.${m.name}`, m.name, depth + 1);
    } else if (at.kind === 'elements') {
      at.labels.slice(0, MAX_ELEMENTS).forEach((l) => walk(at.element, `${path}[${l}]`, `[${l}]`, depth + 1));
    }
  };
  walk(shape, '', name, 0);
  return lines;
}

/**
 * Composes one initial value; members at their default are left out, equal elements are counted (DECL-31). An
 * array that is given at all is given whole, since elements left out would lose what its type gives them.
 */
export function composeInitial(shape: TypeShape, given: GivenValues): string {
  const defaults = typeDefaults(shape);
  const compose = (at: TypeShape, path: string): string | null => {
    const own = given[path];
    if (own !== undefined) return own;
    if (at.kind === 'leaf') return null;
    if (at.kind === 'members') {
      const parts = at.members.flatMap((m) => {
        const value = compose(m.shape, `${path}.${m.name}`);
        return value === null ? [] : [`${m.name} := ${value}`];
      });
      return parts.length === 0 ? null : `(${parts.join(', ')})`;
    }
    return composeElements(at, path);
  };
  const composeElements = (at: Extract<TypeShape, { kind: 'elements' }>, path: string): string | null => {
    const values = at.labels.map((label) => compose(at.element, `${path}[${label}]`));
    if (values.every((value) => value === null)) return null;
    const standard = defaultText(at.element);
    const full = values.map((value, i) => value ?? defaults[`${path}[${at.labels[i] ?? ''}]`] ?? standard);
    let last = full.length - 1;
    while (last > 0 && values[last] === null && full[last] === standard) last -= 1;
    const parts: string[] = [];
    for (let i = 0; i <= last;) {
      const value = full[i] ?? standard;
      let end = i + 1;
      while (end <= last && full[end] === value) end += 1;
      parts.push(end - i === 1 ? value : `${String(end - i)}(${value})`);
      i = end;
    }
    return `[${parts.join(', ')}]`;
  };
  return compose(shape, '') ?? '';
}

/** A value that means "default" where a place in an array must be filled. */
function defaultText(shape: TypeShape): string {
  if (shape.kind === 'leaf') return shape.default;
  if (shape.kind === 'elements') return `[${defaultText(shape.element)}]`;
  const first = shape.members[0];
  return first === undefined ? '()' : `(${first.name} := ${first.initial ?? defaultText(first.shape)})`;
}
