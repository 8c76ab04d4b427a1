// Sliders of the joints, and poses by name.

class JointPanel {
  constructor(world) {
    this.world = world;
    find("pose").addEventListener("change", (event) => {
      const pose = world.robot.poses[Number(event.target.value)];
      if (pose) {
        world.pose(world.robot, pose.values);
      }
    });
  }

  show() {
    const { world } = this, { robot } = world;
    find("joints").hidden = robot.freedoms.length === 0;
    if (this.robot === robot) {
      this.values();
      return;
    }
    this.robot = robot;
    find("pose").replaceChildren(...robot.poses.map((pose, i) => node("option", { value: i }, pose.name)),
      node("option", { value: "own", hidden: true }, "own"));
    this.sliders = robot.freedoms.map((freedom, f) => this.slider(freedom, f));
    find("sliders").replaceChildren(...this.sliders.map(({ row }) => row));
    this.values();
  }

  slider(freedom, f) {
    const id = `joint-${f}`, input = node("input", { type: "range", id, min: freedom.lower, max: freedom.upper,
      step: (freedom.upper - freedom.lower) / 1000 || "any" });
    const output = node("output", { htmlFor: id });
    input.addEventListener("input", () => {
      const configuration = this.robot.configuration.slice();
      configuration[f] = input.valueAsNumber;
      this.world.pose(this.robot, configuration);
    });
    return { input, output, row: node("div", {}, node("label", { htmlFor: id, title: freedom.joint }, freedom.joint),
      output, input) };
  }

  values() {
    const { robot } = this;
    robot.freedoms.forEach((freedom, f) => {
      const value = robot.configuration[f], { input, output } = this.sliders[f];
      input.value = value;
      output.textContent = freedom.turns ? `${(180 / Math.PI * value).toFixed(1)}°` : millimetres(value);
    });
    const pose = robot.poses.findIndex(({ values }) => values.every((v, f) => Math.abs(v - robot.configuration[f]) < 1e-9));
    find("pose").value = pose < 0 ? "own" : pose;
  }
}
