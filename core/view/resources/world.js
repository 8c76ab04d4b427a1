// What the page shows, and what is chosen: robots in poses, models with their elements, layers, colours.

const TOUCHING = [0.86, 0.16, 0.13];

class World {
  /// `changed(what)` is called after every change: "view" for what is drawn only, else the part that changed.
  constructor(scene, changed) {
    this.scene = scene;
    this.changed = changed;
    this.session = scene.session;
    this.robots = scene.robots.map((robot) => ({ ...robot, shown: new Set(robot.links.keys()),
      configuration: robot.poses[0]?.values.slice() ?? [] }));
    this.robots.forEach((robot) => this.place(robot));
    this.models = scene.models.map((model, m) => this.modelOf(model, m));
    this.active = 0;
    this.selected = null;   // {model, link, index}
    this.link = null;       // the link that is edited
    const any = (of) => this.robots.some((robot) => robot.links.some((link) => link[of].length > 0));
    const spheres = this.models.some((model) => model.links.some((link) => link.length > 0));
    this.layers = { visuals: any("visuals"), collisions: !any("visuals") && any("collisions"), spheres: true };
    this.through = spheres ? "geometry" : "none";
    this.colour = "link";
    this.dirty = true;
  }

  modelOf(model, m) {
    const made = { ...model, step: model.at, weights: [], verdicts: model.steps[model.at].verdicts, ignored: null };
    made.links = this.elementsOf(made, model.at);
    const links = this.session?.links[m] ?? [];
    made.weights = links.map((link) => link.weight);
    links.forEach((link, l) => made.links[l].forEach((element, i) => { element.pinned = link.pinned[i]; }));
    if (model.ignored) {
      this.ignore(made, model.ignored);
    }
    return made;
  }

  /// The elements of each link in one step of a model.
  elementsOf(model, step) {
    const { elements, protrusions } = model.steps[step];
    const protruding = protrusions && this.scene.array(protrusions, Float64Array);
    const links = this.robots[model.robot].links.map(() => []);
    for (const { kind, starts, rows } of elements) {
      const first = this.scene.array(starts, Uint32Array), numbers = this.scene.array(rows, Float64Array);
      const width = KINDS[kind].numbers.length;
      links.forEach((link, l) => {
        for (let i = first[l]; i < first[l + 1]; ++i) {
          link.push({ kind, row: Array.from(numbers.subarray(width * i, width * (i + 1))), pinned: false,
            protrusion: protruding ? protruding[i] : null });
        }
      });
    }
    return links;
  }

  ignore(model, pairs) {
    const links = model.links.length;
    model.ignored = new Set(pairs.map(([a, b]) => a * links + b));
  }

  place(robot) {
    robot.placed = robot.joints.length > 0 ? linkPoses(robot, robot.configuration) : robot.links.map(() => UNMOVED);
  }

  get model() { return this.models[this.active]; }
  get robot() { return this.robots[this.model.robot]; }
  get edits() { return this.session !== null; }
  robotOf(model) { return this.robots[model.robot]; }
  count(model = this.model) { return model.links.reduce((sum, link) => sum + link.length, 0); }

  touch(what) {
    this.dirty = true;
    this.changed(what);
  }

  pose(robot, configuration) {
    robot.configuration = configuration.slice();
    this.place(robot);
    this.touch("pose");
  }

  select(selected) {
    this.selected = selected;
    if (selected) {
      this.active = selected.model;
      this.link = selected.link;
    }
    this.touch("selection");
  }

  get element() {
    const s = this.selected;
    return s ? this.models[s.model].links[s.link][s.index] ?? null : null;
  }

  /// Who touches in a model; null while the pairs that need no check are not known.
  contacts(model) {
    if (!model.ignored) {
      return null;
    }
    if (model.links.every((link) => link.length === 0)) {
      return { touching: [], nearest: null };
    }
    return contactsOf(model.links, this.robotOf(model).placed, model.ignored);
  }

  /// The least and the largest number of what colours the spheres, over all models; null without one.
  range() {
    if (this.colour === "link") {
      return null;
    }
    let least = Infinity, most = 0;
    for (const model of this.models) {
      for (const link of model.links) {
        for (const { kind, row, protrusion } of link) {
          const value = this.colour === "radius" ? KINDS[kind].radius(row) : protrusion;
          if (value !== null && Number.isFinite(value)) {
            least = Math.min(least, value);
            most = Math.max(most, value);
          }
        }
      }
    }
    return least <= most ? { least: this.colour === "protrusion" ? 0 : least, most } : null;
  }

  tint(element, link, range) {
    if (!range) {
      return this.hues[link % HUES.length];
    }
    const value = this.colour === "radius" ? KINDS[element.kind].radius(element.row) : element.protrusion;
    return value === null || !Number.isFinite(value) ? GREY : viridis(range.most > range.least
      ? (value - range.least) / (range.most - range.least) : 0.5);
  }

  get hues() { return this.tints ??= HUES.map(rgb); }

  /// Rows of a model's spheres for the renderer, in the root link's frame.
  rows(model) {
    const robot = this.robotOf(model), range = this.range(), red = new Set(), links = model.links.length;
    model.found = this.contacts(model);
    for (const { a, b, elements } of model.found?.touching ?? []) {
      for (const [i, j] of elements) {
        red.add(a + links * i).add(b + links * j);
      }
    }
    const rows = new Float32Array(NUMBERS_OF_SPHERE * this.count(model));
    let at = 0;
    model.links.forEach((link, l) => {
      if (!robot.shown.has(l)) {
        return;
      }
      link.forEach((element, i) => {
        const centre = moved(robot.placed[l], element.row);
        const colour = red.has(l + links * i) ? TOUCHING : this.tint(element, l, range);
        rows.set([...centre, element.row[3], ...colour], at);
        at += NUMBERS_OF_SPHERE;
      });
    });
    return rows.subarray(0, at);
  }

  /// The meshes of a model's robot for the renderer.
  parts(model) {
    const robot = this.robotOf(model), parts = [];
    robot.links.forEach((link, l) => {
      if (!robot.shown.has(l)) {
        return;
      }
      for (const layer of ["visuals", "collisions"]) {
        for (const { mesh, pose, colour } of this.layers[layer] ? link[layer] : []) {
          parts.push({ link: l, mesh, pose: composed(robot.placed[l], pose), colour: colour && rgb(colour) });
        }
      }
    });
    return parts;
  }

  /// The box of everything, with all robots at one place; m.
  bounds(links = null) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const add = (p, r) => p.forEach((x, i) => {
      low[i] = Math.min(low[i], x - r);
      high[i] = Math.max(high[i], x + r);
    });
    const box = (pose, ends) => {
      for (let k = 0; k < 8; ++k) {
        add(moved(pose, [0, 1, 2].map((i) => ends[k >> i & 1][i])), 0);
      }
    };
    for (const model of this.models) {
      const robot = this.robotOf(model);
      robot.links.forEach((link, l) => {
        if (links && !links.has(l)) {
          return;
        }
        for (const { mesh, pose } of [...link.visuals, ...link.collisions]) {
          box(composed(robot.placed[l], pose), this.scene.meshes[mesh].box);
        }
        for (const { kind, row } of model.links[l]) {
          add(moved(robot.placed[l], KINDS[kind].centre(row)), KINDS[kind].radius(row));
        }
      });
    }
    return low[0] <= high[0] ? { low, high } : { low: [-1, -1, -1], high: [1, 1, 1] };
  }
}
