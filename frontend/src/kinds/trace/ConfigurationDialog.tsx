import { Plus, Trash2 } from 'lucide-react';
import { useMemo, useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { FormDialog } from '@/ui/FormDialog';
import {
  changeChannels,
  changeRecord,
  faultsOf,
  MOST_RECORDS,
  newChannel,
  newRecord,
  nodeKey,
  sameNode,
  withoutNodes,
  type Node,
  type TraceData,
} from './configuration';
import { faultText, type FieldContext } from './fields';
import { RecordSettings, TraceSettings } from './RecordSettings';
import { TraceTree } from './TraceTree';
import { storeUsualAppearance, usualAppearance } from './usualAppearance';
import { VariableSettings } from './VariableSettings';
import styles from './Trace.module.css';

interface ConfigurationDialogProps {
  projectId: string;
  object: ObjectSummary;
  data: TraceData;
  /** What is shown first; none: the settings of all records. */
  nodes: readonly Node[];
  /** Why nothing can be changed. */
  readOnly: string | null;
  onData: (data: TraceData) => void;
  close: (answer?: true) => void;
}

/** The configuration of a trace: the tree of records and variables, and the settings of what is chosen (sections 2 to 5). */
export function ConfigurationDialog(props: ConfigurationDialogProps) {
  const { projectId, object, nodes: first, readOnly, onData, close } = props;
  const t = useText();
  const [data, setData] = useState(props.data);
  const [nodes, setNodes] = useState<readonly Node[]>(first);
  const faults = useMemo(() => faultsOf(data), [data]);
  const faulty = new Set(faults.flatMap(({ node }) => (node ? [nodeKey(node)] : [])));
  const last = nodes.at(-1) ?? null;
  const channels = nodes.flatMap(({ record, channel }) => {
    const found = channel === null ? undefined : data.records[record]?.channels[channel];
    return found ? [found] : [];
  });
  const own = faults.filter(({ node }) => (node === null ? last === null : last !== null && sameNode(node, last)));
  const context: FieldContext = {
    disabled: readOnly !== null,
    projectId,
    object,
    faultOf: (field) => (nodes.length > 1 && channels.length > 1 ? null : faultText(t, own, field)),
  };
  const addRecord = () => {
    const records = [...data.records, newRecord(data.records, usualAppearance())];
    setData({ ...data, records });
    setNodes([{ record: records.length - 1, channel: null }]);
  };
  const addVariable = () => {
    const records = data.records.length === 0 ? [newRecord([], usualAppearance())] : data.records;
    const at = Math.min(last?.record ?? 0, records.length - 1);
    const record = records[at]!;
    setData(
      changeRecord({ ...data, records }, at, {
        channels: [...record.channels, newChannel('', usualAppearance().y)],
      }),
    );
    setNodes([{ record: at, channel: record.channels.length }]);
  };
  const remove = () => {
    if (readOnly !== null || nodes.length === 0) return;
    setData(withoutNodes(data, nodes));
    setNodes([]);
  };
  const record = last === null ? undefined : data.records[last.record];
  const page = () => {
    if (last === null || record === undefined) return <TraceSettings data={data} context={context} onData={setData} />;
    if (channels.length === 0 || last.channel === null)
      return (
        <RecordSettings
          key={last.record}
          record={record}
          context={context}
          onRecord={(change) => setData(changeRecord(data, last.record, change))}
          onUsual={storeUsualAppearance}
        />
      );
    return (
      <VariableSettings
        key={nodes.map(nodeKey).join(' ')}
        channels={channels}
        number={nodes.find(({ channel }) => channel !== null)?.channel ?? 0}
        context={context}
        onChannels={(change) => setData(changeChannels(data, nodes, change))}
      />
    );
  };
  const [fault] = faults;
  const where = (node: Node | null) => {
    if (node === null) return '';
    const found = data.records[node.record]!;
    return node.channel === null ? `${found.name}: ` : `${found.name}, ${node.channel + 1}: `;
  };
  return (
    <FormDialog
      title={t('trace.configurationOf', { name: object.name })}
      width={920}
      action={t('action.apply')}
      disabledReason={readOnly ?? (fault ? `${where(fault.node)}${t(fault.key, fault.values)}` : null)}
      onClose={() => close()}
      onSubmit={() => {
        onData(data);
        close(true);
      }}
    >
      <div className={styles.settings}>
        <div className={styles.settingsSide}>
          <button type="button" className={styles.root} aria-pressed={last === null} onClick={() => setNodes([])}>
            {object.name}
          </button>
          <TraceTree
            data={data}
            nodes={nodes}
            onNodes={setNodes}
            faulty={faulty}
            label={t('trace.tree')}
            onOpen={(node) => setNodes([node])}
            onVisible={(chosen) =>
              readOnly === null &&
              setData(changeChannels(data, chosen, (channel) => ({ ...channel, visible: !channel.visible })))
            }
            onDelete={remove}
            menu={() => [
              { kind: 'item', key: 'add', text: t('trace.addVariable'), disabledReason: readOnly, run: addVariable },
              {
                kind: 'item',
                key: 'delete',
                text: t('trace.delete'),
                disabledReason: readOnly ?? (nodes.length === 0 ? t('trace.reason.selected') : null),
                run: remove,
              },
            ]}
          />
          <div className={styles.links}>
            <Button icon={Plus} variant="quiet" disabledReason={readOnly} onClick={addVariable}>
              {t('trace.variable')}
            </Button>
            <Button
              icon={Plus}
              variant="quiet"
              disabledReason={
                readOnly ??
                (data.records.length >= MOST_RECORDS ? t('trace.mostRecords', { most: MOST_RECORDS }) : null)
              }
              onClick={addRecord}
            >
              {t('trace.record')}
            </Button>
            <span className={styles.grow} />
            <IconButton
              icon={Trash2}
              label={t('trace.delete')}
              shortcut="Delete"
              disabledReason={readOnly ?? (nodes.length === 0 ? t('trace.reason.selected') : null)}
              onClick={remove}
            />
          </div>
        </div>
        <div className={styles.settingsPage}>{page()}</div>
      </div>
    </FormDialog>
  );
}
