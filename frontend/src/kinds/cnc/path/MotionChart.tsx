import 'uplot/dist/uPlot.min.css';
import { useEffect, useRef, type PointerEvent } from 'react';
import uPlot from 'uplot';
import { useSize } from '@/editors/plot/useSize';
import { useText } from '@/i18n';
import { usePreferences } from '@/session/preferences';
import styles from './Path.module.css';
import type { PathSamples } from './pathView';

interface MotionChartProps {
  samples: PathSamples;
  time: number;
  onTime: (time: number) => void;
}

/** Velocity and acceleration on the path over the time, with the moment that is shown. */
export function MotionChart({ samples, time, onTime }: MotionChartProps) {
  const t = useText();
  const place = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const now = useRef(time);
  const theme = usePreferences((state) => state.shown);
  const { width, height } = useSize(place);
  const sized = width > 60 && height > 40;
  useEffect(() => {
    if (!sized || place.current === null) return;
    const style = getComputedStyle(place.current);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const axis = (label: string, scale: string, extra: Partial<uPlot.Axis> = {}): uPlot.Axis => ({
      scale,
      label,
      labelSize: 16,
      labelFont: `11px ${style.fontFamily}`,
      font: `11px ${style.fontFamily}`,
      size: 46,
      stroke: colour('--fg-muted'),
      grid: { stroke: colour('--line'), width: 1 },
      ticks: { stroke: colour('--line'), width: 1 },
      ...extra,
    });
    const made = new uPlot(
      {
        width,
        height,
        padding: [8, 4, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false } },
        axes: [
          axis(t('cnc.motion.time'), 'x', { size: 26 }),
          axis(t('cnc.motion.velocity'), 'v', { stroke: colour('--curve-1') }),
          axis(t('cnc.motion.acceleration'), 'a', {
            side: 1,
            space: 24,
            grid: { show: false },
            stroke: colour('--curve-2'),
          }),
        ],
        series: [
          {},
          { scale: 'v', stroke: colour('--curve-1'), width: 1.5, points: { show: false } },
          { scale: 'a', stroke: colour('--curve-2'), width: 1, points: { show: false } },
        ],
        hooks: {
          draw: [
            (self) => {
              const x = self.valToPos(now.current, 'x', true);
              self.ctx.save();
              self.ctx.strokeStyle = colour('--accent');
              self.ctx.lineWidth = 1.5 * devicePixelRatio;
              self.ctx.beginPath();
              self.ctx.moveTo(x, self.bbox.top);
              self.ctx.lineTo(x, self.bbox.top + self.bbox.height);
              self.ctx.stroke();
              self.ctx.restore();
            },
          ],
        },
      },
      [samples.time, samples.velocity, samples.acceleration],
      place.current,
    );
    plot.current = made;
    return () => {
      plot.current = null;
      made.destroy();
    };
  }, [samples, sized, width, height, theme, t]);
  useEffect(() => {
    now.current = time;
    plot.current?.redraw(false, false);
  }, [time]);
  const seek = (event: PointerEvent<HTMLDivElement>) => {
    const chart = plot.current;
    if (chart === null || event.buttons !== 1) return;
    const box = chart.over.getBoundingClientRect();
    onTime(Math.min(samples.duration, Math.max(0, chart.posToVal(event.clientX - box.left, 'x'))));
  };
  return (
    <div
      ref={place}
      className={styles.chart}
      role="img"
      aria-label={t('cnc.motion.chart')}
      data-testid="path-chart"
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        seek(event);
      }}
      onPointerMove={seek}
    />
  );
}
