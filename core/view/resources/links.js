// The list of links: shown or not, their spheres, and whether these are proved to cover them.

class LinkPanel {
  constructor(world) {
    this.world = world;
    find("all-links").addEventListener("click", () => this.showAll(true));
    find("no-links").addEventListener("click", () => this.showAll(false));
  }

  showAll(on) {
    const { robot } = this.world;
    robot.shown = new Set(on ? robot.links.keys() : []);
    this.world.touch("links");
  }

  show() {
    const { world } = this, { robot, model } = world;
    if (this.robot !== robot) {
      this.robot = robot;
      this.rows = robot.links.map((link, l) => this.row(link, l));
      find("links").replaceChildren(...this.rows.map(({ row }) => row));
    }
    this.rows.forEach(({ row, box, swatch, number, mark }, l) => {
      const count = model.links[l].length, verdict = model.verdicts?.[l];
      box.checked = robot.shown.has(l);
      row.classList.toggle("active", world.link === l);
      swatch.hidden = world.colour !== "link" || count === 0;
      number.textContent = count > 0 ? count : "";
      mark.textContent = verdict && count > 0 ? (verdict.holds ? "✓" : "!") : "";
      mark.className = `mark ${verdict?.holds ? "yes" : "no"}`;
      mark.title = verdict && count > 0 ? verdictText(verdict) : "";
    });
    this.verdict();
  }

  row(link, l) {
    const { world } = this, box = node("input", { type: "checkbox", title: "Show the link" });
    box.setAttribute("aria-label", `show ${link.name}`);
    box.addEventListener("change", () => {
      box.checked ? this.robot.shown.add(l) : this.robot.shown.delete(l);
      world.touch("links");
    });
    const swatch = node("span", { className: "swatch" }), number = node("span", { className: "number" });
    swatch.style.background = HUES[l % HUES.length];
    const mark = node("span", { className: "mark" });
    const name = button(link.name, link.name, () => {
      world.link = world.link === l ? null : l;
      world.selected = null;
      world.touch("selection");
    });
    return { box, swatch, number, mark, row: node("li", {}, box, swatch, name, number, mark) };
  }

  /// One sentence on the whole model.
  verdict() {
    const { model, robot } = this.world, line = find("verdict");
    const judged = (model.verdicts ?? []).map((v, l) => [v, l]).filter(([v, l]) => v && robot.links[l]);
    line.className = "";
    if (this.world.count() === 0) {
      line.textContent = "";
    } else if (!robot.judged) {
      line.className = "quiet";
      line.textContent = "Without the original geometry nothing is proved.";
    } else if (!model.verdicts) {
      line.className = "quiet";
      line.textContent = "Not judged yet: proving …";
    } else {
      const open = judged.filter(([v]) => !v.holds), hollow = judged.some(([v]) => v.missing > 0);
      line.className = open.length === 0 ? "yes" : "no";
      line.textContent = open.length === 0 ? `Proved: the spheres cover ${hollow ? "the surface of " : ""}${
        judged.length === 1 ? "the link" : `all ${judged.length} links`}.` : `The spheres do not cover ${open.length} of ${counted(judged.length, "link")}.`;
    }
  }
}

/// "covered, excess 0.42, protrusion 12.3 mm".
const verdictText = ({ holds, gap, excess, protrusion, missing }) => [
  holds ? `${missing > 0 ? "its surface is " : ""}proved to be covered` : gap === null ? "no spheres" : `not covered: a point of the link is ${millimetres(gap)} from them`,
  excess === null ? "" : `excess ${excess.toFixed(2)}`, missing > 0 ? `missing ${missing.toPrecision(2)}` : "", protrusion === null ? "" : `protrusion ${millimetres(protrusion)}`]
  .filter((part) => part).join(", ");
