import { useText } from '@/i18n';
import styles from './PageSetup.module.css';
import { filled, logoAddress, PARTS, sheetOf, type PageSetup, type Placeholder } from './model';

interface PagePreviewProps {
  setup: PageSetup;
  project: string;
  /** Who prints, where the page setup names no author. */
  user: string;
}

const ANCHORS = { left: 'start', centre: 'middle', right: 'end' } as const;
/** Heights of letters in mm, as they are printed. */
const SMALL_MM = 2.8;
const LINE_MM = 5;

/** The title page and one of the others, to scale in mm. Paper is white in both themes. */
export function PagePreview({ setup, project, user }: PagePreviewProps) {
  const t = useText();
  const [width, height] = sheetOf(setup);
  const { margins, logo } = setup;
  const number = setup.title_page ? 2 : 1;
  const now = new Date();
  const pad = (value: number) => String(value).padStart(2, '0');
  const values: Record<Placeholder, string> = {
    project,
    object: 'PLC_PRG',
    path: 'Application/PLC_PRG',
    author: setup.author || user,
    company: setup.company,
    revision: '12',
    date: `${String(now.getFullYear())}-${pad(now.getMonth() + 1)}-${pad(now.getDate())}`,
    time: `${pad(now.getHours())}:${pad(now.getMinutes())}`,
    page: String(number),
    pages: '7',
    page_of_pages: t('pageSetup.pageOfPages', { page: number, pages: 7 }),
  };
  const right = width - margins.right;
  const places = { left: margins.left, centre: (margins.left + right) / 2, right };
  const textHeight = Math.max(0, height - margins.top - margins.bottom);
  const lines = Array.from({ length: Math.floor(textHeight / LINE_MM) }, (_, at) => at);
  const header = Math.min(10, margins.top * 0.6);
  const running = (edge: 'header' | 'footer', y: number) =>
    PARTS.map((part) => {
      const beside = edge === 'header' && logo !== null && setup.logo_in_header === part ? header * 2.2 : 0;
      const x = places[part] + (part === 'right' ? -beside : beside);
      return (
        <text key={`${edge}-${part}`} x={x} y={y} textAnchor={ANCHORS[part]} className={styles.running}>
          {filled(setup[edge][part], values)}
        </text>
      );
    });
  const picture = (x: number, y: number, w: number, h: number, align: string) =>
    logo !== null && (
      <image href={logoAddress(logo)} x={x} y={y} width={w} height={h} preserveAspectRatio={`${align}YMid meet`} />
    );
  const label = t('pageSetup.previewOf', { width, height });
  return (
    <div className={styles.preview} role="img" aria-label={label}>
      {setup.title_page && (
        <svg viewBox={`0 0 ${String(width)} ${String(height)}`} data-page="title">
          {setup.logo_on_title_page && picture(margins.left, height * 0.12, 80, 40, 'xMin')}
          <text x={margins.left} y={height * 0.38} className={styles.title}>
            {project}
          </text>
          {[setup.company, values.author].filter(Boolean).map((text, at) => (
            <text key={at} x={margins.left} y={height * 0.38 + 14 + at * 7} className={styles.fact}>
              {text}
            </text>
          ))}
          {running('footer', height - margins.bottom * 0.7 + SMALL_MM)}
        </svg>
      )}
      <svg viewBox={`0 0 ${String(width)} ${String(height)}`} data-page="inner">
        <rect
          x={margins.left}
          y={margins.top}
          width={Math.max(0, right - margins.left)}
          height={textHeight}
          className={styles.area}
        />
        {lines.map((at) => (
          <line
            key={at}
            x1={margins.left + (at % 7 === 0 ? 0 : 8)}
            x2={margins.left + (right - margins.left) * (at % 7 === 0 ? 0.4 : 0.55 + ((at * 37) % 40) / 100)}
            y1={margins.top + (at + 0.6) * LINE_MM}
            y2={margins.top + (at + 0.6) * LINE_MM}
            className={at % 7 === 0 ? styles.heading : styles.line}
          />
        ))}
        {setup.logo_in_header === 'left' &&
          picture(margins.left, margins.top * 0.7 - header, header * 4, header, 'xMin')}
        {setup.logo_in_header === 'right' &&
          picture(right - header * 4, margins.top * 0.7 - header, header * 4, header, 'xMax')}
        {running('header', margins.top * 0.7)}
        {running('footer', height - margins.bottom * 0.7 + SMALL_MM)}
      </svg>
    </div>
  );
}
