// Where a scene is seen from, in a parallel projection: turned, moved and zoomed by pointers, wheel and keys.
"use strict";

/// The camera of a renderer, seen from `azimuth` around z and `elevation` above the ground; radians.
const cameraOf = ({ azimuth, elevation, target, height }, depth) => {
  const back = [Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth),
    Math.sin(elevation)];
  const right = [-Math.sin(azimuth), Math.cos(azimuth), 0];
  return { right, back, up: Vector.cross(back, right), target, height, depth };
};

/// The view that has the whole box in sight.
const fitted = ({ low, high }, aspect) => {
  const size = high.map((x, i) => x - low[i]), target = high.map((x, i) => (x + low[i]) / 2);
  const view = { azimuth: 0.7, elevation: 0.35, target, height: 1 };
  const { right, up } = cameraOf(view, 1);
  const extent = (axis) => axis.reduce((sum, x, i) => sum + Math.abs(x) * size[i], 0);
  view.height = 1.08 * Math.max(extent(up), extent(right) / aspect) || 1;
  return view;
};

/// `reach`: the size of the scene, m. `moved`: called after each change of `view`, which is null until somebody sets it
/// and after reset(). `heightOf`: of what is drawn, in pixels of the page. `taken(event)`: whether a pressed pointer is
/// somebody else's.
class Camera {
  constructor(canvas, reach, moved, { heightOf = () => canvas.clientHeight, taken = () => false } = {}) {
    Object.assign(this, { canvas, reach, moved, heightOf, view: null, pointers: new Map() });
    canvas.addEventListener("pointerdown", (event) => taken(event) || this.press(event));
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) / 500));
    }, { passive: false });
    canvas.addEventListener("dblclick", () => this.reset());
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  turn(dx, dy) {
    this.view.azimuth -= dx;
    this.view.elevation = Math.min(Math.max(this.view.elevation + dy, -Math.PI / 2), Math.PI / 2);
    this.moved();
  }

  /// By shares of the picture's height.
  pan(dx, dy) {
    const { right, up } = cameraOf(this.view, 1), h = this.view.height;
    this.view.target = this.view.target.map((x, i) => x - h * (dx * right[i] - dy * up[i]));
    this.moved();
  }

  zoom(factor) {
    this.view.height = Math.min(Math.max(this.view.height * factor, this.reach * 1e-4), this.reach * 10);
    this.moved();
  }

  reset() {
    this.view = null;
    this.moved();
  }

  press(event) {
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.canvas.setPointerCapture(event.pointerId);
  }

  /// The middle of two pointers, and their distance.
  spread() {
    const [a, b] = [...this.pointers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, size: Math.hypot(a.x - b.x, a.y - b.y) || 1 };
  }

  drag(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) {
      return;
    }
    const pixels = this.heightOf(), before = this.pointers.size === 2 ? this.spread() : null;
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (before) {
      const now = this.spread();
      this.pan((now.x - before.x) / pixels, (now.y - before.y) / pixels);
      this.zoom(before.size / now.size);
    } else if (this.pointers.size === 1) {
      const dx = event.clientX - last.x, dy = event.clientY - last.y;
      if (event.shiftKey || event.buttons & 6) {
        this.pan(dx / pixels, dy / pixels);
      } else {
        this.turn(dx / 150, dy / 150);
      }
    }
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) {
      return;
    }
    const step = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (step) {
      event.shiftKey ? this.pan(0.05 * step[0], 0.05 * step[1]) : this.turn(-0.1 * step[0], 0.1 * step[1]);
    } else if (event.key === "+" || event.key === "=") {
      this.zoom(1 / 1.1);
    } else if (event.key === "-") {
      this.zoom(1.1);
    } else if (event.key === "0") {
      this.reset();
    } else {
      return;
    }
    event.preventDefault();
  }
}
