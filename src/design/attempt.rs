//! One try at a pair: settings, the gears they give, and how good those are.

use super::settings::Settings;
use super::source::Source;
use super::{
    Design, DesignError, DesignOptions, Scale, TeethStyle, bore_for, feasibility, placed_gear,
    placed_input,
};
use crate::assembly::{Assembly, Fittings, Gear};
use crate::control::Control;
use crate::fit;
use crate::gear::{Motion, Side};
use crate::geometry::{self, Point};
use crate::meshing::{ContactAnalysis, ContactInput, ContactOptions, analyse};
use crate::pitch::{Centrodes, Transmission};
use crate::policy;
use crate::solid::{carve_follower_with_manifold, circle};
use crate::strength::{Loaded, strength};
use crate::teeth::{self, Profile, TeethError, TeethOptions, ToothedPair};

/// The pitch curves at the size asked for; the extent counts the tips of `teeth` driver teeth.
pub(super) fn scaled(
    transmission: Transmission,
    options: &DesignOptions,
    teeth: Option<u32>,
) -> Centrodes {
    match options.scale {
        Scale::CenterDistance(center_distance) => Centrodes { transmission, center_distance },
        Scale::Extent(extent) => {
            let unit = Centrodes { transmission, center_distance: 1.0 };
            let mut points = unit.driver_curve(policy::PITCH_CURVE_POINTS);
            let follower = unit.follower_curve(policy::PITCH_CURVE_POINTS);
            points.extend(follower.iter().map(|p| Point::new(p.x + 1.0, p.y)));
            let (low, high) = geometry::bounds(&points);
            let module =
                |count: u32| unit.perimeter().0 / (std::f64::consts::PI * f64::from(count));
            let tips = 2.0 * options.addendum * teeth.map_or(0.0, module);
            let size = (high - low).max() + tips;
            Centrodes { center_distance: extent / size, ..unit }
        }
    }
}

/// A pair with its analysis, before it is finished.
#[derive(Debug)]
pub(super) struct Attempt {
    settings: Settings,
    pub(super) centrodes: Centrodes,
    pair: ToothedPair,
    finished: [Profile; 2],
    exact: ContactAnalysis,
    contact: ContactAnalysis,
    rounding: fit::LimitCost,
    /// In modules.
    allowed_interference: f64,
    is_confirmed: bool,
}

impl Attempt {
    pub(super) fn make(
        source: &Source<'_>,
        options: &DesignOptions,
        settings: Settings,
    ) -> Result<Self, DesignError> {
        let (transmission, rounding) = if settings.exact {
            (source.transmission.clone(), source.limited)
        } else {
            let folds = source.folds();
            let (samples, rounding) = fit::apply(&source.raw, folds, &settings.limits(options))?;
            let samples =
                if source.symmetric { fit::symmetrised(&samples)?.samples } else { samples };
            (Transmission::from_derivative(&samples, folds.0, folds.1)?, rounding)
        };
        let centrodes = scaled(transmission, options, Some(settings.teeth));
        let module = centrodes.perimeter().0 / (std::f64::consts::PI * f64::from(settings.teeth));
        if let Some(root) = options.root_clearance {
            let most = policy::DEEPEST_ROOT_CLEARANCE * module;
            if root > most {
                let remedy = format!("give up to {most:.3} mm, the module of these teeth");
                return Err(DesignError::Option {
                    name: "the root clearance",
                    value: root,
                    remedy,
                });
            }
        }
        let teeth_options = TeethOptions {
            driver_teeth: settings.teeth,
            pressure_angle: options.pressure_angle,
            addendum: options.addendum,
            // A follower that is carved by solids is carved by the designed motion, before its clearance.
            clearance: if options.carve_with_solids { 0.0 } else { options.clearance },
            backlash: options.backlash,
            root_clearance: options
                .root_clearance
                .map_or(TeethOptions::default().root_clearance, |mm| mm / module),
            chord_tolerance: options.chord_tolerance,
            control: options.control.clone(),
            ..TeethOptions::default()
        };
        let pair = match options.style {
            TeethStyle::Involute => teeth::involute_pair(&centrodes, &teeth_options)?,
            TeethStyle::Wave => teeth::wave_pair(&centrodes, &teeth_options)?,
            TeethStyle::RegularWave => teeth::regular_wave_pair(&centrodes, &teeth_options)?,
        };
        let pair = if options.carve_with_solids {
            carved_by_solids(&centrodes, pair, options)?
        } else {
            pair
        };
        let finished = finished(&pair, options)?;
        let poses = policy::CONTACT_POSES_TRIED;
        let (exact, contact) =
            analysed(None, poses, &centrodes, &pair, &finished, &options.control)?;
        let drawn =
            policy::CARVE_SKIN + 2.0 * options.chord_tolerance - 2.0 * options.clearance / module;
        let allowed_interference = policy::WORST_INTERFERENCE + drawn.max(0.0);
        Ok(Self {
            settings,
            centrodes,
            pair,
            finished,
            exact,
            contact,
            rounding,
            allowed_interference,
            is_confirmed: false,
        })
    }

