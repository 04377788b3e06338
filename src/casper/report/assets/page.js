"use strict";
(() => {
  const data = JSON.parse(document.getElementById("recording").textContent);
  const { states, events, span } = data;
  const [first, last] = span;
  const byId = (id) => document.getElementById(id);
  const slider = byId("slider"), clock = byId("clock"), play = byId("play"), speed = byId("speed");
  const all = (selector, root) => Array.from((root || document).querySelectorAll(selector));
  const keyed = (attribute) => new Map(all(`[data-${attribute}]`).map((e) => [e.getAttribute(`data-${attribute}`), e]));
  const agents = keyed("agent"), objects = keyed("object"), trails = keyed("trail"), gazes = keyed("gaze"), tables = all("[data-whose]");
  const moments = all(".moments li"), articles = all("article[data-t]"), lanes = document.querySelector(".lanes");
  const times = Array.from(new Set(moments.map((e) => Number(e.dataset.t)))).sort((a, b) => a - b);
  const ofType = (...types) => events.filter((e) => types.includes(e.type));
  const focus = ofType("focus"), movement = ofType("movement"), believed = ofType("reading", "episode"), told = ofType("plan", "withdrawn", "robot", "episode");
  let now = first, timer = null, before = 0;

  const own = (table, name) => (Object.hasOwn(table, name) ? table[name] : undefined); // a name may be any word, constructor, too
  const said = (text) => own(data.told, text) ?? text;

  // --- looking up ----------------------------------------------------------------------------------------------
  function index(list, t, key) { // of the last that is no later, -1 for none
    let low = 0, high = list.length;
    while (low < high) { const middle = (low + high) >> 1; if (key(list[middle]) <= t + 1e-9) low = middle + 1; else high = middle; }
    return low - 1;
  }
  const latest = (list, t) => list[index(list, t, (e) => e.t)];
  function between(column, t) { // where something was, in a straight line between two states
    const at = Math.max(0, index(states.t, t, (s) => s)), here = column[at], next = column[at + 1];
    if (!here) return null;
    if (!next) return here;
    const share = Math.min(1, Math.max(0, (t - states.t[at]) / (states.t[at + 1] - states.t[at])));
    const mixed = here.slice();
    mixed[0] += (next[0] - here[0]) * share;
    mixed[1] += (next[1] - here[1]) * share;
    if (here.length > 2) { const turn = next[2] - here[2]; mixed[2] += Math.atan2(Math.sin(turn), Math.cos(turn)) * share; }
    return mixed;
  }

  // --- showing -------------------------------------------------------------------------------------------------
  const place = (spot) => `translate(${(spot[0] * 100).toFixed(1)} ${(-spot[1] * 100).toFixed(1)})`;
  function showRoom() {
    const where = new Map();
    for (const [name, element] of objects) {
      const spot = between(states.objects[name], now);
      element.classList.toggle("gone", !spot);
      if (spot) { where.set(name, spot); element.setAttribute("transform", place(spot)); }
    }
    const bodies = Array.from(agents.keys(), (name) => between(states.agents[name], now)).filter(Boolean);
    spread(where, bodies.flatMap((spot) => [-34, -14, 0, 14].map((y) => [spot[0] * 100, -spot[1] * 100 + y])));
    for (const [name, element] of agents) {
      const column = states.agents[name], spot = between(column, now);
      element.classList.toggle("gone", !spot);
      if (spot) {
        where.set(name, spot);
        element.setAttribute("transform", place(spot));
        element.querySelector(".turned").setAttribute("transform", `rotate(${(-spot[2] * 180 / Math.PI).toFixed(1)})`);
      }
      const upTo = index(states.t, now, (s) => s), points = column.slice(0, upTo + 1).filter(Boolean);
      if (spot) points.push(spot);
      trails.get(name).setAttribute("points", points.map((p) => `${(p[0] * 100).toFixed(1)},${(-p[1] * 100).toFixed(1)}`).join(" "));
    }
    for (const [name, line] of gazes) {
      const seen = latest(focus.filter((e) => (e.agent || name) === name), now), from = where.get(name), to = seen && where.get(seen.target);
      line.style.display = from && to ? "" : "none";
      if (from && to) [["x1", from[0]], ["y1", -from[1]], ["x2", to[0]], ["y2", -to[1]]].forEach(([k, v]) => line.setAttribute(k, (v * 100).toFixed(1)));
    }
  }
  function spread(where, taken) { // a thing's name stands below it, or above, or further away, where nothing else stands
    const isFree = (x, y) => !taken.some((other) => Math.abs(other[0] - x) < 46 && Math.abs(other[1] - y) < 15);
    for (const [name, element] of objects) {
      const spot = where.get(name);
      if (!spot) continue;
      const radius = Number(element.querySelector("circle").getAttribute("r")), x = spot[0] * 100, y = -spot[1] * 100;
      const offsets = [0, 16, 32, 48].flatMap((far) => [radius + 15 + far, -radius - 6 - far]);
      const offset = offsets.find((each) => isFree(x, y + each)) ?? offsets[0];
      taken.push([x, y + offset]);
      element.querySelector("text").setAttribute("y", offset.toFixed(1));
    }
  }
  const doing = { still: "stands still", walk: "walks", transport: "carries", pick: "reaches", place: "puts or uses" };
  function showBelief() {
    const lines = [];
    for (const partner of data.partners) {
      const moved = latest(movement.filter((e) => e.agent === partner), now), seen = latest(focus.filter((e) => e.agent === partner), now);
      const column = own(states.agents, partner), holding = column && (between(column, now) || [])[3];
      const what = own(doing, moved ? moved.movement : "") || (moved ? moved.movement : "is not made out yet");
      const whose = data.partners.length > 1 ? `${said(partner)} ` : "";
      lines.push(whose + what + (holding ? `, holds ${said(holding)}` : "") + (seen && seen.target ? `, attends to ${said(seen.target)}` : ""));
    }
    byId("does").textContent = lines.join("; ");
    for (const table of tables) {
      const state = latest(believed.filter((e) => (e.agent ?? table.dataset.whose) === table.dataset.whose), now);
      const shares = state && state.type === "reading" ? state.posterior : {};
      for (const row of all("[data-goal]", table)) {
        const share = own(shares, row.dataset.goal) || 0;
        row.querySelector("i").style.width = `${100 * share}%`;
        row.lastElementChild.textContent = share.toFixed(2);
      }
    }
    byId("helps").textContent = helping();
  }
  function helping() { // what was asked for part by part, and what is waited for; a part is one partner's
    let asked = [];
    const waits = new Map();
    const waiting = (e) => `waits until ${said(e.waiting[0])}${e.waiting.length > 1 ? ` and ${e.waiting.length - 1} more` : ""}`;
    for (const e of told) {
      if (e.t > now + 1e-9) break;
      const whose = e.partner ?? e.agent, others = asked.filter((each) => each.whose !== whose);
      if (e.type === "plan") waits.set(whose, !e.actions.length ? "can do nothing of what is left" : e.waiting.length ? waiting(e) : "");
      else if (e.type === "robot" && e.status === "asked") asked.push({ action: e.action, whose });
      else if (e.type === "robot" && e.status === "failed") asked = others;
      else if (e.type === "robot") { const at = asked.findIndex((each) => each.action === e.action); if (at >= 0) asked.splice(at, 1); }
      else { waits.delete(whose); if (e.type === "withdrawn") asked = others; }
    }
    if (asked.length) return `is on its way: ${said(asked[0].action)}`;
    return Array.from(waits.values()).filter(Boolean).join("; ") || "watches";
  }
  function showList() {
    let current = null;
    for (const each of moments) {
      const past = Number(each.dataset.t) <= now + 1e-9;
      each.classList.toggle("past", past);
      each.classList.remove("current");
      if (past) current = each;
    }
    for (const each of moments) if (current && each.dataset.t === current.dataset.t) each.classList.add("current");
    const list = current && current.parentElement;
    if (list) list.scrollTop = current.offsetTop - list.offsetTop - list.clientHeight / 2 + current.clientHeight / 2;
    for (const each of articles) each.classList.toggle("current", Boolean(current) && Math.abs(Number(each.dataset.t) - now) < 0.05);
  }
  function show(t) {
    now = Math.min(last, Math.max(first, t));
    slider.value = String(now);
    slider.setAttribute("aria-valuetext", `${now.toFixed(1)} seconds`);
    clock.textContent = `${now.toFixed(1)} s`;
    lanes.style.setProperty("--at", String(100 * (now - first) / ((last - first) || 1)));
    showRoom(); showBelief(); showList();
  }

  // --- playing -------------------------------------------------------------------------------------------------
  function step(stamp) {
    if (timer === null) return;
    show(now + (before ? (stamp - before) / 1000 : 0) * Number(speed.value));
    before = stamp;
    if (now >= last) pause(); else timer = requestAnimationFrame(step);
  }
  function start() { if (now >= last) show(first); before = 0; timer = requestAnimationFrame(step); label(); }
  function pause() { if (timer !== null) cancelAnimationFrame(timer); timer = null; label(); }
  function label() { const on = timer !== null; byId("sign").setAttribute("d", on ? "M4 3h4v14H4zM12 3h4v14h-4z" : "M5 2l13 8-13 8z"); play.setAttribute("aria-label", on ? "pause" : "play"); }
  const toggle = () => (timer === null ? start() : pause());
  const go = (t) => { pause(); show(t); };
  const next = () => go(times.find((t) => t > now + 0.05) ?? last);
  const previous = () => go(times.filter((t) => t < now - 0.05).pop() ?? first);

  slider.addEventListener("input", () => go(Number(slider.value)));
  play.addEventListener("click", toggle);
  byId("next").addEventListener("click", next);
  byId("previous").addEventListener("click", previous);
  document.addEventListener("click", (event) => {
    const lane = event.target.closest(".lane"), timed = event.target.closest("[data-t]");
    if (lane) { const box = lane.getBoundingClientRect(); go(first + (last - first) * (event.clientX - box.left) / box.width); }
    else if (timed && (timed.tagName !== "ARTICLE")) go(Number(timed.dataset.t));
  });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select")) return;
    if (event.key === " " && event.target.closest("summary,button:not(#play)")) return;
    const far = event.shiftKey ? 10 : 1;
    const keys = { " ": toggle, k: toggle, ArrowLeft: () => go(now - far), ArrowRight: () => go(now + far), n: next, p: previous, Home: () => go(first), End: () => go(last) };
    const act = own(keys, event.key.length === 1 ? event.key.toLowerCase() : event.key);
    if (act) { event.preventDefault(); act(); }
  });
  const asked = /^#t=([\d.]+)$/.exec(location.hash);
  show(asked ? Number(asked[1]) : times.length ? ofType("prediction").map((e) => e.t)[0] ?? first : first);
  document.documentElement.dataset.ready = "yes";
})();
