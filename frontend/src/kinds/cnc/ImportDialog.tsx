import { useText } from '@/i18n';
import { TextImportDialog } from '@/ui/TextImportDialog';

interface ImportDialogProps {
  take: (text: string) => void;
  close: (answer?: true) => void;
}

const LARGEST = 16 * 1024 * 1024;

/** Replaces the program by a text: chosen as file or pasted (CNC-91). */
export function ImportDialog({ take, close }: ImportDialogProps) {
  const t = useText();
  return (
    <TextImportDialog
      title={t('cnc.importTitle')}
      texts={{
        description: t('cnc.importText'),
        action: t('cnc.importAction'),
        empty: t('cnc.importEmpty'),
        chooseFile: t('cnc.chooseFile'),
        text: t('cnc.programText'),
        tooLarge: (name) => t('cnc.tooLarge', { name }),
      }}
      accept=".cnc,.txt,.gcode,.nc,text/plain"
      largest={LARGEST}
      rows={14}
      placeholder={'N0 G0 X0 Y0 F100\nN10 G1 X50 Y0'}
      take={(text) => {
        if (text.includes('\0')) return Promise.reject(new Error(t('cnc.notText')));
        take(text.replace(/^\ufeff/, '').replace(/\r\n?/g, '\n'));
        return Promise.resolve();
      }}
      close={close}
    />
  );
}
