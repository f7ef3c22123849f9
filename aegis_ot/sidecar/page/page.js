"use strict";
// Text from runs is only ever set as text content, never as markup.

const state = { run: null, well: null, overview: null, version: null, turn: 0, drawn: "" };

function make(tag, attributes, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name === "onclick") node.addEventListener("click", value);
    else if (value !== null && value !== undefined) node.setAttribute(name, value);
  }
  for (const child of children) {
    if (child !== null && child !== undefined) node.append(child);
  }
  return node;
}

const byId = (id) => document.getElementById(id);
const pause = (ms) => new Promise((done) => setTimeout(done, ms));
const runUrl = (run) => "/v1/runs/" + encodeURIComponent(run);
const number = (value, digits) =>
  typeof value === "number" ? value.toPrecision(digits || 3) : "";

async function get(url) {
  const answer = await fetch(url, { cache: "no-store" });
  if (answer.status === 401) location.assign("/login");
  const body = await answer.json();
  if (!answer.ok) throw new Error(body.error ? body.error.message : answer.statusText);
  return body;
}

function drawRuns(runs) {
  byId("runs").replaceChildren(...runs.map((run) => {
    const ended = run.finished ? run.finished.outcome : "running";
    return make("li", {}, make("button", {
      "aria-current": String(run.run === state.run), onclick: () => choose(run.run),
    }, run.protocol || run.run, make("br"), make("span", { class: "faint" },
      `${run.run}, ${ended}, ${run.keyframes} keyframes` + (run.simulated ? ", simulated" : ""))));
  }));
}

function outcome(trajectory) {
  if (trajectory.abandoned !== null) return make("span", { class: "faint" }, "abandoned");
  if (trajectory.awaiting) return make("span", { class: "undecided" }, "your decision?");
  if (!trajectory.verdict) return make("span", { class: "faint" }, "not judged yet");
  const word = trajectory.verdict.outcome;
  return make("span", { class: word }, word);
}

function drawRun() {
  const run = state.overview;
  const simulated = run.simulated ? " (simulated frames)" : "";
  const rows = run.trajectories.map((t) => {
    const v = t.judged || {};
    const row = make("tr", {
      tabindex: "0", "aria-current": String(t.trajectory === state.well),
      onclick: () => { state.well = t.trajectory; draw(); },
    },
    make("td", { class: "number" }, String(t.trajectory)), make("td", {}, t.well),
    make("td", { class: "number" }, number(v.score)),
    make("td", {}, (v.route || "").replaceAll("_", " ")),
    make("td", {}, t.verdict ? t.verdict.gate : ""), make("td", {}, outcome(t)),
    make("td", { class: "number" }, t.hold ? t.hold.seconds.toFixed(2) : ""));
    row.addEventListener("keydown", (event) => { if (event.key === "Enter") row.click(); });
    return row;
  });
  byId("run").replaceChildren(
    make("h2", {}, (run.protocol || run.run) + simulated),
    make("p", { class: "faint" },
      run.finished ? `${run.finished.outcome}. ${run.finished.detail}` : "running"),
    make("table", {},
      make("thead", {}, make("tr", {}, ...["#", "well", "score", "route", "gate", "verdict",
        "hold, s"].map((title) => make("th", { scope: "col" }, title)))),
      make("tbody", {}, ...rows)));
}

function drawFrame(keyframe, box) {
  const holder = make("div", {});
  const image = make("img", { src: keyframe.frame, alt: `${keyframe.kind} frame` });
  holder.append(image);
  if (Array.isArray(box) && box.length === 4 && box.every((x) => typeof x === "number")) {
    image.addEventListener("load", () => {
      const space = "http://www.w3.org/2000/svg";
      const svg = document.createElementNS(space, "svg");
      svg.setAttribute("viewBox", `0 0 ${image.naturalWidth} ${image.naturalHeight}`);
      const rect = document.createElementNS(space, "rect");
      ["x", "y", "width", "height"].forEach((name, i) => rect.setAttribute(name, box[i]));
      svg.append(rect);
      holder.append(svg);
    });
  }
  return make("figure", {}, holder, make("figcaption", { class: "faint" },
    `${keyframe.kind.replaceAll("_", " ")}: ${number(keyframe.expected_ul, 4)} µL expected in tip`));
}

