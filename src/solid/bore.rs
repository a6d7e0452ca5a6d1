//! Holes for shafts and axles.

use super::SolidError;
use crate::geometry::{self, Point, Vector, cross};
use crate::policy;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The hole about a gear's axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Bore {
    /// No hole.
    #[default]
    None,
    /// A round shaft.
    Round {
        /// Diameter of the hole, mm, play included.
        diameter: f64,
    },
    /// The cross of a Lego axle, 4.8 mm across with arms 1.8 mm wide.
    Lego {
        /// Play added on each side, mm; [`policy::LEGO_AXLE_PLAY`] is a snug fit.
        play: f64,
    },
}

impl Bore {
    /// The hole as a counter-clockwise polygon about the origin, mm, or none.
    ///
    /// Arcs are drawn as chords within `chord_tolerance` (mm) of the true curve, on its outside
    /// where that leaves room for the shaft: a round bore never pinches its shaft.
    ///
    /// # Errors
    /// [`SolidError::NotPositiveBore`] for a hole without size.
    pub fn polygon(self, chord_tolerance: f64) -> Result<Option<Vec<Point>>, SolidError> {
        match self {
            Self::None => Ok(None),
            Self::Round { diameter } => {
                if !(diameter > 0.0 && diameter.is_finite()) {
                    return Err(SolidError::NotPositiveBore { diameter });
                }
                let steps = chords(0.5 * diameter, chord_tolerance, TAU);
                let corner = 0.5 * diameter / (PI / steps as f64).cos();
                Ok(Some(regular(corner, steps)))
            }
            Self::Lego { play } => {
                let arm = policy::LEGO_AXLE_ARM + 2.0 * play;
                if !(arm > 0.0 && arm.is_finite()) {
                    return Err(SolidError::NotPositiveBore { diameter: arm });
                }
                Ok(Some(cross_hole(policy::LEGO_AXLE_SPAN + 2.0 * play, arm, chord_tolerance)))
            }
        }
    }
}

/// A circle about the origin, counter-clockwise, its corners on the circle and its chords within
/// `chord_tolerance` of it; same unit throughout.
#[must_use]
pub fn circle(radius: f64, chord_tolerance: f64) -> Vec<Point> {
    regular(radius, chords(radius, chord_tolerance, TAU))
}

fn regular(radius: f64, steps: usize) -> Vec<Point> {
    let corner = |i| geometry::rotate(Point::new(radius, 0.0), TAU * i as f64 / steps as f64);
    (0..steps).map(corner).collect()
}

/// Chords that keep within `tolerance` of an arc of `radius` over `angle`: one per sixteenth of a
/// turn at least, so that a coarse tolerance still leaves a recognisable arc.
fn chords(radius: f64, tolerance: f64, angle: f64) -> usize {
    let reach = (1.0 - tolerance / radius).clamp(-1.0, 1.0).acos();
    let step = (2.0 * reach).clamp(TAU / 4096.0, TAU / 16.0);
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

/// Passes a bore that leaves at least `wall` (mm) of material up to `outline` everywhere.
///
/// Both polygons in the gear's frame, mm; distances are exact for the polygons.
///
/// # Errors
/// [`SolidError::BoreTooLarge`] with the largest round bore about the axis that would fit.
pub fn fits(outline: &[Point], bore: &[Point], wall: f64) -> Result<(), SolidError> {
    let axis = Point::origin();
    let clear = if geometry::contains(outline, axis) { distance_to(outline, axis) } else { 0.0 };
    let reach = bore.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    if reach + wall <= clear {
        return Ok(());
    }
    let inside = bore.iter().all(|&p| geometry::contains(outline, p))
        && !outline.iter().any(|&p| geometry::contains(bore, p));
    let thinnest = if inside { distance_between(outline, bore) } else { 0.0 };
    if thinnest >= wall && thinnest > 0.0 {
        return Ok(());
    }
    let largest = (2.0 * (clear - wall)).max(0.0);
    Err(SolidError::BoreTooLarge { wall: thinnest, needed: wall, largest })
}

fn edges(ring: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

fn distance_to(ring: &[Point], p: Point) -> f64 {
    edges(ring).map(|(a, b)| distance_to_segment(p, a, b)).fold(f64::INFINITY, f64::min)
}

fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let along = b - a;
    let t = (p - a).dot(&along) / along.norm_squared();
    let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
    (p - (a + along * t)).norm()
}

/// Between two rings; zero where they cross.
fn distance_between(a: &[Point], b: &[Point]) -> f64 {
    let crossing = edges(a).any(|(p, q)| {
        edges(b).any(|(r, s)| {
            let side = |u: Point, v: Point, w: Point| cross(v - u, w - u);
            side(p, q, r) * side(p, q, s) < 0.0 && side(r, s, p) * side(r, s, q) < 0.0
        })
    });
    if crossing {
        return 0.0;
    }
    let one_way = |a: &[Point], b: &[Point]| {
        b.iter().map(|&p| distance_to(a, p)).fold(f64::INFINITY, f64::min)
    };
    one_way(a, b).min(one_way(b, a))
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
        assert_eq!(count(10.0), 16);
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
    }

    #[test]
    fn the_wall_decides_what_fits() {
        let outline = circle(10.0, 1e-4);
        let hole = |diameter| Bore::Round { diameter }.polygon(1e-4).unwrap().unwrap();
        assert_eq!(fits(&outline, &hole(15.9), 2.0), Ok(()));
        match fits(&outline, &hole(17.0), 2.0) {
            Err(SolidError::BoreTooLarge { wall, needed, largest }) => {
                assert!((wall - 1.5).abs() < 1e-3 && needed == 2.0);
                assert!((largest - 16.0).abs() < 1e-3);
                assert_eq!(fits(&outline, &hole(largest - 1e-3), 2.0), Ok(()));
            }
            other => panic!("{other:?}"),
        }
        // A cross may fit between corners where the circle about it would not.
        let square: Vec<Point> = regular(6.0, 4);
        let cross = Bore::Lego { play: 0.1 }.polygon(TOLERANCE).unwrap().unwrap();
        assert_eq!(fits(&square, &cross, 1.6), Ok(()));
    }

    #[test]
    fn an_axis_outside_the_gear_takes_no_bore() {
        let outline: Vec<Point> =
            circle(10.0, 0.01).iter().map(|p| p + Vector::new(30.0, 0.0)).collect();
        let error = fits(&outline, &regular(1.0, 16), 0.0).unwrap_err();
        assert_eq!(error, SolidError::BoreTooLarge { wall: 0.0, needed: 0.0, largest: 0.0 });
        assert!(error.to_string().contains("leave the bore out"));
    }
}
