// The scene and its fine meshes as scene.hpp describes them: from bytes to numbers.

/// Returns the JSON of the bytes, with `array(place, Type)` for the arrays behind it.
const parsedScene = (buffer) => {
  const head = new DataView(buffer), length = head.getUint32(8, true);
  const scene = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 12, length)));
  const begin = Math.ceil((12 + length) / 8) * 8;
  scene.array = ({ at, count }, Type) => new Type(buffer, begin + at, count);
  for (const mesh of scene.meshes.filter((one) => one)) {
    mesh.places = new Uint16Array(buffer, begin + mesh.vertices.at, 4 * mesh.vertices.count);   // x, y, z, normal
    mesh.indices = scene.array(mesh.corners, Uint32Array);
  }
  return scene;
};

/// Returns where a ray (origin, direction) in a mesh's frame first meets it, in lengths of the direction; null if it does
/// not (Möller and Trumbore, 1997).
const hitOfMesh = (mesh, origin, direction) => {
  const o = origin.map((x, i) => (x - mesh.low[i]) / mesh.step), d = direction.map((x) => x / mesh.step);
  const { places, indices } = mesh, corner = (t) => [0, 1, 2].map((k) => places[4 * indices[t] + k]);
  let nearest = Infinity;
  for (let t = 0; t < indices.length; t += 3) {
    const a = corner(t), e = corner(t + 1).map((x, i) => x - a[i]), f = corner(t + 2).map((x, i) => x - a[i]);
    const p = Vector.cross(d, f), s = o.map((x, i) => x - a[i]), q = Vector.cross(s, e), det = Vector.dot(e, p);
    const u = Vector.dot(s, p) / det, v = Vector.dot(d, q) / det, at = Vector.dot(f, q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && at > 0 && at < nearest) {
      nearest = at;
    }
  }
  return nearest < Infinity ? nearest : null;
};

/// Returns the bytes of a text in base64.
const bytesOf = (base64) => {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) {
    bytes[i] = text.charCodeAt(i);
  }
  return bytes.buffer;
};

/// Returns a part of a page that is one file, or of the session that serves this page: "scene" or "meshes".
const loaded = async (part) => {
  const inFile = find("scene") !== null;
  if (inFile && part === "meshes" && document.readyState === "loading") {   // they are the end of the page
    await new Promise((done) => { document.addEventListener("DOMContentLoaded", done); });
  }
  if (inFile) {
    const bytes = bytesOf(find(part).textContent);
    find(part).textContent = "";
    return parsedScene(bytes);
  }
  const answer = await fetch(part);
  if (!answer.ok) {
    throw new Error(`the session does not answer (${answer.status}): is foam view still running?`);
  }
  return parsedScene(await answer.arrayBuffer());
};
