// MuJoCo reads the MJCF: bodies, spheres, where they are at three joint positions, and pairs without contact.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import loadMujoco from '@mujoco/mujoco';

const folder = process.argv[2];
const truth = JSON.parse(readFileSync(`${folder}/truth.json`));
const text = readFileSync(`${folder}/model.mjcf`, 'utf8');
const mujoco = await loadMujoco();
const { mjOBJ_BODY: BODY, mjOBJ_JOINT: JOINT } = mujoco.mjtObj;
const kind = (object) => object.value ?? object;

const model = mujoco.MjModel.from_xml_string(text);
assert.ok(model, 'MuJoCo refuses the file');
// A link called world without spheres is MuJoCo's own world.
assert.equal(model.nbody, new Set([...truth.links, 'world']).size, 'bodies and the world');
assert.equal(model.ngeom, Object.values(truth.spheres).flat().length);
const body = (link) => mujoco.mj_name2id(model, kind(BODY), link);
const triple = (array, i) => Array.from(array.slice(3 * i, 3 * i + 3));

for (const [link, spheres] of Object.entries(truth.spheres)) {
  assert.equal(model.body_geomnum[body(link)], spheres.length, link);
  spheres.forEach(([x, y, z, radius], i) => {
    const geom = model.body_geomadr[body(link)] + i;
    assert.deepEqual(triple(model.geom_pos, geom), [x, y, z], link);
    assert.equal(model.geom_size[3 * geom], radius, link);
  });
}

const data = new mujoco.MjData(model);
for (const { joints, centers } of truth.positions) {
  for (const [joint, value] of Object.entries(joints)) {
    const id = mujoco.mj_name2id(model, kind(JOINT), joint);
    assert.ok(id >= 0, joint);
    data.qpos[model.jnt_qposadr[id]] = value;
  }
  mujoco.mj_kinematics(model, data);
  for (const [link, points] of Object.entries(centers)) {
    points.forEach((point, i) => {
      triple(data.geom_xpos, model.body_geomadr[body(link)] + i).forEach((value, axis) => {
        assert.ok(Math.abs(value - point[axis]) < 1e-12, `${link}: ${value} for ${point[axis]}`);
      });
    });
  }
}

// Contacts of a model in its first position, step by step: the largest number, and whether pairs of `names` are among them.
function contacts(xml, steps, names) {
  const here = mujoco.MjModel.from_xml_string(xml);
  const state = new mujoco.MjData(here);
  let all = 0;
  let ofPairs = 0;
  for (let step = 0; step < steps; ++step) {
    mujoco.mj_step(here, state);
    all += state.ncon;
    const list = state.contact; // a copy, which stays until it is deleted
    for (let i = 0; i < state.ncon; ++i) {
      const contact = list.get(i);
      const pair = [contact.geom1, contact.geom2].map((g) => mujoco.mj_id2name(here, kind(BODY), here.geom_bodyid[g]));
      ofPairs += names.has(pair.sort().join(' ')) ? 1 : 0;
      contact.delete();
    }
    list.delete();
  }
  state.delete();
  here.delete();
  return { all, ofPairs };
}

const excludes = [...text.matchAll(/<exclude [^>]*body1="([^"]*)" body2="([^"]*)"[^>]*>/g)];
assert.ok(excludes.length > 0, 'no pair is excluded');
const names = new Set(excludes.map(([, a, b]) => [a, b].sort().join(' ')));
// Without gravity, and so large that neighbours overlap.
const still = text.replace('<worldbody>', '<option gravity="0 0 0"/>\n<worldbody>').replaceAll(/ size="[^"]*"/g, ' size="0.3"');
const without = contacts(still.replaceAll(/<exclude [^>]*>/g, ''), 1, names);
assert.ok(without.ofPairs > 0, 'spheres of excluded pairs overlap, so that leaving them out is seen');
assert.equal(contacts(still, 1000, names).ofPairs, 0);
console.log(`MuJoCo ${mujoco.mj_versionString()}: ${model.nbody - 1} bodies, ${model.ngeom} spheres, ` +
  `${names.size} pairs excluded: no contact in 1000 steps, ${without.ofPairs} in one step without`);
