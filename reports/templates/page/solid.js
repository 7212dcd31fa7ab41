"use strict";
// Meshes in space. Without this script, or without WebGL, the page shows its six fixed pictures instead.
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const figures = all("figure.solid[data-solid]");
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("webgl2", { antialias: true });
  if (!context || !figures.length) return;
  const renderer = new three.WebGLRenderer({ canvas, context, antialias: true });
  renderer.setClearColor(0xffffff);
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const severities = ["critical", "major", "minor", "note"];
  const colours = severities.map((name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());

  // Vectors are arrays of three numbers.
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const sum = (...terms) => [0, 1, 2].map((n) => terms.reduce((total, [factor, vector]) => total + factor * vector[n], 0));
  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;

  // What the page holds of one mesh, once for all languages.
  const frames = { z: [[1, 0, 0], [0, 0, 1]], y: [[1, 0, 0], [0, 1, 0]], x: [[0, 1, 0], [1, 0, 0]] };
  const held = new Map();
  const meshOf = (number) => {
    if (held.has(number)) return held.get(number);
    const data = document.getElementById(`solid-data-${number}`).dataset;
    const steps = new Uint16Array(bytes(data.steps));
    const corners = new (data.wide ? Uint32Array : Uint16Array)(bytes(data.triangles));
    const points = Float32Array.from(steps, (step) => step / 65535);
    const extent = [0, 0, 0];
    points.forEach((part, n) => { extent[n % 3] = Math.max(extent[n % 3], part); });
    const [right, up] = frames[data.up];
    const mesh = {
      points, corners, extent, right, up, front: cross(right, up),
      middle: extent.map((side) => side / 2), cell: Number(data.cell), metres: Number(data.metres),
      marks: new Float32Array(bytes(data.marks)),
    };
    mesh.lift = Math.max(1.75 * mesh.cell, 0.0015);  // findings lie on the true surface: at most so far under this one
    mesh.build = () => { build(mesh, data); };
    held.set(number, mesh);
    return mesh;
  };

  const geometry = (points, corners) => {
    const made = new three.BufferGeometry();
    made.setAttribute("position", new three.BufferAttribute(points, 3));
    if (corners) made.setIndex(new three.BufferAttribute(corners, 1));
    return made;
  };

  const build = (mesh, data) => {
    if (mesh.scene) return;
    mesh.scene = new three.Scene();
    mesh.light = new three.DirectionalLight(0xffffff, 2.3);
    mesh.scene.add(new three.AmbientLight(0xffffff, 0.85), mesh.light, mesh.light.target);
    const surface = geometry(mesh.points, mesh.corners);
    for (const [side, color] of [[three.FrontSide, 0xe4e0d8], [three.BackSide, 0x7f97b8]]) {
      mesh.scene.add(new three.Mesh(surface, new three.MeshLambertMaterial({ color, side, flatShading: true })));
    }
    // Findings twice: as they are, and lighter where the surface hides them. Lines are drawn beside themselves, to be wider.
    mesh.findings = [];
    const sizes = { points: 3, lines: 6, faces: 9 };
    for (const [kind, size] of Object.entries(sizes)) {
      const values = new Float32Array(bytes(data[kind]));
      let from = 0;
      data[`${kind}Count`].split(" ").map(Number).forEach((count, rank) => {
        const part = values.subarray(from, from + count * size);
        from += count * size;
        if (!count) return;
        const shape = geometry(part);
        for (const hidden of [true, false]) {
          const look = {
            color: colours[rank], depthWrite: false, transparent: true, opacity: hidden ? 0.35 : kind === "faces" ? 0.8 : 1,
            depthFunc: hidden ? three.GreaterDepth : three.LessEqualDepth,
          };
          const places = kind === "lines" ? [[0, 0], [1, 0], [0, 1], [1, 1]] : [[0, 0]];
          const material = kind === "points" ? new three.PointsMaterial({ ...look, size: 6, sizeAttenuation: false })
            : kind === "lines" ? new three.LineBasicMaterial(look) : new three.MeshBasicMaterial({ ...look, side: three.DoubleSide });
          const Kind = { points: three.Points, lines: three.LineSegments, faces: three.Mesh }[kind];
          for (const place of places) {
            const object = new Kind(shape, material);
            object.renderOrder = (hidden ? 10 : 20) + 4 - rank;
            object.frustumCulled = false;
            object.userData.place = place;
            mesh.scene.add(object);
            mesh.findings.push(object);
          }
        }
      });
    }
  };

  // Where the camera stands: what it looks at, from which side, and half the height of what it shows.
  const turned = (mesh, camera) => {
    const { turn, rise } = camera;
    const right = sum([Math.cos(turn), mesh.right], [-Math.sin(turn), mesh.front]);
    const level = sum([Math.sin(turn), mesh.right], [Math.cos(turn), mesh.front]);
    const back = sum([Math.cos(rise), level], [Math.sin(rise), mesh.up]);
    return { right, back, up: cross(back, right) };
  };
  const quarter = Math.PI / 2;
  const sides = {
    front: [0, 0], right: [quarter, 0], back: [2 * quarter, 0], left: [-quarter, 0], top: [0, quarter], bottom: [0, -quarter],
  };

  const lengths = [["km", 1000], ["m", 1], ["cm", 0.01], ["mm", 0.001]];
  const lettering = (metres) => {
    const [name, length] = lengths.find(([, size]) => metres >= size * 0.999) || ["µm", 1e-6];
    return Math.round(metres / length).toLocaleString("en").replaceAll(",", "\u202f") + " " + name;
  };

  const eye = new three.OrthographicCamera(-1, 1, 1, -1, 0, 10);
  eye.matrixAutoUpdate = false;

  // One figure: a canvas that shows what the one renderer made, and marks above it.
  const view = (figure) => {
    const mesh = meshOf(figure.dataset.solid);
    const stage = figure.querySelector(".stage");
    const shown = figure.querySelector("canvas");
    const over = figure.querySelector("svg.over");
    const bar = over.querySelector(".bar");
    const group = over.querySelector(".marks");
    const paper = shown.getContext("2d");
    let camera = null, whole = null, trail = [], due = 0, still = 0, flight = 0, size = [0, 0];

    const frame = (turn, rise) => {
      const axes = turned(mesh, { turn, rise });
      const [width, height] = [axes.right, axes.up].map((axis) => mesh.extent.reduce((total, side, n) => total + side * Math.abs(axis[n]), 0));
      const aspect = size[0] / size[1] || 1.6;
      return { target: [...mesh.middle], turn, rise, half: 0.54 * Math.max(height, width / aspect, 1e-6) };
    };

    // Marks of the findings that the list holds; a row is reached by its mark, a mark by its row.
    const main = figure.closest("main");
    const links = new Map(all(`a.to-mark[data-solid="${figure.dataset.solid}"]`, main).map((link) => [Number(link.textContent), link]));
    const marks = [];
    for (let n = mesh.marks.length - 6; n >= 0; n -= 6) {  // the gravest last, on top
      const [number, rank, x, y, z, reach] = mesh.marks.subarray(n, n + 6);
      const link = links.get(number);
      if (!link) continue;
      const row = link.closest("tr");
      const mark = document.createElementNS("http://www.w3.org/2000/svg", "a");
      mark.id = "m" + row.id.slice(1);
      mark.setAttribute("class", `mark ${severities[rank]}`);
      mark.setAttribute("href", `#${row.id}`);
      const add = (name, attributes, holder, text) => {
        const made = document.createElementNS("http://www.w3.org/2000/svg", name);
        Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
        if (text) made.textContent = text;
        return holder.appendChild(made);
      };
      add("title", {}, mark, `${number}. ${row.lastElementChild.textContent.trim()}`);
      add("circle", { class: "reach", r: 13 }, mark);
      add("use", { href: `#s-${severities[rank]}` }, mark);
      add("text", { x: 11, y: -6 }, mark, String(number));
      group.append(mark);
      link.setAttribute("href", `#${mark.id}`);
      marks.push({ mark, place: [x, y, z], reach });
    }
    over.classList.toggle("many", marks.length > 60);

    const project = (place, axes) => {
      const away = sum([1, place], [-1, camera.target]);
      const unit = size[1] / 2 / camera.half;
      return [size[0] / 2 + unit * dot(away, axes.right), size[1] / 2 - unit * dot(away, axes.up), dot(away, axes.back)];
    };

    // Marks that the surface hides are lighter: looked up once the camera rests, on a coarse buffer of depths.
    const hide = () => {
      const axes = turned(mesh, camera);
      const width = 320, height = Math.max(1, Math.round(width * size[1] / size[0]));
      const scale = width / size[0];
      const depths = new Float32Array(width * height).fill(-Infinity);
      const { points, corners } = mesh;
      const at = new Float32Array(points.length);
      const place = [0, 0, 0];
      for (let n = 0; n < points.length; n += 3) {
        place[0] = points[n]; place[1] = points[n + 1]; place[2] = points[n + 2];
        const [x, y, z] = project(place, axes);
        at[n] = x * scale; at[n + 1] = y * scale; at[n + 2] = z;
      }
      let room = 3e7;  // heaps of large triangles: what is not looked at hides nothing
      for (let n = 0; n < corners.length && room > 0; n += 3) {
        const [a, b, c] = [corners[n] * 3, corners[n + 1] * 3, corners[n + 2] * 3];
        const [ax, ay, bx, by, cx, cy] = [at[a], at[a + 1], at[b], at[b + 1], at[c], at[c + 1]];
        const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5)), right = Math.min(width - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
        const top = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5)), bottom = Math.min(height - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
        const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        if (!area || right < left || bottom < top) continue;
        room -= (right - left + 1) * (bottom - top + 1);
        for (let y = top; y <= bottom; y += 1) {
          for (let x = left; x <= right; x += 1) {
            const v = ((x + 0.5 - ax) * (cy - ay) - (y + 0.5 - ay) * (cx - ax)) / area;
            const w = ((bx - ax) * (y + 0.5 - ay) - (by - ay) * (x + 0.5 - ax)) / area;
            if (v < 0 || w < 0 || v + w > 1) continue;
            const depth = at[a + 2] + v * (at[b + 2] - at[a + 2]) + w * (at[c + 2] - at[a + 2]);
            if (depth > depths[y * width + x]) depths[y * width + x] = depth;
          }
        }
      }
      for (const { mark, place } of marks) {
        const [x, y, z] = project(place, axes);
        const [column, line] = [Math.floor(x * scale), Math.floor(y * scale)];
        let least = Infinity;
        for (let dy = -1; dy <= 1; dy += 1) {
          for (let dx = -1; dx <= 1; dx += 1) {
            const inside = column + dx >= 0 && column + dx < width && line + dy >= 0 && line + dy < height;
            least = Math.min(least, inside ? depths[(line + dy) * width + column + dx] : -Infinity);
          }
        }
        mark.classList.toggle("behind", z < least - mesh.lift);
      }
    };

    const draw = () => {
      due = 0;
      const [width, height] = [stage.clientWidth, Math.round(Math.min(stage.clientWidth / 1.6, innerHeight * 0.8))];
      if (!width) return;
      if (width !== size[0] || height !== size[1]) {
        size = [width, height];
        over.setAttribute("viewBox", `0 0 ${width} ${height}`);
        over.setAttribute("height", height);
        const fitted = frame(...sides.front);
        if (!camera || camera.half === whole) camera = { ...(camera || fitted), half: fitted.half };
        whole = fitted.half;
      }
      mesh.build();
      const axes = turned(mesh, camera);
      const far = 3 + Math.hypot(...sum([1, camera.target], [-1, mesh.middle])) + 2 * camera.half;
      const stand = sum([1, camera.target], [far, axes.back]);
      const aspect = width / height;
      Object.assign(eye, { left: -camera.half * aspect, right: camera.half * aspect, top: camera.half, bottom: -camera.half, near: 0, far: 2 * far });
      eye.updateProjectionMatrix();
      eye.matrix.set(
        axes.right[0], axes.up[0], axes.back[0], stand[0], axes.right[1], axes.up[1], axes.back[1], stand[1],
        axes.right[2], axes.up[2], axes.back[2], stand[2], 0, 0, 0, 1);
      eye.updateMatrixWorld(true);
      const beam = sum([-0.35, axes.right], [0.45, axes.up], [0.82, axes.back]);
      mesh.light.position.set(...sum([1, camera.target], [far, beam]));
      mesh.light.target.position.set(...camera.target);
      const pixel = 2 * camera.half / height;
      mesh.findings.forEach((object) => {
        const [across, down] = object.userData.place;
        object.position.set(...sum([mesh.lift, axes.back], [across * pixel, axes.right], [-down * pixel, axes.up]));
      });
      const ratio = Math.min(devicePixelRatio || 1, 2);
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height, false);
      renderer.render(mesh.scene, eye);
      Object.assign(shown, { width: canvas.width, height: canvas.height });
      paper.drawImage(canvas, 0, 0);
      marks.forEach(({ mark, place }) => {
        const [x, y] = project(place, axes);
        const seen = Math.abs(x) < 1e5 && Math.abs(y) < 1e5;
        mark.setAttribute("transform", seen ? `translate(${x.toFixed(1)} ${y.toFixed(1)})` : "translate(-1000 -1000)");
      });
      over.classList.toggle("near", camera.half < whole / 4);
      const unit = mesh.metres ? pixel * mesh.metres : 0;
      bar.style.display = unit ? "" : "none";
      if (unit) {
        const decade = 10 ** Math.floor(Math.log10(unit * width / 5));
        const length = Math.max(...[1, 2, 5].map((step) => step * decade).filter((step) => step <= unit * width / 5 * 1.0001));
        bar.setAttribute("transform", `translate(16 ${height - 16})`);
        bar.querySelector("path").setAttribute("d", `M0 0v6h${length / unit}v-6`);
        bar.querySelector("text").textContent = lettering(length);
      }
      stage.dataset.moving = flight ? "yes" : "";
      clearTimeout(still);
      if (marks.length) still = setTimeout(hide, 150);
    };
    const show = () => { due ||= requestAnimationFrame(draw); };

    const tools = figure.querySelector(".tools");
    const returning = tools.querySelector("[data-do=return]");
    const stop = () => { cancelAnimationFrame(flight); flight = 0; };
    const fly = (to) => {
      stop();
      const from = camera;
      const round = Math.round((from.turn - to.turn) / (4 * quarter)) * 4 * quarter;  // the short way round
      const end = { ...to, turn: to.turn + round };
      const begun = performance.now();
      const step = (now) => {
        const share = calm.matches ? 1 : Math.min(Math.max((now - begun) / 500, 0), 1);
        const eased = share * share * (3 - 2 * share);
        const mix = (name) => from[name] + eased * (end[name] - from[name]);
        camera = {
          target: from.target.map((part, n) => part + eased * (end.target[n] - part)), turn: mix("turn"), rise: mix("rise"),
          half: from.half * (end.half / from.half) ** eased,
        };
        flight = 0;
        if (share < 1) flight = requestAnimationFrame(step);
        else camera = { ...end, target: [...end.target] };
        show();
      };
      step(begun);
    };
    const leave = () => { trail = [...trail, camera].slice(-50); returning.disabled = false; };
    const back = () => {
      const last = trail.pop();
      returning.disabled = !trail.length;
      if (last) fly(last);
    };

    // Towards the surface at a place: the direction of the triangles around its nearest vertex.
    const outward = (place) => {
      const { points, corners } = mesh;
      let nearest = 0, least = Infinity;
      for (let n = 0; n < points.length; n += 3) {
        const away = (points[n] - place[0]) ** 2 + (points[n + 1] - place[1]) ** 2 + (points[n + 2] - place[2]) ** 2;
        if (away < least) { least = away; nearest = n / 3; }
      }
      const at = (n) => [points[3 * n], points[3 * n + 1], points[3 * n + 2]];
      let normal = [0, 0, 0];
      for (let n = 0; n < corners.length; n += 3) {
        if (corners[n] !== nearest && corners[n + 1] !== nearest && corners[n + 2] !== nearest) continue;
        const [a, b, c] = [at(corners[n]), at(corners[n + 1]), at(corners[n + 2])];
        normal = sum([1, normal], [1, cross(sum([1, b], [-1, a]), sum([1, c], [-1, a]))]);
      }
      const length = Math.hypot(...normal);
      return length ? normal.map((part) => part / length) : null;
    };
    const look = (target) => {
      if (!camera) draw();
      if (!camera) return;
      const { place, reach } = marks.find(({ mark }) => mark === target);
      const normal = outward(place);
      let { turn, rise } = camera;
      if (normal && dot(normal, turned(mesh, camera).back) < 0.5) {
        turn = Math.atan2(dot(normal, mesh.right), dot(normal, mesh.front));
        rise = Math.min(Math.max(Math.asin(Math.min(Math.max(dot(normal, mesh.up), -1), 1)), -1.4), 1.4);
      }
      leave();
      fly({ target: place, turn, rise, half: Math.max(2 * reach, 10 * mesh.cell, 0.015) });
    };
    over.look = look;

    const zoom = (factor) => { camera = { ...camera, half: Math.min(Math.max(camera.half * factor, 1e-5), 1e6) }; show(); };
    const turn = (across, down) => {
      camera = { ...camera, turn: camera.turn - across, rise: Math.min(Math.max(camera.rise + down, -quarter), quarter) };
      show();
    };
    const shift = (across, down) => {
      const axes = turned(mesh, camera), pixel = 2 * camera.half / size[1];
      camera = { ...camera, target: sum([1, camera.target], [-across * pixel, axes.right], [down * pixel, axes.up]) };
      show();
    };
    const to = (side) => { leave(); fly(frame(...sides[side])); };
    const act = (what) => {
      if (!what || !camera) return false;
      if (what === "in" || what === "out") { stop(); zoom(what === "in" ? 0.6 : 1 / 0.6); }
      else if (what === "reset") to("front");
      else if (what === "return") back();
      else to(what);
      return true;
    };
    tools.hidden = false;
    tools.addEventListener("click", (event) => act(event.target.dataset.do));
    const keys = {
      "+": "in", "=": "in", "-": "out", "0": "reset", Home: "reset", Escape: "return",
      1: "front", 2: "back", 3: "left", 4: "right", 5: "top", 6: "bottom",
    };
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    stage.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || !camera) return;
      const arrow = arrows[event.key];
      if (arrow) {
        stop();
        if (event.shiftKey) shift(-30 * arrow[0], -30 * arrow[1]); else turn(-0.12 * arrow[0], -0.12 * arrow[1]);
      } else if (!act(keys[event.key])) return;
      event.preventDefault();
    });

    over.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.metaKey || !camera) return;  // the page must still scroll
      event.preventDefault();
      stop();
      const box = over.getBoundingClientRect();
      const [x, y] = [event.clientX - box.left - size[0] / 2, event.clientY - box.top - size[1] / 2];
      const factor = Math.exp(Math.sign(event.deltaY) * 0.25);
      shift(-x, -y);  // what lies under the pointer stays there
      zoom(factor);
      shift(x, y);
    }, { passive: false });
    let from = null, dragged = false;
    over.addEventListener("contextmenu", (event) => { if (dragged) event.preventDefault(); });
    over.addEventListener("pointerdown", (event) => {
      dragged = false;
      if (event.button > 2 || !camera) return;
      stop();
      from = { x: event.clientX, y: event.clientY, pan: event.button > 0 || event.shiftKey, moved: false };
    });
    over.addEventListener("pointermove", (event) => {
      if (!from) return;
      const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
      if (!from.moved && Math.hypot(dx, dy) < 4) return;
      if (!from.moved) over.setPointerCapture(event.pointerId);
      if (from.pan) shift(dx, dy); else turn(dx * 0.008, dy * 0.008);
      from = { ...from, x: event.clientX, y: event.clientY, moved: true };
      over.classList.add("moving");
    });
    const end = () => { dragged = Boolean(from && from.moved); from = null; over.classList.remove("moving"); };
    over.addEventListener("pointerup", end);
    over.addEventListener("pointercancel", end);
    // A drag that ends on a mark is not a choice of that mark.
    over.addEventListener("click", (event) => { if (dragged) event.preventDefault(); dragged = false; }, true);
    over.addEventListener("dragstart", (event) => event.preventDefault());

    stage.hidden = false;
    figure.classList.add("turning");
    new ResizeObserver(show).observe(stage);
  };
  figures.forEach(view);

  // A context that is lost leaves nothing to turn: the pictures come back.
  canvas.addEventListener("webglcontextlost", () => {
    figures.forEach((figure) => {
      figure.classList.remove("turning");
      figure.querySelector(".stage").hidden = true;
    });
  });
})();
