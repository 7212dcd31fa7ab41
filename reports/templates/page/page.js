"use strict";
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  document.documentElement.classList.add("live");

  // Language: the radio buttons do the work; this tells the browser what it shows.
  const speak = () => {
    const chosen = document.querySelector(".switch:checked");
    if (!chosen) return;
    document.documentElement.lang = chosen.id.slice("show-".length);
    document.title = chosen.dataset.title;
  };
  all(".switch").forEach((input) => input.addEventListener("change", speak));
  speak();

  const lengths = [["km", 1000], ["m", 1], ["cm", 0.01], ["mm", 0.001]];
  const lettering = (metres) => {
    const [name, length] = lengths.find(([, size]) => metres >= size * 0.999) || ["µm", 1e-6];
    return Math.round(metres / length).toLocaleString("en").replaceAll(",", "\u202f") + " " + name;
  };

  // One picture that moves: the view box is the state.
  const picture = (svg) => {
    const box = svg.viewBox.baseVal;
    const whole = { x: box.x, y: box.y, w: box.width, h: box.height };
    const view = { ...whole };
    const bar = svg.querySelector(".bar");
    const cell = Number(svg.dataset.cell);
    const show = () => {
      svg.setAttribute("viewBox", `${view.x} ${view.y} ${view.w} ${view.h}`);
      const sheet = svg.querySelector(".sheet");
      sheet.setAttribute("x", view.x);
      sheet.setAttribute("y", view.y);
      const unit = view.w / (svg.clientWidth || 1000);
      svg.style.setProperty("--unit", unit);
      svg.classList.toggle("near", view.w < whole.w / 6);
      const wide = cell ? view.w * cell : view.w;
      const decade = 10 ** Math.floor(Math.log10(wide / 5));
      const length = Math.max(...[1, 2, 5].map((step) => step * decade).filter((step) => step <= wide / 5 * 1.0001));
      if (cell) {
        bar.querySelector("path").setAttribute("d", `M0 0v${6 * unit}h${length / cell}v${-6 * unit}`);
        bar.querySelector("text").textContent = lettering(length);
      }
      bar.style.display = cell || view.w === whole.w ? "" : "none";
      bar.setAttribute("transform", `translate(${view.x + 16 * unit} ${view.y + view.h - 16 * unit})`);
    };
    const zoom = (factor, x = view.x + view.w / 2, y = view.y + view.h / 2) => {
      const w = Math.min(Math.max(view.w * factor, whole.w / 1e5), whole.w * 4);
      const k = w / view.w;
      view.x = x - (x - view.x) * k;
      view.y = y - (y - view.y) * k;
      view.w = w;
      view.h *= k;
      show();
    };
    const point = (event) => {
      const box = svg.getBoundingClientRect();
      return [view.x + (event.clientX - box.left) / box.width * view.w, view.y + (event.clientY - box.top) / box.height * view.h];
    };
    const reset = () => { Object.assign(view, whole); show(); };
    const look = (mark) => {
      const [x, y, half] = [mark.dataset.x, mark.dataset.y, mark.dataset.window].map(Number);
      Object.assign(view, { w: 2 * half, h: 2 * half * whole.h / whole.w });
      Object.assign(view, { x: x - view.w / 2, y: y - view.h / 2 });
      show();
    };
    svg.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.metaKey) return;  // the page must still scroll
      event.preventDefault();
      zoom(Math.exp(Math.sign(event.deltaY) * 0.25), ...point(event));
    }, { passive: false });
    let from = null;
    svg.addEventListener("pointerdown", (event) => {
      if (event.button === 0 && event.pointerType !== "touch") from = { x: event.clientX, y: event.clientY, at: { ...view }, moved: false };
    });
    svg.addEventListener("pointermove", (event) => {
      if (!from) return;
      const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
      if (!from.moved && Math.hypot(dx, dy) < 4) return;
      if (!from.moved) svg.setPointerCapture(event.pointerId);
      from.moved = true;
      svg.classList.add("moving");
      view.x = from.at.x - dx * view.w / svg.clientWidth;
      view.y = from.at.y - dy * view.h / svg.clientHeight;
      show();
    });
    let dragged = false;
    const end = () => { dragged = Boolean(from && from.moved); from = null; svg.classList.remove("moving"); };
    svg.addEventListener("pointerup", end);
    svg.addEventListener("pointercancel", end);
    // A drag that ends on a mark is not a choice of that mark.
    svg.addEventListener("click", (event) => { if (dragged) event.preventDefault(); dragged = false; }, true);
    svg.addEventListener("dragstart", (event) => event.preventDefault());
    const tools = svg.parentElement.querySelector(".tools");
    tools.hidden = false;
    tools.addEventListener("click", (event) => {
      const what = event.target.dataset.do;
      if (what === "whole") reset();
      else if (what) zoom(what === "in" ? 0.5 : 2);
    });
    new ResizeObserver(show).observe(svg);
    addEventListener("beforeprint", reset);
    show();
    svg.look = look;
  };
  all("svg.picture").forEach(picture);

  // Layers on and off.
  all(".toggle").forEach((cell) => { cell.hidden = false; });
  all(".layers input").forEach((box) => box.addEventListener("change", () => {
    all(".linework use", box.closest("figure")).forEach((use) => {
      if (use.dataset.layer === box.dataset.layer) use.style.display = box.checked ? "" : "none";
    });
  }));

  // List to mark, mark to list.
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const here = (element) => {
    all(".here").forEach((other) => other.classList.remove("here"));
    element.classList.add("here");
  };
  const go = (hash, keep) => {
    const target = hash.length > 1 && document.getElementById(hash.slice(1));
    if (!target) return false;
    const main = target.closest("main");
    if (main && getComputedStyle(main).display === "none") {
      document.getElementById("show-" + main.lang).checked = true;
      speak();
    }
    const mark = target.matches(".mark");
    if (!mark && !target.matches(".rows tr")) return false;
    here(target);
    const fold = target.closest(".rest") && target.closest("article").querySelector(".unfold");
    if (fold) fold.checked = true;
    if (mark) target.closest("svg").look(target);
    (mark ? target.closest(".stage, figure") : target).scrollIntoView({ behavior: calm.matches ? "auto" : "smooth", block: mark ? "nearest" : "center" });
    if (mark) target.focus({ preventScroll: true });
    else (target.querySelector(".to-mark") || target).focus({ preventScroll: true });
    if (!keep) history.pushState(null, "", hash);
    return true;
  };
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a.to-mark, a.mark");
    if (link && !event.defaultPrevented && !event.ctrlKey && !event.metaKey && go(link.getAttribute("href"))) event.preventDefault();
  });
  addEventListener("popstate", () => go(location.hash, true));
  if (location.hash) go(location.hash, true);

  // "?print=all" asks for all rows on paper, as the box on top does.
  if (new URLSearchParams(location.search).get("print") === "all") document.getElementById("print-all").checked = true;

  // Paper folds nothing.
  let folded = [];
  addEventListener("beforeprint", () => {
    folded = all("details:not([open])").filter((details) => !details.matches(".layers"));
    folded.forEach((details) => { details.open = true; });
  });
  addEventListener("afterprint", () => folded.forEach((details) => { details.open = false; }));
})();
