//! The contact sheet: one page on which every pair turns, sorted and filtered by its reader.

use serde_json::{Value, json};

use super::{Figures, Row};
use crate::policy;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");
const BODY: &str = include_str!("page.html");

/// The page, complete in one file; pairs link to their folders beside it.
#[must_use]
pub fn gallery_html(rows: &[Row]) -> String {
    let data = json!({
        "grid": policy::GALLERY_GRID,
        "rows": rows.iter().map(thin).collect::<Vec<_>>(),
    });
    // A closing tag or a comment inside a text would end the script.
    let data = data.to_string().replace('<', "\\u003c");
    BODY.replace("/*style*/", STYLE)
        .replace("/*version*/", env!("CARGO_PKG_VERSION"))
        .replace("/*script*/", SCRIPT)
        .replace("/*data*/", &data)
}

/// What the page needs of a row, in short.
fn thin(row: &Row) -> Value {
    let rounded = |v: f64| (1e4 * v).round() / 1e4;
    let figures = row.figures.as_ref();
    let number = |f: &dyn Fn(&Figures) -> f64| figures.map(|g| rounded(f(g)));
    json!({
        "d": row.driver,
        "f": row.follower,
        "k": row.ratio,
        "v": row.verdict,
        "e": number(&|g| g.e),
        "q": number(&|g| g.torque),
        "i": figures.map(|g| g.iou.map(rounded)),
        "t": figures.and_then(|g| g.teeth),
        "r": row.remarks,
        "at": row.folder,
        "p": row.thumbnail.as_ref().map(|t| json!({
            "o": t.outlines, "n": t.inputs, "r": t.reach, "f": t.folds, "m": t.motion,
        })),
    })
}

#[cfg(test)]
mod tests {
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn texts_cannot_end_the_script() {
        let page = gallery_html(&[row("a", Some(0.3)), row("<b>", None)]);
        assert_eq!(page.matches("</script>").count(), 2);
        assert!(!page.contains("<b>") && !page.contains("/*"), "every mark is filled in");
    }
}
