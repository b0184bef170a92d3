/** The product's mark: a valve tappet over its cam. */
export function TappetMark({ size = 18 }: { size?: number }) {
  return (
    <svg width={size} height={size} viewBox="0 0 32 32" aria-hidden>
      <rect width="32" height="32" rx="7" fill="var(--accent)" />
      <path d="M8 11h16M16 11v8" stroke="var(--fg-on-accent)" strokeWidth="3.2" strokeLinecap="round" fill="none" />
      <circle cx="16" cy="22.5" r="3" fill="none" stroke="var(--fg-on-accent)" strokeWidth="2.6" />
    </svg>
  );
}
