//! The record of a run as a table.

use super::run::Dynamics;
use std::io::{self, Write};

/// Writes one line per step after a heading; angles in radians, torque in N mm, work in N mm
/// (mJ), lengths in mm. Twelve significant digits; a contact angle that is not known is empty.
///
/// # Errors
/// Whatever `out` reports.
pub fn write_csv(run: &Dynamics, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "driver_angle,follower_angle,psi,contact_angle,transmission_error,tracking_error,\
         driver_torque,driver_torque_windowed,driver_torque_ideal,contacts,penetration,lost,\
         work_in,work_out"
    )?;
    for s in &run.steps {
        let contact = s.contact_angle.map_or_else(String::new, |a| format!("{a:.12}"));
        let tracking = s.tracking_error().map_or_else(String::new, |a| format!("{a:.6e}"));
        writeln!(
            out,
            "{:.12},{:.12},{:.12},{contact},{:.6e},{tracking},{:.6e},{:.6e},{:.6e},{},{:.3e},{},{:.6e},{:.6e}",
            s.driver_angle,
            s.follower_angle,
            s.psi,
            s.transmission_error(),
            s.driver_torque,
            s.windowed_torque,
            s.ideal_torque,
            s.contacts,
            s.penetration,
            u8::from(s.lost),
            s.work_in,
            s.work_out,
        )?;
    }
    Ok(())
}
