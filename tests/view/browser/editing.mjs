// The served page: edits, searches, the way back, saving, a reload, two windows. Arguments: CHROMIUM FOAM SOURCE.
import assert from "node:assert/strict";
import fs from "node:fs";
import { answered, box, foam, launch, opened, run, selectASphere, served, servedFrom, spheres, text, until } from "./browser.mjs";

const [chromium, program, source] = process.argv.slice(2);
const panda = `${source}/configs/robots/panda/panda.urdf`;
await foam(program, "spherize", panda, "-n", "22", "-o", "model.csv");
const session = await served(program, panda, "model.csv");
const browser = await launch(chromium);
const page = await opened(browser, session.address);
const link = 5;   // panda_link5
const count = async (l = link) => Number(await page.locator("#links .number").nth(l).textContent());
const press = (label) => page.locator("#link-buttons button", { hasText: label }).click();
const proved = () => until(page, () => /^(Proved|The spheres do not)/.test(document.getElementById("verdict").textContent));
/// Waits for the end of a search.
const worked = () => until(page, () => /\d s$/.test(document.getElementById("work").textContent));

/// Drags the middle of an element of the overlay until that has an effect: an answer of the session, such as a proof that
/// arrives late, ends a drag.
const drags = async (selector, dx, dy, effect) => {
  for (let tries = 0; tries < 5 && !await effect(); ++tries) {
    await answered(page);
    const { x, y, width, height } = await box(page, selector), from = [x + width / 2, y + height / 2];
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(from[0] + dx, from[1] + dy, { steps: 4 });
    await page.mouse.up();
    await page.waitForTimeout(500);
  }
  assert.ok(await effect());
};

