// A browser, a page in it, and the hands of somebody who uses it: real keys, a real mouse, real fingers. It waits for states and steps, never for seconds.
import { chromium } from "playwright-core";
import { mkdir, writeFile } from "node:fs/promises";
import { join } from "node:path";

const SIZE = { width: 1000, height: 640 };
// Longest wait for a state, ms: a software device on a busy machine.
const PATIENCE = 240_000;
// WebGPU, the surfaces it draws on, and the browser's own drawing, all on Chromium's software driver; a picture may take long there.
const DEVICE = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader",
  "--use-angle=swiftshader", "--disable-gpu-watchdog"];
const WITHOUT = { nothing: ["--disable-gpu", "--disable-3d-apis"], webgl: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-features=WebGPUService"] };

// What tells how long each task of the page's one thread took.
const TASKS = ["toplevel", "disabled-by-default-devtools.timeline"];

export class Failure extends Error {}

export function ensure(holds, words) {
  if (!holds) throw new Failure(words);
}

export class Desk {
  // `kind`: "webgpu", "webgl" without WebGPU, or "nothing" without both.
  static async open(address, query, folder, { kind = "webgpu", touch = false, size = SIZE, traced = false } = {}) {
    const desk = new Desk();
    const args = ["--no-sandbox", ...(WITHOUT[kind] ?? DEVICE)];
    desk.browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--headless=new", ...args] });
    const context = await desk.browser.newContext({ viewport: size, hasTouch: touch });
    desk.page = await context.newPage();
    desk.eye = await context.newPage();
    await desk.page.bringToFront();
    desk.folder = folder;
    desk.said = [];
    desk.page.on("console", (message) => desk.said.push(message.text()));
    desk.page.on("pageerror", (error) => desk.said.push(String(error)));
    if (traced) await desk.browser.startTracing(desk.page, { categories: TASKS });
    await desk.page.goto(`${address}?status&${query}`);
    return desk;
  }

  async close() {
    await this.browser.close();
  }

  async now() {
    return this.page.evaluate(() => window.sward_status ?? null);
  }

  // Waits until what the page shows is as wanted.
  async wait(what, wanted) {
    const begun = Date.now();
    let last = null;
    while (Date.now() - begun < PATIENCE) {
      last = await this.now();
      if (last && wanted(last)) return last;
      await new Promise((later) => setTimeout(later, 25));
    }
    if (last) last.marks = Object.keys(last.marks);
    const words = await this.page.textContent("#words").catch(() => "");
    throw new Failure(`waited in vain for ${what}; the page shows ${JSON.stringify(last)}, its words are "${words.trim()}", and its console says ${JSON.stringify(this.said)}`);
  }

  async pictures(count) {
    const before = (await this.now())?.pictures ?? 0;
    return this.wait("pictures", (now) => now.pictures >= before + count);
  }

  async steps(count) {
    const before = (await this.now())?.step ?? 0;
    return this.wait("steps", (now) => now.step >= before + count);
  }

  // The middle of something on the page, in CSS pixels.
  async place(mark) {
    const { marks } = await this.wait(mark, (now) => now.marks[mark]);
    const scale = await this.page.evaluate(() => window.devicePixelRatio);
    const [left, top, width, height] = marks[mark].map((pixels) => pixels / scale);
    return [left + width / 2, top + height / 2];
  }

  async point([x, y]) {
    await this.page.mouse.move(x, y);
    return this.pictures(2);
  }

  async button(down) {
    await (down ? this.page.mouse.down() : this.page.mouse.up());
    return this.pictures(2);
  }

  async clickAt(at) {
    await this.point(at);
    await this.button(true);
    return this.button(false);
  }

  async click(mark) {
    return this.clickAt(await this.place(mark));
  }

  async drag(places) {
    for (const [index, place] of places.entries()) {
      await this.point(place);
      if (index === 0) await this.button(true);
    }
    return this.button(false);
  }

  async key(key) {
    await this.page.keyboard.press(key);
    return this.pictures(2);
  }

  async hold(key, down) {
    await (down ? this.page.keyboard.down(key) : this.page.keyboard.up(key));
  }

  // Drops a file on the page, as from a folder.
  async drop(name, text) {
    await this.page.evaluate(([name, text]) => {
      const data = new DataTransfer();
      data.items.add(new File([text], name));
      const canvas = document.querySelector("canvas");
      for (const type of ["dragover", "drop"]) canvas.dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
    }, [name, text]);
  }

  // Fingers where they are now; none: all are lifted.
  async touch(...places) {
    this.hand ??= await this.page.context().newCDPSession(this.page);
    const type = places.length === 0 ? "touchEnd" : (this.down ?? 0) < places.length ? "touchStart" : "touchMove";
    this.down = places.length;
    await this.hand.send("Input.dispatchTouchEvent", { type, touchPoints: places.map(([x, y], id) => ({ x, y, id })) });
    return this.pictures(2);
  }

  // Touches something shortly.
  async tap(mark) {
    await this.touch(await this.place(mark));
    return this.touch();
  }

  // Saves what the page shows, once the picture shows the present step, and returns it. Only while time stands still.
  async shot(name) {
    await this.wait("the picture of a step", (now) => now.paused && now.drawn === now.step);
    await this.pictures(3);
    const bytes = await this.page.screenshot({ timeout: PATIENCE });
    await mkdir(this.folder, { recursive: true });
    await writeFile(join(this.folder, `${name}.png`), bytes);
    return bytes.toString("base64");
  }

  // A part of a screenshot compared with that of another, or with its own first pixel: mean and largest step of the code values.
  async differences(one, other, [left, top, width, height]) {
    return this.eye.evaluate(async ([one, other, left, top, width, height]) => {
      const pixels = async (base64) => {
        const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
        const context = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
        context.drawImage(picture, 0, 0);
        return context.getImageData(left, top, width, height).data;
      };
      const a = await pixels(one);
      const b = other ? await pixels(other) : a.map((_, index) => a[index % 4]);
      let sum = 0;
      for (let index = 0; index < a.length; index += 1) sum += Math.abs(a[index] - b[index]);
      return sum / (a.length * 0.75);
    }, [one, other, ...[left, top, width, height].map(Math.floor)]);
  }

  // How far the colours of a part lie apart.
  async variety(shot, area) {
    return this.differences(shot, null, area);
  }

  // Of each task of a traced page's one thread: when it began, how long it took, and how long the thread itself worked in it, ms.
  async tasks() {
    const { traceEvents } = JSON.parse(await this.browser.stopTracing());
    const threads = traceEvents.filter((event) => event.name === "thread_name" && event.args.name === "CrRendererMain").map((event) => event.tid);
    const tasks = traceEvents.filter((event) => event.name === "RunTask" && threads.includes(event.tid));
    const first = Math.min(...tasks.map((task) => task.ts));
    return tasks.map((task) => ({ at: (task.ts - first) / 1e3, whole: task.dur / 1e3, own: (task.tdur ?? 0) / 1e3 }));
  }
}
