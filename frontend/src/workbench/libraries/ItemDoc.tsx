import { BookOpenText } from 'lucide-react';
import type { LibraryItem, Pin } from '@/api/types';
import { useText, type TextKey } from '@/i18n';
import { kindOfSubkind } from '@/project/kinds';
import { ObjectIcon } from '@/project/ObjectIcon';
import { Empty } from '@/ui/Empty';
import { BlockPicture } from './BlockPicture';
import styles from './Libraries.module.css';
import { groupOf } from './model';
import { useItemOfNow } from './useLibraries';

/** Documentation of a library item: comment, picture, pins, members, values. `library` may have a version: `Util, 1.0`. */
export function ItemDoc({ library, item: chosen }: { library: string | null; item: LibraryItem | null }) {
  const t = useText();
  const item = useItemOfNow(library, chosen);
  if (!item) return <Empty icon={BookOpenText} title={t('libraryDoc.none')} text={t('libraryDoc.noneText')} />;
  const { kind, subkind } = kindOfSubkind(item.kind);
  const drawn = groupOf(item.kind) === 'function_block' || item.kind === 'function';
  return (
    <article className={styles.doc} tabIndex={0}>
      <h2 className={styles.head}>
        <ObjectIcon kind={kind} subkind={subkind} size={18} />
        {item.name}
        <span className={styles.kind}>{library}</span>
      </h2>
      {item.summary && <p className={styles.comment}>{item.summary}</p>}
      {drawn && <BlockPicture item={item} className={styles.block} />}
      {item.returns && (
        <Pins title="libraryDoc.returns" pins={[{ name: item.name, type: item.returns, default: '', comment: '' }]} />
      )}
      <Pins title="libraryDoc.inputs" pins={item.inputs} />
      <Pins title="libraryDoc.inOut" pins={item.in_out} />
      <Pins title="libraryDoc.outputs" pins={item.outputs} />
      <Pins title="libraryDoc.members" pins={item.members} />
      <Values item={item} />
      <Methods item={item} />
    </article>
  );
}

function Pins({ title, pins }: { title: TextKey; pins: readonly Pin[] }) {
  const t = useText();
  if (pins.length === 0) return null;
  return (
    <section>
      <h3 className={styles.section}>{t(title)}</h3>
      <table className={styles.pins}>
        <thead>
          <tr>
            <th>{t('libraryDoc.name')}</th>
            <th>{t('libraryDoc.type')}</th>
            <th>{t('libraryDoc.initial')}</th>
            <th>{t('libraryDoc.comment')}</th>
          </tr>
        </thead>
        <tbody>
          {pins.map((pin) => (
            <tr key={pin.name}>
              <td>{pin.name}</td>
              <td>{pin.type}</td>
              <td>{pin.default}</td>
              <td>{pin.comment}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

function Methods({ item }: { item: LibraryItem }) {
  const t = useText();
  if (!item.methods?.length) return null;
  return (
    <section>
      <h3 className={styles.section}>{t('libraryDoc.methods')}</h3>
      {item.methods.map((method) => (
        <BlockPicture key={method.name} item={method} className={styles.block} />
      ))}
    </section>
  );
}

function Values({ item }: { item: LibraryItem }) {
  const t = useText();
  if (item.values.length === 0) return null;
  const text = (value: unknown) => (typeof value === 'string' || typeof value === 'number' ? String(value) : '');
  return (
    <section>
      <h3 className={styles.section}>{t('libraryDoc.values')}</h3>
      <table className={styles.pins}>
        <thead>
          <tr>
            <th>{t('libraryDoc.name')}</th>
            <th>{t('libraryDoc.value')}</th>
            <th />
            <th>{t('libraryDoc.comment')}</th>
          </tr>
        </thead>
        <tbody>
          {item.values.map((value) => (
            <tr key={text(value.name)}>
              <td>{text(value.name)}</td>
              <td>{text(value.value)}</td>
              <td />
              <td>{text(value.comment)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
