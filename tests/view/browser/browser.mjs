// What the scripts share: Chromium, a page whose every complaint fails, and comparisons.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { chromium } from "playwright-core";

const FLAGS = ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];

export const launch = (executablePath) => chromium.launch({ executablePath, args: FLAGS });

/// Opens an address. The result has `complaints`, which must stay empty.
export const opened = async (browser, address, options = {}) => {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.complaints = [];
  page.on("console", (message) => message.type() === "error" && page.complaints.push(message.text()));
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("dialog", (dialog) => { page.complaints.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  await page.goto(address);
  await page.waitForFunction(() => { const { ready, error } = document.getElementById("view").dataset; return ready || error; });
  const error = await page.getAttribute("#view", "data-error");
  if (error?.includes("WebGL 2")) {
    console.log("skipped: this browser has no WebGL 2");
    process.exit(77);
  }
  assert.equal(error, null);
  return page;
};

export const spheres = async (page) => Number(await page.getAttribute("#view", "data-spheres"));
export const meshes = async (page) => Number(await page.getAttribute("#view", "data-meshes"));
/// Waits until an expression of the page is true.
export const until = (page, expression, argument) => page.waitForFunction(expression, argument, { timeout: 60000 });
/// Waits until the page has answered what was done and is drawn anew.
export const answered = (page) => page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); }));
/// Clicks down the middle of the picture until a sphere is selected.
export const selectASphere = async (page) => {
  const view = await box(page, "#view");
  for (let y = 0.15; y < 0.9 && await page.isHidden("#selection"); y += 0.04) {
    await page.mouse.click(view.x + view.width / 2, view.y + y * view.height);
    await answered(page);
  }
};
/// Waits until what is drawn is as fine as it becomes.
export const settled = async (page) => {
  await answered(page);
  await until(page, () => document.getElementById("view").dataset.picture === "final");
};
export const text = (page, selector) => page.textContent(selector);

/// The box of an element of the overlay, which is made anew with each picture.
export const box = (page, selector) => page.evaluate((s) => {
  const { x, y, width, height } = document.querySelector(s).getBoundingClientRect();
  return { x, y, width, height };
}, selector);

/// Runs foam; its standard output.
export const foam = async (program, ...options) => {
  const child = spawn(program, options, { stdio: ["ignore", "pipe", "inherit"] });
  let said = "";
  child.stdout.on("data", (bytes) => { said += bytes; });
  const [code] = await once(child, "close");
  assert.equal(code, 0, `foam ${options.join(" ")}`);
  return said;
};

/// Starts foam view; {address, end()}.
export const served = (program, ...options) => servedFrom("", program, ...options);

/// The same, with a text as its standard input.
export const servedFrom = async (input, program, ...options) => {
  const child = spawn(program, ["view", "--no-open", ...options], { stdio: ["pipe", "pipe", "inherit"] });
  child.stdin.end(input);
  const [line] = await once(child.stdout, "data");
  return { address: String(line).trim(), end: async () => { child.kill("SIGTERM"); await once(child, "close"); } };
};

/// Runs the tests of a script, each on its own; ends the process with the number of those that fail.
export const run = async (tests) => {
  let failed = 0;
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test();
      console.log(`ok ${name}`);
    } catch (error) {
      ++failed;
      console.log(`FAILED ${name}: ${error.stack}`);
    }
  }
  process.exit(failed === 0 ? 0 : 1);
};
