//! The verdicts as a JUnit report, which build servers show pair by pair.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use anyhow::Context;
use centrode::diagnose::{Severity, sentences};
use centrode::export::write_atomically;

use super::super::files::told_of;
use super::Case;

/// Writes the report whole.
pub(super) fn write(path: &Path, cases: &[Case]) -> anyhow::Result<()> {
    let text = text(cases).context("the report cannot be laid out")?;
    write_atomically(path, |out| out.write_all(text.as_bytes()))
        .map_err(|error| told_of("--junit", error))
}

fn text(cases: &[Case]) -> Result<String, std::fmt::Error> {
    let failures = cases.iter().filter(|c| c.made.is_ok() && !c.is_sound()).count();
    let errors = cases.iter().filter(|c| c.made.is_err()).count();
    let (count, time) = (cases.len(), cases.iter().map(|c| c.seconds).sum::<f64>());
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    writeln!(
        xml,
        r#"<testsuites tests="{count}" failures="{failures}" errors="{errors}" time="{time:.3}">"#
    )?;
    writeln!(
        xml,
        r#"<testsuite name="centrode check" tests="{count}" failures="{failures}" errors="{errors}" time="{time:.3}">"#
    )?;
    for case in cases {
        let name = escaped(&format!("{} and {}", case.driver, case.follower));
        let open = format!(
            r#"<testcase classname="centrode.check" name="{name}" time="{:.3}">"#,
            case.seconds
        );
        writeln!(xml, "{open}")?;
        match &case.made {
            Err(why) => writeln!(xml, r#"<error message="{0}">{0}</error>"#, escaped(why))?,
            Ok(report) => {
                let told = |severity| escaped(&sentences(&report.diagnostics, severity).join("\n"));
                let faults = told(Severity::Fault);
                if !case.is_sound() {
                    let label = report.verdict().label();
                    writeln!(xml, r#"<failure message="{label}">{faults}</failure>"#)?;
                }
                let warnings = told(Severity::Warning);
                if !warnings.is_empty() {
                    writeln!(xml, "<system-out>{warnings}</system-out>")?;
                }
            }
        }
        writeln!(xml, "</testcase>")?;
    }
    writeln!(xml, "</testsuite>\n</testsuites>")?;
    Ok(xml)
}

/// Text as XML takes it: marked characters escaped, control characters but line ends as blanks.
fn escaped(text: &str) -> String {
    let plain = |c: char| if c.is_control() && c != '\n' { ' ' } else { c };
    let text: String = text.chars().map(plain).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_that_could_not_be_judged_is_an_error_and_names_are_escaped() {
        let case = Case {
            driver: "a<b>&\"\u{1}".to_owned(),
            follower: "c".to_owned(),
            seconds: 0.5,
            made: Err("no file".to_owned()),
        };
        let xml = text(&[case]).unwrap();
        assert!(xml.contains(r#"name="a&lt;b&gt;&amp;&quot;  and c""#), "{xml}");
        assert!(xml.contains(r#"errors="1""#) && xml.contains(r#"failures="0""#), "{xml}");
        assert!(xml.contains(r#"<error message="no file">"#), "{xml}");
        assert!(roxml(&xml));
    }

    /// Whether an XML parser takes it.
    fn roxml(xml: &str) -> bool {
        usvg::roxmltree::Document::parse(xml).is_ok()
    }
}
