// The page of a file that is being edited: pieces come as events, each with its place.
const events = new EventSource("events");
function put(id, html) {
  const old = document.getElementById(id), made = old || document.createElement("section");
  made.id = id; made.classList.remove("old"); made.innerHTML = html;
  if (!old) document.body.append(made);
  startPage(made);
}
events.onmessage = message => {
  const said = JSON.parse(message.data);
  document.getElementById("problem").innerHTML = said.problem || "";
  if (said.title) document.title = said.title;
  if (said.order) {
    for (const section of [...document.body.querySelectorAll(":scope > section")])
      if (!said.order.includes(section.id)) section.remove();
    for (const id of said.order) {
      if (!document.getElementById(id)) put(id, "");
      document.body.append(document.getElementById(id));
    }
  }
  for (const id of said.stale || []) document.getElementById(id)?.classList.add("old");
  for (const id in said.pieces || {}) put(id, said.pieces[id]);
  document.body.dataset.version = message.lastEventId;
};
events.onerror = () => { document.getElementById("problem").innerHTML = "<pre>gearlink watch has ended</pre>"; };
events.onopen = () => { document.getElementById("problem").innerHTML = ""; };