    /// The attempt with its contact analysed at every pose that a delivered pair is judged by.
    pub(super) fn confirmed(mut self, options: &DesignOptions) -> Result<Self, DesignError> {
        if self.is_confirmed || options.quick {
            return Ok(self);
        }
        self.is_confirmed = true;
        let known = Some((self.exact, self.contact));
        (self.exact, self.contact) = analysed(
            known,
            policy::CONTACT_POSES,
            &self.centrodes,
            &self.pair,
            &self.finished,
            &options.control,
        )?;
        Ok(self)
    }

    /// Steepest lean of its pitch curves, radians.
    pub(super) fn max_lean(&self) -> f64 {
        self.centrodes.max_lean()
    }

    /// What it was made with.
    pub(super) fn settings(&self) -> Settings {
        self.settings
    }

    /// 99th percentile of the transmission error against the motion that the flanks were made for, in pitches.
    pub(super) fn error_share(&self) -> f64 {
        self.exact
            .summary
            .transmission_error_pitch
            .as_ref()
            .map_or(f64::INFINITY, |e| e.p99_deviation)
    }

    fn interference_in_modules(&self) -> f64 {
        self.contact.summary.max_interference.as_ref().map_or(0.0, |w| w.value / self.pair.module)
    }

    pub(super) fn is_good(&self) -> bool {
        self.error_share() <= policy::GOOD_TRANSMISSION_ERROR
            && self.contact.summary.lost_poses == 0
            && self.contact.summary.lost_poses_reversed == 0
            && self.interference_in_modules() <= self.allowed_interference
    }

    /// To compare attempts: lost contact and interference weigh more than any transmission error.
    pub(super) fn badness(&self) -> f64 {
        let lost = self.contact.summary.lost_poses + self.contact.summary.lost_poses_reversed;
        let lost =
            policy::CONTACT_POSES as f64 * lost as f64 / self.contact.poses.len().max(1) as f64;
        let interference = (self.interference_in_modules() - self.allowed_interference).max(0.0);
        lost + 10.0 * interference + self.error_share().min(1.0)
    }

    fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let summary = &self.contact.summary;
        let exact = &self.exact.summary;
        // Where the teeth themselves keep contact, clearance opens them too far for their size.
        let remedy = if exact.lost_poses + exact.lost_poses_reversed == 0 {
            "give less clearance or fewer teeth"
        } else {
            "try more teeth, more smoothing or a lower --max-lean"
        };
        if let Some(arc) = summary.lost.first() {
            faults.push(format!(
                "contact is lost over {:.1} degrees of driver turn, first at {:.1} degrees; {remedy}",
                summary.lost_angle.to_degrees(),
                arc.from.to_degrees()
            ));
        } else if summary.lost_poses_reversed > 0 {
            faults.push(format!("driven backwards the pair loses contact; {remedy}"));
        }
        if self.interference_in_modules() > self.allowed_interference
            && let Some(worst) = &summary.max_interference
        {
            faults.push(format!(
                "the gears overlap by {:.4} mm at {:.1} degrees; give more clearance or fewer teeth",
                worst.value,
                worst.driver_angle.to_degrees()
            ));
        }
        for (side, profile) in Side::BOTH.into_iter().zip(&self.finished) {
            if let Some(at) = geometry::first_self_crossing(&profile.points) {
                faults.push(format!(
                    "the outline of the {side} crosses itself at ({:.3}, {:.3}); try more teeth or less clearance",
                    at.x, at.y
                ));
            }
        }
        if self.error_share() > policy::WORST_TRANSMISSION_ERROR {
            faults.push(format!(
                "the transmission error reaches {:.0} % of a pitch; try more teeth or a lower --max-lean",
                100.0 * self.error_share()
            ));
        }
        faults
    }

    fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.error_share() > policy::GOOD_TRANSMISSION_ERROR {
            warnings.push(format!(
                "the transmission error reaches {:.1} % of a pitch in places (99th percentile)",
                100.0 * self.error_share()
            ));
        }
        if let Some(worst) = &self.contact.summary.max_pressure_angle
            && worst.value > policy::STEEP_PRESSURE_ANGLE
        {
            warnings.push(format!(
                "the working pressure angle reaches {:.0} degrees at {:.0} degrees of driver turn: with friction the pair may bind there",
                worst.value.to_degrees(),
                worst.driver_angle.to_degrees()
            ));
        }
        warnings
    }

    pub(super) fn finish(
        self,
        source: &Source<'_>,
        options: &DesignOptions,
        mut steps: Vec<String>,
    ) -> Result<Design, DesignError> {
        let mut warnings = self.warnings();
        let root = options
            .root_clearance
            .unwrap_or(TeethOptions::default().root_clearance * self.pair.module);
        let dedendum = options.addendum * self.pair.module + root;
        warnings.extend(feasibility::warnings(&self.centrodes, &self.pair, dedendum));
        if source.limited.shape > policy::LIMIT_WORTH_SAYING {
            steps.insert(0, format!(
                "bounds on lean and torque changed the pitch curves by {:.3} in the measure of E_s (lean {:.0} to {:.0} degrees)",
                source.limited.shape,
                source.limited.lean.0.to_degrees(),
                source.limited.lean.1.to_degrees()
            ));
        }
        let refinement = source.fit.as_ref().and_then(|fit| fit.refinement);
        if let Some(refinement) = refinement.filter(|r| r.after < r.before) {
            steps.insert(0, format!(
                "refined: the area by which pitch curves and drawings differ, with the weighted torque, went from {:.1} to {:.1} %",
                100.0 * refinement.before,
                100.0 * refinement.after
            ));
        }
        let rounded = self.rounding.shape - source.limited.shape;
        if rounded > policy::LIMIT_WORTH_SAYING {
            steps.push(format!(
                "corners too sharp for the teeth were rounded: {rounded:.3} in the measure of E_s"
            ));
        }
        if source.exact && !self.settings.exact {
            let strays = source.strays(&self.centrodes.transmission);
            steps.push(format!(
                "the motion was changed by up to {:.2} degrees of the follower so that teeth can follow it",
                strays.to_degrees()
            ));
        }
        let transmission = &self.centrodes.transmission;
        let teeth = [
            self.settings.teeth,
            self.settings.teeth * transmission.follower_fold() / transmission.driver_fold(),
        ];
        let curves = [
            self.centrodes.driver_curve(policy::PITCH_CURVE_POINTS),
            self.centrodes.follower_curve(policy::PITCH_CURVE_POINTS),
        ];
        let mut likeness = [None; 2];
        let mut gears = Vec::new();
        for (i, side) in Side::BOTH.into_iter().enumerate() {
            let input = source.drawings[i]
                .map_or_else(Vec::new, |d| placed_input(d.shape, &d.gear, &curves[i]));
            if let Some(drawn) = &source.drawings[i] {
                let share = geometry::intersection_over_union(&curves[i], &input);
                likeness[i] = Some(share);
                if share < policy::POOR_LIKENESS {
                    warnings.push(format!(
                        "the {side} keeps only {:.0} % of the likeness of {}: the shape is too thin or too deeply cut for a gear",
                        100.0 * share,
                        drawn.shape.name
                    ));
                }
                if drawn.gear.lost_area > policy::LOST_AREA_WORTH_SAYING {
                    warnings.push(format!(
                        "bays of {} that the {side}'s axis does not see are filled in, {:.1} % of its area; a shape with shallower bays keeps more",
                        drawn.shape.name,
                        100.0 * drawn.gear.lost_area
                    ));
                }
            }
            let outline = self.finished[i].points.clone();
            let bore = bore_for(options, &outline, &mut warnings, side.name())?;
            gears.push(Gear {
                name: side.to_string(),
                outline,
                bore,
                pitch_curve: curves[i].clone(),
                input,
                teeth: teeth[i],
                fittings: Fittings::default(),
            });
        }
        let periods = transmission.cycle_periods();
        let count = policy::MOTION_SAMPLES * periods as usize;
        let cycle = transmission.cycle();
        let driver_angle: Vec<f64> = (0..=count).map(|i| cycle * i as f64 / count as f64).collect();
        let follower_angle = driver_angle.iter().map(|&phi| -transmission.psi(phi)).collect();
        let axes = [Point::origin(), Point::new(self.centrodes.center_distance, 0.0)];
        let angles = [driver_angle.clone(), follower_angle];
        let gears = gears
            .into_iter()
            .zip(axes)
            .zip(angles)
            .map(|((gear, axis), angle)| placed_gear(gear, axis, angle))
            .collect();
        let faults = self.faults();
        let strength = strength(&Loaded {
            centrodes: &self.centrodes,
            profiles: [&self.finished[0], &self.finished[1]],
            module: self.pair.module,
            thickness: options.thickness,
            pressure_angle: options.pressure_angle,
            contact_ratio: self.contact.summary.contact_ratio,
            load: options.load,
        });
        Ok(Design {
            strength,
            names: source.names.clone(),
            options: options.clone(),
            assembly: Assembly {
                gears,
                driver_angle,
                thickness: options.thickness,
                meshes: vec![[0, 1]],
                axles: Vec::new(),
                fixtures: Vec::new(),
            },
            fit: source.fit.clone(),
            drawings: source.drawings.map(|d| d.map(|d| d.gear)),
            centrodes: self.centrodes,
            teeth,
            pair: self.pair,
            likeness,
            exact_contact: self.exact,
            contact: self.contact,
            proof: None,
            steps,
            warnings,
            faults,
            is_proved: false,
        })
    }
}

