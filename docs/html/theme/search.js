// Finds the sections of all pages that hold every word. The index is a script, because a page that was opened from disk
// may load no other file. It is loaded when somebody first searches.
const root = document.currentScript.dataset.root;
const box = document.getElementById("search");
const results = document.getElementById("results");
const most = 40;

// 0: a word is missing. Words in the section's title count most, then those in the page's.
function rank([, page, title, text], words) {
  const [inPage, inTitle, inText] = [page, title, text].map(part => part.toLowerCase());
  if (!words.every(word => inTitle.includes(word) || inPage.includes(word) || inText.includes(word))) return 0;
  const hits = part => words.filter(word => part.includes(word)).length;
  return 1 + 100 * hits(inTitle) + 10 * hits(inPage) - title.length / 1000;
}

// The text around the first word that it holds.
function excerpt(text, words) {
  const at = Math.min(...words.map(word => text.toLowerCase().indexOf(word)).filter(index => index >= 0));
  const start = Number.isFinite(at) ? Math.max(0, at - 40) : 0;
  return (start ? "…" : "") + text.slice(start, start + 120);
}

function item([location, page, title, text], words) {
  const link = document.createElement("a");
  link.href = root + "/" + location;
  link.textContent = title === page ? page : page + ": " + title;
  const line = document.createElement("li");
  line.append(link, document.createElement("br"), excerpt(text, words));
  return line;
}

function show() {
  const words = box.value.toLowerCase().split(/\s+/).filter(Boolean);
  document.body.classList.toggle("searching", words.length > 0);
  const found = words.length ? SECTIONS.map(section => [rank(section, words), section]).filter(([value]) => value > 0) : [];
  found.sort((a, b) => b[0] - a[0]);
  results.replaceChildren(...found.slice(0, most).map(([, section]) => item(section, words)));
  if (words.length && !found.length) results.textContent = "Nothing found";
}

function search() {
  if (typeof SECTIONS !== "undefined") return show();
  const index = document.createElement("script");
  index.src = root + "/search/search_index.js";
  index.onload = () => { show(); box.addEventListener("input", show); };
  index.onerror = () => { results.textContent = `${index.src} cannot be read: build the pages again`; };
  document.head.append(index);
}

box.addEventListener("input", search, {once: true});
box.value = new URLSearchParams(location.search).get("q") ?? "";
if (box.value) search();
