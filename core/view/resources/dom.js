// Elements of the page, and numbers for people.

const find = (id) => document.getElementById(id);

/// Returns a new element; children that are texts are shown as text.
const node = (tag, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};

/// Returns a new element of the overlay.
const drawn = (tag, attributes) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) {
    made.setAttribute(name, value);
  }
  return made;
};

/// Returns a length in m as millimetres.
const millimetres = (length) => `${(1000 * length).toFixed(Math.abs(length) < 0.01 ? 2 : 1)} mm`;
const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;

/// Returns labelled radio buttons or checkboxes. `choices`: [value, text]; `chosen(value, checked)` is called on a change.
const choices = (type, name, list, checked, chosen) => list.map(([value, text]) => {
  const input = node("input", { type, name, value, checked: checked(value) });
  input.addEventListener("change", () => chosen(value, input.checked));
  return node("label", {}, input, text);
});

const button = (text, title, pressed) => {
  const made = node("button", { type: "button", title }, text);
  made.addEventListener("click", pressed);
  return made;
};
