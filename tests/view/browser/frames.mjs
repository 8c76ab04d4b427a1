// Measures the page: time to the first picture, and pictures a second while it turns.
//
//     node frames.mjs CHROMIUM ADDRESS-OR-FILE [WIDTH HEIGHT]
import { performance } from "node:perf_hooks";
import { launch } from "./browser.mjs";

const [chromium, address, width = "1280", height = "800"] = process.argv.slice(2);
const browser = await launch(chromium);
const page = await browser.newPage({ viewport: { width: Number(width), height: Number(height) } });
const begin = performance.now();
await page.goto(address);
await page.waitForFunction(() => document.getElementById("view").dataset.ready, null, { timeout: 120000 });
const first = performance.now() - begin;
const result = await page.evaluate(async () => {
  const canvas = document.getElementById("view"), turn = () => new Promise((done) => {
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
    requestAnimationFrame(done);
  });
  for (let i = 0; i < 60; ++i) {   // the page learns how coarse it has to be
    await turn();
  }
  const start = performance.now(), before = Number(canvas.dataset.frames);
  while (performance.now() - start < 4000) {
    await turn();
  }
  return { frames: (Number(canvas.dataset.frames) - before) / ((performance.now() - start) / 1000),
    pixels: `${canvas.width} x ${canvas.height}` };
});
console.log(`first picture ${first.toFixed(0)} ms, ${result.frames.toFixed(1)} pictures a second of ${result.pixels}`);
await browser.close();
