// Elements. All text that comes from logs, scenes and robots gets into the page here, as text.

export const byId = (id) => document.getElementById(id);

/** `properties` are set as they are; strings among `children` become text. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key in element) element[key] = value; else element.setAttribute(key, value);
  }
  element.append(...children.map((child) => child instanceof Node ? child : String(child)));
  return element;
}

/** Control characters, also those that turn the direction of writing, as boxes. */
export const plain = (text) => String(text).replace(/[\p{Cc}\p{Cf}]/gu, "\u25a1");

export const headed = (...heads) => make("thead", {}, make("tr", {}, ...heads.map(([text, kind = ""]) =>
  make("th", { className: kind, scope: "col" }, text))));

export function download(name, parts, type) {
  const url = URL.createObjectURL(new Blob(parts, { type }));
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
