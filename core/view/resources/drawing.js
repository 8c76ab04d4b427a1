// The renderer of the report with what robots need beyond it: smooth meshes in their colours, and many spheres at once.

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

const NUMBERS_OF_SPHERE = 7;   // x, y, z, radius, red, green, blue

class RobotRenderer extends Renderer {
  constructor(canvas, scene) {
    super(canvas, scene, { antialias: false, copied: false });   // pictures at rest are drawn twice as fine instead
    this.places = ["model", "colour"].map((name) => this.gl.getUniformLocation(this.meshProgram, name));
  }

  meshShaders() {
    return [SMOOTH_VERTEX, SMOOTH_FRAGMENT];
  }

  /// Uploads the meshes of a scene.
  take(scene) {
    const gl = this.gl, corner = gl.getAttribLocation(this.meshProgram, "corner");
    const octahedral = gl.getAttribLocation(this.meshProgram, "octahedral");
    this.meshes = scene.meshes.map((mesh) => {
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      this.upload(gl.ARRAY_BUFFER, mesh.places);
      gl.enableVertexAttribArray(corner);
      gl.vertexAttribPointer(corner, 3, gl.UNSIGNED_SHORT, false, 8, 0);
      gl.enableVertexAttribArray(octahedral);
      gl.vertexAttribPointer(octahedral, 2, gl.BYTE, true, 8, 6);
      this.upload(gl.ELEMENT_ARRAY_BUFFER, mesh.indices);
      gl.bindVertexArray(null);
      return { array, low: mesh.low, step: mesh.step,
        ranges: mesh.ranges.map(([first, count, colour]) => ({ first, count, colour: colour && rgb(colour) })) };
    });
  }

  /// `parts`: [{mesh, pose, colour: [r, g, b] or null, over: whether it takes the place of the mesh's own colours}].
  drawMeshes(parts, opacity) {
    const gl = this.gl, [model, colour] = this.places;
    gl.useProgram(this.meshProgram);
    for (const part of parts) {
      const mesh = this.meshes[part.mesh];
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
