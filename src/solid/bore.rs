//! Holes for shafts and axles.

use super::SolidError;
use super::wall::{distance_to, fits};
use crate::geometry::{self, Point, Vector};
use crate::policy;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The hole about a gear's axis. Sizes are those of the hole, mm, play included
/// ([`Bore::with_play`]). What is not round has its key, flat or corner-to-corner arm on +x.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Bore {
    /// No hole.
    #[default]
    None,
    /// A round shaft.
    Round {
        /// Diameter of the hole.
        diameter: f64,
    },
    /// A round shaft with one flat.
    D {
        /// Diameter of the round part.
        diameter: f64,
        /// From the flat to the far side of the round part: more than half the diameter, and less
        /// than all of it.
        flat: f64,
    },
    /// A hexagonal shaft.
    Hex {
        /// Across the flats.
        across: f64,
    },
    /// A square shaft.
    Square {
        /// Side of the square.
        side: f64,
    },
    /// A round shaft with a key.
    Keyway {
        /// Diameter of the round part.
        diameter: f64,
        /// Width of the groove for the key.
        width: f64,
        /// Depth of the groove beyond the round part.
        depth: f64,
    },
    /// The cross of a Lego axle, 4.8 mm across with arms 1.8 mm wide.
    Lego {
        /// Play added on each side, mm; [`policy::LEGO_AXLE_PLAY`] is a snug fit.
        play: f64,
    },
}

impl Bore {
    /// The bore of a round shaft (mm) with a parallel key by DIN 6885-1, or none for a shaft thinner or thicker
    /// than that table has.
    #[must_use]
    pub fn with_standard_key(diameter: f64) -> Option<Self> {
        let (thinnest, table) = (policy::THINNEST_KEYED_SHAFT, policy::KEYWAYS);
        let row = table.iter().find(|(most, ..)| diameter >= thinnest && diameter <= *most);
        row.map(|&(_, width, depth)| Self::Keyway { diameter, width, depth })
    }

    /// The same with `play` (mm) more on each side; for a Lego axle, with that play.
    #[must_use]
    pub fn with_play(self, play: f64) -> Self {
        let wide = 2.0 * play;
        match self {
            Self::None => self,
            Self::Round { diameter } => Self::Round { diameter: diameter + wide },
            Self::D { diameter, flat } => Self::D { diameter: diameter + wide, flat: flat + wide },
            Self::Hex { across } => Self::Hex { across: across + wide },
            Self::Square { side } => Self::Square { side: side + wide },
            Self::Keyway { diameter, width, depth } => {
                Self::Keyway { diameter: diameter + wide, width: width + wide, depth }
            }
            Self::Lego { .. } => Self::Lego { play },
        }
    }

