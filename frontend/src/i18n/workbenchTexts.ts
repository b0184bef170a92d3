/** English texts that only the workbench shows: fetched with it. */
import { addTexts } from './index';

addTexts(
  import.meta.glob<Readonly<Record<string, string>>>(
    ['./en/*.json', '!./en/{exchange,libraries,objects,online,workbench}.json', '../editors/*/en.json'],
    { eager: true, import: 'default' },
  ),
);
