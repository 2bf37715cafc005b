// SPDX-License-Identifier: BSD-3-Clause
// Plays `motion`: moves the vertices of plotly's meshes by their carriers' poses, frame by frame.
"use strict";
(() => {
  const unpack = (text) =>
    new Float32Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  const byId = (id) => document.getElementById(id);
  const bodies = byId("bodies"), curves = byId("curves"), slider = byId("slider");
  const play = byId("play"), speed = byId("speed");
  const poses = unpack(motion.poses), time = motion.time, last = time.length - 1;
  const moving = motion.moving.map((one) => ({...one, vertices: unpack(one.vertices)}));
  const lights = motion.lights.map((one) => {
    const box = document.createElement("div"), lamp = document.createElement("i");
    const text = document.createElement("span");
    box.className = "light";
    box.title = one.name;
    box.append(lamp, text);
    byId("lights").append(box);
    return {...one, lamp, words: text};
  });
  const cursor = document.createElement("div");
  cursor.id = "cursor";
  slider.max = last;
  let frame = 0, drawn = -1, busy = false, playing = false, clock = 0, before = 0;

  // Vertices of one trace at a frame: rotation (9) and place (3) of each carrier.
  function moved(one, at) {
    const n = one.vertices.length / 3, v = one.vertices;
    const x = new Array(n), y = new Array(n), z = new Array(n);
    let k = 0;
    for (const [carrier, count] of one.carrier) {
      const p = 12 * (at * motion.carriers + carrier);
      for (const end = k + count; k < end; ++k) {
        const a = v[3 * k], b = v[3 * k + 1], c = v[3 * k + 2];
        x[k] = poses[p] * a + poses[p + 1] * b + poses[p + 2] * c + poses[p + 9];
        y[k] = poses[p + 3] * a + poses[p + 4] * b + poses[p + 5] * c + poses[p + 10];
        z[k] = poses[p + 6] * a + poses[p + 7] * b + poses[p + 8] * c + poses[p + 11];
      }
    }
    return [x, y, z];
  }

  function label() {
    const now = time[frame];
    byId("now").textContent = `${now.toFixed(2)} of ${time[last].toFixed(2)} s`;
    const phase = motion.phases.find(([, begin, end]) => begin <= now && now <= end);
    byId("phase").textContent = phase ? phase[0] : "";
    for (const one of lights) {
      one.lamp.style.background = motion.colours[one.state[frame]];
      one.words.textContent = one.text[frame];
    }
    slider.value = frame;
  }

  // The line through the curves lies over the drawing: to draw that again would take longer.
  function point() {
    if (!curves) return;
    const {xaxis, _size} = curves._fullLayout, x = xaxis.d2p(time[frame]);
    cursor.style.display = x < 0 || x > xaxis._length ? "none" : "block";
    cursor.style.transform = `translate(${_size.l + x}px, ${_size.t}px)`;
    cursor.style.height = `${_size.h}px`;
  }

  async function draw() {
    if (busy || drawn === frame) return;
    busy = true;
    const at = frame;
    label();
    if (moving.length) {
      const points = moving.map((one) => moved(one, at));
      const axis = (k) => points.map((p) => p[k]);
      await Plotly.restyle(bodies, {x: axis(0), y: axis(1), z: axis(2)},
                           moving.map((one) => one.trace));
    }
    point();
    drawn = at;
    busy = false;
    if (at !== frame) requestAnimationFrame(draw);
  }

  function show(number) {
    frame = Math.min(Math.max(number, 0), last);
    requestAnimationFrame(draw);
  }

  function frameAt(now) {
    let low = 0, high = last;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (time[middle] <= now) low = middle; else high = middle - 1;
    }
    return low;
  }

  function step(stamp) {
    if (!playing) return;
    clock += (stamp - before) / 1000 * Number(speed.value);
    before = stamp;
    show(frameAt(clock));
    if (clock >= time[last]) { set(false); return; }
    requestAnimationFrame(step);
  }

  function set(on) {
    playing = on && last > 0;
    play.textContent = playing ? "Pause" : "Play";
    if (!playing) return;
    clock = frame >= last ? time[0] : time[frame];
    before = performance.now();
    requestAnimationFrame(step);
  }

  play.onclick = () => set(!playing);
  slider.oninput = () => { set(false); show(Number(slider.value)); };
  document.addEventListener("keydown", (event) => {
    if (event.target.tagName === "SELECT" || event.target === play) return;
    if (event.key === " ") { event.preventDefault(); set(!playing); }
  });
  if (curves) {
    byId("right").append(cursor);
    curves.on("plotly_click", (event) => { set(false); show(frameAt(event.points[0].x)); });
    curves.on("plotly_afterplot", point);
  }
  window.bathyalShow = show;
  for (const one of [bodies, curves]) if (one) Plotly.Plots.resize(one);
  show(0);
})();
