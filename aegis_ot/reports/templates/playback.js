"use strict";
// Plays a rehearsal. The page holds the steps; what wells and tips hold is worked out here, step by
// step. All words of a protocol reach the page as text, never as markup.
(() => {
const SVG = "http://www.w3.org/2000/svg";
const COLOURS = ["#38bdf8", "#f472b6", "#facc15", "#4ade80", "#c084fc", "#fb923c", "#2dd4bf", "#f87171", "#a3e635", "#818cf8"];
const EVERY = 400; // steps between two states that are kept, so that going back is quick
const WIDE = 136, HIGH = 96, CASE = [127.8, 85.5]; // of a slot and of a labware, mm

const el = (name, attributes = {}, text = "") => {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text) made.textContent = text;
  return made;
};
const html = (name, text = "", kind = "") => {
  const made = document.createElement(name);
  if (text) made.textContent = text;
  if (kind) made.className = kind;
  return made;
};
const ul = (volume) => {
  const digits = Math.abs(volume) < 10 ? 2 : Math.abs(volume) < 100 ? 1 : 0;
  return `${Number(volume.toFixed(digits)).toLocaleString("en")} µL`;
};
const several = (count, word) => `${count.toLocaleString("en")} ${word}${count === 1 ? "" : "s"}`;

class Player {
  constructor(root) {
    this.root = root;
    this.data = JSON.parse(root.querySelector("script").textContent);
    this.find = (selector) => root.querySelector(selector);
    this.labwareOf = []; // by number of a well
    this.wellOf = [];
    this.data.labware.forEach((labware, index) => this.data.shapes[labware.shape].wells.forEach((well, place) => {
      this.labwareOf[labware.first + place] = index;
      this.wellOf[labware.first + place] = well;
    }));
    this.through = new Set(this.data.through);
    this.nameLiquids();
    this.states = [this.begin()];
    this.at = 0; // steps done
    this.shown = null; // labware that a person has chosen to look at
    this.chosen = null;
    this.drawDeck();
    this.bind();
    this.needs();
    this.find(".player").hidden = false;
    this.go(0);
  }

  // Names

  nameLiquids() {
    this.liquid = new Map(); // of each well that held something before the run
    this.colours = new Map();
    for (const [well, held, name, role] of this.data.start) {
      if (held === 0) continue;
      const labware = this.data.labware[this.labwareOf[well]];
      const called = name || role.replaceAll("_", " ") || labware.name;
      this.liquid.set(well, called);
      if (!this.colours.has(called)) {
        const number = this.colours.size;
        this.colours.set(called, COLOURS[number] || `hsl(${(number * 137.5) % 360} 65% 62%)`);
      }
    }
  }
  well(number) { return this.wellOf[number][0]; }
  wells(numbers) {
    const names = [...new Set(numbers.filter((one) => one >= 0))];
    if (!names.length) return "";
    const labware = this.data.labware[this.labwareOf[names[0]]], first = this.well(names[0]);
    const range = names.length > 1 ? `${first} to ${this.well(names.at(-1))}` : first;
    const slot = this.state.slots[this.labwareOf[names[0]]];
    return `${range} of ${labware.name}${slot ? ` (slot ${slot})` : ""}`;
  }
  colour(parts) {
    let total = 0, mixed = [0, 0, 0];
    for (const [origin, volume] of parts) {
      const [r, g, b] = rgb(this.colours.get(this.liquid.get(origin)) || "#94a3b8");
      mixed = [mixed[0] + volume * r * r, mixed[1] + volume * g * g, mixed[2] + volume * b * b];
      total += volume;
    }
    return total > 1e-9 ? `rgb(${mixed.map((one) => Math.round(Math.sqrt(one / total))).join(" ")})` : "";
  }

  // What wells and tips hold

  begin() {
    const wells = new Map();
    for (const [number, held] of this.data.start) {
      const capacity = this.wellOf[number][6];
      const known = held !== null;
      const there = known ? held : (isFinite(capacity) && capacity > 0 ? capacity / 2 : 1000);
      wells.set(number, { known, volume: held || 0, parts: there > 0 ? new Map([[number, there]]) : new Map() });
    }
    return {
      wells, racks: new Map(), returned: new Map(), net: new Map(), low: new Map(), tips: new Map(),
      hands: this.data.pipettes.map(() => new Map()), slots: this.data.labware.map((one) => one.slot),
    };
  }
  contents(state, number) {
    if (!state.wells.has(number)) state.wells.set(number, { known: true, volume: 0, parts: new Map() });
    return state.wells.get(number);
  }
  goTo(step) {
    const kept = Math.min(Math.floor(step / EVERY), this.states.length - 1);
    const from = kept * EVERY;
    if (!this.state || step < this.at || from > this.at) {
      this.state = structuredClone(this.states[kept]);
      this.at = from;
    }
    while (this.at < step) {
      this.apply(this.state, this.data.steps[this.at]);
      this.at += 1;
      if (this.at % EVERY === 0 && this.states.length === this.at / EVERY) this.states.push(structuredClone(this.state));
    }
  }
  apply(state, [kind, , actor, volume, group]) {
    if (group === undefined) return this.happen(state, kind, actor, volume);
    const [nozzles, wells] = this.data.groups[group], hand = state.hands[actor];
    if (kind === "pick") return this.pick(state, hand, nozzles, wells);
    nozzles.forEach((nozzle, index) => {
      const tip = hand.get(nozzle), well = wells[index] ?? -1;
      if (kind === "drop") {
        if (tip && well >= 0) { state.returned.set(well, tip); state.racks.set(well, 2); }
        hand.delete(nozzle);
      } else if (tip) this.act(state, kind, tip, well, volume);
    });
    if (kind === "drop") hand.clear();
  }
  happen(state, kind, labware, text) {
    if (labware < 0) return;
    if (kind === "move") state.slots[labware] = text;
    const { first, shape } = this.data.labware[labware], count = this.data.shapes[shape].wells.length;
    for (let number = first; number < first + count; number++) {
      if (kind === "refill" && state.racks.get(number) === 1) state.racks.delete(number);
      if (kind === "fresh") { state.wells.delete(number); state.racks.delete(number); state.returned.delete(number); }
    }
  }
  pick(state, hand, nozzles, wells) {
    const lead = wells.find((one) => one >= 0);
    nozzles.forEach((nozzle, index) => {
      const home = wells[index] ?? -1, back = state.returned.get(home);
      const bare = lead !== undefined && (home < 0 || (state.racks.get(home) === 1 && home !== lead));
      hand.delete(nozzle);
      if (!back && bare) return;
      state.returned.delete(home);
      if (home >= 0) {
        state.racks.set(home, 1);
        const rack = this.labwareOf[home];
        if (!back) state.tips.set(rack, (state.tips.get(rack) || 0) + 1);
      }
      hand.set(nozzle, back || { layers: [] });
    });
  }
  act(state, kind, tip, well, volume) {
    if (kind === "air" || (kind === "draw" && well < 0)) return tip.layers.push({ volume, parts: null });
    if (kind === "draw") {
      const held = this.contents(state, well);
      const total = [...held.parts.values()].reduce((sum, one) => sum + one, 0);
      const drawn = new Map();
      for (const [origin, share] of held.parts) drawn.set(origin, volume * share / total);
      if (total > 0 && (held.known || held.parts.size > 1)) {
        const left = Math.max(total - volume, total * 0.01) / total;
        for (const [origin, share] of held.parts) held.parts.set(origin, share * left);
      }
      held.volume = held.known ? Math.max(0, held.volume - volume) : held.volume - volume;
      if (held.known && held.volume < 1e-6) held.parts.clear();
      this.count(state, well, -volume);
      tip.layers.push({ volume, parts: drawn });
    } else if (kind === "give" || kind === "blow") {
      let left = kind === "blow" ? Infinity : volume;
      while (tip.layers.length && left > 1e-6) {
        const last = tip.layers.at(-1), out = Math.min(last.volume, left), part = out / last.volume;
        left -= out;
        if (last.parts && well >= 0) this.receive(state, well, out, last.parts, part);
        if (out >= last.volume - 1e-6) tip.layers.pop();
        else {
          last.volume -= out;
          if (last.parts) for (const [origin, share] of last.parts) last.parts.set(origin, share * (1 - part));
        }
      }
    }
  }
  receive(state, well, volume, parts, part) {
    if (this.through.has(well)) return;
    const held = this.contents(state, well);
    held.volume += volume;
    for (const [origin, share] of parts) held.parts.set(origin, (held.parts.get(origin) || 0) + share * part);
    this.count(state, well, volume);
  }
  count(state, well, volume) {
    const net = (state.net.get(well) || 0) + volume;
    state.net.set(well, net);
    if (net < (state.low.get(well) || 0)) state.low.set(well, net);
  }

  // Words

  tell(step) {
    if (!step) return "Before the first step.";
    const [kind, , actor, volume, group] = step;
    if (group === undefined) {
      const name = actor >= 0 ? this.data.labware[actor].name : "";
      return {
        pause: `The run pauses${volume ? `: ${volume}` : "."}`, say: `The protocol says: ${volume}`,
        module: `${volume}${name ? ` (${name})` : ""}`, refill: `Fresh tips stand in ${name}.`,
        move: `${name} is moved ${volume ? `to slot ${volume}` : "off the deck"}.`,
        fresh: `Another ${name} stands there.`,
      }[kind];
    }
    const hand = this.data.pipettes[actor], wells = this.data.groups[group][1];
    const where = this.wells(wells), who = `${hand.name}, ${hand.mount}`, each = wells.length > 1 ? " each" : "";
    const into = where || "the trash";
    return {
      pick: `Picks up ${several(wells.length, "tip")}${where ? ` from ${where}` : ""}`,
      drop: where ? `Puts the tips back to ${where}` : "Drops the tips",
      draw: `Draws ${ul(volume)}${each} from ${where}`, give: `Gives ${ul(volume)}${each} into ${into}`,
      air: `Draws ${ul(volume)} of air`, blow: `Blows out into ${into}`, touch: `Touches the wall of ${where}`,
    }[kind] + ` (${who})`;
  }
  list(parts, total) {
    const groups = new Map();
    for (const [origin, volume] of parts) {
      if (volume < 5e-4) continue;
      const name = this.liquid.get(origin) || "unknown liquid";
      const one = groups.get(name) || groups.set(name, { volume: 0, origins: [] }).get(name);
      one.volume += volume;
      one.origins.push(origin);
    }
    const made = html("ul", "", "parts");
    for (const [name, one] of [...groups].sort((a, b) => b[1].volume - a[1].volume)) {
      const line = html("li"), dot = html("span", "", "dot");
      dot.style.background = this.colours.get(name) || "#94a3b8";
      const from = one.origins.length > 1 ? several(one.origins.length, "well") : `${this.well(one.origins[0])} of ${this.data.labware[this.labwareOf[one.origins[0]]].name}`;
      line.append(dot, `${total === null ? "" : `${ul(one.volume)} `}${name}`, html("span", ` from ${from}`, "faint"));
      made.append(line);
    }
    return made;
  }

  // The deck

  drawDeck() {
    const deck = this.find(".deck"), slots = new Set(this.data.labware.map((one) => one.slot));
    for (const [kind, , , text] of this.data.steps) if (kind === "move") slots.add(text);
    this.flex = [...slots].some((slot) => /^[A-D][1-4]$/.test(slot));
    const columns = this.flex && [...slots].some((slot) => slot.endsWith("4")) ? 4 : 3;
    const away = slots.has("");
    this.columns = columns;
    const names = this.flex
      ? ["A", "B", "C", "D"].flatMap((row) => [...Array(columns).keys()].map((column) => row + (column + 1)))
      : [...Array(12).keys()].map((number) => String(number + 1));
    deck.setAttribute("viewBox", `-2 -6 ${columns * WIDE + 4} ${4 * HIGH + 8 + (away ? HIGH : 0)}`);
    for (const name of names) {
      const [x, y] = this.place(name);
      deck.append(el("rect", { class: "slot", x, y, width: WIDE - 4, height: HIGH - 4, rx: 3 }));
      deck.append(el("text", { class: "big", x: x + WIDE / 2 - 2, y: y + HIGH / 2 + 4, "text-anchor": "middle" }, name));
    }
    if (away) deck.append(el("text", { class: "place", x: 2, y: 4 * HIGH + 10 }, "off the deck"));
    this.cases = this.data.labware.map((labware, index) => this.drawLabware(labware, index));
    this.holes = [];
    this.data.labware.forEach((labware, index) => this.data.shapes[labware.shape].wells.forEach((well, place) => {
      if (labware.kind === "trash") return;
      const hole = shape(well, labware.kind === "tips" ? "tip" : "hole", CASE[1] - well[2]);
      this.cases[index].group.append(hole);
      this.holes[labware.first + place] = hole;
    }));
    deck.addEventListener("click", (event) => this.look(event));
    const legend = this.find(".liquids");
    for (const [name, colour] of [...this.colours].slice(0, 40)) {
      const dot = html("span", "", "dot"), one = html("span");
      dot.style.background = colour;
      one.append(dot, name);
      legend.append(one);
    }
  }
  drawLabware(labware, index) {
    const group = el("g", { class: "pin", "data-labware": index });
    const wells = labware.kind === "trash" ? 0 : this.data.shapes[labware.shape].wells.length;
    const rect = el("rect", { class: "case", x: 0, y: 0, width: CASE[0], height: CASE[1], rx: 4, tabindex: wells ? 0 : -1, role: "button", "aria-label": labware.name });
    const short = labware.name.length > 30 ? `${labware.name.slice(0, 29)}…` : labware.name;
    const name = el("text", { class: "name", x: 17, y: -1.5 }, short), place = el("text", { class: "place", x: 1, y: -1.5 });
    rect.append(el("title", {}, labware.name));
    group.append(rect, name, place);
    this.find(".deck").append(group);
    return { group, rect, place };
  }
  place(slot) {
    const row = this.flex ? slot.charCodeAt(0) - 65 : 3 - Math.floor((Number(slot) - 1) / 3);
    const column = this.flex ? Number(slot[1]) - 1 : (Number(slot) - 1) % 3;
    return [column * WIDE, row * HIGH];
  }
  arrange() {
    let away = 0;
    this.cases.forEach(({ group, place }, index) => {
      const slot = this.state.slots[index], known = /^([A-D][1-4]|[1-9]|1[0-2])$/.test(slot);
      const [x, y] = known ? this.place(slot) : [away++ * WIDE, 4 * HIGH + 4];
      group.setAttribute("transform", `translate(${x + 2} ${y + 8}) scale(.985)`);
      group.style.display = known || away <= this.columns ? "" : "none";
      place.textContent = known ? slot : "";
    });
  }
  look(event) {
    const group = event.target.closest("[data-labware]");
    if (!group) return;
    const index = Number(group.dataset.labware), labware = this.data.labware[index];
    if (labware.kind === "trash" || !this.data.shapes[labware.shape].wells.length) return;
    this.shown = index;
    const hole = this.holes.indexOf(event.target);
    if (hole >= 0 && labware.kind === "wells") this.chosen = hole;
    this.render();
  }

  // Showing a step

  go(step) {
    this.goTo(Math.max(0, Math.min(this.data.steps.length, step)));
    this.render();
  }
  render() {
    const steps = this.data.steps, step = this.at ? steps[this.at - 1] : null;
    const slider = this.find("input[type=range]");
    slider.max = steps.length;
    slider.value = this.at;
    slider.setAttribute("aria-valuetext", `step ${this.at} of ${steps.length}`);
    const line = step?.[1] ?? null;
    this.find(".count").textContent = `Step ${this.at.toLocaleString("en")} of ${steps.length.toLocaleString("en")}`;
    this.find(".told").textContent = this.tell(step);
    this.find(".source code").textContent = line === null ? "" : `${this.data.unit} ${line}: ${this.data.lines[line] ?? ""}`;
    const busy = step && step.length === 5 ? this.data.groups[step[4]][1].filter((one) => one >= 0) : [];
    const marked = this.data.marks.filter((mark) => mark.steps.includes(this.at - 1));
    this.find(".marks").replaceChildren(...this.data.marks.map((mark) => this.markButton(mark, marked)));
    this.arrange();
    this.paint(new Set(busy), marked.length > 0);
    this.drawTips(step);
    const liquid = busy.map((one) => this.labwareOf[one]).find((one) => this.data.labware[one].kind === "wells");
    if (liquid !== undefined && this.shown === null) this.last = liquid;
    const first = this.data.labware.findIndex((one) => one.kind === "wells" && this.data.shapes[one.shape].wells.length);
    this.drawCloser(this.shown ?? this.last ?? (first < 0 ? 0 : first), new Set(busy), marked.length > 0);
    this.drawChosen();
  }
  markButton(mark, here) {
    const next = mark.steps.find((step) => step + 1 > this.at) ?? mark.steps[0];
    const made = html("button", `${mark.rule}: ${mark.text.length > 90 ? `${mark.text.slice(0, 88)}…` : mark.text}`, `${mark.severity}${here.includes(mark) ? " here" : ""}`);
    made.type = "button";
    made.title = mark.text;
    made.addEventListener("click", () => { this.shown = null; this.go(next + 1); });
    return made;
  }
  paint(busy, marked) {
    const told = new Set([...busy].map((one) => this.labwareOf[one]));
    this.cases.forEach(({ rect }, index) => rect.setAttribute("class", `case${this.data.labware[index].kind === "trash" ? " bin" : ""}${told.has(index) ? marked ? " mark" : " at" : ""}`));
    this.painted ??= [];
    this.holes.forEach((hole, number) => {
      const rack = this.data.labware[this.labwareOf[number]].kind === "tips";
      const stands = rack ? ["", " taken", " used"][this.state.racks.get(number) || 0] : "";
      const mark = busy.has(number) ? (marked ? " mark" : " at") : number === this.chosen ? " chosen-well" : "";
      const held = rack ? null : this.state.wells.get(number);
      const fill = held ? this.colour(held.parts) : "", look = (rack ? "tip" : "hole") + stands + mark;
      if (this.painted[number] === look + fill) return;
      this.painted[number] = look + fill;
      hole.setAttribute("class", look);
      hole.style.fill = fill;
    });
  }
  drawTips(step) {
    const acting = step?.length === 5 ? step[2] : -1;
    const byMount = this.data.pipettes.map((pipette, index) => [pipette, index]).sort((a, b) => (a[0].mount > b[0].mount ? 1 : -1));
    this.find(".tips").replaceChildren(...byMount.map(([pipette, index]) => {
      const hand = this.state.hands[index], made = html("div", "", `pipette${acting === index ? "" : " idle"}`);
      const words = html("div"), tips = [...hand.values()];
      words.append(html("h4", `${pipette.name}, ${pipette.mount}`));
      if (!tips.length) words.append(html("p", "no tip", "faint"));
      else this.tellTips(tips, words);
      made.append(this.drawHand(pipette, hand), words);
      return made;
    }));
  }
  tellTips(tips, words) {
    const volumes = tips.map((tip) => tip.layers.reduce((sum, one) => sum + (one.parts ? one.volume : 0), 0));
    const air = Math.max(...tips.map((tip) => tip.layers.reduce((sum, one) => sum + (one.parts ? 0 : one.volume), 0)));
    const least = Math.min(...volumes), most = Math.max(...volumes);
    const held = most < 1e-3 ? "no liquid" : most - least < 1e-3 ? `${ul(most)}${tips.length > 1 ? " each" : ""}` : `${ul(least)} to ${ul(most)}`;
    words.append(html("p", `${tips.length > 1 ? `${tips.length} tips, ` : ""}${held}${air > 1e-3 ? `, ${ul(air)} of air` : ""}`));
    const all = new Map();
    for (const tip of tips) for (const layer of tip.layers) for (const [origin, volume] of layer.parts || []) all.set(origin, (all.get(origin) || 0) + volume / tips.length);
    words.append(this.list(all, 0));
  }
  drawHand(pipette, hand) {
    const many = pipette.channels > 8, high = 96;
    if (many) {
      const made = el("svg", { viewBox: "0 0 120 80", width: 120, height: 80, "aria-hidden": "true" });
      for (let row = 0; row < 8; row++) for (let column = 0; column < 12; column++) {
        const tip = hand.get(`${"ABCDEFGH"[row]}${column + 1}`);
        const dot = el("circle", { class: tip ? "glass" : "glass bare", cx: 5 + 10 * column, cy: 5 + 10 * row, r: 4 });
        if (tip) dot.style.fill = this.colour(tip.layers.flatMap((one) => [...one.parts || []])) || "none";
        made.append(dot);
      }
      return made;
    }
    const wide = 17, made = el("svg", { viewBox: `0 0 ${wide * pipette.channels} ${high}`, width: wide * pipette.channels, height: high, "aria-hidden": "true" });
    const nozzles = pipette.channels === 1 ? ["A1"] : [..."ABCDEFGH"].map((row) => `${row}1`);
    const named = pipette.channels === 1 ? [...hand.keys()] : nozzles;
    (named.length ? named : nozzles).forEach((nozzle, index) => {
      const tip = hand.get(nozzle), x = index * wide + 2;
      let bottom = high - 2;
      for (const layer of tip ? [...tip.layers].reverse() : []) {
        const height = Math.min(bottom - 2, (high - 6) * layer.volume / pipette.max);
        const part = el("rect", { x, y: bottom - height, width: wide - 4, height, class: layer.parts ? "" : "air" });
        if (layer.parts) part.style.fill = this.colour(layer.parts);
        made.append(part);
        bottom -= height;
      }
      made.append(el("path", { class: tip ? "glass" : "glass bare", d: `M${x} 2v${high - 4}h${wide - 4}v${4 - high}` }));
    });
    return made;
  }
  drawCloser(index, busy, marked) {
    const labware = this.data.labware[index], svg = this.find(".closer svg");
    if (!labware) return;
    const wells = this.data.shapes[labware.shape].wells, slot = this.state.slots[index];
    this.find(".closer h4").textContent = `${labware.name}${slot ? `, slot ${slot}` : ""}`;
    svg.setAttribute("viewBox", `-9 -9 ${CASE[0] + 11} ${CASE[1] + 11}`);
    svg.setAttribute("aria-label", labware.name);
    const rows = new Map(), columns = new Map(), made = [];
    made.push(el("rect", { class: "case", x: 0, y: 0, width: CASE[0], height: CASE[1], rx: 4 }));
    wells.forEach((well, place) => {
      const number = labware.first + place, y = CASE[1] - well[2], held = this.state.wells.get(number);
      const [, row, column] = /^([A-Z]+)(\d+)$/.exec(well[0]) || [null, "", ""];
      if (row) { rows.set(row, y); columns.set(column, well[1]); }
      const rack = labware.kind === "tips";
      const stands = rack ? `tip${["", " taken", " used"][this.state.racks.get(number) || 0]}` : "hole";
      const hole = shape(well, stands + (busy.has(number) ? marked ? " mark" : " at" : number === this.chosen ? " chosen-well" : ""), y);
      const fill = held && !rack ? this.colour(held.parts) : "";
      if (fill) hole.style.fill = fill;
      if (!rack) {
        hole.style.cursor = "pointer";
        hole.addEventListener("click", () => { this.chosen = number; this.shown = index; this.render(); });
      }
      hole.append(el("title", {}, rack ? well[0] : `${well[0]}: ${held ? this.volume(held) : "empty"}`));
      made.push(hole);
      const room = Math.min(well[3], well[4]);
      if (held && !rack && fill && room > 5) {
        const text = held.known ? String(Number(held.volume.toFixed(held.volume < 10 ? 1 : 0))) : "?";
        made.push(el("text", { class: "ul", x: well[1], y, "font-size": Math.min(7, room / Math.max(2, 0.62 * text.length)) }, text));
      }
    });
    const size = Math.min(5, 62 / Math.max(rows.size, 1), 74 / Math.max(columns.size, 1));
    for (const [row, y] of rows) made.push(el("text", { class: "axis", x: -4.5, y, "font-size": size }, row));
    for (const [column, x] of columns) made.push(el("text", { class: "axis", x, y: -4.5, "font-size": size }, column));
    svg.replaceChildren(...made);
  }
  volume(held) {
    if (held.known) return ul(held.volume);
    return `an unknown volume${Math.abs(held.volume) > 1e-6 ? ` ${held.volume < 0 ? "less" : "and"} ${ul(Math.abs(held.volume))}` : ""}`;
  }
  drawChosen() {
    const section = this.find(".chosen");
    if (this.chosen === null) return section.replaceChildren();
    const held = this.state.wells.get(this.chosen), labware = this.data.labware[this.labwareOf[this.chosen]];
    const made = [html("h4", `${this.well(this.chosen)} of ${labware.name} holds ${held ? this.volume(held) : "nothing"}`)];
    if (held) made.push(this.list(held.parts, held.known ? held.volume : null));
    const list = html("ol");
    this.data.steps.forEach((step, index) => {
      if (step.length !== 5 || step[0] === "touch" || !this.data.groups[step[4]][1].includes(this.chosen)) return;
      const kinds = { draw: "drawn", give: "given", blow: "blown out", air: "air drawn" };
      const line = html("li"), go = html("button", `Step ${(index + 1).toLocaleString("en")}: ${step[3] ? `${ul(step[3])} ` : ""}${kinds[step[0]] || step[0]}, ${this.data.unit} ${step[1] ?? "?"}`);
      go.type = "button";
      go.className = index === this.at - 1 ? "here" : index >= this.at ? "later" : "";
      go.addEventListener("click", () => this.go(index + 1));
      line.append(go);
      if (list.childElementCount < 300) list.append(line);
    });
    section.replaceChildren(...made, list);
    list.querySelector(".here")?.scrollIntoView({ block: "nearest" });
  }

  // What the run needs

  needs() {
    this.goTo(this.data.steps.length);
    const { tips, low } = this.state, racks = [], stocks = new Map();
    for (const [index, count] of tips) {
      const labware = this.data.labware[index];
      racks.push([`${labware.name}${labware.slot ? `, slot ${labware.slot}` : ""}`, several(count, "tip")]);
    }
    for (const [well, held] of this.data.start) {
      const taken = -(low.get(well) || 0);
      if (held === 0 || taken < 1e-6) continue;
      const name = this.liquid.get(well), labware = this.data.labware[this.labwareOf[well]];
      const key = `${name}\n${labware.name}\n${labware.slot}`;
      const one = stocks.get(key) || stocks.set(key, { name, labware, wells: [], taken: 0, held: 0, short: false }).get(key);
      one.wells.push(this.well(well));
      one.taken += taken;
      one.held = held === null || one.held === null ? null : one.held + held;
      one.short ||= held !== null && taken > held + 0.1;
    }
    const liquids = [...stocks.values()].map(({ name, labware, wells, taken, held, short }) => [
      `${name}: ${wells.length > 3 ? `${wells.length} wells` : wells.join(", ")} of ${labware.name}${labware.slot ? `, slot ${labware.slot}` : ""}`,
      `${ul(taken)}${held === null ? "" : ` of ${ul(held)}`}`, short,
    ]);
    const tables = html("div", "", "tables");
    tables.append(table("Tips", racks, "used"), table("Liquid before the run", liquids, "drawn"));
    this.find(".needs").append(html("h4", "What the run needs"), tables,
      html("p", "Liquid: what is drawn and not given back, where it stands. Add what a well keeps (dead volume).", "faint"));
    this.state = null;
  }

  // Hands on it

  bind() {
    const slider = this.find("input[type=range]");
    let waiting = false;
    slider.addEventListener("input", () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => { waiting = false; this.follow(); this.go(Number(slider.value)); });
    });
    this.stops = [...new Set(this.data.marks.flatMap((mark) => mark.steps))].sort((a, b) => a - b);
    this.root.addEventListener("click", (event) => {
      const button = event.target.closest("[data-do]");
      if (button) this.press(button.dataset.do);
    });
    this.find(".deck").addEventListener("keydown", (event) => {
      if (event.key === "Enter") { event.preventDefault(); this.look(event); }
    });
    for (const mark of this.data.marks) for (const step of mark.steps) {
      const tick = html("i", "", mark.severity);
      tick.style.left = `${100 * (step + 1) / this.data.steps.length}%`;
      this.find(".ticks").append(tick);
    }
    if (!this.stops.length) for (const name of ["before-mark", "next-mark"]) this.find(`[data-do=${name}]`).hidden = true;
  }
  follow() { this.shown = null; }
  press(what) {
    if (what === "play") return this.play(!this.timer);
    this.play(false);
    this.follow();
    if (what === "on") this.go(this.at + 1);
    if (what === "back") this.go(this.at - 1);
    if (what === "start") this.go(0);
    if (what === "end") this.go(this.data.steps.length);
    if (what === "next-mark") this.go((this.stops.find((step) => step + 1 > this.at) ?? this.stops.at(-1) ?? this.at - 1) + 1);
    if (what === "before-mark") this.go((this.stops.findLast((step) => step + 1 < this.at) ?? this.stops[0] ?? this.at - 1) + 1);
  }
  play(on) {
    clearInterval(this.timer);
    const pace = Math.max(1, Math.round(this.data.steps.length / 600));
    if (on && this.at >= this.data.steps.length) this.go(0);
    this.timer = on ? setInterval(() => {
      this.go(this.at + pace);
      if (this.at >= this.data.steps.length) this.play(false);
    }, 140) : null;
    const button = this.find(".go");
    button.textContent = on ? "❚❚" : "▶";
    button.setAttribute("aria-label", on ? "Stop" : "Play");
  }
}

