//! Motions as tables of samples.

use std::f64::consts::TAU;

use super::{LawError, LawOptions, Quantity, Segment, closed, from_segment};
use crate::geometry::solve_cyclic;
use crate::pitch::Transmission;
use crate::policy;
use crate::wording::quoted;

/// Samples of a motion over one period, or over a turn of the driver.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Driver angles, radians, rising.
    angles: Vec<f64>,
    values: Vec<f64>,
    degrees: bool,
}

impl Table {
    /// Reads two columns, the angle and the value, from text: separated by commas, semicolons, tabs or blanks; in lines with
    /// semicolons or tabs a comma is a decimal point. Empty lines and whatever follows `#` are skipped, a first line without
    /// numbers is a header. Angles are radians, or degrees when the header says `deg` or they reach beyond 20. Angles of
    /// the follower (psi) are in the same unit.
    ///
    /// # Errors
    /// [`LawError`] with the line.
    pub fn parse(text: &[u8], quantity: Quantity) -> Result<Self, LawError> {
        let most = policy::LAW_TABLE_BYTES;
        if text.len() > most {
            return Err(LawError::TableTooLong { bytes: text.len(), most });
        }
        let text = std::str::from_utf8(text).map_err(|_| LawError::TableNotText)?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut rows: Vec<(f64, f64)> = Vec::new();
        let mut degrees = false;
        let mut header_allowed = true;
        for (index, line) in text.lines().enumerate() {
            let data = line.split('#').next().unwrap_or_default().trim();
            if data.is_empty() {
                continue;
            }
            let fields = crate::input::split_fields(data);
            let numbers: Vec<Option<f64>> = fields.iter().map(|f| f.parse().ok()).collect();
            let number =
                |i: usize| numbers.get(i).copied().flatten().filter(|v: &f64| v.is_finite());
            if header_allowed && numbers.iter().all(Option::is_none) {
                degrees = data.to_ascii_lowercase().contains("deg") || data.contains('°');
            } else if let (Some(angle), Some(value)) = (number(0), number(1)) {
                if rows.last().is_some_and(|last| angle <= last.0) {
                    return Err(LawError::TableNotRising { line: index + 1 });
                }
                rows.push((angle, value));
            } else {
                let text = quoted(&data.chars().take(40).collect::<String>());
                return Err(LawError::TableLine { line: index + 1, text });
            }
            header_allowed = false;
        }
        let (least, most) = policy::LAW_ROWS;
        if !(least..=most).contains(&rows.len()) {
            return Err(LawError::TableRows { rows: rows.len(), least, most });
        }
        let span = rows[rows.len() - 1].0 - rows[0].0;
        degrees |= span > MOST_RADIANS;
        let unit = if degrees { 1_f64.to_radians() } else { 1.0 };
        let of_value = if quantity == Quantity::Angle { unit } else { 1.0 };
        Ok(Self {
            angles: rows.iter().map(|r| r.0 * unit).collect(),
            values: rows.iter().map(|r| r.1 * of_value).collect(),
            degrees,
        })
    }

