import { Bug } from 'lucide-react';
import { Component, type ReactNode } from 'react';
import { t } from '@/i18n';
import { Button } from './Button';
import { Empty } from './Empty';

interface Props {
  /** The fault is forgotten when this changes. */
  resetKey: string;
  /** Told of a fault; nothing is shown then where the children were. Otherwise the fault is shown there. */
  onFault?: (error: Error) => void;
  children: ReactNode;
}

/** A view that fails leaves the rest of the workbench usable. */
export class ErrorBoundary extends Component<Props, { error: Error | null; key: string }> {
  override state = { error: null, key: this.props.resetKey };

  static getDerivedStateFromError(error: Error) {
    return { error };
  }

  static getDerivedStateFromProps(props: Props, state: { error: Error | null; key: string }) {
    return props.resetKey === state.key ? null : { error: null, key: props.resetKey };
  }

  override componentDidCatch(error: Error) {
    this.props.onFault?.(error);
  }

  override render() {
    const error: Error | null = this.state.error;
    if (!error) return this.props.children;
    if (this.props.onFault) return null;
    return (
      <Empty icon={Bug} title={t('error.view')} text={(error as Error).message}>
        <Button onClick={() => this.setState({ error: null })}>{t('action.retry')}</Button>
      </Empty>
    );
  }
}
