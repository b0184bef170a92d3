import { useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { displayPath } from '@/project/objectName';
import { forestOf, lineage } from '@/project/tree';
import { loadMonaco } from '@/text/monacoLoader';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Checkbox } from '@/ui/Field';
import { FilterInput, FilterToggles } from '@/ui/Filter';
import { useToggleSet } from '@/ui/toggleSet';
import {
  filtered,
  NOTHING,
  sideOf,
  STATES,
  withChoice,
  type Choices,
  type Comparison,
  type DiffRow,
  type Ignoring,
  type State,
} from './comparison';
import styles from './compare.module.css';
import { DifferencePane } from './DifferencePane';
import { DifferenceTree } from './DifferenceTree';
import { StateMark } from './StateMark';
import { useSides } from './useComparison';

interface ComparisonViewProps {
  projectId: string;
  comparison: Comparison;
  titles: readonly [string, string];
  ignoring: Ignoring;
  ignore: (ignoring: Ignoring) => void;
  choices: Choices;
  /** Null: nothing can be taken over. */
  choose: ((choices: Choices) => void) | null;
}

const IGNORABLE = ['white_space', 'comments', 'pragmas'] as const;

/** What differs as a tree, and the object in hand on both sides. */
export function ComparisonView(props: ComparisonViewProps) {
  const { projectId, comparison, titles, ignoring, ignore, choices, choose } = props;
  const t = useText();
  const [search, setSearch] = useState('');
  const [hidden, toggleHidden] = useToggleSet<State>();
  const [row, setRow] = useState<string | null>(null);
  const known = usePaths(projectId);
  const shown = useMemo(
    () => filtered(comparison.differences, hidden, search),
    [comparison.differences, hidden, search],
  );
  const difference = row === null ? shown[0] : shown.find((one) => one.key === row);
  const key = difference?.key ?? null;
  const sides = useSides(projectId, comparison, key);
  const monaco = useQuery({ queryKey: ['monaco'], queryFn: loadMonaco, staleTime: Infinity });
  const select = (next: DiffRow) => setRow(next.difference?.key ?? next.path);
  const count = (state: State) => comparison.differences.filter((one) => one.state === state).length;
  return (
    <div className={styles.comparison}>
      <div className={styles.left}>
        <div className={styles.bar}>
          <FilterInput label={t('compare.filter')} value={search} onValue={setSearch} />
        </div>
        <div className={styles.bar}>
          <FilterToggles kinds={STATES} hidden={hidden} toggle={toggleHidden}>
            {(state) => <StateMark state={state} count={count(state)} />}
          </FilterToggles>
        </div>
        {comparison.differences.length === 0 ? (
          <div className={styles.same}>
            <Empty title={t('compare.same')} />
          </div>
        ) : (
          <DifferenceTree
            differences={shown}
            known={known}
            selected={row ?? key}
            select={select}
            choices={choices}
            choose={choose}
          />
        )}
        <div className={styles.ignoring} role="group" aria-label={t('compare.ignore')}>
          <span>{t('compare.ignore')}</span>
          {IGNORABLE.map((what) => (
            <Checkbox
              key={what}
              checked={ignoring[what]}
              onChecked={(checked) => ignore({ ...ignoring, [what]: checked })}
            >
              {t(`compare.ignore.${what}`)}
            </Checkbox>
          ))}
        </div>
      </div>
      <div className={styles.right}>
        {difference === undefined ? (
          <Empty title={t(comparison.differences.length ? 'compare.chooseOne' : 'compare.same')} />
        ) : sides.error || monaco.error ? (
          <Failed error={sides.error ?? monaco.error} retry={() => void (sides.error ? sides : monaco).refetch()} />
        ) : sides.data && monaco.data ? (
          <>
            <div className={styles.path}>
              <StateMark state={difference.state} />
              <span title={sideOf(difference).path}>{displayPath(sideOf(difference).path)}</span>
            </div>
            <DifferencePane
              key={difference.key}
              monaco={monaco.data}
              difference={difference}
              sides={sides.data}
              titles={titles}
              ignoreWhiteSpace={ignoring.white_space}
              choice={choices.get(difference.key) ?? NOTHING}
              choose={choose && ((choice) => choose(withChoice(choices, difference.key, choice)))}
            />
          </>
        ) : (
          <Loading />
        )}
      </div>
    </div>
  );
}

/** The objects of the project by their paths. */
function usePaths(projectId: string): ReadonlyMap<string, ObjectSummary> {
  const { data } = useObjects(projectId);
  return useMemo(() => {
    const objects = data ?? [];
    const forest = forestOf(objects);
    const path = (object: ObjectSummary) =>
      lineage(forest, object.id)
        .map((one) => one.name)
        .reverse()
        .join('/');
    return new Map(objects.map((object) => [path(object), object]));
  }, [data]);
}
