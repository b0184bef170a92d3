import { useMemo, useState, type ReactNode } from 'react';

import type { ObjectSummary } from '@/api/types';
import { listed, useText } from '@/i18n';
import { displayName } from '@/project/objectName';
import { Field, Select } from '@/ui/Field';
import styles from './Exchange.module.css';
import { ObjectChoice } from './ObjectChoice';
import { projectForest, requestOf, withAllBelow } from './choice';

type Scope = 'whole' | 'selection' | 'editor' | 'single';

interface PartSource {
  projectName: string;
  objects: readonly ObjectSummary[];
  selection: readonly ObjectSummary[];
  /** The object of the editor in front; absent: it is no choice here. */
  current?: ObjectSummary | null;
}

interface Part {
  field: ReactNode;
  /** For the foot of the dialog. */
  count: ReactNode;
  /** Why nothing can be made of it. */
  reason: string | null;
  /** Parameters of requests. */
  request: { object: string[]; without: string[] };
  /** That of the only object, else of the project. */
  name: string;
}

/** A choice of what is printed or exported: the project, what is selected of it, or single objects. */
export function usePart({ projectName, objects, selection, current }: PartSource): Part {
  const t = useText();
  const [scope, setScope] = useState<Scope>('whole');
  const [chosen, setChosen] = useState(() => withAllBelow(objects, selection));
  const forest = useMemo(() => projectForest(objects), [objects]);
  const ids = { whole: [], selection: selection.map(({ id }) => id), editor: current ? [current.id] : [] };
  const request = scope === 'single' ? requestOf(forest, chosen) : { object: ids[scope], without: [] };
  const only = request.object.length === 1 ? objects.find(({ id }) => id === request.object[0]) : undefined;
  const editor = {
    value: 'editor',
    text: current ? t('print.editor', { name: displayName(current) }) : t('print.noEditor'),
    disabled: !current,
  } as const;
  const field = (
    <>
      <Field label={t('exchange.scope')}>
        {(attributes) => (
          <Select
            {...attributes}
            value={scope}
            choices={[
              { value: 'whole', text: t('exchange.wholeProject') },
              {
                value: 'selection',
                text: selection.length
                  ? t('exchange.selection', { names: listed(selection.map(displayName)) })
                  : t('exchange.noSelection'),
                disabled: selection.length === 0,
              },
              ...(current === undefined ? [] : [editor]),
              { value: 'single', text: t('exchange.single') },
            ]}
            onValue={setScope}
          />
        )}
      </Field>
      {scope === 'single' && (
        <ObjectChoice
          label={t('exchange.projectObjects')}
          forest={forest}
          chosen={chosen}
          change={setChosen}
          tooltipOf={({ path }) => path}
          short
        />
      )}
    </>
  );
  const count = scope === 'single' && (
    <span className={styles.count}>{t('exchange.chosen', { chosen: chosen.size, count: forest.nodes.length })}</span>
  );
  const reason = scope === 'single' && chosen.size === 0 ? t('exchange.nothingChosen') : null;
  return { field, count, reason, request, name: only?.name ?? projectName };
}
