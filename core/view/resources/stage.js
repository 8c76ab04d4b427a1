// The canvas: one cell for each model, all with one camera; what is written and drawn over it.

const NO_ROWS = new Float32Array();

class Stage {
  constructor(world, canvas, renderer, onPress) {
    Object.assign(this, { world, canvas, renderer, waiting: false, still: null, fast: 1, triangles: 50000, took: 20,
      last: 0, movements: 0, complete: false });
    renderer.take(world.scene);
    const { low, high } = world.bounds();
    this.reach = 4 * Math.hypot(...high.map((x, i) => x - low[i])) || 1;
    this.camera = new Camera(canvas, this.reach, () => this.move(),
      { heightOf: () => this.cells()[0].height, taken: (event) => onPress(event) });
    new ResizeObserver(() => this.move()).observe(canvas);
  }

  /// Takes the fine meshes; until then no picture is final.
  refine(scene) {
    this.renderer.refine(scene);
    this.complete = true;
    this.draw();
  }

  /// The cells of the canvas, in pixels of the page from its upper left corner: as many columns as make them squarest.
  cells() {
    const { clientWidth: width, clientHeight: height } = this.canvas, n = this.world.models.length;
    let best = 1, worst = Infinity;
    for (let columns = 1; columns <= n; ++columns) {
      const shape = (width / columns) / (height / Math.ceil(n / columns)), off = Math.abs(Math.log(shape));
      [best, worst] = off < worst ? [columns, off] : [best, worst];
    }
    const rows = Math.ceil(n / best);
    return this.world.models.map((_, m) => ({ x: (m % best) * width / best, y: Math.floor(m / best) * height / rows,
      width: width / best, height: height / rows }));
  }

  /// Draws soon: coarsely while something moves, finely when it rests.
  move() {
    this.schedule(true);
  }

  /// Draws finely when no movement follows the picture that was just drawn. The browser asks for the next one when it has
  /// taken this one, so that slow pictures are no rest.
  rest() {
    const drawn = ++this.movements;
    clearTimeout(this.still);
    requestAnimationFrame(() => {
      if (drawn === this.movements) {
        this.still = setTimeout(() => this.complete && this.schedule(false), Math.max(200, 4 * this.took));
      }
    });
  }

  draw() {
    this.schedule(!this.complete);
  }

  schedule(moving) {
    this.moving = moving;
    if (!this.waiting) {
      this.waiting = true;
      requestAnimationFrame((time) => {
        this.waiting = false;
        this.adapt(time, this.moving);
        this.render(this.moving);
        if (this.moving) {
          this.rest();
        }
      });
    }
  }

  /// Pixels of the buffer for one of the page.
  ratio(moving) {
    const screen = window.devicePixelRatio || 1;
    return moving ? Math.min(screen, 1) * this.fast : Math.max(2, screen);
  }

  render(moving) {
    const { canvas, world, renderer } = this, ratio = this.ratio(moving);
    const size = [canvas.clientWidth, canvas.clientHeight].map((x) => Math.max(1, Math.round(ratio * x)));
    if (canvas.width !== size[0] || canvas.height !== size[1]) {
      [canvas.width, canvas.height] = size;
    }
    const cells = this.cells();
    this.camera.view ??= fitted(this.world.bounds(), cells[0].width / cells[0].height);
    this.seen = cameraOf(this.camera.view, this.reach);
    if (world.dirty) {
      world.models.forEach((model) => { model.rows = world.rows(model); });
      world.dirty = false;
    }
    let meshes = 0, spheres = 0, triangles = 0;
    cells.forEach((cell, m) => {
      const model = world.models[m], all = world.parts(model);
      const parts = renderer.chosen(all, this.seen, cell.width / cell.height,
        moving ? this.triangles / cells.length : Infinity);
      const rows = world.layers.spheres ? model.rows : NO_ROWS;
      if (rows !== this.rows) {
        this.rows = rows;
        renderer.setSpheres(rows);
      }
      renderer.draw(this.seen, parts, world.layers.spheres && all.length > 0 && model.rows.length > 0
        ? world.through : "none", { x: Math.round(ratio * cell.x),
        y: Math.round(size[1] - ratio * (cell.y + cell.height)), width: Math.round(ratio * cell.width),
        height: Math.round(ratio * cell.height) });
      meshes += all.length;
      triangles += parts.reduce((sum, { drawn }) => sum + drawn.triangles, 0);
      spheres += renderer.spheres.count;
    });
    Object.assign(canvas.dataset, { meshes, spheres, triangles, frames: Number(canvas.dataset.frames ?? 0) + 1 });
    canvas.dataset.picture = moving ? "moving" : "final";
    this.overlay(cells);
  }

