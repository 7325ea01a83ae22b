"use strict";

/** The animation: a moment that moves on, or is moved, and what is drawn of it. */
(() => {
  const show = report.animation;
  if (show === null) return;
  const element = (id) => document.getElementById(id);
  const [play, slider, slowness, reading] = ["play", "moment", "slowness", "reading"].map(element);
  const scene = makeScene(element("scene"), show);
  const chart = makeForceChart(element("force-chart"), show);
  const time = unpack(show.time), last = show.frames - 1;
  let frame = show.peak, playing = false, before = null, touched = false;

  const words = (moment, forces) => {
    const millimetres = 1000 * scene.distance(frame);
    const place = `flat’s wheel ${Math.abs(millimetres).toFixed(0)} mm ${millimetres < 0 ? "before" : "after"} the place`;
    const each = forces.map((value, k) => `wheel ${k + 1}: ${value.toFixed(1)} kN`).join(", ");
    const shown = 1000 / Number(slowness.value);
    return `t = ${moment.toFixed(4)} s · ${place} · ${each} · one second here is ${shown.toFixed(0)} ms`;
  };

  const draw = () => {
    if (element("scene").clientWidth === 0) return; // while a browser lays the page out on paper
    const moment = time[0] + frame / show.rate;
    const forces = Array.from({ length: show.wheels }, (_, wheel) => scene.force(wheel, frame));
    element("exaggeration").textContent = scene.draw(frame);
    chart.draw(moment, forces);
    slider.value = String(Math.round(frame));
    reading.textContent = words(moment, forces);
  };

  const stop = () => {
    playing = false;
    play.textContent = "Play";
  };

  const advance = (now) => {
    if (!playing) return;
    const passed = before === null ? 0 : Math.min(now - before, 100) / 1000;
    before = now;
    frame = Math.min(frame + (passed * show.rate) / Number(slowness.value), last);
    if (frame >= last) stop();
    draw();
    if (playing) requestAnimationFrame(advance);
  };

  play.addEventListener("click", () => {
    if (playing) {
      stop();
      return;
    }
    if (!touched || frame >= last) frame = 0; // the peak is shown first, the play begins before it
    touched = playing = true;
    before = null;
    play.textContent = "Pause";
    requestAnimationFrame(advance);
  });
  slider.addEventListener("input", () => {
    touched = true;
    frame = Number(slider.value);
    draw();
  });
  slowness.addEventListener("change", draw);
  addEventListener("resize", draw);
  theme.onChange(draw);
  draw();
})();
