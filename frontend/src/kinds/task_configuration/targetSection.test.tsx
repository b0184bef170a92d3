// @vitest-environment happy-dom
import { afterEach, describe, expect, it } from 'vitest';
import { clear, reads, show } from '../../../tests/page';
import { TargetSection } from './TargetSection';

afterEach(clear);

describe('what the device permits of tasks (TASK-04, TASK-07)', () => {
  it('is listed and cannot be changed', async () => {
    const page = show(<TargetSection />);
    await reads(page, 'At most 64');
    const facts = [...page.querySelectorAll('dt')].map((name) => [
      name.textContent,
      name.nextElementSibling!.textContent,
    ]);
    expect(facts).toEqual([
      ['Number of tasks', 'At most 64'],
      ['Priorities', '0 (highest) to 31 (lowest)'],
      ['Task types', 'Cyclic, Freewheeling, Event, Status, External event'],
      ['External events', 'StartDone, OnlineChangeDone, SIGUSR1, SIGUSR2'],
    ]);
    expect(page.querySelectorAll('input, button, [role="checkbox"], [role="combobox"]')).toHaveLength(0);
  });
});
