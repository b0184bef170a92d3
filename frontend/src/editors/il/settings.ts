import { settingsOf } from '@/session/settings';
import type { TextView } from '@/text/settings';

export interface IlSettings {
  /** View in which bodies open. */
  view: TextView;
  /** Optional columns of the table (FBD-41, IL-01). */
  address: boolean;
  symbolComment: boolean;
  operandComment: boolean;
}

export const ilSettings = settingsOf<IlSettings>('editors.il', {
  view: 'table',
  address: true,
  symbolComment: true,
  operandComment: true,
});
