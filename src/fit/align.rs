//! Eq. 12 at every shift at once.
//!
//! With a the short gear's law and b a window of the long one's, scaled by c to
//! close, Delta = |a|^2 - 2 c corr(a, b) + c^2 |b|^2: one inverse Fourier transform
//! gives the correlation for all shifts.

use std::f64::consts::TAU;
use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

/// Transforms for laws of one length.
pub(super) struct Aligner {
    short_len: usize,
    long_len: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

/// The short gear's law, transformed.
#[derive(Debug)]
pub(super) struct ShortSpectrum {
    pub(super) law: Vec<f64>,
    spectrum: Vec<Complex<f64>>,
    energy: f64,
}

/// The long gear's law, transformed, with the scale and the energy of each of its windows.
#[derive(Debug)]
pub(super) struct LongSpectrum {
    pub(super) law: Vec<f64>,
    spectrum: Vec<Complex<f64>>,
    scale: Vec<f64>,
    /// What a shift costs before the correlation is taken off: energy of the scaled window, and its folding when asked for.
    offset: Vec<f64>,
}

impl LongSpectrum {
    /// The window of `n` samples from `shift`, scaled to the mean `mean`.
    pub(super) fn window(&self, shift: usize, n: usize, mean: f64) -> impl Iterator<Item = f64> {
        let ring = self.law.iter().chain(&self.law).skip(shift).take(n);
        let scale = n as f64 * mean / ring.clone().sum::<f64>();
        ring.map(move |v| v * scale)
    }
}

impl ShortSpectrum {
    /// The same in single precision.
    pub(super) fn narrow(&self) -> NarrowShort {
        NarrowShort { spectrum: narrowed(&self.spectrum), energy: self.energy as f32 }
    }
}

impl LongSpectrum {
    /// The same in single precision.
    pub(super) fn narrow(&self) -> NarrowLong {
        let narrow = |values: &[f64]| values.iter().map(|v| *v as f32).collect();
        NarrowLong {
            spectrum: narrowed(&self.spectrum),
            scale: narrow(&self.scale),
            offset: narrow(&self.offset),
        }
    }
}

fn narrowed(spectrum: &[Complex<f64>]) -> Vec<Complex<f32>> {
    spectrum.iter().map(|z| Complex::new(z.re as f32, z.im as f32)).collect()
}

/// A [`ShortSpectrum`] in single precision.
#[derive(Debug)]
pub(super) struct NarrowShort {
    spectrum: Vec<Complex<f32>>,
    energy: f32,
}

/// A [`LongSpectrum`] in single precision.
#[derive(Debug)]
pub(super) struct NarrowLong {
    spectrum: Vec<Complex<f32>>,
    scale: Vec<f32>,
    offset: Vec<f32>,
}

/// [`Aligner::best`] in single precision, for very many pairs that are only to be ranked.
pub(super) struct Ranker {
    over_turn: f32,
    inverse: Arc<dyn ComplexToReal<f32>>,
}

/// Buffers of one thread of a [`Ranker`].
pub(super) struct NarrowScratch {
    product: Vec<Complex<f32>>,
    work: Vec<Complex<f32>>,
    delta: Vec<f32>,
}

impl Ranker {
    /// For `short_len` samples a period and a long gear of `windows` periods.
    pub(super) fn new(short_len: usize, windows: usize) -> Self {
        let inverse = RealFftPlanner::new().plan_fft_inverse(short_len * windows);
        Self { over_turn: TAU as f32 / short_len as f32, inverse }
    }

    pub(super) fn scratch(&self) -> NarrowScratch {
        NarrowScratch {
            product: self.inverse.make_input_vec(),
            work: self.inverse.make_scratch_vec(),
            delta: self.inverse.make_output_vec(),
        }
    }

