import { Fragment } from 'react';
import { useText, type TextKey } from '@/i18n';
import { NumberCell } from '@/editors/form/NumberField';
import axis from '../axis/Axis.module.css';
import type { Faults, FieldName } from './model';

interface ValueTableProps<Column extends string, Row extends string> {
  columns: Readonly<Record<Column, TextKey>>;
  rows: Readonly<Record<Row, { text: TextKey; unit: string }>>;
  values: Readonly<Record<NoInfer<Column>, Readonly<Record<NoInfer<Row>, number>>>>;
  faults: Faults;
  disabled: boolean;
  onValue: (column: Column, row: Row, value: number) => void;
}

/** Numbers in rows and columns, with what is wrong with them below. */
export function ValueTable<Column extends string, Row extends string>(props: ValueTableProps<Column, Row>) {
  const { columns, rows, values, faults, disabled, onValue } = props;
  const t = useText();
  const columnNames = Object.keys(columns) as Column[];
  const rowNames = Object.keys(rows) as Row[];
  const wrong = columnNames.flatMap((column) =>
    rowNames.flatMap((row) => {
      const fault = faults[`${column}.${row}` as FieldName];
      return fault ? [{ column, row, fault }] : [];
    }),
  );
  return (
    <>
      <div
        className={axis.limits}
        style={{ gridTemplateColumns: `max-content repeat(${columnNames.length}, 120px) max-content` }}
      >
        <span />
        {columnNames.map((column) => (
          <span key={column} className={axis.head}>
            {t(columns[column])}
          </span>
        ))}
        <span />
        {rowNames.map((row) => (
          <Fragment key={row}>
            <span>{t(rows[row].text)}</span>
            {columnNames.map((column) => (
              <NumberCell
                key={column}
                label={`${t(columns[column])}: ${t(rows[row].text)}`}
                value={values[column][row]}
                invalid={wrong.some((one) => one.column === column && one.row === row)}
                disabled={disabled}
                onValue={(value) => onValue(column, row, value)}
              />
            ))}
            <span className={axis.unit}>{rows[row].unit}</span>
          </Fragment>
        ))}
      </div>
      <ul className={axis.faults} role="alert">
        {wrong.map(({ column, row, fault }) => (
          <li key={`${column}.${row}`}>
            {t('axis.faultAt', { field: `${t(columns[column])}, ${t(rows[row].text)}`, fault: t(fault) })}
          </li>
        ))}
      </ul>
    </>
  );
}
