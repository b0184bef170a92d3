import { CircleAlert, Info, TriangleAlert } from 'lucide-react';
import type { ReactNode } from 'react';
import { RowMark } from '@/bookmarks/RowMark';
import type { t as Text } from '@/i18n';
import type { GridColumn } from '@/ui/grid/Grid';
import debug from '@/workbench/debugger/Debugger.module.css';
import { isOperator } from './instructionList';
import { textOf, tokenize } from '@/iec/lexer';
import type { OperandFacts } from './facts';
import styles from './IlTable.module.css';
import type { RowMessage } from './messages';
import { cellText, type Cell, type IlColumn, type IlRow } from './rows';
import type { IlSettings } from './settings';
import type { RowBreakpoint } from './useRowBreakpoints';

export type ColumnId = 'line' | 'operator' | 'operand' | 'value' | 'address' | 'symbolComment' | 'comment';

export interface IlGridColumn extends GridColumn {
  id: ColumnId;
}

/** The columns of the table: those that the options show (IL-01), and values while logged in (ONL-02). */
export function ilColumns(t: typeof Text, chosen: Omit<IlSettings, 'view'>, online: boolean): readonly IlGridColumn[] {
  const column = (id: ColumnId, width: number, more: Omit<Partial<GridColumn>, 'id'> = {}): IlGridColumn => ({
    id,
    title: id === 'line' ? '' : t(`il.column.${id}`),
    width,
    ...more,
  });
  return [
    column('line', online ? 68 : 52, { align: 'right' }),
    column('operator', 132, { code: true }),
    column('operand', 190, { code: true, grow: true }),
    ...(online ? [column('value', 150, { grow: true })] : []),
    ...(chosen.address ? [column('address', 84, { code: true })] : []),
    ...(chosen.symbolComment ? [column('symbolComment', 170, { grow: true })] : []),
    ...(chosen.operandComment ? [column('comment', 170, { grow: true })] : []),
  ];
}

/** The cell of the text behind a column that can be edited in this kind of row, or null. */
export function editedColumn(row: IlRow, column: string | undefined): IlColumn | null {
  if (row.excluded) return null;
  if (row.kind === 'comment') return column === 'line' ? null : 'comment';
  if (row.kind === 'label' || row.kind === 'raw') {
    if (column === 'comment') return row.comment !== null || row.kind === 'raw' ? 'comment' : null;
    return column === 'operator' || column === 'operand' ? 'operator' : null;
  }
  return column === 'operator' || column === 'operand' || column === 'comment' ? column : null;
}

interface CellView {
  t: typeof Text;
  row: IlRow;
  facts: OperandFacts | null;
  messages: readonly RowMessage[];
  bookmark: boolean;
  breakpoint: RowBreakpoint | undefined;
  /** Sets or removes a breakpoint; null while logged out. */
  onBreakpoint: (() => void) | null;
}

/** How a cell looks while it is not edited; values come from elsewhere. */
export function cellContent(view: CellView, column: ColumnId): ReactNode {
  const { t, row, facts, messages } = view;
  switch (column) {
    case 'line':
      return <LineCell {...view} />;
    case 'operator':
      return <Operator row={row} messages={messages} />;
    case 'operand':
      if (row.kind === 'label') {
        const text = row.excluded ? 'il.commented' : 'il.network';
        return <i className={styles.network}>{t(text, { number: row.network })}</i>;
      }
      return row.operand && <Code cell={row.operand} row={row} messages={messages} />;
    case 'address':
      return <span>{facts?.address}</span>;
    case 'symbolComment':
      return <span className={styles.muted}>{firstLine(facts?.comment ?? '')}</span>;
    case 'comment':
      if (row.kind === 'comment') return null;
      return <span className={styles.comment}>{firstLine(cellText(row, 'comment'))}</span>;
    default:
      return null;
  }
}

/** Marks and number of a row; while logged in a click on the number sets a breakpoint, as beside a text. */
function LineCell({ t, row, messages, bookmark, breakpoint, onBreakpoint }: CellView) {
  return (
    <>
      {breakpoint !== undefined && (
        <i
          className={`${styles.breakpoint} ${debug.dot}`}
          data-look={breakpoint.look}
          role="img"
          aria-label={[t('debugger.breakpoint'), breakpoint.hint].filter(Boolean).join('\n')}
        />
      )}
      {bookmark && <RowMark />}
      <Mark messages={messages} />
      {onBreakpoint === null ? (
        <span className={styles.line}>{row.line}</span>
      ) : (
        <button
          type="button"
          tabIndex={-1}
          className={`${styles.line} ${styles.lineButton}`}
          aria-label={t('il.breakpointAt', { line: row.line })}
          onClick={(event) => {
            event.stopPropagation();
            onBreakpoint();
          }}
        >
          {row.line}
        </button>
      )}
    </>
  );
}

