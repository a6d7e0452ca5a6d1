//! What a whole cycle of contact poses amounts to.

use super::pose::ContactPose;

/// How far a quantity strays over a cycle. Poses with lost contact are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Median of the quantity itself.
    pub median: f64,
    /// Median distance from that median.
    pub median_deviation: f64,
    /// 99th percentile of the distance from that median.
    pub p99_deviation: f64,
    /// Greatest less smallest value.
    pub peak_to_peak: f64,
}

/// Driver angles over which contact is lost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LostArc {
    /// Where it begins, radians.
    pub from: f64,
    /// Where it ends, radians; above `from`, and past the cycle's end for an arc that holds its
    /// start.
    pub to: f64,
}

/// A value and the driver angle at which it occurs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPlace {
    /// The value.
    pub value: f64,
    /// Driver angle, radians.
    pub driver_angle: f64,
}

/// The figures of one contact analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSummary {
    /// Mean number of tooth pairs in contact over the poses that have contact; 0 without any.
    pub contact_ratio: f64,
    /// Least angular backlash of the follower, radians: play behind plus play ahead. Negative
    /// where both flanks interfere.
    pub min_backlash: Option<WorstPlace>,
    /// Greatest angular backlash, radians, over the poses with contact on both sides.
    pub max_backlash: Option<WorstPlace>,
    /// Transmission error under load, radians; `None` without any contact.
    pub transmission_error: Option<Deviation>,
    /// The same as arc at the pitch point, in pitches.
    pub transmission_error_pitch: Option<Deviation>,
    /// Transmission error with the load reversed (play ahead) as arc at the pitch point, in
    /// pitches.
    pub reversed_error_pitch: Option<Deviation>,
    /// Poses without contact under load.
    pub lost_poses: usize,
    /// Poses without contact under reversed load.
    pub lost_poses_reversed: usize,
    /// Where contact is lost under load.
    pub lost: Vec<LostArc>,
    /// Driver angle over which contact is lost under load, radians in all.
    pub lost_angle: f64,
    /// Deepest interference at the designed pose, mm; `None` when the gears never overlap.
    pub max_interference: Option<WorstPlace>,
    /// Greatest working pressure angle of a first contact, radians.
    pub max_pressure_angle: Option<WorstPlace>,
}

impl ContactSummary {
    /// Sums up poses sorted by driver angle within one cycle.
    pub(super) fn new(poses: &[ContactPose], driver_cycle: f64) -> Self {
        let loaded = || poses.iter().filter(|p| !p.lost);
        let counted = loaded().count();
        let pairs: usize = loaded().map(|p| p.contacts.len()).sum();
        let backlash = || {
            let both = poses.iter().filter(|p| !p.lost && !p.lost_reversed);
            both.map(|p| (p.driver_angle, p.play_behind + p.play_ahead))
        };
        let reversed = poses.iter().filter(|p| !p.lost_reversed);
        let pressure =
            loaded().filter_map(|p| p.contacts.first().map(|c| (p.driver_angle, c.pressure_angle)));
        let overlaps = poses.iter().map(|p| (p.driver_angle, p.interference));
        let lost = lost_arcs(poses, driver_cycle);
        Self {
            contact_ratio: pairs as f64 / counted.max(1) as f64,
            min_backlash: greatest(backlash().map(|(at, b)| (at, -b)))
                .map(|w| WorstPlace { value: -w.value, ..w }),
            max_backlash: greatest(backlash()),
            transmission_error: deviation(loaded().map(|p| p.transmission_error)),
            transmission_error_pitch: deviation(loaded().map(|p| p.transmission_error_pitch)),
            reversed_error_pitch: deviation(reversed.map(|p| p.play_ahead / p.pitch_angle)),
            lost_poses: poses.len() - counted,
            lost_poses_reversed: poses.iter().filter(|p| p.lost_reversed).count(),
            lost_angle: lost.iter().map(|arc| arc.to - arc.from).fold(0.0, |sum, arc| sum + arc),
            lost,
            max_interference: greatest(overlaps).filter(|worst| worst.value > 0.0),
            max_pressure_angle: greatest(pressure),
        }
    }

