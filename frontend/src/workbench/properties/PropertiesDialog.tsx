import { useQuery } from '@tanstack/react-query';
import { Suspense, useState } from 'react';
import { api } from '@/api/client';
import { dataText } from '@/api/objects';
import { objectQuery, useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { kindOf, kindTitle, subkindTitle } from '@/project/kinds';
import { displayName, displayPath } from '@/project/objectName';
import { treePath } from '@/project/tree';
import { Button } from '@/ui/Button';
import { Loading } from '@/ui/Empty';
import { Facts } from '@/ui/Facts';
import { Checkbox, Field, TextInput } from '@/ui/Field';
import { Dialog } from '@/ui/Dialog';
import { useRefusal } from '@/ui/useRefusal';
import { secondText } from '../clock';
import { reasonText } from '../run';
import { mayEdit } from '../rights';
import { renameObject } from '../tree/acts';
import { useCommandContext } from '../useCommandContext';
import { excludeObjects } from './exclude';
import { factsOf } from './facts';

interface PropertiesDialogProps {
  projectId: string;
  object: ObjectSummary;
  close: () => void;
}

/** What an object is and where, who made it, what its text says; name and build can be changed. */
export function PropertiesDialog({ projectId, object: given, close }: PropertiesDialogProps) {
  const t = useText();
  const { data: objects } = useObjects(projectId);
  // What has become of it since the dialog was opened.
  const object = objects?.find((one) => one.id === given.id) ?? given;
  const { data: detail } = useQuery(objectQuery(projectId, object.id));
  const path = { project_id: projectId, object_id: object.id };
  const { data: revisions } = useQuery({
    queryKey: ['project', projectId, 'object', object.id, 'revisions', object.revision],
    queryFn: () => api.get('/api/v1/projects/{project_id}/objects/{object_id}/revisions', { params: { path } }),
  });
  const context = useCommandContext();
  const [name, setName] = useState(object.name);
  const [excluded, setExcluded] = useState(object.excluded);
  const [refused, ask] = useRefusal();
  const Own = kindOf(object.kind)?.properties;
  const compiled = kindOf(object.kind)?.compiled ?? false;
  const kind = [kindTitle(object.kind), object.subkind ? subkindTitle(object.subkind) : ''].filter(Boolean).join(' · ');
  const facts = detail && factsOf(dataText(detail, 'declaration'), dataText(detail, 'implementation'));
  const bodyLanguage = detail ? dataText(detail, 'language') : '';
  const created = revisions?.at(-1);
  const changed = revisions?.[0];
  const by = (one: { author: string; at: string }) =>
    t('properties.by', { author: one.author, at: secondText(one.at) });
  const editable = mayEdit(context);
  const same = name.trim() === object.name && excluded === object.excluded;
  const nothing = same ? t('properties.nothingChanged') : null;
  const apply = () =>
    ask(async () => {
      if (name.trim() !== object.name) await renameObject(projectId, object, name.trim());
      if (excluded !== object.excluded) await excludeObjects(projectId, [object], excluded);
      close();
    });

  return (
    <Dialog
      title={t('properties.title', { name: displayName(object) })}
      width={520}
      onClose={close}
      onSubmit={() => !same && editable === true && void apply()}
      footer={
        <>
          <Button onClick={close}>{t('action.close')}</Button>
          <Button type="submit" variant="primary" disabledReason={editable === true ? nothing : reasonText(editable)}>
            {t('properties.apply')}
          </Button>
        </>
      }
    >
      <Field row label={t('properties.name')} error={refused}>
        {(attributes) => (
          <TextInput {...attributes} value={name} onValue={setName} readOnly={editable !== true} data-autofocus />
        )}
      </Field>
      {compiled && (
        <Checkbox checked={excluded} onChecked={setExcluded} disabled={editable !== true}>
          {t('command.exclude')}
        </Checkbox>
      )}
      <Facts>
        <Fact title={t('properties.kind')} text={kind} />
        <Fact title={t('properties.language')} text={bodyLanguage} />
        <Fact title={t('properties.path')} text={displayPath(treePath(objects ?? [], object.id), '/')} />
        <Fact title={t('properties.access')} text={facts?.access ?? ''} />
        <Fact title={t('properties.modifiers')} text={facts?.modifiers.join(', ') ?? ''} />
        <Fact title={t('properties.attributes')} text={facts?.attributes.join('\n') ?? ''} />
        <Fact title={t('properties.comment')} text={facts?.comment ?? ''} />
        {facts && facts.characters > 0 && (
          <Fact title={t('properties.size')} text={`${String(facts.lines)} / ${String(facts.characters)}`} />
        )}
        <Fact title={t('properties.created')} text={created ? by(created) : ''} />
        <Fact title={t('properties.changed')} text={changed ? by(changed) : ''} />
        <Fact title={t('properties.changeComment')} text={changed?.comment ?? ''} />
        <Fact title={t('properties.revision')} text={String(object.revision)} />
      </Facts>
      {Own && (
        <Suspense fallback={<Loading />}>
          <Own projectId={projectId} objectId={object.id} />
        </Suspense>
      )}
    </Dialog>
  );
}

/** A line of what is known; nothing where nothing is. */
function Fact({ title, text }: { title: string; text: string }) {
  if (text === '') return null;
  return (
    <>
      <dt>{title}</dt>
      <dd style={{ whiteSpace: 'pre-line' }}>{text}</dd>
    </>
  );
}
