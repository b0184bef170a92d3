import type { LibraryItem } from '@/api/types';
import { blockPins } from './model';

const ROW = 22;
const HEAD = 30;
const STUB = 14;
const LETTER = 7.3;

/** A function or function block as FBD draws it: name on top, inputs at the left, outputs at the right. */
export function BlockPicture({ item, className }: { item: LibraryItem; className?: string }) {
  const { left, right } = blockPins(item);
  const rows = Math.max(left.length, right.length, 1);
  const longest = (pins: readonly { name: string }[]) => Math.max(0, ...pins.map((pin) => pin.name.length));
  const types = (pins: readonly { type: string }[]) => Math.min(24, Math.max(0, ...pins.map((pin) => pin.type.length)));
  const inner = Math.max((longest(left) + longest(right)) * LETTER + 44, item.name.length * LETTER + 28);
  const before = types(left) * LETTER + STUB + 8;
  const width = before + inner + types(right) * LETTER + STUB + 8;
  const height = HEAD + rows * ROW + 10;
  const y = (row: number) => HEAD + row * ROW + ROW / 2;
  const short = (text: string) => (text.length > 24 ? `${text.slice(0, 23)}…` : text);
  return (
    <svg
      className={className}
      width={width + 2}
      height={height + 2}
      viewBox={`-1 -1 ${width + 2} ${height + 2}`}
      fontFamily="var(--font-code)"
      fontSize={12}
      role="img"
      aria-label={item.name}
    >
      <rect x={before} y={0} width={inner} height={height} rx={5} fill="var(--bg-raised)" stroke="var(--line-strong)" />
      <text x={before + inner / 2} y={20} textAnchor="middle" fill="var(--fg)" fontWeight={600}>
        {item.name}
      </text>
      {left.map((pin, row) => (
        <g key={pin.name}>
          <line x1={before - STUB} x2={before} y1={y(row)} y2={y(row)} stroke="var(--fg-muted)" />
          <text x={before - STUB - 6} y={y(row) + 4} textAnchor="end" fill="var(--fg-muted)">
            {short(pin.type)}
          </text>
          <text x={before + 8} y={y(row) + 4} fill="var(--fg)">
            {pin.inOut ? `⇄ ${pin.name}` : pin.name}
          </text>
        </g>
      ))}
      {right.map((pin, row) => (
        <g key={pin.name}>
          <line x1={before + inner} x2={before + inner + STUB} y1={y(row)} y2={y(row)} stroke="var(--fg-muted)" />
          {!pin.inOut && (
            <>
              <text x={before + inner - 8} y={y(row) + 4} textAnchor="end" fill="var(--fg)">
                {pin.name}
              </text>
              <text x={before + inner + STUB + 6} y={y(row) + 4} fill="var(--fg-muted)">
                {short(pin.type)}
              </text>
            </>
          )}
        </g>
      ))}
    </svg>
  );
}