    /// Least Delta and its shift; at the shift given, if one is.
    pub(super) fn best(
        &self,
        short: &NarrowShort,
        long: &NarrowLong,
        fixed: Option<usize>,
        scratch: &mut NarrowScratch,
    ) -> (f32, u32) {
        let NarrowScratch { product, work, delta } = scratch;
        for ((p, a), b) in product.iter_mut().zip(&short.spectrum).zip(&long.spectrum) {
            *p = a * b;
        }
        // Only a residue of rounding in the two purely real terms could be refused here; it is harmless.
        let _ = self.inverse.process_with_scratch(product, delta, work);
        for ((d, c), e) in delta.iter_mut().zip(&long.scale).zip(&long.offset) {
            *d = e - c * *d;
        }
        let shift = match fixed {
            Some(shift) => shift % delta.len(),
            None => {
                let least = least(delta);
                delta.iter().position(|d| *d <= least).unwrap_or(0)
            }
        };
        (((delta[shift] + short.energy) * self.over_turn).max(0.0), shift as u32)
    }
}

/// The least of some values, several side by side.
fn least(values: &[f32]) -> f32 {
    let smaller = |a: f32, b: f32| if b < a { b } else { a };
    let (blocks, rest) = values.as_chunks::<8>();
    let mut least = [f32::INFINITY; 8];
    for block in blocks {
        for (m, v) in least.iter_mut().zip(block) {
            *m = smaller(*m, *v);
        }
    }
    least.into_iter().chain(rest.iter().copied()).fold(f32::INFINITY, smaller)
}

/// Buffers of one thread.
pub(super) struct Scratch {
    product: Vec<Complex<f64>>,
    work: Vec<Complex<f64>>,
    delta: Vec<f64>,
}

/// The best shift of one pair of laws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Alignment {
    /// Delta of Eq. 12, integrated over the driver's whole turn, with the cost of folding if the spectrum carries it.
    pub(super) delta: f64,
    /// Samples by which the window of the long gear's law is shifted.
    pub(super) shift: usize,
}

impl Aligner {
    /// For `short_len` samples a period and a long gear of `windows` periods.
    pub(super) fn new(short_len: usize, windows: usize) -> Self {
        let long_len = short_len * windows;
        let mut planner = RealFftPlanner::new();
        Self {
            short_len,
            long_len,
            forward: planner.plan_fft_forward(long_len),
            inverse: planner.plan_fft_inverse(long_len),
        }
    }

    pub(super) fn scratch(&self) -> Scratch {
        Scratch {
            product: self.inverse.make_input_vec(),
            work: self.inverse.make_scratch_vec(),
            delta: self.inverse.make_output_vec(),
        }
    }

    /// Transforms the short gear's law of one period.
    pub(super) fn short(&self, law: Vec<f64>) -> ShortSpectrum {
        let mut padded = law.clone();
        padded.resize(self.long_len, 0.0);
        let energy = law.iter().map(|v| v * v).sum();
        let spectrum = self.transform(padded).iter().map(Complex::conj).collect();
        ShortSpectrum { law, spectrum, energy }
    }

    /// Transforms the long gear's law of one whole turn; its windows will be scaled to the mean `mean`.
    ///
    /// With `folding` each window is also charged what it costs to repeat it over the whole turn.
    pub(super) fn long(&self, law: Vec<f64>, mean: f64, folding: bool) -> LongSpectrum {
        let (n, m) = (self.short_len, self.long_len);
        let windows = m / n;
        let stacked: Vec<f64> = (0..n).map(|i| law.iter().skip(i).step_by(n).sum()).collect();
        let whole: f64 = law.iter().map(|v| v * v).sum();
        let mut sum: f64 = law[..n].iter().sum();
        let mut squares: f64 = law[..n].iter().map(|v| v * v).sum();
        let mut repeated: f64 = law[..n].iter().zip(&stacked).map(|(v, s)| v * s).sum();
        let (mut scale, mut offset) = (Vec::with_capacity(m), Vec::with_capacity(m));
        for s in 0..m {
            let c = n as f64 * mean / sum;
            // The inverse transform is not normalised: its factor is folded in here.
            scale.push(2.0 * c / m as f64);
            let energy = c * c * squares;
            let apart = if folding && windows > 1 {
                ((whole - 2.0 * c * repeated) / windows as f64 + energy).max(0.0)
            } else {
                0.0
            };
            offset.push(energy + apart);
            let (gone, come) = (law[s], law[(s + n) % m]);
            sum += come - gone;
            squares += come * come - gone * gone;
            repeated += (come - gone) * stacked[s % n];
        }
        let spectrum = self.transform(law.clone());
        LongSpectrum { law, spectrum, scale, offset }
    }

    fn transform(&self, mut values: Vec<f64>) -> Vec<Complex<f64>> {
        let mut spectrum = self.forward.make_output_vec();
        // The lengths fit by construction.
        let _ = self.forward.process(&mut values, &mut spectrum);
        spectrum
    }

