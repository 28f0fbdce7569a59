// What people do on the page. So many steps a picture, few pixels, fewer plants far away: the same on every machine.
import { stat } from "node:fs/promises";
import { ensure } from "./desk.mjs";

const USUAL = "steps=8&pixels=0.2&plants=0.3&cpu";
// Few plants: a software device draws it soon.
const YARD = `(
    version: 1,
    field: (patch_side: 8, patches: (5, 5)),
    stands: [(species: Meadow, cells: 32)],
    interactors: [(name: "ball", shape: Sphere(radius: 0.4), path: Still(at: (-3, 2)))],
    camera: (eye: (0, 2.2, -9), target: (0, 0.5, 0)),
)
`;
const PHONE = { width: 420, height: 760 };

const length = (vector) => Math.hypot(...(vector ?? [0, 0]));
const apart = (a, b) => Math.hypot(a.at[0] - b.at[0], a.at[1] - b.at[1]);

// Time stands still, and the page is photographed.
async function still(desk, name) {
  if (!(await desk.now()).paused) {
    await desk.key("p");
    await desk.wait("a pause", (now) => now.paused);
  }
  const shot = await desk.shot(name);
  return { shot, area: (await desk.now()).marks.picture };
}

async function on(desk) {
  await desk.key("p");
  await desk.wait("time to go on", (now) => !now.paused);
}

async function shows(desk, { shot, area }) {
  const variety = await desk.variety(shot, area);
  ensure(variety > 15, `the picture is empty: its colours lie ${variety.toFixed(1)} apart`);
}

// W drives the truck; where it was, plants lie, and beside its way they stand.
async function drive(desk, name) {
  await desk.wait("the scene", (now) => now.scene === "hello" && now.step > 0);
  const idle = await still(desk, `${name} before`);
  await shows(desk, idle);
  await desk.key("e");
  await on(desk);
  const { bodies: [from] } = await desk.wait("somebody at the wheel", (now) => now.driving === "pickup");
  const { bodies: [waits] } = await desk.steps(20);
  ensure(apart(from, waits) < 0.05, "control: nobody pressed a pedal");
  await desk.hold("w", true);
  const { bodies: [gone] } = await desk.wait("the truck to drive", (now) => apart(from, now.bodies[0]) > 12);
  await desk.hold("d", true);
  const before = (await desk.steps(1)).wheel.yaw;
  const turned = (await desk.steps(60)).wheel.yaw;
  await desk.hold("d", false);
  await desk.hold("w", false);
  const [track, beside] = [length(gone.track), length(gone.beside)];
  ensure(track > 0.6 && track > 2 * beside, `on its track plants lean ${track.toFixed(2)} rad, beside it ${beside.toFixed(2)}`);
  ensure(Math.abs(turned - before) > 0.2, `it does not steer: ${before} ${turned}`);
  const after = await still(desk, `${name} after`);
  const changed = await desk.differences(idle.shot, after.shot, idle.area);
  ensure(changed > 4, `the picture has not changed: ${changed}`);
  console.log(`  track ${track.toFixed(2)} rad, beside it ${beside.toFixed(2)}; the picture changed by ${changed.toFixed(1)} code values`);
}

export async function truck(open) {
  await drive(await open("scene=hello&steps=20&pixels=0.2&plants=0.3&cpu"), "truck");
}

// A preset and a dragged number change how far plants lean; undo takes it back.
export async function sliders(open) {
  const desk = await open(`scene=lawn&${USUAL}`);
  await desk.wait("the scene", (now) => now.step > 0);
  await desk.drop("yard.ron", YARD);
  await desk.wait("the yard", (now) => now.bodies[0]?.name === "ball");
  await desk.key("t");
  const [x, y] = await desk.place("picture");
  await desk.clickAt([x, y + 90]);
  const calm = (await desk.wait("the probe", (now) => now.probe !== null)).probe;
  await desk.click("presets wind");
  await desk.click("preset storm");
  const storm = (await desk.wait("plants that lean in the storm", (now) => now.probe > calm + 0.25)).probe;
  await still(desk, "sliders storm");
  await on(desk);
  await desk.click("undo");
  await desk.wait("plants that rise again", (now) => now.probe < calm + 0.15);
  await desk.click("presets wind");
  await desk.click("preset steady");
  await desk.click("wind");
  const before = (await desk.steps(240)).probe;
  const settled = (await desk.steps(60)).probe;
  ensure(Math.abs(settled - before) < 0.02, `control: nothing was changed, and yet ${before} became ${settled}`);
  const at = await desk.place("wind 1 velocity 1");
  await desk.drag([at, [at[0] + 20, at[1]], [at[0] + 60, at[1]]]);
  await desk.wait("plants that lean farther", (now) => now.probe > before + 0.1);
  await still(desk, "sliders dragged");
  console.log(`  calm ${calm.toFixed(3)} rad, storm ${storm.toFixed(3)}, steady ${before.toFixed(3)}`);
}

