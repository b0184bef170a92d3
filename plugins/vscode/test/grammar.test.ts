import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { beforeAll, expect, test } from 'vitest';
import { OnigScanner, OnigString, loadWASM } from 'vscode-oniguruma';
import { INITIAL, type IGrammar, Registry, parseRawGrammar } from 'vscode-textmate';

const FILE = join(__dirname, '../syntaxes/iec-st.tmLanguage.json');
let grammar: IGrammar;

beforeAll(async () => {
  const wasm = createRequire(__filename).resolve('vscode-oniguruma/release/onig.wasm');
  await loadWASM(readFileSync(wasm).buffer as ArrayBuffer);
  const registry = new Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new OnigScanner(patterns),
      createOnigString: (text) => new OnigString(text),
    }),
    loadGrammar: () => Promise.resolve(parseRawGrammar(readFileSync(FILE, 'utf-8'), FILE)),
  });
  grammar = (await registry.loadGrammar('source.iec-st'))!;
});

/** Every word of a text with the last scope that it has. */
function scopes(text: string): Record<string, string> {
  const found: Record<string, string> = {};
  let state = INITIAL;
  for (const line of text.split('\n')) {
    const result = grammar.tokenizeLine(line, state);
    for (const token of result.tokens) {
      const word = line.slice(token.startIndex, token.endIndex).trim();
      if (word) found[word] ??= token.scopes.at(-1)!.replace('.iec-st', '');
    }
    state = result.ruleStack;
  }
  return found;
}

test.each([
  ['IF xRun THEN', { IF: 'keyword.control', THEN: 'keyword.control' }],
  ['end_if', { end_if: 'keyword.control' }],
  ['VAR_GLOBAL RETAIN nCount : UDINT;', { VAR_GLOBAL: 'keyword.declaration', RETAIN: 'keyword.declaration', UDINT: 'storage.type' }],
  ['x := NOT (a AND_THEN b) MOD 3', { NOT: 'keyword.operator.word', AND_THEN: 'keyword.operator.word', MOD: 'keyword.operator.word' }],
  ['t := T#1m30s500ms + LTIME#5us;', { 'T#1m30s500ms': 'constant.other.time', 'LTIME#5us': 'constant.other.time' }],
  ['d := DT#2024-02-29-12:30:00.5', { 'DT#2024-02-29-12:30:00.5': 'constant.other.time' }],
  ['n := 16#FF_00 + 2#1010 + 1_000 + 2.5E-3', { '16#FF_00': 'constant.numeric', '2#1010': 'constant.numeric', '1_000': 'constant.numeric', '2.5E-3': 'constant.numeric' }],
  ['%IX0.3 %QW10 %I*', { '%IX0.3': 'variable.other.address', '%QW10': 'variable.other.address', '%I*': 'variable.other.address' }],
  ["s := 'it$'s';", { "it": 'string.quoted.single', "$'": 'constant.character.escape' }],
  ['THIS^.Move(fPosition := 1)', { THIS: 'variable.language', Move: 'entity.name.function' }],
  ['b := TRUE; p := NULL;', { TRUE: 'constant.language' }],
  ["{attribute 'hide'}", { "{": 'meta.preprocessor' }],
])('%s', (text, expected) => {
  expect(scopes(text)).toMatchObject(expected);
});

test('comments nest, go over lines, and hide keywords', () => {
  const found = scopes('(* IF (* inner *) WHILE\nFOR *) x // REPEAT');
  expect(found).toMatchObject({ IF: 'comment.block', WHILE: 'comment.block', FOR: 'comment.block' });
  expect(Object.values(found).filter((scope) => scope.startsWith('keyword'))).toEqual([]);
});

test('members and names that contain keywords are names', () => {
  const found = scopes('fbIf.END := iForward + stIF_2.DO');
  expect(Object.entries(found).filter(([, scope]) => scope.startsWith('keyword.control'))).toEqual([]);
});
