// Writing the model as a file, in the folder where foam view was started.

class SavePanel {
  constructor(world, session) {
    Object.assign(this, { world, session });
    if (!world.edits) {
      return;
    }
    find("save").hidden = false;
    find("format").append(...world.session.formats.map(({ name, reader }) =>
      node("option", { value: name }, reader ? `${name} – ${reader}` : name)));
    find("format").value = world.session.formats.some(({ name }) => name === "urdf") ? "urdf" : "recipe";
    find("format").addEventListener("change", () => this.name());
    find("save-button").addEventListener("click", () => this.save());
    find("file").addEventListener("keydown", (event) => event.key === "Enter" && this.save());
    this.name();
  }

  /// Proposes a file name.
  name() {
    const { world } = this, format = world.session.formats.find(({ name }) => name === find("format").value);
    const stem = (world.robot.file || world.robot.name).replace(/\.[^.]*$/, "").replace(/[^A-Za-z0-9_-]/g, "_");
    find("file").value = `${stem}_edited.${format.extension}`;
  }

  async save() {
    const told = find("saved");
    try {
      told.className = "";
      told.textContent = "Saving …";
      const { files, statement } = await this.session.ask("save", { model: this.world.active,
        format: find("format").value, file: find("file").value, replace: find("replace").checked });
      told.textContent = `Written: ${files.join(", ")}. ${statement[0].toUpperCase()}${statement.slice(1)}.`;
    } catch (error) {
      told.className = "no";
      told.textContent = error.message;
    }
  }
}
