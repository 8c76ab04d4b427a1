// Meshes and spheres by WebGL 2, in a parallel projection. A sphere is a square that faces the viewer; each of its
// pixels computes the point of the ball that it shows, so that the outline is round at any size and cuts with meshes
// are exact.
"use strict";

const Vector = {
  cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  unit: (a) => { const n = Math.hypot(...a) || 1; return a.map((x) => x / n); },
};

/// Little-endian typed arrays from base64.
const decoded = (text, Type) => new Type(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);

/// `pose`: 3 rows of 4 numbers.
const moved = (pose, p) => [0, 4, 8].map((r) => pose[r] * p[0] + pose[r + 1] * p[1] + pose[r + 2] * p[2] + pose[r + 3]);

/// Column-major 4 x 4 of the pose after p -> low + step * p.
const meshMatrix = (pose, mesh) => {
  const origin = moved(pose, mesh.low), s = mesh.step;
  return [pose[0] * s, pose[4] * s, pose[8] * s, 0, pose[1] * s, pose[5] * s, pose[9] * s, 0,
    pose[2] * s, pose[6] * s, pose[10] * s, 0, ...origin, 1];
};

const LIGHT = `
  vec3 lit(vec3 colour, vec3 normal) {
    float key = max(dot(normal, normalize(vec3(-0.35, 0.55, 0.75))), 0.0);
    float fill = max(dot(normal, normalize(vec3(0.7, -0.1, 0.4))), 0.0);
    return colour * (0.38 + 0.55 * key + 0.17 * fill);
  }`;

const MESH_VERTEX = `#version 300 es
  uniform mat4 model, view;
  uniform vec3 scale;   // of view space to clip space
  in vec3 corner;
  out vec3 place;
  void main() {
    vec4 at = view * model * vec4(corner, 1.0);
    place = at.xyz;
    gl_Position = vec4(at.xyz * scale, 1.0);
  }`;

const MESH_FRAGMENT = `#version 300 es
  precision highp float;
  uniform vec4 colour;
  in vec3 place;
  out vec4 pixel;
  ${LIGHT}
  void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    pixel = vec4(lit(colour.rgb, normal.z < 0.0 ? -normal : normal) * colour.a, colour.a);
  }`;

const SPHERE_VERTEX = `#version 300 es
  uniform mat4 view;
  uniform vec3 scale;
  in vec4 sphere;       // centre, radius; the same for the four corners of its square
  in vec3 tint;
  out vec2 place;       // in radii
  flat out vec2 depth;  // of the centre and of a radius, in clip space
  flat out vec3 base;
  void main() {
    vec3 centre = (view * vec4(sphere.xyz, 1.0)).xyz;
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1 & 1) * 2.0 - 1.0;
    place = corner;
    base = tint;
    depth = vec2(centre.z, sphere.w) * scale.z;
    gl_Position = vec4((centre + vec3(corner * sphere.w, 0.0)) * scale, 1.0);
  }`;

const SPHERE_FRAGMENT = `#version 300 es
  precision highp float;
  uniform float opacity;
  in vec2 place;
  flat in vec2 depth;
  flat in vec3 base;
  out vec4 pixel;
  ${LIGHT}
  void main() {
    float rest = 1.0 - dot(place, place);
    if (rest < 0.0) discard;
    vec3 normal = vec3(place, sqrt(rest));
    gl_FragDepth = 0.5 + 0.5 * (depth.x + depth.y * normal.z);
    pixel = vec4(lit(base, normal) * opacity, opacity);
  }`;

/// Draws a scene, as scene.hpp describes it, into a canvas. Throws if there is no WebGL 2.
class Renderer {
  /// `copied`: whether pictures are copied from the canvas after they are drawn.
  constructor(canvas, scene, { antialias = true, copied = true } = {}) {
    const gl = canvas.getContext("webgl2", { antialias, alpha: true, preserveDrawingBuffer: copied });
    if (!gl) {
      throw new Error("this browser has no WebGL 2, or it is switched off");
    }
    this.gl = gl;
    this.canvas = canvas;
    this.meshProgram = this.program(...this.meshShaders());
    this.sphereProgram = this.program(SPHERE_VERTEX, SPHERE_FRAGMENT);
    this.meshes = scene.meshes.map((mesh) => this.uploadMesh(mesh));
    this.links = scene.links;
    this.elements = [];
    this.spheres = { array: gl.createVertexArray(), buffer: gl.createBuffer(), indices: gl.createBuffer(), count: 0, room: 0 };
    this.describeSpheres();
  }

  meshShaders() {
    return [MESH_VERTEX, MESH_FRAGMENT];
  }

