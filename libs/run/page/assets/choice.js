const element = (id) => document.getElementById(id);

/** Remembered by the browser, so that a reload changes nothing; ?id=value in the address comes first, for a bookmark. */
export function connectChoice(id, otherwise, choose) {
  const buttons = [...element(id).querySelectorAll("button")];
  const pick = (value) => {
    for (const button of buttons) button.setAttribute("aria-pressed", String(button.dataset.value === value));
    choose(value);
  };
  for (const button of buttons)
    button.onclick = () => { localStorage.setItem(id, button.dataset.value); pick(button.dataset.value); };
  const wanted = new URLSearchParams(location.search).get(id) || localStorage.getItem(id);
  pick(buttons.some((button) => button.dataset.value === wanted) ? wanted : otherwise);
}

export function connectTheme(choose) {
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  connectChoice("theme", dark ? "dark" : "light", (theme) => {
    document.documentElement.dataset.theme = theme;
    choose(theme);
  });
}
