import { useMemo, type RefObject } from 'react';
import type { ObjectSummary } from '@/api/types';
import { InputAssistant } from '@/editors/assistant/InputAssistant';
import type { Range } from '@/editors/plot/scales';
import { openDialog } from '@/ui/dialogs';
import { guard } from '@/ui/notices';
import type { Enablement, Handlers } from '@/workbench/commands';
import { saveBlob } from '@/workbench/downloadFile';
import type { OnlineSession } from '@/workbench/onlineSession';
import { TRACE_ACTS, type Need, type TraceActId } from './acts';
import { AxisTemplateDialog } from './AxisTemplateDialog';
import { changeChannels, newRecord, withoutNodes, withVariables, type Node, type TraceData } from './configuration';
import { ConfigurationDialog } from './ConfigurationDialog';
import type { TraceState } from './data/source';
import { back, compressed, forward, shown, stretched, WHOLE_VIEW, type Views } from './diagram/viewport';
import type { Computed } from './diagram/diagrams';
import { ExportDialog } from './ExportDialog';
import { LongTermDialog } from './LongTermDialog';
import { OnlineListDialog } from './OnlineListDialog';
import type { TraceOnline } from './online';
import { pictureOf } from './picture';
import { nextCursors, type TraceView } from './traceView';
import { usualAppearance } from './usualAppearance';

/** What acts see of the editor. */
export interface TraceScene {
  projectId: string;
  object: ObjectSummary;
  /** The configuration of what is shown. */
  data: TraceData;
  /** Why the configuration cannot be changed. */
  readOnly: string | null;
  /** Whether curves may be shown and hidden. */
  mayShow: boolean;
  change: (data: TraceData) => void;
  view: TraceView;
  setView: (change: (view: TraceView) => TraceView) => void;
  seen: Range;
  session: OnlineSession | null;
  state: TraceState | null;
  online: TraceOnline;
  /** The diagrams on the page. */
  place: () => HTMLElement | null;
}

/** Opens the configuration with what is chosen in front. */
export function openConfiguration(scene: TraceScene, nodes: readonly Node[]): void {
  void openDialog((close) => (
    <ConfigurationDialog
      projectId={scene.projectId}
      object={scene.object}
      data={scene.data}
      nodes={nodes}
      readOnly={scene.readOnly}
      onData={scene.change}
      close={close}
    />
  ));
}

const zoom = ({ setView, seen }: TraceScene, to: (range: Range) => Range) =>
  setView((view) => ({ ...view, views: shown(view.views, { ...view.views.now, x: to(seen) }) }));
const go = ({ setView }: TraceScene, to: (views: Views) => Views) =>
  setView((view) => ({ ...view, views: to(view.views) }));

/** Draws what is computed of the chosen variables, or no longer. */
function toggleComputed({ view, setView }: TraceScene, operation: Computed['operation']): void {
  const chosen = view.nodes.flatMap(({ record, channel }) =>
    channel === null ? [] : [{ record, channel, operation }],
  );
  const same = (one: Computed, other: Computed) =>
    one.record === other.record && one.channel === other.channel && one.operation === other.operation;
  setView((before) => {
    const rest = before.computed.filter((one) => !chosen.some((other) => same(one, other)));
    const fresh = chosen.filter((one) => !before.computed.some((other) => same(one, other)));
    return { ...before, computed: [...rest, ...fresh] };
  });
}

async function addVariable(scene: TraceScene): Promise<void> {
  const found = await openDialog<string>((close) => (
    <InputAssistant projectId={scene.projectId} object={scene.object} close={close} />
  ));
  if (found === undefined) return;
  const record = scene.view.nodes.at(-1)?.record ?? 0;
  scene.change(withVariables(scene.data, record, [found]));
}

