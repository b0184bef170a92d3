import { ImageUp, Trash2 } from 'lucide-react';
import { useRef, useState, type DragEvent } from 'react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Field } from '@/ui/Field';
import styles from './PageSetup.module.css';
import { logoSize } from './logoSize';
import { logoAddress, logoFrom, MOST_LOGO_PIXELS, type Fault } from './model';

interface LogoFieldProps {
  logo: string | null;
  disabled: boolean;
  onLogo: (logo: string | null) => void;
}

/** The picture of a file, or what is wrong with it. */
async function readLogo(file: File): Promise<{ logo: string } | { fault: Fault }> {
  const read = logoFrom(new Uint8Array(await file.arrayBuffer()));
  if ('fault' in read) return read;
  try {
    const { width, height } = await logoSize(read.logo);
    const fits = Math.max(width, height) <= MOST_LOGO_PIXELS;
    return fits ? read : { fault: { text: 'pageSetup.logoPixels', values: { width, height, most: MOST_LOGO_PIXELS } } };
  } catch {
    return { fault: { text: 'pageSetup.logoDamaged' } };
  }
}

/** The picture of the company: chosen, dropped, shown and taken out. */
export function LogoField({ logo, disabled, onLogo }: LogoFieldProps) {
  const t = useText();
  const input = useRef<HTMLInputElement>(null);
  const [fault, setFault] = useState<Fault | null>(null);
  const take = async (file: File | undefined) => {
    if (!file || disabled) return;
    const read = await readLogo(file);
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
        <div className={styles.logo} onDragOver={(event) => event.preventDefault()} onDrop={drop} data-drop="logo">
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
            <Button
              icon={Trash2}
              variant="quiet"
              onClick={() => {
                setFault(null);
                onLogo(null);
              }}
            >
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
