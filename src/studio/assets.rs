//! The page, embedded in the program.

/// Files of the page: name, kind, content.
macro_rules! page {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("page/", $name)))),*]
    };
}

const FILES: &[(&str, &str)] = page! {
    "index.html"
    "base.css"
    "stage.css"
    "panels.css"
    "icon.svg"
    "app.js"
    "alternatives.js"
    "away.js"
    "controls.js"
    "curves.js"
    "dom.js"
    "drawings.js"
    "findings.js"
    "icons.js"
    "keys.js"
    "law.js"
    "link.js"
    "numbers.js"
    "pencil.js"
    "photo.js"
    "picker.js"
    "plots.js"
    "shelf.js"
    "stage.js"
    "solid.js"
    "store.js"
    "tabs.js"
    "train.js"
    "texts.js"
    "theme.js"
    "transport.js"
};

/// Content and kind of a file of the page.
pub(super) fn find(name: &str) -> Option<(&'static str, &'static str)> {
    let name = if name.is_empty() { "index.html" } else { name };
    let (known, content) = FILES.iter().find(|(known, _)| *known == name)?;
    let kind = match known.rsplit('.').next() {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => "text/javascript; charset=utf-8",
    };
    Some((content, kind))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_loads_nothing_from_elsewhere_and_has_no_inline_script() {
        for (name, content) in FILES {
            for word in ["http:", "https:", "//cdn", "@import", "eval(", "innerHTML"] {
                let content = content.replace("http://www.w3.org/", "");
                assert!(!content.contains(word), "{name} has {word}");
            }
        }
        let (index, kind) = find("").unwrap();
        assert!(kind.starts_with("text/html"));
        assert!(index.contains("<script type=\"module\" src=\"app.js\"></script>"));
        assert!(!index.contains("style=") && !index.contains(" onclick"));
        assert_eq!(index.matches("<script").count(), 1);
    }

    #[test]
    fn every_module_that_is_imported_is_there() {
        for (name, content) in FILES.iter().filter(|(name, _)| name.ends_with(".js")) {
            for part in content.split(" from \"./").skip(1) {
                let module = part.split('"').next().unwrap();
                assert!(find(module).is_some(), "{name} imports {module}");
            }
        }
    }

    #[test]
    fn nothing_else_is_found() {
        for name in ["../mod.rs", "page/app.js", "/etc/passwd", "app.js/", "APP.JS"] {
            assert!(find(name).is_none(), "{name}");
        }
    }
}