// Another scene from the menu, the same once more, a dropped file, one with a mistake: it is told with its place, and what was there goes on.
export async function scenes(open) {
  const desk = await open(`scene=lawn&${USUAL}`);
  await desk.wait("lawn", (now) => now.scene === "lawn" && now.step > 0);
  await desk.click("scene reed");
  await desk.wait("reed", (now) => now.scene === "reed" && now.step > 30);
  await shows(desk, await still(desk, "scenes reed"));
  await desk.key("r");
  const again = await desk.wait("reed from its beginning", (now) => now.scene === "reed" && now.step < 20 && !now.loading);
  ensure(again.problem === null, again.problem);
  await on(desk);
  const scene = (name) => `(\n    version: 1,\n    stands: [(species: Meadow)],\n    interactors: [(name: "${name}", shape: Sphere(radius: 0.4), path: Still(at: (0, 6)))],\n    camera: (eye: (0, 2, 0), target: (0, 0.5, 6)),\n)\n`;
  await desk.drop("mine.ron", scene("first"));
  await desk.wait("the dropped scene", (now) => now.bodies[0]?.name === "first");
  await desk.drop("mine.ron", scene("second").replace("radius: 0.4", "radios: 0.4"));
  const { problem } = await desk.wait("the mistake", (now) => now.problem !== null);
  ensure(problem.includes("mine.ron:4:") && problem.includes("radius"), problem);
  const later = await desk.steps(20);
  ensure(later.bodies[0].name === "first", "the last good scene goes on");
  await still(desk, "scenes mistake");
  await desk.drop("mine.ron", scene("third"));
  const mended = await desk.wait("the mended scene", (now) => now.bodies[0]?.name === "third");
  ensure(mended.problem === null, mended.problem);
  console.log(`  ${problem.split("\n")[0]}`);
}

// A name that no scene has is told, with those that there are.
export async function names(open) {
  const desk = await open(`scene=nowhere&wind=3&${USUAL}`);
  const { problem, notice } = await desk.wait("what is wrong", (now) => now.problem !== null);
  ensure(problem.includes("nowhere") && problem.includes("hello"), problem);
  ensure(notice?.includes("wind=3"), `control: what the address says is not understood: ${notice}`);
}

// Cells on the graphics device: they step while nobody waits, come to the processor when somebody looks, and go back.
export async function device(open) {
  const desk = await open("scene=lawn&steps=4&pixels=0.2&plants=0.3&gpu");
  await desk.wait("the scene", (now) => now.step > 0);
  await desk.drop("yard.ron", YARD);
  await desk.wait("steps on the device", (now) => now.bodies[0]?.name === "ball" && now.backend === "gpu" && now.step > 20);
  await desk.click("look bend");
  const { looked } = await desk.wait("bends", (now) => now.looked.length === 1);
  ensure(looked[0].startsWith("Bend"), looked[0]);
  const { step } = await desk.steps(10);
  await desk.click("look bend");
  await desk.click("presets wind");
  await desk.click("preset storm");
  await desk.steps(10);
  await desk.click("cpu");
  const cpu = await desk.wait("the processor to go on", (now) => now.backend === "cpu" && now.step > step + 10);
  await desk.click("gpu");
  const gpu = await desk.wait("the device to go on", (now) => now.backend === "gpu" && now.step > cpu.step + 10);
  ensure(gpu.problem === null, gpu.problem);
  await shows(desk, await still(desk, "device"));
  console.log(`  ${looked[0]}`);
}

// No graphics device: a message says so, and the processor draws; everything else is the same.
export async function without(open) {
  const desk = await open("scene=hello&steps=6", { kind: "webgl" });
  const { notice } = await desk.wait("the message", (now) => now.notice !== null);
  ensure(notice.includes("WebGPU") && notice.includes("Chrome"), notice);
  await drive(desk, "without");
}

