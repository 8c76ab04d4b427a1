// The page that is one file: every control, names as text, phone, dark, keyboard. Arguments: CHROMIUM FOAM SOURCE.
import assert from "node:assert/strict";
import fs from "node:fs";
import { pathToFileURL } from "node:url";
import { box, foam, launch, meshes, opened, run, selectASphere, settled, spheres, text, until } from "./browser.mjs";

const [chromium, program, source] = process.argv.slice(2);
const panda = `${source}/configs/robots/panda/panda.urdf`;
const HOSTILE = "<img src=x onerror=alert(1)>&\"'\u202Egnp";
const escaped = HOSTILE.replace(/[<>&"']/g, (c) => `&#${c.charCodeAt(0)};`);
fs.writeFileSync("hostile.urdf", `<robot name="${escaped}"><link name="${escaped}"><collision><geometry><box size="1 1 1"/>
  </geometry></collision></link><link name="tip"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <joint name="${escaped}" type="revolute"><parent link="${escaped}"/><child link="tip"/><origin xyz="0 0 2"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>`);

const SIDE = 260, sheet = [], place = (x, y) => `v ${x / SIDE} ${y / SIDE} ${Math.sin(x / 9) * Math.sin(y / 7) / 20}`;
for (let y = 0; y <= SIDE; ++y) {
  for (let x = 0; x <= SIDE; ++x) {
    sheet.push(place(x, y));
  }
}
for (let y = 0; y < SIDE; ++y) {
  for (let x = 1; x <= SIDE; ++x) {
    const a = y * (SIDE + 1) + x, b = a + SIDE + 1;
    sheet.push(`f ${a} ${a + 1} ${b}`, `f ${a + 1} ${b + 1} ${b}`);
  }
}
fs.writeFileSync("sheet.obj", sheet.join("\n"));
const beside = '<origin xyz="3 0 0"/><geometry><box size="0.5 0.5 0.5"/></geometry>';
fs.writeFileSync("sheet.urdf", `<robot name="sheet"><link name="sheet"><visual><origin xyz="-4 0 0"/><geometry>
  <mesh filename="sheet.obj"/></geometry></visual><visual>${beside}</visual><collision>${beside}</collision></link></robot>`);

await foam(program, "view", "sheet.urdf", "-n", "1", "--html", "sheet.html");
await foam(program, "view", panda, "-n", "11", "-n", "22", "-n", "44", "--html", "panda.html");
await foam(program, "spherize", panda, "-n", "20", "-o", "a.urdf");
await foam(program, "view", panda, "a.urdf", "a.urdf", "--html", "two.html");
await foam(program, "view", "hostile.urdf", "-n", "2", "-n", "4", "--html", "hostile.html");
const browser = await launch(chromium);
const at = (file) => pathToFileURL(`${process.cwd()}/${file}`).href;
const open = (file = "panda.html", options = {}) => opened(browser, at(file), options);
const ended = async (page) => {
  assert.deepEqual(page.complaints, []);
  await page.context().close();
};
await run({
  async layers() {
    const page = await open(), all = await meshes(page);
    assert.ok(all > 5);
    assert.ok(await spheres(page) <= 22 && await spheres(page) > 5);
    await page.uncheck("input[value=visuals]");
    await until(page, () => document.getElementById("view").dataset.meshes === "0");
    await page.check("input[value=collisions]");
    await until(page, (n) => Number(document.getElementById("view").dataset.meshes) > 5, all);
    await page.uncheck("input[value=spheres]");
    await until(page, () => document.getElementById("view").dataset.spheres === "0");
    for (const way of ["spheres", "none", "geometry"]) {
      await page.check(`input[name=through][value=${way}]`);
    }
    await ended(page);
  },
  async counts() {
    const page = await open();
    assert.match(await text(page, "#verdict"), /^Proved: the spheres cover all \d+ links\.$/);
    const before = await spheres(page);
    await page.locator("#count").fill("2");
    await until(page, (n) => Number(document.getElementById("view").dataset.spheres) > n, before);
    assert.equal(await text(page, "#count-text"), String(await spheres(page)));
    await ended(page);
  },
  async colours() {
    const page = await open();
    await page.check("input[value=radius]");
    await until(page, () => !document.getElementById("scale").hidden);
    assert.match(await text(page, "#scale"), /mm.*mm/);
    await page.check("input[value=protrusion]");
    await until(page, () => document.getElementById("scale").textContent.startsWith("0.00 mm"));
    await page.check("input[name=colour][value=link]");
    await until(page, () => document.getElementById("scale").hidden);
    await ended(page);
  },
  async joints() {
    const page = await open();
    const first = page.locator("#sliders input").nth(3);
    const low = Number(await first.getAttribute("min"));
    await first.fill(String(low));
    await until(page, () => document.getElementById("pose").value === "own");
    assert.match(await page.locator("#sliders output").nth(3).textContent(), /°$/);
    await page.selectOption("#pose", { label: "middle" });
    await until(page, () => {   // the sliders follow with the next picture
      const slider = document.querySelectorAll("#sliders input")[3];
      return Math.abs(Number(slider.value) - (Number(slider.min) + Number(slider.max)) / 2) < 0.01;
    });
    await page.selectOption("#pose", { label: "zero" });
    await ended(page);
  },
  async contacts() {
    const page = await open();
    assert.match(await text(page, "#nearest"), /^(Nearest: .+ – .+ mm|\d+ pairs? of links touch(es)?:)$/);
    for (const [joint, value] of [[3, -3.05], [1, 1.7], [5, 3.7]]) {   // the hand goes into the shoulder
      const slider = page.locator("#sliders input").nth(joint);
      const [low, high] = [Number(await slider.getAttribute("min")), Number(await slider.getAttribute("max"))];
      await slider.evaluate((input, to) => {   // fill() takes only values on a step
        input.value = to;
        input.dispatchEvent(new Event("input", { bubbles: true }));
      }, Math.min(Math.max(value, low), high));
    }
    await until(page, () => Number(document.getElementById("touching").dataset.pairs) > 0);
    assert.match(await page.locator("#pairs li").first().textContent(), /.+ – .+ mm deep$/);
    await ended(page);
  },
  async links() {
    const page = await open(), before = await meshes(page);
    await page.click("#no-links");
    await until(page, () => document.getElementById("view").dataset.meshes === "0");
    await page.locator("#links input").nth(1).check();
    await until(page, () => Number(document.getElementById("view").dataset.meshes) >= 1);
    await page.click("#all-links");
    await until(page, (n) => Number(document.getElementById("view").dataset.meshes) === n, before);
    await ended(page);
  },
  async pickingAndCopying() {
    const page = await open("panda.html", { permissions: [] });
    await page.check("input[name=through][value=none]");
    await selectASphere(page);
    assert.match(await text(page, "#selected"), /^panda_\S+ · sphere \d+ of \d+$/);
    const numbers = await page.locator("#numbers input").evaluateAll((inputs) => inputs.map((input) => Number(input.value)));
    assert.equal(numbers.length, 4);
    assert.ok(numbers[3] > 1 && numbers[3] < 1000);   // mm
    assert.ok((await box(page, "#overlay .ring")).width > 4);
    await page.locator("#selection-buttons button").first().click();
    await until(page, () => document.querySelector("#selection-buttons button").hasAttribute("data-text"));   // the clipboard answers later
    const copied = await page.locator("#selection-buttons button").first().getAttribute("data-text");
    assert.match(copied, /^panda_\S+ \d+ \[(-?[\d.e-]+, ){3}[\d.e-]+\]$/);
    assert.ok(Math.abs(Number(copied.match(/([\d.e-]+)\]$/)[1]) * 1000 - numbers[3]) < 1e-3);
    await page.focus("#view");
    await page.keyboard.press("Escape");
    await until(page, () => document.getElementById("selection").hidden);
    assert.ok(await page.isHidden("#edit") && await page.isHidden("#save"));   // nothing answers a file
    await ended(page);
  },
  async sideBySide() {
    const page = await open("two.html");
    assert.equal(await page.locator("#captions span").count(), 2);
    await page.selectOption("#model", "1");
    await until(page, () => document.querySelectorAll("#captions span")[1].className === "active");
    await ended(page);
  },
  async keyboard() {
    const page = await open(), shot = async () => (await page.locator("#view").screenshot()).toString("base64");
    await page.focus("#view");   // its outline is in the picture
    await settled(page);
    const before = await shot();
    for (const key of ["ArrowLeft", "ArrowUp", "Shift+ArrowRight", "+", "-"]) {
      await page.keyboard.press(key);
    }
    await settled(page);
    assert.ok(await shot() !== before);
    await page.keyboard.press("0");
    await settled(page);
    assert.ok(await shot() === before);
    await page.focus("#reset");
    await page.keyboard.press("Tab");
    assert.equal(await page.evaluate(() => document.activeElement.id), "theme");
    await page.keyboard.press("Enter");
    assert.equal(await text(page, "#theme"), "Theme: light");
    await ended(page);
  },
  async coarseThenFine() {
    const page = await open("sheet.html"), view = () => page.evaluate(() => ({ ...document.getElementById("view").dataset }));
    await settled(page);
    const all = Number((await view()).triangles);
    assert.ok(all > 2 * SIDE * SIDE - 1000, all);   // those without area are left out
    await page.focus("#view");
    await page.evaluate(() => {   // the picture after this one moves
      const canvas = document.getElementById("view");
      canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
    });
    await until(page, () => document.getElementById("view").dataset.picture === "moving");
    const { triangles } = await view();
    assert.ok(Number(triangles) < all / 2 && Number(triangles) > 1000, triangles);
    await settled(page);
    assert.equal(Number((await view()).triangles), all);
    for (let i = 0; i < 40; ++i) {   // what is out of sight is not drawn: there is nothing in the middle
      await page.keyboard.press("+");
    }
    await settled(page);
    assert.equal((await view()).triangles, "0");
    const { frames } = await view();
    await page.evaluate(async () => {   // nothing changes, so nothing is drawn
      for (let i = 0; i < 20; ++i) {
        await new Promise(requestAnimationFrame);
      }
    });
    assert.equal((await view()).frames, frames);
    await ended(page);
  },
  async darkAndPhone() {
    const dark = await open("panda.html", { colorScheme: "dark" });
    assert.ok(await dark.evaluate(() => parseInt(getComputedStyle(document.body).backgroundColor.match(/\d+/)[0], 10)) < 60);
    await ended(dark);
    const phone = await open("panda.html", { viewport: { width: 390, height: 844 }, hasTouch: true });
    assert.ok(await phone.evaluate(() => document.documentElement.scrollWidth) <= 390);
    const stage = await phone.locator("#stage").boundingBox(), panel = await phone.locator("#panel").boundingBox();
    assert.ok(panel.y >= stage.y + stage.height - 1);
    await phone.locator("#count").scrollIntoViewIfNeeded();
    assert.ok(await phone.isVisible("#count"));
    await ended(phone);
  },
  async hostileNamesAreText() {
    const page = await open("hostile.html"), shown = HOSTILE.replace("\u202E", "\\u{202e}");
    assert.equal(await text(page, "#title"), shown);
    assert.equal(await page.locator("#links button").first().textContent(), shown);
    assert.equal(await page.locator("#sliders label").first().textContent(), shown);
    assert.equal(await page.locator("img").count(), 0);
    assert.ok(!(await page.content()).includes("\u202E"));
    await page.locator("#links button").first().click();
    await ended(page);
  },
  async policyHasNoInlineCode() {
    const page = await open();
    const policy = await page.getAttribute("meta[http-equiv=Content-Security-Policy]", "content");
    assert.ok(!policy.includes("unsafe") && policy.startsWith("default-src 'none'"));
    await page.evaluate(() => {
      const script = document.createElement("script");
      script.textContent = "document.body.dataset.foreign = 'ran'";
      document.body.append(script);
    });
    assert.equal(await page.getAttribute("body", "data-foreign"), null);
    assert.ok(page.complaints.length > 0 && page.complaints.every((line) => line.includes("Content Security Policy")));
    await page.context().close();
  },
});
