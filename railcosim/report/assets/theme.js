"use strict";

/** The page in light or dark: as the system has it until the reader says otherwise; light on paper. */
const theme = (() => {
  const root = document.documentElement;
  const system = matchMedia("(prefers-color-scheme: dark)");
  const paper = matchMedia("print");
  const listeners = [];
  let chosen = null;

  const isDark = () => !paper.matches && (chosen ?? system.matches);

  const apply = () => {
    root.dataset.theme = isDark() ? "dark" : "light";
    const button = document.getElementById("theme");
    if (button) button.textContent = isDark() ? "Light page" : "Dark page";
    for (const listener of listeners) listener();
  };

  const colour = (name) => getComputedStyle(root).getPropertyValue(`--${name}`).trim();

  for (const media of [system, paper]) media.addEventListener("change", apply);
  document.addEventListener("DOMContentLoaded", () => {
    const button = document.getElementById("theme");
    button.hidden = false;
    button.addEventListener("click", () => {
      chosen = !isDark();
      apply();
    });
    apply();
  });
  apply();
  return { isDark, colour, onChange: (listener) => listeners.push(listener) };
})();
