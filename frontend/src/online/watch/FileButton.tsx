import { useRef } from 'react';
import type { IconComponent } from '@/icons/IconComponent';
import { Button, IconButton } from '@/ui/Button';
import { guard } from '@/ui/notices';

interface FileButtonProps {
  icon: IconComponent;
  label: string;
  disabledReason: string | null;
  /** Its name stands on it: it is alone, as where nothing is listed yet. */
  named?: boolean;
  onText: (text: string) => void;
}

/** A button that asks for a text file and hands on what it holds. */
export function FileButton({ icon, label, disabledReason, named, onText }: FileButtonProps) {
  const field = useRef<HTMLInputElement>(null);
  const ask = () => field.current?.click();
  return (
    <>
      {named === true ? (
        <Button icon={icon} disabledReason={disabledReason} onClick={ask}>
          {label}
        </Button>
      ) : (
        <IconButton small icon={icon} label={label} disabledReason={disabledReason} onClick={ask} />
      )}
      <input
        ref={field}
        type="file"
        accept=".txt,text/plain"
        hidden
        aria-label={label}
        onChange={(event) => {
          const file = event.target.files?.[0];
          event.target.value = '';
          if (file) void guard(async () => onText(await file.text()));
        }}
      />
    </>
  );
}
