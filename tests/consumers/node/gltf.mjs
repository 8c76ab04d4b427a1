// The validator of Khronos has nothing to say of the file; its nodes are the spheres, placed at the default position.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';

const folder = process.argv[2];
const truth = JSON.parse(readFileSync(`${folder}/truth.json`));
const bytes = readFileSync(`${folder}/model.gltf`);
const { issues, info } = await validator.validateBytes(new Uint8Array(bytes));
assert.deepEqual(issues.messages.filter(({ severity }) => severity < 3), []);

const { nodes, scenes, scene } = JSON.parse(bytes);
const found = {};

function rotated([x, y, z, w], v) {
  const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
  return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]];
}

const transformed = (m, [x, y, z]) => [0, 1, 2].map((row) => m[row] * x + m[row + 4] * y + m[row + 8] * z + m[row + 12]);

// `toWorld` maps a point of the parent to the scene.
function visit(node, toWorld, link) {
  const to = (p) => toWorld(node.matrix ? transformed(node.matrix, p)
    : rotated(node.rotation ?? [0, 0, 0, 1], p).map((value, i) => value + (node.translation ?? [0, 0, 0])[i]));
  if (node.extras?.radius !== undefined) {
    assert.deepEqual(node.scale, Array(3).fill(node.extras.radius));
    (found[link] ??= []).push({ row: [...node.translation, node.extras.radius], at: to([0, 0, 0]) });
  }
  for (const child of node.children ?? []) {
    visit(nodes[child], to, node.name);
  }
}
for (const root of scenes[scene ?? 0].nodes) {
  visit(nodes[root], (p) => p, '');
}

const rows = Object.fromEntries(Object.entries(found).map(([link, spheres]) => [link, spheres.map(({ row }) => row)]));
assert.deepEqual(rows, truth.spheres);
for (const [link, centers] of Object.entries(truth.positions[0].centers)) {
  centers.forEach(([x, y, z], i) => {
    [x, z, -y].forEach((value, axis) => { // y is up
      assert.ok(Math.abs(found[link][i].at[axis] - value) < 1e-12, `${link}: ${found[link][i].at} for ${[x, z, -y]}`);
    });
  });
}
console.log(`glTF ${info.version}: ${Object.values(found).flat().length} spheres of ${Object.keys(found).length} links`);
