// Says of each file whether the glTF validator finds errors or warnings in it, and then how many are good.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
const fs = require('fs');
const validator = require('gltf-validator');

async function isGood(path) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(path)));
  const found = report.issues.messages.filter((message) => message.severity <= 1);

  console.log(`${found.length ? 'FAIL' : 'ok  '} ${path}: ${report.info.totalVertexCount} vertices, ` +
              `${report.info.totalTriangleCount} triangles`);
  for (const message of found) {
    console.log(`     ${message.code} ${message.pointer}: ${message.message}`);
  }
  return !found.length && report.info.totalTriangleCount > 0;
}

async function main(paths) {
  let passed = 0;

  for (const path of paths) {
    passed += await isGood(path);
  }
  console.log(`${passed} passed, ${paths.length - passed} failed`);
  process.exitCode = passed && passed === paths.length ? 0 : 1;
}

main(process.argv.slice(2));