function shape(well, kind, y) {
  const [, x, , width, height, round] = well;
  return round ? el("circle", { class: kind, cx: x, cy: y, r: width / 2 })
    : el("rect", { class: kind, x: x - width / 2, y: y - height / 2, width, height, rx: Math.min(1, width / 4) });
}

function rgb(colour) {
  if (colour.startsWith("#")) return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  const [hue, full, light] = colour.match(/[\d.]+/g).map(Number), reach = full / 100 * Math.min(light, 100 - light) / 100;
  return [0, 8, 4].map((at) => {
    const place = (at + hue / 30) % 12;
    return 255 * (light / 100 - reach * Math.max(-1, Math.min(place - 3, 9 - place, 1)));
  });
}

function table(title, rows, last) {
  const made = html("table"), head = html("thead"), line = html("tr"), body = html("tbody");
  line.append(html("th", title), html("th", last));
  head.append(line);
  for (const [name, amount, short] of rows) {
    const row = html("tr");
    row.append(html("td", name), html("td", amount + (short ? ", too little" : ""), short ? "short" : ""));
    body.append(row);
  }
  if (!rows.length) body.insertRow().append(html("td", "none"), html("td"));
  made.append(head, body);
  return made;
}

const players = new Map();
function start(root) {
  if (root.open && !players.has(root)) players.set(root, new Player(root));
  return players.get(root);
}
for (const root of document.querySelectorAll("details.playback")) {
  start(root);
  root.addEventListener("toggle", () => start(root));
}
document.addEventListener("click", (event) => {
  const button = event.target.closest(".goto");
  const root = button && document.getElementById(button.dataset.play);
  if (!root) return;
  root.open = true;
  const player = start(root);
  player.follow();
  player.go(Number(button.dataset.step) + 1);
  root.scrollIntoView({ block: "start" });
});
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input:not([type=range]), textarea, select, summary, a, .chosen button, .marks button")) return;
  const open = [...players].filter(([root]) => root.open);
  const inside = open.find(([root]) => root.contains(event.target)) || open[0];
  const what = { ArrowRight: "on", ArrowLeft: "back", " ": "play", n: "next-mark", p: "before-mark", Home: "start", End: "end" }[event.key];
  if (!inside || !what || (event.key === " " && event.target.closest("button"))) return;
  event.preventDefault();
  inside[1].press(what);
});
})();
