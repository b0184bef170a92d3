import { describe, expect, it } from 'vitest';
import { codeTokens } from '@/iec/lexer';
import { findVariables } from '@/iec/variables';
import { isInstructionList, operandTokens } from './instructionList';

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

  it.each(['LD a\nST b', 'l: LDN x\nST y', 'CAL t1(IN := x)', 'TIME\nST t', 'RET', 'LD -3\nST a'])(
    'knows %j',
    (text) => {
      expect(isRows(text)).toBe(true);
    },
  );

  it.each(['', 'a := 1;', 'LD := 3;', 'R REF= a;', 'S S= x;', 'JMP l;\nl: a := 1;', 'a\n:= 3;', 'ST(3);'])(
    'takes %j for ST',
    (text) => {
      expect(isRows(text)).toBe(false);
    },
  );
});
