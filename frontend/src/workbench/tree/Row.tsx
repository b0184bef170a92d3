import { useProject } from '@/project/openProject';
import { kindOf } from '@/project/kinds';
import { CloudUpload, Zap } from 'lucide-react';
import { useRef, useState, type KeyboardEvent } from 'react';
import type { LoginRelation, ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { displayName } from '@/project/objectName';
import type { OnlineTone } from '../onlineSession';
import { Floating } from '@/ui/Floating';
import { ToneDot } from '../online/ToneDot';
import { Twist } from '@/ui/Twist';
import type { Mark } from './marks';
import type { Row } from '@/project/tree';
import styles from './Tree.module.css';

const INDENT = 14;
const START = 4;

/** Where guide lines and drop lines of a level begin, in pixels. */
export function indentOf(level: number): number {
  return START + (level - 1) * INDENT;
}

interface TreeRowProps {
  row: Row;
  filter: string;
  /** The active application, drawn bold. */
  strong: boolean;
  tone: OnlineTone | undefined;
  /** Online: the program in the controller is not the present one. */
  relation: LoginRelation | undefined;
  mark: Mark | undefined;
  /** From the build, itself or with what it is below. */
  excluded: boolean;
  renaming: boolean;
  faultOf: (name: string) => string | null;
  onTwist: () => void;
  onRenamed: (name: string | null) => void;
}

/** The inside of a tree row: guide lines, twisty, icon, name, what it is, state. */
export function TreeRow({
  row,
  filter,
  strong,
  tone,
  relation,
  mark,
  excluded,
  renaming,
  faultOf,
  onTwist,
  onRenamed,
}: TreeRowProps) {
  const t = useText();
  const { object } = row;
  return (
    <>
      {Array.from({ length: row.level - 1 }, (_, level) => (
        <span key={level} className={styles.guide} style={{ left: indentOf(level + 1) + 8 }} />
      ))}
      <span style={{ width: indentOf(row.level) - 6, flex: 'none' }} />
      <Twist
        open={row.expanded}
        expandable={row.expandable}
        onClick={(event) => {
          event.stopPropagation();
          onTwist();
        }}
        onDoubleClick={(event) => event.stopPropagation()}
      />
      <span className={styles.icon}>
        <ObjectIcon kind={object.kind} subkind={object.subkind} name={object.name} />
      </span>
      {renaming ? (
        <NameField name={object.name} faultOf={faultOf} onDone={onRenamed} />
      ) : (
        <>
          <span
            className={styles.name}
            data-strong={strong ? '' : undefined}
            data-excluded={excluded ? '' : undefined}
            data-severity={mark?.severity}
            title={excluded ? t('tree.excluded') : undefined}
          >
            <Marked text={displayName(object)} filter={filter} />
          </span>
          <Suffix object={object} tone={tone} />
          {relation && relation !== 'same' && <RelationMark relation={relation} />}
          {mark?.forced && (
            <span className={styles.forced} title={t('tree.forced')}>
              F
            </span>
          )}
        </>
      )}
    </>
  );
}

/** What the object is, in the short form that the field uses: PRG, FB, FUN; for applications their state online. */
function Suffix({ object, tone }: { object: ObjectSummary; tone: OnlineTone | undefined }) {
  const t = useText();
  const { projectId } = useProject();
  if (tone) {
    return (
      <span className={styles.state}>
        <ToneDot tone={tone} />
        <span className={styles.suffix} data-tone={tone}>
          {t(`online.tone.${tone}`)}
        </span>
      </span>
    );
  }
  const kind = kindOf(object.kind);
  const State = kind?.state;
  if (State && projectId !== null) return <State projectId={projectId} object={object} />;
  const short = kind?.subkinds?.[object.subkind ?? '']?.short;
  return short ? <span className={styles.suffix}>({short})</span> : null;
}

/** Changed since the download: what brings the controller up to date. */
function RelationMark({ relation }: { relation: LoginRelation }) {
  const t = useText();
  const Icon = relation === 'online_change' ? Zap : CloudUpload;
  return <Icon className={styles.relation} size={13} aria-label={t(`relation.${relation}`)} />;
}

function Marked({ text, filter }: { text: string; filter: string }) {
  const at = filter ? text.toLowerCase().indexOf(filter.toLowerCase()) : -1;
  if (at < 0) return text;
  return (
    <>
      {text.slice(0, at)}
      <mark>{text.slice(at, at + filter.length)}</mark>
      {text.slice(at + filter.length)}
    </>
  );
}

interface NameFieldProps {
  name: string;
  faultOf: (name: string) => string | null;
  /** The new name, or null when it stays. */
  onDone: (name: string | null) => void;
}

/** The name being edited: Enter takes it, Escape leaves it; a name that cannot be says why at once. */
function NameField({ name, faultOf, onDone }: NameFieldProps) {
  const t = useText();
  const [value, setValue] = useState(name);
  const [anchor, setAnchor] = useState<HTMLSpanElement | null>(null);
  const fault = value === name ? null : faultOf(value);
  // Taking the name moves the focus away, which must not take it a second time.
  const done = useRef(false);
  const finish = (result: string | null) => {
    if (done.current) return;
    done.current = true;
    onDone(result === name ? null : result);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    event.stopPropagation();
    if (event.key === 'Enter' && !fault) finish(value);
    else if (event.key === 'Escape') finish(null);
  };
  return (
    <span ref={setAnchor}>
      <input
        className={styles.rename}
        value={value}
        aria-label={t('command.rename')}
        aria-invalid={fault !== null}
        autoFocus
        spellCheck={false}
        onFocus={(event) => event.target.select()}
        onChange={(event) => setValue(event.target.value)}
        onKeyDown={onKeyDown}
        onPointerDown={(event) => event.stopPropagation()}
        onDoubleClick={(event) => event.stopPropagation()}
        onBlur={() => finish(fault ? null : value)}
      />
      {fault && (
        <Floating anchor={anchor} className={styles.fault}>
          <span role="alert">{fault}</span>
        </Floating>
      )}
    </span>
  );
}
