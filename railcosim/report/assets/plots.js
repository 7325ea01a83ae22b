"use strict";

/** The interactive figures; those over time or distance share their horizontal axis. */
(() => {
  const coarse = matchMedia("(pointer: coarse)");
  const paper = matchMedia("print");
  const titles = {
    distance: "distance from the flat’s centre [m]",
    time: "time [s]",
  };
  let passing = false; // one figure passes its range on to the others

  const checked = (name) => document.querySelector(`input[name="${name}"]:checked`).value;

  /** Copies a figure's description with its colours as they are on the present page. */
  const shaded = (value, key) => {
    if (typeof value === "string") return key === "bdata" ? value : shade(value);
    if (Array.isArray(value)) return value.map((item) => shaded(item));
    if (value === null || typeof value !== "object") return value;
    return Object.fromEntries(Object.entries(value).map(([k, item]) => [k, shaded(item, k)]));
  };

  const bandsOf = (plot, axis) => [
    ...(plot.bands[axis] ?? []).map(([x0, x1]) => ({
      type: "rect", xref: "x", yref: "paper", x0, x1, y0: 0, y1: 1,
      fillcolor: theme.colour("accent"), opacity: 0.18, line: { width: 0 }, layer: "below",
    })),
    ...(report.strike === null ? [] : [{
      type: "line", xref: "x", yref: "paper", x0: report.strike[axis], x1: report.strike[axis],
      y0: 0, y1: 1, line: { width: 1, color: theme.colour("quiet"), dash: "dot" }, layer: "below",
    }]),
  ];

  const lines = () => ({
    gridcolor: theme.colour("grid"), linecolor: theme.colour("line"), zeroline: false,
    automargin: true, ticks: "outside", tickcolor: theme.colour("line"), ticklen: 4,
  });

  const horizontal = (plot) => {
    const own = plot.layout.xaxis ?? {};
    if (plot.abscissa === null) return { ...lines(), ...own };
    const axis = checked("axis");
    const range = checked("extent") === "strike" ? { range: [...report.zoom[axis]] } : {};
    return { ...lines(), ...own, title: { text: titles[axis], standoff: 8 }, ...range, hoverformat: ".4f" };
  };

  const layoutOf = (plot) => {
    const layout = shaded(plot.layout);
    const bands = plot.abscissa === null ? [] : bandsOf(plot, checked("axis"));
    return {
      ...layout,
      xaxis: horizontal(plot),
      yaxis: { ...lines(), hoverformat: ".4~g", ...layout.yaxis },
      shapes: [...bands, ...(layout.shapes ?? [])],
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      font: { color: theme.colour("ink"), size: 12, family: getComputedStyle(document.body).fontFamily },
      margin: { l: 56, r: 14, t: coarse.matches ? 34 : 8, b: 44 }, // fingers see the buttons always
      legend: {
        orientation: "h", x: 0, xanchor: "left",
        ...(coarse.matches ? { y: -0.26, yanchor: "top" } : { y: 1.02, yanchor: "bottom" }),
      },
      hovermode: plot.abscissa === null ? "closest" : "x unified",
      hoverlabel: { bgcolor: theme.colour("card"), bordercolor: theme.colour("line"), font: { color: theme.colour("ink") } },
      modebar: { bgcolor: "rgba(0,0,0,0)", color: theme.colour("quiet"), activecolor: theme.colour("accent") },
      dragmode: coarse.matches ? false : "zoom",
      bargap: 0.35,
    };
  };

  const dataOf = (plot) => {
    const traces = shaded(plot.data);
    if (plot.abscissa === null) return traces;
    return traces.map((trace) => ({ ...trace, x: report.axes[plot.abscissa][checked("axis")] }));
  };

  const configOf = (plot) => ({
    responsive: true,
    displaylogo: false,
    doubleClick: plot.abscissa === null ? "reset" : false,
    // these and no others: Plotly has buttons that send the data away
    modeBarButtons: [["toImage"], ["zoom2d", "pan2d"], ["zoomIn2d", "zoomOut2d"]],
    plotlyServerURL: "",
    toImageButtonOptions: { format: "svg", filename: plot.key },
  });

  const draw = (plot) => Plotly.react(plot.key, dataOf(plot), layoutOf(plot), configOf(plot));
  const drawAll = () => report.plots.forEach(draw);
  const linked = report.plots.filter((plot) => plot.abscissa !== null);

  /** Passes the horizontal range of one figure on to all that share the axis. */
  const passOn = async (source, change) => {
    const range = change["xaxis.range"] ?? [change["xaxis.range[0]"], change["xaxis.range[1]"]];
    if (passing || range.includes(undefined)) return;
    passing = true;
    const others = linked.filter((plot) => plot !== source);
    await Promise.all(others.map((plot) => Plotly.relayout(plot.key, { "xaxis.range": [...range] })));
    passing = false;
  };

  /** Fits the figures to the paper's width while it is printed, and back. */
  const fit = () => {
    for (const { key } of report.plots) {
      const { width, height } = document.getElementById(key).getBoundingClientRect();
      Plotly.relayout(key, { width, height, autosize: !paper.matches });
    }
  };

  drawAll();
  for (const plot of linked) {
    const element = document.getElementById(plot.key);
    element.on("plotly_relayout", (change) => passOn(plot, change));
    element.on("plotly_doubleclick", () => linked.forEach(draw));
  }
  for (const input of document.querySelectorAll(".controls input")) {
    input.addEventListener("change", () => linked.forEach(draw));
  }
  theme.onChange(drawAll);
  paper.addEventListener("change", fit);
})();
