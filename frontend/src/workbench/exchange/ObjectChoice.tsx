import { useMemo, useState } from 'react';

import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { Button } from '@/ui/Button';
import { ChoiceTree } from '@/ui/ChoiceTree';
import { FilterInput } from '@/ui/Filter';
import { useToggleSet } from '@/ui/toggleSet';
import { checkedOf, nodeRows, toggled, type ChoiceNode, type NodeForest } from './choice';
import styles from './Exchange.module.css';

interface ObjectChoiceProps<Node extends ChoiceNode> {
  /** Accessible name of the tree. */
  label: string;
  forest: NodeForest<Node>;
  chosen: ReadonlySet<string>;
  change: (chosen: ReadonlySet<string>) => void;
  tooltipOf: (node: Node) => string;
  /** There is much else in the dialog. */
  short?: boolean;
}

/** Objects, each with a box; those of a name can be searched. */
export function ObjectChoice<Node extends ChoiceNode>(props: ObjectChoiceProps<Node>) {
  const { label, forest, chosen, change, tooltipOf, short } = props;
  const t = useText();
  const [search, setSearch] = useState('');
  const [closed, toggleClosed] = useToggleSet<string>();
  const [focused, setFocused] = useState(0);
  const rows = useMemo(() => nodeRows(forest, closed, search), [forest, closed, search]);
  const checked = useMemo(() => checkedOf(forest, chosen), [forest, chosen]);
  return (
    <>
      <div className={styles.buttons}>
        <FilterInput className={styles.filter} label={t('exchange.searchObjects')} value={search} onValue={setSearch} />
        <Button onClick={() => change(new Set(forest.nodes.map(({ key }) => key)))}>{t('exchange.all')}</Button>
        <Button onClick={() => change(new Set())}>{t('exchange.none')}</Button>
      </div>
      <div className={short ? styles.short : undefined}>
        <ChoiceTree
          label={label}
          className={styles.contents}
          rows={rows}
          at={Math.min(focused, rows.length - 1)}
          goTo={setFocused}
          keyOf={({ node }) => node.key}
          tooltipOf={({ node }) => tooltipOf(node)}
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
      </div>
    </>
  );
}