    /// The hole as a counter-clockwise polygon about the origin, mm, or none.
    ///
    /// Arcs are drawn as chords within `chord_tolerance` (mm) of the true curve, on its outside
    /// where that leaves room for the shaft: a round bore never pinches its shaft.
    ///
    /// # Errors
    /// [`SolidError::NotPositiveBore`] for a hole without size, [`SolidError::BadFlat`] and
    /// [`SolidError::BadKeyway`] for one that is not of its kind.
    pub fn polygon(self, chord_tolerance: f64) -> Result<Option<Vec<Point>>, SolidError> {
        let positive = |size: f64| {
            if size > 0.0 && size.is_finite() {
                Ok(())
            } else {
                Err(SolidError::NotPositiveBore { diameter: size })
            }
        };
        let round = |diameter: f64| hole(0.5 * diameter, chord_tolerance);
        Ok(Some(match self {
            Self::None => return Ok(None),
            Self::Round { diameter } => {
                positive(diameter)?;
                round(diameter)
            }
            Self::D { diameter, flat } => {
                positive(diameter)?;
                if !(flat > 0.5 * diameter && flat < diameter) {
                    return Err(SolidError::BadFlat { diameter, flat });
                }
                left_of(&round(diameter), flat - 0.5 * diameter)
            }
            Self::Hex { across } => {
                positive(across)?;
                regular(0.5 * across / (PI / 6.0).cos(), 6)
            }
            Self::Square { side } => {
                positive(side)?;
                let half = 0.5 * side;
                [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                    .map(|(x, y)| Point::new(half * x, half * y))
                    .to_vec()
            }
            Self::Keyway { diameter, width, depth } => {
                positive(diameter)?;
                if !(width > 0.0 && width < diameter && depth > 0.0 && depth < diameter) {
                    return Err(SolidError::BadKeyway { diameter, width, depth });
                }
                keyed(&round(diameter), 0.5 * width, 0.5 * diameter + depth)
            }
            Self::Lego { play } => {
                let arm = policy::LEGO_AXLE_ARM + 2.0 * play;
                positive(arm)?;
                cross_hole(policy::LEGO_AXLE_SPAN + 2.0 * play, arm, chord_tolerance)
            }
        }))
    }

    /// The polygon of a bore that leaves at least `wall` (mm) of material up to `outline`.
    ///
    /// # Errors
    /// Those of [`Bore::polygon`]; [`SolidError::BoreTooLarge`] with the largest of this kind that
    /// would fit.
    pub fn fitted(
        self,
        outline: &[Point],
        wall: f64,
        chord_tolerance: f64,
    ) -> Result<Option<Vec<Point>>, SolidError> {
        let Some(hole) = self.polygon(chord_tolerance)? else { return Ok(None) };
        match fits(outline, &hole, wall) {
            Err(SolidError::BoreTooLarge { wall: found, needed, largest, .. }) => {
                let (kind, size) = self.kind();
                let Some(size) = size else {
                    let kind = "round";
                    return Err(SolidError::BoreTooLarge { wall: found, needed, largest, kind });
                };
                let fitting = |share: f64| {
                    let hole = self.scaled(share).polygon(chord_tolerance).ok().flatten();
                    hole.is_some_and(|hole| fits(outline, &hole, wall).is_ok())
                };
                // Halved until the share is known to a thousandth of a millimetre or so.
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..policy::LARGEST_BORE_STEPS {
                    let middle = 0.5 * (low + high);
                    *(if fitting(middle) { &mut low } else { &mut high }) = middle;
                }
                Err(SolidError::BoreTooLarge { wall: found, needed, largest: low * size, kind })
            }
            other => other.map(|()| Some(hole)),
        }
    }

    /// What it is called, and its main size, mm, if it comes in sizes.
    #[must_use]
    pub fn kind(self) -> (&'static str, Option<f64>) {
        match self {
            Self::None => ("no", None),
            Self::Round { diameter } => ("round", Some(diameter)),
            Self::D { diameter, .. } => ("D", Some(diameter)),
            Self::Hex { across } => ("hex", Some(across)),
            Self::Square { side } => ("square", Some(side)),
            Self::Keyway { diameter, .. } => ("keyway", Some(diameter)),
            Self::Lego { .. } => ("lego", None),
        }
    }

    fn scaled(self, share: f64) -> Self {
        match self {
            Self::None | Self::Lego { .. } => self,
            Self::Round { diameter } => Self::Round { diameter: share * diameter },
            Self::D { diameter, flat } => {
                Self::D { diameter: share * diameter, flat: share * flat }
            }
            Self::Hex { across } => Self::Hex { across: share * across },
            Self::Square { side } => Self::Square { side: share * side },
            Self::Keyway { diameter, width, depth } => Self::Keyway {
                diameter: share * diameter,
                width: share * width,
                depth: share * depth,
            },
        }
    }
}

/// Radius of the thickest round pin about the origin that turns in a hole, mm.
#[must_use]
pub fn pin_radius(hole: &[Point]) -> f64 {
    if geometry::contains(hole, Point::origin()) { distance_to(hole, Point::origin()) } else { 0.0 }
}

/// What of a convex polygon lies left of x = `limit`.
fn left_of(ring: &[Point], limit: f64) -> Vec<Point> {
    let mut kept = Vec::with_capacity(ring.len());
    for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        if a.x <= limit {
            kept.push(*a);
        }
        if (a.x < limit && b.x > limit) || (a.x > limit && b.x < limit) {
            kept.push(a + (b - a) * ((limit - a.x) / (b.x - a.x)));
        }
    }
    kept
}

/// A round hole with a groove on +x: half as wide as `half`, its floor at x = `floor`.
fn keyed(round: &[Point], half: f64, floor: f64) -> Vec<Point> {
    let outside = |p: &&Point| !(p.x > 0.0 && p.y.abs() <= half);
    // The ring starts on +x, so what is left of it is one piece from above the groove to below it.
    let rest: Vec<Point> = round.iter().filter(outside).copied().collect();
    let x_at = |y: f64| {
        let ends = round.iter().zip(round.iter().cycle().skip(1));
        let across = ends.filter(|(a, b)| (a.y - y) * (b.y - y) <= 0.0 && a.y != b.y);
        across.map(|(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y)).fold(0.0, f64::max)
    };
    let mut ring = vec![Point::new(x_at(-half), -half), Point::new(floor, -half)];
    ring.extend([Point::new(floor, half), Point::new(x_at(half), half)]);
    ring.extend(rest);
    ring
}

