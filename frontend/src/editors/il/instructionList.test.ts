import { describe, expect, it } from 'vitest';
import { codeTokens } from '@/iec/lexer';
import { findVariables } from '@/iec/variables';
import { isInstructionList, operandTokens } from './instructionList';
import texts from './texts.json';

const IL = `(* rows *)
start: LD   iCount   // load
       ADD  2,iMore
       MUL( gFactor
       SUB  iLess
       )
       ST   inst.aVal[iCount]
       GT   %MW4
       JMPC start
       CAL  tmr(IN := xStart,
                PT := tTime, Q => xDone)
       LD   xStart
       SEL  iA, iB
       ST   iResult
       iface.Home TRUE, xReady
       LEN
       RET`;

const found = (text: string) =>
  findVariables(text, operandTokens(text, codeTokens(text))).map((use) => text.slice(use.start, use.end));
const isRows = (text: string) => isInstructionList(text, codeTokens(text));

describe('rows of IL', () => {
  it('shows the values of operands, not of operators, labels and functions', () => {
    expect(found(IL)).toEqual(
      'iCount iMore gFactor iLess inst.aVal[iCount] iCount %MW4 xStart tTime xDone xStart iA iB iResult xReady'.split(
        ' ',
      ),
    );
  });

  it.each(texts as [string, boolean][])('are what the compiler takes for rows: %j, %j', (text, rows) => {
    expect(isRows(text)).toBe(rows);
  });
});
