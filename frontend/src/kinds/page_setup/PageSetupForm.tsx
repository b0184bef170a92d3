import { useText } from '@/i18n';
import { useProject } from '@/project/openProject';
import { useSession } from '@/session/session';
import { Checkbox, Field, Select, type SelectProps, TextInput } from '@/ui/Field';
import { Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { LogoField } from './LogoField';
import { PagePreview } from './PagePreview';
import own from './PageSetup.module.css';
import {
  EDGES,
  marginFault,
  PAPERS,
  PARTS,
  PLACEHOLDERS,
  runningFault,
  SIDES,
  type Fault,
  type PageSetup,
} from './model';

const SWITCHES = ['title_page', 'contents', 'variables', 'cross_references'] as const;
const ORIENTATIONS = ['portrait', 'landscape'] as const;
const LOGO_PLACES = ['none', 'left', 'right'] as const;

interface PageSetupFormProps {
  setup: PageSetup;
  disabled: boolean;
  onChange: (setup: PageSetup) => void;
}

/** Paper, margins, parts, logo, head and foot of the printed documentation, with a picture of its pages beside them. */
export function PageSetupForm({ setup, disabled, onChange }: PageSetupFormProps) {
  const t = useText();
  const project = useProject((state) => state.projectName);
  const user = useSession((state) => state.user?.username ?? '');
  const said = (fault: Fault | null) => fault && t(fault.text, fault.values);
  const change = (changes: Partial<PageSetup>) => onChange({ ...setup, ...changes });
  return (
    <div className={own.room}>
      <div className={own.setup}>
        <PagePreview setup={setup} project={project} user={user} />
        <div className={own.fields}>
          <Section title={t('pageSetup.sheet')}>
            <div className={styles.fields}>
              <ChoiceField
                label={t('print.paper')}
                disabled={disabled}
                value={setup.paper}
                choices={PAPERS.map((value) => ({ value, text: t(`print.paper.${value}`) }))}
                onValue={(paper) => change({ paper })}
              />
              <ChoiceField
                label={t('pageSetup.orientation')}
                disabled={disabled}
                value={setup.orientation}
                choices={ORIENTATIONS.map((value) => ({ value, text: t(`pageSetup.${value}`) }))}
                onValue={(orientation) => change({ orientation })}
              />
            </div>
            <div className={own.margins}>
              {SIDES.map((side) => (
                <Field key={side} label={t(`pageSetup.margin.${side}`)} error={said(marginFault(setup, side))}>
                  {(attributes) => (
                    <TextInput
                      {...attributes}
                      type="number"
                      min={5}
                      max={100}
                      step="any"
                      disabled={disabled}
                      value={Number.isNaN(setup.margins[side]) ? '' : setup.margins[side]}
                      onValue={(value) =>
                        change({
                          margins: { ...setup.margins, [side]: value === '' ? Number.NaN : Number(value) },
                        })
                      }
                    />
                  )}
                </Field>
              ))}
            </div>
          </Section>
          <Section title={t('pageSetup.parts')}>
            <div className={styles.fields}>
              {SWITCHES.map((part) => (
                <Checkbox
                  key={part}
                  checked={setup[part]}
                  disabled={disabled}
                  onChecked={(checked) => change({ [part]: checked })}
                >
                  {t(`pageSetup.${part}`)}
                </Checkbox>
              ))}
              {(['author', 'company'] as const).map((name) => (
                <Field
                  key={name}
                  row
                  label={t(`pageSetup.${name}`)}
                  hint={name === 'author' ? t('pageSetup.authorHint') : undefined}
                >
                  {(attributes) => (
                    <TextInput
                      {...attributes}
                      maxLength={200}
                      disabled={disabled}
                      value={setup[name]}
                      onValue={(value) => change({ [name]: value })}
                    />
                  )}
                </Field>
              ))}
            </div>
          </Section>
          <Section title={t('pageSetup.logo')}>
            <div className={styles.fields}>
              <LogoField logo={setup.logo} disabled={disabled} onLogo={(logo) => change({ logo })} />
              <Checkbox
                checked={setup.logo_on_title_page}
                disabled={disabled}
                onChecked={(checked) => change({ logo_on_title_page: checked })}
              >
                {t('pageSetup.logoOnTitlePage')}
              </Checkbox>
              <ChoiceField
                label={t('pageSetup.logoInHeader')}
                disabled={disabled}
                value={setup.logo_in_header}
                choices={LOGO_PLACES.map((value) => ({ value, text: t(`pageSetup.logoAt.${value}`) }))}
                onValue={(place) => change({ logo_in_header: place })}
              />
            </div>
          </Section>
          {EDGES.map((edge) => (
            <Section key={edge} title={t(`pageSetup.${edge}`)}>
              <div className={own.parts}>
                {PARTS.map((part) => (
                  <Field key={part} label={t(`pageSetup.part.${part}`)} error={said(runningFault(setup[edge][part]))}>
                    {(attributes) => (
                      <TextInput
                        {...attributes}
                        maxLength={200}
                        disabled={disabled}
                        value={setup[edge][part]}
                        onValue={(value) => change({ [edge]: { ...setup[edge], [part]: value } })}
                      />
                    )}
                  </Field>
                ))}
              </div>
            </Section>
          ))}
          <p className={styles.note}>
            {t('pageSetup.placeholders', { names: PLACEHOLDERS.map((name) => `{${name}}`).join(' ') })}
          </p>
        </div>
      </div>
    </div>
  );
}

/** A field beside its label that takes one of a few values. */
function ChoiceField<Value extends string>({ label, ...select }: { label: string } & SelectProps<Value>) {
  return (
    <Field row label={label}>
      {(attributes) => <Select {...attributes} {...select} />}
    </Field>
  );
}
