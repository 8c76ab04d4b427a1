// What is shown of the models: layers, colours, and the number of spheres.

const LAYERS = [["visuals", "visual"], ["collisions", "collision"], ["spheres", "spheres"]];
const THROUGH = [["geometry", "meshes"], ["spheres", "spheres"], ["none", "nothing"]];
const COLOURS = [["link", "link"], ["radius", "radius"], ["protrusion", "protrusion"]];

class ModelPanel {
  constructor(world, edits) {
    Object.assign(this, { world, edits });
    find("layers").append(...choices("checkbox", "layer", LAYERS, (layer) => world.layers[layer], (layer, on) => {
      world.layers[layer] = on;
      world.touch("view");
    }));
    find("through").append("See through", ...choices("radio", "through", THROUGH, (way) => way === world.through, (way) => {
      world.through = way;
      world.touch("view");
    }));
    find("colours").append("Colour by", ...choices("radio", "colour", COLOURS, (by) => by === world.colour, async (by) => {
      world.colour = by;
      if (by === "protrusion") {
        await edits.protrusions();
      }
      world.touch("colour");
    }));
    if (world.models.length > 1) {
      find("model-choice").append(node("label", { htmlFor: "model" }, "Model"), node("select", { id: "model" },
        ...world.models.map((model, m) => node("option", { value: m }, model.name || world.robotOf(model).name))));
      find("model").addEventListener("change", (event) => {
        world.active = Number(event.target.value);
        world.selected = null;
        world.link = null;
        world.touch("model");
      });
    }
    find("count").addEventListener("input", () => this.slid(false));
    find("count").addEventListener("change", () => this.slid(true));
  }

  /// The numbers of spheres that the slider goes through.
  counts() {
    const { world } = this;
    return world.edits ? world.session.counts[world.model.robot] : world.model.steps.map(({ count }) => count);
  }

  /// A page that is one file has the spheres of each number; a session searches when the slider is let go.
  slid(end) {
    const { world } = this, at = Number(find("count").value), counts = this.counts();
    find("count-text").textContent = counts[at];
    if (!world.edits) {
      world.model.step = at;
      world.model.links = world.elementsOf(world.model, at);
      world.model.verdicts = world.model.steps[at].verdicts;
      world.selected = null;
      world.touch("count");
    } else if (end) {
      this.edits.count(counts[at]);
    }
  }

  show() {
    const { world } = this, counts = this.counts(), now = world.count();
    find("count-row").hidden = counts.length < 2;
    const above = counts.findIndex((count) => count >= now);
    Object.assign(find("count"), { max: counts.length - 1 });
    find("count").value = world.edits ? (above < 0 ? counts.length - 1 : above) : world.model.step;
    find("count-text").textContent = now;
    if (find("model")) {
      find("model").value = world.active;
    }
    const range = world.range(), scale = find("scale");
    scale.hidden = !range;
    if (range) {
      [scale.firstElementChild.textContent, scale.lastElementChild.textContent] =
        [range.least, range.most].map(millimetres);
    }
    const known = world.robots.some((robot) => robot.judged);
    document.querySelector("input[name=colour][value=protrusion]").disabled = !known
      || (!world.edits && !world.models.some((model) => model.steps.some(({ protrusions }) => protrusions)));
  }
}
