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

  // Viridis (Smith and van der Walt, 2015), and the hues of Okabe and Ito (2008).
  const VIRIDIS = ["#440154", "#443983", "#31688e", "#21918c", "#35b779", "#90d743", "#fde725"];
  const HUES = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#b8a800", "#7a6fd0"];
  const GREY = [0.72, 0.74, 0.77];
  const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
  const viridis = (t) => {
    const at = Math.min(Math.max(t, 0), 1) * (VIRIDIS.length - 1), i = Math.min(Math.floor(at), VIRIDIS.length - 2);
    const [low, high] = [rgb(VIRIDIS[i]), rgb(VIRIDIS[i + 1])];
    return low.map((x, k) => x + (at - i) * (high[k] - x));
  };

  const levels = scene.links.map((link) => link.levels.map((level) => decoded(level, Float32Array)));
  const deepest = Math.max(...levels.map((l) => l.length)) - 1;
  const levelOf = (link, level) => levels[link][Math.min(level, levels[link].length - 1)];
  const radii = levels.flatMap((l) => Array.from(l.at(-1)).filter((_, i) => i % 4 === 3));
  const [least, most] = radii.reduce(([a, b], r) => [Math.min(a, r), Math.max(b, r)], [Infinity, 0]);
  const tintOf = (by, link, radius) => (by === "link" ? rgb(HUES[link % HUES.length])
    : viridis(most > least ? (radius - least) / (most - least) : 0.5));

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

  /// Seen from `azimuth` around z and `elevation` above the ground; radians.
  const cameraOf = ({ azimuth, elevation, target, height }, depth) => {
    const back = [Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth),
      Math.sin(elevation)];
    const right = [-Math.sin(azimuth), Math.cos(azimuth), 0];
    return { right, back, up: Vector.cross(back, right), target, height, depth };
  };

  /// The whole box in sight.
  const fitted = ({ low, high }, aspect) => {
    const size = high.map((x, i) => x - low[i]), target = high.map((x, i) => (x + low[i]) / 2);
    const view = { azimuth: 0.7, elevation: 0.35, target, height: 1 };
    const { right, up } = cameraOf(view, 1);
    const extent = (axis) => axis.reduce((sum, x, i) => sum + Math.abs(x) * size[i], 0);
    view.height = 1.08 * Math.max(extent(up), extent(right) / aspect) || 1;
    return view;
  };

  const all = scene.links.map((_, i) => i);
  const world = boundsOf(all, (l) => scene.links[l].pose);
  const reach = 2 * Math.hypot(...world.high.map((x, i) => x - world.low[i])) || 1;
  const shown = new Set(all);
  const state = { spheres: true, geometry: true, level: deepest, colour: "radius",
    clear: document.querySelector("input[name=clear]:checked").value, view: null };

  const sized = (target) => {
    // Twice as fine as the screen: the outlines of spheres are smoothed by the browser's scaling.
    const ratio = Math.max(2, window.devicePixelRatio || 1), box = target.getBoundingClientRect();
    return [Math.max(1, Math.round(box.width * ratio)), Math.max(1, Math.round(box.height * ratio))];
  };
  const aspectOf = (target) => { const [width, height] = sized(target); return width / height; };

  const draw = () => {
    [canvas.width, canvas.height] = sized(canvas);
    state.view ??= fitted(world, aspectOf(canvas));
    const links = all.filter((l) => shown.has(l));
    renderer.setSpheres(state.spheres
      ? links.flatMap((l) => rowsOf(l, state.level, scene.links[l].pose, state.colour)) : []);
    const parts = state.geometry
      ? links.map((l) => ({ mesh: scene.links[l].meshes[0], pose: scene.links[l].pose, colour: GREY })) : [];
    // Nothing but geometry is not seen through.
    renderer.draw(cameraOf(state.view, reach), parts, state.spheres ? state.clear : "none");
    canvas.dataset.links = links.length;
    canvas.dataset.spheres = renderer.spheres.count;
    canvas.dataset.meshes = parts.length;
  };

  let waiting = false;
  const redraw = () => {
    if (!waiting) {
      waiting = true;
      requestAnimationFrame(() => { waiting = false; draw(); });
    }
  };

  // ---- from where

  const turn = (dx, dy) => {
    state.view.azimuth -= dx;
    state.view.elevation = Math.min(Math.max(state.view.elevation + dy, -Math.PI / 2), Math.PI / 2);
    redraw();
  };
  /// By shares of the picture's height.
  const pan = (dx, dy) => {
    const { right, up } = cameraOf(state.view, 1), h = state.view.height;
    state.view.target = state.view.target.map((x, i) => x - h * (dx * right[i] - dy * up[i]));
    redraw();
  };
  const zoom = (factor) => {
    state.view.height = Math.min(Math.max(state.view.height * factor, reach * 1e-4), reach * 10);
    redraw();
  };
  const reset = () => { state.view = null; redraw(); };

  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, size: Math.hypot(a.x - b.x, a.y - b.y) || 1 };
  };
  canvas.addEventListener("pointerdown", (event) => {
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) {
      return;
    }
    const pixels = canvas.clientHeight, before = pointers.size === 2 ? spread() : null;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (before) {
      const now = spread();
      pan((now.x - before.x) / pixels, (now.y - before.y) / pixels);
      zoom(before.size / now.size);
    } else if (pointers.size === 1) {
      const dx = event.clientX - last.x, dy = event.clientY - last.y;
      if (event.shiftKey || event.buttons & 6) {
        pan(dx / pixels, dy / pixels);
      } else {
        turn(dx / 150, dy / 150);
      }
    }
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) / 500));
  }, { passive: false });
  canvas.addEventListener("dblclick", reset);

  const KEYS = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) {
      return;
    }
    const step = KEYS[event.key];
    if (step) {
      (event.shiftKey ? () => pan(0.05 * step[0], 0.05 * step[1]) : () => turn(-0.1 * step[0], 0.1 * step[1]))();
    } else if (event.key === "+" || event.key === "=") {
      zoom(1 / 1.1);
    } else if (event.key === "-") {
      zoom(1.1);
    } else if (event.key === "0") {
      reset();
    } else {
      return;
    }
    event.preventDefault();
  });

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
    [least, most].map((radius) => `${(1000 * radius).toFixed(radius < 0.01 ? 2 : 0)} mm`);
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
  find("reset-view").addEventListener("click", reset);
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
      state.view = fitted(boundsOf([link], (l) => scene.links[l].pose), aspectOf(canvas));
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
