// A reader of YAML 1.2 finds the same numbers, and texts as keys.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { parseDocument } from 'yaml';

const folder = process.argv[2];
const truth = JSON.parse(readFileSync(`${folder}/truth.json`));
const list = (spheres) => spheres.map((sphere) => [...sphere.get('center'), sphere.get('radius')]);
const lists = (map) => [...map].map(([link, spheres]) => [link, list(spheres)]);
const readers = {
  curobo: (d) => lists(d.get('robot_cfg').get('kinematics').get('collision_spheres')),
  xrdf: (d) => lists(d.get('geometry').get(d.get('collision').get('geometry')).get('spheres')),
  lula: (d) => d.get('collision_spheres').flatMap((entry) => lists(entry)),
  bubblify: (d) => lists(d.get('collision_spheres')),
  plainmp: (d) => [...d.get('collision_spheres')].map(([link, value]) => [link, value.get('spheres')]),
  markers: (d) => {
    const found = new Map();
    for (const marker of d.get('markers')) {
      const position = marker.get('pose').get('position');
      const row = [...['x', 'y', 'z'].map((axis) => position.get(axis)), marker.get('scale').get('x') / 2];
      found.set(marker.get('ns'), [...(found.get(marker.get('ns')) ?? []), row]);
    }
    return [...found];
  },
};
for (const [format, read] of Object.entries(readers)) {
  const document = parseDocument(readFileSync(`${folder}/model.${format}`, 'utf8'), { version: '1.2', uniqueKeys: true });
  assert.deepEqual([...document.errors, ...document.warnings], [], format);
  assert.deepEqual(read(document.toJS({ mapAsMap: true })).sort(), Object.entries(truth.spheres).sort(), format);
}
console.log(`${Object.keys(readers).length} files with ${Object.values(truth.spheres).flat().length} spheres each`);