    /// The motion: a periodic cubic spline through the samples.
    ///
    /// The table covers one period or a whole turn of the driver, with or without a last row that repeats the first.
    ///
    /// # Errors
    /// [`LawError`], as [`super::from_function`].
    pub fn transmission(&self, options: &LawOptions) -> Result<Transmission, LawError> {
        let fold = f64::from(options.ratio.driver_fold());
        let rise = match options.quantity {
            Quantity::Angle => TAU / f64::from(options.ratio.follower_fold()),
            Quantity::Speed | Quantity::DriverRadius => 0.0,
        };
        let n = self.angles.len();
        let span = self.angles[n - 1] - self.angles[0];
        let typical = span / (n - 1) as f64;
        // A row is missing at the end, or the last repeats the first.
        let covers = |period: f64| {
            let open = period - span;
            (open > -0.01 * typical && open < 3.0 * typical).then_some(period)
        };
        let Some(turn) = covers(TAU / fold).or_else(|| covers(TAU)) else {
            let (unit, per) =
                if self.degrees { ("degrees", 1_f64.to_radians()) } else { ("radians", 1.0) };
            return Err(LawError::TableSpan {
                given: span / per,
                wanted: TAU / fold / per,
                unit,
                remedy: "give the angle of the driver in the first column, over one whole period",
            });
        };
        let periods = (turn * fold / TAU).round();
        // Steps may be uneven: what is missing at the end is judged by the turn and by the steps beside it.
        let beside = (self.angles[1] - self.angles[0]).min(self.angles[n - 1] - self.angles[n - 2]);
        let repeats_first = turn - span < (policy::TABLE_TURN_WITHIN * turn).min(0.5 * beside);
        let count = if repeats_first { n - 1 } else { n };
        // psi less its even part is periodic.
        let slope = rise * periods / turn;
        let even = |i: usize| self.values[i] - slope * (self.angles[i] - self.angles[0]);
        if repeats_first {
            let (first, last) = (even(0), even(n - 1));
            let largest = self.values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
            let off = last - first;
            if off.abs() > policy::LAW_CLOSES_WITHIN * largest.max(f64::MIN_POSITIVE) {
                if options.quantity == Quantity::Angle {
                    if !options.normalise {
                        let mean = slope + off / turn;
                        return Err(LawError::NotClosed {
                            quantity: options.quantity,
                            mean,
                            wanted: slope,
                            turns: (options.ratio.follower_fold(), options.ratio.driver_fold()),
                        });
                    }
                } else {
                    return Err(LawError::NotPeriodic {
                        quantity: options.quantity,
                        folds: options.ratio.driver_fold(),
                        turns: (options.ratio.follower_fold(), options.ratio.driver_fold()),
                        at: self.angles[0],
                        values: (first, last),
                    });
                }
            }
        }
        let slope = if repeats_first && options.quantity == Quantity::Angle {
            (self.values[n - 1] - self.values[0]) / turn
        } else {
            slope
        };
        let values: Vec<f64> = (0..count)
            .map(|i| self.values[i] - slope * (self.angles[i] - self.angles[0]))
            .collect();
        let spline = Periodic::through(&self.angles[..count], &values, turn);
        let total = policy::LAW_SAMPLES;
        let step = TAU / fold / total as f64;
        // Over the whole turn, so that a table that does not repeat in it is seen.
        let value = |phi: f64| match options.quantity {
            Quantity::Angle => slope + spline.at(phi).1,
            Quantity::Speed | Quantity::DriverRadius => spline.at(phi).0,
        };
        if periods > 1.0 {
            return super::from_function(
                value,
                &LawOptions {
                    quantity: match options.quantity {
                        Quantity::Angle => Quantity::Speed,
                        other => other,
                    },
                    ..*options
                },
            );
        }
        closed((0..total).map(|i| value(i as f64 * step)).collect(), options)
    }
}

impl Table {
    /// The driver angles it covers.
    #[must_use]
    pub fn segment(&self) -> Segment {
        Segment { from: self.angles[0], to: self.angles[self.angles.len() - 1] }
    }

    /// The motion that follows the samples over a segment that they cover and closes smoothly over the rest of its period.
    ///
    /// # Errors
    /// [`LawError`], as [`from_segment`].
    pub fn segment_transmission(
        &self,
        segment: Segment,
        options: &LawOptions,
    ) -> Result<Transmission, LawError> {
        let whole = self.segment();
        let slack = policy::LAW_CLOSES_WITHIN * whole.length();
        if segment.from < whole.from - slack || segment.to > whole.to + slack {
            return Err(LawError::SegmentOutside {
                wanted: (segment.from, segment.to),
                given: (whole.from, whole.to),
            });
        }
        from_segment(|phi| self.between(phi), segment, options)
    }