  program(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error("the graphics driver refused a shader: " + gl.getProgramInfoLog(program));
    }
    return program;
  }

  upload(target, data) {
    const gl = this.gl, buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return buffer;
  }

  uploadMesh(mesh) {
    const gl = this.gl, array = gl.createVertexArray();
    const triangles = decoded(mesh.triangles, mesh.wide ? Uint32Array : Uint16Array);
    gl.bindVertexArray(array);
    this.upload(gl.ARRAY_BUFFER, decoded(mesh.corners, Uint16Array));
    const corner = gl.getAttribLocation(this.meshProgram, "corner");
    gl.enableVertexAttribArray(corner);
    gl.vertexAttribPointer(corner, 3, gl.UNSIGNED_SHORT, false, 0, 0);
    this.upload(gl.ELEMENT_ARRAY_BUFFER, triangles);
    gl.bindVertexArray(null);
    return { array, count: triangles.length, type: mesh.wide ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT,
      low: mesh.low, step: mesh.step };
  }

  describeSpheres() {
    const gl = this.gl, at = (name) => gl.getAttribLocation(this.sphereProgram, name);
    gl.bindVertexArray(this.spheres.array);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.spheres.indices);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.spheres.buffer);
    for (const [name, size, offset] of [["sphere", 4, 0], ["tint", 3, 16]]) {
      gl.enableVertexAttribArray(at(name));
      gl.vertexAttribPointer(at(name), size, gl.FLOAT, false, 28, offset);
    }
    gl.bindVertexArray(null);
  }

  /// `rows`: x, y, z, radius, red, green, blue of each sphere, in the robot's frame.
  setSpheres(rows) {
    const gl = this.gl, all = rows instanceof Float32Array ? rows : new Float32Array(rows), count = rows.length / 7;
    const corners = new Float32Array(28 * count);   // no instances: each takes renderers in software a call of its own
    for (let i = 0; i < count; ++i) {
      for (let corner = 0; corner < 4; ++corner) {
        corners.set(all.subarray(7 * i, 7 * i + 7), 28 * i + 7 * corner);
      }
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, this.spheres.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, corners, gl.DYNAMIC_DRAW);
    this.spheres.count = count;
    this.indexSpheres(count);
  }

  /// Indexes two triangles for the square of each sphere.
  indexSpheres(count) {
    const gl = this.gl;
    if (count <= this.spheres.room) {
      return;
    }
    const indices = new Uint32Array(6 * count);
    for (let i = 0; i < count; ++i) {
      indices.set([0, 1, 2, 2, 1, 3].map((corner) => 4 * i + corner), 6 * i);
    }
    gl.bindVertexArray(this.spheres.array);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.DYNAMIC_DRAW);
    gl.bindVertexArray(null);
    this.spheres.room = count;
  }

  /// `camera`: {right, up, back: unit vectors; target; height: of what is seen, m; depth: half of what is kept, m}.
  /// `parts`: [{mesh: index, pose, colour: [r, g, b]}]. `clear`: what is seen through: "spheres", "geometry", "none".
  /// `area`: the pixels that are drawn, from the lower left corner.
  draw(camera, parts, clear, area = { x: 0, y: 0, width: this.canvas.width, height: this.canvas.height }) {
    const gl = this.gl, { x, y, width, height } = area;
    gl.viewport(x, y, width, height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(x, y, width, height);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);   // colours are premultiplied
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.setCamera(camera, width / height);
    if (clear === "geometry") {
      this.drawElements(1);
      gl.clear(gl.DEPTH_BUFFER_BIT);   // the geometry shows through the spheres that hold it
      this.drawVeil(parts, 0.45, area);
    } else {
      this.drawMeshes(parts, 1);
      if (clear === "spheres") {
        this.nearestLayer(() => this.drawElements(0.42));
      } else {
        this.drawElements(1);
      }
    }
  }

  /// `elements`: of other kinds than sphere, as the parts of draw().
  setElements(elements) {
    this.elements = elements;
  }

  drawElements(opacity) {
    this.drawMeshes(this.elements, opacity);
    this.drawSpheres(opacity);
  }

  /// Draws meshes that are seen through. Their nearest surfaces only show.
  drawVeil(parts, opacity) {
    this.nearestLayer(() => this.drawMeshes(parts, opacity));
  }

  /// Depth first, then colour: of what is transparent only the nearest surface shows.
  nearestLayer(drawAll) {
    const gl = this.gl;
    gl.colorMask(false, false, false, false);
    drawAll();
    gl.colorMask(true, true, true, true);
    gl.enable(gl.BLEND);
    drawAll();
    gl.disable(gl.BLEND);
  }

  setCamera({ right, up, back, target, height, depth }, aspect) {
    const gl = this.gl, move = [right, up, back].map((axis) => -Vector.dot(axis, target));
    const view = [0, 1, 2].flatMap((i) => [right[i], up[i], back[i], 0]).concat(move, 1);
    for (const program of [this.meshProgram, this.sphereProgram]) {
      gl.useProgram(program);
      gl.uniformMatrix4fv(gl.getUniformLocation(program, "view"), false, view);
      gl.uniform3f(gl.getUniformLocation(program, "scale"), 2 / (height * aspect), 2 / height, -1 / depth);
    }
  }

  drawMeshes(parts, opacity) {
    const gl = this.gl, at = (name) => gl.getUniformLocation(this.meshProgram, name);
    gl.useProgram(this.meshProgram);
    for (const part of parts) {
      const mesh = this.meshes[part.mesh];
      gl.uniformMatrix4fv(at("model"), false, meshMatrix(part.pose, mesh));
      gl.uniform4f(at("colour"), ...part.colour, opacity);
      gl.bindVertexArray(mesh.array);
      gl.drawElements(gl.TRIANGLES, mesh.count, mesh.type, 0);
    }
    gl.bindVertexArray(null);
  }

  drawSpheres(opacity) {
    const gl = this.gl;
    gl.useProgram(this.sphereProgram);
    gl.uniform1f(gl.getUniformLocation(this.sphereProgram, "opacity"), opacity);
    gl.bindVertexArray(this.spheres.array);
    gl.drawElements(gl.TRIANGLES, 6 * this.spheres.count, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
  }
}