/// A circle about the origin, counter-clockwise, its corners on the circle and its chords within
/// `chord_tolerance` of it; same unit throughout.
#[must_use]
pub fn circle(radius: f64, chord_tolerance: f64) -> Vec<Point> {
    regular(radius, chords(radius, chord_tolerance, TAU))
}

/// A round hole about the origin, counter-clockwise: its chords touch the circle of `radius` and its corners lie within
/// `chord_tolerance` outside, so that what is as wide as the circle goes in; same unit throughout.
#[must_use]
pub fn hole(radius: f64, chord_tolerance: f64) -> Vec<Point> {
    let steps = chords(radius, chord_tolerance, TAU);
    regular(radius / (PI / steps as f64).cos(), steps)
}

fn regular(radius: f64, steps: usize) -> Vec<Point> {
    let corner = |i| geometry::rotate(Point::new(radius, 0.0), TAU * i as f64 / steps as f64);
    (0..steps).map(corner).collect()
}

/// Chords that keep within `tolerance` of an arc of `radius` over `angle`: one per thirty-second of
/// a turn at least, so that a coarse tolerance still leaves a recognisable arc
/// ([`policy::CORNER_TURN`]).
fn chords(radius: f64, tolerance: f64, angle: f64) -> usize {
    let reach = (1.0 - tolerance / radius).clamp(-1.0, 1.0).acos();
    let step = (2.0 * reach).clamp(TAU / 4096.0, TAU / 32.0);
    (angle / step).ceil() as usize
}

