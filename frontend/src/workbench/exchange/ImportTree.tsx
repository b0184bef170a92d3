import { useMemo, useState } from 'react';

import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { ChoiceTree } from '@/ui/ChoiceTree';
import { useToggleSet } from '@/ui/toggleSet';
import { checkedOf, nodeRows, toggled, type NodeForest } from './model';
import styles from './Exchange.module.css';

interface ImportTreeProps {
  forest: NodeForest;
  chosen: ReadonlySet<string>;
  search: string;
  change: (chosen: ReadonlySet<string>) => void;
}

/** What the files hold, each object with a box. */
export function ImportTree({ forest, chosen, search, change }: ImportTreeProps) {
  const t = useText();
  const [closed, toggleClosed] = useToggleSet<string>();
  const [focused, setFocused] = useState(0);
  const rows = useMemo(() => nodeRows(forest, closed, search), [forest, closed, search]);
  const checked = useMemo(() => checkedOf(forest, chosen), [forest, chosen]);
  return (
    <ChoiceTree
      label={t('exchange.contents')}
      className={styles.contents}
      rows={rows}
      at={Math.min(focused, rows.length - 1)}
      goTo={setFocused}
      keyOf={({ node }) => node.key}
      tooltipOf={({ node }) => (node.line === null ? node.source : `${node.source}:${node.line}`)}
      twist={({ node }) => toggleClosed(node.key)}
      checkedOf={({ node }) => checked.get(node.key) ?? 'none'}
      toggle={({ node }) => change(toggled(forest, chosen, node.key))}
    >
      {({ node }) => (
        <>
          <ObjectIcon kind={node.kind} subkind={node.subkind} name={node.name} />
          <span data-excluded={node.excluded ? '' : undefined} className={styles.nodeName}>
            {node.name}
          </span>
        </>
      )}
    </ChoiceTree>
  );
}
