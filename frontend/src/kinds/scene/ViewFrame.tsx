import { useEffect, useRef } from 'react';
import { passKeysOn } from './frameKeys';
import { FrameLimit } from './frameLimit';
import { whenDrawn, type ViserWindow } from './viserWindow';
import styles from './Scene.module.css';

interface ViewFrameProps {
  src: string;
  title: string;
  /** A view that is not shown is not drawn either, but stays as it is. */
  shown: boolean;
  testId: string;
  /** The view holds the scene now. */
  onDrawn?: (view: ViserWindow) => void;
}

/** The page of one 3D view, bounded in what it takes of the workbench around it. */
export function ViewFrame({ src, title, shown, testId, onDrawn }: ViewFrameProps) {
  const limit = useRef<FrameLimit | null>(null);
  const stopWaiting = useRef<() => void>(() => undefined);
  useEffect(() => {
    limit.current?.pause(!shown);
  }, [shown]);
  useEffect(() => {
    const yieldToInput = () => limit.current?.yieldToInput();
    const inputs = ['keydown', 'pointerdown', 'wheel'];
    inputs.forEach((input) => document.addEventListener(input, yieldToInput, { capture: true, passive: true }));
    return () => {
      inputs.forEach((input) => document.removeEventListener(input, yieldToInput, { capture: true }));
      stopWaiting.current();
      limit.current?.dispose();
    };
  }, []);
  const loaded = (frame: HTMLIFrameElement) => {
    const view = frame.contentWindow;
    limit.current?.dispose();
    stopWaiting.current();
    limit.current = view === null ? null : new FrameLimit(view);
    limit.current?.pause(!shown);
    if (view === null) return;
    passKeysOn(view, frame);
    if (onDrawn) stopWaiting.current = whenDrawn(view, () => onDrawn(view));
  };
  return (
    <iframe
      className={styles.view}
      data-shown={shown}
      src={src}
      title={title}
      onLoad={(event) => loaded(event.currentTarget)}
      data-testid={testId}
    />
  );
}
