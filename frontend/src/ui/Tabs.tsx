import { Tabs as Radix } from 'radix-ui';
import { useState, type ReactNode } from 'react';
import styles from './Tabs.module.css';

export interface TabPage {
  id: string;
  title: string;
  content: ReactNode;
}

/** The pages of one editor. Only the page in front is mounted. */
export function Tabs({ pages, initial }: { pages: readonly TabPage[]; initial?: string }) {
  const [chosen, setChosen] = useState(initial ?? pages[0]?.id ?? '');
  const shown = pages.some((page) => page.id === chosen) ? chosen : (pages[0]?.id ?? '');
  return (
    <Radix.Root className={styles.tabs} value={shown} onValueChange={setChosen}>
      <Radix.List className={styles.list}>
        {pages.map((page) => (
          <Radix.Trigger key={page.id} value={page.id} className={styles.tab}>
            {page.title}
          </Radix.Trigger>
        ))}
      </Radix.List>
      {pages.map((page) => (
        <Radix.Content key={page.id} value={page.id} className={styles.content}>
          {page.content}
        </Radix.Content>
      ))}
    </Radix.Root>
  );
}
