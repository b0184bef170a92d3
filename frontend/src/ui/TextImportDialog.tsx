import { Upload } from 'lucide-react';
import { useRef, useState, type ReactNode } from 'react';
import { Button } from './Button';
import { Field, TextArea } from './Field';
import { FormDialog } from './FormDialog';
import { explain } from './notices';

interface TextImportDialogProps {
  title: string;
  texts: {
    description: string;
    action: string;
    /** Why nothing can be taken yet. */
    empty: string;
    chooseFile: string;
    /** Name of the field of the text. */
    text: string;
    tooLarge: (name: string) => string;
  };
  /** Kinds of files that are offered. */
  accept: string;
  /** Bytes of a file. */
  largest: number;
  rows: number;
  placeholder: string;
  /** Takes the text; what it throws stands below it. `fileName` is '' where the text was pasted. */
  take: (text: string, fileName: string) => Promise<void>;
  close: (answer?: true) => void;
  /** Fields above the text. */
  children?: ReactNode;
}

/** A text that is chosen as a file or pasted, and taken over. */
export function TextImportDialog(props: TextImportDialogProps) {
  const { title, texts, accept, largest, rows, placeholder, take, close, children } = props;
  const [text, setText] = useState('');
  const [fileName, setFileName] = useState('');
  const [fault, setFault] = useState<string | null>(null);
  const file = useRef<HTMLInputElement>(null);
  const read = async (given: File | undefined) => {
    if (!given) return;
    if (given.size > largest) {
      setFault(texts.tooLarge(given.name));
      return;
    }
    setFault(null);
    setFileName(given.name);
    setText(await given.text());
  };
  const submit = async () => {
    try {
      await take(text, fileName);
      close(true);
    } catch (error) {
      setFault(explain(error).text ?? explain(error).title);
    }
  };
  return (
    <FormDialog
      title={title}
      description={texts.description}
      width={560}
      action={texts.action}
      disabledReason={text.trim() === '' ? texts.empty : null}
      onClose={() => close()}
      onSubmit={() => void submit()}
      aside={
        <>
          <Button icon={Upload} onClick={() => file.current?.click()}>
            {texts.chooseFile}
          </Button>
          <span style={{ flex: 1 }} />
        </>
      }
    >
      <input
        ref={file}
        type="file"
        accept={accept}
        hidden
        aria-label={texts.chooseFile}
        onChange={(event) => {
          void read(event.target.files?.[0]);
          event.target.value = '';
        }}
      />
      {children}
      <Field label={texts.text} error={fault}>
        {(attributes) => (
          <TextArea
            {...attributes}
            rows={rows}
            className="code"
            spellCheck={false}
            placeholder={placeholder}
            value={text}
            onValue={(next) => {
              setFault(null);
              setText(next);
            }}
          />
        )}
      </Field>
    </FormDialog>
  );
}
