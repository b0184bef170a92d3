import { useState } from 'react';
import type { Schemas } from '@/api/types';
import { useText } from '@/i18n';
import { displayPlace } from '@/project/objectName';
import type { Monaco } from '@/text/monacoLoader';
import { Checkbox } from '@/ui/Field';
import { outcome, takes, withPart, withText, type Choice, type Difference, type Part } from './comparison';
import styles from './compare.module.css';
import { DiffView } from './DiffView';
import { PartTabs } from './PartTabs';

interface DifferencePaneProps {
  monaco: Monaco;
  difference: Difference;
  sides: Schemas['DifferenceDetail'];
  titles: readonly [string, string];
  ignoreWhiteSpace: boolean;
  choice: Choice;
  /** Null: nothing can be taken over. */
  choose: ((choice: Choice) => void) | null;
}

const TEXTS = ['declaration', 'implementation'] as const;
/** The tab of all that is no text. */
const VALUES = 'values';
type Tab = (typeof TEXTS)[number] | typeof VALUES;

/** One object on both sides: its texts beside each other, its other data as a table. */
export function DifferencePane(props: DifferencePaneProps) {
  const { monaco, difference, sides, titles, ignoreWhiteSpace, choice, choose } = props;
  const [wanted, setTab] = useState<Tab | null>(null);
  const text = (side: 'old' | 'new', field: string) => {
    const value = sides[side]?.[field];
    return typeof value === 'string' ? value : '';
  };
  const whole = difference.state !== 'changed';
  const texts = TEXTS.filter((field) => field in { ...sides.old, ...sides.new });
  const differing = texts.filter((field) =>
    whole ? text('old', field) !== text('new', field) : difference.fields.includes(field),
  );
  const others = whole
    ? Object.keys({ ...sides.old, ...sides.new }).filter((field) => !texts.some((one) => one === field))
    : difference.fields.filter((field) => !texts.some((one) => one === field));
  const placed = difference.renamed || difference.moved || difference.reordered;
  const tabs: Tab[] = [
    ...differing,
    ...(others.length > 0 || placed || differing.length === 0 ? ([VALUES] as const) : []),
  ];
  const tab = wanted && tabs.includes(wanted) ? wanted : tabs[0]!;
  if (tab === VALUES)
    return (
      <div className={styles.pane}>
        <PartTabs parts={tabs} part={tab} onPart={setTab} />
        <ValueTable {...props} fields={others} whole={whole} />
      </div>
    );
  const [old, now] = [text('old', tab), text('new', tab)];
  return (
    <div className={styles.pane}>
      <PartTabs parts={tabs} part={tab} onPart={setTab} />
      <DiffView
        key={`${difference.key} ${tab}`}
        monaco={monaco}
        left={old}
        right={whole ? now : outcome(choice, difference, tab, old, now)}
        titles={titles}
        ignoreWhiteSpace={ignoreWhiteSpace}
        onRight={
          choose && !whole ? (edited) => choose(withText(choice, difference, tab, { old, now }, edited)) : undefined
        }
      />
    </div>
  );
}

interface ValueTableProps extends DifferencePaneProps {
  fields: readonly string[];
  whole: boolean;
}

/** Name, place and the data that are no texts, a row each. */
function ValueTable({ difference, sides, titles, choice, choose, fields, whole }: ValueTableProps) {
  const t = useText();
  const { old, renamed, moved, reordered } = difference;
  const now = difference.new;
  const rows: { key: string; title: string; part: Part; left: string; right: string }[] = [];
  const add = (key: string, title: string, part: Part, left: string, right: string) =>
    rows.push({ key, title, part, left, right });
  if (renamed || whole) add('name', t('compare.name'), 'name', old?.name ?? '', now?.name ?? '');
  if (moved || whole) add('place', t('compare.place'), 'place', parentOf(old), parentOf(now));
  else if (reordered) add('place', t('compare.place'), 'place', t('compare.elsewhere'), t('compare.elsewhere'));
  fields.forEach((field) => add(`f.${field}`, field, { field }, shown(sides.old?.[field]), shown(sides.new?.[field])));
  return (
    <div className={styles.values} tabIndex={0} role="group" aria-label={t('compare.values')}>
      <table>
        <thead>
          <tr>
            <th scope="col">{t('compare.value')}</th>
            <th scope="col">{titles[0]}</th>
            <th scope="col">{titles[1]}</th>
          </tr>
        </thead>
        <tbody>
          {rows.map(({ key, title, part, left, right }) => (
            <tr key={key}>
              <th scope="row">
                {choose && !whole ? (
                  <Checkbox
                    checked={takes(choice, difference, part)}
                    onChecked={(taken) => choose(withPart(choice, difference, part, taken))}
                  >
                    {title}
                  </Checkbox>
                ) : (
                  title
                )}
              </th>
              <td>{left}</td>
              <td>{right}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function parentOf(side: Schemas['ComparedObject'] | null): string {
  return side === null ? '' : displayPlace(side.path);
}

function shown(value: unknown): string {
  if (value === undefined || value === null) return '';
  return typeof value === 'string' ? value : JSON.stringify(value, null, 2);
}
