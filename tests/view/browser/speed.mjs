// Measures foam view in headless Chromium, which draws in software: when the first picture stands, pictures a second
// while the camera turns, the processor time that Chromium takes for one of them (which other work on the computer hardly
// changes), and pictures at rest, of which there are to be none. No test; it prints a row for each robot. For Linux.
//
//     node speed.mjs CHROMIUM FOAM ROBOT[,SPHERES]...        each is served by foam view
//     node speed.mjs CHROMIUM FOAM PAGE.html ...             pages that foam view --html wrote
import fs from "node:fs";
import path from "node:path";
import { performance } from "node:perf_hooks";
import { pathToFileURL } from "node:url";
import { launch, served } from "./browser.mjs";

const [chromium, program, ...subjects] = process.argv.slice(2);

/// Serves the files of a subject; {address, end(), took: ms}. A page needs no server.
const shown = async (subject) => {
  if (subject.endsWith(".html")) {
    return { address: pathToFileURL(path.resolve(subject)).href, end: () => {}, took: 0 };
  }
  const begin = performance.now(), session = await served(program, ...subject.split(","));
  return { ...session, took: performance.now() - begin };
};

/// Returns the processor time of all processes of Chromium, ms.
const processorTime = () => {
  const processes = new Map();
  for (const id of fs.readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const text = fs.readFileSync(`/proc/${id}/stat`, "utf8"), fields = text.slice(text.lastIndexOf(")") + 2).split(" ");
      processes.set(id, { name: text.slice(text.indexOf("(") + 1, text.lastIndexOf(")")), parent: fields[1],
        time: 10 * (Number(fields[11]) + Number(fields[12])) });
    } catch {
      // it has ended
    }
  }
  const ours = (id) => id === String(process.pid) || (processes.has(id) && ours(processes.get(id).parent));
  return [...processes].filter(([id, { name }]) => name.startsWith("chrom") && ours(id))
    .reduce((sum, [, { time }]) => sum + time, 0);
};

/// Runs in the page: ends when what was drawn so far is on the screen.
const drawn = () => new Promise((done) => {
  const gl = document.getElementById("view").getContext("webgl2");
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  requestAnimationFrame(done);
});

/// Runs in the page: turns the camera for some time.
const turned = async (ms) => {
  const canvas = document.getElementById("view"), gl = canvas.getContext("webgl2");
  const pictures = () => Number(canvas.dataset.frames), begin = performance.now(), before = pictures();
  while (performance.now() - begin < ms) {
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
    await new Promise(requestAnimationFrame);
  }
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));   // until the last is drawn
  return { pictures: pictures() - before, seconds: (performance.now() - begin) / 1000,
    pixels: `${canvas.width} x ${canvas.height}`, triangles: canvas.dataset.triangles };
};

const browser = await launch(chromium);
console.log("| robot | foam, s | page, s | first picture, s | pictures/s, 1st second | pictures/s | CPU, ms | pixels | "
  + "triangles | at rest |\n|---|---|---|---|---|---|---|---|---|---|");
for (const subject of subjects) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } }), session = await shown(subject);
  const begin = performance.now();
  await page.goto(session.address);
  await page.waitForFunction(() => document.getElementById("view").dataset.ready, null, { timeout: 120000 });
  await page.evaluate(drawn);
  const loaded = performance.now() - begin;
  // Proofs run beside the first picture. What is measured next is the page alone, unless they take longer than this.
  await page.waitForFunction(() => !/^(Not judged|Finding)/m.test(document.getElementById("panel").innerText), null,
    { timeout: 20000 }).catch(() => {});
  const first = await page.evaluate(turned, 1000), before = processorTime(), then = await page.evaluate(turned, 4000);
  const each = (processorTime() - before) / then.pictures;
  await page.waitForFunction(() => document.getElementById("view").dataset.picture === "final");
  const pictures = () => page.getAttribute("#view", "data-frames"), final = await pictures();
  await page.waitForTimeout(1000);
  const seconds = (ms) => (ms / 1000).toFixed(2), rate = (one) => (one.pictures / one.seconds).toFixed(1);
  console.log(`| ${path.basename(subject.split(",")[0])} | ${seconds(session.took)} | ${seconds(loaded)} | ${
    seconds(session.took + loaded)} | ${rate(first)} | ${rate(then)} | ${each.toFixed(0)} | ${then.pixels} | ${then.triangles} | ${
    await pictures() - final} |`);
  await page.close();
  await session.end();
}
await browser.close();
