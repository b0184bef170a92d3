// @vitest-environment happy-dom
import { flushSync } from 'react-dom';
import { afterEach, expect, it, vi } from 'vitest';
import { clear, reads, show } from '../../tests/page';
import { FilterToggles } from './Filter';
import { FormDialog } from './FormDialog';
import { RadioCards } from './RadioCards';

afterEach(clear);

/** A form with one choice, as it stands on the page. */
async function form(disabledReason: string | null) {
  const submit = vi.fn();
  const close = vi.fn();
  const page = await reads(
    show(
      <FormDialog title="Start" action="Go" disabledReason={disabledReason} onSubmit={submit} onClose={close}>
        <RadioCards label="How" value="cold" cards={[{ value: 'cold', name: 'Cold', effect: '' }]} onValue={vi.fn()} />
      </FormDialog>,
    ),
    'Cold',
  );
  const button = (text: string) => [...page.querySelectorAll('button')].find((each) => each.textContent === text)!;
  const enter = () =>
    page
      .querySelector('[role="radio"]')!
      .dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true, cancelable: true }));
  return { submit, close, button, enter };
}

it('is submitted by its button and by Enter', async () => {
  const { submit, close, button, enter } = await form(null);
  button('Go').click();
  expect(submit).toHaveBeenCalledTimes(1);
  enter();
  expect(submit).toHaveBeenCalledTimes(2);
  expect(close).not.toHaveBeenCalled();
});

it('is submitted by neither while something is missing', async () => {
  const { submit, button, enter } = await form('A name is missing.');
  button('Go').click();
  enter();
  expect(submit).not.toHaveBeenCalled();
});

it('is given up by Cancel', async () => {
  const { submit, close, button } = await form('A name is missing.');
  button('Cancel').click();
  expect(close).toHaveBeenCalledTimes(1);
  expect(submit).not.toHaveBeenCalled();
});

it('is closed by Escape also while a tooltip is shown', async () => {
  const { close, button } = await form('A name is missing.');
  flushSync(() => button('Go').focus());
  await vi.waitFor(() => expect(document.querySelector('[role="tooltip"]')?.textContent).toBe('A name is missing.'));
  button('Go').dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true, cancelable: true }));
  expect(close).toHaveBeenCalledTimes(1);
});

it('is not submitted by what filters a list in it', async () => {
  const submit = vi.fn();
  const toggle = vi.fn();
  const page = await reads(
    show(
      <FormDialog title="Changes" action="Load" onSubmit={submit} onClose={vi.fn()}>
        <FilterToggles kinds={['lost']} hidden={new Set<'lost'>()} toggle={toggle}>
          {(kind) => kind}
        </FilterToggles>
      </FormDialog>,
    ),
    'lost',
  );
  [...page.querySelectorAll('button')].find((each) => each.textContent === 'lost')!.click();
  expect(toggle).toHaveBeenCalledWith('lost');
  expect(submit).not.toHaveBeenCalled();
});
