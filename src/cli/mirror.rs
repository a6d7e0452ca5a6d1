//! `--mirror`: shapes that are turned over before they are fitted.

use centrode::control::Control;
use centrode::fit::{Fit, fit};
use centrode::geometry::{Point, bounds};
use centrode::input::Shape;
use centrode::outline::Outline;
use centrode::pipeline::DesignOptions;

use super::args::MirrorArg;

/// Share of its measure by which a pair with a mirrored follower must be better to be taken unasked: less is not seen.
const WORTH_MIRRORING: f64 = 0.02;

/// Turns the shapes over that `--mirror` names, with the axes that are fixed in them, and says so in their names.
///
/// Turning over both makes the same pair, seen from behind; so `auto` has to try the follower alone.
pub(super) fn mirrored(
    shapes: [Shape; 2],
    which: MirrorArg,
    options: &mut DesignOptions,
    control: &Control,
) -> anyhow::Result<[Shape; 2]> {
    let turned = match which {
        MirrorArg::None => [false, false],
        MirrorArg::Driver => [true, false],
        MirrorArg::Follower => [false, true],
        MirrorArg::Both => [true, true],
        MirrorArg::Auto => [false, is_better_mirrored(&shapes, options, control)?],
    };
    let [driver, follower] = shapes;
    let turn = |shape: Shape, axis: &mut Option<Point>, turned: bool| -> anyhow::Result<Shape> {
        if turned { turned_over(&shape, axis) } else { Ok(shape) }
    };
    let fixed = &mut options.fit.fixed;
    Ok([
        turn(driver, &mut fixed.driver_axis, turned[0])?,
        turn(follower, &mut fixed.follower_axis, turned[1])?,
    ])
}

/// Whether the pair is clearly better with the follower turned over.
fn is_better_mirrored(
    shapes: &[Shape; 2],
    options: &DesignOptions,
    control: &Control,
) -> anyhow::Result<bool> {
    let [driver, follower] = shapes;
    let mut fixed = options.fit.fixed;
    let other = turned_over(follower, &mut fixed.follower_axis)?;
    let asked = |shape: &Shape, fixed| -> anyhow::Result<f64> {
        let asked = centrode::fit::FitOptions { fixed, ..options.fit.clone() };
        let (a, b) = (&driver.outline, &shape.outline);
        Ok(measure(&fit(a, b, options.ratio, &asked, control)?))
    };
    let (plain, mirrored) = (asked(follower, options.fit.fixed)?, asked(&other, fixed)?);
    Ok(mirrored < (1.0 - WORTH_MIRRORING) * plain)
}

fn measure(fit: &Fit) -> f64 {
    fit.refinement.map_or(fit.objective.total, |refinement| refinement.after)
}

/// A shape seen from behind, in the same place, and a point of it.
fn turned_over(shape: &Shape, axis: &mut Option<Point>) -> anyhow::Result<Shape> {
    let (low, high) = bounds(shape.raw.points());
    let over = |p: &Point| Point::new(low.x + high.x - p.x, p.y);
    *axis = axis.as_ref().map(over);
    let outline = |from: &Outline| Outline::new(from.points().iter().rev().map(over).collect());
    let mut other = shape.clone();
    other.name.push_str(" mirrored");
    other.raw = outline(&shape.raw)?;
    other.outline = outline(&shape.outline)?;
    other.inner = shape.inner.mapped(over);
    Ok(other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode::input::{LoadOptions, load};

    #[test]
    fn twice_over_is_as_it_was() {
        let dove = load("dove", &LoadOptions::default()).unwrap();
        let at = Point::new(0.3, 0.4);
        let mut axis = Some(at);
        let once = turned_over(&dove, &mut axis).unwrap();
        assert!(
            once.name.ends_with("mirrored") && axis.is_some_and(|p| p.y == at.y && p.x != at.x)
        );
        let twice = turned_over(&once, &mut axis).unwrap();
        assert!((axis.unwrap() - at).norm() < 1e-9);
        let near = |a: &Point| twice.outline.points().iter().any(|b| (a - b).norm() < 1e-9);
        assert!(dove.outline.points().iter().all(near));
        assert!((once.outline.area() - dove.outline.area()).abs() < 1e-9);
    }
}
