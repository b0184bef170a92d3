import { ImageUp, Trash2 } from 'lucide-react';
import { useRef, useState, type DragEvent } from 'react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Field } from '@/ui/Field';
import styles from './PageSetup.module.css';
import { logoAddress, logoFrom, type Fault } from './model';

interface LogoFieldProps {
  logo: string | null;
  disabled: boolean;
  onLogo: (logo: string | null) => void;
}

/** The picture of the company: chosen, dropped, shown and taken out. */
export function LogoField({ logo, disabled, onLogo }: LogoFieldProps) {
  const t = useText();
  const input = useRef<HTMLInputElement>(null);
  const [fault, setFault] = useState<Fault | null>(null);
  const take = async (file: File | undefined) => {
    if (!file || disabled) return;
    const read = logoFrom(new Uint8Array(await file.arrayBuffer()));
    setFault('fault' in read ? read.fault : null);
    if ('logo' in read) onLogo(read.logo);
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    void take(event.dataTransfer.files[0]);
  };
  return (
    <Field row label={t('pageSetup.logo')} hint={t('pageSetup.logoHint')} error={fault && t(fault.text, fault.values)}>
      {(attributes) => (
        <div className={styles.logo} onDragOver={(event) => event.preventDefault()} onDrop={drop}>
          {logo !== null && <img src={logoAddress(logo)} alt={t('pageSetup.logo')} />}
          <Button
            {...attributes}
            icon={ImageUp}
            disabledReason={disabled ? t('pageSetup.readOnly') : null}
            onClick={() => input.current?.click()}
          >
            {t('pageSetup.chooseLogo')}
          </Button>
          {logo !== null && !disabled && (
            <Button icon={Trash2} variant="quiet" onClick={() => onLogo(null)}>
              {t('pageSetup.removeLogo')}
            </Button>
          )}
          <input
            ref={input}
            type="file"
            hidden
            accept="image/png,image/jpeg"
            aria-label={t('pageSetup.chooseLogo')}
            onChange={(event) => {
              void take(event.target.files?.[0]);
              event.target.value = '';
            }}
          />
        </div>
      )}
    </Field>
  );
}
