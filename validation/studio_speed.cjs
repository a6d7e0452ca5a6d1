// See studio_speed.
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const { launch, reached, serve } = require("./studio_browser.cjs");

const [program, browserPath, drags, tabs] = process.argv.slice(2);
// What the page should keep, ms at the 95th percentile.
const AIMS = { "pitch curves": 40, teeth: 120, "contact verdict": 500, proof: 2500, "first picture": 400 };

const quantile = (list, q) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(q * list.length))];

const measure = async (browser, address) => {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  const times = { "pitch curves": [], teeth: [], "contact verdict": [], proof: [], "first picture": [] };
  await page.goto(address);
  await page.locator("#control-teeth").fill("48");
  await page.locator("#control-teeth").press("Enter");
  await reached(page, "proven");
  const asked = () => page.evaluate(() => performance.getEntriesByType("measure").map((m) => [m.name, m.duration]));
  const clear = () => page.evaluate(() => performance.clearMeasures());
  const axis = await page.locator(".card.driver .axis").boundingBox();
  const [x, y] = [axis.x + axis.width / 2, axis.y + axis.height / 2];
  await clear();
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let i = 0; i < Number(drags); i += 1) {
    await page.mouse.move(x + 6 * Math.sin(i * 0.5), y + 6 * Math.cos(i * 0.37));
    await page.waitForTimeout(110);
  }
  await page.mouse.up();
  for (const [name, ms] of await asked()) {
    if (name === "told-sized") times["pitch curves"].push(ms);
    if (name === "told-toothed") times.teeth.push(ms);
  }
  await reached(page, "proven");
  for (let i = 0; i < 6; i += 1) {
    await clear();
    await page.locator("#control-balance").fill(String(0.42 + 0.02 * i));
    await page.locator("#control-balance").press("Enter");
    await reached(page, "proven");
    for (const [name, ms] of await asked()) {
      if (name === "told-analysed") times["contact verdict"].push(ms);
      if (name === "told-proven") times.proof.push(ms);
    }
  }
  for (const number of [2, 8, 10, 12, 25]) {
    await clear();
    await page.locator(".card.driver .name").click();
    await page.locator(".shapes button").nth(number).click();
    await reached(page, "sized");
    const first = (await asked()).find(([name]) => name === "told-sized");
    if (first) times["first picture"].push(first[1]);
  }
  await page.locator("#control-teeth").fill("64");
  await page.locator("#control-teeth").press("Enter");
  await reached(page, "proven");
  const frames = await page.evaluate(() => new Promise((resolve) => {
    let count = 0;
    const start = performance.now();
    const step = (now) => { count += 1; if (now - start < 3000) requestAnimationFrame(step); else resolve((1000 * count) / (now - start)); };
    requestAnimationFrame(step);
  }));
  await context.close();
  return { times, frames };
};

const main = async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "studio-"));
  const { child, address } = await serve(program, [], folder);
  const browser = await launch(browserPath);
  const all = await Promise.all(Array.from({ length: Number(tabs) }, () => measure(browser, address)));
  const status = fs.readFileSync(`/proc/${child.pid}/status`, "utf8");
  console.log(`${tabs} tabs        median    95th     aim   (ms, ${drags} drags)`);
  for (const [name, aim] of Object.entries(AIMS)) {
    const list = all.flatMap((one) => one.times[name]);
    const cell = (v) => (v === undefined ? "-" : v.toFixed(0)).padStart(8);
    console.log(`${name.padEnd(16)}${cell(quantile(list, 0.5))}${cell(quantile(list, 0.95))}${cell(aim)}   n = ${list.length}`);
  }
  console.log(`frames a second while turning, 64 teeth: ${all.map((one) => one.frames.toFixed(0)).join(" ")} (drawn without a graphics card)`);
  console.log(`memory of the server: ${(Number(/VmHWM:\s+(\d+)/.exec(status)[1]) / 1024).toFixed(0)} MB at most, ${(Number(/VmRSS:\s+(\d+)/.exec(status)[1]) / 1024).toFixed(0)} MB now`);
  await browser.close();
  child.removeAllListeners("exit");
  child.kill();
  fs.rmSync(folder, { recursive: true, force: true });
};

main().catch((error) => { console.error(error); process.exit(1); });
