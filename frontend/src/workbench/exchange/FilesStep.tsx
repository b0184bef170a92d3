import { FileUp, FolderUp, X } from 'lucide-react';
import { useRef, useState, type DragEvent } from 'react';
import { useText } from '@/i18n';
import { guard } from '@/ui/notices';
import { Button, IconButton } from '@/ui/Button';
import { chosenFiles, droppedFiles, type NamedFile } from './dropped';
import styles from './Exchange.module.css';

const SHOWN = 200;
/** Opens the dialog of the browser for a folder instead of files; React does not know the attribute. */
const FOLDER = { webkitdirectory: '' } as object;

interface FilesStepProps {
  files: readonly NamedFile[];
  change: (files: readonly NamedFile[]) => void;
}

/** The files of an import: chosen, a folder of them, or dropped. */
export function FilesStep({ files, change }: FilesStepProps) {
  const t = useText();
  const [over, setOver] = useState(false);
  const single = useRef<HTMLInputElement>(null);
  const folder = useRef<HTMLInputElement>(null);
  const add = (more: readonly NamedFile[]) => {
    const paths = new Set(more.map(({ path }) => path));
    change([...files.filter(({ path }) => !paths.has(path)), ...more]);
  };
  const later = (found: Promise<readonly NamedFile[]>) => void guard(async () => add(await found));
  const drop = (event: DragEvent) => {
    event.preventDefault();
    setOver(false);
    later(droppedFiles(event.dataTransfer));
  };
  return (
    <section
      className={styles.drop}
      aria-label={t('exchange.files')}
      data-over={over ? '' : undefined}
      onDragOver={(event) => {
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={drop}
    >
      <div className={styles.buttons}>
        <Button icon={FileUp} data-autofocus onClick={() => single.current?.click()}>
          {t('exchange.chooseFiles')}
        </Button>
        <Button icon={FolderUp} onClick={() => folder.current?.click()}>
          {t('exchange.chooseFolder')}
        </Button>
        <span className={styles.muted}>{t('exchange.dropHere')}</span>
        <input
          ref={single}
          type="file"
          multiple
          hidden
          aria-label={t('exchange.chooseFiles')}
          onChange={(event) => {
            later(chosenFiles(event.target.files ?? []));
            event.target.value = '';
          }}
        />
        <input
          ref={folder}
          type="file"
          hidden
          aria-label={t('exchange.chooseFolder')}
          {...FOLDER}
          onChange={(event) => {
            later(chosenFiles(event.target.files ?? []));
            event.target.value = '';
          }}
        />
      </div>
      {files.length === 0 ? (
        <p className={styles.muted}>{t('exchange.formats')}</p>
      ) : (
        <ul className={styles.files}>
          {files.slice(0, SHOWN).map(({ path }) => (
            <li key={path}>
              <span title={path}>{path}</span>
              <IconButton
                small
                icon={X}
                label={t('exchange.removeFile', { name: path })}
                onClick={() => change(files.filter((one) => one.path !== path))}
              />
            </li>
          ))}
          {files.length > SHOWN && (
            <li className={styles.muted}>{t('exchange.moreFiles', { count: files.length - SHOWN })}</li>
          )}
        </ul>
      )}
    </section>
  );
}
