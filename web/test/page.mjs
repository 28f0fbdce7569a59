// What people do on the page: `node page.mjs [FOLDER OF SCREENSHOTS] [TALE…]`. Needs the built page (`bash web/build`) and Chromium.
import { access } from "node:fs/promises";
import { resolve } from "node:path";
import { Desk, Failure } from "./desk.mjs";
import { serve } from "./serve.mjs";
import * as tales from "./tales.mjs";

const here = new URL(".", import.meta.url).pathname;
const target = process.env.CARGO_TARGET_DIR ?? resolve(here, "../../target");
const [folder = resolve(target, "screenshots/page"), ...wanted] = process.argv.slice(2);

const names = Object.keys(tales).filter((name) => wanted.length === 0 || wanted.includes(name));
if (names.length === 0) throw new Failure(`no such tale; there are: ${Object.keys(tales).join(", ")}`);

const page = resolve(target, "web");
await access(resolve(page, "index.html")).catch(() => {
  console.error(`error: there is no page in ${page}; type \`bash web/build\` first`);
  process.exit(1);
});
const server = await serve(page);
let failed = 0;
const begun = Date.now();
for (const name of names) {
  const started = Date.now();
  let desk;
  // Opens the page once more, in a browser of its own.
  const open = async (query, how) => {
    await desk?.close();
    desk = await Desk.open(server.address, query, folder, how);
    return desk;
  };
  let verdict = "ok";
  try {
    await tales[name](open);
  } catch (problem) {
    verdict = `FAILED: ${problem instanceof Failure ? problem.message : problem.stack}`;
    failed += 1;
    await desk?.page.screenshot({ path: resolve(folder, `${name} failed.png`), timeout: 20_000 }).catch(() => {});
  }
  await desk?.close();
  console.log(`tale ${name} ... ${verdict} (${((Date.now() - started) / 1000).toFixed(1)} s)`);
}
server.end();
console.log(`page: ${names.length - failed} passed, ${failed} failed, ${((Date.now() - begun) / 1000).toFixed(0)} s`);
process.exitCode = failed === 0 ? 0 : 1;
