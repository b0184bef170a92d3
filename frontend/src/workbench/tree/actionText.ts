import { textOf } from '@/i18n';

/** What a change of a project did, in words; of an action that this page does not know, the server's word. */
export function actionText(action: string): string {
  return textOf(`action.done.${action}`) ?? action;
}