    /// The same with the transmission error under load of other poses.
    pub(super) fn with_errors_of(&self, poses: &[ContactPose]) -> Self {
        let loaded = || poses.iter().filter(|p| !p.lost);
        Self {
            transmission_error: deviation(loaded().map(|p| p.transmission_error)),
            transmission_error_pitch: deviation(loaded().map(|p| p.transmission_error_pitch)),
            ..self.clone()
        }
    }
}

fn greatest(values: impl Iterator<Item = (f64, f64)>) -> Option<WorstPlace> {
    values
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(driver_angle, value)| WorstPlace { value, driver_angle })
}

fn deviation(values: impl Iterator<Item = f64>) -> Option<Deviation> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let median = percentile(&values, 0.5)?;
    let peak_to_peak = values.last()? - values.first()?;
    let mut strays: Vec<f64> = values.iter().map(|v| (v - median).abs()).collect();
    strays.sort_by(f64::total_cmp);
    Some(Deviation {
        median,
        median_deviation: percentile(&strays, 0.5)?,
        p99_deviation: percentile(&strays, 0.99)?,
        peak_to_peak,
    })
}

/// Linear between the two nearest ranks.
fn percentile(sorted: &[f64], share: f64) -> Option<f64> {
    let rank = share * sorted.len().checked_sub(1)? as f64;
    let (low, high) = (sorted[rank.floor() as usize], sorted[rank.ceil() as usize]);
    Some(low + (high - low) * rank.fract())
}

/// Every run of lost poses, reaching half-way to its neighbours with contact.
fn lost_arcs(poses: &[ContactPose], driver_cycle: f64) -> Vec<LostArc> {
    let n = poses.len();
    let Some(start) = poses.iter().position(|p| !p.lost) else {
        return vec![LostArc { from: 0.0, to: driver_cycle }];
    };
    let angle = |i: usize| poses[i % n].driver_angle + driver_cycle * (i / n) as f64;
    let mut arcs: Vec<LostArc> = Vec::new();
    for i in start + 1..start + n {
        if !poses[i % n].lost {
            continue;
        }
        let to = 0.5 * (angle(i) + angle(i + 1));
        match arcs.last_mut() {
            Some(arc) if poses[(i - 1) % n].lost => arc.to = to,
            _ => arcs.push(LostArc { from: 0.5 * (angle(i - 1) + angle(i)), to }),
        }
    }
    arcs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(driver_angle: f64, lost: bool) -> ContactPose {
        ContactPose {
            driver_angle,
            play_behind: 0.0,
            play_ahead: 0.0,
            transmission_error: 0.0,
            transmission_error_pitch: 0.0,
            lost,
            lost_reversed: lost,
            contacts: Vec::new(),
            interference: 0.0,
            follower_radius: 1.0,
            pitch_angle: 1.0,
        }
    }

    #[test]
    fn a_lost_arc_may_run_through_the_start() {
        let lost = [true, false, true, true, false, true];
        let poses: Vec<_> =
            lost.iter().enumerate().map(|(i, &lost)| pose(i as f64 + 0.5, lost)).collect();
        let arcs = lost_arcs(&poses, 6.0);
        assert_eq!(arcs, [LostArc { from: 2.0, to: 4.0 }, LostArc { from: 5.0, to: 7.0 }]);
    }

    #[test]
    fn deviations_of_a_ramp() {
        let d = deviation((0..=100).map(f64::from)).unwrap();
        assert_eq!((d.median, d.median_deviation, d.peak_to_peak), (50.0, 25.0, 100.0));
        assert!((d.p99_deviation - 50.0).abs() < 1e-9);
        assert_eq!(deviation(std::iter::empty()), None);
    }
}
