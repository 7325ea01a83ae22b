"use strict";

/** A canvas as large as its place on the page, sharp on every screen. */
const stageOf = (canvas) => {
  const pen = canvas.getContext("2d");
  const begin = () => {
    const { width, height } = canvas.getBoundingClientRect();
    const density = devicePixelRatio || 1;
    canvas.width = Math.round(width * density);
    canvas.height = Math.round(height * density);
    pen.setTransform(density, 0, 0, density, 0, 0);
    pen.font = `12px ${getComputedStyle(document.body).fontFamily}`;
    pen.lineJoin = pen.lineCap = "round";
    return { width, height };
  };
  return { pen, begin };
};

/** The rail under the wheels from the side, at a moment between two frames. */
const makeScene = (canvas, show) => {
  const { pen, begin } = stageOf(canvas);
  const railX = unpack(show.railX), sleeperX = unpack(show.sleeperX);
  const rail = unpack(show.rail), sleeper = unpack(show.sleeper);
  const wheelX = unpack(show.wheelX), gap = unpack(show.gap), force = unpack(show.force);
  const distance = unpack(show.distance);
  const deepest = rail.reduce((a, b) => Math.max(a, b), 0.01);
  const highest = gap.reduce((a, b) => Math.max(a, b), 0);
  const strongest = force.reduce((a, b) => Math.max(a, b), show.static);
  const NICE = [1000, 500, 300, 200, 100, 50, 30, 20, 10, 5, 3, 2, 1];
  const RAIL = 8, SLEEPER = 15, WIDTH = 0.26;

  /** A value of a row of frames, on the straight line between two of them. */
  const at = (values, columns, column, frame) => {
    const before = Math.min(Math.floor(frame), show.frames - 1);
    const after = Math.min(before + 1, show.frames - 1);
    const a = values[before * columns + column], b = values[after * columns + column];
    return a + (frame - before) * (b - a);
  };

  const railAt = (x, frame) => {
    const step = railX[1] - railX[0];
    const place = Math.min(Math.max((x - railX[0]) / step, 0), railX.length - 1.001);
    const k = Math.floor(place);
    const a = at(rail, railX.length, k, frame), b = at(rail, railX.length, k + 1, frame);
    return a + (place - k) * (b - a);
  };

  const compression = (() => {
    let largest = 0;
    for (let k = 0; k < sleeperX.length; k += 1) {
      for (let frame = 0; frame < show.frames; frame += 1) {
        largest = Math.max(largest, railAt(sleeperX[k], frame) - at(sleeper, sleeperX.length, k, frame));
      }
    }
    return largest;
  })();

  const measure = ({ width, height }) => {
    const perMetre = width / (railX[railX.length - 1] - railX[0]);
    const wanted = (0.2 * height) / deepest / (perMetre / 1000);
    const exaggeration = NICE.find((value) => value <= wanted) ?? 1;
    const perMillimetre = (exaggeration * perMetre) / 1000;
    const radius = show.radius * perMetre;
    const lift = highest * perMillimetre;
    const top = Math.max(2 * radius + 34 + lift, 0.46 * height);
    return {
      width, height, perMetre, perMillimetre, exaggeration, radius, top,
      pad: Math.max(12, compression * perMillimetre + 8),
      x: (metres) => (metres - railX[0]) * perMetre,
      y: (millimetres) => top + millimetres * perMillimetre,
    };
  };

  const drawBed = (size) => {
    const level = size.top + RAIL + size.pad + 6;
    pen.fillStyle = theme.colour("ballast");
    pen.fillRect(0, level, size.width, size.height - level);
  };

  const drawSupports = (size, frame) => {
    sleeperX.forEach((metres, k) => {
      const x = size.x(metres), half = (WIDTH * size.perMetre) / 2;
      const under = size.y(railAt(metres, frame)) + RAIL;
      const top = size.y(at(sleeper, sleeperX.length, k, frame)) + RAIL + size.pad;
      pen.fillStyle = theme.colour("sleeper");
      pen.beginPath();
      pen.roundRect(x - half, top, 2 * half, SLEEPER, 3);
      pen.fill();
      pen.strokeStyle = theme.colour("quiet");
      pen.lineWidth = 1.3;
      pen.beginPath();
      const turns = 6, swing = Math.min(5, half / 2);
      pen.moveTo(x, under);
      for (let n = 1; n < turns; n += 1) {
        pen.lineTo(x + (n % 2 ? swing : -swing), under + ((top - under) * n) / turns);
      }
      pen.lineTo(x, top);
      pen.stroke();
    });
  };

  const drawRail = (size, frame) => {
    pen.strokeStyle = theme.colour("quiet");
    pen.lineWidth = 1;
    pen.setLineDash([4, 5]);
    pen.beginPath();
    pen.moveTo(0, size.top);
    pen.lineTo(size.width, size.top);
    pen.stroke();
    pen.setLineDash([]);
    pen.fillStyle = theme.colour("steel");
    pen.beginPath();
    railX.forEach((x, k) => pen.lineTo(size.x(x), size.y(at(rail, railX.length, k, frame))));
    for (let k = railX.length - 1; k >= 0; k -= 1) {
      pen.lineTo(size.x(railX[k]), size.y(at(rail, railX.length, k, frame)) + RAIL);
    }
    pen.fill();
  };

  const drawWheel = (size, frame, wheel) => {
    const metres = at(wheelX, show.wheels, wheel, frame);
    const apart = Math.max(0, at(gap, show.wheels, wheel, frame));
    const x = size.x(metres), bottom = size.y(railAt(metres, frame) - apart);
    const centre = bottom - size.radius, colour = shade(show.colours[wheel]);
    if (x < -size.radius || x > size.width + size.radius) return;
    pen.lineWidth = Math.max(3, 0.09 * size.radius);
    pen.strokeStyle = theme.colour("steel");
    pen.fillStyle = theme.colour("card");
    pen.beginPath();
    pen.arc(x, centre, size.radius - pen.lineWidth / 2, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
    if (wheel === show.flatWheel) drawFlat(size, x, centre, at(distance, 1, 0, frame), colour);
    drawArrow(size, x, bottom, at(force, show.wheels, wheel, frame), colour);
    pen.fillStyle = theme.colour("ink");
    pen.textAlign = "center";
    pen.fillText(`wheel ${wheel + 1}`, x, centre - size.radius - 18);
    pen.fillText(`${at(force, show.wheels, wheel, frame).toFixed(0)} kN`, x, centre - size.radius - 4);
  };

  const drawFlat = (size, x, centre, travelled, colour) => {
    const middle = Math.PI / 2 + travelled / show.radius; // clockwise, as a wheel rolls to the right
    const half = Math.max(show.flatLength / 2 / show.radius, 0.09);
    pen.strokeStyle = colour;
    pen.lineWidth = Math.max(6, 0.16 * size.radius);
    pen.lineCap = "butt";
    pen.beginPath();
    pen.arc(x, centre, size.radius - pen.lineWidth / 2, middle - half, middle + half);
    pen.stroke();
    pen.lineCap = "round";
  };

  const drawArrow = (size, x, bottom, kilonewtons, colour) => {
    const length = (1.85 * size.radius * kilonewtons) / strongest;
    if (length < 2) return;
    const head = Math.min(8, length);
    pen.strokeStyle = pen.fillStyle = colour;
    pen.lineWidth = 3;
    pen.beginPath();
    pen.moveTo(x, bottom - length);
    pen.lineTo(x, bottom - head);
    pen.stroke();
    pen.beginPath();
    pen.moveTo(x, bottom);
    pen.lineTo(x - 0.6 * head, bottom - head);
    pen.lineTo(x + 0.6 * head, bottom - head);
    pen.fill();
  };

  const drawScales = (size) => {
    const bottom = size.height - 14;
    pen.strokeStyle = pen.fillStyle = theme.colour("ink");
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.moveTo(16, bottom - size.perMillimetre);
    pen.lineTo(16, bottom);
    pen.lineTo(16 + size.perMetre, bottom);
    pen.stroke();
    pen.textAlign = "left";
    pen.fillText("1 mm", 22, bottom - size.perMillimetre + 10);
    pen.fillText("1 m", 22 + size.perMetre, bottom + 4);
    if (show.flatWheel < 0) return;
    const x = size.x(show.place);
    pen.fillStyle = theme.colour("quiet");
    pen.beginPath();
    pen.moveTo(x, size.height - 30);
    pen.lineTo(x - 5, size.height - 22);
    pen.lineTo(x + 5, size.height - 22);
    pen.fill();
    pen.textAlign = "center";
    pen.fillText("the flat strikes here", x, size.height - 9);
  };

  const draw = (frame) => {
    const size = measure(begin());
    drawBed(size);
    drawSupports(size, frame);
    drawRail(size, frame);
    for (let wheel = 0; wheel < show.wheels; wheel += 1) drawWheel(size, frame, wheel);
    drawScales(size);
    return size.exaggeration;
  };
  return { draw, force: (wheel, frame) => at(force, show.wheels, wheel, frame), distance: (frame) => at(distance, 1, 0, frame) };
};
