/**
 * The workbench with everything that registers itself with it, in the order of the rooms; components load when first
 * shown. The kinds of objects are known before: the start page shows them, too.
 */
import { registerBookmarks } from '@/bookmarks/register';
import { registerCompare } from '@/compare/register';
import { registerEditors } from '@/editors/register';
import { registerHelp } from '@/help/register';
import '@/i18n/workbenchTexts';
import { registerOnline } from '@/online/register';
import { registerScripts } from '@/scripts/register';
import { registerSearch } from '@/search/register';
import { Workbench } from '@/workbench/frame/Workbench';
import { registerPanelCommands, registerWorkbench } from '@/workbench/register';

registerWorkbench();
registerCompare();
registerOnline();
registerSearch();
registerBookmarks();
registerScripts();
registerHelp();
registerEditors();
registerPanelCommands();

export default Workbench;
