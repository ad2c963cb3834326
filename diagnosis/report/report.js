"use strict";
const figures = JSON.parse(document.getElementById("figures").textContent);
const BINS = 1200;
const touch = window.matchMedia("(pointer: coarse)").matches;
const config = { responsive: true, displaylogo: false, showSendToCloud: false, displayModeBar: touch ? true : "hover",
                 modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"] };

// Samples are evenly spaced, two bytes each.
function unpacked(samples) {
  const bytes = Uint8Array.from(atob(samples.u2), (letter) => letter.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const y = new Float64Array(bytes.length / 2);
  for (let i = 0; i < y.length; i++) y[i] = samples.low + samples.size * view.getUint16(2 * i, true) / 65535;
  return { t0: samples.t0, step: samples.step, y };
}

// The least and the largest of each stretch of what is seen, so that nothing narrow is lost.
function thinned(full, range) {
  const at = (t) => Math.round((t - full.t0) / full.step);
  const first = range ? Math.max(0, at(range[0]) - 2) : 0;
  const last = range ? Math.min(full.y.length - 1, at(range[1]) + 2) : full.y.length - 1;
  const stride = Math.max(1, Math.ceil((last - first + 1) / BINS));
  const x = [], y = [];
  for (let i = first; i <= last; i += stride) {
    let low = i, high = i;
    for (let k = i; k < Math.min(i + stride, last + 1); k++) {
      if (full.y[k] < full.y[low]) low = k;
      if (full.y[k] > full.y[high]) high = k;
    }
    for (const k of low === high ? [low] : [Math.min(low, high), Math.max(low, high)]) {
      x.push(full.t0 + k * full.step);
      y.push(full.y[k]);
    }
  }
  return { x, y };
}

function draw(element, figure) {
  const full = figure.data.map((trace) => trace.samples ? unpacked(trace.samples) : null);
  const data = figure.data.map((trace, n) => full[n] ? { ...trace, ...thinned(full[n]), samples: undefined } : trace);
  const layout = { paper_bgcolor: "transparent", plot_bgcolor: "transparent", autosize: true,
                   modebar: { bgcolor: "transparent" }, margin: { l: 50, r: 10, t: touch ? 56 : 30, b: 40 }, dragmode: touch ? false : "zoom",
                   legend: { orientation: "h", y: 1, yanchor: "bottom", x: 0 },
                   font: { family: "system-ui, sans-serif", size: 12 }, ...figure.layout };
  Plotly.newPlot(element, data, layout, config);
  if (!full.some(Boolean)) return;
  element.on("plotly_relayout", (change) => {
    if (!Object.keys(change).some((key) => key.startsWith("xaxis."))) return;
    const range = change["xaxis.autorange"] ? null : element.layout.xaxis.range;
    const parts = full.map((samples) => thinned(samples, range));
    Plotly.restyle(element, { x: parts.map((part) => part.x), y: parts.map((part) => part.y) });
  });
}

const places = [...document.querySelectorAll(".figure")];
for (const place of places) draw(place, figures[place.dataset.figure]);

for (const select of document.querySelectorAll("select[data-shows]")) {
  select.addEventListener("change", () => {
    const place = document.getElementById(select.dataset.shows);
    Plotly.purge(place);
    draw(place, figures[select.value]);
  });
}

for (const button of document.querySelectorAll("button[data-copies]")) {
  button.addEventListener("click", async () => {
    const code = document.getElementById(button.dataset.copies);
    try {
      await navigator.clipboard.writeText(code.textContent);
      button.textContent = "Copied";
    } catch {
      window.getSelection().selectAllChildren(code);
      button.textContent = "Selected; press Ctrl+C";
    }
  });
}

// Paper has its own width.
window.addEventListener("beforeprint", () => {
  for (const place of places) {
    const width = place.parentElement.className === "grid" ? 330 : Math.min(680, place.clientWidth);
    Plotly.relayout(place, { width, height: Math.min(800, figures[place.dataset.figure].layout.height) });
    place.style.height = "auto";
  }
});
window.addEventListener("afterprint", () => {
  for (const place of places) {
    const height = figures[place.dataset.figure].layout.height;
    place.style.height = `${height}px`;
    Plotly.relayout(place, { width: null, height, autosize: true });
  }
});
