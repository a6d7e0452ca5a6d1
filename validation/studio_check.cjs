// See studio_check.
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const { launch, reached, serve, withPage } = require("./studio_browser.cjs");

const [program, browserPath, pictures] = process.argv.slice(2);
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "studio-"));
const drawings = path.join(__dirname, "../scenes/shapes");
let passed = 0;
const failed = [];
const check = async (name, work) => {
  try {
    await work();
    passed += 1;
    console.log(`ok    ${name}`);
  } catch (error) {
    failed.push(name);
    console.log(`FAIL  ${name}: ${String(error.message).split("\n")[0]}`);
  }
};
const must = (fact, text) => { if (!fact) throw new Error(text); };

// Texts whose colour is too near to that of their ground; runs in the page.
const weakTexts = () => {
  const channels = (text) => { const m = /rgba?\(([\d.]+), ([\d.]+), ([\d.]+)(?:, ([\d.]+))?\)/.exec(text); return m ? [Number(m[1]), Number(m[2]), Number(m[3]), m[4] === undefined ? 1 : Number(m[4])] : [0, 0, 0, 0]; };
  const over = (top, under) => [0, 1, 2].map((i) => top[i] * top[3] + under[i] * (1 - top[3]));
  const light = (rgb) => { const [r, g, b] = rgb.map((v) => { const s = v / 255; return s <= 0.03928 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4; }); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const ground = (node) => {
    if (!node) return [255, 255, 255];
    const own = channels(getComputedStyle(node).backgroundColor);
    return own[3] === 1 ? own.slice(0, 3) : over(own, ground(node.parentElement));
  };
  const weak = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let text = walker.nextNode(); text; text = walker.nextNode()) {
    const node = text.parentElement;
    if (!text.textContent.trim() || !node.checkVisibility({ visibilityProperty: true }) || node.closest(":disabled, .barred, noscript, script")) continue;
    const under = ground(node);
    const [a, b] = [light(over(channels(getComputedStyle(node).color), under)), light(under)];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < 4.5) weak.push(`"${text.textContent.trim().slice(0, 30)}" ${ratio.toFixed(2)}`);
  }
  return weak;
};