function drawWell() {
  const t = state.overview.trajectories.find((one) => one.trajectory === state.well);
  if (!t) { byId("well").replaceChildren(); return; }
  const boxes = (t.evidence && t.evidence.boxes) || {};
  const parts = [make("h2", {}, `Trajectory ${t.trajectory}: ${t.well}`),
    make("p", {}, outcome(t), " ", t.verdict ? t.verdict.reason : t.abandoned || "")];
  if (t.judged && t.judged.outcome !== "pass") parts.push(decision(t));
  parts.push(make("div", { class: "frames" },
    ...t.keyframes.map((k) => drawFrame(k, boxes[k.kind]))));
  const facts = make("dl", {});
  const fact = (name, value) => facts.append(make("dt", {}, name), make("dd", {}, value));
  if (t.judged) {
    fact("judged", `${t.judged.outcome}, ${t.judged.route}, gate ${t.judged.gate}`);
    if (t.judged.measured_ul !== null) {
      fact("left in tip", `${number(t.judged.measured_ul, 4)} µL measured, ` +
        `${number(t.judged.expected_ul, 4)} µL expected`);
    }
  }
  for (const d of t.decisions) fact("decision", `${d.by}: ${d.outcome} ${d.note}`);
  if (t.hold) fact("hold", `${t.hold.seconds.toFixed(2)} s, ended by ${t.hold.resolution}`);
  for (const [name, value] of Object.entries(t.evidence || {})) {
    if (name !== "boxes") fact(name, typeof value === "string" ? value : JSON.stringify(value));
  }
  parts.push(make("h3", {}, "Evidence"), facts);
  byId("well").replaceChildren(...parts);
}

function decision(t) {
  const name = make("input", { value: localStorage.getItem("aegis-operator") || "", required: "" });
  const note = make("input", {});
  const said = make("span", { class: "bad", role: "alert" });
  const decide = async (word) => {
    if (!name.value.trim()) { said.textContent = "Who decides?"; name.focus(); return; }
    localStorage.setItem("aegis-operator", name.value);
    try {
      const answer = await fetch(`${runUrl(state.run)}/trajectories/${t.trajectory}/decision`, {
        method: "POST", headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ outcome: word, by: name.value.trim(), note: note.value }),
      });
      if (!answer.ok) said.textContent = (await answer.json()).error.message;
      else await refresh(null);
    } catch (error) { said.textContent = "The sidecar does not answer."; }
  };
  return make("div", { class: "decide" },
    make("label", {}, "Your name ", name), make("label", {}, "Note ", note),
    make("button", { class: "pass", onclick: () => decide("pass") }, "It passed"),
    make("button", { class: "fail", onclick: () => decide("fail") }, "It failed"), said);
}

function draw() {
  if (!state.overview) return;
  drawRun();
  // Redrawing the well would take the operator's half-typed note away.
  const shown = JSON.stringify(
    [state.run, state.overview.trajectories.find((t) => t.trajectory === state.well) || null]);
  if (shown !== state.drawn) { state.drawn = shown; drawWell(); }
}

async function choose(run) {
  state.turn += 1;
  Object.assign(state, { run, well: null, overview: null, drawn: "" });
  history.replaceState(null, "", "?run=" + encodeURIComponent(run));
  byId("well").replaceChildren();
  await refresh(null).catch(() => {});
}

async function refresh(after) {
  const turn = state.turn;
  const query = after === null ? "" : `?after=${after}&wait=15`;
  const list = await get("/v1/runs" + query);
  if (turn !== state.turn) return;
  state.version = list.version;
  if (state.run) {
    const overview = await get(runUrl(state.run));
    if (turn !== state.turn) return;
    state.overview = overview;
    if (state.well === null) {
      const flagged = overview.trajectories.filter((t) => t.judged && t.judged.outcome !== "pass");
      const first = flagged[flagged.length - 1] || overview.trajectories[0];
      state.well = first ? first.trajectory : null;
    }
  }
  drawRuns(list.runs);
  draw();
}

async function cameraHealth() {
  try {
    const { camera } = await get("/v1/health");
    byId("camera").textContent =
      `camera ${camera.kind}: ${camera.ok ? "ok" : "trouble"} ${camera.detail}`;
    byId("camera").className = camera.ok ? "faint" : "bad";
  } catch (error) {
    byId("camera").textContent = "The sidecar does not answer.";
    byId("camera").className = "bad";
  }
}

async function live() {
  for (;;) {
    try { await refresh(state.version); await pause(300); } catch (error) {
      console.error(error);
      await pause(2000);
    }
  }
}

state.run = new URLSearchParams(location.search).get("run");
cameraHealth();
setInterval(cameraHealth, 5000);
live();
