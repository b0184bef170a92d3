import { ArrowLeft, BookOpenText } from 'lucide-react';
import { useQuery } from '@tanstack/react-query';
import { useMemo } from 'react';
import { useLanguage, useText } from '@/i18n';
import { IconButton } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { TextInput } from '@/ui/Field';
import { Panel, PanelBar, PanelRest } from '@/ui/Panel';
import styles from './Help.module.css';
import { searchEntries, type HelpEntry, type HelpTarget } from './model';
import { entriesQuery, helpBack, openEntry, pageQuery, useHelp } from './store';

const NO_ENTRIES: readonly HelpEntry[] = [];

/** Pages of the language, the messages and the views; the field searches all of them and the libraries. */
export default function HelpPanel() {
  const t = useText();
  const language = useLanguage();
  const { pages, search } = useHelp();
  const { data } = useQuery(entriesQuery(language));
  const hits = useMemo(() => searchEntries(data ?? NO_ENTRIES, search), [data, search]);
  const page = pages.at(-1);
  return (
    <Panel>
      <PanelBar>
        <IconButton
          small
          icon={ArrowLeft}
          label={t('help.back')}
          disabledReason={pages.length > 1 || (search !== '' && page) ? null : t('help.noPageBefore')}
          onClick={() => (search === '' ? helpBack() : useHelp.setState({ search: '' }))}
        />
        <TextInput
          data-autofocus
          className={styles.search}
          value={search}
          onValue={(text) => useHelp.setState({ search: text })}
          onKeyDown={(event) => event.key === 'Enter' && hits[0] && openEntry(hits[0])}
          placeholder={t('help.search')}
          aria-label={t('help.search')}
        />
      </PanelBar>
      <PanelRest>
        {search.trim() !== '' ? (
          <Hits hits={hits} />
        ) : page ? (
          <Page target={page} />
        ) : (
          <Empty icon={BookOpenText} title={t('help.start')} text={t('help.startText')} />
        )}
      </PanelRest>
    </Panel>
  );
}

function Hits({ hits }: { hits: readonly HelpEntry[] }) {
  const t = useText();
  if (hits.length === 0) return <Empty title={t('help.nothing')} text={t('help.nothingText')} />;
  return (
    <ul className={styles.hits} aria-label={t('help.found')}>
      {hits.map((entry) => (
        <li key={`${entry.kind}/${entry.library ?? ''}/${entry.name}`}>
          <button type="button" className={styles.hit} onClick={() => openEntry(entry)}>
            <span className={styles.title}>{entry.title}</span>
            <span className={styles.kind}>{t(`help.kind.${entry.kind}`)}</span>
            <span className={styles.summary}>{entry.summary}</span>
          </button>
        </li>
      ))}
    </ul>
  );
}

function Page({ target }: { target: HelpTarget }) {
  const t = useText();
  const language = useLanguage();
  const { data, error, refetch } = useQuery(pageQuery(target, language));
  if (error) return <Failed error={error} retry={() => void refetch()} />;
  if (!data) return <Loading />;
  return (
    <article className={styles.page} tabIndex={0} aria-label={data.title}>
      <h2 className={styles.head}>
        {data.title}
        <span className={styles.kind}>{t(`help.kind.${data.kind}`)}</span>
      </h2>
      {data.sections.map((section, at) => (
        <section key={at}>
          {section.heading && <h3 className={styles.heading}>{section.heading}</h3>}
          {section.text && <p className={styles.text}>{section.text}</p>}
          {section.code && <pre className={styles.code}>{section.code.trimEnd()}</pre>}
        </section>
      ))}
    </article>
  );
}
