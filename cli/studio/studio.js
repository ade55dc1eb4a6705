"use strict";
// The drawing of the studio: the film takes new states, and its joints can be dragged; numbers are put in their places.
const studio = { player: null, held: null, waiting: false, dropping: false, next: null, ghost: null };
studio.animation = (id, data, ghost) => {  // without a ghost the one that is there stays, null takes it away
  const root = document.getElementById(id);
  if (!root) return;
  studio.toggles(data);
  if (!data) { root.hidden = true; return; }
  root.hidden = false;
  if (ghost !== undefined) studio.ghost = ghost;
  if (!studio.player) { studio.player = filmPlayer(root, data); studio.listen(studio.player); }
  studio.player.take(data, studio.ghost);
};
studio.toggles = data => {
  // What can be shown on the mechanism: a box for each word, the points for a path.
  const row = document.getElementById("shown"), words = data ? data.words : [], points = data ? data.points : [];
  row.hidden = !words.length;
  const made = JSON.stringify([words, points]);
  if (row.dataset.made !== made) {
    row.dataset.made = made;
    row.replaceChildren(...words.map(word => {
      const label = document.createElement("label");
      const set = document.createElement(word === "path" ? "select" : "input");
      if (word === "path") set.append(new Option("none", ""), ...points.map(name => new Option(name)));
      else set.type = "checkbox";
      set.dataset.show = word;
      set.onchange = studio.show;
      label.append(...word === "path" ? ["path of ", set] : [set, word === "centres" ? " instant centres" : ` ${word}`]);
      return label;
    }));
  }
  const now = data ? data.show.split(",") : [];
  for (const set of row.querySelectorAll("[data-show]")) {
    if (set.dataset.show === "path") set.value = now.find(each => each.startsWith("path:"))?.slice(5) ?? "";
    else set.checked = now.includes(set.dataset.show);
  }
};
studio.show = () => {
  const found = [];
  for (const set of document.querySelectorAll("[data-show]")) {
    if (set.checked) found.push(set.dataset.show);
    if (set.tagName === "SELECT" && set.value) found.push(`path:${set.value}`);
  }
  emitEvent("show", { show: found.join(",") });
};
studio.joint = (player, event) => {
  // The joint next to the pointer, as list, index, joint; null where none is near.
  const [x, y] = player.toPicture(event), i = player.shown;
  let best = null, least = 18 * player.data.width / player.stage.clientWidth;
  const look = (p, which) => {
    if (!p) return;
    const away = Math.hypot(p[2 * i] - x, p[2 * i + 1] - y);
    if (away < least) { least = away; best = which; }
  };
  const [first, after, marks] = player.data.own;
  player.data.parts.slice(first, after).forEach((part, k) => {
    if (part.is === "chain") part.p.forEach((joint, j) => look(joint, ["parts", k, j]));
    if (part.is === "body") look(part.p, ["parts", k, 0]);
  });
  player.data.marks.slice(0, marks).forEach((mark, k) => look(mark.p, ["marks", k, 0]));
  return best;
};
studio.listen = player => {
  const { stage } = player;
  stage.style.touchAction = "none";
  stage.addEventListener("pointerdown", event => {
    const which = studio.joint(player, event);
    if (!which) return;
    player.pause();
    studio.held = which; studio.waiting = true; studio.dropping = false; studio.next = null;
    stage.setPointerCapture(event.pointerId);
    emitEvent("grip", { which, fraction: player.shown / player.data.count });
  });
  stage.addEventListener("pointermove", event => {
    if (!studio.held) { stage.style.cursor = studio.joint(player, event) ? "grab" : ""; return; }
    stage.style.cursor = "grabbing";
    studio.next = player.toPicture(event);
    studio.send();
  });
  const drop = () => { if (studio.held) { studio.held = null; studio.dropping = true; studio.send(); } };
  stage.addEventListener("pointerup", drop);
  stage.addEventListener("pointercancel", drop);
};
// One place at a time: the next goes when the last has been answered; the joint is let go at the last.
studio.send = () => {
  if (studio.waiting) return;
  if (!studio.next) {
    if (studio.dropping) emitEvent("drop", {});
    studio.dropping = false;
    return;
  }
  studio.waiting = true;
  emitEvent("drag", { place: studio.next });
  studio.next = null;
};
studio.answered = () => { studio.waiting = false; studio.send(); };
studio.sheet = (id, html) => {
  const root = document.getElementById(id);
  if (root) { root.innerHTML = html; if (html) startPage(root); }
};
studio.at = (name, value) => document.querySelector(`[data-${name}="${CSS.escape(value)}"]`);
studio.soon = (work, tries = 50) => { if (!work() && tries) setTimeout(() => studio.soon(work, tries - 1), 20); };
studio.numbers = rows => {
  // Name, least, greatest, value; a field in which the hand is keeps what it has, unless that is another number.
  for (const [name, low, high, value] of rows) studio.soon(() => {
    const field = studio.at("path", name), slider = studio.at("slider", name);
    if (!field) return false;
    if (Number(field.value) !== Number(value) || field.value === "") field.value = value;
    slider.min = low; slider.max = high;
    if (Number(slider.value) !== Number(value) && !slider.matches(":active")) slider.value = value;
    return true;
  });
};
studio.results = found => {
  for (const name in found) studio.soon(() => {
    const now = studio.at("quantity", name), was = studio.at("was", name), title = studio.at("title", name);
    if (!now) return false;
    if (now.textContent !== found[name][0]) now.textContent = found[name][0];
    if (was.textContent !== found[name][1]) was.textContent = found[name][1];
    if (title.textContent !== found[name][2])  // long names may break behind each of their words
      title.replaceChildren(...found[name][2].split(/(?<=_)/).flatMap((word, k) => k ? [document.createElement("wbr"), word] : [word]));
    return true;
  });
};
