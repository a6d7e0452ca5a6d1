//! Fits one after another: what depends on the shapes alone is kept from one to the next.

use std::sync::Arc;

use super::difference::Outlined;
use super::global_search::{self, Found, KEPT_CANDIDATES};
use super::grid::GRID_CENTERS;
use super::objective::{Candidate, Problem};
use super::polish::{self, Plan};
use super::scan::Scan;
use super::{
    Fit, FitError, FitOptions, Fixed, Limits, MOST_ALTERNATIVES, Ratio, Search, apply, check,
    paper_search, placement, symmetric,
};
use crate::control::{Control, StageName};
use crate::gear::Side;
use crate::geometry::Point;
use crate::outline::Outline;
use crate::policy;

/// Scans that are kept: that with an axis held and that without, so that letting it go costs nothing.
const KEPT_SCANS: usize = 2;
/// Alternatives differ by at least this much from every one before them (see [`super::difference`]): a difference that is
/// seen without laying one over the other.
const LEAST_DIFFERENCE: f64 = 0.08;
/// Candidates of the scan for every alternative that is wanted.
const CANDIDATES_PER_ALTERNATIVE: usize = 6;

/// Fits shapes to each other, and keeps what does not depend on balance, weights and limits: the scan of every pair of centres,
/// more than half of the work. Another fit of the same two shapes at the same ratio and with the same choices fixed starts from it.
///
/// Results are the same as those of a new fitter.
#[derive(Clone, Debug, Default)]
pub struct Fitter {
    known: Vec<Known>,
}

/// A scan, and what it holds for.
#[derive(Clone, Debug)]
struct Known {
    shapes: [Vec<Point>; 2],
    ratio: Ratio,
    fixed: Fixed,
    scan: Arc<Scan>,
}

impl Fitter {
    /// As [`super::fit`].
    ///
    /// # Errors
    /// See [`FitError`].
    pub fn fit(
        &mut self,
        driver: &Outline,
        follower: &Outline,
        ratio: Ratio,
        options: &FitOptions,
        control: &Control,
    ) -> Result<Fit, FitError> {
        let Some(choose) = options.choose else {
            let mut fits = self.ranked(driver, follower, ratio, options, 1, control)?;
            return Ok(fits.swap_remove(0));
        };
        let mut fits =
            self.alternatives(driver, follower, ratio, options, MOST_ALTERNATIVES, control)?;
        let found = fits.len();
        if !(1..=found).contains(&choose) {
            return Err(FitError::NoSuchAlternative { choose, found });
        }
        Ok(fits.swap_remove(choose - 1))
    }

    /// As [`super::alternatives`].
    ///
    /// # Errors
    /// See [`FitError`].
    pub fn alternatives(
        &mut self,
        driver: &Outline,
        follower: &Outline,
        ratio: Ratio,
        options: &FitOptions,
        count: usize,
        control: &Control,
    ) -> Result<Vec<Fit>, FitError> {
        let fits = self.ranked(driver, follower, ratio, options, MOST_ALTERNATIVES, control)?;
        let mut kept: Vec<(Outlined, Fit)> = Vec::new();
        for fit in fits {
            if kept.len() >= count.min(MOST_ALTERNATIVES) {
                break;
            }
            let outlined = Outlined::new(&fit);
            if kept.iter().all(|k| k.0.apart(&outlined) >= LEAST_DIFFERENCE) {
                kept.push((outlined, fit));
            }
        }
        Ok(kept.into_iter().map(|k| k.1).collect())
    }

    /// Fits, best first, at least one; of several asked for, about so many differ.
    fn ranked(
        &mut self,
        driver: &Outline,
        follower: &Outline,
        ratio: Ratio,
        options: &FitOptions,
        count: usize,
        control: &Control,
    ) -> Result<Vec<Fit>, FitError> {
        check(ratio, options)?;
        control.progress(StageName::Wanted, 0.0);
        let made = control.run(|| self.made(driver, follower, ratio, options, count, control));
        // Whatever a search says that was given up half way is not worth hearing.
        control.check()?;
        control.progress(StageName::Wanted, 1.0);
        made
    }

