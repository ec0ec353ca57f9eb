// Every word of the page, in each of its languages; those of the program, of robots and of logs stay as they are.
import { WORDS } from "./wordlist.js";

export const LANGUAGES = { en: "English", de: "Deutsch", es: "Español", fr: "Français", zh: "中文" };
const KEPT = "fencepost-language";

const now = { language: "en" };
const listeners = [];

/** The first of the browser's languages that the page has. */
export function preferred(wanted = navigator.languages ?? []) {
  return wanted.map((tag) => tag.slice(0, 2).toLowerCase()).find((tag) => tag in LANGUAGES) ?? "en";
}

/** The words named `key`; `{name}` in them is `values.name`. */
export function t(key, values = {}) {
  const words = WORDS[key];
  if (!words) throw new Error(`no words for ${key}`);
  return words[now.language].replace(/\{(\w+)\}/g, (_, name) => values[name] ?? "");
}

export const language = () => now.language;
/** `redo()` when another language was chosen. */
export const onLanguage = (redo) => { listeners.push(redo); };

/** Puts the words into what of the page names them: data-t for its text, data-t-label for its label. */
export function fill(root) {
  for (const element of root.querySelectorAll("[data-t]")) element.textContent = t(element.dataset.t);
  for (const element of root.querySelectorAll("[data-t-label]")) element.setAttribute("aria-label", t(element.dataset.tLabel));
}

export function speak(name) {
  now.language = name;
  document.documentElement.lang = name;
  fill(document);
  for (const redo of listeners) redo();
}

/** The switch among them. A choice is kept where the browser lets a page from disk keep anything. */
export function bindLanguage(list) {
  list.replaceChildren(...Object.entries(LANGUAGES).map(([value, name]) => Object.assign(document.createElement("option"), { value, textContent: name, lang: value })));
  let kept = null;
  try { kept = localStorage.getItem(KEPT); } catch { /* not here */ }
  list.value = kept in LANGUAGES ? kept : preferred();
  list.onchange = () => {
    try { localStorage.setItem(KEPT, list.value); } catch { /* not here */ }
    speak(list.value);
  };
  speak(list.value);
}
