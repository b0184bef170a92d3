import { ArrowDownAZ, ArrowUpAZ, Layers } from 'lucide-react';
import { useState } from 'react';
import { useText } from '@/i18n';
import { IconButton } from '@/ui/Button';
import { Field, Select } from '@/ui/Field';
import styles from './Cam.module.css';
import { CommitInput } from './CommitInput';
import type { CamEdit } from './edit';
import { ordered, propertiesOf, type Order, type Property } from './properties';

/** All properties of what is selected beside a graphical tab (CAM-60 to CAM-64). */
export function ElementProperties({ edit, of }: { edit: CamEdit; of: 'points' | 'tappets' }) {
  const t = useText();
  const [order, setOrder] = useState<Order>('type');
  const [descending, setDescending] = useState(false);
  const [about, setAbout] = useState<string | null>(null);
  const selected =
    edit.selected !== null && (edit.selected.kind === 'tappet') === (of === 'tappets') ? edit.selected : null;
  const properties = selected === null ? [] : ordered(propertiesOf(edit, selected, t), order, descending);
  const title =
    selected === null
      ? t('cam.properties')
      : selected.kind === 'tappet'
        ? t('cam.tappetOf', { number: selected.index + 1, track: edit.cam.tracks[selected.track]!.id })
        : t(`cam.row.${selected.kind}`, { number: selected.index + 1 });
  const place =
    selected === null
      ? ''
      : `${selected.kind}${'track' in selected ? String(selected.track) : ''}.${String(selected.index)}`;
  const choose = (next: Order) => {
    setDescending(next === order && !descending);
    setOrder(next);
  };
  return (
    <aside className={styles.properties} aria-label={t('cam.properties')}>
      <div className={styles.propertiesHead}>
        <span>{title}</span>
        <IconButton
          small
          icon={Layers}
          label={t('cam.sortByType')}
          pressed={order === 'type'}
          onClick={() => choose('type')}
        />
        <IconButton
          small
          icon={order === 'name' && descending ? ArrowUpAZ : ArrowDownAZ}
          label={t('cam.sortByName')}
          pressed={order === 'name'}
          onClick={() => choose('name')}
        />
      </div>
      {selected === null ? (
        <p className={styles.nothing}>{t(of === 'points' ? 'cam.nothingSelected' : 'cam.noTappetSelected')}</p>
      ) : (
        <div className={styles.propertyList}>
          {properties.map((property) => (
            <PropertyField
              key={`${place}.${property.id}`}
              property={property}
              chosen={property.id === about}
              onFocus={() => setAbout(property.id)}
            />
          ))}
        </div>
      )}
      <p className={styles.description} aria-live="polite">
        {properties.find((property) => property.id === about)?.about}
      </p>
    </aside>
  );
}

interface PropertyFieldProps {
  property: Property;
  /** Its description is shown. */
  chosen: boolean;
  onFocus: () => void;
}

function PropertyField({ property, chosen, onFocus }: PropertyFieldProps) {
  const [fault, setFault] = useState<string | null>(null);
  const { set, choices } = property;
  return (
    <div className={styles.property} data-chosen={chosen || undefined} onFocusCapture={onFocus} onPointerDown={onFocus}>
      <Field row label={property.title} error={fault}>
        {(attributes) =>
          choices ? (
            <Select
              {...attributes}
              compact
              disabled={set === undefined}
              value={property.value}
              choices={choices}
              onValue={(value) => set?.(value)}
            />
          ) : set ? (
            <CommitInput
              {...attributes}
              value={property.value}
              check={property.check ?? (() => null)}
              onFault={setFault}
              onCommit={set}
            />
          ) : (
            <output {...attributes} className={`${styles.readOnly} code`}>
              {property.value}
            </output>
          )
        }
      </Field>
    </div>
  );
}