    fn made(
        &mut self,
        driver: &Outline,
        follower: &Outline,
        ratio: Ratio,
        options: &FitOptions,
        count: usize,
        control: &Control,
    ) -> Result<Vec<Fit>, FitError> {
        if !ratio.is_whole() {
            return Err(FitError::Rational { ratio });
        }
        if options.symmetric {
            return symmetric::fit_to_itself(driver, follower, ratio, options, control)
                .map(|f| vec![f]);
        }
        let problem = Problem::new(
            (driver.points(), follower.points()),
            ratio,
            &options.limits,
            (options.weight, options.balance, options.star_weight),
            options.samples,
        )
        .with_fixed(options.fixed)
        .with_control(control);
        for side in Side::BOTH {
            if let Some(axis) = options.fixed.axis(side) {
                problem.law(side, axis)?;
            }
        }
        // Impossible limits should be said at once, not found in every candidate.
        apply(&[1.0; policy::MIN_TRANSMISSION_SAMPLES], problem.folds(), &options.limits)?;
        if let Fixed {
            driver_axis: Some(driver),
            follower_axis: Some(follower),
            orientation: Some(_),
        } = options.fixed
        {
            // Nothing is left to search for.
            let only = Candidate { driver, follower, shift: 0.0 };
            return placement::place(&problem, &only, 1).map(|fit| vec![fit]);
        }
        let plan = Plan::new(options.effort, count, options.search == Search::Coarse);
        let wanted = KEPT_CANDIDATES.max(CANDIDATES_PER_ALTERNATIVE * count).max(plan.candidates);
        let found = match options.search {
            Search::Paper => {
                let (candidates, pairs) = paper_search::search(&problem);
                Found { candidates, pairs }
            }
            Search::Coarse => global_search::coarse(&problem, &*self.scan(&problem)?, wanted),
            Search::Global => global_search::global(&problem, &*self.scan(&problem)?, wanted),
        };
        control.check()?;
        let winner = found.candidates.first().ok_or(FitError::NoCenter)?;
        let fit = placement::place(&problem, winner, found.pairs)?;
        if !options.refine || options.fixed.orientation.is_some() {
            let others = found.candidates.iter().skip(1).take(if count > 1 { wanted } else { 0 });
            let others = others.filter_map(|c| placement::place(&problem, c, found.pairs).ok());
            let mut fits: Vec<Fit> = [fit].into_iter().chain(others).collect();
            fits.sort_by(|a, b| a.objective.total.total_cmp(&b.objective.total));
            return Ok(fits);
        }
        // Likeness is not bought with torque: psi' stays below what the search found.
        let most = options.limits.max_derivative.unwrap_or(f64::INFINITY);
        let most = most.min(fit.transmission.max_derivative());
        let held = Limits { max_derivative: Some(most), ..options.limits };
        Ok(polish::polished(&problem.with_limits(&held), fit, &found.candidates, &plan))
    }

    /// The scan of a problem's shapes, perhaps a known one.
    fn scan(&mut self, problem: &Problem<'_>) -> Result<Arc<Scan>, FitError> {
        let shapes = [problem.driver, problem.follower];
        let known = self.known.iter().position(|k| {
            k.ratio == problem.ratio && k.fixed == problem.fixed && k.shapes == shapes
        });
        let known = match known {
            Some(at) => self.known.remove(at),
            None => Known {
                shapes: shapes.map(<[Point]>::to_vec),
                ratio: problem.ratio,
                fixed: problem.fixed,
                scan: Arc::new(Scan::new(problem, GRID_CENTERS)),
            },
        };
        // A scan that was given up half way has holes.
        problem.control.check()?;
        let scan = Arc::clone(&known.scan);
        self.known.insert(0, known);
        self.known.truncate(KEPT_SCANS);
        Ok(scan)
    }
}