    /// Delta at one shift, in samples of the long gear's turn.
    pub(super) fn at(&self, short: &ShortSpectrum, long: &LongSpectrum, shift: usize) -> Alignment {
        let ring = long.law.iter().chain(&long.law).skip(shift);
        let shared: f64 = short.law.iter().zip(ring).map(|(a, b)| a * b).sum();
        // The scale is that of an inverse transform that is not normalised.
        let delta = long.offset[shift] - long.scale[shift] * self.long_len as f64 * shared;
        let over_turn = TAU / self.short_len as f64;
        Alignment { delta: ((delta + short.energy) * over_turn).max(0.0), shift }
    }

    /// The shift of least Delta among every `stride`-th.
    pub(super) fn best(
        &self,
        short: &ShortSpectrum,
        long: &LongSpectrum,
        stride: usize,
        scratch: &mut Scratch,
    ) -> Alignment {
        let Scratch { product, work, delta } = scratch;
        for ((p, a), b) in product.iter_mut().zip(&short.spectrum).zip(&long.spectrum) {
            *p = a * b;
        }
        // Only a residue of rounding in the two purely real terms could be refused here; it is harmless.
        let _ = self.inverse.process_with_scratch(product, delta, work);
        for ((d, c), e) in delta.iter_mut().zip(&long.scale).zip(&long.offset) {
            *d = e - c * *d;
        }
        let mut best = Alignment { delta: f64::INFINITY, shift: 0 };
        for (shift, d) in delta.iter().enumerate().step_by(stride) {
            if *d < best.delta {
                best = Alignment { delta: *d, shift };
            }
        }
        let over_turn = TAU / self.short_len as f64;
        Alignment { delta: ((best.delta + short.energy) * over_turn).max(0.0), ..best }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::objective::folding_cost;

    #[test]
    fn transforms_find_what_trying_every_shift_finds() {
        let wave = |i: usize, m: usize| {
            let x = TAU * i as f64 / m as f64;
            1.0 + 0.5 * (x + 1.0).sin() + 0.2 * (5.0 * x).cos()
        };
        for windows in [1, 3] {
            let n = 60;
            let m = n * windows;
            let a: Vec<f64> =
                (0..n).map(|i| 1.0 + 0.4 * (TAU * i as f64 / n as f64).cos()).collect();
            let b: Vec<f64> = (0..m).map(|i| wave(i, m)).collect();
            let slow = (0..m)
                .map(|s| {
                    let window: Vec<f64> = (0..n).map(|i| b[(i + s) % m]).collect();
                    let c = n as f64 / window.iter().sum::<f64>();
                    window.iter().zip(&a).map(|(b, a)| (c * b - a).powi(2)).sum::<f64>() * TAU
                        / n as f64
                })
                .enumerate()
                .min_by(|x, y| x.1.total_cmp(&y.1))
                .unwrap();
            let aligner = Aligner::new(n, windows);
            let (short, long) = (aligner.short(a), aligner.long(b.clone(), 1.0, false));
            let fast = aligner.best(&short, &long, 1, &mut aligner.scratch());
            assert_eq!(fast.shift, slow.0);
            assert!((fast.delta - slow.1).abs() < 1e-12);
            let ranker = Ranker::new(n, windows);
            let (narrow, scratch) = (short.narrow(), &mut ranker.scratch());
            let (delta, shift) = ranker.best(&narrow, &long.narrow(), None, scratch);
            assert!(shift as usize == slow.0 && (f64::from(delta) - slow.1).abs() < 1e-4);
            let (delta, _) = ranker.best(&narrow, &long.narrow(), Some(slow.0), scratch);
            assert!((f64::from(delta) - slow.1).abs() < 1e-4);
            let known = aligner.at(&short, &long, slow.0);
            assert!(known.shift == slow.0 && (known.delta - slow.1).abs() < 1e-12);
            let charged = aligner.long(b.clone(), 1.0, true);
            for s in [0, 7, n / 2] {
                let window: Vec<f64> = charged.window(s, n, 1.0).collect();
                let apart =
                    folding_cost(&(0..m).map(|i| b[(s + i) % m]).collect::<Vec<_>>(), &window);
                let difference = (charged.offset[s] - long.offset[s]) * TAU / n as f64;
                assert!((difference - apart).abs() < 1e-12 && (windows == 1 || apart > 0.1));
            }
        }
    }
}
