import type { OnlineTone } from '../onlineSession';

const TONE_COLORS: Record<OnlineTone, string> = {
  running: 'var(--ok)',
  halted: 'var(--error)',
  stopped: 'var(--error)',
  exception: 'var(--error)',
  simulated: 'var(--warn)',
  lost: 'var(--warn)',
  past: 'var(--past)',
  unknown: 'var(--fg-muted)',
};

/** State of a runtime as a small dot: filled while it runs, a ring while the connection is lost. */
export function ToneDot({ tone, size = 7 }: { tone: OnlineTone; size?: number }) {
  const color = TONE_COLORS[tone];
  const hollow = tone === 'lost' || tone === 'unknown';
  return (
    <span
      aria-hidden
      style={{
        width: size,
        height: size,
        flex: 'none',
        borderRadius: tone === 'stopped' ? 1.5 : '50%',
        background: hollow ? 'transparent' : color,
        border: hollow ? `1.5px solid ${color}` : undefined,
      }}
    />
  );
}
