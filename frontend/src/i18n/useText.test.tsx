// @vitest-environment happy-dom
import { useMemo } from 'react';
import { afterEach, expect, it } from 'vitest';
import { clear, reads, show } from '../../tests/page';
import { setLanguage, useText } from '.';

afterEach(async () => {
  clear();
  await setLanguage('en');
});

function Head() {
  const t = useText();
  const columns = useMemo(() => [t('log.time'), t('log.message')], [t]);
  return <p>{columns.join(', ')}</p>;
}

it('gives remembered texts anew when the language changes', async () => {
  const page = await reads(show(<Head />), 'Time, Message');
  await setLanguage('zh');
  await reads(page, '时间');
  expect(page.textContent).not.toContain('Time');
});
