// The page: from the scene to panels that follow what is chosen.

const told = (text) => {
  find("told").hidden = text === "";
  find("told").textContent = text;
};

const themes = () => {
  const names = ["system", "light", "dark"], root = document.documentElement;
  find("theme").addEventListener("click", () => {
    const next = names[(names.indexOf(root.dataset.theme ?? "system") + 1) % names.length];
    next === "system" ? delete root.dataset.theme : root.dataset.theme = next;
    find("theme").textContent = `Theme: ${next}`;
  });
};

/// What the page is about.
const head = (world) => {
  const robots = world.robots.map((robot) => robot.name), files = world.models.map(({ name }) => name).filter((n) => n);
  document.title = `${robots[0]} – foam view`;
  find("title").textContent = robots.join(", ");
  const links = world.robot.links.length;
  find("subtitle").textContent = [counted(links, "link"), ...files].join(" · ");
  find("foot").textContent = `foam ${world.scene.foam}`;
  find("notes").hidden = world.scene.notes.length === 0;
  find("notes").lastElementChild.append(...world.scene.notes.map((text) => node("li", {}, text)));
};

const start = async () => {
  const canvas = find("view"), loading = loaded("scene");
  loading.catch(() => {});   // it is awaited next
  const renderer = new RobotRenderer(canvas), scene = await loading;
  let stage = null, panels = [];
  const world = new World(scene, (what) => {
    what === "pose" || what === "drag" ? stage.move() : stage.draw();
    requestAnimationFrame(() => panels.forEach((panel) => panel.show()));
  });
  const session = new SessionLink(world, told), edits = new Edits(world, session, told);
  let selection = null;
  stage = new Stage(world, canvas, renderer, (event) => selection.take(event));
  selection = new SelectionPanel(world, stage, edits);
  panels = [new ModelPanel(world, edits), new JointPanel(world), new LinkPanel(world), new ContactPanel(world), selection,
    edits];
  new SavePanel(world, session);
  head(world);
  themes();
  find("reset").addEventListener("click", () => stage.camera.reset());
  find("message").hidden = true;
  find("panel").hidden = false;
  stage.render(true);
  panels.forEach((panel) => panel.show());
  canvas.dataset.ready = Math.round(performance.now());
  canvas.addEventListener("webglcontextlost", () => told("The graphics driver gave up the picture; reload the page."));
  stage.refine(await loaded("meshes"));
  if (world.edits) {
    for (const m of world.models.keys()) {
      await session.learn(m);
    }
  }
};

start().catch((error) => {
  find("message").hidden = false;
  find("message").textContent = `There is no picture: ${error.message}.`;
  find("view").dataset.error = error.message;
});
