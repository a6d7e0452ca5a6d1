//! Who may ask: a loopback host, this page's own origin, and whoever knows the token.

use axum::http::{HeaderMap, HeaderName, HeaderValue, header};

/// Bytes of the token: 128 bits that no other program can guess.
const TOKEN_BYTES: usize = 16;

/// What a request must show.
#[derive(Clone, Debug)]
pub(super) struct Guard {
    token: String,
    port: u16,
}

/// Why a request is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// The Host header names another machine, as after DNS rebinding.
    Host,
    /// The request comes from another page.
    Origin,
    /// The address does not hold the token.
    Token,
}

impl Guard {
    pub(super) fn new(token: String, port: u16) -> Self {
        Self { token, port }
    }

    pub(super) fn token(&self) -> &str {
        &self.token
    }

    /// The address of the page.
    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// Checks the headers and the first part of the path; returns the rest of the path.
    pub(super) fn admit<'a>(&self, headers: &HeaderMap, path: &'a str) -> Result<&'a str, Refusal> {
        let one = |name: HeaderName| {
            let mut all = headers.get_all(name).iter();
            let first = all.next().map(HeaderValue::as_bytes);
            // Two of them are one too many, whatever they say.
            if all.next().is_some() { Some(&b""[..]) } else { first }
        };
        let hosts = self.hosts();
        if !one(header::HOST).is_some_and(|h| hosts.iter().any(|known| known.as_bytes() == h)) {
            return Err(Refusal::Host);
        }
        if let Some(origin) = one(header::ORIGIN) {
            let own = origin.strip_prefix(b"http://").unwrap_or_default();
            if !hosts.iter().any(|known| known.as_bytes() == own) {
                return Err(Refusal::Origin);
            }
        }
        let site = headers.get("sec-fetch-site").map(HeaderValue::as_bytes);
        if !matches!(site, None | Some(b"same-origin" | b"none")) {
            return Err(Refusal::Origin);
        }
        let (token, rest) =
            path.strip_prefix('/').unwrap_or(path).split_once('/').unwrap_or_default();
        if same(token.as_bytes(), self.token.as_bytes()) { Ok(rest) } else { Err(Refusal::Token) }
    }

    fn hosts(&self) -> [String; 3] {
        ["127.0.0.1", "localhost", "[::1]"].map(|name| format!("{name}:{}", self.port))
    }
}

/// Compared in the same time wherever they differ.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |differ, (x, y)| differ | (x ^ y)) == 0
}

/// A token from the system's random numbers, in hexadecimal digits.
pub(super) fn random_token() -> anyhow::Result<String> {
    let mut bytes = [0; TOKEN_BYTES];
    getrandom::fill(&mut bytes)
        .map_err(|e| anyhow::anyhow!("the system gives no random numbers ({e}); try again"))?;
    Ok(bytes.iter().map(|b| format!("{b:02x}")).collect())
}

/// Whether a text has the form of a token.
pub(super) fn is_token(text: &str) -> bool {
    text.len() == 2 * TOKEN_BYTES && text.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f'))
}

/// Headers of every answer: nothing is loaded from elsewhere, kept, framed, or guessed.
pub(super) const HEADERS: [(HeaderName, &str); 7] = [
    (
        header::CONTENT_SECURITY_POLICY,
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; \
         connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::REFERRER_POLICY, "no-referrer"),
    (header::CACHE_CONTROL, "no-store"),
    (header::X_FRAME_OPTIONS, "DENY"),
    (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
];

#[cfg(test)]
mod tests {
    use super::*;

    const TOKEN: &str = "0123456789abcdef0123456789abcdef";

    fn asked(headers: &[(&str, &str)], path: &str) -> Result<String, Refusal> {
        let mut map = HeaderMap::new();
        for (name, value) in headers {
            map.append(
                HeaderName::from_bytes(name.as_bytes()).unwrap(),
                HeaderValue::from_str(value).unwrap(),
            );
        }
        Guard::new(TOKEN.to_owned(), 4827).admit(&map, path).map(str::to_owned)
    }

    #[test]
    fn the_page_itself_is_admitted() {
        let path = format!("/{TOKEN}/app.js");
        for host in ["127.0.0.1:4827", "localhost:4827", "[::1]:4827"] {
            assert_eq!(asked(&[("host", host)], &path), Ok("app.js".to_owned()));
            let origin = format!("http://{host}");
            assert_eq!(
                asked(&[("host", host), ("origin", &origin)], &path),
                Ok("app.js".to_owned())
            );
        }
    }

    #[test]
    fn other_hosts_origins_and_tokens_are_refused() {
        let path = format!("/{TOKEN}/");
        let own = ("host", "127.0.0.1:4827");
        assert_eq!(asked(&[], &path), Err(Refusal::Host));
        for host in ["evil.example", "127.0.0.1", "127.0.0.1:80", "localhost:4827.evil.example"] {
            assert_eq!(asked(&[("host", host)], &path), Err(Refusal::Host), "{host}");
        }
        assert_eq!(asked(&[own, own], &path), Err(Refusal::Host));
        for origin in
            ["null", "http://evil.example", "https://127.0.0.1:4827", "http://127.0.0.1:80"]
        {
            assert_eq!(asked(&[own, ("origin", origin)], &path), Err(Refusal::Origin), "{origin}");
        }
        for site in ["cross-site", "same-site"] {
            assert_eq!(asked(&[own, ("sec-fetch-site", site)], &path), Err(Refusal::Origin));
        }
        for path in ["", "/", "/app.js", "/0123/app.js", "//app.js", &path[..path.len() - 2]] {
            assert_eq!(asked(&[own], path), Err(Refusal::Token), "{path}");
        }
    }

    #[test]
    fn tokens_are_random_and_recognised() {
        let (a, b) = (random_token().unwrap(), random_token().unwrap());
        assert_ne!(a, b);
        assert!(
            is_token(&a) && !is_token(&a[1..]) && !is_token("../../../../../../../../../etc/a")
        );
    }

    #[test]
    fn no_inline_script_may_run() {
        let (_, policy) = &HEADERS[0];
        assert!(policy.contains("default-src 'none'") && !policy.contains("unsafe"));
    }
}
