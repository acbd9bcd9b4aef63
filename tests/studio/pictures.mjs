// SPDX-License-Identifier: Apache-2.0
// node pictures.mjs FOLDER, with ARMATURE=the program: the pictures of docs/studio_walk.md and docs/rover.md, from walks.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { crc32, deflateSync } from "node:zlib";
import * as pilot from "./pilot.mjs";
import { assemble_by_mouse } from "./pilot_by_mouse.mjs";
import { begin, finish, studio, user } from "./session.mjs";
import { lay_out, walk } from "./walk.mjs";

const kMostColours = 256;

/** In the page: the picture's pixels as places in a palette of its most frequent colours. */
async function with_palette({ encoded, most }) {
  const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(encoded), (letter) => letter.charCodeAt(0))]));
  const { width, height } = bitmap;
  const drawing = new OffscreenCanvas(width, height).getContext("2d");
  drawing.drawImage(bitmap, 0, 0);
  const pixels = new Uint32Array(drawing.getImageData(0, 0, width, height).data.buffer);
  const counts = new Map();
  for (const pixel of pixels) counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
  const colours = [...counts].sort(([, a], [, b]) => b - a).slice(0, most).map(([colour]) => [colour & 255, (colour >> 8) & 255, (colour >> 16) & 255]);
  const nearest = (pixel) => {
    const distance = ([r, g, b]) => (r - (pixel & 255)) ** 2 + (g - ((pixel >> 8) & 255)) ** 2 + (b - ((pixel >> 16) & 255)) ** 2;
    return colours.reduce((best, colour, i) => (distance(colour) < distance(colours[best]) ? i : best), 0);
  };
  const places = new Map([...counts.keys()].map((pixel) => [pixel, nearest(pixel)]));
  return { width, height, colours: colours.flat(), places: Array.from(pixels, (pixel) => places.get(pixel)) };
}

function chunk(name, data) {
  const body = Buffer.concat([Buffer.from(name), data]);
  const [size, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
  size.writeUInt32BE(data.length);
  sum.writeUInt32BE(crc32(body));
  return Buffer.concat([size, body, sum]);
}

function png({ width, height, colours, places }) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 3], 8); // a byte for each pixel: its place in the palette
  const rows = Buffer.alloc((width + 1) * height);
  for (let y = 0; y < height; ++y) rows.set(places.slice(y * width, (y + 1) * width), y * (width + 1) + 1);
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  return Buffer.concat([signature, chunk("IHDR", header), chunk("PLTE", Buffer.from(colours)), chunk("IDAT", deflateSync(rows, { level: 9 })), chunk("IEND", Buffer.alloc(0))]);
}

/** Walks in a new file, and keeps a picture each time that the walk shows something. @param wanted  which of them; all unless said */
async function draw(name, file, walk, settings, wanted = () => true) {
  const { address, end } = await studio(file);
  const page = await user(address, settings);
  const painter = await page.context().browser().newPage();
  let number = 0;
  await walk(page, async (what) => {
    if (!wanted(what)) return;
    const encoded = (await page.screenshot({ animations: "disabled" })).toString("base64");
    const bytes = png(await painter.evaluate(with_palette, { encoded, most: kMostColours }));
    const picture = `${name}_${++number}_${what}.png`;
    writeFileSync(join(output, picture), bytes);
    console.log(`${picture}: ${Math.round(bytes.length / 1000)} kB`);
  });
  await end("SIGTERM");
}

const output = process.argv[2];
await begin();
try {
  lay_out();
  await draw("studio_walk", "demo/mine.yaml", walk);
  pilot.lay_out();
  await draw("rover_pilot", "rover/deployments/mine.yaml", assemble_by_mouse, { viewport: { width: 2400, height: 1500 } }, (what) => what === "wired");
} finally {
  await finish();
}