  /// Learns from the time between pictures of a movement how coarse they have to be to take less than 1/30 s: fewer
  /// triangles and fewer pixels.
  adapt(time, moving) {
    const passed = time - this.last;
    if (moving && this.last && passed < 2000) {
      this.took = 0.7 * this.took + 0.3 * passed;
      if (this.took > 30) {
        this.triangles *= 0.6;
        this.fast = Math.max(0.4, this.fast * (this.took > 100 ? 0.75 : 0.92));
      } else if (this.took < 19 && this.fast < 1) {
        this.fast = Math.min(1, this.fast * 1.04);
      } else if (this.took < 19) {
        this.triangles = Math.min(1e8, this.triangles * 1.1 + 1000);
      }
    }
    this.last = moving ? time : 0;
  }

  /// Returns a point of the root frame in pixels of a cell's page area.
  project(point, cell) {
    const { right, up, target, height } = this.seen, d = point.map((x, i) => x - target[i]);
    const scale = cell.height / height;
    return [cell.x + cell.width / 2 + scale * Vector.dot(d, right), cell.y + cell.height / 2 - scale * Vector.dot(d, up)];
  }

  /// Returns {model, origin, direction, scale: pixels of a metre} under a place of the canvas.
  ray(x, y) {
    const cells = this.cells(), m = cells.findIndex((c) => x >= c.x && x < c.x + c.width && y >= c.y && y < c.y + c.height);
    const cell = cells[Math.max(m, 0)], { right, up, back, target, height } = this.seen, scale = cell.height / height;
    const across = (x - cell.x - cell.width / 2) / scale, upwards = -(y - cell.y - cell.height / 2) / scale;
    return { model: Math.max(m, 0), direction: back.map((b) => -b), scale,
      origin: target.map((t, i) => t + across * right[i] + upwards * up[i] + this.reach * back[i]) };
  }

  overlay(cells) {
    const { world } = this, overlay = find("overlay"), captions = find("captions");
    overlay.replaceChildren();
    captions.replaceChildren();
    cells.forEach((cell, m) => {
      const model = world.models[m];
      if (cells.length > 1) {
        const caption = node("span", { className: m === world.active ? "active" : "" },
          `${model.name || world.robotOf(model).name} · ${counted(world.count(model), "sphere")}`);
        caption.style.left = `${cell.x + 8}px`;
        caption.style.top = `${cell.y + 8}px`;
        captions.append(caption);
      }
      this.drawNearest(model, cell, overlay);
      this.drawWitnesses(model, cell, overlay);
    });
    this.drawSelected(cells, overlay);
  }

  drawNearest(model, cell, overlay) {
    const nearest = model.found?.nearest;
    if (!nearest || nearest.distance <= 0 || !this.world.layers.spheres) {
      return;
    }
    const along = Vector.unit([0, 1, 2].map((i) => nearest.to[i] - nearest.from[i]));
    const ends = [[nearest.from, 1], [nearest.to, -1]].map(([ball, sign]) =>
      this.project(ball.slice(0, 3).map((x, i) => x + sign * ball[3] * along[i]), cell));
    overlay.append(drawn("line", { class: "nearest", x1: ends[0][0], y1: ends[0][1], x2: ends[1][0], y2: ends[1][1] }));
    for (const [cx, cy] of ends) {
      overlay.append(drawn("circle", { class: "end", cx, cy, r: 2.5 }));
    }
  }

  drawWitnesses(model, cell, overlay) {
    const robot = this.world.robotOf(model);
    (model.verdicts ?? []).forEach((verdict, l) => {
      if (verdict && !verdict.holds && model.links[l].length > 0 && robot.shown.has(l)) {
        const [cx, cy] = this.project(moved(robot.placed[l], verdict.witness), cell);
        overlay.append(drawn("circle", { class: "witness", cx, cy, r: 4.5 }));
      }
    });
  }

  drawSelected(cells, overlay) {
    const { world } = this, element = world.element;
    if (!element) {
      return;
    }
    const { model, link } = world.selected, cell = cells[model], kind = KINDS[element.kind];
    const [cx, cy] = this.project(moved(world.robotOf(world.models[model]).placed[link], kind.centre(element.row)), cell);
    const r = kind.radius(element.row) * cell.height / this.seen.height;
    overlay.append(drawn("circle", { class: `ring ${element.pinned ? "pinned" : "loose"}`, cx, cy, r }));
    if (world.edits) {
      const s = Math.SQRT1_2;
      overlay.append(drawn("circle", { class: "handle", cx: cx + s * r, cy: cy - s * r, r: 5 }));
    }
  }
}