// On a phone: one finger turns, two move and pinch, and a stick drives while another finger turns.
export async function fingers(open) {
  const desk = await open("scene=hello&steps=6&plants=0.05", { kind: "webgl", touch: true, size: PHONE });
  const begun = await desk.wait("the scene", (now) => now.step > 0);
  ensure(begun.marks.stick === undefined, "control: no finger was there yet");
  const [x, y] = await desk.place("picture");
  await desk.touch([x, y]);
  await desk.touch([x + 60, y]);
  await desk.touch();
  const orbit = await desk.wait("a turned camera", (now) => now.camera === "orbit");
  await desk.touch([x - 40, y], [x + 40, y]);
  await desk.touch([x - 90, y], [x + 90, y]);
  await desk.touch();
  await desk.wait("a camera that came nearer", (now) => now.away < 0.7 * orbit.away);
  await desk.tap("fold");
  await desk.tap("take the wheel");
  await desk.tap("fold");
  await desk.tap("fold");
  const { bodies: [from] } = await desk.wait("a stick", (now) => now.marks.stick);
  const stick = await desk.place("stick");
  await desk.touch(stick);
  await desk.touch([stick[0] + 12, stick[1] - 60]);
  const { wheel } = await desk.wait("the truck to drive", (now) => apart(from, now.bodies[0]) > 6);
  await still(desk, "fingers");
  await on(desk);
  await desk.touch([stick[0] + 12, stick[1] - 60], [x, y]);
  await desk.touch([stick[0] + 12, stick[1] - 60], [x + 80, y]);
  await desk.touch();
  const { speed } = (await desk.steps(120)).wheel;
  ensure(wheel.speed > 2 && speed < wheel.speed + 1, `it rolls out: ${wheel.speed} ${speed}`);
}

// F9 begins a clip of the page and ends it; the browser saves it.
export async function clip(open) {
  const desk = await open("scene=lawn&steps=2", { kind: "webgl" });
  await desk.wait("the scene", (now) => now.step > 0);
  await desk.key("F9");
  await desk.steps(20);
  const saved = desk.page.waitForEvent("download", { timeout: 60_000 });
  await desk.key("F9");
  const file = await saved;
  ensure(/^lawn\.(mp4|webm)$/.test(file.suggestedFilename()), file.suggestedFilename());
  const { size } = await stat(await file.path());
  ensure(size > 5000, `the clip is ${size} bytes long`);
  const now = await desk.now();
  ensure(now.problem === null && now.notice.includes(file.suggestedFilename()), `${now.problem} ${now.notice}`);
  console.log(`  ${file.suggestedFilename()}: ${size} bytes`);
}

// Neither WebGPU nor WebGL: the picture alone, with the same keys.
export async function plain(open) {
  const desk = await open("scene=hello&steps=6", { kind: "nothing" });
  const { notice } = await desk.wait("the message", (now) => now.notice !== null);
  ensure(notice.includes("WebGPU") && notice.includes("WebGL"), notice);
  const shown = await desk.page.textContent("#aside");
  ensure(shown === notice, `the page says "${shown}"`);
  await desk.wait("the scene", (now) => now.step > 0);
  await desk.page.keyboard.press("e");
  const { bodies: [from] } = await desk.wait("somebody at the wheel", (now) => now.driving === "pickup");
  await desk.hold("w", true);
  await desk.wait("the truck to drive", (now) => apart(from, now.bodies[0]) > 6);
  await desk.hold("w", false);
  await desk.page.keyboard.press("p");
  const shot = await desk.shot("plain");
  await shows(desk, { shot, area: [0, 0, 1000, 640] });
}

// While scenes are opened nothing keeps the page from answering: none of its tasks works for more than a tenth of a second. The thread's own time counts,
// since a software device takes its processor away. On the clock a task may take no longer than 400 ms: a page that waits for
// the device stands still, too. The browser's waiting for something to do is a task in which it does not work.
export async function tasks(open) {
  let longest;
  // What else the machine does adds to a time and never takes from it: the shortest of three counts.
  for (let time = 0; time < 3 && !(longest?.own < 100 && longest.whole < 400); time += 1) longest = await opened(open);
  ensure(longest.own < 100, "the page does not answer");
  ensure(longest.whole < 400, "the page waits for the device");
}

// The longest of the tasks while two scenes are opened, one after the other.
async function opened(open) {
  const desk = await open("scene=nowhere&steps=1&pixels=0.2&cpu", { traced: true });
  await desk.wait("the page", (now) => now.problem !== null);
  await desk.click("scene hello");
  await desk.wait("hello", (now) => now.scene === "hello" && now.step > 2);
  // While the device still draws that.
  await desk.click("scene reed");
  await desk.wait("reed", (now) => now.scene === "reed" && now.step > 2);
  const found = (await desk.tasks()).filter((task) => task.own > 20).sort((one, other) => other.own - one.own);
  ensure(found.length > 2, "control: opening takes some work");
  console.log(`  longest tasks: ${found.slice(0, 8).map(({ at, whole, own }) => `${own.toFixed(0)} ms of ${whole.toFixed(0)} at ${at.toFixed(0)}`).join(", ")}`);
  return { own: found[0].own, whole: Math.max(...found.map((task) => task.whole)) };
}
