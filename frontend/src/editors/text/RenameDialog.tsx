import { useMemo, useState } from 'react';
import { useText } from '@/i18n';
import type { CrossReference } from '@/lsp/symbols';
import { FormDialog } from '@/ui/FormDialog';
import { Field, TextInput } from '@/ui/Field';
import { identifierProblem } from '@/iec/keywords';
import list from '@/ui/List.module.css';
import styles from './RenameDialog.module.css';

const SHOWN = 200;

interface RenameDialogProps {
  name: string;
  places: readonly CrossReference[];
  /** `Application.PLC_PRG – Implementation` of a text. */
  nameOf: (uri: string) => string;
  /** Renames; throws with the reason when it cannot be. */
  rename: (name: string) => Promise<void>;
  close: () => void;
}

/** New name for a symbol, and what every place of it will look like. */
export function RenameDialog({ name, places, nameOf, rename, close }: RenameDialogProps) {
  const t = useText();
  const [next, setNext] = useState(name);
  const [refused, setRefused] = useState<{ name: string; reason: string } | null>(null);
  const [busy, setBusy] = useState(false);
  const wanted = next.trim();
  const problem = identifierProblem(wanted);
  const error =
    problem !== null
      ? t(`decl.identifier.${problem}`, { name: wanted })
      : refused?.name === wanted
        ? refused.reason
        : null;
  const objects = useMemo(() => new Set(places.map((place) => place.uri.split('/').at(-2))).size, [places]);
  const submit = async () => {
    if (busy) return;
    setBusy(true);
    try {
      await rename(wanted);
      close();
    } catch (reason) {
      setRefused({ name: wanted, reason: reason instanceof Error ? reason.message : String(reason) });
      setBusy(false);
    }
  };
  return (
    <FormDialog
      title={t('st.renameTitle', { name })}
      description={t('st.renameText')}
      width={620}
      onClose={close}
      onSubmit={() => void submit()}
      action={t('st.rename')}
      disabledReason={error ?? (wanted === name ? t('st.sameName') : null)}
    >
      <Field label={t('st.newName')} error={error}>
        {(field) => <TextInput {...field} value={next} onValue={setNext} data-autofocus />}
      </Field>
      {places.length > 0 && (
        <>
          <span className={styles.count}>
            {t('st.renamePlaces', {
              places: t('st.places', { count: places.length }),
              objects: t('st.objects', { count: objects }),
            })}
          </span>
          <ul className={`${list.list} ${styles.places}`} aria-label={t('st.renamePreview')} tabIndex={0}>
            {places.slice(0, SHOWN).map((place) => (
              <li
                key={`${place.uri} ${place.range.start.line} ${place.range.start.character}`}
                className={styles.place}
              >
                <span className={styles.object} title={nameOf(place.uri)}>
                  {nameOf(place.uri)}
                </span>
                <span className={styles.line}>{place.range.start.line + 1}</span>
                <Line place={place} name={wanted === '' ? name : wanted} />
              </li>
            ))}
          </ul>
        </>
      )}
    </FormDialog>
  );
}

function Line({ place, name }: { place: CrossReference; name: string }) {
  const { text, range } = place;
  const before = text.slice(0, range.start.character).trimStart();
  const after = text.slice(range.end.character);
  return (
    <span className={styles.text} title={`${before}${name}${after}`}>
      {before}
      <mark>{name}</mark>
      {after}
    </span>
  );
}
