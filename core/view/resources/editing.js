// Changes of spheres and links.

class Edits {
  constructor(world, session, told) {
    Object.assign(this, { world, session, told });
    if (!world.edits) {
      return;
    }
    this.more = button("More here", "Twice the weight, and more spheres", () => this.ofLink("more"));
    this.fewer = button("Fewer here", "Half the weight, and fewer spheres", () => this.ofLink("fewer"));
    this.again = button("Again", "Search again, around the pinned spheres", () => this.ofLink("again"));
    this.close = button("Close gaps", "Grow the spheres until they cover the link", () => this.ofLink("close"));
    this.add = button("Add sphere", "A pinned sphere in the middle of the link (A)", () => this.addSphere());
    find("link-buttons").append(this.more, this.fewer, this.again, this.close, this.add);
    find("undo").addEventListener("click", () => this.undo());
    find("redo").addEventListener("click", () => this.redo());
    document.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const typing = event.target.matches?.("input:not([type=range]):not([type=checkbox]):not([type=radio]), select");
    if (typing) {
      return;
    }
    const letter = event.key.toLowerCase(), control = event.ctrlKey || event.metaKey;
    if (control && letter === "z") {
      event.shiftKey ? this.redo() : this.undo();
    } else if (control && letter === "y") {
      this.redo();
    } else if (control && letter === "s") {
      find("save-button").click();
    } else if (!control && !event.altKey && letter === "a" && this.world.link !== null) {
      this.addSphere();
    } else {
      return;
    }
    event.preventDefault();
  }

  /// A change of the chosen element.
  ofElement(kind, more) {
    const { model, link, index } = this.world.selected;
    return this.session.change("edit", { kind, model, link, index, ...more });
  }

  move(row) {
    return this.ofElement("move", { sphere: row });
  }

  pin(pinned) {
    return this.ofElement("pin", { pinned });
  }

  remove() {
    return this.ofElement("remove", {});
  }

  async work(text, change) {
    const begin = performance.now();
    find("work").textContent = `${text} …`;
    await change;
    find("work").textContent = `${text}: ${((performance.now() - begin) / 1000).toFixed(2)} s`;
  }

  ofLink(kind) {
    const { world } = this;
    const texts = { more: "More here", fewer: "Fewer here", again: "Again", close: "Close gaps" };
    this.work(texts[kind], this.session.change("edit", { kind, model: world.active, link: world.link }));
  }

  count(spheres) {
    this.work(`${counted(spheres, "sphere")} at most`, this.session.change("edit", { kind: "count",
      model: this.world.active, spheres }));
  }

  /// Adds a sphere where the chosen one is, or in the middle of the link, of a size that can be seen.
  async addSphere() {
    const { world } = this, { model, robot } = world, link = world.link, elements = model.links[link];
    let row;
    if (world.element) {
      row = world.element.row.slice();
      row[0] += row[3];
    } else if (elements.length > 0) {
      row = elements[0].row.slice();
    } else {
      const { low, high } = world.bounds(new Set([link]));
      const middle = low.map((x, i) => (x + high[i]) / 2), size = Math.hypot(...high.map((x, i) => x - low[i]));
      row = [...insideOf(robot.placed[link], middle), size / 8];
    }
    await this.session.change("edit", { kind: "add", model: world.active, link, sphere: row });
    if (model.links[link].length > elements.length) {
      world.select({ model: world.active, link, index: model.links[link].length - 1 });
    }
  }

  undo() {
    if (this.world.session.undo) {
      this.session.change("undo", {});
    }
  }

  redo() {
    if (this.world.session.redo) {
      this.session.change("redo", {});
    }
  }

  async protrusions() {
    if (this.world.edits) {
      for (const m of this.world.models.keys()) {
        await this.session.protrusions(m);
      }
    }
  }

  show() {
    const { world } = this;
    find("edit").hidden = !world.edits;
    if (!world.edits) {
      return;
    }
    const link = world.link, name = find("edited-link"), judged = world.robot.judged;
    const verdict = link === null ? null : world.model.verdicts?.[link];
    name.textContent = link === null ? "– choose a link or a sphere" : world.robot.links[link].name;
    for (const one of [this.more, this.fewer, this.again, this.close]) {
      one.disabled = link === null || !judged || (world.model.verdicts ? !verdict : false);
    }
    this.add.disabled = link === null;
    find("undo").disabled = !world.session.undo;
    find("redo").disabled = !world.session.redo;
    const weight = link === null ? 1 : world.model.weights[link] ?? 1;
    name.title = weight === 1 ? "" : `weight ${weight}`;
    if (verdict && world.model.links[link].length > 0) {
      name.textContent += ` · ${verdictText(verdict)}`;
    }
  }
}
