//! What a person and a program are told of results: lines, figures, tables and pages. Nothing here prints or writes.

mod bare;
mod design;
mod runs;

pub use bare::bare_page;
pub use design::{design_figures, design_lines, design_page};
pub use runs::{
    RUN_TABLES, contacts as run_contacts, lines as run_lines, plots as run_plots,
    sections as run_sections, table_name,
};

/// Findings as whole sentences, one after another.
pub(crate) fn in_sentences(told: &[String]) -> String {
    let sentence = |text: &String| {
        let mut letters = text.chars();
        let first = letters.next().map(char::to_uppercase).into_iter().flatten();
        first.chain(letters).chain(['.']).collect::<String>()
    };
    told.iter().map(sentence).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::in_sentences;

    #[test]
    fn findings_side_by_side_read_as_sentences() {
        let told = ["contact is lost; give less".to_owned(), "öl fehlt".to_owned()];
        assert_eq!(in_sentences(&told), "Contact is lost; give less. Öl fehlt.");
        assert_eq!(in_sentences(&[]), "");
    }
}
