// The module in Node against the command: node web/test.mjs [FOLDER]
// FOLDER is that of web/build.sh; LIOUVILLE names the command, target/release/liouville by default.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { ask } from "./call.js";
import { command, timeless } from "./native.mjs";

const root = fileURLToPath(new URL("..", import.meta.url));
const folder = resolve(process.argv[2] ?? join(root, "target/playground"));
const module = new WebAssembly.Module(readFileSync(join(folder, "liouville.wasm")));
assert.deepEqual(WebAssembly.Module.imports(module), [], "the module imports nothing");

let instance = new WebAssembly.Instance(module, {});
/** Asks; a module that has failed is made anew. */
function asked(request) {
  try {
    return ask(instance, request);
  } catch (error) {
    instance = new WebAssembly.Instance(module, {});
    throw error;
  }
}

/** Entries of the cases in a document of `check --json`, byte by byte. */
function entries(document) {
  const all = document.split("\n");
  const found = [];
  let begin = -1;
  all.forEach((line, index) => {
    if (line === "    {") begin = index;
    if ((line === "    }" || line === "    },") && begin >= 0) {
      found.push([...all.slice(begin, index), "    }"].join("\n"));
      begin = -1;
    }
  });
  return found;
}

function catalogue() {
  const { stdout } = command(["check", "cases", "--json"], { cwd: root });
  const native = entries(stdout);
  const listed = new Set(asked({ ask: "cases" }).cases.map(([name]) => `cases/${name}.toml`));
  assert.equal(native.length, listed.size, "as many cases as the catalogue inside the module has");
  let claims = 0;
  let longest = { time: 0, path: "" };
  const began = process.cpuUsage();
  for (const entry of native) {
    const { path } = JSON.parse(entry);
    assert.ok(listed.has(path), path);
    const { text } = asked({ ask: "show", name: path });
    assert.equal(text, readFileSync(join(root, path), "utf8"), `${path} is that of the folder`);
    const start = performance.now();
    const answer = asked({ ask: "check", path, text });
    const time = performance.now() - start;
    if (time > longest.time) longest = { time, path };
    assert.equal(entries(answer.json)[0], entry, path);
    const count = JSON.parse(entry).claims.length;
    assert.equal(answer.shown.length, count, `${path}: a formula for each claim`);
    claims += count;
  }
  const { user, system } = process.cpuUsage(began);
  const seconds = `${((user + system) / 1e6).toFixed(1)} s of a processor`;
  const most = `${longest.path} takes ${(longest.time / 1000).toFixed(1)} s`;
  console.log(`${native.length} cases, ${claims} claims: the bytes of the command; ${seconds}, ${most}`);
}

/** Texts with a mistake, made from the cases to start from. */
function wrong() {
  const texts = ["", "title = 1", "title = 'x'\n[field]\n\"x'\" = 'y'\n", "[[claim", "\u0001"];
  for (const [name] of asked({ ask: "cases" }).templates) {
    const lines = asked({ ask: "show", name }).text.split("\n");
    lines.forEach((line, index) => {
      const changed = [
        line.replace(/([+*×−])/, "$1 $1"),
        line.replace("(", ""),
        line.replace(/[ωγxr]/, "unknown"),
        line.replace("=", ""),
      ];
      for (const other of changed.filter((other) => other !== line && !line.startsWith("#"))) {
        texts.push([...lines.slice(0, index), other, ...lines.slice(index + 1)].join("\n"));
      }
    });
  }
  return texts;
}

function mistakes() {
  const cwd = mkdtempSync(join(tmpdir(), "liouville-"));
  let failed = 0;
  const texts = wrong();
  for (const text of texts) {
    writeFileSync(join(cwd, "case.toml"), text);
    const native = command(["check", "case.toml", "--json"], { cwd });
    const answer = asked({ ask: "check", path: "case.toml", text });
    assert.equal(timeless(`${answer.json}\n`), timeless(native.stdout), text);
    assert.equal(answer.code, native.status, text);
    const messages = answer.failures.map(({ rendered }) => rendered).join("\n\n");
    assert.equal(messages && `${messages}\n`, native.stderr, text);
    failed += answer.failures.length > 0;
  }
  assert.ok(failed > 60, `${failed} mistakes`);
  console.log(`${texts.length} changed cases, ${failed} with mistakes: the bytes of the command`);
}

/** A document without the singular values in f64, which depend on the processor. */
const plain = (document) => document.replace(/"(smallest|largest_zero)": [0-9.e-]+/g, '"$1": 0');

function searches() {
  const cwd = mkdtempSync(join(tmpdir(), "liouville-"));
  for (const name of ["plane/balanced-ball", "classical/tops/kovalevskaya", "field"]) {
    const { text } = asked({ ask: "show", name });
    writeFileSync(join(cwd, "case.toml"), text);
    const options = ["--seconds", "5", "--megabytes", "300", "--blind"];
    const native = command(["search", "case.toml", "--json", ...options], { cwd });
    const request = { path: "case.toml", text, blind: true, seconds: 5, megabytes: 300 };
    const answer = asked({ ask: "search", ...request });
    assert.equal(plain(`${answer.json}\n`), plain(native.stdout), name);
    assert.equal(answer.shown.length, JSON.parse(answer.json).found.length, name);
    const names = command(["names", "case.toml"], { cwd });
    assert.equal(asked({ ask: "names", path: "case.toml", text }).text, names.stdout, name);
    const { page } = asked({ ask: "report", path: "case.toml", text });
    const own = command(["report", "case.toml", "--format", "html"], { cwd }).stdout;
    const head = (html) => html.slice(html.indexOf("<header>"), html.indexOf("</header>"));
    assert.equal(head(page), head(own), `${name}: the class of the report`);
  }
  console.log("searches, names and reports: those of the command");
}

function faults() {
  const deep = `title = "x"\n[state]\nx = "1..2"\n[field]\n"x'" = "${"(".repeat(5000)}x${")".repeat(5000)}"\n`;
  const { failures } = asked({ ask: "check", path: "case.toml", text: deep });
  assert.ok(failures.length > 0, "deep nesting is a mistake");
  assert.ok(asked({ ask: "nothing" }).failures.length > 0, "an unknown request is a mistake");
  assert.ok(asked({ ask: "show", name: "no/case" }).failures.length > 0, "so is an unknown case");
}

faults();
mistakes();
searches();
catalogue();
