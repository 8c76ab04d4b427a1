// The chosen element: its numbers, copied or changed.

class SelectionPanel {
  constructor(world, stage, edits) {
    Object.assign(this, { world, stage, edits, drag: null });
    this.copy = button("Copy", "Copy link, index, centre and radius (C)", () => this.copied());
    this.pin = button("Pin", "A search keeps a pinned sphere as it is (P)", () => this.pinned());
    this.remove = button("Delete", "Delete the sphere (Del)", () => this.removed());
    this.close = button("Deselect", "Esc", () => world.select(null));
    find("selection-buttons").append(this.copy, ...(world.edits ? [this.pin, this.remove] : []), this.close);
    stage.canvas.addEventListener("pointerdown", (event) => { this.pressed = [event.clientX, event.clientY]; });
    stage.canvas.addEventListener("pointermove", (event) => this.moveDrag(event));
    for (const end of ["pointerup", "pointercancel"]) {
      stage.canvas.addEventListener(end, (event) => this.release(event));
    }
    stage.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  /// Returns what is under a place of the canvas: {model, link, index}; null if no element is.
  under(x, y) {
    const { world } = this, ray = this.stage.ray(x, y), model = world.models[ray.model];
    const robot = world.robotOf(model);
    let best = null, nearest = Infinity;
    if (!world.layers.spheres) {
      return null;
    }
    model.links.forEach((link, l) => link.forEach((element, index) => {
      const at = robot.shown.has(l)
        ? KINDS[element.kind].hit(element.row, robot.placed[l], ray.origin, ray.direction) : null;
      if (at !== null && at < nearest) {
        nearest = at;
        best = { model: ray.model, link: l, index };
      }
    }));
    return best;
  }

  /// Returns {model, link} of the mesh under a place of the canvas; null if none is.
  meshUnder(x, y) {
    const { world } = this, ray = this.stage.ray(x, y);
    let best = null, nearest = Infinity;
    for (const { link, mesh, pose } of world.parts(world.models[ray.model])) {
      const end = ray.origin.map((o, i) => o + ray.direction[i]), origin = insideOf(pose, ray.origin);
      const at = hitOfMesh(world.scene.meshes[mesh], origin, insideOf(pose, end).map((p, i) => p - origin[i]));
      if (at !== null && at < nearest) {
        nearest = at;
        best = { model: ray.model, link };
      }
    }
    return best;
  }

  place(event) {
    const box = this.stage.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /// Returns "move", "size" or null: what dragging from here does with the chosen element.
  grip(event) {
    const { world, stage } = this, element = world.element;
    if (!element || !world.edits || event.shiftKey || event.button > 0) {
      return null;
    }
    const [x, y] = this.place(event), cell = stage.cells()[world.selected.model], kind = KINDS[element.kind];
    const placed = world.robotOf(world.models[world.selected.model]).placed[world.selected.link];
    const [cx, cy] = stage.project(moved(placed, kind.centre(element.row)), cell);
    const r = kind.radius(element.row) * cell.height / stage.seen.height, s = Math.SQRT1_2 * r;
    if (Math.hypot(x - cx - s, y - cy + s) < 10) {
      return "size";
    }
    return Math.hypot(x - cx, y - cy) < Math.max(r, 6) ? "move" : null;
  }

  /// Takes a pressed pointer if it drags the chosen element.
  take(event) {
    const grip = this.grip(event);
    if (grip) {
      this.drag = { grip, from: this.place(event), row: this.world.element.row.slice(), moved: false,
        selected: this.world.selected };
      this.stage.canvas.setPointerCapture(event.pointerId);
    }
    return grip !== null;
  }

  moveDrag(event) {
    const { drag, world, stage } = this;
    if (drag && (drag.selected !== world.selected || !world.element)) {
      this.drag = null;   // another is chosen, or it was deleted
      return;
    }
    if (!drag) {
      const grip = event.buttons === 0 ? this.grip(event) : null;
      stage.canvas.classList.toggle("moves", grip === "move");
      stage.canvas.classList.toggle("sizes", grip === "size");
      return;
    }
    const [x, y] = this.place(event), dx = x - drag.from[0], dy = y - drag.from[1];
    drag.moved ||= Math.hypot(dx, dy) > 3;
    if (!drag.moved) {
      return;
    }
    const element = world.element, kind = KINDS[element.kind], { right, up } = stage.seen;
    element.before ??= element.row;   // an answer of the session makes the element anew
    const cell = stage.cells()[world.selected.model], metres = stage.seen.height / cell.height;
    const placed = world.robotOf(world.models[world.selected.model]).placed[world.selected.link];
    const centre = moved(placed, kind.centre(drag.row));
    if (drag.grip === "move") {
      const to = centre.map((c, i) => c + metres * (dx * right[i] - dy * up[i]));
      element.row = kind.withCentre(drag.row, insideOf(placed, to));
    } else {
      const [cx, cy] = stage.project(centre, cell);
      element.row = kind.withSize(drag.row, Math.max(1e-4, metres * Math.hypot(x - cx, y - cy)));
    }
    world.touch("drag");
  }

  release(event) {
    const { drag, world } = this, row = world.element?.row;
    const dropped = drag?.moved && event.type === "pointerup" && drag.selected === world.selected && row;
    this.cancel();
    if (dropped) {
      this.edits.move(row);   // it is where it was until the session has taken it
    } else if (!drag?.moved && event.type === "pointerup" && this.pressed && event.button === 0
      && Math.hypot(event.clientX - this.pressed[0], event.clientY - this.pressed[1]) < 4) {
      const place = this.place(event), element = this.under(...place), mesh = element ?? this.meshUnder(...place);
      world.active = mesh?.model ?? world.active;
      world.link = mesh?.link ?? null;
      world.select(element);
    }
    this.pressed = null;
  }

  /// Ends a drag; the element is again where it was.
  cancel() {
    const { drag, world } = this;
    this.drag = null;
    const element = drag && world.models[drag.selected.model].links[drag.selected.link][drag.selected.index];
    if (element?.before) {
      element.row = element.before;
      delete element.before;
      world.touch("drag");
    }
  }

  key(event) {
    const { world } = this;
    if (!world.element || event.ctrlKey || event.metaKey || event.altKey || (this.drag && event.key !== "Escape")) {
      return;
    }
    const done = { c: () => this.copied(), Escape: () => (this.drag ? this.cancel() : world.select(null)) };
    if (world.edits) {
      const sized = (factor) => this.edits.move(KINDS[world.element.kind].withSize(world.element.row,
        factor * KINDS[world.element.kind].radius(world.element.row)));
      Object.assign(done, { Delete: () => this.removed(), p: () => this.pinned(), "[": () => sized(1 / 1.05),
        "]": () => sized(1.05) });
    }
    done[event.key]?.();
    if (done[event.key]) {
      event.preventDefault();
    }
  }

  pinned() {
    this.edits.pin(!this.world.element.pinned);
  }

  removed() {
    this.edits.remove();
  }

  /// What is copied: as a recipe and most formats have it.
  text() {
    const { world } = this, { model, link, index } = world.selected, row = world.element.row;
    return `${world.robotOf(world.models[model]).links[link].name} ${index} [${row.join(", ")}]`;
  }

  async copied() {
    const text = this.text();
    try {
      await navigator.clipboard.writeText(text);
    } catch {   // no right to the clipboard, as in a file: the old way
      const area = node("textarea", { value: text });
      document.body.append(area);
      area.select();
      document.execCommand("copy");
      area.remove();
    }
    this.copy.textContent = "Copied";
    this.copy.dataset.text = text;
    setTimeout(() => { this.copy.textContent = "Copy"; }, 1200);
  }

  /// Shows the chosen element, or the first numbers of a drag.
  show() {
    const { world } = this, element = world.element;
    if (element && find("selection").hidden) {
      find("panel").scrollTop = 0;   // where its numbers are
    }
    find("selection").hidden = !element;
    if (!element) {
      return;
    }
    const { model, link, index } = world.selected, of = world.models[model];
    const title = `${world.robotOf(of).links[link].name} · ${KINDS[element.kind].text} ${index + 1} of ${of.links[link].length}`;
    find("selected").textContent = title;
    this.pin.setAttribute("aria-pressed", element.pinned);
    this.pin.textContent = element.pinned ? "Pinned" : "Pin";
    const fields = find("numbers"), wanted = KINDS[element.kind].numbers;
    if (fields.children.length !== 3 * wanted.length) {
      fields.replaceChildren(...wanted.flatMap(([name, i]) => this.field(name, i)));
    }
    wanted.forEach(([, i]) => {
      const input = fields.children[3 * i + 1];
      if (document.activeElement !== input || this.drag) {
        input.value = Number((1000 * element.row[i]).toFixed(4));
      }
    });
  }

  field(name, i) {
    const input = node("input", { type: "number", step: "any", id: `number-${name}`, readOnly: !this.world.edits });
    input.addEventListener("change", () => {
      const row = this.world.element.row.slice();
      row[i] = input.valueAsNumber / 1000;
      if (Number.isFinite(row[i])) {
        this.edits.move(row);
      }
    });
    return [node("label", { htmlFor: input.id }, name), input, node("span", { className: "quiet" }, "mm")];
  }
}
