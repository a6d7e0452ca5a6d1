# Finds the program, a browser, and the library that drives it. Sourced with `here` set; sets `centrode` and `chromium`.
version=1.65.1
centrode=${1:-$here/../target/release/centrode}
if [ ! -x "$centrode" ]; then
    echo "no program at $centrode; build it with: cargo build --release" >&2
    exit 2
fi

centrode=$(realpath "$centrode")
chromium=
for name in chromium chromium-browser google-chrome google-chrome-stable; do
    chromium=$(command -v "$name") && break
done
if [ -z "$chromium" ] || ! command -v node > /dev/null || ! command -v npm > /dev/null; then
    echo "studio: not tried; install node, npm and chromium"
    exit 3
fi
if [ ! -d "$here/.npm/node_modules/playwright-core" ]; then
    npm install --silent --no-fund --no-audit --prefix "$here/.npm" "playwright-core@$version" >&2 || {
        echo "studio: not tried; npm could not fetch playwright-core"
        exit 3
    }
fi