/// A cross whose four inner corners, where material pokes into the hole, are rounded off.
fn cross_hole(span: f64, arm: f64, tolerance: f64) -> Vec<Point> {
    let (reach, half) = (0.5 * span, 0.5 * arm);
    let fillet = policy::LEGO_AXLE_FILLET.min(0.5 * (reach - half));
    let steps = chords(fillet, tolerance, FRAC_PI_2);
    // One arm along +x from its lower corner to the rounded corner that leads to the next arm.
    let mut quarter = vec![Point::new(reach, -half), Point::new(reach, half)];
    let center = Point::new(half + fillet, half + fillet);
    quarter.extend((0..=steps).map(|i| {
        let turn = -FRAC_PI_2 - FRAC_PI_2 * i as f64 / steps as f64;
        center + fillet * Vector::new(turn.cos(), turn.sin())
    }));
    (0..4)
        .flat_map(|k| {
            let turn = f64::from(k) * FRAC_PI_2;
            quarter.iter().map(move |&p| geometry::rotate(p, turn)).collect::<Vec<_>>()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: f64 = 0.005;

    #[test]
    fn a_round_bore_clears_its_shaft_within_the_tolerance() {
        let hole = Bore::Round { diameter: 5.0 }.polygon(TOLERANCE).unwrap().unwrap();
        let (low, high) = hole.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), p| {
            (low.min(p.coords.norm()), high.max(p.coords.norm()))
        });
        assert!(low > 2.5 && high <= 2.5 + 1.01 * TOLERANCE, "{low} {high}");
        assert!((distance_to(&hole, Point::origin()) - 2.5).abs() < 1e-12);
        assert!(geometry::signed_area(&hole) > 0.0);
    }

    #[test]
    fn a_finer_tolerance_draws_more_chords() {
        let count = |t| Bore::Round { diameter: 5.0 }.polygon(t).unwrap().unwrap().len();
        assert!(count(1e-4) > 2 * count(1e-2));
        assert_eq!(count(10.0), 32);
    }

    #[test]
    fn the_cross_has_the_area_of_two_bars_and_four_fillets() {
        let play = 0.1;
        let hole = Bore::Lego { play }.polygon(1e-5).unwrap().unwrap();
        let (span, arm, r) = (4.8 + 2.0 * play, 1.8 + 2.0 * play, policy::LEGO_AXLE_FILLET);
        let area = 2.0 * span * arm - arm * arm + 4.0 * r * r * (1.0 - PI / 4.0);
        assert!((geometry::signed_area(&hole) - area).abs() < 1e-4);
        assert_eq!(geometry::first_self_crossing(&hole), None);
        let (low, high) = geometry::bounds(&hole);
        assert!((high.x - 2.5).abs() < 1e-12 && (low.y + 2.5).abs() < 1e-12);
        // The axle itself, corners of its arms included, lies inside.
        assert!(geometry::contains(&hole, Point::new(2.4, 0.9)));
    }

    #[test]
    fn no_bore_is_none_and_bad_sizes_are_refused() {
        assert_eq!(Bore::None.polygon(TOLERANCE), Ok(None));
        for diameter in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Bore::Round { diameter }.polygon(TOLERANCE).is_err());
        }
        assert!(Bore::Lego { play: -1.0 }.polygon(TOLERANCE).is_err());
        for flat in [2.5, 5.0, 6.0, f64::NAN] {
            assert!(Bore::D { diameter: 5.0, flat }.polygon(TOLERANCE).is_err());
        }
        for (width, depth) in [(0.0, 1.0), (8.0, 1.0), (2.0, 0.0), (2.0, f64::NAN)] {
            assert!(Bore::Keyway { diameter: 8.0, width, depth }.polygon(TOLERANCE).is_err());
        }
    }

    #[test]
    fn every_kind_has_the_area_of_its_formula() {
        let segment = |r: f64, h: f64| {
            // Of a circle of radius r, beyond a chord at distance h of the centre.
            r * r * (h / r).acos() - h * (r * r - h * h).sqrt()
        };
        let key = |r: f64, w: f64, depth: f64| {
            // The groove counts from the circle on: its box from the chord, less the segment.
            let h = (r * r - 0.25 * w * w).sqrt();
            PI * r * r + w * (r + depth - h) - segment(r, h)
        };
        for (bore, area) in [
            (Bore::D { diameter: 5.0, flat: 4.5 }, PI * 6.25 - segment(2.5, 2.0)),
            (Bore::D { diameter: 6.0, flat: 3.5 }, PI * 9.0 - segment(3.0, 0.5)),
            (Bore::Hex { across: 6.0 }, 0.5 * 3.0_f64.sqrt() * 36.0),
            (Bore::Square { side: 4.0 }, 16.0),
            (Bore::with_standard_key(8.0).unwrap(), key(4.0, 2.0, 1.0)),
            (Bore::with_standard_key(17.0).unwrap(), key(8.5, 5.0, 2.3)),
        ] {
            let hole = bore.polygon(1e-6).unwrap().unwrap();
            let found = geometry::signed_area(&hole);
            assert!((found / area - 1.0).abs() < 1e-5, "{bore:?}: {found} {area}");
            assert_eq!(geometry::first_self_crossing(&hole), None, "{bore:?}");
            // Coarsely drawn it still takes its shaft: no point of the fine one lies outside.
            let coarse = bore.polygon(0.02).unwrap().unwrap();
            let inside = |p: &Point| geometry::contains(&coarse, p * (1.0 - 1e-5));
            assert!(hole.iter().all(inside), "{bore:?}");
        }
        assert_eq!(Bore::with_standard_key(4.0), None);
        assert_eq!(Bore::with_standard_key(200.0), None);
    }

    #[test]
    fn play_widens_every_side_by_itself() {
        for bore in [
            Bore::Round { diameter: 5.0 },
            Bore::D { diameter: 5.0, flat: 4.4 },
            Bore::Hex { across: 6.0 },
            Bore::Square { side: 4.0 },
        ] {
            let [plain, wide] =
                [bore, bore.with_play(0.2)].map(|b| b.polygon(1e-5).unwrap().unwrap());
            assert!((pin_radius(&wide) - pin_radius(&plain) - 0.2).abs() < 1e-9, "{bore:?}");
            // The flat, side or corner on +x moves out too.
            let [a, b] = [&plain, &wide].map(|ring| geometry::bounds(ring).1.x);
            assert!(b - a > 0.199, "{bore:?}: {a} {b}");
        }
        let keyed = Bore::with_standard_key(10.0).unwrap().with_play(0.1);
        assert_eq!(keyed, Bore::Keyway { diameter: 10.2, width: 3.2, depth: 1.4 });
        assert_eq!(Bore::Lego { play: 0.1 }.with_play(0.3), Bore::Lego { play: 0.3 });
    }

    #[test]
    fn the_largest_of_a_kind_is_told() {
        let outline = circle(10.0, 1e-4);
        for (bore, largest) in [
            (Bore::Hex { across: 18.0 }, 16.0 * (PI / 6.0).cos()),
            (Bore::Square { side: 15.0 }, 16.0 / 2.0_f64.sqrt()),
            (Bore::D { diameter: 20.0, flat: 15.0 }, 16.0),
        ] {
            match bore.fitted(&outline, 2.0, 1e-4).unwrap_err() {
                SolidError::BoreTooLarge { largest: told, kind, .. } => {
                    assert!((told - largest).abs() < 2e-3, "{bore:?}: {told} {largest}");
                    assert_eq!(kind, bore.kind().0);
                }
                other => panic!("{other}"),
            }
        }
        let cross = Bore::Lego { play: 0.1 };
        let error = cross.fitted(&circle(3.0, 1e-3), 1.2, 1e-3).unwrap_err().to_string();
        assert!(error.contains("largest round bore that fits is 3.59 mm"), "{error}");
    }
}
