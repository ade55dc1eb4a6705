// Cursors on the sheets: a line over every panel of the same axis, with the values of its curves.
function drawn(name, looks) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const look in looks) made.setAttribute(look, looks[look]);
  return made;
}
function withUnit(value, unit) { return shortNumber(value) + (unit && unit !== "\u00b0" ? " " : "") + unit; }
function words(over, value) {
  const [name, unit] = over.replace("]", "").split(" [");
  return name + " " + withUnit(value, (unit || "").replace("deg", "\u00b0"));
}
function inTime(chart, x) {
  if (!chart.ms) return "";
  return ", " + shortNumber(chart.ms[0] + (x - chart.x[0]) / (chart.x[1] - chart.x[0]) * (chart.ms[1] - chart.ms[0])) + " ms";
}
function linkSheet(sheet) {
  const svg = sheet.querySelector("svg"), charts = JSON.parse(sheet.querySelector("script.charts").textContent);
  const layer = svg.appendChild(drawn("g", { class: "cursor", "pointer-events": "none" }));
  function place(chart, x) { return chart.box[0] + (x - chart.x[0]) / (chart.x[1] - chart.x[0]) * (chart.box[2] - chart.box[0]); }
  function level(chart, y) {
    const [low, high] = chart.log ? chart.y.map(Math.log) : chart.y, at = chart.log ? Math.log(y) : y;
    return chart.box[3] - (at - low) / (high - low) * (chart.box[3] - chart.box[1]);
  }
  let labels = null; // the boxes of the words of the sheet, measured when it is shown for the first time
  function freePlace(chart, at, wide, high) {
    // The highest place beside the line that is within the panel and clear of the words of the sheet; else the clearest.
    const box = svg.getBoundingClientRect(), scale = svg.getAttribute("viewBox").split(" ").map(Number)[2] / box.width;
    labels ??= [...svg.querySelectorAll('g[id^="text_"]')].map(text => {  // with outlined letters there is no element text
      const of = text.getBoundingClientRect();
      return [of.left - box.left, of.top - box.top, of.right - box.left, of.bottom - box.top].map(side => side * scale);
    });
    // Of its curves as well: a point every few units.
    chart.points ??= chart.curves.flatMap(curve => curve.x.map((x, k) => [place(chart, x), level(chart, curve.y[k])]))
      .filter(point => isFinite(point[1]));
    const sides = [at + 4, at - 4 - wide], places = [];
    if (at > (chart.box[0] + chart.box[2]) / 2) sides.reverse();
    sides.push(Math.max(chart.box[0] + 2, Math.min(at + 4, chart.box[2] - wide - 2)));  // across the line where words are long
    for (const left of sides) {
      const crossed = chart.points.filter(([x]) => x > left && x < left + wide).map(([, y]) => y);
      const each = wide / Math.max(crossed.length, 1) * high;  // a curve all along the words hides them all
      for (let top = chart.box[1]; top + high <= chart.box[3]; top += 3) {
        const past = Math.max(0, left + wide - chart.box[2]) + Math.max(0, chart.box[0] - left);
        const hidden = labels.reduce((sum, [l, t, r, b]) =>
          sum + Math.max(0, Math.min(r, left + wide) - Math.max(l, left)) * Math.max(0, Math.min(b, top + high) - Math.max(t, top)), 0);
        const met = crossed.filter(y => y > top - 1 && y < top + high + 1).length;
        places.push([left, top, hidden + past * high + met * each * chart.curves.length]);
      }
    }
    places.sort((one, other) => one[2] - other[2]);
    return places[0] ?? [sides[0], chart.box[1]];
  }
  function show(over, value) {
    layer.replaceChildren();
    for (const chart of charts) {
      if (chart.over !== over) continue;
      let x = value;
      if (/\[deg\]/.test(over) && (x < chart.x[0] || x > chart.x[1]))
        x = [x - 360, x + 360].find(other => other >= chart.x[0] && other <= chart.x[1]) ?? x;
      if (x < chart.x[0] || x > chart.x[1]) continue;
      const at = place(chart, x);
      layer.append(drawn("line", { x1: at, x2: at, y1: chart.box[1], y2: chart.box[3], stroke: "#444", "stroke-width": .8 }));
      const lines = [[words(over, value) + inTime(chart, x), "#222"]];
      for (const curve of chart.curves) {
        const y = valueAt(curve, x);
        if (y === null) continue;
        const up = level(chart, y);
        if (up > chart.box[1] - 1 && up < chart.box[3] + 1)
          layer.append(drawn("circle", { cx: at, cy: up, r: 2.4, fill: curve.color, stroke: "#fff", "stroke-width": .6 }));
        lines.push([curve.label + " " + withUnit(y, chart.unit), curve.color]);
      }
      const texts = lines.map(([words, color]) => {
        const text = drawn("text", { fill: color, stroke: "#fff", "stroke-width": 2.5, "paint-order": "stroke", "font-size": 7.5 });
        text.textContent = words; layer.append(text); return text;
      });
      const free = freePlace(chart, at, Math.max(...texts.map(text => text.getComputedTextLength())), 9 * texts.length);
      texts.forEach((text, k) => { text.setAttribute("x", free[0]); text.setAttribute("y", free[1] + 8 + 9 * k); });
    }
  }
  function follow(event) {
    const box = svg.getBoundingClientRect(), [, , wide, high] = svg.getAttribute("viewBox").split(" ").map(Number);
    const x = (event.clientX - box.left) / box.width * wide, y = (event.clientY - box.top) / box.height * high;
    const chart = charts.find(c => x >= c.box[0] && x <= c.box[2] && y >= c.box[1] && y <= c.box[3]);
    if (chart) cursors.say(chart.over, chart.x[0] + (x - chart.box[0]) / (chart.box[2] - chart.box[0]) * (chart.x[1] - chart.x[0]), sheet);
  }
  svg.addEventListener("pointermove", follow);
  svg.addEventListener("pointerdown", follow);
  const hear = (over, value) => { if (sheet.isConnected) show(over, value); };
  cursors.heard.push(hear);
}
function linkRows(sheet) {
  // Marks and lines of one design of a study: whichever is pointed at, the others of that design stay and the rest fades.
  const marks = [...sheet.querySelectorAll('g[id^="row-"]')], design = mark => mark.id.split("-")[1];
  const names = sheet.querySelector("script.names"), named = names ? JSON.parse(names.textContent) : {};
  const light = index => marks.forEach(mark => { mark.style.opacity = index === null || design(mark) === index ? "" : .12; });
  for (const mark of marks) {
    const words = document.createElementNS("http://www.w3.org/2000/svg", "title");
    words.textContent = named[design(mark)] || "design " + design(mark); mark.append(words);
    mark.addEventListener("pointerenter", () => light(design(mark)));
    mark.addEventListener("pointerleave", () => light(null));
  }
}
function startPage(root) {
  for (const film of root.querySelectorAll(".film")) {
    const data = film.querySelector("script.data");
    if (data) filmPlayer(film, JSON.parse(data.textContent));
  }
  for (const sheet of root.querySelectorAll(".sheet")) { linkSheet(sheet); linkRows(sheet); }
}
startPage(document);
