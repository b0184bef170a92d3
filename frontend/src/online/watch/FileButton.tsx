import { useRef } from 'react';
import type { IconComponent } from '@/icons/IconComponent';
import { IconButton } from '@/ui/Button';
import { guard } from '@/ui/notices';

interface FileButtonProps {
  icon: IconComponent;
  label: string;
  disabledReason: string | null;
  onText: (text: string) => void;
}

/** A button that asks for a text file and hands on what it holds. */
export function FileButton({ icon, label, disabledReason, onText }: FileButtonProps) {
  const field = useRef<HTMLInputElement>(null);
  return (
    <>
      <IconButton
        small
        icon={icon}
        label={label}
        disabledReason={disabledReason}
        onClick={() => field.current?.click()}
      />
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