const main = async () => {
  let { child, address } = await serve(program, ["-o", "out"], folder);
  const { port } = new URL(address);
  const browser = await launch(browserPath);
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true });
  await withPage(context);
  const page = await context.newPage();
  const errors = [];
  const foreign = [];
  let expectBreak = false;
  page.on("console", (m) => { if (["error", "warning"].includes(m.type()) && !expectBreak) errors.push(m.text()); });
  page.on("pageerror", (e) => errors.push(e.message));
  page.on("request", (r) => { if (!/^(blob:|data:)/.test(r.url()) && !r.url().startsWith(address)) foreign.push(r.url()); });
  await page.addInitScript(() => {
    // Counts how often the view of the stage moves by itself.
    window.addEventListener("securitypolicyviolation", (e) => console.error(`policy: ${e.violatedDirective}`));
  });
  const picture = async (name) => { if (pictures) await page.screenshot({ path: path.join(pictures, `${name}.png`) }); };
  const state = () => page.evaluate(() => JSON.parse(localStorage.getItem("centrode-studio")));
  const option = async (key) => (await state()).options[key];
  const drop = async (files, share) => {
    const data = await page.evaluateHandle((given) => {
      const transfer = new DataTransfer();
      for (const { name, text } of given) transfer.items.add(new File([text], name));
      return transfer;
    }, files.map((f) => ({ name: path.basename(f), text: fs.readFileSync(f, "utf8") })));
    const box = await page.locator(".stage").boundingBox();
    const at = { clientX: box.x + box.width * share, clientY: box.y + box.height / 2, dataTransfer: data };
    for (const type of ["dragenter", "dragover", "drop"]) await page.dispatchEvent(".stage", type, at);
  };

  await page.goto(address);
  await check("the page opens on a pair that is proven", async () => { await reached(page, "proven"); await picture("pair"); });
  await check("two files are dropped and become a pair", async () => {
    await drop([path.join(drawings, "fish.svg"), path.join(drawings, "butterfly.svg")], 0.25);
    await page.waitForFunction(() => document.title.startsWith("fish and butterfly"));
    await reached(page, "proven");
    const { driver, follower } = await state();
    must(driver.id && follower.id && driver.name === "fish.svg", "the state does not name the files");
  });
  await check("an axis is dragged and the pair follows", async () => {
    const axis = await page.locator(".card.driver .axis").boundingBox();
    const before = await page.locator(".card.driver .axis").getAttribute("transform");
    await page.mouse.move(axis.x + axis.width / 2, axis.y + axis.height / 2);
    await page.mouse.down();
    for (let i = 1; i <= 8; i += 1) await page.mouse.move(axis.x + axis.width / 2 + i, axis.y + axis.height / 2 + i / 2);
    await page.mouse.up();
    await reached(page, "analysed");
    must(await page.locator(".card.driver .axis").getAttribute("transform") !== before, "the axis did not move");
    must(await option("driver-axis") && await option("follower-axis"), "the axes are not held");
  });
  await check("one undo takes the drag back, one redo brings it", async () => {
    await page.keyboard.press("Control+z");
    must(!(await option("driver-axis")), "still held");
    await page.keyboard.press("Control+Shift+z");
    must(await option("driver-axis"), "not held again");
    await page.keyboard.press("Control+z");
    await reached(page, "sized");
  });
  await check("a decimal comma is a number, and what is none is refused beside the control", async () => {
    const field = page.locator("#control-clearance");
    await field.fill("0,12");
    await field.press("Enter");
    must(await option("clearance") === "0.12", `clearance is ${await option("clearance")}`);
    await field.fill("much");
    await field.press("Enter");
    // The answer to the number before must not take the reason away.
    await reached(page, "analysed");
    must(await page.locator("[data-key=clearance] .why").isVisible(), "no reason is given");
    must(await option("clearance") === "0.12", "the state took it");
    await page.locator("[data-key=clearance] .reset").click();
    must((await option("clearance")) === undefined, "not back to default");
  });
  await check("a control of every group changes the state and goes back to its default", async () => {
    const groups = await page.locator("details.group").count();
    must(groups >= 6, `${groups} groups`);
    for (let i = 0; i < groups; i += 1) {
      const group = page.locator("details.group").nth(i);
      await group.locator("summary").click();
      const control = group.locator(".control").filter({ has: page.locator("input[type=range], select, input[type=checkbox]") }).filter({ hasNot: page.locator(":disabled:not(.reset)") }).first();
      const key = await control.getAttribute("data-key");
      const slider = control.locator("input[type=range]");
      if (await slider.count()) { await slider.focus(); await slider.press("ArrowRight"); }
      else if (await control.locator("select").count()) await control.locator("select").selectOption({ index: 1 });
      else await control.locator("input[type=checkbox]").check();
      must((await option(key)) !== undefined, `${key} did not change`);
      await control.locator(".reset").click();
      must((await option(key)) === undefined, `${key} did not go back`);
      await group.locator("summary").click();
    }
  });
  await check("what cannot be made says why beside its control, with a remedy", async () => {
    const field = page.locator("#control-max-torque");
    await field.fill("0.5");
    await field.press("Enter");
    await page.locator("[data-key=max-torque] .why:not([hidden])").waitFor({ timeout: 20_000 });
    await page.locator(".finding .actions button").first().click();
    must(Number(await option("max-torque")) > 1, "the remedy was not taken");
    await page.keyboard.press("Control+z");
    await page.keyboard.press("Control+z");
    await reached(page, "proven");
  });
  await check("a finding with a place turns the gears there and zooms in", async () => {
    const go = page.locator(".finding .go").first();
    if (!(await go.count())) { console.log("      (this pair has none)"); return; }
    await go.click();
    await page.waitForTimeout(600);
    must(await page.locator(".transport .play").getAttribute("aria-label") === "Play", "still turning");
    await picture("finding");
    await page.keyboard.press("f");
  });
  await check("the zip holds the bytes that the command line writes", async () => {
    await page.locator("#bar button.primary").click();
    await page.waitForSelector(".dialog pre:not(:empty)");
    await picture("away");
    const [download] = await Promise.all([page.waitForEvent("download", { timeout: 120_000 }), page.locator(".dialog footer .primary").click()]);
    const zip = path.join(folder, "pair.zip");
    await download.saveAs(zip);
    await page.keyboard.press("Escape");
    execFileSync("python3", ["-m", "zipfile", "-e", zip, path.join(folder, "zip")]);
    for (const name of ["fish.svg", "butterfly.svg"]) fs.copyFileSync(path.join(drawings, name), path.join(folder, name));
    execFileSync(program, ["design", "fish.svg", "butterfly.svg", "-o", "line", "-q"], { cwd: folder });
    const files = fs.readdirSync(path.join(folder, "line"));
    for (const name of files.filter((f) => f !== "report.html" && !f.startsWith("simulation"))) {
      const [a, b] = ["zip", "line"].map((d) => fs.readFileSync(path.join(folder, d, name)));
      must(a.equals(b), `${name} differs`);
    }
    must(files.length > 8, "too few files");
  });
  await check("files are written to the folder and nowhere else", async () => {
    const before = fs.readdirSync(folder).sort().join();
    await page.locator("#bar button.primary").click();
    await page.locator(".dialog footer button:not(.primary)").click();
    await page.waitForFunction(() => /files in/.test(document.querySelector(".dialog footer")?.textContent), null, { timeout: 120_000 });
    await page.keyboard.press("Escape");
    must(fs.existsSync(path.join(folder, "out/design.json")), "nothing in the folder");
    const now = fs.readdirSync(folder).filter((f) => f !== "out").sort().join();
    must(now === before.split(",").filter((f) => f !== "out").join(), `beside it: ${now}`);
  });
  await check("a reload restores state, drawings and undo", async () => {
    const before = JSON.stringify(await state());
    await page.reload();
    await reached(page, "proven");
    must(JSON.stringify(await state()) === before, "another state");
    must(await page.locator("[aria-label=Undo]").isEnabled(), "nothing to undo");
  });
  await check("killed and started again, the page goes on, its drawings with it", async () => {
    expectBreak = true;
    child.removeAllListeners("exit");
    child.kill("SIGKILL");
    await page.waitForSelector(".offline:not([hidden])");
    ({ child } = await serve(program, ["-o", "out", "--port", port], folder));
    await page.waitForSelector(".offline", { state: "hidden", timeout: 20_000 });
    await page.locator("#control-center-distance").fill("90");
    await page.locator("#control-center-distance").press("Enter");
    await page.waitForFunction(() => document.querySelector(".figures-table").textContent.includes("90.00 mm"), null, { timeout: 60_000 });
    expectBreak = false;
  });
  await check("swap and mirror", async () => {
    await page.locator(".swap").click();
    must((await state()).driver.name === "butterfly.svg", "not swapped");
    await page.locator(".card.driver [aria-label^=Mirror]").click();
    await page.waitForFunction(() => document.title.startsWith("butterfly-mirrored"));
    await reached(page, "sized");
  });
  await check("keyboard alone: a shape is chosen, an axis moved, the gears turned", async () => {
    await page.locator(".card.driver .name").focus();
    await page.keyboard.press("Enter");
    await page.locator(".shapes button").nth(8).focus();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Enter");
    await reached(page, "sized");
    const name = (await state()).driver.name;
    must(name !== "butterfly-mirrored.csv", "the same shape");
    await page.locator(".card.driver .axis").focus();
    await page.keyboard.press("ArrowUp");
    must(await option("driver-axis"), "the axis did not move");
    await page.locator(".stage > canvas").focus();
    const angle = () => page.locator(".transport input").inputValue();
    await page.keyboard.press("ArrowRight");
    const before = Number(await angle());
    await page.keyboard.press("ArrowRight");
    must(Math.abs(Number(await angle()) - before - 1) < 0.3, "the gears did not turn by a degree");
  });
  await check("a motion typed as a formula, a motion drawn, and one shape", async () => {
    await page.locator(".ways button").nth(2).click();
    await reached(page, "proven");
    await picture("motion");
    await page.locator("#law").fill("1 + 0.2*cos(3*phi)");
    await page.locator("#law").blur();
    await reached(page, "analysed");
    const box = await page.locator(".law canvas").boundingBox();
    await page.mouse.click(box.x + box.width * 0.4, box.y + box.height * 0.3);
    must(/cos/.test((await state()).law) && (await state()).law !== "1 + 0.2*cos(3*phi)", "the curve makes no formula");
    await reached(page, "sized");
    await page.locator(".ways button").nth(1).click();
    await reached(page, "analysed");
    await page.locator(".ways button").nth(0).click();
  });
  await check("a remedy is one click and one undo", async () => {
    const before = JSON.stringify(await state());
    // So many teeth that some are undercut or warned of.
    await page.locator("#control-teeth").fill("9");
    await page.locator("#control-teeth").press("Enter");
    await reached(page, "analysed");
    const remedy = page.locator(".finding .actions button", { hasText: "→" }).first();
    if (await remedy.count()) {
      const with9 = JSON.stringify(await state());
      await remedy.click();
      must(JSON.stringify(await state()) !== with9, "the remedy changed nothing");
      await page.keyboard.press("Control+z");
      must(JSON.stringify(await state()) === with9, "undo did not take it back");
    } else console.log("      (this pair needs none)");
    await page.keyboard.press("Control+z");
    must(JSON.stringify(await state()) === before, "undo did not come back");
  });
  await check("a train: gears are added, laid and dragged, collisions show, and its files are those of the command line", async () => {
    await page.locator(".ways button").nth(2).click();
    await reached(page, "proven");
    await page.locator(".stage .tabs button").nth(3).click();
    const stands = () => page.waitForFunction(() => document.querySelector(".train").dataset.asked === "yes", null, { timeout: 60_000 });
    await stands();
    const lay = async (layout) => { await page.locator(`.train [data-layout=${layout}]`).click(); await stands(); };
    await lay("zigzag");
    await page.locator(".train .strip .primary").click();
    await stands();
    must(await page.locator(".train .chip").count() === 5, "no fifth gear");
    await picture("train");
    const [download] = await Promise.all([page.waitForEvent("download", { timeout: 120_000 }), page.locator(".train .strip button", { hasText: "zip" }).click()]);
    await download.saveAs(path.join(folder, "train.zip"));
    execFileSync("python3", ["-m", "zipfile", "-e", path.join(folder, "train.zip"), path.join(folder, "train")]);
    fs.mkdirSync(path.join(folder, "own"));
    fs.copyFileSync(path.join(folder, "train/design.json"), path.join(folder, "own/design.json"));
    execFileSync(program, ["train", "own", "--layout", "zigzag", "--gears", "5", "-o", "rows"], { cwd: folder });
    for (const name of fs.readdirSync(path.join(folder, "rows"))) {
      const [a, b] = ["train", "rows"].map((d) => fs.readFileSync(path.join(folder, d, name)));
      must(a.equals(b), `${name} differs`);
    }
    // The third gear is dragged round the second one, onto the first.
    await lay("straight");
    const pause = page.locator(".transport .play[aria-label=Pause]");
    if (await pause.count()) await pause.click();
    const at = await page.locator(".train").evaluate((node) => JSON.parse(node.dataset.axes));
    const [[x1, y1], [x2, y2], [x3, y3]] = at;
    const box = await page.locator(".train canvas").boundingBox();
    await page.mouse.move(box.x + x3, box.y + y3);
    await page.mouse.down();
    for (let i = 1; i <= 12; i += 1) {
      const turn = (Math.PI * 0.9 * i) / 12;
      await page.mouse.move(box.x + x2 + (x3 - x2) * Math.cos(turn), box.y + y2 - (x3 - x2) * Math.sin(turn));
    }
    await page.mouse.up();
    await stands();
    must(await page.locator(".train .status.bad").isVisible(), "no collision is told");
    must((await state()).train.layout === "free" && Math.hypot(x1 - x2, y1 - y2) > 10, "not put by hand");
    await picture("collision");
    await page.keyboard.press("Control+z");
    await stands();
    must(!(await page.locator(".train .status.bad").count()), "undo did not take the drag back");
    await page.locator(".stage .tabs button").nth(0).click();
  });
  await check("a design.json opens as the pair that it records", async () => {
    await page.locator("input[type=file][accept*=toml]").setInputFiles(path.join(folder, "line/design.json"));
    await page.waitForFunction(() => document.title.startsWith("fish and butterfly"));
    await reached(page, "proven");
    must(await option("driver-axis"), "its axes are not held");
    expectBreak = true;
    await page.locator("input[type=file][accept*=toml]").setInputFiles(path.join(drawings, "fish.svg"));
    await page.waitForSelector(".toast.bad");
    expectBreak = false;
  });
  await check("text stands out from its ground in both themes (WCAG AA, 4.5 to 1)", async () => {
    for (const theme of ["light", "dark"]) {
      if (await page.evaluate(() => document.documentElement.dataset.theme) !== theme) await page.locator("[aria-label='Dark or light']").click();
      await page.waitForTimeout(400);
      const weak = await page.evaluate(weakTexts);
      must(!weak.length, `${theme}: ${weak.slice(0, 3).join("; ")}`);
    }
  });
  await check("dark, and a tablet", async () => {
    if (await page.evaluate(() => document.documentElement.dataset.theme) !== "dark") await page.locator("[aria-label='Dark or light']").click();
    await reached(page, "proven");
    await picture("dark");
    await page.setViewportSize({ width: 1024, height: 768 });
    await page.waitForTimeout(300);
    await picture("tablet");
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    must(wide <= 1024, `the page is ${wide} wide`);
  });
  await check("two tabs do not disturb each other", async () => {
    const before = await page.title();
    const second = await context.newPage();
    await second.goto(`${address}#`);
    await second.locator(".card.driver .name").click();
    await second.locator(".shapes button").first().click();
    await reached(second, "sized");
    must(await page.title() === before, "the first tab changed");
    await second.close();
  });
  await check("no request leaves this machine", async () => must(!foreign.length, foreign[0]));
  await check("nothing in the console", async () => must(!errors.length, errors[0]));
  await browser.close();
  child.removeAllListeners("exit");
  child.kill();
  fs.rmSync(folder, { recursive: true, force: true });
  console.log(`${passed} passed, ${failed.length} failed`);
  process.exit(failed.length ? 1 : 0);
};

main().catch((error) => { console.log(`FAIL  ${error.message}`); process.exit(1); });
