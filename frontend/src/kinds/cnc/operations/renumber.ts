/** New block numbers (CNC-85). */
import { lineEdit, replaced, withWord, type LinesEdit } from '../edits';
import { readBlock, valueOf, wordOf } from '../line';

const STEP = 10;

/** Numbers 0, 10, 20 ...; blocks without one get one; the targets of jumps go along. */
export function renumbered(lines: readonly string[]): LinesEdit[] {
  const blocks = lines.map(readBlock);
  const numbers = new Map<number, number>();
  let next = 0;
  const given = blocks.map(({ words, number }) => {
    if (words.length === 0) return null;
    const own = next;
    next += STEP;
    if (number !== null && !numbers.has(number)) numbers.set(number, own);
    return own;
  });
  return blocks.flatMap((block, line) => {
    const number = given[line];
    if (number === null || number === undefined) return [];
    let { text } = block;
    // From the end on, so that the places in front hold.
    const target = valueOf(block, 'G') === 20 ? wordOf(block, 'L') : undefined;
    const changes = [
      ...(target?.value.kind === 'number' && numbers.has(target.value.number)
        ? [{ word: target, by: numbers.get(target.value.number)! }]
        : []),
      ...(wordOf(block, 'N') ? [{ word: wordOf(block, 'N')!, by: number }] : []),
    ].sort((a, b) => b.word.at - a.word.at);
    for (const { word, by } of changes) text = replaced(text, word.valueAt, word.end, String(by));
    if (wordOf(block, 'N') === undefined) text = withWord(readBlock(text), 'N', String(number));
    return text === block.text ? [] : [lineEdit(line, text)];
  });
}
