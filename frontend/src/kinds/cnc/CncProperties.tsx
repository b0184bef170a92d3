import { ofKind } from '@/api/objects';
import { useObject } from '@/api/queries';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { openDialog } from '@/ui/dialogs';
import { Facts } from '@/ui/Facts';
import { numberText } from '@/editors/form/numbers';
import { PropertiesDialog } from './PropertiesDialog';

/** The CNC part of the properties of an object (CNC-06), and the way to change it. */
export default function CncProperties({ projectId, objectId }: { projectId: string; objectId: string }) {
  const t = useText();
  const { data: object } = useObject(projectId, objectId, ofKind('cnc'));
  if (!object) return null;
  const { compile_mode, queue_size, velocity, acceleration, deceleration } = object.data;
  const facts = [
    [t('cnc.compileMode'), t(`cnc.mode.${compile_mode}`)],
    [t('cnc.queueSize'), String(queue_size)],
    [t('cnc.velocity'), numberText(velocity)],
    [t('cnc.acceleration'), numberText(acceleration)],
    [t('cnc.deceleration'), numberText(deceleration)],
  ];
  return (
    <>
      <Facts>
        {facts.map(([title, text]) => (
          <div key={title} style={{ display: 'contents' }}>
            <dt>{title}</dt>
            <dd>{text}</dd>
          </div>
        ))}
      </Facts>
      <Button
        onClick={() =>
          void openDialog((close) => (
            <PropertiesDialog projectId={projectId} objectId={objectId} name={object.name} close={close} />
          ))
        }
      >
        {t('cnc.properties')}
      </Button>
    </>
  );
}
