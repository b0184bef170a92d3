import type { SymbolTree } from '@/online/symbols';
import { openDialog } from '@/ui/dialogs';
import { closePanel, openObject } from '@/workbench/docking/dock';
import type { OnlineSession } from '@/workbench/onlineSession';
import { InstanceDialog } from './InstanceDialog';

interface InstanceQuestion {
  panelId: string;
  objectId: string;
  name: string;
  type: string;
  tree: SymbolTree;
  session: OnlineSession;
}

let asking = false;

/** Asks which instance to show and puts its editor in the place of the one without values. */
export async function chooseInstance({
  panelId,
  objectId,
  name,
  type,
  tree,
  session,
}: InstanceQuestion): Promise<void> {
  if (asking) return;
  asking = true;
  const codeId = session.runtime?.code_id ?? null;
  const instance = await openDialog<string>((close) => (
    <InstanceDialog type={type} codeId={codeId} tree={tree} close={close} />
  )).finally(() => {
    asking = false;
  });
  if (instance === undefined || instance === '') return;
  openObject(objectId, name, { instance });
  closePanel(panelId);
}
