import {
  ArrowDown,
  ArrowLeft,
  ArrowRight,
  ArrowUp,
  ChevronDown,
  ChevronRight,
  ChevronsDown,
  ChevronsUp,
  RotateCcw,
  RotateCw,
  Redo2,
  Undo2,
  ZoomIn,
  ZoomOut,
} from 'lucide-react';
import { useState } from 'react';
import { useText } from '@/i18n';
import type { IconComponent } from '@/icons/IconComponent';
import { Button, IconButton } from '@/ui/Button';
import type { CameraAct } from './camera';
import styles from './Path.module.css';

const ROWS: readonly (readonly (readonly [CameraAct, IconComponent])[])[] = [
  [
    ['zoomIn', ZoomIn],
    ['up', ArrowUp],
    ['zoomOut', ZoomOut],
  ],
  [
    ['left', ArrowLeft],
    ['down', ArrowDown],
    ['right', ArrowRight],
  ],
  [
    ['turnLeft', Undo2],
    ['tiltUp', ChevronsUp],
    ['turnRight', Redo2],
  ],
  [
    ['rollLeft', RotateCcw],
    ['tiltDown', ChevronsDown],
    ['rollRight', RotateCw],
  ],
];
const SIDES = [
  ['alongX', 'X'],
  ['alongY', 'Y'],
  ['alongZ', 'Z'],
] as const;

/** Moves the camera, never the path (CNC-60 to CNC-62). */
export function CameraPanel({ run }: { run: (act: CameraAct) => void }) {
  const t = useText();
  const [open, setOpen] = useState(true);
  return (
    <div className={styles.camera} role="group" aria-label={t('cnc.camera')}>
      <IconButton
        small
        icon={open ? ChevronDown : ChevronRight}
        label={t(open ? 'cnc.camera.hide' : 'cnc.camera.show')}
        aria-expanded={open}
        onClick={() => setOpen(!open)}
      />
      {open && (
        <>
          {ROWS.map((row) => (
            <div key={row[0]![0]} className={styles.cameraRow}>
              {row.map(([act, icon]) => (
                <IconButton key={act} small icon={icon} label={t(`cnc.camera.${act}`)} onClick={() => run(act)} />
              ))}
            </div>
          ))}
          <div className={styles.cameraRow}>
            {SIDES.map(([act, axis]) => (
              <Button
                key={act}
                variant="quiet"
                className={styles.side}
                aria-label={t(`cnc.camera.${act}`)}
                onClick={() => run(act)}
              >
                {axis}
              </Button>
            ))}
          </div>
        </>
      )}
    </div>
  );
}
