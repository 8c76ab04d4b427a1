// TinyUSDZ reads the layer and prints it: prims, spheres; and it refuses a broken one.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

// It is compiled for browsers only.
process.type = 'renderer';
globalThis.window = globalThis;
const { default: load } = await import('tinyusdz/tinyusdz.js');
const wasm = readFileSync(createRequire(import.meta.url).resolve('tinyusdz/tinyusdz.wasm'));
const native = await load({
  instantiateWasm: (imports, done) => {
    WebAssembly.instantiate(wasm, imports).then(({ instance, module }) => done(instance, module));
    return {};
  },
});

function read(text) {
  const layer = new native.TinyUSDZLoaderNative();
  const read = layer.loadAsLayerFromBinary(new TextEncoder().encode(text), 'model.usda');
  return read ? { text: layer.layerToString() } : { error: layer.error() };
}

const folder = process.argv[2];
const truth = JSON.parse(readFileSync(`${folder}/truth.json`));
const text = readFileSync(`${folder}/model.usd`, 'utf8');
const layer = read(text);
assert.equal(layer.error, undefined);

const found = {};
const path = [];
for (const line of layer.text.split('\n')) {
  const prim = line.match(/^\s*(?:over|def)(?: (\w+))? "([^"]*)"/);
  if (prim) {
    path[line.search(/\S/) / 4] = { type: prim[1], name: prim[2] };
    path.length = line.search(/\S/) / 4 + 1;
  }
  const radius = line.match(/^\s*double radius = (.*)$/);
  const at = line.match(/^\s*double3 xformOp:translate = \((.*)\)$/);
  if (radius || at) {
    assert.equal(path.at(-1).type, 'Sphere');
    const spheres = (found[path.at(-3).name] ??= {});
    const sphere = (spheres[path.at(-1).name] ??= []);
    if (radius) {
      sphere[3] = Number(radius[1]);
    } else {
      at[1].split(',').forEach((number, axis) => (sphere[axis] = Number(number)));
    }
  }
}
const expected = Object.fromEntries(Object.entries(truth.spheres).map(([link, rows]) => [link.replaceAll(/\W/g, '_'), rows]));
assert.deepEqual(Object.fromEntries(Object.entries(found).map(([link, spheres]) => [link, Object.values(spheres)])), expected);

assert.ok(read(text.replace('double radius = ', 'double radius = no')).error, 'a broken layer is refused');
console.log(`TinyUSDZ: ${Object.values(truth.spheres).flat().length} spheres of ${Object.keys(found).length} prims`);
