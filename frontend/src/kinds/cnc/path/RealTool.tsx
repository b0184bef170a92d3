import { useEffect, useState } from 'react';
import { Eraser } from 'lucide-react';
import { useText } from '@/i18n';
import { useLiveNumber, useWatched } from '@/online/useLive';
import { IconButton } from '@/ui/Button';
import { TextInput } from '@/ui/Field';
import styles from './Path.module.css';
import type { Vector } from './projection';

const AXES = ['X', 'Y', 'Z'] as const;
/** Positions of the trace; older ones go. */
const MOST_PLACES = 4000;
const INTERVAL_MS = 50;

interface RealToolProps {
  runtimeId: string;
  objectId: string;
  onTool: (tool: Vector | null, trace: readonly Vector[]) => void;
}

type Names = readonly [string, string, string];
const NONE: Names = ['', '', ''];

/** The variables that say where the real tool is, and the trace that it leaves. */
export function RealTool({ runtimeId, objectId, onTool }: RealToolProps) {
  const t = useText();
  const [names, setNames] = useState<Names>(() => rememberedNames(objectId));
  const [typed, setTyped] = useState<Names>(names);
  const [trace, setTrace] = useState<readonly Vector[]>([]);
  useWatched(
    runtimeId,
    names.filter((name) => name !== ''),
    INTERVAL_MS,
  );
  const x = useLiveNumber(runtimeId, names[0]);
  const y = useLiveNumber(runtimeId, names[1]);
  const z = useLiveNumber(runtimeId, names[2]);
  const known = (names[0] !== '' && x !== null) || (names[1] !== '' && y !== null);
  const place: Vector | null = known ? [x ?? 0, y ?? 0, z ?? 0] : null;
  const last = trace.at(-1);
  if (place !== null && (last === undefined || place.some((value, axis) => value !== last[axis])))
    setTrace([...trace.slice(-MOST_PLACES + 1), place]);
  useEffect(() => {
    onTool(known ? [x ?? 0, y ?? 0, z ?? 0] : null, trace);
  }, [onTool, known, x, y, z, trace]);
  useEffect(() => () => onTool(null, []), [onTool]);
  const take = () => {
    const next = typed.map((name) => name.trim()) as unknown as Names;
    setTyped(next);
    if (next.every((name, axis) => name === names[axis])) return;
    setNames(next);
    setTrace([]);
    rememberNames(objectId, next);
  };
  return (
    <div className={styles.tools} role="group" aria-label={t('cnc.tool')} data-testid="path-real-tool">
      <span>{t('cnc.tool')}</span>
      {AXES.map((axis, at) => (
        <TextInput
          key={axis}
          aria-label={t('cnc.tool.axis', { axis })}
          placeholder={t('cnc.tool.axis', { axis })}
          value={typed[at]}
          onValue={(value) => setTyped(typed.map((name, n) => (n === at ? value : name)) as unknown as Names)}
          onBlur={take}
          onKeyDown={(event) => event.key === 'Enter' && take()}
        />
      ))}
      <IconButton
        small
        icon={Eraser}
        label={t('cnc.tool.clear')}
        disabledReason={trace.length === 0 ? t('cnc.tool.noTrace') : null}
        onClick={() => setTrace([])}
      />
    </div>
  );
}

const keyOf = (objectId: string) => `tappet.cnc.tool.${objectId}`;

function rememberedNames(objectId: string): Names {
  try {
    const found: unknown = JSON.parse(localStorage.getItem(keyOf(objectId)) ?? 'null');
    if (Array.isArray(found) && found.length === 3 && found.every((name) => typeof name === 'string'))
      return found as unknown as Names;
  } catch {
    // Storage that is refused or spoilt remembers nothing.
  }
  return NONE;
}

function rememberNames(objectId: string, names: Names): void {
  try {
    localStorage.setItem(keyOf(objectId), JSON.stringify(names));
  } catch {
    // Private windows may refuse storage; then the choice lasts as long as the page.
  }
}
