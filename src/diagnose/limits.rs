//! Where a pair fails, and where it deserves a warning.

use serde::{Deserialize, Serialize};

/// Limits of the judge. The defaults are for gears of any origin, whose teeth are known by their outlines alone;
/// [`Limits::of_design`] adds what is known of gears made here.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Limits {
    /// Driver pitches without contact in the contact analysis: fails; less warns. 0.1: facets and knocks of outlines of
    /// any origin leave short gaps.
    pub lost_arc: f64,
    /// Overlap at the designed pose, modules: fails. 0.01: past it the gears do not fit.
    pub overlap: f64,
    /// Transmission error peak to peak against psi, local pitches: fails. 0.25: half of what skips a tooth.
    pub transmission_error: f64,
    /// The same: warns. 0.08: seen by eye on gears of 24 teeth.
    pub noted_transmission_error: f64,
    /// Driver pitches in which the run loses contact: fails. 0.1.
    pub free_run: f64,
    /// The same: warns. 0.03.
    pub noted_free_run: f64,
    /// Windowed torque off psi' tau, in loads, of a run without friction: fails. 1: the load itself. With friction it
    /// warns, for binding is then told by the motor.
    pub torque_excess: f64,
    /// Penetration in a run, modules: fails. 0.05: five times what the contact of a sound pair leaves.
    pub penetration: f64,
    /// Net turn off psi, follower pitches: fails. 0.5: it has skipped a tooth.
    pub net_turn: f64,
    /// Distance of a follower driven at constant speed from the exact contact, radians: fails. 0.2 degrees: sixty times
    /// what sound pairs show.
    pub tracking: f64,
    /// Efficiency: warns below. 0.6.
    pub efficiency: f64,
    /// Limits on what only the maker of a pair knows; not judged without.
    pub made: Option<MadeLimits>,
}

/// Limits on a pair that was made here: its teeth are known without clearance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct MadeLimits {
    /// 99th percentile of the transmission error without clearance, pitches: fails. 0.25.
    pub tooth_error: f64,
    /// The same: warns, and gentler settings are tried. 0.02.
    pub noted_tooth_error: f64,
    /// Backlash, pitches: fails. 0.45: teeth so thin beside their gaps hold at their tips only.
    pub backlash: f64,
    /// The same: warns. 0.35.
    pub noted_backlash: f64,
    /// Working pressure angle, radians: warns. 70 degrees: with friction the pair may bind.
    pub pressure_angle: f64,
    /// Coefficient of friction at which the pair must not lock itself: warns. 0.25: dry PLA on itself.
    pub friction: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            lost_arc: 0.1,
            overlap: 0.01,
            transmission_error: 0.25,
            noted_transmission_error: 0.08,
            free_run: 0.1,
            noted_free_run: 0.03,
            torque_excess: 1.0,
            penetration: 0.05,
            net_turn: 0.5,
            tracking: 0.2_f64.to_radians(),
            efficiency: 0.6,
            made: None,
        }
    }
}

impl Default for MadeLimits {
    fn default() -> Self {
        Self {
            tooth_error: 0.25,
            noted_tooth_error: 0.02,
            backlash: 0.45,
            noted_backlash: 0.35,
            pressure_angle: 70_f64.to_radians(),
            friction: 0.25,
        }
    }
}

impl Limits {
    /// The limits for a pair made here: contact is never lost, and what overlaps is a ten-thousandth of a module.
    #[must_use]
    pub fn of_design() -> Self {
        let made = Some(MadeLimits::default());
        Self { lost_arc: 0.0, overlap: 1e-4, made, ..Self::default() }
    }

    /// Limits as TOML, by their names with hyphens; those left out keep their defaults.
    ///
    /// # Errors
    /// What is wrong, as half a sentence: a name that there is not, or a value that is no number of 0 or more.
    pub fn from_toml(text: &str) -> Result<Self, String> {
        let told = |e: toml::de::Error| crate::wording::quoted(e.message());
        let limits: Self = toml::from_str(text).map_err(told)?;
        let value = toml::Value::try_from(limits).map_err(|e| e.to_string())?;
        match bad_number(&value) {
            None => Ok(limits),
            Some((name, bad)) => Err(format!("{name} is {bad}; give a number of 0 or more")),
        }
    }
}

/// The first value that limits nothing, with its name.
fn bad_number(value: &toml::Value) -> Option<(String, f64)> {
    value.as_table()?.iter().find_map(|(name, value)| match value {
        toml::Value::Float(number) => {
            (!number.is_finite() || *number < 0.0).then(|| (name.clone(), *number))
        }
        inner => bad_number(inner),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_may_set_some_of_them() {
        let read: Limits =
            serde_json::from_str(r#"{"efficiency": 0.5, "made": {"backlash": 0.4}}"#).unwrap();
        assert_eq!((read.efficiency, read.overlap), (0.5, Limits::default().overlap));
        assert_eq!(read.made.unwrap().backlash, 0.4);
        assert!(serde_json::from_str::<Limits>(r#"{"eficiency": 0.5}"#).is_err());
    }

    #[test]
    fn a_toml_file_is_told_what_is_wrong_in_it() {
        let read = Limits::from_toml("overlap = 0.02\n[made]\nbacklash = 0.4\n").unwrap();
        assert_eq!((read.overlap, read.made.unwrap().backlash), (0.02, 0.4));
        assert_eq!(Limits::from_toml(""), Ok(Limits::default()));
        for (text, said) in [
            ("overlp = 1.0", "overlp"),
            ("overlap = -1.0", "overlap is -1"),
            ("overlap = nan", "overlap is NaN"),
            ("[made]\nfriction = inf", "friction is inf"),
            ("overlap = \"much\"", "string"),
        ] {
            let error = Limits::from_toml(text).unwrap_err();
            assert!(error.contains(said), "{text}: {error}");
        }
    }
}
