import type { ReactNode } from 'react';
import { Failed, Loading } from '@/ui/Empty';
import type { Draft } from './useDraft';
import styles from './Form.module.css';

interface FormPageProps<Data> {
  draft: Draft<Data>;
  /** For what stands in two columns. */
  wide?: boolean;
  children: (data: Data) => ReactNode;
}

/**
 * The scrolling page of a form editor, with what stands in the way of changing it on top. Where nothing in it can have the keyboard,
 * the page itself has it, so that it can be scrolled.
 */
export function FormPage<Data>({ draft, wide, children }: FormPageProps<Data>) {
  if (draft.error && !draft.object) return <Failed error={draft.error} />;
  if (!draft.object || draft.data === undefined) return <Loading />;
  return (
    <div className={styles.page} tabIndex={draft.readOnly ? 0 : undefined}>
      <div className={styles.inner} data-wide={wide}>
        {draft.readOnly && <div className={styles.banner}>{draft.readOnly}</div>}
        {draft.refused && (
          <div className={styles.banner} data-tone="error" role="alert">
            {draft.refused}
          </div>
        )}
        {children(draft.data)}
      </div>
    </div>
  );
}

export function Section({ title, tools, children }: { title: string; tools?: ReactNode; children: ReactNode }) {
  return (
    <section className={styles.section}>
      <h2 className={styles.heading}>
        {title}
        {tools && <span style={{ marginLeft: 'auto' }}>{tools}</span>}
      </h2>
      {children}
    </section>
  );
}
