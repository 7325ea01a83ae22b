"use strict";

/** The contact forces over time beside the scene, drawn strongly up to the moment that is shown. */
const makeForceChart = (canvas, show) => {
  const { pen, begin } = stageOf(canvas);
  const time = unpack(show.curveTime), force = unpack(show.curveForce);
  const first = time[0], last = time[time.length - 1];
  const highest = 1.06 * force.reduce((a, b) => Math.max(a, b), show.static);
  const edge = { left: 46, right: 14, top: 34, bottom: 40 };

  /** Round numbers, about `number` of them, that divide a range. */
  const ticks = (low, high, number) => {
    const rough = (high - low) / number, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * ([1, 2, 5].find((factor) => factor * power >= rough) ?? 10);
    const start = Math.ceil(low / step), end = Math.floor(high / step + 1e-9);
    return Array.from({ length: end - start + 1 }, (_, k) => (start + k) * step);
  };

  const measure = ({ width, height }) => ({
    width, height,
    x: (t) => edge.left + ((width - edge.left - edge.right) * (t - first)) / (last - first),
    y: (kilonewtons) => height - edge.bottom - ((height - edge.top - edge.bottom) * kilonewtons) / highest,
  });

  const stroke = (points, colour, width, dash = []) => {
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.setLineDash(dash);
    pen.beginPath();
    for (const [x, y] of points) pen.lineTo(x, y);
    pen.stroke();
    pen.setLineDash([]);
  };

  const drawGrid = (size) => {
    pen.fillStyle = theme.colour("quiet");
    pen.textAlign = "right";
    for (const value of ticks(0, highest, 5)) {
      stroke([[edge.left, size.y(value)], [size.width - edge.right, size.y(value)]], theme.colour("grid"), 1);
      pen.fillText(value.toFixed(0), edge.left - 7, size.y(value) + 4);
    }
    pen.textAlign = "center";
    for (const value of ticks(1000 * (first - show.strike), 1000 * (last - show.strike), 8)) {
      const x = size.x(show.strike + value / 1000);
      stroke([[x, size.height - edge.bottom], [x, size.height - edge.bottom + 4]], theme.colour("quiet"), 1);
      pen.fillText(value.toFixed(0), x, size.height - edge.bottom + 17);
    }
    pen.fillText("time from the flat’s centre [ms]", (edge.left + size.width) / 2, size.height - 7);
    pen.textAlign = "left";
    pen.fillStyle = theme.colour("ink");
    pen.fillText("contact force [kN]", 12, 20);
    stroke([[edge.left, size.y(show.static)], [size.width - edge.right, size.y(show.static)]], theme.colour("quiet"), 1, [5, 4]);
  };

  const drawCurve = (size, wheel, until) => {
    const points = Array.from(time, (t, k) => [size.x(t), size.y(force[k * show.wheels + wheel])]);
    const colour = shade(show.colours[wheel]), now = size.x(until);
    pen.globalAlpha = 0.3;
    stroke(points, colour, 1.2);
    pen.globalAlpha = 1;
    stroke(points.filter(([x]) => x <= now), colour, 2);
  };

  const draw = (moment, forces) => {
    const size = measure(begin());
    drawGrid(size);
    for (let wheel = show.wheels - 1; wheel >= 0; wheel -= 1) drawCurve(size, wheel, moment);
    const x = size.x(moment);
    stroke([[x, edge.top], [x, size.height - edge.bottom]], theme.colour("quiet"), 1);
    forces.forEach((value, wheel) => {
      pen.fillStyle = shade(show.colours[wheel]);
      pen.beginPath();
      pen.arc(x, size.y(value), 4.5, 0, 2 * Math.PI);
      pen.fill();
    });
  };
  return { draw };
};
