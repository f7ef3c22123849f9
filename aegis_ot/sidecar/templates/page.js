"use strict";
// The server renders everything; this script asks for news and puts the new parts in place.
// Markup only ever comes from the server's own templates, which escape what runs tell.

const pause = (ms) => new Promise((done) => setTimeout(done, ms));
const page = document.body.dataset.page;
const shown = new Map();
let version = null;
let address = location.href;

// What runs by itself is no news: a countdown, the time since the run began.
const told = (part) => part.outerHTML.replace(/data-(left|since)="\d+">[^<]*/g, "");

for (const part of document.querySelectorAll("[data-live]")) shown.set(part.id, told(part));

function busy(part, fresh) {
  // What a person types is not taken away, as long as it is about the same thing.
  const video = part.querySelector("video"), key = video?.closest("[data-key]")?.dataset.key;
  if (video && !video.paused && fresh.querySelector(`[data-key="${CSS.escape(key)}"]`)) return true;
  const active = document.activeElement;
  if (!active || !part.contains(active) || active.tagName !== "INPUT") return false;
  const typed = active.closest("[data-key]");
  return typed && fresh.querySelector(`[data-key="${CSS.escape(typed.dataset.key)}"]`);
}

function put(fresh) {
  document.title = fresh.title;
  for (const part of fresh.querySelectorAll("[data-live]")) {
    const old = document.getElementById(part.id);
    if (!old || shown.get(part.id) === told(part) || busy(old, part)) continue;
    shown.set(part.id, told(part));
    const open = new Set([...old.querySelectorAll("details[open]")].map((one) => one.id));
    const names = new Map([...old.querySelectorAll("input[name]")].map((one) => [one.name, one.value]));
    const focus = old.contains(document.activeElement) ? document.activeElement : null;
    const again = focus && (focus.getAttribute("href") || focus.value);
    // The element stays, its content is new: a reader of screens hears what changes in it.
    const now = document.importNode(part, true);
    for (const one of now.querySelectorAll("details")) if (open.has(one.id)) one.open = true;
    for (const one of now.querySelectorAll("input[name]")) if (names.get(one.name)) one.value = names.get(one.name);
    for (const one of [...old.attributes]) if (!now.hasAttribute(one.name)) old.removeAttribute(one.name);
    for (const one of now.attributes) old.setAttribute(one.name, one.value);
    old.replaceChildren(...now.childNodes);
    if (again) {
      const same = [...old.querySelectorAll("a, button")].find((one) => (one.getAttribute("href") || one.value) === again);
      if (same) same.focus({ preventScroll: true });
    }
  }
  const main = document.getElementById("main");
  if (fresh.body.dataset.page !== document.body.dataset.page || !main) location.reload();
  const columns = document.getElementById("columns"), other = fresh.getElementById("columns");
  if (columns && other) columns.className = other.className;
  countdowns();
  marks();
  call();
}

async function load(url) {
  const answer = await fetch(url, { cache: "no-store" });
  const text = await answer.text();
  const fresh = new DOMParser().parseFromString(text, "text/html");
  if (!fresh.querySelector("[data-live]")) { location.assign(url); return; }
  const live = [...document.querySelectorAll("main > [data-live], main .columns")].length;
  if (fresh.querySelectorAll("main > [data-live], main .columns").length !== live) { location.reload(); return; }
  put(fresh);
}

function countdowns() {
  for (const one of document.querySelectorAll("[data-left]")) {
    if (!one.dataset.until) one.dataset.until = String(performance.now() + 1000 * Number(one.dataset.left));
    const left = Math.max(0, (Number(one.dataset.until) - performance.now()) / 1000);
    const minutes = Math.floor(left / 60), seconds = Math.floor(left % 60);
    one.textContent = minutes ? `${minutes}:${String(seconds).padStart(2, "0")} min` : `${seconds} s`;
  }
  for (const one of document.querySelectorAll("[data-since]")) {
    if (one.dataset.told !== one.dataset.since) {
      one.dataset.told = one.dataset.since;
      one.dataset.from = String(performance.now() - 1000 * Number(one.dataset.since));
    }
    const gone = Math.max(0, (performance.now() - Number(one.dataset.from)) / 1000), minutes = Math.floor(gone / 60);
    one.textContent = minutes < 1 ? `${Math.floor(gone)} s` : minutes < 60 ? `${minutes} min`
      : `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, "0")} min`;
  }
}

async function news() {
  for (;;) {
    const away = document.getElementById("away");
    try {
      const again = Number(document.getElementById("strip")?.dataset.again || 4);
      const query = version === null ? "" : `?after=${version}&wait=${again}`;
      const answer = await fetch("/v1/news" + query, { cache: "no-store" });
      if (answer.status === 401) { location.assign("/login"); return; }
      const said = await answer.json();
      const first = version === null;
      version = said.version;
      if (!first || !away.hidden) await load(address); // what time alone changes shows too
      away.hidden = true;
      document.body.classList.remove("cut");
      await pause(700);
    } catch (error) {
      away.hidden = false;
      document.body.classList.add("cut"); // what stands there is no longer known
      await pause(2000);
    }
  }
}

// A well is shown without leaving the page: the plate stays where it is.
document.addEventListener("click", (event) => {
  const link = event.target.closest("a[href*='well='], #follow");
  if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  show(link.href);
});

function show(url) {
  address = url;
  history.pushState(null, "", url);
  load(address).then(() => {
    const well = document.getElementById("well");
    if (well && well.getBoundingClientRect().top > innerHeight - 120) well.scrollIntoView({ block: "start" });
  });
}

