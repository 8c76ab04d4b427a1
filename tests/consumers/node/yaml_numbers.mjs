// A reader of YAML 1.2 takes foam's numbers for numbers with all their bits, and its names for texts.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { parseDocument } from 'yaml';

const document = parseDocument(execFileSync(process.argv[2], { encoding: 'utf8' }), { version: '1.2' });
assert.deepEqual([...document.errors, ...document.warnings], []);
const entries = document.toJS();
for (const [value, text, kind] of entries) {
  if (kind === 'number') {
    assert.ok(Object.is(value, Number(text)), `${value} for ${text}`);
  } else {
    assert.equal(`_${value}`, text);
    assert.equal(typeof value, 'string', text);
  }
}
assert.ok(entries.length > 20);
