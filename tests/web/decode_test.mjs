// Decodes a stored message with the page's decoder.
//   decode_test.mjs SOURCE_TREE
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";

const source = process.argv[2];
const code = readFileSync(`${source}/web/lcm.js`, "utf8");  // a data URL, since node takes a .js file for no module
const {decodeGraspState, kGraspNames} = await import(`data:text/javascript,${encodeURIComponent(code)}`);

const bytes = readFileSync(`${source}/tests/golden/lcm/grasp_state_t.bin`);
const grasp = decodeGraspState(new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength));
assert.equal(grasp.sensor, "left camera");
assert.deepEqual([grasp.grasp, grasp.kind, grasp.opposition, grasp.thumb, grasp.first_finger, grasp.last_finger],
                 [1, 2, 3, 4, 5, 6]);
assert.equal(grasp.since, grasp.utime - 1);
assert.equal(grasp.probabilities[17], 0.875);
assert.deepEqual([grasp.finger_probability, grasp.aperture, grasp.closure], [-1.625, -1.5, -1.375]);
assert.equal(grasp.probabilities.length, kGraspNames.length);
