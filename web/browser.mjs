// The page in a headless Chromium: node web/browser.mjs [FOLDER [PICTURES]]
// CHROMIUM names the browser; it is driven through a pipe, without packages.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createServer } from "node:http";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { command, timeless } from "./native.mjs";

const root = fileURLToPath(new URL("..", import.meta.url));
const folder = resolve(process.argv[2] ?? join(root, "target/playground"));
const pictures = process.argv[3] && resolve(process.argv[3]);
const scratch = mkdtempSync(join(tmpdir(), "liouville-"));

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };

/** Serves the folder. */
function serve() {
  const server = createServer((request, response) => {
    const name = request.url.split("?")[0].slice(1) || "index.html";
    try {
      const bytes = readFileSync(join(folder, name.replaceAll("..", "")));
      response.writeHead(200, { "Content-Type": TYPES[extname(name)] ?? "text/plain" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((done) => server.listen(0, "127.0.0.1", () => done(server)));
}

/** A browser behind a pipe of messages that end in a zero byte. */
function browser() {
  const args = ["--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
    "--no-first-run", `--user-data-dir=${join(scratch, "profile")}`, "about:blank"];
  const stdio = ["ignore", "ignore", "ignore", "pipe", "pipe"];
  const child = spawn(process.env.CHROMIUM ?? "chromium", args, { stdio });
  const waiting = new Map();
  const heard = [];
  let [count, rest] = [0, ""];
  child.stdio[4].setEncoding("utf8").on("data", (text) => {
    const parts = (rest + text).split("\0");
    rest = parts.pop();
    for (const part of parts) {
      const { id, result, error, method, params } = JSON.parse(part);
      if (method) heard.push({ method, params });
      else if (error) waiting.get(id).reject(new Error(error.message));
      else waiting.get(id).resolve(result);
    }
  });
  const send = (method, params = {}, sessionId = undefined) =>
    new Promise((resolve, reject) => {
      waiting.set(++count, { resolve, reject });
      child.stdio[3].write(`${JSON.stringify({ id: count, method, params, sessionId })}\0`);
    });
  return { child, send, heard };
}

const pause = (time) => new Promise((done) => setTimeout(done, time));

/** A page of the browser. */
async function tab({ send }) {
  const { targetId } = await send("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  const tell = (method, params) => send(method, params, sessionId);
  await tell("Page.enable");
  await tell("Runtime.enable");
  await tell("Log.enable");
  const value = async (expression) => {
    const { result, exceptionDetails } = await tell("Runtime.evaluate", { expression, returnByValue: true, awaitPromise: true });
    assert.equal(exceptionDetails, undefined, expression);
    return result.value;
  };
  const reach = async (states, time = 60_000) => {
    for (const end = Date.now() + time; Date.now() < end; await pause(30)) {
      const state = await value("document.body?.dataset.state");
      if (states.includes(state)) return state;
    }
    throw new Error(`none of ${states} but ${await value("document.body.dataset.state + ': ' + document.body.innerText.slice(0, 500)")}`);
  };
  const open = async (address) => {
    await tell("Page.navigate", { url: "about:blank" });
    await tell("Page.navigate", { url: address });
    return reach(["done", "wrong", "failed"]);
  };
  const type = async (text) => {
    await value("document.getElementById('editor').focus(); document.getElementById('editor').select()");
    await tell("Input.insertText", { text });
  };
  const click = (id) => value(`document.getElementById('${id}').click()`);
  return { tell, value, reach, open, type, click };
}

const text = (id) => `document.getElementById('${id}').textContent`;

const OWN = `title = "Euler's top, with one wrong sign"
[parameters]
I = "inertia(0.5..5)"
[state]
M = "vector(-2..2)"
[field]
"M'" = "M × inverse(I)*M"
[[claim]]
integral = "(M,M)"
[[claim]]
integral = "M1² − M2²"
`;

/** What the command says of a text under the name that the page gives it. */
function judged(text) {
  writeFileSync(join(scratch, "case.toml"), text);
  return command(["check", "case.toml", "--json"], { cwd: scratch });
}

async function cases(page, home) {
  const name = "plane/unbalanced-ball";
  assert.equal(await page.open(`${home}#case=${name}`), "done", "a case of the catalogue");
  const native = command(["check", `cases/${name}.toml`, "--json"], { cwd: root }).stdout;
  assert.equal(timeless(`${await page.value(text("json"))}\n`), timeless(native), name);
  const verdicts = await page.value("[...document.querySelectorAll('tr[data-verdict]')].map((row) => row.dataset.verdict)");
  assert.deepEqual(verdicts, JSON.parse(native).cases[0].claims.map((claim) => claim.verdict));
  assert.ok(await page.value("document.querySelectorAll('math').length") > 3, "formulas are typeset");
  assert.ok(await page.value("document.querySelectorAll('.witness').length") > 0, "witnesses are shown");
}

async function typed(page) {
  await page.type(OWN);
  await page.click("check");
  assert.equal(await page.reach(["done", "wrong", "failed"]), "done", "a case that was typed");
  const { stdout } = judged(OWN);
  assert.equal(timeless(`${await page.value(text("json"))}\n`), timeless(stdout));
  assert.match(await page.value(text("status")), /1 proved, 1 refuted, 1 against expectation/);
}

async function wrong(page) {
  const text = OWN.replace("M × inverse", "M × invers");
  await page.type(text);
  await page.click("check");
  assert.equal(await page.reach(["done", "wrong", "failed"]), "wrong", "a mistake");
  const shown = await page.value("[...document.querySelectorAll('pre.wrong')].map((one) => one.textContent).join('\\n\\n')");
  assert.equal(`${shown}\n`, judged(text).stderr);
  await page.value("document.querySelector('#answer button').click()");
  const place = await page.value("editor.value.slice(editor.selectionStart).split('\\n')[0]");
  assert.ok(place.startsWith("invers("), `the mistake is selected: ${place}`);
}

async function address(page, home) {
  await page.type(OWN);
  await page.click("check");
  await page.reach(["done"]);
  const link = await page.value("location.href");
  assert.ok(link.includes("#z="), link);
  assert.equal(await page.open(link), "done", "the address is followed");
  assert.equal(await page.value("editor.value"), OWN, "and holds the case");
  const byHand = `${home}#text=${encodeURIComponent(OWN)}&do=search`;
  assert.equal(await page.open(byHand), "done", "an address written by hand");
  assert.match(await page.value("document.querySelector('#answer').innerText"), /theorem|proved/);
  assert.equal(await page.open(`${home}#z=damaged`), "failed", "a damaged address");
}

async function others(page, home) {
  assert.equal(await page.open(`${home}#case=plane/disk&do=report`), "done", "a report");
  assert.equal(await page.value("document.querySelectorAll('iframe').length"), 1);
  await page.click("names");
  assert.equal(await page.reach(["done", "failed"]), "done", "names");
  assert.match(await page.value("document.querySelector('#answer').innerText"), /state variables/);
}

async function stopped(page, home) {
  await page.open(`${home}#case=plane/unbalanced-ball`);
  await page.value("document.getElementById('degree').value = 10; document.getElementById('steps').value = 1000");
  await page.click("search");
  await page.reach(["working"]);
  await pause(1000);
  assert.equal(await page.value("document.body.dataset.state"), "working", "the page does not hang");
  const began = Date.now();
  await page.click("stop");
  await page.reach(["stopped"], 2000);
  const time = Date.now() - began;
  await page.click("check");
  assert.equal(await page.reach(["done", "failed"]), "done", "and goes on after a stop");
  return time;
}

async function phone(page, home, dark) {
  const features = [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }];
  await page.tell("Emulation.setEmulatedMedia", { features });
  await page.tell("Emulation.setDeviceMetricsOverride", { width: 390, height: 844, deviceScaleFactor: 2, mobile: true });
  await page.open(`${home}#case=plane/unbalanced-ball`);
  const wide = await page.value("document.documentElement.scrollWidth");
  assert.ok(wide <= 390, `the page is ${wide} wide on a phone`);
  if (pictures) {
    await shot(page, `phone-${dark ? "dark" : "light"}`);
    await page.value("document.getElementById('status').scrollIntoView(); document.querySelector('.witness').click()");
    await shot(page, `phone-${dark ? "dark" : "light"}-verdicts`);
  }
  await page.tell("Emulation.clearDeviceMetricsOverride");
}

async function shot(page, name) {
  mkdirSync(pictures, { recursive: true });
  const { data } = await page.tell("Page.captureScreenshot", { format: "png" });
  writeFileSync(join(pictures, `${name}.png`), Buffer.from(data, "base64"));
}

const server = await serve();
const chromium = browser();
try {
  const home = `http://127.0.0.1:${server.address().port}/`;
  const page = await tab(chromium);
  const began = Date.now();
  await page.open(home);
  const first = Date.now() - began;
  await cases(page, home);
  if (pictures) await shot(page, "desktop");
  await typed(page);
  await wrong(page);
  await address(page, home);
  await others(page, home);
  const time = await stopped(page, home);
  await phone(page, home, false);
  await phone(page, home, true);
  const errors = chromium.heard.filter(({ method, params }) => method === "Runtime.exceptionThrown" || (method === "Log.entryAdded" && params.entry.level === "error"));
  assert.deepEqual(errors.map(({ params }) => params.entry?.text ?? params.exceptionDetails.text), []);
  console.log(`the page is ready after ${first} ms, stops after ${time} ms, and gives the bytes of the command`);
} finally {
  chromium.child.kill();
  server.close();
  await pause(300);
  rmSync(scratch, { recursive: true, force: true, maxRetries: 5 });
}