const RUN: Readonly<Record<TraceActId, (scene: TraceScene) => void>> = {
  'trace.addVariable': (scene) => void addVariable(scene),
  'trace.addRecord': ({ data, change }) =>
    change({ ...data, records: [...data.records, newRecord(data.records, usualAppearance())] }),
  'trace.axisTemplate': (scene) =>
    void openDialog((close) => (
      <AxisTemplateDialog
        projectId={scene.projectId}
        object={scene.object}
        data={scene.data}
        onData={scene.change}
        close={close}
      />
    )),
  'trace.delete': ({ data, change, view, setView }) => {
    change(withoutNodes(data, view.nodes));
    setView((before) => ({ ...before, nodes: [] }));
  },
  'trace.visible': ({ data, change, view }) =>
    change(changeChannels(data, view.nodes, (channel) => ({ ...channel, visible: !channel.visible }))),
  'trace.derivative': (scene) => toggleComputed(scene, 'derivative'),
  'trace.integral': (scene) => toggleComputed(scene, 'integral'),
  'trace.appearance': (scene) =>
    openConfiguration(scene, scene.view.nodes.length > 0 ? scene.view.nodes : [{ record: 0, channel: null }]),
  'trace.configuration': (scene) => openConfiguration(scene, scene.view.nodes),
  'trace.download': ({ online }) => void guard(() => online.download()),
  'trace.start': ({ online }) => void guard(() => online.tell('start')),
  'trace.stop': ({ online }) => void guard(() => online.tell('stop')),
  'trace.resetTrigger': ({ online }) => void guard(() => online.tell('reset-trigger')),
  'trace.onlineList': ({ session }) =>
    session && void openDialog((close) => <OnlineListDialog runtimeId={session.runtimeId} close={close} />),
  'trace.upload': ({ online, change }) => void guard(async () => change(await online.configuration())),
  'trace.snapshot': ({ online }) => void guard(() => online.snapshot()),
  'trace.longTerm': ({ online, state }) => {
    if (state?.recording) void guard(online.endRecording);
    else
      void openDialog((close) => <LongTermDialog title={online.title()} begin={online.beginRecording} close={close} />);
  },
  'trace.save': ({ online }) => void guard(() => online.save('trace', 0)),
  'trace.load': ({ online }) => online.load(),
  'trace.export': ({ data, online }) =>
    void openDialog((close) => <ExportDialog records={data.records} online={online} close={close} />),
  'trace.picture': ({ place, object }) =>
    void guard(async () => {
      const found = place();
      if (found) saveBlob(await pictureOf(found), `${object.name}.png`);
    }),
  'trace.cursor': ({ seen, setView }) =>
    setView((view) => ({ ...view, cursors: nextCursors(view.cursors, seen), panel: view.panel ?? 'measure' })),
  'trace.mouseScroll': ({ setView }) => setView((view) => ({ ...view, tool: 'scroll' })),
  'trace.mouseZoom': ({ setView }) => setView((view) => ({ ...view, tool: 'zoom' })),
  'trace.resetView': (scene) => go(scene, (views) => shown(views, WHOLE_VIEW)),
  'trace.zoomToCursors': (scene) => {
    const [one, other] = scene.view.cursors;
    if (one !== undefined && other !== undefined && one !== other)
      zoom(scene, () => ({ min: Math.min(one, other), max: Math.max(one, other) }));
  },
  'trace.viewBack': (scene) => go(scene, back),
  'trace.viewForward': (scene) => go(scene, forward),
  'trace.compress': (scene) => zoom(scene, compressed),
  'trace.stretch': (scene) => zoom(scene, stretched),
  'trace.multiChannel': ({ setView }) => setView((view) => ({ ...view, multi: !view.multi, diagram: null })),
};

export type Possible = Readonly<Record<Need, Enablement>>;

/** The acts of the trace that is shown, as commands find them: the same object until what is possible changes. */
export function useTraceActs(latest: RefObject<TraceScene | null>, possible: Possible): Handlers {
  const key = JSON.stringify(possible);
  return useMemo(() => {
    const known = JSON.parse(key) as Possible;
    return Object.fromEntries(
      TRACE_ACTS.map(({ id, needs }) => [
        id,
        {
          run: () => {
            if (latest.current) RUN[id](latest.current);
          },
          enabled: needs.map((need) => known[need]).find((one) => one !== true) ?? true,
        },
      ]),
    );
  }, [latest, key]);
}
