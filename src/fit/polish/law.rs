//! psi' as the exponential of a short Fourier series, closed by its mean: positive, periodic and exact for any coefficients.

use std::f64::consts::TAU;

/// Cosines and sines of the first waves at even places of one period.
#[derive(Clone, Debug)]
pub(super) struct Basis {
    pub(super) places: usize,
    pub(super) waves: usize,
    /// For each wave its cosines, then its sines.
    table: Vec<f64>,
}

/// A law worked out at even driver angles of one period.
#[derive(Clone, Debug, Default)]
pub(super) struct Series {
    /// psi'.
    pub(super) speed: Vec<f64>,
    /// d ln psi' / d phi.
    pub(super) slope: Vec<f64>,
    /// psi from the first place on.
    pub(super) turn: Vec<f64>,
}

/// Derivatives of a number by what a [`Series`] holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Sensitivity {
    pub(super) speed: Vec<f64>,
    pub(super) slope: Vec<f64>,
    pub(super) turn: Vec<f64>,
}

impl Basis {
    pub(super) fn new(places: usize, waves: usize) -> Self {
        let mut table = Vec::with_capacity(2 * waves * places);
        for k in 1..=waves {
            let angle = |i: usize| TAU * (k * i % places) as f64 / places as f64;
            table.extend((0..places).map(|i| angle(i).cos()));
            table.extend((0..places).map(|i| angle(i).sin()));
        }
        Self { places, waves, table }
    }

    /// The law of mean `mean` over a period of `period` radians. Coefficients: all cosines, then all sines.
    pub(super) fn series(&self, coefficients: &[f64], mean: f64, period: f64) -> Series {
        let (n, waves) = (self.places, self.waves);
        let (mut log, mut slope) = (vec![0.0; n], vec![0.0; n]);
        for k in 0..waves {
            let (a, b) = (coefficients[k], coefficients[waves + k]);
            let rate = TAU / period * (k + 1) as f64;
            let (cos, sin) = self.table[2 * k * n..][..2 * n].split_at(n);
            for i in 0..n {
                log[i] += a * cos[i] + b * sin[i];
                slope[i] += rate * (b * cos[i] - a * sin[i]);
            }
        }
        let mut speed: Vec<f64> = log.iter().map(|u| u.exp()).collect();
        let scale = mean * n as f64 / speed.iter().sum::<f64>();
        speed.iter_mut().for_each(|p| *p *= scale);
        let half = 0.5 * period / n as f64;
        let mut turn = Vec::with_capacity(n);
        let mut sum = 0.0;
        for i in 0..n {
            if i > 0 {
                sum += half * (speed[i - 1] + speed[i]);
            }
            turn.push(sum);
        }
        Series { speed, slope, turn }
    }

    /// Adds to `gradient` what `by` means for the coefficients.
    pub(super) fn pull_back(
        &self,
        series: &Series,
        by: &Sensitivity,
        mean: f64,
        period: f64,
        gradient: &mut [f64],
    ) {
        let (n, waves) = (self.places, self.waves);
        let half = 0.5 * period / n as f64;
        let mut speed = by.speed.clone();
        let mut later = 0.0;
        for i in (1..n).rev() {
            later += by.turn[i];
            speed[i] += half * later;
            speed[i - 1] += half * later;
        }
        let average =
            speed.iter().zip(&series.speed).map(|(g, p)| g * p).sum::<f64>() / (n as f64 * mean);
        let log: Vec<f64> =
            speed.iter().zip(&series.speed).map(|(g, p)| p * (g - average)).collect();
        for k in 0..waves {
            let rate = TAU / period * (k + 1) as f64;
            let (cos, sin) = self.table[2 * k * n..][..2 * n].split_at(n);
            let (mut a, mut b) = (0.0, 0.0);
            for i in 0..n {
                a += log[i] * cos[i] - rate * by.slope[i] * sin[i];
                b += log[i] * sin[i] + rate * by.slope[i] * cos[i];
            }
            gradient[k] += a;
            gradient[waves + k] += b;
        }
    }

    /// Coefficients of the logarithm of a law given at even places of one period.
    pub(super) fn coefficients(&self, law: &[f64]) -> Vec<f64> {
        let n = law.len();
        let mut out = vec![0.0; 2 * self.waves];
        for k in 1..=self.waves.min((n - 1) / 2) {
            for (i, p) in law.iter().enumerate() {
                let (sin, cos) = (TAU * (k * i % n) as f64 / n as f64).sin_cos();
                out[k - 1] += 2.0 / n as f64 * p.ln() * cos;
                out[self.waves + k - 1] += 2.0 / n as f64 * p.ln() * sin;
            }
        }
        out
    }
}

/// Samples of the law at `n` places of one period, the first at `start` of it (0..1).
pub(super) fn sampled(coefficients: &[f64], start: f64, mean: f64, n: usize) -> Vec<f64> {
    let waves = coefficients.len() / 2;
    let mut law: Vec<f64> = (0..n)
        .map(|i| {
            let x = TAU * (start + i as f64 / n as f64);
            let log: f64 = (0..waves)
                .map(|k| {
                    let (sin, cos) = ((k + 1) as f64 * x).sin_cos();
                    coefficients[k] * cos + coefficients[waves + k] * sin
                })
                .sum();
            log.exp()
        })
        .collect();
    let scale = mean * n as f64 / law.iter().sum::<f64>();
    law.iter_mut().for_each(|p| *p *= scale);
    law
}

/// The same series with more waves (of height 0) or fewer.
pub(super) fn with_waves(coefficients: &[f64], waves: usize) -> Vec<f64> {
    let had = coefficients.len() / 2;
    let part = |half: &[f64]| {
        (0..waves).map(|k| half.get(k).copied().unwrap_or(0.0)).collect::<Vec<f64>>()
    };
    let mut out = part(&coefficients[..had]);
    out.extend(part(&coefficients[had..]));
    out
}
