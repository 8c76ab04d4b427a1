// The view of the robot: what is shown, and from where; the pictures of each link after each stage.
"use strict";

(() => {
  const find = (id) => document.getElementById(id);
  const canvas = find("viewer"), message = find("viewer-message");
  if (!canvas) {
    return;
  }
  const scene = JSON.parse(find("scene").textContent);
  let renderer;
  try {
    renderer = new Renderer(canvas, scene);
  } catch (error) {
    message.textContent = `There is no 3-D view: ${error.message}. All figures are in the tables below.`;
    canvas.dataset.error = error.message;
    document.querySelector("#view details")?.setAttribute("open", "");
    return;
  }

  const levels = scene.links.map((link) => link.levels.map((level) => decoded(level, Float32Array)));
  const deepest = Math.max(...levels.map((l) => l.length)) - 1;
  const levelOf = (link, level) => levels[link][Math.min(level, levels[link].length - 1)];
  const radii = levels.flatMap((l) => Array.from(l.at(-1)).filter((_, i) => i % 4 === 3));
  const [least, most] = radii.reduce(([a, b], r) => [Math.min(a, r), Math.max(b, r)], [Infinity, 0]);
  const tintOf = (by, link, radius) => (by === "link" ? rgb(HUES[link % HUES.length])
    : viridis(most > least ? (radius - least) / (most - least) : 0.5));

  /// Elements of other kinds than sphere, as meshes.
  const elementsOf = (link, level) => {
    const list = scene.links[link].elements ?? [];
    return list.length ? list[Math.min(level, list.length - 1)] : [];
  };

  const rowsOf = (link, level, pose, by) => {
    const spheres = levelOf(link, level), rows = [];
    for (let i = 0; i < spheres.length; i += 4) {
      rows.push(...moved(pose, spheres.subarray(i, i + 3)), spheres[i + 3], ...tintOf(by, link, spheres[i + 3]));
    }
    return rows;
  };

  /// Box of the spheres (finest level) and first meshes of some links.
  const boundsOf = (links, poseOf) => {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const add = (p, r) => p.forEach((x, i) => {
      low[i] = Math.min(low[i], x - r);
      high[i] = Math.max(high[i], x + r);
    });
    for (const l of links) {
      const spheres = levels[l].at(-1), mesh = scene.meshes[scene.links[l].meshes[0]];
      for (let i = 0; i < spheres.length; i += 4) {
        add(moved(poseOf(l), spheres.subarray(i, i + 3)), spheres[i + 3]);
      }
      const corners = decoded(mesh.corners, Uint16Array);
      for (let i = 0; i < corners.length; i += 3) {
        add(moved(poseOf(l), mesh.low.map((x, k) => x + mesh.step * corners[i + k])), 0);
      }
    }
    return { low, high };
  };

  const all = scene.links.map((_, i) => i);
  const world = boundsOf(all, (l) => scene.links[l].pose);
  const reach = 2 * Math.hypot(...world.high.map((x, i) => x - world.low[i])) || 1;
  const shown = new Set(all);
  const state = { spheres: true, geometry: true, level: deepest, colour: "radius",
    clear: document.querySelector("input[name=clear]:checked").value };

  const sized = (target) => {
    // Twice as fine as the screen: the outlines of spheres are smoothed by the browser's scaling.
    const ratio = Math.max(2, window.devicePixelRatio || 1), box = target.getBoundingClientRect();
    return [Math.max(1, Math.round(box.width * ratio)), Math.max(1, Math.round(box.height * ratio))];
  };
  const aspectOf = (target) => { const [width, height] = sized(target); return width / height; };

  const draw = () => {
    [canvas.width, canvas.height] = sized(canvas);
    camera.view ??= fitted(world, aspectOf(canvas));
    const links = all.filter((l) => shown.has(l));
    renderer.setSpheres(state.spheres
      ? links.flatMap((l) => rowsOf(l, state.level, scene.links[l].pose, state.colour)) : []);
    const parts = state.geometry
      ? links.map((l) => ({ mesh: scene.links[l].meshes[0], pose: scene.links[l].pose, colour: GREY })) : [];
    renderer.setElements(state.spheres ? links.flatMap((l) => elementsOf(l, state.level).map(({ mesh }) => (
      { mesh, pose: scene.links[l].pose, colour: rgb(HUES[l % HUES.length]) }))) : []);
    // Nothing but geometry is not seen through.
    renderer.draw(cameraOf(camera.view, reach), parts, state.spheres ? state.clear : "none");
    canvas.dataset.links = links.length;
    canvas.dataset.spheres = renderer.spheres.count;
    canvas.dataset.meshes = parts.length;
    canvas.dataset.elements = renderer.elements.length;
  };

  let waiting = false;
  const redraw = () => {
    if (!waiting) {
      waiting = true;
      requestAnimationFrame(() => { waiting = false; draw(); });
    }
  };

  const camera = new Camera(canvas, reach, redraw);

  // ---- what

  const boxes = scene.links.map((link, l) => {
    const label = document.createElement("label"), box = document.createElement("input");
    const swatch = document.createElement("span");
    box.type = "checkbox";
    box.checked = true;
    swatch.className = "swatch";
    swatch.style.background = HUES[l % HUES.length];
    swatch.hidden = true;
    box.addEventListener("change", () => { box.checked ? shown.add(l) : shown.delete(l); redraw(); });
    label.append(box, swatch, link.name);
    find("link-list").append(label);
    return { box, swatch };
  });
  const scale = find("radius-scale");
  [scale.firstElementChild.textContent, scale.lastElementChild.textContent] =
    [least, most].map((radius) => radii.length === 0 ? "" : `${(1000 * radius).toFixed(radius < 0.01 ? 2 : 0)} mm`);
  const showLinks = (wanted) => {
    shown.clear();
    boxes.forEach(({ box }, l) => {
      box.checked = wanted(l);
      box.checked && shown.add(l);
    });
    redraw();
  };
  find("all-links").addEventListener("click", () => showLinks(() => true));
  find("no-links").addEventListener("click", () => showLinks(() => false));
  find("reset-view").addEventListener("click", () => camera.reset());
  for (const what of ["spheres", "geometry"]) {
    find(`show-${what}`).addEventListener("change", (event) => { state[what] = event.target.checked; redraw(); });
  }
  for (const choice of document.querySelectorAll("input[name=clear], input[name=colour]")) {
    choice.addEventListener("change", () => {
      state[choice.name] = choice.value;
      boxes.forEach(({ swatch }) => { swatch.hidden = state.colour !== "link"; });
      scale.hidden = state.colour === "link";
      redraw();
    });
  }
  find("level")?.addEventListener("input", (event) => {
    state.level = Number(event.target.value);
    find("level-text").textContent = state.level === deepest ? "finest" : `${state.level}`;
    redraw();
  });

  /// The names in the table of figures lead to the link alone.
  for (const row of document.querySelectorAll("#links tr[data-link]")) {
    const link = scene.links.findIndex(({ name }) => name === row.dataset.link);
    const head = row.cells[0], button = document.createElement("button");
    if (link < 0) {
      continue;
    }
    button.type = "button";
    button.title = "Show this link alone";
    button.append(...head.childNodes);
    button.addEventListener("click", () => {
      showLinks((l) => l === link);
      camera.view = fitted(boundsOf([link], (l) => scene.links[l].pose), aspectOf(canvas));
      find("view").scrollIntoView();
      canvas.focus({ preventScroll: true });
    });
    head.append(button);
  }

  // ---- each link after each stage: drawn by the same renderer, copied into small canvases when they come into sight

  const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
  const drawFrame = (frame) => {
    const link = Number(frame.dataset.link), shows = frame.dataset.shows;
    [frame.width, frame.height] = sized(frame);
    [canvas.width, canvas.height] = [frame.width, frame.height];
    const view = fitted(boundsOf([link], () => IDENTITY), frame.width / frame.height);
    renderer.setSpheres(shows === "spheres" ? rowsOf(link, deepest, IDENTITY, "radius") : []);
    renderer.setElements(shows !== "spheres" ? [] : elementsOf(link, deepest).map(({ mesh }) => (
      { mesh, pose: IDENTITY, colour: rgb(HUES[link % HUES.length]) })));
    const parts = shows === "spheres" ? []
      : [{ mesh: scene.links[link].meshes[Number(shows)], pose: IDENTITY, colour: GREY }];
    renderer.draw(cameraOf(view, 4 * view.height), parts, "none");
    frame.getContext("2d").drawImage(canvas, 0, 0);
    frame.dataset.drawn = "yes";
  };
  const frames = [...document.querySelectorAll(".strip canvas")];
  const drawFrames = (some) => {
    some.filter((frame) => !frame.dataset.drawn).forEach(drawFrame);
    draw();
  };

  canvas.hidden = false;
  message.hidden = true;
  document.querySelector(".controls").hidden = false;
  if (scene.drawn < 1) {
    find("viewer-detail").textContent =
      `Drawn with ${Math.max(1, Math.round(100 * scene.drawn))} % of the triangles; all figures are of all of them.`;
  }
  draw();
  const watch = new IntersectionObserver((entries) => {
    const seen = entries.filter((entry) => entry.isIntersecting).map((entry) => entry.target);
    if (seen.length > 0) {
      drawFrames(seen);
      seen.forEach((frame) => watch.unobserve(frame));
    }
  }, { rootMargin: "200px" });
  frames.forEach((frame) => watch.observe(frame));
  window.addEventListener("beforeprint", () => drawFrames(frames));
  new ResizeObserver(redraw).observe(canvas);
  canvas.addEventListener("webglcontextlost", () => {
    canvas.hidden = true;
    message.hidden = false;
    message.textContent = "The graphics driver gave up the 3-D view; reload the page to see it again.";
  });
  canvas.dataset.ready = "yes";
})();
