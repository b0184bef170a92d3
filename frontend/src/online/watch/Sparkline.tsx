import { useEffect, useRef } from 'react';
import { useText } from '@/i18n';
import { formatShort } from '../format';
import { curve, SAMPLE_MS, type ValueHistory } from './history';
import styles from './Watch.module.css';

const WIDTH = 120;
const HEIGHT = 20;
const REAL = { kind: 'real', type: 'LREAL', size: 8 };

/** The last minute of a value, drawn into a canvas four times a second; smallest and largest value on hover. */
export function Sparkline({ history, name }: { history: ValueHistory; name: string }) {
  const t = useText();
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const draw = () => {
      const element = canvas.current;
      const context = element?.getContext('2d');
      if (!element || !context) return;
      const scale = window.devicePixelRatio || 1;
      if (element.width !== WIDTH * scale) {
        element.width = WIDTH * scale;
        element.height = HEIGHT * scale;
      }
      context.setTransform(scale, 0, 0, scale, 0, 0);
      context.clearRect(0, 0, WIDTH, HEIGHT);
      const view = history.view(name);
      if (view === null) return;
      context.strokeStyle = getComputedStyle(element).color;
      context.lineWidth = 1.25;
      context.beginPath();
      let before: number | null = null;
      for (const [x, y] of curve(view, performance.now(), WIDTH, HEIGHT - 4)) {
        // A value stays until the next one comes.
        if (before === null) context.moveTo(x, y + 2);
        else {
          context.lineTo(x, before + 2);
          context.lineTo(x, y + 2);
        }
        before = y;
      }
      if (before !== null) context.lineTo(WIDTH, before + 2);
      context.stroke();
    };
    draw();
    const timer = setInterval(draw, SAMPLE_MS);
    return () => clearInterval(timer);
  }, [history, name]);
  return (
    <canvas
      ref={canvas}
      className={styles.sparkline}
      role="img"
      aria-label={t('watch.historyOf', { name })}
      onPointerEnter={(event) => {
        const view = history.view(name);
        const text = (value: number) => formatShort(value, REAL);
        event.currentTarget.title =
          view === null ? t('watch.noHistory') : t('watch.range', { min: text(view.min), max: text(view.max) });
      }}
    />
  );
}
