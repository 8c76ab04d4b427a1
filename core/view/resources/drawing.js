// The renderer of the report with what robots need beyond it: smooth meshes in their colours, coarse ones while pictures
// move, and nothing that is out of sight.

const SMOOTH_VERTEX = `#version 300 es
  uniform mat4 model, view;
  uniform vec3 scale;   // of view space to clip space
  in vec3 corner;
  in vec2 octahedral;
  out vec3 normal;
  void main() {
    vec4 at = view * model * vec4(corner, 1.0);
    vec3 n = vec3(octahedral, 1.0 - abs(octahedral.x) - abs(octahedral.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    normal = mat3(view) * mat3(model) * n;
    gl_Position = vec4(at.xyz * scale, 1.0);
  }`;

const SMOOTH_FRAGMENT = `#version 300 es
  precision highp float;
  uniform vec4 colour;
  in vec3 normal;
  out vec4 pixel;
  ${LIGHT}
  void main() {
    vec3 n = normalize(normal);
    pixel = vec4(lit(colour.rgb, n.z < 0.0 ? -n : n) * colour.a, colour.a);
  }`;

const VEIL_VERTEX = `#version 300 es
  in vec2 corner;
  void main() { gl_Position = vec4(corner, 0.0, 1.0); }`;

const VEIL_FRAGMENT = `#version 300 es
  precision highp float;
  uniform sampler2D picture;
  uniform vec3 from;   // the lower left pixel, and the opacity
  out vec4 pixel;
  void main() { pixel = texelFetch(picture, ivec2(gl_FragCoord.xy - from.xy), 0) * from.z; }`;

const NUMBERS_OF_SPHERE = 7;   // x, y, z, radius, red, green, blue

class RobotRenderer extends Renderer {
  constructor(canvas) {
    const none = { meshes: [], links: [] };
    super(canvas, none, { antialias: false, copied: false });   // pictures at rest are drawn twice as fine instead
    this.places = ["model", "colour"].map((name) => this.gl.getUniformLocation(this.meshProgram, name));
    this.veil = null;
  }

  meshShaders() {
    return [SMOOTH_VERTEX, SMOOTH_FRAGMENT];
  }

  /// Uploads the meshes of a scene.
  take(scene) {
    this.meshes = scene.meshes.map((mesh) => ({ coarse: this.uploaded(mesh), fine: null, middle: mesh.box[0].map(
      (low, i) => (low + mesh.box[1][i]) / 2), radius: Math.hypot(...mesh.box[1].map((x, i) => x - mesh.box[0][i])) / 2 }));
  }

  /// Uploads the fine meshes of a scene, where they are others than the first.
  refine(scene) {
    scene.meshes.forEach((mesh, i) => { this.meshes[i].fine = mesh && this.uploaded(mesh); });
  }

  uploaded(mesh) {
    const gl = this.gl, corner = gl.getAttribLocation(this.meshProgram, "corner");
    const octahedral = gl.getAttribLocation(this.meshProgram, "octahedral"), array = gl.createVertexArray();
    gl.bindVertexArray(array);
    this.upload(gl.ARRAY_BUFFER, mesh.places);
    gl.enableVertexAttribArray(corner);
    gl.vertexAttribPointer(corner, 3, gl.UNSIGNED_SHORT, false, 8, 0);
    gl.enableVertexAttribArray(octahedral);
    gl.vertexAttribPointer(octahedral, 2, gl.BYTE, true, 8, 6);
    this.upload(gl.ELEMENT_ARRAY_BUFFER, mesh.indices);
    gl.bindVertexArray(null);
    return { array, low: mesh.low, step: mesh.step, triangles: mesh.indices.length / 3,
      ranges: mesh.ranges.map(([first, count, colour]) => ({ first, count, colour: colour && rgb(colour) })) };
  }

  /// Returns the parts in sight of the camera, each with the mesh to draw: fine ones within `most` triangles, those with
  /// the fewest first, else coarse ones.
  chosen(parts, { right, up, target, height }, aspect, most) {
    const seen = parts.filter(({ mesh, pose }) => {
      const { middle, radius } = this.meshes[mesh], d = moved(pose, middle).map((x, i) => x - target[i]);
      return Math.abs(Vector.dot(d, up)) < height / 2 + radius && Math.abs(Vector.dot(d, right)) < height * aspect / 2 + radius;
    });
    const fine = ({ mesh }) => this.meshes[mesh].fine?.triangles ?? 0;
    let left = most;
    return seen.sort((a, b) => fine(a) - fine(b)).map((part) => {
      const { coarse, fine: other } = this.meshes[part.mesh];
      left -= (other ?? coarse).triangles;
      return { ...part, drawn: other && left >= 0 ? other : coarse };
    });
  }

  /// Draws meshes once to a texture of the area's size, and that over the picture: half the triangles of two passes.
  drawVeil(parts, opacity, { x, y, width, height }) {
    const gl = this.gl;
    this.sizeVeil(width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.veil.frame);
    gl.viewport(0, 0, width, height);
    gl.scissor(0, 0, width, height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawMeshes(parts, 1);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(x, y, width, height);
    gl.scissor(x, y, width, height);
    gl.useProgram(this.veil.program);
    gl.uniform3f(this.veil.from, x, y, opacity);
    gl.bindVertexArray(this.veil.array);
    gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.bindVertexArray(null);
  }

  sizeVeil(width, height) {
    const gl = this.gl, veil = this.veil ??= this.madeVeil();
    if (veil.width === width && veil.height === height) {
      return;
    }
    Object.assign(veil, { width, height });
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    gl.bindRenderbuffer(gl.RENDERBUFFER, veil.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
  }

  /// The only texture of the renderer, which stays bound.
  madeVeil() {
    const gl = this.gl, program = this.program(VEIL_VERTEX, VEIL_FRAGMENT), texture = gl.createTexture();
    const array = gl.createVertexArray(), frame = gl.createFramebuffer(), depth = gl.createRenderbuffer();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    gl.bindVertexArray(array);
    this.upload(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
    gl.enableVertexAttribArray(gl.getAttribLocation(program, "corner"));
    gl.vertexAttribPointer(gl.getAttribLocation(program, "corner"), 2, gl.FLOAT, false, 0, 0);
    gl.bindVertexArray(null);
    return { program, frame, depth, array, from: gl.getUniformLocation(program, "from"), width: 0, height: 0 };
  }

  /// `parts`: [{mesh, pose, colour: [r, g, b] or null, over: whether it takes the place of the mesh's own colours}], with
  /// the mesh to draw by chosen().
  drawMeshes(parts, opacity) {
    const gl = this.gl, [model, colour] = this.places;
    gl.useProgram(this.meshProgram);
    for (const part of parts) {
      const mesh = part.drawn;
      gl.uniformMatrix4fv(model, false, meshMatrix(part.pose, mesh));
      gl.bindVertexArray(mesh.array);
      for (const range of mesh.ranges) {
        const tint = part.over ? part.colour : range.colour ?? part.colour ?? GREY;
        gl.uniform4f(colour, ...tint, opacity);
        gl.drawElements(gl.TRIANGLES, range.count, gl.UNSIGNED_INT, 4 * range.first);
      }
    }
    gl.bindVertexArray(null);
  }
}
