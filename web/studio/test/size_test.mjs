// SPDX-License-Identifier: Apache-2.0
// node --test size_test.mjs, with PAGE=FOLDER that has the page: what a browser has to fetch.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { gzipSync } from "node:zlib";

const kFirst = 220_000;
const kAll = 560_000;
const folder = process.env.PAGE;
const weight = (file) => gzipSync(readFileSync(join(folder, file)), { level: 9 }).length;

/** The file and the parts that it imports before it runs. */
function with_imports(file, known = new Set()) {
  if (known.has(file)) return known;
  known.add(file);
  for (const [, part] of readFileSync(join(folder, file), "utf8").matchAll(/(?:from|import)"\.\/([^"]+\.js)"/g)) with_imports(part, known);
  return known;
}

test("the first page is light", () => {
  const files = ["index.html", "studio.css", ...with_imports("studio.js")];
  const bytes = files.reduce((sum, file) => sum + weight(file), 0);
  console.log(`first page: ${bytes} bytes in ${files.length} files`);
  assert.ok(bytes <= kFirst, `${bytes} bytes`);
});

test("so are all files", () => {
  const bytes = readdirSync(folder).reduce((sum, file) => sum + weight(file), 0);
  console.log(`all files: ${bytes} bytes`);
  assert.ok(bytes <= kAll, `${bytes} bytes`);
});

test("no file has a style or a script in it that the content security policy forbids", () => {
  const page = readFileSync(join(folder, "index.html"), "utf8");
  assert.doesNotMatch(page, /<style|style=|<script(?![^>]*src=)/);
});
