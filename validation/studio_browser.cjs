// What both browser tests of the studio share: the server, the browser, and waiting for a stage.
const { spawn } = require("node:child_process");
const fs = require("node:fs");
const path = require("node:path");
const { chromium } = require("playwright-core");

const FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader", "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1"];

// Starts the program; resolves to its process and address.
const serve = (program, args, cwd) => new Promise((resolve, reject) => {
  const child = spawn(program, ["studio", "--no-open", ...args], { cwd });
  let said = "";
  child.stdout.on("data", (data) => {
    said += data;
    if (said.includes("\n")) resolve({ child, address: said.trim() });
  });
  child.stderr.on("data", (data) => { said += data; });
  child.on("exit", (code) => reject(new Error(`the studio ended with ${code}: ${said}`)));
});

const launch = (executablePath) => chromium.launch({ executablePath, args: FLAGS });

// Waits until the newest state has reached a stage.
const reached = (page, stage, ms = 120_000) => page.waitForFunction((wanted) => {
  const order = ["sized", "toothed", "analysed", "proven"];
  const { stage: now, settled } = document.documentElement.dataset;
  return settled === "yes" && order.indexOf(now) >= order.indexOf(wanted);
}, stage, { timeout: ms });

// With STUDIO_PAGE set, scripts and styles come from that folder instead of the program: for work on the page without a build.
const withPage = async (context) => {
  const folder = process.env.STUDIO_PAGE;
  if (!folder) return;
  const kinds = { ".js": "text/javascript", ".css": "text/css" };
  await context.route(/\.(js|css)$/, async (route) => {
    const file = path.join(folder, path.basename(new URL(route.request().url()).pathname));
    if (!fs.existsSync(file)) { await route.continue(); return; }
    await route.fulfill({ body: fs.readFileSync(file), contentType: kinds[path.extname(file)] });
  });
};

module.exports = { launch, reached, serve, withPage };
