import { expect, it } from 'vitest';
import { millisecondText, secondText, timeText } from './clock';

it('times are local and sortable', () => {
  const at = new Date(2026, 2, 10, 8, 5, 2, 45).toISOString();
  expect(secondText(at)).toBe('2026-03-10 08:05:02');
  expect(timeText(Date.parse(at))).toBe('08:05:02');
  expect(millisecondText(at)).toBe('2026-03-10 08:05:02.045');
});
