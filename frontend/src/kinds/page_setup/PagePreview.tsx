import type { CSSProperties } from 'react';
import { useText } from '@/i18n';
import { useLogoSize } from './logoSize';
import styles from './PageSetup.module.css';
import {
  cellsOf,
  filled,
  fitted,
  headerLogoBox,
  logoAddress,
  sheetOf,
  TITLE_LOGO_BOX,
  type Cell,
  type PageSetup,
  type Placeholder,
} from './model';

interface PagePreviewProps {
  setup: PageSetup;
  project: string;
  /** Who prints, where the page setup names no author. */
  user: string;
}

const LINE_MM = 5;
/** Of the margin, between the text and what stands in the margin, as it is printed. */
const GAP = 0.3;

/** The title page and one of the others, to scale: a unit of the drawings is a mm. Paper is white in both themes. */
export function PagePreview({ setup, project, user }: PagePreviewProps) {
  const t = useText();
  const size = useLogoSize(setup.logo);
  const [width, height] = sheetOf(setup);
  const { margins } = setup;
  const number = setup.title_page ? 2 : 1;
  const [date, time] = printedAt(new Date());
  const values: Record<Placeholder, string> = {
    project,
    object: 'PLC_PRG',
    path: 'Application/PLC_PRG',
    author: setup.author || user,
    company: setup.company,
    revision: '12',
    date,
    time,
    page: String(number),
    pages: '7',
    page_of_pages: t('pageSetup.pageOfPages', { page: number, pages: 7 }),
  };
  const onTitlePage = { ...values, object: '', path: '', page: '1' };
  onTitlePage.page_of_pages = t('pageSetup.pageOfPages', { page: 1, pages: 7 });
  const textWidth = Math.max(0, width - margins.left - margins.right);
  const textHeight = Math.max(0, height - margins.top - margins.bottom);
  const picture = (box: readonly [number, number]) => {
    if (setup.logo === null || size === null) return null;
    const [w, h] = fitted(size, box);
    return <img src={logoAddress(setup.logo)} alt="" style={{ width: w, height: h }} />;
  };
  const cell = ({ part, text, logo }: Cell, known: Record<Placeholder, string>) => (
    <div key={part} data-part={part}>
      {logo && picture(headerLogoBox(margins.top))}
      <span>{filled(text, known)}</span>
    </div>
  );
  const foot = (known: Record<Placeholder, string>) => {
    const room = margins.bottom * (1 - GAP);
    return (
      <foreignObject x={margins.left} y={height - room} width={textWidth} height={room}>
        <div className={styles.running} data-edge="footer">
          {cellsOf(setup.footer, 'none').map((one) => cell(one, known))}
        </div>
      </foreignObject>
    );
  };
  const head = cellsOf(setup.header, setup.logo === null ? 'none' : setup.logo_in_header);
  return (
    <div
      className={styles.preview}
      style={{ '--ratio': width / height } as CSSProperties}
      role="img"
      aria-label={t('pageSetup.previewOf', { width, height })}
    >
      {setup.title_page && (
        <svg viewBox={`0 0 ${String(width)} ${String(height)}`} data-page="title">
          <foreignObject
            x={margins.left}
            y={margins.top + textHeight / 4}
            width={textWidth}
            height={(textHeight * 3) / 4}
          >
            <div className={styles.titlePage}>
              {setup.logo_on_title_page && picture(TITLE_LOGO_BOX)}
              <b>{project}</b>
              {[values.company, values.author, `${date} ${time}`].filter(Boolean).map((text) => (
                <span key={text}>{text}</span>
              ))}
            </div>
          </foreignObject>
          {foot(onTitlePage)}
        </svg>
      )}
      <svg viewBox={`0 0 ${String(width)} ${String(height)}`} data-page="inner">
        <rect x={margins.left} y={margins.top} width={textWidth} height={textHeight} className={styles.area} />
        <TextLines left={margins.left} top={margins.top} width={textWidth} height={textHeight} />
        {head.length > 0 && (
          <foreignObject x={margins.left} y={0} width={textWidth} height={margins.top * (1 - GAP)}>
            <div className={styles.running} data-edge="header">
              {head.map((one) => cell(one, values))}
            </div>
          </foreignObject>
        )}
        {foot(values)}
      </svg>
    </div>
  );
}

/** Date and time as they are printed. */
function printedAt(now: Date): [string, string] {
  const pad = (value: number) => String(value).padStart(2, '0');
  return [
    `${String(now.getFullYear())}-${pad(now.getMonth() + 1)}-${pad(now.getDate())}`,
    `${pad(now.getHours())}:${pad(now.getMinutes())}`,
  ];
}

/** Strokes in the place of a text. */
function TextLines({ left, top, width, height }: { left: number; top: number; width: number; height: number }) {
  return Array.from({ length: Math.floor(height / LINE_MM) }, (_, at) => {
    const heading = at % 7 === 0;
    const y = top + (at + 0.6) * LINE_MM;
    return (
      <line
        key={at}
        x1={left + (heading ? 0 : 8)}
        x2={left + width * (heading ? 0.4 : 0.55 + ((at * 37) % 40) / 100)}
        y1={y}
        y2={y}
        className={heading ? styles.heading : styles.line}
      />
    );
  });
}