/// The pair with its follower carved literally: a disc less the driver at many instants, as solids.
fn carved_by_solids(
    centrodes: &Centrodes,
    pair: ToothedPair,
    options: &DesignOptions,
) -> Result<ToothedPair, DesignError> {
    let transmission = &centrodes.transmission;
    let widest = centrodes
        .follower_curve(policy::PITCH_CURVE_POINTS)
        .iter()
        .map(|p| p.coords.norm())
        .fold(0.0, f64::max);
    let blank = circle(widest + options.addendum * pair.module, policy::BORE_CHORD_TOLERANCE);
    let count = policy::SOLID_CARVING_POSES * transmission.cycle_periods();
    let cycle = transmission.cycle();
    let poses: Vec<(f64, f64)> = (0..count)
        .map(|i| cycle * f64::from(i) / f64::from(count))
        .map(|phi| (phi, transmission.psi(phi)))
        .collect();
    let carved = carve_follower_with_manifold(
        &pair.driver.points,
        &blank,
        centrodes.center_distance,
        &poses,
        options.thickness,
    )?;
    let follower = pair.follower.relabelled(carved.outline);
    Ok(ToothedPair { follower, ..pair })
}

/// Both gears with their clearance.
fn finished(pair: &ToothedPair, options: &DesignOptions) -> Result<[Profile; 2], DesignError> {
    if pair.loaded.is_some() {
        return Ok([pair.driver.clone(), pair.follower.clone()]);
    }
    let inset = |profile: &Profile| {
        profile
            .inset(options.clearance)
            .map(|p| p.without_short_edges(policy::SHORTEST_EDGE * pair.module))
            .ok_or(TeethError::NothingLeft { clearance: options.clearance })
    };
    Ok([inset(&pair.driver)?, inset(&pair.follower)?])
}

/// Contact at `poses` poses against the motion that the flanks were made for, and of the finished gears
/// against the designed motion. Poses of analyses that are `known` are kept.
fn analysed(
    known: Option<(ContactAnalysis, ContactAnalysis)>,
    poses: usize,
    centrodes: &Centrodes,
    pair: &ToothedPair,
    finished: &[Profile; 2],
    control: &Control,
) -> Result<(ContactAnalysis, ContactAnalysis), DesignError> {
    let (known_exact, known) = known.unzip();
    let module = pair.module;
    let found = contact(known, poses, centrodes, module, [&finished[0], &finished[1]], control)?;
    let exact = if let Some([behind, _]) = &pair.loaded {
        let t = &centrodes.transmission;
        found.against(&|phi| behind.psi(phi) - t.psi(phi))
    } else if pair.driver == finished[0] {
        found.clone()
    } else {
        // An inset gives the play of each flank its own swing, which is no error of its shape.
        let gears = [&pair.driver, &pair.follower];
        contact(known_exact, poses, centrodes, module, gears, control)?
    };
    Ok((exact, found))
}

/// Contact at `poses` poses; those of an analysis `known` with fewer are kept.
fn contact(
    known: Option<ContactAnalysis>,
    poses: usize,
    centrodes: &Centrodes,
    module: f64,
    [driver, follower]: [&Profile; 2],
    control: &Control,
) -> Result<ContactAnalysis, DesignError> {
    let transmission = &centrodes.transmission;
    let input = ContactInput {
        driver: &driver.points,
        follower: &follower.points,
        center_distance: centrodes.center_distance,
        module,
        motion: transmission,
        control,
    };
    let options = ContactOptions { poses, ..ContactOptions::default() };
    Ok(match known {
        Some(known) => known.refined(&input, &options)?,
        None => analyse(&input, &options)?,
    })
}
