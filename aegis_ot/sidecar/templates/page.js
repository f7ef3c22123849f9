"use strict";
// The server renders everything; this script asks for news and puts the new parts in place.
// Markup only ever comes from the server's own templates, which escape what runs tell.

const pause = (ms) => new Promise((done) => setTimeout(done, ms));
const page = document.body.dataset.page;
const shown = new Map();
let version = null;
let address = location.href;

// A countdown runs by itself: it alone is no news.
const told = (part) => part.outerHTML.replace(/data-left="\d+">\d+ s/g, "");

for (const part of document.querySelectorAll("[data-live]")) shown.set(part.id, told(part));

function busy(part, fresh) {
  // What a person types is not taken away, as long as it is about the same thing.
  const active = document.activeElement;
  if (!active || !part.contains(active) || active.tagName !== "INPUT") return false;
  const key = active.closest("[data-key]");
  return key && fresh.querySelector(`[data-key="${CSS.escape(key.dataset.key)}"]`);
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
    const now = document.importNode(part, true);
    for (const one of now.querySelectorAll("details")) if (open.has(one.id)) one.open = true;
    for (const one of now.querySelectorAll("input[name]")) if (names.get(one.name)) one.value = names.get(one.name);
    old.replaceWith(now);
    if (again) {
      const same = [...now.querySelectorAll("a, button")].find((one) => (one.getAttribute("href") || one.value) === again);
      if (same) same.focus({ preventScroll: true });
    }
  }
  const main = document.getElementById("main");
  if (fresh.body.dataset.page !== document.body.dataset.page || !main) location.reload();
  countdowns();
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
}

async function news() {
  for (;;) {
    const away = document.getElementById("away");
    try {
      const query = version === null ? "" : `?after=${version}&wait=4`;
      const answer = await fetch("/v1/news" + query, { cache: "no-store" });
      if (answer.status === 401) { location.assign("/login"); return; }
      const said = await answer.json();
      const first = version === null;
      version = said.version;
      if (!first || !away.hidden) await load(address); // what time alone changes shows too
      away.hidden = true;
      await pause(700);
    } catch (error) {
      away.hidden = false;
      await pause(2000);
    }
  }
}

// A well is shown without leaving the page: the plate stays where it is.
document.addEventListener("click", (event) => {
  const link = event.target.closest("a[href*='?well=']");
  if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  address = link.href;
  history.pushState(null, "", link.href);
  load(address).then(() => {
    const well = document.getElementById("well");
    if (well && well.getBoundingClientRect().top > innerHeight - 120) well.scrollIntoView({ block: "start" });
  });
});
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

countdowns();
setInterval(countdowns, 500);
news();
if (page === "camera") aim();