    /// The value at an angle: cubics whose slopes at the samples are those of parabolas through three of them.
    fn between(&self, phi: f64) -> f64 {
        let (x, y) = (&self.angles, &self.values);
        let n = x.len();
        let secant = |i: usize| (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
        let slope = |i: usize| {
            let k = i.clamp(1, n - 2);
            let (a, b) = (x[k] - x[k - 1], x[k + 1] - x[k]);
            let (before, after) = (secant(k - 1), secant(k));
            let middle = (b * before + a * after) / (a + b);
            let bend = (after - before) / (a + b);
            middle + 2.0 * bend * (x[i] - x[k])
        };
        let i = x.partition_point(|&v| v <= phi).clamp(1, n - 1) - 1;
        let h = x[i + 1] - x[i];
        let t = (phi - x[i]) / h;
        let (d0, d1) = (h * slope(i), h * slope(i + 1));
        let (c2, c3) = (3.0 * (y[i + 1] - y[i]) - 2.0 * d0 - d1, 2.0 * (y[i] - y[i + 1]) + d0 + d1);
        y[i] + t * (d0 + t * (c2 + t * c3))
    }
}

/// Greatest span of angles that is taken for radians: two turns and more of the driver make no sense.
const MOST_RADIANS: f64 = 20.0;

/// A periodic cubic spline over uneven knots.
struct Periodic {
    knots: Vec<f64>,
    values: Vec<f64>,
    slopes: Vec<f64>,
    period: f64,
}

impl Periodic {
    /// At least three knots, rising, within one period.
    fn through(knots: &[f64], values: &[f64], period: f64) -> Self {
        let n = knots.len();
        let width = |i: usize| {
            if i + 1 < n { knots[i + 1] - knots[i] } else { knots[0] + period - knots[i] }
        };
        let secant = |i: usize| (values[(i + 1) % n] - values[i]) / width(i);
        let (mut lower, mut diagonal, mut upper, mut rhs) = (vec![], vec![], vec![], vec![]);
        for i in 0..n {
            let before = (i + n - 1) % n;
            let (a, b) = (width(before), width(i));
            lower.push(b);
            diagonal.push(2.0 * (a + b));
            upper.push(a);
            rhs.push(3.0 * (b * secant(before) + a * secant(i)));
        }
        let slopes = solve_cyclic(&lower, &diagonal, &upper, &rhs);
        Self { knots: knots.to_vec(), values: values.to_vec(), slopes, period }
    }

