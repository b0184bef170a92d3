import fc from 'fast-check';
import '@/i18n/workbenchTexts';
import { registerKinds } from '@/kinds/register';

registerKinds();
// The same texts in each run; `FC_SEED=$RANDOM npm test` looks for others.
fc.configureGlobal({ seed: Number(process.env.FC_SEED ?? 1) });
