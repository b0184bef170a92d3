import { ArrowLeft, ArrowRight } from 'lucide-react';
import { useText } from '@/i18n';
import { Checkbox, Select, TextInput } from '@/ui/Field';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { presentMessages, useMessages } from '@/workbench/messages/store';
import {
  bindingOf,
  channelFault,
  channelsOf,
  fittingTypes,
  isInput,
  unboundChannels,
  type Binding,
  type Channel,
  type ChannelType,
} from './channels';
import styles from './Axis.module.css';
import type { AxisPageProps } from './model';

/** Whether the channels of the drive are bound by themselves, and else to what (AXIS-22). */
export function ChannelSection({ objectId, axis, disabled, change }: AxisPageProps) {
  const t = useText();
  const channels = channelsOf(axis.drive);
  const { mapping } = axis;
  const simulated = axis.drive === 'SM_Drive_Simulated';
  if (channels.length === 0 && !simulated) return null;
  const unbound = unboundChannels(axis);
  const bind = (channel: Channel, binding: Binding) =>
    change({ mapping: { ...mapping, channels: { ...mapping.channels, [channel.name]: binding } } });
  return (
    <Section title={t('axis.channels.title')}>
      <Checkbox
        checked={mapping.automatic || simulated}
        disabled={disabled || simulated}
        onChecked={(automatic) => change({ mapping: { ...mapping, automatic } })}
      >
        {t('axis.channels.automatic')}
      </Checkbox>
      <p className={form.note}>
        {t(
          simulated
            ? 'axis.channels.simulatedText'
            : mapping.automatic
              ? 'axis.channels.automaticText'
              : 'axis.channels.text',
        )}
      </p>
      {!simulated && !mapping.automatic && (
        <>
          <table className={styles.channels}>
            <thead>
              <tr>
                <th>{t('axis.channels.channel')}</th>
                <th>{t('axis.channels.index')}</th>
                <th>{t('axis.channels.direction')}</th>
                <th>{t('axis.channels.type')}</th>
                <th>{t('axis.channels.place')}</th>
              </tr>
            </thead>
            <tbody>
              {channels.map((channel) => (
                <ChannelRow
                  key={channel.name}
                  objectId={objectId}
                  channel={channel}
                  binding={bindingOf(channel, axis)}
                  disabled={disabled}
                  onBinding={(binding) => bind(channel, binding)}
                />
              ))}
            </tbody>
          </table>
          {unbound.length > 0 && (
            <div className={form.banner} data-tone="warn">
              {t('axis.channels.unbound', { channels: unbound.map(({ name }) => name).join(', ') })}
            </div>
          )}
        </>
      )}
    </Section>
  );
}

interface ChannelRowProps {
  objectId: string;
  channel: Channel;
  binding: Binding;
  disabled: boolean;
  onBinding: (binding: Binding) => void;
}

function ChannelRow({ objectId, channel, binding, disabled, onBinding }: ChannelRowProps) {
  const t = useText();
  const fault = channelFault(channel, binding);
  const built = useBuildMessage(objectId, channel.name);
  const types = fittingTypes(channel);
  const Arrow = isInput(channel) ? ArrowRight : ArrowLeft;
  const message = fault ? t(fault.text, { ...fault }) : built;
  const note = `${channel.name}-note`;
  return (
    <>
      <tr>
        <th className="code">{channel.name}</th>
        <td>{channel.index}</td>
        <td>
          <span className={form.inline}>
            <Arrow size={14} aria-hidden />
            {t(isInput(channel) ? 'axis.channels.in' : 'axis.channels.out')}
          </span>
        </td>
        <td>
          <Select<ChannelType>
            compact
            label={t('axis.channels.typeOf', { channel: channel.name })}
            disabled={disabled}
            value={binding.type}
            choices={(types.includes(binding.type) ? types : [...types, binding.type]).map((type) => ({
              value: type,
              text: type,
            }))}
            onValue={(type) => onBinding({ ...binding, type })}
          />
        </td>
        <td>
          <TextInput
            className="code"
            aria-label={t('axis.channels.placeOf', { channel: channel.name })}
            aria-invalid={message !== null || undefined}
            aria-describedby={message === null ? undefined : note}
            disabled={disabled}
            value={binding.place}
            onValue={(place) => onBinding({ ...binding, place })}
          />
        </td>
      </tr>
      {message !== null && (
        <tr>
          <td />
          <td colSpan={4} className={styles.channelFault}>
            <div id={note} role="alert">
              {message}
            </div>
          </td>
        </tr>
      )}
    </>
  );
}

/** What the last build said of a row. */
function useBuildMessage(objectId: string, channel: string): string | null {
  const build = useMessages((state) => state.build);
  const live = useMessages((state) => state.live);
  const found = presentMessages(build, live).find(
    (message) => message.object_id === objectId && message.element === channel,
  );
  return found?.message ?? null;
}
