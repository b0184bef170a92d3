// @vitest-environment happy-dom
import { afterEach, expect, it } from 'vitest';
import { setLanguage } from '@/i18n';
import '@/kinds/register';
import { displayPath, displayPlace } from './objectName';

afterEach(() => setLanguage('en'));

it('says fixed names of a path in the language of the user, and no other', async () => {
  expect(displayPath('Line/PLC Logic/App/Library Manager')).toBe('Line / PLC Logic / App / Library Manager');
  await setLanguage('zh');
  expect(displayPath('Line/PLC Logic/App/Library Manager')).toBe('Line / PLC 逻辑 / App / 库管理器');
  expect(displayPlace('Line/PLC Logic/App/PLC_PRG', ': ')).toBe('Line: PLC 逻辑: App');
  expect(displayPlace('GVL')).toBe('');
});