    /// Value and derivative.
    fn at(&self, x: f64) -> (f64, f64) {
        let n = self.knots.len();
        let x = self.knots[0] + (x - self.knots[0]).rem_euclid(self.period);
        let i = self.knots.partition_point(|k| *k <= x).saturating_sub(1);
        let j = (i + 1) % n;
        let end = if i + 1 < n { self.knots[i + 1] } else { self.knots[0] + self.period };
        let h = end - self.knots[i];
        let t = (x - self.knots[i]) / h;
        let (y0, y1, d0, d1) =
            (self.values[i], self.values[j], h * self.slopes[i], h * self.slopes[j]);
        let (c2, c3) = (3.0 * (y1 - y0) - 2.0 * d0 - d1, 2.0 * (y0 - y1) + d0 + d1);
        (y0 + t * (d0 + t * (c2 + t * c3)), (d0 + t * (2.0 * c2 + 3.0 * c3 * t)) / h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Ratio;

    fn speed(phi: f64) -> f64 {
        1.0 + 0.3 * (2.0 * phi).cos() + 0.1 * phi.sin()
    }

    fn written(n: usize, last: bool, row: impl Fn(f64) -> String) -> String {
        let count = n + usize::from(last);
        (0..count).map(|i| row(TAU * i as f64 / n as f64) + "\n").collect()
    }

    fn read(text: &str, quantity: Quantity) -> Result<Transmission, LawError> {
        let options = LawOptions { quantity, ..LawOptions::default() };
        Table::parse(text.as_bytes(), quantity)?.transmission(&options)
    }

    #[test]
    fn every_way_to_write_a_table_gives_the_motion() {
        let angle = |phi: f64| phi + 0.15 * (2.0 * phi).sin() - 0.1 * phi.cos();
        let comma = |v: f64| format!("{v}").replace('.', ",");
        let texts = [
            (Quantity::Speed, written(180, true, |x| format!("{x}, {}", speed(x)))),
            (Quantity::Speed, written(180, false, |x| format!("{x} {}", speed(x)))),
            (
                Quantity::Speed,
                "angle (deg);psi'\n".to_owned()
                    + &written(180, true, |x| {
                        format!("{};{}", comma(x.to_degrees()), comma(speed(x)))
                    }),
            ),
            (Quantity::Angle, written(360, true, |x| format!("{x}\t{}", angle(x)))),
            (
                Quantity::Angle,
                written(360, false, |x| format!("{},{}", x.to_degrees(), angle(x).to_degrees())),
            ),
        ];
        for (quantity, text) in texts {
            let made = read(&text, quantity).unwrap_or_else(|e| panic!("{e}\n{text}"));
            for k in 0..30 {
                let phi = 0.21 * f64::from(k);
                assert!((made.derivative(phi) - speed(phi)).abs() < 2e-5, "{quantity:?} {phi}");
            }
        }
    }

    #[test]
    fn one_period_or_a_turn_may_be_given() {
        let law = |phi: f64| 2.0 + 0.3 * (2.0 * phi).cos();
        let options = LawOptions { ratio: Ratio::reciprocal(2).unwrap(), ..LawOptions::default() };
        for span in [TAU / 2.0, TAU] {
            let rows: String = (0..=200)
                .map(|i| span * f64::from(i) / 200.0)
                .map(|x| format!("{x} {}\n", law(x)))
                .collect();
            let made = Table::parse(rows.as_bytes(), Quantity::Speed)
                .unwrap()
                .transmission(&options)
                .unwrap();
            assert!((made.derivative(0.3) - law(0.3)).abs() < 1e-5);
        }
        let wrong = written(200, true, |x| format!("{x} {}", 2.0 + 0.3 * x.cos()));
        let error = Table::parse(wrong.as_bytes(), Quantity::Speed)
            .unwrap()
            .transmission(&options)
            .unwrap_err();
        assert!(matches!(error, LawError::NotPeriodic { folds: 2, .. }), "{error}");
    }

    #[test]
    fn uneven_steps_do_not_make_the_last_row_repeat_the_first() {
        let psi = |phi: f64| phi + 0.1 * phi.sin();
        let rows: String = [0, 40, 80, 120, 160, 200, 240, 280, 320, 340, 350]
            .iter()
            .map(|&d| f64::from(d))
            .map(|d| format!("{d},{}\n", psi(d.to_radians()).to_degrees()))
            .collect();
        let made = read(&rows, Quantity::Angle).unwrap();
        for k in 0..30 {
            let phi = 0.21 * f64::from(k);
            // Steps of 40 degrees leave the spline 1e-3 off.
            assert!((made.derivative(phi) - 1.0 - 0.1 * phi.cos()).abs() < 1e-2, "{phi}");
        }
        let law = |phi: f64| 1.0 + 0.1 * phi.sin();
        let degrees = (0..=30).map(|i| 10 * i).chain((151..=179).map(|i| 2 * i));
        let rows: String =
            degrees.map(f64::from).map(|d| format!("{d},{}\n", law(d.to_radians()))).collect();
        for text in [rows.clone(), rows + "360,1\n"] {
            let made = read(&text, Quantity::Speed).unwrap();
            for k in 0..30 {
                let phi = 0.21 * f64::from(k);
                assert!((made.derivative(phi) - law(phi)).abs() < 1e-3, "{phi}");
            }
        }
        // Rounded to hundredths, the last row still is one turn after the first.
        let rounded = written(60, true, |x| format!("{x:.2} {}", law(x)));
        assert!(read(&rounded, Quantity::Speed).is_ok());
    }

    #[test]
    fn a_part_of_a_turn_may_be_given() {
        let law = |phi: f64| 0.8 + 0.3 * (1.5 * phi).sin();
        let rows: String = (0..=120)
            .map(|i| 0.4 + f64::from(i) / 60.0)
            .map(|x| format!("{x} {}\n", law(x)))
            .collect();
        let table = Table::parse(rows.as_bytes(), Quantity::Speed).unwrap();
        let options = LawOptions::default();
        let made = table.segment_transmission(table.segment(), &options).unwrap();
        for k in 1..40 {
            let phi = 0.4 + 0.05 * f64::from(k);
            assert!((made.derivative(phi) - law(phi)).abs() < 2e-5, "{phi}");
        }
        let beyond = Segment { from: 0.0, to: 2.0 };
        let error = table.segment_transmission(beyond, &options).unwrap_err();
        assert!(error.to_string().contains("22.9 to 137.5 degrees"), "{error}");
    }

    #[test]
    fn damage_is_named() {
        let cases = [
            ("0 1\n1 x\n".to_owned(), "line 2"),
            ("0 1\n1 1\n1 2\n".to_owned(), "line 3"),
            ("0 1\n1 1\n".to_owned(), "2 rows"),
            (written(20, false, |x| format!("{} 1", x * 0.4)), "one period"),
            (written(20, true, |x| format!("{x} {}", 1.0 + 0.1 * x)), "repeat"),
            (written(20, true, |x| format!("{x} {}", 1.3)), "past"),
            (written(20, true, |x| format!("{x} {}", x.cos())), "psi'"),
            (written(20, true, |x| format!("{x} nan")), "line 1"),
        ];
        for (text, word) in cases {
            let error = read(&text, Quantity::Speed).unwrap_err().to_string();
            assert!(error.contains(word), "{word}: {error}");
        }
        let angle = written(40, true, |x| format!("{x} {}", 1.1 * x));
        let error = read(&angle, Quantity::Angle).unwrap_err().to_string();
        assert!(error.contains("36.0 degrees past"), "{error}");
        assert_eq!(Table::parse(&[0xff, 0xfe], Quantity::Speed), Err(LawError::TableNotText));
    }
}
