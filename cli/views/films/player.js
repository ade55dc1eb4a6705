"use strict";
// Cursors of a page: whoever moves one says over which axis and where, and all others with that axis follow.
const cursors = { heard: [], say(over, value, from) { for (const hear of this.heard) hear(over, value, from); } };

function shortNumber(value) {
  const text = Math.abs(value) < 1e-12 ? "0" : String(Number(value.toPrecision(5)));
  return text.replace(/-/g, "\u2212");
}

function valueAt(curve, x) {
  const xs = curve.x;
  let low = 0, high = xs.length - 1;
  if (high < 1 || x < xs[0] || x > xs[high]) return null;
  while (high - low > 1) { const middle = (low + high) >> 1; if (xs[middle] <= x) low = middle; else high = middle; }
  const a = curve.y[low], b = curve.y[high];
  if (a === null || b === null) return null;
  return xs[high] === xs[low] ? b : a + (b - a) * (x - xs[low]) / (xs[high] - xs[low]);
}

function filmPlayer(root, DATA) {
  root.innerHTML = `
<div class="now" aria-live="off"></div>
<canvas class="stage" role="img"></canvas>
<canvas class="strip" role="img"></canvas>
<div class="controls">
<button id="play" type="button">Pause</button>
<button id="back" type="button" aria-label="one picture back">&#8249;</button>
<button id="on" type="button" aria-label="one picture on">&#8250;</button>
<input id="place" type="range" min="0" step="1" value="0" aria-label="picture">
<output id="number"></output>
<label>speed <select id="speed">
<option value="0.1">1/10</option><option value="0.25">1/4</option><option value="0.5">1/2</option>
<option value="1" selected>1</option><option value="2">2</option>
</select></label>
</div>`;
  const stage = root.querySelector(".stage"), strip = root.querySelector(".strip"), values = root.querySelector(".now");
  const play = root.querySelector("#play"), place = root.querySelector("#place");
  const speed = root.querySelector("#speed"), number = root.querySelector("#number");
  let chart = DATA.chart, ghost = null;
  stage.setAttribute("aria-label", DATA.title + ", animation");
  let readouts = [];
  let playing = true, now = 0, before = null, shown = -1, pen = stage.getContext("2d"), letters = DATA.text;
  function prepare() {
    stage.style.aspectRatio = DATA.width + " / " + DATA.height;
    strip.setAttribute("aria-label", chart ? chart.ylabel + " over " + chart.xlabel : "");
    strip.hidden = !chart;
    values.replaceChildren();
    readouts = DATA.readouts.map(() => values.appendChild(document.createElement("span")));
    place.max = DATA.count - 1;
  }
  prepare();

  function path(p, closed) {
    pen.beginPath();
    for (let k = 0; k < p.length; k += 2) k ? pen.lineTo(p[k], p[k + 1]) : pen.moveTo(p[k], p[k + 1]);
    if (closed) pen.closePath();
  }
  function paint(part) {
    if (part.fill) { pen.fillStyle = part.fill; pen.fill(); }
    pen.strokeStyle = part.color; pen.lineWidth = part.width; pen.stroke();
  }
  function disc(x, y, radius, fill, edge, width) {
    pen.beginPath(); pen.arc(x, y, radius, 0, 2 * Math.PI);
    pen.fillStyle = fill; pen.fill();
    if (edge) { pen.strokeStyle = edge; pen.lineWidth = width; pen.stroke(); }
  }
  function words(text, x, y, size, color, align, baseline, halo) {
    pen.font = size + "px sans-serif"; pen.textAlign = align; pen.textBaseline = baseline;
    if (halo) { pen.strokeStyle = halo; pen.lineWidth = 4; pen.strokeText(text, x, y); }
    pen.fillStyle = color; pen.fillText(text, x, y);
  }
  function letter(text, x, y, color, halo) {  // within the picture, at its edge as well
    pen.font = letters + "px sans-serif";
    const half = pen.measureText(text).width / 2 + 2, tall = 0.65 * letters;
    words(text, Math.max(half, Math.min(DATA.width - half, x)), Math.max(tall, Math.min(DATA.height - tall, y)),
      letters, color, "center", "middle", halo);
  }
  const draw = {
    line(part) {
      pen.setLineDash(part.dashed ? [7, 7] : []);
      path(part.p, false); paint(part); pen.setLineDash([]);
    },
    body(part, i) {
      if (part.p[2 * i] === null) return;
      pen.save();
      pen.translate(part.p[2 * i], part.p[2 * i + 1]); pen.rotate(part.t[i]);
      path(part.o, false); paint(part);
      pen.restore();
    },
    chain(part, i) {
      const p = part.p.flatMap(joint => [joint[2 * i], joint[2 * i + 1]]);
      if (p.includes(null)) return;
      path(p, false); pen.lineCap = "round"; paint(part); pen.lineCap = "butt";
      if (part.marked)
        for (let k = 0; k < p.length; k += 2) disc(p[k], p[k + 1], 1.7 + part.width / 2, "#ffffff", part.color, 1.4);
    },
  };
  draw.arrow = function (part, i) {
    const [x, y, u, v] = [part.p[2 * i], part.p[2 * i + 1], part.q[2 * i], part.q[2 * i + 1]];
    if (x !== null && u !== null) arrow(x, y, u - x, v - y, part.color);
  };
  function arrow(x, y, u, v, color) {
    const long = Math.hypot(u, v), head = Math.min(10, 0.6 * long);
    if (long < 0.05) return;
    const a = u / long * head, b = v / long * head, left = x + u - a, low = y + v - b;
    path([x, y, left + 0.2 * a, low + 0.2 * b]); pen.strokeStyle = color; pen.lineWidth = 1.8; pen.stroke();
    path([x + u, y + v, left + 0.36 * b, low - 0.36 * a, left - 0.36 * b, low + 0.36 * a], true);
    pen.fillStyle = color; pen.fill();
  }
  function keysAndFaults(i) {
    const keys = DATA.keys || [];
    keys.forEach((key, k) => {  // rows as far apart as the letters on the screen are high
      const y = key.p[1] - 1.15 * (letters - DATA.text) * (keys.length - k - 0.5);
      if (key.long) arrow(key.p[0], y, key.long, 0, key.color);
      words(key.words, key.p[0] + key.long + 0.5 * DATA.text, y, letters, key.color, "left", "middle", "#ffffff");
    });
    const wrong = DATA.faults && DATA.faults[i] || [];
    if (!wrong.length) return;
    if (DATA.framed[i]) {
      pen.strokeStyle = "#d00000"; pen.lineWidth = 5; pen.strokeRect(2.5, 2.5, DATA.width - 5, DATA.height - 5);
    }
    wrong.forEach((line, k) =>
      words(line, 10, 10 + 1.25 * letters * k, letters, "#d00000", "left", "top", "#ffffff"));
  }
  function ground(m, i) {
    const x = m.p[2 * i], y = m.p[2 * i + 1], size = 0.5 * DATA.text;
    path([x, y, x - size, y + 1.7 * size, x + size, y + 1.7 * size], true);
    pen.fillStyle = "#ffffff"; pen.fill();
    pen.strokeStyle = "#222222"; pen.lineWidth = 1.3; pen.stroke();
    path([x - 1.7 * size, y + 1.7 * size, x + 1.7 * size, y + 1.7 * size]); pen.stroke();
    for (let k = -1; k <= 2; k++) {
      path([x + k * 0.8 * size, y + 1.7 * size, x + (k * 0.8 - 0.6) * size, y + 2.4 * size]); pen.stroke();
    }
    disc(x, y, 0.4 * size, "#ffffff", "#222222", 1.2);
  }
  function showStage(i) {
    const finer = Math.min(stage.width / DATA.width, stage.height / DATA.height);
    pen = stage.getContext("2d");
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = "#ffffff"; pen.fillRect(0, 0, stage.width, stage.height);
    pen.setTransform(finer, 0, 0, finer,
      (stage.width - finer * DATA.width) / 2, (stage.height - finer * DATA.height) / 2);
    pen.lineJoin = "round";
    // Letters of at least 11 pixels on the screen, however small the picture.
    letters = Math.max(DATA.text, 11 * (window.devicePixelRatio || 1) / finer);
    if (ghost) {
      pen.globalAlpha = .22;
      for (const part of ghost.parts) draw[part.is](part, Math.floor(i / DATA.count * ghost.count));
      pen.globalAlpha = 1;
    }
    for (const part of DATA.parts) if (part.is === "line") draw.line(part);
    for (const part of DATA.parts) if (part.is !== "line") draw[part.is](part, i);
    for (const m of DATA.marks) if (m.pivot) ground(m, i);
    const away = letters / DATA.text;
    for (const part of DATA.parts)
      if (part.label)
        letter(part.label, part.p[2 * i] + part.shift[0], part.p[2 * i + 1] + part.shift[1], part.color,
          part.fill || "#ffffff");
    for (const m of DATA.marks)
      if (m.text && m.p[2 * i] !== null)
        letter(m.text, m.p[2 * i] + away * m.shift[0], m.p[2 * i + 1] + away * m.shift[1], "#222222", "#ffffff");
    keysAndFaults(i);
  }

  // The strip: curves over the loop with their bands, drawn in pixels of the screen.
  const sides = {};
  function across(x) { return sides.left + (x - chart.x[0]) / (chart.x[1] - chart.x[0]) * (sides.right - sides.left); }
  function upwards(y) { return sides.bottom - (y - chart.y[0]) / (chart.y[1] - chart.y[0]) * (sides.bottom - sides.top); }
  function grid(p, color) { path(p); pen.strokeStyle = color; pen.lineWidth = 1; pen.stroke(); }
  const dashes = [[], [7, 3], [2, 2.5], [9, 3, 2, 3]];  // curves differ in more than their colour
  function keyPlaces() {  // of the names of the curves, from the right, in as many rows as they need
    pen.font = "12px sans-serif";
    let x = sides.right, row = 0, first = sides.left + pen.measureText(chart.ylabel).width + 12;
    const last = chart.curves.length - 1, found = [];
    chart.curves.slice().reverse().forEach((curve, k) => {
      const long = pen.measureText(curve.label).width + 22;
      if (x - long < (row ? sides.left : first) && x < sides.right) { row++; x = sides.right; }
      found[last - k] = { x, row, long };
      x -= long + 10;
    });
    return found;
  }
  function showStrip(i) {
    if (!chart) return;
    const finer = window.devicePixelRatio || 1, wide = strip.width / finer, high = strip.height / finer;
    Object.assign(sides, { left: 52, right: wide - 14, bottom: high - 32 });
    pen = strip.getContext("2d");
    pen.setTransform(finer, 0, 0, finer, 0, 0);
    const keys = chart.curves.length > 1 ? keyPlaces() : [];
    sides.top = 20 + 14 * Math.max(0, ...keys.map(key => key.row));
    pen.fillStyle = "#ffffff"; pen.fillRect(0, 0, wide, high);
    for (const band of chart.bands) {
      const from = across(band.start), to = across(band.end);
      pen.fillStyle = band.color; pen.fillRect(from, sides.top, to - from, sides.bottom - sides.top);
    }
    for (const x of chart.xticks) {
      grid([across(x), sides.top, across(x), sides.bottom], "#dddddd");
      words(String(x).replace("-", "\u2212"), across(x), sides.bottom + 3, 11, "#666666", "center", "top");
    }
    for (const y of chart.yticks) {
      grid([sides.left, upwards(y), sides.right, upwards(y)], "#dddddd");
      words(String(y).replace("-", "\u2212"), sides.left - 5, upwards(y), 11, "#666666", "right", "middle");
    }
    grid([sides.left, sides.top, sides.left, sides.bottom, sides.right, sides.bottom], "#777777");
    pen.save();
    pen.beginPath(); pen.rect(sides.left, sides.top - 2, sides.right - sides.left, sides.bottom - sides.top + 4); pen.clip();
    for (const of of [ghost && ghost.chart, chart]) {
      pen.globalAlpha = of === chart ? 1 : .3;
      (of ? of.curves : []).forEach((curve, n) => {
        path(curve.x.flatMap((x, k) => [across(x), upwards(curve.y[k])]));
        pen.setLineDash(dashes[n % dashes.length]);
        pen.strokeStyle = curve.color; pen.lineWidth = 2; pen.stroke();
      });
    }
    pen.setLineDash([]);
    pen.restore();
    pen.font = "11px sans-serif";
    chart.bands.forEach((band, k) => {  // over the curves, which a band's name would be crossed by
      if (!band.name || pen.measureText(band.name).width > across(band.end) - across(band.start)) return;
      const row = chart.bands.slice(0, k).filter(o => o.name && o.start < band.end && band.start < o.end).length;
      const middle = (across(band.start) + across(band.end)) / 2;
      words(band.name, middle, sides.top + 3 + 13 * row, 11, "#444444", "center", "top", "#ffffff");
    });
    grid([across(chart.now[i]), sides.top, across(chart.now[i]), sides.bottom], "#444444");
    for (const curve of chart.curves)
      disc(across(chart.now[i]), upwards(curve.now[i]), 4.5, curve.color, "#ffffff", 1);
    words(chart.xlabel, (sides.left + sides.right) / 2, sides.bottom + 17, 12, "#222222", "center", "top");
    words(chart.ylabel, sides.left, 14, 12, "#222222", "left", "alphabetic");
    keys.forEach(({ x, row, long }, k) => {
      const y = 14 + 14 * row, curve = chart.curves[k];
      words(curve.label, x, y, 12, curve.color, "right", "alphabetic");
      path([x - long, y - 4, x - long + 18, y - 4]); pen.setLineDash(dashes[k % dashes.length]);
      pen.strokeStyle = curve.color; pen.lineWidth = 2; pen.stroke(); pen.setLineDash([]);
    });
  }
  function show(i) {
    showStage(i); showStrip(i);
    readouts.forEach((span, k) => { span.textContent = DATA.readouts[k][i].replace(/-(?=\d)/g, "\u2212"); });
    place.value = i; number.value = (i + 1) + " / " + DATA.count; shown = i;
    if (chart) cursors.say(chart.xlabel, chart.now[i], root);
  }
  function fit() {
    const finer = window.devicePixelRatio || 1;
    for (const canvas of [stage, strip]) {
      canvas.width = Math.max(1, Math.round(canvas.clientWidth * finer));
      canvas.height = Math.max(1, Math.round(canvas.clientHeight * finer));
    }
    show(Math.max(shown, 0));
  }
  function go(i) { now = (i % DATA.count + DATA.count) % DATA.count; show(Math.floor(now)); }
  function pause() { playing = false; play.textContent = "Play"; }
  function toggle() { playing = !playing; play.textContent = playing ? "Pause" : "Play"; }
  function nearest(x) {
    let best = 0;
    for (let i = 1; i < DATA.count; i++)
      if (Math.abs(chart.now[i] - x) < Math.abs(chart.now[best] - x)) best = i;
    return best;
  }
  function tick(time) {
    if (!root.isConnected) return;
    if (playing && before !== null && !document.hidden) {
      now = (now + (time - before) / 1000 * DATA.fps * Number(speed.value)) % DATA.count;
      if (Math.floor(now) !== shown) show(Math.floor(now));
    }
    before = time;
    requestAnimationFrame(tick);
  }
  const steps = { ArrowLeft: () => now - 1, ArrowRight: () => now + 1, Home: () => 0, End: () => DATA.count - 1 };
  function key(event) {
    if (!root.isConnected) { window.removeEventListener("keydown", key); return; }
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select, textarea")) return;
    if (!root.contains(event.target) && event.target.closest("input, button, summary, [contenteditable]")) return;
    if (event.key === " " && !event.target.closest("button")) toggle();
    else if (event.key in steps) { pause(); go(Math.floor(steps[event.key]())); }
    else return;
    event.preventDefault();
  }
  function atPointer(event) {
    const x = event.clientX - strip.getBoundingClientRect().left;
    const way = Math.min(1, Math.max(0, (x - sides.left) / (sides.right - sides.left)));
    pause(); go(nearest(chart.x[0] + way * (chart.x[1] - chart.x[0])));
  }
  play.onclick = toggle;
  root.querySelector("#back").onclick = () => { pause(); go(Math.floor(now) - 1); };
  root.querySelector("#on").onclick = () => { pause(); go(Math.floor(now) + 1); };
  place.oninput = () => { pause(); go(Number(place.value)); };
  strip.onpointerdown = atPointer;
  strip.onpointermove = event => { if (event.buttons || event.pointerType === "mouse") atPointer(event); };
  window.addEventListener("keydown", key);
  new ResizeObserver(fit).observe(root);
  if (chart)
    cursors.heard.push((over, value, from) => {
      if (from !== root && over === chart.xlabel && root.isConnected) { pause(); go(nearest(value)); }
    });
  if (window.matchMedia("(prefers-reduced-motion: reduce)").matches) toggle();
  fit();
  requestAnimationFrame(tick);
  function take(next, before) {
    // Another state of the design, at the same place of its loop; `before` stands pale behind it.
    const part = now / DATA.count;
    DATA = next; chart = DATA.chart; ghost = before; now = Math.min(part * DATA.count, DATA.count - 1);
    prepare(); shown = Math.floor(now); fit();
  }
  function toPicture(event) {
    // From the pointer to the picture's own pixels.
    const box = stage.getBoundingClientRect(), scale = Math.min(box.width / DATA.width, box.height / DATA.height);
    return [(event.clientX - box.left - (box.width - scale * DATA.width) / 2) / scale,
      (event.clientY - box.top - (box.height - scale * DATA.height) / 2) / scale];
  }
  return { take, toPicture, pause, stage, get data() { return DATA; }, get shown() { return shown; } };
}