// How the frames are shown: it stays as a person set it.
const looks = { zoom: "zoomed", plain: "plain" };
function marks() {
  for (const [id, name] of Object.entries(looks)) {
    const on = document.body.classList.contains(name);
    document.getElementById(id)?.setAttribute("aria-pressed", String(on));
  }
}
document.addEventListener("click", (event) => {
  const button = event.target.closest("#zoom, #plain");
  if (button) { document.body.classList.toggle(looks[button.id]); marks(); }
});
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, textarea, select")) return;
  const pressed = { n: "#well a[rel=next]", p: "#well a[rel=prev]", z: "#zoom", o: "#plain" }[event.key];
  const target = pressed && document.querySelector(pressed);
  if (target) { event.preventDefault(); target.click(); }
});

// The page comes to the person: a sound and a notification when a run needs somebody.
const calls = { sound: null, wanted: false };
try { calls.wanted = localStorage.getItem("aegis-ot-call") === "yes"; } catch (error) { /* no storage: asked anew */ }
const may = () => "Notification" in window && isSecureContext && Notification.permission === "granted";

function beep() {
  try {
    calls.sound = calls.sound || new AudioContext();
    [0, 0.25, 0.5].forEach((at) => {
      const tone = calls.sound.createOscillator(), loud = calls.sound.createGain(), start = calls.sound.currentTime + at;
      tone.frequency.value = 880; loud.gain.value = 0.2;
      tone.connect(loud).connect(calls.sound.destination);
      tone.start(start); tone.stop(start + 0.15);
    });
  } catch (error) { /* this browser makes no sound */ }
}

async function call() {
  const button = document.getElementById("tell");
  if (button) button.setAttribute("aria-pressed", String(calls.wanted));
  const strip = document.getElementById("strip"), news = strip?.dataset.call;
  let last = null;
  try { last = sessionStorage.getItem("aegis-ot-called"); sessionStorage.setItem("aegis-ot-called", news || ""); } catch (error) { /* likewise */ }
  if (!calls.wanted || !news || news === last) return;
  beep();
  if (!may()) return;
  const title = document.getElementById("say").textContent, more = { body: document.querySelector("#strip .name").textContent, tag: "aegis-ot", requireInteraction: true };
  const worker = await navigator.serviceWorker?.getRegistration();
  if (worker) worker.showNotification(title, more); else new Notification(title, more);
}

document.addEventListener("click", async (event) => {
  if (!event.target.closest("#tell")) return;
  calls.wanted = !calls.wanted;
  try { localStorage.setItem("aegis-ot-call", calls.wanted ? "yes" : "no"); } catch (error) { /* likewise */ }
  call();
  const said = document.getElementById("tell-said");
  if (!calls.wanted) { said.textContent = ""; return; }
  beep();
  if ("Notification" in window && isSecureContext) await Notification.requestPermission();
  said.textContent = may() ? "This browser calls you, with a sound, while the page is open."
    : isSecureContext ? "Sound only: this browser does not allow notifications."
      : "Sound only: browsers notify over https, or on the workstation itself.";
});

async function thumbnail() {
  const picture = document.getElementById("now-picture");
  while (picture && document.contains(picture)) {
    if (!document.hidden && document.getElementById("strip")?.dataset.state !== "ended") {
      const next = new Image();
      next.src = `/camera/now.jpg?at=${Date.now()}`;
      try { await next.decode(); picture.src = next.src; picture.hidden = false; } catch (error) { picture.hidden = true; }
    }
    await pause(1000);
  }
}
window.addEventListener("popstate", () => { address = location.href; load(address); });

async function aim() {
  const say = (id, text) => { document.getElementById(id).textContent = text; };
  const percent = (share) => `${(100 * share).toFixed(share < 0.1 ? 1 : 0)} %`;
  const number = document.getElementById("aim").dataset.number;
  let best = 0;
  for (;;) {
    try {
      const answer = await fetch(`/v1/camera/view?number=${number}`, { cache: "no-store" });
      const seen = await answer.json();
      if (!answer.ok) throw new Error(seen.error.message);
      document.getElementById("view").setAttribute("viewBox", `0 0 ${seen.width} ${seen.height}`);
      const picture = document.getElementById("picture"), tip = document.getElementById("tip");
      picture.setAttribute("width", seen.width); picture.setAttribute("height", seen.height);
      picture.setAttribute("href", seen.picture);
      tip.setAttribute("visibility", seen.tip ? "visible" : "hidden");
      if (seen.tip) ["x", "y", "width", "height"].forEach((name, i) => tip.setAttribute(name, seen.tip[i]));
      best = Math.max(best, seen.sharpness);
      document.getElementById("sharpness").value = best ? seen.sharpness / best : 0;
      say("aim-said", seen.advice.join(" "));
      say("aim-tip", seen.tip ? `found, ${percent(seen.confidence)} sure, ${Math.round(seen.tip[3])} px long` : "not found");
      say("aim-sharpness", seen.sharpness.toFixed(0)); say("aim-best", `best ${best.toFixed(0)}`);
      say("aim-brightness", percent(seen.brightness)); say("aim-dark", percent(seen.dark));
      say("aim-bright", percent(seen.blown)); say("aim-size", `${seen.width} × ${seen.height} px`);
      await pause(250);
    } catch (error) {
      say("aim-said", String(error.message || error));
      await pause(2000);
    }
  }
}

navigator.serviceWorker?.register("/sw.js").catch(() => {});
countdowns();
setInterval(countdowns, 500);
marks();
call();
thumbnail();
news();
if (page === "camera") aim();
