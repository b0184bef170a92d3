/** The amplitude spectrum of equally spaced samples: windowed FFT. */

export const WINDOWS = ['rectangular', 'hann', 'hamming', 'blackman', 'flattop'] as const;
export type WindowName = (typeof WINDOWS)[number];

/** Coefficients of cosine-sum windows: w(n) = Σ (-1)^k a_k cos(2πkn/N). Harris 1978; flat top: D'Antona, Ferrero 2006. */
const COSINES: Readonly<Record<WindowName, readonly number[]>> = {
  rectangular: [1],
  hann: [0.5, 0.5],
  hamming: [0.54, 0.46],
  blackman: [0.42, 0.5, 0.08],
  flattop: [0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368],
};

/** The window over `count` samples, periodic, as spectra need it. */
export function windowOf(name: WindowName, count: number): Float64Array {
  const terms = COSINES[name];
  return Float64Array.from({ length: count }, (_, n) =>
    terms.reduce((sum, a, k) => sum + (k % 2 === 0 ? a : -a) * Math.cos((2 * Math.PI * k * n) / count), 0),
  );
}

export interface Spectrum {
  /** Hz. */
  frequency: Float64Array;
  /** Of a sine of that frequency, in units of the value. */
  amplitude: Float64Array;
}

/** Real and imaginary part of the discrete Fourier transform, in place; the length is a power of two. */
export function fft(re: Float64Array, im: Float64Array): void {
  const n = re.length;
  if ((n & (n - 1)) !== 0) throw new RangeError(`the length ${n} is no power of two`);
  for (let i = 1, j = 0; i < n; i += 1) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      [re[i], re[j]] = [re[j]!, re[i]!];
      [im[i], im[j]] = [im[j]!, im[i]!];
    }
  }
  for (let size = 2; size <= n; size *= 2) {
    const half = size / 2;
    // Each factor from its own angle: a product of many would lose digits.
    const cos = Float64Array.from({ length: half }, (_, k) => Math.cos((-2 * Math.PI * k) / size));
    const sin = Float64Array.from({ length: half }, (_, k) => Math.sin((-2 * Math.PI * k) / size));
    for (let start = 0; start < n; start += size) {
      for (let k = 0; k < half; k += 1) {
        const a = start + k;
        const b = a + half;
        const tr = re[b]! * cos[k]! - im[b]! * sin[k]!;
        const ti = re[b]! * sin[k]! + im[b]! * cos[k]!;
        re[b] = re[a]! - tr;
        im[b] = im[a]! - ti;
        re[a]! += tr;
        im[a]! += ti;
      }
    }
  }
}

/**
 * The discrete Fourier transform of any length (Bluestein 1970): a convolution of powers of two, so that the bins
 * are those of the samples and nothing is padded.
 */
export function dft(samples: ArrayLike<number>): { re: Float64Array; im: Float64Array } {
  const n = samples.length;
  if ((n & (n - 1)) === 0) {
    const re = Float64Array.from(samples);
    const im = new Float64Array(n);
    fft(re, im);
    return { re, im };
  }
  const m = 2 ** Math.ceil(Math.log2(2 * n - 1));
  const [ar, ai, br, bi] = [0, 1, 2, 3].map(() => new Float64Array(m)) as [
    Float64Array,
    Float64Array,
    Float64Array,
    Float64Array,
  ];
  const cos = new Float64Array(n);
  const sin = new Float64Array(n);
  for (let k = 0; k < n; k += 1) {
    // k² modulo 2n keeps the angle small, and so its digits.
    const angle = (Math.PI * ((k * k) % (2 * n))) / n;
    cos[k] = Math.cos(angle);
    sin[k] = Math.sin(angle);
    ar[k] = samples[k]! * cos[k]!;
    ai[k] = -samples[k]! * sin[k]!;
    br[k] = br[(m - k) % m] = cos[k]!;
    bi[k] = bi[(m - k) % m] = sin[k]!;
  }
  fft(ar, ai);
  fft(br, bi);
  for (let k = 0; k < m; k += 1) {
    const re = ar[k]! * br[k]! - ai[k]! * bi[k]!;
    // The inverse transform is the transform of the conjugate.
    ai[k] = -(ar[k]! * bi[k]! + ai[k]! * br[k]!);
    ar[k] = re;
  }
  fft(ar, ai);
  const re = new Float64Array(n);
  const im = new Float64Array(n);
  for (let k = 0; k < n; k += 1) {
    const [r, i] = [ar[k]! / m, -ai[k]! / m];
    re[k] = r * cos[k]! + i * sin[k]!;
    im[k] = i * cos[k]! - r * sin[k]!;
  }
  return { re, im };
}

/** Amplitudes from 0 Hz to half the sampling rate; a sine that fits the samples has its amplitude in its bin. */
export function spectrum(samples: ArrayLike<number>, rateHz: number, name: WindowName): Spectrum {
  const n = samples.length;
  if (n === 0) return { frequency: new Float64Array(0), amplitude: new Float64Array(0) };
  const window = windowOf(name, n);
  let gain = 0;
  const weighted = new Float64Array(n);
  for (let i = 0; i < n; i += 1) {
    gain += window[i]!;
    weighted[i] = samples[i]! * window[i]!;
  }
  const { re, im } = dft(weighted);
  const count = Math.floor(n / 2) + 1;
  const amplitude = Float64Array.from({ length: count }, (_, k) => {
    // All but 0 Hz and half the rate stand for two bins, of the positive and the negative frequency.
    const both = k === 0 || 2 * k === n ? 1 : 2;
    return (both * Math.hypot(re[k]!, im[k]!)) / gain;
  });
  return { frequency: Float64Array.from({ length: count }, (_, k) => (k * rateHz) / n), amplitude };
}