function firstLine(text: string): string {
  const lines = text.split('\n');
  return lines.length > 1 ? `${lines[0] ?? ''} …` : text;
}

const STEP_PX = 16;

function Operator({ row, messages }: { row: IlRow; messages: readonly RowMessage[] }) {
  if (row.kind === 'comment')
    return <span className={styles.wideComment}>{cellText(row, 'comment').replaceAll('\n', ' ↵ ')}</span>;
  if (row.operator === null) return null;
  const bad = touches(row.operator, row, messages);
  if (row.kind === 'label' || row.kind === 'raw')
    return (
      <span className={row.kind === 'label' ? styles.label : styles.raw} data-bad={bad}>
        {row.operator.text}
      </span>
    );
  const word = /^[^\s(]*/.exec(row.operator.text)?.[0] ?? '';
  const known = isOperator(word) || word === ')' || word === '&';
  const look = row.kind === 'parameter' ? styles.parameter : known ? styles.operator : styles.function;
  return (
    <span className={look} data-bad={bad} style={{ marginLeft: row.depth * STEP_PX }}>
      {row.operator.text}
    </span>
  );
}

/** An operand with the colours that text has. */
function Code({ cell, row, messages }: { cell: Cell; row: IlRow; messages: readonly RowMessage[] }) {
  const pieces: ReactNode[] = [];
  let at = 0;
  for (const token of tokenize(cell.text)) {
    const text = textOf(cell.text, token);
    const look = LOOKS[/^(TRUE|FALSE)$/i.test(text) ? 'number' : token.kind];
    pieces.push(cell.text.slice(at, token.start));
    pieces.push(
      look === undefined ? (
        text
      ) : (
        <b key={token.start} className={styles[look]}>
          {text}
        </b>
      ),
    );
    at = token.end;
  }
  return (
    <span data-bad={touches(cell, row, messages)} className={styles.code}>
      {pieces}
    </span>
  );
}

const LOOKS: Readonly<Record<string, string>> = {
  number: 'number',
  string: 'string',
  wstring: 'string',
  address: 'address',
};

/** The most serious of the messages that begin in a cell. */
function touches(cell: Cell, row: IlRow, messages: readonly RowMessage[]): RowMessage['severity'] | undefined {
  const from = cell.start - row.lineStart;
  const to = cell.end - row.lineStart;
  return mostSerious(messages.filter(({ column }) => column - 1 >= from && column - 1 <= to));
}

function mostSerious(messages: readonly RowMessage[]): RowMessage['severity'] | undefined {
  return (['error', 'warning', 'info'] as const).find((one) => messages.some(({ severity }) => severity === one));
}

const MARKS = { error: CircleAlert, warning: TriangleAlert, info: Info } as const;

function Mark({ messages }: { messages: readonly RowMessage[] }) {
  const severity = mostSerious(messages);
  if (severity === undefined) return null;
  const Icon = MARKS[severity];
  const text = messages.map(({ message }) => message).join('\n');
  return (
    <i className={styles.mark} data-severity={severity} role="img" aria-label={text}>
      <Icon size={13} aria-hidden />
    </i>
  );
}

/** The tooltip of a cell: of an operand its declaration (FBD-04), the messages of the row. */
export function cellHint({ row, facts, messages, breakpoint }: CellView, column: ColumnId): string | undefined {
  const lines =
    column === 'line' || column === 'operator' || column === 'operand' ? messages.map((m) => m.message) : [];
  if (column === 'line' && breakpoint?.hint) lines.unshift(breakpoint.hint);
  if (column === 'operand' && row.operand !== null) {
    lines.unshift(
      row.operand.text + (facts === null ? '' : ` : ${facts.type}${facts.address ? ` (${facts.address})` : ''}`),
    );
    lines.push(...[facts?.comment ?? '', cellText(row, 'comment')].filter((line) => line !== ''));
  } else if (column === 'symbolComment') lines.push(facts?.comment ?? '');
  else if (column === 'comment' || row.kind === 'comment') lines.push(cellText(row, 'comment'));
  return lines.join('\n') || undefined;
}