await run({
  async showsProofAndPairs() {
    await proved();
    assert.match(await text(page, "#verdict"), /^Proved/);
    await until(page, () => /^Nearest|touch/.test(document.getElementById("nearest").textContent));
    assert.ok(await page.isVisible("#edit"));
  },
  async searchesALink() {
    const before = await count();
    await page.locator("#links button").nth(link).click();
    await press("More here");
    await until(page, ([l, least]) => Number(document.querySelectorAll("#links .number")[l].textContent) > least, [link, before]);
    await worked();
    const seconds = Number((await text(page, "#work")).match(/([\d.]+) s$/)[1]);
    console.log(`  more here: ${seconds} s`);
    await press("Fewer here");
    await worked();
    await press("Again");
    await worked();
    assert.match(await text(page, "#verdict"), /^Proved/);
  },
  async movesResizesAndClosesGaps() {
    await page.check("input[name=through][value=none]");
    await selectASphere(page);
    const radius = page.locator("#number-radius"), before = Number(await radius.inputValue());
    await radius.fill(String(before / 2));
    await radius.press("Enter");
    await until(page, () => document.getElementById("verdict").textContent.startsWith("The spheres do not cover 1 of"));
    assert.ok(await page.locator("#overlay .witness").count() > 0);
    await press("Close gaps");
    await until(page, () => document.getElementById("verdict").textContent.startsWith("Proved"));
    const x = await page.locator("#number-x").inputValue();
    await drags("#overlay .ring", 25, -10, async () => await page.locator("#number-x").inputValue() !== x);
    const wide = Number(await radius.inputValue());
    await drags("#overlay .handle", 30, -30, async () => Number(await radius.inputValue()) > wide);
  },
  async aCancelledDragChangesNothing() {
    const x = await page.locator("#number-x").inputValue();
    let edits = 0;
    page.on("request", (request) => { edits += request.url().endsWith("/edit"); });
    for (const cancel of ["pointercancel", "Escape"]) {
      const ring = await box(page, "#overlay .ring");
      await page.mouse.move(ring.x + ring.width / 2, ring.y + ring.height / 2);
      await page.mouse.down();
      await page.mouse.move(ring.x + ring.width / 2 + 25, ring.y + ring.height / 2, { steps: 4 });
      await until(page, (old) => document.getElementById("number-x").value !== old, x);
      if (cancel === "Escape") {
        await page.focus("#view");
        await page.keyboard.press("Escape");
      } else {
        await page.dispatchEvent("#view", "pointercancel", { pointerId: 1, bubbles: true });
      }
      await until(page, (old) => document.getElementById("number-x").value === old, x);
      await page.mouse.up();
      await page.waitForTimeout(300);
      assert.equal(await page.locator("#number-x").inputValue(), x);
    }
    assert.equal(edits, 0);
  },
  async pinsAddsDeletesByKey() {
    await page.focus("#view");
    await page.keyboard.press("p");
    await until(page, () => document.querySelector("#overlay .ring.pinned"));
    const before = await spheres(page);
    await page.keyboard.press("a");
    await until(page, (n) => Number(document.getElementById("view").dataset.spheres) === n + 1, before);
    await page.focus("#view");
    await page.keyboard.press("Delete");
    await until(page, (n) => Number(document.getElementById("view").dataset.spheres) === n, before);
    await page.focus("#view");
    await page.keyboard.press("Control+z");
    await until(page, (n) => Number(document.getElementById("view").dataset.spheres) === n + 1, before);
    await page.keyboard.press("Control+Shift+Z");
    await until(page, (n) => Number(document.getElementById("view").dataset.spheres) === n, before);
  },
  async changesTheWholeRobot() {
    const before = await spheres(page), slider = page.locator("#count");
    await slider.fill(await slider.getAttribute("max"));
    await until(page, (n) => Number(document.getElementById("view").dataset.spheres) > n, before);
    await proved();
    await page.click("#undo");
    await until(page, (n) => Number(document.getElementById("view").dataset.spheres) === n, before);
  },
  async coloursByProtrusion() {
    await page.check("input[value=protrusion]");
    await until(page, () => document.getElementById("scale").textContent.startsWith("0.00 mm"));
    await page.check("input[name=colour][value=link]");
  },
  async savesAndReloads() {
    const kept = await spheres(page);
    await page.selectOption("#format", "csv");
    await page.fill("#file", "saved.csv");
    await page.click("#save-button");
    await until(page, () => document.getElementById("saved").textContent.startsWith("Written"));
    assert.equal(fs.readFileSync("saved.csv", "utf8").trim().split("\n").length - 1, kept);
    await page.click("#save-button");
    await until(page, () => document.getElementById("saved").textContent.includes("exists already"));
    await page.check("#replace");
    await page.click("#save-button");
    await until(page, () => document.getElementById("saved").textContent.startsWith("Written"));
    await page.fill("#file", "../out.csv");
    await page.click("#save-button");
    await until(page, () => document.getElementById("saved").textContent.includes("not a file name"));
    await page.reload();
    await until(page, () => document.getElementById("view").dataset.ready);
    assert.equal(await spheres(page), kept);
    await proved();
    assert.ok(await page.isEnabled("#undo"));
  },
  async savesARecipeThatGivesTheSame() {
    await page.locator("#links button").nth(link).click();
    await proved();
    for (let l = 0; l < await page.locator("#links li").count(); ++l) {   // recipes keep what covers
      if (await page.locator("#links .mark").nth(l).textContent() === "!") {
        await page.locator("#links button").nth(l).click();
        await press("Close gaps");
        await worked();
      }
    }
    await page.selectOption("#format", "recipe");
    await page.fill("#file", "saved.yaml");
    await page.uncheck("#replace");
    await page.click("#save-button");
    await until(page, () => document.getElementById("saved").textContent.startsWith("Written"));
    await page.selectOption("#format", "csv");
    await page.fill("#file", "same.csv");
    await page.click("#save-button");
    await until(page, () => document.getElementById("saved").textContent.includes("same.csv"));
    await foam(program, "run", "saved.yaml", "--run-dir", "again");
    const urdf = fs.readdirSync("again").find((file) => file.endsWith(".urdf"));
    await foam(program, "convert", `again/${urdf}`, panda, "-o", "again.csv");
    assert.deepEqual(fs.readFileSync("again.csv", "utf8").split("\n").sort(), fs.readFileSync("same.csv", "utf8").split("\n").sort());
  },
  async readsTheStandardInput() {
    const piped = await servedFrom(fs.readFileSync("model.csv"), program, panda, "-");
    const other = await opened(browser, piped.address);
    await until(other, () => document.getElementById("verdict").textContent.startsWith("Proved"));
    assert.equal(await spheres(other), 22);
    assert.deepEqual(other.complaints, []);
    await other.context().close();
    await piped.end();
  },
  async anotherWindowIsTold() {
    const other = await opened(browser, session.address);
    await page.locator("#links button").nth(0).click();
    await press("More here");
    await worked();
    await other.locator("#links button").nth(0).click();
    await other.locator("#link-buttons button", { hasText: "Add sphere" }).click();
    await until(other, () => document.getElementById("told").textContent.includes("reload the page"));
    assert.deepEqual(other.complaints.filter((line) => !line.includes("400")), []);
    await other.context().close();
  },
  async strangersAreRefused() {
    const { origin } = new URL(session.address);
    assert.equal((await fetch(`${origin}/scene`)).status, 404);
    const stranger = await browser.newPage();
    await stranger.goto("data:text/html,<p>stranger</p>");
    const answer = await stranger.evaluate((address) => fetch(address).then(() => "read", () => "refused"), session.address);
    assert.equal(answer, "refused");
    await stranger.close();
  },
  async noComplaints() {
    assert.deepEqual(page.complaints.filter((line) => !line.includes("400")), []);   // requests that were refused on purpose
    await session.end();
  },
});
